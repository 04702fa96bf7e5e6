#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wheels that are not round, by finite elements: beside round ones, Hertz, and half-space answers at the same turn of the wheel; bad input."""

import csv
import math
import os
import sys
import tempfile

from tread import hertz
from tread.positions import solve
from tread.runs import ROOT
from tread_runner import Check, run, table

program = sys.argv[1]
check = Check()
SCENE = "smooth-rolling.prm"
LOAD, RADIUS, YOUNG, POISSON = 125e3, 0.46, 210e9, 0.3
# The axle stands still in so little of the way: what contact carries is the equilibrium of the start.
STANDING = ["Scene/Quasi-static=false", "Scene/Density scale=1", "Solid/Mass damping (1 per s)=0", "Vehicle/Wheel load (kN)=125", "Mesh/Finest cell (mm)=1.5",
            "Motion/Speed (km per h)=7.2", "Motion/Rolled distance (mm)=0.1", "Motion/Traction coefficient=0", "Motion/Creepage=0",
            "Wheel/Sector margin (mm)=40", "Rail/Margin (mm)=40", "Output/Write volume=false"]


def hertzian(radius, lateral):
    """Largest pressure of a wheel of this radius on a crown, Pa: semi-axes by trial for the curvatures."""
    modulus = 0.5 * YOUNG / (1. - POISSON**2)
    wanted = 0.5 / radius, 0.5 / lateral
    low, high = 1e-2, 1e2  # of the ratio of the semi-axes
    for _ in range(100):
        ratio = math.sqrt(low * high)
        along, across = hertz.curvatures(ratio * 1e-3, 1e-3, LOAD, modulus)
        low, high = (ratio, high) if along / across > wanted[0] / wanted[1] else (low, ratio)
    # Curvatures go with the inverse cube of the size.
    b = 1e-3 * (across / wanted[1])**(1 / 3)
    return 1.5 * LOAD / (math.pi * ratio * b * b)


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    check.relative("Hertz's pressure of a wheel on a crown of its radius, Pa", hertzian(0.3, 0.3),
                   (6. * LOAD * (0.5 * YOUNG / (1. - POISSON**2) / 0.3)**2)**(1 / 3) / math.pi, 1e-6)

    round_wheel = run(program, SCENE, path("round"), STANDING)
    nothing = run(program, SCENE, path("nothing"), [*STANDING, "Wheel/Deviation=waves: 1=0@0"])
    for key in ("normal_force_N", "max_pressure_Pa"):
        check.relative(f"waves of no height: {key}", nothing[key], round_wheel[key], 1e-8)
    check.that("which is told", any("no part of 'Wheel/Deviation' comes to the rail" in line for line in nothing["warnings"])
               and not any("Deviation" in line for line in round_wheel["warnings"]))

    # At the bottom of a long flat the wheel has another radius.
    depth, length = 0.9e-3, 0.2
    flat = run(program, SCENE, path("flat"), [*STANDING, f"Wheel/Deviation=flat: length_mm={1e3 * length:g} depth_mm={1e3 * depth:g} angle_deg=2",
                                             "Wheel/Deviation pitch (deg)=-2"])
    bigger = 1. / (1. / RADIUS - 0.5 * depth * (2. * math.pi / length)**2)
    check.relative("bottom of a flat: largest pressure over that of the round wheel", flat["max_pressure_Pa"] / round_wheel["max_pressure_Pa"],
                   hertzian(bigger, 0.3) / hertzian(RADIUS, 0.3), 4e-3)
    check.that("no comparison with steady rolling", "not round" in flat["note"])

    # An eccentric wheel touches beside its axle, with the pressure of a round one: as much more where it rolls up as less where it rolls down.
    middle = lambda name: (lambda rows: sum(x * p for x, p in zip(rows["x_mm"], rows["pressure_MPa"])) / sum(rows["pressure_MPa"]))(table(path(name), "patch.csv"))
    pressures = []
    for ahead in (1, -1):
        eccentric = run(program, SCENE, path("eccentric"), [*STANDING, f"Wheel/Deviation=waves: 1=3@{30 * ahead}", f"Wheel/Deviation pitch (deg)={60 * ahead}"])
        pressures.append(eccentric["max_pressure_Pa"])
        check.absolute("eccentric wheel: it touches so far ahead of the axle, mm", middle("eccentric") - middle("round"), 3. * ahead, 0.02)
    check.relative("eccentric wheel: largest pressure over that of the round wheel", 0.5 * sum(pressures) / round_wheel["max_pressure_Pa"], 1., 1e-3)

    # The scanned flat on its rail, at two turns, beside the half-space. Cells of 1.5 mm: detail of the scan is two or three cells long.
    files = os.path.join(ROOT, "prm", "flat")
    worn = min(csv.DictReader(line for line in open(os.path.join(files, "worn-S1002.csv"), encoding="utf-8") if not line.startswith("#")),
               key=lambda row: abs(float(row["y_mm"])))
    radius = 490. - float(worn["z_mm"])
    turns = (-29., -43.)
    half_space = solve([{"rail": os.path.join(files, "rail-of-arcs.csv"), "wheel": os.path.join(files, "worn-S1002.csv"),
                         "wheel_deviation": os.path.join(files, "scan.csv"), "radius_mm": radius, "rail_y_mm": 757.4396, "s_mm": 0., "y_ws_mm": 0.,
                         "pitch_rad": math.radians(turn), "load_N": LOAD, "friction": 0., "young_Pa": YOUNG, "poisson": POISSON} for turn in turns], program)
    for turn, patches in zip(turns, half_space):
        scanned = run(program, SCENE, path("scanned"), [
            *STANDING, f"Wheel/Radius (mm)={radius}", f"Wheel/Tread profile={files}/worn-S1002.csv", "Wheel/Lateral position (mm)=-7.4396",
            f"Wheel/Deviation={files}/scan.csv", f"Wheel/Deviation pitch (deg)={turn}", "Rail/Profile=60E1", f"Rail/Measured head={files}/rail-of-arcs.csv",
            "Contact/Friction coefficient=0"])
        check.relative(f"scanned flat, turned by {turn:g} degrees: largest pressure, Pa", scanned["max_pressure_Pa"], float(patches[0]["max_pressure_Pa"]),
                       0.04)

    # It rolls onto a flat that comes from ahead: until the patch gets there nothing is different, then the wheel falls.
    rolls = [*STANDING, "Motion/Speed (km per h)=100", "Motion/Rolled distance (mm)=30", "Output/History interval (mm)=0.5", "Mesh/Finest cell (mm)=2.2"]
    run(program, SCENE, path("rolls"), [*rolls, "Wheel/Deviation=flat: length_mm=40 depth_mm=0.5", f"Wheel/Deviation pitch (deg)={math.degrees(0.04 / RADIUS)}"])
    run(program, SCENE, path("smooth"), rolls)
    there, smooth = table(path("rolls"), "history.csv"), table(path("smooth"), "history.csv")
    way = [1e3 * (x - there["position_m"][0]) for x in there["position_m"]]
    changes = [(w, a / b - 1.) for w, a, b in zip(way, there["normal_force_N"], smooth["normal_force_N"])]
    # The flat begins 20 mm ahead; the patch is 8 mm long to each side.
    check.below("before the flat: force as of the round wheel", max(abs(change) for w, change in changes if w < 9.), 2e-3)
    check.that("on its first half the wheel falls: the force is less by a tenth", min(change for w, change in changes if w > 18.) < -0.1)

    def must_fail(what, settings, *words):
        check.refused(what, program, SCENE, path("bad"), settings, words)

    deviation = "Wheel/Deviation"
    must_fail("scaled density", {deviation: "waves: 1=1"}, "Scene/Density scale", "Wheel/Deviation")
    must_fail("a file that is not there", {deviation: "scan.csv"}, deviation, "scan.csv", "cannot read")
    must_fail("a misspelt rule", {deviation: "flat: lenght_mm=10 depth_mm=1"}, deviation, "lenght_mm")
    must_fail("another ending", {deviation: "scan.txt"}, deviation, ".csv or .slcw")

check.exit()
