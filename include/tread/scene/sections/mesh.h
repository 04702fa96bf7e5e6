// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_mesh_h
#define tread_scene_sections_mesh_h

#include <tread/base/section.h>

namespace tread
{
  enum class WindowUse
  {
    automatic,
    always,
    never
  };

  template <>
  const std::vector<Choice<WindowUse>> &choices();

  /// Section `Mesh`. Lengths in m.
  struct MeshSection
  {
    double       finest_cell     = 0.63e-3;
    double       fine_half_width = 0.; ///< of the finest cells, from the middle of the path; 0: automatic
    unsigned int fine_layers     = 2;
    double       cells_per_level = 2., level_depth = 1.; ///< the latter in semi-axes
    double       coarsest_cell = 22e-3;
    double       fine_from = 0., fine_to = 0.; ///< counted from the leading edge of the defect
    double       path_cell = 0., longest_row = 40e-3;
    WindowUse    window        = WindowUse::automatic;
    double       window_length = 0., window_margin = 0.; ///< 0: automatic

    void declare(ParameterTable &table);
    /// @throws InputError
    void check() const;
  };
} // namespace tread

#endif
