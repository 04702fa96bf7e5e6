// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/peak_stress.h>

namespace tread
{
  template <>
  const std::vector<Choice<PeakPlace>> &choices()
  {
    static const std::vector<Choice<PeakPlace>> list{
      {PeakPlace::none, "none", "stresses are not looked at in every step."},
      {PeakPlace::trailing_edge, "trailing edge",
       "from the middle of the defect to a semi-axis of the patch behind its trailing edge, and the same "
       "place on a smooth rail with 'Defect/Shape' none, where 'Defect/Position' and 'Length' still count."},
      {PeakPlace::range, "range", "between From and To."}};
    return list;
  }


  void PeakStressSection::declare(ParameterTable &table)
  {
    Section    section(table, "Peak stress");
    const Need range("Peak stress/Region", {"range"});

    section.choose("Region", place,
                   "peak_stress.csv lists, for each layer of cells of the rail in a region and for the "
                   "surface, the largest von Mises stress of all steps with its place and instant, "
                   "peak_stress_wheel.csv those of the tread of the first wheel that rolls over it.");
    section.all_need({{"Peak stress/Region", {}, "a region"}});
    section.needs(range).add("From (mm)", from, "x of the beginning of a range.", Number(-1e5, 1e5));
    section.needs(range).add("To (mm)", to, "x of the end of a range.", Number(-1e5, 1e5));
    section.add("Half width (mm)", half_width,
                "Half width of the region, to both sides of the first contact, or of the path of a wheelset "
                "in a position: of the largest patch of its own wheel, on slices of the piece that carries "
                "most in the range; 0: that of the patch under "
                "the static load, and of a dip's trailing edge no more than to where it runs along the path "
                "as much as across it.",
                Number(0., 100.));
    section.add("Depth (mm)", depth, "Depth of the region below the surface.", Number(0.1, 100.));
  }
} // namespace tread
