#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A verification scene against Kalker's CONTACT with elements of 0.1 mm, and the half-space solution of second order."""

import csv
import json
import os
import sys
import tempfile

from tread.low_strain import compare_with_half_space
from tread.runs import ROOT
from tread_runner import Check, rows_of, run, script

program, scene, contact = sys.argv[1:4]
# What cells of 0.63 mm, a ninth of the smaller semi-axis, must reach: about half as much again as was found. With two cells
# of each size instead of layers as thick as a semi-axis the largest pressure is 0.66 % off at low strain and 1.15 % at the
# usual load. Load over that of CONTACT's case; largest pressure; RMS of pressure, shear stress, micro-slip; adhesion share
# [points]; creepage; energy residual of what was dissipated.
LIMITS = {"half-space-0.63-mu0.15": (1., 0.008, 0.011, 0.018, 0.021, 0.5, 0.010, 0.016),
          "half-space-0.63-mu0.30": (1., 0.008, 0.011, 0.015, 0.0148, 0.5, 0.010, 0.005),
          "low-strain-0.63": (29232. / 127100., 0.0041, 0.010, 0.014, 0.0165, 0.5, 0.015, 0.004)}
scale, pressure, pressure_rms, shear_rms, slip_rms, adhesion, creepage, energy = LIMITS[scene]
check = Check()
with tempfile.TemporaryDirectory() as folder:
    peaks = ["Peak stress/Region=range", "Peak stress/From (mm)=-12", "Peak stress/To (mm)=-6"]
    summary = run(program, f"verification/{scene}.prm", folder, ["Output/Write volume=false"] + peaks)
    measures = os.path.join(folder, "measures.json")
    compared = script("plot/compare-contact.py", folder, os.path.join(ROOT, "contrib", "contact-data", contact), "--scale", str(scale),
                      "--json", measures)
    print(compared.stdout, compared.stderr)
    compared.check_returncode()
    with open(measures, encoding="utf-8") as stream:
        print(stream.read())
        stream.seek(0)
        m = json.load(stream)
    fine = compare_with_half_space(folder) if scene.startswith("low-strain") else {}
    run(program, f"verification/{scene}.prm", os.path.join(folder, "half-space"), peaks, command="reference")
    peak_rows = rows_of(folder, "peak_stress.csv")
    with open(os.path.join(folder, "half-space", "subsurface.csv"), encoding="utf-8") as stream:
        depth_rows = list(csv.DictReader(stream))
half_space = {name: entry["half-space"]["value"] for name, entry in summary["reference"].items() if "half-space" in entry}
check.relative("normal force, N", summary["normal_force_N"], scale * 127100., 0.003)
check.below("maximum pressure, relative difference", m["max_pressure_relative_difference"], pressure)
for axis in ("x", "y"):
    name = f"pressure_semi_axis_{axis}_m"
    check.relative(f"semi-axis along {axis} by moments of the pressure, mm", 1e3 * summary[name], 1e3 * summary["reference"][name]["Hertz"]["value"], 0.01)
check.below("pressure, RMS over the maximum", m["pressure_rms_over_max"], pressure_rms)
check.below("shear stress, RMS over the maximum", m["shear_rms_over_max"], shear_rms)
# Nodes adhere or slip as a whole: one instant knows the share to a point; the mean over rolling one cell does better.
check.absolute("adhesion share, %", 100. * summary["adhesion_share"], 100. * half_space["adhesion_share"], adhesion)
check.relative("creepage at this traction", summary["creepage"], half_space["creepage"], creepage)
check.below("micro-slip averaged over one cell, RMS over the maximum", m["micro_slip_rms_over_max"], slip_rms)
if fine:
    # Half of what is left beside CONTACT is that of its elements. Found: 0.7, 0.9 and 0.5 %.
    for name, most in (("pressure", 0.010), ("shear", 0.013), ("micro_slip", 0.008)):
        check.below(f"{name} beside half-space theory of second order, RMS over the maximum", fine[f"{name}_rms_over_max"], most)
check.below("isolated nodes of adhesion in the slip area", m["isolated_adhesion_nodes"], 0.)
check.below("largest slip in adhesion, m/s, at the solver's tolerance", m["max_slip_in_adhesion_m_per_s"], 1e-6)
check.below("ripple of the normal force over the last 10 mm", summary["normal_force_ripple_share"], 0.002)
check.below("contact steps not converged", summary["contact_unconverged_share"], 0.)
# Largest von Mises stress by depth, recovered, beside the half-space solver with its own tractions. At the surface it has a narrow peak where slip
# begins, which averaging over a face lowers by 5 to 7 %.
largest = [(float(row["depth_mm"]), float(row["von_mises_MPa"])) for row in depth_rows if row["body"] == "rail" and row["line"] == "largest"]
for row in peak_rows:
    depth = row["depth_mm"]
    above, below = max(p for p in largest if p[0] <= depth), min(p for p in largest if p[0] > depth)
    wanted = above[1] + (below[1] - above[1]) * (depth - above[0]) / (below[0] - above[0])
    allowed = 0.04 if depth < 0.5 else 0.025 if depth < 1.2 else 0.03  # found: 3.2 % in the first layer, -2.3 % in the third one
    check.relative(f"largest von Mises stress at a depth of {depth:.2f} mm, MPa", row["von_mises_MPa"], wanted, allowed)
check.relative("largest von Mises stress of the surface from stretch and tractions, MPa",
               1e-6 * summary["peak_surface_von_mises_from_tractions_Pa"], largest[0][1], 0.08)
check.energy("", summary, energy)
check.exit()
