#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A round wheel in a groove of nearly its radius, rolled with finite elements at several cell sizes, beside the half-space.

    groove-table.py [--profiles]

Prints the table of doc/kinematics.md, in some minutes on two cores. The creepage at which no longitudinal force acts is found by the
secant through two runs. With --profiles it only writes the profiles of prm/curves/profiles anew.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping, Sequence
from typing import Tuple

import numpy as np

from tread.commands import command_parser, run_command
from tread.runs import ROOT, run

SCENE = "curves/groove.prm"
LOAD = 10e3  # N
WHEEL_RADIUS, HALF_ARC = 10., 55.  # of the arc across, mm; degrees to both sides
# groove's radius, mm: (creepages about free rolling, cells in mm)
GROOVES = {10.25: ((2e-4, 3e-4), (0.42, 0.3, 0.21)), 10.05: ((6e-4, 8e-4), (0.42, 0.3, 0.21)), 10.02: ((8e-4, 1.1e-3), (0.42, 0.3, 0.21))}

# y and z, mm.
Point = Tuple[float, float]


def polygon(points: Sequence[Point], longest: float) -> list[Point]:
    """Points of a polygon's sides, at most so many mm apart."""
    result = [points[0]]
    for (y0, z0), (y1, z1) in zip(points[:-1], points[1:]):
        n = int(np.ceil(np.hypot(y1 - y0, z1 - z0) / longest))
        result += [(y0 + (y1 - y0) * k / n, z0 + (z1 - z0) * k / n) for k in range(1, n + 1)]
    return result


def arc(radius: float) -> list[Point]:
    angles = np.radians(np.arange(-HALF_ARC, HALF_ARC + 0.5))
    return list(zip(radius * np.sin(angles), radius * (1. - np.cos(angles))))


def ridge() -> list[Point]:
    """The wheel's profile, z up: arc, tangents, a plane above, and a flange far beside the groove's block."""
    around = arc(WHEEL_RADIUS)
    end = around[-1][0] + (9. - around[-1][1]) / np.tan(np.radians(HALF_ARC))
    return [*polygon([(-70, -10), (-68, -28), (-38, -28), (-36, 9), (-end, 9)], 1.), *polygon([(-end, 9), around[0]], 0.2)[1:], *around[1:],
            *polygon([around[-1], (end, 9)], 0.2)[1:], *polygon([(end, 9), (25, 9)], 1.)[1:]]


def groove(radius: float) -> list[Point]:
    """The rail's, z up: a plane with a gauge face 30 mm beside the middle of its groove, whose edges are rounded: splines overshoot corners."""
    around = arc(radius)
    slope, edge, corner = np.radians(HALF_ARC), 2., 5.
    outside, top = around[-1][0] + edge * np.sin(slope), around[-1][1] + edge * (1. - np.cos(slope))
    falling = [(outside - edge * np.sin(t), top - edge * (1. - np.cos(t))) for t in slope * np.linspace(0.9, 0., 10)]
    edges = falling, [(-y, z) for y, z in falling[::-1]]
    rounded = [(-30 + corner * (1. - np.cos(t)), top - corner * (1. - np.sin(t))) for t in np.radians(np.arange(0., 90.5, 1.5))]
    return [*polygon([(-30, top - 30), rounded[0]], 0.5), *rounded[1:], *polygon([rounded[-1], edges[1][0]], 0.5)[1:], *edges[1][1:], *around,
            *edges[0], *polygon([edges[0][-1], (30, top), (30, top - 30)], 0.5)[1:]]


def write_profiles() -> None:
    for name, points, what in [("ridge-10", ridge(), "Wheel with an arc of 10 mm for its tread")] + [
            (f"groove-{radius}", groove(radius), f"Rail with a groove of {radius} mm") for radius in GROOVES]:
        with open(os.path.join(ROOT, "prm/curves/profiles", name + ".txt"), "w", encoding="utf-8") as file:
            file.write(f"# {what}: y and z, mm, z up; by contrib/plot/groove-table.py --profiles.\n")
            file.writelines(f"{y:.7f} {z:.7f}\n" for y, z in points)


def free_rolling(radius: float, creepages: Sequence[float], settings: Mapping[str, object], command: str = "run",
                 ranks: int = 2) -> tuple[float, dict]:
    """(creepage, run's summary) without longitudinal force: the secant through two runs, then a third one there, under the load that
    makes the vertical force LOAD: tractions of conformal contact carry some of it, which the start does not know."""
    def at(creepage: float, load: float = LOAD) -> dict:
        with tempfile.TemporaryDirectory() as folder:
            return run(SCENE, {**settings, "Rail/Measured head": os.path.join(ROOT, f"prm/curves/profiles/groove-{radius}.txt"), "Motion/Creepage": creepage,
                               "Vehicle/Sprung mass (kg)": load / 9.81 - 900., "Output/Write volume": False}, ranks=ranks, output=os.path.join(folder, "run"), command=command).summary
    runs = [at(creepage) for creepage in creepages]
    forces = [summary["longitudinal_force_N"] for summary in runs]
    free = creepages[0] - forces[0] * (creepages[1] - creepages[0]) / (forces[1] - forces[0])
    return free, at(free, LOAD * LOAD / runs[0]["normal_force_N"])


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("--profiles", action="store_true", help="write the profiles and stop")
    if parser.parse_args().profiles:
        write_profiles()
        return
    print("| groove, mm | | creepage, 1e-3 | FX, N | FN, kN | FY in the track, N | p_max, MPa | area, mm2 | length, mm | width, mm | friction, W | residual |\n"
          "|---|---|---|---|---|---|---|---|---|---|---|---|")

    def line(radius: float, name: str, found: tuple[float, dict]) -> None:
        creepage, summary = found
        patch, residual = summary["patches"][0], summary.get("energy_residual_of_dissipated")
        print(f"| {radius} | {name} | {1e3 * creepage:.4f} | {summary['longitudinal_force_N']:.1f} | {1e-3 * patch['normal_force_N']:.3f} | "
              f"{summary['lateral_force_N']:.1f} | {1e-6 * patch['max_pressure_Pa']:.1f} | {1e6 * patch['area_m2']:.2f} | "
              f"{1e3 * patch['length_m']:.2f} | {1e3 * patch['width_m']:.2f} | {summary['frictional_power_W']:.2f} | "
              + ("" if residual is None else f"{100 * residual:+.3f} %") + " |", flush=True)

    for radius, (creepages, cells) in GROOVES.items():
        line(radius, "half-space", free_rolling(radius, creepages, {}, "reference", 1))
        for cell in cells:
            line(radius, f"cells of {cell:g} mm", free_rolling(radius, creepages, {"Mesh/Finest cell (mm)": cell}))
        for name, changed in (("blocks half as large again", {"Wheel/Sector width (mm)": 50, "Wheel/Sector thickness (mm)": 45}),):
            line(radius, f"cells of {cells[1]:g} mm, {name}", free_rolling(radius, creepages, {"Mesh/Finest cell (mm)": cells[1], **changed}))


if __name__ == "__main__":
    run_command(main)
