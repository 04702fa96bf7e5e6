// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/measured_line.h>
#include <tread/geometry/wheel_tread.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Horner's rule, lowest power first.
    template <std::size_t n>
    double polynomial(const double (&coefficients)[n], const double s)
    {
      double value = 0.;
      for (std::size_t i = n; i-- > 0;)
        value = value * s + coefficients[i];
      return value;
    }

    std::function<double(double)> without_flange(std::function<double(double)> offset, const double begin)
    {
      constexpr double step = 1e-5;
      double           root = 0.;
      while (root - step > begin && (offset(root - step) - offset(root)) / step < 1.)
        root -= step;
      return [offset, root](const double y) {
        return offset(std::max(y, root));
      };
    }
  } // namespace


  double s1002_offset(const double y)
  {
    // in mm, as in the standard
    static const double near_tread[] = {0.,
                                        -3.358537058e-2,
                                        1.565681624e-3,
                                        -2.810427944e-5,
                                        5.844240864e-8,
                                        -1.562379023e-8,
                                        5.309217349e-15,
                                        -5.957839843e-12,
                                        2.646656573e-13};
    static const double throat[]     = {-4.320221063e3,  -1.038384026e3,  -1.065501873e2,  -6.051367875,
                                        -2.054332446e-1, -4.169739389e-3, -4.687195829e-5, -2.252755540e-7};
    const double        s            = 1e3 * y;
    if (s < -70. || s > 60. + 1e-9)
      throw std::domain_error("s1002_offset: beside the profile");
    const auto arc = [s](const double radius, const double middle) {
      return std::sqrt(radius * radius - (s - middle) * (s - middle));
    };
    double f;
    if (s >= 32.15796)
      f = 1.364323640 - 0.066666667 * s;
    else if (s >= -26.)
      f = polynomial(near_tread, s);
    else if (s >= -35.)
      f = polynomial(throat, s);
    else if (s >= -38.426669)
      f = 16.446 - arc(13., -26.210665);
    else if (s >= -39.764474)
      f = -93.576667419 - 2.747477419 * s;
    else if (s >= -49.662510)
      f = 8.834924130 + arc(20., -58.558326413);
    else if (s >= -62.764706)
      f = 16. + arc(12., -55.);
    else
      f = 9.519259302 + arc(20.5, -49.5);
    return 1e-3 * f;
  }


  std::function<double(double)> tread_offset(const std::string      &tread,
                                             const double            half_width,
                                             const ProfilePlacement &placement)
  {
    if (tread == "cylinder")
      return nullptr;
    if (tread == "cone 1:40" || tread == "cone 1:20")
      return [slope = tread == "cone 1:40" ? 1. / 40. : 1. / 20.](const double y) {
        return -slope * y;
      };
    if (tread == "S1002")
      return without_flange(
        [](const double y) {
          constexpr double end = 60e-3; // beyond it the chamfer, which nothing touches
          return s1002_offset(std::min(y, end));
        },
        -50e-3);
    const MeasuredLine line = read_wheel_tread(tread, half_width, placement);
    return without_flange([line](const double y) { return -line(y); }, line.begin());
  }
} // namespace tread
