// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/text_file.h>
#include <tread/geometry/profile_file.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace tread
{
  void refuse_profile(const std::string &file, const unsigned int line, const std::string &what)
  {
    throw std::runtime_error("profile '" + file +
                             "': " + (line > 0 ? "line " + std::to_string(line) + ": " : "") + what);
  }


  namespace
  {
    using Points = std::vector<ProfilePoint>;

    constexpr double mm = 1e-3;

    std::string lower(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(),
                     [](const unsigned char c) { return std::tolower(c); });
      return text;
    }

    std::string without_blanks(const std::string &text)
    {
      const std::size_t begin = text.find_first_not_of(" \t\r");
      return begin == text.npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
    }

    /// Words of a file in quotes, as messages show them.
    std::string shown(const std::string &text)
    {
      constexpr std::size_t longest = 40;
      return "'" + text.substr(0, longest) + (text.size() > longest ? "..." : "") + "'";
    }

    std::string ending(const std::string &file)
    {
      const std::size_t dot = file.rfind('.');
      return dot == std::string::npos ? "" : lower(file.substr(dot + 1));
    }

    std::optional<double> number_of_any(const std::string &word)
    {
      const auto value = number_in(word, '.');
      return value ? value : number_in(word, ',');
    }

    /// What stands before one of the signs that programs begin comments with. Numbers may be in quotes.
    std::string without_comment(std::string text)
    {
      text = text.substr(0, text.find_first_of("#!%"));
      if (text.find('"') == text.npos)
        return text;
      const std::string numbers = without_remark(text);
      const bool        pairs   = std::count(numbers.begin(), numbers.end(), '"') % 2 == 0;
      const auto        numeric = [&](const char separator) {
        std::vector<std::string> entries = entries_of(numbers, separator);
        if (entries.size() > 1 && entries.back().empty())
          entries.pop_back();
        return std::all_of(entries.begin(), entries.end(),
                                  [](const std::string &entry) { return number_of_any(entry).has_value(); });
      };
      return pairs && (numeric(' ') || numeric(',') || numeric(';')) ? numbers
                                                                     : text.substr(0, text.find('"'));
    }

    /// Whether a line is one of numbers and no heading: 60E1 is a rail, 3.5e-2 1 are two numbers.
    bool is_row(const std::string &text)
    {
      const char              *between = " \t\r,;\"";
      std::vector<std::string> words;
      for (std::size_t at = text.find_first_not_of(between); at != text.npos;)
        {
          const std::size_t end = std::min(text.find_first_of(between, at), text.size());
          words.push_back(lower(text.substr(at, end - at)));
          at = text.find_first_not_of(between, end);
        }
      if (words.empty())
        return false;
      const bool plain = words[0] == "nan" || words[0] == "inf" ||
                         words[0].find_first_not_of("+-.0123456789") == std::string::npos;
      return number_in(words[0]) &&
             (plain || std::all_of(words.begin(), words.end(),
                                   [](const std::string &word) { return number_in(word).has_value(); }));
    }

    /// Points from lines of numbers, by the grammar that all of them share.
    /// @param exactly_two whether there are two columns, apart from remarks, or at least two
    /// @param column_y, column_z where they stand
    Points points_of(const std::string               &file,
                     const std::vector<NumberedLine> &lines,
                     const bool                       exactly_two,
                     const std::size_t                column_y = 0,
                     const std::size_t                column_z = 1)
    {
      std::vector<NumberedLine> rows;
      for (const NumberedLine &line : lines)
        rows.push_back({line.number, without_blanks(without_remark(line.text))});
      TableGrammar grammar;
      try
        {
          grammar = grammar_of(rows);
        }
      catch (const TextError &error)
        {
          refuse_profile(file, 0, error.what());
        }
      const std::size_t needed = std::max(column_y, column_z) + 1;
      const std::string need   = exactly_two   ? "needs two numbers, in mm; a comment begins with '#'"
                                 : needed == 2 ? "needs at least two numbers"
                                               : "needs at least " + std::to_string(needed) + " numbers";
      Points            points;
      for (const NumberedLine &row : rows)
        {
          std::vector<std::string> entries = entries_of(row.text, grammar.separator);
          while (entries.size() > needed && entries.back().empty()) // a separator that ends the line
            entries.pop_back();
          std::vector<double> values;
          for (std::string &entry : entries)
            {
              const auto value = number_in(entry, grammar.decimal);
              if (!value || !std::isfinite(*value))
                refuse_profile(file, row.number,
                               need +
                                 (entry.empty() ? "; an entry is empty" : "; " + shown(entry) + " is none"));
              values.push_back(*value);
            }
          if (values.size() < needed || (exactly_two && values.size() > 2))
            refuse_profile(file, row.number,
                           need + (exactly_two && values.size() == 4 && grammar.separator == ','
                                     ? "; numbers with decimal commas need semicolons or blanks between them"
                                     : ""));
          points.push_back({values[column_y], values[column_z], row.number});
        }
      return points;
    }

    Points in_metres(Points points)
    {
      for (ProfilePoint &p : points)
        {
          p.y *= mm;
          p.z *= mm;
        }
      return points;
    }

    std::vector<NumberedLine> numbered(const std::vector<std::string> &lines)
    {
      std::vector<NumberedLine> result;
      for (const std::string &line : lines)
        result.push_back({static_cast<unsigned int>(result.size() + 1), line});
      return result;
    }

    bool is_blank(const std::string &text)
    {
      return without_blanks(text).empty();
    }

    /// Points of a plain table: exactly two columns, in mm.
    Points read_table(const std::string &file, const std::vector<std::string> &lines, const ProfileBody)
    {
      std::vector<NumberedLine> rows;
      for (const NumberedLine &line : numbered(lines))
        {
          const std::string text = without_comment(line.text);
          if (rows.empty() && text.find("x_mm") != text.npos && text.find("y_mm") != text.npos)
            refuse_profile(
              file, line.number,
              "is a map of heights, with columns x_mm, y_mm and z_mm, which 'Defect/Shape' map reads; a "
              "profile has two");
          if (is_blank(text) || (rows.empty() && !is_row(text))) // a heading
            continue;
          rows.push_back({line.number, text});
        }
      return in_metres(points_of(file, rows, true));
    }

    /// MiniProf of all ages: a heading of lines "name=value", or, of old instruments, of words and numbers,
    /// that an empty line ends; then a table in mm whose columns ColumnDef names, else y and z are the first
    /// two.
    class MiniProf
    {
    public:
      MiniProf(const std::string &file, const std::vector<std::string> &text)
        : file(file)
        , lines(numbered(text))
      {
        for (NumberedLine &line : lines)
          line.text = without_comment(line.text);
      }

      Points read()
      {
        std::vector<NumberedLine> rows;
        for (std::size_t i = 0, end = end_of_heading(); i < lines.size(); ++i)
          {
            const NumberedLine &line   = lines[i];
            const std::size_t   equals = line.text.find('=');
            if (equals != line.text.npos)
              {
                if (!rows.empty())
                  refuse_profile(file, line.number,
                                 shown(without_blanks(line.text.substr(0, equals))) +
                                   " stands behind points: does another measurement begin? A file has one");
                set(line, lower(without_blanks(line.text.substr(0, equals))),
                    without_blanks(line.text.substr(equals + 1)));
              }
            else if (i >= end && !is_blank(line.text) && (!rows.empty() || is_row(line.text)))
              rows.push_back(line);
          }
        Points points = points_of(file, rows, false, column_y, column_z);
        if (points.size() < n_points)
          refuse_profile(file, 0,
                         "has " + std::to_string(points.size()) + " points, where its 'XYPoints' is " +
                           std::to_string(n_points) + ": is the file complete?");
        for (ProfilePoint &p : points)
          {
            p.y += offset_y;
            p.z += offset_z;
          }
        return in_metres(points);
      }

    private:
      const std::string         file;
      std::vector<NumberedLine> lines;
      std::size_t               column_y = 0, column_z = 1, n_points = 0;
      double                    offset_y = 0., offset_z = 0.; // mm

      /// Index of the first line that may be a point. An empty line ends a heading, whose lines may be
      /// numbers too, but not directly before it.
      std::size_t end_of_heading() const
      {
        constexpr std::size_t few  = 4;
        const auto            rows = [&](const std::size_t begin, const std::size_t end) {
          return static_cast<std::size_t>(
            std::count_if(lines.begin() + begin, lines.begin() + end,
                                     [](const NumberedLine &line) { return is_row(line.text); }));
        };
        std::size_t heading = 0;
        while (heading < lines.size() && is_blank(lines[heading].text))
          ++heading;
        std::size_t blank = heading;
        while (blank < lines.size() && !is_blank(lines[blank].text))
          ++blank;
        const bool has_words = rows(heading, blank) < blank - heading;
        const bool before    = blank >= few && rows(blank - few, blank) == few;
        return has_words && !before && rows(blank, lines.size()) >= few ? blank : 0;
      }

      void set(const NumberedLine &line, const std::string &name, const std::string &value)
      {
        if (name == "columndef")
          {
            const std::vector<std::string> columns = entries_of(lower(value), ',');
            const auto                     place   = [&](const char *letter) {
              const auto at = std::find(columns.begin(), columns.end(), letter);
              if (at == columns.end())
                refuse_profile(file, line.number,
                                                     "'ColumnDef' is " + shown(value) + ", which has no column " + letter);
              return static_cast<std::size_t>(at - columns.begin());
            };
            column_y = place("x"); // its X is lateral, its Y vertical
            column_z = place("y");
          }
        else if (name == "xoffset" || name == "yoffset" || name == "xypoints")
          {
            const auto number = number_of_any(value);
            if (!number || !(std::abs(*number) < 1e6))
              refuse_profile(file, line.number,
                             shown(name) + " is " + shown(value) + ", which is no such number");
            if (name == "xypoints")
              n_points = *number > 0. ? static_cast<std::size_t>(*number) : 0;
            else
              (name == "xoffset" ? offset_y : offset_z) = *number;
          }
      }
    };

    Points read_miniprof(const std::string &file, const std::vector<std::string> &lines, const ProfileBody)
    {
      return MiniProf(file, lines).read();
    }

    /// Simpack: points between point.begin and point.end; names before them change all points, in the order
    /// in which its files number these steps: point.dist.min, shift, rotate, bound, mirror, units.
    class Simpack
    {
    public:
      Simpack(const std::string &file, const ProfileBody body)
        : file(file)
        , body(body)
      {
      }

      Points read(const std::vector<std::string> &text)
      {
        std::vector<NumberedLine> rows;
        bool                      in_points = false, ended = false, in_header = false;
        for (const NumberedLine &line : numbered(text))
          {
            const std::string content = without_quoted_comment(line.text), words = lower(content);
            const auto        has = [&](const char *name) {
              return words.find(name) != words.npos;
            };
            const std::size_t equals = content.find('=');
            if (has("point.begin"))
              {
                if (in_points || ended)
                  refuse_profile(file, line.number, "a second 'point.begin': a file has one profile");
                in_points = true;
              }
            else if (has("point.end"))
              {
                ended     = in_points;
                in_points = false;
              }
            else if (in_points)
              {
                if (!is_blank(content))
                  rows.push_back({line.number, content});
              }
            else if (has("header.begin") || has("header.end"))
              in_header = has("header.begin");
            else if (equals != content.npos)
              set(line.number, in_header, lower(without_blanks(content.substr(0, equals))),
                  without_blanks(content.substr(equals + 1)));
          }
        if (!ended)
          refuse_profile(file, 0, "has no points between 'point.begin' and 'point.end'");
        return placed(points_of(file, rows, false));
      }

    private:
      const std::string             file;
      const ProfileBody             body;
      std::map<std::string, double> values;
      std::string                   unit_name;

      static std::string without_quoted_comment(const std::string &text)
      {
        char quote = 0;
        for (std::size_t i = 0; i < text.size(); ++i)
          if (quote)
            quote = text[i] == quote ? 0 : quote;
          else if (text[i] == '\'' || text[i] == '"')
            quote = text[i];
          else if (text[i] == '!' || text[i] == '#' || text[i] == '%')
            return text.substr(0, i);
        return text;
      }

      double value(const std::string &name, const double otherwise = 0.) const
      {
        const auto at = values.find(name);
        return at == values.end() ? otherwise : at->second;
      }

      void set(const unsigned int line,
               const bool         in_header,
               const std::string &name,
               const std::string &text)
      {
        if (in_header)
          {
            const auto type = number_of_any(text);
            if (name == "type" && type && body != ProfileBody::along_rail &&
                *type != (body == ProfileBody::wheel ? 1. : 0.))
              refuse_profile(file, line,
                             "its header has 'type' " + shown(text) +
                               ", where 0 is a rail and 1 a wheel; a " +
                               (body == ProfileBody::wheel ? "wheel" : "rail") + " is needed");
            return;
          }
        const char *numbers[]  = {"point.dist.min", "shift.y",      "shift.z",     "rotate",
                                  "bound.y.min",    "bound.y.max",  "bound.z.min", "bound.z.max",
                                  "mirror.y",       "mirror.z",     "inversion",   "units.len.f",
                                  "units.ang.f",    "approx.smooth"};
        const char *harmless[] = {"file", "file.mtime", "comment", "type", "version", "units.ang"};
        if (name == "units.len")
          {
            unit_name = text;
            unit_name.erase(std::remove_if(unit_name.begin(), unit_name.end(),
                                           [](const char c) { return c == '\'' || c == '"'; }),
                            unit_name.end());
          }
        else if (std::find(std::begin(numbers), std::end(numbers), name) != std::end(numbers))
          {
            const auto number = number_of_any(text.substr(0, text.find_first_of(" \t")));
            if (!number || !std::isfinite(*number))
              refuse_profile(file, line, shown(name) + " is " + shown(text) + ", which is no number");
            if (name == "approx.smooth" && *number != 0.)
              refuse_profile(file, line,
                             "'approx.smooth' " + shown(text) +
                               " is not available: make it 0, and smooth by 'Smoothing length (mm)'");
            if (name.compare(0, 6, "units.") == 0 && !(*number > 0.))
              refuse_profile(file, line, "'" + name + "' must be above 0");
            values[name] = *number;
          }
        else if (std::find(std::begin(harmless), std::end(harmless), name) == std::end(harmless))
          refuse_profile(file, line, shown(name) + " is not known, and might change the points: take it out");
      }

      double per_metre() const
      {
        if (values.count("units.len.f") || unit_name.empty())
          return value("units.len.f", 1e3);
        const std::map<std::string, double> units{{"m", 1.},
                                                  {"cm", 1e2},
                                                  {"mm", 1e3},
                                                  {"in", 1. / 0.0254},
                                                  {"inch", 1. / 0.0254}};
        const auto                          at = units.find(lower(unit_name));
        if (at == units.end())
          refuse_profile(file, 0, "'units.len' is " + shown(unit_name) + " without a number 'units.len.f'");
        return at->second;
      }

      Points placed(const Points &all) const
      {
        Points       points;
        const double nearest = value("point.dist.min"), angle = value("rotate") / value("units.ang.f", 1.),
                     c = std::cos(angle), s = std::sin(angle);
        for (const ProfilePoint &p : all)
          if (points.empty() || !(std::hypot(p.y - points.back().y, p.z - points.back().z) < nearest))
            points.push_back(p);
        for (ProfilePoint &p : points)
          {
            const double y = p.y + value("shift.y"), z = p.z + value("shift.z");
            p.y = c * y - s * z;
            p.z = s * y + c * z;
          }
        // A least value above the largest is no bound.
        const auto is_beyond = [&](const std::string &name, const double coordinate) {
          const double least = value(name + ".min", 1.), most = value(name + ".max", 0.);
          return least < most && (coordinate < least || coordinate > most);
        };
        points.erase(std::remove_if(points.begin(), points.end(),
                                    [&](const ProfilePoint &p) {
                                      return is_beyond("bound.y", p.y) || is_beyond("bound.z", p.z);
                                    }),
                     points.end());
        if (points.empty() && !all.empty())
          refuse_profile(file, 0, "no point lies within its 'bound.y' and 'bound.z'");
        const double along = value("mirror.y") != 0. ? -1. : 1., up = value("mirror.z") != 0. ? -1. : 1.;
        for (ProfilePoint &p : points)
          {
            p.y *= along / per_metre();
            p.z *= up / per_metre();
          }
        return points;
      }
    };

    Points read_simpack(const std::string              &file,
                        const std::vector<std::string> &lines,
                        const ProfileBody               body)
    {
      return Simpack(file, body).read(lines);
    }

    /// How files are read whose names have these endings. A new format is a function and its line here.
    struct Format
    {
      std::vector<std::string> endings;
      Points (*read)(const std::string &file, const std::vector<std::string> &lines, const ProfileBody body);
    };
    const std::vector<Format> formats{{{"prr", "prw"}, read_simpack}, {{"ban", "whl"}, read_miniprof}};

    /// Files of other programs that are known but not read.
    const std::vector<std::pair<std::string, std::string>> not_available{
      {"mpt", "is a container of MiniProf with several measurements: export each one as .ban or .whl"},
      {"slcs",
       "lists the slices of a rail whose profile varies along the track, which is not available: name one "
       "of its profiles"},
      {"slcw",
       "lists the slices of a wheel that is not round, which is not available: name one of its profiles"},
      {"kpfr",
       "has contact functions of GENSYS and no points; the profiles it was made from (.rail, .wheel) are "
       "read"},
      {"xls", "is a spreadsheet: export its table as text"},
      {"xlsx", "is a spreadsheet: export its table as text"},
      {"ods", "is a spreadsheet: export its table as text"}};
  } // namespace


  std::vector<ProfilePoint> read_profile_points(const std::string &file, const ProfileBody body)
  {
    const std::string kind  = ending(file);
    const auto        lines = [&] {
      try
        {
          return read_lines(file);
        }
      catch (const TextError &error)
        {
          refuse_profile(file, 0, error.what());
        }
    }();
    for (const auto &[name, why] : not_available)
      if (kind == name)
        refuse_profile(file, 0, why);
    const auto   format = std::find_if(formats.begin(), formats.end(), [&](const Format &f) {
      return std::find(f.endings.begin(), f.endings.end(), kind) != f.endings.end();
    });
    const Points points =
      format != formats.end() ? format->read(file, lines, body) : read_table(file, lines, body);
    constexpr double furthest = 1e4; // m
    for (const ProfilePoint &p : points)
      if (!(std::abs(p.y) <= furthest && std::abs(p.z) <= furthest))
        refuse_profile(file, p.line, "a place further away than " + text_in_mm(furthest) + " mm");
    if (points.size() < 4)
      refuse_profile(file, 0,
                     "has " + std::to_string(points.size()) + (points.size() == 1 ? " point" : " points") +
                       "; at least four are needed");
    return points;
  }
} // namespace tread
