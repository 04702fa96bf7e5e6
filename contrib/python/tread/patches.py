# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact patches: patch.csv of a run, and surface files of CONTACT."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .files import DataError, Error, read_table


class Patch:
    """Tractions and slip of the nodes (or elements) of a contact patch, each a (nodes in contact,) array in the units of `units`.

    Shear is that on the wheel, slip that of the wheel's surface relative to the rail's.
    """

    units = {"x": "mm", "y": "mm", "pressure": "MPa", "shear_x": "MPa", "shear_y": "MPa", "slip_x": "m/s", "slip_y": "m/s", "area": "mm2",
             "shear": "MPa", "slip": "m/s"}
    slip_fields = ("slip_x", "slip_y")
    fields = ("pressure", "shear_x", "shear_y", *slip_fields)
    pressure: np.ndarray
    shear_x: np.ndarray
    shear_y: np.ndarray
    slip_x: np.ndarray
    slip_y: np.ndarray

    def __init__(self, path: str, table: dict[str, np.ndarray], names: tuple[str, ...]):
        self.path = path
        self.x, self.y = table["x_mm"], table["y_mm"]
        for field, name in zip(self.fields, names):
            setattr(self, field, table.get(name, np.zeros(len(self.x))))
        state = table["state"]
        unknown = set(state) - {"adhesion", "slip", "exterior", "separated", "none"}
        if unknown:
            raise DataError(f"{path}: unknown state '{sorted(unknown)[0]}' (adhesion, slip or exterior)")
        inside = (state == "adhesion") | (state == "slip")
        self.adhesion = (state == "adhesion")[inside]
        for field in ("x", "y") + self.fields:
            setattr(self, field, getattr(self, field)[inside])
        if not inside.any():
            raise DataError(f"{path}: no node in contact")
        if not all(np.isfinite(getattr(self, field)).all() for field in ("x", "y") + self.fields):
            raise DataError(f"{path}: a value is not finite")
        self.size_x, self.size_y = spacing(self.x), spacing(self.y)
        area = table.get("area_mm2")
        self.area = np.full(len(self.x), self.size_x * self.size_y) if area is None else area[inside]

    @property
    def shear(self) -> np.ndarray:
        return np.hypot(self.shear_x, self.shear_y)

    @property
    def slip(self) -> np.ndarray:
        return np.hypot(self.slip_x, self.slip_y)

    @property
    def normal_force(self) -> float:
        """The sum of the pressure over the patch, N: MPa and mm2 give N."""
        return float((self.pressure * self.area).sum())

    @property
    def adhesion_share(self) -> float:
        return self.area[self.adhesion].sum() / self.area.sum()

    def centroid(self) -> tuple[float, float]:
        """Centre of pressure."""
        weight = self.pressure * self.area
        return (weight * self.x).sum() / weight.sum(), (weight * self.y).sum() / weight.sum()

    def friction_coefficient(self) -> float | None:
        """What the slipping nodes that carry load say; None without any."""
        loaded = ~self.adhesion & (self.pressure > 0.2 * self.pressure.max())
        return float(np.median(self.shear[loaded] / self.pressure[loaded])) if loaded.any() else None

    def values_of(self, values: np.ndarray | str) -> np.ndarray:
        """Values of the nodes in contact, or those of a field by its name. @raises Error for another name or number of values"""
        if isinstance(values, str):
            names = (*self.units, "adhesion")
            if values not in names:
                raise Error(f"a contact patch has no field '{values}', but {', '.join(names)}")
            values = getattr(self, values)
        values = np.asarray(values, float)
        if values.shape != self.x.shape:
            raise Error(f"{values.size} values for the {len(self.x)} nodes in contact: give one for each of them, or the name of a field, such as 'pressure'")
        return values

    def grid(self, values: np.ndarray | str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(x, y, table) for pictures and interpolation: the coordinates of the grid's columns and rows in mm, and the values as table[row, column],
        y before x as matplotlib and numpy want it, nan outside the contact. An empty row or column surrounds the patch.

        values  the name of a field: "pressure", "shear_x", "shear_y", "shear", "slip_x", "slip_y", "slip", "area", "adhesion" (1 or 0); or one
                value for each node in contact
        """
        values = self.values_of(values)
        columns, x0, n_x = grid_index(self.x, self.size_x)
        rows, y0, n_y = grid_index(self.y, self.size_y)
        result = np.full((n_y, n_x), np.nan)
        result[rows, columns] = values
        return x0 + self.size_x * np.arange(n_x), y0 + self.size_y * np.arange(n_y), result

    def sampled(self, values: np.ndarray | str, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """A field by its name, or one value for each node in contact, interpolated bilinearly at the points (x, y) in mm; zero outside the patch."""
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        gx, gy, grid = self.grid(values)
        grid = np.nan_to_num(grid)
        i = np.clip(((x - gx[0]) / self.size_x).astype(int), 0, len(gx) - 2)
        j = np.clip(((y - gy[0]) / self.size_y).astype(int), 0, len(gy) - 2)
        s, t = (x - gx[i]) / self.size_x, (y - gy[j]) / self.size_y
        value = ((1 - s) * (1 - t) * grid[j, i] + s * (1 - t) * grid[j, i + 1]
                 + (1 - s) * t * grid[j + 1, i] + s * t * grid[j + 1, i + 1])
        outside = (x < gx[0]) | (x > gx[-1]) | (y < gy[0]) | (y > gy[-1])
        return np.where(outside, 0.0, value)

    def averaged(self, values: np.ndarray | str, x: np.ndarray, y: np.ndarray, width_x: float, width_y: float) -> np.ndarray:
        """Means of what `sampled` gives over rectangles of width_x by width_y, mm, around the points (x, y): at 8 by 8 places each, at one where
        the rectangle has no width."""
        places = [width * ((np.arange(8) + 0.5) / 8 - 0.5) if width > 0 else np.zeros(1) for width in (width_x, width_y)]
        return np.mean([self.sampled(values, x + along, y + across) for along in places[0] for across in places[1]], axis=0)


class Instant(NamedTuple):
    """A patch on the way; its x counts along the rail."""

    time_s: float
    position_mm: float  # of the wheel
    patch: Patch


def spacing(values: np.ndarray) -> float:
    """The distance of the grid lines to which the coordinates belong."""
    points = np.unique(np.round(values, 6))
    gaps = np.diff(points)
    if not len(gaps):
        return 1.0
    # Nodes of one line differ a little: its place is their mean.
    lines = [line.mean() for line in np.split(points, np.nonzero(gaps > 0.3 * gaps.max())[0] + 1)]
    extent = lines[-1] - lines[0]
    return float(extent / max(1, round(extent / np.median(np.diff(lines)))))


def grid_index(values: np.ndarray, size: float) -> tuple[np.ndarray, float, int]:
    index = np.round((values - values.min()) / size).astype(int)
    offset = float(np.mean(values - size * index))
    return index + 1, offset - size, index.max() + 3


def read_patch(path: str) -> Patch:
    """patch.csv of a run, or a file with the same columns."""
    names = ("pressure_MPa", "shear_x_MPa", "shear_y_MPa", "slip_x_m_per_s", "slip_y_m_per_s")
    return Patch(path, read_table(path, ("x_mm", "y_mm", "state") + names), names)


def read_patches(path: str) -> list[Instant]:
    """patches.csv of a run; instants without contact are left out. @raises DataError"""
    names = ("pressure_MPa", "shear_x_MPa", "shear_y_MPa", "slip_x_m_per_s", "slip_y_m_per_s")
    table = read_table(path, ("time_s", "position_mm", "x_mm", "y_mm", "state") + names)
    if not len(table["time_s"]):
        raise DataError(f"{path}: no instant with contact")
    table["x_mm"] = table["x_mm"] + table["position_mm"]
    _, first = np.unique(table["time_s"], return_index=True)
    bounds = [*sorted(first), len(table["time_s"])]
    return [Instant(table["time_s"][begin], table["position_mm"][begin], Patch(path, {name: values[begin:end] for name, values in table.items()}, names))
            for begin, end in zip(bounds, bounds[1:])]


def read_contact(path: str) -> Patch:
    """A surface file of CONTACT: elements that are not listed carry no traction."""
    names = ("pn_MPa", "px_MPa", "py_MPa", "sx_m_s", "sy_m_s")
    return Patch(path, read_table(path, ("x_mm", "y_mm", "pn_MPa", "px_MPa", "sx_m_s", "state")), names)
