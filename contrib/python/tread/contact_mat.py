# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields of a case in the layout of CONTACT's matlab files (CONTACT's user guide, appendix A, "<experim>.<case>.mat"), which its scripts
loadcase.m and plot3d.m read.

A file holds numbers as text, eleven in each row, with comments behind %: three rows with the places of rail, wheel and contact, a row each
for the grid, the material and the friction, and then a row for each element in contact: number I = ix + MX (iy - 1), state (1: adhesion,
2: slip), undeformed distance, friction coefficient, tractions on body 1 (normal, x, y), displacements of body 1 less those of body 2
(normal, x, y), size of the slip over the speed. Lengths are in mm, stresses in MPa, angles in rad. Scripts of CONTACT from version 23.2 on
read format 2320.
"""

from __future__ import annotations

import dataclasses
import math
import os
from typing import TextIO

import numpy as np

from .contact_cases import Area, Case
from .contact_track import TrackCase, signs
from .files import DataError
from .runs import Run

FORMAT = 2320
COLUMNS = 11
# What the rows before the elements hold.
ROWS = ("TIM S_WS TH_WS Y_R Z_R ROLL_R RNOM_ROL - - - FMT", "X_W Y_W Z_W ROLL_W YAW_W RNOM_WHL",
        "X_CP(R) Y_CP(R) Z_CP(R) DELT_CP(R) X_CP(W) Y_CP(W) Z_CP(W) NPATCH IPATCH SPINXO SPINYO", "MX MY XL YL DX DY CHI DQ C1 D YNOM_WHL",
        "T M GG1 GG2 POISS1 POISS2", "L H VELOC FSTAT FKIN", "I IGS H MU PN PX PY UN UX UY SREL")
RIGHT, PLANE = 1, 2  # digits C1 and D of module 3, where they say nothing


@dataclasses.dataclass
class Fields:
    """Answers on the elements of a patch, (n_y, n_x) arrays in CONTACT's axes and signs, SI units."""

    pressure: np.ndarray  # Pa
    shear_x: np.ndarray  # on body 1, Pa
    shear_y: np.ndarray
    slip: np.ndarray  # size, over the speed
    state: np.ndarray  # 0: no contact, 1: adhesion, 2: slip
    gap: np.ndarray | None = None  # of the undeformed bodies, m; None: where they touch it is the approach less what they give way
    approach: float = 0.  # m


@dataclasses.dataclass
class Conditions:
    """What a case says beside its fields, SI units."""

    shear_modulus: float
    poisson: float
    friction: float
    speed: float
    step: float  # rolled in a step of CONTACT, m; 1 mm where nothing rolls
    tangential: bool = True
    backwards: bool = False
    spin_x: float = 0.
    spin_y: float = 0.


@dataclasses.dataclass
class Place:
    """Of a patch between a wheel and a rail, in the units of the file: the rows of places, and what the grid's row says of the wheel."""

    rail: tuple[float, ...] = ()  # TIM to RNOM_ROL
    wheel: tuple[float, ...] = ()  # X_W to RNOM_WHL
    contact: tuple[float, ...] = 7 * (0.,)  # X_CP(R) to Z_CP(W)
    number_of_patches: int = 0
    patch: int = 0
    config: int = RIGHT
    wheel_y: float = 0.  # YNOM_WHL


def displacements(area: Area, fields: Fields, shear_modulus: float, poisson: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Three (n_y, n_x) arrays, m: by how much body 1 is displaced more than body 2 at the middle of each element, away from body 2, along x
    and along y, when tractions are constant on each element and both half-spaces have the same constants (Boussinesq and Cerruti; Johnson
    1985, section 3.2 and 3.6)."""
    n_x, n_y = area.n_x, area.n_y
    # Of distances between middles, edges of the loaded element lie half an element to both sides.
    u = area.element_x * (np.arange(-n_x, n_x + 1) - 0.5)
    v = area.element_y * (np.arange(-n_y, n_y + 1) - 0.5)[:, None]
    distance = np.hypot(u, v)

    def over_elements(integral: np.ndarray) -> np.ndarray:
        """Transform of the integral over an element by its values at corners; element (0, 0) first, negative distances at the end."""
        values = integral[1:, 1:] - integral[:-1, 1:] - integral[1:, :-1] + integral[:-1, :-1]
        return np.fft.rfft2(np.roll(values, (-n_y, -n_x), axis=(0, 1)))

    along, across = v * np.arcsinh(u / np.abs(v)), u * np.arcsinh(v / np.abs(u))  # of u^2/R^3 and v^2/R^3; their sum is that of 1/R
    xx, yy, xy = over_elements(along), over_elements(across), over_elements(-distance)
    shape = 2 * n_y, 2 * n_x
    p, q_x, q_y = (np.fft.rfft2(values, shape) for values in (fields.pressure, fields.shear_x, fields.shear_y))
    factor = 1. / (math.pi * shear_modulus)
    back = lambda values: factor * np.fft.irfft2(values, shape)[:n_y, :n_x]
    return (back((1. - poisson) * (xx + yy) * p), back((xx + (1. - poisson) * yy) * q_x + poisson * xy * q_y),
            back((yy + (1. - poisson) * xx) * q_y + poisson * xy * q_x))


def write_mat(path: str, area: Area, fields: Fields, conditions: Conditions, place: Place = Place()) -> None:
    """Write the elements in contact with what belongs to them."""
    rows, columns = np.nonzero(fields.state)
    box = slice(rows.min(), rows.max() + 1), slice(columns.min(), columns.max() + 1)
    loaded = dataclasses.replace(fields, pressure=fields.pressure[box], shear_x=fields.shear_x[box], shear_y=fields.shear_y[box])
    of_box = dataclasses.replace(area, n_y=loaded.pressure.shape[0], n_x=loaded.pressure.shape[1])
    u_n, u_x, u_y = (values[rows - rows.min(), columns - columns.min()]
                     for values in displacements(of_box, loaded, conditions.shear_modulus, conditions.poisson))
    of = lambda values: values[rows, columns]
    gap = fields.approach - u_n if fields.gap is None else of(fields.gap)
    table = np.column_stack([
        columns + 1 + area.n_x * rows, of(fields.state), 1e3 * gap, np.full(len(rows), conditions.friction), 1e-6 * of(fields.pressure),
        1e-6 * of(fields.shear_x), 1e-6 * of(fields.shear_y), 1e3 * u_n, 1e3 * u_x, 1e3 * u_y, of(fields.slip)])
    shear_modulus = 1e-6 * conditions.shear_modulus
    heads = (
        (*place.rail, *(10 - len(place.rail)) * (0.,), FORMAT), place.wheel,
        (*place.contact, place.number_of_patches, place.patch, 1e3 * conditions.spin_x, 1e3 * conditions.spin_y),
        (area.n_x, area.n_y, 1e3 * (area.x_first - 0.5 * area.element_x), 1e3 * (area.y_first - 0.5 * area.element_y), 1e3 * area.element_x,
         1e3 * area.element_y, math.pi if conditions.backwards else 0., 1e3 * conditions.step, place.config, PLANE, place.wheel_y),
        (3 if conditions.tangential else 0, 0, shear_modulus, shear_modulus, conditions.poisson, conditions.poisson),
        (0, 0, 1e3 * conditions.speed, conditions.friction, conditions.friction))
    with open(path + ".part", "w", encoding="ascii") as stream:
        for names, values in zip(ROWS, heads):
            _write_row(stream, names, (*values, *(COLUMNS - len(values)) * (0.,)))
        _write_row(stream, ROWS[-1], None)
        np.savetxt(stream, table, fmt=["%8d", "%3d", *(COLUMNS - 2) * ["%16.9e"]])
    os.replace(path + ".part", path)


def _write_row(stream: TextIO, names: str, values: tuple[float, ...] | None) -> None:
    print("%", names, file=stream)
    if values:
        print(*(f"{value + 0.:.12g}" for value in values), file=stream)


def mat_path(folder: str, name: str, case: int, patch: int = 0) -> str:
    """Where CONTACT's scripts look: NAME.0001.mat, of a patch of module 1 NAME.0001a.mat."""
    return os.path.join(folder, f"{name}.{case:04d}{chr(96 + patch) if patch else ''}.mat")


def write_mat_of_case(path: str, case: Case, result: dict) -> None:
    """Of a case of module 3 with its answer by contact_inp.solve_case()."""
    slip = np.hypot(result["slip_x"], result["slip_y"]) if case.tangential else np.zeros(case.gap.shape)
    speed, step = (case.speed, case.step) if case.tangential else (1e-3, 1e-3)
    write_mat(path, case.area, Fields(result["pressure"], result["shear_x"], result["shear_y"], slip, result["state"], case.gap),
              Conditions(case.shear_modulus, case.poisson, case.friction, speed, step, case.tangential, case.backwards, case.spin_x,
                         case.spin_y))


def write_mats_of_track_case(folder: str, name: str, case: TrackCase, run: Run) -> None:
    """Of a case of module 1 that was solved by half-space theory: a file for each patch."""
    table = run.table("patch.csv")
    patches = run.summary["patches"]
    counts = [round(patch["area_m2"] / (patch["element_x_m"] * patch["element_y_m"])) for patch in patches]
    if sum(counts) != len(table["x_mm"]):
        raise DataError(f"{run.path('patch.csv')}: has {len(table['x_mm'])} elements where summary.json has {sum(counts)}")
    young, poisson = 1e9 * case.settings["Rail/Young's modulus (GPa)"], case.settings["Rail/Poisson's ratio"]
    ends = np.cumsum(counts)
    for number, (patch, end, count) in enumerate(zip(patches, ends, counts), 1):
        area, fields = _fields_of_patch(case, patch, {column: values[end - count:end] for column, values in table.items()})
        conditions = Conditions(young / (2. * (1. + poisson)), poisson, case.settings["Contact/Friction coefficient"],
                                patch["rolling_speed_m_per_s"], area.element_x)
        write_mat(mat_path(folder, name, case.number, number), area, fields, conditions, _place(case, run.summary, number))


def _fields_of_patch(case: TrackCase, patch: dict, table: dict[str, np.ndarray]) -> tuple[Area, Fields]:
    """Grid and fields of the elements of one patch: columns of patch.csv, in axes of the rail."""
    factor = signs(case.side)
    own, angle = factor["y_m"], patch["angle_rad"]
    x = 1e-3 * table["x_mm"] - patch["x_m"]
    s = own * ((1e-3 * table["y_mm"] - patch["y_rail_m"]) * math.cos(angle) + (1e-3 * table["z_mm"] - patch["z_m"]) * math.sin(angle))
    size_x, size_y = patch["element_x_m"], patch["element_y_m"]
    columns, rows = _lines((x - x.min()) / size_x), _lines((s - s.min()) / size_y)
    area = Area(int(columns.max()) + 1, int(rows.max()) + 1, float(x.min()), float(s.min()), size_x, size_y)

    def on_grid(values: np.ndarray) -> np.ndarray:
        grid = np.zeros((area.n_y, area.n_x))
        grid[rows, columns] = values
        return grid

    slip = np.hypot(table["slip_x_m_per_s"], table["slip_y_m_per_s"]) / patch["rolling_speed_m_per_s"]
    return area, Fields(on_grid(1e6 * table["pressure_MPa"]), on_grid(1e6 * factor["longitudinal_force_N"] * table["shear_x_MPa"]),
                        on_grid(1e6 * factor["lateral_force_N"] * table["shear_y_MPa"]), on_grid(slip),
                        on_grid(np.where(table["state"] == "adhesion", 1., 2.)), approach=patch["overlap_m"])


def _lines(places: np.ndarray) -> np.ndarray:
    """(n,) numbers of the lines of a grid on which places lie, over their distance. @raises DataError"""
    lines = np.rint(places).astype(int)
    if np.abs(places - lines).max() > 0.01:
        raise DataError("the elements of a patch are not on a grid")
    return lines


def _place(case: TrackCase, summary: dict, number: int) -> Place:
    """Rail, wheel and contact point in the track: x forward, y to the right, z down, mm. The rail's marker is the middle of its top, that
    of the wheel lies on its rolling circle."""
    patch, of = summary["patches"][number - 1], lambda name: case.settings.get("Wheelset/" + name, 0.)
    own = signs(case.side)["y_m"]
    radius = case.settings["Wheel/Radius (mm)"]
    wheel_y = 0.5 * of("Flange-back distance (mm)") - of("Flange back (mm)")
    yaw, roll = own * 1e-3 * of("Yaw (mrad)"), own * 1e-3 * of("Roll (mrad)")
    axle = np.array([0., own * of("Lateral shift (mm)"), -1e3 * summary["wheelset_height_m"] - radius])
    cos_yaw, sin_yaw, cos_roll, sin_roll = math.cos(yaw), math.sin(yaw), math.cos(roll), math.sin(roll)
    turned = np.array([[cos_yaw, -sin_yaw * cos_roll, sin_yaw * sin_roll], [sin_yaw, cos_yaw * cos_roll, -cos_yaw * sin_roll],
                       [0., sin_roll, cos_roll]])
    wheel = axle + turned @ [0., own * wheel_y, radius]
    contact = 1e3 * np.array([patch["x_m"], own * patch["y_m"], -patch["z_m"]])
    rail = np.array([0., own * 1e3 * (patch["y_m"] - patch["y_rail_m"]), 0.])
    angle = signs(case.side)["angle_rad"] * patch["angle_rad"]
    return Place((0., 0., 0., rail[1], rail[2], 0., 0.), (*wheel, roll, yaw, radius),
                 (*(contact - rail), angle, *(turned.T @ (contact - wheel))), len(summary["patches"]), number, int(case.side == "right"),
                 wheel_y)
