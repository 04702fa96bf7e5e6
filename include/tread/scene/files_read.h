// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_files_read_h
#define tread_scene_files_read_h

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace tread
{
  /// A file that a run has read, with what tells its content from another one.
  struct FileRead
  {
    std::string   parameter; ///< Section/Name that names it, or FileRead::scene
    std::string   path;
    std::uint64_t bytes = 0;
    std::uint32_t crc32 = 0;

    /// Instead of a parameter: the parameter file itself, or one that it includes.
    static constexpr const char *scene = "parameter file";

    bool is_scene() const
    {
      return parameter == scene;
    }
    bool same_content(const FileRead &other) const
    {
      return bytes == other.bytes && crc32 == other.crc32;
    }
    /// "1234 bytes with the checksum 567"
    std::string in_words() const
    {
      return std::to_string(bytes) + " bytes with the checksum " + std::to_string(crc32);
    }
  };

  /// What a file contains now; no bytes if it cannot be read.
  FileRead file_read(const std::string &parameter, const std::string &path);

  /// As key "files" of summary.json has them.
  nlohmann::ordered_json as_json(const std::vector<FileRead> &files);

  /// Comment lines that a parameter file may end with.
  std::string as_comments(const std::vector<FileRead> &files);

  /// What these comment lines of a run's parameters.prm say, of files that parameters name.
  /// @param text of the parameter file
  std::vector<FileRead> files_in_comments(const std::string &text);

  /// What keeps a new run out of a folder unless it may overwrite: a complete run of another scene, as its
  /// summary.json and parameters.prm say. @param scene path of the new run's parameter file; @param title of
  /// its scene. @returns a line; empty: nothing
  std::string held_by_other_scene(const std::string &folder,
                                  const std::string &scene,
                                  const std::string &title);

  /// In what a run's files differ from those of another one, in words; empty: in nothing that both know.
  /// @param but beginnings of parameters whose files may be unlike
  struct FilesCompared
  {
    std::string unlike; ///< "'Rail/Measured head' ..."; empty: none
    std::string
      unknown; ///< a parameter that has a file on one side alone, whose content is not known on the other
  };
  FilesCompared compare_files(const std::vector<FileRead>    &before,
                              const std::vector<FileRead>    &now,
                              const std::vector<std::string> &but = {});
} // namespace tread

#endif
