// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/base_on_beam.h>

#include <algorithm>

namespace tread
{
  namespace
  {
    /// Whether the coordinates of the section at an end point along x or against it.
    double side(const unsigned int end)
    {
      return end == 0 ? -1. : 1.;
    }
  } // namespace


  BaseOnBeam::BaseOnBeam(const BeamUnderRail &beam)
    : beam(beam)
    , inertia(beam.mass * beam.length * beam.length / 12. + beam.section.rotary_inertia * beam.length)
    , tracks{{{beam.section, beam.axial_stiffness, beam.beyond[0]},
              {beam.section, beam.axial_stiffness, beam.beyond[1]}}}
  {
    for (unsigned int k = 0; k < 2; ++k)
      {
        rest_at(k == 0 ? UpAndSlope{1., 0.} : UpAndSlope{0., 1.});
        const UpAndSlope force = present_force();
        stiffness[0][k]        = -force.up;
        stiffness[1][k]        = -force.slope;
      }
    place();
  }


  TrackBeyond::AtSection BaseOnBeam::at_end(const unsigned int end, const UpAndSlope &middle) const
  {
    return {0., middle.up + side(end) * 0.5 * beam.length * middle.slope, side(end) * middle.slope};
  }


  BaseOnBeam::UpAndSlope BaseOnBeam::on_middle(const TrackBeyond::AtSection &low,
                                               const TrackBeyond::AtSection &high) const
  {
    return {low.up + high.up, high.slope - low.slope + 0.5 * beam.length * (high.up - low.up)};
  }


  BaseOnBeam::UpAndSlope BaseOnBeam::present_force() const
  {
    return on_middle(tracks[0].present_force_on_section(), tracks[1].present_force_on_section());
  }


  BaseOnBeam::UpAndSlope BaseOnBeam::at_rest(const UpAndSlope &load) const
  {
    const auto  &K           = stiffness;
    const double determinant = K[0][0] * K[1][1] - K[0][1] * K[1][0];
    return {(K[1][1] * load.up - K[0][1] * load.slope) / determinant,
            (K[0][0] * load.slope - K[1][0] * load.up) / determinant};
  }


  void BaseOnBeam::rest_at(const UpAndSlope &displacement)
  {
    for (unsigned int end = 0; end < 2; ++end)
      tracks[end].set_at_rest(at_end(end, displacement));
  }


  void BaseOnBeam::move_slowly()
  {
    for (unsigned int end = 0; end < 2; ++end)
      tracks[end].follow_slowly(at_end(end, state.velocity));
  }


  void BaseOnBeam::place()
  {
    state = State();
    rest_at(UpAndSlope());
  }


  void BaseOnBeam::find_forces()
  {
    for (TrackBeyond &track : tracks)
      track.find_forces();
  }


  void BaseOnBeam::advance(const Load &load, const double time_step)
  {
    const UpAndSlope of_cells{load.force[2], load.moment};
    if (!state.begun)
      {
        rest_at(at_rest(of_cells));
        move_slowly();
        find_forces();
        state.energy_at_rest = energy_of_springs();
        state.begun          = true;
      }
    const UpAndSlope of_track = on_middle(tracks[0].force_on_section(), tracks[1].force_on_section());
    state.velocity.up += time_step / beam.mass * (of_cells.up + of_track.up);
    state.velocity.slope += time_step / inertia * (of_cells.slope + of_track.slope);
    state.displacement.up += time_step * state.velocity.up;
    state.displacement.slope += time_step * state.velocity.slope;
    for (unsigned int end = 0; end < 2; ++end)
      tracks[end].advance(at_end(end, state.velocity), time_step);
  }


  bool BaseOnBeam::follow(const double load, const double speed)
  {
    // At rest its displacement is linear in the moment of the load about its middle.
    state.velocity = at_rest({0., load * speed});
    move_slowly();
    return true;
  }


  double BaseOnBeam::stiffness_over_mass() const
  {
    double of_base[2] = {0., 0.}, largest = 0.;
    for (const TrackBeyond &track : tracks)
      {
        const TrackBeyond::AtSection rows = track.stiffness_of_section();
        const double                 arm  = 0.5 * beam.length;
        of_base[0] += rows.up * (1. + arm) + rows.slope;
        of_base[1] += rows.slope + arm * rows.slope + arm * rows.up * (1. + arm);
        // The slope of the base moves the sections as well.
        largest = std::max(largest, (1. + arm) * track.stiffness_over_mass());
      }
    return std::max({largest, of_base[0] / beam.mass, of_base[1] / inertia});
  }


  double BaseOnBeam::damping_over_mass() const
  {
    return std::max(tracks[0].damping_over_mass(), tracks[1].damping_over_mass());
  }


  double BaseOnBeam::kinetic_energy(const double time_step) const
  {
    // With the product of the velocities half a step before and after now, of the springs' forces alone.
    const UpAndSlope &v = state.velocity, force = present_force();
    return 0.5 * (v.up * (beam.mass * v.up + time_step * force.up) +
                  v.slope * (inertia * v.slope + time_step * force.slope)) +
           tracks[0].kinetic_energy(time_step) + tracks[1].kinetic_energy(time_step);
  }


  double BaseOnBeam::energy_of_springs() const
  {
    return tracks[0].spring_energy() + tracks[1].spring_energy();
  }


  double BaseOnBeam::spring_energy() const
  {
    return energy_of_springs() - state.energy_at_rest;
  }


  double BaseOnBeam::dissipated() const
  {
    return tracks[0].dissipated() + tracks[1].dissipated();
  }


  void BaseOnBeam::serialize(Archive &archive)
  {
    archive.same(state.displacement, state.velocity, state.begun, state.energy_at_rest);
    for (TrackBeyond &track : tracks)
      track.serialize(archive);
  }
} // namespace tread
