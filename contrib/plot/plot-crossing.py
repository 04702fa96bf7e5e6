#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What happens in the contact patch while a wheel crosses a defect: figures 5.1.7 to 5.1.9 of the thesis.

    plot-crossing.py RUN [--at MM [MM ...]] [--y MM] [--output DIR]

The run must have written patches.csv ('Output/Patch interval (mm)'). Written to RUN/pictures:
  crossing-axis.png    pressure and longitudinal shear stress along the middle of the defect, for positions of the wheel
  crossing-stress.png  pressure and shear stress over the patch when each is largest at the trailing edge
  crossing-slip.png    where the patch slips and adheres, on the smooth rail, at the edges, and between them
  crossing.json        the largest pressure and shear stress at each edge, where the wheel is then

Without --at the positions are those of the largest pressure (for the shear stress: of the largest shear stress) at each edge, one
before the defect, one over its middle and one behind it. Shear stress is that on the wheel.
"""

from __future__ import annotations

import json
import os

from tread import Error, Run
from tread.commands import command_parser, run_command
from tread.pictures import save_all
from tread.pictures.crossing import Crossing, figures_of, text_of


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("run", metavar="RUN")
    parser.add_argument("--at", type=float, nargs="+", metavar="MM", help="positions of the wheel in crossing-axis.png")
    parser.add_argument("--y", type=float, metavar="MM", help="the nearest row of nodes is drawn; default: the middle of the defect")
    parser.add_argument("--output", metavar="DIR", help="default: pictures/ in RUN")
    arguments = parser.parse_args()
    crossing = Crossing(Run(arguments.run), arguments.y)
    first, last = crossing.instants[0].position_mm, crossing.instants[-1].position_mm
    for at in arguments.at or []:
        if not first <= at <= last:
            raise Error(f"--at {at:g}: patches.csv has the wheel from {first:.1f} to {last:.1f} mm")
    folder = arguments.output or crossing.run.path("pictures")
    save_all(figures_of(crossing, arguments.at), folder)
    figures = crossing.figures()
    with open(os.path.join(folder, "crossing.json"), "w", encoding="utf-8") as stream:
        json.dump(figures, stream, indent=2)
    print(text_of(figures))


if __name__ == "__main__":
    run_command(main)
