#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/columns.md: the columns of all tables with their units and meanings, as `tread --print-columns` says them.

With --check the page is only compared; the exit code is 1 if it is not current.
"""

import json

from tread.commands import run_command
from tread.runs import execute, must_end_well
from tread.tables import page_command

HEAD = """# Columns of the tables

The first row of each table has the names, which end with the unit; what ends without one is a pure number. [Results](results.md) says when which table is
written. `run.h5` has the same columns, with attributes `unit` and `meaning`. In `history.csv` and `cells.csv` one support, one further wheel and one cell stand
for all: `support_0_` for the number of any support of `Output/Supports`, `wheel_2_` for any further wheel, `cell_1_` for any of `Output/Cells`. A run has only the columns that its scene gives rise to.

This page is written by `contrib/columns-page.py`.
"""
OTHERS = {"patch.csv": "Likewise `patch_averaged.csv`, `reference_patch.csv` and those of further wheels, `patch_wheel_2.csv`.",
          "peak_stress.csv": "Likewise `peak_stress_wheel.csv`.",
          "wheel_profile.csv": "The wheel where it stands in the middle of the track.",
          "contact_points.csv": "`own_` and `other_` wheel are each in the axes of their own side."}


def page(tables):
    """@param tables as `tread --print-columns` prints them"""
    text = HEAD
    for table in tables:
        text += f"\n## {table['file']}\n\n"
        if table["file"] in OTHERS:
            text += OTHERS[table["file"]] + "\n\n"
        text += "| column | unit | meaning |\n|---|---|---|\n"
        for column in table["columns"]:
            text += f"| `{column['name']}` | {column['unit'].replace('_per_', '/').replace('_', ' ')} | {column['meaning']} |\n"
    return text


if __name__ == "__main__":
    run_command(lambda: page_command(__doc__, "columns.md", lambda program: page(json.loads(must_end_well(execute(["--print-columns"], program=program)).stdout))))
