// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_parts_supports_h
#define tread_dynamics_parts_supports_h

#include <tread/dynamics/part.h>
#include <tread/dynamics/rail_beam.h>
#include <tread/track/supports.h>

#include <vector>

namespace tread
{
  /// A rail on discrete supports.
  class RailOnSupports : public Part
  {
  public:
    /// @param rail_material a beam of it is used to find the equilibrium at the start, with the track
    /// @param beyond its ends if there is one: @see RailOnTrackBeyond. Collective.
    RailOnSupports(const PartOf          &part_of,
                   Supports              &supports,
                   const ElasticMaterial &rail_material,
                   const TrackBeyondBoth &beyond = {});

    std::vector<unsigned int> nodes_of_every_step() const override
    {
      return supports.nodes();
    }
    void add_forces(NodalField &force) override
    {
      supports.add_forces(force.data());
    }
    std::size_t n_sums() const override
    {
      return supports.n_points();
    }
    void set_sums(const State               &state,
                  const std::vector<double> &inverse_mass,
                  double                    *velocities) const override
    {
      supports.predict(state.v.data(), state.force.data(), inverse_mass, state.time_step, velocities);
    }
    void advance(Step &step, const double *velocities) override
    {
      supports.advance(velocities, step.state.time_step);
    }
    void add_row_sums(NodalField &rows) const override
    {
      supports.add_row_sums(rows.data());
    }
    OwnRates own_rates(const NodeLevels &) const override;
    void     add_spring_forces(NodalField &force) const override
    {
      supports.add_spring_forces(force.data());
    }
    double kinetic_energy(const double time_step) const override
    {
      return supports.sleeper_kinetic_energy(time_step);
    }
    double spring_energy() const override
    {
      return supports.spring_energy();
    }
    double potential(const double time_step) const override
    {
      return supports.weight_potential(time_step);
    }
    double dissipated() const override
    {
      return supports.dissipated();
    }
    void set_at_rest(const State &state) override
    {
      supports.set_at_rest(state.x_damped.data());
    }
    std::vector<SoftBody> soft_bodies(const State &) const override;
    std::vector<double>   follow(State                                   &state,
                                 const std::vector<MovingLoad>           &loads,
                                 const std::function<void(NodalField &)> &constrain) override;
    void                  serialize(Archive &archive) override
    {
      supports.serialize(archive);
    }

  private:
    Supports      &supports;
    const RailBeam beam;
  };
} // namespace tread

#endif
