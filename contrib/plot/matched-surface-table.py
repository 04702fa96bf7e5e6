#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fill the tables of doc/rolling-error.md with what a matched surface changes: shipped scenes with and without it, beside the half-space solver
with the same load and motion.

With --run, what has no results yet is run first. --scenes chooses by name; scenes without results are named and keep the row that they have.
"""

from __future__ import annotations

import fnmatch
import os

from tread.commands import command_parser, run_command
from tread.files import is_complete, read_summary
from tread.measured_runs import MATCHED_SURFACE, run_scene
from tread.runs import ROOT
from tread.tables import fill, markdown, number, rows_of

# Name, scene, settings.
SCENES: tuple[tuple[str, str, dict], ...] = (
    ("blocks, 1.3 mm", "verification/half-space-1.3-mu0.30.prm", {}),
    ("blocks, 0.63 mm", "verification/half-space-0.63-mu0.30.prm", {}),
    ("blocks, 0.63 mm, friction 0.15", "verification/half-space-0.63-mu0.15.prm", {}),
    ("rail head (thesis 3.1), 1.3 mm", "thesis/3.1-1.3-mu0.30.prm", {}),
    ("rail head (thesis 3.1), 0.63 mm", "thesis/3.1-0.63-mu0.30.prm", {}),
    ("unlike materials (rail of 70 GPa), 1.3 mm", "smooth-rolling.prm",
     {"Mesh/Finest cell (mm)": 1.3, "Rail/Young's modulus (GPa)": 70, "Mesh/Fine half width (mm)": 11}),
    ("driving, 1.3 mm", "smooth-rolling.prm", {"Mesh/Finest cell (mm)": 1.3, "Motion/Traction coefficient": 0.3}),
    ("braking, 1.3 mm", "smooth-rolling.prm", {"Mesh/Finest cell (mm)": 1.3, "Motion/Traction coefficient": -0.3}),
    ("creepages and spin, 1.3 mm", "verification/creepage-spin-0.63.prm", {"Mesh/Finest cell (mm)": 1.3}),
    ("creepages and spin, 0.63 mm", "verification/creepage-spin-0.63.prm", {}),
    ("locomotive, 0.63 mm", "verification/locomotive-0.63.prm", {}),
    ("flange root", "curves/flange-root.prm", {}),
    ("conformal", "curves/conformal.prm", {}),
    ("two patches", "curves/two-patches.prm", {}),
    ("both wheels, held 2 mm beside the middle, 1.2 mm", "curves/klingel.prm",
     {"Mesh/Finest cell (mm)": 1.2, "Mesh/Fine half width (mm)": 0, "Guidance/Kind": "rigid", "Guidance/Lateral force (kN)": "balance", "Guidance/Yaw moment (kN m)": "balance",
      "Wheelset/Lateral shift (mm)": 2, "Motion/Rolled distance (mm)": 20}))

# Of the table of energies: heading, key of summary.json.
ENERGIES = (("energy residual [% of the dissipated]", "energy_residual_of_dissipated"),
            ("contact loss [% of the dissipated]", "contact_loss_of_dissipated"),
            ("hourglass over internal energy [%]", "hourglass_of_internal_energy"),
            ("slip chatter [% of the largest slip]", "slip_chatter_share"))


def folder(results: str, name: str, kind: str) -> str:
    return os.path.join(results, "matched-" + "".join(c if c.isalnum() or c == "." else "-" for c in name) + "-" + kind)


def mean_wheel(summary: dict) -> dict:
    """The summary; where both wheels are modelled, with the mean of their patches. Their longitudinal forces are opposite, so that half of the
    difference counts: it does not depend on the creepage of free rolling."""
    own, other = ([patch for patch in summary.get("patches", []) if patch.get("wheel") == wheel] for wheel in ("own", "other"))
    if not other:
        return summary
    mean = lambda key, sign=1: (own[0][key] + sign * other[0][key]) / 2
    return {**summary, "longitudinal_force_N": mean("longitudinal_force_N", -1),
            **{key: mean(key) for key in ("normal_force_N", "lateral_force_N", "max_pressure_Pa")}}


def over_normal(summary: dict, key: str) -> float:
    return summary[key] / summary["normal_force_N"]


def share(value: float | None, wanted: float | None, least: float = 0.) -> float | None:
    """Difference in %; None where what is wanted is not known, or too small."""
    return None if value is None or wanted is None or abs(wanted) <= least else 100 * (value / wanted - 1)


def differences(own: dict, half_space: dict) -> list[float | None]:
    """From the half-space with the same motion: longitudinal, lateral force over the normal force, largest pressure, frictional power in %,
    adhesion share in points. None: not comparable."""
    return [share(over_normal(own, "longitudinal_force_N"), over_normal(half_space, "longitudinal_force_N"), 3e-3),
            share(over_normal(own, "lateral_force_N"), over_normal(half_space, "lateral_force_N"), 3e-3),
            share(own["max_pressure_Pa"], half_space["max_pressure_Pa"]),
            share(own.get("frictional_power_W"), half_space.get("frictional_power_W")),
            100 * (own["adhesion_share"] - half_space["adhesion_share"])
            if "adhesion_share" in own and "adhesion_share" in half_space else None]


def arrow(before: float | None, after: float | None, sign: str) -> str:
    return "" if after is None or before is None else f"{before:{sign}.2f} → {after:{sign}.2f}"


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results"))
    parser.add_argument("--run", action="store_true", help="run what has no results yet")
    parser.add_argument("--scenes", metavar="PATTERN", default="*", help="names in the table, such as 'blocks*'")
    arguments = parser.parse_args()
    forces, energies = [], []
    for name, scene, settings in SCENES:
        folders = {kind: folder(arguments.results, name, kind) for kind in (*MATCHED_SURFACE, "half-space")}
        if arguments.run and fnmatch.fnmatch(name, arguments.scenes):
            for kind, changes in MATCHED_SURFACE.items():
                run_scene(scene, folders[kind], {**settings, **changes, "Output/Write volume": "false"})
            run_scene(scene, folders["half-space"], settings, ranks=1, command="reference")
        if not all(is_complete(of_run) for of_run in folders.values()):
            print(f"note: no results of '{name}'")
            kept = {table: [row for row in rows_of("rolling-error.md", table) if row[0] == name] for table in ("matched", "energies")}
            forces += kept["matched"]
            energies += kept["energies"]
            continue
        without, matched, half_space = (read_summary(folders[kind]) for kind in (*MATCHED_SURFACE, "half-space"))
        forces.append([name] + [arrow(before, after, "+") for before, after in zip(*(differences(mean_wheel(run), mean_wheel(half_space)) for run in (without, matched)))])
        energies.append([name] + [arrow(100 * without[key], 100 * matched[key], "") for _, key in ENERGIES]
                        + [f"{number(1e9 * without['time_step_s'])} → {number(1e9 * matched['time_step_s'])}"])
    fill("rolling-error.md", "matched", markdown(["scene", "Fx/Fn [%]", "Fy/Fn [%]", "largest pressure [%]",
                                                  "frictional power [%]", "adhesion share [points]"], forces))
    fill("rolling-error.md", "energies", markdown(["scene"] + [heading for heading, _ in ENERGIES] + ["time step [ns]"], energies))


if __name__ == "__main__":
    run_command(main)
