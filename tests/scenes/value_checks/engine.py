# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the values that nobody compares: each one of finished runs is changed in memory, and the comparisons that read it must then fail.

A value is a figure of a JSON file, a column of a table, a number in a line of the screen. A comparison is a function registered with
`compared`; it reads values through `Runs`, which notes which, and says through `Expect` what each must be: by another file, a law of balance, a
closed form or the parameters. Only those comparisons that have read a value are run again when it is changed, so all of it takes seconds.

A mention is not enough: a value counts as compared only if, in one run at least, *all* changes of it make a comparison fail. These are factors
down to 1.01, the opposite sign, and for a column rows that lie one late; for whole numbers one more; for words and truth values others. What is
zero or not a number in all runs has not been compared.
"""

from __future__ import annotations

import csv
import json
import os
import re
import warnings
from collections.abc import Callable, Iterator

import numpy as np

Name = tuple[str, str, str]  # run, file, key or column

FACTORS = (1.01, 1.1, 2.0)  # small ones that go unnoticed are told, the last one must not
NUMBERED = (("^wheel_[0-9]+_", "wheel_2_"), ("^cell_[0-9]+_", "cell_1_"), ("^support_-?[0-9]+_", "support_0_"),
            ("^(half_space_)?patches/[0-9]+/", "patches/1/"), ("^files/[0-9]+/", "files/1/"), ("^reference/[^/]*/[^/]*/", "reference/max_pressure_Pa/Hertz/"),
            ("^.*_half_space_uncertainty$", "max_pressure_Pa_half_space_uncertainty"), ("^forces/[^/]*/", "forces/normal_force_N/"),
            ("/oscillations/[0-9]+/", "/oscillations/1/"), ("/cell_[0-9]+_", "/cell_1_"))
SECTIONS = {("summary.json", name) for name in ("patches", "half_space_patches", "reference", "files")}  # what is in them is compared
# Words that are told, and lines whose numbers stand in files too or tell the time: progress, titles, words of warnings and assumptions.
TOLD = re.compile(r"tread [0-9]|x #|.* finished in|finished in|assumed:|start:|WARNING:|warning:|note:|unused:|rigid wheelset, yaw|.*factorised and solved|Results in|half-space: patch|patch #|time steps in|# # # # # # # # # nan|contact_points")
TABLES = (("^(reference_patch|patch_averaged|patch)(_wheel_[0-9]+)?[.]", "patch."), ("^peak_stress_wheel", "peak_stress"),
          ("^patches_wheel_[0-9]+", "patches"))


def generic(file: str, name: str) -> tuple[str, str]:
    """A file and a key or column as `tread columns` has them: whatever numbers are in their names."""
    for pattern, instead in TABLES:
        file = re.sub(pattern, instead, file)
    for pattern, instead in NUMBERED:
        name = re.sub(pattern, instead, name)
    return file, name


def leaves(value: object, name: str = "") -> Iterator[tuple[str, object]]:
    """(path, value) of all figures of a JSON value; lists of words stay lists."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, f"{name}/{key}" if name else key)
    elif isinstance(value, list) and any(isinstance(inner, (dict, list)) for inner in value):
        for number, inner in enumerate(value):
            yield from leaves(inner, f"{name}/{number + 1}")
    elif isinstance(value, list) and value and all(isinstance(inner, (int, float)) for inner in value):
        yield name, np.array(value, dtype=float)
    else:
        yield name, value


def column(words: list[str]) -> np.ndarray:
    try:
        return np.array(words, dtype=float)
    except ValueError:
        return np.array(words)


def table_of(path: str) -> dict[str, np.ndarray]:
    with open(path, encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.reader(stream) if row and not row[0].startswith("#")]
    return {name: column([row[place] for row in rows[1:]]) for place, name in enumerate(rows[0])}


NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.]*\w)")


def screen_of(text: str) -> dict[str, np.ndarray]:
    """{line with # for its numbers, then " 1", " 2", ... for which of them: its values in all such lines}."""
    values: dict[str, list[float]] = {}
    for line in text.replace("+-", "+- ").replace(", 1e-3", ", per mille").replace("spin, 1/m", "spin, per m").splitlines():
        what = re.sub(r"\s+", " ", NUMBER.sub("#", line)).strip()
        for place, found in enumerate(NUMBER.findall(line)):
            values.setdefault(f"{what} {place + 1}", []).append(float(found))
    return {name: np.array(numbers) for name, numbers in values.items()}


def hdf5_of(path: str) -> dict[str, np.ndarray]:
    import h5py

    values = {}
    with h5py.File(path, "r") as data:
        for group, columns in data.items():
            if isinstance(columns, h5py.Group):
                for name, dataset in columns.items():
                    values[f"{group}/{name}"] = dataset[:]
    return values


class Failed(Exception):
    """A comparison does not hold."""


class Expect:
    """What values must be. @raises Failed"""

    def __init__(self) -> None:
        self.count = 0

    def near(self, what: str, computed: object, reference: object, relative: float = 0., absolute: float = 0.) -> None:
        """Numbers or arrays; the relative error is that of the largest entry."""
        self.count += 1
        a, b = np.asarray(computed, dtype=float), np.asarray(reference, dtype=float)
        if a.shape != b.shape and a.size != 1 and b.size != 1:
            raise Failed(f"{what}: {a.shape} values instead of {b.shape}")
        allowed = relative * np.max(np.abs(b), initial=0.) + absolute
        error = np.max(np.abs(a - b), initial=0.)
        if not error <= allowed:
            raise Failed(f"{what}: computed {np.array2string(a, threshold=6, precision=6)}, reference {np.array2string(b, threshold=6, precision=6)}, "
                         f"error {error:.3g}, allowed {allowed:.3g}")

    def same(self, what: str, computed: object, reference: object) -> None:
        self.count += 1
        if not computed == reference:
            raise Failed(f"{what}: {computed!r} instead of {reference!r}")

    def that(self, what: str, holds: object) -> None:
        self.count += 1
        if not holds:
            raise Failed(what)


class Runs:
    """Values of all runs. Those that a comparison reads are noted; one may be changed."""

    def __init__(self) -> None:
        self.values: dict[Name, object] = {}
        self.changed: dict[Name, object] = {}
        self.read: set[Name] = set()
        self.parameters: dict[str, dict[str, str]] = {}
        self.folders: dict[str, str] = {}
        self.seconds: dict[str, float] = {}  # that each took
        self.version = ""
        self.checksums: dict[str, int] = {}
        self.strains: dict[str, np.ndarray] = {}  # plastic, of the wheel's cells in the picture
        self.contents: dict[str, bytes] = {}  # of files that runs have read

    def add_folder(self, run: str, folder: str, parameters: dict[str, str]) -> None:
        self.parameters[run], self.folders[run] = parameters, folder
        for file in sorted(os.listdir(folder)):
            path = os.path.join(folder, file)
            if file.endswith(".csv"):
                self.add(run, file, table_of(path))
            elif file.endswith(".json"):
                with open(path, encoding="utf-8") as stream:
                    self.add(run, file, dict(leaves(json.load(stream))))
            elif file == "run.h5":
                self.add(run, file, hdf5_of(path))

    def add(self, run: str, file: str, values: dict) -> None:
        self.values.update({(run, file, str(name)): value for name, value in values.items()})

    def get(self, run: str, file: str, name: str) -> object:
        key = (run, file, name)
        self.read.add(key)
        return self.changed[key] if key in self.changed else self.values[key]

    def of(self, run: str, file: str = "summary.json") -> Of:
        return Of(self, run, file)

    def number(self, run: str, parameter: str) -> float:
        """A parameter of a run in the unit of its name."""
        return float(self.parameters[run][parameter])


class Of:
    """Values of one file of a run by key or column."""

    def __init__(self, runs: Runs, run: str, file: str):
        self.runs, self.run, self.file = runs, run, file

    def __getitem__(self, name: str):
        return self.runs.get(self.run, self.file, name)

    def names(self) -> list[str]:
        return [name for run, file, name in self.runs.values if (run, file) == (self.run, self.file)]

    def __contains__(self, name: str) -> bool:
        return (self.run, self.file, name) in self.runs.values


Comparison = Callable[[Runs, Expect], None]
COMPARISONS: list[Comparison] = []


def compared(function: Comparison) -> Comparison:
    COMPARISONS.append(function)
    return function


def compared_each(*arguments: object) -> Callable[[Callable], Callable]:
    """A comparison for each argument."""
    def register(function: Callable) -> Callable:
        for argument in arguments:
            def one(runs: Runs, expect: Expect, argument: object = argument) -> None:
                function(runs, expect, argument)
            one.__name__ = f"{function.__name__}({argument})"
            COMPARISONS.append(one)
        return function
    return register


def changes_of(value: object) -> list[tuple[str, object]]:
    """(how, changed value); empty for what is at zero, which no change shows."""
    if isinstance(value, (bool, np.bool_)):
        return [("the contrary", not value)]
    if isinstance(value, str):
        return [("another word", value + "-")]
    if isinstance(value, list):  # of words
        return [("none of them", []), ("another word", [str(word) + "-" for word in value])] if value else []
    if isinstance(value, (int, float)):
        if not value or not np.isfinite(value):
            return []
        changes = [(f"times {factor}", factor * value) for factor in FACTORS] + [("sign", -value)]
        return ([("one more", value + 1)] if isinstance(value, int) else []) + changes
    if isinstance(value, np.ndarray) and value.dtype.kind in "US":
        return [("another word", np.char.add(value, "-"))] if value.size else []
    if isinstance(value, np.ndarray) and value.size:
        value = value.astype(float)
        finite = value[np.isfinite(value)]
        if not finite.size or not np.any(finite):
            return []
        changes = [(f"times {factor}", factor * value) for factor in FACTORS] + [("sign", -value)]
        late = np.roll(value, 1, axis=0)
        return changes + ([("a row late", late)] if value.size > 2 and np.ptp(finite) > 1e-3 * np.max(np.abs(finite)) else [])
    return []


def passes(comparison: Comparison, runs: Runs) -> str:
    """"" if it passes, or why it does not."""
    try:
        with np.errstate(all="ignore"), warnings.catch_warnings():
            warnings.simplefilter("ignore")  # means of nothing, after a change
            comparison(runs, Expect())
    except Exception as error:  # whatever a wrong value leads to
        return f"{comparison.__name__}: {type(error).__name__ + ': ' if not isinstance(error, Failed) else ''}{error}"
    return ""


class Answer:
    """What became of all values."""

    def __init__(self) -> None:
        self.failures: list[str] = []
        self.unnoticed: dict[tuple[str, str], list[str]] = {}  # of each that is not compared, why
        self.least: dict[tuple[str, str], str] = {}  # the least factor that is noticed


def examine(runs: Runs, names: set[tuple[str, str]]) -> Answer:
    """@param names (file, key or column) that must be compared beside those that the runs have"""
    answer = Answer()
    readers: dict[Name, list[Comparison]] = {}
    for comparison in COMPARISONS:
        runs.read = set()
        if failure := passes(comparison, runs):
            answer.failures.append(failure)
            continue
        for name in runs.read:
            readers.setdefault(name, []).append(comparison)
    why: dict[tuple[str, str], list[str]] = {name: [] for name in names}
    for (run, file, name), value in runs.values.items():
        known = generic(file, name)
        if file == "screen" and TOLD.match(name):
            continue
        if known in answer.least and answer.least[known] == f"{FACTORS[0]}":
            continue
        missed = []
        changes = changes_of(value)
        for how, changed in changes:
            runs.changed = {(run, file, name): changed}
            if not any(passes(comparison, runs) for comparison in readers.get((run, file, name), [])):
                missed.append(how)
        runs.changed = {}
        small = [how for how in missed if how in [f"times {factor}" for factor in FACTORS[:-1]]]
        if changes and len(missed) == len(small):
            if known not in answer.least or len(small) == 0:
                answer.least[known] = f"{FACTORS[len(small)]}"
        else:
            why.setdefault(known, []).append(f"{run}: {'unnoticed ' + ', '.join(missed) if missed else 'zero, or no number'}")
    answer.unnoticed = {name: why[name] or ["in no run"] for name in why if name not in answer.least and name not in SECTIONS}
    return answer
