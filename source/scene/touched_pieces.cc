// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/geometry/natural_spline.h>
#include <tread/scene/touched_pieces.h>
#include <tread/scene/wheelset_case.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace tread
{
  namespace
  {
    /// Without a name two patches belong to one piece if they are as near to each other across the rail, m.
    constexpr double same_piece = 10e-3;

    /// Contact without friction, which has the same place and size within a few per cent, on elements that
    /// suit the patches of the place before: some hundred, a sixth of what an answer takes.
    WheelContact contact_at(const Scene        &scene,
                            const WheelOnRail  &surfaces,
                            const double        axle,
                            const WheelContact &before)
    {
      WheelRolling rolling                        = wheel_rolling(scene, axle);
      static_cast<reference::Friction &>(rolling) = reference::Friction();
      rolling.friction_along                      = {};
      rolling.factor_across                       = {};
      for (const WheelPatch &patch : before.patches)
        {
          const reference::PlanarResult &r     = patch.solution;
          const auto                     finer = [](const double element, const double own) {
            return element > 0. ? std::min(element, own) : own;
          };
          rolling.element_x = finer(rolling.element_x, (r.x_end - r.x_begin) / 24.);
          rolling.element_y = finer(rolling.element_y, (r.y_end - r.y_begin) / 16.);
        }
      WheelsetPosition position = scene.position_at(axle);
      if (scene.guidance.kind == Guidance::file)
        {
          const Across now = scene.across((axle - scene.path_begin()) / scene.motion.speed);
          position.shift += now.y;
          position.yaw  = now.yaw;
          position.roll = now.roll;
        }
      try
        {
          return contact_under_load(surfaces, rolling, position, scene.static_load());
        }
      catch (const std::bad_alloc &)
        {
          throw; // no fault of the input
        }
      catch (const std::exception &error)
        {
          throw InputError(format("'Rail/Slices', at %.4g mm along them: ", 1e3 * position.along) +
                           error.what());
        }
    }

    TouchedPiece &piece_of(std::vector<TouchedPiece> &pieces, const WheelPatch &patch, const double apart)
    {
      const double y     = patch.region.reference[1];
      const auto   found = std::find_if(pieces.begin(), pieces.end(), [&](const TouchedPiece &piece) {
        return piece.body == patch.body &&
               (!patch.body.empty() ||
                std::abs(piece.touches.back().patch.region.reference[1] - y) < same_piece);
      });
      return found != pieces.end() ? *found : pieces.emplace_back(TouchedPiece{patch.body, {}, apart, {}});
    }
  } // namespace


  void TouchedPiece::fit_line()
  {
    line = {};
    for (const Touch &touch : touches)
      {
        line.x += touch.x() / touches.size();
        line.y += touch.patch.region.reference[1] / touches.size();
      }
    double xx = 0., xy = 0.;
    for (const Touch &touch : touches)
      {
        xx += std::pow(touch.x() - line.x, 2);
        xy += (touch.x() - line.x) * (touch.patch.region.reference[1] - line.y);
      }
    line.slope = xx > 0. ? xy / xx : 0.;
  }


  double TouchedPiece::inclination() const
  {
    double sum = 0.;
    for (const Touch &touch : touches)
      sum += touch.patch.angle();
    return sum / touches.size();
  }


  double TouchedPiece::y_low() const
  {
    double low = 1e300;
    for (const Touch &touch : touches)
      low = std::min(low, touch.patch.region.reference[1] +
                            std::cos(touch.patch.angle()) * touch.patch.solution.y_begin);
    return low;
  }


  double TouchedPiece::y_high() const
  {
    double high = -1e300;
    for (const Touch &touch : touches)
      high = std::max(high, touch.patch.region.reference[1] +
                              std::cos(touch.patch.angle()) * touch.patch.solution.y_end);
    return high;
  }


  namespace
  {
    /// The piece of the spline in which x lies, and the share of it up to there.
    std::pair<std::size_t, double> piece_at(const std::vector<double> &at, const double x)
    {
      const std::size_t i =
        std::clamp<std::ptrdiff_t>(std::upper_bound(at.begin(), at.end(), x) - at.begin() - 1, 0,
                                   static_cast<std::ptrdiff_t>(at.size()) - 2);
      return {i, (x - at[i]) / (at[i + 1] - at[i])};
    }
  } // namespace


  double WayOverSlices::slope(const double axle) const
  {
    const auto [i, share] = piece_at(axles, axle);
    return SplinePiece(axles[i + 1] - axles[i], share).slope(height[i], height[i + 1], bend[i], bend[i + 1]);
  }


  double WayOverSlices::curvature(const double axle) const
  {
    if (axle <= axles.front() || axle >= axles.back())
      return 0.;
    const auto [i, share] = piece_at(axles, axle);
    return (1. - share) * bend[i] + share * bend[i + 1];
  }


  WayOverSlices way_over_slices(const Scene &scene, const WheelOnRail &surfaces)
  {
    constexpr double   apart = 1e-3, least = 4., most = 60.; // m
    const double       length = scene.motion.meshed_distance();
    const unsigned int n      = std::ceil(std::clamp(length / apart, least, most));
    WayOverSlices      way;
    // The first place twice, so that it has elements as fine as the others.
    WheelContact contact = contact_at(scene, surfaces, scene.path_begin(), {});
    for (unsigned int i = 0; i <= n; ++i)
      {
        way.axles.push_back(scene.path_begin() + length * i / n);
        contact = contact_at(scene, surfaces, way.axles.back(), contact);
        way.height.push_back(contact.position.height);
        for (const WheelPatch &patch : contact.patches)
          piece_of(way.pieces, patch, length / n).touches.push_back({way.axles.back(), patch});
      }
    for (TouchedPiece &piece : way.pieces)
      piece.fit_line();
    way.bend = natural_spline(way.axles, way.height);
    std::sort(way.pieces.begin(), way.pieces.end(),
              [](const TouchedPiece &a, const TouchedPiece &b) { return a.y_low() < b.y_low(); });
    return way;
  }
} // namespace tread
