// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_rational_friction_h
#define tread_contact_rational_friction_h

#include <tread/contact/falling_friction.h>

namespace tread
{
  /// 1/(1 + s/s_c) (Ohyama 1991; with f_k = 0). Convex.
  class RationalFriction : public FallingFriction
  {
  public:
    static constexpr const char *name = "rational";
    static constexpr const char *description =
      "from the coefficient to the kinetic one, as one over one plus the slip speed";

    static std::shared_ptr<const FrictionLaw> make(const double                    coefficient,
                                                   const dealii::ParameterHandler &section)
    {
      return of_section<RationalFriction>(coefficient, section);
    }

    RationalFriction(const double coefficient, const double kinetic_coefficient, const double falling_speed)
      : FallingFriction(coefficient, kinetic_coefficient, falling_speed)
    {
    }

  private:
    double shape(const double speed) const override
    {
      return 1. / (1. + speed);
    }
  };
} // namespace tread

#endif
