// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/csv_table.h>
#include <tread/scene/scene.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace tread
{
  int Scene::first_support() const
  {
    // The first whose middle lies on the rail.
    return std::ceil((rail_begin() - track.support_0) / track.sleeper_spacing - 1e-9);
  }


  std::vector<double> Scene::support_positions() const
  {
    const int           last = std::floor((rail_end() - track.support_0) / track.sleeper_spacing + 1e-9);
    std::vector<double> positions;
    for (int i = first_support(); i <= last; ++i)
      positions.push_back(track.support_0 + track.sleeper_spacing * i);
    return positions;
  }


  std::vector<int> Scene::recorded_supports() const
  {
    if (!track.has_supports())
      return {};
    std::vector<int> numbers = output.supports;
    if (numbers.empty())
      {
        const int     size = support_positions().size();
        std::set<int> beside_paths;
        for (unsigned int k = 0; k < n_wheels(); ++k)
          {
            const int first = std::max<int>(first_support(), std::floor((path_begin(k) - track.support_0) /
                                                                        track.sleeper_spacing)),
                      last =
                        std::min<int>(first_support() + size - 1,
                                      std::ceil((meshed_end(k) - track.support_0) / track.sleeper_spacing));
            for (int i = first; i <= last; ++i)
              beside_paths.insert(i);
          }
        numbers.assign(beside_paths.begin(), beside_paths.end());
      }
    return numbers;
  }


  void Scene::take_support_springs()
  {
    require(track.has_supports(),
            "'Track/Support file' needs supports: 'Track/Foundation' must be one-layer or two-layer");
    using Springs = TrackParameters::Springs;
    struct Column
    {
      const char *name;
      double Springs::*value;
      double           in_si;
      double           least; ///< SI
      bool             of_ballast;
    };
    const std::array<Column, 5> columns{
      {{"pad_stiffness_MN_per_m", &Springs::pad_stiffness, 1e6, 1., false},
       {"pad_damping_kN_s_per_m", &Springs::pad_damping, 1e3, 0., false},
       {"ballast_stiffness_MN_per_m", &Springs::ballast_stiffness, 1e6, 0., true},
       {"ballast_damping_kN_s_per_m", &Springs::ballast_damping, 1e3, 0., true},
       {"ballast_gap_mm", &Springs::ballast_gap, 1e-3, 0., true}}};
    const std::string file = located(track.support_file), begin = "'Track/Support file': '" + file + "' ";
    const CsvTable    table(
         file,
         [&](const std::string &name) {
        const bool is_known =
          name == "support" ||
          std::any_of(columns.begin(), columns.end(), [&](const Column &c) { return name == c.name; });
        require(is_known, begin + "has a column '" + name +
                               "'; it may have support, pad_stiffness_MN_per_m, pad_damping_kN_s_per_m, "
                                  "ballast_stiffness_MN_per_m, ballast_damping_kN_s_per_m and ballast_gap_mm");
        return true;
      },
         "'Track/Support file': cannot read '" + file + "'");
    const std::vector<double> &numbers = table.column("support");
    require(!numbers.empty() && table.names().size() > 1, begin + "has no rows, or no column beside support");
    for (std::size_t row = 0; row < numbers.size(); ++row)
      {
        const std::string place = begin + "row " + std::to_string(row + 1) + ": ";
        constexpr double  most  = 1e6; // more than on any rail
        require(numbers[row] == std::round(numbers[row]) && std::abs(numbers[row]) <= most,
                place + "support " + text_of(numbers[row]) + " is no whole number, or far beyond the rail");
        const int number = static_cast<int>(numbers[row]);
        require(support_springs.count(number) == 0,
                place + "support " + std::to_string(number) + " occurs twice");
        Springs own{track.pad_stiffness, track.ballast_stiffness, track.pad_damping, track.ballast_damping};
        for (const Column &column : columns)
          if (table.has(column.name))
            {
              require(!column.of_ballast || track.foundation == Foundation::two_layer,
                      begin + "has " + column.name + ", but 'Track/Foundation' one-layer has no ballast");
              own.*column.value = column.in_si * table.column(column.name)[row];
              require(own.*column.value >= column.least,
                      place + column.name + " " + text_of(own.*column.value / column.in_si) +
                        " is too small; at least " + text_of(column.least / column.in_si));
            }
        support_springs[number] = own;
      }
  }


  TrackParameters Scene::track_parameters() const
  {
    TrackParameters p;
    p.springs      = {track.pad_stiffness, track.ballast_stiffness, track.pad_damping, track.ballast_damping};
    p.pads_pull    = track.pads_pull;
    p.pad_length   = track.pad_length;
    p.pad_width    = track.pad_width;
    p.pad_middle   = base_middle()[1];
    p.points_along = track.points_along;
    p.points_across = track.points_across;
    p.two_layers    = track.foundation == Foundation::two_layer;
    p.sleeper_mass  = track.sleeper_mass;
    for (const auto &[number, springs] : support_springs)
      p.exceptions[number - first_support()] = springs;
    return p;
  }


  RailBaseParameters Scene::rail_base_parameters() const
  {
    return {track.co_running_mass,
            {track.vertical_stiffness, track.vertical_damping},
            {track.lateral_stiffness, track.lateral_damping}};
  }


  AbsorbingEnds Scene::absorbing_ends() const
  {
    return {rail_begin(), rail_end(), rail.ends == EndKind::absorbing ? rail.absorbing_length : 0.,
            rail.material.elastic().shear_wave_speed()};
  }


  std::optional<std::array<TrackBeyondParameters, 2>> Scene::track_beyond() const
  {
    if (rail.ends != EndKind::endless)
      return {};
    TrackParameters alike = track_parameters();
    alike.exceptions.clear();
    TrackBeyondParameters p;
    p.n_spans                        = rail.spans_beyond;
    p.spacing                        = track.sleeper_spacing;
    p.stiffness_along                = track.stiffness_along;
    p.shear_speed                    = rail.material.elastic().shear_wave_speed();
    p.gravity                        = vehicle.gravity;
    p.layers                         = alike.layers(0);
    const std::vector<double> places = support_positions();
    TrackBeyondParameters     before = p, behind = p;
    before.first_support = track.sleeper_spacing - (places.front() - rail_begin());
    behind.first_support = track.sleeper_spacing - (rail_end() - places.back());
    return std::array{before, behind};
  }


  dealii::Point<3> Scene::base_middle() const
  {
    return dealii::Point<3>(0., std::sin(rail.angle()) * rail.height(),
                            -std::cos(rail.angle()) * rail.height());
  }
} // namespace tread
