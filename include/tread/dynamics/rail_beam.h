// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_rail_beam_h
#define tread_dynamics_rail_beam_h

#include <tread/material/elastic.h>
#include <tread/mesh/mesh.h>
#include <tread/reference/supported_beam.h>
#include <tread/solid/solid.h>
#include <tread/track/supports.h>

#include <memory>
#include <vector>

namespace tread
{
  /// The rail of cells represented as a beam on its supports, with plane and rigid sections. Such
  /// displacement fields are far softer than relative motions of the cells, so the relaxation, which is
  /// efficient for the latter, leaves them to this beam.
  class RailBeam
  {
  public:
    RailBeam(const Mesh &mesh, const Solid &solid, const Supports &supports, const ElasticMaterial &rail);

    /// Displacements of the sections and of solid sleepers (m), or their velocities (m/s).
    struct Field
    {
      reference::SupportedBeam::Response rail;
      std::vector<double>                sleepers; ///< by support; solid or rigid
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

    const Mesh                                     &mesh;
    const Supports                                 &supports;
    reference::BeamSection                          rail_section;
    double                                          centroid_z = 0., begin = 0., end = 0.;
    std::vector<int>                                support_of_body; ///< of a solid sleeper; -1: none
    Quantum                                         quantum;         ///< of what nodes add to sums, N and N m
    std::unique_ptr<const reference::SupportedBeam> beam;
  };
} // namespace tread

#endif
