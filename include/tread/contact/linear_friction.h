// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_linear_friction_h
#define tread_contact_linear_friction_h

#include <tread/contact/falling_friction.h>

#include <algorithm>

namespace tread
{
  /// 1 - s/s_c up to s_c, 0 beyond. Convex.
  class LinearFriction : public FallingFriction
  {
  public:
    static constexpr const char *name = "linear";
    static constexpr const char *description =
      "from the coefficient to the kinetic one in a straight line, then constant";

    static std::shared_ptr<const FrictionLaw> make(const double                    coefficient,
                                                   const dealii::ParameterHandler &section)
    {
      return of_section<LinearFriction>(coefficient, section);
    }

    LinearFriction(const double coefficient, const double kinetic_coefficient, const double falling_speed)
      : FallingFriction(coefficient, kinetic_coefficient, falling_speed)
    {
    }

  private:
    double shape(const double speed) const override
    {
      return std::max(0., 1. - speed);
    }
  };
} // namespace tread

#endif
