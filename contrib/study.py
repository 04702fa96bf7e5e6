#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run a parameter variation of a scene and tabulate it: tread/studies.py."""

import sys

from tread.runs import DataError
from tread.studies import main

if __name__ == "__main__":
    try:
        sys.exit(main())
    except (DataError, OSError) as error:
        sys.exit(f"study.py: {error}")
