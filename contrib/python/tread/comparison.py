# SPDX-License-Identifier: LGPL-2.1-or-later
"""Error measures of a run of tread against a fine surface file of CONTACT, or against the half-space solution of its own
forces (reference_patch.csv) where no file is named.

CONTACT's patch is shifted so that the centres of pressure coincide, and interpolated bilinearly at
the nodes of the run. A node's tractions are impulses over the area that it stands for, and are compared with the
means over that area: of CONTACT's elements, which are means themselves, over a rectangle with as much variance as is left,
the root of the difference of both sizes' squares. Root mean squares (RMS) are taken over all nodes that are in contact in the run
or in CONTACT, and related to CONTACT's largest value. Micro-slip is compared inside 0.9 of the Hertz
ellipse only, because it jumps at the trailing edge; patch_averaged.csv (mean over the passage of one
cell) is used for it if the run wrote one. A node of adhesion is isolated if it has neighbours in
contact (at most 8) and all of them slip. --scale takes CONTACT's answer to bodies with larger radii and the same
patch: with radii 1/S as large and a load S as large its pressure, shear stress, slip and creepage are S as large.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

import numpy as np

from .files import read_summary, read_table, reference_value
from .patches import Patch, read_contact, read_patch


def neighbours_in_contact(patch: Patch) -> list[list[int]]:
    """For each node the indices of its neighbours."""
    columns = np.round((patch.x - patch.x.min()) / patch.size_x).astype(int)
    rows = np.round((patch.y - patch.y.min()) / patch.size_y).astype(int)
    at = {position: i for i, position in enumerate(zip(columns, rows))}
    around = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]
    return [[at[c + i, r + j] for i, j in around if (c + i, r + j) in at] for c, r in zip(columns, rows)]


def isolated_adhesion(patch: Patch) -> int:
    return sum(1 for i, near in enumerate(neighbours_in_contact(patch))
               if patch.adhesion[i] and near and not patch.adhesion[near].any())


class Shifted:
    """CONTACT's answer at the nodes of a run."""

    def __init__(self, contact: Patch, patch: Patch, shift: Sequence[float]):
        # Also the nodes around the patch: there the run has zero, CONTACT perhaps not.
        gx, gy, inside = patch.grid(np.ones_like(patch.x))
        self.x, self.y = (values.ravel() for values in np.meshgrid(gx, gy))
        self.in_run = ~np.isnan(inside).ravel()
        self.own = {field: np.nan_to_num(patch.grid(getattr(patch, field))[2]).ravel() for field in patch.fields}
        widths = [max(0.0, own ** 2 - of_contact ** 2) ** 0.5
                  for own, of_contact in ((patch.size_x, contact.size_x), (patch.size_y, contact.size_y))]
        self.reference = {field: contact.averaged(field, self.x - shift[0], self.y - shift[1],
                                                  *((0.0, 0.0) if field in contact.slip_fields else widths))
                          for field in contact.fields}
        self.counted = self.in_run | (self.reference["pressure"] > 0)

    def rms(self, fields: Sequence[str], where: np.ndarray) -> float:
        square = sum((self.own[field] - self.reference[field]) ** 2 for field in fields)
        return float(np.sqrt(square[where].mean()))


def hertz_axes(summary: Mapping, contact: Patch) -> list[float]:
    axes = [reference_value(summary, key, "Hertz") for key in ("semi_axis_x_m", "semi_axis_y_m")]
    if None not in axes:
        return [1e3 * axis for axis in axes]
    return [0.5 * np.ptp(contact.x), 0.5 * np.ptp(contact.y)]


def compare(run: str, contact_file: str | None = None, scale: float = 1.0) -> dict:
    contact = read_contact(contact_file) if contact_file else read_patch(os.path.join(run, "reference_patch.csv"))
    for field in contact.fields:
        setattr(contact, field, scale * getattr(contact, field))
    result = compare_fields(run, contact)
    if contact_file:
        result.update(compare_forces(read_summary(run), contact_file, scale))
    result.update(steadiness(run))
    return result


def compare_fields(run: str, contact: Patch) -> dict:
    """The measures of the fields against any patch."""
    summary = read_summary(run)
    patch = read_patch(os.path.join(run, "patch.csv"))
    shift = [own - other for own, other in zip(patch.centroid(), contact.centroid())]
    at_nodes = Shifted(contact, patch, shift)

    averaged_file = os.path.join(run, "patch_averaged.csv")
    slips = read_patch(averaged_file) if os.path.exists(averaged_file) else patch
    slip_shift = [own - other for own, other in zip(slips.centroid(), contact.centroid())]
    slip_at_nodes = Shifted(contact, slips, slip_shift)
    a, b = hertz_axes(summary, contact)

    def inside(nodes: Shifted, offset: Sequence[float]) -> np.ndarray:
        return ((nodes.x - offset[0]) / a) ** 2 + ((nodes.y - offset[1]) / b) ** 2 < 0.9 ** 2

    shear_fields = ("shear_x", "shear_y")
    p_max, shear_max, slip_max = contact.pressure.max(), contact.shear.max(), contact.slip.max()
    result = {
        "nodes_in_contact": len(patch.x),
        "node_distance_mm": round(patch.size_x, 6),
        "shift_x_mm": shift[0],
        "shift_y_mm": shift[1],
        "max_pressure_MPa": patch.pressure.max(),
        "max_pressure_relative_difference": patch.pressure.max() / p_max - 1,
        "pressure_rms_over_max": at_nodes.rms(("pressure",), at_nodes.counted) / p_max,
        "max_shear_MPa": patch.shear.max(),
        "max_shear_relative_difference": patch.shear.max() / shear_max - 1,
        "shear_rms_over_max": at_nodes.rms(shear_fields, at_nodes.counted) / shear_max,
        "adhesion_share": patch.adhesion_share,
        "adhesion_share_difference_points": 100 * (patch.adhesion_share - contact.adhesion_share),
        "micro_slip_from": os.path.basename(slips.path),
        "max_slip_m_per_s": slips.slip.max(),
        "max_slip_relative_difference": slips.slip.max() / slip_max - 1,
        "micro_slip_rms_over_max": slip_at_nodes.rms(
            contact.slip_fields, slip_at_nodes.counted & inside(slip_at_nodes, slip_shift)) / slip_max,
        "micro_slip_rms_over_max_instant": at_nodes.rms(
            contact.slip_fields, at_nodes.counted & inside(at_nodes, shift)) / slip_max,
        "max_slip_in_adhesion_m_per_s": patch.slip[patch.adhesion].max(initial=0.0),
        "isolated_adhesion_nodes": isolated_adhesion(patch),
    }
    if abs(at_nodes.own["shear_x"].sum() + at_nodes.reference["shear_x"].sum()) \
            < 0.5 * abs(at_nodes.own["shear_x"].sum() - at_nodes.reference["shear_x"].sum()):
        print("note: the shear of the run and of CONTACT have opposite signs")
    return {key: value.item() if isinstance(value, np.generic) else value for key, value in result.items()}


def compare_forces(summary: Mapping, contact_file: str, scale: float) -> dict[str, float]:
    """Force and creepage against contact_summary.csv beside the surface file, if it lists that file."""
    table_file = os.path.join(os.path.dirname(contact_file), "contact_summary.csv")
    if not os.path.exists(table_file):
        return {}
    table = read_table(table_file, ("file", "normal_force_N", "traction_coefficient", "friction_coefficient",
                                    "creepage"), text=("file",))
    row = np.nonzero(table["file"] == os.path.basename(contact_file))[0]
    if not len(row):
        return {}
    reference = {key: values[row[0]] for key, values in table.items()}
    result = {}
    reference["normal_force_N"] *= scale
    reference["creepage"] *= scale
    if "normal_force_N" in summary:
        result["normal_force_relative_difference"] = summary["normal_force_N"] / reference["normal_force_N"] - 1
    if "traction_coefficient" in summary:
        traction = summary["traction_coefficient"]
        result["traction_coefficient_difference"] = traction - reference["traction_coefficient"]
        friction = reference["friction_coefficient"]
        if "creepage" in summary and abs(traction) < friction:
            # The creepage CONTACT would have at the traction of the run, by the shape of
            # Vermeulen & Johnson's creep curve; exact enough for a few per cent of difference.
            def shape(value: float) -> float:
                return 1 - (1 - value / friction) ** (1 / 3)

            expected = reference["creepage"] * shape(traction) / shape(reference["traction_coefficient"])
            result["creepage"] = summary["creepage"]
            result["creepage_at_this_traction_relative_difference"] = summary["creepage"] / expected - 1
    return result


def steadiness(run: str) -> dict[str, float]:
    """Ripple of the last millimetres in history.csv: largest deviation from the mean over the mean."""
    history_file = os.path.join(run, "history.csv")
    if not os.path.exists(history_file):
        return {}
    history = read_table(history_file)
    if "position_m" not in history or not len(history["position_m"]):
        return {}
    rest = history["position_m"][-1] - history["position_m"]
    result = {}
    for key, column, distance in (("normal_force_ripple_last_10_mm", "normal_force_N", 0.010),
                                  ("traction_ripple_last_10_mm", "traction_coefficient", 0.010)):
        if column in history:
            values = history[column][rest <= distance]
            mean = values.mean()
            if mean:
                result[key] = abs(values - mean).max() / abs(mean)
    return result
