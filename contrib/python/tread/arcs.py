# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points of a rail head or a wheel tread from the arcs and lines of its drawing, for 'Rail/Measured head' and 'Wheel/Tread profile'.

    contrib/profile-from-arcs.py ARCS.csv --output POINTS.txt [--mirror] [--start Y Z SLOPE] [--spacing MM]

ARCS.csv has a row for each piece, in the order in which they follow each other with common tangents, from the start (by default the
middle of a rail's top: y = z = 0, level) towards +y:

    radius_mm,until,value
    -300,y_mm,10.228
    -80,y_mm,26.0265
    -13,slope,-20
    line,z_mm,-30

radius_mm is negative where the centre lies below (a crown), positive where it lies above (the root of a flange), or the word line.
A piece ends where y or z reaches a value in mm (y_mm, z_mm), or where the surface has the slope dz/dy (slope).
--mirror adds the mirror image at y < 0, as of a new rail. For a wheel, whose flange lies at y < 0, give --start at the flange's side.

The command prints where each piece ends: compare the last arc's end with the width that the drawing gives there. Arcs that do not
close by some micrometres have a wrong number among them.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from .files import DataError, Error

COLUMNS = ["radius_mm", "until", "value"]
ENDS = ("y_mm", "z_mm", "slope")


class Place(NamedTuple):
    """A point of the profile, in mm, and the angle of its tangent."""

    y: float
    z: float
    angle: float


class Piece(NamedTuple):
    radius: float  # mm, negative: centre below; infinite: a line
    until: str
    value: float
    row: int  # of the file, for messages


def read_arcs(path: str) -> list[Piece]:
    """@raises DataError"""
    with open(path, encoding="utf-8") as stream:
        lines = [(number, line.split("#")[0].strip()) for number, line in enumerate(stream, 1)]
    rows = [(number, [entry.strip() for entry in line.split(",")]) for number, line in lines if line]
    if not rows or rows[0][1] != COLUMNS:
        raise DataError(f"{path}: the first row must be {','.join(COLUMNS)}")
    pieces = []
    for number, row in rows[1:]:
        try:
            radius, until, value = row
            piece = Piece(math.inf if radius == "line" else float(radius), until, float(value), number)
        except ValueError:
            raise DataError(f"{path}, line {number}: a row is a radius in mm or the word line, one of {', '.join(ENDS)}, and a number") from None
        if piece.until not in ENDS or piece.radius == 0 or not math.isfinite(piece.value) or math.isnan(piece.radius):
            raise DataError(f"{path}, line {number}: the radius must not be 0, and a piece ends at one of {', '.join(ENDS)}")
        pieces.append(piece)
    if not pieces:
        raise DataError(f"{path}: no pieces")
    return pieces


def moved(start: Place, radius: float, length: float) -> Place:
    """The place at an arc length from the start, towards +y."""
    if math.isinf(radius):
        return Place(start.y + length * math.cos(start.angle), start.z + length * math.sin(start.angle), start.angle)
    angle = start.angle + length / radius
    return Place(start.y + radius * (math.sin(angle) - math.sin(start.angle)), start.z - radius * (math.cos(angle) - math.cos(start.angle)), angle)


def length_of(start: Place, piece: Piece) -> float:
    """How long a piece is, mm; it goes on towards +y. @raises DataError where it does not reach its end"""
    radius = piece.radius
    if piece.until == "slope":
        if math.isinf(radius):
            raise DataError(f"line {piece.row}: a line keeps its slope, so it must end at y_mm or z_mm")
        length = radius * (math.atan(piece.value) - start.angle)
    elif math.isinf(radius):
        along, way = (math.cos(start.angle), piece.value - start.y) if piece.until == "y_mm" else (math.sin(start.angle), piece.value - start.z)
        length = way / along if along else math.nan
    elif piece.until == "y_mm":
        sine = math.sin(start.angle) + (piece.value - start.y) / radius
        length = radius * (math.asin(sine) - start.angle) if abs(sine) <= 1 else math.nan
    else:
        cosine = math.cos(start.angle) - (piece.value - start.z) / radius
        # Where the circle rises to the right its tangent has a positive angle.
        ends = [sign * math.acos(cosine) for sign in (-1, 1)] if abs(cosine) <= 1 else []
        length = min((way for way in (radius * (end - start.angle) for end in ends) if way > 0), default=math.nan)
    if not length > 0:
        raise DataError(f"line {piece.row}: this piece never comes to {piece.until} = {piece.value:g}; from y = {start.y:.3f}, z = {start.z:.3f} mm it begins "
                        f"with a slope of {math.tan(start.angle):.4f}")
    return length


def joints(pieces: list[Piece], start: Place = Place(0., 0., 0.)) -> list[Place]:
    """The start and the ends of all pieces. @raises DataError"""
    places = [start]
    for piece in pieces:
        places.append(moved(places[-1], piece.radius, length_of(places[-1], piece)))
    return places


def points(pieces: list[Piece], start: Place = Place(0., 0., 0.), spacing: float = 0.25, mirror: bool = False) -> list[tuple[float, float]]:
    """(y, z) in mm at most so far apart, with all joints, y ascending. @raises DataError"""
    found = [(start.y, start.z)]
    for piece, place in zip(pieces, joints(pieces, start)):
        length = length_of(place, piece)
        n = max(1, math.ceil(length / spacing))
        found += [moved(place, piece.radius, length * i / n)[:2] for i in range(1, n + 1)]
    if mirror:
        if start.y:
            raise Error("--mirror is for profiles that start at y = 0")
        found = [(-y, z) for y, z in reversed(found[1:])] + found
    if any(b[0] <= a[0] for a, b in zip(found, found[1:])):
        raise DataError("the profile turns back: y must grow all along")
    return found


def main() -> None:
    from .commands import command_parser

    parser = command_parser(__doc__)
    parser.add_argument("arcs", metavar="ARCS.csv")
    parser.add_argument("--output", metavar="POINTS.txt", required=True, help="file with columns y and z in mm")
    parser.add_argument("--mirror", action="store_true", help="add the mirror image at y < 0")
    parser.add_argument("--start", type=float, nargs=3, metavar=("Y", "Z", "SLOPE"), default=(0., 0., 0.), help="where the first piece begins: mm, mm, dz/dy (0 0 0)")
    parser.add_argument("--spacing", type=float, metavar="MM", default=0.25, help="largest distance of the points (0.25)")
    arguments = parser.parse_args()
    if not arguments.spacing > 0:
        raise Error("--spacing must be above 0")
    start = Place(arguments.start[0], arguments.start[1], math.atan(arguments.start[2]))
    try:
        pieces = read_arcs(arguments.arcs)
        ends = joints(pieces, start)
        table = points(pieces, start, arguments.spacing, arguments.mirror)
    except DataError as error:
        text = str(error)
        raise DataError(text if text.startswith(arguments.arcs) else f"{arguments.arcs}: {text}") from None
    print(f"{'piece':>10} {'y, mm':>10} {'z, mm':>10} {'dz/dy':>10}   at its end")
    for piece, end in zip(pieces, ends[1:]):
        name = "line" if math.isinf(piece.radius) else f"R{abs(piece.radius):g}"
        print(f"{name:>10} {end.y:10.4f} {end.z:10.4f} {math.tan(end.angle):10.4f}")
    with open(arguments.output, "w", encoding="utf-8") as stream:
        stream.write(f"# y z in mm, from the arcs of {arguments.arcs}\n" + "".join(f"{y:.6f} {z:.6f}\n" for y, z in table))


def command_line() -> None:
    """What contrib/profile-from-arcs.py and tread-profile-from-arcs do."""
    from .commands import run_command

    run_command(main)
