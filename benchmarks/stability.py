#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hard cases with answers that are known before they are run.

Each case runs at Courant numbers 0.5 and 0.95 on one rank, and at 0.95 on three ranks, whose figures must be those of one.
Either its figures are as expected, or it stops with a line, or it warns: what it should do is part of the case. Fills
the table of doc/stability.md. Runs whose complete results are there are not repeated; remove RESULTS to run all anew.
"""

import os
import re
import sys
from collections.abc import Callable
from dataclasses import dataclass, field

from tread.commands import command_parser, run_command
from tread.files import read_table
from tread.measured_runs import run_scene
from tread.runs import ROOT, ProgramError
from tread.tables import fill, markdown, provenance, rows_of

SMOOTH = "smooth-rolling.prm"
COARSE = {"Mesh/Finest cell (mm)": 1.3, "Motion/Rolled distance (mm)": 15, "Output/Write volume": "false"}
WAYS = {"0.5": (0.5, 1), "0.95": (0.95, 1), "0.95, 3 ranks": (0.95, 3)}  # Courant number, ranks
SAME_ON_RANKS = 1e-5  # of the load and of the largest pressure
RESIDUAL = 0.05  # of what was dissipated, where friction or yielding dissipates; else of the gross work


@dataclass
class Case:
    name: str
    hard: str  # what is
    expected: str  # in words
    scene: str = SMOOTH
    settings: dict = field(default_factory=dict)
    check: Callable = None  # of a summary and its folder: ("what came", whether it is right)
    stops: str = ""  # pattern of the line with which it must stop
    warns: str = ""  # pattern of a warning that it must give
    residual: float = RESIDUAL
    ways: tuple = tuple(WAYS)


def against(key, source, allowed):
    """A figure beside one of the summary's references, allowed in %."""
    def check(summary, _):
        difference = 100 * summary["reference"][key][source]["relative_difference"]
        return f"{difference:+.1f} %", abs(difference) <= allowed
    return check


def traction(expected, allowed):
    def check(summary, _):
        found = summary["traction_coefficient"]
        return f"{found:.4f}", abs(found - expected) <= allowed
    return check


def steady(allowed):
    """Mean normal force over the second and the last quarter of a run: the relative drift between them, allowed in %."""
    def check(summary, folder):
        force = read_table(os.path.join(folder, "history.csv"))["normal_force_N"]
        quarter = len(force) // 4
        drift = 100 * (sum(force[-quarter:]) / sum(force[quarter:2 * quarter]) - 1)
        return f"{drift:+.4f} % after {summary['steps']} steps, traction {summary['traction_coefficient']:.4f}", \
            abs(drift) <= allowed and abs(summary["traction_coefficient"] - 0.3) <= 0.006
    return check


def load(expected, allowed):
    """Normal force over that expected (N), allowed in %."""
    def check(summary, _):
        difference = 100 * (summary["normal_force_N"] / expected - 1)
        return f"{difference:+.2f} %", abs(difference) <= allowed
    return check


def leaves_the_rail(least_peak):
    """Lifts off and lands: no force at some time, and later a peak of so many loads."""
    def check(summary, folder):
        force = read_table(os.path.join(folder, "history.csv"))["normal_force_N"]
        static = force[0]
        peak = max(force) / static
        return f"least {min(force) / static:.2f}, peak {peak:.2f} loads", min(force) < 0.02 * static and peak > least_peak
    return check


LOAD = 14300 * 9.81  # N, of the smooth scene
TRACK_LOAD = 116.8e3  # N, of the tutorial's track
PRESSURE = against("max_pressure_Pa", "half-space", 4.)
CASES = [
    Case("smooth", "nothing: the scale for all others", "pressure of the half-space within 4 %", check=PRESSURE),
    Case("friction 0", "nothing damps the tangential motion", "no more than normals turned by 5e-4 rad make", settings={
        "Contact/Friction coefficient": 0, "Motion/Traction coefficient": 0, "Motion/Creepage": 0}, check=traction(0., 5e-4)),
    Case("friction 1", "much of the patch sticks", "traction 0.300 within 0.006", settings={"Contact/Friction coefficient": 1},
         check=traction(0.3, 0.006)),
    Case("friction 2", "much of the patch sticks", "traction 0.300 within 0.006", settings={"Contact/Friction coefficient": 2},
         check=traction(0.3, 0.006)),
    Case("0.98 of the bound", "the creepage hardly decides the force", "traction 0.490 within 0.006", settings={
        "Motion/Traction coefficient": 0.49}, check=traction(0.49, 0.006)),
    Case("full sliding", "all slips, at 0.1 of the speed", "traction 0.5 within 0.2 %", settings={"Motion/Creepage": 0.1},
         check=traction(0.5, 0.001)),
    Case("full sliding, braked", "all slips, at -0.2 of the speed", "traction -0.5 within 0.2 %", settings={"Motion/Creepage": -0.2},
         check=traction(-0.5, 0.001)),
    Case("braking", "forces change sign", "traction -0.300 within 0.006", settings={"Motion/Traction coefficient": -0.3},
         check=traction(-0.3, 0.006)),
    Case("1 km/h", "14 000 steps for 4 mm", "pressure of the half-space within 4 %", settings={
        "Motion/Speed (km per h)": 1, "Motion/Rolled distance (mm)": 4}, check=PRESSURE),
    Case("500 km/h", "inertia and the speed of waves", "pressure of the half-space within 4 %", settings={
        "Motion/Speed (km per h)": 500, "Scene/Density scale": 1}, check=PRESSURE),
    Case("soft wheel", "Young's moduli 1:10: the patch outgrows the crown's radius", "pressure of the half-space within 4 %", settings={
        "Wheel/Young's modulus (GPa)": 21, "Wheel/Sector thickness (mm)": 120, "Scene/Density scale": 4, "Motion/Traction coefficient": 0, "Motion/Creepage": 0, "Wheel/Sector margin (mm)": 60,
        "Rail/Margin (mm)": 60}, check=PRESSURE),
    Case("rubber wheel", "Young's moduli 1:100: the patch outgrows head and sector", "stops and says why", settings={
        "Wheel/Young's modulus (GPa)": 2.1, "Scene/Density scale": 1, "Motion/Traction coefficient": 0, "Motion/Creepage": 0}, stops="."),
    Case("nu 0.49, one-point", "nearly incompressible", "pressure of Hertz within 5 %", settings={
        "Wheel/Poisson's ratio": 0.49, "Rail/Poisson's ratio": 0.49, "Motion/Traction coefficient": 0, "Motion/Creepage": 0},
         check=against("max_pressure_Pa", "Hertz", 5.)),
    Case("nu 0.49, fully integrated", "such cells lock: the pressure would be 33 % too high", "is refused", settings={
        "Wheel/Poisson's ratio": 0.49, "Solid/Element": "fully-integrated"}, stops="locks"),
    Case("nu 0.45, fully integrated", "on the verge of locking, with levels", "pressure of Hertz within 5 %", settings={
        "Wheel/Poisson's ratio": 0.45, "Rail/Poisson's ratio": 0.45, "Solid/Element": "fully-integrated", "Motion/Traction coefficient": 0,
        "Motion/Creepage": 0}, check=against("max_pressure_Pa", "Hertz", 5.)),
    Case("nearly no hardening", "flow at 300 MPa, a fifth of the pressure, tangent modulus 0.1 GPa", "carries the load within 15 %: flow at the start sets the wheel swinging", settings={
        "Rail/Yield stress (MPa)": 300, "Rail/Tangent modulus (GPa)": 0.1, "Mesh/Fine half width (mm)": 14}, check=load(LOAD, 15.)),
    Case("both flow", "the same steel in wheel and rail", "carries the load within 3 %, or says that it cannot", settings={
        "Rail/Yield stress (MPa)": 300, "Rail/Tangent modulus (GPa)": 0.1, "Wheel/Yield stress (MPa)": 300, "Wheel/Tangent modulus (GPa)": 0.1,
        "Mesh/Fine half width (mm)": 14}, check=load(LOAD, 3.), stops="no equilibrium|leaves what is meshed|has folded"),
    Case("yield at a tenth", "flow at 140 MPa, a tenth of the pressure", "carries the load within 5 %", settings={
        "Rail/Yield stress (MPa)": 140, "Mesh/Fine half width (mm)": 14}, check=load(LOAD, 5.)),
    *(Case(f"{levels} levels", "no scaled density, no mass damping", "pressure of the half-space within 4 %", settings={
        "Scene/Density scale": 1, "Scene/Quasi-static": "false", "Solid/Mass damping (1 per s)": 0, "Time stepping/Levels": levels},
           check=PRESSURE) for levels in (1, 2, 3, 4, 6)),
    Case("density times 100", "an inertia error of 1.7 %", "pressure of the half-space within 4 %", settings={"Scene/Density scale": 100}, check=PRESSURE),
    Case("density times 100, 200 km/h", "an inertia error of 3.5 %", "is refused", settings={
        "Scene/Density scale": 100, "Motion/Speed (km per h)": 200}, stops="inertia error"),
    Case("small wheel", "100 mm, 5 kN", "pressure of the half-space within 5 %", settings={
        "Wheel/Radius (mm)": 50, "Wheel/Mass (kg)": 20, "Wheel/Moment of inertia (kg m2)": 0.1, "Vehicle/Wheel load (kN)": 5, "Wheel/Sector thickness (mm)": 20,
        "Wheel/Sector margin (mm)": 12, "Mesh/Finest cell (mm)": 0.35, "Motion/Rolled distance (mm)": 6, "Motion/Speed (km per h)": 40},
         check=against("max_pressure_Pa", "half-space", 5.)),
    Case("large wheel", "2000 mm", "pressure of the half-space within 4 %", settings={"Wheel/Radius (mm)": 1000}, check=PRESSURE),
    Case("light wheel", "nothing rests on 50 kg of wheel", "pressure of the half-space within 5 %", settings={
        "Wheel/Mass (kg)": 50, "Wheel/Moment of inertia (kg m2)": 5, "Vehicle/Wheel load (kN)": 30, "Mesh/Finest cell (mm)": 0.8,
        "Motion/Rolled distance (mm)": 10}, check=against("max_pressure_Pa", "half-space", 5.)),
    Case("hourglass 0.01", "modes without stiffness", "pressure within 4 %, or a warning", settings={"Solid/Hourglass coefficient": 0.01}, check=PRESSURE),
    Case("hourglass 10", "modes far too stiff", "a warning", settings={"Solid/Hourglass coefficient": 10}, warns="ourglass"),
    Case("mass damping 1e5", "motion is held back", "a warning", settings={"Solid/Mass damping (1 per s)": 1e5}, warns="damping"),
    Case("thin sector", "3 mm of wheel", "says so", settings={"Wheel/Sector thickness (mm)": 3, "Mesh/Fine layers": 1}, warns="thick"),
    Case("off the fine zone", "the patch flows beyond the finest cells", "stops and says where", settings={
        "Rail/Yield stress (MPa)": 100, "Rail/Tangent modulus (GPa)": 0.5, "Mesh/Fine half width (mm)": 9}, stops="leaves what is meshed"),
    Case("torque above friction", "the wheel would spin up", "is refused", settings={
        "Motion/Drive": "torque", "Motion/Traction coefficient": 0.6, "Motion/Hold distance (mm)": 5}, stops="below 'Contact/Friction coefficient'"),
    Case("dip at 300 km/h", "5 mm deep, 100 mm long: flies and lands", "no force for a time, then more than two loads", scene="tutorial/dip.prm", settings={
        "Defect/Depth (mm)": 5, "Defect/Length (mm)": 100, "Defect/Width (mm)": 40, "Motion/Speed (km per h)": 300, "Motion/Rolled distance (mm)": 200,
        "Defect/Position (mm)": -160, "Mesh/Fine to (mm)": 150, "Mesh/Fine half width (mm)": 16, "Output/Write volume": "false"}, check=leaves_the_rail(2.)),
    Case("sharp edge at 200 km/h", "0.5 mm deep, 20 mm long, kinks at its ends", "the wheel bridges it: the force falls below 0.3 and rises above 1.1 loads",
         scene="tutorial/dip.prm", settings={"Defect/Depth (mm)": 0.5, "Defect/Length (mm)": 20, "Motion/Speed (km per h)": 200,
                                             "Output/Write volume": "false"},
         check=lambda summary, folder: edge_forces(folder)),
    Case("a million steps", "error that adds up, at 1 km/h with the true density", "force steady to 0.1 %, what a ripple of 2 % leaves in its means; traction 0.300 within 0.006", settings={
        "Mesh/Finest cell (mm)": 2.6, "Motion/Speed (km per h)": 1, "Scene/Density scale": 1, "Motion/Rolled distance (mm)": 96,
        "Output/History interval (mm)": 0.5}, check=steady(0.1), ways=("0.95",)),
    Case("soft ballast and stiff pads", "2 and 3000 MN/m", "carries the load within 3 %", scene="tutorial/track.prm", settings={
        "Track/Ballast stiffness (MN per m)": 2, "Track/Pad stiffness (MN per m)": 3000, "Motion/Rolled distance (mm)": 20},
         check=load(TRACK_LOAD, 3.), ways=("0.95", "0.95, 3 ranks")),
    Case("two sweeps", "contact is not solved to its tolerance", "a warning", settings={"Contact/Largest number of sweeps": 2}, warns="tolerance"),
    Case("no stiffness damping", "micro-slip chatters", "a warning", settings={
        "Solid/Stiffness damping (time steps)": 0, "Time stepping/Levels": 1}, warns="no stiffness damping"),
    Case("rigid pads", "1e7 MN/m, many thousand times stiff ones", "a warning that they shorten the step", scene="tutorial/track.prm", settings={
        "Track/Pad stiffness (MN per m)": 1e7, "Motion/Rolled distance (mm)": 10, "Output/Write volume": "false"}, warns="far from those of a track"),
    Case("stop at a strain", "0.3 % where the patch has more", "stops and names the cell", settings={"Watchdogs/Stop at strain": 0.003},
         stops="the cell at .* of the (wheel|rail) has a strain of"),
    Case("stop at a speed", "3 m/s, which the back of the sector has", "stops and names the place", settings={"Watchdogs/Stop at node speed (m per s)": 3},
         stops="unstable: nodes move faster than 3 m/s .* of the wheel"),
    Case("stop at a residual", "1e-6 where a good run has 1e-3", "stops and says how much", settings={"Watchdogs/Stop at energy residual": 1e-6},
         stops="J of energy are not accounted for at"),
    Case("Courant number 1.02", "a step above the critical one", "is refused or stops", settings={"Time stepping/Courant number": 1.02}, stops="Courant"),
]


def edge_forces(folder):
    force = read_table(os.path.join(folder, "history.csv"))["normal_force_N"]
    least, peak = min(force) / force[0], max(force) / force[0]
    return f"least {least:.2f}, peak {peak:.2f} loads", least < 0.3 and peak > 1.1


def roll(case, folder, courant, ranks):
    """(summary or None, the line with which it stopped)"""
    settings = {**(COARSE if case.scene == SMOOTH else {}), "Time stepping/Courant number": courant, **case.settings}
    try:
        return run_scene(case.scene, folder, settings, ranks), ""
    except ProgramError as error:
        said = re.search(r"\((.*)\), see", str(error))
        return None, said[1] if said else str(error)


def residual(summary):
    """Of what was dissipated, or where next to nothing was, of the gross work."""
    if abs(summary["frictional_work_J"]) + summary["plastic_work_J"] < 1e-3 * summary["gross_work_J"]:
        return summary["energy_residual_share"]
    return summary["energy_residual_of_dissipated"]


def judge(case, summary, line, folder):
    """What came, and whether it is right."""
    if summary is None:
        return f"stops: {line}", bool(case.stops and re.search(case.stops, line))
    warned = [warning for warning in summary["warnings"] + summary["assumptions"] if case.warns and re.search(case.warns, warning)]
    if case.warns and warned:
        return f"warns: {warned[0]}", True
    if case.check is None:
        return "ends without a word", False
    came, right = case.check(summary, folder)
    return came, right and abs(residual(summary)) <= case.residual


def rows_of_case(case, results):
    """Rows of the table, and the summaries."""
    rows, summaries, one_rank = [], [], None
    for way in case.ways:
        courant, ranks = WAYS[way]
        folder = os.path.join(results, re.sub(r"\W+", "-", f"{case.name} {way}"))
        summary, line = roll(case, folder, courant, ranks)
        came, right = judge(case, summary, line, folder)
        if summary and ranks == 1:
            one_rank = summary
        elif summary and one_rank:
            worst = max(abs(summary[key] / one_rank[key] - 1) for key in ("normal_force_N", "max_pressure_Pa") if one_rank[key])
            came += f"; {worst:.0e} from one rank"
            right = right and worst <= SAME_ON_RANKS
        first = [case.name, case.hard, case.expected] if not rows else ["", "", ""]
        energy = [f"{100 * residual(summary):+.2f} %", f"{100 * summary['hourglass_of_internal_energy']:.1f} %"] if summary else ["", ""]
        rows.append([*first, way, came, *energy, "yes" if right else "**NO**"])
        print(" | ".join(rows[-1]), flush=True)
        if summary:
            summaries.append(summary)
        elif "Courant" in case.name or case.stops:  # what is refused is refused in any way
            break
    return rows, summaries


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/stability"))
    parser.add_argument("--cases", help="only these, separated by commas; the others keep their rows")
    arguments = parser.parse_args()
    wanted = arguments.cases.split(",") if arguments.cases else [case.name for case in CASES]
    for name in wanted:
        if name not in [case.name for case in CASES]:
            sys.exit(f"no case '{name}': {', '.join(case.name for case in CASES)}")
    of_case, name = {}, None
    for row in rows_of("stability.md", "stability"):
        name = row[0] or name
        of_case.setdefault(name, []).append(row)
    summaries, failed = [], False
    for case in CASES:
        if case.name in wanted:
            of_case[case.name], of_runs = rows_of_case(case, arguments.results)
            summaries += of_runs
            failed = failed or any("NO" in row[-1] for row in of_case[case.name])
    fill("stability.md", "stability", markdown(
        ["case", "what is hard", "expected", "Courant number", "came", "residual", "hourglass", "as expected"],
        [row for case in CASES for row in of_case.get(case.name, [])]) + "\n\n" + provenance("benchmarks/stability.py", summaries)
         + (" Other cases are of earlier versions." if arguments.cases else ""))
    return 1 if failed else 0


if __name__ == "__main__":
    run_command(main)
