#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/scenes.md: every shipped scene and study: what it shows, how it is run, and what half-space theory says of it.

Texts are those at the head of the parameter files. Figures stay as the page has them unless --run asks the program for them anew, which takes some
minutes. With --check the page is only compared; the exit code is 1 if it is not current.
"""

import glob
import os
import re
import sys
import tempfile

from tread.commands import command_parser, run_command
from tread.files import read_summary
from tread.runs import ROOT, arguments_of, execute, must_end_well, parameters_of
from tread.tables import markdown, number

PAGE = os.path.join(ROOT, "doc", "scenes.md")
HEAD = """# Scenes

What is shipped in `prm/`: each file begins with what this page says of it, and states only what differs from the defaults ([parameters](parameters.md)).
`tread SCENE.prm --dry-run` says how large a scene is before it runs, `--reference-only` what half-space theory says of it, `-s "Section/Name=value"` changes it, and
`contrib/plot/plot-run.py FOLDER` draws what came. The tables have the half-space's figures: what a run should come near to where the bodies act as
half-spaces, steel does not yield and the rail is smooth. How near is on the page that is named.

This page is written by `contrib/scenes-page.py`.
"""
# (heading, name of the files, pages that show their results, pictures of doc/pictures and what they show, what the files share: these are then
# listed by a line each)
GROUPS = (
    ("First runs", "smooth-rolling.prm", ("verification.md",), (("half-space-map.png", "Pressure and shear on Kalker's case, beside CONTACT"),)),
    ("Tutorials", "tutorial/*.prm", ("measured.md", "track.md", "geometry.md"),
     (("measured-contact-force.png", "The contact force at the squat of tutorial/measured.prm"),)),
    ("Curves: wheelsets in any position", "curves/*.prm", ("kinematics.md", "curve.md"),
     (("two-patches.png", "curves/two-patches.prm: tread and gauge corner at once"), ("klingel.png", "curves/klingel.prm: the first quarter of Klingel's wave"))),
    ("Half-spaces: Kalker's case and its relatives", "verification/*.prm", ("verification.md", "track.md"),
     (("half-space-axis.png", "Pressure and shear along the middle of the patch, beside CONTACT"), ("p2-force.png", "verification/p2-force.prm: the wheel lands behind the joint"))),
    ("Thesis, section 3.1: smooth rolling", "thesis/3.1-*.prm", ("verification.md",), (), "thesis/3.1-common.inc"),
    ("Thesis, section 3.2: steel that yields", "thesis/3.2-*.prm", ("plasticity.md",), (("plastic-patch.png", "The patch on steel that yields"),), "thesis/3.2-common.inc"),
    ("Thesis, chapter 4: squats on a track", "thesis/4.*.prm", ("squats.md", "axle-box.md", "crossing.md"),
     (("squat-contact-force.png", "The contact force while the wheel crosses a squat"),)),
    ("Thesis, section 5.1: the critical size of a defect", "thesis/5.1-*.prm", ("critical-size.md",),
     (("critical-size.png", "The largest stress over the length of the defect"),), "thesis/5.1-common.inc"),
    ("Local time steps", "benchmarks/*.prm", ("performance.md",), ()),
)
STUDIES = "studies/*.study"
HEADER = ("scene", "load, kN", "traction coefficient", "largest pressure, MPa", "area, mm2", "cells", "steps")


def comment(path):
    """(paragraph that says what it is, [(word, text)] of the list below it) at the head of a file."""
    lines = []
    with open(path, encoding="utf-8") as stream:
        for line in stream:
            if not line.startswith("#"):
                break
            lines.append(line[1:].rstrip())
    first, entries = [], []
    for line in lines[:next((i for i, line in enumerate(lines) if not line.strip()), len(lines))]:
        first.append(line.strip())
    for line in lines[len(first) + 1:]:
        found = re.match(r" ([A-Z][\w-]*(?: \w+)?)(?::|  +)\s*(\S.*)$", line)
        if found and (found[1] == "Half-space" or "  " in line[1:].strip()):
            entries.append([found[1], found[2]])
        elif entries and line.startswith("   ") and not line.startswith("   mpirun"):
            entries[-1][1] += " " + line.strip()
    return " ".join(first), entries


def command_of(path, name):
    """How it is run: what its head says, or the program on two ranks."""
    with open(path, encoding="utf-8") as stream:
        found = re.search(r"^#   ((?:mpirun|tread|contrib/)\S* .*)$", stream.read(), re.MULTILINE)
    return found[1].split("  ")[0].strip() if found else f"mpirun -np 2 tread prm/{name}"


def figures(name):
    """The cells of a scene's row but for the first one, by the program."""
    settings = parameters_of(name)
    whole = must_end_well(execute([*arguments_of(name), "--dry-run"])).stdout if settings["Mesh/Finest cell (mm)"] else ""
    size = [(re.search(rf"^{what} +(\d+)", whole, re.MULTILINE) or [None, "-"])[1] for what in ("cells", "steps")]
    with tempfile.TemporaryDirectory() as folder:
        must_end_well(execute([*arguments_of(name, output=folder), "--reference-only"]))
        summary = read_summary(folder)
    half = summary.get("half_space", summary)
    load = summary["normal_force_N"]
    return [number(1e-3 * load), f"{round(summary['longitudinal_force_N'] / load, 3) + 0.:.3f}", number(1e-6 * half["max_pressure_Pa"]),
            number(1e6 * summary["patch_area_m2"]), *size]


def described(name, command=True):
    """What a file is, how it is run, and the list at its head."""
    path = os.path.join(ROOT, "prm", name)
    what, entries = comment(path)
    text = f"**[`{name}`](../prm/{name})** {what}\n\n" + (f"    {command_of(path, name)}\n\n" if command else "")
    lines = [f"- {word}: {said}" for word, said in entries if word not in ("Compare", "Source", "Reference", "Files")]
    return text + "\n".join(lines) + ("\n\n" if lines else "")


def line(name):
    path = os.path.join(ROOT, "prm", name)
    return f"- [`{name}`](../prm/{name}): {comment(path)[0]}\n"


def names_of(pattern):
    found = sorted(os.path.relpath(path, os.path.join(ROOT, "prm")) for path in glob.glob(os.path.join(ROOT, "prm", pattern)))
    if not found:
        raise ValueError(f"no file {pattern} in prm/")
    return found


def page(rows):
    """@param rows {scene: [cell]}"""
    text, listed = HEAD, set()
    for heading, pattern, pages, pictures, *shared in GROUPS:
        names = names_of(pattern)
        listed.update(names)
        text += f"\n## {heading}\n\nResults: " + ", ".join(f"[{os.path.splitext(p)[0].replace('-', ' ')}]({p})" for p in pages) + ".\n\n"
        text += "".join(described(name, command=False) for name in shared)
        text += "".join(map(line, names)) + f"\n    mpirun -np 2 tread prm/{names[0]}\n\n" if shared else "".join(map(described, names))
        text += markdown(HEADER, [[f"`{name}`", *rows.get(name, ["-"] * (len(HEADER) - 1))] for name in names]) + "\n"
        text += "".join(f"\n![{what}](pictures/{picture})\n\n{what}.\n" for picture, what in pictures)
    text += "\n## Studies: many runs by one command\n\n" + "".join(map(described, names_of(STUDIES)))
    shipped = set(os.path.relpath(path, os.path.join(ROOT, "prm")) for path in glob.glob(os.path.join(ROOT, "prm/**/*.prm"), recursive=True))
    if shipped != listed:
        raise ValueError(f"scenes without a group in contrib/scenes-page.py: {', '.join(sorted(shipped - listed))}")
    return text.rstrip() + "\n"


def rows_on(text):
    """{scene: [cell]} of the page as it is."""
    rows = (line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith("| `"))
    return {row[0].strip("`"): row[1:] for row in rows if len(row) == len(HEADER)}


def main():
    parser = command_parser(__doc__)
    parser.add_argument("--run", action="store_true", help="ask the program for the figures")
    parser.add_argument("--check", action="store_true", help="write nothing")
    arguments = parser.parse_args()
    kept = ""
    if os.path.exists(PAGE):
        with open(PAGE, encoding="utf-8") as stream:
            kept = stream.read()
    rows = rows_on(kept)
    if arguments.run:
        rows = {name: figures(name) for _, pattern, *_ in GROUPS for name in names_of(pattern)}
    current = page(rows)
    if not arguments.check:
        with open(PAGE, "w", encoding="utf-8") as stream:
            stream.write(current)
        return 0
    if kept == current and all(name in rows for _, pattern, *_ in GROUPS for name in names_of(pattern)):
        return 0
    sys.exit("doc/scenes.md is not current: run contrib/scenes-page.py, with --run for scenes without figures")


if __name__ == "__main__":
    run_command(main)
