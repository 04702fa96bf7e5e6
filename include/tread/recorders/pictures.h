// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_pictures_h
#define tread_recorders_pictures_h

#include <tread/analysis/stress_recovery.h>
#include <tread/model/model.h>
#include <tread/recorders/recorder.h>
#include <tread/recorders/surface_damage.h>

#include <memory>

namespace tread
{
  /// Surface and volume for ParaView, at the solution instant and on the way, with the tables of the rail's
  /// cells and surface at that instant; patches.csv.
  class Pictures : public Recorder
  {
  public:
    /// @param damage to be shown; null: none
    Pictures(const Model &model, SurfaceDamageRecorder *damage)
      : model(model)
      , damage(damage)
    {
    }

    void write_volume(RunFolder &folder);

    void open(RunFolder &folder) override;
    void pass(const WayPassed &way, RunFolder &folder) override;
    void take_solution(RunFolder &folder) override;

  private:
    void           write_surface(RunFolder &folder);
    NodalStresses &stresses(); ///< made when they are first asked for. Collective.

    const Model                   &model;
    SurfaceDamageRecorder         *damage;
    std::unique_ptr<NodalStresses> at_nodes;
  };
} // namespace tread

#endif
