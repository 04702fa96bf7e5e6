# SPDX-License-Identifier: LGPL-2.1-or-later
"""`tread modes` of a wheel on a bar on four sleepers, against masses on springs and beams."""

from __future__ import annotations

import math

import numpy as np

from .engine import Expect, Runs, compared, compared_each

RUN = "modes"
LENGTH, SPACING = 2.4, 0.6  # m; supports lie at the middles of four equal parts, so that cosines on them are orthogonal


def rows_of(runs: Runs, body: str) -> tuple[np.ndarray, dict]:
    table = runs.of(RUN, "modes.csv")
    return np.flatnonzero(table["body"] == body), table


@compared
def numbers_and_shares(runs: Runs, expect: Expect) -> None:
    table = runs.of(RUN, "modes.csv")
    number = table["number"]
    expect.near("numbers", number, np.arange(1, len(number) + 1))
    parts = [table[f"{name}_share"] for name in ("rail", "sleeper", "rim", "web", "hub", "sprung")]
    expect.near("shares of the parts", sum(parts), 1., absolute=1e-6)
    directions = [table[f"{name}_share"] for name in ("vertical", "lateral", "longitudinal")]
    expect.near("shares of the directions", sum(directions), 1., absolute=1e-6)


@compared
def wheel_that_is_free(runs: Runs, expect: Expect) -> None:
    """Up, along and turning; upwards with the amplitude of its mass."""
    rows, table = rows_of(runs, "wheel")
    mass = runs.number(RUN, "Wheel/Mass (kg)")
    expect.near("rigid motions", np.sum(table["description"][rows] == "rigid motion"), 3)
    up = rows[np.argmax(np.abs(table["contact_amplitude_per_sqrt_kg"][rows]))]
    for name in ("contact", "axle"):
        expect.near(f"amplitude of the {name}", abs(table[f"{name}_amplitude_per_sqrt_kg"][up]), mass**-0.5, relative=1e-4)
    expect.near("upwards", table["vertical_share"][up], 1., absolute=1e-6)
    expect.near("number of waves", table["waves"][up], -1)
    # The sector of the meshed rim, 60 mm high and 120 mm wide, reaches 60 mm beyond the way of 40 mm.
    of_sector = 0.06 * 0.12 * 0.16 * 430 / 460 * runs.number(RUN, "Wheel/Density (kg per m3)")
    expect.near("mass of the rim", table["rim_share"][up] * mass, of_sector, relative=0.25)


@compared
def wheel_on_its_suspension(runs: Runs, expect: Expect) -> None:
    rows, table = rows_of(runs, "wheel_on_suspension")
    wheel, sprung = runs.number(RUN, "Wheel/Mass (kg)"), runs.number(RUN, "Vehicle/Sprung mass (kg)")
    stiffness, damping = 1e3 * runs.number(RUN, "Vehicle/Suspension stiffness (kN per m)"), runs.number(RUN, "Vehicle/Suspension damping (N s per m)")
    omega = math.sqrt(stiffness * (1 / wheel + 1 / sprung))
    rigid, swings = rows[:2]
    expect.near("both together", abs(table["contact_amplitude_per_sqrt_kg"][rigid]), (wheel + sprung)**-0.5, relative=1e-4)
    expect.near("frequency", table["frequency_Hz"][swings], omega / (2 * math.pi), relative=1e-3)
    expect.near("damping", table["damping_share"][swings], damping * omega / (2 * stiffness), relative=2e-3)
    expect.near("sprung mass", table["sprung_share"][swings], wheel / (wheel + sprung), relative=1e-3)
    expect.near("hub and rim", table["hub_share"][swings] + table["rim_share"][swings], sprung / (wheel + sprung), relative=1e-3)
    for name in ("contact", "axle"):
        expect.near(f"amplitude of the {name}", abs(table[f"{name}_amplitude_per_sqrt_kg"][swings]), math.sqrt(sprung / (wheel * (wheel + sprung))), relative=1e-3)
    expect.same("in words", str(table["description"][swings]), "wheel and sprung mass, vertical")


def rail_and_sleepers(runs: Runs, waves: int) -> list[dict[str, float]]:
    """Both modes with so many half waves of a beam and sleepers below it."""
    rail = 0.08 * 0.15 * runs.number(RUN, "Rail/Density (kg per m3)") * LENGTH
    half = 1. if waves == 0 else 0.5  # mean square of a cosine
    sleepers = 4 * runs.number(RUN, "Track/Sleeper mass (kg)")
    pad, ballast, pad_damper, ballast_damper = (4 * factor * runs.number(RUN, f"Track/{name}") for name, factor in (
        ("Pad stiffness (MN per m)", 1e6), ("Ballast stiffness (MN per m)", 1e6), ("Pad damping (kN s per m)", 1e3), ("Ballast damping (kN s per m)", 1e3)))
    bending = 1e9 * runs.number(RUN, "Rail/Young's modulus (GPa)") * 0.08 * 0.15**3 / 12 * (waves * math.pi / LENGTH)**4 * LENGTH
    mass = half * np.diag([rail, sleepers])
    stiffness = half * np.array([[pad + bending, -pad], [-pad, pad + ballast]])
    damping = half * np.array([[pad_damper, -pad_damper], [-pad_damper, pad_damper + ballast_damper]])
    root = np.diag(np.diag(mass)**-0.5)
    squares, vectors = np.linalg.eigh(root @ stiffness @ root)
    modes = []
    for square, vector in zip(squares, (root @ vectors).T):
        omega = math.sqrt(square)
        modes.append({"frequency_Hz": omega / (2 * math.pi), "rail_share": mass[0, 0] * vector[0]**2, "sleeper_share": mass[1, 1] * vector[1]**2,
                      "pad_amplitude_per_sqrt_kg": abs(vector[0]), "pad_elongation_per_sqrt_kg": abs(vector[0] - vector[1]),
                      "damping_share": vector @ damping @ vector / (2 * omega)})
    return modes


@compared_each((0, 0.02), (2, 0.04))
def sleepers_under_the_rail(runs: Runs, expect: Expect, which: tuple[int, float]) -> None:
    waves, allowed = which
    rows, table = rows_of(runs, "track")
    row = [row for row in rows if table["waves"][row] == waves and table["sleeper_share"][row] > 0.6][0]
    expected = rail_and_sleepers(runs, waves)[0]
    largest = abs(math.cos(waves * math.pi * 0.125)) if waves else 1.  # of the cosine at a support
    for name in ("frequency_Hz", "rail_share", "sleeper_share", "damping_share"):
        expect.near(name, table[name][row], expected[name], relative=2 * allowed)
    expect.near("rail over the pads", table["pad_amplitude_per_sqrt_kg"][row], largest * expected["pad_amplitude_per_sqrt_kg"], relative=0.15)
    if waves == 2:
        expect.that("elongation of the pads, two half waves", 0.1 < table["pad_elongation_per_sqrt_kg"][row] / table["pad_amplitude_per_sqrt_kg"][row] < 0.3)
    if waves == 0:
        expect.near("pads, per sqrt t", table["pad_elongation_per_sqrt_kg"][row] * 1e3**0.5, expected["pad_elongation_per_sqrt_kg"] * 1e3**0.5, relative=0.4)
        expect.near("at the contact", abs(table["contact_amplitude_per_sqrt_kg"][row]), expected["pad_amplitude_per_sqrt_kg"], relative=0.03)
    expect.near("upwards", table["vertical_share"][row], 1., absolute=0.02)
    expect.same("in words", str(table["description"][row]), "sleepers, vertical")


@compared
def waves_of_the_rail(runs: Runs, expect: Expect) -> None:
    rows, table = rows_of(runs, "track")
    waves = table["waves"][rows]
    expect.near("half waves, mm", table["half_wave_mm"][rows], np.where(waves > 0, 1e3 * LENGTH / np.maximum(waves, 1), 0.), relative=1e-6)
    # Along: a bar whose ends are held.
    along = rows[np.argmax(table["longitudinal_share"][rows])]
    speed = math.sqrt(1e9 * runs.number(RUN, "Rail/Young's modulus (GPa)") / runs.number(RUN, "Rail/Density (kg per m3)"))
    expect.near("along: frequency", table["frequency_Hz"][along], table["waves"][along] * speed / (2 * LENGTH), relative=5e-3)
    expect.near("along: share", table["longitudinal_share"][along], 1., absolute=5e-3)
    for row in rows:
        words = str(table["description"][row])
        if words.startswith("rail, lateral"):
            expect.that(words, table["lateral_share"][row] > 0.7)
        if words.startswith("rail, vertical"):
            expect.that(words, table["vertical_share"][row] > 0.8)
    # Bending across of a bar of 80 mm, guided at its ends, on nothing: Timoshenko's shear takes a few per cent.
    across = [row for row in rows if table["lateral_share"][row] > 0.85 and table["waves"][row] == 2][0]
    bends = (2 * math.pi / LENGTH)**2 * math.sqrt(1e9 * runs.number(RUN, "Rail/Young's modulus (GPa)") * 0.08**2 / 12 / runs.number(RUN, "Rail/Density (kg per m3)")) / (2 * math.pi)
    expect.that("across: frequency", table["frequency_Hz"][across] > 0.9 * bends)
    expect.that("words of all rows", all(str(words).split(",")[0] in ("rail", "sleepers", "rail and sleepers") for words in table["description"][rows]))


@compared
def receptances(runs: Runs, expect: Expect) -> None:
    """Sums over the modes; what the higher ones add is the constant that is left over at the second line."""
    lines, table = runs.of(RUN, "receptance.csv"), runs.of(RUN, "modes.csv")
    frequency = lines["frequency_Hz"]
    expect.near("lines", frequency, 1500. / 400 * np.arange(1, 401), relative=1e-9)
    for what, body, rest in (("wheel", "wheel_on_suspension", 0.), ("rail", "track", None)):
        rows = table["body"] == body
        omega, own = 2 * np.pi * frequency[:, None], 2 * np.pi * table["frequency_Hz"][rows]
        sums = np.sum(table["contact_amplitude_per_sqrt_kg"][rows]**2 / (own**2 - omega**2 + 2j * table["damping_share"][rows] * own * omega), axis=1)
        value = lines[f"{what}_magnitude_m_per_N"] * np.exp(1j * np.radians(lines[f"{what}_phase_degrees"]))
        low = slice(1, 40) if what == "wheel" else slice(1, 60)
        local = 0. if what == "wheel" else np.mean((value - sums)[low].real)
        expect.near(f"{what}: magnitude, nm/N", 1e9 * np.abs(value)[low], 1e9 * np.abs(sums + local)[low], relative=0.03)
        expect.near(f"{what}: phase, degrees", np.degrees(np.angle(value))[low], np.degrees(np.angle(sums + local))[low], absolute=5.)
        expect.that(f"{what}: what the higher modes add is little", 0. <= local < 5e-9)


@compared
def contact_force(runs: Runs, expect: Expect) -> None:
    """Between wheel and rail without the dents of the discs, and the contact's spring (Johnson 1985, section 3.4: mean of an evenly loaded disc)."""
    from tread import hertz

    from .straight import pair_modulus
    lines = runs.of(RUN, "receptance.csv")
    load = 9.81 * (runs.number(RUN, "Wheel/Mass (kg)") + runs.number(RUN, "Vehicle/Sprung mass (kg)"))
    modulus = pair_modulus(runs, RUN)
    curvature_x, curvature_y = 0.5 / 0.46, 0.5 / 0.3
    a, b = hertz.semi_axes(curvature_x, hertz.ratio_of_semi_axes(curvature_x, curvature_y), load, modulus)
    spring = 1.5 * load / hertz.approach(a, b, load, modulus)
    shown = runs.of(RUN, "screen")["receptances at x = # mm on the rail and under the wheel; Hertz's spring at # kN: # MN/m 3"]
    expect.near("Hertz's spring, MN/m", shown, 1e-6 * spring, relative=4e-3)
    dents = sum(16 * (1 - runs.number(RUN, f"{body}/Poisson's ratio")**2) / (3 * math.pi**2 * 15e-3 * 1e9 * runs.number(RUN, f"{body}/Young's modulus (GPa)")) for body in ("Wheel", "Rail"))
    moves = sum(lines[f"{body}_magnitude_m_per_N"] * np.exp(1j * np.radians(lines[f"{body}_phase_degrees"])) for body in ("wheel", "rail"))
    expect.near("force, kN/mm", 1e-6 * lines["contact_force_N_per_m"], 1e-6 / np.abs(1 / spring + moves - dents), relative=5e-3)


@compared
def full_wheel(runs: Runs, expect: Expect) -> None:
    """Kinetic energy of a rigid motion upwards is shared as the masses of rim and web are."""
    table = runs.of("modes_full", "modes.csv")
    parameter = lambda name: 1e-3 * runs.number("modes_full", f"Wheel/{name}")
    rows = np.flatnonzero(table["body"] == "wheel")
    up = rows[np.argmax(np.abs(table["axle_amplitude_per_sqrt_kg"][rows]) * (table["frequency_Hz"][rows] < 1.))]
    mass, density = runs.number("modes_full", "Wheel/Mass (kg)"), runs.number("modes_full", "Wheel/Density (kg per m3)")
    rim = math.pi * (parameter("Radius (mm)")**2 - parameter("Rim inner radius (mm)")**2) * parameter("Rim width (mm)")
    web = math.pi * ((parameter("Rim inner radius (mm)")**2 - parameter("Hub outer radius (mm)")**2) * parameter("Web thickness (mm)")
                     + (parameter("Hub outer radius (mm)")**2 - parameter("Bore radius (mm)")**2) * parameter("Hub length (mm)"))
    expect.near("rim", table["rim_share"][up], density * rim / mass, relative=0.25)
    expect.near("web", table["web_share"][up], density * web / mass, relative=0.3)
    sum_of_shares = sum(table[f"{name}_share"] for name in ("rail", "sleeper", "rim", "web", "hub", "sprung"))
    expect.near("shares", sum_of_shares, 1., absolute=1e-6)
