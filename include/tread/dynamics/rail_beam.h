// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_rail_beam_h
#define tread_dynamics_rail_beam_h

#include <tread/material/elastic.h>
#include <tread/mesh/mesh.h>
#include <tread/reference/supported_beam.h>
#include <tread/solid/solid.h>
#include <tread/track/supports.h>
#include <tread/track/track_beam.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace tread
{
  /// The track beyond both ends of a rail of cells, if it goes on there.
  using TrackBeyondBoth = std::optional<std::array<TrackBeamParameters, 2>>;

  /// The rail of cells represented as a beam on its supports, with plane and rigid sections, and the track
  /// beyond it, if there is one: how it follows a load that moves.
  class RailBeam
  {
  public:
    RailBeam(const Mesh            &mesh,
             const Solid           &solid,
             const Supports        &supports,
             const ElasticMaterial &rail,
             const TrackBeyondBoth &beyond = {});

    /// Displacements of the sections and of solid sleepers (m), or their velocities (m/s).
    struct Field
    {
      reference::SupportedBeam::Response rail;
      std::vector<double>                sleepers; ///< by support; solid or rigid
    };

    /// The displacement field that balances loads on the rail.
    Field balance(const std::vector<reference::SupportedBeam::Load> &loads) const;

    /// Add factor times the field to the values of rail and solid sleepers.
    void add(const Field &field, const double factor, Vector3 *values) const;

  private:
    const Mesh                                     &mesh;
    const Supports                                 &supports;
    unsigned int                                    n_before   = 0; ///< supports before the cells
    double                                          centroid_z = 0.;
    std::vector<int>                                support_of_body; ///< of a solid sleeper; -1: none
    std::unique_ptr<const reference::SupportedBeam> beam;
  };
} // namespace tread

#endif
