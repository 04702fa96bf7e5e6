#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw the mesh of a run and the defect on its rail.

    plot-mesh.py RUN_DIR [--output DIR] [--from X --to X]

Needs the first volume picture of a run, volume-0000.vtu. Writes
  section.png   rail and wheel cut across the path, where cells are finest and at the end of the rail
  path.png      the rail's cells under the middle of the path, and the height of its top
"""

import base64
import os
import xml.etree.ElementTree
import zlib

import numpy as np
from matplotlib.collections import PolyCollection

from tread.commands import command_parser, run_command
from tread.plots import plt, save

RAIL, WHEEL = 0, 1
TYPES = {"Float64": np.float64, "Float32": np.float32, "Int32": np.int32, "UInt8": np.uint8}


def decode(array):
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


def read_cells(path):
    """Reference positions of the cells' corners in mm, (cells, 8, 3) in VTK's order, and the cells' bodies."""
    positions, bodies = [], []
    for piece in xml.etree.ElementTree.parse(path).iter("Piece"):
        fields = {array.get("Name"): decode(array) for array in piece.find("PointData")}
        points = decode(piece.find("Points/DataArray")).reshape(-1, 3) * 1e3
        points = points - 1e-3 * fields["displacement_um"].reshape(-1, 3)
        cells = decode(piece.find("Cells/DataArray[@Name='connectivity']")).reshape(-1, 8)
        positions.append(points[cells])
        bodies.append(fields["body"][cells[:, 0]])
    return np.concatenate(positions), np.concatenate(bodies).round().astype(int)


def cut_across(cells, x):
    """The cells cut at x: quadrilaterals (y, z). Edges along the path join corners 0-1, 3-2, 4-5 and 7-6."""
    low, high = cells[:, (0, 3, 7, 4)], cells[:, (1, 2, 6, 5)]
    inside = (low[:, :, 0].min(1) <= x) & (high[:, :, 0].max(1) > x)
    low, high = low[inside], high[inside]
    share = np.clip((x - low[:, :, :1]) / (high[:, :, :1] - low[:, :, :1]), 0., 1.)
    return (low + share * (high - low))[:, :, 1:]


def along_middle(cells):
    """Sides of cells at y = 0: quadrilaterals (x, z)."""
    sides = cells[:, (0, 1, 5, 4)]
    return sides[abs(cells[:, (0, 4), 1]).max(1) < 0.12 * np.maximum(1., abs(cells[:, (0, 4), 2]).max(1))][:, :, (0, 2)]


def draw(axis, polygons, scale=(1., 1.), width=0.3):
    axis.add_collection(PolyCollection(polygons * np.array(scale), facecolors="#dce6f0", edgecolors="black", linewidths=width))


def main():
    parser = command_parser(__doc__)
    parser.add_argument("run")
    parser.add_argument("--output")
    parser.add_argument("--from", dest="begin", type=float, help="x in mm of the picture along the path")
    parser.add_argument("--to", dest="end", type=float)
    arguments = parser.parse_args()
    output = arguments.output or os.path.join(arguments.run, "pictures")
    cells, bodies = read_cells(os.path.join(arguments.run, "volume-0000.vtu"))
    rail, wheel = cells[bodies == RAIL], cells[bodies == WHEEL]

    # Where the smallest cells are, and the end.
    length = rail[:, 1, 0] - rail[:, 0, 0]
    finest = np.median(rail[length < 1.01 * length.min()][:, 0, 0])
    figure, axes = plt.subplots(1, 2, figsize=(9, 6))
    for axis, x, name in ((axes[0], finest + 0.3 * length.min(), "where cells are finest"),
                          (axes[1], rail[:, :, 0].max() - 0.1, "at the end of the rail")):
        draw(axis, cut_across(rail, x))
        draw(axis, cut_across(wheel, x))
        axis.set_xlim(-80, 80)
        axis.set_ylim(-180, 40)
        axis.set_aspect("equal")
        axis.set_title(name)
        axis.set_xlabel("y, mm")
    axes[0].set_ylabel("z, mm")
    figure.tight_layout()
    save(figure, os.path.join(output, "section.png"), dpi=130)

    figure, axes = plt.subplots(2, 1, figsize=(9, 5), sharex=True)
    begin = rail[:, :, 0].min() if arguments.begin is None else arguments.begin
    end = rail[:, :, 0].max() if arguments.end is None else arguments.end
    polygons = along_middle(rail)
    draw(axes[0], polygons)
    axes[0].set_ylim(-40, 2)
    axes[0].set_ylabel("z, mm")
    top = rail[:, (4, 5)][abs(rail[:, (4, 5), 1]).max(1) < 0.05]
    highest = {}
    for edge in top:
        x = round(edge[0, 0], 1)
        highest[x] = max(highest.get(x, edge), edge, key=lambda e: e[0, 2])
    for edge in highest.values():
        axes[1].plot(edge[:, 0], 1e3 * edge[:, 2], "k.-", linewidth=0.8, markersize=3)
    axes[1].set_ylabel("z of the rail top, um")
    axes[1].set_xlabel("x, mm")
    axes[1].set_xlim(begin, end)
    figure.tight_layout()
    save(figure, os.path.join(output, "path.png"), dpi=130)
    print(f"{len(rail)} cells of the rail and {len(wheel)} of the wheel; pictures in {output}")


if __name__ == "__main__":
    run_command(main)
