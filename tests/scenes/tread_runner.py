# SPDX-License-Identifier: LGPL-2.1-or-later
"""What scene tests share beyond the package tread: runs that must succeed, Ctrl-C, comparisons as tests/check.h prints them."""

import functools
import json
import os
import re
import signal
import subprocess
import sys
import time

import tread
from tread.files import read_summary, read_table
from tread.runs import ROOT, arguments_of, command, environment, must_end_well

from loaded_once import execute_often


@functools.lru_cache(maxsize=None)
def explained_keys(program):
    """The keys of summary.json whose meanings the program knows."""
    tables = {table["file"]: table["columns"] for table in json.loads(must_end_well(execute_often(["columns"], program)).stdout)}
    return frozenset(key["name"] for key in tables["summary.json"] if key["meaning"])


def unexplained_keys(summary, explained):
    """Keys that a summary has and that are not explained, whatever numbers are in their names. @param explained names as explained_keys() has them"""
    keys = {re.sub(r"^.*_half_space_uncertainty$", "max_pressure_Pa_half_space_uncertainty", re.sub(r"^cell_\d+_", "cell_1_", re.sub(r"^wheel_\d+_", "wheel_2_", key)))
            for key in summary}
    for patch in summary.get("patches", []) + summary.get("half_space_patches", []):
        keys |= {f"patches/1/{key}" for key in patch}
    for figure, sources in summary.get("reference", {}).items():
        keys |= {figure} | {f"reference/max_pressure_Pa/Hertz/{key}" for source in sources.values() for key in source}
    return sorted(keys - explained)


def run(program, scene, output, settings=(), ranks=1, more=(), command="run", table=None):
    """Run a scene to its end, or do with it what another command does, and return its summary, all of whose keys must have a meaning; anything else ends the test."""
    try:
        if ranks > 1:
            began = time.monotonic()
            summary = tread.run(scene, settings, command=command, table=table, ranks=ranks, output=output, options=more, program=program).summary
            print(f"{time.monotonic() - began:6.2f} s on {ranks} ranks:", scene, settings, flush=True)
        else:
            must_end_well(execute_often([*arguments_of(scene, settings, output, command, table), *more], program))
            summary = read_summary(output)
        unexplained = unexplained_keys(summary, explained_keys(program))
    except tread.Error as error:
        sys.exit(f"{scene} on {ranks} rank(s): {error}")
    if unexplained:
        sys.exit(f"{scene} on {ranks} rank(s): tread columns does not say what {', '.join(unexplained)} of summary.json means")
    return summary


def table(folder, name):
    """{column: list} of a CSV file of a run."""
    return {column: values.tolist() for column, values in read_table(os.path.join(folder, name)).items()}


def rows_of(folder, name):
    """[{column: value}] of the same."""
    columns = table(folder, name)
    return [dict(zip(columns, row)) for row in zip(*columns.values())]


def script(name, *arguments):
    """The ended process of a command of contrib/, with what it wrote."""
    return subprocess.run(["/usr/bin/python3", os.path.join(ROOT, "contrib", name), *arguments], env=environment(),
                          capture_output=True, text=True)


def press_ctrl_c(process, history, rows):
    """Interrupt a process when the table `history` has more than so many lines, its heading included."""
    deadline = time.time() + 600
    while time.time() < deadline and process.poll() is None:
        if os.path.exists(history) and sum(1 for _ in open(history, encoding="utf-8")) > rows:
            break
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)


def run_stopped(program, scene, output, settings, rows, of="history.csv"):
    """Run a scene on one rank until one of its tables has more than so many lines, then press Ctrl-C. With passages.csv it ends between two."""
    process = subprocess.Popen(command(arguments_of(scene, settings, output), 1, program), env=environment(),
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    press_ctrl_c(process, os.path.join(output, of), rows)
    process.wait(timeout=120)


class Check:
    """Counts and prints comparisons: computed, reference, error, allowed, PASS or FAIL."""

    def __init__(self):
        self.lines = self.failed = 0

    def _line(self, what, computed, reference, error, allowed):
        passed = error <= allowed
        self.lines += 1
        self.failed += not passed
        print(f"{what:<52} computed {computed:15.8g}  reference {reference:15.8g}  error {error:9.2e}  "
              f"allowed {allowed:9.2e}  {'PASS' if passed else 'FAIL'}", flush=True)
        return passed

    def relative(self, what, computed, reference, allowed):
        return self._line(what, computed, reference, abs(computed / reference - 1.), allowed)

    def absolute(self, what, computed, reference, allowed):
        return self._line(what, computed, reference, abs(computed - reference), allowed)

    def below(self, what, computed, allowed):
        return self._line(what, computed, 0., abs(computed), allowed)

    def that(self, what, holds):
        return self._line(what, float(bool(holds)), 1., 0. if holds else 1., 0.)

    def energy(self, name, summary, residual):
        """What is not accounted for, over what was dissipated; and what contact takes from the nodes must be what it takes
        from the pairs, or one side does not get the impulse of the other."""
        self.below(f"{name}energy residual over what was dissipated", summary["energy_residual_of_dissipated"], residual)
        pairs = summary["frictional_work_J"] + summary["contact_loss_J"]
        self.below(f"{name}work of contact on the nodes less that of the pairs, over what was dissipated",
                   (summary["contact_work_on_nodes_J"] - pairs) / summary["dissipated_work_J"], 1e-9)

    def refused(self, what, program, scene, output, settings, words, more=(), command="run"):
        """A scene that must end at once with one line that has all of the words."""
        ended = execute_often(arguments_of(scene, settings, output, command) + list(more), program)
        lines = [line for line in ended.stderr.splitlines() if line.startswith("tread:")]
        if not self.that(f"{what}: exit code 1, one line with {words}", ended.returncode == 1 and len(lines) == 1
                         and all(word in lines[0] for word in words)):
            print(ended.returncode, ended.stderr)

    def exit(self):
        print(f"{self.lines} comparisons, {self.failed} failed")
        sys.exit(0 if self.lines and not self.failed else 1)
