// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/steady_damage.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tread
{
  namespace
  {
    constexpr double nanometre = 1e-9; // m, to which lines are told apart

    /// Elements by their lines along the path, from where they enter the patch to where they leave it.
    std::vector<std::vector<PatchNode>> rows_of(const std::vector<PatchNode> &elements)
    {
      std::map<std::pair<long long, long long>, std::vector<PatchNode>> rows;
      for (const PatchNode &element : elements)
        rows[{std::llround(element.position[1] / nanometre), std::llround(element.position[2] / nanometre)}]
          .push_back(element);
      std::vector<std::vector<PatchNode>> list;
      for (auto &[place, row] : rows)
        {
          std::sort(row.begin(), row.end(),
                    [](const PatchNode &a, const PatchNode &b) { return a.position[0] > b.position[0]; });
          list.push_back(std::move(row));
        }
      return list;
    }

    /// Spacing of elements along the rows, m: all are alike.
    double spacing_of(const std::vector<std::vector<PatchNode>> &rows)
    {
      double spacing = 1e300;
      for (const std::vector<PatchNode> &row : rows)
        for (std::size_t k = 1; k < row.size(); ++k)
          spacing = std::min(spacing, row[k - 1].position[0] - row[k].position[0]);
      return spacing < 1e300 ? spacing : std::sqrt(rows.front().front().area);
    }

    /// @param heat whose interval is the time in which an element passes
    SurfacePlace passage_of(const std::vector<PatchNode> &row,
                            const double                  spacing,
                            const reference::SurfaceHeat &heat,
                            const WearLaw                *wear,
                            const double                  heat_share,
                            const double                  effusivity)
    {
      const double                   time = heat.interval();
      reference::SurfaceHeat::Memory memory{};
      SurfacePlace                   place{};
      place.y        = row.front().position[1];
      place.passages = 1.;
      double entered = row.front().position[0];
      for (const PatchNode &element : row)
        {
          const double gap = entered - element.position[0]; // where parts of a patch lie one behind the other
          if (gap > 1.5 * spacing)
            heat.rest(memory, std::round(gap / spacing - 1.) * time);
          entered           = element.position[0];
          const double slip = element.adhesion ? 0. : element.slip_speed() * time,
                       flux = element.adhesion ? 0. : element.shear_size() * element.slip_speed();
          place.area        = element.area / spacing; // on a metre of way
          place.friction_work += flux * time;
          place.slip_distance += slip;
          place.max_pressure = std::max(place.max_pressure, element.pressure);
          place.max_shear    = std::max(place.max_shear, element.shear_size());
          place.max_temperature =
            std::max(place.max_temperature, heat.flow(memory, heat_share * flux) / effusivity);
          if (wear && slip > 0.)
            place.wear_depth +=
              wear->volume({flux * time * element.area, element.pressure * element.area * slip, slip, time,
                            element.area}) /
              element.area;
        }
      return place;
    }
  } // namespace


  std::vector<SurfacePlace> steady_damage(const std::vector<PatchNode> &elements,
                                          const double                  speed,
                                          const WearLaw                *wear,
                                          const double                  heat_share,
                                          const double                  effusivity)
  {
    std::vector<SurfacePlace> places;
    const auto                rows = rows_of(elements);
    if (rows.empty())
      return places;
    const double                 spacing = spacing_of(rows);
    const reference::SurfaceHeat heat(spacing / speed);
    for (const std::vector<PatchNode> &row : rows)
      places.push_back(passage_of(row, spacing, heat, wear, heat_share, effusivity));
    return places;
  }
} // namespace tread
