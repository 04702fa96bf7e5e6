// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_output_h
#define tread_scene_sections_output_h

#include <tread/base/section.h>
#include <tread/output/picture.h>

namespace tread
{
  template <>
  const std::vector<Choice<PictureFormat>> &choices();

  /// Section `Output`. SI units.
  struct OutputSection
  {
    std::string      directory        = "results";
    double           history_interval = 0.25e-3;
    std::vector<int> supports;                                    ///< numbers; empty: those beside the path
    std::string      cells;                                       ///< places of the cells of cells.csv
    double           strip_half_width = 3e-3;                     ///< 0: no strip.csv
    double           surface_interval = 0., volume_interval = 0.; ///< 0: the solution instant only
    double           patch_interval      = 0.;                    ///< 0: that of the surface
    double           table_depth         = 0.;                    ///< 0: no tables of cells
    bool             write_volume        = true;
    PictureFormat    pictures            = PictureFormat::vtu;
    double           checkpoint_interval = 600.; ///< wall time, s; 0: only when interrupted

    /// Way between two instants of patches.csv, m; 0: no table.
    double interval_of_patches() const
    {
      return patch_interval > 0. ? patch_interval : surface_interval;
    }

    static constexpr const char *form_of_cells =
      "x,y,depth in mm, depth above 0, entries separated by semicolons";

    void declare(ParameterTable &table);
  };
} // namespace tread

#endif
