// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_strips_h
#define tread_contact_strips_h

#include <tread/base/first_ranks.h>
#include <tread/contact/contact_problem.h>

#include <mpi.h>

#include <vector>

namespace tread
{
  /// Division of the constraints of a contact problem among the ranks: each has a strip of consecutive
  /// constraints, and the velocities of the nodes between two strips are exchanged during a sweep.
  ///
  /// In a sweep a rank first treats the constraints that share nodes with the previous strip and sends the
  /// velocities of these nodes there. The constraints in between follow. Those that share nodes with the next
  /// strip come last, when their velocities have been received from there. No two ranks therefore change a
  /// node at the same time, no rank waits while all have the same amount of work, and the sweep is
  /// Gauss-Seidel in a different order. If strips would be too thin for this, or have less work than waiting
  /// for each other takes, there are fewer strips than ranks: the first ranks have them.
  class Strips
  {
  public:
    /// One strip, for this rank alone.
    explicit Strips(const ContactProblem &problem);

    /// Terms of constraints that a strip has at least, those of loaded constraints counted three times.
    static constexpr unsigned int least_work = 5000;

    /// Strips for the first ranks. The problem is the same on all ranks. Collective.
    /// @param impulse one for each constraint: loaded constraints require more work. @param n_nodes compact
    /// nodes.
    Strips(const ContactProblem       &problem,
           const std::vector<Vector3> &impulse,
           const unsigned int          n_nodes,
           FirstRanks                 &ranks,
           const unsigned int          least_work = Strips::least_work);

    /// Restore strips that were made for the same number of ranks. Collective.
    Strips(const ContactProblem            &problem,
           const std::vector<unsigned int> &begin_of_strip,
           const unsigned int               n_nodes,
           FirstRanks                      &ranks);

    /// Whether this rank has a strip, and takes part in sweeps.
    bool sweeps() const
    {
      return sweeping != MPI_COMM_NULL;
    }

    /// First constraint of each rank, and the number of constraints.
    const std::vector<unsigned int> &begins() const
    {
      return begin_of_strip;
    }

    /// Those that have constraints; one where there are none.
    unsigned int n_strips() const
    {
      return n_sweeping;
    }

    /// This rank's constraints, and the limits of those that share nodes with the previous and the next
    /// strip.
    unsigned int begin, end_lower, begin_upper, end;
    /// Constraints that act on a node of this rank's constraints, including those of neighbours.
    unsigned int first_acting, end_acting;

    struct Neighbour
    {
      int                       rank = MPI_PROC_NULL;
      std::vector<unsigned int> nodes; ///< shared with it, compact numbers
      std::vector<double>       sent;
      std::vector<MPI_Request>  requests;
    };
    Neighbour lower, upper;

    void send(Neighbour &to, const std::vector<Vector3> &velocity);
    void receive(Neighbour &from, std::vector<Vector3> &velocity);
    void wait(Neighbour &to);

    /// The largest of each of two numbers over all ranks that sweep, which must all ask.
    void largest(double (&values)[2]) const;

    /// Distribute to all ranks the values that each has found for its own constraints. Collective.
    /// @param values one for each constraint. @return the largest of the ranks' own numbers.
    double gather(std::vector<Vector3> &values, const double own = 0.);

  private:
    /// Whether these strips can be swept at the same time; if so, their borders are determined.
    bool divide(const ContactProblem &problem, const unsigned int n_nodes);
    /// Know the ranks that have a strip. Collective.
    void let_sweep(FirstRanks &ranks);

    MPI_Comm                  comm, sweeping; ///< of all ranks, and of those that have a strip
    unsigned int              n_sweeping = 1;
    std::vector<unsigned int> begin_of_strip;
    std::vector<double>       send_buffer, receive_buffer;
    std::vector<int>          counts, offsets;
  };
} // namespace tread

#endif
