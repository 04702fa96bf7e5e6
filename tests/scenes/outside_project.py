#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Another project, in C, that uses the installed half-space library.

    outside_project.py BUILD
"""

import os
import re
import subprocess
import sys
import tempfile

from tread.runs import ROOT
from tread_runner import Check

check = Check()
with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as stream:
    VERSION = re.search(r"project\(tread VERSION (\d+\.\d+)", stream.read())[1]
PROJECT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "outside_project")
with tempfile.TemporaryDirectory() as folder:
    path = lambda *names: os.path.join(folder, *names)

    def must(*command):
        done = subprocess.run(command, capture_output=True, text=True)
        check.that(f"{command[1]}: succeeds", done.returncode == 0)
        if done.returncode:
            print(done.stdout, done.stderr)
            check.exit()
        return done.stdout

    must("cmake", "--install", sys.argv[1], "--component", "half_space", "--prefix", path("prefix"))
    installed = sorted(os.path.relpath(os.path.join(where, name), path("prefix")) for where, _, names in os.walk(path("prefix")) for name in names)
    check.that("what is installed", {name.split("/")[-1] for name in installed} >= {"half_space.h", "treadConfig.cmake", "libtread_half_space.so.1"}
               and len(installed) <= 7)
    must("cmake", "-S", PROJECT, "-B", path("build"), f"-DCMAKE_PREFIX_PATH={path('prefix')}", f"-DTREAD_VERSION={VERSION}")
    must("cmake", "--build", path("build"))
    lines = must(path("build/outside"), "run").splitlines()
    status, slope, message = lines[0].split(" ", 2)
    check.that("it solves", (status, message) == ("0", "[]"))
    # Kalker 1990, table E3: 4.12 for a circle and nu = 0.25; a creepage of 1e-5 has a little slip, 16 elements have an error.
    check.relative("its creepage coefficient C11", float(slope), 4.12, 0.02)
    check.that("wrong input: nan, and what was wrong", lines[1].startswith("1 1 [friction = -1"))
check.exit()
