// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/mesh/mesh.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace tread
{
  namespace
  {
    using Triangulation = dealii::Triangulation<3>; // each rank has all of it, unless it is
    using InParts       = dealii::parallel::distributed::Triangulation<3>;

    /// The number of a cell's body. deal.II keeps one number with each cell and its children, from which body
    /// and material follow.
    template <typename Cell>
    unsigned int body_of(const Cell &cell, const std::vector<Body> &bodies)
    {
      return cell->material_id() % bodies.size();
    }

    template <typename Cell>
    unsigned int material_of(const Cell &cell, const std::vector<Body> &bodies)
    {
      const unsigned int other = cell->material_id() / bodies.size();
      return other == 0 ? body_of(cell, bodies) : bodies.size() - 1 + other;
    }

    void make_coarse_mesh(Triangulation &triangulation, const std::vector<Body> &bodies)
    {
      std::vector<dealii::Point<3>>    vertices;
      std::vector<dealii::CellData<3>> cells;
      for (unsigned int b = 0; b < bodies.size(); ++b)
        {
          const unsigned int offset = vertices.size();
          vertices.insert(vertices.end(), bodies[b].vertices.begin(), bodies[b].vertices.end());
          for (dealii::CellData<3> cell : bodies[b].cells)
            {
              for (unsigned int &v : cell.vertices)
                v += offset;
              cell.material_id = b + bodies.size() * cell.material_id;
              cell.manifold_id = b;
              cells.push_back(cell);
            }
        }
      dealii::GridTools::invert_all_negative_measure_cells(vertices, cells);
      triangulation.create_triangulation(vertices, cells, dealii::SubCellData());

      for (const auto &cell : triangulation.cell_iterators_on_level(0))
        {
          const Body &body = bodies[body_of(cell, bodies)];
          if (body.manifold)
            cell->set_all_manifold_ids(body_of(cell, bodies));
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f))
              cell->face(f)->set_boundary_id(
                static_cast<dealii::types::boundary_id>(body.boundary_at(cell->face(f)->center())));
        }
      for (unsigned int b = 0; b < bodies.size(); ++b)
        if (bodies[b].manifold)
          triangulation.set_manifold(b, *bodies[b].manifold);
    }


    /// Whether a cell's line joins vertices 2i and 2i+1.
    bool is_along_path(const unsigned int line)
    {
      return line < 8 && line % 4 >= 2;
    }


    /// The octree halves a cell until its longest edge is near what its corners and centre ask for.
    void refine(Triangulation &triangulation, const std::vector<Body> &bodies)
    {
      constexpr double       tolerance  = 1.2;
      constexpr unsigned int max_levels = 12;
      for (unsigned int level = 0; level < max_levels; ++level)
        {
          bool any = false;
          for (const auto &cell : triangulation.active_cell_iterators())
            if (cell->is_locally_owned() && !cell->user_flag_set())
              {
                const Body &body   = bodies[body_of(cell, bodies)];
                double      wanted = body.wanted_cell_size(cell->center());
                for (const unsigned int v : cell->vertex_indices())
                  wanted = std::min(wanted, body.wanted_cell_size(cell->vertex(v)));
                const double stretch = body.path_stretch ? body.path_stretch(cell->center()) : 1.;
                double       longest = 0.;
                for (const unsigned int l : cell->line_indices())
                  longest = std::max(longest, cell->line(l)->diameter() / (is_along_path(l) ? stretch : 1.));
                if (wanted <= body.even_size)
                  longest = std::ldexp(body.even_edge, -cell->level());
                if (longest > tolerance * wanted)
                  {
                    cell->set_refine_flag();
                    any = true;
                  }
                else
                  cell->set_user_flag(); // and need not be asked again
              }
          if (!dealii::Utilities::MPI::logical_or(any, triangulation.get_communicator()))
            return;
          triangulation.execute_coarsening_and_refinement();
        }
      throw std::runtime_error(
        "mesh: a body asks for cells more than 2^12 times finer than its coarse blocks");
    }

    /// The level of time steps that cells will likely be run with: those 2^l times as large as the smallest
    /// take only every 2^l-th step.
    class LikelyLevels
    {
    public:
      LikelyLevels(const Triangulation &triangulation, const unsigned int max_level)
        : max_level(max_level)
        , smallest(std::numeric_limits<double>::max())
      {
        for (const auto &cell : triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            smallest = std::min(smallest, cell->minimum_vertex_distance());
        smallest = dealii::Utilities::MPI::min(smallest, triangulation.get_communicator());
      }

      template <typename Cell>
      unsigned int operator()(const Cell &cell) const
      {
        return max_level > 0 ? level_of_steps(cell->minimum_vertex_distance() / smallest, max_level) : 0;
      }

    private:
      unsigned int max_level;
      double       smallest; ///< edge of a cell, m
    };

    template <typename Cell>
    dealii::Point<3> vertex_in_space(const Cell &cell, const unsigned int v, const std::vector<Body> &bodies)
    {
      const Body &body = bodies[body_of(cell, bodies)];
      return body.to_space ? body.to_space(cell->vertex(v)) : cell->vertex(v);
    }

    /// What a cell will cost, from its corners in space and its likely level of time steps.
    class CostOfCell
    {
    public:
      CostOfCell(const std::vector<Body> &bodies,
                 const LikelyLevels      &likely_level,
                 const Mesh::CellCost    &cost)
        : bodies(bodies)
        , likely_level(likely_level)
        , cost(cost)
      {
      }

      template <typename Cell>
      double operator()(const Cell &cell) const
      {
        std::array<dealii::Point<3>, Mesh::nodes_per_cell> corners;
        for (unsigned int v = 0; v < corners.size(); ++v)
          corners[v] = vertex_in_space(cell, v, bodies);
        return cost(body_of(cell, bodies), corners, likely_level(cell));
      }

    private:
      const std::vector<Body> &bodies;
      const LikelyLevels      &likely_level;
      const Mesh::CellCost    &cost;
    };

    /// A cell's cost is told as a whole number, of which the dearest one has so many.
    constexpr double dearest = 1000.;

    /// Ranks get equal shares of what the cells cost, if that saves more time than it takes.
    void balance(InParts &triangulation, const CostOfCell &cost_of)
    {
      // What deal.II takes to cut the mesh anew, for each cell of a rank, in the unit of the costs: 20 us on
      // the machine on which a parallelepiped takes 30 ns. With half or double of it, scenes whose ranks wait
      // 10 to 40 us for each cell in all their steps are cut or not, and lose no more than that either way.
      constexpr double to_cut  = 20e-6 / 30e-9;
      double           of_rank = 0., largest = 0.;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const double of_cell = cost_of(cell);
            of_rank += of_cell;
            largest = std::max(largest, of_cell);
          }
      const MPI_Comm comm       = triangulation.get_communicator();
      const auto     over_ranks = dealii::Utilities::MPI::min_max_avg(of_rank, comm);
      const double   n_cells    = triangulation.n_global_active_cells();
      if (over_ranks.max - over_ranks.avg < to_cut * n_cells / dealii::Utilities::MPI::n_mpi_processes(comm))
        return;
      const double unit       = dealii::Utilities::MPI::max(largest, comm) / dearest;
      const auto   connection = triangulation.signals.weight.connect(
        [&](const InParts::cell_iterator &cell, const InParts::CellStatus) -> unsigned int {
          return std::lround(cost_of(cell) / unit);
        });
      triangulation.repartition();
      connection.disconnect();
    }

    /// Share a mesh that each rank has as a whole, as equally by cost and with as few common faces as METIS
    /// can.
    /// @param cost_of each cell; none: number of cells
    void share(Triangulation &triangulation, const unsigned int n_ranks, const CostOfCell *cost_of)
    {
      std::vector<unsigned int> weights;
      if (cost_of)
        {
          std::vector<double> costs;
          for (const auto &cell : triangulation.active_cell_iterators())
            costs.push_back((*cost_of)(cell));
          const double unit = *std::max_element(costs.begin(), costs.end()) / dearest;
          for (const double of_cell : costs)
            weights.push_back(std::max(1l, std::lround(of_cell / unit)));
        }
      dealii::GridTools::partition_triangulation(n_ranks, weights, triangulation,
                                                 dealii::SparsityTools::Partitioner::metis);
    }

    std::unique_ptr<Triangulation> empty_triangulation(const MPI_Comm comm, const bool whole)
    {
      if (whole)
        return std::make_unique<Triangulation>(Triangulation::limit_level_difference_at_vertices);
      return std::make_unique<InParts>(comm, InParts::limit_level_difference_at_vertices);
    }

    /// Reference positions of all nodes visible to this rank, m, including those of ghost cells, to which
    /// parents of hanging nodes may belong. They are stored by index in the set of relevant nodes.
    std::vector<dealii::Point<3>> positions_of(const dealii::DoFHandler<3> &dof_handler,
                                               const dealii::IndexSet      &relevant,
                                               const std::vector<Body>     &bodies)
    {
      std::vector<dealii::Point<3>>                position(relevant.n_elements());
      std::vector<char>                            has_position(position.size(), false);
      std::vector<dealii::types::global_dof_index> dofs(Mesh::nodes_per_cell);
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          {
            cell->get_dof_indices(dofs);
            for (const unsigned int v : cell->vertex_indices())
              if (const auto place = relevant.index_within_set(dofs[v]); !has_position[place])
                {
                  position[place]     = vertex_in_space(cell, v, bodies);
                  has_position[place] = true;
                }
          }
      return position;
    }

    /// Of the coarse cell that a cell is a part of, in the order in which bodies list them: p4est has its
    /// own.
    template <typename Cell>
    unsigned int coarse_number(Cell cell)
    {
      while (cell->level() > 0)
        cell = cell->parent();
      return cell->index();
    }

    /// Add this rank's cells and their faces on the boundary.
    /// @param rank this rank's number
    /// @param local_number number of a node by its global one; a new node if it is met for the first time
    /// @param level_of_node the least of the likely levels of the cells around each node
    template <typename LocalNumber>
    void add_cells(Mesh                        &mesh,
                   const dealii::DoFHandler<3> &dof_handler,
                   const unsigned int           rank,
                   const LocalNumber           &local_number,
                   const LikelyLevels          &likely_level,
                   const std::vector<Body>     &bodies,
                   std::vector<unsigned int>   &level_of_node)
    {
      // Counter-clockwise from outside, for deal.II's faces 0 to 5.
      static constexpr unsigned int face_nodes[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

      std::vector<dealii::types::global_dof_index> dofs(Mesh::nodes_per_cell);
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->subdomain_id() == rank)
          {
            cell->get_dof_indices(dofs);
            Mesh::Cell c;
            c.body                   = body_of(cell, bodies);
            c.material               = material_of(cell, bodies);
            c.address                = CellAddress(coarse_number(cell), cell->id().get_child_indices());
            const unsigned int level = likely_level(cell);
            for (unsigned int v = 0; v < Mesh::nodes_per_cell; ++v)
              {
                c.nodes[v]                = local_number(dofs[v]);
                level_of_node[c.nodes[v]] = std::min(level_of_node[c.nodes[v]], level);
              }
            for (const unsigned int f : cell->face_indices())
              if (cell->at_boundary(f))
                {
                  Mesh::Face face;
                  for (unsigned int v = 0; v < 4; ++v)
                    face.nodes[v] = c.nodes[face_nodes[f][v]];
                  face.cell     = mesh.cells.size();
                  face.body     = c.body;
                  face.boundary = static_cast<Boundary>(cell->face(f)->boundary_id());
                  if (const auto &in_reach = bodies[c.body].in_reach;
                      face.boundary == Boundary::contact && in_reach && !in_reach(cell->face(f)->center()))
                    face.boundary = Boundary::free;
                  mesh.faces.push_back(face);
                }
            mesh.cells.push_back(c);
          }
    }

    /// Add the nodes that hang, with their parents.
    /// @throws std::runtime_error where the octree is not 2:1
    template <typename LocalNumber>
    void add_hanging_nodes(Mesh                                    &mesh,
                           const dealii::AffineConstraints<double> &constraints,
                           const LocalNumber                       &local_number,
                           const std::vector<std::uint64_t>        &global_ids,
                           std::vector<unsigned int>               &level_of_node,
                           const unsigned int                       last_level)
    {
      const std::size_t n_cell_nodes = mesh.nodes.size();
      for (unsigned int i = 0; i < n_cell_nodes; ++i)
        if (constraints.is_constrained(global_ids[i]))
          {
            Mesh::HangingNode h{i, {}};
            unsigned int      n_parents = 0;
            for (const auto &[parent, weight] : *constraints.get_constraint_entries(global_ids[i]))
              {
                if (constraints.is_constrained(parent))
                  throw std::runtime_error("mesh: a hanging node hangs on another hanging node");
                const unsigned int times = std::lround(weight / Mesh::HangingNode::weight);
                for (unsigned int k = 0; k < times && n_parents < h.parents.size(); ++k)
                  h.parents[n_parents++] = local_number(parent);
              }
            if (n_parents != h.parents.size())
              throw std::runtime_error("mesh: a hanging node is not in the middle of an edge or a face");
            mesh.hanging_nodes.push_back(h);
            level_of_node[i] = last_level;
          }
    }
  } // namespace


  Mesh::Mesh(const MPI_Comm           comm,
             const std::vector<Body> &bodies,
             const unsigned int       max_level,
             const CellCost          &cost,
             const bool               is_small)
    : comm(comm)
  {
    const unsigned int                   n_ranks       = dealii::Utilities::MPI::n_mpi_processes(comm);
    const bool                           whole         = is_small || n_ranks == 1;
    const std::unique_ptr<Triangulation> made          = empty_triangulation(comm, whole);
    Triangulation                       &triangulation = *made;
    make_coarse_mesh(triangulation, bodies);
    refine(triangulation, bodies);
    const LikelyLevels likely_level(triangulation, max_level);
    const CostOfCell   cost_of(bodies, likely_level, cost);
    if (whole && n_ranks > 1)
      share(triangulation, n_ranks, cost ? &cost_of : nullptr);
    else if (cost && n_ranks > 1)
      balance(dynamic_cast<InParts &>(triangulation), cost_of);

    const dealii::FE_Q<3> fe(1);
    dealii::DoFHandler<3> dof_handler(triangulation);
    dof_handler.distribute_dofs(fe);
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    dealii::AffineConstraints<double> constraints(relevant);
    dealii::DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    constraints.close();

    for (const Body &body : bodies)
      body_names.push_back(body.name);

    // By index in the set of relevant nodes.
    constexpr unsigned int              unknown  = std::numeric_limits<unsigned int>::max();
    const std::vector<dealii::Point<3>> position = positions_of(dof_handler, relevant, bodies);
    std::vector<unsigned int>           number_of(position.size(), unknown);
    std::vector<unsigned int>           level_of_node; // the last of all for hanging nodes
    std::vector<std::uint64_t>          global_ids;

    const auto local_number = [&](const std::uint64_t id) {
      const auto    place  = relevant.index_within_set(id);
      unsigned int &number = number_of[place];
      if (number == unknown)
        {
          number = nodes.size();
          nodes.push_back(position[place]);
          global_ids.push_back(id);
          level_of_node.push_back(max_level);
        }
      return number;
    };

    add_cells(*this, dof_handler, dealii::Utilities::MPI::this_mpi_process(comm), local_number, likely_level,
              bodies, level_of_node);
    add_hanging_nodes(*this, constraints, local_number, global_ids, level_of_node, max_level + 1);
    renumber(level_of_node, global_ids);
    // deal.II lists parents by numbers that depend on the ranks. By position their mean is the same to the
    // last bit.
    for (HangingNode &h : hanging_nodes)
      std::sort(h.parents.begin(), h.parents.end(), [&](const unsigned int a, const unsigned int b) {
        const dealii::Point<3> &p = nodes[a], &q = nodes[b];
        return std::tie(p[0], p[1], p[2]) < std::tie(q[0], q[1], q[2]);
      });
    // Parents follow from the constraint itself, so every rank places a hanging node alike:
    // on the chord, where every linear displacement field leaves it.
    for (const HangingNode &h : hanging_nodes)
      {
        dealii::Point<3> x;
        for (const unsigned int parent : h.parents)
          x += HangingNode::weight * nodes[parent];
        nodes[h.node] = x;
      }

    node_bodies.assign(nodes.size(), 0);
    for (const Cell &cell : cells)
      for (const unsigned int i : cell.nodes)
        node_bodies[i] = cell.body;
    for (const HangingNode &h : hanging_nodes)
      for (const unsigned int parent : h.parents)
        node_bodies[parent] = node_bodies[h.node];

    shared_nodes            = SharedNodes(comm, global_ids);
    n_global_cells          = triangulation.n_global_active_cells();
    n_global_nodes          = dof_handler.n_dofs();
    std::uint64_t n_hanging = 0;
    for (const HangingNode &h : hanging_nodes)
      n_hanging += shared_nodes.is_owned(h.node);
    n_global_hanging_nodes = dealii::Utilities::MPI::sum(n_hanging, comm);
  }


  void Mesh::renumber(const std::vector<unsigned int> &level_of_node, std::vector<std::uint64_t> &global_ids)
  {
    std::vector<unsigned int> order(nodes.size()), number(nodes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
      return level_of_node[a] < level_of_node[b];
    });
    const std::vector<dealii::Point<3>> old_nodes(nodes);
    const std::vector<std::uint64_t>    old_ids(global_ids);
    for (unsigned int i = 0; i < order.size(); ++i)
      {
        number[order[i]] = i;
        nodes[i]         = old_nodes[order[i]];
        global_ids[i]    = old_ids[order[i]];
      }
    for (Cell &cell : cells)
      for (unsigned int &i : cell.nodes)
        i = number[i];
    for (Face &face : faces)
      for (unsigned int &i : face.nodes)
        i = number[i];
    for (HangingNode &h : hanging_nodes)
      {
        h.node = number[h.node];
        for (unsigned int &i : h.parents)
          i = number[i];
      }
  }


  std::vector<unsigned int> Mesh::boundary_nodes(const unsigned int body, const Boundary boundary) const
  {
    // A rank may hold a node of the boundary without holding a face of it: ask all through the sum.
    NodalField marks(nodes.size(), Vector3{});
    for (const Mesh::Face &face : faces)
      if (face.body == body && face.boundary == boundary)
        for (const unsigned int i : face.nodes)
          marks[i][0] = 1.;
    shared_nodes.sum(marks.data());
    std::vector<unsigned int> found;
    for (unsigned int i = 0; i < marks.size(); ++i)
      if (marks[i][0] > 0.)
        found.push_back(i);
    return found;
  }


  std::array<long long, 4> Mesh::node_key(const unsigned int node) const
  {
    return {{node_bodies[node], std::llround(1e9 * nodes[node][0]), std::llround(1e9 * nodes[node][1]),
             std::llround(1e9 * nodes[node][2])}};
  }
} // namespace tread
