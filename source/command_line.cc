// SPDX-License-Identifier: LGPL-2.1-or-later
#include "command_line.h"

#include <tread/base/input_error.h>
#include <tread/base/version.h>
#include <tread/scene/scene.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

namespace tread
{
  namespace
  {
    /// Group of options that the help does not list, but whose names errors know.
    constexpr const char *older_forms = "Older forms";

    struct Help : CLI::Formatter
    {
      std::string make_group(std::string                      group,
                             bool                             is_positional,
                             std::vector<const CLI::Option *> options) const override
      {
        return group == older_forms ? std::string()
                                    : CLI::Formatter::make_group(group, is_positional, options);
      }
    };

    /// A variable of a shell that is not set would become the default.
    std::string is_given(const std::string &word)
    {
      return word.empty() ? "it is empty" : "";
    }

    /// Options of more than one command.
    CLI::Option *add_output(CLI::App &app, CommandLine &line, const std::string &what)
    {
      return app.add_option("--output", line.output, what)->check(is_given);
    }

    void add_settings(CLI::App &app, CommandLine &line)
    {
      app
        .add_option("-s", line.settings,
                    "\"Section/Name=value\": set a parameter; may be repeated, each time for another one")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }

    void add_quiet(CLI::App &app, CommandLine &line)
    {
      app.add_flag("--quiet", line.quiet, "print errors only; summary.json has the warnings");
    }

    void add_overwrite(CLI::App &app, CommandLine &line)
    {
      app.add_flag("--overwrite", line.overwrite,
                   "replace the results of another scene's finished run in the folder");
    }

    CLI::Option *add_resume(CLI::App &app, CommandLine &line)
    {
      return app.add_flag("--resume", line.resume,
                          "go on from the last checkpoint in the folder of the results");
    }

    CLI::Option *add_dry_run(CLI::App &app, CommandLine &line)
    {
      return app.add_flag("--dry-run", line.dry_run, "print size and cost of the run; run and write nothing");
    }

    CLI::Option *add_up_to(CLI::App &app, CommandLine &line)
    {
      return app.add_option("--up-to", line.modes.up_to, "highest frequency of the modes, Hz (2000)");
    }

    std::vector<CLI::Option *> add_points(CLI::App &app, CommandLine &line)
    {
      const std::vector<CLI::Option *> options{
        app.add_option("--shift-to", line.points.to_mm, "largest lateral shift, mm (10)"),
        app.add_option("--shift-step", line.points.step_mm, "between lateral shifts, mm (0.25)"),
        app
          .add_option("--other-side", line.points.other_side,
                      "scene whose wheel and rail stand on the other side of the track (the same, mirrored)")
          ->check(is_given)};
      for (CLI::Option *option : options)
        option->each([&line](const std::string &) { line.points.is_over_shift = true; });
      return options;
    }

    CLI::Option *add_smooth_twin(CLI::App &app, CommandLine &line)
    {
      return app.add_option("--smooth-twin", line.dynamic.smooth_twin,
                            "folder of the run without the defect");
    }

    std::vector<CLI::Option *> add_spectra(CLI::App &app, CommandLine &line)
    {
      return {app.add_option("--window", line.dynamic.window, "of the spectra: rectangular or Hann"),
              app.add_option("--from", line.dynamic.from_mm, "first position that counts, mm"),
              app.add_option("--to", line.dynamic.to_mm, "last position that counts, mm")};
    }

    std::vector<CLI::Option *> add_sleeper(CLI::App &app, CommandLine &line)
    {
      return {
        app.add_option("--support", line.sleeper.support,
                       "its number; without it, that with the largest force"),
        app.add_option("--bottom", line.sleeper.bottom, "of the sleeper: fixed or ballast"),
        app.add_option("--cell-size", line.sleeper.cell_size_mm, "largest edge of the sleeper's cells, mm")};
    }

    /// Each command is an application of its own below `app`.
    void add_commands(CLI::App &app, CommandLine &line)
    {
      const auto command = [&](const Command which, const std::string &name, const std::string &does) {
        CLI::App *own = app.add_subcommand(name, does)->group("Commands");
        own->callback([&line, which]() { line.command = which; });
        return own;
      };
      const auto of_scene = [&](const Command which, const std::string &name, const std::string &does) {
        CLI::App *own = command(which, name, does);
        own->add_option("SCENE.prm", line.scene, "parameter file")->required();
        add_settings(*own, line);
        add_output(*own, line, "folder of the results");
        add_overwrite(*own, line);
        add_quiet(*own, line);
        return own;
      };
      CLI::App *run =
        of_scene(Command::run, "run", "roll a scene's wheels over its rail; the same as without a command");
      add_resume(*run, line)->excludes(add_dry_run(*run, line));
      of_scene(Command::reference, "reference", "the half-space answer of a scene, in a second");
      add_up_to(*of_scene(Command::modes, "modes", "eigenmodes and receptances of a scene's wheel and track"),
                line);
      add_points(*of_scene(Command::contact_points, "contact-points",
                           "where a rigid wheelset touches its rails over the lateral shift, or a wheel on "
                           "slices over the way"),
                 line);
      CLI::App *wear = of_scene(
        Command::wear, "wear",
        "wear of a wheelset's profiles by a table of contacts, passage after passage, by half-space theory");
      wear->add_option("CONTACTS.csv", line.table, "table of contacts")->required();
      add_resume(*wear, line)->excludes(add_dry_run(*wear, line));

      const auto of_table = [&](const Command which, const std::string &name, const std::string &does) {
        CLI::App *own = command(which, name, does);
        own->add_option("TABLE.csv", line.table, "table")->required();
        add_output(*own, line, "table of the answers")->required();
        add_quiet(*own, line);
      };
      of_table(Command::batch, "batch", "a table of half-space cases, on all cores");
      of_table(Command::positions, "positions",
               "half-space contact in each position of a table, of a wheel over a rail of slices such as a "
               "crossing");

      const auto of_run = [&](const Command which, const std::string &name, const std::string &does,
                              std::string &folder) {
        CLI::App *own = command(which, name, does);
        own->add_option("RUN", folder, "folder of a run")->required();
        add_output(*own, line, "folder of the results, instead of that of the run");
        add_quiet(*own, line);
        return own;
      };
      CLI::App *dynamic = of_run(Command::dynamic_force, "dynamic-force",
                                 "what a defect adds to the forces of a run, with spectra", line.dynamic.run);
      add_smooth_twin(*dynamic, line)->required();
      add_spectra(*dynamic, line);
      add_sleeper(*of_run(Command::sleeper_stress, "sleeper-stress",
                          "static stress of a sleeper at the largest force in its pad, after a run",
                          line.sleeper.run),
                  line);

      CLI::App *parameters =
        command(Command::parameters, "parameters", "all parameters with units, ranges and meaning");
      parameters->add_option("SCENE.prm", line.scene, "parameter file whose values they have");
      add_settings(*parameters, line);
      CLI::Option *const json = parameters->add_flag("--json", line.json, "as JSON");
      parameters->add_flag("--schema", line.schema, "as JSON schema: what each of them may be")
        ->excludes(json);
      command(Command::columns, "columns",
              "columns of all tables and keys of summary.json with units and meaning, as JSON");
      app.require_subcommand(0, 1);
    }


    /// Forms of the commands before they were commands.
    struct OlderForms
    {
      OlderForms(CLI::App &app, CommandLine &line)
        : line(line)
      {
        app.add_option("SCENE.prm", line.scene, "parameter file");
        add_settings(app, line);
        add_output(app, line, "folder of the results");
        add_quiet(app, line);
        add_overwrite(app, line);
        add_resume(app, line);
        add_dry_run(app, line);
        const std::vector<const CLI::Option *> of_run = const_cast<const CLI::App &>(app).get_options();

        app.add_flag("--reference-only", reference, "");
        CLI::Option *modes_flag  = app.add_flag("--modes", modes, "");
        CLI::Option *points_flag = app.add_flag("--contact-points", points, "");
        add_up_to(app, line)->needs(modes_flag);
        for (CLI::Option *option : add_points(app, line))
          option->needs(points_flag);
        app.add_flag("--print-parameters{prm}", print_parameters, "");
        CLI::Option *columns_flag = app.add_flag("--print-columns", columns, "");
        CLI::Option *defect       = app.add_option("--dynamic-force", line.dynamic.run, ""),
                    *smooth       = add_smooth_twin(app, line);
        defect->needs(smooth);
        smooth->needs(defect);
        for (CLI::Option *option : add_spectra(app, line))
          option->needs(defect);
        CLI::Option *seat = app.add_option("--sleeper-stress", line.sleeper.run, "");
        for (CLI::Option *option : add_sleeper(app, line))
          option->needs(seat);
        CLI::Option *wear_table  = app.add_option("--wear", wear, ""),
                    *batch_table = app.add_option("--batch", batch, ""),
                    *place_table = app.add_option("--positions", positions, "");
        const std::array<CLI::Option *, 6> one_of{
          {columns_flag, defect, seat, wear_table, batch_table, place_table}};
        for (std::size_t i = 0; i < one_of.size(); ++i)
          for (std::size_t j = i + 1; j < one_of.size(); ++j)
            one_of[i]->excludes(one_of[j]);
        for (CLI::Option *option : app.get_options())
          if (std::find(of_run.begin(), of_run.end(), option) == of_run.end())
            option->group(older_forms);
      }

      /// The command that they mean. @throws InputError where two are meant
      void resolve()
      {
        require(
          line.resume + line.dry_run + reference + modes + points <= 1,
          "of --resume, --dry-run, --reference-only, --modes and --contact-points only one is possible");
        require(wear.empty() || !(reference || modes || points),
                "--wear excludes --reference-only, --modes and --contact-points");
        if (!print_parameters.empty() && print_parameters != "prm" && print_parameters != "json")
          throw InputError("--print-parameters cannot be '" + print_parameters + "'; allowed: prm, json");
        const bool asks_of_scene = !line.settings.empty() || !print_parameters.empty() || line.resume ||
                                   reference || modes || points || line.dry_run || line.overwrite;
        struct Tool
        {
          Command     command;
          std::string name, reads;
          bool        is_asked;
        };
        for (const Tool &tool :
             {Tool{Command::batch, "--batch", "a table of cases", !batch.empty()},
              Tool{Command::positions, "--positions", "a table of positions", !positions.empty()},
              Tool{Command::dynamic_force, "--dynamic-force", "what two runs left",
                   !line.dynamic.run.empty()},
              Tool{Command::sleeper_stress, "--sleeper-stress", "what a run left", !line.sleeper.run.empty()},
              Tool{Command::columns, "--print-columns", "nothing", columns}})
          if (tool.is_asked)
            {
              require(line.scene.empty(), tool.name + " reads " + tool.reads + "; it takes no scene");
              require(!asks_of_scene,
                      tool.name + " reads " + tool.reads +
                        "; -s, --print-parameters, --resume, --overwrite, --reference-only, --modes, "
                        "--contact-points and --dry-run are for a scene");
              line.command = tool.command;
              line.table   = batch + positions;
            }
        if (!print_parameters.empty())
          {
            line.command = Command::parameters;
            line.json    = print_parameters == "json";
          }
        else if (!wear.empty())
          {
            line.command = Command::wear;
            line.table   = wear;
          }
        else if (reference)
          line.command = Command::reference;
        else if (modes)
          line.command = Command::modes;
        else if (points)
          line.command = Command::contact_points;
        const bool needs_scene =
          line.command <= Command::wear; // what follows reads tables, folders or nothing
        if (needs_scene && line.scene.empty())
          throw InputError("no scene given; tread --help shows how, prm/ holds scenes to start from");
      }

      CommandLine &line;
      bool         reference = false, modes = false, points = false, columns = false;
      std::string  print_parameters; ///< how; empty: not
      std::string  wear, batch, positions;
    };

    /// Words before a command belong to none. @throws InputError
    void refuse_before_command(const CLI::App &app)
    {
      const std::vector<const CLI::App *> commands =
        app.get_subcommands([](const CLI::App *command) { return command->parsed(); });
      if (commands.empty())
        return;
      const std::string name = commands.front()->get_name();
      for (const CLI::Option *option : app.get_options())
        if (option->count() > 0 && option->get_positional())
          throw InputError("'" + option->results().front() + "' stands before the command '" + name +
                           "': a command comes first, tread " + name + " ...");
        else if (option->count() > 0)
          throw InputError(option->get_name() + " stands before the command '" + name + "': put it behind");
    }
  } // namespace


  std::optional<CommandLine> parse_command_line(const int argc, char **argv, const bool speaks)
  {
    CommandLine line;
    CLI::App    app("tread: a railway wheel rolls over a rail\n"
                       "tread SCENE.prm [options]            mpirun -np N tread SCENE.prm [options]\n"
                       "tread COMMAND ... [options]          tread COMMAND --help");
    app.set_version_flag("--version", "tread " + version());
    const auto help = std::make_shared<Help>();
    help->label("SUBCOMMAND", "COMMAND");
    app.formatter(help);
    OlderForms older(app, line);
    add_commands(app, line);
    // The commands would take over a footer that there is before them.
    app.footer(
      "Options that did what the commands do (--reference-only, --modes, --contact-points, --wear, --batch, "
      "--positions,\n--dynamic-force, --sleeper-stress, --print-parameters, --print-columns) are "
      "still understood in this version.");
    // What is no option, no command and no path was meant for one of the commands.
    const std::string first = argc > 1 ? argv[1] : "";
    std::string       behind;
    for (const CLI::App *command : app.get_subcommands([](const CLI::App *) { return true; }))
      if (command->get_name() == first)
        behind = first + " ";
    require(first.empty() || first[0] == '-' || !behind.empty() ||
              first.find_first_of("./") != std::string::npos || std::filesystem::exists(first),
            "there is no command and no file '" + first + "'; tread --help lists the commands");
    try
      {
        app.parse(argc, argv);
      }
    catch (const CLI::Success &asked)
      {
        if (speaks)
          app.exit(asked);
        return {};
      }
    catch (const CLI::ParseError &error)
      {
        refuse_before_command(app);
        throw InputError(std::string(error.what()) + "; tread " + behind + "--help lists all options");
      }
    if (app.get_subcommands().empty())
      older.resolve();
    else
      refuse_before_command(app);
    ParameterFile::refuse_repeated(line.settings);
    return line;
  }
} // namespace tread
