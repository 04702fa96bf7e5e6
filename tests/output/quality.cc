// SPDX-License-Identifier: LGPL-2.1-or-later
// Warnings at the end of a run: none for a good run, one for each measure that is too large, and none if
// there is nothing to compare with.
#include <tread/output/quality.h>

#include "check.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace tread;

namespace output_quality
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
} // namespace output_quality

TREAD_TEST(output_quality)(tests::Check &check, const tests::Arguments &)
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

  // summary.json has them by their keys.
  Quality written                 = good();
  written.energy.plastic          = 0.7;
  written.energy.contact_on_nodes = 3.99;
  written.contact_unconverged     = 0.013;
  written.slip_chatter.reset();
  Summary summary;
  written.add_to(summary);
  const auto   json       = nlohmann::json::parse(summary.text());
  const double dissipated = 4. + 0.7 + 0.1 + 0.01, residual = 4.09 - (4. + 0.7 + 0.1 - 0.01);
  for (const auto &[key, value] :
       std::vector<std::pair<const char *, double>>{{"external_work_J", 4.09},
                                                    {"gross_work_J", 4000.},
                                                    {"frictional_work_J", 4.},
                                                    {"damping_work_J", 0.1},
                                                    {"plastic_work_J", 0.7},
                                                    {"contact_loss_J", -0.01},
                                                    {"energy_residual_J", residual},
                                                    {"energy_residual_share", residual / 4000.},
                                                    {"contact_work_on_nodes_J", 3.99},
                                                    {"dissipated_work_J", dissipated},
                                                    {"energy_residual_of_dissipated", residual / dissipated},
                                                    {"contact_loss_of_dissipated", -0.01 / dissipated},
                                                    {"contact_loss_of_friction_and_plasticity", -0.01 / 4.7},
                                                    {"damping_of_friction_and_plasticity", 0.1 / 4.7},
                                                    {"hourglass_of_internal_energy", 0.14 / 7.14},
                                                    {"contact_unconverged_share", 0.013}})
    check.relative(std::string("summary: ") + key, json.value(key, 0.), value, 1e-12);
  check.that("summary: slip chatter is null where nothing was averaged",
             json.contains("slip_chatter_share") && json["slip_chatter_share"].is_null());
}
