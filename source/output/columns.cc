// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/columns.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
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
             : '"' + dealii::Utilities::replace_in_string(word, "\"", "\"\"") + '"';
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
    std::vector<TableDescription> tables{describe("patch.csv", patch_columns()),
                                         describe("patches.csv", patches_columns()),
                                         describe("rail_surface_damage.csv", surface_damage_columns(false)),
                                         describe("wheel_surface_damage.csv", surface_damage_columns(true))};
    tables.insert(tables.end(), further_tables().begin(), further_tables().end());
    std::sort(tables.begin(), tables.end(),
              [](const TableDescription &a, const TableDescription &b) { return a.file < b.file; });
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
