// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_parts_rail_base_h
#define tread_dynamics_parts_rail_base_h

#include <tread/dynamics/part.h>
#include <tread/track/rail_base.h>

#include <vector>

namespace tread
{
  struct SumsOfRailBase
  {
    Vector3 force; ///< N
  };

  /// The nodes of a rail's bottom on a base that moves.
  class RailOnBase : public PartWithSums<SumsOfRailBase>
  {
  public:
    /// @param body whose support nodes it carries
    RailOnBase(const PartOf &part_of, RailBase &base, const unsigned int body);

    std::vector<unsigned int> carried_nodes() const override
    {
      return nodes;
    }
    void   place_nodes(State &state) const override;
    double kinetic_energy(const double) const override
    {
      return base.kinetic_energy();
    }
    double external_work() const override
    {
      return base.external_work();
    }
    double gross_work() const override
    {
      return base.gross_work();
    }
    void serialize(Archive &archive) override
    {
      base.serialize(archive);
    }

  protected:
    SumsOfRailBase sums_of_rank(const State &state) const override;
    void           advance_with(Step &step, const SumsOfRailBase &sums) override
    {
      base.advance(sums.force, step.state.time_step);
    }

  private:
    const PartOf              of;
    RailBase                 &base;
    std::vector<unsigned int> nodes;
  };
} // namespace tread

#endif
