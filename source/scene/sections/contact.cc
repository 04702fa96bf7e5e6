// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/contact.h>

namespace tread
{
  void ContactSection::declare(dealii::ParameterHandler &handler)
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    Section section(handler, "Contact");

    section.add("Friction coefficient", friction_coefficient,
                "Without slip; that of Coulomb's law is the same at any slip speed. 0 is frictionless.",
                Double(0., 2.));
    section.choose("Friction law", friction_law, friction_laws(),
                   "How the friction coefficient depends on the slip speed of each node.");
    declare_friction_laws(handler);
    section.add(
      "Tolerance", tolerance,
      "Sweeps over the contact nodes end when no impulse changes by more than this share of the largest.",
      Double(1e-15, 0.1));
    section.add("Largest number of sweeps", max_sweeps, "In one time step.", Integer(1, 100000));
  }
} // namespace tread
