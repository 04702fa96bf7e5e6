#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/scenes.md: every shipped scene and study: what it shows, how it is run, how long that takes, its pictures, and what half-space theory says of it.

Texts and times are those at the head of the parameter files. Figures are those of doc/scenes.csv, which --run asks the program for: those of scenes
that are new or whose parameters or profiles are no longer the ones the figures are of, with --all those of all scenes, which takes some minutes.
With --check the page is only compared; the exit code is 1 if it is not current, or if the figures are not.
"""

import csv
import glob
import hashlib
import io
import json
import os
import re
import sys
import tempfile

from tread.commands import command_parser, run_command
from tread.files import DataError, own_parameters, parameter_lines, read_summary
from tread.runs import PROGRAM, ROOT, ProgramError, arguments_of, execute, must_end_well
from tread.tables import first_difference, markdown, number

PRM = os.path.join(ROOT, "prm")
PAGE = os.path.join(ROOT, "doc", "scenes.md")
RECORD = os.path.join(ROOT, "doc", "scenes.csv")
HEAD = """# Scenes

What is shipped in `prm/`: each file begins with what this page says of it, and states only what differs from the defaults ([parameters](parameters.md)) and from
the file it is built on. Commands are written for an installed program; in the source tree it is `build/source/tread`.
`tread SCENE.prm --dry-run` says how large a scene is and how long it will take here, `tread reference` what half-space theory says of it, `-s "Section/Name=value"` changes it, and
`contrib/plot/plot-run.py FOLDER` draws what came. The tables have the half-space's figures: what a run should come near to where the bodies act as
half-spaces, steel does not yield and the rail is smooth. How near is on the page that is named. Creepage is that of the patch with the largest force where there
are several; of two wheels on one rail the figures are the first one's, of a wheelset with both wheels force and area are those of both. Times are the recorded ones.

This page is written by `contrib/scenes-page.py`.
"""
# (heading, name of the files, pages that show their results, picture of doc/pictures and what it shows, files that the scenes share: these
# scenes are then listed by a line each)
GROUPS = (
    ("First runs", "smooth-rolling.prm", ("verification.md",), None),
    ("Tutorials", "tutorial/*.prm", ("measured.md", "track.md", "geometry.md", "dent.md"),
     ("measured-contact-force.png", "The contact force at the squat of tutorial/measured.prm, beside the smooth twin")),
    ("Curves: wheelsets in any position", "curves/*.prm", ("kinematics.md", "curve.md"),
     ("two-patches.png", "curves/two-patches.prm: tread and gauge corner at once")),
    ("Crossings", "crossing/*.prm", ("crossing.md",),
     ("crossing-force.png", "crossing/uk-56E1-passage.prm at several speeds, beside a mass on the half-space's force at rest")),
    ("Joints: rails from a mesh file", "joint/*.prm", ("own-mesh.md",),
     ("joint-force.png", "joint/insulated-joint.prm: up and down the step, level with an end post, and without a joint, beside a mass on a Hertz spring on a beam")),
    ("Wheels that are not round", "flat/*.prm", ("wheel-flat.md",),
     ("wheel-flat-force.png", "flat/scanned-flat.prm at several speeds, beside a mass on a Hertz spring on a beam")),
    ("Test rigs", "rigs/*.prm", ("twin-disc.md",), None),
    ("What rolling does to the surfaces", "damage/*.prm", ("damage.md", "corrugation.md", "ratcheting.md"),
     ("damage.png", "damage/wear-passage.prm: work of friction, slip, temperature, wear and pressure by place")),
    ("Half-spaces: Kalker's case and its relatives", "verification/*.prm", ("verification.md", "track.md"),
     ("half-space-axis.png", "verification/half-space-0.33-mu0.30.prm: pressure, shear stress and micro-slip along the patch, beside Hertz and CONTACT")),
    ("Thesis, section 3.1: smooth rolling", "thesis/3.1-*.prm", ("verification.md",), None, "thesis/3.1-common.inc"),
    ("Thesis, section 3.2: steel that yields", "thesis/3.2-*.prm", ("plasticity.md",),
     ("plastic-patch.png", "thesis/3.2-1.3-mu0.30.prm beside its elastic twin: patch, pressure, shear stress and micro-slip"),
     "thesis/3.2-common.inc", "thesis/3.2-yielding.inc"),
    ("Thesis, chapter 4: squats on a track", "thesis/4.*.prm", ("squats.md", "axle-box.md", "sleeper.md", "modes.md"),
     ("squat-contact-force.png", "thesis/4.1-case1.prm, deeper: the contact force while the wheel crosses a squat")),
    ("Thesis, section 5.1: the critical size of a defect", "thesis/5.1-*.prm", ("critical-size.md",),
     ("critical-size.png", "studies/critical-size.study: the largest von Mises stress over the depth of the defect"), "thesis/5.1-common.inc"),
    ("Local time steps", "benchmarks/*.prm", ("performance.md",), None),
)
# Further pictures of doc/pictures: (picture, what it shows), by scene or study.
PICTURES = {
    "smooth-rolling.prm": (("s1002-patch.png", "the patch of an S1002 in the wheel's place"),),
    "tutorial/dip.prm": (("crossing-axis.png", "stress along the patch at a dip of 10 mm"), ("crossing-stress.png", "stress over the patch there"),
                         ("crossing-slip.png", "slip and adhesion there")),
    "tutorial/measured.prm": (("measured-dynamic-force.png", "dynamic forces and their spectra"),),
    "curves/klingel.prm": (("klingel.png", "the first quarter of Klingel's wave"),),
    "verification/half-space-0.33-mu0.30.prm": (("half-space-map.png", "adhesion and slip, beside CONTACT"), ("half-space-vectors.png", "shear stress and micro-slip")),
    "verification/p2-force.prm": (("p2-force.png", "the normal force behind the joint"),),
    "thesis/3.2-1.3-mu0.30.prm": (("plastic-material.png", "settlement, plastic strain and von Mises stress"),),
    "thesis/4.1-case1.prm": (("squat-dynamic-force.png", "dynamic forces and their spectra"), ("axle-box-case1.png", "acceleration of the axle box, at 110 km/h")),
    "thesis/4.1-case2.prm": (("squat-weld.png", "normal force, largest pressure and area of the patch"),),
    "thesis/4.2-axle-box.prm": (("axle-box.png", "acceleration of the axle box and its wavelet spectrum"),),
    "thesis/4.3-M1.prm": (("modes-M1.png", "receptances of rail and wheel"), ("sleeper-stress.png", "stress in the sleeper")),
    "studies/critical-size-fine.study": (("critical-size-fine.png", "largest von Mises stress over depth, cells of 0.28 mm"),),
}
STUDIES = "studies/*.study"
FIGURES = ("load, kN", "traction coefficient", "creepage, 1e-3", "largest pressure, MPa", "area, mm2", "cells", "steps")
HEADER = ("scene", *FIGURES, "time")


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
    """How it is run: what its head says, or the program on two ranks, with results in a folder of its own: the program refuses one that has those of another scene."""
    with open(path, encoding="utf-8") as stream:
        found = re.search(r"^#   ((?:mpirun|tread|contrib/)\S* .*)$", stream.read(), re.MULTILINE)
    command = found[1].split("  ")[0].strip() if found else f"mpirun -np 2 tread prm/{name}"
    own = command.startswith("contrib/") or "--output" in command
    return command if own else f"{command} --output results/{os.path.splitext(os.path.basename(name))[0]}"


def included(name):
    """The files that a file of prm/ includes, also of prm/."""
    with open(os.path.join(PRM, name), encoding="utf-8") as stream:
        return [os.path.normpath(os.path.join(os.path.dirname(name), other)) for _, kind, other, _ in parameter_lines(stream) if kind == "include"]


def time_of(name):
    """How long it takes, as the head of the file says, or of what it shares with others."""
    said = dict(comment(os.path.join(PRM, name))[1])
    if "Cost" in said:
        return said["Cost"].split(": ")[-1]
    found = re.search(r"(?:^|; )([^;]*\b(?:s|seconds?|minutes?)\b[^;]*)$", said.get("Size", ""))
    if found:
        return found[1].strip()
    return next((time_of(other) for other in included(name) if other.endswith(".inc")), "-")


def input_of(name):
    """A digest of what a scene's figures follow from: its parameters, and the profiles they name. Titles and what is written do not matter."""
    path = os.path.join(PRM, name)
    own = {key: value for key, value in own_parameters(path).items() if key != "Scene/Title" and not key.startswith("Output/")}
    digest = hashlib.sha256(json.dumps(own, sort_keys=True).encode())
    for value in sorted(set(own.values())):
        profile = os.path.join(os.path.dirname(path), value)
        if value and os.path.isfile(profile):
            with open(profile, "rb") as stream:
                digest.update(stream.read())
    return digest.hexdigest()[:8]


def figures(name, program):
    """{name of FIGURES: cell} of a scene, by the program."""
    size = ["-", "-"]
    if "tread reference" not in command_of(os.path.join(PRM, name), name):
        whole = must_end_well(execute([*arguments_of(os.path.join(PRM, name)), "--dry-run"], program=program)).stdout
        size = [re.search(rf"^{what} +(\d+)", whole, re.MULTILINE)[1] for what in ("cells", "steps")]
    with tempfile.TemporaryDirectory() as folder:
        try:
            must_end_well(execute(["reference", *arguments_of(os.path.join(PRM, name), output=folder)], program=program))
        except ProgramError as error:
            if "no half-space answer" not in str(error):  # a line contact has none
                raise
            return dict(zip(FIGURES, [*5 * ["-"], *size]))
        summary = read_summary(folder)
    load = summary["normal_force_N"]
    patch = max(summary.get("patches", [summary]), key=lambda patch: patch["normal_force_N"])
    cells = (number(1e-3 * load), f"{round(summary['longitudinal_force_N'] / load, 3) + 0.:.3f}", f"{round(1e3 * patch['creepage'], 2) + 0.:.2f}",
             number(1e-6 * summary["max_pressure_Pa"]), number(1e6 * summary["patch_area_m2"]), *size)
    return dict(zip(FIGURES, cells))


def recorded():
    """{scene: {name of FIGURES, and "input": cell}}"""
    if not os.path.exists(RECORD):
        return {}
    with open(RECORD, encoding="utf-8", newline="") as stream:
        return {row.pop("scene"): row for row in csv.DictReader(stream)}


def record(rows):
    text = io.StringIO()
    writer = csv.DictWriter(text, ("scene", "input", *FIGURES), lineterminator="\n")
    writer.writeheader()
    writer.writerows({"scene": name, **rows[name]} for name in sorted(rows))
    with open(RECORD, "w", encoding="utf-8") as stream:
        stream.write(text.getvalue())


def link(name):
    return f"[`{name}`](../prm/{name})"


def pictures_of(name):
    return [f"[{what}](pictures/{picture})" for picture, what in PICTURES.get(name, ())]


def described(name, command=True):
    """What a file is, how it is run, and the list at its head."""
    path = os.path.join(PRM, name)
    what, entries = comment(path)
    text = f"**{link(name)}** {what}\n\n" + (f"    {command_of(path, name)}\n\n" if command else "")
    lines = [f"- {word}: {said}" for word, said in entries if word not in ("Compare", "Source", "Reference", "Files")]
    if name.endswith(".prm"):
        lines += [f"- Built on: {link(other)}" for other in included(name)]
    if pictures_of(name):
        lines.append("- Pictures: " + ", ".join(pictures_of(name)))
    return text + "\n".join(lines) + ("\n\n" if lines else "")


def line(name):
    return f"- {link(name)}: {comment(os.path.join(PRM, name))[0]}" + "".join(f" See {picture}." for picture in pictures_of(name)) + "\n"


def names_of(pattern):
    found = sorted(os.path.relpath(path, PRM) for path in glob.glob(os.path.join(PRM, pattern)))
    if not found:
        raise DataError(f"no file {pattern} in prm/")
    return found


def groups():
    """The groups with the names of their scenes. @raises DataError for scenes without one"""
    found = [(names_of(group[1]), group) for group in GROUPS]
    shipped = {os.path.relpath(path, PRM) for path in glob.glob(os.path.join(PRM, "**/*.prm"), recursive=True)}
    without = shipped - {name for names, _ in found for name in names}
    if without:
        raise DataError(f"scenes without a group in contrib/scenes-page.py: {', '.join(sorted(without))}")
    strangers = {name for name in PICTURES if not os.path.exists(os.path.join(PRM, name))}
    if strangers:
        raise DataError(f"pictures of scenes that are not there in contrib/scenes-page.py: {', '.join(sorted(strangers))}")
    return found


def page(rows):
    """@param rows as of recorded()"""
    text = HEAD
    for names, (heading, _, pages, picture, *shared) in groups():
        text += f"\n## {heading}\n\nResults: " + ", ".join(f"[{os.path.splitext(p)[0].replace('-', ' ')}]({p})" for p in pages) + ".\n\n"
        text += "".join(described(name, command=False) for name in shared)
        text += "".join(map(line, names)) + f"\n    {command_of(os.path.join(PRM, names[0]), names[0])}\n\nand so with the others.\n\n" if shared else "".join(map(described, names))
        text += markdown(HEADER, [[f"`{name}`", *(rows.get(name, {}).get(figure, "-") for figure in FIGURES), time_of(name)] for name in names]) + "\n"
        if picture:
            text += f"\n![{picture[1]}](pictures/{picture[0]})\n\n{picture[1]}.\n"
    text += "\n## Studies: many runs by one command\n\n" + "".join(map(described, names_of(STUDIES)))
    return text.rstrip() + "\n"


def main():
    parser = command_parser(__doc__)
    parser.add_argument("--run", action="store_true", help="ask the program for the figures that are missing or not current")
    parser.add_argument("--all", action="store_true", help="with --run: for all figures")
    parser.add_argument("--program", default=PROGRAM, help="the program to ask")
    parser.add_argument("--check", action="store_true", help="write nothing")
    arguments = parser.parse_args()
    rows, inputs = recorded(), {name: input_of(name) for names, _ in groups() for name in names}
    if arguments.run and not arguments.check:
        rows = {name: row for name, row in rows.items() if name in inputs}
        for name, digest in inputs.items():
            if arguments.all or rows.get(name, {}).get("input") != digest:
                print(name, flush=True)
                rows[name] = {"input": digest, **figures(name, arguments.program)}
                record(rows)
        record(rows)
    old = [name for name, digest in inputs.items() if rows.get(name, {}).get("input") != digest] + sorted(set(rows) - set(inputs))
    current = page(rows)
    if arguments.check:
        with open(PAGE, encoding="utf-8") as stream:
            different = first_difference(stream.read(), current)
    else:
        with open(PAGE, "w", encoding="utf-8") as stream:
            stream.write(current)
        different = None
    if old:
        sys.exit(f"doc/scenes.csv: figures that are missing, or of other parameters: {', '.join(old)}: run contrib/scenes-page.py --run")
    if different:
        sys.exit(f"doc/scenes.md is not current from line {different} on: run contrib/scenes-page.py")
    return 0


if __name__ == "__main__":
    run_command(main)
