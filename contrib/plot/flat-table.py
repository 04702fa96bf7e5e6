#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheel with a flat that stands on a rail at given turns, by half-space theory: height of the axle, force and largest pressure.

    flat-table.py --pitches IN.csv --output OUT.csv [--flat scanned] ...
    flat-table.py [--picture wheel-flat.png]
    flat-table.py --cells 1 0.5

IN.csv has a row for each turn: pitch_deg, by which the wheel is turned about its axle, negative where it rolls forward, from where the angle 0
of its deviation is at the bottom, and load_N. OUT.csv has a row for each: pitch_deg, axle_height_mm over the nominal radius, positive up, normal_force_N of all patches
and max_pressure_Pa. Without --pitches: the tables of doc/wheel-flat.md, given turns beside CONTACT's figures, and the picture. With --cells: the largest pressure at three turns of the
scanned flat by finite elements of these sizes in mm, beside the half-space.

Two flats are there: "scanned", a worn S1002 of 490 mm with a measured flat on a rail of arcs, and "rounded", a cylinder of 450 mm with a flat of
100 mm by a formula on a crown of 300 mm. --deviation FILE puts another one on the wheel of the first. The program does the work (tread positions);
elements of 0.4 and 0.2 mm are those of the figures compared with, 0 takes its own.
"""

from __future__ import annotations

import argparse
import os
import tempfile
from collections.abc import Sequence

from tread import Error, positions
from tread.commands import command_parser, run_command
from tread.flats import FLATS, POISSON, SCAN, SHEAR_MODULUS, Options, solve
from tread.positions import number, rows_of
from tread.runs import PROGRAM, ROOT, run

GIVEN = os.path.join(ROOT, "contrib", "contact-data", "flat_given.csv")
COLUMNS = ("pitch_deg", "axle_height_mm", "normal_force_N", "max_pressure_Pa")


def compare(options: Options, picture: str | None) -> None:
    answers = {}
    for flat in FLATS:
        given = [row for row in rows_of(GIVEN) if row["flat"] == flat]
        answers[flat] = solve(flat, [(float(row["pitch_deg"]), float(row["load_N"])) for row in given], options)
        print(f"\n{flat}:\n\n| turn, degrees | height of the axle, mm | CONTACT | diff., um | p_max, MPa | given | diff. |\n|---|---|---|---|---|---|---|")
        for row, own in zip(given, answers[flat]):
            height, wanted = own["axle_height_mm"], 0. - float(row["z_ws_mm"])
            pressure, printed = 1e-6 * own["max_pressure_Pa"], float(row["max_pressure_MPa"])
            print(f"| {row['pitch_deg']} | {height:.4f} | {wanted:.4f} | {1e3 * (height - wanted):+.1f} | {pressure:.1f} | {printed:.1f} | "
                  f"{100 * (pressure / printed - 1):+.2f} % |")
    if picture:
        draw(picture, options)


def by_finite_elements(cells: Sequence[float], options: Options) -> None:
    standing = {"Rail/Shape": "head", "Rail/Begin (mm)": "automatic", "Rail/Length (mm)": 0, "Rail/Ends": "symmetric", "Track/Foundation": "rigid",
                "Vehicle/Wheel load (kN)": 125, "Motion/Speed (km per h)": 7.2, "Motion/Rolled distance (mm)": 0.1, "Motion/Start (mm)": "automatic",
                "Mesh/Fine half width (mm)": 20, "Mesh/Path cell (mm)": 0, "Mesh/Fine from (mm)": 0, "Mesh/Fine to (mm)": 0, "Time stepping/Levels": 1,
                "Output/Write volume": False}
    steel = {"Young's modulus (GPa)": 2e-9 * SHEAR_MODULUS * (1 + POISSON), "Poisson's ratio": POISSON}
    settings = {**standing, **{f"{body}/{name}": value for body in ("Wheel", "Rail") for name, value in steel.items()}}
    turns = (-29., -37., -45.)
    half_space = solve("scanned", [(turn, 125e3) for turn in turns], options)
    print("| turn, degrees | half-space, MPa | " + " | ".join(f"cells of {cell:g} mm" for cell in cells) + " |\n|" + (2 + len(cells)) * "---|")
    for turn, answer in zip(turns, half_space):
        line = f"| {turn:g} | {1e-6 * answer['max_pressure_Pa']:.0f} |"
        for cell in cells:
            with tempfile.TemporaryDirectory() as folder:
                summary = run("flat/scanned-flat.prm", {**settings, "Mesh/Finest cell (mm)": cell, "Wheel/Deviation pitch (deg)": turn},
                              output=os.path.join(folder, "run"), program=options.program).summary
            line += f" {1e-6 * summary['max_pressure_Pa']:.0f} ({100 * (summary['max_pressure_Pa'] / answer['max_pressure_Pa'] - 1):+.1f} %) |"
        print(line)


def draw(path: str, options: Options) -> None:
    import numpy as np
    from tread.plots import BLUE, RED, save, subplots, use_style

    use_style()
    rows = rows_of(options.deviation)
    names = [name for name in rows[0] if name.startswith("y")]
    angles = np.degrees([float(row["angle_rad"]) for row in rows])
    depth = np.array([[float(row[name]) for name in names] for row in rows])
    figure, (map_of_flat, heights, pressures) = subplots(3, 1, figsize=(9, 9))
    drawn = map_of_flat.pcolormesh(angles, [float(name[1:]) for name in names], depth.T, cmap="viridis", shading="gouraud")
    figure.colorbar(drawn, ax=map_of_flat, label="more radius, mm")
    map_of_flat.set(xlabel="angle on the wheel, degrees", ylabel="y on the tread, mm", title="The scanned flat")
    turns = np.arange(-50., -24.75, 0.5)
    own = solve("scanned", [(turn, 125e3) for turn in turns], options)
    given = [row for row in rows_of(GIVEN) if row["flat"] == "scanned"]
    at = [float(row["pitch_deg"]) for row in given]
    heights.plot(turns, [row["axle_height_mm"] for row in own], color=BLUE, label="tread")
    heights.plot(at, [0. - float(row["z_ws_mm"]) for row in given], "o", color=RED, fillstyle="none", label="CONTACT")
    heights.set(xlabel="turn of the wheel, degrees (rolling from right to left)", ylabel="height of the axle, mm", title="125 kN, quasi-static")
    heights.legend()
    pressures.plot(turns, [1e-6 * row["max_pressure_Pa"] for row in own], color=BLUE, label="tread")
    pressures.plot(at, [float(row["max_pressure_MPa"]) for row in given], "o", color=RED, fillstyle="none", label="given, elements of 0.4 mm")
    pressures.set(xlabel="turn of the wheel, degrees", ylabel="largest pressure, MPa")
    pressures.legend()
    save(figure, path)


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("--pitches", metavar="IN.csv")
    parser.add_argument("--output", metavar="OUT.csv")
    parser.add_argument("--picture", metavar="PNG", help="of the scanned flat")
    parser.add_argument("--cells", type=float, nargs="+", metavar="MM", help="finite elements of these sizes")
    parser.add_argument("--flat", choices=FLATS, default="scanned")
    parser.add_argument("--deviation", default=SCAN, help="what the wheel has beyond round, instead of the scan")
    parser.add_argument("--smoothing", type=float, default=0., help="of that, mm (0)")
    parser.add_argument("--friction", type=float, default=0.3, help="coefficient (0.3)")
    parser.add_argument("--element", type=float, help="edge of the elements, mm; 0: the program's own")
    parser.add_argument("--program", default=PROGRAM, help="tread")
    arguments = parser.parse_args()
    if bool(arguments.pitches) != bool(arguments.output):
        raise Error("--pitches and --output belong together")
    if arguments.flat == "rounded" and (arguments.deviation != SCAN or arguments.smoothing > 0.):
        raise Error("--deviation and --smoothing are of the scanned flat")
    options = Options(arguments.deviation, arguments.smoothing, arguments.friction, arguments.element, arguments.program)
    if arguments.cells:
        by_finite_elements(arguments.cells, options)
        return
    if not arguments.pitches:
        compare(options, arguments.picture)
        return
    turns = []
    for place, row in enumerate(rows_of(arguments.pitches)):
        where = f"{arguments.pitches}, row {place + 1}"
        pitch, load = number(row, "pitch_deg", where), number(row, "load_N", where)
        if pitch is None or load is None:
            raise Error(f"{where}: needs pitch_deg and load_N")
        turns.append((pitch, load))
    if not turns:
        raise Error(f"{arguments.pitches} has no rows")
    positions.write(arguments.output, COLUMNS, solve(arguments.flat, turns, options))
    print(f"{len(turns)} turns. Results in {arguments.output}")


if __name__ == "__main__":
    run_command(main)
