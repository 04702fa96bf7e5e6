#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fill the tables of doc/verification.md from the results of the shipped scenes.

With --run, scenes without results are run first (prm/verification/half-space-*.prm, low-strain-*.prm and
prm/thesis/3.1-*.prm; results go to RESULTS/<name of the parameter file>). Tables whose results are missing keep their
text; --tables chooses some.
"""

from __future__ import annotations

import glob
import math
import os
from collections.abc import Sequence

from tread.comparison import compare
from tread.commands import command_parser, run_command
from tread.measured_runs import contact_measures, run_scene, shipped_scenes
from tread.low_strain import (LOW_STRAIN, LOW_STRAIN_LOAD, LOW_STRAIN_SPIN, LOW_STRAIN_SPIN_CELLS, LOW_STRAIN_SPIN_LIMIT, SUMMARY_MEASURES,
                              compare_with_half_space, difference, low_strain_scene, signed)
from tread.patches import read_patch
from tread.files import is_complete, read_summary, reference_value
from tread.runs import ROOT
from tread.tables import fill, markdown, number

# Errors allowed by cell size: (key of compare-contact.py, row, factor, unit, 0.63 mm, 0.33 mm).
MEASURES = (("max_pressure_relative_difference", "largest pressure", 100, "%", 1.2, 0.8),
            ("pressure_rms_over_max", "pressure, RMS", 100, "%", 1.1, 0.8),
            ("shear_rms_over_max", "shear stress, RMS", 100, "%", 1.8, 1.2),
            ("adhesion_share_difference_points", "adhesion share", 1, "points", 1.0, 0.6),
            ("creepage_at_this_traction_relative_difference", "creepage at this traction", 100, "%", 2.0, 1.0),
            ("micro_slip_rms_over_max", "micro-slip, RMS", 100, "%", 2.2, 1.7),
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


# Loads and radii of the strain study: radii times S, load over S, so the patch stays what it is.
STRAIN_SCALES = (1., 1.5, 2.5, 4.347826)

# One change at a time of half-space-0.63-mu0.30: (what, settings).
BLOCKS = {f"{name} (mm)": value for name, value in
          (("Wheel/Sector thickness", 160), ("Wheel/Sector width", 320), ("Wheel/Sector margin", 160),
           ("Rail/Block width", 320), ("Rail/Block height", 160), ("Rail/Margin", 160))}
SENSITIVITY: tuple[tuple[str, dict], ...] = (("hourglass coefficient 0.5", {"Solid/Hourglass coefficient": 0.5}),
               ("hourglass coefficient 2", {"Solid/Hourglass coefficient": 2}),
               ("element: fully integrated", {"Solid/Element": "fully-integrated"}),
               ("grading: two cells per level", {"Mesh/Level depth (semi-axes)": 0}),
               ("grading: layers twice as thick", {"Mesh/Level depth (semi-axes)": 1.5, "Mesh/Cells per level": 4}),
               ("four fine layers", {"Mesh/Fine layers": 4}),
               ("blocks of 160 mm", BLOCKS),
               ("density 1", {"Scene/Density scale": 1}),
               ("mass damping 0", {"Solid/Mass damping (1 per s)": 0}),
               ("mass damping doubled", {"Solid/Mass damping (1 per s)": 10000}),
               ("stiffness damping doubled", {"Solid/Stiffness damping (time steps)": 0.2}),
               ("one level of time steps", {"Time stepping/Levels": 1}),
               ("Courant number 0.5", {"Time stepping/Courant number": 0.5}),
               ("contact tolerance 1e-4", {"Contact/Tolerance": 1e-4}),
               ("contact tolerance 1e-8", {"Contact/Tolerance": 1e-8}),
               ("start tolerance 1e-6", {"Start/Tolerance": 1e-6}),
               ("80 mm from a start without tractions",
                {"Start/Tractions": "none", "Motion/Rolled distance (mm)": 80}))


def order(coarse: float | None, fine: float | None, ratio: float) -> str:
    """With which power of the cell size an error falls; none where it is as small as what decides the last digits."""
    if coarse is None or fine is None or abs(coarse) < 0.05 or fine == 0.:
        return "-"
    return f"{math.log(abs(coarse / fine)) / math.log(ratio):.1f}"


def low_strain_table(results: str) -> str | None:
    found = {}
    for size in LOW_STRAIN:
        run = os.path.join(results, f"low-strain-{size:g}")
        if is_complete(run):
            summary = read_summary(run)
            values = {label: difference(summary, key, source) for label, key, source in SUMMARY_MEASURES}
            for fields, beside in ((compare_with_half_space(run), ""), (contact_measures(run, 0.30, LOW_STRAIN_LOAD), " beside CONTACT")):
                for label, key in (("pressure, RMS", "pressure_rms_over_max"), ("shear stress, RMS", "shear_rms_over_max"),
                                   ("micro-slip, RMS", "micro_slip_rms_over_max")):
                    values[label + beside] = 100 * fields[key]
            found[size] = values, summary
    if len(found) < 2:
        print(f"note: too few results in {results}/low-strain-*")
        return None
    sizes = sorted(found, reverse=True)
    coarse, fine = sizes[0], sizes[-1]
    rows = []
    for label in found[fine][0]:
        unit = "points" if label == "adhesion share" else "%"
        rows.append([f"{label} [{unit}]"] + [signed(found[size][0][label]) for size in sizes]
                    + [order(found[coarse][0][label], found[fine][0][label], coarse / fine)])
    for label, key, factor in (("cells", "cells", 1), ("cell updates [million]", "element_updates", 1e-6),
                               ("wall time [s]", "wall_s", 1)):
        rows.append([label] + [number(factor * found[size][1][key]) for size in sizes] + [""])
    creepage = [found[size][0]["creepage at this traction"] for size in sizes]
    slope, limit = straight_line(sizes, creepage)
    return markdown(["difference"] + [f"{size:g} mm" for size in sizes]
                    + [f"order, {coarse:g} to {fine:g} mm"], rows) + (
        f"\n\nThe differences of the creepage lie about a line of {slope:+.2f} % per mm of the cell, which is {limit:+.2f} % at "
        f"no cell size, with a scatter of {scatter(sizes, creepage):.2f} % (standard deviation).")


def straight_line(x: Sequence[float], y: Sequence[float]) -> tuple[float, float]:
    """Slope and value at 0 of the line of least squares."""
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    slope = sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)
    return slope, mean_y - slope * mean_x


def scatter(x: Sequence[float], y: Sequence[float]) -> float:
    """Standard deviation from that line."""
    slope, limit = straight_line(x, y)
    return math.sqrt(sum((b - limit - slope * a) ** 2 for a, b in zip(x, y)) / max(1, len(x) - 2))


def low_strain_spin_table(results: str) -> str | None:
    rows = []
    for size in LOW_STRAIN_SPIN_CELLS:
        run = os.path.join(results, f"low-strain-spin-{size:g}")
        if not is_complete(run):
            print(f"note: no results in {run}")
            continue
        summary = read_summary(run)
        wanted = LOW_STRAIN_SPIN_LIMIT
        own = abs(summary["lateral_force_N"]) / summary["normal_force_N"]
        rows.append([f"{size:g}", f"{own:.5f}", signed(100 * (own / wanted - 1)),
                     number(100 * summary["slip_chatter_share"]), number(100 * summary["energy_residual_of_dissipated"])])
    if not rows:
        return None
    return markdown(["cells [mm]", "Fy/Fn", "difference from the limit [%]", "chatter of the slip [%]",
                     "energy residual [% of the dissipated]"], rows)


def strain_run(scale: float) -> tuple[str, dict[str, float]]:
    load = 127100. / scale
    return f"strain-{scale:g}", {"Wheel/Radius (mm)": 460 * scale, "Rail/Crown radius (mm)": 300 * scale,
                                 "Vehicle/Sprung mass (kg)": load / 9.81 - 900}


def strain_table(results: str) -> str | None:
    rows, points = [], []
    for scale in STRAIN_SCALES:
        run = os.path.join(results, strain_run(scale)[0])
        if not is_complete(run):
            print(f"note: no results in {run}")
            return None
        summary = read_summary(run)
        strain = 100 * reference_value(summary, "max_pressure_Pa", "Hertz") / 210e9
        values = [difference(summary, key, source) for _, key, source in SUMMARY_MEASURES[:5]]
        points.append((strain, values))
        rows.append([f"{460 * scale:.0f}", number(1e-3 * summary["normal_force_N"]), f"{strain:.3f}"]
                    + [signed(value) for value in values])
    # Least squares: what is left at no strain, and the slope.
    mean = sum(strain for strain, _ in points) / len(points)
    square = sum((strain - mean) ** 2 for strain, _ in points)
    limit, slope = [], []
    for k in range(5):
        middle = sum(values[k] for _, values in points) / len(points)
        of_strain = sum((strain - mean) * (values[k] - middle) for strain, values in points) / square
        limit.append(middle - of_strain * mean)
        slope.append(of_strain)
    rows.append(["line at no strain", "", "0"] + [signed(value) for value in limit])
    rows.append(["slope per % of p0/E", "", ""] + [signed(value) for value in slope])
    return markdown(["wheel radius [mm]", "load [kN]", "p0/E [%]"]
                    + [f"{label} [{'points' if key == 'adhesion_share' else '%'}]"
                       for label, key, _ in SUMMARY_MEASURES[:5]], rows)


def sensitivity_table(results: str) -> str | None:
    base = os.path.join(results, "half-space-0.63-mu0.30")
    if not is_complete(base):
        print(f"note: no results in {base}")
        return None
    # b has no place: it moves with a.
    measures = [measure for measure in SUMMARY_MEASURES if measure[1] != "pressure_semi_axis_y_m"]
    own = [difference(read_summary(base), key, source) for _, key, source in measures]
    rows = [["**as shipped: difference from the reference**"] + [f"**{signed(value)}**" for value in own]]
    for number_of, (what, _) in enumerate(SENSITIVITY):
        run = os.path.join(results, f"sensitivity-{number_of + 1}")
        if is_complete(run):
            values = [difference(read_summary(run), key, source) for _, key, source in measures]
            rows.append([what] + [signed(value - before) for value, before in zip(values, own)])
    return markdown(["change"] + [f"{label} [{'points' if key == 'adhesion_share' else '%'}]"
                                  for label, key, _ in measures], rows)


# Name, settings, of the scene creepage-spin-0.63.prm.
CREEPAGE_SPIN = (("driven, to the side, with spin", {}),
                 ("to the side", {"Motion/Creepage": 0, "Motion/Lateral creepage": 0.001, "Motion/Spin (1 per m)": 0}),
                 ("spin", {"Motion/Creepage": 0, "Motion/Lateral creepage": 0, "Motion/Spin (1 per m)": 0.5}))
CREEPAGE_SPIN_CELLS = (1.3, 0.63, 0.33)


def creepage_spin_run(case: int, size: float) -> str:
    return f"creepage-spin-{case}-{size:g}"


def creepage_spin_table(results: str) -> str | None:
    rows = []
    for case, (name, _) in enumerate(CREEPAGE_SPIN):
        reference = os.path.join(results, creepage_spin_run(case, 0))
        if not is_complete(reference):
            print(f"note: no results in {reference}")
            return None
        half_space = read_summary(reference)
        for size in CREEPAGE_SPIN_CELLS:
            run = os.path.join(results, creepage_spin_run(case, size))
            if not is_complete(run):
                continue
            summary, fields = read_summary(run), compare(run)

            def of_normal(key: str) -> str:
                own, wanted = (s[key] / s["normal_force_N"] for s in (summary, half_space))
                return signed(100 * (own / wanted - 1)) if abs(wanted) > 1e-3 else signed(100 * own) + " of the load"
            rows.append([name, f"{size:g}", of_normal("longitudinal_force_N"), of_normal("lateral_force_N"),
                         signed(100 * (summary["adhesion_share"] - half_space["adhesion_share"])),
                         signed(100 * (summary["frictional_power_W"] / half_space["frictional_power_W"] - 1)),
                         number(100 * fields["pressure_rms_over_max"]), number(100 * fields["shear_rms_over_max"]),
                         number(100 * summary["energy_residual_of_dissipated"])])
    return markdown(["case", "cells [mm]", "Fx/Fn [%]", "Fy/Fn [%]", "adhesion [points]", "frictional power [%]",
                     "pressure, RMS [%]", "shear stress, RMS [%]", "energy residual [% of the dissipated]"], rows)


# Of the scene locomotive-0.63.prm.
LOCOMOTIVE_CREEPAGES = (0.002, 0.004, 0.01, 0.02, 0.04, 0.075)


def locomotive_run(creepage: float, what: str) -> str:
    return f"locomotive-{creepage:g}-{what}"


def locomotive_table(results: str) -> str | None:
    rows = []
    for creepage in LOCOMOTIVE_CREEPAGES:
        runs = [os.path.join(results, locomotive_run(creepage, what)) for what in ("half-space", "0.63")]
        if not all(is_complete(run) for run in runs):
            print(f"note: no results in {' or '.join(runs)}")
            return None
        half_space, own = (read_summary(run) for run in runs)
        traction = lambda summary: summary["longitudinal_force_N"] / summary["normal_force_N"]
        rows.append([f"{creepage:g}", f"{traction(half_space):.4f}", f"{traction(own):.4f}", signed(100 * (traction(own) / traction(half_space) - 1)),
                     signed(100 * (own["adhesion_share"] - half_space["adhesion_share"])),
                     signed(100 * (own["frictional_power_W"] / half_space["frictional_power_W"] - 1)),
                     number(100 * own["tangential_force_ripple_share"]), number(100 * own["slip_chatter_share"]),
                     number(100 * own["energy_residual_of_dissipated"])])
    return markdown(["creepage", "half-space: Fx/Fn", "0.63 mm: Fx/Fn", "difference [%]", "adhesion [points]", "frictional power [%]",
                     "ripple of the tangential force [% of Fn]", "chatter of the slip [%]", "energy residual [% of the dissipated]"], rows)


def run_missing(results: str, tables: Sequence[str]) -> None:
    if "locomotive" in tables:
        for creepage in LOCOMOTIVE_CREEPAGES:
            scene, settings = "verification/locomotive-0.63.prm", {"Motion/Creepage": creepage}
            run_scene(scene, os.path.join(results, locomotive_run(creepage, "half-space")), settings, command="reference")
            run_scene(scene, os.path.join(results, locomotive_run(creepage, "0.63")), settings)
    if "creepage-spin" in tables:
        for case, (_, settings) in enumerate(CREEPAGE_SPIN):
            scene = "verification/creepage-spin-0.63.prm"
            run_scene(scene, os.path.join(results, creepage_spin_run(case, 0)), settings, command="reference")
            for size in CREEPAGE_SPIN_CELLS:
                run_scene(scene, os.path.join(results, creepage_spin_run(case, size)),
                          {**settings, "Mesh/Finest cell (mm)": size})
    if "low-strain" in tables:
        for size in LOW_STRAIN:
            scene, settings = low_strain_scene(size)
            run_scene(scene, os.path.join(results, f"low-strain-{size:g}"), settings)
    if "low-strain-spin" in tables:
        for size in LOW_STRAIN_SPIN_CELLS:
            scene, settings = low_strain_scene(size)
            run_scene(scene, os.path.join(results, f"low-strain-spin-{size:g}"), {**settings, **LOW_STRAIN_SPIN})
    if "strain" in tables:
        for scale in STRAIN_SCALES:
            name, settings = strain_run(scale)
            run_scene("verification/low-strain-0.63.prm", os.path.join(results, name), settings)
    if "sensitivity" in tables:
        for number_of, (_, changes) in enumerate(SENSITIVITY):
            run_scene("verification/half-space-0.63-mu0.30.prm",
                      os.path.join(results, f"sensitivity-{number_of + 1}"), changes)
    if not {"half-space", "published", "sensitivity"} & set(tables):
        return
    for pattern in ("verification/half-space-*.prm", "thesis/3.1-*.prm"):
        for scene in shipped_scenes(pattern):
            run_scene(scene, os.path.join(results, os.path.basename(scene)[:-len(".prm")]))
    for cells in ("0.63", "0.33"):
        name = f"half-space-{cells}-mu0.30"
        run_scene(f"verification/{name}.prm", os.path.join(results, name + FROM_NONE),
                  {"Start/Tractions": "none", "Motion/Rolled distance (mm)": 80})


def half_space_table(results: str) -> str | None:
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


def published_table(results: str) -> str | None:
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


TABLES = {"half-space": half_space_table, "low-strain": low_strain_table, "low-strain-spin": low_strain_spin_table, "strain": strain_table,
          "sensitivity": sensitivity_table, "creepage-spin": creepage_spin_table,
          "locomotive": locomotive_table, "published": published_table}


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results"))
    parser.add_argument("--run", action="store_true", help="run the scenes that have no results yet")
    parser.add_argument("--tables", metavar="NAME", nargs="+", choices=TABLES, default=list(TABLES),
                        help=f"of {', '.join(TABLES)}")
    arguments = parser.parse_args()
    if arguments.run:
        run_missing(arguments.results, arguments.tables)
    for name in arguments.tables:
        table = TABLES[name](arguments.results)
        if table is not None:
            fill("verification.md", name, table)


if __name__ == "__main__":
    run_command(main)
