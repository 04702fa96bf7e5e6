#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wear of one passage by finite elements beside that by half-space theory, on profiles at three states of wear: comparison.csv, with depths as they
are and smoothed over 2 mm, as profiles wear.

    benchmarks/profile-wear.py FOLDER [--program tread] [--cell 0.5] [--ranks 2]

Wears the rail of prm/damage/profile-wear.prm by prm/damage/contacts.csv; then rolls, at the start, after half of the passages and after all, some of
these contacts by finite elements over the profiles of that state, with wear recorded, and solves the same by tread reference.
"""

from __future__ import annotations

import csv
import math
import os

import numpy as np

from tread import Run
from tread.commands import command_parser, run_command
from tread.runs import ROOT, must_end_well, execute

SCENE, CONTACTS = "prm/damage/profile-wear.prm", "prm/damage/contacts.csv"
ROLLED = 45.0  # mm, of which the last is steady
STEADY = 15.0  # mm, of which no place is still under the wheel


def across(folder: str, steady: tuple[float, float] | None, places: np.ndarray) -> np.ndarray:
    """Wear depth of the rail over y (mm), in nm, mean over the steady range of x (mm)."""
    table = Run(folder).table("rail_surface_damage.csv", ("x_mm", "y_mm", "wear_depth_m"))
    rows = np.ones(len(table["x_mm"]), dtype=bool)
    if steady:
        rows = (table["x_mm"] > steady[0]) & (table["x_mm"] < steady[1])
    y = np.round(table["y_mm"][rows], 5)
    lines, number = np.unique(y, return_inverse=True)
    depth = np.bincount(number, table["wear_depth_m"][rows]) / np.bincount(number)
    # To nought over as much as lies between lines, as the program has it.
    lines = np.concatenate([[2 * lines[0] - lines[1]], lines, [2 * lines[-1] - lines[-2]]])
    return np.interp(places, lines, np.concatenate([[0.0], 1e9 * depth, [0.0]]))


def smoothed(depth: np.ndarray, spacing: float, length: float) -> np.ndarray:
    """As the program smooths wear: by a Gaussian that leaves half of waves of this length (mm)."""
    deviation = length * math.sqrt(0.5 * math.log(2.0)) / math.pi
    places = np.arange(-math.ceil(4.0 * deviation / spacing), math.ceil(4.0 * deviation / spacing) + 1) * spacing
    weights = np.exp(-0.5 * (places / deviation) ** 2)
    return np.convolve(depth, weights / weights.sum(), "same")


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("folder")
    parser.add_argument("--program", default="tread")
    parser.add_argument("--cell", type=float, default=0.5, help="finest cell, mm")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--contacts", default="8,16,24", help="rows of the table of contacts")
    arguments = parser.parse_args()
    worn = os.path.join(arguments.folder, "wear")
    must_end_well(execute(["wear", os.path.join(ROOT, SCENE), os.path.join(ROOT, CONTACTS), "-s", "Profile wear/States=2", "--output", worn], program=arguments.program))
    with open(os.path.join(ROOT, CONTACTS), encoding="utf-8") as stream:
        contacts = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    patches = Run(worn).table("wear_patches.csv", ("state_number", "contact", "normal_force_N", "angular_velocity_rad_per_s", "patch_length_mm"))
    rows = ["passages,contact,shift_mm,half_space_depth_nm,finite_elements_depth_nm,largest_difference_percent,smoothed_difference_percent,area_difference_percent,seconds"]
    for state in (0, 1, 2):
        scene = os.path.join(worn, f"worn_{state}.prm") if state else os.path.join(ROOT, SCENE)
        for number in map(int, arguments.contacts.split(",")):
            contact = contacts[number - 1]
            own = np.flatnonzero((patches["state_number"] == state) & (patches["contact"] == number))
            main_patch = own[np.argmax(patches["normal_force_N"][own])]
            settings = [f"Wheelset/Lateral shift (mm)={contact['shift_mm']}", f"Wheelset/Yaw (mrad)={contact['yaw_mrad']}", f"Vehicle/Wheel load (kN)={contact['load_kN']}",
                        "Motion/Creepage=predicted", f"Motion/Angular velocity (rad per s)={patches['angular_velocity_rad_per_s'][main_patch]:.9g}",
                        "Damage/Record=true", f"Motion/Rolled distance (mm)={ROLLED}", f"Mesh/Finest cell (mm)={arguments.cell}",
                        "Scene/Density scale=25", "Solid/Mass damping (1 per s)=3000", "Time stepping/Levels=3", "Output/Write volume=false"]
            words = [word for setting in settings for word in ("-s", setting)]
            folder = os.path.join(arguments.folder, f"state-{state}-contact-{number}")
            must_end_well(execute(["reference", scene, *words, "--output", folder + "-half-space"], program=arguments.program))
            must_end_well(execute([scene, *words, "--output", folder], ranks=arguments.ranks, program=arguments.program))
            run = Run(folder)
            places = np.linspace(-45.0, 45.0, 3601)
            behind = -0.75 * patches["patch_length_mm"][main_patch]  # mm; the wheel ends at 0, and all of the patch has passed there
            exact, found = across(folder + "-half-space", None, places), across(folder, (behind - STEADY, behind), places)
            soft = [smoothed(depth, places[1] - places[0], 2.0) for depth in (exact, found)]
            rows.append(f"{state * 50000},{number},{contact['shift_mm']},{exact.max():.4g},{found.max():.4g},{100.0 * np.abs(found - exact).max() / exact.max():.2f},"
                        f"{100.0 * np.abs(soft[1] - soft[0]).max() / soft[0].max():.2f},"
                        f"{100.0 * (found.sum() / exact.sum() - 1.0):.2f},{run.summary['wall_s']:.1f}")
            print(rows[-1], flush=True)
    with open(os.path.join(arguments.folder, "comparison.csv"), "w", encoding="utf-8") as stream:
        stream.write("\n".join(rows) + "\n")


if __name__ == "__main__":
    run_command(main)
