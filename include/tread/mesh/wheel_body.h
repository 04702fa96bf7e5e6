// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_wheel_body_h
#define tread_mesh_wheel_body_h

#include <tread/mesh/body.h>
#include <tread/mesh/fine_zone.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <limits>

namespace tread
{
  /// A piece of a ring, or a whole one, that rolls with its outer face on the rail. The reference
  /// configuration is the start of the run: axis through (center_x, 0, radius + lift) along y, lowest point
  /// of the running circle at z = lift.
  struct WheelSector
  {
    double center_x  = 0.;   ///< wheel centre: minus the distance to be rolled to the solution instant (m)
    double lift      = 0.;   ///< of the axle over its height `radius`, where the wheel just touches (m)
    double radius    = 0.46; ///< running radius at y = 0 (m)
    double thickness = 0.06; ///< radial (m)
    double width     = 0.12; ///< lateral (m)
    double arc_begin = -0.1; ///< arc length along the tread from the lowest point, positive towards +x (m)
    double arc_end   = 0.1;  ///< (m)
    double coarsest_cell_size = 0.025; ///< upper bound of the coarse cells' edge (m)
    double contact_half_width = std::numeric_limits<double>::infinity(); ///< tread faces with |y| up to this
                                                                         ///< are in reach of the rail (m)
    bool between_planes = false; ///< whether its sides lie on planes of symmetry

    /// Radius of the tread at y minus running radius (m); zero at y = 0; null: a cylinder. The shift fades
    /// linearly to zero at the inner face.
    std::function<double(double)> tread_offset;
    /// The same of a wheel that is not round, over the angle from the lowest point, positive towards +x, and
    /// y. Mass properties leave it out: a flat is some grammes.
    std::function<double(double, double)> deviation;

    /// Whether the arc is a whole turn, so that the piece has no ends.
    bool is_closed() const;
  };

  /// A whole wheel of revolution: rim, straight web and hub, all symmetric to y = 0. Lengths in m.
  struct FullWheel
  {
    double center_x           = 0.;   ///< as in WheelSector
    double lift               = 0.;   ///< as in WheelSector
    double radius             = 0.46; ///< running radius at y = 0
    double rim_inner_radius   = 0.395;
    double rim_width          = 0.135;
    double web_thickness      = 0.028;
    double hub_outer_radius   = 0.14;
    double hub_length         = 0.18;
    double bore_radius        = 0.0925;
    double coarsest_cell_size = 0.041; ///< upper bound of the coarse cells' edge on the tread
    double contact_half_width =
      std::numeric_limits<double>::infinity(); ///< tread faces with |y| up to this are in reach of the rail
    double contact_margin =
      0.02; ///< tread faces up to this far beyond the ends of the fine zone are in reach of the rail

    /// As in WheelSector, fading to zero at the inner radius of the rim.
    std::function<double(double)>         tread_offset;
    std::function<double(double, double)> deviation;
  };

  /// Sector as coarse cells whose arc on the running circle is 2^k finest_cell_size. Chart: the reference
  /// position of the cylinder; new vertices by a CylindricalManifold about the wheel's axis. Inner face:
  /// support, cut faces: end.
  Body make_wheel_sector(const WheelSector &sector, const FineZone &zone);

  /// The whole wheel; a whole number of coarse cells around, so that the circumferential size differs from
  /// finest_cell_size by less than 1 %. Bore: support; tread in reach: contact.
  Body make_full_wheel(const FullWheel &wheel, const FineZone &zone);

  /// Mass properties of the exact (unmeshed) shape about the wheel's axis.
  struct WheelInertia
  {
    double mass          = 0.; ///< (kg)
    double axial_inertia = 0.; ///< about the axis (kg m^2)
    dealii::Tensor<1, 3>
      first_moment; ///< integral of density times position relative to the wheel centre (kg m)
  };

  /// density in kg/m^3.
  WheelInertia wheel_inertia(const WheelSector &sector, double density);
  WheelInertia wheel_inertia(const FullWheel &wheel, double density);
} // namespace tread

#endif
