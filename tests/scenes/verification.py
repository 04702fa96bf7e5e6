#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A verification scene against Kalker's CONTACT with elements of 0.1 mm."""

import json
import os
import subprocess
import sys
import tempfile

from tread_runner import ROOT, Check, run

program, scene, contact = sys.argv[1:4]
check = Check()
with tempfile.TemporaryDirectory() as folder:
    summary = run(program, f"verification/{scene}.prm", folder, ["Output/Write volume=false"], 2)
    measures = os.path.join(folder, "measures.json")
    subprocess.run(["/usr/bin/python3", os.path.join(ROOT, "contrib", "plot", "compare-contact.py"), folder,
                    os.path.join(ROOT, "contrib", "reference", contact), "--json", measures], check=True)
    with open(measures, encoding="utf-8") as stream:
        print(stream.read())
        stream.seek(0)
        m = json.load(stream)
# What cells of 0.63 mm, a ninth of the smaller semi-axis, must reach.
check.relative("normal force, N", summary["normal_force_N"], 127100., 0.002)
check.below("maximum pressure, relative difference", m["max_pressure_relative_difference"], 0.012)
check.below("pressure, RMS over the maximum", m["pressure_rms_over_max"], 0.025)
check.below("shear stress, RMS over the maximum", m["shear_rms_over_max"], 0.025)
# Nodes adhere or slip as a whole: one instant knows the share to a point; the mean over rolling one cell does better.
contact_share = 100. * m["adhesion_share"] - m["adhesion_share_difference_points"]
check.absolute("adhesion share, %", 100. * summary["adhesion_share"], contact_share, 1.)
check.below("creepage at this traction, relative difference", m["creepage_at_this_traction_relative_difference"], 0.02)
check.below("micro-slip averaged over one cell, RMS over the maximum", m["micro_slip_rms_over_max"], 0.04)
check.below("isolated nodes of adhesion in the slip area", m["isolated_adhesion_nodes"], 0.)
check.below("largest slip in adhesion, m/s, at the solver's tolerance", m["max_slip_in_adhesion_m_per_s"], 1e-6)
check.below("ripple of the normal force over the last 10 mm", summary["normal_force_ripple_share"], 0.003)
check.below("energy residual, share of the work", summary["energy_residual_share"], 1e-3)
check.exit()
