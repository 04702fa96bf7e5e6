#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Speed and error of the half-space library: random elliptic contacts with so many elements along a semi-axis.

    half-space-library.py
    half-space-library.py --twice
    half-space-library.py --memory

Fills the tables of doc/half-space-library.md: the time of ten thousand contacts on all cores, and how far the forces of a thousand are
from those on fine elements. --twice: how far those of ten thousand are from those with twice as many elements in both directions as where
none are given, for several numbers along and across, in some minutes. --memory: of the process after ten thousand contacts and after a
hundred thousand.
"""

import os
import time

import numpy as np

from tread import half_space
from tread.commands import command_parser, run_command
from tread.creep_table import FORCE, FRICTION, beside_table, random_cases, table_cases
from tread.tables import fill, machine, markdown, number

CONTACTS, COMPARED = 10000, 1000
DEFAULT = (28, 10)  # along a and b, where none are given
ELEMENTS, FINEST = ((8, 8), (12, 12), (16, 16), DEFAULT), (48, 48)
TWICE, SHAPES = (56, 20), ((16, 16), (20, 8), (24, 9), DEFAULT)
ALLOWED = 0.5  # %


def solve(n_elements, order, chosen):
    """The contacts of a slice, with so many elements along both semi-axes."""
    cases, (a, b) = random_cases(CONTACTS)
    cases, a, b = {name: np.broadcast_to(value, CONTACTS)[chosen] for name, value in cases.items()}, a[chosen], b[chosen]
    return half_space.solve(**cases, element_x=a / n_elements[0], element_y=b / n_elements[1], slip_order=order, on_failure="nan")


def by(shape):
    return f"{shape[0]} x {shape[1]}"


def force_change(answers, others):
    """(contacts,) difference of the forces, N"""
    return np.hypot(*[answers[name] - others[name] for name in ("longitudinal_force", "lateral_force")])


def twice():
    """The table of forces beside those with twice as many elements as where none are given."""
    finer = solve(TWICE, 2, slice(None))
    size = np.hypot(finer["longitudinal_force"], finer["lateral_force"])
    rows = []
    for shape in SHAPES:
        start = time.process_time()
        answers = solve(shape, 2, slice(None))
        rows.append([by(shape), f"{time.process_time() - start:.0f}"])
        change = force_change(answers, finer)
        for share in (100 * change / FRICTION / FORCE, 100 * change / size):
            rows[-1] += [str(np.count_nonzero(share <= ALLOWED)), number(np.nanquantile(share, 0.99)), number(np.nanmax(share))]
    fill("half-space-library.md", "half-space-library-twice", markdown(
        ["elements along the semi-axes, in rolling direction and across", f"processor seconds for {CONTACTS}", f"within {ALLOWED:g} % of friction times load",
         "99 in 100 less than, %", "largest, %", f"within {ALLOWED:g} % of the force", "99 in 100 less than, %", "largest, %"], rows)
        + f"\n\n{machine()}; `benchmarks/half-space-library.py --twice`.")


def memory():
    """Prints the memory of the process, MB, after so many contacts of few elements."""
    for n in range(1, 11):
        solve((4, 4), 2, slice(None))
        with open("/proc/self/status", encoding="ascii") as stream:
            resident = next(line.split()[1] for line in stream if line.startswith("VmRSS"))
        print(f"{n * CONTACTS} contacts: {int(resident) / 1024:.2f} MB", flush=True)


def main():
    parser = command_parser(__doc__)
    parser.add_argument("--twice", action="store_true", help="compare with twice as many elements")
    parser.add_argument("--memory", action="store_true", help="print the memory after 1e4 to 1e5 contacts")
    arguments = parser.parse_args()
    if arguments.twice or arguments.memory:
        (twice if arguments.twice else memory)()
        return
    finest = solve(FINEST, 2, slice(COMPARED))
    unsolved = {FINEST: np.count_nonzero(finest["status"])}
    size = np.hypot(finest["longitudinal_force"], finest["lateral_force"])
    rows = []
    for order in (1, 2):
        for n_elements in ELEMENTS:
            start = time.perf_counter()
            answers = solve(n_elements, order, slice(None))
            seconds = time.perf_counter() - start
            unsolved[n_elements] = unsolved.get(n_elements, 0) + np.count_nonzero(answers["status"])
            change = force_change({name: values[:COMPARED] for name, values in answers.items()}, finest)
            work = np.abs(answers["frictional_work"][:COMPARED] / finest["frictional_work"] - 1.)
            rows.append([by(n_elements), str(order), number(seconds), number(100 * np.nanmedian(change) / FRICTION / FORCE),
                         number(100 * np.nanquantile(change, 0.99) / FRICTION / FORCE), number(100 * np.nanmax(change) / FRICTION / FORCE),
                         number(100 * np.nanquantile(change / size, 0.99)), number(100 * np.nanmax(work))])
    cases, forces = table_cases()
    own = beside_table(half_space.solve(slip_order=1, contact_sixth=True, **cases), cases, forces)
    fill("half-space-library.md", "half-space-library", markdown(
        ["elements along the semi-axes", "order of the slip", f"seconds for {CONTACTS}", "force, median error [% of friction times load]", "of 99 in 100 less than", "largest",
         "of 99 in 100 less than [% of the force]", "frictional work, largest error [%]"], rows)
        + f"\n\n{os.cpu_count()} threads. {machine()}; `benchmarks/half-space-library.py`. The {len(cases['spin'])} rows of CONTACT's creep-force table, on its own elements: "
        + ", ".join(f"{name.replace('_', ' ')} within {difference:.1e}" for name, difference in own.items()) + " of friction times load (and mean semi-axis). Not solved: "
        + ", ".join(f"{count} with {by(n_elements)} elements" for n_elements, count in sorted(unsolved.items())) + ".")


if __name__ == "__main__":
    run_command(main)
