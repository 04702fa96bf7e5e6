// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/archive.h>
#include <tread/base/file_text.h>
#include <tread/base/format.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/scene.h>
#include <tread/simulation/checkpoint.h>
#include <tread/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

namespace tread
{
  namespace
  {
    /// To be counted up when the order or the meaning of what is stored changes. The archive knows the size
    /// of each value by itself.
    constexpr const char *layout = "tread-checkpoint-35";

    /// A text with its size before it.
    std::string with_size(const std::string &text)
    {
      const std::uint64_t size = text.size();
      return std::string(reinterpret_cast<const char *>(&size), sizeof size) + text;
    }

    /// What stands at a place of `content` with its size before it; the place moves behind it. @throws
    /// InputError saying that it is damaged
    std::string take_sized(const std::string &content, std::size_t &place, const std::string &damaged)
    {
      std::uint64_t size = 0;
      require(content.size() - place >= sizeof size, damaged);
      std::memcpy(&size, content.data() + place, sizeof size);
      place += sizeof size;
      require(content.size() - place >= size, damaged);
      place += size;
      return content.substr(place - size, size);
    }

    const std::string rolled_distance = "Motion/Rolled distance (mm)";
  } // namespace


  Checkpoint::Checkpoint(RunFolder &folder, const Scene &scene, const MPI_Comm comm)
    : folder(folder)
    , scene(scene)
    , comm(comm)
  {
  }


  std::vector<ParameterFile::Setting> Checkpoint::settings_that_stay() const
  {
    const std::vector<std::string> of_output{"Output/Supports", "Output/Cells", "Output/Pictures",
                                             "Output/Strip half width (mm)"},
      of_the_end{"Output", "Ratcheting", "Profile wear", "Watchdogs"};
    const auto is_among = [](const std::string &name, const std::vector<std::string> &names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    std::vector<ParameterFile::Setting> settings;
    for (const ParameterFile::Setting &setting : scene.parameters().values())
      if (is_among(setting.path, of_output) ||
          (!is_among(setting.path.substr(0, setting.path.find('/')), of_the_end) &&
           // It may grow up to the longest one, which stays.
           !(setting.path == rolled_distance && scene.motion.longest_distance > 0.)))
        settings.push_back(setting);
    return settings;
  }


  Checkpoint::Values Checkpoint::parameters() const
  {
    Values values;
    for (const ParameterFile::Setting &setting : settings_that_stay())
      values[setting.path] = setting.value;
    for (const FileRead &file : scene.parameters().files_read())
      if (!file.is_scene())
        values["contents of '" + file.parameter + "', checksum"] = std::to_string(file.crc32);
    return values;
  }


  void Checkpoint::write(Simulation &simulation)
  {
    std::string bytes;
    {
      Archive archive(comm);
      simulation.serialize(archive);
      bytes = archive.stored();
    }
    const std::string name   = "checkpoint-" + std::to_string(next_slot),
                      window = format("%u %.17g", simulation.window.number, simulation.window.tread);
    // What fails on rank 0 is thrown on all.
    const auto together = [this](const auto &work) {
      std::string problem;
      try
        {
          work();
        }
      catch (const std::exception &error)
        {
          problem = error.what();
        }
      problem = dealii::Utilities::MPI::broadcast(comm, problem, 0);
      if (!problem.empty())
        throw std::runtime_error(problem);
    };
    std::string texts;
    together([&]() {
      if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
        texts =
          with_size(nlohmann::json(parameters()).dump()) + with_size(folder.progress()) + with_size(window);
    });
    together([&]() {
      folder.write_of_all(name, layout, texts, bytes);
      folder.write("checkpoint.last", name + "\n");
    });
    next_slot = 1 - next_slot;
  }


  std::string Checkpoint::content_of(const std::string &name) const
  {
    // Rank 0 reads, and all find the same.
    const std::string path = folder.path(name);
    std::string       found_layout, content;
    bool              is_whole = false;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        content                        = text_of_file(path);
        const std::size_t  end_of_line = content.find('\n');
        std::istringstream head(content.substr(0, end_of_line));
        std::size_t        size = 0;
        unsigned int       sum  = 0;
        head >> found_layout >> size >> sum;
        content.erase(0, end_of_line < content.size() ? end_of_line + 1 : content.size());
        is_whole = size == content.size() && sum == checksum(content);
      }
    found_layout = dealii::Utilities::MPI::broadcast(comm, found_layout, 0);
    if (found_layout.empty())
      throw InputError("--resume: cannot read '" + path + "'");
    if (found_layout != layout)
      throw InputError("--resume: '" + path + "' was not written by this version of tread");
    if (!dealii::Utilities::MPI::broadcast(comm, is_whole, 0))
      throw InputError("--resume: '" + path + "' is damaged");
    return dealii::Utilities::MPI::broadcast(comm, content, 0);
  }


  void Checkpoint::require_same_parameters(const std::string &of_checkpoint) const
  {
    const Values now = parameters();
    Values       before;
    try
      {
        before = nlohmann::json::parse(of_checkpoint).get<Values>();
      }
    catch (const nlohmann::json::exception &)
      {
        throw InputError(damaged());
      }
    Values all = before;
    all.insert(now.begin(), now.end());
    const auto value = [](const Values &values, const std::string &name) -> std::optional<std::string> {
      const auto found = values.find(name);
      return found == values.end() ? std::nullopt : std::optional(found->second);
    };
    const auto in_words = [](const std::optional<std::string> &text) {
      return !text ? "none" : text->empty() ? "empty" : *text;
    };
    for (const auto &[name, text] : all)
      {
        const auto old_value = value(before, name), new_value = value(now, name);
        require(old_value && new_value && ParameterTable::same_value(*old_value, *new_value),
                "--resume: the checkpoint was made with other parameters: '" + name + "' " +
                  in_words(old_value) + ", now " + in_words(new_value) +
                  (name == rolled_distance ? "; a run can be made longer if it began with a 'Motion/Longest "
                                             "distance (mm)', for which its rail is meshed"
                                           : ""));
      }
  }


  std::vector<ParameterFile::Setting> Checkpoint::parameters_of_run() const
  {
    try
      {
        const auto settings = Scene::parameters_in(folder.path("parameters.prm"));
        for (const ParameterFile::Setting &setting : settings)
          require(setting.is_given, "it has no '" + setting.path + "'");
        return settings;
      }
    catch (const InputError &error)
      {
        throw InputError(
          "--resume: the run in '" + folder.path("") +
          "' is complete, but its 'parameters.prm' is damaged or of another version: " + error.what());
      }
  }


  void Checkpoint::require_parameters_of_run() const
  {
    const auto check = [this]() {
      std::map<std::string, std::string> before;
      for (const ParameterFile::Setting &setting : parameters_of_run())
        before[setting.path] = setting.value;
      std::vector<ParameterFile::Setting> now;
      for (const ParameterFile::Setting &setting : settings_that_stay())
        if (!setting.path.starts_with("Output/")) // which a complete run is not asked to change
          now.push_back(setting);
      for (const ParameterFile::Setting &setting : scene.parameters().values())
        if (setting.path == rolled_distance) // not among those of a run that may go on
          now.push_back(setting);
      const std::string run  = "--resume: the run in '" + folder.path("") + "' ",
                        anew = "; without --resume it starts anew";
      for (const ParameterFile::Setting &setting : now)
        require(ParameterTable::same_value(before.at(setting.path), ParameterFile::as_read(setting.value)),
                run + "is complete, and was made with '" + setting.path + "' " + before.at(setting.path) +
                  ", now " + setting.value + anew);
      const FilesCompared files = compare_files(
        files_in_comments(text_of_file(folder.path("parameters.prm"))), scene.parameters().files_read());
      require(files.unlike.empty(),
              run + "is complete, and was made with other contents: " + files.unlike + anew);
      require(files.unknown.empty(),
              run + "is complete, but its 'parameters.prm' does not say what the file of '" + files.unknown +
                "' contained" + anew);
    };
    std::string problem;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          check();
        }
      catch (const InputError &error)
        {
          problem = error.what();
        }
    problem = dealii::Utilities::MPI::broadcast(comm, problem, 0);
    require(problem.empty(), problem);
  }


  bool Checkpoint::run_may_go_on() const
  {
    bool is_longer = false;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0 && scene.motion.longest_distance > 0.)
      try
        {
          constexpr double tiny = 1e-9; // m
          for (const ParameterFile::Setting &setting : parameters_of_run())
            if (setting.path == rolled_distance)
              is_longer =
                1e-3 * std::strtod(setting.value.c_str(), nullptr) + tiny < scene.motion.rolled_distance;
        }
      catch (const InputError &)
        {
          // require_parameters_of_run() says what is wrong.
        }
    return dealii::Utilities::MPI::broadcast(comm, is_longer, 0);
  }


  Checkpoint::Content Checkpoint::last_content()
  {
    std::string name;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      std::istringstream(text_of_file(folder.path("checkpoint.last"))) >> name;
    name = dealii::Utilities::MPI::broadcast(comm, name, 0);
    if (name.empty())
      throw InputError("--resume: no checkpoint in '" + folder.path("") + "'");
    require(name == "checkpoint-0" || name == "checkpoint-1",
            "--resume: '" + folder.path("checkpoint.last") + "' is damaged");
    last      = name;
    next_slot = name.back() == '0' ? 1 : 0;

    std::string content = content_of(name);
    std::size_t place   = 0;
    Content     parts;
    for (std::string Content::*text : {&Content::parameters, &Content::progress, &Content::window})
      parts.*text = take_sized(content, place, damaged());
    parts.state = std::move(content.erase(0, place));
    return parts;
  }


  WindowPlace Checkpoint::window()
  {
    const Content      content = last_content();
    WindowPlace        window;
    std::istringstream text(content.window);
    require_same_parameters(content.parameters);
    text >> window.number >> window.tread;
    require(bool(text) && window.number < windows(scene).size(), damaged());
    return window;
  }


  void Checkpoint::read(Simulation &simulation)
  {
    const Content content = last_content();
    try
      {
        folder.continue_from(content.progress);
        Archive archive(comm, content.state);
        simulation.serialize(archive);
        if (!archive.found_all())
          throw InputError("--resume: '" + folder.path(last) + "' belongs to another mesh");
      }
    catch (const nlohmann::json::exception &)
      {
        throw InputError(damaged());
      }
    catch (const OtherStoredLayout &)
      {
        throw InputError("--resume: '" + folder.path(last) + "' was not written by this version of tread");
      }
  }


  std::string Checkpoint::damaged() const
  {
    return "--resume: '" + folder.path(last) + "' is damaged";
  }
} // namespace tread
