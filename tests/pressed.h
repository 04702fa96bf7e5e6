// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_pressed_h
#define tread_tests_pressed_h

#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/wheel.h>

#include "boxes.h"

#include <cmath>
#include <memory>
#include <vector>

namespace tread::tests
{
  /// Around a patch with semi-axes a and b (m): a quarter more of fine cells, to the depth given (m).
  inline FineZone zone_around(const double a, const double b, const double cell_size, const double depth)
  {
    FineZone zone;
    zone.finest_cell_size = cell_size;
    zone.x_begin          = -1.25 * a;
    zone.x_end            = 1.25 * a;
    zone.half_width       = 1.25 * b;
    zone.depth            = depth;
    return zone;
  }

  /// A flat block, and above it a cap of a sphere (radius, m) that touches it at the origin. Both are
  /// cube-like with half-width and height size.
  inline std::vector<Body> sphere_on_flat(const double    radius,
                                          const double    size,
                                          const double    coarsest,
                                          const FineZone &zone)
  {
    return {make_indenter("flat", size, coarsest, 0., zone),
            turned(make_indenter("cap", size, coarsest, radius, zone), dealii::Point<3>(1., 0., 0.),
                   dealii::numbers::PI)};
  }

  struct PressParameters
  {
    double                   force    = 0.;  ///< N
    double                   axle     = 0.;  ///< height of the hub when the bodies just touch, m
    double                   friction = 0.;  ///< coefficient
    double                   hub_mass = 1e4; ///< kg; kg m^2 of inertia
    unsigned int             slave    = 0;   ///< body
    double                   damping  = DynamicsParameters().damping_steps;
    std::vector<PlasticZone> plastic_zones{};
  };

  /// Two bodies of steel without weight: body 0 rests on its support, and a rigid hub that carries the
  /// support of body 1 presses this on it.
  struct Pressed
  {
    Mesh             mesh;
    Solid            solid;
    ExplicitDynamics dynamics;
    WheelHub         hub;
    Contact          contact;

    Pressed(const std::vector<Body> &bodies, const PressParameters &p)
      : mesh(MPI_COMM_WORLD, bodies)
      , solid(mesh, {ElasticMaterial(), ElasticMaterial()}, SolidParameters(), p.plastic_zones)
      , dynamics(mesh, solid, dynamics_parameters(p))
      , hub(hub_parameters(p))
      , contact(mesh, contact_parameters(p), std::make_shared<CoulombFriction>(p.friction))
    {
      dynamics.fix_nodes(dynamics.support_nodes(0));
      hub.place(Vector3{0., 0., p.axle, 0.});
      dynamics.add<WheelOnHub>(hub, 1, 0.);
      hub.parameters.sprung_mass = p.force / hub.parameters.gravity - hub.parameters.mass;
      dynamics.attach_contact(contact);
    }

    /// To equilibrium: the root of squares of the nodes' imbalance over the load; its sum may be some ten
    /// times larger. Returns the iterations.
    unsigned int relax()
    {
      return dynamics.relax(2e-5, 20000, nullptr);
    }

    /// Of the contact, N.
    double force() const
    {
      return std::abs(contact.total_impulse()[2]);
    }

  private:
    static DynamicsParameters dynamics_parameters(const PressParameters &p)
    {
      DynamicsParameters parameters;
      parameters.gravity       = 0.;
      parameters.damping_steps = p.damping;
      return parameters;
    }

    static WheelHubParameters hub_parameters(const PressParameters &p)
    {
      WheelHubParameters parameters;
      parameters.mass              = p.hub_mass;
      parameters.moment_of_inertia = p.hub_mass;
      parameters.gravity           = 1.;
      return parameters;
    }

    static ContactParameters contact_parameters(const PressParameters &p)
    {
      ContactParameters parameters;
      parameters.slave_body = p.slave;
      return parameters;
    }
  };
} // namespace tread::tests

#endif
