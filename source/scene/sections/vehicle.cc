// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/vehicle.h>

namespace tread
{
  void VehicleSection::declare(ParameterTable &table)
  {
    Section section(table, "Vehicle");

    section.needs({"Vehicle/Wheel load (kN)", {"masses"}})
      .needs({"Vehicle/Axle load (t)", {"none"}})
      .add(
        "Sprung mass (kg)", sprung_mass,
        "Sprung mass per wheel: it rests on the primary suspension and its weight is part of the wheel load.",
        Number(0.));
    section.add("Wheel load (kN)", wheel_load, "masses",
                "Static force between each wheel and the rail. A number sets the sprung mass, whatever "
                "'Sprung mass' says. masses: the load is the weight of 'Wheel/Mass' and sprung mass.",
                Number(0.));
    section.add(
      "Axle load (t)", axle_load, "none",
      "Static axle load: the mass that both wheels of the axle press on the rails, themselves included; each "
      "wheel carries half of its weight. A number sets the sprung mass, whatever 'Sprung mass' says, and "
      "excludes 'Wheel load (kN)'. none: 'Wheel load (kN)' or the masses give the load.",
      Number(0.));
    section.add("Suspension stiffness (kN per m)", suspension_stiffness,
                "Vertical stiffness of the primary suspension, per wheel.", Number(0.));
    section.add("Suspension damping (N s per m)", suspension_damping,
                "Vertical damping of the primary suspension, per wheel.", Number(0.));
    section.add("Gravity (m per s2)", gravity,
                "Acceleration of gravity, which turns wheel and sprung mass into the load of the contact.",
                Number(0., 100.));
  }
} // namespace tread
