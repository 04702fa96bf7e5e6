// SPDX-License-Identifier: LGPL-2.1-or-later
// Warnings at the end of a run: none for a good run, one for each measure that is too large, and none if
// there is nothing to compare with.
#include <tread/output/quality.h>

#include "check.h"

#include <functional>

using namespace tread;

namespace
{
  Quality good()
  {
    Quality q;
    q.energy.friction         = 4.;
    q.energy.damping          = 0.1;
    q.energy.contact          = -0.01;
    q.energy.external_work    = 4.09; // of a ledger that closes
    q.energy.gross_work       = 4000.;
    q.energy.stored_strain    = 7.;
    q.energy.stored_hourglass = 0.14;
    q.slip_chatter            = 0.03;
    return q;
  }
} // namespace

void run_test(tests::Check &check, const tests::Arguments &)
{
  check.relative("dissipated: the contact loss counts whatever its sign, J", good().energy.dissipated(), 4.11,
                 1e-12);
  check.below("residual of a ledger that closes, J", good().energy.residual(), 1e-12);
  check.that("a good run: no warning", good().warnings().empty());
  struct Case
  {
    const char                    *name, *word;
    std::function<void(Quality &)> make_worse;
  };
  for (const Case &c : {Case{"residual", "not accounted for",
                             [](Quality &q) {
                               q.energy.external_work += 0.1;
                             }},
                        Case{"a residual that is gained", "not accounted for",
                             [](Quality &q) {
                               q.energy.external_work -= 0.1;
                             }},
                        Case{"contact loss", "contact takes or gives",
                             [](Quality &q) {
                               q.energy.contact = 0.1;
                               q.energy.external_work += 0.11;
                             }},
                        Case{"damping", "damping takes",
                             [](Quality &q) {
                               q.energy.damping = 0.9;
                               q.energy.external_work += 0.8;
                             }},
                        Case{"hourglass energy", "hourglass",
                             [](Quality &q) {
                               q.energy.stored_hourglass = 0.65;
                             }},
                        Case{"chatter", "chatters",
                             [](Quality &q) {
                               q.slip_chatter = 0.2;
                             }},
                        Case{"sweeps that do not converge", "tolerance", [](Quality &q) {
                               q.contact_unconverged = 0.02;
                             }}})
    {
      Quality q = good();
      c.make_worse(q);
      const auto warnings = q.warnings();
      check.that(std::string(c.name) + ": one warning",
                 warnings.size() == 1 && warnings[0].find(c.word) != std::string::npos);
    }
  Quality dampers = good();
  dampers.energy.damping += 1.;
  dampers.energy.dampers = 1.;
  dampers.energy.external_work += 1.;
  check.that("the dampers of a track are no numerical damping", dampers.warnings().empty());
  Quality free              = good();
  free.energy.friction      = 1e-5;
  free.energy.contact       = 0.;
  free.energy.external_work = 1e-5 + 0.1 + 0.003;
  free.slip_chatter         = 0.5;
  check.that("nothing slips: damping, chatter and a residual of 3 mJ are nothing to warn of",
             free.warnings().empty());
}
