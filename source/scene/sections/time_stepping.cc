// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/time_stepping.h>

namespace tread
{
  void TimeSteppingSection::declare(dealii::ParameterHandler &handler)
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    Section section(handler, "Time stepping");

    section.add("Courant number", courant_number,
                "Time step over the critical one. Above 1 the run may become unstable and stops.",
                Double(0.01, 2.));
    section.add(
      "Levels", levels,
      "Cells twice, four times, ... as slow as the fastest step only every second, fourth, ... time. "
      "1: all cells in every step. More levels pay where much of the mesh is coarse; results are at "
      "least 2^(levels - 1) steps apart.",
      Integer(1, 6));
  }
} // namespace tread
