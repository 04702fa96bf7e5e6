// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_half_space_h
#define tread_reference_half_space_h

#include <tread/reference/influence.h>
#include <tread/reference/rolling_case.h>

#include <array>
#include <functional>
#include <vector>

namespace tread::reference
{
  // Rolling contact of two elastic half-spaces, the model of Kalker's CONTACT (Kalker 1990; Vollebregt 2014):
  // piecewise constant tractions on a regular grid, exact influence coefficients, Coulomb friction. Axes and
  // signs as in rolling_case.h.

  /// The normal problem: p >= 0, e = h + u_z - approach >= 0, p e = 0 on every element.
  struct NormalProblem
  {
    std::vector<double> gap;                    ///< undeformed gap h per element [m], any shape
    bool                prescribe_force = true; ///< false: the approach is given
    double              force           = 0.;   ///< Fn [N] > 0
    double              approach        = 0.;   ///< [m], larger than the smallest gap
    std::vector<double> initial_pressure;       ///< start of the iteration, may be empty
    double              tolerance = 1e-8; ///< on the gap's error over the depth (approach - smallest gap)
    unsigned int        max_iterations = 1000;
  };

  struct NormalSolution
  {
    std::vector<double>       pressure;      ///< [Pa]
    std::vector<double>       gap;           ///< deformed gap e [m]
    std::vector<unsigned int> contact;       ///< elements with pressure > 0
    double                    force    = 0.; ///< [N]
    double                    approach = 0.; ///< [m]
    bool         cut = false; ///< contact reaches the border of the grid: the answer is that of a cut body
    unsigned int iterations = 0;
    double       residual   = 0.; ///< largest |e| in contact or -e outside, over the depth [-]
  };

  /// Conjugate gradients on the active set (Polonsky & Keer 1999), products by FFT.
  /// Throws std::invalid_argument for wrong sizes, force <= 0, no contact at the given approach;
  /// std::runtime_error if the tolerance is not reached.
  NormalSolution solve_normal(const FourierGrid    &fourier,
                              const NormalOperator &op,
                              const NormalProblem  &problem);

  /// How the surfaces move over each other.
  enum class Motion
  {
    shift, ///< one step of rigid shift without rolling (CONTACT's T = 1); creepages are shifts [m], spin a
           ///< rotation [rad]
    transient, ///< one step of rolling, starting from previous tractions (T = 2)
    steady     ///< steady rolling (T = 3)
  };

  /// The tangential problem: slip s = w + (u - u')/step with the rigid slip w = (xi - phi y, eta + phi x) and
  /// any additional prescribed slip, where u is the displacement at the element and u' that of the particle
  /// one step earlier (at x + step; at the same place for a shift, where step counts as 1); |p| <= f pn; s =
  /// 0 where |p| < f pn, else p = -f pn s/|s|.
  struct TangentialProblem
  {
    Motion motion   = Motion::steady;
    double friction = 0.; ///< f > 0
    /// What is left of f at each element, in [0, 1], on the full grid; empty: all of it.
    std::vector<double> friction_share;
    double              step = 0.; ///< distance rolled per step [m]; 0: the element edge dx

    double longitudinal =
      0.; ///< xi [-] (shift: [m]); if Fx is prescribed: not used, or first guess with initial_shear
    double lateral = 0.; ///< eta [-] (shift: [m])
    double spin    = 0.; ///< phi [rad/m] (shift: [rad])
    /// More rigid slip (x and y component) at (x, y) [m], as of a tread that is no cone; empty: none.
    std::function<std::array<double, 2>(double, double)> more_slip;

    /// Rigid slip without the creepages.
    std::array<double, 2> uneven_slip(const double x, const double y) const
    {
      const std::array<double, 2> more = more_slip ? more_slip(x, y) : std::array<double, 2>{{0., 0.}};
      return {{more[0] - spin * y, more[1] + spin * x}};
    }

    bool   prescribe_longitudinal_force = false;
    bool   prescribe_lateral_force      = false;
    double longitudinal_force           = 0.; ///< Fx on the wheel [N]
    double lateral_force                = 0.; ///< Fy on the wheel [N]

    /// Order in the step of the difference that makes the slip. 1: (u - u')/step, which belongs half a step
    /// ahead. 2: (3 u/2 - 2 u' + u''/2)/step at the element's own place, u'' where the particle was two steps
    /// ago, and the leading edge within an element as in edges.h. A transient step needs before_shear_x and
    /// before_shear_y for it.
    unsigned int order = 1;
    /// For order 2: where each row of elements has its leading edge [m]; empty: found from the pressure.
    std::vector<double> leading_edge;

    std::vector<double> previous_shear_x; ///< full grid, before the step; empty: none (not used if steady)
    std::vector<double> previous_shear_y;
    std::vector<double> before_shear_x; ///< two steps before, for transient steps of order 2
    std::vector<double> before_shear_y;
    std::vector<double>
      previous_pressure;                 ///< for unlike bodies only; empty: as now if rolling, none if shift
    std::vector<double> initial_shear_x; ///< start of the iteration; empty: solutions on coarser grids
    std::vector<double> initial_shear_y;

    double       tolerance      = 1e-6; ///< on the violation of Coulomb's law, in units of f p_max
    unsigned int max_iterations = 60;   ///< Newton steps
  };

  struct TangentialSolution
  {
    // full grid
    std::vector<double> shear_x, shear_y; ///< on the wheel [Pa]
    std::vector<double> slip_x,
      slip_y; ///< relative slip [-] (shift: [m]); zero outside contact and in adhesion
    std::vector<double>       displacement_x, displacement_y; ///< u, wheel less rail [m], in contact only
    std::vector<ElementState> state;

    double longitudinal = 0., lateral = 0.,
           spin               = 0.; ///< as in the problem, or found for the prescribed force
    double longitudinal_force = 0., lateral_force = 0., spin_moment = 0.;

    unsigned int iterations        = 0;  ///< Newton steps on this grid (coarser ones give the first guess)
    unsigned int linear_iterations = 0;  ///< Krylov steps on this grid
    unsigned int fallback_steps    = 0;  ///< transient steps taken because Newton alone did not converge
    double       residual          = 0.; ///< largest violation of Coulomb's law over f p_max [-]
  };

  /// Semismooth Newton method for the projection form of Coulomb's law, with all prescribed forces as further
  /// equations, and GMRES with FFT products for its linear systems.
  /// @param grid     the normal problem's grid
  /// @param pressure full grid [Pa]
  /// Throws std::invalid_argument for wrong sizes, no contact, a prescribed force beyond f Fn;
  /// std::runtime_error if it does not converge.
  TangentialSolution solve_tangential(const Grid                &grid,
                                      const ElasticPair         &pair,
                                      const std::vector<double> &pressure,
                                      const TangentialProblem   &problem);

  /// Normal and tangential problem together. For unlike bodies (K != 0) they are solved in turn until the
  /// pressure changes by less than 1e-7 of its maximum (Kalker's Panagiotopoulos process).
  struct ContactSolution
  {
    NormalSolution     normal;
    TangentialSolution tangential;
    unsigned int       outer_iterations = 1;
  };
  ContactSolution solve_contact(const Grid              &grid,
                                const ElasticPair       &pair,
                                const NormalProblem     &normal,
                                const TangentialProblem &tangential);
} // namespace tread::reference

#endif
