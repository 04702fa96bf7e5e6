// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/base/reproducible_sum.h>
#include <tread/dynamics/parts/rail_on_beam.h>
#include <tread/solid/hexahedron.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>

namespace tread
{
  namespace
  {
    /// Share of the beam's mass and stiffness that is left to it where cells stand: lighter ones could need
    /// shorter steps, and the stiffness of cells is not quite that of a beam.
    constexpr double least_left = 0.25;

    /// m: by which a load is moved to find how the deflection follows it.
    constexpr double small_way = 1e-3;

    /// Mean of the square of z over a cell that is nearly a box, m^2: by the mass matrix of its corners.
    double mean_square(const std::array<dealii::Point<3>, 8> &corners, const double bottom)
    {
      double sum = 0.;
      for (unsigned int a = 0; a < 8; ++a)
        for (unsigned int b = 0; b < 8; ++b)
          sum +=
            (corners[a][2] - bottom) * (corners[b][2] - bottom) / 27. / (1 << std::bitset<3>(a ^ b).count());
      return sum;
    }

    /// The least z of the nodes that the beam carries, m. Collective.
    double bottom_of(const Mesh &mesh, const std::vector<unsigned int> &carried)
    {
      double lowest = std::numeric_limits<double>::max();
      for (const unsigned int i : carried)
        lowest = std::min(lowest, mesh.nodes[i][2]);
      return dealii::Utilities::MPI::min(lowest, mesh.comm);
    }

    void check_what_is_left(const BeamUnderRail          &beam,
                            const double                  from,
                            const double                  to,
                            const reference::BeamSection &cells)
    {
      const reference::BeamSection &whole = section_between(beam.section, beam.track.stretches, from, to);
      const auto                    check = [&](const char *parameter, const char *column, const double has,
                             const double in_cells) {
        require(
                             in_cells <= (1. - least_left) * has,
                             format(
                               "%s %g at x = %.0f mm: of it the meshed piece of the rail alone has %.3g, so that at least %.3g "
                                                  "is needed; mesh a lower or narrower piece where the whole rail has less",
            &whole == &beam.section ? parameter : column, has, 1e3 * (beam.begin + 0.5 * (from + to)),
                               in_cells, in_cells / (1. - least_left)));
      };
      check("'Track/Beam mass (kg per m)'", "'Track/Beam file': mass_kg_per_m", whole.mass, cells.mass);
      check("'Track/Beam bending stiffness (MN m2)'", "'Track/Beam file': bending_stiffness_MN_m2",
            1e-6 * whole.bending_stiffness, 1e-6 * cells.bending_stiffness);
    }

    /// Cells bend with the beam from about their height away from a free end on, where nothing holds them
    /// along the beam. @param places of the elements' ends, m @param height of the cells, m
    void fade_to_free_ends(std::vector<reference::BeamSection> &cells,
                           const std::vector<double>           &places,
                           const double                         height)
    {
      double largest = 0.;
      for (const reference::BeamSection &of_element : cells)
        largest = std::max(largest, of_element.bending_stiffness);
      const double rise = largest / height;
      const auto   grow = [&](const std::size_t e, const std::size_t beside) {
        const double apart = 0.5 * std::abs(places[e] + places[e + 1] - places[beside] - places[beside + 1]);
        cells[e].bending_stiffness =
          std::min(cells[e].bending_stiffness, cells[beside].bending_stiffness + rise * apart);
      };
      for (std::size_t e = 1; e < cells.size(); ++e)
        grow(e, e - 1);
      for (std::size_t e = cells.size() - 1; e-- > 0;)
        grow(e, e + 1);
    }

    /// The beam without the mass of the cells that move by themselves and without their stiffness as they
    /// bend about their bottom, which it holds. @param carried nodes. Collective.
    BeamUnderRail without_cells(const PartOf                    &of,
                                BeamUnderRail                    beam,
                                const unsigned int               body,
                                const std::vector<unsigned int> &carried,
                                const double                     bottom)
    {
      const Mesh               &mesh   = of.mesh;
      const std::vector<double> places = beam_nodes(beam.track).places;
      const std::size_t         n      = places.size() - 1;
      // What nodes that the beam carries would weigh does not act.
      std::vector<double> moves(mesh.nodes.size(), 1.);
      for (const unsigned int i : carried)
        moves[i] = 0.;
      for (const Mesh::HangingNode &h : mesh.hanging_nodes)
        {
          moves[h.node] = 0.;
          for (const unsigned int parent : h.parents)
            moves[h.node] += Mesh::HangingNode::weight * moves[parent];
        }
      std::vector<ReproducibleSum<double>> mass(n), bending(n); // times lengths: kg, N m^3
      double                               height = 0.;         // of the cells over their bottom, m
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        if (mesh.cells[c].body == body)
          {
            const auto                corners = mesh.corners(c);
            const HexahedronIntegrals cell(corners);
            double                    moving = 0., from = corners[0][0], to = from;
            for (unsigned int a = 0; a < 8; ++a)
              {
                moving += moves[mesh.cells[c].nodes[a]] * cell.node_volume[a];
                height = std::max(height, corners[a][2] - bottom);
                from   = std::min(from, corners[a][0]);
                to     = std::max(to, corners[a][0]);
              }
            const ElasticMaterial &material = of.solid.material_of(mesh.cells[c]);
            const double           square   = cell.volume * mean_square(corners, bottom);
            for (std::size_t e = 0; e < n; ++e)
              if (const double share =
                    (std::min(to - beam.begin, places[e + 1]) - std::max(from - beam.begin, places[e])) /
                    (to - from);
                  share > 0.)
                {
                  mass[e].add(share * material.density * moving);
                  bending[e].add(share * material.young_modulus * square);
                }
          }
      LoadedPart &loaded = beam.track.loaded;
      loaded.cells.assign(n, reference::BeamSection());
      for (std::size_t e = 0; e < n; ++e)
        if (places[e + 1] > loaded.from && places[e] < loaded.to)
          {
            const double length               = places[e + 1] - places[e];
            loaded.cells[e].mass              = mass[e].value(mesh.comm) / length;
            loaded.cells[e].bending_stiffness = bending[e].value(mesh.comm) / length;
          }
      fade_to_free_ends(loaded.cells, places, dealii::Utilities::MPI::max(height, mesh.comm));
      for (std::size_t e = 0; e < n; ++e)
        check_what_is_left(beam, places[e], places[e + 1], loaded.cells[e]);
      return beam;
    }

    TrackBeam track_of(const BeamUnderRail &beam)
    {
      return {beam.section, beam.axial_stiffness, beam.track};
    }
  } // namespace


  RailOnBeam::RailOnBeam(const PartOf &part_of, const BeamUnderRail &beam, const unsigned int body)
    : of(part_of)
    , whole(beam)
    , body(body)
    , nodes(of.mesh.boundary_nodes(body, Boundary::support))
    , bottom(bottom_of(of.mesh, nodes))
    , track(track_of(without_cells(part_of, beam, body, nodes, bottom)))
  {
    for (const unsigned int i : nodes)
      places.push_back(place_of(of.mesh.nodes[i][0]));
  }


  TrackBeam::AtSection RailOnBeam::since_start(const TrackBeam::Place &place) const
  {
    TrackBeam::AtSection at = track.displacement_at(place);
    if (begun)
      for (unsigned int k = 0; k < 4; ++k)
        {
          const double before = rest[place.first + k];
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
          double                 *of_two = sums + at.first;
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
            rates[at.first + k] += share * at.up[k];
        }
    // The cells follow with the beam, and resist as they will.
    TrackBeam of_both = track_of(whole);
    of_both.follow_loads(rates.data());
    track.move_as(of_both);
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
