// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/sleeper_stress.h>
#include <tread/material/elastic.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/vector_tools.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace tread
{
  namespace
  {
    using dealii::Point;
    using dealii::SymmetricTensor;
    using dealii::Tensor;
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// Boundary of the mesh; parts of the pad have the numbers from seat on.
    enum : dealii::types::boundary_id
    {
      free_surface,
      bottom,
      cut,
      seat_parts
    };

    /// Cells of the mesh that is refined are at most this large, m: finer ones come from refining it, so that
    /// meshes of half the size contain each other.
    constexpr double coarsest_cell = 0.04;

    /// Lengths (m) and shares that differ by less are the same.
    constexpr double round_off = 1e-9;

    /// The ends of cells no longer than size between given places, which all are ends.
    std::vector<double> divide(const std::vector<double> &places, const double size)
    {
      std::vector<double> ends{places.front()};
      for (std::size_t i = 1; i < places.size(); ++i)
        if (const double length = places[i] - places[i - 1]; length > round_off)
          {
            const unsigned int n = std::max(1., std::ceil(length / size - round_off));
            for (unsigned int k = 1; k <= n; ++k)
              ends.push_back(k == n ? places[i] : places[i - 1] + length * k / n);
          }
      return ends;
    }

    std::vector<double> with_parts(std::vector<double> places,
                                   const double        middle,
                                   const double        length,
                                   const unsigned int  n)
    {
      for (unsigned int i = 0; i <= n; ++i)
        places.push_back(middle + length * (double(i) / n - 0.5));
      std::sort(places.begin(), places.end());
      return places;
    }

    /// The number of the part in which a place from the middle lies; -1 outside.
    int part_of(const double place, const double length, const unsigned int n)
    {
      const double at = (place / length + 0.5) * n;
      return at > 0. && at < n ? static_cast<int>(at) : -1;
    }

    /// Three fields of displacement with their strains, of a shape function: stress = C strain.
    SymmetricTensor<2, 3> stress_of(const SymmetricTensor<2, 3> &strain, const double lambda, const double mu)
    {
      return lambda * trace(strain) * dealii::unit_symmetric_tensor<3>() + 2. * mu * strain;
    }

    /// A matrix as the solver takes one. Its own vmult is a template, whose name clang spells unlike GCC, so
    /// that a deal.II which GCC has built has none for clang.
    struct Product
    {
      const dealii::TrilinosWrappers::SparseMatrix &matrix;

      void vmult(Vector &product, const Vector &vector) const
      {
        const int error =
          matrix.trilinos_matrix().Multiply(false, vector.trilinos_vector(), product.trilinos_vector());
        if (error != 0)
          throw std::runtime_error("Epetra's product failed with error " + std::to_string(error));
      }
    };

    class Model
    {
    public:
      Model(const SleeperShape            &shape,
            const SeatPressures           &seat,
            const SleeperStressParameters &parameters,
            const MPI_Comm                 comm);
      SleeperStress solve(const std::string &picture);

    private:
      void                make_mesh();
      void                number();
      void                assemble();
      void                compute_displacement();
      std::vector<double> rigid_motions() const;
      void                add_loads();
      void                add_stresses(const std::string &picture);
      void                add_bottom();
      void   add_largest(const double value, const Point<3> &place, double &most, Point<3> &where);
      double sum(const double value) const
      {
        return dealii::Utilities::MPI::sum(value, comm);
      }

      const SleeperShape           &shape;
      const SeatPressures          &seat;
      const SleeperStressParameters parameters;
      const MPI_Comm                comm;
      const double                  mu, lambda;
      double                        bedding = 0.; ///< N/m^3

      dealii::parallel::distributed::Triangulation<3> triangulation;
      const dealii::FESystem<3>                       element;
      dealii::DoFHandler<3>                           dofs;
      dealii::IndexSet                                relevant;
      dealii::AffineConstraints<double>               constraints;
      dealii::TrilinosWrappers::SparseMatrix          matrix;
      Vector                                          rhs, load, displacement; ///< the last with ghosts
      SleeperStress                                   result{};
    };


    Model::Model(const SleeperShape            &shape,
                 const SeatPressures           &seat,
                 const SleeperStressParameters &p,
                 const MPI_Comm                 comm)
      : shape(shape)
      , seat(seat)
      , parameters(p)
      , comm(comm)
      , mu(0.5 * p.young_modulus / (1. + p.poisson_ratio))
      , lambda(p.young_modulus * p.poisson_ratio / ((1. + p.poisson_ratio) * (1. - 2. * p.poisson_ratio)))
      , triangulation(comm)
      , element(dealii::FE_Q<3>(p.degree), 3)
      , dofs(triangulation)
    {
      if (p.ballast_stiffness)
        bedding = *p.ballast_stiffness / shape.bottom_area();
    }


    void Model::make_mesh()
    {
      const double half = 0.5 * seat.pad_width, length = shape.stations.back().from_middle;
      if (shape.seat - half < -round_off || shape.seat + half > length + round_off)
        throw std::invalid_argument("the pad does not fit on the sleeper's length");
      const double top = shape.at(shape.seat).top_width;
      for (const double y : {shape.seat - half, shape.seat, shape.seat + half})
        if (std::abs(shape.at(y).top_width - top) > round_off || top < seat.pad_length - round_off)
          throw std::invalid_argument("the pad is longer than the sleeper's top is wide");

      double       size       = parameters.cell_size;
      unsigned int refinement = 0;
      for (; 2. * size <= coarsest_cell * (1. + round_off); size *= 2.)
        ++refinement;
      std::vector<double> along;
      for (const SleeperStation &station : shape.stations)
        along.push_back(station.from_middle);
      // Lines of the mesh are the borders of the pad's parts: each loaded face has one pressure.
      const std::vector<double> Y =
                                  divide(with_parts(along, shape.seat, seat.pad_width, seat.n_across), size),
                                X = divide(
                                  with_parts({-0.5 * top, 0.5 * top}, 0., seat.pad_length, seat.n_along),
                                  size),
                                Z  = divide({0., shape.at(shape.seat).height}, size);
      const double          height = Z.back();
      const unsigned int    nx = X.size(), ny = Y.size(), nz = Z.size();
      std::vector<Point<3>> vertices;
      for (unsigned int k = 0; k < nz; ++k)
        for (unsigned int j = 0; j < ny; ++j)
          for (unsigned int i = 0; i < nx; ++i)
            {
              const SleeperStation s     = shape.at(Y[j]);
              const double         share = Z[k] / height;
              vertices.emplace_back(X[i] / top * (s.bottom_width + share * (s.top_width - s.bottom_width)),
                                    Y[j] - shape.seat, share * s.height - height);
            }
      std::vector<dealii::CellData<3>> cells;
      for (unsigned int k = 0; k + 1 < nz; ++k)
        for (unsigned int j = 0; j + 1 < ny; ++j)
          for (unsigned int i = 0; i + 1 < nx; ++i)
            {
              dealii::CellData<3> cell;
              for (unsigned int v = 0; v < 8; ++v)
                cell.vertices[v] = i + v % 2 + nx * (j + v / 2 % 2 + ny * (k + v / 4));
              cells.push_back(cell);
            }
      triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
      for (const auto &cell : triangulation.cell_iterators_on_level(0))
        for (const unsigned int f : cell->face_indices())
          if (const auto face = cell->face(f); face->at_boundary())
            {
              const Point<3> p = face->center();
              const int      i = part_of(p[0], seat.pad_length, seat.n_along),
                        j      = part_of(p[1], seat.pad_width, seat.n_across);
              face->set_boundary_id(f == 4                       ? bottom
                                    : f == 2                     ? cut
                                    : f == 5 && i >= 0 && j >= 0 ? seat_parts + i * seat.n_across + j
                                                                 : free_surface);
            }
      triangulation.refine_global(refinement);
      const double cells_of = 1 << refinement;
      const auto   edge     = [&](const double whole, const unsigned int n) {
        return whole / n / std::ceil(whole / n / size - round_off) / cells_of;
      };
      result.seat_cell_along  = edge(seat.pad_length, seat.n_along);
      result.seat_cell_across = edge(seat.pad_width, seat.n_across);
      result.cells            = triangulation.n_global_active_cells();
    }


    void Model::number()
    {
      dofs.distribute_dofs(element);
      relevant = dealii::DoFTools::extract_locally_relevant_dofs(dofs);
      constraints.reinit(relevant);
      const auto hold = [&](const dealii::types::boundary_id id, const dealii::ComponentMask &mask) {
        dealii::VectorTools::interpolate_boundary_values(dofs, id, dealii::Functions::ZeroFunction<3>(3),
                                                         constraints, mask);
      };
      hold(cut, {std::vector<bool>{false, true, false}});
      if (bedding == 0.)
        hold(bottom, {std::vector<bool>{true, true, true}});
      else
        {
          // Nothing drives the sleeper along the rail: one node holds it there without a force.
          const Point<3> corner(-0.5 * shape.stations.front().bottom_width, -shape.seat,
                                -shape.at(shape.seat).height);
          for (const auto &cell : dofs.active_cell_iterators())
            if (!cell->is_artificial())
              for (const unsigned int v : cell->vertex_indices())
                if (cell->vertex(v).distance(corner) < round_off)
                  constraints.add_line(cell->vertex_dof_index(v, 0));
        }
      constraints.close();
      const dealii::IndexSet                   &owned = dofs.locally_owned_dofs();
      dealii::TrilinosWrappers::SparsityPattern pattern(owned, owned, relevant, comm);
      dealii::DoFTools::make_sparsity_pattern(dofs, pattern, constraints, false,
                                              dealii::Utilities::MPI::this_mpi_process(comm));
      pattern.compress();
      matrix.reinit(pattern);
      rhs.reinit(owned, comm);
      load.reinit(owned, comm);
      displacement.reinit(owned, relevant, comm);
      result.unknowns = dofs.n_dofs();
    }


    void Model::assemble()
    {
      using namespace dealii;
      const QGauss<3>                      in_cell(parameters.degree + 1);
      const QGauss<2>                      on_face(parameters.degree + 1);
      FEValues<3>                          values(element, in_cell, update_gradients | update_JxW_values);
      FEFaceValues<3>                      face_values(element, on_face,
                                                       update_values | update_JxW_values | update_normal_vectors);
      const unsigned int                   n = element.n_dofs_per_cell();
      FullMatrix<double>                   K(n, n);
      dealii::Vector<double>               F(n);
      std::vector<types::global_dof_index> indices(n);
      double                               volume = 0.;
      for (const auto &cell : dofs.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            K = 0.;
            F = 0.;
            values.reinit(cell);
            for (unsigned int q = 0; q < in_cell.size(); ++q)
              {
                volume += values.JxW(q);
                for (unsigned int i = 0; i < n; ++i)
                  {
                    const unsigned int  a  = element.system_to_component_index(i).first;
                    const Tensor<1, 3> &Ga = values.shape_grad(i, q);
                    for (unsigned int j = 0; j <= i; ++j)
                      {
                        const unsigned int  b  = element.system_to_component_index(j).first;
                        const Tensor<1, 3> &Gb = values.shape_grad(j, q);
                        K(i, j) +=
                          (lambda * Ga[a] * Gb[b] + mu * Ga[b] * Gb[a] + (a == b ? mu * (Ga * Gb) : 0.)) *
                          values.JxW(q);
                      }
                  }
              }
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = i + 1; j < n; ++j)
                K(i, j) = K(j, i);
            for (const unsigned int f : cell->face_indices())
              if (const auto face = cell->face(f); face->at_boundary())
                {
                  const types::boundary_id id        = face->boundary_id();
                  const bool               on_spring = id == bottom && bedding > 0.;
                  if (!on_spring && id < seat_parts)
                    continue;
                  face_values.reinit(cell, f);
                  for (unsigned int q = 0; q < on_face.size(); ++q)
                    {
                      // The area seen from above: the rail presses vertically.
                      const double area = std::abs(face_values.normal_vector(q)[2]) * face_values.JxW(q);
                      for (unsigned int i = 0; i < n; ++i)
                        if (element.system_to_component_index(i).first == 2)
                          {
                            const double value = face_values.shape_value(i, q);
                            if (!on_spring)
                              F(i) -= seat.pressure[id - seat_parts] * value * area;
                            else
                              for (unsigned int j = 0; j < n; ++j)
                                if (element.system_to_component_index(j).first == 2)
                                  K(i, j) += bedding * value * face_values.shape_value(j, q) * area;
                          }
                    }
                }
            cell->get_dof_indices(indices);
            constraints.distribute_local_to_global(K, F, indices, matrix, rhs);
            load.add(indices, F);
          }
      matrix.compress(VectorOperation::add);
      rhs.compress(VectorOperation::add);
      load.compress(VectorOperation::add);
      result.volume = sum(volume);
    }


    std::vector<double> Model::rigid_motions() const
    {
      const dealii::IndexSet                      &owned = dofs.locally_owned_dofs();
      const std::size_t                            n     = owned.n_elements();
      std::vector<double>                          motions(6 * n, 0.);
      std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
      const dealii::MappingQ1<3>                   mapping;
      for (const auto &cell : dofs.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            cell->get_dof_indices(indices);
            for (unsigned int i = 0; i < indices.size(); ++i)
              if (owned.is_element(indices[i]))
                {
                  const Point<3> p = mapping.transform_unit_to_real_cell(cell, element.unit_support_point(i));
                  const unsigned int c  = element.system_to_component_index(i).first;
                  const std::size_t  at = owned.index_within_set(indices[i]);
                  motions[c * n + at]   = 1.;
                  // rotation about axis a: e_a x p
                  for (unsigned int a = 0; a < 3; ++a)
                    if (a != c)
                      motions[(3 + a) * n + at] = c == (a + 1) % 3 ? -p[(a + 2) % 3] : p[(a + 1) % 3];
                }
          }
      return motions;
    }


    void Model::compute_displacement()
    {
      Teuchos::ParameterList list;
      ML_Epetra::SetDefaults("SA", list);
      std::vector<double> motions = rigid_motions();
      list.set("PDE equations", 3);
      list.set("null space: type", "pre-computed");
      list.set("null space: dimension", 6);
      list.set("null space: vectors", motions.data());
      list.set("null space: add default vectors", false);
      list.set("aggregation: type", "Uncoupled");
      list.set("aggregation: threshold", 0.);
      list.set("smoother: type", "Chebyshev");
      list.set("smoother: sweeps", 3);
      list.set("coarse: type", "Amesos-KLU");
      list.set("coarse: max size", 2000);
      list.set("ML output", 0);
      dealii::TrilinosWrappers::PreconditionAMG amg;
      amg.initialize(matrix, list);

      Vector                   u(rhs);
      dealii::SolverControl    control(1000, parameters.tolerance * rhs.l2_norm());
      dealii::SolverCG<Vector> solver(control);
      u = 0.;
      if (rhs.l2_norm() > 0.)
        solver.solve(Product{matrix}, u, rhs, amg);
      constraints.distribute(u);
      displacement      = u;
      result.iterations = control.last_step();
    }


    void Model::add_loads()
    {
      // The nodal forces' work on rigid motions: a rotation about x moves z by y, one about y by -x.
      const std::vector<double> motions = rigid_motions();
      const std::size_t         n       = dofs.locally_owned_dofs().n_elements();
      std::array<double, 3>     work{};
      for (std::size_t i = 0; i < n; ++i)
        for (unsigned int m = 0; m < 3; ++m)
          work[m] += motions[(2 + m) * n + i] * load(dofs.locally_owned_dofs().nth_index_in_set(i));
      result.force    = -sum(work[0]);
      result.moment_x = sum(work[1]);
      result.moment_y = sum(work[2]);
    }


    void Model::add_largest(const double value, const Point<3> &place, double &most, Point<3> &where)
    {
      const double largest = dealii::Utilities::MPI::max(value, comm);
      const int    rank    = dealii::Utilities::MPI::this_mpi_process(comm);
      const int    owner =
        dealii::Utilities::MPI::min(value == largest ? rank : std::numeric_limits<int>::max(), comm);
      most  = largest;
      where = dealii::Utilities::MPI::broadcast(comm, place, owner);
    }


    void Model::add_stresses(const std::string &picture)
    {
      using namespace dealii;
      // Stresses are one order more accurate at these points than elsewhere (Barlow 1976).
      const QGauss<3>                    points(parameters.degree);
      FEValues<3>                        values(element, points, update_gradients | update_quadrature_points);
      const FEValuesExtractors::Vector   u(0);
      std::vector<SymmetricTensor<2, 3>> strains(points.size());
      dealii::Vector<float> mises(triangulation.n_active_cells()), tension(mises), compression(mises),
        ranks(mises);
      double   most = -1., most_tension = std::numeric_limits<double>::lowest();
      Point<3> where, where_tension;
      for (const auto &cell : dofs.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            values.reinit(cell);
            values[u].get_function_symmetric_gradients(displacement, strains);
            SymmetricTensor<2, 3> mean;
            for (unsigned int q = 0; q < points.size(); ++q)
              {
                const SymmetricTensor<2, 3> s = stress_of(strains[q], lambda, mu);
                mean += s / points.size();
                const double v = von_mises({{s[0][0], s[1][1], s[2][2], s[0][1], s[1][2], s[2][0]}});
                if (v > most)
                  {
                    most  = v;
                    where = values.quadrature_point(q);
                  }
                if (const double largest = eigenvalues(s)[0]; largest > most_tension)
                  {
                    most_tension  = largest;
                    where_tension = values.quadrature_point(q);
                  }
              }
            const unsigned int at        = cell->active_cell_index();
            const auto         principal = eigenvalues(mean); // the largest first
            mises[at] =
              1e-6 * von_mises({{mean[0][0], mean[1][1], mean[2][2], mean[0][1], mean[1][2], mean[2][0]}});
            tension[at]     = 1e-6 * principal[0];
            compression[at] = 1e-6 * principal[2];
          }
      add_largest(most, where, result.max_von_mises, result.place);
      add_largest(most_tension, where_tension, result.max_tension, result.tension_place);
      if (picture.empty())
        return;
      Vector um(displacement);
      {
        Vector owned(rhs);
        owned = displacement;
        owned *= 1e6;
        um = owned;
      }
      DataOut<3> out;
      out.add_data_vector(dofs, um, std::vector<std::string>(3, "displacement_um"),
                          std::vector<DataComponentInterpretation::DataComponentInterpretation>(
                            3, DataComponentInterpretation::component_is_part_of_vector));
      out.attach_triangulation(triangulation);
      out.add_data_vector(mises, "von_mises_MPa");
      out.add_data_vector(tension, "largest_principal_stress_MPa");
      out.add_data_vector(compression, "smallest_principal_stress_MPa");
      out.build_patches();
      out.write_vtu_in_parallel(picture, comm);
    }


    void Model::add_bottom()
    {
      using namespace dealii;
      const QGauss<3>                    in_cell(parameters.degree + 1);
      const QGauss<2>                    on_face(parameters.degree + 1);
      FEValues<3>                        values(element, in_cell, update_gradients | update_JxW_values);
      FEFaceValues<3>                    face_values(element, on_face,
                                                     update_values | update_JxW_values | update_normal_vectors |
                                                       update_quadrature_points);
      const FEValuesExtractors::Vector   u(0);
      const MappingQ1<3>                 mapping;
      std::vector<SymmetricTensor<2, 3>> strains(in_cell.size());
      std::vector<Tensor<1, 3>>          moved(on_face.size());
      // All unknowns at the fixed bottom, of which the faces' cells and their neighbours have a share.
      const IndexSet                       held = bedding > 0. ? IndexSet(dofs.n_dofs())
                                                               : DoFTools::extract_boundary_dofs(dofs, ComponentMask(), {bottom});
      std::vector<types::global_dof_index> indices(element.n_dofs_per_cell());
      double force = 0., moment_x = 0., moment_y = 0., settled = 0., seat_area = 0., lowest = 0.;
      double least = std::numeric_limits<double>::max(), largest = -least;
      for (const auto &cell : dofs.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            cell->get_dof_indices(indices);
            for (unsigned int i = 0; i < indices.size(); ++i)
              if (element.system_to_component_index(i).first == 2)
                lowest = std::min<double>(lowest, displacement(indices[i]));
            if (cell->at_boundary() && bedding == 0.)
              {
                values.reinit(cell);
                values[u].get_function_symmetric_gradients(displacement, strains);
                for (unsigned int i = 0; i < indices.size(); ++i)
                  if (const unsigned int c = element.system_to_component_index(i).first;
                      held.is_element(indices[i]))
                    {
                      double internal = 0.;
                      for (unsigned int q = 0; q < in_cell.size(); ++q)
                        internal +=
                          (stress_of(strains[q], lambda, mu) * values.shape_grad(i, q))[c] * values.JxW(q);
                      const Point<3> p =
                        mapping.transform_unit_to_real_cell(cell, element.unit_support_point(i));
                      force += c == 2 ? internal : 0.;
                      moment_x += c == 2 ? p[1] * internal : c == 1 ? -p[2] * internal : 0.;
                      moment_y += c == 2 ? -p[0] * internal : c == 0 ? p[2] * internal : 0.;
                    }
              }
            for (const unsigned int f : cell->face_indices())
              if (const auto face = cell->face(f);
                  face->at_boundary() &&
                  (face->boundary_id() >= seat_parts || (face->boundary_id() == bottom && bedding > 0.)))
                {
                  face_values.reinit(cell, f);
                  face_values[u].get_function_values(displacement, moved);
                  for (unsigned int q = 0; q < on_face.size(); ++q)
                    {
                      const double   area = std::abs(face_values.normal_vector(q)[2]) * face_values.JxW(q);
                      const Point<3> p    = face_values.quadrature_point(q);
                      if (face->boundary_id() >= seat_parts)
                        {
                          seat_area += area;
                          settled -= moved[q][2] * area;
                          continue;
                        }
                      const double pressure = -bedding * moved[q][2];
                      least                 = std::min(least, pressure);
                      largest               = std::max(largest, pressure);
                      force += pressure * area;
                      moment_x += p[1] * pressure * area;
                      moment_y -= p[0] * pressure * area;
                    }
                }
          }
      result.bottom_force         = sum(force);
      result.bottom_moment_x      = sum(moment_x);
      result.bottom_moment_y      = sum(moment_y);
      result.largest_settlement   = -dealii::Utilities::MPI::min(lowest, comm);
      result.mean_seat_settlement = sum(settled) / sum(seat_area);
      if (bedding > 0.)
        {
          result.least_bottom_pressure   = dealii::Utilities::MPI::min(least, comm);
          result.largest_bottom_pressure = dealii::Utilities::MPI::max(largest, comm);
        }
    }


    SleeperStress Model::solve(const std::string &picture)
    {
      make_mesh();
      number();
      assemble();
      compute_displacement();
      add_loads();
      add_stresses(picture);
      add_bottom();
      return result;
    }
  } // namespace


  SleeperStation SleeperShape::at(const double y) const
  {
    std::size_t i = 1;
    while (i + 1 < stations.size() && y > stations[i].from_middle)
      ++i;
    const SleeperStation &a = stations[i - 1], &b = stations[i];
    const double          t = (y - a.from_middle) / (b.from_middle - a.from_middle);
    return {y, a.bottom_width + t * (b.bottom_width - a.bottom_width),
            a.top_width + t * (b.top_width - a.top_width), a.height + t * (b.height - a.height)};
  }


  double SleeperShape::volume() const
  {
    // Between stations the area is a quadratic function: Simpson's rule is exact.
    double     sum  = 0.;
    const auto area = [](const SleeperStation &s) {
      return 0.5 * (s.bottom_width + s.top_width) * s.height;
    };
    for (std::size_t i = 1; i < stations.size(); ++i)
      {
        const double a = stations[i - 1].from_middle, b = stations[i].from_middle;
        sum += (b - a) / 6. * (area(stations[i - 1]) + 4. * area(at(0.5 * (a + b))) + area(stations[i]));
      }
    return sum;
  }


  double SleeperShape::bottom_area() const
  {
    double sum = 0.;
    for (std::size_t i = 1; i < stations.size(); ++i)
      sum += 0.5 * (stations[i].from_middle - stations[i - 1].from_middle) *
             (stations[i].bottom_width + stations[i - 1].bottom_width);
    return sum;
  }


  SleeperShape SleeperShape::ns90()
  {
    // The seat rises outwards by 1:40 from 0.6 to 0.9 m about its height of 205 mm.
    SleeperShape shape;
    shape.stations = {{0., 0.26, 0.15, 0.17},
                      {0.35, 0.26, 0.15, 0.17},
                      {0.55, 0.30, 0.18, 0.205 - 0.15 / 40.},
                      {0.60, 0.30, 0.18, 0.205 - 0.15 / 40.},
                      {0.90, 0.30, 0.18, 0.205 + 0.15 / 40.},
                      {1.26, 0.30, 0.18, 0.205 - 0.15 / 40.}};
    return shape;
  }


  double SeatPressures::force() const
  {
    return std::accumulate(pressure.begin(), pressure.end(), 0.) * pad_length * pad_width / pressure.size();
  }


  double SeatPressures::moment_x() const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < pressure.size(); ++i)
      sum -= pad_width * ((i % n_across + 0.5) / n_across - 0.5) * pressure[i];
    return sum * pad_length * pad_width / pressure.size();
  }


  double SeatPressures::moment_y() const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < pressure.size(); ++i)
      sum += pad_length * ((i / n_across + 0.5) / n_along - 0.5) * pressure[i];
    return sum * pad_length * pad_width / pressure.size();
  }


  SleeperStress sleeper_stress(const SleeperShape            &shape,
                               const SeatPressures           &seat,
                               const SleeperStressParameters &parameters,
                               const MPI_Comm                 comm,
                               const std::string             &picture)
  {
    return Model(shape, seat, parameters, comm).solve(picture);
  }
} // namespace tread
