// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/input_error.h>
#include <tread/geometry/profile_names.h>
#include <tread/scene/parameter_file.h>

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
          joined.text = ParameterFile::as_read(joined.text);
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

    std::string without_unit(const std::string &path)
    {
      return path.substr(0, path.find(" ("));
    }

    std::string did_you_mean(const std::vector<Parameter> &parameters, const std::string &path)
    {
      const std::string name = path.substr(path.rfind('/', path.find('(')) + 1); // a unit may have one, too
      std::string       best;
      std::size_t       least = std::numeric_limits<std::size_t>::max();
      for (const Parameter &parameter : parameters)
        {
          // The right name in another section is the likeliest slip.
          const std::size_t distance =
            std::min({edit_distance(path, parameter.path()),
                      edit_distance(without_unit(path), without_unit(parameter.path())) + 1,
                      edit_distance(name, parameter.name) + 1});
          if (distance < least)
            {
              least = distance;
              best  = parameter.path();
            }
        }
      return "did you mean '" + best + "'? (tread parameters lists all)";
    }

    std::string nearest_section(const std::vector<Parameter> &parameters, const std::string &name)
    {
      return std::min_element(parameters.begin(), parameters.end(),
                              [&](const Parameter &a, const Parameter &b) {
                                return edit_distance(name, a.section) < edit_distance(name, b.section);
                              })
        ->section;
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
    [[noreturn]] void refuse_line(const std::string    &file,
                                  const Line           &line,
                                  const Open           &open,
                                  const ParameterTable &table)
    {
      const std::string where  = place(file, line.number);
      const std::size_t equals = line.text.find('=');
      if (equals != line.text.npos)
        {
          const std::string name = without_blanks(line.text.substr(0, equals)),
                            path = (open.line > 0 ? open.name + "/" : "") + name;
          throw InputError(where + "'" + shortened(line.text) + "' must begin with 'set'" +
                           (table.find(path) ? ""
                                             : "; no parameter '" + shortened(path) + "', " +
                                                 did_you_mean(table.parameters(), shortened(path))));
        }
      for (const Parameter &parameter : table.parameters())
        if (parameter.section == line.text)
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
    const std::vector<Parameter> &parameters = declared.parameters();
    const std::string of_study = "'" + file + "' is a study, no scene: contrib/study.py makes its runs";
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
            if (std::none_of(parameters.begin(), parameters.end(),
                             [&](const Parameter &parameter) { return parameter.section == section; }))
              throw InputError(where + "no section '" + shortened(section) + "'; did you mean '" +
                               nearest_section(parameters, shortened(section)) + "'?");
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
            const std::string      path      = (open.line > 0 ? open.name + "/" : "") + name;
            const Parameter *const parameter = declared.find(path);
            if (!parameter)
              throw InputError(where + "no parameter '" + shortened(path) + "'; " +
                               did_you_mean(parameters, shortened(path)));
            require(open.line > 0, where + "'" + path +
                                     "' stands outside of its section: write 'subsection " +
                                     parameter->section + "', 'set " + parameter->name + " = ...' and 'end'");
            require(equals != setting->npos, where + "'" + path + "' has no value: '=' is missing");
            const auto [first, is_first] = lines_of_parameters.emplace(path, line.number);
            require(is_first, where + "'" + path + "' is set in line " + std::to_string(first->second) +
                                " already: leave one of the two lines out");
            give(*parameter, dealii::Utilities::trim(setting->substr(equals + 1)), where);
          }
        else
          refuse_line(file, line, open, declared);
      }
    require(open.line == 0, place(file, open.line) + "'subsection " + open.name + "' has no 'end'");
  }


  void ParameterFile::read(const std::string &file, const std::vector<std::string> &settings)
  {
    if (!file.empty())
      parse(file);
    require(file.empty() || !given.empty() || !settings.empty(),
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
    if (const Parameter *const parameter = declared.find(path))
      return give(*parameter, value, "");
    const std::string unknown = shortened(path);
    if (declared.find(value))
      throw InputError("-s \"" + shortened(setting) + "\": the parameter comes first, as in \"" + value +
                       "=" + unknown + "\"");
    char *end;
    std::strtod(path.c_str(), &end);
    if (*end == 0)
      throw InputError("-s \"" + shortened(setting) + "\": '" + unknown +
                       "' is no parameter; expected Section/Name=value");
    throw InputError("no parameter '" + unknown + "'; " + did_you_mean(declared.parameters(), unknown));
  }


  void ParameterFile::give(const Parameter &parameter, const std::string &value, const std::string &where)
  {
    // What else to say about a value that is none of the allowed ones.
    const std::string advice = parameter.path() == "Rail/Profile" ? advice_on_rail(value) : "";
    require(declared.set(parameter, value),
            where + "'" + parameter.path() + "' cannot be '" + shortened(value) +
              "'; allowed: " + parameter.allowed->in_words() + (advice.empty() ? "" : ". " + advice));
    given.insert(parameter.path());
  }


  std::string ParameterFile::as_read(std::string value)
  {
    std::replace(value.begin(), value.end(), '\t', ' ');
    return dealii::Utilities::trim(value.substr(0, value.find('#')));
  }


  ParameterFile::Setting ParameterFile::setting_of(const Parameter &parameter) const
  {
    return {parameter.path(), declared.value(parameter), given.count(parameter.path()) > 0};
  }


  std::vector<ParameterFile::Setting> ParameterFile::changed_values() const
  {
    std::vector<Setting> changed;
    for (const Parameter &parameter : declared.parameters())
      if (declared.is_changed(parameter))
        changed.push_back(setting_of(parameter));
    return changed;
  }


  std::vector<ParameterFile::Setting> ParameterFile::values() const
  {
    std::vector<Setting> values;
    for (const Parameter &parameter : declared.parameters())
      values.push_back(setting_of(parameter));
    return values;
  }


  void ParameterFile::print(std::ostream &out, const bool with_documentation) const
  {
    declared.handler().print_parameters(
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
    declared.handler().print_parameters(out, dealii::ParameterHandler::JSON |
                                               dealii::ParameterHandler::KeepDeclarationOrder);
  }


  void ParameterFile::print_schema(std::ostream &out) const
  {
    using Json        = nlohmann::ordered_json;
    const auto object = [](Json &&properties) {
      return Json{{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
    };
    Json sections = Json::object();
    for (const Parameter &parameter : declared.parameters())
      {
        Json schema{{"description", parameter.documentation()}};
        schema.update(parameter.allowed->schema());
        schema["default"]                           = parameter.allowed->value(parameter.normal);
        sections[parameter.section][parameter.name] = std::move(schema);
      }
    for (auto &[name, parameters] : sections.items())
      parameters = object(std::move(parameters));
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", "Parameters of tread"}};
    schema.update(object(std::move(sections)));
    out << schema.dump(1) << std::endl;
  }
} // namespace tread
