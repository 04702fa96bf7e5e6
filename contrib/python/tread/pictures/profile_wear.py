# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `tread wear` left: both profiles before and after, how deep they wore, and how pressure and work changed meanwhile."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import viridis
from matplotlib.figure import Figure

from ..plots import BLUE, GREY, RED, subplots
from ..runs import Run

POINTS = ("state_number", "y_start_mm", "z_start_mm", "y_mm", "z_mm", "depth_mm")


def exaggeration(depth: float, height: float) -> int:
    """By how much depths (mm) are drawn larger to be seen in a picture of this height (mm): 1, 2, 5, 10, ...; the deepest fills a sixth of it at most."""
    if depth <= 0.0:
        return 1
    most = height / (6.0 * depth)
    steps = [factor * 10**power for power in range(6) for factor in (1, 2, 5)]
    return max([step for step in steps if step <= most], default=1)


def draw_body(shape: Axes, depth: Axes, table: dict[str, np.ndarray], count: str, body: str) -> None:
    states = np.unique(table["state_number"])
    last = table["state_number"] == states[-1]
    y, z = table["y_start_mm"][last], table["z_start_mm"][last]
    worn = table["depth_mm"][last]
    touched = worn > 0.01 * max(worn.max(), 1e-12)
    factor = exaggeration(worn.max(), np.ptp(z))
    shape.plot(y, z, color=GREY, label="new")
    shape.plot(y + factor * (table["y_mm"][last] - y), z + factor * (table["z_mm"][last] - z), color=RED, label=f"worn, {factor} times as deep" if factor > 1 else "worn")
    shape.set(aspect="equal", xlabel="y [mm], the gauge side on the left", ylabel="z [mm]", title=body)
    shape.legend()
    for number, state in enumerate(states[1:], 1):
        own = table["state_number"] == state
        depth.plot(table["y_start_mm"][own], 1e3 * table["depth_mm"][own], color=viridis(0.9 * (1.0 - number / (len(states) - 1))), label=f"{table[count][own][0]:,.0f}")
    if touched.any():
        depth.set(xlim=(y[touched].min() - 3.0, y[touched].max() + 3.0))
    depth.set(xlabel="y [mm]", ylabel="depth of wear [um]", title=f"{body}, after so many {'passages' if count == 'passages' else 'turns'}")
    depth.invert_yaxis()
    depth.legend()


def draw_profiles(run: Run) -> Figure:
    tables = [(run.table(f"{body}_wear.csv", (*POINTS, count)), body, count) for body, count in (("rail", "passages"), ("wheel", "wheel_turns"))]
    worn = [entry for entry in tables if entry[0]["depth_mm"].max() > 0.0] or tables[:1]
    figure, axes = subplots(2, len(worn), figsize=(6.2 * len(worn), 8.4), squeeze=False)
    for (table, body, count), shape, depth in zip(worn, axes[0], axes[1]):
        draw_body(shape, depth, table, count, body)
    return figure


def draw_steps(run: Run) -> Figure:
    steps = run.table("wear_steps.csv", ("passages", "wheel_turns", "rail_area_mm2", "wheel_area_mm2", "rail_depth_mm", "wheel_depth_mm", "friction_work_J_per_m", "max_pressure_MPa", "mean_max_pressure_MPa"))
    over, name = (steps["passages"], "passages of wheels over the rail") if steps["passages"].max() > 0.0 else (steps["wheel_turns"], "turns of the wheel")
    figure, (pressure, work, area) = subplots(3, 1, figsize=(8.0, 8.4), sharex=True)
    pressure.plot(over, steps["max_pressure_MPa"], color=RED, label="largest of all contacts")
    pressure.plot(over, steps["mean_max_pressure_MPa"], color=BLUE, linestyle="--", label="mean of the contacts")
    pressure.set(ylabel="largest pressure [MPa]", ylim=(0.0, None))
    pressure.legend()
    work.plot(over, steps["friction_work_J_per_m"], color=BLUE)
    work.set(ylabel="work of friction [J/m]", title="of a passage, mean of the contacts", ylim=(0.0, 1.1 * steps["friction_work_J_per_m"].max()))
    for body, colour, line in (("rail", RED, "-"), ("wheel", BLUE, "--")):
        if steps[f"{body}_depth_mm"].max() > 0.0:
            area.plot(over, steps[f"{body}_area_mm2"], color=colour, linestyle=line, label=body)
    area.set(xlabel=name, ylabel="area worn away [mm²]", ylim=(0.0, None))
    area.legend()
    return figure


def figures(run: Run) -> Iterator[tuple[str, Figure]]:
    yield "wear", draw_profiles(run)
    yield "wear-steps", draw_steps(run)
