#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A window of fine cells that moves with the wheel: the answer of a mesh that is fine everywhere, at less cost; on other ranks, with
Ctrl-C, and refused where its mesh must stay."""

import os
import sys
import tempfile

import numpy as np

from tread.files import read_summary
from tread.runs import arguments_of, must_end_well
from loaded_once import execute_often
from tread_runner import Check, rows_of, run, run_stopped, table

program = sys.argv[1]
check = Check()
SCENE = "smooth-rolling.prm"
COARSE = ["Mesh/Finest cell (mm)=1.8", "Mesh/Fine half width (mm)=9", "Motion/Rolled distance (mm)=40", "Scene/Density scale=1",
          "Time stepping/Levels=1"]
WINDOW = COARSE + ["Mesh/Window=true", "Mesh/Window length (mm)=10"]

# Cells of 20 mm fit the wider bar.
TRACK = ["Rail/Block width (mm)=80", "Motion/Start (mm)=-160", "Motion/Rolled distance (mm)=40", "Rail/Ends=endless", "Mesh/Window length (mm)=10",
         "Output/Supports=", "Output/Write volume=false"]
LEAST_STEP = ["Time stepping/Least step (us)=0.456"]  # of which --dry-run speaks


def differences(of, beside, column):
    """Of two histories of one scene, row for row where the wheel is at the same place, over the mean."""
    own = np.interp(of["position_m"], beside["position_m"], beside[column])
    rolling = np.array(of["position_m"]) > of["position_m"][0] + 3e-3  # the first rows begin in rest
    return (np.array(of[column]) - own)[rolling] / np.mean(own)


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    whole = run(program, SCENE, path("whole"), COARSE)
    moving = run(program, SCENE, path("moving"), WINDOW)
    of_whole, of_moving = table(path("whole"), "history.csv"), table(path("moving"), "history.csv")
    check.that("four windows", moving["windows"] == 4 and "windows" not in whole)
    check.that("fewer cells", moving["cells"] < 0.9 * whole["cells"])
    for column in ("normal_force_N", "longitudinal_force_N"):
        check.below(f"{column}: largest difference from all cells fine", np.abs(differences(of_moving, of_whole, column)).max(), 5e-4)
    for key, allowed in (("max_pressure_Pa", 1e-3), ("patch_area_m2", 1e-3), ("creepage", 1e-4), ("max_shear_Pa", 2e-3),
                         ("adhesion_share", 2e-3), ("frictional_work_J", 1e-3)):
        check.relative(f"{key} beside all cells fine", moving[key], whole[key], allowed)

    # The ledger: the loss is a column of its own that changes where the window does, and little is left over.
    loss = np.array(of_moving["window_loss_J"])
    places = [1e3 * of_moving["position_m"][k + 1] + 40. for k in np.flatnonzero(np.diff(loss))]
    check.that("the loss changes at 10, 20 and 30 mm", len(places) == 3 and all(0. <= at - due <= 0.6 for at, due in zip(places, (10., 20., 30.))))
    check.absolute("the summary has the last row's loss, J", moving["window_loss_J"], loss[-1], 1e-9)
    check.below("window loss over what was dissipated", abs(moving["window_loss_J"] / moving["dissipated_work_J"]), 6e-4)
    check.that("but some was lost", abs(loss[-1]) > 1e-6)
    check.energy("", moving, 1e-3)
    stored = np.array([sum(row[name] for name in ("kinetic_energy_J", "internal_energy_J", "hourglass_energy_J", "frictional_work_J",
                                                  "contact_loss_J", "damping_work_J", "plastic_work_J", "window_loss_J"))
                       for row in rows_of(path("moving"), "history.csv")])
    check.below("its columns give the residual, J", np.abs(np.array(of_moving["external_work_J"]) - stored - of_moving["energy_residual_J"]).max(), 1e-7)

    # With added density: the mass that chords lack is not taken for a loss.
    scaled = run(program, SCENE, path("scaled"), WINDOW + ["Scene/Density scale=25"])
    # 0.005 was found, and with cells of 1.3 mm 0.006, and 0.87 where the kinetic energy of that mass is booked without its centrifugal potential.
    check.below("density scale 25: window loss over what was dissipated", scaled["window_loss_J"] / scaled["dissipated_work_J"], 0.007)
    # In free rolling little is dissipated, and 0.21 was found.
    free = run(program, SCENE, path("free"), WINDOW + ["Scene/Density scale=25", "Motion/Traction coefficient=0"])
    warned = [sum("changes of the window" in line for line in summary["warnings"]) for summary in (moving, scaled, free)]
    check.that("a loss above 2 % is told of", warned == [0, 0, 1] and abs(free["window_loss_J"] / free["dissipated_work_J"]) > 0.02)

    # Ctrl-C in the second window and on to the end.
    run_stopped(program, SCENE, path("stopped"), WINDOW, 50)
    part = read_summary(path("stopped"))
    check.that("stopped in the second window or later", part["completed"] is False and 2 <= part["windows"] < 4)
    resumed = run(program, SCENE, path("stopped"), WINDOW, more=["--resume"])
    check.that("resumed to the last window", resumed["windows"] == 4 and resumed["steps"] == moving["steps"])
    for key in ("normal_force_N", "longitudinal_force_N", "max_pressure_Pa", "creepage", "window_loss_J", "frictional_work_J"):
        check.relative(f"stopped and resumed: {key}", resumed[key], moving[key], 1e-12)
    check.that("stopped and resumed: the same strip", rows_of(path("stopped"), "strip.csv") == rows_of(path("moving"), "strip.csv"))
    one, two = (run(program, SCENE, path(f"on-{ranks}"), [*WINDOW, "Motion/Rolled distance (mm)=12", "Mesh/Window length (mm)=7.5"], ranks) for ranks in (1, 2))
    for key in ("normal_force_N", "longitudinal_force_N", "max_pressure_Pa", "creepage", "frictional_work_J"):
        check.relative(f"two ranks, with friction: {key}", two[key], one[key], 1e-6)
    check.absolute("two ranks, with friction: window loss over what was dissipated", *(of["window_loss_J"] / of["dissipated_work_J"] for of in (two, one)), 1e-8)

    # A small wheel that rolls more than a turn is a ring, and does what it does on a sector.
    small = ["Mesh/Finest cell (mm)=1.25", "Mesh/Fine half width (mm)=8", "Motion/Speed (km per h)=300", "Wheel/Radius (mm)=100", "Wheel/Mass (kg)=100", "Vehicle/Sprung mass (kg)=6000", "Wheel/Sector width (mm)=60", "Wheel/Sector thickness (mm)=30",
             "Scene/Density scale=4", "Time stepping/Levels=2", "Mesh/Window=true", "Mesh/Window length (mm)=60", "Mesh/Window margin (mm)=20", "Output/Write volume=false"]
    sector = run(program, SCENE, path("sector"), small + ["Motion/Rolled distance (mm)=60"])
    ring = run(program, SCENE, path("ring"), small + ["Motion/Rolled distance (mm)=640"])
    check.that("a turn is 628 mm", ring["rolled_m"] > 2 * np.pi * 0.1 and ring["windows"] == 11 and sector["windows"] == 1)
    for key, allowed in (("normal_force_N", 5e-3), ("traction_coefficient", 0.01), ("max_pressure_Pa", 0.02), ("patch_area_m2", 0.02)):
        check.relative(f"ring beside sector: {key}", ring[key], sector[key], allowed)
    check.energy("ring: ", ring, 0.01)
    of_ring = table(path("ring"), "history.csv")
    rolling = np.array(of_ring["position_m"]) > -0.6
    check.below("ring: swing of the force over a turn", np.ptp(np.array(of_ring["normal_force_N"])[rolling]) / ring["normal_force_N"], 0.05)

    # On supports without being asked, and the strip of the largest stresses goes on over the changes.
    fine, without_asking, slow, slow_again = (run(program, "tutorial/track.prm", path(name), TRACK + more, ranks=ranks) for name, more, ranks in
                                                (("fine", ["Mesh/Window=false"], 1), ("automatic", [], 1), ("slow", LEAST_STEP, 1), ("slow-2", LEAST_STEP, 2)))
    check.that("on supports without being asked: four windows", without_asking["windows"] == slow["windows"] == 4 and "windows" not in fine)
    check.that("and says so", any("4 windows" in line for line in without_asking["assumptions"]) and not any("windows" in line for line in fine["assumptions"] + moving["assumptions"]))
    for what, names, allowed in (("all cells fine", ("fine", "automatic"), 1e-3), ("one rank on two", ("slow", "slow-2"), 1e-5)):
        strips = [rows_of(path(name), "strip.csv") for name in names]
        check.that(f"strip beside {what}: as many columns", len(strips[0]) == len(strips[1]) > 20)
        for key in ("x_mm", "depth_mm", "von_mises_MPa", "surface_von_mises_MPa", "wheel_x_mm"):
            check.below(f"strip: {key}, largest difference from {what} over the largest",
                        max(abs(a[key] - b[key]) for a, b in zip(*strips)) / max(abs(row[key]) for row in strips[0]), allowed)
    force = [table(path(name), "history.csv") for name in ("automatic", "slow")]
    check.below("mass for a longer step: change of the force, RMS over the mean",
                np.sqrt(np.mean((np.interp(force[0]["position_m"], force[1]["position_m"], force[1]["normal_force_N"]) / np.array(force[0]["normal_force_N"]) - 1.)**2)), 2e-3)
    # What a smooth rail dissipates in 40 mm is little beside what passes through the bodies.
    check.below("mass for a longer step: energy residual over the gross work", abs(slow["energy_residual_share"]), 1e-4)
    check.that("the step that was wanted, which the mesh as a whole exceeds", 0.456e-6 < slow["time_step_s"] < 0.65e-6)
    for key in ("added_mass_rail_kg", "added_mass_wheels_kg", "added_mass_rail_share", "added_mass_wheels_share", "added_mass_error_estimate"):
        check.relative(f"two ranks: {key}", slow_again[key], slow[key], 1e-9)
    for key in ("normal_force_N", "max_pressure_Pa", "window_loss_J", "damping_work_J"):
        check.relative(f"two ranks: {key}", slow_again[key], slow[key], 1e-6)
    dry = must_end_well(execute_often([*arguments_of("tutorial/track.prm", TRACK), "--dry-run"], program)).stdout
    added = [line.split()[1:3] for line in dry.splitlines() if line.startswith("  0.456 ")][0]
    for body, kg in zip(("rail", "wheels"), added):  # in the first window, of which the summary has the largest
        check.relative(f"--dry-run says what such a step adds, {body}, kg", float(kg), slow[f"added_mass_{body}_kg"], 0.15)
    # Cells along the path have three levels of time steps, the mesh with cubes five. The way before the cubes ends after a step in
    # which cells of the fifth would not be due, and its last window has to wait for one.
    levels = run(program, "tutorial/track.prm", path("levels"), [setting for setting in TRACK if "Window length" not in setting] +
                 ["Time stepping/Levels=6", "Mesh/Finest cell (mm)=1.25", "Mesh/Path cell (mm)=5", "Mesh/Fine from (mm)=-125", "Mesh/Fine to (mm)=-115",
                  "Mesh/Fine half width (mm)=12", "Mesh/Window length (mm)=9"])
    check.that("a mesh with more levels than the one before", levels["windows"] == 6)
    check.below("more levels: energy residual over the gross work", abs(levels["energy_residual_share"]), 1e-3)
    check.refused("a step that adds too much", program, "tutorial/track.prm", path("refused"), TRACK + ["Time stepping/Least step (us)=3"], ["Least step", "1 kHz"])
    check.refused("a step with scaled density", program, SCENE, path("refused"), COARSE + ["Scene/Density scale=4", "Time stepping/Least step (us)=0.5"], ["Least step", "Density scale"])

    dry = must_end_well(execute_often([*arguments_of(SCENE, WINDOW), "--dry-run"], program)).stdout
    check.that("--dry-run says of which place it speaks", "4 places; cells, memory and time step are those of the first one" in dry)

    # A wheelset in a position: the root of a flange, behind the axle, and both wheels on springs.
    root = ["Mesh/Finest cell (mm)=0.42", "Motion/Rolled distance (mm)=12", "Scene/Density scale=1", "Solid/Mass damping (1 per s)=0", "Output/Write volume=false"]
    of_root = [run(program, "curves/flange-root.prm", path(f"root-{name}"), root + more) for name, more in
               (("whole", []), ("moving", ["Mesh/Window=true", "Mesh/Window length (mm)=4"]))]
    check.that("root of a flange: three windows with fewer cells", of_root[1]["windows"] == 3 and of_root[1]["cells"] < 0.9 * of_root[0]["cells"])
    beside = [table(path(f"root-{name}"), "history.csv") for name in ("moving", "whole")]
    for column, allowed in (("normal_force_N", 6e-4), ("longitudinal_force_N", 3e-3), ("lateral_force_N", 2e-3)):
        check.below(f"root of a flange: {column}, largest difference from all cells fine", np.abs(differences(*beside, column)).max(), allowed)
    check.energy("root of a flange: ", of_root[1], 3e-3)
    strips = [rows_of(path(f"root-{name}"), "strip.csv") for name in ("whole", "moving")]
    check.that("root of a flange: as many columns of the strip", len(strips[0]) == len(strips[1]) > 20)
    check.below("root of a flange: strip, largest difference over the largest", max(abs(a["von_mises_MPa"] - b["von_mises_MPa"]) for a, b in zip(*strips)) / max(row["von_mises_MPa"] for row in strips[0]), 0.02)
    both = ["Motion/Rolled distance (mm)=36", "Output/Write volume=false"]
    whole, moving = (run(program, "curves/klingel.prm", path(f"both-{name}"), both + more, ranks) for name, more, ranks in
                     (("whole", [], 1), ("moving", ["Mesh/Window=true", "Mesh/Window length (mm)=15"], 2)))
    check.that("both wheels: three windows", moving["windows"] == 3)
    for key, allowed in (("normal_force_N", 1e-4), ("max_pressure_Pa", 1e-3)):
        check.relative(f"both wheels: {key} beside all cells fine", moving[key], whole[key], allowed)

    # Where the mesh must stay.
    for words, setting in (("'Damage/Record'", "Damage/Record=true"), ("Peak stress", "Peak stress/Record=true"),
                           ("steel that yields", "Rail/Yield stress (MPa)=400"), ("several passages", "Motion/Passages=2"),
                           ("'Output/Cells'", "Output/Cells=0 0 1"), ("Reproducible", "Scene/Reproducible=true"),
                           ("Window margin", "Mesh/Window margin (mm)=5"), ("four cells", "Mesh/Window length (mm)=5")):
        check.refused(f"a window with {setting}", program, SCENE, path("refused"), WINDOW + [setting], [words])
    check.refused("a window over slices", program, "crossing/uk-56E1-nose.prm", path("refused"), ["Mesh/Window=true"], ["'Rail/Shape' slices"])
    without = run(program, SCENE, path("unused"), COARSE + ["Motion/Rolled distance (mm)=4", "Mesh/Window length (mm)=10"])
    check.that("a length without a window is named", any("Window length" in line for line in without["unused_parameters"]))
check.exit()
