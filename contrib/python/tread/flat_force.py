# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheel with a flat on a track, as simple models have it: a mass on a Hertz spring on a beam on discrete supports.

The flat enters as the height that the axle has, quasi-static, while the wheel turns over it, less that of the round wheel. Rail: a beam of
Timoshenko (elements of Przemieniecki 1968, section 5.6, with the mass of slender ones), on pads, sleepers and ballast, held by nothing at its ends.
Implicit steps of Newmark's constant mean acceleration; the force follows from the beam's compliance under the wheel and the spring. SI units.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Track:
    """A rail 60E1 on supports; defaults are those of section 'Track' of the program."""
    young: float = 209.92e9
    poisson: float = 0.28
    area: float = 76.70e-4
    second_moment: float = 3038.3e-8
    shear_factor: float = 0.4
    density: float = 7800.
    spacing: float = 0.6
    spans: int = 30
    elements: int = 12  # of a span
    pad_stiffness: float = 1300e6
    pad_damping: float = 45e3
    sleeper_mass: float = 200.
    ballast_stiffness: float = 45e6
    ballast_damping: float = 32e3


class Beam:
    """Matrices of rail and sleepers: w and the slope at each node, then the sleepers."""

    def __init__(self, track: Track):
        self.size = size = track.spacing / track.elements
        self.n = track.spans * track.elements + 1
        bending = track.young * track.second_moment
        shear = track.shear_factor * track.area * track.young / (2. * (1. + track.poisson))
        phi = 12. * bending / (shear * size**2)
        k = bending / ((1. + phi) * size**3) * np.array([
            [12., 6. * size, -12., 6. * size], [6. * size, (4. + phi) * size**2, -6. * size, (2. - phi) * size**2],
            [-12., -6. * size, 12., -6. * size], [6. * size, (2. - phi) * size**2, -6. * size, (4. + phi) * size**2]])
        m = track.density * track.area * size / 420. * np.array([
            [156., 22. * size, 54., -13. * size], [22. * size, 4. * size**2, 13. * size, -3. * size**2],
            [54., 13. * size, 156., -22. * size], [-13. * size, -3. * size**2, -22. * size, 4. * size**2]])
        n_supports = track.spans - 1
        total = 2 * self.n + n_supports
        self.stiffness, self.mass, self.damping = (np.zeros((total, total)) for _ in range(3))
        for e in range(self.n - 1):
            own = slice(2 * e, 2 * e + 4)
            self.stiffness[own, own] += k
            self.mass[own, own] += m
        for s in range(n_supports):
            rail, sleeper = 2 * (s + 1) * track.elements, 2 * self.n + s
            self.mass[sleeper, sleeper] += track.sleeper_mass
            for matrix, pad, ballast in ((self.stiffness, track.pad_stiffness, track.ballast_stiffness),
                                         (self.damping, track.pad_damping, track.ballast_damping)):
                matrix[np.ix_([rail, sleeper], [rail, sleeper])] += pad * np.array([[1., -1.], [-1., 1.]])
                matrix[sleeper, sleeper] += ballast

    def shape(self, x: float) -> tuple[slice, np.ndarray]:
        """The four entries that a force at x from the rail's begin acts on, and its shares."""
        e = min(int(x / self.size), self.n - 2)
        u, h = x / self.size - e, self.size
        return slice(2 * e, 2 * e + 4), np.array([1. - 3. * u**2 + 2. * u**3, h * (u - 2. * u**2 + u**3), 3. * u**2 - 2. * u**3, h * (u**3 - u**2)])


def roll(track: Track, height: Callable[[float], float], speed: float, way: float, load: float, mass: float, stiffness: float,
         start: float = 0., step: float = 10e-6) -> tuple[np.ndarray, np.ndarray]:
    """(places from the start, contact force). @param height of the axle over that of the round wheel, over the place; @param stiffness of the Hertz spring,
    N/m^1.5; @param start of the wheel from a support in the middle of the rail; @param way to roll"""
    beam = Beam(track)
    begin = track.spacing * (track.spans // 2) + start
    effective = beam.stiffness + 2. / step * beam.damping + 4. / step**2 * beam.mass
    inverse = np.linalg.inv(effective)
    # At rest under the load.
    own, shape = beam.shape(begin)
    force = np.zeros(len(effective))
    force[own] = -load * shape
    w = np.linalg.solve(beam.stiffness, force)
    v, a = np.zeros_like(w), np.zeros_like(w)
    # z of the wheel up; the spring is pressed by what the rail and the flat are above the wheel.
    z, z_speed, z_acceleration = shape @ w[own] + height(0.) - (load / stiffness)**(2 / 3), 0., 0.
    compliance_of_wheel = step**2 / (4. * mass)
    n = int(way / (speed * step))
    places, forces = np.empty(n), np.empty(n)
    for i in range(n):
        place = speed * step * (i + 1)
        own, shape = beam.shape(begin + place)
        w_free = inverse @ (beam.damping @ (2. / step * w + v) + beam.mass @ (4. / step**2 * w + 4. / step * v + a))
        compliance = shape @ inverse[own, own] @ shape
        z_free = z + step * z_speed + 0.25 * step**2 * z_acceleration - compliance_of_wheel * load
        # Pressed by d - c F, where d is what it would be without the force.
        free, total = shape @ w_free[own] + height(place) - z_free, compliance + compliance_of_wheel
        if free <= 0.:
            contact = 0.
        else:
            pressed = free
            for _ in range(60):  # Newton's method for pressed + c K pressed^1.5 = free, which is convex
                value, slope = pressed + total * stiffness * pressed**1.5 - free, 1. + 1.5 * total * stiffness * pressed**0.5
                pressed -= value / slope
                if abs(value) < 1e-15:
                    break
            contact = stiffness * pressed**1.5
        w_next = w_free.copy()
        w_next -= contact * (inverse[:, own] @ shape)
        a_next = 4. / step**2 * (w_next - w) - 4. / step * v - a
        v = v + 0.5 * step * (a + a_next)
        w, a = w_next, a_next
        acceleration = (contact - load) / mass
        z += step * z_speed + 0.25 * step**2 * (z_acceleration + acceleration)
        z_speed += 0.5 * step * (z_acceleration + acceleration)
        z_acceleration = acceleration
        places[i], forces[i] = place, contact
    return places, forces
