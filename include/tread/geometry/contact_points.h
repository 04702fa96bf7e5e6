// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_contact_points_h
#define tread_geometry_contact_points_h

#include <tread/geometry/wheel_on_rail.h>

#include <map>
#include <vector>

namespace tread
{
  /// Where a rigid wheel touches its rail, in the axes of its own side (m).
  struct TouchingWheel
  {
    double x, y;            ///< in the track
    double wheel_y;         ///< in the wheel's profile
    double angle;           ///< of the rail, rad
    double rolling_radius;  ///< distance from the axle
    bool   is_beyond_flank; ///< WheelOnRail::is_beyond_flank()
  };

  /// Both wheels of a wheelset on their rails: the roll and the height at which both touch.
  struct TouchingWheelset
  {
    WheelsetPosition position;
    TouchingWheel    own, other;
    double           radius_difference() const
    {
      return own.rolling_radius - other.rolling_radius;
    }
  };

  /// @param position of which the roll and the height are found. @throws std::runtime_error, one line, where
  /// a wheel meets no rail, or meets it with the edge of its profile only.
  TouchingWheelset touching_wheelset(const WheelOnRail &surfaces, WheelsetPosition position);

  /// Radius differences of a rigid wheelset over its lateral shift, to both sides. Shifts are as near to each
  /// other as straight lines between them need, and a jump of the contact from one place to another is found
  /// to a thousandth of a millimetre.
  class RadiusDifferences
  {
  public:
    /// @param position whose yaw counts; @param largest shift to both sides, m
    RadiusDifferences(const WheelOnRail &surfaces, const WheelsetPosition &position, double largest);

    /// equivalent_conicity() at an amplitude (m); NaN where a wheel meets no rail on the way.
    double conicity(double amplitude) const;

  private:
    /// @param from a shift that is known, from whose roll the search begins, as there may be several
    void add(const WheelOnRail &surfaces, WheelsetPosition position, double shift, double from);
    /// Add what is missing between two shifts whose values are known, from the inner one outwards.
    void refine(const WheelOnRail &surfaces, const WheelsetPosition &position, double inner, double outer);

    struct Touching
    {
      double difference, roll; ///< NaN and that of the search where a wheel meets no rail (m, rad)
    };
    std::map<double, Touching> touching; ///< by the shift (m)
    double                     reach;    ///< least shift to either side at which a wheel meets no rail (m)
  };

  /// The inclination of the cone that has, under a lateral motion of the amplitude, the same rolling radius
  /// difference in the mean: integral of dr(a sin t) sin t over a turn, over 2 pi a (harmonic linearisation).
  /// @param shifts ascending (m); @param differences own less other (m); @param amplitude a (m), within the
  /// shifts at both sides
  double equivalent_conicity(const std::vector<double> &shifts,
                             const std::vector<double> &differences,
                             double                     amplitude);
} // namespace tread

#endif
