#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheel on a bar on sleepers, 20 mm of the tutorial scene: equilibrium at the start, steady rolling, ranks, resuming."""

import json
import os
import subprocess
import sys
import tempfile

from tread.runs import arguments_of, command, environment
from loaded_once import execute_often, execute_on
from tread_runner import Check, press_ctrl_c, rows_of, run

program = sys.argv[1]
check = Check()

SCENE = "tutorial/track.prm"
SUPPORTS = range(-5, 7)
# Cells of 20 mm fit the wider bar, a fifth as many as of 10 mm.
SETTINGS = ["Rail/Block width (mm)=80", "Motion/Start (mm)=-160", "Motion/Rolled distance (mm)=20", "Output/Supports=" + ",".join(str(i) for i in SUPPORTS),
            "Contact/Tolerance=1e-12", "Rail/Ends=endless"]
LOAD = 11906. * 9.81
BALLAST = 45e6  # N/m, a support


def history(folder):
    return rows_of(folder, "history.csv")


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    one = run(program, SCENE, path("1"), SETTINGS)
    rows = history(path("1"))
    weight = 0.08 * 0.15 * 7.2 * 7800. * 9.81
    sleepers = 12 * 200. * 9.81
    first = rows[0]
    pads = sum(first[f"support_{i}_pad_N"] for i in SUPPORTS)
    ballast = sum(first[f"support_{i}_ballast_N"] for i in SUPPORTS)
    # The crown takes 0.1 % of the bar's volume.
    check.relative("pads carry wheel and rail at the start (kN)", 1e-3 * pads, 1e-3 * (LOAD + weight), 3e-3)
    check.relative("ballast carries the sleepers as well (kN)", 1e-3 * ballast, 1e-3 * (LOAD + weight + sleepers), 3e-3)
    check.relative("contact force at the start (kN)", 1e-3 * first["normal_force_N"], 1e-3 * LOAD, 5e-3)
    # The wheel passes the middle of a span, and of the rail, at x = -150 mm.
    middle = min(rows, key=lambda row: abs(row["position_m"] + 150e-3))
    check.absolute("the history begins at the start (mm)", 1e3 * first["position_m"], -159., 0.01)
    check.absolute("and ends half a cell behind the path (mm)", 1e3 * rows[-1]["position_m"], -140. + 1.25, 0.015)
    check.relative("rolled (mm)", 1e3 * one["rolled_m"], 20. + 1.25, 5e-3)
    for i in range(3):
        check.below(f"wheel at mid-span: supports {-i} and {1 + i} alike, difference over the load",
                    (middle[f"support_{-i}_pad_N"] - middle[f"support_{1 + i}_pad_N"]) / LOAD, 5e-3)
    check.below("rolling: contact force off the static load, share", max(abs(r["normal_force_N"] / LOAD - 1.) for r in rows), 0.02)
    check.energy("", one, 0.01)

    two = run(program, SCENE, path("2"), SETTINGS, ranks=2)
    for key in ("normal_force_N", "max_pressure_Pa"):
        check.absolute(f"2 ranks against 1: {key} over that of 1", two[key] / one[key], 1., 1e-9)
    check.absolute("2 ranks against 1: energy residual over what was dissipated", two["energy_residual_of_dissipated"],
                   one["energy_residual_of_dissipated"], 1e-7)
    for name in ("support_0_pad_N", "support_0_ballast_N", "support_1_rail_m"):
        check.relative(f"2 ranks against 1: {name}", history(path("2"))[-1][name], rows[-1][name], 1e-7)

    # Supports, the beam of the start and the track beyond the ends, to the last bit.
    bits = SETTINGS[:-2] + ["Rail/Ends=endless", "Scene/Reproducible=true", "Start/Tolerance=1e-3", "Motion/Rolled distance (mm)=2",
                            "Output/History interval (mm)=0.2"]
    texts = []
    for ranks in (1, 3):
        run(program, SCENE, path(f"bits-{ranks}"), bits, ranks=ranks)
        texts.append(open(os.path.join(path(f"bits-{ranks}"), "history.csv"), encoding="utf-8").read())
    check.that("reproducible: the history of 3 ranks is that of 1", texts[0] == texts[1] and texts[0].count("\n") > 10)

    process = subprocess.Popen(command(arguments_of(SCENE, SETTINGS, path("parts")), program=program), env=environment(), stdout=subprocess.DEVNULL)
    press_ctrl_c(process, os.path.join(path("parts"), "history.csv"), 5)
    process.wait(timeout=120)
    check.that("interrupted", process.returncode == 130)
    resumed = run(program, SCENE, path("parts"), SETTINGS, more=["--resume"], ranks=2)
    for name in ("support_0_pad_N", "support_0_ballast_N", "support_1_rail_m", "normal_force_N"):
        check.relative(f"resumed on 2 ranks against never stopped: {name}", history(path("parts"))[-1][name], rows[-1][name], 1e-7)
    check.energy("resumed: ", resumed, 0.01)

    # Supports of their own: under a hanging sleeper its neighbours carry the wheel.
    def with_supports(name, header, *lines, more=()):
        with open(path(name), "w", encoding="utf-8") as stream:
            stream.write("\n".join([header, *lines]) + "\n")
        return SETTINGS + [f"Track/Support file={path(name)}", "Motion/Rolled distance (mm)=1", "Contact/Tolerance=1e-9", *more]
    run(program, SCENE, path("hanging"), with_supports("hanging.csv", "support,ballast_stiffness_MN_per_m,ballast_damping_kN_s_per_m", "0,0,0"))
    hangs = history(path("hanging"))[0]
    check.below("hanging sleeper: force in its ballast, N", hangs["support_0_ballast_N"], 1e-6)
    check.relative("hanging sleeper: its weight pulls at the pad, N", hangs["support_0_pad_N"], -200. * 9.81, 0.02)
    check.relative("hanging sleeper: the others carry what all did, kN", 1e-3 * sum(hangs[f"support_{i}_ballast_N"] for i in SUPPORTS), 1e-3 * ballast, 1e-3)
    check.that("hanging sleeper: the rail sinks further there", hangs["support_0_rail_m"] < 1.2 * first["support_0_rail_m"] < 0.)
    for what, settings, *words in (
            ("a support beyond the rail", with_supports("far.csv", "support,pad_stiffness_MN_per_m", "99,100"), "Track/Support file", "99"),
            ("a support twice", with_supports("twice.csv", "support,pad_stiffness_MN_per_m", "1,100", "1,90"), "row 2", "twice"),
            ("half a support", with_supports("half.csv", "support,pad_stiffness_MN_per_m", "0.5,100"), "row 1", "whole number"),
            ("no pad", with_supports("soft.csv", "support,pad_stiffness_MN_per_m", "0,0"), "pad_stiffness_MN_per_m", "too small"),
            ("another column", with_supports("name.csv", "support,pad_stiffness", "0,100"), "pad_stiffness'"),
            ("a track without ballast", with_supports("one.csv", "support,ballast_stiffness_MN_per_m", "0,1", more=["Track/Foundation=one-layer"]), "one-layer"),
            ("no track", with_supports("rigid.csv", "support,pad_stiffness_MN_per_m", "0,100", more=["Track/Foundation=rigid"]), "Track/Foundation")):
        check.refused(what, program, SCENE, path("bad"), settings, words)

    # On elastic steel the next wheel finds what the first one found.
    two_wheels = SETTINGS[:-1] + ["Rail/Ends=absorbing", "Motion/Rolled distance (mm)=3", "Motion/Passages=2", "Contact/Tolerance=1e-9"]
    run(program, SCENE, path("passages"), two_wheels)
    first, second = rows_of(path("passages"), "passages.csv")
    check.relative("second passage: largest pressure as in the first (MPa)", second["max_pressure_MPa"], first["max_pressure_MPa"], 1e-4)
    # Forces of slow cells that the first wheel left behind made it a hundred times larger.
    check.below("second passage: energy residual over what was dissipated", abs(second["energy_residual_of_dissipated"]), 0.015)  # 0.011: work of damping is sampled
    process = subprocess.Popen(command(arguments_of(SCENE, two_wheels, path("between")), program=program), env=environment(),
                               stdout=subprocess.DEVNULL)
    press_ctrl_c(process, os.path.join(path("between"), "passages.csv"), 1)
    process.wait(timeout=120)
    check.that("interrupted between two passages", process.returncode == 130)
    run(program, SCENE, path("between"), two_wheels, more=["--resume"])
    for key in ("max_pressure_MPa", "frictional_work_J"):
        check.relative(f"resumed between two passages: {key}", rows_of(path("between"), "passages.csv")[1][key], second[key], 1e-7)

    # Half a sleeper under the pressures at the largest force of a pad, on 1 and 3 ranks.
    seats = rows_of(path("1"), "rail_seats.csv")
    of_parts = rows_of(path("parts"), "rail_seats.csv")
    check.below("seats of the resumed run, largest difference (MPa)",
                max(abs(a["pressure_MPa"] - b["pressure_MPa"]) for a, b in zip(seats, of_parts)), 1e-5)
    largest = max(max(row[f"support_{i}_pad_N"] for row in rows) for i in SUPPORTS)

    def sleeper(*more, ranks=1):
        arguments = ["sleeper-stress", path("1"), *more]
        return execute_on(ranks, arguments, program)

    solved = sleeper("--cell-size", "50")
    print(solved.stdout, solved.stderr)
    with open(os.path.join(path("1"), "sleeper_stress.json"), encoding="utf-8") as stream:
        stress = json.load(stream)
    check.that("the seats of all recorded supports are kept", {row["support"] for row in seats} == set(SUPPORTS))
    # Rows of the history are 0.25 mm apart; every step is looked at.
    check.relative("seat force over the largest of the history's rows", stress["seat_force_N"] / largest, 1., 2e-3)
    check.that("not below it", stress["seat_force_N"] >= largest * (1. - 1e-7))
    check.that("von Mises stress of some MPa", 0.3e6 < stress["max_von_mises_Pa"] < 20e6)
    # The mass of the solid sleeper and the one that the run moved are two numbers, and that they differ is said.
    check.relative("mass of the run's sleeper, kg", stress["scene_sleeper_mass_kg"], 200., 1e-12)
    check.that("another mass than the run's is said", "of the run is 200:" in solved.stdout)
    check.that("3 ranks", sleeper("--cell-size", "50", "--output", path("sleeper"), ranks=3).returncode == 0)
    with open(os.path.join(path("sleeper"), "sleeper_stress.json"), encoding="utf-8") as stream:
        check.relative("3 ranks against 1: largest von Mises stress", json.load(stream)["max_von_mises_Pa"], stress["max_von_mises_Pa"], 1e-7)
    check.that("on ballast", sleeper("--cell-size", "50", "--bottom", "ballast", "--output", path("on-ballast")).returncode == 0)
    with open(os.path.join(path("on-ballast"), "sleeper_stress.json"), encoding="utf-8") as stream:
        on_ballast = json.load(stream)
    # It bends, so that the seat sinks more than a rigid half would.
    check.relative("half a sleeper on ballast: the seat sinks by its force over the ballast's stiffness, mm",
                   1e3 * abs(on_ballast["mean_seat_settlement_m"]), 1e3 * on_ballast["seat_force_N"] / BALLAST, 0.15)
    for words, answer in ((["--support", "99"], "--support"), (["--cell-size", "-1"], "--cell-size"), (["--bottom", "sand"], "--bottom")):
        refused = sleeper(*words)
        check.that(" ".join(words) + ": " + refused.stderr.strip(), refused.returncode == 1 and answer in refused.stderr)
    refused = execute_often(["sleeper-stress", folder], program)
    check.that("a folder without seats: " + refused.stderr.strip(), refused.returncode == 1 and "rail_seats.csv" in refused.stderr)
check.exit()
