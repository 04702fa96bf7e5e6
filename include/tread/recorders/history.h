// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_history_h
#define tread_recorders_history_h

#include <tread/analysis/rail_stress.h>
#include <tread/model/model.h>
#include <tread/output/columns.h>
#include <tread/recorders/recorder.h>

#include <memory>
#include <vector>

namespace tread
{
  /// What has columns in history.csv.
  struct HistoryParts
  {
    unsigned int     n_wheels;                  ///< all but the first have their number in the name
    bool             moves_across;              ///< the first one, across its track
    bool             has_both_wheels;           ///< the first one's wheelset
    std::vector<int> supports;                  ///< their numbers
    bool             base_moves_across = false; ///< of the rail, on a track that runs along
    bool             base_pitches      = false; ///< on a beam
    bool             has_flexible_axle = false; ///< the first one's wheelset
    bool             has_slices        = false; ///< a rail that changes along the way
    bool             has_two_pieces    = false; ///< of it, such as nose and wing
    bool             has_window        = false; ///< of fine cells, which moves
  };
  /// history.csv.
  Columns<HistoryRow> history_columns(const HistoryParts &parts);
  /// cells.csv. @param n_cells so many have columns
  Columns<HistoryRow> cell_columns(std::size_t n_cells);

  /// history.csv and cells.csv: means over intervals of the way, and the state at their ends.
  class History : public Recorder
  {
  public:
    /// Collective. @throws InputError where a cell is to be recorded outside the rail
    explicit History(const Model &model);

    /// Whether steps have been taken since the last row.
    bool has_begun() const
    {
      return steps > 0;
    }
    double interval_seconds() const;
    /// The row of the interval that ends now. Collective.
    HistoryRow row() const;

    void open(RunFolder &folder) override;
    void start() override;
    void add_step() override;
    void add_row(const HistoryRow &row, const double seconds, RunFolder &folder) override;
    void finish(Report &report) override;
    void serialize(Archive &archive) override;

  private:
    /// Sums over the steps of the interval, by wheel.
    struct Interval
    {
      Vector3 force{}, other_force{}; ///< on the wheel, and on the other one of its wheelset, N
      double  inner_force = 0.;       ///< vertical, of the inner one of two pieces of a rail of slices, N
      double  start_speed = 0.;       ///< of the hub, vertical, m/s
    };
    WheelRecord                record(const RollingWheel &wheel, const std::vector<PatchNode> &patch) const;
    std::vector<SupportRecord> support_records() const;
    void                       begin_interval();

    const Model                &model;
    std::vector<Interval>       sums;
    unsigned int                steps      = 0;
    double                      start_time = 0.;
    const Columns<HistoryRow>   columns;
    Columns<HistoryRow>         columns_of_cells;
    std::unique_ptr<CellProbes> probes; ///< none: no cells are recorded
  };
} // namespace tread

#endif
