// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/time_stepping.h>

namespace tread
{
  void TimeSteppingSection::declare(ParameterTable &table)
  {
    Section section(table, "Time stepping");

    section.add("Courant number", courant_number,
                "Time step over the critical one. With 'Levels' above 1 and no mass damping, or with "
                "'Mesh/Window' true, it is at most 0.9, because longer steps resonate on some meshes.",
                Number(0.01, 1.));
    section.add(
      "Levels", levels,
      "Number of levels of time steps: cells whose critical step is twice, four times, ... the shortest one "
      "are evaluated in every second, fourth, ... step only. 1: all cells in every step. More levels pay "
      "where much of the mesh is coarse; results are then at least 2^(levels - 1) steps apart.",
      WholeNumber(1, 6));
    section.add(
      "Least step (us)", least_step,
      "Time step that the fastest cells are given mass for, where they would need a shorter one. For dynamic "
      "scenes whose "
      "few finest cells set the step: what is added is in the summary, by body, with an estimate of what it "
      "does to the "
      "contact force, which `--dry-run` prints for several steps. The step comes out longer where no cell "
      "can vibrate as fast in "
      "the mesh as it would alone. 0: all cells have their own density.",
      Number(0., 100.));
  }
} // namespace tread
