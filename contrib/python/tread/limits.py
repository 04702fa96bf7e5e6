# SPDX-License-Identifier: LGPL-2.1-or-later
"""At which value of a parameter a figure of a study reaches a limit: the size from which a defect grows, for example."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Dict, Optional, Tuple

from .files import DataError

if TYPE_CHECKING:
    from .studies import Study

# Of a run: the values that are varied; a figure, and that of its smooth twin, or None.
Figures = Tuple[Dict[str, str], Optional[float], Optional[float]]


def crossing(sizes: Iterable[float], figures: Iterable[float | None], limit: float) -> tuple[float | None, float | None, float | None]:
    """Where the straight lines between the points reach the limit first, from below: (smallest size above, or None; largest size
    below it among those smaller, or None; the crossing, or None unless both are known and no point between them is without a
    figure)."""
    points = sorted(zip(sizes, figures), key=lambda point: point[0])
    below = above = None
    gap = False
    for size, figure in points:
        if figure is None:
            gap = True
        elif figure >= limit:
            above = (size, figure)
            break
        else:
            below, gap = (size, figure), False
    if not below or not above or gap:
        return above and above[0], below and below[0], None
    share = (limit - below[1]) / (above[1] - below[1])
    return above[0], below[0], below[0] + share * (above[0] - below[0])


class Answer:
    """What the runs of one mesh tell: the size at which the limit is reached (None if there is none), the sizes around it, whether
    the figure falls to it, and the same in a few words and in a sentence."""

    def __init__(self, points: Iterable[tuple[float, float | None, float | None]], limit: float):
        """@param points (size, figure or None, figure of the smooth twin or None) of each run"""
        points = sorted(points, key=lambda point: point[0])
        # 0 is what a figure has that nothing was recorded of.
        known = lambda figure: figure if figure is not None and math.isfinite(figure) and figure != 0 else None
        sizes, figures = [p[0] for p in points], [known(p[1]) for p in points]
        given, smooth = [f for f in figures if f is not None], [p[2] for p in points if known(p[2]) is not None]
        # A figure comes to the limit from above if it is above it without a defect, or with the smallest, and falls.
        falling = bool(given) and given[-1] < (smooth + given)[0]
        self.from_above = falling and (smooth + given)[0] >= limit
        sign = -1 if self.from_above else 1
        self.smooth = max(smooth, default=None)
        self.above, self.below, self.at = crossing(sizes, [f and sign * f for f in figures], sign * limit)
        if given and self.smooth is not None and self.smooth >= limit and not self.from_above:
            self.above = self.below = self.at = None
            self.words = "no defect is needed"
            self.sentence = f"the limit {limit:g} is below what the smooth rail has, {self.smooth:.4g}: no defect is needed to reach it"
        elif falling and not self.from_above and self.above is None:
            self.above = self.below = None
            self.words = f"nowhere from {sizes[0]:g} to {sizes[-1]:g}"
            self.sentence = self.words + ": the figure is below the limit, and falls"
        elif self.at is not None:
            self.words = f"{self.at:.3g}"
            self.sentence = f"{self.words}, between {self.below:g} and {self.above:g}"
        elif self.above is not None and self.below is not None:
            self.words = self.sentence = f"between {self.below:g} and {self.above:g}"
        elif self.below is not None:
            self.words = f"above {self.below:g}"
            self.sentence = self.words + ", the largest with a figure"
        elif self.above is not None:
            self.words = f"below {self.above:g}"
            self.sentence = self.words + ", the smallest with a figure"
        else:
            self.words = self.sentence = "no figures"
        if self.from_above:
            self.sentence += "; the figure falls" + (f", from {self.smooth:.4g} on the smooth rail" if smooth else "")
        missing = [f"{size:g}" + (" (it is 0)" if p[1] == 0 else "") for size, figure, p in zip(sizes, figures, points) if figure is None]
        if missing:
            self.sentence += "; no figure at " + ", ".join(missing)


class Limit:
    """A limit of a figure, and the varied parameter over which it is looked for."""

    def __init__(self, figure: str, value: float, parameter: str, mesh: str):
        self.figure, self.value, self.parameter, self.mesh = figure, value, parameter, mesh

    @classmethod
    def read(cls, path: str, text: str, mesh: str, study: Study) -> Limit:
        """@param text FIGURE = VALUE over PARAMETER; @raises DataError"""
        found = re.fullmatch(r"(\S+)\s*=\s*(\S+)\s+over\s+(.+)", text)
        try:
            limit = cls(found[1], float(found[2]), found[3].strip(), mesh)
        except (TypeError, ValueError):
            raise DataError(f"{path}: 'Limit' cannot be '{text}'; it must be FIGURE = VALUE over PARAMETER") from None
        if not 0 < limit.value < math.inf:
            raise DataError(f"{path}: 'Limit' of {limit.figure} cannot be '{found[2]}'; allowed: numbers above 0")
        if limit.figure not in study.figures:
            raise DataError(f"{path}: 'Limit': '{limit.figure}' is not among 'Figures': {' | '.join(study.figures)}")
        for what, name in (("Limit", limit.parameter), ("Mesh", limit.mesh)):
            if name and name not in study.members[0]:
                raise DataError(f"{path}: '{what}': '{name}' is not varied; varied are {', '.join(study.members[0])}")
            for member in study.members if name else ():
                try:
                    float(member[name])
                except ValueError:
                    raise DataError(f"{path}: '{what}': '{name}' cannot be '{member[name]}', which is no number") from None
        if limit.parameter == limit.mesh:
            raise DataError(f"{path}: 'Limit': '{limit.parameter}' is the 'Mesh'; a limit is looked for over another parameter")
        return limit

    def rows(self, answers: Sequence[Figures]) -> list[list]:
        """The rows of limit.csv, heading first; and the same in words, printed.
        @param answers (values, figure, figure of the smooth twin or None) of each run"""
        groups = {}
        for values, figure, smooth in answers:
            same = {name: value for name, value in values.items() if name not in (self.parameter, self.mesh)}
            # What varies together with the parameter does not tell groups apart.
            same = {name: value for name, value in same.items() if not self.follows(name, answers)}
            key = tuple(same.items())
            size = float(values[self.mesh]) if self.mesh else 0.
            groups.setdefault(key, {}).setdefault(size, []).append((float(values[self.parameter]), figure, smooth))
        rows, lines = [], []
        for key, by_mesh in groups.items():
            label = "".join(f"{name} {value}, " for name, value in key)[:-2]
            label = (label and label + ": ") + self.parameter
            found = {size: Answer(points, self.value) for size, points in sorted(by_mesh.items(), reverse=True)}
            lines += [f"{label}{f' with {self.mesh} {size:g}' if self.mesh else ''}: {answer.sentence}" for size, answer in found.items()]
            coarse, fine = list(found)[-2:] if len(found) > 1 else (None, None)
            uncertainty = None
            if fine is not None and None not in (found[fine].at, found[coarse].at) and found[fine].from_above == found[coarse].from_above:
                uncertainty = abs(found[fine].at - found[coarse].at)
                lines.append(f"{label}: {found[fine].words} +- {uncertainty:.2g} by the two finest meshes")
            elif fine is not None and (found[fine].words, found[fine].from_above) != (found[coarse].words, found[coarse].from_above):
                lines.append(f"{label}: {found[coarse].words} with {self.mesh} {coarse:g}, {found[fine].words} with {fine:g}: not settled")
            for size, answer in found.items():
                rows.append([self.figure, self.value] + [value for _, value in key] + ([size] if self.mesh else [])
                            + ["" if value is None else value for value in (answer.smooth, answer.below, answer.above)]
                            + ["" if value is None else f"{value:.{digits}g}"
                               for value, digits in ((answer.at, 4), (uncertainty if size == fine else None, 2))])
        if any(len(by_mesh) == 1 for by_mesh in groups.values()):
            lines.append("the uncertainty is not known: there is one mesh only")
        names = ["figure", "limit"] + [name for name, _ in next(iter(groups))] + ([self.mesh] if self.mesh else [])
        print(f"\n{self.figure} reaches {self.value:g} at")
        print("\n".join("  " + line for line in lines))
        return [names + ["smooth", "largest_below", "smallest_above", self.parameter, "uncertainty"]] + rows

    def follows(self, name: str, answers: Sequence[Figures]) -> bool:
        """Whether a parameter has one value for each value of the limit's parameter, and several of them."""
        by_size = {}
        for values, _, _ in answers:
            by_size.setdefault(values[self.parameter], set()).add(values[name])
        return all(len(seen) == 1 for seen in by_size.values()) and len(set.union(*by_size.values())) > 1
