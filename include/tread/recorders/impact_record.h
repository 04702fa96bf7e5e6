// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_impact_record_h
#define tread_recorders_impact_record_h

#include <tread/recorders/recorder.h>

#include <string>
#include <vector>

namespace tread
{
  /// What a defect or a track does to the forces of a run: extremes over the rows of its history, in which
  /// contact forces are means over the interval and those of supports are of its end.
  class ImpactRecord : public Recorder
  {
  public:
    /// @param static_load of a wheel, N; @param supports numbers of those in the rows
    ImpactRecord(const double static_load, const std::vector<int> &supports)
      : static_load(static_load)
      , supports(supports)
    {
    }

    /// @param seconds length of the interval
    void add(const HistoryRow &row, const double seconds);

    /// Add the extremes to the figures.
    void add_to(Summary &summary) const;

    /// The same in words, a line each; empty if no row was added.
    std::string words() const;

    void add_row(const HistoryRow &row, const double seconds, RunFolder &) override
    {
      add(row, seconds);
    }
    void finish(Report &report) override;
    void serialize(Archive &archive) override;

  private:
    struct Extreme
    {
      double value = 0., x = 0.; ///< and the position of the wheel, m
      int    support = 0;
    };

    /// Whether it is that of the last row: a run that had gone on might have exceeded it.
    bool is_at_end(const Extreme &e) const
    {
      return e.x == last_x;
    }

    const double           static_load;
    const std::vector<int> supports;

    bool    has_rows = false, has_supports = false;
    Extreme largest, least; ///< normal force of the first wheel, N
    Extreme pad, ballast;   ///< largest forces of the supports recorded, N
    double  airborne = 0.;  ///< how long the first wheel did not touch, s
    double  last_x   = 0.;  ///< position of the first wheel in the last row, m
  };
} // namespace tread

#endif
