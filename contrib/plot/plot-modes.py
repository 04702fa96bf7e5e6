#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `tread --modes` left: receptances of wheel and rail, and how their contact answers a roughness; the strongest modes as a table.

    plot-modes.py FOLDER [--picture modes.png] [--rows 12]

The table has the modes that move the contact most: amplitude there over circular frequency, for each body.
"""

import csv
import os

import numpy as np

from tread.commands import command_parser, run_command
from tread.files import DataError, read_table
from tread.plots import BLUE, GREEN, RED, plt, save, use_style


def main():
    parser = command_parser(__doc__)
    parser.add_argument("folder")
    parser.add_argument("--picture", help="where to draw; default: none")
    parser.add_argument("--rows", type=int, default=12, help="modes of each body in the table")
    arguments = parser.parse_args()
    path = os.path.join(arguments.folder, "modes.csv")
    if not os.path.exists(path):
        raise DataError(f"no '{path}': is '{arguments.folder}' a folder of tread --modes?")
    with open(path, encoding="utf-8") as stream:
        modes = list(csv.DictReader(stream))
    print("| body | number | Hz | where it shows | vertical, lateral, longitudinal | contact, 1/sqrt(kg) | damping share |\n"
          "|---|---|---|---|---|---|---|")
    for body in dict.fromkeys(mode["body"] for mode in modes):
        of_body = [mode for mode in modes if mode["body"] == body and float(mode["frequency_Hz"]) > 1.]
        of_body.sort(key=lambda mode: -abs(float(mode["contact_amplitude_per_sqrt_kg"])) / float(mode["frequency_Hz"]))
        for mode in sorted(of_body[:arguments.rows], key=lambda mode: float(mode["frequency_Hz"])):
            value = lambda name: float(mode[name])
            print(f"| {body} | {mode['number']} | {value('frequency_Hz'):.1f} | {mode['description']} | "
                  f"{value('vertical_share'):.2f}, {value('lateral_share'):.2f}, {value('longitudinal_share'):.2f} | "
                  f"{value('contact_amplitude_per_sqrt_kg'):.4f} | {value('damping_share'):.3f} |")
    if not arguments.picture:
        return
    table = read_table(os.path.join(arguments.folder, "receptance.csv"), ("frequency_Hz",))
    frequency = np.array(table["frequency_Hz"])
    use_style({"legend.fontsize": 9})
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2))
    for name, colour in (("rail", BLUE), ("wheel", RED)):
        axes[0].semilogy(frequency, 1e9 * np.array(table[f"{name}_magnitude_m_per_N"]), color=colour, label=name)
    axes[0].set(xlabel="frequency, Hz", ylabel="receptance, nm/N", ylim=(0.02, 100))
    axes[0].legend()
    axes[1].plot(frequency, 1e-6 * np.array(table["contact_force_N_per_m"]), color=GREEN)
    axes[1].set(xlabel="frequency, Hz", ylabel="contact force over roughness, N/um", ylim=(0, None))
    save(figure, arguments.picture, dpi=110, bbox_inches="tight")


if __name__ == "__main__":
    run_command(main)
