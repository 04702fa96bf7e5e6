#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheel that leaves the rail over a deep dip and lands again, and what is recorded under it."""

import os
import sys
import tempfile

from tread_runner import Check, run, script, table

program = sys.argv[1]
check = Check()
SCENE = os.path.join("tutorial", "dip.prm")
COARSE = ["Mesh/Finest cell (mm)=2.2", "Mesh/Path cell (mm)=3.3", "Output/Write volume=false", "Rail/Plastic depth (mm)=8",
          "Rail/Yield stress (MPa)=1000", "Output/Cells=-17,0,1; -70,1,3"]
DEEP = COARSE + ["Motion/Speed (km per h)=200", "Defect/Depth (mm)=3"]


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    summary = run(program, SCENE, path("deep"), DEEP)
    history = table(path("deep"), "history.csv")
    x, force = [1e3 * p for p in history["position_m"]], history["normal_force_N"]
    static = (900. + 13400.) * 9.81

    # In the air the force is none at all, not a small one; the wheel leaves behind the leading edge at -50 mm.
    air = [i for i, f in enumerate(force) if f == 0.]
    print(f"{len(air)} rows of 0 N from {x[air[0]] if air else 0.:.1f} mm, largest {max(force) / static:.2f} of the load")
    check.that("no force at all in eight rows, one after the other, or more", any(force[i:i + 8] == 8 * [0.] for i in air))
    check.that("it leaves behind the dip's leading edge", air and -50. < x[air[0]] < -20.)
    for column in ("longitudinal_force_N", "lateral_force_N", "contact_area_m2", "max_pressure_Pa"):
        check.absolute(f"in the air: {column}", max(abs(history[column][i]) for i in air), 0., 0.)
    check.that("it lands with more than its load", max(force[air[-1]:]) > static)
    check.that("and stays", min(force[-40:]) > 0.)
    check.energy("", summary, 0.002)

    # The axle box moves as the forces say: from one interval to the next the wheel's speed changes by impulse over mass. What the
    # suspension (1.15 kN over a millimetre, beside a load of 140 kN) and the flexible rim do is less than a hundredth of it.
    time, acceleration = history["time_s"], history["axle_box_acceleration_m_per_s2"]
    steps = [t - s for s, t in zip([time[0] - (time[1] - time[0])] + time, time)]
    of_box, of_forces = [0.], [0.]
    for dt, a, f in zip(steps, acceleration, force):
        of_box.append(of_box[-1] + a * dt)
        of_forces.append(of_forces[-1] + (f - static) / 900. * dt)
    fastest = max(abs(v) for v in of_forces)
    print(f"fastest {1e3 * fastest:.1f} mm/s up or down")
    check.below("axle box: its speed against impulse over mass, worst row over the fastest",
                max(abs(a - b) for a, b in zip(of_box, of_forces)) / fastest, 0.01)

    # Stress under the path and in chosen cells.
    strip = table(path("deep"), "strip.csv")
    peak = max(strip["von_mises_MPa"])
    check.relative("strip: its largest stress is the summary's", summary["strip_max_von_mises_Pa"], 1e6 * peak, 1e-8)
    check.that("strip: the surface, which has stresses of its own, sees most where the wheel is near and steel cannot carry more",
               all(0. < s < 1.5 * peak for s in strip["surface_von_mises_MPa"])
               and all(abs(w - p) < 15. for p, w in zip(strip["x_mm"], strip["surface_wheel_x_mm"]) if -85. < p < -60.))
    at = strip["x_mm"][strip["von_mises_MPa"].index(peak)]
    check.that("strip: the largest stress is at an edge of the dip or beyond", at > -60.)
    where_it_flies = [s for p, s in zip(strip["x_mm"], strip["von_mises_MPa"]) if -38. < p < -32.]
    check.that("strip: the dip's middle, flown over, sees little", max(where_it_flies) < 0.5 * peak)
    check.that("strip: the wheel was near when a cell saw its largest stress",
               all(abs(w - p) < 15. for p, w, s in zip(strip["x_mm"], strip["wheel_x_mm"], strip["von_mises_MPa"])
                   if -85. < p < -60.))
    cells = table(path("deep"), "cells.csv")
    check.that("cells: as many rows as the history", cells["time_s"] == history["time_s"])
    for i, point in ((1, (-17., 0.)), (2, (-70., 1.))):
        for key, value, half in (("x", point[0], 1.7), ("y", point[1], 1.2)):
            check.absolute(f"cell {i}: its centre's {key}, mm", 1e3 * summary[f"cell_{i}_{key}_m"], value, half)
        strain = cells[f"cell_{i}_equivalent_plastic_strain"]
        check.that(f"cell {i}: plastic strain never falls", all(a <= b for a, b in zip(strain, strain[1:])))
        nearest = min(range(len(strip["x_mm"])), key=lambda k: abs(strip["x_mm"][k] - 1e3 * summary[f"cell_{i}_x_m"]))
        check.that(f"cell {i}: the strip's column above it has seen no less",
                   strip["von_mises_MPa"][nearest] >= (1. - 1e-9) * 1e-6 * max(cells[f"cell_{i}_von_mises_Pa"]))
        check.that(f"cell {i}: and has yielded no less",
                   strip["equivalent_plastic_strain_percent"][nearest] >= (1. - 1e-9) * 100. * strain[-1])
    check.that("the rail has yielded", max(strip["equivalent_plastic_strain_percent"]) > 0.01)
    # The strip is as wide as the path's finest cells, where the largest strain is.
    most = max(range(len(strip["x_mm"])), key=lambda k: strip["equivalent_plastic_strain_percent"][k])
    check.relative("largest plastic strain: that of the strip, %", 100. * summary["largest_plastic_strain"],
                   strip["equivalent_plastic_strain_percent"][most], 1e-8)
    check.absolute("largest plastic strain: its place along the rail, mm", 1e3 * summary["largest_plastic_strain_x_m"], strip["x_mm"][most], 0.01)
    check.that("largest plastic strain: it is in the plastic zone", 0. < summary["largest_plastic_strain_depth_m"] < 8e-3)

    pictures = script("plot/plot-impact.py", path("deep"), "--program", program)
    if not check.that("strip and cells are drawn", pictures.returncode == 0 and
                      {"strip.png", "cells.png"} <= set(os.listdir(path("deep/pictures")))):
        print(pictures.stdout, pictures.stderr)
check.exit()
