# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wheel that is struck on its way: what runs and their simple models are compared by. SI units, or one unit for all places."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np


def speed(history: Mapping[str, np.ndarray]) -> float:
    """Mean speed between the first and the last row of a run's history (m/s)."""
    way, time = history["position_m"], history["time_s"]
    return float((way[-1] - way[0]) / (time[-1] - time[0]))


def off_the_rail(places: np.ndarray, forces: np.ndarray) -> float:
    """The way over which nothing presses the wheel on the rail, each place being the end of a step."""
    return float(np.sum(np.diff(places, prepend=places[0])[forces <= 0.]))
