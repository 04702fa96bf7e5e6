// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_rolling_case_h
#define tread_reference_rolling_case_h

#include <tread/reference/elastic.h>
#include <tread/reference/friction.h>
#include <tread/reference/hertz.h>
#include <tread/reference/influence.h>

#include <functional>
#include <string>
#include <vector>

namespace tread::reference
{
  /// A wheel that rolls steadily over a rail, as the half-space solver sees it.
  ///
  /// Axes: origin at the centre of contact, x in rolling direction (leading edge at +x), y lateral, z up into
  /// the wheel. All forces and tractions are those ON THE WHEEL, exerted by the rail: Fx > 0 is a driving
  /// wheel. Creepages have the signs of Kalker's CONTACT: rigid slip of the wheel relative to the rail over
  /// the speed,
  ///   w_x = creepage - spin y - r(y),   w_y = lateral_creepage + spin x + r'(y) x,
  /// so that `creepage` is NEGATIVE for a driving wheel; r is what the tread adds to the rolling radius.
  struct RollingCase : Friction
  {
    // The undeformed gap A x^2 + B y^2.
    double curvature_x = 0.; ///< A [1/m], > 0 (1/(2 R) for a wheel of radius R)
    double curvature_y = 0.; ///< B [1/m], > 0
    /// Any other undeformed gap [m] at (x, y) [m]; A and B then only choose the first grid and the start.
    std::function<double(double, double)> gap;

    double normal_force = 0.; ///< Fn [N], > 0
    double speed        = 1.; ///< rolling speed v [m/s], > 0; scales slip and frictional power only

    Elastic wheel; ///< upper body
    Elastic rail;  ///< lower body

    /// true: Fx is given; false: the creepage is given. Without friction Fx = 0 leaves the creepage open; it
    /// is taken as zero.
    bool   prescribe_force      = true;
    double traction_coefficient = 0.; ///< Fx/Fn [-], |Fx/Fn| < f; used if prescribe_force
    double creepage             = 0.; ///< longitudinal creepage [-]; used if not prescribe_force
    double lateral_creepage     = 0.; ///< [-], always prescribed
    double spin                 = 0.; ///< [rad/m], always prescribed
    /// Rolling radius at y [m] over that at the origin, minus one; empty: 0. Of an upright cone spin y.
    std::function<double(double)> radius_change;

    /// Of a layer between the bodies: ElasticPair::layer [m/Pa].
    double layer = 0.;

    double element_size   = 0.33e-3; ///< edge of the surface elements along x [m], > 0
    double element_size_y = 0.;      ///< along y [m]; 0: square elements

    double edge_y() const
    {
      return element_size_y > 0. ? element_size_y : element_size;
    }
  };

  /// State of an element of the grid.
  enum class ElementState : unsigned char
  {
    exterior = 0, ///< no contact
    adhesion = 1, ///< in contact, no slip
    slip     = 2  ///< in contact, traction at the friction bound
  };

  /// The answer to a RollingCase. Vectors have one entry per grid element, x fastest.
  struct RollingResult
  {
    Grid                grid;
    std::vector<double> x, y;             ///< element centres [m]; one lies at (0, 0)
    std::vector<double> pressure;         ///< [Pa], >= 0
    std::vector<double> shear_x, shear_y; ///< traction on the wheel [Pa]
    std::vector<double> slip_x,
      slip_y; ///< velocity of the wheel's surface relative to the rail's [m/s]; opposite to the shear
    std::vector<ElementState> state;

    double normal_force         = 0.; ///< Fn [N]
    double longitudinal_force   = 0.; ///< Fx on the wheel [N]
    double lateral_force        = 0.; ///< Fy on the wheel [N]
    double spin_moment          = 0.; ///< moment of the shear about z, on the wheel [N m]
    double traction_coefficient = 0.; ///< Fx/Fn [-]
    double creepage             = 0.; ///< longitudinal, negative for a driving wheel [-]
    double lateral_creepage     = 0.; ///< [-]
    double spin                 = 0.; ///< [rad/m]
    double approach             = 0.; ///< of distant points of the two bodies [m]

    HertzEllipse hertz{}; ///< exact, for the same case

    double max_pressure   = 0.; ///< largest element value [Pa]
    double area           = 0.; ///< number of elements in contact times their area [m^2]
    double semi_axis_x    = 0.; ///< half the longest row of elements in contact [m]
    double semi_axis_y    = 0.; ///< half the longest column [m]
    double adhesion_share = 0.; ///< elements in adhesion over elements in contact [-]
    double max_shear      = 0.; ///< [Pa]
    double max_slip       = 0.; ///< [m/s]
    double frictional_power =
      0.; ///< sum of |shear| |slip| over the patch [W], >= 0; first order in the element size
    double power_balance = 0.; ///< pressure times slope of the gap less shear times rigid slip, for like
                               ///< bodies without radius_change -(Fx xi + Fy eta + Mz phi) v [W]; converges
                               ///< faster, the better reference

    /// How the solver came to it.
    struct Convergence
    {
      unsigned int normal_iterations     = 0;  ///< conjugate-gradient steps
      unsigned int tangential_iterations = 0;  ///< Newton steps on the grid itself
      unsigned int linear_iterations     = 0;  ///< Krylov steps on the grid itself
      double       normal_residual       = 0.; ///< largest error of the gap in contact over the approach [-]
      double       tangential_residual   = 0.; ///< largest violation of Coulomb's law over f p_max [-]
      double       seconds               = 0.; ///< wall time [s]
    };
    Convergence convergence;
  };

  /// Solve a case with the half-space solver. Chooses the grid itself: with the centre element at (0, 0), it
  /// holds the patch.
  ///
  /// Errors: std::invalid_argument for non-positive curvatures, force, speed or element size, negative
  /// friction, |Fx| >= f Fn > 0, or an element size that gives fewer than 3 elements along a semi-axis of the
  /// ellipse
  /// or more than two million elements; std::runtime_error if the solver does not converge.
  RollingResult solve_rolling(const RollingCase &rolling_case);
} // namespace tread::reference

#endif
