# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of tread from Python."""
