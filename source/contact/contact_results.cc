// SPDX-License-Identifier: LGPL-2.1-or-later
// What a contact is asked for after a step, the work of its pairs, and what none of the steps needs.
#include <tread/base/gathered.h>
#include <tread/contact/contact.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tread
{
  Vector3 ContactPairs::slip_of(const unsigned int j, const Vector3 &normal, const Vector3 u) const
  {
    return u - dot(u, normal) * normal + imposed[j] - before_entry[j];
  }


  double ContactPairs::tangential_loss(const unsigned int j,
                                       const Vector3     &normal,
                                       const double       along,
                                       const Vector3      u) const
  {
    const Vector3 tangential = impulse[j] - along * normal;
    return -dot(tangential, imposed[j]) - dot(tangential, u);
  }


  bool Contact::counts_pairs() const
  {
    return !parameters.reproducible || dealii::Utilities::MPI::this_mpi_process(comm) == 0;
  }


  void Contact::add_work_of_pairs()
  {
    if (!counts_pairs())
      return;
    for (unsigned int j = strips.begin; j < strips.end; ++j)
      {
        const ContactProblem::Constraint &constraint = problem.constraints[j];
        const double                      normal     = dot(pairs.impulse[j], constraint.normal);
        if (normal <= 0.)
          continue;
        const Vector3 u = problem.combine(constraint, nodes.mean_velocity);
        work.imposed -= dot(pairs.impulse[j] - normal * constraint.normal, pairs.imposed[j]);
        work.normal -= normal * dot(u, constraint.normal);
        (pairs.slips[j] ? work.friction : work.adhesion) +=
          pairs.tangential_loss(j, constraint.normal, normal, u);
      }
  }


  void Contact::add_step_to_record(const double time_step)
  {
    if (!counts_pairs())
      return;
    for (unsigned int j = strips.begin; j < strips.end; ++j)
      {
        const ContactProblem::Constraint &constraint = problem.constraints[j];
        const double                      normal     = dot(pairs.impulse[j], constraint.normal);
        if (normal <= 0. || !pairs.slips[j])
          continue;
        const Vector3 u    = problem.combine(constraint, nodes.mean_velocity);
        const double  slip = norm(pairs.slip_of(j, constraint.normal, u));
        pairs.totals[j].duration += time_step;
        pairs.totals[j].friction += pairs.tangential_loss(j, constraint.normal, normal, u);
        pairs.totals[j].distance += time_step * slip;
        pairs.totals[j].sliding += normal * slip;
      }
  }


  void Contact::hand_over_record()
  {
    if (!counts_pairs())
      return;
    PairRecord record;
    for (unsigned int j = strips.begin; j < strips.end; ++j)
      {
        if (pairs.totals[j].duration == 0.)
          continue;
        const ContactProblem::Constraint &constraint = problem.constraints[j];
        record.slave                                 = constraint.slave;
        record.area                                  = constraint.area;
        record.totals                                = std::exchange(pairs.totals[j], {});
        // The dual functions make the coefficients of some nodes negative, who would gain what others lose.
        record.masters.clear();
        double sum = 0.;
        for (unsigned int i = constraint.begin; i < constraint.end; ++i)
          if (const ContactProblem::Entry &entry = problem.entries[i];
              entry.coefficient > 0. && surfaces.nodes[involved[entry.node]].body != parameters.slave_body)
            {
              record.masters.push_back({involved[entry.node], entry.coefficient});
              sum += entry.coefficient;
            }
        for (PairRecord::Share &share : record.masters)
          share.share /= sum;
        take_record(record);
      }
  }


  void Contact::visit_impulses(
    const std::function<void(unsigned int node, double normal, double tangential)> &visit) const
  {
    for (const EffectsOfPairs::NodeTerms &node : effects.of_nodes)
      if (node.owned)
        {
          double  normal = 0.;
          Vector3 tangential{};
          for (unsigned int k = node.begin; k < node.end; ++k)
            {
              const Vector3 &p   = pairs.impulse[effects.terms[k].constraint],
                            &n   = problem.constraints[effects.terms[k].constraint].normal;
              const double along = dot(p, n);
              normal += effects.terms[k].coefficient * along;
              tangential += effects.terms[k].coefficient * (p - along * n);
            }
          // Normals point into the master. The dual functions pull at some of its nodes beside the patch.
          const double pressing =
            surfaces.nodes[involved[node.node]].body == parameters.slave_body ? -normal : normal;
          if (pressing > 0.)
            visit(involved[node.node], pressing, norm(tangential));
        }
  }


  Vector3 Contact::total_impulse() const
  {
    Vector3 sum{};
    for (const Vector3 &p : pairs.impulse)
      sum += p;
    return sum;
  }


  Vector3 Contact::total_impulse_on(const unsigned int body) const
  {
    if (body == parameters.slave_body)
      return -1. * total_impulse();
    Vector3 sum{};
    for (unsigned int j = 0; j < pairs.impulse.size(); ++j)
      if (pairs.master_of[j] == body)
        sum += pairs.impulse[j];
    return sum;
  }


  Vector3 Contact::total_impulse_below(const double y) const
  {
    Vector3 sum{};
    for (unsigned int j = 0; j < pairs.impulse.size(); ++j)
      if (surfaces.nodes[problem.constraints[j].slave].reference[1] < y)
        sum += pairs.impulse[j];
    return sum;
  }


  double Contact::free_rolling_creepage(const Vector3 *x, const unsigned int master_body) const
  {
    std::vector<Vector3> now;
    surfaces.replicate(x, now);
    std::vector<double> load(surfaces.nodes.size(), 0.);
    for (unsigned int j = 0; j < problem.constraints.size(); ++j)
      for (unsigned int i = problem.constraints[j].begin; i < problem.constraints[j].end; ++i)
        if (pairs.master_of[j] == master_body)
          load[involved[problem.entries[i].node]] +=
            problem.entries[i].coefficient * dot(pairs.impulse[j], problem.constraints[j].normal);

    double stretch[2] = {0., 0.}, weight[2] = {0., 0.};
    for (const ContactSurfaces::Face &face : surfaces.faces)
      {
        double w = 0.;
        for (const unsigned int i : face.nodes)
          w += load[i];
        if (w == 0.)
          continue;
        const auto edge = [&](const unsigned int a, const unsigned int b, const bool reference) {
          const unsigned int i = face.nodes[a], j = face.nodes[b];
          return reference ? surfaces.nodes[j].reference - surfaces.nodes[i].reference : now[j] - now[i];
        };
        const unsigned int a      = face.edge_along;
        const double       before = norm(edge(a, a + 1, true)) + norm(edge((a + 3) % 4, a + 2, true));
        const double       after  = norm(edge(a, a + 1, false)) + norm(edge((a + 3) % 4, a + 2, false));
        const bool         master = face.body == master_body;
        stretch[master] += w * (after / before - 1.);
        weight[master] += w;
      }
    return weight[0] != 0. && weight[1] != 0. ? stretch[0] / weight[0] - stretch[1] / weight[1] : 0.;
  }


  std::vector<ContactNodeState> Contact::active_nodes() const
  {
    std::vector<int> number(surfaces.nodes.size(), -1);
    for (unsigned int i = 0; i < involved.size(); ++i)
      number[involved[i]] = i;
    std::vector<ContactNodeState> states;
    for (unsigned int j = strips.begin; j < strips.end; ++j)
      {
        const ContactProblem::Constraint &constraint = problem.constraints[j];
        const double                      normal     = dot(pairs.impulse[j], constraint.normal);
        if (normal <= 0.)
          continue;
        ContactNodeState state;
        state.node        = constraint.slave;
        state.master_body = pairs.master_of[j];
        state.position    = nodes.position[number[constraint.slave]];
        state.normal      = constraint.normal;
        state.impulse     = pairs.impulse[j];
        const Vector3 u   = problem.combine(constraint, nodes.velocity);
        state.slip        = pairs.slip_of(j, constraint.normal, u);
        state.area        = constraint.area;
        state.gap         = dot(problem.combine(constraint, nodes.position), constraint.normal);
        state.adhesion    = !pairs.slips[j];
        states.push_back(state);
      }
    return parameters.reproducible ? states : gathered(states, comm);
  }


  std::vector<Vector3> Contact::surface_impulses() const
  {
    std::vector<Vector3> of_node(surfaces.nodes.size(), Vector3{});
    for (unsigned int j = 0; j < problem.constraints.size(); ++j)
      if (const ContactProblem::Constraint &constraint = problem.constraints[j];
          dot(pairs.impulse[j], constraint.normal) > 0.)
        for (unsigned int i = constraint.begin; i < constraint.end; ++i)
          of_node[involved[problem.entries[i].node]] += problem.entries[i].coefficient * pairs.impulse[j];
    return of_node;
  }


  std::vector<unsigned int> Contact::nodes_near() const
  {
    std::vector<unsigned int> list;
    for (const unsigned int i : near_contact)
      if (const int local = surfaces.nodes[i].local; local >= 0)
        list.push_back(local);
    return list;
  }


  std::optional<Vector3> Contact::contact_at_rim() const
  {
    if (rim_nodes.empty())
      return {};
    // Slave nodes beside the patch have no impulse. Master nodes there have some where faces overlap, but not
    // as much as those under it.
    constexpr double     beside_patch = 0.3;
    std::vector<Vector3> nodal_impulse(involved.size(), Vector3{});
    std::vector<char>    loaded(surfaces.nodes.size(), false);
    for (unsigned int j = 0; j < problem.constraints.size(); ++j)
      if (const ContactProblem::Constraint &constraint = problem.constraints[j]; norm(pairs.impulse[j]) > 0.)
        {
          loaded[constraint.slave] = true;
          for (unsigned int i = constraint.begin; i < constraint.end; ++i)
            nodal_impulse[problem.entries[i].node] += problem.entries[i].coefficient * pairs.impulse[j];
        }
    double largest = 0.;
    for (const Vector3 &p : nodal_impulse)
      largest = std::max(largest, norm(p));
    for (const unsigned int i : rim_nodes)
      if (surfaces.nodes[involved[i]].body == parameters.slave_body
            ? loaded[involved[i]]
            : norm(nodal_impulse[i]) > beside_patch * largest)
        return nodes.position[i];
    return {};
  }
} // namespace tread
