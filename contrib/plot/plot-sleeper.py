#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Von Mises stress in half a sleeper, as `tread sleeper-stress` left it in each folder, with one scale of colours.

    plot-sleeper.py FOLDER [FOLDER ...] [--names "with the defect" "smooth rail"] [--output sleeper.png]

Drawn is the section along the sleeper through the middle of the rail seat.
"""

from __future__ import annotations

import json
import os

import numpy as np

from tread.commands import command_parser, run_command
from tread.files import DataError
from tread.plots import save, subplots, use_style


def section(path: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Points y, z (mm, from the middle of the seat), triangles and von Mises stress (MPa) of the plane x = 0. @raises DataError"""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    if not os.path.exists(path):
        raise DataError(f"no '{path}': write it with tread sleeper-stress")
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    plane = vtk.vtkPlane()
    plane.SetNormal(1, 0, 0)
    cutter = vtk.vtkCutter()
    cutter.SetCutFunction(plane)
    cutter.SetInputConnection(reader.GetOutputPort())
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(cutter.GetOutputPort())
    triangles.Update()
    cut = triangles.GetOutput()
    points = 1e3 * vtk_to_numpy(cut.GetPoints().GetData())
    cells = vtk_to_numpy(cut.GetPolys().GetData()).reshape(-1, 4)[:, 1:]
    return points[:, 1], points[:, 2], cells, vtk_to_numpy(cut.GetPointData().GetArray("von_mises_MPa"))


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("folders", metavar="FOLDER", nargs="+")
    parser.add_argument("--names", nargs="*", default=[], help="of the folders, for the headings")
    parser.add_argument("--output", default="sleeper.png")
    arguments = parser.parse_args()
    use_style()
    sections = [section(os.path.join(folder, "sleeper_stress.vtu")) for folder in arguments.folders]
    top = max(values.max() for *_, values in sections)
    figure, axes = subplots(len(sections), 1, figsize=(9, 1.8 * len(sections)), squeeze=False, sharex=True)
    for i, (folder, (y, z, cells, values)) in enumerate(zip(arguments.folders, sections)):
        with open(os.path.join(folder, "sleeper_stress.json"), encoding="utf-8") as stream:
            answer = json.load(stream)
        axis = axes[i, 0]
        drawn = axis.tricontourf(y, z, cells, values, levels=np.linspace(0., 1.001 * top, 21), cmap="turbo")
        axis.set(aspect="equal", ylabel="z [mm]")
        name = arguments.names[i] + ": " if i < len(arguments.names) else ""
        axis.set_title(f"{name}{1e-3 * answer['seat_force_N']:.1f} kN on the rail seat, von Mises up to "
                       f"{1e-6 * answer['max_von_mises_Pa']:.2f} MPa, bottom {answer['bottom']}")
    axes[-1, 0].set_xlabel("along the sleeper, outwards from the middle of the rail seat [mm]")
    figure.colorbar(drawn, ax=axes[:, 0].tolist(), label="von Mises stress [MPa]", ticks=np.arange(0., top + 1e-9, 1. if top < 12. else 5.))
    save(figure, arguments.output)


if __name__ == "__main__":
    run_command(main)
