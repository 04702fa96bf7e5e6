#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Traction against rolled distance: a run that starts without tractions beside the half-space's transient answer.

    tread SCENE.prm --output RUN
    tread --reference-only SCENE.prm --output REFERENCE
    contrib/plot/compare-transient.py RUN REFERENCE [--within PERCENT] [--from MM]

Reads RUN/history.csv and REFERENCE/transient.csv and prints the traction coefficients side by side. With --within it
ends with exit code 1 if a difference beyond --from (2 mm) is larger, in per cent of the half-space's value.
"""

import argparse
import csv
import os
import sys


def read(path, *names):
    with open(path, encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    if len(rows) < 2:
        raise SystemExit(f"{path}: fewer than two rows")
    return [[float(row[name]) for row in rows] for name in names]


def interpolated(x, y, at):
    """Linear between rows; `at` within them."""
    k = next(i for i in range(1, len(x)) if x[i] >= at or i == len(x) - 1)
    return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1])


def compare(run, reference):
    """Rows of rolled distance in mm, traction coefficient of the run and of the half-space, difference in %."""
    time, position, traction = read(os.path.join(run, "history.csv"), "time_s", "position_m", "traction_coefficient")
    speed = (position[-1] - position[0]) / (time[-1] - time[0])
    # A row is the mean over the interval that ends with it: it belongs to the interval's middle.
    rolled = [1e3 * speed * 0.5 * (begin + end) for begin, end in zip([0.] + time[:-1], time)]
    distance, expected = read(os.path.join(reference, "transient.csv"), "rolled_mm", "traction_coefficient")
    rows = []
    for s, own in zip(rolled, traction):
        if distance[0] < s <= distance[-1]:
            there = interpolated(distance, expected, s)
            rows.append((s, own, there, 100. * (own / there - 1.)))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run")
    parser.add_argument("reference")
    parser.add_argument("--within", type=float, metavar="PERCENT")
    parser.add_argument("--from", type=float, default=2., dest="begin", metavar="MM")
    parser.add_argument("--every", type=float, default=1., metavar="MM", help="between printed rows (1)")
    arguments = parser.parse_args()
    rows = compare(arguments.run, arguments.reference)
    if not rows:
        raise SystemExit("no rolled distance that both have")
    print(f"{'rolled, mm':>10} {'run':>9} {'half-space':>10} {'diff.':>8}")
    last = -1e300
    for s, own, there, difference in rows:
        if s - last >= arguments.every - 1e-6:
            print(f"{s:10.3f} {own:9.5f} {there:10.5f} {difference:+7.2f}%")
            last = s
    beyond = [(abs(row[3]), row[0]) for row in rows if row[0] >= arguments.begin]
    if not beyond:
        raise SystemExit(f"the run does not reach {arguments.begin} mm")
    worst, where = max(beyond)
    print(f"largest difference from {arguments.begin:g} mm on: {worst:.2f} % at {where:.2f} mm")
    if arguments.within is not None and worst > arguments.within:
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
