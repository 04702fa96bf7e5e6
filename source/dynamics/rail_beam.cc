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
    , beyond(beyond)
    , support_of_body(mesh.body_names.size(), -1)
    , quantum(solid.force_quantum())
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
    begin               = dealii::Utilities::MPI::min(low, mesh.comm);
    end                 = dealii::Utilities::MPI::max(high, mesh.comm);
    centroid_z          = firsts.value(mesh.comm) / volume;
    const double area = volume / (end - begin), moment_of_inertia = seconds.value(mesh.comm) / (end - begin) -
                                                                    area * centroid_z * centroid_z;
    rail_section.bending_stiffness = rail.young_modulus * moment_of_inertia;
    rail_section.shear_stiffness =
      shear_coefficient * rail.young_modulus / (2. * (1. + rail.poisson_ratio)) * area;
    rail_section.mass           = rail.density * area;
    rail_section.rotary_inertia = rail.density * moment_of_inertia;
    axial_stiffness             = rail.young_modulus * area;
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


  unsigned int RailBeam::n_places() const
  {
    return 2 + static_cast<unsigned int>((end - begin) / element_length);
  }


  std::vector<double> RailBeam::stretched(const std::vector<double> &forces) const
  {
    // The track beyond an end is a spring there: the last of its nodes does not move.
    const auto spring = [&](const TrackBeyondParameters &track) {
      double stiffness = axial_stiffness / (0.5 * track.spacing);
      for (unsigned int s = track.n_spans; s-- > 0;)
        {
          stiffness += track.stiffness_along;
          const double length = s > 0 ? track.spacing : track.first_support;
          stiffness           = 1. / (1. / stiffness + length / axial_stiffness);
        }
      return stiffness;
    };
    const double k_begin = spring((*beyond)[0]), k_end = spring((*beyond)[1]),
                 of_element = axial_stiffness * (forces.size() - 1) / (end - begin);
    // With the first place displaced by 1 and no forces, and by 0 with them.
    double tension_of_one = k_begin, tension = 0., moved_of_one = 1., moved = 0.;
    for (std::size_t k = 0; k + 1 < forces.size(); ++k)
      {
        tension -= forces[k];
        moved_of_one += tension_of_one / of_element;
        moved += tension / of_element;
      }
    tension -= forces.back();
    const double        first = -(tension + k_end * moved) / (tension_of_one + k_end * moved_of_one);
    std::vector<double> along{first};
    tension = k_begin * first;
    for (std::size_t k = 0; k + 1 < forces.size(); ++k)
      {
        tension -= forces[k];
        along.push_back(along.back() + tension / of_element);
      }
    return along;
  }


  RailBeam::Field RailBeam::respond(const std::vector<reference::SupportedBeam::Load> &loads,
                                    const std::vector<double>                         &sleeper_loads) const
  {
    Field field{beam->respond(loads), std::vector<double>(supports.positions.size(), 0.), {}};
    if (supports.parameters.two_layers)
      for (unsigned int s = 0; s < field.sleepers.size(); ++s)
        {
          const double k_pad     = beam->layers[n_before + s].pad_stiffness,
                       k_ballast = beam->layers[n_before + s].ballast_stiffness;
          field.sleepers[s] =
            (k_pad * field.rail.deflection(supports.positions[s]).real() + sleeper_loads[s]) /
            (k_pad + k_ballast);
        }
    return field;
  }


  RailBeam::Field RailBeam::balance(const std::vector<reference::SupportedBeam::Load> &loads) const
  {
    return respond(loads, std::vector<double>(supports.positions.size(), 0.));
  }


  RailBeam::Field RailBeam::balance(const Vector3                              *force,
                                    std::vector<reference::SupportedBeam::Load> loads) const
  {
    // Forces and moments about the centroid go to the two nearest of evenly spaced places.
    const unsigned int  n          = n_places();
    const double        h          = (end - begin) / (n - 1);
    const unsigned int  n_supports = supports.positions.size();
    std::vector<double> sums(2 * n + n_supports + (beyond ? n : 0), 0.);
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      {
        if (!mesh.shared_nodes.is_owned(i))
          continue;
        const unsigned int body = mesh.node_bodies[i];
        if (body == supports.rail_body)
          {
            const double       s      = std::clamp((mesh.nodes[i][0] - begin) / h, 0., n - 1. - 1e-9);
            const unsigned int place  = static_cast<unsigned int>(s);
            const double       moment = -(mesh.nodes[i][2] - centroid_z) * force[i][0];
            for (unsigned int side = 0; side < 2; ++side)
              {
                const double share = side == 0 ? 1. - (s - place) : s - place;
                sums[2 * (place + side)] += quantum.round(share * force[i][2]);
                sums[2 * (place + side) + 1] += quantum.round(share * moment);
                if (beyond)
                  sums[2 * n + n_supports + place + side] += quantum.round(share * force[i][0]);
              }
          }
        else if (support_of_body[body] >= 0)
          sums[2 * n + support_of_body[body]] += quantum.round(force[i][2]);
      }
    dealii::Utilities::MPI::sum(sums, mesh.comm, sums);
    for (unsigned int k = 0; k < n; ++k)
      loads.push_back({k + 1 < n ? begin + k * h : end, sums[2 * k], sums[2 * k + 1]});
    const std::vector<double> sleeper_loads(sums.begin() + 2 * n, sums.begin() + 2 * n + n_supports);
    if (!supports.solid_sleepers.empty())
      for (unsigned int s = 0; s < n_supports; ++s)
        {
          const reference::SupportLayers &of_support = beam->layers[n_before + s];
          loads.push_back(
            {supports.positions[s], sleeper_loads[s] * of_support.pad_stiffness /
                                      (of_support.pad_stiffness + of_support.ballast_stiffness)});
        }
    Field field = respond(loads, sleeper_loads);
    if (beyond)
      field.along = stretched({sums.begin() + 2 * n + n_supports, sums.end()});
    return field;
  }


  void RailBeam::add(const Field &field, const double factor, Vector3 *values) const
  {
    const auto along = [&](const double x) {
      if (field.along.empty())
        return 0.;
      const double      s    = std::clamp((x - begin) / (end - begin), 0., 1.) * (field.along.size() - 1);
      const std::size_t last = field.along.size() - 2, place = std::min<std::size_t>(s, last);
      return field.along[place] + (s - place) * (field.along[place + 1] - field.along[place]);
    };
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      {
        const dealii::Point<3> &p    = mesh.nodes[i];
        const unsigned int      body = mesh.node_bodies[i];
        if (body == supports.rail_body)
          {
            const double turned = field.rail.rotation(p[0]).real();
            values[i] += factor * Vector3{along(p[0]) - turned * (p[2] - centroid_z), 0.,
                                          field.rail.deflection(p[0]).real(), 0.};
          }
        else if (support_of_body[body] >= 0)
          values[i] += factor * Vector3{0., 0., field.sleepers[support_of_body[body]], 0.};
      }
  }
} // namespace tread
