// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/solid/one_point_batch.h>

namespace tread
{
  void OnePointBatch<true>::set(const unsigned int         lane,
                                const HexahedronIntegrals &cell,
                                const double               hourglass_stiffness)
  {
    volume[lane]    = cell.volume;
    stiffness[lane] = hourglass_stiffness;
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < 3; ++i)
        {
          double sum = 0.;
          for (unsigned int a = 0; a < 8; ++a)
            sum += linear_pattern(k, a) * cell.gradient[a][i];
          gradient[k][i][lane] = sum / 8.;
        }
  }


  void OnePointBatch<false>::set(const unsigned int         lane,
                                 const HexahedronIntegrals &cell,
                                 const double               hourglass_stiffness)
  {
    OnePointBatch<true>::set(lane, cell, hourglass_stiffness);
    for (unsigned int m = 0; m < 4; ++m)
      for (unsigned int i = 0; i < 3; ++i)
        {
          double sum = 0.;
          for (unsigned int a = 0; a < 8; ++a)
            sum += hourglass_pattern(m, a) * cell.gradient[a][i];
          hourglass_gradient[m][i][lane] = sum / 8.;
          moment[m][i][lane]             = cell.moment[m][i];
        }
  }
} // namespace tread
