# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stress in a half-space under the tractions of a patch: what a run's stresses below its own patch are compared with.

Tractions are interpolated between the nodes onto smaller rectangles, on each of which they are uniform. The formulas are those of
source/reference/subsurface.cc (potentials of Boussinesq and Cerruti, Johnson 1985, section 3.2, integrated over rectangles).
"""

from __future__ import annotations

import numpy as np

from .patches import Patch

TINY = 1e-300


def _corner(nu: float, q: tuple[np.ndarray, np.ndarray, np.ndarray], x: np.ndarray, y: np.ndarray, z: float) -> np.ndarray:
    """2 pi times the six stresses xx, yy, zz, xy, yz, zx of the corners, summed with their tractions; z into the body."""
    r = np.sqrt(x * x + y * y + z * z)
    s = 1.0 / (r + z)
    square_x, square_y = x * x + z * z + TINY, y * y + z * z + TINY
    log_y = np.where(y >= 0, np.log(r + np.abs(y)), np.log(square_x / (r + np.abs(y))))
    log_x = np.where(x >= 0, np.log(r + np.abs(x)), np.log(square_y / (r + np.abs(x))))
    over_y = np.where(y >= 0, 1.0 / (r + np.abs(y)), (r + np.abs(y)) / square_x)
    over_x = np.where(x >= 0, 1.0 / (r + np.abs(x)), (r + np.abs(x)) / square_y)
    xxz, yyz = -x * y / (r * square_x), -x * y / (r * square_y)
    xx, yy = np.arctan2(x * y * (r - z), x * x * r + y * y * z), np.arctan2(x * y * (r - z), y * y * r + x * x * z)
    zz, xy, xz, yz = -np.arctan2(x * y, z * r), np.log(r + z), log_y, log_x
    xxy, xyy, xzz, yzz, xyz, zzz = x * s / r, y * s / r, z * over_y / r, z * over_x / r, 1.0 / r, -xxz - yyz
    xxx, yyy = -xyy - xzz, -xxy - yzz
    wxxy, wxyy, wxxx, wyyy = -x * s, -y * s, y * s - log_y, x * s - log_x
    m, along, across = 1.0 - 2.0 * nu, 2.0 * (1.0 + nu), 2.0 * nu
    terms = (q[2] * (across * zz - z * xxz - m * xx) + q[0] * (along * xz - z * xxx + across * wxxx) + q[1] * (across * yz - z * xxy + across * wxxy),
             q[2] * (across * zz - z * yyz - m * yy) + q[0] * (across * xz - z * xyy + across * wxyy) + q[1] * (along * yz - z * yyy + across * wyyy),
             q[2] * (zz - z * zzz) - q[0] * z * xzz - q[1] * z * yzz,
             -q[2] * (z * xyz + m * xy) + q[0] * (yz - z * xxy + across * wxxy) + q[1] * (xz - z * xyy + across * wxyy),
             -q[2] * z * yzz - q[0] * z * xyz + q[1] * (zz - z * yyz),
             -q[2] * z * xzz + q[0] * (zz - z * xxz) - q[1] * z * xyz)
    return np.array([term.sum() for term in terms])


class HalfSpace:
    """The rail as a half-space under a patch: places in mm, in the patch's axes; stresses in MPa, in axes whose z is into the rail."""

    def __init__(self, patch: Patch, poisson: float = 0.3, parts: int = 4):
        """@param parts: rectangles to a node in each direction; one of them has its middle at the node"""
        self.poisson = poisson
        columns, rows, _ = patch.grid(patch.pressure)
        self.size_x, self.size_y = patch.size_x / parts, patch.size_y / parts
        self.x = columns[0] + self.size_x * np.arange(parts * (len(columns) - 1) + 1)
        self.y = rows[0] + self.size_y * np.arange(parts * (len(rows) - 1) + 1)
        places = np.meshgrid(self.x, self.y, indexing="ij")
        tractions = [patch.sampled(values, *places) for values in (-patch.shear_x, -patch.shear_y, patch.pressure)]
        padded = np.pad(np.array(tractions), ((0, 0), (1, 1), (1, 1)))
        corners = padded[:, 1:, 1:] - padded[:, :-1, 1:] - padded[:, 1:, :-1] + padded[:, :-1, :-1]
        of_x, of_y = np.meshgrid(np.append(self.x - 0.5 * self.size_x, self.x[-1] + 0.5 * self.size_x),
                                 np.append(self.y - 0.5 * self.size_y, self.y[-1] + 0.5 * self.size_y), indexing="ij")
        acts = (corners != 0).any(axis=0)
        self._corner_x, self._corner_y = of_x[acts], of_y[acts]
        self._corner_traction = (corners[0][acts], corners[1][acts], corners[2][acts])

    def stress(self, x: float, y: float, depth: float) -> np.ndarray:
        """xx, yy, zz, xy, yz, zx. At the surface not between two rectangles."""
        return _corner(self.poisson, self._corner_traction, x - self._corner_x, y - self._corner_y, max(depth, 1e-9)) / (2.0 * np.pi)

    def largest_von_mises(self, depth: float, y: float = 0.0) -> float:
        """At this depth below the row of rectangles nearest to y, in the middles of the rectangles."""
        row = self.y[np.abs(self.y - y).argmin()]
        return max(von_mises(self.stress(x, row, depth)) for x in self.x)


def von_mises(stress: np.ndarray) -> float:
    xx, yy, zz, xy, yz, zx = stress
    return float(np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3.0 * (xy * xy + yz * yz + zx * zx)))
