#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The folders of the sources are floors: a file includes only what lies on its own floor or below. Their order is that of CONTRIBUTING.md."""

import glob
import os
import re
import unittest

from tread.runs import ROOT


def text_of(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as stream:
        return stream.read()


def floors():
    """From bottom to top."""
    return re.search(r"from bottom to top:\s*`([^`]*)`", text_of("CONTRIBUTING.md"))[1].split(", ")


def upward(floor, text):
    """Floors above this one of which a text includes something."""
    order = floors()
    return [other for other in re.findall(r"#include <tread/(\w+)/", text) if order.index(other) > order.index(floor)]


class Floors(unittest.TestCase):
    def test_nothing_is_included_from_above(self):
        seen = set()
        for below in ("source", "include/tread"):
            for path in glob.glob(os.path.join(ROOT, below, "*", "**", "*.*"), recursive=True):
                floor = os.path.relpath(path, os.path.join(ROOT, below)).split(os.sep)[0]
                if path.endswith((".cc", ".h")):
                    seen.add(floor)
                    self.assertEqual(upward(floor, text_of(path)), [], os.path.relpath(path, ROOT))
        self.assertEqual(seen, set(floors()))

    def test_what_is_from_above_is_found(self):
        self.assertEqual(upward("mesh", "#include <tread/solid/solid.h>\n#include <tread/mesh/mesh.h>\n#include <tread/base/simd.h>\n"), ["solid"])

    def test_the_page_of_the_house_lists_them(self):
        listed = re.findall(r"^\| `(\w+)` \|", text_of("doc/dev/house.md"), flags=re.MULTILINE)
        self.assertEqual(listed, floors()[::-1])


if __name__ == "__main__":
    unittest.main()
