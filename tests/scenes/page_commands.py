#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands of a page, run one after the other in an empty folder, print what the page says that they print.

    page_commands.py PROGRAM PAGE          (such as measured.md, of doc/)

A block of code that begins with one of BEGINNINGS is commands; those lines with a backslash at their end go on in the next. The block
behind it, if it begins otherwise, has lines that they print: the same words, and numbers that differ by no more than ALLOWED of
theirs or one of their last digit. Of a line with ..., what stands before it counts. In the folder are links build/source/tread, contrib
and prm, as in the source tree.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

from tread.runs import ROOT, environment
from tread_runner import Check

BEGINNINGS = ("build/", "contrib/", "prm/", "mpirun ", "awk ", "grep ", "head ")
# Another processor rounds differently, and what contact leaves within its tolerance moves forces by some 1e-4 of them.
ALLOWED = 0.01
NUMBER = r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"


def blocks(text):
    """[[line]] of code, indented by four spaces."""
    found, last = [], False
    for line in text.splitlines():
        code = line.startswith("    ")
        if code and not last:
            found.append([])
        if code:
            found[-1].append(line[4:])
        last = code
    return found


def commands_of(block):
    return "\n".join(block).replace("\\\n", " ").splitlines()


def is_commands(block):
    return block[0].startswith(BEGINNINGS)


def unit_of_last_digit(number):
    mantissa, _, power = number.lower().partition("e")
    return 10.0 ** (int(power or 0) - len(mantissa.partition(".")[2]))


def agrees(wanted, printed):
    """Whether a printed line is that of the page."""
    wanted, dots, _ = wanted.partition("...")
    words = lambda line: re.sub(r"\s+", " ", re.sub(NUMBER, "#", line)).strip()
    own, other = words(wanted), words(printed)
    if not (other.startswith(own) if dots else other == own):
        return False
    pairs = zip(re.findall(NUMBER, wanted), re.findall(NUMBER, printed))
    return all(abs(float(a) - float(b)) <= max(ALLOWED * abs(float(a)), 1.01 * unit_of_last_digit(a)) for a, b in pairs)


def run_page(page, program, check):
    with open(os.path.join(ROOT, "doc", page), encoding="utf-8") as stream:
        text = stream.read()
    with tempfile.TemporaryDirectory() as folder:
        os.makedirs(os.path.join(folder, "build", "source"))
        os.symlink(os.path.abspath(program), os.path.join(folder, "build", "source", "tread"))
        # Copies, so that commands of contrib/ find the program of this folder.
        for name in ("contrib", "prm"):
            shutil.copytree(os.path.join(ROOT, name), os.path.join(folder, name), symlinks=True, ignore=shutil.ignore_patterns("__pycache__"))
        printed, began = "", time.time()
        for block in blocks(text):
            if is_commands(block):
                printed = ""
                for command in commands_of(block):
                    start = time.time()
                    ended = subprocess.run(["bash", "-c", command], cwd=folder, env=environment(), capture_output=True, text=True)
                    printed += ended.stdout + ended.stderr
                    if not check.that(f"{time.time() - start:.1f} s: {command}"[:200], ended.returncode == 0):
                        print(ended.stdout, ended.stderr)
                continue
            for line in block:
                if not check.that(f"printed: {line.strip()}"[:200], any(agrees(line, other) for other in printed.splitlines())):
                    print(printed)
        used = os.times()
        print(f"{page}: {time.time() - began:.1f} s, {used.children_user + used.children_system:.1f} s of processors")
        missing = [path for path in re.findall(r"`(results/[^`]+\.(?:png|csv|json))`", text) if not os.path.exists(os.path.join(folder, path))]
        check.that("the files that the page names were written" + (f", but for {missing}" if missing else ""), not missing)


def what_is_wrong_is_found(check):
    check.that("a number within what is allowed", agrees("force 100.0 kN at 3 mm", "  force  100.4 kN  at 3 mm"))
    check.that("a number beyond", not agrees("force 100.0 kN", "force 101.2 kN"))
    check.that("a small number beyond", not agrees("depth 0.15 mm", "depth 0.17 mm"))
    check.that("other words", not agrees("force 100.0 kN", "force 100.0 N"))
    check.that("a line that goes on", agrees("force 100.0 kN ...", "force 100.0 kN and more") and not agrees("force 100.0", "force 100.0 kN"))
    check.that("blocks", [is_commands(block) for block in blocks("a\n\n    build/x \\\n      -s\n\nb\n\n    said\n")] == [True, False]
               and commands_of(["build/x \\", "  -s"]) == ["build/x    -s"])


if __name__ == "__main__":
    check = Check()
    what_is_wrong_is_found(check)
    run_page(sys.argv[2], sys.argv[1], check)
    check.exit()
