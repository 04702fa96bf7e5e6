// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/profile_names.h>
#include <tread/geometry/rail_slices.h>
#include <tread/scene/checks.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/recorded.h>
#include <tread/scene/scene.h>
#include <tread/scene/wheelset_case.h>

#include <cmath>
#include <filesystem>

namespace tread
{
  namespace
  {
    /// @throws InputError unless the motion lasts as long as the run, in positions that are allowed
    void check_guidance(const Scene &scene)
    {
      if (!scene.tables().wheelset_motion)
        return;
      const double cell     = 2. * scene.mesh.finest_cell; // half a one and the last group of steps
      const double duration = (scene.motion.meshed_distance() + cell) / scene.motion.speed;
      require(scene.tables().wheelset_motion->end() >= duration - cell / scene.motion.speed,
              "'Guidance/File' ends at " + text_of(scene.tables().wheelset_motion->end()) +
                " s; the run takes " + text_of(scene.motion.meshed_distance() / scene.motion.speed) + " s");
      constexpr unsigned int n_instants = 200;
      constexpr double       largest    = 0.2; // as of the creepages of 'Motion'
      double                 before     = scene.across(0.).y;
      for (unsigned int i = 0; i <= n_instants; ++i)
        {
          const Across now      = scene.across(duration * i / n_instants);
          const double creepage = (now.y - before) / (duration / n_instants * scene.motion.speed);
          require(std::abs(creepage) <= largest, "'Guidance/File' moves the wheelset sideways at " +
                                                   text_of(std::abs(creepage)) + " of its speed, " +
                                                   text_of(duration * i / n_instants) +
                                                   " s after the start; at most " + text_of(largest));
          require(!now.angular_velocity || *now.angular_velocity >= 0.,
                  "'Guidance/File' turns the wheel backwards at " +
                    text_of(now.angular_velocity.value_or(0.)) + " rad/s, " +
                    text_of(duration * i / n_instants) + " s after the start");
          before               = now.y;
          WheelsetSection then = scene.wheelset;
          then.yaw             = now.yaw;
          then.roll            = now.roll;
          try
            {
              then.check();
            }
          catch (const InputError &error)
            {
              throw InputError("'Guidance/File', " + text_of(duration * i / n_instants) +
                               " s after the start: " + error.what());
            }
        }
    }

    void check_slices(const Scene &scene)
    {
      if (!scene.rail.is_sliced())
        return;
      require(
        !scene.wheelset.both_wheels && !scene.contact.varies_across(),
        "'Rail/Slices' are one rail, of which only the surface is known: 'Wheelset/Both wheels' must be "
        "false, 'Contact/Friction across (mm)' and 'Friction inclinations (deg)' empty");
      require(scene.wheel.material.yield_stress == 0. && scene.wheel.material.plastic_zones.empty(),
              "'Wheel/Yield stress (MPa)' must be 0 and 'Plastic zones' empty over 'Rail/Shape' slices: the "
              "wheel would "
              "yield only where it touches at the start");
      const Surface::Extent known = scene.wheel_on_rail().rail_surface().extent();
      const double          begin = scene.rail.slices_place + scene.rail_begin(),
                   end            = scene.rail.slices_place + scene.rail_end();
      require(
        known.includes(begin) && known.includes(end),
        "'Rail/Slices' reach from " + text_in_mm(known.along_begin) + " to " + text_in_mm(known.along_end) +
          " mm, the rail of the scene from " + text_in_mm(begin) + " to " + text_in_mm(end) +
          " mm along them: change 'Rail/Slices place (mm)', 'Margin (mm)' or 'Motion/Rolled distance (mm)'");
    }

    /// Of a wheelset of which one wheel is looked at.
    void check_other_wheel(const Scene &scene)
    {
      // The roll follows from the contact of both, or the other wheel's rail is not known.
      if (scene.wheelset.both_wheels || scene.rail.is_sliced())
        return;
      // A flange that climbs, or a roll that was not given, is some millimetres.
      constexpr double       deepest  = 15e-3; // m
      const WheelOnRail     &surfaces = scene.wheel_on_rail();
      const WheelsetPosition position = scene.wheelset.position();
      double                 overlap  = 0.;
      try
        {
          // At the height at which the own wheel touches.
          overlap = surfaces.nearest(position).gap - surfaces.nearest(position.mirrored()).gap;
        }
      catch (const std::runtime_error &)
        {
          return; // the own wheel meets no rail, which is said later; or the other one has none under it
        }
      require(overlap <= deepest, "'Wheelset/Lateral shift (mm)' " + text_in_mm(position.shift) +
                                    " puts the other wheel of the wheelset " + text_in_mm(overlap) +
                                    " mm deep into its rail: no wheelset stands there; at most " +
                                    text_in_mm(deepest) + " mm, as 'Wheelset/Roll (mrad)' may be missing");
    }

    /// @throws InputError
    WheelOnRail make_wheel_on_rail(const Scene &scene)
    {
      const auto wheel_profile = [&] {
        try
          {
            return wheel_curve(scene.parameters().located(scene.wheel.tread_profile),
                               scene.wheel.profile_placement);
          }
        catch (const std::runtime_error &error)
          {
            throw InputError("'Wheel/Tread profile': " +
                             refused_tread(scene.wheel.tread_profile, error.what()));
          }
      };
      const auto rail_profile = [&] {
        if (scene.rail.measured_head.empty())
          return rail_curve(scene.rail.standard_profile());
        try
          {
            return measured_rail_curve(scene.parameters().located(scene.rail.measured_head),
                                       scene.rail.head_placement);
          }
        catch (const std::runtime_error &error)
          {
            throw InputError("'Rail/Measured head': " + std::string(error.what()));
          }
      };
      const auto sliced_rail = [&] {
        try
          {
            return std::make_shared<const SlicedRail>(
              read_rail_slices(scene.parameters().located(scene.rail.slices)));
          }
        catch (const InputError &error)
          {
            throw InputError("'Rail/Slices': " + std::string(error.what()));
          }
      };
      require(!scene.rail.is_block(),
              "a wheelset in its track needs a rail with a gauge face: 'Rail/Shape' cannot be block");
      try
        {
          if (scene.rail.is_sliced())
            return WheelOnRail(WheelSurface(wheel_profile()), sliced_rail(), scene.wheel.radius,
                               scene.wheelset.track,
                               WheelOnRail::RailOrigin{scene.rail.slices_y, scene.rail.slices_z});
          return WheelOnRail(wheel_profile(), rail_profile().turned(scene.rail.angle()), scene.wheel.radius,
                             scene.wheelset.track);
        }
      catch (const InputError &)
        {
          throw;
        }
      catch (const std::runtime_error &error)
        {
          throw InputError("wheelset in its track: " + std::string(error.what()));
        }
    }
  } // namespace


  const WheelOnRail &Scene::wheel_on_rail() const
  {
    if (!on_rail)
      on_rail = std::make_shared<const WheelOnRail>(make_wheel_on_rail(*this));
    return *on_rail;
  }


  const PlacedWheel &Scene::placed_wheel() const
  {
    if (!placed)
      placed = std::make_shared<const PlacedWheel>(*this);
    return *placed;
  }


  Across Scene::across(const double time) const
  {
    Across now =
      read_tables.wheelset_motion->at(time, {wheelset.shift.value_or(0.), wheelset.yaw, wheelset.roll, {}});
    now.y -= wheelset.shift.value_or(0.);
    return now;
  }


  void check_wheelset(const Scene &scene)
  {
    check_guidance(scene);
    scene.motion.check();
    scene.rail.check();
    scene.wheel.check();
    require(scene.static_load() > 0.,
            "'Vehicle/Gravity (m per s2)' must be above 0: nothing loads the contact");
    require(
      scene.wheel.lateral_position == 0.,
      "'Wheel/Lateral position (mm)' is for an upright wheel; in a track 'Wheelset/Lateral shift (mm)' takes "
      "its place");
    require(!scene.shapes().defect || !scene.rail.is_sliced(),
            "'Defect/Shape' must be none over 'Rail/Shape' slices, which hold the surface as it is");
    require(scene.further_wheels.distances.empty(),
            "'Further wheels/Distances (mm)' must be empty where 'Wheelset' has a position");
    require(scene.motion.angular_velocity || scene.motion.creepage,
            "a wheelset in a given position needs 'Motion/Angular velocity (rad per s)', or a number for "
            "'Motion/Creepage'");
    require(!(scene.motion.angular_velocity && scene.motion.creepage),
            "'Motion/Angular velocity (rad per s)' and a number for 'Motion/Creepage' exclude each other");
    require(scene.motion.spin == 0.,
            "'Motion/Spin (1 per m)' must be 0 where 'Wheelset' has a position, from which it follows");
    scene.contact.check();
    check_friction_by_temperature(scene);
    check_slices(scene);
    check_other_wheel(scene);
    const WheelRolling rolling = wheel_rolling(scene, scene.path_begin());
    require(
      (rolling.is_coulomb() && !scene.contact.varies_across()) ||
        reference::combine(rolling.wheel, rolling.rail).coupling == 0.,
      "'Contact/Friction law' must be Coulomb and 'Friction pressures (MPa)', 'Friction temperatures (C)', "
      "'Friction across (mm)' and 'Friction inclinations (deg)' empty where 'Wheelset' has a position and "
      "wheel and rail are of "
      "unlike materials: half-space theory has no answer");
    require(
      !rolling.slip_friction || (!rolling.pressure_factor && !scene.contact.varies_across()),
      "'Contact/Friction law' must be Coulomb with 'Friction pressures (MPa)', 'Friction across (mm)' or "
      "'Friction inclinations (deg)' where 'Wheelset' has a position: half-space theory has no answer for "
      "both");
    require(
      !scene.contact.varies_across() || !scene.wheelset.both_wheels,
      "'Contact/Friction across (mm)' and 'Friction inclinations (deg)' are for one rail: 'Wheelset/Both "
      "wheels' must be false");
  }


  void check_placed_mesh(const Scene &scene)
  {
    scene.general.check();
    check_motion(scene);
    scene.mesh.check();
    scene.solid.check();
    scene.further_wheels.check(2. * scene.wheel.radius);
    const auto without = [](const bool none, const std::string &what) {
      require(none, what + " where 'Wheelset' has a position and the wheel is meshed");
    };
    require(scene.guidance.yaw_inertia > 0. || !scene.wheelset.both_wheels,
            "'Guidance/Yaw inertia (kg m2)' must be above 0 with 'Wheelset/Both wheels', which roll with it");
    without(!scene.track.has_supports(), "'Track/Foundation' must be rigid, co-running or beam");
    check_rail_ends(scene);
    check_track(scene);
    check_defect(scene);
    without(!scene.wheel.is_full(), "'Wheel/Shape' must be sector");
    require(scene.motion.drive != Drive::torque || !scene.wheelset.has_flexible_axle(),
            "'Motion/Drive' cannot be torque on a flexible axle ('Wheelset/Axle torsional stiffness (MN m "
            "per rad)', "
            "'Axle bending stiffness (MN m2)'): where it acts on it is not known");
    check_peak_stress(scene);
    check_window(scene);
    recorded_cells(scene);
    without(scene.mesh.fine_from == scene.mesh.fine_to,
            "'Mesh/Fine from (mm)' and 'Fine to (mm)' must be equal");
    const auto require_margin = [&](const WheelPatch &patch) {
      const reference::PlanarResult &s = patch.solution;
      const double least               = 1.5 * (s.x_end - s.x_begin) + std::abs(patch.region.reference[0]);
      require(
        std::min(scene.rail.margin, scene.wheel.sector_margin) >= least,
        "'Rail/Margin (mm)' " + text_in_mm(scene.rail.margin) + " or 'Wheel/Sector margin (mm)' " +
          text_in_mm(scene.wheel.sector_margin) +
          " lets the patch leave what is meshed; both at least three half lengths of the patch and what "
          "it lies ahead of the axle, " +
          text_in_mm(least) + " mm");
    };
    for (const WheelPatch &patch : scene.placed_wheel().patches())
      {
        const reference::PlanarResult &s = patch.solution;
        const double                   a = 0.5 * (s.x_end - s.x_begin), b = 0.5 * (s.y_end - s.y_begin);
        const double                   largest_finest = 0.45 * std::min(a, b);
        require(scene.mesh.finest_cell <= largest_finest,
                "'Mesh/Finest cell (mm)' " + text_in_mm(scene.mesh.finest_cell) +
                  " is too large for a patch " + text_in_mm(2. * a) + " mm long and " + text_in_mm(2. * b) +
                  " mm wide; at most " + text_in_mm(largest_finest));
        require_margin(patch);
      }
    for (const TouchedPiece &piece : scene.placed_wheel().way().pieces)
      for (const TouchedPiece::Touch &touch : piece.touches)
        require_margin(touch.patch);
    require(!wheel_is_ring(scene),
            "'Motion/Rolled distance (mm)' with 'Wheel/Sector margin (mm)' at both ends exceeds 95 % of the "
            "wheel's circumference, " +
              text_in_mm(longest_sector(scene)) + ", where 'Wheelset' has a position");
    check_plasticity(scene);
    check_ratcheting(scene);
    check_numerics(scene);
  }


  double given_angular_velocity(const Scene &scene)
  {
    return scene.motion.angular_velocity
             ? *scene.motion.angular_velocity
             : (1. + *scene.motion.creepage) * scene.motion.speed / scene.wheel.radius;
  }


  WheelRolling wheel_rolling(const Scene &scene, const double x)
  {
    WheelRolling rolling;
    rolling.wheel = elastic_of(scene.wheel.material);
    rolling.rail  = elastic_of(scene.rail.material);
    set_friction(rolling, scene, x);
    if (!scene.contact.friction_places.empty())
      rolling.friction_along = [&scene, x](const double ahead) {
        reference::Friction friction;
        set_friction(friction, scene, x + ahead);
        return friction;
      };
    if (scene.contact.varies_across())
      rolling.factor_across = [contact = scene.contact](const double y, const double inclination) {
        return contact.factor_across(y, inclination);
      };
    rolling.speed                = scene.motion.speed;
    rolling.angular_velocity     = given_angular_velocity(scene);
    rolling.lateral_speed        = scene.motion.lateral_creepage * scene.motion.speed;
    rolling.separation           = scene.wheelset.patch_distance;
    rolling.slip_follows_surface = scene.wheelset.slip_over_patch == SlipOverPatch::surface;
    if (scene.guidance.kind == Guidance::file)
      {
        const double step = 1e-3 / scene.motion.speed;
        const Across now = scene.across(0.), next = scene.across(step);
        rolling.across_speed = (next.y - now.y) / step;
        rolling.yaw_rate     = (next.yaw - now.yaw) / step;
        rolling.roll_rate    = (next.roll - now.roll) / step;
      }
    return rolling;
  }
} // namespace tread
