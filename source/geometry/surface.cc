// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/surface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tread
{
  std::optional<OnSection> highest_over(const std::vector<ProfileCurve> &sections, const double y)
  {
    std::optional<OnSection> best;
    for (const ProfileCurve &curve : sections)
      {
        const std::vector<double>           &knots  = curve.knots();
        const std::vector<dealii::Point<2>> &points = curve.points_at_knots();
        for (std::size_t i = 0; i + 1 < knots.size(); ++i)
          {
            const double before = points[i][0], next = points[i + 1][0];
            if ((before - y) * (next - y) <= 0. && before != next)
              {
                double     low = knots[i], high = knots[i + 1];
                const bool rises = next > before;
                double     s     = 0.5 * (low + high);
                for (unsigned int k = 0; k < 60; ++k)
                  {
                    const ProfileCurve::Place p = curve.at(s);
                    if (std::abs(p.y - y) < 1e-15)
                      break;
                    ((p.y < y) == rises ? low : high) = s;
                    const double newton               = s - (p.y - y) / p.dy;
                    s = newton > low && newton < high ? newton : 0.5 * (low + high);
                  }
                const ProfileCurve::Place p = curve.at(s);
                if (!best || p.z > best->z)
                  best = OnSection{static_cast<std::size_t>(&curve - sections.data()), s, p.z, p.dz / p.dy};
              }
          }
      }
    return best;
  }


  std::vector<std::string> Surface::doubts() const
  {
    return {};
  }


  std::optional<Surface::Height> Surface::height(const double along, const double y) const
  {
    const std::optional<OnSection> here = highest_over(sections(along), y);
    if (!here)
      return {};
    Height height{here->z, 0., here->slope};
    if (is_constant())
      return height;
    // A surface that ends here has a derivative to the other side.
    constexpr double               step   = 1e-6; // m or rad
    const std::optional<OnSection> before = highest_over(sections(along - step), y),
                                   behind = highest_over(sections(along + step), y);
    if (before && behind)
      height.by_along = (behind->z - before->z) / (2. * step);
    else if (before || behind)
      height.by_along = before ? (here->z - before->z) / step : (behind->z - here->z) / step;
    return height;
  }


  std::string Surface::body(const double, const double) const
  {
    return "";
  }


  PrismSurface::PrismSurface(const ProfileCurve &profile)
    : profile(profile)
  {
  }


  std::string PrismSurface::in_words() const
  {
    return "one profile along the rail";
  }


  Surface::Extent PrismSurface::extent() const
  {
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    return {-everywhere, everywhere, profile.at(0.).y, profile.at(profile.length()).y};
  }


  bool PrismSurface::is_constant() const
  {
    return true;
  }


  std::vector<ProfileCurve> PrismSurface::sections(const double) const
  {
    return {profile};
  }


  WheelSurface::WheelSurface(const ProfileCurve &profile, std::shared_ptr<const WheelDeviation> deviation)
    : round(profile)
    , more(std::move(deviation))
  {
  }


  std::string WheelSurface::in_words() const
  {
    return more ? "a wheel with " + more->in_words() : "a round wheel";
  }


  Surface::Extent WheelSurface::extent() const
  {
    return {-std::numbers::pi, std::numbers::pi, round.at(0.).y, round.at(round.length()).y};
  }


  bool WheelSurface::is_constant() const
  {
    return !more;
  }


  std::vector<ProfileCurve> WheelSurface::sections(const double along) const
  {
    if (!more)
      return {round};
    std::vector<dealii::Point<2>> points;
    for (const double s : round.knots())
      {
        const ProfileCurve::Place p = round.at(s);
        points.emplace_back(p.y, p.z - more->at(along, p.y).dz);
      }
    return {ProfileCurve(points)};
  }
} // namespace tread
