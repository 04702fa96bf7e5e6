// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/recorders/force_ripple.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  void ForceRipple::add(const double x, const Vector3 force)
  {
    if (n == 0.)
      first_x = x;
    const double way = x - first_x;
    n += 1.;
    sum_x += way;
    sum_xx += way * way;
    normal += force[2];
    for (unsigned int d = 0; d < 2; ++d)
      {
        sum[d] += force[d];
        sum_with_x[d] += force[d] * way;
        sum_of_squares[d] += force[d] * force[d];
      }
  }


  double ForceRipple::share() const
  {
    // A line needs two points, and what is left of it a third.
    if (n < 3. || !(normal > 0.))
      return 0.;
    const double spread = sum_xx - sum_x * sum_x / n;
    double       rest   = 0.;
    for (unsigned int d = 0; d < 2; ++d)
      {
        const double together = sum_with_x[d] - sum_x * sum[d] / n;
        rest += sum_of_squares[d] - sum[d] * sum[d] / n - (spread > 0. ? together * together / spread : 0.);
      }
    return std::sqrt(2. * std::max(0., rest) / n) / (normal / n);
  }
} // namespace tread
