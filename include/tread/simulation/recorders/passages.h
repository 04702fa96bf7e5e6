// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_simulation_recorders_passages_h
#define tread_simulation_recorders_passages_h

#include <tread/output/progress.h>
#include <tread/simulation/model.h>
#include <tread/simulation/passage_growth.h>
#include <tread/simulation/recorders/end_of_way.h>
#include <tread/simulation/recorders/recorder.h>
#include <tread/simulation/recorders/solution.h>

#include <vector>

namespace tread
{
  /// passages.csv: what several passages leave in the rail, which may leave some of them out.
  class Passages : public Recorder
  {
  public:
    /// Collective. @pre scene.motion.passages > 1
    Passages(Model &model, const EndOfWay &end_of_way, const Solution &solution);

    /// Note what the passage that ends has left. Collective.
    void end(RunFolder &folder, Progress &progress);
    /// Whether no passage follows. @pre one has ended
    bool is_last() const;
    /// Leave out what may be left out.
    void begin_next(Progress &progress);

    bool any_has_ended() const
    {
      return !passages.empty();
    }

    void finish(Report &report) override;
    void serialize(Archive &archive) override;

  private:
    /// Means of the surface's line of the path, and the largest stress and strain below it.
    void measure_rail(Passage &passage) const;

    Model               &model;
    const EndOfWay      &end_of_way;
    const Solution      &solution;
    PassageGrowth        growth;
    std::vector<Passage> passages;
    unsigned int         skipped = 0; ///< before the one that rolls
  };
} // namespace tread

#endif
