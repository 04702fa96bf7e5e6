#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solve the cases of an input file of CONTACT by half-space theory: contrib/contact-inp.py --help."""

from tread.contact_inp import command_line

if __name__ == "__main__":
    command_line()
