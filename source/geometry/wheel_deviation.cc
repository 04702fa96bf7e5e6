// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/base/median.h>
#include <tread/base/text_file.h>
#include <tread/geometry/natural_spline.h>
#include <tread/geometry/smoothing_spline.h>
#include <tread/geometry/wheel_deviation.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

namespace tread
{
  namespace
  {
    using std::numbers::pi;
    constexpr double degree = pi / 180.;

    /// A scan whose ends or seam differ by less joins without a step that anybody measures, m.
    constexpr double no_step = 20e-6;

    /// Lines that are further apart than so many usual distances are missing.
    constexpr double missing = 5.;

    /// No wheel in service is so far from round, m, nor so steep along or across its tread.
    constexpr double deepest_deviation = 20e-3, steepest = 0.3;

    /// Lines by which a scan that goes round overlaps itself, so that its spline knows of no seam.
    constexpr std::size_t overlap = 8;

    double wrapped(const double angle)
    {
      return std::remainder(angle, 2. * pi);
    }

    double in_degrees(const double angle)
    {
      return angle / degree;
    }

    std::vector<double> smoothed_values(const std::vector<double> &at,
                                        const std::vector<double> &values,
                                        const double               length)
    {
      std::vector<dealii::Point<2>> points;
      for (std::size_t i = 0; i < at.size(); ++i)
        points.emplace_back(at[i], values[i]);
      std::vector<double> result;
      for (const auto &p : smoothed(points, length))
        result.push_back(p[1]);
      return result;
    }

    std::vector<double> column(const std::vector<std::vector<double>> &lines, const std::size_t j)
    {
      std::vector<double> values;
      for (const std::vector<double> &line : lines)
        values.push_back(line[j]);
      return values;
    }

    void set_column(std::vector<std::vector<double>> &lines,
                    const std::size_t                 j,
                    const std::vector<double>        &values)
    {
      for (std::size_t i = 0; i < lines.size(); ++i)
        lines[i][j] = values[i];
    }

    double largest_difference(const std::vector<double> &a, const std::vector<double> &b)
    {
      double largest = 0.;
      for (std::size_t j = 0; j < a.size(); ++j)
        largest = std::max(largest, std::abs(a[j] - b[j]));
      return largest;
    }

    double largest(const std::vector<double> &values)
    {
      return largest_difference(values, std::vector<double>(values.size(), 0.));
    }

    /// Whether the lines go round the wheel.
    /// @throws InputError for a scan that cannot be that of a wheel
    bool goes_round(const DeviationLines &scan, const double radius)
    {
      const std::string         &file   = scan.file;
      const std::vector<double> &angles = scan.angles;
      const auto                 fail   = [&](const std::string &what) {
        throw InputError("'" + file + "': " + what);
      };
      for (std::size_t i = 1; i < angles.size(); ++i)
        if (!(angles[i] > angles[i - 1]))
          fail(format("lines must follow each other; %g degrees comes after %g", in_degrees(angles[i]),
                      in_degrees(angles[i - 1])));
      for (std::size_t j = 1; j < scan.y.size(); ++j)
        if (!(scan.y[j] > scan.y[j - 1]))
          fail("places across must follow each other; " + text_in_mm(scan.y[j]) + " mm comes after " +
               text_in_mm(scan.y[j - 1]));
      constexpr double round = 2. * pi + 1e-6;
      if (angles.back() - angles.front() > round)
        fail(format("its lines run over %g degrees, more than once around the wheel; are angles in degrees "
                    "given as radians?",
                    in_degrees(angles.back() - angles.front())));
      constexpr double narrow = 15e-3, furthest = 0.2; // m
      if (scan.y.back() - scan.y.front() < narrow)
        fail("its lines cover " + text_in_mm(scan.y.back() - scan.y.front()) +
             " mm of the tread; at least 15 are needed: is y in mm?");
      if (std::max(std::abs(scan.y.front()), std::abs(scan.y.back())) > furthest)
        fail("its lines reach to " + text_in_mm(std::max(std::abs(scan.y.front()), std::abs(scan.y.back()))) +
             " mm beside the running circle: is y in mm?");
      for (std::size_t i = 0; i < angles.size(); ++i)
        for (std::size_t j = 0; j < scan.y.size(); ++j)
          {
            const double dz    = scan.dz[i][j];
            const auto   place = [&] {
              return format(" at %g degrees, y = %g mm", in_degrees(angles[i]), 1e3 * scan.y[j]);
            };
            if (!(std::abs(dz) <= deepest_deviation))
              fail("the deviation is " + text_in_mm(dz) + " mm" + place() + "; a wheel has up to 20");
            const auto slope = [&](const double before, const double way) {
              return std::abs(dz - before) > no_step ? std::abs(dz - before) / way : 0.;
            };
            if (i > 0 && slope(scan.dz[i - 1][j], radius * (angles[i] - angles[i - 1])) > steepest)
              fail(format("it changes by %g mm over %g mm along the tread", 1e3 * (dz - scan.dz[i - 1][j]),
                          1e3 * radius * (angles[i] - angles[i - 1])) +
                   place() + ": a spike, or angles in another unit?");
            if (j > 0 && slope(scan.dz[i][j - 1], scan.y[j] - scan.y[j - 1]) > steepest)
              fail(format("it changes by %g mm over %g mm across the tread", 1e3 * (dz - scan.dz[i][j - 1]),
                          1e3 * (scan.y[j] - scan.y[j - 1])) +
                   place() + ": a spike, or y in another unit?");
          }
      std::vector<double> distances, steps;
      for (std::size_t i = 1; i < angles.size(); ++i)
        {
          distances.push_back(angles[i] - angles[i - 1]);
          steps.push_back(largest_difference(scan.dz[i], scan.dz[i - 1]));
        }
      const double usual = median(distances), seam = angles.front() + 2. * pi - angles.back();
      const bool   is_closed = seam <= 1.5 * std::max(usual, std::max(distances.front(), distances.back()));
      if (!scan.are_chosen)
        for (std::size_t i = 1; i < angles.size(); ++i)
          if (distances[i - 1] > missing * usual &&
              std::max(largest(scan.dz[i]), largest(scan.dz[i - 1])) > no_step)
            fail(format("lines are missing between %g and %g degrees, where others are %g apart",
                        in_degrees(angles[i - 1]), in_degrees(angles[i]), in_degrees(usual)));
      if (is_closed)
        {
          const double step = largest_difference(scan.dz.front(), scan.dz.back()),
                       most = std::max(no_step, 1.5 * *std::max_element(steps.begin(), steps.end()));
          if (seam < 1e-6 ? step > no_step : step > most)
            fail(
              format("the scan has a seam: its last line, at %g degrees, differs by %g mm from its first, at "
                     "%g degrees",
                     in_degrees(angles.back()), 1e3 * step, in_degrees(angles.front())));
        }
      else
        for (const std::size_t end : {std::size_t(0), angles.size() - 1})
          if (largest(scan.dz[end]) > no_step)
            fail(
              format("the scan ends at %g degrees with a deviation of %g mm; it must go round the wheel, or "
                     "end where the wheel is round",
                     in_degrees(angles[end]), 1e3 * largest(scan.dz[end])));
      return is_closed;
    }
  } // namespace


  ScannedDeviation::ScannedDeviation(DeviationLines lines, const double radius, const double smoothing)
    : scan(std::move(lines))
    , smoothing(smoothing)
  {
    require(scan.angles.size() >= 4 && scan.y.size() >= 4,
            "'" + scan.file + "' has " + std::to_string(scan.angles.size()) + " lines of " +
              std::to_string(scan.y.size()) + " places; a surface needs four of each");
    const bool           is_closed = goes_round(scan, radius);
    std::vector<double> &angles    = scan.angles;
    // A last line that repeats the first is not needed.
    if (std::abs(angles.back() - angles.front() - 2. * pi) < 1e-6)
      {
        angles.pop_back();
        scan.dz.pop_back();
      }
    n_lines = angles.size();
    // Lines beyond the seam or the ends, so many that neither the spline nor its smoothing knows of them: the
    // scan again, or the round wheel.
    constexpr double beyond = 3.; // lengths of smoothing
    const double     reach  = beyond * smoothing / radius;
    DeviationLines   front{"", {}, {}, {}}, back(front);
    const auto       add = [](DeviationLines &to, const double angle, const std::vector<double> &line) {
      to.angles.push_back(angle);
      to.dz.push_back(line);
    };
    if (is_closed)
      {
        const std::size_t n = angles.size();
        for (std::size_t k = 0; k < n && (k < overlap || angles[k] - angles.front() < reach); ++k)
          add(back, angles[k] + 2. * pi, scan.dz[k]);
        for (std::size_t k = n; k-- > 0 && (n - k <= overlap || angles.back() - angles[k] < reach);)
          add(front, angles[k] - 2. * pi, scan.dz[k]);
      }
    else if (smoothing > 0.)
      {
        constexpr unsigned int    lines_of_length = 10;
        const double              step            = smoothing / (lines_of_length * radius);
        const std::vector<double> round(scan.y.size(), 0.);
        for (unsigned int k = 1; k <= beyond * lines_of_length; ++k)
          if (angles.back() - angles.front() + 2. * k * step < 2. * pi)
            {
              add(back, angles.back() + k * step, round);
              add(front, angles.front() - k * step, round);
            }
      }
    angles.insert(angles.begin(), front.angles.rbegin(), front.angles.rend());
    scan.dz.insert(scan.dz.begin(), front.dz.rbegin(), front.dz.rend());
    angles.insert(angles.end(), back.angles.begin(), back.angles.end());
    scan.dz.insert(scan.dz.end(), back.dz.begin(), back.dz.end());
    if (smoothing > 0.)
      {
        for (std::vector<double> &line : scan.dz)
          line = smoothed_values(scan.y, line, smoothing);
        std::vector<double> along;
        for (const double angle : angles)
          along.push_back(radius * angle);
        for (std::size_t j = 0; j < scan.y.size(); ++j)
          set_column(scan.dz, j, smoothed_values(along, column(scan.dz, j), smoothing));
      }
    for (const std::vector<double> &line : scan.dz)
      by_yy.push_back(natural_spline(scan.y, line));
    by_aa = by_aayy = by_yy;
    for (std::size_t j = 0; j < scan.y.size(); ++j)
      {
        set_column(by_aa, j, natural_spline(angles, column(scan.dz, j)));
        set_column(by_aayy, j, natural_spline(angles, column(by_yy, j)));
      }
  }


  std::string ScannedDeviation::in_words() const
  {
    double low = 0., high = 0.;
    for (const std::vector<double> &line : scan.dz)
      {
        low  = std::min(low, *std::min_element(line.begin(), line.end()));
        high = std::max(high, *std::max_element(line.begin(), line.end()));
      }
    return format("a scan of %zu lines of '%s', radius %+.4g to %+.4g mm", n_lines, scan.file.c_str(),
                  1e3 * low, 1e3 * high) +
           (smoothing > 0. ? ", smoothed over " + text_in_mm(smoothing) + " mm" : "");
  }


  WheelDeviation::Value ScannedDeviation::at(const double angle, const double at_y) const
  {
    const std::vector<double> &angles = scan.angles, &y = scan.y;
    // The turn in which it lies in the middle of the scan.
    const double middle = 0.5 * (angles.front() + angles.back());
    const double a      = middle + wrapped(angle - middle);
    if (a < angles.front() || a > angles.back())
      return {0., 0., 0.};
    const double here  = std::clamp(at_y, y.front(), y.back());
    const auto   piece = [](const std::vector<double> &knots, const double at) {
      return std::clamp<std::ptrdiff_t>(std::upper_bound(knots.begin(), knots.end(), at) - knots.begin() - 1,
                                        0, static_cast<std::ptrdiff_t>(knots.size()) - 2);
    };
    const std::size_t i = piece(angles, a), j = piece(y, here);
    const double      along = angles[i + 1] - angles[i], across = y[j + 1] - y[j];
    const SplinePiece of_a(along, (a - angles[i]) / along), of_y(across, (here - y[j]) / across);
    double            value[2], bend[2], value_by_y[2], bend_by_y[2];
    for (const unsigned int k : {0, 1})
      {
        const auto &f = scan.dz[i + k], &f_yy = by_yy[i + k], &f_aa = by_aa[i + k], &f_aayy = by_aayy[i + k];
        value[k]      = of_y.value(f[j], f[j + 1], f_yy[j], f_yy[j + 1]);
        bend[k]       = of_y.value(f_aa[j], f_aa[j + 1], f_aayy[j], f_aayy[j + 1]);
        value_by_y[k] = of_y.slope(f[j], f[j + 1], f_yy[j], f_yy[j + 1]);
        bend_by_y[k]  = of_y.slope(f_aa[j], f_aa[j + 1], f_aayy[j], f_aayy[j + 1]);
      }
    return {of_a.value(value[0], value[1], bend[0], bend[1]),
            of_a.slope(value[0], value[1], bend[0], bend[1]),
            here == at_y ? of_a.value(value_by_y[0], value_by_y[1], bend_by_y[0], bend_by_y[1]) : 0.};
  }


  RoundedFlat::RoundedFlat(const double length,
                           const double depth,
                           const double across,
                           const double angle,
                           const double radius)
    : length(length)
    , depth(depth)
    , across(across)
    , middle(angle)
    , radius(radius)
  {
  }


  std::string RoundedFlat::in_words() const
  {
    return "a rounded flat, " + text_in_mm(length) + " mm long and " + text_in_mm(depth) + " mm deep";
  }


  WheelDeviation::Value RoundedFlat::at(const double angle, const double y) const
  {
    const double a = wrapped(angle - middle), wave = 2. * pi * radius / length;
    if (std::abs(wave * a) >= pi)
      return {0., 0., 0.};
    const double deep = 0.5 * depth * (1. + std::cos(wave * a)) - (across > 0. ? 0.5 * y * y / across : 0.);
    if (deep <= 0.)
      return {0., 0., 0.};
    return {-deep, 0.5 * depth * wave * std::sin(wave * a), across > 0. ? y / across : 0.};
  }


  OutOfRound::OutOfRound(std::vector<Wave> waves)
    : waves(std::move(waves))
  {
  }


  std::string OutOfRound::in_words() const
  {
    std::string text = "waves of the radius,";
    for (const Wave &wave : waves)
      text +=
        format("%s %g mm of order %u", &wave == &waves.front() ? "" : ",", 1e3 * wave.amplitude, wave.order);
    return text;
  }


  WheelDeviation::Value OutOfRound::at(const double angle, const double) const
  {
    Value sum{0., 0., 0.};
    for (const Wave &wave : waves)
      {
        const double phase = wave.order * (angle - wave.crest);
        sum.dz += wave.amplitude * std::cos(phase);
        sum.by_angle -= wave.amplitude * wave.order * std::sin(phase);
      }
    return sum;
  }


  namespace
  {
    /// The words "name=number" behind the colon.
    std::vector<std::pair<std::string, std::string>> settings(const std::string &text)
    {
      std::istringstream                               stream(text.substr(text.find(':') + 1));
      std::vector<std::pair<std::string, std::string>> list;
      for (std::string word; stream >> word;)
        {
          const std::size_t is = word.find('=');
          require(is != word.npos && is > 0 && is + 1 < word.size(),
                  "'" + text + "': '" + word + "' must be NAME=NUMBER");
          list.emplace_back(word.substr(0, is), word.substr(is + 1));
        }
      return list;
    }

    double number_of(const std::string &text,
                     const std::string &name,
                     const std::string &word,
                     const double       least,
                     const double       most)
    {
      const std::optional<double> value = number_in(word);
      require(value && *value >= least && *value <= most, "'" + text + "': " + name + " is '" + word +
                                                            "'; allowed: " + text_of(least) + " to " +
                                                            text_of(most));
      return *value;
    }

    void check_slope(const std::string &text, const double slope)
    {
      require(slope <= steepest, "'" + text + "' is as steep as " + text_of(slope) +
                                   " along the tread; a wheel has up to " + text_of(steepest));
    }

    std::shared_ptr<const WheelDeviation> flat(const std::string &text, const double radius)
    {
      struct Setting
      {
        double value, least, most;
        bool   is_needed, is_given;
      };
      const double                   circumference = 2e3 * pi * radius;
      std::map<std::string, Setting> known{{"length_mm", {0., 1., 0.5 * circumference, true, false}},
                                           {"depth_mm", {0., 0., 20., true, false}},
                                           {"across_radius_mm", {0., 0., 1e6, false, false}},
                                           {"angle_deg", {0., -360., 360., false, false}}};
      for (const auto &[name, word] : settings(text))
        {
          const auto found = known.find(name);
          require(found != known.end(), "'" + text + "': '" + name +
                                          "' is not known; a flat has length_mm, depth_mm, "
                                          "across_radius_mm and angle_deg");
          Setting &setting = found->second;
          require(!setting.is_given, "'" + text + "': " + name + " is given twice");
          setting.value    = number_of(text, name, word, setting.least, setting.most);
          setting.is_given = true;
        }
      for (const auto &[name, setting] : known)
        require(setting.is_given || !setting.is_needed, "'" + text + "': " + name + " is missing");
      const auto in_m = [&](const std::string &name) {
        return 1e-3 * known.at(name).value;
      };
      check_slope(text, pi * in_m("depth_mm") / in_m("length_mm"));
      return std::make_shared<RoundedFlat>(in_m("length_mm"), in_m("depth_mm"), in_m("across_radius_mm"),
                                           degree * known.at("angle_deg").value, radius);
    }

    std::shared_ptr<const WheelDeviation> waves(const std::string &text, const double radius)
    {
      std::vector<OutOfRound::Wave> list;
      for (const auto &[name, words] : settings(text))
        {
          const double      order = number_of(text, "the order", name, 1., 1000.);
          const std::size_t at    = words.find('@');
          require(order == std::floor(order), "'" + text + "': the order '" + name + "' is no whole number");
          list.push_back({static_cast<unsigned int>(order),
                          1e-3 * number_of(text, "the amplitude in mm", words.substr(0, at), 0., 20.),
                          at == words.npos ? 0.
                                           : degree * number_of(text, "the crest in degrees",
                                                                words.substr(at + 1), -360., 360.)});
        }
      for (const OutOfRound::Wave &wave : list)
        check_slope(text, wave.order * wave.amplitude / radius);
      require(!list.empty(), "'" + text + "': no wave; each is ORDER=AMPLITUDE_MM@CREST_DEG");
      return std::make_shared<OutOfRound>(list);
    }
  } // namespace


  std::shared_ptr<const WheelDeviation> wheel_deviation(const std::string                   &text,
                                                        const std::function<ProfileCurve()> &profile,
                                                        const double                         radius,
                                                        const double                         smoothing)
  {
    if (text.starts_with("flat:"))
      return flat(text, radius);
    if (text.starts_with("waves:"))
      return waves(text, radius);
    return std::make_shared<ScannedDeviation>(read_deviation_lines(text, profile), radius, smoothing);
  }
} // namespace tread
