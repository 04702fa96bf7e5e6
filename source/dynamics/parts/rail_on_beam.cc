// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/base/reproducible_sum.h>
#include <tread/dynamics/parts/rail_on_beam.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread
{
  namespace
  {
    /// Share of the beam's mass that is left to it where cells stand: lighter ones could need shorter steps.
    constexpr double least_mass = 0.25;

    /// m: by which a load is moved to find how the deflection follows it.
    constexpr double small_way = 1e-3;

    /// The beam without the mass of the cells that move by themselves. Collective.
    BeamUnderRail without_cells(const PartOf &of, BeamUnderRail beam, const unsigned int body)
    {
      ReproducibleSum<double> sum;
      for (unsigned int i = 0; i < of.mesh.nodes.size(); ++i)
        if (of.mesh.node_bodies[i] == body && of.mesh.shared_nodes.is_owned(i))
          sum.add(of.true_mass[i]);
      // What nodes that the beam carries would weigh does not act.
      for (const unsigned int i : of.mesh.boundary_nodes(body, Boundary::support))
        if (of.mesh.shared_nodes.is_owned(i))
          sum.add(-of.true_mass[i]);
      LoadedPart  &loaded = beam.track.loaded;
      const double length = loaded.to - loaded.from;
      loaded.cells        = sum.value(of.mesh.comm);
      require(loaded.cells <= (1. - least_mass) * beam.section.mass * length,
              format("'Track/Beam mass (kg per m)' %g: the meshed piece of the rail has %.3g kg, so that at "
                     "least %g kg/m are needed",
                     beam.section.mass, loaded.cells, std::ceil(loaded.cells / (1. - least_mass) / length)));
      return beam;
    }

    TrackBeam track_of(const BeamUnderRail &beam)
    {
      return {beam.section, beam.axial_stiffness, beam.track};
    }
  } // namespace


  RailOnBeam::RailOnBeam(const PartOf &part_of, const BeamUnderRail &beam, const unsigned int body)
    : of(part_of)
    , body(body)
    , nodes(of.mesh.boundary_nodes(body, Boundary::support))
    , begin(beam.begin)
    , track(track_of(without_cells(part_of, beam, body)))
  {
    double lowest = std::numeric_limits<double>::max();
    for (const unsigned int i : nodes)
      {
        places.push_back(place_of(of.mesh.nodes[i][0]));
        lowest = std::min(lowest, of.mesh.nodes[i][2]);
      }
    bottom = dealii::Utilities::MPI::min(lowest, of.mesh.comm);
  }


  TrackBeam::AtSection RailOnBeam::since_start(const TrackBeam::Place &place) const
  {
    TrackBeam::AtSection at = track.displacement_at(place);
    if (begun)
      for (unsigned int k = 0; k < 4; ++k)
        {
          const double before = rest[2 * (place.node - track.first_loaded_node()) + k];
          at.up -= place.up[k] * before;
          at.slope -= place.slope[k] * before;
        }
    return at;
  }


  TrackBeam::AtSection RailOnBeam::displacement_at(const double x) const
  {
    return since_start(place_of(x));
  }


  void RailOnBeam::place()
  {
    const std::vector<double> none(n_sums(), 0.);
    track.set_loads(none.data());
    track.set_at_rest({});
    begun          = false;
    energy_at_rest = 0.;
  }


  void RailOnBeam::set_sums(const State &state, const std::vector<double> &, double *sums) const
  {
    std::fill_n(sums, n_sums(), 0.);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (const unsigned int i = nodes[n]; of.mesh.shared_nodes.is_owned(i))
        {
          const TrackBeam::Place &at     = places[n];
          const double            up     = state.force[i][2];
          const double            moment = -state.force[i][0] * (of.mesh.nodes[i][2] - bottom);
          double                 *of_two = sums + 2 * (at.node - track.first_loaded_node());
          for (unsigned int k = 0; k < 4; ++k)
            of_two[k] += of.quanta.on_hubs.round(at.up[k] * up + at.slope[k] * moment);
        }
  }


  void RailOnBeam::advance(Step &step, const double *sums)
  {
    track.set_loads(sums);
    if (!begun)
      {
        track.take_loads_at_rest();
        rest           = track.displacements_of_loaded();
        energy_at_rest = track.spring_energy();
        begun          = true;
        track.find_forces();
      }
    track.advance({}, step.state.time_step);
  }


  void RailOnBeam::place_nodes(State &state) const
  {
    for (std::size_t n = 0; n < nodes.size(); ++n)
      {
        const unsigned int      i = nodes[n];
        const dealii::Point<3> &p = of.mesh.nodes[i];
        state.v[i]                = of_node(i, track.velocity_at(places[n]));
        state.set_position(i, Vector3{p[0], p[1], p[2], 0.} + of_node(i, since_start(places[n])));
      }
  }


  std::vector<double> RailOnBeam::follow(State                         &state,
                                         const std::vector<MovingLoad> &loads,
                                         const std::function<void(NodalField &)> &)
  {
    std::vector<double> rates(n_sums(), 0.);
    for (const MovingLoad &load : loads)
      for (const double side : {-1., 1.})
        {
          const TrackBeam::Place at    = place_of(load.x + side * small_way);
          const double           share = side * load.force * load.velocity_x / (2. * small_way);
          for (unsigned int k = 0; k < 4; ++k)
            rates[2 * (at.node - track.first_loaded_node()) + k] += share * at.up[k];
        }
    track.follow_loads(rates.data());
    for (unsigned int i = 0; i < state.v.size(); ++i)
      if (of.mesh.node_bodies[i] == body)
        state.v[i] += of_node(i, track.velocity_at(place_of(of.mesh.nodes[i][0])));
    std::vector<double> up;
    for (const MovingLoad &load : loads)
      up.push_back(track.velocity_at(place_of(load.x)).up);
    return up;
  }


  void RailOnBeam::serialize(Archive &archive)
  {
    archive.same(begun, energy_at_rest);
    rest.resize(n_sums());
    archive.same_number(rest);
    track.serialize(archive);
  }
} // namespace tread
