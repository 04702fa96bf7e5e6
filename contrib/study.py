#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run a parameter variation of a scene and tabulate it: contrib/study.py --help."""

from tread.studies import command_line

if __name__ == "__main__":
    command_line()
