// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_tables_h
#define tread_scene_tables_h

#include <tread/scene/sections/track.h>
#include <tread/scene/wheelset_motion.h>
#include <tread/track/supports.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tread
{
  /// Tables of a scene from files of their own. SI units.
  struct SceneTables
  {
    std::shared_ptr<const WheelsetMotion>   wheelset_motion; ///< of 'Guidance/File'; null: none
    std::map<int, TrackParameters::Springs> support_springs; ///< of 'Track/Support file', by the support
    std::vector<BeamRow>                    beam_rows;       ///< of 'Track/Beam file'
  };

  /// 'Track/Support file', by the number of the support. @param track whose springs count where the table
  /// has none @throws InputError
  std::map<int, TrackParameters::Springs> read_support_springs(const TrackSection &track,
                                                               const std::string  &file);

  /// 'Track/Beam file'. @throws InputError
  std::vector<BeamRow> read_beam_rows(const std::string &file);
} // namespace tread

#endif
