# SPDX-License-Identifier: LGPL-2.1-or-later
"""The mesh of a run, and profiles of defects."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from ..point_files import read_points
from ..plots import GREY, at_least_high, legend_beside, name_sides, rolling_arrow, shade_defects, subplots
from ..runs import Run
from ..vtu import read_pieces

VOLUME = "volume-0000.vtu"
RAIL, WHEEL = 0, 1
RAIL_COLOUR, WHEEL_COLOUR = "#dce6f0", "#f3e6d3"


def read_cells(path: str) -> tuple[np.ndarray, np.ndarray]:
    """Reference positions of the cells' corners in mm, (cells, 8, 3) in VTK's order, and the cells' bodies. @raises DataError"""
    positions, bodies = [], []
    for points, cells, fields in read_pieces(path):
        cells = cells.reshape(-1, 8)
        positions.append((points - 1e-3 * fields["displacement_um"].reshape(-1, 3))[cells])
        bodies.append(fields["body"][cells[:, 0]])
    return np.concatenate(positions), np.concatenate(bodies).round().astype(int)


def cut_across(cells: np.ndarray, x: float) -> np.ndarray:
    """The cells cut at x: quadrilaterals (y, z). Edges along the path join corners 0-1, 3-2, 4-5 and 7-6."""
    low, high = cells[:, (0, 3, 7, 4)], cells[:, (1, 2, 6, 5)]
    inside = (low[:, :, 0].min(1) <= x) & (high[:, :, 0].max(1) > x)
    low, high = low[inside], high[inside]
    share = np.clip((x - low[:, :, :1]) / (high[:, :, :1] - low[:, :, :1]), 0., 1.)
    return (low + share * (high - low))[:, :, 1:]


def cut_along(cells: np.ndarray, y: float) -> np.ndarray:
    """The cells cut at y: quadrilaterals (x, z), the last two corners at the top. Edges across the path join corners 0-3, 1-2, 5-6 and 4-7."""
    low, high = cells[:, (0, 1, 5, 4)], cells[:, (3, 2, 6, 7)]
    inside = (low[:, :, 1].mean(1) <= y) & (high[:, :, 1].mean(1) > y)
    low, high = low[inside], high[inside]
    share = np.clip((y - low[:, :, 1:2]) / (high[:, :, 1:2] - low[:, :, 1:2]), 0., 1.)
    return (low + share * (high - low))[:, :, (0, 2)]


def top_edges(cut: np.ndarray) -> np.ndarray:
    """Those upper edges of quadrilaterals (x, z) above whose middle there is no other one, by x."""
    edges = cut[:, (3, 2)]
    edges = edges[np.argsort(edges[:, 0, 0])]
    middle, height = edges.mean(1).T
    highest = [height[(edges[:, 0, 0] <= x) & (edges[:, 1, 0] >= x)].max() for x in middle]
    return edges[height >= np.array(highest) - 1e-9]


def draw_cells(axis: Axes, polygons: np.ndarray, colour: str, name: str | None = None) -> None:
    """Cells, and the name of their body in the middle of those that are shown."""
    axis.add_collection(PolyCollection(polygons, facecolors=colour, edgecolors="black", linewidths=0.3))
    (left, right), (low, high) = axis.get_xlim(), axis.get_ylim()
    corners = polygons.reshape(-1, 2)
    corners = corners[(corners[:, 0] > left) & (corners[:, 0] < right) & (corners[:, 1] > low) & (corners[:, 1] < high)]
    if name and len(corners):
        axis.text(*(0.5 * (corners.min(0) + corners.max(0))), name, ha="center", va="center", weight="bold",
                  bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 2})


def under_wheel(rail: np.ndarray, wheel: np.ndarray) -> float:
    """Where along the rail the wheel stands: under its lowest cells, moved into a cell of the rail if it lies between two."""
    lowest = wheel[:, :, 2].min()
    size = np.ptp(wheel[:, :, 0], axis=1)
    low = wheel[:, :, 2].min(axis=1) < lowest + 1e-3 * np.ptp(wheel[:, :, 2])
    place = 0.5 * (wheel[low][:, :, 0].min() + wheel[low][:, :, 0].max())
    return float(np.clip(place, rail[:, :, 0].min(), rail[:, :, 0].max() - 1e-3) + 0.01 * size.min())


def draw_section(rail: np.ndarray, wheel: np.ndarray) -> Figure:
    """Rail and wheel cut across the path where the wheel stands, and the rail at its end."""
    wheel_x = under_wheel(rail, wheel)
    figure, axes = subplots(1, 2, figsize=(11, 2 + 5 * (80 - rail[:, :, 2].min()) / 160), sharey=True)
    for axis, x, name in ((axes[0], wheel_x, "under the axle"), (axes[1], rail[:, :, 0].max() - 0.1, "at the end of the rail")):
        axis.set(xlim=(-80, 80), ylim=(rail[:, :, 2].min() - 20, 60), aspect="equal", title=f"cut at x = {x:.0f} mm, {name}", xlabel="y [mm]")
        for cells, colour, body in ((rail, RAIL_COLOUR, "rail"), (wheel, WHEEL_COLOUR, "wheel")):
            draw_cells(axis, cut_across(cells, x), colour, body)
        axis.grid(False)
        name_sides(axis)
    axes[0].set_ylabel("z [mm], up from the rail's top")
    return figure


def draw_path(run: Run, rail: np.ndarray, begin: float | None = None, end: float | None = None) -> Figure:
    """The rail's cells under the path where wheel and rail first touch, and the height of its top there."""
    y = 1e3 * run.summary.get("first_contact_y_m", 0.0)
    cut = cut_along(rail, y)
    ends = rail[:, :, 0].min(), rail[:, :, 0].max()
    start = ends[0]
    if run.has("history.csv") and len(run.history.get("position_m", ())):
        way = 1e3 * run.history["position_m"]
        start = float(way.min())
        beside = max(50., 0.2 * np.ptp(way))
        ends = max(ends[0], way.min() - beside), min(ends[1], way.max() + beside)
    begin, end = (ends[0] if begin is None else begin), (ends[1] if end is None else end)
    figure, axes = subplots(2, 1, figsize=(10, 5.6), sharex=True)
    axes[0].set(xlim=(begin, end), ylim=(-40, 2), ylabel="z [mm]", title=f"rail cut along y = {y:.1f} mm, where the wheel first touches, upper 40 mm")
    draw_cells(axes[0], cut, RAIL_COLOUR)
    axes[0].grid(False)
    rolling_arrow(axes[0])
    top = top_edges(cut)
    level = top[np.argmin(abs(top[:, :, 0].mean(1) - start)), :, 1].mean() if len(top) else 0.
    for edge in top:
        if edge[1, 0] > begin and edge[0, 0] < end:
            axes[1].plot(edge[:, 0], 1e3 * (edge[:, 1] - level), "k.-", lw=0.8, ms=3)
    at_least_high(axes[1], 0.0, 2.0)
    for axis in axes:
        shade_defects(axis, run.parameters, named=axis is axes[0])
    legend_beside(axes[0])
    axes[1].set(ylabel="height of its top over that\nwhere the wheel starts [µm]", xlabel="x [mm]")
    return figure


def draw_defects(paths: Sequence[str]) -> Figure:
    """Longitudinal profiles of defects, from files with columns x and z in mm."""
    figure, axis = subplots(figsize=(10, 3.6))
    for path in paths:
        x, z = read_points(path).T
        axis.plot(x, z, label=os.path.splitext(os.path.basename(path))[0])
    axis.axhline(0, color=GREY, lw=1, ls=":", label="smooth rail")
    axis.margins(y=0.12)
    axis.text(0.5, 0.97, "wheel", transform=axis.transAxes, ha="center", va="top", color=GREY)
    axis.text(0.02, 0.03, "rail", transform=axis.transAxes, ha="left", va="bottom", color=GREY)
    axis.set(xlabel="x from the leading edge [mm]", ylabel="z [mm], up; not to scale", title="profiles along the rail")
    rolling_arrow(axis)
    legend_beside(axis)
    return figure


def figures(run: Run, begin: float | None = None, end: float | None = None) -> Iterator[tuple[str, Figure]]:
    if run.has(VOLUME):
        cells, bodies = read_cells(run.path(VOLUME))
        rail, wheel = cells[bodies == RAIL], cells[bodies == WHEEL]
        yield "section", draw_section(rail, wheel)
        if "patches" not in run.summary:  # the lines of the mesh of a wheelset in a position do not keep to y = 0
            yield "path", draw_path(run, rail, begin, end)
