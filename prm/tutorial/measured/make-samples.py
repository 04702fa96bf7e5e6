#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sample files of a measured rail, a measured wheel and a measured squat, by formulas instead of instruments.

    make-samples.py [FOLDER]     (default: this folder)

All lengths in mm; y is counted from the middle of rail and running circle, x from the beginning of the squat.

  rail.txt       54E1 (arcs of 300, 80 and 13 mm), worn by 0.1 exp(-((y + 8)/12)^2/2); z down, as an instrument above the rail counts
  wheel.txt      tread of 1:40, hollow by 0.15 cos^2(pi y/48) for |y| < 24; throat of 14 mm, flange of 70 degrees with a tip of 12 mm;
                 z down and flange at y > 0, the other way round than the scene
  squat-map.csv  z = -0.10 h(x - 16, 32) h(y - 2, 28) - 0.15 h(x - 44, 40) h(y - 2, 36), h(s, w) = cos^2(pi s/w) for |s| < w/2, else 0
  squat-line.txt the same along y = 2
"""

import math
import os
import sys


def arcs(y, pieces):
    """Height below the top at |y| of arcs, each tangent to the one before: [(radius, where it ends)]."""
    y, slope, begin, height = abs(y), 0.0, 0.0, 0.0
    for radius, end in pieces:
        angle = math.asin(slope)
        middle_y, middle_z = begin - radius * slope, height - radius * math.cos(angle)
        at = min(y, end)
        height = middle_z + math.sqrt(radius**2 - (at - middle_y) ** 2)
        slope, begin = (at - middle_y) / radius, at
        if y <= end:
            break
    return height


def rail(y):
    """z up."""
    return arcs(y, [(300, 10.012), (80, 24.8635), (13, 35)]) - 0.1 * math.exp(-0.5 * ((y + 8) / 12) ** 2)


def wheel():
    """[(y, z)] from the flange to the outer side; z up, flange at y < 0."""
    steep, throat, tip = math.radians(70), 14.0, 12.0
    flat, root = math.atan(1 / 40), -24.0
    throat_y, throat_z = root + throat * math.sin(flat), root / 40 - throat * math.cos(flat)
    face_y, face_z = throat_y - throat * math.sin(steep), throat_z + throat * math.cos(steep)
    end_y, end_z = face_y - 8 / math.tan(steep), face_z - 8
    tip_y, tip_z = end_y - tip * math.sin(steep), end_z + tip * math.cos(steep)
    points = []
    for half_mm in range(-116, 111):
        y = 0.5 * half_mm
        if y < end_y:
            z = tip_z - math.sqrt(tip**2 - (y - tip_y) ** 2)
        elif y < face_y:
            z = face_z + (y - face_y) * math.tan(steep)
        elif y < root:
            z = throat_z + math.sqrt(throat**2 - (y - throat_y) ** 2)
        else:
            z = y / 40 + (0.15 * math.cos(math.pi * y / 48) ** 2 if abs(y) < 24 else 0)
        points.append((y, z))
    return points


def hollow(s, width):
    return math.cos(math.pi * s / width) ** 2 if abs(s) < 0.5 * width else 0.0


def squat(x, y):
    """z up."""
    return -0.10 * hollow(x - 16, 32) * hollow(y - 2, 28) - 0.15 * hollow(x - 44, 40) * hollow(y - 2, 36)


def samples():
    """{name: text}"""
    number = lambda value: f"{round(value, 5) + 0.0}"  # no -0.0
    by = "by make-samples.py"
    sides = [0.5 * i for i in range(-66, 67)]
    return {
        "rail.txt": f"# Worn head of a 54E1, {by}. Columns: y (mm, gauge side at y < 0), z (mm, down).\n"
                    + "".join(f"{y:g} {number(-rail(y))}\n" for y in sides),
        "wheel.txt": f"# Worn wheel with its flange, {by}. Columns: y (mm, flange at y > 0), z (mm, down).\n"
                     + "".join(f"{-y:g} {number(-z)}\n" for y, z in wheel()),
        "squat-line.txt": f"# A squat of two hollows along its middle, {by}. Columns: x (mm), z (mm, up).\n"
                          + "".join(f"{x} {number(squat(x, 2))}\n" for x in range(65)),
        "squat-map.csv": "x_mm,y_mm,z_mm\n" + "".join(f"{x},{y},{number(squat(x, y))}\n" for y in range(-16, 21, 2) for x in range(0, 65, 2)),
    }


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    os.makedirs(folder, exist_ok=True)
    for name, text in samples().items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
            stream.write(text)


if __name__ == "__main__":
    main()
