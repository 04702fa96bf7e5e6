#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Force between a wheel with the scanned flat and a rail on its track: runs of prm/flat/scanned-flat.prm beside a mass on a Hertz spring on a beam.

    flat-force.py RUN ... [--picture flat-force.png]

Each RUN is a folder with the results of that scene at some speed. The table has the largest and the least force of the run and of the simple model, and how long
the wheel is off the rail. The simple model alone is solved at more speeds for the picture.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from tread import Run
from tread.blows import off_the_rail, speed
from tread.commands import command_parser, run_command
from tread.flat_force import Track, roll
from tread.flats import Options, solve
from tread.runs import PROGRAM

LOAD, MASS, RADIUS, PITCH, WAY, START = 125e3, 900., 0.49, -21., 0.35, 0.3  # as in the scene; the wheel starts between two supports
SPEEDS = (5, 10, 15, 20, 25, 30, 35, 40, 50, 60, 70, 80, 90, 100)  # km/h


def heights(program: str) -> tuple[Callable[[float], float], float]:
    """Height of the axle over that of the round wheel (m) over the way, and its Hertz spring (N/m^1.5)."""
    ways = np.arange(0., WAY, 2e-3)
    answers = solve("scanned", [(PITCH - math.degrees(way / RADIUS), LOAD) for way in ways], Options(friction=0., program=program))
    height = 1e-3 * np.array([answer["axle_height_mm"] for answer in answers])
    # Two loads of the round wheel: approach over force.
    light, full = solve("scanned", [(0., 0.9 * LOAD), (0., LOAD)], Options(friction=0., program=program))
    softness = 1e-3 * (light["axle_height_mm"] - full["axle_height_mm"]) / (0.1 * LOAD)
    # delta = (F/K)^(2/3): d delta/dF = 2/3 delta/F, in the middle of both loads.
    middle = 0.95 * LOAD
    stiffness = middle / (1.5 * softness * middle)**1.5
    return lambda way: float(np.interp(way, ways, height - height[0])), stiffness


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("runs", nargs="+", metavar="RUN")
    parser.add_argument("--picture", metavar="PNG")
    parser.add_argument("--program", default=PROGRAM, help="tread")
    arguments = parser.parse_args()
    height, stiffness = heights(arguments.program)
    model = lambda velocity: roll(Track(), height, velocity, WAY, LOAD, MASS, stiffness, START, min(10e-6, 5e-5 / velocity))[:2]
    rows = []
    for folder in arguments.runs:
        history = Run(folder).table("history.csv")
        way, force = history["position_m"], history["normal_force_N"]
        velocity = speed(history)
        rows.append((velocity, way, force, *model(velocity)))
    rows.sort(key=lambda row: row[0])
    print(f"Hertz spring: {stiffness:.4g} N/m^1.5\n\n| km/h | largest force, kN | simple model | least force, kN | simple model | off the rail, mm | simple model |\n"
          "|---|---|---|---|---|---|---|")
    for velocity, way, force, of_model, model_force in rows:
        print(f"| {3.6 * velocity:.0f} | {1e-3 * force.max():.0f} | {1e-3 * model_force.max():.0f} | {1e-3 * force.min():.0f} | {1e-3 * model_force.min():.0f} | "
              f"{1e3 * off_the_rail(way, force):.0f} | {1e3 * off_the_rail(of_model, model_force):.0f} |")
    if arguments.picture:
        from tread.plots import BLUE, RED, save, subplots, use_style

        use_style()
        figure, axes = subplots(len(rows) + 1, 1, figsize=(9, 2.4 * (len(rows) + 1)))
        for axis, (velocity, way, force, of_model, model_force) in zip(axes, rows):
            axis.plot(1e3 * way, 1e-3 * force, color=BLUE, label="finite elements")
            axis.plot(1e3 * of_model, 1e-3 * model_force, "--", color=RED, label="mass on a Hertz spring on a beam")
            axis.set(ylabel="force, kN", title=f"{3.6 * velocity:.0f} km/h")
        axes[0].legend()
        axes[-2].set(xlabel="way of the wheel, mm; its flat is on the rail from 59 to 218 mm")
        speeds = [of_axis / 3.6 for of_axis in SPEEDS]
        axes[-1].plot(SPEEDS, [1e-3 * model(velocity)[1].max() for velocity in speeds], "--", color=RED)
        axes[-1].plot([3.6 * row[0] for row in rows], [1e-3 * row[2].max() for row in rows], "o", color=BLUE)
        axes[-1].set(xlabel="speed, km/h", ylabel="largest force, kN", title="Largest force over the speed")
        save(figure, arguments.picture)


if __name__ == "__main__":
    run_command(main)
