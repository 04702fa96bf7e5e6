// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/contact_points.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

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
    return touching_wheelset({surfaces, surfaces}, position);
  }


  TouchingWheelset touching_wheelset(const WheelsetSurfaces &surfaces,
                                     WheelsetPosition        position,
                                     const Roll              roll)
  {
    // The other wheel on the same axle, in axes of its own side.
    const auto of_other = [&] {
      WheelsetPosition mirrored = position.mirrored();
      mirrored.height += surfaces.own.radius() - surfaces.other.radius();
      return mirrored;
    };
    if (roll == Roll::none)
      {
        position.roll = position.height = 0.;
        return {position, touching(surfaces.own, surfaces.own.nearest(position)),
                touching(surfaces.other, surfaces.other.nearest(of_other()))};
      }
    // The difference of both gaps over the roll: by the secant, on flanks steps to the side count too.
    constexpr double tolerance = 1e-10; // m
    constexpr double longest   = 5e-3;  // of a step, rad
    position.height            = 0.;
    const double first_slope   = -surfaces.own.wheel_origin_y() - surfaces.other.wheel_origin_y();
    double       slope = first_slope, last_roll = 0., last_difference = 0.;
    double       low = -1., high = 1.; // the own gap is larger at the low end
    for (unsigned int i = 0; i < 60; ++i)
      {
        const WheelOnRail::Nearest own   = surfaces.own.nearest(position),
                                   other = surfaces.other.nearest(of_other());
        const double difference          = own.gap - other.gap;
        if (std::abs(difference) < tolerance || high - low < 1e-13)
          {
            position.height = -0.5 * (own.gap + other.gap);
            return {position, touching(surfaces.own, own), touching(surfaces.other, other)};
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


  LateralMotion::LateralMotion(std::vector<double> shifts_of_table, std::vector<double> differences_of_table)
    : shifts(std::move(shifts_of_table))
    , differences(std::move(differences_of_table))
    , potentials(shifts.size(), 0.)
  {
    middle               = std::numeric_limits<double>::quiet_NaN();
    const auto is_nearer = [&](const double y) {
      return !(std::abs(y) >= std::abs(middle));
    };
    constexpr double equal = 1e-12; // m, round-off of like wheels
    for (std::size_t i = 0; i < shifts.size(); ++i)
      {
        if (std::abs(differences[i]) < equal && is_nearer(shifts[i]))
          middle = shifts[i];
        if (i > 0 && differences[i - 1] * differences[i] < 0.)
          if (const double y = shifts[i - 1] + (shifts[i] - shifts[i - 1]) * differences[i - 1] /
                                                 (differences[i - 1] - differences[i]);
              is_nearer(y))
            middle = y;
        if (i > 0)
          potentials[i] =
            potentials[i - 1] + 0.5 * (shifts[i] - shifts[i - 1]) * (differences[i - 1] + differences[i]);
      }
    if (std::isnan(middle))
      return;
    const double there = potential(middle);
    for (double &value : potentials)
      value -= there;
  }


  double LateralMotion::equilibrium() const
  {
    return middle;
  }


  double LateralMotion::potential(const double y) const
  {
    const std::size_t i =
      std::clamp<std::ptrdiff_t>(std::upper_bound(shifts.begin(), shifts.end(), y) - shifts.begin() - 1, 0,
                                 static_cast<std::ptrdiff_t>(shifts.size()) - 2);
    const double t     = y - shifts[i],
                 slope = (differences[i + 1] - differences[i]) / (shifts[i + 1] - shifts[i]);
    return potentials[i] + t * (differences[i] + 0.5 * slope * t);
  }


  double LateralMotion::reaches(const double level, const int side) const
  {
    const auto beyond = std::upper_bound(shifts.begin(), shifts.end(), middle) - shifts.begin();
    double     inner  = middle;
    for (std::ptrdiff_t i = side > 0 ? beyond : beyond - 1;
         i >= 0 && i < static_cast<std::ptrdiff_t>(shifts.size()); i += side)
      {
        double outer = shifts[i];
        if (potentials[i] >= level)
          {
            for (unsigned int halving = 0; halving < 60; ++halving)
              {
                const double half                          = 0.5 * (inner + outer);
                (potential(half) >= level ? outer : inner) = half;
              }
            return outer;
          }
        inner = outer;
      }
    return side * std::numeric_limits<double>::infinity();
  }


  double LateralMotion::conicity_of_stable(const double amplitude) const
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), round_off = 1e-9;
    // The level of the potential at both extremes. The table may end exactly there.
    const auto width = [&](const double level) {
      return reaches(level, 1) - reaches(level, -1);
    };
    double low = 0., high = std::min(potentials.front(), potentials.back());
    if (!(high > 0.) || !(width(high) >= 2. * amplitude * (1. - round_off)))
      return nan;
    for (unsigned int halving = 0; halving < 100; ++halving)
      {
        const double half                            = 0.5 * (low + high);
        (width(half) >= 2. * amplitude ? high : low) = half;
      }
    const double level = high, extremes[] = {reaches(level, -1), reaches(level, 1)};
    if (std::abs(extremes[1] - extremes[0] - 2. * amplitude) > 1e-6 * amplitude)
      return nan;
    // Half a period is the integral of dy over the lateral velocity, sqrt(2 (level - potential)). With
    // y = extreme sin(t) from the equilibrium the integrand stays finite where that is 0.
    constexpr unsigned int n    = 2000;
    double                 half = 0.;
    for (const double extreme : extremes)
      for (unsigned int i = 0; i < n; ++i)
        {
          const double angle = 0.5 * dealii::numbers::PI * (i + 0.5) / n,
                       left  = level - potential(middle + (extreme - middle) * std::sin(angle));
          if (!(left > 0.)) // a higher place on the way
            return nan;
          half += 0.5 * dealii::numbers::PI / n * std::abs(extreme - middle) * std::cos(angle) /
                  std::sqrt(2. * left);
        }
    // Of cones, dr = 2 conicity y: the period is 2 pi/sqrt(2 conicity).
    return 0.5 * dealii::numbers::PI * dealii::numbers::PI / (half * half);
  }


  double LateralMotion::conicity(const double amplitude) const
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), none = 1e-10, round_off = 1e-9;
    if (!(amplitude > 0.) || std::isnan(middle) || shifts.size() < 2)
      return nan;
    // Like cylinders: nothing steers.
    double largest = 0.;
    for (std::size_t i = 0; i < shifts.size(); ++i)
      if (std::abs(shifts[i] - middle) <= amplitude * (1. + round_off))
        largest = std::max(largest, std::abs(differences[i]));
    if (largest < none)
      return std::min(middle - shifts.front(), shifts.back() - middle) >= amplitude * (1. - round_off) ? 0.
                                                                                                       : nan;
    if (const double stable = conicity_of_stable(amplitude); !std::isnan(stable))
      return stable;
    LateralMotion opposite = *this;
    for (double &value : opposite.differences)
      value = -value;
    for (double &value : opposite.potentials)
      value = -value;
    return -opposite.conicity_of_stable(amplitude);
  }


  RadiusDifferences::RadiusDifferences(const WheelsetSurfaces &surfaces,
                                       const WheelsetPosition &position,
                                       const double            largest,
                                       const Roll              roll)
    : surfaces(surfaces)
    , roll(roll)
  {
    constexpr double coarse = 0.25e-3; // m, half of it is looked at
    const int        n      = std::max(2, static_cast<int>(std::ceil(largest / coarse)));
    add(position, 0., 0.);
    for (const double to_side : {largest, -largest})
      for (int i = 1; i <= n; ++i)
        {
          add(position, to_side * i / n, to_side * (i - 1) / n);
          refine(position, to_side * (i - 1) / n, to_side * i / n);
        }
  }


  void RadiusDifferences::add(WheelsetPosition position, const double shift, const double from)
  {
    const auto known = touching.find(from);
    position.shift   = shift;
    position.roll    = known == touching.end() ? 0. : known->second.roll;
    try
      {
        const TouchingWheelset found = touching_wheelset(surfaces, position, roll);
        touching[shift]              = {found.radius_difference(), found.position.roll};
      }
    catch (const std::runtime_error &)
      {
        touching[shift] = {std::numeric_limits<double>::quiet_NaN(), position.roll};
      }
  }


  void RadiusDifferences::refine(const WheelsetPosition &position, const double inner, const double outer)
  {
    constexpr double smallest = 1e-6, tolerance = 2e-6; // m
    const double     middle = 0.5 * (inner + outer),
                 expected   = 0.5 * (touching[inner].difference + touching[outer].difference);
    if (std::abs(outer - inner) < smallest || std::isnan(expected))
      return;
    add(position, middle, inner);
    if (std::abs(touching[middle].difference - expected) > tolerance)
      {
        refine(position, inner, middle);
        refine(position, middle, outer);
      }
  }


  std::pair<std::vector<double>, std::vector<double>> RadiusDifferences::table() const
  {
    std::pair<std::vector<double>, std::vector<double>> known;
    for (const auto &[shift, there] : touching)
      {
        if (!std::isnan(there.difference))
          {
            known.first.push_back(shift);
            known.second.push_back(there.difference);
          }
        else if (shift < 0.) // what lies beyond is not reached from the middle
          known = {};
        else
          break;
      }
    return known;
  }


  LateralMotion RadiusDifferences::motion() const
  {
    auto [shifts, values] = table();
    return {std::move(shifts), std::move(values)};
  }


  double RadiusDifferences::harmonic(const double amplitude) const
  {
    constexpr double round_off  = 1e-12; // m
    const auto [shifts, values] = table();
    if (!(amplitude > 0.) || shifts.size() < 2 || amplitude > -shifts.front() + round_off ||
        amplitude > shifts.back() + round_off)
      return std::numeric_limits<double>::quiet_NaN();
    return harmonic_conicity(shifts, values, amplitude);
  }


  double harmonic_conicity(const std::vector<double> &shifts,
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
