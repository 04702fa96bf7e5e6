// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_columns_h
#define tread_output_columns_h

#include <tread/analysis/contact_patch.h>
#include <tread/analysis/surface_damage.h>
#include <tread/output/records.h>

#include <array>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace tread
{
  /// A column of a table: what its heading says and what its rows have, in one place.
  template <typename Record>
  struct Column
  {
    std::string name;  ///< of the quantity
    std::string unit;  ///< as in the heading; empty: a pure number
    std::string about; ///< what it is, a line
    /// In SI units; the factor to the column's unit follows from its name.
    std::function<double(const Record &)> value;
    /// A word instead of a number, if it is given.
    std::function<std::string(const Record &)> word = {};
  };

  template <typename Record>
  using Columns = std::vector<Column<Record>>;

  /// What a value in SI units is multiplied by to have a column's unit, 1 for SI units themselves.
  double factor_of(const std::string &unit);

  /// The unit that a column's heading ends with, such as m_per_s of slip_x_m_per_s; "" of a pure number.
  std::string unit_of_heading(const std::string &heading);

  /// What the heading has for a column: its name with its unit.
  template <typename Record>
  std::string heading(const Column<Record> &column)
  {
    return column.name + (column.unit.empty() ? "" : "_" + column.unit);
  }

  /// Those of all, separated by commas, without an end of line.
  template <typename Record>
  std::string heading(const Columns<Record> &columns)
  {
    std::string line;
    for (const Column<Record> &column : columns)
      line += (line.empty() ? "" : ",") + heading(column);
    return line;
  }

  /// Add the columns of one of the parts of a row, with a prefix to their names. @param part of the row
  template <typename Row, typename Part, typename PartOf>
  void add_columns(Columns<Row>        &columns,
                   const Columns<Part> &of_part,
                   const std::string   &prefix,
                   const PartOf        &part)
  {
    for (const Column<Part> &column : of_part)
      {
        Column<Row> own{prefix + column.name, column.unit, column.about, {}, {}};
        if (column.word)
          own.word = [part, word = column.word](const Row &r) {
            return word(part(r));
          };
        else
          own.value = [part, value = column.value](const Row &r) {
            return value(part(r));
          };
        columns.push_back(own);
      }
  }

  /// A table for those who read it.
  struct TableDescription
  {
    struct Line
    {
      std::string heading, unit, about;
    };
    std::string       file;
    std::vector<Line> columns;
  };

  template <typename Record>
  TableDescription describe(const std::string &file, const Columns<Record> &columns)
  {
    TableDescription table{file, {}};
    for (const Column<Record> &column : columns)
      table.columns.push_back({heading(column), column.unit, column.about});
    return table;
  }

  /// A word as tables have it: in quotation marks if it holds a comma, at which readers would split it.
  std::string quoted_word(const std::string &word);

  /// A row with its end of line.
  template <typename Record>
  void write_row(std::ostream &out, const Columns<Record> &columns, const Record &row)
  {
    const char *separator = "";
    for (const Column<Record> &column : columns)
      {
        out << separator;
        separator = ",";
        if (column.word)
          out << quoted_word(column.word(row));
        else if (const double factor = factor_of(column.unit); factor != 1.)
          out << factor * column.value(row);
        else
          out << column.value(row);
      }
    out << '\n';
  }

  /// Columns of arrays of values in SI units, in their order. @param texts name, unit and what it is
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

  // Tables that several write; those of one recorder are described beside it. A new column is one line in
  // its list.

  const Columns<PatchNode>  &patch_columns();
  const Columns<PatchesRow> &patches_columns();
  Columns<SurfacePlace>      surface_damage_columns(bool of_wheel);

  /// All tables that a run can leave, with all columns that they can have: one support, 0, the second one of
  /// several wheels, and one cell stand for others.
  std::vector<TableDescription> tables_of_a_run();

  /// Have a further table known as one of a run, to tread columns, run.h5 and the folder of the results:
  /// for a constant beside its columns, before main() begins. @returns true
  bool know_table(const TableDescription &table);

  /// Whether a file of this name is a table of a run, whatever numbers it has.
  bool is_table_of_a_run(const std::string &file);

  /// Of a column in one of them, whatever numbers its name has; empty: it is none. @param file its name
  std::string about_column(const std::string &file, const std::string &heading);
} // namespace tread

#endif
