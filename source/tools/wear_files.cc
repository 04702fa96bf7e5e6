// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/profile_wear.h>
#include <tread/base/csv_table.h>
#include <tread/base/file_text.h>
#include <tread/base/format.h>
#include <tread/base/stop_signal.h>
#include <tread/base/version.h>
#include <tread/output/progress.h>
#include <tread/output/run_folder.h>
#include <tread/output/summary.h>
#include <tread/output/summary_keys.h>
#include <tread/scene/doubts.h>
#include <tread/scene/measured_profiles.h>
#include <tread/scene/surface_laws.h>
#include <tread/scene/wheelset_case.h>
#include <tread/tools/wear_files.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <filesystem>
#include <thread>

namespace tread
{
  namespace
  {
    constexpr const char *checkpoint = "wear.checkpoint";
    /// To be counted up when the order or the meaning of what is stored changes.
    constexpr const char *layout = "tread-wear-1";

    const bool keys_of_profile_wear_are_known = know_summary_keys(
      SummaryGroup::profile_wear,
      {{"contacts", "Contacts of a block of passages, rows of the table of tread wear"},
       {"wear_steps", "Steps in which the profiles wore"},
       {"wear_steps_refused", "Those that changed the pressure too much and were taken again, shorter"},
       {"rail_passages", "'Profile wear/Passages' of wheels over the rail"},
       {"wheel_turns", "'Profile wear/Wheel turns' meanwhile"},
       {"rail_wear_depth_m", "Largest depth that the rail has worn"},
       {"wheel_wear_depth_m", "Largest depth that the wheel has worn"},
       {"rail_wear_area_m2",
        "Area between the rail's profile and that at the start: volume on a metre of way"},
       {"wheel_wear_area_m2",
        "Area between the wheel's profile and that at the start: volume on a metre of its circumference"},
       {"rail_wear_area_by_law_m2", "The same by 'Damage/Wear law', summed over the steps"},
       {"wheel_wear_area_by_law_m2", "The same of the wheel"},
       {"rail_friction_work_J_per_m", "Work of friction in all passages, on a metre of way"},
       {"wheel_friction_work_J_per_m", "Work of friction in all turns, on a metre of the circumference"},
       {"max_pressure_at_start_Pa", "Largest pressure of all contacts on the new profiles"}});

    struct ContactColumn
    {
      const char *name;
      double      unit, least, most; ///< in the unit of the table
      void (*set)(WearContact &contact, double value);
    };
    const std::vector<ContactColumn> &contact_columns()
    {
      static const std::vector<ContactColumn> list{
        {"weight", 1., 1e-12, 1e12,
         [](WearContact &c, const double value) {
           c.weight = value;
         }},
        {"shift_mm", 1e-3, -100., 100.,
         [](WearContact &c, const double value) {
           c.position.shift = value;
         }},
        {"yaw_mrad", 1e-3, -87., 87.,
         [](WearContact &c, const double value) {
           c.position.yaw = value;
         }},
        {"roll_mrad", 1e-3, -87., 87.,
         [](WearContact &c, const double value) {
           c.position.roll = value;
         }},
        {"load_kN", 1e3, 1e-3, 1e5,
         [](WearContact &c, const double value) {
           c.load = value;
         }},
        {"creepage", 1., -0.2, 0.2,
         [](WearContact &c, const double value) {
           c.creepage = value;
         }},
        {"lateral_creepage", 1., -0.2, 0.2,
         [](WearContact &c, const double value) {
           c.rolling.lateral_speed = value * c.rolling.speed;
         }},
        {"friction", 1., 0., 2., [](WearContact &c, const double value) {
           c.rolling.friction = value;
         }}};
      return list;
    }

    std::vector<WearContact> read_contacts(const std::string &file, const Scene &scene)
    {
      std::string known;
      for (const ContactColumn &column : contact_columns())
        known += (known.empty() ? "" : ", ") + std::string(column.name);
      const CsvTable table(
        file,
        [&](const std::string &name) {
          require(std::any_of(contact_columns().begin(), contact_columns().end(),
                              [&](const ContactColumn &column) { return column.name == name; }),
                  "'" + file + "' has the column '" + name +
                    "', which means nothing here; allowed: " + known);
          return true;
        },
        "tread wear: cannot read '" + file + "'");
      require(table.n_rows() > 0, "'" + file + "' has no rows");
      WearContact usual;
      usual.position           = scene.wheelset.position();
      usual.rolling            = wheel_rolling(scene, scene.path_begin());
      usual.rolling.separation = scene.wheelset.patch_distance;
      usual.load               = scene.static_load();
      usual.both_wheels        = scene.wheelset.both_wheels;
      std::vector<WearContact> contacts(table.n_rows(), usual);
      require(!table.has("friction") || usual.rolling.is_coulomb(),
              "'" + file +
                "' has the column friction, which is for 'Contact/Friction law' Coulomb without 'Friction "
                "pressures (MPa)': leave it out, or the law");
      require(!table.has("roll_mrad") || !usual.both_wheels,
              "'" + file +
                "' has the column roll_mrad; with 'Wheelset/Both wheels' the roll is found: leave it out");
      for (const ContactColumn &column : contact_columns())
        if (table.has(column.name))
          for (std::size_t row = 0; row < contacts.size(); ++row)
            {
              const double value = table.column(column.name)[row];
              require(value >= column.least && value <= column.most,
                      "'" + file + "', row " + std::to_string(row + 1) + ": " + column.name + " is " +
                        text_of(value) + "; allowed: " + text_of(column.least) + " to " +
                        text_of(column.most));
              column.set(contacts[row], column.unit * value);
            }
      return contacts;
    }

    void check_scene(const Scene &scene, const MPI_Comm comm)
    {
      require(dealii::Utilities::MPI::n_mpi_processes(comm) == 1,
              "tread wear uses all cores by itself: start it on one rank");
      require(scene.is_positioned(),
              "tread wear needs a wheelset in its track: give 'Wheelset/Lateral shift (mm)' a number, 0 too");
      require(!scene.rail.is_sliced(),
              "tread wear needs a rail that is the same everywhere: 'Rail/Shape' cannot be slices");
      require(!scene.shapes().defect,
              "tread wear needs a rail that is the same everywhere: 'Defect/Shape' must be none");
      require(scene.wheel.deviation.empty(),
              "tread wear needs a wheel that is round: 'Wheel/Deviation' must be empty");
      require(wear_law(scene) != nullptr, "tread wear needs a law: 'Damage/Wear law' must not be none");
      require(scene.guidance.kind != Guidance::file && scene.contact.friction_places.empty() &&
                !scene.contact.varies_across(),
              "tread wear has no use for 'Guidance/Kind' file, 'Contact/Friction places (mm)' and friction "
              "across: its "
              "table has the positions, and friction is the same on all of the rail");
      scene.profile_wear.check();
    }

    ProfileWearParameters parameters_of(const Scene &scene)
    {
      ProfileWearParameters p;
      p.law        = wear_law(scene);
      p.passages   = scene.profile_wear.passages;
      p.turns      = scene.profile_wear.turns;
      p.spacing    = scene.profile_wear.spacing;
      p.smoothing  = scene.profile_wear.smoothing;
      p.change     = scene.profile_wear.change;
      p.least_step = scene.profile_wear.least_step;
      p.states     = scene.profile_wear.states;
      p.radius     = scene.wheel.radius;
      p.rail_angle = scene.rail.angle();
      p.gauge      = scene.wheelset.track;
      return p;
    }

    ProfileWear wear_of(const Scene &scene, const std::vector<WearContact> &contacts)
    {
      const WheelOnRail &surfaces = scene.wheel_on_rail();
      return ProfileWear(parameters_of(scene), contacts, surfaces.wheel(),
                         surfaces.rail_surface().sections(0.).front().turned(-scene.rail.angle()));
    }

    /// Adds a column to those that there are.
    template <typename Record>
    auto adder(Columns<Record> &columns)
    {
      return
        [&](const std::string &name, const std::string &unit, const std::string &about, const auto &value) {
          columns.push_back({name, unit, about, value});
        };
    }

    /// A point of a profile at a state.
    struct WornPoint
    {
      double           state;
      double           passages;
      dealii::Point<2> start, now;
      double           length, work; ///< that it stands for, m; of friction on a metre of way, J
    };

    Columns<WornPoint> worn_point_columns(const std::string &passages)
    {
      using R = WornPoint;
      const std::string about =
        passages == "passages" ? "Of wheels over the rail so far" : "Of the wheel so far";
      Columns<R> columns;
      const auto add = adder(columns);
      add("state_number", "", "Number of the state, 0 at the start", [](const R &r) { return r.state; });
      add(passages, "", about, [](const R &r) { return r.passages; });
      add("y_start", "mm", "In the axes of the profile, new", [](const R &r) { return r.start[0]; });
      add("z_start", "mm", "Upwards", [](const R &r) { return r.start[1]; });
      add("y", "mm", "Where this point of the surface is now", [](const R &r) { return r.now[0]; });
      add("z", "mm", "Upwards", [](const R &r) { return r.now[1]; });
      add("depth", "mm", "How far it has moved into the body",
          [](const R &r) { return r.now.distance(r.start); });
      add("friction_work", "J_per_m2", "Work of friction so far",
          [](const R &r) { return r.work / r.length; });
      return columns;
    }

    std::vector<WornPoint> worn_points(const ProfileWear &wear, const bool of_wheel, const double passages)
    {
      std::vector<WornPoint>               rows;
      const std::vector<dealii::Point<2>> &start  = (of_wheel ? wear.wheel() : wear.rail()).points_at_start();
      double                               number = 0.;
      for (const WornState &state : wear.states())
        {
          const std::vector<dealii::Point<2>> &now  = of_wheel ? state.wheel : state.rail;
          const std::vector<double>           &work = of_wheel ? state.wheel_work : state.rail_work;
          for (std::size_t k = 0; k < now.size(); ++k)
            {
              const double length = 0.5 * ((k > 0 ? now[k].distance(now[k - 1]) : 0.) +
                                           (k + 1 < now.size() ? now[k].distance(now[k + 1]) : 0.));
              rows.push_back({number, passages * state.progress, start[k], now[k], length, work[k]});
            }
          ++number;
        }
      return rows;
    }

    /// @param passages, turns in all
    Columns<WearStep> wear_step_columns(const double passages, const double turns)
    {
      using R = WearStep;
      Columns<R> columns;
      const auto add = adder(columns);
      add("passages", "", "Of wheels over the rail, at the end of the step",
          [passages](const R &r) { return passages * r.progress; });
      add("wheel_turns", "", "Of the wheel, at the end of the step",
          [turns](const R &r) { return turns * r.progress; });
      add("change", "",
          "Of the distribution of the normal force across the rail by the step: sum of its absolute "
          "changes over "
          "its sum, mean of the contacts by their weights",
          [](const R &r) { return r.change; });
      add("rail_depth", "mm", "Largest depth of wear of the rail so far",
          [](const R &r) { return r.rail_depth; });
      add("wheel_depth", "mm", "Largest depth of wear of the wheel so far",
          [](const R &r) { return r.wheel_depth; });
      add("rail_area", "mm2", "Between the rail's profile and that at the start",
          [](const R &r) { return r.rail_area; });
      add("wheel_area", "mm2", "Between the wheel's profile and that at the start",
          [](const R &r) { return r.wheel_area; });
      add("friction_work", "J_per_m", "Of a passage on a metre of way, mean of the contacts by their weights",
          [](const R &r) { return r.mean_work; });
      add("max_pressure", "MPa", "Largest pressure of all contacts",
          [](const R &r) { return r.max_pressure; });
      add("mean_max_pressure", "MPa", "Largest pressure of each contact, mean by their weights",
          [](const R &r) { return r.mean_max_pressure; });
      return columns;
    }

    struct PatchRow
    {
      double           state;
      double           passages, turns;
      const WearPatch *patch;
    };

    Columns<PatchRow> wear_patch_columns()
    {
      using R = PatchRow;
      Columns<R> columns;
      const auto add = adder(columns);
      add("state_number", "", "Number of the state, 0 at the start", [](const R &r) { return r.state; });
      add("passages", "", "Of wheels over the rail so far", [](const R &r) { return r.passages; });
      add("wheel_turns", "", "Of the wheel so far", [](const R &r) { return r.turns; });
      add("contact", "", "Row of the table of contacts, from 1 on",
          [](const R &r) { return r.patch->contact + 1.; });
      add("patch", "", "Number of the patch, from 1 on", [](const R &r) { return r.patch->patch + 1.; });
      add("rail_y", "mm", "Of its middle in the rail's profile", [](const R &r) { return r.patch->rail_y; });
      add("wheel_y", "mm", "Of its middle in the wheel's profile",
          [](const R &r) { return r.patch->wheel_y; });
      add("angle", "rad", "Inclination of the rail there, + where it falls to the gauge side",
          [](const R &r) { return r.patch->angle; });
      add("normal_force", "N", "On the wheel, in contact axes",
          [](const R &r) { return r.patch->normal_force; });
      add("longitudinal_force", "N", "On the wheel, positive: drives",
          [](const R &r) { return r.patch->longitudinal_force; });
      add("lateral_force", "N", "On the wheel, along the rail's surface to the field side",
          [](const R &r) { return r.patch->lateral_force; });
      add("max_pressure", "MPa", "Largest pressure", [](const R &r) { return r.patch->max_pressure; });
      add("patch_length", "mm", "Along the rail", [](const R &r) { return r.patch->length; });
      add("patch_width", "mm", "Across", [](const R &r) { return r.patch->width; });
      add("creepage", "",
          "Slip of the rigid wheel over the rail along it, over the speed, positive when driving",
          [](const R &r) { return 0. - r.patch->creepage; });
      add("angular_velocity", "rad_per_s", "Of the wheel",
          [](const R &r) { return r.patch->angular_velocity; });
      add("lateral_creepage", "", "The same across", [](const R &r) { return r.patch->lateral_creepage; });
      add("spin", "per_m", "About the normal, over the speed", [](const R &r) { return r.patch->spin; });
      add("friction_work", "J_per_m", "Of a passage on a metre of way",
          [](const R &r) { return r.patch->work; });
      add("rail_area", "mm2", "That a rail loses in a passage, by the law",
          [](const R &r) { return r.patch->rail_area; });
      add("sink_by_others", "", "How far it gives way under the other patches, over its undeformed overlap",
          [](const R &r) { return r.patch->sink_by_others; });
      return columns;
    }

    std::vector<PatchRow> patch_rows(const ProfileWear &wear, const double passages, const double turns)
    {
      std::vector<PatchRow> rows;
      double                number = 0.;
      for (const WornState &state : wear.states())
        {
          for (const WearPatch &patch : state.patches)
            rows.push_back({number, passages * state.progress, turns * state.progress, &patch});
          ++number;
        }
      return rows;
    }

    std::string profile_text(const WornProfile &profile)
    {
      std::string text = "y_mm,z_mm\n";
      for (const dealii::Point<2> &point : profile.points())
        text += format("%.9f,%.9f\n", 1e3 * point[0], 1e3 * point[1]);
      return text;
    }

    /// The scene on the worn profiles, in the same place in the track.
    std::string worn_scene(const Scene &scene, const ProfileWear &wear, const std::string &at)
    {
      const WheelOnRail worn  = wear.surfaces();
      TrackGauge        gauge = scene.wheelset.track;
      // A file of a rail is placed by its gauge face, which may have worn.
      const WheelOnRail placed(wear.wheel().curve(), wear.rail().curve().turned(scene.rail.angle()),
                               scene.wheel.radius, gauge);
      gauge.gauge += 2. * (worn.rail_origin_y() - placed.rail_origin_y());
      const double running = CurveFromAbove(wear.wheel().curve()).height(0.);
      std::string  text    = "# The scene on the profiles as they are worn.\n\ninclude parameters.prm\n\n";
      text += "subsection Rail\n  set Measured head = worn_rail" + at +
              ".csv\n  set Measured head mirrored = false\n  set "
              "Measured head shift (mm) = 0\n  set Smoothing length (mm) = 0\nend\n\n";
      text += "subsection Wheel\n  set Tread profile = worn_wheel" + at +
              ".csv\n  set Tread profile mirrored = false\n  set "
              "Tread profile shift (mm) = 0\n  set Smoothing length (mm) = 0\n";
      text += format("  set Radius (mm) = %.9f\nend\n\n", 1e3 * (scene.wheel.radius - running));
      text += format("subsection Wheelset\n  set Track gauge (mm) = %.9f\nend\n\n", 1e3 * gauge.gauge);
      // A creepage would count from the radius that the wheel has now.
      text += format(
        "subsection Motion\n  set Creepage = predicted\n  set Angular velocity (rad per s) = %.12g\nend\n\n",
        given_angular_velocity(scene));
      text += "subsection Output\n  set Directory = " + scene.output.directory + "-worn" + at + "\nend\n";
      return text;
    }

    void warn_of_patches(const ProfileWear &wear, const double smoothing, std::vector<std::string> &warnings)
    {
      const std::vector<WearPatch> &first = wear.states().front().patches,
                                   &last  = wear.states().back().patches;
      for (const auto &[when, patches] : {std::pair("at the start", &first), std::pair("at the end", &last)})
        {
          const auto affected = [&](const WearPatch &patch) {
            return patch.sink_by_others > largest_sink_by_others;
          };
          if (const auto n = std::count_if(patches->begin(), patches->end(), affected))
            {
              const WearPatch &worst = *std::max_element(
                patches->begin(), patches->end(),
                [](const WearPatch &a, const WearPatch &b) { return a.sink_by_others < b.sink_by_others; });
              warnings.push_back(format(
                "%s %zu of %zu patches give way under the pressure of others of their contact, "
                "which half-space theory leaves out: their forces are too large; most in contact "
                "%u, by %.0f %% of its overlap",
                when, std::size_t(n), patches->size(), worst.contact + 1, 100. * worst.sink_by_others));
            }
        }
      for (const auto &[when, patches] : {std::pair("at the start", &first), std::pair("at the end", &last)})
        {
          const auto n = std::count_if(patches->begin(), patches->end(), [](const WearPatch &patch) {
            return patch.turn > largest_turn_of_a_plane;
          });
          if (n > 0)
            warnings.push_back(format(
              "%s %zu of %zu patches are conformal: they bend by more than the %.1f degrees that a "
              "plane stands for",
              when, std::size_t(n), patches->size(), 180. / dealii::numbers::PI * largest_turn_of_a_plane));
          if (std::any_of(patches->begin(), patches->end(),
                          [](const WearPatch &patch) { return patch.climbs; }))
            warnings.push_back(
              format("%s a wheel stands on its flange between its steepest part and the tip: it climbs "
                     "out of the track",
                     when));
        }
      // A ball in its groove has smooth curvature with elements of half of this length, and none with two
      // thirds.
      double element = 0.;
      for (const auto *patches : {&first, &last})
        for (const WearPatch &patch : *patches)
          element = std::max(element, patch.element);
      if (element > 0.5 * smoothing)
        warnings.push_back(
          format("elements across of up to %.2f mm are larger than half of 'Profile wear/Smoothing length "
                 "(mm)': profiles may wear in zigzag",
                 1e3 * element));
      if (wear.n_forced() > 0)
        warnings.push_back(
          format("%u of %zu steps changed the pressure by more than 'Profile wear/Largest change', as "
                 "they were of 'Smallest step (um)' already: a contact jumps from one place to another",
                 wear.n_forced(), wear.steps().size() - 1));
    }

    void write_tables(const RunFolder   &folder,
                      const Scene       &scene,
                      const ProfileWear &wear,
                      const bool         has_new_state)
    {
      const double passages = scene.profile_wear.passages, turns = scene.profile_wear.turns;
      folder.write_table("wear_steps.csv", wear_step_columns(passages, turns), wear.steps());
      if (!has_new_state)
        return;
      folder.write_table("rail_wear.csv", worn_point_columns("passages"), worn_points(wear, false, passages));
      folder.write_table("wheel_wear.csv", worn_point_columns("wheel_turns"), worn_points(wear, true, turns));
      folder.write_table("wear_patches.csv", wear_patch_columns(), patch_rows(wear, passages, turns));
    }

    /// The profiles of the state that was kept just now, and the scene on them.
    void write_worn(const RunFolder &folder, const Scene &scene, const ProfileWear &wear)
    {
      const std::size_t number = wear.states().size() - 1;
      if (number == 0)
        return;
      const std::string at = '_' + std::to_string(number);
      folder.write("worn_rail" + at + ".csv", profile_text(wear.rail()));
      folder.write("worn_wheel" + at + ".csv", profile_text(wear.wheel()));
      folder.write("worn" + at + ".prm", worn_scene(scene, wear, at));
    }

    /// Those of the scene, and the table.
    std::vector<FileRead> files_of(const Scene &scene, const std::string &contacts)
    {
      std::vector<FileRead> files = scene.parameters().files_read();
      files.push_back(file_read("tread wear", contacts));
      return files;
    }

    /// What must be the same in a run that goes on.
    std::string inputs(const Scene &scene, const std::string &contacts)
    {
      std::string text;
      for (const ParameterFile::Setting &parameter : scene.parameters().changed_values())
        if (parameter.path.rfind("Output/", 0) != 0)
          text += parameter.path + '=' + parameter.value + '\n';
      for (const FileRead &file : files_of(scene, contacts))
        if (!file.is_scene())
          text += file.parameter + ' ' + file.in_words() + '\n';
      return text + version();
    }

    /// Refuses a run whose results would replace what it reads.
    void check_folder(const Scene &scene, const std::string &contacts, const std::string &path)
    {
      std::error_code unknown;
      const auto      whole = std::filesystem::weakly_canonical(path, unknown);
      for (const FileRead &file : files_of(scene, contacts))
        require(std::filesystem::weakly_canonical(file.path, unknown).parent_path() != whole,
                "'" + file.path + "' lies in the folder of the results, '" + path +
                  "': give another one by --output");
    }

    void store(const RunFolder &folder, ProfileWear &wear, const std::string &of_inputs)
    {
      Archive archive(MPI_COMM_SELF);
      wear.serialize(archive);
      const std::string bytes = archive.stored();
      folder.write(checkpoint, format("%s %u %u\n", layout, checksum(of_inputs), checksum(bytes)) + bytes);
    }

    void restore(const RunFolder &folder, ProfileWear &wear, const std::string &of_inputs)
    {
      const std::string path = folder.path(checkpoint), text = text_of_file(path);
      require(!text.empty(), "--resume: there is no '" + path + "' to go on from");
      const std::size_t end  = text.find('\n');
      const std::string head = text.substr(0, end), bytes = end == text.npos ? "" : text.substr(end + 1);
      require(head.rfind(std::string(layout) + ' ', 0) == 0 &&
                head.substr(head.rfind(' ') + 1) == std::to_string(checksum(bytes)),
              "--resume: '" + path + "' is damaged, or of another version");
      require(head == format("%s %u %u", layout, checksum(of_inputs), checksum(bytes)),
              "--resume: '" + path +
                "' is of another scene, other contacts or profiles, or another version of tread");
      try
        {
          Archive archive(MPI_COMM_SELF, bytes);
          wear.serialize(archive);
        }
      catch (const OtherStoredLayout &)
        {
          throw InputError("--resume: '" + path + "' has another layout");
        }
    }

    void say_step(Progress &progress, const Scene &scene, const ProfileWear &wear)
    {
      const WearStep &step = wear.steps().back();
      progress.say(format(
        "%11.0f %11.0f %9.2f %9.2f %9.0f %9.0f %8.3f %8.1f", scene.profile_wear.passages * step.progress,
        scene.profile_wear.turns * step.progress, 1e6 * step.rail_depth, 1e6 * step.wheel_depth,
        1e-6 * step.max_pressure, 1e-6 * step.mean_max_pressure, step.change, progress.seconds()));
    }
  } // namespace


  std::vector<TableDescription> tables_of_profile_wear()
  {
    return {describe("wear_steps.csv", wear_step_columns(1., 1.)),
            describe("rail_wear.csv", worn_point_columns("passages")),
            describe("wheel_wear.csv", worn_point_columns("wheel_turns")),
            describe("wear_patches.csv", wear_patch_columns())};
  }


  void estimate_profile_wear(const Scene &scene, const std::string &contacts_file, const MPI_Comm comm)
  {
    check_scene(scene, comm);
    const std::vector<WearContact> contacts = read_contacts(contacts_file, scene);
    ProfileWear                    first    = wear_of(scene, {contacts.front()});
    Progress                       progress(true);
    first.advance();                    // solves the contact, at a creepage of the table twice
    constexpr unsigned int blocks  = 2; // in a step
    const double           seconds = progress.seconds() / (contacts.front().creepage ? 2. : 1.) * blocks *
                           contacts.size() / std::max(1u, std::thread::hardware_concurrency());
    progress.say(
      format("contacts %18zu\nof a step, by the first of them, about %.1f s\nThe steps follow from 'Profile "
             "wear/Largest change': a thousandth of a millimetre at first, at most twice as much each time",
             contacts.size(), seconds));
  }


  bool write_profile_wear(const Scene       &scene,
                          const std::string &contacts_file,
                          const std::string &path,
                          const bool         goes_on,
                          const MPI_Comm     comm)
  {
    check_scene(scene, comm);
    Progress                       progress(true);
    const std::vector<WearContact> contacts = read_contacts(contacts_file, scene);
    const MeasuredProfiles         profiles(scene);
    ProfileWear                    wear = wear_of(scene, contacts);
    check_folder(scene, contacts_file, path);
    RunFolder         folder(path, comm);
    const std::string of_inputs = inputs(scene, contacts_file);
    if (goes_on)
      {
        restore(folder, wear, of_inputs);
        write_tables(folder, scene, wear, true);
      }
    else
      folder.remove_results();
    folder.write("parameters.prm", scene.parameters().of_run());

    progress.say("tread " + version() + (scene.general.title.empty() ? "" : ": " + scene.general.title));
    progress.say(
      format("wear by half-space theory: %zu contacts, %g passages of the rail, %g turns of the wheel\n",
             contacts.size(), scene.profile_wear.passages, scene.profile_wear.turns));
    progress.say("   passages       turns   rail um  wheel um   max MPa  mean MPa   change        s");
    watch_stop_signals();
    while (!wear.is_done() && !stop_was_asked())
      {
        const std::size_t n_states = wear.states().size();
        wear.advance();
        const bool has_new_state = wear.states().size() > n_states;
        write_tables(folder, scene, wear, has_new_state);
        if (has_new_state)
          write_worn(folder, scene, wear);
        store(folder, wear, of_inputs);
        say_step(progress, scene, wear);
      }
    if (!wear.is_done())
      {
        progress.say("interrupted after a step; --resume goes on from here");
        return false;
      }

    std::vector<std::string> warnings;
    warn_of_patches(wear, scene.profile_wear.smoothing, warnings);
    for (const std::vector<std::string> &more :
         {scene.unused_parameters(), implausible_values(scene), profiles.warnings()})
      warnings.insert(warnings.end(), more.begin(), more.end());
    const WearStep &last = wear.steps().back();
    Summary         summary;
    summary.set("title", scene.general.title);
    summary.set("method", "half-space solver");
    summary.set("completed", true);
    summary.set("contacts", contacts.size());
    summary.set("wear_steps", wear.steps().size() - 1);
    summary.set("wear_steps_refused", wear.n_refused());
    summary.show("rail_passages", "passages of the rail", 1., scene.profile_wear.passages);
    summary.show("wheel_turns", "turns of the wheel", 1., scene.profile_wear.turns);
    summary.show("rail_wear_depth_m", "largest depth, rail, um", 1e6, last.rail_depth);
    summary.show("wheel_wear_depth_m", "largest depth, wheel, um", 1e6, last.wheel_depth);
    summary.show("rail_wear_area_m2", "area lost by the rail, mm2", 1e6, last.rail_area);
    summary.show("wheel_wear_area_m2", "area lost by the wheel, mm2", 1e6, last.wheel_area);
    summary.set("rail_wear_area_by_law_m2", wear.rail_loss().area);
    summary.set("wheel_wear_area_by_law_m2", wear.wheel_loss().area);
    summary.set("rail_friction_work_J_per_m", wear.rail_loss().work);
    summary.set("wheel_friction_work_J_per_m", wear.wheel_loss().work);
    summary.show("max_pressure_at_start_Pa", "largest pressure at the start, MPa", 1e-6,
                 wear.steps().front().max_pressure);
    summary.show("max_pressure_Pa", "largest pressure at the end, MPa", 1e-6, last.max_pressure);
    profiles.summarise(summary);
    summary.set("warnings", warnings);
    summary.set("wall_s", progress.seconds());
    summary.set("ranks", 1);
    summary.set("version", version());
    summary.set("files", as_json(files_of(scene, contacts_file)));
    folder.write("summary.json", summary.text());

    progress.say("\n" + summary.table());
    for (const std::string &warning : warnings)
      progress.say("warning: " + warning);
    progress.say(
      format("finished in %.2f s. Results in ", progress.seconds()) + folder.path("") +
      ": summary.json, wear_steps.csv, rail_wear.csv, wheel_wear.csv, wear_patches.csv, worn_*.prm");
    return true;
  }
} // namespace tread
