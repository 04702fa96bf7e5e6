# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the defects of a run lie on the rail."""

from __future__ import annotations

import glob
import os
import re
from collections.abc import Mapping

import h5py
import numpy as np

from .files import DataError
from .point_files import read_lines, read_points
from .runs import ROOT


def _length_of_table(path: str) -> float | None:
    """Extent of the first column, or of x_mm where the first line has names."""
    lines = [line for line in read_lines(path) if line.strip() and not line.startswith("#")]
    names = [name.strip().strip('"') for name in re.split("[;,\t]", lines[0])] if lines else []
    if "x_mm" not in names:
        try:
            return float(np.ptp(read_points(path)[:, 0]))
        except DataError:
            return None
    separator = next((sign for sign in ";\t" if sign in lines[0]), ",")
    try:
        x = [float(line.split(separator)[names.index("x_mm")].strip().strip('"').replace(",", ".")) for line in lines[1:]]
    except (ValueError, IndexError):
        return None
    return max(x) - min(x) if x else None


def profile_length(name: str) -> float | None:
    """Length of a profile's or a map's file in mm, looked for here and beside the shipped scenes; None if it is not found or not understood."""
    for path in [name, *glob.glob(os.path.join(ROOT, "prm", "*", name))]:
        if os.path.isfile(path) and path.endswith((".h5", ".hdf5")):
            with h5py.File(path) as stream:
                return float(np.ptp(stream["x_mm"][:]))
        if os.path.isfile(path):
            return _length_of_table(path)
    return None


def extent_of_defect(parameters: Mapping[str, str]) -> tuple[float, float | None] | None:
    """(leading edge, trailing edge) in mm by a run's parameters; the second is None if its profile is not at hand. None without
    a defect."""
    if parameters.get("Defect/Shape", "none") == "none":
        return None
    begin, length = float(parameters["Defect/Position (mm)"]), float(parameters.get("Defect/Length (mm)", 0))
    if length <= 0:
        length = profile_length(parameters.get("Defect/Profile file", ""))
    return begin, None if length is None else begin + length


def extents_of_defects(parameters: Mapping[str, str]) -> list[tuple[float, float | None]]:
    """Those of extent_of_defect(), of the defect and of its repetitions."""
    first = extent_of_defect(parameters)
    if first is None:
        return []
    begins = [first[0], *(float(word) for word in parameters.get("Defect/Repeated at (mm)", "").split(",") if word.strip())]
    return [(begin, None if first[1] is None else begin + first[1] - first[0]) for begin in begins]
