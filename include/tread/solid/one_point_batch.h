// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_one_point_batch_h
#define tread_solid_one_point_batch_h

#include <tread/base/reproducible_sum.h>
#include <tread/base/simd.h>
#include <tread/solid/hexahedron.h>

namespace tread
{
  /// The nodal vectors of n_lanes trilinear cells, seen as the patterns that their nodes can make: by
  /// component, without the constant one.
  struct NodalPatterns
  {
    Lanes linear[3][3];    ///< xi, eta, zeta
    Lanes hourglass[4][3]; ///< eta zeta, zeta xi, xi eta, xi eta zeta

    /// Sums of nodal vectors times the patterns, by differences along xi, eta and zeta.
    void read(const Vector3 *rows, const unsigned int (&node)[8][n_lanes])
    {
      Lanes both[2][3], slope_eta[2][3], slope_xi[2][3], twist[2][3]; // by zeta
      for (unsigned int zeta = 0; zeta < 2; ++zeta)
        {
          Lanes sum[2][3], difference[2][3]; // by eta
          for (unsigned int eta = 0; eta < 2; ++eta)
            {
              const unsigned int a = 4 * zeta + 2 * eta;
              Lanes              low[3], high[3];
              gather(rows, node[a], low[0], low[1], low[2]);
              gather(rows, node[a + 1], high[0], high[1], high[2]);
              for (unsigned int i = 0; i < 3; ++i)
                {
                  sum[eta][i]        = high[i] + low[i];
                  difference[eta][i] = high[i] - low[i];
                }
            }
          for (unsigned int i = 0; i < 3; ++i)
            {
              both[zeta][i]      = sum[1][i] + sum[0][i];
              slope_eta[zeta][i] = sum[1][i] - sum[0][i];
              slope_xi[zeta][i]  = difference[1][i] + difference[0][i];
              twist[zeta][i]     = difference[1][i] - difference[0][i];
            }
        }
      for (unsigned int i = 0; i < 3; ++i)
        {
          linear[0][i]    = slope_xi[1][i] + slope_xi[0][i];
          linear[1][i]    = slope_eta[1][i] + slope_eta[0][i];
          linear[2][i]    = both[1][i] - both[0][i];
          hourglass[0][i] = slope_eta[1][i] - slope_eta[0][i];
          hourglass[1][i] = slope_xi[1][i] - slope_xi[0][i];
          hourglass[2][i] = twist[1][i] + twist[0][i];
          hourglass[3][i] = twist[1][i] - twist[0][i];
        }
    }

    /// Add to the nodes the sum of the patterns times these vectors, rounded: the transpose of read().
    template <typename Rounding>
    void add_to(Vector3 *rows, const unsigned int (&node)[8][n_lanes], const Rounding quantum) const
    {
      for (unsigned int zeta = 0; zeta < 2; ++zeta)
        {
          const auto signed_sum = [zeta](const Lanes odd, const Lanes even) {
            return zeta == 1 ? even + odd : even - odd;
          };
          Lanes sum[2][3], difference[2][3]; // by eta
          for (unsigned int i = 0; i < 3; ++i)
            {
              const Lanes both      = zeta == 1 ? linear[2][i] : -linear[2][i];
              const Lanes slope_eta = signed_sum(hourglass[0][i], linear[1][i]);
              const Lanes slope_xi  = signed_sum(hourglass[1][i], linear[0][i]);
              const Lanes twist     = signed_sum(hourglass[3][i], hourglass[2][i]);
              sum[0][i]             = both - slope_eta;
              sum[1][i]             = both + slope_eta;
              difference[0][i]      = slope_xi - twist;
              difference[1][i]      = slope_xi + twist;
            }
          for (unsigned int eta = 0; eta < 2; ++eta)
            {
              const unsigned int a = 4 * zeta + 2 * eta;
              const auto        &s = sum[eta];
              const auto        &d = difference[eta];
              scatter_add(rows, node[a], quantum.round(s[0] - d[0]), quantum.round(s[1] - d[1]),
                          quantum.round(s[2] - d[2]));
              scatter_add(rows, node[a + 1], quantum.round(s[0] + d[0]), quantum.round(s[1] + d[1]),
                          quantum.round(s[2] + d[2]));
            }
        }
    }
  };


  /// n_lanes one-point hexahedra: their nodes, and the operators between nodal vectors and the cells' mean
  /// deformation and hourglass amplitudes (Flanagan & Belytschko 1981, eqs. 15 and 35). These operators are
  /// kept by pattern, not by node: mean gradient B_a = sum_k linear_k(a) A_k + sum_m hourglass_m(a) C_m, and
  /// amplitude operator gamma_m(a) = hourglass_m(a) - M_m . B_a with the moment M_m of the reference
  /// positions. A parallelepiped (affine) has no C and no M. All zero: a padded lane, without forces.
  template <bool affine>
  struct OnePointBatch;

  template <>
  struct OnePointBatch<true>
  {
    unsigned int node[8][n_lanes] = {};
    Lanes        gradient[3][3]   = {}; ///< A, 1/m
    Lanes        stiffness        = {}; ///< of the hourglass amplitudes, N/m
    Lanes        volume           = {}; ///< m^3

    void set(const unsigned int lane, const HexahedronIntegrals &cell, const double hourglass_stiffness);
  };

  template <>
  struct OnePointBatch<false> : OnePointBatch<true>
  {
    Lanes hourglass_gradient[4][3] = {}; ///< C, 1/m
    Lanes moment[4][3]             = {}; ///< M, m

    void set(const unsigned int lane, const HexahedronIntegrals &cell, const double hourglass_stiffness);
  };


  /// Mean deformation gradient F = sum_a x_a (x) B_a, and the hourglass amplitudes sum_a gamma_m(a) x_a (m).
  template <bool affine>
  inline void deform(const OnePointBatch<affine> &batch,
                     const Vector3               *x,
                     Lanes (&F)[3][3],
                     Lanes (&amplitude)[4][3])
  {
    NodalPatterns X;
    X.read(x, batch.node);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          F[i][j] = X.linear[0][i] * batch.gradient[0][j] + X.linear[1][i] * batch.gradient[1][j] +
                    X.linear[2][i] * batch.gradient[2][j];
          if constexpr (!affine)
            for (unsigned int m = 0; m < 4; ++m)
              F[i][j] += X.hourglass[m][i] * batch.hourglass_gradient[m][j];
        }
    for (unsigned int m = 0; m < 4; ++m)
      for (unsigned int i = 0; i < 3; ++i)
        {
          amplitude[m][i] = X.hourglass[m][i];
          if constexpr (!affine)
            amplitude[m][i] -=
              F[i][0] * batch.moment[m][0] + F[i][1] * batch.moment[m][1] + F[i][2] * batch.moment[m][2];
        }
  }

  /// Add P B_a + sum_m Q_m gamma_m(a), rounded, to the nodes: the transpose of deform(). P (N m) is
  /// overwritten; Q in N.
  template <bool affine, typename Rounding>
  inline void add_forces_of(const OnePointBatch<affine> &batch,
                            Vector3                     *force,
                            Lanes (&P)[3][3],
                            const Lanes (&Q)[4][3],
                            const Rounding quantum)
  {
    NodalPatterns f;
    for (unsigned int i = 0; i < 3; ++i)
      {
        if constexpr (!affine)
          for (unsigned int j = 0; j < 3; ++j)
            for (unsigned int m = 0; m < 4; ++m)
              P[i][j] -= Q[m][i] * batch.moment[m][j];
        for (unsigned int k = 0; k < 3; ++k)
          f.linear[k][i] =
            P[i][0] * batch.gradient[k][0] + P[i][1] * batch.gradient[k][1] + P[i][2] * batch.gradient[k][2];
        for (unsigned int m = 0; m < 4; ++m)
          {
            f.hourglass[m][i] = Q[m][i];
            if constexpr (!affine)
              f.hourglass[m][i] += P[i][0] * batch.hourglass_gradient[m][0] +
                                   P[i][1] * batch.hourglass_gradient[m][1] +
                                   P[i][2] * batch.hourglass_gradient[m][2];
          }
      }
    f.add_to(force, batch.node, quantum);
  }
} // namespace tread

#endif
