# SPDX-License-Identifier: LGPL-2.1-or-later
"""What friction did to each place of both surfaces ('Damage/Record'): work, slip, temperature and wear, over the surface and across it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..plots import BLUE, RED, name_sides, subplots
from ..runs import Run

RAIL, WHEEL = "rail_surface_damage.csv", "wheel_surface_damage.csv"
ACROSS = (("friction_work_J_per_m2", 1e-3, "work of friction [kJ/m$^2$]"), ("slip_distance_m", 1e6, "slip distance [um]"),
          ("max_flash_temperature_K", 1., "flash temperature [K]"), ("wear_depth_m", 1e9, "wear depth [nm]"), ("max_pressure_Pa", 1e-6, "largest pressure [MPa]"))


def largest_across(table: dict[str, np.ndarray], key: str) -> tuple[np.ndarray, np.ndarray]:
    """(y, the largest value along the path at this y), in tenths of a millimetre."""
    rows = np.round(table["y_mm"], 1)
    lines = np.unique(rows)
    return lines, np.array([table[key][rows == y].max() for y in lines])


def draw_map(axis: Axes, table: dict[str, np.ndarray], along: str, label: str, title: str) -> None:
    surface = axis.tripcolor(table[along], table["y_mm"], 1e-3 * table["friction_work_J_per_m2"], shading="gouraud", cmap="inferno_r", rasterized=True)
    axis.figure.colorbar(surface, ax=axis, label="work of friction [kJ/m$^2$]")
    axis.set(xlabel=label, ylabel="y [mm]", title=title)


def draw_damage(run: Run) -> Figure:
    rail, wheel = run.table(RAIL, ("x_mm", "friction_work_J_per_m2")), run.table(WHEEL, ("angle_deg", "friction_work_J_per_m2"))
    shown = [entry for entry in ACROSS if rail[entry[0]].max() > 0.][:4]
    figure, axes = subplots(3, 2, figsize=(11, 9.5))
    draw_map(axes[0, 0], rail, "x_mm", "x along the rail [mm]", "rail")
    draw_map(axes[0, 1], wheel, "angle_deg", "angle about the axle [degrees]", "wheel")
    for axis, (key, factor, label) in zip(axes[1:].flat, shown):
        for table, name, colour in ((rail, "rail", BLUE), (wheel, "wheel", RED)):
            y, values = largest_across(table, key)
            axis.plot(y, factor * values, color=colour, marker=".", ms=3, label=name)
        axis.set(xlabel="y across the rail [mm]", ylabel=label, ylim=(0., None))
        axis.legend()
        name_sides(axis)
    for axis in axes[1:].flat[len(shown):]:
        axis.remove()
    axes[1, 0].set_title("largest along the path, at each place across")
    return figure


def figures(run: Run) -> Iterator[tuple[str, Figure]]:
    if run.has(RAIL):
        yield "damage", draw_damage(run)
