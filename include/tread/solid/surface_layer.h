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
    std::array<std::array<double, 3>, 3> axes;    ///< two in the surface, then the normal; reference position
    HourglassWeights                     weights; ///< by the cell's own modes and these axes
    double                               stiffness; ///< of the hourglass modes before the weights, N/m
  };

  /// The one-point cells on this rank that have one face on the surface of contact, and the weights of their
  /// hourglass stiffness (@see SurfaceWeights), by the shape of each. Cells that are too far from a box or
  /// from a cube for such weights are not among them.
  class SurfaceLayer
  {
  public:
    SurfaceLayer() = default;

    /// @param materials one for each body.
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


  /// Hourglass modes of n_lanes cells of the surface. Their energy is half the stiffness times
  /// sum_m [|g_m|^2 + sum_i (w_mi - 1) (e_i . g_m)^2] with the amplitudes g_m, the weights w_mi of the two
  /// directions in the surface and the cell's axes in it as they are now, e_i = F E_i, over its length in
  /// cells that yield: stretch of one per cent needs no square roots. It depends on the nodes' positions
  /// alone and not on a common rotation, so that forces keep energy, momentum and angular momentum.
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

    /// Sum of the weighted squares of the amplitudes, m^2.
    template <bool yields>
    Lanes squares(const Lanes (&F)[3][3], const Lanes (&amplitude)[4][3]) const
    {
      Lanes sum{};
      for (const auto &g : amplitude)
        sum += g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
      for (unsigned int i = 0; i < 2; ++i)
        {
          Lanes e[3];
          axis_now<yields>(i, F, e);
          for (unsigned int m = 0; m < 4; ++m)
            {
              const Lanes A = e[0] * amplitude[m][0] + e[1] * amplitude[m][1] + e[2] * amplitude[m][2];
              sum += added[m][i] * A * A;
            }
        }
      return sum;
    }

    /// Set Q_m to stiffness times g_m + sum_i (w_mi - 1) A_mi e_i with A_mi = e_i . g_m, and add to P what
    /// the same loads on A_mi give by F.
    template <bool yields>
    void add(const Lanes (&F)[3][3],
             const Lanes (&amplitude)[4][3],
             const Lanes stiffness,
             Lanes (&Q)[4][3],
             Lanes (&P)[3][3]) const
    {
      Lanes       e[2][3], turned[2][3] = {}, along[2] = {};
      const Lanes inverse_length[2] = {axis_now<yields>(0, F, e[0]), axis_now<yields>(1, F, e[1])};
      for (unsigned int m = 0; m < 4; ++m)
        {
          const Lanes g[3] = {amplitude[m][0], amplitude[m][1], amplitude[m][2]}; // Q may be their own array
          Lanes       sum[3] = {stiffness * g[0], stiffness * g[1], stiffness * g[2]};
          for (unsigned int i = 0; i < 2; ++i)
            {
              const Lanes A    = e[i][0] * g[0] + e[i][1] * g[1] + e[i][2] * g[2];
              const Lanes load = stiffness * added[m][i] * A;
              for (unsigned int j = 0; j < 3; ++j)
                {
                  sum[j] += load * e[i][j];
                  turned[i][j] += load * g[j];
                }
              if constexpr (yields)
                along[i] += load * A;
            }
          for (unsigned int j = 0; j < 3; ++j)
            Q[m][j] = sum[j];
        }
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            if constexpr (yields)
              turned[i][j] = inverse_length[i] * (turned[i][j] - along[i] * e[i][j]);
            for (unsigned int k = 0; k < 3; ++k)
              P[j][k] += turned[i][j] * axis[i][k];
          }
    }

  private:
    /// Set e to F E_i, over its length in cells that yield. @returns one over the length, of those.
    template <bool yields>
    Lanes axis_now(const unsigned int i, const Lanes (&F)[3][3], Lanes (&e)[3]) const
    {
      for (unsigned int j = 0; j < 3; ++j)
        e[j] = F[j][0] * axis[i][0] + F[j][1] * axis[i][1] + F[j][2] * axis[i][2];
      Lanes inverse{};
      if constexpr (yields)
        {
          // Newton's method from a value that is right for no stretch: to round-off for stretches up to 2.
          const Lanes square = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
          inverse            = 2. / (1. + square);
          for (unsigned int pass = 0; pass < 6; ++pass)
            inverse *= 1.5 - 0.5 * square * inverse * inverse;
          for (Lanes &component : e)
            component *= inverse;
        }
      return inverse;
    }
  };
} // namespace tread

#endif
