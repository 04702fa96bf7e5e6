#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/columns.md: the keys of summary.json and the columns of all tables with their units and meanings, as `tread columns` says them.

With --check the page is only compared; the exit code is 1 if it is not current.
"""

import json
import re

from tread.commands import run_command
from tread.runs import execute, must_end_well
from tread.tables import page_command

HEAD = """# Keys of the summary and columns of the tables

The first row of each table has the names, which end with the unit; what ends without one is a pure number. [Results](results.md) says when which table is
written. `run.h5` has the same columns, with attributes `unit` and `meaning`. In `history.csv` and `cells.csv` one support, one further wheel and one cell stand
for all: `support_0_` for the number of any support of `Output/Supports`, `wheel_2_` for any further wheel, `cell_1_` for any of `Output/Cells`. A run has only the columns that its scene gives rise to.

This page is written by `contrib/columns-page.py`.
"""
OTHERS = {"summary.json": """Figures of the run as it ends, in SI units; a scene has only some of these keys. `wheel_2_` stands for any further wheel of `Further wheels/Distances (mm)`, while plain names are those of the first one, `cell_1_` for any of `Output/Cells`,
`max_pressure_Pa` in `..._half_space_uncertainty` and under `reference` for any figure that is compared, and Hertz there for any source. Keys of sections and lists have `/` in their names, as `contrib/compare-runs.py` prints them: `patches/1/x_m` is `x_m` of the first of `patches`.
Means over the end of the path are those over the part of it that was rolled where a run ends before, or of its last step. With `tread reference` all figures are those of the half-space solution, at one instant.""",
          "patch.csv": "Likewise `patch_averaged.csv`, `reference_patch.csv` and those of further wheels, `patch_wheel_2.csv`.",
          "peak_stress.csv": "Likewise `peak_stress_wheel.csv`.",
          "wheel_profile.csv": "The wheel where it stands in the middle of the track.",
          "contact_points.csv": "`own_` and `other_` wheel are each in the axes of their own side."}


def unit_as_read(unit):
    """m/s for m_per_s, 1/m for per_m, N m for Nm"""
    return {"Nm": "N m"}.get(unit, re.sub("^per_", "1/", unit).replace("_per_", "/").replace("_", " "))


def page(tables):
    """@param tables as `tread columns` prints them"""
    text = HEAD
    for table in tables:
        text += f"\n## {table['file']}\n\n"
        if table["file"] in OTHERS:
            text += OTHERS[table["file"]] + "\n\n"
        text += f"| {'key' if table['file'].endswith('.json') else 'column'} | unit | meaning |\n|---|---|---|\n"
        for column in table["columns"]:
            text += f"| `{column['name']}` | {unit_as_read(column['unit'])} | {column['meaning']} |\n"
    return text


if __name__ == "__main__":
    run_command(lambda: page_command(__doc__, "columns.md", lambda program: page(json.loads(must_end_well(execute(["columns"], program=program)).stdout))))
