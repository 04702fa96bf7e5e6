# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run is, in the line above its pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..patches import Patch
    from ..runs import Run


def is_dynamic(run: Run) -> bool:
    """Whether the run has a defect or a track, so that its forces vary."""
    return "largest_normal_force_N" in run.summary


def whose(run: Run) -> str:
    """Words for the wheel that the plain names of a run belong to, where there are several."""
    return "first wheel: " if "wheel_2_normal_force_N" in run.summary else ""


def forces_title(run: Run) -> str:
    """The figures of the forces over a whole run."""
    summary = run.summary
    if not is_dynamic(run):
        return whose(run) + steady_figures(run)
    parts = []
    for word in ("largest", "least"):
        name = f"{word}_normal_force"
        over = summary.get(f"{name}_over_static")
        parts.append(f"{word} normal force {1e-3 * summary[f'{name}_N']:.1f} kN with the wheel at {1e3 * summary[f'{name}_x_m']:.1f} mm"
                     + (f", {over:.2f} of the static load" if over is not None else "") + (", at the end of the run" if summary.get(f"{name}_at_end") else ""))
    return whose(run) + "\n".join(parts)


def steady_figures(run: Run) -> str:
    parts = []
    force = "vertical force" if "patches" in run.summary else "normal force"  # that of a wheelset in a position is in axes of the track
    for key, template, factor in (("normal_force_N", force + " {:.1f} kN", 1e-3), ("traction_coefficient", "traction coefficient {:.3f}", 1.0),
                                  ("creepage", "creepage {:.3f} %", 100.0)):
        if isinstance(run.summary.get(key), (int, float)):
            parts.append(template.format(factor * run.summary[key]))
    return ", ".join(parts)


def patch_title(run: Run, patch: Patch) -> str:
    """The figures of the patch at the end of a run."""
    size = f"{'elements' if run.summary.get('method') == 'half-space solver' else 'cells'} of {patch.size_x:.2f} mm"
    if not is_dynamic(run):
        return f"{whose(run)}{steady_figures(run)}, {size}"
    force = 1e-3 * patch.normal_force
    at = f" with the wheel at {1e3 * run.history['position_m'][-1]:.1f} mm" if len(run.history.get("position_m", ())) else ""
    return f"{whose(run)}at the end{at}: normal force {force:.1f} kN, {size}"
