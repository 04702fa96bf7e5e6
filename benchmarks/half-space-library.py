#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Speed and error of the half-space library: random elliptic contacts with so many elements along a semi-axis.

    half-space-library.py

Fills the table of doc/half-space-library.md: the time of ten thousand contacts on all cores, and how far the forces of a thousand are
from those with twice as many elements as the finest row.
"""

import os
import time

import numpy as np

from tread import half_space
from tread.commands import command_parser, run_command
from tread.creep_table import FORCE, FRICTION, beside_table, random_cases, table_cases
from tread.tables import fill, machine, markdown, number

CONTACTS, COMPARED = 10000, 1000
ELEMENTS = (8, 12, 16, 24, 32)  # along a semi-axis; 16 where none are given


def solve(n_elements, order, contacts):
    cases, (a, b) = random_cases(contacts)
    return half_space.solve(**cases, element_x=a / n_elements, element_y=b / n_elements, slip_order=order)


def main():
    command_parser(__doc__).parse_args()
    finest = solve(2 * ELEMENTS[-1], 2, COMPARED)
    size = np.hypot(finest["longitudinal_force"], finest["lateral_force"])
    rows = []
    for order in (1, 2):
        for n_elements in ELEMENTS:
            start = time.perf_counter()
            answers = solve(n_elements, order, CONTACTS)
            seconds = time.perf_counter() - start
            change = np.hypot(*[answers[name][:COMPARED] - finest[name] for name in ("longitudinal_force", "lateral_force")])
            work = np.abs(answers["frictional_work"][:COMPARED] / finest["frictional_work"] - 1.)
            rows.append([str(n_elements), str(order), number(seconds), number(100 * change.max() / FRICTION / FORCE),
                         number(100 * (change / size).max()), number(100 * np.median(change / size)), number(100 * work.max())])
    cases, forces = table_cases()
    own = beside_table(half_space.solve(slip_order=1, contact_sixth=True, **cases), cases, forces)
    fill("half-space-library.md", "half-space-library", markdown(
        ["elements along a semi-axis", "order of the slip", f"seconds for {CONTACTS}", "force, largest error [% of friction times load]",
         "largest error [% of the force]", "median", "frictional work, largest error [%]"], rows)
        + f"\n\n{os.cpu_count()} threads. {machine()}; `benchmarks/half-space-library.py`. The {len(cases['spin'])} rows of CONTACT's creep-force table, on its own elements: "
        + ", ".join(f"{name.replace('_', ' ')} within {difference:.1e}" for name, difference in own.items()) + " of friction times load (and mean semi-axis).")


if __name__ == "__main__":
    run_command(main)
