# SPDX-License-Identifier: LGPL-2.1-or-later
"""What passage after passage leaves in a rail that yields: strain, settlement and shift over the number of passages."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from ..plots import BLUE, GREEN, GREY, ORANGE, RED, subplots
from ..runs import Run

LEAST = 5  # passages of which there is a picture


def draw_growth(run: Run) -> Figure:
    """Marks: passages that were rolled; between marks far apart passages are left out."""
    table, summary = run.table("passages.csv"), run.summary
    number = table["passage"]
    figure, axes = subplots(3, figsize=(9, 8), sharex=True)

    def draw(axis, column, colour, label):
        axis.plot(number, table[column], color=colour, marker=".", ms=4, lw=1, label=label)

    draw(axes[0], "equivalent_plastic_strain_percent", GREY, "all that has flowed")
    draw(axes[0], "net_plastic_strain_percent", BLUE, "net: what is left")
    draw(axes[1], "net_plastic_strain_of_passage_percent", RED, None)
    draw(axes[2], "settlement_um", GREEN, "settlement")
    axes[2].plot(number, -table["shift_um"], color=ORANGE, marker=".", ms=4, lw=1, label="shift along the rail, backwards")
    left_out = int(number[-1]) - len(number)
    title = f"largest plastic strain in the middle of the path: net {100 * summary['net_plastic_strain']:.3g} % after {number[-1]:.0f} passages"
    if left_out:
        title += f", {left_out} of them left out"
    if "passages_to_failure" in summary:
        title += ": fails"
    axes[0].set(title=title, ylabel="plastic strain [%]")
    axes[1].set(ylabel="net plastic strain\nof the passage [%]", yscale="log" if np.all(table["net_plastic_strain_of_passage_percent"] > 0) else "linear")
    axes[2].set(ylabel="surface [um]", xlabel="passages")
    if number[-1] > 300:
        axes[2].set_xscale("log")
    for axis in (axes[0], axes[2]):
        axis.legend(loc="upper left")
    return figure


def figures(run: Run) -> Iterator[tuple[str, Figure]]:
    if run.has("passages.csv") and len(run.table("passages.csv")["passage"]) >= LEAST:
        yield "passages", draw_growth(run)
