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


  /// Rates of change with which cells of the surface are damped: of F and of the hourglass amplitudes.
  struct HourglassRates
  {
    /// @param v velocities of the nodes, m/s; not read without damping.
    HourglassRates(const OnePointBatch<false> &batch, const Vector3 *v, const double time)
      : time(time)
    {
      if (time > 0.)
        deform(batch, v, F, amplitude);
    }

    /// Amplitudes whose plastic part q is carried with F change by so much less.
    void without_flow(const Lanes (&flowed)[4][3])
    {
      if (time > 0.)
        for (unsigned int m = 0; m < 4; ++m)
          for (unsigned int i = 0; i < 3; ++i)
            amplitude[m][i] -= F[i][0] * flowed[m][0] + F[i][1] * flowed[m][1] + F[i][2] * flowed[m][2];
    }

    Lanes  F[3][3], amplitude[4][3];
    double time; ///< times stiffness is damping, s
  };

  /// Hourglass modes of n_lanes cells of the surface. Their energy is half the stiffness times
  /// sum w_mi (e_i . g_m)^2 with the amplitudes g_m, the weights w_mi and the cell's axes as they are now,
  /// e_i = F E_i, over its length in cells that yield: stretch of one per cent needs no square roots. It
  /// depends on the nodes' positions alone and not on a common rotation, so that forces keep energy,
  /// momentum and angular momentum.
  struct SurfaceModes
  {
    Lanes axis[3][3]   = {}; ///< E_i
    Lanes weight[4][3] = {};

    void set(const unsigned int lane, const SurfaceCell &cell)
    {
      for (unsigned int i = 0; i < 3; ++i)
        {
          for (unsigned int j = 0; j < 3; ++j)
            axis[i][j][lane] = cell.axes[i][j];
          for (unsigned int m = 0; m < 4; ++m)
            weight[m][i][lane] = cell.weights[m][i];
        }
    }

    /// Sum of the weighted squares of the amplitudes, m^2.
    template <bool yields>
    Lanes squares(const Lanes (&F)[3][3], const Lanes (&amplitude)[4][3]) const
    {
      Lanes sum{};
      for (unsigned int i = 0; i < 3; ++i)
        {
          Lanes e[3];
          axis_now<yields>(i, F, e);
          for (unsigned int m = 0; m < 4; ++m)
            {
              const Lanes A = e[0] * amplitude[m][0] + e[1] * amplitude[m][1] + e[2] * amplitude[m][2];
              sum += weight[m][i] * A * A;
            }
        }
      return sum;
    }

    /// Set Q_m to stiffness times sum_i (w_mi A_mi + time e_i . dg_m/dt) e_i with A_mi = e_i . g_m, where
    /// only directions in the surface are damped, and add to P what the same loads on A_mi give by F.
    template <bool yields>
    void add(const Lanes (&F)[3][3],
             const Lanes (&amplitude)[4][3],
             const HourglassRates &rates,
             const Lanes           stiffness,
             Lanes (&Q)[4][3],
             Lanes (&P)[3][3]) const
    {
      const bool is_damped = rates.time > 0.;
      Lanes      sum[4][3] = {}; // Q may be the amplitudes' own array
      for (unsigned int i = 0; i < 3; ++i)
        {
          Lanes       e[3], turned[3] = {}, along{};
          const Lanes inverse_length = axis_now<yields>(i, F, e);
          for (unsigned int m = 0; m < 4; ++m)
            {
              const Lanes(&g)[3] = amplitude[m];
              const Lanes A      = e[0] * g[0] + e[1] * g[1] + e[2] * g[2];
              Lanes       load   = weight[m][i] * A;
              if (i < 2 && is_damped)
                load += rates.time * (e[0] * rates.amplitude[m][0] + e[1] * rates.amplitude[m][1] +
                                      e[2] * rates.amplitude[m][2]);
              load *= stiffness;
              for (unsigned int j = 0; j < 3; ++j)
                {
                  sum[m][j] += load * e[j];
                  turned[j] += load * g[j];
                }
              if constexpr (yields)
                along += load * A;
            }
          if constexpr (yields)
            for (unsigned int j = 0; j < 3; ++j)
              turned[j] = inverse_length * (turned[j] - along * e[j]);
          for (unsigned int j = 0; j < 3; ++j)
            for (unsigned int k = 0; k < 3; ++k)
              P[j][k] += turned[j] * axis[i][k];
        }
      for (unsigned int m = 0; m < 4; ++m)
        for (unsigned int j = 0; j < 3; ++j)
          Q[m][j] = sum[m][j];
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
