// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/version.h>
#include <tread/output/progress.h>
#include <tread/output/run_folder.h>
#include <tread/scene/doubts.h>
#include <tread/scene/touched_pieces.h>
#include <tread/tools/contact_way_files.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    /// A patch at a place of the axle.
    struct TouchRow
    {
      double            axle, along; ///< x of the scene; along the slices, m
      double            height;      ///< of the wheelset under the load, over its radius, m
      double            rigid;       ///< at which it touches without load, m
      double            share;       ///< of the vertical load
      const WheelPatch *patch;
    };

    double vertical(const WheelPatch &patch)
    {
      return patch.force()[2];
    }

    Columns<TouchRow> way_columns()
    {
      const auto of_patch = [](const char *name, const char *unit, const char *about, const auto &value) {
        return Column<TouchRow>{name, unit, about, [value](const TouchRow &row) {
                                  return value(*row.patch);
                                }};
      };
      return {{"along", "mm", "Place of the axle along the slices",
               [](const TouchRow &r) {
                 return r.along;
               }},
              {"axle_x", "mm", "The same as x of the scene",
               [](const TouchRow &r) {
                 return r.axle;
               }},
              {"height", "mm", "Of the wheelset's middle over the radius, under the load",
               [](const TouchRow &r) {
                 return r.height;
               }},
              {"rigid_height", "mm", "The same where the rigid wheel touches without load",
               [](const TouchRow &r) {
                 return r.rigid;
               }},
              of_patch("patch_x", "mm", "Reference point of the patch ahead of the axle",
                       [](const WheelPatch &p) { return p.region.reference[0]; }),
              of_patch("patch_y", "mm", "From the middle of the track to the own side",
                       [](const WheelPatch &p) { return p.region.reference[1]; }),
              of_patch("patch_z", "mm", "From the plane on the rail tops, upwards",
                       [](const WheelPatch &p) { return p.region.reference[2]; }),
              of_patch("angle", "rad", "Inclination of the rail there, + where it falls to the gauge side",
                       [](const WheelPatch &p) { return p.angle(); }),
              of_patch("rolling_radius", "mm", "Of the wheel there",
                       [](const WheelPatch &p) { return p.rolling_radius; }),
              of_patch("vertical_force", "N", "On the wheel", vertical),
              {"load_share", "", "Of that in the vertical force of all patches",
               [](const TouchRow &r) {
                 return r.share;
               }},
              of_patch("normal_force", "N", "On the wheel",
                       [](const WheelPatch &p) { return p.solution.normal_force; }),
              of_patch("max_pressure", "MPa", "Largest pressure",
                       [](const WheelPatch &p) { return p.solution.max_pressure; }),
              of_patch("patch_length", "mm", "Along the rail",
                       [](const WheelPatch &p) { return p.solution.x_end - p.solution.x_begin; }),
              of_patch("patch_width", "mm", "Across",
                       [](const WheelPatch &p) { return p.solution.y_end - p.solution.y_begin; }),
              {"part", "", "Name of the rail's body in the slices", {}, [](const TouchRow &r) {
                 return r.patch->body;
               }}};
    }

    std::vector<TouchRow> touch_rows(const Scene         &scene,
                                     const WheelOnRail   &surfaces,
                                     const WayOverSlices &way)
    {
      std::vector<TouchRow> rows;
      for (std::size_t i = 0; i < way.axles.size(); ++i)
        {
          const double           axle     = way.axles[i];
          const WheelsetPosition position = scene.position_at(axle);
          const double           rigid    = position.height - surfaces.nearest(position).gap;
          const std::size_t      first    = rows.size();
          double                 force    = 0.;
          for (const TouchedPiece &piece : way.pieces)
            for (const TouchedPiece::Touch &touch : piece.touches)
              if (touch.axle == axle)
                {
                  rows.push_back({axle, position.along, way.height[i], rigid, 0., &touch.patch});
                  force += vertical(touch.patch);
                }
          for (std::size_t k = first; k < rows.size(); ++k)
            rows[k].share = vertical(*rows[k].patch) / force;
        }
      return rows;
    }

    void say_pieces(Progress &progress, const Scene &scene, const WayOverSlices &way)
    {
      progress.say("   piece        from      to, mm along the slices; patches at y, mm  largest force, kN");
      for (const TouchedPiece &piece : way.pieces)
        {
          double y_low = 1e300, y_high = -1e300, force = 0.;
          for (const TouchedPiece::Touch &touch : piece.touches)
            {
              y_low  = std::min(y_low, touch.patch.region.reference[1]);
              y_high = std::max(y_high, touch.patch.region.reference[1]);
              force  = std::max(force, touch.patch.solution.normal_force);
            }
          const double place = scene.rail.slices_place;
          progress.say(
            format("%8s %11.2f %7.2f %26.2f to %.2f %17.2f", piece.body.empty() ? "rail" : piece.body.c_str(),
                   1e3 * (place + piece.touches.front().axle), 1e3 * (place + piece.touches.back().axle),
                   1e3 * y_low, 1e3 * y_high, 1e-3 * force));
        }
    }
  } // namespace


  TableDescription table_of_contact_way()
  {
    return describe("contact_way.csv", way_columns());
  }


  void write_contact_way(const Scene &scene, const std::string &path, const MPI_Comm comm)
  {
    require(scene.static_load() > 0.,
            "'Vehicle/Gravity (m per s2)' must be above 0: nothing loads the contact");
    Progress            progress(dealii::Utilities::MPI::this_mpi_process(comm) == 0);
    const WheelOnRail  &surfaces = scene.wheel_on_rail();
    const WayOverSlices way      = way_over_slices(scene, surfaces);
    RunFolder           folder(path, comm);
    folder.write_table("contact_way.csv", way_columns(), touch_rows(scene, surfaces, way));

    progress.say("tread " + version() + (scene.general.title.empty() ? "" : ": " + scene.general.title));
    progress.say(format("a load of %g kN over the slices, at %zu places, without friction",
                        1e-3 * scene.static_load(), way.axles.size()));
    say_pieces(progress, scene, way);
    const auto [low, high] = std::minmax_element(way.height.begin(), way.height.end());
    progress.say(format("the wheelset stands %.4f to %.4f mm over the rail tops' plane and its radius",
                        1e3 * *low, 1e3 * *high));
    for (const std::string &warning : implausible_values(scene, true))
      progress.say("warning: " + warning);
    progress.say(format("\nfinished in %.2f s. Results in ", progress.seconds()) + folder.path("") +
                 ": contact_way.csv");
  }
} // namespace tread
