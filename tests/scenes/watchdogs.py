#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that go wrong, or whose answer is not to be trusted: each stops or is warned of with its line, and a good one is not."""

import json
import math
import os
import random
import sys
import tempfile

from tread.runs import arguments_of
from loaded_once import execute_often
from tread_runner import Check

program = sys.argv[1]
check = Check()
SCENE = "smooth-rolling.prm"
SHORT = ["Mesh/Finest cell (mm)=1.3", "Mesh/Fine half width (mm)=9", "Motion/Rolled distance (mm)=6"]

with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    def run(name, settings):
        return execute_often(arguments_of(SCENE, SHORT + settings, path(name)), program)

    def warned(name, settings, *words):
        """A run that ends, with one warning that has these words, on the screen and in its summary."""
        result = run(name, settings)
        said = [line for line in result.stdout.splitlines() if line.startswith("WARNING")]
        with open(os.path.join(path(name), "summary.json"), encoding="utf-8") as stream:
            kept = json.load(stream)["warnings"]
        # All are shorter than steady rolling takes.
        short = [line for line in kept if "patch lengths rolled" in line]
        kept = [line for line in kept if line not in short]
        if not check.that(f"{name}: it ends, and says so", result.returncode == 0 and len(kept) == (1 if words else 0)
                          and all(word in kept[0] and any(word in line for line in said) for word in words)):
            print(result.returncode, result.stderr, *kept, sep="\n")

    def stopped(name, settings, *words):
        """A run that stops with a line that has these words; the bodies as they were then are kept, and what was before."""
        result = run(name, settings)
        lines = [line for line in result.stderr.splitlines() if line.startswith("tread:")]
        if not check.that(f"{name}: it stops, and says so", result.returncode == 2 and len(lines) == 1 and all(word in lines[0] for word in words)):
            print(result.returncode, result.stderr)
        there = os.listdir(path(name))
        check.that(f"{name}: the bodies are drawn, and nothing calls the run complete", "volume.pvd" in there and "summary.json" not in there)

    warned("as it should be", [])
    warned("too much damping", ["Motion/Traction coefficient=0.15", "Solid/Mass damping (1 per s)=1e4", "Motion/Rolled distance (mm)=15"], "numerical damping")
    warned("hourglass coefficient", ["Solid/Hourglass coefficient=10"], "hourglass modes", "fully-integrated")
    warned("contact that is not solved", ["Contact/Largest number of sweeps=1"], "contact did not reach its tolerance", "sweeps")
    warned("a patch on long cells", ["Mesh/Path cell (mm)=2.6", "Mesh/Fine from (mm)=-3", "Mesh/Fine to (mm)=-2"], "'Mesh/Fine from (mm)'", "from -3 to -2 mm")
    warned("a torque that takes longer", ["Motion/Drive=torque", "Motion/Hold distance (mm)=1", "Start/Tractions=none"], "has reached", "Rolled distance")
    generator = random.Random(1)

    def head(name, added):
        """Settings with a crown of 300 mm, points 0.1 mm apart, and added(y), mm."""
        with open(path(name), "w", encoding="utf-8") as stream:
            for i in range(-300, 301):
                y = 0.1 * i
                stream.write(f"{y} {math.sqrt(300.**2 - y**2) - 300. + added(y)}\n")
        return [f"Rail/Measured head={path(name)}", "Mesh/Fine half width (mm)=14"]

    warned("a profile with 5 um of noise", head("noisy.txt", lambda y: 5e-3 * generator.uniform(-1., 1.)), "detail of", "Hertz", "smooth")
    for name, added, seen in (("1 um of noise", lambda y: 1e-3 * generator.uniform(-1., 1.), True),
                              ("waves of half a cell", lambda y: 2e-3 * math.cos(2. * math.pi * y / 0.65), True),
                              ("no noise", lambda y: 0., False)):
        said = execute_often(arguments_of(SCENE, SHORT + head("head.txt", added), path("dry")) + ["--dry-run"], program)
        check.that(f"{name}: named before the run: {seen}", said.returncode == 0 and ("detail of" in said.stdout) == seen)

    # The same block and steps as above, which stay far below the limits of a user: those of here are below what they do.
    stopped("strain", ["Watchdogs/Stop at strain=0.002"], "the cell at x =", "mm of the", "Stop at strain", "volume.pvd")
    stopped("volume", ["Watchdogs/Stop at volume=0.999"], "the cell at x =", "of its volume", "Stop at volume")
    stopped("speed", ["Watchdogs/Stop at node speed (m per s)=2", "Output/Write volume=false"], "m/s", "unstable")
    stopped("energy", ["Watchdogs/Stop at energy residual=1e-6"], "not accounted for", "Stop at energy residual")
    stopped("steel that hardly carries", ["Rail/Yield stress (MPa)=300", "Rail/Tangent modulus (GPa)=1", "Start/Tractions=none", "Watchdogs/Stop at strain=0.008"], "the cell at x =", "Stop at strain")

check.exit()
