# SPDX-License-Identifier: LGPL-2.1-or-later
"""The static load of a wheel, from the parameters of a run."""

from __future__ import annotations

from collections.abc import Mapping


def number(parameters: Mapping[str, str], name: str) -> float | None:
    """A parameter; None if it is not given or a word, such as 'masses'."""
    try:
        return float(parameters[name])
    except (KeyError, ValueError):
        return None


def static_load(parameters: Mapping[str, str]) -> float | None:
    """Static load of a wheel, kN, by the parameter that sets it: a load of the wheel, one of the axle, or masses; None if they do not say."""
    load, axle, gravity = (number(parameters, f"Vehicle/{name}") for name in ("Wheel load (kN)", "Axle load (t)", "Gravity (m per s2)"))
    if load is not None:
        return load
    if gravity is None:
        return None
    if axle is not None:
        return 0.5 * axle * gravity
    masses = [number(parameters, name) for name in ("Wheel/Mass (kg)", "Vehicle/Sprung mass (kg)")]
    return None if None in masses else 1e-3 * sum(masses) * gravity
