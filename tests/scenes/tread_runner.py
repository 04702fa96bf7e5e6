# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the program for the scene tests, and prints comparisons like tests/check.h does."""

import json
import os
import signal
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def command(program, arguments, ranks=1):
    launcher = ["mpirun", "--oversubscribe", "--bind-to", "none", "-np", str(ranks)] if ranks > 1 else []
    return launcher + [program] + arguments


def environment():
    return dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", DEAL_II_NUM_THREADS="1",
                OMP_NUM_THREADS="1", OMPI_MCA_btl_vader_single_copy_mechanism="none")


def arguments_of(scene, output, settings=()):
    arguments = [os.path.join(ROOT, "prm", scene), "--output", output]
    for setting in settings:
        arguments += ["-s", setting]
    return arguments


def press_ctrl_c(process, history, rows):
    """Interrupt a process when the table `history` has more than so many lines, its heading included."""
    deadline = time.time() + 600
    while time.time() < deadline and process.poll() is None:
        if os.path.exists(history) and sum(1 for _ in open(history, encoding="utf-8")) > rows:
            break
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)


def run(program, scene, output, settings=(), ranks=1, more=()):
    """Run a scene to its end and return its summary; anything else ends the test."""
    arguments = arguments_of(scene, output, settings) + list(more)
    result = subprocess.run(command(program, arguments, ranks), env=environment(), capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{scene} on {ranks} rank(s) ended with {result.returncode}: {result.stderr.strip()[-1000:]}")
    with open(os.path.join(output, "summary.json"), encoding="utf-8") as stream:
        return json.load(stream)


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

    def exit(self):
        print(f"{self.lines} comparisons, {self.failed} failed")
        sys.exit(0 if self.lines and not self.failed else 1)
