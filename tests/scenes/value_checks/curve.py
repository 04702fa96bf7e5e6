# SPDX-License-Identifier: LGPL-2.1-or-later
"""Both wheels of a wheelset that a force pushes aside, on a flexible axle; the same by half-space theory; rigid contact."""

from __future__ import annotations

import math
import os

import numpy as np

from tread import hertz
from tread.runs import ROOT

from .engine import Expect, Of, Runs, compared, compared_each
from .straight import pair_modulus

RUN = "curve"
SPEED = 60 / 3.6
RADIUS, CONE, CROWN, GAUGE_HALF = 0.2, 0.2, 0.3, 0.75
STIFFNESS, DAMPING, PUSH = 5e6, 20e3, 4e3


@compared
def guidance(runs: Runs, expect: Expect) -> None:
    """A spring and a damper from the position at the start, and a constant force."""
    history = runs.of(RUN, "history.csv")
    time, shift = history["time_s"], history["lateral_shift_m"]
    force = history["guidance_force_N"]
    speed = np.gradient(shift, time)
    middle = slice(2, -2)
    expect.near("spring and damper", force[middle], (PUSH - STIFFNESS * (shift - 3e-3) - DAMPING * speed)[middle], relative=0.05)
    expect.near("start", shift[0], 3e-3, relative=0.01)


@compared
def position_at_the_end(runs: Runs, expect: Expect) -> None:
    summary, history = runs.of(RUN), runs.of(RUN, "history.csv")
    for key in ("lateral_shift_m", "yaw_rad", "roll_rad"):
        value = np.interp(0., history["position_m"], history[key])
        expect.near(key, 1e3 * summary[key], 1e3 * value, relative=5e-4)
    expect.near("yaw at the start", history["yaw_rad"][0], 3e-3, relative=0.05)


@compared
def roll_of_the_cones(runs: Runs, expect: Expect) -> None:
    """Cones rise and fall by shift times slope over the levers of the contacts on the crowns, 40 mm nearer to the middle."""
    for run in (RUN, "half_curve"):
        summary = runs.of(run)
        expect.near(f"{run}: roll, mrad", 1e3 * summary["roll_rad"], -1e3 * summary["lateral_shift_m"] * CONE / (GAUGE_HALF - 0.04), relative=0.02)
        expect.near(f"{run}: shift, mm", 1e3 * summary["lateral_shift_m"], 3., relative=0.05)
    expect.near("yaw, mrad", 1e3 * runs.of("half_curve")["yaw_rad"], 3., relative=1e-6)


def patches_of(summary: Of, kind: str = "patches") -> list[dict[str, float]]:
    names = [name.split("/")[2] for name in summary.names() if name.startswith(f"{kind}/1/")]
    count = sum(name.startswith(f"{kind}/") and name.endswith("/wheel") for name in summary.names())
    return [{name: f"{kind}/{number + 1}/{name}" for name in names} for number in range(count)]


@compared_each((RUN, "patches"), (RUN, "half_space_patches"), ("half_curve", "patches"))
def places_of_the_patches(runs: Runs, expect: Expect, which: tuple[str, str]) -> None:
    """Cones on crowns that lean as they do."""
    run, kind = which
    summary = runs.of(run)
    for keys in patches_of(summary, kind):
        value = lambda name: summary[keys[name]]
        side = 1 if value("wheel") == "own" else -1
        shift, yaw, roll = side * summary["lateral_shift_m"], side * summary["yaw_rad"], side * summary["roll_rad"]
        expect.same("side", value("wheel"), "own" if value("y_m") > 0 else "other")
        angle = math.atan(CONE) - roll
        expect.near("angle, mrad", 1e3 * value("angle_rad"), 1e3 * angle, absolute=1.)
        expect.near("y, mm", 1e3 * side * value("y_m") - 1e3 * value("y_rail_m"), 750.025, absolute=0.05)
        expect.near("y from the rail's middle, mm", 1e3 * value("y_rail_m"), 300. * roll, absolute=0.03 if run == "half_curve" else 0.12)
        expect.near("radius, mm", 1e3 * value("rolling_radius_m"), 200. + 1e3 * CONE * (shift - value("y_rail_m") - 0.2 * roll), absolute=0.05)
        expect.near("x, mm", 1e3 * value("x_m"), -1e3 * yaw * (0.75 - RADIUS * CONE), absolute=0.02)
        expect.near("the rail's crown", value("rail_profile_radius_m"), CROWN, relative=0.005)
        expect.that("a cone's profile is straight", abs(value("wheel_profile_radius_m")) > 100.)
        turning = summary["angular_velocity_rad_per_s"]
        expect.near("rolling speed", value("rolling_speed_m_per_s"), 0.5 * (SPEED + turning * value("rolling_radius_m")), relative=5e-3)
        if run == "half_curve":  # that does not turn about the vertical, nor twist
            expect.near("creepage, 1e-3", 1e3 * value("creepage"), 1e3 * (turning * value("rolling_radius_m") - SPEED) / value("rolling_speed_m_per_s"), absolute=0.03)
            expect.near("lateral creepage, 1e-3", 1e3 * value("lateral_creepage"), -1e3 * yaw / math.cos(angle), relative=0.03)
        expect.near("spin", value("spin_per_m"), -math.sin(angle) * turning / value("rolling_speed_m_per_s"), relative=0.008)


@compared_each((RUN, "half_space_patches"), ("half_curve", "patches"))
def patches_beside_hertz(runs: Runs, expect: Expect, which: tuple[str, str]) -> None:
    run, kind = which
    summary = runs.of(run)
    for keys in patches_of(summary, kind):
        value = lambda name: summary[keys[name]]
        modulus = pair_modulus(runs, run)
        curvature_x, curvature_y = 0.5 * math.cos(value("angle_rad")) / value("rolling_radius_m"), 0.5 / CROWN
        a, b = hertz.semi_axes(curvature_x, hertz.ratio_of_semi_axes(curvature_x, curvature_y), value("normal_force_N"), modulus)
        expect.near("largest pressure", 1e-6 * value("max_pressure_Pa"), 1.5e-6 * value("normal_force_N") / (math.pi * a * b), relative=0.02)
        expect.near("area", 1e6 * value("area_m2"), 1e6 * math.pi * a * b, relative=0.03)
        expect.near("length", 1e3 * value("length_m"), 2e3 * a, relative=0.06)
        expect.near("width", 1e3 * value("width_m"), 2e3 * b, relative=0.06)
        expect.near("overlap, um", 1e6 * value("overlap_m"), 1e6 * hertz.approach(a, b, value("normal_force_N"), modulus), relative=0.02)
        expect.near("turn of the normal", value("normal_turns_rad"), value("width_m") / CROWN, relative=0.01)
        elements = value("area_m2") / (value("element_x_m") * value("element_y_m"))
        expect.near("elements", elements, round(elements), absolute=1e-6)
        for name, axis in (("length", "x"), ("width", "y")):
            extent = value(f"{name}_m") / value(f"element_{axis}_m")
            expect.near(f"elements of the {name}", extent, round(extent), absolute=1e-6)
        bound = runs.number(run, "Contact/Friction coefficient") * value("max_pressure_Pa")
        expect.that("shear stress below the bound", 0.5 * bound < value("max_shear_Pa") <= bound * (1 + 1e-9))


@compared
def elements_of_the_patches(runs: Runs, expect: Expect) -> None:
    """Resultants of the table of elements of both wheels."""
    summary, table = runs.of("half_curve"), runs.of("half_curve", "patch.csv")
    for keys in patches_of(summary):
        value = lambda name: summary[keys[name]]
        own = value("wheel") == "own"
        rows = table["y_mm"] > -700 if own else table["y_mm"] < -700
        area, p, sx, sy = (table[name][rows] for name in ("area_mm2", "pressure_MPa", "shear_x_MPa", "shear_y_MPa"))
        side = 1. if own else -1.
        expect.near("normal force", np.sum(area * p), value("normal_force_N"), relative=2e-3)
        expect.near("longitudinal force", np.sum(area * sx), value("longitudinal_force_N"), relative=5e-3)
        expect.near("lateral force", np.sum(area * sy), value("lateral_force_N"), relative=0.01)
        expect.near("area", np.sum(area), 1e6 * value("area_m2"), relative=0.04)
        expect.near("adhesion", np.sum(area[table["state"][rows] == "adhesion"]) / np.sum(area), value("adhesion_share"), relative=0.02)
        expect.near("slip", np.hypot(table["slip_x_m_per_s"], table["slip_y_m_per_s"])[rows].max(), value("max_slip_m_per_s"), relative=5e-3)
        power = -np.sum(area * (sx * table["slip_x_m_per_s"][rows] + sy * table["slip_y_m_per_s"][rows]))
        expect.near("power", power, value("frictional_power_W"), relative=0.03)
        expect.near("pressure", p.max(), 1e-6 * value("max_pressure_Pa"), relative=2e-3)
        expect.near("shear", np.hypot(sx, sy).max(), 1e-6 * value("max_shear_Pa"), relative=0.03)
        x, y = table["x_mm"][rows] - 1e3 * value("x_m"), table["y_mm"][rows]
        s = side * (y - 1e3 * value("y_m") + 750.025) / math.cos(value("angle_rad"))
        expect.near("spin moment", 1e-3 * np.sum(area * (x * sy - s * sx)), value("spin_moment_Nm"), relative=0.02)
        expect.near("z", np.average(table["z_mm"][rows], weights=p), 1e3 * value("z_m"), absolute=0.25)


@compared_each((RUN, "patches"), ("half_curve", "patches"))
def forces_of_the_patches(runs: Runs, expect: Expect, which: tuple[str, str]) -> None:
    run, kind = which
    summary = runs.of(run)
    sums = np.zeros(3)
    if run == RUN:  # where means over a cell are those of the patches
        history = runs.of(RUN, "history.csv")
        end = np.abs(history["position_m"]) <= 1.3e-3
        in_end = {name: history[name][end].mean() for name in ("normal_force_N", "longitudinal_force_N", "lateral_force_N")}
    for keys in patches_of(summary, kind):
        value = lambda name: summary[keys[name]]
        side = 1 if value("wheel") == "own" else -1
        c, s = math.cos(value("angle_rad")), math.sin(value("angle_rad"))
        sums += [value("longitudinal_force_N"), side * (c * value("lateral_force_N") - s * value("normal_force_N")),
                 s * value("lateral_force_N") + c * value("normal_force_N")]
    expect.that("two patches", len(patches_of(summary, kind)) == 2)
    for name, computed in zip(("longitudinal", "lateral", "normal"), sums):
        expect.near(f"sum of {name} forces, kN", 1e-3 * computed, 1e-3 * (summary[f"{name}_force_N"] if run != RUN else in_end[f"{name}_force_N"]), absolute=1.5 if run == RUN else 2e-2)
    expect.near("traction", summary["traction_coefficient"], summary["longitudinal_force_N"] / summary["normal_force_N"], relative=1e-9)
    expect.near("both loads, kN", 1e-3 * summary["normal_force_N"], 300., relative=0.02)


@compared_each((RUN, "patches", 0.02), ("half_curve", "patches", 1e-6))
def sums_of_the_patches(runs: Runs, expect: Expect, which: tuple[str, str, float]) -> None:
    run, kind, allowed = which
    summary = runs.of(run)
    of = lambda name: [summary[keys[name]] for keys in patches_of(summary, kind)]
    expect.near("largest pressure", summary["max_pressure_Pa"], max(of("max_pressure_Pa")), relative=1e-9)
    expect.near("area", summary["patch_area_m2"], sum(of("area_m2")), relative=1e-9)
    expect.near("largest shear", summary["max_shear_Pa"], max(of("max_shear_Pa")), relative=1e-9)
    expect.near("largest slip", summary["max_slip_m_per_s"], max(of("max_slip_m_per_s")), relative=1e-9)
    expect.near("power", summary["frictional_power_W"], sum(of("frictional_power_W")), relative=1e-9)


@compared_each("own", "other")
def patch_of_a_wheel(runs: Runs, expect: Expect, wheel: str) -> None:
    """Each wheel's patch beside the half-space's, and the half-space's beside Hertz's."""
    summary = runs.of(RUN)
    finite, half = ([keys for keys in patches_of(summary, kind) if summary[keys["wheel"]] == wheel][0] for kind in ("patches", "half_space_patches"))
    for name, allowed in (("normal_force_N", 0.03), ("max_pressure_Pa", 0.06), ("area_m2", 0.3), ("length_m", 0.35), ("width_m", 0.35)):
        expect.near(name, summary[finite[name]], summary[half[name]], relative=allowed)


@compared
def history_of_both(runs: Runs, expect: Expect) -> None:
    summary, history = runs.of(RUN), runs.of(RUN, "history.csv")
    last = (history["position_m"] > -10e-3) & (history["position_m"] <= 0)
    for name in ("normal_force_N", "longitudinal_force_N", "lateral_force_N"):
        expect.near(name, 1e-3 * summary[name], 1e-3 * history[name][last].mean(), absolute=0.3 if name != "longitudinal_force_N" else 0.05)
    end = np.abs(history["position_m"]) <= 1.3e-3
    other = [keys for keys in patches_of(summary) if summary[keys["wheel"]] == "other"][0]
    value = lambda name: summary[other[name]]
    c, s = math.cos(value("angle_rad")), math.sin(value("angle_rad"))
    for name, computed in (("longitudinal", value("longitudinal_force_N")), ("lateral", -(c * value("lateral_force_N") - s * value("normal_force_N"))),
                           ("normal", s * value("lateral_force_N") + c * value("normal_force_N"))):
        expect.near(f"other wheel: {name} force, kN", 1e-3 * history[f"other_{name}_force_N"][end].mean(), 1e-3 * computed, absolute=0.6)


@compared
def rigid_contact(runs: Runs, expect: Expect) -> None:
    """Cones of 0.2 on crowns of 300 mm: radii, angles, heights and places of contact for all shifts."""
    table = runs.of("points", "contact_points.csv")
    shift, roll = table["lateral_shift_mm"], table["roll_rad"]
    expect.near("shifts", shift, 0.5 * np.arange(-(len(shift) // 2), len(shift) // 2 + 1))
    expect.near("roll", 1e3 * roll, -shift * CONE / (GAUGE_HALF - 0.04), absolute=0.01)
    expect.near("difference of the radii", table["radius_difference_mm"], table["own_rolling_radius_mm"] - table["other_rolling_radius_mm"], absolute=1e-6)
    aside = shift != 0
    expect.near("difference of the radii of a level axle", table["radius_difference_without_roll_mm"], 2 * CONE * shift, absolute=1e-3)
    expect.near("conicity of a level axle", table["equivalent_conicity_without_roll"][aside], CONE, relative=1e-3)
    expect.near("harmonic conicity", table["harmonic_conicity"][aside], (table["radius_difference_mm"] / (2 * np.where(aside, shift, 1.)))[aside], relative=2e-3)
    expect.near("conicity", table["equivalent_conicity"][aside], (table["radius_difference_mm"] / (2 * np.where(aside, shift, 1.)))[aside], relative=2e-3)
    for wheel, side in (("own", 1), ("other", -1)):
        of = lambda name: table[f"{wheel}_{name}"]
        expect.near(f"{wheel}: angle, mrad", 1e3 * of("angle_rad"), 1e3 * (math.atan(CONE) - side * roll), absolute=0.05)
        expect.near(f"{wheel}: radius", of("rolling_radius_mm"), 200. - CONE * of("y_wheel_mm"), absolute=0.01)
        expect.near(f"{wheel}: y from the rail's middle", of("y_rail_mm"), 300. * side * roll, absolute=0.01)
        expect.near(f"{wheel}: y from the middle of the track", of("y_mm") - of("y_rail_mm"), 750.025, absolute=0.01)
        expect.near(f"{wheel}: y on the wheel", of("y_wheel_mm"), of("y_rail_mm") - side * shift + 200. * side * roll, absolute=0.06)
        expect.near(f"{wheel}: x", of("x_mm"), -side * 3e-3 * (750. - 200. * CONE), absolute=0.03)


@compared
def profiles_in_the_track(runs: Runs, expect: Expect) -> None:
    """The wheel in the middle of the track touches the rail where the table says."""
    points, rail, wheel = (runs.of("points", name) for name in ("contact_points.csv", "rail_profile.csv", "wheel_profile.csv"))
    middle = int(np.argmin(np.abs(points["lateral_shift_mm"])))
    for table in (rail, wheel):
        expect.near("from the rail's middle", table["y_mm"] - table["y_rail_mm"], 750.025, absolute=0.01)
    y = np.linspace(735., 765., 121)
    on_rail, on_wheel = (np.interp(y, table["y_mm"], table["z_mm"]) for table in (rail, wheel))
    expect.near("gap", (on_wheel - on_rail).min(), 0., absolute=0.01)
    expect.near("contact", y[np.argmin(on_wheel - on_rail)], points["own_y_mm"][middle], absolute=1.5)
    expect.near("height", points["height_mm"], np.interp(750.025, wheel["y_mm"], wheel["z_mm"]), absolute=0.015)
    own = [keys for keys in patches_of(runs.of("half_curve")) if runs.of("half_curve")[keys["wheel"]] == "own"][0]
    expect.near("the rail under the own wheel", np.interp(1e3 * runs.of("half_curve")[own["y_m"]], rail["y_mm"], rail["z_mm"]), 1e3 * runs.of("half_curve")[own["z_m"]], absolute=0.02)
    expect.near("slope of the rail", (np.interp(755., rail["y_mm"], rail["z_mm"]) - np.interp(745., rail["y_mm"], rail["z_mm"])) / 10., CONE, relative=0.02)
    expect.near("slope of the wheel", (np.interp(755., wheel["y_mm"], wheel["z_mm"]) - np.interp(745., wheel["y_mm"], wheel["z_mm"])) / 10., CONE, relative=0.01)


@compared
def height_of_the_wheelset(runs: Runs, expect: Expect) -> None:
    """That of rigid contact, less what wheels and rails overlap along their normals."""
    summary, points = runs.of("half_curve"), runs.of("points", "contact_points.csv")
    rigid = np.interp(3., points["lateral_shift_mm"], points["height_mm"])
    overlap = np.mean([1e3 * summary[keys["overlap_m"]] / math.cos(summary[keys["angle_rad"]]) for keys in patches_of(summary)])
    expect.near("height, mm", 1e3 * summary["wheelset_height_m"], rigid - overlap, absolute=0.01)


@compared
def sinking_under_the_other_patch(runs: Runs, expect: Expect) -> None:
    """As under a point load in the middle of the other patch, on both bodies (Johnson 1985, eq. 3.22)."""
    summary = runs.of("half_two")
    patches = patches_of(summary)
    value = lambda number, name: summary[patches[number][name]]
    distance = math.dist(*[[value(number, f"{axis}_m") for axis in "xyz"] for number in (0, 1)])
    for number in (0, 1):
        sinks = value(1 - number, "normal_force_N") / (math.pi * pair_modulus(runs, "half_two") * distance)
        expect.near("sinks, um", 1e6 * value(number, "sink_by_others_m"), 1e6 * sinks, relative=0.25)


@compared
def rotation_of_two_patches(runs: Runs, expect: Expect) -> None:
    """What is given as angular velocity, over that of a wheel that rolls on its radius."""
    for run in ("curve", "half_curve", "half_two"):
        summary, speed = runs.of(run), runs.number(run, "Motion/Speed (km per h)") / 3.6
        creepage = summary["angular_velocity_rad_per_s"] * 1e-3 * runs.number(run, "Wheel/Radius (mm)") / speed - 1
        expect.near(f"{run}: creepage, per mille", 1e3 * summary["creepage_over_nominal_radius"], 1e3 * creepage, relative=1e-6, absolute=1e-9)


@compared_each("wheel", "rail")
def measured_profile(runs: Runs, expect: Expect, body: str) -> None:
    """All points of the file with their lines; the rail's are counted from the highest one within 20 mm of its middle. Smoothing moves them."""
    parameter = {"wheel": "Wheel/Tread profile", "rail": "Rail/Measured head"}[body]
    with open(os.path.join(ROOT, "prm/curves", runs.parameters[RUN][parameter]), encoding="utf-8") as stream:
        lines = stream.read().splitlines()
    points = {number + 1: [float(word) for word in line.split()] for number, line in enumerate(lines) if line and not line.startswith("#")}
    for run in (RUN, "half_curve"):
        table = runs.of(run, f"measured_{body}.csv")
        expect.near(f"{run}: lines", np.sort(table["line"]), sorted(points))
        y, z = np.array([points[int(line)] for line in table["line"]]).T
        expect.near(f"{run}: measured y", table["measured_y_mm"], y, absolute=1e-6)
        if body == "rail":
            z -= z[np.abs(y) <= 20.].max()
        moves = 0.25 if run == "half_curve" else 0.
        # What is smoothed is counted from its own highest point.
        zero = np.median(table["measured_z_mm"] - z) if moves else 0.
        expect.near(f"{run}: zero", zero, 0., absolute=0.02)
        expect.near(f"{run}: measured z", table["measured_z_mm"], z + zero, absolute=1e-6)
        ends = np.arange(len(y))
        before, behind = np.maximum(ends - 1, 0), np.minimum(ends + 1, len(y) - 1)
        along = np.array([y[behind] - y[before], z[behind] - z[before]])
        moved = 1e3 * np.abs((table["y_mm"] - table["measured_y_mm"]) * along[1] - (table["z_mm"] - table["measured_z_mm"]) * along[0]) / np.hypot(*along)
        expect.near(f"{run}: y", table["y_mm"], y, absolute=moves + 1e-6)
        expect.near(f"{run}: z", table["z_mm"], z + zero, absolute=moves + 1e-6)
        if moves:
            expect.near("most moved, um", 1e6 * runs.of(run)[f"{body}_profile_largest_change_m"], moved.max(), relative=1e-4)
            screen, words = runs.of(run, "screen"), f"{body} profile smoothed over # mm: moved by # um at most, at y = # mm"
            length = runs.number(run, f"{body.capitalize()}/Smoothing length (mm)")
            for place, value in enumerate((length, moved.max(), table["y_mm"][np.argmax(moved)])):
                expect.near(f"screen, {place + 1}", screen[f"{words} {place + 1}"], value, absolute=max(0.0051, 6e-3 * abs(value)))


@compared
def words(runs: Runs, expect: Expect) -> None:
    for run, method in ((RUN, "explicit finite elements"), ("half_curve", "half-space solver")):
        summary = runs.of(run)
        expect.same("title", summary["title"], runs.parameters[run]["Scene/Title"])
        expect.same("method", summary["method"], method)
        expect.near("friction", summary["friction_coefficient"], runs.number(run, "Contact/Friction coefficient"))


@compared_each("normal_force_N", "longitudinal_force_N", "lateral_force_N", "frictional_power_W")
def beside_the_half_space_of_both(runs: Runs, expect: Expect, name: str) -> None:
    summary = runs.of(RUN)
    path = f"reference/{name}/half-space"
    if path + "/relative_difference" in summary:
        expect.near("difference", summary[path + "/relative_difference"], summary[name] / summary[path + "/value"] - 1, relative=1e-6)
    if name == "frictional_power_W":
        expect.near("sum", summary[path + "/value"], sum(summary[keys[name]] for keys in patches_of(summary, "half_space_patches")), relative=1e-9)
    if name == "normal_force_N":
        expect.near("load, kN", 1e-3 * summary[path + "/value"], 300., relative=1e-3)


@compared
def twist_of_the_axle(runs: Runs, expect: Expect) -> None:
    """The axle's ends turn against each other by what the longitudinal forces are more than at the start."""
    history = runs.of(RUN, "history.csv")
    time, inertia = history["time_s"], runs.number(RUN, "Wheel/Moment of inertia (kg m2)")
    stiffness = 1e6 * runs.number(RUN, "Wheelset/Axle torsional stiffness (MN m per rad)")
    other = history["other_longitudinal_force_N"]
    own = history["longitudinal_force_N"] - other
    outside = -0.5 * RADIUS * (own - other)
    twist = rate = 0.
    followed = []
    for row, step in enumerate(np.diff(time, prepend=0.)):
        for _ in range(20):
            rate += step / 20 * 2 * (outside[row] - outside[0] - stiffness * twist) / inertia
            twist += step / 20 * rate
        followed.append(twist)
    expect.near("twist, mrad", 1e3 * history["axle_twist_rad"], 1e3 * np.array(followed), relative=0.25)


@compared
def motion_of_the_history(runs: Runs, expect: Expect) -> None:
    """Moments of the guidance and the contacts turn and roll the wheelset: its yaw falls where the cones steer it, and the roll follows the shift."""
    history = runs.of(RUN, "history.csv")
    expect.near("roll, mrad", 1e3 * history["roll_rad"], -1e3 * history["lateral_shift_m"] * CONE / (GAUGE_HALF - 0.04), absolute=0.02)
    expect.near("yaw, mrad", 1e3 * history["yaw_rad"], 3., absolute=0.2)
    expect.near("shift, mm", 1e3 * history["lateral_shift_m"], 3., absolute=0.05)
    expect.that("the yaw falls", np.all(np.diff(history["yaw_rad"]) < 1e-9) and history["yaw_rad"][-1] < 2.95e-3)
    chord = history["yaw_rad"] - history["yaw_rad"][0]
    for wheel in ("own", "other"):
        tilt = history[f"{wheel}_wheel_yaw_rad"]
        # A wheel keeps its direction at first, while the line between both turns.
        expect.that(f"{wheel} wheel lags behind the yaw", np.all(tilt[-8:] > 0.) and 0.4 < -tilt[-1] / chord[-1] < 1.2)
