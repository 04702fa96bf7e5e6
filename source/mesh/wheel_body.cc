// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/mesh/wheel_body.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/manifold_lib.h>

#include "even_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace tread
{
  namespace
  {
    constexpr double pi = dealii::numbers::PI;

    /// Cylinder coordinates about the wheel's axis: angle from the lowest point, positive towards +x; radius.
    struct WheelAxis
    {
      double center_x;
      double height;

      double angle(const dealii::Point<3> &p) const
      {
        return std::atan2(p[0] - center_x, height - p[2]);
      }
      double radius(const dealii::Point<3> &p) const
      {
        return std::hypot(p[0] - center_x, height - p[2]);
      }
      dealii::Point<3> point(const double angle, const double y, const double radius) const
      {
        return {center_x + radius * std::sin(angle), y, height - radius * std::cos(angle)};
      }
      std::shared_ptr<const dealii::Manifold<3>> manifold() const
      {
        return std::make_shared<dealii::CylindricalManifold<3>>(dealii::Tensor<1, 3>({0., 1., 0.}),
                                                                dealii::Point<3>(center_x, 0., height));
      }
    };

    /// Angle in (-pi, pi] that differs from the given one by whole turns.
    double wrap(const double angle)
    {
      return std::remainder(angle, 2. * pi);
    }

    /// wanted_cell_size around the axis. The box, and the cubes in it, are moved to arc lengths symmetric to
    /// zero, so that the shorter way around counts; distances along the arc are those at the point's own
    /// radius.
    std::function<double(const dealii::Point<3> &)> cell_size_around(const WheelAxis &axis,
                                                                     const double     radius,
                                                                     const FineZone  &whole)
    {
      const FineZone zone   = whole.in_window();
      const double   center = 0.5 * (zone.x_begin + zone.x_end) / radius;
      const double   half   = 0.5 * (zone.x_end - zone.x_begin) / radius;
      return [axis, radius, zone, center, half](const dealii::Point<3> &p) {
        const double r     = axis.radius(p);
        FineZone     local = zone;
        local.x_begin      = -half * r;
        local.x_end        = half * r;
        local.cubes_begin  = (zone.cubes_begin / radius - center) * r;
        local.cubes_end    = (zone.cubes_end / radius - center) * r;
        return local.wanted_size(wrap(axis.angle(p) - center) * r, p[1], radius - r);
      };
    }

    /// Stretch of the row in which a point lies.
    std::function<double(const dealii::Point<3> &)> stretch_around(const WheelAxis &axis,
                                                                   const double     radius,
                                                                   const PathLines &path)
    {
      return [axis, radius, path,
              middle = 0.5 * (path.lines.front() + path.lines.back()) / radius](const dealii::Point<3> &p) {
        return std::max(1., path.stretch((middle + wrap(axis.angle(p) - middle)) * radius));
      };
    }

    /// Moves the points of the rim outwards by the tread's offset and what it is not round by, fading to zero
    /// at the inner radius; null where there is neither.
    template <typename Wheel>
    std::function<dealii::Point<3>(const dealii::Point<3> &)> shape_tread(const WheelAxis &axis,
                                                                          const Wheel     &wheel,
                                                                          const double     inner_radius)
    {
      if (!wheel.tread_offset && !wheel.deviation)
        return nullptr;
      return [axis, radius = wheel.radius, inner_radius, offset = wheel.tread_offset,
              deviation = wheel.deviation](const dealii::Point<3> &p) {
        const double r = axis.radius(p);
        if (r <= inner_radius)
          return p;
        const double more  = (offset ? offset(p[1]) : 0.) + (deviation ? deviation(axis.angle(p), p[1]) : 0.);
        const double scale = more * (r - inner_radius) / ((radius - inner_radius) * r);
        const dealii::Point<3> foot(axis.center_x, p[1], axis.height);
        return foot + (1. + scale) * (p - foot);
      };
    }

    /// Quadrilaterals of the wheel's section in (y, r), vertices in the order of (y, decreasing r).
    class Section
    {
    public:
      unsigned int vertex(const double y, const double r)
      {
        const auto key             = std::make_pair(std::lround(y * 1e9), std::lround(r * 1e9));
        const auto [place, is_new] = numbers.try_emplace(key, vertices.size());
        if (is_new)
          vertices.push_back({{y, r}});
        return place->second;
      }

      /// The cells between two rows of equally many points; the outer row has the larger radius.
      void add_row(const std::vector<double> &outer_y,
                   const double               outer_r,
                   const std::vector<double> &inner_y,
                   const double               inner_r)
      {
        for (unsigned int j = 0; j + 1 < outer_y.size(); ++j)
          cells.push_back({{vertex(outer_y[j], outer_r), vertex(outer_y[j + 1], outer_r),
                            vertex(inner_y[j], inner_r), vertex(inner_y[j + 1], inner_r)}});
      }

      std::vector<std::array<double, 2>>       vertices;
      std::vector<std::array<unsigned int, 4>> cells;

    private:
      std::map<std::pair<long, long>, unsigned int> numbers;
    };

    /// Turns the section about the axis: one layer of cells between each two angles.
    void revolve(const Section             &section,
                 const WheelAxis           &axis,
                 const std::vector<double> &angles,
                 const bool                 closed,
                 Body                      &body)
    {
      const unsigned int n_section = section.vertices.size();
      for (const double angle : angles)
        for (const auto &[y, r] : section.vertices)
          body.vertices.push_back(axis.point(angle, y, r));

      const unsigned int n_layers = angles.size() - (closed ? 0 : 1);
      for (unsigned int i = 0; i < n_layers; ++i)
        for (const auto &quadrilateral : section.cells)
          {
            dealii::CellData<3> cell;
            for (unsigned int v = 0; v < 8; ++v)
              cell.vertices[v] = (i + v % 2) % angles.size() * n_section + quadrilateral[v / 2];
            body.cells.push_back(cell);
          }
    }

    /// Lines around a wheel from cell to cell, as many as their size allows.
    PathLines lines_around(const double radius, const double size, const FineZone &zone)
    {
      const double turn = 2. * pi * radius;
      if (zone.path_stretch <= 1.)
        return {even_lines(0., turn, static_cast<unsigned int>(std::lround(turn / size))), size};
      const double middle = 0.5 * (zone.cubes()[0] + zone.cubes()[1]);
      return path_lines(middle - 0.5 * turn, middle + 0.5 * turn, size, zone, 1.);
    }

    /// Integrals over y in |y| <= width/2 of (outer^n - inner^n)/n with outer = radius + offset(y) ; the
    /// shift of the tread does not move the inner face. Also the same times y. Exact for a cylinder.
    struct RadialIntegral
    {
      double value  = 0.;
      double with_y = 0.;
    };

    RadialIntegral radial_integral(const unsigned int                   power,
                                   const double                         outer,
                                   const double                         inner,
                                   const double                         width,
                                   const std::function<double(double)> &offset)
    {
      const unsigned int      n_parts = offset ? 200 : 1;
      const dealii::QGauss<1> quadrature(4);
      RadialIntegral          integral;
      for (unsigned int part = 0; part < n_parts; ++part)
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const double y      = width * ((part + quadrature.point(q)[0]) / n_parts - 0.5);
            const double weight = quadrature.weight(q) * width / n_parts;
            const double r      = outer + (offset ? offset(y) : 0.);
            const double value  = (std::pow(r, power) - std::pow(inner, power)) / power;
            integral.value += weight * value;
            integral.with_y += weight * value * y;
          }
      return integral;
    }
  } // namespace

  bool WheelSector::is_closed() const
  {
    constexpr double tiny = 1e-9;
    return arc_end - arc_begin >= 2. * pi * radius * (1. - tiny);
  }


  Body make_wheel_sector(const WheelSector &sector, const FineZone &zone)
  {
    if (!(sector.thickness > 0. && sector.thickness < sector.radius && sector.width > 0.))
      throw std::invalid_argument(
        "a wheel sector needs a positive width and a thickness between zero and its radius");
    const bool closed = sector.is_closed();
    if (!closed &&
        !(sector.arc_begin < sector.arc_end && sector.arc_end - sector.arc_begin <= 1.9 * pi * sector.radius))
      throw std::invalid_argument(
        "a wheel sector needs a positive arc, which leaves a gap of a twentieth of a turn or none");

    const double anchor =
      (sector.arc_begin <= 0. && 0. <= sector.arc_end) ? 0. : 0.5 * (sector.arc_begin + sector.arc_end);
    std::vector<CoarseSide> sides{{0.5 * sector.width, zone.reach()}, {sector.thickness, zone.depth}};
    if (zone.path_stretch <= 1. && !closed)
      {
        sides.push_back({anchor - sector.arc_begin, anchor - zone.x_begin});
        sides.push_back({sector.arc_end - anchor, zone.x_end - anchor});
      }
    const double size = coarse_cell_size(zone.finest_cell_size, sector.coarsest_cell_size, sides);

    const WheelAxis     axis{sector.center_x, sector.radius + sector.lift};
    const double        inner_radius = sector.radius - sector.thickness;
    const PathLines     path         = closed ? lines_around(sector.radius, size, zone)
                                              : path_lines(sector.arc_begin, sector.arc_end, size, zone, 1.);
    std::vector<double> angles       = path.lines;
    for (double &angle : angles)
      angle /= sector.radius;
    if (closed)
      angles.pop_back();
    const std::vector<double> y     = coarse_lines(-0.5 * sector.width, 0.5 * sector.width, 0., size);
    const std::vector<double> depth = coarse_lines(0., sector.thickness, 0., size);

    Section section;
    for (unsigned int k = 0; k + 1 < depth.size(); ++k)
      section.add_row(y, sector.radius - depth[k], y, sector.radius - depth[k + 1]);

    Body body;
    body.name = closed ? "wheel ring" : "wheel sector";
    revolve(section, axis, angles, closed, body);
    body.manifold         = axis.manifold();
    body.to_space         = shape_tread(axis, sector, inner_radius);
    body.wanted_cell_size = cell_size_around(axis, sector.radius, zone);
    if (zone.path_stretch > 1.)
      body.path_stretch = stretch_around(axis, sector.radius, path);

    // The centre of a face with straight edges lies inside the cylinder, by a sixteenth of the row at most.
    const double tread   = sector.radius - 0.25 * depth[1];
    const double bottom  = inner_radius + 0.25 * (depth.back() - depth[depth.size() - 2]);
    const double quarter = 0.25 * std::min(angles[1] - angles[0], angles.back() - angles[angles.size() - 2]);
    body.boundary_at = [axis, tread, bottom, quarter, closed, first = angles.front(), last = angles.back(),
                        half  = 0.5 * sector.width,
                        side  = sector.between_planes ? Boundary::side : Boundary::free,
                        reach = sector.contact_half_width](const dealii::Point<3> &p) {
      if (std::abs(p[1]) > half * (1. - 1e-9))
        return side;
      const double r      = axis.radius(p);
      const double middle = 0.5 * (first + last);
      if (!closed && std::abs(wrap(axis.angle(p) - middle)) > 0.5 * (last - first) - quarter)
        return Boundary::end;
      if (r > tread)
        return std::abs(p[1]) <= reach ? Boundary::contact : Boundary::free;
      if (r < bottom)
        return Boundary::support;
      return Boundary::free;
    };
    return body;
  }
  namespace
  {
    /// The section of a full wheel, and what follows from its lines, m.
    struct FullSection
    {
      Section section;
      double  size;                ///< of its coarse cells
      double  tread_row, bore_row; ///< heights of the rows along the tread and the bore
    };

    FullSection full_section(const FullWheel &wheel, const FineZone &zone)
    {
      const double half_rim = 0.5 * wheel.rim_width, half_web = 0.5 * wheel.web_thickness,
                   half_hub = 0.5 * wheel.hub_length;
      // At least 50 cells around keep the rounding to a whole number below 1 %. The innermost row of the rim
      // leads over from the regular lines to those of the web, so it must lie below the fine zone.
      FullSection made;
      double     &size = made.size;
      size             = std::min(wheel.coarsest_cell_size, 2. * pi * wheel.radius / 50.);
      std::vector<double> rim_y, depth;
      while (true)
        {
          size =
            coarse_cell_size(zone.finest_cell_size, size,
                             {{half_rim, zone.reach()}, {wheel.radius - wheel.rim_inner_radius, zone.depth}});
          rim_y = coarse_lines(-half_rim, half_rim, 0., size);
          depth = coarse_lines(0., wheel.radius - wheel.rim_inner_radius, 0., size);
          if (rim_y.size() >= 5 && depth.size() >= 3 && zone.depth <= depth[depth.size() - 2])
            break;
          size *= 0.5;
        }

      Section           &section = made.section;
      const unsigned int n_half  = (rim_y.size() - 1) / 2; // rows of the rim on one side of y = 0
      const unsigned int n_web   = std::min(n_half - 1, rows_of(half_web, size, 1));

      // Where the lines of the rim arrive at its inner radius: the n_web lines next to y = 0 on each side
      // enter the web.
      std::vector<double> inner_y(rim_y.size(), 0.);
      for (unsigned int j = 1; j <= n_half; ++j)
        {
          const double web_line = rim_y[n_half + n_web];
          const double y        = j <= n_web ? half_web * j / n_web
                                             : half_web + (rim_y[n_half + j] - web_line) / (half_rim - web_line) *
                                                     (half_rim - half_web);
          inner_y[n_half + j]   = y;
          inner_y[n_half - j]   = -y;
        }
      for (unsigned int k = 0; k + 1 < depth.size(); ++k)
        {
          const bool to_web = k + 2 == depth.size();
          section.add_row(rim_y, wheel.radius - depth[k], to_web ? inner_y : rim_y,
                          wheel.radius - depth[k + 1]);
        }

      const std::vector<double> web_y = even_lines(-half_web, half_web, 2 * n_web);
      const std::vector<double> web_r =
        even_lines(wheel.rim_inner_radius, wheel.hub_outer_radius,
                   rows_of(wheel.rim_inner_radius - wheel.hub_outer_radius, size, 1));
      for (unsigned int k = 0; k + 1 < web_r.size(); ++k)
        section.add_row(web_y, web_r[k], web_y, web_r[k + 1]);

      const unsigned int  n_side = rows_of(half_hub - half_web, size, 1);
      std::vector<double> hub_y  = even_lines(-half_hub, -half_web, n_side);
      hub_y.insert(hub_y.end(), web_y.begin() + 1, web_y.end());
      const std::vector<double> other_side = even_lines(half_web, half_hub, n_side);
      hub_y.insert(hub_y.end(), other_side.begin() + 1, other_side.end());
      const std::vector<double> hub_r =
        even_lines(wheel.hub_outer_radius, wheel.bore_radius,
                   rows_of(wheel.hub_outer_radius - wheel.bore_radius, size, 1));
      for (unsigned int k = 0; k + 1 < hub_r.size(); ++k)
        section.add_row(hub_y, hub_r[k], hub_y, hub_r[k + 1]);
      made.tread_row = depth[1];
      made.bore_row  = hub_r[hub_r.size() - 2] - wheel.bore_radius;
      return made;
    }
  } // namespace


  Body make_full_wheel(const FullWheel &wheel, const FineZone &zone)
  {
    const double half_rim = 0.5 * wheel.rim_width, half_web = 0.5 * wheel.web_thickness,
                 half_hub = 0.5 * wheel.hub_length;
    if (!(0. < wheel.bore_radius && wheel.bore_radius < wheel.hub_outer_radius &&
          wheel.hub_outer_radius < wheel.rim_inner_radius && wheel.rim_inner_radius < wheel.radius))
      throw std::invalid_argument(
        "the wheel's radii must increase from the bore over hub and rim to the tread");
    if (!(0. < half_web && half_web < half_rim && half_web < half_hub))
      throw std::invalid_argument("the wheel's web must be thinner than its rim and its hub");

    const auto [section, size, tread_row, bore_row] = full_section(wheel, zone);

    const WheelAxis     axis{wheel.center_x, wheel.radius + wheel.lift};
    const PathLines     path    = lines_around(wheel.radius, size, zone);
    std::vector<double> angles  = path.lines;
    double              longest = 0.;
    for (unsigned int i = 0; i + 1 < angles.size(); ++i)
      longest = std::max(longest, angles[i + 1] - angles[i]);
    for (double &angle : angles)
      angle /= wheel.radius;
    angles.pop_back();

    Body body;
    body.name = "full wheel";
    revolve(section, axis, angles, true, body);
    body.manifold         = axis.manifold();
    body.to_space         = shape_tread(axis, wheel, wheel.rim_inner_radius);
    body.wanted_cell_size = cell_size_around(axis, wheel.radius, zone);
    if (zone.path_stretch > 1.)
      body.path_stretch = stretch_around(axis, wheel.radius, path);

    // Centres of faces with straight edges lie a little inside the cylinder that the face is on.
    const double tread  = wheel.radius - 0.25 * tread_row;
    const double bore   = wheel.bore_radius + 0.25 * bore_row;
    const double center = 0.5 * (zone.x_begin + zone.x_end) / wheel.radius;
    const double half_path =
      (0.5 * (zone.x_end - zone.x_begin) + wheel.contact_margin + 0.5 * longest) / wheel.radius;
    body.boundary_at = [axis, tread, bore, center, half_path, half_rim, half_hub,
                        half_width = wheel.contact_half_width](const dealii::Point<3> &p) {
      const double r = axis.radius(p);
      if (r > tread && std::abs(p[1]) < half_rim * (1. - 1e-9))
        {
          const bool in_reach =
            std::abs(p[1]) <= half_width && std::abs(wrap(axis.angle(p) - center)) <= half_path;
          return in_reach ? Boundary::contact : Boundary::free;
        }
      if (r < bore && std::abs(p[1]) < half_hub * (1. - 1e-9))
        return Boundary::support;
      return Boundary::free;
    };
    return body;
  }

  WheelInertia wheel_inertia(const WheelSector &sector, const double density)
  {
    const double inner_radius = sector.radius - sector.thickness;
    const double begin        = sector.arc_begin / sector.radius;
    const double end          = sector.arc_end / sector.radius;
    const auto   integral     = [&](const unsigned int power) {
      return radial_integral(power, sector.radius, inner_radius, sector.width, sector.tread_offset);
    };

    // dm = density r dr d(angle) dy at (r sin(angle), y, -r cos(angle)) from the wheel's centre
    WheelInertia inertia;
    inertia.mass            = density * (end - begin) * integral(2).value;
    inertia.axial_inertia   = density * (end - begin) * integral(4).value;
    inertia.first_moment[0] = density * (std::cos(begin) - std::cos(end)) * integral(3).value;
    inertia.first_moment[1] = density * (end - begin) * integral(2).with_y;
    inertia.first_moment[2] = -density * (std::sin(end) - std::sin(begin)) * integral(3).value;
    return inertia;
  }

  WheelInertia wheel_inertia(const FullWheel &wheel, const double density)
  {
    WheelInertia inertia;
    const auto   add_ring = [&](const double outer, const double inner, const double width,
                              const std::function<double(double)> &offset) {
      const RadialIntegral volume = radial_integral(2, outer, inner, width, offset);
      inertia.mass += density * 2. * pi * volume.value;
      inertia.axial_inertia += density * 2. * pi * radial_integral(4, outer, inner, width, offset).value;
      inertia.first_moment[1] += density * 2. * pi * volume.with_y;
    };
    add_ring(wheel.radius, wheel.rim_inner_radius, wheel.rim_width, wheel.tread_offset);
    add_ring(wheel.rim_inner_radius, wheel.hub_outer_radius, wheel.web_thickness, nullptr);
    add_ring(wheel.hub_outer_radius, wheel.bore_radius, wheel.hub_length, nullptr);
    return inertia;
  }
} // namespace tread
