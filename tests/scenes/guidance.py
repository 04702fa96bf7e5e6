#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheelset that moves across its track: as a table says, or free on springs; ranks, resuming, and what is refused."""

import os
import sys
import tempfile

import numpy as np

from tread.files import read_summary
from tread.runs import ROOT, arguments_of
from loaded_once import execute_often
from tread_runner import Check, run, run_stopped, table

program = sys.argv[1]
check = Check()
SCENE = "curves/manchester-a22-right.prm"
SPEED = 140 / 3.6  # m/s
DISTANCE = 0.025  # m, rolled
# Cells of an eighth of the patch's length; the axle turns as on tangent track.
COARSE = {"Mesh/Finest cell (mm)": 0.63, "Scene/Density scale": 25, "Motion/Speed (km per h)": 140, "Motion/Angular velocity (rad per s)": 84.4,
          "Motion/Rolled distance (mm)": 1e3 * DISTANCE, "Solid/Mass damping (1 per s)": 3000, "Time stepping/Levels": 2,
          "Output/Write volume": "false", "Wheelset/Lateral shift (mm)": 0}
COARSER = {**COARSE, "Mesh/Finest cell (mm)": 0.84}  # where runs of one mesh are compared with each other


def write_motion(file, columns):
    """A row for each entry of the columns, by their names."""
    with open(file, "w", encoding="utf-8") as stream:
        stream.write(",".join(columns) + "\n")
        for row in zip(*columns.values()):
            stream.write(",".join("%.12g" % value for value in row) + "\n")
    return {"Guidance/Kind": "file", "Guidance/File": file}


def history_of(folder):
    return {name: np.array(values) for name, values in table(folder, "history.csv").items()}


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    # Moved sideways at a thousandth of the speed, to the middle of the track: the slip of a wheel that slides there at that creepage.
    time = np.linspace(0., 1.2 * DISTANCE / SPEED, 9)
    ramp = write_motion(path("ramp.csv"), {"time_s": time, "lateral_shift_mm": SPEED * time - 1e3 * 1e-3 * DISTANCE})
    moved = run(program, SCENE, path("moved"), {**COARSE, **ramp})
    slid = run(program, SCENE, path("slid"), {**COARSE, "Motion/Lateral creepage": 0.001})
    share = lambda summary, name: summary[f"{name}_force_N"] / summary["normal_force_N"]
    for name in ("longitudinal", "lateral"):
        check.absolute(f"moved sideways: {name} over vertical force", share(moved, name), share(slid, name), 2e-3)
    check.relative("moved sideways: vertical force, kN", 1e-3 * moved["normal_force_N"], 10., 0.02)
    check.energy("moved sideways: ", moved, 2e-3)
    check.absolute("moved sideways: lateral creepage of the half-space beside it", moved["half_space_patches"][0]["lateral_creepage"],
                   slid["half_space_patches"][0]["lateral_creepage"], 2e-5)
    still = run(program, SCENE, path("still"), {**COARSER, "Motion/Rolled distance (mm)": 4})
    check.that("without motion the lateral force is another", abs(share(still, "lateral") - share(slid, "lateral")) > 0.1)
    # A table in which nothing moves, and free rolling beside it: the half-space rolls as beside a wheel that is held.
    constant = write_motion(path("constant.csv"), {"time_s": time, "lateral_shift_mm": 0. * time})
    constant = run(program, SCENE, path("constant"), {**COARSER, **constant, "Motion/Rolled distance (mm)": 4})
    for name in ("creepage", "longitudinal_force_N", "lateral_force_N"):
        check.relative(f"a table that stands still: {name} of the half-space beside it", constant["half_space_patches"][0][name],
                       still["half_space_patches"][0][name], 1e-6)
    check.relative("a table that stands still: angular velocity, rad/s", constant["angular_velocity_rad_per_s"], 84.4, 1e-9)

    # Friction that falls with slip, or with pressure, or on a spot of the rail, beside the half-space's with the same; each is far from Coulomb's.
    sliding = {**COARSE, "Motion/Lateral creepage": 0.005, "Motion/Rolled distance (mm)": 16}
    coulomb = run(program, SCENE, path("coulomb"), sliding, 1, command="reference")
    for what, settings in (("falling", {"Contact/Friction law": "falling", "Contact/Kinetic friction coefficient": 0.1, "Contact/Falling slip speed (m per s)": 0.1,
                                        "Contact/Friction memory (mm)": 0.03}),
                           ("with pressure", {"Contact/Friction pressures (MPa)": "0, 700", "Contact/Friction pressure factors": "1, 0.3"}),
                           ("on a spot", {"Contact/Friction places (mm)": "-9, -8", "Contact/Friction factors": "1, 0.5"})):
        summary = run(program, SCENE, path("friction"), {**sliding, **settings})
        computed, beside = summary["patches"][0], summary["half_space_patches"][0]
        for direction in ("longitudinal", "lateral"):
            check.absolute(f"friction {what}: {direction} over normal force", share(computed, direction), share(beside, direction), 4e-3)
        check.that(f"friction {what}: not Coulomb's", abs(share(beside, "lateral")) < 0.9 * abs(share(coulomb["patches"][0], "lateral")))

    history = history_of(path("moved"))
    check.below("moved sideways: largest miss of the table, um",
                1e6 * np.abs(history["lateral_shift_m"] - (1e-3 * SPEED * history["time_s"] - 1e-3 * DISTANCE)).max(), 1e-6)
    # What moves steadily is in balance; the sector of the wheel swings on its hub.
    steady = history["position_m"] > -0.5 * DISTANCE
    check.relative("moved sideways: guidance against contact, N", history["guidance_force_N"][steady].mean(),
                   -history["lateral_force_N"][steady].mean(), 6e-3)
    check.that("a wheel that keeps its place has no such columns", "lateral_shift_m" not in history_of(path("still")))

    # Yaw, roll and angular velocity: all that the table has arrives at its end where the same position is solved.
    end = {"lateral_shift_mm": 0.02, "yaw_mrad": 0.01, "roll_mrad": 0.0005}
    at_end = DISTANCE / SPEED
    turned = write_motion(path("turn.csv"), {"time_s": time, **{name: value * time / at_end for name, value in end.items()},
                                             "angular_velocity_rad_per_s": 84.4 + 0.02 * time / at_end})
    both = {**COARSE, **turned, "Motion/Angular velocity (rad per s)": "by the drive"}
    turning = run(program, SCENE, path("turning"), both)
    rows = history_of(path("turning"))
    check.relative("turning: yaw at the end, mrad", 1e3 * np.interp(0., rows["position_m"], rows["yaw_rad"]), 0.01, 0.01)
    for key in ("longitudinal_force_N", "lateral_force_N"):
        check.absolute(f"turning: {key} beside the half-space, over the load", np.interp(0., rows["position_m"], rows[key]) / 1e4,
                       turning["reference"][key]["half-space"]["value"] / 1e4, 0.01)
    check.energy("turning: ", turning, 2e-3)

    # A roll that lifts the wheel off the rail.
    flown = run(program, SCENE, path("flown"), {**COARSER, "Motion/Rolled distance (mm)": 20, **write_motion(path("lift.csv"), {"time_s": time, "roll_mrad": np.minimum(0., 0.6 * (time[2] - time) / time[1])})})
    check.that("a wheel that leaves the rail is told", any("has left it" in warning for warning in flown["warnings"]))

    # Free: held in its place by what it finds at the start, and moved by a force of its own.
    free = {"Guidance/Kind": "springs", "Guidance/Lateral stiffness (MN per m)": 5, "Guidance/Yaw inertia (kg m2)": 600,
            "Guidance/Yaw stiffness (MN m per rad)": 5}
    run(program, SCENE, path("free"), {**COARSE, **free})
    history = history_of(path("free"))
    check.below("free: moves by, um", 1e6 * np.abs(history["lateral_shift_m"]).max(), 0.01)
    check.absolute("free: guidance and contact are in balance, share of the load", (history["guidance_force_N"] + history["lateral_force_N"]).mean() / 1e4,
                   0., 3e-3)
    pushed = run(program, SCENE, path("pushed"), {**COARSE, **free, "Guidance/Lateral force (kN)": 10})
    history = history_of(path("pushed"))
    interval = np.diff(history["time_s"], prepend=0.)
    momentum = np.cumsum(interval * (history["guidance_force_N"] + history["lateral_force_N"]))
    moved_by = np.cumsum(interval * (momentum - 0.5 * interval * (history["guidance_force_N"] + history["lateral_force_N"])))
    mass = moved_by[-1] / history["lateral_shift_m"][-1]
    # 900 kg and what density scaling adds to the meshed sector.
    check.that(f"pushed: momentum is that of a wheel of {mass:.0f} kg", 880. < mass < 1250.)
    check.energy("pushed: ", pushed, 3e-3)

    # Ranks, and a run in two parts.
    short = {**COARSER, **turned, "Motion/Angular velocity (rad per s)": "by the drive", "Motion/Rolled distance (mm)": 5, "Contact/Tolerance": 1e-12,
             "Output/Checkpoint interval (minutes)": 0, "Output/History interval (mm)": 0.2, "Time stepping/Levels": 1}
    keys = ("normal_force_N", "longitudinal_force_N", "lateral_force_N", "frictional_power_W", "max_pressure_Pa")
    whole, on_three = run(program, SCENE, path("whole"), short), run(program, SCENE, path("three"), short, 3)
    for key in keys:
        check.relative(f"3 ranks against 1: {key}", on_three[key], whole[key], 1e-7)
    run_stopped(program, SCENE, path("parts"), short, 6)
    check.that("Ctrl-C: not complete", read_summary(path("parts"))["completed"] is False)
    with open(short["Guidance/File"], encoding="utf-8") as file:
        as_it_was = file.read()
    names, *rows = as_it_was.splitlines()
    when, where = rows[-1].split(",", 1)
    with open(short["Guidance/File"], "w", encoding="utf-8") as file:
        file.write("\n".join([names, *rows, f"{1.01 * float(when):.12g},{where}"]) + "\n")
    check.refused("resumed with another table", program, SCENE, path("parts"), short, ("contents of 'Guidance/File'",), more=["--resume"])
    with open(short["Guidance/File"], "w", encoding="utf-8") as file:
        file.write(as_it_was)
    resumed = run(program, SCENE, path("parts"), short, more=["--resume"])
    for key in keys:
        check.relative(f"resumed against never stopped: {key}", resumed[key], whole[key], 1e-12)

    # What cannot be.
    def must_fail(what, settings, *words):
        check.refused(what, program, SCENE, path("bad"), {**COARSE, **settings}, words)

    def with_rows(name, times, **columns):
        return write_motion(path(name), {"time_s": times, **(columns or {"lateral_shift_mm": np.zeros(len(times))})})

    must_fail("a file without its kind", {"Guidance/File": path("ramp.csv")}, "Guidance/File", "Guidance/Kind")
    must_fail("a kind without its file", {"Guidance/Kind": "file"}, "Guidance/File")
    must_fail("no such file", {"Guidance/Kind": "file", "Guidance/File": "none.csv"}, "Guidance/File", "none.csv")
    must_fail("stiffness that nothing uses", {"Guidance/Lateral stiffness (MN per m)": 1}, "Guidance/Lateral stiffness (MN per m)", "springs")
    must_fail("yaw without inertia", {"Guidance/Kind": "springs", "Guidance/Yaw stiffness (MN m per rad)": 1}, "Guidance/Yaw inertia (kg m2)")
    must_fail("a table that is too short", with_rows("short.csv", time / 2), "Guidance/File", "ends at")
    must_fail("a table that begins late", with_rows("late.csv", time + 1e-4), "Guidance/File", "begins at")
    must_fail("three rows", with_rows("three.csv", time[[0, 4, 8]]), "Guidance/File", "four")
    must_fail("time that goes back", with_rows("back.csv", time[[0, 1, 3, 2, 4, 5, 8]]), "row 4", "does not follow")
    must_fail("a gap", with_rows("gap.csv", np.concatenate([time[0] + 1e-6 * np.arange(30), time[3:]])), "row 31", "gap")
    must_fail("a value that is none", with_rows("nan.csv", time, lateral_shift_mm=[0., float("nan")] + [0.] * 7), "row 2", "lateral_shift_mm", "nan")
    must_fail("an unknown column", with_rows("name.csv", time, yaw_rad=np.zeros(9)), "Guidance/File", "yaw_rad", "yaw_mrad")
    must_fail("time alone", write_motion(path("time.csv"), {"time_s": time}), "Guidance/File", "time_s")
    must_fail("more than 5 degrees", with_rows("far.csv", time, yaw_mrad=np.linspace(0., 120., 9)), "Guidance/File", "after the start", "Wheelset/Yaw (mrad)", "5 degrees")
    must_fail("a table beside the track", with_rows("beside.csv", time, lateral_shift_mm=np.full(9, 600.)), "Wheelset/Lateral shift (mm)", "600")
    must_fail("a damper that acts within a step", {**free, "Guidance/Lateral damping (kN s per m)": 1e9}, "Guidance/Lateral stiffness (MN per m)", "which no guidance does")
    must_fail("the profile of a rail on the wheel", {"Wheel/Tread profile": os.path.join(ROOT, "prm", "curves", "profiles", "crown-1-5.txt")},
              "Wheel/Tread profile", "there is no flange")
    must_fail("sideways too fast", with_rows("fast.csv", time, lateral_shift_mm=np.linspace(0., 60., 9)), "Guidance/File", "sideways", "at most 0.2")
    for speed in (1., 3.):
        hurried = with_rows("hurried.csv", time, lateral_shift_mm=1e3 * speed * (time - time[4]))
        said = execute_often([*arguments_of(SCENE, {**COARSE, **hurried}), "--dry-run"], program).stdout
        check.that(f"{speed:g} m/s across the track: a warning from 2 m/s on", (f"across the track with up to {speed:g} m/s" in said) == (speed > 2.))
    must_fail("beyond the rail's head", {"Wheelset/Lateral shift (mm)": -66, **with_rows("beyond.csv", time, lateral_shift_mm=np.linspace(-66., -71., 9))}, "Lateral shift (mm)' -66", "other wheel", "no wheelset stands there")
    must_fail("a wheel that turns backwards", {**with_rows("turns.csv", time, angular_velocity_rad_per_s=np.linspace(84., -84., 9)), "Motion/Angular velocity (rad per s)": "by the drive"},
              "Guidance/File", "backwards")
    must_fail("a column twice", with_rows("twice.csv", time, lateral_shift_mm=np.zeros(9), **{"lateral_shift_mm ": np.zeros(9)}), "Guidance/File", "lateral_shift_mm")
    must_fail("two angular velocities", with_rows("two.csv", time, angular_velocity_rad_per_s=np.full(9, 84.4)), "Motion/Angular velocity (rad per s)")
    upright = execute_often([os.path.join(ROOT, "prm", "smooth-rolling.prm"), "--dry-run", "-s", "Guidance/Kind=springs"], program)
    check.that("an upright wheel on springs", upright.returncode == 1 and "Guidance/Kind" in upright.stderr and "Wheelset/Lateral shift (mm)" in upright.stderr)

check.exit()
