// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_wheel_deviation_h
#define tread_geometry_wheel_deviation_h

#include <tread/geometry/profile_curve.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tread
{
  /// What a wheel has beyond its body of revolution: dz over the angle about the axle, 0 at the bottom of an
  /// unturned wheel and growing towards x, and over y of the profile; positive dz is more radius.
  class WheelDeviation
  {
  public:
    virtual ~WheelDeviation() = default;

    virtual std::string in_words() const = 0;

    struct Value
    {
      double dz, by_angle, by_y; ///< m, m per rad, -
    };
    /// @param angle any number of turns (rad)
    virtual Value at(double angle, double y) const = 0;
  };

  /// A scan: lines across the tread at angles that increase, all at the same places y.
  struct DeviationLines
  {
    std::string                      file;
    std::vector<double>              angles; ///< rad
    std::vector<double>              y;      ///< m
    std::vector<std::vector<double>> dz;     ///< by line and place (m)
    bool are_chosen = false; ///< whoever wrote the lines spaced them on purpose, so that none is missing
  };

  /// A bicubic spline through the lines of a scan. Between its first and its last line where the lines go
  /// round the wheel, else 0 beyond them; beside its first and last y it goes on level.
  class ScannedDeviation : public WheelDeviation
  {
  public:
    /// @param radius of the wheel (m); @param smoothing of waves of this length along and across the tread
    /// half is left, see smoothed() (m); 0: none
    /// @throws InputError, one line, for a scan that cannot be that of a wheel: a seam, lines that are
    /// missing, slopes and depths that tell of another unit
    ScannedDeviation(DeviationLines lines, double radius, double smoothing);

    std::string in_words() const override;
    Value       at(double angle, double y) const override;

  private:
    DeviationLines                   scan;    ///< with lines beyond its seam or its ends
    std::size_t                      n_lines; ///< of its own
    double                           smoothing;
    std::vector<std::vector<double>> by_yy, by_aa, by_aayy;
  };

  /// A flat with rounded edges, as half a wave of a cosine over its length; across the tread it ends where a
  /// parabola of the given radius is as deep, or nowhere (0):
  /// dz = -max(0, depth/2 (1 + cos(2 pi R angle/length)) - y^2/(2 across)). Lengths in m.
  class RoundedFlat : public WheelDeviation
  {
  public:
    RoundedFlat(double length, double depth, double across, double angle, double radius);

    std::string in_words() const override;
    Value       at(double angle, double y) const override;

  private:
    double length, depth, across, middle, radius;
  };

  /// Waves around the wheel: the radius is larger by amplitude cos(order (angle - crest)).
  class OutOfRound : public WheelDeviation
  {
  public:
    struct Wave
    {
      unsigned int order;
      double       amplitude, crest; ///< m, rad
    };
    explicit OutOfRound(std::vector<Wave> waves);

    std::string in_words() const override;
    Value       at(double angle, double y) const override;

  private:
    std::vector<Wave> waves;
  };

  /// Lines of a table (.csv) or of CONTACT's list of slices (.slcw), of which the profile is taken.
  /// @throws InputError, one line with file and place
  DeviationLines read_deviation_lines(const std::string &file, const std::function<ProfileCurve()> &profile);

  /// From its text: a file, or "flat: length_mm=L depth_mm=D [across_radius_mm=R] [angle_deg=A]", or
  /// "waves: ORDER=AMPLITUDE_MM@CREST_DEG ...".
  /// @param profile of the round wheel, asked for only where slices need it, @param radius where z = 0 in it,
  /// @param smoothing of scans (m)
  /// @throws InputError, one line
  std::shared_ptr<const WheelDeviation> wheel_deviation(const std::string                   &text,
                                                        const std::function<ProfileCurve()> &profile,
                                                        const double                         radius,
                                                        const double                         smoothing);
} // namespace tread

#endif
