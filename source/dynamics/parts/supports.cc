// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/parts/supports.h>

namespace tread
{
  namespace
  {
    /// Half of the distance over which the deflection under the moving load is differentiated, m: short
    /// against the bending of a rail between two sleepers, and long enough that the difference of two
    /// deflections has more than ten digits.
    constexpr double half_way = 1e-3;

    std::vector<reference::SupportedBeam::Load> on_beam(const std::vector<MovingLoad> &loads,
                                                        const double                   way)
    {
      std::vector<reference::SupportedBeam::Load> on_beam;
      for (const MovingLoad &load : loads)
        on_beam.push_back({load.x + way, load.force});
      return on_beam;
    }
  } // namespace


  RailOnSupports::RailOnSupports(const PartOf          &of,
                                 Supports              &supports,
                                 const ElasticMaterial &rail_material,
                                 const TrackBeyondBoth &beyond)
    : supports(supports)
    , beam(of.mesh, of.solid, supports, rail_material, beyond)
  {
    supports.set_gravity(of.parameters.gravity);
    supports.set_quanta(of.quanta.force, of.quanta.stiffness);
  }


  Part::OwnRates RailOnSupports::own_rates(const NodeLevels &) const
  {
    OwnRates rates;
    supports.sleeper_row_sums(rates.stiffness, rates.damping);
    return rates;
  }


  std::vector<SoftBody> RailOnSupports::soft_bodies(const State &) const
  {
    std::vector<SoftBody> bodies{{supports.rail_body, SoftBody::Shape::line}};
    for (const auto &sleeper : supports.solid_sleepers)
      bodies.push_back({sleeper.body, SoftBody::Shape::piece});
    return bodies;
  }


  std::vector<double> RailOnSupports::follow(State                                   &state,
                                             const std::vector<MovingLoad>           &loads,
                                             const std::function<void(NodalField &)> &constrain)
  {
    // How the deflection changes while the loads move by a small way, over the time that takes.
    const RailBeam::Field before = beam.balance(on_beam(loads, -half_way)),
                          after  = beam.balance(on_beam(loads, half_way));
    const double rate            = 0.5 * loads.front().velocity_x / half_way;
    beam.add(after, rate, state.v.data());
    beam.add(before, -rate, state.v.data());
    std::vector<double> up;
    for (const MovingLoad &load : loads)
      up.push_back(
        rate * (after.rail.deflection(load.x + half_way) - before.rail.deflection(load.x - half_way)).real());
    constrain(state.v);
    std::vector<double> sleepers(after.sleepers.size());
    for (unsigned int s = 0; s < sleepers.size(); ++s)
      sleepers[s] = rate * (after.sleepers[s] - before.sleepers[s]);
    supports.set_velocities(state.v.data(), sleepers);
    return up;
  }
} // namespace tread
