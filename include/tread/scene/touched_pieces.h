// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_touched_pieces_h
#define tread_scene_touched_pieces_h

#include <tread/analysis/wheelset_contact.h>

#include <string>
#include <vector>

namespace tread
{
  class Scene;

  /// A piece of a rail of slices on which the wheel rolls on its way, such as the nose of a crossing, and
  /// where it does by half-space theory. Track axes, x of the scene, m.
  struct TouchedPiece
  {
    struct Touch
    {
      double     axle; ///< x of the axle
      WheelPatch patch;

      double x() const
      {
        return axle + patch.region.reference[0];
      }
    };

    std::string        body;    ///< its name in the slices; empty: none
    std::vector<Touch> touches; ///< while the axle moves forward
    double             apart;   ///< places at which contact is solved

    /// The straight line nearest to the touches, once they are all there: y() follows it.
    void fit_line();
    /// At x, on that line. @pre fit_line()
    double y(double x) const
    {
      return line.y + line.slope * (x - line.x);
    }
    /// Mean inclination of the rail (rad).
    double inclination() const;
    /// The furthest that patches reach to both sides.
    double y_low() const;
    double y_high() const;

    struct Line
    {
      double x = 0., y = 0., slope = 0.;
    } line;
  };

  /// What a wheel touches on its way over a rail of slices.
  struct WayOverSlices
  {
    std::vector<TouchedPiece> pieces; ///< in the order of y
    /// Places of the axle at which contact is solved, x of the scene, with the height of the wheelset there
    /// (m) and its second derivative by x (1/m).
    std::vector<double> axles, height, bend;

    /// First and second derivative of the height by x, of the spline through the places.
    double slope(double axle) const;
    double curvature(double axle) const;
  };

  /// Contact is solved at 5 to 61 places, a millimetre apart where that is as many. @throws InputError where
  /// the wheel meets no rail
  WayOverSlices way_over_slices(const Scene &scene, const WheelOnRail &surfaces);
} // namespace tread

#endif
