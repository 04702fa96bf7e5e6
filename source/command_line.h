// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_command_line_h
#define tread_command_line_h

#include <tread/tools/contact_points_files.h>
#include <tread/tools/dynamic_force_files.h>
#include <tread/tools/modes_files.h>
#include <tread/tools/sleeper_stress_files.h>

#include <optional>
#include <string>
#include <vector>

namespace tread
{
  /// What the program can be asked for.
  enum class Command
  {
    run,
    reference,
    modes,
    contact_points,
    wear,
    batch,
    positions,
    dynamic_force,
    sleeper_stress,
    parameters,
    columns
  };

  /// A command with all that stands behind it.
  struct CommandLine
  {
    Command                  command = Command::run;
    std::string              scene; ///< file; empty: none
    std::vector<std::string> settings;
    std::string              table;  ///< of wear, batch and positions
    std::string              output; ///< folder or file; empty: that of the scene or of the table
    DynamicForceRequest      dynamic;
    ModesRequest             modes;
    SleeperStressRequest     sleeper;
    ContactPointsRequest     points;
    bool                     json      = false; ///< parameters
    bool                     schema    = false; ///< likewise
    bool                     overwrite = false, resume = false, dry_run = false, quiet = false;
  };

  /// @param speaks whether this process prints help and version
  /// @returns what the user asked for; nothing if it was help or the version, which is then printed.
  /// @throws InputError
  std::optional<CommandLine> parse_command_line(const int argc, char **argv, const bool speaks);
} // namespace tread

#endif
