# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compare two runs: the figures of their summaries and their contact patches at the end.

    contrib/compare-runs.py RUN_A RUN_B [--above PERCENT] [--csv FILE]

Differences are B less A; relative ones are over the figure of A, and empty where that is 0. Figures are named as in summary.json; those of lists
and sections have / in their names. Left out are references, checksums, and what depends on the machine: wall times and ranks. For each field of the
patch there is the root mean square over the nodes in contact in either run: of A, of B, and of their difference. B is interpolated to the nodes of A; x
counts from the wheel in both. Runs of a wheelset in a position, which has patches of their own axes, are compared by their figures alone.

numpy is imported where patches are compared.
"""

from __future__ import annotations

import csv
import filecmp
import os
from typing import TYPE_CHECKING

from .files import frame_or_rows
from .runs import Run

if TYPE_CHECKING:
    import pandas

COLUMNS = ("name", "a", "b", "difference", "relative_difference")
# A checksum is a number only in its notation: how far two of them lie apart says nothing.
CHECKSUM = ("crc32", "checksum", "sha256", "md5")
OF_THE_MACHINE = ("wall_s", "element_updates_per_s", "cells_and_nodes_bytes", "imbalance_of_cells", "imbalance_of_cost", "ranks_of_contact", "ranks", "reference")


def figures_of(value: object, name: str = "") -> dict[str, float]:
    """{name: number} of a summary with the lists and sections in it, whose names are joined by /."""
    if isinstance(value, bool):
        return {}
    if isinstance(value, (int, float)):
        return {name: value}
    entries = value.items() if isinstance(value, dict) else enumerate(value, 1) if isinstance(value, list) else ()
    return {key: number for own, entry in entries if not str(own).startswith(OF_THE_MACHINE)
            for key, number in figures_of(entry, f"{name}/{own}" if name else str(own)).items()}


def other_bits(run_a: Run, run_b: Run) -> list[str]:
    """What is not the same to the last bit: tables of either run, by their bytes, and figures of the summary, but for those of the machine."""
    tables = {name for run in (run_a, run_b) for name in os.listdir(run.folder) if name.endswith(".csv")}
    figures_a, figures_b = figures_of(run_a.summary), figures_of(run_b.summary)
    return sorted(name for name in tables if not (run_a.has(name) and run_b.has(name) and filecmp.cmp(run_a.path(name), run_b.path(name), shallow=False))) \
        + sorted(name for name in {**figures_a, **figures_b} if figures_a.get(name) != figures_b.get(name))


def row(name: str, a: float, b: float, difference: float | None = None) -> dict:
    difference = b - a if difference is None else difference
    return dict(zip(COLUMNS, (name, a, b, difference, difference / abs(a) if a else None)))


def compared_rows(run_a: Run, run_b: Run) -> list[dict]:
    a, b = figures_of(run_a.summary), figures_of(run_b.summary)
    rows = [row(name, a[name], b[name]) for name in a if name in b and not any(word in name.lower() for word in CHECKSUM)]
    if "patches" not in run_a.summary and "patches" not in run_b.summary and run_a.has("patch.csv") and run_b.has("patch.csv"):
        from .comparison import Shifted

        nodes = Shifted(run_b.patch, run_a.patch, (0.0, 0.0))
        for field in run_a.patch.fields:
            a_mean, b_mean = [float((values[field][nodes.counted] ** 2).mean() ** 0.5) for values in (nodes.own, nodes.reference)]
            unit = run_a.patch.units[field].replace("/", "_per_")
            rows.append(row(f"patch_{field}_rms_{unit}", a_mean, b_mean, nodes.rms((field,), nodes.counted)))
    return rows


def compare(run_a: Run | str | os.PathLike, run_b: Run | str | os.PathLike) -> pandas.DataFrame | list[dict]:
    """What differs between two runs, runs or their folders: name, a, b, difference, relative_difference; see the beginning of the
    module. A pandas DataFrame, or a list of dicts where pandas is not installed. @raises DataError"""
    return frame_or_rows(compared_rows(*(run if isinstance(run, Run) else Run(run) for run in (run_a, run_b))), list(COLUMNS))


def text_of_rows(rows: list[dict], above: float | None = None) -> str:
    """A table for the screen, with those rows alone whose relative difference is above so many per cent."""
    shown = [one for one in rows if above is None or abs(one["relative_difference"] or (one["difference"] and float("inf"))) > 1e-2 * above]
    width = max((len(one["name"]) for one in shown), default=4)
    lines = [f"{'':{width}} {'A':>13} {'B':>13} {'B - A':>13} {'of A':>10}"]
    for one in shown:
        share = one["relative_difference"]
        lines.append(f"{one['name']:{width}} {one['a']:13.6g} {one['b']:13.6g} {one['difference']:13.4g} " + (f"{100 * share:+8.2f} %" if share is not None else f"{'':>10}"))
    return "\n".join(lines)


def main() -> None:
    from .commands import command_parser  # which wants numpy

    parser = command_parser(__doc__)
    parser.add_argument("a", metavar="RUN_A")
    parser.add_argument("b", metavar="RUN_B")
    parser.add_argument("--above", type=float, metavar="PERCENT", help="only what differs by more than so much of A")
    parser.add_argument("--csv", metavar="FILE", help="write the whole table to this file too")
    arguments = parser.parse_args()
    rows = compared_rows(Run(arguments.a), Run(arguments.b))
    if arguments.csv:
        with open(arguments.csv, "w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    print(text_of_rows(rows, arguments.above))


def command_line() -> None:
    """What contrib/compare-runs.py and tread-compare-runs do."""
    from .commands import run_command  # which wants numpy

    run_command(main)
