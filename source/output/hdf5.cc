// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/csv_table.h>
#include <tread/base/version.h>
#include <tread/output/run_folder.h>

#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace tread
{
  namespace
  {
    /// What HDF5 has opened; closed at the end of its scope.
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*close)(hid_t))
        : id(id)
        , close(close)
      {
        if (id < 0)
          throw std::runtime_error("HDF5");
      }
      ~Handle()
      {
        close(id);
      }
      Handle(const Handle &)            = delete;
      Handle &operator=(const Handle &) = delete;
              operator hid_t() const
      {
        return id;
      }

    private:
      const hid_t id;
      herr_t (*const close)(hid_t);
    };

    void check(const herr_t result)
    {
      if (result < 0)
        throw std::runtime_error("HDF5");
    }

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

    /// A column, compressed, with one attribute.
    template <typename Number>
    void write_column(const hid_t                group,
                      const std::string         &name,
                      const std::vector<Number> &values,
                      const hid_t                type,
                      const std::string         &attribute,
                      const std::string         &meaning)
    {
      const hsize_t n = values.size();
      const Handle  space(H5Screate_simple(1, &n, nullptr), H5Sclose),
        how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      if (n > 0)
        {
          const hsize_t chunk = std::min<hsize_t>(n, 16384);
          check(H5Pset_chunk(how, 1, &chunk));
          check(H5Pset_shuffle(how));
          check(H5Pset_deflate(how, 4));
        }
      const Handle dataset(H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT),
                           H5Dclose);
      if (n > 0)
        check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
      set_attribute(dataset, attribute, meaning);
    }

    void write_group(const hid_t file, const std::string &path, const std::string &name)
    {
      const auto is_word = [](const std::string &column) {
        return column == "state";
      };
      const CsvTable table(
        path, [](const std::string &) { return true; }, "cannot read '" + path + "'", is_word);
      const Handle group(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
      for (const std::string &column : table.names())
        if (is_word(column))
          {
            std::vector<std::uint8_t> states;
            for (const std::string &word : table.words(column))
              states.push_back(word == "slip" ? 2 : 1);
            write_column(group, column, states, H5T_NATIVE_UINT8, "meaning", "1: adhesion, 2: slip");
          }
        else
          write_column(group, column, table.column_as_it_is(column), H5T_NATIVE_DOUBLE, "unit",
                       unit_of_heading(column));
    }

    std::string text_of_file(const std::string &path)
    {
      std::ifstream file(path);
      return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }
  } // namespace


  void RunFolder::write_hdf5(const std::string                                      &summary,
                             const std::vector<std::pair<std::string, std::string>> &parameters) const
  {
    if (!writes_tables)
      return;
    const std::string temporary = path("run.h5.part");
    std::error_code   ignored;
    try
      {
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
        // The format of HDF5 1.10 needs a third of the room of older ones for columns of some hundred rows.
        const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
        check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110));
        const Handle file(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
        set_attribute(file, "program", "tread " + version());
        write_text(file, "summary.json", summary);
        write_text(file, "parameters.prm", text_of_file(path("parameters.prm")));
        {
          const Handle group(H5Gcreate2(file, "parameters", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
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
      }
    catch (const std::exception &)
      {
        std::filesystem::remove(temporary, ignored);
        throw std::runtime_error("cannot write '" + path("run.h5") + "': is the disk full?");
      }
    std::filesystem::rename(temporary, path("run.h5"));
  }
} // namespace tread
