#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every command of README.md, CONTRIBUTING.md and the pages of doc/ ends well in a clean clone.

    every_command.py PROGRAM [PAGE ...]          (such as README.md or doc/squats.md; without: all)
    every_command.py PROGRAM --list              what would be run, and what is left out: nothing is run

Each page is read in a folder of its own that holds what a clone of this tree would: files that git knows or would take, and nothing of a
build but the program. Every block of code of a page is one of these, or the test fails:

- commands: its first line begins with one of BEGINNINGS. Each is run as it stands, but for the placeholders of GIVEN, or is in LEFT_OUT, with the reason.
- Python: its first line begins with one of PYTHON. All blocks of a page are one script.
- what commands print, which page_commands.py compares for some pages, and other languages: OTHER.

What is run is made shorter by three rules, which do not change what a command is: each run by finite elements has coarser cells and a shorter way, as shortened()
says; commands of DRY pages, which list what is shipped, get --dry-run; and so do studies but those of WHOLE. A reason in LEFT_OUT, a placeholder or a block of OTHER that no page has any more is a failure too.
"""

import argparse
import collections
import glob
import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import time

from page_commands import blocks, commands_of
from tread.runs import ROOT, environment, execute, must_end_well, parameters_of
from tread_runner import Check

BEGINNINGS = ("(", ".", "PYTHONPATH=", "apt", "awk ", "build/", "cd ", "clang-format", "cmake ", "conda ", "contrib/", "export ", "grep ", "head ", "mpirun ", "/usr/", "podman ",
              "prm/", "python3 ", "source ", "spack ", "tread ")
PYTHON = ("import ", "from ", "answers = ", "patch = ", "run = ", "table = ", "with h5py", "x, y = ")

# Commands that are not run here: (words of them, reason).
BUILDS = "builds the program: the test doc.quickstart does it as the README says"
ROOT_OR_NETWORK = "installs packages: needs root and a network"
LEFT_OUT = (
    (r"contrib/quickstart\.sh", BUILDS),
    (r"contrib/test\.sh", "runs the tests, of which this is one"),
    (r"^cmake |^\(cd build-portable", BUILDS),
    (r"cd build && cpack -G DEB", "packs a build; the test doc.quickstart does it"),
    (r"cpack --config CPackSourceConfig", "packs a build; the test doc.quickstart does it"),
    (r"contrib/install-debian\.sh|^apt install", ROOT_OR_NETWORK),
    (r"contrib/package/check-deb\.sh|^podman |^spack |^conda ", "needs root, a network or a container, and hours"),
    (r"contrib/sanitize\.sh", "builds with sanitizers: continuous integration runs it"),
    (r"contrib/mutate\.py|contrib/draw-faults\.py .*--(python|try)", "builds and tests each fault: hours"),
    (r"contrib/unchecked\.py", "the test scene.unchecked"),
    (r"contrib/manual\.sh", "the test doc.manual"),
    (r"contrib/plot/verification-tables\.py --run", "fine meshes, whose figures are the point: an hour; the test scene.verification runs its coarse ones"),
    (r"contrib/plot/plot-plastic\.py", "draws stress 0.7 mm deep, which the coarse cells of this test do not have"),
    (r"contrib/corrugation\.py", "runs of minutes; the test scene.corrugation makes short ones"),
    (r"build/benchmarks/track_receptance_study", "a program of benchmarks/, which are not built for tests"),
    (r"contrib/plot/plot-receptance\.py", "draws what the program of benchmarks/ wrote"),
)

# Blocks that are no commands: page, first words, what they are.
OTHER = (
    ("README.md", "normal force", "printed: doc.quickstart compares"),
    ("README.md", "computed", "printed: doc.quickstart compares"),
    ("README.md", "dissipated", "printed: doc.quickstart compares"),
    ("doc/half-space-library.md", "#include", "C: the test install.half_space compiles it"),
    ("doc/half-space-library.md", "tread_half_space_case", "C: the test install.half_space compiles the like"),
    ("doc/half-space-library.md", "find_package", "CMake: the test install.half_space"),
    ("doc/own-mesh.md", "radius", "a file of Gmsh, which is not installed for tests"),
    ("doc/parameters.md", "subsection", "a piece of a parameter file"),
    ("doc/track.md", "support,", "the head of a table"),
)
DRY = ("doc/scenes.md",)  # the test scene.shipped runs scenes, scene.wheelset_rolling those in a position, scene.study a study
WHOLE = ("friction.study",)  # what a study is made of does not depend on which one it is; each of their scenes is on a page of DRY
COMPARED = ("doc/measured.md",)  # what commands print there is compared by doc.measured

CASES = """A_per_m,B_per_m,normal_force_N,friction,young_Pa,poisson,creepage,lateral_creepage,spin_per_m
1.087,1.667,127100,0.3,210e9,0.3,-0.001,0,0
1.087,1.667,127100,0.3,210e9,0.3,-0.001,0.0005,0.1
"""
STUDY = """set Scene    = prm/smooth-rolling.prm
set Figures  = normal_force_N
subsection Vary
  set Contact/Friction coefficient = 0.4 | 0.5
end
"""
# What a page takes for granted, by page: {word: what stands in its place}, files, and commands before it.
Given = collections.namedtuple("Given", "words files before python", defaults=({}, {}, (), ""))
SMOOTH = "build/source/tread prm/smooth-rolling.prm --output results/smooth-rolling"
DIP = "build/source/tread prm/tutorial/dip.prm -s 'Output/Patch interval (mm)=2' --output results/dip"
SQUAT = ("build/source/tread prm/thesis/4.3-M1.prm --output results/squat",
         "build/source/tread prm/thesis/4.3-M1.prm -s 'Defect/Shape=none' --output results/smooth")
GIVEN = {
    "README.md": Given({"CASES.csv": "cases.csv", "ANSWERS.csv": "answers.csv", "RUN": "results/squat", "TWIN": "results/smooth"}, {"cases.csv": CASES}, (SMOOTH, *SQUAT)),
    "CONTRIBUTING.md": Given({"FILE": "source/main.cc"}),
    "doc/critical-size.md": Given({"RUN RUN ...": "results/one results/two"}, {},
                                  tuple(f"build/source/tread prm/thesis/5.1-{which}.prm --output results/{name}" for which, name in (("6.7-smooth", "one"), ("10-sharp", "two")))),
    "doc/crossing.md": Given({"IN.csv": "in.csv", "OUT.csv": "out.csv"},
                             {"in.csv": "s_mm,y_ws_mm,load_N\n239,0,10000\n",
                              "positions.csv": "rail,wheel,s_mm,y_ws_mm,load_N,element_x_mm,element_y_mm\ncontrib/contact-data/crossing_uk56E1.csv,S1002,239,0,10000,0.4,0.4\n"}),
    "doc/editor.md": Given({}, {"my.prm": "subsection Mesh\n  set Finest cell (mm) = 2\nend\n"}),
    "doc/half-space-library.md": Given({"CASE.inp": "contrib/contact-data/thesis.inp", "FOLDER": "results/inp"}, {"cases.csv": CASES}, (),
                                       "import numpy as np\nx = y = np.linspace(-9e-3, 9e-3, 31)\ngap = 1.087 * x[None, :]**2 + 1.667 * y[:, None]**2\n"),
    "doc/modes.md": Given({"SCENE.prm": "prm/tutorial/track.prm --output results/modes", "FOLDER": "results/modes"}),
    "doc/dev/records/mutations.md": Given({"17 FILE": "17 source/geometry/rail_profile.cc"}),
    # What is installed has the folders of a clone.
    "doc/packages.md": Given({"/usr/share/tread/prm/smooth-rolling.prm": "prm/smooth-rolling.prm", "/usr/share/tread/contrib/plot/plot-run.py": "contrib/plot/plot-run.py",
                              "python3 -c": "PYTHONPATH=contrib/python /usr/bin/python3 -c"}),
    "doc/results.md": Given({}, {"my.study": STUDY}, (f"{SMOOTH} -s Output/Pictures=xdmf", DIP, DIP.replace("dip.prm", "dip.prm -s 'Defect/Shape=none'").replace("results/dip", "results/dip-smooth"), *SQUAT), "import h5py\n"),
    "doc/sleeper.md": Given({"RUN": "results/M1", "FOLDER": "results/M1-sleeper"}, {}, (SQUAT[0].replace("results/squat", "results/M1"),)),
    "doc/squats.md": Given({}, {}, tuple(f"build/source/tread prm/thesis/{scene}.prm -s 'Rail/Yield stress (MPa)=800' -s 'Output/Table depth (mm)=8' --output results/{study}/one"
                                         for scene, study in (("4.1-case1-sliding", "squat-yield"), ("4.1-case2", "squat-weld-yield")))),
    "doc/wheel-flat.md": Given({"IN.csv": "in.csv", "OUT.csv": "out.csv"},
                               {"in.csv": "pitch_deg,load_N\n-33,125000\n",
                                "positions.csv": "rail,wheel,wheel_deviation,s_mm,y_ws_mm,pitch_rad,load_N,rail_y_mm,element_x_mm,element_y_mm\nprm/flat/rail-of-arcs.csv,S1002,flat: length_mm=60 depth_mm=0.5,0,0,0.02,50000,757.44,1,1\n"}),
}

WRAPPER = """#!/usr/bin/python3
import os, sys
sys.path[:0] = [{folder!r}]
from every_command import shortened
program = {program!r}
os.execv(program, [program, *shortened(sys.argv[1:], program)])
"""


def shortened(arguments, program):
    """The arguments of the program: as they are unless they run a scene by finite elements. Then its cells are at least 2.2 mm (0.34 where a
    wheelset is in a position: a patch at the corner of a rail is 1.5 mm wide), evenly along the path and of two layers; it rolls at most 4 mm once, or where there is a defect and a start is given, from 15 mm
    before its leading edge to 30 mm behind it; a wheel that is not round begins on its flat, at -33 degrees; modes end at 300 Hz; profiles
    wear by 2000 passages."""
    scenes = [argument for before, argument in zip(["", *arguments], arguments) if argument.endswith(".prm") and before in ("", "--quiet", "--overwrite", "--resume") or
              argument.endswith(".prm") and not before.startswith("-")]
    if not scenes or "--dry-run" in arguments or arguments[0] in ("reference", "contact-points", "parameters"):
        return list(arguments)
    if arguments[0] == "wear":
        return [*arguments, "-s", "Profile wear/Passages=2000"]
    settings = [after for before, after in zip(arguments, arguments[1:]) if before == "-s"]
    # Ranks of mpirun ask a program that is none of them.
    for name in [name for name in os.environ if name.startswith(("OMPI_", "PMIX_", "PRTE_")) and "ALLOW" not in name and "MCA_btl" not in name]:
        saved = os.environ.pop(name)
        os.environ["SAVED_" + name] = saved
    own = parameters_of(scenes[0], settings, program)
    for name in [name for name in os.environ if name.startswith("SAVED_")]:
        os.environ[name[6:]] = os.environ.pop(name)
    positioned = own["Wheelset/Lateral shift (mm)"] != "none"
    changes = {"Mesh/Fine layers": "2", "Motion/Passages": "1", "Mesh/Fine from (mm)": "0", "Mesh/Fine to (mm)": "0", "Mesh/Path cell (mm)": "0",
               "Mesh/Finest cell (mm)": max(own["Mesh/Finest cell (mm)"], "0.34" if positioned else "2.2", key=float)}
    # The patch of a wheelset in a position, on steel that yields, grows beyond the width that is found for it.
    if not positioned:
        changes["Mesh/Fine half width (mm)"] = "0"
    # A smooth twin rolls where the run with the defect does.
    defect = own["Defect/Shape"] != "none" or float(own["Defect/Length (mm)"]) > 0 or any(re.match(r"Defect/Shape\s*=", setting) for setting in settings)
    if defect and own["Motion/Start (mm)"] != "automatic":
        changes.update({"Motion/Start (mm)": f"{float(own['Defect/Position (mm)']) - 15:g}", "Motion/Rolled distance (mm)": "45"})
    elif not defect:
        changes["Motion/Rolled distance (mm)"] = min(own["Motion/Rolled distance (mm)"], "4", key=float)
        if own["Motion/Drive"] == "torque":
            changes["Motion/Hold distance (mm)"] = min(own["Motion/Hold distance (mm)"], "1", key=float)
    if own["Wheel/Deviation"]:
        changes["Wheel/Deviation pitch (deg)"] = "-33"
    changes = {name: value for name, value in changes.items() if own.get(name, value) != value}
    added = [word for name, value in changes.items() for word in ("-s", f"{name}={value}")]
    # The program takes each name once.
    replaced = {i for i, word in enumerate(arguments[:-1]) if word == "-s" and arguments[i + 1].partition("=")[0].strip() in changes}
    arguments = [word for i, word in enumerate(arguments) if i not in replaced and i - 1 not in replaced]
    if arguments[0] != "modes":
        return [*arguments, *added]
    limit = arguments.index("--up-to") + 1 if "--up-to" in arguments else None
    return [*(["300" if limit == i else argument for i, argument in enumerate(arguments)]), *added, *([] if limit is not None else ["--up-to", "300"])]


def clone(folder, program=None):
    """What a clone would hold, and a program in build/ if one is given."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard"], capture_output=True, text=True)
    names = [name for name in listed.stdout.split("\0") if name] if listed.returncode == 0 else [
        os.path.relpath(os.path.join(where, name), ROOT) for where, _, names in os.walk(ROOT) for name in names
        if not re.match(r"(build|results|\.)", os.path.relpath(where, ROOT))]
    for name in names:
        source, target = os.path.join(ROOT, name), os.path.join(folder, name)
        if os.path.lexists(source):
            os.makedirs(os.path.dirname(target), exist_ok=True)
            shutil.copy2(source, target, follow_symlinks=False)
    if program is None:
        return
    os.makedirs(os.path.join(folder, "build", "source"))
    wrapper = os.path.join(folder, "build", "source", "tread")
    with open(wrapper, "w", encoding="utf-8") as stream:
        stream.write(WRAPPER.format(folder=os.path.dirname(os.path.abspath(__file__)), program=os.path.abspath(program)))
    os.chmod(wrapper, os.stat(wrapper).st_mode | stat.S_IXUSR)


def with_given(command, given):
    """A command without brackets of options, its placeholders filled."""
    command = re.sub(r"\[(?:-s|--)[^\]]*\](?:\.\.\.)?", "", command)
    for word, text in given.words.items():
        command = re.sub(rf"(?<![\w/.]){re.escape(word)}(?![\w/])", lambda _: text, command)
    return command


def dry(command, page):
    """A run on a page of DRY: its size and cost; a study: the list of its runs. Others, which draw, are themselves."""
    run = page in DRY and re.match(r"(?:mpirun -np 2 )?tread (?:(?:run|wear) )?\S+\.prm", command)
    study = "contrib/study.py " in command and "--dry-run" not in command and not any(name in command for name in WHOLE)
    return re.sub(r"(\s*#.*)?$", " --dry-run", command, count=1) if run or study else command


class Pages:
    def __init__(self, program, check, only_list=False):
        self.program, self.check, self.only_list = program, check, only_list
        self.used, self.counts, self.left_out = set(), collections.Counter(), []

    def execute(self, command, folder, what):
        if self.only_list:
            self.check.that(f"{what}"[:200], True)
            return
        start = time.time()
        path = os.pathsep.join((os.path.join(folder, "build", "source"), os.environ["PATH"]))
        ended = subprocess.run(["bash", "-c", command], cwd=folder, env=environment(PATH=path, PYTHONDONTWRITEBYTECODE="1"), capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if not self.check.that(f"{time.time() - start:6.1f} s  {what}"[:300], ended.returncode == 0):
            print(ended.stdout[-3000:], ended.stderr[-3000:], flush=True)

    def kind(self, page, block):
        first = block[0]
        for line in commands_of(block):
            if any(re.search(words, line) for words, _ in LEFT_OUT):
                return "commands"
        for at, words, _ in OTHER:
            if page == at and first.strip().startswith(words):
                self.used.add((at, words))
                return "other"
        if first.startswith(PYTHON):
            return "python"
        return "commands" if first.startswith(BEGINNINGS) else "other" if page in COMPARED else None

    def read(self, page):
        with open(os.path.join(ROOT, page), encoding="utf-8") as stream:
            found = [(self.kind(page, block), block) for block in blocks(stream.read())]
        given = GIVEN.get(page, Given())
        for block in [block for kind, block in found if kind is None]:
            self.check.that(f"{page}: '{block[0]}' is neither commands nor Python nor listed", False)
        if not any(kind in ("commands", "python") for kind, _ in found):
            return
        with tempfile.TemporaryDirectory() as folder:
            if not self.only_list:
                clone(folder, self.program)
            for name, text in given.files.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
                    stream.write(text)
            for command in given.before:
                self.execute(command, folder, f"(before {page}) {command}")
            for command in [line for kind, block in found if kind == "commands" for line in commands_of(block)]:
                reason = next(((words, reason) for words, reason in LEFT_OUT if re.search(words, command)), None)
                if reason:
                    self.used.add(reason[0])
                    self.left_out.append((page, command.split("  #")[0].strip(), reason[1]))
                    continue
                self.counts[page] += 1
                self.used |= {(page, word) for word in given.words if with_given(command, given) != command and word in command}
                command = with_given(command, given)
                self.execute(dry(command, page), folder, f"{page}: {command}")
            python = [line for kind, block in found if kind == "python" for line in block]
            if python:
                self.counts[page] += 1
                script = os.path.join(folder, "blocks.py")
                with open(script, "w", encoding="utf-8") as stream:
                    stream.write(given.python + "\n".join(python) + "\n")
                self.execute(f"PYTHONPATH={folder}/contrib/python MPLBACKEND=Agg /usr/bin/python3 {script}", folder, f"{page}: its {len(python)} lines of Python")

    def unused(self):
        """What is listed above and no page has any more."""
        for words, _ in LEFT_OUT:
            self.check.that(f"LEFT_OUT: a page has {words}", words in self.used)
        for page, words, _ in OTHER:
            self.check.that(f"OTHER: {page} has {words}", (page, words) in self.used)
        for page, given in GIVEN.items():
            for word in given.words:
                self.check.that(f"GIVEN: {page} has {word}", (page, word) in self.used)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("pages", nargs="*")
    parser.add_argument("--list", action="store_true")
    arguments = parser.parse_intermixed_args()
    check = Check()
    pages = Pages(arguments.program, check, arguments.list)
    every = ["README.md", "CONTRIBUTING.md", *sorted(os.path.relpath(page, ROOT) for page in glob.glob(os.path.join(ROOT, "doc", "**", "*.md"), recursive=True))]
    for page in arguments.pages or every:
        pages.read(page)
    if not arguments.pages:
        pages.unused()
    for page, command, reason in pages.left_out:
        print(f"left out: {page}: {command}: {reason}")
    print(f"{sum(pages.counts.values())} commands run, {len(pages.left_out)} left out:", ", ".join(f"{page} {count}" for page, count in pages.counts.items()))
    check.exit()


if __name__ == "__main__":
    main()
