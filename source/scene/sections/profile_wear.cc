// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/profile_wear.h>

namespace tread
{
  void ProfileWearSection::declare(ParameterTable &table)
  {
    Section section(table, "Profile wear");

    section.add("Passages", passages,
                "Of 'tread wear': wheels that pass the rail. 0: the rail keeps its profile.",
                Number(0., 1e12));
    section.add(
      "Wheel turns", turns,
      "Of 'tread wear': turns of the wheel meanwhile. 0: the wheel keeps its profile, as if each that "
      "passes were new.",
      Number(0., 1e12));
    section.add(
      "Smoothing length (mm)", smoothing,
      "Wear of a step is spread along the profile so that half is left of its waves of this length. Shorter "
      "waves cannot grow.",
      Number(0., 50.));
    section.add("Point distance (mm)", spacing, "Of the points by which profiles wear.", Number(0.01, 1.));
    section.add(
      "Largest change", change,
      "Largest share by which a step may change the distribution of the normal force across the rail, as "
      "the mean over the contacts: it sets the steps.",
      Number(0.001, 1.));
    section.add(
      "Smallest step (um)", least_step,
      "A step is not made shorter than by this largest depth, whatever it changes, such as where a contact "
      "jumps from one place to another.",
      Number(1e-4, 100.));
    section.add("States", states, "States that are kept, at even distances, beside that of the start.",
                WholeNumber(1, 1000));
  }


  void ProfileWearSection::check() const
  {
    require(
      passages > 0. || turns > 0.,
      "'Profile wear/Passages' or 'Wheel turns' must be above 0: neither the rail nor the wheel would wear");
    constexpr double points_in_a_wave = 3.;
    require(smoothing == 0. || smoothing >= points_in_a_wave * spacing,
            "'Profile wear/Smoothing length (mm)' " + text_of(1e3 * smoothing) +
              " is too short for 'Point distance (mm)' " + text_of(1e3 * spacing) +
              ": at least three times as long, or 0");
  }
} // namespace tread
