#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What friction does to each place of both surfaces: sums against the ledger, rows against half-space theory, wear, flash temperature; ranks, resuming."""

import math
import os
import sys
import tempfile

import numpy as np

from tread.files import read_summary
from tread.vtu import read_pieces
from tread_runner import Check, script, arguments_of, execute_often, run, run_stopped, table

program = sys.argv[1]
check = Check()
WEAR, HEAT = "damage/wear-passage.prm", "damage/flash-temperature.prm"
COARSE = ["Mesh/Finest cell (mm)=1.3", "Output/Write volume=false"]
RAIL, WHEEL = "rail_surface_damage.csv", "wheel_surface_damage.csv"


def columns(folder, name):
    return {key: np.array(values) for key, values in table(folder, name).items()}


def integral(of, key):
    return float((of[key] * of["area_m2"]).sum())


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    rolled = [*COARSE, "Motion/Rolled distance (mm)=34", "Scene/Reproducible=true"]
    summary = run(program, WEAR, path("one"), rolled)
    rail, wheel = columns(path("one"), RAIL), columns(path("one"), WHEEL)

    # Sums over the surfaces: nine digits are written.
    for name, of in (("rail", rail), ("wheel", wheel)):
        check.relative(f"{name}: work over the surface, J", integral(of, "friction_work_J_per_m2"), summary["frictional_work_J"], 1e-8)
        check.relative(f"{name}: volume lost, m3", integral(of, "wear_depth_m"), summary["wear_volume_m3"], 1e-7)
    # By Coulomb's law what slips loses friction coefficient times normal force times distance.
    check.relative("Archard's volume, m3", summary["wear_volume_m3"], 1e-4 / 2800e6 * summary["frictional_work_J"] / 0.5, 1e-4)
    check.relative("T-gamma, N", summary["t_gamma_N"], summary["frictional_power_W"] / (140 / 3.6), 1e-9)
    check.absolute("surface fatigue index", summary["surface_fatigue_index"],
                   summary["friction_used"] - 300e6 / summary["max_pressure_Pa"], 1e-6)

    check.relative("friction used", summary["friction_used"], math.hypot(summary["longitudinal_force_N"], summary["lateral_force_N"]) / summary["normal_force_N"], 1e-6)
    check.relative("p0/k", summary["shakedown_load_factor"], summary["max_pressure_Pa"] / 300e6, 1e-6)
    check.relative("T-gamma over area, Pa", summary["t_gamma_per_area_Pa"], summary["t_gamma_N"] / summary["patch_area_m2"], 1e-6)
    # Severe wear of a wheel of R8T on a rail of 900A, 55.12 ug per m and mm2, where T-gamma over area is between 10.4 and 77.2 N/mm2.
    check.relative("wear rate, kg/m3", summary["regime_wear_rate_kg_per_m3"], min(5.3e-9 * summary["t_gamma_per_area_Pa"], 55.12e-3), 1e-6)
    check.that("no function of damage was given", "t_gamma_damage" not in summary)

    # Rows across the path where rolling is steady, beside the half-space's: its element rows over the speed.
    at = np.unique(rail["x_mm"])
    middle = at[np.argmin(np.abs(at + 13.))]
    row = {key: values[rail["x_mm"] == middle] for key, values in rail.items()}
    patch = columns(path("one"), "reference_patch.csv")
    lines = np.unique(patch["y_mm"])
    dx = np.diff(np.unique(patch["x_mm"])).min() * 1e-3
    slip = np.hypot(patch["slip_x_m_per_s"], patch["slip_y_m_per_s"])
    power = 1e6 * np.hypot(patch["shear_x_MPa"], patch["shear_y_MPa"]) * slip
    sums = lambda values: np.array([values[patch["y_mm"] == y].sum() for y in lines]) * dx / (140 / 3.6)
    # Regression: cells of 1.3 mm; 0.7 % of the work with cells of 0.63 mm.
    wanted = np.interp(row["y_mm"], lines, sums(power), left=0., right=0.)
    check.below("work across the path beside the half-space's, largest difference over the largest", np.abs(row["friction_work_J_per_m2"] - wanted).max() / wanted.max(), 0.025)
    # A row of elements begins to slip at a whole one, so that slip is compared over all rows.
    check.relative("slip over the width, mm2", 1e3 * np.trapz(row["slip_distance_m"], row["y_mm"]), 1e3 * np.trapz(sums(slip), lines), 0.08)
    check.below("left and right alike", np.abs(row["friction_work_J_per_m2"] - np.interp(-row["y_mm"], row["y_mm"], row["friction_work_J_per_m2"])).max()
                / row["friction_work_J_per_m2"].max(), 5e-3)
    check.relative("largest pressure, Pa", row["max_pressure_Pa"].max(), summary["max_pressure_Pa"], 0.02)
    check.relative("largest shear stress, Pa", row["max_shear_Pa"].max(), summary["max_shear_Pa"], 0.03)
    check.that("one passage", set(row["passages"]) == {1.} and set(rail["passages"]) == {1.} and set(wheel["passages"]) == {1.})
    # The wheel's place that met the rail's: as far along the tread as along the rail, but for the creepage.
    along = np.radians(wheel["angle_deg"]) * 460.
    sides = {name: np.interp(middle - rail["x_mm"].min(), places - places.min(), work) for name, places, work in (
        ("rail", *(lambda t, k: (np.unique(t), np.array([k[t == p].sum() for p in np.unique(t)])))(rail["x_mm"], rail["friction_work_J_per_m2"])),
        ("wheel", *(lambda t, k: (np.unique(t), np.array([k[t == p].sum() for p in np.unique(t)])))(np.round(along, 6), wheel["friction_work_J_per_m2"])))}
    check.relative("wheel beside rail: work of a row", sides["wheel"], sides["rail"], 0.02)

    # ParaView's fields of the rail, at the solution instant: the largest are those of places that are passed.
    fields = [fields for _, _, fields in read_pieces(os.path.join(path("one"), "surface-0000.vtu"))]
    for key in ("friction_work_J_per_m2", "slip_distance_m", "max_flash_temperature_K", "wear_depth_m"):
        check.relative(f"picture: largest {key}", max(float(piece[key].max()) for piece in fields), rail[key].max(), 1e-6)

    # On three ranks, each with a strip of its own, and stopped and resumed.
    run(program, WEAR, path("three"), [*rolled[:-1], "Scene/Reproducible=false"], ranks=3)
    for name in (RAIL, WHEEL):
        one, three = columns(path("one"), name), columns(path("three"), name)
        for key in one:
            check.below(f"three ranks, {name}: {key}", np.abs(three[key] - one[key]).max() / np.abs(one[key]).max(), 1e-6)
    run_stopped(program, WEAR, path("stopped"), rolled, 8)
    again = execute_often(arguments_of(WEAR, rolled, path("stopped")) + ["--resume"], program)
    check.that("resumed", again.returncode == 0 and "resumed at" in again.stdout)
    for name in (RAIL, WHEEL):
        with open(os.path.join(path("one"), name), "rb") as first, open(os.path.join(path("stopped"), name), "rb") as second:
            check.that(f"stopped and resumed: the same {name}", first.read() == second.read())

    # Ertz and Knothe's patch that slides: with the same slip everywhere both surfaces heat by 150.3 K. Surfaces stretch, and slip at 0.886 to 1.108 m/s by half-space
    # theory; with that the exact kernel gives 152.47 K on the rail and, as the wheel passes at 31 m/s, 149.99 K on it.
    hot = run(program, HEAT, path("hot"), [*COARSE, "Motion/Rolled distance (mm)=24"])
    rail, wheel = columns(path("hot"), RAIL), columns(path("hot"), WHEEL)
    check.relative("flash temperature of the rail, K", rail["max_flash_temperature_K"].max(), 152.47, 0.01)
    check.relative("and of the wheel, K", wheel["max_flash_temperature_K"].max(), 149.99, 0.012)
    check.relative("in the summary the hotter one", hot["max_flash_temperature_K"], rail["max_flash_temperature_K"].max(), 1e-8)
    shared = run(program, HEAT, path("shared"), [*COARSE, "Motion/Rolled distance (mm)=24", "Damage/Heat share of the wheel=0.2", "Rail/Density (kg per m3)=7000"])
    check.relative("four fifths into the rail, which is lighter", columns(path("shared"), RAIL)["max_flash_temperature_K"].max() / rail["max_flash_temperature_K"].max(),
                   1.6 * math.sqrt(7850 / 7000), 2e-3)
    check.relative("and a fifth into the wheel", columns(path("shared"), WHEEL)["max_flash_temperature_K"].max() / wheel["max_flash_temperature_K"].max(), 0.4, 2e-3)

    # A coefficient of 0.3 - 0.18 T/400 C: with one slip all over the patch 26 387 N and 126.8 K (exact kernel); surfaces stretch, which is 1.4 % of the temperature of constant friction.
    linear = run(program, HEAT, path("linear"), ["Contact/Friction temperatures (C)=0,400", "Contact/Friction temperature factors=1,0.4", "Damage/Rail temperature (C)=0", "Damage/Wheel temperature (C)=0"],
                 command="reference")
    check.relative("friction linear in the temperature: force, N", abs(linear["longitudinal_force_N"]), 26387., 3e-3)
    check.relative("and flash temperature, K", linear["max_flash_temperature_K"], 126.8, 0.02)

    # Friction that falls with the temperature: from 0.3 at 20 degrees to a third of it at 320, so that it heats less. Beside half-space theory at the same creepage.
    falls = ["Contact/Friction temperatures (C)=20,320", "Contact/Friction temperature factors=1,0.3333333333"]
    cooler = run(program, HEAT, path("falls"), [*COARSE, "Motion/Rolled distance (mm)=24", *falls])
    of_theory = run(program, HEAT, path("falls line"), falls, command="reference")
    check.relative("falling friction: traction beside half-space theory", cooler["traction_coefficient"], of_theory["traction_coefficient"], 4e-3)
    check.relative("falling friction: flash temperature of the rail, K", columns(path("falls"), RAIL)["max_flash_temperature_K"].max(),
                   columns(path("falls line"), RAIL)["max_flash_temperature_K"].max(), 0.01)
    check.relative("and the comparison of the run itself", cooler["reference"]["traction_coefficient"]["half-space"]["value"], of_theory["traction_coefficient"], 4e-3)
    # In full sliding each place has the coefficient of its temperature: less by 2 % for each 9 K.
    check.that("it carries less, by what the heat leaves", 0.2 < abs(cooler["traction_coefficient"]) < 0.28)
    # A wheel that comes warm to a cold rail: what counts is the mean, of steels with unlike effusivities nearer to that of the larger one.
    unlike = ["Rail/Density (kg per m3)=5000", "Damage/Rail temperature (C)=80", "Damage/Wheel temperature (C)=-20"]
    warm = run(program, HEAT, path("warm"), [*unlike, *falls], command="reference")
    mean = (math.sqrt(5000.) * 80. - math.sqrt(7850.) * 20.) / (math.sqrt(5000.) + math.sqrt(7850.))
    alike = run(program, HEAT, path("alike"), [unlike[0], f"Damage/Rail temperature (C)={mean:.9f}", f"Damage/Wheel temperature (C)={mean:.9f}", *falls], command="reference")
    check.relative("unlike temperatures: traction of their mean", warm["traction_coefficient"], alike["traction_coefficient"], 1e-6)
    other = run(program, HEAT, path("other"), [unlike[0], "Damage/Rail temperature (C)=-20", "Damage/Wheel temperature (C)=80", *falls], command="reference")
    check.that("and not of the mean the other way round", abs(other["traction_coefficient"] / warm["traction_coefficient"] - 1.) > 0.01)

    # Mirror images: slip to the other side and spin the other way round leave the mirrored surface.
    images = []
    for sign in (1, -1):
        run(program, WEAR, path(f"image {sign}"), [*COARSE, "Motion/Rolled distance (mm)=10", f"Motion/Lateral creepage={1e-3 * sign}", f"Motion/Spin (1 per m)={0.3 * sign}"])
        image = columns(path(f"image {sign}"), RAIL)
        order = np.lexsort((np.round(sign * image["y_mm"], 3), np.round(image["x_mm"], 3)))
        images.append({key: values[order] for key, values in image.items()})
    check.that("mirror images: places", np.allclose(images[0]["x_mm"], images[1]["x_mm"], atol=1e-3) and np.allclose(images[0]["y_mm"], -images[1]["y_mm"], atol=1e-3))
    work = images[0]["friction_work_J_per_m2"]
    check.that("the two sides of the path differ", np.abs(work[images[0]["y_mm"] > 0.1].sum() / work[images[0]["y_mm"] < -0.1].sum() - 1.) > 0.1)
    for key in ("friction_work_J_per_m2", "slip_distance_m", "max_pressure_Pa", "max_shear_Pa", "max_flash_temperature_K", "wear_depth_m"):
        check.below(f"mirror images: {key}, largest difference over the largest", np.abs(images[0][key] - images[1][key]).max() / images[0][key].max(), 1e-4)

    # By half-space theory alone: a row for each line along the path.
    for scene, name in ((WEAR, "line"), (HEAT, "hot line")):
        run(program, scene, path(name), command="reference")
    line = columns(path("line"), RAIL)
    check.below("work across the path, elements and cells, largest difference over the largest",
                np.abs(row["friction_work_J_per_m2"] - np.interp(row["y_mm"], line["y_mm"], line["friction_work_J_per_m2"], left=0., right=0.)).max()
                / line["friction_work_J_per_m2"].max(), 0.025)
    check.relative("slip over the width, mm2", 1e3 * np.trapz(line["slip_distance_m"], line["y_mm"]), 1e3 * np.trapz(row["slip_distance_m"], row["y_mm"]), 0.08)
    for key, of_run, limit in (("max_pressure_Pa", row["max_pressure_Pa"].max(), 0.02), ("max_shear_Pa", row["max_shear_Pa"].max(), 0.05)):
        check.relative(f"the same of {key}", line[key].max(), of_run, limit)
    check.relative("Archard's depth, nm", 1e9 * line["wear_depth_m"].max(), 1e9 * 1e-4 / 2800e6 * line["friction_work_J_per_m2"].max() / 0.5, 1e-4)
    check.relative("flash temperature of the rail, K", columns(path("hot line"), RAIL)["max_flash_temperature_K"].max(), 152.47, 4e-3)
    check.relative("and of the wheel, K", columns(path("hot line"), WHEEL)["max_flash_temperature_K"].max(), 149.99, 4e-3)
    check.relative("work on a metre of way, J", integral(line, "friction_work_J_per_m2"), read_summary(path("line"))["t_gamma_N"], 5e-3) # which is extrapolated to small elements
    wheelset = run(program, "curves/two-patches.prm", path("wheelset"), ["Damage/Record=true", "Damage/Shear strength (MPa)=300", "Damage/Function T-gammas (N)=0, 10000", "Damage/Function damages=0, 1"],
                   command="reference")
    patches = wheelset["patches"]
    check.relative("T-gamma is the sum over the patches, N", wheelset["t_gamma_N"], sum(patch["t_gamma_N"] for patch in patches), 1e-9)
    for patch in patches:
        used = math.hypot(patch["longitudinal_force_N"], patch["lateral_force_N"]) / patch["normal_force_N"]
        for key, wanted in (("t_gamma_N", patch["frictional_power_W"] / (wheelset["frictional_power_W"] / wheelset["t_gamma_N"])), ("friction_used", used), ("shakedown_load_factor", patch["max_pressure_Pa"] / 300e6),
                            ("surface_fatigue_index", used - 300e6 / patch["max_pressure_Pa"]), ("t_gamma_per_area_Pa", patch["t_gamma_N"] / patch["area_m2"]),
                            ("t_gamma_damage", patch["t_gamma_N"] / 10000)):
            check.relative(f"patch at y = {1e3 * patch['y_rail_m']:.1f} mm: {key}", patch[key], wanted, 1e-6)
    for key in ("friction_used", "shakedown_load_factor", "surface_fatigue_index", "t_gamma_per_area_Pa", "regime_wear_rate_kg_per_m3", "t_gamma_damage"):
        check.relative(f"of the worst patch: {key}", wheelset[key], max(patch[key] for patch in patches), 1e-12)
    for name in (RAIL, WHEEL):
        passed = columns(path("wheelset"), name)
        # A place of the wheel is passed as often as its surface is faster: more by the creepage of its patch.
        check.relative(f"two patches with elements of their own, {name}: work on a metre of way, J", integral(passed, "friction_work_J_per_m2"), wheelset["t_gamma_N"], 2e-3 if name == RAIL else 0.03)
    check.refused("a wheel that does not turn", program, "curves/two-patches.prm", path("refused"), ["Damage/Record=true", "Motion/Angular velocity (rad per s)=0"],
                  ["'Damage/Record'", "passes"], command="reference")
    check.that("pictures of it", "damage.png" in "".join(script("plot/plot-run.py", path("line")).stdout + " ".join(os.listdir(os.path.join(path("line"), "pictures")))))

    # Passages: each begins cold, on a rail that remembers work.
    passed = run(program, WEAR, path("passages"), [*COARSE, "Mesh/Fine half width (mm)=9", "Motion/Rolled distance (mm)=6", "Motion/Passages=2", "Rail/Yield stress (MPa)=1500", "Damage/Wear law=friction work"])
    once = run(program, WEAR, path("passage"), [*COARSE, "Mesh/Fine half width (mm)=9", "Motion/Rolled distance (mm)=6", "Rail/Yield stress (MPa)=1500", "Damage/Wear law=friction work"])
    both, single = (columns(path(name), RAIL) for name in ("passages", "passage"))
    check.relative("two passages: work over the rail, J", integral(both, "friction_work_J_per_m2"), 2. * once["frictional_work_J"], 0.05)
    check.that("each place twice", set(both["passages"]) <= {1., 2.} and (both["passages"] == 2.).mean() > 0.9)
    check.relative("as hot as once, K", both["max_flash_temperature_K"].max(), single["max_flash_temperature_K"].max(), 0.05)
    check.relative("1 mm3 for a kJ", passed["wear_volume_m3"], 1e-12 * integral(both, "friction_work_J_per_m2"), 1e-7)
    check.relative("the last wheel's work, J", integral(columns(path("passages"), WHEEL), "friction_work_J_per_m2"), passed["frictional_work_J"], 1e-7)

    # What has no effect is said.
    unused = run(program, WEAR, path("unused"), [*COARSE, "Motion/Rolled distance (mm)=1", "Damage/Record=false"])
    check.that("a law without a record", any("'Damage/Wear law'" in line for line in unused["unused_parameters"]))
    check.that("no tables", not os.path.exists(os.path.join(path("unused"), RAIL)) and "wear_volume_m3" not in unused)
    check.refused("a negative hardness", program, WEAR, path("refused"), ["Damage/Hardness (MPa)=-3"], ["Hardness (MPa)"])
    check.refused("no such law", program, WEAR, path("refused"), ["Damage/Wear law=Archad"], ["Wear law", "Archard"])

check.exit()
