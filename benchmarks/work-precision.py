#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wall time against the error beside CONTACT: which setting pays.

Runs the half-space verification scenes of prm/verification at several cell sizes with a plain setting (density as it
is, one time step for all cells, twice the distance from a start without tractions), with one change at a time, and
with all that pays together. Fills the table of doc/performance.md and draws doc/pictures/work-precision.png. The runs
of a size are made in turn, several times but for the finest, and the fastest of each counts. Runs that have complete
results are not repeated; remove RESULTS to measure anew.
"""

import functools
import os

from tread.commands import command_parser, run_command
from tread.measured_runs import available_ranks, contact_measures, in_turn, run_scene, steps_seconds
from tread.plots import BLUE, GREEN, ORANGE, PURPLE, RED, SKY, YELLOW, save, subplots, use_style
from tread.runs import ROOT
from tread.tables import fill, markdown, number, provenance

# Cells of 2.6 mm are larger than those scenes have: the scene of 1.3 mm, with more room beside the patch.
SIZES = {2.6: ("verification/half-space-1.3-mu0.30.prm",
               {"Mesh/Finest cell (mm)": 2.6, "Mesh/Fine half width (mm)": 10.4}),
         1.3: ("verification/half-space-1.3-mu0.30.prm", {}),
         0.63: ("verification/half-space-0.63-mu0.30.prm", {}),
         0.33: ("verification/half-space-0.33-mu0.30.prm", {})}
TRACTION = 0.30
TURNS = {2.6: 3, 1.3: 3, 0.63: 2, 0.33: 1}

PLAIN = {"Scene/Density scale": 1, "Time stepping/Levels": 1, "Output/Write volume": "false",
         "Start/Tractions": "none", "Motion/Rolled distance (mm)": 60}
PREDICTED_START = {"Start/Tractions": "predicted", "Motion/Rolled distance (mm)": 30}
# name: (what is changed, colour, marker)
SETTINGS = {
    "plain": ({}, "black", "o"),
    "density 4": ({"Scene/Density scale": 4}, SKY, "v"),
    "density 9": ({"Scene/Density scale": 9}, BLUE, "^"),
    "density 25": ({"Scene/Density scale": 25}, PURPLE, "D"),
    "3 levels": ({"Time stepping/Levels": 3}, GREEN, "s"),
    "predicted start": (PREDICTED_START, YELLOW, "<"),
    "contact tolerance 1e-4": ({"Contact/Tolerance": 1e-4}, ORANGE, "P"),
    "fully integrated": ({"Solid/Element": "fully-integrated"}, "#999999", "X"),
    "best": ({"Scene/Density scale": 25, "Time stepping/Levels": 3, "Contact/Tolerance": 1e-4, **PREDICTED_START}, RED,
             "*")}
SLOW = {"fully integrated": 0.63}  # only cells of at least so many mm

# (key of compare-contact.py, label, factor, unit)
MEASURES = (("max_pressure_relative_difference", "largest pressure", 100, "%"),
            ("pressure_rms_over_max", "pressure RMS", 100, "%"),
            ("shear_rms_over_max", "shear RMS", 100, "%"),
            ("adhesion_share_difference_points", "adhesion share", 1, "points"),
            ("creepage_at_this_traction_relative_difference", "creepage", 100, "%"))
DRAWN = MEASURES[2:]


def measure(results, sizes):
    """{(size, setting): (summary with cost, measures)}"""
    found = {}
    for size in sizes:
        scene, mesh = SIZES[size]

        def run(name, turn):
            folder = os.path.join(results, f"{size}-{name.replace(' ', '-')}-{turn}")
            return dict(run_scene(scene, folder, {**PLAIN, **mesh, **SETTINGS[name][0]}), folder=folder)

        names = [name for name in SETTINGS if size >= SLOW.get(name, 0)]
        for name, summary in in_turn(TURNS[size], {name: functools.partial(run, name) for name in names}).items():
            found[size, name] = summary, contact_measures(summary["folder"], TRACTION)
    return found


def table(found):
    header = ["cells, mm", "setting", "cells", "steps", "seconds", "times plain", "of the steps alone"] + [
        f"{label}, {unit}" for _, label, _, unit in MEASURES] + ["energy residual, % of what is dissipated"]
    rows = []
    for (size, name), (summary, measures) in found.items():
        plain = found[size, "plain"][0]
        rows.append([f"{size:g}", name, number(summary["cells"]), number(summary["steps"]),
                     number(summary["seconds"]), f"{plain['seconds'] / summary['seconds']:.1f}",
                     f"{steps_seconds(plain) / steps_seconds(summary):.1f}"]
                    + [number(factor * measures[key]) for key, _, factor, _ in MEASURES]
                    + [f"{100 * summary['energy_residual_of_dissipated']:.2g}"])
    return markdown(header, rows)


def draw(found, file):
    use_style()
    figure, axes = subplots(1, len(DRAWN), figsize=(4.4 * len(DRAWN), 4.6), sharex=True)
    for axis, (key, label, factor, unit) in zip(axes, DRAWN):
        for name, (_, colour, marker) in SETTINGS.items():
            points = [(summary["seconds"], abs(factor * measures[key]), size)
                      for (size, setting), (summary, measures) in found.items() if setting == name]
            main_line = name in ("plain", "best")
            axis.plot(*zip(*[point[:2] for point in points]), color=colour, marker=marker, label=name,
                      lw=2.2 if main_line else 1.0, ms=10 if marker == "*" else 6, zorder=3 if main_line else 2)
            if name == "plain":
                for x, y, size in points:
                    axis.annotate(f"{size:g} mm", (x, y), xytext=(6, 6), textcoords="offset points", fontsize=8)
        axis.set(xscale="log", yscale="log", xlabel="start to summary.json [s]",
                 ylabel=f"{label} [{unit}]")
        for numbers in (axis.xaxis, axis.yaxis):
            numbers.set_major_formatter("{x:g}")
            numbers.set_minor_formatter(lambda value, _: f"{value:g}" if f"{value:e}"[0] in "235" else "")
        axis.grid(True, which="both")
    axes[0].set_title("difference from CONTACT; to the left and down is better")
    axes[len(axes) // 2].legend(*axes[0].get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=4)
    save(figure, file)


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?",
                        default=os.path.join(ROOT, "results/work-precision"))
    parser.add_argument("--fine", action="store_true", help="cells of 0.33 mm too")
    arguments = parser.parse_args()
    found = measure(arguments.results, [size for size in SIZES if size > 0.5 or arguments.fine])
    script = "benchmarks/work-precision.py" + (" --fine" if arguments.fine else "")
    fill("performance.md", "work-precision", table(found) + f"\n\n{available_ranks()} ranks. "
         + provenance(script, [summary for summary, _ in found.values()]))
    draw(found, os.path.join(ROOT, "doc/pictures/work-precision.png"))


if __name__ == "__main__":
    run_command(main)
