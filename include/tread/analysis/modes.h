// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_modes_h
#define tread_analysis_modes_h

#include <tread/analysis/elastic_system.h>

#include <slepceps.h>

#include <complex>
#include <vector>

namespace tread
{
  /// All undamped eigenmodes K phi = omega^2 M phi of a system up to a frequency, mass-normalised, and what
  /// follows from them.
  ///
  /// Krylov-Schur iteration of SLEPc on the inverse of K + s^2 M, which is positive definite also where
  /// bodies are free, factorised by MUMPS on all ranks. The number of modes is known beforehand: it is that
  /// of the negative pivots of K - omega_max^2 M (Sylvester's law of inertia), so that none is missed.
  class Modes
  {
  public:
    /// @param up_to Hz, > 0. Collective. @throws std::runtime_error if the iteration does not find them all.
    Modes(const ElasticSystem &system, const double up_to);
    ~Modes();
    Modes(const Modes &)            = delete;
    Modes &operator=(const Modes &) = delete;

    std::size_t size() const
    {
      return vectors.size();
    }
    /// Hz, ascending; 0 for rigid motions whose eigenvalue is negative by rounding.
    double frequency(const unsigned int mode) const;
    /// Square of the angular frequency as computed, 1/s^2.
    double eigenvalue(const unsigned int mode) const
    {
      return eigenvalues[mode];
    }
    /// Nodal displacements, m for a modal mass of 1 kg m^2. Collective.
    NodalField shape(const unsigned int mode, ElasticSystem::RigidParts &parts) const
    {
      return system.displacements(vectors[mode], parts);
    }
    /// The damping matrix projected on the mode, as share of critical damping. Collective.
    double damping_share(const unsigned int mode) const;
    /// Largest entry of Phi^T M Phi - 1: modes are orthogonal with unit modal mass. Collective.
    double orthogonality_error() const;

    /// Modes of equal frequency are defined but for a rotation among them: choose it so that only the first
    /// of them moves a place vertically, and the sign of all modes so that the place moves up. Collective.
    void align(const ElasticSystem::Place &place);

    /// Vertical displacement of a place over the vertical force on it, m/N, at these complex angular
    /// frequencies (rad/s; omega - i eta for motions times exp(-eta t)). With all dampers: the equations are
    /// projected on the modes, the responses of the undamped system at low frequency to the force (and the
    /// next two vectors of its Krylov space) and those to a unit force of each support's dampers. Collective.
    std::vector<std::complex<double>> receptance(const ElasticSystem::Place              &place,
                                                 const std::vector<std::complex<double>> &omega) const;

    const ElasticSystem &system;

  private:
    unsigned int number_below(const double omega_squared) const;
    void         solve(const unsigned int n);

    Mat                 shifted = nullptr; ///< K + s^2 M
    EPS                 solver  = nullptr;
    std::vector<Vec>    vectors;
    std::vector<double> eigenvalues; ///< 1/s^2
  };
} // namespace tread

#endif
