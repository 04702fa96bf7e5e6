// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_wheelset_summary_h
#define tread_scene_wheelset_summary_h

#include <tread/analysis/wheelset_contact.h>
#include <tread/output/columns.h>
#include <tread/output/summary.h>
#include <tread/scene/scene.h>

#include <string>
#include <vector>

namespace tread
{
  // What is told of a wheelset in a given position, whichever way it was solved.

  /// A line for each figure, a column for each patch. @param rail_y where the middle of the rail's top lies
  /// in the track, m @param references the half-space's answers beside them, one for each patch or none at
  /// all
  std::string table_of_patches(const std::vector<WheelPatch> &patches,
                               const double                   rail_y,
                               const std::vector<WheelPatch> &references = {});

  /// The figures of each patch by their names in summary.json, indices of damage among them.
  nlohmann::ordered_json patches_as_json(const std::vector<WheelPatch> &patches,
                                         const double                   rail_y,
                                         const Scene                   &scene);

  /// These names with units and meanings.
  std::vector<TableDescription::Line> keys_of_patch();

  /// Where half-space theory ends, in words and with its number.
  std::vector<std::string> limits_of_half_space(const std::vector<WheelPatch> &patches);

  /// Of all patches, W.
  double frictional_power(const WheelContact &contact);

  /// The first entries of the summary: position, and what is largest in the patches or their sum.
  void summarise_wheelset(Summary            &summary,
                          const Scene        &scene,
                          const std::string  &method,
                          const WheelContact &contact,
                          const double        angular_velocity,
                          const bool          completed);
} // namespace tread

#endif
