// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_seat_modes_h
#define tread_analysis_seat_modes_h

#include <tread/analysis/elastic_system.h>
#include <tread/track/supports.h>
#include <tread/track/track_beam.h>

#include <vector>

namespace tread
{
  /// A structure as forces on one place feel it, with a few coordinates: the modes of its motion in the
  /// Krylov space of the response at rest, K^-1 f, K^-1 M K^-1 f, ... (Nour-Omid & Clough, Earthquake
  /// Engineering and Structural Dynamics 12, 1984), each scaled so that the place moves as the coordinate
  /// does. The response at rest is that of the structure itself, and so are those of low frequencies.
  /// @param system that is held: its stiffness matrix is regular; assembled. @param n coordinates at most;
  /// fewer where the space has no more or the place does not feel them. Collective. @throws
  /// std::runtime_error if the equations have no answer
  SleeperModes modes_at_place(const ElasticSystem        &system,
                              const ElasticSystem::Place &place,
                              const unsigned int          n);

  /// The same for a solid sleeper of a mesh, on its ballast, whose place is the area under the pad. @param
  /// position of its support along the rail, m; @param track without exceptions. Collective.
  SleeperModes modes_at_seat(const Mesh                         &mesh,
                             const unsigned int                  rail_body,
                             const SolidSleeper                 &sleeper,
                             const double                        position,
                             TrackParameters                     track,
                             const std::vector<ElasticMaterial> &materials,
                             const SolidParameters              &parameters);
} // namespace tread

#endif
