#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Force on a wheel that goes over from the wing rail to the nose of a crossing: runs of prm/crossing/uk-56E1-passage.prm beside a simple model.

    crossing-force.py RUN ... [--picture crossing-force.png]

Each RUN is a folder with the results of that scene, or of uk-56E1-sleepers.prm, at some speed. Simple model: the wheel is a mass under its load, the rail one that moves up and down on the
springs and dampers of the co-running track (beside a run on a beam too), and between them acts the force that half-space theory gives at rest at the same place and height (tread
positions). It knows neither the inertia of the steel nor how the rails give way below the contact. The table has the largest force of both, and how long the wheel
is off the rail.
"""

from __future__ import annotations

from tread import Run
from tread.blows import off_the_rail, speed
from tread.commands import command_parser, run_command
from tread.crossing_force import SLICES, Rail, force_of_rest, pass_over
from tread.runs import PROGRAM

LOAD, MASS, SHIFT, BEGIN, END = 60e3, 600., 2.5, 170., 280.  # N, kg, mm: as in the scene


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("runs", nargs="+", metavar="RUN")
    parser.add_argument("--picture", metavar="PNG")
    parser.add_argument("--program", default=PROGRAM, help="tread")
    arguments = parser.parse_args()
    force = force_of_rest(SLICES, SHIFT, LOAD, BEGIN, END, arguments.program)
    rows = []
    for folder in arguments.runs:
        run = Run(folder)
        history = run.table("history.csv")
        end = float(run.parameters["Rail/Slices place (mm)"])
        place = end + 1e3 * history["position_m"]
        velocity = speed(history)
        rows.append((velocity, run.parameters["Track/Foundation"], place, history["normal_force_N"], history.get("inner_normal_force_N", 0. * place), 1e3 * history["wheelset_height_m"],
                     *pass_over(force, Rail(), velocity, 1e-3 * place[0], 1e-3 * end, LOAD, MASS)))
    rows.sort(key=lambda row: row[:2])
    name = lambda velocity, foundation: f"{3.6 * velocity:.0f} km/h" + (", on a beam" if foundation == "beam" else "")
    print("| | largest force, kN | simple model | at, mm | simple model | off the rail, mm | simple model |\n|---|---|---|---|---|---|---|")
    for velocity, foundation, place, total, _, _, of_model, model_force in rows:
        print(f"| {name(velocity, foundation)} | {1e-3 * total.max():.0f} | {1e-3 * model_force.max():.0f} | {place[total.argmax()]:.0f} | "
              f"{1e3 * of_model[model_force.argmax()]:.0f} | {off_the_rail(place, total):.0f} | {1e3 * off_the_rail(of_model, model_force):.0f} |")
    if arguments.picture:
        from tread.plots import BLUE, GREEN, ORANGE, RED, save, subplots, use_style

        use_style()
        figure, axes = subplots(len(rows) + 1, 1, figsize=(9, 2.6 * (len(rows) + 1)), sharex=True)
        for axis, (velocity, foundation, place, total, nose, _, of_model, model_force) in zip(axes, rows):
            axis.plot(place, 1e-3 * total, color=BLUE, label="finite elements")
            axis.plot(place, 1e-3 * nose, color=ORANGE, label="on the nose")
            axis.plot(1e3 * of_model, 1e-3 * model_force, "--", color=RED, label="mass on the half-space's force at rest, on a co-running track")
            axis.set(ylabel="force, kN", title=name(velocity, foundation))
        axes[0].legend()
        for (velocity, foundation, place, _, _, height, _, _), colour in zip(rows, (BLUE, GREEN, ORANGE, RED)):
            axes[-1].plot(place, height, color=colour, label=name(velocity, foundation))
        axes[-1].plot(1e3 * force.places, 1e3 * force.heights, "--", color="0.4", label="at rest, half-space")
        axes[-1].set(xlabel="along the slices, mm", ylabel="height of the axle, mm", title="The axle sinks with the wing, and rises with the nose")
        axes[-1].legend()
        save(figure, arguments.picture)


if __name__ == "__main__":
    run_command(main)
