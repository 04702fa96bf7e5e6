// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_rail_h
#define tread_scene_sections_rail_h

#include <tread/geometry/measured_line.h>
#include <tread/geometry/rail_profile.h>
#include <tread/scene/sections/material.h>

namespace tread
{
  enum class RailShape
  {
    head,
    full_section,
    block,
    slices,
    mesh
  };

  template <>
  const std::vector<Choice<RailShape>> &choices();

  /// Of the lengths in a mesh file.
  enum class LengthUnit
  {
    millimetre,
    metre
  };

  template <>
  const std::vector<Choice<LengthUnit>> &choices();

  enum class ProfileName
  {
    rail_54e1,
    rail_60e1,
    rail_49e1,
    rail_cn60
  };

  template <>
  const std::vector<Choice<ProfileName>> &choices();

  enum class RailInclination
  {
    none,
    one_in_forty,
    one_in_twenty
  };

  template <>
  const std::vector<Choice<RailInclination>> &choices();

  enum class EndKind
  {
    symmetric,
    absorbing,
    endless
  };

  template <>
  const std::vector<Choice<EndKind>> &choices();

  /// Section `Rail`. Lengths in m.
  struct RailSection
  {
    RailShape        shape       = RailShape::head;
    ProfileName      profile     = ProfileName::rail_54e1;
    RailInclination  inclination = RailInclination::none;
    std::string      measured_head;             ///< file; empty: a new rail
    ProfilePlacement head_placement;            ///< of that file
    std::string      slices;                    ///< file of a rail that changes along the way
    double           slices_place = 0.;         ///< along them at x = 0
    double      slices_y = 0.75, slices_z = 0.; ///< of their y = 0 and z = 0, from the middle of the track
    std::string mesh_file;                      ///< of a rail that the user has meshed
    LengthUnit  mesh_unit = LengthUnit::millimetre;
    std::string materials;                   ///< of volumes of that mesh that are not of the rail's own
    std::optional<double> begin;             ///< x of the first end; none: automatic
    double                length       = 0.; ///< 0: from margin to margin
    double                crown_radius = 0.3, block_width = 0.12, block_height = 0.06;
    double                margin           = 0.06; ///< beyond the path, at each end
    EndKind               ends             = EndKind::symmetric;
    double                absorbing_length = 0.6;
    unsigned int          spans_beyond     = 20; ///< behind each endless end
    MaterialSection       material;

    struct VolumeMaterial
    {
      std::string     volume; ///< its name in the mesh file
      ElasticMaterial material;
    };
    /// @throws InputError
    std::vector<VolumeMaterial> volume_materials() const;

    bool is_sliced() const
    {
      return shape == RailShape::slices;
    }
    bool is_meshed() const
    {
      return shape == RailShape::mesh;
    }
    bool is_block() const
    {
      return shape == RailShape::block;
    }
    /// Of a rail head or a full section.
    RailProfile standard_profile() const;
    /// The top leans to the gauge side, y < 0, by this, rad.
    double angle() const;
    /// A place of the scene in the rail's own axes, which are inclined with it (m).
    dealii::Point<3> in_own_axes(const dealii::Point<3> &p) const;
    /// Of a head, a full section or a block: half its width at the top, and its thickness there.
    double half_width() const;
    double thickness() const;
    /// From the base to the top, without a measured head or a defect.
    double height() const;

    void declare(ParameterTable &table);
    /// @throws InputError
    void check() const;
  };
} // namespace tread

#endif
