# SPDX-License-Identifier: LGPL-2.1-or-later
"""What commands have in common."""

import os
import subprocess
import sys

from .runs import DataError


def run_command(main):
    """main(), with what goes wrong on one line."""
    try:
        main()
    except (DataError, OSError) as error:
        sys.exit(f"{os.path.basename(sys.argv[0])}: {error}")
    except subprocess.CalledProcessError as error:
        sys.exit(f"{os.path.basename(sys.argv[0])}: {' '.join(map(str, error.cmd))} ended with {error.returncode}")
