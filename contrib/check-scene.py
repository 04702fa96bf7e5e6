#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Check parameter files without the program, for editors: FILE:LINE: what is wrong, such as an unknown parameter or a value out of range.

Files that a scene includes are checked too. What only the program can tell, such as a mesh that does not fit, it says with --dry-run.
The exit code is 1 if anything is wrong.
"""

from tread.commands import command_parser, run_command
from tread.schema import scene_errors


def main():
    parser = command_parser(__doc__)
    parser.add_argument("scenes", metavar="SCENE.prm", nargs="+")
    wrong = False
    for scene in parser.parse_args().scenes:
        for file, line, what in scene_errors(scene):
            print(f"{file}:{line}: {what}")
            wrong = True
    return 1 if wrong else 0


if __name__ == "__main__":
    run_command(main)
