// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_track_rail_h
#define tread_tests_track_rail_h

#include <tread/dynamics/explicit_dynamics.h>
#include <tread/mesh/sleeper_body.h>
#include <tread/reference/supported_beam.h>

#include "boxes.h"

#include <cmath>
#include <memory>
#include <vector>

namespace tread::tests
{
  /// A bar of 60 x 150 mm, near a rail in area and stiffness, on supports 0.6 m apart that begin and end half
  /// a spacing from its symmetric ends; the middle support is at x = 0.
  struct TrackRail
  {
    static constexpr double spacing = 0.6, width = 0.06, height = 0.15;

    std::vector<double>               positions;
    std::unique_ptr<Mesh>             mesh;
    std::unique_ptr<Solid>            solid;
    std::unique_ptr<ExplicitDynamics> dynamics;
    std::unique_ptr<Supports>         supports;

    TrackRail(const MPI_Comm             comm,
              const unsigned int         n_supports,
              const TrackParameters     &track,
              const DynamicsParameters  &parameters,
              const unsigned int         cells_per_span,
              const std::vector<double> &probes,
              const bool                 refined        = false,
              const bool                 solid_sleepers = false)
    {
      const int half = n_supports / 2;
      for (int i = -half; i <= half; ++i)
        positions.push_back(spacing * i);
      const double end  = spacing * (half + 0.5);
      Body         body = make_box(
                "rail", dealii::Point<3>(-end, -0.5 * width, -height), dealii::Point<3>(end, 0.5 * width, 0.),
                {{n_supports * cells_per_span, 2, 6}},
                {{Boundary::end, Boundary::end, Boundary::free, Boundary::free, Boundary::support, Boundary::free}});
      if (refined)
        refine_near(body, dealii::Point<3>(0., 0.02, -height), 0.05, 0.016);
      std::vector<Body>            bodies{body};
      std::vector<ElasticMaterial> materials{steel()};
      std::vector<SolidSleeper>    sleepers;
      if (solid_sleepers)
        for (const double x : positions)
          {
            // Half a sleeper of concrete of 140 kg.
            SleeperBox box;
            box.x      = x;
            box.top    = -height - 0.01;
            box.height = 140. / (2520. * (box.y_end - box.y_begin) * box.width);
            sleepers.push_back({static_cast<unsigned int>(bodies.size()), box.y_begin, box.y_end, box.width});
            bodies.push_back(make_sleeper(box));
            materials.push_back({38.4e9, 0.2, 2520.});
          }
      mesh     = std::make_unique<Mesh>(comm, bodies);
      solid    = std::make_unique<Solid>(*mesh, materials, SolidParameters());
      dynamics = std::make_unique<ExplicitDynamics>(*mesh, *solid, parameters);
      supports = std::make_unique<Supports>(*mesh, 0, positions, track, sleepers);
      for (const double x : probes)
        supports->add_probe(x);
      dynamics->attach_supports(*supports, steel());
      dynamics->guide_nodes(dynamics->boundary_nodes(0, Boundary::end), 0);
      dynamics->guide_nodes(supports->guided_nodes(1), 1);
      for (const SolidSleeper &sleeper : sleepers)
        dynamics->guide_nodes(dynamics->boundary_nodes(sleeper.body, Boundary::end), 1);
      if (solid_sleepers)
        dynamics->guide_nodes(supports->guided_nodes(0), 0);
      dynamics->external_force.assign(mesh->nodes.size(), Row{});
    }

    /// A downward force, N, spread over the nodes of the cross-section at x.
    void load(const double x, const double force)
    {
      std::vector<unsigned int> chosen;
      for (unsigned int i = 0; i < mesh->nodes.size(); ++i)
        if (std::abs(mesh->nodes[i][0] - x) < 1e-6 && dynamics->true_masses()[i] > 0.)
          chosen.push_back(i);
      double n = 0.;
      for (const unsigned int i : chosen)
        n += mesh->shared_nodes.is_owned(i) ? 1. : 0.;
      n = dealii::Utilities::MPI::sum(n, mesh->comm);
      for (const unsigned int i : chosen)
        dynamics->external_force[i] = Row{0., 0., -force / n, 0.};
    }

    static ElasticMaterial steel()
    {
      return {210e9, 0.3, 7850.};
    }

    /// The same rail as a beam; shear coefficient of a rectangle (Cowper 1966).
    static reference::BeamSection section()
    {
      const double           area = width * height, I = width * std::pow(height, 3) / 12., nu = 0.3;
      reference::BeamSection s;
      s.bending_stiffness = steel().young_modulus * I;
      s.shear_stiffness =
        10. * (1. + nu) / (12. + 11. * nu) * steel().young_modulus / (2. * (1. + nu)) * area;
      s.mass           = steel().density * area;
      s.rotary_inertia = steel().density * I;
      return s;
    }
  };
} // namespace tread::tests

#endif
