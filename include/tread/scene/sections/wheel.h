// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_wheel_h
#define tread_scene_sections_wheel_h

#include <tread/geometry/measured_line.h>
#include <tread/scene/sections/material.h>

namespace tread
{
  enum class WheelShape
  {
    sector,
    full
  };

  template <>
  const std::vector<Choice<WheelShape>> &choices();

  /// Section `Wheel`. Lengths in m.
  struct WheelSection
  {
    WheelShape       shape             = WheelShape::sector;
    double           radius            = 0.46; ///< where the tread has its running circle
    double           mass              = 900.; ///< unsprung, kg
    double           moment_of_inertia = 58.;  ///< about the axle, kg m^2
    double           sector_thickness = 0.06, sector_width = 0.12, sector_margin = 0.06;
    double           rim_inner_radius = 0.38, rim_width = 0.135, web_thickness = 0.0523;
    double           hub_outer_radius = 0.14, hub_length = 0.18, bore_radius = 0.0925;
    std::string      tread_profile = "cylinder"; ///< name or file
    ProfilePlacement profile_placement;          ///< of that file
    double           lateral_position = 0.;      ///< of the running circle over the rail's middle
    std::string      deviation;                  ///< from round, see wheel_deviation(); empty: none
    double           deviation_smoothing = 0., deviation_pitch = 0.;
    MaterialSection  material;

    bool is_full() const
    {
      return shape == WheelShape::full;
    }
    /// Whether the tread is a file's.
    bool has_measured_profile() const;
    /// Whether the deviation is a file's.
    bool has_scan() const
    {
      return !deviation.empty() && !deviation.starts_with("flat:") && !deviation.starts_with("waves:");
    }
    /// Of what is meshed, across.
    double half_width() const
    {
      return 0.5 * (is_full() ? rim_width : sector_width);
    }
    /// Of what is meshed, below the tread.
    double thickness() const
    {
      return is_full() ? radius - rim_inner_radius : sector_thickness;
    }

    void declare(ParameterTable &table);
    /// @throws InputError
    void check() const;
  };
} // namespace tread

#endif
