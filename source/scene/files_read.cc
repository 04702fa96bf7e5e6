// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/file_text.h>
#include <tread/scene/files_read.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace tread
{
  namespace
  {
    /// How the comment lines begin.
    const std::string mark = "# file read: ";
  } // namespace


  FileRead file_read(const std::string &parameter, const std::string &path)
  {
    const std::string content = text_of_file(path);
    return {parameter, path, content.size(), checksum(content)};
  }


  nlohmann::ordered_json as_json(const std::vector<FileRead> &files)
  {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const FileRead &file : files)
      list.push_back(
        {{"parameter", file.parameter}, {"path", file.path}, {"bytes", file.bytes}, {"crc32", file.crc32}});
    return list;
  }


  std::string as_comments(const std::vector<FileRead> &files)
  {
    std::string lines;
    for (const nlohmann::ordered_json &file : as_json(files))
      lines += mark + file.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
    return lines;
  }


  std::vector<FileRead> files_in_comments(const std::string &text)
  {
    std::vector<FileRead> files;
    std::istringstream    lines(text);
    for (std::string line; std::getline(lines, line);)
      if (line.compare(0, mark.size(), mark) == 0)
        try
          {
            const auto json = nlohmann::json::parse(line.substr(mark.size()));
            FileRead   file;
            json.at("parameter").get_to(file.parameter);
            json.at("path").get_to(file.path);
            json.at("bytes").get_to(file.bytes);
            json.at("crc32").get_to(file.crc32);
            if (!file.is_scene())
              files.push_back(file);
          }
        catch (const nlohmann::json::exception &)
          {
            // A line that is cut off says nothing.
          }
    return files;
  }


  std::string held_by_other_scene(const std::string &folder,
                                  const std::string &scene,
                                  const std::string &title)
  {
    const auto summary = nlohmann::json::parse(text_of_file(folder + "/summary.json"), nullptr, false);
    if (!summary.is_object() || summary.value("completed", nlohmann::json()) != true)
      return "";
    const auto file_name = [](const std::string &path) {
      return std::filesystem::path(path).filename().string();
    };
    std::string other;
    if (const auto files = summary.find("files"); files != summary.end() && files->is_array())
      for (const nlohmann::json &file : *files)
        if (file.is_object() && file.value("parameter", nlohmann::json()) == FileRead::scene &&
            file.value("path", nlohmann::json()).is_string())
          {
            other = file.at("path").get<std::string>();
            break;
          }
    const nlohmann::json other_title = summary.value("title", nlohmann::json(""));
    const bool is_other = other.empty() ? other_title != title : file_name(other) != file_name(scene);
    if (!is_other)
      return "";
    return "'" + folder + "' holds the finished run of another scene, " +
           (other.empty() ? other_title.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                          : "'" + other + "'") +
           ": give another folder by --output, or --overwrite to replace it";
  }


  FilesCompared compare_files(const std::vector<FileRead>    &before,
                              const std::vector<FileRead>    &now,
                              const std::vector<std::string> &but)
  {
    const auto counts = [&](const FileRead &file) {
      return !file.is_scene() && std::none_of(but.begin(), but.end(), [&](const std::string &begin) {
        return file.parameter.starts_with(begin);
      });
    };
    const auto find = [](const std::vector<FileRead> &files, const std::string &parameter) {
      return std::find_if(files.begin(), files.end(),
                          [&](const FileRead &file) { return file.parameter == parameter; });
    };
    FilesCompared found;
    for (const FileRead &file : now)
      if (counts(file))
        {
          const auto other = find(before, file.parameter);
          if (other == before.end())
            found.unknown = file.parameter;
          else if (!file.same_content(*other) && found.unlike.empty())
            found.unlike = "the file of '" + file.parameter + "', '" + file.path + "', has " +
                           file.in_words() + ", '" + other->path + "' had " + other->in_words();
        }
    for (const FileRead &file : before)
      if (counts(file) && find(now, file.parameter) == now.end())
        found.unknown = file.parameter;
    return found;
  }
} // namespace tread
