#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `tread modes` left: receptances of wheel and rail, and how their contact answers a roughness; the strongest modes as a table.

    plot-modes.py FOLDER [--picture modes.png] [--rows 12] [--mark "270=f1" ...]

The table has, for each body, the modes that move the contact most when each vibrates with an energy of 1 J, those that move it most
first. Peaks of undamped vibrations in the picture are as high as the lines of receptance.csv happen to meet them.
"""

from __future__ import annotations

import csv
import os
from collections.abc import Mapping

import numpy as np

from tread.commands import command_parser, run_command
from tread.files import DataError, read_table
from tread.plots import BLUE, GREEN, RED, save, subplots, use_style


def mark(text: str) -> tuple[float, str]:
    """(frequency, name) of HZ=NAME."""
    frequency, _, name = text.partition("=")
    return float(frequency), name


def contact_at_one_joule(mode: Mapping[str, str]) -> float:
    """Amplitude in m."""
    return abs(float(mode["contact_amplitude_per_sqrt_kg"])) * np.sqrt(2.) / (2. * np.pi * float(mode["frequency_Hz"]))


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("folder")
    parser.add_argument("--picture", help="where to draw; default: none")
    parser.add_argument("--mark", nargs="+", type=mark, default=[], metavar="HZ=NAME", help="frequencies to name in the picture")
    parser.add_argument("--rows", type=int, default=12, help="modes of each body in the table")
    arguments = parser.parse_args()
    path = os.path.join(arguments.folder, "modes.csv")
    if not os.path.exists(path):
        raise DataError(f"no '{path}': is '{arguments.folder}' a folder of tread modes?")
    with open(path, encoding="utf-8") as stream:
        modes = list(csv.DictReader(stream))
    print("| body | number | Hz | where it shows | vertical, lateral, longitudinal | contact at 1 J, um | damping share |\n"
          "|---|---|---|---|---|---|---|")
    for body in dict.fromkeys(mode["body"] for mode in modes):
        of_body = [mode for mode in modes if mode["body"] == body and float(mode["frequency_Hz"]) > 1.]
        for mode in sorted(of_body, key=contact_at_one_joule, reverse=True)[:arguments.rows]:
            value = lambda name: float(mode[name])
            print(f"| {body} | {mode['number']} | {value('frequency_Hz'):.1f} | {mode['description']} | "
                  f"{value('vertical_share'):.2f}, {value('lateral_share'):.2f}, {value('longitudinal_share'):.2f} | "
                  f"{1e6 * contact_at_one_joule(mode):.1f} | {value('damping_share'):.3f} |")
    if not arguments.picture:
        return
    table = read_table(os.path.join(arguments.folder, "receptance.csv"), ("frequency_Hz",))
    frequency = np.array(table["frequency_Hz"])
    use_style()
    figure, axes = subplots(1, 2, figsize=(11, 4.2))
    for name, colour in (("rail", BLUE), ("wheel", RED)):
        axes[0].semilogy(frequency, 1e9 * np.array(table[f"{name}_magnitude_m_per_N"]), color=colour, label=name)
    axes[0].set(xlabel="frequency [Hz]", ylabel="receptance [nm/N]", ylim=(0.02, 100))
    axes[0].legend(loc="upper center")
    axes[1].plot(frequency, 1e-6 * np.array(table["contact_force_N_per_m"]), color=GREEN)
    axes[1].set(xlabel="frequency [Hz]", ylabel="contact force over roughness [N/µm]", ylim=(0, None))
    marks = sorted(arguments.mark)
    for i, (at, name) in enumerate(marks):
        # Above its line, away from a neighbour.
        close = 0.05 * frequency[-1]
        before, behind = i > 0 and at - marks[i - 1][0] < close, i + 1 < len(marks) and marks[i + 1][0] - at < close
        for axis in axes:
            axis.axvline(at, color="0.4", linestyle=":", linewidth=1)
            axis.annotate(name, (at, 1), xycoords=("data", "axes fraction"), xytext=(0, 3), textcoords="offset points", rotation=90,
                          ha="left" if before else "right" if behind else "center", va="bottom", fontsize=8, color="0.3")
    save(figure, arguments.picture)


if __name__ == "__main__":
    run_command(main)
