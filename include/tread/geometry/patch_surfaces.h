// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_patch_surfaces_h
#define tread_geometry_patch_surfaces_h

#include <tread/geometry/wheel_on_rail.h>

#include <map>
#include <vector>

namespace tread
{
  /// Wheel and rail as heights over the plane of a patch: axes x forward, s lateral along the rail and n up
  /// into the wheel, turned by the angle of the region from y and z about x, origin at its reference point.
  ///
  /// Each height is sought in a table of the whole profile about the region, so that a search has no place to
  /// start from and cannot miss. Where a measured profile turns back over the plane, or a flange lies behind
  /// another part of the wheel, the surface that faces the other body counts. One object per thread.
  class PatchSurfaces
  {
  public:
    PatchSurfaces(const WheelOnRail         &surfaces,
                  const WheelsetPosition    &position,
                  const WheelOnRail::Region &region);

    Vector3d along() const
    {
      return {{0., cosine, sine}};
    }
    Vector3d normal() const
    {
      return {{0., -sine, cosine}};
    }
    /// Position along s, and over the plane, of a point of the track (m).
    double along(const Vector3d &p) const
    {
      return (p[1] - origin[1]) * cosine + (p[2] - origin[2]) * sine;
    }
    double above(const Vector3d &p) const
    {
      return (p[2] - origin[2]) * cosine - (p[1] - origin[1]) * sine;
    }

    struct RailPlace
    {
      double height; ///< m
      double angle;  ///< inclination in the track, rad
      bool   exists; ///< not beyond the profile, whose end has these numbers
    };
    RailPlace rail(double s) const;

    struct WheelPlace
    {
      double height;           ///< m
      double profile_s, angle; ///< in the profile (m), about the axle (rad)
      bool   exists;
    };
    WheelPlace wheel(double x, double s) const;

    /// Height of the wheel above the rail, m; where one of them ends, that of its end and the distance to it.
    double gap(double x, double s) const;

    /// Whether both bodies have a surface there.
    bool exists(const double x, const double s) const
    {
      return rail(s).exists && wheel(x, s).exists;
    }

  private:
    /// A place of the wheel's profile on the plane across the track at a place along it.
    struct OnPlane
    {
      double s, height, angle;
      double slope; ///< ds by the parameter of the profile
    };
    OnPlane on_plane(const ProfileCurve::Place &p, double x) const;

    /// Steps of a profile over the plane.
    struct Section
    {
      std::vector<double> s, height;
      bool                increases = true; ///< s does
    };
    /// The step of a section over which s lies and whose surface is the lowest, or with -1 the highest one.
    static int         step(const Section &section, double s, double sign);
    static std::size_t nearest_end(const Section &section, double s);
    const Section     &wheel_section(double x) const;

    const WheelOnRail &surfaces;
    const Vector3d     origin;
    const double       cosine, sine;
    /// Columns of the rotation of the wheelset, and its middle over the radius of the wheel.
    Vector3d turn_x, turn_y, turn_z, middle;

    double                              first_wheel_s, wheel_step, rail_step; ///< m
    std::vector<ProfileCurve::Place>    wheel_places;
    Section                             rail_section;
    mutable std::map<double, Section>   sections; ///< of the wheel, by x
    mutable std::map<double, RailPlace> known_rail;
  };
} // namespace tread

#endif
