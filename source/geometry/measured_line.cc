// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/geometry/measured_line.h>

// clang-format off
#include <math.h> // isnan without a namespace, which pchip.hpp of Boost 1.74 asks for
#include <boost/math/interpolators/pchip.hpp>
// clang-format on

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace tread
{
  namespace
  {
    struct Sample
    {
      double       x, z; ///< m
      unsigned int line; ///< in the file
    };

    /// Places that are nearer are one, m.
    constexpr double least_distance = 1e-9;

    [[noreturn]] void fail(const std::string &file, const std::string &what)
    {
      throw std::runtime_error("profile '" + file + "': " + what);
    }

    [[noreturn]] void fail(const std::string &file, const unsigned int line, const std::string &what)
    {
      fail(file, "line " + std::to_string(line) + ": " + what);
    }

    std::string lower(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(),
                     [](const unsigned char c) { return std::tolower(c); });
      return text;
    }

    std::string ending(const std::string &file)
    {
      const std::size_t dot = file.rfind('.');
      return dot == std::string::npos ? "" : lower(file.substr(dot + 1));
    }

    /// The numbers of a line; empty if anything in it is none.
    std::vector<double> numbers(std::string text)
    {
      for (char &c : text)
        if (c == ',' || c == ';')
          c = ' ';
      std::istringstream  words(text);
      std::string         word;
      std::vector<double> values;
      while (words >> word)
        {
          std::size_t used = 0;
          try
            {
              values.push_back(std::stod(word, &used));
            }
          catch (const std::exception &)
            {
            }
          if (used != word.size() || !std::isfinite(values.back()))
            return {};
        }
      return values;
    }

    /// What stands before one of the signs that programs begin comments with. Numbers may be in quotes.
    std::string without_comment(std::string text)
    {
      text                = text.substr(0, text.find_first_of("#!%"));
      const auto n_quotes = std::count(text.begin(), text.end(), '"');
      if (n_quotes == 0)
        return text;
      std::string unquoted = text;
      unquoted.erase(std::remove(unquoted.begin(), unquoted.end(), '"'), unquoted.end());
      return n_quotes % 2 == 0 && !numbers(unquoted).empty() ? unquoted : text.substr(0, text.find('"'));
    }

    /// Whether a line begins with a number, so that it is no heading; 60E1 is a rail.
    bool begins_with_number(const std::string &text)
    {
      const char       *between = " \t\r,;";
      const std::size_t begin   = std::min(text.find_first_not_of(between), text.size());
      const std::string word    = lower(text.substr(begin, text.find_first_of(between, begin) - begin));
      return !word.empty() &&
             (word == "nan" || word == "inf" ||
              (word.find_first_not_of("+-.0123456789") == word.npos && !numbers(word).empty()));
    }

    /// Points of a plain table: exactly two columns.
    std::vector<Sample> read_table(const std::string &file, std::istream &in)
    {
      std::vector<Sample> samples;
      std::string         text;
      for (unsigned int line = 1; std::getline(in, text); ++line)
        {
          if (line == 1 && text.compare(0, 3, "\xef\xbb\xbf") == 0) // byte order mark
            text.erase(0, 3);
          text = without_comment(text);
          if (text.find_first_not_of(" \t\r") == std::string::npos)
            continue;
          const std::vector<double> values = numbers(text);
          if (values.empty() && samples.empty() && !begins_with_number(text))
            continue; // a heading
          if (values.size() != 2)
            fail(file, line, "needs two numbers, in mm; a comment begins with '#'");
          samples.push_back({1e-3 * values[0], 1e-3 * values[1], line});
        }
      return samples;
    }

    /// MiniProf: lines "name=value" or other words, then a table whose first two columns are y and z in mm.
    std::vector<Sample> read_miniprof(const std::string &file, std::istream &in)
    {
      std::vector<Sample> samples;
      std::string         text;
      for (unsigned int line = 1; std::getline(in, text); ++line)
        {
          text = without_comment(text);
          if (text.find('=') != std::string::npos || text.find_first_not_of(" \t\r") == std::string::npos)
            continue;
          const std::vector<double> values = numbers(text);
          if (values.empty() && samples.empty())
            continue;
          if (values.size() < 2)
            fail(file, line, "needs at least two numbers, in mm");
          samples.push_back({1e-3 * values[0], 1e-3 * values[1], line});
        }
      return samples;
    }

    /// Simpack: points between point.begin and point.end; names that change them stand before.
    std::vector<Sample> read_simpack(const std::string &file, std::istream &in)
    {
      std::vector<Sample> samples;
      double              per_metre = 1e3, mirror[2] = {1., 1.}, shift[2] = {0., 0.};
      bool                in_points = false, ended = false;
      std::string         text;
      for (unsigned int line = 1; std::getline(in, text) && !ended; ++line)
        {
          text = lower(without_comment(text));
          if (text.find("point.begin") != std::string::npos)
            in_points = true;
          else if (text.find("point.end") != std::string::npos)
            ended = true;
          else if (in_points)
            {
              const std::vector<double> values = numbers(text);
              if (values.empty() && text.find_first_not_of(" \t\r") == std::string::npos)
                continue;
              if (values.size() < 2)
                fail(file, line, "needs at least two numbers");
              samples.push_back({values[0], values[1], line});
            }
          else if (const std::size_t equals = text.find('='); equals != std::string::npos)
            {
              std::istringstream left(text.substr(0, equals));
              std::string        name;
              left >> name;
              const std::vector<double> values = numbers(text.substr(equals + 1));
              const double              value  = values.empty() ? 0. : values[0];
              if (name == "units.len.f" && value > 0.)
                per_metre = value;
              else if ((name == "mirror.y" || name == "mirror.z") && value != 0.)
                mirror[name.back() - 'y'] = -1.;
              else if (name == "shift.y" || name == "shift.z")
                shift[name.back() - 'y'] = value;
              else if (name == "rotate" && value != 0.)
                fail(file, line, "a turned profile cannot be read; 'rotate' must be 0");
            }
        }
      if (!ended)
        fail(file, "has no points between 'point.begin' and 'point.end'");
      for (Sample &s : samples)
        {
          s.x = (mirror[0] * s.x + shift[0]) / per_metre;
          s.z = (mirror[1] * s.z + shift[1]) / per_metre;
        }
      return samples;
    }

    /// How files are read whose names have these endings. A new format is a function and its line here.
    struct Format
    {
      std::vector<std::string> endings;
      std::vector<Sample> (*read)(const std::string &file, std::istream &in);
    };
    const std::vector<Format> formats{{{"prr", "prw"}, read_simpack}, {{"ban", "whl"}, read_miniprof}};

    std::vector<Sample> read_samples(const std::string &file)
    {
      std::ifstream in(file);
      if (!in)
        fail(file, "cannot be read");
      if (std::filesystem::is_directory(file))
        fail(file, "is a folder");
      const auto format =
        std::find_if(formats.begin(), formats.end(), [kind = ending(file)](const Format &f) {
          return std::find(f.endings.begin(), f.endings.end(), kind) != f.endings.end();
        });
      const std::vector<Sample> samples =
        format != formats.end() ? format->read(file, in) : read_table(file, in);
      constexpr double furthest = 1e4; // m
      for (const Sample &s : samples)
        if (!(std::abs(s.x) <= furthest && std::abs(s.z) <= furthest))
          fail(file, s.line, "a place further away than " + text_in_mm(furthest) + " mm");
      if (samples.size() < 4)
        fail(file, "has " + std::to_string(samples.size()) + (samples.size() == 1 ? " point" : " points") +
                     "; at least four are needed");
      return samples;
    }

    MeasuredLine line_through(const std::vector<Sample> &samples)
    {
      std::vector<double> x, z;
      for (const Sample &s : samples)
        {
          x.push_back(s.x);
          z.push_back(s.z);
        }
      return MeasuredLine(x, z);
    }

    void refuse_gaps(const std::string &file, const std::vector<Sample> &samples)
    {
      std::vector<double> spacing;
      for (std::size_t i = 1; i < samples.size(); ++i)
        spacing.push_back(samples[i].x - samples[i - 1].x);
      std::vector<double> sorted = spacing;
      std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
      for (std::size_t i = 0; i < spacing.size(); ++i)
        if (spacing[i] > 5. * sorted[sorted.size() / 2])
          fail(file, samples[i + 1].line,
               "gap of " + text_in_mm(spacing[i]) + " mm where points are usually " +
                 text_in_mm(sorted[sorted.size() / 2]) + " mm apart");
    }

    /// The samples around x = 0 in which x runs on, in increasing order.
    std::vector<Sample> around_middle(const std::string  &file,
                                      std::vector<Sample> samples,
                                      const double        half_width,
                                      const double        least)
    {
      std::size_t middle = 0;
      for (std::size_t i = 0; i < samples.size(); ++i)
        if (std::abs(samples[i].x) < std::abs(samples[middle].x))
          middle = i;
      const std::size_t before = middle > 0 ? middle - 1 : middle,
                        after  = middle + 1 < samples.size() ? middle + 1 : middle;
      if (samples[after].x < samples[before].x)
        {
          std::reverse(samples.begin(), samples.end());
          middle = samples.size() - 1 - middle;
        }
      std::size_t begin = middle, end = middle;
      while (begin > 0 && samples[begin].x - samples[begin - 1].x >= least_distance)
        --begin;
      while (end + 1 < samples.size() && samples[end + 1].x - samples[end].x >= least_distance)
        ++end;
      const bool folds_before = samples[begin].x > -half_width && begin > 0,
                 folds_after  = samples[end].x < half_width && end + 1 < samples.size();
      if (folds_before || folds_after)
        fail(file, samples[folds_before ? begin - 1 : end + 1].line,
             "the lateral coordinate turns back at " + text_in_mm(samples[folds_before ? begin : end].x) +
               " mm; it must run on to " + text_in_mm(half_width) + " mm at both sides");
      if (samples[begin].x > -least || samples[end].x < least)
        fail(file, "reaches from " + text_in_mm(samples[begin].x) + " mm to " + text_in_mm(samples[end].x) +
                     " mm; at least " + text_in_mm(least) + " mm at both sides are needed");
      samples = std::vector<Sample>(samples.begin() + begin, samples.begin() + end + 1);
      std::vector<Sample> needed;
      for (const Sample &s : samples)
        if (std::abs(s.x) <= half_width)
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
    const std::vector<Sample> samples = read_samples(file);
    for (std::size_t i = 1; i < samples.size(); ++i)
      if (!(samples[i].x - samples[i - 1].x >= least_distance))
        fail(file, samples[i].line, "x must increase from line to line");
    refuse_gaps(file, samples);
    return line_through(samples);
  }


  namespace
  {
    std::vector<Sample> read_placed(const std::string &file, const ProfilePlacement &placement)
    {
      std::vector<Sample> samples = read_samples(file);
      for (Sample &s : samples)
        s.x = (placement.is_mirrored ? -s.x : s.x) + placement.shift;
      return samples;
    }

    /// z up: the sides of a rail head lie below its middle, whose height is given.
    void point_up(std::vector<Sample> &samples, const double middle)
    {
      if (samples.front().z + samples.back().z > 2. * middle)
        for (Sample &s : samples)
          s.z = -s.z;
    }

    /// The highest point within 20 mm of the middle becomes z = 0.
    void put_top_to_zero(std::vector<Sample> &samples)
    {
      double top = -1e300;
      for (const Sample &s : samples)
        if (std::abs(s.x) <= 20e-3)
          top = std::max(top, s.z);
      for (Sample &s : samples)
        s.z -= top;
    }

    const Sample &next_to_middle(const std::vector<Sample> &samples)
    {
      return *std::min_element(samples.begin(), samples.end(), [](const Sample &a, const Sample &b) {
        return std::abs(a.x) < std::abs(b.x);
      });
    }

    /// The flange, something more than 10 mm beyond the tread, comes to lie at y < 0 and below.
    /// @returns whether there is one.
    bool orient_by_flange(std::vector<Sample> &samples)
    {
      const double middle = next_to_middle(samples).z;
      const auto   extreme =
        std::max_element(samples.begin(), samples.end(), [&](const Sample &a, const Sample &b) {
          return std::abs(a.z - middle) < std::abs(b.z - middle);
        });
      if (std::abs(extreme->z - middle) <= 10e-3)
        return false;
      const double up = extreme->z < middle ? 1. : -1., along = extreme->x < 0. ? 1. : -1.;
      for (Sample &s : samples)
        {
          s.x *= along;
          s.z *= up;
        }
      return true;
    }

    /// From low to high y, without gaps.
    std::vector<dealii::Point<2>> as_curve(const std::string &file, std::vector<Sample> samples)
    {
      if (samples.front().x > samples.back().x)
        std::reverse(samples.begin(), samples.end());
      constexpr double              widest = 5e-3; // m
      std::vector<dealii::Point<2>> points;
      for (const Sample &s : samples)
        {
          points.emplace_back(s.x, s.z);
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
    std::vector<Sample> samples = around_middle(file, read_placed(file, placement), half_width, least);
    point_up(samples, line_through(samples)(0.));
    put_top_to_zero(samples);
    return line_through(samples);
  }


  MeasuredLine read_wheel_tread(const std::string      &file,
                                const double            half_width,
                                const ProfilePlacement &placement)
  {
    std::vector<Sample> samples = read_placed(file, placement);
    orient_by_flange(samples);
    samples            = around_middle(file, samples, half_width, half_width);
    const double level = line_through(samples)(0.);
    for (Sample &s : samples)
      s.z -= level;
    return line_through(samples);
  }


  std::vector<dealii::Point<2>> read_rail_points(const std::string &file, const ProfilePlacement &placement)
  {
    std::vector<Sample> samples = read_placed(file, placement);
    point_up(samples, next_to_middle(samples).z);
    put_top_to_zero(samples);
    return as_curve(file, samples);
  }


  std::vector<dealii::Point<2>> read_wheel_points(const std::string &file, const ProfilePlacement &placement)
  {
    std::vector<Sample> samples = read_placed(file, placement);
    if (!orient_by_flange(samples))
      fail(file, "has no flange: nothing lies 10 mm below the tread");
    constexpr double    near_middle = 5e-3;
    std::vector<Sample> about;
    for (const Sample &s : samples)
      if (std::abs(s.x) <= near_middle)
        about.push_back(s);
    std::sort(about.begin(), about.end(), [](const Sample &a, const Sample &b) { return a.x < b.x; });
    if (about.size() < 4 || about.front().x > 0. || about.back().x < 0.)
      fail(file, "has less than four points within 5 mm of the running circle y = 0");
    for (std::size_t i = 1; i < about.size(); ++i)
      if (!(about[i].x - about[i - 1].x >= least_distance))
        fail(file, about[i].line,
             "y = " + text_in_mm(about[i].x) + " mm occurs twice, within 5 mm of the running circle y = 0");
    const double     level   = line_through(about)(0.);
    constexpr double deepest = 10e-3; // of a worn tread's false flange, and more
    for (Sample &s : samples)
      {
        s.z -= level;
        if (s.x > 0. && s.z < -deepest)
          fail(file, s.line,
               "lies " + text_in_mm(-s.z) +
                 " mm below the running circle on the side without a flange: no wheel does; is it the "
                 "profile of a rail?");
      }
    return as_curve(file, samples);
  }
} // namespace tread
