#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two wheels on one rail: each contact is that of a single wheel, and the forces of the track's supports superpose."""

import os
import subprocess
import sys
import tempfile

from tread.runs import arguments_of, command, environment
from tread_runner import Check, press_ctrl_c, rows_of, run

program = sys.argv[1]
check = Check()

RIGID = "smooth-rolling.prm"
COARSE = ["Mesh/Finest cell (mm)=1.3", "Motion/Rolled distance (mm)=12", "Output/Write volume=false", "Contact/Tolerance=1e-10"]
BEHIND = ["Further wheels/Distances (mm)=2000", "Further wheels/Traction coefficients=0.15"]
PATCH = ("normal_force_N", "traction_coefficient", "max_pressure_Pa", "patch_area_m2", "adhesion_share", "creepage",
         "frictional_power_W")


def on_rigid_foundation(path):
    """The first wheel drives with 0.30, the second one with 0.15. Alone, and together on 1 and 3 ranks."""
    alone = [run(program, RIGID, path("first"), COARSE),
             run(program, RIGID, path("second"), COARSE + ["Motion/Traction coefficient=0.15"])]
    together = run(program, RIGID, path("both"), COARSE + BEHIND)
    for number, (single, folder) in enumerate(zip(alone, ("first", "second"))):
        prefix, table = (f"wheel_{number + 1}_", "patch_wheel_2.csv") if number else ("", "patch.csv")
        for key in PATCH:
            check.relative(f"wheel {number + 1} as alone: {key}", together[prefix + key], single[key], 0.01)
        both, own = (sum(row["pressure_MPa"] * row["area_mm2"] for row in rows_of(path(place), name))
                     for place, name in (("both", table), (folder, "patch.csv")))
        check.relative(f"wheel {number + 1} as alone: sum of its patch table (N)", both, own, 0.01)
        last_both, last_own = (rows_of(path(place), "history.csv")[-1] for place in ("both", folder))
        check.relative(f"wheel {number + 1} as alone: largest pressure in the last row of the history (Pa)",
                       last_both[prefix + "max_pressure_Pa"], last_own["max_pressure_Pa"], 0.01)
    check.energy("two wheels: ", together, 3e-3)
    parallel = run(program, RIGID, path("3"), COARSE + BEHIND, ranks=3)
    for key in ("normal_force_N", "max_pressure_Pa", "wheel_2_max_pressure_Pa", "wheel_2_frictional_power_W"):
        check.relative(f"3 ranks against 1: {key}", parallel[key], together[key], 1e-6)


def on_track(path):
    """Static support forces of two wheels are those of each alone, less the rail's weight that is then counted twice."""
    scene, supports = "tutorial/two-wheels.prm", range(-8, 6)
    load, weight_of_span = 11906. * 9.81, 0.6 * 0.08 * 0.15 * 7800. * 9.81
    # Cells of 20 mm fit the wider bar, a fifth as many as of 10 mm.
    free = ["Rail/Block width (mm)=80", "Motion/Traction coefficient=0", "Further wheels/Traction coefficients=", "Motion/Rolled distance (mm)=4",
            "Output/History interval (mm)=0.5", "Output/Supports=" + ",".join(str(i) for i in supports), "Contact/Tolerance=1e-12"]
    two = run(program, scene, path("two"), free)
    check.energy("two wheels on the track: ", two, 0.02)
    alone = ["Further wheels/Distances (mm)="]
    run(program, scene, path("front"), free + alone)
    run(program, scene, path("rear"), free + alone + ["Motion/Start (mm)=-2100"])
    rows = {name: rows_of(path(name), "history.csv")[0] for name in ("two", "front", "rear")}
    for i in supports[1:-1]:
        force = {name: row[f"support_{i}_pad_N"] for name, row in rows.items()}
        check.absolute(f"support {i}: force of the pad over a wheel's load", force["two"] / load,
                       (force["front"] + force["rear"] - weight_of_span) / load, 5e-4)

    process = subprocess.Popen(command(arguments_of(scene, free, path("parts")), program=program), env=environment(),
                               stdout=subprocess.DEVNULL)
    press_ctrl_c(process, os.path.join(path("parts"), "history.csv"), 3)
    process.wait(timeout=300)
    check.that("interrupted", process.returncode == 130)
    resumed = run(program, scene, path("parts"), free, more=["--resume"], ranks=2)
    for key in ("normal_force_N", "max_pressure_Pa", "wheel_2_normal_force_N", "wheel_2_max_pressure_Pa"):
        check.relative(f"resumed on 2 ranks against never stopped: {key}", resumed[key], two[key], 1e-6)


with tempfile.TemporaryDirectory() as folder:
    on_rigid_foundation(lambda name: os.path.join(folder, "rigid-" + name))
    on_track(lambda name: os.path.join(folder, "track-" + name))
check.exit()
