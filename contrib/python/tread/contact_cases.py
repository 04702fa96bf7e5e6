# SPDX-License-Identifier: LGPL-2.1-or-later
"""Read input files of CONTACT (E. Vollebregt, github.com/eve70a/CONTACT, versions 23 to 25): the words of a file, and module 3, basic
contact. contact_track.py reads module 1, contact_inp.py whole files.

What such a file says is kept from one case to the next, as CONTACT does, unless a control digit announces new values. Lengths in a
file are in mm, forces in N, stresses in MPa, angles in rad or, with a d, in degrees. Cases are in SI.
"""

from __future__ import annotations

import dataclasses
import math
import re

import numpy as np

from . import hertz
from .files import DataError

# CONTACT neglects what different bodies do to each other's shear below this difference parameter.
LIKE_BODIES = 1e-4
# Elements that CONTACT's planform excludes have a gap of so many metres.
EXCLUDED = 1.

# Control digits of the three lines, from the right.
DIGITS = (("S", "F", "N", "T", "B", "P", "CONFIG"), ("E", "Z", "M", "C", "D", "L", "V"), ("R", "W", "O", "A", "I", "G", "H", "X"))
LARGEST = {"CONFIG": 9, "P": 3, "B": 6, "T": 3, "N": 1, "F": 2, "S": 3, "V": 3, "L": 6, "D": 2, "C": 9, "M": 5, "Z": 2, "E": 9,
           "H": 3, "G": 5, "I": 3, "A": 2, "O": 6, "W": 9, "R": 3, "X": 1}
# What the half-space library does not have, by digit and value.
REFUSED = {
    "T": {1: "a shift without rolling", 2: "transient rolling"},
    "B": {1: "a thin sheet between the bodies", 2: "a traction bound by Hertz's ellipse", 3: "a parabolic traction bound",
          4: "the SDEC pressure", 5: "the KPEC pressure", 6: "the ANALYN pressure"},
    "S": {1: "subsurface stress", 2: "subsurface stress", 3: "subsurface stress"},
    "V": {1: "friction that varies over the surface", 2: "friction that varies over the rows", 3: "friction that varies over the rows"},
    "L": {2: "friction falling linearly with slip", 3: "friction falling rationally with slip", 4: "friction falling exponentially with slip",
          5: "an unknown friction law", 6: "friction that depends on temperature"},
    "C": {3: "bilinear elements", 4: "influence coefficients of conformal contact", 5: "unknown influence coefficients",
          6: "unknown influence coefficients", 7: "unknown influence coefficients", 8: "unknown influence coefficients",
          9: "influence coefficients from a file"},
    "M": {1: "viscoelastic bodies", 2: "FASTSIM with one flexibility", 3: "FASTSIM with three flexibilities",
          4: "an interface layer", 5: "an interface with damping"},
    "E": {**{value: "an unknown slip term" for value in range(2, 9)}, 9: "an extra slip of each element"},
    "H": {1: "temperature", 2: "temperature", 3: "temperature"},
}
HERTZ = {-1: "A1, B1", -2: "A1, AOB", -3: "AA, BB"}
REFUSED_AREAS = {-4: "a line contact by its curvature", -5: "a line contact by its half length", -6: "the SDEC geometry"}


@dataclasses.dataclass
class Area:
    """Potential contact area: n_x by n_y elements; the first one has its centre at (x_first, y_first). m."""

    n_x: int
    n_y: int
    x_first: float
    y_first: float
    element_x: float
    element_y: float

    @property
    def x(self) -> np.ndarray:
        """(n_x,) centres, m."""
        return self.x_first + self.element_x * np.arange(self.n_x)

    @property
    def y(self) -> np.ndarray:
        """(n_y,) centres, m."""
        return self.y_first + self.element_y * np.arange(self.n_y)


@dataclasses.dataclass
class Case:
    """A case of module 3 in SI units; signs are CONTACT's, which are those of tread.half_space."""

    number: int = 0
    line: int = 0  # of its first control digits
    solved: bool = True  # False: R = 2 or 3, only to be read
    tangential: bool = False  # steady rolling, otherwise the normal problem alone
    normal_force: float | None = None  # N; None where the approach is given
    approach: float | None = None  # m
    forces: int = 0  # how many of creepage and lateral creepage follow from a force
    creepage: float = 0.
    lateral_creepage: float = 0.
    longitudinal_share: float = 0.  # of friction times load
    lateral_share: float = 0.
    spin: float = 0.  # 1/m
    spin_x: float = 0.  # centre of the spin, m
    spin_y: float = 0.
    friction: float | None = None
    backwards: bool = False  # rolls towards -x
    speed: float = 1.  # m/s
    step: float = 0.  # DQ, m; 0: not known
    spin_step: float = 1. / 6.  # share of an element by which CONTACT moves the spin's centre
    shear_modulus: float | None = None  # Pa
    poisson: float | None = None
    area: Area | None = None
    gap: np.ndarray | None = None  # (n_y, n_x), m
    curvatures: tuple[float, float] | None = None  # A, B (1/m) where the gap is A x^2 + B y^2 and a constant


class Words:
    """The values of a file, with comments left out, and the line of the last one."""

    def __init__(self, path: str):
        self.path, self.line, self.at = path, 0, 0
        try:
            with open(path, encoding="utf-8", errors="replace") as stream:
                self.lines = [(number, self.split(line)) for number, line in enumerate(stream, 1)]
        except OSError as error:
            raise DataError(f"{path}: {error.strerror}") from None
        self.lines = [(number, words) for number, words in self.lines if words]

    @staticmethod
    def split(line: str) -> list[str]:
        """Words of a line: quoted text is one; commas and = separate; % begins a comment."""
        return re.findall(r"'[^']*'|[^\s,=']+", re.match(r"(?:[^%']|'[^']*'?)*", line)[0])

    def refuse(self, what: str, line: int | None = None) -> DataError:
        return DataError(f"{self.path}, line {line or self.line}: {what}")

    def next_line(self, what: str) -> list[str]:
        """Words of the next line that has any. @raises DataError at the end of the file"""
        if self.at == len(self.lines):
            raise self.refuse(f"the file ends where {what} should follow")
        self.line, words = self.lines[self.at]
        self.at += 1
        return words

    def read(self, kinds: str, what: str, optional: int = 0) -> list:
        """Values of kinds i (integer), d (number), a (angle, rad) and s (quoted text); they may go on over several lines, of which the rest is not
        read. The last `optional` ones may be missing on the line on which they would be."""
        values: list = []
        needed = len(kinds) - optional
        while len(values) < needed:
            for word in self.next_line(what):
                if len(values) == len(kinds):
                    break
                try:
                    values.append(number(word, kinds[len(values)]))
                except ValueError:
                    if len(values) >= needed:
                        break
                    raise self.refuse(f"'{word}' where {what} should be, value {len(values) + 1} of {needed}") from None
        return values

    def digits(self, names: tuple[str, ...], what: str) -> dict[str, int]:
        """{digit: value} of a line of control digits."""
        word = self.next_line(what)[0]
        if not re.fullmatch(r"\d+", word) or len(word.lstrip("0")) > len(names):
            raise self.refuse(f"'{word}' where {what} should be, at most {len(names)} digits")
        return dict(zip(names, map(int, reversed(word.zfill(len(names))))))


def number(word: str, kind: str) -> float | str:
    """An integer (i), a number (d), an angle (a) or a quoted text (s) as Fortran writes it. @raises ValueError"""
    if kind == "i":
        return int(word)
    if kind == "s":
        if not re.fullmatch("'.+'", word):
            raise ValueError
        return word[1:-1].strip()
    if kind == "a" and word[-1:].lower() in "dr":
        value = float(word[:-1])
        return math.radians(value) if word[-1].lower() == "d" else value
    value = float(re.sub("[dD]", "e", word))
    if not math.isfinite(value):
        raise ValueError
    return value


class Reader:
    """Reads cases of module 3 one after the other and keeps what one leaves for the next."""

    largest, refused = LARGEST, REFUSED

    def __init__(self, words: Words):
        self.words, self.case = words, Case()
        self.planned: tuple[int, list[float]] | None = None  # IPOTCN and its values, mm
        self.shape: tuple[int, int, list[float], list[float]] | None = None  # IBASE, IPLAN and their values, mm

    def control_digits(self) -> tuple[dict[str, int], dict[str, int], dict[str, int]]:
        """{digit: value} of the three lines, each checked as soon as it is read; and the lines of the solvers, which ours does not need."""
        words = self.words
        first = words.digits(DIGITS[0], "control digits P-B-T-N-F-S")
        self.case.line = words.line
        self.check(first)
        second = words.digits(DIGITS[1], "control digits L-D-C-M-Z-E")
        self.check(second)
        following = words.lines[words.at - 1][1][1:2]
        if following and re.fullmatch(r"[12]", following[0]):
            raise words.refuse(f"weighting of the gap (a {following[0]} behind the control digits) is not available")
        third = words.digits(DIGITS[2], "control digits H-G-I-A-O-W-R")
        self.check(third)
        self.case.solved = third["R"] < 2
        if third["X"]:
            words.read("i", "digits of the debug output")
        self.skip_iteration(third["G"])
        return first, second, third

    def one_case(self, number_of_case: int) -> bool:
        """Read a case into self.case. @returns whether the next one follows without a module number"""
        words, case = self.words, self.case
        case.number = number_of_case
        first, second, third = self.control_digits()
        case.tangential = first["T"] == 3
        self.kinematics(first["N"], first["F"])
        self.friction(second["L"])
        self.material(second["C"], case.tangential)
        if case.tangential and not case.step:
            raise words.refuse(f"'C' = {second['C']} keeps CHI, DQ and VELOC, and there are none before it")
        if second["D"] == 2:
            self.potential_area()
        elif self.planned is None:
            raise words.refuse(f"'D' = {second['D']} keeps the potential contact area, and there is none before it")
        if second["Z"] == 2 and self.planned[0] > 0:
            self.undeformed_distance()
        elif self.shape is None and self.planned[0] > 0:
            raise words.refuse(f"'Z' = {second['Z']} keeps the undeformed distance, and there is none before it")
        self.make_geometry(renew=second["D"] > 0)
        if case.tangential and third["G"] == 2 and abs(case.step - case.area.element_x) > 0.01 * case.area.element_x:
            raise words.refuse(f"DQ = {1e3 * case.step:g} mm with 'G' = 2: steps must be as long as an element, "
                               f"{1e3 * case.area.element_x:g} mm", case.line)
        return third["R"] in (0, 2)

    def result(self) -> Case:
        """A copy of the case that was read last."""
        return dataclasses.replace(self.case)

    def check(self, digits: dict[str, int]) -> None:
        for name, value in digits.items():
            meaning = self.refused.get(name, {}).get(value)
            if value > self.largest[name]:
                raise self.words.refuse(f"'{name}' = {value} is not allowed; 0 to {self.largest[name]}")
            if meaning:
                raise self.words.refuse(f"'{name}' = {value} ({meaning}) is not available")

    def skip_iteration(self, g: int) -> None:
        """What CONTACT's solvers want; ours needs nothing of it."""
        if g != 1:
            self.words.read("iiiid", "MAXGS, MAXIN, MAXNR, MAXOUT, EPS")
        more = {2: ("ddid", "OMEGAH, OMEGAS, INISLP, OMGSLP"), 3: ("ddid", "OMEGAH, OMEGAS, INISLP, OMGSLP"), 4: ("id", "INISLP, OMGSLP"),
                5: ("ddiddddd", "parameters of the solver GDsteady")}
        if g in more:
            self.words.read(*more[g])

    def kinematics(self, n: int, f: int) -> None:
        names = f"{('PEN', 'FN')[n]}, {('CKSI, CETA', 'FX, CETA', 'FX, FY')[f]}, CPHI"
        values = self.words.read("dddddd", names, optional=2)
        normal, along, across, spin = values[:4]
        if n and normal <= 0.:
            raise self.words.refuse(f"FN = {normal:g} must be above 0")
        case, case.forces = self.case, f
        case.normal_force, case.approach = (normal, None) if n else (None, 1e-3 * normal)
        case.creepage, case.lateral_creepage = (0. if f else along), (0. if f == 2 else across)
        case.longitudinal_share, case.lateral_share = (along if f else 0.), (across if f == 2 else 0.)
        if math.hypot(case.longitudinal_share, case.lateral_share) >= 1.:
            raise self.words.refuse(f"{'FX, FY' if f == 2 else 'FX'} are shares of FSTAT*FN and must be below 1 together; full sliding has no "
                                    "creepage of its own")
        case.spin = 1e3 * spin
        case.spin_x, case.spin_y = (1e-3 * value for value in values[4:6]) if len(values) == 6 else (0., 0.)

    def friction(self, law: int) -> None:
        if law == 0:
            static, kinetic = self.words.read("dd", "FSTAT, FKIN")
            if abs(static - kinetic) > 1e-3 * kinetic:
                raise self.words.refuse(f"FSTAT = {static:g} and FKIN = {kinetic:g} must be the same with 'L' = 0")
            if static <= 0.:
                raise self.words.refuse(f"FSTAT = {static:g} must be above 0")
            self.case.friction = static
        elif self.case.friction is None:
            raise self.words.refuse("'L' = 1 keeps the friction coefficient, and there is none before it")

    def material(self, c: int, rolls: bool) -> None:
        words, case = self.words, self.case
        if c < 2 and case.shear_modulus is None:
            raise words.refuse(f"'C' = {c} keeps the elastic constants, and there are none before it")
        if c < 2:
            return
        if rolls:
            values = words.read("addd", "CHI, DQ, VELOC", optional=1)
            angle = abs(math.remainder(values[0], 2. * math.pi))
            if 0.01 < angle < math.pi - 0.01:
                raise words.refuse(f"CHI = {math.degrees(values[0]):g} degrees: rolling is along x, 0 or 180 degrees")
            if values[1] <= 0. or values[2] <= 0.:
                raise words.refuse("DQ and VELOC must be above 0")
            case.backwards, case.step, case.speed = angle > 1., 1e-3 * values[1], 1e-3 * values[2]
            case.spin_step = values[3] if len(values) == 4 else 1. / 6.
        nu1, nu2, g1, g2 = words.read("dddd", "POISS 1,2, GG 1,2")
        if not (0. <= nu1 <= 0.5 and 0. <= nu2 <= 0.5 and g1 > 0. and g2 > 0.):
            raise words.refuse("POISS must be 0 to 0.5 and GG above 0")
        # Kalker 1990, eq. 1.44: like bodies that deform as much together, and what makes them unlike.
        g = 2. / (1. / g1 + 1. / g2)
        difference = 0.25 * g * ((1. - 2. * nu1) / g1 - (1. - 2. * nu2) / g2)
        if abs(difference) >= LIKE_BODIES:
            raise words.refuse(f"unlike bodies, with the difference parameter {difference:.3g}, are not available; it must be below {LIKE_BODIES:g}")
        case.shear_modulus, case.poisson = 1e6 * g, 0.5 * g * (nu1 / g1 + nu2 / g2)

    def potential_area(self) -> None:
        words = self.words
        kind = int(words.read("i", "IPOTCN")[0])
        if kind in REFUSED_AREAS:
            raise words.refuse(f"IPOTCN = {kind} ({REFUSED_AREAS[kind]}) is not available")
        if kind in HERTZ:
            values = words.read("iiddd", f"MX, MY, {HERTZ[kind]}, SCALE")
            if min(values[2:]) <= 0.:
                raise words.refuse(f"{HERTZ[kind]} and SCALE must be above 0")
        elif kind in (1, 2, 3, 4):
            names = ("XL, YL, DX, DY", "XL, YL, XH, YH", "XC1, YC1, DX, DY", "XC1, YC1, XCM, YCM")[kind - 1]
            values = words.read("iidddd", f"MX, MY, {names}")
        else:
            raise words.refuse(f"IPOTCN = {kind} is not allowed; -3 to -1 and 1 to 4 are available")
        if min(values[:2]) < 1:
            raise words.refuse("MX and MY must be 1 or more")
        if self.case.solved and values[0] * values[1] > 4e6:
            raise words.refuse("MX times MY must be at most 4 million")
        if kind > 0 and min(area_of(kind, values).element_x, area_of(kind, values).element_y) <= 0.:
            raise words.refuse(f"{names}: the elements must be larger than 0")
        self.planned = kind, values

    def undeformed_distance(self) -> None:
        words = self.words
        base, plan = (int(value) for value in words.read("ii", "IBASE, IPLAN"))
        n = int(self.planned[1][0] * self.planned[1][1])
        if base == 1:
            values = words.read(6 * "d", "B(1) to B(6)")
        elif base == 2:
            values = words.read("idddd", "NN, XM, RM, Y1, DY1")
            if values[0] < 2 or values[4] <= 0. or values[2] == 0.:
                raise words.refuse("NN must be 2 or more, DY1 above 0 and RM not 0")
            values += words.read(int(values[0]) * "d", "PRFY(1) to PRFY(NN)")
        elif base == 3:
            values = words.read(8 * "d", "B(1) to B(8)")
            if not values[6] or not values[7]:
                raise words.refuse("B(7) and B(8) must not be 0")
        elif base == 9:
            values = words.read(n * "d", "the undeformed distance of each element")
        else:
            raise words.refuse(f"IBASE = {base} is not allowed; 1, 2, 3 and 9 are")
        if plan == 4:
            raise words.refuse("IPLAN = 4 (patches that act on each other by weights) is not available")
        if plan not in (1, 2, 3):
            raise words.refuse(f"IPLAN = {plan} is not allowed; 1, 2 and 3 are")
        self.shape = base, plan, values, words.read({1: "", 2: 6 * "d", 3: 8 * "d"}[plan], "the planform") if plan > 1 else []

    def make_geometry(self, renew: bool) -> None:
        """Area and gap of the case."""
        kind, values = self.planned
        case = self.case
        if kind < 0:
            if case.approach is not None and case.approach <= 0.:
                raise self.words.refuse(f"PEN = {1e3 * case.approach:g} must be above 0 with IPOTCN = {kind}", case.line)
            a, b, curvature_x, curvature_y = self.hertzian()
            if renew or case.area is None:
                case.area = area_between(values[0], values[1], values[4] * a, values[4] * b)
            case.gap = curvature_x * case.area.x ** 2 + curvature_y * case.area.y[:, None] ** 2
            case.curvatures = curvature_x, curvature_y
            return
        case.area = area_of(kind, values)
        base, plan, shape, _ = self.shape
        case.curvatures = (1e3 * shape[0], 1e3 * shape[2]) if base == plan == 1 and not (shape[1] or shape[3] or shape[4]) else None
        if self.shape[0] == 9 and len(self.shape[2]) != case.area.n_x * case.area.n_y:
            raise self.words.refuse("the undeformed distance that is kept is of another number of elements")
        case.gap = gap_of(case.area, *self.shape)
        if not (case.gap < EXCLUDED).any():
            raise self.words.refuse("the planform excludes all elements")

    def hertzian(self) -> tuple[float, ...]:
        """Semi-axes a, b (m) and curvatures A, B (1/m) of a case that gives some of them."""
        kind, (_, _, one, other, _) = self.planned
        case = self.case
        modulus = case.shear_modulus / (1. - case.poisson)
        if kind == -3:
            a, b = 1e-3 * one, 1e-3 * other
            force = case.normal_force or hertz.force_of_approach(a, b, case.approach, modulus)
            return (a, b, *hertz.curvatures(a, b, force, modulus))
        curvature_x = 1e3 * one
        ratio = other if kind == -2 else hertz.ratio_of_semi_axes(curvature_x, 1e3 * other)
        curvature_y = hertz.curvature_y(curvature_x, ratio) if kind == -2 else 1e3 * other
        if case.normal_force:
            return (*hertz.semi_axes(curvature_x, ratio, case.normal_force, modulus), curvature_x, curvature_y)
        a = hertz.semi_axis_of_approach(curvature_x, ratio, case.approach)
        return a, a / ratio, curvature_x, curvature_y


def area_between(n_x: float, n_y: float, x_high: float, y_high: float) -> Area:
    """From -x_high to x_high and from -y_high to y_high (m)."""
    dx, dy = 2. * x_high / n_x, 2. * y_high / n_y
    return Area(int(n_x), int(n_y), 0.5 * dx - x_high, 0.5 * dy - y_high, dx, dy)


def area_of(kind: int, values: list[float]) -> Area:
    """Of IPOTCN 1 to 4 with its values in mm."""
    n_x, n_y = int(values[0]), int(values[1])
    first, second = 1e-3 * np.array(values[2:4]), 1e-3 * np.array(values[4:6])
    n = np.array([n_x, n_y])
    edges = {1: lambda: second, 2: lambda: (second - first) / n, 3: lambda: second, 4: lambda: (second - first) / np.maximum(n - 1, 1)}[kind]()
    corner = first + 0.5 * edges if kind <= 2 else first
    return Area(n_x, n_y, float(corner[0]), float(corner[1]), float(edges[0]), float(edges[1]))


def gap_of(area: Area, base: int, plan: int, values: list[float], plan_values: list[float]) -> np.ndarray:
    """(n_y, n_x) gap (m) by IBASE and IPLAN, whose values are in mm."""
    x, y = 1e3 * area.x[None, :], 1e3 * area.y[:, None]
    quadratic = lambda c: c[0] * x * x + c[1] * x * y + c[2] * y * y + c[3] * x + c[4] * y + c[5]
    if base == 1:
        gap = quadratic(values)
    elif base == 2:
        n, middle, radius, first, step = values[:5]
        place = np.clip(np.floor((y - first) / step), 0, n - 2).astype(int)
        height = np.array(values[5:])
        left = height[place]
        gap = left + (height[place + 1] - left) * ((y - first) / step - place) + (x - middle) ** 2 / (2. * radius)
    elif base == 3:
        gap = (values[0] * np.sin(values[1] * (x - values[2])) - values[3] * np.sin(values[4] * (x - values[5]))
               + x * x / values[6] + y * y / values[7])
    else:
        gap = np.reshape(values, (area.n_y, area.n_x))
    gap = np.array(1e-3 * np.broadcast_to(gap, (area.n_y, area.n_x)))
    if plan == 2:
        gap[np.broadcast_to(quadratic(plan_values) >= 0., gap.shape)] = EXCLUDED
    elif plan == 3:
        inside = [(c[0] <= x) & (x <= c[1]) & (c[2] <= y) & (y <= c[3]) for c in (plan_values[:4], plan_values[4:])]
        gap[~(inside[0] | inside[1])] = EXCLUDED
    return gap

