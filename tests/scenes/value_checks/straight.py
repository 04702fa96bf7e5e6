# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheel on a straight rail: every step is in the tables, so that means, extremes and works follow from the patches of all steps."""

from __future__ import annotations

import math

import numpy as np

from tread import hertz

from .engine import Expect, Of, Runs, compared, compared_each

RUN = "straight"
SPEED = 140 / 3.6
LAST_WAY, CELL = 10e-3, 1.3e-3


def instants(runs: Runs, names: tuple[str, ...], run: str = RUN) -> tuple[np.ndarray, list[np.ndarray]]:
    """(beginnings of the instants' rows, columns) of patches.csv."""
    table = runs.of(run, "patches.csv")
    time = table["time_s"]
    return np.flatnonzero(np.diff(time, prepend=-1.)), [table[name] for name in names]


def forces_of_nodes(runs: Runs, name: str) -> np.ndarray:
    """Of each instant the resultant of a traction, N."""
    begins, (area, traction) = instants(runs, ("area_mm2", name))
    return np.add.reduceat(area * traction, begins)


def in_end(runs: Runs) -> np.ndarray:
    """Instants while the wheel rolls over one cell around the end of the path."""
    begins, (position,) = instants(runs, ("position_mm",))
    return np.abs(position[begins]) <= 0.5e3 * CELL


@compared
def instants_of_the_way(runs: Runs, expect: Expect) -> None:
    history, table = runs.of(RUN, "history.csv"), runs.of(RUN, "patches.csv")
    time, position = history["time_s"], history["position_m"]
    expect.near("position", position, SPEED * time - 12e-3, absolute=1e-9)
    expect.near("the way, mm", position[-1], 0.5 * CELL, relative=0.03)
    begins = instants(runs, ("time_s",))[0]
    expect.near("patches: position", table["position_mm"], 1e3 * SPEED * table["time_s"] - 12., absolute=1e-6)
    expect.near("patches: time", np.interp(1e-3 * table["position_mm"][begins], position, time), table["time_s"][begins], absolute=1e-8)


@compared
def steps(runs: Runs, expect: Expect) -> None:
    summary, history = runs.of(RUN), runs.of(RUN, "history.csv")
    expect.near("a row for each step", summary["steps"], len(history["time_s"]))
    expect.near("time step", summary["time_step_s"] * summary["steps"], history["time_s"][-1], relative=1e-6)
    expect.near("rolled", summary["rolled_m"], history["position_m"][-1] + 12e-3, relative=1e-6)
    expect.near("element updates", summary["element_updates"], summary["cells"] * summary["steps"], relative=1e-9)
    expect.near("share of the steps", summary["contact_unconverged_share"], summary["contact_unconverged_steps"] / len(history["time_s"]), relative=1e-9)


@compared_each(("normal_force_N", 2), ("longitudinal_force_N", 0), ("lateral_force_N", 1))
def forces(runs: Runs, expect: Expect, which: tuple[str, int]) -> None:
    name, _ = which
    history = runs.of(RUN, "history.csv")
    last = (history["position_m"] > -LAST_WAY) & (history["position_m"] <= 0)
    expect.near(name, runs.of(RUN)[name], history[name][last].mean(), relative=4e-3)


@compared
def forces_of_the_patch(runs: Runs, expect: Expect) -> None:
    """The tread falls by 1 : 40 to the field side, so that the pressure has a part across."""
    history = runs.of(RUN, "history.csv")
    pressure, along, across = (forces_of_nodes(runs, name) for name in ("pressure_MPa", "shear_x_MPa", "shear_y_MPa"))
    n = min(len(pressure), len(history["time_s"]))
    slope = 1 / 40
    expect.near("normal force", history["normal_force_N"][:n], pressure[:n], relative=5e-3)
    expect.near("longitudinal force", history["longitudinal_force_N"][:n], along[:n], relative=5e-3)
    expect.near("lateral force", history["lateral_force_N"][:n], across[:n] - slope * pressure[:n], relative=5e-3)
    expect.near("traction", history["traction_coefficient"], history["longitudinal_force_N"] / history["normal_force_N"], relative=1e-9)


@compared
def load(runs: Runs, expect: Expect) -> None:
    weight = runs.number(RUN, "Vehicle/Gravity (m per s2)") * (runs.number(RUN, "Wheel/Mass (kg)") + runs.number(RUN, "Vehicle/Sprung mass (kg)"))
    expect.near("load", runs.of(RUN)["normal_force_N"], weight, relative=5e-3)


@compared
def patches_of_the_history(runs: Runs, expect: Expect) -> None:
    history = runs.of(RUN, "history.csv")
    begins, (area, pressure, state) = instants(runs, ("area_mm2", "pressure_MPa", "state"))
    n = min(len(begins), len(history["time_s"]))
    whole = np.add.reduceat(area, begins)
    expect.near("area", 1e6 * history["contact_area_m2"][:n], whole[:n], relative=1e-6)
    expect.near("largest pressure", 1e-6 * history["max_pressure_Pa"][:n], np.maximum.reduceat(pressure, begins)[:n], relative=1e-6)
    expect.near("adhesion", history["adhesion_share"][:n], (np.add.reduceat(area * (state == "adhesion"), begins) / whole)[:n], relative=1e-6)


@compared
def means_of_the_patch(runs: Runs, expect: Expect) -> None:
    summary, end = runs.of(RUN), in_end(runs)
    begins, (x, y, area, pressure, along, across, state) = instants(
        runs, ("x_mm", "y_mm", "area_mm2", "pressure_MPa", "shear_x_MPa", "shear_y_MPa", "state"))
    whole, force = np.add.reduceat(area, begins), np.add.reduceat(area * pressure, begins)
    mean = lambda values: values[end].mean()
    largest = lambda values: np.maximum.reduceat(values, begins)
    moment = lambda values: np.add.reduceat(values * area * pressure, begins) / force
    expect.near("largest pressure", 1e-6 * summary["max_pressure_Pa"], mean(largest(pressure)), relative=2e-3)
    expect.near("area", 1e6 * summary["patch_area_m2"], mean(whole), relative=2e-3)
    expect.near("adhesion", summary["adhesion_share"], mean(np.add.reduceat(area * (state == "adhesion"), begins) / whole), relative=5e-3)
    expect.near("largest shear stress", 1e-6 * summary["max_shear_Pa"], mean(largest(np.hypot(along, across))), relative=2e-3)
    cell = np.sqrt(whole / np.diff(begins, append=len(x)))
    for name, places in (("semi_axis_x_m", x), ("semi_axis_y_m", y)):
        extent = np.maximum.reduceat(places, begins) - np.minimum.reduceat(places, begins) + cell
        expect.near(name, 1e3 * summary[name], mean(0.5 * extent), relative=3e-3)
    for axis, places in (("x", x), ("y", y)):
        centre = moment(places)
        expect.near(f"semi-axis by moments, {axis}", 1e3 * summary[f"pressure_semi_axis_{axis}_m"], mean(np.sqrt(5 * (moment(places**2) - centre**2))), relative=2e-3)
        expect.near(f"centre of the pressure, {axis}", 1e3 * summary[f"pressure_centre_{axis}_m"], mean(centre), relative=2e-3, absolute=0.008)
    expect.near("lateral coefficient", summary["lateral_coefficient"], mean(np.add.reduceat(area * across, begins)) / mean(force), relative=3e-3)


@compared
def slip_of_the_patch(runs: Runs, expect: Expect) -> None:
    summary, history, end = runs.of(RUN), runs.of(RUN, "history.csv"), in_end(runs)
    begins, (area, along, across, slip_x, slip_y, time) = instants(
        runs, ("area_mm2", "shear_x_MPa", "shear_y_MPa", "slip_x_m_per_s", "slip_y_m_per_s", "time_s"))
    power = np.add.reduceat(-area * (along * slip_x + across * slip_y), begins)
    expect.near("frictional power", summary["frictional_power_W"], power[end].mean(), relative=5e-3)
    expect.near("largest micro-slip", summary["max_slip_m_per_s"], np.maximum.reduceat(np.hypot(slip_x, slip_y), begins)[end].mean(), relative=5e-3)
    work = np.cumsum(power * np.diff(time[begins], prepend=0.))
    own = np.interp(time[begins], history["time_s"], history["frictional_work_J"])
    expect.near("frictional work", own - own[0], work - work[0], relative=0.02)


@compared
def slip_opposes_the_shear_stress(runs: Runs, expect: Expect) -> None:
    """At nodes that slip, with the size of the friction bound."""
    for file in ("patch.csv", "patch_averaged.csv"):
        table = runs.of(RUN, file)
        slips = (table["state"] == "slip") & (table["pressure_MPa"] > 0.2 * table["pressure_MPa"].max())
        size = np.hypot(table["shear_x_MPa"], table["shear_y_MPa"])
        if file == "patch.csv":
            expect.near("friction bound", size[slips], 0.4 * table["pressure_MPa"][slips], relative=2e-3)
        speed = np.hypot(table["slip_x_m_per_s"], table["slip_y_m_per_s"])
        for axis in "xy":
            expect.near(f"{file}: direction {axis}", (table[f"slip_{axis}_m_per_s"] / speed)[slips].mean(),
                        (-table[f"shear_{axis}_MPa"] / size)[slips].mean(), absolute=0.06)


@compared
def patch_at_the_end(runs: Runs, expect: Expect) -> None:
    """The patch at the solution instant is that of the table of all instants nearest to it."""
    patch = runs.of(RUN, "patch.csv")
    names = ("x_mm", "y_mm", "z_mm", "area_mm2", "pressure_MPa", "shear_x_MPa", "shear_y_MPa", "slip_x_m_per_s", "slip_y_m_per_s", "state")
    begins, columns = instants(runs, names)
    position = instants(runs, ("position_mm",))[1][0]
    number = int(np.argmax(position[begins] >= 0))
    rows = slice(begins[number], begins[number + 1])
    for name, values in zip(names, columns):
        if name == "state":
            expect.near("adhering nodes", np.sum(patch["state"] == "adhesion"), np.sum(values[rows] == "adhesion"), absolute=2)
        else:
            of_wheel = values[rows]
            expect.near(f"mean of {name}", patch[name].mean(), of_wheel.mean(), relative=3e-3, absolute=8e-3 if name == "x_mm" else 1e-6)
            expect.near(f"spread of {name}", np.sort(patch[name])[-3:].mean(), np.sort(of_wheel)[-3:].mean(), relative=2e-2, absolute=2e-3)


@compared
def averaged_patch(runs: Runs, expect: Expect) -> None:
    patch, end = runs.of(RUN, "patch_averaged.csv"), in_end(runs)
    begins, (area,) = instants(runs, ("area_mm2",))
    for name in ("pressure_MPa", "shear_x_MPa", "shear_y_MPa"):
        expect.near(f"resultant of {name}", np.sum(patch["area_mm2"] * patch[name]), forces_of_nodes(runs, name)[end].mean(), relative=5e-3)
    for axis in "xyz":
        _, (places, pressure) = instants(runs, (f"{axis}_mm", "pressure_MPa"))
        weight = np.add.reduceat(area * pressure, begins)
        centre = (np.add.reduceat(area * pressure * places, begins) / weight)[end].mean()
        of_patch = np.sum(patch["area_mm2"] * patch["pressure_MPa"] * patch[f"{axis}_mm"]) / np.sum(patch["area_mm2"] * patch["pressure_MPa"])
        expect.near(f"centre, {axis}", of_patch, centre, relative=5e-3, absolute=8e-3)
    whole = np.add.reduceat(area, begins)[end].mean()
    expect.that("area of all nodes that were in contact", whole < np.sum(patch["area_mm2"]) < 1.3 * whole)


@compared
def wheel_lies_on_the_cone(runs: Runs, expect: Expect) -> None:
    """On the crown of 300 mm a cone of 1 : 40 touches 7.5 mm to the gauge side, 0.094 mm below its top."""
    expect.near("first contact", 1e3 * runs.of(RUN)["first_contact_y_m"], -300 * math.sin(math.atan(1 / 40)), relative=2e-3)
    patch = runs.of(RUN, "patch.csv")
    middle = np.average(patch["y_mm"], weights=patch["pressure_MPa"])
    # The rail takes its part of the approach.
    give = [(1 - runs.number(RUN, f"{body}/Poisson's ratio")**2) / runs.number(RUN, f"{body}/Young's modulus (GPa)") for body in ("Rail", "Wheel")]
    sinks = 1e3 * ellipse(runs, RUN, runs.of(RUN)["normal_force_N"])["approach_m"] * give[0] / sum(give)
    for name in ("patch.csv", "patches.csv"):
        table = runs.of(RUN, name)
        expect.near(f"{name}: height", np.average(table["z_mm"], weights=table["pressure_MPa"]), -middle**2 / 600 - sinks, absolute=0.03)


@compared
def ripple_of_the_forces(runs: Runs, expect: Expect) -> None:
    summary, history = runs.of(RUN), runs.of(RUN, "history.csv")
    x = history["position_m"]
    last = (x > -LAST_WAY) & (x <= 0)
    normal = history["normal_force_N"][last]
    expect.near("normal force", summary["normal_force_ripple_share"], np.abs(normal / normal.mean() - 1).max(), relative=0.05)
    rest = 0.
    for name in ("longitudinal_force_N", "lateral_force_N"):
        force = history[name][last]
        rest += np.mean((force - np.polyval(np.polyfit(x[last], force, 1), x[last]))**2)
    expect.near("tangential force", summary["tangential_force_ripple_share"], math.sqrt(2 * rest) / normal.mean(), relative=0.06)


@compared
def creepage(runs: Runs, expect: Expect) -> None:
    summary, history = runs.of(RUN), runs.of(RUN, "history.csv")
    expect.near("as given", summary["creepage"], runs.number(RUN, "Motion/Creepage"), relative=1e-6)
    expect.near("history", history["creepage"], runs.number(RUN, "Motion/Creepage"), relative=1e-6)
    expect.near("traction", summary["traction_coefficient"], summary["longitudinal_force_N"] / summary["normal_force_N"], relative=1e-9)
    expect.near("friction", summary["friction_coefficient"], runs.number(RUN, "Contact/Friction coefficient"))


ENERGIES = ("external_work_J", "kinetic_energy_J", "internal_energy_J", "hourglass_energy_J", "frictional_work_J", "contact_loss_J", "damping_work_J", "plastic_work_J")


@compared_each(RUN, "track", "curve", "plastic")
def energies(runs: Runs, expect: Expect, run: str) -> None:
    summary, history = runs.of(run), runs.of(run, "history.csv")
    stored = sum(history[name] for name in ENERGIES[1:]) + (history["spring_energy_J"] if "spring_energy_J" in history else 0.)
    expect.near("balance", history["energy_residual_J"], history["external_work_J"] - stored, relative=1e-6, absolute=1e-7)
    for name in ("external_work_J", "frictional_work_J", "contact_loss_J", "damping_work_J", "plastic_work_J", "energy_residual_J"):
        expect.near(name, summary[name], history[name][-1], relative=1e-6, absolute=1e-9)
    expect.near("contact", summary["contact_work_on_nodes_J"], history["frictional_work_J"][-1] + history["contact_loss_J"][-1], relative=1e-7)


@compared_each(RUN, "track", "curve", "plastic")
def shares_of_the_energies(runs: Runs, expect: Expect, run: str) -> None:
    summary, history = runs.of(run), runs.of(run, "history.csv")
    friction, plastic, damping, loss, residual = (history[f"{name}_J"][-1] for name in (
        "frictional_work", "plastic_work", "damping_work", "contact_loss", "energy_residual"))
    dissipated = friction + plastic + damping + abs(loss)
    expect.near("dissipated", summary["dissipated_work_J"], dissipated, relative=1e-6)
    expect.near("residual of dissipated", summary["energy_residual_of_dissipated"], residual / dissipated, relative=1e-5)
    expect.near("loss of dissipated", summary["contact_loss_of_dissipated"], loss / dissipated, relative=1e-6)
    expect.near("loss of friction and plasticity", summary["contact_loss_of_friction_and_plasticity"], loss / (friction + plastic), relative=1e-6)
    expect.near("damping of friction and plasticity", summary["damping_of_friction_and_plasticity"], damping / (friction + plastic), relative=1e-6)
    expect.near("residual share", summary["energy_residual_share"], residual / summary["gross_work_J"], relative=1e-5)


@compared_each((RUN, 0.02), ("track", 0.05), ("curve", 0.02), ("plastic", 0.02))
def energy_is_kept(runs: Runs, expect: Expect, which: tuple[str, float]) -> None:
    run, allowed = which
    history = runs.of(run, "history.csv")
    dissipated = history["frictional_work_J"][-1] + history["plastic_work_J"][-1] + history["damping_work_J"][-1]
    expect.near("residual", history["energy_residual_J"][-1], 0., absolute=allowed * dissipated)


@compared
def means_that_chatter_is_counted_from(runs: Runs, expect: Expect) -> None:
    """Root mean square of each node's slip about the straight line over its own place in the patch, over the largest mean slip."""
    end = in_end(runs)
    begins, (x, position, y, slip_x, slip_y) = instants(runs, ("x_mm", "position_mm", "y_mm", "slip_x_m_per_s", "slip_y_m_per_s"))
    wanted = np.repeat(end, np.diff(begins, append=len(x)))
    node = np.round((x + position)[wanted] / 1.3) * 1000 + np.round(y[wanted] / 1.3)
    squares, count, largest = 0., 0, 0.
    for number in np.unique(node):
        rows = node == number
        places, slips = x[wanted][rows], (slip_x[wanted][rows], slip_y[wanted][rows])
        largest = max(largest, np.hypot(*[slip.mean() for slip in slips]))
        if len(places) >= 3:
            squares += sum(np.sum((slip - np.polyval(np.polyfit(places, slip, 1), places))**2) for slip in slips)
            count += len(places)
    expect.near("chatter", runs.of(RUN)["slip_chatter_share"], math.sqrt(squares / count) / largest, relative=0.05)


@compared
def words(runs: Runs, expect: Expect) -> None:
    summary, parameters = runs.of(RUN), runs.parameters[RUN]
    expect.same("title", summary["title"], parameters["Scene/Title"])
    expect.same("method", summary["method"], "explicit finite elements")
    expect.same("completed", summary["completed"], bool(runs.of(RUN, "history.csv")["position_m"][-1] > 0))
    expect.near("ranks", summary["ranks"], 1)
    expect.near("density scale", summary["density_scale"], float(parameters["Scene/Density scale"]))
    assumed = summary["assumptions"]
    expect.same("assumptions begin with", [text.split(" ")[0] for text in assumed], ["density", "mass", "the", "the"])
    expect.that("assumptions", "times 25" in assumed[0] and "5000 per s" in assumed[1] and "axle" in assumed[2] and assumed[3].endswith("predicts for steady rolling"))
    expect.that("warnings", len(summary["warnings"]) == 2 and summary["warnings"][0].startswith("contact did not reach its tolerance in many steps (100 %, above 1 %)")
                and summary["warnings"][0].endswith("'Contact/Tolerance'"))
    expect.same("a warning of a short way", summary["warnings"][1],
                f"only {summary['rolled_patch_lengths']:.1f} patch lengths rolled since the start: steady rolling takes 1.5 or more")
    unused = summary["unused_parameters"]
    expect.that("unused", len(unused) == 1 and "Hold distance" in unused[0] and not unused[0].endswith("-"))


def pair_modulus(runs: Runs, run: str) -> float:
    return 1 / sum((1 - runs.number(run, f"{body}/Poisson's ratio")**2) / (1e9 * runs.number(run, f"{body}/Young's modulus (GPa)")) for body in ("Wheel", "Rail"))


def ellipse(runs: Runs, run: str, force: float) -> dict[str, float]:
    """Hertz's, of a wheel of 0.46 m on a crown of 0.3 m; one on its cone of 1 : 40 is 7.5 mm * 1 / 40 larger there."""
    curvature_x, curvature_y = 0.5 / (0.46 + 7.5e-3 / 40), 0.5 / 0.3
    modulus = pair_modulus(runs, run)
    ratio = hertz.ratio_of_semi_axes(curvature_x, curvature_y)
    a, b = hertz.semi_axes(curvature_x, ratio, force, modulus)
    return {"semi_axis_x_m": a, "semi_axis_y_m": b, "pressure_semi_axis_x_m": a, "pressure_semi_axis_y_m": b, "patch_area_m2": math.pi * a * b,
            "max_pressure_Pa": 1.5 * force / (math.pi * a * b), "approach_m": hertz.approach(a, b, force, modulus)}


@compared_each(RUN, "half")
def beside_hertz(runs: Runs, expect: Expect, run: str) -> None:
    summary = runs.of(run)
    of_hertz = ellipse(runs, run, summary["normal_force_N"])
    for name in ("max_pressure_Pa", "patch_area_m2", "semi_axis_x_m", "semi_axis_y_m", "pressure_semi_axis_x_m", "pressure_semi_axis_y_m"):
        value, path = summary[name], f"reference/{name}/Hertz"
        expect.near(f"Hertz: {name}", summary[path + "/value"], of_hertz[name], relative=3e-3)
        expect.near(f"difference of {name}", summary[path + "/relative_difference"], value / summary[path + "/value"] - 1, relative=1e-6)
        expect.same("source", summary[path + "/source"], "Hertz")


@compared_each("max_pressure_Pa", "creepage", "lateral_coefficient", "adhesion_share", "max_shear_Pa", "max_slip_m_per_s", "frictional_power_W")
def beside_the_half_space(runs: Runs, expect: Expect, name: str) -> None:
    """The same scene by the half-space alone, whose load is that of the masses."""
    summary, half = runs.of(RUN), runs.of("half")
    path = f"reference/{name}/half-space"
    alone = half["lateral_force_N"] / half["normal_force_N"] if name == "lateral_coefficient" else half[name]
    expect.near(f"half-space: {name}", summary[path + "/value"], alone, relative=0.04 if name == "frictional_power_W" else 0.02)
    expect.near(f"difference of {name}", summary[path + "/relative_difference"], summary[name] / summary[path + "/value"] - 1, relative=1e-6)
    expect.same("source", summary[path + "/source"], "half-space")
    if name == "max_pressure_Pa":
        expect.near(f"uncertainty of {name}", summary[path + "/uncertainty"], half[f"{name}_half_space_uncertainty"], relative=0.3)


@compared
def rolled_lengths(runs: Runs, expect: Expect) -> None:
    summary = runs.of(RUN)
    lengths = summary["rolled_m"] / (2 * ellipse(runs, RUN, summary["normal_force_N"])["semi_axis_x_m"])
    expect.near("lengths of the patch", summary["rolled_patch_lengths"], lengths, relative=3e-3)
    expect.same("long enough", summary["long_enough_to_be_steady"], bool(lengths > 1.5))


@compared
def inertia(runs: Runs, expect: Expect) -> None:
    """Rayleigh waves by Viktorov's formula, 0.1 % from the root of Rayleigh's equation."""
    slowest = min((0.87 + 1.12 * nu) / (1 + nu) * math.sqrt(0.5e9 * young / (1 + nu) / density) for young, nu, density in (
        [runs.number(RUN, f"{body}/{name}") for name in ("Young's modulus (GPa)", "Poisson's ratio", "Density (kg per m3)")] for body in ("Wheel", "Rail")))
    expect.near("estimate", runs.of(RUN)["inertia_error_estimate"], runs.number(RUN, "Scene/Density scale") * (SPEED / slowest)**2, relative=8e-3)


@compared
def peaks_of_the_patch(runs: Runs, expect: Expect) -> None:
    """Of all steps, within the region."""
    summary = runs.of(RUN)
    _, (x, position, y, time, pressure, along, across) = instants(
        runs, ("x_mm", "position_mm", "y_mm", "time_s", "pressure_MPa", "shear_x_MPa", "shear_y_MPa"))
    x = x + position
    region = (x >= -9) & (x <= 0)
    for name, values in (("peak_pressure", pressure), ("peak_shear", np.hypot(along, across))):
        most = values[region].max()
        at = np.argmin(np.hypot(np.hypot(x - 1e3 * summary[f"{name}_x_m"], y - 1e3 * summary[f"{name}_y_m"]), 1e3 * SPEED * (time - summary[f"{name}_time_s"])))
        expect.near(f"{name}", 1e-6 * summary[f"{name}_Pa"], most, relative=5e-3)
        expect.near(f"{name}: there", values[at], most, relative=5e-3)
        expect.near(f"{name}: x", 1e3 * summary[f"{name}_x_m"], x[at], absolute=0.02)
        expect.near(f"{name}: y", 1e3 * summary[f"{name}_y_m"], y[at], absolute=0.02)
        expect.near(f"{name}: time, us", 1e6 * summary[f"{name}_time_s"], 1e6 * time[at], absolute=1.)


@compared_each(("peak_", "peak_stress.csv"), ("wheel_peak_", "peak_stress_wheel.csv"))
def peaks_of_stress(runs: Runs, expect: Expect, which: tuple[str, str]) -> None:
    prefix, file = which
    summary, table = runs.of(RUN), runs.of(RUN, file)
    depth = table["depth_mm"]
    cells = depth > 0
    for name, rows in (("von_mises", cells), ("surface_von_mises", ~cells)):
        most = int(np.flatnonzero(rows)[np.argmax(table["von_mises_MPa"][rows])])
        for key, column, factor in (("Pa", "von_mises_MPa", 1e-6), ("x_m", "x_mm", 1e3), ("y_m", "y_mm", 1e3), ("time_s", "time_s", 1.), ("depth_m", "depth_mm", 1e3)):
            if f"{prefix}{name}_{key}" in summary:
                expect.near(f"{prefix}{name}_{key}", factor * summary[f"{prefix}{name}_{key}"], table[column][most], relative=1e-6)
    expect.near("wheel", table["wheel_x_mm"], 1e3 * SPEED * table["time_s"] - 12., absolute=1e-4)
    shear = runs.number(RUN, "Wheel/Young's modulus (GPa)" if "wheel" in file else "Rail/Young's modulus (GPa)") / (
        2 + 2 * runs.number(RUN, "Wheel/Poisson's ratio" if "wheel" in file else "Rail/Poisson's ratio"))
    expect.near("strain, per cent", table["equivalent_strain_percent"], 0.1 * table["von_mises_MPa"] / (3 * shear), relative=1e-6)


@compared_each(("peak_", "rail", 0.06), ("wheel_peak_", "wheel", 0.06))
def stresses_beside_the_half_space(runs: Runs, expect: Expect, which: tuple[str, str, float]) -> None:
    prefix, body, allowed = which
    summary, half = runs.of(RUN), runs.of("half")
    expect.near("von Mises", summary[f"{prefix}von_mises_Pa"], half[f"{body}_max_von_mises_Pa"], relative=allowed)
    expect.near("depth", 1e3 * summary[f"{prefix}von_mises_depth_m"], 1e3 * half[f"{body}_max_von_mises_depth_m"], absolute=0.9)
    expect.near("y", 1e3 * summary[f"{prefix}von_mises_y_m"], -7.5, absolute=2.)
