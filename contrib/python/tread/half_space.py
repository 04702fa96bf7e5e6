# SPDX-License-Identifier: LGPL-2.1-or-later
"""Steady rolling of two elastic half-spaces, many contacts at once: the library libtread_half_space.

    import numpy as np
    from tread import half_space

    answers = half_space.solve(curvature_x=1.087, curvature_y=1.667, normal_force=127.1e3, friction=0.3,
                               creepage=np.linspace(-4e-3, 0, 1000))
    answers["longitudinal_force"]                 # (1000,) array, N

Axes, signs and units are those of include/tread/half_space.h: forces act on the wheel, a driving wheel has a negative creepage.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import functools
import os
import shutil
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from .files import Error
from .runs import ROOT

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

VERSION = 1  # TREAD_HALF_SPACE_VERSION

# tread_half_space_case and tread_half_space_answer.
_NUMBERS = ("curvature_x", "curvature_y", "normal_force", "friction", "young", "poisson", "creepage", "lateral_creepage", "spin",
            "element_x", "element_y")
_CASE = np.dtype([(name, float) for name in _NUMBERS] + [
    ("slip_order", np.intc), ("gap", np.uintp), ("n_x", np.uintc), ("n_y", np.uintc), ("x_first", float), ("y_first", float)], align=True)
_ANSWER = np.dtype([("status", np.intc), ("iterations", np.intc)] + [(name, float) for name in (
    "longitudinal_force", "lateral_force", "spin_moment", "max_pressure", "adhesion_share", "area", "approach", "frictional_work")],
    align=True)
_DAMAGE = np.dtype([(name, float) for name in ("friction_used", "shakedown_load_factor", "surface_fatigue_index", "t_gamma_per_area",
                                               "regime_wear_rate")], align=True)
_WAY = np.dtype([("n", np.uintp), ("heights", np.uintp), ("normal_force", np.uintp), ("creepage", np.uintp)], align=True)
_GRID = np.dtype([("n_x", np.uintc), ("n_y", np.uintc)] + [(name, float) for name in ("element_x", "element_y", "x_first", "y_first")],
                 align=True)
FIELDS = ("pressure", "shear_x", "shear_y", "slip_x", "slip_y", "state")


def library_path() -> str:
    """Of $TREAD_HALF_SPACE_LIBRARY, of the source tree's build, beside the program, or where the system looks. @raises Error"""
    name = "libtread_half_space.so"
    program = shutil.which("tread")
    beside = [os.path.join(os.path.dirname(os.path.realpath(program)), os.pardir, folder, name) for folder in ("lib", "lib64")] if program else []
    for path in (os.environ.get("TREAD_HALF_SPACE_LIBRARY"), os.path.join(ROOT, "build/source", name), *beside,
                 ctypes.util.find_library("tread_half_space")):
        if path and (os.path.exists(path) or os.sep not in path):
            return path
    raise Error(f"{name} is not found: build it (cmake --build build --target tread_half_space), or name its file in $TREAD_HALF_SPACE_LIBRARY")


@functools.lru_cache(maxsize=None)
def _library() -> ctypes.CDLL:
    path = library_path()
    try:
        library = ctypes.CDLL(path)
        version = library.tread_half_space_version()
    except (OSError, AttributeError) as error:
        raise Error(f"{path}: {error}") from None
    if version != VERSION:
        raise Error(f"{path}: has version {version} of the interface where this package knows {VERSION}")
    pointer = ctypes.c_void_p
    library.tread_half_space_create.restype = pointer
    library.tread_half_space_destroy.argtypes = [pointer]
    library.tread_half_space_solve.argtypes = [pointer] * 3
    library.tread_half_space_roll.argtypes = [pointer] * 6
    library.tread_half_space_damage_of.argtypes = [pointer, pointer, ctypes.c_size_t, pointer, pointer]
    library.tread_half_space_damage_of.restype = None
    library.tread_half_space_message.argtypes = [pointer]
    library.tread_half_space_message.restype = ctypes.c_char_p
    library.tread_half_space_get_grid.argtypes = [pointer] * 2
    library.tread_half_space_get_field.argtypes = [pointer, ctypes.c_int, pointer]
    library.tread_half_space_solve_all.argtypes = [pointer, ctypes.c_size_t, ctypes.c_uint, pointer]
    library.tread_half_space_solve_all.restype = ctypes.c_size_t
    return library


def _refuse_masked(values: Mapping[str, ArrayLike]) -> None:
    masked = sorted(name for name, value in values.items() if np.ma.is_masked(value))
    if masked:
        raise TypeError(f"{', '.join(masked)}: masked values are no numbers; leave them out, or fill them")


def _cases(settings: Mapping[str, ArrayLike], slip_order: ArrayLike, contact_sixth: bool) -> tuple[np.ndarray, tuple[int, ...]]:
    """(cases, their shape): numbers and arrays that broadcast become structs."""
    unknown = sorted(set(settings) - set(_NUMBERS))
    if unknown:
        raise TypeError(f"unknown: {', '.join(unknown)}; known are {', '.join(_NUMBERS)}")
    _refuse_masked(settings)
    settings = {"young": 210e9, "poisson": 0.3, **settings}
    arrays = np.broadcast_arrays(*[np.asarray(value, dtype=float) for value in settings.values()], np.asarray(slip_order, dtype=np.intc))
    cases = np.zeros(arrays[0].shape, _CASE)
    for name, values in zip([*settings, "slip_order"], arrays):
        cases[name] = values
    if contact_sixth:
        if not (cases["element_x"] > 0.).all():
            raise TypeError("contact_sixth needs element_x above 0: what CONTACT adds is a sixth of its own element")
        cases["lateral_creepage"] += cases["spin"] * cases["element_x"] / 6.
    return np.ascontiguousarray(cases.reshape(-1)), arrays[0].shape


class HalfSpaceError(Error):
    """A case that was not solved, with the library's reason."""


def solve(*, slip_order: ArrayLike = 2, contact_sixth: bool = False, threads: int = 0, on_failure: str = "raise",
          **settings: ArrayLike) -> dict[str, np.ndarray]:
    """Solve cases of Hertzian contacts on all cores.

    curvature_x, curvature_y  A, B of the gap A x^2 + B y^2, 1/m
    normal_force, friction    N, Coulomb's coefficient
    young, poisson            of both bodies, Pa; steel by default
    creepage, lateral_creepage, spin   rigid slip over the speed, spin in rad/m; 0 by default
    element_x, element_y      edges of the elements, m; 0, the default: a 28th of the semi-axis in rolling direction, a tenth across
    slip_order                2, or 1: slip as in CONTACT
    contact_sixth             add spin element_x/6 to the lateral creepage, as CONTACT does for its steps; needs element_x
    threads                   0: all cores
    on_failure                "raise", or "nan": cases that are not solved have nan and a status that is not 0

    Each a number or an array; they are broadcast. Returns {name: array of their shape}: status, iterations, longitudinal_force and
    lateral_force (N, on the wheel), spin_moment (N m), max_pressure (Pa), adhesion_share, area (m^2), approach (m), frictional_work
    (J for each metre). Raises HalfSpaceError.
    """
    if threads < 0:
        raise TypeError("threads must be 0 or more")
    cases, shape = _cases(settings, slip_order, contact_sixth)
    answers = np.zeros(len(cases), _ANSWER)
    failed = _library().tread_half_space_solve_all(cases.ctypes.data, len(cases), threads, answers.ctypes.data)
    if failed and on_failure == "raise":
        first = int(np.flatnonzero(answers["status"])[0])
        with _Solver() as solver:
            solver.solve(cases[first:first + 1], f"{failed} of {len(cases)} cases were not solved; the first is number {first}: ")
    return {name: answers[name].reshape(shape) for name in _ANSWER.names}


def damage(answers: Mapping[str, ArrayLike], *, normal_force: ArrayLike, shear_strength: ArrayLike = 0.) -> dict[str, np.ndarray]:
    """What the patches of solved cases do to the surfaces: indices of doc/damage.md.

    answers         of solve(), for these cases
    normal_force    theirs, N
    shear_strength  yield stress in shear k, from 1e6 to 1e11 Pa; 0 or nan: not known, the two indices that need it are nan

    Returns {name: array}: friction_used (tangential over normal force), shakedown_load_factor (p0/k), surface_fatigue_index,
    t_gamma_per_area (Pa), regime_wear_rate (kg/m^3, of a wheel of R8T on a rail of 900A). Cases that were not solved have nan.
    Raises TypeError for masked values, and for forces that cannot be those of the answers: pressure over area carries another.
    """
    _refuse_masked({"normal_force": normal_force, "shear_strength": shear_strength, **answers})
    if missing := [name for name in _ANSWER.names if name not in answers]:
        raise TypeError(f"answers lack {', '.join(missing)}: give all that solve() returned")
    forces, strengths, *_ = np.broadcast_arrays(np.asarray(normal_force, dtype=float), np.asarray(shear_strength, dtype=float),
                                                np.asarray(answers["status"]))
    is_solved = np.broadcast_to(np.asarray(answers["status"]) == 0, forces.shape)
    # The mean pressure of an ellipse is two thirds of the largest; that of other patches lies between.
    share = forces / (np.asarray(answers["max_pressure"]) * np.asarray(answers["area"]))
    wrong = np.flatnonzero(is_solved & ~((share > 0.3) & (share < 1.)))
    if wrong.size:
        raise TypeError(f"normal_force of case {wrong[0]}, {forces.reshape(-1)[wrong[0]]:g} N, is not that of its answer")
    if not (np.isnan(strengths) | (strengths == 0.) | ((strengths >= 1e6) & (strengths <= 1e11))).all():
        raise TypeError("shear_strength must be from 1e6 to 1e11 Pa, or 0 or nan where it is not known")
    solved, cases, damages = np.zeros(forces.shape, _ANSWER), np.zeros(forces.shape, _CASE), np.zeros(forces.shape, _DAMAGE)
    for name in _ANSWER.names:
        solved[name] = answers[name]
    cases["normal_force"] = forces
    strengths = np.ascontiguousarray(strengths)
    _library().tread_half_space_damage_of(cases.ctypes.data, solved.ctypes.data, cases.size, strengths.ctypes.data, damages.ctypes.data)
    return {name: damages[name] for name in _DAMAGE.names}


class _Solver:
    def __enter__(self) -> _Solver:
        self.library = _library()
        self.handle = self.library.tread_half_space_create()
        return self

    def __exit__(self, *_: object) -> None:
        self.library.tread_half_space_destroy(self.handle)

    def solve(self, case: np.ndarray, what: str = "") -> np.ndarray:
        answer = np.zeros(1, _ANSWER)
        if self.library.tread_half_space_solve(self.handle, case.ctypes.data, answer.ctypes.data):
            raise HalfSpaceError(what + self.message())
        return answer

    def message(self) -> str:
        return self.library.tread_half_space_message(self.handle).decode()


def _exclude_curvatures(settings: Mapping[str, object]) -> None:
    void = sorted({"curvature_x", "curvature_y"} & set(settings))
    if void:
        raise TypeError(f"gap excludes {' and '.join(void)}: it is the whole gap")


def _set_gap(case: np.ndarray, gap: ArrayLike, x_first: float, y_first: float) -> np.ndarray:
    """What must live as long as the case is used."""
    if np.ma.is_masked(gap):
        raise TypeError("gap has masked values, which are no numbers: fill them with a height that is out of contact")
    gap = np.ascontiguousarray(gap, dtype=float)
    if gap.ndim != 2:
        raise TypeError("gap must be an (n_y, n_x) array")
    case["gap"], case["n_y"], case["n_x"] = gap.ctypes.data, *gap.shape
    case["x_first"], case["y_first"] = x_first, y_first
    return gap


def roll(*, gap: ArrayLike, x_first: float, y_first: float, heights: ArrayLike | None = None, normal_force: ArrayLike, creepage: ArrayLike = 0.,
         slip_order: int = 2, **settings: float) -> dict[str, np.ndarray]:
    """Transient rolling over a rail whose height changes along the way, from steady rolling in the first step.

    gap, x_first, y_first     as for solve_patch(); an element has its centre at x = 0
    heights                   (n,) of the rail's surface, m, alike across: of the elements along the way, one for each step; 0 by default
    normal_force, creepage    N and longitudinal creepage, a number or (n,) arrays
    Others as for solve(), numbers all; element_x and element_y must be given, friction above 0.

    Returns {name: array}: approach (n,) in m, longitudinal_force (n,) in N on the wheel, and work (n_y, n), the work of friction per area of
    the rail, J/m^2; elements near both ends of the way have not been passed by all of the patch. Raises HalfSpaceError.
    """
    _exclude_curvatures(settings)
    given = {"heights": heights, "normal_force": normal_force, "creepage": creepage}
    along = {name: np.array(values, dtype=float) for name, values in given.items() if values is not None}
    sizes = {values.size for values in along.values() if values.ndim == 1}
    if len(sizes) != 1 or any(values.ndim > 1 or np.ma.is_masked(given[name]) for name, values in along.items()):
        raise TypeError("heights, normal_force and creepage must be numbers or arrays of one length, one of them an array, without masked values")
    case, shape = _cases({**settings, **{name: float(values) for name, values in along.items() if values.ndim == 0 and name != "heights"}}, slip_order, False)
    if shape:
        raise TypeError("all but heights, normal_force and creepage must be numbers")
    gap = _set_gap(case, gap, x_first, y_first)
    way, n = np.zeros(1, _WAY), sizes.pop()
    way["n"] = n
    for name, values in along.items():
        if values.ndim == 1:
            way[name] = values.ctypes.data
        elif name == "heights":
            raise TypeError("heights must be an array")
    result = {"approach": np.empty(n), "longitudinal_force": np.empty(n), "work": np.empty((len(gap), n))}
    with _Solver() as solver:
        if solver.library.tread_half_space_roll(solver.handle, case.ctypes.data, way.ctypes.data, *[values.ctypes.data for values in result.values()]):
            raise HalfSpaceError(solver.message())
    return result


def solve_patch(*, gap: ArrayLike | None = None, x_first: float = 0., y_first: float = 0., slip_order: int = 2, contact_sixth: bool = False,
                **settings: float) -> dict:
    """Solve one case, of any gap, with its fields.

    gap    (n_y, n_x) array of the undeformed gap, m, on elements element_x by element_y whose first centre is (x_first, y_first);
           without it that of curvature_x and curvature_y
    Others as for solve(), numbers all.

    Returns {name: value}: as of solve(), and x (n_x,), y (n_y,) in m, and (n_y, n_x) arrays pressure, shear_x, shear_y (Pa, on the
    wheel), slip_x, slip_y (over the speed) and state (0: no contact, 1: adhesion, 2: slip). Raises HalfSpaceError.
    """
    case, _ = _cases(settings, slip_order, contact_sixth)
    if len(case) != 1:
        raise TypeError(f"solve_patch() solves one case and was given {len(case)}: call it for each, or solve() for the forces of ellipses")
    if gap is not None:
        _exclude_curvatures(settings)
        gap = _set_gap(case, gap, x_first, y_first)
    with _Solver() as solver:
        answer = solver.solve(case)
        grid = np.zeros(1, _GRID)
        solver.library.tread_half_space_get_grid(solver.handle, grid.ctypes.data)
        of = grid[0]
        result = {name: answer[name][0] for name in _ANSWER.names}
        result["x"] = of["x_first"] + of["element_x"] * np.arange(of["n_x"])
        result["y"] = of["y_first"] + of["element_y"] * np.arange(of["n_y"])
        for number, name in enumerate(FIELDS):
            values = np.empty((of["n_y"], of["n_x"]))
            solver.library.tread_half_space_get_field(solver.handle, number, values.ctypes.data)
            result[name] = values
    return result
