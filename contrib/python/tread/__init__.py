# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of tread from Python: tread.run() rolls a scene, tread.study() varies its parameters, tread.Run reads what a run left in its
folder, tread.compare() two of them."""

from .differences import compare
from .files import DataError, Error
from .runs import ProgramError, Run, run
from .studies import study

__all__ = ["DataError", "Error", "ProgramError", "Run", "compare", "run", "study"]
