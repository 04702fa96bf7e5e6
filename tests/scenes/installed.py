#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is installed, all of it, works from a folder elsewhere and writes nothing into itself.

    installed.py BUILD PYTHON_FOLDER
"""

import os
import re
import subprocess
import sys
import tempfile

from tread_runner import Check
from tread.runs import environment

check = Check()
CALLS = """
import tread
from tread import half_space
run = tread.run("smooth-rolling.prm", command="reference", output="reference")
answer = half_space.solve(curvature_x=1., curvature_y=1., normal_force=1e5, friction=0.3, creepage=-1e-3)
print(run.folder, half_space.library_path(), float(answer["longitudinal_force"]) > 0.)
"""


def files_below(prefix):
    """{path seen from the prefix: time of its last change}"""
    return {os.path.relpath(os.path.join(where, name), prefix): os.lstat(os.path.join(where, name)).st_mtime_ns
            for where, _, names in os.walk(prefix) for name in names}


with tempfile.TemporaryDirectory() as folder:
    prefix, elsewhere = os.path.join(folder, "prefix"), os.path.join(folder, "elsewhere")
    os.mkdir(elsewhere)
    subprocess.run(["cmake", "--install", sys.argv[1], "--prefix", prefix, "--strip"], check=True, stdout=subprocess.DEVNULL)
    installed = files_below(prefix)
    check.that("one header, no archive of objects", [name for name in installed if name.endswith((".h", ".a"))] == ["include/tread/half_space.h"])
    check.that("no leftovers", not [name for name in installed if re.search(r"\.pyc$|~$|\.orig$|results/", name)])
    # The package lies there as on Debian, below the folder of libraries, where no source tree is around it.
    python = environment(PATH=os.path.join(prefix, "bin") + ":/usr/bin:/bin", PYTHONPATH=os.path.join(prefix, sys.argv[2]),
                         PYTHONDONTWRITEBYTECODE="1")
    python.pop("TREAD_HALF_SPACE_LIBRARY", None)

    def said(*command):
        """What a command prints, which must end well."""
        done = subprocess.run(command, cwd=elsewhere, env=python, capture_output=True, text=True)
        check.that(" ".join(os.path.basename(word) for word in command[:2])[:40] + ": succeeds", done.returncode == 0)
        if done.returncode:
            print(done.stdout, done.stderr)
        return done.stdout

    shared = os.path.join(prefix, "share/tread")
    # One scene includes another file, the other names a measured profile.
    said("tread", "reference", f"{shared}/prm/thesis/3.1-1.3-mu0.30.prm", "--output", "included")
    said("tread", "reference", f"{shared}/prm/curves/groove.prm", "--output", "profile")
    words = said("/usr/bin/python3", "-c", CALLS).split()
    check.that("Python: installed scene and library", words[:1] == ["reference"] and words[1].startswith(prefix) and words[2] == "True")
    said("tread-study", f"{shared}/prm/studies/friction.study", "--dry-run")
    said("tread-check-scene", f"{shared}/prm/smooth-rolling.prm")
    said("tread-compare-runs", "included", "included")
    with open(os.path.join(elsewhere, "arcs.csv"), "w", encoding="utf-8") as stream:
        stream.write("radius_mm,until,value\n-300,y_mm,20\n")
    said("tread-profile-from-arcs", "arcs.csv", "--output", "points.txt")
    said("tread-contact-inp", f"{shared}/contrib/contact-data/thesis.inp", "--output", "thesis")
    said(f"{shared}/contrib/plot/plot-run.py", "--help")

    manual = re.sub(r"\\", "", open(os.path.join(prefix, "share/man/man1/tread.1"), encoding="utf-8").read())
    commands = re.findall(r"^  ([a-z-]+) ", said("tread", "--help").partition("Commands:")[2], re.MULTILINE)
    helps = "".join(said("tread", *command, "--help") for command in [(), *((command,) for command in commands)])
    options = set(re.findall(r"^\s+(?:-h,)?(--[a-z-]+)", helps, re.MULTILINE))
    check.that("the manual page has all commands", len(commands) > 10 and all(f'"tread {command}' in manual for command in commands))
    check.that("the manual page has all options", len(options) > 15 and not [option for option in options if not re.search(rf"{option}\b(?!-)", manual)])
    # As bash-completion reads it, inside a function.
    completion = os.path.join(prefix, "share/bash-completion/completions/tread")
    words = f"({prefix}/bin/tread -s Contact/Friction\\ co)"
    completed = said("bash", "-c", f"load() {{ source {completion}; }}; load; COMP_WORDS={words}; COMP_CWORD=2; _tread 2>&1; echo $COMPREPLY")
    check.that("completion", completed.strip() == "Contact/Friction\\ coefficient=")
    check.that("nothing is written there", files_below(prefix) == installed)
check.exit()
