#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of wheels that cross a defect, and of what reaches the supports: figures 4.1.8 to 4.1.12 and 4.3.6 to 4.3.17 of the
thesis.

    plot-impact.py RUN [RUN ...] [--smooth-twin TWIN [TWIN ...]] [--output DIR]
    plot-impact.py RUN --zimmermann

Written to RUN/pictures (the first run's), each where its data is there:
  contact-force.png   normal force beside the static load and the twin, distances of its peaks; largest pressure, patch area
  patches.png         contact pressure at instants around the largest force (needs 'Output/Surface interval (mm)')
  strip.png           largest von Mises stress that the cells under the path have seen, its depth, plastic strain
  cells.png           von Mises stress and plastic strain of the chosen cells (needs 'Output/Cells')
  residual.png        residual von Mises stress and plastic strain along the rail (needs 'Output/Table depth (mm)')
  dynamic-force.png   dynamic force of contact and the most loaded support, and their spectra
  supports.png        dynamic forces of pads and ballast at the supports, and their spectra
  distribution.png    forces of all pads and ballast supports at the instants of the largest, run beside twin
  zimmermann.png      shares of the twin's supports between two sleepers and near one, beside Zimmermann's beam
  speeds.png          of several runs: dynamic forces, their spectra, and peaks over speed

--zimmermann prints the table of the last but one and draws nothing. RUN is then a smooth one, or --smooth-twin names it.

Twins are those of the runs in the same order; one serves runs that share it. Without --smooth-twin the dynamic.csv that is there
is drawn.
"""

import json
import os
import re
from xml.etree import ElementTree

import numpy as np

from tread.commands import command_parser, run_command
from tread.plots import BLUE, COLOURS, ORANGE, RED, plt, save, use_style
from tread.files import DataError
from tread.runs import PROGRAM, Run, dynamic_force

# Second moments of area about the lateral axis, m4 (EN 13674-1).
SECOND_MOMENT = {"54E1": 2337.9e-8, "60E1": 3038.3e-8}
CONTACT = "normal_force_N"

use_style({"legend.fontsize": 8, "lines.linewidth": 1.3, "savefig.dpi": 120, "savefig.bbox": "tight"})


class Impact(Run):
    """A run over a defect. Positions in mm, forces in kN, m/s."""

    def __init__(self, folder, twin=None, program=PROGRAM):
        super().__init__(folder)
        self.history = self.table("history.csv", ("time_s", "position_m", CONTACT))
        self.x = 1e3 * self.history["position_m"]
        if len(self.x) < 2:
            raise DataError(f"{folder}/history.csv: fewer than two rows")
        self.speed = np.ptp(self.history["position_m"]) / np.ptp(self.history["time_s"])
        self.label = f"{3.6 * self.speed:.0f} km/h"
        self.twin, self.dynamic, self.figures = None, None, None
        if twin is not None:
            self.twin = Impact(twin)
            dynamic_force(folder, twin, program)
        if self.has("dynamic.csv"):
            self.dynamic = self.table("dynamic.csv", ("time_s", "position_m", CONTACT))
            self.spectrum = self.table("spectrum.csv", ("frequency_Hz", CONTACT))
            with open(self.path("dynamic.json"), encoding="utf-8") as stream:
                self.figures = json.load(stream)

    def force(self, column):
        return 1e-3 * self.history[column]

    def static_load(self):
        """Weight on the contact, kN; None if the parameters do not say."""
        mass = [self.parameters.get(name) for name in ("Wheel/Mass (kg)", "Vehicle/Sprung mass (kg)", "Vehicle/Gravity (m per s2)")]
        return None if None in mass else 1e-3 * (float(mass[0]) + float(mass[1])) * float(mass[2])

    def supports(self, layer):
        """Numbers of the supports whose forces are recorded, 'pad' or 'ballast'."""
        found = (re.fullmatch(rf"support_(-?\d+)_{layer}_N", name) for name in self.history)
        return sorted(int(match[1]) for match in found if match)

    def most_loaded(self, layer):
        """The support whose dynamic force is largest."""
        return max(self.supports(layer), key=lambda n: abs(self.figures["forces"][f"support_{n}_{layer}_N"]["peak_N"]))


def peaks(x, force, least):
    """Indices of the local maxima that rise above both sides by at least `least` before anything larger."""
    found = []
    for i in range(1, len(force) - 1):
        if force[i] >= force[i - 1] and force[i] > force[i + 1]:
            sides = []
            for part in (force[:i][::-1], force[i + 1:]):
                larger = np.nonzero(part > force[i])[0]
                sides.append(part[:larger[0]].min() if len(larger) else part.min())
            if force[i] - max(sides) >= least:
                found.append(i)
    return found


def draw_contact_force(run):
    figure, axes = plt.subplots(3, 1, figsize=(8, 8), sharex=True, height_ratios=(3, 1, 1))
    force, static = run.force(CONTACT), run.static_load()
    axes[0].plot(run.x, force, color=BLUE, label="with the defect" if run.twin else "normal force")
    if run.twin:
        axes[0].plot(run.twin.x, run.twin.force(CONTACT), color=ORANGE, lw=1, label="smooth twin")
    if static:
        axes[0].axhline(static, color="black", ls=":", label=f"static load {static:.1f} kN; largest {force.max() / static:.2f} of it")
    top = peaks(run.x, force, 0.05 * force.max())
    for i in top:
        axes[0].plot(run.x[i], force[i], "v", color=RED, ms=4)
    for i, j in zip(top, top[1:]):
        axes[0].annotate(f"{run.x[j] - run.x[i]:.0f} mm", (0.5 * (run.x[i] + run.x[j]), min(force[i], force[j])), xytext=(0, -4),
                         textcoords="offset points", ha="center", va="top", fontsize=8, color=RED)
    axes[0].set_ylabel("normal force [kN]")
    axes[0].legend()
    for axis, column, factor, label in ((axes[1], "max_pressure_Pa", 1e-6, "largest\npressure [MPa]"),
                                        (axes[2], "contact_area_m2", 1e6, "patch\narea [mm2]")):
        if column in run.history:
            axis.plot(run.x, factor * run.history[column], color=BLUE)
        axis.set_ylabel(label)
    axes[-1].set_xlabel("position of the wheel [mm]")
    return figure


def draw_patches(run):
    """Six contact surfaces around the largest force."""
    if not run.has("surface.pvd"):
        return None
    entries = [(float(entry.get("timestep")), entry.get("file")) for entry in ElementTree.parse(run.path("surface.pvd")).iter("DataSet")]
    if len(entries) < 2:
        return None
    import vtk
    from vtkmodules.util.numpy_support import vtk_to_numpy

    time, force = run.history["time_s"], run.history[CONTACT]
    impact = time[np.argmax(force)]
    entries = sorted(sorted(entries, key=lambda entry: abs(entry[0] - impact))[:6])
    figure, axes = plt.subplots(2, 3, figsize=(12, 6.5), sharey=True)
    pictures = []
    for when, name in entries:
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(run.path(name))
        reader.Update()
        grid = reader.GetOutput()
        points = 1e3 * vtk_to_numpy(grid.GetPoints().GetData())
        pressure = vtk_to_numpy(grid.GetPointData().GetArray("pressure_MPa"))
        centre = np.interp(when, time, run.x)
        near = (abs(points[:, 0] - centre) < 15) & (abs(points[:, 1]) < 12)
        pictures.append((centre, np.interp(when, time, force), points[near], pressure[near]))
    largest = max((pressure.max() for *_, pressure in pictures if len(pressure)), default=1.0)
    for axis, (centre, normal, points, pressure) in zip(axes.flat, pictures):
        if len(points) > 3:
            filled = axis.tricontourf(points[:, 0] - centre, points[:, 1], pressure, levels=np.linspace(1e-3 * largest, largest, 13),
                                      cmap="viridis")
        axis.set(title=f"wheel at {centre:.1f} mm\n{1e-3 * normal:.1f} kN, {pressure.max(initial=0):.0f} MPa", aspect="equal",
                 xlim=(-14, 14), ylim=(-11, 11), xlabel="x from the wheel [mm]")
    axes[0, 0].set_ylabel("y [mm]")
    axes[1, 0].set_ylabel("y [mm]")
    figure.colorbar(filled, ax=axes, label="contact pressure [MPa]")
    return figure


def draw_strip(run):
    if not run.has("strip.csv"):
        return None
    strip = run.table("strip.csv", ("x_mm", "von_mises_MPa", "depth_mm", "surface_von_mises_MPa", "equivalent_plastic_strain_percent"))
    if len(strip["x_mm"]) < 2:
        return None
    yields = strip["equivalent_plastic_strain_percent"].max() > 0
    figure, axes = plt.subplots(2 + yields, 1, figsize=(8, 5.5 + 2 * yields), sharex=True, height_ratios=(2, 1, 1)[:2 + yields])
    axes[0].plot(strip["x_mm"], strip["von_mises_MPa"], color=RED, label="at any depth")
    axes[0].plot(strip["x_mm"], strip["surface_von_mises_MPa"], color=BLUE, label="in the cells at the surface")
    axes[0].set(ylabel="largest von Mises [MPa]", title="largest stress that the cells under the path have seen")
    axes[0].legend()
    axes[1].plot(strip["x_mm"], strip["depth_mm"], color=RED)
    axes[1].invert_yaxis()
    axes[1].set_ylabel("its depth [mm]")
    if yields:
        axes[2].plot(strip["x_mm"], strip["equivalent_plastic_strain_percent"], color=BLUE)
        axes[2].set_ylabel("plastic strain [%]")
    axes[-1].set_xlabel("position on the rail [mm]")
    return figure


def draw_cells(run):
    if not run.has("cells.csv"):
        return None
    table = run.table("cells.csv", ("time_s", "position_m", "cell_1_von_mises_Pa"))
    figure, axes = plt.subplots(2, 1, figsize=(8, 5.5), sharex=True)
    numbers = sorted(int(match[1]) for match in (re.fullmatch(r"cell_(\d+)_von_mises_Pa", name) for name in table) if match)
    for i, number in enumerate(numbers):
        for axis, column, factor in ((axes[0], "von_mises_Pa", 1e-6), (axes[1], "equivalent_plastic_strain", 1e2)):
            axis.plot(1e3 * table["position_m"], factor * table[f"cell_{number}_{column}"], color=COLOURS[i % len(COLOURS)],
                      label=f"cell {number}")
    axes[0].set_ylabel("von Mises [MPa]")
    axes[0].legend()
    axes[1].set(ylabel="plastic strain [%]", xlabel="position of the wheel [mm]")
    return figure


def draw_residual(run):
    if not run.has("rail_cells.csv"):
        return None
    cells = run.table("rail_cells.csv", ("x_mm", "y_mm", "z_mm", "von_mises_MPa", "equivalent_plastic_strain_percent"))
    strip = (abs(cells["y_mm"]) < 1.01 * abs(cells["y_mm"]).min()) & (abs(cells["z_mm"]) < 1.5 * abs(cells["z_mm"]).min())
    order = np.argsort(cells["x_mm"][strip])
    figure, axes = plt.subplots(2, 1, figsize=(8, 5.5), sharex=True)
    for axis, column, label in ((axes[0], "von_mises_MPa", "von Mises [MPa]"),
                                (axes[1], "equivalent_plastic_strain_percent", "plastic strain [%]")):
        axis.plot(cells["x_mm"][strip][order], cells[column][strip][order], color=BLUE)
        axis.set_ylabel(label)
    axes[0].set_title(f"first layer of cells under y = 0, {abs(cells['z_mm']).min():.2f} mm deep, at the solution instant")
    axes[1].set_xlabel("position on the rail [mm]")
    return figure


def draw_lines(axis, run, columns, labels=None):
    for i, column in enumerate(columns):
        axis.plot(1e3 * run.dynamic["position_m"], 1e-3 * run.dynamic[column], color=COLOURS[i % len(COLOURS)],
                  label=labels[i] if labels else column)
    axis.set(xlabel="position of the wheel [mm]", ylabel="dynamic force [kN]")
    axis.legend()


def draw_spectra(axis, run, columns, labels=None, highest=2500):
    shown = run.spectrum["frequency_Hz"] <= highest
    for i, column in enumerate(columns):
        axis.plot(run.spectrum["frequency_Hz"][shown], 1e-3 * run.spectrum[column][shown], color=COLOURS[i % len(COLOURS)],
                  label=labels[i] if labels else column)
    axis.set(xlabel="frequency [Hz]", ylabel="amplitude [kN]",
             title=f"{run.figures['window']} window, resolution {run.figures['resolution_Hz']:.0f} Hz")
    axis.legend()


def draw_dynamic_force(run):
    if run.dynamic is None:
        return None
    columns, labels = [CONTACT], ["contact"]
    for layer in ("pad", "ballast"):
        if run.supports(layer):
            number = run.most_loaded(layer)
            columns.append(f"support_{number}_{layer}_N")
            labels.append(f"{layer} {number}")
    figure, axes = plt.subplots(1, 2, figsize=(12, 4.5))
    draw_lines(axes[0], run, columns, labels)
    draw_spectra(axes[1], run, columns, labels)
    for line in run.figures["forces"][CONTACT]["oscillations"][:3]:
        text = f"{line['frequency_Hz']:.0f} Hz, {1e3 * line['wavelength_m']:.0f} mm"
        if line["logarithmic_decrement"] is not None:
            text += f"\ndecrement {line['logarithmic_decrement']:.2f}"
        axes[1].annotate(text, (line["frequency_Hz"], 1e-3 * line["amplitude_N"]), xytext=(8, -8), textcoords="offset points", fontsize=8)
    entry = run.figures["forces"][CONTACT]
    axes[0].set_title(f"peak {1e-3 * entry['peak_N']:.1f} kN at {1e3 * entry['peak_position_m']:.1f} mm, {run.label}")
    return figure


def draw_supports(run):
    if run.dynamic is None or not run.supports("pad"):
        return None
    layers = [layer for layer in ("pad", "ballast") if run.supports(layer)]
    figure, axes = plt.subplots(len(layers), 2, figsize=(12, 4.2 * len(layers)), squeeze=False)
    for row, layer in zip(axes, layers):
        # The most loaded one and its neighbours.
        numbers = sorted(run.supports(layer), key=lambda n: abs(n - run.most_loaded(layer)))[:5]
        columns = [f"support_{n}_{layer}_N" for n in sorted(numbers)]
        labels = [f"{layer} {n}" for n in sorted(numbers)]
        draw_lines(row[0], run, columns, labels)
        draw_spectra(row[1], run, columns, labels)
    figure.tight_layout()
    return figure


def draw_distribution(run):
    if run.dynamic is None or run.twin is None or not run.supports("pad"):
        return None
    layers = [layer for layer in ("pad", "ballast") if run.supports(layer)]
    figure, axes = plt.subplots(1, len(layers), figsize=(6 * len(layers), 4), squeeze=False)
    for axis, layer in zip(axes[0], layers):
        numbers = run.supports(layer)
        at = 1e3 * run.figures["forces"][f"support_{run.most_loaded(layer)}_{layer}_N"]["peak_position_m"]
        for shift, one, label, colour in ((-0.2, run, "with the defect", RED), (0.2, run.twin, "smooth twin", BLUE)):
            axis.bar(np.array(numbers) + shift, [np.interp(at, one.x, one.force(f"support_{n}_{layer}_N")) for n in numbers], 0.4,
                     color=colour, label=label)
        axis.set(title=f"{layer}, wheel at {at:.1f} mm", xlabel="support", ylabel="force [kN]", xticks=numbers)
        axis.legend()
    return figure


def zimmermann_share(distance, spacing, length):
    """Force on a support over the wheel's, by the deflection of the beam (Zimmermann 1888). @param all m"""
    s = abs(distance) / length
    return spacing / (2 * length) * np.exp(-s) * (np.cos(s) + np.sin(s))


def zimmermann(run):
    """Five most loaded supports of a smooth rail, wheel between two and near one: [(position of the wheel in mm, {support: (share
    of the contact force in its pad, share by Zimmermann)})], or None."""
    run = run.twin or run
    p = run.parameters
    names = ["Track/Sleeper spacing (m)", "Track/Support 0 (mm)", "Track/Pad stiffness (MN per m)", "Rail/Young's modulus (GPa)"]
    if (not run.supports("pad") or p.get("Track/Foundation") == "rigid" or any(name not in p for name in names)
            or p.get("Rail/Profile") not in SECOND_MOMENT):
        return None
    spacing, origin, pad, young = (float(p[name]) for name in names)
    stiffness = pad
    if p.get("Track/Foundation") == "two-layer":
        stiffness = 1 / (1 / pad + 1 / float(p["Track/Ballast stiffness (MN per m)"]))
    length = (4 * young * 1e9 * SECOND_MOMENT[p["Rail/Profile"]] / (stiffness * 1e6 / spacing)) ** 0.25
    # As far from the ends of the record as can be: over a mid-span, and an eighth of a spacing before a sleeper.
    middle = 0.5 * (run.x[0] + run.x[-1])
    instants = []
    for phase in (0.5, 0.875):
        at = origin + 1e3 * spacing * (round((middle - origin) / (1e3 * spacing) - phase) + phase)
        at = float(np.clip(at, run.x[0], run.x[-1]))
        contact = np.interp(at, run.x, run.force(CONTACT))
        own = {n: np.interp(at, run.x, run.force(f"support_{n}_pad_N")) / contact for n in run.supports("pad")}
        most = sorted(sorted(own, key=own.get)[-5:])
        instants.append((at, {n: (own[n], zimmermann_share(1e-3 * (origin - at) + spacing * n, spacing, length)) for n in most}))
    return instants


def draw_zimmermann(run):
    instants = zimmermann(run)
    if instants is None:
        return None
    figure, axes = plt.subplots(1, 2, figsize=(11, 4), sharey=True)
    for axis, (at, shares) in zip(axes, instants):
        numbers = np.array(list(shares))
        own, theory = np.array(list(shares.values())).T
        axis.bar(numbers - 0.2, own, 0.4, color=BLUE, label="tread")
        axis.bar(numbers + 0.2, theory, 0.4, color=ORANGE, label="Zimmermann")
        most = int(np.argmax(own))
        axis.set(title=f"wheel at {at:.1f} mm; most loaded: {100 * (own[most] / theory[most] - 1):+.1f} %", xlabel="support",
                 ylabel="force over contact force", xticks=numbers)
        axis.legend()
    return figure


def print_zimmermann(run):
    """What draw_zimmermann() draws, as a table in Markdown."""
    instants = zimmermann(run)
    if instants is None:
        raise DataError(f"{run.folder}: no supports of a known rail in history.csv and parameters.prm")
    print("| wheel at | support | share of the contact force | Zimmermann | difference |\n|---|---|---|---|---|")
    for at, shares in instants:
        for n, (own, theory) in shares.items():
            print(f"| {at:.1f} mm | {n} | {100 * own:.2f} % | {100 * theory:.2f} % | {100 * (own / theory - 1):+.1f} % |")


def draw_speeds(runs):
    runs = sorted((run for run in runs if run.dynamic is not None), key=lambda run: run.speed)
    if len(runs) < 2:
        return None
    columns = [(CONTACT, "contact")]
    for layer in ("pad", "ballast"):
        common = set.intersection(*(set(run.supports(layer)) for run in runs))
        if common:
            most = max(common, key=lambda n: max(abs(run.figures["forces"][f"support_{n}_{layer}_N"]["peak_N"]) for run in runs))
            columns += [(f"support_{n}_{layer}_N", f"{layer} {n}") for n in sorted(common & ({most - 1, most} if layer == "pad" else {most}))]
    figure, axes = plt.subplots(2, 2 + (len(columns) > 2), figsize=(6 + 3 * len(columns), 8.5), squeeze=False)
    places = list(axes.flat)
    for (column, label), axis in zip(columns, places):
        for i, run in enumerate(runs):
            axis.plot(1e3 * run.dynamic["position_m"], 1e-3 * run.dynamic[column], color=COLOURS[i % len(COLOURS)], label=run.label)
        axis.set(title=label, xlabel="position of the wheel [mm]", ylabel="dynamic force [kN]")
        axis.legend()
    spectra, over_speed = places[len(columns)], places[len(columns) + 1]
    for i, run in enumerate(runs):
        shown = run.spectrum["frequency_Hz"] <= 2500
        spectra.plot(run.spectrum["frequency_Hz"][shown], 1e-3 * run.spectrum[CONTACT][shown], color=COLOURS[i % len(COLOURS)],
                     label=f"{run.label}, resolution {run.figures['resolution_Hz']:.0f} Hz")
    spectra.set(title=f"contact, {runs[0].figures['window']} window", xlabel="frequency [Hz]", ylabel="amplitude [kN]")
    spectra.legend()
    for i, (column, label) in enumerate(columns):
        over_speed.plot([3.6 * run.speed for run in runs], [1e-3 * abs(run.figures["forces"][column]["peak_N"]) for run in runs], "o-",
                        color=COLOURS[i % len(COLOURS)], label=label)
    over_speed.set(title="peaks", xlabel="speed [km/h]", ylabel="largest dynamic force [kN]")
    over_speed.legend()
    for axis in places[len(columns) + 2:]:
        axis.remove()
    figure.tight_layout()
    return figure


def main():
    parser = command_parser(__doc__)
    parser.add_argument("runs", metavar="RUN", nargs="+")
    parser.add_argument("--smooth-twin", metavar="TWIN", nargs="+", default=[])
    parser.add_argument("--output", help="folder of the pictures; default: pictures/ in the first run")
    parser.add_argument("--zimmermann", action="store_true", help="print the shares of the supports beside Zimmermann's")
    parser.add_argument("--program", default=PROGRAM, help="tread itself")
    arguments = parser.parse_args()
    twins = arguments.smooth_twin
    if len(twins) not in (0, 1, len(arguments.runs)):
        raise DataError(f"{len(arguments.runs)} runs and {len(twins)} smooth twins: one for each or one for all")
    twins = (twins * len(arguments.runs) if len(twins) == 1 else twins) or [None] * len(arguments.runs)
    runs = [Impact(folder, twin, arguments.program) for folder, twin in zip(arguments.runs, twins)]
    if arguments.zimmermann:
        for run in runs:
            print_zimmermann(run)
        return
    folder = arguments.output or runs[0].path("pictures")
    pictures = [("contact-force", draw_contact_force), ("patches", draw_patches), ("strip", draw_strip), ("cells", draw_cells),
                ("residual", draw_residual), ("dynamic-force", draw_dynamic_force), ("supports", draw_supports), ("distribution", draw_distribution),
                ("zimmermann", draw_zimmermann)]
    drawn = [(name, draw(runs[0])) for name, draw in pictures] + [("speeds", draw_speeds(runs))]
    for name, figure in drawn:
        if figure is not None:
            save(figure, os.path.join(folder, f"{name}.png"))
    print(f"{folder}: " + ", ".join(f"{name}.png" for name, figure in drawn if figure is not None))


if __name__ == "__main__":
    run_command(main)
