#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Check parameter files without the program: contrib/check-scene.py --help."""

from tread.schema import command_line

if __name__ == "__main__":
    command_line()
