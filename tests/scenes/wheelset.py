#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheelset in any position in half-space theory: the Manchester contact benchmark, mirrored positions, contact points, bad input."""

import math
import os
import re
import sys
import tempfile

import numpy as np

from tread.manchester import positions, solve
from tread.runs import ROOT, arguments_of
from loaded_once import execute_often
from tread_runner import Check, rows_of, run, table

program = sys.argv[1]
check = Check()
RIGHT = os.path.join(ROOT, "prm", "curves", "manchester-a22-right.prm")
HEAD = "profiles/uic60-manchester.txt"


def position(side, shift):
    return next((settings, given) for wheel, y, settings, given in positions() if (wheel, y) == (side, shift))


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    # CONTACT has three to four digits, and elements of 0.2 mm: on flanges, 0.7 mm wide, its largest pressure is up to 2 % high.
    for side, shift, settings, given in positions():
        if side == "left" and shift in (2, 6, 8):
            continue  # like its neighbours
        name = f"{side} wheel, y_ws {shift:g} mm"
        answer = solve(side, settings, program)
        check.relative(f"{name}: vertical force, kN", 1e-3 * answer["normal_force_N"], 10., 1e-5)
        if not check.that(f"{name}: one patch", len(answer["patches"]) == 1):
            continue
        patch = answer["patches"][0]
        check.relative(f"{name}: normal force, N", patch["normal_force_N"], given["normal_force_N"], 2e-3)
        check.absolute(f"{name}: longitudinal force, N", patch["longitudinal_force_N"], given["longitudinal_force_N"], 12.)
        check.absolute(f"{name}: lateral force, N", patch["lateral_force_N"], given["lateral_force_N"], 20.)
        for key in ("x_m", "y_m"):
            check.absolute(f"{name}: {key[0]} of the contact, mm", 1e3 * patch[key], 1e3 * given[key], 2.5e-3)
        check.absolute(f"{name}: contact angle, rad", patch["angle_rad"], given["angle_rad"], 2e-4)
        check.relative(f"{name}: largest pressure, MPa", 1e-6 * patch["max_pressure_Pa"], 1e-6 * given["max_pressure_Pa"], 0.02)
        check.absolute(f"{name}: lateral creepage, 1e-3", 1e3 * patch["lateral_creepage"], 1e3 * given["lateral_creepage"], 0.01)
        check.relative(f"{name}: spin, 1/m", patch["spin_per_m"], given["spin_per_m"], 2e-3)

    # A lubricated gauge corner, by the inclination of the surface (CONTACT's variant of the benchmark: 0.2 from 20 degrees on, 0.3 up to 10): planar, with a
    # patch distance of 6 mm. The same by y of places that have these inclinations.
    corner = {"Wheelset/Lateral shift (mm)": 5.5, "Wheelset/Yaw (mrad)": 13.2, "Wheelset/Roll (mrad)": -0.4777,
              "Motion/Angular velocity (rad per s)": 4.3318864, "Wheelset/Patch distance (mm)": 6}
    slippery = {**corner, "Contact/Friction inclinations (deg)": "10, 20", "Contact/Friction inclination factors": f"1, {2 / 3:.15g}"}
    answer, plain = solve("right", slippery, program)["patches"][0], solve("right", corner, program)["patches"][0]
    check.relative("friction by inclination: normal force, N", answer["normal_force_N"], 9907., 2e-3)
    check.relative("friction by inclination: longitudinal force, N", abs(answer["longitudinal_force_N"]), 608.6, 0.015)
    check.relative("friction by inclination: lateral force, N", abs(answer["lateral_force_N"]), 1963., 0.015)
    check.that("as much everywhere carries a tenth more", abs(plain["lateral_force_N"]) > 1.1 * abs(answer["lateral_force_N"]))
    points = np.loadtxt(os.path.join(ROOT, "prm", "curves", HEAD))
    on_corner = points[(points[:, 0] > -38.) & (points[:, 0] < -20.)]
    falls = np.degrees(np.arctan(-np.gradient(on_corner[:, 1], on_corner[:, 0])))
    angles = np.linspace(20., 10., 21)
    places = np.interp(-angles, -falls, on_corner[:, 0])
    listed = lambda values: ", ".join(f"{value:.6g}" for value in values)
    by_place = solve("right", {**corner, "Contact/Friction across (mm)": listed(places),
                               "Contact/Friction across factors": listed(np.linspace(2 / 3, 1., 21))}, program)["patches"][0]
    for key in ("longitudinal_force_N", "lateral_force_N"):
        check.relative(f"friction by place, from {places[0]:.1f} to {places[-1]:.1f} mm: {key}", by_place[key], answer[key], 0.003)

    # Both wheels of a wheelset in the middle, and in mirrored positions.
    for shift in (0, 6):
        settings, _ = position("right", shift)
        own = run(program, "curves/manchester-a22-right.prm", path("own"), settings, command="reference")
        other = run(program, "curves/manchester-a22-left.prm", path("other"), settings, command="reference")
        for key in ("normal_force_N", "lateral_force_N", "spin_moment_Nm", "max_pressure_Pa"):
            check.relative(f"mirrored, {shift} mm: {key}", own["patches"][0][key], other["patches"][0][key], 1e-10)

    # The sums of patch.csv are those of the summary.
    patch, nodes = own["patches"][0], rows_of(path("own"), "patch.csv")
    weight = lambda column: 1e-6 * sum(row["area_mm2"] * 1e6 * row[column] for row in nodes)
    check.relative("patch.csv: normal force, kN", 1e-3 * weight("pressure_MPa"), 1e-3 * patch["normal_force_N"], 1e-6)
    check.relative("patch.csv: lateral force, kN", 1e-3 * weight("shear_y_MPa"), 1e-3 * patch["lateral_force_N"], 0.002)
    check.that("patch.csv: no shear beyond the friction bound", all(
        math.hypot(row["shear_x_MPa"], row["shear_y_MPa"]) <= 0.3 * row["pressure_MPa"] * (1 + 1e-6) for row in nodes))
    # Force balance in the track by the angle.
    angle = patch["angle_rad"]
    check.relative("lateral force in the track, kN", 1e-3 * own["lateral_force_N"], 1e-3 * (
        math.cos(angle) * patch["lateral_force_N"] - math.sin(angle) * patch["normal_force_N"]), 1e-9)

    # A patch 16 mm wide on the tread's changing radius: what the plane does not know, and that it is said.
    surface = run(program, "curves/manchester-a22-right.prm", path("surface"), {"Wheelset/Slip over the patch": "surface"},
                  command="reference")
    check.absolute("slip by the wheel's surface: longitudinal force, N", surface["longitudinal_force_N"], 117., 1.5)

    # A lateral speed imposed on the wheelset adds to what yaw makes, along the patch.
    settings, _ = position("right", 4)
    straight, pushed = (solve("right", {**settings, "Motion/Lateral creepage": creepage}, program)["patches"][0] for creepage in (0, 0.002))
    check.relative("imposed lateral creepage", pushed["lateral_creepage"] - straight["lateral_creepage"],
                   0.002 * math.cos(straight["angle_rad"]), 2e-3)
    check.that("imposed lateral creepage drags the wheel less against it", pushed["lateral_force_N"] < straight["lateral_force_N"])

    # From the tread to the flange of a rail that leans more: two patches, then one for which a plane is not enough.
    heavy = {"Rail/Measured head": "", "Rail/Profile": "60E1", "Rail/Inclination": "1:20", "Vehicle/Sprung mass (kg)": 9000}
    two, wide = (run(program, "curves/manchester-a22-right.prm", path(f"heavy-{shift}"), {**heavy, "Wheelset/Lateral shift (mm)": shift},
                     command="reference") for shift in (6, 6.1))
    check.that("two patches, and that one deforms the other", len(two["patches"]) == 2 and len(two["warnings"]) == 1
               and "patch 1 gives way" in two["warnings"][0])
    check.relative("two patches: their vertical forces, kN", sum(
        math.cos(p["angle_rad"]) * p["normal_force_N"] + math.sin(p["angle_rad"]) * p["lateral_force_N"] for p in two["patches"]),
        9900 * 9.81, 1e-5)
    check.that("a conformal patch is told", any("conformal" in warning and "degrees" in warning for warning in wide["warnings"]))
    check.that("the benchmark is not conformal", not own["warnings"] and not surface["warnings"])

    # Contact points: rows, symmetry, the flange.
    result = execute_often(["contact-points", RIGHT, "--output", path("points")], program)
    check.that("contact-points ends well", result.returncode == 0)
    points = table(path("points"), "contact_points.csv")
    # The wheel stands on the rail where the table says so.
    rail, wheel = (table(path("points"), f"{body}_profile.csv") for body in ("rail", "wheel"))
    middle = points["lateral_shift_mm"].index(0.)
    gaps = [(z - np.interp(y, rail["y_mm"], rail["z_mm"]), y) for y, z in zip(wheel["y_mm"], wheel["z_mm"]) if abs(y - points["own_y_mm"][middle]) < 15.]
    check.absolute("profiles: gap where the wheel is nearest, mm", min(gaps)[0], 0., 2e-3)
    check.absolute("profiles: there it touches, mm", min(gaps)[1], points["own_y_mm"][middle], 1.)
    check.absolute("profiles: the rail's top, mm", max(rail["z_mm"]), 0., 1e-3)
    check.that("81 shifts from -10 to 10 mm", len(points["lateral_shift_mm"]) == 81 and points["lateral_shift_mm"][0] == -10.)
    difference = points["radius_difference_mm"]
    check.absolute("radius difference is odd, um", 1e3 * max(abs(a + b) for a, b in zip(difference, reversed(difference))), 0., 0.01)
    # The conicity of EN 15302 from the wavelength of y'' = -dr(y), stepped through time from the extreme to the middle.
    by_shift = {shift: row for row, shift in enumerate(points["lateral_shift_mm"])}
    for amplitude in (2., 3., 4.):
        row, y, v, time, step = by_shift[amplitude], amplitude, 0., 0., 2e-3
        while y > 0.:
            v -= step * np.interp(y, points["lateral_shift_mm"], points["radius_difference_mm"])
            y, time = y + step * v, time + step
        time += y / -v
        check.relative(f"equivalent conicity at {amplitude:g} mm", points["equivalent_conicity"][row], math.pi ** 2 / (8. * time ** 2), 0.01)
        check.absolute(f"equivalent conicity at {amplitude:g} mm without roll", points["equivalent_conicity_without_roll"][row], points["equivalent_conicity"][row], 0.01)
        check.relative(f"harmonic conicity at {amplitude:g} mm", points["harmonic_conicity"][row], points["equivalent_conicity"][row], 0.02)
    check.that("the conicity at 3 mm is printed", f"amplitude of 3 mm (EN 15302): {points['equivalent_conicity'][by_shift[3.]]:.3f}" in result.stdout)
    # The other side from another scene: the same one changes nothing, a larger wheel there moves the middle of the motion to where radii are equal.
    head = f"subsection Rail\n set Measured head = {os.path.join(ROOT, 'prm', 'curves', HEAD)}\nend\n"
    with open(path("larger.prm"), "w", encoding="utf-8") as stream:
        stream.write(f"include {RIGHT}\n{head}subsection Wheel\n set Radius (mm) = 460.2\nend\n")
    with open(path("wide.prm"), "w", encoding="utf-8") as stream:
        stream.write(f"include {RIGHT}\n{head}subsection Wheelset\n set Track gauge (mm) = 1440\nend\n")
    same = execute_often(["contact-points", RIGHT, "--other-side", RIGHT, "--output", path("same")], program)
    check.that("the other side by the same scene", same.returncode == 0 and str(table(path("same"), "contact_points.csv")) == str(points))  # nan is nan
    unlike = execute_often(["contact-points", RIGHT, "--other-side", path("larger.prm"), "--output", path("unlike")], program)
    unlike_points = table(path("unlike"), "contact_points.csv")
    check.absolute("a larger other wheel: radius difference in the middle without roll, mm", unlike_points["radius_difference_without_roll_mm"][by_shift[0.]], -0.2, 1e-6)
    shift = float(re.search(r"equal at a lateral shift of (\S+) mm", unlike.stdout)[1])
    # The contact jumps there, and the difference with it.
    rows = list(zip(unlike_points["lateral_shift_mm"], unlike_points["radius_difference_mm"]))
    check.that("a larger other wheel: there the radii are equal", max(row for row in rows if row[0] <= shift)[1] < 0. < min(row for row in rows if row[0] >= shift)[1])
    check.that("a larger other wheel: the middle of the motion is on the own side", 0.1 < shift < 1.5)
    for wheel in ("own", "other"):
        check.below(f"{wheel} wheel in the middle: its contact from the middle of its rail head, mm", points[f"{wheel}_y_rail_mm"][40], 10.)
    check.absolute("own wheel: centre of the patch near that of rigid contact, mm", 1e3 * solve("right", position("right", 0)[0], program)
                   ["patches"][0]["y_rail_m"], points["own_y_rail_mm"][40], 2.)
    check.absolute("flange angle at 8 mm, degrees", math.degrees(points["own_angle_rad"][72]), 57., 3.)

    # Equivalent conicity: the integral over a harmonic motion to both sides, the same in rows of both.
    shifts, conicity = np.array(points["lateral_shift_mm"]), np.array(points["equivalent_conicity"])
    angles = 2. * np.pi * (np.arange(720) + 0.5) / 720
    for amplitude in (2., 4.):
        integral = np.mean(np.interp(amplitude * np.sin(angles), shifts, difference) * np.sin(angles)) / amplitude
        for side in (-1., 1.):
            check.relative(f"equivalent conicity, row {side * amplitude:g} mm", conicity[list(shifts).index(side * amplitude)], integral, 0.02)
    check.that("a conicity in each row but the middle one", list(np.isnan(conicity)) == [shift == 0. for shift in shifts])

    # Steep cones on short profiles touch at several rolls: both sides of the track have the same, that of the way out of the middle.
    klingel = os.path.join(ROOT, "prm", "curves", "klingel.prm")
    check.that("contact points of steep cones", execute_often(["contact-points", klingel, "--output", path("steep")], program).returncode == 0)
    steep = table(path("steep"), "contact_points.csv")
    by_shift = dict(zip(steep["lateral_shift_mm"], steep["radius_difference_mm"]))
    check.that("steep cones: as many shifts to both sides", set(by_shift) == {-shift for shift in by_shift} and len(by_shift) > 50)
    check.absolute("steep cones: radius difference is odd, um", 1e3 * max(abs(by_shift[shift] + by_shift[-shift]) for shift in by_shift), 0., 0.01)
    check.absolute("steep cones: at 5 mm both wheels stand on their treads, mm", by_shift[5.], 2.2784, 1e-3)

    # The flange of the wheel's file has its back 70 mm from the running circle, as the scene says by default.
    elsewhere = "'Wheelset/Flange back (mm)' -62: the flange of 'Wheel/Tread profile' 'profiles/cone-1-5.txt' has its back at -70.0, so that the wheel stands 8.0 mm off"
    told = [run(program, "curves/klingel.prm", path(f"back {back}"), {"Wheelset/Flange back (mm)": back}, command="reference")["warnings"] for back in (-70, -67.5, -62)]
    check.that("a flange back of another wheel", [any("Flange back" in warning for warning in warnings) for warnings in told] == [False, False, True]
               and any(warning.startswith(elsewhere) for warning in told[2]))
    profiles = os.path.join(ROOT, "prm", "curves", "profiles")
    upright = {"Wheelset/Flange back (mm)": -62, "Wheel/Tread profile": f"{profiles}/cone-1-5.txt", "Rail/Measured head": f"{profiles}/crown-1-5.txt"}
    in_table = execute_often([*arguments_of("smooth-rolling.prm", upright, path("back-points"), "contact-points"), "--shift-step", "3"], program)
    check.that("and in a table of contact points", in_table.returncode == 0 and "warning: " + elsewhere.replace("profiles/", f"{profiles}/") in in_table.stdout)
    check.that("shifts that end before their last one", "the table ends at lateral shifts of 9 mm, before --shift-to 10" in in_table.stdout
               and max(table(path("back-points"), "contact_points.csv")["lateral_shift_mm"]) == 9.)
    check.that("nothing of both where they fit", "Flange back" not in result.stdout and "--shift-to" not in result.stdout)

    # What cannot be.
    def must_fail(what, arguments, *words):
        failed = execute_often([*arguments, "--output", path("bad")], program)
        lines = [line for line in failed.stderr.splitlines() if line.startswith("tread:")]
        if not check.that(f"{what}: exit code 1, one line with {words}", failed.returncode == 1 and len(lines) == 1
                          and all(word in lines[0] for word in words)):
            print(failed.returncode, failed.stderr)

    reference, points = ["reference", RIGHT], ["contact-points", RIGHT]
    must_fail("yaw beyond 5 degrees", [*reference, "-s", "Wheelset/Yaw (mrad)=90"], "Wheelset/Yaw (mrad)", "5 degrees")
    must_fail("falls between the rails", [*reference, "-s", "Wheelset/Lateral shift (mm)=-90"], "Wheelset/Lateral shift (mm)' -90", "falls between the rails")
    must_fail("the other flange in the other rail", [*reference, "-s", "Wheelset/Lateral shift (mm)=-27"], "Wheelset/Lateral shift (mm)' -27", "other wheel", "deep")
    must_fail("profiles that do not meet", [*reference, "-s", "Wheelset/Track gauge (mm)=1900"], "do not meet")
    must_fail("a rail without gauge face", [*reference, "-s", "Rail/Shape=block", "-s", "Rail/Measured head="], "Rail/Shape", "block")
    with open(path("flat.txt"), "w", encoding="utf-8") as stream:
        stream.writelines(f"{y} {0.02 * y}\n" for y in range(-60, 61))
    must_fail("a wheel without flange in a file", [*reference, "-s", f"Wheel/Tread profile={path('flat.txt')}"],
              "Wheel/Tread profile", "no flange")
    must_fail("no angular velocity", [*reference, "-s", "Motion/Angular velocity (rad per s)=by the drive"], "Motion/Angular velocity (rad per s)")
    must_fail("torque and angular velocity", [*reference, "-s", "Motion/Drive=torque"], "Motion/Drive", "torque")
    must_fail("contact points of a gauge too wide", [*points, "-s", "Wheelset/Track gauge (mm)=1900"], "do not meet")
    for what in (reference, points):
        must_fail(f"{what[0]}: a gauge below the distance of the flanges", [*what, "-s", "Wheelset/Track gauge (mm)=1000"],
                  "Wheelset/Track gauge (mm)' 1000", "Flange-back distance (mm)' 1360", "between the rails")
    must_fail("another gauge on the other side", [*points, "--other-side", path("wide.prm")], "--other-side", "track gauge")
    must_fail("shifts without a step", [*points, "--shift-step", "0"], "--shift-step")

check.exit()
