// SPDX-License-Identifier: LGPL-2.1-or-later
// One step of the explicit time integration, and what acts on the nodes from outside in it.
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace tread
{
  namespace
  {
    class Stopwatch
    {
    public:
      double lap()
      {
        const auto   now     = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last).count();
        last                 = now;
        return seconds;
      }

    private:
      std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
    };
  } // namespace


  void ExplicitDynamics::add_local_damping(const unsigned int due)
  {
    for (DampedNode &damped : damped_nodes)
      if (const unsigned int i = damped.node; levels.of_node[i] <= due)
        {
          damped.load =
            -damped.rate * free_mass(i, std::ldexp(parameters.density_scale, levels.of_node[i])) * v[i];
          force[i] += damped.load;
        }
  }


  void ExplicitDynamics::count_local_damping(const unsigned int due)
  {
    // The work uses the mean of the velocities before and after the step, as for all prescribed forces.
    ReproducibleSum<double> lost;
    for (const DampedNode &damped : damped_nodes)
      if (const unsigned int i = damped.node; levels.of_node[i] <= due && mesh.shared_nodes.is_owned(i))
        lost.add(-time_step * dot(damped.load, v[i] + (0.5 * time_step * inverse_mass[i]) * force[i]));
    totals.damping.add(lost);
  }


  template <typename Loop>
  inline void ExplicitDynamics::with_body_loads(const bool   has_loads,
                                                const Run   &run,
                                                const double factor,
                                                BodyLoads   &sums,
                                                const Loop  &loop) const
  {
    if (!has_loads)
      loop([](const unsigned int) { return Vector3{}; });
    else if (levels.reproducible)
      with_rounded_loads(quanta, run, factor, sums, loop);
    else
      with_rounded_loads(QuantaOf<NoRounding>(), run, factor, sums, loop);
  }


  template <typename Quanta, typename Loop>
  inline void ExplicitDynamics::with_rounded_loads(const Quanta quanta, // a copy, which no force overwrites
                                                   const Run   &run,
                                                   const double factor,
                                                   BodyLoads   &sums,
                                                   const Loop  &loop) const
  {
    Vector3      loss{};
    const double damping = parameters.mass_damping, scaled = parameters.density_scale * factor;
    if (run.wheel >= 0)
      {
        const Wheel       &wheel = wheels[run.wheel];
        const WheelHub    &hub   = *wheel.hub;
        BodyLoads::OfWheel of_run;
        const double       inward = -compensation(wheel);
        const bool         tilts  = hub.may_tilt(); // else nothing asks for the products
        const Vector3      middle = hub.middle(), velocity = hub.velocity(), turning = hub.turning(),
                      axle = hub.axle();
        loop([&](const unsigned int i) {
          const double  mass     = free_mass(i, scaled);
          const Vector3 arm      = position(i) - middle;
          const double  along    = dot(axle, arm);
          const Vector3 off_axle = arm - along * axle;
          const Vector3 relative = v[i] - velocity - cross(turning, arm);
          const Vector3 drag     = (damping * mass) * relative;
          of_run.arms += quanta.moments.round(mass * off_axle);
          if (tilts)
            of_run.products += quanta.moments.round((mass * along) * off_axle);
          of_run.drag += quanta.on_hubs.round(drag);
          of_run.moments += quanta.on_hubs.round(cross(arm, drag));
          loss += quanta.loss.round((time_step * relative) * drag);
          return mass * inward * off_axle - drag;
        });
        if (run.is_owned)
          sums.wheels[run.wheel] += of_run;
      }
    else
      loop([&](const unsigned int i) {
        const Vector3 drag = (damping * free_mass(i, scaled)) * v[i];
        loss += quanta.loss.round((time_step * v[i]) * drag);
        return -drag;
      });
    if (run.is_owned)
      sums.loss += loss;
  }


  void ExplicitDynamics::keep_loads_of_shared(const unsigned int due)
  {
    for (LoadOfShared &shared : loads_of_shared)
      if (shared.level <= due)
        {
          shared.load        = force[shared.node];
          force[shared.node] = Vector3{};
        }
  }


  void ExplicitDynamics::prepare_step()
  {
    set_damping_time(parameters.damping_steps * time_step);
    mesh.distribute_hanging_nodes(x_damped.data());
    next_loads = BodyLoads(wheels.size());
    std::fill(force.begin(), force.end(), Vector3{});
    for (unsigned int level = 0; level <= max_level(); ++level)
      for (const Run &run : levels.runs[level])
        {
          const double factor = std::ldexp(1., level);
          with_body_loads(level == 0 && has_body_loads(run), run, factor, next_loads, [&](const auto &load) {
            for (unsigned int i = run.begin; i < run.end; ++i)
              force[i] = quanta.force.round(weight(i, factor) + load(i));
          });
        }
    keep_loads_of_shared(max_level());
  }


  void ExplicitDynamics::set_hub_sums(std::vector<double> &sums) const
  {
    std::fill(sums.begin(), sums.end(), 0.);
    double *of_wheel = sums.data();
    for (const Wheel &wheel : wheels)
      {
        const Vector3 middle = wheel.hub->middle();
        for (const unsigned int i : wheel.nodes)
          if (mesh.shared_nodes.is_owned(i))
            {
              const Vector3 load   = quanta.on_hubs.round(force[i]),
                            moment = quanta.on_hubs.round(cross(position(i) - middle, force[i]));
              for (unsigned int d = 0; d < 3; ++d)
                {
                  of_wheel[d] += load[d];
                  of_wheel[3 + d] += moment[d];
                }
              if (!wheel.hub->flexible_axle())
                continue;
              const FlexibleAxle::Side side = wheel.hub->side_of(position(i));
              const Vector3            on_side =
                quanta.on_hubs.round(cross(position(i) - wheel.hub->middle_of(side), force[i]));
              for (unsigned int d = 0; d < 3; ++d)
                of_wheel[12 + 3 * side + d] += on_side[d];
            }
        of_wheel += n_hub_sums;
      }
    for (const unsigned int i : base_nodes)
      if (mesh.shared_nodes.is_owned(i))
        {
          const Vector3 load = quanta.on_hubs.round(force[i]);
          for (unsigned int d = 0; d < n_base_sums; ++d)
            of_wheel[d] += load[d];
        }
  }


  void ExplicitDynamics::move_hub_nodes()
  {
    for (const Wheel &wheel : wheels)
      for (unsigned int k = 0; k < wheel.nodes.size(); ++k)
        {
          const unsigned int i = wheel.nodes[k];
          const Vector3      x = wheel.hub->position_of(wheel.reference[k]);
          v[i]                 = wheel.hub->velocity_at(x);
          set_position(i, x);
        }
    for (const unsigned int i : base_nodes)
      {
        const dealii::Point<3> &p = mesh.nodes[i];
        v[i]                      = rail_base->velocity();
        set_position(i, Vector3{p[0], p[1], p[2], 0.} + rail_base->displacement());
      }
  }


  void ExplicitDynamics::sum_forces(const unsigned int due)
  {
    mesh.shared_nodes.sum(force.data());
    // These loads are added after the sum, because the sums of nodes that are not due must remain zero.
    for (const LoadOfShared &shared : loads_of_shared)
      if (shared.level <= due)
        force[shared.node] += shared.load;
  }


  ExplicitDynamics::BodyLoads ExplicitDynamics::add_loads(const unsigned int due)
  {
    BodyLoads loads = next_loads;
    if (!external_force.empty())
      for (unsigned int level = 0; level <= due; ++level)
        for (const Run &run : levels.runs[level])
          for (unsigned int i = run.begin; i < run.end; ++i)
            force[i] += std::ldexp(1., level) * external_force[i];
    for (unsigned int level = 1; level <= due; ++level)
      for (const Run &run : levels.runs[level])
        if (has_body_loads(run))
          with_body_loads(true, run, std::ldexp(1., level), loads, [&](const auto &load) {
            for (unsigned int i = run.begin; i < run.end; ++i)
              force[i] += load(i);
          });
    totals.damping.add(dot(loads.loss, Vector3{1., 1., 1., 0.}));
    add_local_damping(due);
    hold_guided_nodes(force);
    return loads;
  }


  void ExplicitDynamics::set_rank_sums(const BodyLoads &loads)
  {
    set_hub_sums(rank_sums);
    for (std::size_t k = 0; k < wheels.size(); ++k)
      {
        const BodyLoads::OfWheel &of_wheel = loads.wheels[k];
        double                   *sums     = rank_sums.data() + n_hub_sums * k;
        for (unsigned int d = 0; d < 3; ++d)
          {
            sums[d] += of_wheel.drag[d];
            sums[3 + d] += of_wheel.moments[d];
            sums[6 + d] = of_wheel.arms[d];
            sums[9 + d] = of_wheel.products[d];
          }
      }
    if (supports)
      supports->predict(v.data(), force.data(), inverse_mass, time_step, rank_sums.data() + n_sums_of_hubs());
  }


  void ExplicitDynamics::add_contact_forces()
  {
    Stopwatch watch;
    if (contact->refresh_due())
      {
        check_stability(); // a search among nodes that fly apart fills the memory
        contact->refresh(positions().data(), v.data(), time_step);
        matched_surface.select(contact->nodes_near());
        times.search += watch.lap();
      }
    contact->predict(v.data(), force.data(), time_step, rank_sums);
    times.communication += watch.lap();
    contact->solve(time_step, force.data());
    const ContactWork &work = contact->last_work();
    totals.friction.add(work.friction);
    totals.contact.add(work.normal + work.adhesion);
    totals.contact_on_nodes.add(work.on_nodes);
    totals.contact_on_nodes.add(work.imposed);
    totals.external_work.add(work.imposed);
    totals.gross_work.add(std::abs(work.imposed));
    times.contact += watch.lap();
  }


  void ExplicitDynamics::advance_hubs()
  {
    const double *sums = rank_sums.data();
    for (const Wheel &wheel : wheels)
      {
        const Vector3 before = wheel.hub->velocity(), axle = wheel.hub->axle();
        wheel.hub->advance(
          Vector3{sums[0], sums[1], sums[2], 0.}, Vector3{sums[3], sums[4], sums[5], 0.}, time_step,
          {Vector3{sums[12], sums[13], sums[14], 0.}, Vector3{sums[15], sums[16], sums[17], 0.}});
        // The compensation acts on mass that is not there, so the axle feels nothing of it. Its work with the
        // motion about the axle is a potential, that with the axle's motion in this step is summed here.
        const double work =
          -compensation(wheel) *
          (0.5 * time_step * dot(Vector3{sums[6], sums[7], sums[8], 0.}, before + wheel.hub->velocity()) +
           dot(Vector3{sums[9], sums[10], sums[11], 0.}, wheel.hub->axle() - axle));
        if (dealii::Utilities::MPI::this_mpi_process(mesh.comm) == 0)
          {
            totals.external_work.add(work);
            totals.gross_work.add(std::abs(work));
          }
        sums += n_hub_sums;
      }
    if (rail_base)
      rail_base->advance(Vector3{sums[0], sums[1], sums[2], 0.}, time_step);
  }


  void ExplicitDynamics::advance_nodes(const unsigned int due)
  {
    const bool              loaded = !external_force.empty();
    ReproducibleSum<double> work, gross;
    next_loads             = BodyLoads(wheels.size());
    const Quantum of_loads = quanta.force;
    for (unsigned int level = 0; level <= due; ++level)
      {
        const double factor = std::ldexp(1., level), way = factor * time_step + damping_time;
        for (const Run &run : levels.runs[level])
          {
            const auto advance = [&](const unsigned int i) {
              const Vector3 velocity = v[i] + (time_step * inverse_mass[i]) * force[i];
              if (loaded && run.is_owned)
                {
                  const double w = 0.5 * factor * time_step * dot(external_force[i], velocity + v[i]);
                  work.add(w);
                  gross.add(std::abs(w));
                }
              x_damped[i] += way * velocity - damping_time * v[i];
              v[i] = velocity;
            };
            with_body_loads(level == 0 && has_body_loads(run), run, factor, next_loads,
                            [&](const auto &load) {
                              for (unsigned int i = run.begin; i < run.end; ++i)
                                {
                                  advance(i);
                                  force[i] = of_loads.round(weight(i, factor) + load(i));
                                }
                            });
          }
      }
    keep_loads_of_shared(due);
    totals.external_work.add(work);
    totals.gross_work.add(gross);
  }


  void ExplicitDynamics::step()
  {
    Stopwatch                    watch;
    std::optional<DampingSample> sample;
    if (synchronised() &&
        (!damping_is_sampled || n_steps >= last_damping_step + parameters.steps_between_damping_samples))
      sample = begin_damping_sample();
    const unsigned int due = level_due();
    add_forces_due(due);
    if (supports)
      supports->add_forces(force.data());
    times.internal_forces += watch.lap();
    sum_forces(due);
    times.communication += watch.lap();
    set_rank_sums(add_loads(due));
    times.nodes += watch.lap();

    if (contact)
      {
        add_contact_forces();
        watch.lap(); // counted there
      }
    else if (!rank_sums.empty())
      dealii::Utilities::MPI::sum(rank_sums, mesh.comm, rank_sums);
    if (supports)
      supports->advance(rank_sums.data() + n_sums_of_hubs(), time_step);
    advance_hubs();
    count_local_damping(due);
    advance_nodes(due);
    move_hub_nodes();
    time += time_step;
    ++n_steps;
    place_hanging_nodes();
    if (sample)
      end_damping_sample(*sample);
    times.nodes += watch.lap();
  }
} // namespace tread
