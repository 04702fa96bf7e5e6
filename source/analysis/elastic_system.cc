// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/elastic_system.h>
#include <tread/base/gathered.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/lac/exceptions.h>

#include "petsc_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace tread
{
  namespace
  {
    /// Of a vector from which the part in a basis has been subtracted, less than this share of its size is
    /// rounding.
    constexpr double rounding_share = 1e-8;

    /// Displacement by which forces are differentiated, over the size of a cell. Central differences then
    /// leave an error of the order of its square, 1e-10, and rounding one of 1e-16/1e-5: both vanish beside
    /// any other error, at half and at double the value, too.
    constexpr double difference_step = 1e-5;

    /// Cells that are differentiated together: enough to fill the vector lanes, few enough for the cache.
    constexpr unsigned int cells_at_once = 1024;

    using CellMatrix = std::array<std::array<double, 24>, 24>;

    /// K -> (1 - R R^T) K (1 - R R^T) with the six rigid motions R of a cell, and symmetric.
    void without_rigid_motions(CellMatrix &K, const std::array<dealii::Point<3>, 8> &corners)
    {
      dealii::Point<3> centre;
      for (const dealii::Point<3> &corner : corners)
        centre += corner / 8.;
      std::array<std::array<double, 24>, 6> R{};
      for (unsigned int a = 0; a < 8; ++a)
        {
          const dealii::Tensor<1, 3> r = corners[a] - centre;
          for (unsigned int d = 0; d < 3; ++d)
            {
              const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
              R[d][3 * a + d]     = 1.;
              R[3 + d][3 * a + e] = -r[f];
              R[3 + d][3 * a + f] = r[e];
            }
        }
      const auto product = [](const std::array<double, 24> &a, const std::array<double, 24> &b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
      };
      for (unsigned int m = 0; m < 6; ++m)
        {
          for (unsigned int n = 0; n < m; ++n)
            {
              const double share = product(R[m], R[n]);
              for (unsigned int i = 0; i < 24; ++i)
                R[m][i] -= share * R[n][i];
            }
          const double size = std::sqrt(product(R[m], R[m]));
          for (double &value : R[m])
            value /= size;
        }
      for (unsigned int i = 0; i < 24; ++i)
        for (unsigned int j = 0; j < i; ++j)
          K[i][j] = K[j][i] = 0.5 * (K[i][j] + K[j][i]);
      for (unsigned int side = 0; side < 2; ++side)
        {
          for (auto &row : K)
            for (const auto &mode : R)
              {
                const double share = product(row, mode);
                for (unsigned int i = 0; i < 24; ++i)
                  row[i] -= share * mode[i];
              }
          for (unsigned int i = 0; i < 24; ++i)
            for (unsigned int j = 0; j < i; ++j)
              std::swap(K[i][j], K[j][i]);
        }
      for (unsigned int i = 0; i < 24; ++i)
        for (unsigned int j = 0; j < i; ++j)
          K[i][j] = K[j][i] = 0.5 * (K[i][j] + K[j][i]);
    }

    /// Stiffness of cells of one material, N/m: the derivative of the forces of their element. Each cell gets
    /// nodes of its own, so that one evaluation of the forces serves the same unknown of all of them. @param
    /// loose a mesh whose nodes and cells are replaced by these
    std::vector<CellMatrix> cell_stiffness(Mesh                                               &loose,
                                           const std::vector<std::array<dealii::Point<3>, 8>> &corners,
                                           const Element                                      &element,
                                           const ElasticMaterial                              &material)
    {
      const unsigned int        n = corners.size();
      std::vector<unsigned int> cells(n);
      loose.nodes.clear();
      loose.cells.clear();
      std::iota(cells.begin(), cells.end(), 0u);
      for (unsigned int c = 0; c < n; ++c)
        {
          Mesh::Cell cell;
          cell.body = cell.material = 0;
          for (unsigned int a = 0; a < 8; ++a)
            {
              cell.nodes[a] = 8 * c + a;
              loose.nodes.push_back(corners[c][a]);
            }
          loose.cells.push_back(cell);
        }
      const auto groups = element.make_groups(loose, material, cells);

      NodalField x(8 * n), v(8 * n, Vector3{}), force(8 * n);
      for (unsigned int i = 0; i < 8 * n; ++i)
        x[i] = Vector3{loose.nodes[i][0], loose.nodes[i][1], loose.nodes[i][2], 0.};
      std::vector<double> step(n);
      for (unsigned int c = 0; c < n; ++c)
        step[c] = difference_step * std::cbrt(HexahedronIntegrals(corners[c]).volume);
      std::vector<CellMatrix> matrices(n, CellMatrix{});
      for (unsigned int j = 0; j < 24; ++j)
        for (const double sign : {1., -1.})
          {
            for (unsigned int c = 0; c < n; ++c)
              x[8 * c + j / 3][j % 3] = corners[c][j / 3][j % 3] + sign * step[c];
            std::fill(force.begin(), force.end(), Vector3{});
            for (const auto &group : groups)
              group->add_forces(x.data(), v.data(), force.data(), 1.);
            for (unsigned int c = 0; c < n; ++c)
              {
                for (unsigned int i = 0; i < 24; ++i)
                  matrices[c][i][j] -= sign * 0.5 / step[c] * force[8 * c + i / 3][i % 3];
                x[8 * c + j / 3][j % 3] = corners[c][j / 3][j % 3];
              }
          }
      for (unsigned int c = 0; c < n; ++c)
        without_rigid_motions(matrices[c], corners[c]);
      return matrices;
    }
  } // namespace


  ElasticSystem::ElasticSystem(const Mesh                         &mesh,
                               const std::vector<char>            &with_body,
                               const std::vector<ElasticMaterial> &materials,
                               const SolidParameters              &parameters)
    : mesh(mesh)
    , with_body(with_body)
    , materials(materials)
    , parameters(parameters)
    , node_masses(mesh.nodes.size(), 0.)
    , node_damping(mesh.nodes.size(), 0.)
    , held(mesh.nodes.size(), std::array<char, 3>{})
    , carried(mesh.nodes.size(), false)
    , hanging(mesh.nodes.size(), -1)
  {
    // Bulk viscosity is a damper.
    this->parameters.linear_bulk_viscosity = this->parameters.quadratic_bulk_viscosity = 0.;
    for (unsigned int h = 0; h < mesh.hanging_nodes.size(); ++h)
      hanging[mesh.hanging_nodes[h].node] = h;
    NodalField mass(mesh.nodes.size(), Vector3{});
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (with_body[mesh.cells[c].body])
        {
          const auto volume = HexahedronIntegrals(mesh.corners(c)).node_volume;
          for (unsigned int a = 0; a < 8; ++a)
            mass[mesh.cells[c].nodes[a]][0] += materials[mesh.cells[c].material].density * volume[a];
        }
    mesh.condense_hanging_nodes(mass.data());
    mesh.shared_nodes.sum(mass.data());
    for (unsigned int i = 0; i < mass.size(); ++i)
      node_masses[i] = hanging[i] >= 0 ? 0. : mass[i][0];
  }


  ElasticSystem::~ElasticSystem()
  {
    for (Mat *matrix : {&K, &M, &C})
      MatDestroy(matrix);
  }


  void ElasticSystem::fix_nodes(const std::vector<unsigned int> &nodes)
  {
    for (unsigned int d = 0; d < 3; ++d)
      guide_nodes(nodes, d);
  }


  void ElasticSystem::guide_nodes(const std::vector<unsigned int> &nodes, const unsigned int direction)
  {
    for (const unsigned int i : nodes)
      held[i][direction] = true;
  }


  void ElasticSystem::attach_hub(WheelHub given, const unsigned int body, const HubFreedom &may)
  {
    hub.freedom = may;
    hub.x       = given.start()[0];
    hub.z       = given.start()[2];
    for (const unsigned int i : mesh.boundary_nodes(body, Boundary::support))
      {
        carried[i]     = true;
        node_masses[i] = 0.; // the mass of the hub contains theirs
      }
    std::vector<double> sums(4, 0.);
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == body && mesh.shared_nodes.is_owned(i))
        {
          const double rx = mesh.nodes[i][0] - hub.x, rz = mesh.nodes[i][2] - hub.z, m = node_masses[i];
          sums[0] += m;
          sums[1] += m * (rx * rx + rz * rz);
          sums[2] += m * rx;
          sums[3] += m * rz;
        }
    dealii::Utilities::MPI::sum(sums, mesh.comm, sums);
    given.take_out(sums[0], sums[1], Vector3{sums[2], 0., sums[3], 0.});
    hub.parameters     = given.parameters;
    hub.first_moment_x = -sums[2];
    hub.first_moment_z = -sums[3];
    hub.is_there       = true;
  }


  void ElasticSystem::attach_supports(const Supports &s)
  {
    supports = &s;
  }


  void ElasticSystem::damp_nodes(const unsigned int                                     body,
                                 const std::function<double(const dealii::Point<3> &)> &rate)
  {
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == body)
        node_damping[i] += rate(mesh.nodes[i]);
  }


  void ElasticSystem::number_unknowns()
  {
    unknowns.assign(mesh.nodes.size(), {none, none, none});
    const auto moves = [&](const unsigned int i, const unsigned int d) {
      return node_masses[i] > 0. && !held[i][d];
    };
    n_own = 0;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        for (unsigned int d = 0; d < 3; ++d)
          n_own += moves(i, d);
    const std::vector<long long> counts = gathered(std::vector<long long>{n_own}, mesh.comm);
    const unsigned int           rank   = dealii::Utilities::MPI::this_mpi_process(mesh.comm);
    first_own                           = std::accumulate(counts.begin(), counts.begin() + rank, 0ll);
    n_global                            = std::accumulate(counts.begin(), counts.end(), 0ll);

    // Copies on other ranks learn the number of a node's first unknown from its owner.
    NodalField numbers(mesh.nodes.size(), Vector3{});
    long long  next = first_own;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        {
          numbers[i][0] = next;
          for (unsigned int d = 0; d < 3; ++d)
            next += moves(i, d);
        }
    mesh.shared_nodes.sum(numbers.data());
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      {
        long long number = std::llround(numbers[i][0]);
        for (unsigned int d = 0; d < 3; ++d)
          if (moves(i, d))
            unknowns[i][d] = number++;
      }

    const long long n_of_nodes = n_global;
    if (hub.is_there)
      {
        hub.up     = n_global++;
        hub.along  = hub.freedom.moves_along ? n_global++ : none;
        hub.turn   = hub.freedom.turns ? n_global++ : none;
        hub.sprung = hub.freedom.is_suspended && hub.parameters.sprung_mass > 0. ? n_global++ : none;
      }
    if (supports && supports->n_rigid_sleepers() > 0)
      {
        first_sleeper = n_global;
        n_global += supports->n_rigid_sleepers();
      }
    if (rank + 1 == counts.size())
      n_own += n_global - n_of_nodes;
  }


  void ElasticSystem::expand(const unsigned int node,
                             const unsigned int d,
                             const double       weight,
                             LinearForm        &form) const
  {
    if (hanging[node] >= 0)
      for (const unsigned int parent : mesh.hanging_nodes[hanging[node]].parents)
        expand(parent, d, Mesh::HangingNode::weight * weight, form);
    else if (carried[node])
      {
        const auto add = [&](const long long unknown, const double share) {
          if (unknown != none)
            form.push_back({unknown, share * weight});
        };
        if (d == 0)
          {
            add(hub.along, 1.);
            add(hub.turn, mesh.nodes[node][2] - hub.z);
          }
        else if (d == 2)
          {
            add(hub.up, 1.);
            add(hub.turn, -(mesh.nodes[node][0] - hub.x));
          }
      }
    else if (unknowns[node][d] != none)
      form.push_back({unknowns[node][d], weight});
  }


  void ElasticSystem::gather_links()
  {
    links.clear();
    if (!supports)
      return;
    struct Piece
    {
      long long link, unknown;
      double    weight;
    };
    const std::vector<Supports::Link> list = supports->links();
    std::vector<Piece>                pieces;
    for (unsigned int l = 0; l < list.size(); ++l)
      {
        LinearForm form;
        for (const auto &[node, share] : list[l].nodes)
          expand(node, 2, share, form);
        for (const Term &term : form)
          pieces.push_back({l, term.unknown, term.weight});
      }
    for (const Supports::Link &link : list)
      {
        links.push_back({{}, link.stiffness, link.damping, {link.support, link.layer}});
        for (const auto &[sleeper, share] : link.sleepers)
          links.back().form.push_back({first_sleeper + sleeper, share});
      }
    for (const Piece &piece : gathered(pieces, mesh.comm))
      links[piece.link].form.push_back({piece.unknown, piece.weight});
    for (Link &link : links)
      {
        std::map<long long, double> unique;
        for (const Term &term : link.form)
          unique[term.unknown] += term.weight;
        link.form.clear();
        for (const auto &[unknown, weight] : unique)
          link.form.push_back({unknown, weight});
      }
  }


  void ElasticSystem::add_cells(Mat matrix) const
  {
    const auto element = element_named(parameters.element).make(parameters);
    Mesh       loose   = mesh;
    for (unsigned int material = 0; material < materials.size(); ++material)
      {
        std::vector<unsigned int> cells;
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (with_body[mesh.cells[c].body] && mesh.cells[c].material == material)
            cells.push_back(c);
        for (std::size_t first = 0; first < cells.size(); first += cells_at_once)
          {
            std::vector<std::array<dealii::Point<3>, 8>> corners;
            for (std::size_t k = first; k < std::min(cells.size(), first + cells_at_once); ++k)
              corners.push_back(mesh.corners(cells[k]));
            const std::vector<CellMatrix> matrices =
              cell_stiffness(loose, corners, *element, materials[material]);
            for (unsigned int k = 0; k < corners.size(); ++k)
              {
                std::array<LinearForm, 24> forms;
                std::vector<PetscInt>      rows;
                for (unsigned int i = 0; i < 24; ++i)
                  {
                    expand(mesh.cells[cells[first + k]].nodes[i / 3], i % 3, 1., forms[i]);
                    for (const Term &term : forms[i])
                      rows.push_back(term.unknown);
                  }
                std::sort(rows.begin(), rows.end());
                rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
                std::vector<double> block(rows.size() * rows.size(), 0.);
                const auto          place = [&](const Term &term) {
                  return std::lower_bound(rows.begin(), rows.end(), term.unknown) - rows.begin();
                };
                for (unsigned int i = 0; i < 24; ++i)
                  for (unsigned int j = 0; j < 24; ++j)
                    for (const Term &row : forms[i])
                      for (const Term &column : forms[j])
                        block[place(row) * rows.size() + place(column)] +=
                          row.weight * column.weight * matrices[k][i][j];
                check_petsc(MatSetValues(matrix, rows.size(), rows.data(), rows.size(), rows.data(),
                                         block.data(), ADD_VALUES));
              }
          }
      }
  }


  void ElasticSystem::add_links(Mat stiffness, Mat damping) const
  {
    if (dealii::Utilities::MPI::this_mpi_process(mesh.comm) != 0)
      return;
    const auto add = [](Mat matrix, const LinearForm &form, const double factor) {
      if (matrix)
        for (const Term &row : form)
          for (const Term &column : form)
            check_petsc(MatSetValue(matrix, row.unknown, column.unknown, factor * row.weight * column.weight,
                                    ADD_VALUES));
    };
    for (const Link &link : links)
      {
        add(stiffness, link.form, link.stiffness);
        add(damping, link.form, link.damping);
      }
    if (hub.is_there && hub.freedom.is_suspended)
      {
        LinearForm suspension{{hub.up, 1.}};
        if (hub.sprung != none)
          suspension.push_back({hub.sprung, -1.});
        add(stiffness, suspension, hub.parameters.suspension_stiffness);
        add(damping, suspension, hub.parameters.suspension_damping);
      }
  }


  void ElasticSystem::add_inertia(Mat mass, Mat damping) const
  {
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        for (unsigned int d = 0; d < 3; ++d)
          if (const PetscInt k = unknowns[i][d]; k != none)
            {
              if (mass)
                check_petsc(MatSetValue(mass, k, k, node_masses[i], ADD_VALUES));
              if (damping && node_damping[i] > 0.)
                check_petsc(MatSetValue(damping, k, k, node_damping[i] * node_masses[i], ADD_VALUES));
            }
    if (!mass || dealii::Utilities::MPI::this_mpi_process(mesh.comm) != 0)
      return;
    const auto add = [&](const long long row, const long long column, const double value) {
      if (row == none || column == none)
        return;
      check_petsc(MatSetValue(mass, row, column, value, ADD_VALUES));
      if (row != column)
        check_petsc(MatSetValue(mass, column, row, value, ADD_VALUES));
    };
    if (hub.is_there)
      {
        add(hub.along, hub.along, hub.parameters.mass);
        add(hub.up, hub.up, hub.parameters.mass);
        add(hub.turn, hub.turn, hub.parameters.moment_of_inertia);
        add(hub.along, hub.turn, hub.first_moment_z);
        add(hub.up, hub.turn, -hub.first_moment_x);
        add(hub.sprung, hub.sprung, hub.parameters.sprung_mass);
      }
    for (unsigned int s = 0; first_sleeper != none && s < supports->n_rigid_sleepers(); ++s)
      add(first_sleeper + s, first_sleeper + s, supports->parameters.sleeper_mass);
  }


  template <typename Fill>
  Mat ElasticSystem::make_matrix(const Fill &fill) const
  {
    const auto of_type = [&](const MatType type) {
      Mat matrix;
      check_petsc(MatCreate(mesh.comm, &matrix));
      check_petsc(MatSetSizes(matrix, n_own, n_own, n_global, n_global));
      check_petsc(MatSetType(matrix, type));
      return matrix;
    };
    const auto finish = [&](Mat matrix) {
      // Each row has a place on the diagonal.
      PetscInt begin, end;
      check_petsc(MatGetOwnershipRange(matrix, &begin, &end));
      for (PetscInt i = begin; i < end; ++i)
        check_petsc(MatSetValue(matrix, i, i, 0., ADD_VALUES));
      fill(matrix);
      check_petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
      check_petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
    };
    Mat places = of_type(MATPREALLOCATOR);
    check_petsc(MatSetUp(places));
    finish(places);
    Mat matrix = of_type(MATAIJ);
    check_petsc(MatPreallocatorPreallocate(places, PETSC_TRUE, matrix));
    check_petsc(MatDestroy(&places));
    check_petsc(MatSetOption(matrix, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE));
    finish(matrix);
    check_petsc(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
    check_petsc(MatSetOption(matrix, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
    return matrix;
  }


  void ElasticSystem::assemble()
  {
    number_unknowns();
    gather_links();
    K = make_matrix([&](Mat matrix) {
      add_cells(matrix);
      add_links(matrix, nullptr);
    });
    M = make_matrix([&](Mat matrix) { add_inertia(matrix, nullptr); });
    C = make_matrix([&](Mat matrix) {
      add_links(nullptr, matrix);
      add_inertia(nullptr, matrix);
    });
  }


  Vec ElasticSystem::new_vector() const
  {
    Vec vector;
    check_petsc(MatCreateVecs(K, &vector, nullptr));
    check_petsc(VecSet(vector, 0.));
    return vector;
  }


  Vec ElasticSystem::force_on(const Place &place) const
  {
    Vec        vector = new_vector();
    LinearForm form;
    for (const auto &[node, share] : place)
      expand(node, 2, share, form);
    for (const Term &term : form)
      check_petsc(VecSetValue(vector, term.unknown, term.weight, ADD_VALUES));
    check_petsc(VecAssemblyBegin(vector));
    check_petsc(VecAssemblyEnd(vector));
    return vector;
  }


  std::vector<Vec> ElasticSystem::damper_forces() const
  {
    std::map<std::pair<unsigned int, int>, std::vector<const Link *>> groups;
    for (const Link &link : links)
      if (link.damping > 0.)
        groups[link.layer].push_back(&link);
    std::vector<Vec> vectors;
    for (const auto &group : groups)
      {
        Vec vector = new_vector();
        if (dealii::Utilities::MPI::this_mpi_process(mesh.comm) == 0)
          for (const Link *link : group.second)
            for (const Term &term : link->form)
              check_petsc(VecSetValue(vector, term.unknown, term.weight / group.second.size(), ADD_VALUES));
        check_petsc(VecAssemblyBegin(vector));
        check_petsc(VecAssemblyEnd(vector));
        vectors.push_back(vector);
      }
    return vectors;
  }


  NodalField ElasticSystem::displacements(const Vec vector, RigidParts &parts) const
  {
    PetscInt begin, end;
    check_petsc(VecGetOwnershipRange(vector, &begin, &end));
    const PetscScalar *values;
    check_petsc(VecGetArrayRead(vector, &values));
    const auto own = [&](const long long k) {
      return k >= begin && k < end ? values[k - begin] : 0.;
    };
    std::vector<double> rigid{own(hub.along), own(hub.up), own(hub.turn), own(hub.sprung)};
    for (unsigned int s = 0; first_sleeper != none && s < supports->n_rigid_sleepers(); ++s)
      rigid.push_back(own(first_sleeper + s));
    dealii::Utilities::MPI::sum(rigid, mesh.comm, rigid);
    parts = {rigid[0], rigid[1], rigid[2], rigid[3], {rigid.begin() + 4, rigid.end()}};

    NodalField u(mesh.nodes.size(), Vector3{});
    for (unsigned int i = 0; i < u.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        for (unsigned int d = 0; d < 3; ++d)
          u[i][d] = own(unknowns[i][d]);
    check_petsc(VecRestoreArrayRead(vector, &values));
    mesh.shared_nodes.sum(u.data());
    for (unsigned int i = 0; i < u.size(); ++i)
      if (carried[i])
        u[i] = Vector3{parts.along + parts.turn * (mesh.nodes[i][2] - hub.z), 0.,
                       parts.up - parts.turn * (mesh.nodes[i][0] - hub.x), 0.};
    mesh.distribute_hanging_nodes(u.data());
    return u;
  }


  std::array<double, 3> ElasticSystem::rigid_inertia(const RigidParts &v) const
  {
    std::array<double, 3> sums{};
    if (hub.is_there)
      {
        sums[0] = hub.parameters.mass * (v.along * v.along + v.up * v.up) +
                  2. * v.turn * (v.along * hub.first_moment_z - v.up * hub.first_moment_x) +
                  hub.parameters.moment_of_inertia * v.turn * v.turn;
        sums[1] = hub.parameters.sprung_mass * v.sprung * v.sprung;
      }
    for (const double velocity : v.sleepers)
      sums[2] += supports->parameters.sleeper_mass * velocity * velocity;
    return sums;
  }


  bool ElasticSystem::normalise_against(const std::vector<Vec> &basis, Vec vector) const
  {
    Vec        product = new_vector();
    const auto size    = [&]() {
      check_petsc(MatMult(M, vector, product));
      return std::sqrt(std::max(0., dot(vector, product)));
    };
    const double             before = size();
    std::vector<PetscScalar> shares(basis.size());
    for (unsigned int pass = 0; pass < 2 && !basis.empty(); ++pass)
      {
        check_petsc(MatMult(M, vector, product));
        check_petsc(VecMDot(product, basis.size(), basis.data(), shares.data()));
        for (PetscScalar &share : shares)
          share = -share;
        check_petsc(VecMAXPY(vector, basis.size(), shares.data(), const_cast<Vec *>(basis.data())));
      }
    const double after   = size();
    const bool   remains = after > rounding_share * before && after > 0.;
    if (remains)
      check_petsc(VecScale(vector, 1. / after));
    check_petsc(VecDestroy(&product));
    return remains;
  }


  double ElasticSystem::displacement_of(const Place &place, const NodalField &field) const
  {
    double sum = 0.;
    for (const auto &[node, share] : place)
      sum += share * field[node][2];
    return dealii::Utilities::MPI::sum(sum, mesh.comm);
  }
} // namespace tread
