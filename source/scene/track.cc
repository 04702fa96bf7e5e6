// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/scene.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
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
                                      std::ceil((path_end(k) - track.support_0) / track.sleeper_spacing));
            for (int i = first; i <= last; ++i)
              beside_paths.insert(i);
          }
        numbers.assign(beside_paths.begin(), beside_paths.end());
      }
    return numbers;
  }


  TrackParameters Scene::track_parameters() const
  {
    TrackParameters p;
    p.pad_stiffness     = track.pad_stiffness;
    p.pad_damping       = track.pad_damping;
    p.pad_length        = track.pad_length;
    p.pad_width         = track.pad_width;
    p.pad_middle        = base_middle()[1];
    p.points_along      = track.points_along;
    p.points_across     = track.points_across;
    p.two_layers        = track.foundation == Foundation::two_layer;
    p.sleeper_mass      = track.sleeper_mass;
    p.ballast_stiffness = track.ballast_stiffness;
    p.ballast_damping   = track.ballast_damping;
    return p;
  }


  AbsorbingEnds Scene::absorbing_ends() const
  {
    return {rail_begin(), rail_end(), rail.ends == EndKind::absorbing ? rail.absorbing_length : 0.,
            rail.material.elastic().shear_wave_speed()};
  }


  dealii::Point<3> Scene::base_middle() const
  {
    return dealii::Point<3>(0., std::sin(rail.angle()) * rail.height(),
                            -std::cos(rail.angle()) * rail.height());
  }
} // namespace tread
