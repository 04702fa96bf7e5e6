#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""CONTACT's examples beside tread's half-space solver, on the same elements: fills the tables of doc/contact-cases.md.

    contact-cases-table.py
"""

from tread.commands import command_parser, run_command
from tread.contact_examples import of_inputs, of_profiles
from tread.tables import fill, markdown


def table(rows):
    """Differences over what is given; in its own unit as well where that is nothing or they are large."""
    cells, before = [], None
    for _, case, quantity, given, computed in rows:
        difference = computed - given + 0.
        text = f"{100 * difference / given:+.3f} %" if given else ""
        if not given or abs(difference) > 0.01 * abs(given):
            text = f"{difference:+.3g}" + (f" ({text})" if text else "")
        cells.append(["" if case == before else case, quantity, f"{given + 0.:.6g}", f"{computed + 0.:.6g}", text])
        before = case
    return markdown(["case", "quantity", "CONTACT", "tread", "difference"], cells)


def main():
    command_parser(__doc__).parse_args()
    inputs = list(of_inputs())
    for folder in ("classic", "friction", "conformal"):
        fill("contact-cases.md", folder, table([row for row in inputs if row[0] == folder]))
    fill("contact-cases.md", "manchester", table(of_profiles()))


if __name__ == "__main__":
    run_command(main)
