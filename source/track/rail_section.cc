// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/rail_section.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Corners nearer than this are one, m.
    constexpr double same_place = 1e-8;

    /// Of the quadrilaterals: a web may be as thin as one or two of them.
    constexpr unsigned int refinements = 2;

    void triangulate(const std::vector<std::array<std::array<double, 2>, 4>> &quadrilaterals,
                     dealii::Triangulation<2>                                &triangulation)
    {
      std::map<std::array<long long, 2>, unsigned int> numbers;
      std::vector<dealii::Point<2>>                    points;
      std::vector<dealii::CellData<2>>                 cells;
      for (auto corners : quadrilaterals)
        {
          double twice_area = 0.;
          for (unsigned int k = 0; k < 4; ++k)
            twice_area += corners[k][0] * corners[(k + 1) % 4][1] - corners[(k + 1) % 4][0] * corners[k][1];
          if (twice_area < 0.)
            std::swap(corners[1], corners[3]);
          dealii::CellData<2>                   cell;
          constexpr std::array<unsigned int, 4> lexicographic{0, 1, 3, 2};
          for (unsigned int k = 0; k < 4; ++k)
            {
              const auto &corner         = corners[lexicographic[k]];
              const auto [found, is_new] = numbers.try_emplace(
                {std::llround(corner[0] / same_place), std::llround(corner[1] / same_place)}, points.size());
              if (is_new)
                points.emplace_back(corner[0], corner[1]);
              cell.vertices[k] = found->second;
            }
          cells.push_back(cell);
        }
      dealii::GridTools::consistently_order_cells(cells);
      triangulation.create_triangulation(points, cells, dealii::SubCellData());
    }
  } // namespace


  RailSectionProperties rail_section_properties(
    const std::vector<std::array<std::array<double, 2>, 4>> &quadrilaterals)
  {
    if (quadrilaterals.empty())
      throw std::invalid_argument("a section without area");
    dealii::Triangulation<2> triangulation;
    triangulate(quadrilaterals, triangulation);
    triangulation.refine_global(refinements);
    const dealii::FE_Q<2>   element(1);
    dealii::DoFHandler<2>   dofs(triangulation);
    const dealii::QGauss<2> quadrature(2);
    dealii::FEValues<2>     values(element, quadrature,
                                   dealii::update_values | dealii::update_gradients |
                                     dealii::update_quadrature_points | dealii::update_JxW_values);
    dofs.distribute_dofs(element);

    RailSectionProperties section;
    double                yy = 0., zz = 0.;
    for (const auto &cell : dofs.active_cell_iterators())
      {
        values.reinit(cell);
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const dealii::Point<2> p  = values.quadrature_point(q);
            const double           dA = values.JxW(q);
            section.area += dA;
            section.y += p[0] * dA;
            section.z += p[1] * dA;
            yy += p[0] * p[0] * dA;
            zz += p[1] * p[1] * dA;
          }
      }
    section.y /= section.area;
    section.z /= section.area;
    section.about_y = zz - section.area * section.z * section.z;
    section.about_z = yy - section.area * section.y * section.y;

    // A unit shear force: stresses grad(chi) with div grad(chi) = -(z - z_c)/I and none across the boundary.
    dealii::AffineConstraints<double> constraints;
    constraints.add_line(0); // chi is known but for a constant
    constraints.close();
    dealii::DynamicSparsityPattern entries(dofs.n_dofs());
    dealii::DoFTools::make_sparsity_pattern(dofs, entries, constraints);
    dealii::SparsityPattern pattern;
    pattern.copy_from(entries);
    dealii::SparseMatrix<double>                 laplace(pattern);
    dealii::Vector<double>                       load(dofs.n_dofs()), chi;
    dealii::FullMatrix<double>                   of_cell(4, 4);
    dealii::Vector<double>                       on_cell(4);
    std::vector<dealii::types::global_dof_index> indices(4);
    for (const auto &cell : dofs.active_cell_iterators())
      {
        values.reinit(cell);
        of_cell = 0.;
        on_cell = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
          for (unsigned int i = 0; i < 4; ++i)
            {
              for (unsigned int j = 0; j < 4; ++j)
                of_cell(i, j) += values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
              on_cell(i) += values.shape_value(i, q) * (values.quadrature_point(q)[1] - section.z) /
                            section.about_y * values.JxW(q);
            }
        cell->get_dof_indices(indices);
        constraints.distribute_local_to_global(of_cell, on_cell, indices, laplace, load);
      }
    dealii::SparseDirectUMFPACK solver;
    solver.initialize(laplace);
    chi = load;
    solver.solve(chi);
    // Twice the energy times G, of the unit force: 1/(kappa A).
    section.shear_coefficient = 1. / (section.area * (load * chi));
    return section;
  }
} // namespace tread
