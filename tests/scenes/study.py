#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameter variations: complete runs are not repeated, interrupted ones go on, one that fails leaves the others alone."""

import csv
import os
import subprocess
import sys
import tempfile

from tread.runs import ROOT, environment
from tread_runner import Check, press_ctrl_c, run, table

program = sys.argv[1]
check = Check()
SCENE = os.path.join(ROOT, "prm", "smooth-rolling.prm")
# The cells are as coarse as they may be: studies look at no figure as such.
SETTINGS = ["Mesh/Finest cell (mm)=2.6", "Mesh/Fine half width (mm)=0", "Motion/Rolled distance (mm)=6", "Output/Write volume=false"]


def line(study, *more):
    return [sys.executable, os.path.join(ROOT, "contrib", "study.py"), study, "--program", program, *more]


def perform(study, *more):
    return subprocess.run(line(study, *more), env=environment(), capture_output=True, text=True)


def write(path, vary, settings=SETTINGS, **entries):
    """A study; entries with spaces in their names have _ here."""
    with open(path, "w", encoding="utf-8") as stream:
        for name, value in {"Scene": SCENE, "Settings": " | ".join(settings), **entries}.items():
            stream.write(f"set {name.replace('_', ' ')} = {value}\n")
        stream.write("subsection Vary   # a comment\n")
        for name, values in vary.items():
            stream.write(f"  set {name} = {' | '.join(values)}\n")
        stream.write("end\n")
    return path


def study_table(folder):
    with open(os.path.join(folder, "study.csv"), encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def column(folder, name):
    return table(folder, "history.csv")[name]


def refused(name, study, words):
    result = perform(study)
    lines = result.stderr.splitlines()
    if not check.that(name, result.returncode == 1 and len(lines) == 1 and all(word in lines[0] for word in words)):
        print(result.returncode, result.stderr)


with tempfile.TemporaryDirectory() as folder:
    path = lambda *names: os.path.join(folder, *names)

    # Four runs, two of which cannot be.
    study = write(path("product.study"), {"Motion/Creepage": ["0.001", "0.9"], "Contact/Friction coefficient": ["0.4", "0.5"]},
                  Directory=path("product"), Figures="traction_coefficient | max(normal_force_N) | last(position_m) | max(strip.csv:von_mises_MPa) | "
                          "at(strip.csv:von_mises_MPa:x_mm)")
    result = perform(study, "--processes", "2")
    rows = study_table(path("product"))
    check.that("a run that fails: the exit code says so", result.returncode == 1)
    check.that("a product: every combination once", [(row["Motion/Creepage"], row["Contact/Friction coefficient"]) for row in rows]
               == [("0.001", "0.4"), ("0.001", "0.5"), ("0.9", "0.4"), ("0.9", "0.5")])
    check.that("a run that fails leaves the others alone", [row["state"] for row in rows[:2]] == ["complete"] * 2)
    check.that("a run that fails says why", all(row["state"].startswith("failed: 'Motion/Creepage'") for row in rows[2:]))
    check.that("a run that fails is said on the terminal", "failed: 'Motion/Creepage'" in result.stdout)
    alone = run(program, "smooth-rolling.prm", path("alone"), SETTINGS + ["Motion/Creepage=0.001", "Contact/Friction coefficient=0.4"])
    check.relative("a run of a study is the run alone", float(rows[0]["traction_coefficient"]), alone["traction_coefficient"], 1e-6)
    check.relative("largest value of a column", float(rows[0]["max(normal_force_N)"]), max(column(path("alone"), "normal_force_N")), 1e-6)
    check.relative("last value of a column", float(rows[0]["last(position_m)"]), column(path("alone"), "position_m")[-1], 1e-6)

    # The summary has the same two from the program itself, in Pa and m.
    check.relative("largest value of a column of another table", float(rows[0]["max(strip.csv:von_mises_MPa)"]),
                   1e-6 * alone["strip_max_von_mises_Pa"], 1e-6)
    check.relative("another column where one is largest", float(rows[0]["at(strip.csv:von_mises_MPa:x_mm)"]),
                   1e3 * alone["strip_max_von_mises_x_m"], 1e-6)

    # Once more, with one value more: what is there is kept.
    summary = path("product", "creepage-0.001_friction-coefficient-0.4", "summary.json")
    before = os.stat(summary).st_mtime_ns
    write(study, {"Motion/Creepage": ["0.001", "0.002"], "Contact/Friction coefficient": ["0.4", "0.5"]}, Directory=path("product"),
          Figures="traction_coefficient | wheel_2_creepage")  # which runs with two wheels have
    result = perform(study)
    check.that("a complete run is not repeated", os.stat(summary).st_mtime_ns == before and "creepage-0.001" not in
               result.stdout.split("Motion/Creepage")[0])
    check.that("a new value is run", [row["state"] for row in study_table(path("product"))] == ["complete"] * 4)
    check.that("a figure that is not there is named, with an exit code", result.returncode == 1 and "wheel_2_creepage" in result.stdout)
    write(study, {"Motion/Creepage": ["0.001"], "Contact/Friction coefficient": ["0.4"]}, SETTINGS + ["Motion/Speed (km per h)=70"],
          Directory=path("product"))
    result = perform(study)
    check.that("all complete: exit code 0", result.returncode == 0)
    check.that("other settings: the run is repeated", os.stat(summary).st_mtime_ns != before)

    # A zip, with a twin that both runs share.
    study = write(path("zip.study"), {"Defect/Depth (mm)": ["0.002", "0.004"], "Defect/Length (mm)": ["5", "6"]},
                  SETTINGS + ["Mesh/Finest cell (mm)=1.3", "Defect/Shape=dip", "Defect/Position (mm)=-4", "Scene/Density scale=1", "Solid/Mass damping (1 per s)=0"], Directory=path("zip"), Combination="zip",
                  Smooth_twin="Defect/Shape=none", Figures="dynamic(normal_force_N)")
    result = perform(study)
    rows = study_table(path("zip"))
    check.that("a zip with twins: exit code 0", result.returncode == 0)
    check.that("a zip: first with first", [(row["Defect/Depth (mm)"], row["Defect/Length (mm)"]) for row in rows]
               == [("0.002", "5"), ("0.004", "6")])
    check.that("one twin for both", [name for name in os.listdir(path("zip")) if name.startswith("smooth-twin")] == ["smooth-twin"])
    with_it, without = (column(path("zip", name), "normal_force_N")[:-1] for name in ("depth-0.004_length-6", "smooth-twin"))
    # Nearly the same steps: rows of both are within a step of each other.
    check.relative("peak of the difference to the twin", float(rows[1]["dynamic(normal_force_N)"]),
                   max((a - b for a, b in zip(with_it, without)), key=abs), 2.5e-3)

    # Interrupted and continued: small steps, so that there is time.
    slow = SETTINGS + ["Mesh/Finest cell (mm)=1.3", "Motion/Rolled distance (mm)=8", "Scene/Density scale=1"]
    study = write(path("slow.study"), {"Motion/Creepage": ["0.001", "0.002", "0.003"]}, slow, Directory=path("slow"),
                  Figures="traction_coefficient", Processes="2")
    history = path("slow", "creepage-0.002", "history.csv")
    process = subprocess.Popen(line(study), env=environment(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    press_ctrl_c(process, history, 12)
    process.communicate(timeout=300)
    check.that("interrupted: exit code 130", process.returncode == 130)
    rows = study_table(path("slow"))
    check.that("interrupted: the table says so", rows[1]["state"] == "interrupted" and rows[2]["state"] in ("not begun", "interrupted"))
    result = perform(study)
    check.that("continued: all complete, exit code 0", result.returncode == 0
               and all(row["state"] == "complete" for row in study_table(path("slow"))))
    check.that("continued: from the checkpoint", "creepage-0.002: goes on" in result.stdout)
    whole = run(program, "smooth-rolling.prm", path("whole"), slow + ["Motion/Creepage=0.002"])
    # The table has eight digits.
    check.relative("continued against never stopped", float(study_table(path("slow"))[1]["traction_coefficient"]),
                   whole["traction_coefficient"], 1e-7)

    vary = {"Motion/Creepage": ["0.001", "0.002"]}
    refused("no such study", path("none.study"), ["none.study"])
    refused("an unknown entry", write(path("bad.study"), vary, Speeds="40"), ["line 3", "Speeds", "Combination"])
    refused("no such scene", write(path("bad.study"), vary, Scene="none.prm"), ["none.prm", "scene"])
    refused("nothing to vary", write(path("bad.study"), {}), ["Vary", "no parameter"])
    refused("a parameter without values", write(path("bad.study"), {"Motion/Creepage": []}), ["Motion/Creepage", "no value"])
    refused("a parameter without its section", write(path("bad.study"), {"Creepage": ["0.001"]}), ["Creepage", "Section/Name"])
    refused("a setting without a value", write(path("bad.study"), vary, ["Motion/Creepage"]), ["Settings", "Section/Name=value"])
    refused("an unknown combination", write(path("bad.study"), vary, Combination="sum"), ["sum", "product, zip"])
    refused("a zip of unlike lengths", write(path("bad.study"), dict(vary, **{"Motion/Speed (km per h)": ["40"]}), Combination="zip"),
            ["zip", "2 of 'Motion/Creepage'", "1 of"])
    for value in ("0.001", "1e-3"):
        refused(f"the same value twice, as 0.001 and {value}", write(path("bad.study"), {"Motion/Creepage": ["0.001", value]}),
                ["same values", f"Motion/Creepage={value}"])
    refused("values whose folders have one name", write(path("bad.study"), {"Scene/Title": ["a b", "a-b"]}), ["same name of a folder", "Scene/Title=a b"])
    refused("a misspelt parameter", write(path("bad.study"), {"Motion/Crepage": ["0.001", "0.002"]}, Directory=path("bad")),
            ["'Vary': no parameter 'Motion/Crepage'", "did you mean 'Motion/Creepage'?"])
    refused("a misspelt setting", write(path("bad.study"), vary, ["Contact/Finest cell (mm)=1.3"], Directory=path("bad")), ["'Settings'", "did you mean 'Mesh/Finest cell (mm)'?"])
    refused("a misspelt figure", write(path("bad.study"), vary, Figures="normal_force_N | max_presure_Pa", Directory=path("bad")),
            ["'Figures': summary.json has no 'max_presure_Pa'", "did you mean 'max_pressure_Pa'?"])
    refused("a misspelt column", write(path("bad.study"), vary, Figures="max(strip.csv:von_mises_Mpa_)", Directory=path("bad")),
            ["'Figures': strip.csv has no 'von_mises_Mpa_'", "did you mean 'von_mises_MPa'?"])
    check.that("nothing has begun where a study is refused", not os.path.exists(path("bad")))
    refused("an empty value", write(path("bad.study"), {"Motion/Creepage": ["0.001", "", "0.003"]}), ["Motion/Creepage", "empty"])
    refused("folders of runs", write(path("bad.study"), {"Output/Directory": ["a", "b"]}), ["Output/Directory", "folder of its own"])
    refused("no number of processes", write(path("bad.study"), vary, Processes="many"), ["Processes", "many"])
    refused("an unknown kind of figure", write(path("bad.study"), vary, Figures="mean(normal_force_N)"), ["mean", "max, min"])
    refused("a place without its column", write(path("bad.study"), vary, Figures="at(strip.csv:x_mm)"), ["at(TABLE.csv:COLUMN:OTHER"])
    refused("a dynamic force without a twin", write(path("bad.study"), vary, Figures="dynamic(normal_force_N)"), ["Smooth twin"])
    refused("a limit that cannot be", write(path("bad.study"), vary, Limit="normal_force_N = nan over Motion/Creepage"), ["Limit", "nan", "above 0"])
    refused("a limit of another figure", write(path("bad.study"), vary, Limit="force = 1 over Motion/Creepage"), ["Limit", "'force'", "Figures"])
    # Without its site packages a Python has no numpy.
    bare = subprocess.run([sys.executable, "-S"] + line(path("bad.study"))[1:], env=environment(), capture_output=True, text=True)
    check.that("a Python without numpy: one line", bare.returncode == 1 and bare.stderr.count("\n") == 1
               and all(word in bare.stderr for word in ("study.py", "numpy", "install-debian.sh")))

check.exit()
