// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/damage_index.h>
#include <tread/analysis/wear_law.h>
#include <tread/scene/sections/damage.h>

namespace tread
{
  void DamageSection::declare(ParameterTable &table)
  {
    Section    section(table, "Damage");
    const Need by_temperature("Contact/Friction temperatures (C)", {}, "given");

    section.add(
      "Record", record,
      "true: rail_surface_damage.csv and wheel_surface_damage.csv have, for each place of both surfaces, "
      "frictional work, slip, largest pressure and shear stress, passages, flash temperature and "
      "wear of all steps; doc/damage.md.");
    section.all_need({{"Damage/Record", {"true"}}});
    section.choose("Wear law", wear_law, wear_laws(),
                   "What a surface loses where the other one slides over it.");
    declare_wear_laws(section);
    section.add("Thermal conductivity (W per m K)", conductivity,
                "Of wheel and rail, for the flash temperature.", Number(1e-3, 1e4));
    section.add("Heat capacity (J per kg K)", heat_capacity,
                "Of wheel and rail, likewise; with 'Density (kg per m3)', not scaled.", Number(1e-3, 1e6));
    section.add(
      "Heat share of the wheel", wheel_share, "automatic",
      "Of the heat of friction, the rest flows into the rail. automatic: so that both surfaces have one "
      "temperature, half for like steels.",
      Number(0., 1.));
    section.all_need({});
    section.needs(by_temperature)
      .add("Rail temperature (C)", rail_temperature,
           "Of the rail before the wheel comes, for 'Contact/Friction temperatures (C)'.",
           Number(-100., 1000.));
    section.needs(by_temperature)
      .add("Wheel temperature (C)", wheel_temperature,
           "Of the wheel's surface before it comes into contact, likewise, as by braking on the tread. "
           "Surfaces of unlike temperature take one between in the patch at once, by their effusivities.",
           Number(-100., 1000.));
    section.add("Shear strength (MPa)", shear_strength,
                "Yield stress in shear of the rail, for the surface fatigue index and the shakedown map. 0: "
                "'Rail/Yield stress (MPa)' over the root of 3 where that is given, else there are none.",
                Number(0., 1e5));
    declare_damage_indices(section);
  }
} // namespace tread
