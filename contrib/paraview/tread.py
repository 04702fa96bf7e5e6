#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Show the last step of a run of tread: von Mises stress on the cut y = 0, pressure on the surface.

  pvpython contrib/paraview/tread.py RUN_DIR          writes RUN_DIR/pictures/paraview.png
  paraview --script=contrib/paraview/tread.py         the same in the window; start it in RUN_DIR, or
                                                      name the folder in the variable TREAD_RUN
  /usr/bin/python3 contrib/paraview/tread.py RUN_DIR  without ParaView: reads the .vtu files with VTK, prints
                                                      every field's range, draws RUN_DIR/pictures/cut.png

ParaView as Debian has it draws with a display only; without one: xvfb-run -a pvpython ...
"""

import glob
import os
import sys
import xml.etree.ElementTree as ElementTree

HALF_WIDTH = 0.02  # of the region shown, m


def find_field(names, word):
    """The field whose name contains the word, spelled with blanks or underscores."""
    return next((name for name in names if word in name.lower().replace(" ", "_")), None)


# ---------------------------------------------------------------- with ParaView
def show_in_paraview(lists, picture):
    import paraview.simple as pv

    layout = pv.CreateLayout("tread")
    shown = 0
    for name in lists:
        reader = pv.Xdmf3ReaderS(FileName=[name]) if name.endswith(".xdmf") else pv.PVDReader(FileName=name)
        steps = reader.TimestepValues  # a number where there is one only
        last = steps[-1] if hasattr(steps, "__len__") and len(steps) else steps or 0.0
        scene = pv.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        scene.AnimationTime = last  # before the views: a range of colours is that of their time
        reader.UpdatePipeline(last)
        for word, cut in (("von_mises", True), ("pressure", False)):
            field, where = None, None
            for where, data in (("POINTS", reader.PointData), ("CELLS", reader.CellData)):
                field = find_field(data.keys(), word)
                if field:
                    break
            if not field:
                continue
            if shown == 1:
                layout.SplitHorizontal(0, 0.5)
            view = pv.CreateView("RenderView")
            view.UseColorPaletteForBackground, view.Background = 0, [1, 1, 1]
            pv.AssignViewToLayout(view=view, layout=layout, hint=min(shown, 2))
            source = reader
            if cut:
                source = pv.Slice(Input=reader, SliceType="Plane")
                source.SliceType.Origin, source.SliceType.Normal = [0, 1e-9, 0], [0, 1, 0]
            view.ViewTime = last
            display = pv.Show(source, view)
            pv.Render(view)
            pv.ColorBy(display, (where, field))
            display.RescaleTransferFunctionToDataRange(True, False)
            colours = pv.GetColorTransferFunction(field)
            colours.ApplyPreset("Viridis (matplotlib)", True)
            display.SetScalarBarVisibility(view, True)
            bar = pv.GetScalarBar(colours, view)
            bar.Orientation, bar.WindowLocation = "Horizontal", "Lower Center"
            bar.TitleFontSize, bar.LabelFontSize, bar.ScalarBarLength = 16, 14, 0.5
            bar.TitleColor = bar.LabelColor = [0, 0, 0]
            bar.DrawBackground, bar.BackgroundColor, bar.BackgroundPadding = 1, [1, 1, 1, 0.7], 5
            focus = peak_in_paraview(pv, source, field, where, last)
            view.CameraParallelProjection, view.CameraParallelScale = 1, HALF_WIDTH
            view.CameraFocalPoint = focus
            view.CameraPosition = [focus[0], focus[1] - 1, focus[2]] if cut else [focus[0], focus[1], focus[2] + 1]
            view.CameraViewUp = [0, 0, 1] if cut else [0, 1, 0]
            shown += 1
    if not shown:
        sys.exit("tread.py: no field 'von Mises' or 'pressure' in " + ", ".join(lists))
    if picture:
        layout.SetSize(1800, 800)
    pv.RenderAllViews()
    if picture:
        pv.SaveScreenshot(picture, layout, ImageResolution=[1800, 800])
        print(picture)


def peak_in_paraview(pv, source, field, where, time):
    """Where the field is largest."""
    from vtkmodules.numpy_interface import dataset_adapter
    from paraview import servermanager

    merged = pv.MergeBlocks(Input=source)
    merged.UpdatePipeline(time)
    data = servermanager.Fetch(merged)
    pv.Delete(merged)
    return peak(dataset_adapter.WrapDataObject(data), field, where == "CELLS")


def peak(wrapped, field, by_cell):
    values = (wrapped.CellData if by_cell else wrapped.PointData)[field]
    index = int(values.argmax())
    if by_cell:
        bounds = wrapped.VTKObject.GetCell(index).GetBounds()
        return [0.5 * (bounds[2 * i] + bounds[2 * i + 1]) for i in range(3)]
    return [float(value) for value in wrapped.Points[index]]


# ---------------------------------------------------------------- with VTK alone
def files_of_last_step(pvd):
    try:
        entries = ElementTree.parse(pvd).getroot().findall("./Collection/DataSet")
        last = max(float(entry.get("timestep", 0)) for entry in entries)
    except (OSError, ValueError, ElementTree.ParseError) as error:
        sys.exit(f"tread.py: {pvd}: {error}")
    folder = os.path.dirname(pvd)
    return last, [os.path.join(folder, e.get("file")) for e in entries if float(e.get("timestep", 0)) == last]


def read_with_vtk(files):
    import vtk

    merged = vtk.vtkAppendFilter()
    for name in files:
        parallel = name.endswith(".pvtu")
        reader = vtk.vtkXMLPUnstructuredGridReader() if parallel else vtk.vtkXMLUnstructuredGridReader()
        if not os.path.exists(name):
            sys.exit(f"tread.py: {name}: no such file")
        reader.SetFileName(name)
        reader.Update()
        if reader.GetErrorCode() or reader.GetOutput().GetNumberOfPoints() == 0 and len(files) == 1:
            sys.exit(f"tread.py: {name}: cannot be read, or is empty")
        merged.AddInputData(reader.GetOutput())
    merged.Update()
    return merged.GetOutput()


def show_with_vtk(lists, folder):
    import numpy as np
    from vtkmodules.numpy_interface import dataset_adapter

    for pvd in lists:
        time, files = files_of_last_step(pvd)
        grid = read_with_vtk(files)
        print(f"{pvd}: {grid.GetNumberOfCells()} cells, {grid.GetNumberOfPoints()} points at {time:g} s")
        wrapped = dataset_adapter.WrapDataObject(grid)
        for kind, data in (("point", wrapped.PointData), ("cell", wrapped.CellData)):
            for name in data.keys():
                values = np.asarray(data[name])
                if not np.isfinite(values).all():
                    sys.exit(f"tread.py: {pvd}: field '{name}' is not finite everywhere")
                print(f"  {kind} field {name}: {values.min():.6g} to {values.max():.6g}")
        if find_field(wrapped.PointData.keys() + wrapped.CellData.keys(), "von_mises"):
            draw_cut(grid, os.path.join(folder, "cut.png"))


def draw_cut(grid, picture):
    import matplotlib
    import numpy as np
    import vtk
    from vtkmodules.numpy_interface import dataset_adapter

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plane, cutter, triangles = vtk.vtkPlane(), vtk.vtkCutter(), vtk.vtkTriangleFilter()
    plane.SetOrigin(0, 1e-9, 0)  # beside the cell faces that lie in y = 0
    plane.SetNormal(0, 1, 0)
    cutter.SetInputData(grid)
    cutter.SetCutFunction(plane)
    triangles.SetInputConnection(cutter.GetOutputPort())
    triangles.Update()
    cut = dataset_adapter.WrapDataObject(triangles.GetOutput())
    if not triangles.GetOutput().GetNumberOfPolys():
        print("  the plane y = 0 cuts no cell; no picture drawn")
        return
    corners = np.asarray(cut.Polygons).reshape(-1, 4)[:, 1:]
    field = find_field(cut.PointData.keys(), "von_mises")
    by_cell = field is None
    field = field or find_field(cut.CellData.keys(), "von_mises")
    values = np.asarray((cut.CellData if by_cell else cut.PointData)[field])
    scale = 1e-6 if field.lower().endswith("_pa") or values.max() > 1e5 else 1.0  # to MPa
    focus = peak(cut, field, by_cell)
    points = np.asarray(cut.Points)
    figure, axes = plt.subplots(figsize=(7.2, 5.2))
    style = {"facecolors": scale * values} if by_cell else {"shading": "gouraud"}
    image = axes.tripcolor(1e3 * points[:, 0], 1e3 * points[:, 2], corners,
                           *([] if by_cell else [scale * values]), cmap="cividis", **style)
    axes.set_xlim(1e3 * (focus[0] - HALF_WIDTH), 1e3 * (focus[0] + HALF_WIDTH))
    axes.set_ylim(1e3 * (focus[2] - 0.7 * HALF_WIDTH), 1e3 * (focus[2] + 0.7 * HALF_WIDTH))
    axes.set_aspect("equal")
    axes.set_xlabel("x, rolling direction [mm]")
    axes.set_ylabel("z [mm]")
    figure.colorbar(image, label="von Mises stress on y = 0 [MPa]", shrink=0.8)
    os.makedirs(os.path.dirname(picture), exist_ok=True)
    figure.savefig(picture, dpi=160, bbox_inches="tight")
    print(picture)


def main():
    arguments = [argument for argument in sys.argv[1:] if not argument.startswith("-")]
    run = arguments[0] if arguments else os.environ.get("TREAD_RUN", ".")
    lists = sorted(glob.glob(os.path.join(run, "*.pvd")) + glob.glob(os.path.join(run, "*.xdmf")))
    if not lists:
        sys.exit(f"tread.py: no .pvd or .xdmf file in {run}")
    pictures = os.path.join(run, "pictures")
    batch = bool(arguments)
    remedy = "which pvpython of ParaView reads"
    try:
        import paraview
        import vtkmodules.vtkRenderingOpenGL2
        from vtkmodules.vtkRenderingCore import vtkRenderWindow

        # A ParaView that draws with X only, as Debian's, ends with a fault of memory without a display.
        alone = batch and not os.environ.get("DISPLAY") and vtkRenderWindow().GetClassName() == "vtkXOpenGLRenderWindow"
        remedy = "for which ParaView needs a display, as by xvfb-run"
    except ImportError:
        alone = True
    if alone:
        show_with_vtk([name for name in lists if name.endswith(".pvd")]
                      or sys.exit(f"tread.py: {run} has pictures in XDMF only, {remedy}"), pictures)
        return
    if batch:
        os.makedirs(pictures, exist_ok=True)
    show_in_paraview(lists, os.path.join(pictures, "paraview.png") if batch else None)


main()
