// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_half_space_case_h
#define tread_scene_half_space_case_h

#include <tread/analysis/contact_patch.h>
#include <tread/output/summary.h>
#include <tread/reference/hertz.h>
#include <tread/reference/rolling_estimate.h>
#include <tread/scene/scene.h>

#include <vector>

namespace tread
{
  /// The scene as the half-space solver sees it, at a given force and with the friction where the path ends.
  /// A rail head has its true running surface.
  /// @param normal_force N, > 0
  /// @param traction_coefficient longitudinal over normal force on the wheel, below the friction coefficient
  reference::RollingCase half_space_case(const Scene &scene,
                                         double       normal_force,
                                         double       traction_coefficient);

  /// The same for the forces or the creepage that the scene prescribes for a wheel: its static load, and its
  /// traction coefficient if a torque drives or the creepage is to be predicted.
  reference::RollingCase half_space_case(const Scene &scene, unsigned int wheel = 0);

  /// What half-space theory knows of a material.
  reference::Elastic elastic_of(const MaterialSection &material);

  /// Give a case the friction that the scene has at x (m) on the rail.
  void set_friction(reference::Friction &c, const Scene &scene, const double x);

  /// @throws InputError where the bodies are not half-spaces even by their shape.
  void require_half_space(const Scene &scene);

  /// reference::estimate_rolling() for a case of the scene. @param wheel whose traction is asked for
  /// @throws InputError, one line that names the parameters, where there is no answer
  reference::RollingEstimate half_space_answer(const Scene                  &scene,
                                               const reference::RollingCase &c,
                                               const unsigned int            wheel = 0);

  /// Hertz's patch of a case with like curvatures along each axis, its true gap aside.
  reference::HertzEllipse hertz(const reference::RollingCase &c);

  /// Lateral radius of the gap between the surfaces where they touch, m: that of the rail, or fitted over
  /// 5 mm at both sides.
  double lateral_radius(const Scene &scene);
  /// Whether it is fitted: it is no number of the scene.
  bool has_fitted_lateral_radius(const Scene &scene);

  /// The patch of WheelStance::ellipse() with the lateral radius over the patch that comes out, where that is
  /// fitted; over 5 mm where no size of the patch agrees with its own radius. @param normal_force N, > 0
  reference::HertzEllipse hertz_over_patch(const Scene &scene, double normal_force);

  /// Difference between the stretches of the rail's and the wheel's surface along x under the pressure alone,
  /// averaged with the pressure as weight: eps_x = -(1 + nu)(1 - 2 nu)/E b/(a + b) 3/4 p_max on each
  /// half-space (Johnson 1985, section 3.2, integrated over the ellipse). Zero for like bodies.
  double half_space_stretch(const Scene &scene);

  /// The elements in contact of a half-space solution as nodes of a patch table, with y measured from the
  /// middle of the rail. @param y_first_contact y of the origin of the solution, m.
  std::vector<PatchNode> patch_nodes(const reference::RollingResult &half_space,
                                     const double                    y_first_contact);

  /// Tangential traction on the wheel over the pressure in a half-space solution [-], at a position relative
  /// to the centre of contact (m). Outside the patch the value of the nearest element on the way to the
  /// centre is taken.
  Vector3 traction_over_pressure(const reference::RollingResult &half_space, double x, double y);

  /// Quantities acting in the contact: forces on the wheel (N), creepage as in the scene (positive when
  /// driving), and the measures of the patch.
  struct ContactAnswer
  {
    Vector3       force;
    double        creepage;
    PatchMeasures patch;
  };

  /// The half-space solution in these terms, in the limit of small elements. Its frictional power is that of
  /// the balance of forces and creepages.
  ContactAnswer contact_answer(const reference::RollingEstimate &half_space);

  /// Add the indices of damage, of several patches the largest. Those without a load are left out.
  void summarise_damage(Summary &summary, const Scene &scene, const std::vector<DamageIndex::Load> &loads);

  /// Write the first entries of every summary: forces, patch, creepage, and Hertz's values for comparison.
  /// @param method by which the answer was found
  void summarise(Summary             &summary,
                 const Scene         &scene,
                 const std::string   &method,
                 const ContactAnswer &answer,
                 bool                 completed);

  /// Add the half-space values to a computed answer for comparison.
  /// @param forces_given true: the solution is for the computed forces, so that the creepages can be
  /// compared; false: it is for the computed creepage, so that the traction coefficients can be compared
  void compare(Summary                          &summary,
               const ContactAnswer              &answer,
               const reference::RollingEstimate &half_space,
               bool                              forces_given);
} // namespace tread

#endif
