// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_force_ripple_h
#define tread_recorders_force_ripple_h

#include <tread/base/archive.h>
#include <tread/base/simd.h>

#include <array>

namespace tread
{
  /// How the force along the rail's surface swings while a wheel rolls over a piece of its way: about
  /// straight lines over the position, so that a force that still builds up does not count.
  class ForceRipple
  {
  public:
    /// @param x position of the wheel, m; @param force on it in a step, N
    void add(const double x, const Vector3 force);

    /// Amplitude over the mean normal force: that of a sine with the same mean square. 0 if nothing was
    /// added.
    double share() const;

    void serialize(Archive &archive)
    {
      archive.same(n, first_x, sum_x, sum_xx, normal, sum, sum_with_x, sum_of_squares);
    }

  private:
    // Sums over the steps, positions counted from the first one.
    double                n = 0., first_x = 0., sum_x = 0., sum_xx = 0., normal = 0.;
    std::array<double, 2> sum{}, sum_with_x{}, sum_of_squares{}; ///< of the force in x and in y
  };
} // namespace tread

#endif
