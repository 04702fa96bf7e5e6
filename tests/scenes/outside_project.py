#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Another project, in C, that uses the installed half-space library.

    outside_project.py BUILD
"""

import os
import re
import subprocess
import sys
import tempfile

from tread.runs import ROOT
from tread_runner import Check

check = Check()
with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as stream:
    VERSION = re.search(r"project\(tread VERSION (\d+\.\d+)", stream.read())[1]
PROJECT = f"""cmake_minimum_required(VERSION 3.18)
project(outside C)
find_package(tread {VERSION} REQUIRED)
add_executable(outside outside.c)
target_link_libraries(outside PRIVATE tread::half_space)
"""
# Shared between threads only by the operating system: a solver each.
PROGRAM = """#include <stdio.h>
#include <tread/half_space.h>
int main(void)
{
  tread_half_space_case problem = {.curvature_x = 1., .curvature_y = 1., .normal_force = 1e5, .friction = 0.3, .young = 210e9, .poisson = 0.25, .creepage = -1e-5};
  tread_half_space_answer answer;
  tread_half_space *solver = tread_half_space_create();
  int status = tread_half_space_version() == TREAD_HALF_SPACE_VERSION ? tread_half_space_solve(solver, &problem, &answer) : 9;
  double a, g = 84e9;
  tread_half_space_grid grid;
  tread_half_space_get_grid(solver, &grid);
  a = grid.element_x * 16.;
  printf("%d %.6f [%s]\\n", status, answer.longitudinal_force / (g * a * a * 1e-5), tread_half_space_message(solver));
  problem.friction = -1.;
  status = tread_half_space_solve(solver, &problem, &answer);
  printf("%d %d [%s]\\n", status, answer.longitudinal_force != answer.longitudinal_force, tread_half_space_message(solver));
  tread_half_space_destroy(solver);
  return 0;
}
"""
with tempfile.TemporaryDirectory() as folder:
    path = lambda *names: os.path.join(folder, *names)

    def must(*command):
        done = subprocess.run(command, capture_output=True, text=True)
        check.that(f"{command[1]}: succeeds", done.returncode == 0)
        if done.returncode:
            print(done.stdout, done.stderr)
            check.exit()
        return done.stdout

    must("cmake", "--install", sys.argv[1], "--component", "half_space", "--prefix", path("prefix"))
    installed = sorted(os.path.relpath(os.path.join(where, name), path("prefix")) for where, _, names in os.walk(path("prefix")) for name in names)
    check.that("what is installed", {name.split("/")[-1] for name in installed} >= {"half_space.h", "treadConfig.cmake", "libtread_half_space.so.1"}
               and len(installed) <= 7)
    for name, text in (("CMakeLists.txt", PROJECT), ("outside.c", PROGRAM)):
        with open(path(name), "w", encoding="utf-8") as file:
            file.write(text)
    must("cmake", "-S", folder, "-B", path("build"), f"-DCMAKE_PREFIX_PATH={path('prefix')}")
    must("cmake", "--build", path("build"))
    lines = must(path("build/outside"), "run").splitlines()
    status, slope, message = lines[0].split(" ", 2)
    check.that("it solves", (status, message) == ("0", "[]"))
    # Kalker 1990, table E3: 4.12 for a circle and nu = 0.25; a creepage of 1e-5 has a little slip, 16 elements have an error.
    check.relative("its creepage coefficient C11", float(slope), 4.12, 0.02)
    check.that("wrong input: nan, and what was wrong", lines[1].startswith("1 1 [friction = -1"))
check.exit()
