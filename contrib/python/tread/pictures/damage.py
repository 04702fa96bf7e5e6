# SPDX-License-Identifier: LGPL-2.1-or-later
"""What friction did to each place of both surfaces ('Damage/Record'): work, slip, temperature and wear, over the surface and across it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.tri import Triangulation

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


def near_the_most_loaded(table: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The rows within 100 mm across from the place with most work: of a wheelset one side."""
    near = np.abs(table["y_mm"] - table["y_mm"][np.argmax(table["friction_work_J_per_m2"])]) <= 100.
    return {key: values[near] for key, values in table.items()}


def draw_map(axis: Axes, table: dict[str, np.ndarray], along: str, label: str, title: str) -> None:
    triangles = Triangulation(table[along], table["y_mm"])
    corners = np.stack([triangles.x, triangles.y], axis=1)[triangles.triangles]
    edges = np.abs(corners - np.roll(corners, 1, axis=1)).max(axis=1)
    triangles.set_mask((edges > 3. * np.median(edges, axis=0)).any(axis=1))  # between places that nothing has touched
    surface = axis.tripcolor(triangles, 1e-3 * table["friction_work_J_per_m2"], shading="gouraud", cmap="inferno_r", rasterized=True)
    axis.figure.colorbar(surface, ax=axis, label="work of friction [kJ/m$^2$]")
    axis.set(xlabel=label, ylabel="y [mm]", title=title)


def draw_damage(run: Run) -> Figure:
    rail, wheel = (near_the_most_loaded(run.table(name, (along, "friction_work_J_per_m2"))) for name, along in ((RAIL, "x_mm"), (WHEEL, "angle_deg")))
    shown = [entry for entry in ACROSS if rail[entry[0]].max() > 0.][:4]
    has_maps = np.ptp(rail["x_mm"]) > 0.  # half-space theory has one row for all of the way
    figure, axes = subplots(3 if has_maps else 2, 2, figsize=(11, 9.5 if has_maps else 6.5))
    if has_maps:
        draw_map(axes[0, 0], rail, "x_mm", "x along the rail [mm]", "rail")
        draw_map(axes[0, 1], wheel, "angle_deg", "angle about the axle [degrees]", "wheel")
    across = axes[1:] if has_maps else axes
    for axis, (key, factor, label) in zip(across.flat, shown):
        for table, name, colour in ((rail, "rail", BLUE), (wheel, "wheel", RED)):
            y, values = largest_across(table, key)
            apart = np.flatnonzero(np.diff(y) > 5.) + 1
            axis.plot(np.insert(y, apart, np.nan), factor * np.insert(values, apart, np.nan), color=colour, marker=".", ms=3, label=name)
        axis.set(xlabel="y across the rail [mm]", ylabel=label, ylim=(0., None))
        axis.legend()
        name_sides(axis)
    for axis in across.flat[len(shown):]:
        axis.remove()
    across[0, 0].set_title("largest along the path, at each place across" if has_maps else "by one passage, half-space theory")
    return figure


def figures(run: Run) -> Iterator[tuple[str, Figure]]:
    if run.has(RAIL):
        yield "damage", draw_damage(run)
