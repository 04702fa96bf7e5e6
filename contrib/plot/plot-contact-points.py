#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `tread --contact-points` left: where both wheels of a wheelset touch, contact angle, rolling radii and equivalent conicity over the shift.

    plot-contact-points.py FOLDER [--picture contact-points.png]
"""

import os

import numpy as np

from tread.commands import command_parser, run_command
from tread.files import read_table
from tread.plots import BLUE, GREEN, RED, plt, save, use_style


def broken(shift, values, jump):
    """The line with gaps where the contact jumps by more than so much from one shift to the next."""
    at = np.flatnonzero(np.abs(np.diff(values)) > jump) + 1
    return np.insert(shift, at, np.nan), np.insert(values, at, np.nan)


def main():
    parser = command_parser(__doc__)
    parser.add_argument("folder")
    parser.add_argument("--picture", help="default: contact-points.png in the folder")
    arguments = parser.parse_args()
    table = {name: np.asarray(values) for name, values in
             read_table(os.path.join(arguments.folder, "contact_points.csv"), ("lateral_shift_mm", "radius_difference_mm")).items()}
    shift = table["lateral_shift_mm"]
    use_style({"legend.fontsize": 9})
    figure, axes = plt.subplots(2, 2, figsize=(10, 6.6), sharex=True, constrained_layout=True)
    for side, colour, label in (("own", BLUE, "own wheel"), ("other", RED, "other wheel")):
        axes[0, 0].plot(*broken(shift, table[f"{side}_y_wheel_mm"], 2.), color=colour, label=f"{label}, on its profile")
        axes[0, 0].plot(*broken(shift, table[f"{side}_y_rail_mm"], 2.), color=colour, linestyle="--", label=f"{label}, on the rail")
        axes[0, 1].plot(*broken(shift, np.degrees(table[f"{side}_angle_rad"]), 8.), color=colour, label=label)
    axes[0, 0].set(ylabel="y of the contact, mm", ylim=(-48, 62))
    axes[0, 1].set(ylabel="contact angle, degrees")
    axes[1, 0].plot(*broken(shift, table["radius_difference_mm"], 2.), color=GREEN)
    axes[1, 0].set(xlabel="lateral shift to the own side, mm", ylabel="rolling radius difference, mm")
    one_side = (shift > 0) & np.isfinite(table["equivalent_conicity"])
    axes[1, 1].plot(shift[one_side], table["equivalent_conicity"][one_side], color=GREEN)
    axes[1, 1].set(xlabel="lateral shift, mm, or amplitude, mm", ylabel="equivalent conicity", ylim=(0, None))
    axes[0, 0].legend(loc="upper center", ncol=2, fontsize=8)
    axes[0, 1].legend()
    save(figure, arguments.picture or os.path.join(arguments.folder, "contact-points.png"), dpi=110)


if __name__ == "__main__":
    run_command(main)
