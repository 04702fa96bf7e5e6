// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/stress_recovery.h>
#include <tread/base/reproducible_sum.h>
#include <tread/solid/hexahedron.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    using Stress = StressRecovery::Stress;

    /// What is summed at nodes, so that the sums do not depend on the ranks: stresses to 1.5e-5 Pa, with room
    /// for 3e10 Pa; areas to 7e-18 m^2, with room for 0.01 m^2.
    constexpr Quantum stress_quantum(0x1p-16), area_quantum(0x1p-57);

    /// S n.
    Vector3 times(const Stress &S, const Vector3 n)
    {
      return Vector3{S[0] * n[0] + S[3] * n[1] + S[5] * n[2], S[3] * n[0] + S[1] * n[1] + S[4] * n[2],
                     S[5] * n[0] + S[4] * n[1] + S[2] * n[2], 0.};
    }

    /// Add factor (a b^T + b a^T) / 2.
    void add_product(Stress &S, const double factor, const Vector3 a, const Vector3 b)
    {
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int j = (i + 1) % 3;
          S[i] += factor * a[i] * b[i];
          S[3 + i] += 0.5 * factor * (a[i] * b[j] + a[j] * b[i]); // xy, yz, zx
        }
    }

    /// Leave the part along the surface: P S P with P = 1 - n n^T.
    void project(Stress &S, const Vector3 n)
    {
      const Vector3 across = times(S, n);
      const double  normal = dot(across, n);
      add_product(S, -2., across, n);
      add_product(S, normal, n, n);
    }

    /// Add the stress of a traction with this normal part and this part along the surface, and the given
    /// multiple of the normal one in all directions along the surface.
    void add_traction(Stress       &S,
                      const Vector3 n,
                      const double  normal,
                      const Vector3 tangential,
                      const double  share_along)
    {
      for (unsigned int i = 0; i < 3; ++i)
        S[i] += share_along * normal;
      add_product(S, (1. - share_along) * normal, n, n);
      add_product(S, 2., tangential, n);
    }
  } // namespace


  StressRecovery::StressRecovery(const Mesh            &mesh,
                                 const Solid           &solid,
                                 const ContactSurfaces *surfaces,
                                 const ElasticMaterial &material,
                                 const RecoveryExtent  &extent)
    : shared_nodes(&mesh.shared_nodes)
    , on_several_ranks(dealii::Utilities::MPI::n_mpi_processes(mesh.comm) > 1)
    , can_yield(dealii::Utilities::MPI::logical_or(!solid.plastic().empty(), mesh.comm))
    , lame(material.lame())
    , shear_modulus(material.shear_modulus())
  {
    if (on_several_ranks)
      field.resize(mesh.nodes.size());
    number_sites(mesh, solid, extent);
    find_faces(mesh, surfaces, extent);
    surface_stress.resize(surface_sites.size());
    area_and_limit.resize(surface_sites.size());
    edge_stress.resize(edge_sites.size());
  }


  void StressRecovery::number_sites(const Mesh &mesh, const Solid &solid, const RecoveryExtent &extent)
  {
    const std::size_t n_nodes = mesh.nodes.size();
    std::vector<char> at_surface(n_nodes, false), wanted(n_nodes, false);
    for (const unsigned int i : mesh.boundary_nodes(extent.body, Boundary::contact))
      at_surface[i] = true;
    for (unsigned int i = 0; i < n_nodes; ++i)
      wanted[i] = mesh.node_bodies[i] == extent.body && (at_surface[i] || !extent.only_surface) &&
                  extent.contains(mesh.nodes[i]);

    // The four edges into depth of the cells at these nodes: their upper and lower nodes.
    struct Edges
    {
      unsigned int                               cell;
      std::array<std::array<unsigned int, 2>, 4> nodes;
    };
    std::vector<Edges> all;
    std::vector<char>  has_edges(mesh.cells.size(), false);
    const auto         find_edges = [&](const std::vector<char> &chosen) {
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        {
          const auto &nodes = mesh.cells[c].nodes;
          if (mesh.cells[c].material != extent.body || has_edges[c] ||
              std::none_of(nodes.begin(), nodes.end(), [&](const unsigned int i) { return chosen[i]; }))
            continue;
          const auto            corners = mesh.corners(c);
          std::array<double, 3> rise{};
          for (unsigned int a = 0; a < 8; ++a)
            {
              const double depth = extent.depth_of(corners[a]);
              for (unsigned int d = 0; d < 3; ++d)
                rise[d] += linear_pattern(d, a) * depth;
            }
          unsigned int axis = 0;
          for (unsigned int d = 1; d < 3; ++d)
            if (std::abs(rise[d]) > std::abs(rise[axis]))
              axis = d;
          Edges        edges{c, {}};
          unsigned int n = 0;
          for (unsigned int a = 0; a < 8; ++a)
            if (linear_pattern(axis, a) * rise[axis] < 0.)
              edges.nodes[n++] = {{nodes[a], nodes[a ^ (1u << axis)]}};
          all.push_back(edges);
          has_edges[c] = true;
        }
    };
    find_edges(wanted);

    // Edges below those that begin at a node of the surface help; their upper nodes may be alone on a rank.
    NodalField sums(n_nodes, Vector3{});
    for (const Edges &edges : all)
      for (const auto &[upper, lower] : edges.nodes)
        if (wanted[upper] && at_surface[upper])
          sums[lower][0] = 1.;
    mesh.shared_nodes.sum(sums.data());
    std::vector<int> edge_of_node(n_nodes, none);
    for (unsigned int i = 0; i < n_nodes; ++i)
      edge_of_node[i] = wanted[i] || sums[i][0] > 0. ? 0 : none;
    std::vector<char> below(n_nodes, false);
    for (unsigned int i = 0; i < n_nodes; ++i)
      below[i] = sums[i][0] > 0.;
    find_edges(below);

    // Numbers of cells around the edges, and of those with longer time steps; the middles of the edges.
    NodalField middles(n_nodes, Vector3{});
    std::fill(sums.begin(), sums.end(), Vector3{});
    for (const Edges &edges : all)
      for (const auto &[upper, lower] : edges.nodes)
        if (edge_of_node[upper] != none)
          {
            const dealii::Point<3> &p = mesh.nodes[upper], &q = mesh.nodes[lower];
            sums[upper] += Vector3{1., solid.cell_levels()[edges.cell] > 0 ? 1. : 0., 0., 0.};
            middles[upper] += 0.5 * Vector3{p[0] + q[0], p[1] + q[1], p[2] + q[2], 0.};
          }
    mesh.shared_nodes.sum(sums.data());
    mesh.shared_nodes.sum(middles.data());
    for (unsigned int i = 0; i < n_nodes; ++i)
      if (edge_of_node[i] != none)
        {
          const double n = sums[i][0];
          if (n == 0.) // a node at the bottom, or one that hangs above larger cells
            {
              edge_of_node[i] = none;
              continue;
            }
          const Vector3          p = (1. / n) * middles[i];
          const dealii::Point<3> middle(p[0], p[1], p[2]);
          edge_of_node[i] = edge_sites.size();
          edge_sites.push_back({i, middle, extent.depth_of(middle), sums[i][1] == 0.,
                                wanted[i] && mesh.shared_nodes.is_owned(i)});
          cells_around.push_back(n);
        }
    std::vector<char> needs(n_nodes, false);
    for (const Edges &edges : all)
      {
        Cell cell{edges.cell, {}};
        bool helps = false;
        for (unsigned int e = 0; e < 4; ++e)
          {
            cell.edges[e] = edge_of_node[edges.nodes[e][0]];
            helps         = helps || cell.edges[e] != none;
          }
        if (!helps)
          continue;
        own_cells.push_back(cell);
        needed_cells.push_back(edges.cell);
        for (const unsigned int i : mesh.cells[edges.cell].nodes)
          needs[i] = true;
      }
    for (unsigned int i = 0; i < n_nodes; ++i)
      if (needs[i])
        needed_nodes.push_back(i);

    std::vector<int> surface_of_node(n_nodes, none);
    for (unsigned int i = 0; i < n_nodes; ++i)
      if (wanted[i] && at_surface[i])
        {
          const int   below = edge_of_node[i];
          SurfaceNode node{none, below, none, below == none ? 0. : edge_sites[below].depth, 0., 0.};
          surface_of_node[i] = surface_sites.size();
          surface_sites.push_back({i, mesh.nodes[i], 0., below == none || edge_sites[below].every_step,
                                   mesh.shared_nodes.is_owned(i)});
          surface_nodes.push_back(node);
        }
    for (const Edges &edges : all)
      for (const auto &[upper, lower] : edges.nodes)
        if (const int k = surface_of_node[upper]; k != none && edge_of_node[lower] != none)
          {
            SurfaceNode &node = surface_nodes[k];
            node.deeper       = edge_of_node[lower];
            node.deeper_depth = edge_sites[node.deeper].depth;
          }
    // Depths are counted from the surface of the mesh.
    for (std::size_t k = 0; k < surface_sites.size(); ++k)
      {
        const double top = extent.depth_of(surface_sites[k].place);
        surface_nodes[k].depth -= top;
        surface_nodes[k].deeper_depth -= top;
      }
  }


  void StressRecovery::find_faces(const Mesh            &mesh,
                                  const ContactSurfaces *surfaces,
                                  const RecoveryExtent  &extent)
  {
    std::vector<int> site_of_node(mesh.nodes.size(), none);
    for (std::size_t k = 0; k < surface_sites.size(); ++k)
      site_of_node[surface_sites[k].node] = k;
    if (surfaces)
      for (std::size_t k = 0; k < surfaces->nodes.size(); ++k)
        if (const int local = surfaces->nodes[k].local; local >= 0 && site_of_node[local] != none)
          surface_nodes[site_of_node[local]].contact_node = k;
    NodalField        counts(mesh.nodes.size(), Vector3{});
    std::vector<char> needs(mesh.nodes.size(), false);
    for (const unsigned int i : needed_nodes)
      needs[i] = true;
    for (const Mesh::Face &of_mesh : mesh.faces)
      if (of_mesh.body == extent.body && of_mesh.boundary == Boundary::contact)
        {
          Face face{of_mesh.nodes, {}, 0., 0., 0., of_mesh.cell};
          bool helps = false;
          for (unsigned int a = 0; a < 4; ++a)
            {
              face.sites[a] = site_of_node[face.nodes[a]];
              helps         = helps || face.sites[a] != none;
            }
          if (!helps)
            continue;
          std::array<Vector3, 4> p;
          for (unsigned int a = 0; a < 4; ++a)
            {
              const dealii::Point<3> &place = mesh.nodes[face.nodes[a]];
              p[a]                          = Vector3{place[0], place[1], place[2], 0.};
              counts[face.nodes[a]][0] += 1.;
              needs[face.nodes[a]] = true;
            }
          const Vector3 A = 0.5 * ((p[1] - p[0]) + (p[2] - p[3])), B = 0.5 * ((p[3] - p[0]) + (p[2] - p[1]));
          face.length = norm(A);
          face.b1     = dot(A, B) / face.length;
          face.b2     = norm(B - (face.b1 / face.length) * A);
          faces.push_back(face);
        }
    mesh.shared_nodes.sum(counts.data());
    for (std::size_t k = 0; k < surface_sites.size(); ++k)
      surface_nodes[k].n_faces = counts[surface_sites[k].node][0];
    needed_nodes.clear();
    for (unsigned int i = 0; i < needs.size(); ++i)
      if (needs[i])
        needed_nodes.push_back(i);
  }


  void StressRecovery::sum_over_ranks(const std::vector<Site> &sites, std::vector<Stress> &values)
  {
    if (!on_several_ranks)
      return;
    for (const unsigned int half : {0u, 3u})
      {
        for (const unsigned int i : shared_nodes->nodes())
          field[i] = Vector3{};
        for (std::size_t k = 0; k < sites.size(); ++k)
          field[sites[k].node] = Vector3{values[k][half], values[k][half + 1], values[k][half + 2], 0.};
        shared_nodes->sum(field.data());
        for (std::size_t k = 0; k < sites.size(); ++k)
          for (unsigned int d = 0; d < 3; ++d)
            values[k][half + d] = field[sites[k].node][d];
      }
  }


  void StressRecovery::mean_of_cells(const std::vector<Stress> &stress)
  {
    std::fill(edge_stress.begin(), edge_stress.end(), Stress{});
    for (const Cell &cell : own_cells)
      {
        Stress rounded;
        for (unsigned int k = 0; k < 6; ++k)
          rounded[k] = stress_quantum.round(stress[cell.number][k]);
        for (const int edge : cell.edges)
          if (edge != none)
            for (unsigned int k = 0; k < 6; ++k)
              edge_stress[edge][k] += rounded[k];
      }
    sum_over_ranks(edge_sites, edge_stress);
    for (std::size_t e = 0; e < edge_stress.size(); ++e)
      for (double &component : edge_stress[e])
        component /= cells_around[e];
  }


  void StressRecovery::stretch_of_faces(const Vector3 *x, const std::vector<double> &yield_limits)
  {
    std::fill(surface_stress.begin(), surface_stress.end(), Stress{});
    area_and_limit.assign(surface_stress.size(), Stress{});
    const double plane_lame = 2. * shear_modulus * lame / (lame + 2. * shear_modulus);
    for (const Face &face : faces)
      {
        const Vector3 p0 = x[face.nodes[0]], p1 = x[face.nodes[1]], p2 = x[face.nodes[2]],
                      p3 = x[face.nodes[3]];
        const Vector3 a = 0.5 * ((p1 - p0) + (p2 - p3)), b = 0.5 * ((p3 - p0) + (p2 - p1));
        const Vector3 area = 0.125 * cross(p2 - p0, p3 - p1); // a quarter for each node
        // Deformation gradient F of the face in axes along and across A, and its Green-Lagrange strain E;
        // to second order logarithmic strain E - E^2 and rotated axes F (1 + 2 E)^(-1/2).
        const Vector3 f1 = (1. / face.length) * a, f2 = (1. / face.b2) * (b - (face.b1 / face.length) * a);
        const double  E11 = 0.5 * (dot(f1, f1) - 1.), E22 = 0.5 * (dot(f2, f2) - 1.), E12 = 0.5 * dot(f1, f2);
        const double  q11 = E11 * E11 + E12 * E12, q22 = E22 * E22 + E12 * E12, q12 = E12 * (E11 + E22);
        const double  e11 = E11 - q11, e22 = E22 - q22, e12 = E12 - q12;
        const Vector3 t1    = f1 - (E11 - 1.5 * q11) * f1 - (E12 - 1.5 * q12) * f2,
                      t2    = f2 - (E22 - 1.5 * q22) * f2 - (E12 - 1.5 * q12) * f1;
        const double volume = plane_lame * (e11 + e22);
        Stress       plane{};
        add_product(plane, volume + 2. * shear_modulus * e11, t1, t1);
        add_product(plane, volume + 2. * shear_modulus * e22, t2, t2);
        add_product(plane, 4. * shear_modulus * e12, t1, t2);
        const double limit = yield_limits.empty() ? 0. : yield_limits[face.cell];
        for (const int site : face.sites)
          if (site != none)
            {
              for (unsigned int k = 0; k < 6; ++k)
                surface_stress[site][k] += stress_quantum.round(plane[k]);
              Stress &others = area_and_limit[site];
              for (unsigned int d = 0; d < 3; ++d)
                others[d] += area_quantum.round(area[d]);
              others[3] += stress_quantum.round(limit);
              others[4] += limit > 0. ? 1. : 0.;
            }
      }
    sum_over_ranks(surface_sites, surface_stress);
    sum_over_ranks(surface_sites, area_and_limit);
  }


  Stress StressRecovery::of_yielded(const SurfaceNode &node,
                                    const Vector3      normal,
                                    const Vector3      traction,
                                    const double       limit) const
  {
    Stress S = edge_stress[node.below];
    if (node.deeper != none)
      for (unsigned int k = 0; k < 6; ++k)
        S[k] += (S[k] - edge_stress[node.deeper][k]) * node.depth / (node.deeper_depth - node.depth);
    project(S, normal);
    const double  across     = dot(traction, normal);
    const Vector3 tangential = traction - across * normal;
    // Over equal stress in all directions. Its equivalent and that of the shear stress across the surface
    // add by their squares.
    for (unsigned int i = 0; i < 3; ++i)
      S[i] -= across;
    add_product(S, across, normal, normal);
    const double equivalent = von_mises(S), room = limit * limit - 3. * dot(tangential, tangential);
    if (equivalent * equivalent > room)
      for (double &component : S)
        component *= std::sqrt(std::max(0., room)) / equivalent;
    add_traction(S, normal, across, tangential, 1.);
    return S;
  }


  void StressRecovery::recover(const Vector3              *x,
                               const std::vector<Stress>  &stress,
                               const std::vector<double>  &yield_limits,
                               const std::vector<Vector3> &impulses,
                               const double                time_step)
  {
    mean_of_cells(stress);
    stretch_of_faces(x, yield_limits);
    const double share_along = lame / (lame + 2. * shear_modulus);
    for (std::size_t k = 0; k < surface_sites.size(); ++k)
      {
        const SurfaceNode &node   = surface_nodes[k];
        const Stress      &others = area_and_limit[k];
        const Vector3      area{others[0], others[1], others[2], 0.};
        const double       size     = norm(area);
        const Vector3      normal   = (1. / size) * area;
        const Vector3      traction = impulses.empty() || node.contact_node == none
                                        ? Vector3{}
                                        : (1. / (time_step * size)) * impulses[node.contact_node];
        const bool         yielded  = can_yield && others[4] > 0. && node.below != none;
        Stress            &S        = surface_stress[k];
        if (yielded)
          {
            S = of_yielded(node, normal, traction, others[3] / others[4]);
            continue;
          }
        for (double &component : S)
          component /= node.n_faces;
        project(S, normal);
        const double across = dot(traction, normal);
        add_traction(S, normal, across, traction - across * normal, share_along);
        if (node.deeper == none)
          continue;
        Stress       &upper = edge_stress[node.below];
        const Stress &lower = edge_stress[node.deeper];
        const double  d = node.depth, between = node.deeper_depth - node.depth;
        for (unsigned int c = 0; c < 6; ++c)
          upper[c] -= d * d / node.deeper_depth * ((lower[c] - upper[c]) / between - (upper[c] - S[c]) / d);
      }
  }


  void StressRecovery::recover(const ExplicitDynamics &dynamics, const Contact *contact)
  {
    std::vector<char> wanted(dynamics.mesh.cells.size(), false);
    for (const unsigned int c : needed_cells)
      wanted[c] = true;
    const NodalField x = dynamics.state.positions();
    recover(x.data(), dynamics.solid.cauchy_stress(x.data(), dynamics.state.history, wanted),
            dynamics.solid.plastic().yield_limits(dynamics.state.history),
            contact ? contact->surface_impulses() : std::vector<Vector3>(), dynamics.state.time_step);
  }


  NodalStresses::NodalStresses(const ExplicitDynamics           &dynamics,
                               const Contact                    *contact,
                               const std::vector<RecoveredBody> &bodies)
    : dynamics(dynamics)
    , contact(contact)
  {
    const Mesh &mesh = dynamics.mesh;
    for (const RecoveredBody &of_body : bodies)
      surfaces.emplace_back(
        mesh, dynamics.solid, contact ? &contact->surfaces : nullptr, of_body.material,
        RecoveryExtent{of_body.body, of_body.depth_of, [](const dealii::Point<3> &) { return true; }, true});
    NodalField counts(mesh.nodes.size(), Vector3{});
    for (const Mesh::Cell &cell : mesh.cells)
      for (const unsigned int i : cell.nodes)
        counts[i][0] += 1.;
    mesh.shared_nodes.sum(counts.data());
    for (const Vector3 &count : counts)
      cells_around.push_back(count[0]);
  }


  std::vector<Stress> NodalStresses::at_present()
  {
    const Mesh                &mesh     = dynamics.mesh;
    const NodalField           x        = dynamics.state.positions();
    const std::vector<Stress>  stress   = dynamics.solid.cauchy_stress(x.data(), dynamics.state.history);
    const std::vector<double>  limits   = dynamics.solid.plastic().yield_limits(dynamics.state.history);
    const std::vector<Vector3> impulses = contact ? contact->surface_impulses() : std::vector<Vector3>();
    std::vector<Stress>        nodal(mesh.nodes.size());
    for (const unsigned int half : {0u, 3u})
      {
        NodalField sums(mesh.nodes.size(), Vector3{});
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          for (const unsigned int i : mesh.cells[c].nodes)
            for (unsigned int d = 0; d < 3; ++d)
              sums[i][d] += stress_quantum.round(stress[c][half + d]);
        mesh.shared_nodes.sum(sums.data());
        for (std::size_t i = 0; i < nodal.size(); ++i)
          for (unsigned int d = 0; d < 3; ++d)
            nodal[i][half + d] = sums[i][d] / cells_around[i];
      }
    for (StressRecovery &surface : surfaces)
      {
        surface.recover(x.data(), stress, limits, impulses, dynamics.state.time_step);
        for (std::size_t k = 0; k < surface.at_surface().size(); ++k)
          nodal[surface.at_surface()[k].node] = surface.stress_at_surface()[k];
      }
    return nodal;
  }
} // namespace tread
