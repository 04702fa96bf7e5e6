#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rails from mesh files: a block beside the program's own, in all formats and on cells that lie in any way; a joint; files and parameters that do not fit."""

import csv
import math
import os
import sys
import tempfile

import numpy as np

from tread import rail_mesh
from tread.runs import arguments_of, must_end_well
from loaded_once import execute_often
from tread_runner import Check, run, table

program = sys.argv[1]
check = Check()
BLOCK, JOINT = "verification/half-space-1.3-mu0.30.prm", "joint/insulated-joint.prm"


def lines(begin, end, size):
    """Rows of this size from 0 on; the last one takes up the rest, as the program has it for these lengths."""
    side = lambda length: [size * i for i in range(int(length / size))] + [length]
    return [-x for x in side(-begin)[:0:-1]] + side(end)


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    size = 10.4  # eight cells of 1.3 mm
    x, y, z = lines(-46., 42.6, size), lines(-31.2, 31.2, size), [-x for x in lines(0., 31.2, size)[::-1]]
    block = ["Rail/Block width (mm)=62.4", "Rail/Block height (mm)=31.2", "Rail/Begin (mm)=-46", "Rail/Length (mm)=88.6", "Rail/Margin (mm)=30"]
    short = ["Motion/Rolled distance (mm)=6", "Wheel/Sector thickness (mm)=31.2", "Wheel/Sector width (mm)=62.4", "Wheel/Sector margin (mm)=40",
             "Mesh/Coarsest cell (mm)=11", "Output/Write volume=false"]
    mesh = lambda name: ["Rail/Shape=mesh", f"Rail/Mesh file={path(name)}"]

    # On the same lines it is the program's own block.
    rail_mesh.write(rail_mesh.bar(x, y, z, 300.), path("same.msh"))
    own = run(program, BLOCK, path("own"), [*short, *block])
    same = run(program, BLOCK, path("same"), [*short, *mesh("same.msh")])
    check.absolute("cells", same["cells"], own["cells"], 0)
    for key in ("normal_force_N", "longitudinal_force_N", "max_pressure_Pa", "creepage", "pressure_semi_axis_x_m", "pressure_semi_axis_y_m"):
        check.relative(f"same lines: {key}", same[key], own[key], 5e-4)
    files = {file["parameter"]: file for file in same["files"]}
    check.absolute("bytes of the mesh among the files of the run", files["Rail/Mesh file"]["bytes"], os.path.getsize(path("same.msh")), 0)
    # On cells that lie in any way the contact has other nodes: as far apart as two meshes are.
    rail_mesh.write(rail_mesh.perturbed(x, y, z, 300., 0.15), path("any.inp"))
    with open(path("any.inp"), "a", encoding="utf-8") as file:
        file.write("*STEP\n*STATIC\n*END STEP\n")
    moved = run(program, BLOCK, path("any"), [*short, *mesh("any.inp")])
    check.that("what is passed over is among the warnings", any("'Rail/Mesh file': '" in line and "Passed over: *STEP (line " in line for line in moved["warnings"]))
    check.that("nothing is said of a mesh alone", not any("Rail/Mesh file" in line for line in same["warnings"]))
    for key, allowed in (("normal_force_N", 3e-3), ("longitudinal_force_N", 0.02), ("max_pressure_Pa", 0.01), ("creepage", 2e-3), ("pressure_semi_axis_x_m", 5e-3)):
        check.relative(f"cells that lie in any way: {key}", moved[key], own[key], allowed)

    # Ends are held in `tread modes` as in a run: shear along the path, at c_s / 4h of the bar's height, is a mode of free ends alone.
    shear_wave, height = 3.2e3, 104e-3  # m/s of steel, m
    found = {}
    coarsest = {"Motion/Start (mm)": 0, "Motion/Rolled distance (mm)": 1, "Mesh/Finest cell (mm)": 2.6, "Mesh/Fine half width (mm)": 9.1, "Mesh/Cells per level": 1,
                "Mesh/Level depth (semi-axes)": 0, "Mesh/Coarsest cell (mm)": 22}
    for name, held in (("free", False), ("held", True)):
        rail_mesh.write(rail_mesh.bar(lines(-40., 40., 20.), lines(-20.8, 20.8, 20.8), lines(-1e3 * height, 0., 26.), 300., 0., (held, held)), path(f"{name}.msh"))
        settings = [*short, *(f"{parameter}={value}" for parameter, value in coarsest.items()), *mesh(f"{name}.msh")]
        must_end_well(execute_often([*arguments_of(BLOCK, settings, path(name), "modes"), "--up-to", "10000"], program))
        with open(os.path.join(path(name), "modes.csv"), encoding="utf-8") as stream:
            found[name] = [row for row in csv.DictReader(stream) if row["body"] == "track"]
    along = {name: [float(row["frequency_Hz"]) for row in rows if float(row["longitudinal_share"]) > 0.5] for name, rows in found.items()}
    print("track modes along the path, Hz:", along)
    check.that("free ends: shear along the path", any(0.5 < frequency * 4. * height / shear_wave < 1.1 for frequency in along["free"]))
    check.that("held ends: none", found["held"] and not along["held"])
    # Half of Young's modulus and twice the density for all of the volume: half the frequencies.
    must_end_well(execute_often([*arguments_of(BLOCK, [*short, *(f"{parameter}={value}" for parameter, value in coarsest.items()), *mesh("held.msh"), "Rail/Materials=Rail:105:0.3:15600"],
                                         path("soft"), "modes"), "--up-to", "5000"], program))
    with open(os.path.join(path("soft"), "modes.csv"), encoding="utf-8") as stream:
        soft = [float(row["frequency_Hz"]) for row in csv.DictReader(stream) if row["body"] == "track"]
    held = [float(row["frequency_Hz"]) for row in found["held"]]
    check.that(f"modes of a volume of its own material: {len(soft)} and {len(held)}", len(soft) == len(held) > 0)
    check.below("half the stiffness, twice the mass: frequencies over half of the rail's, less 1", np.abs(2. * np.array(soft) / np.array(held[:len(soft)]) - 1.).max(), 1e-5)

    # A joint: the wheel meets the step with the kink of its path, 47 mrad, and a continuous bar keeps its force.
    coarse = ["Mesh/Finest cell (mm)=2.4", "Mesh/Fine half width (mm)=20", "Motion/Start (mm)=-14", "Motion/Rolled distance (mm)=26", "Output/Write volume=false"]
    joint = run(program, JOINT, path("joint"), coarse)
    history = table(path("joint"), "history.csv")
    largest = max(history["normal_force_N"])
    place = 1e3 * history["position_m"][history["normal_force_N"].index(largest)]
    # A mass of 600 kg on Hertz's spring on a beam without fishplates (contrib/plot/joint-force.py): 286 kN. Bars give way besides, most at the edge.
    check.that(f"blow of {1e-3 * largest:.0f} kN, of 286 by a simple model, and more than six tenths of it", 172e3 < largest < 286e3)
    check.that(f"at {place:.1f} mm, where the step is met", -20. < place < 5.)
    check.below("energy residual over what is dissipated", joint["energy_residual_of_dissipated"], 0.01)
    continuous = run(program, JOINT, path("continuous"), [*coarse, "Rail/Mesh file=continuous.msh", "Track/Beam file="])
    forces = table(path("continuous"), "history.csv")["normal_force_N"]
    check.below("ripple of the force on a bar without a joint", (max(forces) - min(forces)) / sum(forces) * len(forces), 0.02)

    # An end post in the gap: of steel it is the rail, of nylon it is softer.
    half, gap, across, down = [-98., -84., -70., -56., -42., -28., -16., -3.], [3., 16., 28., 42., 56., 70.], lines(-35., 35., 14.), rail_mesh.even_lines(-60., 0., 14.)
    rail_mesh.write(rail_mesh.with_volume(rail_mesh.bar(half + gap, across, down, 300.), "end post", -3., 3.), path("post.k"))
    over = ["Mesh/Finest cell (mm)=2.4", "Mesh/Fine half width (mm)=20", "Motion/Start (mm)=-4", "Motion/Rolled distance (mm)=8", "Output/Write volume=false", "Track/Beam file="]
    post = {}
    for name, material in (("rail", "210:0.3:7800"), ("nylon", "3:0.35:1900")):
        run(program, JOINT, path(f"post-{name}"), [*over, *mesh("post.k"), f"Rail/Materials=End post:{material}"])
        post[name] = table(path(f"post-{name}"), "history.csv")["normal_force_N"]
    with open(path("post.k"), encoding="utf-8") as file:
        text = file.read()
    with open(path("one.k"), "w", encoding="utf-8") as file:
        file.write(text.replace(f"{2:10d}{2:10d}{2:10d}", f"{2:10d}{2:10d}{1:10d}"))
    run(program, JOINT, path("one"), [*over, *mesh("one.k")])
    one = np.array(table(path("one"), "history.csv")["normal_force_N"])
    check.below("an end post of the rail's steel is the rail: force, difference", np.abs(np.array(post["rail"]) / one - 1.).max(), 1e-6)
    check.that("of nylon the force changes, by less than half", 0.01 < np.abs(np.array(post["nylon"]) / one - 1.).max() < 0.5)

    # What is refused, and what is said to have no effect.
    def refusal(scene, settings):
        return execute_often([*arguments_of(scene, settings, path("refused")), "--dry-run"], program).stderr.strip().splitlines()

    with open(path("same.msh"), encoding="utf-8") as file:
        text = file.read()
    rail_mesh.write(rail_mesh.bar(x, lines(-2., 2., 2.), z, 300.), path("narrow.k"))
    rail_mesh.write(rail_mesh.bar(x, [value + 40. for value in y], z, 300.), path("beside.msh"))
    rail_mesh.write(rail_mesh.bar(x, y, z, 300.), path("tied.inp"))
    with open(path("tied.inp"), "a", encoding="utf-8") as file:
        file.write("*TIE, NAME=joint\nfoot, head\n")
    # A slice between two planes of symmetry: the line contact of Hertz, alike up to the planes.
    line_contact = ["Motion/Passages=1", "Rail/Yield stress (MPa)=0", "Damage/Shear strength (MPa)=250"]
    whole = run(program, "damage/line-contact.prm", path("slice"), [*line_contact, "Motion/Rolled distance (mm)=30"])
    patch = {key: np.array(values) for key, values in table(path("slice"), "patch_averaged.csv").items()}
    load = whole["normal_force_N"] / 5.2e-3  # N/m
    half_width = math.sqrt(8. * load * 0.46 * (1. - 0.3**2) / (math.pi * 210e9))
    peak = 1e-6 * 2. * load / (math.pi * half_width)
    check.relative("line contact: largest pressure, MPa", patch["pressure_MPa"].max(), peak, 0.01)
    for key, wanted in (("max_pressure_Pa", 1e6 * peak), ("semi_axis_x_m", half_width), ("patch_area_m2", 2. * half_width * 5.2e-3)):
        check.relative(f"what stands beside it: {key}", whole["reference"][key]["Hertz"]["value"], wanted, 1e-6)
    check.that("and no ellipse's semi-axis across", "semi_axis_y_m" not in whole["reference"])
    check.relative("surface fatigue index", whole["surface_fatigue_index"], whole["friction_used"] - 250e6 / whole["max_pressure_Pa"], 1e-6)
    line = np.round(patch["y_mm"], 1)
    check.that("it reaches both planes", list(np.unique(line)) == [-2.6, -1.3, 0., 1.3, 2.6])
    largest = np.array([patch["pressure_MPa"][line == y].max() for y in np.unique(line)])
    # Both bodies are held on the planes: a wheel with free sides has 4 %.
    check.below("and is alike across: largest pressures of all lines, over their mean", np.ptp(largest) / largest.mean(), 1e-6)
    check.below("nodes stay on the planes, mm", np.abs(np.abs(patch["y_mm"][np.abs(line) == 2.6]) - 2.6).max(), 5e-4)
    one, three = (run(program, "damage/line-contact.prm", path(f"slice-{ranks}"), [*line_contact, "Motion/Rolled distance (mm)=6"], ranks) for ranks in (1, 3))
    for key in ("normal_force_N", "max_pressure_Pa", "patch_area_m2"):
        check.relative(f"on three ranks: {key}", three[key], one[key], 1e-6)

    faults = (
        ([*mesh("tied.inp")], "*TIE is not read: pieces hang together by common nodes only"),
        ([*mesh("same.msh"), "Rail/Mesh unit=m"], "where rails have"),
        ([*mesh("narrow.k")], "wide on its running surface, where rails have 5 to 1000"),
        ([*mesh("beside.msh")], "has no contact surface about y = 0 at x = -6 mm"),
        ([*mesh("none.msh")], "'Rail/Mesh file': "),
        ([*mesh("post.k")], "gives the material '2' to hexahedra of 'end post', and line"),
        ([*mesh("post.k"), "Rail/Materials=rubber:1:0.4:1200"], "has no hexahedra in a volume 'rubber', to which 'Rail/Materials' gives a material; it has 'rail', 'end post'"),
        ([*mesh("post.k"), "Rail/Materials=end post:1"], "'Rail/Materials' cannot be 'end post:1'; allowed: name of the volume"),
        (["Rail/Shape=mesh"], "'Rail/Shape' mesh needs a file: 'Rail/Mesh file'"),
        ([f"Rail/Mesh file={path('same.msh')}"], "'Rail/Mesh file' needs 'Rail/Shape' mesh"),
        ([*mesh("same.msh"), "Motion/Start (mm)=-6", "Motion/Rolled distance (mm)=60"], "has a contact surface for x from -46 to 42.6 mm"),
        ([*mesh("same.msh"), "Defect/Shape=dip", "Defect/Length (mm)=10", "Defect/Depth (mm)=0.1"], "'Defect/Shape' dip is laid on a rail of the program's own"),
        ([*mesh("same.msh"), "Track/Foundation=one-layer", "Scene/Density scale=1", "Solid/Mass damping (1 per s)=0"], "must be rigid, co-running or beam"),
        ([*mesh("same.msh"), "Wheelset/Lateral shift (mm)=0"], "'Rail/Shape' mesh is for an upright wheel"),
        ([*mesh("same.msh"), "Rail/Inclination=1:40"], "'Rail/Mesh file' takes the place of a profile"),
    )
    for settings, words in faults:
        said = refusal(BLOCK, [*short, *settings])
        check.that(f"refused: {said[-1] if said else ''}", any(words in line for line in said) and len([line for line in said if not line.startswith('WARNING')]) == 1)
    for name, across, crown in (("wide.msh", lines(-5.2, 5.2, 5.2), 0.), ("crowned.msh", lines(-2.6, 2.6, 2.6), 300.), ("aside.msh", [-2.6, 0., 2.6, 5.2], 0.)):
        rail_mesh.write(rail_mesh.bar(rail_mesh.even_lines(-166.4, 166.4, 5.2), across, rail_mesh.even_lines(-62.4, 0., 5.2), crown, 0., (True, True), True), path(name))
    for settings, words in (([], "between which the wheel must fit: 'Wheel/Shape' sector with 'Sector width (mm)' 10.4"), (["Wheel/Sector width (mm)=12"], "between which the wheel must fit"),
                            (["Wheel/Sector width (mm)=10.4", "Wheel/Lateral position (mm)=2"], "'Wheel/Lateral position (mm)' must be 0"), (["Wheel/Shape=full"], "between which the wheel must fit"), (["Wheel/Sector width (mm)=10.4", "Mesh/Finest cell (mm)=5.2"], "of semi-axes 5.3"),
                            ([f"Rail/Mesh file={path('crowned.msh')}"], "must be level across"), ([f"Rail/Mesh file={path('aside.msh')}"], "at y = -2.6 to 5.2 mm, between which")):
        said = refusal("damage/line-contact.prm", [f"Rail/Mesh file={path('wide.msh')}", *settings])  # of each name the last one counts
        check.that(f"a slice is refused: {said[-1] if said else ''}", any(words in line for line in said))
    said = refusal("damage/line-contact.prm", [f"Rail/Mesh file={path('wide.msh')}", "Wheel/Sector width (mm)=10.4", "Track/Foundation=beam"])
    check.that(f"a slice on a beam is refused: {said[-1] if said else ''}", any("needs a rail of some width" in line for line in said))
    said = refusal(JOINT, [*coarse, "Mesh/Fine half width (mm)=12", *mesh("held.msh")])
    check.that(f"ends that a beam would turn are refused: {said[-1] if said else ''}", any("faces named 'end' in 'Rail/Mesh file' would hold them upright" in line for line in said))
    for settings, words in ((["Motion/Start (mm)=-4"], "where a wheel begins: move 'Motion/Start (mm)' away from the gap"),
                            (["Scene/Quasi-static=true", "Scene/Density scale=4"], "a 'Rail/Mesh file' whose running surface changes along the path by a gap")):
        said = refusal(JOINT, [*coarse, *settings])
        check.that(f"refused: {said[-1] if said else ''}", any(words in line for line in said))
    warnings = must_end_well(execute_often([*arguments_of(BLOCK, [*short, *mesh("same.msh"), "Rail/Begin (mm)=-46", "Rail/Profile=60E1"], path("warned")), "--dry-run"], program))
    rail_mesh.write(rail_mesh.bar(lines(-46., 42.6, 26.), lines(-31.2, 31.2, 7.8), z, 300.), path("long.msh"))
    long = must_end_well(execute_often([*arguments_of(BLOCK, [*short, *mesh("long.msh")], path("warned")), "--dry-run"], program))
    check.that("long cells are warned of", "cells at the running surface under the path have edges unlike the mean one" in long.stdout + long.stderr)
    for name in ("Rail/Block width (mm)", "Rail/Begin (mm)", "Rail/Margin (mm)", "Rail/Profile"):
        check.that(f"said to have no effect: {name}", f"'{name}' has no effect" in warnings.stdout + warnings.stderr)

check.exit()
