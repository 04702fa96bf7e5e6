// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_fields_h
#define tread_tests_fields_h

#include <tread/mesh/mesh.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace tread::tests
{
  inline double size(const Vector3 a)
  {
    return std::sqrt(dot(a, a));
  }

  /// The largest of the sizes of all rows.
  inline double largest(const NodalField &field)
  {
    double square = 0.;
    for (const Vector3 &row : field)
      square = std::max(square, dot(row, row));
    return std::sqrt(square);
  }

  inline Vector3 sum_over_ranks(Vector3 a, const MPI_Comm comm)
  {
    for (unsigned int d = 0; d < 3; ++d)
      a[d] = dealii::Utilities::MPI::sum(a[d], comm);
    return a;
  }

  /// Where the nodes are in the reference, m.
  inline NodalField reference_positions(const Mesh &mesh)
  {
    NodalField x(mesh.nodes.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = Vector3{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
    return x;
  }

  /// Positions turned about the skew axis (1, 2, 3) by an angle (rad), then shifted.
  inline NodalField turned(const NodalField &x, const double angle, const Vector3 shift = Vector3{})
  {
    const dealii::Point<3> axis(1. / std::sqrt(14.), 2. / std::sqrt(14.), 3. / std::sqrt(14.));
    NodalField             y(x.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        const dealii::Point<3> p = turn(dealii::Point<3>(x[i][0], x[i][1], x[i][2]), axis, angle);
        y[i]                     = Vector3{p[0], p[1], p[2], 0.} + shift;
      }
    return y;
  }

  /// For each node whether it hangs.
  inline std::vector<char> which_hang(const Mesh &mesh)
  {
    std::vector<char> hanging(mesh.nodes.size(), false);
    for (const Mesh::HangingNode &h : mesh.hanging_nodes)
      hanging[h.node] = true;
    return hanging;
  }

  /// Largest difference of two histories of the same length over the largest value of the second, on any
  /// rank.
  inline double difference(const std::vector<double> &together, const std::vector<double> &alone)
  {
    double largest = 0., scale = 0.;
    for (unsigned int i = 0; i < alone.size(); ++i)
      {
        largest = std::max(largest, std::abs(together[i] - alone[i]));
        scale   = std::max(scale, std::abs(alone[i]));
      }
    return dealii::Utilities::MPI::max(largest / scale, MPI_COMM_WORLD);
  }

  /// The same of the stresses of cells.
  inline double difference(const std::vector<std::array<double, 6>> &found,
                           const std::vector<std::array<double, 6>> &expected)
  {
    const auto flat = [](const std::vector<std::array<double, 6>> &stresses) {
      std::vector<double> values;
      for (const auto &stress : stresses)
        values.insert(values.end(), stress.begin(), stress.end());
      return values;
    };
    return difference(flat(found), flat(expected));
  }
} // namespace tread::tests

#endif
