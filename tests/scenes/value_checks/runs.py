# SPDX-License-Identifier: LGPL-2.1-or-later
"""The runs whose values are compared: small ones, in which nothing that may be exchanged is alike. Wheel and rail are of unlike steel, the contact
lies beside the middle, creepages act in both directions, both wheels of a wheelset bear unlike forces."""

from __future__ import annotations

import os
import subprocess
import time

from tread.files import read_parameters
from tread.runs import ROOT, arguments_of, must_end_well
from loaded_once import execute_often, execute_on

from .engine import Runs, screen_of

UNLIKE = {"Wheel/Young's modulus (GPa)": 200, "Wheel/Poisson's ratio": 0.27, "Rail/Young's modulus (GPa)": 215, "Rail/Poisson's ratio": 0.31,
          "Wheel/Density (kg per m3)": 7700, "Rail/Density (kg per m3)": 7900}
STRAIGHT = {**UNLIKE, "Scene/Title": "values, straight", "Rail/Shape": "block", "Rail/Block width (mm)": 80, "Rail/Block height (mm)": 50, "Mesh/Finest cell (mm)": 1.3, "Mesh/Fine half width (mm)": 9, "Wheel/Tread profile": "cone 1:40",
            "Motion/Rolled distance (mm)": 12, "Motion/Creepage": 0.0011, "Motion/Lateral creepage": 0.0006, "Motion/Spin (1 per m)": 0.1,
            "Contact/Friction coefficient": 0.4, "Motion/Hold distance (mm)": 5, "Time stepping/Levels": 1, "Contact/Tolerance": 1e-9}
EVERY_STEP = {"Output/History interval (mm)": 0.005, "Output/Patch interval (mm)": 0.005}
BAR = {**UNLIKE, "Rail/Block width (mm)": 80, "Mesh/Coarsest cell (mm)": 50, "Mesh/Finest cell (mm)": 2.5, "Rail/Begin (mm)": -1350, "Rail/Length (mm)": 2400,
       "Track/Support 0 (mm)": -1650, "Mesh/Fine half width (mm)": 15, "Motion/Start (mm)": -40, "Motion/Rolled distance (mm)": 40,
       "Output/Supports": "1,2,3,4", "Rail/Crown radius (mm)": 300}
CURVE = {**UNLIKE, "Scene/Title": "values, both wheels", "Motion/Rolled distance (mm)": 11, "Output/Write volume": False, "Mesh/Fine half width (mm)": 0, "Wheelset/Yaw (mrad)": 3}


class Maker:
    """Makes runs, and puts them among the values. @param folder for all of them"""

    def __init__(self, program: str, folder: str):
        self.program, self.folder = program, folder
        self.runs = Runs()
        self.runs.version = execute_often(["--version"], program).stdout.strip()

    def path(self, name: str) -> str:
        return os.path.join(self.folder, name)

    def ended(self, arguments: list[str], ranks: int) -> subprocess.CompletedProcess:
        return must_end_well(execute_on(ranks, arguments, self.program))

    def run(self, name: str, scene: str, settings: dict, ranks: int = 1, more: tuple[str, ...] = (), command: str = "run") -> None:
        start = time.monotonic()
        ended = self.ended([*arguments_of(os.path.join(ROOT, "prm", scene), settings, self.path(name), command), *more], ranks)
        self.keep(name, ended.stdout, time.monotonic() - start)

    def keep(self, name: str, screen: str, seconds: float) -> None:
        parameters = self.path(os.path.join(name, "parameters.prm"))
        self.runs.add_folder(name, self.path(name), read_parameters(parameters) if os.path.exists(parameters) else {})
        with open(self.path(name + ".screen"), "w", encoding="utf-8") as stream:
            stream.write(screen)
        self.runs.add(name, "screen", screen_of(screen))
        self.runs.seconds[name] = seconds
        print(f"{name}: {seconds:.1f} s", flush=True)

    def tool(self, name: str, arguments: list[str], ranks: int = 1) -> None:
        start = time.monotonic()
        ended = self.ended([*arguments, "--output", self.path(name)], ranks)
        self.keep(name, ended.stdout, time.monotonic() - start)


def all_runs(program: str, folder: str, only: str = "") -> Runs:
    make = Maker(program, folder)
    want = lambda name: not only or name in only.split(",")
    if want("straight"):
        make.run("straight", "smooth-rolling.prm", {**STRAIGHT, **EVERY_STEP, "Output/Cells": "-2,-7.5,3; -2,-7.5,0.6", "Peak stress/Region": "range",
                                                    "Peak stress/From (mm)": -9, "Peak stress/To (mm)": 0, "Contact/Largest number of sweeps": 5})
    if want("plastic"):
        make.run("plastic", "smooth-rolling.prm", {"Mesh/Finest cell (mm)": 1.3, "Mesh/Fine half width (mm)": 9, "Motion/Rolled distance (mm)": 14,
                                                   "Rail/Yield stress (MPa)": 450, "Wheel/Yield stress (MPa)": 600, "Motion/Passages": 2, "Output/Table depth (mm)": 8,
                                                   "Output/Cells": "-6,0,3", "Time stepping/Levels": 1})
    if want("track"):
        dip = {"Defect/Shape": "dip", "Defect/Position (mm)": -30, "Defect/Length (mm)": 24, "Defect/Depth (mm)": 0.1, "Defect/Repeated at (mm)": -3, "Output/History interval (mm)": 0.25}
        wheels = {"Further wheels/Distances (mm)": 1000, "Further wheels/Traction coefficients": 0.1, "Motion/Traction coefficient": 0.2}
        heavy = {"Time stepping/Least step (us)": 0.45}
        make.run("track", "tutorial/track.prm", {**BAR, **dip, **wheels, **heavy})
        make.run("twin", "tutorial/track.prm", {**BAR, **dip, **wheels, **heavy, "Defect/Shape": "none"})
        make.tool("dynamic", ["dynamic-force", make.path("track"), "--smooth-twin", make.path("twin")])
        make.tool("sleeper", ["sleeper-stress", make.path("track"), "--cell-size", "40", "--bottom", "ballast"])
    if want("modes"):
        make.run("modes", "tutorial/track.prm", BAR, 1, ("--up-to", "1500"), "modes")
    if want("modes_full"):
        make.run("modes_full", "tutorial/full-wheel.prm", {"Mesh/Finest cell (mm)": 2.7, "Mesh/Fine half width (mm)": 12, "Mesh/Coarsest cell (mm)": 60}, 1, ("--up-to", "300"), "modes")
    if want("curve"):
        make.run("curve", "curves/klingel.prm", {**CURVE, "Guidance/Kind": "springs", "Guidance/Lateral force (kN)": 4, "Guidance/Yaw moment (kN m)": 1,
                                                 "Guidance/Lateral stiffness (MN per m)": 5, "Guidance/Lateral damping (kN s per m)": 20,
                                                 "Wheelset/Axle torsional stiffness (MN m per rad)": 3.4, "Wheelset/Axle bending stiffness (MN m2)": 5})
    if want("half"):
        make.run("half", "smooth-rolling.prm", STRAIGHT, 1, command="reference")
        alike = {name: value for name, value in STRAIGHT.items() if name not in UNLIKE}
        make.run("half_alike", "smooth-rolling.prm", {**alike, "Start/Tractions": "none", "Motion/Rolled distance (mm)": 45}, 2, command="reference")
    if want("half_curve"):
        make.run("half_curve", "curves/klingel.prm", {**CURVE, "Guidance/Kind": "rigid", "Guidance/Lateral force (kN)": "balance", "Guidance/Yaw moment (kN m)": "balance",
                                                      "Wheel/Smoothing length (mm)": 2, "Rail/Smoothing length (mm)": 3},
                 1, command="reference")
    if want("half_two"):
        make.run("half_two", "curves/two-patches.prm", UNLIKE, 1, command="reference")
    if want("points"):
        make.run("points", "curves/klingel.prm", CURVE, 1, ("--shift-to", "6", "--shift-step", "0.5"), "contact-points")
    return make.runs
