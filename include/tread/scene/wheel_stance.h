// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_wheel_stance_h
#define tread_scene_wheel_stance_h

#include <tread/contact/contact_records.h>
#include <tread/mesh/body.h>
#include <tread/mesh/fine_zone.h>
#include <tread/reference/hertz.h>
#include <tread/scene/islands.h>
#include <tread/track/wheel_hub.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tread
{
  struct TouchedPiece;

  /// How the wheels of a scene stand on their rail under the static load, as half-space theory finds it:
  /// upright over the path (UprightWheel), or as a wheelset in a position of its track (PlacedWheel). What
  /// differs between both is asked here.
  ///
  /// Axes of the mesh: x along the track; y from the middle of the rail's top to the own side; z up from the
  /// plane on the rail tops (m).
  class WheelStance
  {
  public:
    virtual ~WheelStance() = default;

    /// Rolling radius where the wheel touches; of both wheels of a wheelset the nominal one, m.
    virtual double rolling_radius() const = 0;
    /// The patch, of several the main one, as Hertz's ellipse. @param normal_force N, > 0; of a wheelset in a
    /// position the vertical one
    virtual reference::HertzEllipse ellipse(const double normal_force) const = 0;
    /// y of its middle, m.
    virtual double patch_y() const = 0;
    /// What rests on the rails under one meshed wheelset, in static loads of a wheel.
    virtual unsigned int n_loads() const = 0;

    /// Rail, wheels and solid sleepers, in the order of their numbers. @throws InputError
    virtual std::vector<Body> make_bodies(const FineWindow &window) const = 0;
    /// Where and how fast a wheel begins.
    virtual void place(WheelHub &hub, const unsigned int number) const = 0;

    /// How far a place in a body is `beside` a patch, in its plane, and `below` the running surface, across
    /// this plane, and where along the path it is, on the wheel from where it touches at the start (m).
    struct Place
    {
      double along, beside, below;
    };
    /// A place of the reference configuration beside each patch under which steel may yield.
    virtual std::vector<Place> places_under(const dealii::Point<3> &p, const unsigned int body) const = 0;
    /// Depth below the rail's running surface of a place in the reference configuration, m.
    virtual double depth_in_rail(const dealii::Point<3> &p) const = 0;

    /// The way of a patch of the own wheel along the rail: of the main one, or of the most loaded on each
    /// piece of slices.
    struct Path
    {
      const TouchedPiece *piece;      ///< null: the rail is the same everywhere
      std::string         name;       ///< of the piece; empty: none
      double              begin, end; ///< x of the patch's reference point at both ends (m)
      double              half_width; ///< of the widest patch; 0: of Hertz's (m)
      double              ahead;      ///< how far from the axle it is at most, m
    };
    virtual std::vector<Path> paths() const = 0;
    /// The path that carries most over a stretch of the rail (m), and where places of a body are beside it,
    /// each measure by itself: the depth below a rail of slices costs a section. `along` is where they meet
    /// the rail.
    /// @pre a path holds the stretch
    struct Strip
    {
      using Measure = std::function<double(const dealii::Point<3> &)>;
      Path    path;
      Measure along, beside, below;
    };
    virtual Strip strip(const unsigned int body, const double begin, const double end) const = 0;
    /// Whether a place of the rail's surface lies within half a cell on the line on which the wheel rolls.
    virtual bool is_on_path(const dealii::Point<3> &p, const double cell) const = 0;

    /// Factor of the friction coefficient across the rail, at a place of its surface in the reference
    /// configuration. @pre the scene's friction varies across
    virtual double factor_across(const Vector3 &place) const = 0;
    /// Lines of the rail under the patches: y (m), and by how much each carries, in any unit.
    virtual std::vector<std::pair<double, double>> loaded_lines() const = 0;
    /// A patch of the own wheel on the smooth rail at the start, from edge to edge: along x from the axle,
    /// and across in the rail's own axes, m.
    struct Footprint
    {
      double x_begin, x_end, y_begin, y_end;
    };
    virtual std::vector<Footprint> footprints() const = 0;
    /// What of the tread comes to the rail on all of the way: along the arc from the bottom at the start, and
    /// over y as SceneShapes has its deviation, m.
    virtual std::vector<Footprint> treads() const = 0;
    /// How far beside these patches the wheel touches a rail that is higher by this (m); infinite: anywhere.
    virtual double reach_beside(const double height) const = 0;
    /// The parts of the patches on the way, with the words for each patch.
    virtual std::vector<std::pair<std::string, std::vector<Island>>> parts_of_patches() const = 0;

    /// Force, normal and slip of a node in the contact axes of its patch; its position stays. @param wheel_x
    /// m
    virtual ContactNodeState in_contact_axes(const ContactNodeState &state, const double wheel_x) const = 0;
    /// What should not be for long of how the wheels touch, a line each.
    virtual std::vector<std::string> warnings() const = 0;
    /// Patches that a run measures one by one; 0: all contact of a wheel is one patch.
    virtual unsigned int n_separate_patches() const = 0;

    /// What moves the wheel across the rail, and what its load's direction is called.
    struct Words
    {
      std::string across_parameter, load_direction;
    };
    virtual Words words() const = 0;
  };
} // namespace tread

#endif
