// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_measured_line_h
#define tread_geometry_measured_line_h

#include <tread/geometry/measured_profile.h>

#include <deal.II/base/point.h>

#include <functional>
#include <string>
#include <vector>

namespace tread
{
  /// A measured line z(x) through points with increasing x; between them monotone cubic (Fritsch & Carlson
  /// 1980), which does not overshoot. Lengths in m.
  class MeasuredLine
  {
  public:
    MeasuredLine(const std::vector<double> &x, const std::vector<double> &z);

    /// Beyond the ends the value at the end is returned.
    double operator()(const double x) const;

    double begin() const; ///< (m)
    double end() const;   ///< (m)

  private:
    double                        first, last;
    std::function<double(double)> line;
  };

  /// A longitudinal profile: two columns, x and z in mm, z up, separated by blanks, commas or semicolons;
  /// headings, and what stands behind #, !, % or ", are passed over.
  /// @throws std::runtime_error, one line with file and number of the line, where a line has not two numbers,
  /// x does not increase, or a gap is more than five times as long as usual.
  MeasuredLine read_longitudinal_profile(const std::string &file);

  /// The running surface of a rail as z(y), with its file's y placed, its highest point within 20 mm of y = 0
  /// at z = 0: two columns (y and z in mm), .prr of Simpack or .ban of MiniProf. Whether z points up or down
  /// is seen from the shape. Only the part around y = 0 in which y runs on is taken.
  /// @throws std::runtime_error as above within half_width (m) of y = 0, where y turns back there, and where
  /// the file does not reach `least` (m) at both sides.
  MeasuredLine read_rail_head(const std::string      &file,
                              const double            half_width,
                              const double            least,
                              const ProfilePlacement &placement = {});

  /// A wheel tread as z(y), z up: 0 at y = 0 and negative at the flange, which is at y < 0. Formats as of a
  /// rail head, .prw and .whl. The side of the flange and the direction of z are seen from the shape if the
  /// file has the flange, something more than 10 mm beyond the tread, once its y is placed.
  /// @throws std::runtime_error as above.
  MeasuredLine read_wheel_tread(const std::string      &file,
                                const double            half_width,
                                const ProfilePlacement &placement = {});

  /// All points (y, z) of a rail's running surface with its flanks as far as the file has them, from low to
  /// high y, placed and with z up as by read_rail_head(). y may turn back on the flanks.
  /// @throws std::runtime_error as above, for fewer than four points, or for a gap of more than 5 mm.
  std::vector<dealii::Point<2>> read_rail_points(const std::string      &file,
                                                 const ProfilePlacement &placement = {});

  /// All points (y, z) of a wheel's profile with its flange, from low to high y, placed and turned as by
  /// read_wheel_tread().
  /// @throws std::runtime_error as above, and for a file without a flange.
  std::vector<dealii::Point<2>> read_wheel_points(const std::string      &file,
                                                  const ProfilePlacement &placement = {});
} // namespace tread

#endif
