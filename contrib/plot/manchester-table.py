#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Manchester contact benchmark, case A-2.2: all given positions of both wheels by tread's half-space solver, beside those of CONTACT.

    manchester-table.py [--set "Section/Name=value"]...

Prints the table of doc/kinematics.md. Forces act on the wheel in contact axes, each wheel's lateral axis pointing to its own side.
Differences: of forces over those of CONTACT, or in N where they are more than 1 % of them; of the place in um; of the largest pressure in %.
"""

from tread.commands import command_parser, run_command
from tread.manchester import positions, solve


def force_text(computed, reference):
    difference = computed - reference
    small = abs(difference) > 0.01 * abs(reference)
    return f"{computed + 0.:.0f} | {reference + 0.:.0f} | " + (f"{difference:+.0f} N" if small else f"{100 * (computed / reference - 1):+.2f} %")


def main():
    parser = command_parser(__doc__)
    parser.add_argument("--set", action="append", default=[], metavar="SETTING", help="a further setting for all positions")
    arguments = parser.parse_args()
    more = dict(setting.split("=", 1) for setting in arguments.set)
    print("| wheel | y_ws, mm | FN, N | CONTACT | diff. | FX, N | CONTACT | diff. | FS, N | CONTACT | diff. | place, um | p_max, MPa | "
          "CONTACT | diff. |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    for side, shift, settings, reference in positions():
        patches = solve(side, {**settings, **more})["patches"]
        if len(patches) != 1:
            print(f"| {side} | {shift:g} | {len(patches)} patches |")
            continue
        patch = patches[0]
        forces = " | ".join(force_text(patch[name], reference[name])
                            for name in ("normal_force_N", "longitudinal_force_N", "lateral_force_N"))
        place = max(abs(patch[name] - reference[name]) for name in ("x_m", "y_m"))
        pressure, given = patch["max_pressure_Pa"], reference["max_pressure_Pa"]
        print(f"| {side} | {shift:g} | {forces} | {1e6 * place:.1f} | {1e-6 * pressure:.1f} | {1e-6 * given:.1f} | "
              f"{100 * (pressure / given - 1):+.2f} % |")


if __name__ == "__main__":
    run_command(main)
