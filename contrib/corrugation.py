#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the wear of a passage adds to small waves of the rail, wavelength by wavelength, and passage after passage.

    contrib/corrugation.py SCENE RESULTS [--passages N --depth UM]

The scene rolls over small waves of drawn phases and over the smooth rail. RESULTS/gain.csv and gain.png have the gain: the height that each micrometre of mean
wear adds to a wave, for each micrometre of its own height; beside it a linear model, where the scene is one that it describes (doc/corrugation.md).
With --passages the surface is worn after each passage, by a mean depth of --depth, and rolled over again: passages.csv and passages.png.
Runs that have complete results are not repeated.
"""

import csv
import math
import os

import numpy as np

from tread.commands import command_parser, run_command
from tread.corrugation import Waves, gain_at_rest, gain_of_model, responses
from tread.corrugation_runs import Scene, expected_passages, wear_passages
from tread.files import DataError
from tread.measured_runs import available_ranks
from tread.plots import BLUE, GREY, ORANGE, RED, save, subplots, use_style


def settings_in(pairs):
    """{name: value}. @raises DataError"""
    for pair in pairs:
        if "=" not in pair:
            raise DataError(f"-s {pair}: is no SECTION/NAME=VALUE")
    return dict(pair.split("=", 1) for pair in pairs)


def write(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, lineterminator="\n").writerows([header, *([f"{value:.6g}" for value in row] for row in rows)])
    print(path)


def write_gain(scene, waves, crown):
    """gain.csv and gain.png."""
    speed = float(scene.parameters["Motion/Speed (km per h)"]) / 3.6
    length = waves.wavelengths
    of = {"gain": scene.gain(waves)}
    try:
        model, left = scene.model(crown, waves)
        print(f"track of the model: pads {1e-6 * model.track.pad_stiffness:.3g} MN/m and {1e-3 * model.track.pad_damping:.3g} kNs/m, shear factor "
              f"{model.track.shear_factor:.3f}; its receptances are within {100 * left:.2g} % (RMS) of the cells'")
        parts = responses(model.contact, waves)
        of["model"], at_rest = gain_of_model(model, scene.way(waves), parts), gain_at_rest(parts)
    except DataError as error:
        print(f"no model beside it: {error}")
        at_rest = None
    columns = {"wavelength_mm": 1e3 * length, "frequency_Hz": speed / length}
    for name, found in of.items():
        prefix = "" if name == "gain" else f"{name}_"
        columns.update({f"{prefix}gain_real_per_m": found.gain.real, f"{prefix}gain_imaginary_per_m": found.gain.imag,
                        f"{prefix}force_real_N_per_m": found.force.real, f"{prefix}force_imaginary_N_per_m": found.force.imag})
    if at_rest is not None:
        columns.update({"at_rest_gain_real_per_m": at_rest.real, "at_rest_gain_imaginary_per_m": at_rest.imag})
    write(os.path.join(scene.results, "gain.csv"), list(columns), zip(*columns.values()))
    use_style()
    figure, axes = subplots(3, figsize=(9, 9), sharex=True)
    for name, found, mark, colour in (("finite elements", of["gain"], "o-", BLUE), ("linear model", of.get("model"), "--", RED)):
        if found is not None:
            axes[0].plot(1e3 * length, 1e-3 * found.gain.real, mark, color=colour, ms=4, label=name)
            axes[1].plot(1e3 * length, 1e-3 * found.gain.imag, mark, color=colour, ms=4)
            axes[2].plot(1e3 * length, 1e-9 * np.abs(found.force), mark, color=colour, ms=4)
    if at_rest is not None:
        axes[0].plot(1e3 * length, 1e-3 * at_rest.real, ":", color=GREY, label="half-spaces without inertia")
        axes[1].plot(1e3 * length, 1e-3 * at_rest.imag, ":", color=GREY)
    axes[0].axhline(0., color="black", lw=0.8)
    axes[0].legend()
    axes[0].set(ylabel="grows [1/mm of wear]", title=f"what wear adds to waves, over their height, at {3.6 * speed:.4g} km/h")
    axes[1].set(ylabel="moves along [1/mm of wear]")
    axes[2].set(ylabel="contact force over\nroughness [kN/um]", xlabel="wavelength [mm]")
    other = axes[0].secondary_xaxis("top", functions=(lambda x: 1e3 * speed / np.maximum(x, 1e-9), lambda f: 1e3 * speed / np.maximum(f, 1e-9)))
    frequencies = np.array([50, 75, 100, 150, 200, 300, 400, 600, 1000, 2000, 4000])
    other.set_xticks(frequencies[(frequencies >= columns["frequency_Hz"].min()) & (frequencies <= columns["frequency_Hz"].max())])
    other.set_xlabel("frequency [Hz]")
    save(figure, os.path.join(scene.results, "gain.png"))


def write_passages(scene, waves, depth, passages):
    """passages.csv and passages.png."""
    expected = expected_passages(scene, waves, depth, passages)
    found = np.array(list(wear_passages(scene, waves, depth, passages)))
    rows = [(passage, 1e3 * length, 1e6 * here.real, 1e6 * here.imag, 1e6 * there.real, 1e6 * there.imag)
            for passage in range(passages + 1) for length, here, there in zip(waves.wavelengths, found[passage], expected[passage])]
    write(os.path.join(scene.results, "passages.csv"), ["passage", "wavelength_mm", "height_real_um", "height_imaginary_um", "by_gain_real_um", "by_gain_imaginary_um"], rows)
    use_style()
    figure, axes = subplots(2, figsize=(9, 7))
    strongest = np.argsort(-np.abs(found[-1]))[:4]
    for n, colour in zip(strongest, (BLUE, RED, ORANGE, GREY)):
        axes[0].plot(1e6 * np.abs(found[:, n]), "o-", ms=4, color=colour, label=f"{1e3 * waves.wavelengths[n]:.3g} mm")
        axes[0].plot(1e6 * np.abs(expected[:, n]), "--", color=colour)
    axes[0].legend(title="dashed: by the gain")
    axes[0].set_xticks(np.unique(np.linspace(0, passages, min(passages, 10) + 1).astype(int)))
    axes[0].set(xlabel=f"passages of {1e6 * depth:g} um mean wear", ylabel="height of the wave [um]", title="waves that are highest in the end")
    places = np.linspace(scene.begin, scene.begin + waves.period, 1201)
    for passage, colour in ((0, GREY), (passages, BLUE)):
        worn = Waves(waves.period, waves.orders, found[passage])
        axes[1].plot(1e3 * places, 1e6 * worn.heights(places), color=colour, lw=1, label=f"after {passage}" if passage else "before")
    axes[1].legend()
    axes[1].set(xlabel="along the rail [mm]", ylabel="height [um]")
    save(figure, os.path.join(scene.results, "passages.png"))


def main():
    parser = command_parser(__doc__)
    parser.add_argument("scene", metavar="SCENE")
    parser.add_argument("results", metavar="RESULTS")
    parser.add_argument("-s", "--set", dest="settings", action="append", default=[], metavar="SECTION/NAME=VALUE", help="another value of the scene")
    parser.add_argument("--period", type=float, default=600., metavar="MM", help="that holds a whole number of each wave (600): the distance of the sleepers")
    parser.add_argument("--shortest", type=float, default=20., metavar="MM", help="wavelength (20)")
    parser.add_argument("--longest", type=float, default=120., metavar="MM", help="wavelength (120)")
    parser.add_argument("--height", type=float, default=0.4, metavar="UM", help="amplitude of each wave (0.4)")
    parser.add_argument("--seed", type=int, default=1, help="of the phases (1)")
    parser.add_argument("--begin", type=float, default=0., metavar="MM", help="place of the period that is looked at (0)")
    parser.add_argument("--half-width", type=float, default=2.5, metavar="MM", help="of the strip in which wear is looked at (2.5)")
    parser.add_argument("--crown", type=float, default=300., metavar="MM", help="radius of the rail's crown, for the model (300)")
    parser.add_argument("--passages", type=int, default=0, metavar="N", help="that wear the surface one after the other")
    parser.add_argument("--depth", type=float, default=5., metavar="UM", help="mean wear of each of them (5)")
    parser.add_argument("--ranks", type=int, default=available_ranks())
    arguments = parser.parse_args()
    for name in ("period", "shortest", "longest", "height", "half_width", "crown", "depth"):
        if not 0. < getattr(arguments, name) < math.inf:
            raise DataError(f"--{name.replace('_', '-')} must be a number above 0")
    for name, least in (("passages", 0), ("seed", 0), ("ranks", 1)):
        if getattr(arguments, name) < least:
            raise DataError(f"--{name} must be {least} or more")
    if not math.isfinite(arguments.begin):
        raise DataError("--begin must be a number")
    waves = Waves.draw(1e-3 * arguments.period, 1e-3 * arguments.shortest, 1e-3 * arguments.longest, 1e-6 * arguments.height, arguments.seed)
    scene = Scene(arguments.scene, arguments.results, settings_in(arguments.settings), arguments.ranks, 1e-3 * arguments.half_width, 1e-3 * arguments.begin)
    write_gain(scene, waves, 1e-3 * arguments.crown)
    if arguments.passages:
        write_passages(scene, waves, 1e-6 * arguments.depth, arguments.passages)


if __name__ == "__main__":
    run_command(main)
