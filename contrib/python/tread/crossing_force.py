# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheel over a rail that changes along the way, as a simple model has it: two masses and the contact force of half-space theory at rest. SI units."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from . import positions
from .runs import ROOT

SLICES = os.path.join(ROOT, "contrib", "contact-data", "crossing_uk56E1.csv")


@dataclass(frozen=True)
class Rail:
    """A rail whose bottom moves up and down; defaults are those of section 'Track' of the program."""
    mass: float = 450.
    stiffness: float = 100e6
    damping: float = 60e3


class AtRest(Protocol):
    """Contact force (N) over the place along the way and the height of the axle over its radius (m), and the height under the load."""

    def height(self, place: float) -> float: ...

    def __call__(self, place: float, height: float) -> float: ...


@dataclass(frozen=True)
class Force:
    """Contact force at rest over place and height: `heights` (m) of the axle over its radius, under the load at the `places` (m), and the forces (N) at `offsets` (m)
    from them, a row for each place."""
    places: np.ndarray
    heights: np.ndarray
    offsets: np.ndarray
    forces: np.ndarray

    def height(self, place: float) -> float:
        return float(np.interp(place, self.places, self.heights))

    def __call__(self, place: float, height: float) -> float:
        """N; the force to the power of 2/3 goes nearly straight with the height."""
        share = np.clip((place - self.places[0]) / (self.places[1] - self.places[0]), 0., len(self.places) - 1.)
        low = min(int(share), len(self.places) - 2)
        share -= low
        offset = height - self.height(place)
        sunk = [np.interp(offset, self.offsets, row**(2 / 3)) for row in self.forces[low:low + 2]]
        return float(((1. - share) * sunk[0] + share * sunk[1])**1.5)


def force_of_rest(rail: str, shift_mm: float, load: float, begin_mm: float, end_mm: float, program: str, apart_mm: float = 2.) -> Force:
    """From the half-space's answers without friction. @raises Error"""
    places = np.arange(begin_mm, end_mm + 0.5 * apart_mm, apart_mm)
    common = {"rail": rail, "y_ws_mm": shift_mm, "friction": 0.}
    sums = lambda rows: np.array([float(patches[0]["vertical_force_N"]) if float(patches[0]["patch"]) > 0 else 0. for patches in positions.solve(rows, program)])
    heights = np.array([float(patches[0]["height_mm"]) for patches in
                        positions.solve([{**common, "s_mm": place, "load_N": load} for place in places], program)])
    offsets = np.linspace(-0.25, 0.15, 21)
    elements = {"element_x_mm": 0.4, "element_y_mm": 0.2}
    forces = sums([{**common, **elements, "s_mm": place, "height_mm": height + offset} for place, height in zip(places, heights) for offset in offsets])
    return Force(1e-3 * places, 1e-3 * heights, 1e-3 * offsets, forces.reshape(len(places), len(offsets)))


def pass_over(force: AtRest, rail: Rail, speed: float, begin: float, end: float, load: float, mass: float,
              step: float = 5e-6) -> tuple[np.ndarray, np.ndarray]:
    """(places, contact force): explicit steps from rest under the load, the wheel rising with the way. @param mass of the wheel under the constant `load`"""
    slope = (force.height(begin + 2e-3) - force.height(begin)) / 2e-3
    sunk, sinking = -load / rail.stiffness, 0.
    height, rising = force.height(begin) + sunk, slope * speed
    n = int((end - begin) / (speed * step))
    places, forces = np.empty(n), np.empty(n)
    for i in range(n):
        place = begin + speed * step * i
        contact = force(place, height - sunk)
        places[i], forces[i] = place, contact
        rising += step * (contact - load) / mass
        sinking += step * (-contact - rail.stiffness * sunk - rail.damping * sinking) / rail.mass
        height += step * rising
        sunk += step * sinking
    return places, forces
