// SPDX-License-Identifier: LGPL-2.1-or-later
// A wheel on a track with all that has state is stored in the middle of its way and restored in objects that
// were just made. A member that its class forgets to store is found in two ways: by the bytes of the objects
// themselves, and by what they do in the next steps.
#include <tread/analysis/contact_patch.h>
#include <tread/analysis/rail_stress.h>
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>
#include <tread/dynamics/parts/supports.h>
#include <tread/dynamics/parts/wheel.h>
#include <tread/mesh/rail_body.h>
#include <tread/mesh/wheel_body.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "reopened.h"

#include <cstring>
#include <new>

using namespace tread;
using dealii::Point;

namespace checkpoint_members
{
  constexpr double       axle_height = 0.46, speed = 28.; // m, m/s
  constexpr unsigned int steps_before = 120, steps_after = 100;

  std::vector<Body> bodies()
  {
    FineZone zone;
    zone.finest_cell_size = 2.5e-3;
    zone.x_begin          = -15e-3;
    zone.x_end            = 15e-3;
    zone.half_width       = 8e-3;
    zone.depth            = 2.5e-3;
    RailBlock rail;
    rail.x_begin            = -0.6;
    rail.x_end              = 0.6;
    rail.width              = 0.06;
    rail.height             = 0.15;
    rail.crown_radius       = 0.3;
    rail.coarsest_cell_size = 0.04;
    WheelSector wheel;
    wheel.radius    = axle_height;
    wheel.arc_begin = -0.06;
    wheel.arc_end   = 0.06;
    wheel.width     = 0.08;
    return {make_rail_block(rail, zone), make_wheel_sector(wheel, zone)};
  }

  std::vector<PlasticZone> zones()
  {
    PlasticMaterial material;
    material.yield_stress      = 250e6;
    material.isotropic_modulus = 1e9;
    material.backstresses      = {{20e9, 100.}, {2e9, 0.}};
    return {{0, material, [](const Point<3> &p) {
               return std::abs(p[0]) < 0.015 && p[2] > -8e-3;
             }}};
  }

  SolidParameters solid_parameters()
  {
    SolidParameters p;
    p.max_level     = 2;
    p.density_scale = 4.;
    return p;
  }

  DynamicsParameters dynamics_parameters()
  {
    DynamicsParameters p;
    p.density_scale  = 4.;
    p.mass_damping   = 20.;
    p.courant_number = 0.99; // so that deformed cells make it look for their frequency
    return p;
  }

  WheelHubParameters hub_parameters()
  {
    WheelHubParameters p;
    p.mass                 = 900.;
    p.moment_of_inertia    = 70.;
    p.sprung_mass          = 11000.;
    p.suspension_stiffness = 880e3;
    p.suspension_damping   = 4000.;
    return p;
  }

  ContactParameters contact_parameters()
  {
    ContactParameters p;
    p.solver.max_sweeps = 5; // some steps do not converge, and are counted
    return p;
  }

  /// All that a simulation is made of and that has state.
  struct Vehicle
  {
    Mesh             mesh;
    Solid            solid;
    WheelHub         hub;
    ExplicitDynamics dynamics;
    Supports         supports;
    Contact          contact;
    StressStrip      strip;
    PatchAverage     average;

    explicit Vehicle(const MPI_Comm comm)
      : mesh(comm, bodies(), solid_parameters().max_level)
      , solid(mesh, {ElasticMaterial(), ElasticMaterial()}, solid_parameters(), zones())
      , hub(hub_parameters())
      , dynamics(mesh, solid, dynamics_parameters())
      , supports(mesh, 0, {-0.3, 0.3}, track())
      , contact(mesh, contact_parameters(), std::make_shared<CoulombFriction>(0.3))
      , strip(mesh,
              solid,
              &contact.surfaces,
              0,
              ElasticMaterial(),
              StripExtent{-0.02, 0.02, 0., 8e-3, 8e-3, [](const Point<3> &p) {
                            return -p[2];
                          }})
    {
      hub.place(Vector3{0., 0., axle_height, 0.});
      hub.motion.angular_velocity = speed / axle_height;
      supports.add_probe(0.);
      dynamics.add<RailOnSupports>(supports, ElasticMaterial());
      dynamics.guide_nodes(dynamics.boundary_nodes(0, Boundary::end), 0);
      dynamics.guide_nodes(supports.guided_nodes(1), 1);
      dynamics.add<DampedNodes>(0, [](const Point<3> &p) { return std::abs(p[0]) > 0.4 ? 2e3 : 0.; });
      dynamics.add<WheelOnHub>(hub, 1, hub.motion.angular_velocity);
      dynamics.attach_contact(contact);
    }

    static TrackParameters track()
    {
      TrackParameters p;
      p.pad_width = 0.05;
      return p;
    }

    /// From equilibrium, with a creepage.
    void start()
    {
      dynamics.relax(1e-3, 20000, {});
      contact.set_friction(std::make_shared<CoulombFriction>(0.3));
      hub.drive                   = Drive::creepage;
      hub.motion.velocity_x       = speed;
      hub.motion.angular_velocity = 1.002 * speed / axle_height;
      dynamics.set_bending_velocities();
      dynamics.set_rigid_velocities();
      contact.scale_impulses(dynamics_parameters().courant_number * dynamics.critical_step().seconds());
      dynamics.start();
    }

    void roll(const unsigned int n_steps)
    {
      const std::uint64_t end = dynamics.state.n_steps + n_steps;
      while (dynamics.state.n_steps < end || !dynamics.synchronised())
        {
          dynamics.step();
          average.add(contact.active_nodes(), hub.motion.x, dynamics.state.time_step);
          if (dynamics.synchronised())
            strip.sample(dynamics, {}, hub.motion.x);
        }
      dynamics.critical_step().check_cells();
    }

    void serialize(Archive &archive)
    {
      dynamics.serialize(archive);
      strip.serialize(archive);
      average.serialize(archive);
    }
  };

  /// Makes an object in memory that was all zeros, so that gaps between its members are alike.
  struct InZeros
  {
    Vehicle *vehicle;

    explicit InZeros(const MPI_Comm comm)
    {
      void *memory = ::operator new(sizeof(Vehicle), std::align_val_t(64));
      for (std::size_t i = 0; i < sizeof(Vehicle); ++i)
        static_cast<volatile char *>(memory)[i] = 0;
      vehicle = new (memory) Vehicle(comm);
    }

    ~InZeros()
    {
      vehicle->~Vehicle();
      ::operator delete(vehicle, std::align_val_t(64));
    }

    InZeros(const InZeros &)            = delete;
    InZeros &operator=(const InZeros &) = delete;

    Vehicle *operator->() const
    {
      return vehicle;
    }
  };

  /// In the bytes of an object and of two that were restored from it: where these two agree there is no
  /// address in them, so the first must agree as well.
  template <typename T>
  void compare_bytes(tests::Check      &check,
                     const std::string &name,
                     const T           &original,
                     const T           &one,
                     const T           &other)
  {
    unsigned int n_forgotten = 0, n_alike = 0;
    for (std::size_t at = 0; at < sizeof(T); at += sizeof(std::uint64_t))
      {
        const auto word = [&](const T &object) {
          std::uint64_t value;
          std::memcpy(&value, reinterpret_cast<const char *>(&object) + at, sizeof value);
          return value;
        };
        if (word(one) != word(other))
          continue;
        ++n_alike;
        if (word(original) == word(one))
          continue;
        ++n_forgotten;
        double number;
        std::memcpy(&number, reinterpret_cast<const char *>(&original) + at, sizeof number);
        std::printf("%s: byte %zu of %zu is not restored: %llx, as a number %g\n", name.c_str(), at,
                    sizeof(T), (unsigned long long)word(original), number);
      }
    check.absolute(name + ": words that are not restored", n_forgotten, 0., 0.);
    check.that(name + ": not all words are addresses", n_alike > 0);
  }

  /// Whether two lists are the same to the last bit.
  template <typename T, typename A>
  bool same_bits(const std::vector<T, A> &a, const std::vector<T, A> &b)
  {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
  }

  template <typename T>
  bool same_bits(const T &a, const T &b)
  {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
  }

  /// What the nodes in contact say, without the gaps in their structure.
  std::vector<double> numbers(const std::vector<ContactNodeState> &states, const bool with_slip)
  {
    std::vector<double> list;
    for (const ContactNodeState &state : states)
      {
        for (const Vector3 &row :
             {state.position, state.normal, state.impulse, with_slip ? state.slip : Vector3{}})
          list.insert(list.end(), {row[0], row[1], row[2]});
        list.insert(list.end(), {double(state.node), state.area, state.gap, double(state.adhesion)});
      }
    return list;
  }

  std::vector<double> numbers(const PatchAverage &average)
  {
    std::vector<double> list{average.slip_chatter(), double(average.n_steps()),
                             average.measures().max_pressure, average.measures().frictional_power};
    for (const PatchNode &node : average.nodes())
      list.insert(list.end(), {node.position[0], node.area, node.pressure, node.shear[0], node.shear[1],
                               node.slip[0], node.slip[1], double(node.adhesion)});
    return list;
  }

  std::vector<double> numbers(const std::vector<StripColumn> &columns)
  {
    std::vector<double> list;
    for (const StripColumn &c : columns)
      list.insert(list.end(), {c.x, c.largest.stress, c.largest.time, c.largest.wheel_x, c.at_surface.stress,
                               c.depth, c.equivalent_plastic_strain});
    return list;
  }

  std::vector<double> numbers(const Supports &supports)
  {
    std::vector<double> list{supports.spring_energy(), supports.dissipated(), supports.probe_displacement(0)};
    for (unsigned int s = 0; s < 2; ++s)
      list.insert(list.end(), {supports.force(s, Supports::pad), supports.force(s, Supports::ballast),
                               supports.pad_pressures(s).first, supports.rail_displacement(s)});
    return list;
  }

  /// @param has_stepped: what a step finds by the way is compared too.
  void compare(tests::Check &check, const std::string &name, Vehicle &a, Vehicle &b, const bool has_stepped)
  {
    const auto all = [&](const std::string &what, const bool same) {
      check.that(name + what, !dealii::Utilities::MPI::logical_or(!same, a.mesh.comm));
    };
    all("step and time", a.dynamics.state.n_steps == b.dynamics.state.n_steps &&
                           same_bits(a.dynamics.state.time, b.dynamics.state.time));
    all("time step", same_bits(a.dynamics.state.time_step, b.dynamics.state.time_step) &&
                       same_bits(a.dynamics.critical_step().seconds(), b.dynamics.critical_step().seconds()));
    all("positions", same_bits(a.dynamics.state.positions(), b.dynamics.state.positions()));
    all("velocities", same_bits(a.dynamics.state.v, b.dynamics.state.v));
    all("plastic history", same_bits(a.dynamics.state.history.values, b.dynamics.state.history.values));
    all("hub", same_bits(a.hub.motion, b.hub.motion) && a.hub.drive == b.hub.drive &&
                 same_bits(a.hub.drive_torque, b.hub.drive_torque) &&
                 same_bits(a.hub.external_work(), b.hub.external_work()) &&
                 same_bits(a.hub.gross_work(), b.hub.gross_work()));
    all("supports", same_bits(numbers(a.supports), numbers(b.supports)));
    all("energies", same_bits(a.dynamics.ledger(), b.dynamics.ledger()));
    all("contact", same_bits(numbers(a.contact.active_nodes(), has_stepped),
                             numbers(b.contact.active_nodes(), has_stepped)));
    all("steps without convergence", a.contact.n_unconverged_steps == b.contact.n_unconverged_steps);
    all("averaged patch", same_bits(numbers(a.average), numbers(b.average)));
    all("stress under the path",
        same_bits(numbers(a.strip.columns(a.dynamics)), numbers(b.strip.columns(b.dynamics))));
  }
} // namespace checkpoint_members


TREAD_TEST(checkpoint_members)(tests::Check &check, const tests::Arguments &)
{
  const MPI_Comm comm = MPI_COMM_WORLD;
  InZeros        original(comm), restored(comm), again(comm);

  // A second start, so that what a start remembers is not zero; then the torque.
  original->start();
  original->roll(steps_before);
  original->start();
  original->roll(steps_before);
  original->hub.drive        = Drive::torque;
  original->hub.drive_torque = 9000.;
  original->roll(steps_before);
  const EnergyLedger ledger = original->dynamics.ledger();
  std::printf(
    "%llu cells, %u levels, %llu steps of %.4g us, %llu of them unconverged, %llu nodes in contact\n",
    (unsigned long long)original->mesh.n_global_cells, original->dynamics.max_level() + 1,
    (unsigned long long)original->dynamics.state.n_steps, 1e6 * original->dynamics.state.time_step,
    (unsigned long long)original->contact.n_unconverged_steps,
    (unsigned long long)original->contact.active_nodes().size());
  check.that("there are levels of time steps", original->dynamics.max_level() == 2);
  check.that("cells have yielded", ledger.plastic > 0.);
  check.that("friction, damping and dampers have taken energy",
             ledger.friction > 0. && ledger.damping > 0. && ledger.dampers > 0.);
  check.that("some steps did not converge", original->contact.n_unconverged_steps > 0);

  Archive stored(comm);
  original->serialize(stored);
  const std::string parts = tests::parts_of(stored, comm);
  for (Vehicle *vehicle : {restored.vehicle, again.vehicle})
    {
      Archive archive(comm, parts);
      vehicle->serialize(archive);
      check.that("everything was found", archive.found_all());
    }
  // On several ranks one that is beside the patch may keep room for what is empty, which the restored one
  // never had.
  if (dealii::Utilities::MPI::n_mpi_processes(comm) == 1)
    {
      compare_bytes(check, "hub", original->hub, restored->hub, again->hub);
      compare_bytes(check, "dynamics", original->dynamics, restored->dynamics, again->dynamics);
      compare_bytes(check, "supports", original->supports, restored->supports, again->supports);
      compare_bytes(check, "contact", original->contact, restored->contact, again->contact);
      compare_bytes(check, "strip", original->strip, restored->strip, again->strip);
      compare_bytes(check, "average", original->average, restored->average, again->average);
    }
  compare(check, "restored: ", *original.vehicle, *restored.vehicle, false);
  original->roll(steps_after);
  restored->roll(steps_after);
  compare(check, std::to_string(steps_after) + " steps later: ", *original.vehicle, *restored.vehicle, true);
}
