// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/input_error.h>
#include <tread/tools/answer_table.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace tread
{
  void check_answer_table(const std::string &option,
                          const std::string &table,
                          const std::string &output,
                          const MPI_Comm     comm)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
      throw InputError(option + " uses all cores by itself; start it without mpirun");
    if (output.empty())
      throw InputError(option + " needs --output RESULTS.csv");
    if (std::filesystem::is_directory(output))
      throw InputError("--output '" + output + "' is a folder; " + option + " writes a table");
    std::error_code none;
    if (std::filesystem::equivalent(table, output, none))
      throw InputError(option + " reads '" + table + "'; --output must be another file");
  }


  void write_answer_table(const std::string &output, const std::function<void(std::ostream &)> &write)
  {
    const bool        is_file = !std::filesystem::exists(output) || std::filesystem::is_regular_file(output);
    const std::string part    = is_file ? output + ".part" : output;
    std::ofstream     file(part);
    write(file);
    file.close();
    if (!file)
      {
        std::error_code ignored;
        if (is_file)
          std::filesystem::remove(part, ignored);
        throw std::runtime_error("cannot write '" + output + "': is the disk full?");
      }
    if (is_file)
      std::filesystem::rename(part, output);
  }
} // namespace tread
