// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/registry.h>
#include <tread/contact/falling_friction.h>
#include <tread/contact/friction_law.h>

#include <boost/math/tools/toms748_solve.hpp>

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
      entry<CoulombFriction>(),
      entry<FallingFriction>(),
    };
    return laws;
  }


  double FrictionLaw::slip(const double free_slip, const double stopping) const
  {
    const auto excess = [&](const double s) {
      return s + stopping * coefficient(s) - free_slip;
    };
    const double at_no_slip = excess(0.), at_most = excess(free_slip);
    if (!(at_no_slip < 0.))
      return 0.;
    if (!(at_most > 0.))
      return free_slip;
    // Algorithm 748 of Alefeld, Potra & Shi (1995). The interval that it leaves is some round-off of
    // free_slip; its lower end is where the excess of speed is not yet above 0.
    std::uintmax_t most_evaluations = 60;
    const double   round_off        = 4. * std::numeric_limits<double>::epsilon() * free_slip;
    return boost::math::tools::toms748_solve(
             excess, 0., free_slip, at_no_slip, at_most,
             [=](const double lower, const double upper) { return upper - lower <= round_off; },
             most_evaluations)
      .first;
  }


  void declare_friction_laws(dealii::ParameterHandler &section)
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
