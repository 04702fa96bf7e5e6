# SPDX-License-Identifier: LGPL-2.1-or-later
"""What commands have in common. Import it first: it says in one line that a Python without numpy will not do."""

from __future__ import annotations

import argparse
import importlib.util
import os
import sys
from collections.abc import Callable
from types import TracebackType

from .files import Error

NAME = os.path.basename(sys.argv[0])

if importlib.util.find_spec("numpy") is None:
    sys.exit(f"{NAME}: {sys.executable} has no numpy; /usr/bin/python3 has it (contrib/install-debian.sh)")


def one_line(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    """What goes wrong before run_command(), such as at the import of pictures without matplotlib."""
    if issubclass(kind, Error):
        print(f"{NAME}: {error}", file=sys.stderr)
    else:
        sys.__excepthook__(kind, error, trace)


sys.excepthook = one_line


def command_parser(description: str) -> argparse.ArgumentParser:
    return argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)


def run_command(main: Callable[[], int | None]) -> None:
    """End with the exit code that main() returns, none being 0, or with what went wrong on one line."""
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        print(f"{NAME}: interrupted", file=sys.stderr)
        sys.exit(130)
    except Error as error:
        sys.exit(f"{NAME}: {error}")
    except OSError as error:
        sys.exit(f"{NAME}: {error.filename}: {error.strerror}" if error.filename else f"{NAME}: {error}")
