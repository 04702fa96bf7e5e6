#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheel over a rail of full section with a dip, on a rigid foundation: the run beside its smooth twin, on 2 ranks beside 1,
and what a measured profile does."""

import math
import os
import sys
import tempfile

from tread_runner import Check, run, table

program = sys.argv[1]
check = Check()
SCENE = os.path.join("tutorial", "dip.prm")
COARSE = ["Mesh/Finest cell (mm)=2.2", "Mesh/Path cell (mm)=3.3", "Output/Write volume=false"]
SMOOTH = COARSE + ["Defect/Shape=none"]
SHORT = ["Mesh/Finest cell (mm)=2.2", "Motion/Rolled distance (mm)=4", "Defect/Shape=none", "Mesh/Fine from (mm)=0", "Mesh/Fine to (mm)=0",
         "Mesh/Path cell (mm)=0"]


def history(folder):
    columns = table(folder, "history.csv")
    return [1e3 * x for x in columns["position_m"]], columns["normal_force_N"], columns["lateral_force_N"]


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    dip = run(program, SCENE, path("dip"), COARSE)
    smooth = run(program, SCENE, path("smooth"), SMOOTH)
    x, force, lateral = history(path("dip"))
    x_smooth, force_smooth, _ = history(path("smooth"))
    # Time steps differ a little with the shape of the cells, so rows end up to a step, 8 um, apart.
    check.that("the same cells", dip["cells"] == smooth["cells"])
    check.below("rows of the history are at the same places, mm", max(abs(a - b) for a, b in zip(x, x_smooth)), 1e-3)
    static = (900. + 13400.) * 9.81

    # The dip begins at -50 mm; a patch of 8 mm semi-axis, twice that for what nodes of the patch's rim feel.
    begin = -50.
    before = [a / b - 1. for p, a, b in zip(x, force, force_smooth) if p < begin - 16.]
    check.below("before the dip: force as without it", max(map(abs, before)), 1e-4)
    # It starts from equilibrium; waves of the start and cells of 2.2 mm make it ripple, its mean is the load.
    check.relative("without it: mean force over the load", sum(force_smooth) / len(force_smooth), static, 4e-3)
    after = [(p, a / static) for p, a in zip(x, force) if p > begin - 16.]
    least, largest = min(after, key=lambda row: row[1]), max(after, key=lambda row: row[1])
    print(f"least force {least[1]:.3f} at {least[0]:.1f} mm, largest {largest[1]:.3f} at {largest[0]:.1f} mm, share of the load")
    check.that("the force falls by a tenth or more, within the dip", least[1] < 0.9 and begin < least[0] < begin + 30.)
    check.that("it rises by a tenth or more, later", largest[1] > 1.1 and largest[0] > least[0])
    check.energy("", dip, 1e-3)

    # The patch is normal to the rail, which leans by 1:40: without friction, by which spin pushes back, the force is, too.
    frictionless = run(program, SCENE, path("frictionless"), [*SHORT, "Contact/Friction coefficient=0"])
    check.absolute("lateral over normal force", frictionless["lateral_force_N"] / frictionless["normal_force_N"], -1. / 40., 2e-3)
    check.that("spin pushes back", frictionless["lateral_force_N"] < lateral[0] < 0.)

    two = run(program, SCENE, path("two"), ["Contact/Tolerance=1e-12", *SHORT], 2)
    one = run(program, SCENE, path("one"), ["Contact/Tolerance=1e-12", *SHORT])
    for key in ("normal_force_N", "max_pressure_Pa", "patch_area_m2"):
        check.relative(f"2 ranks against 1: {key}", two[key], one[key], 1e-8)
    # What two opposite forces leave, of which each is a fortieth of the normal force.
    check.absolute("2 ranks against 1: lateral force over a fortieth of the normal one", 40. * two["lateral_force_N"] / two["normal_force_N"],
                   40. * one["lateral_force_N"] / one["normal_force_N"], 1e-8)

    # A head as measured: an arc of 200 mm, by which Hertz's patch is narrower.
    def write_head(name, width):
        with open(path(name), "w", encoding="utf-8") as stream:
            stream.writelines(f"{y} {math.sqrt(200.**2 - y * y) - 200.:.6f}\n" for y in range(-width, width + 1))

    write_head("head.txt", 26)
    narrow = run(program, SCENE, path("narrow"),
                 [*SHORT, "Rail/Measured head=" + path("head.txt"), "Rail/Inclination=none", "Wheel/Tread profile=cylinder"])
    check.relative("measured head of 200 mm: largest pressure over Hertz's", narrow["max_pressure_Pa"],
                   narrow["reference"]["max_pressure_Pa"]["Hertz"]["value"], 0.04)
    check.that("measured head of 200 mm: Hertz's pressure is above that of 300 mm",
               narrow["reference"]["max_pressure_Pa"]["Hertz"]["value"] > 1.1 * one["reference"]["max_pressure_Pa"]["Hertz"]["value"])
    # The same, measured no wider than needed: the patch does not see where it ends.
    write_head("short.txt", 14)
    short = run(program, SCENE, path("short"),
                [*SHORT, "Rail/Measured head=" + path("short.txt"), "Rail/Inclination=none", "Wheel/Tread profile=cylinder"])
    check.relative("a head measured to 14 mm at each side: largest pressure", short["max_pressure_Pa"], narrow["max_pressure_Pa"], 1e-3)
    check.that("it is said where it ends", any("measured up to 14 mm" in line for line in short["assumptions"])
               and not any("measured up to" in line for line in narrow["assumptions"]))
    # A cylinder touches the arc 10 mm beside the middle where it leans by 1:20.
    check.refused("contact beyond what was measured", program, SCENE, path("bad"),
                  [*SHORT, "Rail/Measured head=" + path("short.txt"), "Rail/Inclination=1:20", "Wheel/Tread profile=cylinder"],
                  ("'Rail/Measured head' ends 14 mm", "measure a wider head"))
check.exit()
