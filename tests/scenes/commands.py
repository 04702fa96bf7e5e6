#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands of the program: each does what its older form does, byte by byte, and words that do not belong to it are refused."""

import os
import re
import sys
import tempfile

from tread.runs import ROOT, execute
from tread_runner import Check

from loaded_once import execute_often

program = sys.argv[1]
check = Check()
SCENE, CURVE = (os.path.join(ROOT, "prm", name) for name in ("smooth-rolling.prm", "curves/manchester-a22-right.prm"))
CASES = "A_per_m,B_per_m,normal_force_N,friction,young_Pa,poisson,creepage,lateral_creepage,spin_per_m\n1.087,1.667,1e5,0.3,210e9,0.3,-0.001,0,0\n"
PLACES = "rail,wheel,s_mm,y_ws_mm,load_N,element_x_mm,element_y_mm\n" + os.path.join(ROOT, "contrib/contact-data/crossing_uk56E1.csv") + ",S1002,239,0,10000,0.4,0.4\n"


def without_times(text):
    """What was printed, without names of files and what took how long."""
    return re.sub(r"(?m)^.*(finished in|Results in|results/|wall|rate|memory| s |folder).*$", "", re.sub(r"\S*/(old|new)\S*", "", text))


def without_names(content):
    """A file, without the folder that it names and the seconds that it records."""
    return re.sub(rb"(old|new)-\d+", b"", re.sub(rb'("\w*(wall|_s|seconds|started|memory)\w*": )[^,\n]*|set Directory.*|(?i:generated|written) [^>]*', rb"\1", content))


with tempfile.TemporaryDirectory() as folder:
    def path(*names):
        return os.path.join(folder, *names)

    for name, text in (("cases.csv", CASES), ("places.csv", PLACES)):
        with open(path(name), "w", encoding="utf-8") as stream:
            stream.write(text)

    def alike(what, new, old, output=True, status=0):
        """The results of both forms."""
        ended = []
        for form, words in (("new", new), ("old", old)):
            written = path(f"{form}-{len(os.listdir(folder))}")
            ended.append((execute_often([*words, *(["--output", written] if output else [])], program), written))
        (own, own_files), (other, other_files) = ended
        if not check.that(f"{what}: both end with {status}", own.returncode == other.returncode == status):
            print(own.stderr, other.stderr)
        check.that(f"{what}: the same on the screen", without_times(own.stdout) == without_times(other.stdout) and (bool(own.stdout) or status != 0))
        if not output:
            return
        names = [sorted(os.listdir(files)) if os.path.isdir(files) else [""] for files in (own_files, other_files)]
        check.that(f"{what}: the same files", names[0] == names[1])
        for name in names[0]:
            contents = []
            for files in (own_files, other_files):
                with open(os.path.join(files, name) if name else files, "rb") as stream:
                    contents.append(without_names(stream.read()))
            if not name.endswith((".h5", ".vtu")):
                check.that(f"{what}: the same {name or 'table'}", contents[0] == contents[1] and len(contents[0]) > 50)

    alike("reference", ["reference", SCENE, "-s", "Motion/Creepage=0.002"], ["--reference-only", SCENE, "-s", "Motion/Creepage=0.002"])
    alike("contact points", ["contact-points", CURVE, "--shift-to", "2", "--shift-step", "1"], [CURVE, "--contact-points", "--shift-to", "2", "--shift-step", "1"])
    alike("batch", ["batch", path("cases.csv")], ["--batch", path("cases.csv")])
    alike("positions", ["positions", path("places.csv")], ["--positions", path("places.csv")])
    alike("parameters", ["parameters", SCENE, "-s", "Motion/Creepage=0.002"], [SCENE, "--print-parameters", "-s", "Motion/Creepage=0.002"], output=False)
    alike("parameters as JSON", ["parameters", "--json"], ["--print-parameters=json"], output=False)
    alike("columns", ["columns"], ["--print-columns"], output=False)
    size = ["-s", "Mesh/Finest cell (mm)=2", "--dry-run"]
    sizes = [execute_often([*words, SCENE, *size], program).stdout for words in (["run"], [])]
    check.that("run --dry-run: as many cells", len({re.search(r"cells\D+(\d+)", text)[1] for text in sizes}) == 1)

    def refused(what, words, *said):
        result = execute_often(words, program)
        if not check.that(f"{what}: refused in one line", result.returncode == 1 and result.stderr.count("\n") == 1 and all(word in result.stderr for word in said)):
            print(result.returncode, result.stdout[-300:], result.stderr)

    refused("a command without its scene", ["run"], "SCENE.prm is required", "tread run --help")
    refused("an option of another command", ["run", SCENE, "--up-to", "300"], "--up-to", "tread run --help")
    refused("an option before the command", ["-s", "Motion/Creepage=0", "run", SCENE], "-s stands before the command 'run'")
    refused("a scene before the command", [SCENE, "reference"], "smooth-rolling.prm' stands before the command 'reference'", "a command comes first")
    refused("an option before a command that lacks its scene", ["-s", "Motion/Creepage=0", "run"], "-s stands before the command 'run'")
    refused("a scene before a command without one", [SCENE, "columns"], "a command comes first, tread columns")
    refused("an older form with a command", ["run", SCENE, "--modes"], "--modes", "tread run --help")
    refused("two commands", ["run", SCENE, "reference"], "reference")
    refused("to resume what is estimated", ["run", SCENE, "--resume", "--dry-run"], "--resume", "--dry-run")
    refused("two older forms", [SCENE, "--modes", "--reference-only"], "--modes", "--reference-only")
    refused("an older form beside a scene", [SCENE, "--batch", path("cases.csv")], "--batch reads a table of cases", "takes no scene")
    refused("an older form with a parameter", ["--dynamic-force", path("nothing"), "--smooth-twin", path("nothing"), "-s", "Motion/Creepage=0"], "--dynamic-force", "for a scene")
    refused("an older form of wear and another one", [SCENE, "--wear", path("cases.csv"), "--reference-only"], "--wear excludes")
    refused("two tables", ["--batch", path("cases.csv"), "--positions", path("places.csv")], "--batch", "--positions")
    refused("a number that is none", ["modes", SCENE, "--up-to", "high"], "--up-to", "tread modes --help")
    refused("a parameter twice", ["reference", SCENE, *2 * ["-s", "Motion/Creepage=0"]], "twice")
    refused("no run", ["sleeper-stress", path("nothing")], "no folder", "nothing")
    refused("a run without its twin", ["dynamic-force", path("nothing")], "--smooth-twin", "tread dynamic-force --help")
    refused("no table", ["wear", SCENE], "CONTACTS.csv", "tread wear --help")
    refused("a command that there is not", ["roll", SCENE], "no command and no file 'roll'", "tread --help")
    refused("a folder without a name", ["run", SCENE, "--output", ""], "--output", "empty")
    refused("a table of answers without a name", ["batch", path("cases.csv")], "--output is required")

    commands = re.findall(r"(?m)^  ([a-z-]+) ", execute_often(["--help"], program).stdout.partition("Commands:")[2])
    check.that("eleven commands", len(commands) == 11)
    for command in commands:
        own = execute_often([command, "--help"], program).stdout
        check.that(f"{command} explains itself, and not the older forms", f"tread {command} [OPTIONS]" in own and "still understood" not in own)
    check.that("on two ranks once", execute(["columns"], 2, program).stdout == execute(["columns"], 1, program).stdout)
check.exit()
