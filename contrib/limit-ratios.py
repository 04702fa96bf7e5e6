#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How near the tests' limits are to the errors found: fill the table of doc/dev/records/mutations.md from the log of contrib/test.sh.

Statements that hold or do not, and comparisons without any error, have no ratio and are counted apart. A limit that comparisons of a test share is
as loose as the largest of their errors makes it. tests/loose-limits.toml says why some limits stay wide.
"""

import collections
import os
import re

from tread.commands import command_parser, run_command
from tread.files import DataError, read_toml
from tread.runs import ROOT
from tread.tables import fill, markdown

LINE = re.compile(r"^(?P<what>.*\S) +computed +(\S+) +reference +(\S+) +error +(?P<error>\S+) +allowed +(?P<allowed>\S+) +PASS", re.MULTILINE)
TEST = re.compile(r"^\d+/\d+ Testing: (\S+)$", re.MULTILINE)
RATIOS = (3, 10, 100, 1000)  # limit over error
LOOSE = 0.01  # a limit above it that is ten times the error is listed
LIST = os.path.join(ROOT, "tests", "loose-limits.toml")


def comparisons(log):
    """[(test, what, error, limit)] of what ctest keeps of the tests. @raises DataError"""
    try:
        with open(log, encoding="utf-8", errors="replace") as stream:
            text = stream.read()
    except OSError as error:
        raise DataError(f"{log}: {error.strerror}; run contrib/test.sh first") from None
    parts = TEST.split(text)
    found = [(test, match["what"], float(match["error"]), float(match["allowed"]))
             for test, output in zip(parts[1::2], parts[2::2]) for match in LINE.finditer(output)]
    if not found:
        raise DataError(f"{log}: no comparison; run contrib/test.sh first")
    return found


def reasons():
    """[(test, part of what is compared)] of limits that stay wide. @raises DataError"""
    try:
        return [(entry["test"], entry["what"]) for entry in read_toml(LIST)["limit"] if entry["reason"]]
    except KeyError as error:
        raise DataError(f"{LIST}: no {error}") from None


def shared(test, what, limit):
    """What comparisons that share a limit have in common: the program, what is measured but for numbers, the limit to a digit."""
    return program(test), re.sub(r"[-+]?\d[\d.]*", "#", what.split(": ")[-1]), f"{limit:.0e}"


def program(test):
    return test.split(".")[0] if not test.startswith("scene.") else test


def loose_ones(found):
    """Which comparisons have a loose limit: for each None, "loose" or "reason"."""
    largest = collections.defaultdict(float)
    for test, what, error, limit in found:
        key = shared(test, what, limit)
        largest[key] = max(largest[key], error)
    listed = reasons()
    for test, what, _, limit in found:
        if limit <= LOOSE or limit <= 10. * largest[shared(test, what, limit)]:
            yield None
        else:
            yield "reason" if any(program(test) == of and part in what for of, part in listed) else "loose"


def main():
    parser = command_parser(__doc__)
    parser.add_argument("--log", default=os.path.join(ROOT, "build/Testing/Temporary/LastTest.log"), help="ctest's log (build/Testing/Temporary/LastTest.log)")
    parser.add_argument("--loose", action="store_true", help=f"list the limits above {LOOSE} that are more than ten times the error")
    arguments = parser.parse_args()
    found = comparisons(arguments.log)
    marks = list(loose_ones(found))
    if arguments.loose:
        for (test, what, error, limit), mark in sorted(zip(found, marks), key=lambda entry: entry[0][2] / entry[0][3] if entry[0][3] else 0.):
            if mark == "loose":
                print(f"{test:<34} {what:<80} {error:9.2e} {limit:9.2e}")
        print(f"{marks.count('loose')} loose, {marks.count('reason')} with a reason")
        return
    counts = collections.defaultdict(collections.Counter)
    for (test, _, error, limit), mark in zip(found, marks):
        for group in (re.split(r"[._]", test)[0], "all"):
            if limit == 0.:
                counts[group]["statements"] += 1
            elif error == 0.:
                counts[group]["none"] += 1
            else:
                counts[group][next((ratio for ratio in RATIOS if limit < ratio * error), "more")] += 1
            counts[group][mark] += 1
    columns = ["statements", "none", *RATIOS, "more", "loose", "reason"]
    header = ["tests", "statements", "no error", *(f"limit below {ratio} errors" for ratio in RATIOS), "above", "loose", "loose with a reason"]
    rows = [[group, *(str(counts[group][column]) for column in columns)] for group in sorted(counts, key=lambda group: (group == "all", group))]
    fill("dev/records/mutations.md", "limits", markdown(header, rows))


run_command(main)
