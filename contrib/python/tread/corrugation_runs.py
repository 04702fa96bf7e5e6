# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of a scene over small waves: the gain of each wavelength, and passage after passage with what each wears. See corrugation.py. SI units."""

from __future__ import annotations

import functools
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .corrugation import Contact, Gain, Model, Waves, Way, fitted, gain_of_runs, work_along
from .files import DataError
from .flat_force import Track
from .measured_runs import run_scene
from .runs import Run, arguments_of, execute, must_end_well, parameters_of, scene_path

BEFORE, BEHIND = 20e-3, 50e-3  # the waves begin behind the wheel's start, and end behind the end of its way
DISC = 15e-3  # radius of the disc in which `tread modes` measures
OF_MODES = 0.6  # m of absorbing ends for `tread modes` of scenes with endless ones
PATCH = 10e-3  # what a place needs before and behind it to be passed by all of the patch


def is_number(text: str) -> bool:
    try:
        return np.isfinite(float(text))
    except ValueError:
        return False


def indentation(young: float, poisson: float) -> float:
    """Of a half-space by an even pressure over the disc, mean over it, over the force (Johnson 1985, section 3.4), m/N."""
    return 16. * (1. - poisson**2) / (3. * np.pi**2 * young * DISC)


@dataclass(frozen=True)
class Scene:
    """A scene, how it is run, and in which strip |y| <= half_width and from which place on its wear is looked at."""
    path: str
    results: str
    settings: Mapping[str, object]
    ranks: int
    half_width: float = 2.5e-3
    begin: float = 0.

    @functools.cached_property
    def parameters(self) -> dict[str, str]:
        return parameters_of(self.path, {name: str(value) for name, value in self.settings.items()})

    def run(self, name: str, waves: Mapping[str, object]) -> Run:
        """Unless its results are there."""
        folder = os.path.join(self.results, name)
        run_scene(os.path.abspath(scene_path(self.path)), folder, {**self.settings, "Damage/Record": "true", "Output/History interval (mm)": 0.5, **waves}, self.ranks)
        return Run(folder)

    def way(self, waves: Waves) -> Way:
        """@raises DataError of scenes with a defect of their own, of waves with less than six cells, and where the wheel does not roll over a period and what it needs
        before and behind"""
        known = self.parameters
        if known["Defect/Shape"] != "none":
            raise DataError(f"{self.path}: has a defect of its own, in whose place the waves would be: set Defect/Shape=none")
        cell = 1e-3 * max(float(known[f"Mesh/{name} cell (mm)"]) for name in ("Finest", "Path"))
        if waves.wavelengths.min() < 6. * cell:
            raise DataError(f"{self.path}: waves of {1e3 * waves.wavelengths.min():.4g} mm need cells of at most {1e3 * waves.wavelengths.min() / 6.:.4g} mm; "
                            f"they have {1e3 * cell:g} mm")
        rolled = 1e-3 * float(known["Motion/Rolled distance (mm)"])
        start = -rolled if known["Motion/Start (mm)"] == "automatic" else 1e-3 * float(known["Motion/Start (mm)"])
        way = Way(waves, start + BEFORE, start + rolled + BEHIND, self.begin)
        if way.first + way.ramp > way.begin or start + rolled < way.begin + waves.period + PATCH:
            raise DataError(f"{self.path}: the wheel rolls from {1e3 * start:g} to {1e3 * (start + rolled):g} mm; it must begin at "
                            f"{1e3 * (way.begin - BEFORE - way.ramp):g} mm or before, and roll to {1e3 * (way.begin + waves.period + PATCH):g} mm or further")
        return way

    def over_waves(self, name: str, way: Way) -> Run:
        os.makedirs(self.results, exist_ok=True)
        return self.run(name, way.settings(os.path.join(self.results, f"{name}.txt")))

    def smooth(self) -> Run:
        return self.run("smooth", {"Defect/Shape": "none"})

    def gain(self, waves: Waves) -> Gain:
        way = self.way(waves)
        return gain_of_runs(way, self.over_waves("waves", way), self.smooth(), self.half_width)

    def receptances(self, places: Sequence[float], highest: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(frequencies, (places, n) complex of the rail, (n,) of the wheel less that of its mass) in m/N, by `tread modes` under a wheel at each place; the
        indentation of half-spaces by its disc is taken off."""
        known = self.parameters
        by_disc = {body: indentation(1e9 * float(known[f"{body}/Young's modulus (GPa)"]), float(known[f"{body}/Poisson's ratio"])) for body in ("Rail", "Wheel")}
        rail = []
        for place in places:
            folder = os.path.join(self.results, f"modes-{round(1e3 * place)}")
            settings = {**self.settings, "Motion/Start (mm)": 1e3 * place, "Motion/Rolled distance (mm)": 10, "Damage/Record": "false",
                        "Mesh/Path cell (mm)": 0, "Mesh/Longest row (mm)": 60}
            if known["Rail/Ends"] == "endless":  # waves that leave have no modes
                settings |= {"Rail/Ends": "absorbing", "Rail/Absorbing length (m)": OF_MODES}
            must_end_well(execute([*arguments_of(self.path, settings, folder, "modes"), "--up-to", f"{1.2 * highest:.0f}"], self.ranks))
            table = Run(folder).table("receptance.csv")
            complex_of = lambda body: table[f"{body}_magnitude_m_per_N"] * np.exp(1j * np.radians(table[f"{body}_phase_degrees"]))
            rail.append(complex_of("rail") - by_disc["Rail"])
        frequency, mass = table["frequency_Hz"], float(known["Wheel/Mass (kg)"])
        return frequency, np.array(rail), complex_of("wheel") + 1. / (mass * (2. * np.pi * frequency)**2) - by_disc["Wheel"]

    def model(self, crown: float, waves: Waves) -> tuple[Model, float]:
        """(model, relative difference of its track's receptances from those of the cells) of a cylindrical wheel that slides with a given creepage on a rail on
        pads and rigid sleepers. @raises DataError of other scenes"""
        known = self.parameters
        needed = {"Track/Foundation": "two-layer", "Track/Sleepers": "mass", "Track/Points along": "1", "Rail/Profile": "60E1", "Rail/Inclination": "none",
                  "Wheel/Tread profile": "cylinder", "Motion/Drive": "creepage", "Scene/Quasi-static": "false"}
        other = [f"{name}={known[name]}" for name, value in needed.items() if known[name] != value]
        other += [f"{name}={known[name]}" for name in ("Motion/Creepage", "Rail/Begin (mm)", "Motion/Start (mm)") if not is_number(known[name])]
        steel = [known[f"{body}/{name}"] for name in ("Young's modulus (GPa)", "Poisson's ratio", "Yield stress (MPa)") for body in ("Rail", "Wheel")]
        if steel[::2] != steel[1::2] or steel[-1] != "0":
            other.append("unlike steels, or steel that yields")
        if known["Motion/Creepage"] in ("0", "0.0"):
            other.append("Motion/Creepage=0, with which nothing wears")
        if other:
            raise DataError(f"{self.path}: the linear model needs {', '.join(f'{name}={value}' for name, value in needed.items())}, and numbers for the "
                            f"creepage and where rail and wheel begin; the scene has {', '.join(other)}")
        number = lambda name: float(known[name])
        spacing = number("Track/Sleeper spacing (m)")
        begin, support = 1e-3 * number("Rail/Begin (mm)"), 1e-3 * number("Track/Support 0 (mm)")
        spans = round(1e-3 * number("Rail/Length (mm)") / spacing)
        if abs((support - begin) / spacing % 1. - 0.5) > 1e-6 or abs(1e-3 * number("Rail/Length (mm)") / spacing - spans) > 1e-6:
            raise DataError(f"{self.path}: the linear model needs a rail that begins and ends in the middle of a span")
        middle = begin + spacing * (spans // 2 + 0.5)
        young, poisson = 1e9 * number("Rail/Young's modulus (GPa)"), number("Rail/Poisson's ratio")
        absorbing = {"absorbing": number("Rail/Absorbing length (m)"), "endless": OF_MODES}.get(known["Rail/Ends"], 0.)
        track = Track(young=young, poisson=poisson, density=number("Rail/Density (kg per m3)"), spacing=spacing, spans=spans, half_ends=True, absorbing=absorbing,
                      pad_stiffness=1e6 * number("Track/Pad stiffness (MN per m)"), pad_damping=1e3 * number("Track/Pad damping (kN s per m)"),
                      sleeper_mass=number("Track/Sleeper mass (kg)"), ballast_stiffness=1e6 * number("Track/Ballast stiffness (MN per m)"),
                      ballast_damping=1e3 * number("Track/Ballast damping (kN s per m)"))
        speed, mass = number("Motion/Speed (km per h)") / 3.6, number("Wheel/Mass (kg)")
        highest = speed / waves.wavelengths.min()
        frequency, rail, wheel = self.receptances((middle - 0.5 * spacing, middle), highest)
        looked_at = (frequency > 0.7 * speed / waves.wavelengths.max()) & (frequency < 1.1 * highest)
        if not looked_at.any():
            raise DataError(f"{self.path}: `tread modes` has no frequencies of these waves")
        some = np.flatnonzero(looked_at)[::max(1, looked_at.sum() // 30)]
        track, compliance, left = fitted(track, (-0.5 * spacing, 0.), frequency[some], rail[:, some])
        if known["Rail/Ends"] == "endless":
            track = replace(track.endless(int(known["Rail/Spans beyond"])), stiffness_along=1e6 * number("Track/Stiffness along the rail (MN per m)"))
        load = number("Vehicle/Gravity (m per s2)") * (mass + number("Vehicle/Sprung mass (kg)"))
        contact = Contact(0.5e3 / number("Wheel/Radius (mm)"), 0.5 / crown, load, number("Contact/Friction coefficient"), -number("Motion/Creepage"),
                          young, poisson, half_width=self.half_width)
        return Model(contact, track, speed, mass, 1e-3 * number("Motion/Start (mm)"), middle, compliance + float(wheel.real[some].mean())), left


def worn(scene: Scene, way: Way, run: Run, depth: float) -> np.ndarray:
    """(n,) complex: what a passage that wears the rail by a mean depth adds to each wave."""
    places, work = work_along(run, scene.half_width)
    return -depth * way.found_in(places, work) / work[way.looked_at(places)].mean()


def wear_passages(scene: Scene, waves: Waves, depth: float, passages: int) -> Iterator[np.ndarray]:
    """(n,) complex amplitudes before the first and after each of so many passages, or blocks of passages alike, that wear the rail by a mean depth: what a
    passage wears off of each wavelength, alike across the head and in each period, is missing before the next. The mean is not taken off, so that the
    shape of the head across stays as it is. @raises DataError where what a passage changes is more than half of the largest wave"""
    yield waves.amplitudes
    for passage in range(1, passages + 1):
        way = scene.way(waves)
        name = "waves" if passage == 1 else f"passage-{passage:03}"  # the first rolls over what the gain was found on
        change = worn(scene, way, scene.over_waves(name, way), depth)
        if np.abs(change).max() > 0.5 * np.abs(waves.amplitudes).max():
            raise DataError(f"passage {passage} changes waves by {1e6 * np.abs(change).max():.3g} um, the largest of which has "
                            f"{1e6 * np.abs(waves.amplitudes).max():.3g} um: take a smaller depth")
        waves = replace(waves, amplitudes=waves.amplitudes + change)
        yield waves.amplitudes


def expected_passages(scene: Scene, waves: Waves, depth: float, passages: int) -> np.ndarray:
    """(passages + 1, n) complex amplitudes by the gain at small amplitude, and by what a passage wears into a smooth rail on its supports."""
    gain, by_itself = scene.gain(waves).gain, worn(scene, scene.way(waves), scene.smooth(), depth)
    amplitudes = [waves.amplitudes]
    for _ in range(passages):
        amplitudes.append(amplitudes[-1] * (1. + depth * gain) + by_itself)
    return np.array(amplitudes)
