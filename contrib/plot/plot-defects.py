#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw longitudinal profiles of defects, one beside the other.

    plot-defects.py FILE... [--output PICTURE]

Each file has columns x and z in mm; lines that start with # are passed over.
"""

import os

import numpy as np

from tread.commands import command_parser, run_command
from tread.plots import plt, save


def main():
    parser = command_parser(__doc__)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--output", default="defects.png")
    arguments = parser.parse_args()
    figure, axis = plt.subplots(figsize=(7, 3))
    for path in arguments.files:
        x, z = np.loadtxt(path, unpack=True)
        axis.plot(x, z, label=os.path.splitext(os.path.basename(path))[0])
    axis.set_xlabel("x from the leading edge, mm")
    axis.set_ylabel("z, mm")
    axis.grid(linewidth=0.3)
    axis.legend()
    figure.tight_layout()
    save(figure, arguments.output, dpi=110)


if __name__ == "__main__":
    run_command(main)
