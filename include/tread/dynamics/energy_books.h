// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_energy_books_h
#define tread_dynamics_energy_books_h

#include <tread/base/archive.h>
#include <tread/dynamics/energy_ledger.h>
#include <tread/dynamics/moving_bodies.h>

namespace tread
{
  /// Keeps the ledger of bodies that move: what steps have counted, what there was at the start, and samples
  /// of the power of damping, which is too dear to be found in every step.
  class EnergyBooks
  {
  public:
    explicit EnergyBooks(const MovingBodies &bodies)
      : moving(bodies)
    {
    }

    /// The motion begins with the present energies. Collective.
    void start();

    /// Present energies, when nodes must be synchronised. Collective; costs about two steps.
    EnergyLedger ledger() const;

    /// Whether damping is to be sampled in the step to come.
    bool sample_is_due() const
    {
      return moving.synchronised() &&
             (!is_sampled ||
              moving.state.n_steps >=
                last_step + moving.steps_worth(moving.parameters.steps_between_damping_samples));
    }
    /// What damping does in a step that samples it.
    struct DampingSample
    {
      NodalField force; ///< N
      double     power; ///< that it takes with the velocities before the step, W
    };
    DampingSample begin_sample() const;                    ///< before a step. Collective.
    void          end_sample(const DampingSample &sample); ///< when its velocities are known. Collective.

    /// Go on with the books of the same bodies on another mesh. @param damping_power at present, W
    void go_on_from(const EnergyBooks &before, const double damping_power);
    /// What a change of the mesh has taken and brought, J.
    void count_window(const double lost, const double added);

    void serialize(Archive &archive);

    LedgerTotals totals; ///< accumulated by the steps: this rank's shares

  private:
    /// What the energies of nodes, cells and parts are at present, J.
    struct Energies
    {
      double       kinetic = 0., potential = 0.;
      StrainEnergy strain{};
      double       external_work = 0., gross_work = 0.; ///< of the parts so far
      double       springs = 0., dissipated = 0.;       ///< likewise
    };
    struct Found
    {
      Energies   energies;
      LedgerSums totals;
    };
    Found find(const NodalField &cell_forces) const; ///< Collective.
    /// Kinetic energy from the velocities half a step back and the change that the cells' forces cause in
    /// half a step, of this rank's own nodes.
    ReproducibleSum<double> kinetic_energy_of_nodes(NodalField cell_forces) const;
    ReproducibleSum<double> potential_of_nodes() const; ///< of this rank's own
    StrainEnergySums        strain_energy_sums() const; ///< of this rank's cells
    /// Forces of the cells, before hanging nodes pass theirs to their parents.
    NodalField cell_forces() const;
    /// Contribution of damping to the forces of the cells of all ranks on nodes that do not hang, N. @param
    /// forces the present cell_forces(). @returns the dissipated power with the velocities of half a step
    /// back, of all ranks, W. Collective.
    double damping_forces(const NodalField &forces, NodalField &damping) const;
    /// That the forces on this rank's own nodes take with the present velocities, summed over all ranks, W.
    /// Collective.
    double power_of(const NodalField &forces) const;
    /// Energy dissipated from the step of the last sample to that before step n, if the power is this much
    /// at present, J.
    double damping_since_sample(const double power, const std::uint64_t n_steps) const;
    bool   is_first_rank() const;

    const MovingBodies &moving;
    Energies            at_start;
    double              last_power = 0.; ///< of damping when it was last sampled, W
    std::uint64_t       last_step  = 0;
    bool                is_sampled = false; ///< since start()
  };
} // namespace tread

#endif
