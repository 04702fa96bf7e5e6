// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/mesh/flat_box.h>
#include <tread/mesh/rail_body.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tread
{
  std::function<dealii::Point<3>(const dealii::Point<3> &)> shape_top(
    std::function<dealii::Point<3>(const dealii::Point<3> &)> to_space,
    const RailTop                                            &top,
    const double                                              depth)
  {
    if (!top.height && top.inclination == 0.)
      return to_space;
    return [to_space, top, depth, c = std::cos(top.inclination),
            s = std::sin(top.inclination)](const dealii::Point<3> &p) {
      dealii::Point<3> q = to_space(p);
      if (top.height && p[2] > -depth)
        q[2] += (1. + p[2] / depth) * top.height(p[0], to_space({p[0], p[1], 0.})[1]);
      return dealii::Point<3>(q[0], c * q[1] - s * q[2], s * q[1] + c * q[2]);
    };
  }

  Body make_rail_block(const RailBlock &block, const FineZones &zones)
  {
    if (!(block.crown_radius > 0.5 * block.width))
      throw std::invalid_argument("the block's crown radius must exceed half its width");
    if (!(block.height > -crown_height(0.5 * block.width, block.crown_radius)))
      throw std::invalid_argument("the block is lower than its crown's rise");

    Body body = make_flat_box({block.x_begin, block.x_end, 0.5 * block.width, block.height},
                              block.coarsest_cell_size, block.contact_half_width, zones);
    body.name = "rail block";
    // Down to some depth all lines keep the crown's shape, which leaves cells parallelepipeds (the cheapest
    // ones); below it they go over to the flat bottom.
    const double rise = -crown_height(0.5 * block.width, block.crown_radius);
    body.to_space     = shape_top(
      [radius = block.crown_radius, height = block.height,
       below = 0.5 * (block.height + rise)](const dealii::Point<3> &p) {
        return dealii::Point<3>(p[0], p[1],
                                p[2] + crown_height(p[1], radius) * std::min(1., (p[2] + height) / below));
      },
      block.top, block.height);
    return body;
  }

  Body make_rail_head(const RailProfile &profile, const RailHead &head, const FineZones &zones)
  {
    const double width  = profile.shoulder_length(); // half the width of the chart
    const double depth  = profile.head_depth();
    const double length = profile.head_length() - width; // of the chart's vertical sides

    Body body = make_flat_box({head.x_begin, head.x_end, width, depth}, head.coarsest_cell_size,
                              head.contact_half_width, zones);
    body.name = "rail head " + profile.name();

    // Straight lines from the top outline to points evenly spaced on the flat bottom, which at s = 0 is the
    // vertical itself; near the sides the curved side's deviation from the straight line is added. The weight
    // is zero with its slope up to the beginning of the ramp, beside the crown.
    const double ramp_begin = 0.3 * width;
    const auto   to_space   = [profile, width, depth, length, ramp_begin](const dealii::Point<3> &p) {
      const double s = std::abs(p[1]);
      const double v = std::clamp(-p[2] / depth, 0., 1.);

      const auto straight = [&](const double t) {
        const dealii::Point<2> top = profile.head_point(t);
        return dealii::Point<2>((1. - v) * top[0] + v * profile.head_half_width() * t / width,
                                (1. - v) * top[1] - v * depth);
      };

      dealii::Point<2> q = straight(s);
      if (s > ramp_begin)
        {
          const double ramp   = (s - ramp_begin) / (width - ramp_begin);
          const double weight = ramp * ramp;
          q += weight * (profile.head_point(width + v * length) - straight(width));
        }
      return dealii::Point<3>(p[0], std::copysign(q[0], p[1]), q[1]);
    };
    body.to_space = shape_top(to_space, head.top, depth);
    return body;
  }
} // namespace tread
