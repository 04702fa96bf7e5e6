# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hertz's contact of two like bodies with the gap A x^2 + B y^2 (Johnson 1985, Contact Mechanics, eq. 4.26). SI units.

The modulus of the pair is 1/((1 - nu1^2)/E1 + (1 - nu2^2)/E2), which is G/(1 - nu) for like bodies.
"""

from __future__ import annotations

import numpy as np


def elliptic(m: float) -> tuple[float, float]:
    """Complete elliptic integrals K and E of the parameter m, by arithmetic-geometric means."""
    a, b, c, total = 1., np.sqrt(1. - m), np.sqrt(m), 0.5 * m
    for n in range(1, 40):
        a, b, c = 0.5 * (a + b), np.sqrt(a * b), 0.5 * (a - b)
        total += 2. ** (n - 1) * c * c
    return 0.5 * np.pi / a, 0.5 * np.pi / a * (1. - total)


def _shape(ratio: float) -> tuple[float, float, float]:
    """(alpha, beta, delta) of the ratio a/b of the semi-axes: A = p alpha/a, B = p beta/a, approach = p delta a, where p is the
    largest pressure over the modulus of the pair."""
    if ratio < 1.:
        alpha, beta, delta = _shape(1. / ratio)
        return beta * ratio, alpha * ratio, delta / ratio
    if ratio - 1. < 1e-7:
        return 0.25 * np.pi, 0.25 * np.pi, 0.5 * np.pi
    m = 1. - ratio ** -2
    k, e = elliptic(m)
    return (k - e) / (ratio * m), (ratio * ratio * e - k) / (ratio * m), k / ratio


def _pressure(a: float, b: float, force: float, modulus: float) -> float:
    """Largest pressure over the modulus of the pair."""
    return 3. * force / (2. * np.pi * a * b) / modulus


def curvatures(a: float, b: float, force: float, modulus: float) -> list[float]:
    """A and B (1/m) of the gap whose patch has semi-axes a and b (m) under a force (N)."""
    alpha, beta, _ = _shape(a / b)
    p = _pressure(a, b, force, modulus)
    return [p * alpha / a, p * beta / a]


def approach(a: float, b: float, force: float, modulus: float) -> float:
    """Of distant points (m), when the patch has semi-axes a and b (m) under a force (N)."""
    return _pressure(a, b, force, modulus) * _shape(a / b)[2] * a


def force_of_approach(a: float, b: float, depth: float, modulus: float) -> float:
    """Force (N) under which distant points approach by `depth` (m) when the patch has semi-axes a and b (m)."""
    return depth / approach(a, b, 1., modulus)


def ratio_of_semi_axes(curvature_x: float, curvature_y: float) -> float:
    """a/b of the gap A x^2 + B y^2."""
    low, high = np.log(1e-6), np.log(1e6)
    for _ in range(80):
        middle = 0.5 * (low + high)
        alpha, beta, _ = _shape(np.exp(middle))
        low, high = (low, middle) if beta * curvature_x > alpha * curvature_y else (middle, high)
    return float(np.exp(0.5 * (low + high)))


def semi_axes(curvature_x: float, ratio: float, force: float, modulus: float) -> tuple[float, float]:
    """a and b (m) for the curvature A (1/m) in rolling direction and the ratio a/b."""
    a = (3. * force * ratio * _shape(ratio)[0] / (2. * np.pi * modulus * curvature_x)) ** (1. / 3.)
    return a, a / ratio


def semi_axis_of_approach(curvature_x: float, ratio: float, depth: float) -> float:
    """a (m) for the curvature A (1/m) in rolling direction, the ratio a/b and the approach `depth` (m)."""
    alpha, _, delta = _shape(ratio)
    return float(np.sqrt(depth * alpha / (delta * curvature_x)))


def curvature_y(curvature_x: float, ratio: float) -> float:
    """B (1/m) for A and the ratio a/b."""
    alpha, beta, _ = _shape(ratio)
    return curvature_x * beta / alpha
