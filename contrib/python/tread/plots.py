# SPDX-License-Identifier: LGPL-2.1-or-later
"""What pictures have in common: they go to files, in colours that the colour-blind can tell apart."""

import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Okabe and Ito's.
BLUE, SKY, ORANGE, GREEN, RED, PURPLE, YELLOW = (
    "#0072B2", "#56B4E9", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#F0E442")
COLOURS = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY, "black")  # of lines, one after the other
GRID = "#E3E3E3"


def use_style(more):
    """Light grid behind the lines, no frames, and more of matplotlib's rcParams."""
    plt.rcParams.update({"font.size": 10, "axes.titlesize": 10, "axes.grid": True, "axes.axisbelow": True,
                         "grid.color": GRID, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False, **more})


def save(figure, path, **options):
    """Write a picture, the folder too if it is missing, and forget it."""
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    figure.savefig(path, **options)
    plt.close(figure)
