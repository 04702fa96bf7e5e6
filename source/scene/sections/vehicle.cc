// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/vehicle.h>

namespace tread
{
  void VehicleSection::declare(dealii::ParameterHandler &handler)
  {
    using dealii::Patterns::Double;
    Section section(handler, "Vehicle");

    section.add("Sprung mass (kg)", sprung_mass, "Rests on the primary suspension and loads the contact.",
                Double(0.));
    section.add("Wheel load (kN)", wheel_load, "masses",
                "Static force between each wheel and the rail. A number sets the sprung mass, whatever "
                "'Sprung mass' says; "
                "masses: the weight of 'Wheel/Mass' and sprung mass.",
                Double(0.));
    section.add("Suspension stiffness (kN per m)", suspension_stiffness, "Vertical.", Double(0.));
    section.add("Suspension damping (N s per m)", suspension_damping, "Vertical.", Double(0.));
    section.add("Gravity (m per s2)", gravity, "Weight of wheel and sprung mass: the load of the contact.",
                Double(0., 100.));
  }
} // namespace tread
