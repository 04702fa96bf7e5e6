# SPDX-License-Identifier: LGPL-2.1-or-later
"""Positions of a wheel over a rail whose surfaces change along the way, solved by the program (tread positions)."""

from __future__ import annotations

import csv
import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence

from .files import Error
from .runs import execute, must_end_well

Row = Mapping[str, object]


def rows_of(path: str) -> list[dict[str, str]]:
    """Of a table with names in its first line that is no comment. @raises Error"""
    try:
        with open(path, encoding="utf-8-sig", newline="") as stream:
            return list(csv.DictReader(line for line in stream if not line.startswith("#")))
    except UnicodeDecodeError as error:
        raise Error(f"{path}: {error}") from None


def number(row: Mapping[str, str], name: str, where: str) -> float | None:
    """The entry of a column; None where there is none. @raises Error"""
    text = (row.get(name) or "").strip()
    if not text:
        return None
    try:
        return float(text)
    except ValueError:
        raise Error(f"{where}: {name} is '{text}', which is no number") from None


def solve(rows: Sequence[Row], program: str) -> list[list[dict[str, str]]]:
    """The patches of each position. All rows have the same columns, those of the program's table. @raises Error"""
    with tempfile.TemporaryDirectory() as folder:
        table, output = os.path.join(folder, "positions.csv"), os.path.join(folder, "patches.csv")
        write(table, list(rows[0]), rows)
        done = execute(["positions", table, "--output", output], program=program)
        if not os.path.exists(output):
            must_end_well(done)
            raise Error("the program wrote no table")
        if done.returncode:  # What was solved is still of use; rows with nan tell which was not.
            print("warning: " + (done.stderr.strip().splitlines() or ["some positions were not solved"])[-1])
        answers: list[list[dict[str, str]]] = [[] for _ in rows]
        for row in rows_of(output):
            answers[int(row["row"]) - 1].append(row)
    return answers


def write(path: str, columns: Sequence[str], rows: Iterable[Row]) -> None:
    with open(path, "w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, columns, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
