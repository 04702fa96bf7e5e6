// SPDX-License-Identifier: LGPL-2.1-or-later
// What a run keeps of its way: extremes of the forces, ripples of the force at its end, the mean of the
// patch, and what the cost of a run is estimated from.
#include <tread/base/file_text.h>
#include <tread/recorders/end_of_way.h>
#include <tread/recorders/impact_record.h>
#include <tread/recorders/solution.h>
#include <tread/simulation/simulation.h>

#include <deal.II/base/numbers.h>

#include "check.h"
#include "reopened.h"
#include "temporary_folder.h"
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

using namespace tread;

namespace simulation_records
{
  /// A row of the history with two supports. @param x place of the wheel, m; @param force on it, N
  HistoryRow row_of(const double               x,
                    const double               force,
                    const std::vector<double> &pads    = {},
                    const std::vector<double> &ballast = {})
  {
    HistoryRow row{};
    row.time     = x / 20.;
    row.position = x;
    row.wheels.resize(1);
    row.wheels.front().force = Vector3{0.31 * force, 0.07 * force, force, 0.};
    for (std::size_t i = 0; i < pads.size(); ++i)
      row.supports.push_back({pads[i], ballast[i], 1e6, 1e5, -1e-3, -2e-3});
    return row;
  }

  constexpr double static_load = 80e3; // N

  nlohmann::json figures(const ImpactRecord &record)
  {
    Summary summary;
    record.add_to(summary);
    return nlohmann::json::parse(summary.text());
  }

  /// One extreme of the summary.
  void check_extreme(tests::Check         &check,
                     const nlohmann::json &of,
                     const std::string    &name,
                     const double          force,
                     const double          x,
                     const bool            at_end)
  {
    check.relative(name + ", kN", 1e-3 * of.value(name + "_N", 0.), force, 1e-12);
    check.relative(name + ": place of the wheel, mm", 1e3 * of.value(name + "_x_m", 0.), x, 1e-12);
    check.that(name + (at_end ? " is that of the end" : " is a peak on the way"),
               of.value(name + "_at_end", !at_end) == at_end);
  }


  void check_impacts(tests::Check &check)
  {
    // The wheel leaves the rail in the third and the fourth interval, of 2 and 3 ms.
    const std::vector<int> supports{-3, 8};
    ImpactRecord           record(static_load, supports);
    record.add(row_of(1e-3, 81e3, {21e3, 11e3}, {17e3, 9e3}), 1e-3);
    record.add(row_of(2e-3, 151e3, {23e3, 12e3}, {16e3, 29e3}), 1.5e-3);
    record.add(row_of(3e-3, 0., {22e3, 41e3}, {15e3, 8e3}), 2e-3);
    record.add(row_of(4e-3, 0., {19e3, 13e3}, {14e3, 7e3}), 3e-3);
    record.add(row_of(5e-3, 97e3, {18e3, 14e3}, {13e3, 6e3}), 4e-3);
    const nlohmann::json all = figures(record);
    check_extreme(check, all, "largest_normal_force", 151., 2., false);
    check.relative("largest_normal_force_over_static", all["largest_normal_force_over_static"].get<double>(),
                   151. / 80., 1e-12);
    check.below("least_normal_force of a wheel that leaves the rail, kN",
                1e-3 * all["least_normal_force_N"].get<double>(), 0.);
    check.relative("least_normal_force: where it is reached first, mm",
                   1e3 * all["least_normal_force_x_m"].get<double>(), 3., 1e-12);
    check.relative("airborne_s: time in the air, ms", 1e3 * all["airborne_s"].get<double>(), 5., 1e-12);
    check_extreme(check, all, "largest_pad_force", 41., 3., false);
    check.absolute("largest_pad_force_support", all["largest_pad_force_support"].get<double>(), 8., 0.);
    check_extreme(check, all, "largest_ballast_force", 29., 2., false);
    check.absolute("largest_ballast_force_support", all["largest_ballast_force_support"].get<double>(), 8.,
                   0.);
    const std::string lines = record.words();
    check.that("in words: time in the air", lines.find("in the air for 5.000 ms") != std::string::npos);
    check.that("in words: the support", lines.find("29.00 kN, at support 8,") != std::string::npos);
    check.that("in words: all are peaks", lines.find("no peak") == std::string::npos);

    // Forces that still grow, or fall, when the run ends.
    ImpactRecord growing(static_load, {-3});
    growing.add(row_of(1e-3, 81e3, {21e3}, {17e3}), 1e-3);
    growing.add(row_of(2e-3, 77e3, {19e3}, {18e3}), 1e-3);
    const nlohmann::json of = figures(growing);
    check_extreme(check, of, "largest_normal_force", 81., 1., false);
    check_extreme(check, of, "least_normal_force", 77., 2., true);
    check_extreme(check, of, "largest_pad_force", 21., 1., false);
    check_extreme(check, of, "largest_ballast_force", 18., 2., true);
    check.absolute("largest_ballast_force_support of one", of["largest_ballast_force_support"].get<double>(),
                   -3., 0.);
    check.below("airborne_s: never", of["airborne_s"].get<double>(), 0.);
    check.that("in words: the end is no peak",
               growing.words().find("the end of the run, no peak") != std::string::npos);

    // Of both wheels of a wheelset the own one counts, whose rail has the defect: it is in the air.
    ImpactRecord of_own(static_load, {});
    HistoryRow   both                  = row_of(1e-3, 83e3);
    both.wheels.front().other_force[2] = 83e3;
    of_own.add(both, 2e-3);
    check.relative("airborne_s of the own wheel of two, ms",
                   1e3 * figures(of_own)["airborne_s"].get<double>(), 2., 1e-12);

    const ImpactRecord nothing(static_load, {});
    ImpactRecord       without(static_load, {});
    without.add(row_of(1e-3, 81e3), 1e-3);
    check.that("without supports nothing is said of them", !figures(without).contains("largest_pad_force_N"));
    check.that("nothing is said where nothing was recorded",
               figures(nothing).empty() && nothing.words().empty());

    // A run that is resumed remembers.
    Archive stored(MPI_COMM_SELF);
    record.serialize(stored);
    Archive      opened(MPI_COMM_SELF, tests::parts_of(stored, MPI_COMM_SELF));
    ImpactRecord again(static_load, supports);
    again.serialize(opened);
    check.that("resumed: the same figures", figures(again) == all);
  }


  /// Sines over whole turns about straight lines, of which the fit takes less the more turns there are.
  void check_ripple(tests::Check &check)
  {
    constexpr unsigned int n = 4000, turns = 40;
    constexpr double       normal = 80e3, along = 0.03, across = 0.04; // N; amplitudes over the normal force
    const auto             ripple = [&](const double share_x, const double share_y) {
      ForceRipple record;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double x = 0.3 + 0.01 * i / n, sine = std::sin(2. * dealii::numbers::PI * turns * i / n);
          record.add(x, normal * Vector3{0.2 + 3. * (x - 0.3) + share_x * sine,
                                         -0.1 - 2. * (x - 0.3) + share_y * sine, 1., 0.});
        }
      return record.share();
    };
    check.below("ripple of forces that grow in a straight line", ripple(0., 0.), 1e-6);
    check.relative("ripple of a sine along the rail", ripple(along, 0.), along, 1e-3);
    check.relative("ripple of a sine across it", ripple(0., across), across, 1e-3);
    check.relative("ripple of both", ripple(along, across), 0.05, 1e-3);
  }


  /// What was stored, in another one.
  template <typename Record>
  void reopen(Record &record, Record &again)
  {
    Archive stored(MPI_COMM_SELF);
    record.serialize(stored);
    Archive opened(MPI_COMM_SELF, tests::parts_of(stored, MPI_COMM_SELF));
    again.serialize(opened);
  }


  /// A normal force that falls by more than it rises.
  void check_mean_force(tests::Check &check)
  {
    MeanForce falling, rising, again;
    for (const double force : {100e3, 70e3, 104e3, 90e3})
      falling.add(Vector3{0.1 * force, 0., force, 0.});
    check.relative("mean force at the end, kN", 1e-3 * falling.mean()[2], 91., 1e-12);
    check.relative("mean force at the end, along the rail, kN", 1e-3 * falling.mean()[0], 9.1, 1e-12);
    check.relative("ripple of a normal force that falls", falling.ripple(), 21. / 91., 1e-12);
    for (const double force : {90e3, 88e3, 113e3})
      rising.add(Vector3{0., 0., force, 0.});
    check.relative("ripple of a normal force that rises", rising.ripple(), 16. / 97., 1e-12);
    check.that("nothing was added", again.is_empty() && again.ripple() == 0.);
    reopen(falling, again);
    check.relative("resumed: mean force at the end, kN", 1e-3 * again.mean()[2], 91., 1e-12);
    check.relative("resumed: its ripple", again.ripple(), 21. / 91., 1e-12);
  }


  /// Steps before and after the run is resumed make one mean.
  void check_averaged_patch(tests::Check &check)
  {
    ContactNodeState state{};
    state.normal   = Vector3{0., 0., 1., 0.};
    state.area     = 1e-6;
    const auto add = [&](PatchAverage &to, const double pressure) {
      constexpr double time_step = 1e-7;
      state.impulse              = Vector3{0., 0., pressure * state.area * time_step, 0.};
      to.add({state}, 0., time_step);
    };
    PatchAverage average, again;
    add(average, 500e6);
    reopen(average, again);
    add(again, 900e6);
    check.absolute("averaged patch, resumed: steps", again.n_steps(), 2, 0.);
    check.relative("averaged patch, resumed: pressure, MPa", 1e-6 * again.measures().max_pressure, 700.,
                   1e-12);
  }


  /// A small scene whose mesh is made in no time.
  void read_small_block(Scene &scene)
  {
    scene.read("",
               {"Rail/Shape=block", "Mesh/Finest cell (mm)=2.5", "Mesh/Fine half width (mm)=10",
                "Motion/Speed (km per h)=0.1", "Motion/Rolled distance (mm)=10", "Scene/Density scale=4"});
  }


  /// Recorders look at the piece of the way that is theirs, remember it, and forget it.
  void check_pieces_of_the_way(tests::Check &check)
  {
    Scene scene;
    read_small_block(scene);
    Model    model(scene, MPI_COMM_SELF, {});
    Solution solution(model), solution_again(model);
    // One step each 0.25 mm, from before the means to their end half a cell of 2.5 mm beyond the path's.
    constexpr double step    = 0.25e-3;
    unsigned int     n_steps = 0;
    for (double x = scene.path_end() - 3e-3 + 0.5 * step; x < model.end_position(); x += step)
      {
        model.wheels.front().hub.motion.x = x;
        solution.add_step();
        ++n_steps;
      }
    check.absolute("steps on 4.25 mm", n_steps, 17, 0.);
    check.absolute("of which those on the last cell of 2.5 mm are averaged", solution.average().n_steps(), 10,
                   0.);
    reopen(solution, solution_again);
    check.absolute("resumed: averaged steps", solution_again.average().n_steps(), 10, 0.);
    check.that("resumed: the solution is yet to come", !solution_again.is_taken());
    solution.forget_solution();
    check.absolute("forgotten: averaged steps", solution.average().n_steps(), 0, 0.);

    const WayPassed way{-0.07, -0.0604, -0.0596}; // over 10 mm from the path's begin
    check.that("way: an interval ends on it", way.has_end_of(10e-3) && way.has_end_of(0.5e-3));
    check.that("way: none ends on it", !way.has_end_of(4e-3) && !way.has_end_of(0.));
  }


  /// What a call prints.
  template <typename Call>
  std::string printed(const Call &call)
  {
    const tests::TemporaryFolder folder;
    const std::string            name = folder.path + "/printed";
    std::fflush(stdout);
    const int  screen = dup(STDOUT_FILENO);
    std::FILE *file   = std::fopen(name.c_str(), "w+");
    if (screen < 0 || file == nullptr)
      return "";
    dup2(fileno(file), STDOUT_FILENO);
    call();
    std::fflush(stdout);
    dup2(screen, STDOUT_FILENO);
    close(screen);
    std::fclose(file);
    return text_of_file(name);
  }

  /// With the scale s of the density a run needs 1/sqrt(s) of the steps. What the start takes is the same: it
  /// drops out of differences.
  void check_estimate(tests::Check &check)
  {
    Scene scene;
    read_small_block(scene);
    const std::string text    = printed([&] { estimate(scene, MPI_COMM_SELF); });
    const auto        seconds = [&](const std::string &scale) {
      const std::string line = "'Density scale' " + scale + ": s";
      const std::size_t at   = text.find(line);
      return at == std::string::npos ? 0. : std::atof(text.c_str() + at + line.size());
    };
    const double like_true = seconds("   1"), four = seconds("   4"), much = seconds("  25");
    std::printf("%s", text.c_str());
    check.that("estimate: a run with the true density lasts longest", like_true > four && four > much);
    // Tenths of a second are printed: each difference may be off by one of them.
    const double tenths = 0.1 / std::abs(like_true - four) + 0.1 / std::abs(four - much);
    check.relative("estimate: saved by a density scale of 4 over that of 25 instead of 4",
                   (like_true - four) / (four - much), (1. - 1. / 2.) / (1. / 2. - 1. / 5.), tenths);
  }
} // namespace simulation_records


TREAD_TEST(simulation_records)(tests::Check &check, const tests::Arguments &)
{
  check_impacts(check);
  check_ripple(check);
  check_mean_force(check);
  check_averaged_patch(check);
  check_pieces_of_the_way(check);
  check_estimate(check);
}
