// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_track_rail_h
#define tread_tests_track_rail_h

#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>
#include <tread/dynamics/parts/supports.h>
#include <tread/dynamics/parts/track_beyond.h>
#include <tread/mesh/sleeper_body.h>
#include <tread/mesh/whole_rail.h>
#include <tread/reference/supported_beam.h>

#include "boxes.h"

#include <cmath>
#include <map>
#include <memory>
#include <vector>

namespace tread::tests
{
  /// A rail of cells and the same rail as a beam, from -n/2 to n/2 spacings of supports, the rail top at z =
  /// 0.
  struct RailForTrack
  {
    Body                   body;
    reference::BeamSection section;
    double                 height; ///< m
  };

  constexpr double spacing = 0.6; ///< of supports, m

  inline ElasticMaterial steel()
  {
    return {210e9, 0.3, 7850.};
  }

  inline ElasticMaterial concrete()
  {
    return {38.4e9, 0.2, 2520.};
  }

  inline reference::BeamSection beam_section(const double area,
                                             const double second_moment,
                                             const double shear_coefficient)
  {
    reference::BeamSection s;
    s.bending_stiffness = steel().young_modulus * second_moment;
    s.shear_stiffness   = shear_coefficient * steel().shear_modulus() * area;
    s.mass              = steel().density * area;
    s.rotary_inertia    = steel().density * second_moment;
    return s;
  }

  /// A bar of 60 x 150 mm, near a rail in area and stiffness. Shear coefficient of a rectangle (Cowper 1966).
  inline RailForTrack bar(const unsigned int n_supports, const unsigned int cells_per_span)
  {
    constexpr double width = 0.06, height = 0.15, nu = 0.3;
    const double     end = 0.5 * spacing * n_supports;
    return {
      make_box("rail", dealii::Point<3>(-end, -0.5 * width, -height), dealii::Point<3>(end, 0.5 * width, 0.),
               {{n_supports * cells_per_span, 2, 6}},
               {{tests::Side::left, Boundary::end},
                {tests::Side::right, Boundary::end},
                {tests::Side::bottom, Boundary::support}}),
      beam_section(width * height, width * std::pow(height, 3) / 12., 10. * (1. + nu) / (12. + 11. * nu)),
      height};
  }

  /// The full section; a cross-section of nodes lies at x. The shear coefficient of flat-bottom rails
  /// is about 0.4.
  inline RailForTrack full_section(const RailProfile &profile,
                                   const unsigned int n_supports,
                                   const double       cell_size,
                                   const double       row,
                                   const double       x)
  {
    WholeRail rail;
    rail.x_end              = 0.5 * spacing * n_supports;
    rail.x_begin            = -rail.x_end;
    rail.coarsest_cell_size = cell_size;
    rail.longest_row        = row;
    FineZone zone;
    zone.finest_cell_size = cell_size;
    zone.x_begin          = x - cell_size;
    zone.x_end            = x + cell_size;
    zone.half_width       = 0.5 * cell_size;
    zone.depth            = 0.5 * cell_size;
    return {make_whole_rail(profile, rail, zone),
            beam_section(profile.section().area, profile.section().inertia_y, 0.4), profile.height()};
  }

  /// Force (N) of a blow that rises and falls within 800 steps.
  inline double blow(const unsigned int step)
  {
    return step < 400 ? 5e3 * step : step < 800 ? 5e3 * (800 - step) : 0.;
  }

  /// A rail on supports that begin and end half a spacing from its symmetric ends; the middle support is at
  /// x = 0.
  struct TrackRail
  {
    const reference::BeamSection      section;
    const double                      height, end; ///< of the rail, and x of its end (m)
    std::vector<double>               positions;
    std::unique_ptr<Mesh>             mesh;
    std::unique_ptr<Solid>            solid;
    std::unique_ptr<ExplicitDynamics> dynamics;
    NodeLoads                        *loads;
    std::unique_ptr<Supports>         supports;

    TrackRail(const MPI_Comm             comm,
              const RailForTrack        &rail,
              const unsigned int         n_supports,
              const TrackParameters     &track,
              const DynamicsParameters  &parameters,
              const std::vector<double> &probes,
              const bool                 solid_sleepers = false,
              const unsigned int         max_level      = 0,
              const double               sleeper_cell   = SleeperBox().coarsest_cell_size,
              const TrackBeyondBoth     &beyond         = {})
      : section(rail.section)
      , height(rail.height)
      , end(0.5 * spacing * n_supports)
    {
      const int half = n_supports / 2;
      for (int i = -half; i <= half; ++i)
        positions.push_back(spacing * i);
      std::vector<Body>            bodies{rail.body};
      std::vector<ElasticMaterial> materials{steel()};
      std::vector<SolidSleeper>    sleepers;
      if (solid_sleepers)
        for (const double x : positions)
          {
            SleeperBox box         = sleeper_box(x);
            box.coarsest_cell_size = sleeper_cell;
            sleepers.push_back({static_cast<unsigned int>(bodies.size()), box.y_begin, box.y_end, box.width});
            bodies.push_back(make_sleeper(box));
            materials.push_back(concrete());
          }
      SolidParameters solid_parameters;
      solid_parameters.max_level = max_level;
      mesh                       = std::make_unique<Mesh>(comm, bodies);
      solid                      = std::make_unique<Solid>(*mesh, materials, solid_parameters);
      dynamics                   = std::make_unique<ExplicitDynamics>(*mesh, *solid, parameters);
      supports                   = std::make_unique<Supports>(*mesh, 0, positions, track, sleepers);
      for (const double x : probes)
        supports->add_probe(x);
      dynamics->add<RailOnSupports>(*supports, steel(), beyond);
      if (beyond)
        dynamics->add<RailOnTrackBeyond>(0, steel(), *beyond);
      else
        dynamics->guide_nodes(dynamics->boundary_nodes(0, Boundary::end), 0);
      dynamics->guide_nodes(supports->guided_nodes(1), 1);
      for (const SolidSleeper &sleeper : sleepers)
        dynamics->guide_nodes(dynamics->boundary_nodes(sleeper.body, Boundary::end), 1);
      if (solid_sleepers)
        dynamics->guide_nodes(supports->guided_nodes(0), 0);
      loads = &dynamics->add<NodeLoads>();
    }

    /// Half a sleeper of concrete of 140 kg.
    SleeperBox sleeper_box(const double x) const
    {
      SleeperBox box;
      box.x      = x;
      box.top    = -height - 0.01;
      box.height = 140. / (concrete().density * (box.y_end - box.y_begin) * box.width);
      return box;
    }

    /// Nodes that share a force, and whose mean displacement with the same shares is what it moves.
    using Patch = std::vector<std::pair<unsigned int, double>>;

    /// The cross-sections from x - reach to x + reach, shares by mass: the mean of a section is the
    /// deflection that Timoshenko's beam has.
    Patch sections(const double x, const double reach = 0.) const
    {
      return patch([&](const dealii::Point<3> &p) { return std::abs(p[0] - x) < reach + 1e-6; });
    }

    /// The cross-section of solid sleepers at y.
    Patch section_of_sleepers(const double y) const
    {
      return patch(
        [&](const dealii::Point<3> &p) { return p[2] < -height - 1e-6 && std::abs(p[1] - y) < 1e-6; });
    }

    /// The middle of the rail top at x.
    Patch top(const double x) const
    {
      return patch([&](const dealii::Point<3> &p) {
        return std::abs(p[0] - x) < 1e-6 && std::abs(p[1]) < 0.013 && p[2] > -1e-3;
      });
    }

    /// A downward force, N.
    void load(const Patch &patch, const double force)
    {
      for (const auto &[node, share] : patch)
        loads->force[node] = Vector3{0., 0., -force * share, 0.};
    }

    /// Downwards, m.
    double displacement(const Patch &patch) const
    {
      double sum = 0.;
      for (const auto &[node, share] : patch)
        if (mesh->shared_nodes.is_owned(node))
          sum += share * (mesh->nodes[node][2] - dynamics->state.position(node)[2]);
      return dealii::Utilities::MPI::sum(sum, mesh->comm);
    }

    /// The same rail as a beam on the same supports, or on these.
    reference::SupportedBeam beam(const double element_length) const
    {
      return beam(element_length, supports->parameters.layers(0));
    }
    reference::SupportedBeam beam(const double element_length, const reference::SupportLayers &layers) const
    {
      return {section, layers, positions, -end, end, element_length};
    }

    /// A force on a patch as loads of that beam, 1 N in all. Of one rank.
    std::vector<reference::SupportedBeam::Load> beam_loads(const Patch &patch) const
    {
      std::map<long, double> share_at; // by x in um
      for (const auto &[node, share] : patch)
        share_at[std::lround(1e6 * mesh->nodes[node][0])] += share;
      std::vector<reference::SupportedBeam::Load> loads;
      for (const auto &[x, share] : share_at)
        loads.push_back({1e-6 * x, share});
      return loads;
    }

  private:
    template <typename Chosen>
    Patch patch(const Chosen &chosen) const
    {
      Patch  patch;
      double sum = 0.;
      for (unsigned int i = 0; i < mesh->nodes.size(); ++i)
        if (chosen(mesh->nodes[i]) && dynamics->true_masses()[i] > 0.)
          {
            patch.emplace_back(i, dynamics->true_masses()[i]);
            sum += mesh->shared_nodes.is_owned(i) ? dynamics->true_masses()[i] : 0.;
          }
      sum = dealii::Utilities::MPI::sum(sum, mesh->comm);
      for (auto &[node, share] : patch)
        share /= sum;
      return patch;
    }
  };

  /// What is left of an energy (J) at an instant (s), over what it was when a tone of so many periods along
  /// the rail at x = 0 had ended.
  template <typename Energy>
  double left_of_tone(TrackRail    &rail,
                      const double  frequency,
                      const double  periods,
                      const double  until,
                      const Energy &energy)
  {
    constexpr double blow     = 1e4; // N
    const double     duration = periods / frequency;
    const auto       struck   = rail.sections(0.);
    rail.dynamics->start();
    double before = 0.;
    while (rail.dynamics->state.time < until)
      {
        const double s = rail.dynamics->state.time / duration, phase = 2. * dealii::numbers::PI * s;
        const double f = s < 1. ? .5 * (1. - std::cos(phase)) * std::sin(periods * phase) * blow : 0.;
        for (const auto &[node, share] : struck)
          rail.loads->force[node] = Vector3{f * share, 0., 0., 0.};
        rail.dynamics->step();
        if (s > 1. && before == 0.)
          before = energy();
      }
    return energy() / before;
  }

  inline double bar_wave_speed() ///< m/s
  {
    return std::sqrt(steel().young_modulus / steel().density);
  }
} // namespace tread::tests

#endif
