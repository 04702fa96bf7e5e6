#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where half-space theory ends: neighbouring patches and a conformal one, rolled with finite elements, beside the half-space.

    patches-table.py

Prints the tables of doc/kinematics.md, in four minutes on two cores. Forces act on the wheel; those of a patch in its contact axes.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping

from tread.commands import command_parser, run_command
from tread.runs import run

TWO, CONFORMAL = "curves/two-patches.prm", "curves/conformal.prm"
# Depth and width of the blocks behind the surfaces, and the finest cells, mm.
BLOCKS = ((60, 120, 0.34), (60, 120, 0.24), (60, 160, 0.34), (100, 160, 0.34))
CELLS = (1.26, 0.89, 0.63, 0.44)


def summary_of(scene: str, settings: Mapping[str, object], ranks: int = 2, command: str = "run") -> dict:
    with tempfile.TemporaryDirectory() as folder:
        return run(scene, {**settings, "Output/Write volume": False}, ranks=ranks, output=os.path.join(folder, "run"), command=command).summary


def two_patches() -> None:
    print("| | FN, kN | FX, kN | p_max, MPa | FN, kN | FX, kN | p_max, MPa | FX of both, kN | friction, W |\n|---|---|---|---|---|---|---|---|---|")

    def line(name: str, summary: dict) -> None:
        cells = [f"{1e-3 * patch['normal_force_N']:.2f} | {1e-3 * patch['longitudinal_force_N']:.2f} | {1e-6 * patch['max_pressure_Pa']:.0f}"
                 for patch in summary["patches"]]
        print(f"| {name} | {' | '.join(cells)} {'| | | ' * (2 - len(cells))}| {1e-3 * summary['longitudinal_force_N']:.2f} | "
              f"{summary['frictional_power_W']:.0f} |", flush=True)

    half_space = lambda distance: summary_of(TWO, {"Wheelset/Patch distance (mm)": distance}, 1, "reference")
    line("half-space, each patch alone", half_space(8))
    line("half-space, all in one plane", half_space(30))
    for depth, width, cell in BLOCKS:
        line(f"blocks {depth} mm deep, {width} mm wide, cells of {cell:g} mm", summary_of(TWO, {
            "Wheel/Sector thickness (mm)": depth, "Wheel/Sector width (mm)": width, "Mesh/Finest cell (mm)": cell}))


def conformal() -> None:
    print("| | FN, kN | FX, kN | FS, kN | FY in the track, kN | p_max, MPa | area, mm2 | width, mm | friction, W | residual |\n"
          "|---|---|---|---|---|---|---|---|---|---|")

    def line(name: str, summary: dict, patch: dict) -> None:
        print(f"| {name} | {1e-3 * patch['normal_force_N']:.2f} | {1e-3 * patch['longitudinal_force_N']:.2f} | "
              f"{1e-3 * patch['lateral_force_N']:.2f} | {1e-3 * summary['lateral_force_N']:.2f} | {1e-6 * patch['max_pressure_Pa']:.0f} | "
              f"{1e6 * patch['area_m2']:.0f} | {1e3 * patch['width_m']:.1f} | {patch['frictional_power_W']:.0f} | ", end="")
        residual = summary.get("energy_residual_of_dissipated")
        print("|" if residual is None else f"{100 * residual:+.3f} % |", flush=True)

    half_space = summary_of(CONFORMAL, {}, 1, "reference")
    line("half-space", half_space, half_space["patches"][0])
    for cell in CELLS:
        summary = summary_of(CONFORMAL, {"Mesh/Finest cell (mm)": cell})
        line(f"cells of {cell:g} mm", summary, summary["patches"][0])


def main() -> None:
    command_parser(__doc__).parse_args()
    two_patches()
    print()
    conformal()


if __name__ == "__main__":
    run_command(main)
