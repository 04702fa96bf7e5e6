// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/version.h>
#include <tread/output/progress.h>
#include <tread/output/run_folder.h>
#include <tread/output/summary.h>
#include <tread/scene/wheelset_case.h>
#include <tread/tools/wheelset_reference.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <functional>
#include <sstream>

namespace tread
{
  namespace
  {
    /// A figure of a patch: its key in summary.json, and its line on the screen where it has one.
    struct Figure
    {
      const char                               *key, *label;
      double                                    scale; ///< from SI to the unit of the label
      std::function<double(const WheelPatch &)> value;
    };

    /// @param rail_y where the middle of the rail's top lies in the track, m
    std::vector<Figure> figures_of_patch(const double rail_y)
    {
      using P = WheelPatch;
      return {{"normal_force_N", "normal force, kN", 1e-3,
               [](const P &p) {
                 return p.solution.normal_force;
               }},
              {"longitudinal_force_N", "longitudinal force, kN", 1e-3,
               [](const P &p) {
                 return p.solution.longitudinal_force;
               }},
              {"lateral_force_N", "lateral force, kN", 1e-3,
               [](const P &p) {
                 return p.solution.lateral_force;
               }},
              {"spin_moment_Nm", "spin moment, N m", 1.,
               [](const P &p) {
                 return p.solution.spin_moment;
               }},
              {"x_m", "x from the axle, mm", 1e3,
               [](const P &p) {
                 return p.region.reference[0];
               }},
              {"y_m", "y in the track, mm", 1e3,
               [](const P &p) {
                 return p.region.reference[1];
               }},
              {"y_rail_m", "y from the rail's middle, mm", 1e3,
               [rail_y](const P &p) {
                 return p.region.reference[1] - rail_y;
               }},
              {"z_m", "", 1e3,
               [](const P &p) {
                 return p.region.reference[2];
               }},
              {"angle_rad", "contact angle, degrees", 180. / dealii::numbers::PI,
               [](const P &p) {
                 return p.angle();
               }},
              {"rolling_radius_m", "rolling radius, mm", 1e3,
               [](const P &p) {
                 return p.rolling_radius;
               }},
              {"rolling_speed_m_per_s", "", 1.,
               [](const P &p) {
                 return p.rolling_speed;
               }},
              {"creepage", "creepage, 1e-3", 1e3,
               [](const P &p) {
                 return 0. - p.creepage;
               }},
              {"lateral_creepage", "lateral creepage, 1e-3", 1e3,
               [](const P &p) {
                 return p.lateral_creepage;
               }},
              {"spin_per_m", "spin, 1/m", 1.,
               [](const P &p) {
                 return p.spin;
               }},
              {"max_pressure_Pa", "maximum pressure, MPa", 1e-6,
               [](const P &p) {
                 return p.solution.max_pressure;
               }},
              {"area_m2", "area, mm2", 1e6,
               [](const P &p) {
                 return p.solution.area;
               }},
              {"length_m", "length along x, mm", 1e3,
               [](const P &p) {
                 return p.solution.x_end - p.solution.x_begin;
               }},
              {"width_m", "width across, mm", 1e3,
               [](const P &p) {
                 return p.solution.y_end - p.solution.y_begin;
               }},
              {"adhesion_share", "adhesion share, %", 1e2,
               [](const P &p) {
                 return p.solution.adhesion_share;
               }},
              {"max_shear_Pa", "maximum shear stress, MPa", 1e-6,
               [](const P &p) {
                 return p.solution.max_shear;
               }},
              {"max_slip_m_per_s", "maximum micro-slip, m/s", 1.,
               [](const P &p) {
                 return p.solution.max_slip;
               }},
              {"frictional_power_W", "frictional power, W", 1.,
               [](const P &p) {
                 return p.solution.frictional_power;
               }},
              {"overlap_m", "undeformed overlap, um", 1e6,
               [](const P &p) {
                 return p.region.overlap;
               }},
              {"normal_turns_rad", "the normal turns by, degrees", 180. / dealii::numbers::PI,
               [](const P &p) {
                 return p.turn;
               }},
              {"wheel_profile_radius_m", "", 1e3,
               [](const P &p) {
                 return p.wheel_radius;
               }},
              {"rail_profile_radius_m", "", 1e3,
               [](const P &p) {
                 return p.rail_radius;
               }},
              {"element_x_m", "", 1e3,
               [](const P &p) {
                 return p.solution.grid.dx;
               }},
              {"element_y_m", "", 1e3, [](const P &p) {
                 return p.solution.grid.dy;
               }}};
    }

    std::string table_of(const std::vector<Figure> &figures, const std::vector<WheelPatch> &patches)
    {
      std::string text = format("%-32s", "");
      for (std::size_t k = 0; k < patches.size(); ++k)
        text += format(" %12s", ("patch " + std::to_string(k + 1)).c_str());
      for (const Figure &figure : figures)
        if (*figure.label)
          {
            text += format("\n%-32s", figure.label);
            for (const WheelPatch &patch : patches)
              text += format(" %12.5g", figure.scale * figure.value(patch));
          }
      return text + "\n";
    }

    /// The elements in contact: x from the axle, y from the middle of the rail's top, z from the rail tops'
    /// plane, all in the plane of their patch.
    std::vector<PatchNode> nodes_of(const WheelContact &contact, const double rail_y)
    {
      std::vector<PatchNode> nodes;
      for (const WheelPatch &patch : contact.patches)
        {
          const reference::PlanarResult &s    = patch.solution;
          const reference::Grid         &grid = s.grid;
          for (std::size_t e = 0; e < grid.size(); ++e)
            if (s.state[e] != reference::ElementState::exterior)
              {
                const double along = grid.y(e / grid.n_x);
                nodes.push_back({Vector3{patch.region.reference[0] + grid.x(e % grid.n_x),
                                         patch.region.reference[1] - rail_y + along * std::cos(patch.angle()),
                                         patch.region.reference[2] + along * std::sin(patch.angle()), 0.},
                                 grid.element_area(),
                                 s.pressure[e],
                                 {s.shear_x[e], s.shear_y[e]},
                                 {s.slip_x[e], s.slip_y[e]},
                                 s.state[e] == reference::ElementState::adhesion});
              }
        }
      return nodes;
    }

    /// Where half-space theory ends, in words and with its number.
    std::vector<std::string> warnings_of(const std::vector<WheelPatch> &patches)
    {
      std::vector<std::string> warnings;
      for (std::size_t k = 0; k < patches.size(); ++k)
        {
          if (patches[k].turn > largest_turn_of_a_plane)
            warnings.push_back(
              format("patch %u is conformal: its normal turns by %.1f degrees, more than the %.1f degrees "
                     "that a plane stands for; "
                     "forces, pressure and spin are those of a half-space that the bodies are not",
                     static_cast<unsigned int>(k + 1), 180. / dealii::numbers::PI * patches[k].turn,
                     180. / dealii::numbers::PI * largest_turn_of_a_plane));
          if (patches[k].region.parts > 1)
            warnings.push_back(format("patch %u holds %u regions less than 8 mm apart, solved in one plane",
                                      static_cast<unsigned int>(k + 1), patches[k].region.parts));
        }
      return warnings;
    }

    WheelContact solve(const Scene &scene, const WheelOnRail &surfaces)
    {
      try
        {
          return contact_under_load(surfaces, wheel_rolling(scene), scene.wheelset.position(),
                                    scene.static_load());
        }
      catch (const std::exception &error)
        {
          throw InputError(
            format("no half-space answer at a lateral shift of %g mm, a yaw of %g mrad and a roll of "
                   "%g mrad: ",
                   1e3 * scene.wheelset.position().shift, 1e3 * scene.wheelset.yaw,
                   1e3 * scene.wheelset.roll) +
            error.what());
        }
    }

    void summarise_wheelset(Summary &summary, const Scene &scene, const WheelContact &contact)
    {
      summary.set("title", scene.general.title);
      summary.set("method", "half-space solver");
      summary.set("completed", true);
      summary.set("lateral_shift_m", scene.wheelset.position().shift);
      summary.set("yaw_rad", scene.wheelset.yaw);
      summary.set("roll_rad", scene.wheelset.roll);
      summary.set("angular_velocity_rad_per_s", wheel_rolling(scene).angular_velocity);
      summary.show("wheelset_height_m", "wheelset over its radius, mm", 1e3, contact.position.height);
      // In track axes: the normal of the track points up.
      summary.show("normal_force_N", "vertical force, kN", 1e-3, contact.force[2]);
      summary.show("longitudinal_force_N", "longitudinal force, kN", 1e-3, contact.force[0]);
      summary.show("lateral_force_N", "lateral force in the track, kN", 1e-3, contact.force[1]);
      summary.set("traction_coefficient", contact.force[0] / contact.force[2]);
      summary.set("friction_coefficient", scene.contact.friction_coefficient);
      const auto over_patches = [&](const bool sums, const auto &value) {
        double result = 0.;
        for (const WheelPatch &patch : contact.patches)
          result = sums ? result + value(patch) : std::max(result, value(patch));
        return result;
      };
      using P = WheelPatch;
      summary.set("max_pressure_Pa", over_patches(false, [](const P &p) { return p.solution.max_pressure; }));
      summary.set("patch_area_m2", over_patches(true, [](const P &p) { return p.solution.area; }));
      summary.set("max_shear_Pa", over_patches(false, [](const P &p) { return p.solution.max_shear; }));
      summary.set("max_slip_m_per_s", over_patches(false, [](const P &p) { return p.solution.max_slip; }));
      summary.show("frictional_power_W", "frictional power, W", 1.,
                   over_patches(true, [](const P &p) { return p.solution.frictional_power; }));
      summary.set("solutions", contact.turns);
    }
  } // namespace


  void run_wheelset_reference(const Scene &scene, const std::string &path, const MPI_Comm comm)
  {
    Progress                       progress(dealii::Utilities::MPI::this_mpi_process(comm) == 0);
    const WheelOnRail              surfaces = scene.wheel_on_rail();
    const WheelContact             contact  = solve(scene, surfaces);
    const double                   rail_y   = surfaces.rail_origin_y();
    const std::vector<Figure>      figures  = figures_of_patch(rail_y);
    const std::vector<std::string> warnings = warnings_of(contact.patches);

    Summary summary;
    summarise_wheelset(summary, scene, contact);
    nlohmann::ordered_json patches = nlohmann::ordered_json::array();
    for (const WheelPatch &patch : contact.patches)
      {
        nlohmann::ordered_json entry;
        for (const Figure &figure : figures)
          entry[figure.key] = figure.value(patch);
        patches.push_back(entry);
      }
    summary.set("patches", patches);
    summary.set("warnings", warnings);
    summary.set("wall_s", progress.seconds());
    summary.set("ranks", dealii::Utilities::MPI::n_mpi_processes(comm));
    summary.set("version", version());

    RunFolder          folder(path, comm);
    std::ostringstream effective;
    scene.print(effective, true);
    folder.remove_results();
    folder.write("parameters.prm", effective.str());
    folder.write_patch("patch.csv", nodes_of(contact, rail_y));
    folder.write("summary.json", summary.text());

    progress.say("tread " + version() + (scene.general.title.empty() ? "" : ": " + scene.general.title));
    progress.say(format(
      "half-space solver: shift %g mm, yaw %g mrad, roll %g mrad, %g rad/s; forces act on the wheel, by "
      "patch in contact axes\n",
      1e3 * scene.wheelset.position().shift, 1e3 * scene.wheelset.yaw, 1e3 * scene.wheelset.roll,
      wheel_rolling(scene).angular_velocity));
    progress.say(table_of(figures, contact.patches));
    progress.say(summary.table());
    for (const std::string &warning : warnings)
      progress.say("warning: " + warning);
    progress.say(format("finished in %.2f s. Results in ", progress.seconds()) + folder.path("") +
                 ": summary.json, patch.csv");
  }
} // namespace tread
