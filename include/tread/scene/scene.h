// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_scene_h
#define tread_scene_scene_h

#include <tread/geometry/running_surfaces.h>
#include <tread/mesh/mesh_rail.h>
#include <tread/scene/islands.h>
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
#include <tread/scene/upright_wheel.h>
#include <tread/scene/wheelset_motion.h>
#include <tread/track/supports.h>

#include <cmath>
#include <map>
#include <string>

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

    /// Whether the measured head ends, at one side, before what is searched for contact:
    /// surfaces().half_width.
    bool has_narrow_head() const;

    /// Where the defect lies and how deep, and what the wheel is not round by, one line; empty: neither.
    std::string defect_in_words() const;

    /// Whether read() has laid the path on the rail; read_surfaces() does not.
    bool has_path() const
    {
      return shapes != nullptr;
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
      return shapes->path_begin - distance_behind(number);
    }
    double path_end(const unsigned int number = 0) const
    {
      return shapes->path_end - distance_behind(number);
    }
    /// Where the way ends for which rail and wheel are meshed: at the end of the path, or behind it.
    double meshed_end(const unsigned int number = 0) const
    {
      return path_begin(number) + motion.meshed_distance();
    }
    /// Longitudinal over normal force that the drive of a wheel aims at.
    double traction_coefficient(const unsigned int number) const;
    /// Ends of the rail, m.
    double rail_begin() const
    {
      return shapes->rail_begin;
    }
    double rail_end() const;
    /// Half the width of the rail's top, where the wheel begins, and the thickness of what is meshed there,
    /// m.
    double rail_half_width() const;
    double rail_thickness() const;
    /// The rail from 'Rail/Mesh file'. Null: it has another shape.
    const std::shared_ptr<const MeshRail> &rail_mesh() const
    {
      return shapes->rail_mesh;
    }
    bool is_between_planes() const ///< @see MeshRail::between_planes
    {
      return rail_mesh() && rail_mesh()->between_planes;
    }
    /// Whether the running surface of that rail has other heights, or ends, somewhere along the path.
    bool has_uneven_mesh() const
    {
      return shapes->unevenness > 0.;
    }
    /// By how much, m.
    double unevenness() const
    {
      return shapes->unevenness;
    }
    /// Position in the rail's own axes, which are inclined with it.
    dealii::Point<3> in_rail_axes(const dealii::Point<3> &p) const;

    /// The running surfaces of wheel and rail, created by read().
    const RunningSurfaces &surfaces() const
    {
      return shapes->surfaces;
    }
    bool has_defect() const
    {
      return shapes->defect != nullptr;
    }
    /// Null: none.
    const Defect *made_defect() const
    {
      return shapes->defect.get();
    }
    /// Whether the wheel is a body of revolution.
    bool is_round() const
    {
      return !surfaces().deviation;
    }
    /// The largest deviation from round, inwards or outwards, that comes to the rail on the way that is
    /// meshed (m).
    double largest_deviation() const
    {
      return shapes->largest_deviation;
    }
    /// Whether rolling may become steady: a round wheel on a rail without a defect that is the same all the
    /// way.
    bool rolls_smoothly() const
    {
      return !has_defect() && is_round() && !has_uneven_mesh();
    }
    /// Whether forces vary along the path by the nature of the scene: a defect, a wheel that is not round, or
    /// discrete supports.
    bool has_impacts() const
    {
      return !rolls_smoothly() || track.has_supports() || track.is_beam();
    }
    /// Height above the rail's profile, in the rail's own axes: measured head and defect. Null: none. @see
    /// RailTop
    const std::function<double(double, double)> &rail_height() const
    {
      return shapes->rail_height;
    }
    /// Point of first contact on the smooth rail, and the position of the wheel at the start.
    const FirstContact &first_contact() const
    {
      return shapes->contact;
    }
    /// Lateral extent of the patch under the static load on the smooth rail (m), from half-space theory with
    /// the true gap: the patch of a worn profile or of S1002 may extend far to one side of the first contact.
    struct PatchExtent
    {
      double begin, end;
    };
    const PatchExtent &patch_extent() const
    {
      return shapes->patch;
    }
    /// Along the rail or the tread, m.
    struct Range
    {
      double begin, end;
    };
    /// The parts of the patch under the static load, more than one where a worn profile touches with a gap
    /// between.
    const std::vector<Island> &islands() const
    {
      return shapes->islands;
    }
    /// Height of the axle at the start, m.
    double axle_height() const
    {
      return wheel.radius + first_contact().lift;
    }
    /// Of 'Track/Support file', by the number of the support.
    const std::map<int, TrackParameters::Springs> &springs_of_supports() const
    {
      return support_springs;
    }
    /// Of 'Track/Beam file'.
    const std::vector<BeamRow> &rows_of_beam() const
    {
      return beam_rows;
    }
    /// Of 'Guidance/File'; null: none.
    const WheelsetMotion *motion_of_wheelset() const
    {
      return wheelset_motion.get();
    }
    /// Rolling radius of the wheel at the first contact; of both wheels of a wheelset the nominal one, m.
    double rolling_radius() const;
    /// Lateral radius of the gap between the surfaces where they touch, m: that of the rail, or fitted over
    /// 5 mm at both sides. Flatter gaps than the largest touch along a line, for which Hertz's ellipse means
    /// nothing.
    static constexpr double largest_lateral_radius = 10.;
    double                  lateral_radius() const;
    bool                    has_fitted_lateral_radius() const;

  private:
    /// Read a file and settings, unchecked.
    void take(const std::string &file, const std::vector<std::string> &settings);
    /// Read the table of 'Guidance', and the position at the start from it.
    void take_wheelset_motion();
    /// Read 'Track/Support file' and 'Beam file'.
    void take_support_springs();
    void take_beam_rows();
    /// Quantities that follow from the positions, files and shapes named by the parameters.
    struct Shapes
    {
      double                                path_begin, path_end, rail_begin; ///< x, m
      RunningSurfaces                       surfaces;
      std::function<double(double, double)> rail_height;
      std::string                           deviation; ///< of the wheel from round, in words
      double                                largest_deviation = 0.;
      std::shared_ptr<const Defect>         defect;          ///< null: none
      std::shared_ptr<const MeshRail>       rail_mesh;       ///< null: the rail has another shape
      double                                unevenness = 0.; ///< of that rail along the path, m
      FirstContact                          contact;
      PatchExtent                           patch;
      std::vector<Island>                   islands; ///< of that patch
    };

    /// Of a wheel behind the first one, m.
    double distance_behind(const unsigned int number) const
    {
      return number == 0 ? 0. : further_wheels.distances[number - 1];
    }
    void        check(const SceneUse use) const;
    WheelOnRail make_wheel_on_rail() const;
    /// Note the files that parameters name, with their contents.
    void note_files();
    /// Where the path and the rail begin and end.
    std::shared_ptr<Shapes> make_path() const;
    /// @throws InputError
    void make_shapes();
    void shape_wheel(Shapes &made) const;
    /// largest_deviation(), looked for.
    double deviation_on_the_way() const;
    void   shape_rail(Shapes &made) const;
    /// Surfaces of a rail from a mesh file.
    void shape_mesh_rail(Shapes &made) const;
    /// By how much the smooth surface differs from its section at the start, along the path and over the
    /// patch's width: 0 where it is the same within the error of the fit.
    double unevenness(const Shapes &made) const;
    /// @param islands of the patch, found with it
    PatchExtent patch_under_load(std::vector<Island> &islands) const;

    ParameterFile                              input;
    std::shared_ptr<const Shapes>              shapes;
    const UprightWheel                         upright{*this};
    mutable std::shared_ptr<const WheelOnRail> on_rail;         ///< null until it is asked for
    mutable std::shared_ptr<const PlacedWheel> placed;          ///< null until it is asked for
    std::shared_ptr<const WheelsetMotion>      wheelset_motion; ///< of 'Guidance/File'; null: none
    std::vector<BeamRow>                       beam_rows;
    std::map<int, TrackParameters::Springs>    support_springs; ///< of 'Track/Support file', by the number
  };
} // namespace tread

#endif
