// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/output/quality.h>
#include <tread/output/summary_keys.h>

#include <cmath>
#include <cstdio>
#include <limits>

namespace tread
{
  const Columns<Quality> &quality_columns()
  {
    using Q = Quality;
    static const Columns<Q> columns{
      {"energy_residual_share", "", "Energy that is not accounted for over the gross work, with its sign",
       [](const Q &q) {
         return q.energy.residual_share();
       }},
      {"external_work", "J",
       "Work of drive, guidance, suspension, weight, imposed sliding and cells of the surface that become "
       "matched, since the start (of the last "
       "passage)",
       [](const Q &q) {
         return q.energy.external_work;
       }},
      {"gross_work", "J", "The same with all parts counted as positive",
       [](const Q &q) {
         return q.energy.gross_work;
       }},
      {"frictional_work", "J", "Work of friction since then",
       [](const Q &q) {
         return q.energy.friction;
       }},
      {"damping_work", "J",
       "Work lost to stiffness and mass damping, bulk viscosity and the dampers of a track since then",
       [](const Q &q) {
         return q.energy.damping;
       }},
      {"plastic_work", "J", "Work on plastic strain since then",
       [](const Q &q) {
         return q.energy.plastic;
       }},
      {"contact_loss", "J",
       "Energy that the contact took other than by sliding since then; negative: it gave",
       [](const Q &q) {
         return q.energy.contact;
       }},
      {"energy_residual", "J",
       "Energy that is not accounted for: external work less what has been stored and lost since then",
       [](const Q &q) {
         return q.energy.residual();
       }},
      {"contact_work_on_nodes", "J",
       "Work that the contact forces took from the nodes, and that imposed sliding put in: it must equal the "
       "sum of frictional work and contact loss",
       [](const Q &q) {
         return q.energy.contact_on_nodes;
       }},
      {"dissipated_work", "J",
       "Work of friction, plastic strain and damping, and the size of the contact loss",
       [](const Q &q) {
         return q.energy.dissipated();
       }},
      {"energy_residual_of_dissipated", "",
       "Energy that is not accounted for over the dissipated work, with its sign",
       [](const Q &q) {
         return q.energy.of_dissipated(q.energy.residual());
       }},
      {"contact_loss_of_dissipated", "", "Contact loss over the dissipated work",
       [](const Q &q) {
         return q.energy.of_dissipated(q.energy.contact);
       }},
      {"contact_loss_of_friction_and_plasticity", "",
       "Contact loss over the work of friction and plastic strain",
       [](const Q &q) {
         return q.energy.of_friction_and_plasticity(q.energy.contact);
       }},
      {"damping_of_friction_and_plasticity", "", "Damping work over the work of friction and plastic strain",
       [](const Q &q) {
         return q.energy.of_friction_and_plasticity(q.energy.damping);
       }},
      {"hourglass_of_internal_energy", "",
       "Energy of hourglass modes over all energy that the cells hold at the end",
       [](const Q &q) {
         return q.energy.hourglass_of_internal();
       }},
      {"contact_unconverged_share", "",
       "Share of the steps in which the iteration of the contact ended before 'Contact/Tolerance' was "
       "reached",
       [](const Q &q) {
         return q.contact_unconverged;
       }},
      {"slip_chatter_share", "",
       "Deviation of the micro-slip in single steps from the straight line over the position in the patch "
       "that fits it best, "
       "RMS over nodes and steps in contact, over the largest mean slip, while the wheel rolls over one cell "
       "around the end of the path; null if nothing was averaged",
       [](const Q &q) {
         return q.slip_chatter.value_or(std::numeric_limits<double>::quiet_NaN());
       }}};
    return columns;
  }


  namespace
  {
    SummaryKeys keys_of_quality()
    {
      SummaryKeys keys;
      for (const Column<Quality> &column : quality_columns())
        keys.push_back({heading(column), column.about});
      return keys;
    }

    const bool keys_of_quality_are_known = know_summary_keys(SummaryGroup::quality, keys_of_quality());
  } // namespace


  void Quality::add_to(Summary &summary) const
  {
    for (const Column<Quality> &column : quality_columns())
      summary.set(heading(column), column.value(*this)); // NaN is written as null
  }


  std::string Quality::lines() const
  {
    const EnergyLedger &e     = energy;
    const double        share = e.dissipated() > 0. ? 100. / e.dissipated() : 0.;
    std::string         text =
      format("dissipated %.4g J: friction %.2f %%, plasticity %.2f %%, damping %.2f %%, contact "
             "%+.2f %%; energy residual %+.3f %% of it\n",
             e.dissipated(), share * e.friction, share * e.plastic, share * e.damping, share * e.contact,
             share * e.residual());
    text += format("hourglass energy %.2f %% of the internal energy; ", 100. * e.hourglass_of_internal());
    if (slip_chatter)
      text += format("slip chatter %.1f %% of the largest slip; ", 100. * *slip_chatter);
    return text + format("contact not converged in %.2f %% of the steps\n", 100. * contact_unconverged);
  }


  std::vector<std::string> Quality::warnings() const
  {
    std::vector<std::string> list;
    const EnergyLedger      &e = energy;
    const auto warn = [&](const double share, const double large, const char *what, const char *advice) {
      if (std::abs(share) > large)
        list.push_back(format("%s (%.*f %%, above %g %%): %s", what, std::abs(share) < 0.1 ? 1 : 0,
                              100. * share, 100. * large, advice));
    };
    const double internal  = e.stored_strain + e.stored_hourglass;
    const auto   if_counts = [&](const double work, const double share, const double least) {
      return std::abs(work) > least * internal ? share : 0.;
    };
    warn(if_counts(e.residual(), e.of_dissipated(e.residual()), negligible), limits.residual,
         "energy of the run is not accounted for, as a share of what was dissipated",
         "do not trust frictional power and creepage to better than that; try a smaller Courant number");
    warn(if_counts(e.contact, e.of_dissipated(e.contact), negligible), limits.contact_loss,
         "contact takes or gives energy other than by friction",
         "usual where nodes strike, otherwise the cells are too large for the patch");
    const double of_cells   = e.damping - e.dampers;
    const double of_damping = if_counts(of_cells, e.of_friction_and_plasticity(of_cells), negligible_damping);
    // Without friction and plasticity there is nothing to compare with.
    warn(if_counts(e.friction + e.plastic, of_damping, negligible), limits.damping,
         "numerical damping takes a large share beside friction and plasticity",
         "lower 'Solid/Mass damping (1 per s)' or 'Solid/Stiffness damping (time steps)'");
    warn(e.hourglass_of_internal(), limits.hourglass, "hourglass modes hold much of the internal energy",
         "cells there are too large; compare 'Solid/Element' fully-integrated or another 'Solid/Hourglass "
         "coefficient'");
    warn(
      if_counts(e.friction, slip_chatter.value_or(0.), negligible), limits.chatter,
      "micro-slip of single steps chatters about its mean",
      "take slip and state of patch.csv from patch_averaged.csv; 'Solid/Stiffness damping (time steps)' 0.1 "
      "removes chatter of the cells");
    warn(contact_unconverged, limits.unconverged, "contact did not reach its tolerance in many steps",
         "raise 'Contact/Largest number of sweeps' or 'Contact/Tolerance'");
    return list;
  }
} // namespace tread
