#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Error against time with and without a matched surface: the table 'matched-surface' of doc/rolling-error.md.

Runs the low-strain scenes and the same under spin, of several cell sizes, with `Solid/Matched surface` true and false in turn, on an otherwise idle
machine; the fastest of the turns counts.
"""

from __future__ import annotations

import os

from tread.commands import command_parser, run_command
from tread.measured_runs import MATCHED_SURFACE, available_ranks, in_turn, run_scene, steps_seconds
from tread.low_strain import (LOW_STRAIN_SPIN, LOW_STRAIN_SPIN_CELLS, LOW_STRAIN_SPIN_LIMIT, SUMMARY_MEASURES, compare_with_half_space, difference,
                              low_strain_scene, signed)
from tread.runs import ROOT
from tread.tables import fill, markdown, number, provenance

SIZES = (1.3, 1.0, 0.63, 0.5, 0.33, 0.2)


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results", "matched-surface"))
    parser.add_argument("--turns", metavar="N", type=int, default=3)
    parser.add_argument("--sizes", metavar="MM", type=float, nargs="+", default=list(SIZES))
    arguments = parser.parse_args()
    rows, summaries = [], []
    for size in arguments.sizes:
        scene, settings = low_strain_scene(size)
        folder = lambda what, kind, turn: os.path.join(arguments.results, f"{what}-{size:g}-{kind}-{turn}")
        best = in_turn(arguments.turns, {
            kind: lambda turn, kind=kind, changes=changes: dict(
                run_scene(scene, folder("rolling", kind, turn), {**settings, **changes, "Output/Write volume": "false"}),
                folder=folder("rolling", kind, turn))
            for kind, changes in MATCHED_SURFACE.items()})
        for kind, changes in MATCHED_SURFACE.items():
            summary = best[kind]
            summaries.append(summary)
            spin = None
            if size in LOW_STRAIN_SPIN_CELLS:
                under_spin = run_scene(scene, folder("spin", kind, 0), {**settings, **LOW_STRAIN_SPIN, **changes,
                                                                        "Output/Write volume": "false"})
                spin = 100 * (abs(under_spin["lateral_force_N"]) / under_spin["normal_force_N"] / LOW_STRAIN_SPIN_LIMIT - 1)
            fields = compare_with_half_space(summary["folder"])
            rows.append([f"{size:g}", kind, number(summary["cells"]), number(summary["seconds"]),
                         f"{summary['seconds'] / best['without']['seconds']:.3f}",
                         f"{steps_seconds(summary) / steps_seconds(best['without']):.3f}"]
                        + [signed(difference(summary, key, source)) for _, key, source in SUMMARY_MEASURES
                           if key in ("max_pressure_Pa", "creepage", "adhesion_share")]
                        + [signed(100 * fields[key]) for key in ("pressure_rms_over_max", "shear_rms_over_max", "micro_slip_rms_over_max")]
                        + [signed(spin)])
    table = markdown(["cells [mm]", "matched surface", "cells", "seconds", "over without", "of the steps alone", "largest pressure [%]",
                      "adhesion share [points]", "creepage [%]", "pressure, RMS [%]", "shear stress, RMS [%]", "micro-slip, RMS [%]",
                      "force by spin [%]"], rows)
    fill("rolling-error.md", "matched-surface", f"{table}\n\n{available_ranks()} ranks, fastest of {arguments.turns} in turn. "
         + provenance("benchmarks/matched-surface.py", summaries))


if __name__ == "__main__":
    run_command(main)
