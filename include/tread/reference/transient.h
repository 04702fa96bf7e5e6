// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_transient_h
#define tread_reference_transient_h

#include <tread/reference/rolling_case.h>

#include <vector>

namespace tread::reference
{
  /// Rolling from a state that is not steady (Kalker 1990, section 5.2.2.5), like bodies.
  ///
  /// The wheel moves by a step, its surface's particles are carried through the patch, and the slip of an
  /// element is the rigid slip plus what the displacement difference of its particles has changed by since
  /// the step before. The pressure stays as it is. Inertia plays no part.
  struct TransientCase
  {
    /// Bodies, load, friction; the force or the creepages that act while rolling.
    RollingCase rolling;

    /// Fx/Fn of a shift without rolling before (Cattaneo 1938); 0: rolling starts without tractions. Where a
    /// given force differs from it, the wheel shifts once more until that force acts.
    double start_traction_coefficient = 0.;

    double       distance = 0.; ///< to be rolled [m], > 0
    double       step     = 0.; ///< [m]; 0: the element edge
    unsigned int order    = 2;  ///< of the slip in the step and in the element size, 1 or 2

    std::vector<double>
      fields_at; ///< distances [m], ascending: the fields of the first step that reaches each
  };

  struct TransientFields
  {
    double                    distance = 0.;    ///< [m]
    std::vector<double>       shear_x, shear_y; ///< on the wheel [Pa]
    std::vector<double>       slip_x, slip_y;   ///< relative [-]
    std::vector<ElementState> state;
  };

  /// Entry 0 of the series is the start.
  struct TransientResult
  {
    std::vector<double> distance;             ///< rolled [m]
    std::vector<double> traction_coefficient; ///< Fx/Fn on the wheel [-]
    std::vector<double> lateral_coefficient;  ///< Fy/Fn [-]
    std::vector<double> creepage;             ///< longitudinal, negative for a driving wheel [-]

    unsigned int                 n_x = 0, n_y = 0;
    std::vector<double>          x, y;     ///< element centres [m]
    std::vector<double>          pressure; ///< [Pa]
    std::vector<TransientFields> fields;
    double                       start_shift = 0.; ///< of the wheel over the rail in the shift before [m]
  };

  /// Errors: as solve_rolling(); std::invalid_argument also for unlike bodies, no friction, or a distance or
  /// step that is none.
  TransientResult solve_transient(const TransientCase &transient);
} // namespace tread::reference

#endif
