// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_surface_damage_h
#define tread_recorders_surface_damage_h

#include <tread/analysis/surface_damage.h>
#include <tread/model/model.h>
#include <tread/recorders/recorder.h>

#include <vector>

namespace tread
{
  /// Tables and figures of what friction does to the surfaces, whose temperature friction may depend on.
  class SurfaceDamageRecorder : public Recorder
  {
  public:
    explicit SurfaceDamageRecorder(Model &model);

    /// By surface node. Collective.
    std::vector<SurfacePlace> by_node()
    {
      return damage.by_node();
    }

    void add_step() override
    {
      damage.add_step(model.dynamics.state.time_step);
    }
    void begin_passage() override
    {
      damage.begin_passage();
    }
    void finish(Report &report) override;
    void serialize(Archive &archive) override
    {
      damage.serialize(archive);
    }

  private:
    const Model  &model;
    SurfaceDamage damage;
  };
} // namespace tread

#endif
