# SPDX-License-Identifier: LGPL-2.1-or-later
"""Measured profiles of a run as the program read and smoothed them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from ..plots import BLUE, GREY, RED, name_sides, subplots
from ..runs import Run

BODIES = ("wheel", "rail")


def change_of(table: dict[str, np.ndarray]) -> np.ndarray:
    """By how much each point was moved at right angles to the curve, um, positive to the left of its direction: upwards."""
    along_y, along_z = np.gradient(table["measured_y_mm"]), np.gradient(table["measured_z_mm"])
    length = np.hypot(along_y, along_z)
    across = (table["z_mm"] - table["measured_z_mm"]) * along_y - (table["y_mm"] - table["measured_y_mm"]) * along_z
    return 1e3 * np.divide(across, length, out=np.zeros_like(length), where=length > 0)


def draw_measured(run: Run, body: str) -> Figure:
    """A profile as it is used, the measured points, and what smoothing changed."""
    table = run.table(f"measured_{body}.csv", ("y_mm", "z_mm", "measured_y_mm", "measured_z_mm"))
    change = change_of(table)
    smoothed = bool(np.any(change))
    figure, axes = subplots(2, 1, figsize=(11, 7), sharex=True, gridspec_kw={"height_ratios": (2, 1)}) if smoothed else subplots(1, 1, figsize=(11, 5))
    shape = axes[0] if smoothed else axes
    shape.plot(table["measured_y_mm"], table["measured_z_mm"], ".", color=GREY, ms=4, label="measured")
    shape.plot(table["y_mm"], table["z_mm"], color=BLUE, lw=1.4, label="as it is used")
    shape.set(ylabel="z [mm], up", aspect="auto" if smoothed else "equal", title=f"measured {body}, as it was read; flange and gauge side at y < 0")
    shape.legend()
    name_sides(shape)
    if smoothed:
        axes[1].plot(table["y_mm"], change, color=RED, lw=1)
        axes[1].axhline(0, color=GREY, lw=1, ls=":")
        axes[1].set(ylabel="moved by smoothing [µm],\n+ upwards", title=f"at most {abs(change).max():.3g} µm")
    (axes[1] if smoothed else shape).set_xlabel("y [mm]")
    return figure


def figures(run: Run) -> Iterator[tuple[str, Figure]]:
    for body in BODIES:
        if run.has(f"measured_{body}.csv"):
            yield f"measured-{body}", draw_measured(run, body)
