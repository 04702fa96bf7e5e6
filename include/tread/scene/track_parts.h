// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_track_parts_h
#define tread_scene_track_parts_h

#include <tread/scene/scene.h>
#include <tread/track/rail_ends.h>
#include <tread/track/supports.h>

#include <array>
#include <optional>
#include <vector>

namespace tread
{
  struct BeamUnderRail;
  struct TrackBeamParameters;

  /// What carries the rail of a scene.
  TrackParameters track_parameters(const Scene &scene);
  /// Under the meshed piece of the rail, its cells' mass included.
  BeamUnderRail beam_under_rail(const Scene &scene);
  /// The absorbing ends of the rail. Their length is 0 if the ends are symmetric.
  AbsorbingEnds absorbing_ends(const Scene &scene);
  /// The track beyond the ends of the rail, if these are endless.
  std::optional<std::array<TrackBeamParameters, 2>> track_beyond(const Scene &scene);

  /// Coordinates x of the supports on the rail, m, and the number of the first one. Support 0 lies where
  /// the scene places it.
  std::vector<double> support_positions(const Scene &scene);
  int                 first_support(const Scene &scene);
  /// The middle of the rail's base at x = 0.
  dealii::Point<3> base_middle(const Scene &scene);
  /// Numbers of the supports written to history.csv: those selected, or those next to the path of the
  /// wheel.
  std::vector<int> recorded_supports(const Scene &scene);
} // namespace tread

#endif
