#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""List the values that a run writes and that no test compares: tests/scenes/unchecked.py, with the program of the build.

  contrib/unchecked.py                       make the small runs, compare, list
  contrib/unchecked.py --all                 also those that need no comparison, with the reason, and how small a change of each is noticed
"""

import os
import sys

from tread.runs import PROGRAM, ROOT

script = os.path.join(ROOT, "tests/scenes/unchecked.py")
os.execv(sys.executable, [sys.executable, script, PROGRAM, *sys.argv[1:]])
