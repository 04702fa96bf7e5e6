# SPDX-License-Identifier: LGPL-2.1-or-later
"""A mesh of a bar with a crown, or of two bars at a joint, for 'Rail/Mesh file': hexahedra with names of their boundary.

    contrib/rail-mesh.py --output joint.msh --length 300 --width 60 --height 60 --edge 10 --gap 6 --step 0.5

The bars lie along x about x = 0, where the gap is, with the crown's top at z = 0; behind the gap it is higher by the step. Without a gap there is one
bar, and with --end-post the gap is filled with the volume 'end post', to which 'Rail/Materials' gives its material. Tops are named contact, bottoms support, with --hold-ends both outer ends end and with --hold-sides both sides symmetry; the ends at the gap are free. The ending of --output
decides about the format: .msh (Gmsh, --version 2.2 or 4.1), .inp (Abaqus) or .k (LS-DYNA). Lengths in mm.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import NamedTuple

from .commands import command_parser, run_command
from .files import Error

import numpy

FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))  # of a hexahedron, as Abaqus' S1 to S6
BOUNDARIES = ("contact", "support", "end", "symmetry")


class Mesh(NamedTuple):
    """Points in mm, eight corners of each cell in the usual order from 0, and faces (cell, number from 0) by their names."""

    points: numpy.ndarray
    cells: list[tuple[int, ...]]
    faces: dict[str, list[tuple[int, int]]]
    volumes: dict[str, list[int]] = {}  # cells of volumes that are not the rail


def even_lines(begin: float, end: float, edge: float) -> list[float]:
    """Lines so far apart, or a little less."""
    n = max(1, round((end - begin) / edge + 0.49))
    return [begin + (end - begin) * i / n for i in range(n + 1)]


def bar(x: Sequence[float], y: Sequence[float], z: Sequence[float], crown_radius: float, top: float = 0., hold_ends: tuple[bool, bool] = (False, False),
        hold_sides: bool = False) -> Mesh:
    """A bar with these lines, z from its bottom to 0. The crown fades out to the flat bottom."""
    grid = numpy.array([(a, b, c) for c in z for b in y for a in x])
    crown = numpy.sqrt(crown_radius**2 - grid[:, 1]**2) - crown_radius if crown_radius > 0. else 0.
    grid[:, 2] += crown * (1. - grid[:, 2] / z[0]) + top
    n_x, n_y, n_z = len(x), len(y), len(z)
    cells, faces = [], {name: [] for name in BOUNDARIES}
    for k in range(n_z - 1):
        for j in range(n_y - 1):
            for i in range(n_x - 1):
                low = [i + n_x * (j + n_y * k), i + 1 + n_x * (j + n_y * k), i + 1 + n_x * (j + 1 + n_y * k), i + n_x * (j + 1 + n_y * k)]
                for name, face, is_there in (("support", 0, k == 0), ("contact", 1, k == n_z - 2), ("end", 5, hold_ends[0] and i == 0), ("end", 3, hold_ends[1] and i == n_x - 2),
                                              ("symmetry", 2, hold_sides and j == 0), ("symmetry", 4, hold_sides and j == n_y - 2)):
                    if is_there:
                        faces[name].append((len(cells), face))
                cells.append((*low, *(corner + n_x * n_y for corner in low)))
    return Mesh(grid, cells, faces)


def perturbed(x: Sequence[float], y: Sequence[float], z: Sequence[float], crown_radius: float, share: float, seed: int = 1) -> Mesh:
    """A bar of which the inner nodes are moved by up to this share of the neighbours' distance, along x and y; those below the top in z too."""
    flat = bar(x, y, z, 0.)
    random, points = numpy.random.default_rng(seed), flat.points
    for direction, lines in ((0, x), (1, y), (2, z)):
        inner = numpy.all([(points[:, d] > min(of)) & (points[:, d] < max(of)) for d, of in ((0, x), (1, y)) + (((2, z),) if direction == 2 else ())], axis=0)
        points[inner, direction] += share * min(numpy.diff(lines)) * random.uniform(-1., 1., inner.sum())
    if crown_radius > 0.:
        points[:, 2] += (numpy.sqrt(crown_radius**2 - points[:, 1]**2) - crown_radius) * (1. - points[:, 2] / z[0])
    return flat


def joined(first: Mesh, second: Mesh) -> Mesh:
    """Both as one mesh."""
    n_points, n_cells = len(first.points), len(first.cells)
    return Mesh(numpy.concatenate((first.points, second.points)), first.cells + [tuple(corner + n_points for corner in cell) for cell in second.cells],
                {name: first.faces[name] + [(cell + n_cells, face) for cell, face in second.faces[name]] for name in BOUNDARIES})


def with_volume(mesh: Mesh, name: str, begin: float, end: float) -> Mesh:
    """The same with a name for the volume of the cells between two x."""
    middles = mesh.points[numpy.array(mesh.cells)][:, :, 0].mean(axis=1)
    return mesh._replace(volumes={**mesh.volumes, name: [int(cell) for cell in numpy.flatnonzero((middles > begin) & (middles < end))]})


def volumes_of(mesh: Mesh) -> list[tuple[str, list[int]]]:
    """Names of all volumes and their cells, the rail first."""
    others = {cell for cells in mesh.volumes.values() for cell in cells}
    return [("rail", [cell for cell in range(len(mesh.cells)) if cell not in others]), *mesh.volumes.items()]


def corners(mesh: Mesh, cell: int, face: int) -> list[int]:
    """Numbers of a face's nodes from 1, as files have them."""
    return [mesh.cells[cell][corner] + 1 for corner in FACES[face]]


def named(mesh: Mesh) -> list[tuple[int, str]]:
    """Numbers and names of the boundaries that the mesh has."""
    return [(number, name) for number, name in enumerate(BOUNDARIES, 1) if mesh.faces[name]]


def gmsh(mesh: Mesh, version: str) -> str:
    """The text of a .msh file of Gmsh."""
    names, volumes = named(mesh), [(number, name, cells) for number, (name, cells) in enumerate(volumes_of(mesh), 10)]
    lines = ["$MeshFormat", f"{version} 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names) + len(volumes))]
    lines += [f'2 {number} "{name}"' for number, name in names] + [f'3 {number} "{name}"' for number, name, _ in volumes] + ["$EndPhysicalNames"]
    n_faces = sum(len(mesh.faces[name]) for _, name in names)
    if version == "2.2":
        lines += ["$Nodes", str(len(mesh.points))] + [f"{i} {p[0]:.12g} {p[1]:.12g} {p[2]:.12g}" for i, p in enumerate(mesh.points, 1)]
        lines += ["$EndNodes", "$Elements", str(n_faces + len(mesh.cells))]
        rows = [(3, number, corners(mesh, *face)) for number, name in names for face in mesh.faces[name]] + [
            (5, number, [i + 1 for i in mesh.cells[cell]]) for number, _, cells in volumes for cell in cells]
        lines += [f"{i} {kind} 2 {number} {number} {' '.join(map(str, nodes))}" for i, (kind, number, nodes) in enumerate(rows, 1)]
        return "\n".join(lines + ["$EndElements", ""])
    box = " ".join(f"{value:.12g}" for value in (*mesh.points.min(0), *mesh.points.max(0)))
    lines += ["$Entities", f"0 0 {len(names)} {len(volumes)}"] + [f"{number} {box} 1 {number} 0" for number, _ in names]
    lines += [f"{number - 9} {box} 1 {number} 0" for number, _, _ in volumes] + ["$EndEntities"]
    lines += ["$Nodes", f"1 {len(mesh.points)} 1 {len(mesh.points)}", f"3 1 0 {len(mesh.points)}"]
    lines += [str(i + 1) for i in range(len(mesh.points))] + [f"{p[0]:.12g} {p[1]:.12g} {p[2]:.12g}" for p in mesh.points]
    lines += ["$EndNodes", "$Elements", f"{len(names) + len(volumes)} {n_faces + len(mesh.cells)} 1 {n_faces + len(mesh.cells)}"]
    count = 0
    blocks = [(2, number, 3, [corners(mesh, *face) for face in mesh.faces[name]]) for number, name in names] + [
        (3, number - 9, 5, [[i + 1 for i in mesh.cells[cell]] for cell in cells]) for number, _, cells in volumes]
    for dimension, entity, kind, block in blocks:
        lines.append(f"{dimension} {entity} {kind} {len(block)}")
        for nodes in block:
            count += 1
            lines.append(f"{count} {' '.join(map(str, nodes))}")
    return "\n".join(lines + ["$EndElements", ""])


def abaqus(mesh: Mesh) -> str:
    """The text of an .inp file of Abaqus."""
    lines = ["*HEADING", "a bar", "*NODE"] + [f"{i}, {p[0]:.12g}, {p[1]:.12g}, {p[2]:.12g}" for i, p in enumerate(mesh.points, 1)]
    for name, cells in volumes_of(mesh):
        lines += [f'*ELEMENT, TYPE=C3D8R, ELSET="{name.upper()}"' if " " in name else f"*ELEMENT, TYPE=C3D8R, ELSET={name.upper()}"]
        lines += [f"{cell + 1}, {', '.join(str(corner + 1) for corner in mesh.cells[cell])}" for cell in cells]
    for _, name in named(mesh):
        lines += [f"*SURFACE, TYPE=ELEMENT, NAME={name.upper()}"] + [f"{cell + 1}, S{face + 1}" for cell, face in mesh.faces[name]]
    return "\n".join(lines + [""])


def ls_dyna(mesh: Mesh) -> str:
    """The text of a .k file of LS-DYNA."""
    lines = ["*KEYWORD", "*NODE"] + [f"{i:8d}{p[0]:16.9g}{p[1]:16.9g}{p[2]:16.9g}" for i, p in enumerate(mesh.points, 1)]
    volumes = volumes_of(mesh)
    for part, (name, _) in enumerate(volumes, 1):
        lines += ["*PART", name, f"{part:10d}{part:10d}{part:10d}"]
    lines += ["*ELEMENT_SOLID"] + ["".join(f"{number:8d}" for number in (cell + 1, part, *(corner + 1 for corner in mesh.cells[cell])))
                                   for part, (_, cells) in enumerate(volumes, 1) for cell in cells]
    for number, name in named(mesh):
        lines += ["*SET_SEGMENT_TITLE", name, f"{number:10d}"] + ["".join(f"{node:10d}" for node in corners(mesh, *face)) for face in mesh.faces[name]]
    return "\n".join(lines + ["*END", ""])


def write(mesh: Mesh, path: str, version: str = "4.1") -> None:
    """Write a mesh as the ending of the path says. @raises Error"""
    ending = os.path.splitext(path)[1]
    texts = {".msh": lambda: gmsh(mesh, version), ".inp": lambda: abaqus(mesh), ".k": lambda: ls_dyna(mesh)}
    if ending not in texts:
        raise Error(f"{path}: a mesh is written as .msh, .inp or .k")
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(texts[ending]())


def main() -> None:
    parser = command_parser(__doc__ or "")
    parser.add_argument("--output", required=True, help="file that is written")
    parser.add_argument("--version", choices=("2.2", "4.1"), default="4.1", help="of a file of Gmsh (default 4.1)")
    parser.add_argument("--perturb", type=float, metavar="SHARE", help="move the inner nodes by up to this share of an edge: 0 to 0.3; without a gap")
    for name, value, what in (("length", 300., "of both bars with the gap"), ("width", 60., "of a bar"), ("height", 60., "at the crown"), ("edge", 10., "of the cells"),
                              ("crown-radius", 300., "0: a flat top"), ("gap", 0., "about x = 0"), ("step", 0., "by which the bar behind the gap is higher")):
        parser.add_argument(f"--{name}", type=float, default=value, metavar="MM", help=f"{what} (default {value:g})")
    parser.add_argument("--end-post", action="store_true", help="fill the gap with a volume of this name; without a step")
    parser.add_argument("--hold-ends", action="store_true", help="name the outer ends 'end': planes of symmetry")
    parser.add_argument("--hold-sides", action="store_true", help="name the sides 'symmetry': a slice in plane strain; without a gap or --perturb")
    options = parser.parse_args()
    if min(options.length, options.width, options.height, options.edge) <= 0. or options.crown_radius < 0.:
        raise Error("length, width, height and edge must be above 0, the crown's radius no less")
    if options.gap >= options.length:
        raise Error("the gap leaves nothing of the length")
    if options.gap < 0. or (options.step != 0. and options.gap == 0.) or (options.perturb and options.gap > 0.):
        raise Error("a step needs a gap above 0, and perturbed nodes a bar without one")
    if options.hold_sides and (options.perturb or options.gap > 0.):
        raise Error("--hold-sides is for a bar without --gap and without --perturb")
    if options.hold_sides and options.crown_radius > 0.:
        raise Error("--hold-sides is for a flat top: --crown-radius 0")
    if options.end_post and (options.gap == 0. or options.step != 0.):
        raise Error("--end-post fills a --gap without a --step")
    half = 0.5 * options.length
    y, z = even_lines(-0.5 * options.width, 0.5 * options.width, options.edge), even_lines(-options.height, 0., options.edge)
    ends, radius = options.hold_ends, options.crown_radius
    if options.perturb:
        mesh = perturbed(even_lines(-half, half, options.edge), y, z, radius, options.perturb)
    elif options.gap == 0.:
        mesh = bar(even_lines(-half, half, options.edge), y, z, radius, 0., (ends, ends), options.hold_sides)
    elif options.end_post:
        before, behind = even_lines(-half, -0.5 * options.gap, options.edge), even_lines(0.5 * options.gap, half, options.edge)
        within = even_lines(before[-1], behind[0], options.edge)
        mesh = with_volume(bar(before + within[1:-1] + behind, y, z, radius, 0., (ends, ends)), "end post", before[-1], behind[0])
    else:
        mesh = joined(bar(even_lines(-half, -0.5 * options.gap, options.edge), y, z, radius, 0., (ends, False)),
                      bar(even_lines(0.5 * options.gap, half, options.edge), y, z, radius, options.step, (False, ends)))
    write(mesh, options.output, options.version)
    print(f"{options.output}: {len(mesh.cells)} cells, {len(mesh.points)} nodes")


def command_line() -> None:
    run_command(main)
