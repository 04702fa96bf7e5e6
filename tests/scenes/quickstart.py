#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The first command of README.md in a clean clone: it builds the program, rolls the first scene, draws it, and prints what the README says that it
prints. Then the two commands of the README that need its build: a package for Debian, and an environment of Python.

    quickstart.py            some ten minutes of two processors; cmake and compilers take what the environment names (CXXFLAGS, CMAKE_CXX_COMPILER_LAUNCHER)
"""

import os
import re
import subprocess
import sys
import tempfile
import time

from every_command import clone
from page_commands import agrees, blocks, commands_of
from tread.runs import ROOT, environment
from tread_runner import Check


def main():
    check = Check()
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as stream:
        found = blocks(stream.read())
    first = next(i for i, block in enumerate(found) if block[0].startswith("contrib/quickstart.sh"))
    printed_there = []
    for block in found[first + 1:]:
        if block[0].startswith("build/"):
            break
        printed_there += block
    later = [line for block in found for line in commands_of(block) if "cpack -G DEB" in line or "-m venv" in line or line.startswith("PYTHONPATH=")]
    check.that("the README has a table that is printed, and three commands after it", len(printed_there) > 10 and len(later) == 3)
    with tempfile.TemporaryDirectory() as folder:
        clone(folder)

        def execute(command):
            start = time.time()
            ended = subprocess.run(["bash", "-c", command], cwd=folder, env=environment(), capture_output=True, text=True, stdin=subprocess.DEVNULL)
            if not check.that(f"{time.time() - start:.0f} s: {command}"[:200], ended.returncode == 0):
                print(ended.stdout[-5000:], ended.stderr[-5000:], flush=True)
            return ended.stdout

        printed = execute("contrib/quickstart.sh").splitlines()
        for line in printed_there:
            if not check.that(f"printed: {line.strip()}"[:200], any(agrees(line, other) for other in printed)):
                words = re.split(r"\s{2,}", line.strip())[0]
                print(*[other for other in printed if words in other], sep="\n")
        for name in ("summary.json", "history.csv", "patch.csv", "volume.pvd", "surface.pvd"):
            check.that(f"{name} is written", os.path.exists(os.path.join(folder, "results", "smooth-rolling", name)))
        check.that("pictures are drawn", len(os.listdir(os.path.join(folder, "results", "smooth-rolling", "pictures"))) > 3)
        for command in later:
            execute(command)
        check.that("a package is made", any(name.endswith(".deb") for name in os.listdir(os.path.join(folder, "build"))))
    check.exit()


if __name__ == "__main__":
    sys.exit(main())
