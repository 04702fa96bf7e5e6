#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheelset in any position, meshed and rolled: tread, root of the flange, neighbouring patches, a conformal one; ranks, resuming,
yielding, and what is refused."""

import math
import os
import subprocess
import sys
import tempfile

from tread.files import read_summary, read_table
from tread.manchester import positions, roll
from tread.patches import Patch
from tread.runs import ROOT, command, environment
from tread.subsurface import HalfSpace, von_mises
from loaded_once import execute_often
from tread_runner import Check, press_ctrl_c, rows_of, run, script

program = sys.argv[1]
check = Check()
ROOT_OF_FLANGE = "curves/flange-root.prm"
QUIET = {"Output/Write volume": "false"}


def beside_half_space(name, summary, normal, tangential, pressure):
    """Forces in contact axes and the largest pressure against the half-space's; forces along the surface over their resultant."""
    own, other = summary["patches"][0], summary["half_space_patches"][0]
    check.relative(f"{name}: normal force, N", own["normal_force_N"], other["normal_force_N"], normal)
    resultant = math.hypot(other["longitudinal_force_N"], other["lateral_force_N"])
    for key in ("longitudinal", "lateral"):
        check.absolute(f"{name}: {key} force over that along the surface", own[f"{key}_force_N"] / resultant,
                       other[f"{key}_force_N"] / resultant, tangential)
    check.relative(f"{name}: largest pressure, MPa", 1e-6 * own["max_pressure_Pa"], 1e-6 * other["max_pressure_Pa"], pressure)


def force_in_track(summary):
    """Sum over the patches by their angles: lateral and vertical, N."""
    lateral = vertical = 0.
    for patch in summary["patches"]:
        c, s = math.cos(patch["angle_rad"]), math.sin(patch["angle_rad"])
        lateral += c * patch["lateral_force_N"] - s * patch["normal_force_N"]
        vertical += s * patch["lateral_force_N"] + c * patch["normal_force_N"]
    return lateral, vertical


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    # About half as much again as was found (doc/kinematics.md).
    settings = next(settings for side, shift, settings, _ in positions() if (side, shift) == ("left", 4))
    tread = roll(settings, 0.63, program=program)
    beside_half_space("tread", tread, 0.004, 0.004, 0.005)
    check.energy("tread: ", tread, 0.006)

    # The patch rolls 7.4 mm behind the axle.
    PEAKS = {"Peak stress/Region": "range", "Peak stress/From (mm)": -13, "Peak stress/To (mm)": -11, "Peak stress/Depth (mm)": 3}
    one = run(program, ROOT_OF_FLANGE, path("1"), {**QUIET, **PEAKS, "Motion/Rolled distance (mm)": 14, "Output/Cells": "-12,-35.4,1"})
    beside_half_space("flange root", one, 0.002, 0.006, 0.0125)
    check.energy("flange root: ", one, 1e-3)
    lateral, vertical = force_in_track(one)
    # The normal turns inside the patch: its middle one stands for all of them as a plane would.
    check.absolute("flange root: lateral force in the track by the patch's axes over the vertical", lateral / vertical,
                   one["lateral_force_N"] / one["normal_force_N"], 3e-3)
    check.relative("flange root: vertical force in the track by the patch's axes", vertical, one["normal_force_N"], 2e-3)
    check.relative("flange root: vertical force, kN", 1e-3 * one["normal_force_N"], 10., 2e-3)
    rows = rows_of(path("1"), "patch.csv")
    check.relative("flange root: pressure of patch.csv over its area, kN", 1e-3 * sum(r["area_mm2"] * r["pressure_MPa"] for r in rows),
                   1e-3 * one["patches"][0]["normal_force_N"], 0.01)
    check.that("flange root: no shear beyond the friction bound", all(
        math.hypot(r["shear_x_MPa"], r["shear_y_MPa"]) <= 0.3 * r["pressure_MPa"] * (1 + 1e-6) for r in rows))

    # Stress below the inclined surfaces, beside that of the half-space under its own tractions (known, but for the curved surfaces, of 13 mm
    # on the rail, and the layers of 0.33 mm at the peak: about half as much again as was found).
    table = dict(read_table(os.path.join(path("1"), "reference_patch.csv")))
    table["y_mm"] = (table["y_mm"] - table["y_mm"].mean()) / math.cos(one["patches"][0]["angle_rad"])
    below = HalfSpace(Patch("half-space", table, ("pressure_MPa", "shear_x_MPa", "shear_y_MPa", "slip_x_m_per_s", "slip_y_m_per_s")), poisson=0.28, parts=1)
    for body, file, allowed in (("rail", "peak_stress.csv", (0.02, 0.06, 0.012, 0.01, 0.01, 0.01)), ("wheel", "peak_stress_wheel.csv", (0.02, 0.09, 0.04, 0.05, 0.055, 0.055))):
        found = rows_of(path("1"), file)
        del found[1]  # the uppermost layer, where the half-space has a minimum between the surface and the largest stress
        check.that(f"flange root, {body}: layers lie along the surface", all(
            abs(row["depth_mm"] - depth) < 0.02 for row, depth in zip(found, (0., 0.495, 0.99, 1.65, 2.31, 2.97))) and len(found) == 6)
        for row, limit in zip(found, allowed):
            depth = row["depth_mm"]
            check.relative(f"flange root, {body}: von Mises stress {depth:.2f} mm below the surface, MPa", row["von_mises_MPa"],
                           max(von_mises(below.stress(x, y, depth)) for x in below.x[::3] for y in below.y[::2]), limit)
    check.relative("flange root: largest pressure of a node in all steps, MPa", 1e-6 * one["peak_pressure_Pa"], 1e-6 * one["max_pressure_Pa"], 0.02)
    check.relative("flange root: the largest of the table", one["peak_von_mises_Pa"], 1e6 * max(row["von_mises_MPa"] for row in rows_of(path("1"), "peak_stress.csv")[1:]), 1e-6)
    check.that("flange root: the cell that is recorded is the one at 1 mm", abs(1e3 * one["cell_1_depth_m"] - 1.) < 0.34 and abs(1e3 * one["cell_1_x_m"] + 12.) < 0.34
               and abs(1e3 * one["cell_1_y_m"] + 35.4) < 0.35)
    # Between its rows the history has most of what all steps have.
    in_rows = 1e-6 * max(row["cell_1_von_mises_Pa"] for row in rows_of(path("1"), "cells.csv")) / rows_of(path("1"), "peak_stress.csv")[3]["von_mises_MPa"]
    check.that(f"flange root: largest stress of that cell over that of its layer, {in_rows:.3f}", 0.85 < in_rows < 1.)

    # Ranks, and a run in two parts.
    short = {**QUIET, "Mesh/Finest cell (mm)": 0.42, "Motion/Rolled distance (mm)": 3, "Contact/Tolerance": 1e-12,
             "Output/Checkpoint interval (minutes)": 0, "Output/History interval (mm)": 0.12, "Time stepping/Levels": 1}
    whole = run(program, ROOT_OF_FLANGE, path("whole"), short)
    # Friction across the rail counts from the place of a node on the curved surface: all of the patch slides.
    run(program, ROOT_OF_FLANGE, path("across"), {**short, "Contact/Friction across (mm)": "-36.4,-34.4", "Contact/Friction across factors": "0.2,1"})
    off = max(abs(math.hypot(r["shear_x_MPa"], r["shear_y_MPa"]) / (0.3 * r["pressure_MPa"]) - min(1., max(0.2, 0.2 + 0.4 * (r["y_mm"] + 36.4))))
              for r in rows_of(path("across"), "patch.csv"))
    check.below("flange root: shear over pressure beside the friction across the rail at each node, over the coefficient", off, 0.01)

    keys = ("normal_force_N", "longitudinal_force_N", "lateral_force_N", "frictional_power_W", "max_pressure_Pa")
    on_three = run(program, ROOT_OF_FLANGE, path("on three"), short, 3)
    for key in keys:
        check.relative(f"3 ranks against 1: {key}", on_three[key], whole[key], 1e-7)
    parts = subprocess.Popen(command([os.path.join(ROOT, "prm", ROOT_OF_FLANGE), "--output", path("parts")] + [
        word for setting in short.items() for word in ("-s", "%s=%s" % setting)], 1, program), env=environment(),
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    press_ctrl_c(parts, os.path.join(path("parts"), "history.csv"), 6)
    parts.wait(timeout=120)
    check.that("Ctrl-C: not complete", read_summary(path("parts"))["completed"] is False)
    resumed = run(program, ROOT_OF_FLANGE, path("parts"), short, more=["--resume"])
    for key in keys:
        check.relative(f"resumed against never stopped: {key}", resumed[key], whole[key], 1e-12)
    check.that("resumed: forces by patch too", resumed["patches"] == whole["patches"])

    # Neighbouring patches: the pressure of the larger one takes half of the other's force away, which half-spaces of their own do not
    # know. In one plane they do; that plane has no force on the gauge corner's own normal, but the sum along the track, 2.2 kN.
    two = run(program, "curves/two-patches.prm", path("two"), {**QUIET, "Motion/Rolled distance (mm)": 8})
    share = two["patches"][0]["normal_force_N"] / two["half_space_patches"][0]["normal_force_N"]
    check.absolute("two patches: force of the smaller over that of a half-space alone", share, 0.515, 5e-3)
    check.relative("two patches: vertical force, kN", 1e-3 * two["normal_force_N"], 9900 * 9.81e-3, 3e-3)
    lateral, vertical = force_in_track(two)
    check.relative("two patches: vertical force by the patches' axes", vertical, two["normal_force_N"], 2e-3)
    together = run(program, "curves/two-patches.prm", path("together"), {"Wheelset/Patch distance (mm)": 30}, command="reference")
    for key in ("longitudinal_force_N", "frictional_power_W"):
        check.relative(f"two patches: {key} of one plane", two[key], together[key], 0.06)
    apart = run(program, "curves/two-patches.prm", path("apart"), command="reference")
    check.that("half-space: says what it leaves out", any("gives way under the pressure of the others" in w for w in apart["warnings"]))
    check.that("half-space in one plane: says so", any("Wheelset/Patch distance" in w for w in together["warnings"]))

    drawn = script("plot/plot-run.py", path("two"))
    if not check.that("two patches are drawn", drawn.returncode == 0 and os.path.getsize(os.path.join(path("two"), "pictures", "patches.png"))):
        print(drawn.stderr)

    # Where no plane stands for the patch. Converged to 2 % at this cell.
    conformal = execute_often([os.path.join(ROOT, "prm", "curves", "conformal.prm"), "--output", path("conformal"), "-s", "Mesh/Finest cell (mm)=1",
                         "-s", "Output/Write volume=false"], program)
    check.that("conformal: says that half-space theory ends", "half-space: patch 1 is conformal" in conformal.stdout)
    summary = read_summary(path("conformal"))
    own, other = summary["patches"][0], summary["half_space_patches"][0]
    check.relative("conformal: largest pressure over the half-space's", own["max_pressure_Pa"] / other["max_pressure_Pa"], 0.89, 0.03)
    check.relative("conformal: frictional power over the half-space's", own["frictional_power_W"] / other["frictional_power_W"], 1.065, 5e-3)
    check.energy("conformal: ", summary, 1e-3)

    # Yielding in the root of the flange: the load is carried, and pressure falls to what the steel bears.
    soft = run(program, ROOT_OF_FLANGE, path("soft"), {**QUIET, "Mesh/Finest cell (mm)": 0.42, "Motion/Rolled distance (mm)": 8,
                                                       "Mesh/Fine half width (mm)": 4, "Rail/Yield stress (MPa)": 500,
                                                       "Rail/Tangent modulus (GPa)": 21})
    check.relative("yielding: vertical force, kN", 1e-3 * soft["normal_force_N"], 10., 0.02)
    check.that("yielding: pressure falls", soft["max_pressure_Pa"] < 0.97 * one["max_pressure_Pa"])
    check.that("yielding: work is done", soft["plastic_work_J"] > 0.)
    check.energy("yielding: ", soft, 5e-3)

    # One wave under or on one wheel, which stands upright on a crown of 300 mm or in a position on the same arc of 60E1: each has a mesh, depths and
    # a hub of its own. The limit is half as much again as was found with cells of 1 mm.
    WAVE = {**QUIET, "Scene/Quasi-static": "false", "Scene/Density scale": 1, "Solid/Mass damping (1 per s)": 0, "Wheel/Tread profile": "cone 1:40",
            "Wheel/Sector thickness (mm)": 60, "Wheel/Sector width (mm)": 60, "Vehicle/Sprung mass (kg)": 7000, "Contact/Friction coefficient": 0,
            "Motion/Start (mm)": 0, "Motion/Rolled distance (mm)": 30,
            "Motion/Traction coefficient": 0, "Motion/Creepage": 0, "Mesh/Finest cell (mm)": 1, "Output/History interval (mm)": 0.25}
    STANCES = {"upright": {"Rail/Shape": "block", "Rail/Block width (mm)": 60, "Rail/Block height (mm)": 60, "Rail/Crown radius (mm)": 300},
               "in a position": {"Rail/Profile": "60E1", "Wheelset/Lateral shift (mm)": 0}}
    WAVES = {"of the rail": {"Defect/Shape": "corrugation", "Defect/Lateral law": "uniform", "Defect/Position (mm)": 10, "Defect/Length (mm)": 14,
                             "Defect/Wavelength (mm)": 14, "Defect/Depth (mm)": 0.05},
             "of the wheel": {"Wheel/Deviation": "flat: length_mm=14 depth_mm=0.05", "Wheel/Deviation pitch (deg)": math.degrees(0.017 / 0.46)}}
    for whose, wave in WAVES.items():
        over_wave = {stance: run(program, "smooth-rolling.prm", path(stance), {**WAVE, **wave, **own}) for stance, own in STANCES.items()}
        forces = [[(row["position_m"], 1e-3 * row["normal_force_N"]) for row in rows_of(path(stance), "history.csv")] for stance in STANCES]
        static = 7900 * 9.81e-3
        pairs = [(a[1] - static, b[1] - static) for a, b in zip(*forces)]
        check.that(f"a wave {whose}: a hundred rows, at the same places", len(forces[0]) == len(forces[1]) > 100 and all(abs(a[0] - b[0]) < 5e-5 for a, b in zip(*forces)))
        check.below(f"a wave {whose} in a position beside upright: RMS of the difference over that of the dynamic force",
                    math.sqrt(sum((a - b) ** 2 for a, b in pairs) / sum(a ** 2 for a, _ in pairs)), 0.02)
        check.below(f"a wave {whose}: least force over the static one", over_wave["in a position"]["least_normal_force_over_static"], 0.7)
        check.that(f"a wave {whose}: no half-space beside it", "half_space_patches" not in over_wave["in a position"] and not os.path.exists(os.path.join(path("in a position"), "reference_patch.csv")))

    smooth = run(program, "smooth-rolling.prm", path("smooth"), {**WAVE, **WAVES["of the rail"], **WAVES["of the wheel"], **STANCES["in a position"]}, command="reference")
    check.that("a half-space beside a wave: says what it leaves out", all(any(words in w for w in smooth["warnings"]) for words in ("the defect is left out", "the wheel is taken as round")))
    drawn = script("plot/plot-run.py", path("in a position"))
    check.that("a wave in a position is drawn: " + drawn.stderr, drawn.returncode == 0 and os.path.getsize(os.path.join(path("in a position"), "pictures", "patches.png")))

    # What cannot be.
    def must_fail(what, settings, *words, command=()):
        more = [word for setting in settings for word in ("-s", setting)]
        failed = execute_often([*command, os.path.join(ROOT, "prm", ROOT_OF_FLANGE), "--output", path("bad"), *more], program)
        lines = [line for line in failed.stderr.splitlines() if line.startswith("tread:")]
        if not check.that(f"{what}: exit code 1, one line with {words}", failed.returncode == 1 and len(lines) == 1
                          and all(word in lines[0] for word in words)):
            print(failed.returncode, failed.stderr)

    must_fail("cells too large for the patch", ["Mesh/Finest cell (mm)=1"], "Mesh/Finest cell (mm)", "too large for a patch", "at most")
    must_fail("peaks where the patch does not come", [f"{name}={value}" for name, value in {**PEAKS, "Peak stress/To (mm)": -2}.items()], "Peak stress", "must lie on the path", "-27.38")
    must_fail("a torque and a speed", ["Motion/Drive=torque", "Motion/Hold distance (mm)=1"], "Motion/Angular velocity (rad per s)", "Motion/Drive")
    must_fail("a track", ["Track/Foundation=two-layer"], "Track/Foundation", "Wheelset")
    must_fail("a full wheel", ["Wheel/Shape=full"], "Wheel/Shape", "Wheelset")
    DIP = ["Defect/Shape=dip", "Defect/Length (mm)=12", "Defect/Width (mm)=6", "Defect/Depth (mm)=0.1", "Defect/Lateral position (mm)=-35.4"]
    must_fail("a short rail", ["Rail/Begin (mm)=-25"], "Rail/Begin (mm)", "must hold the path")
    must_fail("a defect without inertia", [*DIP, "Defect/Position (mm)=-18"], "Scene/Density scale", "Defect/Shape")
    must_fail("a defect outside the rail", [*DIP, "Defect/Position (mm)=200"], "lies outside the rail", "Defect/Position (mm)")
    must_fail("a uniform rail", ["Ratcheting/Uniform rail=true", "Motion/Passages=2", "Rail/Yield stress (MPa)=500"], "Ratcheting/Uniform rail", "stands upright")
    must_fail("the largest stress where no dip is", [*DIP[:-1], "Scene/Density scale=1", "Solid/Mass damping (1 per s)=0", "Defect/Position (mm)=-25", "Peak stress/Region=trailing edge"],
              "Peak stress", "does not meet the defect")
    must_fail("spin beside the position", ["Motion/Spin (1 per m)=0.1"], "Motion/Spin (1 per m)", "Wheelset")
    must_fail("a short margin", ["Rail/Margin (mm)=9"], "Rail/Margin (mm)", "at least")
    must_fail("further wheels", ["Further wheels/Distances (mm)=500"], "Further wheels/Distances (mm)")
    must_fail("fine cells beyond the profile", ["Mesh/Fine half width (mm)=45"], "Mesh/Fine half width (mm)")

check.exit()
