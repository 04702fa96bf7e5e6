// SPDX-License-Identifier: LGPL-2.1-or-later
// The state of the contact, stored and restored.
#include <tread/base/archive.h>
#include <tread/contact/contact.h>

#include <algorithm>

namespace tread
{
  bool Contact::is_consistent(const std::vector<unsigned int> &begin_of_strip) const
  {
    const std::size_t n_pairs = problem.constraints.size(), n_nodes = involved.size();
    const auto        all_below = [](const std::vector<unsigned int> &numbers, const std::size_t end) {
      return std::all_of(numbers.begin(), numbers.end(), [end](const unsigned int i) { return i < end; });
    };
    for (const std::size_t size :
         {pairs.impulse.size(), pairs.previous_impulse.size(), pairs.slid.size(), corners_around.size()})
      if (size != n_pairs)
        return false;
    for (const std::size_t size :
         {pair_friction.coefficient.size(), pair_friction.factor.size(), pairs.totals.size()})
      if (size != 0 && size != n_pairs)
        return false;
    if (nodes.position.size() != n_nodes || !all_below(involved, surfaces.nodes.size()) ||
        !all_below(near_contact, surfaces.nodes.size()))
      return false;

    // Entries belong to the pairs one after the other.
    unsigned int next = 0;
    for (const ContactProblem::Constraint &pair : problem.constraints)
      {
        if (pair.begin != next || pair.end < pair.begin || pair.slave >= surfaces.nodes.size())
          return false;
        next = pair.end;
      }
    if (next != problem.entries.size() ||
        !std::all_of(problem.entries.begin(), problem.entries.end(),
                     [n_nodes](const ContactProblem::Entry &entry) { return entry.node < n_nodes; }))
      return false;
    for (const std::vector<unsigned int> &corners : corners_around)
      if (corners.size() % 4 != 0 || !all_below(corners, n_nodes))
        return false;

    std::vector<char> is_involved(surfaces.nodes.size(), false);
    for (const unsigned int node : involved)
      is_involved[node] = true;
    for (const ContactSurfaces::HangingNode &h : surfaces.hanging_nodes)
      if (is_involved[h.node] && !(is_involved[h.parents[0]] && is_involved[h.parents[1]]))
        return false;
    return begin_of_strip.size() > 1 && begin_of_strip.front() == 0 && begin_of_strip.back() == n_pairs &&
           std::is_sorted(begin_of_strip.begin(), begin_of_strip.end());
  }


  void Contact::serialize(Archive &archive)
  {
    if (!archive.restores())
      complete_state();
    archive.same(problem.constraints, problem.entries, involved, nodes.position, pairs.impulse,
                 pairs.previous_impulse, pairs.slid, corners_around, steps_since_normals, until_refresh.time,
                 until_refresh.due, until_refresh.closing_speed, until_refresh.travelled,
                 until_refresh.allowed_travel, n_unconverged_steps, pair_friction.coefficient,
                 pair_friction.factor, near_contact, pairs.totals);
    archive.shares(work.friction, work.normal, work.adhesion, work.imposed);
    work.on_nodes.serialize(archive);
    std::vector<unsigned int> begin_of_strip = strips.begins();
    archive.same(begin_of_strip);
    if (archive.restores())
      {
        if (!is_consistent(begin_of_strip))
          throw OtherStoredLayout();
        make_room(begin_of_strip);
      }
    if (parameters.reproducible)
      archive.same(pairs.slips);
    else
      archive.own(pairs.slips); // on other ranks they are found by the next step
  }
} // namespace tread
