#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw longitudinal profiles of defects, one beside the other.

    plot-defects.py FILE... [--output PICTURE]

Each file has columns x and z in mm, as the program reads them: blanks, semicolons or commas between them, comments behind #.
"""

from __future__ import annotations

from tread.commands import command_parser, run_command
from tread.pictures.mesh import draw_defects
from tread.plots import save, use_style


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--output", default="defects.png")
    arguments = parser.parse_args()
    use_style()
    save(draw_defects(arguments.files), arguments.output)


if __name__ == "__main__":
    run_command(main)
