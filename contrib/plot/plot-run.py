#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw all pictures of a run for which it has the data, into RUN_DIR/pictures; the same as tread.Run(RUN_DIR).pictures().

  axis, map, vectors    the patch at the end: pressure, shear stress and micro-slip along its axis; adhesion and slip; arrows
  patches               instead of these where the wheelset has a position: each patch in its contact axes
  depth                 stress below the surface (tread reference)
  forces, energies      over the position of the wheel, and over time
  contact-force, ...    of a scene with a defect or a track: those of plot-impact.py
  crossing-...          of a wheel that crosses a defect, with patches.csv: those of plot-crossing.py
  peaks                 with 'Peak stress/Region': that of plot-peaks.py
  section, path         the mesh, with 'Output/Write volume': those of plot-mesh.py
  contact-points        tread contact-points
  wear, wear-steps      tread wear: both profiles, depths, pressure and work

Lines and borders of reference_patch.csv, the half-space answer at the same forces, are drawn beside. Shaded is the extent of the
defects. Over a defect the approach is cut to a fifth of the picture; history.csv has all of it.
"""

from __future__ import annotations

from tread import Run
from tread.commands import command_parser, run_command


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("run", metavar="RUN_DIR")
    parser.add_argument("--contact", metavar="FILE", help="surface file of CONTACT (.csv or .csv.gz) to compare with")
    arguments = parser.parse_args()
    print("\n".join(Run(arguments.run).pictures(contact=arguments.contact)))


if __name__ == "__main__":
    run_command(main)
