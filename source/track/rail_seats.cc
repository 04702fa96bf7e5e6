// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/rail_seats.h>

#include <algorithm>
#include <limits>

namespace tread
{
  namespace
  {
    constexpr double never = std::numeric_limits<double>::lowest();
  } // namespace


  RailSeats::RailSeats(const Supports &supports, const std::vector<int> &numbers, const int first)
    : supports(supports)
    , numbers(numbers)
    , first(first)
    , force(numbers.size(), never)
    , time(numbers.size(), 0.)
    , wheel_x(numbers.size(), 0.)
    , pressure(numbers.size() * supports.parameters.points_along * supports.parameters.points_across, 0.)
  {
  }


  void RailSeats::record(const double now, const double x)
  {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (const double f = supports.force(numbers[i] - first, Supports::pad); f > force[i])
        {
          force[i]                       = f;
          time[i]                        = now;
          wheel_x[i]                     = x;
          const std::vector<double> seat = supports.seat_pressures(numbers[i] - first);
          std::copy(seat.begin(), seat.end(), pressure.begin() + i * seat.size());
        }
  }


  std::vector<RailSeatPoint> RailSeats::points() const
  {
    const TrackParameters     &p = supports.parameters;
    std::vector<RailSeatPoint> list;
    for (std::size_t i = 0, next = 0; i < numbers.size(); ++i)
      for (unsigned int along = 0; along < p.points_along; ++along)
        for (unsigned int across = 0; across < p.points_across; ++across, ++next)
          if (force[i] > never)
            list.push_back({numbers[i], time[i], wheel_x[i],
                            p.pad_length * ((along + 0.5) / p.points_along - 0.5),
                            p.pad_width * ((across + 0.5) / p.points_across - 0.5), pressure[next]});
    return list;
  }


  void RailSeats::serialize(Archive &archive)
  {
    archive.same_number(force, time, wheel_x, pressure);
  }
} // namespace tread
