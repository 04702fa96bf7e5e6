// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/rail_ends.h>
#include <tread/track/track_beam.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    constexpr unsigned int along = 0, up = 1, slope = 2; // kinds of unknowns

    /// m: lumped inertia makes the bending waves of a rail at 2 kHz (0.9 m long) 0.5 % slower.
    constexpr double longest_element = 0.05;
    /// m: half of its mass lies beside the section instead of in it, which reflects 1e-5 of a wave's energy
    /// along the rail at 2 kHz.
    constexpr double first_element = 0.0125;
    /// m: where cells stand on the beam. What an element sinks more under a force in its middle than the line
    /// between its nodes, the force times a quarter of its length over the shear stiffness, is not in it: 0.6
    /// um under 60 kN, a tenth of it under the piece that spreads the force.
    constexpr double loaded_element = 0.01;

    SleeperModes rigid_sleeper(const reference::SupportLayers &layers)
    {
      if (!std::isfinite(layers.ballast_stiffness))
        return {};
      return {{layers.sleeper_mass},
              {layers.ballast_stiffness},
              {layers.sleeper_mass},
              {layers.ballast_damping}};
    }
  } // namespace


  BeamNodes beam_nodes(const TrackBeamParameters &parameters)
  {
    constexpr double  same_place = 1e-3; // m: shorter elements would need shorter steps
    const LoadedPart &loaded     = parameters.loaded;
    BeamNodes         nodes{{0.}, {}};
    const auto        divide = [&](const double to) {
      const double       from    = nodes.places.back();
      const bool         carries = loaded.is_there() && to > loaded.from && from < loaded.to;
      const double       longest = carries ? loaded_element : longest_element;
      const unsigned int n       = std::max(1., std::ceil((to - from) / longest - 1e-9));
      for (unsigned int i = 1; i <= n; ++i)
        nodes.places.push_back(i < n ? from + (to - from) * i / n : to);
    };
    const auto divide_at_stretches = [&](const double to) {
      for (const BeamStretch &stretch : parameters.stretches)
        if (stretch.from > nodes.places.back() + same_place && stretch.from < to - same_place)
          divide(stretch.from);
      divide(to);
    };
    divide(std::min(first_element, 0.5 * parameters.first_support));
    for (unsigned int s = 0; s < parameters.n_spans; ++s)
      {
        divide_at_stretches(parameters.first_support + s * parameters.spacing);
        nodes.of_support.push_back(nodes.places.size() - 1);
      }
    // Half a span is left behind the last support.
    divide_at_stretches(nodes.places.back() + 0.5 * parameters.spacing);
    return nodes;
  }


  const reference::BeamSection &section_between(const reference::BeamSection   &before,
                                                const std::vector<BeamStretch> &stretches,
                                                const double                    from,
                                                const double                    to)
  {
    const reference::BeamSection *section = &before;
    for (const BeamStretch &stretch : stretches)
      if (stretch.from < 0.5 * (from + to)) // sections change at nodes
        section = &stretch.section;
    return *section;
  }


  TrackBeam::TrackBeam(const reference::BeamSection &beam,
                       const double                  axial_stiffness,
                       const TrackBeamParameters    &parameters)
    : parameters(parameters)
  {
    if (parameters.sleeper.size() == 0)
      this->parameters.sleeper = rigid_sleeper(parameters.layers);
    const SleeperModes        &sleeper = this->parameters.sleeper;
    const LoadedPart          &loaded  = this->parameters.loaded;
    const BeamNodes            nodes   = beam_nodes(parameters);
    const std::vector<double> &places  = nodes.places;
    for (const std::size_t at : nodes.of_support)
      node_of_support.push_back(at - 1); // the section is none
    n_nodes                    = places.size() - 1;
    const std::size_t   n      = 3 * n_nodes + parameters.n_spans * sleeper.size();
    const double        length = places.back();
    const AbsorbingEnds layer =
      loaded.is_there()
        ? AbsorbingEnds{0., length, 0.5 * std::min(loaded.from, length - loaded.to), parameters.shear_speed}
        : AbsorbingEnds{-length, length, 0.5 * length, parameters.shear_speed};
    distances.assign(places.begin() + 1, places.end());

    for (auto *values : {&load, &mass, &weight, &rate, &displacement, &velocity, &force, &damping})
      values->assign(n, 0.);
    for (auto &of_elements : strains)
      of_elements.assign(n_nodes + 1, 0.);
    for (std::size_t i = 0; i < n_nodes; ++i)
      {
        const double           h = places[i + 1] - places[i];
        reference::BeamSection here =
          section_between(beam, this->parameters.stretches, places[i], places[i + 1]);
        if (!loaded.cells.empty())
          {
            const double left = 1. - loaded.cells[i].bending_stiffness / here.bending_stiffness;
            here.mass -= loaded.cells[i].mass;
            here.bending_stiffness *= left;
            here.rotary_inertia *= left;
          }
        elements.push_back({h, axial_stiffness / h, here.bending_stiffness / h,
                            1. / (1. / here.shear_stiffness + h * h / (12. * here.bending_stiffness))});
        for (const std::size_t node : {i == 0 ? i : i - 1, i}) // the section has none
          {
            mass[unknown(along, node)] += 0.5 * h * here.mass;
            mass[unknown(up, node)] += 0.5 * h * here.mass;
            mass[unknown(slope, node)] += 0.5 * h * here.rotary_inertia;
          }
      }
    for (std::size_t i = 0; i < n_nodes; ++i)
      {
        weight[unknown(up, i)] = -parameters.gravity * mass[unknown(up, i)];
        for (const unsigned int kind : {along, up, slope})
          rate[unknown(kind, i)] = layer.rate(places[i + 1]);
      }
    for (unsigned int s = 0; s < parameters.n_spans; ++s)
      for (std::size_t j = 0; j < sleeper.size(); ++j)
        {
          const std::size_t k = of_sleeper(s, j);
          mass[k]             = sleeper.mass[j];
          weight[k]           = -parameters.gravity * sleeper.weighing[j];
          rate[k]             = layer.rate(places[node_of_support[s] + 1]);
        }
    if (loaded.is_there())
      {
        first_loaded =
          std::upper_bound(distances.begin(), distances.end(), loaded.from) - distances.begin() - 1;
        last_loaded = std::lower_bound(distances.begin(), distances.end(), loaded.to) - distances.begin();
      }
    find_shapes();
    set_at_rest(AtSection());
  }


  double TrackBeam::under_pad(const std::vector<double> &values, const std::size_t support) const
  {
    double sum = 0.;
    for (std::size_t j = 0; j < parameters.sleeper.size(); ++j)
      sum += values[of_sleeper(support, j)];
    return sum;
  }


  TrackBeam::AtSection TrackBeam::spring_forces(const AtSection           &at,
                                                const std::vector<double> &u,
                                                std::vector<double>       &f) const
  {
    // Tension, shear force and bending moment of the elements.
    for (std::size_t e = 0; e < n_nodes; ++e)
      {
        const Element &element = elements[e];
        const double   before[3]{e > 0 ? u[unknown(along, e - 1)] : at.along,
                               e > 0 ? u[unknown(up, e - 1)] : at.up,
                               e > 0 ? u[unknown(slope, e - 1)] : at.slope};
        const double turned = u[unknown(slope, e)];
        strains[along][e]   = element.axial * (u[unknown(along, e)] - before[along]);
        strains[up][e]      = element.shear *
                         ((u[unknown(up, e)] - before[up]) / element.length - 0.5 * (turned + before[slope]));
        strains[slope][e] = element.bending * (turned - before[slope]);
      }
    for (std::size_t i = 0; i < n_nodes; ++i)
      {
        f[unknown(along, i)] = strains[along][i + 1] - strains[along][i];
        f[unknown(up, i)]    = strains[up][i + 1] - strains[up][i];
        f[unknown(slope, i)] = strains[slope][i + 1] - strains[slope][i] +
                               0.5 * strains[up][i] * elements[i].length +
                               (i + 1 < n_nodes ? 0.5 * strains[up][i + 1] * elements[i + 1].length : 0.);
      }
    const reference::SupportLayers &layers = parameters.layers;
    for (std::size_t s = 0; s < node_of_support.size(); ++s)
      {
        const std::size_t node = node_of_support[s];
        f[unknown(along, node)] -= parameters.stiffness_along * u[unknown(along, node)];
        f[unknown(slope, node)] -=
          layers.pad_stiffness * layers.pad_radius * layers.pad_radius * u[unknown(slope, node)];
        const double pad = layers.pad_stiffness * (u[unknown(up, node)] - under_pad(u, s));
        f[unknown(up, node)] -= pad;
        for (std::size_t j = 0; j < parameters.sleeper.size(); ++j)
          f[of_sleeper(s, j)] = pad - parameters.sleeper.stiffness[j] * u[of_sleeper(s, j)];
      }
    // The plane of symmetry.
    f[unknown(along, n_nodes - 1)] = f[unknown(slope, n_nodes - 1)] = 0.;
    return {strains[along][0], strains[up][0], strains[slope][0] + 0.5 * strains[up][0] * elements[0].length};
  }


  void TrackBeam::find_damping()
  {
    for (std::size_t k = 0; k < velocity.size(); ++k)
      damping[k] = -rate[k] * mass[k] * velocity[k];
    const reference::SupportLayers &layers = parameters.layers;
    const std::size_t               n      = parameters.sleeper.size();
    for (std::size_t s = 0; s < node_of_support.size(); ++s)
      {
        const std::size_t node = node_of_support[s];
        const double      pad  = layers.pad_damping * (velocity[unknown(up, node)] - under_pad(velocity, s));
        damping[unknown(up, node)] -= pad;
        damping[unknown(slope, node)] -=
          layers.pad_damping * layers.pad_radius * layers.pad_radius * velocity[unknown(slope, node)];
        // Row after row of a symmetric matrix, so that all coordinates of a sleeper are counted at once.
        double       *of_ballast = damping.data() + of_sleeper(s);
        const double *speed      = velocity.data() + of_sleeper(s);
        for (std::size_t j = 0; j < n; ++j)
          of_ballast[j] += pad;
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = 0; j < n; ++j)
            of_ballast[j] -= parameters.sleeper.damping[i * n + j] * speed[i];
      }
  }


  void TrackBeam::find_shapes()
  {
    // The stiffness matrix by its columns, which unit displacements give. Nodes act on their neighbours and
    // on the sleepers under them alone, so that the columns of every third node can be had at once.
    constexpr unsigned int every = 3;
    const std::size_t      n     = mass.size();
    std::vector<double>    unit(n, 0.), f(n, 0.);
    std::vector<int>       node_of(n);
    const std::size_t      n_coordinates = parameters.sleeper.size();
    for (std::size_t k = 0; k < n; ++k)
      node_of[k] = k < 3 * n_nodes ? k % n_nodes : node_of_support[(k - 3 * n_nodes) / n_coordinates];
    struct Entry
    {
      std::size_t row, column;
      double      value;
    };
    std::vector<Entry> entries;
    for (unsigned int kind = 0; kind < 3 + n_coordinates; ++kind)
      for (unsigned int colour = 0; colour < (kind < 3 ? every : 1); ++colour)
        {
          std::vector<int> column_of(n_nodes, -1); // by node
          const auto       move = [&](const std::size_t k) {
            unit[k]               = 1.;
            column_of[node_of[k]] = k;
          };
          if (kind < 3)
            for (std::size_t node = colour; node < n_nodes; node += every)
              move(unknown(kind, node));
          else
            for (std::size_t s = 0; s < node_of_support.size(); ++s)
              move(of_sleeper(s, kind - 3));
          spring_forces(AtSection(), unit, f);
          for (std::size_t i = 0; i < n; ++i)
            for (int node = node_of[i] - 1; node <= node_of[i] + 1; ++node)
              if (f[i] != 0. && node >= 0 && node < static_cast<int>(n_nodes) && column_of[node] >= 0 &&
                  (kind < 3 || node == node_of[i]))
                entries.push_back({i, static_cast<std::size_t>(column_of[node]), -f[i]});
          std::fill(unit.begin(), unit.end(), 0.);
        }
    held               = {unknown(along, n_nodes - 1), unknown(slope, n_nodes - 1)};
    const auto is_held = [&](const std::size_t k) {
      return k == held[0] || k == held[1];
    };
    dealii::DynamicSparsityPattern places(n);
    for (const Entry &entry : entries)
      places.add(entry.row, entry.column);
    for (const std::size_t k : held)
      places.add(k, k);
    dealii::SparsityPattern pattern;
    pattern.copy_from(places);
    dealii::SparseMatrix<double> sparse(pattern);
    for (const Entry &entry : entries)
      if (!is_held(entry.row) && !is_held(entry.column))
        sparse.add(entry.row, entry.column, entry.value);
    for (const std::size_t k : held)
      sparse.set(k, k, 1.);
    solver = std::make_unique<dealii::SparseDirectUMFPACK>();
    solver->initialize(sparse);
    const auto by_section = [&](const AtSection &at) {
      spring_forces(at, unit, f);
      return at_rest(f);
    };
    shapes[along] = by_section({1., 0., 0.});
    shapes[up]    = by_section({0., 1., 0.});
    shapes[slope] = by_section({0., 0., 1.});
    sagged        = at_rest(weight);
  }


  std::vector<double> TrackBeam::at_rest(const std::vector<double> &forces) const
  {
    dealii::Vector<double> solution(forces.begin(), forces.end());
    for (const std::size_t k : held)
      solution(k) = 0.;
    solver->solve(solution);
    return {solution.begin(), solution.end()};
  }


  TrackBeam::Place TrackBeam::place(const double from_section) const
  {
    const auto        after = std::upper_bound(distances.begin(), distances.end(), from_section);
    const std::size_t node =
      std::clamp<std::ptrdiff_t>(after - distances.begin() - 1, first_loaded, last_loaded - 1);
    const Element &element = elements[node + 1];
    const double h = element.length, bending = element.bending * h, s = (from_section - distances[node]) / h;
    // 12 E I over kappa G A h^2, where the element has a shear stiffness that makes up for its one point.
    const double phi = 12. * bending / (h * h) / element.shear - 1., over = 1. / (1. + phi);
    const double dip = over * (s * s - s);
    return {2 * (node - first_loaded),
            {1. + over * (s * s * (2. * s - 3.) - phi * s),
             h * over * s * (s * s - (2. + 0.5 * phi) * s + 1. + 0.5 * phi),
             over * (s * s * (3. - 2. * s) + phi * s),
             h * over * s * (s * s - (1. - 0.5 * phi) * s - 0.5 * phi)},
            {6. * dip / h, 1. + 3. * dip - s, -6. * dip / h, 3. * dip + s}};
  }


  TrackBeam::AtSection TrackBeam::value_at(const Place &at, const std::vector<double> &values) const
  {
    AtSection value;
    for (unsigned int k = 0; k < 4; ++k)
      {
        const double of_node = values[unknown(k % 2 == 0 ? up : slope, first_loaded + at.first / 2 + k / 2)];
        value.up += at.up[k] * of_node;
        value.slope += at.slope[k] * of_node;
      }
    return value;
  }


  void TrackBeam::set_loads(const double *of_nodes)
  {
    for (std::size_t i = first_loaded; i <= last_loaded; ++i)
      {
        load[unknown(up, i)]    = *of_nodes++;
        load[unknown(slope, i)] = *of_nodes++;
      }
  }


  std::vector<double> TrackBeam::displacements_of_loaded() const
  {
    std::vector<double> values;
    for (std::size_t i = first_loaded; i <= last_loaded; ++i)
      {
        values.push_back(displacement[unknown(up, i)]);
        values.push_back(displacement[unknown(slope, i)]);
      }
    return values;
  }


  void TrackBeam::take_loads_at_rest()
  {
    const std::vector<double> present = velocity;
    set_at_rest(section);
    velocity                       = present;
    const std::vector<double> more = at_rest(load);
    for (std::size_t k = 0; k < displacement.size(); ++k)
      displacement[k] += more[k];
  }


  void TrackBeam::follow_loads(const double *rates)
  {
    const std::vector<double> present = load;
    set_loads(rates);
    velocity = at_rest(load);
    load     = present;
  }


  void TrackBeam::set_at_rest(const AtSection &at)
  {
    section = at;
    for (std::size_t k = 0; k < displacement.size(); ++k)
      displacement[k] =
        sagged[k] + at.along * shapes[along][k] + at.up * shapes[up][k] + at.slope * shapes[slope][k];
    std::fill(velocity.begin(), velocity.end(), 0.);
  }


  void TrackBeam::follow_slowly(const AtSection &at)
  {
    for (std::size_t k = 0; k < velocity.size(); ++k)
      velocity[k] = at.along * shapes[along][k] + at.up * shapes[up][k] + at.slope * shapes[slope][k];
  }


  void TrackBeam::find_forces()
  {
    on_section = spring_forces(section, displacement, force);
    find_damping();
  }


  TrackBeam::AtSection TrackBeam::present_force_on_section() const
  {
    std::vector<double> unused(force.size());
    return spring_forces(section, displacement, unused);
  }


  void TrackBeam::advance(const AtSection &velocity_of_section, const double time_step)
  {
    for (std::size_t k = 0; k < velocity.size(); ++k)
      {
        const double before = velocity[k];
        velocity[k] += time_step / mass[k] * (force[k] + weight[k] + damping[k] + load[k]);
        // In central differences a force works in a step with the mean of the velocities around it.
        damper_work -= 0.5 * time_step * damping[k] * (before + velocity[k]);
      }
    velocity[unknown(along, n_nodes - 1)] = velocity[unknown(slope, n_nodes - 1)] = 0.;
    for (std::size_t k = 0; k < velocity.size(); ++k)
      displacement[k] += time_step * velocity[k];
    section.along += time_step * velocity_of_section.along;
    section.up += time_step * velocity_of_section.up;
    section.slope += time_step * velocity_of_section.slope;
  }


  double TrackBeam::stiffness_over_mass() const
  {
    // Sums of the rows, each element by itself.
    std::vector<double> rows(mass.size(), 0.);
    const auto          add = [&](const unsigned int kind, const std::size_t node, const double value) {
      rows[unknown(kind, node)] += value;
    };
    for (std::size_t e = 0; e < n_nodes; ++e)
      for (const std::size_t node : {e == 0 ? e : e - 1, e})
        {
          const Element &element = elements[e];
          const double   shear   = element.shear / element.length;
          add(along, node, 2. * element.axial);
          add(up, node, shear * (2. + element.length));
          add(slope, node, 2. * element.bending + shear * element.length * (1. + 0.5 * element.length));
        }
    const reference::SupportLayers &layers        = parameters.layers;
    const std::size_t               n_coordinates = parameters.sleeper.size();
    for (std::size_t s = 0; s < node_of_support.size(); ++s)
      {
        const std::size_t node = node_of_support[s];
        add(along, node, parameters.stiffness_along);
        add(up, node, std::max<double>(2., 1. + n_coordinates) * layers.pad_stiffness);
        add(slope, node, layers.pad_stiffness * layers.pad_radius * layers.pad_radius);
        for (std::size_t j = 0; j < n_coordinates; ++j)
          rows[of_sleeper(s, j)] =
            (1. + n_coordinates) * layers.pad_stiffness + parameters.sleeper.stiffness[j];
      }
    double largest = 0.;
    for (std::size_t k = 0; k < rows.size(); ++k)
      largest = std::max(largest, rows[k] / mass[k]);
    return largest;
  }


  double TrackBeam::damping_over_mass() const
  {
    const reference::SupportLayers &layers  = parameters.layers;
    const std::size_t               n       = parameters.sleeper.size();
    double                          largest = *std::max_element(rate.begin(), rate.end());
    for (std::size_t s = 0; s < node_of_support.size(); ++s)
      {
        const std::size_t node = node_of_support[s];
        largest                = std::max({largest,
                                           rate[unknown(up, node)] +
                                             std::max<double>(2., 1. + n) * layers.pad_damping / mass[unknown(up, node)],
                                           rate[unknown(slope, node)] + layers.pad_damping * layers.pad_radius *
                                                                          layers.pad_radius / mass[unknown(slope, node)]});
        for (std::size_t j = 0; j < n; ++j)
          {
            double row = (1. + n) * layers.pad_damping;
            for (std::size_t i = 0; i < n; ++i)
              row += std::abs(parameters.sleeper.damping[j * n + i]);
            largest = std::max(largest, rate[of_sleeper(s, j)] + row / mass[of_sleeper(s, j)]);
          }
      }
    return largest;
  }


  TrackBeam::AtSection TrackBeam::stiffness_of_section() const
  {
    const Element &first = elements[0];
    const double   shear = first.shear / first.length;
    return {2. * first.axial, shear * (2. + first.length),
            2. * first.bending + shear * first.length * (1. + 0.5 * first.length)};
  }


  double TrackBeam::spring_energy() const
  {
    std::vector<double> f(force.size());
    spring_forces(section, displacement, f);
    double energy = 0.;
    for (std::size_t e = 0; e < n_nodes; ++e)
      {
        const Element &element = elements[e];
        energy += 0.5 * (strains[along][e] * strains[along][e] / element.axial +
                         strains[up][e] * strains[up][e] * element.length / element.shear +
                         strains[slope][e] * strains[slope][e] / element.bending);
      }
    const reference::SupportLayers &layers      = parameters.layers;
    const auto                      half_square = [](const double x) {
      return 0.5 * x * x;
    };
    for (std::size_t s = 0; s < node_of_support.size(); ++s)
      {
        const std::size_t node = node_of_support[s];
        energy +=
          parameters.stiffness_along * half_square(displacement[unknown(along, node)]) +
          layers.pad_stiffness * (half_square(displacement[unknown(up, node)] - under_pad(displacement, s)) +
                                  half_square(layers.pad_radius * displacement[unknown(slope, node)]));
        for (std::size_t j = 0; j < parameters.sleeper.size(); ++j)
          energy += parameters.sleeper.stiffness[j] * half_square(displacement[of_sleeper(s, j)]);
      }
    return energy;
  }


  double TrackBeam::kinetic_energy(const double time_step) const
  {
    // With the product of the velocities half a step before and after now, of the springs' forces alone.
    std::vector<double> f(force.size());
    spring_forces(section, displacement, f);
    double energy = 0.;
    for (std::size_t k = 0; k < f.size(); ++k)
      energy += 0.5 * velocity[k] * (mass[k] * velocity[k] + time_step * f[k]);
    return energy;
  }


  double TrackBeam::weight_potential(const double time_step) const
  {
    double potential = 0.;
    for (std::size_t k = 0; k < weight.size(); ++k)
      potential -= weight[k] * (displacement[k] - 0.5 * time_step * velocity[k]);
    return potential;
  }


  void TrackBeam::serialize(Archive &archive)
  {
    archive.same(section, damper_work);
    archive.same_number(displacement, velocity);
  }
} // namespace tread
