#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Gain of waves by wear beside a linear model, what its parts are worth, and waves that grow: fills the tables of doc/corrugation.md, copies its pictures.

Runs the scenes by contrib/corrugation.py into folders of RESULTS. Runs that have complete results are not repeated; remove RESULTS to measure anew.
"""

import dataclasses
import os
import shutil
import subprocess
import sys
from dataclasses import replace

import numpy as np

from tread.commands import command_parser, run_command
from tread.corrugation import Model, Waves, gain_at_rest, gain_of_model, responses
from tread.corrugation_runs import Scene
from tread.files import read_summary, read_table
from tread.measured_runs import available_ranks, shipped
from tread.runs import ROOT, must_end_well
from tread.tables import fill, markdown, provenance

SCENE, GROWTH = shipped("damage/corrugation.prm"), shipped("damage/corrugation-growth.prm")
GROWTH_OPTIONS = ["--period", "240", "--shortest", "30", "--longest", "120", "--passages", "20", "--depth", "4", "--ranks", "1"]
WAVES = Waves.draw(0.6, 20e-3, 120e-3, 0.4e-6)  # as the command draws them
DEPTH = 4e-6


class Held(Model):
    """A rail that no traction moves."""
    traction = property(lambda self: 0.)

    def mobility(self, way):
        return np.zeros(len(way.waves.orders))


def run(scene, folder, *options):
    must_end_well(subprocess.run([sys.executable, os.path.join(ROOT, "contrib/corrugation.py"), scene, folder, *options], stderr=subprocess.PIPE, text=True, check=False))


def complex_number(value):
    return f"{value.real:.0f} {'+' if value.imag >= 0 else '-'} {abs(value.imag):.0f}i"


def off(found, expected):
    return 100. * abs(found - expected) / abs(found)


def gain_tables(folder, note):
    scene = Scene(SCENE, folder, {}, available_ranks())
    way, found = scene.way(WAVES), scene.gain(WAVES)
    model, left = scene.model(0.3, WAVES)
    parts = responses(model.contact, WAVES)
    known, at_rest = gain_of_model(model, way, parts), gain_at_rest(parts)
    lengths = WAVES.wavelengths
    fill("corrugation.md", "corrugation-gain", markdown(
        ["wavelength, mm", "frequency, Hz", "force over height, kN/um", "model", "off, %", "gain, 1/m", "model", "off, %", "half-spaces without inertia"],
        [[f"{1e3 * length:.1f}", f"{model.speed / length:.0f}", f"{1e-9 * abs(force):.3f}", f"{1e-9 * abs(of_model):.3f}", f"{off(force, of_model):.1f}",
          complex_number(gain), complex_number(of_model_gain), f"{off(gain, of_model_gain):.1f}", complex_number(rest)]
         for length, force, of_model, gain, of_model_gain, rest in zip(lengths, found.force, known.force, found.gain, known.gain, at_rest)])
        + f"\n\nDifferences are those of the complex numbers. Receptances of the model's track are within {100 * left:.1f} % (RMS) of the cells'. " + note)
    short, long = lengths < 34e-3, lengths > 49e-3
    rms = lambda values, where: float(np.sqrt(np.mean(np.abs((values - found.gain) / found.gain)[where]**2)))
    fields = {field.name: getattr(model, field.name) for field in dataclasses.fields(model)}
    variants = {
        "whole": known.gain, "no compliance of head and wheel": gain_of_model(replace(model, compliance=0.), way, parts).gain,
        "sections do not turn": gain_of_model(replace(model, track=replace(model.track, head=0.)), way, parts).gain,
        "nothing moves along the rail": gain_of_model(Held(**{**fields, "track": replace(model.track, head=0.)}), way, parts).gain,
        "pads and shear factor as given": gain_of_model(replace(model, track=replace(model.track, pad_stiffness=120e6, pad_damping=20e3, shear_factor=0.4)), way, parts).gain,
        "half-spaces without inertia": at_rest}
    fill("corrugation.md", "corrugation-parts", markdown(
        ["model", "up to 33 mm, %", "from 50 mm, %"],
        [[name, f"{100. * rms(gain, short):.1f}", f"{100. * rms(gain, long):.1f}"] for name, gain in variants.items()]) + "\n\n" + note)


def growth_table(folder, note):
    table = read_table(os.path.join(folder, "passages.csv"), ())
    passages = int(table["passage"].max())
    complex_of = lambda name: (table[f"{name}_real_um"] + 1j * table[f"{name}_imaginary_um"]).reshape(passages + 1, -1)
    height, expected = complex_of("height"), complex_of("by_gain")
    lengths = table["wavelength_mm"].reshape(passages + 1, -1)[0]
    rate = lambda waves: (np.abs(waves[-1]) / np.abs(waves[0]))**(1. / passages) - 1.
    fill("corrugation.md", "corrugation-growth", markdown(
        ["wavelength, mm", "before, um", "after 5", "10", "20 passages", "by the gain, after 20", "a passage, %", "by the gain, %"],
        [[f"{length:.1f}", *(f"{abs(height[k, n]):.3f}" for k in (0, 5, 10, passages)), f"{abs(expected[-1, n]):.3f}", f"{100. * rate(height[:, n]):+.1f}",
          f"{100. * rate(expected[:, n]):+.1f}"] for n, length in enumerate(lengths)]) + f"\n\n{1e6 * DEPTH:g} um of mean wear a passage. " + note)


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/corrugation-tables"))
    parser.add_argument("--only", choices=("gain", "growth"), help="the tables of one scene")
    arguments = parser.parse_args()
    for name, scene, options, picture, fill_tables in (("gain", SCENE, (), "gain.png", gain_tables), ("growth", GROWTH, GROWTH_OPTIONS, "passages.png", growth_table)):
        if arguments.only in (None, name):
            folder = os.path.join(arguments.results, name)
            run(scene, folder, *options)
            shutil.copyfile(os.path.join(folder, picture), os.path.join(ROOT, "doc", "pictures", f"corrugation-{name}.png"))
            fill_tables(folder, provenance("benchmarks/corrugation.py", [read_summary(os.path.join(folder, "smooth"))]))


if __name__ == "__main__":
    run_command(main)
