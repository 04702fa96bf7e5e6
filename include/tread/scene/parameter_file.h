// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_parameter_file_h
#define tread_scene_parameter_file_h

#include <tread/base/parameter_table.h>
#include <tread/scene/files_read.h>

#include <filesystem>
#include <iosfwd>
#include <set>
#include <string>
#include <vector>

namespace tread
{
  /// Parameters that sections declare, read from a file and settings, with what a user is told of a wrong
  /// one, and written again.
  class ParameterFile
  {
  public:
    /// Parameters that sections declare, of which laws and indices of damage take their own.
    ParameterTable &table() const
    {
      return declared;
    }

    /// Read a file (none: all defaults) with those that its lines "include NAME" name, relative to its
    /// folder, then "Section/Name=value" settings in their order. @throws InputError
    void read(const std::string &file, const std::vector<std::string> &settings);

    /// @throws InputError where one parameter is given twice, of which one value would be lost.
    static void refuse_repeated(const std::vector<std::string> &settings);

    struct Setting
    {
      std::string path, value;      ///< Section/Name
      bool        is_given = false; ///< by a file or -s
    };
    /// All, in the order of declaration.
    std::vector<Setting> values() const;
    /// Those that are not what they are without being set.
    std::vector<Setting> changed_values() const;
    /// What is read of a value that stands in a parameter file, where # begins a comment; -s takes all of it.
    static std::string as_read(std::string value);

    /// All parameters with their values, units, ranges, meaning and needs, as a parameter file.
    void print(std::ostream &out, const bool with_documentation) const;
    /// The same as deal.II's JSON: of each the value, the default, the documentation and the pattern.
    void print_json(std::ostream &out) const;
    /// A JSON schema (draft 2020-12) of all of them, of a scene as {"Section": {"Name": value}}.
    void print_schema(std::ostream &out) const;
    /// parameters.prm of a run: all parameters, and the files that it has read.
    std::string of_run() const;

    /// Files that were read, parameter files first, with their contents as they were then.
    const std::vector<FileRead> &files_read() const
    {
      return read_files;
    }
    /// Note a file that a parameter names.
    void note(const std::string &parameter, const std::string &path);
    /// Path of a file named by a parameter: as given, or relative to the folder of the parameter file.
    std::string located(const std::string &file) const;

  private:
    /// Read the files that it includes, then its own lines, which therefore have the last word.
    /// @param depth of files that include each other. @throws InputError
    void parse(const std::string &file, const unsigned int depth = 0);
    void set(const std::string &setting);
    /// Give a parameter a value. @param where it stands, for the beginning of a message @throws InputError
    void    give(const Parameter &parameter, const std::string &value, const std::string &where);
    Setting setting_of(const Parameter &parameter) const;

    mutable ParameterTable declared;
    std::filesystem::path  folder; ///< of the parameter file
    std::vector<FileRead>  read_files;
    std::set<std::string>  given; ///< paths of parameters that a file or a setting sets
  };
} // namespace tread

#endif
