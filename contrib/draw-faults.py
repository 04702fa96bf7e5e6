#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw small faults by a rule, so that nobody chooses what the tests are tried with, and try them.

The files are those of source/ (.cc, .h) and contrib/python/tread (.py). Each is drawn with the weight of its lines of code; in it a line, and in the line one
of the changes that it allows, all with a random generator of a given seed. Comments, includes, declarations of text alone and lines that allow no
change are drawn again, and so are changes that do not compile. The changes:

  sign         + becomes -, - becomes + between two terms
  factor       a product or quotient is twice as large
  index        [0] becomes [1], [1] becomes [0], [2] becomes [1]; .x and .y, _x and _y exchanged
  comparison   < becomes >, <= becomes >=, == becomes !=, && becomes ||, `and` becomes `or`
  off by one   a whole number other than 0 and 1 behind +, -, *, <, ( is one more; of 1: 2
  dropped      the last term of a sum is left out

  contrib/draw-faults.py --seed 3 --number 60                        the list
  contrib/draw-faults.py --seed 3 --number 60 --try                  build in build-drawn, try them, fill doc/dev/records/mutations.md
  contrib/draw-faults.py --seed 3 --number 60 --patch 17 FILE        FILE with the fault of that number, for a build
  contrib/draw-faults.py --number 300 --check                        each can be chosen at run time (no build)

All of them are in one copy of the project, as those of contrib/mutate.py are; the environment variable TREAD_FAULT chooses the one that acts. Each test
runs once without any and notes which faults it reaches; then the tests that reach a fault run with it, shortest first, until one fails. A fault that
no test reaches survives. What is known of survivors is in tests/mutations/drawn/: the test written since (`noticed`), why there is none (`survives`), or why
the change can alter no answer (`equivalent`).
"""

from __future__ import annotations

import collections
import glob
import json
import os
import random
import re
import resource
import shlex
import subprocess
import sys
import time
from collections.abc import Callable, Iterable

from mutate import build, copy_sources, fails, tests_of, write_if_changed
from tread.commands import command_parser, run_command
from tread.files import Error, read_toml
from tread.runs import ROOT
from tread.tables import fill, machine, markdown, marked

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
    files = sorted(path for pattern in ("source/**/*.cc", "source/**/*.h", "contrib/python/tread/**/*.py")
                   for path in glob.glob(os.path.join(ROOT, pattern), recursive=True))
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


COMMAND_WORDS = {"if", "for", "while", "switch", "catch"}
# Where an expression begins and ends.
BORDERS = {"cc": {"return", "else", "case", "throw", "do"},
           "py": {"return", "else", "if", "elif", "for", "while", "assert", "yield", "lambda", "raise", "from", "with", "as", "del", "import"}}
CLOSING = {")": "(", "]": "[", "}": "{"}


def masked(text: str, is_python: bool) -> str:
    """The text with remarks and quoted text blotted out, each sign where it was."""
    comment = r"#[^\n]*" if is_python else r"//[^\n]*|/\*.*?\*/"
    quoted = r'(?:[rbf]*""".*?""")|' if is_python else r'R"(\w*)\(.*?\)\1"|'
    pattern = re.compile(rf"""{comment}|{quoted}"(?:[^"\\\n]|\\.)*"|(?<![\w])'(?:[^'\\\n]|\\.)*'""", re.DOTALL)
    return pattern.sub(lambda match: re.sub(r"[^\n]", "_", match[0]), text)


def is_assignment(text: str, at: int) -> bool:
    return text[at] == "=" and text[at - 1] not in "=!<>" and text[at + 1:at + 2] != "="


def expression_around(text: str, begin: int, end: int, is_python: bool) -> tuple[int, int]:
    """The smallest whole expression of a masked text in which [begin, end) lies: between brackets, commas, assignments and words such as return."""
    words = BORDERS["py" if is_python else "cc"]
    breaks = ",;?\n:" if is_python else ",;?:"

    def ends(at: int, depth: int) -> bool:
        if depth:
            return False
        if text[at] == "\n" and is_python:
            return in_brackets == 0
        if text[at] == ":" and not is_python and ":" in (text[at - 1], text[at + 1]):
            return False
        return text[at] in breaks or is_assignment(text, at)

    in_brackets = 0  # of a Python statement, whose lines end with it
    if is_python:
        for sign in text[:begin]:
            in_brackets += (sign in "([{") - (sign in ")]}")
    left, open_at = begin, []
    while left > 0:
        sign = text[left - 1]
        if sign == "}" and not open_at and not is_python:
            break
        if sign in ")]}":
            open_at.append(left)
        elif sign in "([{":
            if not open_at:
                break
            closed = open_at.pop()
            word = re.search(r"(\w+)\s*$", text[:left - 1])
            if not open_at and not is_python and word and word[1] in COMMAND_WORDS:
                left = closed
                break
        elif ends(left - 1, len(open_at)):
            break
        elif not open_at and not sign.isalnum() and sign != "_":
            word = re.match(r"\w+", text[left:])
            of_loop = word and word[0] == "in" and re.search(r"\bfor\s+[\w, ()*]+\s$", text[:left])
            if word and (word[0] in words or of_loop) and left + len(word[0]) <= begin:
                left += len(word[0])
                break
        left -= 1
    right, depth = end, 0
    while right < len(text):
        sign = text[right]
        if sign in "([{":
            depth += 1
        elif sign in ")]}":
            if not depth:
                break
            depth -= 1
        elif ends(right, depth):
            while is_assignment(text, right) and text[right - 1] in "+-*/%&|^":
                right -= 1
            break
        elif not depth and is_python and not text[right - 1].isalnum() and (word := re.match(r"\w+", text[right:])) and word[0] in words:
            break
        right += 1
    while text[left].isspace():
        left += 1
    while text[right - 1].isspace():
        right -= 1
    return left, right


def at_run_time(fault: dict) -> dict | None:
    """The fault as contrib/mutate.py has them: `begin`, `old` and `new` of an expression; None if it is none."""
    with open(os.path.join(ROOT, fault["file"]), encoding="utf-8") as stream:
        text = stream.read()
    start = sum(len(line) + 1 for line in text.split("\n")[:fault["line"] - 1])
    old, new = fault["old"], fault["new"]
    before = len(os.path.commonprefix([old, new]))
    behind = min(len(os.path.commonprefix([old[::-1], new[::-1]])), len(old) - before, len(new) - before)
    begin, end = start + before, start + len(old) - behind
    is_python = fault["file"].endswith(".py")
    left, right = expression_around(masked(text, is_python), begin, end, is_python)
    if "\n#" in text[left:right] and not is_python:
        return None
    changed = text[left:begin] + new[before:len(new) - behind] + text[end:right]
    choice = {"file": fault["file"], "number": fault["number"], "begin": left, "old": text[left:right], "new": changed}
    # What is known at compile time cannot be chosen later.
    statement = text[max(text.rfind(sign, 0, left) for sign in ";{}") + 1:left]
    if "constexpr " in statement and not is_python:
        first = left - len(statement) + statement.index("constexpr ")
        choice |= {"begin": first, "old": text[first:right],
                   "both": text[first:left].replace("constexpr ", "const ", 1) + f"(CHOSEN ? ({changed}) : ({text[left:right]}))"}
    return choice


CHOSEN = '''# SPDX-License-Identifier: LGPL-2.1-or-later
"""The fault that acts."""

import os

# Those with which the process began: tests change os.environ.
with open("/proc/self/environ", encoding="utf-8", errors="replace") as _stream:
    _GIVEN = dict(line.split("=", 1) for line in _stream.read().split("\\0") if "=" in line)


def _acts(number: int) -> bool:
    chosen = _GIVEN.get("TREAD_FAULT", "0")
    if chosen == "-1" and "TREAD_FAULTS_REACHED" in _GIVEN:
        with open(_GIVEN["TREAD_FAULTS_REACHED"], "a", encoding="utf-8") as stream:
            stream.write(f"{number}\\n")
    return chosen == str(number)
'''


def is_python_text(text: str) -> bool:
    try:
        compile(text, "text", "exec")
    except (SyntaxError, ValueError):
        return False
    return True


def with_python_faults(text: str, faults: Iterable[dict]) -> tuple[str, list[dict]]:
    """A Python file in which each fault waits for its number, as an expression or as a statement of one line, and the faults for which neither compiles."""
    left_out = []
    for fault in sorted(faults, key=lambda one: -one["begin"]):
        acts = f'__import__("tread.chosen_fault", fromlist=["_acts"])._acts({fault["number"]})'
        begin, end = fault["begin"], fault["begin"] + len(fault["old"])
        line_begin, line_end = text.rfind("\n", 0, begin) + 1, text.find("\n", end)
        line, room = text[line_begin:line_end], re.match(r"\s*", text[line_begin:])[0]
        new_line = line[:begin - line_begin] + fault["new"] + line[end - line_begin:]
        choices = [text[:begin] + f"(({fault['new']}) if {acts} else ({fault['old']}))" + text[end:],
                   text[:line_begin] + f"{room}if {acts}: {new_line.strip()}\n{room}else: {line.strip()}" + text[line_end:]]
        good = [choice for choice in choices if is_python_text(choice)]
        if good:
            text = good[0]
        else:
            left_out.append(fault)
    return text, left_out


def compiles(fault: dict, folder: str) -> bool:
    """Whether its file compiles with the fault instead of the line."""
    text = with_fault(fault)
    if fault["file"].endswith(".py"):
        return is_python_text(text)
    with open(os.path.join(folder, "build/compile_commands.json"), encoding="utf-8") as stream:
        commands = json.load(stream)
    path = os.path.join(folder, fault["file"])
    command = next((one for one in commands if one["file"] == path), None)
    if command is None:
        return True  # of a header: the build says so
    trial = path + ".trial.cc"
    with open(trial, "w", encoding="utf-8") as stream:
        stream.write(text)
    words = [trial if word == path else word for word in shlex.split(command["command"])]
    words[words.index("-o") + 1] = os.devnull
    done = subprocess.run([*words, "-fsyntax-only"], cwd=command["directory"], capture_output=True)
    os.remove(trial)
    return done.returncode == 0


def without_overlaps(faults: Iterable[dict]) -> list[dict]:
    """Those whose expressions lie apart from those drawn before them."""
    kept: list[dict] = []
    for fault in faults:
        if not any(one["file"] == fault["file"] and one["begin"] < fault["begin"] + len(fault["old"]) and fault["begin"] < one["begin"] + len(one["old"])
                   for one in kept):
            kept.append(fault)
    return kept


def lines_in_copy(fault: dict) -> range:
    """Those of its expression; the copy has one more in front."""
    with open(os.path.join(ROOT, fault["file"]), encoding="utf-8") as stream:
        before = stream.read()[:fault["begin"]].count("\n") + 2
    return range(before, before + fault["old"].count("\n") + 1)


def build_copy(folder: str, faults: list[dict], jobs: int) -> tuple[list[int], list[int]]:
    """Numbers of the faults that are in the program of the copy, and of those that do not compile, of which others are drawn in the place. The rest is
    in neither: their files compile with the one or the other line, but not with a choice between them."""
    choices = [choice for fault in faults if (choice := at_run_time(fault))]
    choices = without_overlaps(choices)
    impossible = []
    by_number = {fault["number"]: fault for fault in faults}
    while True:
        copy_sources(folder, [choice for choice in choices if not choice["file"].endswith(".py")])
        write_if_changed(os.path.join(folder, "contrib/python/tread/chosen_fault.py"), CHOSEN)
        for file in sorted({choice["file"] for choice in choices if choice["file"].endswith(".py")}):
            with open(os.path.join(ROOT, file), encoding="utf-8") as stream:
                text, left_out = with_python_faults(stream.read(), [choice for choice in choices if choice["file"] == file])
            write_if_changed(os.path.join(folder, file), text)
            choices = [choice for choice in choices if choice not in left_out]
        try:
            build(folder, jobs)
            break
        except Error:
            with open(os.path.join(folder, "build.log"), encoding="utf-8") as stream:
                errors = re.findall(r"(source/[\w/]+\.(?:cc|h)):(\d+):\d+: error|(source/[\w/]+\.(?:cc|h)):(\d+):\d+:   required from", stream.read())
            places = {(one or other, int(line or other_line)) for one, line, other, other_line in errors}
            culprits = [choice for choice in choices if any((choice["file"], line) in places for line in lines_in_copy(choice))]
            culprits = culprits or [choice for choice in choices if choice["file"] in {file for file, line in places}]
            if not culprits:
                raise
            print("not at run time: " + ", ".join(str(choice["number"]) for choice in culprits), flush=True)
            choices = [choice for choice in choices if choice not in culprits]
    inside = [choice["number"] for choice in choices]
    impossible = [number for number in by_number if number not in inside and not compiles(by_number[number], folder)]
    return inside, impossible


LEFT_OUT = re.compile(r"^(doc\.manual|install\.|mutations\.|fuzz\.|python\.source|doc\.pages|doc\.scenes)")  # They look at texts and installations.


def costs_of(folder: str) -> dict[str, float]:
    """Seconds of tests by ctest's own record of a build."""
    try:
        with open(os.path.join(folder, "Testing/Temporary/CTestCostData.txt"), encoding="utf-8") as stream:
            return {words[0]: float(words[2]) for line in stream if len(words := line.split()) == 3}
    except OSError:
        return {}


def check(faults: list[dict]) -> None:
    """@raises Error if some cannot be chosen at run time, or give another line than what was drawn"""
    choices = [choice for fault in faults if (choice := at_run_time(fault))]
    by_number = {fault["number"]: fault for fault in faults}
    for choice in choices:
        with open(os.path.join(ROOT, choice["file"]), encoding="utf-8") as stream:
            text = stream.read()
        fault, end = by_number[choice["number"]], choice["begin"] + len(choice["old"])
        if "both" not in choice and text[:choice["begin"]] + choice["new"] + text[end:] != with_fault(fault):
            raise Error(f"{fault['file']}:{fault['line']}: the expression with the fault is not the line that was drawn")
    count = len(choices)
    for file in sorted({choice["file"] for choice in choices if choice["file"].endswith(".py")}):
        with open(os.path.join(ROOT, file), encoding="utf-8") as stream:
            text, left_out = with_python_faults(stream.read(), without_overlaps(choice for choice in choices if choice["file"] == file))
        count -= len(left_out)
        if not is_python_text(text):
            raise Error(f"{file} with faults is no Python")
    if count < 0.98 * len(faults):
        raise Error(f"{count} of {len(faults)} faults can be chosen at run time")
    print(f"{count} of {len(faults)} faults can be chosen at run time")


class Attempts:
    """What is known so far of tests and faults, in a file."""

    def __init__(self, folder: str):
        self.path = os.path.join(folder, "attempts.json")
        self.tests: dict[str, dict] = {}
        self.faults: dict[str, dict] = {}
        if os.path.exists(self.path):
            with open(self.path, encoding="utf-8") as stream:
                known = json.load(stream)
            self.tests, self.faults = known["tests"], known["faults"]

    def save(self) -> None:
        with open(self.path + ".new", "w", encoding="utf-8") as stream:
            json.dump({"tests": self.tests, "faults": self.faults}, stream, indent=1)
        os.replace(self.path + ".new", self.path)

    def of(self, number: int) -> dict:
        return self.faults.setdefault(str(number), {"noticed": None, "seconds": 0., "tried": []})

    def note_reached(self, name: str, test: dict, folder: str) -> None:
        """Run a test without any fault, and note those that it reaches."""
        path = os.path.join(folder, "reached")
        if os.path.exists(path):
            os.remove(path)
        start = time.monotonic()
        failed = fails(test, -1, 1800, TREAD_FAULTS_REACHED=path)
        reached: list[int] = []
        if os.path.exists(path):
            with open(path, encoding="utf-8") as stream:
                reached = sorted({int(line) for line in stream})
        self.tests[name] = {"seconds": time.monotonic() - start, "passes": not failed, "reached": reached}
        self.save()

    def try_faults(self, name: str, test: dict, numbers: Iterable[int], longest: float) -> None:
        """Run a test with each of the faults that it reaches and no test has noticed."""
        known = self.tests[name]
        if not known["passes"]:
            return
        for number in sorted(set(known["reached"]) & set(numbers)):
            fault = self.of(number)
            if fault["noticed"] or name in fault["tried"] or fault["seconds"] > longest:
                continue
            start = time.monotonic()
            failed = fails(test, number, 60. + 10. * known["seconds"])
            fault["seconds"] += time.monotonic() - start
            fault["tried"].append(name)
            if failed:
                fault["noticed"] = name
            self.save()


def try_all(folder: str, numbers: list[int], longest_test: float, longest: float, only: str) -> tuple[Attempts, list[int]]:
    """Test by test, shortest first: which faults it reaches, and which of them it notices. With them those that were tried: all if all tests ran, now or
    before, and otherwise those with which one ran."""
    tests = {name: test for name, test in tests_of(folder).items()
             if not LEFT_OUT.search(name)
             and "nightly" not in next((one["value"] for one in test["properties"] if one["name"] == "LABELS"), [])}
    attempts = Attempts(folder)
    costs = costs_of(os.path.join(ROOT, "build")) | {name: known["seconds"] for name, known in attempts.tests.items()}
    for name in sorted((name for name in tests if re.search(only, name)), key=lambda name: costs.get(name, 30.)):
        if costs.get(name, 0.) > longest_test:
            continue
        if name not in attempts.tests:
            attempts.note_reached(name, tests[name], folder)
        attempts.try_faults(name, tests[name], numbers, longest)
        left = [number for number in numbers if not attempts.of(number)["noticed"]]
        known = attempts.tests[name]
        print(f"{time.strftime('%H:%M:%S')} {name:<40} {known['seconds']:5.1f} s{'' if known['passes'] else ' FAILS'}, reaches {len(known['reached']):3}; "
              f"{len(left)} not noticed", flush=True)
    return attempts, [number for number in numbers if attempts.of(number)["tried"] or tests.keys() <= attempts.tests.keys()]


def folder_of(file: str) -> str:
    return "contrib/python/tread" if file.endswith(".py") else os.path.join(*file.split(os.sep)[:2]) if file.count(os.sep) > 1 else "source"


def without_equivalent(tried: list[int], attempts: Attempts, known: dict[int, dict]) -> str:
    """A sentence on those that can alter no answer, and the share of the others that is noticed."""
    equivalent = [number for number in tried if "equivalent" in known.get(number, {}) and not attempts.of(number)["noticed"]]
    others = [number for number in tried if number not in equivalent]
    noticed = [number for number in others if attempts.of(number)["noticed"] or "noticed" in known.get(number, {})]
    if not equivalent:
        return ""
    return (f"{len(equivalent)} of those tried alter no answer by more than the tolerance of an iteration ({', '.join(map(str, equivalent))}); "
            f"with the tests written since {len(noticed)} of the {len(others)} others are noticed, {100 * len(noticed) / len(others):.0f} %. ")


def write_page(seed: int, commit: str, faults: list[dict], inside: list[int], attempts: Attempts, not_compiled: int) -> None:
    """The tables of doc/dev/records/mutations.md on drawn faults. @param inside numbers of those that were tried"""
    path = os.path.join(ROOT, f"tests/mutations/drawn/{seed}.toml")
    known = {one["number"]: one for one in read_toml(path)["fault"]} if os.path.exists(path) else {}
    folders = collections.defaultdict(list)
    for fault in faults:
        folders[folder_of(fault["file"])].append(fault)
    rows, survivors, noticed_by = [], [], []
    reached = {number for test in attempts.tests.values() if test["passes"] for number in test["reached"]}
    for folder, listed in [*sorted(folders.items()), ("all", faults)]:
        tried = [fault["number"] for fault in listed if fault["number"] in inside]
        noticed = [number for number in tried if attempts.of(number)["noticed"]]
        now = noticed + [number for number in tried if number not in noticed and "noticed" in known.get(number, {})]
        share = lambda some: f"{100 * len(some) / len(tried):.0f} %" if tried else "-"
        rows.append([folder, str(len(listed)), str(len(tried)), str(len(noticed)), share(noticed), str(len(now)), share(now)])
    text = lambda line: "`" + line.strip().replace("|", "\\|") + "`"
    for fault in faults:
        noticed, why = attempts.of(fault["number"])["noticed"], known.get(fault["number"], {})
        place = f"{fault['file']}:{fault['line']}"
        if noticed:
            noticed_by.append([str(fault["number"]), place, fault["kind"], f"`{noticed}`"])
        elif fault["number"] in inside:
            unknown = "a test is missing" if fault["number"] in reached else "no test that ran reaches it"
            survivors.append([str(fault["number"]), place, text(fault["old"]), text(fault["new"]),
                              f"`{why['noticed']}` does since" if "noticed" in why else why.get("equivalent", why.get("survives", unknown))])
    names = [f"`{name}`" for name, test in sorted(attempts.tests.items()) if test["passes"]]
    missing = "" if not not_compiled else f" ({not_compiled} more did not)"
    fill("dev/records/mutations.md", f"drawn {seed}", markdown(["folder", "drawn", "tried", "noticed", "share", "with the tests written since", "share"], rows)
         + f"\n\nThe first {len(faults)} faults of seed {seed} that compile{missing}, drawn from the sources of {commit}. What ran: {', '.join(names)}; "
         + f"{sum(attempts.of(fault['number'])['seconds'] for fault in faults):.0f} s with a fault on a machine that was busy otherwise. "
         + ("Tried are those with which one of these tests ran; nothing is known of the others. " if any(f["number"] not in inside for f in faults) else "")
         + without_equivalent([fault["number"] for fault in faults if fault["number"] in inside], attempts, known)
         + f"{machine()}; `contrib/draw-faults.py --seed {seed} --number {len(faults)} --try`.")
    fill("dev/records/mutations.md", f"drawn survivors {seed}", markdown(["number", "line", "it was", "with the fault", "why no test noticed it"], survivors or [["-"] * 5]))
    fill("dev/records/mutations.md", f"drawn noticed {seed}", markdown(["number", "line", "change", "noticed by"], noticed_by or [["-"] * 4]))


def main() -> None:
    parser = command_parser(__doc__ or "")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--number", type=int, default=60)
    parser.add_argument("--patch", nargs=2, metavar=("NUMBER", "FILE"))
    parser.add_argument("--check", action="store_true", help="only see that each can be chosen at run time")
    parser.add_argument("--try", dest="tried", action="store_true", help="build a copy with all of them, run the tests, fill the page")
    parser.add_argument("--folder", default=os.path.join(ROOT, "build-drawn"), help="copy, its build and what is known so far (build-drawn)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers at a time (number of processors)")
    parser.add_argument("--tests", default="", metavar="REGEX", help="only these tests")
    parser.add_argument("--longest-test", type=float, default=120., help="tests that take longer are left out (120 s)")
    parser.add_argument("--longest", type=float, default=600., help="no further test for a fault that has taken so long (600 s)")
    arguments = parser.parse_args()
    faults = drawn(arguments.seed, arguments.number)
    if arguments.patch:
        with open(arguments.patch[1], "w", encoding="utf-8") as stream:
            stream.write(with_fault(faults[int(arguments.patch[0]) - 1]))
        return
    if arguments.check:
        return check(faults)
    if not arguments.tried:
        for fault in faults:
            print(f"{fault['number']:3} {fault['file']}:{fault['line']} {fault['kind']}\n    - {fault['old'].strip()}\n    + {fault['new'].strip()}")
        return
    with open(os.path.join(ROOT, "doc/dev/records/mutations.md"), encoding="utf-8") as stream:
        page = stream.read()
    for table in (f"{kind} {arguments.seed}" for kind in ("drawn", "drawn survivors", "drawn noticed")):
        if not marked(table).search(page):
            raise Error(f"doc/dev/records/mutations.md has no place for the table '{table}': each seed has its own three")
    # A fault that allocates or writes without end takes the machine from nobody.
    resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
    resource.setrlimit(resource.RLIMIT_FSIZE, (4 << 30, 4 << 30))
    more = drawn(arguments.seed, arguments.number + arguments.number // 10 + 5)  # for those that do not compile
    store = os.path.join(arguments.folder, "built.json")
    if os.path.exists(store):
        with open(store, encoding="utf-8") as stream:
            commit, more, inside, impossible = json.load(stream)
    else:
        inside, impossible = build_copy(arguments.folder, more, arguments.jobs)
        commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()
        write_if_changed(store, json.dumps([commit, more, inside, impossible], indent=1))
    chosen = [fault for fault in more if fault["number"] not in impossible][:arguments.number]
    numbers = [fault["number"] for fault in chosen]
    if left_out := [number for number in numbers if number not in inside]:
        print("in no program, to be built one by one: " + ", ".join(map(str, left_out)), flush=True)
    attempts, tried = try_all(arguments.folder, numbers, arguments.longest_test, arguments.longest, arguments.tests)
    write_page(arguments.seed, commit, chosen, [number for number in inside if number in tried], attempts, sum(number < numbers[-1] for number in impossible))


if __name__ == "__main__":
    run_command(main)
