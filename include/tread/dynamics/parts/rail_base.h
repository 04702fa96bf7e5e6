// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_parts_rail_base_h
#define tread_dynamics_parts_rail_base_h

#include <tread/dynamics/part.h>
#include <tread/track/rail_base.h>

#include <functional>
#include <vector>

namespace tread
{
  struct SumsOfRailBase
  {
    Vector3 force;     ///< N
    double  moment;    ///< N m: @see RailBase::Load
    double  unused[3]; ///< which a vector's alignment would leave undefined
  };

  /// The nodes of a rail's bottom on a base that moves.
  class RailOnBase : public PartWithSums<SumsOfRailBase>
  {
  public:
    /// @param body whose support nodes it carries. Collective.
    RailOnBase(const PartOf &part_of, RailBase &base, const unsigned int body);

    std::vector<unsigned int> carried_nodes() const override
    {
      return nodes;
    }
    void add_forces(NodalField &) override
    {
      base.find_forces();
    }
    void     place_nodes(State &state) const override;
    OwnRates own_rates(const NodeLevels &) const override
    {
      return {base.stiffness_over_mass(), base.damping_over_mass()};
    }
    double kinetic_energy(const double time_step) const override
    {
      return base.kinetic_energy(time_step);
    }
    double spring_energy() const override
    {
      return base.spring_energy();
    }
    double dissipated() const override
    {
      return base.dissipated();
    }
    double external_work() const override
    {
      return base.external_work();
    }
    double gross_work() const override
    {
      return base.gross_work();
    }
    /// With one load.
    std::vector<double> follow(State                                   &state,
                               const std::vector<MovingLoad>           &loads,
                               const std::function<void(NodalField &)> &constrain) override;
    void                serialize(Archive &archive) override
    {
      base.serialize(archive);
    }

  protected:
    SumsOfRailBase sums_of_rank(const State &state) const override;
    void           advance_with(Step &step, const SumsOfRailBase &sums) override
    {
      base.advance({sums.force, sums.moment}, step.state.time_step);
    }

  private:
    /// Velocity of a point of the rail that moves with the base, m/s; of another motion its displacement.
    Vector3 at(const unsigned int node, const RailBase::Motion &motion) const
    {
      const dealii::Point<3> &p = of.mesh.nodes[node];
      return motion.shift + motion.slope * Vector3{bottom - p[2], 0., p[0] - middle, 0.};
    }

    const PartOf              of;
    RailBase                 &base;
    const unsigned int        body;
    std::vector<unsigned int> nodes;
    double                    middle = 0., bottom = 0.; ///< x and least z of the base, m
  };
} // namespace tread

#endif
