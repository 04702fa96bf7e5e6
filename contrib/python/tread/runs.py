# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads what a run of tread leaves in its folder, and surface files of CONTACT."""

import csv
import gzip
import json
import os
import sys

try:
    import numpy as np
except ModuleNotFoundError:
    sys.exit(f"{os.path.basename(sys.argv[0])}: {sys.executable} has no numpy; /usr/bin/python3 has it "
             "(contrib/install-debian.sh)")


class DataError(Exception):
    """A file that is missing or cannot be understood; the message is one line for the user."""


def read_table(path, required=(), text=("state",)):
    """A CSV file (also .gz; lines that start with # are comments) as {column: numpy array}."""
    try:
        opener = gzip.open if path.endswith(".gz") else open
        with opener(path, "rt", encoding="utf-8", newline="") as stream:
            rows = list(csv.reader(line for line in stream if line.strip() and not line.startswith("#")))
    except (OSError, EOFError, UnicodeDecodeError) as error:
        raise DataError(f"{path}: {getattr(error, 'strerror', None) or error}") from None
    if not rows:
        raise DataError(f"{path}: empty file")
    names = [name.strip() for name in rows[0]]
    for name in required:
        if name not in names:
            raise DataError(f"{path}: no column '{name}' (columns: {', '.join(names)})")
    for number, row in enumerate(rows[1:], 1):
        if len(row) != len(names):
            raise DataError(f"{path}: data row {number} has {len(row)} entries, expected {len(names)}")
    table = {}
    for i, name in enumerate(names):
        column = [row[i].strip() for row in rows[1:]]
        if name in text:
            table[name] = np.array(column, dtype=str)
            continue
        try:
            table[name] = np.array(column, dtype=float)
        except ValueError:
            if name in required:
                raise DataError(f"{path}: column '{name}' has an entry that is not a number") from None
    return table


def read_summary(run):
    path = os.path.join(run, "summary.json")
    try:
        with open(path, encoding="utf-8") as stream:
            summary = json.load(stream)
    except OSError as error:
        raise DataError(f"{path}: {error.strerror}") from None
    except ValueError as error:
        raise DataError(f"{path}: not valid JSON ({error})") from None
    if not isinstance(summary, dict):
        raise DataError(f"{path}: not a JSON object")
    return summary


def read_parameters(path):
    """{"Section/Name": value} of a parameter file, empty if there is none."""
    result, section = {}, []
    if not os.path.exists(path):
        return result
    with open(path, encoding="utf-8") as stream:
        for line in stream:
            line = line.split("#")[0].strip()
            if line.startswith("subsection "):
                section.append(line[len("subsection "):].strip())
            elif line == "end" and section:
                section.pop()
            elif line.startswith("set "):
                name, _, value = line[len("set "):].partition("=")
                result["/".join(section + [name.strip()])] = value.strip()
    return result


def reference_value(summary, key, source=""):
    """The number that the summary compares `key` with, or None; `source` picks one of several."""
    entries = summary.get("reference", {}).get(key)
    if isinstance(entries, dict) and "value" not in entries:
        entries = [dict(entry, source=entry.get("source", name)) for name, entry in entries.items()]
    elif not isinstance(entries, list):
        entries = [entries]
    entries = [entry for entry in entries if isinstance(entry, dict) and entry.get("value") is not None]
    for entry in entries:
        if source.lower() in str(entry.get("source", "")).lower():
            return float(entry["value"])
    return None


class Patch:
    """Tractions and slip of the nodes (or elements) of a contact patch. mm, MPa, m/s.

    Shear is that on the wheel, slip that of the wheel's surface relative to the rail's.
    """

    fields = ("pressure", "shear_x", "shear_y", "slip_x", "slip_y")

    def __init__(self, path, table, names):
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
    def shear(self):
        return np.hypot(self.shear_x, self.shear_y)

    @property
    def slip(self):
        return np.hypot(self.slip_x, self.slip_y)

    @property
    def adhesion_share(self):
        return self.area[self.adhesion].sum() / self.area.sum()

    def centroid(self):
        """Centre of pressure."""
        weight = self.pressure * self.area
        return (weight * self.x).sum() / weight.sum(), (weight * self.y).sum() / weight.sum()

    def friction_coefficient(self):
        """What the slipping nodes that carry load say; None without any."""
        loaded = ~self.adhesion & (self.pressure > 0.2 * self.pressure.max())
        return float(np.median(self.shear[loaded] / self.pressure[loaded])) if loaded.any() else None

    def grid(self, values):
        """(x lines, y lines, values[y, x]) on the grid of the nodes, with one empty line around."""
        columns, x0, n_x = grid_index(self.x, self.size_x)
        rows, y0, n_y = grid_index(self.y, self.size_y)
        result = np.full((n_y, n_x), np.nan)
        result[rows, columns] = values
        return x0 + self.size_x * np.arange(n_x), y0 + self.size_y * np.arange(n_y), result

    def sampled(self, values, x, y):
        """Bilinear interpolation between the nodes at the points (x, y); zero outside the patch."""
        gx, gy, grid = self.grid(values)
        grid = np.nan_to_num(grid)
        i = np.clip(((x - gx[0]) / self.size_x).astype(int), 0, len(gx) - 2)
        j = np.clip(((y - gy[0]) / self.size_y).astype(int), 0, len(gy) - 2)
        s, t = (x - gx[i]) / self.size_x, (y - gy[j]) / self.size_y
        value = ((1 - s) * (1 - t) * grid[j, i] + s * (1 - t) * grid[j, i + 1]
                 + (1 - s) * t * grid[j + 1, i] + s * t * grid[j + 1, i + 1])
        outside = (x < gx[0]) | (x > gx[-1]) | (y < gy[0]) | (y > gy[-1])
        return np.where(outside, 0.0, value)


def spacing(values):
    """The distance of the grid lines to which the coordinates belong."""
    points = np.unique(np.round(values, 6))
    gaps = np.diff(points)
    if not len(gaps):
        return 1.0
    # Nodes of one line differ a little: its place is their mean.
    lines = [line.mean() for line in np.split(points, np.nonzero(gaps > 0.3 * gaps.max())[0] + 1)]
    extent = lines[-1] - lines[0]
    return float(extent / max(1, round(extent / np.median(np.diff(lines)))))


def grid_index(values, size):
    index = np.round((values - values.min()) / size).astype(int)
    offset = float(np.mean(values - size * index))
    return index + 1, offset - size, index.max() + 3


def read_patch(path):
    """patch.csv of a run, or a file with the same columns."""
    names = ("pressure_MPa", "shear_x_MPa", "shear_y_MPa", "slip_x_m_per_s", "slip_y_m_per_s")
    return Patch(path, read_table(path, ("x_mm", "y_mm", "state") + names), names)


def read_contact(path):
    """A surface file of CONTACT: elements that are not listed carry no traction."""
    names = ("pn_MPa", "px_MPa", "py_MPa", "sx_m_s", "sy_m_s")
    return Patch(path, read_table(path, ("x_mm", "y_mm", "pn_MPa", "px_MPa", "sx_m_s", "state")), names)
