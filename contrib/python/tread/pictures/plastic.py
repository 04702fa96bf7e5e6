# SPDX-License-Identifier: LGPL-2.1-or-later
"""An elasto-plastic run beside its elastic twin: what figures 3.2.3 to 3.2.17 of the thesis show. Both need 'Output/Table depth (mm)'
above 0."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from ..files import DataError
from ..plots import BLUE, GREEN, ORANGE, PURPLE, RED, SKY, rolling_arrow, subplots
from ..runs import Run

SECTIONS_MM = (-4.3, 5.7)
DEPTH_MM = 0.7


class Tables(Run):
    def __init__(self, folder: str):
        super().__init__(folder)
        self.cells = self.table("rail_cells.csv", ("x_mm", "y_mm", "z_mm", "von_mises_MPa"))
        self.surface = self.table("rail_surface.csv", ("x_mm", "y_mm", "u_z_um"))

    def along(self, values: np.ndarray, y: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """x from the foremost to the last node of the line of nodes nearest to y, and the values there."""
        lines = np.unique(np.round(self.patch.y / self.patch.size_y))
        line = lines[np.argmin(abs(lines * self.patch.size_y - y))]
        on = np.round(self.patch.y / self.patch.size_y) == line
        order = np.argsort(self.patch.x[on])
        return self.patch.x[on][order], values[on][order]

    def across(self, values: np.ndarray, x: float) -> tuple[np.ndarray, np.ndarray]:
        y = np.linspace(-9, 9, 181)
        return y, self.patch.sampled(values, np.full_like(y, x), y)

    def level(self, depth: float, field: str) -> tuple[np.ndarray, np.ndarray]:
        """A field of the cells along x, under y = 0, interpolated to a depth (mm) between the layers of cells."""
        cells = self.cells
        near = abs(cells["y_mm"]) < 1.01 * abs(cells["y_mm"]).min()
        columns = {}
        for x, z, value in zip(cells["x_mm"][near], cells["z_mm"][near], cells[field][near]):
            columns.setdefault(round(x, 3), {}).setdefault(round(-z, 3), []).append(value)
        x_of, value_of = [], []
        for x in sorted(columns):
            depths = sorted(columns[x])
            if depths[0] > 2 * depth or len(depths) < 3:
                continue
            x_of.append(x)
            value_of.append(np.interp(depth, depths, [np.mean(columns[x][d]) for d in depths]))
        if not x_of:
            raise DataError(f"{self.path('rail_cells.csv')}: no three layers of cells around a depth of {depth:g} mm; smaller cells, or a larger 'Output/Table depth (mm)'")
        return np.array(x_of), np.array(value_of)

    def settlement(self) -> tuple[np.ndarray, np.ndarray]:
        line = abs(self.surface["y_mm"]) < 1e-6
        order = np.argsort(self.surface["x_mm"][line])
        return self.surface["x_mm"][line][order], self.surface["u_z_um"][line][order]

    def under(self, x: float, field: str) -> tuple[np.ndarray, np.ndarray]:
        """A field of the cells at x, y = 0 over the depth (mm)."""
        cells = self.cells
        # Cells beside y = 0 are twice as wide as their centre is away from it.
        size = abs(cells["y_mm"])
        at = (size < 5 * size.min()) & (abs(cells["x_mm"] - x) < 1.01 * size) & (abs(cells["z_mm"]) > 0.99 * size)
        depth = np.round(-cells["z_mm"][at], 3)
        levels = np.unique(depth)
        return levels, np.array([cells[field][at][depth == d].mean() for d in levels])


def table_lines(plastic: Tables, elastic: Tables, behind: float) -> Iterator[str]:
    """Lines of a Markdown table."""
    def outline(run: Tables) -> tuple[float, float, float, float]:
        p = run.patch
        return p.x.min(), p.x.max(), p.y.max() - p.y.min(), p.area.sum()

    def slip_on_axis(run: Tables) -> tuple[float, float]:
        x, adhesion = run.along(run.patch.adhesion.astype(float))
        return (x[0], x[adhesion > 0.5].min()) if (adhesion > 0.5).any() else (x[0], x[-1])

    def largest(run: Tables, field: str, level: float = DEPTH_MM) -> tuple[float, float]:
        x, value = run.level(level, field)
        i = np.argmax(np.where(abs(x) < 12, value, 0))
        return value[i], x[i]

    rows = []
    for name, run in (("elastic", elastic), ("elasto-plastic", plastic)):
        begin, end, width, area = outline(run)
        slip = slip_on_axis(run)
        stress, at = largest(run, "von_mises_MPa")
        x, value = run.level(DEPTH_MM, "von_mises_MPa")
        x_p, p = run.along(run.patch.pressure)
        rows.append((name, f"{begin:.1f} to {end:.1f}", f"{width:.1f}", f"{area:.1f}",
                     f"{run.patch.pressure.max():.0f}", f"{x_p[np.argmax(p)]:.1f}", f"{run.patch.shear.max():.0f}",
                     f"{slip[0]:.1f} to {slip[1]:.1f}", f"{stress:.0f} at {at:.1f}", f"{np.interp(behind, x, value):.0f}",
                     f"{run.summary['traction_coefficient']:.4f}", f"{run.summary['frictional_work_J']:.2f}",
                     f"{run.summary.get('plastic_work_J', 0.0):.2f}"))
    names = ("", "patch along x, mm", "its width, mm", "its area, mm2", "largest pressure, MPa", "at x, mm",
             "largest shear stress, MPa", "slip on y = 0, mm", "von Mises at 0.7 mm, MPa", f"behind, at {behind:.0f} mm",
             "traction coefficient", "frictional work, J", "plastic work, J")
    yield "| " + " | ".join(row[0] for row in [names] + rows) + " |"
    yield "|---|---|---|"
    for i in range(1, len(names)):
        yield "| " + " | ".join(row[i] for row in [names] + rows) + " |"
    x_p, u_p = plastic.settlement()
    x_e, u_e = elastic.settlement()
    yield f"| settlement at {behind:.0f} mm, um | | {np.interp(behind, x_e, u_e) - np.interp(behind, x_p, u_p):.2f} |"
    cells = plastic.cells
    wide = (cells["x_mm"] > -40) & (cells["x_mm"] < -15) & (abs(cells["z_mm"] + DEPTH_MM) < 0.4)
    yield f"| largest residual von Mises, x from -40 to -15 mm, at 0.4 to 1.1 mm, MPa | | {cells['von_mises_MPa'][wide].max():.0f} |"
    depth, strain = plastic.under(behind, "equivalent_plastic_strain_percent")
    yield f"| largest plastic strain there, % (at depth, mm) | | {strain.max():.3f} ({depth[np.argmax(strain)]:.2f}) |"


def draw_patch(runs: list[tuple[str, Tables, str]]) -> Figure:
    """@param runs (label, run, line style) each"""
    figure, axes = subplots(2, 3, figsize=(17, 9.4))
    for label, run, style in runs:
        patch = run.patch
        x, y, grid = patch.grid(np.ones(len(patch.x)))
        axes[0, 0].contour(x, y, np.nan_to_num(grid), [0.5], colors="black", linestyles=style)
        axes[0, 0].plot([], [], color="black", ls=style, label=f"patch, {label}")
        x, y, grid = patch.grid(patch.adhesion.astype(float))
        if np.nanmax(grid) > 0 and np.nanmin(grid) < 1:
            axes[0, 0].contour(x, y, np.nan_to_num(grid), [0.5], colors=GREEN, linestyles=style)
            axes[0, 0].plot([], [], color=GREEN, ls=style, label=f"adhesion, {label}")
        axes[0, 1].plot(*run.along(patch.pressure), BLUE, ls=style, label=f"pressure, {label}")
        axes[0, 1].plot(*run.along(patch.shear), RED, ls=style, label=f"shear stress, {label}")
        for axis, section in zip((axes[0, 2], axes[1, 0]), SECTIONS_MM):
            axis.plot(*run.across(patch.pressure, section), BLUE, ls=style, label=f"pressure, {label}")
            axis.plot(*run.across(patch.shear, section), RED, ls=style, label=f"shear stress, {label}")
            axis.set(title=f"across at x = {section} mm", xlabel="y, + to the field side [mm]", ylabel="stress [MPa]")
        axes[1, 1].plot(*run.along(patch.slip), ORANGE, ls=style, label=label)
        for section, colour in ((-0.3, SKY), (-3.4, GREEN), (-5.5, PURPLE)):
            axes[1, 2].plot(*run.across(patch.slip, section), colour, ls=style, label=f"x = {section} mm, {label}")
    axes[0, 0].set(xlabel="x from the wheel [mm]", ylabel="y, + to the field side [mm]", aspect="equal")
    rolling_arrow(axes[0, 0])
    axes[0, 1].set(title="along y = 0", xlabel="x from the wheel [mm]", ylabel="stress [MPa]")
    axes[1, 1].set(title="micro-slip along y = 0", xlabel="x from the wheel [mm]", ylabel="micro-slip [m/s]")
    axes[1, 2].set(title="micro-slip across", xlabel="y, + to the field side [mm]", ylabel="micro-slip [m/s]")
    for axis in axes.flat:
        axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=2)
    return figure


def draw_material(runs: list[tuple[str, Tables, str]]) -> Figure:
    figure, axes = subplots(1, 3, figsize=(17, 5.2))
    for label, run, style in runs:
        axes[0].plot(*run.settlement(), "black", ls=style, label=label)
        axes[2].plot(*run.level(DEPTH_MM, "von_mises_MPa"), BLUE, ls=style, label=label)
    (_, plastic, _), (_, elastic, _) = runs
    x, u = plastic.settlement()
    axes[0].plot(x, u - np.interp(x, *elastic.settlement()), RED, label="permanent (difference)")
    for at, colour in ((-25.0, BLUE), (-6.0, ORANGE)):
        depth, strain = plastic.under(at, "equivalent_plastic_strain_percent")
        axes[1].plot(strain, depth, color=colour, label=f"x = {at} mm")
    axes[1].invert_yaxis()
    axes[0].set(title="settlement of the rail's surface, y = 0", xlabel="x from the wheel, it rolls to the right [mm]", ylabel="u$_z$, + up [µm]", xlim=(-60, 30))
    axes[1].set(title="plastic strain in the rail, y = 0", xlabel="equivalent plastic strain [%]", ylabel="depth below the rail's surface [mm]")
    axes[2].set(title=f"von Mises stress in the rail at {DEPTH_MM} mm depth, y = 0", xlabel="x from the wheel, it rolls to the right [mm]", ylabel="von Mises stress [MPa]",
                xlim=(-40, 20))
    for axis in axes:
        axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncol=3)
    return figure


def figures_of(plastic: Tables, elastic: Tables) -> Iterator[tuple[str, Figure]]:
    runs = [("elasto-plastic", plastic, "-"), ("elastic", elastic, "--")]
    yield "plastic-patch", draw_patch(runs)
    yield "plastic-material", draw_material(runs)
