// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_patch_surfaces_h
#define tread_geometry_patch_surfaces_h

#include <tread/geometry/wheel_on_rail.h>

#include <map>
#include <memory>
#include <utility>
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
      double height;    ///< m
      double angle;     ///< inclination in the track, rad
      double parameter; ///< of the section, m
      bool   exists;    ///< not beyond the profile, whose end has these numbers
    };
    /// x from the reference point.
    RailPlace rail(double x, double s) const;
    /// Of the rail's section at the reference point, positive where it bends down to both sides (m).
    double rail_radius() const;

    struct WheelPlace
    {
      double height;           ///< m
      double profile_s, angle; ///< in the profile (m), about the axle (rad)
      bool   exists;
    };
    WheelPlace wheel(double x, double s) const;

    /// Height of the wheel above the rail, m; where one of them ends, that of its end and the distance to it.
    double gap(double x, double s) const;

    bool is_constant() const
    {
      return surfaces.is_constant();
    }
    /// Whether the rail is not known at any s there.
    bool is_beyond_end(const double x) const
    {
      return !surfaces.rail_surface().extent().includes(along_rail + x);
    }

    /// Whether both bodies have a surface there.
    bool exists(const double x, const double s) const
    {
      return rail(x, s).exists && wheel(x, s).exists;
    }

    /// Steps of a profile over the plane.
    struct Section
    {
      std::vector<double> s, height;
      bool                increases = true; ///< s does
    };
    const Section &wheel_section(double x) const;
    /// Of the pieces of the rail.
    const std::vector<Section> &rail_sections(double x) const;
    /// The parameter of the wheel's profile at a step of its section (m).
    double parameter(const std::size_t step) const
    {
      return first_wheel_s + step * wheel_step;
    }

  private:
    /// A place of the wheel's profile on the plane across the track at a place along it.
    struct OnPlane
    {
      double s, height, angle;
      double slope; ///< ds by the parameter of the profile
    };
    OnPlane on_plane(const ProfileCurve::Place &p, double x) const;

    /// The rail across the plane at x.
    struct RailAt
    {
      std::shared_ptr<const std::vector<ProfileCurve>> curves;
      std::vector<Section>                             sections;
      std::vector<double>                              steps; ///< m
    };
    const RailAt &rail_at(double x) const;
    /// The piece of the rail, its parameter there, and whether it lies over s.
    struct OnRail
    {
      const ProfileCurve *curve;
      double              parameter;
      bool                exists;
    };
    OnRail on_rail(double x, double s) const;

    /// The step of a section over which s lies and whose surface is the lowest, or with -1 the highest one.
    static int         step(const Section &section, double s, double sign);
    static std::size_t nearest_end(const Section &section, double s);

    const WheelOnRail &surfaces;
    const Vector3d     origin;
    const double       cosine, sine;
    /// Columns of the rotation of the wheelset, and its middle over the radius of the wheel.
    Vector3d turn_x, turn_y, turn_z, middle;

    double                            along_rail; ///< of the reference point, m
    double                            pitch;
    double                            first_wheel_s, wheel_step; ///< m
    std::vector<ProfileCurve::Place>  wheel_places;
    mutable std::map<double, RailAt>  rails;    ///< by x, one of a rail that does not change
    mutable std::map<double, Section> sections; ///< of the wheel, by x
    mutable std::map<std::pair<double, double>, RailPlace> known_rail; ///< by x and s
  };
} // namespace tread

#endif
