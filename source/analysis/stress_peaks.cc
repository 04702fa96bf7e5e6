// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/stress_peaks.h>
#include <tread/base/gathered.h>
#include <tread/base/input_error.h>
#include <tread/solid/hexahedron.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace tread
{
  namespace
  {
    /// Layers of an octree are one, two, four ... finest cells thick, and their centres lie at half of that
    /// or at whole numbers below the surface: a quarter of a cell more tells all of them apart.
    unsigned int layer_at(const double depth, const double finest_cell)
    {
      constexpr double quarter = 0.25;
      return std::max(0., std::floor(depth / finest_cell + quarter));
    }
  } // namespace


  bool Peak::operator<(const Peak &other) const
  {
    const auto numbers = [](const Peak &p) {
      return std::make_tuple(p.value, p.x, p.y, p.depth, p.time, p.wheel_x);
    };
    return numbers(*this) < numbers(other);
  }


  double von_mises_at_face(const std::array<Vector3, 4> &reference,
                           const std::array<Vector3, 4> &current,
                           const ElasticMaterial        &material,
                           const double                  pressure,
                           const double                  shear)
  {
    // Vectors along both local coordinates in the middle of the face.
    const auto along = [](const std::array<Vector3, 4> &p, const unsigned int d) {
      return d == 0 ? 0.5 * ((p[1] - p[0]) + (p[2] - p[3])) : 0.5 * ((p[3] - p[0]) + (p[2] - p[1]));
    };
    const Vector3 A = along(reference, 0), B = along(reference, 1), a = along(current, 0),
                  b = along(current, 1);
    // Components of A and B in the reference plane, the first axis along A; the metric of the current face
    // in these axes is C = F^T F.
    const double  length = norm(A);
    const Vector3 e      = (1. / length) * A;
    const double  b1 = dot(B, e), b2 = norm(B - b1 * e);
    const Vector3 f1 = (1. / length) * a, f2 = (1. / b2) * (b - (b1 / length) * a);
    // Green-Lagrange strain E; logarithmic strain E - E^2 to second order.
    const double E11 = 0.5 * (dot(f1, f1) - 1.), E22 = 0.5 * (dot(f2, f2) - 1.), E12 = 0.5 * dot(f1, f2);
    const double e11 = E11 - E11 * E11 - E12 * E12, e22 = E22 - E22 * E22 - E12 * E12,
                 e12    = E12 - E12 * (E11 + E22);
    const double lambda = material.lame(), mu = material.shear_modulus();
    const double e33   = (-pressure - lambda * (e11 + e22)) / (lambda + 2. * mu);
    const double trace = lambda * (e11 + e22 + e33);
    return von_mises({{trace + 2. * mu * e11, trace + 2. * mu * e22, -pressure, 2. * mu * e12, shear, 0.}});
  }


  StressPeaks::StressPeaks(const ExplicitDynamics &dynamics,
                           const Contact          *contact,
                           const unsigned int      body,
                           const ElasticMaterial  &material,
                           const PeakRegion       &region)
    : comm(dynamics.mesh.comm)
    , region(region)
    , material(material)
  {
    find_members(dynamics, body);
    if (dealii::Utilities::MPI::sum(members.size(), comm) == 0)
      throw InputError(std::string("the region of 'Peak stress' holds no middle of a cell of the ") +
                       (contact ? "rail" : "wheel") + ": make it longer, wider or deeper");
    find_pairs();
    if (dealii::Utilities::MPI::sum(pairs.size(), comm) == 0)
      throw InputError(
        std::string("the region of 'Peak stress' holds no two layers of the finest cells of the ") +
        (contact ? "rail" : "wheel") +
        ", from which the stress at its surface follows: make it deeper, or longer where the "
        "cells are finest");
    if (contact)
      find_faces(dynamics, *contact);
    unsigned int n_layers = 0;
    for (const Member &member : members)
      n_layers = std::max(n_layers, member.layer + 1);
    peaks.resize(first_layer + dealii::Utilities::MPI::max(n_layers, comm));
  }


  void StressPeaks::find_members(const ExplicitDynamics &dynamics, const unsigned int body)
  {
    const Mesh               &mesh  = dynamics.mesh;
    const Solid              &solid = dynamics.solid;
    std::vector<unsigned int> elastic;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.cells[c].body == body)
        {
          const dealii::Point<3> centre = centre_of(mesh.corners(c));
          const double           along = region.along(centre), depth = region.depth_of(centre);
          if (along < region.x_begin || along > region.x_end ||
              std::abs(centre[1] - region.y_middle) > region.half_width || depth > region.depth)
            continue;
          members.push_back(
            {c, layer_at(depth, region.finest_cell), along, centre[1], depth, solid.cell_levels()[c] == 0});
          nodes.insert(nodes.end(), mesh.cells[c].nodes.begin(), mesh.cells[c].nodes.end());
          if (!solid.plastic().contains(c))
            elastic.push_back(c);
          else
            {
              plastic_members.resize(mesh.cells.size(), false);
              plastic_members[c] = true;
            }
        }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    groups = solid.groups_of(mesh, body, elastic);
    x.resize(mesh.nodes.size());
    stress.resize(mesh.cells.size());
  }


  void StressPeaks::find_pairs()
  {
    struct Cell
    {
      double       x, y, depth;
      unsigned int rank, member;
      bool         every_step;
    };
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
    std::vector<Cell>  own, own_at_surface;
    for (unsigned int m = 0; m < members.size(); ++m)
      (members[m].layer == 0 ? own_at_surface : own)
        .push_back({members[m].x, members[m].y, members[m].depth, rank, m, members[m].every_step});
    const std::vector<Cell> all = gathered(own_at_surface, comm), below = gathered(own, comm);
    for (const Cell &cell : all)
      {
        const Cell *nearest  = nullptr;
        double      distance = 0.;
        for (const Cell &other : below)
          {
            const double d = std::hypot(cell.x - other.x, cell.y - other.y) + (other.depth - cell.depth);
            if (!nearest || d < distance)
              {
                nearest  = &other;
                distance = d;
              }
          }
        // Not below the middle: the region ends at the surface cells, or they are finer than what lies below.
        if (!nearest || std::hypot(cell.x - nearest->x, cell.y - nearest->y) > 0.5 * region.finest_cell)
          continue;
        const bool     here = nearest->rank == rank, crosses = nearest->rank != cell.rank;
        const unsigned slot = exchanged.size();
        if (crosses)
          {
            exchanged.emplace_back();
            if (here)
              sent.emplace_back(nearest->member, slot);
          }
        if (cell.rank == rank)
          pairs.push_back({cell.member, crosses ? -1 : static_cast<int>(nearest->member), slot,
                           cell.depth / (nearest->depth - cell.depth),
                           cell.every_step && nearest->every_step});
      }
  }


  void StressPeaks::find_faces(const ExplicitDynamics &dynamics, const Contact &contact)
  {
    const Mesh                          &mesh = dynamics.mesh;
    std::map<unsigned int, unsigned int> surface_number;
    for (unsigned int k = 0; k < contact.surfaces.nodes.size(); ++k)
      if (const int local = contact.surfaces.nodes[k].local; local >= 0)
        surface_number[local] = k;
    traction.resize(contact.surfaces.nodes.size());
    // Hooke's law is not that of steel that can yield, and the largest of a part of the region would be taken
    // for that of all of it.
    std::vector<char> is_member(mesh.cells.size(), false);
    unsigned int      can_yield = 0;
    for (const Member &member : members)
      {
        is_member[member.cell] = true;
        can_yield += member.layer == 0 && dynamics.solid.plastic().contains(member.cell);
      }
    if (dealii::Utilities::MPI::sum(can_yield, comm) > 0)
      return;
    for (const Mesh::Face &face : mesh.faces)
      if (face.boundary == Boundary::contact && is_member[face.cell])
        {
          SurfaceFace found{face.nodes, {}, {}, 0., 0.};
          bool        complete = true;
          for (unsigned int a = 0; a < 4; ++a)
            {
              const dealii::Point<3> &p = mesh.nodes[face.nodes[a]];
              const auto              k = surface_number.find(face.nodes[a]);
              complete                  = complete && k != surface_number.end();
              if (complete)
                found.surface_nodes[a] = k->second;
              found.reference[a] = Vector3{p[0], p[1], p[2], 0.};
              found.x += 0.25 * region.along(p);
              found.y += 0.25 * p[1];
            }
          if (complete) // else it rims the fine zone
            faces.push_back(found);
        }
  }


  void StressPeaks::keep(const unsigned int slot, const Peak &peak)
  {
    if (peaks[slot] < peak)
      peaks[slot] = peak;
  }


  void StressPeaks::sample(const ExplicitDynamics              &dynamics,
                           const std::vector<ContactNodeState> &states,
                           const double                         wheel_x)
  {
    const Instant instant{dynamics.time, wheel_x, dynamics.synchronised()};
    for (const unsigned int i : nodes)
      x[i] = dynamics.position(i);
    for (const auto &group : groups)
      group->set_cauchy_stress(x.data(), {}, stress);
    if (!plastic_members.empty())
      dynamics.solid.plastic().cauchy_stress(x.data(), dynamics.history, stress, plastic_members);
    sample_layers(instant);
    extrapolate(instant);
    sample_surface(states, dynamics.time_step, instant);
  }


  void StressPeaks::sample_layers(const Instant &instant)
  {
    for (const Member &m : members)
      if (m.every_step || instant.all)
        keep(first_layer + m.layer,
             {von_mises(stress[m.cell]), m.x, m.y, m.depth, instant.time, instant.wheel_x});
  }


  void StressPeaks::extrapolate(const Instant &instant)
  {
    if (!exchanged.empty())
      {
        std::fill(exchanged.begin(), exchanged.end(), std::array<double, 6>{});
        for (const auto &[member, slot] : sent)
          exchanged[slot] = stress[members[member].cell];
        MPI_Allreduce(MPI_IN_PLACE, exchanged.data(), 6 * exchanged.size(), MPI_DOUBLE, MPI_SUM, comm);
      }
    for (const Pair &pair : pairs)
      if (pair.every_step || instant.all)
        {
          const Member                &member = members[pair.member];
          const std::array<double, 6> &upper  = stress[member.cell],
                                      &lower  = pair.below < 0 ? exchanged[pair.slot]
                                                               : stress[members[pair.below].cell];
          std::array<double, 6> at_surface;
          for (unsigned int k = 0; k < 6; ++k)
            at_surface[k] = upper[k] + pair.share * (upper[k] - lower[k]);
          keep(extrapolated, {von_mises(at_surface), member.x, member.y, 0., instant.time, instant.wheel_x});
        }
  }


  void StressPeaks::sample_surface(const std::vector<ContactNodeState> &states,
                                   const double                         time_step,
                                   const Instant                       &instant)
  {
    if (traction.empty())
      return;
    for (const ContactNodeState &state : states)
      {
        const double  per_area = 1. / (state.area * time_step), normal = dot(state.impulse, state.normal);
        const Vector3 tangential = state.impulse - normal * state.normal;
        traction[state.node]     = per_area * Vector3{normal, tangential[0], tangential[1], tangential[2]};
        const Vector3 p          = state.position;
        if (p[0] < region.x_begin || p[0] > region.x_end ||
            std::abs(p[1] - region.y_middle) > region.half_width)
          continue;
        keep(pressure, {per_area * normal, p[0], p[1], 0., instant.time, instant.wheel_x});
        keep(shear, {per_area * norm(tangential), p[0], p[1], 0., instant.time, instant.wheel_x});
      }
    for (const SurfaceFace &face : faces)
      {
        std::array<Vector3, 4> current;
        Vector3                mean{};
        for (unsigned int a = 0; a < 4; ++a)
          {
            current[a] = x[face.nodes[a]];
            mean += 0.25 * traction[face.surface_nodes[a]];
          }
        const double sheared = std::sqrt(mean[1] * mean[1] + mean[2] * mean[2] + mean[3] * mean[3]);
        keep(from_tractions, {von_mises_at_face(face.reference, current, material, mean[0], sheared), face.x,
                              face.y, 0., instant.time, instant.wheel_x});
      }
    for (const ContactNodeState &state : states)
      traction[state.node] = Vector3{};
  }


  std::vector<Peak> StressPeaks::of_all_ranks() const
  {
    std::vector<Peak>       largest(peaks.size());
    const std::vector<Peak> all = gathered(peaks, comm);
    for (std::size_t i = 0; i < all.size(); ++i)
      largest[i % peaks.size()] = std::max(largest[i % peaks.size()], all[i]);
    return largest;
  }


  StressPeaks::Answer StressPeaks::answer(const ExplicitDynamics &dynamics) const
  {
    const std::vector<Peak>   all     = of_all_ranks();
    const std::vector<double> plastic = dynamics.solid.plastic().equivalent_plastic_strain(dynamics.history);
    std::vector<double>       strain(all.size() - first_layer, 0.);
    if (!plastic.empty())
      for (const Member &member : members)
        strain[member.layer] = std::max(strain[member.layer], plastic[member.cell]);
    dealii::Utilities::MPI::max(strain, comm, strain);
    const auto of_layer = [&](const Peak &peak, const unsigned int layer) {
      const double plastic_part = layer < strain.size() ? strain[layer] : 0.;
      return Layer{peak, peak.value / (3. * material.shear_modulus()) + plastic_part};
    };
    Answer answer{of_layer(all[extrapolated], 0), all[from_tractions], all[pressure], all[shear], {}};
    for (unsigned int layer = 0; layer < strain.size(); ++layer)
      if (const Peak &peak = all[first_layer + layer]; peak.value > 0.)
        answer.layers.push_back(of_layer(peak, layer));
    return answer;
  }


  void StressPeaks::serialize(Archive &archive)
  {
    if (!archive.restores())
      peaks = of_all_ranks();
    archive.same_number(peaks);
  }
} // namespace tread
