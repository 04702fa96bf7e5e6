// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/parts/nodes.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  DampedNodes::DampedNodes(const PartOf                                          &part_of,
                           const unsigned int                                     body,
                           const std::function<double(const dealii::Point<3> &)> &rate)
    : of(part_of)
  {
    for (unsigned int i = 0; i < of.mesh.nodes.size(); ++i)
      if (of.mesh.node_bodies[i] == body && of.true_mass[i] > 0.) // hanging nodes have none
        if (const double r = rate(of.mesh.nodes[i]); r > 0.)
          nodes.push_back({i, r, Vector3{}});
  }


  void DampedNodes::add_loads(Step &step)
  {
    for (Node &node : nodes)
      if (const unsigned int i = node.number, level = step.levels.of_node[i]; level <= step.due)
        {
          const double scale = std::ldexp(of.parameters.density_scale, level);
          const double mass  = step.inverse_mass[i] > 0. ? scale * of.true_mass[i] : 0.;
          node.load          = -node.rate * mass * step.state.v[i];
          step.state.force[i] += node.load;
        }
  }


  void DampedNodes::advance(Step &step, const double *)
  {
    // The work uses the mean of the velocities before and after the step, as for all prescribed forces.
    const State            &state = step.state;
    ReproducibleSum<double> lost;
    for (const Node &node : nodes)
      if (const unsigned int i = node.number;
          step.levels.of_node[i] <= step.due && of.mesh.shared_nodes.is_owned(i))
        lost.add(
          -state.time_step *
          dot(node.load, state.v[i] + (0.5 * state.time_step * step.inverse_mass[i]) * state.force[i]));
    step.totals.damping.add(lost);
  }


  Part::OwnRates DampedNodes::own_rates(const NodeLevels &levels) const
  {
    // A node of level l moves with a step 2^l times as long.
    OwnRates rates;
    for (const Node &node : nodes)
      rates.damping = std::max(rates.damping, std::ldexp(node.rate, levels.of_node[node.number]));
    return rates;
  }


  void NodeLoads::add_loads(Step &step)
  {
    for (unsigned int level = 0; level <= step.due; ++level)
      for (const NodeLevels::Run &run : step.levels.runs[level])
        for (unsigned int i = run.begin; i < run.end; ++i)
          step.state.force[i] += std::ldexp(1., level) * force[i];
  }


  void NodeLoads::advance(Step &step, const double *)
  {
    const State            &state = step.state;
    ReproducibleSum<double> work, gross;
    for (unsigned int level = 0; level <= step.due; ++level)
      for (const NodeLevels::Run &run : step.levels.runs[level])
        if (run.is_owned)
          for (unsigned int i = run.begin; i < run.end; ++i)
            {
              const Vector3 velocity = state.v[i] + (state.time_step * step.inverse_mass[i]) * state.force[i];
              const double  w =
                0.5 * std::ldexp(state.time_step, level) * dot(force[i], velocity + state.v[i]);
              work.add(w);
              gross.add(std::abs(w));
            }
    step.totals.external_work.add(work);
    step.totals.gross_work.add(gross);
  }


  void NodeLoads::add_static_loads(NodalField &loads) const
  {
    for (unsigned int i = 0; i < loads.size(); ++i)
      if (of.mesh.shared_nodes.is_owned(i))
        loads[i] += force[i];
  }
} // namespace tread
