// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/further_wheels.h>

namespace tread
{
  namespace
  {
    constexpr unsigned int most_wheels = 20;
  } // namespace


  void FurtherWheelsSection::declare(ParameterTable &table)
  {
    constexpr double tiny = 1e-12; // for "above 0"
    Section          section(table, "Further wheels");

    section.add(
      "Distances (mm)", distances,
      "Of the axles of further wheels behind that of the first one, rising, separated by commas. "
      "They are like the first wheel, with the same load, speed and rolled distance, and roll on the "
      "same rail at the same time. A distance of whole finest cells gives each the same mesh. "
      "Empty: there is one wheel.",
      Number(tiny, 1e5), most_wheels);
    section.needs(Need("Motion/Creepage", {"predicted"}).or_else({"Motion/Drive", {"torque"}}))
      .add("Traction coefficients", traction_coefficients,
           "One for each further wheel, separated by commas. Empty: that of the first one. Without meaning "
           "where 'Motion/Creepage' prescribes the motion of all wheels.",
           Number(-2., 2.), most_wheels);
  }


  void FurtherWheelsSection::check(const double least_distance) const
  {
    double before = 0.;
    for (const double distance : distances)
      {
        require(distance - before > least_distance,
                "'Further wheels/Distances (mm)': " + text_in_mm(distance) + " after " + text_in_mm(before) +
                  "; axles must follow each other by more than a wheel's diameter, " +
                  text_in_mm(least_distance));
        before = distance;
      }
    require(traction_coefficients.empty() || traction_coefficients.size() == distances.size(),
            "'Further wheels/Traction coefficients' has " + std::to_string(traction_coefficients.size()) +
              " entries; 'Further wheels/Distances (mm)' has " + std::to_string(distances.size()));
  }
} // namespace tread
