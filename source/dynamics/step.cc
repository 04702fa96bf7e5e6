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


  template <typename Rounding, typename Loop>
  inline void ExplicitDynamics::with_rounded_loads(const Rounding quanta, // a copy, which no force overwrites
                                                   const Run     &run,
                                                   const double   factor,
                                                   BodyLoads     &sums,
                                                   const Loop    &loop) const
  {
    Vector3      loss{};
    const double damping = parameters.mass_damping, scaled = parameters.density_scale * factor;
    if (run.carrier >= 0)
      {
        const RigidMotion &motion = parts.motions()[run.carrier];
        LoadsOnBody        of_run;
        const double       inward = -motion.compensation;
        const bool         tilts  = motion.tilts; // else nothing asks for the products
        const Vector3      middle = motion.middle, velocity = motion.velocity, turning = motion.turning,
                      axle = motion.axle;
        loop([&](const unsigned int i) {
          const double  mass     = free_mass(i, scaled);
          const Vector3 arm      = state.position(i) - middle;
          const double  along    = dot(axle, arm);
          const Vector3 off_axle = arm - along * axle;
          const Vector3 relative = state.v[i] - velocity - cross(turning, arm);
          const Vector3 drag     = (damping * mass) * relative;
          of_run.arms += quanta.moments.round(mass * off_axle);
          if (tilts)
            of_run.products += quanta.moments.round((mass * along) * off_axle);
          of_run.drag += quanta.on_hubs.round(drag);
          of_run.moments += quanta.on_hubs.round(cross(arm, drag));
          loss += quanta.loss.round((state.time_step * relative) * drag);
          return mass * inward * off_axle - drag;
        });
        if (run.is_owned)
          sums.of_carrier[run.carrier] += of_run;
      }
    else
      loop([&](const unsigned int i) {
        const Vector3 drag = (damping * free_mass(i, scaled)) * state.v[i];
        loss += quanta.loss.round((state.time_step * state.v[i]) * drag);
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
          shared.load              = state.force[shared.node];
          state.force[shared.node] = Vector3{};
        }
  }


  void ExplicitDynamics::prepare_step()
  {
    state.set_damping_time(parameters.damping_steps * state.time_step);
    mesh.distribute_hanging_nodes(state.x_damped.data());
    parts.find_motions();
    next_loads = BodyLoads(parts.carriers().size());
    std::fill(state.force.begin(), state.force.end(), Vector3{});
    for (unsigned int level = 0; level <= max_level(); ++level)
      for (const Run &run : levels.runs[level])
        {
          const double factor = std::ldexp(1., level);
          with_body_loads(level == 0 && has_body_loads(run), run, factor, next_loads, [&](const auto &load) {
            for (unsigned int i = run.begin; i < run.end; ++i)
              state.force[i] = quanta.force.round(weight(i, factor) + load(i));
          });
        }
    keep_loads_of_shared(max_level());
  }


  void ExplicitDynamics::sum_forces(const unsigned int due)
  {
    mesh.shared_nodes.sum(state.force.data());
    // These loads are added after the sum, because the sums of nodes that are not due must remain zero.
    for (const LoadOfShared &shared : loads_of_shared)
      if (shared.level <= due)
        state.force[shared.node] += shared.load;
  }


  void ExplicitDynamics::add_loads(const unsigned int due)
  {
    BodyLoads loads = next_loads;
    for (unsigned int level = 1; level <= due; ++level)
      for (const Run &run : levels.runs[level])
        if (has_body_loads(run))
          with_body_loads(true, run, std::ldexp(1., level), loads, [&](const auto &load) {
            for (unsigned int i = run.begin; i < run.end; ++i)
              state.force[i] += load(i);
          });
    books.totals.damping.add(dot(loads.loss, Vector3{1., 1., 1., 0.}));
    for (std::size_t k = 0; k < loads.of_carrier.size(); ++k)
      parts.carriers()[k]->take(loads.of_carrier[k]);
    Step step = step_with(due);
    for (const auto &part : parts)
      part->add_loads(step);
    hold_guided_nodes(state.force);
  }


  void ExplicitDynamics::add_contact_forces()
  {
    Stopwatch watch;
    if (contact->refresh_due())
      {
        check_stability(); // a search among nodes that fly apart fills the memory
        contact->refresh(state.positions().data(), state.v.data(), state.time_step);
        matched_surface.select(contact->nodes_near());
        spent.search += watch.lap();
      }
    contact->predict(state.v.data(), state.force.data(), state.time_step, parts.sums());
    spent.communication += watch.lap();
    contact->solve(state.time_step, state.force.data());
    hold_guided_nodes(state.force); // also where contact reaches the plane on which they are guided
    const ContactWork &work = contact->last_work();
    books.totals.friction.add(work.friction);
    books.totals.contact.add(work.normal + work.adhesion);
    books.totals.contact_on_nodes.add(work.on_nodes);
    books.totals.contact_on_nodes.add(work.imposed);
    books.totals.external_work.add(work.imposed);
    books.totals.gross_work.add(std::abs(work.imposed));
    spent.contact += watch.lap();
  }


  void ExplicitDynamics::advance_nodes(const unsigned int due)
  {
    parts.find_motions();
    next_loads             = BodyLoads(parts.carriers().size());
    const Quantum of_loads = quanta.force;
    for (unsigned int level = 0; level <= due; ++level)
      {
        const double factor = std::ldexp(1., level), way = factor * state.time_step + state.damping_time;
        for (const Run &run : levels.runs[level])
          {
            const auto advance = [&](const unsigned int i) {
              const Vector3 velocity = state.v[i] + (state.time_step * inverse_mass[i]) * state.force[i];
              state.x_damped[i] += way * velocity - state.damping_time * state.v[i];
              state.v[i] = velocity;
            };
            with_body_loads(level == 0 && has_body_loads(run), run, factor, next_loads,
                            [&](const auto &load) {
                              for (unsigned int i = run.begin; i < run.end; ++i)
                                {
                                  advance(i);
                                  state.force[i] = of_loads.round(weight(i, factor) + load(i));
                                }
                            });
          }
      }
    keep_loads_of_shared(due);
  }


  void ExplicitDynamics::step()
  {
    Stopwatch                                 watch;
    std::optional<EnergyBooks::DampingSample> sample;
    if (books.sample_is_due())
      sample = books.begin_sample();
    const unsigned int due = level_due();
    add_forces_due(due);
    for (const auto &part : parts)
      part->add_forces(state.force);
    spent.internal_forces += watch.lap();
    sum_forces(due);
    spent.communication += watch.lap();
    add_loads(due);
    parts.set_sums(state, inverse_mass);
    spent.nodes += watch.lap();

    if (contact)
      {
        add_contact_forces();
        watch.lap(); // counted there
      }
    else
      parts.sum_over_ranks(mesh.comm);
    Step step = step_with(due);
    parts.advance(step);
    advance_nodes(due);
    for (const auto &part : parts)
      part->place_nodes(state);
    state.time += state.time_step;
    ++state.n_steps;
    place_hanging_nodes();
    if (sample)
      books.end_sample(*sample);
    spent.nodes += watch.lap();
  }
} // namespace tread
