// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_matched_surface_h
#define tread_solid_matched_surface_h

#include <tread/base/archive.h>
#include <tread/solid/one_point_batch.h>
#include <tread/solid/solid.h>

#include <limits>
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
  /// A cell has a share of these forces that grows from 0 to 1 over some steps after it is selected, and
  /// falls again: stiffness that changed at once would make it vibrate.
  ///
  /// The forces have neither resultant nor moment, and the damping takes no power from rigid motions. Without
  /// damping and with constant shares they are minus the gradient of the energy, which depends on the nodes'
  /// positions alone.
  class MatchedSurface
  {
  public:
    /// Of solid.surface(); none of its cells before select().
    MatchedSurface(const Mesh &mesh, const Solid &solid);

    /// From now on, the cells that have one of these nodes of this rank.
    void select(const std::vector<unsigned int> &nodes);
    /// Give the selected cells all of their share and others none, at once: at rest.
    void settle();
    /// Select all, and settle.
    void select_all();

    /// Add the forces of the cells (N) with nodes at x (m) that move at v (m/s), those of hanging nodes
    /// included. @param time the damping tau, s; 0: v is not read.
    void add_forces(const Vector3 *x,
                    const Vector3 *v,
                    Vector3       *force,
                    const double   time,
                    const Levels   levels = {}) const;

    /// The same with the shares of the next time step; v is always read. @param back from the middle of the
    /// last step, when shares change, to the instant of x, s. @returns energy that the cells of this rank
    /// lose by that change, J.
    ReproducibleSum<double> advance(const Vector3 *x,
                                    const Vector3 *v,
                                    Vector3       *force,
                                    const double   time,
                                    const double   back,
                                    const Levels   levels = {});

    /// What the weights add to the energy of the elastic cells of this rank, J.
    ReproducibleSum<double> energy(const Vector3 *x) const;

    /// Number of cells of this rank that are selected or still have a share.
    std::size_t n_cells() const;

    /// Store or restore which cells are selected, and the shares.
    void serialize(Archive &archive);

  private:
    /// Time steps in which a share grows from 0 to 1.
    static constexpr double steps_to_grow = 16.;

    struct Batch : OnePointBatch<false>
    {
      SurfaceModes modes;
      Lanes        share = {}, wanted = {};
      unsigned int cell[n_lanes]; ///< number among cells; padded lanes: none
      unsigned int level = 0;
    };
    static constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

    template <typename Batches, typename Rounding, typename Change>
    static void add(Batches       &batches,
                    const Vector3 *x,
                    const Vector3 *v,
                    Vector3       *force,
                    const double   time,
                    const Levels   levels,
                    const Rounding rounding,
                    const Change  &change);

    template <typename Chosen>
    void select_if(const Chosen &is_chosen);
    /// Make batches of the cells k for which is_wanted(k) says whether they are selected; none: they have no
    /// share.
    template <typename Wanted>
    void make_batches(const Wanted &is_wanted);

    const Mesh               &mesh;
    const Solid              &solid;
    std::vector<unsigned int> cells;  ///< of the layer on this rank, by level
    std::vector<double>       shares; ///< of these cells when they were last selected
    AlignedVector<Batch>      batches;
  };
} // namespace tread

#endif
