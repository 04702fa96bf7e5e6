#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What time steps in levels gain, beside what they could gain at best, and what they change in the answer.

Runs the smooth scene and the long rail with 1 to 4 levels, in turn, of which the fastest of each counts, and with
--long with 2 and 3 levels over 1e5 steps, and fills the table of doc/performance.md. Runs that have complete results
are not repeated; remove RESULTS to measure anew.
"""

import functools
import os

from tread.commands import command_parser, run_command
from tread.measured_runs import available_ranks, dry_run, in_turn, rolling_seconds, run_scene
from tread.files import Error
from tread.runs import ROOT
from tread.tables import fill, markdown, number, provenance

# Rolled twice as far as shipped, as the changes looked for are small.
ROLLED = {"Motion/Rolled distance (mm)": 60, "Output/Write volume": "false"}
SCENES = {"smooth": "smooth-rolling.prm", "long rail": "benchmarks/long-rail.prm"}
LEVELS = (2, 3, 4)  # beside one
TURNS = 2
# Without levels but with a shorter step: what it changes is no matter of levels.
SHORTER_STEP = {"Time stepping/Courant number": 0.86}
# Changes with which a scene takes 1e5 steps: true density, hence short steps, and a slow wheel.
LONG_LEVELS = (2, 3)
LONG = {"smooth": {"Scene/Density scale": 1, "Motion/Speed (km per h)": 24},
        "long rail": {"Scene/Density scale": 1, "Motion/Speed (km per h)": 12}}

# What must not change by more than 0.2 %. Slip, of some 0.4 m/s, hears the bodies ring, and another step alone changes
# it more: it must not change by more than that.
PATCH = ("normal_force_N", "longitudinal_force_N", "patch_area_m2", "max_pressure_Pa", "max_shear_Pa", "adhesion_share",
         "creepage")
SLIP = ("max_slip_m_per_s", "frictional_power_W")
ALLOWED_CHANGE, ALLOWED_RESIDUAL = 0.2, 2.  # %; of a larger residual a run warns


def judged(value, allowed):
    return number(value) + ("" if abs(value) <= allowed else " **FAIL**")


def largest_change(summary, base, keys):
    """In %, and in what."""
    changed = {key: 100 * (summary[key] / base[key] - 1) for key in keys}
    worst = max(changed, key=lambda key: abs(changed[key]))
    return changed[worst], worst


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/levels"))
    parser.add_argument("--long", action="store_true", help="runs over 1e5 steps too")
    arguments = parser.parse_args()

    rows, summaries = [], []

    def run(name, levels, changes, label, turn=0):
        settings = {"Time stepping/Levels": levels, **ROLLED, **changes}
        folder = f"{label.replace(' ', '-')}-{levels}-{turn}"
        return run_scene(SCENES[name], os.path.join(arguments.results, folder), settings)

    def ideal_gain(name, levels, changes):
        return dry_run(SCENES[name], {"Time stepping/Levels": levels, **ROLLED, **changes})["ideal gain of levels"]

    for name in SCENES:
        kinds = {"1": (1, {}), "1, shorter step": (1, SHORTER_STEP), **{str(levels): (levels, {}) for levels in LEVELS}}
        runs = in_turn(TURNS, {label: functools.partial(run, name, *kind, f"{name} {label}")
                               for label, kind in kinds.items()}, rolling_seconds)
        summaries += runs.values()
        base, shorter = list(runs.values())[:2]
        allowed_slip = max(ALLOWED_CHANGE, abs(largest_change(shorter, base, SLIP)[0]))
        for label, summary in runs.items():
            is_base = summary is base
            change, worst = largest_change(summary, base, PATCH)
            slip, worst_slip = largest_change(summary, base, SLIP)
            rows.append([name, label, number(summary["cells"]),
                         number(summary["steps"]), f"{ideal_gain(name, *kinds[label]):.2f}",
                         f"{base['wall_s_internal_forces'] / summary['wall_s_internal_forces']:.2f}",
                         f"{rolling_seconds(base) / rolling_seconds(summary):.2f}", number(summary["seconds"]),
                         "-" if is_base else f"{judged(change, ALLOWED_CHANGE)} ({worst})",
                         "-" if is_base else f"{judged(slip, allowed_slip)} ({worst_slip})",
                         judged(100 * summary["energy_residual_of_dissipated"], ALLOWED_RESIDUAL)])
    for name, changes in LONG.items() if arguments.long else ():
        for levels in LONG_LEVELS:
            row = [f"{name}, 1e5 steps", str(levels)]
            try:
                summary = run(name, levels, changes, f"{name} 1e5 steps")
                summaries.append(summary)
            except Error as error:  # a scheme that is not stable shows here
                print(error)
                rows.append(row + ["-"] * 8 + ["**FAIL**: did not end"])
                continue
            rows.append(row + [number(summary["cells"]), number(summary["steps"]),
                               f"{ideal_gain(name, levels, changes):.2f}", "-", "-",
                               number(summary["seconds"]), "-", "-",
                               judged(100 * summary["energy_residual_of_dissipated"], ALLOWED_RESIDUAL)])

    script = "benchmarks/levels.py" + (" --long" if arguments.long else "")
    fill("performance.md", "levels", markdown(
        ["scene", "levels", "cells", "steps", "ideal gain", "gain, internal forces", "gain, rolling", "seconds",
         f"largest change, % (allowed {ALLOWED_CHANGE})", "slip, % (allowed: that of a shorter step)",
         f"energy residual, % of what is dissipated (allowed {ALLOWED_RESIDUAL})"], rows)
        + f"\n\n{available_ranks()} ranks. " + provenance(script, summaries))


if __name__ == "__main__":
    run_command(main)
