// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_falling_friction_h
#define tread_contact_falling_friction_h

#include <tread/contact/friction_law.h>

#include <cmath>
#include <stdexcept>

namespace tread
{
  /// A coefficient that falls with the slip speed s from f_0 to f_k, f(s) = f_k + (f_0 - f_k) exp(-s/s_c)
  /// (Polach 2005, with f_k/f_0 = A and 1/s_c = B; Vollebregt & Schuttelaars 2012 on what it does to
  /// rolling). Convex.
  class FallingFriction : public FrictionLaw
  {
  public:
    static constexpr const char *name = "falling";
    static constexpr const char *description =
      "from the coefficient to the kinetic one, exponentially with the slip speed";

    static void declare(dealii::ParameterHandler &section)
    {
      using dealii::Patterns::Double;
      // Polach's A = 0.4 and B = 0.6 s/m for a dry rail, with the usual friction coefficient 0.5.
      section.declare_entry("Kinetic friction coefficient", "0.2", Double(0., 2.),
                            "Of the falling law: at slip speeds far above the one below. Not above the "
                            "friction coefficient.");
      section.declare_entry("Falling slip speed (m per s)", "1.67", Double(1e-6, 1e6),
                            "Of the falling law: where 63 % of the fall is over.");
    }

    static std::shared_ptr<const FrictionLaw> make(const double                    coefficient,
                                                   const dealii::ParameterHandler &section)
    {
      return std::make_shared<FallingFriction>(coefficient,
                                               section.get_double("Kinetic friction coefficient"),
                                               section.get_double("Falling slip speed (m per s)"));
    }

    /// @param slip_speed s_c, m/s. @throws std::invalid_argument if the law would rise.
    FallingFriction(const double coefficient, const double kinetic_coefficient, const double slip_speed)
      : kinetic(kinetic_coefficient)
      , fall(coefficient - kinetic_coefficient)
      , slip_speed(slip_speed)
    {
      if (!(fall >= 0.))
        throw std::invalid_argument(
          "'Contact/Kinetic friction coefficient' must not be above 'Contact/Friction coefficient'");
    }

    double coefficient(const double slip_speed) const override
    {
      return kinetic + fall * std::exp(-slip_speed / this->slip_speed);
    }

  private:
    double kinetic, fall, slip_speed;
  };
} // namespace tread

#endif
