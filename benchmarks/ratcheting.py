#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Many passages over a rail that yields: jumps over passages beside passages that are all rolled, and what shakes down.

Runs the ratcheting scene over 200 passages, all rolled and with jumps of several sizes, and over 10 000 with --long; then a dozen
passages of steels of other strengths with and without traction. Fills the tables of doc/ratcheting.md. Runs that have complete results
are not repeated; remove RESULTS to measure anew. Each run has one rank, and there are as many at a time as processors; that of --long has
all ranks to itself.
"""

import concurrent.futures
import math
import os

from tread.commands import command_parser, run_command
from tread.measured_runs import available_ranks, run_scene
from tread.runs import ROOT, Run
from tread.tables import fill, markdown, number, provenance

SCENE = "damage/ratcheting.prm"
PASSAGES = 200
JUMPS = {"all rolled": {"Ratcheting/Jumps": "false"},
         "as by default": {},
         "strain of a jump 1 %": {"Ratcheting/Strain of a jump (%)": 1},
         "4 rolled between": {"Ratcheting/Rolled between jumps": 4}}
LONG, STRONGER = 10000, 600  # passages over steel with a yield stress, MPa, that ratchets slowly; on all ranks
# Pressure of Hertz over the yield stress in shear, and the traction coefficient. Shakedown limits of a point contact: 4.7 without
# traction, and at the surface the inverse of the traction coefficient (Ponter, Hearle & Johnson 1985; Johnson 1989).
STRENGTHS, TRACTIONS, SHAKEDOWN = (3.5, 4.5, 6.), (0., 0.3), 12
HERTZ = 1393.2e6  # Pa, of the scene
LIMIT = {0.: 4.7, 0.3: 1 / 0.3}


def main():
    parser = command_parser(__doc__)
    parser.add_argument("results", metavar="RESULTS", nargs="?", default=os.path.join(ROOT, "results/ratcheting"))
    parser.add_argument("--long", action="store_true", help=f"{LONG} passages too")
    arguments = parser.parse_args()
    script = "benchmarks/ratcheting.py" + (" --long" if arguments.long else "")
    workers = concurrent.futures.ThreadPoolExecutor(available_ranks())

    def begin(name, settings, ranks=1):
        """What will be a run's summary and its passages."""
        folder = os.path.join(arguments.results, name.replace(" ", "-").replace("%", "percent"))
        return workers.submit(lambda: (run_scene(SCENE, folder, settings, ranks=ranks), Run(folder).table("passages.csv")))

    def note(runs):
        return f"\n\nOne rank each, {available_ranks()} runs at a time. " + provenance(script, [run.result()[0] for run in runs])

    jumps = {(name, PASSAGES): begin(f"{PASSAGES}-{name}", {"Motion/Passages": PASSAGES, **settings}) for name, settings in JUMPS.items()}
    steels = {(traction, strength, hardening): begin(f"{hardening} {strength} {traction}", {
        "Ratcheting/Jumps": "false", "Motion/Passages": SHAKEDOWN, "Motion/Traction coefficient": traction,
        "Rail/Hardening": hardening, "Rail/Yield stress (MPa)": f"{1e-6 * math.sqrt(3) * HERTZ / strength:.2f}"})
        for traction in TRACTIONS for strength in STRENGTHS for hardening in ("isotropic", "kinematic")}

    if arguments.long:
        concurrent.futures.wait([*jumps.values(), *steels.values()])
        name = f"yield stress {STRONGER} MPa, {available_ranks()} ranks"
        jumps[name, LONG] = begin(f"{LONG}-{name}", {"Motion/Passages": LONG, "Rail/Yield stress (MPa)": STRONGER}, available_ranks())

    rows, base = [], None
    for (name, n), run in jumps.items():
        summary, passages = run.result()
        base = base or (summary, passages)
        off = lambda value, of: "-" if n != PASSAGES or summary is base[0] else f"{100 * (value / of - 1):+.2f}"
        rows.append([name, number(n), number(summary["passages_rolled"]), f"{100 * summary['net_plastic_strain']:.3f}",
                     off(summary["net_plastic_strain"], base[0]["net_plastic_strain"]),
                     "-" if "jumps" not in summary else number(100 * summary["net_plastic_strain_error_estimate"] / summary["net_plastic_strain"]),
                     f"{100 * summary['net_plastic_strain_of_last_passage']:.4f}", f"{passages['shift_um'][-1]:.1f}",
                     off(passages["shift_um"][-1], base[1]["shift_um"][-1]), number(summary["seconds"])])
    fill("ratcheting.md", "ratcheting-jumps", markdown(
        ["", "passages", "rolled", "net plastic strain, %", "off, %", "own estimate, %", "of the last passage, %", "shift, um", "off, %", "seconds"], rows) + note(jumps.values()))

    rows = []
    for (traction, strength, hardening), run in steels.items():
        passages = run.result()[1]
        work = passages["plastic_work_J"]
        shakes_down = strength < LIMIT[traction] or hardening == "isotropic"
        rows.append([f"{strength:g}", f"{traction:g}", hardening, number(work[0]), number(work[1]), number(work[-1]),
                     f"{passages['net_plastic_strain_percent'][-1]:.4f}", f"{passages['net_plastic_strain_of_passage_percent'][-1]:.5f}", "yes" if shakes_down else "no"])
    fill("ratcheting.md", "ratcheting-shakedown", markdown(
        ["p0/k", "traction coefficient", "hardening", "plastic work of passage 1, J", "2", str(SHAKEDOWN), "net plastic strain, %", "of the last passage, %",
         "shakes down by the map"], rows) + note(steels.values()))


if __name__ == "__main__":
    run_command(main)
