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
ELEMENTS, FINEST = (8, 12, 16), 48  # along a semi-axis; 16 where none are given


def solve(n_elements, order, contacts):
    """The first so many contacts."""
    cases, (a, b) = random_cases(CONTACTS)
    cases, a, b = {name: np.broadcast_to(value, CONTACTS)[:contacts] for name, value in cases.items()}, a[:contacts], b[:contacts]
    return half_space.solve(**cases, element_x=a / n_elements, element_y=b / n_elements, slip_order=order, on_failure="nan")


def main():
    command_parser(__doc__).parse_args()
    finest = solve(FINEST, 2, COMPARED)
    unsolved = {FINEST: np.count_nonzero(finest["status"])}
    size = np.hypot(finest["longitudinal_force"], finest["lateral_force"])
    rows = []
    for order in (1, 2):
        for n_elements in ELEMENTS:
            start = time.perf_counter()
            answers = solve(n_elements, order, CONTACTS)
            seconds = time.perf_counter() - start
            unsolved[n_elements] = unsolved.get(n_elements, 0) + np.count_nonzero(answers["status"])
            change = np.hypot(*[answers[name][:COMPARED] - finest[name] for name in ("longitudinal_force", "lateral_force")])
            work = np.abs(answers["frictional_work"][:COMPARED] / finest["frictional_work"] - 1.)
            rows.append([str(n_elements), str(order), number(seconds), number(100 * np.nanmedian(change) / FRICTION / FORCE),
                         number(100 * np.nanquantile(change, 0.99) / FRICTION / FORCE), number(100 * np.nanmax(change) / FRICTION / FORCE),
                         number(100 * np.nanquantile(change / size, 0.99)), number(100 * np.nanmax(work))])
    cases, forces = table_cases()
    own = beside_table(half_space.solve(slip_order=1, contact_sixth=True, **cases), cases, forces)
    fill("half-space-library.md", "half-space-library", markdown(
        ["elements along a semi-axis", "order of the slip", f"seconds for {CONTACTS}", "force, median error [% of friction times load]", "of 99 in 100 less than", "largest",
         "of 99 in 100 less than [% of the force]", "frictional work, largest error [%]"], rows)
        + f"\n\n{os.cpu_count()} threads. {machine()}; `benchmarks/half-space-library.py`. The {len(cases['spin'])} rows of CONTACT's creep-force table, on its own elements: "
        + ", ".join(f"{name.replace('_', ' ')} within {difference:.1e}" for name, difference in own.items()) + " of friction times load (and mean semi-axis). Not solved: "
        + ", ".join(f"{count} with {n_elements} elements" for n_elements, count in sorted(unsolved.items())) + ".")


if __name__ == "__main__":
    run_command(main)
