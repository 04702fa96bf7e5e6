# SPDX-License-Identifier: LGPL-2.1-or-later
"""Starts of the program on one rank that load its libraries once: 0.1 s of a processor instead of 0.5 s."""

import functools
import os
import select
import subprocess
import tempfile
import time

from tread.runs import ALONE, environment, execute


class LoadedOnce:
    """The program with its libraries in memory, of which each start is a copy (loaded_once.cc)."""

    def __init__(self, program, library):
        self.process = subprocess.Popen([*ALONE, f"LD_PRELOAD={library}", program], env=environment(), stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.folder = tempfile.TemporaryDirectory()

    def execute(self, arguments, timeout):
        files = [os.path.join(self.folder.name, name) for name in ("stdout", "stderr")]
        in_hexadecimal = lambda word: os.fsencode(word).hex()
        words = [*map(in_hexadecimal, files), str(len(arguments)), *map(in_hexadecimal, arguments)]
        self.process.stdin.write("".join(word + "\n" for word in words).encode())
        self.process.stdin.flush()
        if not select.select([self.process.stdout], [], [], timeout)[0]:
            self.process.kill()  # and with it the copy that hangs
            raise subprocess.TimeoutExpired(arguments, timeout)
        exit_code = int(self.process.stdout.readline())
        texts = []
        for file in files:
            with open(file, encoding="utf-8") as stream:
                texts.append(stream.read())
        return subprocess.CompletedProcess(arguments, exit_code, *texts)


@functools.lru_cache(maxsize=None)
def loaded_once(program):
    return LoadedOnce(program, os.environ["TREAD_LOADED_ONCE"])


def execute_often(arguments, program, timeout=None):
    """As execute() on one rank, but that the program is loaded once. TREAD_LOADED_ONCE is the library that does so; without it, as with the
    sanitizers, each is a start of its own. What each took is printed, for those who make tests cheaper."""
    began = time.monotonic()
    if "TREAD_LOADED_ONCE" in os.environ:
        ended = loaded_once(program).execute(list(arguments), timeout)
    else:
        ended = execute(arguments, program=program, timeout=timeout)
    print(f"{time.monotonic() - began:6.2f} s:", *arguments, flush=True)
    return ended


def execute_on(ranks, arguments, program, timeout=None):
    """As execute_often() on one rank, as execute() on several."""
    return execute(arguments, ranks, program, timeout=timeout) if ranks > 1 else execute_often(arguments, program, timeout)
