// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/input_error.h>
#include <tread/base/quiet_boost.h>
#include <tread/geometry/profile_names.h>
#include <tread/scene/parameter_file.h>

#include <boost/property_tree/json_parser.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <regex>
#include <sstream>

namespace tread
{
  namespace
  {
    /// The beginning and the end of a text that is longer than what a user may be told of a value.
    std::string shortened(const std::string &text)
    {
      constexpr std::size_t longest = 1000, kept_end = 700;
      return text.size() <= longest
               ? text
               : text.substr(0, longest - kept_end) + " ... " + text.substr(text.size() - kept_end);
    }

    std::size_t edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 1; i <= a.size(); ++i)
        {
          std::size_t diagonal = row[0]++;
          for (std::size_t j = 1; j <= b.size(); ++j)
            {
              const std::size_t above = row[j];
              row[j]                  = std::min(
                                 {row[j - 1] + 1, above + 1, diagonal + (std::tolower(a[i - 1]) != std::tolower(b[j - 1]))});
              diagonal = above;
            }
        }
      return row.back();
    }

    /// A text with deal.II's patterns in it, for people: "[Selection a|b ]" is "a or b", "[Integer range
    /// 1...6 (inclusive)]" is "1 to 6".
    std::string readable(std::string text)
    {
      std::smatch match;
      while (std::regex_search(text, match, std::regex(R"(\[Selection ([^\]]*?) ?\])")))
        text = match.prefix().str() + std::regex_replace(match[1].str(), std::regex(R"(\|)"), " or ") +
               match.suffix().str();
      text = std::regex_replace(
        text, std::regex(R"(\[List of <(\[[^\]]*\])> of length \d+\.\.\.(\d+) \(inclusive\)\])"),
        "up to $2 numbers from $1, separated by commas");
      text = std::regex_replace(
        text, std::regex(R"(\[(Double|Integer range) (\S*?)\.\.\.(\S*) \(inclusive\)\])"), "$2 to $3");
      text = std::regex_replace(text, std::regex(R"(\[Bool\])"), "true or false");
      text =
        std::regex_replace(text, std::regex("(a number from )?-MAX_DOUBLE to MAX_DOUBLE"), "a finite number");
      text = std::regex_replace(text, std::regex("-MAX_DOUBLE to "), "at most ");
      return std::regex_replace(text, std::regex(" to MAX_(DOUBLE|INT)"), " or more");
    }

    /// As the files of a run must be, of which titles and names of files become part.
    bool is_utf8(const std::string &text)
    {
      try
        {
          nlohmann::json(text).dump();
          return true;
        }
      catch (const nlohmann::json::type_error &)
        {
          return false;
        }
    }

    /// A line of a parameter file without its comment; several where a backslash at the end joins them.
    struct Line
    {
      std::string  text;   ///< without blanks at both ends
      unsigned int number; ///< of the first of them
    };

    /// With single ones between words.
    std::string without_blanks(const std::string &text)
    {
      std::istringstream words(text);
      std::string        word, line;
      while (words >> word)
        line += (line.empty() ? "" : " ") + word;
      return line;
    }

    /// Where in a parameter file, for the beginning of a message.
    std::string place(const std::string &file, const unsigned int line)
    {
      return "'" + shortened(file) + "', line " + std::to_string(line) + ": ";
    }

    /// The lines that say something. Ends of lines are those of any system; a byte order mark says nothing.
    std::vector<Line> lines_of(const std::string &file, std::string text)
    {
      require(text.compare(0, 2, "\xff\xfe") != 0 && text.compare(0, 2, "\xfe\xff") != 0 &&
                text.find('\0') == text.npos,
              "'" + file +
                "' is no text in UTF-8 (it may be UTF-16, or no text at all); save the file in that "
                "encoding");
      if (text.compare(0, 3, "\xef\xbb\xbf") == 0)
        text.erase(0, 3);
      std::string unified;
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] != '\r')
          unified += text[i];
        else if (i + 1 == text.size() || text[i + 1] != '\n')
          unified += '\n';
      std::vector<Line>  lines;
      std::istringstream input(unified);
      Line               joined{"", 0};
      unsigned int       number = 0;
      for (std::string line; std::getline(input, line);)
        {
          ++number;
          require(is_utf8(line.substr(0, line.find('#'))),
                  place(file, number) + "its characters are not UTF-8; save the file in that encoding");
          std::replace(line.begin(), line.end(), '\t', ' ');
          line = dealii::Utilities::trim(line);
          if (joined.number == 0)
            joined.number = number;
          const bool goes_on = !line.empty() && line.back() == '\\';
          joined.text += goes_on ? line.substr(0, line.size() - 1) : line;
          if (goes_on && input.peek() != std::istringstream::traits_type::eof())
            continue;
          joined.text = dealii::Utilities::trim(joined.text.substr(0, joined.text.find('#')));
          if (!joined.text.empty())
            lines.push_back(joined);
          joined = {"", 0};
        }
      return lines;
    }

    /// The rest of a line that begins with this word, in small letters or capitals; nothing if it does not.
    std::optional<std::string> behind(const std::string &word, const std::string &line)
    {
      const std::string first = line.substr(0, line.find(' '));
      if (first.size() != word.size() ||
          !std::equal(word.begin(), word.end(), first.begin(),
                      [](const char a, const unsigned char b) { return a == std::tolower(b); }))
        return {};
      return dealii::Utilities::trim(line.substr(word.size()));
    }

    struct Entry
    {
      std::string path, section, name, value, normal, pattern;
    };

    /// All declared entries, by walking the handler's own description.
    void list_entries(const boost::property_tree::ptree &tree,
                      const std::string                 &section,
                      std::vector<Entry>                &entries)
    {
      for (const auto &[mangled, child] : tree)
        {
          std::string name;
          for (std::size_t i = 0; i < mangled.size(); ++i) // deal.II writes special characters as _hex
            if (mangled[i] == '_' && i + 2 < mangled.size())
              {
                name += static_cast<char>(std::stoi(mangled.substr(i + 1, 2), nullptr, 16));
                i += 2;
              }
            else
              name += mangled[i];
          if (child.get_optional<std::string>("value"))
            entries.push_back({section.empty() ? name : section + "/" + name, section, name,
                               child.get<std::string>("value"), child.get<std::string>("default_value", ""),
                               child.get<std::string>("pattern_description", "")});
          else if (!child.empty())
            list_entries(child, section.empty() ? name : section + "/" + name, entries);
        }
    }

    std::vector<Entry> all_entries(const dealii::ParameterHandler &handler)
    {
      std::ostringstream json;
      handler.print_parameters(json, dealii::ParameterHandler::JSON |
                                       dealii::ParameterHandler::KeepDeclarationOrder);
      boost::property_tree::ptree tree;
      std::istringstream          in(json.str());
      boost::property_tree::read_json(in, tree);
      std::vector<Entry> entries;
      list_entries(tree, "", entries);
      return entries;
    }

    std::string did_you_mean(const std::vector<Entry> &entries, const std::string &path)
    {
      const auto name_of = [](const std::string &p) {
        return p.substr(p.rfind('/', p.find('(')) + 1); // a unit may have one, too
      };
      const auto without_unit = [](const std::string &p) {
        return p.substr(0, p.find(" ("));
      };
      std::string best;
      std::size_t least = std::numeric_limits<std::size_t>::max();
      for (const Entry &entry : entries)
        {
          // The right name in another section is the likeliest slip.
          const std::size_t distance = std::min(
            {edit_distance(path, entry.path), edit_distance(without_unit(path), without_unit(entry.path)) + 1,
             edit_distance(name_of(path), entry.name) + 1});
          if (distance < least)
            {
              least = distance;
              best  = entry.path;
            }
        }
      return "did you mean '" + best + "'? (tread parameters lists all)";
    }

    std::string nearest_section(const std::vector<Entry> &entries, const std::string &name)
    {
      return std::min_element(entries.begin(), entries.end(),
                              [&](const Entry &a, const Entry &b) {
                                return edit_distance(name, a.section) < edit_distance(name, b.section);
                              })
        ->section;
    }

    /// What else to say about a value that is none of the allowed ones.
    std::string advice(const Entry &entry, const std::string &value)
    {
      const std::string text = entry.path == "Rail/Profile" ? advice_on_rail(value) : "";
      return text.empty() ? "" : ". " + text;
    }

    void set_entry(dealii::ParameterHandler &handler,
                   const Entry              &entry,
                   const std::string        &value,
                   const std::string        &place)
    {
      handler.enter_subsection(entry.section);
      try
        {
          handler.set(entry.name, value);
        }
      catch (const dealii::ExceptionBase &)
        {
          handler.leave_subsection();
          throw InputError(place + "'" + entry.path + "' cannot be '" + shortened(value) +
                           "'; allowed: " + readable(entry.pattern) + advice(entry, value));
        }
      handler.leave_subsection();
    }

    /// Entries of studies, which have no section around them.
    bool is_of_study(const std::string &name)
    {
      const std::vector<std::string> entries{"Scene",       "Settings",  "Combination", "Figures",
                                             "Smooth twin", "Directory", "Processes",   "Ranks",
                                             "Limit",       "Mesh"};
      return std::find(entries.begin(), entries.end(), name) != entries.end();
    }

    /// A subsection that has begun.
    struct Open
    {
      std::string  name;
      unsigned int line; ///< 0: none
    };

    /// @throws InputError about a line that is none of a parameter file. @param open the subsection around it
    [[noreturn]] void refuse_line(const std::string        &file,
                                  const Line               &line,
                                  const Open               &open,
                                  const std::vector<Entry> &entries)
    {
      const std::string where  = place(file, line.number);
      const std::size_t equals = line.text.find('=');
      if (equals != line.text.npos)
        {
          const std::string name = without_blanks(line.text.substr(0, equals)),
                            path = (open.line > 0 ? open.name + "/" : "") + name;
          const bool known =
            std::any_of(entries.begin(), entries.end(), [&](const Entry &e) { return e.path == path; });
          throw InputError(
            where + "'" + shortened(line.text) + "' must begin with 'set'" +
            (known ? ""
                   : "; no parameter '" + shortened(path) + "', " + did_you_mean(entries, shortened(path))));
        }
      for (const Entry &entry : entries)
        if (entry.section == line.text)
          throw InputError(where + "'" + line.text + "' must begin with 'subsection'");
      throw InputError(
        where + "cannot read '" + shortened(line.text) +
        "'; a line is 'subsection NAME', 'set NAME = VALUE', 'end', 'include FILE', or begins with #");
    }
  } // namespace


  void ParameterFile::parse(const std::string &file, const unsigned int depth)
  {
    constexpr unsigned int deepest = 10;
    if (depth > deepest)
      throw InputError("parameter file '" + file + "' is included by itself");
    std::error_code cannot_tell; // of a name that no file can have
    if (std::filesystem::is_directory(file, cannot_tell))
      throw InputError("parameter file '" + file + "' is a folder");
    std::ifstream input(file, std::ios::binary);
    if (!input)
      throw InputError("cannot read parameter file '" + shortened(file) + "'" +
                       (depth > 0 ? ", which another one includes" : ""));
    const std::string text{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
    read_files.push_back(file_read(FileRead::scene, file));
    const std::vector<Line> lines = lines_of(file, text);
    // Files that it includes come first, so that its own lines have the last word.
    for (const Line &line : lines)
      if (const auto name = behind("include", line.text))
        {
          require(!name->empty(), place(file, line.number) + "'include' names no file");
          parse((std::filesystem::path(file).parent_path() / *name).string(), depth + 1);
        }
    const std::vector<Entry> entries = all_entries(handler);
    const std::string of_study       = "'" + file + "' is a study, no scene: contrib/study.py makes its runs";
    Open              open{"", 0};
    std::map<std::string, unsigned int>
      lines_of_parameters; // that this file sets; it may set again what one that it includes does
    for (const Line &line : lines)
      {
        const std::string where = place(file, line.number);
        if (behind("include", line.text))
          continue;
        if (const auto rest = behind("subsection", line.text))
          {
            const std::string section = without_blanks(*rest);
            require(!(open.line == 0 && section == "Vary"), of_study);
            require(open.line == 0, where + "'subsection " + shortened(section) +
                                      "' stands within 'subsection " + open.name + "' of line " +
                                      std::to_string(open.line) + ", which has no 'end'");
            if (std::none_of(entries.begin(), entries.end(),
                             [&](const Entry &e) { return e.section == section; }))
              throw InputError(where + "no section '" + shortened(section) + "'; did you mean '" +
                               nearest_section(entries, shortened(section)) + "'?");
            open = {section, line.number};
          }
        else if (const auto more = behind("end", line.text); more && more->empty())
          {
            require(open.line > 0, where + "'end' without a 'subsection' before it");
            open = {"", 0};
          }
        else if (const auto setting = behind("set", line.text))
          {
            const std::size_t equals = setting->find('=');
            const std::string name   = without_blanks(setting->substr(0, equals));
            require(!(open.line == 0 && is_of_study(name)), of_study);
            const std::string path = (open.line > 0 ? open.name + "/" : "") + name;
            const auto        entry =
              std::find_if(entries.begin(), entries.end(), [&](const Entry &e) { return e.path == path; });
            if (entry == entries.end())
              throw InputError(where + "no parameter '" + shortened(path) + "'; " +
                               did_you_mean(entries, shortened(path)));
            require(open.line > 0, where + "'" + path +
                                     "' stands outside of its section: write 'subsection " + entry->section +
                                     "', 'set " + entry->name + " = ...' and 'end'");
            require(equals != setting->npos, where + "'" + path + "' has no value: '=' is missing");
            const auto [first, is_first] = lines_of_parameters.emplace(path, line.number);
            require(is_first, where + "'" + path + "' is set in line " + std::to_string(first->second) +
                                " already: leave one of the two lines out");
            sets_something = true;
            set_entry(handler, *entry, dealii::Utilities::trim(setting->substr(equals + 1)), where);
          }
        else
          refuse_line(file, line, open, entries);
      }
    require(open.line == 0, place(file, open.line) + "'subsection " + open.name + "' has no 'end'");
  }


  void ParameterFile::read(const std::string &file, const std::vector<std::string> &settings)
  {
    if (!file.empty())
      parse(file);
    require(file.empty() || sets_something || !settings.empty(),
            "'" + shortened(file) +
              "' sets no parameter: it is empty, or has comments alone; scenes to start from are in prm/, "
              "and tread parameters writes all parameters with their defaults");
    for (const std::string &setting : settings)
      set(setting);
    folder = std::filesystem::path(file).parent_path();
  }


  std::string ParameterFile::located(const std::string &file) const
  {
    std::error_code cannot_tell; // of a name that no file can have
    return !std::filesystem::exists(file, cannot_tell) && std::filesystem::exists(folder / file, cannot_tell)
             ? (folder / file).string()
             : file;
  }


  void ParameterFile::note(const std::string &parameter, const std::string &path)
  {
    read_files.push_back(file_read(parameter, path));
  }


  namespace
  {
    std::string strip(std::string text)
    {
      text.erase(0, text.find_first_not_of(" \t"));
      text.erase(text.find_last_not_of(" \t") + 1);
      return text;
    }
  } // namespace


  void ParameterFile::refuse_repeated(const std::vector<std::string> &settings)
  {
    std::map<std::string, std::string> values;
    for (const std::string &setting : settings)
      if (const std::size_t equals = setting.find('='); equals != setting.npos)
        {
          const std::string value      = strip(setting.substr(equals + 1));
          const auto [first, is_first] = values.emplace(strip(setting.substr(0, equals)), value);
          require(is_first, "-s sets '" + shortened(first->first) + "' twice, to '" +
                              shortened(first->second) + "' and to '" + shortened(value) + "': give it once");
        }
  }


  void ParameterFile::set(const std::string &setting)
  {
    require(is_utf8(setting), "a setting of -s is not UTF-8 text");
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos)
      throw InputError("-s \"" + shortened(setting) + "\": expected Section/Name=value");
    const std::string path = strip(setting.substr(0, equals)), value = strip(setting.substr(equals + 1));
    const std::vector<Entry> entries = all_entries(handler);
    for (const Entry &entry : entries)
      if (entry.path == path)
        return set_entry(handler, entry, value, "");
    const std::string unknown = shortened(path);
    if (std::any_of(entries.begin(), entries.end(), [&](const Entry &e) { return e.path == value; }))
      throw InputError("-s \"" + shortened(setting) + "\": the parameter comes first, as in \"" + value +
                       "=" + unknown + "\"");
    char *end;
    std::strtod(path.c_str(), &end);
    if (*end == 0)
      throw InputError("-s \"" + shortened(setting) + "\": '" + unknown +
                       "' is no parameter; expected Section/Name=value");
    throw InputError("no parameter '" + unknown + "'; " + did_you_mean(entries, unknown));
  }


  std::vector<ParameterFile::Parameter> ParameterFile::changed_values() const
  {
    const auto same = [](const std::string &a, const std::string &b) {
      char        *end_a, *end_b;
      const double number_a = std::strtod(a.c_str(), &end_a), number_b = std::strtod(b.c_str(), &end_b);
      return a == b || (!a.empty() && !b.empty() && *end_a == 0 && *end_b == 0 && number_a == number_b);
    };
    std::vector<Parameter> changed;
    for (const Entry &entry : all_entries(handler))
      if (!same(entry.value, entry.normal))
        changed.push_back({entry.path, entry.value});
    return changed;
  }


  std::vector<ParameterFile::Parameter> ParameterFile::values() const
  {
    std::vector<Parameter> parameters;
    for (const Entry &entry : all_entries(handler))
      parameters.push_back({entry.path, entry.value});
    return parameters;
  }


  void ParameterFile::print(std::ostream &out, const bool with_documentation) const
  {
    handler.print_parameters(
      out, (with_documentation ? dealii::ParameterHandler::PRM : dealii::ParameterHandler::ShortPRM) |
             dealii::ParameterHandler::KeepDeclarationOrder);
  }


  std::string ParameterFile::of_run() const
  {
    std::ostringstream text;
    print(text, true);
    const std::string files = as_comments(read_files);
    return text.str() +
           (files.empty() ? "" : "\n\n# Files that the run has read, with CRC-32 of their bytes:\n" + files);
  }


  void ParameterFile::print_json(std::ostream &out) const
  {
    handler.print_parameters(out,
                             dealii::ParameterHandler::JSON | dealii::ParameterHandler::KeepDeclarationOrder);
  }
} // namespace tread
