// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/motion.h>

#include <string>

namespace tread
{
  template <>
  const std::vector<Choice<Drive>> &choices()
  {
    static const std::vector<Choice<Drive>> list{
      {Drive::creepage, "creepage", "the angular velocity is kept."},
      {Drive::torque, "torque",
       "a torque of traction coefficient x load x radius acts on the axle, after Hold distance at the "
       "creepage below."},
      {Drive::angular_velocity, "angular velocity",
       "the angular velocity below is kept, by a wheelset in a given position ('Wheelset')."}};
    return list;
  }


  void MotionSection::declare(ParameterTable &table)
  {
    constexpr double tiny = 1e-12; // for "above 0"
    Section          section(table, "Motion");
    const Need       by_torque("Motion/Drive", {"torque"});

    section.add("Speed (km per h)", speed, "Speed of the wheel's centre, constant along x. At least 0.1.",
                Number(0., 1000.));
    section.add("Start (mm)", start, "automatic",
                "x of the wheel at the start. automatic: minus the rolled distance, so that the solution "
                "instant is at x = 0. A number "
                "keeps the wheel, the rail with its supports and a defect in their places when the rolled "
                "distance is changed.",
                Number(-1e5, 1e5));
    section.add(
      "Rolled distance (mm)", rolled_distance,
      "From the start to the solution instant; the run ends half a finest cell after it, over which the "
      "patch is averaged. The tangential solution needs one and a half to two patch lengths to become "
      "steady, and three to four if 'Start/Tractions' is none.",
      Number(tiny, 10000.));
    section.add(
      "Longest distance (mm)", longest_distance,
      "The rail and the wheel are meshed for so much way, so that --resume may go on from the end of "
      "a run with a longer rolled distance; an automatic start is minus this distance then. 0: for "
      "the rolled distance alone.",
      Number(0., 10000.));
    section.choose("Drive", drive);
    section.needs(Need::of_fact("Motion/Creepage", "predicted", "traction").or_else(by_torque))
      .add("Traction coefficient", traction_coefficient,
           "Longitudinal over normal force, positive when driving. Below the friction coefficient.",
           Number(-2., 2.));
    section.add(
      "Creepage", creepage, "predicted",
      "(angular velocity x radius - speed) / speed, counted from free rolling, positive when "
      "driving; or 'predicted': what "
      "half-space theory gives for the traction coefficient. Where 'Wheelset' has a position the radius is "
      "'Wheel/Radius (mm)', which the wheel may roll on nowhere, and the creepage counts from zero: that "
      "at each patch is in the table of patches.",
      Number(-0.2, 0.2));
    section.add(
      "Lateral creepage", lateral_creepage,
      "Lateral velocity of the wheel relative to the rail / speed, towards +y. The axle stays upright and on "
      "its line: the surfaces slide over each other as if it did not (CONTACT's module 3). Where 'Wheelset' "
      "has a position: "
      "of the wheelset to its own side, in that position, besides what follows from it.",
      Number(-0.2, 0.2));
    section.add(
      "Spin (1 per m)", spin,
      "Angular velocity of the wheel relative to the rail about z (upwards) / speed, imposed likewise: under "
      "the middle of the wheel it slides by nothing, ahead of it towards +y if positive. The spin of a "
      "tapered tread comes by itself.",
      Number(-10., 10.));
    section.needs(by_torque).add(
      "Hold distance (mm)", hold_distance,
      "Distance that is rolled at the prescribed creepage before the torque acts, which saves a long run-in.",
      Number(0., 10000.));
    section.add(
      "Angular velocity (rad per s)", angular_velocity, "by the drive",
      "Of the wheel about its axle, positive rolling forward, for a wheelset in a given position "
      "('Wheelset'). A number selects the drive angular velocity and puts the wheel into the track.",
      Number(0., 1e5));
    section.add("Passages", passages,
                "Number of wheel passes: new wheels that roll over the same rail one after the other, while "
                "the rail keeps its stress and strain. Above 1, passages.csv has a row for each pass. The "
                "cost grows in proportion.",
                WholeNumber(1, 10000));
  }


  void MotionSection::check() const
  {
    require(longest_distance == 0. || longest_distance >= rolled_distance,
            "'Motion/Longest distance (mm)' " + text_in_mm(longest_distance) +
              " must be at least 'Motion/Rolled distance (mm)' " + text_in_mm(rolled_distance) + ", or 0");
    require(longest_distance == 0. || passages == 1,
            "'Motion/Longest distance (mm)' is for one passage; each of 'Motion/Passages' has the same way");
    require(speed >= 0.1 / 3.6,
            "'Motion/Speed (km per h)' must be at least 0.1: a wheel that stands does not roll" +
              std::string(drive == Drive::torque ? ", and a torque would only spin it" : ""));
    require(drive != Drive::angular_velocity || angular_velocity,
            "'Motion/Drive' angular velocity needs a number for 'Motion/Angular velocity (rad per s)'");
    require(drive != Drive::torque || !angular_velocity,
            "'Motion/Angular velocity (rad per s)' and 'Motion/Drive' torque exclude each other");
    require(drive != Drive::torque || hold_distance < rolled_distance,
            "'Motion/Hold distance (mm)' must be below 'Motion/Rolled distance (mm)' " +
              text_in_mm(rolled_distance));
  }
} // namespace tread
