// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_supports_h
#define tread_track_supports_h

#include <tread/base/archive.h>
#include <tread/base/reproducible_sum.h>
#include <tread/mesh/mesh.h>
#include <tread/reference/supported_beam.h>

#include <map>
#include <utility>
#include <vector>

namespace tread
{
  /// The foundation of a rail between its foot and the ground at each sleeper. Stiffness and damping are
  /// those of a whole support; its points share them.
  struct TrackParameters
  {
    struct Springs
    {
      double pad_stiffness = 1300e6, ballast_stiffness = 45e6; ///< N/m
      double pad_damping = 45e3, ballast_damping = 32e3;       ///< N s/m
      double ballast_gap = 0.; ///< below the unloaded sleeper, m; above 0 the ballast does not pull
    };
    Springs                         springs;
    std::map<unsigned int, Springs> exceptions;       ///< supports that differ, by their place in the list
    bool                            pads_pull = true; ///< a rail that rises is held down
    const Springs                  &springs_of(const unsigned int support) const
    {
      const auto own = exceptions.find(support);
      return own == exceptions.end() ? springs : own->second;
    }

    double       pad_length = 0.15, pad_width = 0.14; ///< along and across the rail, m
    double       pad_middle   = 0.;                   ///< y, m
    unsigned int points_along = 3, points_across = 4;
    /// With a second layer the pads rest on sleepers on ballast, otherwise on the ground.
    bool   two_layers   = true;
    double sleeper_mass = 200.; ///< kg; of a rigid sleeper that moves in z only

    /// The same foundation of a support for a beam; rigid sleepers do not rotate.
    reference::SupportLayers layers(const unsigned int support) const;
  };

  /// A sleeper that is a body of the mesh: the area over which it rests on the ballast.
  struct SolidSleeper
  {
    unsigned int body;
    double       y_begin, y_end; ///< m
    double       width;          ///< along the rail, m
  };

  /// Discrete supports of a rail: vertical springs and dampers from points of the rail's foot to sleepers,
  /// which are masses or bodies of the mesh, and on to the ground. A point lies on a face, and the face's
  /// nodes share its force by their shape functions.
  ///
  /// Displacement and velocity of all points are known to all ranks, which update them identically; forces
  /// reach the nodes through the rank that holds the face. Like all damping in central differences, dampers
  /// act with the velocities of half a step back. Springs that do not pull let go where they would.
  class Supports
  {
  public:
    enum Layer
    {
      pad,
      ballast
    };

    /// @param positions of the supports along the rail (x, m); @param solid_sleepers one for each support, or
    /// none.
    /// @throws std::invalid_argument if a point finds no face of its body. Collective.
    Supports(const Mesh                      &mesh,
             const unsigned int               rail_body,
             const std::vector<double>       &positions,
             const TrackParameters           &parameters,
             const std::vector<SolidSleeper> &solid_sleepers = {});

    /// Record the vertical displacement of the rail's foot at x. @returns the number of this record.
    /// Collective.
    unsigned int add_probe(const double x);

    /// Set the gravity of rigid sleepers, m/s^2 along -z.
    void set_gravity(const double value)
    {
      gravity = value;
    }

    /// Round what is added to the forces of nodes (N) and to row sums (N/m, N s/m), so that the sums do not
    /// depend on the ranks.
    void set_quanta(const Quantum of_forces, const Quantum of_rows)
    {
      force_quantum = of_forces;
      row_quantum   = of_rows;
    }

    /// Initialise the displacements from nodal positions: everything is at rest, and rigid sleepers are
    /// placed where forces balance. Collective.
    void set_at_rest(const Vector3 *x);

    /// Add the forces at the present state to the nodes of this rank.
    void add_forces(Vector3 *force);
    /// Add the forces of the springs alone.
    void add_spring_forces(Vector3 *force) const;

    /// Vector3 sums of stiffness (in [0], N/m) and damping (in [1], N s/m) on the nodes of this rank, and
    /// those of a rigid sleeper over its mass: bounds of eigenvalues.
    void add_row_sums(Vector3 *field) const;
    void sleeper_row_sums(double &stiffness_over_mass, double &damping_over_mass) const;

    /// Velocities that this rank's points will have: v + time_step * force / m; zero for those of other
    /// ranks. Their sums over the ranks are passed to advance().
    void        predict(const Vector3             *v,
                        const Vector3             *force,
                        const std::vector<double> &inverse_masses,
                        const double               time_step,
                        double                    *velocities) const;
    std::size_t n_points() const
    {
      return ends.size();
    }

    /// Advance by one step with the new velocities of all points.
    void advance(const double *velocities, const double time_step);

    /// Initialise the velocities: points get those of the nodes, half a step back, and rigid sleepers those
    /// given. Collective.
    void set_velocities(const Vector3 *v, const std::vector<double> &sleeper_velocities);

    /// Compressive force in a layer of a support in the last step, N.
    double force(const unsigned int support, const Layer layer) const;
    /// Smallest and largest pressure among the points of the pad, Pa; negative in tension.
    std::pair<double, double> pad_pressures(const unsigned int support) const;
    /// Pressure on each part of the pad, Pa: parts behind each other along the rail, in each of these rows
    /// side by side across it.
    std::vector<double> seat_pressures(const unsigned int support) const;
    /// Mean displacement of the rail's foot over a support, upwards, m.
    double rail_displacement(const unsigned int support) const;
    double probe_displacement(const unsigned int probe) const;

    /// Present energies of all ranks, J: springs; rigid sleepers, with velocities half a step back and
    /// present spring forces; weight of rigid sleepers half a step back.
    double spring_energy() const;
    double sleeper_kinetic_energy(const double time_step) const;
    double weight_potential(const double time_step) const;
    /// Work dissipated by the dampers since the start, J.
    double dissipated() const
    {
      return damper_work;
    }

    /// Nodes of this rank that carry points: they move in every step.
    std::vector<unsigned int> nodes() const;
    /// Nodes to be held so that supports move vertically only: in y (direction 1) the nodes of the rail's
    /// foot nearest to the middle of each pad, in x (direction 0) those of solid sleepers nearest to the
    /// middle of the ballast. If they were held across the whole area of a pad, the rail could not bend
    /// freely. Collective.
    std::vector<unsigned int> guided_nodes(const unsigned int direction) const;

    /// A spring with its damper, as it acts on the degrees of freedom: its elongation is the sum of the
    /// shares times the vertical displacements of nodes of this rank and of rigid sleepers, over all ranks.
    struct Link
    {
      double                                       stiffness, damping; ///< N/m, N s/m
      unsigned int                                 support;
      Layer                                        layer;
      std::vector<std::pair<unsigned int, double>> nodes;    ///< of this rank, with their shares
      std::vector<std::pair<unsigned int, double>> sleepers; ///< rigid ones by support, with their shares
    };
    /// All of them, in the same order on all ranks, as if none let go.
    std::vector<Link> links() const;
    unsigned int      n_rigid_sleepers() const
    {
      return n_sleepers;
    }

    /// Store or restore the state: all but the forces of dampers and on sleepers, with which a step begins.
    void serialize(Archive &archive);

    const unsigned int              rail_body;
    const std::vector<double>       positions; ///< x of the supports, m
    const TrackParameters           parameters;
    const std::vector<SolidSleeper> solid_sleepers; ///< one a support, or none

  private:
    /// A point on a face; it has no nodes if another rank holds the face.
    struct End
    {
      std::vector<std::pair<unsigned int, double>> nodes; ///< with shares that sum to 1
    };
    struct Spring
    {
      int          a, b; ///< points: rigid sleepers, then those on faces; -1: ground
      double       stiffness, damping;
      unsigned int support;
      Layer        layer;
      bool         pulls; ///< otherwise both parts separate instead, and dampers let go with the spring
      double       gap;   ///< between the parts when nothing is displaced, m; of springs that do not pull
    };
    /// Tension of a spring without its damper, N.
    double tension(const Spring &spring) const
    {
      const double stretch = difference(displacement, spring) + spring.gap;
      return spring.pulls || stretch < 0. ? spring.stiffness * stretch : 0.;
    }

    using Faces = std::vector<const Mesh::Face *>;
    /// Boundary faces of a body of this rank whose outer normal points up (side 1) or down (-1).
    Faces facing(const unsigned int body, const double side) const;
    /// A point on the outermost of these faces at (x, y). Collective.
    unsigned int add_end(const Faces &faces, const double x, const double y, const double side);
    unsigned int point_of(const unsigned int end) const
    {
      return n_sleepers + end;
    }
    double difference(const std::vector<double> &values, const Spring &spring) const
    {
      return values[spring.a] - (spring.b < 0 ? 0. : values[spring.b]);
    }
    void                place_sleepers(); ///< rigid ones, where forces at rest balance
    void                give(const int point, const double value, Vector3 *force) const;
    std::vector<double> of_nodes(const Vector3 *field, const bool displacement) const;

    const Mesh                            &mesh;
    std::vector<End>                       ends;
    std::vector<Spring>                    springs;
    std::vector<unsigned int>              probes;         ///< ends
    std::vector<std::vector<unsigned int>> rail_ends;      ///< by support
    unsigned int                           n_sleepers = 0; ///< rigid ones, the first points

    // The state, by point.
    std::vector<double> displacement, velocity, sleeper_force;
    std::vector<double> spring_force; ///< by spring, of the last step: tension, N
    std::vector<double> damper_force; ///< the dampers' part of it
    double              damper_work = 0., gravity = 0.;
    Quantum             force_quantum, row_quantum;
  };
} // namespace tread

#endif
