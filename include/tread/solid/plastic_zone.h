// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_plastic_zone_h
#define tread_solid_plastic_zone_h

#include <tread/material/plastic.h>

#include <deal.II/base/point.h>

#include <functional>
#include <vector>

namespace tread
{
  /// Cells of one body that may yield.
  struct PlasticZone
  {
    unsigned int    body;
    PlasticMaterial material;
    /// Whether a cell with its centre at this reference position (m) belongs to the zone.
    std::function<bool(const dealii::Point<3> &)> contains;
  };

  /// Index of the zone in which a cell of a body with this centre (reference configuration, m) may yield: the
  /// last zone that contains it; -1 if there is none or if that zone is elastic.
  int zone_at(const std::vector<PlasticZone> &zones, const unsigned int body, const dealii::Point<3> &centre);
} // namespace tread

#endif
