// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_strips_h
#define tread_contact_strips_h

#include <tread/contact/contact_problem.h>

#include <mpi.h>

#include <vector>

namespace tread
{
  /// How the ranks share the constraints of a contact problem: each has a strip of some that follow each
  /// other, and the velocities of the nodes between two strips pass to and fro during a sweep.
  ///
  /// In a sweep a rank first changes the constraints that have nodes in common with the strip before its own
  /// and sends these nodes' velocities there, then those between, and those with nodes of the next strip when
  /// it has them from there. So no two ranks change a node at the same time, none waits while all have as
  /// much to do, and the sweep is one of Gauss-Seidel in another order. Where strips would be too thin for
  /// that there are fewer of them than ranks.
  class Strips
  {
  public:
    /// One strip, for this rank alone.
    explicit Strips(const ContactProblem &problem);

    /// One strip a rank. The same problem on all ranks.
    /// @param impulse one a constraint: loaded ones are more work. @param n_nodes compact nodes.
    Strips(const ContactProblem   &problem,
           const std::vector<Row> &impulse,
           const unsigned int      n_nodes,
           const MPI_Comm          comm);

    /// Strips that were made before for as many ranks.
    Strips(const ContactProblem            &problem,
           const std::vector<unsigned int> &begin_of_strip,
           const unsigned int               n_nodes,
           const MPI_Comm                   comm);

    /// First constraint of each rank, and the number of constraints.
    const std::vector<unsigned int> &begins() const
    {
      return begin_of_strip;
    }

    /// This rank's constraints, and where those end and begin that have nodes of the strips beside.
    unsigned int begin, end_lower, begin_upper, end;
    /// Of those that act on a node of this rank's constraints: neighbours' too.
    unsigned int first_acting, end_acting;

    struct Neighbour
    {
      int                       rank = MPI_PROC_NULL;
      std::vector<unsigned int> nodes; ///< shared with it, compact numbers
      std::vector<double>       sent;
      std::vector<MPI_Request>  requests;
    };
    Neighbour lower, upper;

    void send(Neighbour &to, const std::vector<Row> &velocity);
    void receive(Neighbour &from, std::vector<Row> &velocity);
    void wait(Neighbour &to);

    /// The largest of each of two numbers over all ranks. Collective.
    void largest(double (&values)[2]) const;

    /// Give all ranks what each has found for its own constraints. Collective.
    /// @param values one a constraint. @return the largest of the ranks' own numbers.
    double gather(std::vector<Row> &values, const double own = 0.);

  private:
    /// Whether these strips can do their sweeps at the same time; finds the borders if so.
    bool divide(const ContactProblem &problem, const unsigned int n_nodes);

    MPI_Comm                  comm;
    std::vector<unsigned int> begin_of_strip;
    std::vector<double>       send_buffer, receive_buffer;
    std::vector<int>          counts, offsets;
  };
} // namespace tread

#endif
