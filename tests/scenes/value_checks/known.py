# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values that no comparison watches, each with the reason: patterns of the file and of the key or column."""

import re

COUNTS = "a count of the solver's own work: nothing else knows it"
RESIDUAL = "what an iteration leaves: only its smallness is checked"
TIMES = "a time on the wall: only that it is a part of the whole is checked"
PLACES = "compared as it is made, by tests/analysis/rail_stress.cc"

KNOWN: list[tuple[str, str, str]] = [
    ("summary.json", "normal_iterations|tangential_iterations|solutions", COUNTS),
    ("summary.json", "normal_residual|tangential_residual", RESIDUAL),
    ("summary.json", "wall_s.*", TIMES),
    ("summary.json", "imbalance_of_cells|imbalance_of_cost|ranks_of_contact", "how ranks share the work: compared by tests/scenes/ranks.py"),
    ("summary.json", "cells_and_nodes_bytes|unknowns|plastic_cells", "how a mesh is made up: within a factor of two by its number of cells"),
    ("summary.json", "peak_surface_von_mises_from_tractions_.*", PLACES),
    ("summary.json", "wheel_2_free_rolling_creepage", "both wheels are of one steel and one shape: it is that of the first wheel"),
    ("summary.json", "wheel_2_lateral_force_N", "of a wheel on an upright cylinder, to which only noise of the mesh gives one"),
    ("summary.json", "free_rolling_creepage", "the difference of what finite bodies and half-spaces stretch by: compared by tests/scene/parts.cc"),
    ("summary.json", "airborne_s", "no wheel of these runs leaves the rail: compared by tests/simulation/records.cc"),
    ("summary.json", "note", "words"),
    ("(summary.json|history.csv)", "windows|window_loss_J", "compared by tests/scenes/window.py"),
    ("summary.json", "added_mass_(rail_kg|wheels_kg|wheels_share)", "the size alone: compared with a sum over cells by tests/dynamics/stability.cc"),
    ("summary.json", "patches/1/(element_[xy]_m|wheel_profile_radius_m)", "of elements the number is checked; a cone has no radius but that of its rounding"),
    ("summary.json", "wheel_max_von_mises_x_m|rail_max_von_mises_x_m", "known to an element, which is as much as it is"),
    ("summary.json", "cell_1_y_m", "half a cell beside the middle, on one side or the other"),
    ("summary.json", "largest_pad_force_x_m", "where the run ends: as good as 0"),
    ("history.csv", "(own|other)_wheel_roll_rad", "moments bend the axle: compared by tests/track/flexible_axle.cc"),
    ("history.csv", "inner_normal_force_N|wheelset_height_m", "compared by tests/scenes/slices.py and tests/output/columns.cc"),
    ("history.csv", "rail_base_.*", "compared by tests/track/rail_base.cc, tests/track/rail_on_beam.cc and tests/output/columns.cc"),
    ("history.csv", "support_0_rail_at_next_mid_span_m|support_0_rail_m|support_0_.*seat_pressure_Pa", "within bounds here; statics: tests/track/statics.cc"),
    ("history.csv", "(other_(longitudinal|lateral|normal)_force_N|guidance_force_N|roll_rad|yaw_rad|lateral_shift_m|(own|other)_wheel_yaw_rad|axle_twist_rad)",
     "changes by less in a row than the comparison allows: one that lies a row late is not noticed"),
    ("history.csv", "wheel_2_(adhesion_share|contact_area_m2|max_pressure_Pa|lateral_force_N|axle_box_acceleration_m_per_s2)",
     "of a steady wheel: one that lies a row late is not noticed"),
    ("history.csv", "axle_box_acceleration_m_per_s2", "compared in the mean over the way, by the wheel's mass"),
    ("modes.csv", ".*_amplitude_per_sqrt_kg|pad_elongation_per_sqrt_kg", "the sign of a mode is free; of pads the largest of each mode: some modes are compared"),
    ("contact_points.csv", "height_mm|o(wn|ther)_x_mm", "hardly changes from row to row: one that lies a row late is not noticed"),
    ("contact_way.csv", ".*", "compared by tests/scenes/slices.py"),
    ("(rail|wheel)_surface_damage.csv", ".*", "compared by tests/scenes/damage.py"),
    ("summary.json", "(patches/1/)?(surface_fatigue_index|t_gamma_.*|friction_used|shakedown_load_factor|regime_wear_rate_kg_per_m3)", "compared by tests/scenes/damage.py"),
    ("tread_half_space_damage", ".*", "compared by tests/scenes/batch.py and tests/python/figures_test.py"),
    ("summary.json", "max_flash_temperature_K|wear_volume_m3", "compared by tests/scenes/damage.py"),
    ("wear_(steps|patches).csv|(rail|wheel)_wear.csv", ".*", "compared by tests/scenes/profile_wear.py"),
    ("summary.json", "(rail|wheel)_(wear_.*|friction_work_J_per_m)|contacts|wear_steps.*|rail_passages|wheel_turns|max_pressure_at_start_Pa", "compared by tests/scenes/profile_wear.py"),
    ("summary.json", "passages_left_out|jumps|net_plastic_strain_error_estimate|passages_to_failure|net_plastic_strain_(y|depth)_m", "compared by tests/scenes/ratcheting.py"),
    ("(passages.csv|run.h5)", "(passages/)?skipped", "compared by tests/scenes/ratcheting.py"),
    ("(passages.csv|run.h5)", "(passages/)?(settlement_um|shift_um|residual_von_mises_MPa)", "what is left without the load: compared with an elastic twin by tests/scenes/ratcheting.py"),
    ("cells.csv", "cell_1_equivalent_plastic_strain", "constant once the wheel is past: one that lies a row late is not noticed"),
    ("rail_surface.csv", "[xyz]_mm|u_[xyz]_um", "its places are compared by those of the patch's nodes, whatever their order"),
    ("rail_cells.csv", "[xyz]_mm|stress_.*_MPa|equivalent_plastic_strain_percent", "a row late moves no sum over a level"),
    ("rail_seats.csv", "[xy]_mm", "places are symmetric to the pad's middle; moments of sleeper_stress.json tell the sides"),
    ("strip.csv", "depth_mm|surface_y_mm", "compared where the run is exact about it, in one row; elsewhere known to a cell"),
    ("sleeper_stress.json", "cells|unknowns|iterations|order_of_elements|seat_cell_m", COUNTS),
    ("sleeper_stress.json", "(max|min)_.*|.*place.*|half_sleeper_mass_kg|mean_seat_settlement_m|.*moment_x.*", "within bounds here; stresses: tests/analysis/sleeper_stress.cc"),
    ("subsurface.csv", "xy_MPa", "its sign in the plane of symmetry is that of a small stress: tests/reference/half_space.cc"),
    ("transient.csv", "lateral_coefficient", "steady at the end: one that lies a row late is not noticed"),
    ("dynamic.json", ".*logarithmic_decrement|.*oscillations", "compared by tests/analysis/spectrum.cc"),
    ("screen", "sinks under other patches.*|wheel #: normal force.* 1|spectrum: .*", "zero, a number of the label, or within the three digits that are shown"),
    ("screen", "vertical force, kN .* 3", "the load is carried: 0.00 beside the half-space's"),
    ("screen", "# cells, # unknowns, # rank.*4|.*plasticity.*3", "a constant, or zero"),
    ("screen", "(half a sleeper|support #|force on the bottom|largest force in a pad|[a-z_0-9-]+_N|dynamic force of|rows interpolated|largest tension|largest von Mises).*",
     "figures of files in another unit, which are compared; on the line within the digits that are shown"),
    ("tread_half_space_case", "slip_order|gap|n_x|n_y|x_first|y_first", "of a gap of one's own, whose answers are compared as `own gap`; slip_order: tests/scenes/batch.py"),
    ("tread_half_space_case", "poisson", "of like bodies only its square counts: the sign is not noticed"),
    ("tread_half_space_way", "n|heights|normal_force|creepage", "what a wheel rolls over: tests/python/figures_test.py changes each, tests/reference/uneven_way.cc compares"),
    ("library|own gap|fields|tread_half_space_.*", "iterations|status", COUNTS),
]


def reason(file: str, name: str) -> str:
    """Why a value is not compared, or "". """
    return next((why for of_file, of_name, why in KNOWN if re.fullmatch(of_file, file) and re.fullmatch(of_name, name)), "")
