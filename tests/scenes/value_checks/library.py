# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields of the C library's structs: each input changes the answer as a closed form says, and each answer follows from the fields of the grid."""

from __future__ import annotations

import math
import re

import numpy as np

from tread import half_space, hertz

from .engine import Expect, Runs, compared

# Of a driving wheel whose patch is longer than wide; nothing is alike in x and y.
CASE = {"curvature_x": 0.9, "curvature_y": 2.3, "normal_force": 61e3, "friction": 0.35, "young": 203e9, "poisson": 0.27, "creepage": -0.0012,
        "lateral_creepage": 0.0007, "spin": 0.15, "element_x": 0.45e-3, "element_y": 0.4e-3}


def fields_of_the_header(path: str) -> dict[str, list[str]]:
    """{struct: its fields} of half_space.h."""
    with open(path, encoding="utf-8") as stream:
        text = re.sub(r"/\*.*?\*/", "", stream.read(), flags=re.S)
    structs = re.findall(r"typedef struct\s*\{(.*?)\}\s*(\w+);", text, re.S)
    return {name: [re.split(r"[\s*]+", one.strip())[-1] for fields in body.split(";") if fields.strip() for one in fields.split(",")] for body, name in structs}


def add_library(runs: Runs) -> None:
    """The cases and what the library answers."""
    runs.add("library", "tread_half_space_case", {name: float(value) for name, value in CASE.items()})
    add_answers(runs, CASE)
    grid = patch_gap(CASE)
    runs.add("library", "own gap", {name: float(value) for name, value in half_space.solve_patch(
        gap=grid[2], x_first=grid[0], y_first=grid[1], **{name: value for name, value in CASE.items() if not name.startswith("curvature")}).items()
        if np.ndim(value) == 0})


def add_answers(runs: Runs, case: dict) -> None:
    answer = half_space.solve_patch(**case)
    runs.add("library", "tread_half_space_answer", {name: value.item() if hasattr(value, "item") and np.ndim(value) == 0 else value
                                                    for name, value in answer.items() if np.ndim(value) == 0})
    runs.add("library", "fields", {name: np.ravel(answer[name]) for name in half_space.FIELDS})
    nx, ny = len(answer["x"]), len(answer["y"])
    runs.add("library", "tread_half_space_grid", {"x_first": float(answer["x"][0]), "y_first": float(answer["y"][0]), "n_x": nx, "n_y": ny,
                                                  "element_x": float(answer["x"][1] - answer["x"][0]), "element_y": float(answer["y"][1] - answer["y"][0])})


def patch_gap(case: dict) -> tuple[float, float, np.ndarray]:
    """(first x, first y, gap) of the same ellipse on a grid of its own."""
    x = case["element_x"] * (np.arange(41) - 19.25)
    y = case["element_y"] * (np.arange(31) - 14.5)
    return x[0], y[0], case["curvature_x"] * x[None, :]**2 + case["curvature_y"] * y[:, None]**2


@compared
def normal_answer(runs: Runs, expect: Expect) -> None:
    """Hertz's, of the case."""
    case, answer = runs.of("library", "tread_half_space_case"), runs.of("library", "tread_half_space_answer")
    modulus = case["young"] / (2 * (1 - case["poisson"]**2))
    a, b = hertz.semi_axes(case["curvature_x"], hertz.ratio_of_semi_axes(case["curvature_x"], case["curvature_y"]), case["normal_force"], modulus)
    pressure = 1.5 * case["normal_force"] / (math.pi * a * b)
    expect.near("largest pressure", 1e-6 * answer["max_pressure"], 1e-6 * pressure, relative=1e-3)
    expect.near("approach", 1e6 * answer["approach"], 1e6 * hertz.approach(a, b, case["normal_force"], modulus), relative=8e-3)
    expect.near("area", 1e6 * answer["area"], 1e6 * math.pi * a * b, relative=1e-6)
    expect.near("status", answer["status"], 0)


@compared
def tangential_answer(runs: Runs, expect: Expect) -> None:
    """Resultants of the fields; where all slips, the shear stress is the bound against the slip."""
    case, answer, fields, grid = (runs.of("library", name) for name in ("tread_half_space_case", "tread_half_space_answer", "fields", "tread_half_space_grid"))
    area = grid["element_x"] * grid["element_y"]
    expect.near("element x", grid["element_x"], case["element_x"], relative=1e-9)
    expect.near("element y", grid["element_y"], case["element_y"], relative=1e-9)
    x = np.tile(grid["x_first"] + grid["element_x"] * np.arange(grid["n_x"]), grid["n_y"])
    y = np.repeat(grid["y_first"] + grid["element_y"] * np.arange(grid["n_y"]), grid["n_x"])
    p, tx, ty, sx, sy, state = (fields[name] for name in half_space.FIELDS)
    expect.near("load", area * np.sum(p), case["normal_force"], relative=3e-3)
    expect.near("longitudinal force", area * np.sum(tx), answer["longitudinal_force"], relative=3e-3)
    expect.near("lateral force", area * np.sum(ty), answer["lateral_force"], relative=0.01)
    expect.near("spin moment", area * np.sum(x * ty - y * tx), answer["spin_moment"], relative=0.03)
    expect.near("centre, x", np.sum(x * p) / np.sum(p), 0., absolute=2e-6)
    expect.near("centre, y", np.sum(y * p) / np.sum(p), 0., absolute=2e-6)
    contact, slips = state > 0, state == 2
    expect.near("adhesion", np.sum(state == 1) / np.sum(contact), answer["adhesion_share"], relative=1e-9)
    expect.near("bound", np.hypot(tx, ty)[slips], case["friction"] * p[slips], relative=8e-3)
    expect.near("work", -area * np.sum(tx * sx + ty * sy), answer["frictional_work"], relative=0.02)
    size, speed = np.hypot(tx, ty), np.hypot(sx, sy)
    moving = slips & (speed > 0.2 * speed.max())
    for name, stress, slip in (("x", tx, sx), ("y", ty, sy)):
        expect.near(f"direction {name}", (slip / np.where(moving, speed, 1.))[moving], (-stress / np.where(moving, size, 1.))[moving], absolute=0.1)


@compared
def creepages(runs: Runs, expect: Expect) -> None:
    """Far ahead of its trailing edge the slip is rigid slip less what the surfaces give way; at the trailing edge of a patch that slips wholly it is
    that of Kalker's full sliding: a case of thirty times the creepages."""
    case = runs.of("library", "tread_half_space_case")
    values = {name: case[name] for name in CASE}
    given = {name: 30 * value if name in ("creepage", "lateral_creepage", "spin") else value for name, value in CASE.items()}
    sliding = half_space.solve_patch(**given)
    weight = sliding["pressure"] / np.sum(sliding["pressure"])
    mean_x, mean_y = np.sum(weight * sliding["slip_x"]), np.sum(weight * sliding["slip_y"])
    x, y = np.meshgrid(sliding["x"], sliding["y"])
    expect.near("creepage", 1e3 * mean_x, 1e3 * 30 * values["creepage"], relative=0.02)
    expect.near("lateral creepage", 1e3 * mean_y, 1e3 * 30 * values["lateral_creepage"], relative=0.03)
    turning = np.sum(weight * (x * sliding["slip_y"] - y * sliding["slip_x"])) / np.sum(weight * (x**2 + y**2))
    expect.near("spin", turning, 30 * values["spin"], relative=0.1)


@compared
def answer_for_a_gap(runs: Runs, expect: Expect) -> None:
    """The same ellipse by a gap of one's own."""
    own, answer = runs.of("library", "own gap"), runs.of("library", "tread_half_space_answer")
    for name, allowed in (("longitudinal_force", 0.01), ("lateral_force", 0.02), ("spin_moment", 0.15), ("max_pressure", 0.01), ("area", 0.05), ("approach", 0.01),
                          ("adhesion_share", 0.08), ("frictional_work", 0.03)):
        expect.near(name, own[name], answer[name], relative=allowed)
    expect.that("iterations", 0 < answer["iterations"] < 60 and 0 < own["iterations"] < 60)
