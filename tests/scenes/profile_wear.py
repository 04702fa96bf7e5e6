#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Profiles that wear: areas against the law, states against tread reference on them, weights, resuming, input that is wrong, pictures."""

import os
import signal
import subprocess
import sys
import tempfile
import time

import numpy as np

import tread
from tread.files import read_summary, read_table
from tread.runs import arguments_of, command, environment, execute
from tread_runner import Check, execute_often, run

program = sys.argv[1]
check = Check()
SCENE = "damage/profile-wear.prm"
SHORT = {"Profile wear/Passages": 2000, "Profile wear/Wheel turns": 3000, "Profile wear/States": 2, "Damage/Wear coefficient": 1e-3}
HEAD = "weight,shift_mm,yaw_mrad,load_kN,creepage\n"
ROWS = ["2,1.2,0.5,105,0.0006\n", "1,5.8,2,95,-0.0004\n"]


def area(y, z, y_new, z_new):
    """Between two lines, by the trapezoidal rule along them: positive where the new one lies to the right of the way."""
    y_all, z_all = np.concatenate([y, y_new[::-1]]), np.concatenate([z, z_new[::-1]])
    return 0.5 * np.sum(y_all * np.roll(z_all, -1) - np.roll(y_all, -1) * z_all)


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    def contacts(name, rows, head=HEAD):
        with open(path(name), "w", encoding="utf-8") as stream:
            stream.write(head + "".join(rows))
        return path(name)

    usual = contacts("contacts.csv", ROWS)
    settings = [f"{name}={value}" for name, value in SHORT.items()]
    summary = run(program, SCENE, path("wear"), settings, command="wear", table=usual)

    # By Coulomb's and Archard's laws what slips loses coefficient over hardness times work over friction.
    for body, passages in (("rail", 2000), ("wheel", 3000)):
        lost = summary[f"{body}_wear_area_by_law_m2"]
        check.relative(f"{body}: area by the law over that by the work", lost, 1e-3 / 2800e6 / 0.3 * summary[f"{body}_friction_work_J_per_m"], 1e-3)
        check.relative(f"{body}: area between the profiles over that by the law", summary[f"{body}_wear_area_m2"], lost, 1e-3)
        points = read_table(os.path.join(path("wear"), f"{body}_wear.csv"))
        last = points["state_number"] == 2
        y, z, now_y, now_z = (points[name][last] for name in ("y_start_mm", "z_start_mm", "y_mm", "z_mm"))
        check.relative(f"{body}: area of the table's points", abs(area(y, z, now_y, now_z)), 1e6 * lost, 1e-3)
        check.that(f"{body} loses, and does not grow", (area(y, z, now_y, now_z) < 0) == (body == "rail"))
        check.below(f"{body}: depths are distances, mm", np.abs(np.hypot(now_y - y, now_z - z) - points["depth_mm"][last]).max(), 1e-6)
        check.relative(f"{body}: largest depth", 1e-3 * points["depth_mm"].max(), summary[f"{body}_wear_depth_m"], 1e-6)
        lengths = np.hypot(np.diff(now_y), np.diff(now_z)) * 1e-3
        share = 0.5 * (np.append(lengths, 0) + np.insert(lengths, 0, 0))
        check.relative(f"{body}: work over the profile, J/m", (points["friction_work_J_per_m2"][last] * share).sum(), summary[f"{body}_friction_work_J_per_m"], 1e-6)
        count = points["passages" if body == "rail" else "wheel_turns"]
        check.that(f"{body}: its states", sorted(set(count)) == [0, passages / 2, passages])
        profile = np.loadtxt(os.path.join(path("wear"), f"worn_{body}_2.csv"), delimiter=",", skiprows=1)
        check.below(f"{body}: its file, mm", np.abs(profile - np.column_stack([now_y, now_z])).max(), 1e-6)
    check.that("what the summary counts", summary["rail_passages"] == 2000 and summary["wheel_turns"] == 3000 and summary["contacts"] == len(ROWS))
    steps = read_table(os.path.join(path("wear"), "wear_steps.csv"))
    check.that("steps go up to the end", steps["passages"][0] == 0 and steps["passages"][-1] == 2000 and steps["wheel_turns"][-1] == 3000 and np.all(np.diff(steps["passages"]) > 0))
    check.that("a step changes the pressure by what is allowed", steps["change"].max() <= 0.1 and steps["change"].max() > 0.01 and summary["wear_steps"] == len(steps["change"]) - 1)
    for name, key in (("rail_depth_mm", "rail_wear_depth_m"), ("wheel_depth_mm", "wheel_wear_depth_m")):
        check.relative(f"{name} at the end", 1e-3 * steps[name][-1], summary[key], 1e-6)
    for name, key in (("rail_area_mm2", "rail_wear_area_m2"), ("wheel_area_mm2", "wheel_wear_area_m2")):
        check.relative(f"{name} at the end", 1e-6 * steps[name][-1], summary[key], 1e-6)
    check.relative("work of all passages by those of the steps", np.trapz(steps["friction_work_J_per_m"], steps["passages"]), summary["rail_friction_work_J_per_m"], 0.01)

    # What a state says of its contacts is what a scene on its profiles says.
    patches = read_table(os.path.join(path("wear"), "wear_patches.csv"))
    for state, scene in ((0, SCENE), (2, os.path.join(path("wear"), "worn_2.prm"))):
        loss = 0.
        for number, row in enumerate(ROWS, 1):
            weight, shift, yaw, load, _ = row.strip().split(",")
            own = np.flatnonzero((patches["state_number"] == state) & (patches["contact"] == number))
            single = path(f"single-{state}-{number}")
            alone = run(program, scene, single, [f"Wheelset/Lateral shift (mm)={shift}", f"Wheelset/Yaw (mrad)={yaw}", f"Vehicle/Wheel load (kN)={load}", "Motion/Creepage=predicted",
                                                 f"Motion/Angular velocity (rad per s)={patches['angular_velocity_rad_per_s'][own[0]]:.9g}", "Damage/Wear coefficient=1e-3", "Damage/Record=true"],
                        command="reference")
            check.that(f"state {state}, contact {number}: patches", len(own) == len(alone["patches"]))
            worn = 0.
            for k, patch in zip(own, alone["patches"]):
                check.absolute(f"state {state}, contact {number}: creepage", 1e3 * patches["creepage"][k], 1e3 * patch["creepage"], 0.01)
                name = f"state {state}, contact {number}, patch {patches['patch'][k]:.0f}: "
                # Profiles between points are other splines, and the table has nine digits.
                for column, key, factor, limit in (("normal_force_N", "normal_force_N", 1, 5e-3), ("max_pressure_MPa", "max_pressure_Pa", 1e6, 5e-3), ("patch_width_mm", "width_m", 1e3, 0.03),
                                                   ("patch_length_mm", "length_m", 1e3, 0.03), ("longitudinal_force_N", "longitudinal_force_N", 1, 0.01),
                                                   ("lateral_force_N", "lateral_force_N", 1, 0.01)):
                    wanted = patch[key] / factor if column == "max_pressure_MPa" else patch[key] * factor
                    check.relative(name + column, patches[column][k], wanted, limit)
                check.absolute(name + "rail_y_mm", patches["rail_y_mm"][k], 1e3 * patch["y_in_rail_m"] if "y_in_rail_m" in patch else patches["rail_y_mm"][k], 0.5)
            damage = read_table(os.path.join(single, "rail_surface_damage.csv"))
            check.relative(f"state {state}, contact {number}: area that a passage takes", patches["rail_area_mm2"][own].sum(), 1e6 * (damage["wear_depth_m"] * damage["area_m2"]).sum(), 0.01)
            check.relative(f"state {state}, contact {number}: work of a passage is T-gamma", patches["friction_work_J_per_m"][own].sum(), alone["t_gamma_N"], 0.01)
            loss += float(weight) / 3 * (damage["friction_work_J_per_m2"] * damage["area_m2"]).sum()
        check.relative(f"state {state}: mean work of a passage, J/m", steps["friction_work_J_per_m"][0 if state == 0 else -1], loss, 0.01)
    check.relative("largest pressure at the end", summary["max_pressure_Pa"], 1e6 * patches["max_pressure_MPa"][patches["state_number"] == 2].max(), 1e-6)
    check.relative("and at the start", summary["max_pressure_at_start_Pa"], 1e6 * patches["max_pressure_MPa"][patches["state_number"] == 0].max(), 1e-6)
    check.that("worn profiles press less", summary["max_pressure_Pa"] < summary["max_pressure_at_start_Pa"])

    # A contact of weight 2 is two of weight 1.
    quick = ["Profile wear/Passages=200", "Profile wear/States=1", "Damage/Wear coefficient=1e-3"]
    split = contacts("split.csv", ["1" + ROWS[0][1:], *ROWS[1:], "1" + ROWS[0][1:]])
    for name, table in (("heavy", usual), ("split", split)):
        run(program, SCENE, path(name), quick, command="wear", table=table)
    depths = [read_table(os.path.join(path(name), "rail_wear.csv"))["depth_mm"] for name in ("heavy", "split")]
    check.below("a contact in two halves, relative", np.abs(depths[0] - depths[1]).max() / depths[0].max(), 1e-6)
    kept = read_table(os.path.join(path("heavy"), "wheel_wear.csv"))
    check.that("a wheel without turns keeps its profile", kept["depth_mm"].max() == 0)

    # Killed after some steps, and interrupted: the rest leaves the same bytes.
    tables = ("rail_wear.csv", "wheel_wear.csv", "wear_patches.csv", "wear_steps.csv", *(f"worn{body}_{state}" for state in (1, 2) for body in ("_rail", "_wheel")))
    tables = [name + ".csv" if name.startswith("worn") else name for name in tables]
    for number, (name, exit_code) in ((signal.SIGKILL, ("killed", -9)), (signal.SIGINT, ("interrupted", 130))):
        process = subprocess.Popen(command(arguments_of(SCENE, settings, path(name), "wear", usual), 1, program), env=environment(), stdout=subprocess.DEVNULL)
        # The one that is killed between two states that are kept.
        grown = lambda: os.path.exists(os.path.join(path(name), "wear_steps.csv")) and read_table(os.path.join(path(name), "wear_steps.csv"))["passages"].max() > (1000 if name == "killed" else 0)
        while process.poll() is None and not grown():
            time.sleep(0.02)
        process.send_signal(number)
        check.that(f"{name}: exit code", process.wait(timeout=60) == exit_code)
        check.that(f"{name}: no summary", not os.path.exists(os.path.join(path(name), "summary.json")))
        if name == "killed":
            for what, other, more in (("other contacts", split, []), ("another scene", usual, ["-s", "Profile wear/Largest change=0.2"])):
                said = execute_often([*arguments_of(SCENE, settings, path(name), "wear", other), "--resume", *more], program)
                check.that(f"--resume with {what}: one line", said.returncode == 1 and said.stderr.count("\n") == 1 and "of another scene, other contacts" in said.stderr)
        run(program, SCENE, path(name), settings, more=["--resume"], command="wear", table=usual)
        check.that(f"{name} and resumed: the same bytes", all(open(os.path.join(path(name), table), "rb").read() == open(os.path.join(path("wear"), table), "rb").read() for table in tables))
    with open(os.path.join(path("killed"), "wear.checkpoint"), "r+b") as stream:
        stream.seek(5000)
        stream.write(b"\0\1\2\3")
    said = execute_often([*arguments_of(SCENE, settings, path("killed"), "wear", usual), "--resume"], program)
    check.that("a damaged checkpoint: one line", said.returncode == 1 and said.stderr.count("\n") == 1 and "damaged" in said.stderr)
    run(program, SCENE, path("killed"), quick, more=["--overwrite"], command="wear", table=usual)
    check.that("a new run leaves nothing of the old one", not os.path.exists(os.path.join(path("killed"), "worn_2.prm")))

    # A scene on worn profiles does not write over them, and turns as the one before.
    said = execute_often(["wear", os.path.join(path("wear"), "worn_1.prm"), usual, "--overwrite", "--output", path("wear")], program)
    check.that("nor with --overwrite", said.returncode == 1 and "lies in the folder of the results" in said.stderr and os.path.exists(os.path.join(path("wear"), "worn_rail_1.csv")))
    turns = run(program, os.path.join(path("wear"), "worn_2.prm"), path("turns"), command="reference")
    check.relative("a worn scene turns as fast", turns["angular_velocity_rad_per_s"], 80 / 3.6 / 0.46, 1e-9)

    # Pictures, from Python.
    pictures = tread.Run(path("wear")).pictures()
    check.that("pictures", [os.path.basename(picture) for picture in pictures] == ["wear.png", "wear-steps.png"])

    # What is wrong is said in a line.
    for what, rows, more, words in (
            ("a column that means nothing", contacts("1.csv", ["1,2\n"], "weight,shft_mm\n"), [], "'shft_mm', which means nothing"),
            ("a shift that no wheelset has", contacts("2.csv", ["1,200\n"], "weight,shift_mm\n"), [], "row 1: shift_mm is 200"),
            ("a weight of 0", contacts("3.csv", ["0,1\n"], "weight,shift_mm\n"), [], "weight is 0"),
            ("a load below 0", contacts("4.csv", ["-5\n"], "load_kN\n"), [], "load_kN is -5"),
            ("friction beside a law of it", contacts("8.csv", ["0.2\n"], "friction\n"), ["-s", "Contact/Friction law=linear"], "has the column friction"),
            ("a roll that is found", contacts("9.csv", ["1\n"], "roll_mrad\n"), ["-s", "Wheelset/Both wheels=true"], "has the column roll_mrad"),
            ("no rows", contacts("5.csv", []), [], "has no rows"),
            ("no such table", path("none.csv"), [], "tread wear: cannot read"),
            ("no law", usual, ["-s", "Damage/Wear law=none"], "'Damage/Wear law' must not be none"),
            ("a hardness below 0", usual, ["-s", "Damage/Hardness (MPa)=-1"], "Hardness"),
            ("nothing that wears", usual, ["-s", "Profile wear/Passages=0", "-s", "Profile wear/Wheel turns=0"], "neither the rail nor the wheel"),
            ("no work", usual, ["-s", "Contact/Friction coefficient=0", "-s", "Damage/Wear law=friction work"], "nothing wears"),
            ("smoothing between the points", usual, ["-s", "Profile wear/Smoothing length (mm)=0.3"], "too short for"),
            ("an upright wheel", usual, ["-s", "Wheelset/Lateral shift (mm)=none"], "tread wear"),
            ("two things at once", usual, ["--dry-run", "--resume"], "--resume"),
            ("a wheel that derails", contacts("7.csv", ["90\n"], "shift_mm\n"), [], "the wheelset's other wheel"),
            ("a map with a gap", usual, ["-s", "Damage/Wear law=Archard map", "-s", "Damage/Map slip speeds (m per s)=0.2", "-s", "Damage/Map wear coefficients=1e-4"], "has 1 numbers; 2 ranges")):
        said = execute_often([*arguments_of(SCENE, [], path("wrong"), "wear", rows), *more], program)
        check.that(f"{what}: one line", said.returncode in (1, 2) and said.stderr.count("\n") == 1 and words in said.stderr)
        if words not in said.stderr:
            print(said.returncode, said.stderr)
    said = execute_often([*arguments_of(SCENE, [], path("nowhere"), "wear", usual), "--resume"], program)
    check.that("nothing to go on from: one line", said.returncode == 1 and "--resume: there is no" in said.stderr)
    said = execute(arguments_of(SCENE, [], path("wrong"), "wear", usual), ranks=2, program=program)
    check.that("two ranks: one line", said.returncode == 1 and "start it on one rank" in said.stderr)

check.exit()
