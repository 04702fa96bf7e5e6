#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a time step sends and where it waits on 2 to 64 ranks, in counts that do not depend on the machine, and how long a step is by them.

Runs scenes, on more ranks than cores too, with message_counter (benchmarks/message_counter.cc, made with the benchmarks) loaded before MPI, which
counts over the time steps alone. A model of a step has the cells by their pace on one rank, where as many runs as there are cores go at the same
time, the contact shared by the ranks that sweep, a latency for each wait and each doubling of the ranks in a collective operation, and the bandwidth.
Fills two tables of doc/performance.md, section 4. Runs that have complete results are not repeated; remove RESULTS to measure anew.
"""

from __future__ import annotations

import csv
import glob
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor

from tread.commands import command_parser, run_command
from tread.files import Error, is_complete, read_summary
from tread.measured_runs import shipped, steps_seconds
from tread.runs import PROGRAM, ROOT, arguments_of, command, environment, must_end_well
from tread.tables import fill, markdown, number, provenance

# The start is left rough where it is long: what counts are steps.
FINE = {"Motion/Rolled distance (mm)": 1, "Motion/Creepage": 0.0029, "Start/Tolerance": 0.01}
SCENES = {"smooth-rolling, 1.3 mm": ("smooth-rolling.prm", {"Mesh/Finest cell (mm)": 1.3, "Mesh/Fine half width (mm)": 9, "Motion/Rolled distance (mm)": 4}),
          "half-space, 0.33 mm": ("verification/half-space-0.33-mu0.30.prm", FINE),
          "fine all over, 0.33 mm": ("verification/half-space-0.33-mu0.30.prm",
                                     {**FINE, "Motion/Rolled distance (mm)": 0.5, "Mesh/Fine layers": 64, "Mesh/Fine half width (mm)": 22})}
RANKS = (2, 4, 8, 16, 32, 64)
TEN_TIMES = "ten times as many cells"  # by the counts of the last scene: surfaces between ranks grow by the power 2/3
CORES = 2


def counter() -> str:
    found = glob.glob(os.path.join(os.path.dirname(PROGRAM), "..", "benchmarks", "libmessage_counter.so"))
    if not found:
        raise Error("there is no libmessage_counter.so beside the program: build the benchmarks")
    return os.path.abspath(found[0])


def counted(scene: str, settings: dict, ranks: int, folder: str) -> dict:
    """The summary of a run, with what the busiest rank has in a step of each count."""
    table = os.path.join(folder, "messages.csv")
    if not (is_complete(folder) and os.path.exists(table)):
        os.makedirs(folder, exist_ok=True)
        line = command(arguments_of(shipped(scene), {"Output/Write volume": "false", **settings}, folder), ranks, PROGRAM)
        at = line.index(PROGRAM)
        line[at:at] = ["env", f"LD_PRELOAD={counter()}", f"TREAD_MESSAGES={table}"]
        print(" ".join(line), flush=True)
        must_end_well(subprocess.run(line, env=environment(), capture_output=True, text=True))
    summary = read_summary(folder)
    with open(table, encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    counts = {key: max(float(row[key]) for row in rows) / summary["steps"] for key in rows[0]}
    return {**summary, **counts}


def fastest(runs: list[dict]) -> dict:
    return min(runs, key=lambda run: steps_seconds(run) / run["steps"])


def alone(scene: str, settings: dict, folder: str) -> dict:
    """One of as many runs on one rank as there are cores, at the same time: the ranks of a run have no more of the machine. Its pace is that of the slower one."""
    with ThreadPoolExecutor(CORES) as pool:
        runs = list(pool.map(lambda k: counted(scene, settings, 1, f"{folder}-{k}"), range(CORES)))
    return max(runs, key=lambda run: steps_seconds(run) / run["steps"])


def step_of(one: dict, run: dict, ranks: int, latency: float, bandwidth: float, growth: float = 1.) -> dict:
    """Seconds of the parts of a step, by the run on one rank and the counts of that on so many. @param growth of the number of cells"""
    surface = growth ** (2. / 3.)
    return {"cells": growth * (one["wall_s_internal_forces"] + one["wall_s_nodes"]) / one["steps"] / ranks * run["imbalance_of_cost"],
            "contact": one["wall_s_contact"] / one["steps"] / run["ranks_of_contact"],
            "messages": run["waits"] * latency + run["bytes"] * surface / bandwidth,
            "collectives": run["doublings"] * latency + run["collective_bytes"] / bandwidth}


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/messages"))
    parser.add_argument("--ranks", type=int, default=RANKS[-1], metavar="N", help=f"up to so many (default {RANKS[-1]})")
    parser.add_argument("--latency", type=float, default=2e-6, metavar="S", help="of a message of the network in the model (default 2e-6)")
    parser.add_argument("--bandwidth", type=float, default=1e10, metavar="BYTES", help="of a rank, in a second (default 1e10)")
    parser.add_argument("--own-latency", type=float, default=7e-7, metavar="S", help="the same of this machine (default 7e-7)")
    parser.add_argument("--own-bandwidth", type=float, default=4e9, metavar="BYTES", help="of this machine (default 4e9)")
    parser.add_argument("--turns", type=int, default=3, metavar="N", help="runs on no more ranks than cores are made so often, of which the fastest counts (default 3)")
    parser.add_argument("--scenes", type=int, default=len(SCENES), metavar="N", help="the first N only")
    arguments = parser.parse_args()
    summaries, count_rows, rows = [], [], []
    for name, (scene, settings) in list(SCENES.items())[:arguments.scenes]:
        folder = os.path.join(arguments.results, name.partition(",")[0].replace(" ", "-"))
        # In turn, so that what slows the machine down for some time does so for all.
        turns = [(alone(scene, settings, f"{folder}-1-{turn}"), counted(scene, settings, CORES, f"{folder}-{CORES}-{turn}")) for turn in range(arguments.turns)]
        one, of_cores = (fastest(list(runs)) for runs in zip(*turns))
        summaries.append(one)
        pace = {}
        for ranks in (1, *(ranks for ranks in RANKS if ranks <= arguments.ranks)):
            run = one if ranks == 1 else of_cores if ranks == CORES else counted(scene, settings, ranks, f"{folder}-{ranks}")
            if ranks > 1:
                summaries.append(run)
                count_rows.append([name, number(run["cells"]), str(ranks), f"{run['imbalance_of_cost']:.2f}", str(run["ranks_of_contact"]), f"{run['messages']:.1f}",
                                   f"{run['bytes'] / 1e3:.1f}", f"{run['waits']:.1f}", f"{run['collectives']:.1f}", f"{run['doublings']:.1f}", f"{run['collective_bytes'] / 1e3:.1f}"])
                print(" | ".join(count_rows[-1]), flush=True)
            for label, growth in ((name, 1.),) + (((TEN_TIMES, 10.),) if name == list(SCENES)[-1] else ()):
                parts = step_of(one, run, ranks, arguments.latency, arguments.bandwidth, growth)
                whole = sum(parts.values())
                pace.setdefault(label, whole)
                own = sum(step_of(one, run, ranks, arguments.own_latency, arguments.own_bandwidth).values())
                here = [f"{1e6 * own:.0f}", f"{1e6 * steps_seconds(run) / run['steps']:.0f}"] if ranks <= CORES and growth == 1. else ["", ""]
                rows.append([label, number(growth * run["cells"]), str(ranks), *(f"{1e6 * part:.0f}" for part in parts.values()), f"{1e6 * whole:.0f}", f"{pace[label] / whole / ranks:.2f}", *here])
    rows.sort(key=lambda row: row[0] == TEN_TIMES)
    note = "\n\n" + provenance("benchmarks/messages.py", summaries)
    fill("performance.md", "messages", markdown(["scene", "cells", "ranks", "largest cost of cells over the mean", "ranks that sweep", "messages a step", "kB", "waits",
                                                 "collective operations a step", "doublings in them", "kB given to them"], count_rows) + note)
    fill("performance.md", "scaling-model", markdown(["scene", "cells", "ranks", "cells, us", "contact", "messages", "collective operations", "a step, us", "efficiency",
                                                      "by this machine's latency, us", "measured, us"], rows) + note)


if __name__ == "__main__":
    run_command(main)
