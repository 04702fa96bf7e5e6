// SPDX-License-Identifier: LGPL-2.1-or-later
// The half-space solver beyond Hertz: a rail head of three arcs, two patches at once, unlike bodies; and bad
// input.
#include <tread/reference/half_space.h>
#include <tread/reference/hertz.h>
#include <tread/reference/planar_contact.h>
#include <tread/reference/rolling_case.h>
#include <tread/reference/rolling_estimate.h>

#include "check.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace tread::reference;

namespace reference_gap
{
  using Field = std::vector<double>;

  Field make_gap(const Grid &grid, const std::function<double(double, double)> &gap)
  {
    Field h(grid.size());
    for (unsigned int j = 0; j < grid.n_y; ++j)
      for (unsigned int i = 0; i < grid.n_x; ++i)
        h[j * grid.n_x + i] = gap(grid.x(i), grid.y(j));
    return h;
  }

  double largest(const Field &f)
  {
    return *std::max_element(f.begin(), f.end());
  }

  /// Head of the rail 54E1 (EN 13674-1): arcs of 300, 80 and 13 mm that touch at |y| = 10.012 and 24.8635 mm.
  /// Depth below the crown.
  double rail_depth(const double y)
  {
    const double r[3] = {0.3, 0.08, 0.013}, border[2] = {10.012e-3, 24.8635e-3};
    const double t    = std::abs(y);
    double       sine = 0., depth = 0., start = 0.; // slope angle's sine and depth where the arc starts
    for (int k = 0; k < 3; ++k)
      {
        const double end = (k < 2) ? std::min(t, border[k]) : t;
        const double s   = sine + (end - start) / r[k];
        depth += r[k] * (std::sqrt(1. - sine * sine) - std::sqrt(1. - std::min(s * s, 1.)));
        sine  = s;
        start = end;
        if (end == t)
          break;
      }
    return depth;
  }

  double rail_slope(const double y)
  {
    const double d = 1e-7;
    return (rail_depth(y + d) - rail_depth(y - d)) / (2. * d);
  }

  /// A conical tread, R = 460 mm, that touches the head beside the crown and drives with a tenth of its load.
  struct TreadOnHead
  {
    double            force, shift; ///< N; from the crown to the point of contact, m
    double            slope, depth; ///< of the head where the tread touches it; depth in m
    std::string       name;
    ElasticPair       pair;
    HertzEllipse      crown, side; ///< if all of the head were the crown's arc or the 80 mm arc
    Grid              grid;
    TangentialProblem rolling;

    explicit TreadOnHead(const double shift)
      : force(80e3)
      , shift(shift)
      , slope(rail_slope(shift))
      , depth(rail_depth(shift))
      , name(std::to_string(std::lround(shift * 1e3)) + " mm: ")
      , pair(combine(Elastic{}, Elastic{}))
      , crown(hertz_ellipse(1. / 0.92, 1. / 0.6, pair.hertz_modulus(), force))
      , side(hertz_ellipse(1. / 0.92, 1. / 0.16, pair.hertz_modulus(), force))
      , grid(centred_grid(12e-3, 8e-3, 0.33e-3))
    {
      grid.y_first += shift;
      rolling.friction                     = 0.4;
      rolling.prescribe_longitudinal_force = true;
      rolling.longitudinal_force           = 0.1 * force;
      rolling.spin                         = slope / 0.46; // of a cone of this slope
    }

    ContactSolution solve() const
    {
      NormalProblem normal;
      normal.force = force;
      normal.gap   = make_gap(grid, [&](const double x, const double y) {
        return x * x / 0.92 + rail_depth(y) - depth - slope * (y - shift);
      });
      return solve_contact(grid, pair, normal, rolling);
    }

    /// The same with y from the point of contact, and a first grid that holds the patch of the 80 mm arc
    /// only.
    RollingCase narrow_case() const
    {
      RollingCase narrow;
      narrow.curvature_x          = 1. / 0.92;
      narrow.curvature_y          = 1. / 0.16;
      narrow.normal_force         = force;
      narrow.friction             = rolling.friction;
      narrow.traction_coefficient = 0.1;
      narrow.spin                 = rolling.spin;
      narrow.element_size         = grid.dx;
      narrow.gap                  = [*this](const double x, const double y) {
        return x * x / 0.92 + rail_depth(y + shift) - depth - slope * y;
      };
      return narrow;
    }
  };

  /// Area and largest pressure of a patch.
  struct Patch
  {
    double area, max_pressure;
  };

  /// What holds for each patch by itself.
  Patch patch_on_head(tread::tests::Check &check, const TreadOnHead &on_head, const ContactSolution &c)
  {
    const std::string &name = on_head.name;
    const Grid        &grid = on_head.grid;
    const double area = c.normal.contact.size() * grid.element_area(), p_max = largest(c.normal.pressure);
    double       sum = 0., moment = 0.;
    for (std::size_t e = 0; e < grid.size(); ++e)
      {
        sum += c.normal.pressure[e] * grid.element_area();
        moment += c.normal.pressure[e] * grid.element_area() * grid.y(e / grid.n_x);
      }
    std::printf("    %sarea %.2f mm^2, p_max %.1f MPa, centre of force at %.3f mm, xi %.3e, Fy/Fn %+.4f, "
                "%u + %u iterations\n",
                name.c_str(), area * 1e6, p_max * 1e-6, moment / sum * 1e3, c.tangential.longitudinal,
                c.tangential.lateral_force / on_head.force, c.normal.iterations, c.tangential.iterations);
    check.relative(name + "sum of the pressure [kN]", sum * 1e-3, 80., 1e-12);
    check.relative(name + "Fx [kN]", c.tangential.longitudinal_force * 1e-3, 8., 1e-5);
    check.that(name + "patch inside the grid", !c.normal.cut);
    double gap_error = 0.;
    for (std::size_t e = 0; e < grid.size(); ++e)
      gap_error =
        std::max(gap_error, c.normal.pressure[e] > 0. ? std::abs(c.normal.gap[e]) : -c.normal.gap[e]);
    check.below(name + "gap in contact, penetration outside, over the approach",
                gap_error / c.normal.approach, 1e-8);
    return {area, p_max};
  }

  /// Between the ellipses of the crown and of the 80 mm arc, and monotonic as the patch leaves the crown.
  void between_both_arcs(tread::tests::Check   &check,
                         const TreadOnHead     &on_head,
                         const ContactSolution &c,
                         const Patch           &patch,
                         const Patch           &before)
  {
    const std::string &name = on_head.name;
    // whole elements are counted: an element more or less along half of the edge is 3 %
    check.that(name + "area between that of both arcs",
               patch.area < 1.03 * on_head.crown.area && patch.area > 0.97 * on_head.side.area);
    check.that(name + "pressure between that of both arcs",
               patch.max_pressure > 0.995 * on_head.crown.max_pressure &&
                 patch.max_pressure < 1.01 * on_head.side.max_pressure);
    check.that(name + "area falls, pressure rises",
               patch.area <= before.area && patch.max_pressure >= before.max_pressure * (1. - 1e-3));
    if (on_head.shift == 0.)
      {
        // the patch (b = 5.0 mm) lies on the crown arc alone; that is a circle, Hertz's a parabola:
        // (b/R)^2/4 of the gap, 1e-4
        check.relative(name + "p_max against Hertz [MPa]", patch.max_pressure * 1e-6,
                       on_head.crown.max_pressure * 1e-6, 1e-3);
        check.relative(name + "area against Hertz [mm^2]", patch.area * 1e6, on_head.crown.area * 1e6, 0.03);
        check.below(name + "Fy/Fn", c.tangential.lateral_force / on_head.force, 1e-6);
      }
  }

  /// Solved from a first grid that holds the patch of the 80 mm arc only: where the patch reaches over the
  /// crown's arc the grid has to grow, and the answer must not depend on it. Returns whether it grew.
  bool narrow_first_grid(tread::tests::Check   &check,
                         const TreadOnHead     &on_head,
                         const ContactSolution &c,
                         const Patch           &patch,
                         const RollingResult   &grown)
  {
    const std::string &name   = on_head.name;
    bool               border = false;
    for (std::size_t e = 0; e < grown.x.size(); ++e)
      border = border || (grown.pressure[e] > 0. &&
                          (e % grown.grid.n_x == 0 || e % grown.grid.n_x == grown.grid.n_x - 1 ||
                           e / grown.grid.n_x == 0 || e / grown.grid.n_x == grown.grid.n_y - 1));
    const double first_width = 2. * on_head.side.semi_axis_y + 4. * on_head.grid.dy,
                 width       = grown.grid.n_y * on_head.grid.dy;
    std::printf("    %sfirst guess %.1f mm wide, in the end %.1f mm\n", name.c_str(), first_width * 1e3,
                width * 1e3);
    check.that(name + "narrow first grid: holds the patch in the end", !border);
    check.relative(name + "narrow first grid: area [mm^2]", grown.area * 1e6, patch.area * 1e6, 1e-12);
    check.relative(name + "narrow first grid: p_max [MPa]", grown.max_pressure * 1e-6,
                   patch.max_pressure * 1e-6, 1e-6);
    // its y, and with it the pole of spin, begins at the point of contact
    check.relative(name + "narrow first grid: xi [1e-3]", grown.creepage * 1e3,
                   (c.tangential.longitudinal - on_head.rolling.spin * on_head.shift) * 1e3, 1e-5);
    check.relative(name + "narrow first grid: Fn [kN]", grown.normal_force * 1e-3, 80., 1e-12);
    return width > 1.2 * first_width;
  }

  /// The same spin as the change of the rolling radius of a cone, and that of a hollow tread, whose power
  /// must be that of the shear stresses over their slip, which converges with the element size.
  void cone_and_hollow_tread(tread::tests::Check &check,
                             const std::string   &name,
                             RollingCase          c,
                             const RollingResult &with_spin)
  {
    const double spin = c.spin;
    c.spin            = 0.;
    c.radius_change   = [&](const double y) {
      return spin * y;
    };
    const RollingResult cone = solve_rolling(c);
    check.relative(name + "cone: xi [1e-3]", cone.creepage * 1e3, with_spin.creepage * 1e3, 1e-6);
    check.relative(name + "cone: power [W]", cone.power_balance, with_spin.power_balance, 1e-6);
    c.radius_change = [&](const double y) {
      return spin * y + 20. * y * y;
    };
    const RollingResult hollow = solve_rolling(c);
    check.relative(name + "hollow tread: Fx [kN]", hollow.longitudinal_force * 1e-3, 8., 1e-5);
    c.element_size /= 2.;
    const double power_finer = solve_rolling(c).frictional_power;
    check.relative(name + "hollow tread: power [W], extrapolated", hollow.power_balance,
                   2. * power_finer - hollow.frictional_power, 0.03);
    check.that(name + "hollow tread: creeps less, as its radius is larger beside the middle",
               hollow.creepage > cone.creepage);
  }

  void rail_head(tread::tests::Check &check)
  {
    std::printf("\n--- head of 54E1 under a conical tread, R = 460 mm, that touches it 0 to 8 mm beside the "
                "crown; 80 kN\n");
    Patch        before{1e9, 0.};
    unsigned int n_grown = 0;
    for (const double shift : {0., 2e-3, 4e-3, 6e-3, 8e-3})
      {
        const TreadOnHead     on_head(shift);
        const ContactSolution c     = on_head.solve();
        const Patch           patch = patch_on_head(check, on_head, c);
        between_both_arcs(check, on_head, c, patch, before);
        const RollingCase   narrow = on_head.narrow_case();
        const RollingResult grown  = solve_rolling(narrow);
        n_grown += narrow_first_grid(check, on_head, c, patch, grown);
        cone_and_hollow_tread(check, on_head.name, narrow, grown);
        before = patch;
      }
    check.that("narrow first grid: grew on the crown and beside it", n_grown >= 3);
  }

  void two_patches(tread::tests::Check &check)
  {
    std::printf("\n--- two patches: a flat-bottomed valley, loaded as one body\n");
    const ElasticPair pair = combine(Elastic{}, Elastic{});
    const Grid        grid = centred_grid(6e-3, 16e-3, 0.4e-3);
    NormalProblem     normal;
    normal.force = 60e3;
    normal.gap   = make_gap(grid, [](const double x, const double y) {
      const double d = std::abs(y) - 9e-3;
      return x * x / 0.92 + d * d / 0.1;
    });
    TangentialProblem rolling;
    rolling.friction            = 0.3;
    rolling.longitudinal        = -1e-3;
    const ContactSolution c     = solve_contact(grid, pair, normal, rolling);
    const HertzEllipse    half  = hertz_ellipse(1. / 0.92, 1. / 0.1, pair.hertz_modulus(), 30e3);
    double                upper = 0.;
    for (std::size_t e = 0; e < grid.size(); ++e)
      upper += grid.y(e / grid.n_x) > 0. ? c.normal.pressure[e] * grid.element_area() : 0.;
    check.relative("each carries half [kN]", upper * 1e-3, 30., 1e-6);
    // at 18 mm each patch tilts and sinks the other's ground: the pressure stays Hertz's nearly, the approach
    // grows by 1/(pi E* 18 mm) N/2
    check.relative("p_max against Hertz for half the load [MPa]", largest(c.normal.pressure) * 1e-6,
                   half.max_pressure * 1e-6, 0.01);
    check.relative("approach with the neighbour's share [um]", c.normal.approach * 1e6,
                   (half.approach + 30e3 / (M_PI * pair.hertz_modulus() * 18e-3)) * 1e6, 0.01);
    check.that("slip and adhesion in both",
               c.tangential.longitudinal_force > 0. && c.tangential.longitudinal_force < 0.3 * 60e3);

    // prescribed approach gives the force back
    NormalProblem by_approach   = normal;
    by_approach.prescribe_force = false;
    by_approach.approach        = c.normal.approach;
    FourierGrid          fourier(grid);
    const NormalOperator op(fourier, pair);
    check.relative("force of a prescribed approach [kN]", solve_normal(fourier, op, by_approach).force * 1e-3,
                   60., 1e-6);
  }

  void unlike_bodies(tread::tests::Check &check)
  {
    std::printf("\n--- unlike bodies\n");
    const Elastic     steel{207e9, 0.3}, aluminium{70e9, 0.33};
    const ElasticPair pair = combine(aluminium, steel);
    {
      // Pressure on a strip stretches both surfaces: du_x/dx = -2 K/G p at each point (plane strain)
      const unsigned int     n = 60;
      const Grid             grid{n, 1, 0.1e-3, 10., 0., 0.};
      FourierGrid            fourier(grid);
      const CouplingOperator coupling(fourier, pair, {{1., 0.}});
      Field                  p(n), u(2 * n), q(2 * n, 0.), w(n);
      for (unsigned int i = 0; i < n; ++i)
        p[i] = 1e9 * (1. + std::sin(0.3 * i));
      coupling.tangential_by_pressure(p.data(), u.data());
      // between the centres of two elements lie two halves; the strip is 10 m long: errors (6 mm/10 m)
      check.relative("strain under pressure", (u[31] - u[30]) / grid.dx,
                     -2. * pair.coupling / pair.shear * 0.5 * (p[30] + p[31]), 1e-3);
      for (unsigned int i = 0; i < n; ++i)
        q[i] = 1e8 * std::cos(0.2 * i * i);
      coupling.normal_by_traction(q.data(), w.data());
      double one = 0., two = 0.;
      for (unsigned int i = 0; i < n; ++i)
        one += p[i] * w[i], two += q[i] * u[i];
      check.relative("Betti: work of one load on the other's displacement", one, two, 1e-10);
    }

    RollingCase c;
    c.curvature_x = c.curvature_y = 1. / 0.1;
    c.normal_force                = 2e3;
    c.friction                    = 0.2;
    c.wheel                       = aluminium;
    c.rail                        = steel;
    c.traction_coefficient        = 0.;
    c.element_size                = 0.04e-3;
    const RollingResult r         = solve_rolling(c);
    std::swap(c.wheel, c.rail);
    const RollingResult s = solve_rolling(c);
    std::printf("    free rolling of aluminium on steel: creepage %.4e, largest shear %.3f f p0, slip in "
                "%.1f %% of the patch\n",
                r.creepage, r.max_shear / (c.friction * r.max_pressure), 100. * (1. - r.adhesion_share));
    double shear = 0., pressure = 0.;
    for (std::size_t e = 0; e < r.x.size(); ++e)
      {
        shear    = std::max(shear, std::hypot(r.shear_x[e] + s.shear_x[e], r.shear_y[e] + s.shear_y[e]));
        pressure = std::max(pressure, std::abs(r.pressure[e] - s.pressure[e]));
      }
    // each side is solved to 1e-6 f p0; the two turn about each other until the pressure moves by 1e-7
    check.that("free rolling has creepage", std::abs(r.creepage) > 1e-5);
    check.below("Fx/Fn", r.traction_coefficient, 1e-7);
    check.relative("bodies exchanged: creepage changes its sign", s.creepage, -r.creepage, 1e-4);
    check.below("bodies exchanged: shear changes its sign, over f p0", shear / (c.friction * r.max_pressure),
                1e-4);
    check.below("bodies exchanged: same pressure, over p0", pressure / r.max_pressure, 1e-5);
    check.relative("force [kN]", r.normal_force * 1e-3, 2., 1e-9);
    // shear changes the pressure by about f K, here below 1 %
    check.relative("p_max against Hertz [MPa]", r.max_pressure * 1e-6, r.hertz.max_pressure * 1e-6, 0.02);
  }

  /// In a plane of its own a patch dissipates what it does as an ellipse; where bodies are unlike, the moment
  /// of their pressure has a part in it.
  void planar_power(tread::tests::Check &check)
  {
    RollingCase c;
    c.curvature_x = c.curvature_y = 1. / 0.1;
    c.normal_force                = 2e3;
    c.friction                    = 0.2;
    c.wheel                       = {70e9, 0.33};
    c.rail                        = {207e9, 0.3};
    c.prescribe_force             = false;
    c.creepage                    = -2e-3;
    c.element_size                = 0.04e-3;
    const RollingResult r         = solve_rolling(c);

    PlanarCase planar;
    static_cast<Friction &>(planar) = c;
    planar.grid                     = r.grid;
    planar.gap                      = [&](const double x, const double y) {
      return c.curvature_x * x * x + c.curvature_y * y * y;
    };
    planar.normal_force  = c.normal_force;
    planar.longitudinal  = c.creepage;
    planar.wheel         = c.wheel;
    planar.rail          = c.rail;
    planar.order         = 1;
    const PlanarResult p = solve_planar(planar);
    check.relative("unlike bodies in a plane: force along, N", p.longitudinal_force, r.longitudinal_force,
                   1e-4);
    check.relative("unlike bodies in a plane: power, W", p.frictional_power, r.power_balance, 1e-4);
    check.that("to which the moment of the pressure belongs",
               std::abs(p.frictional_power + p.longitudinal_force * c.creepage) > 0.005 * p.frictional_power);
  }

  // A transient step that starts from steady rolling must stay there, for unlike bodies too; and so must the
  // answer from any start.
  void steady_is_steady(tread::tests::Check &check)
  {
    std::printf("\n--- a transient step from steady rolling; normal problem from a poor start\n");
    for (const bool alike : {true, false})
      {
        const ElasticPair  pair  = combine(alike ? Elastic{} : Elastic{70e9, 0.33}, Elastic{});
        const HertzEllipse hertz = hertz_ellipse(10., 6., pair.hertz_modulus(), 1e3);
        const Grid         grid =
          centred_grid(1.1 * hertz.semi_axis_x, 1.1 * hertz.semi_axis_y, hertz.semi_axis_x / 12.);
        NormalProblem normal;
        normal.force = 1e3;
        normal.gap = make_gap(grid, [](const double x, const double y) { return 10. * x * x + 6. * y * y; });
        TangentialProblem rolling;
        rolling.friction                = 0.25;
        rolling.longitudinal            = -1e-3;
        rolling.lateral                 = 4e-4;
        rolling.spin                    = 0.5;
        rolling.tolerance               = 1e-9;
        const ContactSolution c         = solve_contact(grid, pair, normal, rolling);
        rolling.motion                  = Motion::transient;
        rolling.previous_shear_x        = c.tangential.shear_x;
        rolling.previous_shear_y        = c.tangential.shear_y;
        const TangentialSolution next   = solve_tangential(grid, pair, c.normal.pressure, rolling);
        double                   change = 0.;
        for (std::size_t e = 0; e < grid.size(); ++e)
          change = std::max(change, std::hypot(next.shear_x[e] - c.tangential.shear_x[e],
                                               next.shear_y[e] - c.tangential.shear_y[e]));
        // both solved to 1e-9 f p0 of their own scaling, whose ratio is the patch's length in elements
        check.below(std::string(alike ? "like" : "unlike") + " bodies: change of the shear over f p0",
                    change / (0.25 * hertz.max_pressure), 1e-6);

        // all load on one element at the wrong place: same answer
        NormalProblem poor = normal;
        poor.initial_pressure.assign(grid.size(), 0.);
        poor.initial_pressure[grid.size() / 3] = 1.;
        FourierGrid          fourier(grid);
        const NormalOperator op(fourier, pair);
        const NormalSolution first  = solve_normal(fourier, op, normal),
                             second = solve_normal(fourier, op, poor);
        double difference           = 0.;
        for (std::size_t e = 0; e < grid.size(); ++e)
          difference = std::max(difference, std::abs(first.pressure[e] - second.pressure[e]));
        check.below("start from one element: change of the pressure over p0", difference / hertz.max_pressure,
                    1e-5);
      }
  }

  void frictionless(tread::tests::Check &check)
  {
    std::printf("\n--- without friction\n");
    for (const bool alike : {true, false})
      {
        RollingCase c;
        c.curvature_x     = 10.;
        c.curvature_y     = 6.;
        c.normal_force    = 1e3;
        c.speed           = 20.;
        c.wheel           = alike ? Elastic{} : Elastic{70e9, 0.33};
        c.element_size    = 0.1e-3;
        c.prescribe_force = false;
        c.creepage        = 2e-3;
        c.spin            = 0.1;
        const std::string   name(alike ? "like bodies: " : "unlike bodies: ");
        const RollingResult none   = solve_rolling(c);
        c.friction                 = 1e-7;
        const RollingResult hardly = solve_rolling(c);
        check.below(name + "shear [MPa]", none.max_shear * 1e-6, 0.);
        check.below(name + "adhesion share", none.adhesion_share, 0.);
        check.relative(name + "p_max as with friction 1e-7 [MPa]", none.max_pressure * 1e-6,
                       hardly.max_pressure * 1e-6, 1e-7);
        // the tractions of friction 1e-7 shift the slip by some 1e-7 p/G = 1e-9 of the creepage's 2e-3
        double difference = 0.;
        for (std::size_t e = 0; e < none.x.size(); ++e)
          difference = std::max(
            difference, std::hypot(none.slip_x[e] - hardly.slip_x[e], none.slip_y[e] - hardly.slip_y[e]));
        check.below(name + "slip as with friction 1e-7, over the largest", difference / hardly.max_slip,
                    1e-5);
        check.that(name + "stretching by pressure is part of the slip of unlike bodies only",
                   (std::abs(none.slip_x[none.x.size() / 2] / (c.speed * c.creepage) - 1.) < 1e-9) == alike);
      }
  }

  void bad_input(tread::tests::Check &check)
  {
    std::printf("\n--- bad input: one line that names the argument and what is allowed\n");
    const auto refused = [&](const std::string &what, const std::string &name,
                             const std::function<void()> &call) {
      const std::string got = tread::tests::complaint<std::invalid_argument>(call);
      std::printf("    %s\n", got.c_str());
      check.that(what, got.find(name) != std::string::npos && got.find("allowed") != std::string::npos &&
                         got.find('\n') == std::string::npos);
    };
    RollingCase good;
    good.curvature_x  = 1. / 0.92;
    good.curvature_y  = 1. / 0.6;
    good.normal_force = 100e3;
    good.friction     = 0.5;
    good.element_size = 1.3e-3;
    const auto with   = [&](const std::function<void(RollingCase &)> &change) {
      return [good, change] {
        RollingCase c = good;
        change(c);
        solve_rolling(c);
      };
    };
    refused("negative force", "normal_force", with([](RollingCase &c) { c.normal_force = -1.; }));
    refused("no force, no contact", "no contact", with([](RollingCase &c) { c.normal_force = 0.; }));
    refused("force beyond f N", "traction_coefficient",
            with([](RollingCase &c) { c.traction_coefficient = -0.6; }));
    refused("force equal to f N", "traction_coefficient",
            with([](RollingCase &c) { c.traction_coefficient = 0.5; }));
    refused("negative friction", "friction", with([](RollingCase &c) { c.friction = -0.1; }));
    refused("force without friction", "traction_coefficient",
            with([](RollingCase &c) { c.friction = 0., c.traction_coefficient = 0.1; }));
    refused("no curvature", "curvature_y", with([](RollingCase &c) { c.curvature_y = 0.; }));
    refused("NaN creepage", "creepage",
            with([](RollingCase &c) { c.prescribe_force = false, c.creepage = NAN; }));
    refused("elements too large", "element_size", with([](RollingCase &c) { c.element_size = 4e-3; }));
    refused("elements too small", "element_size", with([](RollingCase &c) { c.element_size = 1e-6; }));
    refused("Young's modulus", "Young's modulus of the wheel",
            with([](RollingCase &c) { c.wheel.young = 0.; }));

    const ElasticPair    pair = combine(Elastic{}, Elastic{});
    const Grid           grid = centred_grid(4e-3, 4e-3, 1e-3);
    FourierGrid          fourier(grid);
    const NormalOperator op(fourier, pair);
    NormalProblem        normal;
    normal.gap = make_gap(grid, [](const double x, const double y) { return 1e-4 + x * x + y * y; });
    normal.prescribe_force = false;
    normal.approach        = 0.5e-4;
    refused("approach without contact", "approach", [&] { solve_normal(fourier, op, normal); });
    normal.gap.pop_back();
    refused("gap of wrong size", "size of gap", [&] { solve_normal(fourier, op, normal); });
    // Each field by itself: all have a length of their own.
    const std::pair<const char *, Field TangentialProblem::*> fields[] = {
      {"previous_shear_x", &TangentialProblem::previous_shear_x},
      {"previous_shear_y", &TangentialProblem::previous_shear_y},
      {"before_shear_x", &TangentialProblem::before_shear_x},
      {"before_shear_y", &TangentialProblem::before_shear_y},
      {"previous_pressure", &TangentialProblem::previous_pressure},
      {"friction_share", &TangentialProblem::friction_share},
      {"initial_shear_x", &TangentialProblem::initial_shear_x},
      {"initial_shear_y", &TangentialProblem::initial_shear_y}};
    for (const auto &[name, field] : fields)
      {
        TangentialProblem longer;
        longer.friction = 0.3;
        longer.*field   = Field(grid.size() + 1, 0.);
        refused(std::string(name) + " of wrong size", std::string("size of ") + name,
                [&] { solve_tangential(grid, pair, Field(grid.size(), 1e8), longer); });
      }
    TangentialProblem t;
    t.friction = 0.3;
    refused("tangential problem without contact", "no contact",
            [&] { solve_tangential(grid, pair, Field(grid.size(), 0.), t); });
    t.prescribe_lateral_force = true;
    t.lateral_force           = 1e9;
    refused("tangential force beyond f N", "tangential force",
            [&] { solve_tangential(grid, pair, Field(grid.size(), 1e8), t); });

    // a grid that cuts the patch is reported...
    normal.gap             = make_gap(grid, [](const double x, const double y) { return x * x + y * y; });
    normal.prescribe_force = true;
    normal.force           = 500e3;
    check.that("a grid that cuts the patch is marked", solve_normal(fourier, op, normal).cut);
    normal.force = 1e3;
    check.that("a grid that holds it is not", !solve_normal(fourier, op, normal).cut);
    // ... and it is, at whichever side that happens
    for (const auto &[dx, dy] : {std::pair{0., 0.}, {3.5e-3, 0.}, {-3.5e-3, 0.}, {0., 3.5e-3}, {0., -3.5e-3}})
      {
        normal.gap   = make_gap(grid, [dx = dx, dy = dy](const double x, const double y) {
          return (x - dx) * (x - dx) + (y - dy) * (y - dy);
        });
        normal.force = 1e3;
        char name[60];
        std::snprintf(name, sizeof name, "patch at %+.1f, %+.1f mm is cut", 1e3 * dx, 1e3 * dy);
        check.absolute(name, solve_normal(fourier, op, normal).cut, dx != 0. || dy != 0., 0.);
      }

    // ... and coarse grids chosen by solve_rolling hold it
    for (const double size : {1.6e-3, 1.3e-3, 1e-3, 0.7e-3})
      {
        RollingCase c     = good;
        c.element_size    = size;
        const auto result = solve_rolling(c);
        bool       border = false;
        for (std::size_t e = 0; e < result.x.size(); ++e)
          if (e % result.grid.n_x == 0 || e % result.grid.n_x == result.grid.n_x - 1 ||
              e / result.grid.n_x == 0 || e / result.grid.n_x == result.grid.n_y - 1)
            border = border || result.pressure[e] > 0.;
        check.that("the grid holds the patch", !border);
      }

    // ... and a patch that lies beside the middle of its first grid, to any side, is not cut
    for (const auto &[dx, dy] : {std::pair{6e-3, 0.}, {-6e-3, 0.}, {0., 6e-3}, {0., -6e-3}})
      {
        RollingCase c     = good;
        c.prescribe_force = false;
        c.gap             = [&, dx = dx, dy = dy](const double x, const double y) {
          return good.curvature_x * (x - dx) * (x - dx) + good.curvature_y * (y - dy) * (y - dy);
        };
        const auto result = solve_rolling(c);
        char       name[60];
        std::snprintf(name, sizeof name, "patch %+.0f, %+.0f mm beside: largest pressure, MPa", 1e3 * dx,
                      1e3 * dy);
        check.relative(name, 1e-6 * *std::max_element(result.pressure.begin(), result.pressure.end()),
                       1e-6 * result.hertz.max_pressure, 0.01);
      }

    // creepage for a traction: positive for driving, odd in the force
    RollingCase c          = good;
    c.traction_coefficient = 0.3;
    const double driving   = creepage_for_traction(c);
    c.traction_coefficient = -0.3;
    check.that("driving creepage is positive", driving > 0.);
    check.relative("braking creepage [1e-3]", creepage_for_traction(c) * 1e3, -driving * 1e3, 1e-5);
    c.prescribe_force = false;
    c.creepage        = -driving;
    check.relative("the creepage gives the traction back", estimate_rolling(c).traction_coefficient.value,
                   0.3, 1e-5);
  }
} // namespace reference_gap

TREAD_TEST(reference_gap)(tread::tests::Check &check, const tread::tests::Arguments &)
{
  rail_head(check);
  two_patches(check);
  unlike_bodies(check);
  planar_power(check);
  steady_is_steady(check);
  frictionless(check);
  bad_input(check);
}
