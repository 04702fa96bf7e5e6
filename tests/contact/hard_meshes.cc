// SPDX-License-Identifier: LGPL-2.1-or-later
// A block slides on a plate, stops and stands, on meshes that are hard on the coupling: much finer on one
// side, borders of cells of two sizes in the contact, slivers, distorted cells; and with a gap or an overlap
// at the start. Coulomb's law and the balances of momentum and energy do not depend on the mesh. The block is
// the slave: its sharp edges would cover faces of a slave plate in part, and such contact gives energy.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

using namespace tread;
using tests::Check;
using dealii::Point;

namespace contact_hard_meshes
{
  constexpr double gravity = 500., friction = 0.2, speed = 0.5; // m/s^2, -, m/s
  constexpr double edge = 0.02, height = 0.01;                  // of the block, m
  constexpr double x_begin = 0.01, y_begin = 0.01;              // of the block, m
  constexpr double settling = 0.008;                            // s, twenty periods of block on plate

  using Cells = std::array<unsigned int, 3>;

  Body plate(const Cells &n)
  {
    return tests::make_box("plate", Point<3>(0., 0., -0.01), Point<3>(0.06, 0.04, 0.), n,
                           {{tests::Side::bottom, Boundary::support}, {tests::Side::top, Boundary::contact}});
  }

  Body block(const Cells &n, const double gap = 0.)
  {
    return tests::make_box("block", Point<3>(x_begin, y_begin, gap),
                           Point<3>(x_begin + edge, y_begin + edge, gap + height), n,
                           {{tests::Side::bottom, Boundary::contact}});
  }

  /// Cells of half the size on one side of the middle of the way and of the block.
  Body refined_behind(Body body, const double x, const double cell_size)
  {
    body.wanted_cell_size = [=](const Point<3> &p) {
      return p[0] < x ? cell_size : std::numeric_limits<double>::max();
    };
    return body;
  }

  /// A cube of seven distorted cells that stands on the plate.
  Body distorted_block()
  {
    Body body = tests::make_patch_cube(edge);
    body.name = "block";
    for (Point<3> &p : body.vertices)
      p += Point<3>(x_begin, y_begin, 0.);
    body.boundary_at = [](const Point<3> &p) {
      return p[2] < 1e-6 ? Boundary::contact : Boundary::free;
    };
    return body;
  }

  struct Case
  {
    std::string name;
    Body        plate, block;
    double      damping  = 0.5;  ///< of the stiffness, in time steps
    bool        settles  = true; ///< the weight grows smoothly; else the block falls or is pushed out
    bool        hops     = !settles;
    double      standing = 0.01; ///< s
    double      drift    = 1e-5; ///< allowed, of the block's length: what still vibrates
  };

  struct Slide
  {
    Mesh             mesh;
    Solid            solid;
    ExplicitDynamics dynamics;
    NodeLoads       &loads = dynamics.add<NodeLoads>();
    Contact          contact;
    double           mass = 0.; ///< of the block, kg

    explicit Slide(const Case &test)
      : mesh(MPI_COMM_WORLD, {test.plate, test.block})
      , solid(mesh, {material(), material()}, SolidParameters())
      , dynamics(mesh, solid, dynamics_parameters(test))
      , contact(mesh, contact_parameters(), std::make_shared<CoulombFriction>(friction))
    {
      dynamics.fix_nodes(dynamics.support_nodes(0));
      dynamics.attach_contact(contact);
      of_block([&](const unsigned int, const double m) { mass += m; });
      dynamics.start();
    }

    /// Call add(node, mass in kg) for the nodes of the block.
    template <typename Add>
    void of_block(const Add &add) const
    {
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        if (mesh.node_bodies[i] == 1)
          add(i, dynamics.true_masses()[i]);
    }

    Vector3 velocity() const
    {
      Vector3 momentum{};
      of_block([&](const unsigned int i, const double m) { momentum += m * dynamics.state.v[i]; });
      return (1. / mass) * momentum;
    }

    void set_weight(const double share)
    {
      of_block([&](const unsigned int i, const double m) {
        loads.force[i] = Vector3{0., 0., -share * m * gravity, 0.};
      });
    }

    void settle()
    {
      while (dynamics.state.time < settling)
        {
          const double s = dynamics.state.time / settling;
          set_weight(s * s * (3. - 2. * s));
          dynamics.step();
        }
    }

    void push()
    {
      of_block([&](const unsigned int i, const double) {
        dynamics.state.v[i] += Vector3{speed, 0., 0., 0.};
      });
    }

    void stand(const double seconds)
    {
      for (const double end = dynamics.state.time + seconds; dynamics.state.time < end;)
        dynamics.step();
    }

  private:
    /// Soft and light, so that steps are long.
    static ElasticMaterial material()
    {
      ElasticMaterial rubber;
      rubber.young_modulus = 3e7;
      rubber.density       = 1000.;
      return rubber;
    }

    static DynamicsParameters dynamics_parameters(const Case &test)
    {
      DynamicsParameters parameters;
      parameters.gravity                       = 0.;
      parameters.damping_steps                 = test.damping;
      parameters.steps_between_damping_samples = 1;
      return parameters;
    }

    static ContactParameters contact_parameters()
    {
      ContactParameters parameters;
      parameters.slave_body        = 1;
      parameters.solver.tolerance  = 1e-12;
      parameters.solver.max_sweeps = 10000;
      return parameters;
    }
  };

  /// Until it has lost nine tenths of its speed; before that all of it slides.
  void check_sliding(Check &check, const std::string &name, const Case &test, Slide &slide)
  {
    ExplicitDynamics  &dynamics = slide.dynamics;
    const EnergyLedger at_first = dynamics.ledger();
    const Vector3      first    = slide.velocity();
    const double       begin    = dynamics.state.time;
    double             along = 0., normal = 0., way = 0.;
    while (slide.velocity()[0] > 0.1 * speed && dynamics.state.time < begin + 0.1)
      {
        dynamics.step();
        const Vector3 impulse = slide.contact.total_impulse_on(1);
        along += impulse[0];
        normal += impulse[2];
        way += dynamics.state.time_step * slide.velocity()[0];
      }
    const Vector3      change = slide.velocity() - first;
    const EnergyLedger now    = dynamics.ledger();
    const double       energy = 0.5 * slide.mass * (1. - 0.1 * 0.1) * speed * speed;
    std::printf("%s%u + %u cells, slid %.3f mm, %llu steps in all\n", name.c_str(),
                (unsigned int)test.plate.cells.size(), (unsigned int)test.block.cells.size(), 1e3 * way,
                (unsigned long long)dynamics.state.n_steps);
    check.relative(name + "change of momentum over impulse along", slide.mass * change[0] / along, 1., 1e-9);
    check.relative(name + "impulse of the weight, N s", normal - slide.mass * change[2],
                   slide.mass * gravity * (dynamics.state.time - begin), 1e-9);
    check.below(name + "energy residual over what was dissipated",
                (now.residual() - at_first.residual()) / (now.dissipated() - at_first.dissipated()),
                test.hops ? 2e-4 : 1e-8);
    check.below(name + "contact loss over friction",
                (now.contact - at_first.contact) / (now.friction - at_first.friction), test.hops ? 1. : 1e-3);
    if (test.hops)
      {
        // While it hops some of its nodes stick for a moment.
        check.that(name + "no more friction than the bound", -along <= (1. + 1e-9) * friction * normal);
        return;
      }
    // Where the block widens under its load, slip turns sideways by some per cent of a radian.
    check.relative(name + "friction over normal impulse", -along / normal, friction, 1e-3);
    // Some of the energy goes into shear of block and plate.
    check.relative(name + "friction loss, mJ", 1e3 * (now.friction - at_first.friction), 1e3 * energy, 5e-3);
  }

  void check_standing(Check &check, const std::string &name, const Case &test, Slide &slide)
  {
    slide.stand(0.03);
    const NodalField x    = slide.dynamics.state.positions();
    const double     lost = slide.dynamics.ledger().friction;
    const auto       n    = slide.dynamics.state.n_steps;
    slide.stand(test.standing);
    std::printf("%sstood for %llu steps\n", name.c_str(),
                (unsigned long long)(slide.dynamics.state.n_steps - n));
    double drift = 0.;
    for (const Mesh::Face &face : slide.mesh.faces)
      if (face.body == 1 && face.boundary == Boundary::contact)
        for (const unsigned int i : face.nodes)
          drift = std::max(drift, std::abs(slide.dynamics.state.position(i)[0] - x[i][0]));
    check.below(name + "drift while it stands, share of its length", drift / edge, test.drift);
    check.below(name + "friction while it stands, share of what there was",
                (slide.dynamics.ledger().friction - lost) / lost, 1e-9);
    check.relative(name + "weight that the plate carries in the end, N",
                   slide.contact.total_impulse_on(1)[2] / slide.dynamics.state.time_step,
                   slide.mass * gravity, 3e-5);
  }

  void check_case(Check &check, const Case &test)
  {
    const std::string name = test.name + ": ";
    Slide             slide(test);
    if (test.settles)
      slide.settle();
    slide.set_weight(1.);
    slide.push();
    check_sliding(check, name, test, slide);
    check_standing(check, name, test, slide);
  }
} // namespace contact_hard_meshes

TREAD_TEST(contact_hard_meshes)(Check &check, const tests::Arguments &)
{
  // 1e5 steps under load.
  check_case(check, {"alike", plate({{12, 8, 2}}), block({{4, 4, 2}}), 0.5, true, false, 1.52, 1e-9});
  check_case(check, {"block 7 times finer", plate({{6, 4, 1}}), block({{14, 14, 7}})});
  check_case(check, {"plate 7 times finer", plate({{42, 28, 2}}), block({{2, 2, 1}})});
  check_case(check, {"borders of cell sizes", refined_behind(plate({{6, 4, 1}}), 0.021, 0.005),
                     refined_behind(block({{4, 4, 2}}), x_begin + 0.006, 0.0025)});
  check_case(check, {"slivers 1:10 in the plate", plate({{6, 4, 10}}), block({{4, 4, 2}}), 3.});
  check_case(check, {"slivers 1:10 in the block", plate({{12, 8, 2}}), block({{4, 4, 20}}), 3.});
  // Hourglass modes of cells that are thin along the way vibrate under friction.
  check_case(check, {"slivers 1:20 that slide", plate({{12, 8, 2}}), block({{40, 2, 1}}), 5., true, true});
  check_case(check, {"distorted block", plate({{12, 8, 2}}), distorted_block()});
  check_case(check, {"gap of 0.01 mm", plate({{12, 8, 2}}), block({{4, 4, 2}}, 1e-5), 0.5, false});
  check_case(check, {"overlap of 0.01 mm", plate({{12, 8, 2}}), block({{4, 4, 2}}, -1e-5), 0.5, false});
}
