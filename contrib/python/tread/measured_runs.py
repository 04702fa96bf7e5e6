# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of shipped scenes whose results and costs are kept: what the tables of doc/ are made of."""

from __future__ import annotations

import glob
import json
import os
import re
import subprocess
import time
from collections.abc import Callable, Mapping
from typing import TypeVar

from .comparison import compare
from .files import input_of, is_complete, read_summary
from .runs import ROOT, ProgramError, arguments_of, environment, execute, must_end_well, own_line
from .runs import command as words_of

Name = TypeVar("Name")

# Changes of the settings with which a scene shows what a matched surface does.
MATCHED_SURFACE: dict[str, dict[str, object]] = {"without": {"Solid/Matched surface": "false"}, "with": {}}


def shipped(scene: str) -> str:
    """The path of a scene of prm/."""
    return os.path.join(ROOT, "prm", scene)


def shipped_scenes(pattern: str = "**/*.prm") -> list[str]:
    """The scenes of prm/ whose paths, seen from there, are like a pattern; ** stands for any folders."""
    folder = os.path.join(ROOT, "prm")
    return sorted(os.path.relpath(path, folder) for path in glob.glob(os.path.join(glob.escape(folder), pattern), recursive=True))


def available_ranks() -> int:
    return min(2, os.cpu_count() or 1)


def run_scene(scene: str, folder: str, settings: Mapping[str, object] | None = None, ranks: int | None = None, command: str = "run") -> dict:
    """The summary of a scene of prm/, which is run, or what another command of the program does with it, unless `folder` has the complete results
    of the same command and the same input.

    Beside the summary's figures: `seconds` from the start of the program to its summary.json, and `peak_bytes`,
    the memory of its largest process.
    """
    line = words_of(arguments_of(shipped(scene), settings or {}, folder, command), ranks or available_ranks())
    known_line = [part for before, part in zip(["", *line], line) if before != "orte_tmpdir_base"]  # a folder that each start has of its own
    cost_file = os.path.join(folder, "cost.json")
    cost = {}
    if is_complete(folder) and os.path.exists(cost_file):
        with open(cost_file, encoding="utf-8") as stream:
            cost = json.load(stream)
    known = input_of(shipped(scene), settings or {})
    if cost.get("command") != known_line or cost.get("input") != known:
        print(" ".join(line), flush=True)
        os.makedirs(folder, exist_ok=True)
        with open(os.path.join(folder, "output.txt"), "w", encoding="utf-8") as output:
            began = time.time()
            process = subprocess.Popen(line, env=environment(), stdout=output, stderr=subprocess.STDOUT)
            _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            with open(output.name, encoding="utf-8") as stream:
                said = own_line(stream.read()) or "it did not say why"
            raise ProgramError(f"{scene} ended with {process.returncode} ({said}), see {output.name}", process.returncode)
        cost = {"command": known_line, "input": known, "peak_bytes": 1024 * usage.ru_maxrss,
                "seconds": os.path.getmtime(os.path.join(folder, "summary.json")) - began}
        with open(cost_file, "w", encoding="utf-8") as stream:
            json.dump(cost, stream, indent=2)
    return dict(read_summary(folder), **cost)


def in_turn(turns: int, runs: Mapping[Name, Callable[[int], dict]],
            time_of: Callable[[dict], float] = lambda summary: summary["seconds"]) -> dict[Name, dict]:
    """The fastest summary of each run(turn) of a dictionary, all runs made one after the other so many times: where
    other programs take their part of a machine, the least time is the nearest to the run's own."""
    summaries = [{name: run(turn) for name, run in runs.items()} for turn in range(turns)]
    return {name: min((of_turn[name] for of_turn in summaries), key=time_of) for name in runs}


def steps_seconds(summary: Mapping[str, float]) -> float:
    """Of all time steps, without start, end and output."""
    return sum(summary[f"wall_s_{part}"] for part in ("internal_forces", "contact", "communication", "nodes"))


def rolling_seconds(summary: Mapping[str, float]) -> float:
    """From the end of the start to the end of the run, with what it writes on the way."""
    return summary["wall_s"] - summary["wall_s_start"]


def dry_run(scene: str, settings: Mapping[str, object], ranks: int = 1) -> dict[str, float]:
    """What --dry-run says: {what: number}."""
    result = must_end_well(execute([*arguments_of(shipped(scene), settings), "--dry-run"], ranks))
    found = {what.strip(): float(value) for what, value in
             re.findall(r"^(\S[^\d\n]*?)\s{2,}([\d.eE+-]+)", result.stdout, re.MULTILINE)}
    gain = re.search(r"fall to 1/([\d.]+)", result.stdout)
    found["ideal gain of levels"] = float(gain[1]) if gain else 1.0
    return found


def contact_measures(run: str, traction: float, scale: float = 1.0) -> dict:
    """The measures of comparison.py against CONTACT at a traction coefficient, as doc/ states them; scale: of
    CONTACT's load."""
    contact = os.path.join(ROOT, f"contrib/contact-data/contact_F127_mu{round(100 * traction):03d}_dx010.csv.gz")
    found = compare(run, contact, scale)
    with open(os.path.join(run, "contact.json"), "w", encoding="utf-8") as stream:
        json.dump(found, stream, indent=2)
        stream.write("\n")
    summary = read_summary(run)
    # The summary's share is the mean over rolling one cell: finer than the nodes of one instant. Its ripple
    # is that of every step, not of the means in history.csv.
    found["adhesion_share_difference_points"] += 100 * (summary["adhesion_share"] - found["adhesion_share"])
    found["normal_force_ripple_last_10_mm"] = summary["normal_force_ripple_share"]
    return found
