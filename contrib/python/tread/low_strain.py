# SPDX-License-Identifier: LGPL-2.1-or-later
"""The low-strain scenes of prm/verification, on which half-space theory is as good as exact: sizes, spin, and what is compared."""

from __future__ import annotations

from collections.abc import Mapping

from .files import reference_value

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
