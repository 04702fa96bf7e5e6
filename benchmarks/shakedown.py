#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Residual stress of elastic shakedown: a rail in plane strain beside a plane-strain solution of its own.

Rolls the scene of a line contact, and computes the same strip with tread.rolling_strip: small strain, another kind of element, steady in the
axes of the contact, under the pressure of Hertz with the line load and the second moment of the pressure that the run had. Fills the tables of
doc/ratcheting.md. Runs that have complete results are not repeated; remove RESULTS to measure anew.
"""

import glob
import os

import numpy as np

from tread import rolling_strip
from tread.commands import command_parser, run_command
from tread.measured_runs import run_scene
from tread.runs import ROOT, Run
from tread.tables import fill, markdown, number, provenance
from tread.vtu import read_pieces

SCENE = "damage/line-contact.prm"
CELLS = {"1.3": {}, "0.65": {"Mesh/Finest cell (mm)": 0.65, "Mesh/Fine layers": 28}}
# mm and MPa, as in the scene.
YOUNG, TANGENT, YIELD, DEPTH, WIDTH = 210e3, 21e3, 430., 62.4, 5.2
HARDENING = YOUNG * TANGENT / (YOUNG - TANGENT)
MIDDLE = 10.  # half length about the middle of the path over which stress is averaged, mm
DEEPEST = 20.  # mm
HALF_PATH, HALF_RAIL = 78., 166.4  # rolled, and between the planes at the ends, mm


def left_behind(folder):
    """Depths of the layers of cells, mm, and (4, layers) stresses xx, yy, zz, xz, MPa, after the last passage: means about the middle."""
    path, rows = sorted(glob.glob(os.path.join(folder, "volume-*.vtu")))[-1], []
    for points, cells, fields in read_pieces(path):
        corners = cells.reshape(-1, 8)
        where = (points - 1e-3 * fields["displacement_um"].reshape(-1, 3))[corners].mean(1)
        values = [fields[name].ravel()[corners].mean(1) for name in ("stress_xx_MPa", "stress_yy_MPa", "stress_zz_MPa", "stress_zx_MPa")]
        here = (fields["body"].ravel()[corners].mean(1) < 0.5) & (abs(where[:, 0]) < MIDDLE) & (where[:, 2] > -DEEPEST)
        rows.append(np.column_stack([-where[here, 2], *(value[here] for value in values)]))
    table = np.concatenate(rows)
    depth = np.round(table[:, 0], 3)
    layers = np.unique(depth)
    return layers, np.array([table[depth == layer, 1:].mean(0) for layer in layers]).T


def pressure_of(run):
    """Half width, mm, and peak, MPa, of the pressure of Hertz in the middle of the path, and the range of the force along it, of its mean: with
    the second moment of the run's pressure at its end, and the line load that the wheels had in the middle."""
    x, y, p = run.patch.x, run.patch.y, run.patch.pressure
    weights = np.where(abs(abs(y) - 0.5 * WIDTH) < 0.01, 0.5, 1.) * p
    middle = (weights * x).sum() / weights.sum()
    at_end = 2. * np.sqrt((weights * (x - middle) ** 2).sum() / weights.sum())
    history = run.history
    force = history["normal_force_N"][abs(history["position_m"]) < 1e-3 * MIDDLE]
    half_width = at_end * np.sqrt(force.mean() / run.summary["normal_force_N"])
    return half_width, 2. * force.mean() / WIDTH / np.pi / half_width, np.ptp(history["normal_force_N"][abs(history["position_m"]) < 30e-3]) / force.mean()


def passages(strip, half_width, peak, traction_coefficient=0., most=10):
    """Depths; residual stresses (4, depths) of an endless rail, and in the middle of one that was rolled over along the path; passages with yielding."""
    force = strip.load(rolling_strip.hertzian(half_width, peak), traction_coefficient)
    before, plastic = np.zeros((4, strip.shape[1])), np.zeros((4, *strip.shape))
    for passage in range(1, most + 1):
        plastic, _ = strip.passage(force, before, plastic, YIELD, HARDENING)
        change, before = abs(plastic[:, 0] - before).max(), plastic[:, 0]
        if change < 1e-9:
            break
    # The steel beyond the path, which has not yielded, gives way, and the last wheel stands at the end of the path.
    rail = rolling_strip.Strip(np.linspace(-HALF_RAIL, HALF_RAIL, 129), strip.z, YOUNG)
    rolled = (abs(rail.points_x.reshape(rail.shape)) < HALF_PATH) * before[:, None, :]
    pressure = rolling_strip.hertzian(half_width, peak)
    found = rail.stress_of(rail.strain(rail.load(lambda x: pressure(x - HALF_PATH)), rolled) - rolled)
    of_path = 0.5 * found[:, rail.shape[0] // 2 - 1:rail.shape[0] // 2 + 1].sum(1)
    return strip.points_z.reshape(strip.shape)[0], strip.residual_stress(before), of_path, passage - 1


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/shakedown"))
    parser.add_argument("--fine", action="store_true", help="cells of 0.65 mm too")
    arguments = parser.parse_args()
    summaries, columns, rows, found = [], [], [], {}
    for cell, settings in CELLS.items():
        if settings and not arguments.fine:
            continue
        folder = os.path.join(arguments.results, cell)
        summaries.append(run_scene(SCENE, folder, settings, ranks=1))
        half_width, peak, ripple = pressure_of(Run(folder))
        depths, stress = left_behind(folder)
        z, endless, own, n = passages(rolling_strip.strip_of(half_width, DEPTH, 10, YOUNG), half_width, peak)
        of_cells = np.array([np.interp(depths, z, component) for component in own])
        of_endless = np.array([np.interp(depths, z, component) for component in endless])
        largest = abs(endless[:2]).max(1)[:, None]
        off, off_endless = ((stress - of)[:2] / largest for of in (of_cells, of_endless))
        found[cell] = depths, stress, of_cells, of_endless, off
        inner = depths > 0.3 * half_width
        work = Run(folder).table("passages.csv")["plastic_work_J"]
        share = lambda values: f"{100. * abs(values[inner]).max():.1f}"
        columns.append([cell, number(half_width), f"{peak:.0f}", f"{np.sqrt(3.) * peak / YIELD:.3f}", f"{100. * ripple:.2f}", share(off[0]), share(off[1]), share(off_endless[0]),
                        share(off_endless[1]), " / ".join(number(w) for w in work), str(n)])
    depths, stress, own, endless, off = list(found.values())[-1]  # of the finest cells
    for i in np.flatnonzero(depths < 17.):
        rows.append([f"{depths[i]:.2f}"] + [text for k in (0, 1) for text in (f"{endless[k, i]:.1f}", f"{own[k, i]:.1f}", f"{stress[k, i]:.1f}", f"{100. * off[k, i]:+.1f}")])
    note = "\n\nOne rank. " + provenance("benchmarks/shakedown.py" + (" --fine" if arguments.fine else ""), summaries)
    fill("ratcheting.md", "shakedown-stress", markdown(
        ["depth, mm", "xx, endless, MPa", "of the path", "tread", "off, %", "yy, endless, MPa", "of the path", "tread", "off, %"], rows) + note)
    fill("ratcheting.md", "shakedown-cells", markdown(
        ["cells, mm", "half width, mm", "peak, MPa", "p0/k", "range of the force over 60 mm, %", "xx off at most, %", "yy", "xx off an endless rail, %", "yy", "plastic work of the passages, J",
         "passages with yielding by plane strain"], columns) + note)


if __name__ == "__main__":
    run_command(main)
