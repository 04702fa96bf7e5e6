// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_parts_nodes_h
#define tread_dynamics_parts_nodes_h

#include <tread/dynamics/part.h>

#include <functional>
#include <vector>

namespace tread
{
  /// Damping of the free nodes of a body by a force of -rate(p) m v, with a rate (1/s) that depends on their
  /// position in the reference configuration: absorbing ends. The energy dissipated counts as damping.
  class DampedNodes : public Part
  {
  public:
    DampedNodes(const PartOf                                          &part_of,
                const unsigned int                                     body,
                const std::function<double(const dealii::Point<3> &)> &rate);

    void     add_loads(Step &step) override;
    void     advance(Step &step, const double *) override;
    OwnRates own_rates(const NodeLevels &levels) const override;

  private:
    struct Node
    {
      unsigned int number;
      double       rate; ///< 1/s
      Vector3      load; ///< the force on it in the present step, times 2^level, N
    };

    const PartOf      of;
    std::vector<Node> nodes;
  };

  /// Given forces on nodes. What they do counts as external work.
  class NodeLoads : public Part
  {
  public:
    explicit NodeLoads(const PartOf &part_of)
      : of(part_of)
      , force(of.state.v.size(), Vector3{})
    {
    }

    void add_loads(Step &step) override;
    void advance(Step &step, const double *) override;
    void add_static_loads(NodalField &loads) const override;

  private:
    const PartOf of;

  public:
    NodalField force; ///< N, by node of this rank; on each copy of a node the same
  };
} // namespace tread

#endif
