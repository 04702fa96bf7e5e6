// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_rail_base_h
#define tread_track_rail_base_h

#include <tread/base/archive.h>
#include <tread/base/simd.h>

#include <optional>

namespace tread
{
  /// A spring and a damper beside each other, SI units.
  struct SpringAndDamper
  {
    double stiffness = 0., damping = 0.; ///< N/m, N s/m
  };

  struct RailBaseParameters
  {
    double          mass = 0.; ///< of the track that moves with the rail, without the rail's cells, kg
    SpringAndDamper vertical, lateral;
  };

  /// The bottom of a rail on a track that runs along with the wheel: it stays in shape, and moves up, down
  /// and across on springs and dampers under a mass (the co-running or moving track model of vehicle
  /// dynamics; Chaar & Berg 2006). The track's deflection under the wheel's mean load is left out: the base
  /// begins to move from the equilibrium at the start, where springs hold what the rail exerts.
  class RailBase
  {
  public:
    explicit RailBase(const RailBaseParameters &parameters)
      : parameters(parameters)
    {
    }

    /// Go back to the reference position and hold from now on what the rail exerts first.
    void place();

    /// One central-difference step under the force of the rail's cells, N.
    void advance(const Vector3 force, const double time_step);

    /// From the start, m.
    Vector3 displacement() const
    {
      return state.displacement;
    }
    /// Half a step back, m/s.
    Vector3 velocity() const
    {
      return state.velocity;
    }
    /// With this velocity, J.
    double kinetic_energy() const
    {
      return 0.5 * parameters.mass * dot(state.velocity, state.velocity);
    }
    /// Work of springs and dampers on the base so far, J.
    double external_work() const
    {
      return state.work;
    }
    /// Sum of the absolute amounts of that work, J: the scale for energy residuals.
    double gross_work() const
    {
      return state.gross;
    }

    /// Store or restore the state.
    void serialize(Archive &archive);

  private:
    struct State
    {
      Vector3                displacement{}, velocity{};
      std::optional<Vector3> held; ///< constant part of the springs, N; none: before the first step
      double                 work = 0., gross = 0.;
    };

    RailBaseParameters parameters;
    State              state;
  };
} // namespace tread

#endif
