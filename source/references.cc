// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/rail_profile.h>
#include <tread/references.h>

#include <algorithm>

namespace tread
{
  namespace
  {
    /// Half of the crown's relative curvature is B of the undeformed gap; the head's crown has its own
    /// radius.
    double lateral_radius(const Scene &scene)
    {
      return scene.rail_shape == "block" ? 1e-3 * scene.crown_radius_mm
             : scene.profile == "54E1"   ? RailProfile::rail_54e1().crown_radius()
                                         : RailProfile::rail_60e1().crown_radius();
    }
  } // namespace


  reference::RollingCase half_space_case(const Scene &scene,
                                         const double normal_force,
                                         const double traction_coefficient)
  {
    reference::RollingCase c;
    c.curvature_x     = 0.5 / (1e-3 * scene.radius_mm);
    c.curvature_y     = 0.5 / lateral_radius(scene);
    c.normal_force    = normal_force;
    c.friction        = std::max(scene.friction, 1e-6);
    c.speed           = scene.speed();
    c.wheel           = {scene.wheel_material.si().young_modulus, scene.wheel_material.si().poisson_ratio};
    c.rail            = {scene.rail_material.si().young_modulus, scene.rail_material.si().poisson_ratio};
    c.prescribe_force = true;
    c.traction_coefficient = traction_coefficient;
    // 100 elements along the patch: fine enough for creepages within 0.5 % of the limit.
    const double a =
      reference::hertz_ellipse(c.curvature_x, c.curvature_y,
                               reference::combine(c.wheel, c.rail).hertz_modulus(), normal_force)
        .semi_axis_x;
    c.element_size = a / 50.;
    return c;
  }

  reference::HertzEllipse hertz(const Scene &scene, const double normal_force)
  {
    const reference::RollingCase c = half_space_case(scene, normal_force, 0.);
    return reference::hertz_ellipse(c.curvature_x, c.curvature_y,
                                    reference::combine(c.wheel, c.rail).hertz_modulus(), normal_force);
  }


  std::vector<PatchNode> patch_nodes(const reference::RollingResult &half_space)
  {
    std::vector<PatchNode> nodes;
    for (std::size_t i = 0; i < half_space.x.size(); ++i)
      if (half_space.state[i] != reference::ElementState::exterior)
        nodes.push_back({Row{half_space.x[i], half_space.y[i], 0., 0.},
                         half_space.element_size * half_space.element_size,
                         half_space.pressure[i],
                         {half_space.shear_x[i], half_space.shear_y[i]},
                         {half_space.slip_x[i], half_space.slip_y[i]},
                         half_space.state[i] == reference::ElementState::adhesion});
    return nodes;
  }
} // namespace tread
