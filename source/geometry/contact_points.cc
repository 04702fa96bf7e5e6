// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/contact_points.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tread
{
  namespace
  {
    TouchingWheel touching(const WheelOnRail &surfaces, const WheelOnRail::Nearest &nearest)
    {
      const WheelOnRail::OutlinePoint &point = nearest.point;
      const ProfileCurve::Place        place = surfaces.wheel().at(point.s);
      return {point.place[0],
              point.place[1],
              place.y,
              std::atan(surfaces.rail().slope(point.place[1])),
              surfaces.radius() - place.z,
              surfaces.is_beyond_flank(point.s)};
    }
  } // namespace


  TouchingWheelset touching_wheelset(const WheelOnRail &surfaces, WheelsetPosition position)
  {
    // The difference of both gaps over the roll: by the secant, on flanks steps to the side count too.
    constexpr double tolerance = 1e-10; // m
    constexpr double longest   = 5e-3;  // of a step, rad
    position.height            = 0.;
    const double first_slope   = -2. * surfaces.wheel_origin_y();
    double       slope = first_slope, last_roll = 0., last_difference = 0.;
    double       low = -1., high = 1.; // the own gap is larger at the low end
    for (unsigned int i = 0; i < 60; ++i)
      {
        const WheelOnRail::Nearest own   = surfaces.nearest(position),
                                   other = surfaces.nearest(position.mirrored());
        const double difference          = own.gap - other.gap;
        if (std::abs(difference) < tolerance || high - low < 1e-13)
          {
            position.height = -0.5 * (own.gap + other.gap);
            return {position, touching(surfaces, own), touching(surfaces, other)};
          }
        (difference > 0. ? low : high) = position.roll;
        if (i > 0 && position.roll != last_roll)
          slope = (difference - last_difference) / (position.roll - last_roll);
        if (!(slope < 0.))
          slope = first_slope;
        last_roll       = position.roll;
        last_difference = difference;
        position.roll   = last_roll - std::clamp(difference / slope, -longest, longest);
        if (!(position.roll > low && position.roll < high))
          position.roll = 0.5 * (low + high);
      }
    throw std::runtime_error("no roll is found at which both wheels touch");
  }


  RadiusDifferences::RadiusDifferences(const WheelOnRail      &surfaces,
                                       const WheelsetPosition &position,
                                       const double            largest)
    : reach(std::numeric_limits<double>::infinity())
  {
    constexpr double coarse = 0.25e-3; // m, half of it is looked at
    const int        n      = std::max(2, static_cast<int>(std::ceil(largest / coarse)));
    add(surfaces, position, 0., 0.);
    for (const double to_side : {largest, -largest})
      for (int i = 1; i <= n; ++i)
        {
          add(surfaces, position, to_side * i / n, to_side * (i - 1) / n);
          refine(surfaces, position, to_side * (i - 1) / n, to_side * i / n);
        }
  }


  void RadiusDifferences::add(const WheelOnRail &surfaces,
                              WheelsetPosition   position,
                              const double       shift,
                              const double       from)
  {
    const auto known = touching.find(from);
    position.shift   = shift;
    position.roll    = known == touching.end() ? 0. : known->second.roll;
    try
      {
        const TouchingWheelset found = touching_wheelset(surfaces, position);
        touching[shift]              = {found.radius_difference(), found.position.roll};
      }
    catch (const std::runtime_error &)
      {
        touching[shift] = {std::numeric_limits<double>::quiet_NaN(), position.roll};
        reach           = std::min(reach, std::abs(shift));
      }
  }


  void RadiusDifferences::refine(const WheelOnRail      &surfaces,
                                 const WheelsetPosition &position,
                                 const double            inner,
                                 const double            outer)
  {
    constexpr double smallest = 1e-6, tolerance = 2e-6; // m
    const double     middle = 0.5 * (inner + outer),
                 expected   = 0.5 * (touching[inner].difference + touching[outer].difference);
    if (std::abs(outer - inner) < smallest || std::isnan(expected))
      return;
    add(surfaces, position, middle, inner);
    if (std::abs(touching[middle].difference - expected) > tolerance)
      {
        refine(surfaces, position, inner, middle);
        refine(surfaces, position, middle, outer);
      }
  }


  double RadiusDifferences::conicity(const double amplitude) const
  {
    constexpr double round_off = 1e-12; // m
    if (!(amplitude > 0.) || amplitude >= reach || amplitude > touching.rbegin()->first + round_off)
      return std::numeric_limits<double>::quiet_NaN();
    std::vector<double> shifts, values;
    for (const auto &[shift, there] : touching)
      if (!std::isnan(there.difference))
        {
          shifts.push_back(shift);
          values.push_back(there.difference);
        }
    return equivalent_conicity(shifts, values, amplitude);
  }


  double equivalent_conicity(const std::vector<double> &shifts,
                             const std::vector<double> &differences,
                             const double               amplitude)
  {
    const auto difference = [&](const double y) {
      const std::size_t i =
        std::clamp<std::ptrdiff_t>(std::upper_bound(shifts.begin(), shifts.end(), y) - shifts.begin() - 1, 0,
                                   static_cast<std::ptrdiff_t>(shifts.size()) - 2);
      return differences[i] +
             (y - shifts[i]) / (shifts[i + 1] - shifts[i]) * (differences[i + 1] - differences[i]);
    };
    constexpr unsigned int n   = 720;
    double                 sum = 0.;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double sine = std::sin(2. * dealii::numbers::PI * (i + 0.5) / n);
        sum += difference(amplitude * sine) * sine / n;
      }
    return sum / amplitude;
  }
} // namespace tread
