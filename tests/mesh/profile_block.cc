// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks behind a piece of a profile, as a wheelset in any position has them: volume, surface, cell shapes,
// where they can touch, and how far a profile may turn away.
#include <tread/mesh/profile_block.h>

#include "check.h"
#include "refined_body.h"

#include <cmath>
#include <string>
#include <tuple>

using namespace tread;
using dealii::Point;

namespace mesh_profile_block
{
  constexpr double radius = 20e-3, half_width = 20e-3, depth = 30e-3, finest = 1e-3; // m

  /// An arc of 172 degrees, its middle at the origin. @param bends 1: as the crown of a rail, -1: as a throat
  ProfileCurve arc(const double bends)
  {
    std::vector<Point<2>> points;
    for (double angle = -86.; angle <= 86.; angle += 0.25)
      {
        const double a = angle * dealii::numbers::PI / 180.;
        points.emplace_back(radius * std::sin(a), bends * radius * (std::cos(a) - 1.));
      }
    return ProfileCurve(points);
  }

  /// Two zones side by side, the second beside the middle.
  std::vector<FineZone> zones()
  {
    FineZone first;
    first.finest_cell_size = finest;
    first.x_begin          = -8e-3;
    first.x_end            = 8e-3;
    first.y_middle         = -9e-3;
    first.half_width       = 2e-3;
    first.depth            = 2e-3;
    FineZone second        = first;
    second.y_middle        = 6e-3;
    second.half_width      = 4e-3;
    return {first, second};
  }

  /// Area of a section and its first moment in z, by the outline: surface, ends, base (m2, m3).
  std::pair<double, double> area_of(const ProfileSection &section)
  {
    std::vector<Point<2>> outline;
    const int             n = 4000;
    for (int i = 0; i <= n; ++i)
      outline.push_back(section.point(half_width * (2. * i / n - 1.), 0.));
    outline.push_back(section.point(half_width, depth));
    outline.push_back(section.point(-half_width, depth));
    double area = 0., moment = 0.;
    for (std::size_t i = 0; i < outline.size(); ++i)
      {
        const Point<2> &a = outline[i], &b = outline[(i + 1) % outline.size()];
        const double    twice = a[0] * b[1] - b[0] * a[1];
        area += 0.5 * twice;
        moment += (a[1] + b[1]) * twice / 6.;
      }
    return {std::abs(area), area < 0. ? -moment : moment};
  }

  void check_rail(tests::Check &check, const double inclination)
  {
    const std::string    name    = "rail, base at " + std::to_string(inclination) + ": ";
    const ProfileCurve   profile = arc(1.);
    const ProfileSection section(profile, 0.5 * profile.length() - radius * inclination, inclination,
                                 ProfileSection::Side::below, depth, half_width);
    const Body           body =
      make_profile_block({-0.03, 0.03, section.half_width, section.depth, false,
                          [&section](const double x, const double along, const double behind) {
                            const Point<2> p = section.point(along, behind);
                            return Point<3>(x, p[0], p[1]);
                          }},
                         0.01, zones());
    tests::Mesh mesh;
    tests::refine(body, mesh);
    const tests::Measured m = tests::measure(body, mesh, finest, [](const Point<3> &p) {
      return zones()[0].distance(p[0], p[1], -p[2]) <= 0. || zones()[1].distance(p[0], p[1], -p[2]) <= 0.;
    });
    std::printf("%s%u cells, %u fine, Jacobian %.3f of the volume, scaled %.3f, fine %.3f\n", name.c_str(),
                m.n_cells, m.n_fine, m.min_jacobian, m.min_scaled, m.fine_scaled);
    check.that(name + "Jacobians at vertices and Gauss points > 0", m.min_jacobian > 0.);
    check.that(name + "cells in the fine zones", m.n_fine >= 16 * 12 * 2);
    check.relative(name + "volume, cm3", 1e6 * m.volume, 6e4 * area_of(section).first, 3e-3);
    check.below(name + "shortest fine edge over the asked, less 1", std::min(0., m.edge_low - 1.), 0.15);
    check.below(name + "longest fine edge over the asked, less 1", std::max(0., m.edge_high - 1.), 1e-9);
    const auto off_arc = [&](const Point<3> &p) {
      return std::hypot(p[1], p[2] + radius) - radius;
    };
    check.below(name + "nodes off the profile, nm",
                1e9 * tests::off_surface(mesh, Boundary::contact, off_arc), 1e-3);
    // The lines behind both ends and the middle are at right angles to the base.
    const auto behind = [&](const double along) {
      return section.point(along, depth) - section.point(along, 0.);
    };
    const Point<2> middle(behind(0.));
    for (const double end : {-half_width, half_width})
      check.below(name + "line behind the end at " + std::to_string(1e3 * end) + " mm off the middle's, rad",
                  std::atan2(middle[0] * behind(end)[1] - middle[1] * behind(end)[0], middle * behind(end)),
                  1e-9);
    check.relative(name + "base, cm2", 1e4 * m.areas.at(2),
                   600. * section.point(half_width, depth).distance(section.point(-half_width, depth)), 1e-9);
    // A little beside the zones, along the path too, and not between them.
    for (const auto &[x, y, reached] :
         {std::tuple(0., -9e-3, true), std::tuple(0., -11.9e-3 - 3e-3, true),
          std::tuple(0., -9e-3 - 6.1e-3, false), std::tuple(7e-3, 10e-3, true),
          std::tuple(11.9e-3, 6e-3, true), std::tuple(-12.1e-3, 6e-3, false), std::tuple(0., 14.1e-3, false)})
      check.that(name + "reach of the other body at " + std::to_string(1e3 * x) + ", " +
                   std::to_string(1e3 * y) + " mm",
                 body.in_reach(Point<3>(x, y, 0.)) == reached);
  }

  void check_wheel(tests::Check &check)
  {
    constexpr double     nominal = 0.46;
    const ProfileCurve   profile = arc(-1.);
    const ProfileSection section(profile, 0.5 * profile.length() - 5e-3, -0.25, ProfileSection::Side::above,
                                 depth, half_width);
    const double         begin = -0.03, end = 0.05;
    const Body           body =
      make_profile_block({begin, end, section.half_width, section.depth, true,
                          [&section](const double arc_length, const double along, const double behind) {
                            const Point<2> p     = section.point(along, behind);
                            const double   angle = arc_length / nominal, r = nominal - p[1];
                            return Point<3>(r * std::sin(angle), p[0], nominal - r * std::cos(angle));
                          }},
                         0.01, zones());
    tests::Mesh mesh;
    tests::refine(body, mesh);
    const tests::Measured m = tests::measure(
      body, mesh, finest, [](const Point<3> &p) { return zones()[1].distance(p[0], -p[1], -p[2]) <= 0.; });
    check.that("wheel: Jacobians at vertices and Gauss points > 0", m.min_jacobian > 0.);
    check.that("wheel: cells in the fine zone", m.n_fine >= 16 * 8 * 2);
    const auto [area, moment] = area_of(section);
    check.relative("wheel: volume (Pappus), cm3", 1e6 * m.volume,
                   1e6 * (end - begin) / nominal * (nominal * area - moment), 3e-3);
    const auto off_arc = [&](const Point<3> &p) {
      const double r = std::hypot(p[0], p[2] - nominal);
      return std::hypot(p[1], nominal - r - radius) - radius;
    };
    check.below("wheel: nodes off the profile, nm",
                1e9 * tests::off_surface(mesh, Boundary::contact, off_arc), 1e-3);
  }
} // namespace mesh_profile_block

TREAD_TEST(mesh_profile_block)(tests::Check &check, const tests::Arguments &)
{
  check_rail(check, 0.);
  check_rail(check, 0.4);
  check_wheel(check);

  // 70 degrees from the base's direction the profile ends, and goes on straight.
  const ProfileCurve   profile = arc(1.);
  const ProfileSection wide(profile, 0.5 * profile.length(), 0., ProfileSection::Side::below, 60e-3, 40e-3);
  const double         largest = radius * std::acos(0.34);
  check.absolute("profile used up to, mm", 1e3 * wide.end(), 1e3 * largest, 0.11);
  check.absolute("profile used from, mm", 1e3 * wide.begin(), -1e3 * largest, 0.11);
  const Point<2> a = wide.point(30e-3, 0.), b = wide.point(35e-3, 0.), c = wide.point(40e-3, 0.);
  check.below("straight beyond, nm", 1e9 * (a + (c - a) / 2.).distance(b), 1e-3);
  check.that("a base at right angles to the profile is refused",
             !tests::complaint<std::invalid_argument>([&] {
                ProfileSection(profile, 0.5 * profile.length(), 1.3, ProfileSection::Side::below, depth,
                               half_width);
              }).empty());
}
