// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/flexible_axle.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  void FlexibleAxle::place()
  {
    state = State();
  }


  FlexibleAxle::OfSides<FlexibleAxle::Tilt> FlexibleAxle::unbalanced(const OfSides<Tilt> &outside)
  {
    if (!bends())
      return {};
    if (!state.held)
      state.held =
        OfSides<Tilt>{{{-outside[own].x, -outside[own].z}, {-outside[other].x, -outside[other].z}}};
    const double  stiffness = *parameters.bending_stiffness / parameters.half_length; // 2 E I / L
    OfSides<Tilt> moments;
    for (const Side side : {own, other})
      {
        const Side opposite = side == own ? other : own;
        const auto moment   = [&](double Tilt::*about) {
          const auto deflection = [&](const Side of) {
            return state.tilts[of].*about + parameters.damping_time * state.tilt_rates[of].*about;
          };
          return (*state.held)[side].*about - stiffness * (2. * deflection(side) + deflection(opposite));
        };
        state.last[side] = {moment(&Tilt::x), moment(&Tilt::z)};
        moments[side]    = {outside[side].x + state.last[side].x, outside[side].z + state.last[side].z};
      }
    return moments;
  }


  void FlexibleAxle::advance(const OfSides<Tilt>   &moments,
                             const OfSides<double> &torques,
                             const Tilt             of_chord,
                             const double           inertia,
                             const double           time_step)
  {
    const auto count = [&](const double moment, const double before, const double after) {
      const double work = 0.5 * time_step * moment * (before + after);
      state.work += work;
      state.gross += std::abs(work);
    };
    if (twists())
      {
        const double outside = 0.5 * (torques[own] - torques[other]), before = state.twist_rate;
        if (!state.held_torque)
          state.held_torque = -outside;
        const double torque =
          *state.held_torque -
          *parameters.torsional_stiffness * (state.twist + parameters.damping_time * state.twist_rate);
        state.twist_rate += time_step * 2. * (outside + torque) / inertia;
        state.twist += time_step * state.twist_rate;
        count(torque, before, state.twist_rate);
      }
    if (bends())
      for (const Side side : {own, other})
        for (double Tilt::*about : {&Tilt::x, &Tilt::z})
          {
            double      &rate   = state.tilt_rates[side].*about;
            const double before = rate;
            rate += time_step * (moments[side].*about / about_diameter(inertia) - of_chord.*about);
            state.tilts[side].*about += time_step * rate;
            count(state.last[side].*about, before, rate);
          }
  }


  double FlexibleAxle::kinetic_energy(const Tilt of_chord, const double inertia) const
  {
    // A wheel's share of the twist is half of it.
    double energy = 0.25 * inertia * state.twist_rate * state.twist_rate;
    for (const Tilt &rate : state.tilt_rates)
      energy += about_diameter(inertia) *
                (of_chord.x * rate.x + of_chord.z * rate.z + 0.5 * (rate.x * rate.x + rate.z * rate.z));
    return energy;
  }


  double FlexibleAxle::largest_frequency(const double inertia, const double of_chord) const
  {
    // Both wheels bend it into an S, against which the chord turns, or twist it.
    const double bent    = bends() ? 3. * *parameters.bending_stiffness / parameters.half_length : 0.,
                 twisted = twists() ? 2. * *parameters.torsional_stiffness : 0.;
    return std::sqrt(std::max(bent * (1. / about_diameter(inertia) + 2. / of_chord), twisted / inertia));
  }


  void FlexibleAxle::serialize(Archive &archive)
  {
    archive.same(state);
  }
} // namespace tread
