#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fill the tables of doc/verification.md from the results of the shipped scenes.

With --run, scenes without results are run first (prm/verification/half-space-*.prm and prm/thesis/3.1-*.prm;
results go to RESULTS/<name of the parameter file>). Tables whose results are missing keep their text.
"""

import argparse
import glob
import os

from doc_tables import ROOT, contact_measures, fill, markdown, number, run_scene, run_script
from run_data import read_patch, read_summary, reference_value

# Errors allowed by cell size: (key of compare-contact.py, row, factor, unit, 0.63 mm, 0.33 mm).
MEASURES = (("max_pressure_relative_difference", "largest pressure", 100, "%", 1.2, 0.8),
            ("pressure_rms_over_max", "pressure, RMS", 100, "%", 2.5, 1.0),
            ("shear_rms_over_max", "shear stress, RMS", 100, "%", 2.5, 1.1),
            ("adhesion_share_difference_points", "adhesion share", 1, "points", 1.0, 0.6),
            ("creepage_at_this_traction_relative_difference", "creepage at this traction", 100, "%", 2.0, 1.0),
            ("micro_slip_rms_over_max", "micro-slip, RMS", 100, "%", 4.0, 2.0),
            ("max_slip_in_adhesion_m_per_s", "largest slip in adhesion", 1, "m/s", 1e-6, 1e-6),
            ("normal_force_ripple_last_10_mm", "normal force, ripple over 10 mm", 100, "%", 0.3, 0.3),
            ("isolated_adhesion_nodes", "isolated adhesion nodes", 1, "", 0, 0))

# Zhao & Li (2011), tables 2 and 3 = Zhao (2012), tables 3.1.2 and 3.1.3: finite elements of 0.33, 0.63, 1.3 mm.
PUBLISHED = (("semi-axis a [mm]", 1e3, "semi_axis_x_m", (8.00, 7.83, 8.48)),
             ("semi-axis b [mm]", 1e3, "semi_axis_y_m", (6.03, 5.95, 7.07)),
             ("area [mm2]", 1e6, "patch_area_m2", (151, 146, 188)),
             ("largest pressure [MPa]", 1e-6, "max_pressure_Pa", (1344, 1323, 1297)),
             ("adhesion share [%]", 100, "adhesion_share", (60.0, 59.6, 62.5)),
             ("largest shear stress [MPa]", 1e-6, "max_shear_Pa", (575, 580, 485)),
             ("largest micro-slip [m/s]", 1, "max_slip_m_per_s", (0.39, 0.41, 0.52)),
             ("cells [1000]", 1e-3, "cells", (219, 116, 53)),
             ("wall time [s]", 1, "wall_s", (97380, 22644, 8532)))
SIZES = (0.33, 0.63, 1.3)
FROM_NONE = "-from-none"  # what rolls 80 mm from a start without tractions


def run_missing(results):
    for pattern in ("verification/half-space-*.prm", "thesis/3.1-*.prm"):
        for scene in sorted(glob.glob(pattern, root_dir=os.path.join(ROOT, "prm"))):
            run_scene(scene, os.path.join(results, os.path.basename(scene)[:-len(".prm")]))
    for size in ("0.63", "0.33"):
        name = f"half-space-{size}-mu0.30"
        run_scene(f"verification/{name}.prm", os.path.join(results, name + FROM_NONE),
                  {"Start/Tractions": "none", "Motion/Rolled distance (mm)": 80})


def half_space_table(results):
    columns = []
    for size, traction, start in (("0.63", "0.15", ""), ("0.63", "0.30", ""), ("0.63", "0.30", FROM_NONE),
                                  ("0.33", "0.30", ""), ("0.33", "0.30", FROM_NONE)):
        run = os.path.join(results, f"half-space-{size}-mu{traction}{start}")
        if not os.path.exists(os.path.join(run, "summary.json")):
            print(f"note: no results in {run}")
            continue
        label = f"{size} mm, traction {traction}" + (", 80 mm from none" if start else "")
        columns.append((size, label, contact_measures(run, float(traction)), read_summary(run)))
    if not columns:
        return None
    rows = []
    for key, label, factor, unit, coarse, fine in MEASURES:
        row = [f"{label} [{unit}]" if unit else label]
        for size, _, measures, _ in columns:
            allowed = coarse if size == "0.63" else fine
            value = measures.get(key)
            row.append("-" if value is None else f"{number(factor * value)} (allowed {allowed:g})"
                       + ("" if abs(factor * value) <= allowed else " **FAIL**"))
        rows.append(row)
    rows.append(["cells"] + [number(summary.get("cells")) for *_, summary in columns])
    rows.append(["wall time [s]"] + [number(summary.get("wall_s")) for *_, summary in columns])
    return markdown(["difference from CONTACT"]
                    + [label for _, label, *_ in columns], rows)


def published_table(results):
    runs, lower = {}, {}
    for run in sorted(glob.glob(os.path.join(results, "3.1-*"))):
        if run.endswith("torque") or not os.path.exists(os.path.join(run, "summary.json")):
            continue
        summary = read_summary(run)
        if abs(summary.get("traction_coefficient", 0) - 0.15) < 0.02:
            size = read_patch(os.path.join(run, "patch.csv")).size_x
            lower[min(SIZES, key=lambda candidate: abs(candidate - size))] = summary
        if abs(summary.get("traction_coefficient", 0) - 0.30) < 0.02:
            size = read_patch(os.path.join(run, "patch.csv")).size_x
            runs[min(SIZES, key=lambda candidate: abs(candidate - size))] = summary
    if not runs:
        print(f"note: no results with traction coefficient 0.30 in {results}/3.1-*")
        return None
    forces = ", ".join(f"{1e-3 * run['normal_force_N']:.1f} kN ({size} mm)" for size, run in sorted(runs.items()))
    header = [""] + [f"{size} mm: published | tread | Hertz" for size in sorted(runs)]
    rows = []
    for label, factor, key, published in PUBLISHED:
        row = [label]
        for size in sorted(runs):
            own, hertz = runs[size].get(key), reference_value(runs[size], key, "Hertz")
            row += [number(published[SIZES.index(size)]), number(None if own is None else factor * own),
                    number(None if hertz is None else factor * hertz)]
        rows.append(row)
    # Published at 0.33 mm only: 81 % by finite elements, 83 % by CONTACT.
    row = ["adhesion share at traction 0.15 [%]"]
    for size in sorted(runs):
        row += ["81" if size == 0.33 else "-", number(100 * lower[size]["adhesion_share"]) if size in lower else "-", "-"]
    rows.append(row)
    return f"Normal force in tread's runs: {forces}.\n\n" + markdown(header, rows).replace(
        "|" + "---|" * len(header), "|" + "---|" * (1 + 3 * len(runs)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results"))
    parser.add_argument("--run", action="store_true", help="run the scenes that have no results yet")
    arguments = parser.parse_args()
    if arguments.run:
        run_missing(arguments.results)
    for name, make in (("half-space", half_space_table), ("published", published_table)):
        table = make(arguments.results)
        if table is not None:
            fill("verification.md", name, table)


if __name__ == "__main__":
    run_script(main)
