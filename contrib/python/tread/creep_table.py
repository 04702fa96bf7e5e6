# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cases for the half-space library: CONTACT's creep-force table, and random ones."""

from __future__ import annotations

import os
from collections.abc import Mapping

import numpy as np

from . import hertz
from .files import read_table
from .runs import ROOT

# Of the table: normal force (N), friction, shear modulus (Pa), Poisson's ratio.
FORCE, FRICTION, SHEAR, POISSON = 82000., 0.3, 82e9, 0.28
COMMON = {"normal_force": FORCE, "friction": FRICTION, "young": 2. * (1. + POISSON) * SHEAR, "poisson": POISSON}


def curvatures(a: float, b: float) -> list[float]:
    """A, B (1/m) of the gap whose Hertzian patch has semi-axes a and b (m) under FORCE."""
    return hertz.curvatures(a, b, FORCE, SHEAR / (1. - POISSON))


def table_cases() -> tuple[dict, dict[str, np.ndarray]]:
    """(cases, forces): settings of half_space.solve() for the rows of creep_table.csv on its own elements, 7 over each axis, and
    {name: (rows,) array} of its forces over friction times load, the moment over that times the mean semi-axis too."""
    table = read_table(os.path.join(ROOT, "contrib/contact-data/creep_table.csv"))
    a, b = 1e-3 * table["semi_axis_x_mm"], 1e-3 * table["semi_axis_y_mm"]
    gap = np.array([curvatures(*axes) for axes in zip(a, b)])
    cases: dict = {"curvature_x": gap[:, 0], "curvature_y": gap[:, 1], **COMMON, "creepage": table["creepage"],
             "lateral_creepage": table["lateral_creepage"], "spin": 1e3 * table["spin_per_mm"], "element_x": 2. * a / 7., "element_y": 2. * b / 7.}
    return cases, {"longitudinal_force": table["FX_over_mu_FN"], "lateral_force": table["FY_over_mu_FN"], "spin_moment": table["MZ_over_mu_FN_c"]}


def beside_table(answers: Mapping[str, np.ndarray], cases: Mapping, forces: Mapping[str, np.ndarray]) -> dict[str, float]:
    """{name: largest difference from the table} in its units."""
    mean = 3.5 * np.sqrt(cases["element_x"] * cases["element_y"])
    return {name: np.abs(answers[name] / (FRICTION * FORCE * (mean if name == "spin_moment" else 1.)) - wanted).max() for name, wanted in forces.items()}


def random_cases(n: int, seed: int = 1) -> tuple[dict, tuple[np.ndarray, np.ndarray]]:
    """(cases, (a, b)): ellipses from 1:5 to 5:1 of 5 mm in the mean, creepages and spin from nothing to full sliding; semi-axes in m."""
    random, mean = np.random.default_rng(seed), 5e-3
    ratio = np.exp(random.uniform(np.log(0.2), np.log(5.), n))
    a, b = mean * np.sqrt(ratio), mean / np.sqrt(ratio)
    gap = np.array([curvatures(*axes) for axes in zip(a, b)])
    scale = FRICTION * mean * gap.sum(axis=1)
    return {"curvature_x": gap[:, 0], "curvature_y": gap[:, 1], **COMMON, "creepage": scale * random.uniform(-2., 2., n),
            "lateral_creepage": scale * random.uniform(-2., 2., n), "spin": scale / mean * random.uniform(-2., 2., n)}, (a, b)
