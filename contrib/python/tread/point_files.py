# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of points as instruments and spreadsheets write them: the same grammar as the program's own reader of profiles."""

from __future__ import annotations

import os
import re

import numpy as np

from .files import DataError


def read_lines(path: str) -> list[str]:
    """Lines of a text in UTF-8 or UTF-16, with the line ends of Unix, Windows or old Macs. @raises DataError"""
    try:
        with open(path, "rb") as stream:
            content = stream.read()
    except OSError as error:
        raise DataError(f"{path}: {error.strerror}") from None
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        encoding = "utf-16"
    elif content[1:2] == b"\0":
        encoding = "utf-16-le"
    else:
        encoding = "utf-16-be" if content[:1] == b"\0" else "utf-8-sig"
    try:
        text = content.decode(encoding)
    except UnicodeDecodeError:
        text = content.decode("latin-1")
    text = text.replace("\u2212", "-").replace("\u00a0", " ")
    return text.replace("\r\n", "\n").split("\n") if "\n" in text else text.split("\r")


def read_points(path: str) -> np.ndarray:
    """(points, 2) of a file with two columns, separated by blanks, tabs, semicolons or commas; decimal commas where commas do not
    separate. Headings before the first point, comments behind #, ! or % and remarks behind numbers are passed over. @raises DataError"""
    rows = []
    for number, line in enumerate(read_lines(path), 1):
        if not rows and "x_mm" in line and "y_mm" in line:
            raise DataError(f"{os.path.basename(path)}, line {number}: is a map of heights, with columns x_mm, y_mm and z_mm, and no profile, which has two")
        text = re.sub(r"(?:^|(?<=[\s,;]))[^\W\d_].*", "", re.split("[#!%]", line)[0].replace('"', "")).strip()
        if re.match(r"[-+.]?\d", text):
            rows.append((number, text))
    comma_between = any(re.search(r"^,|,(?!\d)|(?<![\d+-]),", text) for _, text in rows)
    words_with_comma = any("," in text and len(re.split(r"[\s;]+", text)) > 1 for _, text in rows)
    decimal_comma = words_with_comma and not comma_between
    points = []
    for number, text in rows:
        words = [word for word in re.split(r"[\s;]+" if decimal_comma else r"[\s;,]+", text) if word]
        try:
            values = [float(word.replace(",", ".") if decimal_comma else word) for word in words]
        except ValueError:
            values = []
        if len(values) != 2:
            raise DataError(f"{os.path.basename(path)}, line {number}: needs two numbers")
        points.append(values)
    if not points:
        raise DataError(f"{os.path.basename(path)}: has no points")
    return np.array(points)
