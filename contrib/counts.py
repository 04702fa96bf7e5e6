#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How large the house is: the largest classes and headers, lines, words of the manual, and what is compiled anew after a change of a header.

    counts.py [--at REVISION ...]

A table with a column for each revision (default: the last commit). Files are read from git, so that any state can be counted beside another. Classes are
those of include/; members are data, methods are functions of their own, and both are counted where the class is written down.
"""

from __future__ import annotations

import re
import subprocess
from collections import defaultdict
from collections.abc import Iterator

from tread.commands import command_parser, run_command
from tread.runs import ROOT


def git(*arguments: str) -> str:
    return subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, check=True, text=True).stdout


def files_at(revision: str) -> dict[str, str]:
    """Texts of all files of a revision that are counted, by their paths."""
    names = [name for name in git("ls-tree", "-r", "--name-only", revision).splitlines()
             if name.endswith((".cc", ".h", ".py", ".md")) and name.split("/")[0] in ("source", "include", "contrib", "tests", "benchmarks", "doc")]
    asked = "".join(f"{revision}:{name}\n" for name in names)
    answer = subprocess.run(["git", "-C", ROOT, "cat-file", "--batch"], input=asked.encode(), capture_output=True, check=True).stdout
    texts, at = {}, 0
    for name in names:
        end = answer.index(b"\n", at)
        size = int(answer[at:end].split()[-1])
        texts[name] = answer[end + 1:end + 1 + size].decode()
        at = end + size + 2
    return texts


def bare(text: str) -> str:
    """C++ without comments, texts, lines of the preprocessor and arguments of templates."""
    text = re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|^\s*#(?:\\\n|[^\n])*', " ", text, flags=re.DOTALL | re.MULTILINE)
    while (shorter := re.sub(r"(?<![<\s])<[^<>;{}]*>", "", text)) != text:
        text = shorter
    return text


def statements(body: str) -> Iterator[str]:
    """Those at the first level of a class, blocks left out."""
    words, depth = "", 0
    for sign in body:
        if sign == "{":
            depth += 1
        elif sign == "}":
            depth -= 1
            if depth == 0:
                words += "{}"
                if re.search(r"\)[^;=]*\{\}$", words) and not re.match(r"\s*(class|struct|enum|union)\b", words):
                    yield words  # the definition of a function, which no semicolon ends
                    words = ""
        elif sign == ";" and depth == 0:
            yield words
            words = ""
        elif depth == 0:
            words += sign


def classes(text: str) -> Iterator[tuple[str, int, int]]:
    """Name, members and methods of the classes of a header that have a body."""
    text = bare(text)
    for match in re.finditer(r"\b(?:class|struct)\s+(\w+)\s*(?:final\s*)?(?::[^;{]*)?\{", text):
        at, depth = match.end(), 1
        while depth > 0 and at < len(text):
            depth += {"{": 1, "}": -1}.get(text[at], 0)
            at += 1
        members = methods = 0
        for words in statements(text[match.end():at - 1]):
            words = re.sub(r"\b(public|private|protected)\s*:", "", words).strip()
            if re.match(r"(class|struct|enum|union|using|friend|static_assert|typedef|template\s*$)\b", words) or not words:
                continue
            if "(" in words.split("=")[0].split("{}")[0]:
                methods += 1
            else:
                members += 1 + words.split("{}")[0].count(",")
        yield match[1], members, methods


def compiled_with(texts: dict[str, str]) -> dict[str, int]:
    """For each header of include/ the number of files of source/ that include it, by others too."""
    included = {name: {path if path in texts else f"include/{path}" for path in re.findall(r'^#include [<"]([^>"]+)[>"]', text, re.MULTILINE)} & texts.keys() | {
        f"include/{path}" for path in re.findall(r"^#include <(tread/[^>]+)>", text, re.MULTILINE)} & texts.keys()
                for name, text in texts.items() if name.endswith((".cc", ".h"))}
    count: dict[str, int] = defaultdict(int)
    for name in included:
        if name.startswith("source/") and name.endswith(".cc"):
            seen, new = set(), {name}
            while new:
                seen |= new
                new = set().union(*(included[path] for path in new)) - seen
            for path in seen:
                count[path] += path.startswith("include/")
    return count


def counts(revision: str) -> dict[str, str]:
    texts = files_at(revision)
    lines = lambda end, *tops: sum(text.count("\n") for name, text in texts.items() if name.endswith(end) and name.split("/")[0] in tops)
    headers = {name: text for name, text in texts.items() if name.startswith("include/")}
    found = sorted(((members + methods, name, members, methods) for text in headers.values() for name, members, methods in classes(text)), reverse=True)
    longest = sorted(((text.count("\n"), name) for name, text in headers.items()), reverse=True)[:3]
    anew = compiled_with(texts)
    of = lambda *names: next((str(anew[path]) for path in (f"include/tread/{name}" for name in names) if path in anew), "-")
    manual = [text for name, text in texts.items() if re.fullmatch(r"doc/[^/]+\.md", name)]
    return {"lines of C++ in source and include": str(lines((".cc", ".h"), "source", "include")),
            "lines of tests": str(lines((".cc", ".h", ".py"), "tests")),
            "lines of Python outside of tests": str(lines(".py", "contrib", "benchmarks")),
            "words of the manual": str(sum(len(text.split()) for text in manual)),
            **{f"{('first', 'second', 'third', 'fourth', 'fifth')[k]} of the largest classes: members + methods": f"{name} {members} + {methods}"
               for k, (_, name, members, methods) in enumerate(found[:5])},
            "classes above 30 members or 40 methods": str(sum(members > 30 or methods > 40 for _, _, members, methods in found)),
            "longest headers, lines": ", ".join(f"{name.split('/')[-1]} {size}" for size, name in longest),
            "headers above 250 lines": str(sum(text.count("\n") > 250 for text in headers.values())),
            "lines that ask is_positioned()": str(sum(text.count("is_positioned()") for name, text in texts.items() if name.split("/")[0] in ("source", "include"))),
            "virtual functions": str(sum(len(re.findall(r"\bvirtual\b", bare(text))) for text in headers.values())),
            "std::regex in source": str(sum(text.count("std::regex_") for name, text in texts.items() if name.startswith("source/"))),
            "files compiled anew after a change of scene.h": of("scene/scene.h"),
            "... of mesh.h": of("mesh/mesh.h"), "... of explicit_dynamics.h": of("dynamics/explicit_dynamics.h"),
            "... of a section (wheel.h)": of("scene/sections/wheel.h"), "... of a part (supports.h)": of("dynamics/parts/supports.h"),
            "... of a recorder (history.h)": of("recorders/history.h", "simulation/recorders/history.h"), "... of summary_keys.h": of("output/summary_keys.h")}


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("--at", nargs="+", default=["HEAD"], metavar="REVISION")
    revisions = parser.parse_args().at
    columns = [counts(revision) for revision in revisions]
    print("| | " + " | ".join(git("rev-parse", "--short=8", revision).strip() for revision in revisions) + " |\n|---|" + "---|" * len(revisions))
    for row in columns[-1]:
        print(f"| {row} | " + " | ".join(column[row] for column in columns) + " |")


if __name__ == "__main__":
    run_command(main)
