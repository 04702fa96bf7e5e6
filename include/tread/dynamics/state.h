// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_state_h
#define tread_dynamics_state_h

#include <tread/base/simd.h>
#include <tread/mesh/mesh.h>
#include <tread/solid/plastic_cells.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tread
{
  class Solid;

  /// What the integrator advances and parts read: the motion of this rank's nodes, the history of the steel
  /// and the time. SI units.
  ///
  /// Positions are kept as x + beta v, all that a step needs of them, and velocities are those of half a step
  /// back. They may be set from outside only between ExplicitDynamics::relax() and start(), where positions
  /// do not depend on them.
  struct State
  {
    /// At rest where the mesh has its nodes. @param virgin history of the cells of plastic zones
    State(const Mesh &mesh, PlasticHistory virgin);

    Vector3 position(const unsigned int node) const ///< m
    {
      return x_damped[node] - damping_time * v[node];
    }
    NodalField positions() const;
    void       set_position(const unsigned int node, const Vector3 place)
    {
      x_damped[node] = place + damping_time * v[node];
    }
    void set_damping_time(const double beta); ///< positions stay

    /// Numbers on nodes that somebody adds to the model, by a name with its unit (temperature_K), alike on
    /// all ranks: they are kept in checkpoints and shown in pictures.
    std::map<std::string, std::vector<double>> fields;

    NodalField     v;                 ///< m/s, half a step back
    NodalField     x_damped;          ///< x + beta v, m
    double         damping_time = 0.; ///< beta, s: 0 at rest
    NodalField     force;             ///< that acts in the present step, times 2^level, N
    PlasticHistory history;           ///< of the cells of plastic zones, at x + beta v of the last step
    double         time = 0., time_step = 0.; ///< s
    std::uint64_t  n_steps = 0;

    /// Store or restore nodes, history, time and number of steps: all but the forces. @param damping_time of
    /// the motion to come, s. Collective.
    void serialize(Archive &archive, const Mesh &mesh, const Solid &solid, const double damping_time);
  };
} // namespace tread

#endif
