// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/parts/wheel.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tread
{
  WheelOnHub::WheelOnHub(const PartOf      &part_of,
                         WheelHub          &hub,
                         const unsigned int body,
                         const double       nominal_angular_velocity)
    : of(part_of)
    , hub(hub)
    , body_number(body)
    , nominal_angular_velocity(nominal_angular_velocity)
    , nodes(of.mesh.boundary_nodes(body, Boundary::support))
  {
    std::vector<char> carried(of.mesh.nodes.size(), false);
    for (const unsigned int i : nodes)
      {
        carried[i] = true;
        reference.push_back(of.state.position(i) - hub.middle());
      }

    std::array<ReproducibleSum<double>, 6> sums;
    for (unsigned int i = 0; i < of.mesh.nodes.size(); ++i)
      if (of.mesh.node_bodies[i] == body && of.mesh.shared_nodes.is_owned(i))
        {
          if (carried[i])
            {
              sums[5].add(of.true_mass[i]);
              continue;
            }
          const Vector3 arm = of.state.position(i) - hub.middle(), off_axle = hub.off_axle(arm);
          sums[0].add(of.true_mass[i]);
          sums[1].add(of.true_mass[i] * dot(off_axle, off_axle));
          for (unsigned int d = 0; d < 3; ++d)
            sums[2 + d].add(of.true_mass[i] * arm[d]);
        }
    std::array<double, 6> of_all;
    for (unsigned int k = 0; k < sums.size(); ++k)
      of_all[k] = sums[k].value(of.mesh.comm);
    hub.take_out(of_all[0], of_all[1], Vector3{of_all[2], of_all[3], of_all[4], 0.});
    hub.settling.count(of.parameters.density_scale * of_all[5], of.parameters.density_scale * of_all[0]);
  }


  std::vector<SoftBody> WheelOnHub::soft_bodies(const State &state) const
  {
    // A sector has cells below its axle alone.
    double above = std::numeric_limits<double>::lowest(), below = above;
    for (unsigned int i = 0; i < of.mesh.nodes.size(); ++i)
      if (of.mesh.node_bodies[i] == body_number)
        {
          const double z = state.position(i)[2] - hub.middle()[2];
          above          = std::max(above, z);
          below          = std::max(below, -z);
        }
    above = dealii::Utilities::MPI::max(above, of.mesh.comm);
    below = dealii::Utilities::MPI::max(below, of.mesh.comm);
    if (above < 0.9 * below)
      return {};
    return {{body_number, SoftBody::Shape::ring, hub.middle(), nodes}};
  }


  RigidMotion WheelOnHub::motion() const
  {
    return {hub.middle(), hub.velocity(), hub.turning(), hub.axle(), hub.may_tilt(), compensation()};
  }


  SumsOfWheel WheelOnHub::sums_of_rank(const State &state) const
  {
    SumsOfWheel   sums{};
    const Vector3 middle = hub.middle();
    for (const unsigned int i : nodes)
      if (of.mesh.shared_nodes.is_owned(i))
        {
          const Quantum &quantum = of.quanta.on_hubs;
          sums.force += quantum.round(state.force[i]);
          sums.moment += quantum.round(cross(state.position(i) - middle, state.force[i]));
          if (!hub.flexible_axle())
            continue;
          const FlexibleAxle::Side side = hub.side_of(state.position(i));
          sums.on_wheels[side] +=
            quantum.round(cross(state.position(i) - hub.middle_of(side), state.force[i]));
        }
    sums.force += loads.drag;
    sums.moment += loads.moments;
    sums.arms     = loads.arms;
    sums.products = loads.products;
    return sums;
  }


  void WheelOnHub::advance_with(Step &step, const SumsOfWheel &sums)
  {
    const double  time_step = step.state.time_step;
    const Vector3 before = hub.velocity(), axle = hub.axle();
    hub.advance(sums.force, sums.moment, time_step, {sums.on_wheels[0], sums.on_wheels[1]});
    // The compensation acts on mass that is not there, so the axle feels nothing of it. Its work with the
    // motion about the axle is a potential, that with the axle's motion in this step is summed here.
    const double work = -compensation() * (0.5 * time_step * dot(sums.arms, before + hub.velocity()) +
                                           dot(sums.products, hub.axle() - axle));
    if (dealii::Utilities::MPI::this_mpi_process(of.mesh.comm) == 0)
      {
        step.totals.external_work.add(work);
        step.totals.gross_work.add(std::abs(work));
      }
  }


  void WheelOnHub::place_nodes(State &state) const
  {
    const auto turns = hub.turns();
    for (unsigned int k = 0; k < nodes.size(); ++k)
      {
        const unsigned int i = nodes[k];
        const Vector3      x = hub.position_of(reference[k], turns);
        state.v[i]           = hub.velocity_at(x);
        state.set_position(i, x);
      }
  }


  void WheelOnHub::set_velocities(State &state, const std::function<double(unsigned int)> &back) const
  {
    // The centripetal acceleration in half a step is no small thing.
    for (unsigned int i = 0; i < state.v.size(); ++i)
      if (of.mesh.node_bodies[i] == body_number)
        {
          const Vector3 x = state.position(i);
          state.v[i]      = hub.velocity_at(x - back(i) * (hub.velocity_at(x) - hub.velocity()));
        }
  }


  Resultant WheelOnHub::resultant(const double *sums) const
  {
    const SumsOfWheel of_all = from(sums);
    return {of_all.force, of_all.moment};
  }
} // namespace tread
