// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_falling_friction_h
#define tread_contact_falling_friction_h

#include <tread/contact/friction_law.h>

#include <cmath>
#include <stdexcept>

namespace tread
{
  /// A coefficient that falls with the slip speed s from f_0 to f_k, f(s) = f_k + (f_0 - f_k) shape(s/s_c),
  /// with shape(0) = 1 and no less than 0. @see the laws below, stribeck_friction.h
  class FallingFriction : public FrictionLaw
  {
  public:
    /// Distance of a memory that is to be found by the scene, m.
    static constexpr double to_be_found = -1.;

    static void declare(Section &section)
    {
      // The law that is there if nothing is said is Coulomb's.
      const Need falls(section.path("Friction law"), {}, "one that falls"),
        remembers = Need::of_fact(section.path("Friction memory (mm)"), "above 0", "memory of friction");
      // Polach's A = 0.4 and B = 0.6 s/m for a dry rail, with the usual friction coefficient 0.5.
      section.needs(falls).declare("Kinetic friction coefficient", "0.2", Number(0., 2.),
                                   "Of laws that fall: at slip speeds far above the one below. Not above the "
                                   "friction coefficient.");
      section.needs(falls).declare(
        "Falling slip speed (m per s)", "1.67", Number(1e-6, 1e6),
        "Of laws that fall: where 63 % of the fall is over (falling, Stribeck), half of it "
        "(rational) or all of it (linear).");
      section.needs(falls).declare(
        "Friction memory (mm)", automatic, WordOrNumber(automatic, Number(0., 10.)),
        "Of laws that fall: a node's coefficient follows its slip speed over this way of "
        "slip. 0: at once, so that under high pressure slip begins to oscillate by itself. automatic: the "
        "shortest way that keeps slip from it, some micrometres, by load, law and creepage; 0 where none is "
        "needed.");
      section.needs(falls).needs(remembers).declare(
        "Least speed of memory (m per s)", "0.001", Number(0., 1e3),
        "Of laws that fall: nodes that slip more slowly forget at this speed.");
    }

    double coefficient(const double slip_speed) const override
    {
      return kinetic + fall * shape(slip_speed / falling_speed);
    }

    Memory memory() const override
    {
      return kept;
    }

  protected:
    /// The word for a memory that a scene finds. @see RememberingFriction
    static constexpr const char *automatic = "automatic";

    /// @param falling_speed s_c, m/s. @throws std::invalid_argument if the law would rise.
    FallingFriction(const double coefficient, const double kinetic_coefficient, const double falling_speed)
      : kinetic(kinetic_coefficient)
      , fall(coefficient - kinetic_coefficient)
      , falling_speed(falling_speed)
    {
      if (!(fall >= 0.))
        throw std::invalid_argument(
          "'Contact/Kinetic friction coefficient' must not be above 'Contact/Friction coefficient'");
    }

    /// The law of this type with the values of the section.
    template <typename Law>
    static std::shared_ptr<const FrictionLaw> of_section(const double                    coefficient,
                                                         const dealii::ParameterHandler &section)
    {
      const auto law = std::make_shared<Law>(coefficient, section.get_double("Kinetic friction coefficient"),
                                             section.get_double("Falling slip speed (m per s)"));
      law->kept      = {section.get("Friction memory (mm)") == automatic
                          ? to_be_found
                          : 1e-3 * section.get_double("Friction memory (mm)"),
                   section.get_double("Least speed of memory (m per s)")};
      return law;
    }

    /// What is left of the fall at a slip speed over s_c.
    virtual double shape(const double speed) const = 0;

    const double kinetic, fall, falling_speed;
    Memory       kept;
  };
} // namespace tread

#endif
