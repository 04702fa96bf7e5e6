// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_matched_surface_h
#define tread_solid_matched_surface_h

#include <tread/solid/one_point_batch.h>
#include <tread/solid/solid.h>

#include <vector>

namespace tread
{
  /// What the cells of the uppermost layer (@see SurfaceLayer) add to the forces of cells like those below
  /// them, where the contact is near: forces k (w_mi - 1) A_mi on the amplitudes A_mi = e_i . g_m of their
  /// hourglass modes g_m along the two axes in the surface e_i = F E_i, with the unweighted stiffness k and
  /// the weights w_mi; and a damping k tau dA_mi/dt, because nodes that enter and leave the contact excite
  /// modes that are soft. Cells of plastic zones have their weights in their own kernel (@see PlasticCells):
  /// these are damped only.
  ///
  /// The forces have neither resultant nor moment, and the damping takes no power from rigid motions. Without
  /// damping they are minus the gradient of the energy, which depends on the nodes' positions alone.
  class MatchedSurface
  {
  public:
    /// Of solid.surface(); none of its cells before select().
    MatchedSurface(const Mesh &mesh, const Solid &solid);

    /// From now on, the cells that have one of these nodes of this rank.
    void select(const std::vector<unsigned int> &nodes);
    void select_all();

    /// Add the forces of the selected cells (N) with nodes at x (m) that move at v (m/s), those of hanging
    /// nodes included. @param time the damping tau, s; 0: v is not read.
    void add_forces(const Vector3 *x,
                    const Vector3 *v,
                    Vector3       *force,
                    const double   time,
                    const Levels   levels = {}) const;

    /// What the weights add to the energy of the selected elastic cells of this rank, J.
    ReproducibleSum<double> energy(const Vector3 *x) const;

    /// Number of selected cells of this rank.
    std::size_t n_selected() const
    {
      return n_cells;
    }

  private:
    struct Batch : OnePointBatch<false>
    {
      SurfaceModes modes;
      unsigned int level = 0;
    };

    template <typename Rounding>
    void add_forces(const Vector3 *x,
                    const Vector3 *v,
                    Vector3       *force,
                    const double   time,
                    const Levels   levels,
                    const Rounding rounding) const;

    template <typename Chosen>
    void select_if(const Chosen &is_chosen);

    const Mesh               &mesh;
    const Solid              &solid;
    std::vector<unsigned int> cells; ///< of the layer on this rank, by level
    AlignedVector<Batch>      batches;
    std::size_t               n_cells = 0;
  };
} // namespace tread

#endif
