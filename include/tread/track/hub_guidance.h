// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_hub_guidance_h
#define tread_track_hub_guidance_h

#include <tread/base/archive.h>
#include <tread/track/hub_motion.h>

#include <functional>
#include <optional>

namespace tread
{
  /// How a wheelset comes to move across its track and to yaw.
  enum class Guidance
  {
    rigid,  ///< it does not
    file,   ///< its motion is given over time
    springs ///< it is free on springs and dampers
  };

  /// Where a wheelset stands across its track: a roll about x, then a yaw about the rolled vertical axis,
  /// with the signs of WheelsetPosition. SI units.
  struct Across
  {
    double                y   = 0.; ///< from the start
    double                yaw = 0., roll = 0.;
    std::optional<double> angular_velocity{}; ///< about the axle; none: the drive's
  };

  /// Springs and dampers between a wheelset and a frame that runs along with it. SI units.
  struct GuidanceSprings
  {
    double stiffness = 0., damping = 0.;         ///< lateral, from the start: N/m, N s/m
    double yaw_stiffness = 0., yaw_damping = 0.; ///< N m, N m s
    /// Constant part; none: what holds the wheelset in its place at the start (N, N m).
    std::optional<double> force{}, moment{};
  };

  /// What leads a hub across the track.
  class HubGuidance
  {
  public:
    /// Let it be rigid.
    void hold()
    {
      kind = Guidance::rigid;
    }
    bool is_rigid() const
    {
      return kind == Guidance::rigid;
    }
    /// Move across the track as given from now on. @param across at a time from now, s
    void follow(const std::function<Across(const double time)> &across);
    /// Move across the track on springs from now on. @param yaw at present, rad
    void release(const GuidanceSprings &on, const double yaw);

    /// Velocities of the motion that is followed, as differences over a step. @param rolls whether the roll
    /// follows from the forces
    void begin(HubMotion &motion, const double time_step, const bool rolls) const;

    /// A hub without its guidance: what acts on it, and what of it moves.
    struct FreeHub
    {
      double lateral;           ///< N
      double yaw_moment;        ///< N m
      double roll_moment;       ///< about x, N m
      double mass, yaw_inertia; ///< kg, kg m^2
      bool   rolls;             ///< whether the roll follows from the forces
    };
    /// Change the motion across the track, and angular_velocity where it is prescribed. @param before the
    /// motion before the step @returns work, J
    double advance(HubMotion &motion, const HubMotion &before, const FreeHub &hub, const double time_step);

    /// Mean lateral force in the last step, on the hub, N.
    double lateral_force() const
    {
      return lateral;
    }

    void serialize(Archive &archive);

  private:
    Guidance                      kind = Guidance::rigid;
    double                        time = 0., lateral = 0.; ///< s since guidance began; N
    std::function<Across(double)> across;
    GuidanceSprings               springs;
    double                        released_yaw = 0.;
  };
} // namespace tread

#endif
