// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/elastic.h>

#include "require.h"

namespace tread::reference
{
  double Elastic::shear() const
  {
    return young / (2. * (1. + poisson));
  }

  double ElasticPair::hertz_modulus() const
  {
    return shear / (1. - poisson);
  }

  ElasticPair combine(const Elastic &wheel, const Elastic &rail)
  {
    for (const Elastic *body : {&wheel, &rail})
      {
        const std::string name = (body == &wheel) ? "wheel" : "rail";
        require_positive("Young's modulus of the " + name, body->young, "Pa");
        require(body->poisson >= 0. && body->poisson <= 0.5, "Poisson's ratio of the " + name, body->poisson,
                "0 to 0.5");
      }
    const double g1 = wheel.shear(), g2 = rail.shear();
    ElasticPair  pair;
    pair.shear    = 2. / (1. / g1 + 1. / g2);
    pair.poisson  = 0.5 * pair.shear * (wheel.poisson / g1 + rail.poisson / g2);
    pair.coupling = 0.25 * pair.shear * ((1. - 2. * wheel.poisson) / g1 - (1. - 2. * rail.poisson) / g2);
    return pair;
  }
} // namespace tread::reference
