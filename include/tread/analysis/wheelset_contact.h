// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_wheelset_contact_h
#define tread_analysis_wheelset_contact_h

#include <tread/analysis/contact_patch.h>
#include <tread/geometry/wheel_on_rail.h>
#include <tread/reference/planar_contact.h>

#include <functional>
#include <string>
#include <vector>

namespace tread
{
  /// How a wheelset turns, and moves across its track: it rises with it as a patch needs. In the axes of its
  /// position, SI units.
  struct WheelsetRates
  {
    double angular_velocity = 0.; ///< about the axle, positive forward, counted from free rolling
    double across_speed     = 0.; ///< to the own side
    double yaw_rate = 0., roll_rate = 0.;

    /// What a wheel on a flexible axle does against the line through the middles of both: it turns about it,
    /// and tilts about the axes at right angles to it, x in the plane of the rail tops and z.
    struct AgainstLine
    {
      double spin = 0., tilt_x = 0., tilt_z = 0., tilt_rate_x = 0., tilt_rate_z = 0.;

      AgainstLine mirrored() const
      {
        return {spin, 0. - tilt_x, 0. - tilt_z, 0. - tilt_rate_x, 0. - tilt_rate_z};
      }
    };
    AgainstLine own{}, other{};

    /// The same in the axes of the other wheel's side.
    WheelsetRates mirrored() const
    {
      return {angular_velocity, 0. - across_speed, 0. - yaw_rate,
              0. - roll_rate,   other.mirrored(),  own.mirrored()};
    }
  };

  /// Steady rolling of one wheel of a wheelset in any position over its rail, in half-space theory. SI units.
  struct WheelRolling : reference::Friction, WheelsetRates
  {
    /// Where it changes along the rail: friction at x from the middle of the wheelset (m), instead of the one
    /// above.
    std::function<reference::Friction(double x)> friction_along;

    /// Where it changes across the rail: a factor on it by y in the rail's profile (m) and the inclination of
    /// its surface in the track, dz/dy = tan(inclination) (rad).
    std::function<double(double y, double inclination)> factor_across;

    reference::Elastic wheel, rail;
    double             speed         = 1.; ///< of the wheelset along the track, m/s
    double             lateral_speed = 0.; ///< of the wheelset over the track, to the own side, m/s

    /// Overlaps nearer to each other than this along the surface are solved in one plane, m.
    double separation = 0.;
    /// Edges of the elements along and across, m; 0: a share of the patch.
    double element_x = 0., element_y = 0.;
    /// Of the slip in the element size (reference::PlanarCase::order).
    unsigned int order = 2;
    /// Whether the rigid slip follows the wheel's surface over the patch, which is no cone in general,
    /// instead of being linear from the reference point on.
    bool slip_follows_surface = true;

    /// The same of the other wheel, in the axes of its own side.
    WheelRolling mirrored() const;
  };

  /// Contact of one region in its own plane: axes x forward, s lateral along the rail and n up into the
  /// wheel, turned by `angle` from y and z about x, origin at the reference point. Forces act on the wheel.
  struct WheelPatch
  {
    WheelOnRail::Region region;
    /// Of the other wheel of the wheelset: its own axes are the mirrored ones, so that s points to the other
    /// side, but its reference point is given in the track axes of the own wheel. @see of_other_wheel()
    bool   is_of_other_wheel = false;
    double wheel_s = 0., wheel_angle = 0.;       ///< where the wheel's profile (m) and its turn (rad) meet it
    double rolling_radius = 0.;                  ///< of the undeformed wheel at the reference point (m)
    double rolling_speed  = 0.;                  ///< V, mean of both surfaces' speeds through the patch (m/s)
    double creepage = 0., lateral_creepage = 0.; ///< slip of the rigid wheel over the rail there over V [-]
    double spin = 0.;                            ///< its angular velocity about n over V (rad/m)
    double rise =
      0.; ///< vertical speed at which it keeps touching here while the wheelset moves across (m/s)

    reference::PlanarResult solution;

    double      wheel_radius = 0., rail_radius = 0.; ///< of the profiles at the reference point (m)
    std::string body;                                ///< of the rail on which it lies, where it has several
    double      turn = 0.; ///< of the rail's normal from one edge of the patch to the other (rad)
    /// How far both surfaces give way here under the pressure of the other patches, each a point force on
    /// half-spaces that is felt along their distance (m). The solution leaves it out.
    double sink_by_others = 0.;

    double angle() const
    {
      return region.angle;
    }
    /// Unit vectors of the contact axes in the track.
    Vector3d along() const;
    Vector3d normal() const;
    /// Force on the wheel in track axes (N).
    Vector3d force() const;
  };

  /// The elements in contact, in contact axes.
  std::vector<PatchNode> elements_in_contact(const WheelPatch &patch);

  struct WheelContact
  {
    WheelsetPosition        position; ///< with the height found
    std::vector<WheelPatch> patches;
    Vector3d                force{};   ///< on the wheel, track axes (N)
    unsigned int            turns = 0; ///< solutions at different heights
  };

  /// What was found in the axes of the other wheel's side, in the track axes of the own wheel; the patches
  /// keep their own axes.
  WheelContact of_other_wheel(const WheelContact &mirrored);

  /// The normal of the rail must not turn by more over a patch that is solved in one plane: beyond it
  /// pressures of both ends differ in direction by so much that the resultant is 0.5 % too large.
  constexpr double largest_turn_of_a_plane = 0.2; // rad

  /// Patches deform each other by as much of their undeformed overlap at most; the force of a patch changes
  /// by half as much again.
  constexpr double largest_sink_by_others = 0.1;

  /// Contact with the wheelset at the height of the position. No patches if nothing overlaps.
  WheelContact contact_at_height(const WheelOnRail      &surfaces,
                                 const WheelRolling     &rolling,
                                 const WheelsetPosition &position);

  /// Refuses a wheel whose other wheel, on the same axle at the given roll, stands deep in its rail. What a
  /// roll that is a few milliradians off lets it sink in is no error: only this wheel's rail carries.
  /// @throws std::runtime_error, one line
  void require_other_wheel_clear(const WheelOnRail &surfaces, const WheelsetPosition &position);

  /// A line for each patch on the flange beyond its steepest part: the wheel has climbed the rail.
  std::vector<std::string> climbing_patches(const WheelOnRail             &surfaces,
                                            const std::vector<WheelPatch> &patches);

  /// Contact under a vertical load (N), friction forces included: the height is found.
  /// @throws std::runtime_error, one line, where the surfaces do not meet or no height carries the load.
  WheelContact contact_under_load(const WheelOnRail  &surfaces,
                                  const WheelRolling &rolling,
                                  WheelsetPosition    position,
                                  double              load);

  /// Both wheels of a wheelset, each in the axes of its own side.
  struct BothWheels
  {
    WheelContact own, other;
  };

  /// Contact of both wheels on a rigid axle under a vertical load (N) in its middle: height and roll are
  /// found, with which the forces of both carry the load and have no moment about x. Each wheel's position
  /// is that of the wheelset, seen from its side.
  /// @throws std::runtime_error as contact_under_load(), or where no roll balances them
  BothWheels contact_of_both_wheels(const WheelOnRail  &surfaces,
                                    const WheelRolling &rolling,
                                    WheelsetPosition    position,
                                    double              load);
} // namespace tread

#endif
