#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Vertical acceleration of the axle box at a defect and its wavelet power over position and frequency, as in figure 4.2.6 of the
thesis.

    axle-box.py RUN [--smooth-twin TWIN] [--band 50 2000] [--from MM] [--to MM] [--output PNG]

Written to RUN, or where --output says: axle-box.png and, beside it, axle-box.json with the dominant frequencies and the shares of
the bands in which squats and welds were measured. Force over acceleration is that of the contact: the unsprung mass where the wheel
moves as one body, and little where it is the wheel itself that vibrates between hub and rim. With a twin the acceleration is that of the run less that of the twin: what the
defect alone does. The twin must be the same scene but for the defect.
"""

from __future__ import annotations

import json
import os

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch as Swatch
from matplotlib.patheffects import Normal, Stroke

from tread.commands import command_parser, run_command
from tread.defects import extent_of_defect
from tread.files import DataError, Error
from tread.plots import BLUE, GREEN, ORANGE, RED, save, subplots, use_style
from tread.runs import Run
from tread.wavelets import NOISE_95, Scalogram, band_pass, evenly_spaced

ACCELERATION, FORCE = "axle_box_acceleration_m_per_s2", "normal_force_N"
# Hz, where measured: squats Molodova et al. (2014), welds An et al. (2017).
BANDS = {"squats, 200-400 Hz": (200, 400), "squats, 1060-1160 Hz": (1060, 1160),
         "welds, 350-500 Hz": (350, 500), "welds, 1000-1200 Hz": (1000, 1200)}
BAND_COLOURS = {"squats": ORANGE, "welds": GREEN}
# Zhao's thesis, section 4.2.4: seen at a squat by a train at 110 km/h; predicted wavelengths at any speed.
MEASURED_HZ, MEASURED_SPEED, WAVELENGTHS_MM = 1500, 110 / 3.6, (20, 40)


def record(run: Run) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times in the middle of the intervals that the rows are means over, positions there in mm; accelerations and contact forces in
    two rows."""
    history = run.table("history.csv", ("time_s", "position_m", ACCELERATION, FORCE))
    time, x = history["time_s"], 1e3 * history["position_m"]
    if len(time) < 16:
        raise DataError(f"{run.path('history.csv')}: fewer than 16 rows")
    middle = lambda values: 0.5 * (values[1:] + values[:-1])
    return middle(time), middle(x), np.array([history[ACCELERATION][1:], history[FORCE][1:]])


def must_be_twins(run: Run, twin: Run) -> None:
    """@raises DataError naming the first parameter that differs and may not."""
    own, other = run.parameters, twin.parameters
    for name in sorted(set(own) | set(other)):
        if own.get(name) != other.get(name) and not name.startswith(("Defect/", "Output/")) and name != "Scene/Title":
            raise DataError(f"{twin.folder} is no twin of {run.folder}: '{name}' is '{other.get(name)}' instead of '{own.get(name)}'")


class AxleBox:
    """Accelerations in m/s2 over positions in mm, band-passed and as a scalogram."""

    def __init__(self, run: Run, twin: Run | None, band: tuple[float, float], begin: float | None, end: float | None):
        self.run, self.twin_run, self.band = run, twin, band
        time, x, own = record(run)
        other = np.zeros_like(own)
        if twin is not None:
            must_be_twins(run, twin)
            twin_time, _, values = record(twin)
            within = (time >= twin_time[0]) & (time <= twin_time[-1])
            time, x, own = time[within], x[within], own[:, within]
            if len(time) < 16:
                raise DataError(f"{twin.folder} ends before {run.folder} begins")
            other = np.array([np.interp(time, twin_time, row) for row in values])
        time, self.x, *rows = evenly_spaced(time, x, *own, *other)
        self.step = time[1] - time[0]
        self.speed = 1e-3 * (self.x[-1] - self.x[0]) / (time[-1] - time[0])
        low, high = band
        if not 0 < low < high <= 0.5 / self.step:
            raise Error(f"--band {low:g} {high:g}: must ascend from above 0 to {0.5 / self.step:.0f} Hz, half of the rows a second")
        chosen = (self.x >= (self.x[0] if begin is None else begin)) & (self.x <= (self.x[-1] if end is None else end))
        if chosen.sum() < 16:
            raise Error(f"--from and --to: {chosen.sum()} rows in between; the run has {self.x[0]:.1f} to {self.x[-1]:.1f} mm")
        self.own, force, self.twin, twin_force = (band_pass(values, self.step, low, high)[chosen] for values in rows)
        self.x = self.x[chosen]
        self.acceleration, self.force = self.own - self.twin, force - twin_force
        self.scalogram = Scalogram(self.acceleration, self.step, low, high)
        self.defect = extent_of_defect(run.parameters)

    def energy_share(self, low: float, high: float) -> float:
        """Of the squared acceleration: what lies between two frequencies."""
        padded = 8 * len(self.acceleration)  # narrow bands contain several frequencies
        energy = abs(np.fft.rfft(self.acceleration, padded)) ** 2
        frequency = np.fft.rfftfreq(padded, self.step)
        return float(energy[(frequency >= low) & (frequency <= high)].sum() / (energy.sum() or 1))

    def dominant(self) -> list[dict]:
        """The maxima of the wavelet power as entries of axle-box.json."""
        force = Scalogram(self.force, self.step, *self.band)
        entries = []
        for f, n, power, amplitude in self.scalogram.maxima():
            k = np.argmin(abs(np.log(self.scalogram.frequency / f)))
            entries.append({"frequency_Hz": float(f), "wavelength_mm": float(1e3 * self.speed / f), "amplitude_m_per_s2": float(amplitude),
                            "position_mm": float(self.x[n]), "behind_leading_edge_mm": float(self.x[n] - self.defect[0]) if self.defect else None,
                            "power_over_white_noise": float(power),
                            "force_over_acceleration_kg": float(force.amplitude[k, n] / self.scalogram.amplitude[k, n])})
        return entries

    def figures(self) -> dict:
        """What axle-box.json has."""
        wavelengths = [1e3 * self.speed / length for length in WAVELENGTHS_MM[::-1]]
        most = int(np.argmax(abs(self.acceleration)))
        return {
            "run": os.path.basename(os.path.normpath(self.run.folder)),
            "smooth_twin": None if self.twin_run is None else os.path.basename(os.path.normpath(self.twin_run.folder)),
            "speed_km_per_h": 3.6 * self.speed, "band_Hz": list(self.band), "from_mm": self.x[0], "to_mm": self.x[-1],
            "defect_mm": self.defect, "rms_m_per_s2": float(np.sqrt(np.mean(self.acceleration**2))),
            "largest_m_per_s2": float(self.acceleration[most]), "largest_at_mm": float(self.x[most]),
            "dominant": self.dominant(),
            "energy_share": {**{name: self.energy_share(*band) for name, band in BANDS.items()},
                             f"wavelengths of 20 to 40 mm, {wavelengths[0]:.0f}-{wavelengths[1]:.0f} Hz": self.energy_share(*wavelengths)}}


def text_of(figures: dict) -> str:
    """The figures as tables."""
    lines = [f"{figures['speed_km_per_h']:.1f} km/h, {figures['band_Hz'][0]:g} to {figures['band_Hz'][1]:g} Hz: RMS {figures['rms_m_per_s2']:.3g} m/s2, "
             f"largest {figures['largest_m_per_s2']:.4g} m/s2 at {figures['largest_at_mm']:.1f} mm", "",
             "| frequency, Hz | wavelength, mm | amplitude, m/s2 | at, mm | behind the leading edge, mm | power over white noise "
             "| contact force over acceleration, kg |", "|---|---|---|---|---|---|---|"]
    for i, line in enumerate(figures["dominant"]):
        behind = line["behind_leading_edge_mm"]
        lines.append(f"| {line['frequency_Hz']:.0f} | {line['wavelength_mm']:.1f} | {line['amplitude_m_per_s2']:.1f} | {line['position_mm']:.1f} "
                     f"| {'-' if behind is None else format(behind, '.1f')} | {line['power_over_white_noise']:.1f} "
                     f"| {line['force_over_acceleration_kg']:.0f} |")
    lines += ["", "| band | share of the squared acceleration |", "|---|---|"]
    lines += [f"| {name} | {100 * share:.1f} % |" for name, share in figures["energy_share"].items()]
    return "\n".join(lines)


def label_maxima(figure: Figure, axis: Axes, dominant: list[dict]) -> None:
    """Frequency and wavelength at each maximum, where they cover neither another label nor another maximum."""
    figure.canvas.draw()  # lays out the axes, which labels are measured in
    points = [axis.transData.transform((line["position_mm"], line["frequency_Hz"])) for line in dominant]
    placed = []
    for point, line in zip(points, dominant):
        for dx, dy in ((7, 4), (7, -12), (7, 14), (7, -22), (-7, 4), (-7, -12)):
            label = axis.annotate(f"{line['frequency_Hz']:.0f} Hz, {line['wavelength_mm']:.0f} mm", (line["position_mm"], line["frequency_Hz"]),
                                  xytext=(dx, dy), textcoords="offset points", ha="left" if dx > 0 else "right", fontsize=8, color="white",
                                  weight="bold", path_effects=[Stroke(linewidth=1.5, foreground="#00000080"), Normal()])
            extent = label.get_window_extent()
            if (axis.bbox.contains(*extent.min) and axis.bbox.contains(*extent.max) and not any(extent.overlaps(other) for other in placed)
                    and not any(extent.padded(5).contains(*other) for other in points if other is not point)):
                break
            label.remove()
        else:
            continue
        placed.append(extent)


def draw(box: AxleBox, figures: dict) -> Figure:
    use_style()
    figure, axes = subplots(2, 2, figsize=(12, 7), sharex="col", sharey="row", width_ratios=(4, 1.2), height_ratios=(1, 1.6))
    above, map_axis, beside = axes[0, 0], axes[1, 0], axes[1, 1]
    axes[0, 1].axis("off")
    beside.xaxis.set_tick_params(labelbottom=True)
    scalogram = box.scalogram
    if box.twin_run is not None:
        above.plot(box.x, box.twin, color=ORANGE, label="smooth twin")
    above.plot(box.x, box.own, color=BLUE, label="with the defect" if box.defect else "axle box")
    above.set(ylabel="acceleration [m/s$^2$], + up", title=f"axle box at {3.6 * box.speed:.0f} km/h, {box.band[0]:g} to {box.band[1]:g} Hz")

    # Half octaves of power: what stands out and what is still there.
    top = float(np.max(scalogram.power, initial=4))
    levels = 2.0 ** np.arange(-2, np.log2(top) + 0.5, 0.5)
    filled = map_axis.contourf(box.x, scalogram.frequency, scalogram.power, levels=levels, cmap="viridis", extend="both",
                               norm=LogNorm(levels[0], levels[-1]))
    map_axis.contour(box.x, scalogram.frequency, scalogram.power, levels=[NOISE_95], colors="white", linewidths=0.9)
    cone = np.clip(scalogram.edge, scalogram.frequency[0], scalogram.frequency[-1])
    map_axis.fill_between(box.x, scalogram.frequency[0], cone, facecolor="#FFFFFF80", edgecolor="white", hatch="//", lw=0)
    for line in figures["dominant"]:
        map_axis.plot(line["position_mm"], line["frequency_Hz"], "o", color=RED, ms=5, mec="white")
    legend = []
    for name, (low, high) in BANDS.items():
        colour = BAND_COLOURS[name.split(",")[0]]
        beside.axhspan(low, high, color=colour, alpha=0.3, lw=0)
        legend.append(Swatch(fc=colour, alpha=0.3, label=name))
    if abs(box.speed / MEASURED_SPEED - 1) < 0.02:
        for axis in (map_axis, beside):
            axis.axhline(MEASURED_HZ, color=RED, ls="--", lw=1.2)
        legend.append(Line2D([], [], color=RED, ls="--", lw=1.2, label=f"thesis: measured at\na squat, {MEASURED_HZ} Hz"))
    ticks = [f for f in (20, 50, 100, 200, 300, 500, 700, 1000, 1500, 2000, 3000, 5000) if box.band[0] <= f <= box.band[1]]
    map_axis.set_yscale("log")
    map_axis.set_yticks(ticks, [str(f) for f in ticks])
    map_axis.minorticks_off()
    what = "what the defect adds: run less twin" if box.twin_run is not None else "wavelet power"
    map_axis.set(xlabel="position of the wheel on the rail [mm]", ylabel="frequency [Hz]", title=f"{what}; hatched: disturbed by the ends")
    if box.defect is not None:
        begin, end = box.defect
        for axis, colour in ((above, RED), (map_axis, "white")):
            if end is not None:
                axis.axvspan(begin, end, color=RED, alpha=0.13, lw=0)
            for edge in (begin, end):
                if edge is not None:
                    axis.axvline(edge, color=colour, ls=":", lw=1.3)
        above.annotate("defect", (begin if end is None else 0.5 * (begin + end), 1), xycoords=("data", "axes fraction"), xytext=(0, -10),
                       textcoords="offset points", ha="center", fontsize=9, color=RED)
    above.legend(loc="upper left")
    above.set_xlim(box.x[0], box.x[-1])
    beside.plot(scalogram.global_spectrum(), scalogram.frequency, color=BLUE)
    beside.axvline(1, color="black", ls=":", lw=1)
    beside.set(xlabel="mean power", title="whole record", xlim=(0, None), ylim=box.band)
    axes[0, 1].legend(handles=legend, loc="lower left", title="published bands", borderaxespad=0)
    figure.colorbar(filled, ax=map_axis, orientation="horizontal", aspect=50, pad=0.02,
                    ticks=[t for t in 2.0 ** np.arange(-2, 12) if levels[0] <= t <= levels[-1]], format="%g",
                    label="power over that of white noise of the same variance; white line: above 95 % of noise")
    label_maxima(figure, map_axis, figures["dominant"])
    return figure


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("run", metavar="RUN")
    parser.add_argument("--smooth-twin", metavar="TWIN")
    parser.add_argument("--band", nargs=2, type=float, default=(50, 2000), metavar=("LOW", "HIGH"), help="Hz; default 50 2000")
    parser.add_argument("--from", dest="begin", type=float, metavar="MM", help="where the evaluated section begins")
    parser.add_argument("--to", dest="end", type=float, metavar="MM", help="and ends")
    parser.add_argument("--output", metavar="PNG", help="default: axle-box.png in RUN")
    arguments = parser.parse_args()
    box = AxleBox(Run(arguments.run), arguments.smooth_twin and Run(arguments.smooth_twin), arguments.band, arguments.begin, arguments.end)
    picture = arguments.output or box.run.path("axle-box.png")
    figures = box.figures()
    save(draw(box, figures), picture)
    with open(os.path.splitext(picture)[0] + ".json", "w", encoding="utf-8") as stream:
        json.dump(figures, stream, indent=2)
    print(text_of(figures))


if __name__ == "__main__":
    run_command(main)
