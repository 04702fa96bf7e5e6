#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reproducible runs on 1, 2, 3 and 4 ranks: are all tables and figures the same to the last bit?

Four scenes with coarse cells run on each number of ranks; all their tables are compared by bytes, and the numbers of summary.json, with those of one rank.
Fills a table of doc/stability.md. --cost measures instead what the option costs the shipped scenes, with and without it in turn, on an idle machine.
"""

import os
import re

from tread.commands import command_parser, run_command
from tread.differences import figures_of, other_bits
from tread.measured_runs import in_turn, run_scene
from tread.runs import ROOT, Run
from tread.tables import fill, markdown, number, provenance

RANKS = (1, 2, 3, 4)
SMOOTH, TRACK = "smooth-rolling.prm", "tutorial/track.prm"
COARSE = {"Mesh/Finest cell (mm)": 2.6, "Motion/Rolled distance (mm)": 6, "Output/Write volume": False, "Output/Surface interval (mm)": 2}
SCENES = {
    "smooth": (SMOOTH, {**COARSE, "Time stepping/Levels": 1}),
    "smooth, two levels": (SMOOTH, {**COARSE, "Time stepping/Levels": 2}),
    "plastic, two wheels one after the other": (SMOOTH, {**COARSE, "Time stepping/Levels": 1, "Motion/Passages": 2, "Rail/Yield stress (MPa)": 500,
                                                         "Wheel/Yield stress (MPa)": 500}),
    "track": (TRACK, {"Motion/Rolled distance (mm)": 6, "Output/History interval (mm)": 0.25, "Output/Surface interval (mm)": 2}),
}


def compared(name, results):
    """(row of the table, summaries)"""
    scene, settings = SCENES[name]
    runs = {}
    for ranks in RANKS:
        folder = os.path.join(results, re.sub(r"\W+", "-", f"{name} {ranks}"))
        run_scene(scene, folder, {**settings, "Scene/Reproducible": True}, ranks)
        runs[ranks] = Run(folder)
    one = runs[1]
    differ = [", ".join(other_bits(run, one)) or "none" for ranks, run in runs.items() if ranks > 1]
    tables = [table for table in os.listdir(one.folder) if table.endswith(".csv")]
    return [name, str(one.summary["cells"]), str(one.summary["steps"]), str(len(tables)), str(len(one.history["time_s"])),
            str(len(figures_of(one.summary))), *differ], [run.summary for run in runs.values()]


def cost(results, turns):
    """A table for the screen: seconds without and with the option, the least of so many turns."""
    def run(scene, ranks, reproducible, turn):
        folder = os.path.join(results, re.sub(r"\W+", "-", f"cost {scene} {ranks} {reproducible} {turn}"))
        return run_scene(scene, folder, {"Scene/Reproducible": reproducible}, ranks)

    rows = []
    for scene in (SMOOTH, TRACK):
        for ranks in (1, 2):
            plain, same = in_turn(turns, {reproducible: lambda turn, chosen=reproducible: run(scene, ranks, chosen, turn) for reproducible in (False, True)}).values()
            rows.append([scene, str(ranks), number(plain["seconds"]), number(same["seconds"]), number(same["seconds"] / plain["seconds"]),
                         *(number(same[key] / plain[key]) for key in ("wall_s_internal_forces", "wall_s_contact"))])
    return markdown(["scene", "ranks", "seconds", "seconds, reproducible", "ratio", "of internal forces", "of contact"], rows)


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/bits"))
    parser.add_argument("--cost", type=int, metavar="TURNS", help="print what the option costs, the least of so many turns")
    arguments = parser.parse_args()
    if arguments.cost:
        print(cost(arguments.results, arguments.cost))
        return 0
    rows, summaries = [], []
    for name in SCENES:
        row, of_runs = compared(name, arguments.results)
        print(" | ".join(row), flush=True)
        rows.append(row)
        summaries += of_runs
    fill("stability.md", "bits", markdown(["scene", "cells", "steps", "tables", "rows of the history", "figures of the summary",
                                           *(f"other bits on {ranks} ranks" for ranks in RANKS[1:])], rows) + "\n\n" + provenance("benchmarks/bits.py", summaries))
    return 1 if any(cell != "none" for row in rows for cell in row[-len(RANKS) + 1:]) else 0


if __name__ == "__main__":
    run_command(main)
