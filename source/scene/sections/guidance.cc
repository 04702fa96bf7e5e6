// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/guidance.h>

namespace tread
{
  template <>
  const std::vector<Choice<Guidance>> &choices()
  {
    static const std::vector<Choice<Guidance>> list{
      {Guidance::rigid, "rigid", "it keeps its position."},
      {Guidance::file, "file", "it moves as File says."},
      {Guidance::springs, "springs", "it is free on the springs and dampers below."}};
    return list;
  }


  void GuidanceSection::declare(ParameterTable &table)
  {
    Section    section(table, "Guidance");
    const Need on_springs("Guidance/Kind", {"springs"});

    section.choose("Kind", kind,
                   "How a wheelset in a position ('Wheelset') moves across its track and yaws:");
    section.needs({"Guidance/Kind", {"file"}})
      .add("File", file,
           "Table of its motion, separated by commas, with a row of names: time_s from the start of the "
           "run and at least one of lateral_shift_mm, yaw_mrad, roll_mrad and angular_velocity_rad_per_s. "
           "What it has takes the place of the parameter of that name. At least four rows, as long as the "
           "run; in between it is interpolated smoothly and without overshoot.");
    section.needs(on_springs)
      .add("Lateral stiffness (MN per m)", springs.stiffness,
           "Lateral stiffness between the wheelset and a frame that runs along with it; the force "
           "counts from the position at the start.",
           Number(0.));
    section.needs(on_springs)
      .add("Lateral damping (kN s per m)", springs.damping,
           "Damping of the lateral velocity relative to that frame.", Number(0.));
    section.needs(on_springs)
      .add("Lateral force (kN)", springs.force, "balance",
           "Constant lateral force on the wheelset, positive towards the side of the modelled wheel. "
           "balance: the force that holds the wheelset in place at the start.",
           Number());
    section.needs(on_springs)
      .add("Yaw stiffness (MN m per rad)", springs.yaw_stiffness,
           "Yaw stiffness relative to that frame; the moment counts from the yaw at the start.", Number(0.));
    section.needs(on_springs)
      .add("Yaw damping (kN m s per rad)", springs.yaw_damping, "Damping of the yaw rate.", Number(0.));
    section.needs(on_springs)
      .add("Yaw moment (kN m)", springs.moment, "balance",
           "Constant yaw moment on the wheelset. balance: the moment that holds the wheelset in place "
           "at the start.",
           Number());
    section
      .needs(Need("Guidance/Kind", {"springs"}, "springs, or both wheels")
               .or_has("Wheelset/Both wheels", {"true"}))
      .add(
        "Yaw inertia (kg m2)", yaw_inertia,
        "Of the wheelset about the vertical, and about x where both wheels are meshed, without the wheels' "
        "cells. 0: on springs the yaw is held.",
        Number(0.));
  }


  void GuidanceSection::check(const bool has_both_wheels) const
  {
    require(kind == Guidance::file || file.empty(), "'Guidance/File' is read where 'Guidance/Kind' is file");
    require(kind != Guidance::file || !file.empty(), "'Guidance/Kind' file needs 'Guidance/File'");
    const auto of_springs = [&](const bool is_given, const std::string &name) {
      require(kind == Guidance::springs || !is_given,
              "'Guidance/" + name + "' has a meaning where 'Guidance/Kind' is springs");
    };
    of_springs(springs.stiffness != 0., "Lateral stiffness (MN per m)");
    of_springs(springs.damping != 0., "Lateral damping (kN s per m)");
    of_springs(bool(springs.force), "Lateral force (kN)");
    of_springs(springs.yaw_stiffness != 0., "Yaw stiffness (MN m per rad)");
    of_springs(springs.yaw_damping != 0., "Yaw damping (kN m s per rad)");
    of_springs(bool(springs.moment), "Yaw moment (kN m)");
    of_springs(yaw_inertia != 0. && !has_both_wheels, "Yaw inertia (kg m2)");
    require(yaw_inertia > 0. || (springs.yaw_stiffness == 0. && springs.yaw_damping == 0. && !springs.moment),
            "'Guidance/Yaw inertia (kg m2)' must be above 0 for a wheelset that yaws on springs");
  }
} // namespace tread
