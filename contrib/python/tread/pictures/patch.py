# SPDX-License-Identifier: LGPL-2.1-or-later
"""The contact patch at the end of a run: axis, map and vectors, or patches of a wheelset in a position; stress below the surface."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, Patch as Swatch, Rectangle
from matplotlib.ticker import MaxNLocator

from ..files import reference_value
from ..patches import Patch, read_contact, read_patch, spacing
from ..plots import ADHESION, BLUE, GREEN, GREY, ORANGE, RED, SLIP, legend_beside, rolling_arrow, subplots
from ..runs import Run
from .titles import is_dynamic, patch_title

PATCH_COLUMNS = ("x_mm", "y_mm", "z_mm", "area_mm2", "pressure_MPa", "shear_x_MPa", "shear_y_MPa")


class Pictured:
    """A run's patch and what is drawn beside it."""

    def __init__(self, run: Run, contact_file: str | None):
        self.run, self.patch = run, run.patch
        self.half_space_only = run.summary.get("method") == "half-space solver"
        self.label = "half-space solver" if self.half_space_only else "tread"
        optional = lambda name: read_patch(run.path(name)) if run.has(name) and not self.half_space_only else None
        self.averaged, reference = optional("patch_averaged.csv"), optional("reference_patch.csv")
        self.references = []  # (label, patch, colour, line style)
        # Of a run whose force varies the patch is that of its last instant, and so is its load.
        self.force = 1e-3 * self.patch.normal_force if is_dynamic(run) else 1e-3 * run.summary["normal_force_N"]
        if reference is not None:
            self.references.append((f"half-space solver{self.other_load(reference)}", reference, ORANGE, "-"))
        if contact_file:
            patch = read_contact(contact_file)
            self.references.append((f"CONTACT, {patch.size_x:.2g} mm{self.other_load(patch)}", patch, "black", "--"))
        scale = {"semi_axis_x_m": 1e3, "semi_axis_y_m": 1e3, "max_pressure_Pa": 1e-6}
        hertz = [reference_value(run.summary, key, "Hertz") for key in scale]
        self.hertz = None if None in hertz else [value * factor for value, factor in zip(hertz, scale.values())]
        self.hertz_label = "Hertz"
        if self.hertz and is_dynamic(run):
            # The program takes Hertz's answer at the mean force of the last 10 mm; all of it grows with the cube root of the force.
            growth = (1e3 * self.force / run.summary["normal_force_N"]) ** (1 / 3)
            self.hertz = [growth * value for value in self.hertz]
            self.hertz_label = f"Hertz at {self.force:.1f} kN"
        self.y = 1e3 * run.summary.get("first_contact_y_m", 0.0)
        self.friction = run.summary.get("friction_coefficient") or self.patch.friction_coefficient()
        self.title = patch_title(run, self.patch)

    def other_load(self, patch: Patch) -> str:
        """A solution for another load is no answer to this run: words for its label that say for which it is."""
        force = 1e-3 * patch.normal_force
        return "" if abs(force / self.force - 1) < 0.01 else f", {force:.1f} kN"


def axis_profile(patch: Patch, values: np.ndarray, y: float) -> tuple[np.ndarray, np.ndarray]:
    """(x, values) on the line at y, with a zero at both ends: nodes out of contact carry nothing."""
    x, _, _ = patch.grid(values)
    result = patch.sampled(values, x, np.full_like(x, y))
    loaded = np.nonzero(patch.sampled(patch.pressure, x, np.full_like(x, y)) > 0)[0]
    span = slice(loaded[0] - 1, loaded[-1] + 2) if len(loaded) else slice(0, 0)
    return x[span], result[span]


def dominant(patch: Patch) -> str:
    """Along which axis the shear acts: x unless the lateral force is the larger."""
    along_x = abs((patch.shear_x * patch.area).sum()) >= abs((patch.shear_y * patch.area).sum())
    return "x" if along_x else "y"


def draw_axis(run: Pictured) -> Figure:
    patch, direction = run.patch, dominant(run.patch)
    name, positive = {"x": ("longitudinal", "forward"), "y": ("lateral", "to the field side")}[direction]
    figure, axes = subplots(3, 1, figsize=(9.4, 8.6), sharex=True)
    shear, slip = f"shear_{direction}", f"slip_{direction}"

    if run.hertz:
        a, _, p0 = run.hertz
        x = np.linspace(-a, a, 401)
        ellipse = p0 * np.sqrt(1 - (x / a) ** 2)
        axes[0].plot(x, ellipse, color=GREY, lw=3.5, alpha=0.45, label=run.hertz_label)
        if run.friction:
            sign = np.sign((getattr(patch, shear) * patch.area).sum()) or 1.0
            axes[1].plot(x, sign * run.friction * ellipse, color=GREY, lw=1.2, ls=":",
                         label=f"friction bound,\n{run.friction:.2g} x {run.hertz_label}")
    for row, field in enumerate(("pressure", shear, slip)):
        for label, other, colour, style in run.references:
            axes[row].plot(*axis_profile(other, getattr(other, field), run.y), color=colour, ls=style, label=label)
        axes[row].plot(*axis_profile(patch, getattr(patch, field), run.y), color=BLUE, label=run.label,
                       **({} if run.half_space_only else {"marker": "o", "ms": 3.6, "lw": 0.9}))
    if run.averaged is not None:
        axes[2].plot(*axis_profile(run.averaged, getattr(run.averaged, slip), run.y), color=RED, marker="s",
                     ms=3.0, lw=0.9, label="tread, mean of\none cell passage")
    axes[0].set_ylabel("pressure [MPa]")
    axes[1].set_ylabel(f"{name} shear stress\non the wheel [MPa], + {positive}")
    axes[2].set_ylabel(f"{name} micro-slip of wheel\nrelative to rail [m/s], + {positive}")
    axes[2].set_xlabel(f"x from the wheel, at y = {run.y:.3g} mm, where they first touch [mm]")
    axes[0].set_ylim(bottom=0)
    low, high = axes[2].get_ylim()
    axes[2].set_ylim(min(low, -1e-3), max(high, 1e-3))  # below a millimetre per second it is round-off
    for axis in axes:
        axis.axhline(0, color="#999999", lw=0.8, zorder=0)
        legend_beside(axis)
    drawn = [abs(other.x).max() + other.size_x for other in (patch, run.averaged) if other is not None]
    limit = 1.05 * max(*drawn, run.hertz[0] if run.hertz else 0)
    axes[0].set_xlim(-limit, limit)
    axes[0].set_title(run.title, pad=24)
    rolling_arrow(axes[0])
    figure.align_ylabels(axes)
    return figure


def patch_axes(axis: Axes, run: Pictured, patch: Patch) -> None:
    """Axes around a patch of the run and Hertz's ellipse."""
    a, b = run.hertz[:2] if run.hertz else (0, 0)
    if run.hertz:
        axis.add_patch(Ellipse((0, run.y), 2 * a, 2 * b, fill=False, ec="black", lw=1.3, zorder=4))
    x = 1.05 * max(abs(patch.x).max() + 0.5 * patch.size_x, a)
    low, high = min(patch.y.min() - 0.5 * patch.size_y, run.y - b), max(patch.y.max() + 0.5 * patch.size_y, run.y + b)
    axis.set_xlim(-x, x)
    axis.set_ylim(low - 0.06 * (high - low), high + 0.06 * (high - low))
    axis.set_aspect("equal")
    axis.grid(False)
    axis.set_xlabel("x from the wheel [mm]")
    axis.set_ylabel("y, + to the field side [mm]")


def adhesion_border(axis: Axes, patch: Patch, **style: Any) -> None:
    """The line on which adhesion gives way to slip; the barely loaded rim of the patch is left out."""
    loaded = patch.pressure > 0.2 * patch.pressure.max()
    x, y, adhesion = patch.grid(np.where(loaded, patch.adhesion.astype(float), np.nan))
    if len(set(patch.adhesion[loaded])) == 2:
        axis.contour(x, y, np.ma.masked_invalid(adhesion), levels=[0.5], **style)


def patch_border(axis: Axes, patch: Patch, **style: Any) -> None:
    """The outline of the contact."""
    x, y, inside = patch.grid(np.ones_like(patch.x))
    axis.contour(x, y, np.nan_to_num(inside), levels=[0.5], **style)


def draw_map(run: Pictured) -> Figure:
    patch = run.patch
    figure, axis = subplots(figsize=(7.2, 6.0))
    x, y, state = patch.grid(np.where(patch.adhesion, 0.0, 1.0))
    axis.pcolormesh(x, y, np.ma.masked_invalid(state), cmap=ListedColormap([ADHESION, SLIP]), vmin=0, vmax=1,
                    shading="nearest", edgecolors="white", linewidth=0.0 if run.half_space_only else 0.4)
    entries = [Swatch(fc=ADHESION, label=f"adhesion, {100 * patch.adhesion_share:.1f} % of the patch"),
               Swatch(fc=SLIP, label=f"slip, {100 * (1 - patch.adhesion_share):.1f} %")]
    patch_axes(axis, run, patch)
    if run.hertz:
        entries.append(Line2D([], [], color="black", lw=1.3, label=f"{run.hertz_label}: ellipse"))
    for label, other, colour, style in run.references:
        adhesion_border(axis, other, colors=colour, linewidths=1.8, linestyles=style)
        patch_border(axis, other, colors=colour, linewidths=1.2, linestyles=style)
        entries.append(Line2D([], [], color=colour, ls=style, lw=1.8, label="borders of patch and adhesion,\n" + label
                              + f" ({100 * other.adhesion_share:.1f} %)"))
    axis.legend(handles=entries, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=2)
    axis.set_title(run.title, pad=24)
    rolling_arrow(axis)
    return figure


def draw_vectors(run: Pictured) -> Figure:
    patch = run.patch
    slips = run.averaged if run.averaged is not None else patch
    figure, axes = subplots(1, 2, figsize=(13.2, 5.4))
    when = "mean of one cell passage" if slips is run.averaged else "at this instant"
    parts = ((patch, patch.shear, patch.shear_x, patch.shear_y, "shear stress on the wheel", "MPa", "Blues"),
             (slips, slips.slip, slips.slip_x, slips.slip_y, f"micro-slip of wheel relative to rail, {when}",
              "m/s", "Oranges"))
    for axis, (source, size, u, v, what, unit, colours) in zip(axes, parts):
        x, y, grid = source.grid(size)
        largest = size.max() or 1.0
        image = axis.pcolormesh(x, y, np.ma.masked_invalid(grid), cmap=colours, vmin=0, vmax=1.25 * largest,
                                shading="nearest")
        # At most about 28 arrows along the patch, on whole rows and columns of nodes.
        step = max(1, int(np.ceil(2 * abs(source.x).max() / source.size_x / 28)))
        columns = np.round((source.x - x[0]) / source.size_x).astype(int)
        rows = np.round((source.y - y[0]) / source.size_y).astype(int)
        centre = np.argmin(abs(y))
        shown = ((columns - np.argmin(abs(x))) % step == 0) & ((rows - centre) % step == 0) & (size > 0.01 * largest)
        axis.quiver(source.x[shown], source.y[shown], u[shown], v[shown], color="#222222", pivot="middle",
                    angles="xy", scale_units="xy", scale=largest / (1.35 * step * source.size_x), width=0.0022,
                    headwidth=4.5, headlength=5, headaxislength=4.5, zorder=3)
        patch_axes(axis, run, source)
        adhesion_border(axis, source, colors=GREEN, linewidths=1.6)
        bar = figure.colorbar(image, ax=axis, shrink=0.8, pad=0.02, boundaries=np.linspace(0, largest, 200),
                              ticks=MaxNLocator(6))
        bar.set_label(f"magnitude [{unit}]")
        axis.set_title(f"{what}\nlargest {largest:.3g} {unit}", pad=20)
        rolling_arrow(axis)
    entries = [Line2D([], [], color=GREEN, lw=1.6, label="border of adhesion")]
    if run.hertz:
        entries.append(Line2D([], [], color="black", lw=1.3, label=f"{run.hertz_label}: ellipse"))
    for axis in axes:
        axis.legend(handles=entries, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=2)
    figure.suptitle(run.title, x=0.01, ha="left", fontsize=10)
    return figure


def along_patch(table: dict[str, np.ndarray], patch: dict) -> tuple[np.ndarray, np.ndarray]:
    """Places in the contact axes of a patch: along its plane across the path, and off it (mm)."""
    y, z = table["y_mm"] - 1e3 * patch["y_rail_m"], table["z_mm"] - 1e3 * patch["z_m"]
    if patch.get("wheel") == "other":  # the table counts y from the middle of the own rail, to the own side
        y = 1e3 * (2. * patch["y_m"] + patch["y_rail_m"]) - table["y_mm"]
    c, s = np.cos(patch["angle_rad"]), np.sin(patch["angle_rad"])
    return c * y + s * z, c * z - s * y


def patch_numbers(run: Run, nodes: dict[str, np.ndarray], has_half_space: bool) -> tuple[np.ndarray, dict[str, np.ndarray], np.ndarray]:
    """Number of the patch of each node of patch.csv and of each element of the half-space beside it, whose plane holds it; without one of
    each node the patch whose plane is nearest."""
    half_space = run.table("reference_patch.csv", PATCH_COLUMNS) if has_half_space else nodes
    planes = [abs(along_patch(half_space, patch)[1]) for patch in run.summary["patches"]]
    owner = np.argmin(planes, axis=0)
    if not has_half_space:
        return owner, half_space, owner
    place = np.array([half_space["y_mm"], half_space["z_mm"]])
    nearest = [np.argmin(np.hypot(place[0] - y, place[1] - z)) for y, z in zip(nodes["y_mm"], nodes["z_mm"])]
    return owner[nearest], half_space, owner


def draw_patches(run: Run) -> Figure:
    """A row for each patch of a wheelset in a position: pressure, and shear stress where it adheres and where it slips."""
    has_half_space = "half_space_patches" in run.summary  # beside finite elements, in steady rolling
    nodes, patches = run.table("patch.csv", PATCH_COLUMNS), run.summary["patches"]
    numbers, half_space, owner = patch_numbers(run, nodes, has_half_space)
    figure, axes = subplots(len(patches), 2, figsize=(12.5, 1.9 + 3.8 * len(patches)), squeeze=False)
    largest_pressure, largest_shear = nodes["pressure_MPa"].max(), np.hypot(nodes["shear_x_MPa"], nodes["shear_y_MPa"]).max()
    for k, (patch, row) in enumerate(zip(patches, axes)):
        mine = numbers == k
        x, s, area = nodes["x_mm"][mine], along_patch(nodes, patch)[0][mine], nodes["area_mm2"][mine]
        width = spacing(x)
        boxes = [Rectangle((x0 - width / 2, s0 - a / width / 2), width, a / width) for x0, s0, a in zip(x, s, area)]
        filled = PatchCollection(boxes, cmap="viridis", lw=0)
        filled.set_array(nodes["pressure_MPa"][mine])
        filled.set_clim(0, largest_pressure)
        row[0].add_collection(filled)
        slips = nodes["state"][mine] == "slip"
        row[1].add_collection(PatchCollection(boxes, facecolors=np.where(slips, SLIP, ADHESION), lw=0))
        step = max(1, len(x) // 250)
        row[1].quiver(x[::step], s[::step], nodes["shear_x_MPa"][mine][::step], nodes["shear_y_MPa"][mine][::step], color="#222222",
                      pivot="middle", angles="xy", scale_units="xy", scale=largest_shear / max(1.0, 0.06 * np.ptp(x)), width=0.0025)
        if has_half_space:
            other = owner == k
            element = [1e3 * run.summary["half_space_patches"][k][f"element_{axis}_m"] for axis in "xy"]
            ex, es = half_space["x_mm"][other], along_patch(half_space, patch)[0][other]
            column, line = (np.round((v - v.min()) / h).astype(int) + 1 for v, h in zip((ex, es), element))
            inside = np.zeros((line.max() + 2, column.max() + 2))
            inside[line, column] = 1
            for axis in row:
                axis.contour(ex.min() + element[0] * (np.arange(inside.shape[1]) - 1), es.min() + element[1] * (np.arange(inside.shape[0]) - 1),
                             inside, levels=[0.5], colors=RED, linewidths=1.2)
        for axis in row:
            axis.autoscale_view()
            axis.set_aspect("equal", adjustable="datalim")
            axis.grid(False)
            axis.set_xlabel("x from the axle [mm]")
            axis.set_ylabel("s across, along the surface,\n+ to the field side [mm]")
            rolling_arrow(axis, -0.14)
        wheel = "other wheel" if patch.get("wheel") == "other" else "own wheel"
        text = (f"{wheel}, patch {k + 1}, {abs(1e3 * patch['y_rail_m']):.1f} mm to the {'gauge' if patch['y_rail_m'] < 0 else 'field'} side of the rail's middle\n"
                f"contact angle {np.degrees(patch['angle_rad']):.1f}°, normal force {1e-3 * patch['normal_force_N']:.2f} kN")
        if has_half_space:
            text += f" (half-space {1e-3 * run.summary['half_space_patches'][k]['normal_force_N']:.2f})"
        row[0].set_title(text)
        row[1].set_title(f"shear stress on the wheel, up to {np.hypot(nodes['shear_x_MPa'][mine], nodes['shear_y_MPa'][mine]).max():.0f} MPa\n"
                         f"adhesion {100 * patch['adhesion_share']:.0f} % (blue), slip (orange)")
        figure.colorbar(filled, ax=row[0], shrink=0.9).set_label("pressure [MPa]")
    if has_half_space:
        figure.legend(handles=[Line2D([], [], color=RED, lw=1.2, label="border of the half-space's patch")], loc="upper right")
    figure.suptitle(f"shift {1e3 * run.summary['lateral_shift_m']:g} mm, yaw {1e3 * run.summary['yaw_rad']:.3g} mrad, vertical force "
                    f"{1e-3 * run.summary['normal_force_N']:.2f} kN", x=0.01, ha="left", fontsize=10)
    return figure


def draw_depth(run: Pictured) -> Figure:
    depths = run.run.table("subsurface.csv", ("x_mm", "depth_mm", "von_mises_MPa"), text=("body", "line"))
    figure, axis = subplots(figsize=(7.4, 6.0))
    for body, colour in (("wheel", BLUE), ("rail", RED)):
        for line, style, place in (("centre", "-", "under the patch centre"), ("maximum", "--", "under x = {:.2f} mm")):
            rows = (depths["body"] == body) & (depths["line"] == line)
            if rows.any():
                axis.plot(depths["von_mises_MPa"][rows], depths["depth_mm"][rows], color=colour, ls=style,
                          label=f"{body}, " + place.format(depths["x_mm"][rows][0]))
    axis.invert_yaxis()
    axis.set_xlim(left=0)
    axis.set(xlabel="von Mises stress [MPa]", ylabel="depth below the surface [mm]", title=run.title)
    legend_beside(axis)
    return figure


def figures(run: Run, contact: str | None = None) -> Iterator[tuple[str, Figure]]:
    if "patches" in run.summary:
        yield "patches", draw_patches(run)
        return
    pictured = Pictured(run, contact)
    yield "axis", draw_axis(pictured)
    yield "map", draw_map(pictured)
    yield "vectors", draw_vectors(pictured)
    if pictured.half_space_only and run.has("subsurface.csv"):
        yield "depth", draw_depth(pictured)
