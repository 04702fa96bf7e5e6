// SPDX-License-Identifier: LGPL-2.1-or-later
// A coefficient that falls with the slip speed: does each node get the one of its own slip, in the impulses,
// in what counts as adhesion, and in the friction work? One node against the closed form by Lambert's
// function, a block that slides to rest against its equation of motion, and what every law has to do that a
// scene can name.
#include <tread/contact/contact.h>
#include <tread/contact/exponential_friction.h>

#include "boxes.h"
#include "check.h"
#include <boost/math/special_functions/lambert_w.hpp>

#include <algorithm>
#include <stdexcept>

using namespace tread;
using tests::Check;
using dealii::Point;

namespace contact_falling_friction
{
  constexpr double static_coefficient = 0.5, kinetic_coefficient = 0.2, slip_speed = 0.5; // m/s
  constexpr double fall    = static_coefficient - kinetic_coefficient;
  constexpr double gravity = 9.81; // m/s^2

  /// The law once more, from its formula.
  double coefficient(const double s)
  {
    return kinetic_coefficient + fall * std::exp(-s / slip_speed);
  }

  /// A node of unit mass on a rigid plane, in one step of the solver.
  struct OneNode
  {
    double slip, tangential; ///< m/s; N s
    bool   slips;
  };

  /// @param free_slip, approach its velocity without contact along and towards the plane, m/s
  /// @param start tangential impulse from which the sweeps start, N s
  OneNode solve(const FrictionLaw &law, const double free_slip, const double approach, const double start)
  {
    ContactProblem problem;
    problem.constraints = {{Vector3{0., 0., 1., 0.}, 1e-6, 1., 0, 2, 0}};
    problem.entries     = {{0, -1., 0.}, {1, 1., 1.}};
    Strips                  strips(problem);
    std::vector<Vector3>    velocity{Vector3{}, Vector3{free_slip, 0., -approach, 0.}};
    std::vector<Vector3>    impulse{Vector3{-start, 0., start > 0. ? approach : 0., 0.}};
    std::vector<char>       slips;
    CoulombSolverParameters parameters;
    parameters.tolerance = 1e-15;
    solve_coulomb(problem, law, parameters, strips, {Vector3{}}, velocity, impulse, slips);
    return {velocity[1][0], -impulse[0][0], bool(slips[0])};
  }

  /// Roots of s + stopping f(s) = free_slip, the lesser first: s = d + s_c W(-(stopping fall/s_c)
  /// exp(-d/s_c)) with d = free_slip - stopping f_k and the two real branches of Lambert's W; NaN where there
  /// are none.
  std::array<double, 2> closed_form(const double free_slip, const double stopping)
  {
    const double d        = free_slip - stopping * kinetic_coefficient;
    const double argument = -(stopping * fall / slip_speed) * std::exp(-d / slip_speed);
    if (argument < -std::exp(-1.))
      return {{std::nan(""), std::nan("")}};
    return {{d + slip_speed * boost::math::lambert_wm1(argument),
             d + slip_speed * boost::math::lambert_w0(argument)}};
  }

  void check_one_node(Check &check)
  {
    const ExponentialFriction law(static_coefficient, kinetic_coefficient, slip_speed);
    unsigned int              n_adhere = 0, n_slip = 0, n_with_two_more = 0;
    double                    slip_error = 0., impulse_error = 0., equation_error = 0., adhesion_error = 0.;
    bool                      states = true, same_from_anywhere = true;
    double                    if_static = 0.;
    for (const double stopping : {0.01, 0.5, 1., 3., 10.}) // steepness stopping |f'(0)|: 0.006 to 6
      for (const double over_bound : {0.2, 0.999, 1.001, 1.5, 3.})
        {
          const double  free_slip = over_bound * stopping * static_coefficient;
          const OneNode node      = solve(law, free_slip, stopping, 0.);
          // Where it starts from does not matter: not even from slip.
          for (const double start : {0.3, 1.2})
            same_from_anywhere &=
              std::abs(solve(law, free_slip, stopping, start * kinetic_coefficient * stopping).slip -
                       node.slip) < 1e-12 * free_slip;
          const auto [lesser, greater] = closed_form(free_slip, stopping);
          if (over_bound < 1.)
            {
              ++n_adhere;
              n_with_two_more += lesser > 0. && greater > lesser;
              states &= !node.slips;
              adhesion_error = std::max({adhesion_error, std::abs(node.slip) / free_slip,
                                         std::abs(node.tangential / free_slip - 1.)});
            }
          else
            {
              ++n_slip;
              states &= node.slips && !(lesser > 0.);
              slip_error = std::max(slip_error, std::abs(node.slip / greater - 1.));
              impulse_error =
                std::max(impulse_error, std::abs(node.tangential / (coefficient(greater) * stopping) - 1.));
              equation_error =
                std::max(equation_error,
                         std::abs(node.slip + stopping * coefficient(node.slip) - free_slip) / free_slip);
              if_static = std::max(if_static, std::abs(static_coefficient / coefficient(greater) - 1.));
            }
        }
    std::printf("one node: %u adhere, of which %u could slip in two ways; %u slip\n", n_adhere,
                n_with_two_more, n_slip);
    // Round-off: the speeds are differences of some m/s, the least slip is 1e-3 of them.
    check.below("one node: slip against Lambert's function, share", slip_error, 1e-10);
    check.below("one node: impulse against the law at that slip, share", impulse_error, 1e-10);
    check.below("one node: equation of its own slip, share", equation_error, 1e-13);
    check.below("one node: adhesion stops it, share", adhesion_error, 1e-14);
    check.that("one node: state is adhesion below the static bound, slip above", states);
    check.that("one node: least root, from wherever the sweeps start", same_from_anywhere);
    check.that("one node: where it adheres there are other roots too", n_with_two_more >= 2);
    check.that("one node: the coefficient at no slip would be noticed", if_static > 0.1);
  }

  /// Four nodes of a block's lower side on a rigid plane, with the block's mass and nothing between them. It
  /// weighs the same at any slip, and nothing vibrates.
  class Block
  {
  public:
    static constexpr double edge = 0.02, mass = 1., time_step = 1e-4; // m, kg, s

    explicit Block(const FrictionLaw &law)
      : mesh(MPI_COMM_WORLD,
             {tests::make_box("block",
                              Point<3>(0., 0., 0.),
                              Point<3>(edge, edge, edge),
                              {{1, 1, 1}},
                              {{tests::Side::bottom, Boundary::contact}}),
              tests::make_box(
                "plane",
                Point<3>(-0.05, -0.05, -0.05),
                Point<3>(0.95, 0.07, 0.),
                {{20, 2, 1}},
                {{tests::Side::bottom, Boundary::support}, {tests::Side::top, Boundary::contact}})})
      , contact(mesh, ContactParameters(), std::shared_ptr<const FrictionLaw>(&law, [](auto *) {}))
      , x(mesh.nodes.size(), Vector3{})
      , v(mesh.nodes.size(), Vector3{})
      , inverse_mass(mesh.nodes.size(), 0.)
    {
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        {
          x[i] = Vector3{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
          if (mesh.node_bodies[i] == 0 && mesh.nodes[i][2] < 0.5 * edge)
            {
              nodes.push_back(i);
              inverse_mass[i] = 4. / mass;
            }
        }
      contact.set_inverse_masses(inverse_mass);
      contact.refresh(x.data(), v.data(), time_step);
    }

    void set_speed(const double speed)
    {
      for (const unsigned int i : nodes)
        v[i] = Vector3{speed, 0., 0., 0.};
    }

    double speed() const
    {
      return v[nodes[0]][0];
    }

    double kinetic_energy() const
    {
      double energy = 0.;
      for (const unsigned int i : nodes)
        energy += 0.5 / inverse_mass[i] * dot(v[i], v[i]);
      return energy;
    }

    /// @param push, lift forces on the block along the plane and upwards, N
    void step(const double push, const double lift = 0.)
    {
      if (contact.refresh_due())
        contact.refresh(x.data(), v.data(), time_step);
      NodalField          force(mesh.nodes.size(), Vector3{});
      std::vector<double> nothing;
      for (const unsigned int i : nodes)
        force[i] = Vector3{push / 4., 0., lift / 4. - gravity / inverse_mass[i], 0.};
      contact.predict(v.data(), force.data(), time_step, nothing);
      contact.solve(time_step, force.data());
      for (const unsigned int i : nodes)
        {
          v[i] += time_step * inverse_mass[i] * force[i];
          x[i] += time_step * v[i];
        }
    }

    Mesh    mesh;
    Contact contact;

  private:
    NodalField                x, v;
    std::vector<double>       inverse_mass;
    std::vector<unsigned int> nodes;
  };

  /// All nodes in this state, with this coefficient (to round-off of the solver), which is that of their
  /// slip.
  bool all_are(const Block &block, const bool adhesion)
  {
    const std::vector<ContactNodeState> states = block.contact.active_nodes();
    return states.size() == 4 &&
           std::all_of(states.begin(), states.end(), [&](const ContactNodeState &state) {
             const double  normal     = dot(state.impulse, state.normal);
             const Vector3 tangential = state.impulse - normal * state.normal;
             const double  bound      = coefficient(std::sqrt(dot(state.slip, state.slip))) * normal;
             const double  size       = std::sqrt(dot(tangential, tangential));
             return state.adhesion == adhesion &&
                    (adhesion ? size < bound : std::abs(size / bound - 1.) < 1e-9);
           });
  }

  void check_block(Check &check)
  {
    const ExponentialFriction law(static_coefficient, kinetic_coefficient, slip_speed);
    Block                     block(law);
    const double              start = 1.; // m/s
    block.set_speed(start);
    const double energy = block.kinetic_energy();

    // The same in steps of its own: v' = v - g f(v') dt by bisection. And m dv/dt = -f(v) m g by the
    // classical method of Runge and Kutta, in steps of its own.
    double       in_steps = start, of_equation = start;
    const double dt           = Block::time_step;
    const auto   acceleration = [](const double v) {
      return -gravity * coefficient(v);
    };
    double       friction = 0., adhesion = 0., steps_apart = 0., equation_apart = 0., energy_apart = 0.;
    bool         slipped = true;
    unsigned int n       = 0;
    while (block.speed() > 0.01)
      {
        block.step(0.);
        ++n;
        friction += block.contact.last_work().friction;
        adhesion += block.contact.last_work().adhesion;
        slipped &= all_are(block, false);
        double low = 0., high = in_steps;
        for (unsigned int k = 0; k < 60; ++k)
          {
            const double middle                                                   = 0.5 * (low + high);
            (middle + gravity * coefficient(middle) * dt < in_steps ? low : high) = middle;
          }
        in_steps = low;
        for (unsigned int k = 0; k < 4; ++k)
          {
            const double h = dt / 4., k1 = acceleration(of_equation),
                         k2 = acceleration(of_equation + 0.5 * h * k1),
                         k3 = acceleration(of_equation + 0.5 * h * k2),
                         k4 = acceleration(of_equation + h * k3);
            of_equation += h / 6. * (k1 + 2. * k2 + 2. * k3 + k4);
          }
        steps_apart    = std::max(steps_apart, std::abs(block.speed() - in_steps));
        equation_apart = std::max(equation_apart, std::abs(block.speed() - of_equation));
        energy_apart   = std::max(energy_apart, std::abs(friction + block.kinetic_energy() - energy));
      }
    std::printf("block: slid from %.2f to %.4f m/s in %u steps\n", start, block.speed(), n);
    // The solver's tolerance is 1e-7 of an impulse of f g dt = 5e-4 m/s at most in each step; in practice the
    // nodes are alone, and one sweep is exact.
    check.below("block: speed against steps by bisection, m/s", steps_apart, 1e-10);
    // Backward steps lag by dt/2 g f(v) ln(f(v)/f(1 m/s)), 1.7e-4 m/s in the end.
    check.below("block: speed against the equation of motion, m/s", equation_apart, 2e-4);
    check.relative(
      "block: seconds to that speed", n * dt,
      [&]() {
        // Of v from start to the end, dv/(g f(v)), by Simpson's rule.
        const unsigned int intervals = 1000;
        const double       h         = (block.speed() - start) / intervals;
        double             sum       = 0.;
        for (unsigned int i = 0; i <= intervals; ++i)
          sum += (i == 0 || i == intervals ? 1. : i % 2 == 1 ? 4. : 2.) / acceleration(start + i * h);
        return sum * h / 3.;
      }(),
      1e-3);
    check.relative("block: friction work over loss of kinetic energy", friction,
                   energy - block.kinetic_energy(), 1e-9);
    check.below("block: the same in each step, share", energy_apart / energy, 1e-9);
    check.below("block: work of adhesion while it slides, share", adhesion / energy, 0.);
    check.that("block: every node slips at the bound of its own slip", slipped);
    check.that("block: the coefficient at no slip would be noticed",
               std::abs(start - gravity * static_coefficient * n * dt - block.speed()) > 0.1);

    // It comes to rest, and stays.
    while (block.speed() > 1e-12 && n++ < 10000)
      {
        block.step(0.);
        friction += block.contact.last_work().friction;
        adhesion += block.contact.last_work().adhesion;
      }
    check.relative("block at rest: all work over all kinetic energy", friction + adhesion, energy, 1e-9);
    check.that("block at rest: adheres", all_are(block, true));

    // A push between the kinetic and the static bound holds a block at rest and speeds one up that slides.
    const double push = 0.4 * Block::mass * gravity;
    for (unsigned int k = 0; k < 100; ++k)
      block.step(push);
    check.below("pushed at rest: speed, m/s", block.speed(), 1e-12);
    check.that("pushed at rest: adheres", all_are(block, true));
    block.set_speed(start);
    block.step(push);
    double expected = start;
    for (unsigned int k = 0; k < 60; ++k) // contracts: g |f'| dt < 1e-4
      expected = start + (0.4 - coefficient(expected)) * gravity * dt;
    check.absolute("pushed while it slides: gain of speed, mm/s", 1e3 * (block.speed() - start),
                   1e3 * (expected - start), 1e-9);
    check.that("pushed while it slides: slips", all_are(block, false));
    for (unsigned int k = 0; k < 100; ++k)
      block.step(0.55 * Block::mass * gravity);
    block.set_speed(0.);
    block.step(0.55 * Block::mass * gravity);
    check.that("pushed above the static bound: slips from rest", all_are(block, false) && block.speed() > 0.);
  }

  /// A law with memory: the coefficient follows that of the slip speed over a way of slip, recovers at rest
  /// with the least speed, and is that of a node which has not slid when it touches again.
  void check_memory(Check &check)
  {
    constexpr double way = 2e-3, least_speed = 0.05, dt = Block::time_step;
    ParameterTable   table;
    {
      Section section(table, "Contact");
      declare_friction_laws(section);
    }
    for (const auto &[name, value] :
         {std::pair("Kinetic friction coefficient", kinetic_coefficient),
          std::pair("Falling slip speed (m per s)", slip_speed), std::pair("Friction memory (mm)", 1e3 * way),
          std::pair("Least speed of memory (m per s)", least_speed)})
      check.that(std::string("memory: set ") + name,
                 table.set(*table.find(std::string("Contact/") + name), format("%.17g", value)));
    const Section section(table, "Contact");
    const auto    law = make_friction_law("falling", static_coefficient, table.handler());
    Block         block(*law);
    block.set_speed(1.);
    double     speed = 1., now = static_coefficient, apart = 0.;
    const auto age = [&]() {
      const double in_the_long_run = coefficient(speed);
      now = in_the_long_run + (now - in_the_long_run) * std::exp(-std::max(speed, least_speed) * dt / way);
    };
    for (unsigned int n = 0; n < 200; ++n)
      {
        block.step(0.);
        speed -= gravity * now * dt;
        age();
        apart = std::max(apart, std::abs(block.speed() - speed));
      }
    check.below("memory: speed of a block that slides, m/s", apart, 1e-10);
    check.that("memory: friction has fallen", now < 0.3);

    // It flies for some steps: the pairs begin anew.
    for (unsigned int n = 0; n < 5; ++n)
      block.step(0., 2. * Block::mass * gravity);
    unsigned int n_flown = 0;
    for (; block.contact.active_nodes().empty() && n_flown < 1000; ++n_flown)
      block.step(0.);
    double ratio = 0.;
    for (const ContactNodeState &state : block.contact.active_nodes())
      {
        const double  normal     = dot(state.impulse, state.normal);
        const Vector3 tangential = state.impulse - normal * state.normal;
        ratio                    = std::max(ratio, std::sqrt(dot(tangential, tangential)) / normal);
      }
    check.that("memory: the block has flown", n_flown > 3);
    check.relative("memory: coefficient of pairs that close again", ratio, static_coefficient, 1e-9);

    // Fallen again, it is stopped, and recovers while it stands.
    for (unsigned int n = 0; n < 200; ++n)
      block.step(0.3 * Block::mass * gravity);
    const double before_push = block.speed();
    block.step(0.);
    now                 = (before_push - block.speed()) / (gravity * dt);
    const double fallen = now;
    check.that("memory: friction has fallen once more", fallen < 0.35);
    speed = block.speed();
    age();
    block.set_speed(0.);
    speed = 0.;
    for (unsigned int n = 0; n < 200; ++n, age())
      block.step(0.);
    block.step(0.6 * Block::mass * gravity);
    check.relative("memory: coefficient after 20 ms of rest", 0.6 - block.speed() / (gravity * dt), now,
                   1e-6);
    check.that("memory: it has recovered in part", now > fallen + 0.05 && now < 0.98 * static_coefficient);
  }

  /// What a scene relies on, of every law that is registered.
  void check_registry(Check &check)
  {
    ParameterTable table;
    Section        section(table, "Contact");
    declare_friction_laws(section);
    for (const FrictionLawEntry &entry : friction_laws())
      {
        const std::string name = "law " + entry.name + ": ";
        check.that(name + "is described", !entry.description.empty());
        const auto law = make_friction_law(entry.name, static_coefficient, table.handler());
        check.relative(name + "coefficient without slip", law->coefficient(0.), static_coefficient, 1e-15);
        double error = 0., beyond_least = 0.;
        for (const double stopping : {1e-3, 1., 10., 100.})
          for (const double over_bound : {1.0001, 1.1, 10.})
            {
              const double free_slip = over_bound * stopping * static_coefficient;
              const double s         = law->slip(free_slip, stopping);
              error = std::max(error, std::abs(s + stopping * law->coefficient(s) - free_slip) / free_slip);
              // No root before it: a law that is neither convex nor flat could have one.
              constexpr unsigned int n_looks = 20000;
              for (unsigned int k = 0; k < n_looks; ++k)
                if (const double before = s * k / n_looks;
                    before + stopping * law->coefficient(before) > free_slip * (1. + 1e-12))
                  beyond_least = std::max(beyond_least, s - before);
            }
        check.below(name + "slip solves its equation, share", error, 1e-14);
        check.below(name + "way from the least root, m/s", beyond_least, 1e-12);
        bool negative = false;
        for (double s = 0.; s < 10.; s += 0.01)
          negative = negative || law->coefficient(s) < 0.;
        check.that(name + "never negative", !negative);
      }
    check.that("an unknown name is refused", !tests::complaint<std::invalid_argument>([&] {
                                                make_friction_law("Coulombs", static_coefficient,
                                                                  table.handler());
                                              }).empty());
    bool refused = false;
    try
      {
        make_friction_law("falling", 0.1, table.handler()); // below the kinetic coefficient
      }
    catch (const std::invalid_argument &)
      {
        refused = true;
      }
    check.that("a law that would rise is refused", refused);
  }
} // namespace contact_falling_friction

TREAD_TEST(contact_falling_friction)(Check &check, const tests::Arguments &)
{
  check_one_node(check);
  check_block(check);
  check_memory(check);
  check_registry(check);
}
