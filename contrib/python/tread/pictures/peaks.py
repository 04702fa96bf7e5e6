# SPDX-License-Identifier: LGPL-2.1-or-later
"""The largest von Mises stress over depth in a region of the rail, in all steps of runs."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence

from matplotlib.figure import Figure

from ..plots import GREY, legend_beside, subplots
from ..runs import Run


def draw_peaks(runs: Sequence[Run], names: Sequence[str] = (), strength: float | None = None) -> Figure:
    """Lines and filled marks: layers of cells, and the nodes of the surface. Open marks: the middles of its faces.
    @param names of the runs @param strength in MPa, a line"""
    figure, axis = subplots(figsize=(9, 4.6))
    for i, run in enumerate(runs):
        peaks = run.table("peak_stress.csv", ("depth_mm", "von_mises_MPa"))
        name = names[i] if i < len(names) else os.path.basename(os.path.normpath(run.folder))
        if run.summary.get("completed") is not True:
            name += " (interrupted)"
        line, = axis.plot(peaks["depth_mm"], peaks["von_mises_MPa"], marker="o", ms=4, label=name)
        surface = run.summary.get("peak_surface_von_mises_from_tractions_Pa")
        if surface:
            axis.plot(0., 1e-6 * surface, marker="s", ms=7, fillstyle="none", color=line.get_color(), clip_on=False, zorder=5)
    if strength:
        axis.axhline(strength, color=GREY, ls="--", lw=1, label=f"strength, {strength:g} MPa")
    axis.set(xlabel="depth below the rail's surface [mm]", ylabel="von Mises stress [MPa]", xlim=(0., None),
             title="largest stress of all steps in the region of 'Peak stress'")
    if any(run.summary.get("peak_surface_von_mises_from_tractions_Pa") for run in runs):
        axis.plot([], [], marker="s", ms=7, fillstyle="none", ls="none", color=GREY, label="surface, middles\nof its faces")
    legend_beside(axis)
    return figure


def figures(run: Run) -> Iterator[tuple[str, Figure]]:
    if run.has("peak_stress.csv"):
        yield "peaks", draw_peaks([run])
