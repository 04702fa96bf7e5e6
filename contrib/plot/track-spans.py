#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Differences of force histories of runs that differ in their rails: a table for doc/track.md.

    contrib/plot/track-spans.py STUDY [--from MM]

STUDY is the folder of a study (contrib/study.py). The run with the longest rail is what the others are compared with, each column
of forces over the position of the wheel from --from on (the beginning of the defect). A difference is given as its largest
value and its root mean square; the range of the reference stands in the first row.
"""

from __future__ import annotations

import glob
import os

import numpy as np

from tread.commands import command_parser, run_command
from tread.files import DataError
from tread.runs import Run

COLUMNS = {"normal_force_N": "contact", "support_1_pad_N": "pad", "support_1_ballast_N": "ballast"}


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("study")
    parser.add_argument("--from", dest="begin", type=float, default=0.0, help="position of the wheel, mm")
    arguments = parser.parse_args()
    runs = []
    for path in sorted(glob.glob(os.path.join(arguments.study, "*", "summary.json"))):
        run = Run(os.path.dirname(path))
        p = run.parameters
        length, spacing = 1e-3 * float(p["Rail/Length (mm)"]), float(p["Track/Sleeper spacing (m)"])
        ends = p["Rail/Ends"]
        if ends == "absorbing":
            ends += f", {float(p['Rail/Absorbing length (m)']):g} m"
        runs.append((length / spacing, ends, run.table("history.csv", ["position_m", *COLUMNS])))
    if len(runs) < 2:
        raise DataError(f"{arguments.study}: fewer than two complete runs")
    reference = max(runs, key=lambda run: run[0])
    x = 1e3 * reference[2]["position_m"]
    chosen = x >= arguments.begin
    print("| spans | ends | " + " | ".join(f"{name}: largest, RMS, kN" for name in COLUMNS.values()) + " |")
    print("|---|---|" + "---|" * len(COLUMNS))
    print(f"| {reference[0]:.0f} | {reference[1]} | " + " | ".join(
        f"{1e-3 * reference[2][c][chosen].min():.1f} to {1e-3 * reference[2][c][chosen].max():.1f}" for c in COLUMNS) + " |")
    for spans, ends, history in sorted((run for run in runs if run is not reference), key=lambda run: (run[1], run[0])):
        cells = []
        for column in COLUMNS:
            off = 1e-3 * (np.interp(x, 1e3 * history["position_m"], history[column]) - reference[2][column])[chosen]
            cells.append(f"{abs(off).max():.2f}, {np.sqrt(np.mean(off**2)):.2f}")
        print(f"| {spans:.0f} | {ends} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    run_command(main)
