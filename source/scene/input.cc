// SPDX-License-Identifier: LGPL-2.1-or-later
// From a parameter file and settings to a scene that has been checked.
#include <tread/base/format.h>
#include <tread/geometry/slice_list.h>
#include <tread/scene/checks.h>
#include <tread/scene/scene.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

namespace tread
{
  namespace
  {
    /// Note the files that parameters name, with their contents.
    void note_files(ParameterFile &input, const Scene &scene)
    {
      std::error_code cannot_tell;
      for (const auto &[name, file] :
           {std::pair("Wheel/Tread profile", scene.wheel.tread_profile),
            std::pair("Wheel/Deviation", scene.wheel.deviation),
            std::pair("Rail/Measured head", scene.rail.measured_head),
            std::pair("Rail/Slices", scene.rail.slices), std::pair("Rail/Mesh file", scene.rail.mesh_file),
            std::pair("Defect/Profile file", scene.defect.profile_file),
            std::pair("Guidance/File", scene.guidance.file),
            std::pair("Track/Support file", scene.track.support_file),
            std::pair("Track/Beam file", scene.track.beam_file)})
        if (const std::string path = input.located(file);
            !file.empty() && std::filesystem::is_regular_file(path, cannot_tell))
          {
            input.note(name, path);
            // A slice may stand in a list more than once.
            const std::vector<std::string> named = slices_named_in(path);
            for (const std::string &slice : std::set<std::string>(named.begin(), named.end()))
              input.note(std::string(name) + ": " + slice,
                         (std::filesystem::path(path).parent_path() / slice).string());
          }
    }

    /// Put the wheelset where its motion begins. @throws InputError
    void stand_at_start_of(const WheelsetMotion &table, WheelsetSection &wheelset, MotionSection &motion)
    {
      const Across start = table.at(0., {wheelset.shift.value_or(0.), wheelset.yaw, wheelset.roll, {}});
      require(!(wheelset.both_wheels && table.has_roll()),
              "'Guidance/File' has roll_mrad, which is found where 'Wheelset/Both wheels' is true");
      wheelset.shift = start.y;
      wheelset.yaw   = start.yaw;
      wheelset.roll  = start.roll;
      if (start.angular_velocity)
        {
          require(!motion.angular_velocity,
                  "'Motion/Angular velocity (rad per s)' and the angular velocity in "
                  "'Guidance/File' exclude each other");
          motion.angular_velocity = start.angular_velocity;
        }
    }
  } // namespace


  void Scene::take(const std::string &file, const std::vector<std::string> &settings)
  {
    input.read(file, settings);
    require(!vehicle.wheel_load || !vehicle.axle_load,
            "'Vehicle/Wheel load (kN)' and 'Vehicle/Axle load (t)' both set the load: give one of them");
    if (vehicle.wheel_load)
      {
        require(vehicle.gravity > 0., "'Vehicle/Wheel load (kN)' needs 'Vehicle/Gravity (m per s2)' above 0");
        const double weight = wheel.mass * vehicle.gravity;
        require(*vehicle.wheel_load >= weight,
                "'Vehicle/Wheel load (kN)' " + text_of(1e-3 * *vehicle.wheel_load) +
                  " is less than the weight of 'Wheel/Mass (kg)', " + text_of(1e-3 * weight) + " kN");
        vehicle.sprung_mass = *vehicle.wheel_load / vehicle.gravity - wheel.mass;
      }
    if (vehicle.axle_load)
      {
        require(*vehicle.axle_load >= 2. * wheel.mass,
                "'Vehicle/Axle load (t)' " + text_of(1e-3 * *vehicle.axle_load) +
                  " is less than twice 'Wheel/Mass (kg)', " + text_of(2e-3 * wheel.mass) + " t");
        vehicle.sprung_mass = 0.5 * *vehicle.axle_load - wheel.mass;
      }
    constexpr double largest_load = 1e8; // N
    require(static_load() <= largest_load,
            std::string(vehicle.wheel_load  ? "'Vehicle/Wheel load (kN)' presses"
                        : vehicle.axle_load ? "'Vehicle/Axle load (t)' presses"
                                            : "'Wheel/Mass (kg)' and 'Vehicle/Sprung mass (kg)' press") +
              " a wheel with " + text_of(1e-3 * static_load()) + " kN; at most " +
              text_of(1e-3 * largest_load));
    if (time_stepping.levels > 1 && (solid.mass_damping == 0. || mesh.window == WindowUse::always))
      time_stepping.courant_number =
        std::min(time_stepping.courant_number, DynamicsParameters::largest_courant_with_levels);
    note_files(input, *this);
    guidance.check(wheelset.both_wheels);
    if (guidance.kind == Guidance::file)
      {
        read_tables.wheelset_motion = std::make_shared<const WheelsetMotion>(input.located(guidance.file));
        stand_at_start_of(*read_tables.wheelset_motion, wheelset, motion);
      }
    wheelset.check();
    if (!track.support_file.empty())
      read_tables.support_springs = read_support_springs(track, input.located(track.support_file));
    if (!track.beam_file.empty() && track.is_beam())
      read_tables.beam_rows = read_beam_rows(input.located(track.beam_file));
  }


  void Scene::read_surfaces(const std::string &file, const std::vector<std::string> &settings)
  {
    take(file, settings);
    rail.check();
    require(!rail.is_meshed(),
            "'Rail/Shape' mesh has no section for a wheelset in its track: give a profile or slices");
    wheel.check();
  }


  void Scene::read(const std::string &file, const std::vector<std::string> &settings, const SceneUse use)
  {
    take(file, settings);
    const auto made_defect = defect.make(parameters().located(defect.profile_file));
    // A wheelset in a given position has no point of first contact by an upright wheel.
    if (is_positioned())
      {
        require(!rail.is_meshed(),
                "'Rail/Shape' mesh is for an upright wheel: 'Wheelset/Lateral shift (mm)' and "
                "'Motion/Angular velocity (rad per s)' must be left out");
        made_shapes.defect = made_defect;
        shape_deviation(made_shapes, *this);
      }
    else
      {
        made_shapes = make_shapes(*this, made_defect);
        add_patch(made_shapes, *this);
      }
    check_sections(*this, use);
  }


  std::vector<ParameterFile::Setting> Scene::parameters_in(const std::string &file)
  {
    Scene scene;
    scene.input.read(file, {});
    return scene.input.values();
  }
} // namespace tread
