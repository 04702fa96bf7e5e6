#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two discs of 47 mm in diameter beside half-space theory: sizes of a laboratory, not of a railway."""

import os
import sys
import tempfile

from tread_runner import Check, run

program = sys.argv[1]
check = Check()
with tempfile.TemporaryDirectory() as folder:
    # Regression: cells of 0.05 mm, three and a half to the smaller semi-axis; 0.032 mm in doc/twin-disc.md.
    disc = run(program, "rigs/twin-disc.prm", os.path.join(folder, "disc"), ["Mesh/Finest cell (mm)=0.05", "Motion/Rolled distance (mm)=0.8"])
    check.relative("largest pressure, Pa", disc["max_pressure_Pa"], disc["reference"]["max_pressure_Pa"]["Hertz"]["value"], 0.01)
    check.relative("Hertz's for radii of 11.75 and 23.5 mm and 0.1 kN, MPa", 1e-6 * disc["reference"]["max_pressure_Pa"]["Hertz"]["value"], 990.2, 1e-3)
    check.below("creepage beside the half-space's", abs(disc["reference"]["creepage"]["half-space"]["relative_difference"]), 0.01)
    check.relative("traction coefficient", disc["traction_coefficient"], 0.15, 0.005)
    check.that("a light disc is no wheel in t", not any("is it in t" in warning for warning in disc["warnings"]))
check.exit()
