# SPDX-License-Identifier: LGPL-2.1-or-later
"""CONTACT's examples, solved on their own elements by half-space theory and set beside its figures: contrib/contact-data/examples.inp and the
Manchester benchmark."""

import csv
import os

import numpy as np

from .contact_inp import read_cases, solve_case
from .files import read_table
from .manchester import positions, solve
from .runs import PROGRAM, ROOT

DATA = os.path.join(ROOT, "contrib", "contact-data")

# Of summary.csv of contact-inp: name in the table. Powers are those that CONTACT prints, sums over the elements.
QUANTITIES = {"normal_force_N": "normal force, N", "longitudinal_force_N": "longitudinal force, N", "lateral_force_N": "lateral force, N",
              "spin_moment_Nm": "spin moment, N m", "creepage": "creepage", "approach_mm": "approach, mm", "max_pressure_MPa": "largest pressure, MPa",
              "patch_area_mm2": "area, mm2", "adhesion_share": "adhesion share", "frictional_power_of_elements_W": "frictional power, W"}
# Where they differ most.
OF_ELEMENTS = {"pressure_MPa": "pressure of elements, MPa", "shear_MPa": "shear of elements, MPa", "slip": "slip of elements over the speed"}
OF_PATCHES = {"normal_force_N": ("normal force, N", 1.), "longitudinal_force_N": ("longitudinal force, N", 1.), "lateral_force_N": ("lateral force, N", 1.),
              "max_pressure_Pa": ("largest pressure, MPa", 1e-6)}


def elements_beside(result, given):
    """{name of OF_ELEMENTS: (given, computed)} of a given table of elements, where the difference is largest, in its units."""
    column = np.rint((1e-3 * given["x_mm"] - result["x"][0]) / (result["x"][1] - result["x"][0])).astype(int)
    row = np.abs(1e-3 * given["y_mm"][:, None] - result["y"]).argmin(axis=1)
    own = {"pressure_MPa": 1e-6 * result["pressure"], "shear_MPa": 1e-6 * np.hypot(result["shear_x"], result["shear_y"]),
           "slip": np.hypot(result["slip_x"], result["slip_y"])}
    pairs = {}
    for name in OF_ELEMENTS:
        if not np.isnan(given[name]).any():
            computed = own[name][row, column]
            worst = np.abs(computed - given[name]).argmax()
            pairs[name] = float(given[name][worst]), float(computed[worst])
    return pairs


def of_inputs():
    """Yields (folder, case, quantity, given, computed) of examples.inp."""
    results = {case.number: solve_case(case) for case in read_cases(os.path.join(DATA, "examples.inp"))}
    elements = read_table(os.path.join(DATA, "example_elements.csv"))
    with open(os.path.join(DATA, "examples.csv"), encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    for row, following in zip(rows, [*rows[1:], {}]):
        number = int(row["case"])
        yield row["folder"], row["name"], QUANTITIES[row["quantity"]], float(row["value"]), float(results[number][row["quantity"]])
        own = elements["case"] == number
        if following.get("case") != row["case"] and own.any():
            for name, pair in elements_beside(results[number], {key: values[own] for key, values in elements.items()}).items():
                yield row["folder"], row["name"], OF_ELEMENTS[name], *pair


def of_profiles(program=PROGRAM):
    """Yields the same of the Manchester benchmark, in tread's signs."""
    for side, shift, settings, given in positions():
        patch, = solve(side, settings, program)["patches"]
        for name, (quantity, unit) in OF_PATCHES.items():
            yield "manchester", f"A-2.2, {side} wheel, {shift:g} mm", quantity, unit * given[name], unit * patch[name]
