// SPDX-License-Identifier: LGPL-2.1-or-later
// Large deformation of cells: an inverted cell stops the run with an error that gives its position, a time
// step that is no longer stable stops it as well, and neither check reports anything for valid states.
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

using namespace tread;
using dealii::Point;

namespace dynamics_cells
{
  /// What check_cells() says of a block whose nodes were moved; "" if nothing.
  std::string complaint(const std::function<Point<3>(const Point<3> &)> &moved,
                        const double                                     courant,
                        double                                          &growth)
  {
    const Mesh         mesh(MPI_COMM_WORLD,
                            {tests::make_box("block", Point<3>(), Point<3>(.08, .03, .03), {{8, 3, 3}})});
    const Solid        solid(mesh, {ElasticMaterial()}, SolidParameters());
    DynamicsParameters parameters;
    parameters.courant_number = courant;
    ExplicitDynamics dynamics(mesh, solid, parameters);
    dynamics.start();
    const double before = dynamics.critical_step().seconds();
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      {
        const Point<3> p = moved(mesh.nodes[i]);
        dynamics.state.set_position(i, Vector3{p[0], p[1], p[2], 0.});
      }
    const std::string text =
      tests::complaint<std::runtime_error>([&] { dynamics.critical_step().check_cells(); });
    dynamics.critical_step().renew();
    growth = before / dynamics.critical_step().seconds();
    std::printf("critical step over the new one %.4f: '%s'\n", growth, text.c_str());
    return text;
  }
} // namespace dynamics_cells


TREAD_TEST(dynamics_cells)(tests::Check &check, const tests::Arguments &)
{
  double     growth;
  const auto stretch = [](const double factor) {
    return [=](const Point<3> &p) {
      return Point<3>(factor * p[0], factor * p[1], factor * p[2]);
    };
  };

  check.that("undeformed: nothing is said", complaint(stretch(1.), .95, growth).empty());
  check.relative("undeformed: the same step", growth, 1., 0.);
  // A turn is no deformation.
  check.that(
    "turned by 2 rad: nothing is said",
    complaint([](const Point<3> &p) { return tests::turn(p, Point<3>(0., .6, .8), 2.); }, .95, growth)
      .empty());
  check.relative("turned by 2 rad: the same step", growth, 1., 0.005);

  // The node between the cells around (30, 10, 10) mm goes through the opposite corner of one of them.
  const auto inverted = [](const Point<3> &p) {
    return p.distance(Point<3>(.03, .01, .01)) < 1e-6 ? Point<3>(.075, .045, .045) : p;
  };
  const std::string inside_out = complaint(inverted, .95, growth);
  check.that("inside out: said", inside_out.find("inside out") != std::string::npos);
  check.that("inside out: which body", inside_out.find("of the block") != std::string::npos);
  check.that("inside out: one line", inside_out.find('\n') == std::string::npos);
  check.that("inside out: where", inside_out.find("x = 35.00, y = 15.00, z = 15.00 mm") != std::string::npos);

  // Simple shear of the cells between x = 30 and 40 mm: C - 1 has g, g and g^2, E half of them.
  const auto sheared = [](const double g) {
    return [=](const Point<3> &p) {
      return Point<3>(p[0], p[1] + g * std::clamp(p[0] - .03, 0., .01), p[2]);
    };
  };
  const auto strain = [](const double g) {
    return 0.5 * g * std::sqrt(2. + g * g);
  };
  double g = 0.1;
  while (strain(g) < MotionLimits().strain)
    g += 0.001;
  const std::string strained = complaint(sheared(g), .5, growth);
  check.that("strained too much: said, with the parameter",
             strained.find("'Watchdogs/Stop at strain' 0.5") != std::string::npos);
  check.that("strained too much: where", strained.find("x = 35.00") != std::string::npos &&
                                           strained.find("of the block") != std::string::npos);
  check.that("strained a little less: not", complaint(sheared(g - 0.002), .5, growth).empty());

  // Alike in all directions by 8 %: the law's tangent changes the highest frequency by some per cent, in a
  // direction that is its own.
  double            larger, smaller;
  const std::string of_larger  = complaint(stretch(1.08), .99, larger),
                    of_smaller = complaint(stretch(.92), .99, smaller);
  check.that("8 % strain changes the critical step", std::abs(std::max(larger, smaller) - 1.) > .03);
  check.that("the step that has become too large: said",
             (larger > smaller ? of_larger : of_smaller).find("Courant number") != std::string::npos);
  check.that("the step that has become smaller than it must be: not",
             (larger > smaller ? of_smaller : of_larger).empty());
  check.that("with room for it: not", complaint(stretch(larger > smaller ? 1.08 : .92), .7, growth).empty());
}
