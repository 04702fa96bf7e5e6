// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_contact_arrays_h
#define tread_contact_contact_arrays_h

#include <tread/base/simd.h>
#include <tread/contact/contact_records.h>

#include <vector>

// What a contact has of its nodes and pairs from one refresh to the next, and from one step to the next.

namespace tread
{
  /// Of the involved nodes, by compact number. At the end of a step positions and velocities are known for
  /// the nodes of this rank's strip, for those that its normals follow, and for the rank's own nodes.
  struct ContactNodes
  {
    std::vector<Vector3> position, predicted, velocity, velocity_before;
    std::vector<Vector3> mean_velocity; ///< of before and after the step
  };

  /// By constraint.
  struct ContactPairs
  {
    std::vector<Vector3>            impulse;          ///< of the last step
    std::vector<unsigned int>       master_of;        ///< the body of its master surface
    std::vector<Vector3>            previous_impulse; ///< those that act on the strip
    std::vector<Vector3>            given_ratio;      ///< of impulses, tangential over normal
    std::vector<Vector3>            offset;           ///< of the strip, see solve_coulomb()
    std::vector<Vector3>            imposed;          ///< of the strip: sliding in the last step, m/s
    std::vector<Vector3>            before_entry; ///< likewise: slip before it touched, over the step, m/s
    std::vector<char>               slips;        ///< of the strip: as the last solve left it
    std::vector<double>             slid;         ///< of the strip: since the last refresh, m
    std::vector<PairRecord::Totals> totals;       ///< likewise; empty: not recorded

    /// Slip of a pair of the strip with the relative velocity u (m/s), while it touches: what an entering
    /// pair slips before that is left out. @param normal of the pair
    Vector3 slip_of(unsigned int constraint, const Vector3 &normal, const Vector3 u) const;
    /// Work that the tangential impulse of a pair loses, with the mean relative velocity u of the step, J.
    /// @param along the part of its impulse along its normal, N s
    double tangential_loss(unsigned int   constraint,
                           const Vector3 &normal,
                           double         along,
                           const Vector3  u) const;
  };

  /// What a slave node has of its pair, by surface node.
  struct MemoryOfNodes
  {
    std::vector<Vector3> impulse;     ///< in the last step, N s
    std::vector<double>  coefficient; ///< of friction with a memory; else empty
  };

  /// Which predictions go from rank to rank.
  struct PredictionExchange
  {
    std::vector<std::vector<unsigned int>> involved_of_rank; ///< compact numbers
    /// Data of the involved nodes of this rank, in their order, that a prediction needs.
    struct Predicted
    {
      unsigned int node, local; ///< compact number, number on this rank
      double       inverse_mass;
    };
    std::vector<Predicted> own;
    /// Compact numbers of the nodes whose prediction goes to or comes from each rank.
    std::vector<std::vector<unsigned int>> sent_to, received_from;
    std::vector<double>                    send_buffer, receive_buffer;
  };

  /// Effect of the constraints on the nodes of the strip or of this rank. It is summed in the same order on
  /// all ranks that know a node, so that its position is the same on all of them.
  struct EffectsOfPairs
  {
    struct NodeTerms
    {
      unsigned int node;         ///< compact number
      int          local;        ///< number on this rank, -1 if it has no copy
      bool         owned;        ///< by this rank
      double       inverse_mass; ///< 1/kg
      unsigned int begin, end;   ///< range of terms
    };
    struct Term
    {
      unsigned int constraint;
      double       coefficient;
    };
    std::vector<NodeTerms> of_nodes;
    std::vector<Term>      terms;
  };
} // namespace tread

#endif
