// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_stresses_h
#define tread_recorders_stresses_h

#include <tread/analysis/rail_stress.h>
#include <tread/analysis/stress_peaks.h>
#include <tread/model/model.h>
#include <tread/output/columns.h>
#include <tread/recorders/recorder.h>
#include <tread/track/rail_seats.h>

namespace tread
{
  const Columns<StripColumn>        &strip_columns();
  const Columns<StressPeaks::Layer> &peak_columns();
  const Columns<RailSeatPoint>      &rail_seat_columns();

  /// strip.csv: the largest stresses under the path, at the ends of intervals of the history.
  class StripRecorder : public Recorder
  {
  public:
    StripRecorder(const Model &model, const WindowPlace &window);

    void add_row(const HistoryRow &row, const double seconds, RunFolder &folder) override;
    void finish(Report &report) override;
    void take_over(const Recorder &before) override
    {
      strip.take_over(dynamic_cast<const StripRecorder &>(before).strip);
    }
    void serialize(Archive &archive) override
    {
      strip.serialize(archive);
    }

  private:
    const Model &model;
    StressStrip  strip;
  };

  /// The largest stresses of a region of the rail, and of the first wheel's rim while it is there, in all
  /// steps.
  class PeakRecorder : public Recorder
  {
  public:
    explicit PeakRecorder(const Model &model);

    void add_step() override;
    void finish(Report &report) override;
    void serialize(Archive &archive) override;

  private:
    const Model &model;
    StressPeaks  rail, wheel;
  };

  /// rail_seats.csv: pressures under the rail at the largest force of each recorded support.
  class SeatRecorder : public Recorder
  {
  public:
    /// @pre the model has supports
    explicit SeatRecorder(const Model &model);

    void add_step() override
    {
      seats.record(model.dynamics.state.time, model.position());
    }
    void finish(Report &report) override
    {
      report.folder.write_table("rail_seats.csv", rail_seat_columns(), seats.points());
    }
    void serialize(Archive &archive) override
    {
      seats.serialize(archive);
    }

  private:
    const Model &model;
    RailSeats    seats;
  };

  /// The largest plastic strain of the rail's and the first wheel's cells at the end.
  class PlasticStrainRecorder : public Recorder
  {
  public:
    explicit PlasticStrainRecorder(const Model &model)
      : model(model)
    {
    }

    void finish(Report &report) override;

  private:
    const Model &model;
  };
} // namespace tread

#endif
