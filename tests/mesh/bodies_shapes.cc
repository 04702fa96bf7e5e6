// SPDX-License-Identifier: LGPL-2.1-or-later
// Rails and wheels: refined by their own rule, then volume, surfaces, cell shapes and boundaries against the
// exact ones.
#include <tread/mesh/rail_body.h>
#include <tread/mesh/sleeper_body.h>
#include <tread/mesh/wheel_body.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/tria.h>

#include "check.h"
#include "refined_body.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>

using namespace tread;
using dealii::Point;
using dealii::Tensor;

namespace bodies_shapes
{
  using tests::Mesh;
  using tests::Measured;
  using tests::measure;
  using tests::off_surface;
  using tests::refine;
  using tests::shortest_edge;

  constexpr double pi = dealii::numbers::PI;

  void check_shape(tests::Check      &check,
                   const std::string &name,
                   const Mesh        &mesh,
                   const Measured    &m,
                   const double       volume,
                   const double       allowed)
  {
    unsigned int n_levels = mesh.n_levels();
    std::printf(
      "%s: %u cells (%u coarse, %u levels, %u in the fine zone), %u vertices, shortest edge %.4f mm, "
      "scaled Jacobian at vertices: lowest %.4f, in the fine zone %.5f\n",
      name.c_str(), m.n_cells, mesh.n_cells(0), n_levels, m.n_fine, mesh.n_used_vertices(),
      1e3 * m.shortest_edge, m.min_scaled, m.fine_scaled);
    check.relative(name + ": volume, cm3", 1e6 * m.volume, 1e6 * volume, allowed);
    check.that(name + ": Jacobians at vertices and Gauss points > 0", m.min_jacobian > 0.);
    check.that(name + ": cells in the fine zone", m.n_fine > 0);
    check.absolute(name + ": shortest fine edge over the asked", m.edge_low, 1., 0.02);
    check.absolute(name + ": longest fine edge over the asked", m.edge_high, 1., 0.02);
  }

  std::function<bool(const Point<3> &)> in_box(const FineZone &zone)
  {
    return [zone](const Point<3> &p) {
      return zone.distance(p[0], p[1], -p[2]) <= 0.;
    };
  }

  std::function<bool(const Point<3> &)> in_arc(const FineZone &zone,
                                               const double    center_x,
                                               const double    radius)
  {
    return [=](const Point<3> &p) {
      double angle = std::atan2(p[0] - center_x, radius - p[2]);
      while (angle * radius < zone.x_begin)
        angle += 2. * pi;
      return zone.distance(angle * radius, p[1], radius - std::hypot(p[0] - center_x, radius - p[2])) <= 0.;
    };
  }

  void check_rule(tests::Check &check)
  {
    FineZone zone;
    zone.finest_cell_size = 1e-3;
    zone.cells_per_level  = 3;
    check.absolute("rule: in the box, mm", 1e3 * zone.wanted_size(0.), 1., 1e-12);
    check.absolute("rule: beside the box, mm", 1e3 * zone.wanted_size(1e-6), 2., 1e-12);
    check.absolute("rule: before three cells of 2 mm, mm", 1e3 * zone.wanted_size(5.99e-3), 2., 1e-12);
    check.absolute("rule: behind three cells of 2 mm, mm", 1e3 * zone.wanted_size(6.01e-3), 4., 1e-12);
    check.absolute("rule: before three cells of 2 and 4 mm, mm", 1e3 * zone.wanted_size(17.99e-3), 4., 1e-12);
    check.absolute("rule: behind three cells of 2 and 4 mm, mm", 1e3 * zone.wanted_size(18.01e-3), 8., 1e-12);

    const auto lines = coarse_lines(-0.1, 0.1, 0., 0.0224); // 4.46 rows a side: three whole, one of 1.46
    check.that("lines: number", lines.size() == 9);
    check.absolute("lines: regular row, mm", 1e3 * (lines[5] - lines[4]), 22.4, 1e-9);
    check.absolute("lines: stretched row over regular", (lines[8] - lines[7]) / 0.0224, 0.1 / 0.0224 - 3.,
                   1e-9);
    check.below("lines: symmetric, mm", 1e3 * (lines[0] + lines[8]), 1e-12);
  }

  void check_block(tests::Check &check, const double finest, const double crown_radius)
  {
    RailBlock block;
    block.crown_radius = crown_radius;
    FineZone zone;
    zone.finest_cell_size = finest;
    zone.x_begin          = -0.045;
    zone.x_end            = 0.045;

    char name[40];
    std::snprintf(name, sizeof(name), "block %.2f mm, R %.0f mm", 1e3 * finest, 1e3 * crown_radius);

    const Body body = make_rail_block(block, zone);
    Mesh       mesh;
    refine(body, mesh);

    // every cell at least as far from the box as the rule says
    bool keeps_distance = true;
    for (const auto &cell : mesh.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        {
          const Point<3> p = cell->vertex(v);
          keeps_distance =
            keeps_distance && shortest_edge(cell) < 1.2001 * zone.wanted_size(p[0], p[1], -p[2]);
        }
    const Measured m = measure(body, mesh, finest, in_box(zone));

    double area = block.width * block.height; // minus the circular segment over the top's chord
    if (!std::isinf(crown_radius))
      {
        const double angle = std::asin(0.5 * block.width / crown_radius);
        area -=
          block.width * crown_radius - crown_radius * crown_radius * (angle + 0.5 * std::sin(2. * angle));
      }
    // What facets of coarse cells take from the crown, they take from the ends, too (below).
    check_shape(check, name, mesh, m, 0.5 * m.areas.at(3) * (block.x_end - block.x_begin), 1e-4);
    check.that(std::string(name) + ": cells per level kept", keeps_distance);
    check.below(std::string(name) + ": nodes off the crown, nm",
                1e9 * off_surface(mesh, Boundary::contact,
                                  [&](const Point<3> &p) { return p[2] - crown_height(p[1], crown_radius); }),
                1e-3);
    check.below(
      std::string(name) + ": nodes off the flat bottom, nm",
      1e9 * off_surface(mesh, Boundary::support, [&](const Point<3> &p) { return p[2] + block.height; }),
      1e-3);
    check.relative(std::string(name) + ": support area, cm2", 1e4 * m.areas.at(2), 1e4 * block.width * 0.24,
                   1e-9);
    check.relative(std::string(name) + ": end area, cm2", 1e4 * m.areas.at(3), 2e4 * area, 1.1e-3);
    check.below(std::string(name) + ": first moment in y, mm4", 1e12 * m.moment[1], 1e-3);
  }

  void check_head(tests::Check      &check,
                  const RailProfile &profile,
                  const double       finest,
                  const double       coarsest,
                  const double       allowed)
  {
    RailHead head;
    head.coarsest_cell_size = coarsest;
    FineZone zone;
    zone.finest_cell_size = finest;
    char name[60];
    std::snprintf(name, sizeof(name), "head %s, %.2f mm, coarse %.1f mm", profile.name().c_str(),
                  1e3 * finest, 1e3 * coarsest);

    const Body body = make_rail_head(profile, head, zone);
    Mesh       mesh;
    refine(body, mesh);
    const Measured m = measure(body, mesh, finest, in_box(zone));

    // area by the outline, trapezoids
    double             area = 2. * profile.head_half_width() * profile.head_depth();
    const unsigned int n    = 100000;
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto a = profile.head_point(profile.head_length() * i / n),
                   b = profile.head_point(profile.head_length() * (i + 1) / n);
        area += (a[1] + b[1]) * (b[0] - a[0]);
      }
    check_shape(check, name, mesh, m, 0.24 * area, allowed);
    check.that(std::string(name) + ": lowest scaled Jacobian above 0.25", m.min_scaled > 0.25);
    check.below(std::string(name) + ": nodes off the top, nm",
                1e9 * off_surface(mesh, Boundary::contact,
                                  [&](const Point<3> &p) { return p[2] - profile.z_top(p[1]); }),
                1e-3);
    check.relative(std::string(name) + ": support area, cm2", 1e4 * m.areas.at(2),
                   1e4 * 0.48 * profile.head_half_width(), 1e-9);
    check.relative(std::string(name) + ": end area, cm2", 1e4 * m.areas.at(3), 2e4 * area, 1.5 * allowed);
    check.below(std::string(name) + ": first moment in y, mm4", 1e12 * m.moment[1], 1e-3);
  }

  /// A rail that is laid at 1:20 has its foot beside its top, away from the gauge side.
  void check_inclination(tests::Check &check)
  {
    RailTop top;
    top.inclination  = std::atan(1. / 20.);
    const auto place = shape_top([](const Point<3> &p) { return p; }, top, 0.04);
    const auto foot = place(Point<3>(0.1, 0., -0.16)), gauge_side = place(Point<3>(0.1, -0.03, 0.));
    check.absolute("inclined rail: foot to the field side, mm", 1e3 * foot[1], 160. / std::hypot(20., 1.),
                   1e-9);
    check.absolute("inclined rail: gauge side of the top, lower by mm", -1e3 * gauge_side[2],
                   30. / std::hypot(20., 1.), 1e-9);
    check.absolute("inclined rail: nothing moves along, mm", 1e3 * foot[0], 100., 1e-12);

    // A defect lies where its place is in space, not in a chart that is half as wide.
    RailTop bumpy;
    bumpy.height = [](const double, const double y) {
      return 0.1 * y;
    };
    const auto of_defect =
      shape_top([](const Point<3> &p) { return Point<3>(p[0], 2. * p[1], p[2]); }, bumpy, 0.04);
    check.absolute("height of a defect at 20 mm beside the middle, mm",
                   1e3 * of_defect(Point<3>(0., 0.01, 0.))[2], 2., 1e-12);
  }

  /// Half a sleeper: it rests on its bottom and is cut in the middle of the track.
  void check_sleeper(tests::Check &check)
  {
    SleeperBox box;
    box.x           = 0.6;
    box.y_begin     = -0.7;
    box.height      = 0.2;
    const Body body = make_sleeper(box);
    Mesh       mesh;
    refine(body, mesh);
    const double length = box.y_end - box.y_begin, volume = length * box.width * box.height;
    check.that("sleeper: edges no longer than asked",
               tests::largest_edge(mesh.begin_active()) < box.coarsest_cell_size * (1. + 1e-9));
    Measured m = measure(body, mesh, box.coarsest_cell_size, [](const Point<3> &) { return true; });
    check.relative("sleeper: volume, dm3", 1e3 * m.volume, 1e3 * volume, 1e-12);
    const Point<3> middle(box.x, 0.5 * (box.y_begin + box.y_end), box.top - 0.5 * box.height);
    check.below("sleeper: centre of gravity off its place, mm", 1e3 * (m.moment / m.volume - middle).norm(),
                1e-9);
    const auto area = [&](const Boundary boundary) {
      return 1e4 * m.areas[static_cast<int>(boundary)];
    };
    check.relative("sleeper: bottom, cm2", area(Boundary::support), 1e4 * length * box.width, 1e-12);
    check.relative("sleeper: cut, cm2", area(Boundary::end), 1e4 * box.width * box.height, 1e-12);
    check.below("sleeper: nodes off the bottom, nm",
                1e9 * off_surface(mesh, Boundary::support,
                                  [&](const Point<3> &p) { return p[2] - box.top + box.height; }),
                1e-3);
    check.below("sleeper: nodes off the cut, nm",
                1e9 * off_surface(mesh, Boundary::end, [&](const Point<3> &p) { return p[1] - box.y_begin; }),
                1e-3);
  }

  void check_sector(tests::Check &check, const double finest, const bool conical)
  {
    WheelSector sector;
    sector.center_x  = -0.09;
    sector.arc_begin = -0.09;
    sector.arc_end   = 0.18;
    if (conical)
      sector.tread_offset = [](const double y) {
        return -y / 40.;
      };
    FineZone zone;
    zone.finest_cell_size = finest;
    zone.x_begin          = -0.01;
    zone.x_end            = 0.1;

    char name[40];
    std::snprintf(name, sizeof(name), "%s sector %.2f mm", conical ? "conical" : "cylindrical", 1e3 * finest);
    const Body body = make_wheel_sector(sector, zone);
    Mesh       mesh;
    refine(body, mesh);
    const Measured m     = measure(body, mesh, finest, in_arc(zone, sector.center_x, sector.radius));
    const auto     exact = wheel_inertia(sector, 1.);

    check_shape(check, name, mesh, m, exact.mass, 1e-3);
    const auto from_axis = [&](const Point<3> &p) {
      return std::hypot(p[0] - sector.center_x, p[2] - sector.radius);
    };
    check.below(std::string(name) + ": nodes off the tread, nm",
                1e9 * off_surface(mesh, Boundary::contact,
                                  [&](const Point<3> &p) {
                                    return from_axis(p) - sector.radius -
                                           (conical ? sector.tread_offset(p[1]) : 0.);
                                  }),
                1e-3);
    check.below(std::string(name) + ": nodes off the inner face, nm",
                1e9 *
                  off_surface(mesh, Boundary::support, [&](const Point<3> &p) { return from_axis(p) - 0.4; }),
                1e-3);
    check.relative(std::string(name) + ": support area, cm2", 1e4 * m.areas.at(2),
                   1e4 * 0.27 / 0.46 * 0.4 * 0.12, 1e-3);
    check.relative(std::string(name) + ": contact area, cm2", 1e4 * m.areas.at(1), 1e4 * 0.27 * 0.12, 1e-3);
    check.relative(std::string(name) + ": end area, cm2", 1e4 * m.areas.at(3), 1e4 * 2. * 0.06 * 0.12, 1e-3);
    // the mesh's first moment, moved to the wheel's centre
    const Tensor<1, 3> moment = m.moment - m.volume * Point<3>(sector.center_x, 0., sector.radius);
    check.below(std::string(name) + ": first moment, relative error",
                (moment - exact.first_moment).norm() / exact.first_moment.norm(), 2e-3);
    double lowest = 1e300;
    for (const auto &p : mesh.get_vertices())
      lowest = std::min(lowest, p[2]);
    if (!conical)
      check.below(std::string(name) + ": lowest point, nm", 1e9 * lowest, 1e-3);
  }

  /// A sector of a whole turn: a ring without ends, fine where it is lowest, the shorter way around.
  void check_ring(tests::Check &check)
  {
    WheelSector ring;
    ring.center_x  = 0.2;
    ring.arc_begin = -pi * ring.radius;
    ring.arc_end   = pi * ring.radius;
    FineZone zone;
    zone.finest_cell_size = 1e-3;
    zone.x_begin          = pi * ring.radius - 0.04; // across the angle's jump
    zone.x_end            = pi * ring.radius + 0.06;
    const Body body       = make_wheel_sector(ring, zone);
    Mesh       mesh;
    refine(body, mesh);
    const Measured m = measure(body, mesh, zone.finest_cell_size, in_arc(zone, ring.center_x, ring.radius));
    const auto     exact = wheel_inertia(ring, 1.);
    check_shape(check, "ring", mesh, m, exact.mass, 1e-3);
    check.relative("ring: contact area, cm2", 1e4 * m.areas.at(1), 1e4 * 2. * pi * 0.46 * 0.12, 1e-3);
    check.relative("ring: support area, cm2", 1e4 * m.areas.at(2), 1e4 * 2. * pi * 0.4 * 0.12, 1e-3);
    check.that("ring: no ends", m.areas.count(3) == 0);
    check.below("ring: its middle is the axle, mm",
                1e3 * (m.moment / m.volume - Point<3>(ring.center_x, 0., ring.radius)).norm(), 1e-2);
  }

  void check_flat(tests::Check &check)
  {
    WheelSector sector;
    sector.center_x     = 0.3;
    sector.lift         = 1e-3;
    sector.arc_begin    = -0.05;
    sector.arc_end      = 0.15;
    sector.tread_offset = [](const double y) {
      return -y / 20.;
    };
    // Ahead of the lowest point and deeper at one side.
    sector.deviation = [](const double angle, const double y) {
      return -1e-3 * (1. + y / 0.1) * std::exp(-std::pow((angle - 0.1) / 0.03, 2.));
    };
    FineZone zone;
    zone.finest_cell_size = 4e-3;
    zone.x_begin          = -0.01;
    zone.x_end            = 0.1;
    const Body body       = make_wheel_sector(sector, zone);
    Mesh       mesh;
    refine(body, mesh);
    measure(body, mesh, zone.finest_cell_size, [](const Point<3> &) { return true; });
    check.below("sector with a flat: nodes off the tread, nm",
                1e9 * off_surface(mesh, Boundary::contact,
                                  [&](const Point<3> &p) {
                                    const double up    = sector.radius + sector.lift - p[2],
                                                 angle = std::atan2(p[0] - sector.center_x, up);
                                    return std::hypot(p[0] - sector.center_x, up) - sector.radius -
                                           sector.tread_offset(p[1]) - sector.deviation(angle, p[1]);
                                  }),
                1e-3);
  }

  void check_wheel(tests::Check &check, const double finest, const double coarsest, const double zone_center)
  {
    FullWheel wheel;
    wheel.center_x           = -0.09;
    wheel.coarsest_cell_size = coarsest;
    FineZone zone;
    zone.finest_cell_size = finest;
    zone.x_begin          = zone_center - 0.05;
    zone.x_end            = zone_center + 0.05;

    char name[60];
    std::snprintf(name, sizeof(name), "wheel %.2f mm, coarse %.0f mm, zone %.2f m", 1e3 * finest,
                  1e3 * coarsest, zone_center);
    const Body body = make_full_wheel(wheel, zone);
    Mesh       mesh;
    refine(body, mesh);
    const Measured m     = measure(body, mesh, finest, in_arc(zone, wheel.center_x, wheel.radius));
    const auto     exact = wheel_inertia(wheel, 1.);

    check_shape(check, name, mesh, m, exact.mass, 3e-3);
    const auto from_axis = [&](const Point<3> &p) {
      return std::hypot(p[0] - wheel.center_x, p[2] - wheel.radius);
    };
    check.below(std::string(name) + ": nodes off the tread, nm",
                1e9 * off_surface(mesh, Boundary::contact,
                                  [&](const Point<3> &p) { return from_axis(p) - wheel.radius; }),
                1e-3);
    check.below(std::string(name) + ": nodes off the bore, nm",
                1e9 * off_surface(mesh, Boundary::support,
                                  [&](const Point<3> &p) { return from_axis(p) - wheel.bore_radius; }),
                1e-3);
    check.relative(std::string(name) + ": bore area, cm2", 1e4 * m.areas.at(2),
                   1e4 * 2. * pi * wheel.bore_radius * wheel.hub_length, 2e-3);
    check.that(std::string(name) + ": contact area covers the path and not much more",
               m.areas.at(1) > 0.1 * wheel.rim_width &&
                 m.areas.at(1) < (0.1 + 2. * 0.02 + 3. * coarsest) * wheel.rim_width);
    check.that(std::string(name) + ": no cut faces", m.areas.count(3) == 0);
    check.below(std::string(name) + ": centre of gravity off the axis, mm",
                1e3 * (m.moment / m.volume - Point<3>(wheel.center_x, 0., wheel.radius)).norm(), 0.1);
  }
} // namespace bodies_shapes

TREAD_TEST(bodies_shapes)(tests::Check &check, const tests::Arguments &)
{
  const auto start = std::chrono::steady_clock::now();
  const auto lap   = [&] {
    std::printf("-- %.1f s\n",
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  };

  check_rule(check);
  check_inclination(check);
  check_sleeper(check);
  check_block(check, 0.63e-3, 0.3);
  check_block(check, 0.63e-3, std::numeric_limits<double>::infinity());
  lap();
  check_block(check, 0.33e-3, 0.3);
  lap();
  // chords of the gauge corner's arc (R13) cut off a share that falls with the square of the coarse size
  check_head(check, RailProfile::rail_54e1(), 1e-3, 0.0125, 1e-2);
  check_head(check, RailProfile::rail_54e1(), 1e-3, 0.0045, 2.5e-3);
  check_head(check, RailProfile::rail_60e1(), 0.7e-3, 0.0125, 1e-2);
  lap();
  check_sector(check, 0.63e-3, false);
  check_sector(check, 1e-3, true);
  lap();
  check_ring(check);
  check_flat(check);
  check_wheel(check, 0.63e-3, 0.041, 0.04);
  check_wheel(check, 1e-3, 0.021, 0.);
  check_wheel(check, 1e-3, 0.041, pi * 0.46); // half a turn away, where the angle jumps
  lap();

  // The full wheel of 920 mm: 341 kg and 46 kg m^2 with a flange of 640 mm2 at r = 472 mm.
  const auto   inertia = wheel_inertia(FullWheel(), 7800.);
  const double flange  = 7800. * 640e-6 * 2. * pi * 0.472;
  check.relative("full wheel with flange, kg", inertia.mass + flange, 341., 3e-3);
  check.relative("full wheel with flange, kg m2", inertia.axial_inertia + flange * 0.472 * 0.472, 46., 1e-2);
  FullWheel heavy; // heavier rim and web, no flange
  heavy.rim_inner_radius = 0.38;
  heavy.web_thickness    = 0.0523;
  check.relative("wheel of 431 kg, kg", wheel_inertia(heavy, 7800.).mass, 431., 1e-3);
  check.relative("wheel of 431 kg, kg m2", wheel_inertia(heavy, 7800.).axial_inertia, 53.4, 2e-3);
  WheelSector half_ring;
  half_ring.arc_begin = -0.5 * pi * half_ring.radius;
  half_ring.arc_end   = 0.5 * pi * half_ring.radius;
  const auto ring     = wheel_inertia(half_ring, 7800.);
  check.relative("half ring, kg", ring.mass, 7800. * 0.5 * pi * (0.46 * 0.46 - 0.16) * 0.12, 1e-12);
  check.relative("half ring, kg m2", ring.axial_inertia, 0.5 * ring.mass * (0.46 * 0.46 + 0.16), 1e-12);
  check.relative("half ring, first moment in z, kg m", ring.first_moment[2],
                 -7800. * 2. / 3. * (std::pow(0.46, 3) - 0.064) * 0.12, 1e-12);

  // The cell size does not notice where the angle jumps.
  FineZone behind;
  behind.x_begin     = pi * 0.46 - 0.03;
  behind.x_end       = pi * 0.46 + 0.05;
  const Body around  = make_full_wheel(FullWheel(), behind);
  const auto size_at = [&](const double arc) {
    return around.wanted_cell_size(
      Point<3>(0.46 * std::sin(arc / 0.46), 0., 0.46 - 0.46 * std::cos(arc / 0.46)));
  };
  check.absolute("wheel: size on both sides of the jump, mm", 1e3 * size_at(pi * 0.46 - 1e-6),
                 1e3 * size_at(pi * 0.46 + 1e-6), 1e-12);
  check.absolute("wheel: size at the zone's end, mm", 1e3 * size_at(pi * 0.46 + 0.0499), 1., 1e-12);
  check.absolute("wheel: size just behind the zone, mm", 1e3 * size_at(pi * 0.46 + 0.0501), 2., 1e-12);
  check.absolute("wheel: size just before the zone, mm", 1e3 * size_at(pi * 0.46 - 0.0301), 2., 1e-12);
  check.that("wheel: coarse at the opposite end", size_at(0.) > 0.1);

  // Where only a part of the path is fine, that part is fine and no other.
  FineZone partly;
  partly.x_begin     = -0.01;
  partly.x_end       = 0.2;
  partly.path_level  = 2;
  partly.cubes_begin = 0.02;
  partly.cubes_end   = 0.05;
  for (const auto &[name, body] : {std::pair("sector", make_wheel_sector(half_ring, partly)),
                                   std::pair("wheel", make_full_wheel(FullWheel(), partly))})
    for (const auto &[arc, cells] :
         {std::pair(0.015, 4.), std::pair(0.0195, 2.), std::pair(0.0205, 1.), std::pair(0.035, 1.),
          std::pair(0.0495, 1.), std::pair(0.0505, 2.), std::pair(0.06, 4.), std::pair(0.12, 4.)})
      {
        const double angle = arc / 0.46, r = 0.46 - 1e-6;
        check.relative(std::string(name) + ": size " + std::to_string(1e3 * arc) +
                         " mm along its path, finest cells",
                       body.wanted_cell_size(Point<3>(r * std::sin(angle), 0., 0.46 - r * std::cos(angle))) /
                         partly.finest_cell_size,
                       cells, 1e-12);
      }

  // Impossible requests are refused.
  const auto refused = [](const auto &make) {
    return !tests::complaint<std::invalid_argument>(make).empty();
  };
  FineZone too_long;
  too_long.x_end = 0.5;
  check.that("a zone beyond the block's end is refused",
             refused([&] { make_rail_block(RailBlock(), too_long); }));
  check.that("a zone beyond the sector's end is refused",
             refused([&] { make_wheel_sector(WheelSector(), too_long); }));
  FullWheel inside_out;
  inside_out.bore_radius = 0.2;
  check.that("a bore wider than the hub is refused",
             refused([&] { make_full_wheel(inside_out, FineZone()); }));
  lap();
}
