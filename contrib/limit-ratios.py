#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How near the tests' limits are to the errors found: fill the table of doc/mutations.md from the log of contrib/test.sh.

Statements that hold or do not, and comparisons without any error, have no ratio and are counted apart.
"""

import collections
import os
import re

from tread.commands import command_parser, run_command
from tread.files import DataError
from tread.runs import ROOT
from tread.tables import fill, markdown

LINE = re.compile(r"^(?P<what>.*\S) +computed +(\S+) +reference +(\S+) +error +(?P<error>\S+) +allowed +(?P<allowed>\S+) +PASS", re.MULTILINE)
TEST = re.compile(r"^\d+/\d+ Testing: (\S+)$", re.MULTILINE)
RATIOS = (3, 10, 100, 1000)  # limit over error
LOOSE = 0.01  # a limit above it that is ten times the error is listed


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


def main():
    parser = command_parser(__doc__)
    parser.add_argument("--log", default=os.path.join(ROOT, "build/Testing/Temporary/LastTest.log"), help="ctest's log (build/Testing/Temporary/LastTest.log)")
    parser.add_argument("--loose", action="store_true", help=f"list the limits above {LOOSE} that are more than ten times the error")
    arguments = parser.parse_args()
    found = comparisons(arguments.log)
    if arguments.loose:
        for test, what, error, limit in sorted(found, key=lambda entry: entry[2] / entry[3] if entry[3] else 0.):
            if limit > LOOSE and 10. * error < limit:
                print(f"{test:<34} {what:<80} {error:9.2e} {limit:9.2e}")
        return
    counts = collections.defaultdict(collections.Counter)
    for test, _, error, limit in found:
        for group in (re.split(r"[._]", test)[0], "all"):
            if limit == 0.:
                counts[group]["statements"] += 1
            elif error == 0.:
                counts[group]["none"] += 1
            else:
                counts[group][next((ratio for ratio in RATIOS if limit < ratio * error), "more")] += 1
                counts[group]["loose"] += limit > LOOSE and limit > 10. * error
    columns = ["statements", "none", *RATIOS, "more", "loose"]
    header = ["tests", "statements", "no error", *(f"limit below {ratio} errors" for ratio in RATIOS), "above", f"above 10 errors and {LOOSE}"]
    rows = [[group, *(str(counts[group][column]) for column in columns)] for group in sorted(counts, key=lambda group: (group == "all", group))]
    fill("mutations.md", "limits", markdown(header, rows))


run_command(main)
