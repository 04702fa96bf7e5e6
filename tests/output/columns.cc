// SPDX-License-Identifier: LGPL-2.1-or-later
// Tables: what stands under each heading, in the unit of its name, as doc/results.md says. Every figure of a
// record has a value of its own, so that an exchange is noticed, and every column of a table is compared.
#include <tread/output/columns.h>
#include <tread/output/summary_keys.h>
#include <tread/recorders/history.h>
#include <tread/recorders/passages.h>
#include <tread/recorders/stresses.h>

#include "check.h"

#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace tread;

namespace output_columns
{
  /// Names of columns, and what a reader of the table expects there.
  using Expected = std::vector<std::pair<std::string, double>>;

  std::vector<std::string> split(const std::string &line)
  {
    std::vector<std::string> parts;
    std::istringstream       stream(line);
    for (std::string part; std::getline(stream, part, ',');)
      parts.push_back(part);
    return parts;
  }

  /// The row of one record by the names in the heading; empty where it is no table that anybody can read.
  template <typename Record>
  std::map<std::string, std::string> written(const Columns<Record> &columns, const Record &record)
  {
    std::ostringstream row;
    row << std::setprecision(12);
    write_row(row, columns, record);
    std::string line = row.str();
    if (!line.empty() && line.back() == '\n')
      line.pop_back();
    const std::vector<std::string>     names = split(heading(columns)), values = split(line);
    std::map<std::string, std::string> by_name;
    for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i)
      by_name[names[i]] = values[i];
    if (names.size() != values.size() || by_name.size() != names.size())
      by_name.clear();
    return by_name;
  }

  /// The last digits that are written are the twelfth.
  constexpr double round_off = 1e-11;

  template <typename Record>
  void compare(tests::Check                             &check,
               const std::string                        &table,
               const Columns<Record>                    &columns,
               const Record                             &record,
               const Expected                           &expected,
               const std::map<std::string, std::string> &words = {})
  {
    const std::map<std::string, std::string> row = written(columns, record);
    check.absolute(table + ": number of columns", row.size(), expected.size() + words.size(), 0.);
    std::set<double> values;
    for (const auto &[name, value] : expected)
      {
        values.insert(value);
        const auto entry = row.find(name);
        check.relative(table + ": " + name, entry == row.end() ? 0. : std::atof(entry->second.c_str()), value,
                       round_off);
      }
    check.that(table + ": no two columns have the same value", values.size() == expected.size());
    for (const auto &[name, word] : words)
      {
        const auto entry = row.find(name);
        check.that(table + ": " + name + " is " + word, entry != row.end() && entry->second == word);
      }
    // run.h5 has the units and what they mean beside its columns.
    for (const Column<Record> &column : columns)
      check.that(table + ": meaning of " + column.name, !column.about.empty());
    for (const Column<Record> &column : columns)
      check.that(table + ": unit of " + column.name + " is '" + column.unit + "'",
                 unit_of_heading(column.name + (column.unit.empty() ? "" : "_" + column.unit)) ==
                   column.unit);
  }

  /// Tractions and slip at a node, SI units.
  PatchNode patch_node()
  {
    PatchNode node{};
    node.position = Vector3{1.1e-3, -2.2e-3, 0.3e-3, 0.};
    node.area     = 1.7e-6;
    node.pressure = 811e6;
    node.shear[0] = 212e6;
    node.shear[1] = -93e6;
    node.slip[0]  = -0.041;
    node.slip[1]  = 0.013;
    node.adhesion = true;
    return node;
  }

  WheelRecord wheel_record(const double factor)
  {
    WheelRecord wheel{};
    wheel.force                      = factor * Vector3{11e3, -1.2e3, 110e3, 0.};
    wheel.creepage                   = factor * 1.5e-3;
    wheel.patch.area                 = factor * 151e-6;
    wheel.patch.max_pressure         = factor * 901e6;
    wheel.patch.adhesion_share       = factor * 0.61;
    wheel.patch.max_shear            = factor * 251e6;
    wheel.patch.max_slip             = factor * 0.071;
    wheel.patch.frictional_power     = factor * 802.;
    wheel.patch.semi_axis_x          = factor * 7.1e-3;
    wheel.patch.semi_axis_y          = factor * 5.3e-3;
    wheel.patch.normal_force         = factor * 109e3;
    wheel.patch.longitudinal_force   = factor * 10.9e3;
    wheel.patch.lateral_force        = factor * -1.1e3;
    wheel.patch.pressure_semi_axis_x = factor * 7.3e-3;
    wheel.patch.pressure_semi_axis_y = factor * 5.1e-3;
    wheel.axle_box_acceleration      = factor * -17.;
    wheel.lateral_shift              = factor * 2.1e-3;
    wheel.yaw                        = factor * 3.1e-3;
    wheel.guidance_force             = factor * 4100.;
    wheel.roll                       = factor * 0.6e-3;
    wheel.other_force                = factor * Vector3{5.1e3, 0.7e3, 57e3, 0.};
    wheel.inner_force                = factor * 4.2e3;
    wheel.height                     = factor * -0.83e-3;
    return wheel;
  }

  HistoryRow history_row()
  {
    HistoryRow row;
    row.time                    = 0.0123;
    row.position                = -0.0456;
    row.wheels                  = {wheel_record(1.), wheel_record(1.25)};
    row.wheels[1].force[0]      = 5.5e3;
    row.energy.external_work    = 101.;
    row.energy.gross_work       = 2002.;
    row.energy.kinetic          = 13.;
    row.energy.strain           = 16.;
    row.energy.hourglass        = 1.9;
    row.energy.friction         = 23.;
    row.energy.contact          = -2.9;
    row.energy.damping          = 3.1;
    row.energy.plastic          = 3.7;
    row.energy.springs          = 4.1;
    row.energy.dampers          = 4.3;
    row.energy.contact_on_nodes = 4.7;
    row.energy.stored_strain    = 5.3;
    row.energy.stored_hourglass = 5.9;
    row.supports                = {{31e3, 29e3, 1.7e6, -0.4e6, -0.51e-3, -0.37e-3},
                                   {21e3, 19e3, 1.3e6, 0.2e6, -0.61e-3, -0.47e-3}};
    row.cells                   = {{411e6, 0.0021}, {333e6, 0.0007}};
    return row;
  }

  /// Of the first of the wheels, without a prefix.
  const Expected first_wheel{
    {"normal_force_N", 110e3},     {"longitudinal_force_N", 11e3}, {"lateral_force_N", -1.2e3},
    {"traction_coefficient", 0.1}, {"creepage", 1.5e-3},           {"contact_area_m2", 151e-6},
    {"adhesion_share", 0.61},      {"max_pressure_Pa", 901e6},     {"axle_box_acceleration_m_per_s2", -17.}};
  const Expected time_and_energies{
    {"time_s", 0.0123},         {"position_m", -0.0456},    {"external_work_J", 101.},
    {"kinetic_energy_J", 13.},  {"internal_energy_J", 16.}, {"hourglass_energy_J", 1.9},
    {"frictional_work_J", 23.}, {"contact_loss_J", -2.9},   {"damping_work_J", 3.1},
    {"plastic_work_J", 3.7},    {"energy_residual_J", 39.1}}; // what is left of 101 J

  Expected together(const std::vector<Expected> &parts)
  {
    Expected all;
    for (const Expected &part : parts)
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  void check_history(tests::Check &check)
  {
    HistoryRow row = history_row();
    // Wheels, motion across the track and both wheels of a wheelset, supports.
    compare(check, "history.csv", history_columns({2, true, true, {-1, 4}}), row,
            together({time_and_energies,
                      first_wheel,
                      {{"lateral_shift_m", 2.1e-3},
                       {"yaw_rad", 3.1e-3},
                       {"guidance_force_N", 4100.},
                       {"roll_rad", 0.6e-3},
                       {"other_normal_force_N", 57e3},
                       {"other_longitudinal_force_N", 5.1e3},
                       {"other_lateral_force_N", 0.7e3},
                       {"spring_energy_J", 4.1},
                       {"support_-1_pad_N", 31e3},
                       {"support_-1_ballast_N", 29e3},
                       {"support_-1_seat_pressure_Pa", 1.7e6},
                       {"support_-1_least_seat_pressure_Pa", -0.4e6},
                       {"support_-1_rail_m", -0.51e-3},
                       {"support_-1_rail_at_next_mid_span_m", -0.37e-3},
                       {"support_4_pad_N", 21e3},
                       {"support_4_ballast_N", 19e3},
                       {"support_4_seat_pressure_Pa", 1.3e6},
                       {"support_4_least_seat_pressure_Pa", 0.2e6},
                       {"support_4_rail_m", -0.61e-3},
                       {"support_4_rail_at_next_mid_span_m", -0.47e-3},
                       {"wheel_2_normal_force_N", 137.5e3},
                       {"wheel_2_longitudinal_force_N", 5.5e3},
                       {"wheel_2_lateral_force_N", -1.5e3},
                       {"wheel_2_traction_coefficient", 0.04},
                       {"wheel_2_creepage", 1.875e-3},
                       {"wheel_2_contact_area_m2", 188.75e-6},
                       {"wheel_2_adhesion_share", 0.7625},
                       {"wheel_2_max_pressure_Pa", 1126.25e6},
                       {"wheel_2_axle_box_acceleration_m_per_s2", -21.25}}}));

    // What is not there has no columns.
    row.supports.clear();
    row.wheels.resize(1);
    compare(check, "history.csv of one wheel", history_columns({1, false, false, {}}), row,
            together({time_and_energies, first_wheel}));

    // A rail of slices, of one piece and of two.
    Expected     of_slices = together({time_and_energies, first_wheel, {{"wheelset_height_m", -0.83e-3}}});
    HistoryParts parts{1, false, false, {}};
    parts.has_slices = true;
    compare(check, "history.csv of slices", history_columns(parts), row, of_slices);
    of_slices.push_back({"inner_normal_force_N", 4.2e3});
    parts.has_two_pieces = true;
    compare(check, "history.csv of two pieces", history_columns(parts), row, of_slices);

    // A rail on a base that moves.
    row.rail_base           = Vector3{0.13e-3, -0.017e-3, -0.19e-3, 0.};
    row.rail_base_slope     = 0.23e-3;
    parts                   = {1, false, false, {}};
    parts.base_moves_across = true;
    const Expected one      = together({time_and_energies, first_wheel});
    compare(check, "history.csv of a track that runs along", history_columns(parts), row,
            together({one, {{"rail_base_lateral_m", -0.017e-3}, {"rail_base_vertical_m", -0.19e-3}}}));
    parts.base_moves_across = false;
    parts.base_pitches      = true;
    compare(
      check, "history.csv of a beam", history_columns(parts), row,
      together(
        {one,
         {{"spring_energy_J", 4.1}, {"rail_base_vertical_m", -0.19e-3}, {"rail_base_slope_rad", 0.23e-3}}}));

    // A wheel in the air has no traction coefficient, and the table no nan.
    row.wheels.front().force = Vector3{};
    check.that("history.csv of a wheel in the air: traction_coefficient is 0",
               written(history_columns({1, false, false, {}}), row)["traction_coefficient"] == "0");
  }

  void check_cells(tests::Check &check)
  {
    compare(check, "cells.csv", cell_columns(2), history_row(),
            {{"time_s", 0.0123},
             {"position_m", -0.0456},
             {"cell_1_von_mises_Pa", 411e6},
             {"cell_1_equivalent_plastic_strain", 0.0021},
             {"cell_2_von_mises_Pa", 333e6},
             {"cell_2_equivalent_plastic_strain", 0.0007}});
  }

  void check_patches(tests::Check &check)
  {
    const Expected of_node{{"x_mm", 1.1},
                           {"y_mm", -2.2},
                           {"z_mm", 0.3},
                           {"area_mm2", 1.7},
                           {"pressure_MPa", 811.},
                           {"shear_x_MPa", 212.},
                           {"shear_y_MPa", -93.},
                           {"slip_x_m_per_s", -0.041},
                           {"slip_y_m_per_s", 0.013}};
    PatchNode      node = patch_node();
    compare(check, "patch.csv", patch_columns(), node, of_node, {{"state", "adhesion"}});
    node.adhesion = false;
    check.that("patch.csv: state of a node that slips is slip",
               written(patch_columns(), node)["state"] == "slip");
    compare(check, "patches.csv", patches_columns(), PatchesRow{0.0123, -0.0456, node},
            together({{{"time_s", 0.0123}, {"position_mm", -45.6}}, of_node}), {{"state", "slip"}});
  }

  void check_passages(tests::Check &check)
  {
    Passage passage;
    passage.number                        = 3.;
    passage.skipped                       = 7.;
    passage.net_strain                    = 0.0017;
    passage.growth                        = 0.00042;
    passage.settlement                    = 1.7e-6;
    passage.shift                         = -0.9e-6;
    passage.plastic_strain                = 0.0021;
    passage.residual_stress               = 151e6;
    passage.plastic_work                  = 4.1;
    passage.frictional_work               = 23.;
    passage.traction_coefficient          = 0.31;
    passage.max_pressure                  = 1350e6;
    passage.energy_residual_share         = 1.3e-5;
    passage.energy_residual_of_dissipated = -0.0017;
    compare(check, "passages.csv", passage_columns(), passage,
            {{"passage", 3.},
             {"skipped", 7.},
             {"net_plastic_strain_percent", 0.17},
             {"net_plastic_strain_of_passage_percent", 0.042},
             {"settlement_um", 1.7},
             {"shift_um", -0.9},
             {"equivalent_plastic_strain_percent", 0.21},
             {"residual_von_mises_MPa", 151.},
             {"plastic_work_J", 4.1},
             {"frictional_work_J", 23.},
             {"traction_coefficient", 0.31},
             {"max_pressure_MPa", 1350.},
             {"energy_residual_share", 1.3e-5},
             {"energy_residual_of_dissipated", -0.0017}});
  }

  void check_stresses(tests::Check &check)
  {
    StripColumn strip;
    strip.x                         = -0.0251;
    strip.largest                   = {612e6, 0.0131, -0.0246};
    strip.at_surface                = {413e6, 0.0137, -0.0239};
    strip.y                         = 1.9e-3;
    strip.depth                     = 3.3e-3;
    strip.y_at_surface              = -2.7e-3;
    strip.equivalent_plastic_strain = 0.0029;
    compare(check, "strip.csv", strip_columns(), strip,
            {{"x_mm", -25.1},
             {"von_mises_MPa", 612.},
             {"y_mm", 1.9},
             {"depth_mm", 3.3},
             {"time_s", 0.0131},
             {"wheel_x_mm", -24.6},
             {"surface_von_mises_MPa", 413.},
             {"surface_y_mm", -2.7},
             {"surface_time_s", 0.0137},
             {"surface_wheel_x_mm", -23.9},
             {"equivalent_plastic_strain_percent", 0.29}});

    StressPeaks::Layer layer;
    layer.peak.value        = 612e6;
    layer.peak.x            = 0.0251;
    layer.peak.y            = -1.9e-3;
    layer.peak.depth        = 3.3e-3;
    layer.peak.time         = 0.0131;
    layer.peak.wheel_x      = 0.0246;
    layer.equivalent_strain = 0.0029;
    compare(check, "peak_stress.csv", peak_columns(), layer,
            {{"depth_mm", 3.3},
             {"von_mises_MPa", 612.},
             {"x_mm", 25.1},
             {"y_mm", -1.9},
             {"time_s", 0.0131},
             {"wheel_x_mm", 24.6},
             {"equivalent_strain_percent", 0.29}});
  }

  void check_rail_seats(tests::Check &check)
  {
    RailSeatPoint point;
    point.support  = -2;
    point.time     = 0.0131;
    point.wheel_x  = 0.0246;
    point.x        = -0.05;
    point.y        = 0.035;
    point.pressure = 1.7e6;
    compare(check, "rail_seats.csv", rail_seat_columns(), point,
            {{"support", -2.},
             {"time_s", 0.0131},
             {"wheel_x_mm", 24.6},
             {"x_mm", -50.},
             {"y_mm", 35.},
             {"pressure_MPa", 1.7}});
  }

  /// Keys as files make them known that set them, in an order that is not that of the page.
  const bool cell_is_known   = know_summary_keys(SummaryGroup::recorded, {{"cell_1_test_m", "Of a cell"}}),
             costs_are_known = know_summary_keys(
               SummaryGroup::cost,
               {{"test_c_rad_per_s", "First of its call"}, {"test_a_bytes", "Second of its call"}}),
             cost_is_known =
               know_summary_keys(SummaryGroup::cost, {{"test_b_per_s", "Before those, by its name"}}),
             run_is_known = know_summary_keys(SummaryGroup::run, {{"wall_s_test", "Of the first group"}});

  /// What summary.json means: each key once, whatever number a name has, and units where they are not at the
  /// end.
  void check_summary_keys(tests::Check &check)
  {
    std::map<std::string, std::string> units;
    bool                               all_mean_something = true;
    const TableDescription             table              = keys_of_summary();
    for (const TableDescription::Line &key : table.columns)
      {
        units[key.heading] = key.unit;
        all_mean_something = all_mean_something && !key.about.empty();
      }
    check.absolute("summary.json: each key stands once", units.size(), table.columns.size(), 0.);
    check.that("summary.json: each key has a meaning", all_mean_something);
    std::vector<std::string> order;
    for (const TableDescription::Line &key : table.columns)
      if (key.heading.find("test") != std::string::npos)
        order.push_back(key.heading);
    check.that("summary.json: groups, then calls by their first keys, then as the call has them",
               order == std::vector<std::string>{"wall_s_test", "test_b_per_s", "test_c_rad_per_s",
                                                 "test_a_bytes", "cell_1_test_m"});
    for (const auto &[key, unit] :
         std::map<std::string, std::string>{{"normal_force_N", "N"},
                                            {"creepage", ""},
                                            {"test_c_rad_per_s", "rad_per_s"},
                                            {"wall_s", "s"},
                                            {"wall_s_test", "s"},
                                            {"test_b_per_s", "per_s"},
                                            {"test_a_bytes", "bytes"},
                                            {"max_pressure_Pa_half_space_uncertainty", "Pa"},
                                            {"reference/max_pressure_Pa/Hertz/value", "Pa"},
                                            {"reference/max_pressure_Pa/Hertz/relative_difference", ""}})
      check.that("summary.json: unit of " + key + " is '" + unit + "'",
                 units.count(key) && units[key] == unit);
    for (const auto &[key, like] : std::map<std::string, std::string>{
           {"wheel_3_creepage", "creepage"},
           {"cell_12_test_m", "cell_1_test_m"},
           {"creepage_half_space_uncertainty", "max_pressure_Pa_half_space_uncertainty"},
           {"reference/creepage/half-space/value", "reference/max_pressure_Pa/Hertz/value"}})
      check.that("summary.json: " + key + " means what " + like + " does",
                 !about_summary_key(key).empty() && about_summary_key(key) == about_summary_key(like));
    for (const std::string key : {"made_up_N", "wheel_3_steps", "cell_x_m"})
      check.that("summary.json: nothing is known of " + key, about_summary_key(key).empty());

    // Of another group, and with another meaning.
    know_summary_keys(SummaryGroup::half_space, {{"test_b_per_s", "Once more"}});
    check.that("summary.json: a key that is described twice is refused by its name",
               tests::complaint<std::logic_error>(keys_of_summary) ==
                 "'test_b_per_s' of summary.json is described twice");
  }
} // namespace output_columns


TREAD_TEST(output_columns)(tests::Check &check, const tests::Arguments &)
{
  check_summary_keys(check);
  check_history(check);
  check_cells(check);
  check_patches(check);
  check_passages(check);
  check_stresses(check);
  check_rail_seats(check);
  check.that("a word with a comma is one entry of a row",
             quoted_word("sleepers, vertical") == "\"sleepers, vertical\"" &&
               quoted_word("adhesion") == "adhesion" &&
               quoted_word("so \"called\"") == "\"so \"\"called\"\"\"");
}
