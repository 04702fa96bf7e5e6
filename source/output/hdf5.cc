// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/csv_table.h>
#include <tread/base/file_text.h>
#include <tread/base/hdf5_file.h>
#include <tread/base/version.h>
#include <tread/output/run_folder.h>

#include <algorithm>
#include <filesystem>

namespace tread
{
  namespace
  {
    using namespace hdf5;

    /// A string of variable length.
    hid_t text_type()
    {
      const hid_t type = H5Tcopy(H5T_C_S1);
      H5Tset_size(type, H5T_VARIABLE);
      H5Tset_cset(type, H5T_CSET_UTF8);
      return type;
    }

    void set_attribute(const hid_t object, const std::string &name, const std::string &text)
    {
      const Handle type(text_type(), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose),
        attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
      const char *data = text.c_str();
      check(H5Awrite(attribute, type, &data));
    }

    void write_text(const hid_t group, const std::string &name, const std::string &text)
    {
      const Handle type(text_type(), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose),
        dataset(H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                H5Dclose);
      const char *data = text.c_str();
      check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &data));
    }

    void set_attribute_of(const hid_t        group,
                          const std::string &dataset,
                          const std::string &name,
                          const std::string &text)
    {
      const Handle column(H5Dopen2(group, dataset.c_str(), H5P_DEFAULT), H5Dclose);
      set_attribute(column, name, text);
    }

    void write_group(const hid_t file, const std::string &path, const std::string &name)
    {
      const auto is_word = [](const std::string &column) {
        return column == "state";
      };
      const CsvTable table(
        path, [](const std::string &) { return true; }, "cannot read '" + path + "'", is_word);
      const Handle group(create_group(file, name), H5Gclose);
      for (const std::string &column : table.names())
        if (is_word(column))
          {
            std::vector<std::uint8_t> states;
            for (const std::string &word : table.words(column))
              states.push_back(word == "slip" ? 2 : 1);
            write_rows(group, column, states);
            set_attribute_of(group, column, "values", "1: adhesion, 2: slip");
          }
        else
          {
            write_rows(group, column, table.column_as_it_is(column));
            set_attribute_of(group, column, "unit", unit_of_heading(column));
          }
      const std::string file_name = std::filesystem::path(path).filename();
      for (const std::string &column : table.names())
        if (const std::string about = about_column(file_name, column); !about.empty())
          set_attribute_of(group, column, "meaning", about);
    }
  } // namespace


  void RunFolder::write_hdf5(const std::string                                      &summary,
                             const std::vector<std::pair<std::string, std::string>> &parameters) const
  {
    if (!writes_tables)
      return;
    write_through("run.h5", [&](const std::string &temporary) {
      const Handle file(create(temporary), H5Fclose);
      set_attribute(file, "program", "tread " + version());
      write_text(file, "summary.json", summary);
      write_text(file, "parameters.prm", text_of_file(path("parameters.prm")));
      {
        const Handle group(create_group(file, "parameters"), H5Gclose);
        for (const auto &[name, value] : parameters)
          set_attribute(group, name, value);
      }
      std::vector<std::filesystem::path> tables;
      for (const auto &entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".csv" && is_own(entry.path().filename()))
          tables.push_back(entry.path());
      std::sort(tables.begin(), tables.end());
      for (const std::filesystem::path &table : tables)
        write_group(file, table, table.stem());
      check(H5Fflush(file, H5F_SCOPE_GLOBAL));
    });
  }
} // namespace tread
