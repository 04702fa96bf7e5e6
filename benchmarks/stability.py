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
from tread.runs import ROOT, ProgramError, version_of
from tread.tables import fill, markdown, provenance, rows_of

SMOOTH, DIP = "smooth-rolling.prm", "tutorial/dip.prm"
COARSE = {"Mesh/Finest cell (mm)": 1.3, "Motion/Rolled distance (mm)": 15, "Output/Write volume": "false"}
WAYS = {"0.5": (0.5, 1), "0.95": (0.95, 1), "0.95, 3 ranks": (0.95, 3)}  # Courant number, ranks
SAME_ON_RANKS = 1e-5  # of the load and of the largest pressure
RESIDUAL = 0.05  # of what was dissipated, where friction or yielding dissipates; else of the gross work
WARNED_RESIDUAL = 0.02  # the default of 'Watchdogs/Energy residual': above it a run must say so itself


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
    same_on_ranks: float = SAME_ON_RANKS
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


def like_one_level(case_settings):
    """Plastic work, settlement and stress that stays, beside those of the same run with one level."""
    def check(summary, folder):
        twin = folder + "-one-level"
        one = run_scene(SMOOTH, twin, {**COARSE, **case_settings, "Time stepping/Levels": 1}, 1)
        last, of_twin = (read_table(os.path.join(path, "passages.csv")) for path in (folder, twin))
        work = 100 * (summary["plastic_work_J"] / one["plastic_work_J"] - 1)
        worst = max(100 * abs(last[key][-1] / of_twin[key][-1] - 1) for key in ("settlement_um", "residual_von_mises_MPa"))
        return f"settlement and stress within {worst:.2f} %, plastic work {work:+.1f} %", worst <= 0.5 and abs(work) <= 1.
    return check


def leaves_the_rail(least_peak):
    """Lifts off and lands: no force at some time, and later a peak of so many loads."""
    def check(summary, folder):
        force = read_table(os.path.join(folder, "history.csv"))["normal_force_N"]
        static = force[0]
        peak = max(force) / static
        return f"least {min(force) / static:.2f}, peak {peak:.2f} loads", min(force) < 0.02 * static and peak > least_peak
    return check


def flies(longest, allowed):
    """Time without force (s), allowed below the longest as a share, and a harder landing than standing."""
    def check(summary, _):
        found = summary["airborne_s"]
        return f"{1e3 * found:.3f} ms in the air, peak {summary['largest_normal_force_over_static']:.2f} loads", \
            1 - allowed <= found / longest <= 1 and summary["largest_normal_force_over_static"] > 1.2
    return check


LOAD = 14300 * 9.81  # N, of the smooth scene
TRACK_LOAD = 116.8e3  # N, of the tutorial's track
SOFT = {"Rail/Tangent modulus (GPa)": 0.1, "Mesh/Fine half width (mm)": 14}
SMALL = {"Wheel/Radius (mm)": 50, "Wheel/Mass (kg)": 20, "Wheel/Moment of inertia (kg m2)": 0.1, "Vehicle/Wheel load (kN)": 5, "Wheel/Sector thickness (mm)": 20,
         "Wheel/Sector margin (mm)": 12, "Motion/Speed (km per h)": 40}
FALLING = {"Contact/Friction law": "falling", "Contact/Friction memory (mm)": 0.3, "Motion/Creepage": 0.1}
RESIDUAL_STRESS = {"Motion/Passages": 2, "Rail/Yield stress (MPa)": 500, "Wheel/Yield stress (MPa)": 500, "Time stepping/Levels": 3}
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
    Case("falling friction, no memory", "from 0.5 to 0.2 at once: slip begins to oscillate by itself", "a warning", settings={**FALLING, "Contact/Friction memory (mm)": 0}, warns="chatters",
         same_on_ranks=3e-3),  # rounding decides about single oscillations
    Case("falling friction", "the same after 0.3 mm of slip, at a creepage of 0.1", "traction of the half-space within 2 %: twice its own uncertainty", settings=FALLING,
         check=against("traction_coefficient", "half-space", 2.)),
    Case("locked wheel", "creepage -1", "is refused", settings={"Motion/Creepage": -1}, stops="allowed: .* from -0.2 to 0.2"),
    Case("reversed", "rolls backwards", "is refused", settings={"Motion/Speed (km per h)": -140}, stops="allowed: 0 to 1000"),
    Case("standing", "speed 0", "is refused", settings={"Motion/Speed (km per h)": 0}, stops="a wheel that stands does not roll"),
    Case("1 km/h", "14 000 steps for 4 mm", "pressure of the half-space within 4 %", settings={
        "Motion/Speed (km per h)": 1, "Motion/Rolled distance (mm)": 4}, check=PRESSURE),
    Case("500 km/h", "inertia and the speed of waves", "pressure of the half-space within 4 %", settings={
        "Motion/Speed (km per h)": 500, "Scene/Density scale": 1}, check=PRESSURE),
    Case("soft wheel", "Young's moduli 1:10: the patch outgrows the crown's radius", "pressure of the half-space within 4 %", settings={
        "Wheel/Young's modulus (GPa)": 21, "Wheel/Sector thickness (mm)": 120, "Scene/Density scale": 4, "Motion/Traction coefficient": 0, "Motion/Creepage": 0, "Wheel/Sector margin (mm)": 60,
        "Rail/Margin (mm)": 60}, check=PRESSURE),
    Case("rubber wheel", "Young's moduli 1:100: the patch outgrows head and sector", "stops and says why", settings={
        "Wheel/Young's modulus (GPa)": 2.1, "Scene/Density scale": 1, "Motion/Traction coefficient": 0, "Motion/Creepage": 0}, stops="'Rail/Margin .mm.' 60 lets the wheel leave the rail"),
    Case("nu 0.49, one-point", "nearly incompressible", "pressure of Hertz within 4 %", settings={
        "Wheel/Poisson's ratio": 0.49, "Rail/Poisson's ratio": 0.49, "Motion/Traction coefficient": 0, "Motion/Creepage": 0},
         check=against("max_pressure_Pa", "Hertz", 4.)),
    Case("nu 0.49, fully integrated", "such cells lock: the pressure would be 33 % too high", "is refused", settings={
        "Wheel/Poisson's ratio": 0.49, "Solid/Element": "fully-integrated"}, stops="locks"),
    Case("nu 0.45, fully integrated", "on the verge of locking, with levels", "pressure of Hertz within 5 %", settings={
        "Wheel/Poisson's ratio": 0.45, "Rail/Poisson's ratio": 0.45, "Solid/Element": "fully-integrated", "Motion/Traction coefficient": 0,
        "Motion/Creepage": 0}, check=against("max_pressure_Pa", "Hertz", 5.)),
    Case("nearly no hardening, driving", "flow at 300 MPa, tangent modulus 0.1 GPa: 0.3 of the load over Hertz's patch is 277 MPa of shear, the steel yields at 173",
         "stops and names the cell", settings={**SOFT, "Rail/Yield stress (MPa)": 300}, stops="of the rail has a strain of"),
    Case("nearly no hardening", "the same at 400 MPa, 0.43 of the mean pressure, without traction: the wheel sinks as it rolls", "carries the load within 5 %, and says that the wheel still sinks", settings={
        **SOFT, "Rail/Yield stress (MPa)": 400, "Motion/Traction coefficient": 0, "Motion/Creepage": 0}, check=load(LOAD, 5.), warns="contact carries"),
    Case("both flow", "the same steel in wheel and rail", "carries the load within 3 %, or says that it cannot", settings={
        "Rail/Yield stress (MPa)": 300, "Rail/Tangent modulus (GPa)": 0.1, "Wheel/Yield stress (MPa)": 300, "Wheel/Tangent modulus (GPa)": 0.1,
        "Mesh/Fine half width (mm)": 14}, check=load(LOAD, 3.), stops="no equilibrium|leaves what is meshed|has folded"),
    Case("yield at a tenth", "flow at 140 MPa, a tenth of the pressure", "carries the load within 5 %, and says that the wheel still sinks", settings={
        "Rail/Yield stress (MPa)": 140, "Mesh/Fine half width (mm)": 14}, check=load(LOAD, 5.), warns="contact carries"),
    Case("levels over residual stress", "the second wheel rolls on stress that the first one left, with three levels", "settlement and stress of one level within 0.5 %, plastic work within 1 %",
         settings=RESIDUAL_STRESS, check=like_one_level(RESIDUAL_STRESS)),
    *(Case(f"{levels} levels", "no scaled density, no mass damping", "pressure of the half-space within 4 %", settings={
        "Scene/Density scale": 1, "Scene/Quasi-static": "false", "Solid/Mass damping (1 per s)": 0, "Time stepping/Levels": levels},
           check=PRESSURE) for levels in (1, 2, 3, 4, 5, 6)),
    Case("density times 100", "an inertia error of 1.7 %", "pressure of the half-space within 4 %", settings={"Scene/Density scale": 100}, check=PRESSURE),
    Case("density times 100, 200 km/h", "an inertia error of 3.5 %", "is refused", settings={
        "Scene/Density scale": 100, "Motion/Speed (km per h)": 200}, stops="inertia error"),
    Case("small wheel", "100 mm, 5 kN", "pressure of the half-space within 2 %", settings={**SMALL, "Mesh/Finest cell (mm)": 0.35, "Motion/Rolled distance (mm)": 6},
         check=against("max_pressure_Pa", "half-space", 2.)),
    Case("cells of 0.2 mm", "the same wheel, four cells to the shorter semi-axis", "pressure of the half-space within 2 %", settings={
        **SMALL, "Mesh/Finest cell (mm)": 0.2, "Motion/Rolled distance (mm)": 3}, check=against("max_pressure_Pa", "half-space", 2.)),
    Case("large wheel", "2000 mm", "pressure of the half-space within 4 %", settings={"Wheel/Radius (mm)": 1000}, check=PRESSURE),
    Case("light wheel", "nothing rests on 50 kg of wheel", "pressure of the half-space within 2 %", settings={
        "Wheel/Mass (kg)": 50, "Wheel/Moment of inertia (kg m2)": 5, "Vehicle/Wheel load (kN)": 30, "Mesh/Finest cell (mm)": 0.8,
        "Motion/Rolled distance (mm)": 10}, check=against("max_pressure_Pa", "half-space", 2.)),
    Case("hourglass 0.01", "modes without stiffness", "pressure within 4 %, or a warning", settings={"Solid/Hourglass coefficient": 0.01}, check=PRESSURE),
    Case("hourglass 10", "modes far too stiff", "a warning", settings={"Solid/Hourglass coefficient": 10}, warns="ourglass"),
    Case("mass damping 1e5", "motion is held back", "a warning", settings={"Solid/Mass damping (1 per s)": 1e5}, warns="damping",
         residual=0.06),  # power that fades in 25 steps is sampled every 50: the error falls with the square of the step
    Case("thin sector", "3 mm of wheel", "says so", settings={"Wheel/Sector thickness (mm)": 3, "Mesh/Fine layers": 1}, warns="thick"),
    Case("off the fine zone", "the patch flows beyond the finest cells", "stops and says where", settings={
        "Rail/Yield stress (MPa)": 100, "Rail/Tangent modulus (GPa)": 0.5, "Mesh/Fine half width (mm)": 9}, stops="leaves what is meshed"),
    Case("torque above friction", "the wheel would spin up", "is refused", settings={
        "Motion/Drive": "torque", "Motion/Traction coefficient": 0.6, "Motion/Hold distance (mm)": 5}, stops="below 'Contact/Friction coefficient'"),
    Case("dip at 300 km/h", "5 mm deep, 100 mm long: flies and lands", "no force for a time, then more than two loads", scene=DIP, settings={
        "Defect/Depth (mm)": 5, "Defect/Length (mm)": 100, "Defect/Width (mm)": 40, "Motion/Speed (km per h)": 300, "Motion/Rolled distance (mm)": 200,
        "Defect/Position (mm)": -160, "Mesh/Fine to (mm)": 150, "Mesh/Fine half width (mm)": 16, "Output/Write volume": "false"}, check=leaves_the_rail(2.)),
    Case("sharp edge at 200 km/h", "0.5 mm deep, 20 mm long, kinks at its ends", "the wheel bridges it: the force falls below 0.3 and rises above 1.1 loads",
         scene=DIP, settings={"Defect/Depth (mm)": 0.5, "Defect/Length (mm)": 20, "Motion/Speed (km per h)": 200,
                                             "Output/Write volume": "false"},
         check=lambda summary, folder: edge_forces(folder)),
    Case("gap at 200 km/h", "1 mm deep and 40 mm in diameter: the wheel flies over it and lands on its edge", "at most 0.316 ms in the air and 10 % less, then above 1.2 loads", scene=DIP, settings={
        "Defect/Depth (mm)": 1, "Defect/Length (mm)": 40, "Defect/Width (mm)": 40, "Motion/Speed (km per h)": 200, "Output/Write volume": "false"},
         check=flies(0.316e-3, 0.1)),
    Case("slivers", "rail cells of 147 x 15 x 5 mm before and behind the path", "pressure of the half-space within 4 %", scene=DIP, settings={
        "Defect/Shape": "none", "Mesh/Longest row (mm)": 1000, "Rail/Margin (mm)": 500, "Motion/Rolled distance (mm)": 30, "Output/Write volume": "false"}, check=PRESSURE),
    Case("a million steps", "error that adds up, at 1 km/h with the true density", "force steady to 0.1 %, what a ripple of 2 % leaves in its means; traction 0.300 within 0.006", settings={
        "Mesh/Finest cell (mm)": 2.6, "Motion/Speed (km per h)": 1, "Scene/Density scale": 1, "Motion/Rolled distance (mm)": 96,
        "Output/History interval (mm)": 0.5}, check=steady(0.1), ways=("0.95",)),
    Case("soft ballast and stiff pads", "2 and 3000 MN/m", "carries the load within 1 %", scene="tutorial/track.prm", settings={
        "Track/Ballast stiffness (MN per m)": 2, "Track/Pad stiffness (MN per m)": 3000, "Motion/Rolled distance (mm)": 20},
         check=load(TRACK_LOAD, 1.), ways=("0.95", "0.95, 3 ranks")),
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
    words = summary["warnings"] + summary["assumptions"]
    warned = [word for word in words if case.warns and re.search(case.warns, word)]
    energy = abs(residual(summary))
    right = energy <= case.residual and (energy <= WARNED_RESIDUAL or any("not accounted for" in word for word in words))
    came = []
    if case.check:
        found, as_expected = case.check(summary, folder)
        came.append(found)
        right = right and as_expected
    if warned:
        came.append(f"warns: {warned[0]}")
    if energy > WARNED_RESIDUAL:
        came.append("warns of the residual" if any("not accounted for" in word for word in words) else "says nothing of the residual")
    return "; ".join(came) or "ends without a word", right and bool(case.check or warned)


def hash_in(version):
    """What is in brackets: "0.1.0 (5d3a853)"."""
    found = re.search(r"\((.*)\)", version or "")
    return found[1] if found else "unknown"


def rows_of_case(case, results, ways):
    """{way: cells of the table} and the summaries."""
    rows, summaries = {}, []
    folder_of = lambda way: os.path.join(results, re.sub(r"\W+", "-", f"{case.name} {way}"))
    for way in [way for way in case.ways if way in ways]:
        courant, ranks = WAYS[way]
        summary, line = roll(case, folder_of(way), courant, ranks)
        came, right = judge(case, summary, line, folder_of(way))
        if summary and ranks > 1:
            one_rank, _ = roll(case, folder_of(str(courant)), courant, 1)
            worst = max(abs(summary[key] / one_rank[key] - 1) for key in ("normal_force_N", "max_pressure_Pa") if one_rank[key])
            came += f"; {worst:.0e} from one rank"
            right = right and worst <= case.same_on_ranks
        shares = [f"{100 * share:+.2f} %" if i == 0 else f"{100 * share:.1f} %" for i, share in enumerate(
            (residual(summary), summary["hourglass_of_internal_energy"], summary["slip_chatter_share"]))] if summary else ["", "", ""]
        rows[way] = [came, *shares, "yes" if right else "**NO**", hash_in(summary["version"] if summary else version_of())]
        print(" | ".join([case.name, way, *rows[way]]), flush=True)
        if summary:
            summaries.append(summary)
        elif case.stops:  # what is refused is refused in any way
            break
    return rows, summaries


def rows_on_the_page():
    """{(case, way): cells} as they are."""
    rows, name = {}, None
    for row in rows_of("stability.md", "stability"):
        name = row[0] or name
        rows[name, row[3]] = row[4:]
    return rows


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/stability"))
    parser.add_argument("--cases", help="only these, separated by semicolons; the others keep their rows")
    parser.add_argument("--ways", help=f"only these, of {'; '.join(WAYS)}; the others keep their rows")
    arguments = parser.parse_args()
    wanted = [name.strip() for name in arguments.cases.split(";")] if arguments.cases else [case.name for case in CASES]
    for name in wanted:
        if name not in [case.name for case in CASES]:
            sys.exit(f"no case '{name}': {'; '.join(case.name for case in CASES)}")
    ways = [way.strip() for way in arguments.ways.split(";")] if arguments.ways else list(WAYS)
    for way in ways:
        if way not in WAYS:
            sys.exit(f"no way '{way}': {'; '.join(WAYS)}")
    made, summaries = {}, []
    for case in CASES:
        if case.name in wanted:
            of_case, of_runs = rows_of_case(case, arguments.results, ways)
            made.update({(case.name, way): row for way, row in of_case.items()})
            summaries += of_runs
    kept = {key: row for key, row in rows_on_the_page().items() if key[0] not in wanted or ways != list(WAYS)}
    rows = {**kept, **made}
    table = []
    for case in CASES:
        first = [case.name, case.hard, case.expected]
        for way in case.ways:
            if (case.name, way) in rows:
                table.append([*first, way, *rows[case.name, way]])
                first = ["", "", ""]
    fill("stability.md", "stability", markdown(
        ["case", "what is hard", "expected", "Courant number", "came", "residual", "hourglass", "chatter", "as expected", "version"], table)
         + "\n\n" + provenance("benchmarks/stability.py", summaries))
    failed = [row for row in table if "NO" in row[-2]]
    return 1 if failed else 0


if __name__ == "__main__":
    run_command(main)
