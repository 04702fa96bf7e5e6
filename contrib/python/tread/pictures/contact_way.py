# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `tread contact-points` left of a rail of slices: where the wheel touches along the way, who carries the load, and how the axle rises and sinks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from ..plots import BLUE, GREEN, GREY, RED, subplots
from ..runs import Run

COLUMNS = ("along_mm", "height_mm", "rigid_height_mm", "patch_y_mm", "load_share", "max_pressure_MPa", "part")


def draw_contact_way(run: Run) -> Figure:
    table = run.table("contact_way.csv", COLUMNS, ("part",))
    figure, (height, place, share) = subplots(3, 1, figsize=(11, 8.4), sharex=True)
    along, first = np.unique(table["along_mm"], return_index=True)
    height.plot(along, table["rigid_height_mm"][first], color=GREY, label="touching, without load")
    height.plot(along, table["height_mm"][first], color="black", label="under the load")
    height.set(ylabel="height of the wheelset [mm]", title="vertical path of the axle")
    height.legend()
    parts = list(dict.fromkeys(table["part"]))
    for part, colour in zip(parts, (BLUE, RED, GREEN, GREY)):
        own = table["part"] == part
        name = part or "rail"
        place.scatter(table["along_mm"][own], table["patch_y_mm"][own], s=4. + 40. * table["load_share"][own], color=colour, label=name)
        share.plot(table["along_mm"][own], 100. * table["load_share"][own], color=colour, marker=".", label=name)
    place.set(ylabel="y of the patch [mm],\nfrom the middle of the track", title="where the wheel touches; larger: more of the load")
    place.legend()
    share.set(xlabel="place of the axle along the slices [mm]", ylabel="share of the vertical load [%]", ylim=(0., 105.), title="load-bearing part")
    return figure


def figures(run: Run) -> Iterator[tuple[str, Figure]]:
    yield "contact-points", draw_contact_way(run)
