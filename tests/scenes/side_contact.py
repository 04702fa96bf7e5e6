#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""S1002 treads on inclined rails: the patch lies to the gauge side and is wide. They roll as others do, with the creepage, the power and
the lateral force by spin that half-space theory has for their tread; recorded tables go on after an interruption, on any number of ranks."""

import os
import subprocess
import sys
import tempfile

from tread.runs import arguments_of, command, environment
from loaded_once import execute_often
from tread_runner import Check, press_ctrl_c, run, table

program = sys.argv[1]
check = Check()
SCENE = os.path.join("tutorial", "dip.prm")
# Fine cells at the gauge corner, which is smooth and hence flat as a corner of cells, would cut the time step: sizes grow fast.
SETTINGS = ["Mesh/Finest cell (mm)=1.8", "Mesh/Cells per level=1", "Motion/Rolled distance (mm)=16", "Defect/Shape=none", "Mesh/Fine from (mm)=0", "Mesh/Fine to (mm)=0",
            "Mesh/Path cell (mm)=0", "Output/Write volume=false", "Output/Cells=-8,-12,1; -8,-9,4"]
S1002 = SETTINGS + ["Wheel/Tread profile=S1002", "Mesh/Fine half width (mm)=11", "Contact/Tolerance=1e-12"]
# Around the gauge corner, where cells are flat: a quarter of the time step, and hence a short way.
WIDE = ["Mesh/Fine half width (mm)=15", "Motion/Rolled distance (mm)=4"]
LOAD = (900. + 13400.) * 9.81


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    # A full section rolls over a little under the load beside its web, which shifts the patch; a head on a rigid foundation does not.
    for profile, shape in (("54E1", "full section"), ("60E1", "head")):
        name = f"S1002 on {profile} 1:40, {shape}: "
        rail = [f"Rail/Profile={profile}", f"Rail/Shape={shape}"]
        width = [] if shape == "head" else WIDE
        folder_of_run = path(profile + shape)
        summary = run(program, SCENE, folder_of_run, S1002 + rail + width)
        check.that(name + "comes to its end", summary["completed"])
        # Starting from rest, on cells of 1.8 mm.
        check.relative(name + "normal force over the load", summary["normal_force_N"], LOAD, 0.02)
        check.energy(name, summary, 0.01)
        if shape == "head":
            cone = run(program, SCENE, path("cone"), SETTINGS + rail + ["Motion/Rolled distance (mm)=4"])
            check.that(name + "time steps are about those of a cone", summary["time_step_s"] > 0.7 * cone["time_step_s"])
        patch, half_space = table(folder_of_run, "patch_averaged.csv"), table(folder_of_run, "reference_patch.csv")
        print(f"patch from {min(patch['y_mm']):.1f} to {max(patch['y_mm']):.1f} mm, half-space "
              f"from {min(half_space['y_mm']):.1f} to {max(half_space['y_mm']):.1f} mm")
        if shape == "head": # a cell of 1.8 mm at each side
            for side, end in (("left", min), ("right", max)):
                check.absolute(name + f"{side} end of the patch, half-space's, mm", end(patch["y_mm"]), end(half_space["y_mm"]), 1.8)

    # Friction's lateral force is what is there more than without friction, where the inclined surfaces push.
    for tread, tractions in (("S1002", (0., 0.3)), ("cone 1:20", (0.3,))):
        settings = [f"Wheel/Tread profile={tread}", "Wheel/Lateral position (mm)=-2", "Rail/Inclination=1:40", "Mesh/Finest cell (mm)=1.3",
                    "Mesh/Fine half width (mm)=15", "Output/Write volume=false"]
        smooth = run(program, "smooth-rolling.prm", path("no friction"),
                     settings + ["Contact/Friction coefficient=0", "Motion/Traction coefficient=0", "Motion/Rolled distance (mm)=15"])
        for traction in tractions:
            name = f"{tread}, traction coefficient {traction}: "
            driven = settings + [f"Motion/Traction coefficient={traction}"]
            summary = run(program, "smooth-rolling.prm", path("driven"), driven)
            half_space = run(program, "smooth-rolling.prm", path("half-space"), driven, command="reference")
            check.absolute(name + "traction coefficient, the one asked for", summary["traction_coefficient"], traction, 0.005)
            check.absolute(name + "creepage, half-space's", summary["creepage"], summary["reference"]["creepage"]["half-space"]["value"],
                           5e-5)
            # Spin alone slips on a rim narrower than a cell of 1.3 mm.
            check.absolute(name + "adhesion share, half-space's", summary["adhesion_share"],
                           summary["reference"]["adhesion_share"]["half-space"]["value"], 0.02 if traction > 0. else 0.03)
            # Found: 0.1 %. Spin alone slips at the rim, which cells of 1.3 mm see coarsely: 1.4 %.
            check.relative(name + "power, half-space's, W", summary["frictional_power_W"],
                           summary["reference"]["frictional_power_W"]["half-space"]["value"], 0.004 if traction > 0. else 0.022)
            check.relative(name + "lateral force by friction, half-space's, N",
                           summary["lateral_force_N"] - smooth["lateral_force_N"], half_space["lateral_force_N"], 0.05)
            check.that(name + "is long enough to be steady", summary["long_enough_to_be_steady"])

    whole = path("60E1head")
    settings = S1002 + ["Rail/Profile=60E1", "Rail/Shape=head"]
    strip = table(whole, "strip.csv")
    run(program, SCENE, path("two"), settings, 2)
    other = table(path("two"), "strip.csv")
    check.that("2 ranks against 1: strip has the same columns", all(abs(a - b) < 1e-6 for a, b in zip(strip["x_mm"], other["x_mm"])))
    check.below("2 ranks against 1: largest stresses, share", max(abs(b / a - 1.) for a, b in zip(strip["von_mises_MPa"],
                                                                                               other["von_mises_MPa"])), 1e-6)
    cells, others = table(whole, "cells.csv"), table(path("two"), "cells.csv")
    check.below("2 ranks against 1: stress of a cell, share",
                max(abs(b / a - 1.) for a, b in zip(cells["cell_2_von_mises_Pa"], others["cell_2_von_mises_Pa"])), 1e-6)

    arguments = arguments_of(SCENE, settings, path("parts"))
    process = subprocess.Popen(command(arguments, program=program), env=environment(), stdout=subprocess.DEVNULL)
    press_ctrl_c(process, os.path.join(path("parts"), "history.csv"), 40)
    process.wait(timeout=120)
    check.that("Ctrl-C ends with its own exit code", process.returncode == 130)
    more = execute_often(arguments_of(SCENE, settings + ["Output/Cells=-8,-12,1"], path("parts")) + ["--resume"], program)
    check.that("resuming with other cells is refused by name", more.returncode == 1 and "'Output/Cells' " in more.stderr and ", now -8,-12,1" in more.stderr)
    run(program, SCENE, path("parts"), settings, 2, more=["--resume"])
    parts = table(path("parts"), "strip.csv")
    # The coupling of the contact is integrated anew at a checkpoint.
    check.below("resumed on 2 ranks: largest stresses, share", max(abs(b / a - 1.) for a, b in zip(strip["von_mises_MPa"],
                                                                                                  parts["von_mises_MPa"])), 2e-3)
    after = table(path("parts"), "cells.csv")
    check.that("resumed: as many rows of the cells", len(after["time_s"]) == len(cells["time_s"]))
    check.relative("resumed: stress of a cell", max(after["cell_1_von_mises_Pa"]), max(cells["cell_1_von_mises_Pa"]), 2e-3)
check.exit()
