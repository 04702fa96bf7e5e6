// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/track.h>

namespace tread
{
  template <>
  const std::vector<Choice<Foundation>> &choices()
  {
    static const std::vector<Choice<Foundation>> list{
      {Foundation::rigid, "rigid", "the rail's bottom is held."},
      {Foundation::one_layer, "one-layer", "it rests on pads on the ground."},
      {Foundation::two_layer, "two-layer", "pads, sleepers and ballast."},
      {Foundation::co_running, "co-running",
       "the rail's bottom stays in shape and moves up, down and across on springs and dampers under a mass, "
       "all of which run along with the wheel; for one wheel, also in a wheelset's position."},
      {Foundation::beam, "beam",
       "the rail's bottom is bonded to a beam of the whole rail's stiffness on pads, sleepers and ballast, "
       "which goes on "
       "beyond both of its ends; for one wheel, also in a wheelset's position."}};
    return list;
  }


  template <>
  const std::vector<Choice<SleeperKind>> &choices()
  {
    static const std::vector<Choice<SleeperKind>> list{
      {SleeperKind::mass, "mass", "they move in z and are rigid."},
      {SleeperKind::solid, "solid",
       "half sleepers of cells, the middle of the track being a plane of symmetry; they bend and cost "
       "cells."}};
    return list;
  }


  void TrackSection::declare(ParameterTable &table)
  {
    // Far beyond any pad or ballast on both sides; still softer ones let the rail sink away, stiffer ones and
    // stronger dampers take steps that no run has time for.
    const Number stiffness(1., 1e8), damping(0., 1e5);
    Section      section(table, "Track");
    const Need   moves("Track/Foundation", {"one-layer", "two-layer", "co-running", "beam"}),
      pads("Track/Foundation", {"one-layer", "two-layer"}),
      seats("Track/Foundation", {"one-layer", "two-layer", "beam"}),
      two_layers("Track/Foundation", {"two-layer"}), ballast("Track/Foundation", {"two-layer", "beam"}),
      co_runs("Track/Foundation", {"co-running"}), beam("Track/Foundation", {"beam"}),
      solid =
        Need("Track/Sleepers", {"solid"}, "solid, on two layers").and_has("Track/Foundation", {"two-layer"});

    section.choose("Foundation", foundation, "",
                   "With layers the rail's ends are planes of symmetry, and supports move vertically only.");
    section.all_need({moves});
    section.needs(two_layers).choose("Sleepers", sleepers, "Of two layers.");
    section.needs(seats).add(
      "Sleeper spacing (m)", sleeper_spacing,
      "Distance between the middles of neighbouring supports. But on a beam the rail must end between half a "
      "pad and half a spacing beyond its last supports.",
      Number(0.05, 10.));
    section.needs(seats).add("Support 0 (mm)", support_0,
                             "x of the support with number 0. Numbers grow in rolling direction.",
                             Number(-20000., 20000.));
    section.needs(seats).add("Pad stiffness (MN per m)", pad_stiffness,
                             "Vertical stiffness of the rail pad, for a whole rail seat.", stiffness);
    section.needs(seats).add("Pad damping (kN s per m)", pad_damping,
                             "Vertical damping of the rail pad, for a whole rail seat.", damping);
    section.needs(pads).add(
      "Pads pull", pads_pull,
      "true: the fastenings hold the rail down, so that pads carry uplift as well as compression. "
      "false: the rail can lift off its pads.");
    section.needs(seats).add(
      "Pad length (mm)", pad_length,
      "Length of the pad along the rail. Longer pads resist the slope of the rail as well.",
      Number(1., 2000.));
    section.needs(pads).add(
      "Pad width (mm)", pad_width,
      "Width of the pad across the rail, at most that of the foot. Wider pads resist the roll-over "
      "of the rail more.",
      Number(1., 2000.));
    section.needs(seats).add(
      "Points along", points_along,
      "Number of points along the rail at which a pad acts (the ballast under a solid sleeper "
      "likewise). 1: the pad does not resist the slope of the rail.",
      WholeNumber(1, 50));
    section.needs(pads).add(
      "Points across", points_across,
      "Number of points across the rail at which a pad acts. 1: nothing keeps the rail from rolling over, so "
      "only for upright rails that are loaded on y = 0 and whose crown radius exceeds their height.",
      WholeNumber(1, 50));
    section.needs(ballast).add(
      "Sleeper mass (kg)", sleeper_mass,
      "Mass of the sleeper under one rail: half a sleeper. It sets the height of a solid one.",
      Number(1e-3, 1e6));
    section.needs(solid).add("Sleeper length (m)", sleeper_length, "Length of a whole solid sleeper.",
                             Number(0.1, 10.));
    section.needs(solid).add("Sleeper width (mm)", sleeper_width,
                             "Width of a solid sleeper along the rail; not below the length of the pad.",
                             Number(1., 2000.));
    section.needs(solid).add(
      "Rail distance (mm)", rail_distance,
      "Distance between the middles of both rails, for solid sleepers: the middle of the track "
      "lies half of it away, at y < 0.",
      Number(1., 5000.));
    section.needs(solid).add("Sleeper Young's modulus (GPa)", sleeper_young_modulus,
                             "Young's modulus of a solid sleeper.", Number(1e-3, 1e4));
    section.needs(solid).add("Sleeper Poisson's ratio", sleeper_poisson_ratio,
                             "Poisson's ratio of a solid sleeper.", Number(0., 0.49));
    section.needs(solid).add("Sleeper density (kg per m3)", sleeper_density, "Density of a solid sleeper.",
                             Number(1., 1e5));
    section.needs(ballast).add("Ballast stiffness (MN per m)", ballast_stiffness,
                               "Vertical stiffness of the ballast under one rail's half of a sleeper.",
                               stiffness);
    section.needs(ballast).add("Ballast damping (kN s per m)", ballast_damping,
                               "Vertical damping of the ballast under one rail's half of a sleeper.",
                               damping);
    section.all_need({{"Rail/Ends", {"endless"}}, moves}); // the ends are told first
    section.add(
      "Stiffness along the rail (MN per m)", stiffness_along,
      "With which each support beyond endless ends ('Rail/Ends') holds the rail along itself. Those "
      "under the cells hold it vertically only.",
      Number(0., 1e6));
    section.all_need({moves});
    section.needs(pads).add(
      "Support file", support_file,
      "Table of supports that differ, such as hanging sleepers or soft pads, separated by commas, with a row "
      "of names: support, its number, and any of pad_stiffness_MN_per_m, pad_damping_kN_s_per_m, "
      "ballast_stiffness_MN_per_m and ballast_damping_kN_s_per_m, in place of the parameters of these names, "
      "and ballast_gap_mm, of a sleeper that hangs as far above its ballast.");
    section.needs(co_runs).add(
      "Co-running mass (kg)", co_running.mass,
      "Mass of the track that moves with the rail under the wheel, without the meshed part of the rail.",
      Number(10., 1e6));
    section.needs(co_runs).add(
      "Vertical stiffness (MN per m)", co_running.vertical.stiffness,
      "Vertical stiffness of the co-running track under a wheel; the force counts from the "
      "equilibrium at the start.",
      stiffness);
    section.needs(co_runs).add("Vertical damping (kN s per m)", co_running.vertical.damping,
                               "Vertical damping of the co-running track.", damping);
    section.needs(co_runs).add("Lateral stiffness (MN per m)", co_running.lateral.stiffness,
                               "Lateral stiffness of the co-running track.", stiffness);
    section.needs(co_runs).add("Lateral damping (kN s per m)", co_running.lateral.damping,
                               "Lateral damping of the co-running track.", damping);
    section.needs(beam).add(
      "Beam bending stiffness (MN m2)", beam_bending_stiffness,
      "E I of the rail's whole section, of which a beam is made, that of the cells included. The "
      "default is a 60E1 rail's; a crossing has several times as much.",
      Number(1e-3, 1e4));
    section.needs(beam).add("Beam shear stiffness (MN)", beam_shear_stiffness,
                            "The same in shear, kappa G A.", Number(1e-1, 1e6));
    section.needs(beam).add("Beam mass (kg per m)", beam_mass,
                            "The same: mass per length, that of the cells included.", Number(1e-1, 1e5));
    section.needs(beam).add(
      "Beam file", beam_file,
      "Table of stretches of the beam that differ, such as a joint with fishplates or the casting of a "
      "crossing, separated by commas, with a row of names: x_mm, from which on up to the next row's the "
      "beam has this bending_stiffness_MN_m2, shear_stiffness_MN and mass_kg_per_m. Before the first "
      "row it has those of the parameters, behind the last row that row's.");
  }


  double TrackSection::solid_sleeper_height() const
  {
    return sleeper_mass / (sleeper_density * 0.5 * sleeper_length * sleeper_width);
  }


  void TrackSection::check() const
  {
    if (!has_supports() && !is_beam())
      return;
    require(pad_length < sleeper_spacing, "'Track/Pad length (mm)' " + text_in_mm(pad_length) +
                                            " must be below the sleeper spacing, " +
                                            text_in_mm(sleeper_spacing));
    if (!has_solid_sleepers())
      return;
    require(pad_length <= sleeper_width && sleeper_width < sleeper_spacing,
            "'Track/Sleeper width (mm)' " + text_in_mm(sleeper_width) +
              " must be from 'Pad length (mm)' to below the spacing");
    require(0.5 * (rail_distance + pad_width) <= 0.5 * sleeper_length && pad_width <= rail_distance,
            "'Track/Sleeper length (m)' " + text_of(sleeper_length) +
              " does not reach under the pads of rails at 'Rail distance (mm)' " + text_in_mm(rail_distance));
  }
} // namespace tread
