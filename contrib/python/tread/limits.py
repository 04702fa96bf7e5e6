# SPDX-License-Identifier: LGPL-2.1-or-later
"""At which value of a parameter a figure of a study reaches a limit: the size from which a defect grows, for example."""

import re

from .files import DataError


def crossing(sizes, figures, limit):
    """Where the straight lines between the points reach the limit first: (smallest size above, or None; largest size below it
    among those smaller, or None; the crossing, or None unless both are known). Points without a figure are left out."""
    points = sorted((size, figure) for size, figure in zip(sizes, figures) if figure is not None)
    below = above = None
    for size, figure in points:
        if figure >= limit:
            above = (size, figure)
            break
        below = (size, figure)
    if not below or not above:
        return above and above[0], below and below[0], None
    share = (limit - below[1]) / (above[1] - below[1])
    return above[0], below[0], below[0] + share * (above[0] - below[0])


class Limit:
    """A limit of a figure, and the varied parameter over which it is looked for."""

    def __init__(self, figure, value, parameter, mesh):
        self.figure, self.value, self.parameter, self.mesh = figure, value, parameter, mesh

    @classmethod
    def read(cls, path, text, mesh, study):
        """@param text FIGURE = VALUE over PARAMETER; @raises DataError"""
        found = re.fullmatch(r"(\S+)\s*=\s*(\S+)\s+over\s+(.+)", text)
        try:
            limit = cls(found[1], float(found[2]), found[3].strip(), mesh)
        except (TypeError, ValueError):
            raise DataError(f"{path}: 'Limit' cannot be '{text}'; it must be FIGURE = VALUE over PARAMETER") from None
        for what, name in (("Limit", limit.parameter), ("Mesh", limit.mesh)):
            if name and name not in study.members[0]:
                raise DataError(f"{path}: '{what}': '{name}' is not varied; varied are {', '.join(study.members[0])}")
            for member in study.members if name else ():
                try:
                    float(member[name])
                except ValueError:
                    raise DataError(f"{path}: '{what}': '{name}' cannot be '{member[name]}', which is no number") from None
        return limit

    def rows(self, answers):
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
            label = ", ".join(f"{name} {value}" for name, value in key)
            found = {}
            for size, points in sorted(by_mesh.items(), reverse=True):
                smooth = [p[2] for p in points if p[2] is not None]
                above, below, at = crossing([p[0] for p in points], [p[1] for p in points], self.value)
                found[size] = at
                rows.append([self.figure] + [value for _, value in key] + ([size] if self.mesh else [])
                            + [max(smooth) if smooth else "", below if below is not None else "", above if above is not None else "",
                               f"{at:.4g}" if at is not None else ""])
                where = f" with {self.mesh} {size:g}" if self.mesh else ""
                if smooth and max(smooth) >= self.value:
                    text = f"the limit {self.value:g} is below what the smooth rail has, {max(smooth):.4g}: no defect is needed to reach it"
                elif at is not None:
                    text = f"{at:.3g}, between {below:g} and {above:g}"
                elif above is None and below is None:
                    text = "no figures"
                else:
                    text = f"above {below:g}, the largest tried" if above is None else f"below {above:g}, the smallest tried"
                lines.append(f"{label + ': ' if label else ''}{self.parameter}{where}: {text}")
            finest = [found[size] for size in sorted(found)[:2]]
            if len(finest) == 2 and None not in finest:
                lines.append(f"{label + ': ' if label else ''}{self.parameter}: {finest[0]:.3g} +- {abs(finest[0] - finest[1]):.2g} "
                             "by the two finest meshes")
        names = ["figure"] + [name for name, _ in next(iter(groups))] + ([self.mesh] if self.mesh else [])
        print(f"\n{self.figure} reaches {self.value:g} at")
        print("\n".join("  " + line for line in lines))
        return [names + ["smooth", "largest_below", "smallest_above", self.parameter]] + rows

    def follows(self, name, answers):
        """Whether a parameter has one value for each value of the limit's parameter, and several of them."""
        by_size = {}
        for values, _, _ in answers:
            by_size.setdefault(values[self.parameter], set()).add(values[name])
        return all(len(seen) == 1 for seen in by_size.values()) and len(set.union(*by_size.values())) > 1
