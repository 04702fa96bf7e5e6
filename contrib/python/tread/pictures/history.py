# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forces over the position of the wheel, and energies over time."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from ..defects import extents_of_defects
from ..files import reference_value
from ..loads import static_load
from ..plots import BLUE, GREEN, ORANGE, PURPLE, RED, SKY, legend_beside, passages, plot_passages, shade_defects, shown_rows, span_at_least, subplots
from ..runs import Run
from .titles import forces_title, is_dynamic


def marker(history: dict[str, np.ndarray]) -> dict[str, str]:
    """A single row is a point, not a line."""
    return {"marker": "o"} if len(history["time_s"]) < 3 else {}


def number_of_passages(history: dict[str, np.ndarray]) -> str:
    number = len(passages(history["position_m"]))
    return f"\n{number} passages, the last one in full colour" if number > 1 else ""


def draw_forces(run: Run) -> Figure:
    position = 1e3 * run.history["position_m"]
    rows = shown_rows(position, run.parameters)
    x, history, single = position[rows], {name: values[rows] for name, values in run.history.items()}, marker(run.history)
    wheelset = "patches" in run.summary
    both = "other_normal_force_N" in history
    longitudinal, lateral = (("longitudinal of both wheels, + forward", "lateral of both wheels, + to the own side") if both
                             else ("longitudinal, + forward", "lateral, + to the field side"))
    figure, axes = subplots(4, 1, figsize=(10, 9.6), sharex=True, height_ratios=(1.5, 1, 1, 1))
    for axis, names in ((axes[0], (("normal_force_N", "vertical, of all patches" if wheelset else "normal", BLUE, "-"),
                                   ("inner_normal_force_N", "of the inner piece, such as a nose", SKY, "-"),
                                   *((name, f"normal, wheel {name.split('_')[1]}", SKY, "--") for name in history
                                     if name.startswith("wheel_") and name.endswith("_normal_force_N")))),
                        (axes[1], (("longitudinal_force_N", longitudinal, RED, "-"),
                                   ("lateral_force_N", lateral, GREEN, "--")))):
        for name, text, colour, style in names:
            if name in history:
                plot_passages(axis, x, x, 1e-3 * history[name], color=colour, ls=style, **single,
                              label=f"{text}\n(at the end {round(1e-3 * history[name][-1], 2) + 0.0:.2f} kN)")
    axes[0].set_ylabel("vertical force [kN]" if wheelset else "normal force [kN]")
    axes[1].set_ylabel("force on\nthe wheelset [kN]" if both else "force on\nthe wheel [kN]")
    static = static_load(run.parameters) if is_dynamic(run) else None
    if static is not None:
        axes[0].axhline(static, color="black", ls=":", lw=1.1, label=f"static load {static:.1f} kN")
    loads = [values for name, values in history.items() if name.endswith("normal_force_N") and not name.startswith("other_")]
    span_at_least(axes[0], np.append([] if static is None else static, 1e-3 * np.concatenate(loads)), 0.02, 0.1)
    for axis, name, factor, text, colour in ((axes[2], "traction_coefficient", 1.0, "traction\ncoefficient [-]", PURPLE),
                                             (axes[3], "creepage", 100.0, "creepage by angular\nvelocity alone [%]" if wheelset else "creepage [%]", ORANGE)):
        axis.set_ylabel(text)
        if name not in history:
            continue
        values = factor * history[name]
        plot_passages(axis, x, x, values, color=colour, label=f"at the end {round(values[-1], 4) + 0.0:.4f}", **single)
        wanted = reference_value(run.summary, name)
        if wanted is not None:
            wanted *= factor
            axis.axhline(wanted, color="black", ls="--", lw=1.1, label=f"reference {wanted:.4f}")
        span_at_least(axis, np.append(wanted if wanted is not None else values[:0], values), *((0.02, 0.005) if name == "traction_coefficient" else (0.1, 0.001)))
    begins = "" if rows.all() else f"; history.csv begins at {position.min():.0f} mm"
    axes[-1].set_xlabel(f"position of the wheel along the rail [mm], it rolls to the right{begins}")
    axes[0].set_title(forces_title(run) + number_of_passages(history))
    for axis in axes:
        shade_defects(axis, run.parameters, named=axis is axes[0])
        legend_beside(axis)
    figure.align_ylabels(axes)
    return figure


def draw_energies(run: Run) -> Figure:
    history, time = run.history, 1e3 * run.history["time_s"]
    position = 1e3 * history["position_m"]
    figure, axes = subplots(3, 1, figsize=(10, 8.4), sharex=True)
    large = (("external_work_J", "external work", "black"), ("kinetic_energy_J", "kinetic energy, change", BLUE),
             ("internal_energy_J", "internal (elastic)", GREEN), ("frictional_work_J", "frictional work", RED),
             ("plastic_work_J", "plastic work", PURPLE))
    small = (("hourglass_energy_J", "hourglass", PURPLE), ("damping_work_J", "damping", ORANGE), ("contact_loss_J", "contact loss", SKY))
    scale = 0.0
    for axis, group in ((axes[0], large), (axes[1], small)):
        for name, label, colour in group:
            values = history.get(name)
            if values is None or (name == "plastic_work_J" and not values.any()):
                continue
            if name == "kinetic_energy_J":
                values = np.concatenate([values[rows] - values[rows][0] for rows in passages(position)])
            if axis is axes[0]:
                scale = max(scale, abs(values).max())
            plot_passages(axis, position, time, values, color=colour, label=f"{label}\n({values[-1]:.3g} J)", **marker(history))
        axis.set_ylabel("energy [J]")
    residual = history.get("energy_residual_J")
    if residual is not None and scale > 0:
        share = 100 * residual / scale
        plot_passages(axes[2], position, time, share, color=BLUE, label="residual", **marker(history))
        axes[2].axhspan(-0.1, 0.1, color="#DDEBDD", zorder=0, label="$\\pm$0.1 %")
        limit = max(0.15, 1.1 * abs(share).max())
        axes[2].set_ylim(-limit, limit)
    # While the middle of the wheel is over a defect.
    for number, (begin, end) in enumerate((begin, end) for begin, end in extents_of_defects(run.parameters) if end is not None):
        for rows in passages(position):
            over = (position[rows] >= begin) & (position[rows] <= end)
            if over.any():
                for axis in axes:
                    label = "wheel over\na defect" if axis is axes[0] and number == 0 and rows.start == 0 else None
                    axis.axvspan(time[rows][over][0], time[rows][over][-1], color="black", alpha=0.10, lw=0, zorder=0, label=label)
    axes[2].set_ylabel("residual of the balance [%\nof the largest term above]")
    axes[2].set_xlabel("time [ms]")
    axes[0].set_title("energies since the start of the run" + (", anew for each passage; " if len(passages(position)) > 1 else "; ") + "in brackets: at the end")
    for axis in axes:
        legend_beside(axis)
    figure.align_ylabels(axes)
    return figure


def figures(run: Run) -> Iterator[tuple[str, Figure]]:
    if not run.has("history.csv") or not len(run.history["time_s"]):
        return
    if "position_m" in run.history:
        yield "forces", draw_forces(run)
        if "energy_residual_J" in run.history:
            yield "energies", draw_energies(run)
