// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_track_h
#define tread_scene_sections_track_h

#include <tread/base/section.h>
#include <tread/track/rail_base.h>

namespace tread
{
  enum class Foundation
  {
    rigid,
    one_layer,
    two_layer,
    co_running,
    beam
  };

  template <>
  const std::vector<Choice<Foundation>> &choices();

  enum class SleeperKind
  {
    mass,
    solid
  };

  template <>
  const std::vector<Choice<SleeperKind>> &choices();

  /// Row of 'Track/Beam file': from x on the beam has this section. SI units.
  struct BeamRow
  {
    double x, bending_stiffness, shear_stiffness, mass;
  };

  /// Section `Track`. SI units.
  struct TrackSection
  {
    Foundation         foundation      = Foundation::rigid;
    SleeperKind        sleepers        = SleeperKind::mass;
    double             sleeper_spacing = 0.6;
    double             support_0       = 0.; ///< x of the support with number 0
    double             pad_stiffness = 1300e6, pad_damping = 45e3, pad_length = 0.15, pad_width = 0.14;
    unsigned int       points_along = 3, points_across = 4;
    double             sleeper_mass   = 200.; ///< half a sleeper
    double             sleeper_length = 2.52, sleeper_width = 0.25, rail_distance = 1.5;
    double             sleeper_young_modulus = 38.4e9, sleeper_poisson_ratio = 0.2, sleeper_density = 2520.;
    double             ballast_stiffness = 45e6, ballast_damping = 32e3;
    double             stiffness_along = 40e6; ///< of a support beyond endless ends
    bool               pads_pull       = true;
    std::string        support_file; ///< supports with springs of their own; empty: none
    RailBaseParameters co_running{450., {100e6, 60e3}, {30e6, 30e3}};
    // 60E1
    double      beam_bending_stiffness = 6.4e6, beam_shear_stiffness = 250e6, beam_mass = 60.2;
    std::string beam_file; ///< stretches of it that differ; empty: none

    bool has_supports() const
    {
      return foundation == Foundation::one_layer || foundation == Foundation::two_layer;
    }
    bool runs_along() const
    {
      return foundation == Foundation::co_running;
    }
    bool is_beam() const
    {
      return foundation == Foundation::beam;
    }
    /// The rail's bottom moves with what stands for the track.
    bool has_moving_base() const
    {
      return runs_along() || is_beam();
    }
    bool has_solid_sleepers() const
    {
      return foundation == Foundation::two_layer && sleepers == SleeperKind::solid;
    }
    /// With which a solid sleeper has its mass, m.
    double solid_sleeper_height() const;

    void declare(ParameterTable &table);
    /// What concerns the track alone, if it has supports. @throws InputError
    void check() const;
  };
} // namespace tread

#endif
