// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_soft_motions_h
#define tread_dynamics_soft_motions_h

#include <tread/base/reproducible_sum.h>
#include <tread/dynamics/part.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <vector>

namespace tread
{
  /// Displacements of the soft bodies of parts in which they are far softer than in relative motions of their
  /// cells: a rail's bending in both directions, its torsion and stretch, sleepers as rigid bodies, and a
  /// wheel's rim to the side of its hub. A relaxation that moves each node by what acts on it takes thousands
  /// of iterations for them; these motions are balanced at once. It is the coarse level of a two-level method
  /// with Galerkin's stiffness (deflation; Nicolaides 1987).
  ///
  /// A rail has stations at even distances. With each of them a piece of the body moves rigidly, less and
  /// less towards the next ones. A wheel has the waves around its axle, each with powers of the distance from
  /// the hub; they take the place of stations.
  class SoftMotions
  {
  public:
    /// @param at positions of nodes, m. @param moves by node, whether it is free to move. @param hold takes
    /// away from a field what guided nodes cannot do. @param quantum of what nodes add to sums, N.
    /// Collective.
    SoftMotions(const Mesh                       &mesh,
                const std::vector<SoftBody>      &soft,
                NodalField                        at,
                std::vector<char>                 moves,
                std::function<void(NodalField &)> hold,
                const Quantum                     quantum);

    /// Find the stiffness of the motions. @param forces_by the change of the forces on all nodes (N) by a
    /// displacement (m). @returns whether it is stable; else the one before is kept, if there is one.
    /// Collective.
    bool find_stiffness(const std::function<NodalField(const NodalField &)> &forces_by);

    bool stiffness_is_known() const
    {
      return is_known;
    }
    void forget_stiffness()
    {
      is_known = false;
    }

    struct Balance
    {
      dealii::Vector<double> amplitudes;    ///< of the motions, m
      double                 work;          ///< of what they balance, J: twice the energy that they take up
      double                 largest_force; ///< of what they balance, N
    };
    /// Motions that balance forces on nodes (N, summed over the ranks), and loads on what stands on the line.
    /// Collective. @pre stiffness_is_known()
    Balance balance(const NodalField &force, const std::vector<MovingLoad> &loads) const;

    /// The displacement of nodes by motions of these amplitudes, m.
    NodalField field(const dealii::Vector<double> &amplitudes) const;

    /// How far what stands on the line at x is moved upwards by motions of these amplitudes, m.
    double up(const dealii::Vector<double> &amplitudes, const double x) const;

  private:
    /// Stations of one body.
    struct Body
    {
      SoftBody         what;
      dealii::Point<3> low, high;    ///< of its nodes
      double           hub     = 0.; ///< radius of what is carried of a ring, m
      unsigned int     n       = 1;  ///< stations
      unsigned int     first   = 0;  ///< motion of the first of them
      double           spacing = 0.; ///< of stations of a line, m

      unsigned int n_motions() const ///< of a station
      {
        return what.shape == SoftBody::Shape::ring ? 3 : 6;
      }
    };
    /// What moves with a station: stretches that overlap in one body, or of bodies that rest on each other.
    struct Station
    {
      const Body  *body;
      unsigned int number;   ///< in its body
      double       from, to; ///< along x, with the cells that feel it, m: of lines and pieces
    };
    std::vector<Station> stations() const;
    bool                 touch(const Station &a, const Station &b) const;
    /// Call loop(motion, displacement) for the motions of a body that move a place.
    template <typename Loop>
    void for_motions(const Body &body, const Vector3 &place, const Loop &loop) const;
    /// The same for what stands on the line at x.
    template <typename Loop>
    void for_line(const double x, const Loop &loop) const;
    /// Add the shares of the motions in forces on this rank's own nodes.
    void        project(const NodalField &force, double *shares) const;
    const Body *body_of(const unsigned int node) const
    {
      const int place = place_of_body[mesh.node_bodies[node]];
      return place >= 0 && moves[node] ? &bodies[place] : nullptr;
    }

    const Mesh                       &mesh;
    const NodalField                  at;
    const std::vector<char>           moves;
    std::function<void(NodalField &)> hold;
    const Quantum                     quantum;
    std::vector<Body>                 bodies;
    std::vector<int>                  place_of_body;     ///< by number; -1: it is not soft
    double                            longest_cell = 0.; ///< of a line, m
    unsigned int                      n_motions    = 0;
    dealii::LAPACKFullMatrix<double>  stiffness; ///< factorised
    bool                              is_known = false;
  };
} // namespace tread

#endif
