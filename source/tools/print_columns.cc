// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/summary_keys.h>
#include <tread/scene/wheelset_summary.h>
#include <tread/tools/contact_points_files.h>
#include <tread/tools/contact_way_files.h>
#include <tread/tools/modes_files.h>
#include <tread/tools/print_columns.h>
#include <tread/tools/wear_files.h>

#include <nlohmann/json.hpp>

namespace tread
{
  void print_columns(std::ostream &out)
  {
    // Keys of lists have / in their names, as contrib/compare-runs.py has them.
    TableDescription summary = keys_of_summary();
    for (const TableDescription::Line &key : keys_of_patch())
      summary.columns.push_back({"patches/1/" + key.heading, key.unit, key.about});
    std::vector<TableDescription> tables = tables_of_a_run();
    tables.insert(tables.begin(), summary);
    for (const auto &more : {tables_of_modes(), tables_of_contact_points(), tables_of_profile_wear()})
      tables.insert(tables.end(), more.begin(), more.end());
    tables.push_back(table_of_contact_way());
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const TableDescription &table : tables)
      {
        nlohmann::ordered_json columns = nlohmann::ordered_json::array();
        for (const TableDescription::Line &column : table.columns)
          columns.push_back({{"name", column.heading}, {"unit", column.unit}, {"meaning", column.about}});
        list.push_back({{"file", table.file}, {"columns", columns}});
      }
    out << list.dump(2) << '\n';
  }
} // namespace tread
