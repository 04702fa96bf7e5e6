#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What it costs to keep the contact's fields on the way: a wheel on fifteen spans of track, with the table of its patch every half a
millimetre, with pictures of the surface too, and without, in turn.

Fills the table of doc/performance.md. Runs that have complete results are not repeated; remove RESULTS to measure anew.
"""

import glob
import os

from tread.commands import command_parser, run_command
from tread.measured_runs import in_turn, rolling_seconds, run_scene
from tread.runs import ROOT
from tread.tables import fill, markdown, number, provenance

SCENE = "tutorial/track.prm"
SETTINGS = {"Rail/Begin (mm)": -4350, "Rail/Length (mm)": 9000, "Motion/Start (mm)": -60, "Motion/Rolled distance (mm)": 60, "Motion/Creepage": 0,
            "Start/Tolerance": 1e-4}
KINDS = {"nothing": {},
         "the table of the patch": {"Output/Patch interval (mm)": 0.5},
         "table and pictures, vtu": {"Output/Surface interval (mm)": 0.5, "Output/Pictures": "vtu"},
         "table and pictures, xdmf": {"Output/Surface interval (mm)": 0.5, "Output/Pictures": "xdmf"}}
TURNS = 2


def size_of(folder: str, pattern: str) -> float:
    """Of the files of a folder, MB."""
    return sum(os.path.getsize(path) for path in glob.glob(os.path.join(folder, pattern))) / 1e6


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/fields-cost"))
    arguments = parser.parse_args()
    folder = lambda kind, turn: os.path.join(arguments.results, f"{list(KINDS).index(kind)}-{turn}")
    best = in_turn(TURNS, {kind: lambda turn, kind=kind: run_scene(SCENE, folder(kind, turn), {**SETTINGS, **KINDS[kind]}, 1) for kind in KINDS},
                   rolling_seconds)
    rows = []
    for kind, summary in best.items():
        sizes = {name: size_of(folder(kind, 0), pattern) for name, pattern in
                 (("patches.csv", "patches.csv"), ("run.h5", "run.h5"), ("pictures", "surface*"))}
        rows.append([kind, number(rolling_seconds(summary)), f"{100 * (rolling_seconds(summary) / rolling_seconds(best['nothing']) - 1):+.1f} %",
                     *(number(size) for size in sizes.values())])
    fill("performance.md", "fields-cost", markdown(
        ["kept every 0.5 mm", "seconds rolled", "more than without", "patches.csv, MB", "run.h5, MB", "all pictures, MB"], rows)
        + f"\n\n{provenance('benchmarks/fields-cost.py', best.values())}")


if __name__ == "__main__":
    run_command(main)
