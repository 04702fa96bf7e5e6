// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/version.h>
#include <tread/output/progress.h>
#include <tread/output/run_folder.h>
#include <tread/output/summary_keys.h>
#include <tread/scene/doubts.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/measured_profiles.h>
#include <tread/scene/steady_damage_tables.h>
#include <tread/scene/wheelset_case.h>
#include <tread/scene/wheelset_summary.h>
#include <tread/tools/wheelset_reference.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <sstream>

namespace tread
{
  namespace
  {
    const bool keys_of_wheelset_reference_are_known =
      know_summary_keys(SummaryGroup::half_space,
                        {{"solutions", "Of a wheelset in a position: half-space solutions in the search for "
                                       "the height that carries the load"}});
  } // namespace


  void run_wheelset_reference(const Scene &scene, const std::string &path, const MPI_Comm comm)
  {
    Progress progress(dealii::Utilities::MPI::this_mpi_process(comm) == 0);
    // Friction is that at the end of the path, as other scenes have it.
    const PlacedWheel        placed(scene, scene.position_at(scene.path_end()),
                                    wheel_rolling(scene, scene.path_end()));
    const WheelContact      &contact  = placed.contact;
    const double             rail_y   = placed.surfaces.rail_origin_y();
    std::vector<std::string> warnings = limits_of_half_space(contact.patches);
    for (const std::string &warning : placed.warnings())
      warnings.push_back(warning);
    const MeasuredProfiles profiles(scene);
    for (const std::vector<std::string> &more : {scene.unused_parameters(), implausible_values(scene),
                                                 profiles.warnings(), left_out_by_half_space(scene)})
      warnings.insert(warnings.end(), more.begin(), more.end());

    Summary summary;
    summarise_wheelset(summary, scene, "half-space solver", contact, given_angular_velocity(scene), true);
    summary.show("normal_force_N", "vertical force, kN", 1e-3, contact.force[2]);
    summary.show("longitudinal_force_N", "longitudinal force, kN", 1e-3, contact.force[0]);
    summary.show("lateral_force_N", "lateral force in the track, kN", 1e-3, contact.force[1]);
    summary.show("frictional_power_W", "frictional power, W", 1., frictional_power(contact));
    summary.set("solutions", contact.turns);
    summary.set("patches", patches_as_json(contact.patches, rail_y, scene));
    profiles.summarise(summary);
    summary.set("wall_s", progress.seconds());
    summary.set("ranks", dealii::Utilities::MPI::n_mpi_processes(comm));
    summary.set("version", version());
    summary.set("files", as_json(scene.parameters().files_read()));

    RunFolder folder(path, comm);
    folder.remove_results();
    folder.write("parameters.prm", scene.parameters().of_run());
    folder.write_table("patch.csv", patch_columns(), table_nodes(placed));
    std::vector<PassedPatch> passed;
    for (const WheelPatch &patch : contact.patches)
      passed.push_back({table_nodes(placed, patch), given_angular_velocity(scene) * patch.rolling_radius});
    write_steady_damage(scene, passed, folder, summary, warnings);
    summary.set("warnings", warnings);
    profiles.write(folder);
    folder.write("summary.json", summary.text());

    progress.say("tread " + version() + (scene.general.title.empty() ? "" : ": " + scene.general.title));
    progress.say(format(
      "half-space solver: shift %g mm, yaw %g mrad, roll %g mrad, %g rad/s; forces act on the wheel, by "
      "patch in contact axes\n",
      1e3 * contact.position.shift, 1e3 * contact.position.yaw, 1e3 * contact.position.roll,
      given_angular_velocity(scene)));
    for (const std::string &line : profiles.smoothing())
      progress.say(line);
    progress.say(table_of_patches(contact.patches, rail_y));
    progress.say(summary.table());
    for (const std::string &warning : warnings)
      progress.say("warning: " + warning);
    progress.say(format("finished in %.2f s. Results in ", progress.seconds()) + folder.path("") +
                 ": summary.json, patch.csv");
  }
} // namespace tread
