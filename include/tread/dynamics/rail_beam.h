// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_rail_beam_h
#define tread_dynamics_rail_beam_h

#include <tread/material/elastic.h>
#include <tread/mesh/mesh.h>
#include <tread/reference/supported_beam.h>
#include <tread/solid/solid.h>
#include <tread/track/supports.h>
#include <tread/track/track_beyond.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace tread
{
  /// The track beyond both ends of a rail of cells, if it goes on there.
  using TrackBeyondBoth = std::optional<std::array<TrackBeyondParameters, 2>>;

  /// The rail of cells represented as a beam on its supports, with plane and rigid sections, and the track
  /// beyond it, if there is one. Such displacement fields are far softer than relative motions of the cells,
  /// so the relaxation, which is efficient for the latter, leaves them to this beam.
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
      std::vector<double>                along;    ///< at evenly spaced places of the rail; none: it is held
    };

    /// The displacement field that balances loads on the rail, and nodal forces (N, of this rank). The
    /// first is collective.
    Field balance(const Vector3 *force, std::vector<reference::SupportedBeam::Load> loads) const;
    Field balance(const std::vector<reference::SupportedBeam::Load> &loads) const;

    /// Add factor times the field to the values of rail and solid sleepers.
    void add(const Field &field, const double factor, Vector3 *values) const;

    reference::BeamSection section() const
    {
      return rail_section;
    }

  private:
    Field respond(const std::vector<reference::SupportedBeam::Load> &loads,
                  const std::vector<double>                         &sleeper_loads) const;

    /// Number of evenly spaced places, at which what acts on nodes is gathered.
    unsigned int n_places() const;
    /// How a bar is displaced along itself by these forces (N) at the places.
    std::vector<double> stretched(const std::vector<double> &forces) const;

    const Mesh                                     &mesh;
    const Supports                                 &supports;
    const TrackBeyondBoth                           beyond;
    double                                          axial_stiffness = 0.; ///< E A, N
    unsigned int                                    n_before        = 0;  ///< supports before the cells
    reference::BeamSection                          rail_section;
    double                                          centroid_z = 0., begin = 0., end = 0.;
    std::vector<int>                                support_of_body; ///< of a solid sleeper; -1: none
    Quantum                                         quantum;         ///< of what nodes add to sums, N and N m
    std::unique_ptr<const reference::SupportedBeam> beam;
  };
} // namespace tread

#endif
