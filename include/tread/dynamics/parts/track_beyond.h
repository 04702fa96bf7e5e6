// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_parts_track_beyond_h
#define tread_dynamics_parts_track_beyond_h

#include <tread/dynamics/part.h>
#include <tread/material/elastic.h>
#include <tread/track/track_beam.h>

#include <array>
#include <memory>
#include <vector>

namespace tread
{
  struct SumsOfTrackBeyond
  {
    double along, up, slope, yaw; ///< velocities of the section, m/s and rad/s
  };

  /// The track beyond both ends of a rail of cells (@see TrackBeam). A section of cells that ends there
  /// moves as its mean does: displacement and rotation weighted with the nodes' masses (those of Cowper 1966
  /// for a beam), by which it passes its forces on; it may warp and bulge. It is kept from turning about the
  /// vertical by the bending stiffness of a continuous beam that rests on the supports across; across and
  /// about the rail's axis nothing acts on it.
  class RailOnTrackBeyond : public PartWithSums<std::array<SumsOfTrackBeyond, 2>>
  {
  public:
    /// @param beyond behind the end of lowest and of highest x. Collective.
    /// @throws InputError if cells of an end are refined
    RailOnTrackBeyond(const PartOf                             &part_of,
                      const unsigned int                        rail_body,
                      const ElasticMaterial                    &rail,
                      const std::array<TrackBeamParameters, 2> &beyond);

    std::vector<unsigned int> nodes_of_every_step() const override;
    void                      add_forces(NodalField &force) override;
    void                      add_row_sums(NodalField &rows) const override;
    OwnRates                  own_rates(const NodeLevels &levels) const override;
    void                      add_spring_forces(NodalField &force) const override;
    double                    kinetic_energy(const double time_step) const override;
    double                    spring_energy() const override;
    double                    potential(const double time_step) const override;
    double                    dissipated() const override;
    void                      set_at_rest(const State &state) override;
    /// With the velocities of the sections that what bends has set.
    std::vector<double> follow(State                                   &state,
                               const std::vector<MovingLoad>           &loads,
                               const std::function<void(NodalField &)> &constrain) override;
    void                serialize(Archive &archive) override;

  protected:
    std::array<SumsOfTrackBeyond, 2> sums_of_rank(const State &state) const override;
    void advance_with(Step &step, const std::array<SumsOfTrackBeyond, 2> &sums) override;

  private:
    struct Node
    {
      unsigned int number;
      double       mass; ///< kg
      /// Share of its displacement along the rail in the rotations of the section: least squares, weighted
      /// with the masses, 1/m.
      double pitch = 0., yaw = 0.;
    };
    struct End
    {
      double                     side;                                     ///< 1: at highest x, -1
      std::vector<Node>          nodes;                                    ///< this rank's own
      double                     mass            = 0.;                     ///< of the section, kg
      double                     pitch_by_moment = 0., yaw_by_moment = 0.; ///< 1/(kg m^2)
      double                     yaw_stiffness = 0.;                       ///< N m
      std::unique_ptr<TrackBeam> track;
      double                     yaw = 0.; ///< rad
    };
    /// This rank's share of the section's mean of a nodal vector. @param of_node its value on a node
    template <typename OfNode>
    SumsOfTrackBeyond mean(const End &end, const Quantum quantum, const OfNode &of_node) const;
    /// The same of all ranks for both ends. Collective.
    template <typename OfNode>
    std::array<SumsOfTrackBeyond, 2> means(const Quantum quantum, const OfNode &of_node) const;
    TrackBeam::AtSection             outwards(const End &end, const SumsOfTrackBeyond &of_section) const
    {
      return {end.side * of_section.along, of_section.up, end.side * of_section.slope};
    }
    void give(const End &end, const TrackBeam::AtSection &force_outwards, NodalField &force) const;

    const PartOf       of;
    const unsigned int body;
    std::array<End, 2> ends;
  };
} // namespace tread

#endif
