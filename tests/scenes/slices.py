#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rails of slices by finite elements: a rail that does not change beside its profile, wing and nose of a crossing beside half-space theory; bad input."""

import math
import os
import sys
import tempfile
import zlib

import numpy as np

from tread.crossing_force import SLICES
from tread.files import input_of, read_table
from tread.positions import rows_of, solve
from tread.runs import ROOT, arguments_of, must_end_well
from loaded_once import execute_often
from tread_runner import Check, run, run_stopped, table

program = sys.argv[1]
check = Check()
CURVE, NOSE, PASSAGE = "curves/two-patches.prm", "crossing/uk-56E1-nose.prm", "crossing/uk-56E1-passage.prm"
GIVEN = os.path.join(ROOT, "contrib", "contact-data", "crossing_given.csv")

with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    # The same profile at every x: its points once in 60 mm.
    short = ["Mesh/Finest cell (mm)=1", "Wheelset/Lateral shift (mm)=0", "Motion/Rolled distance (mm)=3", "Output/Write volume=false",
             "Motion/Angular velocity (rad per s)=84.5", "Wheel/Sector thickness (mm)=30", "Wheel/Sector width (mm)=50",
             "Peak stress/Region=range", "Peak stress/From (mm)=-2.5", "Peak stress/To (mm)=-0.5", "Peak stress/Depth (mm)=5"]
    must_end_well(execute_often([*arguments_of(CURVE, short, path("points"), "contact-points"), "--shift-to", "1"], program))
    points = table(path("points"), "rail_profile.csv")
    with open(path("same.csv"), "w", encoding="utf-8") as file:
        file.write("x_mm,y_mm,z_mm\n")
        for x in (-120, -60, 0, 60, 120):
            for y, z in zip(points["y_mm"], points["z_mm"]):
                file.write(f"{x},{y:.9f},{z:.9f}\n")
    profile = run(program, CURVE, path("profile"), short)
    slices = run(program, CURVE, path("slices"), [*short, "Rail/Shape=slices", f"Rail/Slices={path('same.csv')}", "Rail/Slices y (mm)=0", "Rail/Inclination=none"])
    # Where finest cells end follows from elements of the half-space's answer, which are others: within what the mesh makes.
    check.relative("cells", slices["cells"], profile["cells"], 0.03)
    for key in ("normal_force_N", "longitudinal_force_N", "max_pressure_Pa", "wheelset_height_m"):
        check.relative(f"a rail that does not change: {key} beside that of its profile", slices[key], profile[key], 2e-3)
    for key in ("peak_von_mises_Pa", "peak_von_mises_depth_m", "peak_surface_von_mises_Pa", "peak_pressure_Pa", "wheel_peak_von_mises_Pa", "wheel_peak_von_mises_depth_m"):
        check.relative(f"a rail that does not change: {key} beside that of its profile", slices[key], profile[key], 1e-2)
    check.absolute("its lateral force over the normal one", slices["lateral_force_N"] / profile["normal_force_N"],
                   profile["lateral_force_N"] / profile["normal_force_N"], 3e-4)

    # As a list, whose slices count as files that the run has read.
    with open(path("section.txt"), "w", encoding="utf-8") as file:
        file.writelines(f"{y:.9f} {-z:.9f}\n" for y, z in zip(points["y_mm"], points["z_mm"]))
    with open(path("same.slcs"), "w", encoding="utf-8") as file:
        file.write("0 1\n5\n0 0 0\n1\n" + "".join(f"{x} 'section.txt'\n" for x in (-120, -60, 0, 60, 120)))
    listed = run(program, CURVE, path("listed"), [*short, "Rail/Shape=slices", f"Rail/Slices={path('same.slcs')}", "Rail/Slices y (mm)=0", "Rail/Inclination=none"], command="reference")
    check.relative("a list beside the table: largest pressure by half-space theory", listed["max_pressure_Pa"], slices["half_space_patches"][0]["max_pressure_Pa"], 1e-3)
    read = {file["parameter"]: file for file in listed["files"]}
    with open(path("section.txt"), "rb") as file:
        check.that("its slices are among the files, once", list(read)[1:] == ["Rail/Slices", "Rail/Slices: section.txt"] and read["Rail/Slices: section.txt"]["crc32"] == zlib.crc32(file.read()))
    known = input_of(arguments_of(CURVE, [], path("listed"))[0], {"Rail/Slices": path("same.slcs")})["files"]
    check.that("and of what decides about a study's run", {path("same.slcs"), path("same.slcs") + ": section.txt"} <= set(known))

    # One of five that lies too high is said, in the summary too.
    with open(path("same.csv"), encoding="utf-8") as file:
        lines = [line.strip().split(",") for line in file]
    with open(path("high.csv"), "w", encoding="utf-8") as file:
        file.writelines(f"{x},{y},{z if x != '60' else float(z) + 0.05}\n" for x, y, z in lines)
    high = run(program, CURVE, path("high"), [*short, "Rail/Shape=slices", f"Rail/Slices={path('high.csv')}", "Rail/Slices y (mm)=0", "Rail/Inclination=none"], command="reference")
    of_slices = lambda summary: [line for line in summary["warnings"] if "fit the neighbours" in line]
    check.that("a slice that is 50 um too high is named, others are not", len(of_slices(high)) == 1 and "slice at 60 mm" in of_slices(high)[0]
               and "up to 0.05 mm" in of_slices(high)[0] and not of_slices(listed) + of_slices(slices))

    # Wing and nose at rest. Five cells lie over the width of the nose's patch.
    given = {float(row["y_mm"]) > 755.: row for row in rows_of(GIVEN) if (row["s_mm"], row["y_ws_mm"]) == ("160", "3.52")}
    at_rest = ["Rail/Slices place (mm)=160", "Wheelset/Lateral shift (mm)=3.52", "Mesh/Finest cell (mm)=0.19", "Motion/Rolled distance (mm)=0.1", "Output/Write volume=false"]
    on_wing, on_nose = (float(given[of]["y_mm"]) - 750. for of in (True, False))  # from the origin of the slices
    nose = run(program, NOSE, path("nose"), [*at_rest, f"Output/Cells=0,{on_wing},0.5;4.1,{on_nose},0.8"])
    for cell, y, depth in ((1, on_wing, 0.5), (2, on_nose, 0.8)):
        check.absolute(f"cell {cell} that is recorded: y, mm", 1e3 * nose[f"cell_{cell}_y_m"], y, 0.3)  # cells of up to 0.4 mm
        check.absolute(f"cell {cell} that is recorded: depth, mm", 1e3 * nose[f"cell_{cell}_depth_m"], depth, 0.3)
    check.absolute("number of patches", len(nose["patches"]), 2, 0)
    for patch in nose["patches"]:
        row  = given[1e3 * patch["y_m"] > 755.]
        name = "wing" if 1e3 * patch["y_m"] > 755. else "nose"
        check.relative(f"{name}: normal force, N", patch["normal_force_N"], float(row["normal_force_N"]), 0.03)
        check.relative(f"{name}: largest pressure, MPa", 1e-6 * patch["max_pressure_Pa"], float(row["max_pressure_MPa"]), 0.03)
        check.absolute(f"{name}: y, mm", 1e3 * patch["y_m"], float(row["y_mm"]), 0.05)

    # The columns of slices: what is vertical of the nose's patch, and the height of the half-space.
    row = {name: values[-1] for name, values in table(path("nose"), "history.csv").items()}
    on_nose = min(nose["patches"], key=lambda patch: patch["y_m"])
    check.relative("nose: vertical force, N", row["inner_normal_force_N"], on_nose["normal_force_N"] * math.cos(on_nose["angle_rad"]) +
                   on_nose["lateral_force_N"] * math.sin(on_nose["angle_rad"]), 0.005)
    position = {"rail": SLICES, "s_mm": 160, "y_ws_mm": 3.52, "load_N": 10e3, "young_Pa": 209.92e9, "poisson": 0.28, "friction": 0}
    at_load = solve([position], program)[0][0]
    check.absolute("height of the wheelset, mm", 1e3 * row["wheelset_height_m"], float(at_load["height_mm"]), 4e-3)

    # On the way to the nose: forces by piece, height.
    rolled = ["Rail/Slices place (mm)=210", "Motion/Rolled distance (mm)=9", "Mesh/Finest cell (mm)=0.9", "Output/Write volume=false"]
    peaks = ["Peak stress/Region=range", "Peak stress/From (mm)=2", "Peak stress/To (mm)=4", "Peak stress/Depth (mm)=4"]
    way = run(program, PASSAGE, path("way"), [*rolled, *peaks])
    history = table(path("way"), "history.csv")
    inner, all_of_it = history["inner_normal_force_N"], history["normal_force_N"]
    check.that("the wheel begins on the wing", inner[0] == 0.)
    check.that("and comes to the nose", 0.2 * all_of_it[-1] < inner[-1] < all_of_it[-1])
    check.absolute("height of the wheelset at the end, mm", 1e3 * history["wheelset_height_m"][-1], 1e3 * way["wheelset_height_m"], 0.01)
    check.energy("over the nose: ", way, 3e-3)
    # Of the nose alone, which the wheel touches there: the wing lies 60 mm beside it.
    largest = table(path("way"), "peak_stress.csv")
    check.that("largest stresses are those of the nose, layer by layer", max(largest["y_mm"]) < -25. and len(largest["y_mm"]) == 4 and max(np.diff(largest["von_mises_MPa"][2:])) < 0.
               and np.allclose(largest["depth_mm"], [0., 0.45, 1.35, 2.7], atol=0.1))
    on_nose = min(way["patches"], key=lambda patch: patch["y_m"])
    check.relative("its largest pressure, in all steps up to the last one, MPa", 1e-6 * way["peak_pressure_Pa"], 1e-6 * on_nose["max_pressure_Pa"], 0.03)

    # On sleepers it gives way and turns as the load passes, and nothing is lost.
    beam = [*rolled, "Track/Foundation=beam", "Track/Support 0 (mm)=300"]
    bits = [*beam, "Scene/Reproducible=true"]
    soft = run(program, PASSAGE, path("beam"), bits, 2)
    check.energy("over the nose, on a beam: ", soft, 0.01)
    moved = table(path("beam"), "history.csv")
    check.that("of the mass of a co-running track it is said that it makes blows too large, of a beam nothing", ["its mass stands for the track" in " ".join(of["warnings"]) for of in (way, soft)] == [True, False])
    check.that("of what the beam has nothing is unused, across nothing moves", not any("Beam" in line or "Sleeper" in line for line in soft["unused_parameters"])
               and "rail_base_lateral_m" not in moved)
    check.that("the base moves and turns with the load", max(abs(np.array(moved["rail_base_vertical_m"]))) > 1e-6 and max(abs(np.array(moved["rail_base_slope_rad"]))) > 1e-5)
    run_stopped(program, PASSAGE, path("stopped"), bits, len(moved["position_m"]) // 2)
    run(program, PASSAGE, path("stopped"), bits, 1, more=["--resume"])
    check.that("stopped, resumed and on two ranks: the same bytes", open(os.path.join(path("stopped"), "history.csv"), "rb").read() == open(os.path.join(path("beam"), "history.csv"), "rb").read())

    # Without inertia the wheel keeps its load on a wing that sinks by 6 um in a millimetre: a hub that is not carried along loses a quarter of it.
    steady = run(program, PASSAGE, path("steady"), ["Scene/Quasi-static=true", "Scene/Density scale=9", "Track/Foundation=rigid", "Rail/Slices place (mm)=165",
                                                    "Motion/Rolled distance (mm)=6", "Mesh/Finest cell (mm)=0.8", "Output/Write volume=false"])
    check.relative("a wing that sinks: vertical force, N", steady["normal_force_N"], 60e3, 0.01)

    # The way as a table, beside the answers at its places, and the height at which nothing carries yet.
    must_end_well(execute_often([*arguments_of(PASSAGE, ["Rail/Slices place (mm)=239", "Wheelset/Lateral shift (mm)=0.97", "Motion/Start (mm)=-2", "Motion/Rolled distance (mm)=4"],
                                         path("points-along"), "contact-points")], program))
    along = read_table(os.path.join(path("points-along"), "contact_way.csv"), text=("part",))
    places = sorted(set(along["along_mm"]))
    check.that("five places", np.allclose(places, [237, 238, 239, 240, 241]) and np.allclose(along["along_mm"] - along["axle_x_mm"], 239))
    check.that("wing and nose at each", all(sorted(along["part"][along["along_mm"] == place]) == ["nose", "wing"] for place in places))
    load = [{**position, "s_mm": place, "y_ws_mm": 0.97, "load_N": 60e3} for place in places]
    for place, patches in zip(places, solve(load, program)):
        for patch in patches:
            row = {name: values[(along["along_mm"] == place) & (along["part"] == patch["part"])][0] for name, values in along.items()}
            for name, of_answer, factor, limit in (("height_mm", "height_mm", 1., 1e-3), ("patch_x_mm", "x_mm", 1., 0.02), ("patch_y_mm", "y_mm", 1., 0.02), ("patch_z_mm", "z_mm", 1., 0.02),
                                                   ("angle_rad", "angle_rad", 1., 0.003), ("normal_force_N", "normal_force_N", 1e-3, 0.3),
                                                   ("max_pressure_MPa", "max_pressure_Pa", 1e-6, 40.), ("patch_length_mm", "length_mm", 1., 0.5), ("patch_width_mm", "width_mm", 1., 0.3)):
                check.absolute(f"way at {place:.0f} mm, {patch['part']}: {name}", (factor if name.endswith("_N") else 1.) * row[name], factor * float(patch[of_answer]), limit)
            check.relative("its vertical force, N", row["vertical_force_N"], row["normal_force_N"] * math.cos(row["angle_rad"]), 1e-6)
            check.relative("its share", row["load_share"], row["vertical_force_N"] / 60e3, 1e-3)
            check.absolute("its radius, mm: the axle from the patch, up to how deep surfaces overlap", row["rolling_radius_mm"], math.hypot(460. + row["height_mm"] - row["patch_z_mm"], row["patch_x_mm"]), 0.15)
    touching = {**position, "y_ws_mm": 0.97, "s_mm": 239}
    del touching["load_N"]
    at = along["rigid_height_mm"][along["along_mm"] == 239][0]
    just = lambda off: float(solve([{**touching, "height_mm": at + off}], program)[0][0]["normal_force_N"])
    check.that("without load: nothing a micrometre higher, something three lower", just(1e-3) == 0. < just(-3e-3))

    # What is refused, in one line.
    refused = lambda what, scene, settings, words: check.refused(what, program, scene, path("refused"), settings, words)
    refused("slices that end too early", PASSAGE, ["Rail/Slices place (mm)=380"], ["'Rail/Slices' reach from -85.2 to 385.91 mm"])
    refused("peaks where nothing touches", PASSAGE, [*rolled, *peaks, "Peak stress/From (mm)=-100"], ["must lie on the path of the first wheel", "nose from", "wing from"])
    refused("both wheels", PASSAGE, ["Wheelset/Both wheels=true"], ["'Wheelset/Both wheels' must be false"])
    refused("a beam lighter than its cells", PASSAGE, [*beam, "Track/Beam mass (kg per m)=10"], ["'Track/Beam mass (kg per m)' 10 at x = ", "is needed"])
    refused("a beam with a file of supports", PASSAGE, [*beam, "Track/Support file=some.csv"], ["'Track/Support file' must be empty", "all alike"])
    refused("a beam under a foot", "smooth-rolling.prm", ["Track/Foundation=beam", "Rail/Shape=full section", "Scene/Density scale=1", "Solid/Mass damping (1 per s)=0"], ["'Track/Foundation' beam", "'Rail/Shape'"])
    refused("an upright wheel", "smooth-rolling.prm", ["Rail/Shape=slices", f"Rail/Slices={path('same.csv')}"], ["'Rail/Shape' slices", "'Wheelset/Lateral shift (mm)'"])
    check.refused("points over the shift", program, PASSAGE, path("refused"), [], ["--shift-to", "'Rail/Shape' slices"], more=["--shift-to", "5"], command="contact-points")
    refused("a full section", PASSAGE, ["Rail/Shape=full section"], ["'Rail/Slices' need 'Rail/Shape' slices"])
    refused("a wheel that yields", PASSAGE, ["Wheel/Yield stress (MPa)=500"], ["'Wheel/Yield stress (MPa)' must be 0"])
    refused("no file", PASSAGE, ["Rail/Slices="], ["'Rail/Shape' slices needs a file"])
    refused("a measured head", PASSAGE, ["Rail/Measured head=some.csv"], ["'Rail/Slices' take the place of a profile"])
    refused("a file that is not there", PASSAGE, ["Rail/Slices=nowhere.csv"], ["'Rail/Slices'", "nowhere.csv"])
    refused("a gap under the wheel", PASSAGE, ["Wheelset/Lateral shift (mm)=-60", "Rail/Slices place (mm)=60"], ["'Rail/Slices'"])

check.exit()
