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


  void WheelsetSection::declare(ParameterTable &table)
  {
    Section    section(table, "Wheelset");
    const Need gauge_faces("Rail/Shape", {"head", "full section"}, "head");

    section.add("Lateral shift (mm)", shift, "none",
                "Lateral displacement of the wheelset from the middle of the track, positive towards the "
                "side of the modelled wheel (its own side), so that the flange of this wheel approaches its "
                "rail. A number, 0 too, puts the wheel with its flange into the track. none: an upright "
                "wheel over the rail, at 'Wheel/Lateral position (mm)'.",
                Number(-100., 100.));
    section.add("Yaw (mrad)", yaw,
                "Yaw of the wheelset, positive when its leading side turns towards the side of the modelled "
                "wheel, so that this wheel falls behind the other. Up to 5 degrees.",
                Number());
    section.add(
      "Roll (mrad)", roll,
      "Roll of the wheelset, positive when the side of the modelled wheel goes down. Up to 5 degrees.",
      Number());
    // What stands above puts the wheel there.
    section.all_need({in_a_position()});
    section.add("Both wheels", both_wheels,
                "true: both wheels are meshed, on one axle and over both rails. Mass, inertia, load and "
                "suspension of the wheel are then those of each wheel, and the roll follows from both "
                "contacts. false: one wheel is modelled, on its own side of the track.");
    section.add("Axle torsional stiffness (MN m per rad)", axle_torsion, "rigid",
                "Torsional stiffness of the axle between both wheels; twist counts from the start of the "
                "run. rigid: the axle does not twist.",
                Number(0.));
    section.add(
      "Axle bending stiffness (MN m2)", axle_bending, "rigid",
      "Bending stiffness E I of the axle between both wheels; bending counts from the start of the run, so "
      "that the position includes what the static load bends. rigid: the axle does not bend.",
      Number(0.));
    section.add(
      "Axle damping (us)", axle_damping,
      "Damping of a flexible axle over its stiffness: twice the damping ratio over the angular frequency.",
      Number(0., 1e5));
    section.needs(gauge_faces)
      .add("Track gauge (mm)", track.gauge, "Track gauge, between the gauge faces of both rails.",
           Number(500., 3000.));
    section.needs(gauge_faces)
      .add("Gauge depth (mm)", track.measuring_depth,
           "Depth below the rail tops at which the gauge is measured.", Number(1., 30.));
    section.add("Flange-back distance (mm)", track.back_distance,
                "Back-to-back distance of the wheels' flanges.", Number(400., 3000.));
    section.add("Flange back (mm)", track.back_position, "y of the flange's back in the wheel's profile.",
                Number(-200., 0.));
    section.choose("Slip over the patch", slip_over_patch,
                   "Rigid slip over a patch that is wide for its profiles.");
    section.add("Patch distance (mm)", patch_distance,
                "Half-space theory solves overlaps of wheel and rail that are nearer to each other, along "
                "the surface, as one patch in "
                "one plane. Others are patches of their own, which do not deform each other.",
                Number(0., 100.));
  }


  Need WheelsetSection::in_a_position()
  {
    return Need("Wheelset/Lateral shift (mm)", {}, "a number")
      .or_has("Wheelset/Yaw (mrad)", {})
      .or_has("Wheelset/Roll (mrad)", {})
      .or_has("Motion/Angular velocity (rad per s)", {})
      .or_has("Guidance/Kind", {"file"});
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
    require(track.gauge > track.back_distance, "'Wheelset/Track gauge (mm)' " + text_of(1e3 * track.gauge) +
                                                 " must be above 'Flange-back distance (mm)' " +
                                                 text_of(1e3 * track.back_distance) +
                                                 ": both flanges run between the rails");
    require(!both_wheels || roll == 0.,
            "'Wheelset/Roll (mrad)' is found where 'Wheelset/Both wheels' is true");
  }
} // namespace tread
