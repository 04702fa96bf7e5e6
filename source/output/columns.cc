// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/columns.h>

#include <deal.II/base/numbers.h>

#include <array>
#include <regex>
#include <utility>

namespace tread
{
  double factor_of(const std::string &unit)
  {
    static const std::array<std::pair<const char *, double>, 6> factors{
      {{"mm", 1e3},
       {"um", 1e6},
       {"mm2", 1e6},
       {"MPa", 1e-6},
       {"percent", 100.},
       {"deg", 180. / dealii::numbers::PI}}};
    for (const auto &[name, factor] : factors)
      if (unit == name)
        return factor;
    return 1.;
  }


  std::string unit_of_heading(const std::string &heading)
  {
    // Longer ones before those that they end with.
    for (const std::string unit :
         {"J_per_m2", "J_per_m", "kg_per_m3", "m3",    "deg",   "K",       "rad_per_s", "m_per_s2",
          "m_per_s",  "N_per_m", "m_per_N",   "per_m", "per_s", "percent", "degrees",   "bytes",
          "MPa",      "Pa",      "Hz",        "mm2",   "mm",    "um",      "m2",        "rad",
          "Nm",       "m",       "N",         "J",     "W",     "s"})
      if (heading.size() > unit.size() + 1 &&
          heading.compare(heading.size() - unit.size() - 1, std::string::npos, "_" + unit) == 0)
        return unit;
    return "";
  }


  std::string quoted_word(const std::string &word)
  {
    return word.find_first_of(",\"") == std::string::npos
             ? word
             : '"' + std::regex_replace(word, std::regex("\""), "\"\"") + '"';
  }


  const Columns<PatchNode> &patch_columns()
  {
    using R = PatchNode;
    static const Columns<R> columns{
      {"x", "mm", "Along the rail from the wheel",
       [](const R &r) {
         return r.position[0];
       }},
      {"y", "mm", "Across, from the middle of the rail's head (of the patch, for a wheelset in a position)",
       [](const R &r) {
         return r.position[1];
       }},
      {"z", "mm", "Height of the node over the rail's top",
       [](const R &r) {
         return r.position[2];
       }},
      {"area", "mm2", "That belongs to the node",
       [](const R &r) {
         return r.area;
       }},
      {"pressure", "MPa", "Normal to the surface",
       [](const R &r) {
         return r.pressure;
       }},
      {"shear_x", "MPa", "Shear stress on the wheel, forward",
       [](const R &r) {
         return r.shear[0];
       }},
      {"shear_y", "MPa",
       "Shear stress on the wheel, across the rail along the surface, positive to the field side of that "
       "wheel's rail",
       [](const R &r) {
         return r.shear[1];
       }},
      {"slip_x", "m_per_s", "Velocity of the wheel over the rail at the node, forward",
       [](const R &r) {
         return r.slip[0];
       }},
      {"slip_y", "m_per_s", "The same across, likewise",
       [](const R &r) {
         return r.slip[1];
       }},
      {"state", "", "adhesion or slip", {}, [](const R &r) {
         return std::string(r.adhesion ? "adhesion" : "slip");
       }}};
    return columns;
  }


  const Columns<PatchesRow> &patches_columns()
  {
    using R                         = PatchesRow;
    static const Columns<R> columns = []() {
      Columns<R> c{{"time", "s", "From the start of the run",
                    [](const R &r) {
                      return r.time;
                    }},
                   {"position", "mm", "Of the wheel along the rail", [](const R &r) {
                      return r.position;
                    }}};
      add_columns(c, patch_columns(), "", [](const R &r) -> const PatchNode & { return r.node; });
      return c;
    }();
    return columns;
  }


  const Columns<Passage> &passage_columns()
  {
    using R = Passage;
    static const Columns<R> columns{
      {"passage", "", "Number of the wheel that has rolled over",
       [](const R &r) {
         return r.number;
       }},
      {"skipped", "", "Passages before it over which the change was extrapolated",
       [](const R &r) {
         return r.skipped;
       }},
      {"settlement", "um",
       "Of the rail's surface in the middle of the path since before the first wheel, downwards, without "
       "load: the first row's is known when the second wheel stands at the beginning, and never where the "
       "steel failed before",
       [](const R &r) {
         return r.settlement;
       }},
      {"shift", "um", "The same along the rail, forward",
       [](const R &r) {
         return r.shift;
       }},
      {"equivalent_plastic_strain", "percent", "Largest of the rail's cells in the middle of the path",
       [](const R &r) {
         return r.plastic_strain;
       }},
      {"net_plastic_strain", "percent",
       "Largest there of what is left of the plastic strain, equivalent, without what goes forth and back",
       [](const R &r) {
         return r.net_strain;
       }},
      {"net_plastic_strain_of_passage", "percent", "Largest change there in this passage",
       [](const R &r) {
         return r.growth;
       }},
      {"residual_von_mises", "MPa", "Largest stress there, likewise without load",
       [](const R &r) {
         return r.residual_stress;
       }},
      {"plastic_work", "J", "Of this passage",
       [](const R &r) {
         return r.plastic_work;
       }},
      {"frictional_work", "J", "Of this passage",
       [](const R &r) {
         return r.frictional_work;
       }},
      {"traction_coefficient", "", "Mean over the last 10 mm of the passage",
       [](const R &r) {
         return r.traction_coefficient;
       }},
      {"max_pressure", "MPa", "Largest of a node at the solution instant",
       [](const R &r) {
         return r.max_pressure;
       }},
      {"energy_residual_share", "", "Residual over the gross work",
       [](const R &r) {
         return r.energy_residual_share;
       }},
      {"energy_residual_of_dissipated", "", "Residual over the dissipated work", [](const R &r) {
         return r.energy_residual_of_dissipated;
       }}};
    return columns;
  }


  const Columns<StressPeaks::Layer> &peak_columns()
  {
    using R = StressPeaks::Layer;
    static const Columns<R> columns{
      {"depth", "mm", "Half the height of the layer of cells; 0: the surface",
       [](const R &r) {
         return r.peak.depth;
       }},
      {"von_mises", "MPa", "Largest von Mises stress of all steps, recovered at this depth",
       [](const R &r) {
         return r.peak.value;
       }},
      {"x", "mm", "Where it was, along the rail",
       [](const R &r) {
         return r.peak.x;
       }},
      {"y", "mm", "Where it was, across",
       [](const R &r) {
         return r.peak.y;
       }},
      {"time", "s", "When it was",
       [](const R &r) {
         return r.peak.time;
       }},
      {"wheel_x", "mm", "Where the wheel was then",
       [](const R &r) {
         return r.peak.wheel_x;
       }},
      {"equivalent_strain", "percent",
       "Stress over three times the shear modulus, and the largest equivalent plastic strain at the end",
       [](const R &r) {
         return r.equivalent_strain;
       }}};
    return columns;
  }


  Columns<SurfacePlace> surface_damage_columns(const bool of_wheel)
  {
    using R = SurfacePlace;
    return {
      of_wheel ? Column<R>{"angle", "deg",
                           "About the axle, from where the wheel stands on the rail at the start; "
                           "positive: comes to the rail later",
                           [](const R &r) {
                             return r.along;
                           }}
               : Column<R>{"x", "mm", "Along the rail, without load",
                           [](const R &r) {
                             return r.along;
                           }},
      {"y", "mm",
       "Across, without load; 0 at the middle of the rail's top, over slices at the middle of the track",
       [](const R &r) {
         return r.y;
       }},
      {"area", "m2",
       "Of the surface that this node stands for: its share of the faces around it; by half-space theory "
       "that of the line on a metre of way",
       [](const R &r) {
         return r.area;
       }},
      {"friction_work", "J_per_m2", "Work of friction so far",
       [](const R &r) {
         return r.friction_work;
       }},
      {"slip_distance", "m", "Way that the other surface has slid over it",
       [](const R &r) {
         return r.slip_distance;
       }},
      {"max_pressure", "Pa", "Largest pressure",
       [](const R &r) {
         return r.max_pressure;
       }},
      {"max_shear", "Pa", "Largest shear stress of friction",
       [](const R &r) {
         return r.max_shear;
       }},
      {"passages", "", "How often it came into contact",
       [](const R &r) {
         return r.passages;
       }},
      {"max_flash_temperature", "K", "Largest rise of temperature by the heat of friction",
       [](const R &r) {
         return r.max_temperature;
       }},
      {"wear_depth", "m", "Lost by 'Damage/Wear law'", [](const R &r) {
         return r.wear_depth;
       }}};
  }


  const Columns<StripColumn> &strip_columns()
  {
    using R = StripColumn;
    static const Columns<R> columns{
      {"x", "mm", "Of the surface cell, along the rail",
       [](const R &r) {
         return r.x;
       }},
      {"von_mises", "MPa", "Largest stress of all rows of the history in the middles of the cells below it",
       [](const R &r) {
         return r.largest.stress;
       }},
      {"y", "mm", "Where it was, across",
       [](const R &r) {
         return r.y;
       }},
      {"depth", "mm", "Where it was",
       [](const R &r) {
         return r.depth;
       }},
      {"time", "s", "When it was",
       [](const R &r) {
         return r.largest.time;
       }},
      {"wheel_x", "mm", "Where the wheel was then",
       [](const R &r) {
         return r.largest.wheel_x;
       }},
      {"surface_von_mises", "MPa", "Largest stress of the surface, recovered at the nodes of the cell",
       [](const R &r) {
         return r.at_surface.stress;
       }},
      {"surface_y", "mm", "Where it was, across",
       [](const R &r) {
         return r.y_at_surface;
       }},
      {"surface_time", "s", "When it was",
       [](const R &r) {
         return r.at_surface.time;
       }},
      {"surface_wheel_x", "mm", "Where the wheel was then",
       [](const R &r) {
         return r.at_surface.wheel_x;
       }},
      {"equivalent_plastic_strain", "percent", "Largest of the cells below, at the end", [](const R &r) {
         return r.equivalent_plastic_strain;
       }}};
    return columns;
  }


  const Columns<RailSeatPoint> &rail_seat_columns()
  {
    using R = RailSeatPoint;
    static const Columns<R> columns{
      {"support", "", "Its number",
       [](const R &r) {
         return r.support;
       }},
      {"time", "s", "Of the largest force in its pad",
       [](const R &r) {
         return r.time;
       }},
      {"wheel_x", "mm", "Where the wheel was then",
       [](const R &r) {
         return r.wheel_x;
       }},
      {"x", "mm", "Of the part of the pad, along the rail from the pad's middle",
       [](const R &r) {
         return r.x;
       }},
      {"y", "mm", "The same across",
       [](const R &r) {
         return r.y;
       }},
      {"pressure", "MPa", "On the pad there, negative in tension", [](const R &r) {
         return r.pressure;
       }}};
    return columns;
  }


  namespace
  {
    /// Columns of arrays of values in SI units, in their order.
    template <std::size_t n>
    Columns<std::array<double, n>> columns_of(const std::array<std::array<const char *, 3>, n> &texts)
    {
      Columns<std::array<double, n>> columns;
      for (std::size_t k = 0; k < n; ++k)
        columns.push_back({texts[k][0], texts[k][1], texts[k][2], [k](const std::array<double, n> &row) {
                             return row[k];
                           }});
      return columns;
    }
  } // namespace


  const Columns<std::array<double, 11>> &rail_cell_columns()
  {
    static const auto columns = columns_of<11>(
      {{{"x", "mm", "Middle of the cell before any load, along the rail"},
        {"y", "mm", "The same across"},
        {"z", "mm", "The same upwards"},
        {"von_mises", "MPa", "Von Mises stress in the middle of the cell at the solution instant"},
        {"stress_xx", "MPa", "Cauchy stress, along the rail"},
        {"stress_yy", "MPa", "Across"},
        {"stress_zz", "MPa", "Upwards"},
        {"stress_xy", "MPa", "Shear"},
        {"stress_yz", "MPa", "Shear"},
        {"stress_zx", "MPa", "Shear"},
        {"equivalent_plastic_strain", "percent", "Equivalent plastic strain at that instant"}}});
    return columns;
  }


  const Columns<std::array<double, 13>> &rail_surface_columns()
  {
    static const auto columns =
      columns_of<13>({{{"x", "mm", "Node of the surface before any load, along the rail"},
                       {"y", "mm", "The same across"},
                       {"z", "mm", "The same upwards"},
                       {"u_x", "um", "Displacement at the solution instant, along the rail"},
                       {"u_y", "um", "The same across"},
                       {"u_z", "um", "The same upwards"},
                       {"von_mises", "MPa", "Von Mises stress at the surface, recovered, at that instant"},
                       {"stress_xx", "MPa", "Cauchy stress there, along the rail"},
                       {"stress_yy", "MPa", "Across"},
                       {"stress_zz", "MPa", "Upwards"},
                       {"stress_xy", "MPa", "Shear"},
                       {"stress_yz", "MPa", "Shear"},
                       {"stress_zx", "MPa", "Shear"}}});
    return columns;
  }


  const Columns<std::array<double, 5>> &measured_profile_columns()
  {
    static const auto columns = columns_of<5>(
      {{{"line", "", "Of the profile's file that the point stands in"},
        {"y", "mm", "Point of the profile as it is used, placed and smoothed, across the track"},
        {"z", "mm", "The same upwards"},
        {"measured_y", "mm", "The same point before it was smoothed, across the track"},
        {"measured_z", "mm", "The same upwards"}}});
    return columns;
  }


  namespace
  {
    std::vector<TableDescription> &further_tables()
    {
      static std::vector<TableDescription> tables;
      return tables;
    }

    /// patch_averaged.csv, patch_wheel_2.csv, reference_patch.csv, peak_stress_wheel.csv as their
    /// descriptions have them.
    std::string as_described(const std::string &file)
    {
      static const std::regex patch("^(reference_patch|patch(_averaged)?(_wheel_[0-9]+)?)[.]csv$"),
        patches("^patches_wheel_[0-9]+[.]csv$"), peaks("^peak_stress_wheel[.]csv$"),
        damage("^wheel_surface_damage_wheel_[0-9]+[.]csv$");
      for (const auto &[numbered, described] :
           {std::pair(&patch, "patch.csv"), std::pair(&patches, "patches.csv"),
            std::pair(&peaks, "peak_stress.csv"), std::pair(&damage, "wheel_surface_damage.csv")})
        if (std::regex_match(file, *numbered))
          return described;
      return file;
    }

    const TableDescription *table_like(const std::string &file)
    {
      static const std::vector<TableDescription> tables = tables_of_a_run();
      for (const TableDescription &table : tables)
        if (table.file == as_described(file))
          return &table;
      return nullptr;
    }
  } // namespace


  bool know_table(const TableDescription &table)
  {
    further_tables().push_back(table);
    return true;
  }


  bool is_table_of_a_run(const std::string &file)
  {
    return table_like(file) != nullptr;
  }


  std::vector<TableDescription> tables_of_a_run()
  {
    HistoryParts all{2, true, true, {0}};
    all.base_moves_across = all.base_pitches = all.has_flexible_axle = all.has_slices = all.has_two_pieces =
      all.has_window                                                                  = true;
    std::vector<TableDescription> tables{describe("history.csv", history_columns(all)),
                                         describe("patch.csv", patch_columns()),
                                         describe("patches.csv", patches_columns()),
                                         describe("cells.csv", cell_columns(1)),
                                         describe("strip.csv", strip_columns()),
                                         describe("rail_surface_damage.csv", surface_damage_columns(false)),
                                         describe("wheel_surface_damage.csv", surface_damage_columns(true)),
                                         describe("peak_stress.csv", peak_columns()),
                                         describe("rail_seats.csv", rail_seat_columns()),
                                         describe("passages.csv", passage_columns()),
                                         describe("rail_cells.csv", rail_cell_columns()),
                                         describe("rail_surface.csv", rail_surface_columns()),
                                         describe("measured_wheel.csv", measured_profile_columns()),
                                         describe("measured_rail.csv", measured_profile_columns())};
    tables.insert(tables.end(), further_tables().begin(), further_tables().end());
    return tables;
  }


  std::string about_column(const std::string &file, const std::string &heading)
  {
    static const std::regex support("^support_-?[0-9]+_"), wheel("^wheel_[0-9]+_"), cell("^cell_[0-9]+_");
    const auto like = [](const std::string &text, const std::regex &numbered, const char *instead) {
      return std::regex_replace(text, numbered, instead);
    };
    const std::string name =
      like(like(like(heading, support, "support_0_"), wheel, "wheel_2_"), cell, "cell_1_");
    if (const TableDescription *table = table_like(file))
      for (const TableDescription::Line &column : table->columns)
        if (column.heading == name)
          return column.about;
    return "";
  }
} // namespace tread
