// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_contact_records_h
#define tread_contact_contact_records_h

#include <tread/base/reproducible_sum.h>
#include <tread/contact/coulomb_solver.h>

#include <vector>

namespace tread
{
  struct ContactParameters
  {
    unsigned int            slave_body = 0; ///< the surfaces of all others are masters
    CoulombSolverParameters solver;
    // Chosen by trial. In prm/smooth-rolling.prm with cells of 1.3 mm, rolled 12 mm, the coupling is
    // integrated 18 times with these; half and double of each change the frictional power by up to 0.1 %, the
    // traction coefficient by up to 3e-5 of it.
    /// The coupling is integrated anew when surfaces have slid over each other by this share of a face: 23
    /// and 16 times with half and double of it.
    double sliding_share = 0.02;
    /// ... or when the loaded slave faces have turned by this angle, rad: 22 times with half of it, 18 with
    /// double.
    double turning = 2e-3;
    /// Whether all ranks sweep all pairs, in the order of their places, so that the impulses do not depend on
    /// the number of ranks. Otherwise each rank has a strip of its own.
    bool reproducible = false;
  };

  /// Result of the last step at one slave node.
  struct ContactNodeState
  {
    unsigned int node;                       ///< surface node
    unsigned int master_body;                ///< that it touches
    Vector3 position, normal, impulse, slip; ///< m, -, N s (on the master surface), m/s (master over slave)
    double  area, gap;                       ///< m^2, m
    bool    adhesion;
  };

  /// Work of one step's impulses, J. All but on_nodes are computed from the pairs, with the mean of their
  /// relative velocities before and after the step; on_nodes is computed from the nodes, with their own
  /// velocities and the forces applied to them. The energy lost by the pairs must equal that lost by the
  /// nodes and put in with imposed sliding.
  struct ContactWork
  {
    double friction = 0.; ///< lost by the tangential impulses of slipping pairs
    double normal   = 0.; ///< lost by the normal impulses: by touching down and, as pairs whose coupling is
                          ///< older than their sliding turn with the surfaces, lost or gained
    double adhesion =
      0.; ///< lost by the tangential impulses of adhering pairs: what stops those that slipped
    ReproducibleSum<double> on_nodes; ///< lost by what the forces on the nodes do
    double imposed = 0.; ///< put in by who imposes sliding; on_nodes + imposed is lost by the pairs
  };

  /// What a pair has done since it was asked for the last time.
  struct PairRecord
  {
    struct Totals
    {
      double duration = 0.; ///< in which it slipped, s
      double friction = 0.; ///< work lost by its tangential impulses, J
      double distance = 0.; ///< slip of master over slave surface while it touches, m
      double sliding  = 0.; ///< normal force over that distance, J
    };
    unsigned int slave; ///< surface node
    double       area;  ///< m^2
    Totals       totals;
    /// The master's nodes under the slave node, each with its share in what the pair does; together 1.
    struct Share
    {
      unsigned int node; ///< surface node
      double       share;
    };
    std::vector<Share> masters;
  };
} // namespace tread

#endif
