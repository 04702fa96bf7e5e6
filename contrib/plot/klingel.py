#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A free wheelset with both wheels runs back from beside the middle of its track: its wave beside Klingel's.

    klingel.py [--profiles] [--settings NAME=VALUE ...] [--output FOLDER] [--picture klingel.png]

Runs prm/curves/klingel.prm, two minutes on two cores, fits a sine to the lateral shift over the distance rolled, prints its wavelength and
draws shift, yaw and forces. With --profiles it only writes the profiles of prm/curves/profiles anew.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping, Sequence

import numpy as np

from tread.commands import command_parser, run_command
from tread.files import read_table
from tread.plots import BLUE, GREEN, RED, legend_beside, save, subplots, use_style
from tread.runs import ROOT, run

SCENE = "curves/klingel.prm"
CONICITY, CROWN_RADIUS, WHEEL_RADIUS, HALF_DISTANCE = 0.2, 0.3, 0.2, 0.75  # -, m; of the contacts from the middle of the track


def wavelengths() -> dict[str, float]:
    """(m) Klingel's, of two cones on edges (1883); on crowned rails, which raise the conicity; and with the roll that the cones bring with
    them, by which the contacts move across more than the axle does: all without slip, for small shifts (A. H. Wickens, Fundamentals of Rail
    Vehicle Dynamics, 2003, chapter 2)."""
    lever, raised = HALF_DISTANCE - WHEEL_RADIUS * CONICITY, HALF_DISTANCE + CROWN_RADIUS * CONICITY
    squares = {"cones": CONICITY / (HALF_DISTANCE * WHEEL_RADIUS)}
    squares["crowned rails"] = squares["cones"] * raised / lever
    squares["with roll"] = squares["crowned rails"] * lever / HALF_DISTANCE
    return {name: 2. * np.pi / np.sqrt(square) for name, square in squares.items()}


def fitted_wave(x: np.ndarray, y: np.ndarray) -> tuple[float, float, float]:
    """(wavelength, amplitude, rms of the rest) of the sine through y(x) with any phase, m."""
    def fit(wavelength: float) -> tuple[float, float]:
        basis = np.column_stack([np.cos(2. * np.pi * x / wavelength), np.sin(2. * np.pi * x / wavelength)])
        parts, *_ = np.linalg.lstsq(basis, y, rcond=None)
        return np.sqrt(np.mean((basis @ parts - y) ** 2)), np.hypot(*parts)
    best = wavelengths()["with roll"]
    step = 0.5 * best
    while step > 1e-5:
        best = min((best + k * step for k in np.linspace(-0.9, 1., 20)), key=lambda wavelength: fit(wavelength)[0])
        step *= 0.2
    return (best, *fit(best)[::-1])


def write_profiles() -> None:
    """A cone with a flange, and a head whose crown leans as the cone does, both through y = 0."""
    def line(corners: Sequence[tuple[float, float]], spacing: float = 0.5) -> np.ndarray:
        points = np.array(corners)
        along = np.concatenate([[0.], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
        at = np.unique(np.concatenate([along, np.linspace(0., along[-1], int(along[-1] / spacing) + 1)]))
        return np.column_stack([np.interp(at, along, points[:, d]) for d in (0, 1)])
    lean, radius = np.arctan(CONICITY), 1e3 * CROWN_RADIUS
    angle = np.linspace(-30., 30., 241) / radius
    crown = np.column_stack([radius * (np.sin(lean) + np.sin(angle - lean)), radius * (np.cos(angle - lean) - np.cos(lean))])
    crown = crown[crown[:, 0] > -29.9]
    wheel = line([(-70, -10), (-68, -28), (-38, -28), (-36, -36 * CONICITY), (40, 40 * CONICITY)])
    rail = np.vstack([line([(-30., -40.), (-30., crown[0, 1] - 0.5)]), crown, line([crown[-1], (crown[-1, 0], -40.)])[1:]])
    rail[:, 1] -= crown[:, 1].max()
    for name, points, what in (("cone-1-5", wheel, "Wheel: a cone of 0.2 with a flange"), ("crown-1-5", rail, "Rail: a crown of 300 mm that leans by 0.2")):
        with open(os.path.join(ROOT, "prm/curves/profiles", name + ".txt"), "w", encoding="utf-8") as file:
            file.write(f"# {what}: y and z, mm, z up; by contrib/plot/klingel.py --profiles.\n")
            file.writelines(f"{y:.7f} {z:.7f}\n" for y, z in points)


def draw(history: Mapping[str, np.ndarray], wave: float, picture: str) -> None:
    use_style()
    x = history["position_m"] - history["position_m"][0]
    figure, axes = subplots(1, 2, figsize=(14, 3.8))
    axes[0].plot(x, 1e3 * history["lateral_shift_m"], color=BLUE, label="lateral shift [mm]")
    start = history["lateral_shift_m"][0]
    for name, style in (("with roll", "--"), ("cones", ":")):
        length = wavelengths()[name]
        axes[0].plot(x, 1e3 * start * np.cos(2. * np.pi * x / length), color="black", linestyle=style,
                     label=f"no slip, {name}: {length:.2f} m")
    axes[0].plot(x, 1e3 * history["yaw_rad"], color=RED, label="yaw [mrad]")
    axes[0].set(xlabel="rolled distance [m]", title=f"wavelength {wave:.3f} m")
    legend_beside(axes[0])
    own = history["normal_force_N"] - history["other_normal_force_N"]
    axes[1].plot(x, 1e-3 * own, color=BLUE, label="own wheel, vertical")
    axes[1].plot(x, 1e-3 * history["other_normal_force_N"], color=RED, label="other wheel, vertical")
    axes[1].plot(x, 1e-3 * history["longitudinal_force_N"], color=GREEN, label="longitudinal, both")
    axes[1].plot(x, 1e-3 * history["lateral_force_N"], color="black", label="lateral, both")
    axes[1].set(xlabel="rolled distance [m]", ylabel="force on the wheel [kN]")
    legend_beside(axes[1])
    save(figure, picture)


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("--profiles", action="store_true", help="write the profiles and stop")
    parser.add_argument("--settings", nargs="*", default=[], metavar="NAME=VALUE", help="parameters of the scene")
    parser.add_argument("--output", help="folder of the run; default: one that is removed")
    parser.add_argument("--picture", help="default: none")
    arguments = parser.parse_args()
    if arguments.profiles:
        write_profiles()
        return
    with tempfile.TemporaryDirectory() as folder:
        output = arguments.output or os.path.join(folder, "run")
        settings = dict(setting.split("=", 1) for setting in arguments.settings)
        summary = run(SCENE, settings, ranks=2, output=output).summary
        history = {name: np.asarray(values) for name, values in read_table(os.path.join(output, "history.csv")).items()}
    wave, amplitude, rest = fitted_wave(history["position_m"] - history["position_m"][0], history["lateral_shift_m"])
    print(f"wavelength {wave:.4f} m, amplitude {1e3 * amplitude:.4f} mm, rest {1e6 * rest:.2f} um rms")
    for name, length in wavelengths().items():
        print(f"  no slip, {name:<14} {length:.4f} m   {100. * (wave / length - 1.):+.2f} %")
    print(f"energy residual {100. * summary['energy_residual_of_dissipated']:+.3f} % of what was dissipated")
    if arguments.picture:
        draw(history, wave, arguments.picture)


if __name__ == "__main__":
    run_command(main)
