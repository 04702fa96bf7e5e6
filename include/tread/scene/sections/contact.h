// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_contact_h
#define tread_scene_sections_contact_h

#include <tread/base/section.h>
#include <tread/contact/coulomb_solver.h>
#include <tread/contact/friction_law.h>

namespace tread
{
  /// Section `Contact`.
  struct ContactSection
  {
    double                  friction_coefficient = 0.5;       ///< without slip
    std::string             friction_law         = "Coulomb"; ///< its name in the list of laws
    CoulombSolverParameters solver;
    std::vector<double>     friction_places, friction_factors;    ///< along the rail, m and -
    std::vector<double>     friction_pressures, pressure_factors; ///< Pa and -
    std::vector<double>     temperatures, temperature_factors;    ///< degrees C and -
    std::vector<double>     across_places, across_factors;        ///< y of the rail, m and -
    std::vector<double>     inclinations, inclination_factors;    ///< of the rail's surface, rad and -

    /// Of the friction coefficient at x (m), linear between the places.
    double friction_factor(const double x) const;
    /// Of the friction coefficient at a pressure (Pa), linear between those given; 1 where none is given.
    double pressure_factor(const double pressure) const;
    /// The same at a temperature (degrees C) of the surfaces.
    double temperature_factor(const double temperature) const;
    /// The same across the rail, by y of the rail and by the inclination of its surface, positive where it
    /// falls to the gauge side (m, rad).
    double factor_across(const double y, const double inclination) const;
    bool   varies_across() const
    {
      return !across_places.empty() || !inclinations.empty();
    }
    /// Whether friction_factor() changes between two places (m).
    bool friction_varies(const double from, const double to) const;

    /// @throws InputError
    void check() const;
    void declare(ParameterTable &table);
  };
} // namespace tread

#endif
