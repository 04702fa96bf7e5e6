// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_contact_problem_h
#define tread_contact_contact_problem_h

#include <tread/base/simd.h>

#include <vector>

namespace tread
{
  /// The contact problem of one time step: rows of weighted constraints between nodes that are
  /// numbered compactly.
  struct ContactProblem
  {
    struct Constraint
    {
      Vector3      normal;
      double       area;       ///< m^2
      double       compliance; ///< sum c^2 / m, 1/kg
      unsigned int begin, end; ///< range of entries
      unsigned int slave;      ///< surface node
    };
    struct Entry
    {
      unsigned int node;                   ///< compact number
      double       coefficient, over_mass; ///< c and c / m
    };

    std::vector<Constraint> constraints;
    std::vector<Entry>      entries;

    /// Sum of c times the field, computed as four independent sums because each addition waits for the
    /// previous one.
    Vector3 combine(const Constraint &constraint, const std::vector<Vector3> &field) const
    {
      Vector3      sum[4] = {};
      unsigned int i      = constraint.begin;
      for (; i + 4 <= constraint.end; i += 4)
        for (unsigned int k = 0; k < 4; ++k)
          sum[k] += entries[i + k].coefficient * field[entries[i + k].node];
      for (; i < constraint.end; ++i)
        sum[0] += entries[i].coefficient * field[entries[i].node];
      return (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }

    void apply(const Constraint &constraint, const Vector3 impulse, std::vector<Vector3> &velocity) const
    {
      for (unsigned int i = constraint.begin; i < constraint.end; ++i)
        velocity[entries[i].node] += entries[i].over_mass * impulse;
    }
  };
} // namespace tread

#endif
