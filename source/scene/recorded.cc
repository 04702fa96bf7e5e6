// SPDX-License-Identifier: LGPL-2.1-or-later
// Where in the rail results are taken.
#include <tread/base/input_error.h>
#include <tread/reference/hertz.h>
#include <tread/scene/recorded.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  Scene::Range peak_range(const Scene &scene)
  {
    if (scene.peak_stress.place == PeakPlace::range)
      return {scene.peak_stress.from, scene.peak_stress.to};
    const double length = scene.shapes().defect ? scene.shapes().defect->length : scene.defect.length;
    require(length > 0.,
            "'Peak stress/Region' trailing edge needs a defect, or its 'Defect/Length (mm)' where "
            "'Defect/Shape' is none");
    const double edge = scene.defect.position + length;
    return {edge - 0.5 * length, edge + scene.stance().ellipse(scene.static_load()).semi_axis_x};
  }


  double peak_half_width(const Scene &scene)
  {
    if (scene.peak_stress.half_width > 0.)
      return scene.peak_stress.half_width;
    const double of_patch = scene.stance().ellipse(scene.static_load()).semi_axis_y;
    if (scene.peak_stress.place != PeakPlace::trailing_edge ||
        (scene.shapes().defect && scene.defect.shape != "dip"))
      return of_patch;
    // To where the edge of a round defect runs along the path as much as across. Beyond, it is rounded over
    // less and less of its own direction: at the sides it is sharp, and elasticity has no limit there.
    const double width = scene.defect.width > 0. ? scene.defect.width : scene.defect.length;
    return std::min(of_patch, 0.5 * width * std::sqrt(0.5));
  }


  std::vector<dealii::Point<3>> recorded_cells(const Scene &scene)
  {
    std::vector<dealii::Point<3>> points;
    for (const std::string &text : dealii::Utilities::split_string_list(scene.output.cells, ';'))
      {
        std::vector<double> values;
        try
          {
            values = dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(text));
          }
        catch (const dealii::ExceptionBase &)
          {
            values.clear();
          }
        require(values.size() == 3 && values[2] > 0. &&
                  std::all_of(values.begin(), values.end(),
                              [](const double value) { return std::isfinite(value); }),
                "'Output/Cells' cannot be '" + text + "'; allowed: " + OutputSection::form_of_cells);
        const double     depth = 1e-3 * values[2];
        dealii::Point<3> place(1e-3 * values[0], 1e-3 * values[1], 0.);
        // Below a wheelset in a position depth is measured across the plane of contact, which may be steep.
        constexpr unsigned int most_steps = 60;
        constexpr double       close      = 1e-9; // m
        for (unsigned int step = 0; step < most_steps; ++step)
          {
            const double up = scene.stance().depth_in_rail(place) - depth;
            place[2] += up;
            if (std::abs(up) < close)
              break;
          }
        points.push_back(place);
      }
    return points;
  }
} // namespace tread
