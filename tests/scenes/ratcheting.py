#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Passages over a rail that ratchets: a rail that is alike along its length, jumps over passages beside passages that are rolled, the
strain at which the steel fails; ranks, Ctrl-C, and what is refused."""

import os
import sys
import tempfile

import numpy as np

from tread_runner import Check, run, run_stopped, table

program = sys.argv[1]
check = Check()
SCENE = "damage/ratcheting.prm"
COARSE = ["Mesh/Finest cell (mm)=2.6", "Mesh/Fine half width (mm)=10", "Motion/Rolled distance (mm)=30", "Output/History interval (mm)=2"]
SHORT = COARSE + ["Motion/Passages=16", "Ratcheting/Irregularity (%)=15", "Ratcheting/Change in a jump (%)=40"]
ROLLED = COARSE + ["Ratcheting/Jumps=false"]


def columns(folder, name="passages.csv"):
    return {key: np.array(values) for key, values in table(folder, name).items()}


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    # The middle of the path is given to all of the rail, before and behind the path too.
    three = ROLLED + ["Motion/Passages=3", "Output/Table depth (mm)=4", "Ratcheting/Longest jump=7"]
    uniform = run(program, SCENE, path("uniform"), three)
    check.that("what has no effect without jumps is named", any("Longest jump" in line for line in uniform["unused_parameters"]))
    cells = columns(path("uniform"), "rail_cells.csv")
    check.that("rail cells of the table are there", len(cells["x_mm"]) > 100)
    ahead = cells["x_mm"] > 12.
    strained = cells["equivalent_plastic_strain_percent"]
    # The last wheel has rolled up to x = 0 only: ahead of it is what the two before left in the middle.
    before = columns(path("uniform"))["equivalent_plastic_strain_percent"]
    check.that("cells ahead of the last wheel", ahead.sum() > 10)
    check.relative("where no wheel has rolled: as in the middle, %", strained[ahead].max(), before[1], 5e-3)
    lines = {}
    for x, y, z, strain in zip(cells["x_mm"][ahead], cells["y_mm"][ahead], cells["z_mm"][ahead], strained[ahead]):
        lines.setdefault((round(y, 2), round(z, 2)), []).append(strain)
    # Known: the mean of the middle; regression: beside larger cells they yield a little once more.
    check.below("along each line all cells have the same, share of the largest", max(np.ptp(values) for values in lines.values()) / before[1], 5e-3)

    # What is left without the load is what the twin that does not yield has not, at the same place under the same load, 30 mm before it; the wheel has
    # a profile and rolls 14 mm beside the rail's middle, where only its own line has sunk.
    far = [*ROLLED, "Motion/Rolled distance (mm)=60", "Motion/Passages=2", "Ratcheting/Uniform rail=false", "Output/Table depth (mm)=25", "Output/Write volume=false"]
    aside = [*far, "Wheel/Tread profile=S1002", "Wheel/Lateral position (mm)=-2", "Mesh/Finest cell (mm)=1.8", "Mesh/Fine half width (mm)=9"]
    for name, settings, cell in (("straight", far, 2.6), ("aside", aside, 1.8)):
        summary = run(program, SCENE, path(name), settings)
        run(program, SCENE, path(f"{name} elastic"), settings + ["Rail/Yield stress (MPa)=5000", "Motion/Passages=1"])  # each finds the same rail
        left, of_load = ({table_name: columns(path(of), f"{table_name}.csv") for table_name in ("rail_cells", "rail_surface")} for of in (name, f"{name} elastic"))
        last = {key: values[-1] for key, values in columns(path(name)).items()}
        line = (np.abs(left["rail_surface"]["y_mm"] - 1e3 * summary["first_contact_y_m"]) < 0.51 * cell) & (np.abs(left["rail_surface"]["x_mm"] + 30.) <= 5.)
        for column, direction, sign in (("settlement_um", "u_z_um", -1.), ("shift_um", "u_x_um", 1.)):
            check.relative(f"{name}: {column} beside the difference from the twin", last[column], sign * (left["rail_surface"][direction] - of_load["rail_surface"][direction])[line].mean(), 0.03)
        near = np.abs(left["rail_cells"]["x_mm"] - 0.5 * cell + 30.) <= 5.001  # by its first node
        xx, yy, zz, xy, yz, zx = (left["rail_cells"][f"stress_{of}_MPa"][near] - of_load["rail_cells"][f"stress_{of}_MPa"][near] for of in ("xx", "yy", "zz", "xy", "yz", "zx"))
        check.relative(f"{name}: residual_von_mises_MPa beside the same", last["residual_von_mises_MPa"],
                       np.sqrt(0.5 * ((xx - yy)**2 + (yy - zz)**2 + (zz - xx)**2) + 3. * (xy**2 + yz**2 + zx**2)).max(), 0.03)

    # A rail that never yields is as it was once the wheel is gone, though the wheel still stands 15 mm from where it is looked at; nothing of what
    # was left out of such passages is forgotten.
    elastic = run(program, SCENE, path("elastic"), COARSE + ["Motion/Passages=12", "Rail/Yield stress (MPa)=5000"])
    left = columns(path("elastic"))
    for column, allowed in (("residual_von_mises_MPa", 0.5), ("settlement_um", 0.02), ("shift_um", 0.02)):
        check.below(f"of steel that does not yield: {column}", np.abs(left[column]).max(), allowed)
    check.that("and passages left out", elastic["net_plastic_strain"] == 0. and elastic["passages_rolled"] + elastic["passages_left_out"] == 12 and elastic["passages_left_out"] > 4 and elastic["jumps"] >= 1)
    first = columns(path("uniform"))
    check.that("in steel that yields there is, from the first wheel on", np.all(first["residual_von_mises_MPa"] > 100.) and np.all(np.diff(first["settlement_um"]) > 0.) and first["settlement_um"][0] > 1.)

    # Passages that are rolled beside those that are left out.
    n = 36  # with two jumps
    rolled = run(program, SCENE, path("rolled"), ROLLED + [f"Motion/Passages={n}"])
    jumped = run(program, SCENE, path("jumped"), COARSE + [f"Motion/Passages={n}"])
    all_of, some = columns(path("rolled")), columns(path("jumped"))
    check.that("all are rolled without jumps", rolled["passages_rolled"] == n and list(all_of["passage"]) == list(range(1, n + 1)) and "jumps" not in rolled)
    check.that("fewer with", jumped["jumps"] == 2 and jumped["passages_left_out"] >= 12 and jumped["passages_rolled"] + jumped["passages_left_out"] == n)
    check.that("each row says how many were left out before it", np.all(np.diff(some["passage"], prepend=0) == some["skipped"] + 1) and some["skipped"].sum() == jumped["passages_left_out"]
               and (some["skipped"] > 0).sum() == jumped["jumps"] and some["passage"][-1] == n)
    at = some["passage"].astype(int) - 1
    for column, allowed in (("net_plastic_strain_percent", 0.015), ("equivalent_plastic_strain_percent", 0.015), ("shift_um", 0.015), ("settlement_um", 0.003)):
        check.below(f"{column}: largest difference from all rolled, over the last", np.abs(some[column] - all_of[column][at]).max() / abs(all_of[column][-1]), allowed)
    off = abs(jumped["net_plastic_strain"] / rolled["net_plastic_strain"] - 1.)
    check.that("the estimate of the error is no less than a third of it, and no more than a tenth of the strain",
               off / 3. <= jumped["net_plastic_strain_error_estimate"] / rolled["net_plastic_strain"] <= 0.1)
    growth = np.diff(all_of["net_plastic_strain_percent"], prepend=0.)
    check.that("the largest change of a passage is no less than that of the largest strain", np.all(all_of["net_plastic_strain_of_passage_percent"] >= growth - 1e-6))
    check.that("it ratchets: the surface moves against the wheel, the strain grows, the net one less", np.all(np.diff(all_of["shift_um"]) < 0) and np.all(growth > 0)
               and np.all(all_of["net_plastic_strain_percent"] <= all_of["equivalent_plastic_strain_percent"] * (1 + 1e-6)))
    check.relative("summary: net strain", 100 * jumped["net_plastic_strain"], some["net_plastic_strain_percent"][-1], 1e-6)
    check.relative("summary: of the last passage", 100 * jumped["net_plastic_strain_of_last_passage"], some["net_plastic_strain_of_passage_percent"][-1], 1e-6)
    # In the uppermost layer of cells, of 2.6 mm, one of the two beside the middle.
    check.absolute("depth, mm", 1e3 * jumped["net_plastic_strain_depth_m"], 1.3, 0.02)
    check.absolute("y, to one side or the other, mm", abs(1e3 * jumped["net_plastic_strain_y_m"]), 1.3, 0.02)

    # Steel that shakes down changes less in each passage until nothing is seen of it. What is left out then leaves it as it is.
    down = run(program, SCENE, path("down"), COARSE + ["Motion/Passages=300", "Rail/Yield stress (MPa)=900"])
    still = columns(path("down"))
    last = np.nonzero(still["skipped"])[0][-1]
    check.that("it shakes down within a hundred passages", down["passages_rolled"] < 100 and still["skipped"][last] > 150)
    check.that("each passage changes it less", np.all(np.diff(still["net_plastic_strain_of_passage_percent"][8:last]) < 0))
    check.relative("behind those left out: net strain, %", still["net_plastic_strain_percent"][-1], still["net_plastic_strain_percent"][last - 1], 1e-3)
    check.below("change in a passage behind them, %", still["net_plastic_strain_of_passage_percent"][last:].max(), 1e-6)

    # To the same bytes: from the start on two ranks; stopped behind a jump, in a passage and between two, and on to the end on other ranks.
    bits = SHORT + ["Scene/Reproducible=true"]
    one = run(program, SCENE, path("one"), bits)
    run_stopped(program, SCENE, path("stopped"), bits, 16 * 10)
    run_stopped(program, SCENE, path("between"), bits, 9, "passages.csv")
    resumed = {}
    for name, ranks in (("stopped", 2), ("between", 3)):
        part = columns(path(name))  # it may have ended between two passages, where there is no summary
        check.that(f"{name} behind a jump", part["skipped"].sum() > 0 and len(part["passage"]) < one["passages_rolled"])
        resumed[name] = run(program, SCENE, path(name), bits, more=["--resume"], ranks=ranks)
    def bytes_of(name):
        with open(os.path.join(path(name), "passages.csv"), "rb") as stream:
            return stream.read()

    for ranks in (1, 2):
        run(program, SCENE, path(f"first-{ranks}"), [*bits, "Motion/Passages=4"], ranks)
    check.that("four passages on two ranks: passages.csv to the last byte", bytes_of("first-1") == bytes_of("first-2"))
    for name, of in resumed.items():
        check.that(f"{name}: the mesh does not depend on the ranks", of["cells"] == one["cells"])
        check.that(f"{name}: passages.csv to the last byte", bytes_of(name) == bytes_of("one"))
        for key in ("net_plastic_strain", "net_plastic_strain_error_estimate", "passages_rolled", "passages_left_out", "normal_force_N"):
            check.that(f"{name}: {key} to the last bit", of[key] == one[key])

    # It ends where the steel fails.
    limit = 0.5 * (all_of["net_plastic_strain_percent"][2] + all_of["net_plastic_strain_percent"][3])
    failed = run(program, SCENE, path("failed"), ROLLED + ["Motion/Passages=20", f"Ratcheting/Strain at failure (%)={limit:.6f}"])
    check.that("the fourth passage reaches the strain at failure", failed["passages_to_failure"] == failed["passages_rolled"] == failed["passages"] == 4 and failed["completed"] and "passages_to_failure" not in rolled)

    # What cannot be had, and what has no effect.
    check.refused("a dip", program, SCENE, path("refused"), COARSE + ["Defect/Shape=dip", "Defect/Length (mm)=10", "Defect/Depth (mm)=0.05"], ["alike along its"])
    for words, setting in (("several 'Motion/Passages'", "Motion/Passages=1"), ("a rail that yields", "Rail/Yield stress (MPa)=0"), ("'Damage/Record'", "Damage/Record=true"),
                           ("'Ratcheting/Rolled between jumps'", "Ratcheting/Rolled between jumps=1000"),
                           ("Rolled between jumps", "Ratcheting/Rolled between jumps=2"), ("Irregularity", "Ratcheting/Irregularity (%)=-1"),
                           ("Strain of a jump", "Ratcheting/Strain of a jump (%)=50"), ("Longest jump", "Ratcheting/Longest jump=1")):
        check.refused(setting, program, SCENE, path("refused"), COARSE + [setting], [words])
check.exit()
