// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_energy_ledger_h
#define tread_dynamics_energy_ledger_h

#include <tread/base/archive.h>
#include <tread/base/reproducible_sum.h>

#include <cmath>

namespace tread
{
  /// Stored and dissipated energies since the start, J; sums over all ranks.
  struct EnergyLedger
  {
    /// Drive, guidance, suspension, weight, prescribed forces, imposed sliding, cells of the surface that
    /// become or cease to be matched, and added density that comes or goes with a window of fine cells.
    double external_work = 0.;
    double gross_work    = 0.; ///< sum of its absolute parts: the scale of the residual
    double kinetic = 0., strain = 0., hourglass = 0.; ///< changes since the start
    double friction = 0., contact = 0., damping = 0.; ///< lost so far
    double plastic = 0.;                              ///< work on plastic strain so far
    double window  = 0.; ///< lost so far where another mesh does not carry what fine cells did
    double springs = 0.; ///< of the supports, change since the start
    double dampers = 0.; ///< the supports' part of damping
    /// Lost so far by the contact forces on the nodes, and put in with imposed sliding: friction + contact.
    double contact_on_nodes = 0.;
    double stored_strain = 0., stored_hourglass = 0.; ///< in the cells now

    double residual() const
    {
      return external_work -
             (kinetic + strain + hourglass + springs + friction + contact + damping + plastic + window);
    }
    double residual_share() const
    {
      return gross_work > 0. ? residual() / gross_work : 0.;
    }

    /// Energy dissipated by friction, plastic strain, damping and contact. Drive and guidance pass much more
    /// energy through the contact, which is no measure for errors.
    double dissipated() const
    {
      return friction + plastic + damping + std::abs(contact);
    }

    /// A work over the dissipated energy; 0 if nothing was dissipated.
    double of_dissipated(const double work) const
    {
      return dissipated() > 0. ? work / dissipated() : 0.;
    }

    /// A work over the energy dissipated by friction and plastic strain, the purpose of a run; 0 if there was
    /// none.
    double of_friction_and_plasticity(const double work) const
    {
      return friction + plastic > 0. ? work / (friction + plastic) : 0.;
    }

    /// Energy in the hourglass modes over all that the cells hold now.
    double hourglass_of_internal() const
    {
      const double internal = stored_strain + stored_hourglass;
      return internal > 0. ? stored_hourglass / internal : 0.;
    }
  };

  /// The same as LedgerTotals, of all ranks, J.
  struct LedgerSums
  {
    double external_work, gross_work, friction, contact, damping, plastic, contact_on_nodes, window;
  };

  /// What steps add to the ledger, J: this rank's shares of what it has by these names.
  struct LedgerTotals
  {
    ReproducibleSum<double> external_work, gross_work, friction, contact, damping, plastic, contact_on_nodes,
      window;

    void serialize(Archive &archive)
    {
      for (ReproducibleSum<double> *total :
           {&external_work, &gross_work, &friction, &contact, &damping, &plastic, &contact_on_nodes, &window})
        total->serialize(archive);
    }
  };
} // namespace tread

#endif
