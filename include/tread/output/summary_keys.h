// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_summary_keys_h
#define tread_output_summary_keys_h

#include <tread/output/columns.h>

#include <compare>
#include <string>
#include <vector>

namespace tread
{
  /// Groups of the keys of summary.json, in the order of doc/columns.md.
  enum class SummaryGroup
  {
    run,            ///< what was solved, and whether to its end
    position,       ///< where a wheelset stands in its track
    wheels,         ///< what all wheels have, of the first one
    first_wheel,    ///< what only the first wheel has
    references,     ///< what figures are compared with, and patches beside those of the half-space
    words,          ///< notes, assumptions and warnings, and what was done to profiles as they were read
    quality,        ///< by which a run is judged
    impacts,        ///< extremes of a scene with a defect or a track
    size,           ///< how large the run was, and how far it rolled
    passages,       ///< how often wheels rolled over the rail, and what is left of it
    cost,           ///< time, memory and ranks; which program and which files
    further_wheels, ///< what all wheels have, of the second one
    recorded,       ///< what recorders add: stresses and strains, the history
    damage,         ///< what rolling does to the surfaces
    damage_indices, ///< the same in single numbers
    profile_wear,   ///< of profiles that wear (tread wear)
    peaks,          ///< largest values in the region of 'Peak stress'
    half_space      ///< of the half-space's answer alone
  };

  /// A key of summary.json and what it means, a line. Its unit is the end of its name.
  struct SummaryKey
  {
    std::string name, about;

    auto operator<=>(const SummaryKey &) const = default;
  };

  using SummaryKeys = std::vector<SummaryKey>;

  /// How a run's figures of the patch are taken, for their meanings.
  inline const std::string over_a_cell =
    "mean while the wheel rolls over one cell around the end of the path";

  /// Have keys known: for a constant beside what sets them, before main() begins. The second of several
  /// wheels and the first cell stand for others. The keys of a call stay in their order; several calls of a
  /// group are ordered by their first keys, as files may be linked in any order. @returns true
  bool know_summary_keys(SummaryGroup group, const SummaryKeys &keys);

  /// All keys that summary.json can have, with units and meanings, group by group: the largest pressure and
  /// Hertz stand for all figures that are compared and their sources. The keys of a patch are in
  /// scene/wheelset_summary.h. @throws std::logic_error if a key was described twice
  TableDescription keys_of_summary();

  /// Of a key in the summary, whatever number its name has; empty: it is none.
  /// @throws std::logic_error as keys_of_summary() does
  std::string about_summary_key(const std::string &key);
} // namespace tread

#endif
