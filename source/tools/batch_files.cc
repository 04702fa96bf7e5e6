// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/csv_table.h>
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/half_space.h>
#include <tread/output/progress.h>
#include <tread/tools/answer_table.h>
#include <tread/tools/batch_files.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <ostream>
#include <stdexcept>

namespace tread
{
  namespace
  {
    struct CaseColumn
    {
      const char *name;
      double tread_half_space_case::*value;
      bool                           required;
    };
    const CaseColumn      case_columns[] = {{"A_per_m", &tread_half_space_case::curvature_x, true},
                                            {"B_per_m", &tread_half_space_case::curvature_y, true},
                                            {"normal_force_N", &tread_half_space_case::normal_force, true},
                                            {"friction", &tread_half_space_case::friction, true},
                                            {"young_Pa", &tread_half_space_case::young, true},
                                            {"poisson", &tread_half_space_case::poisson, true},
                                            {"creepage", &tread_half_space_case::creepage, true},
                                            {"lateral_creepage", &tread_half_space_case::lateral_creepage, true},
                                            {"spin_per_m", &tread_half_space_case::spin, true},
                                            {"element_x_m", &tread_half_space_case::element_x, false},
                                            {"element_y_m", &tread_half_space_case::element_y, false}};
    constexpr const char *order_column = "slip_order", *strength_column = "shear_strength_Pa";
    constexpr double      least_shear_strength = 1e6,
                     most_shear_strength       = 1e11; // Pa, softer and harder than any metal's
    const std::string answer_columns = ",longitudinal_force_N,lateral_force_N,spin_moment_Nm,max_pressure_Pa,"
                                       "adhesion_share,iterations,area_m2,"
                                       "approach_m,frictional_work_J_per_m,status,friction_used,"
                                       "t_gamma_per_area_Pa,regime_wear_rate_kg_per_m3,";
    /// Those that need the yield stress in shear.
    const std::string strength_columns = "shakedown_load_factor,surface_fatigue_index,";

    std::vector<tread_half_space_case> read_cases(const std::string   &file,
                                                  std::string         &not_read,
                                                  TableGrammar        &grammar,
                                                  std::vector<double> &strengths)
    {
      const CsvTable table(
        file,
        [&](const std::string &name) {
          const bool known = name == order_column || name == strength_column ||
                             std::any_of(std::begin(case_columns), std::end(case_columns),
                                         [&](const CaseColumn &c) { return c.name == name; });
          if ((answer_columns + strength_columns).find("," + name + ",") != std::string::npos)
            throw InputError("'" + file + "' has a column '" + name + "', which is one of the answers");
          if (!known)
            not_read += (not_read.empty() ? "" : ", ") + name;
          return known;
        },
        "tread batch: cannot read '" + file + "'");
      if (table.n_rows() == 0)
        throw InputError("'" + file + "' has no rows");
      grammar = table.grammar();
      std::vector<tread_half_space_case> cases(table.n_rows());
      for (const CaseColumn &c : case_columns)
        if (c.required || table.has(c.name))
          for (std::size_t row = 0; row < cases.size(); ++row)
            cases[row].*c.value = table.column_as_it_is(c.name)[row]; // nan is refused with its row alone
      if (table.has(strength_column))
        strengths = table.column_as_it_is(strength_column); // nan: not known
      for (std::size_t row = 0; row < strengths.size(); ++row)
        if (!std::isnan(strengths[row]) &&
            !(strengths[row] >= least_shear_strength && strengths[row] <= most_shear_strength))
          throw InputError(
            "'" + file + "', row " + std::to_string(row + 1) + ": '" + strength_column + "' " +
            format("%g must be from %g to %g Pa", strengths[row], least_shear_strength, most_shear_strength));
      for (std::size_t row = 0; row < cases.size(); ++row)
        {
          const double order = table.has(order_column)     ? table.column(order_column)[row]
                               : cases[row].element_x > 0. ? 1.
                                                           : 2.;
          if (order != 1. && order != 2.)
            throw InputError("'" + file + "', row " + std::to_string(row + 1) + ": '" + order_column +
                             "' must be 1 or 2");
          cases[row].slip_order = static_cast<int>(order);
        }
      return cases;
    }

    /// The rows as they are, each with its answer, by the grammar of the table.
    void write_answers(const std::string                          &cases,
                       std::ostream                               &file,
                       const TableGrammar                         &grammar,
                       const std::vector<tread_half_space_answer> &answers,
                       const std::vector<tread_half_space_damage> &damages,
                       const bool                                  has_strengths)
    {
      const std::vector<NumberedLine> lines = csv_lines(cases);
      // Our own columns have commas and points.
      const auto in_grammar = [&](std::string own) {
        for (char &c : own)
          if (c == ',')
            c = grammar.separator;
          else if (c == '.')
            c = grammar.decimal;
        return own;
      };
      // A separator that ends a line is left out.
      const std::size_t n_entries = entries_of(lines.front().text, grammar.separator).size(),
                        n_columns = n_entries - (lines.front().text.back() == grammar.separator ? 1 : 0);
      const auto row_of           = [&](std::string line) {
        line.erase(line.find_last_not_of(" \t\r") + 1);
        if (entries_of(line, grammar.separator).size() == n_columns + 1)
          line.pop_back();
        return line;
      };
      const std::string headings = answer_columns + (has_strengths ? strength_columns : "");
      file << row_of(lines.front().text) << in_grammar(headings.substr(0, headings.size() - 1)) << '\n';
      std::size_t at = 0;
      for (std::size_t k = 0; k < answers.size(); ++k)
        {
          const tread_half_space_answer &a = answers[k];
          const tread_half_space_damage &d = damages[k];
          std::string                    line;
          do
            {
              ++at;
              line = row_of(lines[at].text.substr(0, lines[at].text.find('#')));
            }
          while (line.empty());
          std::string text = format(",%.9g,%.9g,%.9g,%.9g,%.9g,%d,%.9g,%.9g,%.9g,%d,%.9g,%.9g,%.9g",
                                    a.longitudinal_force, a.lateral_force, a.spin_moment, a.max_pressure,
                                    a.adhesion_share, a.iterations, a.area, a.approach, a.frictional_work,
                                    a.status, d.friction_used, d.t_gamma_per_area, d.regime_wear_rate);
          if (has_strengths)
            text += format(",%.9g,%.9g", d.shakedown_load_factor, d.surface_fatigue_index);
          file << line << in_grammar(text) << '\n';
        }
    }
  } // namespace


  void write_batch(const std::string &cases, const std::string &output, const MPI_Comm comm)
  {
    check_answer_table("tread batch", cases, output, comm);
    if (std::filesystem::exists(cases) && !std::filesystem::is_directory(cases) &&
        !std::filesystem::is_regular_file(cases))
      throw InputError("tread batch reads its table twice; '" + cases + "' is no file");
    Progress                                 progress(true);
    std::string                              not_read;
    TableGrammar                             grammar;
    std::vector<double>                      strengths; // none, or one for each case
    const std::vector<tread_half_space_case> problems = read_cases(cases, not_read, grammar, strengths);
    if (!not_read.empty())
      progress.say("note: columns that mean nothing here, kept: " + not_read);
    std::vector<tread_half_space_answer> answers(problems.size());
    const std::size_t                    failed =
      tread_half_space_solve_all(problems.data(), problems.size(), 0, answers.data());
    std::vector<tread_half_space_damage> damages(problems.size());
    tread_half_space_damage_of(problems.data(), answers.data(), problems.size(),
                               strengths.empty() ? nullptr : strengths.data(), damages.data());
    write_answer_table(output, [&](std::ostream &file) {
      write_answers(cases, file, grammar, answers, damages, !strengths.empty());
    });
    progress.say(
      format("%zu cases in %.2f s. Results in %s", problems.size(), progress.seconds(), output.c_str()));
    if (failed > 0)
      {
        const std::size_t first =
          std::find_if(answers.begin(), answers.end(),
                       [](const auto &a) { return a.status != TREAD_HALF_SPACE_SOLVED; }) -
          answers.begin();
        const std::unique_ptr<tread_half_space, void (*)(tread_half_space *)> solver(
          tread_half_space_create(), tread_half_space_destroy);
        tread_half_space_answer again;
        tread_half_space_solve(solver.get(), &problems[first], &again);
        throw std::runtime_error(
          format("%zu of %zu cases were not solved, in their rows stands nan; the first is row %zu: ", failed,
                 problems.size(), first + 1) +
          tread_half_space_message(solver.get()));
      }
  }
} // namespace tread
