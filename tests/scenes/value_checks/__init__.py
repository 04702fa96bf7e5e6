# SPDX-License-Identifier: LGPL-2.1-or-later
"""Comparisons of all values that runs write, and the search for those without one."""
