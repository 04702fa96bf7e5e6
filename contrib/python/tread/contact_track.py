# SPDX-License-Identifier: LGPL-2.1-or-later
"""Module 1 of CONTACT's input files, a wheel on a rail by their profiles: cases become scenes for tread reference.

CONTACT's axes belong to the right side: x forward, y to the right, z down, and forces act on the rail. A wheel of tread has axes of its own,
y to its side and z up, and forces act on the wheel: the right one is mirrored at the track's plane, the left one turned about x.
"""

from __future__ import annotations

import dataclasses
import os
from typing import Any

from . import contact_cases
from .runs import PROGRAM, Run, run

GRAVITY = 9.81  # m/s2, tread's default
MASS = 900.  # kg, tread's default; it must be less than the load

REFUSED: dict[str, dict[int, str]] = {
    **contact_cases.REFUSED,
    "CONFIG": {4: "a wheel on a roller", 5: "a wheel on a roller"},
    "T": {0: "the normal problem alone with module 1", **contact_cases.REFUSED["T"]},
    "N": {0: "a given height of the wheelset"},
    "F": {1: "a given force of the wheelset", 2: "a given moment of the wheelset", 3: "a rail on springs"},
    "D": {value: "a grid that is not plane" for value in range(3, 10)},
    "E": {4: "a flexible wheelset", 5: "a flexible wheelset"},
    "Z": {}}
LARGEST = {**contact_cases.LARGEST, "CONFIG": 5, "F": 3, "D": 9, "Z": 3, "E": 5}

# Of a patch: name in patches.csv, name in tread's summary, unit of the file over SI.
PATCH = (("normal_force_N", "normal_force_N", 1.), ("longitudinal_force_N", "longitudinal_force_N", 1.), ("lateral_force_N", "lateral_force_N", 1.),
         ("x_mm", "x_m", 1e3), ("y_mm", "y_m", 1e3), ("contact_angle_rad", "angle_rad", 1.), ("creepage", "creepage", 1.),
         ("lateral_creepage", "lateral_creepage", 1.), ("spin_per_m", "spin_per_m", 1.), ("max_pressure_MPa", "max_pressure_Pa", 1e-6),
         ("area_mm2", "area_m2", 1e6))


def signs(side: str) -> dict[str, float]:
    """{name in tread's summary: factor} between CONTACT's axes and those of a wheel, "left" or "right"; either way."""
    own = 1. if side == "right" else -1.
    return {"longitudinal_force_N": -1., "lateral_force_N": -own, "y_m": own, "angle_rad": -own, "lateral_creepage": -own, "spin_per_m": -own}


@dataclasses.dataclass
class TrackCase:
    """A case of module 1 as settings of a scene."""

    number: int
    line: int
    solved: bool
    side: str  # "left" or "right"
    settings: dict[str, Any]  # {"Section/Name": value}


class TrackReader(contact_cases.Reader):
    """Reads cases of module 1 one after the other and keeps what one leaves for the next."""

    largest, refused = LARGEST, REFUSED

    def __init__(self, words: contact_cases.Words):
        super().__init__(words)
        self.settings: dict[str, Any] = {"Wheelset/Slip over the patch": "plane"}

    def one_case(self, number_of_case: int) -> bool:
        """Read a case into self.case. @returns whether the next one follows without a module number"""
        words, case = self.words, self.case
        first, second, third = self.control_digits()
        if first["CONFIG"] in (2, 3):
            raise words.refuse(f"'CONFIG' = {first['CONFIG']} is not allowed; 0 (left) and 1 (right) are", case.line)
        self.friction(second["L"])
        self.material(second["C"], rolls=False)
        if second["D"] == 2:
            values = words.read("dddaddd", "DX, DS, DQREL, A_SEP, D_SEP, D_COMB", optional=1)
            self.settings["Wheelset/Patch distance (mm)"] = values[4]
        side = "right" if first["CONFIG"] else "left"
        self.track(second["Z"])
        self.wheelset(second["E"], side)
        for name, digit in (("Rail/Measured head", "Z"), ("Wheel/Tread profile", "E"), ("Motion/Speed (km per h)", "E")):
            if name not in self.settings:
                raise words.refuse(f"'{digit}' = {second[digit]} keeps what none has given before it")
        young = 2e-9 * (1. + case.poisson) * case.shear_modulus
        self.settings.update({f"{body}/{name}": value for body in ("Wheel", "Rail")
                              for name, value in (("Young's modulus (GPa)", young), ("Poisson's ratio", case.poisson))})
        self.settings["Contact/Friction coefficient"] = case.friction
        self.case_of_track = TrackCase(number_of_case, case.line, case.solved, side, dict(self.settings))
        return third["R"] in (0, 2)

    def result(self) -> TrackCase:  # type: ignore[override]
        return self.case_of_track

    def zero(self, names: str, values: list[float]) -> None:
        """@raises DataError unless all values are 0"""
        for name, value in zip(names.split(", "), values):
            if value:
                raise self.words.refuse(f"{name} = {value:g} is not available; it must be 0")

    def profile(self, names: str) -> str:
        """Name of a profile: of a file beside the input, or one that tread knows, such as S1002."""
        name, mirror, scale, smooth = self.words.read("sidd", names)
        if mirror == 1 or scale != 1. or smooth > 0.:
            raise self.words.refuse("profiles are taken as they are: MIRRORY 0, SCALE 1, SMOOTH 0")
        if name.lower().endswith((".slcs", ".slcw")):
            raise self.words.refuse(f"'{name}' lists slices of a profile that varies along the track or around the wheel, which is not available")
        path = os.path.join(os.path.dirname(os.path.abspath(self.words.path)), name)
        return path if os.path.exists(path) else name

    def track(self, z: int) -> None:
        words = self.words
        if z in (1, 3):
            depth, point, gauge, cant = words.read("ddda", "GAUGHT, GAUGSQ, GAUGWD, CANT")
            self.zero("CANT", [cant])
            if depth <= 0. or point > 1.:
                raise words.refuse("GAUGHT must be above 0 and GAUGSQ 0 or 1: the rail is placed by its gauge face")
            self.settings.update({"Wheelset/Gauge depth (mm)": depth, "Wheelset/Track gauge (mm)": gauge})
        if z == 3:
            self.settings["Rail/Measured head"] = self.profile("RFNAME, MIRRORY, SCALE, SMOOTH")
        if z in (2, 3):
            names = "DY, DZ, ROLL, VY, VZ, VROLL"
            self.zero(names, words.read("ddadda", names))

    def wheelset(self, e: int, side: str) -> None:
        words, own = self.words, 1. if side == "right" else -1.
        if e == 3:
            distance, back, radius = words.read("ddd", "FBDIST, FBPOS, NOMRAD")
            self.settings.update({"Wheelset/Flange-back distance (mm)": distance, "Wheelset/Flange back (mm)": back, "Wheel/Radius (mm)": radius})
            self.settings["Wheel/Tread profile"] = self.profile("WFNAME, MIRRORY, SCALE, SMOOTH")
        if e >= 1:
            _, shift, load, roll, yaw, _ = words.read("dddaaa", "S, Y, FZ, ROLL, YAW, PITCH")
            if load <= 0.:
                raise words.refuse(f"FZ = {load:g} must be above 0")
            self.settings.update({"Wheelset/Lateral shift (mm)": own * shift + 0., "Wheelset/Yaw (mrad)": 1e3 * own * yaw + 0.,
                                  "Wheelset/Roll (mrad)": 1e3 * own * roll + 0., "Vehicle/Wheel load (kN)": 1e-3 * load,
                                  "Wheel/Mass (kg)": min(MASS, 0.99 * load / GRAVITY)})
        if e >= 2:
            names = "VS, VY, VZ, VROLL, VYAW, VPITCH"
            speed, *others, turning = words.read("dddaaa", names)
            self.zero("VY, VZ, VROLL, VYAW", others)
            if speed <= 0. or turning >= 0.:
                raise words.refuse("VS must be above 0 and VPITCH below 0: the wheel rolls forward")
            self.settings.update({"Motion/Speed (km per h)": 3.6e-3 * speed, "Motion/Angular velocity (rad per s)": -turning})


def scene_text(settings: dict[str, Any], title: str) -> str:
    """A parameter file with the settings {"Section/Name": value} of a case."""
    sections: dict[str, list[str]] = {"Scene": [f"  set Title = {title}"]}
    for name, value in settings.items():
        section, _, own = name.partition("/")
        sections.setdefault(section, []).append(f"  set {own} = {value:.12g}" if isinstance(value, float) else f"  set {own} = {value}")
    return "\n".join("\n".join([f"subsection {section}", *lines, "end", ""]) for section, lines in sections.items())


def patch_rows(side: str, patches: list[dict]) -> list[dict[str, float]]:
    """[{name: value}] of patches of tread's summary: the names of PATCH, in CONTACT's axes and signs."""
    factor = signs(side)
    return [{name: unit * factor.get(source, 1.) * patch[source] + 0. for name, source, unit in PATCH} for patch in patches]


def solve_track_case(case: TrackCase, output: str, title: str = "", program: str = PROGRAM) -> tuple[Run, list[dict[str, float]]]:
    """Write a scene beside a folder and solve it there by half-space theory.

    Returns the run and [{name: value}] of its patches: the names of PATCH, in CONTACT's axes and signs. Raises ProgramError.
    """
    os.makedirs(os.path.dirname(output) or ".", exist_ok=True)
    with open(output + ".prm", "w", encoding="utf-8") as stream:
        stream.write(scene_text(case.settings, title))
    answer = run(output + ".prm", command="reference", output=output, program=program)
    return answer, patch_rows(case.side, answer.summary["patches"])
