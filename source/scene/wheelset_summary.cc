// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/output/summary_keys.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/surface_laws.h>
#include <tread/scene/wheelset_case.h>
#include <tread/scene/wheelset_summary.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace tread
{
  namespace
  {
    const bool keys_of_wheelset_are_known = know_summary_keys(
      SummaryGroup::position,
      {{"lateral_shift_m",
        "Of a wheelset in a position: its shift in the track, to its own side, at the end of the path"},
       {"yaw_rad", "Of a wheelset in a position, at the end of the path, positive: the leading side turns "
                   "to the own side"},
       {"roll_rad", "Of a wheelset in a position, at the end of the path, positive: the own side goes down"},
       {"creepage_over_nominal_radius",
        "Of a wheelset in a position: angular velocity times 'Wheel/Radius (mm)' over the speed, less 1, "
        "as 'Motion/Creepage' counts it; 'creepage' of each patch counts from the radius that rolls there"},
       {"angular_velocity_rad_per_s",
        "Of a wheelset in a position, about its axle at the end of the path, counted from free rolling"},
       {"wheelset_height_m", "Of a wheelset in a position: height of the middle of its axle over the tops "
                             "of the rails, less the wheel's radius, at the end of the path"}});
    const bool keys_of_patch_lists_are_known = know_summary_keys(
      SummaryGroup::references,
      {{"patches", "Of a wheelset in a position: a list with an entry for each patch, in contact axes: x "
                   "forward, s along the rail's surface to the field side, the normal upwards; forces, "
                   "pressure, slip and extent are means while the wheel rolls over one cell around the end "
                   "of the path, what follows from the undeformed bodies is the half-space's"},
       {"half_space_patches", "The same patches as half-space theory has them, with the same keys"}});

    /// A figure of a patch: its key in summary.json with what it means, and its line on the screen where it
    /// has one.
    struct Figure
    {
      const char                               *key, *about, *label;
      double                                    scale; ///< from SI to the unit of the label
      std::function<double(const WheelPatch &)> value;
    };

    /// @param rail_y where the middle of the rail's top lies in the track, m
    std::vector<Figure> figures_of_patch(const double rail_y)
    {
      using P = WheelPatch;
      return {
        {"normal_force_N", "Resultant of the pressure on the wheel", "normal force, kN", 1e-3,
         [](const P &p) {
           return p.solution.normal_force;
         }},
        {"longitudinal_force_N", "Resultant of the shear stress on the wheel along x, positive forward",
         "longitudinal force, kN", 1e-3,
         [](const P &p) {
           return p.solution.longitudinal_force;
         }},
        {"lateral_force_N", "Resultant of the shear stress on the wheel along s, positive to the field side",
         "lateral force, kN", 1e-3,
         [](const P &p) {
           return p.solution.lateral_force;
         }},
        {"spin_moment_Nm",
         "Moment of the shear stress on the wheel about the normal through the reference point, from x to s",
         "spin moment, N m", 1.,
         [](const P &p) {
           return p.solution.spin_moment;
         }},
        {"x_m", "Reference point of the patch, ahead of the middle of the axle", "x from the axle, mm", 1e3,
         [](const P &p) {
           return p.region.reference[0];
         }},
        {"y_m", "The same across, from the middle of the track, positive to the own side",
         "y in the track, mm", 1e3,
         [](const P &p) {
           return p.region.reference[1];
         }},
        {"y_rail_m", "The same across, from the middle of the rail's top, positive to the field side",
         "y from the rail's middle, mm", 1e3,
         [rail_y](const P &p) {
           return (p.is_of_other_wheel ? -1. : 1.) * p.region.reference[1] - rail_y;
         }},
        {"z_m", "The same over the tops of the rails", "", 1e3,
         [](const P &p) {
           return p.region.reference[2];
         }},
        {"angle_rad", "Contact angle: inclination of the rail there, positive: it rises to the field side",
         "contact angle, degrees", 180. / dealii::numbers::PI,
         [](const P &p) {
           return p.angle();
         }},
        {"rolling_radius_m", "Of the undeformed wheel at the reference point", "rolling radius, mm", 1e3,
         [](const P &p) {
           return p.rolling_radius;
         }},
        {"rolling_speed_m_per_s", "Mean of the speeds of both surfaces through the patch, as rigid bodies",
         "", 1.,
         [](const P &p) {
           return p.rolling_speed;
         }},
        {"creepage",
         "Slip of the rigid wheel over the rail at the reference point over the rolling speed, along x, "
         "positive when driving",
         "creepage, 1e-3", 1e3,
         [](const P &p) {
           return 0. - p.creepage;
         }},
        {"lateral_creepage", "The same along s, positive: the wheel slips to the field side",
         "lateral creepage, 1e-3", 1e3,
         [](const P &p) {
           return p.lateral_creepage;
         }},
        {"spin_per_m", "Angular velocity of the wheel about the normal over the rolling speed, from x to s",
         "spin, 1/m", 1.,
         [](const P &p) {
           return p.spin;
         }},
        {"max_pressure_Pa", "Largest pressure of a node (of an element)", "maximum pressure, MPa", 1e-6,
         [](const P &p) {
           return p.solution.max_pressure;
         }},
        {"area_m2", "Area in contact", "area, mm2", 1e6,
         [](const P &p) {
           return p.solution.area;
         }},
        {"length_m", "Extent of the patch along x", "length along x, mm", 1e3,
         [](const P &p) {
           return p.solution.x_end - p.solution.x_begin;
         }},
        {"width_m", "Extent of the patch along s", "width across, mm", 1e3,
         [](const P &p) {
           return p.solution.y_end - p.solution.y_begin;
         }},
        {"adhesion_share", "Share of the area that sticks", "adhesion share, %", 1e2,
         [](const P &p) {
           return p.solution.adhesion_share;
         }},
        {"max_shear_Pa", "Largest shear stress of a node (of an element)", "maximum shear stress, MPa", 1e-6,
         [](const P &p) {
           return p.solution.max_shear;
         }},
        {"max_slip_m_per_s", "Largest micro-slip of a node (of an element)", "maximum micro-slip, m/s", 1.,
         [](const P &p) {
           return p.solution.max_slip;
         }},
        {"frictional_power_W", "Power that friction takes in the patch", "frictional power, W", 1.,
         [](const P &p) {
           return p.solution.frictional_power;
         }},
        {"overlap_m", "Largest overlap of the undeformed bodies along the normal", "undeformed overlap, um",
         1e6,
         [](const P &p) {
           return p.region.overlap;
         }},
        {"sink_by_others_m",
         "How far both surfaces give way here under the pressure of the other patches, about, which "
         "half-space solutions leave out",
         "sinks under other patches, um", 1e6,
         [](const P &p) {
           return p.sink_by_others;
         }},
        {"normal_turns_rad", "By how much the rail's normal turns from one edge of the patch to the other",
         "the normal turns by, degrees", 180. / dealii::numbers::PI,
         [](const P &p) {
           return p.turn;
         }},
        {"wheel_profile_radius_m",
         "Radius of the wheel's profile at the reference point, positive where it is hollow", "", 1e3,
         [](const P &p) {
           return p.wheel_radius;
         }},
        {"rail_profile_radius_m",
         "Radius of the rail's profile at the reference point, positive where it is a crown", "", 1e3,
         [](const P &p) {
           return p.rail_radius;
         }},
        {"element_x_m", "Edge of the half-space's elements along x", "", 1e3,
         [](const P &p) {
           return p.solution.grid.dx;
         }},
        {"element_y_m", "The same along s", "", 1e3, [](const P &p) {
           return p.solution.grid.dy;
         }}};
    }
  } // namespace


  namespace
  {
    DamageIndex::Load load_of(const WheelPatch &patch, const Scene &scene)
    {
      const reference::PlanarResult &s = patch.solution;
      return {s.normal_force, std::hypot(s.longitudinal_force, s.lateral_force), s.area,
              s.max_pressure, s.frictional_power / scene.motion.speed,           shear_strength(scene)};
    }
  } // namespace


  std::string table_of_patches(const std::vector<WheelPatch> &patches,
                               const double                   rail_y,
                               const std::vector<WheelPatch> &references)
  {
    std::string text = format("%-32s", "");
    for (std::size_t k = 0; k < patches.size(); ++k)
      {
        text += format(
          " %12s", ((patches[k].is_of_other_wheel ? "other " : "patch ") + std::to_string(k + 1)).c_str());
        if (!references.empty())
          text += format(" %12s %10s", "half-space", "diff.");
      }
    for (const Figure &figure : figures_of_patch(rail_y))
      if (*figure.label)
        {
          text += format("\n%-32s", figure.label);
          for (std::size_t k = 0; k < patches.size(); ++k)
            {
              const double value = figure.value(patches[k]);
              text += format(" %12.5g", figure.scale * value);
              if (references.empty())
                continue;
              const double reference = figure.value(references[k]);
              text += format(" %12.5g", figure.scale * reference);
              text += value == reference || reference == 0.
                        ? format(" %10s", "")
                        : format(" %+8.2f %%", 100. * (value / reference - 1.));
            }
        }
    return text + "\n";
  }


  nlohmann::ordered_json patches_as_json(const std::vector<WheelPatch> &patches,
                                         const double                   rail_y,
                                         const Scene                   &scene)
  {
    const DamageIndices    indices = indices_of_damage(scene);
    nlohmann::ordered_json list    = nlohmann::ordered_json::array();
    for (const WheelPatch &patch : patches)
      {
        nlohmann::ordered_json entry;
        entry["wheel"] = patch.is_of_other_wheel ? "other" : "own";
        for (const Figure &figure : figures_of_patch(rail_y))
          entry[figure.key] = figure.value(patch);
        const DamageIndex::Load load = load_of(patch, scene);
        entry["t_gamma_N"]           = load.t_gamma;
        for (const auto &[key, value] : damage_of(indices, load))
          entry[key] = value;
        list.push_back(entry);
      }
    return list;
  }


  std::vector<TableDescription::Line> keys_of_patch()
  {
    std::vector<TableDescription::Line> keys{{"wheel", "", "own or other"}};
    for (const Figure &figure : figures_of_patch(0.))
      keys.push_back({figure.key, unit_of_heading(figure.key), figure.about});
    keys.push_back({"t_gamma_N", "N", "Frictional power of the patch over the rolling speed"});
    for (const DamageIndexEntry &index : damage_indices())
      keys.push_back({index.key, unit_of_heading(index.key), index.about});
    return keys;
  }


  std::vector<std::string> limits_of_half_space(const std::vector<WheelPatch> &patches)
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
          warnings.push_back(format("patch %u holds %u regions nearer to each other than 'Wheelset/Patch "
                                    "distance (mm)', solved in one "
                                    "plane",
                                    static_cast<unsigned int>(k + 1), patches[k].region.parts));
        if (const double share = patches[k].sink_by_others / patches[k].region.overlap;
            share > largest_sink_by_others)
          warnings.push_back(format(
            "patch %u gives way under the pressure of the others by about %.0f %% of its overlap, which its "
            "solution leaves out: its force is too large",
            static_cast<unsigned int>(k + 1), 100. * share));
      }
    return warnings;
  }


  double frictional_power(const WheelContact &contact)
  {
    double sum = 0.;
    for (const WheelPatch &patch : contact.patches)
      sum += patch.solution.frictional_power;
    return sum;
  }


  void summarise_wheelset(Summary            &summary,
                          const Scene        &scene,
                          const std::string  &method,
                          const WheelContact &contact,
                          const double        angular_velocity,
                          const bool          completed)
  {
    summary.set("title", scene.general.title);
    summary.set("method", method);
    summary.set("completed", completed);
    summary.set("lateral_shift_m", contact.position.shift);
    summary.set("yaw_rad", contact.position.yaw);
    summary.set("roll_rad", contact.position.roll);
    summary.set("angular_velocity_rad_per_s", angular_velocity);
    summary.show("creepage_over_nominal_radius", "creepage over 'Wheel/Radius', 1e-3", 1e3,
                 angular_velocity * scene.wheel.radius / scene.motion.speed - 1.);
    summary.show("wheelset_height_m", "wheelset over its radius, mm", 1e3, contact.position.height);
    summary.set("traction_coefficient", contact.force[2] > 0. ? contact.force[0] / contact.force[2] : 0.);
    summary.set("friction_coefficient", scene.contact.friction_coefficient);
    double pressure = 0., area = 0., shear = 0., slip = 0.;
    for (const WheelPatch &patch : contact.patches)
      {
        pressure = std::max(pressure, patch.solution.max_pressure);
        area += patch.solution.area;
        shear = std::max(shear, patch.solution.max_shear);
        slip  = std::max(slip, patch.solution.max_slip);
      }
    summary.set("max_pressure_Pa", pressure);
    summary.set("patch_area_m2", area);
    summary.set("max_shear_Pa", shear);
    summary.set("max_slip_m_per_s", slip);
    summary.set("t_gamma_N", frictional_power(contact) / scene.motion.speed);
    std::vector<DamageIndex::Load> loads;
    for (const WheelPatch &patch : contact.patches)
      loads.push_back(load_of(patch, scene));
    summarise_damage(summary, scene, loads);
  }
} // namespace tread
