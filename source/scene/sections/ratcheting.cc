// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/ratcheting.h>

namespace tread
{
  void RatchetingSection::declare(ParameterTable &table)
  {
    Section section(table, "Ratcheting");

    section.add("Strain at failure (%)", strain_at_failure,
                "Net plastic strain at which the steel of the rail cracks: what is left after all passages, "
                "without what goes forth and back in each. The run ends with the passage that reaches it. "
                "0: none.",
                Number(0., 1e5));
    section.add("Uniform rail", uniform,
                "true: what a wheel leaves in the middle of its path is given to the rail along its whole "
                "length before the next one comes, as if all had rolled from far before to far behind. "
                "Without it steel that is moved along the rail piles up at the ends of the path.");
    section.add("Jumps", jumps,
                "true: once the rail changes alike from passage to passage, its change is extrapolated over "
                "passages that are not rolled; doc/ratcheting.md.");
    section.all_need({{"Ratcheting/Jumps", {"true"}}});
    section.add(
      "Rolled between jumps", rolled_between,
      "Passages that are rolled between two jumps at least: by the last three what fades behind a jump "
      "is told from what goes on.",
      WholeNumber(3, 1000));
    section.add("Irregularity (%)", irregularity,
                "There is no jump while the change per passage differs by more than this, in its root mean "
                "square over the cells, from that of the passage before.",
                Number(0.01, 100.));
    section.add("Change in a jump (%)", change_in_a_jump,
                "A jump is so short that the change per passage becomes another one by this at most in it, "
                "in its root mean square over the cells.",
                Number(0.1, 100.));
    section.add("Strain of a jump (%)", strain_of_a_jump,
                "Largest change of the net plastic strain of a cell in a jump.", Number(1e-4, 20.));
    section.add("Longest jump", longest_jump, "Passages that are left out in a jump at most.",
                WholeNumber(2, 100000));
  }
} // namespace tread
