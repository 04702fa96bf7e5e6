#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""contrib/python/tread/parameters.schema.json: a JSON schema of all parameters of a scene, for editors and check-scene.py.

The program writes it (tread parameters --schema). With --check the file is only compared; the exit code is 1 if it is not current.
"""

import json
import sys

from tread.commands import command_parser, run_command
from tread.runs import PROGRAM
from tread.schema import PATH, of_program, parameters, shipped


def main():
    parser = command_parser(__doc__)
    parser.add_argument("--program", default=PROGRAM, help="the program to ask")
    parser.add_argument("--output", default=PATH, help="file to write instead")
    parser.add_argument("--check", action="store_true", help="write nothing")
    arguments = parser.parse_args()
    current = of_program(arguments.program)
    if not arguments.check:
        with open(arguments.output, "w", encoding="utf-8") as stream:
            json.dump(current, stream, indent=1, ensure_ascii=False)
            stream.write("\n")
        return 0
    old, new = parameters(shipped()), parameters(current)
    different = [name for name in {**old, **new} if old.get(name) != new.get(name)]
    if different:
        sys.exit(f"parameters.schema.json is not current, beginning with '{different[0]}': run contrib/schema.py")
    return 0


if __name__ == "__main__":
    run_command(main)
