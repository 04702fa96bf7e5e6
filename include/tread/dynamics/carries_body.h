// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_carries_body_h
#define tread_dynamics_carries_body_h

#include <tread/base/simd.h>
#include <tread/dynamics/part.h>
#include <tread/dynamics/state.h>

#include <functional>
#include <vector>

namespace tread
{
  /// The rigid motion of a body whose cells hang on a rigid part, with what the integrator needs to know of
  /// it where nodes move.
  struct RigidMotion
  {
    Vector3 middle{}, velocity{}, turning{}; ///< m, m/s, rad/s
    Vector3 axle{};                          ///< unit vector
    bool    tilts        = false;            ///< the axle's direction may change
    double  compensation = 0.; ///< centripetal acceleration per arm that added density lacks, 1/s^2
  };

  /// Mass damping relative to the rigid motion, and compensation of the centrifugal force of the density
  /// added by scaling: sums over this rank's own nodes, weighted with their scaled masses.
  struct LoadsOnBody
  {
    Vector3 arms{};     ///< from the axle to the body's nodes, at right angles to it, kg m
    Vector3 drag{};     ///< of mass damping on the body's nodes, N
    Vector3 products{}; ///< of these arms with the places along the axle, kg m^2
    Vector3 moments{};  ///< of that drag about the body's middle, N m

    void operator+=(const LoadsOnBody &other)
    {
      arms += other.arms;
      products += other.products;
      drag += other.drag;
      moments += other.moments;
    }
  };

  /// Force and moment on what carries a body.
  struct Resultant
  {
    Vector3 force{}, moment{}; ///< N, N m about its middle
  };

  /// A part that carries a body: a wheel on its hub.
  class CarriesBody
  {
  public:
    virtual ~CarriesBody() = default;

    virtual unsigned int                     body() const    = 0;
    virtual const std::vector<unsigned int> &carried() const = 0; ///< nodes of this rank that it moves
    virtual RigidMotion                      motion() const  = 0;
    /// How an arm (m) of the undeformed body at the start lies now.
    virtual Vector3 turned(const Vector3 &arm) const = 0;
    /// What nodes of the body bear in this step by mass damping and compensation.
    virtual void take(const LoadsOnBody &) = 0;
    /// Velocities of the nodes of the body as those of the rigid motion. @param back by how much earlier, s,
    /// for each node
    virtual void set_velocities(State &, const std::function<double(unsigned int)> &back) const = 0;

    // At rest, where it moves up and, if it rolls, turns about x.

    virtual Resultant  resultant(const double *sums) const = 0; ///< of the nodes that it moves
    virtual MovingLoad load() const                        = 0; ///< of all but the cells
    virtual double     angular_velocity() const            = 0; ///< of the true centrifugal force, rad/s
    virtual void       move_up(const double way)           = 0;
    virtual void       rise(const double velocity)         = 0; ///< added to its velocity, m/s
    virtual bool       rolls() const                       = 0;
    virtual void       roll_by(const double angle)         = 0;
  };
} // namespace tread

#endif
