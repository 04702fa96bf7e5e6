#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Surfaces that change along the way, as the scripts solve them: a crossing and two wheel flats beside CONTACT's figures, and bad tables."""

import csv
import os
import subprocess
import sys
import tempfile

from tread.positions import rows_of
from tread.runs import ROOT, environment
from tread_runner import Check

program = sys.argv[1]
check = Check()
DATA = os.path.join(ROOT, "contrib", "contact-data")


def start(script, *arguments):
    return subprocess.run([os.path.join(ROOT, "contrib", "plot", script), *arguments, "--program", program], env=environment(), capture_output=True,
                          text=True, check=False)


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    def write(name, rows):
        with open(path(name), "w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
        return path(name)

    # Of each flat the given turns that differ most: the edge, the deepest place, one where several patches of detail carry, the round wheel.
    for flat, chosen in (("scanned", (-29, -37, -39, -49)), ("rounded", (-7, -3, 5))):
        given = [row for row in rows_of(os.path.join(DATA, "flat_given.csv")) if row["flat"] == flat and int(row["pitch_deg"]) in chosen]
        table = write("pitches.csv", [{"pitch_deg": row["pitch_deg"], "load_N": row["load_N"]} for row in given])
        done = start("flat-table.py", "--flat", flat, "--pitches", table, "--output", path("out.csv"))
        if not check.that(f"{flat} flat: the script ends well: {done.stderr.strip()}", done.returncode == 0):
            continue
        for row, answer in zip(given, rows_of(path("out.csv"))):
            name = f"{flat} flat, turned by {answer['pitch_deg']} degrees"
            check.absolute(f"{name}: the turn that was given", float(answer["pitch_deg"]), float(row["pitch_deg"]), 0.)
            check.absolute(f"{name}: height of the axle, um", 1e3 * float(answer["axle_height_mm"]), -1e3 * float(row["z_ws_mm"]), 2.)
            # Where the rounded flat ends across the tread its surface has a kink, whose pressure is that of an element.
            check.relative(f"{name}: largest pressure, MPa", 1e-6 * float(answer["max_pressure_Pa"]), float(row["max_pressure_MPa"]),
                           0.01 if flat == "scanned" else 0.03)
            # In the plane of the patch; the rail is inclined, and friction turns the force.
            check.relative(f"{name}: normal force, N", float(answer["normal_force_N"]), float(row["load_N"]), 0.02)

    given = [row for row in rows_of(os.path.join(DATA, "crossing_given.csv")) if (row["s_mm"], row["y_ws_mm"]) in (("118.5", "0.78"), ("239", "0.97"))]
    positions = []
    for row in given:
        entry = {name: row[name] for name in ("s_mm", "y_ws_mm", "load_N", "z_ws_mm")}
        if entry not in positions:
            positions.append(entry)
    done = start("crossing-table.py", "--positions", write("positions.csv", positions), "--output", path("patches.csv"))
    if check.that(f"crossing: the script ends well: {done.stderr.strip()}", done.returncode == 0):
        answers = rows_of(path("patches.csv"))
        check.that("crossing: three patches, of which one is the nose's", sorted(row["part"] for row in answers) == ["nose", "wing", "wing"])
        for row in given:
            answer = min((answer for answer in answers if float(answer["s_mm"]) == float(row["s_mm"])),
                         key=lambda answer: abs(float(answer["y_mm"]) - float(row["y_mm"])))
            name = f"crossing at {row['s_mm']} mm, y = {float(row['y_mm']):.0f} mm"
            check.relative(f"{name}: normal force, N", float(answer["normal_force_N"]), float(row["normal_force_N"]), 0.02)
            check.relative(f"{name}: largest pressure, MPa", 1e-6 * float(answer["max_pressure_Pa"]), float(row["max_pressure_MPa"]), 0.02)
            for axis in ("x", "y"):
                check.absolute(f"{name}: {axis}, mm", float(answer[f"{axis}_mm"]), float(row[f"{axis}_mm"]), 0.2)

    def must_fail(what, words, script, *arguments):
        done = start(script, *arguments)
        said = done.stderr.strip()
        check.that(f"{what} is refused in one line: {said}", done.returncode != 0 and "\n" not in said and all(word in said for word in words))

    pitches = write("pitches.csv", [{"pitch_deg": -37, "load_N": 125e3}])
    must_fail("a table without its result", ["--output"], "flat-table.py", "--pitches", pitches)
    must_fail("a table without loads", ["row 1", "load_N"], "flat-table.py", "--pitches", write("none.csv", [{"pitch_deg": 1}]), "--output", path("out.csv"))
    must_fail("a word for a number", ["row 1", "pitch_deg", "deep"], "flat-table.py", "--pitches", write("word.csv", [{"pitch_deg": "deep", "load_N": 1}]),
              "--output", path("out.csv"))
    scan = rows_of(os.path.join(ROOT, "prm", "flat", "scan.csv"))
    must_fail("radians called degrees", ["scan.csv", "along the tread"], "flat-table.py", "--pitches", pitches, "--output", path("out.csv"), "--deviation",
              write("scan.csv", [{"angle_deg": row.pop("angle_rad"), **row} for row in scan]))

check.exit()
