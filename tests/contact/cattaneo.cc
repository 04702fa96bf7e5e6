// SPDX-License-Identifier: LGPL-2.1-or-later
// Cattaneo and Mindlin: a sphere pressed on a flat and then sheared slowly; the slip area grows inwards from
// the edge.
#include <tread/reference/cattaneo_mindlin.h>
#include <tread/reference/hertz.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "pressed.h"

#include <algorithm>

using namespace tread;
using tests::Check;
using dealii::Point;

TREAD_TEST(contact_cattaneo)(Check &check, const tests::Arguments &)
{
  const double                 radius = 0.05, force = 1000., friction = 0.3; // m, N
  const reference::Elastic     steel;
  const reference::ElasticPair pair = reference::combine(steel, steel);
  const double                 a = reference::hertz_sphere(radius, pair.hertz_modulus(), force).semi_axis_x;
  const double                 h = 0.08e-3;

  const double           size = 64. * h; // 7 a: small, so that waves cross it quickly
  tests::PressParameters parameters;
  parameters.force    = force;
  parameters.axle     = size;
  parameters.friction = friction;
  parameters.hub_mass = 1e2; // with it the hub hardly moves up or down while this lasts
  parameters.damping  = 1.;
  tests::Pressed pressed(tests::sphere_on_flat(radius, size, 16. * h, tests::zone_around(a, a, h, 0.6 * a)),
                         parameters);
  pressed.relax();
  ExplicitDynamics &dynamics = pressed.dynamics;
  WheelHub         &hub      = pressed.hub;
  Contact          &contact  = pressed.contact;
  contact.set_friction(std::make_shared<CoulombFriction>(friction));
  contact.scale_impulses(DynamicsParameters().courant_number * dynamics.critical_step().seconds());
  dynamics.start();

  // The hub is moved along x, slowly and with a smooth start; instants are chosen by the force that contact
  // carries.
  const unsigned int steps = 6000;
  const double shift = 4.6e-6, total = steps * dynamics.state.time_step; // the whole would just make it slide
  std::vector<double> shares{0.3, 0.5, 0.7, 0.875};                      // T/(f N)
  for (unsigned int n = 0; n < steps && !shares.empty(); ++n)
    {
      hub.motion.velocity_x = 2. * shift / total * std::pow(std::sin(dealii::numbers::PI * n / steps), 2);
      dynamics.step();
      const Vector3 p         = contact.total_impulse();
      const double  normal    = std::abs(p[2]) / dynamics.state.time_step,
                   tangential = std::abs(p[0]) / dynamics.state.time_step;
      const double share      = tangential / (friction * normal);
      if (share < shares.front())
        continue;

      const std::string name   = "T/fN = " + std::to_string(shares.front()).substr(0, 5) + ": ";
      const auto        theory = reference::cattaneo_mindlin(radius, pair, normal, friction, tangential);
      unsigned int      stick = 0, slip = 0;
      double            stick_area = 0., squares[2] = {};
      for (const ContactNodeState &state : contact.active_nodes())
        {
          (state.adhesion ? stick : slip) += 1;
          stick_area += state.adhesion ? state.area : 0.;
          const double r     = std::hypot(state.position[0] - hub.motion.x, state.position[1]);
          const double shear = std::abs(state.impulse[0]) / (dynamics.state.time_step * state.area);
          squares[0] += std::pow(shear - theory.shear(r), 2);
          squares[1] += std::pow(friction * theory.max_pressure, 2);
        }
      const double found = std::sqrt(stick_area / dealii::numbers::PI);
      std::printf("%sstep %u, N %.2f N, %u stick, %u slip, h/a %.3f\n", name.c_str(), n, normal, stick, slip,
                  h / theory.contact_radius);
      check.relative(name + "normal force, N", normal, force, 2e-3);
      // Nodes stick or slip as a whole: the border is known to one cell, its mean radius better.
      check.absolute(name + "radius of adhesion, mm", 1e3 * found, 1e3 * theory.adhesion_radius, 0.5e3 * h);
      // Nodes at the edges of contact and adhesion have the mean over their surroundings.
      check.below(name + "surface shear stress, rms error, share of f p0", std::sqrt(squares[0] / squares[1]),
                  0.06);
      const double wrong =
        reference::cattaneo_mindlin(radius, pair, normal, friction, 0.5 * tangential).adhesion_radius;
      if (shares.front() >= 0.5)
        check.that(name + "half the force is noticed", std::abs(found - wrong) > 0.5 * h);
      shares.erase(shares.begin());
    }
  check.that("all forces were reached", shares.empty());
}
