#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""CONTACT's examples beside tread's half-space solver, on the same elements: fills the tables of doc/contact-cases.md.

    contact-cases-table.py [--finite-elements [--ranks N]]

With --finite-elements the tables of rolled examples, which takes two minutes.
"""

from __future__ import annotations

from collections.abc import Iterable

from tread.commands import command_parser, run_command
from tread.contact_examples import of_finite_elements, of_inputs, of_profiles, of_rolled_profiles
from tread.tables import fill, markdown


def table(rows: Iterable[tuple[str, str, str, float, float]], names: tuple[str, str] = ("CONTACT", "tread")) -> str:
    """Of (folder, case, quantity, given, computed): differences over what is given; in its own unit as well where that is nothing or they are
    large."""
    cells, before = [], None
    for _, case, quantity, given, computed in rows:
        difference = computed - given + 0.
        text = f"{100 * difference / given:+.3f} %" if given else ""
        if not given or abs(difference) > 0.01 * abs(given):
            text = f"{difference:+.3g}" + (f" ({text})" if text else "")
        cells.append(["" if case == before else case, quantity, f"{given + 0.:.6g}", f"{computed + 0.:.6g}", text])
        before = case
    return markdown(["case", "quantity", *names, "difference"], cells)


def profiles_table(rows: Iterable[tuple[str, float, float, dict, dict]]) -> str:
    """Of of_rolled_profiles(): differences of forces along the surface over friction times load, 3 kN."""
    cells = []
    for side, shift, cell, half_space, rolled in rows:
        pair = lambda key, digits: [f"{answer[key] + 0.:.{digits}f}" for answer in (half_space, rolled)]
        share = lambda key: f"{100 * (rolled[key] / half_space[key] - 1.):+.2f} %"
        force = lambda key: [*pair(key, 0), f"{(rolled[key] - half_space[key]) / 30.:+.2f} %"]
        cells.append([side, f"{shift:g}", f"{cell:g}", *pair("normal_force_N", 0), share("normal_force_N"), *force("longitudinal_force_N"),
                      *force("lateral_force_N"), *pair("max_pressure_MPa", 1), share("max_pressure_MPa")])
        print(*cells[-1], flush=True)
    of = lambda name: [f"{name}, half-space", "finite elements", "diff."]
    return markdown(["wheel", "y_ws, mm", "cell, mm", *of("FN, N"), *of("FX, N"), *of("FS, N"), *of("p_max, MPa")], cells)


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("--finite-elements", action="store_true", help="roll examples")
    parser.add_argument("--ranks", type=int, default=1, metavar="N", help="MPI processes of each (1)")
    arguments = parser.parse_args()
    if arguments.finite_elements:
        rows = [("", *row) for row in of_finite_elements(ranks=arguments.ranks)]
        fill("contact-cases.md", "rolled", table(rows, ("half-space", "finite elements")))
        fill("contact-cases.md", "manchester-rolled", profiles_table(of_rolled_profiles(ranks=arguments.ranks)))
        return
    inputs = list(of_inputs())
    for folder in ("classic", "friction", "conformal"):
        fill("contact-cases.md", folder, table([row for row in inputs if row[0] == folder]))
    fill("contact-cases.md", "manchester", table(of_profiles()))


if __name__ == "__main__":
    run_command(main)
