#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A mesh of a bar or of a joint for 'Rail/Mesh file': contrib/rail-mesh.py --help."""

from tread.rail_mesh import command_line

if __name__ == "__main__":
    command_line()
