// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_scene_h
#define tread_scene_scene_h

#include <tread/scene/parameter_file.h>
#include <tread/scene/placed_wheel.h>
#include <tread/scene/sections/contact.h>
#include <tread/scene/sections/damage.h>
#include <tread/scene/sections/defect.h>
#include <tread/scene/sections/further_wheels.h>
#include <tread/scene/sections/general.h>
#include <tread/scene/sections/guidance.h>
#include <tread/scene/sections/mesh.h>
#include <tread/scene/sections/motion.h>
#include <tread/scene/sections/output.h>
#include <tread/scene/sections/peak_stress.h>
#include <tread/scene/sections/profile_wear.h>
#include <tread/scene/sections/rail.h>
#include <tread/scene/sections/ratcheting.h>
#include <tread/scene/sections/solid.h>
#include <tread/scene/sections/start.h>
#include <tread/scene/sections/time_stepping.h>
#include <tread/scene/sections/track.h>
#include <tread/scene/sections/vehicle.h>
#include <tread/scene/sections/watchdogs.h>
#include <tread/scene/sections/wheel.h>
#include <tread/scene/sections/wheelset.h>
#include <tread/scene/shapes.h>
#include <tread/scene/tables.h>
#include <tread/scene/upright_wheel.h>

#include <memory>
#include <string>
#include <vector>

namespace tread
{
  /// What a scene is read for.
  enum class SceneUse
  {
    roll,      ///< by finite elements
    half_space ///< the half-space solver alone, which has no mesh: sections of mesh, cells and track may say
               ///< what they like
  };

  /// All that a user chooses: the sections of the parameter file, and what follows from several of them. Each
  /// section declares its own parameters. SI units.
  class Scene
  {
  public:
    Scene();
    Scene(const Scene &) = delete; ///< what stands on it refers to it

    GeneralSection       general;
    WheelSection         wheel;
    WheelsetSection      wheelset;
    GuidanceSection      guidance;
    FurtherWheelsSection further_wheels;
    RailSection          rail;
    DefectSection        defect;
    MeshSection          mesh;
    SolidSection         solid;
    ContactSection       contact;
    TrackSection         track;
    VehicleSection       vehicle;
    MotionSection        motion;
    TimeSteppingSection  time_stepping;
    StartSection         start;
    OutputSection        output;
    PeakStressSection    peak_stress;
    RatchetingSection    ratcheting;
    DamageSection        damage;
    ProfileWearSection   profile_wear;
    WatchdogSection      watchdogs;

    /// Read a parameter file (none: all defaults) with those that its lines "include NAME" name, relative to
    /// its folder, then "Section/Name=value" settings in their order, and
    /// check that they make sense together for what is wanted. @throws InputError
    void read(const std::string              &file,
              const std::vector<std::string> &settings,
              const SceneUse                  use = SceneUse::roll);
    /// The same for the rigid surfaces of a wheelset in its track, which need no more than their own
    /// sections.
    void read_surfaces(const std::string &file, const std::vector<std::string> &settings);

    /// What was read: all parameters as text, the changed ones, the files.
    const ParameterFile &parameters() const
    {
      return input;
    }
    /// All parameters of a scene with this parameter file, in the order of declaration. Only names and ranges
    /// are checked. @throws InputError, also for a file that sets nothing
    static std::vector<ParameterFile::Setting> parameters_in(const std::string &file);
    /// Those among the changed ones that another parameter leaves without effect, one line each, with what
    /// they need.
    std::vector<std::string> unused_parameters() const;

    /// Weight that rests on the contact of each wheel, N.
    double static_load() const
    {
      return (wheel.mass + vehicle.sprung_mass) * vehicle.gravity;
    }
    /// Whether the wheel stands in a position of a wheelset in its track, or turns as one does.
    bool is_positioned() const
    {
      return wheelset.is_positioned() || motion.angular_velocity.has_value();
    }
    /// The wheel with its flange over the rail with its flanks, in the track; read at the first call.
    /// @throws InputError
    const WheelOnRail &wheel_on_rail() const;
    /// The wheelset's position in its track with the axle at x, as long as nothing moves it across.
    WheelsetPosition position_at(const double x) const
    {
      WheelsetPosition position = wheelset.position();
      position.along            = rail.slices_place + x;
      return position;
    }
    /// The wheel in its position under the static load, solved at the first call, which may take some
    /// seconds.
    /// @pre is_positioned() @throws InputError
    const PlacedWheel &placed_wheel() const;
    /// How the wheels stand on the rail: upright, or as placed_wheel(). @throws InputError
    const WheelStance &stance() const
    {
      return is_positioned() ? static_cast<const WheelStance &>(placed_wheel()) : upright;
    }
    /// Where the wheelset stands at a time from the start (s) if 'Guidance' has a file. @pre guidance.kind is
    /// file
    Across across(const double time) const;

    /// Tables that parameters name.
    const SceneTables &tables() const
    {
      return read_tables;
    }
    /// Surfaces and patch of upright wheels, made by read().
    const SceneShapes &shapes() const
    {
      return made_shapes;
    }

    unsigned int n_wheels() const
    {
      return 1 + further_wheels.distances.size();
    }
    unsigned int last_wheel() const
    {
      return n_wheels() - 1;
    }
    /// x of a wheel at the start and at the solution instant, m. Wheel 0 runs ahead of the others.
    double path_begin(const unsigned int number = 0) const
    {
      return motion.start.value_or(-motion.meshed_distance()) - distance_behind(number);
    }
    double path_end(const unsigned int number = 0) const
    {
      return motion.start.value_or(-motion.meshed_distance()) + motion.rolled_distance -
             distance_behind(number);
    }
    /// Where the way ends for which rail and wheel are meshed: at the end of the path, or behind it.
    double meshed_end(const unsigned int number = 0) const
    {
      return path_begin(number) + motion.meshed_distance();
    }
    /// Longitudinal over normal force that the drive of a wheel aims at.
    double traction_coefficient(const unsigned int number) const;
    /// Ends of the rail, m.
    double rail_begin() const;
    double rail_end() const;
    /// Half the width of the rail's top, where the wheel begins, and the thickness of what is meshed there,
    /// m.
    double rail_half_width() const;
    double rail_thickness() const;
    /// Height of the axle at the start, m.
    double axle_height() const
    {
      return wheel.radius + made_shapes.first_contact.lift;
    }
    /// Whether forces vary along the path by the nature of the scene: a defect, a wheel that is not round, or
    /// discrete supports.
    bool has_impacts() const
    {
      return !made_shapes.are_smooth() || track.has_supports() || track.is_beam();
    }

    /// Along the rail or the tread, m.
    struct Range
    {
      double begin, end;
    };

  private:
    /// Read a file and settings, unchecked.
    void take(const std::string &file, const std::vector<std::string> &settings);
    /// Of a wheel behind the first one, m.
    double distance_behind(const unsigned int number) const
    {
      return number == 0 ? 0. : further_wheels.distances[number - 1];
    }

    ParameterFile                              input;
    SceneTables                                read_tables;
    SceneShapes                                made_shapes;
    const UprightWheel                         upright{*this};
    mutable std::shared_ptr<const WheelOnRail> on_rail; ///< null until it is asked for
    mutable std::shared_ptr<const PlacedWheel> placed;  ///< null until it is asked for
  };
} // namespace tread

#endif
