# SPDX-License-Identifier: LGPL-2.1-or-later
"""CONTACT's examples, solved on their own elements by half-space theory and set beside its figures: contrib/contact-data/examples.inp and the
Manchester benchmark."""

from __future__ import annotations

import csv
import os
import tempfile
from collections.abc import Iterator, Mapping

import numpy as np

from .contact_cases import Case
from .contact_inp import read_cases, solve_case
from .contact_rolled import roll_track_case, roll_upright, upright_wheel
from .contact_track import TrackCase, solve_track_case
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
# What finite elements tell, too.
OF_ROLLED = {"longitudinal_force_N": "longitudinal force, N", "lateral_force_N": "lateral force, N", "spin_moment_Nm": "spin moment, N m",
             "max_pressure_MPa": "largest pressure, MPa", "adhesion_share": "adhesion share", "frictional_power_W": "frictional power, W"}
# File, case and name of those that are rolled.
ROLLED = (("thesis", 2, "thesis, traction coefficient 0.15"), ("thesis", 1, "thesis, traction coefficient 0.30"),
          ("examples", 3, "lateral creepage and spin"), ("examples", 8, "Eurosprinter, creepage 0.0008"),
          ("examples", 10, "Eurosprinter, creepage 0.0024"), ("examples", 22, "gauge corner, quadratic gap"))
NARROWEST = 1e-3  # m, of patches that are rolled
OF_PATCHES = {"normal_force_N": ("normal force, N", 1.), "longitudinal_force_N": ("longitudinal force, N", 1.), "lateral_force_N": ("lateral force, N", 1.),
              "max_pressure_Pa": ("largest pressure, MPa", 1e-6)}


def elements_beside(result: Mapping, given: Mapping[str, np.ndarray]) -> dict[str, tuple[float, float]]:
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


def of_inputs() -> Iterator[tuple[str, str, str, float, float]]:
    """Yields (folder, case, quantity, given, computed) of examples.inp."""
    results = {case.number: solve_case(case) for case in read_cases(os.path.join(DATA, "examples.inp")) if isinstance(case, Case)}
    elements = read_table(os.path.join(DATA, "example_elements.csv"))
    with open(os.path.join(DATA, "examples.csv"), encoding="utf-8") as stream:
        rows: list[dict] = list(csv.DictReader(stream))
    for row, following in zip(rows, [*rows[1:], {}]):
        number = int(row["case"])
        yield row["folder"], row["name"], QUANTITIES[row["quantity"]], float(row["value"]), float(results[number][row["quantity"]])
        own = elements["case"] == number
        if following.get("case") != row["case"] and own.any():
            for name, pair in elements_beside(results[number], {key: values[own] for key, values in elements.items()}).items():
                yield row["folder"], row["name"], OF_ELEMENTS[name], *pair


def of_profiles(program: str = PROGRAM) -> Iterator[tuple[str, str, str, float, float]]:
    """Yields the same of the Manchester benchmark, in tread's signs."""
    for side, shift, settings, given in positions():
        patch, = solve(side, settings, program)["patches"]
        for name, (quantity, unit) in OF_PATCHES.items():
            yield "manchester", f"A-2.2, {side} wheel, {shift:g} mm", quantity, unit * given[name], unit * patch[name]


def of_finite_elements(program: str = PROGRAM, ranks: int = 1) -> Iterator[tuple[str, str, float, float]]:
    """Yields (name with the size of the cells, quantity, half-space's answer, finite elements') of Hertzian examples."""
    for file, number, name in ROLLED:
        case = read_cases(os.path.join(DATA, f"{file}.inp"))[number - 1]
        assert isinstance(case, Case)
        result = solve_case(case)
        scene = upright_wheel(case, result, None)
        with tempfile.TemporaryDirectory() as folder:
            _, rolled = roll_upright(case, result, scene, os.path.join(folder, "run"), name, ranks, program)
        for key, quantity in OF_ROLLED.items():
            # Nothing but rounding acts where nothing should.
            if abs(result[key]) > 1e-6 * result["normal_force_N"] or key in ("max_pressure_MPa", "adhesion_share"):
                yield f"{name}; cells of {scene['Mesh/Finest cell (mm)']:g} mm", quantity, float(result[key]), float(rolled[key])


def of_rolled_profiles(program: str = PROGRAM, ranks: int = 1) -> Iterator[tuple[str, float, float, dict[str, float], dict[str, float]]]:
    """Yields (side, shift of the wheelset to the right in mm, finest cell in mm, half-space's patch, finite elements' patch) of the
    Manchester benchmark's positions but those on the flange, whose narrow patches take long; patches are {name: value} with the names of
    contact_track.PATCH."""
    for case in read_cases(os.path.join(DATA, "manchester.inp")):
        assert isinstance(case, TrackCase)
        with tempfile.TemporaryDirectory() as folder:
            run, (half_space,) = solve_track_case(case, os.path.join(folder, "half-space"), program=program)
            if run.summary["patches"][0]["width_m"] < NARROWEST:
                continue
            answer, (rolled,) = roll_track_case(case, run, os.path.join(folder, "rolled"), None, "", ranks, program)
            cell = float(answer.parameters["Mesh/Finest cell (mm)"])
        own = 1. if case.side == "right" else -1.
        yield case.side, own * case.settings["Wheelset/Lateral shift (mm)"] + 0., cell, half_space, rolled
