# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is written twice: run.h5 beside the tables, the screen beside the summary; and what a run says of itself."""

from __future__ import annotations

import os
import re
import zlib

import numpy as np

from .engine import Expect, Runs, compared, compared_each

WITH_HDF5 = ("straight", "plastic", "track", "curve")


@compared_each(*WITH_HDF5)
def hdf5(runs: Runs, expect: Expect, run: str) -> None:
    data = runs.of(run, "run.h5")
    groups = {name.partition("/")[0] for name in data.names()}
    tables = {re.sub("[.]csv$", "", file) for of_run, file, _ in runs.values if of_run == run and file.endswith(".csv")}
    expect.same("a group for each table", groups, tables)
    for name in data.names():
        group, _, column = name.partition("/")
        table = runs.values[(run, group + ".csv", column)]
        if column == "state":
            expect.near(name, data[name], np.where(table == "slip", 2, 1))
        else:
            expect.near(name, data[name], table, relative=1e-12)


@compared_each(*WITH_HDF5)
def units_and_meanings(runs: Runs, expect: Expect, run: str) -> None:
    """The attributes of the columns of run.h5."""
    import h5py

    with h5py.File(os.path.join(runs.folders[run], "run.h5"), "r") as data:
        for group in data.values():
            if isinstance(group, h5py.Group):
                for name, dataset in group.items():
                    unit = dataset.attrs.get("unit", "")
                    spelt = unit.decode() if isinstance(unit, bytes) else unit
                    expect.that(f"{group.name}/{name}: unit '{spelt}'", name.endswith("_" + spelt) if spelt else True)
                    expect.that(f"{group.name}/{name}: meaning", len(dataset.attrs.get("meaning", "")) >= 5)


@compared_each(*WITH_HDF5)
def checksum_of_the_history(runs: Runs, expect: Expect, run: str) -> None:
    if run not in runs.checksums:
        with open(os.path.join(runs.folders[run], "history.csv"), "rb") as stream:
            runs.checksums[run] = zlib.crc32(stream.read())
    expect.near("CRC-32", runs.of(run)["history_crc32"], runs.checksums[run])


@compared_each(*WITH_HDF5, "half", "half_curve")
def wall_times(runs: Runs, expect: Expect, run: str) -> None:
    """Beside the time that the process took, which starts earlier and ends later."""
    summary, seconds = runs.of(run), runs.seconds[run]
    whole = summary["wall_s"]
    expect.that("the whole", 0.05 * seconds < whole <= seconds)
    if "wall_s_start" in summary:
        parts = [summary[f"wall_s_{name}"] for name in ("internal_forces", "contact", "communication", "nodes")]
        expect.that("parts", all(part >= 0 for part in parts) and max(parts) + 0. <= whole and summary["wall_s_start"] <= whole and summary["wall_s_start"] >= 0)
        expect.near("updates in a second", summary["element_updates_per_s"], summary["element_updates"] / parts[0], relative=1e-6)


@compared_each(*WITH_HDF5, "half", "half_curve", "half_two")
def files_that_were_read(runs: Runs, expect: Expect, run: str) -> None:
    """The scene's own text and the profiles that its parameters name, beside it."""
    summary, parameters = runs.of(run), runs.parameters[run]
    named = [name for name in ("Wheel/Tread profile", "Rail/Measured head") if parameters[name].endswith(".txt")]
    count = len({name.split("/")[1] for name in summary.names() if name.startswith("files/")})
    expect.same("parameters", [summary[f"files/{number + 1}/parameter"] for number in range(count)], ["parameter file", *named])
    scene = summary["files/1/path"]
    for number in range(count):
        path = summary[f"files/{number + 1}/path"]
        if number:
            expect.same("path", os.path.realpath(path), os.path.realpath(os.path.join(os.path.dirname(scene), parameters[named[number - 1]])))
        if path not in runs.contents:
            with open(path, "rb") as stream:
                runs.contents[path] = stream.read()
        expect.near("bytes", summary[f"files/{number + 1}/bytes"], len(runs.contents[path]))
        expect.near("CRC-32", summary[f"files/{number + 1}/crc32"], zlib.crc32(runs.contents[path]))


@compared_each("straight", "half")
def version(runs: Runs, expect: Expect, run: str) -> None:
    expect.same("as --version has it", "tread " + runs.of(run)["version"], runs.version)


@compared
def size(runs: Runs, expect: Expect) -> None:
    """A cell has some hundreds of bytes with its share of the nodes, and about as many nodes as cells."""
    for run in WITH_HDF5:
        summary = runs.of(run)
        expect.that("bytes", 200 < summary["cells_and_nodes_bytes"] / summary["cells"] < 2000)
        expect.that("unknowns", 2.2 < summary["unknowns"] / summary["cells"] < 4.2)


TABLE = (("maximum pressure, MPa", "max_pressure_Pa", 1e-6), ("patch area, mm2", "patch_area_m2", 1e6), ("semi-axis a, mm", "semi_axis_x_m", 1e3),
         ("semi-axis b, mm", "semi_axis_y_m", 1e3), ("a by moments of pressure, mm", "pressure_semi_axis_x_m", 1e3),
         ("b by moments of pressure, mm", "pressure_semi_axis_y_m", 1e3), ("creepage, per mille", "creepage", 1e3), ("adhesion share, %", "adhesion_share", 100.),
         ("maximum shear stress, MPa", "max_shear_Pa", 1e-6), ("maximum micro-slip, m/s", "max_slip_m_per_s", 1.), ("frictional power, W", "frictional_power_W", 1.),
         ("lateral over normal force", "lateral_coefficient", 1.), ("traction coefficient", "traction_coefficient", 1.),
         ("counted from free rolling at", "free_rolling_creepage", 1e3), ("von Mises maximum, wheel, MPa", "wheel_max_von_mises_Pa", 1e-6),
         ("von Mises maximum, rail, MPa", "rail_max_von_mises_Pa", 1e-6), ("its depth, wheel, mm", "wheel_max_von_mises_depth_m", 1e3),
         ("its depth, rail, mm", "rail_max_von_mises_depth_m", 1e3), ("vertical force, kN", "normal_force_N", 1e-3),
         ("longitudinal force, kN", "longitudinal_force_N", 1e-3), ("lateral force in the track, kN", "lateral_force_N", 1e-3))


@compared_each("straight", "half", "plastic", "curve")
def table_on_the_screen(runs: Runs, expect: Expect, run: str) -> None:
    """Each line has the computed value, and by each source its value, uncertainty and difference."""
    screen, summary = runs.of(run, "screen"), runs.of(run)
    lines = {name.rpartition(" ")[0] for name in screen.names()}
    for label, key, factor in TABLE:
        found = [words for words in lines if words.startswith(label + " #")]
        if not found or key not in summary:
            continue
        numbers: list[float] = []
        numbers.append(factor * summary[key])
        for source in ("Hertz", "half-space"):
            path = f"reference/{key}/{source}"
            if path + "/value" in summary:
                numbers.append(factor * summary[path + "/value"])
                if path + "/uncertainty" in summary:
                    numbers.append(factor * summary[path + "/uncertainty"])
                if path + "/relative_difference" in summary and summary[path + "/relative_difference"] is not None:
                    numbers.append(100. * summary[path + "/relative_difference"])
        count = {words: sum(name.rpartition(" ")[0] == words for name in screen.names()) for words in found}
        found = [words for words in found if count[words] == len(numbers)]  # by patch there are such lines too
        if run == "curve" and not found:
            continue
        expect.that(f"one line '{label}' with {len(numbers)} numbers", len(found) == 1)
        words = found[0]
        for place, value in enumerate(numbers):
            # The difference of a load that is carried is shown as 0.00.
            allowed = 0.005 if label == "vertical force, kN" and abs(value) < 0.005 else rounding(value, place == 0)
            expect.near(f"{label} {place + 1}", screen[f"{words} {place + 1}"], value, absolute=allowed)


def rounding(value: float, exact: bool) -> float:
    """Five digits; differences have two behind the point, uncertainties two digits."""
    if exact:
        return 6e-5 * abs(value)
    return max(1e-4 * abs(value), min(0.0051, 0.9 * abs(value))) if abs(value) < 0.5 or abs(value) > 9.9 else 0.051 * min(1., abs(value))


PATCH_TABLE = (("normal force, kN", "normal_force_N", 1e-3), ("longitudinal force, kN", "longitudinal_force_N", 1e-3), ("lateral force, kN", "lateral_force_N", 1e-3),
               ("spin moment, N m", "spin_moment_Nm", 1.), ("x from the axle, mm", "x_m", 1e3), ("y in the track, mm", "y_m", 1e3),
               ("y from the rail's middle, mm", "y_rail_m", 1e3), ("contact angle, degrees", "angle_rad", 180 / np.pi), ("rolling radius, mm", "rolling_radius_m", 1e3),
               ("creepage, per mille", "creepage", 1e3), ("lateral creepage, per mille", "lateral_creepage", 1e3), ("spin, per m", "spin_per_m", 1.),
               ("maximum pressure, MPa", "max_pressure_Pa", 1e-6), ("area, mm2", "area_m2", 1e6), ("length along x, mm", "length_m", 1e3), ("width across, mm", "width_m", 1e3),
               ("adhesion share, %", "adhesion_share", 100.), ("maximum shear stress, MPa", "max_shear_Pa", 1e-6), ("maximum micro-slip, m/s", "max_slip_m_per_s", 1.),
               ("frictional power, W", "frictional_power_W", 1.), ("undeformed overlap, um", "overlap_m", 1e6), ("sinks under other patches, um", "sink_by_others_m", 1e6), ("the normal turns by, degrees", "normal_turns_rad", 180 / np.pi))


@compared_each("curve", "half_curve", "half_two")
def patches_on_the_screen(runs: Runs, expect: Expect, run: str) -> None:
    """A column for each patch, and in a run of finite elements the half-space's beside it with the difference."""
    screen, summary = runs.of(run, "screen"), runs.of(run)
    lines = {name.rpartition(" ")[0] for name in screen.names()}
    with_half_space = "half_space_patches/1/x_m" in summary
    for label, key, factor in PATCH_TABLE:
        words = [words for words in lines if re.fullmatch(re.escape(label) + r"( \+?#( %)?)+", words)]
        numbers: list[float] = []
        words = [one for one in words if len([name for name in screen.names() if name.rpartition(" ")[0] == one]) in (2, 4, 5, 6)]
        expect.that(f"one line '{label}'", len(words) == 1)
        for patch in (1, 2):
            own = summary[f"patches/{patch}/{key}"]
            numbers.append(factor * own)
            if with_half_space:
                other = summary[f"half_space_patches/{patch}/{key}"]
                numbers += [factor * other] + ([] if own == other or other == 0. else [100. * (own / other - 1.)])
        for place, value in enumerate(numbers):
            expect.near(f"{label} {place + 1}", screen[f"{words[0]} {place + 1}"], value, absolute=rounding(value, not with_half_space))


# Lines of the screen with # for their numbers, and what these are: (key of the summary, factor).
LINES = {
    ("track", "wheel #: normal force # kN, traction coefficient #, creepage #, maximum pressure # MPa, adhesion # %"): (
        None, ("wheel_2_normal_force_N", 1e-3), ("wheel_2_traction_coefficient", 1.), ("wheel_2_creepage", 1e3 / 1e3), ("wheel_2_max_pressure_Pa", 1e-6),
        ("wheel_2_adhesion_share", 100.)),
    ("track", "largest von Mises stress of the rail's cells # MPa at x = # mm, y = # mm, depth # mm"): (
        ("strip_max_von_mises_Pa", 1e-6), ("strip_max_von_mises_x_m", 1e3), ("strip_max_von_mises_y_m", 1e3), ("strip_max_von_mises_depth_m", 1e3)),
    ("half_curve", "half-space solver: shift # mm, yaw # mrad, roll # mrad, # rad/s; forces act on the wheel, by patch in contact axes"): (
        ("lateral_shift_m", 1e3), ("yaw_rad", 1e3), ("roll_rad", 1e3), ("angular_velocity_rad_per_s", 1.)),
    ("straight", "normal force # kN (ripple # %), traction coefficient #"): (("normal_force_N", 1e-3), ("normal_force_ripple_share", 100.), ("traction_coefficient", 1.)),
    ("curve", "vertical force # kN (ripple # %), traction coefficient #"): (("normal_force_N", 1e-3), ("normal_force_ripple_share", 100.), ("traction_coefficient", 1.)),
    ("straight", "# cells, # unknowns, # rank(s), # lanes"): (("cells", 1.), ("unknowns", 1.), ("ranks", 1.)),
    ("half_curve", "vertical force, kN #"): (("normal_force_N", 1e-3),),
    ("half_curve", "longitudinal force, kN #"): (("longitudinal_force_N", 1e-3),),
    ("half_curve", "lateral force in the track, kN #"): (("lateral_force_N", 1e-3),),
    ("half_curve", "frictional power, W #"): (("frictional_power_W", 1.),),
    ("half_curve", "wheelset over its radius, mm #"): (("wheelset_height_m", 1e3),),
    ("half", "half-space solver: elements of # mm, normal force # kN, approach # um, traction coefficient #"): (
        ("element_size_m", 1e3), ("normal_force_N", 1e-3), ("approach_m", 1e6), ("traction_coefficient", 1.)),
    ("straight", "time step # ns, # steps to roll # mm"): (("time_step_s", 1e9), ("steps", 1.), ("rolled_m", 1e3)),
    ("straight", "hourglass energy # % of the internal energy; slip chatter # % of the largest slip; contact not converged in # % of the steps"): (
        ("hourglass_of_internal_energy", 100.), ("slip_chatter_share", 100.), ("contact_unconverged_share", 100.)),
    ("plastic", "largest equivalent plastic strain # % in the rail (x = # mm, y = # mm, depth # mm), # % in the wheel"): (
        ("largest_plastic_strain", 100.), ("largest_plastic_strain_x_m", 1e3), ("largest_plastic_strain_y_m", 1e3), ("largest_plastic_strain_depth_m", 1e3),
        ("wheel_largest_plastic_strain", 100.)),
    ("plastic", "net plastic strain of the rail # % after # passages (y = # mm, depth # mm), at most # % more in the last one"): (
        ("net_plastic_strain", 100.), ("passages_rolled", 1.), ("net_plastic_strain_y_m", 1e3), ("net_plastic_strain_depth_m", 1e3), ("net_plastic_strain_of_last_passage", 100.)),
    ("half_two", "creepage over 'Wheel/Radius', per mille #"): (("creepage_over_nominal_radius", 1e3),),
    ("track", "largest contact force # kN, # of the static load, with the wheel at x = # mm"): (
        ("largest_normal_force_N", 1e-3), ("largest_normal_force_over_static", 1.), ("largest_normal_force_x_m", 1e3)),
    ("track", "least contact force # kN, # of the static load, with the wheel at x = # mm"): (
        ("least_normal_force_N", 1e-3), ("least_normal_force_over_static", 1.), ("least_normal_force_x_m", 1e3)),
    ("track", "largest force in a pad # kN, at support #, with the wheel at x = # mm"): (
        ("largest_pad_force_N", 1e-3), ("largest_pad_force_support", 1.), ("largest_pad_force_x_m", 1e3)),
    ("track", "largest force in ballast # kN, at support #, with the wheel at x = # mm"): (
        ("largest_ballast_force_N", 1e-3), ("largest_ballast_force_support", 1.), ("largest_ballast_force_x_m", 1e3)),
    ("straight", "dissipated # J: friction # %, plasticity # %, damping # %, contact # %; energy residual # % of it"): (
        ("dissipated_work_J", 1.), None, None, None, ("contact_loss_of_dissipated", 100.), ("energy_residual_of_dissipated", 100.)),
}


@compared_each(*LINES)
def lines_on_the_screen(runs: Runs, expect: Expect, which: tuple[str, str]) -> None:
    run, words = which
    screen, summary = runs.of(run, "screen"), runs.of(run)
    found = [name for name in {name.rpartition(" ")[0] for name in screen.names()} if name.replace("+#", "#").replace("#%", "# %") == words or len(words) > 60 and name.replace("+#", "#").startswith(words)]
    expect.that(f"a line like '{words}'", len(found) == 1)
    for place, known in enumerate(LINES[which]):
        if known:
            key, factor = known
            shown, value = screen[f"{found[0]} {place + 1}"], factor * summary[key]
            expect.near(f"{words}, {place + 1}", shown, value, absolute=max(6e-3 * abs(value), 0.0051 if abs(value) > 0.05 else 0., 0.051 if 0.5 < abs(value) < 10. and ("lengths" in words or "chatter" in words and place == 1) or "x = #" in words else 0.))
    if words.startswith("dissipated"):
        for place, name in ((2, "frictional_work_J"), (3, "plastic_work_J"), (4, "damping_work_J")):
            expect.near(name, screen[f"{found[0]} {place}"], 100. * summary[name] / summary["dissipated_work_J"], absolute=0.006)


@compared
def points_on_the_screen(runs: Runs, expect: Expect) -> None:
    """Rows at whole millimetres of contact_points.csv."""
    screen, table = runs.of("points", "screen"), runs.of("points", "contact_points.csv")
    whole = (table["lateral_shift_mm"] % 1. == 0.) & np.isfinite(table["equivalent_conicity"])
    row = [name.rpartition(" ")[0] for name in screen.names() if re.fullmatch("# # # # # # # # # # 1", name)][0]
    degrees = 180 / np.pi
    for place, (name, factor) in enumerate((("lateral_shift_mm", 1.), ("roll_rad", 1e3), ("own_y_wheel_mm", 1.), ("own_angle_rad", degrees), ("own_rolling_radius_mm", 1.),
                                            ("other_y_wheel_mm", 1.), ("other_angle_rad", degrees), ("other_rolling_radius_mm", 1.), ("radius_difference_mm", 1.),
                                            ("equivalent_conicity", 1.))):
        values = screen[f"{row} {place + 1}"]
        wanted = factor * table[name][whole]
        expect.near(name, values, wanted[-len(values):] if len(values) != len(wanted) else wanted, absolute=0.0051)


@compared
def conicities_on_the_screen(runs: Runs, expect: Expect) -> None:
    """The row of 3 mm, which EN 15302 asks for."""
    screen, table = runs.of("points", "screen"), runs.of("points", "contact_points.csv")
    words = "equivalent conicity at an amplitude of # mm (EN #): #, without roll #"
    row = int(np.argmin(np.abs(table["lateral_shift_mm"] - 3.)))
    for place, value in enumerate((3., 15302., table["equivalent_conicity"][row], table["equivalent_conicity_without_roll"][row])):
        expect.near(f"number {place + 1}", screen[f"{words} {place + 1}"], value, absolute=5.1e-4)


@compared
def passages_on_the_screen(runs: Runs, expect: Expect) -> None:
    screen, table = runs.of("plastic", "screen"), runs.of("plastic", "passages.csv")
    words = [name.rpartition(" ")[0] for name in screen.names() if name.startswith("passage # of #")][0]
    for place, (column, absolute) in enumerate((("passage", 0.), (None, 0.), ("equivalent_plastic_strain_percent", 5.1e-4), ("net_plastic_strain_percent", 5.1e-4))):
        shown = screen[f"{words} {place + 1}"]
        expect.near(f"number {place + 1}", shown, table[column][:len(shown)] if column else 2., absolute=max(absolute, 1e-9))


@compared_each(("dynamic", "dynamic.json", "[a-z_0-9-]+_N "), ("sleeper", "sleeper_stress.json", "largest (tension|von Mises stress) # MPa at"), ("sleeper", "sleeper_stress.json", "half a sleeper|force on the bottom|support #"),
               ("dynamic", "dynamic.json", "spectrum: |rows interpolated|dynamic force of"))
def figures_on_the_screen(runs: Runs, expect: Expect, which: tuple[str, str, str]) -> None:
    """Each number of these lines is a figure of the file, in a unit of thousands or millions of its own, or rounded to three digits."""
    run, file, pattern = which
    screen, figures = runs.of(run, "screen"), runs.of(run, file)
    known = [0.]
    for name in figures.names():
        value = figures[name]
        if isinstance(value, (int, float, np.ndarray)) and not isinstance(value, bool):
            known += list(np.ravel(value).astype(float))
    if run == "dynamic":
        time = runs.of(run, "dynamic.csv")["time_s"]
        known += [time[1] - time[0], 3.6e-3 * figures["speed_m_per_s"]]
    candidates = np.array([factor * value for value in known for factor in (1., 1e3, 1e-3, 1e6, 1e-6)])
    for name in screen.names():
        if re.match(pattern, name):
            for value in screen[name]:
                expect.that(f"{name}: {value}", np.min(np.abs(candidates - value)) <= max(6e-3 * abs(value), min(0.0051, 0.3 * abs(value) + 1e-12)))


@compared
def resonances_on_the_screen(runs: Runs, expect: Expect) -> None:
    """Local maxima of the contact force in receptance.csv, and Hertz's spring under the load."""
    screen, lines, parameters = runs.of("modes", "screen"), runs.of("modes", "receptance.csv"), runs.parameters["modes"]
    force, frequency = 1e-6 * lines["contact_force_N_per_m"], lines["frequency_Hz"]
    tops = [row for row in range(1, len(force) - 1) if force[row] > force[row - 1] and force[row] > force[row + 1]]
    words = "resonance of wheel, contact and rail: # Hz, # N/um"
    expect.near("Hz", screen[words + " 1"], frequency[tops], absolute=0.51)
    expect.near("N/um", screen[words + " 2"], force[tops], relative=6e-3)
    words = "receptances at x = # mm on the rail and under the wheel; Hertz's spring at # kN: # MN/m"
    load = 9.81e-3 * (float(parameters["Wheel/Mass (kg)"]) + float(parameters["Vehicle/Sprung mass (kg)"]))
    expect.near("x", screen[words + " 1"], float(parameters["Motion/Start (mm)"]), absolute=0.051)
    expect.near("load", screen[words + " 2"], load, relative=1e-3)


@compared
def defect_on_the_screen(runs: Runs, expect: Expect) -> None:
    screen, parameters = runs.of("track", "screen"), runs.parameters["track"]
    words = "defect: x = # to # mm, # mm deep; # more like it"
    begin, length, depth = (float(parameters[f"Defect/{name} (mm)"]) for name in ("Position", "Length", "Depth"))
    for place, value in enumerate((begin, begin + length, depth, 1.)):
        expect.near(f"number {place + 1}", screen[f"{words} {place + 1}"], value, absolute=0.0051)
