// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_parts_wheel_h
#define tread_dynamics_parts_wheel_h

#include <tread/dynamics/carries_body.h>
#include <tread/dynamics/part.h>
#include <tread/track/wheel_hub.h>

#include <vector>

namespace tread
{
  struct SumsOfWheel
  {
    Vector3 force, moment;  ///< on the hub, N, N m
    Vector3 arms, products; ///< @see LoadsOnBody
    Vector3 on_wheels[2];   ///< moments on both wheels of a flexible axle about their middles, N m
  };

  /// A body whose support nodes are attached to a rigid hub. The centrifugal force of the density added by
  /// scaling, which does not exist in reality, is compensated on this body.
  class WheelOnHub : public PartWithSums<SumsOfWheel>, public CarriesBody
  {
  public:
    /// Takes the share of the cells out of the hub's mass and inertia. Collective.
    /// @param nominal_angular_velocity at which centrifugal force acts until start() takes that of the hub
    WheelOnHub(const PartOf      &part_of,
               WheelHub          &hub,
               const unsigned int body,
               const double       nominal_angular_velocity);

    std::vector<unsigned int> carried_nodes() const override
    {
      return nodes;
    }
    void   place_nodes(State &state) const override;
    double kinetic_energy(const double time_step) const override
    {
      return hub.kinetic_energy(0.5 * time_step);
    }
    double external_work() const override
    {
      return hub.external_work();
    }
    double gross_work() const override
    {
      return hub.gross_work();
    }
    /// A whole wheel.
    std::vector<SoftBody> soft_bodies(const State &state) const override;
    void                  balance() override
    {
      hub.balance_suspension();
    }
    void start() override
    {
      nominal_angular_velocity = hub.motion.angular_velocity;
    }
    void serialize(Archive &archive) override
    {
      hub.serialize(archive);
      archive.same(nominal_angular_velocity);
    }

    unsigned int body() const override
    {
      return body_number;
    }
    const std::vector<unsigned int> &carried() const override
    {
      return nodes;
    }
    RigidMotion motion() const override;
    Vector3     turned(const Vector3 &arm) const override
    {
      return hub.position_of(arm) - hub.middle();
    }
    void take(const LoadsOnBody &loads_of_step) override
    {
      loads = loads_of_step;
    }
    void       set_velocities(State &state, const std::function<double(unsigned int)> &back) const override;
    Resultant  resultant(const double *sums) const override;
    MovingLoad load() const override
    {
      return {hub.motion.x, hub.motion.velocity_x, hub.static_force()};
    }
    double angular_velocity() const override
    {
      return nominal_angular_velocity;
    }
    void move_up(const double way) override
    {
      hub.motion.z += way;
    }
    void rise(const double velocity) override
    {
      hub.motion.velocity_z += velocity;
    }
    bool rolls() const override
    {
      return hub.rolls();
    }
    void roll_by(const double angle) override
    {
      hub.roll_by(angle);
    }

  protected:
    SumsOfWheel sums_of_rank(const State &state) const override;
    void        advance_with(Step &step, const SumsOfWheel &sums) override;

  private:
    double compensation() const
    {
      return (1. - 1. / of.parameters.density_scale) * nominal_angular_velocity * nominal_angular_velocity;
    }

    const PartOf              of;
    WheelHub                 &hub;
    const unsigned int        body_number;
    double                    nominal_angular_velocity; ///< rad/s
    std::vector<unsigned int> nodes;                    ///< that the hub carries
    std::vector<Vector3>      reference;                ///< of these nodes, relative to the axle
    LoadsOnBody               loads;                    ///< of the present step
  };
} // namespace tread

#endif
