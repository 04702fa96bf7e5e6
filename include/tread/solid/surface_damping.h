// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_surface_damping_h
#define tread_solid_surface_damping_h

#include <tread/solid/one_point_batch.h>
#include <tread/solid/solid.h>

#include <vector>

namespace tread
{
  /// Damping of the hourglass modes that a matched surface softens (@see SurfaceLayer): forces
  /// -k tau dA_mi/dt on A_mi = e_i . g_m with the unweighted stiffness k, the amplitudes g_m and the two axes
  /// e_i = F E_i in the surface. Only cells near the contact are damped, where nodes that enter and leave it
  /// excite these modes.
  ///
  /// The forces take power from every motion but rigid ones, and have neither resultant nor moment.
  class SurfaceDamping
  {
  public:
    /// All of solid.surface(), none of them damped before select().
    SurfaceDamping(const Mesh &mesh, const Solid &solid);

    /// From now on, damp the cells that have one of these nodes of this rank.
    void select(const std::vector<unsigned int> &nodes);
    void select_all();

    /// Add the forces of the selected cells (N) with nodes at x (m) that move at v (m/s), those of hanging
    /// nodes included. @param time the damping tau, s.
    void add_forces(const Vector3 *x,
                    const Vector3 *v,
                    Vector3       *force,
                    const double   time,
                    const Levels   levels = {}) const;

    /// Cells that are damped, on this rank.
    unsigned int n_selected() const;

  private:
    struct Batch : OnePointBatch<false>
    {
      Lanes        axis[2][3] = {};
      Lanes        selected   = {}; ///< 1 or 0
      unsigned int level      = 0;
    };

    template <typename Select>
    void select_if(const Select &selects);
    template <typename Rounding>
    void add_forces(const Vector3 *x,
                    const Vector3 *v,
                    Vector3       *force,
                    const double   time,
                    const Levels   levels,
                    const Rounding rounding) const;

    AlignedVector<Batch>     batches;
    std::vector<std::size_t> active; ///< batches with selected cells
    std::size_t              n_nodes;
    bool                     reproducible;
    Quantum                  quantum;
  };
} // namespace tread

#endif
