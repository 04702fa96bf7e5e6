// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_stribeck_friction_h
#define tread_contact_stribeck_friction_h

#include <tread/contact/falling_friction.h>

namespace tread
{
  /// exp(-(s/s_c)^2): flat at first, as between lubricated surfaces (Stribeck 1902; Armstrong-Helouvry,
  /// Dupont & Canudas de Wit 1994). Concave up to s_c/sqrt(2), convex beyond.
  class StribeckFriction : public FallingFriction
  {
  public:
    static constexpr const char *name = "Stribeck";
    static constexpr const char *description =
      "from the coefficient to the kinetic one, as a bell curve over the slip speed";

    static std::shared_ptr<const FrictionLaw> make(const double                    coefficient,
                                                   const dealii::ParameterHandler &section)
    {
      return of_section<StribeckFriction>(coefficient, section);
    }

    StribeckFriction(const double coefficient, const double kinetic_coefficient, const double falling_speed)
      : FallingFriction(coefficient, kinetic_coefficient, falling_speed)
    {
    }

    /// s + stopping f(s) rises, and where the law is steep (stopping (f_0 - f_k)/s_c above sqrt(e/2)) falls
    /// between two speeds: the least root lies before the first of them if its value there is above
    /// free_slip, otherwise beyond the second.
    double slip(const double free_slip, const double stopping) const override;

  private:
    double shape(const double speed) const override
    {
      return std::exp(-speed * speed);
    }
  };
} // namespace tread

#endif
