// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_matrix3_h
#define tread_base_matrix3_h

#include <tread/base/simd.h>

#include <cmath>

namespace tread
{
  /// 3 x 3 matrices of lanes. Symmetric ones are stored as xx, yy, zz, xy, yz, zx; T is double or Lanes.
  /// Position of component (i, j) of a symmetric matrix.
  inline constexpr unsigned int symmetric_index[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

  /// Square root lane by lane.
  inline Lanes square_root(const Lanes x)
  {
    Lanes root;
    for (unsigned int l = 0; l < n_lanes; ++l)
      root[l] = std::sqrt(x[l]);
    return root;
  }

  /// True where the comparison held in any lane: comparisons of lanes give all bits or none.
  template <typename Mask>
  inline bool any(const Mask &mask)
  {
    long long bits = 0;
    for (unsigned int l = 0; l < n_lanes; ++l)
      bits |= mask[l];
    return bits != 0;
  }

  /// Trace of the product of two symmetric matrices, a : b.
  template <typename T>
  inline T contraction(const T (&a)[6], const T (&b)[6])
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2. * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
  }

  /// Inverse of a matrix and, returned, its determinant.
  template <typename T>
  inline T invert(const T (&m)[3][3], T (&inverse)[3][3])
  {
    T cofactor[3][3];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          const unsigned int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
          cofactor[i][j] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
        }
    const T determinant = m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
    const T factor      = 1. / determinant;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        inverse[i][j] = factor * cofactor[j][i];
    return determinant;
  }

  /// Determinant of a symmetric matrix.
  template <typename T>
  inline T determinant(const T (&s)[6])
  {
    return s[0] * (s[1] * s[2] - s[4] * s[4]) - s[3] * (s[3] * s[2] - s[4] * s[5]) +
           s[5] * (s[3] * s[4] - s[1] * s[5]);
  }

  /// Inverse of a symmetric matrix.
  template <typename T>
  inline void invert(const T (&s)[6], T (&inverse)[6])
  {
    const T factor = 1. / determinant(s);
    inverse[0]     = factor * (s[1] * s[2] - s[4] * s[4]);
    inverse[1]     = factor * (s[0] * s[2] - s[5] * s[5]);
    inverse[2]     = factor * (s[0] * s[1] - s[3] * s[3]);
    inverse[3]     = factor * (s[4] * s[5] - s[3] * s[2]);
    inverse[4]     = factor * (s[3] * s[5] - s[0] * s[4]);
    inverse[5]     = factor * (s[3] * s[4] - s[1] * s[5]);
  }

  /// Product of two symmetric matrices that commute, such as functions of one matrix: symmetric as well.
  template <typename T>
  inline void commuting_product(const T (&a)[6], const T (&b)[6], T (&product)[6])
  {
    product[0] = a[0] * b[0] + a[3] * b[3] + a[5] * b[5];
    product[1] = a[3] * b[3] + a[1] * b[1] + a[4] * b[4];
    product[2] = a[5] * b[5] + a[4] * b[4] + a[2] * b[2];
    product[3] = a[0] * b[3] + a[3] * b[1] + a[5] * b[4];
    product[4] = a[3] * b[5] + a[1] * b[4] + a[4] * b[2];
    product[5] = a[0] * b[5] + a[3] * b[4] + a[5] * b[2];
  }

  /// result = M S M^T for symmetric S.
  template <typename T>
  inline void congruence(const T (&m)[3][3], const T (&s)[6], T (&result)[6])
  {
    T product[3][3];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int k = 0; k < 3; ++k)
        product[i][k] = m[i][0] * s[symmetric_index[0][k]] + m[i][1] * s[symmetric_index[1][k]] +
                        m[i][2] * s[symmetric_index[2][k]];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        result[symmetric_index[i][j]] =
          product[i][0] * m[j][0] + product[i][1] * m[j][1] + product[i][2] * m[j][2];
  }

  /// Rotation of the polar decomposition F = R U by Newton's iteration R <- (R + R^-T)/2 (Higham 1986,
  /// eq. 3.1). Seven iterations reach round-off for principal stretches from 1/5 to 5.
  template <typename T>
  inline void polar_rotation(const T (&f)[3][3], T (&rotation)[3][3])
  {
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        rotation[i][j] = f[i][j];
    for (unsigned int iteration = 0; iteration < 7; ++iteration)
      {
        T inverse[3][3];
        invert(rotation, inverse);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            rotation[i][j] = 0.5 * (rotation[i][j] + inverse[j][i]);
      }
  }
} // namespace tread

#endif
