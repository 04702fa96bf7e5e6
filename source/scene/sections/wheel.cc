// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/wheel.h>
#include <tread/scene/sections/wheelset.h>

#include <algorithm>

namespace tread
{
  template <>
  const std::vector<Choice<WheelShape>> &choices()
  {
    static const std::vector<Choice<WheelShape>> list{
      {WheelShape::sector, "sector",
       "a piece of the rim on a rigid hub that has the rest of mass and inertia."},
      {WheelShape::full, "full", "rim, web and hub deform; what the bore holds is rigid."}};
    return list;
  }


  void WheelSection::declare(ParameterTable &table)
  {
    constexpr double tiny = 1e-12; // for "above 0"
    Section          section(table, "Wheel");
    const Need       full("Wheel/Shape", {"full"}),
      sector = Need("Wheel/Shape", {"sector"}).or_else(WheelsetSection::in_a_position());

    section.choose("Shape", shape);
    section.add("Radius (mm)", radius, "Rolling radius of the wheel. It sets the curvature along the rail.",
                Number(10., 2000.));
    section.add("Mass (kg)", mass,
                "Unsprung mass per wheel (wheel, half axle, axle box), whether meshed or not; its weight is "
                "part of the wheel load.",
                Number(tiny));
    section.add(
      "Moment of inertia (kg m2)", moment_of_inertia,
      "Moment of inertia of the unsprung mass about the axle. It matters when a torque drives the wheel.",
      Number(tiny));
    section.needs(sector).add(
      "Sector thickness (mm)", sector_thickness,
      "Radial thickness of a sector; a thicker one is nearer to a half-space. Where 'Wheelset' has a "
      "position: thickness of wheel and rail behind their surfaces, at right angles to the contact.",
      Number(1., 1000.));
    section.needs(sector).add(
      "Sector width (mm)", sector_width,
      "Lateral width of a sector. Where 'Wheelset' has a position: width of wheel and rail along "
      "their surfaces, across the path.",
      Number(1., 1000.));
    section.needs(sector).add(
      "Sector margin (mm)", sector_margin,
      "Length of the arc by which a sector extends beyond the rolled distance at each end.",
      Number(0., 1000.));
    section.needs(full).add(
      "Rim inner radius (mm)", rim_inner_radius,
      "Inner radius of the rim of a full wheel; above the hub's outer radius and below the wheel's radius.",
      Number(1., 2000.));
    section.needs(full).add("Rim width (mm)", rim_width,
                            "Width of the rim of a full wheel; above the thickness of the web.",
                            Number(1., 1000.));
    section.needs(full).add("Web thickness (mm)", web_thickness,
                            "Thickness of the web of a full wheel; below rim width and hub length.",
                            Number(1., 1000.));
    section.needs(full).add("Hub outer radius (mm)", hub_outer_radius,
                            "Outer radius of the hub of a full wheel; above the radius of the bore.",
                            Number(1., 2000.));
    section.needs(full).add(
      "Hub length (mm)", hub_length,
      "Length of the hub of a full wheel along the axle; above the thickness of the web.", Number(1., 1000.));
    section.needs(full).add("Bore radius (mm)", bore_radius,
                            "Radius of the bore of a full wheel, in which the rigid axle sits.",
                            Number(1., 2000.));
    section.add(
      "Tread profile", tread_profile,
      "cylinder, cone 1:40, cone 1:20, S1002 (EN 13715), or a file with a measured one: columns y and z in "
      "mm "
      "(flange at y < 0, z up), .prw of Simpack or .whl of MiniProf. The flange itself is not meshed.",
      AnyText());
    section.add("Tread profile mirrored", profile_placement.is_mirrored,
                "true: the sign of y in the file is reversed.");
    section.add(
      "Tread profile shift (mm)", profile_placement.shift,
      "Added to the file's y, after mirroring: where its y = 0 lies from the running circle, 70 mm from the "
      "back of the flange. A file that counts y from this back needs -70.",
      Number(-200., 200.));
    section.add(
      "Smoothing length (mm)", profile_placement.smoothing,
      "Of the file 'Wheel/Tread profile': a smoothing spline leaves half of waves of this length along the "
      "surface, 6 % of those half as long and 94 % of those twice as long. Instruments need some "
      "millimetres; how far it moves the points is printed. 0: none.",
      Number(0., 50.));
    section.add("Lateral position (mm)", lateral_position,
                "y of the running circle relative to the middle of the rail; the flange lies at y < 0.",
                Number(-30., 30.));
    section.add(
      "Deviation", deviation,
      "What the wheel has beyond round: a scan (.csv with angle_deg or angle_rad, y_mm, dz_mm, or a column "
      "for "
      "each place y; .slcw of CONTACT), 'flat: length_mm=L depth_mm=D across_radius_mm=R angle_deg=A', or "
      "'waves: ORDER=AMPLITUDE_MM@CREST_DEG ...'. Of 'Wheelset/Both wheels' the own one has it. Empty: the "
      "wheel is round.",
      AnyText());
    section.needs(Need::of_fact("Wheel/Deviation", "a file", "scan"))
      .add("Deviation smoothing (mm)", deviation_smoothing,
           "Of a scan: of waves of this length, along and across the tread, half is left. 0: none.",
           Number(0., 100.));
    section.needs({"Wheel/Deviation", {}, "a file or a rule"})
      .add("Deviation pitch (deg)", deviation_pitch,
           "Turn of the deviation about the axle at the start, negative forward. At 0 its angle 0 is at "
           "the bottom; a place at the angle A on the wheel comes to the rail when the wheel has rolled by "
           "its radius times A plus this pitch.",
           Number(-360., 360.));
    material.declare(section);
  }


  bool WheelSection::has_measured_profile() const
  {
    return tread_profile != "cylinder" && tread_profile != "cone 1:40" && tread_profile != "cone 1:20" &&
           tread_profile != "S1002";
  }


  void WheelSection::check() const
  {
    require(
      has_measured_profile() || (!profile_placement.is_mirrored && profile_placement.shift == 0. &&
                                 profile_placement.smoothing == 0.),
      "'Wheel/Tread profile mirrored', 'Tread profile shift (mm)' and 'Smoothing length (mm)' are of a file, "
      "not of 'Wheel/Tread profile' " +
        tread_profile);
    require(is_full() || sector_thickness < radius,
            "'Wheel/Sector thickness (mm)' must be below 'Wheel/Radius (mm)' " + text_in_mm(radius));
    require(!is_full() || (bore_radius < hub_outer_radius && hub_outer_radius < rim_inner_radius &&
                           rim_inner_radius < radius),
            "a full wheel needs 'Wheel/Bore radius (mm)' < 'Hub outer radius (mm)' < 'Rim inner radius (mm)' "
            "< 'Radius (mm)'");
    require(!is_full() || web_thickness < std::min(rim_width, hub_length),
            "'Wheel/Web thickness (mm)' " + text_in_mm(web_thickness) +
              " must be below 'Wheel/Rim width (mm)' " + text_in_mm(rim_width) +
              " and 'Wheel/Hub length (mm)' " + text_in_mm(hub_length));
  }
} // namespace tread
