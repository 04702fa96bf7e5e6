// SPDX-License-Identifier: LGPL-2.1-or-later
// Hertz: a sphere on a flat block, and wheel on rail at 127.1 kN, in frictionless equilibrium.
#include <tread/mesh/rail_body.h>
#include <tread/mesh/wheel_body.h>
#include <tread/reference/hertz.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "pressed.h"

#include <algorithm>

using namespace tread;
using tests::Check;
using dealii::Point;

namespace contact_hertz
{
  struct Contacts
  {
    double       approach = 0., force = 0.;               ///< m, N
    double       max_pressure = 0., a = 0., b = 0.;       ///< of the fitted ellipse, Pa and m
    double       center_pressure = 0., counted_area = 0.; ///< largest nodal pressure, areas of loaded nodes
    unsigned int n_loaded = 0, iterations = 0;
    bool         touches_rim = false;
    std::size_t  n_cells     = 0;
  };

  /// p^2 = p0^2 (1 - x^2/a^2 - y^2/b^2) by least squares over the nodes with more than a third of the largest
  /// pressure.
  void fit(const std::vector<ContactNodeState> &states, Contacts &result)
  {
    std::vector<double> pressure;
    Vector3             center{};
    double              total = 0.;
    for (const ContactNodeState &s : states)
      {
        const double p = dot(s.impulse, s.normal);
        pressure.push_back(p / s.area);
        center += p * s.position;
        total += p;
        result.counted_area += s.area;
      }
    center *= 1. / total;
    result.center_pressure = *std::max_element(pressure.begin(), pressure.end());
    result.n_loaded        = states.size();
    double matrix[3][4]    = {};
    for (unsigned int i = 0; i < states.size(); ++i)
      if (pressure[i] > result.center_pressure / 3.)
        {
          const double x = states[i].position[0] - center[0], y = states[i].position[1] - center[1];
          const double row[4] = {1., 1e6 * x * x, 1e6 * y * y, 1e-18 * pressure[i] * pressure[i]};
          for (unsigned int j = 0; j < 3; ++j)
            for (unsigned int k = 0; k < 4; ++k)
              matrix[j][k] += row[j] * row[k];
        }
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < 3; ++i)
        if (i != k)
          for (unsigned int j = 4; j-- > k;)
            matrix[i][j] -= matrix[i][k] / matrix[k][k] * matrix[k][j];
    const double p2     = matrix[0][3] / matrix[0][0];
    result.max_pressure = 1e9 * std::sqrt(p2);
    result.a            = 1e-3 * std::sqrt(-p2 / (matrix[1][3] / matrix[1][1]));
    result.b            = 1e-3 * std::sqrt(-p2 / (matrix[2][3] / matrix[2][2]));
  }

  /// Body 1, whose support a rigid hub carries, rests on body 0 with the force given.
  /// @param axle height of the hub at first touch, m
  Contacts press(const std::vector<Body> &bodies,
                 const double             axle,
                 const double             force,
                 const unsigned int       slave)
  {
    tests::PressParameters parameters;
    parameters.force = force;
    parameters.axle  = axle;
    parameters.slave = slave;
    tests::Pressed pressed(bodies, parameters);
    Contacts       result;
    result.iterations  = pressed.relax();
    result.approach    = axle - pressed.hub.motion.z;
    result.force       = pressed.force();
    result.touches_rim = pressed.contact.contact_at_rim().has_value();
    result.n_cells     = pressed.mesh.n_global_cells;
    fit(pressed.contact.active_nodes(), result);
    return result;
  }

  /// Sphere on a flat block, both cube-like with half-width and height size.
  Contacts sphere(const double       radius,
                  const double       force,
                  const double       size,
                  const double       h,
                  const double       a,
                  const unsigned int slave)
  {
    return press(tests::sphere_on_flat(radius, size, 64. * h, tests::zone_around(a, a, h, 0.6 * a)), size,
                 force, slave);
  }

  void report(Check &check, const std::string &name, const Contacts &r)
  {
    std::printf("%s%zu cells, %u iterations, %u loaded slave nodes, areas %.3f mm2, largest nodal pressure "
                "%.1f MPa%s\n",
                name.c_str(), r.n_cells, r.iterations, r.n_loaded, 1e6 * r.counted_area,
                1e-6 * r.center_pressure, r.touches_rim ? ", touches the rim" : "");
    // At most 1160 with the damping of what still moves; with that of another frequency twice as many.
    check.that(name + "at rest within 1400 iterations", r.iterations <= 1400);
  }
} // namespace contact_hertz

TREAD_TEST(contact_hertz)(Check &check, const tests::Arguments &)
{
  const double modulus = 210e9 / (2. * (1. - 0.09));
  const double pi      = dealii::numbers::PI;

  {
    const double radius = 0.05, force = 1000.;
    const auto   hertz = reference::hertz_sphere(radius, modulus, force);
    check.relative("closed form: sphere, radius of contact, mm", 1e3 * hertz.semi_axis_x, 0.6875, 1e-3);
    double approach[2][2] = {};
    for (const unsigned int slave : {0u, 1u})
      {
        const double h = 0.07e-3, size = 64. * h * 4.;
        for (const unsigned int i :
             slave == 0 ? std::vector<unsigned int>{0, 1} : std::vector<unsigned int>{0})
          {
            const std::string name = std::string("sphere, ") + (slave ? "slave above" : "slave below") +
                                     (i ? ", twice the size: " : ": ");
            const Contacts r = sphere(radius, force, (i + 1) * size, h, hertz.semi_axis_x, slave);
            report(check, name, r);
            approach[slave][i] = r.approach;
            check.relative(name + "force, N", r.force, force, 1e-3);
            check.that(name + "inside the fine zone", !r.touches_rim);
            // Ten cells across a radius.
            check.relative(name + "largest pressure, MPa", 1e-6 * r.max_pressure, 1e-6 * hertz.max_pressure,
                           0.015);
            check.relative(name + "a, mm", 1e3 * r.a, 1e3 * hertz.semi_axis_x, 0.015);
            check.relative(name + "b, mm", 1e3 * r.b, 1e3 * hertz.semi_axis_x, 0.015);
            check.relative(name + "area, mm2", 1e6 * pi * r.a * r.b, 1e6 * hertz.area,
                           0.02); // half a row of cells about it
            check.that(
              name + "a force wrong by 10 % is noticed",
              std::abs(r.max_pressure / reference::hertz_sphere(radius, modulus, 1.1 * force).max_pressure -
                       1.) > 0.015);
          }
        if (slave == 1)
          {
            check.relative("sphere: approach, slave above - slave below, um", 1e6 * approach[1][0],
                           1e6 * approach[0][0], 1e-3);
            continue;
          }
        // Far from the contact displacements die out as 1/distance: so does the effect of finite blocks.
        const double limit = 2. * approach[slave][1] - approach[slave][0];
        std::printf("approach: %.3f um, twice the size %.3f um\n", 1e6 * approach[slave][0],
                    1e6 * approach[slave][1]);
        check.relative("sphere: approach extrapolated to half-spaces, um", 1e6 * limit, 1e6 * hertz.approach,
                       0.015);
      }
  }

  {
    // At a pressure of 308 MPa: that of 1340 MPa under a wheel of 0.46 m strains steel by half a per cent,
    // and the patch is 2 % smaller than half-space theory says, which neglects strain.
    const double force = 29232., radius = 2., crown = 1.304348;
    const auto   hertz = reference::hertz_ellipse(0.5 / radius, 0.5 / crown, modulus, force);
    check.relative("closed form: ellipse, a, mm", 1e3 * hertz.semi_axis_x, 7.754, 1e-3);
    check.relative("closed form: ellipse, b, mm", 1e3 * hertz.semi_axis_y, 5.835, 1e-3);
    double approach[2] = {};
    for (const unsigned int i : {0u, 1u})
      {
        FineZone zone = tests::zone_around(hertz.semi_axis_x, hertz.semi_axis_y, 0.75e-3, 3e-3);
        // Two cells of each size leave the bodies too stiff: the patch would be 1.9 % too small.
        zone.level_depth  = std::sqrt(hertz.semi_axis_x * hertz.semi_axis_y);
        const double size = 0.072 * (i + 1); // heights of both, and half of lengths and widths
        RailBlock    block;
        block.x_begin            = -size;
        block.x_end              = size;
        block.width              = 2. * size;
        block.height             = size;
        block.crown_radius       = crown;
        block.coarsest_cell_size = 0.025;
        WheelSector sector;
        sector.radius             = radius;
        sector.thickness          = size;
        sector.width              = 2. * size;
        sector.arc_begin          = -size;
        sector.arc_end            = size;
        sector.coarsest_cell_size = 0.025;
        const std::string name    = std::string("wheel on rail") + (i ? ", twice the size: " : ": ");
        const Contacts    r =
          press({make_rail_block(block, zone), make_wheel_sector(sector, zone)}, radius, force, 1);
        report(check, name, r);
        approach[i] = r.approach;
        check.relative(name + "force, kN", 1e-3 * r.force, 1e-3 * force, 1e-3);
        check.that(name + "inside the fine zone", !r.touches_rim);
        // Eight to ten cells across a semi-axis; (a/R)^2 is 3e-4, (a/size)^3 1e-3.
        check.relative(name + "largest pressure, MPa", 1e-6 * r.max_pressure, 1e-6 * hertz.max_pressure,
                       0.015);
        check.relative(name + "a, mm", 1e3 * r.a, 1e3 * hertz.semi_axis_x, 0.015);
        check.relative(name + "b, mm", 1e3 * r.b, 1e3 * hertz.semi_axis_y, 0.015);
        check.relative(name + "area, mm2", 1e6 * pi * r.a * r.b, 1e6 * hertz.area,
                       0.02); // half a row of cells about it
      }
    std::printf("approach: %.3f um, twice the size %.3f um\n", 1e6 * approach[0], 1e6 * approach[1]);
    check.relative("wheel on rail: approach extrapolated to half-spaces, um",
                   1e6 * (2. * approach[1] - approach[0]), 1e6 * hertz.approach, 0.015);
  }
}
