// SPDX-License-Identifier: LGPL-2.1-or-later
// Where the patch lies across the rail before a run: half-space theory on the coarse grid of the check
// against Hertz and against a finer one, for S1002 treads that touch to one side; what leaves the rail is
// refused.
#include <tread/scene/fine_cells.h>
#include <tread/scene/half_space_case.h>

#include "check.h"

#include <algorithm>
#include <string>
#include <vector>

using namespace tread;

namespace scene_patch
{
  std::vector<std::string> s1002(const std::string &profile, const std::string &position)
  {
    return {"Wheel/Tread profile=S1002",     "Wheel/Lateral position (mm)=" + position,
            "Rail/Shape=full section",       "Rail/Profile=" + profile,
            "Rail/Inclination=1:40",         "Contact/Friction coefficient=0",
            "Motion/Traction coefficient=0", "Mesh/Finest cell (mm)=1.3",
            "Mesh/Fine half width (mm)=12"};
  }

  std::string complaint(const std::vector<std::string> &settings)
  {
    return tests::complaint<InputError>([&] { Scene().read("", settings); });
  }
} // namespace scene_patch

TREAD_TEST(scene_patch)(tests::Check &check, const tests::Arguments &)
{
  Scene crown;
  crown.read("", {"Rail/Shape=block", "Mesh/Finest cell (mm)=1.3", "Mesh/Fine half width (mm)=9"});
  const double b = crown.stance().ellipse(crown.static_load()).semi_axis_y;
  // Elements of a tenth of the semi-axis; the outermost centres lie inside.
  check.absolute("round crown: half the patch's width over Hertz's",
                 0.5 * (crown.shapes().patch.end - crown.shapes().patch.begin) / b, 0.95, 0.051);
  check.absolute("round crown: the path's middle, mm", 1e3 * path_y(crown), 0., 0.);

  // Tractions of a start: the half-space's in its patch, beside it those of its rim.
  const reference::RollingResult answer = reference::solve_rolling(half_space_case(crown));
  double                         force  = 0.;
  for (unsigned int e = 0; e < answer.x.size(); ++e)
    force += answer.pressure[e] * answer.grid.dx * answer.grid.dx *
             traction_over_pressure(answer, answer.x[e], answer.y[e])[0];
  check.relative("tractions of a start: their force, N", force, answer.longitudinal_force, 1e-9);
  check.relative("tractions of a start: over pressure behind the patch",
                 traction_over_pressure(answer, -30e-3, 0.)[0], crown.contact.friction_coefficient, 1e-6);
  const double ahead = traction_over_pressure(answer, 30e-3, 1e-3)[0];
  check.that("tractions of a start: below the bound ahead of the patch",
             ahead > 0. && ahead < crown.contact.friction_coefficient);

  for (const std::string profile : {"54E1", "60E1"})
    {
      const std::string name = "S1002 on " + profile + " 1:40: ";
      Scene             scene;
      scene.read("", s1002(profile, "0"));
      const PatchExtent              patch = scene.shapes().patch;
      const double                   y     = scene.shapes().first_contact.y;
      const reference::RollingResult fine  = reference::solve_rolling(half_space_case(scene));
      double                         begin = 0., end = 0.;
      for (std::size_t i = 0; i < fine.y.size(); ++i)
        if (fine.pressure[i] > 0.)
          {
            begin = std::min(begin, fine.y[i]);
            end   = std::max(end, fine.y[i]);
          }
      const double element =
        0.1 * scene.stance().ellipse(scene.static_load()).semi_axis_y + 0.5 * fine.grid.dx;
      check.absolute(name + "one side of the first contact, mm", 1e3 * (patch.begin - y), 1e3 * begin,
                     1e3 * element);
      check.absolute(name + "the other side, mm", 1e3 * (patch.end - y), 1e3 * end, 1e3 * element);
      check.that(name + "it is wider to one side by half or more", patch.end - y > 1.5 * (y - patch.begin));
      check.below(name + "the path's middle from the patch's, cells",
                  (path_y(scene) - 0.5 * (patch.begin + patch.end)) / 1.3e-3, 1.);
      auto narrow = s1002(profile, "0");
      narrow.push_back("Mesh/Fine half width (mm)=7");
      check.that(name + "cells fine on 7 mm to each side do not hold it",
                 complaint(narrow).find("must hold the patch from y = -") != std::string::npos);
      const std::string said = complaint(s1002(profile, "2"));
      if (!check.that(name + "moved by 2 mm towards the flange it leaves the head's top",
                      said.find("Wheel/Lateral position (mm)") != std::string::npos))
        std::printf("%s\n", said.c_str());
    }
}
