#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Error measures of a run of tread against CONTACT or the half-space solution: tread/comparison.py."""

from __future__ import annotations

import json
import os

from tread import comparison
from tread.commands import command_parser, run_command

LINES = (("largest pressure", "max_pressure_relative_difference", "{:+.2%}"),
         ("pressure, RMS over largest", "pressure_rms_over_max", "{:.2%}"),
         ("largest shear stress", "max_shear_relative_difference", "{:+.2%}"),
         ("shear stress, RMS over largest", "shear_rms_over_max", "{:.2%}"),
         ("adhesion share", "adhesion_share_difference_points", "{:+.2f} points"),
         ("largest micro-slip", "max_slip_relative_difference", "{:+.2%}"),
         ("micro-slip, RMS over largest", "micro_slip_rms_over_max", "{:.2%}"),
         ("the same, at one instant", "micro_slip_rms_over_max_instant", "{:.2%}"),
         ("largest slip in adhesion", "max_slip_in_adhesion_m_per_s", "{:.1e} m/s"),
         ("isolated adhesion nodes", "isolated_adhesion_nodes", "{}"),
         ("normal force", "normal_force_relative_difference", "{:+.2%}"),
         ("traction coefficient", "traction_coefficient_difference", "{:+.4f}"),
         ("creepage at this traction", "creepage_at_this_traction_relative_difference", "{:+.2%}"),
         ("ripple of the normal force, 10 mm", "normal_force_ripple_last_10_mm", "{:.2%}"),
         ("ripple of the traction, 10 mm", "traction_ripple_last_10_mm", "{:.2%}"))


def main() -> None:
    parser = command_parser(comparison.__doc__)
    parser.add_argument("run", metavar="RUN_DIR")
    parser.add_argument("contact", metavar="CONTACT.csv", nargs="?",
                        help="surface file of CONTACT, also .csv.gz; without it the run's half-space solution")
    parser.add_argument("--scale", metavar="S", type=float, default=1.0, help="of CONTACT's load; the default is 1")
    parser.add_argument("--json", metavar="FILE", help="write the measures to this file too")
    arguments = parser.parse_args()
    result = comparison.compare(arguments.run, arguments.contact, arguments.scale)
    reference = os.path.basename(arguments.contact or "reference_patch.csv")
    print(f"{arguments.run} against {reference}: {result['nodes_in_contact']} nodes in "
          f"contact, {result['node_distance_mm']:.3g} mm apart, shifted by "
          f"({result['shift_x_mm']:.3f}, {result['shift_y_mm']:.3f}) mm")
    for label, key, template in LINES:
        if key in result:
            print(f"  {label:34s} {template.format(result[key])}")
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as stream:
            json.dump(result, stream, indent=2)
            stream.write("\n")


if __name__ == "__main__":
    run_command(main)
