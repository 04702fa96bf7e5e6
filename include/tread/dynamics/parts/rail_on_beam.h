// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_parts_rail_on_beam_h
#define tread_dynamics_parts_rail_on_beam_h

#include <tread/dynamics/part.h>
#include <tread/track/track_beam.h>

#include <functional>
#include <vector>

namespace tread
{
  /// A piece of a rail whose bottom is bonded to a beam on pads, sleepers and ballast, which with the
  /// cells has the mass and the stiffness of the whole rail: so the rail bends and has its waves at the price
  /// of the cells under the wheel. The bottom moves up with the beam and turns with its cross-sections; along
  /// and across it is held. The track is at rest under the load with which the motion begins, and
  /// displacements count from there.
  class RailOnBeam : public Part
  {
  public:
    /// @param body whose support nodes the beam carries. Collective.
    /// @throws InputError if the beam has too little mass or stiffness beside the cells
    RailOnBeam(const PartOf &part_of, const BeamUnderRail &beam, const unsigned int body);

    /// Displacement since the start (m, rad) at x within the rail.
    TrackBeam::AtSection displacement_at(const double x) const;
    /// Go back to the reference position: the next motion begins with another load.
    void place();

    std::vector<unsigned int> carried_nodes() const override
    {
      return nodes;
    }
    void add_forces(NodalField &) override
    {
      track.find_forces();
    }
    std::size_t n_sums() const override
    {
      return 2 * track.n_loaded();
    }
    void     set_sums(const State &state, const std::vector<double> &, double *sums) const override;
    void     advance(Step &step, const double *sums) override;
    void     place_nodes(State &state) const override;
    OwnRates own_rates(const NodeLevels &) const override
    {
      return {track.stiffness_over_mass(), track.damping_over_mass()};
    }
    double kinetic_energy(const double time_step) const override
    {
      return track.kinetic_energy(time_step);
    }
    double spring_energy() const override ///< over that at rest under the load at the start
    {
      return track.spring_energy() - energy_at_rest;
    }
    double dissipated() const override
    {
      return track.dissipated();
    }
    std::vector<double> follow(State                                   &state,
                               const std::vector<MovingLoad>           &loads,
                               const std::function<void(NodalField &)> &constrain) override;
    void                serialize(Archive &archive) override;

  private:
    TrackBeam::Place place_of(const double x) const
    {
      return track.place(x - whole.begin);
    }
    /// Displacement or velocity of a node from those of the beam at its place.
    Vector3 of_node(const unsigned int node, const TrackBeam::AtSection &beam) const
    {
      return Vector3{-beam.slope * (of.mesh.nodes[node][2] - bottom), 0., beam.up, 0.};
    }
    TrackBeam::AtSection since_start(const TrackBeam::Place &place) const;

    const PartOf                  of;
    const BeamUnderRail           whole; ///< with what the cells have
    const unsigned int            body;
    std::vector<unsigned int>     nodes;
    std::vector<TrackBeam::Place> places; ///< of these nodes
    const double                  bottom; ///< least z of the nodes, m
    TrackBeam                     track;
    std::vector<double>           rest; ///< up and slope of the beam's nodes under the load at the start
    bool                          begun          = false; ///< that load is known
    double                        energy_at_rest = 0.;    ///< J
  };
} // namespace tread

#endif
