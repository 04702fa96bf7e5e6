#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Python package and the commands that use it, with a stand-in for the program; with the program as argument real runs too.

    tests/python/package_test.py [build/source/tread]
"""

import contextlib
import csv
import glob
import gzip
import importlib.util
import io
import json
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

import numpy as np

import tread
from tread import arcs, files, limits, low_strain, measured_runs, schema, studies, tables
from tread.comparison import compare
from tread.patches import Patch, read_patch, read_patches
from tread.files import read_table
from tread.runs import ROOT, arguments_of, command, environment
from tread.wavelets import NOISE_95, Scalogram, band_pass

REAL_PROGRAM = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 and os.path.isfile(sys.argv[1]) else None

# Refuses a creepage of 0.9 as the program does, and otherwise leaves its arguments and a patch in its folder.
STAND_IN = """#!/usr/bin/python3
import json, os, sys
if "Motion/Creepage=0.9" in sys.argv:
    print("a warning", file=sys.stderr)
    sys.exit("tread: 'Motion/Creepage' cannot be '0.9'")
if sys.argv[1] == "parameters":
    print("subsection Output\\n  set Directory = somewhere  # a folder\\nend")
    sys.exit()
folder = sys.argv[sys.argv.index("--output") + 1]
os.makedirs(folder, exist_ok=True)
with open(os.path.join(folder, "calls"), "a") as stream:
    stream.write(".")
with open(os.path.join(folder, "history.csv"), "w") as stream:
    stream.write("time_s,position_m\\n0.5,1\\n1,2\\n")
with open(os.path.join(folder, "summary.json"), "w") as stream:
    json.dump(dict(completed=True, version="0", normal_force_N=140e3, arguments=sys.argv[1:],
                   warnings=["the cells do not see it", "it sways"] if "Motion/Creepage=0.001" in sys.argv else []), stream)
"""


def write(path, text, mode=0o644):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(text)
    os.chmod(path, mode)
    return path


class InFolder(unittest.TestCase):
    """A test with a folder of its own, which is the current one, and a stand-in for the program."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(temporary.name)
        self.folder = temporary.name
        self.program = write(self.path("stand-in"), STAND_IN)
        os.chmod(self.program, 0o755)

    def path(self, *names):
        return os.path.join(self.folder, *names)


class Tables(InFolder):
    def test_numbers_text_and_comments(self):
        text = "# a comment\na_m, state ,b\n1,slip,x\n\n2.5,adhesion,y\n"
        write(self.path("plain.csv"), text)
        with gzip.open(self.path("packed.csv.gz"), "wt") as stream:
            stream.write(text)
        for name in ("plain.csv", "packed.csv.gz"):
            table = read_table(self.path(name), ("a_m", "state"))
            self.assertEqual(table["a_m"].tolist(), [1, 2.5])
            self.assertEqual(table["state"].tolist(), ["slip", "adhesion"])
            self.assertNotIn("b", table)

    def test_what_is_wrong_is_said_in_one_line(self):
        for text, words in (("", "empty file"), ("a\n1\n", "no column 'b' (columns: a)"), ("a,b\n1,2\n3\n", "data row 2 has 1 entries"),
                            ("a,b\n1,x\n", "column 'b' has an entry that is not a number")):
            with self.assertRaisesRegex(tread.DataError, re.escape("table.csv: " + words)):
                read_table(write(self.path("table.csv"), text), ("b",))
        with self.assertRaisesRegex(tread.DataError, "none.csv: No such file"):
            read_table("none.csv")

    def test_pages(self):
        page = write(self.path("doc", "page.md"), "before\n<!-- begin table t -->\nold\n<!-- end table t -->\nafter\n")
        with mock.patch.object(tables, "ROOT", self.folder), mock.patch("builtins.print"):
            tables.fill("page.md", "t", tables.markdown(["x", "y"], [["1", r"\2"]]))
            with self.assertRaisesRegex(tread.DataError, "no place for table 'u'"):
                tables.fill("page.md", "u", "")
        with open(page, encoding="utf-8") as stream:
            self.assertEqual(stream.read(), "before\n<!-- begin table t -->\n| x | y |\n|---|---|\n| 1 | \\2 |\n<!-- end table t -->\nafter\n")
        self.assertEqual([tables.number(value) for value in (None, 1234.5, 0.012345)], ["-", "1234", "0.0123"])


class Patches(InFolder):
    """An ellipse of Hertz's pressure 6 by 4 mm on nodes 0.5 mm apart, whose trailing third slips."""

    def write_patch(self, name, pressure=1.0, contact=False):
        columns = ("x_mm,y_mm,pn_MPa,px_MPa,py_MPa,sx_m_s,sy_m_s,state" if contact else
                   "x_mm,y_mm,pressure_MPa,shear_x_MPa,shear_y_MPa,slip_x_m_per_s,slip_y_m_per_s,state")
        lines = [columns]
        for x in np.arange(-6, 6.01, 0.5):
            for y in np.arange(-4, 4.01, 0.5):
                square = 1 - (x / 6) ** 2 - (y / 4) ** 2
                p, slips = 1000 * np.sqrt(max(square, 0.0)), x < -2
                state = "exterior" if square <= 0 else "slip" if slips else "adhesion"
                lines.append(f"{x + 3},{y},{pressure * p},{0.3 * p if slips else 0.1 * p},0,{0.2 if slips else 0},0,{state}")
        return write(self.path(name), "\n".join(lines) + "\n")

    def test_patch(self):
        patch = read_patch(self.write_patch("patch.csv"))
        self.assertEqual(patch.pressure.shape, patch.adhesion.shape)
        self.assertAlmostEqual(patch.size_x, 0.5)
        self.assertAlmostEqual(patch.area.sum() / (np.pi * 6 * 4), 1, delta=0.03)  # a node's cell at the rim is in or out
        self.assertAlmostEqual((patch.pressure * patch.area).sum() / (1000 * 2 / 3 * np.pi * 6 * 4), 1, delta=0.01)
        np.testing.assert_allclose(patch.centroid(), (3, 0), atol=1e-9)
        self.assertAlmostEqual(patch.friction_coefficient(), 0.3)
        # Bilinear between the nodes: the mean of the four around, and zero outside.
        np.testing.assert_allclose(patch.sampled(patch.x, np.array([3.25, 30]), np.array([0.25, 0])), [3.25, 0])

    def test_grid(self):
        patch = read_patch(self.write_patch("patch.csv"))
        x, y, pressure = patch.grid("pressure")
        self.assertEqual(pressure.shape, (len(y), len(x)))
        np.testing.assert_array_equal(pressure, patch.grid(patch.pressure)[2])
        i, j = np.argmin(abs(x - 5)), np.argmin(abs(y + 2))  # x of the middle is 3, so that x and y are not taken for each other
        self.assertAlmostEqual(pressure[j, i], 1000 * np.sqrt(1 - (2 / 6) ** 2 - (2 / 4) ** 2))
        self.assertTrue(np.isnan(pressure[0]).all() and np.isnan(pressure[:, -1]).all())  # the empty border
        adhesion = patch.grid("adhesion")[2]
        self.assertEqual((np.nansum(adhesion), np.isfinite(adhesion).sum()), (patch.adhesion.sum(), len(patch.x)))
        self.assertAlmostEqual(float(patch.sampled("shear", 3.0, 0.0)), 100.0)
        np.testing.assert_allclose(patch.sampled("pressure", x=3.0, y=[0.0, 30.0]), [1000, 0])
        # Half a cell beyond the last nodes in contact half of their pressure is left, on all sides.
        for along, values, sign in ((patch.x, patch.y, 1), (patch.x, patch.y, -1), (patch.y, patch.x, 1), (patch.y, patch.x, -1)):
            last = np.argmax(np.where(abs(values - np.median(values)) < 1e-9, sign * along, -np.inf))
            x, y = patch.x[last] + (along is patch.x) * sign * 0.25, patch.y[last] + (along is patch.y) * sign * 0.25
            self.assertAlmostEqual(float(patch.sampled("pressure", x, y)), 0.5 * patch.pressure[last])
        with self.assertRaisesRegex(tread.Error, "no field 'presure', but .*pressure"):
            patch.grid("presure")
        with self.assertRaisesRegex(tread.Error, "3 values for the .* nodes in contact"):
            patch.grid([1.0, 2.0, 3.0])

    def test_means_over_areas(self):
        """Of a plane its value, of a parabola a twelfth of the square of each width more; without width what is interpolated."""
        x, y = (grid.ravel() for grid in np.meshgrid(np.linspace(-2, 2, 81), np.linspace(-1, 1, 41)))
        table = {"x_mm": x, "y_mm": y, "state": np.full(len(x), "slip"), "pressure": 100 + 3 * x - 5 * y, "shear_x": x ** 2 + 10 * y ** 2}
        patch = Patch("made", table, Patch.fields)
        np.testing.assert_allclose(patch.averaged("pressure", [0.3, 0.], [0.1, -0.2], 0.8, 0.4), [100.4, 101.])
        np.testing.assert_allclose(patch.averaged("shear_x", [0., 0.5], [0., 0.2], 0.8, 0.4), np.array([0, 0.65]) + (0.8**2 + 10 * 0.4**2) / 12, rtol=0.03)
        np.testing.assert_allclose(patch.averaged("shear_x", [0.5], [0.2], 0., 0.), [0.65])

    def test_comparison(self):
        own, contact = self.path("run", "patch.csv"), self.write_patch("contact.csv", contact=True)
        write(self.path("run", "summary.json"), "{}")
        self.write_patch(own)
        same = compare(self.path("run"), contact)
        for key in ("max_pressure_relative_difference", "pressure_rms_over_max", "shear_rms_over_max", "micro_slip_rms_over_max",
                    "adhesion_share_difference_points", "shift_x_mm"):
            self.assertAlmostEqual(same[key], 0, delta=1e-9, msg=key)
        self.write_patch(own, pressure=1.02)
        other = compare(self.path("run"), contact)
        self.assertAlmostEqual(other["max_pressure_relative_difference"], 0.02)
        self.assertGreater(other["pressure_rms_over_max"], 0.005)
        self.assertAlmostEqual(compare(self.path("run"), contact, 1.02)["max_pressure_relative_difference"], 0)


class Arcs(InFolder):
    """Profiles of arcs and lines with common tangents."""

    def arcs(self, *rows):
        return write(self.path("arcs.csv"), "radius_mm,until,value\n" + "".join(f"{row}\n" for row in rows))

    def test_a_head_closes(self):
        """60E1: the arcs end on the flank at half of 72 mm, 14.3 mm deep."""
        path = self.arcs("-300,y_mm,10.228", "-80,y_mm,26.0265", "-13,slope,-20  # flank", "", "line,z_mm,-30")
        ends = arcs.joints(arcs.read_arcs(path))
        np.testing.assert_allclose([end[:2] for end in ends], [(0, 0), (10.228, -0.1744), (26.0265, -2.3025), (36, -14.3), (36.785, -30)], atol=3e-4)
        table = np.array(arcs.points(arcs.read_arcs(path), mirror=True))
        np.testing.assert_allclose(table, np.array([[-1, 1]]) * table[::-1])
        self.assertLessEqual(np.hypot(*np.diff(table, axis=0).T).max(), 0.25)
        middle = table[abs(table[:, 0]) < 10]
        np.testing.assert_allclose(np.hypot(middle[:, 0], middle[:, 1] + 300), 300, atol=1e-9)
        result = subprocess.run([os.path.join(ROOT, "contrib", "profile-from-arcs.py"), path, "--output", "points.txt", "--mirror", "--spacing", "1"],
                                capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, r"R13 +35\.9998 +-14\.3000 +-20\.0000")
        np.testing.assert_allclose(np.loadtxt("points.txt"), arcs.points(arcs.read_arcs(path), spacing=1.0, mirror=True), atol=1e-6)

    def test_a_flange(self):
        """From the flange's flank (70 degrees) through a root of 13 mm onto a tread of 1:40: tangents are common, and the root's circle lies above."""
        start = arcs.Place(-40.0, -16.0, math.atan(2.747477))
        path = self.arcs("line,y_mm,-38.5", "-13,slope,0.025", "line,y_mm,30")
        ends = arcs.joints(arcs.read_arcs(path), start)
        self.assertAlmostEqual(ends[1].z, -16 + 1.5 * 2.747477)
        centre = np.array([ends[1].y + 13 * math.sin(ends[1].angle), ends[1].z - 13 * math.cos(ends[1].angle)])
        self.assertAlmostEqual(float(np.hypot(*(np.array(ends[2][:2]) - centre))), 13)
        self.assertAlmostEqual(math.tan(ends[3].angle), 0.025)
        # To a height, past the lowest point of a hollow.
        hollow = arcs.joints(arcs.read_arcs(self.arcs("20,z_mm,1")), arcs.Place(0, 0, math.atan(-0.5)))[1]
        self.assertGreater(hollow.angle, 0)
        self.assertAlmostEqual(hollow.z, 1)

    def test_what_is_wrong_is_named(self):
        for rows, said in ((("-300,y_mm,400",), "line 2: this piece never comes to y_mm = 400"), (("line,slope,1",), "line 2: a line keeps its slope"),
                           (("300,y_mm",), "arcs.csv, line 2: a row is"), (("0,y_mm,3",), "line 2: the radius must not be 0"),
                           (("-300,y_mm,10", "80,z_mm,-9"), "line 3: this piece never comes to z_mm = -9"), ((), "no pieces")):
            with self.assertRaisesRegex(tread.Error, said):
                arcs.joints(arcs.read_arcs(self.arcs(*rows)))
        with self.assertRaisesRegex(tread.Error, "first row must be radius_mm,until,value"):
            arcs.read_arcs(write(self.path("none.csv"), "-300,y_mm,3\n"))


class Wavelets(InFolder):
    STEP = 16e-6
    time = STEP * np.arange(2000)

    def burst(self, frequency, amplitude, middle, duration):
        return amplitude * np.exp(-(((self.time - middle) / duration) ** 2)) * np.sin(2 * np.pi * frequency * (self.time - middle))

    def test_bursts_are_found_where_they_are(self):
        bursts = ((1500, 30.0, 10e-3, 4e-3), (300, 20.0, 20e-3, 10e-3))
        scalogram = Scalogram(sum(self.burst(*burst) for burst in bursts), self.STEP, 50, 2000)
        found = sorted(scalogram.maxima(), reverse=True)
        self.assertEqual(len(found), 2)
        for (frequency, amplitude, middle, duration), (f, n, _, a) in zip(bursts, found):
            self.assertAlmostEqual(f / frequency, 1, delta=0.01)
            self.assertAlmostEqual(self.time[n], middle, delta=0.05 / frequency)
            # A wavelet as long as s (of exp(-t^2/2s^2)) sees the mean of an envelope of duration d: 1/sqrt(1 + 2 s^2/d^2) of its top.
            s = 6.0828 / (2 * np.pi * frequency)
            self.assertAlmostEqual(a / amplitude * np.sqrt(1 + 2 * (s / duration) ** 2), 1, delta=0.02)

    def test_power_of_a_sine_and_of_white_noise(self):
        sine = Scalogram(3 * np.sin(2 * np.pi * 700 * self.time), self.STEP, 100, 2000)
        where = np.unravel_index(np.argmax(np.where(sine.reliable, sine.amplitude, 0)), sine.power.shape)
        self.assertAlmostEqual(sine.amplitude[where] / 3, 1, delta=0.01)
        noise = Scalogram(np.random.default_rng(1).normal(size=60000), self.STEP, 1000, 8000)
        # So long a record has a thousand independent wavelets at 1 kHz and more above: 3 % of the mean.
        self.assertAlmostEqual(noise.power[noise.reliable].mean(), 1, delta=0.05)
        self.assertAlmostEqual((noise.power[noise.reliable] > NOISE_95).mean(), 0.05, delta=0.01)
        with self.assertRaises(ValueError):
            Scalogram(self.time, self.STEP, 50, 1 / self.STEP)

    def test_band_pass(self):
        tone = lambda frequency: np.sin(2 * np.pi * frequency * self.time)
        passed = band_pass(tone(500) + tone(20000) + 5 + 100 * self.time, self.STEP, 50, 2000)
        inner = slice(700, -700)  # half a period of 50 Hz from the ends
        np.testing.assert_allclose(passed[inner], tone(500)[inner], atol=0.02)  # not even delayed
        edge = band_pass(tone(2000), self.STEP, 50, 2000)
        self.assertAlmostEqual(abs(edge[inner]).max(), 0.5, delta=0.01)

    def write_run(self, name, burst, drift, parameters=""):
        x = -500 + 0.5 * np.arange(1400)
        time = 1e-3 * (x + 500) / 30
        middle = 1e-3 * (-140 + 500) / 30
        a = burst * np.exp(-(((time - middle) / 2e-3) ** 2)) * np.cos(2 * np.pi * 1200 * (time - middle)) + drift * np.sin(2 * np.pi * 400 * time)
        rows = "".join(f"{t:.12g},{1e-3 * p:.12g},{v:.12g},{1e5 + 900 * v}\n" for t, p, v in zip(time, x, a))
        write(self.path(name, "history.csv"), "time_s,position_m,axle_box_acceleration_m_per_s2,normal_force_N\n" + rows)
        write(self.path(name, "parameters.prm"), "subsection Defect\n  set Shape = dip\n  set Position (mm) = -150\n  set Length (mm) = 20\nend\n"
              "subsection Motion\n  set Speed (km per h) = 108\nend\n" + parameters)

    def test_the_axle_box_of_a_run(self):
        command = os.path.join(ROOT, "contrib", "plot", "axle-box.py")
        self.write_run("squat", 50, 200)
        self.write_run("smooth", 0, 200)
        result = subprocess.run([command, "squat", "--smooth-twin", "smooth"], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertTrue(os.path.exists(self.path("squat", "axle-box.png")))
        with open(self.path("squat", "axle-box.json"), encoding="utf-8") as stream:
            figures = json.load(stream)
        self.assertEqual(len(figures["dominant"]), 1)
        line = figures["dominant"][0]
        self.assertAlmostEqual(line["frequency_Hz"] / 1200, 1, delta=0.01)
        self.assertAlmostEqual(line["wavelength_mm"], 25, delta=0.3)
        self.assertAlmostEqual(line["force_over_acceleration_kg"], 900, delta=1)
        self.assertAlmostEqual(line["behind_leading_edge_mm"], 10, delta=1)  # the middle of an interval, and two rows
        self.assertAlmostEqual(figures["largest_m_per_s2"], 50 / (1 + 0.6**8), delta=0.3)  # 1200 Hz beside the edge of 2000 Hz
        self.assertGreater(figures["energy_share"]["wavelengths of 20 to 40 mm, 750-1500 Hz"], 0.98)
        self.assertLess(figures["energy_share"]["squats, 200-400 Hz"], 0.01)
        # Not without its twin: there the 400 Hz are the louder.
        self.assertEqual(subprocess.run([command, "squat"], capture_output=True).returncode, 0)
        with open(self.path("squat", "axle-box.json"), encoding="utf-8") as stream:
            self.assertAlmostEqual(json.load(stream)["dominant"][0]["frequency_Hz"] / 400, 1, delta=0.02)
        self.write_run("other", 0, 200, "subsection Contact\n  set Friction coefficient = 0.1\nend\n")
        for arguments, words in (([], "'Contact/Friction coefficient'"), (["--band", "2000", "50"], "--band 2000 50: must ascend"),
                                 (["--from", "900"], "0 rows in between")):
            result = subprocess.run([command, "squat", *(arguments or ["--smooth-twin", "other"]), *arguments], capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1))
            self.assertIn(words, result.stderr)


class Crossings(InFolder):
    """A patch of 12 by 8 mm over a defect from 0 to 10 mm, whose pressure at the edges is twice what Hertz has there; shear stress
    follows where the patch slips, which is its rear half."""

    COMMAND = os.path.join(ROOT, "contrib", "plot", "plot-crossing.py")

    def write_run(self, name, positions, step_y=0.5):
        lines = ["time_s,position_mm,x_mm,y_mm,z_mm,area_mm2,pressure_MPa,shear_x_MPa,shear_y_MPa,slip_x_m_per_s,slip_y_m_per_s,state"]
        for i, position in enumerate(positions):
            for x in np.arange(-30, 40.1, 0.5):
                for y in np.arange(-4, 4.1, step_y):
                    square = 1 - ((x - position) / 6) ** 2 - (y / 4) ** 2
                    if square <= 0 or (2 < x < 8 and abs(y) < 1.1):  # deep in the defect there is no contact
                        continue
                    p, slips = 1000 * np.sqrt(square) * (2 if x in (0, 10) else 1), x < position - 1
                    lines.append(f"{1e-5 * i},{position},{x - position},{y},0,0.25,{p},{0.3 * p if slips else 0.05 * p},0,0,0,"
                                 + ("slip" if slips else "adhesion"))
        write(self.path(name, "patches.csv"), "\n".join(lines) + "\n")
        write(self.path(name, "parameters.prm"), "subsection Defect\n  set Shape = dip\n  set Position (mm) = 0\n  set Length (mm) = 10\nend\n")

    def test_instants(self):
        positions = np.arange(-12, 22.1, 0.5)
        self.write_run("run", positions)
        rows = read_patches(self.path("run", "patches.csv"))
        self.assertEqual([position for _, position, _ in rows], positions.tolist())
        np.testing.assert_allclose(rows[0][2].centroid(), (-12, 0), atol=1e-9)

    def test_edges(self):
        self.write_run("run", np.arange(-12, 22.1, 0.5))
        result = subprocess.run([self.COMMAND, "run", "--output", "pictures"], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(sorted(os.listdir("pictures")), ["crossing-axis.png", "crossing-slip.png", "crossing-stress.png", "crossing.json"])
        with open(self.path("pictures", "crossing.json"), encoding="utf-8") as stream:
            figures = json.load(stream)
        self.assertAlmostEqual(figures["smooth_rail_largest_pressure_MPa"], 1000)
        for edge, place in (("leading_edge", 0), ("trailing_edge", 10)):
            # Pressure with the wheel above the edge, shear stress when the edge has just begun to slip, 1.5 mm behind it.
            for quantity, wheel, value in (("pressure", place, 2000), ("shear", place + 1.5, 600 * np.sqrt(1 - (1.5 / 6) ** 2))):
                line = figures[f"largest_{quantity}_MPa"][edge]
                self.assertEqual((line["wheel_mm"], line["x_mm"], line["y_mm"]), (wheel, place, 0))
                self.assertAlmostEqual(line["value"], value, places=6)
            # sqrt(1 - (x/6)^2) > 0.95 up to x = 1.87 mm.
            self.assertEqual(figures["largest_pressure_MPa"][edge]["above_95_percent_from_to_mm"], [place - 1.5, place + 1.5])

    def test_what_is_missing_is_said(self):
        self.write_run("run", np.arange(-12, 22.1, 2))
        self.write_run("short", np.arange(-12, 5.1, 2))
        write(self.path("none", "parameters.prm"), "")
        for arguments, words in ((["run", "--y", "400"], "--y 400: no nodes there; patches.csv has rows from -3.50 to 3.50 mm"),
                                 (["run", "--at", "50"], "--at 50: patches.csv has the wheel from -12.0 to 22.0 mm"),
                                 (["short"], "short: the wheel does not cross the defect from 0 to 10 mm"),
                                 (["none"], "none/patches.csv: No such file")):
            result = subprocess.run([self.COMMAND, *arguments], capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1))
            self.assertIn(words, result.stderr)


class ModesTable(InFolder):
    def test_the_mode_that_moves_the_contact_most_is_first(self):
        columns = ("number,frequency_Hz,body,vertical_share,lateral_share,longitudinal_share,contact_amplitude_per_sqrt_kg,damping_share,description")
        write(self.path("run", "modes.csv"), columns + "\n1,0,track,1,0,0,0.1,0,rigid motion\n2,100,track,1,0,0,0.01,0,low\n3,1000,track,1,0,0,0.2,0,high\n")
        result = subprocess.run([os.path.join(ROOT, "contrib", "plot", "plot-modes.py"), "run"], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        rows = [row.split(" | ") for row in result.stdout.splitlines()[2:]]
        # An amplitude q with the energy (omega q)^2 / 2 of 1 J.
        self.assertEqual([(row[3], row[5]) for row in rows], [("high", f"{0.2e6 * 2**0.5 / (2000 * np.pi):.1f}"), ("low", f"{0.01e6 * 2**0.5 / (200 * np.pi):.1f}")])


class EnergyTable(InFolder):
    def row(self):
        result = subprocess.run([os.path.join(ROOT, "contrib", "plot", "energy-table.py"), "results", "--scenes", "smooth-rolling.prm", "--print"],
                                capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        rows = [row.strip("| ").split(" | ") for row in result.stdout.splitlines() if row.startswith("| smooth-rolling |")]
        self.assertEqual(len(rows), 1)
        return rows[0]

    def test_what_is_beyond_the_limits_of_the_run_is_bold(self):
        known = {name: schema.parameters()[f"Watchdogs/{name}"]["default"] for name in ("Energy residual", "Contact loss", "Numerical damping", "Hourglass energy",
                                                                                       "Slip chatter", "Unconverged steps")}
        keys = ("energy_residual_of_dissipated", "contact_loss_of_dissipated", "damping_of_friction_and_plasticity", "hourglass_of_internal_energy",
                "slip_chatter_share", "contact_unconverged_share")
        bold = lambda: [cell.startswith("**") for cell in self.row()[3:9]]
        for share, expected in ((-1.01, True), (0.99, False)):
            summary = {"rolled_m": 0.03, "dissipated_work_J": 1., "warnings": [], "version": "0 (abc)",
                       **{key: share * limit for key, limit in zip(keys, known.values())}}
            write(self.path("results", "smooth-rolling", "summary.json"), json.dumps(summary))
            self.assertEqual(bold(), [expected] * 6)
        # The run has other limits of its own.
        write(self.path("results", "smooth-rolling", "parameters.prm"), "subsection Watchdogs\n  set Contact loss = 0.001\n  set Slip chatter = 0.001\nend\n")
        self.assertEqual(bold(), [False, True, False, False, True, False])


class Runs(InFolder):
    def test_command_line(self):
        shipped = os.path.join(ROOT, "prm", "smooth-rolling.prm")
        self.assertEqual(arguments_of("smooth-rolling.prm", {"A/B (mm)": 1.3, "C/D": True}, "out"),
                         [shipped, "-s", "A/B (mm)=1.3", "-s", "C/D=true", "--output", "out"])
        self.assertEqual(arguments_of("smooth-rolling.prm", ["A/B=1"]), [shipped, "-s", "A/B=1"])
        self.assertEqual(arguments_of("smooth-rolling.prm", ["A/B=1", "C/D=2", "A/B = 3"]), [shipped, "-s", "A/B = 3", "-s", "C/D=2"])
        write(self.path("smooth-rolling.prm"), "")
        self.assertEqual(arguments_of("smooth-rolling.prm"), ["smooth-rolling.prm"])
        self.assertEqual((command(["x"], 1, "tread")[0], command(["x"], 1, "tread")[-2:]), ("env", ["tread", "x"]))
        self.assertEqual(command(["x"], 3, "tread")[:3] + command(["x"], 3, "tread")[-2:], ["mpirun", "-np", "3", "tread", "x"])

    def test_environment_is_that_of_the_shell_scripts(self):
        shell = subprocess.run(["bash", "-c", f". {ROOT}/contrib/environment.sh && env -0"], env={"PATH": os.environ["PATH"]},
                               check=True, capture_output=True, text=True).stdout
        shell = dict(line.partition("=")[::2] for line in shell.split("\0") if re.match("DEAL_II|OMP", line))
        with mock.patch.dict(os.environ, {}, clear=True):
            self.assertEqual(environment(), shell)
            self.assertEqual(environment(A="1")["A"], "1")

    def test_a_run(self):
        run = tread.run("smooth-rolling.prm", {"Motion/Creepage": 0.001}, output=self.path("out"), options=["--resume"],
                        program=self.program)
        self.assertEqual((run.folder, run.summary["normal_force_N"]), (self.path("out"), 140e3))
        self.assertEqual(run.summary["arguments"][1:], ["-s", "Motion/Creepage=0.001", "--output", self.path("out"), "--resume"])
        self.assertEqual(run.history["position_m"].tolist(), [1, 2])
        self.assertEqual(run.parameters, {})
        with self.assertRaisesRegex(tread.DataError, "patch.csv: No such file"):
            run.patch
        self.assertEqual(tread.run("smooth-rolling.prm", program=self.program).folder, "somewhere")

    def test_commands(self):
        def said(scene="smooth-rolling.prm", **asked):
            run = tread.run(scene, {"A/B": 1}, program=self.program, **asked)
            return run.folder, [word.replace(os.path.join(ROOT, "prm") + os.sep, "") for word in run.summary["arguments"]]

        words = lambda folder: ["smooth-rolling.prm", "-s", "A/B=1", "--output", folder]
        self.assertEqual(said(command="run"), ("somewhere", words("somewhere")))
        for command in ("reference", "modes", "contact-points"):
            self.assertEqual(said(command=command, options=["--x", "1"]), (f"somewhere-{command}", [command, *words(f"somewhere-{command}"), "--x", "1"]))
        # The table is looked for where scenes are.
        self.assertEqual(said(command="wear", table="damage/contacts.csv", output="worn"),
                         ("worn", ["wear", "smooth-rolling.prm", "damage/contacts.csv", *words("worn")[1:]]))
        write(self.path("own.csv"), "")
        self.assertEqual(said(command="wear", table=pathlib.Path("own.csv"))[1][:3], ["wear", "smooth-rolling.prm", "own.csv"])
        # What was written before there were commands.
        self.assertEqual(said(options=["--reference-only"]), ("somewhere-reference", [*words("somewhere-reference"), "--reference-only"]))
        self.assertEqual(said(options=["--wear", "own.csv"]), ("somewhere-wear", [*words("somewhere-wear"), "--wear", "own.csv"]))

    def test_commands_that_are_wrong(self):
        for asked, message in (({"command": "roll"}, "'roll' is no command for a scene; there are run, reference, modes, contact-points, wear"),
                               ({"command": "batch", "table": "x.csv"}, "'batch' is no command for a scene; there are run, reference, modes, contact-points, wear"),
                               ({"command": "wear"}, "the command 'wear' needs table=, a table of contacts"),
                               ({"command": "reference", "table": "x.csv"}, "the command 'reference' takes no table"),
                               ({"table": "x.csv"}, "the command 'run' takes no table")):
            for start in (lambda **asked: tread.run("smooth-rolling.prm", program=self.program, **asked),
                          lambda **asked: tread.study("smooth-rolling.prm", {"Motion/Creepage": [1]}, output="out", program=self.program, **asked)):
                with self.assertRaises(tread.Error) as caught:
                    start(**asked)
                self.assertEqual(str(caught.exception), message)
        self.assertFalse(os.path.exists("out"))

    def test_a_run_that_fails(self):
        with self.assertRaises(tread.ProgramError) as caught:
            tread.run("smooth-rolling.prm", {"Motion/Creepage": 0.9}, output=self.path("out"), program=self.program)
        self.assertEqual((str(caught.exception), caught.exception.exit_code), ("'Motion/Creepage' cannot be '0.9'", 1))
        with self.assertRaisesRegex(tread.Error, "none: no such program"):
            tread.run("smooth-rolling.prm", program="none")
        with self.assertRaisesRegex(tread.DataError, "none/summary.json: No such file"):
            tread.Run("none").summary

    def test_runs_that_are_kept(self):
        line = lambda arguments, ranks: [self.program, *arguments]
        with mock.patch.object(measured_runs, "words_of", line), mock.patch("builtins.print"):
            for value in (1, 1, 2):  # once more with another setting
                summary = measured_runs.run_scene("smooth-rolling.prm", self.path("kept"), {"A/B": value})
            with self.assertRaisesRegex(tread.ProgramError, "smooth-rolling.prm ended with 1 .'Motion/Creepage' cannot be '0.9'"):
                measured_runs.run_scene("smooth-rolling.prm", self.path("fails"), {"Motion/Creepage": 0.9})
        with open(self.path("kept", "calls"), encoding="utf-8") as stream:
            self.assertEqual(stream.read(), "..")
        self.assertGreater(summary["seconds"], 0)
        self.assertGreater(summary["peak_bytes"], 1e6)


class Studies(InFolder):
    def test_names_of_folders(self):
        self.assertEqual(studies.folder_name({"Motion/Speed (km per h)": "100", "Defect/Depth (mm)": "-0.2"}), "speed-100_depth--0.2")
        self.assertEqual(studies.folder_name({"Rail/Shape": "a b", "Wheel/Shape": "c"}), "rail-shape-a-b_wheel-shape-c")

    def test_a_study(self):
        study = write(self.path("two.study"), f"set Scene = {ROOT}/prm/smooth-rolling.prm\nset Figures = normal_force_N | last(position_m)\n"
                      "subsection Vary\n  set Motion/Creepage = 0.001 | 0.9\nend\n")
        result = subprocess.run([os.path.join(ROOT, "contrib", "study.py"), study, "--program", self.program], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (1, ""))
        with open(self.path("results", "two", "study.csv"), encoding="utf-8") as stream:
            self.assertEqual(list(csv.reader(stream))[1:], [["0.001", "140000", "2", "2", "complete"],
                                                            ["0.9", "", "", "", "failed: 'Motion/Creepage' cannot be '0.9'"]])


    def test_warnings_of_runs(self):
        study = write(self.path("one.study"), f"set Scene = {ROOT}/prm/smooth-rolling.prm\nset Figures = normal_force_N\nsubsection Vary\n"
                      "  set Motion/Creepage = 0.001 | 0.002\nend\n")
        said = self.perform(study).stdout.split("\n")
        self.assertEqual([line for line in said if "WARNING" in line], [f"creepage-0.001: WARNING: {text}" for text in ("the cells do not see it", "it sways")])
        with open(self.path("results", "one", "study.csv"), encoding="utf-8") as stream:
            self.assertEqual([row[2:] for row in csv.reader(stream)], [["warnings", "state"], ["2", "complete"], ["0", "complete"]])

    def test_a_scene_is_no_study(self):
        scene = write(self.path("scene.study"), "subsection Motion\n  set Creepage = 0.001\nend\n")
        with self.assertRaisesRegex(tread.DataError, "line 1: 'subsection Motion' is of a scene.*set Scene"):
            studies.Study.of_file(scene)

    def test_a_file_that_changes_while_its_run_waits(self):
        profile = write(self.path("profile.txt"), "0 0\n")
        scene = write(self.path("scene.prm"), "subsection Defect\n  set Profile file = profile.txt\nend\n")
        asked = studies.Study.of_file(write(self.path("one.study"), f"set Scene = {scene}\nset Figures = normal_force_N\nsubsection Vary\n"
                                            "  set Motion/Creepage = 0.001\nend\n"))
        members = lambda: studies.runs_of(studies.members_of(asked, self.path("results", "one"), self.program))
        waiting = members()
        write(profile, "0 1\n")  # which the run then reads
        with contextlib.redirect_stdout(io.StringIO()):
            studies.run_all(waiting, 1)
        self.assertTrue(members()[0].keep())
        write(profile, "0 0\n")
        self.assertFalse(members()[0].keep())

    def test_results_of_other_input_are_not_taken(self):
        profile = write(self.path("profile.txt"), "0 0\n")
        scene = write(self.path("scene.prm"), "subsection Defect\n  set Profile = profile.txt\nend\n")
        study = lambda creepage, settings="": write(self.path("one.study"), f"set Scene = {scene}\nset Settings = {settings}\nset Figures = normal_force_N\n"
                                                    f"subsection Vary\n  set Motion/Creepage = {creepage}\nend\n")
        folder = self.path("results", "one", "creepage-0.001")
        state = lambda: self.perform(study("0.001")).stdout.split("\n")[0]
        self.assertEqual(state(), "creepage-0.001: begins")
        self.assertNotIn("begins", state())
        write(profile, "0 0.1\n")
        self.assertEqual(state(), "creepage-0.001: begins")
        # A start that fails under other settings, and then once more, where there is a checkpoint under the settings before.
        write(os.path.join(folder, "checkpoint.last"), "checkpoint-0\n")
        for _ in range(2):
            result = self.perform(study("0.001", "Motion/Speed (km per h)=70"), "--program", write(self.path("fails"), "#!/bin/sh\nexit 1\n", 0o755))
            self.assertEqual((result.returncode, "0 of 1 runs complete" in result.stdout, "goes on" in result.stdout), (1, True, False))
        self.assertFalse(os.path.exists(os.path.join(folder, "summary.json")))

    def test_a_profile_in_the_present_folder_goes_before_that_beside_the_scene(self):
        scene = write(self.path("scenes", "scene.prm"), "subsection Defect\n  set Profile file = profile.txt\nend\n")
        beside = write(self.path("scenes", "profile.txt"), "0 0\n")
        study = write(self.path("one.study"), f"set Scene = {scene}\nset Figures = normal_force_N\nsubsection Vary\n  set Motion/Creepage = 0.001\nend\n")
        begins = lambda: "creepage-0.001: begins" in self.perform(study).stdout
        self.assertEqual([begins(), begins()], [True, False])
        write(self.path("profile.txt"), "0 0.1\n")
        self.assertEqual([begins(), begins()], [True, False])
        write(beside, "0 0.2\n")  # which the program does not read
        self.assertFalse(begins())
        write(self.path("profile.txt"), "0 0.3\n")
        self.assertTrue(begins())

    def test_a_study_that_cannot_be(self):
        text = f"set Scene = {ROOT}/prm/smooth-rolling.prm\nsubsection Vary\n  set Motion/Creepage = 0.001\n  set Motion/Creepage = 0.002\nend\n"
        for arguments, what, code in (((write(self.path("twice.study"), text),), "'Motion/Creepage' is there twice", 1),
                                      ((write(self.path("again.study"), "set Ranks = 1\n" + text.replace("\n", "\nset Ranks = 2\n", 1)),), "line 3: 'Ranks' is there twice", 1),
                                      ((write(self.path("two.study"), text.replace("  set Motion/Creepage = 0.002\n", "")), "--processes", "-1"), "'-1' must be 1, 2, ...", 2)):
            result = self.perform(*arguments)
            self.assertEqual((result.returncode, what in result.stderr), (code, True), result.stderr)
        with self.assertRaisesRegex(tread.DataError, "is included by files that it includes"):
            files.texts_of(write(self.path("self.prm"), "include self.prm\n"))
        # Twenty files one in the other are read.
        for number in range(20):
            write(self.path(f"{number}.prm"), f"include {number + 1}.prm\n")
        write(self.path("20.prm"), "subsection General\n  set Title = innermost\nend\n")
        self.assertEqual(files.own_parameters(self.path("0.prm")), {"General/Title": "innermost"})

    def test_a_parameter_that_there_is_not_is_refused_before_the_first_run(self):
        text = "set Scene = {}\nset Settings = {}=1\nset Smooth twin = {}=none\nsubsection Vary\n  set {} & {} = 0.001 & 1 | 0.002 & 2\nend\n"
        right = [f"{ROOT}/prm/smooth-rolling.prm", "Contact/Friction coefficient", "Defect/Shape", "Motion/Creepage", "Defect/Length (mm)"]
        for wrong, entry, meant in (("Contact/Friction coeficient", "Settings", "Contact/Friction coefficient"), ("Defect/Shap", "Smooth twin", "Defect/Shape"),
                                    ("Motion/Crepage", "Vary", "Motion/Creepage"), ("Motion/Length (mm)", "Vary", "Rail/Length (mm)")):
            with self.subTest(wrong):
                names = [wrong if name == meant or (name, wrong) == ("Defect/Length (mm)", "Motion/Length (mm)") else name for name in right]
                study = write(self.path("wrong.study"), text.format(*names))
                for more in ((), ("--dry-run",)):
                    result = self.perform(study, *more)
                    self.assertEqual((result.returncode, result.stdout, result.stderr),
                                     (1, "", f"study.py: {study}: '{entry}': no parameter '{wrong}'; did you mean '{meant}'?\n"))
        self.assertFalse(os.path.exists("results"))
        # A newer program knows more than this package.
        newer = write(self.path("newer"), f"#!/bin/sh\n[ $1 = parameters ] && printf 'subsection Motion\\n  set Crepage = 1\\nend\\n' && exit\n"
                      f"exec {self.program} \"$@\"\n", 0o755)
        self.assertEqual(self.perform(write(self.path("new.study"), text.format(*[name.replace("Creepage", "Crepage") for name in right])), "--dry-run",
                                      "--program", newer).returncode, 0)

    def test_where_a_figure_reaches_a_limit(self):
        self.assertEqual(limits.crossing([4, 6, 8], [700, 800, 1000], 900), (8, 6, 7))
        self.assertEqual(limits.crossing([8, 4, 6], [1000, None, 800], 900), (8, 6, 7))
        self.assertEqual(limits.crossing([8, 4, 6], [1000, 800, None], 900), (8, 4, None))
        self.assertEqual(limits.crossing([4, 6], [700, 800], 900), (None, 6, None))
        self.assertEqual(limits.crossing([4, 6], [950, 980], 900), (4, None, None))
        self.assertEqual(limits.crossing([4, 6, 8], [950, 800, 1000], 900), (4, None, None))

    def limit_study(self, *entries, lengths="4 & 0.04 | 8 & 0.08"):
        return write(self.path("limit.study"), f"set Scene = {ROOT}/prm/smooth-rolling.prm\n" + "".join(e + "\n" for e in entries) +
                     f"subsection Vary\n  set Mesh/Finest cell (mm) = 2 | 1\n  set Defect/Length (mm) & Defect/Depth (mm) = {lengths}\nend\n")

    def perform(self, study, *more):
        return subprocess.run([os.path.join(ROOT, "contrib", "study.py"), study, "--program", self.program, *more], capture_output=True, text=True)

    def test_a_limit(self):
        study = studies.Study.of_file(self.limit_study("set Figures = f", "set Limit = f = 900 over Defect/Length (mm)", "set Mesh = Mesh/Finest cell (mm)",
                                               lengths="4 & 0.04 | 6 & 0.06 | 8 & 0.08"))
        self.assertEqual([m["Defect/Depth (mm)"] for m in study.members], ["0.04", "0.06", "0.08"] * 2)

        def rows_and_words(figures, smooth=700):
            with mock.patch("builtins.print") as said:
                heading, *rows = study.limits[0].rows(list(zip(study.members, figures, [smooth] * 6)))
            self.assertEqual(heading, ["figure", "limit", "Mesh/Finest cell (mm)", "smooth", "largest_below", "smallest_above", "Defect/Length (mm)",
                                       "uncertainty"])
            self.assertEqual([row.pop(1) for row in rows], [900.] * 2)
            return rows, "\n".join(str(call.args[0]) for call in said.call_args_list)

        rows, words = rows_and_words([750, 850, 950, 850, 950, 980])
        self.assertEqual(rows, [["f", 2., 700, 6., 8., "7", ""], ["f", 1., 700, 4., 6., "5", "2"]])
        self.assertIn("5 +- 2 by the two finest meshes", words)
        # The smooth rail has more than the limit: no size.
        rows, words = rows_and_words([890, 1000, 1000] * 2, smooth=910)
        self.assertEqual([row[3:] for row in rows], [["", "", "", ""]] * 2)
        self.assertIn("below what the smooth rail has, 910", words)
        self.assertNotIn("+-", words)
        # The finest mesh does not reach the limit between two sizes.
        for figures, finest in (([950, 960, 970], "below 4"), ([700, 710, 720], "above 8"), ([None] * 3, "no figures")):
            rows, words = rows_and_words([750, 850, 950] + figures)
            self.assertIn(f"7 with Mesh/Finest cell (mm) 2, {finest} with 1: not settled", words)
            self.assertEqual(rows[1][5:], ["", ""])
        # A run without a figure between two sizes; one that is smaller than both is named.
        for missing in (None, float("nan")):
            rows, words = rows_and_words([800, missing, 1000, missing, 850, 950])
            self.assertEqual([row[3:] for row in rows], [[4., 8., "", ""], [6., 8., "7", ""]])
            self.assertIn("between 4 and 8; no figure at 6", words)
            self.assertIn("7, between 6 and 8; no figure at 4", words)
            self.assertIn("between 4 and 8 with Mesh/Finest cell (mm) 2, 7 with 1: not settled", words)

    def test_a_limit_to_which_a_figure_falls(self):
        answer = lambda *figures, smooth=None: limits.Answer([(size, figure, smooth) for size, figure in zip((8, 4, 6), figures)], 900)
        for smooth in (None, 1000.):
            found = answer(700, 950, 850, smooth=smooth)
            self.assertEqual((found.below, found.above, found.at, found.from_above), (4, 6, 5, True))
            self.assertIn("5, between 4 and 6; the figure falls", found.sentence)
        self.assertEqual(answer(700, 850, 800, smooth=1000).words, "below 4")
        self.assertEqual(answer(910, 950, 920, smooth=1000).words, "above 8")
        self.assertIn("the figure falls, from 1000 on the smooth rail", answer(910, 950, 920, smooth=1000).sentence)
        # What is below the limit and falls does not come to it, whether it is looked for from below or from above.
        for smooth in (None, 800):
            found = answer(600, 700, 650, smooth=smooth)
            self.assertEqual((found.words, found.below, found.above, found.at), ("nowhere from 4 to 8", None, None, None))
        # It rises from the smooth rail, though not from the smallest defect.
        self.assertEqual(answer(940, 950, 945, smooth=700).words, "below 4")
        self.assertEqual(answer(1000, 890, 950, smooth=910).words, "no defect is needed")

    def test_a_figure_of_0_is_none(self):
        found = limits.Answer([(4, 0., None), (6, 800, None), (8, 1000, None)], 900)
        self.assertEqual((found.below, found.above, found.at), (6, 8, 7))
        self.assertIn("no figure at 4 (it is 0)", found.sentence)
        for figure, smooth in ((0, 0), (None, 950), (float("nan"), None)):
            found = limits.Answer([(4, figure, smooth), (8, figure, smooth)], 900)
            self.assertEqual((found.words, found.below, found.above, found.at), ("no figures", None, None, None))

    def test_limits_in_one_table(self):
        program = write(self.path("program"), "#!/usr/bin/python3\nimport json, sys\nfolder = sys.argv[sys.argv.index('--output') + 1]\n"
                        "length = [float(a.split('=')[1]) for a in sys.argv if 'Length' in a][0]\n"
                        "json.dump({'completed': True, 'f': 100 * length}, open(folder + '/summary.json', 'w'))\n", 0o755)
        limits_of = lambda *values: "set Limit = " + " | ".join(f"f = {value} over Defect/Length (mm)" for value in values)
        mesh, out = "set Mesh = Mesh/Finest cell (mm)", self.path("results", "limit", "limit.csv")

        def perform(*entries, program=program):
            result = self.perform(self.limit_study("set Figures = f", *entries), "--program", program)
            if not os.path.exists(out):
                return result.stdout, None
            with open(out, encoding="utf-8") as stream:
                return result.stdout, list(csv.DictReader(stream))

        said, rows = perform(limits_of(500, 600), mesh)
        self.assertEqual([(float(row["limit"]), row["Defect/Length (mm)"]) for row in rows], [(500, "5")] * 2 + [(600, "6")] * 2)
        self.assertNotIn("one mesh only", said)
        self.assertIn("the uncertainty is not known: there is one mesh only", self.perform(write(self.path("one.study"), (
            f"set Scene = {ROOT}/prm/smooth-rolling.prm\nset Figures = f\n{limits_of(500)}\nsubsection Vary\n  set Defect/Length (mm) = 4 | 8\nend\n")),
            "--program", program).stdout)
        # It says nothing of other settings than study.csv does.
        _, rows = perform(limits_of(500), mesh, "set Settings = Motion/Speed (km per h)=70", program=write(self.path("fails"), "#!/bin/sh\nexit 1\n", 0o755))
        self.assertEqual([row["Defect/Length (mm)"] + row["largest_below"] for row in rows], [""] * 2)
        self.assertIsNone(perform()[1])

    def test_limits_that_cannot_be(self):
        for entries, words in ((["set Limit = f over"], "FIGURE = VALUE over PARAMETER"), (["set Limit = f = 1 over Rail/Length (mm)"], "is not varied"),
                               (["set Mesh = Mesh/Finest cell (mm)"], "there is none"),
                               (["set Limit = f = 1 over Defect/Length (mm)", "set Mesh = Fine"], "is not varied"),
                               (["set Limit = f = 1 over Mesh/Finest cell (mm)", "set Mesh = Mesh/Finest cell (mm)"], "is the 'Mesh'"),
                               (["set Limit = g = 1 over Defect/Length (mm)"], "'g' is not among 'Figures': f"),
                               *(([f"set Limit = f = {value} over Defect/Length (mm)"], f"'{value}'; allowed: numbers above 0")
                                 for value in ("nan", "inf", "-9e8", "0"))):
            result = self.perform(self.limit_study("set Figures = f", *entries))
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
            self.assertIn(words, result.stderr)
        result = self.perform(self.limit_study(lengths="4 & 0.04 | 8"))
        self.assertIn("must be 2 values with &", result.stderr)

    def twin_study(self, vary, *entries, scene=""):
        scene = write(self.path("defect.prm"), scene or "subsection Peak stress\n  set Region = trailing edge\nend\n")
        return write(self.path("twin.study"), f"set Scene = {scene}\nset Smooth twin = Defect/Shape=none\n" + "".join(e + "\n" for e in entries) +
                     "subsection Vary\n" + "".join(f"  set {v}\n" for v in vary) + "end\n")

    def test_smooth_twins_lie_where_the_runs_do(self):
        def twins(*vary, scene=""):
            lines = self.perform(self.twin_study(vary, scene=scene), "--dry-run").stdout.splitlines()
            found = dict(line.split(": ", 1) for line in lines if line.startswith("smooth-twin"))
            self.assertEqual(lines[:len(found)], [f"{name}: {settings}" for name, settings in found.items()])  # they are first
            return found

        length, position = "Defect/Length (mm) = 4 | 8", "Defect/Position (mm) = -10 | 5"
        # One for all lengths, for which the scene or else the first run says where the peaks are, and that the axle has its inertia.
        self.assertEqual(twins(length), {"smooth-twin": "Defect/Shape=none, Defect/Length (mm)=4"})
        scene = "subsection Peak stress\n  set Region = {}\nend\nsubsection Defect\n  set Length (mm) = {}\nend\n"
        self.assertEqual(twins(length, scene=scene.format("range", "0")), {"smooth-twin": "Defect/Shape=none, Defect/Length (mm)=4"})
        for text in (scene.format("trailing edge", "6"), scene.format("none", "6"), "include parts.inc\n"):
            write(self.path("parts.inc"), scene.format("trailing edge", "6"))
            self.assertEqual(twins(length, scene=text), {"smooth-twin": "Defect/Shape=none"})
        # One for each position.
        self.assertEqual(twins(position, "Defect/Depth (mm) = 0.1 | 0.2", scene=scene.format("trailing edge", "6")),
                         {f"smooth-twin_position-{x}": f"Defect/Position (mm)={x}, Defect/Shape=none" for x in ("-10", "5")})
        self.assertEqual(twins("Defect/Position (mm) & Defect/Length (mm) = -10 & 4 | 5 & 8"),
                         {f"smooth-twin_position-{x}": f"Defect/Position (mm)={x}, Defect/Shape=none, Defect/Length (mm)={l}" for x, l in (("-10", 4), ("5", 8))})

    def test_a_smooth_twin_that_fails_hides_no_other_figure(self):
        """The stand-in knows no dynamic-force: without a twin's fault that is the reason why there is no figure."""
        program = write(self.path("program"), f"#!/bin/sh\ncase \"$*\" in *Shape=none*$FAILING*) echo 'tread: no edge' >&2; exit 1;; esac\nexec {self.program} \"$@\"\n", 0o755)

        def perform(figures, failing, *entries):
            with mock.patch.dict(os.environ, {"FAILING": failing}):
                result = self.perform(self.twin_study(["Defect/Length (mm) = 4 | 8"], f"set Figures = {figures}", *entries), "--program", program)
            with open(self.path("results", "twin", "study.csv"), encoding="utf-8") as stream:
                return result, list(csv.reader(stream))[1:]

        limit = "set Limit = normal_force_N = 1e5 over Defect/Length (mm)"
        result, rows = perform("normal_force_N | dynamic(normal_force_N)", "", limit)
        self.assertEqual((result.returncode, rows), (1, [["4", "140000", "", "0", "complete"], ["8", "140000", "", "0", "complete"]]), result.stderr)
        self.assertLess(result.stdout.index("smooth-twin: begins"), result.stdout.index("length-4: begins"))
        self.assertIn("length-4: no 'dynamic(normal_force_N)': its smooth twin smooth-twin failed: no edge", result.stdout)
        self.assertIn("below 4, the smallest with a figure", result.stdout)
        # The exit code tells of it also where no figure needs it.
        result, rows = perform("normal_force_N", "")
        self.assertEqual((result.returncode, rows), (1, [["4", "140000", "0", "complete"], ["8", "140000", "0", "complete"]]))
        self.assertIn("\nsmooth-twin: failed: no edge\n2 of 2 runs complete", result.stdout)
        # What does not need a dynamic force does not fail with it; nor is one that is there taken once the twin fails.
        result, rows = perform("normal_force_N", "never")
        self.assertEqual((result.returncode, [row[-1] for row in rows]), (0, ["complete"] * 2), result.stdout)
        write(self.path("results", "twin", "length-4", "dynamic.json"), '{"forces": {"normal_force_N": {"peak_N": 5}}}')
        self.assertEqual([row[1] for row in perform("dynamic(normal_force_N)", "never")[1]], ["5", ""])
        self.assertEqual([row[1] for row in perform("dynamic(normal_force_N)", "", "set Settings = Motion/Speed (km per h)=70")[1]], ["", ""])

    def interrupt(self, study, *more, ready):
        """Ctrl-C as soon as a file is there. @returns exit code, {what: said of it}"""
        with subprocess.Popen([os.path.join(ROOT, "contrib", "study.py"), study, *more], stdout=subprocess.PIPE, text=True) as process:
            while not os.path.exists(ready) and process.poll() is None:
                time.sleep(0.02)
            process.send_signal(signal.SIGINT)
            said = process.communicate()[0]
        return process.returncode, dict(re.findall(r"^(\S+): (?!begins|goes on)(.+)$", said, re.MULTILINE))

    def test_ctrl_c_with_mpirun_whose_exit_code_is_1(self):
        """Of the runs one has nothing, one a checkpoint after a fault before it, one its results, and one a fault."""
        write(self.path("mpirun"), "#!/bin/sh\ntrap '' INT\n$0-rank \"$@\"\nexit 1\n", 0o755)  # as if it told its ranks too late
        write(self.path("mpirun-rank"), f"""#!/usr/bin/python3
import glob, os, signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)
folder = sys.argv[sys.argv.index("--output") + 1]
what = folder[-1]
leave = lambda name, text: open(os.path.join(folder, name), "w").write(text)
if what == "2" and "--resume" not in sys.argv:
    leave("checkpoint.last", "checkpoint-0")
    sys.exit("tread: no space left")
try:
    leave("ready", "")
    while what == "4" and len(glob.glob(folder[:-1] + "*/ready")) < 4:
        time.sleep(0.02)
    leave("all-ready", "")
    time.sleep(60)
except KeyboardInterrupt:
    if what == "3":
        leave("summary.json", '{{"completed": true, "normal_force_N": 5}}')
    sys.exit("tread: no checkpoint, disk full" if what == "4" else 1)
""", 0o755)
        entries = "set Ranks = 2\nset Processes = 4\nset Figures = normal_force_N\nset Limit = normal_force_N = 3 over Motion/Passages\n"
        study = write(self.path("four.study"), f"set Scene = {ROOT}/prm/smooth-rolling.prm\n{entries}subsection Vary\n  set Motion/Passages = 2 | 1 | 3 | 4\nend\n")
        with mock.patch.dict(os.environ, {"PATH": f"{self.folder}:{os.environ['PATH']}"}):
            arguments = (study, "--program", self.program)
            one = write(self.path("one.study"), f"set Scene = {ROOT}/prm/smooth-rolling.prm\nset Ranks = 2\nset Directory = results/four\nset Figures = normal_force_N\n"
                        "subsection Vary\n  set Motion/Passages = 2\nend\n")
            self.assertIn("passages-2: failed: no space left", self.perform(one).stdout)
            write(self.path("results", "four", "limit.csv"), "of other settings\n")
            code, states = self.interrupt(*arguments, ready=self.path("results", "four", "passages-4", "all-ready"))
        self.assertEqual((code, states), (130, {"passages-1": "interrupted", "passages-2": "interrupted", "passages-3": "complete",
                                                "passages-4": "failed: no checkpoint, disk full",
                                                "INTERRUPTED": "the same command goes on"}))
        with open(self.path("results", "four", "study.csv"), encoding="utf-8") as stream:
            self.assertEqual([row[:2] for row in csv.reader(stream)][1:], [["2", ""], ["1", ""], ["3", "5"], ["4", ""]])
        with open(self.path("results", "four", "limit.csv"), encoding="utf-8") as stream:
            self.assertEqual(list(csv.reader(stream))[1:], [["normal_force_N", "3.0", "", "", "3.0", "", ""]])

    def test_runs_of_another_version_are_named(self):
        study = self.twin_study(["Defect/Length (mm) = 4 | 8"], "set Figures = normal_force_N")
        line = "2 of 3 runs, with smooth twins, were kept as other versions of the program than 1 (abc) made them: smooth-twin (0), length-4 (0)\n"
        newer = write(self.path("newer"), f"#!/bin/bash\nif [ $1 = --version ]; then echo 'tread 1 (abc)'; exit; fi\n"
                      f"{self.program} \"$@\" && sed -i 's/\"version\": \"0\"/\"version\": \"1 (abc)\"/' \"${{@: -1}}/summary.json\"\n", 0o755)
        self.assertNotIn("other versions", self.perform(study).stdout)
        self.assertNotIn("other versions", self.perform(study).stdout)  # of a program that does not tell
        os.remove(self.path("results", "twin", "length-8", "summary.json"))
        result = self.perform(study, "--program", newer)
        self.assertEqual((result.returncode, line in result.stdout, result.stdout.count("begins")), (0, True, 1), result.stdout + result.stderr)
        for name in ("smooth-twin", "length-4"):
            os.remove(self.path("results", "twin", name, "summary.json"))
        self.assertNotIn("other versions", self.perform(study, "--program", newer).stdout)
        self.assertNotIn("other versions", self.perform(study, "--program", newer).stdout)


class StudiesFromPython(InFolder):
    def calls(self, row):
        with open(os.path.join(row["folder"], "calls"), encoding="utf-8") as stream:
            return len(stream.read())

    def vary(self, creepages, **options):
        return tread.study("smooth-rolling.prm", {"Motion/Creepage": creepages}, program=self.program,
                           **{"figures": ["normal_force_N", "last(position_m)"], "processes": 2, "output": "out", **options})

    def test_a_study(self):
        with mock.patch.dict(sys.modules, {"pandas": None}), contextlib.redirect_stdout(io.StringIO()) as said:
            rows = self.vary([0.001, 0.9])
        self.assertEqual(said.getvalue(), "")
        self.assertEqual(list(rows[0]), ["Motion/Creepage", "normal_force_N", "last(position_m)", "warnings", "state", "folder"])
        self.assertEqual(list(rows[0].values()), [0.001, 140e3, 2., 2, "complete", "out/creepage-0.001"])
        self.assertEqual((rows[1]["state"], np.isnan(rows[1]["normal_force_N"])), ("failed: 'Motion/Creepage' cannot be '0.9'", True))
        with open("out/study.csv", encoding="utf-8") as stream:
            self.assertEqual(list(csv.reader(stream))[1], ["0.001", "140000", "2", "2", "complete"])

    def test_what_is_complete_is_kept(self):
        with mock.patch.dict(sys.modules, {"pandas": None}):
            self.vary([0.001])
            rows = self.vary([0.001, 0.002])
            self.assertEqual([self.calls(row) for row in rows], [1, 1])
            rows = self.vary([0.001, 0.002], settings={"Output/Write volume": False})  # other input
            self.assertEqual([self.calls(row) for row in rows], [2, 2])
            rows = self.vary([0.001], settings={"Output/Write volume": False}, options=["--reference-only"])
            self.assertEqual(self.calls(rows[0]), 3)
            words = ["-s", "Output/Write volume=false", "-s", "Motion/Creepage=0.001", "--output", "out/creepage-0.001"]
            said = lambda: tread.Run("out/creepage-0.001").summary["arguments"]
            self.assertEqual(said()[1:], [*words, "--reference-only"])
            vary = lambda **asked: self.calls(self.vary([0.001], settings={"Output/Write volume": False}, **asked)[0])
            self.assertEqual([vary(command="reference"), vary(command="reference"), said()[0], said()[2:]], [4, 4, "reference", words])
            for content, calls in (("a\n1\n", 5), ("a\n1\n", 5), ("a\n2\n", 6)):  # a table is input, too
                self.assertEqual(vary(command="wear", table=write(self.path("table.csv"), content)), calls)
            self.assertEqual([said()[0], said()[2:]], ["wear", [self.path("table.csv"), *words]])
            with self.assertRaisesRegex(tread.DataError, "none.csv: no such table"):
                vary(command="wear", table="none.csv")

    def test_parameters_that_vary_together(self):
        with mock.patch.dict(sys.modules, {"pandas": None}):
            rows = tread.study("smooth-rolling.prm", {("Defect/Length (mm)", "Defect/Shape"): [(1, "x"), (2, "y")], "Output/Write volume": [True]}, combination="product", output="out",
                               program=self.program, figures=["normal_force_N"])
            self.assertEqual([list(row.values())[:3] for row in rows], [[1, "x", True], [2, "y", True]])
            rows = tread.study("smooth-rolling.prm", {"Defect/Length (mm)": [1, 2], "Defect/Depth (mm)": [3, 4]}, combination="zip", output="zip", program=self.program,
                               figures=["normal_force_N"])
        self.assertEqual([list(row.values())[:3] for row in rows], [[1, 3, 140e3], [2, 4, 140e3]])
        self.assertEqual(sorted(os.listdir("out")), ["length-1_shape-x_write-volume-true", "length-2_shape-y_write-volume-true", "study.csv"])

    def test_a_figure_that_is_not_there(self):
        with mock.patch.dict(sys.modules, {"pandas": None}), self.assertWarnsRegex(UserWarning, "summary.json has no figure 'none'"):
            rows = self.vary([0.001], figures=["none"])
        self.assertTrue(np.isnan(rows[0]["none"]))

    def test_what_cannot_be(self):
        for vary, more, words in (({}, {}, "names no parameter"), ({"A/B": ["1|2"]}, {}, "'1|2' cannot be varied"), ({"A/B": []}, {}, "'Vary/A/B' has no value"),
                                  ({("A/B", "A/C"): [(1,)]}, {}, "must be 2 values"), ({"A/B": [1, 1.0]}, {}, "two runs have the same values"),
                                  ({"A/B": [1], "A/C": [1, 2]}, {"combination": "zip"}, "zip needs as many"), ({"A/B": [1]}, {"combination": "sum"}, "'sum'"),
                                  ({"A/B": [1]}, {"processes": 0}, "'Processes' cannot be '0'"), ({"A/B": [1]}, {"figures": ["mean(x)"]}, "no 'mean(...)'"),
                                  ({"A/B": [1]}, {"program": "none"}, "none: no such program"), ({"A/B": [1]}, {}, "'Vary': no parameter 'A/B'"),
                                  ({"Motion/Creepage": [1]}, {"settings": {"Motion/Creepage": 2}}, "'Motion/Creepage' is in 'Settings' and in 'Vary'"),
                                  ({"Motion/Creepage": [1]}, {"settings": {"Motion/Sped": 1}}, "'Settings': no parameter 'Motion/Sped'; did you mean 'Motion/Speed (km per h)'?")):
            with self.assertRaisesRegex(tread.DataError, re.escape(words)):
                tread.study("smooth-rolling.prm", vary, **{"program": self.program, "output": "out", **more})
        with self.assertRaisesRegex(tread.DataError, "none.prm: no such scene"):
            tread.study("none.prm", {"A/B": [1]}, program=self.program)
        self.assertFalse(os.path.exists("out"))

    def test_ctrl_c_ends_the_runs_with_a_checkpoint(self):
        program = write(self.path("slow"), "#!/usr/bin/python3\nimport sys, time\nif sys.argv[1] == 'columns':\n  sys.exit(1)\nopen('begun', 'w').close()\ntry:\n  time.sleep(60)\n"
                        "except KeyboardInterrupt:\n  sys.exit(130)\n", 0o755)
        call = f"import tread\ntry:\n  tread.study('smooth-rolling.prm', {{'Motion/Passages': [1]}}, output='out', program={program!r})\nexcept KeyboardInterrupt:\n  print('stopped')"
        with subprocess.Popen([sys.executable, "-c", call], env={**os.environ, "PYTHONPATH": os.path.join(ROOT, "contrib/python")},
                              stdout=subprocess.PIPE, text=True, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler)) as process:
            while not os.path.exists("begun") and process.poll() is None:
                time.sleep(0.02)
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.communicate()[0], "stopped\n")
        with open("out/study.csv", encoding="utf-8") as stream:
            self.assertIn(",interrupted", stream.read())

    def test_frames(self):
        """With a stand-in for pandas, which need not be installed."""
        pandas = mock.Mock(DataFrame=lambda rows, columns=None: ("frame", rows, columns))
        with mock.patch.dict(sys.modules, {"pandas": pandas}):
            kind, rows, _ = self.vary([0.001])
            self.assertEqual((kind, rows[0]["Motion/Creepage"]), ("frame", 0.001))
            history = [{"time_s": 0.5, "position_m": 1.}, {"time_s": 1., "position_m": 2.}]
            self.assertEqual(tread.Run("out/creepage-0.001").frame(), ("frame", history, ["time_s", "position_m"]))
        with mock.patch.dict(sys.modules, {"pandas": None}):
            self.assertEqual(tread.Run("out/creepage-0.001").frame("history.csv"), history)


class LowStrain(unittest.TestCase):
    def test_scenes_of_sizes(self):
        for size in low_strain.LOW_STRAIN:
            scene, settings = low_strain.low_strain_scene(size)
            cell = settings.get("Mesh/Finest cell (mm)")
            with open(os.path.join(ROOT, "prm", scene), encoding="utf-8") as stream:
                own = float(re.search(r"set Finest cell \(mm\) *= *(\S+)", stream.read())[1])
            self.assertEqual(own if cell is None else cell, size)
        self.assertEqual(low_strain.low_strain_scene(0.5), ("verification/low-strain-0.63.prm", {"Mesh/Finest cell (mm)": 0.5}))

    def test_differences(self):
        summary = {"creepage": 0.99e-3, "adhesion_share": 0.66, "reference": {"creepage": {"half-space": {"value": 1e-3}},
                                                                                "adhesion_share": {"half-space": {"value": 0.62}}}}
        self.assertAlmostEqual(low_strain.difference(summary, "creepage", "half-space"), -1.)
        self.assertAlmostEqual(low_strain.difference(summary, "adhesion_share", "half-space"), 4.)
        self.assertIsNone(low_strain.difference(summary, "max_pressure_Pa", "Hertz"))
        self.assertEqual([low_strain.signed(value) for value in (None, 0.0123, -2.345)], ["-", "+0.012", "-2.35"])


# Pairs of a command and the beginning of the names of its output's files; prints the exit codes.
HELP_OF_ALL = """
import os, runpy, sys
import matplotlib.pyplot, numpy, scipy.interpolate, scipy.optimize
for path, place in zip(sys.argv[1::2], sys.argv[2::2]):
    if not (child := os.fork()):
        for number, end in ((1, ".out"), (2, ".err")):
            os.dup2(os.open(place + end, os.O_CREAT | os.O_WRONLY), number)
        sys.path[0], sys.argv = os.path.dirname(path), [path, "--help"]
        try:
            runpy.run_path(path, run_name="__main__")
            code = "returned"
        except SystemExit as ended:
            code = ended.code
        sys.stdout.flush()
        os._exit(1 if code else 0)  # to tidy up what was loaded would take as long again
    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
"""


class Commands(unittest.TestCase):
    def test_help_from_any_folder(self):
        commands = [path for pattern in ("contrib/*.py", "contrib/plot/*.py", "benchmarks/*.py") for path in glob.glob(os.path.join(ROOT, pattern))]
        self.assertGreater(len(commands), 15)
        with tempfile.TemporaryDirectory() as folder:
            # What takes their time are libraries, which one interpreter loads for all of them.
            places = [os.path.join(folder, str(number)) for number in range(len(commands))]
            started = subprocess.run([sys.executable, "-c", HELP_OF_ALL, *(word for pair in zip(commands, places) for word in pair)],
                                     cwd="/", env={"PATH": os.environ["PATH"]}, capture_output=True, text=True)
            self.assertEqual(started.stderr, "")
            for path, place, code in zip(commands, places, started.stdout.split()):
                with self.subTest(os.path.relpath(path, ROOT)), open(place + ".out", encoding="utf-8") as stdout, open(place + ".err", encoding="utf-8") as stderr, \
                        open(path, encoding="utf-8") as text:
                    self.assertEqual((int(code), stderr.read()), (0, ""))
                    self.assertIn("usage: " + os.path.basename(path), stdout.read())
                    self.assertTrue(os.access(path, os.X_OK) and text.readline() == "#!/usr/bin/python3\n")
            self.assertEqual(len(started.stdout.split()), len(commands))

    def test_import_from_any_folder(self):
        """As the README shows it: by PYTHONPATH, and installed into an environment of its own, which finds the program and the scenes of this folder."""
        with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as stream:
            readme = stream.read()
        path = re.search(r"PYTHONPATH=\$PWD/(\S+) /usr/bin/python3", readme)[1]
        ask = "import tread, tread.runs; print(tread.runs.PROGRAM, tread.runs.scene_path('smooth-rolling.prm'))"
        with tempfile.TemporaryDirectory() as folder:
            for name in ("contrib/python", "prm"):
                shutil.copytree(os.path.join(ROOT, name), os.path.join(folder, name), symlinks=True, ignore=shutil.ignore_patterns("*.egg-info", "__pycache__"))
            wanted = f"{folder}/build/source/tread {folder}/prm/smooth-rolling.prm\n"
            asked = subprocess.run(["/usr/bin/python3", "-c", ask], cwd="/", env={"PYTHONPATH": os.path.join(folder, path)}, capture_output=True, text=True)
            self.assertEqual((asked.stdout, asked.stderr), (wanted, ""))
            if not os.path.isdir("/usr/share/python-wheels") or not importlib.util.find_spec("wheel"):
                self.skipTest("python3-venv or python3-wheel is not installed")
            line = re.search(r"^    (.*-m venv .*?)(?:\s+#.*)?$", readme, re.MULTILINE)[1]
            made = subprocess.run(["bash", "-c", line], cwd=folder, env={**os.environ, "PIP_NO_INDEX": "1"}, capture_output=True, text=True)
            self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
            asked = subprocess.run([os.path.join(folder, "build/python/bin/python"), "-c", ask], cwd="/", capture_output=True, text=True)
            self.assertEqual((asked.stdout, asked.stderr), (wanted, ""))

    def test_what_fails_is_said_in_one_line(self):
        result = subprocess.run([os.path.join(ROOT, "contrib/plot/plot-run.py"), "none"], cwd="/", capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (1, "plot-run.py: none/summary.json: No such file or directory\n"))
        scene = os.path.join(ROOT, "prm/smooth-rolling.prm")
        for given, words in ((scene, ", but a scene: roll it first, and name the folder of its results"), (os.path.join(ROOT, "README.md"), ": name that of a run")):
            result = subprocess.run([os.path.join(ROOT, "contrib/plot/plot-run.py"), given], cwd="/", capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stderr), (1, f"plot-run.py: {given} is no folder of results{words}\n"))

    def test_version_is_that_of_the_program(self):
        versions = []
        places = (("CMakeLists.txt", r"project\(tread VERSION (\S+)"), ("contrib/python/pyproject.toml", r'version = "(.+)"'),
                  ("CITATION.cff", r"^version: (\S+)"), ("CHANGELOG.md", r"^## \[([0-9.]+)\]"), ("doc/packages.md", r"tread_([0-9.]+)_amd64.deb"),
                  ("contrib/package/spack/packages/tread/package.py", r'^    version\("(.+)"\)'), ("contrib/package/conda/meta.yaml", r"^  version: (\S+)"))
        for path, pattern in places:
            with open(os.path.join(ROOT, path), encoding="utf-8") as stream:
                versions += re.findall(pattern, stream.read(), re.MULTILINE)[:1]
        self.assertEqual(versions, versions[:1] * len(places))

    def test_recipes_name_what_the_build_looks_for(self):
        def read(path):
            with open(os.path.join(ROOT, path), encoding="utf-8") as stream:
                return stream.read()

        options = set(re.findall(r"^(?:option|set)\((TREAD_\w+)", read("CMakeLists.txt") + read("contrib/package/CMakeLists.txt"), re.MULTILINE))
        for recipe in ("contrib/package/spack/packages/tread/package.py", "contrib/package/conda/meta.yaml", "contrib/package/Containerfile"):
            text = read(recipe)
            named = set(re.findall(r"TREAD_\w+", text))
            self.assertTrue(named and named <= options, f"{recipe}: {named - options}")
            if recipe.endswith(".py"):
                compile(text, recipe, "exec")
            if not recipe.endswith("Containerfile"):
                for needed in ("dealii", "fftw", "nlohmann", "cli11", "numpy"):
                    self.assertIn(needed, text)


@unittest.skipUnless(REAL_PROGRAM, "no program named")
class TheProgram(InFolder):
    COARSE = {"Mesh/Finest cell (mm)": 1.3, "Mesh/Fine half width (mm)": 9, "Motion/Rolled distance (mm)": 3, "Output/Write volume": False}

    def test_a_short_run(self):
        run = tread.run("smooth-rolling.prm", self.COARSE, output="short", program=REAL_PROGRAM)
        self.assertTrue(run.summary["completed"])
        self.assertEqual(float(run.parameters["Mesh/Finest cell (mm)"]), 1.3)
        # It has rolled a millimetre: the load holds, and the patch carries it.
        self.assertAlmostEqual(run.history["normal_force_N"][-1] / (14300 * 9.81), 1, delta=0.02)
        self.assertAlmostEqual((run.patch.pressure * run.patch.area).sum() / run.summary["normal_force_N"], 1, delta=0.02)

    def test_a_study_of_half_space_solutions(self):
        with mock.patch.dict(sys.modules, {"pandas": None}):
            for repetition in range(2):
                rows = tread.study("smooth-rolling.prm", {"Contact/Friction coefficient": [0.35, 0.5]}, figures=["creepage", "adhesion_share"], processes=2,
                                   output="study", command="reference", program=REAL_PROGRAM)
                self.assertEqual([row["state"] for row in rows], ["complete"] * 2)
                written = [os.path.getmtime(os.path.join(row["folder"], "summary.json")) for row in rows]
                self.assertEqual(written, before if repetition else written)  # the second call takes what is there
                before = written
        # The same traction takes less of more friction.
        self.assertLess(rows[1]["creepage"], rows[0]["creepage"])
        self.assertGreater(rows[1]["adhesion_share"], 1.5 * rows[0]["adhesion_share"])

    def test_its_own_folder_and_its_own_line(self):
        own, older = (tread.run("smooth-rolling.prm", {"Output/Directory": "own"}, program=REAL_PROGRAM, **asked) for asked in ({"command": "reference"}, {"options": ["--reference-only"]}))
        self.assertEqual(own.folder, older.folder)
        self.assertEqual(own.folder, "own-reference")
        with self.assertRaisesRegex(tread.ProgramError, "--shift-to"):
            tread.run("smooth-rolling.prm", {"Output/Directory": "own"}, command="reference", options=["--shift-to", "3"], program=REAL_PROGRAM)
        self.assertAlmostEqual(own.summary["traction_coefficient"], 0.3, delta=1e-4)
        for ranks in (1, 2):
            with self.assertRaises(tread.ProgramError) as caught:
                tread.run("smooth-rolling.prm", {"Contact/Friction coefficient": -1}, ranks=ranks, output="bad", program=REAL_PROGRAM)
            self.assertEqual(caught.exception.exit_code, 1)
            self.assertRegex(str(caught.exception), "^'Contact/Friction coefficient'")
        self.assertFalse(os.path.exists("bad"))


if __name__ == "__main__":
    unittest.main()
