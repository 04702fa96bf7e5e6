// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_passages_h
#define tread_recorders_passages_h

#include <tread/model/model.h>
#include <tread/output/columns.h>
#include <tread/output/progress.h>
#include <tread/recorders/end_of_way.h>
#include <tread/recorders/passage_growth.h>
#include <tread/recorders/recorder.h>
#include <tread/recorders/solution.h>

#include <array>
#include <vector>

namespace tread
{
  const Columns<Passage> &passage_columns();

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

    /// A wheel stands at the beginning of the path, in equilibrium. Collective.
    void start() override;
    void finish(Report &report) override;
    void serialize(Archive &archive) override;

  private:
    /// The rail in the middle of the path.
    struct Middle
    {
      double settlement = 0., shift = 0.; ///< means over the surface's line of the path, m
      /// Of the cells that are judged, in the order of the mesh, Pa.
      std::vector<std::array<double, 6>> stress;

      Middle operator-(const Middle &other) const;
    };
    /// Collective.
    Middle measure_middle() const;
    /// Write what is left without the load. Collective.
    void note(const Middle &left, Passage &passage) const;
    void serialize(Archive &archive, Middle &middle) const;

    Model                    &model;
    const EndOfWay           &end_of_way;
    const Solution           &solution;
    std::vector<unsigned int> judged;  ///< cells in the middle of the path that may yield
    std::vector<unsigned int> on_line; ///< nodes of the surface there on the line of the path, each once
    PassageGrowth             growth;
    std::vector<Passage>      passages;
    unsigned int              skipped = 0; ///< before the one that rolls

    // A wheel at an end of a short path loads its middle, and does so alike in all passages. What a wheel at
    // the beginning finds more than the first one did is therefore what the passages before have left, and
    // all else at the last one's end was the load.
    Middle at_first_start, at_last_end, of_load;
  };
} // namespace tread

#endif
