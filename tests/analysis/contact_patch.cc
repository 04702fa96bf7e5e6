// SPDX-License-Identifier: LGPL-2.1-or-later
// Measures of a contact patch with a known pressure and a known shear stress, and their average over steps in
// which not all nodes are in contact.
#include <tread/analysis/contact_patch.h>

#include <deal.II/base/numbers.h>

#include "check.h"

#include <algorithm>
#include <cmath>

using namespace tread;
using dealii::numbers::PI;

namespace analysis_contact_patch
{
  constexpr double a = 6e-3, b = 4e-3, cell = 0.1e-3;              // m
  constexpr double largest = 1e9, shear_along = 2e8, twist = 3e10; // Pa, Pa, Pa/m
  constexpr double x_middle = 1e-3, y_middle = -2e-3;              // m
  constexpr double time_step = 1e-7;                               // s

  /// Nodes of a Hertzian ellipse about a middle: shear stress along plus one that twists about the origin;
  /// the half behind the middle slips against the shear stress, ahead nodes adhere.
  std::vector<ContactNodeState> ellipse(const double centre_x)
  {
    std::vector<ContactNodeState> states;
    for (int i = -100; i <= 100; ++i)
      for (int j = -100; j <= 100; ++j)
        {
          const double x = (i + 0.5) * cell, y = (j + 0.5) * cell, out = x * x / (a * a) + y * y / (b * b);
          if (out >= 1.)
            continue;
          ContactNodeState state{};
          const double     px = x + x_middle, py = y + y_middle, area = cell * cell;
          const Vector3    traction{shear_along - twist * py, twist * px, largest * std::sqrt(1. - out), 0.};
          state.node     = 1000 * (i + 500) + j + 500;
          state.position = Vector3{px + centre_x, py, 0.1, 0.};
          state.normal   = Vector3{0., 0., 1., 0.};
          state.impulse  = (area * time_step) * traction;
          state.area     = area;
          state.adhesion = x > 0.;
          if (!state.adhesion)
            state.slip = Vector3{-2., 0., 0., 0.};
          states.push_back(state);
        }
    return states;
  }

  void check_measures(tests::Check &check)
  {
    const PatchMeasures m    = measure(patch_nodes(ellipse(0.3), 0.3, time_step));
    const double        area = PI * a * b, force = 2. / 3. * largest * area;
    // Sums over 7500 cells of a field with a square-root edge.
    check.relative("area (mm2)", 1e6 * m.area, 1e6 * area, 2e-3);
    check.relative("largest pressure (MPa)", 1e-6 * m.max_pressure, 1e-6 * largest, 1e-3);
    check.relative("normal force (N)", m.normal_force, force, 1e-3);
    check.relative("longitudinal force (N)", m.longitudinal_force, area * (shear_along - twist * y_middle),
                   2e-3);
    check.relative("lateral force (N)", m.lateral_force, area * twist * x_middle, 2e-3);
    // About the origin: of the middle, and a quarter of the squares of the semi-axes.
    check.relative("spin moment (N m)", m.spin_moment,
                   area * (twist * (0.25 * (a * a + b * b) + x_middle * x_middle + y_middle * y_middle) -
                           y_middle * shear_along),
                   2e-3);
    check.relative("adhesion share", m.adhesion_share, 0.5, 1e-12);
    check.relative("frictional power (W)", m.frictional_power,
                   2. * 0.5 * area * (shear_along - twist * y_middle), 2e-3);
    check.relative("largest slip (m/s)", m.max_slip, 2., 1e-15);
    check.relative("semi-axis by moments, along (mm)", 1e3 * m.pressure_semi_axis_x, 1e3 * a, 1e-3);
    check.relative("semi-axis by moments, across (mm)", 1e3 * m.pressure_semi_axis_y, 1e3 * b, 1e-3);
    // Both are whole numbers of cells.
    check.absolute("semi-axis by extent, along (mm)", 1e3 * m.semi_axis_x, 1e3 * a, 1e-9);
    check.absolute("semi-axis by extent, across (mm)", 1e3 * m.semi_axis_y, 1e3 * b, 1e-9);
    check.absolute("middle, along (mm)", 1e3 * m.x_middle, 1e3 * x_middle, 1e-9);
    check.absolute("pressure, along (mm)", 1e3 * m.x_of_pressure, 1e3 * x_middle, 1e-9);
    check.absolute("pressure, across (mm)", 1e3 * m.y_of_pressure, 1e3 * y_middle, 1e-9);
    check.absolute("middle, across (mm)", 1e3 * m.y_middle, 1e3 * y_middle, 1e-9);
  }

  /// A node in contact in all of four steps, and one in a single step.
  void check_average(tests::Check &check)
  {
    PatchAverage average;
    for (unsigned int n = 0; n < 4; ++n)
      {
        ContactNodeState always{};
        always.node           = 7;
        always.position       = Vector3{1e-3, 2e-3, 0., 0.};
        always.normal         = Vector3{0., 0., 1., 0.};
        always.area           = 1e-6;
        always.impulse        = (1e-6 * time_step) * Vector3{1e6 * (n + 1.), -2e6, 1e9, 0.};
        always.slip           = Vector3{0.1 * n, 0.2, 0., 0.};
        always.adhesion       = n < 3;
        ContactNodeState once = always;
        once.node             = 9;
        once.adhesion         = false;
        std::vector<ContactNodeState> states{always};
        if (n == 2)
          states.push_back(once);
        average.add(states, 1e-3 * n, time_step);
      }
    const std::vector<PatchNode> nodes = average.nodes();
    check.that("average: two nodes in four steps", nodes.size() == 2 && average.n_steps() == 4);
    if (nodes.size() != 2)
      return;
    check.relative("average: pressure of the node that always touches (MPa)", 1e-6 * nodes[0].pressure, 1e3,
                   1e-12);
    check.relative("average: its shear stress (MPa)", 1e-6 * nodes[0].shear[0], 2.5, 1e-12);
    check.relative("average: its slip (m/s)", nodes[0].slip[0], 0.15, 1e-12);
    check.that("average: it adheres, as in most steps", nodes[0].adhesion);
    // The mean over all steps, and the slip of those in contact; x from the mean place of the wheel.
    check.relative("average: pressure of the other (MPa)", 1e-6 * nodes[1].pressure, 250., 1e-12);
    check.relative("average: its shear stress across (MPa)", 1e-6 * nodes[1].shear[1], -0.5, 1e-12);
    check.relative("average: its slip (m/s)", nodes[1].slip[0], 0.2, 1e-12);
    check.that("average: it slips", !nodes[1].adhesion);
    check.absolute("average: its place (mm)", 1e3 * nodes[1].position[0], 1. - 1.5, 1e-12);
    check.relative("average: its area (mm2)", 1e6 * nodes[1].area, 1., 1e-12);
    check.relative("average: mean of the steps' largest pressures (MPa)",
                   1e-6 * average.measures().max_pressure, 1e3, 1e-12);
    check.relative("average: mean of the steps' areas (mm2)", 1e6 * average.measures().area, 1.25, 1e-12);
  }
} // namespace analysis_contact_patch


TREAD_TEST(analysis_contact_patch)(tests::Check &check, const tests::Arguments &)
{
  check_measures(check);
  check_average(check);
}
