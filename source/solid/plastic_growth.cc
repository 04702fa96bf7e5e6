// SPDX-License-Identifier: LGPL-2.1-or-later
// How the history of plastic cells is compared and extrapolated from passage to passage.
#include <tread/solid/plastic_cells.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    constexpr unsigned int n_components = 6; // of a symmetric tensor
  }


  template <typename Function>
  PlasticHistory PlasticCells::of_eigenvalues(const PlasticHistory &history, const Function &function) const
  {
    static constexpr unsigned int index[n_components][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
    PlasticHistory                result                 = history;
    for (const Range &range : ranges)
      for (std::size_t b = range.begin; b < range.end; ++b)
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            Lanes *const values = &result.values[range.history + (b - range.begin) * range.stride()];
            dealii::SymmetricTensor<2, 3> tensor;
            for (unsigned int k = 0; k < n_components; ++k)
              tensor[index[k][0]][index[k][1]] = values[k][lane];
            const auto pairs = dealii::eigenvectors(tensor, dealii::SymmetricTensorEigenvectorMethod::jacobi);
            for (unsigned int k = 0; k < n_components; ++k)
              {
                double sum = 0.;
                for (const auto &[value, vector] : pairs)
                  sum += function(value) * vector[index[k][0]] * vector[index[k][1]];
                values[k][lane] = sum;
              }
          }
    return result;
  }


  PlasticHistory PlasticCells::with_logarithms(const PlasticHistory &history) const
  {
    return of_eigenvalues(history, [](const double value) { return -0.5 * std::log(value); });
  }


  PlasticHistory PlasticCells::from_logarithms(const PlasticHistory &logarithmic) const
  {
    PlasticHistory history =
      of_eigenvalues(logarithmic, [](const double value) { return std::exp(-2. * value); });
    for (const Range &range : ranges)
      for (std::size_t i = 0; i < range.plastic.backstresses.size(); ++i)
        {
          const auto &[modulus, recovery] = range.plastic.backstresses[i];
          if (recovery == 0.)
            continue;
          for (std::size_t b = range.begin; b < range.end; ++b)
            {
              Lanes *const backstress = &history.values[range.history + (b - range.begin) * range.stride() +
                                                        backstress_at + n_components * i];
              for (unsigned int lane = 0; lane < n_lanes; ++lane)
                {
                  std::array<double, n_components> now;
                  for (unsigned int k = 0; k < n_components; ++k)
                    now[k] = backstress[k][lane];
                  const double beyond = von_mises(now) / (modulus / recovery);
                  for (unsigned int k = 0; k < n_components && beyond > 1.; ++k)
                    backstress[k][lane] /= beyond;
                }
            }
        }
    return history;
  }


  std::vector<double> PlasticCells::net_plastic_strain(const PlasticHistory &logarithmic) const
  {
    std::vector<double> strain(zone_of_cell.size(), 0.);
    for (const Range &range : ranges)
      for (std::size_t b = range.begin; b < range.end; ++b)
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          if (const int cell = cell_of_lane[b][lane]; cell >= 0)
            {
              const Lanes *const values =
                &logarithmic.values[range.history + (b - range.begin) * range.stride()];
              double square = 0.;
              for (unsigned int k = 0; k < n_components; ++k)
                square += (k < 3 ? 1. : 2.) * values[k][lane] * values[k][lane];
              strain[cell] = std::sqrt(2. / 3. * square);
            }
    return strain;
  }
} // namespace tread
