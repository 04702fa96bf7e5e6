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
  /// The scene as the half-space solver sees it, at a given force. A rail head has its true running surface.
  /// @param normal_force N, > 0
  /// @param traction_coefficient longitudinal over normal force on the wheel, below the friction coefficient
  reference::RollingCase half_space_case(const Scene &scene,
                                         double       normal_force,
                                         double       traction_coefficient);

  /// The same at the forces or the creepage that the scene asks for: its static load, and its traction
  /// coefficient if a torque drives or the creepage is to be predicted.
  reference::RollingCase half_space_case(const Scene &scene);

  /// Hertz's patch of the scene's wheel and rail. @param normal_force N, > 0
  reference::HertzEllipse hertz(const Scene &scene, double normal_force);

  /// How much more the rail's surface stretches along x than the wheel's under the pressure alone, mean
  /// weighted with the pressure: eps_x = -(1 + nu)(1 - 2 nu)/E b/(a + b) 3/4 p_max on each half-space
  /// (Johnson 1985, section 3.2, integrated over the ellipse). Zero for like bodies.
  double half_space_stretch(const Scene &scene);

  /// The elements in contact of a half-space answer, as nodes of a patch table, whose y begins on the rail's
  /// middle. @param y_first_contact where that of the answer begins, m.
  std::vector<PatchNode> patch_nodes(const reference::RollingResult &half_space,
                                     const double                    y_first_contact);

  /// Tangential traction on the wheel over the pressure in a half-space answer [-], at a place relative to
  /// the centre of contact (m); beside the patch what is nearest on the way to the centre.
  Row traction_over_pressure(const reference::RollingResult &half_space, double x, double y);

  /// What acts in the contact: forces on the wheel (N), creepage as in the scene (positive when driving), and
  /// the measures of the patch.
  struct ContactAnswer
  {
    Row           force;
    double        creepage;
    PatchMeasures patch;
  };

  /// The half-space answer in these terms, in the limit of small elements. Its frictional power is that of
  /// the balance of forces and creepages.
  ContactAnswer contact_answer(const reference::RollingEstimate &half_space);

  /// What each summary begins with: forces, patch, creepage, and Hertz's values beside them.
  /// @param method that found the answer
  void summarise(Summary             &summary,
                 const Scene         &scene,
                 const std::string   &method,
                 const ContactAnswer &answer,
                 bool                 completed);

  /// The half-space values beside a computed answer.
  /// @param forces_given true: at the computed forces, so that the creepages can be compared; false: at the
  /// computed creepage, so that the traction coefficients can
  void compare(Summary                          &summary,
               const ContactAnswer              &answer,
               const reference::RollingEstimate &half_space,
               bool                              forces_given);
} // namespace tread

#endif
