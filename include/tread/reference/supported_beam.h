// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_supported_beam_h
#define tread_reference_supported_beam_h

#include <array>
#include <complex>
#include <limits>
#include <vector>

namespace tread::reference
{
  struct BeamSection
  {
    double bending_stiffness = 0.;                                      ///< E I, N m^2
    double shear_stiffness   = std::numeric_limits<double>::infinity(); ///< kappa G A, N; infinite: Euler
    double mass              = 0.;                                      ///< per length, kg/m
    double rotary_inertia    = 0.;                                      ///< rho I, kg m
  };

  /// The support between a rail and the ground at one sleeper: a pad and, in the two-layer track, a sleeper
  /// on ballast.
  struct SupportLayers
  {
    double pad_stiffness     = 0.; ///< N/m
    double pad_damping       = 0.; ///< N s/m
    double pad_radius        = 0.; ///< of gyration along the rail: it holds the slope as well, m
    double sleeper_mass      = 0.; ///< kg
    double ballast_stiffness = std::numeric_limits<double>::infinity(); ///< N/m; infinite: one layer
    double ballast_damping   = 0.;                                      ///< N s/m

    /// Force on the rail over its deflection, exp(i omega t): pad in series with sleeper and ballast [N/m].
    std::complex<double> stiffness(std::complex<double> omega) const;
    /// Force in the ballast over that in the pad.
    std::complex<double> transmission(std::complex<double> omega) const;
  };

  /// Angular frequency [rad/s] of the free vibration of a Timoshenko beam with the half wave length [m], the
  /// lower branch (Timoshenko 1921): pinned-pinned when this is the spacing of supports.
  double timoshenko_frequency(const BeamSection &section, double half_wave_length);

  /// A Timoshenko beam on discrete supports; its ends neither turn nor carry a shear force (symmetry).
  /// Two-node elements with the shape functions that solve the static equations, so that nodes are exact in
  /// statics; lumped inertia (error of a wave number k: (k h)^2/12).
  class SupportedBeam
  {
  public:
    /// @param layers one for each support; @param supports positions, ascending, within [begin, end]
    /// @param element_length upper bound [m]
    SupportedBeam(const BeamSection                &section,
                  const std::vector<SupportLayers> &layers,
                  const std::vector<double>        &supports,
                  double                            begin,
                  double                            end,
                  double                            element_length);
    /// All supports alike.
    SupportedBeam(const BeamSection         &section,
                  const SupportLayers       &layers,
                  const std::vector<double> &supports,
                  double                     begin,
                  double                     end,
                  double                     element_length)
      : SupportedBeam(section,
                      std::vector<SupportLayers>(supports.size(), layers),
                      supports,
                      begin,
                      end,
                      element_length)
    {
    }

    struct Load
    {
      double x;           ///< m
      double force;       ///< N, positive: deflection is positive in its direction
      double moment = 0.; ///< N m, positive: turns the way a positive slope does
    };

    /// Amplitudes of the steady state exp(i omega t).
    class Response
    {
    public:
      std::complex<double> deflection(double x) const;                ///< m
      std::complex<double> rotation(double x) const;                  ///< rad, of the cross-section
      std::complex<double> pad_force(unsigned int support) const;     ///< N
      std::complex<double> ballast_force(unsigned int support) const; ///< N

    private:
      friend class SupportedBeam;
      const SupportedBeam                             *beam;
      std::complex<double>                             omega;
      std::vector<std::array<std::complex<double>, 2>> nodes; ///< deflection (m), rotation (rad)
    };

    /// It refers to this beam, which must not be a temporary.
    /// @param omega rad/s; 0: static; omega - i eta: of forces and displacements times exp(-eta t)
    Response respond(const std::vector<Load> &loads, std::complex<double> omega = 0.) const &;
    Response respond(const std::vector<Load> &, std::complex<double> = 0.) const && = delete;

    const std::vector<SupportLayers> layers;   ///< by support
    const std::vector<double>        supports; ///< m

  private:
    /// Deflection and rotation at the share s of an element for its four nodal values (deflection and
    /// rotation of the left, then of the right node).
    struct Shape
    {
      std::array<double, 4> deflection, rotation;
    };
    Shape        shape(unsigned int element, double s) const;
    unsigned int element_at(double x, double &s) const;

    BeamSection               section;
    std::vector<double>       nodes; ///< m
    std::vector<unsigned int> node_of_support;
  };
} // namespace tread::reference

#endif
