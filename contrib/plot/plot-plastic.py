#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw an elasto-plastic run beside its elastic twin: what figures 3.2.3 to 3.2.17 of the thesis show.

    plot-plastic.py PLASTIC_DIR ELASTIC_DIR [--output DIR]

Both runs need 'Output/Table depth (mm)' above 0. Writes pictures and prints the figures of merit:
  plastic-patch.png     outlines of patch and adhesion area, pressure along and across the patch, shear, micro-slip
  plastic-material.png  settlement, plastic strain by depth, von Mises at 0.7 mm depth
"""

from __future__ import annotations

from tread.commands import command_parser, run_command
from tread.pictures import save_all
from tread.pictures.plastic import Tables, figures_of, table_lines


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("plastic")
    parser.add_argument("elastic")
    parser.add_argument("--output", help="folder of the pictures; default: PLASTIC_DIR/pictures")
    parser.add_argument("--behind", type=float, default=-25.0, help="x (mm) where what remains is read")
    arguments = parser.parse_args()
    plastic, elastic = Tables(arguments.plastic), Tables(arguments.elastic)
    save_all(figures_of(plastic, elastic), arguments.output or plastic.path("pictures"))
    print("\n".join(table_lines(plastic, elastic, arguments.behind)))


if __name__ == "__main__":
    run_command(main)
