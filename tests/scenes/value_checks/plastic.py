# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two wheels roll over a rail that yields, one after the other; tables of its cells at the solution instant."""

from __future__ import annotations

import os

import numpy as np

from tread import vtu

from .engine import Expect, Runs, compared, compared_each

RUN = "plastic"
SPEED = 140 / 3.6
WHEEL = 1  # in the field `body` of pictures


@compared
def passages(runs: Runs, expect: Expect) -> None:
    table, history, summary = runs.of(RUN, "passages.csv"), runs.of(RUN, "history.csv"), runs.of(RUN)
    number = table["passage"]
    expect.near("numbers", number, [1, 2])
    expect.near("passages", [summary["passages"], summary["passages_rolled"]], len(number))
    expect.that("none is left out", np.all(table["skipped"] == 0))
    net, added, all_flow = table["net_plastic_strain_percent"], table["net_plastic_strain_of_passage_percent"], table["equivalent_plastic_strain_percent"]
    # In the first passage the stress turns by half a turn at least: of what flows a part goes back.
    expect.that("net strain is a part of all strain", np.all((0.3 * all_flow < net) & (net <= all_flow)))
    expect.near("what the first passage adds is all there is", added[0], net[0], relative=1e-6)
    expect.that("what the second one adds", net[1] - net[0] <= added[1] < 0.7 * added[0])
    expect.near("summary", [100. * summary["net_plastic_strain"], 100. * summary["net_plastic_strain_of_last_passage"]], [net[-1], added[-1]], relative=1e-6)
    position = history["position_m"]
    ends = [*np.flatnonzero(np.diff(position) < 0), len(position) - 1]
    for column in ("plastic_work_J", "frictional_work_J"):
        expect.near(column, table[column], history[column][ends], relative=1e-6)
    begins = [0, ends[0] + 1]
    means = [history["traction_coefficient"][begin:end + 1][(position[begin:end + 1] > -10e-3) & (position[begin:end + 1] <= 0)].mean() for begin, end in zip(begins, ends)]
    expect.near("traction", table["traction_coefficient"], means, relative=0.01)
    for passage, (begin, end) in enumerate(zip(begins, ends)):
        instant = begin + int(np.argmin(np.abs(position[begin:end + 1])))
        expect.near("largest pressure", table["max_pressure_MPa"][passage], 1e-6 * history["max_pressure_Pa"][instant], relative=0.02)
    dissipated = history["frictional_work_J"] + history["plastic_work_J"] + history["damping_work_J"] + np.abs(history["contact_loss_J"])
    expect.near("residual of dissipated", table["energy_residual_of_dissipated"], (history["energy_residual_J"] / dissipated)[ends], relative=1e-5)
    expect.near("residual", table["energy_residual_share"][-1], summary["energy_residual_share"], relative=1e-5)
    expect.that("the first wheel takes more plastic work", table["plastic_work_J"][0] > table["plastic_work_J"][1] > 0)


@compared
def rail_after_the_passages(runs: Runs, expect: Expect) -> None:
    """Cells in the middle of the path, 10 mm of it, after the last wheel: of its table at the end, the cells have kept their strain."""
    table, cells, surface, summary = runs.of(RUN, "passages.csv"), runs.of(RUN, "rail_cells.csv"), runs.of(RUN, "rail_surface.csv"), runs.of(RUN)
    middle = np.abs(cells["x_mm"] + 7.) < 6.
    expect.near("strain", table["equivalent_plastic_strain_percent"][-1], cells["equivalent_plastic_strain_percent"][middle].max(), relative=0.06)
    line = (np.abs(surface["y_mm"]) < 0.1) & (np.abs(surface["x_mm"] + 7.) <= 5.)
    back = np.abs(surface["x_mm"] + 10.) < 1.5
    expect.that("shift of the surface, against a driving wheel", np.all(table["shift_um"] * summary["longitudinal_force_N"] < 0.) and np.abs(table["shift_um"]).max() < 5. * np.abs(surface["u_x_um"][back]).max())
    expect.that("settlement grows, and is less than under load", 0. < table["settlement_um"][0] < table["settlement_um"][1] < -surface["u_z_um"][line].mean())
    behind = cells["x_mm"] < -9.
    expect.that("stress that is left", 0.2 * 450. < table["residual_von_mises_MPa"][-1] < 2. * cells["von_mises_MPa"][behind].max() + 100.)


@compared
def stress_of_the_cells(runs: Runs, expect: Expect) -> None:
    cells = runs.of(RUN, "rail_cells.csv")
    xx, yy, zz, xy, yz, zx = (cells[f"stress_{name}_MPa"] for name in ("xx", "yy", "zz", "xy", "yz", "zx"))
    mises = np.sqrt(0.5 * ((xx - yy)**2 + (yy - zz)**2 + (zz - xx)**2) + 3 * (xy**2 + yz**2 + zx**2))
    expect.near("von Mises", cells["von_mises_MPa"], mises, relative=1e-6)


@compared
def stress_on_a_level(runs: Runs, expect: Expect) -> None:
    """Below the finest layers the resultant of zz over a level is the load, that of zx the traction, and yz is odd in y."""
    cells, summary = runs.of(RUN, "rail_cells.csv"), runs.of(RUN)
    x, y, z = (cells[f"{axis}_mm"] for axis in "xyz")
    depth = -z - y**2 / 600.
    level = np.flatnonzero((depth > 1.6) & (depth < 2.3))
    expect.that("cells of a level", len(level) > 50)
    area = np.ptp(x[level]) * np.ptp(y[level]) * (1 + 1. / np.sqrt(len(level)))**2
    size = area / len(level)
    expect.near("load", -np.sum(cells["stress_zz_MPa"][level]) * size, summary["normal_force_N"], relative=0.25)
    expect.near("traction", np.sum(cells["stress_zx_MPa"][level]) * size, -summary["longitudinal_force_N"], relative=0.45)
    expect.near("mean place of the load, x", np.sum((x * cells["stress_zz_MPa"])[level]) / np.sum(cells["stress_zz_MPa"][level]), 0., absolute=0.7)
    expect.that("zz falls with the depth, so that yz has the sign of y", np.sum((y * cells["stress_yz_MPa"])[level]) > 0.)
    # Johnson (1985), eq. 3.75: of a traction along x on a half-space xy x y has its opposite sign; that on the rail opposes the wheel's.
    expect.that("xy has the sign of the traction", np.sum((y * cells["stress_xy_MPa"])[level]) * summary["longitudinal_force_N"] > 0.)
    for name, even in (("xx", 1), ("yy", 1), ("zz", 1), ("zx", 1), ("xy", -1), ("yz", -1)):
        values = cells[f"stress_{name}_MPa"]
        left, right = values[level][y[level] < 0], values[level][y[level] > 0]
        if len(left) == len(right):
            expect.near(f"{name}: symmetry", np.sort(left).mean(), even * np.sort(right).mean(), relative=0.02, absolute=1.)


@compared
def displaced_surface(runs: Runs, expect: Expect) -> None:
    """At the solution instant the nodes of patch.csv are those of rail_surface.csv where they have gone."""
    surface, patch = runs.of(RUN, "rail_surface.csv"), runs.of(RUN, "patch.csv")
    moved = [surface[f"{axis}_mm"] + 1e-3 * surface[f"u_{axis}_um"] for axis in "xyz"]
    nodes = [patch[f"{axis}_mm"] for axis in "xyz"]
    aheads = []
    for ahead in (0., np.inf):  # the wheel lies a part of a step behind or ahead of the end of the path
        ahead = np.median(aheads) if np.isinf(ahead) else ahead
        nearest = [int(np.argmin(np.hypot(moved[0] - x - ahead, moved[1] - y))) for x, y in zip(nodes[0], nodes[1])]
        aheads = moved[0][nearest] - nodes[0]
    expect.near("the wheel's place", np.median(aheads), 0., absolute=0.06)
    expect.near("x, um", 1e3 * (aheads - np.median(aheads)), 0., absolute=0.02)
    for name, k in (("y", 1), ("z", 2)):
        expect.near(f"{name}, um", 1e3 * moved[k][nearest], 1e3 * nodes[k], absolute=0.02)
    expect.that("lines of nodes", len(np.unique(np.round(surface["y_mm"], 3))) > 5)
    on_top = np.abs(surface["y_mm"]) < 6.
    expect.near("the crown", np.median(surface["z_mm"][on_top] + 300. - np.sqrt(300.**2 - surface["y_mm"][on_top]**2)), 0., absolute=1e-3)
    expect.near("the crown beside the path", np.percentile(surface["z_mm"][np.abs(surface["y_mm"]) > 5.], 50), -300. + np.sqrt(300.**2 - np.median(np.abs(surface["y_mm"][np.abs(surface["y_mm"]) > 5.]))**2), relative=0.4)
    expect.near("spacing along the path", np.median(np.diff(np.unique(np.round(surface["x_mm"], 3)))), 1.3, relative=0.03)


@compared
def plastic_strain_of_the_strip(runs: Runs, expect: Expect) -> None:
    """Largest of all cells under 3 mm to both sides, behind the wheel."""
    strip, cells = runs.of(RUN, "strip.csv"), runs.of(RUN, "rail_cells.csv")
    for column in np.flatnonzero(strip["x_mm"] < -8.):
        below = (np.abs(cells["x_mm"] - strip["x_mm"][column]) < 0.4) & (np.abs(cells["y_mm"]) <= 3.)
        expect.near("strain", strip["equivalent_plastic_strain_percent"][column], cells["equivalent_plastic_strain_percent"][below].max(), relative=0.01)


@compared
def cell_under_watch(runs: Runs, expect: Expect) -> None:
    """The cell of cells.csv at the solution instant is the one of rail_cells.csv at its place."""
    cells, summary, history, all_cells = runs.of(RUN, "cells.csv"), runs.of(RUN), runs.of(RUN, "history.csv"), runs.of(RUN, "rail_cells.csv")
    expect.near("time", cells["time_s"], history["time_s"], relative=1e-9)
    expect.near("position", cells["position_m"], history["position_m"], relative=1e-9)
    place = [1e3 * summary["cell_1_x_m"], 1e3 * summary["cell_1_y_m"], 1e3 * summary["cell_1_depth_m"]]
    expect.near("x", place[0], -6., absolute=0.7)
    expect.near("y", abs(place[1]), 0.65, absolute=0.7)
    expect.near("depth", place[2], 3., absolute=1.)
    nearest = int(np.argmin(np.abs(all_cells["x_mm"] - place[0]) + np.abs(all_cells["y_mm"] - place[1]) + np.abs(-all_cells["z_mm"] - all_cells["y_mm"]**2 / 600 - place[2])))
    expect.near("nearest, x", all_cells["x_mm"][nearest], place[0], absolute=0.02)
    expect.near("nearest, y", all_cells["y_mm"][nearest], place[1], absolute=0.02)
    expect.near("nearest, z", -all_cells["z_mm"][nearest], place[2], absolute=0.02)
    expect.that("it yields", all_cells["equivalent_plastic_strain_percent"][nearest] > 1e-3)
    row = len(cells["time_s"]) - 1 - int(np.argmin(np.abs(cells["position_m"][::-1])))
    expect.near("von Mises", 1e-6 * cells["cell_1_von_mises_Pa"][row], all_cells["von_mises_MPa"][nearest], relative=0.02)
    expect.near("strain, per cent", 100 * cells["cell_1_equivalent_plastic_strain"][row], all_cells["equivalent_plastic_strain_percent"][nearest], relative=0.02)


@compared_each(RUN, "straight")
def strip_of_the_summary(runs: Runs, expect: Expect, run: str) -> None:
    strip, summary = runs.of(run, "strip.csv"), runs.of(run)
    most = int(np.argmax(strip["von_mises_MPa"]))
    for key, column, factor in (("Pa", "von_mises_MPa", 1e-6), ("x_m", "x_mm", 1e3), ("y_m", "y_mm", 1e3), ("depth_m", "depth_mm", 1e3), ("time_s", "time_s", 1.)):
        expect.near(key, factor * summary[f"strip_max_von_mises_{key}"], strip[column][most], relative=1e-5)
    way = 12. if run == "straight" else 14.
    last = 0. if run == "straight" else runs.of(run, "history.csv")["time_s"][-1]
    for prefix in ("", "surface_"):
        expect.near(f"{prefix}wheel", strip[f"{prefix}wheel_x_mm"], 1e3 * SPEED * strip[f"{prefix}time_s"] - way, absolute=1e-3 if run == "straight" else np.inf)
    expect.that("within the strip", last >= 0)


@compared
def strip_beside_a_cell(runs: Runs, expect: Expect) -> None:
    """The second cell that is watched lies at the surface; its column of the strip has its largest stress."""
    strip, summary, cells = runs.of("straight", "strip.csv"), runs.of("straight"), runs.of("straight", "cells.csv")
    column = int(np.argmin(np.abs(strip["x_mm"] - 1e3 * summary["cell_2_x_m"])))
    expect.near("x", strip["x_mm"][column], 1e3 * summary["cell_2_x_m"], absolute=0.01)
    # The first one is that cell below it which bears most.
    expect.near("below", strip["von_mises_MPa"][column], 1e-6 * cells["cell_1_von_mises_Pa"].max(), relative=1e-6)
    row = int(np.argmax(cells["cell_1_von_mises_Pa"]))
    expect.near("time, us", 1e6 * strip["time_s"][column], 1e6 * cells["time_s"][row], absolute=0.01)
    expect.near("y", strip["y_mm"][column], 1e3 * summary["cell_1_y_m"], absolute=1e-3)
    expect.near("y at the surface", strip["surface_y_mm"][column], -7.5, absolute=3.1)
    expect.that("surface's is positive", strip["surface_von_mises_MPa"].min() >= 0.)
    expect.near("depth", strip["depth_mm"][column], 1e3 * summary["cell_1_depth_m"], absolute=1e-3)


@compared
def surface_of_the_strip(runs: Runs, expect: Expect) -> None:
    """Recovered at nodes, of all steps: that of the cells within the region of 'Peak stress' is its largest one."""
    strip, summary = runs.of("straight", "strip.csv"), runs.of("straight")
    inside = np.flatnonzero((strip["x_mm"] > -9. + 0.65) & (strip["x_mm"] < -0.65 + 1e-6))
    most = inside[int(np.argmax(strip["surface_von_mises_MPa"][inside]))]
    expect.near("largest", strip["surface_von_mises_MPa"][most], 1e-6 * summary["peak_surface_von_mises_Pa"], relative=1e-6)
    expect.near("x: of a node of that cell", abs(strip["x_mm"][most] - 1e3 * summary["peak_surface_von_mises_x_m"]), 0.65, absolute=1e-3)
    expect.near("y", strip["surface_y_mm"][most], 1e3 * summary["peak_surface_von_mises_y_m"], absolute=1e-3)
    expect.near("time, us", 1e6 * strip["surface_time_s"][most], 1e6 * summary["peak_surface_von_mises_time_s"], absolute=0.01)


@compared
def stress_of_the_surface(runs: Runs, expect: Expect) -> None:
    """Under the patch the rail bears the reaction of its tractions, and along it what the uppermost cells do."""
    surface, patch, cells = runs.of(RUN, "rail_surface.csv"), runs.of(RUN, "patch.csv"), runs.of(RUN, "rail_cells.csv")
    xx, yy, zz, xy, yz, zx = (surface[f"stress_{name}_MPa"] for name in ("xx", "yy", "zz", "xy", "yz", "zx"))
    mises = np.sqrt(0.5 * ((xx - yy)**2 + (yy - zz)**2 + (zz - xx)**2) + 3 * (xy**2 + yz**2 + zx**2))
    expect.near("von Mises", surface["von_mises_MPa"], mises, relative=1e-6)
    x, y = (surface[f"{axis}_mm"] + 1e-3 * surface[f"u_{axis}_um"] for axis in "xy")
    nodes = [int(np.argmin(np.hypot(x - at_x, y - at_y))) for at_x, at_y in zip(patch["x_mm"], patch["y_mm"])]
    for name, computed, reference in (("zz", zz, patch["pressure_MPa"]), ("zx", zx, patch["shear_x_MPa"])):
        expect.near(f"{name} is the traction", computed[nodes], -reference, relative=0.01)
    # The patch of two bodies of like steel curves half as much as the crown, with the slope y / 600.
    slope = surface["y_mm"][nodes] / 600.
    expect.near("yz is the traction", yz[nodes] - slope * (zz - yy)[nodes], -patch["shear_y_MPa"], relative=0.02)
    top = np.flatnonzero(-cells["z_mm"] - cells["y_mm"]**2 / 600. < 0.9)
    near = [top[np.argsort(np.hypot(cells["x_mm"][top] - surface["x_mm"][node], cells["y_mm"][top] - surface["y_mm"][node]))[:4]] for node in nodes]
    for name, values, allowed in (("xx", xx, 0.3), ("yy", yy, 0.3), ("xy", xy, 0.3)):
        below = np.array([cells[f"stress_{name}_MPa"][rows].mean() for rows in near])
        expect.near(f"{name} beside the cells' below", np.sum(values[nodes] * below) / np.sum(below**2), 1., absolute=allowed)


@compared
def largest_plastic_strain(runs: Runs, expect: Expect) -> None:
    """Of all cells of the table, and of the wheel's in the last picture."""
    summary, cells = runs.of(RUN), runs.of(RUN, "rail_cells.csv")
    most = int(np.argmax(cells["equivalent_plastic_strain_percent"]))
    expect.near("per cent", 100. * summary["largest_plastic_strain"], cells["equivalent_plastic_strain_percent"][most], relative=1e-6)
    expect.near("x", 1e3 * summary["largest_plastic_strain_x_m"], cells["x_mm"][most], absolute=1e-3)
    expect.near("y, to either side", abs(1e3 * summary["largest_plastic_strain_y_m"]), abs(cells["y_mm"][most]), absolute=1e-3)
    if RUN not in runs.strains:
        last = max(file for file in os.listdir(runs.folders[RUN]) if file.startswith("volume-") and file.endswith(".vtu"))
        pieces = [fields for _, _, fields in vtu.read_pieces(os.path.join(runs.folders[RUN], last))]
        runs.strains[RUN] = np.concatenate([piece["equivalent_plastic_strain_percent"][piece["body"] == WHEEL] for piece in pieces])
    expect.near("wheel, per cent", 100. * summary["wheel_largest_plastic_strain"], runs.strains[RUN].max(), relative=1e-5)
    expect.near("depth", 1e3 * summary["largest_plastic_strain_depth_m"], -cells["z_mm"][most] - cells["y_mm"][most]**2 / 600., absolute=2e-3)
