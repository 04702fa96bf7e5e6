# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wheels with a flat that stand on a rail at given turns, by half-space theory: the examples of CONTACT, or another deviation on the wheel of the first."""

from __future__ import annotations

import math
import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass

from . import positions
from .positions import rows_of
from .runs import PROGRAM, ROOT

PROFILES = os.path.join(ROOT, "prm", "flat")
SCAN = os.path.join(PROFILES, "scan.csv")
SHEAR_MODULUS, POISSON = 82e9, 0.28  # of the figures compared with
SPEED = 2.  # m/s


@dataclass(frozen=True)
class Options:
    deviation: str = SCAN  # of the wheel of the scanned flat
    smoothing: float = 0.  # of it, mm
    friction: float = 0.3
    element: float | None = None  # edge, mm; None: as in the figures compared with; 0: the program's own
    program: str = PROGRAM


def scanned(options: Options, _: str) -> tuple[dict[str, object], float]:
    """The columns of a position but for turn and load, and the nominal radius in mm."""
    wheel, radius = os.path.join(PROFILES, "worn-S1002.csv"), 490.
    # The program's radius is that where the profile has y = 0, which is worn.
    worn = min(rows_of(wheel), key=lambda row: abs(float(row["y_mm"])))
    return {"rail": os.path.join(PROFILES, "rail-of-arcs.csv"), "wheel": wheel, "wheel_deviation": os.path.abspath(options.deviation),
            "wheel_deviation_smoothing_mm": options.smoothing, "radius_mm": radius - float(worn["z_mm"]), "rail_y_mm": 757.4396}, radius


def rounded(_: Options, folder: str) -> tuple[dict[str, object], float]:
    """By the formula of CONTACT's example, which samples it as slices that its splines pass beside."""
    radius, across, half_length, half_depth, half_width = 450., 300., 0.111312, 0.45, 30.20927  # mm, rad
    steps, places = 25, 65
    slices = []
    for i in range(-steps - 3, steps + 4):
        angle = half_length * i / steps
        name = f"{i}.txt"
        slices.append(f"{angle:.6f} '{name}'")
        deep = half_depth * (1. + math.cos(math.pi * angle / half_length)) if abs(i) < steps else 0.
        with open(os.path.join(folder, name), "w", encoding="ascii") as stream:
            for k in range(-places, places + 1):
                y = half_width * k / places
                stream.write(f"{y:.6f} {-max(0., deep - y * y / (2. * across)):.6f}\n")
    flat, crown = os.path.join(folder, "flat.slcw"), os.path.join(folder, "crown.txt")
    with open(flat, "w", encoding="ascii") as stream:
        stream.write(f"0 1\n{len(slices)}\n0 0 0\n2\n" + "\n".join(slices) + "\n")
    with open(crown, "w", encoding="ascii") as stream:
        for k in range(-160, 161):
            angle = 0.25 * k / across
            stream.write(f"{across * math.sin(angle):.6f} {-across * (1. - math.cos(angle)):.6f}\n")
    return {"rail": crown, "wheel": "cylinder", "wheel_deviation": flat, "wheel_deviation_smoothing_mm": 0., "radius_mm": radius, "rail_y_mm": 750.}, radius


FLATS = {"scanned": (scanned, 0.4), "rounded": (rounded, 0.2)}  # each with the edge of its elements, mm


def solve(flat: str, turns: Sequence[tuple[float, float]], options: Options) -> list[dict[str, float]]:
    """Of each turn in degrees and load in N. @raises Error"""
    make, usual = FLATS[flat]
    element = usual if options.element is None else options.element
    with tempfile.TemporaryDirectory() as folder:
        common, radius = make(options, folder)
        common |= {"s_mm": 0., "y_ws_mm": 0., "friction": options.friction, "speed_m_per_s": SPEED,
                   "angular_velocity_rad_per_s": 1e3 * SPEED / radius, "young_Pa": 2 * SHEAR_MODULUS * (1 + POISSON), "poisson": POISSON,
                   "element_x_mm": element, "element_y_mm": element}
        answers = positions.solve([{**common, "pitch_rad": math.radians(pitch), "load_N": load} for pitch, load in turns], options.program)
    return [{"pitch_deg": pitch, "axle_height_mm": float(patches[0]["height_mm"]) + float(common["radius_mm"]) - radius,  # type: ignore[arg-type]
             "normal_force_N": sum(float(patch["normal_force_N"]) for patch in patches),
             "max_pressure_Pa": max(float(patch["max_pressure_Pa"]) for patch in patches), "patches": float(len(patches))}
            for (pitch, _), patches in zip(turns, answers)]
