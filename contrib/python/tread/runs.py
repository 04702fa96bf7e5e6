# SPDX-License-Identifier: LGPL-2.1-or-later
"""Start the program, and read what a run leaves in its folder.

    import tread

    run = tread.run("prm/smooth-rolling.prm", {"Mesh/Finest cell (mm)": 1.3}, ranks=2, output="results/coarse")
    run.summary["normal_force_N"], run.history["position_m"], run.patch.pressure
    run.frame()                                           # history.csv as a data frame
    [(instant.position_mm, instant.patch.pressure.max()) for instant in run.patches]
    run.pictures()
    tread.run("prm/smooth-rolling.prm", command="reference")       # what the program can do with a scene besides rolling it

numpy is imported where columns are read: without it programs can be started, and commands say in one line that it is missing.
"""

from __future__ import annotations

import atexit
import functools
import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .files import Error, frame_or_rows, parameters_in, read_parameters, read_summary, read_table

if TYPE_CHECKING:
    import numpy as np
    import pandas

    from .patches import Instant, Patch

# This file is contrib/python/tread/runs.py, to which folders of commands have links; in an installed package its place says nothing.
ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.realpath(__file__)), *3 * [os.pardir]))
PROGRAM = os.path.join(ROOT, "build/source/tread")
if not os.path.isdir(os.path.join(ROOT, "prm")):
    PROGRAM = shutil.which("tread") or "tread"
    if os.path.isabs(PROGRAM):  # What is installed with it has the layout of the source tree.
        ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.realpath(PROGRAM)), os.pardir, "share", "tread"))


class ProgramError(Error):
    """The program ended with an exit code that is not 0: 1 for wrong input, 2 for a failure, 130 when interrupted. The message
    is the line the program itself says why in."""

    def __init__(self, message: str, exit_code: int):
        super().__init__(message)
        self.exit_code = exit_code


def own_line(text: str) -> str | None:
    """The last line in which the program says what went wrong, without its name; None if there is none."""
    said = [line.strip() for line in text.splitlines() if line.startswith("tread: ")]
    return said[-1][len("tread: "):] if said else None


def environment(**more: str) -> dict[str, str]:
    """The variables of this process with those that runs need, as contrib/environment.sh sets and explains them, and more."""
    settings = {"DEAL_II_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
                "OMPI_MCA_pml": "ob1"}
    if os.getuid() == 0:
        settings.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return {**os.environ, **settings, **more}


# A program on one rank needs no daemon of Open MPI beside it, which takes 0.1 s; without one all programs that start at the same time would
# share one folder of their session, which the first that ends removes under the others, so that one start in some hundred failed.
ALONE = ["env", "OMPI_MCA_ess_singleton_isolated=1", "OMPI_MCA_orte_create_session_dirs=0"]


@functools.lru_cache(maxsize=None)
def sessions() -> str:
    """The folder for the sessions of all mpirun that this process starts, which goes with it."""
    folder = tempfile.mkdtemp(prefix="tread-mpirun-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def command(arguments: Iterable[str], ranks: int = 1, program: str = PROGRAM) -> list[str]:
    """The program on so many ranks; one rank needs no mpirun. Where there are more ranks than processors, those that wait yield: it is some
    forty times as fast. Each mpirun has a folder of its own for its session: in the one that they share otherwise, one start in some hundred
    fails, when another makes or removes that folder at the same time (Open MPI 4.1)."""
    launch = ALONE
    if ranks > 1:
        launch = ["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none",
                  "--mca", "orte_tmpdir_base", tempfile.mkdtemp(dir=sessions())]
    if ranks > (os.cpu_count() or 1):
        launch += ["--mca", "mpi_yield_when_idle", "1"]
    return [*launch, program, *arguments]


def scene_path(scene: str | os.PathLike) -> str:
    """A path from the current folder, or else from prm/ of the source tree or of the installed program."""
    scene = os.fspath(scene)
    shipped = os.path.join(ROOT, "prm", scene)
    return shipped if not os.path.exists(scene) and os.path.exists(shipped) else scene


def text_of(value: object) -> str:
    """A value as parameter files have it."""
    return str(value).lower() if isinstance(value, bool) else str(value)


# What the program does with a scene, as `tread --help` lists it, and what it adds to the name of the folder where the scene names one.
COMMANDS = {"run": "", "reference": "-reference", "modes": "-modes", "contact-points": "-contact-points", "wear": "-wear"}


def must_be_command(command: str, table: object) -> None:
    """@raises Error for what is no command for scenes, or one whose table is missing or too many"""
    if command not in COMMANDS:
        raise Error(f"'{command}' is no command for a scene; there are {', '.join(COMMANDS)}")
    if (table is not None) != (command == "wear"):
        raise Error("the command 'wear' needs table=, a table of contacts" if table is None else f"the command '{command}' takes no table")


def arguments_of(scene: str | os.PathLike, settings: Mapping[str, object] | Sequence[str] = (), output: str | None = None, command: str = "run",
                 table: str | os.PathLike | None = None) -> list[str]:
    """What follows the program's name. @param scene a path from the current folder, or from prm/ of the source tree
    @param settings {"Section/Name": value}, or a list of "Section/Name=value", of which the last of each name counts: the program takes
    each name once @param command one of COMMANDS @param table of contacts, a path like the scene's, for 'wear'
    @raises Error as must_be_command()"""
    must_be_command(command, table)
    if hasattr(settings, "items"):
        settings = [f"{name}={text_of(value)}" for name, value in settings.items()]
    arguments = ([command] if command != "run" else []) + [scene_path(path) for path in (scene, table) if path is not None]
    for setting in {setting.partition("=")[0].strip(): setting for setting in settings}.values():
        arguments += ["-s", setting]
    return arguments + (["--output", output] if output else [])


def execute(arguments: Iterable[str], ranks: int = 1, program: str = PROGRAM, **options: Any) -> subprocess.CompletedProcess:
    """The ended process (subprocess.CompletedProcess), whatever its exit code, with what it wrote as text."""
    options = {"env": environment(), "capture_output": True, "text": True, **options}
    return subprocess.run(command(arguments, ranks, program), **options)


def processes_below(launcher: int) -> list[int]:
    """Numbers of the processes that a process has started: the ranks of mpirun."""
    return [int(number) for number in subprocess.run(["pgrep", "-P", str(launcher)], capture_output=True, text=True, check=False).stdout.split()]


def must_end_well(result: subprocess.CompletedProcess) -> subprocess.CompletedProcess:
    """@raises ProgramError unless the exit code of an ended process is 0"""
    if result.returncode:
        last = result.stderr.strip().splitlines()[-1:] or ["it said nothing"]
        what = "interrupted" if result.returncode == 130 else f"ended with exit code {result.returncode}: {last[0]}"
        raise ProgramError(own_line(result.stderr) or what, result.returncode)
    return result


def execute_stoppable(arguments: Iterable[str], ranks: int = 1, program: str = PROGRAM, show: bool = False) -> None:
    """The program to its end. Ctrl-C ends it with a checkpoint. @raises ProgramError if the exit code is not 0"""
    line = command(arguments, ranks, program)
    # A session of its own: Ctrl-C comes once, from here, and not from the terminal as well.
    with subprocess.Popen(line, env=environment(), stdout=None if show else subprocess.DEVNULL, stderr=subprocess.PIPE,
                          text=True, start_new_session=True) as process:
        try:
            errors = process.communicate()[1]
        except KeyboardInterrupt:
            process.send_signal(signal.SIGINT)
            process.communicate()
            raise
    must_end_well(subprocess.CompletedProcess(line, process.returncode, stderr=errors))


def run(scene: str | os.PathLike, settings: Mapping[str, object] | None = None, *, command: str = "run", table: str | os.PathLike | None = None,
        ranks: int = 1, output: str | os.PathLike | None = None, options: Sequence[str] = (), program: str = PROGRAM, show: bool = False) -> Run:
    """Roll a scene to its end, or do with it what another command of the program does.

    scene     path of a parameter file, from the current folder or from prm/ of the source tree
    settings  {"Section/Name": value}, in the units that the names state, such as {"Mesh/Finest cell (mm)": 1.3}
    command   of the program: "run", "reference", "modes", "contact-points" or "wear"
    table     of contacts, which "wear" reads: a path like that of the scene
    ranks     MPI processes
    output    folder of the results; by default that of the scene, 'Output/Directory', seen from the current folder, and the command behind
              its name unless that is "run"
    options   more of the program's, such as ["--resume"], or ["--shift-to", "5"] of "contact-points"
    show      let the terminal have what the program prints

    Returns the Run. Raises ProgramError if the exit code is not 0. Ctrl-C ends the program with a checkpoint, from which
    options=["--resume"] goes on.
    """
    if shutil.which(program) is None:
        raise Error(f"{program}: no such program; build it or name it with program=")
    must_be_command(command, table)
    if output is None:
        behind = COMMANDS[command] or next((COMMANDS[name] for name, flag in (("reference", "--reference-only"), ("wear", "--wear")) if flag in options), "")
        output = parameters_of(scene, settings or {}, program)["Output/Directory"] + behind
    execute_stoppable([*arguments_of(scene, settings or {}, os.fspath(output), command, table), *options], ranks, program, show)
    return Run(output)


def version_of(program: str = PROGRAM) -> str | None:
    """As summary.json has it; None of a program that does not tell."""
    asked = execute(["--version"], program=program)
    name, _, version = asked.stdout.strip().partition(" ")
    return version if asked.returncode == 0 and name == "tread" else None


def dynamic_force(folder: str, twin: str, program: str = PROGRAM) -> None:
    """Write dynamic.csv, spectrum.csv and dynamic.json: what a defect adds to the forces of the run in a folder, beside its
    smooth twin in another."""
    must_end_well(execute(["dynamic-force", folder, "--smooth-twin", twin], program=program))


class Run:
    """What a run left in its folder. Files are read when they are asked for, once. @raises DataError"""

    def __init__(self, folder: str | os.PathLike):
        self.folder = os.fspath(folder)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.folder!r})"

    def path(self, name: str) -> str:
        return os.path.join(self.folder, name)

    def has(self, name: str) -> bool:
        return os.path.exists(self.path(name))

    def table(self, name: str, required: Sequence[str] = (), text: Sequence[str] = ("state",)) -> dict[str, np.ndarray]:
        """{column: (rows,) array} of a CSV file in the folder; names of columns state their units."""
        return read_table(self.path(name), required, text)

    def frame(self, name: str = "history.csv") -> pandas.DataFrame | list[dict]:
        """A table of the folder as a pandas DataFrame with the columns of table(), or where pandas is not installed as a list of
        dicts, one for each row."""
        table = self.table(name)
        return frame_or_rows([dict(zip(table, row)) for row in zip(*(column.tolist() for column in table.values()))], list(table))

    @functools.cached_property
    def summary(self) -> dict:
        """The figures of summary.json: SI, units in their names."""
        return read_summary(self.folder)

    @functools.cached_property
    def history(self) -> dict[str, np.ndarray]:
        """{column: (rows,) array} of history.csv: SI, such as time_s, position_m, normal_force_N; a row is the mean over the
        interval that ends with it."""
        return self.table("history.csv")

    @functools.cached_property
    def patch(self) -> Patch:
        """The contact patch at the end, a patches.Patch: x, y (mm), pressure, shear_x, shear_y (MPa), slip_x, slip_y (m/s),
        area (mm2), adhesion (bool), each a (nodes in contact,) array. x counts from the wheel."""
        from .patches import read_patch  # which needs numpy

        return read_patch(self.path("patch.csv"))

    @functools.cached_property
    def patches(self) -> list[Instant]:
        """The contact patch on the way, of a scene with 'Output/Patch interval (mm)': for each instant of patches.csv (time_s,
        position_mm of the wheel, patch), x of the patch along the rail."""
        from .patches import read_patches

        return read_patches(self.path("patches.csv"))

    @functools.cached_property
    def parameters(self) -> dict[str, str]:
        """{"Section/Name": text} of parameters.prm; empty if there is none."""
        return read_parameters(self.path("parameters.prm"))

    def pictures(self, folder: str | os.PathLike | None = None, contact: str | None = None) -> list[str]:
        """Draw all pictures for which the run has the data. @returns their paths @raises Error without matplotlib

        folder   of the pictures; by default pictures/ in the run's folder
        contact  surface file of CONTACT to draw beside the patch
        """
        from .pictures import all_figures, save_all

        return save_all(all_figures(self, contact), os.fspath(folder) if folder else self.path("pictures"))


def parameters_of(scene: str | os.PathLike, settings: Mapping[str, object] | Sequence[str] = (), program: str = PROGRAM) -> dict[str, str]:
    """{"Section/Name": text} of all parameters of a scene, as the program understands it."""
    asked = must_end_well(execute(["parameters", *arguments_of(scene, settings)], program=program))
    return parameters_in(asked.stdout.splitlines())
