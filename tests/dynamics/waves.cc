// SPDX-License-Identifier: LGPL-2.1-or-later
// Waves with known speeds: bar, pressure and shear waves along a column of single cells, a Rayleigh wave in a
// half-space, and the dispersion that theory gives for lumped masses and central differences.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "boxes.h"
#include "check.h"

#include <algorithm>
#include <memory>

using namespace tread;
using dealii::Point;

namespace dynamics_waves
{
  constexpr double pi       = dealii::numbers::PI;
  constexpr double traction = 10e6; // Pa

  /// A box of cubes in explicit dynamics without damping.
  struct Box
  {
    std::unique_ptr<Mesh>             mesh;
    std::unique_ptr<Solid>            solid;
    std::unique_ptr<ExplicitDynamics> dynamics;
    NodeLoads                        *loads;
    NodalField                        internal;

    Box(const std::array<unsigned int, 3> &n,
        const double                       h,
        const ElasticMaterial             &material,
        const Boundary                     far_end)
    {
      const Body body = tests::make_box("box", Point<3>(), Point<3>(n[0] * h, n[1] * h, n[2] * h), n,
                                        {{tests::Side::right, far_end}});
      mesh            = std::make_unique<Mesh>(MPI_COMM_SELF, std::vector<Body>{body});
      solid = std::make_unique<Solid>(*mesh, std::vector<ElasticMaterial>{material}, SolidParameters());
      DynamicsParameters parameters;
      parameters.gravity       = 0.;
      parameters.damping_steps = 0.;
      dynamics                 = std::make_unique<ExplicitDynamics>(*mesh, *solid, parameters);
      dynamics->fix_nodes(dynamics->support_nodes(0));
      loads = &dynamics->add<NodeLoads>();
    }

    /// Nodes whose reference x (or another coordinate) is that given.
    std::vector<unsigned int> nodes_at(const double place, const unsigned int direction = 0) const
    {
      std::vector<unsigned int> nodes;
      for (unsigned int i = 0; i < mesh->nodes.size(); ++i)
        if (std::abs(mesh->nodes[i][direction] - place) < 1e-9)
          nodes.push_back(i);
      return nodes;
    }

    /// Rollers: an external force that balances the internal one in this direction, exact to the bit.
    void hold(const std::vector<unsigned int> &nodes, const unsigned int direction)
    {
      for (const unsigned int i : nodes)
        loads->force[i][direction] = -internal[i][direction];
    }

    void evaluate_internal_forces()
    {
      internal.assign(mesh->nodes.size(), Vector3{});
      solid->add_internal_forces(dynamics->state.positions().data(), dynamics->state.v.data(),
                                 internal.data());
    }

    double mean_velocity(const std::vector<unsigned int> &nodes, const unsigned int direction) const
    {
      double sum = 0.;
      for (const unsigned int i : nodes)
        sum += dynamics->state.v[i][direction];
      return sum / nodes.size();
    }
  };

  /// Mean of a history over a window of time.
  struct WindowMean
  {
    double begin, end, sum = 0., time = 0.;
    void   add(const double now, const double step, const double value)
    {
      if (now >= begin && now <= end)
        {
          sum += value * step;
          time += step;
        }
    }
    double mean() const
    {
      return sum / time;
    }
  };

  /// First time at which a history reaches a level, between two steps by interpolation.
  struct Arrival
  {
    double level, time = -1., last_value = 0., last_time = 0.;
    void   add(const double now, const double value)
    {
      if (time < 0. && value >= level)
        time = last_time + (level - last_value) / (value - last_value) * (now - last_time);
      last_value = value;
      last_time  = now;
    }
  };

  void bar_wave(tests::Check &check)
  {
    constexpr unsigned int n = 200;
    constexpr double       h = 1e-3, length = n * h;
    ElasticMaterial        material;
    material.poisson_ratio = 0.;
    const double c0        = std::sqrt(material.young_modulus / material.density);
    const double velocity  = traction / (material.density * c0);
    std::printf("bar wave: c0 = %.1f m/s, traction/(rho c0) = %.4f m/s\n", c0, velocity);

    for (const bool far_end_fixed : {false, true})
      {
        Box               bar({{n, 1, 1}}, h, material, far_end_fixed ? Boundary::support : Boundary::free);
        ExplicitDynamics &dynamics = *bar.dynamics;
        const auto loaded = bar.nodes_at(0.), middle = bar.nodes_at(0.5 * length), far = bar.nodes_at(length);
        for (const unsigned int i : loaded)
          bar.loads->force[i][0] = traction * h * h / 4.;
        dynamics.start();
        unsigned int last_cell = 0;
        for (unsigned int c = 0; c < bar.mesh->cells.size(); ++c)
          if (bar.mesh->cells[c].nodes[1] == far[0] || bar.mesh->cells[c].nodes[1] == far[1])
            last_cell = c;

        // Windows in units of length/c0; the front is smeared over some cells, hence their margins.
        const double unit = length / c0;
        WindowMean   first{.1 * unit, 1.9 * unit}, later{2.2 * unit, 2.9 * unit},
          far_velocity{1.1 * unit, 2.9 * unit}, far_stress{1.2 * unit, 2.8 * unit};
        // A step that travels along lumped masses has reached 1/3 of its height at the exact time: the
        // front is the integral of Airy's function, and that from 0 to infinity is 1/3.
        Arrival front{velocity / 3.}, front_end{2. * velocity / 3.};
        while (dynamics.state.time < 3. * unit)
          {
            dynamics.step();
            const double t  = dynamics.state.time - 0.5 * dynamics.state.time_step,
                         dt = dynamics.state.time_step;
            first.add(t, dt, bar.mean_velocity(loaded, 0));
            later.add(t, dt, bar.mean_velocity(loaded, 0));
            far_velocity.add(t, dt, bar.mean_velocity(far, 0));
            front.add(t, bar.mean_velocity(middle, 0));
            front_end.add(t, bar.mean_velocity(far, 0));
            far_stress.add(dynamics.state.time, dt,
                           bar.solid->cauchy_stress(dynamics.state.positions().data())[last_cell][0]);
          }
        const std::string name = far_end_fixed ? "bar, fixed end: " : "bar, free end: ";
        // 200 cells: ripples behind the front average out to some 1e-3.
        check.relative(name + "loaded end (m/s)", first.mean(), velocity, 0.005);
        check.relative(name + "front at L/2 (us)", 1e6 * front.time, 1e6 * 0.5 * unit, 0.005);
        if (far_end_fixed)
          {
            check.relative(name + "stress there (MPa)", 1e-6 * far_stress.mean(), -2e-6 * traction, 0.005);
            check.relative(name + "loaded end after 2L/c0 (m/s)", later.mean(), -velocity, 8e-4);
          }
        else
          {
            check.relative(name + "front at L (us)", 1e6 * front_end.time, 1e6 * unit, 0.005);
            check.relative(name + "velocity there (m/s)", far_velocity.mean(), 2. * velocity, 0.005);
            check.relative(name + "loaded end after 2L/c0 (m/s)", later.mean(), 3. * velocity, 8e-4);
          }
      }
  }

  /// A smooth front of displacement along direction, running in x; everything else on rollers.
  void plane_wave(tests::Check      &check,
                  const unsigned int direction,
                  const double       speed,
                  const std::string &name)
  {
    constexpr unsigned int n = 200;
    constexpr double       h = 1e-3;
    const ElasticMaterial  material;
    Box                    column({{n, 1, 1}}, h, material, Boundary::free);
    ExplicitDynamics      &dynamics = *column.dynamics;
    dynamics.start();
    const auto loaded = column.nodes_at(0.), near = column.nodes_at(50 * h), away = column.nodes_at(150 * h);
    std::vector<unsigned int> all(column.mesh->nodes.size());
    for (unsigned int i = 0; i < all.size(); ++i)
      all[i] = i;
    const double velocity = traction / (material.density * speed), rise = 20. * h / speed;
    Arrival      at_near{0.5 * velocity}, at_away{0.5 * velocity};
    WindowMean   plateau{0., 1e9};
    while (dynamics.state.time < 190. * h / speed)
      {
        column.evaluate_internal_forces();
        for (unsigned int d = 0; d < 3; ++d)
          if (d != direction)
            column.hold(all, d);
        const double s = std::min(1., dynamics.state.time / rise);
        for (const unsigned int i : loaded)
          column.loads->force[i][direction] = 0.5 * (1. - std::cos(pi * s)) * traction * h * h / 4.;
        dynamics.step();
        const double t = dynamics.state.time - 0.5 * dynamics.state.time_step;
        at_near.add(t, column.mean_velocity(near, direction));
        at_away.add(t, column.mean_velocity(away, direction));
        if (t > 90. * h / speed && t < 180. * h / speed)
          plateau.add(t, dynamics.state.time_step, column.mean_velocity(near, direction));
      }
    // A front over 20 cells: wave lengths of 40 cells lag by (k h)^2/24 = 1e-3 at most.
    check.relative(name + " speed (m/s)", 100. * h / (at_away.time - at_near.time), speed, 0.005);
    check.relative(name + " velocity behind the front (m/s)", plateau.mean(), velocity, 0.005);
  }

  /// Standing wave between free ends: sin(omega dt/2) = (c dt/h) sin(k h/2) for lumped masses, exact in one
  /// dimension.
  void dispersion(tests::Check      &check,
                  const unsigned int direction,
                  const double       speed,
                  const std::string &name)
  {
    constexpr unsigned int n = 40;
    constexpr double       h = 1e-3;
    const ElasticMaterial  material;
    for (const unsigned int half_waves : {4u, 16u, 36u})
      {
        Box               column({{n, 1, 1}}, h, material, Boundary::free);
        ExplicitDynamics &dynamics = *column.dynamics;
        dynamics.start();
        const double              k = half_waves * pi / (n * h);
        std::vector<unsigned int> all(column.mesh->nodes.size());
        for (unsigned int i = 0; i < all.size(); ++i)
          {
            all[i]    = i;
            Vector3 x = dynamics.state.position(i);
            x[direction] += 1e-6 / k * std::cos(k * column.mesh->nodes[i][0]);
            dynamics.state.set_position(i, x);
          }
        const auto amplitude = [&]() {
          double sum = 0., norm = 0.;
          for (unsigned int i = 0; i < all.size(); ++i)
            {
              const double shape = std::cos(k * column.mesh->nodes[i][0]) * dynamics.true_masses()[i];
              sum += shape * (dynamics.state.position(i)[direction] - column.mesh->nodes[i][direction]);
              norm += shape * std::cos(k * column.mesh->nodes[i][0]);
            }
          return sum / norm;
        };
        // u(n+1) + u(n-1) = 2 cos(omega dt) u(n), from start velocities 0: u(1) - u(0) = (cos(omega dt) - 1)
        // 2 u(0).
        dynamics.start();
        const double before = amplitude();
        column.evaluate_internal_forces();
        for (unsigned int d = 0; d < 3; ++d)
          if (d != direction)
            column.hold(all, d);
        dynamics.step();
        const double after    = amplitude();
        const double measured = std::asin(std::sqrt((before - after) / (4. * before)));
        const double theory   = std::asin(speed * dynamics.state.time_step / h * std::sin(0.5 * k * h));
        char         what[100];
        std::snprintf(what, sizeof what, "%s, %.1f cells a wave: omega dt", name.c_str(),
                      2. * n / half_waves);
        // Strain 1e-6: StVenant-Kirchhoff differs by as much from linear; rounding of 1e-17 m over 1e-10 m
        // less.
        check.relative(what, 2. * measured, 2. * theory, 5e-6);
      }
  }

  /// Half a wave length of a standing Rayleigh wave between mirrors, one cell of plane strain, three wave
  /// lengths deep.
  void rayleigh_wave(tests::Check &check)
  {
    constexpr unsigned int n = 24, n_depth = 120;
    constexpr double       h = 1e-3;
    const ElasticMaterial  material;
    const double c_p = material.pressure_wave_speed(), c_s = material.shear_wave_speed(), c = 0.92741 * c_s;
    const double k = pi / (n * h), q = k * std::sqrt(1. - c * c / (c_p * c_p)),
                 s = k * std::sqrt(1. - c * c / (c_s * c_s)), b = 2. * k * q / (k * k + s * s);
    Box               block({{n, 1, n_depth}}, h, material, Boundary::free);
    ExplicitDynamics &dynamics = *block.dynamics;
    const double      top = n_depth * h, amplitude = 1e-7;
    NodalField        shape(block.mesh->nodes.size());
    for (unsigned int i = 0; i < shape.size(); ++i)
      {
        const double x = block.mesh->nodes[i][0], depth = top - block.mesh->nodes[i][2];
        shape[i] = Vector3{(-k * std::exp(-q * depth) + s * b * std::exp(-s * depth)) * std::sin(k * x), 0.,
                           (q * std::exp(-q * depth) - k * b * std::exp(-s * depth)) * std::cos(k * x), 0.} /
                   k;
        dynamics.state.set_position(i, dynamics.state.position(i) + amplitude * shape[i]);
      }
    dynamics.start();
    std::vector<unsigned int> all(shape.size());
    for (unsigned int i = 0; i < all.size(); ++i)
      all[i] = i;
    const auto left = block.nodes_at(0.), right = block.nodes_at(n * h);
    // Zero crossings of the mass-weighted amplitude over five periods.
    double              last = 0., last_time = 0.;
    std::vector<double> crossings;
    while (dynamics.state.time < 5.2 * 2. * pi / (c * k))
      {
        block.evaluate_internal_forces();
        block.hold(all, 1);
        block.hold(left, 0);
        block.hold(right, 0);
        dynamics.step();
        double now = 0.;
        for (unsigned int i = 0; i < all.size(); ++i)
          now += dynamics.true_masses()[i] *
                 dot(shape[i],
                     dynamics.state.position(i) - Vector3{block.mesh->nodes[i][0], block.mesh->nodes[i][1],
                                                          block.mesh->nodes[i][2], 0.});
        if (dynamics.state.n_steps > 1 && now * last < 0.)
          crossings.push_back(last_time + last / (last - now) * (dynamics.state.time - last_time));
        last      = now;
        last_time = dynamics.state.time;
      }
    const double period = 2. * (crossings.back() - crossings.front()) / (crossings.size() - 1);
    // 48 cells a wave: dispersion of 1e-3.
    check.relative("Rayleigh wave speed (m/s)", 2. * pi / (period * k), c, 0.005);
  }
} // namespace dynamics_waves


TREAD_TEST(dynamics_waves)(tests::Check &check, const tests::Arguments &)
{
  const ElasticMaterial material;
  check.absolute("pressure wave speed of steel (m/s)", material.pressure_wave_speed(), 6020.2, 0.1);
  check.absolute("shear wave speed of steel (m/s)", material.shear_wave_speed(), 3217.9, 0.1);
  bar_wave(check);
  plane_wave(check, 0, material.pressure_wave_speed(), "pressure wave:");
  plane_wave(check, 1, material.shear_wave_speed(), "shear wave:");
  dispersion(check, 0, material.pressure_wave_speed(), "pressure wave");
  dispersion(check, 1, material.shear_wave_speed(), "shear wave");
  rayleigh_wave(check);
}
