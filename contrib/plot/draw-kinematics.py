#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The picture of doc/kinematics.md: axes, angles and signs of a wheelset in its track.

    draw-kinematics.py [--picture doc/pictures/kinematics.png]
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Tuple, Union

import numpy as np

from tread.commands import command_parser, run_command
from tread.plots import BLUE, GREEN, ORANGE, PURPLE, RED, save, subplots, use_style
from tread.runs import ROOT

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# A wheel with its flange from the back of it outwards, mm: points of S1002, z up from the running circle.
WHEEL = np.array(((-70, -9.5), (-69.6, -13.5), (-66, -22), (-60.7, -26.6), (-55, -28), (-51, -27.3), (-47, -25), (-42.2, -20.4), (-40.8, -18.1),
                  (-38.2, -11.3), (-36, -7.5), (-32.8, -5.2), (-25.6, -2.6), (-17, -1.2), (-7.2, -.3), (3.6, .1), (14.7, .25), (33.9, .9),
                  (51.3, 2.05), (60, 2.6), (65, 7)))
Place = Union[Tuple[float, ...], np.ndarray]
TRACK = dict(arrowstyle="-|>", linewidth=1.4)


def arrow(axes: Axes, begin: Place, end: Place, text: str, colour: str, shift: tuple[float, float] = (0, 0), **more: Any) -> None:
    axes.annotate("", end, begin, arrowprops=dict(TRACK, color=colour))
    axes.text(end[0] + shift[0], end[1] + shift[1], text, color=colour, ha="center", va="center", **more)


def turning(axes: Axes, middle: Place, radius: float, from_degrees: float, to_degrees: float, text: str, colour: str,
            place: tuple[float, float]) -> None:
    angle = np.radians(np.linspace(from_degrees, to_degrees, 40))
    x, y = middle[0] + radius * np.cos(angle), middle[1] + radius * np.sin(angle)
    axes.plot(x[:-3], y[:-3], color=colour, linewidth=1.4)
    axes.annotate("", (x[-1], y[-1]), (x[-5], y[-5]), arrowprops=dict(TRACK, color=colour))
    axes.text(*place, text, color=colour, ha="center", va="center")


def from_behind(axes: Axes, rail: np.ndarray) -> None:
    """Both wheels, seen in rolling direction; the own side on the right of the page."""
    axes.set_title("seen along the track; the own side is drawn on the right")
    for side in (1, -1):
        shape = np.array([[-32, -40], *rail, [28, -40]])
        axes.fill(side * (300 + shape[:, 0]), shape[:, 1], color="#DDDDDD", edgecolor="black", linewidth=.8, zorder=1)
        wheel = np.vstack((WHEEL, [[65, 120], [-70, 120]]))
        roll = np.radians(-1.5)
        y, z = side * (292 + wheel[:, 0]) + 6, wheel[:, 1] + 2
        y, z = np.cos(roll) * y - np.sin(roll) * (z - 75), np.sin(roll) * y + np.cos(roll) * (z - 75) + 75
        axes.fill(y, z, color="#F4F4F4", edgecolor="black", linewidth=.8, zorder=2)
    y = np.array([-240, 240])
    axes.plot(y + 6, 75 + np.tan(roll) * y, color="black", linewidth=1, linestyle="-.")
    axes.axhline(0, color="#999999", linewidth=.6, zorder=0)
    axes.axvline(0, color="#999999", linewidth=.6, zorder=0)
    arrow(axes, (0, 0), (60, 0), "$y$", "black", (9, 0))
    arrow(axes, (0, 0), (0, 50), "$z$", "black", (-9, 0))
    axes.text(-12, -12, "$x$ into\nthe page", ha="right", va="center", fontsize=9)
    arrow(axes, (0, 108), (24, 108), "lateral shift > 0", RED, (52, 9))
    axes.plot([6, 6], [75, 103], color=RED, linewidth=.8, linestyle=":")
    turning(axes, (6, 75), 120, 12, -18, "roll > 0", RED, (158, 96))
    # Contact axes, much turned for the eye.
    foot, angle = np.array([283, -1.5]), np.radians(24)
    s, n = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    arrow(axes, foot, foot + 62 * s, "$s$", BLUE, (8, 5), zorder=5)
    arrow(axes, foot, foot + 62 * n, "$n$", BLUE, (-8, 5), zorder=5)
    turning(axes, foot, 44, 0, 24, r"$\delta > 0$", BLUE, (356, 8))
    axes.plot([foot[0], foot[0] + 70], [foot[1]] * 2, color=BLUE, linewidth=.7, linestyle=":", zorder=5)
    axes.set(xlim=(-400, 400), ylim=(-50, 135), aspect="equal")


def from_above(axes: Axes) -> None:
    axes.set_title("seen from above, much yawed")
    yaw = np.radians(14)
    turn = lambda x, y: (np.cos(yaw) * x - np.sin(yaw) * y, np.sin(yaw) * x + np.cos(yaw) * y)
    # The page's upward direction is x; the own side, +y, lies to the right: x and y exchanged.
    draw = lambda x, y, **more: axes.plot(y, x, **more)
    for side in (1, -1):
        draw(np.array([-110, 150]), np.array([75 * side] * 2), color="#BBBBBB", linewidth=7, solid_capstyle="butt", zorder=0)
        corners = [turn(x, 72 * side + y) for x, y in ((-42, -7), (42, -7), (42, 7), (-42, 7), (-42, -7))]
        draw(*np.array(corners).T, color="black", linewidth=1)
    draw(*np.array([turn(0, -95), turn(0, 95)]).T, color="black", linewidth=1, linestyle="-.")
    arrow(axes, (0, 0), (0, 130), "$x$, $V$", "black", (14, 4))
    arrow(axes, (0, 0), (125, 0), "$y$", "black", (8, 0))
    arrow(axes, (0, 0), tuple(reversed(turn(100, 0))), "yaw > 0", RED, (24, 7))
    turning(axes, (0, 0), 70, 90, 76, "", RED, (0, 0))
    place = tuple(reversed(turn(0, 73)))
    axes.plot([75, 112], [place[1]] * 2, color=PURPLE, linewidth=.8)
    axes.annotate("", (108, place[1]), (108, 0), arrowprops=dict(TRACK, color=PURPLE))
    axes.text(130, .5 * place[1] - 2, "x_m < 0", color=PURPLE, ha="center", va="center")
    end = tuple(reversed(turn(0, 73 + 32)))
    axes.annotate("", end, place, arrowprops=dict(TRACK, color=ORANGE))
    axes.text(end[0] + 3, end[1] - 9, r"axle, $\omega > 0$", color=ORANGE, ha="left")
    arrow(axes, (place[0], place[1] - 3), (place[0] - 36, place[1] - 3), "lateral creepage < 0", GREEN, (-34, -9))
    axes.set(xlim=(-110, 150), ylim=(-105, 150), aspect="equal")


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("--picture", default=os.path.join(ROOT, "doc", "pictures", "kinematics.png"))
    arguments = parser.parse_args()
    rail = np.loadtxt(os.path.join(ROOT, "prm", "curves", "profiles", "uic60-manchester.txt"))[::6] * (1, -1)
    use_style({"axes.grid": False, "axes.spines.left": False, "axes.spines.bottom": False, "xtick.bottom": False, "ytick.left": False,
               "xtick.labelbottom": False, "ytick.labelleft": False})
    figure, axes = subplots(1, 2, figsize=(13, 4.4), width_ratios=(2.3, 1))
    from_behind(axes[0], rail)
    from_above(axes[1])
    save(figure, arguments.picture)


if __name__ == "__main__":
    run_command(main)
