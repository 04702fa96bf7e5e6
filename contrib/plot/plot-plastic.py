#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw an elasto-plastic run beside its elastic twin: what figures 3.2.3 to 3.2.17 of the thesis show.

    plot-plastic.py PLASTIC_DIR ELASTIC_DIR [--output DIR]

Both runs need 'Output/Table depth (mm)' above 0. Writes pictures and prints the figures of merit:
  patch.png     outlines of patch and adhesion area, pressure along and across the patch, shear, micro-slip
  material.png  settlement, plastic strain by depth, von Mises at 0.7 mm depth
"""

import argparse
import os

import numpy as np

from tread.commands import run_command
from tread.plots import plt, save
from tread.runs import Run

SECTIONS_MM = (-4.3, 5.7)
DEPTH_MM = 0.7


class Tables(Run):
    def __init__(self, folder):
        super().__init__(folder)
        self.cells = self.table("rail_cells.csv", ("x_mm", "y_mm", "z_mm", "von_mises_MPa"))
        self.surface = self.table("rail_surface.csv", ("x_mm", "y_mm", "u_z_um"))

    def along(self, values, y=0.0):
        """x from the foremost to the last node of the line of nodes nearest to y, and the values there."""
        lines = np.unique(np.round(self.patch.y / self.patch.size_y))
        line = lines[np.argmin(abs(lines * self.patch.size_y - y))]
        on = np.round(self.patch.y / self.patch.size_y) == line
        order = np.argsort(self.patch.x[on])
        return self.patch.x[on][order], values[on][order]

    def across(self, values, x):
        y = np.linspace(-9, 9, 181)
        return y, self.patch.sampled(values, np.full_like(y, x), y)

    def level(self, depth, field):
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
        return np.array(x_of), np.array(value_of)

    def settlement(self):
        line = abs(self.surface["y_mm"]) < 1e-6
        order = np.argsort(self.surface["x_mm"][line])
        return self.surface["x_mm"][line][order], self.surface["u_z_um"][line][order]

    def under(self, x, field):
        """A field of the cells at x, y = 0 over the depth (mm)."""
        cells = self.cells
        # Cells beside y = 0 are twice as wide as their centre is away from it.
        size = abs(cells["y_mm"])
        at = (size < 5 * size.min()) & (abs(cells["x_mm"] - x) < 1.01 * size) & (abs(cells["z_mm"]) > 0.99 * size)
        depth = np.round(-cells["z_mm"][at], 3)
        levels = np.unique(depth)
        return levels, np.array([cells[field][at][depth == d].mean() for d in levels])


def figures(plastic, elastic, behind):
    """Lines of a Markdown table."""
    def outline(run):
        p = run.patch
        return p.x.min(), p.x.max(), p.y.max() - p.y.min(), p.area.sum()

    def slip_on_axis(run):
        x, adhesion = run.along(run.patch.adhesion.astype(float))
        return (x[0], x[adhesion > 0.5].min()) if (adhesion > 0.5).any() else (x[0], x[-1])

    def largest(run, field, level=DEPTH_MM):
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


def draw_patch(runs):
    figure, axes = plt.subplots(2, 3, figsize=(15, 8.5))
    for label, run, style in runs:
        patch = run.patch
        x, y, grid = patch.grid(np.ones(len(patch.x)))
        axes[0, 0].contour(x, y, np.nan_to_num(grid), [0.5], colors="black", linestyles=style)
        x, y, grid = patch.grid(patch.adhesion.astype(float))
        if np.nanmax(grid) > 0 and np.nanmin(grid) < 1:
            axes[0, 0].contour(x, y, np.nan_to_num(grid), [0.5], colors="tab:green", linestyles=style)
        axes[0, 1].plot(*run.along(patch.pressure), "tab:blue", ls=style, label=f"pressure, {label}")
        axes[0, 1].plot(*run.along(patch.shear), "tab:red", ls=style, label=f"shear stress, {label}")
        for axis, section in zip((axes[0, 2], axes[1, 0]), SECTIONS_MM):
            axis.plot(*run.across(patch.pressure, section), "tab:blue", ls=style, label=f"pressure, {label}")
            axis.plot(*run.across(patch.shear, section), "tab:red", ls=style, label=f"shear stress, {label}")
            axis.set(title=f"across at x = {section} mm", xlabel="y, mm", ylabel="MPa")
        axes[1, 1].plot(*run.along(patch.slip), "tab:orange", ls=style, label=label)
        for section, colour in ((-0.3, "tab:cyan"), (-3.4, "tab:olive"), (-5.5, "tab:purple")):
            axes[1, 2].plot(*run.across(patch.slip, section), colour, ls=style, label=f"x = {section} mm, {label}")
    axes[0, 0].set(title="patch (black), adhesion (green)", xlabel="x, mm", ylabel="y, mm", aspect="equal")
    axes[0, 1].set(title="y = 0", xlabel="x, mm", ylabel="MPa")
    axes[1, 1].set(title="micro-slip, y = 0", xlabel="x, mm", ylabel="m/s")
    axes[1, 2].set(title="micro-slip across", xlabel="y, mm", ylabel="m/s")
    return figure, axes


def draw_material(runs):
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.5))
    for label, run, style in runs:
        axes[0].plot(*run.settlement(), "black", ls=style, label=label)
        axes[2].plot(*run.level(DEPTH_MM, "von_mises_MPa"), "tab:blue", ls=style, label=label)
    (_, plastic, _), (_, elastic, _) = runs
    x, u = plastic.settlement()
    axes[0].plot(x, u - np.interp(x, *elastic.settlement()), "tab:red", label="permanent (difference)")
    for at in (-25.0, -6.0):
        depth, strain = plastic.under(at, "equivalent_plastic_strain_percent")
        axes[1].plot(strain, -depth, label=f"x = {at} mm")
    axes[0].set(title="rail surface, y = 0", xlabel="x, mm", ylabel="u_z, um", xlim=(-60, 30))
    axes[1].set(title="equivalent plastic strain, y = 0", xlabel="%", ylabel="z, mm")
    axes[2].set(title=f"von Mises at {DEPTH_MM} mm depth, y = 0", xlabel="x, mm", ylabel="MPa", xlim=(-40, 20))
    return figure, axes


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("plastic")
    parser.add_argument("elastic")
    parser.add_argument("--output", help="folder of the pictures; default: PLASTIC_DIR/pictures")
    parser.add_argument("--behind", type=float, default=-25.0, help="x (mm) where what remains is read")
    arguments = parser.parse_args()
    folder = arguments.output or os.path.join(arguments.plastic, "pictures")
    plastic, elastic = Tables(arguments.plastic), Tables(arguments.elastic)
    runs = [("elasto-plastic", plastic, "-"), ("elastic", elastic, "--")]
    for name, draw in (("patch", draw_patch), ("material", draw_material)):
        figure, axes = draw(runs)
        for axis in np.ravel(axes):
            if axis.get_legend_handles_labels()[0]:
                axis.legend(fontsize=8)
            axis.grid(alpha=0.3)
        figure.tight_layout()
        save(figure, os.path.join(folder, f"plastic-{name}.png"), dpi=80)
    print("\n".join(figures(plastic, elastic, arguments.behind)))


if __name__ == "__main__":
    run_command(main)
