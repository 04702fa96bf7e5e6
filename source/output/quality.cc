// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/output/quality.h>

#include <cmath>
#include <cstdio>

namespace tread
{
  void Quality::add_to(Summary &summary) const
  {
    const EnergyLedger &e = energy;
    summary.set("energy_residual_share", e.residual_share());
    for (const auto &[name, value] : std::vector<std::pair<const char *, double>>{
           {"external_work_J", e.external_work},
           {"gross_work_J", e.gross_work},
           {"frictional_work_J", e.friction},
           {"damping_work_J", e.damping},
           {"plastic_work_J", e.plastic},
           {"contact_loss_J", e.contact},
           {"energy_residual_J", e.residual()},
           {"contact_work_on_nodes_J", e.contact_on_nodes},
           {"dissipated_work_J", e.dissipated()},
           {"energy_residual_of_dissipated", e.of_dissipated(e.residual())},
           {"contact_loss_of_dissipated", e.of_dissipated(e.contact)},
           {"contact_loss_of_friction_and_plasticity", e.of_friction_and_plasticity(e.contact)},
           {"damping_of_friction_and_plasticity", e.of_friction_and_plasticity(e.damping)},
           {"hourglass_of_internal_energy", e.hourglass_of_internal()},
           {"contact_unconverged_share", contact_unconverged}})
      summary.set(name, value);
    if (slip_chatter)
      summary.set("slip_chatter_share", *slip_chatter);
    else
      summary.set("slip_chatter_share", nullptr);
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
