// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_surface_layer_h
#define tread_solid_surface_layer_h

#include <tread/base/simd.h>
#include <tread/mesh/mesh.h>
#include <tread/solid/one_point_batch.h>
#include <tread/solid/surface_lattice.h>

#include <cstdint>
#include <vector>

namespace tread
{
  /// What a cell of the uppermost layer has beside a cell below it.
  struct SurfaceCell
  {
    std::array<std::array<double, 3>, 2> axes;      ///< in the surface, reference position
    HourglassWeights                     weights;   ///< by the cell's own modes and these axes
    double                               stiffness; ///< of the hourglass modes before the weights, N/m
  };

  /// The one-point cells on this rank that have one face on the surface of contact, and the weights of their
  /// hourglass stiffness (@see SurfaceWeights), by the shape of each. Cells that are too far from a box or
  /// from a cube for such weights are not among them.
  class SurfaceLayer
  {
  public:
    SurfaceLayer() = default;

    /// @param materials @see Solid.
    SurfaceLayer(const Mesh                         &mesh,
                 const std::vector<ElasticMaterial> &materials,
                 const double                        hourglass_coefficient);

    /// Null: the cell is not of the layer.
    const SurfaceCell *find(const unsigned int cell) const
    {
      return number.empty() || number[cell] < 0 ? nullptr : &cells[number[cell]];
    }

    /// Upper bound of the factor by which weights and damping raise the stiffness of a cell's hourglass modes
    /// in the stability of a time step, at least 1. @param damping in time steps.
    double stiffening_of(const unsigned int cell, const double damping) const;

    std::size_t n_cells() const
    {
      return cells.size();
    }

  private:
    std::vector<std::int32_t> number; ///< by cell of the mesh; -1: none
    std::vector<SurfaceCell>  cells;
  };


  /// The axes and weights of n_lanes cells of the surface. Their hourglass modes have the energy of half the
  /// stiffness times sum_m [|g_m|^2 + sum_i (w_mi - 1) (e_i . g_m)^2] with the amplitudes g_m, the weights
  /// w_mi of the two directions in the surface and the cell's axes in it as they are now, e_i = F E_i. It
  /// depends on the nodes' positions alone and not on a common rotation, so that forces keep energy, momentum
  /// and angular momentum.
  struct SurfaceModes
  {
    Lanes axis[2][3]  = {}; ///< E_i
    Lanes added[4][2] = {}; ///< w_mi - 1

    void set(const unsigned int lane, const SurfaceCell &cell)
    {
      for (unsigned int i = 0; i < 2; ++i)
        {
          for (unsigned int j = 0; j < 3; ++j)
            axis[i][j][lane] = cell.axes[i][j];
          for (unsigned int m = 0; m < 4; ++m)
            added[m][i][lane] = cell.weights[m][i] - 1.;
        }
    }

    /// Set e to F E_i.
    void turn(const unsigned int i, const Lanes (&F)[3][3], Lanes (&e)[3]) const
    {
      for (unsigned int j = 0; j < 3; ++j)
        e[j] = F[j][0] * axis[i][0] + F[j][1] * axis[i][1] + F[j][2] * axis[i][2];
    }
  };
} // namespace tread

#endif
