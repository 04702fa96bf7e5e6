# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of a run: tread.Run(folder).pictures(). Each module draws one kind of them, `figures(run)` those for which the run has
the data, as (name, figure)."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..plots import Figure, save, style  # before the modules: it says that matplotlib is missing
from . import contact_points, contact_way, crossing, damage, growth, history, impact, mesh, patch, peaks, profile_wear, profiles

if TYPE_CHECKING:
    from ..runs import Run


def all_figures(run: Run, contact: str | None = None) -> Iterator[tuple[str, Figure]]:
    """(name, figure) of all pictures for which a run has the data. @param contact surface file of CONTACT to draw beside the patch"""
    if run.has("contact_points.csv"):
        yield from contact_points.figures(run)
        return
    if run.has("contact_way.csv"):
        yield from contact_way.figures(run)
        return
    if run.has("wear_steps.csv"):
        yield from profile_wear.figures(run)
        return
    yield from patch.figures(run, contact)
    for module in (history, impact, crossing, growth, peaks, damage, mesh, profiles):
        yield from module.figures(run)


def save_all(figures: Iterator[tuple[str, Figure]], folder: str) -> list[str]:
    """Draw figures into a folder, in the one style, which is undone at the end. @returns their paths"""
    with style():
        return [save(figure, os.path.join(folder, f"{name}.png")) for name, figure in figures]
