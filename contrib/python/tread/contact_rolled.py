# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cases of CONTACT's input files rolled by finite elements, beside their half-space answers: a wheel on a rail by their profiles (module
1), and Hertzian contacts (module 3) as an upright wheel on a crowned block.

Both are steady rolling, whose answer depends on creepages and not on the speed: all roll at one speed, with denser cells, and what is
proportional to the speed is converted to that of the file.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from . import hertz
from .contact_cases import Case
from .contact_track import GRAVITY, MASS, TrackCase, patch_rows, scene_text
from .files import DataError
from .runs import PROGRAM, Run, run

SPEED_KM_H = 140.
# Of steel, whose waves are so much faster than the wheel that cells 25 times as dense change forces by 0.4 %. Softer cells are lighter in
# proportion, which leaves the waves as fast.
DENSITY, YOUNG = 7800., 210e9
STEADY = {"Scene/Density scale": 25., "Solid/Mass damping (1 per s)": 3000., "Time stepping/Levels": 3.,
          "Motion/Speed (km per h)": SPEED_KM_H, "Output/Write volume": "false"}
# Rolling is steady after so many lengths of the patch (doc/results.md); then come those mm over which a run averages its forces.
LENGTHS, AVERAGED = 1.5, 10.
CELLS_IN_SEMI_AXIS = 5.
# Semi-axes from the patch to the ends of the blocks, as in prm/verification/half-space-0.63-mu0.30.prm.
BLOCK = 13.
# Of tread's default wheel and vehicle: moment of inertia over mass and squared radius; stiffness (kN/m) and damping (N s/m) over the
# sprung mass. They have no part in the answer, and other wheels need others.
INERTIA, STIFFNESS, DAMPING = 58. / 900. / 0.46 ** 2, 1150. / 13400., 2500. / 13400.
RADII, CROWN_RADII = (10., 2000.), (10., 1e6)  # mm, of 'Wheel/Radius' and 'Rail/Crown radius'


def cell_of(length: float, width: float) -> float:
    """Finest cell (mm, two digits) for a patch (m)."""
    return float(f"{1e3 * 0.5 * min(length, width) / CELLS_IN_SEMI_AXIS:.2g}")


def _rolled_distance(length: float) -> float:
    """mm, for a patch of a length (m)."""
    return math.ceil(LENGTHS * 1e3 * length + AVERAGED)


def _roll(settings: dict[str, Any], output: str, title: str, ranks: int, program: str) -> Run:
    """Write a scene beside a folder and roll it there. @raises ProgramError"""
    with open(output + ".prm", "w", encoding="utf-8") as stream:
        stream.write(scene_text(settings, title))
    return run(output + ".prm", output=output, ranks=ranks, program=program)


def roll_track_case(case: TrackCase, half_space: Run, output: str, cell: float | None, title: str = "", ranks: int = 1,
                    program: str = PROGRAM) -> tuple[Run, list[dict[str, float]]]:
    """Roll a case of module 1 whose half-space answer is known, with finest cells of a size (mm; None: by the narrowest patch).

    Returns the run and [{name: value}] of its patches: the names of contact_track.PATCH, in CONTACT's axes and signs. Raises ProgramError.
    """
    patches = half_space.summary["patches"]
    faster = SPEED_KM_H / case.settings["Motion/Speed (km per h)"]
    density = DENSITY * 1e9 * case.settings["Rail/Young's modulus (GPa)"] / YOUNG
    answer = _roll({
        **case.settings, **STEADY, "Motion/Angular velocity (rad per s)": faster * case.settings["Motion/Angular velocity (rad per s)"],
        "Motion/Rolled distance (mm)": _rolled_distance(max(patch["length_m"] for patch in patches)),
        "Mesh/Finest cell (mm)": cell or min(cell_of(patch["length_m"], patch["width_m"]) for patch in patches),
        "Wheel/Density (kg per m3)": density, "Rail/Density (kg per m3)": density}, output, title, ranks, program)
    return answer, patch_rows(case.side, answer.summary["patches"])


def upright_wheel(case: Case, result: dict, cell: float | None) -> dict[str, Any]:
    """{"Section/Name": value} of a scene with the gap, the constants, the force and the creepages of a case of module 3 that has been
    solved. @raises DataError, which names what keeps it from being a wheel on a rail"""
    if case.curvatures is None:
        raise DataError("finite elements roll a gap of A x^2 + B y^2 alone: IPOTCN below 0, or IBASE = 1 with B(2), B(4), B(5) = 0 and "
                        "IPLAN = 1")
    if result["reaches_border"]:
        raise DataError("the patch reaches the border of the potential contact area, at which finite elements would go on")
    if case.poisson > 0.49:
        raise DataError(f"Poisson's ratio {case.poisson:g} is above 0.49, too much for finite elements")
    curvature_x, curvature_y = case.curvatures
    if min(curvature_x, curvature_y) <= 0.:
        raise DataError("finite elements need curvatures above 0 along and across: a patch that ends within the bodies")
    radius, crown = 500. / curvature_x, 500. / curvature_y
    for name, value, body, (low, high) in (("in rolling direction, 1/(2 A)", radius, "wheel", RADII),
                                           ("across, 1/(2 B)", crown, "rail", CROWN_RADII)):
        if not low <= value <= high:
            raise DataError(f"the radius {name} = {value:.4g} mm, is none of a {body} of tread: {low:g} to {high:g} mm")
    a, b = hertz.semi_axes(curvature_x, hertz.ratio_of_semi_axes(curvature_x, curvature_y), result["normal_force_N"],
                           case.shear_modulus / (1. - case.poisson))
    block = 1e3 * BLOCK * max(a, b)
    if block > 0.9 * min(radius, crown):
        raise DataError(f"the patch, {2e3 * a:.3g} x {2e3 * b:.3g} mm, is too large for bodies with radii of {radius:.4g} and {crown:.4g} "
                        f"mm to be half-spaces: finite elements ask for {BLOCK / 0.9:.3g} semi-axes in the smaller radius")
    mirror = -1. if case.backwards else 1.
    # Rigid slip in the middle of the patch over the mean of both surfaces' speeds; tread counts it over the speed of the wheel's centre.
    along = mirror * (result["creepage"] + case.spin * case.spin_y)
    across = result["lateral_creepage"] - case.spin * case.spin_x
    creepage = -along / (1. + 0.5 * along) + 0.
    slower = 1. + 0.5 * creepage
    motion = {"Contact/Friction coefficient": case.friction, "Motion/Creepage": creepage, "Motion/Lateral creepage": across * slower,
              "Motion/Spin (1 per m)": mirror * case.spin * slower}
    if not case.tangential:
        motion = dict.fromkeys(motion, 0.)
    weight = result["normal_force_N"] / GRAVITY
    mass = min(max(MASS, 0.1 * weight), 0.99 * weight)
    young = 2. * (1. + case.poisson) * case.shear_modulus
    bodies = {"Young's modulus (GPa)": 1e-9 * young, "Poisson's ratio": case.poisson, "Density (kg per m3)": DENSITY * young / YOUNG}
    return {
        **STEADY, **{f"{body}/{name}": value for body in ("Wheel", "Rail") for name, value in bodies.items()},
        "Wheel/Radius (mm)": radius, "Wheel/Sector thickness (mm)": block, "Wheel/Sector width (mm)": 2. * block,
        "Wheel/Sector margin (mm)": block,
        "Wheel/Mass (kg)": mass, "Wheel/Moment of inertia (kg m2)": INERTIA * mass * (1e-3 * radius) ** 2,
        "Vehicle/Wheel load (kN)": 1e-3 * result["normal_force_N"], "Vehicle/Suspension stiffness (kN per m)": STIFFNESS * (weight - mass),
        "Vehicle/Suspension damping (N s per m)": DAMPING * (weight - mass),
        "Rail/Shape": "block", "Rail/Crown radius (mm)": crown, "Rail/Block width (mm)": 2. * block, "Rail/Block height (mm)": block,
        "Rail/Margin (mm)": block, **motion, "Motion/Rolled distance (mm)": _rolled_distance(2. * a),
        "Mesh/Finest cell (mm)": cell or cell_of(2. * a, 2. * b)}


def roll_upright(case: Case, result: dict, settings: dict[str, Any], output: str, title: str = "", ranks: int = 1,
                 program: str = PROGRAM) -> tuple[Run, dict]:
    """Roll the scene of upright_wheel().

    Returns the run and {name: value} with the names of contact_inp.SUMMARY, in the file's axes and signs; nan for what finite elements do
    not tell: the approach, to which the bodies as a whole belong, and the power as a sum over elements. Raises ProgramError.
    """
    answer = _roll(settings, output, title, ranks, program)
    summary, patch = answer.summary, answer.patch
    mirror = -1. if case.backwards else 1.
    slower = 3.6 * case.speed / SPEED_KM_H
    cell = float(settings["Mesh/Finest cell (mm)"])
    moment = mirror * 1e-3 * float((patch.area * (patch.x * patch.shear_y - patch.y * patch.shear_x)).sum())
    return answer, {
        **{name: result[name] for name in ("case", "line", "friction_coefficient", "creepage", "lateral_creepage", "spin_per_m")},
        "normal_force_N": summary["normal_force_N"], "longitudinal_force_N": mirror * summary["longitudinal_force_N"],
        "lateral_force_N": summary["lateral_force_N"] + 0., "spin_moment_Nm": moment, "approach_mm": np.nan,
        "max_pressure_MPa": 1e-6 * summary["max_pressure_Pa"], "patch_area_mm2": 1e6 * summary["patch_area_m2"],
        "adhesion_share": summary["adhesion_share"] if case.tangential else 1., "max_shear_MPa": 1e-6 * summary["max_shear_Pa"],
        "max_slip_m_per_s": slower * summary["max_slip_m_per_s"] if case.tangential else 0.,
        "frictional_power_W": slower * summary["frictional_power_W"], "frictional_power_of_elements_W": np.nan,
        "element_x_mm": cell, "element_y_mm": cell, "reaches_border": False}
