# SPDX-License-Identifier: LGPL-2.1-or-later
"""A JSON schema of all parameters of a scene, and parameter files checked against it.

The program writes it (tread parameters --schema). It describes a scene as {"Section": {"Name": value}}: numbers in the units that the
names state, lists as arrays. It lies beside this file and needs no program.
"""

from __future__ import annotations

import functools
import json
import math
import os
import re
from collections.abc import Iterable, Iterator

from .files import DataError, parameter_lines
from .runs import PROGRAM, execute, must_end_well

PATH = os.path.join(os.path.dirname(os.path.realpath(__file__)), "parameters.schema.json")


def sections(listing: str) -> list[tuple[str, list[tuple[str, str, str]]]]:
    """[(section, [(name, default, meaning)])] of what `tread parameters` prints."""
    found, meaning = [], []
    for line in listing.splitlines():
        line = line.strip()
        if line.startswith("subsection "):
            found.append((line[len("subsection "):], []))
        elif found and line.startswith("#"):
            meaning.append(line.lstrip("# "))
        elif line.startswith("set "):
            name, _, default = line[len("set "):].partition("=")
            found[-1][1].append((name.strip(), default.strip(), " ".join(meaning)))
            meaning = []
    return found


def listing(program: str = PROGRAM) -> list[tuple[str, list[tuple[str, str, str]]]]:
    """sections() of a program."""
    return sections(must_end_well(execute(["parameters"], program=program)).stdout)


def plain(value: float) -> float | int:
    """Whole numbers without a point."""
    return int(value) if value == int(value) and abs(value) < 1e15 else value


def of_program(program: str = PROGRAM) -> dict:
    """The schema that a program writes."""
    return json.loads(must_end_well(execute(["parameters", "--schema"], program=program)).stdout)


@functools.lru_cache(maxsize=None)
def shipped() -> dict:
    """The schema beside this file. @raises DataError"""
    try:
        with open(PATH, encoding="utf-8") as stream:
            return json.load(stream)
    except OSError as error:
        raise DataError(f"{PATH}: {error.strerror}") from None


def parameters(schema: dict | None = None) -> dict[str, dict]:
    """{"Section/Name": schema} of all parameters."""
    return {f"{section}/{name}": entry for section, group in (schema or shipped())["properties"].items()
            for name, entry in group["properties"].items()}


def value_of(text: str, schema: dict) -> object:
    """The text of a parameter file as the schema has it. What is not of its type is left as text."""
    if "anyOf" in schema:
        return next((value for value in (value_of(text, part) for part in schema["anyOf"]) if not isinstance(value, str)), text)
    kind = schema.get("type")
    if kind == "array":
        return [value_of(part.strip(), schema["items"]) for part in text.split(",")] if text else []
    if kind == "boolean":
        return {"true": True, "false": False}.get(text, text)
    if kind in ("number", "integer"):
        try:
            value = float(text)
        except ValueError:
            return text
        if not math.isfinite(value) or "_" in text or (kind == "integer" and not re.fullmatch(r"[+-]?\d+", text)):
            return text
        return plain(value)
    return text


def allowed(schema: dict) -> str:
    """What a schema allows, in words."""
    if "anyOf" in schema:
        return " or ".join(map(allowed, schema["anyOf"]))
    if "const" in schema or "enum" in schema:
        return " or ".join(f"'{value}'" for value in schema.get("enum", [schema.get("const")]))
    if schema["type"] == "array":
        return f"{schema.get('minItems', 0)} to {schema['maxItems']} of {allowed(schema['items'])}, separated by commas"
    if schema["type"] == "boolean":
        return "true or false"
    if schema["type"] == "string":
        return schema.get("$comment", "any text")
    word = "a whole number" if schema["type"] == "integer" else "a number"
    low, high = schema.get("minimum"), schema.get("maximum")
    if low is None and high is None:
        return word
    return f"{word}, {low} to {high}" if None not in (low, high) else f"{word}, {low} or more" if high is None else f"{word}, at most {high}"


def fits(value: object, schema: dict) -> bool:
    """Whether a value is one that the schema allows: type, enum, const, anyOf, minimum, maximum, items, minItems, maxItems, pattern."""
    if "anyOf" in schema:
        return any(fits(value, part) for part in schema["anyOf"])
    if "enum" in schema or "const" in schema:
        return value in schema.get("enum", [schema.get("const")])
    kind = schema["type"]
    if kind == "array":
        return (isinstance(value, list) and schema.get("minItems", 0) <= len(value) <= schema["maxItems"]
                and all(fits(part, schema["items"]) for part in value))
    if kind == "boolean":
        return isinstance(value, bool)
    if kind == "string":
        return isinstance(value, str) and re.search(schema.get("pattern", ""), value) is not None
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return (number and (kind == "number" or isinstance(value, int))
            and schema.get("minimum", -math.inf) <= value <= schema.get("maximum", math.inf))


def scene_errors(path: str, schema: dict | None = None, depth: int = 0) -> Iterator[tuple[str, int, str]]:
    """(file, line, what is wrong) of a parameter file and of those that it includes."""
    known = parameters(schema)
    try:
        with open(path, encoding="utf-8") as stream:
            lines = stream.read().split("\n")
    except (OSError, UnicodeDecodeError) as error:
        yield path, 1, getattr(error, "strerror", None) or "is not text"
        return
    last, opened, first_lines = 0, [], {}
    for number, kind, name, text in parameter_lines(lines):
        last = number
        if kind is None:
            yield path, number, f"'{text}' is neither 'set NAME = VALUE' nor subsection, end or include"
        elif kind == "include":
            if depth == 10:
                yield path, number, "is included by files that it includes"
                return
            yield from scene_errors(os.path.join(os.path.dirname(path), name), schema, depth + 1)
        elif kind == "subsection":
            opened.append(number)
        elif kind == "end":
            opened.pop()
        elif name not in known:
            yield path, number, not_among(name, known)
        elif first_lines.setdefault(name, number) != number:
            yield path, number, f"'{name}' is set in line {first_lines[name]} already: leave one of the two lines out"
        elif not fits(value_of(text, known[name]), known[name]):
            yield path, number, f"'{name}' cannot be '{text}'; allowed: {allowed(known[name])}"
    if opened:
        yield path, last, f"the subsection of line {opened[-1]} has no end"


def not_among(name: str, known: Iterable[str]) -> str:
    """What is said of a parameter that there is not, with the one that was most likely meant, as the program finds it: source/scene/parameter_file.cc."""
    own, bare = name_in_section(name), name.partition(" (")[0]
    # The right name in another section is the likeliest slip.
    close = min(known, key=lambda path: min(edit_distance(name, path), edit_distance(bare, path.partition(" (")[0]) + 1,
                                            edit_distance(own, name_in_section(path)) + 1))
    return f"no parameter '{name}'; did you mean '{close}'?"


def name_in_section(path: str) -> str:
    """A unit may have a / too."""
    name, bracket, unit = path.partition("(")
    return name.rpartition("/")[2] + bracket + unit


def edit_distance(a: str, b: str) -> int:
    """How many letters are put in, left out or exchanged (Levenshtein), large ones being small ones."""
    a, b = a.lower(), b.lower()
    row = list(range(len(b) + 1))
    for i, letter in enumerate(a, 1):
        diagonal, row[0] = row[0], i
        for j, other in enumerate(b, 1):
            diagonal, row[j] = row[j], min(row[j - 1] + 1, row[j] + 1, diagonal + (letter != other))
    return row[-1]


def check_scenes() -> int:
    from .commands import command_parser

    parser = command_parser("""Check parameter files without the program, for editors: FILE:LINE: what is wrong, such as an unknown parameter or a value out of range.

Files that a scene includes are checked too. What only the program can tell, such as a mesh that does not fit, it says with --dry-run.
The exit code is 1 if anything is wrong.
""")
    parser.add_argument("scenes", metavar="SCENE.prm", nargs="+")
    wrong = False
    for scene in parser.parse_args().scenes:
        for file, line, what in scene_errors(scene):
            print(f"{file}:{line}: {what}")
            wrong = True
    return 1 if wrong else 0


def command_line() -> None:
    """What contrib/check-scene.py and tread-check-scene do."""
    from .commands import run_command

    run_command(check_scenes)
