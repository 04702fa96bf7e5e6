// SPDX-License-Identifier: LGPL-2.1-or-later
// Recovered stresses beside known fields: uniform stress in turned and distorted cells of two sizes, the
// half-space under the pressure and the shear stress of a Hertzian contact, whose error is of second order,
// and steel that has yielded.
#include <tread/analysis/stress_recovery.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace tread;
using dealii::Point;
using Stress = StressRecovery::Stress;

namespace analysis_stress_recovery
{
  double depth_of(const Point<3> &p)
  {
    return -p[2];
  }

  /// A block with its top at z = 0 that may be in contact there. @param fine_depth cells down to there have
  /// half the size
  struct Block
  {
    Mesh             mesh;
    Solid            solid;
    ExplicitDynamics dynamics;
    Contact          contact;

    Block(const double                                     half_length,
          const double                                     depth,
          const double                                     cell,
          const double                                     fine_depth = 0.,
          const std::function<Point<3>(const Point<3> &)> &to_space   = {},
          const std::vector<PlasticZone>                  &zones      = {})
      : mesh(MPI_COMM_WORLD, {body(half_length, depth, cell, fine_depth, to_space)})
      , solid(mesh, {ElasticMaterial()}, SolidParameters(), zones)
      , dynamics(mesh, solid, DynamicsParameters())
      , contact(mesh, ContactParameters(), std::make_shared<CoulombFriction>(0.3))
    {
    }

    static Body body(const double                                     half_length,
                     const double                                     depth,
                     const double                                     cell,
                     const double                                     fine_depth,
                     const std::function<Point<3>(const Point<3> &)> &to_space)
    {
      const unsigned int along = std::lround(2. * half_length / cell), down = std::lround(depth / cell);
      Body               body =
        tests::make_box("block", Point<3>(-half_length, -half_length, -depth),
                        Point<3>(half_length, half_length, 0.), {{along, along, down}},
                        {{tests::Side::bottom, Boundary::support}, {tests::Side::top, Boundary::contact}});
      body.wanted_cell_size = [=](const Point<3> &p) {
        return p[2] > -0.9 * fine_depth ? 0.5 * cell : std::numeric_limits<double>::max();
      };
      body.to_space = to_space;
      return body;
    }

    /// Recover under a displacement (m) and tractions on the surface (Pa).
    template <typename Displacement, typename Traction>
    StressRecovery recovered(const std::function<bool(const Point<3> &)> &contains,
                             const Displacement                          &displacement,
                             const Traction                              &traction)
    {
      constexpr double time_step = 1e-7;
      StressRecovery   recovery(mesh, solid, &contact.surfaces, ElasticMaterial(), {0, depth_of, contains});
      NodalField       x(mesh.nodes.size());
      for (unsigned int i = 0; i < x.size(); ++i)
        {
          const Point<3> &p = mesh.nodes[i];
          x[i]              = Vector3{p[0], p[1], p[2], 0.} + displacement(p);
        }
      // Areas that belong to the nodes, as all ranks know them.
      std::vector<double>  area(contact.surfaces.nodes.size(), 0.);
      std::vector<Vector3> impulses(area.size()), places;
      contact.surfaces.replicate(x.data(), places);
      for (const ContactSurfaces::Face &face : contact.surfaces.faces)
        {
          const Vector3 d = places[face.nodes[2]] - places[face.nodes[0]],
                        e = places[face.nodes[3]] - places[face.nodes[1]];
          for (const unsigned int k : face.nodes)
            area[k] += 0.125 * norm(Vector3{d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2],
                                            d[0] * e[1] - d[1] * e[0], 0.});
        }
      for (std::size_t k = 0; k < area.size(); ++k)
        {
          const Vector3 p = contact.surfaces.nodes[k].reference;
          impulses[k]     = time_step * area[k] * traction(Point<3>(p[0], p[1], p[2]));
        }
      recovery.recover(x.data(), solid.cauchy_stress(x.data(), dynamics.state.history),
                       solid.plastic().yield_limits(dynamics.state.history), impulses, time_step);
      return recovery;
    }
  };

  bool everywhere(const Point<3> &)
  {
    return true;
  }

  double largest(const double own)
  {
    return dealii::Utilities::MPI::max(own, MPI_COMM_WORLD);
  }

  /// Uniform stress, in cells of two sizes that are sheared and bent, turned with the body by a radian.
  void check_patch(tests::Check &check)
  {
    Block block(0.01, 0.01, 2.5e-3, 2.5e-3, [](const Point<3> &p) {
      return Point<3>(p[0] + 0.1 * p[1], p[1] - 8. * p[1] * p[2], p[2] + 3. * p[0] * p[2]);
    });
    // Strains so small that their squares do not count.
    const double e[6] = {3e-6, -2e-6, 1e-6, 2e-6, -1e-6, 4e-6}; // xx, yy, zz, xy, yz, zx
    const double c = std::cos(1.), s = std::sin(1.);
    const auto   turned = [&](const Vector3 p) {
      return Vector3{c * p[0] + s * p[2], p[1], c * p[2] - s * p[0], 0.};
    };
    const double mu       = ElasticMaterial().shear_modulus(),
                 mean     = ElasticMaterial().lame() * (e[0] + e[1] + e[2]);
    const double  S[6]    = {mean + 2. * mu * e[0], mean + 2. * mu * e[1], mean + 2. * mu * e[2],
                             2. * mu * e[3],        2. * mu * e[4],        2. * mu * e[5]};
    const Vector3 rows[3] = {turned(Vector3{S[0], S[3], S[5], 0.}), turned(Vector3{S[3], S[1], S[4], 0.}),
                             turned(Vector3{S[5], S[4], S[2], 0.})};
    Vector3       columns[3];
    for (unsigned int d = 0; d < 3; ++d)
      columns[d] = turned(Vector3{rows[0][d], rows[1][d], rows[2][d], 0.});
    const Stress expected{
      {columns[0][0], columns[1][1], columns[2][2], columns[0][1], columns[1][2], columns[2][0]}};
    const auto recovery = block.recovered(
      everywhere,
      [&](const Point<3> &p) {
        const Vector3 place{p[0], p[1], p[2], 0.};
        return turned(place + Vector3{e[0] * p[0] + e[3] * p[1] + e[5] * p[2],
                                      e[3] * p[0] + e[1] * p[1] + e[4] * p[2],
                                      e[5] * p[0] + e[4] * p[1] + e[2] * p[2], 0.}) -
               place;
      },
      // The surface's normal is that of the plane z = 0.
      [&](const Point<3> &) {
        return turned(Vector3{S[5], S[4], S[2], 0.});
      });
    const auto error = [&](const std::vector<Stress> &stresses) {
      double worst = 0.;
      for (const Stress &stress : stresses)
        for (unsigned int k = 0; k < 6; ++k)
          worst = std::max(worst, std::abs(stress[k] - expected[k]));
      return largest(worst) / von_mises(expected);
    };
    check.below("uniform stress: at the surface, share", error(recovery.stress_at_surface()), 2e-5);
    check.below("uniform stress: below it, share", error(recovery.stress_below_surface()), 2e-5);
    double n[2] = {0., 0.};
    for (const auto &site : recovery.at_surface())
      n[0] += site.wanted;
    for (const auto &site : recovery.below_surface())
      n[1] += site.wanted;
    check.absolute("uniform stress: nodes of the surface", dealii::Utilities::MPI::sum(n[0], MPI_COMM_WORLD),
                   17. * 17., 0.);
    // Two layers of 16 x 16 cells, of which nodes hang between the second and the third, and three of 8 x 8.
    check.absolute("uniform stress: edges into depth", dealii::Utilities::MPI::sum(n[1], MPI_COMM_WORLD),
                   2. * 17. * 17. + 3. * 9. * 9., 0.);
  }

  /// Half-space under axisymmetric pressure and, in the middle plane, the same of shear stress: a finite sum
  /// of Bessel functions, which is an exact solution, with the transform of Hertz's pressure (Johnson 1985,
  /// sections 3.2 and 4.2). Lengths over the radius of the patch, stresses over the largest pressure.
  struct HertzField
  {
    static constexpr double last = 9.42477796, step = last / 27.,
                            nu = 0.3; ///< three halves of its periods

    static double amplitude(const double k) // times k and the step of the sum
    {
      return step * (std::sin(k) - k * std::cos(k)) / (k * k);
    }

    template <typename Term>
    static void sum(const Term &term)
    {
      for (double k = 0.5 * step; k < last; k += step)
        term(k, amplitude(k));
    }

    /// 2 mu u over pressure and radius: radial and into the depth.
    static std::array<double, 2> displacement(const double r, const double z)
    {
      std::array<double, 2> u{};
      sum([&](const double k, const double a) {
        const double decay = a * std::exp(-k * z) / k;
        u[0] -= decay * (1. - 2. * nu - k * z) * std::cyl_bessel_j(1, k * r);
        u[1] += decay * (2. * (1. - nu) + k * z) * std::cyl_bessel_j(0, k * r);
      });
      return u;
    }

    /// rr, circumferential, zz, rz (z into the depth).
    static std::array<double, 4> stress(const double r, const double z)
    {
      std::array<double, 4> s{};
      sum([&](const double k, const double a) {
        const double decay = a * std::exp(-k * z), J0 = std::cyl_bessel_j(0, k * r);
        const double J1 = std::cyl_bessel_j(1, k * r), over = r > 1e-9 ? J1 / (k * r) : 0.5;
        s[0] -= decay * ((1. - k * z) * J0 - (1. - 2. * nu - k * z) * over);
        s[1] -= decay * (2. * nu * J0 + (1. - 2. * nu - k * z) * over);
        s[2] -= decay * (1. + k * z) * J0;
        s[3] -= decay * k * z * J1;
      });
      return s;
    }

    static double von_mises(const double r, const double z)
    {
      const auto s = stress(r, z);
      return tread::von_mises({{s[0], s[1], s[2], 0., 0., s[3]}});
    }
  };

  struct Errors
  {
    double surface = 0., uppermost = 0., below = 0.;
  };

  Errors hertz_errors(const unsigned int cells_per_radius)
  {
    constexpr double radius = 6e-3, pressure = 1e5; // small: nothing but linear elasticity counts
    const double     cell = radius / cells_per_radius,
                 factor   = pressure * radius / (2. * ElasticMaterial().shear_modulus());
    Block      block(1.5 * radius, radius, cell);
    const auto inside = [&](const Point<3> &p) {
      return std::hypot(p[0], p[1]) < 1.2 * radius && p[2] > -0.6 * radius;
    };
    const auto recovery = block.recovered(
      inside,
      [&](const Point<3> &p) {
        const double r      = std::hypot(p[0], p[1]);
        const auto   u      = HertzField::displacement(r / radius, -p[2] / radius);
        const double radial = r > 0. ? factor * u[0] / r : 0.;
        return Vector3{radial * p[0], radial * p[1], -factor * u[1], 0.};
      },
      [&](const Point<3> &p) {
        return Vector3{0., 0., pressure * HertzField::stress(std::hypot(p[0], p[1]) / radius, 0.)[2], 0.};
      });
    Errors     errors;
    const auto compare = [&](const StressRecovery::Site &site, const Stress &stress, double &worst) {
      if (site.wanted)
        worst =
          std::max(worst, std::abs(von_mises(stress) / pressure -
                                   HertzField::von_mises(std::hypot(site.place[0], site.place[1]) / radius,
                                                         site.depth / radius)));
    };
    for (std::size_t k = 0; k < recovery.at_surface().size(); ++k)
      compare(recovery.at_surface()[k], recovery.stress_at_surface()[k], errors.surface);
    for (std::size_t k = 0; k < recovery.below_surface().size(); ++k)
      {
        const StressRecovery::Site &site = recovery.below_surface()[k];
        // The second layer lies where stress curves the more the thinner it is: a fixed range of depths.
        if (site.depth < cell)
          compare(site, recovery.stress_below_surface()[k], errors.uppermost);
        else if (site.depth > 0.25 * radius)
          compare(site, recovery.stress_below_surface()[k], errors.below);
      }
    for (double *error : {&errors.surface, &errors.uppermost, &errors.below})
      *error = largest(*error);
    return errors;
  }

  void check_hertz(tests::Check &check)
  {
    // The sum is Hertz's pressure but for what varies faster than a tenth of the radius.
    const double on_axis = HertzField::stress(0., 0.48)[2] - HertzField::stress(0., 0.48)[0];
    check.relative("Hertz: largest shear stress on the axis over the pressure", -0.5 * on_axis, 0.310, 0.02);
    check.relative("Hertz: stress along the surface in the middle", HertzField::stress(0., 0.)[0], -0.8,
                   0.02);
    const Errors coarse = hertz_errors(8), fine = hertz_errors(16);
    const auto   order = [&](const std::string &where, const double first, const double second,
                           const double allowed) {
      check.below("Hertz: " + where + ", 16 cells a radius, over the pressure", second, allowed);
      // A quarter is order two; the largest of all errors belongs to other places on the two meshes.
      check.below("Hertz: " + where + ", its error over that of cells twice as large", second / first, 0.31);
    };
    order("at the surface", coarse.surface, fine.surface, 0.0035);
    order("in the uppermost layer", coarse.uppermost, fine.uppermost, 0.006);
    order("a quarter of the radius below it and deeper", coarse.below, fine.below, 0.006);
  }

  /// Steel that has yielded: Hooke's law would give twice the yield stress.
  void check_yield(tests::Check &check)
  {
    PlasticMaterial plastic;
    plastic.yield_stress = 500e6;
    const auto zone      = [](const Point<3> &p) {
      return p[2] > -6e-3;
    };
    for (const double bend : {0., 40.})
      {
        Block        block(0.01, 0.01, 2.5e-3, 0., {}, {{0, plastic, zone}});
        const double stretch = 5e-3;
        const auto   u       = [&](const Point<3> &p) {
          return Vector3{stretch * (1. + bend * p[2]) * p[0], 0., 0., 0.};
        };
        NodalField x(block.mesh.nodes.size()), v(x.size(), Vector3{}), force(x.size(), Vector3{});
        for (unsigned int i = 0; i < x.size(); ++i)
          {
            const Point<3> &p = block.mesh.nodes[i];
            x[i]              = Vector3{p[0], p[1], p[2], 0.} + u(p);
          }
        block.solid.update_internal_forces(x.data(), v.data(), force.data(), block.dynamics.state.history);
        const auto recovery = block.recovered(everywhere, u, [](const Point<3> &) { return Vector3{}; });
        double     most = 0., least = std::numeric_limits<double>::max();
        for (const Stress &stress : recovery.stress_at_surface())
          {
            most  = std::max(most, von_mises(stress));
            least = std::min(least, von_mises(stress));
          }
        const std::string name = bend == 0. ? "yielded: stretched: " : "yielded: stretched and bent: ";
        check.relative(name + "largest stress at the surface, MPa", 1e-6 * largest(most), 500., 1e-9);
        check.relative(name + "least stress at the surface, MPa", -1e-6 * largest(-least), 500., 1e-9);
        // What lies on the surface is in equilibrium with its stress, and the rest is what the yield stress
        // leaves.
        const auto loaded = block.recovered(everywhere, u, [](const Point<3> &) {
          return Vector3{100e6, -50e6, -200e6, 0.};
        });
        double     off = 0., unbalanced = 0.;
        for (const Stress &stress : loaded.stress_at_surface())
          {
            off        = std::max(off, std::abs(von_mises(stress) - 500e6));
            unbalanced = std::max({unbalanced, std::abs(stress[2] + 200e6), std::abs(stress[4] + 50e6),
                                   std::abs(stress[5] - 100e6)});
          }
        check.below(name + "under pressure and shear: off the yield stress, MPa", 1e-6 * largest(off), 1e-6);
        check.below(name + "stress at the surface less the traction, MPa", 1e-6 * largest(unbalanced), 1e-6);
      }
  }
} // namespace analysis_stress_recovery

TREAD_TEST(analysis_stress_recovery)(tests::Check &check, const tests::Arguments &)
{
  check_patch(check);
  check_hertz(check);
  check_yield(check);
}
