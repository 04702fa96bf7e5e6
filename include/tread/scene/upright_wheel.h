// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_upright_wheel_h
#define tread_scene_upright_wheel_h

#include <tread/scene/wheel_stance.h>

namespace tread
{
  class Scene;

  /// Wheels that stand upright over the path, all alike: where they touch follows from
  /// 'Wheel/Lateral position (mm)'.
  class UprightWheel : public WheelStance
  {
  public:
    /// @param scene which must stay
    explicit UprightWheel(const Scene &scene)
      : scene(scene)
    {
    }

    double                  rolling_radius() const override;
    reference::HertzEllipse ellipse(const double normal_force) const override;
    double                  patch_y() const override;
    unsigned int            n_loads() const override
    {
      return 1;
    }
    std::vector<Body>  make_bodies(const FineWindow &window) const override;
    void               place(WheelHub &hub, const unsigned int number) const override;
    std::vector<Place> places_under(const dealii::Point<3> &p, const unsigned int body) const override;
    double             depth_in_rail(const dealii::Point<3> &p) const override;
    std::vector<Path>  paths() const override;
    Strip              strip(const unsigned int body, const double begin, const double end) const override;
    bool               is_on_path(const dealii::Point<3> &p, const double cell) const override;
    double             factor_across(const Vector3 &place) const override;
    std::vector<std::pair<double, double>>                   loaded_lines() const override;
    std::vector<Footprint>                                   footprints() const override;
    std::vector<Footprint>                                   treads() const override;
    double                                                   reach_beside(const double height) const override;
    std::vector<std::pair<std::string, std::vector<Island>>> parts_of_patches() const override;
    ContactNodeState in_contact_axes(const ContactNodeState &state, const double) const override
    {
      return state;
    }
    std::vector<std::string> warnings() const override
    {
      return {};
    }
    unsigned int n_separate_patches() const override
    {
      return 0;
    }
    Words words() const override
    {
      return {"'Wheel/Lateral position (mm)'", "normal"};
    }

  private:
    const Scene &scene;
  };
} // namespace tread

#endif
