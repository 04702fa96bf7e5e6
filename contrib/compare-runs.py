#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compare two runs: contrib/compare-runs.py --help."""

from tread.differences import command_line

if __name__ == "__main__":
    command_line()
