// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/surface_heat.h>

#include <cmath>

namespace tread::reference
{
  SurfaceHeat::SurfaceHeat(const double interval)
    : length(interval)
    , at_once(2. * std::sqrt(interval))
  {
    // 1/sqrt(t) = 2/sqrt(pi) int exp(u) exp(-exp(2 u) t) du; the error of the rule is exp(-pi^2/(2 spacing)).
    constexpr double spacing = 0.6, largest = 4.; // of the rates, over the interval
    for (unsigned int k = 0; k < n_rates; ++k)
      {
        rates[k]   = largest / interval * std::exp(-2. * spacing * k);
        weights[k] = 2. / std::sqrt(M_PI) * spacing * std::sqrt(rates[k]);
        decay[k]   = std::exp(-rates[k] * interval);
        gain[k]    = -std::expm1(-rates[k] * interval) / rates[k];
        at_once -= weights[k] * gain[k];
      }
  }


  double SurfaceHeat::flow(Memory &memory, const double flux) const
  {
    double sum = at_once * flux;
    for (unsigned int k = 0; k < n_rates; ++k)
      {
        memory[k] = decay[k] * memory[k] + gain[k] * flux;
        sum += weights[k] * memory[k];
      }
    return sum / std::sqrt(M_PI);
  }


  void SurfaceHeat::rest(Memory &memory, const double time) const
  {
    for (unsigned int k = 0; k < n_rates; ++k)
      memory[k] *= std::exp(-rates[k] * time);
  }
} // namespace tread::reference
