# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheel with a flat on a track, as simple models have it: a mass on a Hertz spring on a beam on discrete supports.

The flat enters as the height that the axle has, quasi-static, while the wheel turns over it, less that of the round wheel. Rail: a beam of
Timoshenko (elements of Przemieniecki 1968, section 5.6, with the mass of slender ones), on pads, sleepers and ballast, held by nothing at its ends.
Implicit steps of Newmark's constant mean acceleration; the force follows from the beam's compliance under the wheel and the spring. SI units.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

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
    elements: int = 12  # of a span, even
    head: float = 91e-3  # of the rail over its neutral axis
    half_ends: bool = False  # the rail ends in the middle of a span, in planes of symmetry as those of the program; otherwise free, a span behind a support
    absorbing: float = 0.  # length of the damped part at each end, as 'Rail/Absorbing length (m)'
    beyond: int = 0  # of the spans, at each end, that lie beyond the rail of cells with endless ends; their supports hold the rail along itself
    stiffness_along: float = 40e6  # of each of them
    pad_stiffness: float = 1300e6
    pad_damping: float = 45e3
    sleeper_mass: float = 200.
    ballast_stiffness: float = 45e6
    ballast_damping: float = 32e3

    @property
    def middle_support(self) -> float:
        """Its place from the rail's begin."""
        return self.spacing * (self.spans // 2 + (0.5 if self.half_ends else 0.))

    def endless(self, beyond: int) -> Track:
        """The same rail with so many spans more at each end, whose farther half absorbs: as 'Rail/Ends' endless, 'Spans beyond'."""
        return replace(self, spans=self.spans + 2 * beyond, beyond=beyond, absorbing=0.5 * beyond * self.spacing)

    def damping_rate(self, place: float) -> float:
        """Damping force over mass and velocity, 1/s, of the absorbing ends (include/tread/track/rail_ends.h)."""
        depth = self.absorbing - min(place, self.spans * self.spacing - place)
        if depth <= 0.:
            return 0.
        return 6. * np.sqrt(self.young / (2. * (1. + self.poisson)) / self.density) / self.absorbing * (depth / self.absorbing)**2


def element_at(x: float, size: float, n: int) -> tuple[int, float]:
    """(number of the element at x from the first of n nodes, place in it from 0 to 1)"""
    e = min(int(x / size), n - 2)
    return e, x / size - e


class Beam:
    """Matrices of rail and sleepers: w and the slope at each node, then the sleepers."""

    def __init__(self, track: Track):
        self.size = size = track.spacing / track.elements
        self.n = track.spans * track.elements + 1
        bending = track.young * track.second_moment
        shear = track.shear_factor * track.area * track.young / (2. * (1. + track.poisson))
        self.phi = phi = 12. * bending / (shear * size**2)
        k = bending / ((1. + phi) * size**3) * np.array([
            [12., 6. * size, -12., 6. * size], [6. * size, (4. + phi) * size**2, -6. * size, (2. - phi) * size**2],
            [-12., -6. * size, 12., -6. * size], [6. * size, (2. - phi) * size**2, -6. * size, (4. + phi) * size**2]])
        m = track.density * track.area * size / 420. * np.array([
            [156., 22. * size, 54., -13. * size], [22. * size, 4. * size**2, 13. * size, -3. * size**2],
            [54., 13. * size, 156., -22. * size], [-13. * size, -3. * size**2, -22. * size, 4. * size**2]])
        n_supports = track.spans if track.half_ends else track.spans - 1
        self.first_support = track.elements // 2 if track.half_ends else track.elements
        total = 2 * self.n + n_supports
        self.stiffness, self.mass, self.damping = (np.zeros((total, total)) for _ in range(3))
        for e in range(self.n - 1):
            own = slice(2 * e, 2 * e + 4)
            self.stiffness[own, own] += k
            self.mass[own, own] += m
            self.damping[own, own] += m * track.damping_rate((e + 0.5) * size)
        if track.half_ends:
            for end in (1, 2 * self.n - 1):
                self.stiffness[end, end] += 1e3 * self.stiffness[3, 3]
        for s in range(n_supports):
            rail, sleeper = 2 * (self.first_support + s * track.elements), 2 * self.n + s
            self.mass[sleeper, sleeper] += track.sleeper_mass
            for matrix, pad, ballast in ((self.stiffness, track.pad_stiffness, track.ballast_stiffness),
                                         (self.damping, track.pad_damping, track.ballast_damping)):
                matrix[np.ix_([rail, sleeper], [rail, sleeper])] += pad * np.array([[1., -1.], [-1., 1.]])
                matrix[sleeper, sleeper] += ballast

    def shape(self, x: float) -> tuple[slice, np.ndarray]:
        """The four entries that a force at x from the rail's begin acts on, and its shares."""
        e, u = element_at(x, self.size, self.n)
        h, phi = self.size, self.phi
        return slice(2 * e, 2 * e + 4), np.array([
            1. - 3. * u**2 + 2. * u**3 + phi * (1. - u), h * (u - 2. * u**2 + u**3 + 0.5 * phi * (u - u**2)),
            3. * u**2 - 2. * u**3 + phi * u, h * (u**3 - u**2 - 0.5 * phi * (u - u**2))]) / (1. + phi)

    def turning(self, x: float) -> np.ndarray:
        """Shares of the same entries in how far the section at x is turned, rad, rising along the rail."""
        _, u = element_at(x, self.size, self.n)
        h, phi = self.size, self.phi
        return np.array([6. * (u**2 - u) / h, 1. - 4. * u + 3. * u**2 + phi * (1. - u), 6. * (u - u**2) / h, 3. * u**2 - 2. * u + phi * u]) / (1. + phi)


def receptance(track: Track, places: np.ndarray | Sequence[float], frequencies: np.ndarray | Sequence[float], turns: bool = False) -> np.ndarray:
    """(places, frequencies) complex, m/N: of the rail under a force at places from the middle support. @param turns of its head along the rail, by the
    turning of the section alone, under a force there along the rail"""
    beam = Beam(track)
    forces = np.zeros((len(beam.mass), len(places)))
    for column, place in enumerate(places):
        own, shape = beam.shape(track.middle_support + place)
        forces[own, column] = track.head * beam.turning(track.middle_support + place) if turns else shape
    return answers(beam, forces, frequencies)


def answers(system: Beam | Bar, forces: np.ndarray, frequencies: np.ndarray | Sequence[float]) -> np.ndarray:
    """(columns, frequencies) complex: how far each column of forces moves where it acts."""
    moved = [np.linalg.solve(system.stiffness + 1j * w * system.damping - w**2 * system.mass, forces) for w in 2. * np.pi * np.asarray(frequencies)]
    return np.array([(forces * of_frequency).sum(axis=0) for of_frequency in moved]).T


class Bar:
    """Matrices of the rail along itself, which pads of the rail of cells do not hold; in planes of symmetry it does not move."""

    def __init__(self, track: Track):
        self.size = size = track.spacing / track.elements
        self.n = track.spans * track.elements + 1
        self.stiffness, self.mass, self.damping = (np.zeros((self.n, self.n)) for _ in range(3))
        for e in range(self.n - 1):
            own = slice(e, e + 2)
            of_element = track.density * track.area * size / 6. * np.array([[2., 1.], [1., 2.]])
            self.stiffness[own, own] += track.young * track.area / size * np.array([[1., -1.], [-1., 1.]])
            self.mass[own, own] += of_element
            self.damping[own, own] += of_element * track.damping_rate((e + 0.5) * size)
        if track.half_ends:
            for end in (0, self.n - 1):
                self.stiffness[end, end] += 1e3 * self.stiffness[1, 1]
        for span in range(track.beyond):
            for node in (track.elements // 2 + span * track.elements, self.n - 1 - track.elements // 2 - span * track.elements):
                self.stiffness[node, node] += track.stiffness_along

    def shape(self, x: float) -> tuple[slice, np.ndarray]:
        """The two entries that a force at x from the rail's begin acts on, and its shares."""
        e, u = element_at(x, self.size, self.n)
        return slice(e, e + 2), np.array([1. - u, u])


def bar_mobility(track: Track, places: np.ndarray | Sequence[float], frequencies: np.ndarray | Sequence[float]) -> np.ndarray:
    """(places, frequencies) complex, m/s/N: along the rail under a force along it at places from the middle support."""
    bar = Bar(track)
    forces = np.zeros((bar.n, len(places)))
    for column, place in enumerate(places):
        own, shape = bar.shape(track.middle_support + place)
        forces[own, column] = shape
    return 2j * np.pi * np.asarray(frequencies) * answers(bar, forces, frequencies)


class Implicit:
    """A linear system in steps of constant mean acceleration (Newmark 1959), from rest at places `w`."""

    def __init__(self, system: Beam | Bar, w: np.ndarray, step: float):
        self.system, self.step, self.w = system, step, w
        self.v, self.a = np.zeros_like(w), np.zeros_like(w)
        self.compliance = np.linalg.inv(system.stiffness + 2. / step * system.damping + 4. / step**2 * system.mass)

    def free(self) -> np.ndarray:
        """Where it is after the next step without forces; with them `compliance` times the forces further on."""
        step = self.step
        return self.compliance @ (self.system.damping @ (2. / step * self.w + self.v) + self.system.mass @ (4. / step**2 * self.w + 4. / step * self.v + self.a))

    def move(self, w: np.ndarray) -> None:
        """To where the next step ends."""
        a = 4. / self.step**2 * (w - self.w) - 4. / self.step * self.v - self.a
        self.v = self.v + 0.5 * self.step * (self.a + a)
        self.w, self.a = w, a


def roll(track: Track, height: Callable[[float], float], speed: float, way: float, load: float, mass: float, stiffness: float,
         start: float = 0., step: float = 10e-6, compliance: float = 0., traction: float = 0.) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(places from the start, contact force, speed of the rail's head along the rail under the wheel). @param height of the axle over that of the round wheel,
    over the place; @param stiffness of the Hertz spring, N/m^1.5; @param start of the wheel from the middle support; @param way to roll; @param compliance in
    series with the spring, m/N; @param traction force along the rail over the contact force, driving; it acts on the head, whose section it turns, and moves
    the rail along itself: its mean is left out there, as if it had come slowly"""
    beam, bar = Beam(track), Bar(track)
    begin = track.middle_support + start

    def under(x: float) -> tuple[slice, np.ndarray, np.ndarray]:
        """Entries of the beam under the wheel, their shares in the height there, and what the contact force does to them."""
        own, shape = beam.shape(x)
        return own, shape, shape - traction * track.head * beam.turning(x)

    # At rest under the load.
    own, shape, acting = under(begin)
    force = np.zeros(len(beam.mass))
    force[own] = -load * acting
    bending = Implicit(beam, np.linalg.solve(beam.stiffness, force), step)
    stretching = Implicit(bar, np.zeros(bar.n), step)
    # z of the wheel up; the spring is pressed by what the rail and the flat are above the wheel.
    z, z_speed, z_acceleration = shape @ bending.w[own] + height(0.) - (load / stiffness)**(2 / 3) - compliance * load, 0., 0.
    compliance_of_wheel = step**2 / (4. * mass)
    n = int(way / (speed * step))
    places, forces, along = np.empty(n), np.empty(n), np.empty(n)
    for i in range(n):
        place = speed * step * (i + 1)
        own, shape, acting = under(begin + place)
        w_free, softness = bending.free(), bending.compliance[:, own] @ acting
        z_free = z + step * z_speed + 0.25 * step**2 * z_acceleration - compliance_of_wheel * load
        # Pressed by d - c F, where d is what it would be without the force.
        free, total = shape @ w_free[own] + height(place) - z_free, shape @ softness[own] + compliance_of_wheel + compliance
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
        bending.move(w_free - contact * softness)
        acceleration = (contact - load) / mass
        z += step * z_speed + 0.25 * step**2 * (z_acceleration + acceleration)
        z_speed += 0.5 * step * (z_acceleration + acceleration)
        z_acceleration = acceleration
        own_bar, shares = bar.shape(begin + place)
        stretching.move(stretching.free() - traction * (contact - load) * (stretching.compliance[:, own_bar] @ shares))
        places[i], forces[i] = place, contact
        along[i] = shares @ stretching.v[own_bar] - track.head * (beam.turning(begin + place) @ bending.v[own])
    return places, forces, along
