#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fill the table of doc/verification.md with the largest von Mises stress by depth on a smooth rail, as peak_stress.csv has it, beside the
half-space under the run's own patch at as many instants as fall into the same part of the way: both are the largest that nodes of this mesh meet
while the narrow peak where slip begins passes between them.

With --run, what has no results yet is run first: prm/verification/half-space-0.63-mu0.30.prm with several cells and traction coefficients.
"""

from __future__ import annotations

import os

from tread.commands import command_parser, run_command
from tread.files import is_complete, read_table
from tread.measured_runs import run_scene
from tread.patches import read_patches
from tread.runs import ROOT
from tread.subsurface import HalfSpace
from tread.tables import fill, markdown

SCENE = "verification/half-space-0.63-mu0.30.prm"
CELLS = (1.1, 0.63)
TRACTIONS = (0.0, 0.26, 0.3, 0.5)
LAYERS = 4  # below the surface


def folder(results: str, cell: float, traction: float) -> str:
    return os.path.join(results, f"surface-stress-{cell:g}-{traction:g}")


def run(results: str, cell: float, traction: float) -> None:
    # The patch slips as a whole where the friction coefficient is all that is used of it.
    settings = {"Mesh/Finest cell (mm)": cell, "Peak stress/Region": "range", "Peak stress/From (mm)": -12, "Peak stress/To (mm)": -6,
                "Output/Patch interval (mm)": round(cell / 3, 3), "Output/Write volume": "false", "Motion/Traction coefficient": min(traction, 0.495)}
    run_scene(SCENE, folder(results, cell, traction), settings, ranks=1)


def differences(of_run: str) -> list[tuple[float, float, float]]:
    """(depth in mm, largest von Mises stress in MPa, its difference from the half-space in %) from the surface downwards."""
    # The part of the way on which peaks are recorded is 6 mm long.
    instants = read_patches(os.path.join(of_run, "patches.csv"))
    last = [instant for instant in instants if instant.patch.centroid()[0] > instants[-1].patch.centroid()[0] - 6]
    half_spaces = [HalfSpace(instant.patch) for instant in last]
    peaks = read_table(os.path.join(of_run, "peak_stress.csv"), ("depth_mm", "von_mises_MPa"))
    found = []
    for depth, value in list(zip(peaks["depth_mm"], peaks["von_mises_MPa"]))[:1 + LAYERS]:
        found.append((float(depth), float(value), 100.0 * (float(value) / max(under.largest_von_mises(float(depth)) for under in half_spaces) - 1.0)))
    return found


def table(results: str) -> str | None:
    rows = []
    for cell in CELLS:
        for traction in TRACTIONS:
            of_run = folder(results, cell, traction)
            if not is_complete(of_run):
                print(f"note: no results in {of_run}")
                continue
            cells = [f"{value:.0f} ({difference:+.1f} %)" for _, value, difference in differences(of_run)]
            rows.append([f"{cell:g}", f"{traction:g}"] + cells + ["-"] * (1 + LAYERS - len(cells)))
    if not rows:
        return None
    return markdown(["cells [mm]", "friction used", "at the surface"] + [f"layer {k + 1}" for k in range(LAYERS)], rows)


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results"))
    parser.add_argument("--run", action="store_true", help="run what has no results yet")
    arguments = parser.parse_args()
    if arguments.run:
        for cell in CELLS:
            for traction in TRACTIONS:
                run(arguments.results, cell, traction)
    text = table(arguments.results)
    if text is not None:
        fill("verification.md", "surface-stress", text)


if __name__ == "__main__":
    run_command(main)
