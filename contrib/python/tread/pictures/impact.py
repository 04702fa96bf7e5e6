# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wheels that cross a defect, and what reaches the supports: figures 4.1.8 to 4.1.12 and 4.3.6 to 4.3.17 of the thesis."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from xml.etree import ElementTree

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from ..defects import extents_of_defects
from ..files import DataError
from ..loads import static_load
from ..plots import (BLUE, COLOURS, ORANGE, RED, at_least_high, depth_axis, legend_beside, passages, plot_passages, shade_defects, shown_rows, subplots)
from ..runs import PROGRAM, Run, dynamic_force
from ..vtu import read_pieces
from .titles import is_dynamic

# Second moments of area about the lateral axis, m4 (EN 13674-1, TB/T 2344).
SECOND_MOMENT = {"54E1": 2337.9e-8, "60E1": 3038.3e-8, "49E1": 1816e-8, "CN60": 3217e-8}
CONTACT = "normal_force_N"


class Impact(Run):
    """A run over a defect or on a track. Positions in mm, forces in kN, m/s."""

    def __init__(self, folder: str, twin: str | None = None, program: str = PROGRAM):
        super().__init__(folder)
        self.record = self.table("history.csv", ("time_s", "position_m", CONTACT))
        if len(self.record["time_s"]) < 2:
            raise DataError(f"{folder}/history.csv: fewer than two rows")
        # Of several passages supports, spectra and shares are those of the last one.
        last = passages(self.record["position_m"])[-1]
        self.history = {name: values[last] for name, values in self.record.items()}
        self.x = 1e3 * self.history["position_m"]
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

    def force(self, column: str) -> np.ndarray:
        return 1e-3 * self.history[column]

    def supports(self, layer: str) -> list[int]:
        """Numbers of the supports whose forces are recorded, 'pad' or 'ballast'."""
        found = (re.fullmatch(rf"support_(-?\d+)_{layer}_N", name) for name in self.history)
        return sorted(int(match[1]) for match in found if match)

    def most_loaded(self, layer: str) -> int:
        """The support whose dynamic force is largest."""
        return max(self.supports(layer), key=lambda n: abs(self.figures["forces"][f"support_{n}_{layer}_N"]["peak_N"]))


def peaks(x: np.ndarray, force: np.ndarray, least: float) -> list[int]:
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


def draw_contact_force(run: Impact) -> Figure:
    figure, axes = subplots(3, 1, figsize=(10.5, 8), sharex=True, height_ratios=(3, 1, 1))
    position = 1e3 * run.record["position_m"]
    rows = shown_rows(position, run.parameters)
    x, history = position[rows], {name: values[rows] for name, values in run.record.items()}
    last = passages(x)[-1]
    force, static = 1e-3 * history[CONTACT], static_load(run.parameters)
    plot_passages(axes[0], x, x, force, color=BLUE, label="with the defect" if run.twin else "normal force")
    if run.twin:
        near = run.twin.x >= x.min()
        axes[0].plot(run.twin.x[near], run.twin.force(CONTACT)[near], color=ORANGE, lw=1, label="smooth twin")
    if static:
        axes[0].axhline(static, color="black", ls=":", label=f"static load {static:.1f} kN;\nlargest {force.max() / static:.2f},\nleast {force.min() / static:.2f} of it")
    x_last, force_last = x[last], force[last]
    top = peaks(x_last, force_last, 0.05 * force.max())
    axes[0].plot(x_last[top], force_last[top], "v", color=RED, ms=4, label="peaks and their\ndistances" if len(top) > 1 else None)
    for i, j in zip(top, top[1:]):
        axes[0].annotate(f"{x_last[j] - x_last[i]:.0f} mm", (0.5 * (x_last[i] + x_last[j]), max(force_last[i], force_last[j])), xytext=(0, 6),
                         textcoords="offset points", ha="center", va="bottom", fontsize=8, color=RED)
    axes[0].margins(y=0.1)
    at_least_high(axes[0], 0.02, 0.1)
    axes[0].set_ylabel("normal force [kN]")
    for axis, column, factor, label in ((axes[1], "max_pressure_Pa", 1e-6, "largest\npressure [MPa]"),
                                        (axes[2], "contact_area_m2", 1e6, "patch\narea [mm$^2$]")):
        if column in history:
            plot_passages(axis, x, x, factor * history[column], color=BLUE)
            at_least_high(axis, 0.02, 1.0)
        axis.set_ylabel(label)
    for axis in axes:
        shade_defects(axis, run.parameters, named=axis is axes[0])
    legend_beside(axes[0])
    number = len(passages(x))
    axes[0].set_title(f"normal force at {run.label}" + (f", {number} passages, the last one in full colour" if number > 1 else ""))
    begins = "" if rows.all() else f"; history.csv begins at {position.min():.0f} mm"
    axes[-1].set_xlabel(f"position of the wheel [mm], it rolls to the right{begins}")
    figure.align_ylabels(axes)
    return figure


def draw_patches(run: Impact) -> Figure | None:
    """Six contact surfaces: from before the first defect to the largest force, or around that one."""
    if not run.has("surface.pvd"):
        return None
    entries = [(float(entry.get("timestep")), entry.get("file")) for entry in ElementTree.parse(run.path("surface.pvd")).iter("DataSet")]
    if len(entries) < 2:
        return None
    time, force = run.history["time_s"], run.history[CONTACT]
    entries = [entry for entry in entries if entry[0] >= time[0]]  # of several passages the last
    impact, begin = run.x[np.argmax(force)], min((begin for begin, _ in extents_of_defects(run.parameters)), default=np.inf)
    places = np.interp([when for when, _ in entries], time, run.x)
    if begin < impact:
        what = "instants from before the defect to the largest normal force"
        wanted = np.linspace(max(begin - 10, run.x[0]), impact, 6)
        chosen = sorted({int(np.argmin(abs(places - at))) for at in wanted})
    else:
        what = "instants around the largest normal force"
        chosen = sorted(np.argsort(abs(places - impact))[:6])
    entries = [entries[i] for i in chosen]
    if not entries:
        return None
    figure, axes = subplots(2, 3, figsize=(12, 7.2), sharey=True, squeeze=False)
    pictures = []
    for when, name in entries:
        pieces = list(read_pieces(run.path(name)))
        points = np.concatenate([points for points, _, _ in pieces])
        pressure = np.concatenate([fields["pressure_MPa"] for _, _, fields in pieces])
        centre = np.interp(when, time, run.x)
        near = abs(points[:, 0] - centre) < 15
        pictures.append((centre, np.interp(when, time, force), points[near], pressure[near]))
    # As wide as the patches of all instants, wherever on the rail the wheel runs.
    loaded = np.concatenate([points[pressure > 0, 1] for *_, points, pressure in pictures] or [np.empty(0)])
    low, high = (loaded.min() - 3, loaded.max() + 3) if len(loaded) else (-11, 11)
    low, high = min(low, 0.5 * (low + high) - 11), max(high, 0.5 * (low + high) + 11)
    largest = max((pressure.max() for *_, pressure in pictures if len(pressure)), default=1.0) or 1.0
    levels, colours = np.linspace(1e-3 * largest, largest, 13), ScalarMappable(Normalize(0, largest), "viridis")
    for axis, (centre, normal, points, pressure) in zip(axes.flat, pictures):
        across = (points[:, 1] > low - 5) & (points[:, 1] < high + 5)
        points, pressure = points[across], pressure[across]
        if len(points) > 3:
            axis.tricontourf(points[:, 0], points[:, 1], pressure, levels=levels, norm=colours.norm, cmap=colours.cmap)
        shade_defects(axis, run.parameters)
        axis.axvline(centre, color="black", lw=0.7, ls="--")
        axis.set(title=f"wheel at {centre:.1f} mm (dashed)\n{1e-3 * normal:.1f} kN, {pressure.max(initial=0):.0f} MPa", aspect="equal",
                 xlim=(centre - 14, centre + 14), ylim=(low, high), xlabel="position on the rail [mm]")
    for axis in axes.flat[len(pictures):]:
        axis.remove()
    for axis in axes[:, 0]:
        axis.set_ylabel("y, + to the field side [mm]")
    figure.colorbar(colours, ax=axes, label="contact pressure [MPa]")
    figure.suptitle(f"{what}; shaded: the defect; the wheel rolls to the right", x=0.01, ha="left", fontsize=10)
    return figure


def draw_strip(run: Impact) -> Figure | None:
    if not run.has("strip.csv"):
        return None
    strip = run.table("strip.csv", ("x_mm", "von_mises_MPa", "depth_mm", "surface_von_mises_MPa", "equivalent_plastic_strain_percent"))
    if len(strip["x_mm"]) < 2:
        return None
    strip = {name: values[shown_rows(strip["x_mm"], run.parameters)] for name, values in strip.items()}
    yields = strip["equivalent_plastic_strain_percent"].max() > 0
    figure, axes = subplots(2 + yields, 1, figsize=(10, 5.5 + 2 * yields), sharex=True, height_ratios=(2, 1, 1)[:2 + yields])
    axes[0].plot(strip["x_mm"], strip["von_mises_MPa"], color=RED, label="at any depth")
    axes[0].plot(strip["x_mm"], strip["surface_von_mises_MPa"], color=BLUE, label="at the surface")
    axes[0].set(ylabel="largest von Mises stress [MPa]", title="largest stress that the rail's cells under the path have seen")
    axes[1].plot(strip["x_mm"], strip["depth_mm"], color=RED)
    depth_axis(axes[1], strip["depth_mm"])
    axes[1].set_ylabel("its depth [mm]")
    if yields:
        axes[2].plot(strip["x_mm"], strip["equivalent_plastic_strain_percent"], color=BLUE)
        axes[2].set_ylim(bottom=0)
        axes[2].set_ylabel("plastic strain\nat the end [%]")
    over_the_rail(axes, run)
    return figure


def over_the_rail(axes: Sequence[Axes], run: Run, what: str = "position on the rail") -> None:
    """The abscissa that panels share, with the defects."""
    for axis in axes:
        shade_defects(axis, run.parameters)
        if not axis.yaxis_inverted():
            at_least_high(axis, 0.02, 0.01)
    legend_beside(axes[0])
    axes[-1].set_xlabel(f"{what} [mm], the wheel rolls to the right")
    axes[0].figure.align_ylabels(axes)


def draw_cells(run: Impact) -> Figure | None:
    if not run.has("cells.csv"):
        return None
    table = run.table("cells.csv", ("time_s", "position_m", "cell_1_von_mises_Pa"))
    position = 1e3 * table["position_m"]
    rows = shown_rows(position, run.parameters)
    figure, axes = subplots(2, 1, figsize=(10, 5.5), sharex=True)
    numbers = sorted(int(match[1]) for match in (re.fullmatch(r"cell_(\d+)_von_mises_Pa", name) for name in table) if match)
    for i, number in enumerate(numbers):
        for axis, column, factor in ((axes[0], "von_mises_Pa", 1e-6), (axes[1], "equivalent_plastic_strain", 1e2)):
            plot_passages(axis, position[rows], position[rows], factor * table[f"cell_{number}_{column}"][rows], color=COLOURS[i % len(COLOURS)],
                          label=f"cell {number}")
    axes[0].set_ylabel("von Mises stress [MPa]")
    axes[1].set_ylabel("plastic strain [%]")
    over_the_rail(axes, run, "position of the wheel")
    return figure


def draw_residual(run: Impact) -> Figure | None:
    if not run.has("rail_cells.csv"):
        return None
    cells = run.table("rail_cells.csv", ("x_mm", "y_mm", "z_mm", "von_mises_MPa", "equivalent_plastic_strain_percent"))
    # At each x the highest cell of those nearest to y = 0.
    order = np.lexsort((-cells["z_mm"], np.round(abs(cells["y_mm"]), 1), np.round(cells["x_mm"], 2)))
    first = order[np.unique(np.round(cells["x_mm"][order], 2), return_index=True)[1]]
    first = first[shown_rows(cells["x_mm"][first], run.parameters)]
    figure, axes = subplots(2, 1, figsize=(10, 5.5), sharex=True)
    for axis, column, label in ((axes[0], "von_mises_MPa", "von Mises stress [MPa]"),
                                (axes[1], "equivalent_plastic_strain_percent", "plastic strain [%]")):
        axis.plot(cells["x_mm"][first], cells[column][first], color=BLUE)
        axis.axvline(run.x[-1], color="black", lw=0.7, ls="--", label="wheel" if axis is axes[0] else None)
        axis.set_ylabel(label)
    axes[0].set_title("first layer of cells of the rail under y = 0 at the end of the run: load under the wheel, what remains behind it")
    over_the_rail(axes, run)
    return figure


def draw_lines(axis: Axes, run: Impact, columns: Sequence[str], labels: Sequence[str], colour: str | None = None) -> None:
    x = 1e3 * run.dynamic["position_m"]
    rows = shown_rows(x, run.parameters)
    for i, (column, label) in enumerate(zip(columns, labels)):
        axis.plot(x[rows], 1e-3 * run.dynamic[column][rows], color=colour or COLOURS[i % len(COLOURS)], label=label)
    at_least_high(axis, 0.0, 0.1)
    axis.set(xlabel="position of the wheel [mm], it rolls to the right", ylabel="dynamic force [kN], + more load")


def draw_spectra(axis: Axes, run: Impact, columns: Sequence[str], labels: Sequence[str | None], colour: str | None = None,
                 highest: float = 2500) -> None:
    rows = run.spectrum["frequency_Hz"] <= highest
    for i, (column, label) in enumerate(zip(columns, labels)):
        axis.plot(run.spectrum["frequency_Hz"][rows], 1e-3 * run.spectrum[column][rows], color=colour or COLOURS[i % len(COLOURS)], label=label)
    axis.set(xlabel="frequency [Hz]", ylabel="amplitude [kN]",
             title=f"{run.figures['window']} window, resolution {run.figures['resolution_Hz']:.0f} Hz")


def draw_dynamic_force(run: Impact) -> Figure | None:
    if run.dynamic is None:
        return None
    columns, labels = [CONTACT], ["contact"]
    for layer in ("pad", "ballast"):
        if run.supports(layer):
            number = run.most_loaded(layer)
            columns.append(f"support_{number}_{layer}_N")
            labels.append(f"{layer} {number}")
    figure, axes = subplots(1, 2, figsize=(13, 4.7))
    draw_lines(axes[0], run, columns, labels)
    draw_spectra(axes[1], run, columns, [None] * len(columns))
    shade_defects(axes[0], run.parameters)
    for line in run.figures["forces"][CONTACT]["oscillations"][:3]:
        text = f"{line['frequency_Hz']:.0f} Hz, {1e3 * line['wavelength_m']:.0f} mm"
        if line["logarithmic_decrement"] is not None:
            text += f"\ndecrement {line['logarithmic_decrement']:.2f}"
        axes[1].annotate(text, (line["frequency_Hz"], 1e-3 * line["amplitude_N"]), xytext=(0, 4), textcoords="offset points", fontsize=8,
                         ha="center", va="bottom", bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1})
    axes[1].set_ylim(0, 1.2 * axes[1].get_ylim()[1])
    entry = run.figures["forces"][CONTACT]
    axes[0].set_title(f"what the defect adds; contact: peak {1e-3 * entry['peak_N']:.1f} kN with the wheel at {1e3 * entry['peak_position_m']:.1f} mm, {run.label}")
    axes[0].legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=4)
    return figure


def draw_supports(run: Impact) -> Figure | None:
    if run.dynamic is None or not run.supports("pad"):
        return None
    layers = [layer for layer in ("pad", "ballast") if run.supports(layer)]
    figure, axes = subplots(len(layers), 2, figsize=(13, 4.2 * len(layers)), squeeze=False)
    for row, layer in zip(axes, layers):
        # The most loaded one and its neighbours.
        numbers = sorted(run.supports(layer), key=lambda n: abs(n - run.most_loaded(layer)))[:5]
        columns = [f"support_{n}_{layer}_N" for n in sorted(numbers)]
        labels = [f"{layer} {n}" for n in sorted(numbers)]
        draw_lines(row[0], run, columns, [None] * len(labels))
        draw_spectra(row[1], run, columns, labels)
        legend_beside(row[1])
        row[0].set_title(f"what the defect adds to the forces in the {'pads' if layer == 'pad' else layer}, {run.label}; shaded: the defect")
        shade_defects(row[0], run.parameters)
    return figure


def draw_distribution(run: Impact) -> Figure | None:
    if run.dynamic is None or run.twin is None or not run.supports("pad"):
        return None
    layers = [layer for layer in ("pad", "ballast") if run.supports(layer)]
    figure, axes = subplots(1, len(layers), figsize=(2 + 6 * len(layers), 4), squeeze=False)
    for axis, layer in zip(axes[0], layers):
        numbers = run.supports(layer)
        at = 1e3 * run.figures["forces"][f"support_{run.most_loaded(layer)}_{layer}_N"]["peak_position_m"]
        for shift, one, label, colour in ((-0.2, run, "with the defect", RED), (0.2, run.twin, "smooth twin", BLUE)):
            axis.bar(np.array(numbers) + shift, [np.interp(at, one.x, one.force(f"support_{n}_{layer}_N")) for n in numbers], 0.4,
                     color=colour, label=label)
        axis.set(title=f"{layer}, wheel at {at:.1f} mm", xlabel="support, numbered in rolling direction", ylabel="force [kN], + compression", xticks=numbers)
    legend_beside(axes[0, -1])
    return figure


def zimmermann_share(distance: float, spacing: float, length: float) -> float:
    """Force on a support over the wheel's, by the deflection of the beam (Zimmermann 1888); all in m."""
    s = abs(distance) / length
    return spacing / (2 * length) * np.exp(-s) * (np.cos(s) + np.sin(s))


def zimmermann(run: Impact) -> list[tuple[float, dict[int, tuple[float, float]]]] | None:
    """Five most loaded supports of a smooth rail, wheel between two and near one: [(position of the wheel in mm, {support: (share
    of the contact force in its pad, share by Zimmermann)})], or None."""
    run = run.twin or run
    p = run.parameters
    names = ["Track/Sleeper spacing (m)", "Track/Support 0 (mm)", "Track/Pad stiffness (MN per m)", "Rail/Young's modulus (GPa)"]
    if (not run.supports("pad") or "wheel_2_normal_force_N" in run.history or p.get("Track/Foundation") == "rigid" or any(name not in p for name in names)
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
        contact = float(np.interp(at, run.x, run.force(CONTACT)))
        own = {n: float(np.interp(at, run.x, run.force(f"support_{n}_pad_N"))) / contact for n in run.supports("pad")}
        most = sorted(sorted(own, key=lambda n: own[n])[-5:])
        instants.append((at, {n: (own[n], zimmermann_share(1e-3 * (origin - at) + spacing * n, spacing, length)) for n in most}))
    return instants


def draw_zimmermann(run: Impact) -> Figure | None:
    if run.twin is None and extents_of_defects(run.parameters):
        return None
    instants = zimmermann(run)
    if instants is None:
        return None
    figure, axes = subplots(1, 2, figsize=(13, 4), sharey=True)
    for axis, (at, shares) in zip(axes, instants):
        numbers = np.array(list(shares))
        own, theory = np.array(list(shares.values())).T
        axis.bar(numbers - 0.2, own, 0.4, color=BLUE, label="tread")
        axis.bar(numbers + 0.2, theory, 0.4, color=ORANGE, label="Zimmermann")
        most = int(np.argmax(own))
        axis.set(title=f"wheel at {at:.1f} mm; most loaded: {100 * (own[most] / theory[most] - 1):+.1f} %", xlabel="support, numbered in rolling direction",
                 xticks=numbers)
    axes[0].set_ylabel("force in the pad over contact force")
    legend_beside(axes[-1])
    return figure


def zimmermann_table(run: Impact) -> str:
    """What draw_zimmermann() draws, as a table in Markdown. @raises DataError"""
    instants = zimmermann(run)
    if instants is None:
        raise DataError(f"{run.folder}: no supports of a known rail under a single wheel in history.csv and parameters.prm")
    lines = ["| wheel at | support | share of the contact force | Zimmermann | difference |", "|---|---|---|---|---|"]
    for at, shares in instants:
        for n, (own, theory) in shares.items():
            lines.append(f"| {at:.1f} mm | {n} | {100 * own:.2f} % | {100 * theory:.2f} % | {100 * (own / theory - 1):+.1f} % |")
    return "\n".join(lines)


def draw_speeds(runs: Sequence[Impact]) -> Figure | None:
    runs = sorted((run for run in runs if run.dynamic is not None), key=lambda run: run.speed)
    if len(runs) < 2:
        return None
    columns = [(CONTACT, "contact")]
    for layer in ("pad", "ballast"):
        common = set.intersection(*(set(run.supports(layer)) for run in runs))
        if common:
            most = max(common, key=lambda n: max(abs(run.figures["forces"][f"support_{n}_{layer}_N"]["peak_N"]) for run in runs))
            columns += [(f"support_{n}_{layer}_N", f"{layer} {n}") for n in sorted(common & ({most - 1, most} if layer == "pad" else {most}))]
    figure, axes = subplots(2, 2 + (len(columns) > 2), figsize=(8 + 3 * len(columns), 8.5), squeeze=False)
    places = list(axes.flat)
    for (column, label), axis in zip(columns, places):
        for i, run in enumerate(runs):
            draw_lines(axis, run, [column], [run.label], COLOURS[i % len(COLOURS)])
        axis.set_title(label)
        shade_defects(axis, runs[0].parameters)
    spectra, over_speed = places[len(columns)], places[len(columns) + 1]
    for i, run in enumerate(runs):
        draw_spectra(spectra, run, [CONTACT], [f"{run.label}, resolution {run.figures['resolution_Hz']:.0f} Hz"], COLOURS[i % len(COLOURS)])
    spectra.set_title(f"contact, {runs[0].figures['window']} window")
    for i, (column, label) in enumerate(columns):
        over_speed.plot([3.6 * run.speed for run in runs], [1e-3 * abs(run.figures["forces"][column]["peak_N"]) for run in runs], "o-",
                        color=COLOURS[i % len(COLOURS)], label=label)
    over_speed.set(title="peaks", xlabel="speed [km/h]", ylabel="largest dynamic force [kN]")
    for axis in places[:len(columns) + 2]:
        axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=2)
    for axis in places[len(columns) + 2:]:
        axis.remove()
    return figure


def figures(run: Run) -> Iterator[tuple[str, Figure]]:
    """Pictures of a run over a defect or on a track; none of another one."""
    if is_dynamic(run) and run.has("history.csv") and len(run.history["time_s"]) > 1:
        yield from figures_of([Impact(run.folder)])


def figures_of(runs: Sequence[Impact]) -> Iterator[tuple[str, Figure]]:
    """Pictures of the first one, and of all over their speeds."""
    run = runs[0]
    for name, draw in (("contact-force", draw_contact_force), ("impact-patches", draw_patches), ("strip", draw_strip), ("cells", draw_cells),
                       ("residual", draw_residual), ("dynamic-force", draw_dynamic_force), ("supports", draw_supports),
                       ("distribution", draw_distribution), ("zimmermann", draw_zimmermann)):
        figure = draw(run)
        if figure is not None:
            yield name, figure
    figure = draw_speeds(runs)
    if figure is not None:
        yield "speeds", figure
