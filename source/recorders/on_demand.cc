// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/model/model.h>
#include <tread/recorders/impact_record.h>
#include <tread/recorders/on_demand.h>
#include <tread/recorders/stresses.h>
#include <tread/scene/track_parts.h>

namespace tread
{
  namespace
  {
    using Made = std::unique_ptr<Recorder>;

    Made impacts(Model &model, const WindowPlace &)
    {
      const Scene &scene = model.scene;
      return scene.has_impacts()
               ? std::make_unique<ImpactRecord>(scene.static_load(), recorded_supports(scene))
               : nullptr;
    }

    Made strip(Model &model, const WindowPlace &window)
    {
      return model.scene.output.strip_half_width > 0. ? std::make_unique<StripRecorder>(model, window)
                                                      : nullptr;
    }

    Made stress_peaks(Model &model, const WindowPlace &)
    {
      return model.scene.peak_stress.is_wanted() ? std::make_unique<PeakRecorder>(model) : nullptr;
    }

    Made rail_seats(Model &model, const WindowPlace &)
    {
      return recorded_supports(model.scene).empty() ? nullptr : std::make_unique<SeatRecorder>(model);
    }

    Made plastic_strain(Model &model, const WindowPlace &)
    {
      return std::make_unique<PlasticStrainRecorder>(model);
    }
  } // namespace


  const std::vector<Made (*)(Model &, const WindowPlace &)> &recorders_on_demand()
  {
    static const std::vector<Made (*)(Model &, const WindowPlace &)> list{impacts, strip, stress_peaks,
                                                                          rail_seats, plastic_strain};
    return list;
  }
} // namespace tread
