#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Each shipped scene on a coarse mesh for some twenty steps, by a program that the sanitizers watch (contrib/sanitize.sh): a run that
does not end well is a finding.

  sanitized.py PROGRAM [WORD ...]     only scenes whose path has one of the words
"""

import os
import sys
import tempfile
import time

from tread.runs import ROOT, arguments_of, execute, parameters_of
from tread_runner import Check

program, words = sys.argv[1], sys.argv[2:]
check = Check()

COARSE = {"Mesh/Finest cell (mm)": "2.2", "Mesh/Fine half width (mm)": "0", "Mesh/Fine layers": "2", "Mesh/Path cell (mm)": "0",
          "Motion/Rolled distance (mm)": "0.5", "Motion/Hold distance (mm)": "0.2", "Motion/Passages": "1",
          "Output/History interval (mm)": "0.2", "Output/Write volume": "false"}
# What a scene that is cut so short cannot have: a place beside its path, a start before a defect that is fine enough for it.
OFF = {"Mesh/Fine from (mm)": "0", "Mesh/Fine to (mm)": "0", "Peak stress/Region": "none", "Output/Cells": ""}
ALIKE = ("Scene/Title", "Output/Directory", "Defect/Depth (mm)", "Defect/Length (mm)", "Motion/Creepage", "Contact/Friction coefficient",
         "Motion/Traction coefficient", "Rail/Tangent modulus (GPa)", "Defect/Rounded trailing edge (mm)")
ON_TWO_RANKS = ("smooth-rolling", "tutorial/track", "tutorial/two-wheels", "curves/klingel", "3.2-0.63-mu0.30.prm", "4.1-case1.prm")


def ends_well(name, arguments, ranks=1):
    start = time.time()
    result = execute(arguments, ranks, program, timeout=1800)
    text = f"{name}, {ranks} rank(s), {time.time() - start:.0f} s"
    if not check.that(text, result.returncode == 0):
        print(result.returncode, result.stdout[-2000:], result.stderr[-8000:], flush=True)


shipped = sorted(os.path.join(where, name) for where, _, names in os.walk(os.path.join(ROOT, "prm")) for name in names
                 if name.endswith(".prm"))
seen = set()
with tempfile.TemporaryDirectory() as folder:
    for scene in shipped:
        name = os.path.relpath(scene, os.path.join(ROOT, "prm"))
        if words and not any(word in name for word in words):
            continue
        settings = parameters_of(scene)  # by the program in build/, which is faster
        positioned = settings["Wheelset/Lateral shift (mm)"] != "none"
        changes = dict(COARSE, **{key: value for key, value in OFF.items() if settings[key] not in ("", value)})
        if positioned:  # small patches
            changes.pop("Mesh/Finest cell (mm)")
        # Scenes that differ in such numbers alone run through the same code.
        kind = frozenset((key, value) for key, value in {**settings, **changes}.items() if key not in ALIKE)
        if kind in seen:
            continue
        seen.add(kind)
        ranks = 2 if any(word in name for word in ON_TWO_RANKS) else 1
        ends_well(name, arguments_of(scene, changes, os.path.join(folder, "run")), ranks)
        if ranks == 2:
            ends_well(name, arguments_of(scene, changes, os.path.join(folder, "run")))
            ends_well("reference " + name, arguments_of(scene, changes, os.path.join(folder, "reference"), "reference"))
check.exit()
