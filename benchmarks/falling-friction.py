#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Friction that falls with slip, as scenes have it by default: the table 'falling-friction' of doc/verification.md.

Cases are drawn by a rule (--seed): law, coefficients, slip speed of the fall, load, speed, creepage and cells, each independently and evenly (speeds,
creepages and slip speeds evenly in their logarithm) over the range of what railways have. Each is rolled on blocks that act as half-spaces and compared
with the half-space solver at the same creepage; the program may also refuse it.
"""

from __future__ import annotations

import os
import random

from tread.commands import command_parser, run_command
from tread.measured_runs import run_scene
from tread.runs import ROOT, ProgramError
from tread.tables import fill, markdown, provenance

SCENE = "verification/half-space-1.3-mu0.30.prm"
WHEEL_MASS, GRAVITY = 900., 9.81  # kg, m/s2, of the scene
LAWS = ("falling", "linear", "rational", "Stribeck")


def drawn(rng: random.Random) -> dict[str, float | str]:
    between = lambda low, high: low * (high / low) ** rng.random()
    coefficient = rng.uniform(0.2, 0.5)
    load = rng.uniform(40e3, 150e3)
    return {"Contact/Friction law": rng.choice(LAWS),
            "Contact/Friction coefficient": round(coefficient, 3),
            "Contact/Kinetic friction coefficient": round(coefficient * rng.uniform(0.4, 0.9), 3),
            "Contact/Falling slip speed (m per s)": round(between(0.3, 3), 2),
            "Vehicle/Sprung mass (kg)": round(load / GRAVITY - WHEEL_MASS),
            "Motion/Speed (km per h)": round(between(30, 250)),
            "Motion/Traction coefficient": 0, "Motion/Creepage": round(between(0.001, 0.03), 5),
            # 6 to 12 cells in the smaller semi-axis of 127 kN, 5.8 mm.
            "Mesh/Finest cell (mm)": round(rng.uniform(0.5, 1.0) * (load / 127e3) ** (1 / 3), 2)}


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results", "falling-friction"))
    parser.add_argument("--cases", metavar="N", type=int, default=20)
    parser.add_argument("--seed", metavar="N", type=int, default=1)
    arguments = parser.parse_args()
    rng = random.Random(arguments.seed)
    rows, summaries = [], []
    for case in range(arguments.cases):
        settings = drawn(rng)
        of_case = lambda what: os.path.join(arguments.results, f"{arguments.seed}-{case}-{what}")
        row = [settings["Contact/Friction law"], f"{settings['Contact/Friction coefficient']:g} to {settings['Contact/Kinetic friction coefficient']:g}",
               f"{settings['Contact/Falling slip speed (m per s)']:g}", f"{(settings['Vehicle/Sprung mass (kg)'] + WHEEL_MASS) * GRAVITY / 1e3:.0f}",
               f"{settings['Motion/Speed (km per h)']:g}", f"{settings['Motion/Creepage']:g}", f"{settings['Mesh/Finest cell (mm)']:g}"]
        try:
            own = run_scene(SCENE, of_case("run"), {**settings, "Output/Write volume": "false"})
        except ProgramError as error:
            rows.append(row + [str(error)] + [""] * 4)
            continue
        half_space = run_scene(SCENE, of_case("half-space"), settings, ranks=1, command="reference")
        traction, wanted = (summary["longitudinal_force_N"] / summary["normal_force_N"] for summary in (own, half_space))
        summaries.append(own)
        rows.append(row + [f"{traction:.4f}", f"{wanted:.4f}", f"{100 * (traction / wanted - 1):+.2f}", f"{100 * own['slip_chatter_share']:.1f}",
                           str(len(own["warnings"]))])
    table = markdown(["law", "friction", "slip speed [m/s]", "load [kN]", "speed [km/h]", "creepage", "cells [mm]", "traction", "half-space",
                      "difference [%]", "chatter [%]", "warnings"], rows)
    if arguments.seed == 1:
        fill("verification.md", "falling-friction", f"{table}\n\n" + provenance("benchmarks/falling-friction.py", summaries))
    else:
        print(table)
    for text in sorted({text for summary in summaries for text in summary["warnings"]}):
        print(text)


if __name__ == "__main__":
    run_command(main)
