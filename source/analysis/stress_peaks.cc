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

    /// Cells whose centres lie deeper than that below their tops, in finest cells, are larger than these.
    constexpr double half_of_larger = 0.75;
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
                           const bool              is_slave,
                           const unsigned int      body,
                           const ElasticMaterial  &material,
                           const PeakRegion       &region)
    : comm(dynamics.mesh.comm)
    , region(region)
    , material(material)
    , recovery(dynamics.mesh,
               dynamics.solid,
               contact ? &contact->surfaces : nullptr,
               material,
               {body, region.depth_of, [this](const dealii::Point<3> &p) {
                  return contains(p);
                }})
  {
    const std::string of_body = body == 0 ? "rail" : "wheel";
    find_members(dynamics, body);
    find_places(dynamics.mesh);
    if (dealii::Utilities::MPI::sum(below_surface.size() + centres.size(), comm) == 0)
      throw InputError("the region of 'Peak stress' holds no edge between cells of the " + of_body +
                       ": make it longer, wider or deeper");
    if (dealii::Utilities::MPI::sum(at_surface.size(), comm) == 0)
      throw InputError("the region of 'Peak stress' holds no node of the surface of the " + of_body +
                       " that can be in contact: make it longer or wider");
    if (contact && is_slave)
      find_faces(dynamics, *contact);
    unsigned int n_slots = first_layer;
    for (const auto *places : {&below_surface, &centres})
      for (const Place &place : *places)
        n_slots = std::max(n_slots, place.slot + 1);
    for (const Member &member : members)
      n_slots = std::max(n_slots, first_layer + member.layer + 1);
    peaks.resize(dealii::Utilities::MPI::max(n_slots, comm));
  }


  bool StressPeaks::contains(const dealii::Point<3> &p) const
  {
    constexpr double round_off = 1e-9; // m
    const double     along     = region.along(p);
    return along >= region.x_begin - round_off && along <= region.x_end + round_off &&
           std::abs(region.beside(p)) <= region.half_width + round_off &&
           region.depth_of(p) <= region.depth;
  }


  void StressPeaks::find_members(const ExplicitDynamics &dynamics, const unsigned int body)
  {
    const Mesh       &mesh  = dynamics.mesh;
    const Solid      &solid = dynamics.solid;
    std::vector<char> needed(mesh.cells.size(), false), needs_node(mesh.nodes.size(), false);
    for (const unsigned int c : recovery.cells())
      needed[c] = true;
    nodes = recovery.nodes();
    for (const unsigned int i : nodes)
      needs_node[i] = true;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.cells[c].material == body)
        {
          const auto             corners = mesh.corners(c);
          const dealii::Point<3> centre  = centre_of(corners);
          if (!contains(centre))
            continue;
          const double depth = region.depth_of(centre);
          members.push_back({c, layer_at(depth, region.finest_cell)});
          double top = depth;
          for (const dealii::Point<3> &p : corners)
            top = std::min(top, region.depth_of(p));
          if (depth - top < half_of_larger * region.finest_cell)
            continue;
          centres.push_back({c, first_layer + members.back().layer, region.along(centre), centre[1], depth,
                             solid.cell_levels()[c] == 0});
          needed[c] = true;
          for (const unsigned int i : mesh.cells[c].nodes)
            if (!needs_node[i])
              {
                needs_node[i] = true;
                nodes.push_back(i);
              }
        }
    std::vector<unsigned int> elastic;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (!needed[c])
        continue;
      else if (!solid.plastic().contains(c))
        elastic.push_back(c);
      else
        {
          plastic_members.resize(mesh.cells.size(), false);
          plastic_members[c] = true;
        }
    groups = solid.groups_of(mesh, body, elastic);
    x.resize(mesh.nodes.size());
    stress.resize(mesh.cells.size());
  }


  void StressPeaks::find_places(const Mesh &mesh)
  {
    const auto place_of = [&](const StressRecovery::Site &site, const unsigned int number) {
      return Place{number, surface, region.along(site.place), site.place[1], site.depth, site.every_step};
    };
    for (unsigned int k = 0; k < recovery.at_surface().size(); ++k)
      if (const StressRecovery::Site &site = recovery.at_surface()[k]; site.wanted)
        at_surface.push_back(place_of(site, k));
    for (unsigned int k = 0; k < recovery.below_surface().size(); ++k)
      if (const StressRecovery::Site &site = recovery.below_surface()[k];
          site.wanted && site.depth <= region.depth &&
          site.depth - region.depth_of(mesh.nodes[site.node]) < half_of_larger * region.finest_cell)
        {
          below_surface.push_back(place_of(site, k));
          below_surface.back().slot = first_layer + layer_at(site.depth, region.finest_cell);
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
    std::vector<char> known(mesh.nodes.size(), false);
    for (const unsigned int i : nodes)
      known[i] = true;
    for (const Mesh::Face &face : mesh.faces)
      if (face.boundary == Boundary::contact && is_member[face.cell] &&
          std::all_of(face.nodes.begin(), face.nodes.end(), [&](const unsigned int i) { return known[i]; }))
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
                           const std::vector<Vector3>          &impulses,
                           const double                         wheel_x)
  {
    const Instant instant{dynamics.state.time, wheel_x, dynamics.synchronised()};
    for (const unsigned int i : nodes)
      x[i] = dynamics.state.position(i);
    for (const auto &group : groups)
      group->set_cauchy_stress(x.data(), {}, stress);
    std::vector<double> yield_limits;
    if (!plastic_members.empty())
      {
        dynamics.solid.plastic().cauchy_stress(x.data(), dynamics.state.history, stress, plastic_members);
        yield_limits = dynamics.solid.plastic().yield_limits(dynamics.state.history);
      }
    recovery.recover(x.data(), stress, yield_limits, impulses, dynamics.state.time_step);
    sample_places(at_surface, recovery.stress_at_surface(), instant);
    sample_places(below_surface, recovery.stress_below_surface(), instant);
    sample_places(centres, stress, instant);
    sample_surface(states, dynamics.state.time_step, instant);
  }


  void StressPeaks::sample_places(const std::vector<Place>                  &places,
                                  const std::vector<StressRecovery::Stress> &stresses,
                                  const Instant                             &instant)
  {
    for (const Place &place : places)
      if (place.every_step || instant.all)
        keep(place.slot,
             {von_mises(stresses[place.site]), place.x, place.y, place.depth, instant.time, instant.wheel_x});
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
            std::abs(region.beside(dealii::Point<3>(p[0], p[1], p[2]))) > region.half_width)
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
    const std::vector<Peak>   all = of_all_ranks();
    const std::vector<double> plastic =
      dynamics.solid.plastic().equivalent_plastic_strain(dynamics.state.history);
    std::vector<double> strain(all.size() - first_layer, 0.);
    if (!plastic.empty())
      for (const Member &member : members)
        strain[member.layer] = std::max(strain[member.layer], plastic[member.cell]);
    dealii::Utilities::MPI::max(strain, comm, strain);
    const auto of_layer = [&](const Peak &peak, const unsigned int layer) {
      const double plastic_part = layer < strain.size() ? strain[layer] : 0.;
      return Layer{peak, peak.value / (3. * material.shear_modulus()) + plastic_part};
    };
    Answer answer{of_layer(all[surface], 0), all[from_tractions], all[pressure], all[shear], {}};
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
