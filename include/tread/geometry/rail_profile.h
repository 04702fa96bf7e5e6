// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_rail_profile_h
#define tread_geometry_rail_profile_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace tread
{
  /// Height of a circular crown of the given radius over its top: z = sqrt(radius^2 - y^2) - radius, without
  /// cancellation; 0 for an infinite radius (m).
  double crown_height(double y, double radius);

  /// A piece of an outline in the (y, z) plane: a straight line or a circular arc. Lengths in m, angles in
  /// rad.
  struct OutlinePiece
  {
    dealii::Point<2> begin;
    dealii::Point<2> end;
    bool             straight = true;
    dealii::Point<2> center;           ///< of an arc
    double           radius      = 0.; ///< of an arc
    double           angle_begin = 0.; ///< of an arc: point = center + radius (cos, sin)
    double           angle_end   = 0.;

    double length() const; ///< (m)

    /// The point at the arc length s from the beginning, 0 <= s <= length().
    dealii::Point<2> point(double s) const;
  };

  /// Properties of a section about its horizontal (y) and vertical (z) centroidal axes.
  struct SectionProperties
  {
    double area;            ///< (m^2)
    double centroid_height; ///< above the foot's base (m)
    double inertia_y;       ///< second moment about the horizontal axis: vertical bending (m^4)
    double inertia_z;       ///< second moment about the vertical axis: lateral bending (m^4)
  };

  /// The section of a flat-bottom rail, made of lines and arcs that meet tangentially. y is
  /// lateral, z up and zero on the rail top. Only the right half (y >= 0) is stored.
  class RailProfile
  {
  public:
    static RailProfile rail_54e1(); ///< 54 kg/m
    static RailProfile rail_60e1(); ///< 60 kg/m
    static RailProfile rail_49e1(); ///< 49 kg/m, the S49 of before
    static RailProfile rail_cn60(); ///< 60 kg/m, of TB/T 2344 (CHN60)

    const std::string &name() const;
    double             height() const; ///< foot base to rail top (m)

    /// Height of the running surface (m, negative below the top), for |y| <= head_half_width(): the crown
    /// arcs, the gauge corner and the flank, exactly.
    double z_top(double y) const;

    /// Radius of the crown's middle arc (m).
    double crown_radius() const;

    /// The head's outline at the arc length |s| from the rail top, down to the lower end of the flank;
    /// negative s is the left half: y(-s) = -y(s). |s| <= head_length().
    dealii::Point<2> head_point(double s) const;

    double head_length() const; ///< arc length from the rail top to the lower end of the flank (m)
    double shoulder_length()
      const;                   ///< arc length from the rail top to the middle of the gauge corner arc (m)
    double head_depth() const; ///< lower end of the flank below the rail top, without the rounding there (m)
    double head_half_width() const; ///< y at the lower end of the flank, without the rounding there (m)

    /// The right half of the whole section from the rail top clockwise to the middle of the base.
    const std::vector<OutlinePiece> &half_outline() const;

    /// The point of half_outline() at the arc length s from the rail top (m).
    dealii::Point<2> outline_point(double s) const;

    /// Where a mesh of the section has its corners: arc lengths along half_outline() (m).
    struct Corners
    {
      double head;        ///< middle of the rounding of flank and underside
      double head_fillet; ///< middle of the fillet of underside and web
      double foot_fillet; ///< middle of the fillet of web and foot
      double foot_top;    ///< middle of the upper rounding of the foot's edge
      double foot_edge;   ///< where its vertical edge ends in the lower rounding
    };
    const Corners &corners() const;

    SectionProperties section() const;

  private:
    struct Dimensions;

    explicit RailProfile(const Dimensions &dimensions);

    std::string               name_;
    double                    height_       = 0.;
    double                    crown_radius_ = 0.;
    std::vector<OutlinePiece> head_;    ///< crown, shoulder, gauge corner, flank to its full length
    std::vector<OutlinePiece> outline_; ///< of the right half, with roundings
    Corners                   corners_;
  };
} // namespace tread

#endif
