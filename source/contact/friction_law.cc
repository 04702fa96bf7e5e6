// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/registry.h>
#include <tread/contact/exponential_friction.h>
#include <tread/contact/friction_law.h>
#include <tread/contact/linear_friction.h>
#include <tread/contact/rational_friction.h>
#include <tread/contact/stribeck_friction.h>

#include <boost/math/tools/roots.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tread
{
  namespace
  {
    template <typename Law>
    FrictionLawEntry entry()
    {
      return {Law::name, Law::description, &Law::declare, &Law::make};
    }
  } // namespace


  const std::vector<FrictionLawEntry> &friction_laws()
  {
    static const std::vector<FrictionLawEntry> laws{
      entry<CoulombFriction>(),  entry<ExponentialFriction>(), entry<LinearFriction>(),
      entry<RationalFriction>(), entry<StribeckFriction>(),
    };
    return laws;
  }


  double FrictionLaw::slip(const double free_slip, const double stopping) const
  {
    return slip_between(0., free_slip, free_slip, stopping);
  }


  double FrictionLaw::slip_between(const double lower,
                                   const double upper,
                                   const double free_slip,
                                   const double stopping) const
  {
    const auto excess = [&](const double s) {
      return s + stopping * coefficient(s) - free_slip;
    };
    const double at_lower = excess(lower), at_upper = excess(upper);
    if (!(at_lower < 0.))
      return lower;
    if (!(at_upper > 0.))
      return upper;
    // Algorithm 748 of Alefeld, Potra & Shi (1995). The interval that it leaves is some round-off of
    // free_slip; its lower end is where the excess of speed is not yet above 0.
    std::uintmax_t most_evaluations = 60;
    const double   round_off        = 4. * std::numeric_limits<double>::epsilon() * free_slip;
    return boost::math::tools::toms748_solve(
             excess, lower, upper, at_lower, at_upper,
             [=](const double a, const double b) { return b - a <= round_off; }, most_evaluations)
      .first;
  }


  double StribeckFriction::slip(const double free_slip, const double stopping) const
  {
    // Of t = s/s_c the derivative of the sum over s_c is 1 - k t exp(-t^2), k = 2 stopping fall/s_c: least at
    // t = 1/sqrt(2).
    const double k     = 2. * stopping * fall / falling_speed;
    const auto   slope = [k](const double t) {
      return 1. - k * t * std::exp(-t * t);
    };
    const double middle  = 1. / std::sqrt(2.);
    const auto   turning = [&](const double lower, const double upper) {
      std::uintmax_t most_evaluations = 60;
      return falling_speed * boost::math::tools::toms748_solve(slope, lower, upper,
                                                                 boost::math::tools::eps_tolerance<double>(),
                                                                 most_evaluations)
                               .first;
    };
    if (!(slope(middle) < 0.))
      return slip_between(0., free_slip, free_slip, stopping);
    const double first = turning(0., middle);
    if (first + stopping * coefficient(first) >= free_slip)
      return slip_between(0., std::min(first, free_slip), free_slip, stopping);
    double beyond = 2. * middle;
    while (slope(beyond) < 0.)
      beyond *= 2.;
    return slip_between(turning(middle, beyond), free_slip, free_slip, stopping);
  }


  void declare_friction_laws(Section &section)
  {
    for (const FrictionLawEntry &law : friction_laws())
      law.declare(section);
  }


  std::shared_ptr<const FrictionLaw> make_friction_law(const std::string              &name,
                                                       const double                    coefficient,
                                                       const dealii::ParameterHandler &section)
  {
    return entry_named(friction_laws(), name, "friction law").make(coefficient, section);
  }
} // namespace tread
