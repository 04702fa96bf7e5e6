// SPDX-License-Identifier: LGPL-2.1-or-later
// Slip chatter: zero if the slip of each point is linear in its position in the patch, and equal to the
// prescribed chatter otherwise.
#include <tread/analysis/contact_patch.h>

#include <deal.II/base/numbers.h>

#include "check.h"

#include <random>

using namespace tread;

namespace analysis_chatter
{
  constexpr double       cell = 1e-3, half = 6e-3, largest = 0.4; // m, m, m/s
  constexpr unsigned int n_steps = 60;

  /// The patch of half-length `half` rolls by one cell; behind its middle slip grows to `largest`.
  /// @param power 1: in a straight line; noise: RMS added to both directions, m/s.
  double chatter(const double power, const double noise)
  {
    std::mt19937               random(3);
    std::normal_distribution<> deviation(0., noise);
    PatchAverage               average;
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        const double                  centre = cell * (double(n) / n_steps - 0.5);
        std::vector<ContactNodeState> states;
        for (int i = -20; i <= 20; ++i)
          {
            const double x = i * cell - centre;
            // Nodes whose slip begins between two steps have a bend in it: none lies there.
            if (std::abs(x) > half || std::abs(i) < 1)
              continue;
            ContactNodeState state{};
            state.node     = i + 100;
            state.position = Vector3{i * cell, 0., 0., 0.};
            state.normal   = Vector3{0., 0., 1., 0.};
            state.impulse  = Vector3{0., 0., 1., 0.};
            state.area     = cell * cell;
            if (i < 0)
              state.slip =
                Vector3{largest * std::pow(-x / half, power) + deviation(random), deviation(random), 0., 0.};
            else
              state.slip = Vector3{deviation(random), deviation(random), 0., 0.};
            states.push_back(state);
          }
        average.add(states, centre, 1e-7);
      }
    return average.slip_chatter();
  }
} // namespace analysis_chatter


TREAD_TEST(analysis_chatter)(tests::Check &check, const tests::Arguments &)
{
  check.below("steady slip, straight over the patch", chatter(1., 0.), 1e-6);
  check.below("steady slip, curved", chatter(2., 0.), 0.01);
  check.that("but not nothing", chatter(2., 0.) > 1e-5);
  // Both directions: sqrt(2) of one. The largest mean slip is that of the last node, half a cell from the
  // end.
  for (const double noise : {0.01, 0.1})
    check.relative("noise that was put in, over the largest slip", chatter(1., noise),
                   std::sqrt(2.) * noise / largest, 0.1);
}
