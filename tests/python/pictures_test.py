#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of runs and the comparison of two runs, with runs that are written here.

    tests/python/pictures_test.py
"""

import base64
import csv
import glob
import json
import os
import re
import subprocess
import sys
import unittest
import zlib
from unittest import mock

import matplotlib
import h5py
import numpy as np

import tread
import package_test
from package_test import InFolder, write
from tread import plots
from tread.defects import extents_of_defects, profile_length
from tread.differences import other_bits
from tread.files import DataError
from tread.loads import static_load
from tread.pictures import contact_points, crossing, history, impact, mesh, patch, plastic, profiles
from tread.point_files import read_points
from tread.runs import ROOT
from tread.vtu import read_pieces

PATCH = "x_mm,y_mm,z_mm,area_mm2,pressure_MPa,shear_x_MPa,shear_y_MPa,slip_x_m_per_s,slip_y_m_per_s,state"


def patch_rows(scale=1.0):
    """Hertz's pressure on 6 by 4 mm, whose trailing third slips."""
    rows = []
    for x in np.arange(-6, 6.01, 0.5):
        for y in np.arange(-4, 4.01, 0.5):
            square = 1 - (x / 6) ** 2 - (y / 4) ** 2
            if square > 0:
                p, slips = 1000 * scale * np.sqrt(square), x < -2
                rows.append(f"{x},{y},0,0.25,{p},{0.3 * p if slips else 0.1 * p},{0.01 * p},{0.2 * scale if slips else 0},0,{'slip' if slips else 'adhesion'}")
    return rows


class OfRuns(InFolder):
    def write_run(self, name, summary=None, positions=np.arange(-100.0, 80.1, 1.0), passages=1, parameters="", scale=1.0):
        """A run whose normal force is 100 kN, and 1 kN more with each passage."""
        rows, time = [], 0.0
        for passage in range(passages):
            for x in positions:
                time += 1e-4
                rows.append(f"{time},{1e-3 * x},{1e3 * (100 + passage)},3e4,0,0.3,0.003,0,1,1,0.1,0.2,0,0.01,0.0001")
        write(self.path(name, "history.csv"), "time_s,position_m,normal_force_N,longitudinal_force_N,lateral_force_N,traction_coefficient,creepage,"
              "external_work_J,kinetic_energy_J,internal_energy_J,hourglass_energy_J,frictional_work_J,contact_loss_J,damping_work_J,energy_residual_J\n"
              + "\n".join(rows) + "\n")
        write(self.path(name, "patch.csv"), "\n".join([PATCH, *patch_rows(scale)]) + "\n")
        figures = {"completed": True, "normal_force_N": 1e5 * scale, "traction_coefficient": 0.3, "creepage": 0.003, "friction_coefficient": 0.3}
        write(self.path(name, "summary.json"), json.dumps({**figures, **(summary or {})}))
        write(self.path(name, "parameters.prm"), parameters)
        return tread.Run(self.path(name))


DYNAMIC = {"largest_normal_force_N": 151e3, "largest_normal_force_x_m": 0.012, "largest_normal_force_over_static": 1.51,
           "least_normal_force_N": 62e3, "least_normal_force_x_m": -0.03, "least_normal_force_over_static": 0.62}
TWO_DIPS = "subsection Defect\n set Shape = dip\n set Position (mm) = 20\n set Length (mm) = 30\n set Repeated at (mm) = 60\nend\n"


def spans(axis):
    """What is shaded over the abscissa."""
    return [(patch.get_xy()[:, 0].min(), patch.get_xy()[:, 0].max()) for patch in axis.patches if hasattr(patch, "get_xy") and np.ndim(patch.get_xy()) == 2]


class MeasuredProfiles(OfRuns):
    def test_points_as_other_programs_write_them(self):
        expected = [[-30, -1.5], [0, 0], [30, -1.25]]
        for name, content in (("blanks", b"# y z\n-30 -1.5\n0 0 remark, 3\n30 -1.25\n"), ("commas", b"y,z\n-30,-1.5\n0,0\n30,-1.25\n"),
                              ("german", "y;z\r\n-30,0;-1,5\r\n0,0;0,0\r\n30,0;-1,25\r\n".encode("utf-16")),
                              ("tabs", b"\xef\xbb\xbf-30,0\t-1,5\r0,0\t0,0\r30,0\t-1,25\r"), ("quotes", b'"-30" "-1.5"\n"0" "0"\n"30" "-1.25"\n')):
            with open(self.path(name), "wb") as stream:
                stream.write(content)
            self.assertEqual(read_points(self.path(name)).tolist(), expected, name)
        write(self.path("words"), "0 1\n2 deep\n")
        self.assertRaisesRegex(DataError, "line 2: needs two numbers", read_points, self.path("words"))
        write(self.path("map.csv"), "# of a squat\nx_mm,y_mm,z_mm\n0,-16,0.0\n")
        self.assertRaisesRegex(DataError, "map.csv, line 2: is a map of heights, .* and no profile", read_points, self.path("map.csv"))

    def test_a_depth_that_coarse_cells_do_not_have(self):
        run = mock.Mock(path=lambda name: name)
        for depths, found in (((0.5, 1.5, 2.5), [1.2]), ((0.5, 1.5), None), ((2., 6., 10.), None)):
            run.cells = {"x_mm": np.zeros(len(depths)), "y_mm": np.ones(len(depths)), "z_mm": -np.array(depths), "stress": np.array(depths) + 0.5}
            if found:
                self.assertEqual(np.round(plastic.Tables.level(run, 0.7, "stress")[1], 9).tolist(), found)
            else:
                self.assertRaisesRegex(DataError, "rail_cells.csv: no three layers of cells around a depth of 0.7 mm", plastic.Tables.level, run, 0.7, "stress")

    def test_length_of_a_german_map(self):
        write(self.path("map.csv"), '"x_mm";"y_mm";"z_mm"\n-2,5;0;0\n10;0;-0,1\n22,5;0;0\n')
        self.assertEqual(profile_length(self.path("map.csv")), 25)

    def test_change_by_smoothing(self):
        run = self.write_run("run")
        write(run.path("measured_rail.csv"), "line,y_mm,z_mm,measured_y_mm,measured_z_mm\n" + "".join(
            f"{i + 2},{y + 0.003 * (y == 1)},{2 * y + 0.001 * (y == 1)},{y},{2 * y}\n" for i, y in enumerate(range(-3, 4))))
        drawn = dict(profiles.figures(run))
        self.assertEqual(list(drawn), ["measured-rail"])
        change = drawn["measured-rail"].axes[1].lines[0].get_ydata()
        # (3, 1) um beside a line of slope 2: the part at right angles, which points up for (-2, 1).
        np.testing.assert_allclose(change, [0, 0, 0, 0, (1 - 6) / np.sqrt(5), 0, 0], atol=1e-9)
        self.assertIn("2.24", drawn["measured-rail"].axes[1].get_title())


class Pictures(OfRuns):
    def test_passages_break_lines(self):
        run = self.write_run("run", passages=3)
        figure = history.draw_forces(run)
        lines = [line for line in figure.axes[0].lines if line.get_color() == plots.BLUE]
        self.assertEqual(len(lines), 3)
        for passage, line in enumerate(lines):
            self.assertGreater(np.diff(line.get_xdata()).min(), 0)
            np.testing.assert_allclose(line.get_ydata(), 100 + passage)
        self.assertEqual([line.get_alpha() for line in lines], [1 / 3, 2 / 3, 1])
        self.assertIn("3 passages", figure.axes[0].get_title())
        self.assertEqual(plots.passages(np.array([1., 2., 2., 3.])), [slice(0, 4)])  # a wheel that stands still is no new one

    def test_defects_are_shaded_and_the_approach_is_cut(self):
        run = self.write_run("run", DYNAMIC, parameters=TWO_DIPS)
        figure = history.draw_forces(run)
        for axis in figure.axes:
            self.assertEqual(spans(axis), [(20, 50), (60, 90)])
        x = figure.axes[0].lines[0].get_xdata()
        self.assertEqual((x.min(), x.max()), (5, 80))  # from 20 to the end and a quarter of it before
        self.assertIn("history.csv begins at -100 mm", figure.axes[-1].get_xlabel())
        title = figure.axes[0].get_title()
        self.assertEqual(title, "largest normal force 151.0 kN with the wheel at 12.0 mm, 1.51 of the static load\n"
                                "least normal force 62.0 kN with the wheel at -30.0 mm, 0.62 of the static load")
        contact = impact.draw_contact_force(impact.Impact(run.folder))
        self.assertEqual(spans(contact.axes[0]), [(20, 50), (60, 90)])
        # A wheel that has not come to the defect is drawn on all its way.
        self.assertTrue(plots.shown_rows(np.arange(-100.0, 10.0), run.parameters).all())

    def test_where_defects_are(self):
        self.assertEqual(extents_of_defects({"Defect/Shape": "none", "Defect/Position (mm)": "0"}), [])
        write(self.path("map.csv"), "x_mm,y_mm,z_mm\n0,0,0\n40,0,0\n")
        map_of = {"Defect/Shape": "map", "Defect/Position (mm)": "-5", "Defect/Length (mm)": "0", "Defect/Profile file": "map.csv"}
        self.assertEqual(extents_of_defects(map_of), [(-5, 35)])
        self.assertEqual(extents_of_defects({**map_of, "Defect/Profile file": "none", "Defect/Repeated at (mm)": "100"}), [(-5, None), (100, None)])
        with h5py.File(self.path("map.h5"), "w") as stream:
            stream["x_mm"] = [2., 12., 22.]
        self.assertEqual(extents_of_defects({**map_of, "Defect/Profile file": self.path("map.h5")}), [(-5, 15)])

    def test_static_load_is_that_of_the_scene(self):
        """Whatever parameter sets it; the masses that it makes void are not added."""
        masses = "subsection Wheel\n set Mass (kg) = 900\nend\nsubsection Vehicle\n set Sprung mass (kg) = 13400\n set Gravity (m per s2) = 9.8\n"
        for more, load in ((" set Wheel load (kN) = masses\n set Axle load (t) = none\n", 140.14), (" set Wheel load (kN) = 123.45\n", 123.45),
                           (" set Wheel load (kN) = masses\n set Axle load (t) = 22.6\n", 110.74)):
            run = self.write_run("run", DYNAMIC, parameters=masses + more + "end\n")
            self.assertAlmostEqual(static_load(run.parameters), load)
            for figure in (history.draw_forces(run), impact.draw_contact_force(impact.Impact(run.folder))):
                drawn = [line for line in figure.axes[0].lines if str(line.get_label()).startswith("static load")]
                self.assertEqual(len(drawn), 1)
                self.assertAlmostEqual(drawn[0].get_ydata()[0], load)
                self.assertIn(f"static load {load:.1f} kN", drawn[0].get_label())
        self.assertIsNone(static_load(self.write_run("run", DYNAMIC).parameters))

    def test_section_is_cut_where_the_wheel_stands(self):
        def box(x, y, z, size):
            return np.array([(i, j, k) for i, j, k in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))]) * size + (x, y - 0.5 * size, z)

        # Fine cells of the rail at -40 mm, and a wheel of 300 mm radius that touches it at 210 mm.
        rail = np.array([box(x, 0, -20, 20) for x in range(0, 400, 20)] + [box(-40, 0, -2, 2)], float)
        x = np.arange(110, 310, 4.0)
        wheel = np.array([box(at, 0, 300 - np.sqrt(300 ** 2 - (at + 2 - 210) ** 2), 4) for at in x])
        self.assertAlmostEqual(mesh.under_wheel(rail, wheel), 210, delta=4)
        figure = mesh.draw_section(rail, wheel)
        self.assertIn("under the axle", figure.axes[0].get_title())
        lowest = min(path.vertices[:, 1].min() for path in figure.axes[0].collections[1].get_paths())
        self.assertLess(lowest, 0.1)  # on the rail, not above it

    def test_path_is_cut_where_the_wheel_runs(self):
        """Along y = 6 mm, where a layer below the surface has ends of its own, and no further than the way."""
        def box(x, y, z, size):
            corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)
            return corners * size + (x, y, z)

        rail = np.array([box(x, y, -10, (20, 10, 10)) for x in range(-400, 400, 20) for y in (-10, 0)]
                        + [box(x, 0, -20, (30, 10, 10)) for x in range(-400, 380, 30)])
        rail[:, 4:, 2] -= 0.002 * rail[:, 4:, 1]  # falls across: 12 um at y = 6 mm
        run = self.write_run("run", {"first_contact_y_m": 6e-3})  # from -100 to 80 mm
        cut = mesh.cut_along(rail, 6.0)
        self.assertEqual(len(cut), 40 + 26)
        np.testing.assert_allclose(mesh.top_edges(cut)[:, :, 1], -0.012)
        self.assertEqual(len(mesh.top_edges(cut)), 40)
        figure = mesh.draw_path(run, rail)
        self.assertEqual(figure.axes[0].get_xlim(), (-150, 130))
        self.assertIn("y = 6.0 mm", figure.axes[0].get_title())
        self.assertTrue(all(abs(np.asarray(line.get_ydata())).max() < 1e-9 for line in figure.axes[1].lines))
        low, high = figure.axes[1].get_ylim()
        self.assertLess(high - low, 5)

    def test_round_off_is_no_event(self):
        """Depths from the surface on; a force or a stress that differs in its last digits is a straight line."""
        run = self.write_run("run", DYNAMIC, parameters="subsection Defect\n set Shape = none\nend\n")
        x = np.arange(-50, 51.0)
        rows = [f"{at},{600 + 1e-7 * at},{3.005 + 1e-5 * np.sin(at)},{400 + 1e-7 * at},0" for at in x]
        write(self.path("run", "strip.csv"), "x_mm,von_mises_MPa,depth_mm,surface_von_mises_MPa,equivalent_plastic_strain_percent\n" + "\n".join(rows) + "\n")
        figure = impact.draw_strip(impact.Impact(run.folder))
        stress, depth = (axis.get_ylim() for axis in figure.axes[:2])
        self.assertEqual(depth[1], 0)
        self.assertTrue(3.005 < depth[0] < 4)
        self.assertGreater(stress[1] - stress[0], 100)
        force = impact.draw_contact_force(impact.Impact(run.folder)).axes[0].get_ylim()
        self.assertGreater(force[1] - force[0], 1)
        _, axis = plots.subplots(figsize=(2, 2))
        axis.plot(x, 5 + 1e-9 * x)
        plots.at_least_high(axis, 0.02)
        np.testing.assert_allclose(axis.get_ylim(), (4.95, 5.05), atol=1e-6)
        axis.plot(x, x)
        low, high = axis.get_ylim()
        plots.at_least_high(axis, 0.02)
        self.assertEqual(axis.get_ylim(), (low, high))
        self.assertFalse(plots.STYLE["axes.formatter.useoffset"])

    def test_patch_of_a_dynamic_run_stands_beside_hertz_at_its_own_load(self):
        force = 1e-3 * 0.25 * sum(float(row.split(",")[4]) for row in patch_rows())
        reference = {"semi_axis_x_m": {"Hertz": {"value": 6e-3}}, "semi_axis_y_m": {"Hertz": {"value": 4e-3}}, "max_pressure_Pa": {"Hertz": {"value": 1e9}}}
        steady = self.write_run("steady", {"reference": reference})
        run = self.write_run("run", {**DYNAMIC, "normal_force_N": 8e3 * force, "reference": reference})
        pictured = patch.Pictured(run, None)
        np.testing.assert_allclose(pictured.hertz, (3, 2, 500))  # of an eighth of the load
        self.assertEqual(pictured.hertz_label, f"Hertz at {force:.1f} kN")
        self.assertIn(f"normal force {force:.1f} kN", pictured.title)
        self.assertEqual(patch.Pictured(steady, None).hertz_label, "Hertz")
        # Micro-slip of 0.2 m/s fills its axis, beside shear stress of 300 MPa.
        low, high = patch.draw_axis(pictured).axes[2].get_ylim()
        self.assertTrue(-0.1 < low < 0 and 0.2 < high < 0.3, f"micro-slip is drawn from {low} to {high} m/s")

    def test_one_call_draws_what_is_there(self):
        run = self.write_run("run")
        style = dict(matplotlib.rcParams)
        paths = run.pictures()
        self.assertEqual(paths, [self.path("run", "pictures", f"{name}.png") for name in ("axis", "map", "vectors", "forces", "energies")])
        self.assertEqual(dict(matplotlib.rcParams), style)
        os.remove(self.path("run", "history.csv"))
        self.assertEqual([os.path.basename(path) for path in tread.Run("run").pictures("elsewhere")], ["axis.png", "map.png", "vectors.png"])
        self.assertEqual(sorted(os.listdir("elsewhere")), ["axis.png", "map.png", "vectors.png"])
        dynamic = self.write_run("dynamic", DYNAMIC, parameters=TWO_DIPS)
        self.assertIn(self.path("dynamic", "pictures", "contact-force.png"), dynamic.pictures())

    def test_without_matplotlib(self):
        self.write_run("run")
        write(self.path("without", "matplotlib", "__init__.py"), "raise ImportError\n")
        for command in ("plot-run.py", "plot-peaks.py"):  # which ask for it late, and at once
            result = subprocess.run([os.path.join(ROOT, "contrib", "plot", command), "run"], env={**os.environ, "PYTHONPATH": self.path("without")},
                                    capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1))
            self.assertRegex(result.stderr, f"^{command}: pictures need matplotlib")

    def test_bodies_and_sides_are_named(self):
        corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)
        cell = (corners - (0, 0.5, 0))[None] * 10
        figure = mesh.draw_section(cell - (0, 0, 10), cell)
        texts = [text.get_text() for text in figure.axes[0].texts]
        self.assertEqual(texts[:2], ["rail", "wheel"])
        self.assertTrue("gauge side" in texts[2] and "field side" in texts[3])
        (left, _), (right, _) = (text.get_position() for text in figure.axes[0].texts[2:])
        self.assertLess(left, right)  # the flange is at y < 0
        self.assertLess(figure.axes[0].texts[0].get_position()[1], figure.axes[0].texts[1].get_position()[1])
        np.testing.assert_allclose(mesh.cut_across(cell, 5.0)[0], [(-5, 0), (5, 0), (5, 10), (-5, 10)])

    def test_files_for_paraview(self):
        def packed(values):
            data = zlib.compress(values.tobytes())
            header = np.array([1, values.nbytes, values.nbytes, len(data)], np.uint32).tobytes()
            return (base64.b64encode(header) + base64.b64encode(data)).decode()

        points, pressure = np.arange(6, dtype=np.float32).reshape(2, 3), np.array([5, 7], np.float32)
        write(self.path("one.vtu"), '<VTKFile><UnstructuredGrid><Piece NumberOfPoints="2"><Points><DataArray type="Float32" format="binary">'
              f'{packed(points)}</DataArray></Points><Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1</DataArray></Cells>'
              f'<PointData><DataArray type="Float32" Name="pressure_MPa" format="binary">{packed(pressure)}</DataArray></PointData></Piece>'
              "</UnstructuredGrid></VTKFile>")
        (found, cells, fields), = read_pieces("one.vtu")
        np.testing.assert_array_equal(found, 1e3 * points)
        self.assertEqual((cells.tolist(), fields["pressure_MPa"].tolist()), ([0, 1], [5, 7]))
        with self.assertRaisesRegex(tread.DataError, "none.vtu: No such file"):
            list(read_pieces("none.vtu"))


    def test_slip_over_a_defect(self):
        of_defect = package_test.Crossings("write_run")
        of_defect.folder = self.folder
        of_defect.write_run("run", np.arange(-12, 22.1, 0.5), 0.25)
        axes = crossing.draw_slip(crossing.Crossing(tread.Run(self.path("run")))).axes
        # The rows of nodes end at 3.75 mm, and their cells an eighth of a millimetre farther: as much again is left free, and a twentieth.
        np.testing.assert_allclose(axes[0].get_ylim(), (-1.05 * 4, 1.05 * 4), rtol=1e-12)
        # Its nodes lie from 5.5 mm behind the wheel on, and all of them are to be more than one of 0.5 mm behind the defect's end at 10 mm.
        whens = [axis.get_title().split("\n") for axis in axes]
        self.assertEqual([lines[1].split(",")[0] for lines in whens if lines[0] == "behind the defect"], ["wheel at 16.50 mm"])
        self.assertEqual([lines[1].split(",")[0] for lines in whens if lines[0] == "before the defect"], ["wheel at -6.50 mm"])
        self.assertEqual([lines[1].split(",")[0] for lines in whens if lines[0] == "over the middle"], ["wheel at 5.00 mm"])

    def test_contacts_on_the_rail_of_a_track(self):
        run = self.write_run("run")
        write(run.path("contact_points.csv"), "lateral_shift_mm,own_y_rail_mm\n-2,1.5\n0,0.5\n3,-4\n")
        write(run.path("rail_profile.csv"), "y_rail_mm,z_mm\n5,-0.5\n0,0\n-5,-1\n-10,-2\n")
        write(run.path("wheel_profile.csv"), "y_rail_mm,z_mm\n6,0.5\n0,0.1\n-6,0.25\n")
        axis = contact_points.draw_profiles(run).axes[0]
        np.testing.assert_allclose(axis.collections[0].get_offsets(), [(1.5, -0.15), (0.5, -0.05), (-4, -0.8)], rtol=1e-12)
        np.testing.assert_allclose(axis.collections[0].get_array(), [-2, 0, 3])
        np.testing.assert_allclose(axis.lines[1].get_xydata(), [(6, 0.5), (0, 0.1), (-6, 0.25)])


class Patches(OfRuns):
    def test_patches_on_the_way(self):
        run = self.write_run("run")
        rows = [f"{1e-3 * position},{position},{row}" for position in (-20, 10) for row in patch_rows()]
        write(self.path("run", "patches.csv"), "\n".join([f"time_s,position_mm,{PATCH}", *rows]) + "\n")
        self.assertEqual([(instant.time_s, instant.position_mm) for instant in run.patches], [(-0.02, -20), (0.01, 10)])
        np.testing.assert_allclose(run.patches[1].patch.x, run.patch.x + 10)  # along the rail
        self.assertEqual((run.patch.units["pressure"], run.patch.units["slip_x"]), ("MPa", "m/s"))


class Comparison(OfRuns):
    def rows(self, a, b):
        with mock.patch.dict(sys.modules, {"pandas": None}):
            return {row["name"]: row for row in tread.compare(a, b)}

    def test_equal_runs(self):
        a = self.write_run("a", {"wall_s": 1.0, "patches_like": [{"force_N": 2.0}], "reference": {"creepage": {"value": 3.0}}})
        self.write_run("b", {"wall_s": 2.0, "patches_like": [{"force_N": 2.0}], "reference": {"creepage": {"value": 4.0}}})
        rows = self.rows(a, "b")
        self.assertEqual({row["difference"] for row in rows.values()}, {0})
        self.assertIn("patches_like/1/force_N", rows)
        self.assertFalse([name for name in rows if name.startswith(("wall_s", "reference", "completed"))])
        self.assertTrue({"patch_pressure_rms_MPa", "patch_shear_x_rms_MPa", "patch_slip_x_rms_m_per_s"} <= set(rows))

    def test_checksums_are_no_figures(self):
        a, b = (self.write_run(name, {"history_crc32": value, "files": [{"sha256": value, "bytes": 10 + value}]}) for name, value in (("a", 1), ("b", 3)))
        rows = self.rows(a, b)
        self.assertEqual([name for name in rows if "crc" in name or "sha" in name], [])
        self.assertIn("files/1/bytes", rows)
        self.assertIn("history_crc32", other_bits(a, b))  # but other bits are other bits

    def test_what_was_put_in_comes_out(self):
        a, b = self.write_run("a", {"zero": 0.0}), self.write_run("b", {"zero": 0.5}, scale=1.1)
        rows = self.rows(a, b)
        self.assertAlmostEqual(rows["normal_force_N"]["difference"], 1e4)
        for name in ("normal_force_N", "patch_pressure_rms_MPa", "patch_shear_x_rms_MPa", "patch_shear_y_rms_MPa", "patch_slip_x_rms_m_per_s"):
            self.assertAlmostEqual(rows[name]["relative_difference"], 0.1, msg=name)
        self.assertEqual(rows["creepage"]["difference"], 0)
        self.assertEqual((rows["zero"]["difference"], rows["zero"]["relative_difference"]), (0.5, None))

    def test_other_bits(self):
        last_bit = float(np.nextafter(2.0, 3.0))
        a = self.write_run("a", {"wall_s": 1.0, "ranks": 1, "work_J": 2.0})
        b = self.write_run("b", {"wall_s": 2.0, "ranks": 3, "work_J": 2.0})
        self.assertEqual(other_bits(a, b), [])
        self.write_run("c", {"work_J": last_bit, "more_J": 1.0})
        with open(self.path("c", "patch.csv"), "a", encoding="utf-8") as stream:
            stream.write("\n")
        os.remove(self.path("c", "history.csv"))
        self.assertEqual(other_bits(a, tread.Run("c")), ["history.csv", "patch.csv", "more_J", "work_J"])

    def test_the_command(self):
        self.write_run("a"), self.write_run("b", scale=1.1)
        result = subprocess.run([os.path.join(ROOT, "contrib", "compare-runs.py"), "a", "b", "--above", "5", "--csv", "differences.csv"],
                                capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, r"normal_force_N +100000 +110000 +1e\+04 +\+10\.00 %")
        self.assertNotIn("creepage", result.stdout)
        with open("differences.csv", encoding="utf-8") as stream:
            self.assertIn("creepage", [row["name"] for row in csv.DictReader(stream)])
        result = subprocess.run([os.path.join(ROOT, "contrib", "compare-runs.py"), "a", "none"], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (1, "compare-runs.py: none/summary.json: No such file or directory\n"))


class Installation(unittest.TestCase):
    def test_commands_are_listed(self):
        """Those of contrib/ that are one call of the package: by pip and beside the program."""
        with open(os.path.join(ROOT, "contrib/python/pyproject.toml"), encoding="utf-8") as stream:
            project = stream.read()
        with open(os.path.join(ROOT, "contrib/package/CMakeLists.txt"), encoding="utf-8") as stream:
            beside = re.search(r"foreach\(command ([^)]+)\)", stream.read())[1].split()
        listed = dict(re.findall(r'^tread-(\S+) = "(\S+):command_line"$', project, re.MULTILINE))
        commands = {}
        for path in glob.glob(os.path.join(ROOT, "contrib", "*.py")):
            with open(path, encoding="utf-8") as stream:
                found = re.search(r"^from (\S+) import command_line$", stream.read(), re.MULTILINE)
            if found:
                commands[os.path.basename(path)[:-3]] = found[1]
        self.assertGreater(len(commands), 3)
        self.assertEqual(commands, listed)
        self.assertEqual(sorted(commands), sorted(beside))
        packages = {os.path.relpath(os.path.dirname(path), os.path.join(ROOT, "contrib/python")).replace(os.sep, ".")
                    for path in glob.glob(os.path.join(ROOT, "contrib/python/tread/**/__init__.py"), recursive=True)}
        self.assertEqual(set(re.findall(r'"([^"]+)"', re.search(r"^packages = \[(.*)\]", project, re.MULTILINE)[1])), packages)


if __name__ == "__main__":
    unittest.main()
