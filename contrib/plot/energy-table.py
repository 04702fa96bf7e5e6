#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What every shipped scene does with its energy, and whether it carries its load: the table 'energy' of doc/verification.md.

Reads RESULTS/<folder>-<name of the parameter file>/summary.json of the scenes of prm/. With --run, scenes without results
are run first, one after the other; --rolled shortens their paths but for scenes that look
for peaks of stress (results of other lengths are run anew), --scenes chooses.
Scenes without results are named, and keep the row that they have in the table.
"""

from __future__ import annotations

import fnmatch
import os

from tread.commands import command_parser, run_command
from tread.loads import static_load
from tread.measured_runs import available_ranks, run_scene, shipped_scenes
from tread.files import DataError, Error, read_summary
from tread.runs import ROOT, Run, parameters_of
from tread.schema import parameters
from tread.tables import fill, machine, markdown, number, rows_of

# Heading, key of summary.json, factor, and the parameter beyond which a run warns.
MEASURES = (("dissipated [J]", "dissipated_work_J", 1, None),
            ("residual [%]", "energy_residual_of_dissipated", 100, "Watchdogs/Energy residual"),
            ("contact loss [%]", "contact_loss_of_dissipated", 100, "Watchdogs/Contact loss"),
            ("damping over friction and plasticity [%]", "damping_of_friction_and_plasticity", 100, "Watchdogs/Numerical damping"),
            ("hourglass over internal energy [%]", "hourglass_of_internal_energy", 100, "Watchdogs/Hourglass energy"),
            ("slip chatter [%]", "slip_chatter_share", 100, "Watchdogs/Slip chatter"),
            ("contact unconverged [% of steps]", "contact_unconverged_share", 100, "Watchdogs/Unconverged steps"))


def settings_of(scene: str, rolled: float | None) -> dict[str, str]:
    settings = {"Output/Write volume": "false"}
    if rolled is None:
        return settings
    own = parameters_of(scene)
    # Peaks of stress are looked for where the whole path leads.
    if float(own["Motion/Rolled distance (mm)"]) > rolled and own["Peak stress/Region"] == "none":
        settings["Motion/Rolled distance (mm)"] = f"{rolled:g}"
        # The torque must set in on the way.
        if float(own["Motion/Hold distance (mm)"]) >= rolled:
            settings["Motion/Hold distance (mm)"] = f"{0.5 * rolled:g}"
    return settings


def commit_of(summary: dict) -> str:
    """What stands in brackets in the version of the program."""
    return summary["version"].partition("(")[2].rstrip(")")


def limits_of(folder: str) -> dict[str, float]:
    """{parameter of MEASURES: value} of a run; those that it does not have are the program's defaults."""
    own, known = Run(folder).parameters, parameters()
    return {name: float(own.get(name, known[name]["default"])) for *_, name in MEASURES if name}


def over_load(scene: str, summary: dict) -> str:
    """What the contacts carry more than the load, in %, where the axle settles under it."""
    if not any(assumption.startswith("the axle") for assumption in summary.get("assumptions", ())):
        return "-"
    own = parameters_of(scene)
    load = 1e3 * static_load(own) * (2 if own["Wheelset/Both wheels"] == "true" else 1)
    return f"{100 * (summary['normal_force_N'] / load - 1):+.2f}"


def cell(value: float | None, factor: float, limit: float | None) -> str:
    """Bold if it is beyond the limit."""
    if value is None:
        return "-"
    text = number(factor * value)
    return f"**{text}**" if limit is not None and abs(value) > limit else text


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results", "energy"))
    parser.add_argument("--run", action="store_true", help="run the scenes that have no such results yet")
    parser.add_argument("--rolled", metavar="MM", type=float, help="roll no farther than this")
    parser.add_argument("--scenes", metavar="PATTERN", default="*", help="of paths in prm/, such as 'thesis/3.1-*'")
    parser.add_argument("--ranks", metavar="N", type=int, default=available_ranks())
    parser.add_argument("--print", action="store_true", dest="only_print", help="print the table instead of filling it in")
    arguments = parser.parse_args()
    rows, missing = [], []
    for scene in fnmatch.filter(shipped_scenes(), arguments.scenes):
        folder = os.path.join(arguments.results, scene[:-len(".prm")].replace(os.sep, "-"))
        try:
            summary = run_scene(scene, folder, settings_of(scene, arguments.rolled), arguments.ranks) if arguments.run \
                else read_summary(folder)
        except Error as error:
            print(f"note: {error}")
            missing.append(scene)
            continue
        limits = limits_of(folder)
        rows.append([scene[:-len(".prm")], number(1e3 * summary["rolled_m"])]
                    + [cell(summary.get(key), factor, limits.get(name)) for _, key, factor, name in MEASURES]
                    + [over_load(scene, summary), str(len(summary["warnings"])), commit_of(summary)])
    if not rows:
        raise DataError(f"no results in {arguments.results}")
    if missing:
        print("without results:", ", ".join(missing))
    measured = {row[0] for row in rows}
    headings = ["scene", "rolled [mm]"] + [heading for heading, *_ in MEASURES] + ["vertical force over the load [%]", "warnings", "commit"]
    rows += [row for row in rows_of("verification.md", "energy") if row[0] not in measured]
    table = markdown(headings, sorted(rows))
    table += (f"\n\nBold: above the threshold of a warning, which a run gives where the energy counts beside what the cells store. {machine()}; `contrib/plot/energy-table.py --run"
              + (f" --rolled {arguments.rolled:g}" if arguments.rolled else "") + "`, each row with the commit it was made with.")
    if arguments.only_print:
        print(table)
    else:
        fill("verification.md", "energy", table)


if __name__ == "__main__":
    run_command(main)
