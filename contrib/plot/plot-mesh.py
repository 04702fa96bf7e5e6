#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw the mesh of a run and the defect on its rail.

    plot-mesh.py RUN_DIR [--output DIR] [--from X --to X]

Needs the first volume picture of a run, volume-0000.vtu. Writes
  section.png   rail and wheel cut across the path, where cells are finest and at the end of the rail
  path.png      the rail's cells under the middle of the path, and the height of its top
"""

from __future__ import annotations

from tread import DataError, Run
from tread.commands import command_parser, run_command
from tread.pictures import mesh, save_all


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("run")
    parser.add_argument("--output")
    parser.add_argument("--from", dest="begin", type=float, help="x in mm of the picture along the path")
    parser.add_argument("--to", dest="end", type=float)
    arguments = parser.parse_args()
    run = Run(arguments.run)
    paths = save_all(mesh.figures(run, arguments.begin, arguments.end), arguments.output or run.path("pictures"))
    if not paths:
        raise DataError(f"{run.path(mesh.VOLUME)}: No such file; it is written with 'Output/Write volume'")
    print("\n".join(paths))


if __name__ == "__main__":
    run_command(main)
