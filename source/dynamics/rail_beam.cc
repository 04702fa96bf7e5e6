// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/rail_beam.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread
{
  namespace
  {
    constexpr double element_length = 0.025; // m: short against any bending of a rail

    /// Shear coefficient of rails (about 0.4 for the usual sections, 0.85 for a block; Cowper 1966); the beam
    /// only guides an iteration and the velocities at the start.
    constexpr double shear_coefficient = 0.4;
  } // namespace


  RailBeam::RailBeam(const Mesh            &mesh,
                     const Solid           &solid,
                     const Supports        &supports,
                     const ElasticMaterial &rail,
                     const TrackBeyondBoth &beyond)
    : mesh(mesh)
    , supports(supports)
    , support_of_body(mesh.body_names.size(), -1)
  {
    for (unsigned int s = 0; s < supports.solid_sleepers.size(); ++s)
      support_of_body[supports.solid_sleepers[s].body] = s;

    ReproducibleSum<double> volumes, firsts, seconds;
    double     low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    const auto cell_masses = solid.cell_masses(mesh);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.cells[c].body == supports.rail_body)
        {
          double mass = 0., z = 0., bottom = std::numeric_limits<double>::max(),
                 top = std::numeric_limits<double>::lowest();
          for (unsigned int a = 0; a < 8; ++a)
            {
              const dealii::Point<3> &p = mesh.nodes[mesh.cells[c].nodes[a]];
              mass += cell_masses[c][a];
              z += 0.125 * p[2];
              bottom = std::min(bottom, p[2]);
              top    = std::max(top, p[2]);
              low    = std::min(low, p[0]);
              high   = std::max(high, p[0]);
            }
          const double cell = mass / rail.density;
          volumes.add(cell);
          firsts.add(cell * z);
          seconds.add(cell * (z * z + (top - bottom) * (top - bottom) / 12.));
        }
    const double volume = volumes.value(mesh.comm);
    const double begin  = dealii::Utilities::MPI::min(low, mesh.comm),
                 end    = dealii::Utilities::MPI::max(high, mesh.comm);
    centroid_z          = firsts.value(mesh.comm) / volume;
    const double area = volume / (end - begin), moment_of_inertia = seconds.value(mesh.comm) / (end - begin) -
                                                                    area * centroid_z * centroid_z;
    reference::BeamSection rail_section;
    rail_section.bending_stiffness = rail.young_modulus * moment_of_inertia;
    rail_section.shear_stiffness =
      shear_coefficient * rail.young_modulus / (2. * (1. + rail.poisson_ratio)) * area;
    rail_section.mass           = rail.density * area;
    rail_section.rotary_inertia = rail.density * moment_of_inertia;
    std::vector<reference::SupportLayers> layers;
    for (unsigned int s = 0; s < supports.positions.size(); ++s)
      layers.push_back(supports.parameters.layers(s));
    std::vector<double> places = supports.positions;
    double              from = begin, to = end;
    if (beyond)
      {
        const auto &[before, behind] = *beyond;
        n_before                     = before.n_spans;
        layers.insert(layers.begin(), n_before, before.layers);
        layers.insert(layers.end(), behind.n_spans, behind.layers);
        for (unsigned int s = 0; s < before.n_spans; ++s)
          places.insert(places.begin(), begin - before.first_support - s * before.spacing);
        for (unsigned int s = 0; s < behind.n_spans; ++s)
          places.push_back(end + behind.first_support + s * behind.spacing);
        from = places.front() - 0.5 * before.spacing;
        to   = places.back() + 0.5 * behind.spacing;
      }
    beam = std::make_unique<reference::SupportedBeam>(rail_section, layers, places, from, to, element_length);
  }


  RailBeam::Field RailBeam::balance(const std::vector<reference::SupportedBeam::Load> &loads) const
  {
    Field field{beam->respond(loads), std::vector<double>(supports.positions.size(), 0.)};
    if (supports.parameters.two_layers)
      for (unsigned int s = 0; s < field.sleepers.size(); ++s)
        {
          const double k_pad     = beam->layers[n_before + s].pad_stiffness,
                       k_ballast = beam->layers[n_before + s].ballast_stiffness;
          field.sleepers[s] =
            k_pad * field.rail.deflection(supports.positions[s]).real() / (k_pad + k_ballast);
        }
    return field;
  }


  void RailBeam::add(const Field &field, const double factor, Vector3 *values) const
  {
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      {
        const dealii::Point<3> &p    = mesh.nodes[i];
        const unsigned int      body = mesh.node_bodies[i];
        if (body == supports.rail_body)
          {
            const double turned = field.rail.rotation(p[0]).real();
            values[i] +=
              factor * Vector3{-turned * (p[2] - centroid_z), 0., field.rail.deflection(p[0]).real(), 0.};
          }
        else if (support_of_body[body] >= 0)
          values[i] += factor * Vector3{0., 0., field.sleepers[support_of_body[body]], 0.};
      }
  }
} // namespace tread
