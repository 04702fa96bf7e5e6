#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures that functions of the Python package return, against numbers that follow from what was put in by other ways than theirs.

unnoticed_figures.py tells which figures no test compares.
"""

import dataclasses
import math
import os
import sys
import tempfile
import time
import unittest
from types import SimpleNamespace
from unittest import mock

import numpy as np

from tread import blows, comparison, contact_cases, corrugation, creep_table, crossing_force, differences, flat_force, half_space, hertz, limits, low_strain, measured_runs, plots, rail_mesh, rolling_strip, schema, studies, subsurface, tables, vtu, wavelets
from tread.patches import Patch, read_contact
from tread.runs import ROOT, Run

try:
    from tread.pictures import contact_points, damage, impact, mesh, patch as patch_pictures, plastic, profile_wear
except ImportError:  # without matplotlib
    impact = None

FIELDS = ("pressure_MPa", "shear_x_MPa", "shear_y_MPa", "slip_x_m_per_s", "slip_y_m_per_s")


def ellipse(a=6., b=4., step=0.5, pressure=1000., shift=(0., 0.), factor=1.):
    """{column: values} of a patch on a grid: half an ellipsoid of pressure, shear stress of 0.3 and -0.1 of it, slip behind the middle."""
    x, y = (values.ravel() for values in np.meshgrid(np.arange(-a, a + step / 2, step), np.arange(-b, b + step / 2, step)))
    inside = (x / a) ** 2 + (y / b) ** 2 < 1 - 1e-9
    x, y = x[inside], y[inside]
    p = pressure * np.sqrt(1 - (x / a) ** 2 - (y / b) ** 2)
    slips = x < 0
    return {"x_mm": x + shift[0], "y_mm": y + shift[1], "pressure_MPa": p, "shear_x_MPa": 0.3 * factor * p, "shear_y_MPa": -0.1 * factor * p,
            "slip_x_m_per_s": -0.04 * factor * slips, "slip_y_m_per_s": 0.03 * factor * slips, "area_mm2": np.full(len(x), step * step) * (1 + 0.5 * slips),
            "state": np.where(slips, "slip", "adhesion")}


def patch_of(table):
    return Patch("patch.csv", dict(table), FIELDS)


def write_table(path, table):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(",".join(table) + "\n" + "".join(",".join(map(str, row)) + "\n" for row in zip(*table.values())))


class FlatForce(unittest.TestCase):
    """The simple model of a wheel with a flat, in limits that have closed forms."""

    LOAD, MASS, STIFFNESS = 1e5, 900., 1e11

    def rolled(self, track, height, speed, way):
        return flat_force.roll(track, height, speed, way, self.LOAD, self.MASS, self.STIFFNESS, 0., 5e-6)[:2]

    def test_a_mass_on_its_spring(self):
        # On a track that does not yield, over a support, after a step of 1 um: the linearised spring's cosine.
        rigid = flat_force.Track(young=1e16, spans=4, pad_stiffness=1e14, ballast_stiffness=1e14, pad_damping=0., ballast_damping=0.)
        step = 1e-6
        places, forces = self.rolled(rigid, lambda way: step if way > 0. else 0., 0.5, 5e-3)
        stiffness = 1.5 * self.STIFFNESS**(2 / 3) * self.LOAD**(1 / 3)
        expected = self.LOAD + stiffness * step * np.cos(math.sqrt(stiffness / self.MASS) * places / 0.5)
        np.testing.assert_allclose(forces, expected, atol=0.03 * stiffness * step)

    def test_long_steps_of_a_light_wheel(self):
        # The trapezoidal rule from rest after a step in height: with tan(turn) = w h/2 the force turns by 2 turn in each step of h.
        rigid = flat_force.Track(young=1e16, spans=4, pad_stiffness=1e14, ballast_stiffness=1e14, pad_damping=0., ballast_damping=0.)
        load, mass, height, step = 1e4, 5., 1e-8, 40e-6
        stiffness = 1.5 * self.STIFFNESS**(2 / 3) * load**(1 / 3)
        forces = flat_force.roll(rigid, lambda way: height if way > 0. else 0., 0.5, 1e-3, load, mass, self.STIFFNESS, 0., step)[1]
        turn = math.atan(0.5 * math.sqrt(stiffness / mass) * step)
        expected = math.cos(turn) * np.cos((2 * np.arange(1, len(forces) + 1) - 1) * turn)
        np.testing.assert_allclose((forces - load) / (stiffness * height), expected, atol=0.01)

    def test_a_smooth_wheel_keeps_its_load(self):
        places, forces = self.rolled(flat_force.Track(spans=16), lambda way: 0., 10., 0.1)
        self.assertAlmostEqual(places[-1], 0.1, delta=2e-4)
        np.testing.assert_allclose(forces, self.LOAD, rtol=0.02)

    def test_the_beam(self):
        # Cubics are exact between nodes; a cantilever's tip deflects by bending and shear.
        beam = flat_force.Beam(flat_force.Track(spans=2, elements=4))
        own, shape = beam.shape(0.4)
        x = np.repeat(beam.size * np.arange(beam.n), 2)
        # Sections of a beam with the deflection x^3 are turned by 3 x^2 and by what shear leaves, 6 E I/(kappa G A).
        sheared = 0.5 * beam.phi * beam.size**2
        cubic = np.where(np.arange(2 * beam.n) % 2 == 0, x**3, 3. * x**2 + sheared)
        self.assertAlmostEqual(shape @ cubic[own], 0.4**3, delta=1e-12)
        self.assertAlmostEqual(beam.turning(0.4) @ cubic[own], 3. * 0.4**2 + sheared, delta=1e-12)
        track = flat_force.Track(spans=2, elements=4)
        self.assertAlmostEqual(sheared / (6. * track.young * track.second_moment / (track.shear_factor * track.area * track.young / 2.56)), 1., delta=1e-12)
        track = flat_force.Track(spans=2, elements=4, pad_stiffness=0., ballast_stiffness=1.)
        beam = flat_force.Beam(track)
        free = slice(2, 2 * beam.n)
        force = np.zeros(2 * beam.n - 2)
        force[-2] = 1e3
        tip = np.linalg.solve(beam.stiffness[free, free], force)[-2]
        length, bending = 1.2, track.young * track.second_moment
        shear = track.shear_factor * track.area * track.young / (2. * (1. + track.poisson))
        self.assertAlmostEqual(tip / (1e3 * (length**3 / (3. * bending) + length / shear)), 1., delta=1e-6)
        # The mass of the rail, by a rigid motion, and of the sleeper.
        rigid = np.where(np.arange(2 * beam.n) % 2 == 0, 1., 0.)
        self.assertAlmostEqual(rigid @ beam.mass[:2 * beam.n, :2 * beam.n] @ rigid, 7800. * 76.70e-4 * 1.2, delta=1e-6)
        self.assertEqual(beam.mass[-1, -1], 200.)


class Blows(unittest.TestCase):
    def test_speed_and_way_in_the_air(self):
        self.assertAlmostEqual(blows.speed({"position_m": np.array([-0.3, 0.1, 0.5]), "time_s": np.array([0.01, 0.03, 0.09])}), 10.)
        places, forces = np.array([1., 2., 4., 7., 9.]), np.array([5., 0., 3., 0., -0.])
        self.assertAlmostEqual(blows.off_the_rail(places, forces), 1. + 3. + 2.)


class TrackOfBeam(unittest.TestCase):
    """Receptances and mobilities of the beam that half a span ends at planes of symmetry."""

    TRACK = flat_force.Track(spans=21, half_ends=True)

    def test_at_rest_a_rail_on_supports_is_a_rail_on_a_bed(self):
        track = flat_force.Track(spans=41, half_ends=True, shear_factor=100., pad_stiffness=60e6)
        bed = 1. / (1. / track.pad_stiffness + 1. / track.ballast_stiffness) / track.spacing
        beta = (bed / (4. * track.young * track.second_moment))**0.25
        found = flat_force.receptance(track, [0., 0.3], [1e-3])[:, 0]
        self.assertAlmostEqual(float(found.mean().real) / (beta / (2. * bed)), 1., delta=0.02)

    def test_a_long_bar_takes_waves_away(self):
        track = flat_force.Track(spans=60, half_ends=True, elements=2, absorbing=15.)
        found = flat_force.bar_mobility(track, [0.], np.arange(200., 1000., 10.)).mean()  # over what comes back from the ends
        self.assertAlmostEqual(found * 2. * track.area * math.sqrt(track.young * track.density), 1., delta=0.05)

    def test_between_planes_of_symmetry_a_bar_vibrates_with_half_a_wave(self):
        frequencies = np.arange(195., 215., 0.25)
        found = np.abs(flat_force.bar_mobility(self.TRACK, [0.], frequencies)[0])
        expected = math.sqrt(self.TRACK.young / self.TRACK.density) / (2. * self.TRACK.spans * self.TRACK.spacing)
        self.assertAlmostEqual(frequencies[found.argmax()] / expected, 1., delta=0.005)
        # Below it is a spring of both halves.
        half = self.TRACK.young * self.TRACK.area / (0.5 * self.TRACK.spans * self.TRACK.spacing)
        self.assertAlmostEqual(flat_force.bar_mobility(self.TRACK, [0.], [1.])[0, 0] / (2j * math.pi / (2. * half)), 1., delta=0.01)

    def test_endless_ends_of_a_bar_are_a_chain_of_springs(self):
        cells = flat_force.Track(spans=5, elements=2, half_ends=True, stiffness_along=30e6)
        track = cells.endless(8)
        self.assertEqual((track.spans, track.beyond), (21, 8))
        self.assertAlmostEqual(track.absorbing, 2.4)
        self.assertEqual(dataclasses.replace(track, spans=5, beyond=0, absorbing=0.), cells)
        axial = track.young * track.area
        stiffness = axial / (0.5 * track.spacing)  # to the plane of symmetry at the far end
        for support in range(8):
            stiffness += track.stiffness_along
            stiffness = 1. / (1. / stiffness + (track.spacing if support < 7 else 3. * track.spacing) / axial)  # the last one to the middle
        found = flat_force.bar_mobility(track, [0.], [1e-2])[0, 0] / (2j * math.pi * 1e-2)
        self.assertAlmostEqual(found * 2. * stiffness, 1., delta=1e-3)

    def test_a_section_turns_with_its_head(self):
        """A force along the head turns the section by its moment: the head moves by the square of its height."""
        track = flat_force.Track(spans=2, half_ends=True, pad_stiffness=1e3, ballast_stiffness=1e3, sleeper_mass=1., shear_factor=100.)
        # A moment in the middle of a beam whose ends do not turn: the slope is M L/(4 E I).
        length = track.spans * track.spacing
        found = flat_force.receptance(track, [0.5 * length - track.middle_support], [1e-2], turns=True)[0, 0].real
        self.assertAlmostEqual(found / (track.head**2 * length / (4. * track.young * track.second_moment)), 1., delta=0.02)

    def test_traction_moves_the_rail_along_itself(self):
        """On a rail that does not bend: backwards under a driving wheel, by the bar's mobility."""
        stiff = flat_force.Track(spans=8, pad_stiffness=1e13, ballast_stiffness=1e13, second_moment=10., shear_factor=100., half_ends=True, absorbing=1.5)
        places, force, along = flat_force.roll(stiff, lambda x: 1e-6 * math.sin(2. * math.pi * x / 0.05), 25., 0.5, 1e5, 1e9, 1e11, 0., 1e-5, traction=0.3)
        found = corrugation.Waves(0.2, np.array([4]), np.array([1.]))
        late = (places > 0.3) & (places <= 0.5)
        of_force, of_along = (found.found_in(places[late], values[late])[0] for values in (force, along))
        mobility = flat_force.bar_mobility(stiff, np.linspace(0.3, 0.5, 9), [500.]).mean()
        self.assertAlmostEqual(of_along / (-0.3 * mobility * of_force), 1., delta=0.1)

    def test_damped_ends(self):
        track = flat_force.Track(absorbing=2., spans=10)
        self.assertEqual([track.damping_rate(place) for place in (2., 3., 4.)], [0., 0., 0.])
        shear_speed = math.sqrt(track.young / (2. * (1. + track.poisson)) / track.density)
        for place, share in ((0., 1.), (1., 0.25), (6., 1.), (5.5, 0.5625)):
            self.assertAlmostEqual(track.damping_rate(place) / (6. * shear_speed / 2. * share), 1., delta=1e-12)

    def test_a_compliance_in_series_with_the_spring(self):
        """On a stiff rail: force over the height of a long wave that moves the wheel up and down slowly; and at rest."""
        stiff = flat_force.Track(pad_stiffness=1e13, ballast_stiffness=1e13, second_moment=1., shear_factor=100., spans=4)
        _, force, _ = flat_force.roll(stiff, lambda x: 1e-6 * math.sin(2. * math.pi * x / 0.05), 25., 0.05, 1e5, 1e9, 1e11, 0., 5e-6, compliance=1e-9)
        _, without, _ = flat_force.roll(stiff, lambda x: 1e-6 * math.sin(2. * math.pi * x / 0.05), 25., 0.05, 1e5, 1e9, 1e11, 0., 5e-6)
        soft = 2. / 3. * (1e5 / 1e11)**(2. / 3.) / 1e5
        self.assertAlmostEqual(np.ptp(without) / np.ptp(force), (soft + 1e-9) / soft, delta=0.01 * (soft + 1e-9) / soft)


class Corrugation(unittest.TestCase):
    """Waves, what wear does to them, and the linear model, against what was put in and closed forms."""

    def waves(self, *lengths_mm, period=0.6, amplitude=1e-6):
        orders = np.round(period / (1e-3 * np.array(lengths_mm))).astype(int)
        return corrugation.Waves(period, orders, amplitude * np.exp(1j * np.arange(1., len(orders) + 1.)))

    def test_waves_that_are_drawn_divide_the_period(self):
        waves = corrugation.Waves.draw(0.6, 0.02, 0.12, 0.4e-6, 3)
        self.assertEqual(list(waves.orders), list(range(5, 31)))
        np.testing.assert_allclose(np.abs(waves.amplitudes), 0.4e-6)
        np.testing.assert_allclose(waves.wavelengths[[0, -1]], [0.12, 0.02])
        self.assertGreater(np.ptp(np.angle(waves.amplitudes)), 3.)
        with self.assertRaises(corrugation.DataError):
            corrugation.Waves.draw(0.6, 0.5, 0.55, 1e-6)

    def test_waves_are_found_again(self):
        waves = self.waves(100., 24.)
        places = np.arange(-0.1, 0.9, 2.4e-3)
        values = 5. + 3e-6 * np.cos(2. * np.pi / 0.1 * places + 0.7) - 2e-6 * np.sin(2. * np.pi / 0.024 * places)
        way = corrugation.Way(waves, -0.2, 1.)
        np.testing.assert_allclose(way.found_in(places, values), [3e-6 * np.exp(0.7j), 2e-6j], rtol=1e-4)
        np.testing.assert_allclose(waves.heights(np.array([0.03])), 1e-6 * (math.cos(2. * math.pi * 0.3 + 1.) + math.cos(2. * math.pi * 1.25 + 2.)))
        with self.assertRaises(corrugation.DataError):
            way.found_in(places[::20], values[::20])
        with self.assertRaises(corrugation.DataError):
            way.found_in(places[:200], values[:200])

    def test_ramps(self):
        way = corrugation.Way(self.waves(100.), -0.2, 1.)
        np.testing.assert_allclose(way.share(np.array([-0.3, -0.2, -0.17, -0.14, 0.5, 0.94, 0.97, 1.2])), [0., 0., 0.5, 1., 1., 1., 0.5, 0.], atol=1e-12)
        np.testing.assert_allclose(way.heights(np.array([-0.17, 0.53])), 1e-6 * np.array([0.5 * math.cos(1. - 3.4 * math.pi), math.cos(1. + 10.6 * math.pi)]))

    def test_gain_of_two_runs(self):
        """Wear that is twice as deep in troughs as it swings on average, a quarter of a wave further on for the second wave."""
        waves = self.waves(100., 40.)
        way = corrugation.Way(waves, -0.2, 1.)
        with tempfile.TemporaryDirectory() as folder:
            for name, share in (("rough", 1.), ("smooth", 0.)):
                x = np.repeat(np.arange(-0.1, 0.8, 2.5e-3), 3)
                y = np.tile([-2.5, 0., 2.5], len(x) // 3)
                swing = np.real(waves.amplitudes[0] * -1e4 * np.exp(2j * np.pi * x / 0.1) + waves.amplitudes[1] * 2e4j * np.exp(2j * np.pi * x / 0.04))
                work = 300. * (1. + share * swing) * np.where(y == 0., 1., 0.5)
                write_table(os.path.join(folder, name, "rail_surface_damage.csv"), {
                    "x_mm": 1e3 * x, "y_mm": y, "friction_work_J_per_m2": work})
                at = np.arange(-0.1, 0.8, 1e-3)
                force = 1e5 + share * np.real(waves.amplitudes @ (1e9 * np.array([[2.], [3j]]) * np.exp(2j * np.pi * np.outer([10., 25.], at - 0.5e-3))))
                write_table(os.path.join(folder, name, "history.csv"), {"time_s": at / 25., "position_m": at, "normal_force_N": force})
            rough, smooth = Run(os.path.join(folder, "rough")), Run(os.path.join(folder, "smooth"))
            places, work = corrugation.work_along(smooth, 2.5e-3)
            np.testing.assert_allclose([len(places), work[7], corrugation.work_along(smooth, 1e-3)[1][7]], [360, 225., 270.])
            found = corrugation.gain_of_runs(way, rough, smooth, 2.5e-3)
        np.testing.assert_allclose(found.gain, [1e4, -2e4j], rtol=1e-3)
        np.testing.assert_allclose(found.force, [2e9, 3e9j], rtol=1e-3)

    def test_means_across(self):
        """A triangle over 4 mm, in the middle half of it, beyond it, and of two columns at once."""
        y, values = np.array([-2e-3, 0., 2e-3]), np.array([[0., 1.], [1., 1.], [0., 1.]])
        np.testing.assert_allclose(corrugation.mean_across(y, values, 1e-3), [0.75, 1.])
        np.testing.assert_allclose(corrugation.mean_across(y, values, 2e-3), [0.5, 1.])
        np.testing.assert_allclose(corrugation.mean_across(y, values, 4e-3), [0.25, 0.5], atol=0.03)

    def test_settings_and_the_file_of_waves(self):
        way = corrugation.Way(self.waves(100.), -0.2, 1.)
        with tempfile.TemporaryDirectory() as folder:
            settings = way.settings(os.path.join(folder, "waves.txt"))
            x, z = np.loadtxt(settings["Defect/Profile file"]).T
        self.assertEqual((settings["Defect/Position (mm)"], settings["Defect/Ramp (mm)"], settings["Defect/Lateral law"]), (-200., 60., "uniform"))
        np.testing.assert_allclose(z, 1e-3 * np.cos(2. * np.pi * (x - 200.) / 100. + 1.), atol=2e-9)

    CONTACT = corrugation.Contact(1.087, 1.667, 1e5, 0.3, -0.02, element=1e-3, half_width=12e-3)

    def test_full_slip_over_long_waves(self):
        """All slides: work is friction times load times creepage, on crests for longer: the patch moves more slowly than the wheel by the ratio of curvatures."""
        waves = self.waves(200., period=0.2)
        parts = corrugation.responses(self.CONTACT, waves)
        bent = (2. * math.pi / 0.2)**2
        load, creepage = parts["load"], parts["creepage"]
        # A long wave: 2 a is a sixteenth of it.
        self.assertAlmostEqual(load.work[0] * 1e5, 1., delta=0.06)
        self.assertAlmostEqual(creepage.work[0] * -0.02, 1., delta=0.06)
        self.assertAlmostEqual(load.longitudinal_force[0], 0.3, delta=3e-3)
        self.assertAlmostEqual(parts["heights"].work[0].real / (bent / (2. * 1.087)), 1., delta=0.1)
        self.assertAlmostEqual(-parts["heights"].approach[0].real, 1., delta=0.02)
        spring = 1.5 * self.CONTACT.stiffness**(2. / 3.) * 1e5**(1. / 3.)
        self.assertAlmostEqual(load.approach[0].real * spring, 1., delta=0.03)

    def test_gain_on_a_rail_that_does_not_move(self):
        """A heavy wheel stays where it is: the load swings with the height that the patch rides on."""
        waves = self.waves(50., period=0.1)
        stiff = flat_force.Track(pad_stiffness=1e13, ballast_stiffness=1e13, second_moment=1., shear_factor=100., area=1., spans=4)
        model = corrugation.Model(self.CONTACT, stiff, 25., 1e7, -0.1, 0.)
        way = corrugation.Way(waves, -0.08, 0.18)
        parts = corrugation.responses(self.CONTACT, waves)
        spring = 1.5 * self.CONTACT.stiffness**(2. / 3.) * 1e5**(1. / 3.)
        found = corrugation.gain_of_model(model, way, parts)
        self.assertAlmostEqual(found.force[0] / (-parts["heights"].approach[0] * spring), 1., delta=0.02)
        expected = -(parts["heights"].work[0] + parts["load"].work[0] * found.force[0])
        self.assertAlmostEqual(found.gain[0] / expected, 1., delta=0.01)
        np.testing.assert_allclose(corrugation.gain_at_rest(parts), -parts["heights"].work)

    def test_gain_on_a_rail_that_moves_along_itself(self):
        """Of a contact whose answers are given: what the rail's head moves along the rail is creepage; a force along the rail in proportion to the load adds nothing."""
        way = corrugation.Way(self.waves(50., period=0.1), -0.08, 0.18)
        model = corrugation.Model(self.CONTACT, flat_force.Track(spans=4, stiffness_along=40e6), 25., 300., -0.1, 0.)
        nothing, mobility = np.zeros(1, dtype=complex), model.mobility(way)

        def swing(load: float = 0., by_creepage: float = 0.) -> corrugation.Gain:
            force_along = {"heights": 0., "load": model.traction + load, "creepage": by_creepage}
            return corrugation.gain_of_model(model, way, {name: corrugation.Response(nothing - (name == "heights"), nothing + along, nothing + (name == "creepage"))
                                                          for name, along in force_along.items()})

        exact = 1e-7  # The contact is solved to 1e-15 m, of heights of a micrometre, and sums of vectors round by where these lie in memory.
        still, places = swing(), model.roll(way, lambda x: 0.)[0]
        rough, smooth = (model.roll(way, height) for height in (lambda x: float(way.heights(np.array(x))), lambda x: 0.))
        along = corrugation.difference(way, (places, rough[2]), (places, smooth[2]))[0] / way.waves.amplitudes
        self.assertGreater(abs(still.gain[0]), 0.)
        np.testing.assert_allclose(still.gain, along / model.speed, rtol=exact)
        self.assertGreater(abs(mobility[0] * 0.1 * still.force[0]), 0.05 * abs(along[0]))
        np.testing.assert_allclose(swing(load=0.1).gain, (along - mobility * 0.1 * still.force) / model.speed, rtol=exact)
        # A contact that answers to creepage holds the rail back.
        per_speed = -4e6 / model.speed
        np.testing.assert_allclose(swing(by_creepage=-4e6).gain, (along + mobility * per_speed * along / (1. - mobility * per_speed)) / model.speed, rtol=exact)

    def test_a_track_is_fitted(self):
        hidden = flat_force.Track(spans=5, elements=4, half_ends=True, absorbing=0.9, pad_stiffness=110e6, pad_damping=16e3, shear_factor=0.37)
        frequencies = np.arange(200., 1200., 100.)
        track, compliance, left = corrugation.fitted(flat_force.Track(spans=5, elements=4, half_ends=True, absorbing=0.9, pad_stiffness=120e6, pad_damping=20e3), [0., 0.3], frequencies,
                                                     flat_force.receptance(hidden, [0., 0.3], frequencies) + 0.2e-9)
        np.testing.assert_allclose([track.pad_stiffness, track.pad_damping, track.shear_factor, compliance], [110e6, 16e3, 0.37, 0.2e-9], rtol=1e-3)
        self.assertLess(left, 1e-4)


class HalfSpaceRoll(unittest.TestCase):
    """Rolling over a way, beside the library's steady rolling, and what it refuses."""

    EDGE = 1e-3  # across
    X, Y = 0.8e-3 * np.arange(-14, 15), EDGE * np.arange(-10, 11)
    CASE = {"gap": 1.087 * X**2 + 1.667 * Y[:, None]**2, "x_first": X[0], "y_first": Y[0], "element_x": 0.8e-3, "element_y": EDGE, "friction": 0.3}

    def test_indices_of_damage(self):
        answers = {"status": [0, 0, 1], "longitudinal_force": [30e3, 0., 1.], "lateral_force": [0., 40e3, 1.], "frictional_work": [700., 14000., 1.],
                   "area": [140e-6, 140e-6, 1.], "max_pressure": [900e6, 1200e6, 1.], "iterations": 0, "spin_moment": 0., "adhesion_share": 0., "approach": 0.}
        found = half_space.damage(answers, normal_force=100e3, shear_strength=[0., 300e6, 300e6])
        for name, wanted in (("friction_used", [0.3, 0.4, np.nan]), ("shakedown_load_factor", [np.nan, 4., np.nan]), ("surface_fatigue_index", [np.nan, 0.4 - 0.25, np.nan]),
                             ("t_gamma_per_area", [5e6, 100e6, np.nan]), ("regime_wear_rate", [26.5e-3, 1e-3 * (55.12 + 61.9 * 22.8), np.nan])):
            np.testing.assert_allclose(found[name], wanted, rtol=1e-12, err_msg=name)
        unsolved = half_space.damage(answers, normal_force=[100e3, 100e3, -1.], shear_strength=[np.nan, 300e6, 300e6])
        np.testing.assert_equal(unsolved["friction_used"][2], np.nan)
        np.testing.assert_allclose(unsolved["shakedown_load_factor"], [np.nan, 4., np.nan])
        for wrong in ({"normal_force": 0.}, {"normal_force": 100.}, {"normal_force": np.inf}, {"normal_force": np.nan}, {"normal_force": [100e3, 1e3, 100e3]},
                      {"normal_force": np.ma.masked_equal([100e3, 100e3, 7.], 7.)}, {"normal_force": 1e5, "shear_strength": -1.},
                      {"normal_force": 1e5, "shear_strength": 300.}, {"normal_force": 1e5, "shear_strength": np.inf}):
            with self.assertRaises(TypeError, msg=str(wrong)):
                half_space.damage(answers, **wrong)
        with self.assertRaisesRegex(TypeError, "lack area"):
            half_space.damage({name: value for name, value in answers.items() if name != "area"}, normal_force=1e5)

    def test_a_level_way_is_steady_rolling(self):
        for creepage in (-1e-3, -0.03):
            steady = half_space.solve_patch(normal_force=1e5, creepage=creepage, **self.CASE)
            rolled = half_space.roll(heights=np.zeros(30), normal_force=1e5, creepage=creepage, **self.CASE)
            np.testing.assert_allclose(rolled["approach"], steady["approach"], rtol=1e-6)
            np.testing.assert_allclose(rolled["longitudinal_force"], steady["longitudinal_force"], rtol=1e-3)
            self.assertEqual(rolled["work"].shape, (21, 30))
            self.assertAlmostEqual(self.EDGE * rolled["work"][:, 15].sum() / steady["frictional_work"], 1., delta=0.08)

    def test_load_and_creepage_may_change(self):
        load, creepage = np.linspace(0.9e5, 1.1e5, 20), np.full(20, -0.03)
        rolled = half_space.roll(normal_force=load, creepage=creepage, **self.CASE)
        np.testing.assert_allclose(rolled["longitudinal_force"], 0.3 * load, rtol=2e-3)
        raised = half_space.roll(heights=np.full(20, 5e-6), normal_force=load, creepage=-0.03, **self.CASE)
        np.testing.assert_allclose(raised["approach"], rolled["approach"] - 5e-6, rtol=1e-6)

    def test_what_is_refused(self):
        for words, error, settings in (("one length", TypeError, {"heights": np.zeros(3), "normal_force": np.ones(4)}),
                                       ("one length", TypeError, {"normal_force": 1e5}), ("heights", TypeError, {"heights": 0., "normal_force": np.ones(4)}),
                                       ("normal_force", half_space.HalfSpaceError, {"heights": np.zeros(3), "normal_force": -1.}),
                                       ("x_first", half_space.HalfSpaceError, {"heights": np.zeros(3), "normal_force": 1e5, "x_first": 0.1e-3}),
                                       ("numbers", TypeError, {"heights": np.zeros(3), "normal_force": 1e5, "friction": np.array([0.3, 0.2])}),
                                       ("curvature_x", TypeError, {"heights": np.zeros(3), "normal_force": 1e5, "curvature_x": 1.}),
                                       ("mm", half_space.HalfSpaceError, {"heights": np.array([0., 1., 0.]), "normal_force": 1e5}),
                                       ("creepage", half_space.HalfSpaceError, {"normal_force": 1e5, "creepage": np.full(3, 1e200)}),
                                       ("elements along", half_space.HalfSpaceError, {"heights": np.zeros(3), "normal_force": 3.}),
                                       ("masked", TypeError, {"heights": np.ma.masked_less(np.arange(3.), 1.), "normal_force": 1e5})):
            with self.assertRaisesRegex(error, words):
                half_space.roll(**{**self.CASE, "creepage": -1e-3, **settings})


class CrossingForce(unittest.TestCase):
    """A mass on a contact force at rest: one of a Hertz spring over a level way, and over one that rises."""
    LOAD, STIFFNESS, SLOPE = 60e3, 4e10, 5e-3  # N, N/m^1.5, -

    def force(self, slope):
        places, offsets = np.linspace(0., 0.1, 11), np.linspace(-0.3e-3, 0.3e-3, 601)
        sunk = (self.LOAD / self.STIFFNESS)**(2 / 3)
        row = self.STIFFNESS * np.maximum(0., sunk - offsets)**1.5
        return crossing_force.Force(places, slope * places, offsets, np.array([row] * len(places)))

    def test_the_force_is_that_of_its_table(self):
        force = self.force(self.SLOPE)
        sunk = (self.LOAD / self.STIFFNESS)**(2 / 3)
        self.assertAlmostEqual(force.height(0.034), self.SLOPE * 0.034, places=12)
        self.assertAlmostEqual(force(0.034, self.SLOPE * 0.034 - 30e-6) / (self.STIFFNESS * (sunk + 30e-6)**1.5), 1., places=6)
        self.assertEqual(force(0.034, self.SLOPE * 0.034 + 2. * sunk), 0.)

    def test_a_way_that_rises_evenly_leaves_the_load_as_it_is(self):
        for slope in (0., self.SLOPE):
            places, forces = crossing_force.pass_over(self.force(slope), crossing_force.Rail(), 10., 0.01, 0.09, self.LOAD, 600.)
            self.assertAlmostEqual(places[0], 0.01)
            self.assertAlmostEqual(places[-1], 0.09, places=3)
            np.testing.assert_allclose(forces, self.LOAD, rtol=1e-6)

    def test_a_kink_swings_the_mass_on_its_spring(self):
        # On a rail that does not move, linear for so small a kink: v0 sqrt(k m) more, after a quarter of a period.
        kink, speed, mass = 2e-4, 10., 600.
        force = self.force(0.)
        bent = crossing_force.Force(force.places, np.maximum(0., force.places - 0.02) * kink, force.offsets, force.forces)
        places, forces = crossing_force.pass_over(bent, crossing_force.Rail(1e9, 1e15, 0.), speed, 0.01, 0.09, self.LOAD, mass, 1e-6)
        spring = 1.5 * self.LOAD**(1 / 3) * self.STIFFNESS**(2 / 3)
        more = kink * speed * math.sqrt(spring * mass)
        self.assertAlmostEqual((forces.max() - self.LOAD) / more, 1., delta=0.03)
        self.assertAlmostEqual((places[forces.argmax()] - 0.02) / (speed * 0.5 * math.pi * math.sqrt(mass / spring)), 1., delta=0.02)


class InFolder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def close(self, computed, reference, relative=1e-9):
        np.testing.assert_allclose(computed, reference, rtol=relative, atol=1e-12)


class Patches(InFolder):
    def test_figures_of_a_patch(self):
        table = ellipse()
        patch = patch_of(table)
        self.close(patch.shear, math.sqrt(0.1) * table["pressure_MPa"])
        self.close(patch.slip[table["x_mm"] < 0], 0.05)
        behind, ahead = np.sum(table["x_mm"] < 0), np.sum(table["x_mm"] >= 0)
        self.close(patch.adhesion_share, ahead / (ahead + 1.5 * behind))

    @unittest.skipUnless(impact, "without matplotlib")
    def test_a_line_through_a_patch(self):
        patch = patch_of(ellipse())
        x, values = patch_pictures.axis_profile(patch, patch.pressure, 0.)
        self.close((x[0], x[-1]), (-6, 6))
        self.close(values, 1000 * np.sqrt(1 - (x / 6) ** 2))
        self.assertEqual(patch_pictures.dominant(patch), "x")

    @unittest.skipUnless(impact, "without matplotlib")
    def test_places_in_the_axes_of_a_patch(self):
        """A point 2 mm along a plane that rises by 0.3 rad, 1 mm above it, of each wheel; the other one's rail lies across the track."""
        c, s = math.cos(0.3), math.sin(0.3)
        own = {"wheel": "own", "y_m": 0.755, "y_rail_m": 0.005, "z_m": -0.001, "angle_rad": 0.3}
        table = {"y_mm": np.array([5 + 2 * c - s]), "z_mm": np.array([-1 + 2 * s + c])}
        self.close(patch_pictures.along_patch(table, own), [[2], [1]])
        other = {**own, "wheel": "other", "y_m": -0.757, "y_rail_m": 0.007}
        table["y_mm"] = np.array([-757 - 750 - (2 * c - s)])
        self.close(patch_pictures.along_patch(table, other), [[2], [1]])

    def test_beside_contact(self):
        """Figures of a run beside one whose tractions are 10 % larger and whose patch lies elsewhere."""
        own, other = ellipse(), ellipse(shift=(1.25, -0.5), pressure=1100.)
        write_table(self.path("run", "patch.csv"), own)
        write_table(self.path("run", "reference_patch.csv"), other)
        with open(self.path("run", "summary.json"), "w", encoding="utf-8") as stream:
            stream.write('{"reference": {"semi_axis_x_m": {"Hertz": {"value": 0.006}}, "semi_axis_y_m": {"Hertz": {"value": 0.004}}}}')
        self.close(comparison.hertz_axes({"reference": {"semi_axis_x_m": {"Hertz": {"value": 0.006}}, "semi_axis_y_m": {"Hertz": {"value": 0.004}}}}, None), (6, 4))
        found = comparison.compare(self.path("run"))
        p = own["pressure_MPa"]
        rms = 0.1 * math.sqrt(np.mean(p**2)) / (1.1 * p.max())
        for key, value in (("nodes_in_contact", len(p)), ("node_distance_mm", 0.5), ("max_pressure_MPa", 1000.), ("max_pressure_relative_difference", 1 / 1.1 - 1),
                           ("max_shear_MPa", 1000 * math.sqrt(0.1)), ("max_shear_relative_difference", 1 / 1.1 - 1), ("shift_x_mm", -1.25), ("shift_y_mm", 0.5),
                           ("max_slip_m_per_s", 0.05), ("pressure_rms_over_max", rms), ("shear_rms_over_max", rms),
                           ("adhesion_share", np.sum(own["x_mm"] >= 0) / (np.sum(own["x_mm"] >= 0) + 1.5 * np.sum(own["x_mm"] < 0)))):
            self.close(found[key], value, 1e-6)
        # Beside a patch that slips everywhere all that adheres is the difference.
        write_table(self.path("run", "reference_patch.csv"), {**other, "state": np.full(len(p), "slip")})
        self.close(comparison.compare(self.path("run"))["adhesion_share_difference_points"], 100. * found["adhesion_share"], 1e-6)

    def test_slip_beside_contact(self):
        """A third more slip, everywhere behind the middle."""
        own, other = ellipse(), ellipse(factor=0.75)
        write_table(self.path("run", "patch.csv"), own)
        write_table(self.path("run", "patch_averaged.csv"), ellipse(factor=1.5))
        write_table(self.path("run", "reference_patch.csv"), other)
        with open(self.path("run", "summary.json"), "w", encoding="utf-8") as stream:
            stream.write("{}")
        found = comparison.compare(self.path("run"))
        inside = (own["x_mm"] / 5.5) ** 2 + (own["y_mm"] / 3.5) ** 2 < 0.81
        share = math.sqrt(np.mean(own["x_mm"][inside] < 0))
        self.close(found["micro_slip_rms_over_max_instant"], 0.25 / 0.75 * share, 0.02)
        self.close(found["micro_slip_rms_over_max"], 0.75 / 0.75 * share, 0.02)
        self.close(found["max_slip_relative_difference"], 1., 1e-6)
        self.close(found["max_slip_m_per_s"], 0.075)

    def test_half_space_theory_on_fine_elements(self):
        """Forces, Hertz's pressure and CONTACT's fields, whose slip on elements of 0.1 mm is that of half an element ahead."""
        patch = low_strain.half_space_patch(29232., 0.3, element=0.2)
        self.close(patch.normal_force, 29232., 2e-4)
        self.close((patch.shear_x * patch.area).sum(), 0.3 * 29232., 3e-4)
        self.close(patch.pressure.max(), 308.3, 1e-3)
        contact = read_contact(os.path.join(ROOT, "contrib/contact-data/contact_F127_mu030_dx010.csv.gz"))
        inside = (contact.x / 7.76) ** 2 + (contact.y / 5.84) ** 2 < 0.9 ** 2
        for field, most in (("pressure", 0.003), ("shear_x", 0.014), ("slip_x", 0.013)):
            known = low_strain.LOW_STRAIN_LOAD * getattr(contact, field)
            off = (patch.sampled(field, contact.x, contact.y) - known)[inside]
            self.assertLess(np.sqrt(np.mean(off ** 2)) / abs(known).max(), most, field)

    def test_beside_half_space_theory(self):
        """Nodes whose tractions are the means of fine elements over 0.8 mm are nothing off; with 5 % more pressure they are by 5 % of it."""
        fine = low_strain.half_space_patch(29232., 0.3, element=0.2)
        x, y = (grid.ravel() for grid in np.meshgrid(np.arange(-8.8, 8.9, 0.8), np.arange(-7.2, 7.3, 0.8)))
        places = (np.arange(4) - 1.5) * 0.2
        means = {field: np.mean([fine.sampled(field, x + along, y + across) for along in places for across in places], axis=0) for field in fine.fields}
        inside = means["pressure"] > 0
        adhesion = np.hypot(means["slip_x"], means["slip_y"])[inside] == 0
        own = np.sqrt(np.mean(means["pressure"][inside] ** 2)) / fine.pressure.max()
        os.makedirs(self.path("run"))
        with open(self.path("run", "summary.json"), "w", encoding="utf-8") as stream:
            stream.write('{"normal_force_N": 29232.0, "traction_coefficient": 0.3}')
        for more in (1., 1.05):
            table = {"x_mm": x, "y_mm": y, **{name: more ** (name == FIELDS[0]) * means[field] for name, field in zip(FIELDS, fine.fields)}}
            write_table(self.path("run", "patch.csv"), {**{name: values[inside] for name, values in table.items()}, "state": np.where(adhesion, "adhesion", "slip")})
            found = low_strain.compare_with_half_space(self.path("run"), element=0.2)
            self.assertEqual(found, comparison.compare_fields(self.path("run"), fine))
            self.assertLess(abs(found["pressure_rms_over_max"] - (more - 1) * own), 0.0015)
            self.assertLess(found["shear_rms_over_max"], 0.002)
            self.assertLess(found["micro_slip_rms_over_max"], 0.018)  # at the nodes, not over their areas
            self.close(found["adhesion_share_difference_points"], 100 * (adhesion.mean() - fine.adhesion_share), 1e-9)

    def test_neighbours(self):
        """Of 3 x 2 nodes the one in the middle of a long side has all others, a corner three; a node that alone adheres is isolated."""
        table = {name: np.ones(6) for name in FIELDS} | {"x_mm": np.array([0., 1, 2, 0, 1, 2]), "y_mm": np.array([0., 0, 0, 1, 1, 1]), "state": np.full(6, "slip")}
        near = comparison.neighbours_in_contact(patch_of(table))
        self.assertEqual([sorted(one) for one in near[:2]], [[1, 3, 4], [0, 2, 3, 4, 5]])
        table["state"] = np.array(["slip"] * 4 + ["adhesion", "slip"])
        self.assertEqual(comparison.isolated_adhesion(patch_of(table)), 1)


class Runs(InFolder):
    def test_rows_of_two_runs(self):
        row = differences.row("work_J", 4., 5.)
        self.assertEqual((row["name"], row["a"], row["b"], row["difference"], row["relative_difference"]), ("work_J", 4., 5., 1., 0.25))
        self.assertEqual(differences.row("x", -4., 5.)["relative_difference"], 2.25)
        figures = differences.figures_of({"a": 2.5, "list": [{"b": 3}, {"b": 4}], "wall_s": 9., "yes": True, "word": "x", "deep": {"c": {"d": 5}}})
        self.assertEqual(figures, {"a": 2.5, "list/1/b": 3, "list/2/b": 4, "deep/c/d": 5})
        for name, value, factor in (("a", 2., 1.), ("b", 3., 1.2)):
            write_table(self.path(name, "patch.csv"), ellipse(pressure=1000 * factor))
            with open(self.path(name, "summary.json"), "w", encoding="utf-8") as stream:
                stream.write('{"work_J": %g, "list": [{"creepage": %g}]}' % (value, 10 * value))
        with mock.patch.dict(sys.modules, {"pandas": None}):
            rows = {row["name"]: row for row in differences.compare(self.path("a"), self.path("b"))}
        pressure = math.sqrt(np.mean(ellipse()["pressure_MPa"] ** 2))
        for name, a, b in (("work_J", 2., 3.), ("list/1/creepage", 20., 30.), ("patch_pressure_rms_MPa", pressure, 1.2 * pressure)):
            self.close((rows[name]["a"], rows[name]["b"]), (a, b), 1e-6)

    def test_costs(self):
        """A stand-in that takes 0.2 s and 64 MB."""
        program = self.path("stand-in")
        with open(program, "w", encoding="utf-8") as stream:
            stream.write("#!/usr/bin/python3\nimport json, sys, time\nkept = bytearray(64 << 20)\ntime.sleep(0.2)\n"
                         "open(sys.argv[sys.argv.index('--output') + 1] + '/summary.json', 'w').write(json.dumps({'completed': True, 'normal_force_N': 140e3}))\n")
        os.chmod(program, 0o755)
        start = time.monotonic()
        with mock.patch.object(measured_runs, "words_of", lambda arguments, ranks: [program, *arguments]), mock.patch("builtins.print"):
            summary = measured_runs.run_scene("smooth-rolling.prm", self.path("kept"))
        self.assertEqual(summary["normal_force_N"], 140e3)
        self.assertTrue(0.2 <= summary["seconds"] <= time.monotonic() - start)
        self.assertTrue(64 << 20 <= summary["peak_bytes"] < 1 << 30)  # before it starts it is as large as this process
        with mock.patch.object(os, "cpu_count", return_value=1):
            self.assertEqual(measured_runs.available_ranks(), 1)
        with mock.patch.object(os, "cpu_count", return_value=8):
            self.assertEqual(measured_runs.available_ranks(), 2)
        runs = {"a": lambda turn: {"seconds": [3., 1., 2.][turn], "turn": turn}, "b": lambda turn: {"seconds": [1., 4., 5.][turn], "turn": turn}}
        best = measured_runs.in_turn(3, runs)
        self.assertEqual((best["a"]["seconds"], best["b"]["seconds"]), (1., 1.))


    def test_times_of_a_summary(self):
        summary = {"wall_s": 100., "wall_s_start": 30., "wall_s_internal_forces": 1., "wall_s_contact": 2., "wall_s_communication": 4., "wall_s_nodes": 8.}
        self.assertEqual((measured_runs.steps_seconds(summary), measured_runs.rolling_seconds(summary)), (15., 70.))

    def test_lines_of_pages(self):
        self.assertEqual([tables.first_difference(*texts) for texts in (("a\nb", "a\nb"), ("a\nb", "a\nc"), ("a", "a\nb"))], [None, 2, 2])

    def test_rows_at_even_times(self):
        time, values, twice = wavelets.evenly_spaced(np.array([0., 1., 4.]), np.array([0., 10., 40.]), np.array([0., 20., 80.]))
        self.close((time, values, twice), ([0, 2, 4], [0, 20, 40], [0, 40, 80]))

    def test_power_at_a_frequency(self):
        """A single 1 among zeros: whatever the frequency, all of its power adds up to 1 (Morlet's wavelet has the norm 1), over the record's variance and
        the times between the cones of influence, each of which is sqrt(2) scales of 1.0330 / f wide (Torrence and Compo 1998, table 1)."""
        n, step = 8000, 1e-4
        values = np.zeros(n)
        values[n // 2 + 7] = 1.
        scalogram = wavelets.Scalogram(values, step, 100., 1500., per_octave=4)
        times = n - 2 * math.sqrt(2) * 1.0330 / (scalogram.frequency * step)
        self.close(scalogram.global_spectrum(), n / (times * (1 - 1 / n)), 5e-3)


class Studies(InFolder):
    def test_figures_of_a_run(self):
        """Each kind of figure, of a column whose largest, least and last entries are unlike."""
        write_table(self.path("history.csv"), {"position_m": [1., 2., 3., 4.], "force_N": [5., 9., -7., 6.]})
        write_table(self.path("strip.csv"), {"x_mm": [10., 20., 30.], "von_mises_MPa": [300., 700., 500.]})
        with open(self.path("summary.json"), "w", encoding="utf-8") as stream:
            stream.write('{"normal_force_N": 123.5, "count": 4}')
        with open(self.path("dynamic.json"), "w", encoding="utf-8") as stream:
            stream.write('{"forces": {"force_N": {"peak_N": -8.5, "oscillations": [{"frequency_Hz": 310.0}, {"frequency_Hz": 620.0}]}, "still_N": {"peak_N": 0, "oscillations": []}}}')
        run = Run(self.folder)
        member = SimpleNamespace(name="run", summary=run.summary, table=run.table, without_force="", path=run.path)
        for figure, value in (("normal_force_N", 123.5), ("max(force_N)", 9.), ("min(force_N)", -7.), ("last(force_N)", 6.), ("max(strip.csv:von_mises_MPa)", 700.),
                              ("min(strip.csv:von_mises_MPa)", 300.), ("at(strip.csv:von_mises_MPa:x_mm)", 20.), ("dynamic(force_N)", -8.5), ("frequency(force_N)", 310.)):
            self.assertEqual(studies.figure_of(member, figure), value, figure)
        nested = {"patches": [{"x_m": 1.}, {"x_m": 2.}], "reference": {"creepage": {"half-space": {"value": 3.}}}}
        self.assertEqual([studies.figure_in(nested, name) for name in ("patches/2/x_m", "reference/creepage/half-space/value", "patches/3/x_m", "patches/x_m", "reference/none/value")],
                         [2., 3., None, None, None])
        self.assertTrue(math.isnan(studies.figure_of(member, "frequency(still_N)")))

    def test_words_and_numbers(self):
        self.assertEqual([studies.number_or_text(text) for text in ("1", "1.0", "-2.5e-3", "predicted")], [1., 1., -0.0025, "predicted"])
        self.assertEqual([schema.edit_distance(*words) for words in (("Wheel", "wheel"), ("kitten", "sitting"), ("", "abc"), ("Finest", "Finst"))], [0, 3, 3, 1])

    def test_numbers_of_the_command_line(self):
        self.assertEqual([studies.natural(text) for text in ("1", "27")], [1, 27])
        whole, broken = (SimpleNamespace(state=state, name="run", summary={"normal_force_N": 3.5}) for state in (studies.COMPLETE, "failed"))
        self.assertEqual((studies.figure_or_none(whole, "normal_force_N"), studies.figure_or_none(broken, "normal_force_N")), (3.5, None))
        self.assertIsNone(studies.figure_or_none(whole, "force_N"))

    def test_where_a_limit_is_reached(self):
        """By the straight line between 20 and 30, at a quarter of the way."""
        self.assertEqual(limits.crossing([10, 20, 30, 40], [100., 150., 250., 260.], 175.), (30, 20, 22.5))
        self.assertEqual(limits.crossing([40, 10, 30, 20], [260., 100., None, 150.], 175.), (40, 20, None))


class ClosedForms(InFolder):
    def test_elliptic_integrals(self):
        """By Simpson's rule."""
        angle, step = np.linspace(0, math.pi / 2, 2001, retstep=True)
        weight = step / 3 * np.where(np.arange(2001) % 2, 4., 2.)
        weight[[0, -1]] = step / 3
        for m in (0.1, 0.5, 0.9):
            root = np.sqrt(1 - m * np.sin(angle) ** 2)
            self.close(hertz.elliptic(m), (np.sum(weight / root), np.sum(weight * root)), 1e-9)

    def test_spheres(self):
        """Johnson (1985), eq. 4.22 to 4.24, with 1/R = 2 A = 2 B."""
        force, modulus, curvature = 1e5, 115e9, 1.25
        radius = 0.5 / curvature
        a = (0.75 * force * radius / modulus) ** (1 / 3)
        self.close(hertz.semi_axes(curvature, 1., force, modulus), (a, a), 1e-6)
        self.close(hertz.approach(a, a, force, modulus), a * a / radius, 1e-6)
        self.close(hertz.force_of_approach(a, a, a * a / radius, modulus), force, 1e-6)
        self.close(hertz.curvatures(a, a, force, modulus), (curvature, curvature), 1e-6)
        self.close(hertz.semi_axis_of_approach(curvature, 1., a * a / radius), a, 1e-6)
        self.close(hertz.ratio_of_semi_axes(curvature, curvature), 1., 1e-5)

    def test_ellipses(self):
        """The pressure's own displacement: the gap closes in the middle and on both axes alike, by the integral of Johnson's eq. 3.38."""
        a, b, force, modulus = 6e-3, 2e-3, 1e5, 115e9
        in_x, in_y = hertz.curvatures(a, b, force, modulus)
        w = np.linspace(0., 1., 200001)[1:-1]
        # Substituted by t = (w / (1 - w))^2 a b.
        t, dt = a * b * (w / (1 - w)) ** 2, a * b * 2 * w / (1 - w) ** 3 * (w[1] - w[0])
        rest = np.sqrt((a * a + t) * (b * b + t) * t)
        scale = 0.75 * force / (math.pi * modulus)
        self.close(in_x, scale * np.sum(dt / ((a * a + t) * rest)), 1e-3)
        self.close(in_y, scale * np.sum(dt / ((b * b + t) * rest)), 1e-3)
        self.close(hertz.approach(a, b, force, modulus), scale * np.sum(dt / rest), 1e-3)
        self.close(hertz.ratio_of_semi_axes(in_x, in_y), 3., 1e-6)
        self.close(hertz.curvature_y(in_x, 3.), in_y, 1e-9)
        self.close(hertz.semi_axes(in_x, 3., force, modulus), (a, b), 1e-9)

    def test_von_mises_stress(self):
        """In a plane; in shear; of one more pressure all around, which has none."""
        self.close(subsurface.von_mises(np.array([300., 0, 0, 0, 0, 0])), 300.)
        for place in (3, 4, 5):
            self.close(subsurface.von_mises(100. * np.eye(6)[place]), 100. * math.sqrt(3))
        self.close(subsurface.von_mises(np.array([-170., -20, -70, 40, -10, 20])), math.sqrt(0.5 * (150**2 + 50**2 + 100**2) + 3 * (40**2 + 10**2 + 20**2)))

    def test_stress_below_a_circle(self):
        """Hertz's pressure over a circle, without friction: on the axis Johnson (1985), eq. 3.45, at the surface 3.43; the largest shear stress is
        0.310 of the pressure, 0.481 of the radius deep."""
        a, p0, nu = 6., 1000., 0.3
        below = subsurface.HalfSpace(patch_of(ellipse(a, a, 0.4, p0, factor=0.)), nu, parts=4)
        for depth in (0.1, 0.25, 0.481, 1., 2.):
            downwards = -p0 / (1 + depth**2)
            around = -p0 * ((1 + nu) * (1 - depth * math.atan(1 / depth)) - 0.5 / (1 + depth**2))
            stress = below.stress(0., 0., depth * a)
            np.testing.assert_allclose(stress, [around, around, downwards, 0, 0, 0], rtol=0, atol=0.006 * p0)
        np.testing.assert_allclose(below.stress(0., 0., 0.), [-(0.5 + nu) * p0, -(0.5 + nu) * p0, -p0, 0, 0, 0], rtol=0, atol=0.006 * p0)
        depths = np.linspace(0.3, 0.7, 21)
        on_axis = [subsurface.von_mises(below.stress(0., 0., depth * a)) for depth in depths]
        self.close(max(on_axis), 2 * 0.310 * p0, 5e-3)
        self.close(depths[int(np.argmax(on_axis))], 0.481, 0.05)
        self.close(below.largest_von_mises(0.481 * a), 2 * 0.310 * p0, 5e-3)

    def test_stress_below_shear_stress(self):
        """Beside the middle of an ellipse, by the point forces of Boussinesq and Cerruti (Johnson 1985, eq. 3.19 and 3.75): zz, zx and yz, which have no
        Poisson's ratio, and the sum of the three normal stresses. The rail bears the opposite of the shear stress on the wheel."""
        a, b, p0, nu = 6., 4., 1000., 0.27
        below = subsurface.HalfSpace(patch_of(ellipse(a, b, 0.25, p0)), nu, parts=2)
        radius, turn = (values.ravel() for values in np.meshgrid((np.arange(400) + 0.5) / 400, 2 * math.pi * np.arange(400) / 400))
        force = p0 * np.sqrt(1 - radius**2) * a * b * radius / 400 * 2 * math.pi / 400
        for x, y, depth in ((1.5, -1., 2.), (-4., 2., 3.), (7., 1., 1.5)):
            dx, dy = x - a * radius * np.cos(turn), y - b * radius * np.sin(turn)
            r = np.sqrt(dx**2 + dy**2 + depth**2)
            towards = force * (depth - 0.3 * dx + 0.1 * dy)
            xx, yy, zz, _, yz, zx = below.stress(x, y, depth)
            np.testing.assert_allclose((zz, yz, zx), [-1.5 / math.pi * np.sum(towards * depth * at / r**5) for at in (depth, dy, dx)], rtol=0.01, atol=0.3)
            self.close(xx + yy + zz, -(1 + nu) / math.pi * np.sum(towards / r**3), 0.01)

    def test_creep_table(self):
        """Its cases' curvatures give the table's semi-axes again."""
        cases, forces = creep_table.table_cases()
        modulus = 82e9 / (1 - 0.28)
        for row in (0, len(cases["curvature_x"]) // 2):
            ratio = hertz.ratio_of_semi_axes(cases["curvature_x"][row], cases["curvature_y"][row])
            a, b = hertz.semi_axes(cases["curvature_x"][row], ratio, 82000., modulus)
            self.close((7 * cases["element_x"][row], 7 * cases["element_y"][row]), (2 * a, 2 * b), 1e-5)
        answers = {"longitudinal_force": 0.3 * 82000. * (forces["longitudinal_force"] + np.eye(1, len(forces["longitudinal_force"]), 2)[0] * 0.25)}
        self.close(creep_table.beside_table(answers, cases, {"longitudinal_force": forces["longitudinal_force"]})["longitudinal_force"], 0.25, 1e-6)
        random, (a, b) = creep_table.random_cases(50)
        self.assertTrue(np.all((0.2 < a / b) & (a / b < 5.)))
        self.close(np.sqrt(a * b), 5e-3)
        self.assertEqual(len(random["creepage"]), 50)


@unittest.skipUnless(impact, "without matplotlib")
class Pictured(InFolder):
    def test_zimmermann(self):
        """Shares of many supports sum up to the whole force, and the largest is spacing over twice the length."""
        shares = [impact.zimmermann_share(0.6 * n + 0.13, 0.6, 0.8) for n in range(-40, 41)]
        self.close(sum(shares), 1., 2e-3)
        self.close(impact.zimmermann_share(0., 0.6, 0.8), 0.375)
        self.close(impact.zimmermann_share(-0.8 * math.pi * 0.75, 0.6, 0.8), 0., 1e-6)

    def test_forces_over_speed(self):
        """Contact, two pads and ballast of two runs, their spectra and peaks: each with a legend, and no frame is left empty."""
        def run(speed, supports):
            shares = {impact.CONTACT: 1.} | {f"support_{n}_{layer}_N": 0.1 * n for n in supports for layer in ("pad", "ballast")}
            forces = {name: share * speed * 1e3 * np.ones(3) for name, share in shares.items()}
            return SimpleNamespace(speed=speed, label=f"{speed:.0f} m/s", parameters={}, supports=lambda layer: supports,
                                   dynamic={"position_m": np.arange(3.), **forces}, spectrum={"frequency_Hz": np.arange(3.), **forces},
                                   figures={"forces": {name: {"peak_N": -force[0]} for name, force in forces.items()}, "window": "Hann", "resolution_Hz": 1.})
        for supports, labels in (([], ["contact"]), ([3, 4], ["contact", "pad 3", "pad 4", "ballast 4"])):
            figure = impact.draw_speeds([run(20., supports), run(10., supports)])
            legends = [[text.get_text() for text in axis.get_legend().get_texts()] for axis in figure.axes]
            of_runs = ["10 m/s", "20 m/s"]
            self.assertEqual(legends, [of_runs] * len(labels) + [[f"{label}, resolution 1 Hz" for label in of_runs], labels])
            self.close(figure.axes[-1].lines[0].get_xydata(), [[36., 10.], [72., 20.]])

    def test_lines_of_contact_points_are_broken_where_they_jump(self):
        table = {"lateral_shift_mm": np.array([0., 1., 2., 3.])} | {f"{side}_{place}_mm": np.array([0., 2., 4. + 10. * (side == "own"), 6. + 10. * (side == "own")])
                                                                  for side in ("own", "other") for place in ("y_wheel", "y_rail")}
        x, values = contact_points.broken(table, np.array([5., 6., 7., 8.]), ("own", "other"))
        np.testing.assert_allclose(x, [0, 1, np.nan, 2, 3])
        np.testing.assert_allclose(values, [5, 6, np.nan, 7, 8])
        self.assertEqual(len(contact_points.broken(table, np.arange(4.), ("other",))[0]), 4)

    def test_damage_of_one_side(self):
        table = {"y_mm": np.array([-1500., -1490., 3., 60.]), "friction_work_J_per_m2": np.array([5., 9., 8., 1.])}
        self.assertEqual(damage.near_the_most_loaded(table)["y_mm"].tolist(), [-1500., -1490.])
        table["friction_work_J_per_m2"][2] = 10.
        self.assertEqual(damage.near_the_most_loaded(table)["friction_work_J_per_m2"].tolist(), [10., 1.])

    def test_wear_is_drawn_larger(self):
        # A sixth of 36 mm is 6 mm.
        for depth, factor in ((0.0, 1), (0.05, 100), (0.07, 50), (0.5, 10), (2.0, 2), (9.0, 1)):
            self.assertEqual(profile_wear.exaggeration(depth, 36.0), factor)

    def test_mesh_of_a_bar(self):
        self.assertEqual(rail_mesh.even_lines(0., 10., 3.), [0., 2.5, 5., 7.5, 10.])
        bar = rail_mesh.bar([0., 1.], [-1., 1.], [-2., 0.], 0., hold_ends=(True, False))
        self.assertEqual(rail_mesh.named(bar), [(1, "contact"), (2, "support"), (3, "end")])
        for name, direction, place in (("contact", 2, 0.), ("support", 2, -2.), ("end", 0, 0.)):
            (cell, face), = bar.faces[name]
            numbers = rail_mesh.corners(bar, cell, face)
            self.assertEqual([bar.points[number - 1][direction] for number in numbers], 4 * [place])
            self.assertEqual(len(set(numbers)), 4)

    def test_damage_across_the_path(self):
        table = {"y_mm": np.array([1.02, 0.98, 2., 1.]), "work": np.array([3., 5., 7., 4.])}
        y, largest = damage.largest_across(table, "work")
        self.assertEqual((y.tolist(), largest.tolist()), ([1., 2.], [5., 7.]))

    def test_peaks(self):
        force = np.array([0., 5., 4., 4.5, 1., 3., 2., 2.9, 0.])
        self.assertEqual(impact.peaks(np.arange(9.), force, 1.), [1, 5])
        self.assertEqual(impact.peaks(np.arange(9.), force, 0.4), [1, 3, 5, 7])

    def test_cells_that_are_cut(self):
        """One cell from x = 1 to 3, whose far side is twice as wide, cut in its middle; its side on y = 0."""
        near, far = [(1., 0., 0.), (1., 1., 0.), (1., 1., 1.), (1., 0., 1.)], [(3., 0., 0.), (3., 2., 0.), (3., 2., 1.), (3., 0., 1.)]
        cell = np.array([[near[0], far[0], far[1], near[1], near[3], far[3], far[2], near[2]]])
        np.testing.assert_allclose(sorted(map(tuple, mesh.cut_across(cell, 2.)[0])), [(0, 0), (0, 1), (1.5, 0), (1.5, 1)])
        np.testing.assert_allclose(sorted(map(tuple, mesh.cut_along(cell, 0.5)[0])), [(1, 0), (1, 1), (3, 0), (3, 1)])
        self.assertEqual(len(mesh.cut_across(cell, 3.5)), 0)

    def test_tables_of_a_yielding_rail(self):
        write_table(self.path("patch.csv"), ellipse())
        x, y, z = (values.ravel() for values in np.meshgrid([-1., 0., 1.], [-0.25, 0.25], [-0.25, -0.75, -1.5]))
        write_table(self.path("rail_cells.csv"), {"x_mm": x, "y_mm": y, "z_mm": z, "von_mises_MPa": 100 + 10 * x - 40 * z + 5 * np.abs(y)})
        xs, ys = (values.ravel() for values in np.meshgrid([2., 1., 3.], [-1., 0., 1.]))
        write_table(self.path("rail_surface.csv"), {"x_mm": xs, "y_mm": ys, "u_z_um": -xs * (1 + ys)})
        tables = plastic.Tables(self.folder)
        at, values = tables.level(0.5, "von_mises_MPa")
        self.close((at, values), ([-1, 0, 1], [100 - 10 + 20 + 1.25, 100 + 20 + 1.25, 100 + 10 + 20 + 1.25]))
        self.close(tables.settlement(), ([1, 2, 3], [-1, -2, -3]))
        depth, values = tables.under(1., "von_mises_MPa")
        self.close((depth, values), ([0.25, 0.75, 1.5], [100 + 10 + 40 * d + 1.25 for d in (0.25, 0.75, 1.5)]), 1e-6)
        x, values = tables.along(tables.patch.pressure)
        self.close(values, 1000 * np.sqrt(1 - (x / 6) ** 2))
        y, values = tables.across(tables.patch.pressure, 0.)
        self.close(np.interp([-2., 1.], y, values), 1000 * np.sqrt(1 - (np.array([2., 1.]) / 4) ** 2), 1e-6)


class Areas(InFolder):
    def test_places_of_elements(self):
        area = contact_cases.area_between(4, 2, 6., 3.)
        self.assertEqual(len(area.x) * len(area.y), 8)
        self.close(np.diff(area.x), area.element_x)
        self.close(np.diff(area.y), area.element_y)
        self.close((area.x[0] + area.x[-1], area.y[0] + area.y[-1]), (0, 0))


class Read(InFolder):
    def test_vtu_in_letters(self):
        with open(self.path("one.vtu"), "w", encoding="utf-8") as stream:
            stream.write('<VTKFile><UnstructuredGrid><Piece><PointData><DataArray type="Float64" Name="p" format="ascii"> 1.5 2.5 </DataArray></PointData>'
                         '<Points><DataArray type="Float64" format="ascii"> 0.001 0.002 0.003 0.004 0.005 0.006 </DataArray></Points>'
                         '<Cells><DataArray type="Int32" Name="connectivity" format="ascii"> 1 0 </DataArray></Cells></Piece></UnstructuredGrid></VTKFile>')
        (points, cells, fields), = vtu.read_pieces(self.path("one.vtu"))
        self.close(points, [[1, 2, 3], [4, 5, 6]])
        self.assertEqual((cells.tolist(), fields["p"].tolist()), ([1, 0], [1.5, 2.5]))

    def test_passages_and_rows_that_are_shown(self):
        self.assertEqual([(part.start, part.stop) for part in plots.passages(np.array([1., 2., 3., 1., 2., 1.]))], [(0, 3), (3, 5), (5, 6)])
        dip = {"Defect/Shape": "dip", "Defect/Position (mm)": "20", "Defect/Length (mm)": "10"}
        shown = plots.shown_rows(np.arange(0., 61., 5.), dip)  # from a quarter of 40 mm before 20 mm on
        self.assertEqual(shown.tolist(), [x >= 10. for x in np.arange(0., 61., 5.)])


class RollingStrip(InFolder):
    def test_limits_of_a_line_contact(self):
        # Tresca's first yield, in the plane, is at 0.3 of the peak (Johnson 1985, 4.3); elastic shakedown at twice the largest shear stress along
        # the surface, a quarter of the peak, whatever the criterion (Johnson 1962).
        x, z = np.meshgrid(np.linspace(-1., 1., 41), np.linspace(0.02, 1.2, 60))
        xx, _, zz, xz = rolling_strip.line_contact_stress(x, z)
        self.assertAlmostEqual(np.hypot(0.5 * (xx - zz), xz).max(), 0.3, delta=1e-3)
        self.assertAlmostEqual(abs(xz).max(), 0.25, delta=1e-3)
        self.assertAlmostEqual(rolling_strip.shakedown_limit(depths=np.array([0.5])), 4., delta=2e-3)
        self.assertAlmostEqual(rolling_strip.first_yield(), 3.107, delta=1e-3)  # by the same stresses on the axis, at a depth of 0.70

    def test_elastic_stress_and_layers(self):
        strip = rolling_strip.strip_of(1., 60., 5, 210e3, length=60.)
        stress = strip.stress_of(strip.strain(strip.load(rolling_strip.hertzian(1., 1.), 0.3), np.zeros((4, *strip.shape)))).reshape(4, -1)
        near = (abs(strip.points_x) < 1.5) & (strip.points_z < 2.) & (strip.points_z > 0.4)
        exact = rolling_strip.line_contact_stress(strip.points_x[near], strip.points_z[near], 0.3)
        self.assertLess(abs(stress[:, near] - exact).max(), 0.02)  # of the peak pressure; held at a depth of 60 half widths
        # Plastic strains that are alike along x: the elements' answer is that of each layer for itself.
        layers = np.outer([1e-3, -4e-4, -6e-4, 0.], strip.points_z.reshape(strip.shape)[0] < 1.)
        of_elements = strip.unloaded_stress(np.repeat(layers[:, None, :], strip.shape[0], axis=1))[:, strip.shape[0] // 2]
        self.assertLess(abs(of_elements - strip.residual_stress(layers)).max(), 1e-6 * 210)

    def test_graded_lines(self):
        for sign in (1, -1):
            self.close(rolling_strip.graded(0.5 * sign, 4.14 * sign, 1.), sign * np.array([1.5, 2.7, 4.14]), 1e-12)

    def test_shakes_down_below_the_limit(self):
        strip = rolling_strip.strip_of(1., 8., 3, 210e3, length=6.)
        force, none = strip.load(rolling_strip.hertzian(1., 1000.)), np.zeros((4, strip.shape[1]))
        first, _ = strip.passage(force, none, np.zeros((4, *strip.shape)), 1000. * np.sqrt(3.) / 3.5, 23e3)
        self.close(abs(first[:, 0]).max(), 7.692e-4, 5e-3)  # regression
        later, _ = strip.passage(force, first[:, 0], first, 1000. * np.sqrt(3.) / 3.5, 23e3)
        self.assertLess(abs(later[:, 0] - first[:, 0]).max(), 0.1 * abs(first[:, 0]).max())
        self.assertLess(strip.residual_stress(first[:, 0])[:2].min(), -20.)


if __name__ == "__main__":
    unittest.main()
