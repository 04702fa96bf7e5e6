// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/median.h>
#include <tread/geometry/measured_line.h>

// clang-format off
#include <math.h> // isnan without a namespace, which pchip.hpp of Boost 1.74 asks for
#include <boost/math/interpolators/pchip.hpp>
// clang-format on

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    using Sample = ProfilePoint;

    /// Places that are nearer are one, m.
    constexpr double least_distance = 1e-9;

    [[noreturn]] void fail(const std::string &file, const std::string &what)
    {
      refuse_profile(file, 0, what);
    }

    [[noreturn]] void fail(const std::string &file, const unsigned int line, const std::string &what)
    {
      refuse_profile(file, line, what);
    }

    MeasuredLine line_through(const std::vector<Sample> &samples)
    {
      std::vector<double> x, z;
      for (const Sample &s : samples)
        {
          x.push_back(s.y);
          z.push_back(s.z);
        }
      return MeasuredLine(x, z);
    }

    void refuse_gaps(const std::string &file, const std::vector<Sample> &samples)
    {
      std::vector<double> spacing;
      for (std::size_t i = 1; i < samples.size(); ++i)
        spacing.push_back(samples[i].y - samples[i - 1].y);
      const double usual = median(spacing);
      for (std::size_t i = 0; i < spacing.size(); ++i)
        if (spacing[i] > 5. * usual)
          fail(file, samples[i + 1].line,
               "gap of " + text_in_mm(spacing[i]) + " mm where points are usually " + text_in_mm(usual) +
                 " mm apart");
    }

    /// The samples around x = 0 in which x runs on, in increasing order.
    std::vector<Sample> around_middle(const std::string  &file,
                                      std::vector<Sample> samples,
                                      const double        half_width,
                                      const double        least)
    {
      std::size_t middle = 0;
      for (std::size_t i = 0; i < samples.size(); ++i)
        if (std::abs(samples[i].y) < std::abs(samples[middle].y))
          middle = i;
      const std::size_t before = middle > 0 ? middle - 1 : middle,
                        after  = middle + 1 < samples.size() ? middle + 1 : middle;
      if (samples[after].y < samples[before].y)
        {
          std::reverse(samples.begin(), samples.end());
          middle = samples.size() - 1 - middle;
        }
      std::size_t begin = middle, end = middle;
      while (begin > 0 && samples[begin].y - samples[begin - 1].y >= least_distance)
        --begin;
      while (end + 1 < samples.size() && samples[end + 1].y - samples[end].y >= least_distance)
        ++end;
      const bool folds_before = samples[begin].y > -half_width && begin > 0,
                 folds_after  = samples[end].y < half_width && end + 1 < samples.size();
      if (folds_before || folds_after)
        fail(file, samples[folds_before ? begin - 1 : end + 1].line,
             "the lateral coordinate turns back at " + text_in_mm(samples[folds_before ? begin : end].y) +
               " mm; it must run on to " + text_in_mm(half_width) + " mm at both sides");
      if (samples[begin].y > -least || samples[end].y < least)
        fail(file, "reaches from " + text_in_mm(samples[begin].y) + " mm to " + text_in_mm(samples[end].y) +
                     " mm; at least " + text_in_mm(least) + " mm at both sides are needed");
      samples = std::vector<Sample>(samples.begin() + begin, samples.begin() + end + 1);
      std::vector<Sample> needed;
      for (const Sample &s : samples)
        if (std::abs(s.y) <= half_width)
          needed.push_back(s);
      if (needed.size() < 4)
        fail(file, "has less than four points within " + text_in_mm(half_width) + " mm of the middle");
      refuse_gaps(file, needed);
      return samples;
    }
  } // namespace


  MeasuredLine::MeasuredLine(const std::vector<double> &x, const std::vector<double> &z)
    : first(x.front())
    , last(x.back())
  {
    auto abscissas = x, ordinates = z;
    line = boost::math::interpolators::pchip<std::vector<double>>(std::move(abscissas), std::move(ordinates));
  }


  double MeasuredLine::operator()(const double x) const
  {
    return line(std::clamp(x, first, last));
  }


  double MeasuredLine::begin() const
  {
    return first;
  }


  double MeasuredLine::end() const
  {
    return last;
  }


  MeasuredLine read_longitudinal_profile(const std::string &file)
  {
    const std::vector<Sample> samples = read_profile_points(file, ProfileBody::along_rail);
    for (std::size_t i = 1; i < samples.size(); ++i)
      if (!(samples[i].y - samples[i - 1].y >= least_distance))
        fail(file, samples[i].line, "x must increase from line to line");
    refuse_gaps(file, samples);
    return line_through(samples);
  }


  namespace
  {
    /// The highest point within 20 mm of the middle becomes z = 0.
    void put_top_to_zero(std::vector<Sample> &samples)
    {
      double top = -1e300;
      for (const Sample &s : samples)
        if (std::abs(s.y) <= 20e-3)
          top = std::max(top, s.z);
      for (Sample &s : samples)
        s.z -= top;
    }

    /// From low to high y, without gaps.
    std::vector<dealii::Point<2>> as_curve(const std::string &file, std::vector<Sample> samples)
    {
      if (samples.front().y > samples.back().y)
        std::reverse(samples.begin(), samples.end());
      constexpr double              widest = 5e-3; // m
      std::vector<dealii::Point<2>> points;
      for (const Sample &s : samples)
        {
          points.emplace_back(s.y, s.z);
          if (points.size() > 1 && points.back().distance(points[points.size() - 2]) > widest)
            fail(file, s.line,
                 "gap of " + text_in_mm(points.back().distance(points[points.size() - 2])) + " mm; at most " +
                   text_in_mm(widest) + " mm between neighbours");
        }
      return points;
    }
  } // namespace


  MeasuredLine read_rail_head(const std::string      &file,
                              const double            half_width,
                              const double            least,
                              const ProfilePlacement &placement)
  {
    std::vector<Sample> samples = around_middle(
      file, read_measured_profile(file, ProfileBody::rail, placement).points, half_width, least);
    put_top_to_zero(samples);
    return line_through(samples);
  }


  MeasuredLine read_wheel_tread(const std::string      &file,
                                const double            half_width,
                                const ProfilePlacement &placement)
  {
    std::vector<Sample> samples = around_middle(
      file, read_measured_profile(file, ProfileBody::wheel, placement).points, half_width, half_width);
    const double level = line_through(samples)(0.);
    for (Sample &s : samples)
      s.z -= level;
    return line_through(samples);
  }


  std::vector<dealii::Point<2>> read_rail_points(const std::string &file, const ProfilePlacement &placement)
  {
    std::vector<Sample> samples = read_measured_profile(file, ProfileBody::rail, placement).points;
    put_top_to_zero(samples);
    return as_curve(file, samples);
  }


  std::vector<dealii::Point<2>> read_wheel_points(const std::string &file, const ProfilePlacement &placement)
  {
    const MeasuredProfile profile = read_measured_profile(file, ProfileBody::wheel, placement);
    if (!profile.has_flange)
      fail(file, "has no flange: nothing lies 10 mm below the tread");
    std::vector<Sample> samples     = profile.points;
    constexpr double    near_middle = 5e-3;
    std::vector<Sample> about;
    for (const Sample &s : samples)
      if (std::abs(s.y) <= near_middle)
        about.push_back(s);
    std::sort(about.begin(), about.end(), [](const Sample &a, const Sample &b) { return a.y < b.y; });
    if (about.size() < 4 || about.front().y > 0. || about.back().y < 0.)
      fail(file, "has less than four points within 5 mm of the running circle y = 0");
    for (std::size_t i = 1; i < about.size(); ++i)
      if (!(about[i].y - about[i - 1].y >= least_distance))
        fail(file, about[i].line,
             "y = " + text_in_mm(about[i].y) + " mm occurs twice, within 5 mm of the running circle y = 0");
    const double level = line_through(about)(0.);
    for (Sample &s : samples)
      s.z -= level;
    return as_curve(file, samples);
  }
} // namespace tread
