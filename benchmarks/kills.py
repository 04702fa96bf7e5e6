#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that are killed at random instants and resumed: is anything lost, are the bits the same?

A reproducible run with three levels of time steps on 1, 2 or 3 ranks is killed (SIGKILL, which no program can answer): all its processes at once, or one
rank of several. The kill comes at a random row of the history, before the first one too, and every second time when next a file is being written. The run
writes a checkpoint every 100 steps. Then it is resumed on as many ranks and, from a copy of what the kill left, on another number; without a
checkpoint it is begun anew in the same folder. All its tables and the figures of its summary must be those of a run on one rank that nothing interrupted, to the last bit.

Fills a table of doc/stability.md. Kills are drawn by number from the seed; those listed in RESULTS/kills.csv are not repeated.
"""

import csv
import glob
import os
import random
import shutil
import signal
import subprocess
import sys
import time

from tread.commands import command_parser, run_command
from tread.differences import other_bits
from tread.files import Error
from tread.runs import ROOT, Run, arguments_of, command, environment, execute, must_end_well, own_line, processes_below
from tread.tables import fill, markdown, provenance

SCENE = "smooth-rolling.prm"
SETTINGS = {"Scene/Reproducible": True, "Scene/Density scale": 1, "Time stepping/Levels": 3, "Mesh/Finest cell (mm)": 2.6, "Start/Tolerance": 1e-3,
            "Motion/Rolled distance (mm)": 4, "Output/History interval (mm)": 0.05, "Output/Surface interval (mm)": 1, "Output/Write volume": False,
            "Output/Checkpoint interval (minutes)": 1e-6}  # looked at every 100 steps
PATIENCE = 600  # seconds, after which a run hangs
SAME = "same bits"
COLUMNS = ("number", "ranks", "killed", "row", "cut_short", "checkpoint", "as_many_ranks", "other_ranks", "on_other_ranks", "version")


def is_alive(number):
    """Whether a process is there and not a zombie, which has no program."""
    return os.path.exists(f"/proc/{number}/exe")


def ranks_below(launcher):
    """Numbers of the program's processes below mpirun, or the program itself."""
    return processes_below(launcher) or [launcher]


def rows_in(path):
    try:
        with open(path, "rb") as stream:
            return stream.read().count(b"\n") - 1
    except OSError:
        return -1


def half_written(folder):
    return sorted(os.path.basename(path).removesuffix(".part") for path in glob.glob(os.path.join(folder, "*.part")))


def wait_until(process, condition):
    while process.poll() is None and not condition():
        time.sleep(2e-4)


def start_and_kill(folder, ranks, row, one_rank, at_a_file, draw):
    """Whether the kill came before the end. @param row of the history after which it comes; below 0: before the first"""
    process = subprocess.Popen(command(arguments_of(SCENE, SETTINGS, folder), ranks), env=environment(),
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    wait_until(process, lambda: ranks == 1 or ranks_below(process.pid) != [process.pid])
    if row < 0:
        time.sleep(draw.random())
    else:
        wait_until(process, lambda: rows_in(os.path.join(folder, "history.csv")) >= row)
        time.sleep(0.01 * draw.random())
    of_program = ranks_below(process.pid)
    if at_a_file:
        wait_until(process, lambda: half_written(folder))
    in_time = process.poll() is None
    if in_time:
        for number in [draw.choice(of_program)] if one_rank else [*of_program, process.pid]:
            try:
                os.kill(number, signal.SIGKILL)
            except ProcessLookupError:  # mpirun has ended it, as another one is dead
                pass
    process.wait()
    while any(is_alive(number) for number in of_program):
        time.sleep(0.01)
    return in_time


def outcome(folder, whole, ranks, more=()):
    """What becomes of a run that goes on, or begins anew."""
    try:
        result = execute([*arguments_of(SCENE, SETTINGS, folder), *more], ranks, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        return f"LOST: hangs after {PATIENCE} s"
    if result.returncode:
        return f"LOST: {own_line(result.stderr) or f'exit code {result.returncode}'}"
    differ = other_bits(Run(folder), whole)
    return f"OTHER BITS: {' '.join(differ)}" if differ else SAME


def trial(number, seed, folder, whole, rows):
    """A row of kills.csv, or None if the run ended before the kill."""
    draw = random.Random(f"{seed} {number}")
    ranks = number % 3 + 1
    one_rank, at_a_file = ranks > 1 and number // 3 % 2 == 1, number // 6 % 2 == 1
    row = draw.randint(-rows // 6, rows)
    other = draw.choice([count for count in (1, 2, 3) if count != ranks])
    run, copy = os.path.join(folder, "run"), os.path.join(folder, "copy")
    for path in (run, copy):
        shutil.rmtree(path, ignore_errors=True)
    if not start_and_kill(run, ranks, row, one_rank, at_a_file, draw):
        return None
    cut_short = half_written(run) if os.path.isdir(run) else []
    checkpoint = os.path.exists(os.path.join(run, "checkpoint.last"))
    if checkpoint:
        shutil.copytree(run, copy)
    went = [outcome(path, whole, count, ["--resume"] if checkpoint else []) for path, count in ((run, ranks), (copy, other))]
    return dict(zip(COLUMNS, (number, ranks, "one rank" if one_rank else "all at once", row, " ".join(cut_short), "yes" if checkpoint else "no", went[0],
                              other, went[1], whole.summary["version"])))


def counted(kills):
    """Rows of the page's table."""
    rows = []
    for ranks, killed in sorted({(kill["ranks"], kill["killed"]) for kill in kills}):
        own = [kill for kill in kills if (kill["ranks"], kill["killed"]) == (ranks, killed)]
        went = [kill[name] for kill in own for name in ("as_many_ranks", "on_other_ranks")]
        counts = [len(own), sum(bool(kill["cut_short"]) for kill in own), sum(kill["checkpoint"] == "no" for kill in own),
                  *(sum(kill["checkpoint"] == "yes" and kill[name] == SAME for kill in own) for name in ("as_many_ranks", "on_other_ranks")),
                  sum(one.startswith("LOST") for one in went), sum(one.startswith("OTHER") for one in went)]
        rows.append([ranks, killed, *map(str, counts)])
    totals = [str(sum(int(row[i]) for row in rows)) for i in range(2, len(rows[0]))]
    return rows + [["all", "", *totals]]


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/kills"))
    parser.add_argument("--instants", type=int, default=100, help="number of kills, with those that are there (100)")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    if arguments.instants < 1:
        raise Error("--instants must be at least 1")
    os.makedirs(arguments.results, exist_ok=True)
    listed, whole = os.path.join(arguments.results, "kills.csv"), Run(os.path.join(arguments.results, "whole"))
    must_end_well(execute(arguments_of(SCENE, SETTINGS, whole.folder)))
    kills = []
    if os.path.exists(listed):
        with open(listed, encoding="utf-8", newline="") as stream:
            kills = list(csv.DictReader(stream))
    number = int(kills[-1]["number"]) if kills else 0
    with open(listed, "a", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        if not kills:
            writer.writeheader()
        while len(kills) < arguments.instants:
            number += 1
            kill = trial(number, arguments.seed, arguments.results, whole, rows_in(whole.path("history.csv")))
            if kill is None:
                continue
            writer.writerow(kill)
            stream.flush()
            kills.append({name: str(value) for name, value in kill.items()})
            print(", ".join(f"{name} {value}" for name, value in kills[-1].items()), flush=True)
    fill("stability.md", "kills", markdown(
        ["ranks", "killed", "kills", "of them while a file was written", "before the first checkpoint, begun anew", "resumed on as many ranks to the same bits",
         "on another number", "lost", "other bits"], counted(kills))
         + "\n\n" + provenance(f"benchmarks/kills.py --instants {arguments.instants}", kills))
    bad = [kill["number"] for kill in kills if {kill["as_many_ranks"], kill["on_other_ranks"]} != {SAME}]
    if bad:
        sys.exit(f"lost or with other bits: kills {', '.join(bad)} of {listed}")


if __name__ == "__main__":
    run_command(main)
