// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_profile_curve_h
#define tread_geometry_profile_curve_h

#include <tread/geometry/measured_line.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace tread
{
  class RailProfile;

  /// The running surface of a wheel with its flange, or of a rail with its flanks, as a plane curve y(s),
  /// z(s) through points: two cubic splines over the length of the chords, natural at the ends. y is lateral
  /// with the flange, or the gauge face, at y < 0, z points up; from the end at low y to that at high y.
  /// Lengths in m.
  class ProfileCurve
  {
  public:
    /// Place and derivatives by the parameter s at one s.
    struct Place
    {
      double y, z, dy, dz;
    };

    /// @param points in their order along the curve; points that coincide with the one before are left out.
    /// @throws std::runtime_error where less than four remain.
    explicit ProfileCurve(const std::vector<dealii::Point<2>> &points);

    double length() const; ///< the largest s (m)
    Place  at(double s) const;
    /// Radius of curvature at s, positive where the curve bends towards -z as a rail's crown does (m).
    double radius(double s) const;

    /// Knots of the splines (m): no piece has a kink or a turn that these do not show.
    const std::vector<double> &knots() const;
    /// y, z there.
    const std::vector<dealii::Point<2>> &points_at_knots() const
    {
      return points;
    }

    /// The curve turned about the origin from y to z by `angle` (rad), then moved.
    ProfileCurve turned(double angle) const;
    ProfileCurve moved(double along_y, double along_z) const;

  private:
    std::vector<double>           s;      ///< knots
    std::vector<dealii::Point<2>> points; ///< y, z there
    std::vector<dealii::Point<2>> bend;   ///< second derivatives there
  };

  /// The part of a curve in which y increases, seen from above: height z and parameter s at y.
  class CurveFromAbove
  {
  public:
    /// The longest stretch about the highest point within 25 mm of y_middle in which y increases.
    explicit CurveFromAbove(const ProfileCurve &curve, double y_middle = 0.);

    double begin() const; ///< y of the first end (m)
    double end() const;   ///< y of the last end (m)
    /// s at y, begin() <= y <= end().
    double              parameter(double y) const;
    double              height(double y) const;
    double              slope(double y) const; ///< dz/dy
    const ProfileCurve &curve() const;

    /// Height of the chord between steps of the curve next to y, and by how much the curve may lie beside it
    /// (m): quick, and exact enough to tell where it is not worth to ask for height().
    struct RoughHeight
    {
      double z, error;
    };
    RoughHeight rough_height(double y) const;

  private:
    /// The step, of those in which Newton's method starts, next to y.
    std::size_t step(double y) const;

    ProfileCurve        line;
    std::vector<double> s, y, z;   ///< ends of the steps
    std::vector<double> deviation; ///< of the curve from the chord of each step (m)
  };

  /// A wheel's profile with its flange; z = 0 on the running circle y = 0.
  /// @param tread "cylinder" (from -70 to 60 mm, no flange), "cone 1:40", "cone 1:20" (with the flange of
  /// S1002, joined by the arc R13 of its throat), "S1002" (EN 13715), or a file. @throws std::runtime_error,
  /// one line.
  ProfileCurve wheel_curve(const std::string &tread, const ProfilePlacement &placement = {});

  /// The head of a rail from flank to flank, upright: the rail top's middle at the origin.
  ProfileCurve rail_curve(const RailProfile &profile);

  /// A measured head as in the file, its highest point within 20 mm of y = 0 at z = 0. @throws
  /// std::runtime_error, one line.
  ProfileCurve measured_rail_curve(const std::string &file, const ProfilePlacement &placement = {});
} // namespace tread

#endif
