#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What wear adds to waves: force and gain of a heavy wheel on a track that is one mass, beside springs, masses and half-spaces; passage after passage; what is refused."""

import contextlib
import io
import math
import os
import sys
import tempfile

import numpy as np

from tread import corrugation
from tread.corrugation_runs import Scene, expected_passages, wear_passages
from tread.files import DataError, read_table
from tread_runner import Check, ROOT, script

check = Check()
SCENE = os.path.join(ROOT, "prm/damage/corrugation-growth.prm")
SPEED, START, ROLLED, PERIOD, DEPTH = 250., -80., 175., 80e-3, 2e-6
SETTINGS = {"Motion/Speed (km per h)": SPEED, "Motion/Start (mm)": START, "Motion/Rolled distance (mm)": ROLLED,
            "Wheel/Mass (kg)": 5000, "Vehicle/Sprung mass (kg)": 5197, "Track/Co-running mass (kg)": 5000}  # which hardly move


def said(*arguments):
    """Exit code and what the command writes on standard error."""
    ended = script("corrugation.py", *arguments)
    return ended.returncode, ended.stderr.strip()


with tempfile.TemporaryDirectory() as folder:
    results = os.path.join(folder, "results")
    options = ["--period", "80", "--shortest", "40", "--longest", "80", "--ranks", "1", "--height", "0.5"]
    settings = [part for name, value in SETTINGS.items() for part in ("-s", f"{name}={value}")]
    code, text = said(SCENE, results, *settings, *options, "--passages", "2", "--depth", f"{1e6 * DEPTH:g}")
    check.that(f"the command ends well: {text}", code == 0)
    check.that("pictures", all(os.path.getsize(os.path.join(results, name)) > 10000 for name in ("gain.png", "passages.png")))

    waves = corrugation.Waves.draw(PERIOD, 40e-3, 80e-3, 0.5e-6)
    scene = Scene(SCENE, results, SETTINGS, 1)
    with contextlib.redirect_stdout(io.StringIO()):  # the runs are there
        gain, expected = scene.gain(waves), expected_passages(scene, waves, DEPTH, 2)
        found = np.array(list(wear_passages(scene, waves, DEPTH, 2)))
    table = read_table(os.path.join(results, "gain.csv"), ())
    check.relative("wavelengths, mm", float(table["wavelength_mm"].sum()), 120., 1e-9)
    check.relative("frequency of the longer, Hz", float(table["frequency_Hz"][0]), SPEED / 3.6 / PERIOD, 1e-5)
    for name, values in (("gain_real_per_m", gain.gain.real), ("gain_imaginary_per_m", gain.gain.imag), ("force_real_N_per_m", gain.force.real),
                         ("force_imaginary_N_per_m", gain.force.imag)):
        check.below(f"gain.csv: {name}", float(np.abs(table[name] - values).max() / np.abs(values).max()), 1e-5)

    # Known: Hertz's spring between the wheel and the base with the rail's mass, both above their resonance. The block and the sector are less compliant than the
    # half-spaces of Hertz's theory, by about an eighth.
    known = scene.parameters
    number = lambda name: float(known[name])
    load = 9.81 * (number("Wheel/Mass (kg)") + number("Vehicle/Sprung mass (kg)"))
    contact = corrugation.Contact(0.5 / 0.46, 0.5 / 0.3, load, 0.3, -0.01)
    parts = corrugation.responses(contact, waves)
    turning = 2. * math.pi * SPEED / 3.6 / waves.wavelengths
    spring = 1.5 * contact.stiffness**(2. / 3.) * load**(1. / 3.)
    base = 1. / (number("Track/Vertical stiffness (MN per m)") * 1e6 + 1j * turning * 1e3 * number("Track/Vertical damping (kN s per m)")
                 - turning**2 * number("Track/Co-running mass (kg)"))
    force = -parts["heights"].approach / (1. / spring + base - 1. / (number("Wheel/Mass (kg)") * turning**2))
    for n, length in enumerate(waves.wavelengths):
        name = f"{1e3 * length:g} mm: "
        check.below(name + "contact force over roughness, off springs and masses", abs(gain.force[n] / force[n] - 1.), 0.2)
        # With the force that was found: heights and load of half-spaces.
        by_parts = -(parts["heights"].work[n] + parts["load"].work[n] * gain.force[n])
        check.below(name + "gain, off half-spaces under that force", abs(gain.gain[n] / by_parts - 1.), 0.08)

    # A passage changes waves by their gain and by what it wears into a smooth rail: the first by definition, the second as it is linear.
    check.below("first passage, um", 1e6 * float(np.abs(found[1] - expected[1]).max()), 1e-4)
    change = np.abs(found[2] - found[1]).max()
    check.below("second passage, off the gain, over its change", float(np.abs(found[2] - expected[2]).max() / change), 0.05)
    rows = read_table(os.path.join(results, "passages.csv"), ())
    check.relative("passages.csv: rows", float(len(rows["passage"])), 6., 0.)
    for column, values in (("height_real_um", found.real), ("height_imaginary_um", found.imag), ("by_gain_real_um", expected.real), ("by_gain_imaginary_um", expected.imag)):
        check.below(f"passages.csv: {column}", float(np.abs(rows[column] - 1e6 * values.ravel()).max()), 1e-5)

    # What is refused, before anything is run.
    for what, word, arguments in (
            ("waves that do not divide the period", "divides", ["--period", "80", "--shortest", "50", "--longest", "60"]),
            ("a height of nothing", "--height", ["--height", "0"]),
            ("a way that is too short", "must begin at", [*settings, "--period", "160", "--shortest", "40", "--longest", "80"]),
            ("a period that is no number", "--period", ["--period", "inf"]),
            ("passages before the first", "--passages", ["--passages", "-1"]),
            ("no rank", "--ranks", ["--ranks", "0"]),
            ("waves shorter than six cells", "need cells of at most", [*settings, "--period", "80", "--shortest", "10", "--longest", "80"]),
            ("a defect of the scene's own", "defect of its own", [*settings, "-s", "Defect/Shape=corrugation", "-s", "Defect/Wavelength (mm)=40", "-s", "Defect/Depth (mm)=0.01",
                                                                  "-s", "Defect/Length (mm)=80", "-s", "Defect/Lateral law=uniform", "--period", "80", "--shortest", "40", "--longest", "80"]),
            ("a setting that is none", "SECTION/NAME=VALUE", ["-s", "Motion"]),
            ("a parameter that is none", "Motion/Sped", ["-s", "Motion/Sped=3"])):
        code, text = said(SCENE, os.path.join(folder, "refused"), *arguments)
        check.that(f"{what}: {text}", code != 0 and word in text and "\n" not in text)
    try:
        list(wear_passages(scene, waves, 1e-3, 1))
        text = ""
    except DataError as error:
        text = str(error)
    check.that(f"a depth that turns waves over: {text}", "smaller depth" in text)

check.exit()
