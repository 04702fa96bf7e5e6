#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheel over a crossing, by half-space theory: where it touches, with which forces and pressures.

    crossing-table.py --positions IN.csv --output OUT.csv [--rail SLICES] [--wheel S1002] ...
    crossing-table.py [--picture crossing.png] [--element 0]
    crossing-table.py --cells 0.13 0.1 0.075

IN.csv has a row for each position: s_mm along the rail, y_ws_mm to the side of the wheel, load_N or z_ws_mm (down, of the axle from the
radius), and where wanted yaw_rad and roll_rad. OUT.csv has a row for each patch: s_mm, y_ws_mm, x_mm ahead of the axle, y_mm from the middle
of the track, normal_force_N, max_pressure_Pa and part, the body of the rail; a position without contact has a row with the forces 0.
Without --positions: the table of doc/crossing.md, given positions of a British crossing beside CONTACT's figures, and the picture.
With --cells: wheel at rest in three of them by finite elements of these sizes in mm (prm/crossing/uk-56E1-nose.prm), likewise.

The program does the work (tread positions); elements of 0.2 mm are those of the figures compared with, 0 takes its own, which are finer.
"""

from __future__ import annotations

import argparse
import os
import tempfile
from collections.abc import Iterable, Mapping

from tread import Error, positions
from tread.commands import command_parser, run_command
from tread.positions import number, rows_of
from tread.runs import PROGRAM, ROOT, run

RAIL = os.path.join(ROOT, "contrib", "contact-data", "crossing_uk56E1.csv")
GIVEN = os.path.join(ROOT, "contrib", "contact-data", "crossing_given.csv")
COLUMNS = ("s_mm", "y_ws_mm", "x_mm", "y_mm", "normal_force_N", "max_pressure_Pa", "part")
MIDDLE = 755.  # between nose and wing, mm
SHEAR_MODULUS, POISSON = 82e9, 0.28  # of the figures compared with


def solve(given: Iterable[Mapping[str, str]], where: str, options: argparse.Namespace) -> list[list[dict[str, str]]]:
    """The patches of each position. @raises Error"""
    common = {"friction": options.friction, "angular_velocity_rad_per_s": options.angular_velocity, "speed_m_per_s": options.speed,
              "young_Pa": 2 * SHEAR_MODULUS * (1 + POISSON), "poisson": POISSON, "radius_mm": options.radius, "rail_y_mm": options.rail_y,
              "element_x_mm": options.element, "element_y_mm": options.element, "rail": os.path.abspath(options.rail),
              "wheel": os.path.abspath(options.wheel) if os.path.exists(options.wheel) else options.wheel}
    groups: dict[str, list[tuple[int, dict]]] = {"load_N": [], "height_mm": []}
    n_positions = 0
    for place, row in enumerate(given):
        n_positions += 1
        at = f"{where}, row {place + 1}"
        load, depth = number(row, "load_N", at), number(row, "z_ws_mm", at)
        own = {name: number(row, name, at) for name in ("s_mm", "y_ws_mm")}
        if None in own.values() or (load is None) == (depth is None):
            raise Error(f"{at}: needs s_mm, y_ws_mm and one of load_N and z_ws_mm")
        own.update({name: number(row, name, at) or 0. for name in ("yaw_rad", "roll_rad")})
        key, value = ("load_N", load) if depth is None else ("height_mm", 0. - depth)
        groups[key].append((place, {**own, key: value, **common}))
    answers: list[list[dict[str, str]]] = [[] for _ in range(n_positions)]
    for rows in groups.values():
        if rows:
            for (place, _), patches in zip(rows, positions.solve([row for _, row in rows], options.program)):
                answers[place] = patches
    return answers


def compare(options: argparse.Namespace) -> None:
    given = rows_of(GIVEN)
    keys = list(dict.fromkeys((row["s_mm"], row["y_ws_mm"]) for row in given))
    of = {key: [row for row in given if (row["s_mm"], row["y_ws_mm"]) == key] for key in keys}
    answers = solve([of[key][0] for key in keys], GIVEN, options)
    print("| s, mm | y_ws, mm | part | FN, N | CONTACT | diff. | p_max, MPa | CONTACT | diff. | x, mm | y, mm | off in x, um | in y, um |\n"
          "|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    worst: dict[str, list[float]] = {"FN": [], "p_max": [], "place": []}
    for key, patches in zip(keys, answers):
        for row in of[key]:
            x, y = float(row["x_mm"]), float(row["y_mm"])
            near = [patch for patch in patches if abs(float(patch["y_mm"]) - y) < 5.]
            if not near:
                print(f"| {key[0]} | {key[1]} | | | {row['normal_force_N']} | no patch |")
                continue
            patch = near[0]
            force, wanted = float(patch["normal_force_N"]), float(row["normal_force_N"])
            pressure, printed = 1e-6 * float(patch["max_pressure_Pa"]), float(row["max_pressure_MPa"])
            off = [1e3 * (float(patch[name]) - value) for name, value in (("x_mm", x), ("y_mm", y))]
            if wanted > 200.:
                worst["FN"].append(100 * abs(force / wanted - 1))
                worst["p_max"].append(100 * abs(pressure / printed - 1))
                worst["place"].append(max(abs(off[0]), abs(off[1])))
            print(f"| {key[0]} | {key[1]} | {patch['part']} | {force:.0f} | {wanted:.0f} | {100 * (force / wanted - 1):+.2f} % | {pressure:.0f} | "
                  f"{printed:.0f} | {100 * (pressure / printed - 1):+.2f} % | {float(patch['x_mm']):.3f} | {float(patch['y_mm']):.3f} | "
                  f"{off[0]:+.0f} | {off[1]:+.0f} |")
    print()
    for name, unit in (("FN", "%"), ("p_max", "%"), ("place", "um")):
        values = sorted(worst[name])
        print(f"{name}, patches above 200 N: median {values[len(values) // 2]:.2f} {unit}, largest {values[-1]:.2f} {unit}")
    if options.picture:
        draw(options.picture, options.rail, of, answers)


def by_finite_elements(options: argparse.Namespace) -> None:
    """Split of the load and largest pressure where the wheel touches both, beside the half-space's and CONTACT's."""
    keys = (("160", "3.52"), ("239", "0.95"), ("239", "1.01"))
    given = {(row["s_mm"], row["y_ws_mm"], float(row["y_mm"]) > MIDDLE): row for row in rows_of(GIVEN)}
    half_space = solve([{"s_mm": s, "y_ws_mm": y, "load_N": "10000"} for s, y in keys], "positions", options)
    print("| s, mm | y_ws, mm | part | | CONTACT | half-space | " + " | ".join(f"cells of {cell:g} mm" for cell in options.cells) + " |\n|" +
          (6 + len(options.cells)) * "---|")
    for (s, y), of_half_space in zip(keys, half_space):
        found = []
        for cell in options.cells:
            settings = {"Rail/Slices place (mm)": s, "Wheelset/Lateral shift (mm)": y, "Motion/Rolled distance (mm)": 0.1, "Mesh/Finest cell (mm)": cell,
                        "Output/Write volume": False}
            with tempfile.TemporaryDirectory() as folder:
                found.append(run("crossing/uk-56E1-nose.prm", settings, output=os.path.join(folder, "run"), program=options.program).summary["patches"])
        for is_wing, part in ((True, "wing"), (False, "nose")):
            row = given[s, y, is_wing]
            own = next(patch for patch in of_half_space if (float(patch["y_mm"]) > MIDDLE) == is_wing)
            patches = [next(patch for patch in of_run if (1e3 * patch["y_m"] > MIDDLE) == is_wing) for of_run in found]
            for label, key, column, unit in (("FN, N", "normal_force_N", "normal_force_N", 1.), ("p_max, MPa", "max_pressure_Pa", "max_pressure_MPa", 1e-6)):
                wanted = float(row[column])
                values = [unit * float(own[key])] + [unit * patch[key] for patch in patches]
                print(f"| {s} | {y} | {part} | {label} | {wanted:.0f} | " +
                      " | ".join(f"{value:.0f} ({100 * (value / wanted - 1):+.1f} %)" for value in values) + " |")


def draw(path: str, rail: str, given: Mapping[tuple[str, str], list[dict[str, str]]], answers: list[list[dict[str, str]]]) -> None:
    from tread.plots import BLUE, GREEN, ORANGE, RED, save, subplots, use_style

    use_style()
    figure, (above, beside) = subplots(2, 1, figsize=(9, 7))
    slices: dict[str, list[dict[str, str]]] = {}
    for row in rows_of(rail):
        slices.setdefault(row["x_mm"], []).append(row)
    colours = {"nose": BLUE, "wing": GREEN, "gap": "0.8"}
    for x, points in slices.items():
        for body, colour in colours.items():
            y = [float(point["y_mm"]) for point in points if point["body"] == body and float(point["z_mm"]) > -12.]
            if y:
                above.plot(len(y) * [float(x)], y, color=colour, linewidth=0.8)
    for (s, _), patches in zip(given, answers):
        for patch in patches:
            size = 0.25 * float(patch["normal_force_N"])**0.5
            above.plot(float(s) + float(patch["x_mm"]), float(patch["y_mm"]) - 750., "o", color=RED, markersize=size, alpha=0.3)
    above.set(xlabel="along the rail, mm", ylabel="y of the slices, mm", title="Slices within 12 mm of the top: nose (blue), wing (green); "
              "patches, area as the force")
    for body, colour in (("nose", ORANGE), ("wing", RED)):
        shifts = [(float(y), sum(float(patch["normal_force_N"]) for patch in patches if patch["part"] == body))
                  for (s, y), patches in zip(given, answers) if s == "239"]
        beside.plot(*zip(*shifts), "-", color=colour, label=f"{body}, tread")
        printed = [(float(row["y_ws_mm"]), float(row["normal_force_N"])) for (s, _), rows in given.items() if s == "239" for row in rows
                   if (float(row["y_mm"]) > MIDDLE) == (body == "wing")]
        beside.plot(*zip(*printed), "o", color=colour, fillstyle="none", label=f"{body}, CONTACT")
    beside.set(xlabel="lateral shift of the wheelset at 239 mm, mm", ylabel="normal force, N", title="The load goes over from the wing to the nose")
    beside.legend()
    save(figure, path)


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("--positions", metavar="IN.csv")
    parser.add_argument("--output", metavar="OUT.csv")
    parser.add_argument("--picture", metavar="PNG", help="of the given positions")
    parser.add_argument("--cells", type=float, nargs="+", metavar="MM", help="finite elements of these sizes")
    parser.add_argument("--rail", default=RAIL, help="slices: .slcs or .csv (the crossing of doc/crossing.md)")
    parser.add_argument("--rail-y", type=float, default=750., help="where y = 0 of the slices lies in the track, mm (750)")
    parser.add_argument("--wheel", default="S1002", help="profile, or its file (S1002)")
    parser.add_argument("--radius", type=float, default=460., help="of the wheel, mm (460)")
    parser.add_argument("--friction", type=float, default=0.3, help="coefficient (0.3)")
    parser.add_argument("--speed", type=float, default=2., help="m/s (2)")
    parser.add_argument("--angular-velocity", type=float, default=4.3481181, help="about the axle, rad/s (4.3481181)")
    parser.add_argument("--element", type=float, default=0.2, help="edge of the elements, mm; 0: the program's own (0.2)")
    parser.add_argument("--program", default=PROGRAM, help="tread")
    arguments = parser.parse_args()
    if bool(arguments.positions) != bool(arguments.output):
        raise Error("--positions and --output belong together")
    if arguments.cells:
        by_finite_elements(arguments)
    elif arguments.positions:
        answers = solve(rows_of(arguments.positions), arguments.positions, arguments)
        positions.write(arguments.output, COLUMNS, [row for patches in answers for row in patches])
        print(f"{len(answers)} positions, {sum(map(len, answers))} rows. Results in {arguments.output}")
    else:
        compare(arguments)


if __name__ == "__main__":
    run_command(main)
