#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of wheels that cross a defect, and of what reaches the supports: figures 4.1.8 to 4.1.12 and 4.3.6 to 4.3.17 of the
thesis.

    plot-impact.py RUN [RUN ...] [--smooth-twin TWIN [TWIN ...]] [--output DIR]
    plot-impact.py RUN --zimmermann

Written to RUN/pictures (the first run's), each where its data is there:
  contact-force.png   normal force beside the static load and the twin, distances of its peaks; largest pressure, patch area
  impact-patches.png  contact pressure at instants around the largest force (needs 'Output/Patch interval (mm)')
  strip.png           largest von Mises stress that the cells under the path have seen, its depth, plastic strain
  cells.png           von Mises stress and plastic strain of the chosen cells (needs 'Output/Cells')
  residual.png        residual von Mises stress and plastic strain along the rail (needs 'Output/Table depth (mm)')
  dynamic-force.png   dynamic force of contact and the most loaded support, and their spectra
  supports.png        dynamic forces of pads and ballast at the supports, and their spectra
  distribution.png    forces of all pads and ballast supports at the instants of the largest, run beside twin
  zimmermann.png      shares of the twin's supports between two sleepers and near one, beside Zimmermann's beam
  speeds.png          of several runs: dynamic forces, their spectra, and peaks over speed

--zimmermann prints the table of the last but one and draws nothing. RUN is then a smooth one, or --smooth-twin names it.

Twins are those of the runs in the same order; one serves runs that share it. Without --smooth-twin the dynamic.csv that is there
is drawn.
"""

from __future__ import annotations

from tread.commands import command_parser, run_command
from tread.files import DataError
from tread.pictures import impact, save_all
from tread.runs import PROGRAM


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("runs", metavar="RUN", nargs="+")
    parser.add_argument("--smooth-twin", metavar="TWIN", nargs="+", default=[])
    parser.add_argument("--output", help="folder of the pictures; default: pictures/ in the first run")
    parser.add_argument("--zimmermann", action="store_true", help="print the shares of the supports beside Zimmermann's")
    parser.add_argument("--program", default=PROGRAM, help="tread itself")
    arguments = parser.parse_args()
    twins = arguments.smooth_twin
    if len(twins) not in (0, 1, len(arguments.runs)):
        raise DataError(f"{len(arguments.runs)} runs and {len(twins)} smooth twins: one for each or one for all")
    twins = (twins * len(arguments.runs) if len(twins) == 1 else twins) or [None] * len(arguments.runs)
    runs = [impact.Impact(folder, twin, arguments.program) for folder, twin in zip(arguments.runs, twins)]
    if arguments.zimmermann:
        print("\n".join(impact.zimmermann_table(run) for run in runs))
        return
    print("\n".join(save_all(impact.figures_of(runs), arguments.output or runs[0].path("pictures"))))


if __name__ == "__main__":
    run_command(main)
