// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_parts_added_mass_h
#define tread_dynamics_parts_added_mass_h

#include <tread/dynamics/carries_body.h>
#include <tread/dynamics/part.h>

#include <vector>

namespace tread
{
  struct SumsOfAddedMass
  {
    Vector3 arms, products; ///< @see LoadsOnBody
  };

  /// The mass that the fastest cells of a body on a carrier were given to slow them down
  /// (SolidParameters::highest_frequency) turns with the body: its centrifugal force, which does not exist in
  /// reality, is held by a force that has a potential. Its cells are the fastest ones, so that its nodes move
  /// in every step. To be added behind the carrier.
  class AddedMassOnWheel : public PartWithSums<SumsOfAddedMass>
  {
  public:
    AddedMassOnWheel(const PartOf &part_of, const CarriesBody &carrier);

    void   add_loads(Step &step) override;
    double potential(const double time_step) const override;
    void   start() override
    {
      omega = carrier.angular_velocity();
    }
    void serialize(Archive &archive) override
    {
      archive.same(omega);
    }

  protected:
    SumsOfAddedMass sums_of_rank(const State &) const override
    {
      return sums;
    }
    void advance_with(Step &step, const SumsOfAddedMass &of_all_ranks) override;

  private:
    struct Node
    {
      unsigned int number;
      double       mass; ///< kg
    };

    const PartOf       of;
    const CarriesBody &carrier;
    std::vector<Node>  nodes;
    double             omega = 0.; ///< rad/s
    RigidMotion        before;     ///< the step that is being made
    SumsOfAddedMass    sums{};     ///< of this rank in this step
  };
} // namespace tread

#endif
