# SPDX-License-Identifier: LGPL-2.1-or-later
"""Half-space answers: `tread reference`, and the C library."""

from __future__ import annotations

import math

import numpy as np

from .engine import Expect, Runs, compared, compared_each
from .straight import ellipse, pair_modulus


@compared
def normal_problem(runs: Runs, expect: Expect) -> None:
    summary = runs.of("half")
    of_hertz = ellipse(runs, "half", summary["normal_force_N"])
    for name, allowed in (("max_pressure_Pa", 5e-3), ("patch_area_m2", 0.02), ("semi_axis_x_m", 0.03), ("semi_axis_y_m", 0.05),
                          ("pressure_semi_axis_x_m", 8e-3), ("pressure_semi_axis_y_m", 8e-3), ("approach_m", 5e-3)):
        expect.near(name, summary[name], of_hertz[name], relative=allowed)
    expect.near("load", summary["normal_force_N"], 9.81 * (900 + 13400), relative=1e-9)
    expect.same("method", summary["method"], "half-space solver")
    expect.near("ranks", summary["ranks"], 1)
    expect.near("ranks", runs.of("half_alike")["ranks"], 2)


@compared
def tangential_problem(runs: Runs, expect: Expect) -> None:
    """Resultants of the table of elements; the summary has the limit of small ones."""
    summary, patch = runs.of("half"), runs.of("half", "patch.csv")
    area, pressure, along, across = (patch[name] for name in ("area_mm2", "pressure_MPa", "shear_x_MPa", "shear_y_MPa"))
    expect.near("elements", summary["elements"], len(area))
    lines, rows = (np.unique(np.round(patch[f"{axis}_mm"], 6)) for axis in "xy")
    size_x, size_y = np.median(np.diff(lines)), np.median(np.diff(rows))
    expect.near("their length", 1e3 * summary["element_size_m"], size_x, relative=1e-5)
    expect.near("their area", size_x * size_y * len(area), np.sum(area), relative=1e-5)
    expect.near("normal force", np.sum(area * pressure), summary["normal_force_N"], relative=2e-3)
    expect.near("longitudinal force", np.sum(area * along), summary["longitudinal_force_N"], relative=5e-3)
    expect.near("lateral force", np.sum(area * across), summary["lateral_force_N"], relative=0.015)
    expect.near("adhesion", np.sum(area[patch["state"] == "adhesion"]) / np.sum(area), summary["adhesion_share"], relative=0.02)
    expect.near("largest shear stress", np.hypot(along, across).max(), 1e-6 * summary["max_shear_Pa"], relative=0.08)
    expect.near("slip", np.hypot(patch["slip_x_m_per_s"], patch["slip_y_m_per_s"]).max(), summary["max_slip_m_per_s"], relative=0.15)
    power = -np.sum(area * (along * patch["slip_x_m_per_s"] + across * patch["slip_y_m_per_s"]))
    expect.near("frictional power", power, summary["frictional_power_W"], relative=0.02)
    expect.near("centre, x", 1e3 * summary["pressure_centre_x_m"], np.average(patch["x_mm"], weights=pressure), absolute=0.03)
    expect.near("centre, y", 1e3 * summary["pressure_centre_y_m"], np.average(patch["y_mm"], weights=pressure), relative=5e-3)
    bound = 0.4 * pressure
    expect.that("friction bound", np.all(np.hypot(along, across) <= bound * (1 + 1e-6) + 1e-6))


@compared
def solver_of_the_half_space(runs: Runs, expect: Expect) -> None:
    summary = runs.of("half")
    expect.that("residuals", 0 <= summary["normal_residual"] < 1e-5 and 0 <= summary["tangential_residual"] < 1e-5)


@compared_each("wheel", "rail")
def stresses_below(runs: Runs, expect: Expect, body: str) -> None:
    """Von Mises stress and mean of the components, and Johnson's largest value of an ellipse."""
    table, summary = runs.of("half", "subsurface.csv"), runs.of("half")
    rows = table["body"] == body
    xx, yy, zz, xy, xz, yz = (table[f"{name}_MPa"][rows] for name in ("xx", "yy", "zz", "xy", "xz", "yz"))
    expect.near("mean", table["mean_stress_MPa"][rows], (xx + yy + zz) / 3, relative=1e-5)
    mises = np.sqrt(0.5 * ((xx - yy)**2 + (yy - zz)**2 + (zz - xx)**2) + 3 * (xy**2 + xz**2 + yz**2))
    expect.near("von Mises", table["von_mises_MPa"][rows], mises, relative=1e-5)
    expect.near("largest", 1e-6 * summary[f"{body}_max_von_mises_Pa"], table["von_mises_MPa"][rows & (table["line"] == "maximum") & (table["depth_mm"] > 0.3)].max(), relative=0.02)
    on_line = rows & (table["line"] == "maximum")
    expect.near("x", 1e3 * summary[f"{body}_max_von_mises_x_m"], table["x_mm"][on_line][0], absolute=0.3)
    deepest = table["depth_mm"][on_line][np.argmax(np.where(table["depth_mm"][on_line] > 0.2, table["von_mises_MPa"][on_line], 0))]
    expect.near("depth", 1e3 * summary[f"{body}_max_von_mises_depth_m"], deepest, absolute=0.3)
    centre = rows & (table["line"] == "centre")
    expect.near("centre", table["x_mm"][centre], 0., absolute=1e-9)
    expect.near("y", table["y_mm"][rows], 1e3 * summary["first_contact_y_m"], relative=1e-6)
    surface = table["depth_mm"][centre] == 0
    patch = runs.of("half", "patch.csv")
    nearest = int(np.argmin(np.hypot(patch["x_mm"], patch["y_mm"] - 1e3 * summary["first_contact_y_m"])))
    expect.near("pressure at the surface", -table["zz_MPa"][centre][surface], patch["pressure_MPa"][nearest], relative=0.02)
    # Both half-spaces have the depth into themselves, and both tables the tractions on the wheel, mirrored with the depth.
    sign = -1.
    expect.near("shear at the surface", table["xz_MPa"][centre][surface], sign * patch["shear_x_MPa"][nearest], relative=0.1, absolute=3.)
    expect.near("shear across", table["yz_MPa"][centre][surface], sign * patch["shear_y_MPa"][nearest], relative=0.2, absolute=3.)


@compared_each("wheel", "rail")
def depth_of_the_stresses(runs: Runs, expect: Expect, body: str) -> None:
    """zz of the tractions on a half-space (Johnson 1985, eq. 3.19 and 3.75), whatever its Poisson's ratio; the rail bears their reaction."""
    table, patch, y0 = runs.of("half", "subsurface.csv"), runs.of("half", "patch.csv"), 1e3 * runs.of("half")["first_contact_y_m"]
    sign = 1. if body == "wheel" else -1.
    for line in ("centre", "maximum"):
        rows = (table["body"] == body) & (table["line"] == line) & (table["depth_mm"] > 2.)
        for row in np.flatnonzero(rows)[::6]:
            depth, zz = table["depth_mm"][row], table["zz_MPa"][row]
            x, y = table["x_mm"][row] - patch["x_mm"], table["y_mm"][row] - patch["y_mm"]
            r5 = (x**2 + y**2 + depth**2)**2.5
            area = patch["area_mm2"]
            expected = -3 / (2 * np.pi) * np.sum(area * (patch["pressure_MPa"] * depth**3 + sign * depth**2 * (patch["shear_x_MPa"] * x + patch["shear_y_MPa"] * y)) / r5)
            expect.near(f"{line} at {depth:.2f} mm", zz, expected, relative=0.01)
    expect.that("y", abs(y0) > 1.)


@compared
def start_of_rolling(runs: Runs, expect: Expect) -> None:
    table, summary = runs.of("half_alike", "transient.csv"), runs.of("half_alike")
    expect.near("from", table["rolled_mm"][0], 0., absolute=0.7)
    expect.near("to", table["rolled_mm"][-1], 45., relative=0.02)
    expect.near("force", table["longitudinal_force_N"], table["traction_coefficient"] * summary["normal_force_N"], relative=1e-5)
    expect.near("at the end nearly steady", table["traction_coefficient"][-1], summary["traction_coefficient"], relative=0.06)
    expect.near("at the end nearly steady, across", table["lateral_coefficient"][-1], summary["lateral_force_N"] / summary["normal_force_N"], relative=0.1)
    expect.near("creepage", table["creepage"], runs.number("half_alike", "Motion/Creepage"), relative=2e-3)


@compared
def creepage_given(runs: Runs, expect: Expect) -> None:
    for run in ("half", "half_alike"):
        expect.near("as given", runs.of(run)["creepage"], runs.number(run, "Motion/Creepage"), relative=1e-6)
