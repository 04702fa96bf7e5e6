// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/wheelset.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace tread
{
  template <>
  const std::vector<Choice<SlipOverPatch>> &choices()
  {
    static const std::vector<Choice<SlipOverPatch>> list{
      {SlipOverPatch::surface, "surface", "follows the rolling radius of the wheel's profile at each place."},
      {SlipOverPatch::plane, "plane",
       "creepages and spin of the reference point for all of the patch, as planar contact in CONTACT."}};
    return list;
  }


  void WheelsetSection::declare(dealii::ParameterHandler &handler)
  {
    using dealii::Patterns::Double;
    Section section(handler, "Wheelset");

    section.add(
      "Lateral shift (mm)", shift, "none",
      "Of the wheelset from the middle of the track, positive towards the wheel's own side: its flange "
      "then approaches the rail. A number, 0 too, puts the wheel with its flange into the track. none: an "
      "upright wheel over the rail, at 'Wheel/Lateral position (mm)'.",
      Double(-100., 100.));
    section.add(
      "Yaw (mrad)", yaw,
      "Positive when the leading side turns to the own side, so that the own wheel falls back. Up to "
      "5 degrees.",
      Double());
    section.add("Roll (mrad)", roll, "Positive when the own side goes down. Up to 5 degrees.", Double());
    section.add("Both wheels", both_wheels,
                "Mesh both wheels on one axle, over both rails. Mass, inertia, load and suspension of the "
                "wheel are those of each. The roll follows from both contacts. false: the own wheel alone.");
    section.add(
      "Axle torsional stiffness (MN m per rad)", axle_torsion, "rigid",
      "Of the axle between both wheels, which twists from the start on. A number; rigid: it does not.",
      Double(0.));
    section.add(
      "Axle bending stiffness (MN m2)", axle_bending, "rigid",
      "E I of the axle between both wheels, which bends from the start on: what it bears then belongs to the "
      "position. A number; rigid: it does not.",
      Double(0.));
    section.add("Axle damping (us)", axle_damping,
                "Of a flexible axle, over its stiffness: twice the damping ratio over the angular frequency.",
                Double(0., 1e5));
    section.add("Track gauge (mm)", track.gauge, "Between the gauge faces of both rails.",
                Double(500., 3000.));
    section.add("Gauge depth (mm)", track.measuring_depth,
                "Below the rail tops, where the gauge is measured.", Double(1., 30.));
    section.add("Flange-back distance (mm)", track.back_distance, "Between the backs of both flanges.",
                Double(400., 3000.));
    section.add("Flange back (mm)", track.back_position,
                "Where the wheel's profile has the back of its flange.", Double(-200., 0.));
    section.choose("Slip over the patch", slip_over_patch,
                   "Rigid slip over a patch that is wide for its profiles.");
    section.add("Patch distance (mm)", patch_distance,
                "Half-space theory solves overlaps of wheel and rail that are nearer to each other, along "
                "the surface, as one patch in "
                "one plane. Others are patches of their own, which do not deform each other.",
                Double(0., 100.));
  }


  void WheelsetSection::check() const
  {
    constexpr double largest = 5. * dealii::numbers::PI / 180.;
    for (const auto &[name, angle] : {std::pair("Yaw", yaw), std::pair("Roll", roll)})
      require(std::abs(angle) <= largest, "'Wheelset/" + std::string(name) + " (mrad)' " +
                                            text_of(1e3 * angle) + " is more than 5 degrees, " +
                                            text_of(1e3 * largest) + " mrad");
    require(!both_wheels || shift,
            "'Wheelset/Both wheels' needs 'Wheelset/Lateral shift (mm)': a number, 0 too");
    require(both_wheels || !has_flexible_axle(),
            "'Wheelset/Axle torsional stiffness (MN m per rad)' and 'Axle bending stiffness (MN m2)' are of "
            "the axle between two wheels: 'Wheelset/Both wheels' must be true");
    require(
      !(axle_torsion == 0. || axle_bending == 0.),
      "a flexible axle must have some stiffness: 'Wheelset/Axle torsional stiffness (MN m per rad)' and "
      "'Axle bending stiffness (MN m2)' must be above 0");
    require(
      axle_damping == 0. || has_flexible_axle(),
      "'Wheelset/Axle damping (us)' is of a flexible axle: 'Axle torsional stiffness (MN m per rad)' or "
      "'Axle bending stiffness (MN m2)' must be a number");
    require(!both_wheels || roll == 0.,
            "'Wheelset/Roll (mrad)' is found where 'Wheelset/Both wheels' is true");
  }
} // namespace tread
