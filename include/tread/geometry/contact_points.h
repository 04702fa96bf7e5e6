// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_contact_points_h
#define tread_geometry_contact_points_h

#include <tread/geometry/wheel_on_rail.h>

#include <map>
#include <utility>
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

  /// Wheel and rail of both sides, each in axes of its own side, y outwards.
  struct WheelsetSurfaces
  {
    const WheelOnRail &own, &other;
  };

  enum class Roll
  {
    as_both_touch,
    none ///< each wheel touches where it is nearest to its rail under an axle that stays level
  };

  /// The same for unlike sides: profiles, rails or radii. The height counts from the own wheel's radius; that
  /// of a wheelset without roll is 0.
  TouchingWheelset touching_wheelset(const WheelsetSurfaces &surfaces,
                                     WheelsetPosition        position,
                                     Roll                    roll = Roll::as_both_touch);

  /// The lateral motion of a rigid wheelset that rolls freely on straight track, y'' = -dr(y)/(e r), e the
  /// distance of the contacts and r the radius: without speed, mass and creepage (Klingel 1883; EN 15302).
  class LateralMotion
  {
  public:
    /// @param shifts ascending (m); @param differences own less other rolling radius (m), between shifts on
    /// straight lines
    LateralMotion(std::vector<double> shifts, std::vector<double> differences);

    /// Shift without a radius difference, of several the one nearest to the middle of the track (m); NaN if
    /// there is none. Not 0 where the sides are unlike.
    double equilibrium() const;

    /// The equivalent conicity of EN 15302: inclination of the cones whose motion, from one extreme to the
    /// other over twice the amplitude (m), has the same wavelength. Negative where the difference drives the
    /// wheelset away from the equilibrium, by the motion under the opposite one. NaN where the table does not
    /// reach to both extremes, or where no motion has this amplitude.
    double conicity(double amplitude) const;

  private:
    double potential(double y) const; ///< integral of the difference from the equilibrium (m^2)
    /// The first place from the equilibrium to one side at which the potential reaches a level; infinite if
    /// there is none.
    double reaches(double level, int side) const;
    double conicity_of_stable(double amplitude) const;

    std::vector<double> shifts, differences, potentials;
    double              middle = 0.;
  };

  /// Radius differences of a rigid wheelset over its lateral shift, to both sides. Shifts are as near to each
  /// other as straight lines between them need, and a jump of the contact from one place to another is found
  /// to a thousandth of a millimetre.
  class RadiusDifferences
  {
  public:
    /// @param position whose yaw counts; @param largest shift to both sides, m
    RadiusDifferences(const WheelsetSurfaces &surfaces,
                      const WheelsetPosition &position,
                      double                  largest,
                      Roll                    roll = Roll::as_both_touch);

    /// Of what is known: shifts between those nearest to the middle at which a wheel meets no rail.
    LateralMotion motion() const;

    /// harmonic_conicity() at an amplitude (m); NaN where a wheel meets no rail on the way.
    double harmonic(double amplitude) const;

  private:
    /// @param from a shift that is known, from whose roll the search begins, as there may be several
    void add(WheelsetPosition position, double shift, double from);
    /// Add what is missing between two shifts whose values are known, from the inner one outwards.
    void refine(const WheelsetPosition &position, double inner, double outer);
    std::pair<std::vector<double>, std::vector<double>> table() const;

    struct Touching
    {
      double difference, roll; ///< NaN and that of the search where a wheel meets no rail (m, rad)
    };
    WheelsetSurfaces           surfaces;
    Roll                       roll;
    std::map<double, Touching> touching; ///< by the shift (m)
  };

  /// The inclination of the cone that has, under a lateral motion of the amplitude, the same rolling radius
  /// difference in the mean: integral of dr(a sin t) sin t over a turn, over 2 pi a (harmonic linearisation).
  /// @param shifts ascending (m); @param differences own less other (m); @param amplitude a (m), within the
  /// shifts at both sides
  double harmonic_conicity(const std::vector<double> &shifts,
                           const std::vector<double> &differences,
                           double                     amplitude);
} // namespace tread

#endif
