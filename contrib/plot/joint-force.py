#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Force on a wheel that rolls over a joint: runs of prm/joint/insulated-joint.prm beside a simple model.

    joint-force.py RUN ... [--names TEXT ...] [--gap 6] [--steps 0.5 ...] [--picture joint-force.png]

Each RUN is a folder with the results of that scene. Simple model: the rigid wheel, a mass under its load, rolls over the shape of the rails with Hertz's spring between them. Below
them is a 60E1 rail as a beam without fishplates on pads, sleepers and ballast; for a run on a co-running track, its mass, spring and damper. At the edge of a step of height h the wheel's path has a kink of sqrt(2 h / R), which
the table has times the speed: the speed with which the masses meet. --steps has the step of each run in mm, by which the second rail is higher; nan: no joint.
"""

from __future__ import annotations

import math

import numpy as np

from tread import Run
from tread.blows import off_the_rail, speed
from tread.commands import command_parser, run_command
from tread.crossing_force import Rail, pass_over
from tread.flat_force import Track, roll
from tread.hertz import approach, ratio_of_semi_axes, semi_axes

RADIUS, CROWN, LOAD, MASS, MODULUS = 0.46, 0.3, 100e3, 600., 0.5 * 210e9 / (1. - 0.3**2)  # SI units: as in the scene, the modulus of the pair
BARS = 10.  # kg: of the meshed rails, which move with the track


def spring() -> float:
    """Hertz's, N/m^1.5."""
    along, across = 0.5 / RADIUS, 0.5 / CROWN
    a, b = semi_axes(along, ratio_of_semi_axes(along, across), LOAD, MODULUS)
    return LOAD / approach(a, b, LOAD, MODULUS)**1.5


class Joint:
    """Contact force over place (m) and height of the axle over its radius (m)."""

    def __init__(self, gap: float, step: float):
        self.gap, self.step, self.spring = gap, step, spring()

    def free_height(self, place: float) -> float:
        """Of a wheel that just touches."""
        if math.isnan(self.step):
            return 0.
        heights = []
        for nearest, level in ((min(place, -0.5 * self.gap), 0.), (max(place, 0.5 * self.gap), self.step)):
            heights.append(level + math.sqrt(RADIUS**2 - (nearest - place)**2) - RADIUS if abs(nearest - place) < RADIUS else -1.)
        return max(heights)

    def height(self, place: float) -> float:
        """Under the load at rest."""
        return self.free_height(place) - (LOAD / self.spring)**(2 / 3)

    def __call__(self, place: float, height: float) -> float:
        return self.spring * max(0., self.free_height(place) - height)**1.5


def simple_model(run: Run, joint: Joint, velocity: float, begin: float, end: float) -> tuple[np.ndarray, np.ndarray]:
    """(places, contact force) on the track of the run."""
    given = run.parameters
    if given["Track/Foundation"] != "beam":
        return pass_over(joint, Rail(mass=Rail().mass + BARS), velocity, begin, end, LOAD, MASS, 1e-6)
    value = lambda name, unit: float(given[f"Track/{name}"]) * unit
    track = Track(spans=12, elements=24, spacing=value("Sleeper spacing (m)", 1.), pad_stiffness=value("Pad stiffness (MN per m)", 1e6), pad_damping=value("Pad damping (kN s per m)", 1e3),
                  sleeper_mass=value("Sleeper mass (kg)", 1.), ballast_stiffness=value("Ballast stiffness (MN per m)", 1e6),
                  ballast_damping=value("Ballast damping (kN s per m)", 1e3))
    way, force = roll(track, lambda way: joint.free_height(begin + way), velocity, end - begin, LOAD, MASS, joint.spring, begin - value("Support 0 (mm)", 1e-3), 1e-6)[:2]
    return begin + way, force


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("runs", nargs="+", metavar="RUN")
    parser.add_argument("--names", nargs="+", metavar="TEXT", help="of the runs, for the table and the picture (default: their folders)")
    parser.add_argument("--gap", type=float, default=6., metavar="MM")
    parser.add_argument("--steps", type=float, nargs="+", default=[0.5], metavar="MM", help="of each run")
    parser.add_argument("--picture", metavar="PNG")
    arguments = parser.parse_args()
    names = arguments.names or arguments.runs
    steps = arguments.steps + arguments.steps[-1:] * (len(arguments.runs) - len(arguments.steps))
    rows = []
    for folder, name, step in zip(arguments.runs, names, steps):
        run = Run(folder)
        history = run.table("history.csv")
        place, velocity = history["position_m"], speed(history)
        joint = Joint(1e-3 * arguments.gap, 1e-3 * step)
        rows.append((name, velocity, step, 1e3 * place, history["normal_force_N"],
                     *simple_model(run, joint, velocity, place[0], place[-1])))
    print("| run | km/h | kink times speed, m/s | largest force, kN | simple model | at, mm | simple model | off the rail, mm | simple model |\n|---|---|---|---|---|---|---|---|---|")
    for name, velocity, step, place, force, of_model, model_force in rows:
        kink = 0. if math.isnan(step) else velocity * math.sqrt(2e-3 * abs(step) / RADIUS)
        print(f"| {name} | {3.6 * velocity:.0f} | {kink:.2f} | {1e-3 * force.max():.0f} | {1e-3 * model_force.max():.0f} | {place[force.argmax()]:.1f} | "
              f"{1e3 * of_model[model_force.argmax()]:.1f} | {off_the_rail(place, force):.0f} | {1e3 * off_the_rail(of_model, model_force):.0f} |")
    if arguments.picture:
        from tread.plots import BLUE, RED, save, subplots, use_style

        use_style()
        figure, axes = subplots(len(rows), 1, figsize=(9, 2.6 * len(rows)), sharex=True, squeeze=False)
        for axis, (name, velocity, _, place, force, of_model, model_force) in zip(np.ravel(axes), rows):
            axis.plot(place, 1e-3 * force, color=BLUE, label="finite elements")
            axis.plot(1e3 * of_model, 1e-3 * model_force, "--", color=RED, label="simple model")
            axis.axvspan(-0.5 * arguments.gap, 0.5 * arguments.gap, color="0.85")
            axis.set(ylabel="force, kN", title=f"{name}, {3.6 * velocity:.0f} km/h")
        np.ravel(axes)[0].legend()
        np.ravel(axes)[-1].set(xlabel="axle from the middle of the gap, mm")
        save(figure, arguments.picture)


if __name__ == "__main__":
    run_command(main)
