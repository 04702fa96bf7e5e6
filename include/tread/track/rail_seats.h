// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_rail_seats_h
#define tread_track_rail_seats_h

#include <tread/track/supports.h>

#include <vector>

namespace tread
{
  /// What a rail presses on one part of a pad, at the instant of the largest force in the pad.
  struct RailSeatPoint
  {
    int    support;  ///< number
    double time;     ///< s
    double wheel_x;  ///< of the first wheel, m
    double x, y;     ///< middle of the part from the middle of the pad, m
    double pressure; ///< Pa; negative in tension
  };

  /// Keeps, for some supports, the pressures on all parts of the pad at the instant of the largest force in
  /// it. All ranks know the same.
  class RailSeats
  {
  public:
    /// @param numbers of the supports to be watched; @param first number of the first support
    RailSeats(const Supports &supports, const std::vector<int> &numbers, const int first);

    /// Keep the present pressures of each pad whose force is larger than ever before. To be called after
    /// every step: it is a sum over the springs.
    void record(const double time, const double wheel_x);

    /// All parts of the pads that have been recorded, support by support.
    std::vector<RailSeatPoint> points() const;

    void serialize(Archive &archive);

  private:
    const Supports        &supports;
    const std::vector<int> numbers;
    const int              first;

    // The state, by support, and for the pressures by support and point.
    std::vector<double> force, time, wheel_x, pressure; ///< N, s, m, Pa
  };
} // namespace tread

#endif
