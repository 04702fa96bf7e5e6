#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a run's time follows the number of ranks and cells, what memory a cell takes, and that ranks agree.

Fills the tables of doc/performance.md: strong scaling on one and two ranks, cost and memory of a cell over the number
of cells, weak scaling, and the differences of 2, 3 and 4 ranks from one. Runs whose times are compared are made in
turn; the fastest of each counts, and of ratios the median. Runs that have complete results are not repeated; remove
RESULTS to measure anew.
"""

import functools
import os
import statistics

from tread.commands import command_parser, run_command
from tread.measured_runs import in_turn, run_scene, steps_seconds
from tread.runs import ROOT
from tread.tables import fill, markdown, number, provenance

# The same contact in ever more cells of 0.33 mm around it. The start is left rough: what counts is the pace.
SIZE_SCENE = "verification/half-space-0.33-mu0.30.prm"
SIZE_CHANGES = {"Motion/Rolled distance (mm)": 1, "Motion/Creepage": 0.0029, "Start/Tolerance": 0.01}
SIZES = ({"Mesh/Fine layers": 1, "Mesh/Cells per level": 1}, {"Mesh/Fine layers": 8}, {"Mesh/Fine layers": 20},
         {"Mesh/Fine layers": 40}, {"Mesh/Fine layers": 32, "Mesh/Fine half width (mm)": 20},
         {"Mesh/Fine layers": 64, "Mesh/Fine half width (mm)": 22})
LARGE = {"Mesh/Fine layers": 64, "Mesh/Fine half width (mm)": 80}
WEAK = ((2, 3), (4, 5))  # which of the sizes on one rank is compared with which on two

# name: (scene, changes); the first two are whole runs.
STRONG = {"smooth-rolling, 0.63 mm": ("smooth-rolling.prm", {}),
          "half-space, 0.33 mm": ("verification/half-space-0.33-mu0.30.prm", {}),
          "fine to a greater depth, 1 mm rolled": (SIZE_SCENE, {**SIZE_CHANGES, **SIZES[3]}),
          "fine all over, 1 mm rolled": (SIZE_SCENE, {**SIZE_CHANGES, **SIZES[5]})}

# What all ranks must agree on, with a tight contact tolerance.
RANKS = {"Mesh/Finest cell (mm)": 1.3, "Mesh/Fine half width (mm)": 9, "Motion/Rolled distance (mm)": 12,
         "Contact/Tolerance": 1e-12}
NUMBERS = ("normal_force_N", "longitudinal_force_N", "traction_coefficient", "patch_area_m2", "max_pressure_Pa",
           "max_shear_Pa", "adhesion_share", "max_slip_m_per_s", "frictional_work_J")

PICTURES_OFF = {"Output/Write volume": "false"}
TURNS, STRONG_TURNS = 2, 3


def step_seconds(summary):
    return steps_seconds(summary) / summary["steps"]


def ratio(pairs, time_of):
    """Of one rank over two, of runs one after the other: the median, and from the least to the largest."""
    ratios = sorted(time_of(one) / time_of(two) for one, two in pairs)
    return f"{statistics.median(ratios):.2f} ({ratios[0]:.2f} to {ratios[-1]:.2f})"


def strong(run):
    rows, summaries = [], []
    for name, (scene, changes) in STRONG.items():
        pairs = [[run(scene, changes, ranks, turn) for ranks in (1, 2)] for turn in range(STRONG_TURNS)]
        one, two = (min(of_ranks, key=lambda summary: summary["seconds"]) for of_ranks in zip(*pairs))
        summaries += [one, two]
        rows.append([name, number(one["cells"]), number(one["seconds"]), number(two["seconds"]),
                     ratio(pairs, lambda summary: summary["seconds"]), ratio(pairs, step_seconds),
                     ratio(pairs, lambda summary: summary["wall_s_internal_forces"]),
                     ratio(pairs, lambda summary: summary["wall_s_contact"])])
    return ["scene", "cells", "seconds, 1 rank", "2 ranks", "ratio", "of a step", "of internal forces",
            "of contact"], rows, summaries


def size(run, sizes):
    rows = []
    found = in_turn(TURNS, {n: functools.partial(run, SIZE_SCENE, {**SIZE_CHANGES, **mesh}, 1)
                            for n, mesh in enumerate(sizes)}, step_seconds)
    summaries = list(found.values())
    for summary in summaries:
        cells, smallest = summary["cells"], summaries[0]["cells"]
        per_cell = 1e9 / cells / summary["steps"]
        more = (summary["peak_bytes"] - summaries[0]["peak_bytes"]) / (cells - smallest) if cells > smallest else None
        rows.append([number(cells), number(summary["steps"]),
                     f"{per_cell * summary['wall_s_internal_forces']:.1f}",
                     f"{per_cell * summary['wall_s_nodes']:.1f}", f"{1e9 / cells * step_seconds(summary):.1f}",
                     number(summary["cells_and_nodes_bytes"] / cells), number(summary["peak_bytes"] / cells),
                     number(more), number(summary["seconds"])])
    return ["cells", "steps", "internal forces, ns a cell and step", "nodes, ns", "all, ns",
            "cells and nodes, bytes a cell", "peak of the process, bytes a cell",
            "the same, added since the first row", "seconds"], rows, summaries


def weak(run):
    rows, summaries = [], []
    for small, large in WEAK:
        one, two = in_turn(TURNS, {ranks: functools.partial(run, SIZE_SCENE, {**SIZE_CHANGES, **SIZES[n]}, ranks)
                                   for ranks, n in ((1, small), (2, large))}, step_seconds).values()
        summaries += [one, two]
        growth = two["cells"] / one["cells"] / 2
        rows.append([number(one["cells"]), number(two["cells"]), f"{1e3 * step_seconds(one):.3g}",
                     f"{1e3 * step_seconds(two):.3g}", f"{growth * step_seconds(one) / step_seconds(two):.2f}"])
    return ["cells on one rank", "cells on two", "ms a step, one rank", "ms a step, two ranks",
            "efficiency for equal cells a rank"], rows, summaries


def agreement(run):
    one = run("smooth-rolling.prm", RANKS, 1)
    rows, summaries = [], [one]
    for ranks in (2, 3, 4):
        summary = run("smooth-rolling.prm", RANKS, ranks)
        summaries.append(summary)
        changed = {key: abs(summary[key] / one[key] - 1) for key in NUMBERS}
        worst = max(changed, key=changed.get)
        rows.append([str(ranks), f"{changed[worst]:.1e}" + ("" if changed[worst] <= 1e-8 else " **FAIL**"), worst])
    return ["ranks", "largest relative difference from 1 rank (allowed 1e-8)", "in"], rows, summaries


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/scaling"))
    parser.add_argument("--large", action="store_true", help="a mesh of five million cells too")
    arguments = parser.parse_args()

    def run(scene, changes, ranks, turn=0):
        name = "-".join([os.path.basename(scene)[:-len(".prm")]] + [f"{value}" for value in changes.values()])
        return run_scene(scene, os.path.join(arguments.results, f"{name}-{ranks}-ranks-{turn}"),
                         {**PICTURES_OFF, **changes}, ranks)

    sizes = SIZES + ((LARGE,) if arguments.large else ())
    script = "benchmarks/scaling.py" + (" --large" if arguments.large else "")
    # Weak scaling comes before the sizes, which take its runs over: those on one and two ranks must be made in turn.
    for name, (header, rows, summaries) in (("strong-scaling", strong(run)), ("weak-scaling", weak(run)),
                                            ("cost-of-a-cell", size(run, sizes)), ("ranks", agreement(run))):
        fill("performance.md", name, markdown(header, rows) + "\n\n" + provenance(script, summaries))


if __name__ == "__main__":
    run_command(main)
