// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_rail_base_h
#define tread_track_rail_base_h

#include <tread/base/archive.h>
#include <tread/base/simd.h>

#include <optional>

namespace tread
{
  /// The bottom of a rail of which only a piece under the wheel is meshed. It stays in shape and moves with
  /// what stands for the track. It begins to move from the equilibrium at the start.
  class RailBase
  {
  public:
    /// Force and moment of the rail's cells.
    struct Load
    {
      Vector3 force{};     ///< N
      double  moment = 0.; ///< N m, about the base's middle: positive where it lifts what has a higher x
    };
    struct Motion
    {
      Vector3 shift{};    ///< of its middle, m or m/s
      double  slope = 0.; ///< what lies at a higher x rises by it, rad or rad/s
    };

    virtual ~RailBase() = default;

    /// Go back to the reference position and hold from now on what the rail exerts first.
    virtual void place() = 0;

    /// Find the forces at the present state, with which a step begins.
    virtual void find_forces()
    {
    }
    /// One central-difference step under the load of the cells.
    virtual void advance(const Load &load, const double time_step) = 0;

    virtual Motion displacement() const = 0; ///< from the start
    virtual Motion velocity() const     = 0; ///< half a step back

    /// Bounds of what moves here, over its masses: 1/s^2 and 1/s.
    virtual double stiffness_over_mass() const
    {
      return 0.;
    }
    virtual double damping_over_mass() const
    {
      return 0.;
    }

    // Energies, J.

    virtual double kinetic_energy(const double time_step) const = 0; ///< @see Part::kinetic_energy
    virtual double spring_energy() const
    {
      return 0.;
    }
    virtual double dissipated() const ///< so far
    {
      return 0.;
    }
    virtual double external_work() const ///< so far
    {
      return 0.;
    }
    virtual double gross_work() const ///< sum of its absolute amounts
    {
      return 0.;
    }

    /// Take the velocity with which the deflection at rest follows a load that moves along the rail. @param
    /// load upwards, N; @param speed along x, m/s. @returns whether it does
    virtual bool follow(const double /*load*/, const double /*speed*/)
    {
      return false;
    }

    virtual void serialize(Archive &archive) = 0;
  };

  /// A spring and a damper beside each other, SI units.
  struct SpringAndDamper
  {
    double stiffness = 0., damping = 0.; ///< N/m, N s/m
  };

  struct CoRunningTrack
  {
    double          mass = 0.; ///< of the track that moves with the rail, without the rail's cells, kg
    SpringAndDamper vertical, lateral;
  };

  /// A base on a track that runs along with the wheel: it moves up, down and across on springs and dampers
  /// under a mass (the co-running or moving track model of vehicle dynamics; Chaar & Berg 2006). The track's
  /// deflection under the wheel's mean load is left out: at the start springs hold what the rail exerts.
  class CoRunningBase : public RailBase
  {
  public:
    explicit CoRunningBase(const CoRunningTrack &track)
      : track(track)
    {
    }

    void   place() override;
    void   advance(const Load &load, const double time_step) override;
    Motion displacement() const override
    {
      return {state.displacement};
    }
    Motion velocity() const override
    {
      return {state.velocity};
    }
    double kinetic_energy(const double) const override
    {
      return 0.5 * track.mass * dot(state.velocity, state.velocity);
    }
    double external_work() const override ///< of springs and dampers on the base
    {
      return state.work;
    }
    double gross_work() const override
    {
      return state.gross;
    }
    void serialize(Archive &archive) override;

  private:
    struct State
    {
      Vector3                displacement{}, velocity{};
      std::optional<Vector3> held; ///< constant part of the springs, N; none: before the first step
      double                 work = 0., gross = 0.;
    };

    CoRunningTrack track;
    State          state;
  };
} // namespace tread

#endif
