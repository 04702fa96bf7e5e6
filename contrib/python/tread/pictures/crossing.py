# SPDX-License-Identifier: LGPL-2.1-or-later
"""What happens in the contact patch while a wheel crosses a defect: figures 5.1.7 to 5.1.9 of the thesis. Shear stress is that on the
wheel."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, Patch as Swatch

from ..defects import extent_of_defect
from ..files import DataError, Error
from ..patches import Instant, Patch
from ..plots import ADHESION, COLOURS, RED, SLIP, legend_beside, passages, shade_defects, subplots
from ..runs import Run

# Half of what counts as at an edge, in spacings of the nodes: the nearest one to each side of a sharp edge.
AT_AN_EDGE = 1.5
# Share of the largest value from which on it counts as close to it.
CLOSE = 0.95


def line(patch: Patch, values: np.ndarray, y: float) -> tuple[Sequence[float], Sequence[float]]:
    """(x, values) of the row of nodes at y, with zeros where contact ends; nothing where the row has no contact."""
    gap = patch.size_x
    row = abs(patch.y - y) < 0.5 * patch.size_y
    if not row.any():
        return [], []
    order = np.argsort(patch.x[row])
    x, values = patch.x[row][order], values[row][order]
    parts = np.split(np.arange(len(x)), np.nonzero(np.diff(x) > 1.5 * gap)[0] + 1)
    return (np.concatenate([np.concatenate([[x[i[0]] - gap], x[i], [x[i[-1]] + gap]]) for i in parts]),
            np.concatenate([np.concatenate([[0.0], values[i], [0.0]]) for i in parts]))


def largest(patch: Patch, values: np.ndarray, near: float | None = None) -> tuple[float, float, float]:
    """(value, x, y) of the largest one; near an edge, if it is given, and (0, nan, nan) if there is no contact there."""
    inside = np.ones(len(patch.x), bool) if near is None else abs(patch.x - near) < AT_AN_EDGE * patch.size_x
    if not inside.any():
        return 0.0, np.nan, np.nan
    i = np.flatnonzero(inside)[np.argmax(values[inside])]
    return values[i], patch.x[i], patch.y[i]


class Crossing:
    """The instants of patches.csv around the defect; of several passages those of the last one."""

    def __init__(self, run: Run, y: float | None = None):
        self.run = run
        if not run.has("patches.csv"):
            raise DataError(f"{run.path('patches.csv')}: No such file; it is written with 'Output/Surface interval (mm)' above 0")
        extent = extent_of_defect(run.parameters)
        if extent is None or extent[1] is None:
            raise DataError(f"{run.path('parameters.prm')}: no defect with known edges")
        self.edges = dict(zip(("leading", "trailing"), extent))
        self.width = float(run.parameters.get("Defect/Width (mm)", 0)) or extent[1] - extent[0]
        self.middle_y = float(run.parameters.get("Defect/Lateral position (mm)", 0))
        instants = run.patches
        self.instants = instants[passages(np.array([instant.position_mm for instant in instants]))[-1]]
        self.y = self.row(self.middle_y if y is None else y)
        if not crosses(run, self.instants):
            raise DataError(f"{run.folder}: the wheel does not cross the defect from {extent[0]:g} to {extent[1]:g} mm in patches.csv")

    def row(self, y: float) -> float:
        """Where the row of nodes nearest to y lies. @raises Error if that is farther than the distance of two rows"""
        rows = np.concatenate([instant.patch.y for instant in self.instants])
        nearest = rows[np.argmin(abs(rows - y))]
        spacing = np.median([instant.patch.size_y for instant in self.instants])
        if abs(nearest - y) > spacing:
            raise Error(f"--y {y:g}: no nodes there; patches.csv has rows from {rows.min():.2f} to {rows.max():.2f} mm")
        return np.median(rows[abs(rows - nearest) < 0.5 * spacing])

    def nearest(self, position: float) -> Instant:
        return min(self.instants, key=lambda instant: abs(instant.position_mm - position))

    def at_edge(self, edge: str, quantity: str) -> Instant:
        """The instant of the largest pressure or shear stress near an edge."""
        return max(self.instants, key=lambda instant: largest(instant.patch, getattr(instant.patch, quantity), self.edges[edge])[0])

    def while_high(self, edge: str, quantity: str) -> tuple[float, float]:
        """First and last position of the wheel at which the pressure or shear stress near an edge is close to its largest."""
        values = [largest(instant.patch, getattr(instant.patch, quantity), self.edges[edge])[0] for instant in self.instants]
        high = [instant.position_mm for instant, value in zip(self.instants, values) if value >= CLOSE * max(values)]
        return high[0], high[-1]

    def smooth(self, before: bool = True) -> list[Instant]:
        """The instants at which the patch is wholly before the defect or behind it."""
        begin, end = self.edges.values()
        return [instant for instant in self.instants
                if (instant.patch.x.max() < begin - instant.patch.size_x if before else instant.patch.x.min() > end + instant.patch.size_x)]

    def chosen(self, quantity: str) -> list[tuple[float, Instant]]:
        """One before the defect, at its edges, over its middle, and one behind it."""
        before, behind = self.smooth(True), self.smooth(False)
        chosen = before[-1:] + [self.at_edge("leading", quantity), self.nearest(0.5 * sum(self.edges.values())),
                                self.at_edge("trailing", quantity)] + behind[:1]
        return sorted({instant.position_mm: instant for instant in chosen}.items())

    def figures(self) -> dict:
        result: dict = {"run": os.path.basename(os.path.normpath(self.run.folder)), "edges_mm": self.edges}
        before = self.smooth(True)
        for quantity in ("pressure", "shear"):
            name = f"{quantity}_MPa"
            if before:
                result[f"smooth_rail_largest_{name}"] = float(np.median([getattr(i.patch, quantity).max() for i in before]))
            result[f"largest_{name}"] = {}
            for edge, place in self.edges.items():
                instant = self.at_edge(edge, quantity)
                value, x, y = largest(instant.patch, getattr(instant.patch, quantity), place)
                result[f"largest_{name}"][f"{edge}_edge"] = {"value": float(value), "x_mm": float(x), "y_mm": float(y),
                                                             "wheel_mm": float(instant.position_mm), "time_s": float(instant.time_s),
                                                             f"above_{100 * CLOSE:.0f}_percent_from_to_mm": self.while_high(edge, quantity)}
        return result


def draw_axis(crossing: Crossing, positions: Sequence[float] | None = None) -> Figure:
    figure, axes = subplots(2, 1, figsize=(11.5, 8), sharex=True)
    for axis, quantity, field, label in ((axes[0], "pressure", "pressure", "pressure [MPa]"),
                                         (axes[1], "shear", "shear_x", "longitudinal shear stress\non the wheel [MPa], + forward")):
        instants = [crossing.nearest(at) for at in positions] if positions else [instant for _, instant in crossing.chosen(quantity)]
        at = {crossing.at_edge(edge, quantity).position_mm: f",\nlargest of all rows at the {edge} edge" for edge in crossing.edges}
        for i, instant in enumerate(instants):
            x, values = line(instant.patch, getattr(instant.patch, field), crossing.y)
            axis.plot(x, values, "o-", ms=3, color=COLOURS[i % len(COLOURS)], label=f"wheel at {instant.position_mm:.2f} mm{at.get(instant.position_mm, '')}")
        shade_defects(axis, crossing.run.parameters)
        axis.set_ylabel(label)
        legend_beside(axis)
    axes[0].set_title(f"along the rail, row of nodes at y = {crossing.y:.2f} mm; the wheel rolls to the right")
    axes[1].set_xlabel("position on the rail [mm]")
    return figure


def outline(axis: Axes, crossing: Crossing, **style: Any) -> None:
    begin, end = crossing.edges.values()
    axis.add_patch(Ellipse((0.5 * (begin + end), crossing.middle_y), end - begin, crossing.width, fill=False, **style))


def draw_stress(crossing: Crossing) -> Figure:
    figure = Figure(figsize=(12.5, 5.4))
    for number, (quantity, label) in enumerate((("pressure", "pressure"), ("shear", "shear stress")), 1):
        instant = crossing.at_edge("trailing", quantity)
        x, y, values = instant.patch.grid(getattr(instant.patch, quantity))
        axis = figure.add_subplot(1, 2, number, projection="3d", computed_zorder=False)
        values = np.nan_to_num(values)
        gx, gy = np.meshgrid(x, y)
        axis.plot_surface(gx, gy, values, cmap="viridis", rstride=1, cstride=1, edgecolor="#00000040", linewidth=0.3, antialiased=True, zorder=2)
        angle = np.linspace(0, 2 * np.pi, 200)
        begin, end = crossing.edges.values()
        axis.plot(0.5 * (begin + end) + 0.5 * (end - begin) * np.cos(angle), crossing.middle_y + 0.5 * crossing.width * np.sin(angle), 0,
                  color=RED, lw=1.5, zorder=3)
        axis.set(xlabel="x along the rail [mm]", ylabel="y [mm], + field side", box_aspect=(np.ptp(x), np.ptp(y), 0.8 * np.ptp(x)),
                 title=f"{label} [MPa], wheel at {instant.position_mm:.2f} mm: largest {values.max():.0f} MPa\nat the trailing edge; red: border of the defect")
        axis.view_init(elev=28, azim=-60)
    figure.subplots_adjust(left=0.0, right=0.93, wspace=0.05, top=0.9, bottom=0.05)
    return figure


def draw_slip(crossing: Crossing) -> Figure:
    before, behind = crossing.smooth(True), crossing.smooth(False)
    instants = [(before[-1], "before the defect")] if before else []
    pressure, shear = (crossing.at_edge("trailing", quantity) for quantity in ("pressure", "shear"))
    instants += [(crossing.at_edge("leading", "pressure"), "largest pressure at the leading edge"),
                 (crossing.nearest(0.5 * sum(crossing.edges.values())), "over the middle")]
    if pressure is shear:
        instants += [(pressure, "largest pressure and shear stress\nat the trailing edge")]
    else:
        instants += [(pressure, "largest pressure at the trailing edge"), (shear, "largest shear stress at the trailing edge")]
    instants += [(behind[0], "behind the defect")] if behind else []
    figure, axes = subplots(2, 3, figsize=(12, 7.4), sharey=True)
    reach = 1.05 * max((abs(patch.x - at) + patch.size_x).max() for (_, at, patch), _ in instants)
    across = 1.05 * max((abs(patch.y) + patch.size_y).max() for (_, _, patch), _ in instants)
    for axis, (instant, when) in zip(axes.flat, instants):
        x, y, state = instant.patch.grid(np.where(instant.patch.adhesion, 0.0, 1.0))
        axis.pcolormesh(x, y, np.ma.masked_invalid(state), cmap=ListedColormap([ADHESION, SLIP]), vmin=0, vmax=1, shading="nearest",
                        edgecolors="white", linewidth=0.3)
        outline(axis, crossing, ec="black", lw=1.4, zorder=4)
        axis.axvline(instant.position_mm, color="black", lw=0.7, ls="--")
        axis.grid(False)
        axis.set(title=f"{when}\nwheel at {instant.position_mm:.2f} mm, {100 * instant.patch.adhesion_share:.0f} % of the patch adheres",
                 xlim=(instant.position_mm - reach, instant.position_mm + reach), ylim=(-across, across), aspect="equal", xlabel="x along the rail [mm]")
    for axis in axes[:, 0]:
        axis.set_ylabel("y, + to the field side [mm]")
    for axis in axes.flat[len(instants):]:
        axis.remove()
    axes[1, 1].legend(handles=[Swatch(fc=ADHESION, label="adhesion"), Swatch(fc=SLIP, label="slip"), Swatch(fc="none", ec="black", label="border of the defect"),
                               Line2D([], [], color="black", lw=0.7, ls="--", label="the wheel, it rolls to the right")],
                      loc="upper center", bbox_to_anchor=(0.5, -0.3), ncol=4)
    return figure


def text_of(figures: dict) -> str:
    lines = [f"| at | of | largest, MPa | wheel at, mm | above {100 * CLOSE:.0f} % of it, wheel at, mm |", "|---|---|---|---|---|"]
    for edge, place in figures["edges_mm"].items():
        for name in ("pressure", "shear"):
            found = figures[f"largest_{name}_MPa"][f"{edge}_edge"]
            span = " to ".join(f"{x:.2f}" for x in found[f"above_{100 * CLOSE:.0f}_percent_from_to_mm"])
            lines.append(f"| the {edge} edge, {place:g} mm | {name} | {found['value']:.0f} | {found['wheel_mm']:.2f} | {span} |")
    for name in ("pressure", "shear"):
        value = figures.get(f"smooth_rail_largest_{name}_MPa")
        if value is not None:
            lines.append(f"| the smooth rail before it | {name} | {value:.0f} | | |")
    return "\n".join(lines)


def crosses(run: Run, instants: Sequence[Instant]) -> bool:
    """Whether the wheel is before the defect of a run at the first instant and behind it at the last."""
    begin, end = extent_of_defect(run.parameters)
    return instants[0].position_mm < begin and instants[-1].position_mm > end


def figures(run: Run) -> Iterator[tuple[str, Figure]]:
    """Pictures of a run that crosses its defect with patches.csv; none of another one."""
    extent = extent_of_defect(run.parameters)
    if run.has("patches.csv") and extent and extent[1] is not None and "patches" not in run.summary:
        last = run.patches[passages(np.array([instant.position_mm for instant in run.patches]))[-1]]
        if crosses(run, last):
            yield from figures_of(Crossing(run))


def figures_of(crossing: Crossing, positions: Sequence[float] | None = None) -> Iterator[tuple[str, Figure]]:
    yield "crossing-axis", draw_axis(crossing, positions)
    yield "crossing-stress", draw_stress(crossing)
    yield "crossing-slip", draw_slip(crossing)
