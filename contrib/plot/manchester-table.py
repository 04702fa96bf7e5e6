#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Manchester contact benchmark, case A-2.2: all given positions of both wheels by tread's half-space solver, beside those of CONTACT.

    manchester-table.py [--set "Section/Name=value"]...
    manchester-table.py --finite-elements [--sizes 3] [--set ...]

Prints the tables of doc/kinematics.md. With --finite-elements a wheel is rolled through seven of the positions, on meshes whose cells
under the patch are 1/3.5 of its smaller half length and then 0.7 times as large each time; the table compares them with the
half-space. Forces act on the wheel in contact axes, each wheel's lateral axis pointing to its own side.
Differences: of forces over those of CONTACT, or in N where they are more than 1 % of them; of the place in um; of the largest pressure in %.
"""

from __future__ import annotations

from collections.abc import Mapping

from tread.commands import command_parser, run_command
from tread.manchester import positions, roll, solve

# Of the tread, the root of the flange, and the flange; the others are like their neighbours.
ROLLED = (("left", 4), ("left", 8), ("right", 2), ("right", 4), ("right", 6), ("right", 8), ("right", 10))
CELLS_IN_HALF_LENGTH = 3.5


def force_text(computed: float, reference: float) -> str:
    difference = computed - reference
    small = abs(difference) > 0.01 * abs(reference)
    return f"{computed + 0.:.0f} | {reference + 0.:.0f} | " + (f"{difference:+.0f} N" if small else f"{100 * (computed / reference - 1):+.2f} %")


def half_space_table(more: Mapping[str, str]) -> None:
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


def finite_element_table(sizes: int, more: Mapping[str, str]) -> None:
    print("| wheel | y_ws, mm | angle | cell, mm | cells | FN, N | half-space | FX, N | half-space | FS, N | half-space | p_max, MPa | half-space | "
          "residual |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    for side, shift, settings, _ in positions():
        if (side, shift) not in ROLLED:
            continue
        patch = solve(side, {**settings, **more})["patches"][0]
        largest = 1e3 * min(patch["length_m"], patch["width_m"]) / 2 / CELLS_IN_HALF_LENGTH
        for k in range(sizes):
            cell = float(f"{largest / 2**(k / 2):.2g}")
            summary = roll({**settings, **more}, cell)
            own, other = summary["patches"][0], summary["half_space_patches"][0]
            # The size of the tangential force says little about that of a small component.
            tangential = sum(other[name]**2 for name in ("longitudinal_force_N", "lateral_force_N"))**0.5
            text = lambda name, scale: f"{own[name]:.0f} | {100 * (own[name] - other[name]) / scale:+.2f} %"
            print(f"| {side} | {shift:g} | {57.29578 * other['angle_rad']:.1f} | {cell:g} | {summary['cells']} | "
                  f"{text('normal_force_N', other['normal_force_N'])} | {text('longitudinal_force_N', tangential)} | "
                  f"{text('lateral_force_N', tangential)} | {1e-6 * own['max_pressure_Pa']:.1f} | "
                  f"{100 * (own['max_pressure_Pa'] / other['max_pressure_Pa'] - 1):+.2f} % | "
                  f"{100 * summary['energy_residual_of_dissipated']:+.3f} % |", flush=True)


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("--set", action="append", default=[], metavar="SETTING", help="a further setting for all positions")
    parser.add_argument("--finite-elements", action="store_true", help="roll, and compare with the half-space")
    parser.add_argument("--sizes", type=int, default=3, help="numbers of sizes of cells (3)")
    arguments = parser.parse_args()
    more = dict(setting.split("=", 1) for setting in arguments.set)
    if arguments.finite_elements:
        finite_element_table(arguments.sizes, more)
    else:
        half_space_table(more)


if __name__ == "__main__":
    run_command(main)
