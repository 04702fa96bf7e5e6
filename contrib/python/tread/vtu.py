# SPDX-License-Identifier: LGPL-2.1-or-later
"""Read the program's files for ParaView (.vtu) without VTK."""

from __future__ import annotations

import base64
import os
import zlib
from collections.abc import Iterator
from xml.etree import ElementTree

import numpy as np

from .files import DataError

TYPES = {"Float64": np.float64, "Float32": np.float32, "Int32": np.int32, "UInt8": np.uint8}


def _decode(array: ElementTree.Element) -> np.ndarray:
    """The numbers of a DataArray: ascii, or blocks compressed by zlib in base64."""
    text = array.text.strip()
    kind = TYPES[array.get("type")]
    if array.get("format") == "ascii":
        return np.array(text.split(), dtype=kind)
    n_blocks = np.frombuffer(base64.b64decode(text[:8])[:4], np.uint32)[0]
    header_length = 4 * ((4 * (3 + int(n_blocks)) + 2) // 3)
    sizes = np.frombuffer(base64.b64decode(text[:header_length])[:4 * (3 + int(n_blocks))], np.uint32)[3:]
    data, begin, blocks = base64.b64decode(text[header_length:]), 0, []
    for size in sizes:
        blocks.append(zlib.decompress(data[begin:begin + size]))
        begin += size
    return np.frombuffer(b"".join(blocks), kind)


def read_pieces(path: str) -> Iterator[tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]]:
    """(points in mm, (points, 3); points of the cells in VTK's order; {field: values at the points}) of each piece. @raises DataError"""
    if not os.path.exists(path):
        raise DataError(f"{path}: No such file")
    for piece in ElementTree.parse(path).iter("Piece"):
        fields = {array.get("Name"): _decode(array) for array in piece.find("PointData")}
        yield (1e3 * _decode(piece.find("Points/DataArray")).reshape(-1, 3), _decode(piece.find("Cells/DataArray[@Name='connectivity']")), fields)
