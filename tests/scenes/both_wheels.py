#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Both wheels of a wheelset on a rigid and on a flexible axle: symmetry, equilibrium with the roll found, the first part of Klingel's wave, ranks,
resuming, and what is refused."""

import importlib.util
import os
import re
import sys
import tempfile

import numpy as np

from tread.files import read_summary
from tread.runs import ROOT, arguments_of, must_end_well
from loaded_once import execute_often
from tread_runner import Check, run, run_stopped, table

program = sys.argv[1]
check = Check()
SCENE = "curves/klingel.prm"
LOAD = 150e3  # N, on each wheel
RADIUS, INERTIA, SPEED = 0.2, 10., 60 / 3.6  # m, kg m2, of each wheel; m/s
TORSION = 3.4  # MN m/rad
HELD = {"Guidance/Kind": "rigid", "Guidance/Lateral force (kN)": "balance", "Guidance/Yaw moment (kN m)": "balance",
        "Motion/Rolled distance (mm)": 10, "Output/Write volume": "false", "Mesh/Fine half width (mm)": 0, "Mesh/Fine layers": 4}


def history_of(folder):
    return {name: np.array(values) for name, values in table(folder, "history.csv").items()}


def klingel():
    """contrib/plot/klingel.py as a module."""
    spec = importlib.util.spec_from_file_location("klingel", os.path.join(ROOT, "contrib/plot/klingel.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def of(patches, wheel):
    return [patch for patch in patches if patch["wheel"] == wheel][0]


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    # Half-space: in the middle both wheels are alike; beside it they carry the load without a moment, and each is the single wheel's
    # answer with that roll under its share of the load.
    half = lambda name, **settings: run(program, SCENE, path(name), {**HELD, **settings}, 1, command="reference")
    middle = half("middle", **{"Wheelset/Lateral shift (mm)": 0})
    own, other = (of(middle["patches"], wheel) for wheel in ("own", "other"))
    check.below("half-space, middle: roll, urad", 1e6 * middle["roll_rad"], 1e-3)
    scales = {"max_pressure_Pa": own["max_pressure_Pa"], "angle_rad": 1.}  # of the others: the load
    for name in ("normal_force_N", "longitudinal_force_N", "lateral_force_N", "max_pressure_Pa", "angle_rad"):
        scale = scales.get(name, LOAD)
        check.absolute(f"half-space, middle: {name} of the other wheel, over its scale", other[name] / scale, own[name] / scale, 1e-6)
    check.absolute("half-space, middle: y of the other wheel, mm", 1e3 * other["y_m"], -1e3 * own["y_m"], 1e-6)
    beside = half("beside", **{"Guidance/Yaw inertia (kg m2)": 0})
    own, other = (of(beside["patches"], wheel) for wheel in ("own", "other"))
    check.relative("half-space, 3 mm: vertical force, kN", 1e-3 * beside["normal_force_N"], 2e-3 * LOAD, 1e-5)
    # The cone's rise and fall over the levers of the contacts on a crowned rail.
    check.relative("half-space, 3 mm: roll, mrad", 1e3 * beside["roll_rad"], -3. * 0.2 / (0.75 - 0.04), 2.5e-3)
    check.that("half-space, 3 mm: the own wheel stands on a larger radius", own["rolling_radius_m"] > other["rolling_radius_m"] + 1e-3)
    vertical = lambda patch: patch["normal_force_N"] * np.cos(patch["angle_rad"]) + patch["lateral_force_N"] * np.sin(patch["angle_rad"])
    alone = half("alone", **{"Wheelset/Both wheels": "false", "Wheelset/Roll (mrad)": 1e3 * beside["roll_rad"],
                             "Guidance/Yaw inertia (kg m2)": 0, "Vehicle/Wheel load (kN)": 1e-3 * vertical(own)})
    for name in ("normal_force_N", "longitudinal_force_N", "lateral_force_N", "spin_moment_Nm", "max_pressure_Pa"):
        check.relative(f"half-space, 3 mm: {name} of one wheel", alone["patches"][0][name], own[name], 1e-4)

    # Finite elements: both rails and both wheels feel the same in the middle; mirrored positions have mirrored answers.
    # A torque turns them faster, and what it gives beyond the forces of friction is their spin (known, but for the inertia of cells whose
    # density is scaled, 0.5 of 20 kg m2).
    traction, hold = 0.1, 2e-3
    summary = run(program, SCENE, path("held"), {**HELD, "Wheelset/Lateral shift (mm)": 0, "Motion/Drive": "torque", "Motion/Traction coefficient": traction,
                                                 "Motion/Hold distance (mm)": 1e3 * hold})
    rows = history_of(path("held"))
    driven = rows["position_m"] - rows["position_m"][0] > hold + 1e-3
    seconds = np.diff(rows["time_s"], prepend=0.)[driven]
    faster = np.diff(rows["creepage"], prepend=0.)[driven].sum() * SPEED / RADIUS  # rad/s
    torque = (rows["longitudinal_force_N"][driven] * seconds).sum() / seconds.sum() * RADIUS + 2. * INERTIA * faster / seconds.sum()
    check.relative("driven: torque by forces and spin, kN m", 1e-3 * torque, 1e-3 * traction * 2. * LOAD * RADIUS, 0.03)
    check.that("driven: it turns faster than it rolls", rows["creepage"][-1] > 1e-5 and rows["longitudinal_force_N"][-1] > 0.)
    own, other = (of(summary["patches"], wheel) for wheel in ("own", "other"))
    for name in ("normal_force_N", "max_pressure_Pa", "area_m2", "length_m"):
        check.relative(f"middle: {name} of the other wheel", other[name], own[name], 1e-6)
    check.that("the yaw inertia that lets both wheels roll is not called useless", not any("Yaw inertia" in text for text in summary["unused_parameters"]))
    check.relative("middle: vertical force, kN", 1e-3 * summary["normal_force_N"], 2e-3 * LOAD, 5e-3)
    check.relative("middle: largest pressure beside the half-space's, MPa", 1e-6 * own["max_pressure_Pa"],
                   1e-6 * of(summary["half_space_patches"], "own")["max_pressure_Pa"], 0.03)
    check.absolute("middle: lateral force of both, share of the load", summary["lateral_force_N"] / LOAD, 0., 1e-6)
    sides = {}
    for shift in (2, -2):
        name = f"shift{shift}"
        sides[shift] = run(program, SCENE, path(name), {**HELD, "Wheelset/Lateral shift (mm)": shift})
        rows = history_of(path(name))
        both = rows["normal_force_N"][-1], rows["other_normal_force_N"][-1]
        check.that(f"{shift} mm: the forces of both wheels in the history", 0.4 < both[1] / both[0] < 0.6)
    for name in ("normal_force_N", "longitudinal_force_N", "lateral_force_N", "max_pressure_Pa"):
        check.relative(f"2 mm: {name} of the own wheel is the other's at -2 mm", of(sides[2]["patches"], "own")[name],
                       of(sides[-2]["patches"], "other")[name], 2e-5)  # the tolerance of the sweeps, and where the axle settles by it
    check.absolute("2 mm: roll, urad, and at -2 mm", 1e6 * sides[2]["roll_rad"], -1e6 * sides[-2]["roll_rad"], 1e-3)
    for wheel in ("own", "other"):
        computed, reference = (of(sides[2][name], wheel) for name in ("patches", "half_space_patches"))
        check.relative(f"2 mm: normal force of the {wheel} wheel beside the half-space's, kN", 1e-3 * computed["normal_force_N"],
                       1e-3 * reference["normal_force_N"], 0.01)
        check.absolute(f"2 mm: longitudinal force of the {wheel} wheel beside the half-space's, share of the load",
                       computed["longitudinal_force_N"] / LOAD, reference["longitudinal_force_N"] / LOAD, 0.01)

    # Free: the difference of the rolling radii turns the wheelset, and its yaw leads the contacts, which move across more than the axle.
    free = {"Motion/Rolled distance (mm)": 120, "Output/Write volume": "false", "Output/History interval (mm)": 2}
    waved = run(program, SCENE, path("free"), free)
    rows = history_of(path("free"))
    x = rows["position_m"] - rows["position_m"][0]
    settled = x > 0.05
    shift = np.mean(rows["lateral_shift_m"][settled])
    wanted = {name: -1e3 * shift * (2. * np.pi / length) ** 2 for name, length in klingel().wavelengths().items()}
    check.relative("free: yaw for each metre, mrad", 1e3 * np.polyfit(x[settled], rows["yaw_rad"][settled], 1)[0], wanted["crowned rails"], 0.01)
    check.relative("free: curvature of the path, 1e-3/m", 2e3 * np.polyfit(x[settled], rows["lateral_shift_m"][settled], 2)[0], wanted["with roll"], 0.02)
    check.energy("free: ", waved, 0.02)
    # No guidance: what the rails do to the wheelset across is its momentum.
    check.below("free: guidance force, N", np.abs(rows["guidance_force_N"]).max(), 1e-9)

    # Ranks and resuming, on an axle of steel of 160 mm.
    short = {**free, "Motion/Rolled distance (mm)": 20}
    axle = lambda factor: {"Wheelset/Axle torsional stiffness (MN m per rad)": TORSION * factor, "Wheelset/Axle bending stiffness (MN m2)": 6.6 * factor}
    for name, settings in (("rigid", {}), ("stiff", axle(300))):
        run(program, SCENE, path(name), {**short, **settings})
    rigid, stiff = history_of(path("rigid")), history_of(path("stiff"))
    short |= axle(1)
    bent = run(program, SCENE, path("bent"), short)
    one = history_of(path("bent"))
    # What ranks and a checkpoint change they change at once.
    parts = {**short, "Motion/Rolled distance (mm)": 2, "Output/History interval (mm)": 0.1}
    for ranks in (1, 3):
        run(program, SCENE, path(f"ranks{ranks}"), parts, ranks)
    whole, three = history_of(path("ranks1")), history_of(path("ranks3"))
    # The lateral shift grows with the square of the way.
    for name, scale in (("lateral_shift_m", 1e-8), ("yaw_rad", 2.4e-7), ("roll_rad", 1e-5), ("other_normal_force_N", LOAD)):
        check.below(f"3 ranks: {name}", np.abs(whole[name] - three[name]).max() / scale, 1e-5)
    check.energy("flexible axle: ", bent, 0.02)
    # The drive turns each wheel about its own axle, which a yaw that lasts tilts by half a milliradian: its work is 0.8 % of what is dissipated.
    leaning = run(program, SCENE, path("leaning"), {**short, "Wheelset/Lateral shift (mm)": -4, "Wheelset/Yaw (mrad)": 6, "Rail/Margin (mm)": 30,
                                                    "Wheel/Sector margin (mm)": 30, "Wheelset/Axle bending stiffness (MN m2)": 2})
    check.energy("soft axle of a yawed wheelset: ", leaning, 4e-3)
    # Pushed to where its flange stands beside the rail's profile.
    shown = must_end_well(execute_often(arguments_of(SCENE, {**free, "Motion/Rolled distance (mm)": 40, "Guidance/Lateral force (kN)": 800,
                                                             "Mesh/Fine half width (mm)": 17, "Wheel/Sector width (mm)": 44}, path("pushed")), program)).stdout
    pushed = read_summary(path("pushed"))
    for words, name, scale in (("vertical force, kN", "normal_force_N", 1e-3), ("longitudinal force, kN", "longitudinal_force_N", 1e-3),
                               ("lateral force in the track, kN", "lateral_force_N", 1e-3), ("frictional power, W", "frictional_power_W", 1.)):
        # The last line with these words: the others are those of patches.
        figure = float(re.findall(rf"^{words} +(\S+)", shown, re.MULTILINE)[-1])
        check.relative(f"no half-space answer beside a run: {words} on the screen", figure, scale * pushed[name], 1e-3)
    check.that("no half-space answer beside a run: it ends, and says so",
               pushed["completed"] and "half_space_patches" not in pushed and any("no half-space answer" in warning for warning in pushed["warnings"]))
    for name in ("lateral_shift_m", "yaw_rad", "other_normal_force_N", "other_longitudinal_force_N"):
        # The inertia of wheels that turn by themselves delays how the axle settles.
        check.below(f"300 times as stiff: {name} beside a rigid axle's, share of the difference of steel",
                    np.abs(stiff[name] - rigid[name]).max() / np.abs(one[name] - rigid[name]).max(), 0.25 if name == "other_normal_force_N" else 0.05)
    # Two discs on a shaft under the couple of the longitudinal forces that came since the start, of which rows have the means; the
    # scaled mass of the cells makes the wheels some per cent slower.
    couple = RADIUS * (2 * one["other_longitudinal_force_N"] - one["longitudinal_force_N"])
    held, time, twist, rate = 1.5 * couple[0] - 0.5 * couple[1], np.append(0., one["time_s"]), 0., 0.
    for moment, begin, end in zip(couple, time, time[1:]):
        for step in np.full(100, (end - begin) / 100):
            rate += step * (moment - held - 2e6 * TORSION * twist) / INERTIA
            twist += step * rate
    check.relative("twist of the axle beside that of two discs on a shaft, mrad", 1e3 * one["axle_twist_rad"][-1], 1e3 * twist, 0.1)
    # Creepages differ by the rolling radii, by the yaw and by the twist.
    def differ(summary, rows):
        patches, late = [of(summary["patches"], wheel) for wheel in ("own", "other")], rows["time_s"] > 0.7 * rows["time_s"][-1]
        own, other = ([patch[name] for name in ("rolling_radius_m", "y_m", "creepage")] for patch in patches)
        rate = lambda name: np.polyfit(rows["time_s"][late], rows[name][late], 1)[0]
        radius, across, creepage = np.subtract(own, other)
        return creepage, radius / RADIUS + (rate("yaw_rad") * across + rate("axle_twist_rad") * RADIUS) / SPEED

    found, wanted = differ(bent, one)
    check.absolute("flexible axle: difference of the creepages, 1e-3", 1e3 * found, 1e3 * wanted, 0.4)
    settled = run(program, SCENE, path("settled"), {**free, "Motion/Rolled distance (mm)": 60, "Wheelset/Axle torsional stiffness (MN m per rad)": TORSION})
    found, wanted = differ(settled, history_of(path("settled")))
    check.absolute("axle that twists: difference of the creepages, 1e-3", 1e3 * found, 1e3 * wanted, 0.4)
    power = lambda patches: sum(patch["frictional_power_W"] for patch in settled[patches])
    check.relative("axle that twists: frictional power beside the half-space's, W", power("patches"), power("half_space_patches"), 0.07)  # coarse cells, large spin: -5 %
    check.that("wheels roll and yaw on the bent axle", min(np.abs(one[f"{wheel}_wheel_{way}_rad"]).max() for wheel in ("own", "other") for way in ("roll", "yaw")) > 4e-6)
    run_stopped(program, SCENE, path("stopped"), parts, 3)
    check.that("Ctrl-C: not complete", read_summary(path("stopped"))["completed"] is False)
    run(program, SCENE, path("stopped"), parts, 1, ["--resume"])
    resumed = history_of(path("stopped"))
    for name in ("lateral_shift_m", "yaw_rad", "roll_rad", "other_normal_force_N", "external_work_J", "axle_twist_rad", "own_wheel_roll_rad"):
        check.that(f"resumed: {name} has the same bits", np.array_equal(resumed[name], whole[name]))

    def must_fail(name, settings, *words):
        check.refused(name, program, SCENE, path("bad"), {**HELD, **settings}, words)

    must_fail("a roll", {"Wheelset/Roll (mrad)": 1}, "Wheelset/Roll (mrad)", "Both wheels")
    must_fail("no inertia", {"Guidance/Yaw inertia (kg m2)": 0}, "Guidance/Yaw inertia (kg m2)", "Both wheels")
    must_fail("a flexible axle of one wheel", {**axle(1), "Wheelset/Both wheels": "false", "Guidance/Yaw inertia (kg m2)": 0}, "Axle torsional stiffness", "Both wheels")
    must_fail("an axle that swings within a step", {**axle(1e6), "Wheelset/Lateral shift (mm)": 0}, "Axle torsional stiffness", "which no axle does")
    must_fail("a torque on a flexible axle", {**axle(1), "Motion/Drive": "torque", "Motion/Traction coefficient": traction, "Motion/Hold distance (mm)": 2}, "Motion/Drive", "flexible axle")
    must_fail("a wheelset lighter than its wheels", {**axle(1), "Guidance/Yaw inertia (kg m2)": 8}, "Yaw inertia", "diameters")
    must_fail("no stiffness", axle(0), "must be above 0")
    must_fail("a fine zone that does not fit", {"Mesh/Fine half width (mm)": 17}, "too small for its fine zone", "Mesh/Fine half width (mm)", "Wheel/Sector width (mm)")
    must_fail("a track for one wheel", {"Track/Foundation": "co-running"}, "co-running is for one wheel", "Both wheels")
    must_fail("no position", {"Wheelset/Lateral shift (mm)": "none"}, "Wheelset/Lateral shift (mm)")
    must_fail("more than the wheel's circumference", {"Motion/Rolled distance (mm)": 1200}, "Rolled distance", "circumference")
    must_fail("a wheelset between the rails", {"Wheelset/Lateral shift (mm)": 80}, "no half-space answer", "roll that is found")
    with open(path("roll.csv"), "w", encoding="utf-8") as file:
        file.write("time_s,roll_mrad\n" + "".join(f"{0.01 * k},0.1\n" for k in range(9)))
    must_fail("a roll over time", {"Guidance/Kind": "file", "Guidance/File": path("roll.csv")}, "roll_mrad", "Both wheels")

check.exit()
