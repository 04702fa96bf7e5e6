// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_wheel_on_rail_h
#define tread_geometry_wheel_on_rail_h

#include <tread/geometry/profile_curve.h>
#include <tread/geometry/surface.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace tread
{
  using Vector3d = std::array<double, 3>; ///< x, y, z

  /// Where a wheelset stands in its track, seen from one of its wheels. Track axes of that wheel: x forward,
  /// y from the middle of the track towards the wheel's own side, z up from the plane on the rail tops. A
  /// wheel of the other side has the mirrored axes, so that its position is that of the own wheel with the
  /// signs of shift, yaw and roll changed.
  struct WheelsetPosition
  {
    double shift = 0.; ///< y of the wheelset's middle (m)
    double yaw =
      0.; ///< positive: the leading side turns to the own side, so that the own wheel falls back (rad)
    double roll   = 0.; ///< positive: the own side goes down (rad)
    double height = 0.; ///< of the wheelset's middle over the wheel's radius (m)
    double along  = 0.; ///< of the wheelset's middle on a rail that changes along the way (m)
    double pitch  = 0.; ///< of a wheel that is not round: turned about the axle, negative forward (rad)

    WheelsetPosition mirrored() const
    {
      return {0. - shift, 0. - yaw, 0. - roll, height, along, pitch};
    }
  };

  /// What places wheels on their axle and rails in their track (m).
  struct TrackGauge
  {
    double gauge           = 1.435;  ///< between the gauge faces
    double measuring_depth = 14e-3;  ///< of the gauge below the rail tops
    double back_distance   = 1.36;   ///< between the backs of the wheels' flanges
    double back_position   = -70e-3; ///< of the flange's back in the wheel's profile
                                     /// Of the wheel's profile on the axle, from the middle, m.
    double wheel_origin() const
    {
      return 0.5 * back_distance - back_position;
    }
  };

  class OverlapSearch;

  /// One wheel of a wheelset over its rail: both rigid.
  ///
  /// The position is a roll about x, then a yaw about the rolled vertical axis, then a pitch about the axle,
  /// which changes nothing of a round wheel. x counts from the middle of the wheelset.
  class WheelOnRail
  {
  public:
    /// @param wheel profile; @param rail head in its inclination; both as in profile_curve.h. @param radius
    /// of the wheel where z = 0 in its profile (m).
    /// @throws std::runtime_error, one line, for a rail without a gauge face.
    WheelOnRail(const ProfileCurve &wheel, const ProfileCurve &rail, double radius, const TrackGauge &gauge);

    /// Where y = 0 and z = 0 of a rail's surface lie in the track (m).
    struct RailOrigin
    {
      double y, z;
    };
    /// Surfaces that may change along the way.
    /// @param origin none: the rail is placed by its gauge face, which a rail of one profile has
    /// @throws as above
    WheelOnRail(const WheelSurface              &wheel,
                std::shared_ptr<const Surface>   rail,
                double                           radius,
                const TrackGauge                &gauge,
                const std::optional<RailOrigin> &origin = {});

    double                radius() const;
    const CurveFromAbove &rail() const;  ///< in track axes. @pre it is the same at every x
    const ProfileCurve   &wheel() const; ///< in its own axes, where it is round
    /// The sections of the rail in track axes at a place along the rail (m).
    std::shared_ptr<const std::vector<ProfileCurve>> rail_sections(double along) const;
    const Surface                                   &rail_surface() const
    {
      return *rail_of;
    }
    const WheelSurface &wheel_surface() const
    {
      return wheel_of;
    }
    /// Whether only places of the outline can touch.
    bool is_constant() const
    {
      return rail_of->is_constant() && wheel_of.is_constant();
    }
    double rail_origin_y() const; ///< where y = 0 of the rail's curve lies in the track (m)
    double rail_origin_z() const;
    double wheel_origin_y() const; ///< of the wheel's profile on the axle, from the middle (m)
    /// Whether a place of the wheel's profile, by its parameter, lies on the flange between its steepest part
    /// and its tip, where a wheel stands only while it climbs out of the track.
    bool is_beyond_flank(const double s) const
    {
      return s < flank_end;
    }

    /// Unit vector along the axle, to the own side; a wheel that rolls forward turns about it positively.
    static Vector3d axle(const WheelsetPosition &position);
    static Vector3d middle(const WheelsetPosition &position, double radius);

    /// The wheel's surface at the profile's parameter s and the angle about the axle, 0 at the bottom and
    /// positive forwards, with the derivatives by both (m).
    struct SurfacePoint
    {
      Vector3d place, by_s, by_angle;
    };
    SurfacePoint surface(const WheelsetPosition &position, double s, double angle) const;
    /// Any point of the wheel, from y and z in its profile's axes and the angle.
    Vector3d place(const WheelsetPosition &position, double y, double z, double angle) const;

    /// Point of the wheel's outline seen along x: the surface stands upright on the planes through x there.
    /// Only such points can touch a rail that is the same at every x.
    struct OutlinePoint
    {
      double   s, angle;
      Vector3d place;
    };
    /// None where the surface is so steep that the yaw hides all of the circle.
    std::optional<OutlinePoint> outline(const WheelsetPosition &position, double s) const;

    /// How far the wheel stands above the rail where it is nearest.
    struct Nearest
    {
      double       gap; ///< along z, negative: overlap (m)
      OutlinePoint point;
      double       inclination = 0.; ///< of the rail there (rad)
    };
    /// @throws std::runtime_error where the wheel meets no rail.
    Nearest nearest(const WheelsetPosition &position) const;

    /// A region in which the surfaces overlap, alone or next to others not further away than the distance
    /// given.
    struct Region
    {
      double s_begin = 0., s_end = 0.; ///< on the wheel's profile (m)
      /// The reference point, on the rail: centre of the square of the overlap's depth over the area.
      Vector3d     reference{};
      double       angle   = 0.; ///< of the rail there, mean with the same weight: dz/dy = tan(angle) (rad)
      double       overlap = 0.; ///< largest, along the normal (m)
      unsigned int parts   = 0;  ///< overlaps taken together
      /// Where it lies in the plane at that angle, from the reference point; of an outline it is not known
      /// (m).
      struct Box
      {
        double x_low = 0., x_high = 0., s_low = 0., s_high = 0.;
      };
      std::optional<Box> box{};
    };
    /// @param separation along the surface, m
    std::vector<Region> overlaps(const WheelsetPosition &position, double separation) const;

  private:
    /// The vertical gap at s; a large number where there is no rail below.
    double gap(const WheelsetPosition &position, double s, OutlinePoint &point) const;
    /// The samples at which the gap may be smallest.
    std::vector<std::size_t> near_samples(const WheelsetPosition &position) const;

    /// The search at a position, kept for its other heights.
    std::shared_ptr<OverlapSearch> search_at(const WheelsetPosition &position) const;

    WheelSurface                                     wheel_of;
    std::shared_ptr<const Surface>                   rail_of;
    ProfileCurve                                     wheel_profile;
    std::optional<CurveFromAbove>                    rail_profile; ///< of one that does not change
    std::shared_ptr<const std::vector<ProfileCurve>> rail_section; ///< the same
    double                                           nominal_radius, wheel_y, rail_y, rail_z;
    double flank_end; ///< s where the steepest part ends towards the tip; 0: no flange
    mutable std::shared_ptr<OverlapSearch> last_search; ///< shared by copies
    /// Places of the profile at which the wheel is looked at.
    std::vector<double>              samples; ///< s
    std::vector<ProfileCurve::Place> places;
  };
} // namespace tread

#endif
