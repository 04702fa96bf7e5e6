# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two wheels on a bar on sleepers, the first one through a dip; a smooth twin, and what is made of both."""

from __future__ import annotations

import math

import numpy as np

from .engine import Expect, Runs, compared, compared_each

RUN = "track"
SPEED = 100 / 3.6
SUPPORTS = (1, 2, 3, 4)


def static_load(runs: Runs, run: str = RUN) -> float:
    return runs.number(run, "Vehicle/Gravity (m per s2)") * (runs.number(run, "Wheel/Mass (kg)") + runs.number(run, "Vehicle/Sprung mass (kg)"))


@compared
def extremes_of_the_force(runs: Runs, expect: Expect) -> None:
    summary, history = runs.of(RUN), runs.of(RUN, "history.csv")
    force, x = history["normal_force_N"], history["position_m"]
    for name, row in (("largest", int(np.argmax(force))), ("least", int(np.argmin(force)))):
        expect.near(f"{name}", 1e-3 * summary[f"{name}_normal_force_N"], 1e-3 * force[row], relative=1e-8)
        expect.near(f"{name}: x", 1e3 * summary[f"{name}_normal_force_x_m"], 1e3 * x[row], relative=1e-8)
        expect.near(f"{name} over static", summary[f"{name}_normal_force_over_static"], force[row] / static_load(runs), relative=1e-6)
        expect.same(f"{name}: at the end", summary[f"{name}_normal_force_at_end"], row == len(x) - 1)
    expect.near("in the air", summary["airborne_s"], np.sum(np.diff(history["time_s"], prepend=0.)[force <= 0]), absolute=1e-9)


@compared_each("pad", "ballast")
def extremes_of_the_supports(runs: Runs, expect: Expect, layer: str) -> None:
    summary, history = runs.of(RUN), runs.of(RUN, "history.csv")
    forces = np.array([history[f"support_{i}_{layer}_N"] for i in SUPPORTS])
    support, row = np.unravel_index(np.argmax(forces), forces.shape)
    expect.near("largest", 1e-3 * summary[f"largest_{layer}_force_N"], 1e-3 * forces[support, row], relative=1e-8)
    expect.near("x", 1e3 * summary[f"largest_{layer}_force_x_m"], 1e3 * history["position_m"][row], relative=1e-8)
    expect.near("support", summary[f"largest_{layer}_force_support"], SUPPORTS[support])
    expect.same("at the end", summary[f"largest_{layer}_force_at_end"], bool(row == forces.shape[1] - 1))


@compared
def mass_of_the_finest_cells(runs: Runs, expect: Expect) -> None:
    """What it takes that cubes of the finest size, in two layers under both paths, allow a step half as long again as their own."""
    from tread import hertz

    from .straight import pair_modulus
    summary, number = runs.of(RUN), lambda name: runs.number(RUN, name)
    wanted = 1e-6 * number("Time stepping/Least step (us)")
    expect.that("a step that is at least what was wanted", wanted < summary["time_step_s"] < 1.5 * wanted)
    cell, width, path = (1e-3 * number(name) for name in ("Mesh/Finest cell (mm)", "Mesh/Fine half width (mm)", "Motion/Rolled distance (mm)"))
    density, n_wheels = number("Rail/Density (kg per m3)"), 2
    cubes = n_wheels * number("Mesh/Fine layers") * 2 * width / cell * path / cell
    expect.that("rail, kg: more than a quarter of the path's finest cells' own, less than six times it: they go on beyond its ends",
                0.25 < summary["added_mass_rail_kg"] / (cubes * density * cell**3) < 6)
    expect.that("wheels, kg: a little less, as their fine cells end with their sectors", 0.4 < summary["added_mass_wheels_kg"] / summary["added_mass_rail_kg"] < 1.2)
    expect.near("rail, share", 1e3 * summary["added_mass_rail_share"], 1e3 * summary["added_mass_rail_kg"] / (0.08 * 0.15 * 1e-3 * number("Rail/Length (mm)") * density), relative=0.01)
    expect.that("wheels, share: cells of a sector or a wheel", 1e-5 < summary["added_mass_wheels_share"] < 0.1)
    load, curvature_x, curvature_y = static_load(runs), 0.5 / 0.46, 0.5 / 0.3
    a, b = hertz.semi_axes(curvature_x, hertz.ratio_of_semi_axes(curvature_x, curvature_y), load, pair_modulus(runs, RUN))
    spring = 1.5 * load / hertz.approach(a, b, load, pair_modulus(runs, RUN))
    expect.near("inertia at 1 kHz over the contact's stiffness, %", 100 * summary["added_mass_error_estimate"],
                100 * (summary["added_mass_rail_kg"] + summary["added_mass_wheels_kg"]) / n_wheels * (2e3 * math.pi)**2 / spring, relative=5e-3)


@compared
def supports_carry_the_wheels(runs: Runs, expect: Expect) -> None:
    """At the start, and the springs' compression by the rail's sinking: the ballast's and the pad's in a row."""
    history = runs.of("twin", "history.csv")
    pads = sum(history[f"support_{i}_pad_N"][0] for i in SUPPORTS)
    ballast = sum(history[f"support_{i}_ballast_N"][0] for i in SUPPORTS)
    rail = 0.08 * 0.15 * 3.0 * 7900 * 9.81
    sleeper = runs.number("twin", "Track/Sleeper mass (kg)") * 9.81
    expect.near("ballast less pads: sleepers, kN", 1e-3 * (ballast - pads), 4e-3 * sleeper, relative=0.02)
    expect.that("these four of five carry most", 0.6 < pads / (2 * static_load(runs, "twin") + rail) < 1.)


@compared_each(*SUPPORTS)
def springs_of_a_support(runs: Runs, expect: Expect, i: int) -> None:
    history = runs.of("twin", "history.csv")
    pad, ballast, rail = (history[f"support_{i}_{name}"][0] for name in ("pad_N", "ballast_N", "rail_m"))
    sinks = pad / (1e6 * runs.number("twin", "Track/Pad stiffness (MN per m)")) + ballast / (1e6 * runs.number("twin", "Track/Ballast stiffness (MN per m)"))
    expect.near("sinks, um", -1e6 * rail, 1e6 * sinks, relative=0.06)
    area = 1e-6 * runs.number("twin", "Track/Pad length (mm)") * runs.number("twin", "Track/Pad width (mm)")
    most, least = history[f"support_{i}_seat_pressure_Pa"][0], history[f"support_{i}_least_seat_pressure_Pa"][0]
    expect.that("the mean pressure lies between largest and least", least < pad / area < most)


@compared
def second_wheel(runs: Runs, expect: Expect) -> None:
    for run in (RUN, "twin"):
        summary, history = runs.of(run), runs.of(run, "history.csv")
        last = (history["position_m"] > -10e-3) & (history["position_m"] <= 0)
        for name in ("normal_force_N", "longitudinal_force_N", "lateral_force_N"):
            expect.near(name, summary[f"wheel_2_{name}"], history[f"wheel_2_{name}"][last].mean(), relative=0.02, absolute=0.5)
        expect.near("traction", summary["wheel_2_traction_coefficient"], summary["wheel_2_longitudinal_force_N"] / summary["wheel_2_normal_force_N"], relative=1e-9)
        expect.near("traction", history["wheel_2_traction_coefficient"], history["wheel_2_longitudinal_force_N"] / history["wheel_2_normal_force_N"], relative=1e-9)
        expect.near("creepage", summary["wheel_2_creepage"], history["wheel_2_creepage"][-1], relative=1e-6)


@compared
def second_patch(runs: Runs, expect: Expect) -> None:
    summary, history, patch = runs.of("twin"), runs.of("twin", "history.csv"), runs.of("twin", "patch_averaged_wheel_2.csv")
    area, pressure = patch["area_mm2"], patch["pressure_MPa"]
    expect.near("resultant", np.sum(area * pressure), summary["wheel_2_normal_force_N"], relative=0.02)
    expect.near("largest pressure", 1e-6 * summary["wheel_2_max_pressure_Pa"], pressure.max(), relative=0.03)
    expect.near("largest pressure, history", history["wheel_2_max_pressure_Pa"][-1], summary["wheel_2_max_pressure_Pa"], relative=0.03)
    expect.near("area", 1e6 * summary["wheel_2_patch_area_m2"], np.sum(area), relative=0.15)
    expect.near("area, history", history["wheel_2_contact_area_m2"][-1], summary["wheel_2_patch_area_m2"], relative=0.1)
    expect.near("adhesion", summary["wheel_2_adhesion_share"], np.sum(area[patch["state"] == "adhesion"]) / np.sum(area), relative=0.1)
    expect.near("adhesion, history", history["wheel_2_adhesion_share"][-1], summary["wheel_2_adhesion_share"], relative=0.1)
    power = -np.sum(area * (patch["shear_x_MPa"] * patch["slip_x_m_per_s"] + patch["shear_y_MPa"] * patch["slip_y_m_per_s"]))
    expect.near("frictional power", summary["wheel_2_frictional_power_W"], power, relative=0.1)
    expect.near("slip", summary["wheel_2_max_slip_m_per_s"], np.hypot(patch["slip_x_m_per_s"], patch["slip_y_m_per_s"]).max(), relative=0.3)


@compared_each("", "wheel_2_")
def acceleration_of_an_axle_box(runs: Runs, expect: Expect, prefix: str) -> None:
    """What the contact pushes more than it must carry accelerates the wheel's mass; the soft suspension hardly moves."""
    history = runs.of(RUN, "history.csv")
    force, acceleration = history[f"{prefix}normal_force_N"], history[f"{prefix}axle_box_acceleration_m_per_s2"]
    share = np.polyfit(force - static_load(runs), acceleration, 1)[0]
    expect.near("1 / mass", 1 / share, runs.number(RUN, "Wheel/Mass (kg)"), relative=0.2)


@compared
def seats(runs: Runs, expect: Expect) -> None:
    """At each point of a pad, at the instant at which the pad's force was largest."""
    table, history = runs.of(RUN, "rail_seats.csv"), runs.of(RUN, "history.csv")
    length, width = (runs.number(RUN, f"Track/Pad {name} (mm)") for name in ("length", "width"))
    area = 1e-6 * length * width / 12
    for i in SUPPORTS:
        rows = table["support"] == i
        force = history[f"support_{i}_pad_N"]
        expect.near(f"support {i}: force", 1e6 * area * np.sum(table["pressure_MPa"][rows]), force.max(), relative=5e-3)
        row = int(np.argmin(np.abs(history["time_s"] - table["time_s"][rows][0])))
        expect.near(f"support {i}: instant", force[row], force.max(), relative=5e-3)
        expect.near(f"support {i}: largest pressure", 1e6 * table["pressure_MPa"][rows].max(), history[f"support_{i}_seat_pressure_Pa"][row], relative=0.01)
        expect.near(f"support {i}: least pressure", 1e6 * table["pressure_MPa"][rows].min(), history[f"support_{i}_least_seat_pressure_Pa"][row], relative=0.02)
        expect.near(f"support {i}: wheel", table["wheel_x_mm"][rows], 1e3 * SPEED * table["time_s"][rows] - 40., absolute=0.01)
        expect.near(f"support {i}: x", np.unique(np.round(table["x_mm"][rows], 6)), length * np.array([-1, 0, 1]) / 3, absolute=1e-3)
        expect.near(f"support {i}: y", np.unique(np.round(table["y_mm"][rows], 6)), width * np.array([-3, -1, 1, 3]) / 8, absolute=1e-3)


@compared
def force_of_the_dip(runs: Runs, expect: Expect) -> None:
    """dynamic.csv is the difference of both histories, whose rows belong to the same positions."""
    table, run, twin = runs.of("dynamic", "dynamic.csv"), runs.of(RUN, "history.csv"), runs.of("twin", "history.csv")
    time = table["time_s"]
    expect.near("position", table["position_m"], SPEED * time - 40e-3, absolute=1e-7)
    middle = lambda history: history["time_s"] - 0.5 * np.diff(history["time_s"], prepend=0.)  # of the interval that a row is the mean of
    for name in table.names():
        if name.endswith("_N"):
            difference = np.interp(time, middle(run), run[name]) - np.interp(time, middle(twin), twin[name])
            expect.near(name, table[name], difference, relative=0.02)


@compared
def figures_of_the_dip(runs: Runs, expect: Expect) -> None:
    middle = lambda history: history["time_s"] - 0.5 * np.diff(history["time_s"], prepend=0.)
    figures, table = runs.of("dynamic", "dynamic.json"), runs.of("dynamic", "dynamic.csv")
    time, position = table["time_s"], table["position_m"]
    run, twin = runs.of(RUN, "history.csv"), runs.of("twin", "history.csv")
    expect.near("speed", figures["speed_m_per_s"], SPEED, relative=1e-6)
    expect.near("from", figures["from_m"], position[0], relative=1e-6)
    expect.near("to", figures["to_m"], position[-1], relative=1e-6)
    expect.same("window", figures["window"], "rectangular")
    expect.same("interpolation", figures["interpolation"], "linear in time")
    expect.that("folders", figures["run"].endswith("/track") and figures["smooth_twin"].endswith("/twin"))
    record = (time[-1] - time[0]) * len(time) / (len(time) - 1)
    expect.near("record", figures["record_s"], record, relative=5e-3)
    # Width at which a rectangle's line is 6 dB below its top: sin(u) / u = 1 / 2 at u = 1.8955, over pi.
    expect.near("resolution", figures["resolution_Hz"], 1.21 / record, relative=5e-3)
    expect.that("warnings", len(figures["warnings"]) > 0 and all(words.endswith("take --window Hann") for words in figures["warnings"]))
    for name in [name for name in table.names() if name.endswith("_N")]:
        values, path = table[name], f"forces/{name}"
        for what, row in (("increase", int(np.argmax(values))), ("decrease", int(np.argmin(values)))):
            expect.near(f"{name}: {what}", figures[f"{path}/largest_{what}_N"], values[row], relative=1e-6)
            expect.near(f"{name}: {what}, x", figures[f"{path}/largest_{what}_position_m"], position[row], relative=1e-6)
        row = int(np.argmax(np.abs(values)))
        expect.near(f"{name}: peak", figures[f"{path}/peak_N"], values[row], relative=1e-6)
        expect.near(f"{name}: time", figures[f"{path}/peak_time_s"], time[row], relative=1e-6)
        expect.near(f"{name}: position", figures[f"{path}/peak_position_m"], position[row], relative=1e-6)
        expect.near(f"{name}: force then", figures[f"{path}/force_at_peak_N"], np.interp(time[row], middle(run), run[name]), relative=5e-3)
        expect.near(f"{name}: smooth mean", figures[f"{path}/smooth_mean_N"], np.interp(time, middle(twin), twin[name]).mean(), relative=5e-3)


@compared
def spectrum_of_the_dip(runs: Runs, expect: Expect) -> None:
    """Amplitudes of a Fourier transform that numpy makes of dynamic.csv."""
    spectrum, table, figures = runs.of("dynamic", "spectrum.csv"), runs.of("dynamic", "dynamic.csv"), runs.of("dynamic", "dynamic.json")
    frequency = spectrum["frequency_Hz"]
    expect.near("interval", figures["frequency_interval_Hz"], frequency[0], relative=1e-6)
    expect.near("wavelength", spectrum["wavelength_m"], SPEED / frequency, relative=1e-6)
    time = table["time_s"]
    step = (time[-1] - time[0]) / (len(time) - 1)
    expect.that("from the interval to Nyquist's frequency", 0.4 / step < frequency[-1] < 0.51 / step)
    chosen = frequency[:: max(1, len(frequency) // 40)]
    turns = np.exp(-2j * np.pi * np.outer(chosen, time - time[0]))
    for name in [name for name in table.names() if name.endswith("_N")]:
        values = table[name] - table[name].mean()
        amplitude = 2 / len(time) * np.abs(turns @ values)
        expect.near(name, spectrum[name][:: max(1, len(frequency) // 40)], amplitude, relative=0.03)


@compared
def vibrations_of_the_dip(runs: Runs, expect: Expect) -> None:
    """Each is a local maximum of its spectrum, between two of whose lines it lies."""
    spectrum, figures = runs.of("dynamic", "spectrum.csv"), runs.of("dynamic", "dynamic.json")
    frequency = spectrum["frequency_Hz"]
    for name in [name for name in figures.names() if name.endswith("/frequency_Hz")]:
        path, column = name[: -len("frequency_Hz")], name.split("/")[1]
        amplitude, line = spectrum[column], figures[name]
        if amplitude.max() < 1.:  # N: a wheel that the dip does not reach
            continue
        near = int(np.argmin(np.abs(frequency - line)))
        expect.near(f"{path}: amplitude", figures[path + "amplitude_N"], amplitude[max(0, near - 1):near + 2].max(), relative=0.009)
        expect.near(f"{path}: wavelength", figures[path + "wavelength_m"], SPEED / line, relative=1e-6)
        top = max(0, near - 1) + int(np.argmax(amplitude[max(0, near - 1):near + 2]))
        a, b, c = amplitude[top - 1], amplitude[top], amplitude[min(top + 1, len(amplitude) - 1)]
        expect.that(f"{path}: a maximum", b >= a and b >= c)
        # The parabola through the three lines around has its top there.
        expect.near(f"{path}: frequency", line, frequency[top] + 0.5 * (a - c) / (a - 2 * b + c) * frequency[0], absolute=0.35 * frequency[0] if line < 3e3 else frequency[0])


@compared
def deflection_of_the_rail(runs: Runs, expect: Expect) -> None:
    """The ballast under a support and its pad are compressed by the rail; over a support and half a span ahead the rail bends little."""
    history = runs.of("twin", "history.csv")
    at_supports = {i: history[f"support_{i}_rail_m"] for i in SUPPORTS}
    for i in SUPPORTS[:-1]:
        between = history[f"support_{i}_rail_at_next_mid_span_m"][0]
        low, high = sorted((at_supports[i][0], at_supports[i + 1][0]))
        expect.that(f"support {i}: rail at the next mid-span between both, or deeper under a wheel", 1.6 * low < between < 0.7 * high)
    for i in SUPPORTS:
        pad = history[f"support_{i}_pad_N"]
        expect.that(f"support {i}: it sinks as its pad's force grows", np.corrcoef(pad, at_supports[i])[0, 1] < -0.2 or np.ptp(pad) < 0.02 * pad.max())


@compared
def half_a_sleeper(runs: Runs, expect: Expect) -> None:
    """Under the largest force of a pad: what is given must arrive at the bottom."""
    stress, table, history, summary = runs.of("sleeper", "sleeper_stress.json"), runs.of(RUN, "rail_seats.csv"), runs.of(RUN, "history.csv"), runs.of(RUN)
    rows = table["support"] == stress["support"]
    area = 1e-6 * runs.number(RUN, "Track/Pad length (mm)") * runs.number(RUN, "Track/Pad width (mm)") / 12
    force = 1e6 * area * table["pressure_MPa"][rows]
    expect.near("support", stress["support"], summary["largest_pad_force_support"])
    expect.same("run", stress["run"].endswith("/track"), True)
    expect.same("completed", stress["run_completed"], summary["completed"])
    expect.same("at the end", stress["at_end_of_run"], summary["largest_pad_force_at_end"])
    expect.same("bottom", stress["bottom"], "ballast")
    expect.near("time", stress["time_s"], table["time_s"][rows][0], relative=1e-6)
    expect.near("wheel", 1e3 * stress["wheel_x_m"], table["wheel_x_mm"][rows][0], relative=1e-6)
    for name in ("seat_force_N", "nodal_force_N", "bottom_force_N"):
        expect.near(name, stress[name], force.sum(), relative=1e-4)
    expect.near("largest pressure", 1e-6 * stress["max_seat_pressure_Pa"], table["pressure_MPa"][rows].max(), relative=1e-6)
    expect.near("least pressure", 1e-6 * stress["min_seat_pressure_Pa"], table["pressure_MPa"][rows].min(), relative=1e-6)
    for name, arm in (("x", table["y_mm"]), ("y", table["x_mm"])):
        moment = np.sum(1e-3 * arm[rows] * force)
        for kind in ("seat", "nodal"):
            expect.near(f"{kind} moment about {name}", stress[f"{kind}_moment_{name}_Nm"], (-1. if name == "x" else 1.) * moment, relative=1e-3, absolute=1e-3)
    expect.near("Young's modulus", 1e-9 * stress["young_modulus_Pa"], runs.number(RUN, "Track/Sleeper Young's modulus (GPa)"), relative=1e-9)
    expect.near("Poisson's ratio", stress["poisson_ratio"], runs.number(RUN, "Track/Sleeper Poisson's ratio"), relative=1e-9)
    expect.near("cell", 1e3 * stress["cell_size_m"], 40)
    expect.near("Young's modulus of the cells", stress["ranks"], 1)
    expect.same("places", stress["places_counted_from"], "middle of the rail seat: x along the rail, y outwards, z upwards")
    mean = force.sum() / 1e6 / (0.5 * runs.number(RUN, "Track/Sleeper length (m)") * 1e-3 * runs.number(RUN, "Track/Sleeper width (mm)"))
    expect.that("pressures on the ballast around the mean of the bottom", 0. <= 1e-6 * stress["min_bottom_pressure_Pa"] < mean < 1e-6 * stress["max_bottom_pressure_Pa"] < 3 * mean)
    expect.that("tension below von Mises stress, both some times the mean pressure", 0.1 * mean < 1e-6 * stress["max_tension_Pa"] <= 1.2e-6 * stress["max_von_mises_Pa"] < 60. * mean)
    x, y, z = stress["max_tension_place_m"]
    expect.that("tension at the bottom or the top of the sleeper, within it", abs(x) < 0.16 and -0.8 < y < 0.55 and -0.25 < z < 0.05)
    x, y, z = stress["max_von_mises_place_m"]
    expect.that("largest von Mises stress under the seat", -0.16 < x < 0. and -0.2 < y < 0. and -0.1 < z <= 0.)
    # NS 90: 258 mm wide at the bottom, 2.52 m long; its volume is what the density takes of its mass.
    expect.that("mass", 0.04 < stress["half_sleeper_mass_kg"] / runs.number(RUN, "Track/Sleeper density (kg per m3)") < 0.07)
    expect.near("mass in the scene", stress["scene_sleeper_mass_kg"], runs.number(RUN, "Track/Sleeper mass (kg)"), relative=1e-9)
    expect.same("warnings", stress["warnings"], [
        f"half the sleeper of the run weighs {stress['scene_sleeper_mass_kg']:.4g} kg ('Track/Sleeper mass (kg)'), that of an NS 90 at "
        f"'Track/Sleeper density (kg per m3)' {stress['half_sleeper_mass_kg']:.4g} kg: the stress is that in an NS 90"])
    expect.near("settlement, um", 1e6 * abs(stress["mean_seat_settlement_m"]), force.sum() / runs.number(RUN, "Track/Ballast stiffness (MN per m)"), relative=0.2)
