#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A piece of rail on a beam beside the whole rail on the same sleepers: a wheel over a dip.

The whole rail is of full section, on six supports under its cells and endless ends; the piece is its head between two sleepers, on a beam of its section, on a
co-running track and held. Contact force over the way, its swing, and time. Fills the table of doc/track.md. Runs that have complete results are not repeated; remove
RESULTS to measure anew.
"""

import os

import numpy as np

from tread.commands import command_parser, run_command
from tread.measured_runs import run_scene
from tread.runs import ROOT, Run
from tread.tables import fill, markdown, number, provenance

SCENE = "tutorial/dip.prm"
ALL = {"Time stepping/Levels": 3, "Output/Write volume": "false", "Output/History interval (mm)": 0.25, "Mesh/Fine half width (mm)": 12}
SLEEPERS = {"Track/Support 0 (mm)": 250, "Track/Pad width (mm)": 130, "Track/Pad stiffness (MN per m)": 200, "Track/Pad damping (kN s per m)": 40}
PIECE = {**ALL, "Rail/Shape": "head", "Rail/Margin (mm)": 40}
# A 54E1 rail: 6977 mm2 of 7800 kg/m3, 2338 cm4, shear coefficient 0.38.
RUNS = {"whole rail on sleepers": {**ALL, **SLEEPERS, "Track/Foundation": "two-layer", "Rail/Ends": "endless", "Rail/Begin (mm)": -1750, "Rail/Length (mm)": 3400},
        "head on a beam": {**PIECE, **SLEEPERS, "Track/Foundation": "beam", "Track/Beam bending stiffness (MN m2)": 4.91, "Track/Beam shear stiffness (MN)": 215,
                           "Track/Beam mass (kg per m)": 54.4},
        "head on a co-running track": {**PIECE, "Track/Foundation": "co-running"},
        "head, held": {**PIECE, "Track/Foundation": "rigid"}}


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/beam-track"))
    parser.add_argument("--picture", metavar="PNG")
    arguments = parser.parse_args()
    folders = {name: os.path.join(arguments.results, name.replace(",", "").replace(" ", "-")) for name in RUNS}
    summaries = {name: run_scene(SCENE, folders[name], settings, ranks=1) for name, settings in RUNS.items()}
    history = {name: Run(folder).history for name, folder in folders.items()}
    place, force = {}, {}
    for name, table in history.items():
        place[name], force[name] = np.array(table["position_m"]), np.array(table["normal_force_N"])
    whole = next(iter(RUNS))
    rows = []
    for name, summary in summaries.items():
        here = np.interp(place[whole], place[name], force[name])
        off = np.sqrt(np.mean((here - force[whole])**2)) / force[whole].std()
        rows.append([name, number(summary["cells"]), number(summary["seconds"]), f"{1e-3 * force[name].max():.1f}", f"{1e3 * place[name][force[name].argmax()]:.1f}", f"{1e-3 * force[name].min():.1f}",
                     "-" if name == whole else number(100 * off)])
    fill("track.md", "beam-track", markdown(["", "cells", "seconds", "largest force, kN", "at, mm", "least force, kN", "difference of the force, RMS, % of its swing"], rows)
         + "\n\nOne rank. " + provenance("benchmarks/beam-track.py", summaries.values()))
    if arguments.picture:
        from tread.plots import BLUE, GREEN, ORANGE, RED, save, subplots, use_style

        use_style()
        figure, axis = subplots(1, 1, figsize=(9, 4))
        for name, colour in zip(RUNS, (BLUE, ORANGE, GREEN, RED)):
            axis.plot(1e3 * place[name], 1e-3 * force[name], color=colour, label=name)
        axis.set(xlabel="place of the wheel, mm", ylabel="contact force, kN", title="A wheel over a dip of 30 mm, 140 km/h")
        axis.legend()
        save(figure, arguments.picture)


if __name__ == "__main__":
    run_command(main)
