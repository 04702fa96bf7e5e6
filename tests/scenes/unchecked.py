#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compare what small runs write with independent values, and list every value that no comparison watches.

Each key of a JSON file, column of a table, dataset of run.h5, field of the half-space library and number on the screen is changed in memory, one at a
time, by factors down to 1.01, in its sign and by a row, and the comparisons that read it must then fail (tests/scenes/value_checks/engine.py). Those
that need none are in tests/scenes/value_checks/known.py with the reason. tests/python/unnoticed_figures.py does the same for the Python package.
"""

import argparse
import json
import os
import sys
import tempfile
import time

from tread.runs import ROOT, must_end_well
from loaded_once import execute_often
from value_checks import engine
from value_checks.known import reason
from value_checks.runs import all_runs
from value_checks import curve, half_space, library, modes, plastic, straight, track, written  # noqa: F401: they register their comparisons


def names_of(program: str) -> set[tuple[str, str]]:
    """All keys and columns that the program explains."""
    tables = json.loads(must_end_well(execute_often(["columns"], program)).stdout)
    fields = library.fields_of_the_header(os.path.join(ROOT, "include/tread/half_space.h"))
    return {(table["file"], column["name"]) for table in tables for column in table["columns"]} | {
        (struct, field) for struct, of_struct in fields.items() for field in of_struct}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--folder", help="of the runs; by default a temporary one")
    parser.add_argument("--only", default="", help="these runs alone, separated by commas")
    parser.add_argument("--all", action="store_true", help="list also what is known not to be compared, and the least factor noticed of each value")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        runs = all_runs(arguments.program, arguments.folder or temporary, arguments.only)
        if not arguments.only:
            library.add_library(runs)
        start = time.monotonic()
        answer = engine.examine(runs, names_of(arguments.program))
    for failure in answer.failures:
        print(f"FAIL {failure}")
    by_name = lambda name: f"{name[0]}: {name[1]}"
    for name in sorted(answer.unnoticed):
        why = reason(*name)
        if not why or arguments.all:
            print(f"{'known' if why else 'UNCHECKED':<10} {by_name(name):<70} {why or '; '.join(answer.unnoticed[name])[:150]}")
    if arguments.all:
        for name, least in sorted(answer.least.items()):
            print(f"noticed from a factor of {least:<5} {by_name(name)}")
    new = [name for name in answer.unnoticed if not reason(*name)]
    count = len(answer.least) + len(answer.unnoticed)
    exact = sum(least == f"{engine.FACTORS[0]}" for least in answer.least.values())
    print(f"{count} values: {len(answer.least)} compared, of which {exact} to 1 %; {len(answer.unnoticed)} not, {len(new)} of them unknown; "
          f"{len(engine.COMPARISONS)} comparisons, {len(answer.failures)} failed; {time.monotonic() - start:.0f} s")
    if new:
        print("compare them in tests/scenes/value_checks/, or say in known.py there why they need no comparison")
    return 1 if new or answer.failures else 0


if __name__ == "__main__":
    sys.exit(main())
