// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/measured_line.h>
#include <tread/scene/sections/defect.h>

#include <algorithm>
#include <limits>

namespace tread
{
  template <>
  const std::vector<Choice<DefectShape>> &choices()
  {
    static const std::vector<Choice<DefectShape>> list{
      {DefectShape::none, "none", "smooth."},
      {DefectShape::dip, "dip",
       "of Length, Width and Depth, a sphere's cap where length and width are equal."},
      {DefectShape::profile, "profile", "along the path as in Profile file, across as Lateral law says."}};
    return list;
  }


  template <>
  const std::vector<Choice<LateralLaw>> &choices()
  {
    static const std::vector<Choice<LateralLaw>> list{
      {LateralLaw::parabola, "parabola", "1 - (2 y / Width)^2 of the depth."},
      {LateralLaw::uniform, "uniform", "the whole head, as at a weld."}};
    return list;
  }


  void DefectSection::declare(dealii::ParameterHandler &handler)
  {
    using dealii::Patterns::Double;
    Section section(handler, "Defect");

    section.choose("Shape", shape);
    section.add(
      "Position (mm)", position,
      "x of the leading edge. Where the wheel starts and ends: 'Motion/Start' and 'Rolled distance'.",
      Double(-1e5, 1e5));
    section.add("Length (mm)", length, "Along the rail. A profile is stretched to it; 0: as in the file.",
                Double(0., 1e4));
    section.add("Width (mm)", width, "Lateral. 0: as long as it is wide, for a dip.", Double(0., 200.));
    section.add("Depth (mm)", depth, "Of the deepest point. A profile is scaled to it; 0: as in the file.",
                Double(0., 10.));
    section.add("Lateral position (mm)", lateral_position,
                "y of its middle, along the rail's top; the gauge side is y < 0.", Double(-50., 50.));
    section.add("Rounded leading edge (mm)", leading_rounding,
                "Of a dip: the kink at its beginning is rounded over so much of the path. 0: sharp.",
                Double(0., 1000.));
    section.add("Rounded trailing edge (mm)", trailing_rounding, "The same at its end.", Double(0., 1000.));
    section.add(
      "Profile file", profile_file,
      "Columns x and z in mm, z up; depth is counted from the straight line between the ends. Looked for in "
      "the present folder and beside the parameter file.",
      dealii::Patterns::Anything());
    section.choose("Lateral law", lateral_law, "Of a profile.");
    section.add("Reversed", reversed, "A profile is rolled over from its other end.");
  }


  std::shared_ptr<const Defect> DefectSection::make(const std::string &file) const
  {
    if (shape == DefectShape::none)
      return nullptr;
    auto defect = std::make_shared<Defect>();
    if (shape == DefectShape::dip)
      {
        require(length > 0. && depth > 0.,
                "a dip needs 'Defect/Length (mm)' and 'Defect/Depth (mm)' above 0");
        require(!reversed,
                "'Defect/Reversed' is for 'Defect/Shape' profile; a dip is rolled over from its other "
                "end with its rounded edges exchanged");
        defect->width             = width > 0. ? width : length;
        defect->leading_rounding  = leading_rounding;
        defect->trailing_rounding = trailing_rounding;
        require(std::max(leading_rounding, trailing_rounding) <= 0.5 * length,
                "'Defect/Rounded leading edge (mm)' and 'Rounded trailing edge (mm)' must be at most half of "
                "'Defect/Length (mm)', " +
                  text_in_mm(0.5 * length));
      }
    else
      {
        require(!profile_file.empty(), "'Defect/Shape' profile needs 'Defect/Profile file'");
        try
          {
            *defect = defect_along(read_longitudinal_profile(file), reversed);
          }
        catch (const std::runtime_error &error)
          {
            throw InputError("'Defect/Profile file': " + std::string(error.what()));
          }
        const bool uniform = lateral_law == LateralLaw::uniform;
        require(uniform || width > 0.,
                "'Defect/Width (mm)' must be above 0 for a profile with 'Lateral law' parabola");
        defect->width = uniform ? std::numeric_limits<double>::infinity() : width;
      }
    if (length > 0.)
      defect->length = length;
    if (depth > 0.)
      defect->depth = depth;
    defect->begin    = position;
    defect->y_middle = lateral_position;
    return defect;
  }
} // namespace tread
