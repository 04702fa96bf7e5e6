// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_exponential_friction_h
#define tread_contact_exponential_friction_h

#include <tread/contact/falling_friction.h>

namespace tread
{
  /// exp(-s/s_c) (Polach 2005, with f_k/f_0 = A and 1/s_c = B; Vollebregt & Schuttelaars 2012 on what it does
  /// to rolling). Convex.
  class ExponentialFriction : public FallingFriction
  {
  public:
    static constexpr const char *name = "falling";
    static constexpr const char *description =
      "from the coefficient to the kinetic one, exponentially with the slip speed";

    static std::shared_ptr<const FrictionLaw> make(const double                    coefficient,
                                                   const dealii::ParameterHandler &section)
    {
      return of_section<ExponentialFriction>(coefficient, section);
    }

    ExponentialFriction(const double coefficient,
                        const double kinetic_coefficient,
                        const double falling_speed)
      : FallingFriction(coefficient, kinetic_coefficient, falling_speed)
    {
    }

  private:
    double shape(const double speed) const override
    {
      return std::exp(-speed);
    }
  };
} // namespace tread

#endif
