// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_recorder_h
#define tread_recorders_recorder_h

#include <tread/base/archive.h>
#include <tread/output/records.h>
#include <tread/output/run_folder.h>
#include <tread/output/summary.h>

#include <cmath>
#include <string>
#include <vector>

namespace tread
{
  /// A piece of the first wheel's way, from where recorders were last asked to where it is. No sums are used,
  /// so that a resumed run finds the same.
  struct WayPassed
  {
    double path_begin, from, to; ///< m

    /// Whether one of the intervals into which the path is divided has ended on it; never for one of 0.
    bool has_end_of(const double interval) const
    {
      const auto number = [&](const double x) {
        return std::floor((x - path_begin) / interval);
      };
      return interval > 0. && number(to) > number(from);
    }
  };

  /// What a run says at its end.
  struct Report
  {
    RunFolder               &folder;
    const bool               completed;
    Summary                  summary  = {};
    std::vector<std::string> warnings = {};
    std::string              extremes = {}; ///< lines for the screen, above the table of the answer
    std::string              lines    = {}; ///< likewise, below it
  };

  /// Something that a run keeps of what rolls, and writes: a table, pictures, means, extremes. The loop, the
  /// checkpoints and the end of a run ask all recorders in the order in which they were added and know none
  /// of them by name but those that others build on. What a recorder needs of the model it is given when it
  /// is made.
  ///
  /// All functions are called by all ranks alike.
  class Recorder
  {
  public:
    virtual ~Recorder() = default;

    /// Begin the tables that grow, or continue those of the run that is resumed.
    virtual void open(RunFolder &)
    {
    }
    /// The motion begins.
    virtual void start()
    {
    }
    /// To be called after each step; nodes may be at different instants.
    virtual void add_step()
    {
    }
    /// All nodes are at one instant: write what was due on this piece of the way.
    virtual void pass(const WayPassed &, RunFolder &)
    {
    }
    /// An interval of the history has ended. @param seconds that it took
    virtual void add_row(const HistoryRow &, const double /*seconds*/, RunFolder &)
    {
    }
    /// The first wheel is at the end of its path, where the answer of the run is taken.
    virtual void take_solution(RunFolder &)
    {
    }
    /// That instant is yet to come, for another passage or on a longer way.
    virtual void forget_solution()
    {
    }
    /// New wheels are placed on the rail.
    virtual void begin_passage()
    {
    }
    /// What serialize() cannot find again because it is kept on cells: that of the same recorder before the
    /// window of fine cells moved.
    virtual void take_over(const Recorder & /*before*/)
    {
    }
    /// Write what is known at the end, and say it.
    virtual void finish(Report &)
    {
    }
    /// Store or restore the state. Collective.
    virtual void serialize(Archive &)
    {
    }
  };
} // namespace tread

#endif
