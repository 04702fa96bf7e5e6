// SPDX-License-Identifier: LGPL-2.1-or-later
// How the history of plastic cells is compared and extrapolated from passage to passage.
#include <tread/base/matrix3.h>
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
    for_batches([&](const Range &, const std::size_t, const std::size_t first) {
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        {
          Lanes *const                  values = &result.values[first];
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
    });
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
    for_batches([&](const Range &range, const std::size_t, const std::size_t first) {
      for (std::size_t i = 0; i < range.plastic.backstresses.size(); ++i)
        {
          const auto &[modulus, recovery] = range.plastic.backstresses[i];
          if (recovery == 0.)
            continue;
          Lanes *const backstress = &history.values[first + backstress_at + n_components * i];
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
    });
    return history;
  }


  PlasticHistory PlasticCells::with_stresses(const Vector3 *x, const PlasticHistory &history) const
  {
    PlasticHistory stressed = history;
    for_batches([&](const Range &, const std::size_t b, const std::size_t first) {
      Lanes *const values = &stressed.values[first];
      Lanes        F[3][3], amplitude[4][3], G[n_components], elastic[n_components];
      deform(batches[b], x, F, amplitude);
      std::copy_n(values, n_components, G);
      congruence(F, G, elastic);
      std::copy_n(elastic, n_components, values);
      for (unsigned int m = 0; m < 4; ++m)
        {
          Lanes *const flowed = values + hourglass_at + 3 * m;
          for (unsigned int i = 0; i < 3; ++i)
            amplitude[m][i] -= F[i][0] * flowed[0] + F[i][1] * flowed[1] + F[i][2] * flowed[2];
          std::copy_n(amplitude[m], 3, flowed);
        }
    });
    return of_eigenvalues(stressed, [](const double value) { return 0.5 * std::log(value); });
  }


  PlasticHistory PlasticCells::from_stresses(const Vector3 *x, const PlasticHistory &stressed) const
  {
    PlasticHistory history =
      of_eigenvalues(stressed, [](const double value) { return std::exp(2. * value); });
    for_batches([&](const Range &, const std::size_t b, const std::size_t first) {
      Lanes *const values = &history.values[first];
      Lanes        F[3][3], inverse[3][3], amplitude[4][3], elastic[n_components], G[n_components];
      deform(batches[b], x, F, amplitude);
      invert(F, inverse);
      std::copy_n(values, n_components, elastic);
      congruence(inverse, elastic, G);
      std::copy_n(G, n_components, values);
      for (unsigned int m = 0; m < 4; ++m)
        {
          Lanes *const flowed = values + hourglass_at + 3 * m;
          for (unsigned int i = 0; i < 3; ++i)
            amplitude[m][i] -= flowed[i];
          for (unsigned int i = 0; i < 3; ++i)
            flowed[i] = inverse[i][0] * amplitude[m][0] + inverse[i][1] * amplitude[m][1] +
                        inverse[i][2] * amplitude[m][2];
        }
    });
    return history;
  }


  void PlasticCells::add(PlasticHistory       &history,
                         const double          factor,
                         const PlasticHistory &other,
                         const unsigned int    begin,
                         const unsigned int    end) const
  {
    for_batches([&](const Range &range, const std::size_t, const std::size_t first) {
      for (std::size_t k = begin; k < std::min<std::size_t>(end, range.stride()); ++k)
        history.values[first + k] += factor * other.values[first + k];
    });
  }


  void PlasticCells::copy(PlasticHistory       &history,
                          const PlasticHistory &other,
                          const unsigned int    begin,
                          const unsigned int    end) const
  {
    for_batches([&](const Range &, const std::size_t, const std::size_t first) {
      std::copy_n(other.values.begin() + first + begin, end - begin, history.values.begin() + first + begin);
    });
  }


  PlasticHistory PlasticCells::where_flowing(const PlasticHistory &flow,
                                             const PlasticHistory &there,
                                             const PlasticHistory &elsewhere) const
  {
    PlasticHistory result = elsewhere;
    for_batches([&](const Range &range, const std::size_t, const std::size_t first) {
      for (std::size_t k = first; k < first + range.stride(); ++k)
        result.values[k] = flow.values[first + strain_at] > 0. ? there.values[k] : result.values[k];
    });
    return result;
  }


  std::vector<double> PlasticCells::products(const PlasticHistory &a,
                                             const PlasticHistory &b,
                                             const unsigned int    begin,
                                             const unsigned int    end) const
  {
    std::vector<double> product(zone_of_cell.size(), 0.);
    for_cells([&](const Range &range, const std::size_t first, const unsigned int lane, const int cell,
                  const std::size_t) {
      for (std::size_t k = begin; k < std::min<std::size_t>(end, range.stride()); ++k)
        product[cell] += a.values[first + k][lane] * b.values[first + k][lane];
    });
    return product;
  }


  std::vector<double> PlasticCells::net_plastic_strain(const PlasticHistory &logarithmic) const
  {
    std::vector<double> strain(zone_of_cell.size(), 0.);
    for_cells([&](const Range &, const std::size_t first, const unsigned int lane, const int cell,
                  const std::size_t) {
      const Lanes *const values = &logarithmic.values[first];
      double             square = 0.;
      for (unsigned int k = 0; k < n_components; ++k)
        square += (k < 3 ? 1. : 2.) * values[k][lane] * values[k][lane];
      strain[cell] = std::sqrt(2. / 3. * square);
    });
    return strain;
  }
} // namespace tread
