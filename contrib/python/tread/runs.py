# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads what a run of tread leaves in its folder, and surface files of CONTACT."""

import csv
import gzip
import json
import os
import sys

try:
    import numpy as np
except ModuleNotFoundError:
    sys.exit(f"{os.path.basename(sys.argv[0])}: {sys.executable} has no numpy; /usr/bin/python3 has it "
             "(contrib/install-debian.sh)")


class DataError(Exception):
    """A file that is missing or cannot be understood; the message is one line for the user."""


# contrib/python/tread, which the folders of commands have links to
ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), *[os.pardir] * 3))
PROGRAM = os.path.join(ROOT, "build/source/tread")


def command(arguments, ranks, program=PROGRAM):
    """The program on so many ranks; one rank needs no mpirun."""
    launch = ["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none"] if ranks > 1 else []
    return launch + [program] + arguments


def environment():
    settings = {"DEAL_II_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
                "OMPI_MCA_pml": "ob1"}
    if os.getuid() == 0:
        settings.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return dict(os.environ, **settings)


def arguments_of(scene, settings):
    result = [os.path.join(ROOT, "prm", scene)]
    for name, value in settings.items():
        result += ["-s", f"{name}={value}"]
    return result


def read_table(path, required=(), text=("state",)):
    """A CSV file (also .gz; lines that start with # are comments) as {column: numpy array}."""
    try:
        opener = gzip.open if path.endswith(".gz") else open
        with opener(path, "rt", encoding="utf-8", newline="") as stream:
            rows = list(csv.reader(line for line in stream if line.strip() and not line.startswith("#")))
    except (OSError, EOFError, UnicodeDecodeError) as error:
        raise DataError(f"{path}: {getattr(error, 'strerror', None) or error}") from None
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


def read_summary(run):
    path = os.path.join(run, "summary.json")
    try:
        with open(path, encoding="utf-8") as stream:
            summary = json.load(stream)
    except OSError as error:
        raise DataError(f"{path}: {error.strerror}") from None
    except ValueError as error:
        raise DataError(f"{path}: not valid JSON ({error})") from None
    if not isinstance(summary, dict):
        raise DataError(f"{path}: not a JSON object")
    return summary


def is_complete(folder):
    try:
        return read_summary(folder).get("completed") is True
    except DataError:
        return False


def read_parameters(path):
    """{"Section/Name": value} of a parameter file, empty if there is none."""
    result, section = {}, []
    if not os.path.exists(path):
        return result
    with open(path, encoding="utf-8") as stream:
        for line in stream:
            line = line.split("#")[0].strip()
            if line.startswith("subsection "):
                section.append(line[len("subsection "):].strip())
            elif line == "end" and section:
                section.pop()
            elif line.startswith("set "):
                name, _, value = line[len("set "):].partition("=")
                result["/".join(section + [name.strip()])] = value.strip()
    return result


def reference_value(summary, key, source=""):
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
