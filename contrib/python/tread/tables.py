# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of the pages in doc/, between their marks."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence

from .commands import command_parser
from .files import DataError
from .runs import PROGRAM, ROOT


def machine() -> str:
    """Processor, its cores and widest vectors."""
    with open("/proc/cpuinfo", encoding="utf-8") as stream:
        text = stream.read()
    model = re.search(r"^model name\s*:\s*(.+)$", text, re.MULTILINE)
    vectors = next((name for flag, name in (("avx512f", "AVX-512"), ("avx2", "AVX2")) if f" {flag}" in text), "SSE2")
    cores = os.cpu_count()
    return f"{model[1] if model else 'unknown processor'}, {cores} core{'s' if cores != 1 else ''}, {vectors}"


def provenance(script: str, summaries: Iterable[Mapping]) -> str:
    """The line under a table: machine, version, command."""
    versions = ", ".join(sorted({summary["version"] for summary in summaries}))
    return f"{machine()}; tread {versions}; `{script}`."


def markdown(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def number(value: float | None) -> str:
    if value is None:
        return "-"
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.3g}"


def marked(name: str) -> re.Pattern[str]:
    """Pattern of a table's text between its marks."""
    return re.compile(rf"(<!-- begin table {name} -->\n)(.*?)(<!-- end table {name} -->)", re.DOTALL)


def rows_of(page: str, name: str) -> list[list[str]]:
    """[[cell]] of a table on a page of doc/ as it is, without its heading."""
    with open(os.path.join(ROOT, "doc", page), encoding="utf-8") as stream:
        found = marked(name).search(stream.read())
    lines = [line for line in (found[2] if found else "").splitlines() if line.startswith("| ")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[1:]]


def first_difference(kept: str, current: str) -> int | None:
    """Number of the first line in which two texts differ; None: they are the same."""
    if kept == current:
        return None
    old, new = kept.splitlines(), current.splitlines()
    return 1 + next((i for i, pair in enumerate(zip(old, new)) if pair[0] != pair[1]), min(len(old), len(new)))


def page_command(description: str, page: str, text_of: Callable[[str], str]) -> None:
    """What a command does that writes a page of doc/ as the program says it, or with --check only compares it. @param page its name; @param
    text_of a function of the program's path"""
    parser = command_parser(description)
    parser.add_argument("--program", default=PROGRAM, help="the program to ask")
    parser.add_argument("--check", action="store_true", help="write nothing")
    arguments = parser.parse_args()
    current = text_of(arguments.program)
    path = os.path.join(ROOT, "doc", page)
    if not arguments.check:
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(current)
        return
    with open(path, encoding="utf-8") as stream:
        line = first_difference(stream.read(), current)
    if line:
        sys.exit(f"doc/{page} is not current from line {line} on: run contrib/{parser.prog}")


def fill(page: str, name: str, table: str) -> None:
    """Put a table between its marks on a page of doc/."""
    path = os.path.join(ROOT, "doc", page)
    with open(path, encoding="utf-8") as stream:
        text = stream.read()
    pattern = marked(name)
    if not pattern.search(text):
        raise DataError(f"doc/{page}: no place for table '{name}'")
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(pattern.sub(lambda match: match[1] + table + "\n" + match[3], text))
    print(f"doc/{page}: table '{name}' filled")
