#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that are killed at random instants and resumed: is anything lost, are the bits the same?

A run on 1, 2 and 3 ranks is killed (SIGKILL, which no program can answer): all its processes at once, or one rank of several. It
writes checkpoints all the time, so that many kills meet one that is being written. Then it is resumed on as many ranks and, from
a copy of what the kill left, on another number. Its history and its patch are compared with those of a run that nothing
interrupted: on as many ranks every bit, on another number the largest difference. Fills a table of doc/stability.md.
"""

import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from tread.commands import command_parser, run_command
from tread.files import Error, read_summary, read_table
from tread.runs import arguments_of, command, environment, execute, own_line
from tread.tables import fill, markdown, provenance

SCENE = "smooth-rolling.prm"
SETTINGS = {"Mesh/Finest cell (mm)": 2.6, "Motion/Rolled distance (mm)": 20, "Output/Checkpoint interval (minutes)": 0.001,
            "Output/Write volume": False, "Contact/Tolerance": 1e-12, "Time stepping/Levels": 1}
FILES = ("history.csv", "patch.csv", "patch_averaged.csv")
SAME_ON_OTHER_RANKS = 1e-7  # of the largest value of a column: the order of sums


def processes_of(launcher):
    """Numbers of the program's processes below mpirun, or the program itself."""
    below = subprocess.run(["pgrep", "-P", str(launcher)], capture_output=True, text=True, check=False).stdout.split()
    return [int(number) for number in below] or [launcher]


def start_and_kill(folder, ranks, seconds, one_rank):
    process = subprocess.Popen(command(arguments_of(SCENE, SETTINGS, folder), ranks), env=environment(), start_new_session=True,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(seconds)
    if process.poll() is None:
        if one_rank:
            os.kill(random.choice(processes_of(process.pid)), signal.SIGKILL)
        else:
            os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def text_of(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as stream:
        return stream.read()


def same_bits(folder, whole):
    return all(text_of(folder, name) == text_of(whole, name) for name in FILES)


def difference(folder, whole):
    """Largest difference of a column of history.csv, of its largest value."""
    found, expected = (read_table(os.path.join(path, "history.csv")) for path in (folder, whole))
    worst = 0.
    for name in expected:
        if len(found[name]) != len(expected[name]):
            return float("inf")
        scale = max(abs(value) for value in expected[name]) or 1.
        worst = max(worst, max(abs(a - b) for a, b in zip(found[name], expected[name])) / scale)
    return worst


def resume(folder, ranks):
    """"" when it went on to the end, else the line with which it refused."""
    result = execute([*arguments_of(SCENE, SETTINGS, folder), "--resume"], ranks)
    return "" if result.returncode == 0 else own_line(result.stderr) or f"exit code {result.returncode}"


def trial(folder, whole, ranks, seconds, one_rank):
    """(what became of it, difference on another number of ranks or None)"""
    run, copy = os.path.join(folder, "run"), os.path.join(folder, "copy")
    for path in (run, copy):
        shutil.rmtree(path, ignore_errors=True)
    start_and_kill(run, ranks, seconds, one_rank)
    if not os.path.exists(os.path.join(run, "checkpoint.last")):
        return "before the first checkpoint", None
    shutil.copytree(run, copy)
    if refused := resume(run, ranks):
        return f"LOST: {refused}", None
    if not same_bits(run, whole[ranks]):
        return "OTHER BITS", None
    other = ranks % 3 + 1
    if refused := resume(copy, other):
        return f"LOST on {other} ranks: {refused}", None
    return "same bits", difference(copy, whole[ranks])


def main():
    parser = command_parser(__doc__)
    parser.add_argument("--instants", type=int, default=100, help="number of kills (100)")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    if arguments.instants < 1:
        raise Error("--instants must be at least 1")
    random.seed(arguments.seed)
    rows, bad = {}, []
    with tempfile.TemporaryDirectory() as folder:
        whole, lasts = {}, {}
        for ranks in (1, 2, 3):
            whole[ranks] = os.path.join(folder, f"whole-{ranks}")
            began = time.monotonic()
            result = execute(arguments_of(SCENE, SETTINGS, whole[ranks]), ranks)
            if result.returncode:
                raise Error(own_line(result.stderr) or "the run that nothing interrupts has failed")
            lasts[ranks] = time.monotonic() - began
        for number in range(arguments.instants):
            ranks = number % 3 + 1
            one_rank = ranks > 1 and number % 2 == 0
            became, apart = trial(folder, whole, ranks, random.uniform(0., lasts[ranks]), one_rank)
            row = rows.setdefault((ranks, one_rank), {"kills": 0, "before": 0, "same": 0, "bad": 0, "apart": 0.})
            row["kills"] += 1
            row["before"] += became.startswith("before")
            row["same"] += became == "same bits"
            row["apart"] = max(row["apart"], apart or 0.)
            if became not in ("same bits", "before the first checkpoint") or row["apart"] > SAME_ON_OTHER_RANKS:
                row["bad"] += 1
                bad.append(f"{number}: {became}, {apart}")
            print(f"{number + 1}: {ranks} ranks{', one of them' if one_rank else ''}: {became}"
                  + (f", on another number within {apart:.0e}" if apart is not None else ""), flush=True)
        summary = read_summary(whole[1])
    table = [[str(ranks), "one rank" if one_rank else "all at once", str(row["kills"]), str(row["before"]), str(row["same"]),
              str(row["bad"]), f"{row['apart']:.0e}"] for (ranks, one_rank), row in sorted(rows.items())]
    fill("stability.md", "kills", markdown(["ranks", "killed", "kills", "before the first checkpoint", "resumed to the same bits",
                                            "lost or other bits", "resumed on another number of ranks, largest difference"], table)
         + "\n\n" + provenance(f"benchmarks/kills.py --instants {arguments.instants}", [summary]))
    if bad:
        sys.exit("; ".join(bad))


if __name__ == "__main__":
    run_command(main)
