#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a window of fine cells that moves with the wheel costs, and what it changes in the answer.

Runs the metre of smooth rolling and, with --long, three metres; 120 mm of it with windows of several sizes beside all cells fine; the root of a flange in a position; and
the squat on 15 spans with and without a window, with mass for longer steps, and on fewer with endless ends. Each so many times in turn, of which the fastest counts. Fills the tables of
doc/performance.md. Runs that have complete results are not repeated; remove RESULTS to measure anew.
"""

import functools
import os

import numpy as np

from tread.commands import command_parser, run_command
from tread.measured_runs import available_ranks, in_turn, run_scene, steps_seconds
from tread.runs import ROOT, Run
from tread.tables import fill, markdown, number, provenance

METRES = {"1 m": "benchmarks/one-metre.prm", "3 m": "benchmarks/three-metres.prm"}
SHORT = {"Motion/Rolled distance (mm)": 120, "Output/Write volume": "false"}
WINDOWS = {"all fine": {"Mesh/Window": "false"},
           **{f"{length}, {margin}": {"Mesh/Window length (mm)": length, "Mesh/Window margin (mm)": margin}
              for length, margin in ((40, 25), (20, 25), (20, 15), (10, 15))}}
TRACK = {"15 spans, all along": {"Mesh/Window": "false"},
         **{f"15 spans, windows of {length} mm": {"Mesh/Window length (mm)": length} for length in (75, 40)},
         **{f"the same, {step} us at least": {"Mesh/Window length (mm)": 75, "Time stepping/Least step (us)": step} for step in (0.28, 0.35)},
         **{f"{spans} spans, endless, windows of 75 mm": {"Mesh/Window length (mm)": 75, "Rail/Ends": "endless", "Rail/Begin (mm)": begin, "Rail/Length (mm)": 600 * spans + 300}
            for spans, begin in ((7, -2625), (5, -2025))}}
CURVE = {"all fine, 100 mm": {"Mesh/Window": "false", "Motion/Rolled distance (mm)": 100},
         **{f"windows, {way} mm": {"Mesh/Window": "true", "Motion/Rolled distance (mm)": way} for way in (100, 500)}}
AT_REST = 3e-3  # m: the first rows begin at rest


def along(folder, column):
    """Positions of a run's rows behind its start, m, and a column of its history."""
    history = Run(folder).history
    place, values = np.array(history["position_m"]), np.array(history[column])
    rolling = place > place[0] + AT_REST
    return place[rolling], values[rolling]


def difference(folder, beside, column):
    """Of a column at the places of the rows, from another run's: {largest and RMS, over the mean; RMS over that of its own swing}."""
    place, values = along(folder, column)
    other = np.interp(place, *along(beside, column))
    off = values - other
    return {"largest": np.abs(off).max() / np.abs(other.mean()), "of swing": np.sqrt(np.mean(off**2)) / other.std()}


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/window"))
    parser.add_argument("--only", choices=("metres", "short", "curve", "track"), help="one of the tables")
    parser.add_argument("--long", action="store_true", help="three metres too")
    parser.add_argument("--turns", type=int, default=1, metavar="N", help="how often each run is made; default 1")
    arguments = parser.parse_args()
    folder_of = lambda name, turn: os.path.join(arguments.results, f"{name.replace(', ', '-').replace(' ', '-')}-{turn}")
    script = "benchmarks/window.py" + (" --long" if arguments.long else "")

    def measured(runs):
        """{name: summary} of {name: (scene, settings)}."""
        return in_turn(arguments.turns, {name: functools.partial(lambda scene, settings, name, turn: run_scene(scene, folder_of(name, turn), settings), scene, settings, name)
                                         for name, (scene, settings) in runs.items()})

    def note(summaries):
        return f"\n\n{available_ranks()} ranks, the fastest of {arguments.turns}. " + provenance(script, summaries.values())

    if arguments.only in (None, "metres"):
        fill_metres(measured, note, arguments.long)
    if arguments.only in (None, "short"):
        fill_short(measured, note, folder_of)
    if arguments.only in (None, "curve"):
        fill_curve(measured, note, folder_of)
    if arguments.only in (None, "track"):
        fill_track(measured, note, folder_of)


def fill_metres(measured, note, has_long):
    metres = measured({name: (scene, {}) for name, scene in METRES.items() if name == "1 m" or has_long})
    fill("performance.md", "window-metres", markdown(
        ["way", "windows", "cells", "steps", "seconds", "largest process, MB", "window loss, % of what is dissipated", "energy residual, % of the same"],
        [[name, number(of["windows"]), number(of["cells"]), number(of["steps"]), number(of["seconds"]), number(1e-6 * of["peak_bytes"]),
          number(100 * of["window_loss_J"] / of["dissipated_work_J"]), number(100 * of["energy_residual_of_dissipated"])] for name, of in metres.items()]) + note(metres))


def fill_short(measured, note, folder_of):
    short = measured({name: (METRES["1 m"], {**SHORT, **settings}) for name, settings in WINDOWS.items()})
    off = {name: [difference(folder_of(name, 0), folder_of("all fine", 0), column)["largest"] for column in ("normal_force_N", "longitudinal_force_N")]
           for name in WINDOWS}
    fill("performance.md", "window-force", markdown(
        ["window, margin, mm", "cells", "seconds", "normal force, largest difference, %", "tangential force, %"],
        [[name, number(of["cells"]), number(of["seconds"]), *(number(100 * value) if name != "all fine" else "-" for value in off[name])]
         for name, of in short.items()]) + note(short))


def fill_curve(measured, note, folder_of):
    first, *others = CURVE
    curve = measured({name: ("curves/flange-root.prm", {**settings, "Output/Write volume": "false"}) for name, settings in CURVE.items()})
    off = {name: [difference(folder_of(first, 0), folder_of(name, 0), column)["largest"] for column in ("normal_force_N", "longitudinal_force_N")] for name in others}
    fill("performance.md", "window-curve", markdown(
        ["", "windows", "cells", "seconds", "window loss, % of what is dissipated", "energy residual, % of the same", "normal force, largest difference on 100 mm, %", "longitudinal force, %"],
        [[name, number(of.get("windows", 1)), number(of["cells"]), number(of["seconds"]), number(100 * of.get("window_loss_J", 0.) / of["dissipated_work_J"]),
          number(100 * of["energy_residual_of_dissipated"]), *(number(100 * value) if name in off else "-" for value in off.get(name, (0., 0.)))]
         for name, of in curve.items()]) + note(curve))


def fill_track(measured, note, folder_of):
    first = next(iter(TRACK))
    track = measured({name: ("thesis/4.3-M1.prm", settings) for name, settings in TRACK.items()})
    fill("performance.md", "window-track", markdown(
        ["", "seconds", "of them steps", "cell updates", "largest force, kN", "least force, kN", "difference of the force, RMS, % of its swing"],
        [[name, number(of["seconds"]), number(steps_seconds(of)), number(of["element_updates"]), f"{1e-3 * of['largest_normal_force_N']:.2f}", f"{1e-3 * of['least_normal_force_N']:.2f}",
          number(100 * difference(folder_of(name, 0), folder_of(first, 0), "normal_force_N")["of swing"]) if name != first else "-"]
         for name, of in track.items()]) + note(track))


if __name__ == "__main__":
    run_command(main)
