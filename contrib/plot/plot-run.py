#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of a run of tread, written to RUN_DIR/pictures:

  axis.png      pressure, shear stress and micro-slip along the longitudinal axis of the patch
  map.png       adhesion and slip areas
  vectors.png   shear stress on the wheel and micro-slip
  forces.png    forces, traction coefficient and creepage over the rolled position
  energies.png  energy ledger over time
  depth.png     stress below the surface, if the run has subsurface.csv (tread --reference-only)
  patches.png   instead of the first three where the wheelset has a position: each patch in its contact axes

Lines and borders of reference_patch.csv, the half-space answer at the same forces, are drawn beside. A run without
history.csv (tread --reference-only) has no pictures over time.
"""

import argparse
import os

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.collections import PatchCollection
from matplotlib.colors import ListedColormap
from matplotlib.patches import Ellipse, Patch as Swatch, Rectangle
from matplotlib.ticker import MaxNLocator

from tread.commands import run_command
from tread.patches import read_contact, read_patch, spacing
from tread.plots import BLUE, GREEN, ORANGE, PURPLE, RED, SKY, plt, save, use_style
from tread.files import reference_value
from tread.runs import Run

PATCH_COLUMNS = ("x_mm", "y_mm", "z_mm", "area_mm2", "pressure_MPa", "shear_x_MPa", "shear_y_MPa")
GREY, ADHESION, SLIP = "#666666", "#A9CBE3", "#F3B77E"

use_style({"axes.labelsize": 10, "legend.fontsize": 9, "grid.linewidth": 0.7, "lines.linewidth": 1.6, "figure.dpi": 100,
           "savefig.dpi": 160, "savefig.bbox": "tight", "font.family": "DejaVu Sans"})


class Pictured(Run):
    """All that the pictures need."""

    def __init__(self, folder, contact_file):
        super().__init__(folder)
        self.half_space_only = self.summary.get("method") == "half-space solver"
        self.label = "half-space solver" if self.half_space_only else "tread"
        self.averaged = self.reference = self.history = self.depths = None
        if self.half_space_only:
            if self.has("subsurface.csv"):
                self.depths = self.table("subsurface.csv", ("x_mm", "depth_mm", "von_mises_MPa"), text=("body", "line"))
        else:
            self.averaged = self.optional("patch_averaged.csv")
            self.reference = self.optional("reference_patch.csv")
            self.history = self.table("history.csv", ("time_s",))
            # A single row is a point, not a line.
            self.marker = "o" if len(self.history["time_s"]) < 3 else None
        # Of a wheelset in a position, whose patches have axes of their own.
        self.patch_table = self.table("patch.csv", PATCH_COLUMNS) if "patches" in self.summary else None
        self.references = []  # (label, patch, colour, line style)
        if self.reference is not None:
            self.references.append(("half-space solver", self.reference, ORANGE, "-"))
        if contact_file:
            patch = read_contact(contact_file)
            # A solution for another load is no answer to this run; its label says for which.
            force = 1e-3 * (patch.pressure * patch.area).sum()  # MPa and mm2 give N
            own = 1e-3 * self.summary["normal_force_N"]
            load = "" if abs(force / own - 1) < 0.01 else f", {force:.0f} kN"
            self.references.append((f"CONTACT, {patch.size_x:.2g} mm{load}", patch, "black", "--"))

        scale = {"semi_axis_x_m": 1e3, "semi_axis_y_m": 1e3, "max_pressure_Pa": 1e-6}
        hertz = [reference_value(self.summary, key, "Hertz") for key in scale]
        self.hertz = None
        if None in hertz and "patches" not in self.summary:
            print("note: summary.json has no Hertz values; drawn without")
        elif None not in hertz:
            self.hertz = [value * factor for value, factor in zip(hertz, scale.values())]
        self.y = 1e3 * self.summary.get("first_contact_y_m", 0.0)
        self.missing = []
        self.friction = self.summary.get("friction_coefficient") or self.patch.friction_coefficient()

    def optional(self, name):
        if self.has(name):
            return read_patch(self.path(name))
        print(f"note: no {name}; drawn without")
        return None

    def title(self):
        parts = []
        for key, template, factor in (("normal_force_N", "normal force {:.1f} kN", 1e-3),
                                      ("traction_coefficient", "traction coefficient {:.3f}", 1.0),
                                      ("creepage", "creepage {:.3f} %", 100.0)):
            if isinstance(self.summary.get(key), (int, float)):
                parts.append(template.format(self.summary[key] * factor))
        parts.append(f"{'elements' if self.half_space_only else 'cells'} {self.patch.size_x:.2f} mm")
        return ", ".join(parts)


def rolling_arrow(axes, y=1.04):
    axes.annotate("", xy=(1.0, y), xytext=(0.84, y), xycoords="axes fraction",
                  arrowprops=dict(arrowstyle="-|>", color="black", lw=1.2, mutation_scale=12))
    axes.text(0.83, y, "rolling direction", transform=axes.transAxes, ha="right", va="center", fontsize=9)


def axis_profile(patch, values, y):
    """(x, values) on the line at y, with a zero at both ends: nodes out of contact carry nothing."""
    x, _, _ = patch.grid(values)
    result = patch.sampled(values, x, np.full_like(x, y))
    loaded = np.nonzero(patch.sampled(patch.pressure, x, np.full_like(x, y)) > 0)[0]
    span = slice(loaded[0] - 1, loaded[-1] + 2) if len(loaded) else slice(0, 0)
    return x[span], result[span]


def dominant(patch):
    """Along which axis the shear acts: x unless the lateral force is the larger."""
    along_x = abs((patch.shear_x * patch.area).sum()) >= abs((patch.shear_y * patch.area).sum())
    return "x" if along_x else "y"


def draw_axis(run):
    patch, direction = run.patch, dominant(run.patch)
    name = {"x": "longitudinal", "y": "lateral"}[direction]
    figure, axes = plt.subplots(3, 1, figsize=(7.6, 8.6), sharex=True)
    shear, slip = f"shear_{direction}", f"slip_{direction}"

    if run.hertz:
        a, _, p0 = run.hertz
        x = np.linspace(-a, a, 401)
        ellipse = p0 * np.sqrt(1 - (x / a) ** 2)
        axes[0].plot(x, ellipse, color=GREY, lw=3.5, alpha=0.45, label="Hertz")
        if run.friction:
            sign = np.sign((getattr(patch, shear) * patch.area).sum()) or 1.0
            axes[1].plot(x, sign * run.friction * ellipse, color=GREY, lw=1.2, ls=":",
                         label=f"friction bound, {run.friction:.2g} x Hertz")
    for row, field in enumerate(("pressure", shear, slip)):
        for label, other, colour, style in run.references:
            axes[row].plot(*axis_profile(other, getattr(other, field), run.y), color=colour, ls=style, lw=1.4,
                           label=label)
        axes[row].plot(*axis_profile(patch, getattr(patch, field), run.y), color=BLUE, label=run.label,
                       **({"lw": 1.6} if run.half_space_only else {"marker": "o", "ms": 3.6, "lw": 0.9}))
    if run.averaged is not None:
        axes[2].plot(*axis_profile(run.averaged, getattr(run.averaged, slip), run.y), color=RED, marker="s",
                     ms=3.0, lw=0.9, label="tread, mean of one cell passage")
    entries = {label: handle for axis in axes for handle, label in zip(*axis.get_legend_handles_labels())}

    axes[0].set_ylabel("pressure [MPa]")
    axes[1].set_ylabel(f"{name} shear stress\non the wheel [MPa]")
    axes[2].set_ylabel(f"{name} micro-slip of wheel\nrelative to rail [m/s]")
    axes[2].set_xlabel(f"x from the wheel, at y = {run.y:.3g} mm, where they first touch [mm]")
    axes[0].set_ylim(bottom=0)
    axes[2].legend(entries.values(), entries.keys(), loc="upper center", bbox_to_anchor=(0.47, -0.22), ncol=3)
    for axis in axes:
        axis.axhline(0, color="#999999", lw=0.8, zorder=0)
    limit = 1.12 * max(abs(patch.x).max(), run.hertz[0] if run.hertz else 0)
    axes[0].set_xlim(-limit, limit)
    axes[0].set_title(run.title(), loc="left", pad=24)
    rolling_arrow(axes[0])
    figure.align_ylabels(axes)
    return figure


def patch_axes(axis, run):
    a, b = run.hertz[:2] if run.hertz else (0, 0)
    if run.hertz:
        axis.add_patch(Ellipse((0, run.y), 2 * a, 2 * b, fill=False, ec="black", lw=1.3, zorder=4))
    x = 1.12 * max(abs(run.patch.x).max(), a)
    low, high = min(run.patch.y.min(), run.y - b), max(run.patch.y.max(), run.y + b)
    axis.set_xlim(-x, x)
    axis.set_ylim(low - 0.06 * (high - low), high + 0.06 * (high - low))
    axis.set_aspect("equal")
    axis.grid(False)
    axis.set_xlabel("x, rolling direction [mm]")
    axis.set_ylabel("y, lateral [mm]")


def adhesion_border(axis, patch, **style):
    """The line on which adhesion gives way to slip; the barely loaded rim of the patch is left out."""
    loaded = patch.pressure > 0.2 * patch.pressure.max()
    x, y, adhesion = patch.grid(np.where(loaded, patch.adhesion.astype(float), np.nan))
    if 0 < patch.adhesion.sum() < len(patch.adhesion):
        axis.contour(x, y, np.ma.masked_invalid(adhesion), levels=[0.5], **style)


def patch_border(axis, patch, **style):
    """The outline of the contact."""
    x, y, inside = patch.grid(np.ones_like(patch.x))
    axis.contour(x, y, np.nan_to_num(inside), levels=[0.5], **style)


def draw_map(run):
    patch = run.patch
    figure, axis = plt.subplots(figsize=(7.2, 5.6))
    x, y, state = patch.grid(np.where(patch.adhesion, 0.0, 1.0))
    axis.pcolormesh(x, y, np.ma.masked_invalid(state), cmap=ListedColormap([ADHESION, SLIP]), vmin=0, vmax=1,
                    shading="nearest", edgecolors="white", linewidth=0.0 if run.half_space_only else 0.4)
    entries = [Swatch(fc=ADHESION, label=f"adhesion, {100 * patch.adhesion_share:.1f} % of the patch"),
               Swatch(fc=SLIP, label=f"slip, {100 * (1 - patch.adhesion_share):.1f} %")]
    patch_axes(axis, run)
    if run.hertz:
        entries.append(Line2D([], [], color="black", lw=1.3, label="Hertz ellipse"))
    for label, other, colour, style in run.references:
        adhesion_border(axis, other, colors=colour, linewidths=1.8, linestyles=style)
        patch_border(axis, other, colors=colour, linewidths=1.2, linestyles=style)
        entries.append(Line2D([], [], color=colour, ls=style, lw=1.8, label="borders of patch and adhesion,\n" + label
                              + f" ({100 * other.adhesion_share:.1f} %)"))
    axis.legend(handles=entries, loc="upper center", bbox_to_anchor=(0.5, -0.13), ncol=2)
    axis.set_title(run.title(), loc="left", pad=24)
    rolling_arrow(axis)
    return figure


def draw_vectors(run):
    patch = run.patch
    slips = run.averaged if run.averaged is not None else patch
    figure, axes = plt.subplots(1, 2, figsize=(13.2, 5.4))
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
        patch_axes(axis, run)
        adhesion_border(axis, source, colors=GREEN, linewidths=1.6)
        bar = figure.colorbar(image, ax=axis, shrink=0.8, pad=0.02, boundaries=np.linspace(0, largest, 200),
                              ticks=MaxNLocator(6))
        bar.set_label(f"magnitude [{unit}]")
        axis.set_title(f"{what}\nlargest {largest:.3g} {unit}", loc="left", pad=20)
        rolling_arrow(axis)
    entries = [Line2D([], [], color=GREEN, lw=1.6, label="adhesion border")]
    if run.hertz:
        entries.append(Line2D([], [], color="black", lw=1.3, label="Hertz ellipse"))
    figure.legend(handles=entries, loc="lower center", ncol=2, bbox_to_anchor=(0.5, 0.04))
    figure.subplots_adjust(wspace=0.16)
    return figure


def patch_numbers(run):
    """Number of the patch of each node of patch.csv and of each element of the half-space, whose plane holds it."""
    half_space = run.patch_table if run.half_space_only else run.table("reference_patch.csv", PATCH_COLUMNS)
    planes = [abs(along_patch(half_space, patch)[1]) for patch in run.summary["patches"]]
    owner = np.argmin(planes, axis=0)
    if run.half_space_only:
        return owner, half_space, owner
    place = np.array([half_space["y_mm"], half_space["z_mm"]])
    nearest = [np.argmin(np.hypot(place[0] - y, place[1] - z)) for y, z in zip(run.patch_table["y_mm"], run.patch_table["z_mm"])]
    return owner[nearest], half_space, owner


def along_patch(table, patch):
    """Places in the contact axes of a patch: along its plane across the path, and off it (mm)."""
    y, z = table["y_mm"] - 1e3 * patch["y_rail_m"], table["z_mm"] - 1e3 * patch["z_m"]
    if patch.get("wheel") == "other":  # the table counts y from the middle of the own rail, to the own side
        y = 1e3 * (2. * patch["y_m"] + patch["y_rail_m"]) - table["y_mm"]
    c, s = np.cos(patch["angle_rad"]), np.sin(patch["angle_rad"])
    return c * y + s * z, c * z - s * y


def draw_patches(run):
    """A row for each patch: pressure, and shear stress where it adheres and where it slips."""
    nodes, patches = run.patch_table, run.summary["patches"]
    numbers, half_space, owner = patch_numbers(run)
    figure, axes = plt.subplots(len(patches), 2, figsize=(11.5, 1.5 + 3.6 * len(patches)), squeeze=False, layout="constrained")
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
        if not run.half_space_only:
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
            axis.set_xlabel("x from the axle, rolling direction [mm]")
            axis.set_ylabel("s, along the surface [mm]")
        text = f"patch {k + 1}{' of the other wheel' if patch.get('wheel') == 'other' else ''}: contact angle {np.degrees(patch['angle_rad']):.1f}°, normal force {1e-3 * patch['normal_force_N']:.2f} kN"
        if not run.half_space_only:
            text += f" (half-space {1e-3 * run.summary['half_space_patches'][k]['normal_force_N']:.2f})"
        row[0].set_title(text, loc="left", fontsize=9)
        row[1].set_title(f"shear stress on the wheel; adhesion {100 * patch['adhesion_share']:.0f} % (blue), slip (orange)", loc="left", fontsize=9)
        figure.colorbar(filled, ax=row[0], shrink=0.9).set_label("pressure [MPa]")
    if not run.half_space_only:
        axes[0, 0].legend(handles=[Line2D([], [], color=RED, lw=1.2, label="border of the half-space's patch")], loc="lower right")
    figure.suptitle(f"shift {1e3 * run.summary['lateral_shift_m']:g} mm, yaw {1e3 * run.summary['yaw_rad']:.3g} mrad, vertical force "
                    f"{1e-3 * run.summary['normal_force_N']:.2f} kN", fontsize=10)
    return figure


def draw_depth(run):
    depths = run.depths
    figure, axes = plt.subplots(figsize=(6.0, 6.4))
    for body, colour in (("wheel", BLUE), ("rail", RED)):
        for line, style, place in (("centre", "-", "under the patch centre"), ("maximum", "--", "under x = {:.2f} mm")):
            rows = (depths["body"] == body) & (depths["line"] == line)
            if rows.any():
                axes.plot(depths["von_mises_MPa"][rows], depths["depth_mm"][rows], color=colour, ls=style,
                          label=f"{body}, " + place.format(depths["x_mm"][rows][0]))
    axes.invert_yaxis()
    axes.set_xlim(left=0)
    axes.set_xlabel("von Mises stress [MPa]")
    axes.set_ylabel("depth below the surface [mm]")
    axes.set_title(run.title(), loc="left", fontsize=8)
    axes.legend(loc="lower right")
    return figure


def column(run, name):
    values = run.history.get(name)
    if values is None:
        run.missing.append(name)
    return values


def centred_limits(axis, values, share):
    """Let the axis span at least +-share of the last value, so that round-off is not drawn as an event."""
    low, high = np.nanmin(values), np.nanmax(values)
    middle = values[-1]
    axis.set_ylim(min(low, middle - share * abs(middle)), max(high, middle + share * abs(middle)))
    axis.margins(y=0.05)


def draw_forces(run):
    history = run.history
    position = column(run, "position_m")
    x, label = ((history["time_s"] * 1e3, "time [ms]") if position is None
                else (position * 1e3, "position of the wheel along the rail [mm]"))
    figure, axes = plt.subplots(3, 1, figsize=(7.2, 8.0), sharex=True)
    for name, text, colour, style in (("normal_force_N", "normal", BLUE, "-"),
                                      ("longitudinal_force_N", "longitudinal, on the wheel", RED, "-"),
                                      ("lateral_force_N", "lateral, on the wheel", GREEN, "--")):
        values = column(run, name)
        if values is not None:
            axes[0].plot(x, values / 1e3, color=colour, ls=style, marker=run.marker,
                         label=f"{text} (at the end {values[-1] / 1e3:.2f} kN)")
    axes[0].set_ylabel("contact force [kN]")
    for axis, name, factor, text, colour in ((axes[1], "traction_coefficient", 1.0, "traction coefficient [-]", PURPLE),
                                             (axes[2], "creepage", 100.0, "creepage [%]", ORANGE)):
        values = column(run, name)
        axis.set_ylabel(text)
        if values is None:
            continue
        axis.plot(x, factor * values, color=colour, marker=run.marker, label=f"at the end {factor * values[-1]:.4f}")
        wanted = reference_value(run.summary, name)
        if wanted is not None:
            axis.axhline(factor * wanted, color="black", ls="--", lw=1.1, label=f"reference {factor * wanted:.4f}")
        if name == "creepage":
            centred_limits(axis, factor * values, 0.1)
    axes[2].set_xlabel(label)
    axes[0].set_title(run.title(), loc="left")
    for axis in axes:
        if axis.get_legend_handles_labels()[0]:
            axis.legend(loc="best")
    figure.align_ylabels(axes)
    return figure


def draw_energies(run):
    history = run.history
    time = history["time_s"] * 1e3
    figure, axes = plt.subplots(3, 1, figsize=(7.2, 8.4), sharex=True)
    large = (("external_work_J", "external work", "black", "-"),
             ("kinetic_energy_J", "kinetic energy, change", BLUE, "-"),
             ("internal_energy_J", "internal (elastic)", GREEN, "-"),
             ("frictional_work_J", "frictional work", RED, "-"))
    small = (("hourglass_energy_J", "hourglass", PURPLE, "-"),
             ("damping_work_J", "damping", ORANGE, "-"),
             ("contact_loss_J", "contact loss", SKY, "-"))
    scale = 0.0
    for axis, group in ((axes[0], large), (axes[1], small)):
        for name, label, colour, style in group:
            values = column(run, name)
            if values is None:
                continue
            if name == "kinetic_energy_J":
                values = values - values[0]
            if axis is axes[0]:
                scale = max(scale, abs(values).max())
            axis.plot(time, values, color=colour, ls=style, marker=run.marker, label=f"{label}\n({values[-1]:.3g} J)")
        axis.set_ylabel("energy [J]")
        if axis.get_legend_handles_labels()[0]:
            axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), title="(value at the end)", title_fontsize=9)
    residual = column(run, "energy_residual_J")
    if residual is not None and scale > 0:
        share = 100 * residual / scale
        axes[2].plot(time, share, color=BLUE, marker=run.marker)
        axes[2].axhspan(-0.1, 0.1, color="#DDEBDD", zorder=0)
        axes[2].text(0.99, 0.94, "shaded: $\\pm$0.1 %", transform=axes[2].transAxes, ha="right", va="top", fontsize=9)
        limit = max(0.15, 1.1 * abs(share).max())
        axes[2].set_ylim(-limit, limit)
    axes[2].set_ylabel("residual of the balance [%\nof the largest term above]")
    axes[2].set_xlabel("time [ms]")
    axes[0].set_title(run.title(), loc="left")
    figure.align_ylabels(axes)
    return figure


def main():
    parser = argparse.ArgumentParser(description="Draw the pictures of a run of tread into RUN_DIR/pictures.")
    parser.add_argument("run", metavar="RUN_DIR")
    parser.add_argument("--contact", metavar="FILE", help="surface file of CONTACT (.csv or .csv.gz) to compare with")
    arguments = parser.parse_args()
    run = Pictured(arguments.run, arguments.contact)
    pictures = ([("axis", draw_axis), ("map", draw_map), ("vectors", draw_vectors)] if run.patch_table is None
                else [("patches", draw_patches)])
    if run.half_space_only:
        pictures += [("depth", draw_depth)] if run.depths is not None else []
    elif len(run.history["time_s"]):
        pictures += [("forces", draw_forces), ("energies", draw_energies)]
    else:
        print("note: history.csv has no rows; drawn without forces and energies")
    for name, draw in pictures:
        path = run.path(os.path.join("pictures", name + ".png"))
        save(draw(run), path)
        print(path)
    if run.missing:
        print(f"note: history.csv has no {', '.join(run.missing)}; drawn without")


if __name__ == "__main__":
    run_command(main)
