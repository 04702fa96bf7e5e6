// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_summary_h
#define tread_output_summary_h

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace tread
{
  /// The figures of a run: names with units, values, and reference values.
  class Summary
  {
  public:
    template <typename T>
    void set(const std::string &name, const T &value)
    {
      require_meaning(name);
      json[name] = value;
    }

    /// A figure that is also a line of the table. @param scale from SI to the unit shown there.
    /// @param after label of the line that it is to follow; empty or not there: at the end.
    void show(const std::string &name,
              const std::string &label,
              const double       scale,
              const double       value,
              const std::string &after = "");

    /// A figure with its reference value, which is written under "reference" in the file and shown as a line
    /// of the table.
    /// @param scale from SI to the unit shown in the table. @param negligible magnitude below which a
    /// reference is treated as zero: the relative difference from it is meaningless and is written as null.
    /// @param uncertainty of the reference itself; written with it, and as `<name>_half_space_uncertainty`
    /// (the source, in lower case with underscores) among the figures.
    void compare(const std::string    &name,
                 const std::string    &label,
                 const double          scale,
                 const double          value,
                 const std::string    &source,
                 const double          reference_value,
                 const double          negligible  = 0.,
                 std::optional<double> uncertainty = {});

    std::string text() const
    {
      return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    }

    /// Computed value, reference and difference, one line for each figure; a column for each reference.
    std::string table() const;

  private:
    /// Debug builds stop at a name that about_summary_key() does not know.
    static void require_meaning(const std::string &name);

    struct Line
    {
      std::string           label, source; // no source: nothing to compare with
      double                value, reference;
      std::optional<double> difference;  // relative
      std::optional<double> uncertainty; // of the reference, scaled
    };
    nlohmann::ordered_json json;
    std::vector<Line>      lines;
  };
} // namespace tread

#endif
