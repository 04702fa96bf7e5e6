#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Convergence of the half-space's forces with its elements, for the page of reference solutions: spin, creepage with spin, and creepage alone.

    contrib/plot/half-space-convergence.py

Each line has elements half as large again as the next one and divides both semi-axes evenly. What the program gives beside a run is the limit
that two lines have, extrapolated with the power 1.5 of the element size under spin.
"""

from __future__ import annotations

import numpy as np

from tread import half_space, hertz
from tread.commands import command_parser, run_command

LOAD, FRICTION, YOUNG, POISSON = 127.1e3, 0.3, 210e9, 0.3
CURVATURES = (1.087, 1.667)  # 1/m
CASES = {"spin 0.115 1/m": {"spin": 0.115}, "spin 0.5 1/m": {"spin": 0.5}, "creepage -0.001, spin 0.3 1/m": {"creepage": -1e-3, "spin": 0.3},
         "creepage -0.0015": {"creepage": -1.5e-3}}
PARTS = (24, 36, 54, 81)  # elements along the semi-axis in rolling direction; two thirds of that across
ADDED = 1. / (1.5 ** 1.5 - 1.)


def semi_axes() -> tuple[float, float]:
    """Of Hertz's ellipse, m."""
    answer = half_space.solve_patch(curvature_x=CURVATURES[0], curvature_y=CURVATURES[1], normal_force=LOAD, friction=0., young=YOUNG, poisson=POISSON)
    modulus = 0.5 * YOUNG / (1. - POISSON ** 2)
    low, high = 0.1, 10.
    for _ in range(60):  # the ratio a/b by its curvatures
        ratio = np.sqrt(low * high)
        b = np.sqrt(1.5 * LOAD / (np.pi * ratio * float(answer["max_pressure"])))
        a_x, b_y = hertz.curvatures(ratio * b, b, LOAD, modulus)
        low, high = (ratio, high) if a_x / b_y > CURVATURES[0] / CURVATURES[1] else (low, ratio)
    return ratio * b, b


def main() -> None:
    command_parser(__doc__).parse_args()
    a, b = semi_axes()
    print("| case | elements along a, b | Fx/(f N) | Fy/(f N) | limit by this and the line above: Fx/(f N) | Fy/(f N) |\n|---|---|---|---|---|---|")
    for name, case in CASES.items():
        before = None
        for parts in PARTS:
            answer = half_space.solve(curvature_x=CURVATURES[0], curvature_y=CURVATURES[1], normal_force=LOAD, friction=FRICTION, young=YOUNG,
                                      poisson=POISSON, element_x=a / parts, element_y=1.5 * b / parts,
                                      creepage=case.get("creepage", 0.), spin=case.get("spin", 0.))
            forces = np.array([float(answer[f"{side}_force"]) for side in ("longitudinal", "lateral")]) / (FRICTION * LOAD)
            limit = "| | |" if before is None else "| {:.5f} | {:.5f} |".format(*(forces + ADDED * (forces - before) + 0.))
            print(f"| {name} | {parts}, {2 * parts // 3} | {forces[0] + 0.:.5f} | {forces[1] + 0.:.5f} {limit}")
            before = forces


if __name__ == "__main__":
    run_command(main)
