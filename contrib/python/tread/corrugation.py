# SPDX-License-Identifier: LGPL-2.1-or-later
"""How the wear of one passage follows the roughness that is there, wavelength by wavelength: what makes corrugation grow. SI units.

The gain G (1/m) is the complex amplitude of the roughness that a mean wear depth of 1 m adds to each wavelength, over the amplitude that is there:
where its real part is positive waves grow, its imaginary part moves them along. A run over small waves of drawn phases has all wavelengths at
once. Beside it stands a linear model: a mass on a Hertz spring on a beam of Timoshenko on pads, sleepers and ballast (flat_force.py), and transient
rolling of half-spaces over waves, with loads and creepages that swing (half_space.roll()).
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from . import flat_force, half_space
from .files import DataError
from .runs import Run


@dataclass(frozen=True)
class Waves:
    """Cosines a cos(2 pi n x/period + phi), of which a whole number n lies in each period."""
    period: float
    orders: np.ndarray  # (n,) of waves in a period
    amplitudes: np.ndarray  # (n,) complex, a exp(i phi)

    @classmethod
    def draw(cls, period: float, shortest: float, longest: float, amplitude: float, seed: int = 1) -> Waves:
        """All wavelengths between two that divide the period, equally high, with phases drawn evenly. @raises DataError"""
        orders = np.arange(int(np.ceil(period / longest - 1e-9)), int(np.floor(period / shortest + 1e-9)) + 1)
        if not len(orders) or orders[0] < 1:
            raise DataError(f"no wave of {1e3 * shortest:g} to {1e3 * longest:g} mm divides {1e3 * period:g} mm")
        return cls(period, orders, amplitude * np.exp(2j * np.pi * np.random.default_rng(seed).random(len(orders))))

    @property
    def wavelengths(self) -> np.ndarray:
        return self.period / self.orders

    def heights(self, places: np.ndarray) -> np.ndarray:
        return (self.amplitudes * np.exp(2j * np.pi / self.period * np.multiply.outer(places, self.orders))).real.sum(axis=-1)

    def found_in(self, places: np.ndarray, values: np.ndarray) -> np.ndarray:
        """(n,) complex amplitudes of these waves in what is given at places that cover a period. @raises DataError"""
        if len(places) < 4 * self.orders.max() or np.ptp(places) < self.period * (1. - 1.5 / len(places)):
            raise DataError(f"{len(places)} places over {1e3 * np.ptp(places) if len(places) else 0.:.4g} mm do not resolve waves of "
                            f"{1e3 * self.wavelengths.min():.4g} mm in a period of {1e3 * self.period:.4g} mm")
        basis = np.exp(2j * np.pi / self.period * np.multiply.outer(places, np.arange(1, self.orders.max() + 3)))
        columns = np.hstack([np.ones((len(places), 1)), basis.real, -basis.imag])
        found = np.linalg.lstsq(columns, values, rcond=None)[0][1:].reshape(2, -1)
        return (found[0] + 1j * found[1])[self.orders - 1]


@dataclass(frozen=True)
class Way:
    """Where waves are and the wheel rolls: they begin and end over a ramp by half a cosine. From `begin` on a period is looked at."""
    waves: Waves
    first: float  # where the waves begin
    last: float
    begin: float = 0.
    ramp: float = 60e-3

    def share(self, places: np.ndarray) -> np.ndarray:
        """Of their height that waves have."""
        return 0.5 - 0.5 * np.cos(np.pi * np.clip(np.minimum(places - self.first, self.last - places) / self.ramp, 0., 1.))

    def heights(self, places: np.ndarray) -> np.ndarray:
        return self.share(places) * self.waves.heights(places)

    def looked_at(self, places: np.ndarray) -> np.ndarray:
        return (places >= self.begin - 1e-9) & (places < self.begin + self.waves.period - 1e-9)

    def found_in(self, places: np.ndarray, values: np.ndarray) -> np.ndarray:
        here = self.looked_at(places)
        return self.waves.found_in(places[here], values[here])

    def settings(self, path: str, apart: float = 0.5e-3) -> dict[str, object]:
        """What a scene needs for the waves, which a file at `path` then has."""
        places = np.linspace(self.first, self.last, int(round((self.last - self.first) / apart)) + 1)
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(f"# waves of {1e3 * self.waves.wavelengths.min():g} to {1e3 * self.waves.wavelengths.max():g} mm\n")
            stream.writelines(f"{1e3 * (x - self.first):.4f} {1e3 * z:.9f}\n" for x, z in zip(places, self.waves.heights(places)))
        return {"Defect/Shape": "profile", "Defect/Profile file": os.path.abspath(path), "Defect/Position (mm)": round(1e3 * self.first, 6),
                "Defect/Ramp (mm)": round(1e3 * self.ramp, 6), "Defect/Lateral law": "uniform"}


def mean_across(y: np.ndarray, values: np.ndarray, half_width: float) -> np.ndarray:
    """Over |y| <= half_width of values that go straight from y to y, which ascend, and are 0 beyond. @param values (len(y), ...)"""
    inside = np.linspace(-half_width, half_width, 41)
    shares = np.array([np.interp(inside, y, unit, 0., 0.) for unit in np.eye(len(y))])  # of each y at the places inside
    weights = 0.5 * (shares[:, 1:] + shares[:, :-1]).sum(axis=1) / (len(inside) - 1)
    return np.tensordot(weights, values, axes=1)


def work_along(run: Run, half_width: float) -> tuple[np.ndarray, np.ndarray]:
    """(places, work of friction per area of the rail), mean over the strip |y| <= half_width."""
    table = run.table("rail_surface_damage.csv", ("x_mm", "y_mm", "friction_work_J_per_m2"))
    places, row = np.unique(np.round(table["x_mm"], 4), return_inverse=True)
    lines, column = np.unique(np.round(table["y_mm"], 4), return_inverse=True)
    if half_width > 1e-3 * np.abs(lines).max():
        raise DataError(f"{run.path('rail_surface_damage.csv')}: its lines lie within {np.abs(lines).max():.4g} mm of the middle, the strip is {1e3 * half_width:.4g} mm "
                        "wide on each side")
    work = np.zeros((len(lines), len(places)))  # 0 where no wheel came
    work[column, row] = table["friction_work_J_per_m2"]
    return 1e-3 * places, mean_across(1e-3 * lines, work, half_width)


@dataclass(frozen=True)
class Gain:
    """What a passage does to waves. (n,) complex."""
    gain: np.ndarray  # 1/m
    force: np.ndarray  # contact force over roughness, N/m


def difference(way: Way, rough: tuple[np.ndarray, np.ndarray], smooth: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, float]:
    """(amplitudes of what the waves change, mean of the smooth rail) of two (places, values)."""
    places, rows, smooth_rows = np.intersect1d(np.round(rough[0], 9), np.round(smooth[0], 9), return_indices=True)
    change = way.found_in(places, rough[1][rows] - smooth[1][smooth_rows])
    return change, float(smooth[1][smooth_rows][way.looked_at(places)].mean())


def force_along(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """(places, contact force): rows of history.csv are means of the intervals that end with them."""
    position, force = run.history["position_m"], run.history["normal_force_N"]
    return position[1:] - 0.5 * np.diff(position), force[1:]


def gain_of_runs(way: Way, rough: Run, smooth: Run, half_width: float) -> Gain:
    """Of two runs that differ in the waves alone; wear in proportion to the work of friction."""
    there = way.waves.amplitudes
    work, mean = difference(way, work_along(rough, half_width), work_along(smooth, half_width))
    return Gain(-work / mean / there, difference(way, force_along(rough), force_along(smooth))[0] / there)


@dataclass(frozen=True)
class Contact:
    """A wheel on a rail as half-spaces."""
    curvature_x: float  # of the gap A x^2 + B y^2, 1/m
    curvature_y: float
    load: float
    friction: float
    creepage: float  # negative: driving
    young: float = 210e9
    poisson: float = 0.3
    element: float = 0.5e-3
    half_width: float = 2.5e-3  # of the strip in which the work is looked at

    @property
    def stiffness(self) -> float:
        """K of the Hertz spring K delta^1.5."""
        return self.load / float(half_space.solve(curvature_x=self.curvature_x, curvature_y=self.curvature_y, normal_force=self.load, friction=0.,
                                                  young=self.young, poisson=self.poisson)["approach"])**1.5

    def roll(self, heights: np.ndarray, load: np.ndarray, creepage: np.ndarray) -> dict[str, np.ndarray]:
        """approach, longitudinal_force and work per area in the strip, for each element of the way."""
        patch = half_space.solve_patch(curvature_x=self.curvature_x, curvature_y=self.curvature_y, normal_force=self.load, friction=0., young=self.young,
                                       poisson=self.poisson)
        n = [int(np.ceil(1.35 * np.abs(along[(patch["pressure"] > 0.).any(axis=axis)]).max() / self.element)) for axis, along in ((0, patch["x"]), (1, patch["y"]))]
        x, y = (self.element * np.arange(-of, of + 1) for of in n)
        rolled = half_space.roll(gap=self.curvature_x * x**2 + self.curvature_y * y[:, None]**2, x_first=x[0], y_first=y[0], element_x=self.element,
                                 element_y=self.element, friction=self.friction, young=self.young, poisson=self.poisson, heights=heights,
                                 normal_force=load, creepage=creepage)
        return {**rolled, "work": mean_across(y, rolled["work"], self.half_width)}


@dataclass(frozen=True)
class Response:
    """(n,) complex amplitudes over that of what swings; `work` over its mean."""
    approach: np.ndarray
    longitudinal_force: np.ndarray
    work: np.ndarray


def responses(contact: Contact, waves: Waves) -> dict[str, Response]:
    """Of transient rolling to `heights` (m), `load` (N) and `creepage`, each swinging alone."""
    margin = 80  # elements: what the patch needs on both sides
    n = int(round(waves.period / contact.element))
    places, period = contact.element * np.arange(-margin, n + margin), slice(margin, margin + n)
    unit = replace(waves, amplitudes=waves.amplitudes / np.abs(waves.amplitudes))
    shape = unit.heights(places)
    level = {"heights": np.zeros(len(places)), "load": np.full(len(places), contact.load), "creepage": np.full(len(places), contact.creepage)}
    still, found = contact.roll(**level), {}
    for name, swing in {"heights": 0.02e-6, "load": 2e-4 * contact.load, "creepage": 2e-4 * contact.creepage}.items():
        swung = contact.roll(**{**level, name: level[name] + swing * shape})
        ratio = {key: waves.found_in(places[period], (swung[key] - still[key])[period]) / (swing * unit.amplitudes) for key in still}
        found[name] = Response(ratio["approach"], ratio["longitudinal_force"], ratio["work"] / still["work"][period].mean())
    return found


@dataclass(frozen=True)
class Model:
    """What rolls, on what, and how fast."""
    contact: Contact
    track: flat_force.Track
    speed: float
    mass: float
    start: float  # place of the wheel
    support: float  # place of the support that is the track's middle one
    compliance: float = 0.  # of rail and wheel near the contact, beyond that of half-spaces, m/N

    @property
    def traction(self) -> float:
        """Force along the rail over the load in steady rolling."""
        steady = self.contact.roll(np.zeros(1), np.array([self.contact.load]), np.array([self.contact.creepage]))
        return float(steady["longitudinal_force"][0]) / self.contact.load

    def roll(self, way: Way, height: Callable[[float], float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(places, contact force, speed of the rail's head along the rail) over a rail with an effective height, under a traction in proportion to the force."""
        rolled, force, along = flat_force.roll(self.track, lambda rolled: height(self.start + rolled), self.speed, way.last - self.start, self.contact.load,
                                               self.mass, self.contact.stiffness, self.start - self.support, 2.5e-4 / self.speed, self.compliance, self.traction)
        return self.start + rolled, force, along

    def mobility(self, way: Way) -> np.ndarray:
        """(n,) complex, of the rail's head along the rail under a force there, mean over the period that is looked at."""
        places = way.begin - self.support + way.waves.period * (np.arange(12) + 0.5) / 12
        frequencies = self.speed / way.waves.wavelengths
        return (flat_force.bar_mobility(self.track, places, frequencies)
                + 2j * np.pi * frequencies * flat_force.receptance(self.track, places, frequencies, turns=True)).mean(axis=0)


def fitted(track: flat_force.Track, places: Sequence[float], frequencies: np.ndarray, receptances: np.ndarray) -> tuple[flat_force.Track, float, float]:
    """(track, compliance in series, root mean square of the relative difference that is left): the track whose receptances, with a compliance that all
    frequencies have, are nearest to given ones, (places, frequencies) complex at places from the middle support. The stiffness of its pads has the rail's foot in it
    then, its shear factor the section as its cells have it. @raises DataError"""
    start = np.array([track.pad_stiffness, track.pad_damping, track.shear_factor, 0.1e-9])
    scale = np.maximum(np.abs(receptances), 0.1 * np.abs(receptances).max())

    def track_of(ratios):
        stiffness, damping, factor, compliance = start * ratios
        return replace(track, pad_stiffness=stiffness, pad_damping=damping, shear_factor=factor), compliance

    def off(ratios):
        changed, compliance = track_of(ratios)
        difference = (flat_force.receptance(changed, places, frequencies) + compliance - receptances) / scale
        return np.concatenate([difference.real.ravel(), difference.imag.ravel()])

    ratios = np.ones(4)
    for _ in range(30):
        here, small = off(ratios), 1e-3
        slopes = np.array([(off(ratios + small * unit) - here) / small for unit in np.eye(4)]).T
        step = np.linalg.lstsq(slopes, -here, rcond=None)[0]
        ratios = ratios + step * min(1., 0.2 / np.abs(step).max())
        if np.abs(step).max() < 1e-5:
            break
    else:
        raise DataError("no track of the linear model comes near the receptances of the cells")
    changed, compliance = track_of(ratios)
    return changed, float(compliance), float(np.sqrt(np.mean(off(ratios)**2)))


def gain_at_rest(parts: Mapping[str, Response]) -> np.ndarray:
    """Without inertia and track: of half-spaces under constant load and creepage."""
    return -parts["heights"].work


def gain_of_model(model: Model, way: Way, parts: Mapping[str, Response]) -> Gain:
    """@param parts responses of its contact to the waves"""
    waves = way.waves
    # The patch rides on less than the height of short waves: the approach under constant load is lower by what it rides on.
    ridden = replace(way, waves=replace(waves, amplitudes=-parts["heights"].approach * waves.amplitudes))
    places, rough_force, rough_along = model.roll(way, lambda x: float(ridden.heights(np.array(x))))
    _, force, along = model.roll(way, lambda x: 0.)
    force, along = (difference(way, (places, rough), (places, smooth))[0] / waves.amplitudes for rough, smooth in ((rough_force, force), (rough_along, along)))
    # The rail's head moves along the rail under the wheel, and more so by what the force along the rail has beyond its proportion to the load.
    by_creepage, mobility = parts["creepage"].longitudinal_force, model.mobility(way)
    beyond = parts["heights"].longitudinal_force + (parts["load"].longitudinal_force - model.traction) * force - by_creepage * along / model.speed
    beyond /= 1. - by_creepage * mobility / model.speed
    creepage = (mobility * beyond - along) / model.speed
    return Gain(-(parts["heights"].work + parts["load"].work * force + parts["creepage"].work * creepage), force)
