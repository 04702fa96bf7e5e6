# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run a parameter variation of a scene and tabulate it.

    contrib/study.py STUDY [--output DIR] [--processes N] [--ranks N] [--program FILE] [--dry-run]

A study is a text file in the format of the scenes:

    set Scene       = ../smooth-rolling.prm        # to vary, seen from the study's folder
    set Settings    = Mesh/Finest cell (mm)=1.3    # for all runs, several separated by |
    set Combination = product                      # of the values below; or zip: first with first, ...
    set Figures     = max_pressure_Pa | max(normal_force_N)
    set Smooth twin =                              # settings that take the defect away, separated by |
    set Directory   = results/my-study             # seen from where the study is started
    set Processes   = 1                            # runs at a time
    set Ranks       = 1                            # of each run
    set Limit       =                              # FIGURE = VALUE over PARAMETER: at which value of a parameter the figure
                                                   # reaches the limit, from below or from above, as in
                                                   # peak_pressure_Pa = 2e9 over Defect/Length (mm); several separated by |;
                                                   # the figure is one of 'Figures', and 0 counts as no figure
    set Mesh        =                              # varied parameter, the smaller the finer, that tells how sure this is
    subsection Vary
      set Motion/Speed (km per h) = 70 | 100 | 140
      set Defect/Length (mm) & Defect/Depth (mm) = 5 & 0.03 | 10 & 0.06     # vary together
    end

Parameters and figures that there are not are refused before the first run. Values that cannot be are left to the run that has them.

Figures are those of summary.json by their names; max(...), min(...) and last(...) of a column of history.csv, or of another
table, as in max(strip.csv:von_mises_MPa); at(strip.csv:von_mises_MPa:x_mm), which is x_mm in the row where von_mises_MPa is
largest; and, with a smooth twin, dynamic(...) and frequency(...) of a force: the peak of what the defect adds, and its
strongest vibration.

Smooth twins run first. There is one for all runs that differ in their defect alone, and one for each 'Defect/Position (mm)',
since the rail is not the same everywhere. A twin has the 'Defect/Length (mm)' of the scene, or else, if only 'Vary' has one, of the
first run: it keeps the inertia of the axle, which would settle under its load in steady rolling, and where the largest stresses
near a 'trailing edge' are recorded they are so there, which on a smooth rail makes little difference. Where a twin fails, only
the figures that need it are missing, and what the smooth rail has in limit.csv.

Each run is a process of its own with a folder of its own. A run whose results are complete is not repeated, an
interrupted one goes on from its last checkpoint, and one that fails leaves the others alone. A run is complete also if
another version of the program made it; the last lines name such runs, and without their folders they are repeated. Ctrl-C
ends the runs with a checkpoint. The table is study.csv in the study's folder, with the number of each run's warnings, which follow on the
terminal; and limit.csv beside it what 'Limit' asks.
Exit code 0: all complete; 1: something failed; 130: interrupted.
"""

from __future__ import annotations

import argparse
import contextlib
import csv
import io
import itertools
import json
import os
import re
import signal
import subprocess
import time
import warnings
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import TYPE_CHECKING, List, Optional, Tuple

from .files import DataError, Error, frame_or_rows, input_of, is_complete, own_parameters
from .limits import Limit
from .runs import PROGRAM, ProgramError, Run, arguments_of, command, dynamic_force, environment, execute, must_be_command, must_end_well, own_line, scene_path, text_of, version_of
from .schema import edit_distance, listing, not_among, parameters

if TYPE_CHECKING:
    import pandas

DEFAULTS = {"Scene": None, "Settings": "", "Combination": "product",
            "Figures": "normal_force_N | traction_coefficient | max_pressure_Pa", "Smooth twin": "", "Directory": "",
            "Processes": "1", "Ranks": "1", "Limit": "", "Mesh": ""}
COMPLETE = "complete"
LENGTH = "Defect/Length (mm)"


class Interruption(Exception):
    pass


def values_of(text: str, none_empty: str = "") -> list[str]:
    """What | separates. Empty values are left out, or refused if it is said what must have none. @raises DataError"""
    values = [value.strip() for value in text.split("|")] if text.strip() else []
    if none_empty and "" in values:
        raise DataError(f"{none_empty} has an empty value")
    return [value for value in values if value]


def settings_of(text: str, where: str) -> dict[str, str]:
    """{"Section/Name": value} of "Section/Name=value | ..."."""
    result = {}
    for setting in values_of(text):
        name, equals, value = setting.partition("=")
        if not equals or "/" not in name:
            raise DataError(f"{where}: '{setting}' must be Section/Name=value")
        result[name.strip()] = value.strip()
    return result


class Study:
    """What a file, or a call of study(), asks for."""

    def __init__(self, path: str, entries: Mapping[str, str], vary: Mapping[str, str]):
        """@param path of the file, or what names the call in messages @param entries {entry: text}, those of DEFAULTS
        @param vary {"Section/Name", or several with & between them: values separated by |}"""
        self.path, self.vary = path, vary
        self.scene = os.path.join(os.path.dirname(os.path.abspath(path)), entries["Scene"])
        self.settings = settings_of(entries["Settings"], f"{path}: 'Settings'")
        self.without_defect = settings_of(entries["Smooth twin"], f"{path}: 'Smooth twin'")
        self.figures = values_of(entries["Figures"])
        for figure in self.figures:
            kind = re.match(r"(\w+)\(", figure)
            if kind and kind[1] not in ("max", "min", "last", "at", "dynamic", "frequency"):
                raise DataError(f"{path}: 'Figures': no '{kind[1]}(...)'; there are max, min, last, at, dynamic, frequency")
            if kind and kind[1] == "at" and figure.count(":") != 2:
                raise DataError(f"{path}: 'Figures': {figure} must be at(TABLE.csv:COLUMN:OTHER COLUMN)")
            if kind and kind[1] in ("dynamic", "frequency") and not self.without_defect:
                raise DataError(f"{path}: 'Figures': {figure} needs a 'Smooth twin'")
        self.directory = entries["Directory"] or os.path.join(
            "results", os.path.splitext(os.path.basename(path))[0])
        self.processes, self.ranks = (self.count(path, entries, name) for name in ("Processes", "Ranks"))
        lists = [[split_together(value) for value in values_of(text, f"{path}: 'Vary/{name}'")] for name, text in self.vary.items()]
        names = [split_together(name) for name in self.vary]
        for together, name, values in zip(names, self.vary, lists):
            if not values:
                raise DataError(f"{path}: 'Vary/{name}' has no value")
            if "Output/Directory" in together:
                raise DataError(f"{path}: 'Vary/Output/Directory': each run of a study has a folder of its own, below 'Directory'")
            for value in values:
                if len(value) != len(together):
                    raise DataError(f"{path}: 'Vary/{name}': '{' & '.join(value)}' must be {len(together)} values with & between them")
        if entries["Combination"] == "zip" and len({len(values) for values in lists}) > 1:
            raise DataError(f"{path}: 'Combination' zip needs as many values of each parameter; there are "
                            + ", ".join(f"{len(values)} of '{name}'" for name, values in zip(self.vary, lists)))
        if entries["Combination"] not in ("product", "zip"):
            raise DataError(f"{path}: 'Combination' cannot be '{entries['Combination']}'; allowed: product, zip")
        combined = itertools.product(*lists) if entries["Combination"] == "product" else zip(*lists)
        self.members = [{name: value for pair in zip(names, values) for name, value in zip(*pair)} for values in combined]
        self.limits = [Limit.read(path, text, entries["Mesh"], self) for text in values_of(entries["Limit"])]
        if entries["Mesh"] and not self.limits:
            raise DataError(f"{path}: 'Mesh' says how sure a 'Limit' is; there is none")
        for what, same in (("the same values", lambda member: tuple(map(number_or_text, member.values()))),
                           ("values that make the same name of a folder", folder_name)):
            seen = {}
            for member in self.members:
                other = seen.setdefault(same(member), member)
                if other is not member:
                    texts = (", ".join(f"{name}={value}" for name, value in each.items()) for each in (other, member))
                    raise DataError(f"{path}: two runs have {what}: {' and '.join(texts)}")

    @classmethod
    def of_file(cls, path: str) -> Study:
        return cls(path, *cls.read(path))

    @staticmethod
    def read(path: str) -> tuple[dict[str, str], dict[str, str]]:
        """(entries, vary) of a file."""
        try:
            with open(path, encoding="utf-8") as stream:
                lines = [line.split("#")[0].strip() for line in stream]
        except (OSError, UnicodeDecodeError) as error:
            raise DataError(f"{path}: {getattr(error, 'strerror', None) or error}") from None
        entries, vary, given, inside = dict(DEFAULTS), {}, set(), False
        for number, line in enumerate(lines, 1):
            where = f"{path}, line {number}"
            found = re.fullmatch(r"set\s+([^=]+?)\s*=\s*(.*)", line)
            if found and inside:
                if "/" not in found[1]:
                    raise DataError(f"{where}: '{found[1]}' must be Section/Name")
                if found[1] in vary:
                    raise DataError(f"{where}: '{found[1]}' is there twice")
                vary[found[1]] = found[2]
            elif found:
                if found[1] not in DEFAULTS:
                    raise DataError(f"{where}: no entry '{found[1]}'; there are {', '.join(DEFAULTS)} and subsection Vary")
                if found[1] in given:
                    raise DataError(f"{where}: '{found[1]}' is there twice")
                given.add(found[1])
                entries[found[1]] = found[2]
            elif re.fullmatch(r"subsection\s+Vary", line) and not inside:
                inside = True
            elif line == "end" and inside:
                inside = False
            elif line.startswith("subsection ") and not inside:
                raise DataError(f"{where}: '{line}' is of a scene; a study names its scene by 'set Scene = FILE'")
            elif line:
                raise DataError(f"{where}: cannot read '{line}'")
        if inside:
            raise DataError(f"{path}: 'subsection Vary' has no end")
        if not entries["Scene"]:
            raise DataError(f"{path}: 'Scene' is missing")
        if not vary:
            raise DataError(f"{path}: 'subsection Vary' names no parameter")
        return entries, vary

    def must_name_parameters(self, program: str) -> None:
        """@raises DataError naming a parameter that there is not: every run would fail of it. A program may be newer than this package: it
        is asked for its own before one is refused."""
        for name in self.members[0]:
            if name in self.settings:
                raise DataError(f"{self.path}: '{name}' is in 'Settings' and in 'Vary': give it once")
        known: Collection[str] = parameters()
        given = [(entry, name) for entry, names in (("Vary", self.members[0]), ("Settings", self.settings), ("Smooth twin", self.without_defect))
                 for name in names]
        if all(name in known for _, name in given):
            return
        with contextlib.suppress(Error, OSError):
            known = [*known, *(f"{section}/{name}" for section, entries in listing(program) for name, _, _ in entries)]
        for entry, name in given:
            if name not in known:
                raise DataError(f"{self.path}: '{entry}': {not_among(name, known)}")

    def must_name_figures(self, program: str) -> None:
        """@raises DataError naming a figure that no run leaves, which else would be found missing after all of them. Nothing is said where the
        program does not list what it writes."""
        known: dict[str, dict[str, str]] = {}
        with contextlib.suppress(Error, OSError, ValueError, KeyError, TypeError, subprocess.TimeoutExpired):
            listed = json.loads(must_end_well(execute(["columns"], program=program, timeout=30)).stdout)
            known = {table["file"]: {any_number(column["name"]): column["name"] for column in table["columns"]} for table in listed}
        for figure in self.figures:
            kind = re.fullmatch(r"(\w+)\((.+)\)", figure)
            if kind and kind[1] in ("dynamic", "frequency"):
                continue
            names = kind[2].split(":") if kind else [figure]
            table = names.pop(0) if len(names) > 1 else "history.csv" if kind else "summary.json"
            for name in names:
                if table in known and any_number(name) not in known[table] and not name.endswith("_half_space_uncertainty"):
                    close = min(known[table].values(), key=lambda other: edit_distance(name, other))
                    raise DataError(f"{self.path}: 'Figures': {table} has no '{name}'; did you mean '{close}'?")

    @staticmethod
    def count(path: str, entries: Mapping[str, str], name: str) -> int:
        if not re.fullmatch(r"[1-9]\d*", entries[name]):
            raise DataError(f"{path}: '{name}' cannot be '{entries[name]}'; allowed: 1, 2, ...")
        return int(entries[name])


def natural(text: str) -> int:
    """1, 2, ... of the command line."""
    if not re.fullmatch(r"[1-9]\d*", text):
        raise argparse.ArgumentTypeError(f"'{text}' must be 1, 2, ...")
    return int(text)


def any_number(name: str) -> str:
    """The name of a figure or column without the number of its wheel, support, cell or patch; what is compared with what is one name for all."""
    return re.sub(r"^reference/[^/]+/[^/]+/", "reference/#/#/", re.sub(r"(?<=[_/])\d+(?=[_/])", "#", name))


def figure_in(summary: Mapping[str, object], name: str) -> object:
    """What a key of summary.json has, with / between the names of sections and the numbers of lists, from 1; None: nothing."""
    value: object = summary
    for part in name.split("/"):
        if isinstance(value, list):
            value = value[int(part) - 1] if part.isdecimal() and 1 <= int(part) <= len(value) else None
        else:
            value = value.get(part) if isinstance(value, Mapping) else None
    return value


def split_together(text: str) -> tuple[str, ...]:
    """Names, or values, that & holds together."""
    return tuple(part.strip() for part in text.split("&"))


def number_or_text(value: str) -> float | str:
    """1 and 1.0 are the same."""
    try:
        return float(value)
    except ValueError:
        return value


def folder_name(values: Mapping[str, str]) -> str:
    """Of the values alone, so that a study that grows finds what it has: speed-100_depth-0.2."""
    last = [name.rpartition("/")[2] for name in values]
    parts = []
    for (name, value), short in zip(values.items(), last):
        text = (name if last.count(short) > 1 else short).partition(" (")[0] + "-" + value
        parts.append(re.sub(r"[^A-Za-z0-9.+-]+", "-", text).strip("-").lower())
    return "_".join(parts)


class Member(Run):
    """One run of a study."""

    def __init__(self, study: Study, root: str, name: str, settings: Mapping[str, str], program: str, options: Sequence[str] = (), command: str = "run",
                 table: str | os.PathLike | None = None):
        super().__init__(os.path.join(root, name))
        self.name, self.state = name, ""
        self.process: subprocess.Popen | None = None
        self.kept = False  # complete before this study began
        self.without_force = ""  # why there is no dynamic.json
        self.line = [*arguments_of(study.scene, settings, self.folder, command, table), *options]
        self.ranks, self.program = study.ranks, program
        self.scene, self.settings, self.options, self.command = study.scene, dict(settings), list(options), command
        self.table_path = scene_path(table) if table is not None else None
        self.input = self.present_input()

    def present_input(self) -> dict:
        """What decides about its results, with files as they are now."""
        known = input_of(self.scene, self.settings)
        if self.options:
            known["options"] = self.options
        if self.command != "run":
            known["command"] = self.command
        if self.table_path is not None:
            with open(self.table_path, encoding="utf-8") as stream:
                known["table"] = stream.read()
        return known

    def same_input(self) -> bool:
        try:
            with open(self.path("input.json"), encoding="utf-8") as stream:
                return json.load(stream) == self.input
        except (OSError, ValueError):
            return False

    def keep(self) -> bool:
        """Take its results if they are complete. @returns whether they are"""
        self.kept = self.same_input() and is_complete(self.folder)
        if self.kept:
            self.state = COMPLETE
        return self.kept

    def begin(self) -> None:
        """Start it, or let it go on from its checkpoint."""
        self.input = self.present_input()  # it may have waited for hours
        known = self.same_input()
        resume = known and self.has("checkpoint.last")
        os.makedirs(self.folder, exist_ok=True)
        for name in ("summary.json", "checkpoint.last"):
            if not known and self.has(name):
                os.remove(self.path(name))  # of other input: never to be taken for what this run does not come to
        with open(self.path("input.json"), "w", encoding="utf-8") as stream:
            json.dump(self.input, stream, indent=1)
        line = command(self.line + (["--resume"] if resume else []), self.ranks, self.program)
        print(f"{self.name}: {'goes on' if resume else 'begins'}", flush=True)
        with open(self.path("output.txt"), "a" if resume else "w", encoding="utf-8") as output:
            self.begun_at = output.tell()
            # A session of its own: Ctrl-C comes once, from here, and not from the terminal as well.
            self.process = subprocess.Popen(line, env=environment(), stdout=output, stderr=subprocess.STDOUT, start_new_session=True)

    def interrupt(self) -> None:
        """Ctrl-C for the ranks themselves: mpirun kills them a second after it has told them, too soon for a large checkpoint."""
        pids = [self.process.pid]
        if self.ranks > 1:
            with contextlib.suppress(OSError), open(f"/proc/{pids[0]}/task/{pids[0]}/children", encoding="ascii") as stream:
                pids = [int(pid) for pid in stream.read().split()] or pids
        for pid in pids:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGINT)

    def ended(self, stopped: bool = False) -> bool:
        """Whether it has ended; then its state says how. @param stopped by Ctrl-C, after which mpirun may end with 1"""
        if self.process is None:
            return True
        code = self.process.poll()
        if code is None:
            return False
        self.process = None
        with open(self.path("output.txt"), "rb") as stream:
            stream.seek(self.begun_at)
            said = own_line(stream.read().decode(errors="replace"))
        if is_complete(self.folder):
            self.state = COMPLETE
        elif code == 130 or stopped and not said:
            self.state = "interrupted"
        else:
            self.state = "failed: " + (said or f"exit code {code}, see {self.path('output.txt')}")
        print(f"{self.name}: {self.state}", flush=True)
        return True


# Each run with its smooth twin, if it has one.
Members = List[Tuple[Member, Optional[Member]]]


def run_all(runs: Sequence[Member], processes: int) -> None:
    """Every run that is not complete, so many at a time. @raises Interruption when all have ended with a checkpoint."""
    waiting, active = [run for run in runs if not run.keep()], []
    try:
        while waiting or active:
            active = [run for run in active if not run.ended()]
            while waiting and len(active) < processes:
                active.append(waiting.pop(0))
                active[-1].begin()
            time.sleep(0.05)
    except KeyboardInterrupt:
        for run in active:
            if run.process is not None:
                run.interrupt()
        try:
            while not all([run.ended(stopped=True) for run in active]):
                time.sleep(0.05)
        except KeyboardInterrupt:
            for run in active:
                if run.process is not None:
                    os.killpg(run.process.pid, signal.SIGKILL)
                    run.process.wait()
                    run.ended(stopped=True)
        raise Interruption from None


def add_dynamic_force(member: Member, twin: Member, stopped: bool) -> None:
    """dynamic.json of a member, unless it is newer than both runs. @param stopped by Ctrl-C: nothing more is computed"""
    if twin.state != COMPLETE:
        member.without_force = f"its smooth twin {twin.name} {twin.state or 'not begun'}"
        return
    result = member.path("dynamic.json")
    if os.path.exists(result) and os.path.getmtime(result) >= max(
            os.path.getmtime(run.path("summary.json")) for run in (member, twin)):
        return
    if stopped:
        member.without_force = "interrupted"
        return
    try:
        dynamic_force(member.folder, twin.folder, member.program)
    except ProgramError as error:
        member.without_force = str(error)


def figure_of(run: Member, figure: str) -> float:
    """A number. @raises DataError"""
    kind = re.fullmatch(r"(\w+)\((.+)\)", figure)
    if kind is None:
        value = figure_in(run.summary, figure)
        if not isinstance(value, (int, float)):
            raise DataError(f"{run.name}: summary.json has no figure '{figure}'")
        return float(value)
    if kind[1] in ("max", "min", "last", "at"):
        names = kind[2].split(":")
        table = names.pop(0) if len(names) > 1 else "history.csv"
        columns = run.table(table, names)
        column = columns[names[0]]
        of_kind: dict[str, Callable[[], float]] = {"max": column.max, "min": column.min, "last": lambda: column[-1],
                                                   "at": lambda: columns[names[1]][column.argmax()]}
        return float(of_kind[kind[1]]())
    if run.without_force:
        raise DataError(f"{run.name}: no '{figure}': {run.without_force}")
    with open(run.path("dynamic.json"), encoding="utf-8") as stream:
        force = json.load(stream)["forces"].get(kind[2])
    if force is None:
        raise DataError(f"{run.name}: dynamic.json has no force '{kind[2]}'")
    if kind[1] == "dynamic":
        return force["peak_N"]
    return force["oscillations"][0]["frequency_Hz"] if force["oscillations"] else float("nan")


def warnings_of(run: Member) -> list[str]:
    """What summary.json of a complete run warns of."""
    if run.state != COMPLETE:
        return []
    with contextlib.suppress(DataError, OSError):
        return [str(warning) for warning in run.summary.get("warnings", [])]
    return []


def figure_or_none(run: Member, figure: str) -> float | None:
    """Of a run that may not be complete."""
    try:
        return figure_of(run, figure) if run.state == COMPLETE else None
    except (DataError, OSError):
        return None


def report_limits(study: Study, root: str, members: Members) -> None:
    """limit.csv, and the same on the terminal."""
    table = []
    for limit in study.limits:
        heading, *rows = limit.rows([(values, figure_or_none(run, limit.figure), figure_or_none(twin, limit.figure) if twin else None)
                                     for values, (run, twin) in zip(study.members, members)])
        table += rows if table and table[0] == heading else [heading] + rows
    with open(os.path.join(root, "limit.csv"), "w", encoding="utf-8", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows(table)
    print(f"Table in {os.path.join(root, 'limit.csv')}")


def report_versions(runs: Sequence[Member], program: str) -> None:
    """A line about the results that another version of the program has left."""
    kept = [run for run in runs if run.kept]
    present = version_of(program) if kept else None
    others = [f"{run.name} ({run.summary.get('version', 'none')})" for run in kept if run.summary.get("version") != present]
    if present and others:
        print(f"{len(others)} of {len(runs)} runs, with smooth twins, were kept as other versions of the program than {present} made them: "
              + ", ".join(others))


def tabulate(study: Study, root: str, members: Members) -> bool:
    """study.csv, and the same on the terminal. @returns whether every run is complete and every figure was found."""
    rows, missing = [], []
    for values, (run, _) in zip(study.members, members):
        figures = []
        for figure in study.figures:
            try:
                figures.append(f"{figure_of(run, figure):.8g}" if run.state == COMPLETE else "")
            except DataError as error:
                figures.append("")
                missing.append(str(error))
        rows.append(list(values.values()) + figures + [str(len(warnings_of(run))) if run.state == COMPLETE else "", run.state or "not begun"])
    header = list(study.members[0]) + study.figures + ["warnings", "state"]
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([header] + rows)
    part = os.path.join(root, "study.csv.part")
    with open(part, "w", encoding="utf-8") as stream:
        stream.write(text.getvalue())
    with contextlib.suppress(FileNotFoundError):
        os.remove(os.path.join(root, "limit.csv"))  # which may be of other settings
    os.replace(part, os.path.join(root, "study.csv"))

    widths = [max(len(row[i]) for row in [header] + rows) for i in range(len(header) - 1)]
    print()
    for row in [header] + rows:
        print("  ".join([f"{cell:>{width}}" for cell, width in zip(row, widths)] + [row[-1]]))
    said = [f"{run.name}: WARNING: {warning}" for run in runs_of(members) for warning in warnings_of(run)]
    print("\n".join(["", *said]) if said else "")
    missing += [f"{twin.name}: {twin.state or 'not begun'}" for twin in twins_of(members) if twin.state != COMPLETE]
    print("\n".join([""] + missing) if missing else "")
    print(f"{sum(run.state == COMPLETE for run, _ in members)} of {len(members)} runs complete. Table in {os.path.join(root, 'study.csv')}")
    return not missing and all(run.state == COMPLETE for run, _ in members)


def members_of(study: Study, root: str, program: str, options: Sequence[str] = (), command: str = "run",
               table: str | os.PathLike | None = None) -> Members:
    """[(run, its smooth twin or None)] of a study in a folder."""
    members, twins = [], {}
    no_defect = study.without_defect.get("Defect/Shape") == "none"
    scene = own_parameters(study.scene)
    for values in study.members:
        left = {name: value for name, value in values.items() if name not in study.without_defect
                and not (no_defect and name.startswith("Defect/") and name != "Defect/Position (mm)")}
        name = "smooth-twin" + ("_" + folder_name(left) if left else "")
        if study.without_defect and name not in twins:
            settings = {**study.settings, **left, **study.without_defect}
            has = {**scene, **settings}
            # Where the defect would be is where stresses are recorded, and a length is also what the axle's inertia goes by.
            if number_or_text(has.get(LENGTH, "0")) == 0 and LENGTH in values:
                settings[LENGTH] = values[LENGTH]
            twins[name] = Member(study, root, name, settings, program, options, command, table)
        members.append((Member(study, root, folder_name(values), {**study.settings, **values}, program, options, command, table), twins.get(name)))
    return members


def runs_of(members: Members) -> list[Member]:
    """Every run once, smooth twins first: all others of a study are in vain if these cannot be."""
    return twins_of(members) + [run for run, _ in members]


def twins_of(members: Members) -> list[Member]:
    return list(dict.fromkeys(twin for _, twin in members if twin is not None))


def perform(study: Study, root: str, members: Members) -> bool:
    """Every run, and the tables. @returns whether every run is complete and every figure was found @raises Interruption"""
    os.makedirs(root, exist_ok=True)
    interruption = None
    try:
        run_all(runs_of(members), study.processes)
    except Interruption as error:
        interruption = error
    for member, twin in members:
        if twin is not None and member.state == COMPLETE:
            add_dynamic_force(member, twin, stopped=interruption is not None)
    good = tabulate(study, root, members)
    if study.limits:
        report_limits(study, root, members)
    report_versions(runs_of(members), members[0][0].program)
    if interruption:
        raise interruption
    return good


def study(scene: str | os.PathLike, vary: Mapping, *, figures: Sequence[str] = (), settings: Mapping[str, object] | None = None,
          command: str = "run", table: str | os.PathLike | None = None, combination: str = "product",
          smooth_twin: Mapping[str, object] | None = None, output: str | os.PathLike | None = None,
          processes: int = 1, ranks: int = 1, options: Sequence[str] = (), program: str = PROGRAM,
          show: bool = False) -> pandas.DataFrame | list[dict]:
    """Run a parameter variation of a scene, as contrib/study.py does from a file.

    scene        path of a parameter file, from the current folder or from prm/ of the source tree
    vary         {"Section/Name": values}, in the units that the names state; of parameters that vary together
                 {("Section/Name", "Section/Other"): [(value, other), ...]}
    figures      names as in 'Figures' of a study: of summary.json, max(...), dynamic(...); by default those that a file has
    settings     {"Section/Name": value} of all runs
    command      what the program does with the scene, and the table that it reads with it, as in run()
    combination  "product" of the values, or "zip": first with first, ...
    smooth_twin  {"Section/Name": value} that takes the defect away
    output       folder of the study, by default results/ and the name of the scene
    processes    runs at a time
    ranks        of each run
    options      more of the program's, such as ["--up-to", "1000"] of "modes"
    show         print what happens, and the table

    Returns a table with a row for each run: the varied values as given, the figures (nan where there is none), warnings, the number of those
    in its summary.json, state, which is "complete" or
    "failed: ...", and folder. It is a pandas DataFrame, or a list of dicts where pandas is not installed. study.csv in the folder is that of
    the command. Results that are complete are not computed again; an interrupted call goes on when it is repeated. Raises DataError, and
    KeyboardInterrupt after Ctrl-C, when all runs have a checkpoint.
    """
    where = "tread.study()"
    must_be_command(command, table)
    joined = lambda values: " | ".join(map(text_of, values))
    pairs = lambda given: joined(f"{name}={text_of(value)}" for name, value in (given or {}).items())
    lists = {(name,) if isinstance(name, str) else tuple(name): [value if not isinstance(name, str) else (value,) for value in values]
             for name, values in vary.items()}
    for name, values in lists.items():
        for text in map(text_of, itertools.chain(name, *values)):
            if not text.strip() or "|" in text or "&" in text:
                raise DataError(f"{where}: '{text}' cannot be varied; no text that is empty or has | or & in it")
    if not lists:
        raise DataError(f"{where}: vary names no parameter")
    scene = os.path.abspath(scene_path(scene))
    entries = {**DEFAULTS, "Scene": scene, "Settings": pairs(settings), "Combination": combination, "Smooth twin": pairs(smooth_twin),
               "Processes": str(processes), "Ranks": str(ranks), **({"Figures": joined(figures)} if figures else {})}
    asked = Study(where, entries, {" & ".join(name): joined(" & ".join(map(text_of, value)) for value in values) for name, values in lists.items()})
    for path, what in ((scene, "scene"), (program, "program; build it or name it with program="), *([(scene_path(table), "table")] if table is not None else [])):
        if not os.path.isfile(path):
            raise DataError(f"{path}: no such {what}")
    asked.must_name_parameters(program)
    asked.must_name_figures(program)
    root = os.fspath(output or os.path.join("results", os.path.splitext(os.path.basename(scene))[0]))
    members = members_of(asked, root, program, options, command, table)
    try:
        with contextlib.redirect_stdout(None) if not show else contextlib.nullcontext():
            perform(asked, root, members)
    except Interruption:
        raise KeyboardInterrupt from None
    rows = []
    chosen = itertools.product(*lists.values()) if combination == "product" else zip(*lists.values())
    for values, (run, _) in zip(chosen, members):
        row = {name: value for names, together in zip(lists, values) for name, value in zip(names, together)}
        for figure in asked.figures:
            try:
                row[figure] = figure_of(run, figure) if run.state == COMPLETE else float("nan")
            except DataError as error:
                row[figure] = float("nan")
                warnings.warn(str(error), stacklevel=2)
        rows.append({**row, "warnings": len(warnings_of(run)), "state": run.state, "folder": run.folder})
    for twin in twins_of(members):
        if twin.state != COMPLETE:
            warnings.warn(f"{twin.name}: {twin.state}", stacklevel=2)
    return frame_or_rows(rows)


def main() -> int:
    from .commands import command_parser  # which wants numpy

    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs ignore it
    signal.signal(signal.SIGTERM, lambda *_: signal.raise_signal(signal.SIGINT))
    parser = command_parser(__doc__)
    parser.add_argument("study", metavar="STUDY")
    parser.add_argument("--output", help="folder of the study, instead of 'Directory'")
    parser.add_argument("--processes", type=natural, help="runs at a time, instead of 'Processes'")
    parser.add_argument("--ranks", type=natural, help="of each run, instead of 'Ranks'")
    parser.add_argument("--program", default=PROGRAM, help="tread itself")
    parser.add_argument("--dry-run", action="store_true", help="list the runs and run nothing")
    arguments = parser.parse_args()
    asked = Study.of_file(arguments.study)
    for path, what in ((asked.scene, "scene"), (arguments.program, "program; build it or name it with --program")):
        if not os.path.isfile(path):
            raise DataError(f"{path}: no such {what}")
    asked.must_name_parameters(arguments.program)
    asked.must_name_figures(arguments.program)
    asked.processes, asked.ranks = arguments.processes or asked.processes, arguments.ranks or asked.ranks
    root = arguments.output or asked.directory
    members = members_of(asked, root, arguments.program)
    if arguments.dry_run:
        for run in runs_of(members):
            print(f"{run.name}: " + ", ".join(f"{name}={value}" for name, value in run.input["settings"].items()))
        return 0
    try:
        return 0 if perform(asked, root, members) else 1
    except Interruption:
        print("INTERRUPTED: the same command goes on")
        return 130


def command_line() -> None:
    """What contrib/study.py and tread-study do."""
    from .commands import run_command  # which wants numpy

    run_command(main)
