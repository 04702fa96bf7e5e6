// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_planar_contact_h
#define tread_reference_planar_contact_h

#include <tread/reference/elastic.h>
#include <tread/reference/friction.h>
#include <tread/reference/half_space.h>

#include <array>
#include <functional>
#include <vector>

namespace tread::reference
{
  /// Steady rolling of two bodies with any gap, solved in one plane: a patch of any shape in its own axes.
  /// Axes and signs as in rolling_case.h, the origin anywhere in the plane.
  struct PlanarCase : Friction
  {
    Grid grid; ///< rectangular elements over all places in contact
    std::function<double(double, double)>
           gap;               ///< of the undeformed surfaces, negative where they overlap [m]
    double normal_force = 0.; ///< [N]; 0: they stay where the gap has them

    double speed = 1.; ///< rolling speed [m/s]; scales slip and power only

    double longitudinal = 0.; ///< creepage xi: wheel less rail over speed [-]
    double lateral      = 0.; ///< eta [-]
    double spin         = 0.; ///< phi [rad/m]
    std::function<std::array<double, 2>(double, double)>
      more_slip; ///< what the rigid slip has beyond (xi - phi y, eta + phi x) [-]; empty: nothing

    Elastic wheel, rail;

    /// Order of the slip, TangentialProblem::order. 1 is what CONTACT does.
    unsigned int order = 2;
  };

  struct PlanarResult
  {
    Grid                      grid;
    std::vector<double>       pressure;         ///< [Pa]
    std::vector<double>       shear_x, shear_y; ///< on the wheel [Pa]
    std::vector<double>       slip_x, slip_y;   ///< of the wheel over the rail [m/s]
    std::vector<ElementState> state;

    double       normal_force = 0., longitudinal_force = 0., lateral_force = 0.; ///< on the wheel [N]
    double       spin_moment  = 0.; ///< of the shear about the normal through the origin, on the wheel [N m]
    double       max_pressure = 0.; ///< [Pa]
    double       area         = 0.; ///< of elements in contact [m^2]
    double       adhesion_share   = 0.;    ///< of it [-]
    double       max_shear        = 0.;    ///< [Pa]
    double       max_slip         = 0.;    ///< [m/s]
    double       frictional_power = 0.;    ///< by the balance of forces, as RollingResult::power_balance [W]
    double       overlap          = 0.;    ///< largest, of the undeformed surfaces at the elements [m]
    double       y_begin = 0., y_end = 0.; ///< outer edges of the elements in contact [m]
    double       x_begin = 0., x_end = 0.;
    double       approach   = 0.; ///< beyond what the gap has [m]
    unsigned int iterations = 0;  ///< Newton steps of the tangential problem
  };

  /// Errors: std::invalid_argument where the surfaces do not overlap or a number makes no sense;
  /// std::runtime_error if contact reaches the border of the grid or the solver does not converge.
  PlanarResult solve_planar(const PlanarCase &planar);
} // namespace tread::reference

#endif
