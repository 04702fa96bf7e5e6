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
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <utility>

namespace tread
{
  namespace
  {
    /// To be counted up when the order or the meaning of what is stored changes. The archive knows the size
    /// of each value by itself.
    constexpr const char *layout = "tread-checkpoint-34";

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

    /// Values by Section/Name, all but those of the output.
    std::map<std::string, std::string> settings_in(std::istream &&text)
    {
      std::map<std::string, std::string> settings;
      std::string                        section;
      for (std::string line; std::getline(text, line);)
        {
          line                     = dealii::Utilities::trim(line.substr(0, line.find('#')));
          const std::size_t equals = line.find('=');
          if (line.compare(0, 11, "subsection ") == 0)
            section = line.substr(11);
          else if (line.compare(0, 4, "set ") == 0 && equals != line.npos && section != "Output")
            settings[section + "/" + dealii::Utilities::trim(line.substr(4, equals - 4))] =
              dealii::Utilities::trim(line.substr(equals + 1));
        }
      return settings;
    }
  } // namespace


  Checkpoint::Checkpoint(RunFolder &folder, const Scene &scene, const MPI_Comm comm)
    : folder(folder)
    , scene(scene)
    , comm(comm)
  {
  }


  std::string Checkpoint::parameters() const
  {
    std::ostringstream text;
    scene.parameters().print(text, false);
    const std::string all = text.str();
    // At the beginning of a line: a value may have the same words.
    const auto section = [&all](const std::string &name) {
      const std::size_t begin = all.find("\nsubsection " + name + "\n");
      return std::make_pair(begin, all.substr(begin, all.find("\nend\n", begin) - begin));
    };
    std::string supports;
    for (const int number : scene.output.supports)
      supports += (supports.empty() ? "" : ",") + std::to_string(number);
    std::string contents;
    for (const FileRead &file : scene.parameters().files_read())
      if (!file.is_scene())
        contents +=
          "contents of '" + file.parameter + "' with the checksum " + std::to_string(file.crc32) + "\n";
    std::string before_output = all.substr(0, section("Output").first);
    // It may grow up to the longest one, which stays.
    if (scene.motion.longest_distance > 0.)
      before_output =
        std::regex_replace(before_output, std::regex("\n *set Rolled distance \\(mm\\) [^\n]*"), "");
    return before_output + section("Peak stress").second + "\nset Supports = " + supports +
           "\nset Cells = " + scene.output.cells + "\nset Pictures = " + name_of(scene.output.pictures) +
           "\nset Strip half width (mm) = " + std::to_string(1e3 * scene.output.strip_half_width) + "\n" +
           contents;
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
        texts = with_size(parameters()) + with_size(folder.progress()) + with_size(window);
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
    const std::string own = parameters();
    if (of_checkpoint == own)
      return;
    std::istringstream old_lines(of_checkpoint), new_lines(own);
    std::string        old_line, new_line;
    while (std::getline(old_lines, old_line) && std::getline(new_lines, new_line) && old_line == new_line)
      ;
    const auto trimmed = [](const std::string &line) {
      return line.substr(std::min(line.size(), line.find_first_not_of(' ')));
    };
    const bool of_distance = trimmed(new_line).rfind("set Rolled distance", 0) == 0;
    throw InputError("--resume: the checkpoint was made with other parameters: '" + trimmed(old_line) +
                     "', now '" + trimmed(new_line) + "'" +
                     (of_distance ? "; a run can be made longer if it began with a 'Motion/Longest distance "
                                    "(mm)', for which its rail is meshed"
                                  : ""));
  }


  void Checkpoint::require_parameters_of_run() const
  {
    std::string problem;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        std::stringstream all;
        scene.parameters().print(all, false);
        const std::string distance = "Motion/Rolled distance (mm)"; // not among those of a run that may go on
        const auto of_run = settings_in(std::istringstream(text_of_file(folder.path("parameters.prm"))));
        auto       now    = settings_in(std::istringstream(parameters()));
        const auto whole  = settings_in(std::move(all));
        now[distance]     = whole.at(distance);
        for (const auto &[name, value] : whole)
          if (of_run.find(name) == of_run.end())
            problem =
              "--resume: the run in '" + folder.path("") +
              "' is complete, but its 'parameters.prm' is damaged or of another version: it has no '" + name +
              "'";
        for (const auto &[name, value] : now)
          if (const auto before = of_run.find(name); before != of_run.end() && before->second != value)
            problem = "--resume: the run in '" + folder.path("") + "' is complete, and was made with '" +
                      name + "' " + before->second + ", now " + value + "; without --resume it starts anew";
        if (problem.empty())
          {
            const FilesCompared files =
              compare_files(files_in_comments(text_of_file(folder.path("parameters.prm"))),
                            scene.parameters().files_read());
            if (!files.unlike.empty())
              problem = "--resume: the run in '" + folder.path("") +
                        "' is complete, and was made with other contents: " + files.unlike +
                        "; without --resume it starts anew";
            else if (!files.unknown.empty())
              problem = "--resume: the run in '" + folder.path("") +
                        "' is complete, but its 'parameters.prm' does not say what the file of '" +
                        files.unknown + "' contained; without --resume it starts anew";
          }
      }
    problem = dealii::Utilities::MPI::broadcast(comm, problem, 0);
    if (!problem.empty())
      throw InputError(problem);
  }


  bool Checkpoint::run_may_go_on() const
  {
    bool is_longer = false;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0 && scene.motion.longest_distance > 0.)
      {
        const auto   of_run = settings_in(std::istringstream(text_of_file(folder.path("parameters.prm"))));
        const auto   rolled = of_run.find("Motion/Rolled distance (mm)");
        const double tiny   = 1e-9; // m
        is_longer           = rolled != of_run.end() &&
                    1e-3 * std::strtod(rolled->second.c_str(), nullptr) + tiny < scene.motion.rolled_distance;
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
