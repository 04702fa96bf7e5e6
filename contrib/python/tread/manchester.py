# SPDX-License-Identifier: LGPL-2.1-or-later
"""Case A-2.2 of the Manchester contact benchmark: its positions as settings of tread, with CONTACT's figures in tread's signs."""

from __future__ import annotations

import csv
import os
import tempfile
from collections.abc import Iterator, Mapping
from typing import Any

from .contact_rolled import SPEED_KM_H
from .contact_track import signs
from .runs import PROGRAM, ROOT, run

DATA = os.path.join(ROOT, "contrib", "contact-data", "manchester_a22.csv")


def positions() -> Iterator[tuple[str, float, dict[str, float], dict[str, float]]]:
    """Yields side, shift in the benchmark's sign (mm), settings, and CONTACT's figures by their names in tread's summary."""
    with open(DATA, encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            value = {name: float(text) for name, text in row.items() if name != "side"}
            # No negative zeros among the settings.
            own = 1. if row["side"] == "right" else -1.
            signed = lambda name: own * value[name] + 0.
            figures = {"normal_force_N": value["FN_N"], "longitudinal_force_N": value["FX_N"], "lateral_force_N": value["FS_N"],
                       "x_m": 1e-3 * value["x_cp_mm"], "y_m": 1e-3 * value["y_cp_mm"], "angle_rad": value["delta_rad"],
                       "max_pressure_Pa": 1e6 * value["p_max_MPa"], "lateral_creepage": value["ceta"], "creepage": value["cksi"],
                       "spin_per_m": 1e3 * value["cphi_rad_mm"]}
            yield row["side"], value["y_ws_mm"], {
                "Wheelset/Lateral shift (mm)": signed("y_ws_mm"), "Wheelset/Yaw (mrad)": 1e3 * signed("yaw_rad"),
                "Wheelset/Roll (mrad)": 1e3 * signed("roll_rad"), "Motion/Angular velocity (rad per s)": -value["omega_rad_s"]}, {
                name: signs(row["side"]).get(name, 1.) * figure for name, figure in figures.items()}


# Finite elements roll 20 times as fast: the answer is that of steady rolling, whatever the speed.
BENCHMARK_KM_H = 7.2


def roll(settings: Mapping[str, Any], cell_mm: float, output: str | None = None, ranks: int = 2, program: str = PROGRAM) -> dict:
    """The summary of a position with finite elements of a size under the patch."""
    settings = {**settings, "Motion/Speed (km per h)": SPEED_KM_H, "Mesh/Finest cell (mm)": cell_mm, "Output/Write volume": False,
                "Motion/Angular velocity (rad per s)": settings["Motion/Angular velocity (rad per s)"] * SPEED_KM_H / BENCHMARK_KM_H}
    for name in ("Lateral shift (mm)", "Yaw (mrad)", "Roll (mrad)"):
        settings.setdefault(f"Wheelset/{name}", 0.)
    with tempfile.TemporaryDirectory() as folder:
        return run("curves/flange-root.prm", settings, output=output or os.path.join(folder, "run"), ranks=ranks, program=program).summary


def solve(side: str, settings: Mapping[str, object], program: str = PROGRAM) -> dict:
    """The summary of a position."""
    with tempfile.TemporaryDirectory() as folder:
        return run(f"curves/manchester-a22-{side}.prm", settings, output=os.path.join(folder, "run"),
                   command="reference", program=program).summary
