// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/went_wrong.h>
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread
{
  namespace
  {
    /// Half of the distance over which the deflection under the moving load is differentiated, m: short
    /// against the bending of a rail between two sleepers, and long enough that the difference of two
    /// deflections has more than ten digits.
    constexpr double half_way = 1e-3;

    // Quanta of reproducible sums, each with room for sums of 2^53 quanta.
    constexpr double on_hubs   = 0x1p-28; ///< N and N m, up to 3e7: 200 times the load of a wheel
    constexpr double moments   = 0x1p-36; ///< kg m and kg m^2, up to 1e5: a hundred wheels
    constexpr double loss      = 0x1p-50; ///< J in a step, up to 8; a run dissipates some J in 1e5 steps
    constexpr double stiffness = 0x1p-12; ///< N/m, up to 2e12: a cell of steel of 10 m
  }                                       // namespace


  ExplicitDynamics::ExplicitDynamics(const Mesh               &mesh,
                                     const Solid              &solid,
                                     const DynamicsParameters &parameters)
    : v(mesh.nodes.size(), Vector3{})
    , history(solid.virgin())
    , mesh(mesh)
    , solid(solid)
    , matched_surface(mesh, solid)
    , parameters(parameters)
    , force(mesh.nodes.size(), Vector3{})
    , x_damped(mesh.nodes.size())
    , true_mass(mesh.nodes.size())
    , inverse_mass(mesh.nodes.size(), 0.)
    , fixed(mesh.nodes.size(), false)
    , carried(mesh.nodes.size(), false)
    , wheel_of_body(mesh.body_names.size(), -1)
  {
    if (solid.reproducible())
      quanta = {solid.force_quantum(), Quantum(on_hubs), Quantum(moments), Quantum(loss), Quantum(stiffness)};
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      x_damped[i] = Vector3{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
    NodalField mass(mesh.nodes.size(), Vector3{});
    const auto cell_masses = solid.cell_masses(mesh);
    // In two parts, each of which sums exactly: cells of all sizes weigh up to 1e7 kg and have digits to
    // 1e-21 kg.
    const Quantum large(0x1p-24), small(0x1p-68);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int a = 0; a < 8; ++a)
        {
          const double part = large.round(cell_masses[c][a]);
          mass[mesh.cells[c].nodes[a]] += Vector3{part, small.round(cell_masses[c][a] - part), 0., 0.};
        }
    mesh.condense_hanging_nodes(mass.data());
    mesh.shared_nodes.sum(mass.data());
    for (unsigned int i = 0; i < mass.size(); ++i)
      true_mass[i] = mass[i][0] + mass[i][1];
    // A hanging node is condensed on each rank that holds cells at it, so its sum is zero everywhere.
    set_node_levels();
  }


  void ExplicitDynamics::fix_nodes(const std::vector<unsigned int> &nodes)
  {
    for (const unsigned int i : nodes)
      fixed[i] = true;
  }


  void ExplicitDynamics::guide_nodes(const std::vector<unsigned int> &nodes, const unsigned int direction)
  {
    for (const unsigned int i : nodes)
      guided.emplace_back(i, direction);
  }


  void ExplicitDynamics::hold_guided_nodes(NodalField &field) const
  {
    for (const auto &[node, direction] : guided)
      field[node][direction] = 0.;
  }


  void ExplicitDynamics::attach_hub(WheelHub          &wheel_hub,
                                    const unsigned int body,
                                    const double       angular_velocity)
  {
    const int number    = wheels.size();
    wheel_of_body[body] = number;
    wheels.push_back({&wheel_hub, body, angular_velocity});
    Wheel &wheel = wheels.back();
    wheel.nodes  = support_nodes(body);
    for (const unsigned int i : wheel.nodes)
      {
        carried[i] = true;
        wheel.reference.push_back(position(i) - wheel_hub.middle());
      }
    size_rank_sums();
    set_node_levels(); // the hub moves in every step

    std::array<ReproducibleSum<double>, 6> sums;
    for (unsigned int i = 0; i < v.size(); ++i)
      if (wheel_of(i) == number && mesh.shared_nodes.is_owned(i))
        {
          if (carried[i])
            {
              sums[5].add(true_mass[i]);
              continue;
            }
          const Vector3 arm = position(i) - wheel_hub.middle(), off_axle = wheel_hub.off_axle(arm);
          sums[0].add(true_mass[i]);
          sums[1].add(true_mass[i] * dot(off_axle, off_axle));
          for (unsigned int d = 0; d < 3; ++d)
            sums[2 + d].add(true_mass[i] * arm[d]);
        }
    std::array<double, 6> of_all;
    for (unsigned int k = 0; k < sums.size(); ++k)
      of_all[k] = sums[k].value(mesh.comm);
    wheel_hub.take_out(of_all[0], of_all[1], Vector3{of_all[2], of_all[3], of_all[4], 0.});
    wheel_hub.settle_with(parameters.density_scale * of_all[5], parameters.density_scale * of_all[0]);
  }


  void ExplicitDynamics::attach_rail_base(RailBase &base, const unsigned int body)
  {
    rail_base  = &base;
    base_nodes = support_nodes(body);
    for (const unsigned int i : base_nodes)
      carried[i] = true;
    size_rank_sums();
    set_node_levels(); // the base moves in every step
  }


  void ExplicitDynamics::size_rank_sums()
  {
    rank_sums.resize(n_sums_of_hubs() + (supports ? supports->n_points() : 0));
  }


  void ExplicitDynamics::attach_contact(Contact &c)
  {
    contact = &c;
  }


  void ExplicitDynamics::attach_supports(Supports &s, const ElasticMaterial &rail_material)
  {
    supports = &s;
    s.set_gravity(parameters.gravity);
    s.set_quanta(quanta.force, quanta.stiffness);
    rail_beam = std::make_unique<RailBeam>(mesh, solid, s, rail_material);
    size_rank_sums();
    set_node_levels();
  }


  void ExplicitDynamics::damp_nodes(const unsigned int                                     body,
                                    const std::function<double(const dealii::Point<3> &)> &rate)
  {
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == body && true_mass[i] > 0.) // hanging nodes have none
        if (const double r = rate(mesh.nodes[i]); r > 0.)
          damped_nodes.push_back({i, r, Vector3{}});
  }


  std::vector<double> ExplicitDynamics::free_inverse_masses() const
  {
    std::vector<double> inverse(mesh.nodes.size(), 0.);
    for (unsigned int i = 0; i < inverse.size(); ++i)
      if (!fixed[i] && !carried[i] && true_mass[i] > 0.) // hanging nodes have none
        inverse[i] = 1. / (parameters.density_scale * true_mass[i]);
    return inverse;
  }


  void ExplicitDynamics::set_wheel_velocities()
  {
    // Half a step back, as velocities are: the centripetal acceleration in that time is no small thing.
    const double step = parameters.courant_number * critical_time_step();
    for (unsigned int i = 0; i < v.size(); ++i)
      if (const int number = wheel_of(i); number >= 0)
        {
          const WheelHub &hub  = *wheels[number].hub;
          const double    back = 0.5 * std::ldexp(step, levels.of_node[i]);
          const Vector3   x    = position(i);
          v[i]                 = hub.velocity_at(x - back * (hub.velocity_at(x) - hub.velocity()));
        }
  }


  void ExplicitDynamics::set_track_velocities()
  {
    // How the deflection changes while the loads move by a small way, over the time that takes.
    const auto loads_moved_by = [&](const double way) {
      std::vector<reference::SupportedBeam::Load> loads;
      for (const Wheel &wheel : wheels)
        loads.push_back({wheel.hub->motion.x + way, wheel.hub->static_force()});
      return loads;
    };
    const RailBeam::Field before = rail_beam->balance(loads_moved_by(-half_way)),
                          after  = rail_beam->balance(loads_moved_by(half_way));
    const double rate            = 0.5 * wheels.front().hub->motion.velocity_x / half_way;
    rail_beam->add(after, rate, v.data());
    rail_beam->add(before, -rate, v.data());
    for (Wheel &wheel : wheels)
      {
        const double x = wheel.hub->motion.x;
        wheel.hub->motion.velocity_z +=
          rate * (after.rail.deflection(x + half_way) - before.rail.deflection(x - half_way)).real();
      }
    hold_guided_nodes(v);
    mesh.distribute_hanging_nodes(v.data());
    std::vector<double> sleepers(after.sleepers.size());
    for (unsigned int s = 0; s < sleepers.size(); ++s)
      sleepers[s] = rate * (after.sleepers[s] - before.sleepers[s]);
    supports->set_velocities(v.data(), sleepers);
  }


  void ExplicitDynamics::set_inertia()
  {
    levels.slow_shares_known = false;
    time_step                = parameters.courant_number * critical_time_step();
    inverse_mass             = free_inverse_masses();
    loads_of_shared.clear();
    for (const unsigned int i : mesh.shared_nodes.nodes())
      loads_of_shared.push_back({i, levels.of_node[i], Vector3{}});
    if (contact)
      {
        contact->set_inverse_masses(inverse_mass);
        contact->refresh(positions().data(), v.data(), time_step);
        matched_surface.select(contact->nodes_near());
      }
    hold_guided_nodes(v);
  }


  NodalField ExplicitDynamics::positions() const
  {
    NodalField x(v.size());
    for (unsigned int i = 0; i < v.size(); ++i)
      x[i] = position(i);
    return x;
  }


  void ExplicitDynamics::set_damping_time(const double beta)
  {
    for (unsigned int i = 0; i < v.size(); ++i)
      x_damped[i] += (beta - damping_time) * v[i];
    damping_time = beta;
  }


  void ExplicitDynamics::start()
  {
    for (Wheel &wheel : wheels)
      wheel.nominal_angular_velocity = wheel.hub->motion.angular_velocity;
    set_inertia();
    prepare_step();
    totals             = Totals();
    start_kinetic      = kinetic_energy(cell_forces());
    start_potential    = body_potential();
    start_strain       = strain_energy();
    start_hub_work     = work_on_hubs();
    start_springs      = supports ? supports->spring_energy() : 0.;
    start_dissipated   = supports ? supports->dissipated() : 0.;
    last_damping_step  = n_steps;
    last_damping_power = 0.;
    damping_is_sampled = false;
  }


  void ExplicitDynamics::check_stability() const
  {
    double       fastest = 0.; // squared
    unsigned int worst   = 0;
    for (unsigned int i = 0; i < v.size(); ++i)
      if (const double speed2 = dot(v[i], v[i]); !(speed2 <= fastest)) // NaN is found as well
        {
          fastest = speed2 == speed2 ? speed2 : std::numeric_limits<double>::max();
          worst   = i;
        }
    const double largest = dealii::Utilities::MPI::max(fastest, mesh.comm);
    if (largest <= parameters.largest_speed * parameters.largest_speed)
      return;
    const bool             is_here = fastest == largest && !v.empty();
    const dealii::Point<3> place   = is_here ? mesh.nodes[worst] : dealii::Point<3>();
    throw WentWrong(
      format("unstable: nodes move faster than %g m/s after %llu steps, most of all that which was ",
             parameters.largest_speed, (unsigned long long)n_steps) +
      place_of_worst(is_here, place, is_here ? mesh.node_bodies[worst] : 0) +
      format("; lower 'Time stepping/Courant number' (%f, at most 1)", parameters.courant_number));
  }
} // namespace tread
