// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_defect_h
#define tread_scene_sections_defect_h

#include <tread/base/section.h>
#include <tread/geometry/defect.h>

#include <memory>

namespace tread
{
  struct DefectSection;

  /// What a scene has to know of a shape of defects to offer it. A new one is a function like dip() of
  /// geometry/defect.h, its entry in sections/defect.cc and a test.
  struct DefectShape
  {
    std::string name, description;
    /// Null: there is none. @param section the parameters that the user has set; position and depth
    /// are set afterwards where they are given. @param file where the profile file was found
    /// @throws InputError
    std::shared_ptr<Defect> (*make)(const DefectSection &section, const std::string &file);
  };

  /// All shapes, the usual one first.
  const std::vector<DefectShape> &defect_shapes();

  enum class LateralLaw
  {
    parabola,
    uniform
  };

  template <>
  const std::vector<Choice<LateralLaw>> &choices();

  /// Section `Defect`. Lengths in m.
  struct DefectSection
  {
    std::string         shape    = defect_shapes().front().name;
    double              position = 0.; ///< x of the leading edge
    double              length = 0., width = 0., depth = 0.;
    double              lateral_position = 0.;
    double              leading_rounding = 0., trailing_rounding = 0.;
    double              wavelength = 0., ramp = 0.;
    std::string         profile_file;
    LateralLaw          lateral_law = LateralLaw::parabola;
    bool                reversed    = false;
    std::vector<double> repeated_at; ///< x of further leading edges

    void declare(ParameterTable &table);
    /// Null: none. @param file where the profile file was found. @throws InputError
    std::shared_ptr<const Defect> make(const std::string &file) const;
  };
} // namespace tread

#endif
