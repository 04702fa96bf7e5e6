// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/gathered.h>
#include <tread/base/input_error.h>
#include <tread/dynamics/parts/track_beyond.h>
#include <tread/track/rail_section.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tread
{
  namespace
  {
    /// What nodes add to means of displacements (m) and velocities (m/s): far below any, and sums up to 30 mm
    /// and 2 m/s do not depend on the ranks.
    const Quantum of_displacements(0x1p-58), of_velocities(0x1p-52);

    /// Two ends, by the middle of the rail.
    std::array<double, 2> extent(const Mesh &mesh, const std::vector<unsigned int> &nodes)
    {
      double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
      for (const unsigned int i : nodes)
        {
          low  = std::min(low, mesh.nodes[i][0]);
          high = std::max(high, mesh.nodes[i][0]);
        }
      return {dealii::Utilities::MPI::min(low, mesh.comm), dealii::Utilities::MPI::max(high, mesh.comm)};
    }

    using Quadrilateral = std::array<std::array<double, 2>, 4>;

    RailSectionProperties section_of_end(const Mesh        &mesh,
                                         const unsigned int body,
                                         const double       middle,
                                         const double       side)
    {
      std::vector<Quadrilateral> own;
      for (const Mesh::Face &face : mesh.faces)
        if (face.body == body && face.boundary == Boundary::end &&
            side * (mesh.nodes[face.nodes[0]][0] - middle) > 0.)
          {
            own.emplace_back();
            for (unsigned int k = 0; k < 4; ++k)
              own.back()[k] = {mesh.nodes[face.nodes[k]][1], mesh.nodes[face.nodes[k]][2]};
          }
      std::vector<Quadrilateral> all = gathered(own, mesh.comm);
      std::sort(all.begin(), all.end()); // their order is that of the ranks
      return rail_section_properties(all);
    }
  } // namespace


  RailOnTrackBeyond::RailOnTrackBeyond(const PartOf                             &part_of,
                                       const unsigned int                        rail_body,
                                       const ElasticMaterial                    &rail,
                                       const std::array<TrackBeamParameters, 2> &beyond)
    : of(part_of)
    , body(rail_body)
  {
    const std::vector<unsigned int> at_ends = nodes_of_every_step();
    const auto [begin, finish]              = extent(of.mesh, at_ends);
    const double middle                     = 0.5 * (begin + finish);
    bool         is_coarse                  = true;
    for (unsigned int e = 0; e < 2; ++e)
      {
        End &end = ends[e];
        end.side = e == 0 ? -1. : 1.;
        std::array<ReproducibleSum<double>, 3> firsts;
        for (const unsigned int i : at_ends)
          if (const dealii::Point<3> &p = of.mesh.nodes[i];
              end.side * (p[0] - middle) > 0. && of.mesh.shared_nodes.is_owned(i))
            {
              is_coarse = is_coarse && of.true_mass[i] > 0.; // hanging nodes have none
              end.nodes.push_back({i, of.true_mass[i]});
              firsts[0].add(of.true_mass[i]);
              firsts[1].add(of.true_mass[i] * p[1]);
              firsts[2].add(of.true_mass[i] * p[2]);
            }
        end.mass        = firsts[0].value(of.mesh.comm);
        const double y0 = firsts[1].value(of.mesh.comm) / end.mass,
                     z0 = firsts[2].value(of.mesh.comm) / end.mass;
        const auto arms = [&](const Node &node) {
          const dealii::Point<3> &p = of.mesh.nodes[node.number];
          return std::pair(p[1] - y0, p[2] - z0);
        };
        std::array<ReproducibleSum<double>, 3> seconds;
        for (const Node &node : end.nodes)
          {
            const auto [across, up] = arms(node);
            seconds[0].add(node.mass * up * up);
            seconds[1].add(node.mass * across * across);
            seconds[2].add(node.mass * up * across);
          }
        // An inclined rail has a product of inertia.
        const double zz = seconds[0].value(of.mesh.comm), yy = seconds[1].value(of.mesh.comm),
                     zy = seconds[2].value(of.mesh.comm), determinant = zz * yy - zy * zy;
        for (Node &node : end.nodes)
          {
            const auto [across, up] = arms(node);
            node.pitch              = node.mass * (yy * up - zy * across) / determinant;
            node.yaw                = node.mass * (zz * across - zy * up) / determinant;
          }
        end.pitch_by_moment = yy / determinant;
        end.yaw_by_moment   = zz / determinant;

        const RailSectionProperties properties = section_of_end(of.mesh, rail_body, middle, end.side);
        reference::BeamSection      section;
        section.bending_stiffness = rail.young_modulus * properties.about_y;
        section.shear_stiffness   = properties.shear_coefficient * rail.young_modulus /
                                  (2. * (1. + rail.poisson_ratio)) * properties.area;
        section.mass           = rail.density * properties.area;
        section.rotary_inertia = rail.density * properties.about_y;
        end.track = std::make_unique<TrackBeam>(section, rail.young_modulus * properties.area, beyond[e]);
        // Clapeyron's equation of three moments for endless equal spans.
        end.yaw_stiffness = 2. * std::sqrt(3.) * rail.young_modulus * properties.about_z / beyond[e].spacing;
      }
    require(!dealii::Utilities::MPI::logical_or(!is_coarse, of.mesh.comm),
            "'Rail/Ends' endless: cells at the ends of the rail are refined; the rail must be longer");
  }


  template <typename OfNode>
  SumsOfTrackBeyond RailOnTrackBeyond::mean(const End    &end,
                                            const Quantum quantum,
                                            const OfNode &of_node) const
  {
    SumsOfTrackBeyond sums{};
    for (const Node &node : end.nodes)
      {
        const Vector3 value = of_node(node);
        const double  share = node.mass / end.mass;
        sums.along += quantum.round(share * value[0]);
        sums.up += quantum.round(share * value[2]);
        sums.slope -= quantum.round(node.pitch * value[0]);
        sums.yaw -= quantum.round(node.yaw * value[0]);
      }
    return sums;
  }


  template <typename OfNode>
  std::array<SumsOfTrackBeyond, 2> RailOnTrackBeyond::means(const Quantum quantum,
                                                            const OfNode &of_node) const
  {
    constexpr unsigned int n = 8;
    std::array<double, n>  sums;
    for (unsigned int e = 0; e < 2; ++e)
      {
        const SumsOfTrackBeyond m = mean(ends[e], quantum, of_node);
        std::copy_n(std::array{m.along, m.up, m.slope, m.yaw}.begin(), 4, sums.begin() + 4 * e);
      }
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums.data(), n), of.mesh.comm,
                                dealii::ArrayView<double>(sums.data(), n));
    return {SumsOfTrackBeyond{sums[0], sums[1], sums[2], sums[3]},
            SumsOfTrackBeyond{sums[4], sums[5], sums[6], sums[7]}};
  }


  std::vector<unsigned int> RailOnTrackBeyond::nodes_of_every_step() const
  {
    return of.mesh.boundary_nodes(body, Boundary::end);
  }


  void RailOnTrackBeyond::give(const End &end, const TrackBeam::AtSection &outwards, NodalField &force) const
  {
    const double yaw = -end.yaw_stiffness * end.yaw;
    for (const Node &node : end.nodes)
      {
        const double share = node.mass / end.mass;
        force[node.number] += of.quanta.force.round(
          Vector3{end.side * (share * outwards.along - node.pitch * outwards.slope) - node.yaw * yaw, 0.,
                  share * outwards.up, 0.});
      }
  }


  void RailOnTrackBeyond::add_forces(NodalField &force)
  {
    for (End &end : ends)
      {
        end.track->find_forces();
        give(end, end.track->force_on_section(), force);
      }
  }


  void RailOnTrackBeyond::add_spring_forces(NodalField &force) const
  {
    for (const End &end : ends)
      give(end, end.track->present_force_on_section(), force);
  }


  void RailOnTrackBeyond::add_row_sums(NodalField &rows) const
  {
    for (const End &end : ends)
      {
        // Forces are in proportion to the masses of the nodes.
        const TrackBeam::AtSection stiffness = end.track->stiffness_of_section();
        const double               rate      = (stiffness.along + stiffness.up) / end.mass +
                            stiffness.slope * end.pitch_by_moment + end.yaw_stiffness * end.yaw_by_moment;
        for (const Node &node : end.nodes)
          rows[node.number][0] += of.quanta.stiffness.round(rate * node.mass);
      }
  }


  Part::OwnRates RailOnTrackBeyond::own_rates(const NodeLevels &) const
  {
    OwnRates rates;
    for (const End &end : ends)
      {
        rates.stiffness = std::max(rates.stiffness, end.track->stiffness_over_mass());
        rates.damping   = std::max(rates.damping, end.track->damping_over_mass());
      }
    return rates;
  }


  double RailOnTrackBeyond::kinetic_energy(const double time_step) const
  {
    return ends[0].track->kinetic_energy(time_step) + ends[1].track->kinetic_energy(time_step);
  }


  double RailOnTrackBeyond::spring_energy() const
  {
    double energy = 0.;
    for (const End &end : ends)
      energy += end.track->spring_energy() + 0.5 * end.yaw_stiffness * end.yaw * end.yaw;
    return energy;
  }


  double RailOnTrackBeyond::potential(const double time_step) const
  {
    return ends[0].track->weight_potential(time_step) + ends[1].track->weight_potential(time_step);
  }


  double RailOnTrackBeyond::dissipated() const
  {
    return ends[0].track->dissipated() + ends[1].track->dissipated();
  }


  void RailOnTrackBeyond::set_at_rest(const State &state)
  {
    const auto at = means(of_displacements, [&](const Node &node) {
      const dealii::Point<3> &p = of.mesh.nodes[node.number];
      return state.x_damped[node.number] - Vector3{p[0], p[1], p[2], 0.};
    });
    for (unsigned int e = 0; e < 2; ++e)
      {
        ends[e].track->set_at_rest(outwards(ends[e], at[e]));
        ends[e].yaw = at[e].yaw;
      }
  }


  std::vector<double> RailOnTrackBeyond::follow(State &state,
                                                const std::vector<MovingLoad> &,
                                                const std::function<void(NodalField &)> &)
  {
    const auto at = means(of_velocities, [&](const Node &node) { return state.v[node.number]; });
    for (unsigned int e = 0; e < 2; ++e)
      ends[e].track->follow_slowly(outwards(ends[e], at[e]));
    return {};
  }


  std::array<SumsOfTrackBeyond, 2> RailOnTrackBeyond::sums_of_rank(const State &state) const
  {
    const auto of_node = [&](const Node &node) {
      return state.v[node.number] + (state.time_step / node.mass) * state.force[node.number];
    };
    return {mean(ends[0], of_velocities, of_node), mean(ends[1], of_velocities, of_node)};
  }


  void RailOnTrackBeyond::advance_with(Step &step, const std::array<SumsOfTrackBeyond, 2> &sums)
  {
    for (unsigned int e = 0; e < 2; ++e)
      {
        ends[e].track->advance(outwards(ends[e], sums[e]), step.state.time_step);
        ends[e].yaw += step.state.time_step * sums[e].yaw;
      }
  }


  void RailOnTrackBeyond::serialize(Archive &archive)
  {
    for (End &end : ends)
      {
        end.track->serialize(archive);
        archive.same(end.yaw);
      }
  }
} // namespace tread
