#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Receptance of a rail on its track, by hammer blows and of the Timoshenko beam: a picture, and peaks and dips as a table.

    build/benchmarks/track_receptance_study 60E1 12.5 40 9 areas 1300 45 20 200 > receptance.csv
    plot-receptance.py receptance.csv [--picture receptance.png]

Columns of the file: frequency_Hz, then PLACE_FORCE_MODEL_nm_N; the models are cells, beam and beam_and_foot.
"""

from __future__ import annotations

import re

import numpy as np

from tread.commands import command_parser, run_command
from tread.plots import BLUE, GREEN, RED, SKY, save, subplots, use_style
from tread.files import DataError, read_table

PLACES = {"sleeper": "over a sleeper", "mid_span": "at mid-span"}
FORCES = {"section": "force on a cross-section", "spread": "on 120 mm of the rail", "top": "on the rail top"}
MODELS = {"cells": "cells", "beam": "Timoshenko beam", "beam_and_foot": "beam, foot in series with the pads"}
STYLES = {"cells": dict(color=BLUE), "beam": dict(color=RED, ls="--"), "beam_and_foot": dict(color=GREEN, ls=":")}


def extremes(frequency: np.ndarray, amplitude: np.ndarray) -> list[tuple[float, float, bool]]:
    """[(frequency in Hz, amplitude, is a peak)] by parabolas through three values of the logarithm."""
    value = np.log(amplitude)
    found = []
    for i in range(1, len(value) - 1):
        left, middle, right = value[i - 1:i + 2]
        if (middle > left and middle >= right) or (middle < left and middle <= right):
            shift = 0.5 * (left - right) / (left - 2 * middle + right)
            found.append((frequency[i] + shift * (frequency[1] - frequency[0]), amplitude[i], middle > left))
    return found


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("file")
    parser.add_argument("--picture", help="where to draw; default: none")
    arguments = parser.parse_args()
    table = read_table(arguments.file, ("frequency_Hz",))
    frequency = table["frequency_Hz"]
    columns = {}
    for name in table:
        match = re.fullmatch(rf"({'|'.join(PLACES)})_({'|'.join(FORCES)})_(cells|beam_and_foot|beam)_nm_N", name)
        if match:
            columns[match.groups()] = table[name]
    if not columns:
        raise DataError(f"{arguments.file}: no columns like sleeper_section_cells_nm_N")
    print("| place | force | model | peaks and dips, Hz (nm/N) |\n|---|---|---|---|")
    for (place, force, model), amplitude in columns.items():
        row = ", ".join(f"{'peak' if peak else 'dip'} {f:.0f} ({a:.2f})" for f, a, peak in extremes(frequency, amplitude))
        print(f"| {PLACES[place]} | {FORCES[force]} | {MODELS[model]} | {row} |")
    if not arguments.picture:
        return
    use_style()
    figure, axes = subplots(1, 2, figsize=(11, 4.5), sharey=True)
    for axis, place in zip(axes, PLACES):
        for model, style in STYLES.items():
            if (place, "section", model) in columns:
                axis.loglog(frequency, columns[place, "section", model], label=MODELS[model], **style)
        if (place, "top", "cells") in columns:
            axis.loglog(frequency, columns[place, "top", "cells"], color=SKY, lw=0.8, label="cells, force on the rail top")
        axis.set(title=PLACES[place], xlabel="frequency [Hz]", xlim=(100, frequency[-1]))
        axis.legend(loc="lower left")
    axes[0].set_ylabel("receptance [nm/N]")
    save(figure, arguments.picture)


if __name__ == "__main__":
    run_command(main)
