#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What it costs to record what rolling does to the surfaces: a smooth passage without, with `Damage/Record`, and with friction that depends
on the temperature too, in turn; the fastest of the turns counts.

Fills the table of doc/damage.md. Runs that have complete results are not repeated; remove RESULTS to measure anew.
"""

import os

from tread.commands import command_parser, run_command
from tread.measured_runs import available_ranks, in_turn, run_scene, steps_seconds
from tread.runs import ROOT
from tread.tables import fill, markdown, number, provenance

SCENES = {"rail head, 1.3 mm": "thesis/3.1-1.3-mu0.30.prm", "rail head, 0.63 mm": "thesis/3.1-0.63-mu0.30.prm"}
KINDS = {"nothing": {},
         "work, slip, wear and flash temperature": {"Damage/Record": "true"},
         "the same, friction by temperature": {"Damage/Record": "true", "Contact/Friction temperatures (C)": "20,320", "Contact/Friction temperature factors": "1,0.9"}}


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/damage-cost"))
    parser.add_argument("--turns", metavar="N", type=int, default=6)
    arguments = parser.parse_args()
    rows, summaries = [], []
    for name, scene in SCENES.items():
        best = in_turn(arguments.turns, {
            kind: lambda turn, kind=kind, scene=scene: run_scene(
                scene, os.path.join(arguments.results, f"{os.path.basename(scene)[:-len('.prm')]}-{list(KINDS).index(kind)}-{turn}"),
                {"Output/Write volume": "false", **KINDS[kind]})
            for kind in KINDS}, steps_seconds)
        plain = best["nothing"]
        for kind, summary in best.items():
            summaries.append(summary)
            rows.append([name, kind, number(steps_seconds(summary)), f"{steps_seconds(summary) / steps_seconds(plain):.3f}",
                         number(summary["seconds"]), f"{summary['seconds'] / plain['seconds']:.3f}"])
    fill("damage.md", "damage-cost", markdown(["scene", "recorded", "seconds of the steps", "over nothing", "seconds in all", "over nothing"], rows)
         + f"\n\n{available_ranks()} ranks, fastest of {arguments.turns} in turn. {provenance('benchmarks/damage-cost.py', summaries)}")


if __name__ == "__main__":
    run_command(main)
