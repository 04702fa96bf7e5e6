#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points of a profile from the arcs of its drawing: contrib/profile-from-arcs.py --help."""

from tread.arcs import command_line

if __name__ == "__main__":
    command_line()
