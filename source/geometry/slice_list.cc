// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/base/text_file.h>
#include <tread/geometry/profile_file.h>
#include <tread/geometry/slice_list.h>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace tread
{
  namespace
  {
    /// The lines of a list with something on them, without remarks.
    class Lines
    {
    public:
      explicit Lines(const std::string &file)
        : file(file)
      {
        try
          {
            unsigned int number = 0;
            for (const std::string &line : read_lines(file))
              {
                ++number;
                const std::string text = line.substr(0, line.find_first_of("%!#"));
                if (text.find_first_not_of(" \t\r") != text.npos)
                  lines.push_back({number, text});
              }
          }
        catch (const TextError &error)
          {
            throw InputError("cannot read '" + file + "': " + error.what());
          }
      }

      [[noreturn]] void fail(const std::string &what) const
      {
        throw InputError("'" + file + "'" + (next > 0 ? ", line " + std::to_string(number()) : "") + ": " +
                         what);
      }

      unsigned int number() const
      {
        return lines[std::min(next, lines.size()) - 1].number;
      }

      const std::string &take(const std::string &what)
      {
        if (next >= lines.size())
          {
            next = lines.size();
            fail("the list ends before " + what);
          }
        return lines[next++].text;
      }

      bool has_more() const
      {
        return next < lines.size();
      }

      /// So many numbers from the beginning of the next line; words may follow.
      std::vector<double> numbers(const std::size_t n, const std::string &what)
      {
        std::istringstream  stream(take(what));
        std::vector<double> values;
        for (std::string word; values.size() < n && stream >> word;)
          {
            const std::optional<double> value = number_in(word);
            if (!value || !std::isfinite(*value))
              fail("'" + word.substr(0, 40) + "' is no number; expected: " + what);
            values.push_back(*value);
          }
        if (values.size() < n)
          fail(std::to_string(values.size()) + " numbers where " + std::to_string(n) +
               " are needed: " + what);
        return values;
      }

      unsigned int count(const double value, const std::string &name) const
      {
        constexpr double most = 1e5;
        if (!(value >= 0. && value <= most && value == std::floor(value)))
          fail(name + " is " + text_of(value) + ", which is no number of things");
        return static_cast<unsigned int>(value);
      }

    private:
      std::string               file;
      std::vector<NumberedLine> lines;
      std::size_t               next = 0;
    };

    std::vector<std::pair<double, double>> points_of(const std::string &file)
    {
      try
        {
          std::vector<std::pair<double, double>> points;
          for (const ProfilePoint &p : read_profile_points(file, ProfileBody::rail))
            points.emplace_back(p.y, p.z);
          return points;
        }
      catch (const std::runtime_error &error)
        {
          throw InputError(error.what());
        }
    }

    /// The list without the points of its slices.
    SliceList read_list(const std::string &file)
    {
      Lines        lines(file);
      SliceList    list;
      const auto   scale  = lines.numbers(2, "offset and scale of the positions");
      const double factor = scale[1];
      if (!(factor > 0.))
        lines.fail("the scale of the positions is " + text_of(factor) + "; it must be above 0");
      const unsigned int n          = lines.count(lines.numbers(1, "the number of slices NSLC")[0], "NSLC");
      const auto         counts     = lines.numbers(3, "NFEAT, NKINK, NACCEL");
      const unsigned int n_features = lines.count(counts[0], "NFEAT");
      if (counts[1] != 0. || counts[2] != 0.)
        lines.fail("kinks and accelerations (NKINK, NACCEL) are not available; they must be 0");
      if (n_features == 1)
        lines.fail("NFEAT is 1; parts need at least two features, 0 means that no slice is cut");
      const double method = lines.numbers(1, "the method, 1 or 2")[0];
      if (method != 1. && method != 2.)
        lines.fail("the method is " + text_of(method) + "; it must be 1 or 2");
      list.approximates   = method == 2.;
      list.line_of_method = lines.number();

      for (unsigned int i = 0; i < n; ++i)
        {
          const std::string  text = lines.take("slice " + std::to_string(i + 1) + " of " + std::to_string(n));
          std::istringstream stream(text);
          std::string        word;
          stream >> word;
          const std::optional<double> at = number_in(word);
          if (!at || !std::isfinite(*at))
            lines.fail("'" + word.substr(0, 40) + "' is no position of a slice");
          const std::size_t begin = text.find_first_of("'\"");
          const std::size_t end   = begin == text.npos ? text.npos : text.find(text[begin], begin + 1);
          if (end == text.npos || end == begin + 1)
            lines.fail("the name of the slice's file must stand in quotes behind its position");
          const std::string name  = text.substr(begin + 1, end - begin - 1);
          const double      along = factor * (scale[0] + *at);
          if (!list.entries.empty() && !(along > list.entries.back().along))
            lines.fail("slices must follow each other; " + text_of(along) + " comes after " +
                       text_of(list.entries.back().along));
          list.entries.push_back({along, name, {}, {}});
        }
      for (unsigned int i = 0; n_features > 0 && i < n; ++i)
        {
          const auto row = lines.numbers(n_features + 1, "position and NFEAT features of a slice");
          if (const double along = factor * (scale[0] + row[0]);
              std::abs(along - list.entries[i].along) > 1e-6 * factor)
            lines.fail("features of a slice at " + text_of(along) + ", where that at " +
                       text_of(list.entries[i].along) + " comes next");
          list.entries[i].features.assign(row.begin() + 1, row.end());
        }
      if (lines.has_more())
        {
          lines.take("");
          lines.fail("more lines than the list of " + std::to_string(n) + " slices has");
        }
      return list;
    }
  } // namespace


  SliceList read_slice_list(const std::string &file)
  {
    SliceList                   list   = read_list(file);
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    for (SliceList::Entry &entry : list.entries)
      entry.points = points_of((folder / entry.file).string());
    return list;
  }


  std::vector<std::string> slices_named_in(const std::string &file)
  {
    std::vector<std::string> names;
    if (file.ends_with(".slcs") || file.ends_with(".slcw"))
      try
        {
          for (const SliceList::Entry &entry : read_list(file).entries)
            names.push_back(entry.file);
        }
      catch (const InputError &)
        {
          // Whoever reads the slices says so.
        }
    return names;
  }
} // namespace tread
