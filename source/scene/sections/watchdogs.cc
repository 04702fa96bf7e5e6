// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/watchdogs.h>

namespace tread
{
  void WatchdogSection::declare(ParameterTable &table)
  {
    const Number positive(1e-12, 1e12);
    Section      section(table, "Watchdogs");

    section.add("Energy residual", warn.residual,
                "Share of the dissipated energy that may be unaccounted for before the run is warned of.",
                positive);
    section.add("Contact loss", warn.contact_loss,
                "Share of the dissipated energy that contact may take or give other than by friction, before "
                "a warning.",
                positive);
    section.add("Numerical damping", warn.damping,
                "What the damping of cells may take over friction and plasticity before a warning.",
                positive);
    section.add("Hourglass energy", warn.hourglass,
                "Share of the internal energy in hourglass modes before a warning.", positive);
    section.add("Slip chatter", warn.chatter,
                "RMS of single steps' micro-slip about its mean, over the largest slip, before a warning.",
                positive);
    section.add("Unconverged steps", warn.unconverged,
                "Share of the steps whose contact may miss its tolerance before a warning.", positive);
    section.add("Stop at energy residual", stop_at_residual,
                "A run stops where more energy than this share of what was dissipated or, if that is more, "
                "is stored as strain is not accounted for. Looked at with each row of history.csv.",
                positive);
    section.add("Stop at strain", stop_at.strain,
                "A run stops where a cell has a larger strain (Green-Lagrange, Frobenius' norm).", positive);
    section.add("Stop at volume", stop_at.volume,
                "A run stops where a cell has less of its volume before deformation.", Number(0., 1.));
    section.add("Stop at node speed (m per s)", stop_at.node_speed,
                "A run stops where a node is faster: an unstable step.", positive);
  }
} // namespace tread
