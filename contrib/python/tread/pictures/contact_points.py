# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `tread contact-points` left: where both wheels of a wheelset touch over the lateral shift."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from ..plots import BLUE, GREEN, RED, name_sides, subplots
from ..runs import Run

DOTS = {"marker": ".", "markersize": 3.5}  # a row between two gaps is no line


def broken(table: dict[str, np.ndarray], values: np.ndarray, sides: tuple[str, ...]) -> tuple[np.ndarray, np.ndarray]:
    """The line of values over the shift, with gaps where the contact of one of the sides jumps from one shift to the next."""
    shift = table["lateral_shift_mm"]
    far = 2. + 4. * np.diff(shift)  # mm; on a tread it moves by up to three times the shift
    jumps = [np.abs(np.diff(table[f"{side}_{place}_mm"])) > far for side in sides for place in ("y_wheel", "y_rail")]
    at = np.flatnonzero(np.any(jumps, axis=0)) + 1
    return np.insert(shift, at, np.nan), np.insert(values, at, np.nan)


def draw_contact_points(run: Run) -> Figure:
    table = run.table("contact_points.csv", ("lateral_shift_mm", "radius_difference_mm"))
    shift = table["lateral_shift_mm"]
    figure, axes = subplots(2, 2, figsize=(11, 7.4), sharex=True)
    for side, colour in (("own", BLUE), ("other", RED)):
        axes[0, 0].plot(*broken(table, table[f"{side}_y_wheel_mm"], (side,)), color=colour, **DOTS, label=f"{side} wheel, on its profile")
        axes[0, 0].plot(*broken(table, table[f"{side}_y_rail_mm"], (side,)), color=colour, ls="--", **DOTS, label=f"{side} wheel, on the rail")
        axes[0, 1].plot(*broken(table, np.degrees(table[f"{side}_angle_rad"]), (side,)), color=colour, **DOTS, label=f"{side} wheel")
    axes[0, 0].set(ylabel="y of the contact [mm], + to the field side", title="where they touch; flange and gauge side at y < 0")
    axes[0, 1].set(ylabel="contact angle [degrees]", title="+ where the rail falls to the gauge side, as at the flange")
    axes[1, 0].plot(*broken(table, table["radius_difference_mm"], ("own", "other")), color=GREEN, **DOTS)
    axes[1, 0].set(xlabel="lateral shift of the wheelset [mm],\n+ own flange to its rail", ylabel="rolling radius difference [mm],\nown less other wheel")
    one_side = (shift > 0) & np.isfinite(table["equivalent_conicity"])
    axes[1, 1].plot(shift[one_side], table["equivalent_conicity"][one_side], color=GREEN)
    axes[1, 1].set(xlabel="amplitude of the lateral motion [mm]", ylabel="equivalent conicity [-]", ylim=(0, 1.1 * table["equivalent_conicity"][one_side].max(initial=0.1)))
    for axis in axes[0]:
        axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.02), ncol=2)
    return figure


def draw_profiles(run: Run) -> Figure:
    """Both profiles of the own side as they were read, in the track, and where they touch over the shift."""
    table = run.table("contact_points.csv", ("lateral_shift_mm", "own_y_rail_mm"))
    rail, wheel = (run.table(f"{body}_profile.csv", ("y_rail_mm", "z_mm")) for body in ("rail", "wheel"))
    figure, axis = subplots(1, 1, figsize=(11, 5.4))
    axis.plot(rail["y_rail_mm"], rail["z_mm"], color="black", lw=1.6, label="rail")
    axis.plot(wheel["y_rail_mm"], wheel["z_mm"], color=BLUE, lw=1.6, label="wheel, where it stands in the middle of the track")
    touches = table["own_y_rail_mm"]
    along = np.argsort(rail["y_rail_mm"], kind="stable")
    points = axis.scatter(touches, np.interp(touches, rail["y_rail_mm"][along], rail["z_mm"][along]), c=table["lateral_shift_mm"], cmap="coolwarm", s=26,
                          edgecolors="black", linewidths=0.4, zorder=3, label="contact on the rail")
    figure.colorbar(points, ax=axis, label="lateral shift [mm],\n+ own flange to its rail", shrink=0.6)
    axis.set(xlabel="y from the middle of the rail's top [mm]", ylabel="z from the rail tops [mm]", aspect="equal",
             title="profiles as they were read, in the track")
    name_sides(axis)
    axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=3)
    return figure


def figures(run: Run) -> Iterator[tuple[str, Figure]]:
    if run.has("contact_points.csv"):
        yield "contact-points", draw_contact_points(run)
        yield "profiles", draw_profiles(run)
