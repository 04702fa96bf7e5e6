#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The largest von Mises stress over depth, as `Peak stress/Region` recorded it in each run, and those at the surface.

    plot-peaks.py RUN [RUN ...] [--names "10 mm, sharp" ...] [--strength 900] [--output peaks.png]

Lines and filled marks: layers of cells, and the surface by extrapolation. Open marks: the surface from stretch and tractions.
"""

import os

from tread import Run
from tread.commands import command_parser, run_command
from tread.plots import plt, save, use_style


def main():
    parser = command_parser(__doc__)
    parser.add_argument("runs", metavar="RUN", nargs="+")
    parser.add_argument("--names", nargs="*", default=[], help="of the runs, for the legend")
    parser.add_argument("--strength", metavar="MPA", type=float, help="a line at this stress")
    parser.add_argument("--output", default="peaks.png")
    arguments = parser.parse_args()
    use_style({"legend.fontsize": 9})
    figure, axis = plt.subplots(figsize=(7, 4.4))
    for i, folder in enumerate(arguments.runs):
        run = Run(folder)
        peaks = run.table("peak_stress.csv", ("depth_mm", "von_mises_MPa"))
        name = arguments.names[i] if i < len(arguments.names) else os.path.basename(os.path.normpath(folder))
        if run.summary.get("completed") is not True:
            name += " (interrupted)"
        line, = axis.plot(peaks["depth_mm"], peaks["von_mises_MPa"], marker="o", markersize=4, label=name)
        surface = run.summary.get("peak_surface_von_mises_from_tractions_Pa")
        if surface:
            axis.plot(0., 1e-6 * surface, marker="s", markersize=7, fillstyle="none", color=line.get_color(), clip_on=False, zorder=5)
    if arguments.strength:
        axis.axhline(arguments.strength, color="0.4", linestyle="--", linewidth=1)
        axis.annotate("strength", (axis.get_xlim()[1], arguments.strength), ha="right", va="bottom", color="0.4")
    axis.set(xlabel="depth, mm", ylabel="largest von Mises stress, MPa", xlim=(0., None))
    axis.plot([], [], marker="s", markersize=7, fillstyle="none", linestyle="none", color="0.4", label="surface, from stretch and tractions")
    axis.legend()
    save(figure, arguments.output, dpi=110, bbox_inches="tight")


if __name__ == "__main__":
    run_command(main)
