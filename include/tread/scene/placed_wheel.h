// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_placed_wheel_h
#define tread_scene_placed_wheel_h

#include <tread/analysis/contact_patch.h>
#include <tread/analysis/wheelset_contact.h>
#include <tread/base/simd.h>
#include <tread/contact/contact.h>
#include <tread/mesh/body.h>
#include <tread/reference/hertz.h>
#include <tread/scene/touched_pieces.h>
#include <tread/scene/wheel_stance.h>

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace tread
{
  class Scene;

  /// Contact axes of a patch in those of the mesh, relative to the wheelset's middle at x = 0: x, s along the
  /// tangent plane, n normal to it into the wheel; s of the other wheel points to its own side.
  struct ContactAxes
  {
    Vector3 origin;        ///< reference point of the patch, m
    Vector3 along, normal; ///< directions of s and n

    /// Along x, s and n: a vector of the mesh.
    Vector3 turned(const Vector3 &v) const
    {
      return Vector3{v[0], dot(v, along), dot(v, normal), 0.};
    }
  };

  /// The wheel of a wheelset, or both wheels, in its position under the static load, as half-space theory
  /// finds it: where a mesh must be fine, and what a run is compared with.
  ///
  /// The wheelset's middle is at the wheel's x.
  class PlacedWheel : public WheelStance
  {
  public:
    /// @param scene which must stay @throws InputError where wheel and rail do not meet, or no height carries
    /// the load.
    explicit PlacedWheel(const Scene &scene);
    /// The same in another position.
    PlacedWheel(const Scene &scene, const WheelsetPosition &position, const WheelRolling &rolling);

    /// One wheel in the track axes of its own side.
    struct Side
    {
      WheelContact contact;
      bool         is_mirrored;
    };
    /// The own wheel, then the other one where it is there.
    const std::vector<Side> &sides() const
    {
      return solved_sides;
    }
    /// Those of the own wheel first.
    const std::vector<WheelPatch> &patches() const
    {
      return contact.patches;
    }
    /// Of the own wheel, that with the largest normal force.
    const WheelPatch &main_patch() const;

    double rolling_radius() const override;
    double patch_y() const override
    {
      return axes(main_patch()).origin[1];
    }
    unsigned int      n_loads() const override;
    std::vector<Body> make_bodies(const FineWindow &) const override;
    void              place(WheelHub &hub, const unsigned int) const override;

    /// Through the main patch, or the most loaded touch of slices that is nearest.
    bool   is_on_path(const dealii::Point<3> &p, const double cell) const override;
    double factor_across(const Vector3 &place) const override;
    std::vector<std::pair<double, double>> loaded_lines() const override;
    std::vector<Footprint>                 footprints() const override;
    std::vector<Footprint>                 treads() const override;
    double                                 reach_beside(const double) const override
    {
      return std::numeric_limits<double>::infinity(); // the surfaces lie close at other angles, too
    }
    std::vector<std::pair<std::string, std::vector<Island>>> parts_of_patches() const override;
    /// Patches that climb.
    std::vector<std::string> warnings() const override
    {
      return climbing_patches(surfaces, patches());
    }
    unsigned int n_separate_patches() const override
    {
      return patches().size();
    }
    Words words() const override
    {
      return {"'Wheelset/Lateral shift (mm)'", "vertical"};
    }

    /// Of a rail of slices. @pre made of the scene alone
    const WayOverSlices &way() const
    {
      return slices;
    }
    /// Between two pieces of it on all of the way: y in the mesh, m; nothing where there are not two.
    std::optional<double> between_pieces() const;

    /// Vertical speed (m/s) and roll rate (rad/s) of the wheelset with which its wheels keep touching while
    /// it moves along a rail that rises, and across the track as prescribed.
    struct Rise
    {
      double speed, roll_rate;
    };
    Rise rise() const;
    /// Of the patch, from one edge across the path to the other, that is nearest to a place relative to the
    /// wheelset's middle.
    unsigned int nearest_patch(const Vector3 place) const;

    /// Middle of the wheelset with the wheel at x = 0.
    Vector3 middle() const;
    /// Of a patch of either wheel.
    ContactAxes axes(const WheelPatch &patch) const;

    ContactNodeState in_contact_axes(const ContactNodeState &state, const double wheel_x) const override;
    /// Those nodes in contact axes that belong to a patch, their positions too, but for the wheel's x in
    /// them.
    std::vector<ContactNodeState> of_patch(const unsigned int                   number,
                                           const std::vector<ContactNodeState> &states,
                                           const double                         wheel_x) const;

    /// An ellipse of the main patch's length and width, at another vertical force in proportion (N).
    reference::HertzEllipse ellipse(const double vertical_force) const override;

    /// Below the rail without its defect, as zones that may yield are.
    Place place_in_rail(const dealii::Point<3> &p, const WheelPatch &patch) const;
    /// Below the wheel as it is without what it is not round by. @param start_x of the wheel in the reference
    /// configuration
    Place place_in_wheel(const dealii::Point<3> &p, const WheelPatch &patch, const double start_x) const;
    std::vector<Place> places_under(const dealii::Point<3> &p, const unsigned int body) const override;
    /// Of the patch that is nearest.
    double depth_in_rail(const dealii::Point<3> &p) const override;

    std::vector<Path> paths() const override;
    Strip             strip(const unsigned int body, const double begin, const double end) const override;
    /// Those that hold a stretch of the rail; that with the largest force there first.
    std::vector<Path> paths_over(double begin, double end) const;
    /// How far a place of the rail is beside a path (m).
    double beside(const Path &path, const dealii::Point<3> &p) const;
    /// Of the patch that rolls there, below the tread with what it is not round by; `along` is where this
    /// part of it meets the rail.
    Place place_in_wheel(const dealii::Point<3> &p, const Path &path, const double start_x) const;

    const WheelOnRail surfaces;

  private:
    /// Depth below the running surface with its defect, along the normal of a patch, m.
    double depth_under(const dealii::Point<3> &p, const WheelPatch &patch) const;
    /// Of slices, where a place is in the piece whose path is nearest.
    Place place_in_slices(const dealii::Point<3> &p) const;

    const Scene      &scene;
    std::vector<Side> solved_sides;
    /// Of the slices, by x.
    mutable std::map<double, std::shared_ptr<const std::vector<ProfileCurve>>> sections_at;
    WayOverSlices                                                              slices;

  public:
    /// Of all wheels, in the track axes of the own one.
    WheelContact contact;
  };

  /// Traction on the wheel over the pressure [-] in the half-space's answer, in axes of the mesh, at a place
  /// relative to the wheelset's middle (m).
  Vector3 traction_over_pressure(const PlacedWheel &wheel, const Vector3 place);

  /// The elements in contact of the half-space's answer, x from the wheelset's middle (m), tractions and slip
  /// in contact axes.
  std::vector<PatchNode> table_nodes(const PlacedWheel &wheel);
  std::vector<PatchNode> table_nodes(const PlacedWheel &wheel, const WheelPatch &patch); ///< of one patch
} // namespace tread

#endif
