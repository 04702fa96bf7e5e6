#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The notebooks of doc/notebooks: all their code runs, cell by cell, in an empty folder, and leaves the figures it should.

    notebooks.py PROGRAM [NOTEBOOK ...]
"""

import json
import os
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")

import tread
from tread import runs
from tread_runner import Check

program, chosen = os.path.abspath(sys.argv[1]), sys.argv[2:]
check = Check()
NOTEBOOKS = os.path.join(runs.ROOT, "doc/notebooks")


def cells(name):
    with open(os.path.join(NOTEBOOKS, name), encoding="utf-8") as stream:
        book = json.load(stream)
    check.that(f"{name}: format 4.5, nothing stored", (book["nbformat"], book["nbformat_minor"]) == (4, 5) and
               not any(cell.get("outputs") or cell.get("execution_count") for cell in book["cells"]))
    check.that(f"{name}: cells have names of their own", len({cell["id"] for cell in book["cells"]}) == len(book["cells"]))
    return ["".join(cell["source"]) for cell in book["cells"] if cell["cell_type"] == "code"]


def first_hour(names):
    summary, table = names["summary"], names["table"]
    rows = table.to_dict("records") if hasattr(table, "to_dict") else table
    check.relative("first hour: wheel load, kN", 1e-3 * summary["normal_force_N"], 140.3, 0.01)
    check.relative("first hour: traction coefficient", summary["traction_coefficient"], 0.3, 0.02)
    check.that("first hour: pictures", len(os.listdir("results/first/pictures")) > 2)
    check.that("first hour: more friction, more adhesion", len(rows) == 2 and rows[1]["adhesion_share"] > rows[0]["adhesion_share"] + 0.05)
    check.that("first hour: both runs are compared", {"max_pressure_Pa", "adhesion_share"} <= {row["name"] for row in names["rows"]})


def measured(names):
    check.relative("measured: first contact, mm", 1e3 * names["half"].summary["first_contact_y_m"], 2.32, 0.05)
    static, force = names["twin"].history["normal_force_N"][0], names["run"].history["normal_force_N"]
    check.that("measured: the squat adds a third to a half of the load", 1.3 < force.max() / static < 1.6)
    check.that("measured: a spectrum", len(names["spectrum"]["frequency_Hz"]) > 10)


FIGURES = {"first-hour.ipynb": first_hour, "measured.ipynb": measured}
shipped = sorted(name for name in os.listdir(NOTEBOOKS) if name.endswith(".ipynb"))
check.that("each notebook has its figures here", shipped == sorted(FIGURES))
# The notebooks name no program: they take the one that is built or installed.
for function in (tread.run, tread.study):
    function.__kwdefaults__["program"] = program
runs.dynamic_force.__defaults__ = (program,)
for name in chosen or shipped:
    names = {"__name__": "__main__"}
    code = cells(name)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for number, text in enumerate(code, 1):
            try:
                exec(compile(text, f"{name}, code {number}", "exec"), names)
            except Exception as error:
                check.that(f"{name}: code {number}: {type(error).__name__}: {error}", False)
                break
        else:
            FIGURES[name](names)
        os.chdir(os.path.dirname(program))
check.exit()
