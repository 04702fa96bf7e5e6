# SPDX-License-Identifier: LGPL-2.1-or-later
"""The low-strain scenes of prm/verification, on which half-space theory is as good as exact: sizes, spin, and what is compared."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from . import half_space
from .files import read_summary, reference_value
from .comparison import compare_fields
from .patches import Patch

# Measures beside Hertz (the first three) and the half-space solver, as a run's summary has them.
SUMMARY_MEASURES = (("largest pressure", "max_pressure_Pa", "Hertz"),
                    ("semi-axis a, by moments", "pressure_semi_axis_x_m", "Hertz"),
                    ("semi-axis b, by moments", "pressure_semi_axis_y_m", "Hertz"),
                    ("adhesion share", "adhesion_share", "half-space"),
                    ("creepage at this traction", "creepage", "half-space"),
                    ("largest shear stress", "max_shear_Pa", "half-space"),
                    ("largest micro-slip", "max_slip_m_per_s", "half-space"))

LOW_STRAIN = (1.3, 1.0, 0.63, 0.5, 0.4, 0.33, 0.2)
LOW_STRAIN_SHIPPED = (1.3, 0.63, 0.33, 0.2)  # the others are that of 0.63 mm with other cells
LOW_STRAIN_LOAD = 29232. / 127100.  # over that of CONTACT's solution: radii are as many times larger
LOW_STRAIN_RADII = (2., 1.304348)  # m, of the wheel and of the rail's crown
LOW_STRAIN_SPEED = 140 / 3.6  # m/s
# Low strain, spin alone (1/m) with this coefficient of friction; elements across the patch of the half-space beside.
LOW_STRAIN_SPIN = {"Motion/Creepage": 0, "Motion/Spin (1 per m)": 0.115, "Contact/Friction coefficient": 0.3}
LOW_STRAIN_SPIN_CELLS = (1.3, 0.63, 0.33, 0.2)
# Lateral over normal force to which the half-space's elements converge (doc/reference-solutions.md).
LOW_STRAIN_SPIN_LIMIT = 0.16454 * 1.005


def low_strain_scene(size: float) -> tuple[str, dict[str, float]]:
    if size in LOW_STRAIN_SHIPPED:
        return f"verification/low-strain-{size:g}.prm", {}
    return "verification/low-strain-0.63.prm", {"Mesh/Finest cell (mm)": size}


def difference(summary: Mapping, key: str, source: str) -> float | None:
    """Of a measure from its reference, %; points of an adhesion share."""
    value, reference = summary.get(key), reference_value(summary, key, source)
    if value is None or reference is None:
        return None
    return 100 * (value - reference) if key == "adhesion_share" else 100 * (value / reference - 1)


def signed(value: float | None) -> str:
    return "-" if value is None else f"{value:+.3f}" if abs(value) < 0.1 else f"{value:+.2f}"


def half_space_patch(normal_force: float, traction_coefficient: float, element: float = 0.1) -> Patch:
    """Half-space theory of second order in the slip at a run's forces (N, and tangential over normal force of a driving wheel), on elements of
    0.1 mm: shear stress and slip differ from those on elements of half the size by 0.25 % of the largest (RMS), where CONTACT's on elements of
    0.1 mm, whose slip is that of half an element ahead, differ by 0.7 and 0.9 %."""

    def answer(creepage: float, size: float) -> dict:
        return half_space.solve_patch(curvature_x=0.5 / LOW_STRAIN_RADII[0], curvature_y=0.5 / LOW_STRAIN_RADII[1], young=210e9, poisson=0.3, friction=0.5,
                                      creepage=creepage, normal_force=normal_force, element_x=1e-3 * size, element_y=1e-3 * size)

    # Secants, from creepages on both sides of what 0.3 needs here, with elements of twice the size: the creepage is the same within 1e-4.
    before, now = -6.4e-4, -6.9e-4
    beyond_before, beyond = (answer(creepage, 2 * element)["longitudinal_force"] / normal_force - traction_coefficient for creepage in (before, now))
    while abs(beyond) > 1e-6:
        before, now, beyond_before = now, now - beyond * (now - before) / (beyond - beyond_before), beyond
        beyond = answer(now, 2 * element)["longitudinal_force"] / normal_force - traction_coefficient
    found = answer(now, element)
    x, y = np.meshgrid(1e3 * found["x"], 1e3 * found["y"])
    fields = {name: (1e-6 if name in ("pressure", "shear_x", "shear_y") else LOW_STRAIN_SPEED) * found[name].ravel() for name in Patch.fields}
    return Patch("half-space theory", {"x_mm": x.ravel(), "y_mm": y.ravel(), "state": np.array(["none", "adhesion", "slip"])[found["state"].astype(int).ravel()],
                                       **fields}, Patch.fields)


def compare_with_half_space(run: str, element: float = 0.1) -> dict:
    """The measures of comparison.py of the scenes that roll with traction, against half-space theory on elements of so many mm."""
    summary = read_summary(run)
    return compare_fields(run, half_space_patch(summary["normal_force_N"], summary["traction_coefficient"], element))
