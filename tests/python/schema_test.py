#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The JSON schema of parameters, scenes checked against it, and completion in bash.

    tests/python/schema_test.py [build/source/tread]
"""

import glob
import json
import os
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

from loaded_once import execute_often
from tread import schema
from tread.files import parameters_in
from tread.runs import ROOT

PROGRAM = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 and os.path.isfile(sys.argv[1]) else None
COMPLETION = os.path.join(ROOT, "contrib/completion/tread.bash")
CHECK = os.path.join(ROOT, "contrib/check-scene.py")


class Words(unittest.TestCase):
    def test_values(self):
        number, whole = {"type": "number", "minimum": 0, "maximum": 2}, {"type": "integer", "minimum": 1, "maximum": 3}
        word = {"anyOf": [{"const": "masses"}, {"type": "number", "minimum": 0}]}
        cells, zones = (schema.parameters()[name] for name in ("Output/Cells", "Rail/Plastic zones"))
        some = {"type": "array", "items": number, "minItems": 1, "maxItems": 2}
        for part, right, wrong in ((number, ("0", "2", "1e-3", " 1", ".5"), ("", "x", "2.1", "-1e-9", "nan", "inf", "1_0", "1 mm", "true")),
                                   (whole, ("1", "3", "+2"), ("0", "4", "1.5", "1e0", "2.0", "")), (word, ("masses", "0", "7.5"), ("-1", "mass", "")),
                                   (some, ("0", "1, 2"), ("", "1,2,1", "1,,2", "3")), ({"type": "boolean"}, ("true", "false"), ("yes", "1", "")),
                                   (cells, ("", "-20,0,1.5; -20,0,4", "1, 2 , 3 ;4,5,6;"), ("1,2", "1,2,-3", "1,2,3;4,5", "x")),
                                   (zones, ("", "-30:-20:8:400:21", "-30:-20:8:4e2:.5 , 1:2:3:400:21,"), ("-30:-20:8:400", "1:2:3:x:21", "1,2")),
                                   ({"enum": ["a b", "c"]}, ("a b", "c"), ("a", "")), ({"type": "string"}, ("", "1", "any"), ())):
            for text in right:
                self.assertTrue(schema.fits(schema.value_of(text, part), part), (text, part))
            for text in wrong:
                self.assertFalse(schema.fits(schema.value_of(text, part), part), (text, part))


class Scenes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def write(self, text, name="scene.prm"):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(text)
        return path

    def errors(self, text):
        return [f"{os.path.basename(file)}:{line}: {what}" for file, line, what in schema.scene_errors(self.write(text))]

    def test_shipped_scenes_are_accepted(self):
        # Examples of the fuzzed readers need not be scenes.
        scenes = [path for pattern in ("prm/**/*.prm", "tests/**/*.prm") for path in glob.glob(os.path.join(ROOT, pattern), recursive=True)
                  if os.path.join("tests", "fuzz") not in path]
        self.assertGreater(len(scenes), 60)
        result = subprocess.run([CHECK, *scenes], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    def test_defaults_fit(self):
        for name, entry in schema.parameters().items():
            self.assertTrue(schema.fits(entry["default"], entry), name)
            self.assertTrue(entry["description"], name)

    def test_what_is_wrong_is_said_with_its_place(self):
        for line, words in (("set Friction coeficient = 0.3", "no parameter 'Contact/Friction coeficient'; did you mean 'Contact/Friction coefficient'?"),
                            ("set Finest cell (mm) = 1", "no parameter 'Contact/Finest cell (mm)'; did you mean 'Mesh/Finest cell (mm)'?"),
                            ("set Friction coefficient = 2.5", "'Contact/Friction coefficient' cannot be '2.5'; allowed: a number, 0 to 2"),
                            ("set Friction coefficient = much", "'Contact/Friction coefficient' cannot be 'much'"),
                            ("set Largest number of sweeps = 1.5", "allowed: a whole number, 1 to 100000"),
                            ("set Friction law = falling fast", "'Contact/Friction law' cannot be 'falling fast'; allowed: 'Coulomb' or "),
                            ("set Friction factors = 1, -1", "'Contact/Friction factors' cannot be '1, -1'; allowed: 0 to 10000 of a number, 0 to 100"),
                            ("Friction coefficient = 1", "'Friction coefficient = 1' is neither 'set NAME = VALUE'")):
            with self.subTest(line):
                found = self.errors(f"# a comment\nsubsection Contact\n  {line}   # another\nend\n")
                self.assertEqual(len(found), 1)
                self.assertTrue(found[0].startswith("scene.prm:3: ") and words in found[0], found)
        self.assertEqual(self.errors("SUBSECTION Contact\n\tset Friction\tcoefficient \\\n = 0.3\nEND\n"), [])
        for between in ("", "end\nsubsection Contact\n"):
            found = self.errors(f"subsection Contact\n  set Friction coefficient = 0.3\n{between}  set Friction coefficient = 0.3\nend\n")
            self.assertEqual(found, [f"scene.prm:{5 if between else 3}: 'Contact/Friction coefficient' is set in line 2 already: leave one of the two lines out"])
        self.assertEqual(self.errors("subsection Contact\n"), ["scene.prm:1: the subsection of line 1 has no end"])
        self.assertIn("'end' is neither", self.errors("end\n")[0])
        self.assertIn("No such file", next(schema.scene_errors("none.prm"))[2])

    def test_files_that_are_included(self):
        self.write("subsection Mesh\n  set Finest cell (mm) = -1\nend\n", "other.prm")
        self.assertEqual(self.errors("include other.prm   # of old\n"),
                         ["other.prm:2: 'Mesh/Finest cell (mm)' cannot be '-1'; allowed: " + schema.allowed(schema.parameters()["Mesh/Finest cell (mm)"])])
        self.assertIn("included by files that it includes", self.errors("include scene.prm\n")[0])
        self.assertIn("none.prm:1: No such file", self.errors("include none.prm\n")[0])

    def test_the_command(self):
        result = subprocess.run([CHECK, self.write("subsection Wheel\n  set Radius (mm) = -460\nend\n")], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr, result.stdout.count("\n")), (1, "", 1))
        self.assertRegex(result.stdout, r"scene.prm:2: 'Wheel/Radius \(mm\)' cannot be '-460'; allowed: a number, ")


@unittest.skipUnless(PROGRAM, "no program named")
class TheProgram(unittest.TestCase):
    def setUp(self):
        faster = mock.patch.object(schema, "execute", lambda arguments, program: execute_often(arguments, program))
        faster.start()
        self.addCleanup(faster.stop)

    def test_names_defaults_and_meanings_are_current(self):
        known = schema.parameters()
        found = [(f"{section}/{name}", default, meaning) for section, entries in schema.listing(PROGRAM) for name, default, meaning in entries]
        self.assertEqual([name for name, _, _ in found], list(known))
        for name, default, meaning in found:
            self.assertEqual((schema.value_of(default, known[name]), meaning), (known[name]["default"], known[name]["description"]), name)

    def test_ranges_are_current(self):
        self.assertEqual(schema.parameters(json.loads(execute_often(["parameters", "--schema"], PROGRAM).stdout)), schema.parameters())

    def test_the_program_refuses_the_same(self):
        for name, value in (("Contact/Friction coefficient", "2.1"), ("Contact/Largest number of sweeps", "1.5"), ("Motion/Passages", "0"),
                            ("Motion/Creepage", "0.9"), ("Motion/Drive", "rocket"), ("Vehicle/Wheel load (kN)", "heavy"), ("Scene/Quasi-static", "yes"),
                            ("Contact/Friction factors", "1,-1")):
            entry = schema.parameters()[name]
            self.assertFalse(schema.fits(schema.value_of(value, entry), entry), name)
            self.assertIn(f"'{name}' cannot be '{value}'", execute_often(["parameters", "-s", f"{name}={value}"], PROGRAM).stderr)

    def test_the_program_means_the_same(self):
        for name in ("Motion/Sped", "Motion/Crepage", "Motion/Length (mm)", "Contact/Finest cell (mm)", "Defect/Shap", "Creepage", "wheel/mass (kg)", "Foo/Bar",
                     "Mesh/Finest cell", "Motion/Speed (m/s)", "Track/Pad damping (kN)"):
            said = execute_often(["parameters", "-s", f"{name}=1"], PROGRAM).stderr
            self.assertIn(schema.not_among(name, schema.parameters()), said, name)

    def test_a_scene_as_the_program_prints_it_is_accepted(self):
        printed = execute_often(["parameters"], PROGRAM).stdout
        for name, text in parameters_in(printed.splitlines()).items():
            entry = schema.parameters()[name]
            self.assertTrue(schema.fits(schema.value_of(text, entry), entry), name)


@unittest.skipUnless(PROGRAM, "no program named")
class Completion(unittest.TestCase):
    def complete(self, *words):
        script = f'source {COMPLETION}; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _tread; printf "%s\\n" "${{COMPREPLY[@]}}"'
        result = subprocess.run(["bash", "-c", script, "bash", PROGRAM, *words], cwd=ROOT, capture_output=True, text=True)
        self.assertEqual(result.stderr, "")
        return result.stdout.split("\n")[:-1]

    def test_options(self):
        self.assertEqual(self.complete("contact-points", "--s"), ["--shift-to", "--shift-step"])
        self.assertEqual(self.complete("sleeper-stress", "--s"), ["--support"])
        self.assertEqual(self.complete("--r"), ["--resume"])
        self.assertIn("-s", self.complete("-"))
        self.assertNotIn("-s", self.complete("batch", "-"))
        self.assertEqual(self.complete("dynamic-force", "results", "--window", ""), ["rectangular", "Hann"])

    def test_commands(self):
        self.assertEqual(self.complete("ref"), ["reference"])
        self.assertEqual(self.complete("p"), ["positions", "parameters", "prm"])
        self.assertEqual(self.complete("modes", "ref"), [""])

    def test_paths(self):
        self.assertEqual(self.complete("prm/smooth"), ["prm/smooth-rolling.prm"])
        self.assertEqual(self.complete("prm/cu"), ["prm/curves"])
        self.assertEqual(self.complete("scene.prm", "--output", "contrib/stu"), [""])
        self.assertEqual(self.complete("batch", "contrib/contact-data/creep"), ["contrib/contact-data/creep_table.csv"])
        self.assertEqual(self.complete("reference", "prm/smooth"), ["prm/smooth-rolling.prm"])
        self.assertEqual(self.complete("sleeper-stress", "contrib/stu"), [""])
        self.assertEqual(self.complete("wear", "prm/damage/cont"), ["prm/damage/contacts.csv"])

    def test_parameters(self):
        self.assertEqual(self.complete("-s", "Contact/Friction co"), [r"Contact/Friction\ coefficient="])
        self.assertEqual(self.complete("-s", r"Contact/Friction\ co"), [r"Contact/Friction\ coefficient="])
        self.assertEqual(self.complete("-s", '"Mesh/Fines'), ["Mesh/Finest cell (mm)="])
        self.assertEqual(self.complete("-s", "Wheel/Poisson"), [r"Wheel/Poisson\'s\ ratio="])
        self.assertEqual(len(self.complete("-s", "")), len(schema.parameters()))


if __name__ == "__main__":
    unittest.main()
