// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_base_on_beam_h
#define tread_track_base_on_beam_h

#include <tread/reference/supported_beam.h>
#include <tread/track/rail_base.h>
#include <tread/track/track_beyond.h>

#include <array>

namespace tread
{
  struct BeamUnderRail
  {
    reference::BeamSection section;              ///< of the whole rail
    double                 axial_stiffness = 0.; ///< E A, N
    double                 length          = 0.; ///< of the base, between two supports, m
    double                 mass = 0.; ///< of the base: of the beam's piece without the rail's cells, kg
    std::array<TrackBeyondParameters, 2> beyond; ///< behind its end of lowest and of highest x
  };

  /// A base that is the middle of a beam on pads, sleepers and ballast: it stays straight, moves up and down
  /// and pitches, and the beam goes on at both of its ends (@see TrackBeyond). So the rail has the mass, the
  /// bending and the waves of its whole section at the price of the cells under the wheel. Along and across
  /// it is held. The track is at rest under the load with which the motion begins, and displacements count
  /// from there.
  class BaseOnBeam : public RailBase
  {
  public:
    explicit BaseOnBeam(const BeamUnderRail &beam);

    void   place() override;
    void   find_forces() override;
    void   advance(const Load &load, const double time_step) override;
    Motion displacement() const override
    {
      return state.displacement.motion();
    }
    Motion velocity() const override
    {
      return state.velocity.motion();
    }
    double stiffness_over_mass() const override;
    double damping_over_mass() const override;
    double kinetic_energy(const double time_step) const override;
    double spring_energy() const override; ///< over that at rest under the load at the start
    double dissipated() const override;
    bool   follow(const double load, const double speed) override;
    void   serialize(Archive &archive) override;

  private:
    /// Of the base's middle: m and rad, their rates, or N and N m.
    struct UpAndSlope
    {
      double up = 0., slope = 0.;

      Motion motion() const
      {
        return {Vector3{0., 0., up, 0.}, slope};
      }
    };
    /// What a section at an end (0: of lowest x, 1: of highest) has, in its coordinates, which point
    /// outwards.
    TrackBeyond::AtSection at_end(const unsigned int end, const UpAndSlope &of_middle) const;
    /// Forces on both sections as force and moment on the middle.
    UpAndSlope on_middle(const TrackBeyond::AtSection &low, const TrackBeyond::AtSection &high) const;
    UpAndSlope present_force() const; ///< of both tracks on the middle
    double     energy_of_springs() const;
    /// The displacement at rest under a load.
    UpAndSlope at_rest(const UpAndSlope &load) const;
    void       rest_at(const UpAndSlope &displacement); ///< both tracks
    void       move_slowly();                           ///< with the velocity of the base

    BeamUnderRail              beam;
    double                     inertia; ///< about its middle, kg m^2
    std::array<TrackBeyond, 2> tracks;
    double                     stiffness[2][2]; ///< of both tracks, against up and slope: N/m, N, N m

    struct State
    {
      UpAndSlope displacement, velocity;
      bool       begun          = false; ///< the load at the start is known
      double     energy_at_rest = 0.;    ///< of the springs under it, J
    };
    State state;
  };
} // namespace tread

#endif
