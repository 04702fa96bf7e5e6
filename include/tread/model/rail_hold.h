// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_model_rail_hold_h
#define tread_model_rail_hold_h

#include <tread/mesh/mesh.h>
#include <tread/scene/scene.h>
#include <tread/track/supports.h>

#include <functional>
#include <memory>
#include <vector>

namespace tread
{
  /// Ways in which something that moves the nodes of a mesh, a run or a system of small vibrations, can be
  /// told to hold some of the rail or of its sleepers.
  struct RailHold
  {
    std::function<void(const std::vector<unsigned int> &nodes)>                               fix;
    std::function<void(const std::vector<unsigned int> &nodes, const unsigned int direction)> guide;
    /// Nodes of the rail in proportion to their mass, by place (1/s).
    std::function<void(const std::function<double(const dealii::Point<3> &)> &rate)> damp;
  };

  /// Null: the scene's rail has another foundation. Collective.
  std::unique_ptr<Supports> make_supports(const Scene &scene, const Mesh &mesh);

  /// Hold rail and sleepers as a scene says; what carries them is left. @param supports as above. Collective.
  void hold_rail(const Scene &scene, const Mesh &mesh, const Supports *supports, const RailHold &hold);
} // namespace tread

#endif
