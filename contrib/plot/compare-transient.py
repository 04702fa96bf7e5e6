#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Traction against rolled distance: a run that starts without tractions beside the half-space's transient answer.

    tread SCENE.prm --output RUN
    tread reference SCENE.prm --output REFERENCE
    contrib/plot/compare-transient.py RUN REFERENCE [--within PERCENT] [--from MM]

Reads RUN/history.csv and REFERENCE/transient.csv and prints the traction coefficients side by side. With --within it
ends with exit code 1 if a difference beyond --from (2 mm) is larger, in per cent of the half-space's value.
"""

from __future__ import annotations

import os

import numpy as np

from tread.commands import command_parser, run_command
from tread.files import DataError
from tread.runs import Run


def columns(folder: str, table: str, *names: str) -> list[np.ndarray]:
    found = Run(folder).table(table, names)
    if len(found[names[0]]) < 2:
        raise DataError(f"{os.path.join(folder, table)}: fewer than two rows")
    return [found[name] for name in names]


def compare(run: str, reference: str) -> list[tuple[float, float, float, float]]:
    """Rows of rolled distance in mm, traction coefficient of the run and of the half-space, difference in %."""
    time, position, traction = columns(run, "history.csv", "time_s", "position_m", "traction_coefficient")
    speed = (position[-1] - position[0]) / (time[-1] - time[0])
    # A row is the mean over the interval that ends with it: it belongs to the interval's middle.
    rolled = 1e3 * speed * 0.5 * (np.append(0.0, time[:-1]) + time)
    distance, expected = columns(reference, "transient.csv", "rolled_mm", "traction_coefficient")
    both = (rolled > distance[0]) & (rolled <= distance[-1])
    there = np.interp(rolled[both], distance, expected)
    return list(zip(rolled[both], traction[both], there, 100 * (traction[both] / there - 1)))


def main() -> int:
    parser = command_parser(__doc__)
    parser.add_argument("run")
    parser.add_argument("reference")
    parser.add_argument("--within", type=float, metavar="PERCENT")
    parser.add_argument("--from", type=float, default=2., dest="begin", metavar="MM")
    parser.add_argument("--every", type=float, default=1., metavar="MM", help="between printed rows (1)")
    arguments = parser.parse_args()
    rows = compare(arguments.run, arguments.reference)
    if not rows:
        raise DataError("no rolled distance that both have")
    print(f"{'rolled, mm':>10} {'run':>9} {'half-space':>10} {'diff.':>8}")
    last = -1e300
    for s, own, there, difference in rows:
        if s - last >= arguments.every - 1e-6:
            print(f"{s:10.3f} {own:9.5f} {there:10.5f} {difference:+7.2f}%")
            last = s
    beyond = [(abs(row[3]), row[0]) for row in rows if row[0] >= arguments.begin]
    if not beyond:
        raise DataError(f"the run does not reach {arguments.begin} mm")
    worst, where = max(beyond)
    print(f"largest difference from {arguments.begin:g} mm on: {worst:.2f} % at {where:.2f} mm")
    return 1 if arguments.within is not None and worst > arguments.within else 0


if __name__ == "__main__":
    run_command(main)
