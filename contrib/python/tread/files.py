# SPDX-License-Identifier: LGPL-2.1-or-later
"""Read the files of a run's folder.

numpy is imported where columns are read: without it commands can say in one line that it is missing.
"""

from __future__ import annotations

import csv
import gzip
import hashlib
import json
import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    import pandas


class Error(Exception):
    """What went wrong, in one line for the user."""

class DataError(Error):
    """A file is missing or cannot be understood."""


def why_unreadable(path: str, error: Exception) -> str:
    """One line on a file of a folder that cannot be read."""
    folder = os.path.dirname(path)
    if isinstance(error, NotADirectoryError) and os.path.isfile(folder):
        scene = ", but a scene: roll it first, and name the folder of its results" if folder.endswith(".prm") else ": name that of a run"
        return f"{folder} is no folder of results{scene}"
    return f"{path}: {getattr(error, 'strerror', None) or error}"


def read_table(path: str, required: Iterable[str] = (), text: Iterable[str] = ("state",)) -> dict[str, np.ndarray]:
    """A CSV file (also .gz; lines that start with # are comments) as {column: (rows,) array}, of numbers but for the columns
    `text`; other columns that are not numbers are left out, or refused if they are required. @raises DataError"""
    import numpy as np

    try:
        opener: Any = gzip.open if path.endswith(".gz") else open
        with opener(path, "rt", encoding="utf-8", newline="") as stream:
            rows = list(csv.reader(line for line in stream if line.strip() and not line.startswith("#")))
    except (OSError, EOFError, UnicodeDecodeError) as error:
        raise DataError(why_unreadable(path, error)) from None
    if not rows:
        raise DataError(f"{path}: empty file")
    names = [name.strip() for name in rows[0]]
    for name in required:
        if name not in names:
            raise DataError(f"{path}: no column '{name}' (columns: {', '.join(names)})")
    for number, row in enumerate(rows[1:], 1):
        if len(row) != len(names):
            raise DataError(f"{path}: data row {number} has {len(row)} entries, expected {len(names)}")
    table = {}
    for i, name in enumerate(names):
        column = [row[i].strip() for row in rows[1:]]
        if name in text:
            table[name] = np.array(column, dtype=str)
            continue
        try:
            table[name] = np.array(column, dtype=float)
        except ValueError:
            if name in required:
                raise DataError(f"{path}: column '{name}' has an entry that is not a number") from None
    return table


def frame_or_rows(rows: list[dict], columns: Sequence[str] | None = None) -> pandas.DataFrame | list[dict]:
    """A pandas DataFrame of [{column: value}], or the rows themselves where pandas is not installed. @param columns if there may be no row"""
    try:
        import pandas
    except ImportError:
        return rows
    return pandas.DataFrame(rows, columns=columns)


def read_summary(folder: str | os.PathLike) -> dict:
    """summary.json of a run, read anew. @raises DataError"""
    path = os.path.join(folder, "summary.json")
    try:
        with open(path, encoding="utf-8") as stream:
            summary = json.load(stream)
    except OSError as error:
        raise DataError(why_unreadable(path, error)) from None
    except ValueError as error:
        raise DataError(f"{path}: not valid JSON ({error})") from None
    if not isinstance(summary, dict):
        raise DataError(f"{path}: not a JSON object")
    return summary


def read_toml(path: str) -> dict:
    """A TOML file. Pythons before 3.11 need tomli for it. @raises DataError"""
    try:
        import tomllib as toml
    except ImportError:
        try:
            import tomli as toml
        except ImportError:
            raise Error(f"{path}: reading TOML needs Python 3.11, or tomli: apt install python3-tomli, or pip install tomli") from None
    try:
        with open(path, "rb") as stream:
            return toml.load(stream)
    except OSError as error:
        raise DataError(f"{path}: {error.strerror}") from None
    except ValueError as error:
        raise DataError(f"{path}: {error}") from None


def is_complete(folder: str | os.PathLike) -> bool:
    """Whether a folder has the results of a run that came to its end."""
    try:
        return read_summary(folder).get("completed") is True
    except DataError:
        return False


def parameter_lines(lines: Iterable[str]) -> Iterator[tuple[int, str | None, str, str]]:
    """(number, kind, name, text) of each line of a parameter file that is not empty; one that ends with a backslash goes on in the next. kind is "set", with name "Section/Name" and the value as
    text; "include" and "subsection", with the name; "end"; or None for a line that is none of these, or an end without a beginning, as
    text."""
    section, begun = [], ""
    for number, line in enumerate(lines, 1):
        line = begun + line.replace("\t", " ").rstrip("\n")
        begun = line[:-1] if line.endswith("\\") else ""
        if begun:
            continue
        line = line.split("#")[0].strip()
        word, _, rest = line.partition(" ")
        word = word.lower()
        name, equals, value = rest.partition("=")
        if word == "subsection":
            section.append(rest.strip())
            yield number, "subsection", rest.strip(), line
        elif line.lower() == "end" and section:
            section.pop()
            yield number, "end", "", line
        elif word == "set" and equals:
            yield number, "set", "/".join(section + [name.strip()]), value.strip()
        elif word == "include" and rest.strip():
            yield number, "include", rest.strip(), line
        elif line:
            yield number, None, "", line


def parameters_in(lines: Iterable[str]) -> dict[str, str]:
    """{"Section/Name": text} of the lines of a parameter file."""
    return {name: text for _, kind, name, text in parameter_lines(lines) if kind == "set"}


def texts_of(scene: str, depth: int = 0) -> list[str]:
    """[text] of a parameter file and of those that it includes, one after the other. @raises DataError"""
    if depth > 20:
        raise DataError(f"{scene}: is included by files that it includes")
    try:
        with open(scene, encoding="utf-8") as stream:
            text = stream.read()
    except OSError as error:
        raise DataError(f"{scene}: {error.strerror}") from None
    included = [name for _, kind, name, _ in parameter_lines(text.splitlines()) if kind == "include"]
    return [text] + [own for name in included for own in texts_of(os.path.join(os.path.dirname(scene), name), depth + 1)]


def own_parameters(scene: str) -> dict[str, str]:
    """{"Section/Name": text} of what a parameter file sets, with the files that it includes. @raises DataError"""
    return {name: value for text in reversed(texts_of(scene)) for name, value in parameters_in(text.splitlines()).items()}


def slices_named_in(path: str) -> list[str]:
    """Paths of the files in quotes that a list of slices names (.slcs, .slcw of CONTACT), relative to its folder; of any other file none."""
    if not path.lower().endswith((".slcs", ".slcw")) or not os.path.isfile(path):
        return []
    with open(path, encoding="utf-8", errors="replace") as stream:
        named = re.findall(r"^[^%!#'\"]*['\"]([^'\"]+)['\"]", stream.read(), re.MULTILINE)
    return [os.path.join(os.path.dirname(path), name) for name in named]


def input_of(scene: str, settings: Mapping[str, object]) -> dict:
    """What decides about a run's results: its settings, {"Section/Name": value}, the texts of the scene, and what the files contain that
    parameters name, such as profiles: as the program takes them, from the present folder or else from that of the scene. @raises DataError"""
    texts = texts_of(scene)
    named = {str(value) for text in texts for value in parameters_in(text.splitlines()).values()} | {str(value) for value in settings.values()}
    files = {}
    for name in sorted(named - {""}):
        path = name if os.path.exists(name) else os.path.join(os.path.dirname(scene), name)
        for part in [path] + slices_named_in(path):
            if os.path.isfile(part):
                with open(part, "rb") as stream:
                    files[name if part == path else f"{name}: {os.path.relpath(part, os.path.dirname(path) or '.')}"] = hashlib.sha256(stream.read()).hexdigest()
    return {"settings": {name: str(value) for name, value in settings.items()}, "scene": texts, "files": files}


def read_parameters(path: str) -> dict[str, str]:
    """{"Section/Name": text} of a parameter file, empty if there is none."""
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8") as stream:
        return parameters_in(stream)


def reference_value(summary: Mapping, key: str, source: str = "") -> float | None:
    """The number that the summary compares `key` with, or None; `source` picks one of several."""
    entries = summary.get("reference", {}).get(key)
    if isinstance(entries, dict) and "value" not in entries:
        entries = [dict(entry, source=entry.get("source", name)) for name, entry in entries.items()]
    elif not isinstance(entries, list):
        entries = [entries]
    entries = [entry for entry in entries if isinstance(entry, dict) and entry.get("value") is not None]
    for entry in entries:
        if source.lower() in str(entry.get("source", "")).lower():
            return float(entry["value"])
    return None
