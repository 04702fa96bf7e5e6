#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the figures of the Python package that no test of this folder compares: whatever a public function, method or property of the package
`tread` returns is made 3 % larger, one entry at a time, and the tests that call it must then fail.

    tests/python/unnoticed_figures.py           the list; fails if one is not in `KNOWN`

A function that returns no numbers has no figures. One that only commands call in processes of their own is not seen here.
Tests in LEFT_OUT are not run: which figures are compared does not depend on how fast the machine is.
"""

from __future__ import annotations

import contextlib
import dataclasses
import fnmatch
import functools
import importlib
import inspect
import io
import os
import pkgutil
import re
import sys
import types
import unittest
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

import tread

FACTOR = 1.03
TEST_MODULES = ("package_test", "pictures_test", "schema_test", "figures_test")
MOST_PARTS = 12  # of one answer, such as the columns of a table
MOST_EXAMPLES = 2  # of entries of one list, one of which must be noticed
# What they return is what a file holds: its names are the tests' own.
READERS = ("schema.parameters", "files.read_table", "files.read_summary", "files.frame_or_rows", "runs.Run.summary", "runs.Run.table",
           "runs.Run.history", "runs.Run.frame")
# Tests that are not run here: they spend seconds of a processor, most of them in programs that they start, in which nothing is watched. By name, so that the same
# ones are left out on each machine, however busy it is.
LEFT_OUT = (
    "package_test.Commands.*",
    "package_test.EnergyTable.*",
    "package_test.Studies.*",
    "package_test.Crossings.test_edges",
    "package_test.Crossings.test_what_is_missing_is_said",
    "package_test.Wavelets.test_the_axle_box_of_a_run",
    "package_test.Wavelets.test_power_of_a_sine_and_of_white_noise",
    "figures_test.Corrugation.test_full_slip_over_long_waves",
    "figures_test.Corrugation.test_gain_on_a_rail_that_does_not_move",
    "pictures_test.Pictures.test_one_call_draws_what_is_there",
)
MUCH = 1.  # s of a processor: tests that take more are told, for LEFT_OUT


def parts_of(value: object, depth: int = 0) -> Iterator[tuple]:
    """Paths to the numbers in an answer."""
    if isinstance(value, (bool, np.bool_, str, bytes)) or value is None:
        return
    if isinstance(value, (int, float, np.number)):
        if value and np.isfinite(value):
            yield ()
    elif isinstance(value, np.ndarray):
        if value.dtype.kind in "fiu" and value.size and np.any(np.nan_to_num(value.astype(float))):
            yield ()
    elif depth > 3:
        return
    elif isinstance(value, dict):
        for key, inner in value.items():
            yield from ((("key", key), *path) for path in parts_of(inner, depth + 1))
    elif isinstance(value, (list, tuple)):
        for place, inner in enumerate(value[:MOST_PARTS]):
            yield from ((("place", place), *path) for path in parts_of(inner, depth + 1))
    elif dataclasses.is_dataclass(value) and not isinstance(value, type):
        for field in dataclasses.fields(value):
            yield from ((("field", field.name), *path) for path in parts_of(getattr(value, field.name), depth + 1))


def with_part_changed(value: Any, path: tuple) -> Any:
    """A copy in which the number at a path is larger; the value itself if there is none."""
    if not path:
        if isinstance(value, (int, np.integer)) and not isinstance(value, bool):
            return value + 1
        if isinstance(value, (float, np.floating)):
            return FACTOR * value
        return FACTOR * value if isinstance(value, np.ndarray) and value.dtype.kind in "fiu" else value
    (kind, name), rest = path[0], path[1:]
    try:
        if kind == "key":
            return type(value)({**value, name: with_part_changed(value[name], rest)}) if name in value else value
        if kind == "place":
            entries = list(value)
            if name < len(entries):
                entries[name] = with_part_changed(entries[name], rest)
            return type(value)(*entries) if hasattr(value, "_fields") else type(value)(entries)
        changed = object.__new__(type(value))
        changed.__dict__.update(value.__dict__)
        changed.__dict__[name] = with_part_changed(getattr(value, name), rest)
        return changed
    except (TypeError, AttributeError, KeyError):
        return value


def generic(path: tuple) -> str:
    """Entries of lists are one figure, keys and fields one each."""
    return "".join(f".{name}" if kind == "field" else f"[{name}]" if kind == "key" else "[]" for kind, name in path)


class Watch:
    """Which tests call which functions; one figure of one function may be changed."""

    def __init__(self) -> None:
        self.callers: dict[str, dict[str, None]] = {}
        self.figures: dict[str, dict[str, list[tuple]]] = {}
        self.with_numbers: set[str] = set()  # by what they say that they return
        self.test = ""
        self.chosen: tuple[str, tuple] | None = None

    def answer(self, name: str, value: object) -> object:
        if isinstance(value, types.GeneratorType):
            return self.generated(name, value)
        if self.chosen is not None:
            if self.chosen[0] == name:
                value = with_part_changed(value, self.chosen[1])
        else:
            paths = self.figures.setdefault(name, {})
            for path in parts_of(value):
                examples = paths.setdefault("" if name in READERS else generic(path), [])
                if path not in examples and len(examples) < MOST_EXAMPLES:
                    examples.append(path)
            if self.test:
                self.callers.setdefault(name, {})[self.test] = None
        return value

    def generated(self, name: str, values: Iterator) -> Iterator:
        for value in values:
            yield self.answer(name, value)

    def wrapped(self, name: str, function: Callable) -> Callable:
        if re.search(r"float|int\b|ndarray|dict|Mapping", str(function.__annotations__.get("return", ""))):
            self.with_numbers.add(name)

        @functools.wraps(function)
        def around(*arguments: Any, **settings: Any) -> Any:
            return self.answer(name, function(*arguments, **settings))
        return around

    def watch_class(self, name: str, kind: type) -> None:
        for member, value in list(vars(kind).items()):
            if member.startswith("_"):
                continue
            full = f"{name}.{member}"
            if isinstance(value, functools.cached_property):
                new: Any = functools.cached_property(self.wrapped(full, value.func))
                new.__set_name__(kind, member)
            elif isinstance(value, property) and value.fget:
                new = property(self.wrapped(full, value.fget))
            elif inspect.isfunction(value):
                new = self.wrapped(full, value)
            else:
                continue
            setattr(kind, member, new)


def modules() -> list[types.ModuleType]:
    found = [tread]
    for info in pkgutil.walk_packages(tread.__path__, "tread."):
        with contextlib.suppress(ImportError):
            found.append(importlib.import_module(info.name))
    return found


def watch_package(watch: Watch) -> None:
    own = modules()
    others = [module for name, module in sys.modules.items() if name.partition(".")[0] in ("tread", *TEST_MODULES)]
    for module in own:
        for name, value in list(vars(module).items()):
            if name.startswith("_") or getattr(value, "__module__", None) != module.__name__:
                continue
            full = f"{module.__name__.removeprefix('tread.')}.{name}" if hasattr(str, "removeprefix") else f"{module.__name__[6:]}.{name}"
            if inspect.isclass(value):
                if not issubclass(value, BaseException):
                    watch.watch_class(full, value)
            elif inspect.isfunction(value):
                new = watch.wrapped(full, value)
                for other in others:
                    for alias, candidate in list(vars(other).items()):
                        if candidate is value:
                            setattr(other, alias, new)


def tests_of(suite: unittest.TestSuite) -> Iterator[unittest.TestCase]:
    for test in suite:
        if isinstance(test, unittest.TestSuite):
            yield from tests_of(test)
        else:
            yield test


def passes(test: unittest.TestCase) -> bool:
    """Also where its class prepares itself once."""
    result = unittest.TestResult()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        unittest.TestSuite([type(test)(test._testMethodName)]).run(result)
    return result.wasSuccessful()


def processor_seconds() -> float:
    """Of this process and of the programs that it has started."""
    return sum(os.times()[:4])


def unnoticed(watch: Watch, tests: dict[str, unittest.TestCase]) -> tuple[dict[str, str], int]:
    """({figure: why it is not compared}, number of all figures)"""
    seconds = {}
    for name, test in tests.items():
        watch.test, start = name, processor_seconds()
        if not passes(test):
            sys.exit(f"{name} fails without any change")
        seconds[name] = processor_seconds() - start
        if seconds[name] > MUCH:
            print(f"{name} takes {seconds[name]:.1f} s of a processor: if it always does, it belongs into LEFT_OUT", file=sys.stderr)
    watch.test = ""
    missed, count = {}, 0
    for name, paths in sorted(watch.figures.items()):
        callers = sorted(watch.callers.get(name, {}), key=lambda test: seconds[test])
        for figure, examples in paths.items():
            count += 1
            noticed = False
            for path in examples:
                watch.chosen = (name, path)
                noticed = any(not passes(tests[test]) for test in callers)
                watch.chosen = None
                if noticed:
                    break
            if not noticed:
                missed[name + figure] = "unnoticed by " + (", ".join(callers[:3]) or "any test: none calls it")
    for name in sorted(watch.with_numbers - set(watch.callers)):
        count += 1
        missed[name] = "no test of this folder calls it"
    return missed, count


# Figures that need no comparison here: patterns and reasons.
CONTACT = "of whole cases: compared by tests/scenes/contact_inp.py beside CONTACT's own answers"
KNOWN: list[tuple[str, str]] = [
    (r"contact_(cases|inp|mat|rolled|track|examples)\..*", CONTACT),
    (r"half_space\.solve(_patch)?.*", "the library's answers: compared by tests/scenes/unchecked.py and batch.py"),
    (r"creep_table\..*", "rows of contrib/contact-data/creep_table.csv and random input: compared with the library's answers by tests/scenes/batch.py"),
    (r"manchester\..*", "rolled and solved by tests/scenes/wheelset.py and wheelset_rolling.py"),
    (r"(flats|positions)\..*", "answers of the program for whole tables: compared by tests/scenes/positions.py beside CONTACT's"),
    (r"arcs\.joints.*", "joints of arcs, of which the radii are compared"),
    (r"measured_runs\.(dry_run|contact_measures|run_scene.*|in_turn.*turn.*)", "costs and figures of whole programs, for tables of doc/; compared in figures_test.py where a stand-in has them"),
    (r"pictures\.(crossing|impact|mesh|patch)\..*", "what pictures show: pictures_test.py reads it off drawn axes, in a test that takes too long to be watched"),
    (r"differences\.figures_of\[.*\]", "names of what a test puts in: figures_test.py compares all of an answer"),
    (r"schema\.(check_scenes|of_program)", "made with the program's help: schema_test.py compares the whole with the file"),
    (r"(studies\.main|runs\.processes_below|files\.read_toml)", "an exit code, numbers of processes, a file as it is"),
    (r"half_space\.roll.*", "the library's answers: compared by tests/reference/uneven_way.cc, and with its other answers in figures_test.py"),
    (r"corrugation\.(Contact|Model|gain_at_rest|gain_of_model|responses).*", "compared in figures_test.py in tests that take too long to be watched"),
    (r"corrugation\.fitted\[\].*", "what the track that is fitted has unchanged; the rest is compared"),
    (r"corrugation_runs\..*", "runs of scenes: compared by tests/scenes/corrugation.py"),
    (r"crossing_force\.AtRest\.height", "what a force at rest must have: those that have it are compared"),
]


def reason(figure: str) -> str:
    return next((why for pattern, why in KNOWN if re.fullmatch(pattern, figure)), "")


def main() -> None:
    # Tests of the program itself and of the sources need no look.
    del sys.argv[1:]
    for name in TEST_MODULES:
        with contextlib.suppress(ModuleNotFoundError):
            importlib.import_module(name)
    watch = Watch()
    watch_package(watch)
    loader = unittest.TestLoader()
    tests = {test.id(): test for name in TEST_MODULES if name in sys.modules for test in tests_of(loader.loadTestsFromModule(sys.modules[name]))}
    for pattern in LEFT_OUT:
        if not any(fnmatch.fnmatch(name, pattern) for name in tests) and pattern.partition(".")[0] in sys.modules:
            sys.exit(f"no test is called '{pattern}', which is in LEFT_OUT")
    tests = {name: test for name, test in tests.items() if not any(fnmatch.fnmatch(name, pattern) for pattern in LEFT_OUT)}
    start = processor_seconds()
    missed, count = unnoticed(watch, tests)
    new = {figure: why for figure, why in missed.items() if not reason(figure)}
    for figure, why in new.items():
        print(f"UNCHECKED {figure:<60} {why}")
    print(f"{count} figures, {len(missed)} that no test here compares, {len(new)} of them unknown; "
          f"{len(tests)} tests, {processor_seconds() - start:.0f} s of a processor")
    sys.exit(1 if new else 0)


if __name__ == "__main__":
    main()
