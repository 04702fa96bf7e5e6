# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solve the cases of an input file of CONTACT by half-space theory, and roll them by finite elements.

    contrib/contact-inp.py CASE.inp --output FOLDER [--finite-elements [--cell MM] [--ranks N]] [--mat]

or python3 -m tread.contact_inp, or tread-contact-inp. In the folder are summary.csv with a row for each case, and case-1.csv,
case-2.csv, ... with the elements in contact, which the commands that read patch.csv read too. Cases of module 3: the normal problem
alone (T = 0) or steady rolling (T = 3), at given creepages or forces. A case of module 1, a wheel on a rail by their profiles, becomes
a scene, case-1.prm, with the results of tread reference in the folder case-1; its patches are rows of patches.csv, in CONTACT's axes
and signs. What else a file asks for is refused in one line with its place; the cases before it are solved.

--finite-elements rolls each case besides, by the scene case-1-finite-elements.prm: both tables have its answers in rows of their own, whose
column "method" says so, in the same axes and signs. Of module 3 those cases are rolled whose gap is that of an upright wheel on a rail
with a crown, A x^2 + B y^2; others are refused. --mat writes the elements of the half-space in the layout of CONTACT's matlab files too,
CASE.0001.mat, of module 1 CASE.0001a.mat, CASE.0001b.mat for its patches.
"""

from __future__ import annotations

import csv
import dataclasses
import math
import os
from collections.abc import Iterable, Iterator

import numpy as np

from . import half_space
from .commands import command_parser, run_command
from .contact_cases import EXCLUDED, Case, Reader, Words
from .contact_mat import mat_path, write_mat_of_case, write_mats_of_track_case
from .contact_rolled import roll_track_case, roll_upright, upright_wheel
from .contact_track import PATCH, TrackCase, TrackReader, solve_track_case
from .files import DataError
from .runs import PROGRAM, ProgramError, Run

# Of friction times load, and of the approach.
FORCE_TOLERANCE, APPROACH_TOLERANCE = 1e-7, 1e-9
STEPS = 40

HALF_SPACE, FINITE_ELEMENTS = "half-space", "finite elements"

SUMMARY = ("case", "line", "normal_force_N", "longitudinal_force_N", "lateral_force_N", "spin_moment_Nm", "friction_coefficient",
           "creepage", "lateral_creepage", "spin_per_m", "approach_mm", "max_pressure_MPa", "patch_area_mm2", "adhesion_share",
           "max_shear_MPa", "max_slip_m_per_s", "frictional_power_W", "frictional_power_of_elements_W", "element_x_mm", "element_y_mm", "reaches_border")
ELEMENTS = ("x_mm", "y_mm", "pressure_MPa", "shear_x_MPa", "shear_y_MPa", "slip_x_m_per_s", "slip_y_m_per_s", "state")


def cases_of(path: str) -> Iterator[Case | TrackCase]:
    """The cases of a file one after the other. @raises DataError, in one line with file, line and option, for what is wrong or not
    available"""
    words = Words(path)
    readers = {1: TrackReader(words), 3: Reader(words)}
    number_of_case = 0
    while words.at < len(words.lines):
        module = words.read("i", "a module number")[0]
        if module == 0:
            break
        if module not in readers:
            raise words.refuse(f"no module {module}; modules are 1, 3 and 0 for the end")
        stays = True
        while stays:
            number_of_case += 1
            stays = readers[module].one_case(number_of_case)
            yield readers[module].result()
    if not number_of_case:
        raise words.refuse("there is no case", line=max(words.line, 1))


def read_cases(path: str) -> list[Case | TrackCase]:
    """All cases of a file. @raises DataError"""
    return list(cases_of(path))


class _Problem:
    """A case on its elements, with a ring of elements around them that never touch: CONTACT ends contact at the border, the library
    refuses a patch that reaches it. A case that rolls towards -x is solved as its mirror image."""

    def __init__(self, case: Case):
        self.case, area = case, case.area
        self.mirror = -1. if case.backwards else 1.
        gap = case.gap[:, ::-1] if case.backwards else case.gap
        self.common = {
            "gap": np.pad(gap, 1, constant_values=EXCLUDED), "element_x": area.element_x, "element_y": area.element_y,
            "x_first": (-area.x[-1] if case.backwards else area.x_first) - area.element_x, "y_first": area.y_first - area.element_y,
            "young": 2. * (1. + case.poisson) * case.shear_modulus, "poisson": case.poisson, "slip_order": 1}
        self.normal_force = case.normal_force

    def normal(self, force: float) -> dict:
        """Answers of the normal problem alone, under a force (N)."""
        return half_space.solve_patch(normal_force=force, friction=0., **self.common)

    def rolling(self, creepage: float, lateral_creepage: float) -> dict:
        """Answers at creepages of the file's axes. The slip of CONTACT is that at x - spin_x + spin_step elements."""
        case, common = self.case, self.common
        along = creepage + case.spin * case.spin_y
        across = lateral_creepage - case.spin * (case.spin_x - self.mirror * case.spin_step * common["element_x"])
        return half_space.solve_patch(normal_force=self.normal_force, friction=case.friction, creepage=self.mirror * along,
                                      lateral_creepage=across, spin=self.mirror * case.spin, **common)

    def forces(self, answer: dict) -> np.ndarray:
        """(2,) forces over friction times load, in the file's axes."""
        return np.array([self.mirror * answer["longitudinal_force"], answer["lateral_force"]]) / (self.case.friction * self.normal_force)


def _load_of_approach(problem: _Problem) -> float:
    """Force (N) whose approach is the given one, by secants of the logarithms."""
    case, common = problem.case, problem.common
    depth = case.approach - case.gap.min()
    overlap = np.count_nonzero(case.gap < case.approach) * common["element_x"] * common["element_y"]
    if not overlap:
        raise DataError(f"PEN leaves the bodies apart; no element overlaps")
    force = case.shear_modulus / (1. - case.poisson) * depth * math.sqrt(overlap / math.pi)
    points: list[tuple[float, float]] = []
    for _ in range(STEPS):
        found = problem.normal(force)["approach"] - case.gap.min()
        if abs(found / depth - 1.) < APPROACH_TOLERANCE:
            return force
        points = [*points[-1:], (math.log(force), math.log(found))]
        slope = (points[1][0] - points[0][0]) / (points[1][1] - points[0][1]) if len(points) == 2 and points[0][1] != points[1][1] else 1.5
        force *= math.exp(slope * (math.log(depth) - math.log(found)))
    raise DataError(f"no force was found for PEN")


def _stretched(share: np.ndarray) -> np.ndarray:
    """Of forces over friction times load, what grows nearly linearly with the creepages (Vermeulen & Johnson 1964)."""
    size = float(np.hypot(*share))
    return share if size < 1e-9 else share / size * (1. - np.cbrt(max(1. - size, 0.)))


def _creepages_of_forces(problem: _Problem) -> tuple[float, float]:
    """Creepages at which the forces are the given ones, by Broyden's method on stretched forces."""
    case = problem.case
    n = case.forces
    target = np.array([case.longitudinal_share, case.lateral_share])
    unknown = np.arange(n)
    # Where FX alone is given FY is free: only what FX says is compared.
    stretched = lambda share: _stretched(np.where(np.arange(2) < n, share, 0.))[:n]
    pressure = problem.normal(problem.normal_force)["max_pressure"]
    scale = 2. * case.friction * pressure * (1. - case.poisson) / case.shear_modulus  # about that of full sliding
    creepages = np.array([case.creepage, case.lateral_creepage])
    slope = -np.eye(n) / scale
    creepages[unknown] = np.linalg.solve(slope, stretched(target))
    before = None
    for _ in range(STEPS):
        share = problem.forces(problem.rolling(*creepages))
        if np.abs(share - target)[:n].max() < FORCE_TOLERANCE:
            return float(creepages[0]), float(creepages[1])
        value = stretched(share)
        if before is not None:
            step = creepages[unknown] - before[0]
            slope += np.outer(value - before[1] - slope @ step, step) / (step @ step)
        before = creepages[unknown].copy(), value
        creepages[unknown] += np.linalg.solve(slope, stretched(target) - value)
    raise DataError(f"no creepage was found for {'FX, FY' if n == 2 else 'FX'}")


def solve_case(case: Case) -> dict:
    """Solve a case of module 3.

    Returns {name: value}: those of SUMMARY, in their units, and x (n_x,), y (n_y,) in m with (n_y, n_x) arrays pressure, shear_x, shear_y
    (Pa, on body 1), slip_x, slip_y (of body 1 over body 2, over the speed), state (0: no contact, 1: adhesion, 2: slip), all in
    the axes of the file. Raises DataError, HalfSpaceError.
    """
    problem, area = _Problem(case), case.area
    if case.normal_force is None:
        problem.normal_force = _load_of_approach(problem)
    creepage, lateral_creepage = case.creepage, case.lateral_creepage
    if not case.tangential:
        answer = problem.normal(problem.normal_force)
        answer["state"] = np.minimum(answer["state"], 1.)  # as CONTACT names it
        answer["adhesion_share"] = 1.
    else:
        if case.forces:
            creepage, lateral_creepage = _creepages_of_forces(problem)
        answer = problem.rolling(creepage, lateral_creepage)
    fields = {}
    for name in half_space.FIELDS:
        values = answer[name][1:-1, 1:-1]
        fields[name] = values[:, ::-1] if case.backwards else values
        if name in ("shear_x", "slip_x"):
            fields[name] = problem.mirror * fields[name]
    contact = fields["state"] > 0.
    border = contact[[0, -1], :].any() and area.n_y > 1 or contact[:, [0, -1]].any() and area.n_x > 1
    element = area.element_x * area.element_y
    x, y = area.x, area.y[:, None]
    longitudinal, lateral = problem.mirror * answer["longitudinal_force"], answer["lateral_force"]
    moment = float((x * fields["shear_y"] - y * fields["shear_x"]).sum() * element)
    # By forces and creepages, which is nearer to its limit than CONTACT's sum over the elements.
    power = -case.speed * (creepage * longitudinal + lateral_creepage * lateral
                           + case.spin * (moment - case.spin_x * lateral + case.spin_y * longitudinal))
    of_elements = -case.speed * element * (fields["shear_x"] * fields["slip_x"] + fields["shear_y"] * fields["slip_y"]).sum()
    return {
        "case": case.number, "line": case.line, "normal_force_N": problem.normal_force,
        "longitudinal_force_N": longitudinal, "lateral_force_N": lateral, "spin_moment_Nm": moment,
        "friction_coefficient": case.friction, "creepage": creepage, "lateral_creepage": lateral_creepage, "spin_per_m": case.spin,
        "approach_mm": 1e3 * answer["approach"], "max_pressure_MPa": 1e-6 * fields["pressure"].max(), "patch_area_mm2": 1e6 * answer["area"],
        "adhesion_share": answer["adhesion_share"], "max_shear_MPa": 1e-6 * np.hypot(fields["shear_x"], fields["shear_y"]).max(),
        "max_slip_m_per_s": case.speed * np.hypot(fields["slip_x"], fields["slip_y"])[contact].max(),
        "frictional_power_W": power + 0., "frictional_power_of_elements_W": of_elements + 0., "element_x_mm": 1e3 * area.element_x, "element_y_mm": 1e3 * area.element_y,
        "reaches_border": bool(border), "x": area.x, "y": area.y, **fields}


def _write_csv(path: str, header: tuple[str, ...], rows: Iterable[Iterable]) -> None:
    with open(path + ".part", "w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([[f"{value:.9g}" if isinstance(value, float) else value for value in row] for row in rows])
    os.replace(path + ".part", path)


def write_elements(path: str, case: Case, result: dict) -> None:
    """The elements in contact, in the columns of patch.csv."""
    rows, columns = np.nonzero(result["state"])
    units = {"pressure": 1e-6, "shear_x": 1e-6, "shear_y": 1e-6, "slip_x": case.speed, "slip_y": case.speed}
    values = [1e3 * result["x"][columns], 1e3 * result["y"][rows], *(unit * result[name][rows, columns] for name, unit in units.items())]
    states = np.where(result["state"][rows, columns] == 1., "adhesion", "slip")
    _write_csv(path, ELEMENTS, zip(*(value.tolist() for value in values), states.tolist()))


@dataclasses.dataclass
class Job:
    """What is made of the cases of a file."""

    input: str
    folder: str
    program: str = PROGRAM
    finite_elements: bool = False
    cell: float | None = None  # mm; None: by the patch
    ranks: int = 1
    mat: bool = False
    summary: list[list] = dataclasses.field(default_factory=list)  # rows of summary.csv
    patches: list[list] = dataclasses.field(default_factory=list)  # rows of patches.csv

    @property
    def name(self) -> str:
        """Of the input, without its ending."""
        return os.path.splitext(os.path.basename(self.input))[0]

    def solve(self, case: Case | TrackCase) -> Iterator[tuple[str, str]]:
        """Solve a case and write what belongs to it. Yields (method, what is printed of it)."""
        os.makedirs(self.folder, exist_ok=True)
        own = os.path.join(self.folder, f"case-{case.number}")
        title = f"{os.path.basename(self.input)}, case {case.number}"
        yield from self.solve_track(case, own, title) if isinstance(case, TrackCase) else self.solve_basic(case, own, title)

    def solve_track(self, case: TrackCase, own: str, title: str) -> Iterator[tuple[str, str]]:
        """A case of module 1."""
        run, patches = solve_track_case(case, own, title, self.program)
        if self.mat:
            write_mats_of_track_case(self.folder, self.name, case, run)
        yield HALF_SPACE, self.add_patches(case, HALF_SPACE, patches)
        if self.finite_elements:
            rolled, patches = roll_track_case(case, run, own + "-finite-elements", self.cell, title, self.ranks, self.program)
            yield FINITE_ELEMENTS, self.add_patches(case, FINITE_ELEMENTS, patches)
            yield from self.warnings(rolled)

    def add_patches(self, case: TrackCase, method: str, patches: list[dict[str, float]]) -> str:
        """Rows of patches.csv. @returns what is printed"""
        self.patches += [[case.number, case.line, case.side, method, number, *patch.values()] for number, patch in enumerate(patches, 1)]
        header = ("case", "line", "side", "method", "patch", *(name for name, _, _ in PATCH))
        _write_csv(os.path.join(self.folder, "patches.csv"), header, self.patches)
        return "; ".join(f"FN {patch['normal_force_N']:.6g} N, FX {patch['longitudinal_force_N']:.6g} N, "
                         f"FS {patch['lateral_force_N']:.6g} N, largest pressure {patch['max_pressure_MPa']:.6g} MPa" for patch in patches)

    def solve_basic(self, case: Case, own: str, title: str) -> Iterator[tuple[str, str]]:
        """A case of module 3."""
        result = solve_case(case)
        scene = upright_wheel(case, result, self.cell) if self.finite_elements else None
        write_elements(own + ".csv", case, result)
        if self.mat:
            write_mat_of_case(mat_path(self.folder, self.name, case.number), case, result)
        border = "; the patch reaches the border of the potential contact area" if result["reaches_border"] else ""
        yield HALF_SPACE, self.add_summary(HALF_SPACE, result) + border
        if scene:
            rolled, result = roll_upright(case, result, scene, own + "-finite-elements", title, self.ranks, self.program)
            yield FINITE_ELEMENTS, self.add_summary(FINITE_ELEMENTS, result)
            yield from self.warnings(rolled)

    def add_summary(self, method: str, result: dict) -> str:
        """A row of summary.csv. @returns what is printed"""
        self.summary.append([method, *(result[name] for name in SUMMARY)])
        _write_csv(os.path.join(self.folder, "summary.csv"), ("method", *SUMMARY), self.summary)
        return (f"FN {result['normal_force_N']:.6g} N, FX {result['longitudinal_force_N']:.6g} N, FY {result['lateral_force_N']:.6g} N, "
                f"creepages {result['creepage']:.6g} {result['lateral_creepage']:.6g}, "
                f"largest pressure {result['max_pressure_MPa']:.6g} MPa")

    @staticmethod
    def warnings(rolled: Run) -> Iterator[tuple[str, str]]:
        """Lines with what a rolled case warns of."""
        for warning in rolled.summary["warnings"]:
            yield FINITE_ELEMENTS, f"warning: {warning}"


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("input", metavar="CASE.inp")
    parser.add_argument("--output", required=True, metavar="FOLDER", help="of the results; it is made if it is not there")
    parser.add_argument("--finite-elements", action="store_true", help="roll the cases besides, in seconds to minutes each")
    parser.add_argument("--cell", type=float, metavar="MM", help="edge of the finest cells (a fifth of the patch's smaller half length)")
    parser.add_argument("--ranks", type=int, metavar="N", help="MPI processes of a rolled case (1)")
    parser.add_argument("--mat", action="store_true", help="write the elements in the layout of CONTACT's matlab files, too")
    parser.add_argument("--program", default=PROGRAM, help="tread itself, for module 1 and finite elements")
    arguments = parser.parse_args()
    for name, value in (("--cell", arguments.cell), ("--ranks", arguments.ranks)):
        if value is not None and not arguments.finite_elements:
            parser.error(f"{name} needs --finite-elements")
        if value is not None and not value > 0:
            parser.error(f"{name} must be above 0")
    job = Job(arguments.input, arguments.output, arguments.program, arguments.finite_elements, arguments.cell, arguments.ranks or 1,
              arguments.mat)
    for case in cases_of(arguments.input):
        if not case.solved:
            print(f"case {case.number}: only read (R = 2 or 3)")
            continue
        try:
            for method, said in job.solve(case):
                print(f"case {case.number}{', ' + method if job.finite_elements else ''}: {said}", flush=True)
        except (DataError, ProgramError, half_space.HalfSpaceError) as error:
            raise DataError(f"{arguments.input}, line {case.line}: case {case.number}: {error}") from None


def command_line() -> None:
    """What contrib/contact-inp.py and tread-contact-inp do."""
    run_command(main)


if __name__ == "__main__":
    command_line()
