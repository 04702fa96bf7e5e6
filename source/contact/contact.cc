// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/gathered.h>
#include <tread/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace tread
{
  namespace
  {
    /// Normals are averaged anew every so many steps.
    constexpr unsigned int steps_between_normals = 5;

    // How far the search looks, in edges of the smallest slave face, chosen by trial. Pairs that do not touch
    // have no impulse, so that the answer only feels when the coupling was integrated: up to 0.2 % of the
    // frictional power with half or double of a reach (prm/smooth-rolling.prm with cells of 1.3 mm, rolled 12
    // mm).
    /// Faces that are further apart are not looked at. It bounds the way between two searches, which seldom
    /// matters: with 0.7 times and with double of it as many were made.
    constexpr double searched = 1.5;
    /// Slave nodes are coupled if a face around them is nearer. Half of it took 25 searches instead of 18,
    /// double of it 16, with more pairs in each.
    constexpr double coupled = 0.15;
    /// Share of the time to touch after which to search again: half of it is left for speeds that change.
    constexpr double of_time_to_touch = 0.5;
    /// The surfaces may always travel this share of the coupled reach: half of what nodes that are no
    /// candidates are away at least.
    constexpr double least_travel = 0.5 * MortarCoupling::candidates;
    /// ... and never more than this share of the searched reach: half of what faces that were not looked at
    /// are away at least.
    constexpr double most_travel = 0.5;
  } // namespace


  Contact::Contact(const Mesh                        &mesh,
                   const ContactParameters           &parameters,
                   std::shared_ptr<const FrictionLaw> friction)
    : surfaces(mesh)
    , prescribed(until_refresh)
    , comm(mesh.comm)
    , parameters(parameters)
    , friction(std::move(friction))
    , inverse_mass(surfaces.nodes.size(), 0.)
    , face_size(0.)
    , first_ranks(std::make_unique<FirstRanks>(comm))
    , strips(problem)
  {
    // The smallest slave face sets the scale of search distances.
    const int this_rank = dealii::Utilities::MPI::this_mpi_process(comm);
    for (const ContactSurfaces::Node &node : surfaces.nodes)
      if (node.owner == this_rank)
        {
          if (node.body == parameters.slave_body)
            own_nodes[0].push_back(node.local);
          else
            own_nodes[1].push_back(node.local);
        }
    face_size = std::numeric_limits<double>::max();
    slave_faces.resize(surfaces.nodes.size());
    for (unsigned int f = 0; f < surfaces.faces.size(); ++f)
      if (surfaces.faces[f].body == parameters.slave_body)
        for (const unsigned int i : surfaces.faces[f].nodes)
          slave_faces[i].push_back(f);
    for (const ContactSurfaces::Face &face : surfaces.faces)
      if (face.body == parameters.slave_body)
        face_size = std::min(
          face_size, norm(surfaces.nodes[face.nodes[1]].reference - surfaces.nodes[face.nodes[0]].reference));
  }


  void Contact::set_inverse_masses(const std::vector<double> &inverse_masses)
  {
    NodalField rows(inverse_masses.size());
    for (unsigned int i = 0; i < inverse_masses.size(); ++i)
      rows[i] = Vector3{inverse_masses[i], 0., 0., 0.};
    std::vector<Vector3> replicated;
    surfaces.replicate(rows.data(), replicated);
    for (unsigned int i = 0; i < replicated.size(); ++i)
      inverse_mass[i] = replicated[i][0];
    until_refresh.make_due();
  }


  void Contact::scale_impulses(const double factor)
  {
    for (Vector3 &p : pairs.impulse)
      p *= factor;
    pairs.previous_impulse = pairs.impulse;
  }


  template <typename Values>
  void Contact::gather_strips(Values &values) const
  {
    // The strips follow each other as the ranks do.
    if (!values.empty() && !parameters.reproducible)
      values = gathered(Values(values.begin() + strips.begin, values.begin() + strips.end), comm);
  }


  MemoryOfNodes Contact::memory_of_nodes()
  {
    MemoryOfNodes memory;
    memory.impulse.assign(surfaces.nodes.size(), Vector3{});
    for (unsigned int j = 0; j < problem.constraints.size(); ++j)
      memory.impulse[problem.constraints[j].slave] = pairs.impulse[j];
    if (friction->memory().distance > 0.)
      {
        memory.coefficient.assign(surfaces.nodes.size(), friction->coefficient(0.));
        gather_strips(pair_friction.coefficient);
        for (unsigned int j = 0; j < pair_friction.coefficient.size(); ++j)
          memory.coefficient[problem.constraints[j].slave] = pair_friction.coefficient[j];
      }
    return memory;
  }


  void Contact::go_on_from(Contact &before)
  {
    const auto key_of = [](const ContactSurfaces::Node &node) {
      std::array<long long, 4> key{{node.body}};
      for (unsigned int d = 0; d < 3; ++d)
        key[1 + d] = std::llround(1e9 * node.reference[d]);
      return key;
    };
    std::map<std::array<long long, 4>, unsigned int> number;
    for (unsigned int i = 0; i < surfaces.nodes.size(); ++i)
      number[key_of(surfaces.nodes[i])] = i;
    const MemoryOfNodes of_other = before.memory_of_nodes();
    MemoryOfNodes       memory   = memory_of_nodes();
    n_unconverged_steps          = before.n_unconverged_steps;
    for (const ContactProblem::Constraint &pair : before.problem.constraints)
      if (const auto node = number.find(key_of(before.surfaces.nodes[pair.slave])); node != number.end())
        {
          memory.impulse[node->second] = of_other.impulse[pair.slave];
          if (!memory.coefficient.empty())
            memory.coefficient[node->second] = of_other.coefficient[pair.slave];
        }
      else if (norm(of_other.impulse[pair.slave]) > 0.)
        throw std::logic_error("contact: a node that is pressed is not in the other mesh");
    from_other_mesh = std::move(memory);
  }


  void Contact::refresh(const Vector3 *x, const Vector3 *v, const double time_step)
  {
    if (take_record)
      hand_over_record();
    std::vector<Vector3> all_x, all_v;
    surfaces.replicate(x, all_x);
    surfaces.replicate(v, all_v);

    const MemoryOfNodes memory = from_other_mesh ? *std::exchange(from_other_mesh, {}) : memory_of_nodes();
    const std::vector<Vector3> &impulse_of_node     = memory.impulse; // the warm start
    const std::vector<double>  &coefficient_of_node = memory.coefficient;

    const double         search_reach = searched * face_size, reach = coupled * face_size;
    const MortarCoupling coupling =
      couple(surfaces, all_x, all_v, parameters.slave_body, search_reach, reach);

    // Until the next refresh no node may come to touch that is not a candidate now. The way that the surfaces
    // can have gone towards each other is bounded by the sum of their largest speeds since; where only part
    // of that is closing speed now, it is taken to stay that part.
    const auto   largest = largest_speeds(v);
    const double speed =
      dealii::Utilities::MPI::max(largest[0], comm) + dealii::Utilities::MPI::max(largest[1], comm);
    until_refresh.travelled = 0.;
    until_refresh.allowed_travel =
      std::min(most_travel * search_reach,
               std::max(least_travel * reach, of_time_to_touch * speed * coupling.time_to_touch));
    until_refresh.due = std::numeric_limits<double>::max();
    Vector3             turning{};
    unsigned int        n_loaded = 0;
    std::vector<double> gap(coupling.rows.size()), approach(coupling.rows.size());
    for (unsigned int j = 0; j < coupling.rows.size(); ++j)
      {
        const MortarRow &row = coupling.rows[j];
        Vector3          distance{}, u{};
        for (std::size_t i = row.begin; i < row.end; ++i)
          {
            distance += coupling.entries[i].coefficient * all_x[coupling.entries[i].node];
            u += coupling.entries[i].coefficient * all_v[coupling.entries[i].node];
          }
        gap[j]      = dot(distance, row.normal);
        approach[j] = -dot(u, row.normal);
        if (norm(impulse_of_node[row.slave]) > 0.)
          {
            const double sliding = norm(u - dot(u, row.normal) * row.normal);
            if (sliding * until_refresh.due > parameters.sliding_share * face_size)
              until_refresh.due = parameters.sliding_share * face_size / sliding;
            ++n_loaded;
            for (const unsigned int f : slave_faces[row.slave])
              {
                const auto  &corners = surfaces.faces[f].nodes;
                const double share   = 1. / (slave_faces[row.slave].size() * face_size);
                turning += share * Vector3{dot(all_v[corners[2]] - all_v[corners[0]], row.normal),
                                           dot(all_v[corners[3]] - all_v[corners[1]], row.normal), 0., 0.};
              }
          }
      }
    if (const double rate = n_loaded > 0 ? norm(turning) / n_loaded : 0.;
        rate * until_refresh.due > parameters.turning)
      until_refresh.due = parameters.turning / rate;
    until_refresh.due  = std::max(until_refresh.due, time_step);
    until_refresh.time = 0.;

    std::vector<unsigned int> chosen;
    for (unsigned int j = 0; j < coupling.rows.size(); ++j)
      if (gap[j] <= MortarCoupling::candidates * reach || norm(impulse_of_node[coupling.rows[j].slave]) > 0.)
        chosen.push_back(j);
    compact(coupling, chosen, impulse_of_node, all_x);
    std::vector<char> is_near(involved.size(), false);
    for (unsigned int k = 0; k < chosen.size(); ++k)
      if (const unsigned int j = chosen[k];
          norm(pairs.impulse[k]) > 0. || gap[j] <= approach[j] * until_refresh.due)
        for (unsigned int i = problem.constraints[k].begin; i < problem.constraints[k].end; ++i)
          is_near[problem.entries[i].node] = true;
    near_contact.clear();
    for (unsigned int i = 0; i < involved.size(); ++i)
      if (is_near[i])
        near_contact.push_back(involved[i]);
    pair_friction.coefficient.clear();
    if (!coefficient_of_node.empty())
      for (const ContactProblem::Constraint &constraint : problem.constraints)
        pair_friction.coefficient.push_back(coefficient_of_node[constraint.slave]);
  }


  std::array<double, 2> Contact::largest_speeds(const Vector3 *v) const
  {
    std::array<double, 2> squares{{0., 0.}};
    for (const unsigned int side : {0u, 1u})
      {
        for (const unsigned int i : own_nodes[side])
          squares[side] = std::max(squares[side], dot(v[i], v[i]));
        squares[side] = std::sqrt(squares[side]);
      }
    return squares;
  }


  void Contact::compact(const MortarCoupling            &coupling,
                        const std::vector<unsigned int> &chosen,
                        const std::vector<Vector3>      &impulse_of_node,
                        const std::vector<Vector3>      &x)
  {
    std::vector<int> number(surfaces.nodes.size(), -1);
    involved.clear();
    problem.constraints.clear();
    problem.entries.clear();
    pairs.impulse.clear();
    corners_around.clear();
    steps_since_normals       = 0;
    const auto compact_number = [&](const unsigned int node) -> unsigned int {
      if (number[node] < 0)
        {
          number[node] = involved.size();
          involved.push_back(node);
        }
      return number[node];
    };
    for (const unsigned int j : chosen)
      {
        const MortarRow           &row = coupling.rows[j];
        ContactProblem::Constraint constraint{row.normal, row.area, 0., (unsigned int)problem.entries.size(),
                                              0,          row.slave};
        for (std::size_t i = row.begin; i < row.end; ++i)
          {
            const MortarEntry &entry = coupling.entries[i];
            problem.entries.push_back(
              {compact_number(entry.node), entry.coefficient, entry.coefficient * inverse_mass[entry.node]});
            constraint.compliance += entry.coefficient * entry.coefficient * inverse_mass[entry.node];
          }
        constraint.end = problem.entries.size();
        problem.constraints.push_back(constraint);
        pairs.impulse.push_back(impulse_of_node[row.slave]);
        corners_around.emplace_back();
        for (const unsigned int f : slave_faces[row.slave])
          for (const unsigned int i : surfaces.faces[f].nodes)
            corners_around.back().push_back(compact_number(i));
      }

    for (const ContactSurfaces::HangingNode &h : surfaces.hanging_nodes)
      if (number[h.node] >= 0)
        for (const unsigned int parent : h.parents)
          compact_number(parent);

    nodes.position.resize(involved.size());
    for (unsigned int i = 0; i < involved.size(); ++i)
      nodes.position[i] = x[involved[i]];
    pairs.previous_impulse = pairs.impulse;
    pairs.slid.assign(problem.constraints.size(), 0.);
    if (take_record)
      pairs.totals.assign(problem.constraints.size(), {});
    pairs.given_ratio.clear();
    if (prescribed.has_tractions())
      for (const ContactProblem::Constraint &constraint : problem.constraints)
        pairs.given_ratio.push_back(
          prescribed.traction_over_pressure(surfaces.nodes[constraint.slave].reference));
    renew_friction();
    make_room();
  }


  void Contact::renew_friction()
  {
    pair_friction.factor.clear();
    if (prescribed.varies_friction())
      for (const ContactProblem::Constraint &constraint : problem.constraints)
        pair_friction.factor.push_back(
          prescribed.friction_factor(surfaces.nodes[constraint.slave].reference, constraint.slave));
  }


  void Contact::make_room(const std::vector<unsigned int> &begin_of_strip)
  {
    const int this_rank = dealii::Utilities::MPI::this_mpi_process(comm);
    exchange.involved_of_rank.assign(dealii::Utilities::MPI::n_mpi_processes(comm), {});
    exchange.own.clear();
    for (unsigned int i = 0; i < involved.size(); ++i)
      {
        const ContactSurfaces::Node &node = surfaces.nodes[involved[i]];
        exchange.involved_of_rank[node.owner].push_back(i);
        if (node.owner == this_rank)
          exchange.own.push_back({i, static_cast<unsigned int>(node.local), inverse_mass[involved[i]]});
      }
    std::vector<int> number(surfaces.nodes.size(), -1);
    for (unsigned int i = 0; i < involved.size(); ++i)
      number[involved[i]] = i;
    involved_hanging.clear();
    for (const ContactSurfaces::HangingNode &h : surfaces.hanging_nodes)
      if (number[h.node] >= 0)
        involved_hanging.push_back({static_cast<unsigned int>(number[h.node]),
                                    {{static_cast<unsigned int>(number[h.parents[0]]),
                                      static_cast<unsigned int>(number[h.parents[1]])}}});
    pairs.master_of.assign(problem.constraints.size(), parameters.slave_body);
    for (unsigned int j = 0; j < problem.constraints.size(); ++j)
      for (unsigned int i = problem.constraints[j].begin; i < problem.constraints[j].end; ++i)
        if (const unsigned int body = surfaces.nodes[involved[problem.entries[i].node]].body;
            body != parameters.slave_body)
          pairs.master_of[j] = body;
    nodes.velocity.assign(involved.size(), Vector3{});
    nodes.predicted.assign(involved.size(), Vector3{});
    nodes.velocity_before.assign(involved.size(), Vector3{});
    nodes.mean_velocity.assign(involved.size(), Vector3{});
    pairs.offset.resize(problem.constraints.size());
    pairs.imposed.assign(problem.constraints.size(), Vector3{});
    pairs.before_entry.assign(problem.constraints.size(), Vector3{});
    pairs.slips.assign(problem.constraints.size(), false);
    const unsigned int n_ranks = exchange.involved_of_rank.size();
    if (parameters.reproducible)
      strips = Strips(problem);
    else
      strips = begin_of_strip.size() == n_ranks + 1
                 ? Strips(problem, begin_of_strip, involved.size(), *first_ranks)
                 : Strips(problem, pairs.impulse, involved.size(), *first_ranks);

    // Nodes that the sweeps of this rank's strip move, and others whose positions it needs.
    std::vector<char> swept(involved.size(), false), needed(involved.size(), false);
    for (unsigned int j = strips.begin; j < strips.end; ++j)
      for (unsigned int i = problem.constraints[j].begin; i < problem.constraints[j].end; ++i)
        swept[problem.entries[i].node] = true;
    for (unsigned int j = strips.first_acting; j < strips.end_acting; ++j)
      for (const unsigned int i : corners_around[j])
        needed[i] = true;
    rim_nodes.clear();
    for (unsigned int i = 0; i < involved.size(); ++i)
      if (surfaces.nodes[involved[i]].at_rim)
        {
          rim_nodes.push_back(i);
          needed[i] = true;
        }
    for (const ContactSurfaces::HangingNode &h : involved_hanging)
      if (needed[h.node])
        for (const unsigned int parent : h.parents)
          needed[parent] = true;
    exchange.received_from.assign(n_ranks, {});
    exchange.sent_to.assign(n_ranks, {});
    std::map<unsigned int, std::vector<unsigned int>> wanted;
    for (unsigned int i = 0; i < involved.size(); ++i)
      if (const int owner = surfaces.nodes[involved[i]].owner; (swept[i] || needed[i]) && owner != this_rank)
        wanted[owner].push_back(i);
    for (const auto &[rank, nodes] : wanted)
      exchange.received_from[rank] = nodes;
    if (n_ranks > 1)
      for (const auto &[rank, nodes] : dealii::Utilities::MPI::some_to_some(comm, wanted))
        exchange.sent_to[rank] = nodes;

    swept_nodes.clear();
    effects.of_nodes.clear();
    std::vector<int> number_of_terms(involved.size(), -1);
    for (unsigned int i = 0; i < involved.size(); ++i)
      {
        if (swept[i])
          swept_nodes.push_back(i);
        if (const ContactSurfaces::Node &node = surfaces.nodes[involved[i]];
            swept[i] || needed[i] || node.local >= 0)
          {
            number_of_terms[i] = effects.of_nodes.size();
            effects.of_nodes.push_back(
              {i, node.local, node.owner == this_rank, inverse_mass[involved[i]], 0, 0});
          }
      }
    for (const ContactProblem::Entry &entry : problem.entries)
      if (const int k = number_of_terms[entry.node]; k >= 0)
        ++effects.of_nodes[k].end;
    unsigned int n_terms = 0;
    for (EffectsOfPairs::NodeTerms &node : effects.of_nodes)
      {
        node.begin = n_terms;
        n_terms += std::exchange(node.end, n_terms);
      }
    effects.terms.resize(n_terms);
    for (unsigned int j = 0; j < problem.constraints.size(); ++j)
      for (unsigned int i = problem.constraints[j].begin; i < problem.constraints[j].end; ++i)
        if (const int k = number_of_terms[problem.entries[i].node]; k >= 0)
          effects.terms[effects.of_nodes[k].end++] = {j, problem.entries[i].coefficient};
  }


  void Contact::complete_normals()
  {
    gather_strips(problem.constraints);
  }


  void Contact::complete_state()
  {
    complete_normals();
    gather_strips(pair_friction.coefficient);
    gather_strips(pairs.previous_impulse);
    gather_strips(pairs.slid);
    gather_strips(pairs.totals);

    std::vector<Vector3> rows;
    for (const unsigned int i : exchange.involved_of_rank[dealii::Utilities::MPI::this_mpi_process(comm)])
      rows.push_back(nodes.position[i]);
    rows     = gathered(rows, comm);
    auto row = rows.begin();
    for (const std::vector<unsigned int> &of_rank : exchange.involved_of_rank)
      for (const unsigned int i : of_rank)
        nodes.position[i] = *row++;
  }


  void Contact::predict(const Vector3       *v,
                        const Vector3       *force,
                        const double         time_step,
                        std::vector<double> &extra)
  {
    const unsigned int n_ranks = exchange.involved_of_rank.size();
    // Measured as rarely as the normals are updated, because speeds change little in between.
    const bool            measures = steps_since_normals == 0;
    std::array<double, 2> largest  = measures ? largest_speeds(v) : std::array<double, 2>{{0., 0.}};
    for (std::size_t k = 0; k < exchange.own.size(); ++k)
      {
        // Surface nodes lie far apart among those of the body.
        constexpr std::size_t ahead = 8;
        if (k + ahead < exchange.own.size())
          {
            __builtin_prefetch(v + exchange.own[k + ahead].local);
            __builtin_prefetch(force + exchange.own[k + ahead].local);
          }
        const auto [node, local, inverse_mass] = exchange.own[k];
        nodes.velocity_before[node]            = v[local];
        nodes.predicted[node]                  = v[local] + time_step * inverse_mass * force[local];
      }

    if (n_ranks > 1)
      {
        const unsigned int this_rank = dealii::Utilities::MPI::this_mpi_process(comm);
        std::vector<int>   send_counts(n_ranks, 0), send_offsets(n_ranks, 0), counts(n_ranks, 0),
          offsets(n_ranks, 0);
        unsigned int total = 0;
        exchange.send_buffer.clear();
        for (unsigned int rank = 0; rank < n_ranks; ++rank)
          {
            offsets[rank]      = total;
            send_offsets[rank] = exchange.send_buffer.size();
            if (rank == this_rank)
              continue;
            exchange.send_buffer.insert(exchange.send_buffer.end(), largest.begin(), largest.end());
            exchange.send_buffer.insert(exchange.send_buffer.end(), extra.begin(), extra.end());
            for (const unsigned int i : exchange.sent_to[rank])
              for (const Vector3 &row : {nodes.velocity_before[i], nodes.predicted[i]})
                exchange.send_buffer.insert(exchange.send_buffer.end(), {row[0], row[1], row[2]});
            send_counts[rank] = exchange.send_buffer.size() - send_offsets[rank];
            counts[rank]      = largest.size() + extra.size() + 6 * exchange.received_from[rank].size();
            total += counts[rank];
          }
        exchange.receive_buffer.resize(total);
        MPI_Alltoallv(exchange.send_buffer.data(), send_counts.data(), send_offsets.data(), MPI_DOUBLE,
                      exchange.receive_buffer.data(), counts.data(), offsets.data(), MPI_DOUBLE, comm);
        std::vector<double> sums(extra.size(), 0.);
        for (unsigned int rank = 0; rank < n_ranks; ++rank)
          {
            const double *received = exchange.receive_buffer.data() + offsets[rank];
            if (rank != this_rank)
              for (double &speed : largest)
                speed = std::max(speed, *received++);
            for (unsigned int i = 0; i < extra.size(); ++i)
              sums[i] += rank == this_rank ? extra[i] : *received++;
            for (const unsigned int i : exchange.received_from[rank])
              {
                nodes.velocity_before[i] = Vector3{received[0], received[1], received[2], 0.};
                nodes.predicted[i]       = Vector3{received[3], received[4], received[5], 0.};
                received += 6;
              }
          }
        extra = sums;
      }
    if (measures)
      until_refresh.closing_speed = largest[0] + largest[1];
    until_refresh.travelled += time_step * until_refresh.closing_speed;
  }


  void Contact::update_normals()
  {
    for (unsigned int j = strips.first_acting; j < strips.end_acting; ++j)
      {
        Vector3 sum{};
        for (unsigned int k = 0; k < corners_around[j].size(); k += 4)
          {
            const unsigned int *c = &corners_around[j][k];
            sum +=
              cross(nodes.position[c[2]] - nodes.position[c[0]], nodes.position[c[3]] - nodes.position[c[1]]);
          }
        problem.constraints[j].normal = sum * (1. / norm(sum));
      }
    steps_since_normals = 0;
  }


  Vector3 Contact::slip_before_entry(const ContactProblem::Constraint &constraint,
                                     const double                      gap_over_step,
                                     const Vector3                     sliding) const
  {
    const Vector3 u       = problem.combine(constraint, nodes.velocity_before);
    const double  opening = dot(u, constraint.normal);
    if (opening >= 0. || gap_over_step <= 0.)
      return Vector3{};
    return std::min(1., gap_over_step / -opening) * (u - opening * constraint.normal + sliding);
  }


  CoulombSolverResult Contact::solve(const double time_step, Vector3 *force)
  {
    if (++steps_since_normals > steps_between_normals)
      update_normals();
    for (const unsigned int i : swept_nodes)
      nodes.velocity[i] = nodes.predicted[i];
    for (unsigned int j = strips.begin; j < strips.end; ++j)
      {
        const ContactProblem::Constraint &constraint = problem.constraints[j];
        pairs.offset[j] = (dot(problem.combine(constraint, nodes.position), constraint.normal) / time_step) *
                          constraint.normal;
        if (prescribed.has_sliding())
          {
            const Vector3 sliding =
              prescribed.sliding(surfaces.nodes[constraint.slave].reference, pairs.master_of[j]);
            pairs.imposed[j] = sliding - dot(sliding, constraint.normal) * constraint.normal;
            pairs.offset[j] += pairs.imposed[j];
          }
        pairs.before_entry[j] =
          pairs.given_ratio.empty() && dot(pairs.impulse[j], pairs.impulse[j]) == 0.
            ? slip_before_entry(constraint, dot(pairs.offset[j], constraint.normal), pairs.imposed[j])
            : Vector3{};
        pairs.offset[j] -= pairs.before_entry[j];
      }
    // Impulses change smoothly while rolling: the start is extrapolated from the last two steps.
    for (unsigned int j = strips.first_acting; j < strips.end_acting; ++j)
      {
        const Vector3 guess       = 2. * pairs.impulse[j] - pairs.previous_impulse[j];
        pairs.previous_impulse[j] = pairs.impulse[j];
        if (dot(pairs.impulse[j], pairs.impulse[j]) > 0. && dot(guess, problem.constraints[j].normal) > 0.)
          pairs.impulse[j] = guess;
      }
    const CoulombSolverResult result =
      solve_coulomb(problem, *friction, parameters.solver, strips, pairs.offset, nodes.velocity,
                    pairs.impulse, pairs.slips, pairs.given_ratio, pair_friction, time_step);

    bool slid_enough = false;
    for (unsigned int j = strips.begin; j < strips.end; ++j)
      {
        const ContactProblem::Constraint &constraint = problem.constraints[j];
        if (dot(pairs.impulse[j], constraint.normal) <= 0. || !pairs.slips[j])
          continue;
        const Vector3 after = problem.combine(constraint, nodes.velocity);
        pairs.slid[j] += time_step * norm(after - dot(after, constraint.normal) * constraint.normal);
        slid_enough = slid_enough || pairs.slid[j] > parameters.sliding_share * face_size;
      }
    if (!pair_friction.coefficient.empty())
      age_friction(time_step);
    // All that sweep know the same change; the others know none.
    const bool unconverged = result.change > parameters.solver.tolerance;
    const auto found =
      static_cast<int>(strips.gather(pairs.impulse, (unconverged ? 2. : 0.) + (slid_enough ? 1. : 0.)));
    n_unconverged_steps += found / 2;
    if (found % 2 > 0)
      until_refresh.make_due(); // also for pairs that did not touch at the last refresh

    work = ContactWork();
    for (const EffectsOfPairs::NodeTerms &of_node : effects.of_nodes)
      {
        Vector3      sum[2] = {}; // each addition waits for the one before it
        unsigned int k      = of_node.begin;
        for (; k + 2 <= of_node.end; k += 2)
          for (unsigned int half : {0u, 1u})
            sum[half] +=
              effects.terms[k + half].coefficient * pairs.impulse[effects.terms[k + half].constraint];
        if (k < of_node.end)
          sum[0] += effects.terms[k].coefficient * pairs.impulse[effects.terms[k].constraint];
        const Vector3 p     = sum[0] + sum[1];
        Vector3      &after = nodes.velocity[of_node.node];
        after               = nodes.predicted[of_node.node] + of_node.inverse_mass * p;
        nodes.position[of_node.node] += time_step * after;
        nodes.mean_velocity[of_node.node] = 0.5 * (after + nodes.velocity_before[of_node.node]);
        if (of_node.local < 0)
          continue;
        const Vector3 before = force[of_node.local];
        force[of_node.local] += (1. / time_step) * p;
        if (of_node.owned)
          {
            // The work is that of the force actually applied to the node, not of the impulse intended.
            const Vector3 passed_on = time_step * (force[of_node.local] - before);
            work.on_nodes.add(-0.5 * dot(passed_on, nodes.velocity_before[of_node.node] +
                                                      nodes.predicted[of_node.node] +
                                                      of_node.inverse_mass * passed_on));
          }
      }
    add_work_of_pairs();
    for (const ContactSurfaces::HangingNode &h : involved_hanging)
      nodes.position[h.node] = 0.5 * (nodes.position[h.parents[0]] + nodes.position[h.parents[1]]);
    until_refresh.time += time_step;
    return result;
  }


  void Contact::age_friction(const double time_step)
  {
    const FrictionLaw::Memory memory       = friction->memory();
    const double              without_slip = friction->coefficient(0.);
    for (unsigned int j = strips.begin; j < strips.end; ++j)
      {
        const ContactProblem::Constraint &constraint = problem.constraints[j];
        if (dot(pairs.impulse[j], constraint.normal) <= 0.)
          {
            pair_friction.coefficient[j] = without_slip;
            continue;
          }
        const Vector3 u = problem.combine(constraint, nodes.velocity);
        const double  speed =
          pairs.slips[j] ? norm(u - dot(u, constraint.normal) * constraint.normal + pairs.imposed[j]) : 0.;
        const double in_the_long_run = friction->coefficient(speed);
        pair_friction.coefficient[j] =
          in_the_long_run + (pair_friction.coefficient[j] - in_the_long_run) *
                              std::exp(-std::max(speed, memory.speed) * time_step / memory.distance);
      }
  }
} // namespace tread
