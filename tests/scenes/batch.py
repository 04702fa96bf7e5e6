#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The half-space solver as a library: tread batch and tread.half_space beside CONTACT's creep-force table, finer elements, a gap
given by points, and what is wrong on purpose."""

import csv
import os
import resource
import sys
import tempfile

import numpy as np

from tread import half_space
from tread.creep_table import FORCE, FRICTION, beside_table, random_cases, table_cases
from tread.files import read_table
from loaded_once import execute_on
from tread_runner import Check

program = os.path.abspath(sys.argv[1])
check = Check()

cases, forces = table_cases()
COLUMNS = dict(zip(cases, ("A_per_m", "B_per_m", "normal_force_N", "friction", "young_Pa", "poisson", "creepage", "lateral_creepage",
                           "spin_per_m", "element_x_m", "element_y_m")))


answers = half_space.solve(slip_order=1, contact_sixth=True, **cases)
for name, difference in beside_table(answers, cases, forces).items():
    check.below(f"creep table: {name}, over friction times load", difference, 1e-4)
without = half_space.solve(slip_order=1, **cases)
check.that("without CONTACT's sixth of an element the table is missed",
           np.abs(without["lateral_force"] - answers["lateral_force"]).max() > 1e-2 * FRICTION * FORCE)

with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    def batch(columns, output="out.csv", more=(), ranks=1):
        with open(path("cases.csv"), "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(columns)
            writer.writerows(zip(*[[f"{value:.17g}" if isinstance(value, float) else value for value in column] for column in columns.values()]))
        arguments = ["batch", path("cases.csv"), *(["--output", path(output)] if output else []), *more]
        return execute_on(ranks, arguments, program)

    full = {COLUMNS[name]: np.broadcast_to(value, len(answers["status"])).astype(float) for name, value in cases.items()}
    full["lateral_creepage"] = full["lateral_creepage"] + full["spin_per_m"] * full["element_x_m"] / 6.
    full["name"] = np.array([f"case {i}" for i in range(len(answers["status"]))])
    done = batch(full)
    check.that("the batch ends well and names the column that it only keeps", done.returncode == 0 and ": name\n" in done.stdout)
    out = read_table(path("out.csv"), text=("name",))
    check.that("its rows are those of the table of cases", np.array_equal(out["name"], full["name"])
               and np.array_equal(out["spin_per_m"], full["spin_per_m"]))
    check.below("batch less library, over the largest force", np.abs(out["lateral_force_N"] - answers["lateral_force"]).max()
                / FRICTION / FORCE, 1e-8)
    check.that("its other columns", all(np.allclose(out[column], answers[name], rtol=1e-8) for column, name in (
        ("longitudinal_force_N", "longitudinal_force"), ("spin_moment_Nm", "spin_moment"), ("max_pressure_Pa", "max_pressure"),
        ("adhesion_share", "adhesion_share"), ("iterations", "iterations"), ("area_m2", "area"), ("approach_m", "approach"),
        ("frictional_work_J_per_m", "frictional_work"), ("status", "status"))))

    # Indices of damage, from the answers in their own row and from the library.
    load = FORCE if np.isscalar(FORCE) else cases["normal_force"]
    used = np.hypot(out["longitudinal_force_N"], out["lateral_force_N"]) / load
    check.below("friction used", np.abs(out["friction_used"] - used).max(), 1e-8)
    check.below("T-gamma over area, Pa", np.abs(out["t_gamma_per_area_Pa"] / np.maximum(out["frictional_work_J_per_m"] / out["area_m2"], 1.) - 1.)[out["frictional_work_J_per_m"] > 1e-3].max(), 1e-7)
    indices = half_space.damage(answers, normal_force=load, shear_strength=300e6)
    check.that("those that need a yield stress are not there without it", "surface_fatigue_index" not in out)
    check.that("the library's are those of the batch", np.allclose(out["friction_used"], indices["friction_used"], rtol=1e-7, atol=1e-9)
               and np.allclose(out["regime_wear_rate_kg_per_m3"], indices["regime_wear_rate"], rtol=1e-7, atol=1e-12))

    def refused(name, result, code, words):
        said = result.stderr.strip().splitlines()
        check.that(f"{name}: one line", result.returncode == code and len(said) == 1 and all(word in said[0] for word in words))

    one = {name: values[:3] for name, values in full.items()}
    bad = {**one, "friction": np.array([0.3, -1., 0.3])}
    refused("a negative coefficient", batch(bad), 2, ["1 of 3 cases", "row 2", "friction = -1"])
    out = read_table(path("out.csv"), text=("name",))
    check.that("its row has nan and a status", np.isnan(out["lateral_force_N"][1]) and list(out["status"]) == [0, 1, 0])
    # Elements of their own size: the patch grows with softness.
    strong = batch({**one, "shear_strength_Pa": np.array([250e6, 300e6, 350e6])}, "strong.csv")
    out = read_table(path("strong.csv"), text=("name",))
    check.that("p0/k and the surface fatigue index of each row", strong.returncode == 0
               and np.allclose(out["shakedown_load_factor"], out["max_pressure_Pa"] / out["shear_strength_Pa"], rtol=1e-7)
               and np.allclose(out["surface_fatigue_index"], out["friction_used"] - out["shear_strength_Pa"] / out["max_pressure_Pa"], atol=1e-8))
    some = batch({**one, "shear_strength_Pa": np.array([250e6, np.nan, 350e6])}, "some.csv")
    out = read_table(path("some.csv"), text=("name",))
    check.that("a row whose strength is not known has the others", some.returncode == 0 and list(np.isnan(out["surface_fatigue_index"])) == [False, True, False] and not np.isnan(out["friction_used"]).any())
    refused("a strength in MPa", batch({**one, "shear_strength_Pa": np.array([250e6, 300., 350e6])}), 1, ["row 2", "'shear_strength_Pa' 300 must be from"])
    refused("a strength of nought", batch({**one, "shear_strength_Pa": np.array([250e6, 0., 350e6])}), 1, ["row 2", "'shear_strength_Pa'"])
    refused("Young's modulus in another unit", batch({**{name: values for name, values in one.items() if not name.startswith("element")},
                                                      "young_Pa": one["young_Pa"] * [1., 1e-9, 1.]}), 2, ["1 of 3 cases", "row 2", "young", "the gap rises by"])
    refused("a missing column", batch({name: values for name, values in one.items() if name != "friction"}), 1, ["'friction'"])
    refused("a word for a number", batch({**one, "poisson": np.array(["0.3", "much", "0.3"])}), 1, ["row 2", "'poisson'", "much"])
    refused("a column of answers", batch({**one, "status": np.zeros(3)}), 1, ["'status'", "answers"])
    refused("an unknown order", batch({**one, "slip_order": np.array([1., 2., 3.])}), 1, ["row 3", "slip_order"])
    refused("no rows", batch({name: values[:0] for name, values in one.items()}), 1, ["no rows"])
    refused("no --output", batch(one, None), 1, ["--output"])
    refused("a scene beside it", batch(one, more=["scene.prm"]), 1, ["scene.prm", "tread batch --help"])
    check.that("mpirun is refused, once", batch(one, ranks=2).stderr.count("start it without mpirun") == 1)
    refused("a folder that is not there", batch(one, "no/out.csv"), 2, ["no/out.csv"])
    os.symlink("/dev/full", path("full"))
    refused("a full disk", batch(one, "full"), 2, ["full"])
    check.that("a device stays one", os.path.islink(path("full")) and not os.path.isfile("/dev/full"))

# Elements as they are chosen, and half as large.
N = 200
drawn, semi_axes = random_cases(N)
chosen = half_space.solve(**drawn)
finer = half_space.solve(**drawn, element_x=semi_axes[0] / 32., element_y=semi_axes[1] / 32.)
change = np.hypot(*[chosen[name] - finer[name] for name in ("longitudinal_force", "lateral_force")])
# Strong spin makes forces that are small differences: those are within 0.5 % of the bound, most others of themselves.
check.below("chosen elements: change of the force by halves, over friction times load", change.max() / FRICTION / FORCE, 5e-3)
check.below("the same over the force itself, nine of ten", np.quantile(change / np.hypot(finer["longitudinal_force"], finer["lateral_force"]), 0.9), 5e-3)
check.below("frictional work", np.abs(chosen["frictional_work"] / finer["frictional_work"] - 1.).max(), 0.01)
serial = half_space.solve(threads=1, **drawn)
check.that("one thread gives the same bits", all(np.array_equal(serial[name], chosen[name]) for name in serial))
check.that("broadcast: a table of 2 by 3", half_space.solve(**{**drawn, **{k: v[0] for k, v in drawn.items() if np.ndim(v)}, "creepage": [[0.], [1e-3]],
           "spin": [0., .1, .2]})["lateral_force"].shape == (2, 3))

# A gap by points.
single = {name: float(np.broadcast_to(value, (N,))[0]) for name, value in drawn.items()}
size = {"element_x": semi_axes[0][0] / 12.3, "element_y": semi_axes[1][0] / 12.3}
# Gaps on elements that are too large for the patch, and gaps in mm, are refused as coarse ellipses are.
def refused(what, words, error=half_space.HalfSpaceError, **settings):
    try:
        half_space.solve_patch(**{"normal_force": 9e4, "friction": 0.3, "creepage": -1e-3, **settings})
        said = ""
    except error as complaint:
        said = str(complaint)
    check.that(f"{what} is refused: {said}", all(word in said for word in words))


def bowl(edge, n_x, n_y, unit=1.):
    places = [edge * (np.arange(n) - 0.5 * (n - 1)) for n in (n_x, n_y)]
    return {"gap": unit * (0.9 * places[0] ** 2 + 1.4 * places[1][:, None] ** 2), "x_first": places[0][0], "y_first": places[1][0],
            "element_x": edge, "element_y": edge}


for what, settings in (("one element in contact", bowl(12e-3, 9, 9)), ("three elements in contact", bowl(6e-3, 9, 9)), ("a grid of 1 x 1", bowl(1e-3, 1, 1)),
                       ("a grid of 1 x 29", bowl(1e-3, 1, 29)), ("a grid of 29 x 1", bowl(1e-3, 29, 1)), ("a gap in mm", bowl(1e-3, 29, 29, 1e3))):
    refused(what, ("element_x, element_y", "at least 5", "in m, not in mm"), **settings)
refused("a gap in mm on small elements", ("gap", "in m, not in mm"), **bowl(1e-4, 29, 29, 1e3))
# What the gap or a single case leaves without effect, and masked values, are errors.
plain = bowl(1e-3, 29, 29)
refused("a curvature beside a gap", ("gap excludes curvature_y",), TypeError, curvature_y=1.4, **plain)
refused("two loads for one patch", ("one case and was given 2",), TypeError, **{**plain, "normal_force": [8e4, 9e4]})
refused("a masked gap", ("gap has masked values",), TypeError, **{**plain, "gap": np.ma.masked_greater(plain["gap"], 1e-4)})
refused("a masked load", ("normal_force", "masked"), TypeError, **{**plain, "normal_force": np.ma.masked_less([9e4], 1e5)})
check.that("a mask that hides nothing is none", half_space.solve_patch(
    normal_force=9e4, friction=0.3, **{**plain, "gap": np.ma.masked_greater(plain["gap"], 1.)})["max_pressure"] > 1e9)
# Ellipses of bodies that are no half-spaces.
ball = {"curvature_x": 1.2, "curvature_y": 0.8, "normal_force": 7e4, "friction": 0.3}
for what, settings in (("radii in mm for curvatures", {"curvature_x": 420., "curvature_y": 310.}), ("a modulus in GPa", {"young": 205.}),
                       ("a force in mN", {"normal_force": 7e10})):
    refused(what, ("the gap rises by", "1/m, N and Pa"), creepage=0., **{**ball, **settings})
check.that("a radius of 6 mm under 300 N has an answer", half_space.solve_patch(
    curvature_x=80., curvature_y=80., normal_force=300., friction=0.3)["status"] == 0)
right = half_space.solve_patch(normal_force=9e4, friction=0.3, **bowl(1e-3, 29, 29))
hertz = half_space.solve_patch(normal_force=9e4, friction=0.3, curvature_x=0.9, curvature_y=1.4)
check.relative("the same gap in m: largest pressure, MPa", 1e-6 * right["max_pressure"], 1e-6 * hertz["max_pressure"], 0.01)
# A row of long elements is the plane problem of two cylinders: p0 = sqrt(E* q/(pi R)), q the load over the length.
edge, length, radius = 0.2e-3, 0.5, 0.25
x = edge * (np.arange(41) - 20)
strip = half_space.solve_patch(gap=0.5 / radius * x[None, :] ** 2, x_first=x[0], element_x=edge, element_y=length, normal_force=2e5, friction=0.)
check.relative("a strip of long elements: largest pressure, MPa", 1e-6 * strip["max_pressure"],
               1e-6 * np.sqrt(0.5 * 210e9 / (1. - 0.3 ** 2) * 2e5 / length / (np.pi * radius)), 0.01)
for what, call in (("solve_patch()", half_space.solve_patch), ("solve()", half_space.solve)):
    try:
        call(curvature_x=1., curvature_y=1., normal_force=1e4, friction=0.3, spin=0.1, contact_sixth=True)
        said = ""
    except TypeError as complaint:
        said = str(complaint)
    check.that(f"{what}: contact_sixth without element_x is an error: {said}", "element_x" in said)

ellipse = half_space.solve_patch(slip_order=1, **single, **size)
x, y = ellipse["x"], ellipse["y"]
rest = {name: value for name, value in single.items() if not name.startswith("curvature")}
points = half_space.solve_patch(slip_order=1, gap=single["curvature_x"] * x ** 2 + single["curvature_y"] * y[:, None] ** 2,
                                x_first=x[0], y_first=y[0], **rest, **size)
for name in ("longitudinal_force", "lateral_force", "spin_moment", "max_pressure"):
    check.relative(f"gap by points: {name}", points[name], ellipse[name], 1e-6)
area = size["element_x"] * size["element_y"]
check.relative("its fields sum up: load", points["pressure"].sum() * area, FORCE, 1e-9)
check.relative("and longitudinal force", points["shear_x"].sum() * area, points["longitudinal_force"], 1e-6)
check.that("stick where the bound is not reached, none outside", set(np.unique(points["state"])) <= {0., 1., 2.}
           and not points["pressure"][points["state"] == 0.].any())
# Far below the friction bound the force is linear in the creepage.
linear = [half_space.solve(curvature_x=1., curvature_y=1., normal_force=1e5, friction=f, creepage=xi)["longitudinal_force"] / xi
          for f, xi in ((0.3, -1e-7), (0.3, -1e-12), (1e4, -1e-3))]
check.relative("slope at a creepage of 1e-12", linear[1], linear[0], 1e-3)
check.relative("slope under large friction", linear[2], linear[0], 1e-3)
for name, change_of, words in (("a spin that overflows", {"spin": 1e300}, "spin"), ("no curvature", {"curvature_x": 0.}, "curvature_x"), ("elements too large", {"element_x": 1.}, "element_x"),
                               ("Poisson's ratio", {"poisson": 0.7}, "Poisson"), ("nan", {"spin": np.nan}, "spin")):
    try:
        half_space.solve(**{**single, **change_of})
        check.that(f"{name} is refused", False)
    except half_space.HalfSpaceError as error:
        check.that(f"{name} is refused by its name", words.replace("element_x", "element") in str(error))
check.that("or leaves nan", np.isnan(half_space.solve(on_failure="nan", **{**single, "friction": -1.})["longitudinal_force"]))

# Memory.
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
for _ in range(10):
    half_space.solve(**drawn)
check.below("memory that 2000 more cases left, MB", (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024., 5.)
check.exit()
