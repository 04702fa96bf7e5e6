// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_shapes_h
#define tread_scene_shapes_h

#include <tread/geometry/defect.h>
#include <tread/geometry/running_surfaces.h>
#include <tread/mesh/mesh_rail.h>
#include <tread/scene/islands.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tread
{
  class Scene;

  /// Lateral extent of a patch, m.
  struct PatchExtent
  {
    double begin, end;
  };

  /// The surfaces of an upright wheel and its rail, and how they touch: what follows from the positions,
  /// files and shapes that parameters name. Of a wheelset in a position there are only the defect and the
  /// deviation, over y of the wheel's profile. SI units.
  struct SceneShapes
  {
    RunningSurfaces surfaces;
    /// Height above the rail's profile, in the rail's own axes: measured head and defect. Null: none. @see
    /// RailTop
    std::function<double(double, double)> rail_height;
    std::shared_ptr<const Defect>         defect;          ///< null: none
    std::string                           wheel_deviation; ///< from round, in words; empty: none
    /// From round, inwards or outwards, that comes to the rail on the way that is meshed (m).
    double largest_deviation = 0.;

    std::shared_ptr<const MeshRail> rail_mesh; ///< from 'Rail/Mesh file'; null: the rail has another shape
    /// By how much the running surface of that rail has other heights, or ends, somewhere along the path (m).
    double unevenness = 0.;

    /// Point of first contact on the smooth rail, and the position of the wheel at the start.
    FirstContact first_contact{};
    /// Under the static load on the smooth rail, from half-space theory with the true gap: the patch of a
    /// worn profile or of S1002 may extend far to one side of the first contact.
    PatchExtent patch{};
    /// The parts of this patch, more than one where a worn profile touches with a gap between.
    std::vector<Island> islands;

    bool is_between_planes() const ///< @see MeshRail::between_planes
    {
      return rail_mesh && rail_mesh->between_planes;
    }
    bool has_uneven_mesh() const
    {
      return unevenness > 0.;
    }
    /// Whether the wheel is a body of revolution.
    bool is_round() const
    {
      return !surfaces.deviation;
    }
    /// Whether rolling may become steady: a round wheel on a rail without a defect that is the same all the
    /// way.
    bool are_smooth() const
    {
      return !defect && is_round() && !has_uneven_mesh();
    }
  };

  /// Surfaces and first contact of a scene; its patch is left. @param defect null: none. @throws InputError
  SceneShapes make_shapes(const Scene &scene, const std::shared_ptr<const Defect> &defect);
  /// The part of make_shapes() for what the wheel is not round by.
  void shape_deviation(SceneShapes &made, const Scene &scene);
  /// The part of make_shapes() for a rail from a mesh file.
  void shape_mesh_rail(SceneShapes &made, const Scene &scene);
  /// Add the patch under the static load, and the largest deviation from round on the way.
  /// @pre half-space theory finds these shapes in the scene
  void add_patch(SceneShapes &shapes, const Scene &scene);
} // namespace tread

#endif
