#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""tread modes: files and columns for a wheel on a track, the same on one rank and on three, and bad input."""

import cmath
import csv
import math
import os
import sys
import tempfile

from tread.runs import arguments_of
from loaded_once import execute_often, execute_on
from tread_runner import Check, rows_of, run

program = sys.argv[1]
check = Check()
# A sector on a bar of four spans, as wide as cells of 20 mm fit.
SCENE = "tutorial/track.prm"
COARSE = ["Rail/Block width (mm)=80", "Mesh/Finest cell (mm)=2.5", "Mesh/Coarsest cell (mm)=50", "Rail/Begin (mm)=-1350", "Rail/Length (mm)=2400", "Mesh/Fine half width (mm)=10"]
SHARES = ["rail_share", "sleeper_share", "rim_share", "web_share", "hub_share", "sprung_share"]

with tempfile.TemporaryDirectory() as folder:
    def modes(output, ranks=1, *more):
        arguments = arguments_of(SCENE, COARSE, output, "modes") + ["--up-to", "1500", *more]
        return execute_on(ranks, arguments, program)

    def words_of(path):
        with open(os.path.join(path, "modes.csv"), encoding="utf-8") as stream:
            return list(csv.DictReader(stream))

    one, three = os.path.join(folder, "one"), os.path.join(folder, "three")
    for path, ranks in ((one, 1), (three, 3)):
        result = modes(path, ranks)
        print(result.stdout, result.stderr)
        check.that(f"{ranks} rank(s): it ends well", result.returncode == 0)
    rows, parallel = words_of(one), words_of(three)
    check.that("columns begin with number, frequency, body", list(rows[0])[:3] == ["number", "frequency_Hz", "body"])
    check.that("each row has as many entries as there are headings, whatever commas are in its words",
               all(None not in row and None not in row.values() for row in rows) and any(row["description"] == "rail, vertical" for row in rows))
    check.that("bodies", {row["body"] for row in rows} == {"wheel", "wheel_on_suspension", "track"})
    check.that("as many modes on three ranks", len(rows) == len(parallel))
    number = lambda row, name: float(row[name])
    check.below("frequencies on three ranks, relative; without rigid motions",
                max(abs(number(b, "frequency_Hz") / number(a, "frequency_Hz") - 1) for a, b in zip(rows, parallel)
                    if number(a, "frequency_Hz") > 0.05), 1e-6)
    check.below("shares of the kinetic energy by part sum to 1", max(abs(sum(number(row, s) for s in SHARES) - 1) for row in rows), 1e-6)
    check.below("by direction", max(abs(sum(number(row, f"{d}_share") for d in ("vertical", "lateral", "longitudinal")) - 1)
                                    for row in rows), 1e-6)
    free = [row for row in rows if row["body"] == "wheel"]
    # The hub moves in the plane: along, up and turning.
    check.that("three rigid motions of the wheel", [row["description"] for row in free].count("rigid motion") == 3)
    check.below("their frequencies, Hz", max(number(row, "frequency_Hz") for row in free[:3]), 5e-3)
    # 900 kg under 11 006 kg on 880 kN/m.
    suspension = next(row for row in rows if row["body"] == "wheel_on_suspension" and number(row, "frequency_Hz") > 1)
    check.relative("on its suspension, Hz", number(suspension, "frequency_Hz"),
                   (880e3 * (1 / 900 + 1 / 11006)) ** 0.5 / (2 * 3.14159265), 1e-3)

    lines, again = rows_of(one, "receptance.csv"), rows_of(three, "receptance.csv")
    check.below("receptance on three ranks, relative", max(abs(a["rail_magnitude_m_per_N"] / b["rail_magnitude_m_per_N"] - 1)
                                                           for a, b in zip(lines, again)), 1e-5)
    # Far below the first resonance but for the suspension: the weight of the wheel, in opposite phase.
    low = lines[7]
    check.relative("wheel at 30 Hz: that of its mass, 1/(m omega^2)", low["wheel_magnitude_m_per_N"],
                   1 / (900 * (2 * 3.14159265 * low["frequency_Hz"]) ** 2), 0.05)
    check.relative("wheel at 30 Hz: in opposite phase, degrees", abs(low["wheel_phase_degrees"]), 180., 0.02)
    check.that("the rail's motion passes a quarter of a turn behind the force at its first resonance",
               lines[0]["rail_phase_degrees"] > -60. and min(row["rail_phase_degrees"] for row in lines) < -120.)
    # Between equal roughness and force: the contact spring, and wheel and rail without the dents that the discs press into
    # them, each of which is in the contact spring already (Johnson 1985, section 3.4: mean of an evenly loaded disc).
    half_space = run(program, SCENE, os.path.join(folder, "half_space"), COARSE, command="reference")
    spring = 1.5 * half_space["normal_force_N"] / half_space["approach_m"]
    dents = 2 * 16 * (1 - 0.28**2) / (3 * math.pi**2 * 15e-3 * 210e9)
    for row in (lines[100], lines[300]):
        moves = sum(row[f"{body}_magnitude_m_per_N"] * cmath.exp(1j * math.radians(row[f"{body}_phase_degrees"])) for body in ("wheel", "rail"))
        check.relative(f"contact force for a roughness at {row['frequency_Hz']:.0f} Hz, kN/mm", 1e-6 * row["contact_force_N_per_m"],
                       1e-6 / abs(1 / spring + moves - dents), 0.02)
    files = sorted(os.listdir(one))
    check.that("the files", files == sorted(["modes.csv", "modes.pvd", "parameters.prm", "receptance.csv"] +
                                            [f"modes-{k:04d}.vtu" for k in range(1, len(rows) + 1)]))

    # Bad input: one line, no files.
    def must_fail(what, arguments, words, command="modes"):
        output = os.path.join(folder, "bad")
        result = execute_often([*arguments_of(SCENE, COARSE, output, command), *arguments], program)
        said = result.stderr.strip().splitlines()
        print("   ", *said)
        check.that(f"{what}: one line that names it, exit code 1, nothing written",
                   result.returncode == 1 and len(said) == 1 and all(word in said[0] for word in words) and not os.path.exists(output))

    must_fail("no frequency", ["--up-to", "0"], ["--up-to 0", "between"])
    must_fail("nan", ["--up-to", "nan"], ["--up-to", "between"])
    must_fail("no number", ["--up-to", "high"], ["--up-to", "high"])
    must_fail("of a run", ["--up-to", "500"], ["--up-to", "modes"], command="run")
    for moving, words in (("co-running", "moves on with the wheel"), ("beam", "waves leave along the beam")):
        must_fail(f"on a base that moves: {moving}", [word for setting in (f"Track/Foundation={moving}", "Rail/Shape=head", "Track/Sleepers=mass") for word in ("-s", setting)],
                  [f"'Track/Foundation' {moving}", words])
    must_fail("with --resume", ["--resume"], ["--resume", "tread modes --help"])

check.exit()
