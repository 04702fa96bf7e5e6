#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What surrounds a run: names of folders, home, languages, more ranks than cells want, folders that vanish, ranks that stop."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from tread.files import read_summary
from tread.runs import ROOT, arguments_of, command, environment, execute, processes_below
from tread_runner import Check, run

program = sys.argv[1]
check = Check()
SCENE = "smooth-rolling.prm"
SHORT = ["Mesh/Finest cell (mm)=2.6", "Motion/Rolled distance (mm)=2"]


def start(output, settings, ranks=1, **more):
    return subprocess.Popen(command(arguments_of(SCENE, settings, output), ranks, program), env=environment(), stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, **more)


def wait_for(path, process):
    deadline = time.time() + 60
    while not os.path.exists(path) and process.poll() is None and time.time() < deadline:
        time.sleep(0.01)


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    plain = run(program, SCENE, path("plain"), SHORT)

    # Names with spaces, quotes and letters of other alphabets, for scene, profile and results.
    odd = path("a \"quoted\" folder's Größe, 100 %")
    os.mkdir(odd)
    scene = os.path.join(odd, "my scene.prm")
    shutil.copy(os.path.join(ROOT, "prm", SCENE), scene)
    result = execute([scene, *[word for setting in SHORT for word in ("-s", setting)], "--output", os.path.join(odd, "re sults")], program=program)
    check.that("a folder with spaces and quotes", result.returncode == 0
               and read_summary(os.path.join(odd, "re sults"))["max_pressure_Pa"] == plain["max_pressure_Pa"])

    # A home that cannot be written, and a language with decimal commas (if the machine has one: the program asks for none).
    languages = subprocess.run(["locale", "-a"], capture_output=True, text=True, check=False).stdout.split()
    comma = next((name for name in languages if name.startswith(("de_", "fr_", "nl_"))), "de_DE.UTF-8")
    ended = subprocess.run(command(arguments_of(SCENE, SHORT, path("comma")), 1, program), capture_output=True, text=True,
                           env=environment() | {"LC_ALL": comma, "LANG": comma, "HOME": "/proc"})
    check.that(f"{comma}, and a home that cannot be written", ended.returncode == 0
               and read_summary(path("comma"))["max_pressure_Pa"] == plain["max_pressure_Pa"])

    # More ranks than a mesh of this size can use.
    many = run(program, SCENE, path("many"), SHORT + ["Motion/Rolled distance (mm)=0.2", "Output/Write volume=false"], ranks=16)
    check.that("16 ranks on a small mesh", many["completed"] and many["ranks"] == 16)

    # The folder of the results is removed while the run goes on.
    long = SHORT + ["Motion/Rolled distance (mm)=30"]
    process = start(path("removed"), long)
    wait_for(path("removed/history.csv"), process)
    os.rename(path("removed"), path("out of its way"))  # in one act: the run may write between the removal of two files
    shutil.rmtree(path("out of its way"))
    _, said = process.communicate(timeout=120)
    check.that("a folder that is removed: one line and no success", process.returncode == 2
               and len([line for line in said.splitlines() if line.startswith("tread:") and "cannot write" in line]) == 1)

    # One rank of three is stopped for a while: the others wait for it, and the answer is the same.
    process = start(path("waits"), long, ranks=3, start_new_session=True)
    wait_for(path("waits/history.csv"), process)
    ranks = processes_below(process.pid)
    check.that("mpirun has started three ranks", len(ranks) == 3)
    os.kill(ranks[1], signal.SIGSTOP)
    time.sleep(0.5)
    check.that("a rank that is stopped: the run waits", process.poll() is None)
    os.kill(ranks[1], signal.SIGCONT)
    process.communicate(timeout=120)
    check.that("and goes on", process.returncode == 0 and read_summary(path("waits"))["completed"])

    # One rank is killed: the run ends, and says nothing that looks like success.
    process = start(path("killed"), long, ranks=3, start_new_session=True)
    wait_for(path("killed/history.csv"), process)
    ranks = processes_below(process.pid)
    os.kill(ranks[2], signal.SIGKILL)
    process.communicate(timeout=120)
    check.that("a rank that is killed: no success, and no summary", process.returncode != 0 and not os.path.exists(path("killed/summary.json")))
    again = run(program, SCENE, path("killed"), long)
    check.that("and its lock does not stay", again["completed"])

check.exit()
