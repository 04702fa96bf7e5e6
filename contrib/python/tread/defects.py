# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the defect of a run lies on the rail."""

import glob
import os

from .runs import ROOT


def profile_length(name):
    """Length of a profile's file in mm, looked for here and beside the shipped scenes; None if it is not found."""
    places = [name, *glob.glob(os.path.join(ROOT, "prm", "*", name))]
    for path in places:
        if os.path.isfile(path):
            with open(path, encoding="utf-8") as stream:
                x = [float(line.split()[0]) for line in stream if line.strip() and not line.startswith("#")]
            return max(x) - min(x)
    return None


def extent_of_defect(parameters):
    """(leading edge, trailing edge) in mm by a run's parameters; the second is None if its profile is not at hand. None without
    a defect."""
    if parameters.get("Defect/Shape", "none") == "none":
        return None
    begin, length = float(parameters["Defect/Position (mm)"]), float(parameters.get("Defect/Length (mm)", 0))
    if length <= 0:
        length = profile_length(parameters.get("Defect/Profile file", ""))
    return begin, None if length is None else begin + length
