// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/start.h>

namespace tread
{
  template <>
  const std::vector<Choice<StartTractions>> &choices()
  {
    static const std::vector<Choice<StartTractions>> list{
      {StartTractions::none, "none",
       "the wheel stands without friction at the start, and the tangential tractions build up as it rolls."},
      {StartTractions::predicted, "predicted",
       "it starts with what half-space theory gives for steady rolling, so that only what differs from that "
       "must still build up, as where steel yields."}};
    return list;
  }


  void StartSection::declare(ParameterTable &table)
  {
    Section section(table, "Start");

    section.choose(
      "Tractions", tractions, "",
      "On a track the start takes some times as many iterations, and lateral tractions build up.");
    section.add("Tolerance", tolerance,
                "Largest residual of the force balance at the start, as a share of the largest force.",
                Number(1e-12, 0.01));
    section.add("Largest number of iterations", max_iterations,
                "Limit for the dynamic relaxation that finds the equilibrium at the start.",
                WholeNumber(1, 100000000));
  }
} // namespace tread
