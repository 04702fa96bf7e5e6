# SPDX-License-Identifier: LGPL-2.1-or-later
"""A line of pressure that rolls again and again over an elastic-plastic strip in plane strain.

Finite elements of small strain (eight nodes, two by two points) in axes that move with the pressure, where each passage is steady: what flows
through the points of one depth is one history. Strains follow from the plastic strains by one factorised elastic matrix, plastic strains from
the strains by the return to the yield surface along the lines of flow, in turn until both agree. The strip is held below, and along its
length at both ends, where it is alike along x. Lengths in any unit, moduli and stresses in one other. x is the rolling direction, z the depth.
Components are xx, yy, zz, xz (xz of strain is the tensor's).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.optimize
import scipy.sparse
import scipy.sparse.linalg

Pressure = Callable[[np.ndarray], np.ndarray]


def hertzian(half_width: float, peak: float) -> Pressure:
    """The pressure of a line contact over x (Johnson 1985, eq. 4.45)."""
    return lambda x: peak * np.sqrt(np.maximum(0., 1. - (np.asarray(x) / half_width) ** 2))


def line_contact_stress(x: np.ndarray, z: np.ndarray, traction_coefficient: float = 0., poisson: float = 0.3) -> np.ndarray:
    """(4, ...) stresses in an elastic half-space below a line contact of half width 1 and peak pressure 1 (McEwen; Johnson 1985, eq. 4.49 and
    7.8) that slides with this traction in +x on the half-space; in plane strain."""
    x, z = np.broadcast_arrays(np.asarray(x, float), np.asarray(z, float))
    sum_, root = 1. - x * x + z * z, np.sqrt((1. - x * x + z * z) ** 2 + 4. * x * x * z * z)
    m, n = np.sqrt(0.5 * (root + sum_)), np.sign(x) * np.sqrt(np.maximum(0., 0.5 * (root - sum_)))
    square = m * m + n * n
    xx = -m * (1. + (z * z + n * n) / square) + 2. * z
    zz = -m * (1. - (z * z + n * n) / square)
    xz = -n * (m * m - z * z) / square
    # A traction q in +x on the surface: stress zx = -q there, z being into the body.
    q = traction_coefficient
    xx, zz, xz = (xx + q * (n * (2. - (z * z - m * m) / square) - 2. * x), zz + q * xz, xz + q * xx)
    return np.stack([xx, poisson * (xx + zz), zz, xz])


def equivalent(deviator: np.ndarray) -> np.ndarray:
    """Von Mises equivalent of deviators (4, ...)."""
    xx, yy, zz, xz = deviator
    return np.sqrt(1.5 * (xx * xx + yy * yy + zz * zz + 2. * xz * xz))


def deviatoric(stress: np.ndarray) -> np.ndarray:
    mean = (stress[0] + stress[1] + stress[2]) / 3.
    return stress - np.stack([mean, mean, mean, 0. * mean])


def first_yield(poisson: float = 0.3) -> float:
    """Peak pressure over the yield stress in shear at which a frictionless line contact first yields (von Mises)."""
    z = np.linspace(0.3, 1.2, 361)
    x = np.linspace(0., 1., 101)
    stress = line_contact_stress(x[:, None], z[None, :], 0., poisson)
    return float(np.sqrt(3.) / equivalent(deviatoric(stress)).max())


def shakedown_limit(poisson: float = 0.3, depths: np.ndarray | None = None) -> float:
    """Peak pressure over the yield stress in shear up to which a frictionless line contact shakes down: by Melan's theorem, with the residual
    stresses xx and yy of each depth that are best there."""
    x, worst = np.linspace(-4., 4., 801), 0.
    for z in np.linspace(0.3, 1., 29) if depths is None else depths:
        stress = line_contact_stress(x, np.full_like(x, z), 0., poisson)

        def largest(residual: np.ndarray) -> float:
            return float(equivalent(deviatoric(stress + np.array([residual[0], residual[1], 0., 0.])[:, None])).max())
        found = scipy.optimize.minimize(largest, [-0.1, -0.1], method="Nelder-Mead", options={"xatol": 1e-5, "fatol": 1e-6})
        worst = max(worst, float(found.fun))
    return float(np.sqrt(3.) / worst)


def graded(begin: float, end: float, first: float, ratio: float = 1.2) -> np.ndarray:
    """Lines behind `begin` up to `end`, the steps growing from about `first` by about this ratio."""
    steps = [first]
    while sum(steps) < abs(end - begin):
        steps.append(ratio * steps[-1])
    lines = np.cumsum(steps)
    return begin + (end - begin) * lines / lines[-1]


class Strip:
    """@param x, z: lines between the elements, z from 0 downwards"""

    def __init__(self, x: np.ndarray, z: np.ndarray, young: float, poisson: float = 0.3):
        self.x, self.z = np.asarray(x, float), np.asarray(z, float)
        self.shear = 0.5 * young / (1. + poisson)
        self.lame = young * poisson / (1. + poisson) / (1. - 2. * poisson)
        n_x, n_z = len(self.x) - 1, len(self.z) - 1
        number = np.arange((2 * n_x + 1) * (2 * n_z + 1)).reshape(2 * n_x + 1, 2 * n_z + 1)
        i, j = (a.ravel() for a in np.meshgrid(np.arange(n_x), np.arange(n_z), indexing="ij"))
        places = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
        nodes = np.stack([number[2 * i + a, 2 * j + b] for a, b in places], axis=1)
        g = 1. / np.sqrt(3.)
        of_x, of_z, rows, columns, values = [], [], [], [], []
        h_x, h_z = np.diff(self.x)[i], np.diff(self.z)[j]
        self.n_points = 4 * n_x * n_z
        for point, (s, t) in enumerate(((-g, -g), (g, -g), (-g, g), (g, g))):
            by_s, by_t = self._gradients(s, t)
            of = (2 * i + (s > 0)) * 2 * n_z + 2 * j + (t > 0)  # points by x, then by z
            of_x.append((of, self.x[i] + 0.5 * h_x * (1. + s)))
            of_z.append((of, self.z[j] + 0.5 * h_z * (1. + t)))
            for a in range(8):
                d_x, d_z = 2. * by_s[a] / h_x, 2. * by_t[a] / h_z
                for component, direction, value in ((0, 0, d_x), (1, 1, d_z), (2, 0, d_z), (2, 1, d_x)):  # xx, zz, 2 xz
                    rows.append(component * self.n_points + of)
                    columns.append(2 * nodes[:, a] + direction)
                    values.append(value)
        order = np.concatenate([a for a, _ in of_x])
        self.points_x, self.points_z, area = (np.empty(self.n_points) for _ in range(3))
        self.points_x[order] = np.concatenate([b for _, b in of_x])
        self.points_z[order] = np.concatenate([b for _, b in of_z])
        area[order] = np.tile(0.25 * h_x * h_z, 4)
        self.shape = (2 * n_x, 2 * n_z)
        n = 2 * number.size
        self.gradient = scipy.sparse.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), (3 * self.n_points, n))
        weights = scipy.sparse.diags(np.tile(area, 3))
        self.weighted = (self.gradient.T @ weights).tocsr()
        one = scipy.sparse.identity(self.n_points)
        along, across, shear = (self.lame + 2. * self.shear) * one, self.lame * one, self.shear * one
        stiffness = self.weighted @ scipy.sparse.bmat([[along, across, None], [across, along, None], [None, None, shear]]) @ self.gradient
        held = np.ones(n, bool)
        held[2 * np.unique(nodes)] = held[2 * np.unique(nodes) + 1] = False
        held[2 * number[[0, -1]].ravel()] = True
        held[2 * number[:, -1]] = held[2 * number[:, -1] + 1] = True
        self.free = np.flatnonzero(~held)
        self.solve = scipy.sparse.linalg.splu(stiffness[self.free][:, self.free].tocsc()).solve
        self.top, self.n = number[:, 0], n

    @staticmethod
    def _gradients(s: float, t: float) -> tuple[np.ndarray, np.ndarray]:
        """Of the eight shape functions in the square, corners first."""
        by_s, by_t = np.empty(8), np.empty(8)
        for a, (p, q) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1))):
            by_s[a] = 0.25 * p * (1 + q * t) * (2 * p * s + q * t)
            by_t[a] = 0.25 * q * (1 + p * s) * (p * s + 2 * q * t)
        by_s[4:] = -s * (1 - t), 0.5 * (1 - t * t), -s * (1 + t), -0.5 * (1 - t * t)
        by_t[4:] = -0.5 * (1 - s * s), -t * (1 + s), 0.5 * (1 - s * s), -t * (1 - s)
        return by_s, by_t

    def load(self, pressure: Pressure, traction_coefficient: float = 0.) -> np.ndarray:
        """Forces on the nodes of the surface."""
        force = np.zeros(self.n)
        s, w = np.polynomial.legendre.leggauss(12)
        for e, (begin, end) in enumerate(zip(self.x[:-1], self.x[1:])):
            p = 0.5 * (end - begin) * w * pressure(0.5 * (begin + end) + 0.5 * (end - begin) * s)
            for node, shape in zip(self.top[2 * e:2 * e + 3], (0.5 * s * (s - 1), 1 - s * s, 0.5 * s * (s + 1))):
                force[2 * node + 1] += (p * shape).sum()
                force[2 * node] += traction_coefficient * (p * shape).sum()
        return force

    def stress_of(self, elastic: np.ndarray) -> np.ndarray:
        """Of elastic strains (4, ...)."""
        volume = self.lame * (elastic[0] + elastic[1] + elastic[2])
        return 2. * self.shear * elastic + np.stack([volume, volume, volume, 0. * volume])

    def strain(self, force: np.ndarray, plastic: np.ndarray) -> np.ndarray:
        """(4, n_x, n_z) strains under forces, with plastic strains of that shape."""
        stress = self.stress_of(plastic).reshape(4, -1)
        right = force + self.weighted @ np.concatenate([stress[0], stress[2], stress[3]])
        displacement = np.zeros(self.n)
        displacement[self.free] = self.solve(right[self.free])
        found = (self.gradient @ displacement).reshape(3, *self.shape)
        return np.stack([found[0], 0. * found[0], found[1], 0.5 * found[2]])

    def passage(self, force: np.ndarray, before: np.ndarray, guess: np.ndarray, yield_stress: float, hardening: float,
                tolerance: float = 1e-4, most: int = 400) -> tuple[np.ndarray, int]:
        """(4, n_x, n_z) plastic strains in the steady state, and the number of iterations. @param before (4, n_z) those that flow in, ahead;
        hardening: of stress by plastic strain, the plastic modulus"""
        plastic = guess
        g3, changes, past = 3. * self.shear, [], []
        for iteration in range(1, most + 1):
            strain = self.strain(force, plastic)
            new, now = np.empty_like(plastic), before
            for i in range(self.shape[0] - 1, -1, -1):
                drive = deviatoric(2. * self.shear * (strain[:, i] - now)) - 2. / 3. * hardening * now
                q = equivalent(drive)
                flow = np.maximum(0., q - yield_stress) / (g3 + hardening)
                now = now + 1.5 * flow / np.maximum(q, 1e-300) * drive
                new[:, i] = now
            residual = new - plastic
            off = np.abs(residual).max()
            if off * 2. * self.shear < tolerance * yield_stress:
                return new, iteration
            # Anderson's acceleration over the last iterations.
            past.append((new.ravel(), residual.ravel()))
            past = past[-6:]
            if len(past) > 1:
                d = np.stack([b[1] - a[1] for a, b in zip(past[:-1], past[1:])], axis=1)
                by = np.stack([b[0] - a[0] for a, b in zip(past[:-1], past[1:])], axis=1)
                c = np.linalg.lstsq(d, past[-1][1], rcond=1e-8)[0]
                plastic = (past[-1][0] - by @ c).reshape(new.shape)
            else:
                plastic = new
        raise RuntimeError(f"no steady state within {most} iterations: off by {off:.3g}")

    def residual_stress(self, plastic: np.ndarray) -> np.ndarray:
        """(4, n_z) left behind in a strip that has these plastic strains (4, n_z) all along its length: along x and y it is not strained."""
        poisson = 0.5 * self.lame / (self.lame + self.shear)
        of_layers, none = 2. * self.shear / (1. - poisson), np.zeros_like(plastic[0])
        return np.stack([-of_layers * (plastic[0] + poisson * plastic[1]), -of_layers * (plastic[1] + poisson * plastic[0]), none, none])

    def unloaded_stress(self, plastic: np.ndarray) -> np.ndarray:
        """(4, n_x, n_z) with these plastic strains and no forces."""
        return self.stress_of(self.strain(np.zeros(self.n), plastic) - plastic)


def strip_of(half_width: float, depth: float, per_half_width: int, young: float, poisson: float = 0.3, length: float = 15.) -> Strip:
    """A strip with this number of elements to the half width of the contact, down to this depth; length: half of it, in half widths."""
    h = half_width / per_half_width
    near = h * np.arange(0, int(round(2. * per_half_width)) + 1)
    ahead = np.concatenate([near, graded(near[-1], length * half_width, h)])
    down = np.concatenate([near, graded(near[-1], depth, h)])
    return Strip(np.concatenate([-ahead[:0:-1], ahead]), down, young, poisson)
