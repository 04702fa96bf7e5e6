#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/parameters.md: every parameter with its default, its meaning and what it needs, as `tread parameters` says them.

With --check the page is only compared; the exit code is 1 if it is not current.
"""

from tread.commands import run_command
from tread.schema import allowed, listing, of_program, parameters
from tread.tables import page_command

HEAD = """# Parameters

A parameter file has sections with one parameter a line:

    subsection Wheel
      set Radius (mm) = 460
    end

On the command line the same is `-s "Wheel/Radius (mm)=460"`, which has the last word. A line `include NAME` reads another file first, relative to the
folder of the file it stands in; what the file itself sets overrides it. One file, and the command line, sets each parameter once. Files with measured profiles are looked for in the present folder and beside
the file that the program was given. What is not set has the default given here.
What has an effect only where another parameter has some value says what it needs; set elsewhere, it is named by a warning.

This page is written by `contrib/parameters-page.py`.
"""


def page(found, known):
    """@param found as of schema.listing(); @param known as of schema.parameters()"""
    text = HEAD
    for section, entries in found:
        text += f"\n## {section}\n\n| parameter | default | allowed | meaning |\n|---|---|---|---|\n"
        for entry in entries:
            name, default, meaning = (part.replace("|", "\\|") for part in entry)
            schema = known[f"{section}/{entry[0]}"]
            # What a choice may be is said by its meaning.
            may_be = "" if "enum" in schema or (schema.get("type") == "string" and "pattern" not in schema) else allowed(schema)
            text += f"| {name} | {f'`{default}`' if default else ''} | {may_be} | {meaning} |\n"
    return text


if __name__ == "__main__":
    run_command(lambda: page_command(__doc__, "parameters.md", lambda program: page(listing(program), parameters(of_program(program)))))
