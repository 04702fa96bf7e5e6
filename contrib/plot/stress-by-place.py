#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Largest von Mises stress and plastic strain under parts of the wheel's path: a table for doc/squats.md.

    contrib/plot/stress-by-place.py RUN... --parts=-60:-10,-10:10,10:40,40:65

The parts are sections of the path in mm from the beginning of the defect. For each run (a folder with strip.csv, and
rail_cells.csv if the rail yields) and part the table has the largest von Mises stress that a cell under the path has seen with
its place and the depth of its centre, the same for the surface, and the largest equivalent plastic strain at
the end of the run with its place and depth, in all cells and in those of the first layer in the fine part of the mesh. Write the option with =, as the first number may be negative.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence

import numpy as np

from tread.commands import command_parser, run_command
from tread.files import DataError
from tread.runs import Run
from tread.tables import markdown

STRAIN = "equivalent_plastic_strain_percent"


def parts_of(text: str) -> list[tuple[float, ...]]:
    try:
        parts = [tuple(map(float, part.split(":"))) for part in text.split(",")]
    except ValueError:
        parts = []
    if not parts or any(len(part) != 2 or part[0] >= part[1] for part in parts):
        raise DataError(f"--parts cannot be '{text}'; such as -60:-10,-10:10 is allowed")
    return parts


def rows_of(run: Run, parts: Sequence[tuple[float, ...]]) -> Iterator[list[str]]:
    begin = float(run.parameters["Defect/Position (mm)"])
    strip = run.table("strip.csv", ("x_mm", "von_mises_MPa", "depth_mm", "surface_von_mises_MPa"))
    cells = run.table("rail_cells.csv", ("x_mm", "z_mm", STRAIN)) if run.has("rail_cells.csv") else None
    # Centres of the first layer lie half a finest cell deep, those of the second one and a half, below the defect's surface.
    first_layer = float(run.parameters["Mesh/Finest cell (mm)"])
    for first, last in parts:
        inside = (strip["x_mm"] >= begin + first) & (strip["x_mm"] < begin + last)
        row = [os.path.basename(os.path.normpath(run.folder)), f"{first:g} to {last:g}"]
        if not inside.any():
            yield row + ["-"] * 4
            continue
        part = {name: column[inside] for name, column in strip.items()}
        most, top = part["von_mises_MPa"].argmax(), part["surface_von_mises_MPa"].argmax()
        row += [f"{part['von_mises_MPa'][most]:.0f} at {part['x_mm'][most] - begin:.1f}, {part['depth_mm'][most]:.2f} deep",
                f"{part['surface_von_mises_MPa'][top]:.0f} at {part['x_mm'][top] - begin:.1f}"]
        if cells is None:
            yield row + ["-"] * 2
            continue
        in_part = (cells["x_mm"] >= begin + first) & (cells["x_mm"] < begin + last)
        yield row + [strain_of(cells, chosen, begin) for chosen in (in_part, in_part & (-cells["z_mm"] < first_layer))]


def strain_of(cells: dict[str, np.ndarray], chosen: np.ndarray, begin: float) -> str:
    """The largest plastic strain of the chosen cells, with its place and depth in the undeformed rail."""
    values = np.where(chosen, cells[STRAIN], 0.0)
    i = values.argmax()
    return f"{values[i]:.3f} at {cells['x_mm'][i] - begin:.1f}, {-cells['z_mm'][i]:.2f} deep" if values[i] > 0.0 else "0"


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("runs", nargs="+", metavar="RUN")
    parser.add_argument("--parts", required=True, help="sections of the path, mm from the beginning of the defect")
    arguments = parser.parse_args()
    parts = parts_of(arguments.parts)
    runs = [Run(folder) for folder in arguments.runs]
    rows = [row for run in runs for row in rows_of(run, parts)]
    print(markdown(["run", "part of the path, mm", "von Mises stress, MPa", "at the surface, MPa", "plastic strain, %", "in the first layer, %"], rows))
    print("version: " + ", ".join(sorted({run.summary["version"] for run in runs})))


if __name__ == "__main__":
    run_command(main)
