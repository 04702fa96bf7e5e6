// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/mesh/flat_box.h>
#include <tread/mesh/profile_block.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// The surface may stand this steep on the base: cosine of the angle. Cells there are sheared by as much.
    constexpr double least_cosine = 0.34; // 70 degrees

    /// Surfaces are in reach of each other this many finest cells beside the fine zones.
    constexpr double cells_beside_zone = 4.;
  } // namespace


  ProfileSection::ProfileSection(const ProfileCurve &profile,
                                 const double        s_middle,
                                 const double        inclination,
                                 const Side          side,
                                 const double        depth,
                                 const double        half_width)
    : depth(depth)
    , half_width(half_width)
    , profile(profile)
    , s_middle(s_middle)
    , first(0.)
    , last(0.)
    , base_direction({std::cos(inclination), std::sin(inclination)})
  {
    const double               sign = side == Side::below ? -1. : 1.;
    const ProfileCurve::Place  p    = profile.at(s_middle);
    const dealii::Tensor<1, 2> inwards({-sign * base_direction[1], sign * base_direction[0]});
    base_middle = dealii::Point<2>(p.y, p.z) + depth * inwards;

    constexpr double step  = 0.1e-3; // m
    const auto       bears = [&](const double along) {
      const double s = s_middle + along;
      if (std::abs(along) > half_width || s < 0. || s > profile.length())
        return false;
      const ProfileCurve::Place at = profile.at(s);
      return at.dy * base_direction[0] + at.dz * base_direction[1] >= least_cosine * std::hypot(at.dy, at.dz);
    };
    if (!bears(0.))
      throw std::invalid_argument("the profile is too steep on the base of its block");
    while (bears(last + step))
      last += step;
    while (bears(first - step))
      first -= step;
    for (unsigned int side = 0; side < 2; ++side)
      {
        const double along = side == 0 ? -half_width : half_width;
        base_spacing[side] = ((surface(along) - dealii::Point<2>(p.y, p.z)) * base_direction) / along;
      }
  }


  dealii::Point<2> ProfileSection::surface(const double along) const
  {
    const double              on_profile = std::clamp(along, first, last), beyond = along - on_profile;
    const ProfileCurve::Place p    = profile.at(s_middle + on_profile);
    const double              size = std::hypot(p.dy, p.dz);
    return {p.y + beyond * p.dy / size, p.z + beyond * p.dz / size};
  }


  bool ProfileSection::is_above_base(const double along) const
  {
    constexpr double           least   = 0.4; // of the depth
    const dealii::Tensor<1, 2> inwards = (base_middle - surface(0.)) / depth;
    return (base_middle - surface(along)) * inwards >= least * depth;
  }


  dealii::Point<2> ProfileSection::point(const double along, const double behind) const
  {
    const double           share = behind / depth;
    const dealii::Point<2> top   = surface(along);
    return top + share * (base_middle + along * base_spacing[along > 0.] * base_direction - top);
  }


  Body make_profile_block(const ProfileBlock          &block,
                          const double                 coarsest,
                          const std::vector<FineZone> &zones)
  {
    const double          sign = block.mirrored ? -1. : 1.;
    std::vector<FineZone> charted(zones);
    double                begin = block.half_width, end = -block.half_width;
    for (FineZone &zone : charted)
      {
        zone.y_middle *= sign;
        begin = std::min(begin, zone.y_middle - zone.half_width);
        end   = std::max(end, zone.y_middle + zone.half_width);
      }
    FineZone all = charted.front();
    for (const FineZone &zone : charted)
      {
        all.x_begin = std::min(all.x_begin, zone.x_begin);
        all.x_end   = std::max(all.x_end, zone.x_end);
      }
    all.y_middle   = 0.5 * (begin + end);
    all.half_width = 0.5 * (end - begin);

    Body body = make_flat_box({block.x_begin, block.x_end, block.half_width, block.depth}, coarsest,
                              block.half_width, all);
    body.wanted_cell_size = [charted](const dealii::Point<3> &p) {
      double size = charted.front().wanted_size(p[0], p[1], -p[2]);
      for (const FineZone &zone : charted)
        size = std::min(size, zone.wanted_size(p[0], p[1], -p[2]));
      return size;
    };
    // Coarse facets would meet where the curved surfaces do not: a chord of the flange's root cuts into the
    // rail.
    std::vector<FineZone> present;
    for (const FineZone &zone : charted)
      present.push_back(zone.in_window());
    body.in_reach = [present](const dealii::Point<3> &p) {
      return std::any_of(present.begin(), present.end(), [&](const FineZone &zone) {
        const double reach = cells_beside_zone * zone.finest_cell_size;
        return std::abs(p[1] - zone.y_middle) < zone.half_width + reach && p[0] > zone.x_begin - reach &&
               p[0] < zone.x_end + reach;
      });
    };
    body.to_space = [sign, place = block.place](const dealii::Point<3> &p) {
      return place(p[0], sign * p[1], -p[2]);
    };
    return body;
  }
} // namespace tread
