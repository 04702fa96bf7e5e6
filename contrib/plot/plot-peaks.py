#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The largest von Mises stress over depth, as `Peak stress/Region` recorded it in each run, and those at the surface.

    plot-peaks.py RUN [RUN ...] [--names "10 mm, sharp" ...] [--strength 900] [--output peaks.png]

Lines and filled marks: layers of cells, and the nodes of the surface. Open marks: the middles of its faces.
"""

from __future__ import annotations

from tread import Run
from tread.commands import command_parser, run_command
from tread.pictures.peaks import draw_peaks
from tread.plots import save, use_style


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("runs", metavar="RUN", nargs="+")
    parser.add_argument("--names", nargs="*", default=[], help="of the runs, for the legend")
    parser.add_argument("--strength", metavar="MPA", type=float, help="a line at this stress")
    parser.add_argument("--output", default="peaks.png")
    arguments = parser.parse_args()
    use_style()
    save(draw_peaks([Run(folder) for folder in arguments.runs], arguments.names, arguments.strength), arguments.output)


if __name__ == "__main__":
    run_command(main)
