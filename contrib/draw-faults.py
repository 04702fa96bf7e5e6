#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw small faults by a rule, so that nobody chooses what the tests are tried with.

The files are those of source/ (.cc) and contrib/python/tread (.py). Each is drawn with the weight of its lines of code; in it a line, and in the line one
of the changes that it allows, all with a random generator of a given seed. Comments, includes, declarations of text alone and lines that allow no
change are drawn again. The changes:

  sign         + becomes -, - becomes + between two terms
  factor       a product or quotient is twice as large
  index        [0] becomes [1], [1] becomes [0], [2] becomes [1]; .x and .y, _x and _y exchanged
  comparison   < becomes >, <= becomes >=, == becomes !=, && becomes ||, `and` becomes `or`
  off by one   a whole number other than 0 and 1 behind +, -, *, <, ( is one more; of 1: 2
  dropped      the last term of a sum is left out

  contrib/draw-faults.py --seed 3 --number 60                        the list
  contrib/draw-faults.py --seed 3 --number 60 --python               those of the Python package alone, each tried with tests/python
  contrib/draw-faults.py --seed 3 --number 60 --patch 17 FILE        FILE with the fault of that number, for a build

What became of a draw is in doc/mutations.md.
"""

from __future__ import annotations

import glob
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable

from tread.commands import command_parser, run_command
from tread.files import Error
from tread.runs import ROOT, environment

Change = tuple[str, str]  # kind, the new line

EXCHANGED = {"[0]": "[1]", "[1]": "[0]", "[2]": "[1]", ".x": ".y", ".y": ".x", "_x": "_y", "_y": "_x"}
TURNED = {"<=": ">=", ">=": "<=", "==": "!=", "!=": "==", "<": ">", ">": "<", "&&": "||", "||": "&&", "and": "or", "or": "and"}


def spans_of_text(line: str) -> list[tuple[int, int]]:
    """What stands in quotation marks is left alone."""
    return [match.span() for match in re.finditer(r'"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)*\'', line)]


def changes_of(line: str, is_python: bool) -> list[Change]:
    """All changes that a line allows."""
    code = line.split("#" if is_python else "//")[0]
    texts = spans_of_text(code)
    free = lambda at: not any(begin <= at < end for begin, end in texts)
    found: list[Change] = []

    def add(kind: str, pattern: str, new: Callable[[re.Match], str]) -> None:
        for match in re.finditer(pattern, code):
            if free(match.start()):
                changed = line[:match.start()] + new(match) + line[match.end():]
                if changed != line:
                    found.append((kind, changed))

    add("sign", r"(?<=[\w\])]) [+-] (?=[\w(])", lambda m: " - " if "+" in m[0] else " + ")
    add("factor", r"(?<=[\w\])]) [*/] (?=[\w(])", lambda m: m[0] + ("2. * " if "*" in m[0] else "0.5 / "))
    add("index", r"\[[012]\]|(?<=\w)[._][xy]\b", lambda m: EXCHANGED[m[0]])
    add("comparison", r"(?<= )(<=|>=|==|!=|&&|\|\||<|>)(?= )" if not is_python else r"(?<= )(<=|>=|==|!=|<|>|and|or)(?= )", lambda m: TURNED[m[0]])
    add("off by one", r"(?<=[-+*<(] )\d+(?![\w.])|(?<=[(+*-])\d+(?![\w.])", lambda m: str(int(m[0]) + 1) if int(m[0]) else m[0])
    add("dropped", r"(?<=[\w\])]) [+-] [\w.]+(\[\w+\])?(?=[;,)])", lambda m: "")
    if is_python:
        return [(kind, new) for kind, new in found if compiles_alone(new, line)]
    return found


def compiles_alone(new: str, old: str) -> bool:
    """A cheap look at brackets; the file is compiled as a whole later."""
    return all(new.count(bracket) - old.count(bracket) == 0 for bracket in "()[]{}")


def lines_of_code(path: str) -> list[int]:
    """Numbers of the lines that are neither empty nor comments nor texts."""
    numbers, in_text = [], False
    with open(path, encoding="utf-8") as stream:
        for number, line in enumerate(stream):
            quotes = line.count('"""')
            if quotes:
                in_text ^= quotes % 2 == 1
                continue
            if not in_text and line.strip() and not line.strip().startswith(("//", "#", "import ", "from ")):
                numbers.append(number)
    return numbers


def drawn(seed: int, count: int) -> list[dict]:
    """The faults of a seed: the first ones stay the same when more are drawn."""
    source = random.Random(seed)
    files = sorted(glob.glob(os.path.join(ROOT, "source/**/*.cc"), recursive=True) + glob.glob(os.path.join(ROOT, "contrib/python/tread/**/*.py"), recursive=True))
    code = {path: lines_of_code(path) for path in files}
    faults: list[dict] = []
    while len(faults) < count:
        path = source.choices(files, [len(code[file]) for file in files])[0]
        number = source.choice(code[path])
        with open(path, encoding="utf-8") as stream:
            line = stream.read().splitlines()[number]
        changes = changes_of(line, path.endswith(".py"))
        if not changes:
            continue
        kind, new = source.choice(changes)
        fault = {"file": os.path.relpath(path, ROOT), "line": number + 1, "kind": kind, "old": line, "new": new}
        if (fault["file"], fault["line"]) not in [(one["file"], one["line"]) for one in faults]:
            faults.append({"number": len(faults) + 1, **fault})
    return faults


def with_fault(fault: dict) -> str:
    """The text of its file. @raises Error if the line is another one by now"""
    with open(os.path.join(ROOT, fault["file"]), encoding="utf-8") as stream:
        lines = stream.read().split("\n")
    if lines[fault["line"] - 1] != fault["old"]:
        raise Error(f"{fault['file']}: line {fault['line']} has changed")
    lines[fault["line"] - 1] = fault["new"]
    return "\n".join(lines)


def noticing_test(fault: dict, tests: list[str], seconds: int) -> str:
    """The first test of tests/python that fails in a copy of the project with the fault; "" if none does."""
    with tempfile.TemporaryDirectory() as folder:
        copy = os.path.join(folder, "project")
        shutil.copytree(ROOT, copy, symlinks=True, ignore=shutil.ignore_patterns("build*", ".git", "results"))
        with open(os.path.join(copy, fault["file"]), "w", encoding="utf-8") as stream:
            stream.write(with_fault(fault))
        for test in tests:
            try:
                ended = subprocess.run([sys.executable, test], cwd=os.path.join(copy, "tests/python"), env=environment(), capture_output=True, timeout=seconds)
            except subprocess.TimeoutExpired:
                return test
            if ended.returncode:
                return test
    return ""


def main() -> None:
    parser = command_parser(__doc__ or "")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--number", type=int, default=60)
    parser.add_argument("--python", action="store_true", help="try those of the Python package")
    parser.add_argument("--patch", nargs=2, metavar=("NUMBER", "FILE"))
    arguments = parser.parse_args()
    faults = drawn(arguments.seed, arguments.number)
    if arguments.patch:
        with open(arguments.patch[1], "w", encoding="utf-8") as stream:
            stream.write(with_fault(faults[int(arguments.patch[0]) - 1]))
        return
    for fault in faults:
        what = f"{fault['number']:3} {fault['file']}:{fault['line']} {fault['kind']}"
        if not arguments.python:
            print(f"{what}\n    - {fault['old'].strip()}\n    + {fault['new'].strip()}")
        elif fault["file"].endswith(".py"):
            noticed = noticing_test(fault, ["figures_test.py", "package_test.py", "pictures_test.py", "schema_test.py"], 600)
            print(f"{what}: {'noticed by ' + noticed if noticed else 'SURVIVES'}", flush=True)


run_command(main)
