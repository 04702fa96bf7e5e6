# SPDX-License-Identifier: LGPL-2.1-or-later
"""What pictures have in common: one style, colours that the colour-blind can tell apart, and no window: they go to files."""

from __future__ import annotations

import os
from collections.abc import Mapping
from contextlib import AbstractContextManager
from typing import Any

import numpy as np

from .defects import extents_of_defects
from .files import Error

try:
    import matplotlib
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
except ImportError:
    raise Error("pictures need matplotlib, which this Python does not have: apt install python3-matplotlib, or pip install matplotlib") from None

# Okabe and Ito's.
BLUE, SKY, ORANGE, GREEN, RED, PURPLE, YELLOW = (
    "#0072B2", "#56B4E9", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#F0E442")
COLOURS = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY, "black")  # of lines, one after the other
ADHESION, SLIP, GREY, GRID = "#A9CBE3", "#F3B77E", "#666666", "#E3E3E3"
STYLE = {"font.family": "DejaVu Sans", "font.size": 10, "axes.titlesize": 10, "axes.titlelocation": "left", "axes.labelsize": 10,
         "axes.prop_cycle": matplotlib.cycler(color=COLOURS), "axes.grid": True, "axes.axisbelow": True, "axes.spines.top": False,
         "axes.spines.right": False, "axes.formatter.useoffset": False, "grid.color": GRID, "grid.linewidth": 0.7, "legend.frameon": False, "legend.fontsize": 8.5,
         "lines.linewidth": 1.4, "savefig.dpi": 120, "savefig.bbox": "tight"}


def use_style(more: Mapping[str, object] | None = None) -> None:
    """The style of all pictures, and more of matplotlib's rcParams where a picture is a drawing without scales."""
    matplotlib.rcParams.update({**STYLE, **(more or {})})


def style() -> AbstractContextManager[None]:
    """The style of all pictures inside a `with`, behind which the user's own is back."""
    return matplotlib.rc_context(STYLE)


def subplots(rows: int = 1, columns: int = 1, *, figsize: tuple[float, float], **options: Any) -> tuple[Figure, Any]:
    """(figure, axes) as matplotlib.pyplot.subplots() has them, but without a window. Labels, titles and legends beside the axes
    find their places by themselves."""
    figure = Figure(figsize=figsize, layout="constrained")
    FigureCanvasAgg(figure)
    return figure, figure.subplots(rows, columns, **options)


def save(figure: Figure, path: str) -> str:
    """Write a picture, the folder too if it is missing. @returns its path"""
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    figure.savefig(path)
    return path


def legend_beside(axis: Axes, **options: Any) -> None:
    """A legend on the right of the axes, where it covers no line; none if nothing is named."""
    if axis.get_legend_handles_labels()[0]:
        axis.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), **options)


def rolling_arrow(axis: Axes, y: float = 1.04) -> None:
    """Above the axes, at the right."""
    axis.annotate("", xy=(1.0, y), xytext=(0.88, y), xycoords="axes fraction",
                  arrowprops={"arrowstyle": "-|>", "color": "black", "lw": 1.2, "mutation_scale": 12})
    axis.text(0.87, y, "rolling direction", transform=axis.transAxes, ha="right", va="center", fontsize=9)


def name_sides(axis: Axes, y: float = 0.02) -> None:
    """In axes whose abscissa is the lateral coordinate: where the flange runs, and where not."""
    for x, side, text in ((0.02, "left", "$\\leftarrow$ gauge side (flange)"), (0.98, "right", "field side $\\rightarrow$")):
        axis.text(x, y, text, transform=axis.transAxes, ha=side, va="bottom", fontsize=8.5, color=GREY)


def passages(position: np.ndarray) -> list[slice]:
    """The rows of each passage of a record: a new wheel begins where the position falls."""
    bounds = [0, *(np.nonzero(np.diff(position) < 0)[0] + 1), len(position)]
    return [slice(begin, end) for begin, end in zip(bounds, bounds[1:])]


def plot_passages(axis: Axes, position: np.ndarray, x: np.ndarray, values: np.ndarray, label: str | None = None, **style: Any) -> None:
    """A line for each passage, the earlier the paler; only the last one has the label."""
    parts = passages(position)
    for number, rows in enumerate(parts, 1):
        axis.plot(x[rows], values[rows], alpha=number / len(parts), label=label if number == len(parts) else None, **style)


def shade_defects(axis: Axes, parameters: Mapping[str, str], named: bool = True) -> None:
    """The extent of each defect of a run over the position in mm; a line where its end is not known. @param named for the legend"""
    for number, (begin, end) in enumerate(extents_of_defects(parameters)):
        label = "defect" if named and number == 0 else None
        if end is None:
            axis.axvline(begin, color="black", ls=":", lw=1.2, label="leading edge of the defect" if label else None)
        else:
            axis.axvspan(begin, end, color="black", alpha=0.10, lw=0, zorder=0, label=label)


def span_at_least(axis: Axes, values: np.ndarray, share: float, least: float) -> None:
    """Let the ordinate span the values and so large a share of the last one to both sides, so that round-off is not drawn as an event."""
    reach = max(share * abs(values[-1]), least)
    low, high = min(values.min(), values[-1] - reach), max(values.max(), values[-1] + reach)
    axis.set_ylim(low - 0.05 * (high - low), high + 0.05 * (high - low))


def at_least_high(axis: Axes, share: float, least: float = 0.0) -> None:
    """Once all lines are drawn: let the ordinate span at least this share of the largest size of their values, and at least so much,
    so that round-off is not drawn as an event."""
    values = np.concatenate([np.asarray(line.get_ydata(), float) for line in axis.lines] or [np.empty(0)])
    values = values[np.isfinite(values)]
    if not len(values):
        return
    wanted = max(share * abs(values).max(), least)
    low, high = values.min(), values.max()
    if high - low < wanted:
        middle = 0.5 * (low + high)
        axis.set_ylim(middle - 0.5 * wanted, middle + 0.5 * wanted)


def depth_axis(axis: Axes, depths: np.ndarray) -> None:
    """An ordinate that counts depths downwards from the surface."""
    axis.set_ylim(1.1 * max(np.nanmax(depths, initial=0.0), 1e-3), 0.0)


def shown_rows(position_mm: np.ndarray, parameters: Mapping[str, str]) -> np.ndarray:
    """Which rows of a record are worth drawing: of a run over a defect what follows its leading edge, since the wheel and the track
    swing on to the end, and a quarter as much before it; of any other run all."""
    extents = extents_of_defects(parameters)
    begin = min(begin for begin, _ in extents) if extents else np.inf
    end = position_mm.max(initial=-np.inf)
    if not begin < end:
        return np.ones(len(position_mm), bool)
    return position_mm >= begin - 0.25 * (end - begin)
