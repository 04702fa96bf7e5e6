// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_explicit_dynamics_h
#define tread_dynamics_explicit_dynamics_h

#include <tread/contact/contact.h>
#include <tread/mesh/mesh.h>
#include <tread/solid/solid.h>
#include <tread/track/wheel_hub.h>

#include <functional>
#include <string>

namespace tread
{
  struct DynamicsParameters
  {
    /// Time step over the critical one.
    double courant_number = 0.9;
    /// Stiffness-proportional damping: internal forces are taken at x + beta v with
    /// beta = damping_steps time steps.
    double damping_steps = 0.1;
    double density_scale = 1.;
    double gravity       = 9.81; ///< m/s^2, along -z
  };

  /// Where energy is and went since the start, J; sums over all ranks.
  struct EnergyLedger
  {
    double external_work = 0.; ///< drive, guidance, suspension, weight, prescribed forces
    double gross_work    = 0.; ///< sum of its absolute parts: the scale of the residual
    double kinetic = 0., strain = 0., hourglass = 0.; ///< changes since the start
    double friction = 0., contact = 0., damping = 0.; ///< lost so far
    double plastic = 0.;                              ///< work on plastic strain so far

    double residual() const
    {
      return external_work - (kinetic + strain + hourglass + friction + contact + damping + plastic);
    }
    double residual_share() const;
  };

  /// Seconds that this rank spent since the start.
  struct StepTimes
  {
    double internal_forces = 0., contact = 0., search = 0., communication = 0., nodes = 0.;
  };

  /// Central differences for all bodies, the wheel's hub and the contact between them.
  ///
  /// v^(n+1/2) = v^(n-1/2) + dt M^-1 (f_int(x^n + beta v^(n-1/2)) + f_ext + G^T P/dt),
  /// x^(n+1) = x^n + dt v^(n+1/2), with the impulses P such that gaps at n+1 are closed or open
  /// and Coulomb's law holds for v^(n+1/2).
  class ExplicitDynamics
  {
  public:
    ExplicitDynamics(const Mesh &mesh, const Solid &solid, const DynamicsParameters &parameters);

    /// Hold these nodes (of this rank) where they are.
    void fix_nodes(const std::vector<unsigned int> &nodes);

    /// The nodes of a body's support boundary on this rank.
    std::vector<unsigned int> support_nodes(const unsigned int body) const;

    /// Carry the support nodes of a body by a rigid hub. The centrifugal force of density that is
    /// only scaled (not there) is compensated on this body, at the angular velocity given until start() takes
    /// the hub's.
    void attach_hub(WheelHub &hub, const unsigned int body, const double nominal_angular_velocity);

    void attach_contact(Contact &contact);

    /// Largest stable time step with the damping asked for, s: from the highest frequency of the mesh.
    /// Collective; costs some 80 force evaluations the first time, when all supports must have been set.
    double critical_time_step() const;

    /// Give the nodes of the wheel the velocities of the hub's rigid motion at their present positions.
    void set_wheel_velocities();

    /// Take over inertia and time step and zero the ledger; call after all that is attached and set.
    void start();

    void step();

    /// Equilibrium at rest under weight, the hub's static force and the centrifugal force of the
    /// true density at the nominal angular velocity: dynamic relaxation (Underwood 1983) with
    /// masses that give every cell the same frequency. Contact is frictionless here. Cells of plastic zones
    /// yield in one step, from their history before to the equilibrium: what is passed on the way to it
    /// leaves no trace.
    /// @param tolerance of the force balance, share of the largest force.
    /// @returns the number of iterations. @throws std::runtime_error if max_iterations do not do.
    unsigned int relax(const double                                     tolerance,
                       const unsigned int                               max_iterations,
                       const std::function<void(unsigned int, double)> &progress);

    /// Energies half a step back, the instant of the velocities. Collective; costs about one step.
    EnergyLedger ledger();

    /// @throws std::runtime_error with a clear line if nodes move faster than steel can. Collective.
    void check_stability() const;

    NodalField x, v;           ///< positions, m, and velocities (half a step back), m/s
    NodalField external_force; ///< N, by node; empty if none
    /// Of the cells of plastic zones, at x + beta v of the last step.
    PlasticHistory history;
    double         time = 0., time_step = 0.;
    std::uint64_t  n_steps = 0;
    StepTimes      times;

    const std::vector<double> &inverse_masses() const
    {
      return inverse_mass;
    }
    /// True nodal masses (kg), condensed and summed.
    const std::vector<double> &true_masses() const
    {
      return true_mass;
    }

    const Mesh  &mesh;
    const Solid &solid;

  private:
    /// Time step, inverse masses and all that follows from positions and velocities.
    void                set_inertia();
    std::vector<double> free_inverse_masses() const; ///< 0 where motion is prescribed
    mutable double      critical_step = 0.;
    void                add_hub_sums(std::vector<double> &sums) const;
    void                move_hub_nodes();
    double              kinetic_energy() const;
    double              body_potential(const NodalField &positions) const;
    /// Positions at the instant of the velocities, half a step back: there kinetic energy and work are known.
    NodalField positions_with_velocities() const;
    void       sample_damping();

    DynamicsParameters        parameters;
    NodalField                force, x_damped;
    std::vector<double>       true_mass, inverse_mass;
    std::vector<char>         fixed, carried, on_wheel;
    std::vector<unsigned int> hub_nodes;
    std::vector<Row>          hub_reference; ///< relative to the axle
    WheelHub                 *hub                      = nullptr;
    Contact                  *contact                  = nullptr;
    double                    nominal_angular_velocity = 0.;
    std::vector<double>       hub_sums;

    EnergyLedger  totals; ///< accumulated by step()
    double        start_kinetic = 0., start_potential = 0.;
    StrainEnergy  start_strain;
    double        start_hub_work = 0., start_hub_gross = 0.;
    double        last_damping_power = 0.;
    std::uint64_t last_damping_step  = 0;

    friend class Checkpoint;
  };
} // namespace tread

#endif
