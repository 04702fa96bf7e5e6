// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/running_surfaces.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread
{
  double RunningSurfaces::gap(const double y) const
  {
    return -(tread_offset ? tread_offset(y) : 0.) - rail_top(y);
  }


  namespace
  {
    /// Height of the axle over the radius where a wheel that is not round touches, m.
    double lift_where_not_round(const RunningSurfaces &surfaces, const double center_x)
    {
      // A wheel is up to 20 mm from round; 0.14 m beside the axle it is as much above the rail.
      constexpr int along = 700, across = 300;
      double        lift = -1e300;
      for (int j = -along; j <= along; ++j)
        for (int i = -across; i <= across; ++i)
          {
            const double angle = 2e-4 * j / surfaces.radius, y = i / double(across) * surfaces.half_width;
            const double r    = surfaces.wheel_radius(angle, y);
            const double rail = surfaces.rail_top(y) +
                                (surfaces.defect ? surfaces.defect(center_x + r * std::sin(angle), y) : 0.);
            lift = std::max(lift, rail + r * std::cos(angle) - surfaces.radius);
          }
      return lift;
    }
  } // namespace


  FirstContact first_contact(const RunningSurfaces &surfaces, const double center_x)
  {
    // Steps of 10 um miss the top of a crown of 13 mm radius by 1e-9 m.
    const int    n    = static_cast<int>(surfaces.half_width / 1e-5);
    const double step = surfaces.half_width / n;
    FirstContact contact{0., 0., std::numeric_limits<double>::infinity()};
    double       least = surfaces.gap(0.);
    for (int i = 1; i <= n; ++i)
      for (const double y : {-i * step, i * step})
        // outwards only for what is more than round-off, so that the middle stays the middle
        if (const double gap = surfaces.gap(y); gap < least - 1e-10)
          {
            least     = gap;
            contact.y = y;
          }
    // and 100 times finer about it, for corners
    const double middle = contact.y;
    for (int i = -100; i <= 100; ++i)
      if (const double y = middle + 0.01 * i * step, gap = surfaces.gap(y); gap < least - 1e-10)
        {
          least     = gap;
          contact.y = y;
        }
    contact.lift = -least;

    if (surfaces.deviation)
      contact.lift = lift_where_not_round(surfaces, center_x);
    else if (surfaces.defect)
      {
        // Along the path the wheel rises by 1 mm in 30 mm.
        double highest = -1e300;
        for (int j = -150; j <= 150; ++j)
          for (int i = -300; i <= 300; ++i)
            {
              const double dx = 2e-4 * j, y = i / 300. * surfaces.half_width;
              const double r = surfaces.radius + (surfaces.tread_offset ? surfaces.tread_offset(y) : 0.);
              highest        = std::max(highest, surfaces.rail_top(y) + surfaces.defect(center_x + dx, y) +
                                                   std::sqrt(r * r - dx * dx) - surfaces.radius);
            }
        contact.lift = std::max(highest, contact.lift - 1e-3);
      }

    contact.lateral_radius = fitted_lateral_radius(surfaces, contact.y, 5e-3);
    return contact;
  }


  double fitted_lateral_radius(const RunningSurfaces &surfaces, const double y, const double half)
  {
    double sum = 0., weights = 0.;
    for (int i = 1; i <= 50; ++i)
      {
        const double d = half * i / 50.;
        sum += d * d * (surfaces.gap(y + d) + surfaces.gap(y - d) - 2. * surfaces.gap(y));
        weights += d * d * d * d;
      }
    return sum > 0. ? weights / sum : std::numeric_limits<double>::infinity();
  }


  double turned_line(const std::function<double(double)> &line, const double angle, const double y)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    double       own = y;
    for (unsigned int i = 0; i < 60; ++i)
      {
        const double next = (y + s * line(own)) / c;
        if (std::abs(next - own) < 1e-15)
          break;
        own = next;
      }
    return s * own + c * line(own);
  }
} // namespace tread
