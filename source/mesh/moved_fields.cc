// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/gathered.h>
#include <tread/mesh/moved_fields.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace tread
{
  namespace
  {
    /// Cells of all ranks by address, with the values of several fields at their corners.
    class CellValues
    {
    public:
      CellValues(const Mesh &mesh, const std::vector<const NodalField *> &fields)
        : n_fields(fields.size())
      {
        std::vector<CellAddress> own_addresses;
        std::vector<double>      own_values;
        for (const Mesh::Cell &cell : mesh.cells)
          {
            own_addresses.push_back(cell.address);
            for (const unsigned int i : cell.nodes)
              for (const NodalField *field : fields)
                for (unsigned int d = 0; d < 3; ++d)
                  own_values.push_back((*field)[i][d]);
          }
        const std::vector<CellAddress> addresses = gathered(own_addresses, mesh.comm);
        values                                   = gathered(own_values, mesh.comm);
        for (std::size_t c = 0; c < addresses.size(); ++c)
          cells.emplace_back(addresses[c], c);
        std::sort(cells.begin(), cells.end());
      }

      /// Values at a corner of a cell of this or of another mesh; none if that has other coarse cells.
      std::vector<Vector3> at_corner(const CellAddress &cell, const unsigned int corner) const
      {
        // In the cell itself, in one that it is a part of, or in the one of its parts that has the corner.
        std::array<double, 3> place;
        for (unsigned int d = 0; d < 3; ++d)
          place[d] = corner >> d & 1;
        for (CellAddress at = cell;; at = at.parent())
          {
            if (const std::size_t c = find(at); c != none)
              return interpolated(c, place);
            if (at.is_coarse())
              break;
            for (unsigned int d = 0; d < 3; ++d)
              place[d] = 0.5 * (place[d] + (at.number() >> d & 1));
          }
        CellAddress part = cell;
        for (unsigned int level = 0; level < CellAddress::max_levels; ++level)
          {
            part = part.child(corner);
            if (const std::size_t c = find(part); c != none)
              return interpolated(c,
                                  {{double(corner & 1), double(corner >> 1 & 1), double(corner >> 2 & 1)}});
          }
        return {};
      }

    private:
      static constexpr std::size_t none = -1;

      std::size_t find(const CellAddress &address) const
      {
        const auto cell = std::lower_bound(cells.begin(), cells.end(), std::pair(address, std::size_t(0)));
        return cell != cells.end() && cell->first == address ? cell->second : none;
      }

      std::vector<Vector3> interpolated(const std::size_t cell, const std::array<double, 3> &place) const
      {
        std::vector<Vector3> result(n_fields, Vector3{});
        for (unsigned int v = 0; v < 8; ++v)
          {
            double weight = 1.;
            for (unsigned int d = 0; d < 3; ++d)
              weight *= (v >> d & 1) ? place[d] : 1. - place[d];
            if (weight == 0.)
              continue;
            const double *of_corner = values.data() + (cell * 8 + v) * n_fields * 3;
            for (std::size_t k = 0; k < n_fields; ++k)
              result[k] += weight * Vector3{of_corner[3 * k], of_corner[3 * k + 1], of_corner[3 * k + 2], 0.};
          }
        return result;
      }

      std::size_t                                      n_fields;
      std::vector<std::pair<CellAddress, std::size_t>> cells;
      std::vector<double>                              values;
    };
  } // namespace


  std::vector<NodalField> moved_fields(const Mesh                            &from,
                                       const std::vector<const NodalField *> &fields,
                                       const Mesh                            &to)
  {
    const CellValues        values(from, fields);
    std::vector<NodalField> moved(fields.size(), NodalField(to.nodes.size(), Vector3{}));
    NodalField              n_known(to.nodes.size(), Vector3{});
    bool                    all_found = true;
    for (const Mesh::Cell &cell : to.cells)
      for (unsigned int corner = 0; corner < 8; ++corner)
        if (const unsigned int i = cell.nodes[corner]; n_known[i][0] == 0.)
          {
            n_known[i][0]                             = 1.;
            const std::vector<Vector3> values_of_node = values.at_corner(cell.address, corner);
            all_found                                 = all_found && values_of_node.size() == fields.size();
            for (std::size_t k = 0; k < values_of_node.size(); ++k)
              moved[k][i] = values_of_node[k];
          }
    if (dealii::Utilities::MPI::logical_or(!all_found, to.comm))
      throw std::logic_error("moved_fields: the meshes have other coarse cells");
    // A rank may know parents of hanging nodes without a cell around them, and in different cells the same
    // value is found in other roundings: all take the mean.
    to.shared_nodes.sum(n_known.data());
    for (NodalField &field : moved)
      {
        to.shared_nodes.sum(field.data());
        for (unsigned int i = 0; i < field.size(); ++i)
          field[i] = (1. / n_known[i][0]) * field[i];
      }
    return moved;
  }
} // namespace tread
