// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/dynamics/relaxation.h>
#include <tread/dynamics/soft_motions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace tread
{
  namespace
  {
    /// Largest frequency times step that the masses of the iteration give any cell: below 2, where central
    /// differences become unstable, with room for contact. Higher ones take fewer iterations.
    constexpr double frequency_of_cells = 1.8;

    /// Share of its velocity that damping leaves a node in an iteration: at the beginning, and the bounds of
    /// what is found from the frequency that still moves. The iteration is stable for
    /// frequency_of_cells^2 < 2 (1 + share), so above 0.62; the upper bound damps by half in 3500 iterations,
    /// slower than any scene needs (Underwood 1983).
    constexpr double kept_at_first = 0.9, least_kept = 0.75, most_kept = 0.9998;

    /// Iterations between two looks at the balance and the frequency. Twice as many find the best damping
    /// later, half as many cost more sums over the ranks.
    constexpr unsigned int iterations_between_looks = 20;

    /// Iterations between two balances of soft motions: until then the cells have followed the last.
    constexpr unsigned int iterations_between_balances = 200;

    /// Where soft motions meet less than this share of the resistance that their stiffness says, or the
    /// reverse, as springs open or close, their stiffness is found anew: so often at most in one iteration.
    constexpr double       least_of_expected = 0.8;
    constexpr unsigned int most_rounds       = 20;

    /// No node moves farther than this in one round, m: several times what sleepers sink or rails bend.
    constexpr double longest_soft_motion = 0.01;

    /// So often the coupling of a balanced contact is integrated anew. One or two are usual; more happen
    /// where two couplings alternate, because a pair at the border of the patch comes with one of them and
    /// goes with the other. Either is an equilibrium but for what this pair carries.
    constexpr unsigned int most_refreshes = 10;

    /// A slow motion is that of the whole wheel sinking into the contact. Its rigid shift is given this many
    /// times more acceleration by the total force, and a wheel of many cells so many times more that it sinks
    /// with this frequency into a contact of this stiffness (N/m): one of 100 kN between steel bodies of any
    /// wheel and rail; those of small wheels are softer.
    constexpr double least_lightness = 16., frequency_of_sinking = 0.1, stiffness_of_contact = 2e9;

    /// Iterations are the steps.
    constexpr double unit_step = 1.;

    /// N: stands for the load where there is none and nothing is out of balance at the start.
    constexpr double no_force = 1e-300;


    /// The iteration of relax(): its masses, loads and what changes from one iteration to the next. Positions
    /// and forces are those of the dynamics, velocities are displacements in an iteration.
    class Relaxation
    {
    public:
      /// @param tolerance of the balance, share of the load
      Relaxation(MovingBodies &moving, const double tolerance);
      /// The contact has its friction law and its sliding again.
      ~Relaxation()
      {
        if (d.contact)
          {
            d.contact->set_friction(law);
            d.contact->prescribed.impose_sliding(std::move(sliding));
          }
      }
      Relaxation(const Relaxation &)            = delete;
      Relaxation &operator=(const Relaxation &) = delete;

      /// Forces of cells, supports and weight where nodes are now, without the contact's.
      void find_forces();

      /// Find the damping that is best for the frequency that still moves, from the forces now and those
      /// remembered an iteration ago.
      void adapt_damping();
      void remember_forces()
      {
        previous = d.state.force;
      }

      /// Add the contact's forces, and sum what acts on the hubs.
      void add_contact();

      /// Move soft bodies as far as what is out of balance moves them, and the carried bodies on them along.
      /// @returns whether they were balanced before. Collective. @pre has_soft_motions()
      bool balance_soft_motions();
      bool has_soft_motions() const
      {
        return soft.has_value();
      }

      /// Displace all nodes and the hubs. @param measure: find the balance.
      void advance(const bool measure);

      /// What is out of balance over the load as advance() has last measured it; without a load, over what
      /// was out of balance the first time.
      double share_out_of_balance() const
      {
        return residual / scale();
      }

      void refresh_contact()
      {
        check_that_nodes_stay(); // a search among nodes that fly apart fills the memory
        d.contact->refresh(x.data(), d.state.v.data(), unit_step);
        // Cells that were near at some time stay matched, or the balance could depend on what it decides.
        const std::vector<unsigned int> near = d.contact->nodes_near();
        nodes_near.insert(nodes_near.end(), near.begin(), near.end());
        d.matched_surface.select(nodes_near);
        d.matched_surface.settle();
      }

    private:
      /// @throws std::runtime_error, one line, if nodes move by more in an iteration than any start needs.
      /// Collective.
      void check_that_nodes_stay() const;
      /// What forces out of balance are compared with, N.
      double scale() const
      {
        return load > 0. ? load : std::max(first_residual, no_force);
      }
      void set_masses();
      void set_loads();
      void find_soft_motions();
      /// Forces of all but contact with nodes displaced so from where they were (m); they stay there.
      const NodalField &forces_at(const NodalField &at, const NodalField &displacement);
      /// Sum of term(i) over the nodes of a carried body, each of them once. Collective.
      template <typename Term>
      double sum_of_body(const std::size_t k, const Term &term) const
      {
        return reproducible_sum(
          x.size(),
          [&](const std::size_t i) {
            return d.carrier_of(i) == static_cast<int>(k) && d.mesh.shared_nodes.is_owned(i) ? term(i) : 0.;
          },
          d.mesh.comm);
      }
      /// Sum of term(i) over the nodes that are free to move. Collective.
      template <typename Term>
      double sum_of_free(const Term &term) const
      {
        return reproducible_sum(
          x.size(), [&](const std::size_t i) { return is_free_and_owned(i) ? term(i) : 0.; }, d.mesh.comm);
      }
      /// Whether a node of this rank's own is free to move.
      bool is_free_and_owned(const unsigned int i) const
      {
        return inverse[i] > 0. && d.mesh.shared_nodes.is_owned(i);
      }

      MovingBodies             &d;
      const double              tolerance;
      NodalField               &x;          ///< positions, as there is no damping time
      const NodalField          at_rest;    ///< no velocities
      NodalField                mass;       ///< in [0], N/m, as the step has no unit
      std::vector<double>       inverse;    ///< of these, 0 where nodes are held or carried
      NodalField                body_force; ///< weight, true centrifugal force and external forces, N
      NodalField                previous;   ///< forces remembered, N
      std::vector<unsigned int> nodes_near; ///< the contact at any of its searches
      /// A carried body, a wheel on its hub.
      struct OfBody
      {
        double hub_mass = 0.;        ///< of the nodes that the hub carries
        double hub_load = 0.;        ///< static force of all but the cells, N
        double mass = 0., load = 0.; ///< of all nodes of the body; with the hub's load
        double lightness    = 0.;    ///< @see least_lightness; 0 without contact
        double hub_velocity = 0.;
        // Of a hub that rolls: the same about x through its middle, N m and the square of the arms times
        // mass.
        double hub_roll_inertia = 0., roll_inertia = 0., hub_roll_velocity = 0.;
      };
      /// A function of a node: its displacement by a small roll of its body about the body's middle, per
      /// radian, m.
      auto by_roll(const std::size_t k) const
      {
        return [this, middle = d.parts.carriers()[k]->motion().middle](const unsigned int i) {
          const Vector3 arm = x[i] - middle;
          return Vector3{0., arm[2], -arm[1], 0.};
        };
      }
      /// Moment of all forces on hub and cells of a body that rolls the hub, N m. Collective.
      double                     roll_moment(const std::size_t k) const;
      std::vector<OfBody>        bodies;
      std::optional<SoftMotions> soft;
      double                     keep = kept_at_first;
      double residual = 0., load = 0., first_residual = -1.; ///< N; negative: not measured yet
      std::shared_ptr<const FrictionLaw> law;                ///< of the motion to come
      PrescribedContact::Sliding         sliding;            ///< likewise
    };


    Relaxation::Relaxation(MovingBodies &moving, const double tolerance)
      : d(moving)
      , tolerance(tolerance)
      , x(d.state.x_damped)
      , at_rest(x.size(), Vector3{})
      , mass(x.size(), Vector3{})
      , inverse(x.size(), 0.)
      , body_force(x.size(), Vector3{})
      , previous(x.size(), Vector3{})
      , bodies(d.parts.carriers().size())
    {
      set_masses();
      set_loads();
      find_soft_motions();
      std::fill(d.state.v.begin(), d.state.v.end(), Vector3{});
      for (CarriesBody *carrier : d.parts.carriers())
        carrier->take(LoadsOnBody()); // those of a motion before are over
      if (d.contact)
        {
          d.contact->set_inverse_masses(inverse);
          law     = d.contact->set_friction(std::make_shared<CoulombFriction>(0.));
          sliding = d.contact->prescribed.impose_sliding({}); // metres in a unit step
          refresh_contact();
        }
    }


    void Relaxation::check_that_nodes_stay() const
    {
      constexpr double longest_way = 10e-3; // m
      bool             all_stay    = true;
      for (const Vector3 &way : d.state.v)
        all_stay = all_stay && dot(way, way) < longest_way * longest_way;
      if (dealii::Utilities::MPI::logical_or(!all_stay, d.mesh.comm))
        throw std::runtime_error(format("no equilibrium at the start: nodes move by more than %g mm in an "
                                        "iteration; what yields cannot carry "
                                        "the load, or supports do not hold the rail",
                                        1e3 * longest_way));
    }


    void Relaxation::set_masses()
    {
      // Masses with which a unit "time" step is stable, and equally so, for every cell.
      const Mesh &mesh        = d.mesh;
      const auto  cell_masses = d.solid.cell_masses(mesh);
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        {
          const double ratio = d.solid.cell_frequencies()[c] / frequency_of_cells;
          for (unsigned int a = 0; a < 8; ++a)
            mass[mesh.cells[c].nodes[a]][0] += d.quanta.stiffness.round(
              ratio * ratio * (d.parameters.density_scale + d.solid.added_share(c)) * cell_masses[c][a]);
        }
      mesh.condense_hanging_nodes(mass.data());
      mesh.shared_nodes.sum(mass.data());
      NodalField rows(x.size(), Vector3{});
      for (const auto &part : d.parts)
        part->add_row_sums(rows);
      mesh.shared_nodes.sum(rows.data());
      for (unsigned int i = 0; i < x.size(); ++i)
        mass[i][0] += rows[i][0] / (frequency_of_cells * frequency_of_cells);
      for (unsigned int i = 0; i < x.size(); ++i)
        if (!d.carried[i] && !d.fixed[i] && mass[i][0] > 0.)
          inverse[i] = 1. / mass[i][0];
      for (std::size_t k = 0; k < bodies.size(); ++k)
        {
          bodies[k].hub_mass =
            sum_of_body(k, [&](const std::size_t i) { return d.carried[i] ? mass[i][0] : 0.; });
          bodies[k].hub_roll_inertia = sum_of_body(k, [&, by_roll = by_roll(k)](const std::size_t i) {
            const Vector3 roll = by_roll(i);
            return d.carried[i] ? mass[i][0] * dot(roll, roll) : 0.;
          });
        }
    }


    void Relaxation::set_loads()
    {
      // Weight and true centrifugal force act on the true masses; once on nodes that ranks share.
      NodalField of_parts(x.size(), Vector3{});
      for (const auto &part : d.parts)
        part->add_static_loads(of_parts);
      std::vector<RigidMotion> motions;
      for (const CarriesBody *carrier : d.parts.carriers())
        motions.push_back(carrier->motion());
      for (unsigned int i = 0; i < x.size(); ++i)
        if (is_free_and_owned(i))
          {
            body_force[i] = Vector3{0., 0., -d.parameters.gravity * d.true_mass[i], 0.};
            if (const int number = d.carrier_of(i); number >= 0)
              {
                const RigidMotion &motion = motions[number];
                const double       omega  = d.parts.carriers()[number]->angular_velocity();
                const Vector3      arm    = x[i] - motion.middle;
                body_force[i] += omega * omega * d.true_mass[i] * (arm - dot(motion.axle, arm) * motion.axle);
              }
            body_force[i] = d.quanta.force.round(body_force[i] + of_parts[i]);
          }
      for (std::size_t k = 0; k < bodies.size(); ++k)
        {
          OfBody &wheel  = bodies[k];
          wheel.hub_load = d.parts.carriers()[k]->load().force;
          wheel.mass     = sum_of_body(k, [&](const std::size_t i) { return mass[i][0]; });
          if (d.contact)
            wheel.lightness = std::max(least_lightness, frequency_of_sinking * frequency_of_sinking *
                                                          wheel.mass / stiffness_of_contact);
          wheel.load = sum_of_body(k, [&](const std::size_t i) { return body_force[i][2]; }) + wheel.hub_load;
          wheel.roll_inertia = sum_of_body(k, [&, by_roll = by_roll(k)](const std::size_t i) {
            const Vector3 roll = by_roll(i);
            return mass[i][0] * dot(roll, roll);
          });
        }
    }


    void Relaxation::find_soft_motions()
    {
      std::vector<SoftBody> soft_bodies;
      for (const auto &part : d.parts)
        for (SoftBody &body : part->soft_bodies(d.state))
          soft_bodies.push_back(std::move(body));
      if (soft_bodies.empty())
        return;
      std::vector<char> moves(x.size());
      for (unsigned int i = 0; i < x.size(); ++i)
        moves[i] = inverse[i] > 0.;
      soft.emplace(
        d.mesh, soft_bodies, x, std::move(moves), [this](NodalField &field) { d.hold_guided_nodes(field); },
        d.quanta.force);
    }


    const NodalField &Relaxation::forces_at(const NodalField &at, const NodalField &displacement)
    {
      for (unsigned int i = 0; i < x.size(); ++i)
        x[i] = at[i] + displacement[i];
      find_forces();
      d.hold_guided_nodes(d.state.force);
      return d.state.force;
    }


    double Relaxation::roll_moment(const std::size_t k) const
    {
      return sum_of_body(k,
                         [&, by_roll = by_roll(k)](const std::size_t i) {
                           return inverse[i] > 0. ? dot(by_roll(i), d.state.force[i]) : 0.;
                         }) -
             d.parts.carriers()[k]->resultant(d.parts.sums_of_carrier(k)).moment[0];
    }


    void Relaxation::find_forces()
    {
      std::copy(body_force.begin(), body_force.end(), d.state.force.begin());
      d.solid.add_internal_forces(x.data(), at_rest.data(), d.state.force.data(), d.state.history);
      d.matched_surface.add_forces(x.data(), at_rest.data(), d.state.force.data(), 0.);
      d.mesh.condense_hanging_nodes(d.state.force.data());
      for (const auto &part : d.parts)
        {
          part->set_at_rest(d.state);
          part->add_forces(d.state.force);
        }
      d.mesh.shared_nodes.sum(d.state.force.data());
    }


    void Relaxation::adapt_damping()
    {
      // Rayleigh quotient of the last displacement, of which the velocities are what damping leaves: the
      // frequency that still moves (Underwood 1983).
      const double change = -sum_of_free([&](const std::size_t i) {
        return dot(d.state.v[i], d.state.force[i] - previous[i]);
      }) / keep;
      double       inertia =
        sum_of_free([&](const std::size_t i) { return dot(d.state.v[i], d.state.v[i]) / inverse[i]; });
      for (std::size_t k = 0; k < bodies.size(); ++k)
        {
          const OfBody &wheel    = bodies[k];
          const double  momentum = sum_of_body(
             k, [&](const std::size_t i) { return inverse[i] > 0. ? d.state.v[i][2] / inverse[i] : 0.; });
          const double total = momentum + wheel.hub_mass * wheel.hub_velocity;
          inertia += wheel.hub_mass * wheel.hub_velocity * wheel.hub_velocity;
          inertia -= wheel.lightness / (1. + wheel.lightness) * total * total / wheel.mass;
          if (!d.parts.carriers()[k]->rolls())
            continue;
          const double turning = sum_of_body(k, [&, by_roll = by_roll(k)](const std::size_t i) {
            return inverse[i] > 0. ? dot(by_roll(i), d.state.v[i]) / inverse[i] : 0.;
          });
          const double turns   = turning + wheel.hub_roll_inertia * wheel.hub_roll_velocity;
          inertia += wheel.hub_roll_inertia * wheel.hub_roll_velocity * wheel.hub_roll_velocity;
          if (d.contact)
            inertia -= least_lightness / (1. + least_lightness) * turns * turns / wheel.roll_inertia;
        }
      inertia /= keep * keep;
      const double omega = inertia > 0. ? std::sqrt(std::max(0., change / inertia)) : 0.;
      const double kept  = std::exchange(keep, std::clamp(1. - 2. * omega, least_kept, most_kept));
      for (Vector3 &velocity : d.state.v)
        velocity *= keep / kept;
      for (OfBody &wheel : bodies)
        {
          wheel.hub_velocity *= keep / kept;
          wheel.hub_roll_velocity *= keep / kept;
        }
    }


    void Relaxation::add_contact()
    {
      d.hold_guided_nodes(d.state.force);
      d.parts.set_sums(d.state, d.inverse_mass);
      if (d.contact)
        {
          if (d.contact->refresh_due())
            refresh_contact();
          d.contact->predict(d.state.v.data(), d.state.force.data(), unit_step, d.parts.sums());
          d.contact->solve(unit_step, d.state.force.data());
          d.hold_guided_nodes(d.state.force);
        }
      else
        d.parts.sum_over_ranks(d.mesh.comm);
    }


    bool Relaxation::balance_soft_motions()
    {
      // The carried bodies with all of their loads included.
      std::vector<MovingLoad> loads = d.parts.loads_of_carriers();
      for (std::size_t k = 0; k < bodies.size(); ++k)
        {
          const double on_nodes =
            sum_of_body(k, [&](const std::size_t i) { return d.carried[i] ? 0. : d.state.force[i][2]; });
          loads[k].force = on_nodes + d.parts.carriers()[k]->resultant(d.parts.sums_of_carrier(k)).force[2] +
                           bodies[k].hub_load;
        }
      const NodalField    all_forces = d.state.force; // with the contact's
      NodalField          at = x, forces = forces_at(at, at_rest), out_of_balance = all_forces;
      std::vector<double> up(bodies.size(), 0.);
      bool                as_expected = false;
      for (unsigned int round = 0; round < most_rounds && !as_expected; ++round)
        {
          const bool keeps_old =
            !soft->stiffness_is_known() && !soft->find_stiffness([&](const NodalField &displacement) {
              NodalField change = forces_at(at, displacement);
              for (unsigned int i = 0; i < x.size(); ++i)
                change[i] -= forces[i];
              return change;
            });
          const SoftMotions::Balance balance = soft->balance(out_of_balance, loads);
          if (balance.largest_force <= tolerance * scale())
            {
              if (round > 0)
                break;
              x             = at;
              d.state.force = all_forces;
              return true;
            }
          NodalField displacement = soft->field(balance.amplitudes);
          double     longest      = 0.;
          for (const Vector3 &of_node : displacement)
            longest = std::max(longest, norm(of_node));
          longest            = dealii::Utilities::MPI::max(longest, d.mesh.comm);
          double share_moved = std::min(1., longest_soft_motion / longest);
          for (Vector3 &of_node : displacement)
            of_node *= share_moved;
          // Springs that open or close resist otherwise than was found.
          const NodalField &then = forces_at(at, displacement);
          const double      resistance =
            sum_of_free([&](const std::size_t i) { return dot(displacement[i], forces[i] - then[i]); });
          const double share_again = share_moved * balance.work / std::abs(resistance);
          if (share_again < 1.)
            for (Vector3 &of_node : displacement)
              of_node *= share_again;
          const double found_over_met = share_again * share_moved;
          if (found_over_met < least_of_expected || found_over_met > 1. / least_of_expected)
            soft->forget_stiffness();
          share_moved *= std::min(1., share_again);
          as_expected      = keeps_old || (soft->stiffness_is_known() && share_moved >= least_of_expected);
          NodalField moved = forces_at(at, displacement);
          for (unsigned int i = 0; i < x.size(); ++i)
            out_of_balance[i] += moved[i] - forces[i];
          forces = std::move(moved);
          at     = x;
          for (std::size_t k = 0; k < bodies.size(); ++k)
            up[k] += share_moved * soft->up(balance.amplitudes, loads[k].x);
        }
      d.state.force = all_forces;
      for (std::size_t k = 0; k < bodies.size(); ++k)
        d.parts.carriers()[k]->move_up(up[k]);
      for (unsigned int i = 0; i < x.size(); ++i)
        if (const int number = d.carrier_of(i); number >= 0)
          x[i][2] += up[number];
      d.mesh.distribute_hanging_nodes(x.data());
      if (d.contact)
        refresh_contact();
      return false;
    }


    void Relaxation::advance(const bool measure)
    {
      // The rigid shift r of a wheel: inverse masses M^-1 + lightness r r^T / (r^T M r). It strains no cell,
      // as K r = 0. So is a roll.
      std::vector<double> shift(bodies.size(), 0.), roll(bodies.size(), 0.), rolled(bodies.size(), 0.);
      double              of_hubs = 0., hub_loads = 0.;
      for (std::size_t k = 0; k < bodies.size(); ++k)
        {
          OfBody         &of_body   = bodies[k];
          CarriesBody    &carrier   = *d.parts.carriers()[k];
          const Resultant resultant = carrier.resultant(d.parts.sums_of_carrier(k));
          if (d.contact)
            {
              const double of_all = of_body.load + d.contact->total_impulse_on(carrier.body())[2];
              shift[k]            = of_body.lightness / of_body.mass * of_all;
              of_hubs             = std::max(of_hubs, std::abs(of_all));
            }
          const double imbalance    = resultant.force[2] + of_body.hub_load;
          const double displacement = of_body.hub_velocity + imbalance / of_body.hub_mass + shift[k];
          carrier.move_up(displacement);
          of_body.hub_velocity = keep * displacement;
          of_hubs              = std::max(of_hubs, std::abs(imbalance));
          hub_loads            = std::max(hub_loads, std::abs(of_body.hub_load));
          if (!carrier.rolls())
            continue;
          const double moment = -resultant.moment[0];
          if (d.contact)
            roll[k] = least_lightness / of_body.roll_inertia * roll_moment(k);
          of_body.hub_roll_velocity += moment / of_body.hub_roll_inertia + roll[k];
          rolled[k] = of_body.hub_roll_velocity;
          of_body.hub_roll_velocity *= keep;
          of_hubs =
            std::max(of_hubs, std::abs(moment) / std::sqrt(of_body.hub_roll_inertia / of_body.hub_mass));
        }
      std::vector<decltype(by_roll(0))> rolls;
      for (std::size_t k = 0; k < bodies.size(); ++k)
        rolls.push_back(by_roll(k));
      for (unsigned int i = 0; i < x.size(); ++i)
        {
          const int number       = d.carrier_of(i);
          Vector3   displacement = d.state.v[i] + inverse[i] * d.state.force[i] +
                                 Vector3{0., 0., number >= 0 ? shift[number] : 0., 0.};
          if (number >= 0 && roll[number] != 0.)
            displacement += roll[number] * rolls[number](i);
          x[i] += displacement;
          d.state.v[i] = keep * displacement;
        }
      for (std::size_t k = 0; k < bodies.size(); ++k)
        if (rolled[k] != 0.)
          d.parts.carriers()[k]->roll_by(rolled[k]);
      for (const auto &part : d.parts)
        part->place_nodes(d.state);
      for (std::size_t k = 0; k < bodies.size(); ++k)
        for (const auto of_node = by_roll(k); const unsigned int i : d.parts.carriers()[k]->carried())
          d.state.v[i] =
            Vector3{0., 0., bodies[k].hub_velocity, 0.} + bodies[k].hub_roll_velocity * of_node(i);
      d.mesh.distribute_hanging_nodes(x.data());
      Mesh::distribute(d.levels.hanging_at_contact, d.state.v.data()); // all that is asked for
      if (!measure)
        return;
      const double squares =
        sum_of_free([&](const std::size_t i) { return dot(d.state.force[i], d.state.force[i]); });
      const double load_squares =
        sum_of_free([&](const std::size_t i) { return dot(body_force[i], body_force[i]); });
      residual = std::max(of_hubs, std::sqrt(squares));
      load     = std::max(hub_loads, std::sqrt(load_squares));
      if (first_residual < 0.)
        first_residual = residual;
    }
  } // namespace


  unsigned int relax(MovingBodies                                    &moving,
                     const double                                     tolerance,
                     const unsigned int                               max_iterations,
                     const std::function<void(unsigned int, double)> &after_measurement)
  {
    State   &state   = moving.state;
    Contact *contact = moving.contact;
    state.set_damping_time(0.);
    // Sweeps on the way to equilibrium are no steps in time.
    const std::uint64_t unconverged_steps = contact ? contact->n_unconverged_steps : 0;
    Relaxation          relaxation(moving, tolerance);
    unsigned int        iteration = 1, last_refresh = 0, n_refreshes = 0;
    bool                soft_balance_due = false, soft_are_balanced = false; // at the last look
    for (; iteration <= max_iterations; ++iteration)
      {
        const unsigned int place   = iteration % iterations_between_looks;
        const bool         measure = iteration == 1 || place == 0;
        relaxation.find_forces();
        if (measure && iteration > 1)
          relaxation.adapt_damping();
        if (place == iterations_between_looks - 1)
          relaxation.remember_forces();
        relaxation.add_contact();
        if (relaxation.has_soft_motions() &&
            (iteration % iterations_between_balances == 1 || soft_balance_due))
          {
            soft_are_balanced = relaxation.balance_soft_motions();
            soft_balance_due  = false;
          }
        relaxation.advance(measure);
        if (!measure)
          continue;
        const double share = relaxation.share_out_of_balance();
        if (!std::isfinite(share))
          throw std::runtime_error("no equilibrium at the start: forces grow without bound after " +
                                   std::to_string(iteration) + " iterations");
        if (after_measurement)
          after_measurement(iteration, share);
        // The iteration continues if the callback has changed the contact.
        if (share <= tolerance && !(contact && contact->refresh_due()))
          {
            // Small forces on many nodes may add up.
            soft_balance_due = relaxation.has_soft_motions() && !std::exchange(soft_are_balanced, false);
            if (soft_balance_due)
              continue;
            // Balanced with the coupling of where nodes were many iterations ago? Then not yet.
            const unsigned int looks = relaxation.has_soft_motions() ? 2 : 1;
            if (!contact || iteration <= last_refresh + looks * iterations_between_looks ||
                n_refreshes == most_refreshes)
              break;
            relaxation.refresh_contact();
            last_refresh = iteration;
            ++n_refreshes;
          }
      }
    if (iteration > max_iterations)
      throw std::runtime_error(
        "no equilibrium at the start within " + std::to_string(max_iterations) +
        " iterations: raise 'Start/Largest number of iterations' or check loads and supports");
    std::fill(state.v.begin(), state.v.end(), Vector3{});
    moving.solid.update_internal_forces(state.x_damped.data(), state.v.data(), state.force.data(),
                                        state.history);
    std::fill(state.force.begin(), state.force.end(), Vector3{});
    for (const auto &part : moving.parts)
      {
        part->set_at_rest(state);
        part->balance();
      }
    if (contact)
      contact->n_unconverged_steps = unconverged_steps;
    return iteration;
  }
} // namespace tread
