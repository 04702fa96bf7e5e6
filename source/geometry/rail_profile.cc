// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/rail_profile.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tread
{
  namespace
  {
    using Point = dealii::Point<2>;

    using std::numbers::pi;

    Point on_circle(const Point &center, const double radius, const double angle)
    {
      return {center[0] + radius * std::cos(angle), center[1] + radius * std::sin(angle)};
    }

    OutlinePiece line_piece(const Point &begin, const Point &end)
    {
      OutlinePiece piece;
      piece.begin = begin;
      piece.end   = end;
      return piece;
    }

    OutlinePiece arc_piece(const Point &center,
                           const double radius,
                           const double angle_begin,
                           const double angle_end)
    {
      OutlinePiece piece;
      piece.straight    = false;
      piece.center      = center;
      piece.radius      = radius;
      piece.angle_begin = angle_begin;
      piece.angle_end   = angle_end;
      piece.begin       = on_circle(center, radius, angle_begin);
      piece.end         = on_circle(center, radius, angle_end);
      return piece;
    }

    /// An unbounded curve that is walked along: a line, or a circle whose signed radius is positive when its
    /// centre is on the left of the walker.
    struct Curve
    {
      bool   straight;
      Point  place;     ///< a point of the line, or the centre
      Point  direction; ///< unit vector of the line
      double radius;    ///< signed

      static Curve line(const Point &from, const Point &to)
      {
        const double length = from.distance(to);
        return {true, from, Point((to[0] - from[0]) / length, (to[1] - from[1]) / length), 0.};
      }
      static Curve circle(const Point &center, const double signed_radius)
      {
        return {false, center, Point(), signed_radius};
      }

      /// The curve moved to its left.
      Curve offset(const double distance) const
      {
        Curve moved = *this;
        if (straight)
          moved.place += dealii::Tensor<1, 2>({-direction[1] * distance, direction[0] * distance});
        else
          moved.radius -= distance;
        return moved;
      }

      /// The curve's point next to p.
      Point foot(const Point &p) const
      {
        if (straight)
          return place + ((p - place) * direction) * dealii::Tensor<1, 2>(direction);
        const dealii::Tensor<1, 2> ray = p - place;
        return place + std::abs(radius) / ray.norm() * ray;
      }
    };

    /// The intersection next to `hint`; at most one of the curves is a circle.
    Point intersect(const Curve &a, const Curve &b, const Point &hint)
    {
      if (!a.straight)
        return intersect(b, a, hint);
      if (b.straight)
        {
          const dealii::Tensor<1, 2> d = b.place - a.place;
          const double cross           = a.direction[0] * b.direction[1] - a.direction[1] * b.direction[0];
          const double t               = (d[0] * b.direction[1] - d[1] * b.direction[0]) / cross;
          return a.place + t * dealii::Tensor<1, 2>(a.direction);
        }
      const Point  middle = a.foot(b.place);
      const double half   = std::sqrt(b.radius * b.radius - (middle - b.place).norm_square());
      const Point  p      = middle + half * dealii::Tensor<1, 2>(a.direction);
      const Point  q      = middle - half * dealii::Tensor<1, 2>(a.direction);
      return p.distance(hint) < q.distance(hint) ? p : q;
    }

    double angle_of(const Point &center, const Point &p)
    {
      return std::atan2(p[1] - center[1], p[0] - center[0]);
    }

    /// The arc on a circle from p to q, turning left (signed radius positive) or right by less than a turn.
    OutlinePiece arc_between(const Point &center, const double signed_radius, const Point &p, const Point &q)
    {
      const double begin = angle_of(center, p);
      double       turn  = std::remainder(angle_of(center, q) - begin, 2. * pi);
      if (turn * signed_radius < 0.)
        turn += std::copysign(2. * pi, signed_radius);
      return arc_piece(center, std::abs(signed_radius), begin, begin + turn);
    }

    /// Curves met one after another, each corner rounded.
    class Outline
    {
    public:
      Outline(const Point &begin, const Curve &first)
        : position(begin)
        , curve(first)
      {
      }

      /// Goes on along `next` after a rounding that turns left (positive radius) or right (negative).
      void turn(const Curve &next, const double radius, const Point &hint)
      {
        const Point center = intersect(curve.offset(radius), next.offset(radius), hint);
        const Point leave  = curve.foot(center);
        const Point arrive = next.foot(center);
        go_to(leave);
        pieces.push_back(arc_between(center, radius, leave, arrive));
        position = arrive;
        curve    = next;
      }

      /// Goes on along `next`, which the present curve touches at `joint`.
      void pass(const Curve &next, const Point &joint)
      {
        go_to(joint);
        curve = next;
      }

      void go_to(const Point &p)
      {
        if (position.distance(p) < 1e-12)
          return;
        pieces.push_back(curve.straight ? line_piece(position, p)
                                        : arc_between(curve.place, curve.radius, position, p));
        position = p;
      }

      std::vector<OutlinePiece> pieces;

    private:
      Point position;
      Curve curve;
    };

    /// The point at the arc length s of a chain.
    Point point_on_chain(const std::vector<OutlinePiece> &pieces, double s)
    {
      for (const OutlinePiece &piece : pieces)
        {
          if (s <= piece.length())
            return piece.point(s);
          s -= piece.length();
        }
      return pieces.back().end;
    }
  } // namespace

  double crown_height(const double y, const double radius)
  {
    if (std::isinf(radius))
      return 0.;
    return -y * y / (radius + std::sqrt(radius * radius - y * y));
  }

  double OutlinePiece::length() const
  {
    return straight ? begin.distance(end) : radius * std::abs(angle_end - angle_begin);
  }

  dealii::Point<2> OutlinePiece::point(const double s) const
  {
    const double share = s / length();
    if (straight)
      return begin + share * (end - begin);
    return on_circle(center, radius, angle_begin + share * (angle_end - angle_begin));
  }

  /// Dimensions in mm, heights above the foot's base, as in the drawings of EN 13674-1 (54E1, 60E1, 49E1) and
  /// TB/T 2344 (CN60). The heads are checked by their closure: the arcs of the drawing end on the flank at
  /// the nominal head width, within 1 um (CN60, by its drawing's tenths: within 7 um). Values of web and foot
  /// that are not published are fitted to the published area, centroid and second moments: met within 0.25 %
  /// by 54E1, 0.12 % by 60E1, whose R35 between R7 and the web is left out, and 0.1 % by 49E1 and CN60.
  struct RailProfile::Dimensions
  {
    const char *name;
    double      height;
    double      crown_radius, shoulder_radius, corner_radius;
    double      crown_half_width, shoulder_half_width; ///< where the arcs of the top meet
    double      flank_end_radius;                      ///< rounds the corner of flank and head underside
    double      underside_z;                           ///< height of the head's underside, extended to y = 0
    double      head_fillet;                           ///< between underside and web
    double      web_half;                              ///< half of the smallest web thickness
    double      web_radius;
    double      web_top, web_bottom; ///< between them the web is straight
    double      foot_fillet;         ///< between web and foot
    double      foot_z;              ///< height of the foot's inner slope, extended to y = 0
    double      slope_change_y;      ///< near which the inner slope meets the outer one
    double      slope_change_radius;
    double      foot_half_width;
    double      foot_edge_z; ///< of the outer slope at the foot's edge
    double      edge_upper_radius, edge_lower_radius;
    /// Run over rise: of the flank 1:20 (across over down), of the head's underside and the foot's inner
    /// slope 1:2.75, of its outer slope 1:14.
    double flank_slope = 20., underside_slope = 2.75, foot_inner_slope = 2.75, foot_outer_slope = 14.;
  };

  RailProfile::RailProfile(const Dimensions &d)
    : name_(d.name)
    , height_(1e-3 * d.height)
    , crown_radius_(1e-3 * d.crown_radius)
  {
    // in m, z from the rail top
    const auto at = [&](const double y, const double z) {
      return Point(1e-3 * y, 1e-3 * (z - d.height));
    };

    // Top: each arc's centre lies on the line from the end of the arc before to that arc's centre.
    const double crown = crown_radius_, shoulder = 1e-3 * d.shoulder_radius, corner = 1e-3 * d.corner_radius;
    const double flank_angle = std::atan(1. / d.flank_slope); // of the outward normal, above the horizontal
    const Point  crown_center(0., -crown);
    const double angle_1         = std::acos(1e-3 * d.crown_half_width / crown);
    const Point  shoulder_center = on_circle(crown_center, crown - shoulder, angle_1);
    const double angle_2         = std::acos((1e-3 * d.shoulder_half_width - shoulder_center[0]) / shoulder);
    const Point  corner_center   = on_circle(shoulder_center, shoulder - corner, angle_2);

    head_.push_back(arc_piece(crown_center, crown, 0.5 * pi, angle_1));
    head_.push_back(arc_piece(shoulder_center, shoulder, angle_1, angle_2));
    head_.push_back(arc_piece(corner_center, corner, angle_2, flank_angle));

    // Flank and underside meet at a corner that is rounded in the section, and sharp in the head cut off
    // there.
    const Point flank_begin = head_.back().end;
    const Point along_flank(flank_begin[0] + std::sin(flank_angle), flank_begin[1] - std::cos(flank_angle));
    const Curve flank     = Curve::line(flank_begin, along_flank);
    const Curve underside = Curve::line(
      at(d.foot_half_width, d.underside_z + d.foot_half_width / d.underside_slope), at(0., d.underside_z));
    const Point flank_end = intersect(flank, underside, flank_begin);
    head_.push_back(line_piece(flank_begin, flank_end));

    // Web: one circle, or a straight line between two.
    const bool  one_circle = d.web_top == d.web_bottom;
    const Curve web_upper  = Curve::circle(at(d.web_half + d.web_radius, d.web_top), 1e-3 * d.web_radius);
    const Curve web_lower  = Curve::circle(at(d.web_half + d.web_radius, d.web_bottom), 1e-3 * d.web_radius);
    const Curve web_straight = Curve::line(at(d.web_half, d.web_top), at(d.web_half, d.web_top - 1.));

    const Point slope_change = at(d.slope_change_y, d.foot_z - d.slope_change_y / d.foot_inner_slope);
    const Curve inner_slope  = Curve::line(at(0., d.foot_z), slope_change);
    const Curve outer_slope  = Curve::line(
       at(d.slope_change_y, d.foot_edge_z + (d.foot_half_width - d.slope_change_y) / d.foot_outer_slope),
       at(d.foot_half_width, d.foot_edge_z));
    const Curve edge = Curve::line(at(d.foot_half_width, d.foot_edge_z), at(d.foot_half_width, 0.));
    const Curve base = Curve::line(at(d.foot_half_width, 0.), at(0., 0.));

    // Clockwise: the section on the right, so outer corners turn right and inner ones left.
    outline_.assign(head_.begin(), head_.begin() + 3);
    Outline outline(flank_begin, flank);

    double before_flank = 0.;
    for (const OutlinePiece &piece : outline_)
      before_flank += piece.length();
    const auto length_to_last = [&](const double share_of_last) {
      double length = before_flank;
      for (const OutlinePiece &piece : outline.pieces)
        length += piece.length();
      return length - (1. - share_of_last) * outline.pieces.back().length();
    };

    outline.turn(underside, -1e-3 * d.flank_end_radius, flank_end);
    corners_.head = length_to_last(0.5);
    outline.turn(web_upper, 1e-3 * d.head_fillet, at(d.web_half, d.underside_z));
    corners_.head_fillet = length_to_last(0.5);
    if (!one_circle)
      {
        outline.pass(web_straight, at(d.web_half, d.web_top));
        outline.pass(web_lower, at(d.web_half, d.web_bottom));
      }
    outline.turn(inner_slope, 1e-3 * d.foot_fillet, at(d.web_half, d.foot_z));
    corners_.foot_fillet = length_to_last(0.5);
    outline.turn(outer_slope, 1e-3 * d.slope_change_radius, slope_change);
    outline.turn(edge, -1e-3 * d.edge_upper_radius, at(d.foot_half_width, d.foot_edge_z));
    corners_.foot_top = length_to_last(0.5);
    outline.turn(base, -1e-3 * d.edge_lower_radius, at(d.foot_half_width, 0.));
    corners_.foot_edge = length_to_last(0.);
    outline.go_to(at(0., 0.));
    outline_.insert(outline_.end(), outline.pieces.begin(), outline.pieces.end());
  }

  RailProfile RailProfile::rail_54e1()
  {
    Dimensions d{};
    d.name                = "54E1";
    d.height              = 159.;
    d.crown_radius        = 300.;
    d.shoulder_radius     = 80.;
    d.corner_radius       = 13.;
    d.crown_half_width    = 10.012;
    d.shoulder_half_width = 24.8635;
    d.flank_end_radius    = 3.;
    d.underside_z         = 109.6;
    d.head_fillet         = 10.; // fitted
    d.web_half            = 8.;
    d.web_radius          = 508.;
    d.web_top             = 69.9;
    d.web_bottom          = 69.9;
    d.foot_fillet         = 16.;
    d.foot_z              = 30.2;
    d.slope_change_y      = 46.88;
    d.slope_change_radius = 40.;
    d.foot_half_width     = 70.;
    d.foot_edge_z         = 11.35; // fitted
    d.edge_upper_radius   = 4.;
    d.edge_lower_radius   = 2.;
    return RailProfile(d);
  }

  RailProfile RailProfile::rail_60e1()
  {
    Dimensions d{};
    d.name                = "60E1";
    d.height              = 172.;
    d.crown_radius        = 300.;
    d.shoulder_radius     = 80.;
    d.corner_radius       = 13.;
    d.crown_half_width    = 10.228;
    d.shoulder_half_width = 26.026;
    d.flank_end_radius    = 3.;
    d.underside_z         = 121.;
    d.head_fillet         = 7.;
    d.web_half            = 8.25;
    d.web_radius          = 120.;
    d.web_top             = 91.5;
    d.web_bottom          = 59.6;
    d.foot_fillet         = 7.;
    d.foot_z              = 31.5;
    d.slope_change_y      = 50.1;
    d.slope_change_radius = 40.;
    d.foot_half_width     = 75.;
    d.foot_edge_z         = 11.5;
    d.edge_upper_radius   = 4.;
    d.edge_lower_radius   = 2.;
    return RailProfile(d);
  }

  RailProfile RailProfile::rail_49e1()
  {
    Dimensions d{};
    d.name                = "49E1";
    d.height              = 149.;
    d.crown_radius        = 300.;
    d.shoulder_radius     = 80.;
    d.corner_radius       = 13.;
    d.crown_half_width    = 7.6335;
    d.shoulder_half_width = 23.4175;
    d.flank_slope         = 17.2;
    d.flank_end_radius    = 3.;
    d.underside_z         = 97.5;
    d.underside_slope     = 3.;
    d.head_fillet         = 6.66; // fitted
    d.web_half            = 7.;
    d.web_radius          = 628.; // fitted
    d.web_top             = 75.;
    d.web_bottom          = 75.;
    d.foot_fillet         = 8.5; // fitted
    d.foot_z              = 27.5;
    d.foot_inner_slope    = 3.;
    d.slope_change_y      = 40.;
    d.slope_change_radius = 40.;
    d.foot_half_width     = 62.5;
    d.foot_edge_z         = 11.08; // fitted
    d.edge_upper_radius   = 4.;
    d.edge_lower_radius   = 2.;
    return RailProfile(d);
  }

  RailProfile RailProfile::rail_cn60()
  {
    Dimensions d{};
    d.name                = "CN60";
    d.height              = 176.;
    d.crown_radius        = 300.;
    d.shoulder_radius     = 80.;
    d.corner_radius       = 13.;
    d.crown_half_width    = 10.;
    d.shoulder_half_width = 25.343;
    d.flank_end_radius    = 2.;
    d.underside_z         = 127.5;
    d.underside_slope     = 3.;
    d.head_fillet         = 12.93; // fitted
    d.web_half            = 8.25;
    d.web_radius          = 400.;
    d.web_top             = 79.49; // fitted
    d.web_bottom          = 79.49;
    d.foot_fillet         = 20.;
    d.foot_z              = 30.5;
    d.foot_inner_slope    = 3.;
    d.foot_outer_slope    = 9.;
    d.slope_change_y      = 45.;
    d.slope_change_radius = 40.;
    d.foot_half_width     = 75.;
    d.foot_edge_z         = 12.;
    d.edge_upper_radius   = 4.;
    d.edge_lower_radius   = 2.;
    return RailProfile(d);
  }

  const std::string &RailProfile::name() const
  {
    return name_;
  }

  double RailProfile::height() const
  {
    return height_;
  }

  double RailProfile::crown_radius() const
  {
    return crown_radius_;
  }

  double RailProfile::z_top(const double y) const
  {
    const double distance = std::abs(y);
    if (distance <= head_[0].end[0])
      return crown_height(distance, crown_radius_);
    for (unsigned int i = 1; i < 3; ++i)
      if (distance <= head_[i].end[0])
        {
          const double a = distance - head_[i].center[0];
          return head_[i].center[1] + std::sqrt(head_[i].radius * head_[i].radius - a * a);
        }
    const OutlinePiece &flank = head_[3];
    if (distance > flank.end[0] + 1e-12)
      throw std::domain_error("z_top: beside the rail head");
    return flank.begin[1] +
           (distance - flank.begin[0]) / (flank.end[0] - flank.begin[0]) * (flank.end[1] - flank.begin[1]);
  }

  dealii::Point<2> RailProfile::head_point(const double s) const
  {
    // The crown in a form without cancellation, so that its top is smooth to round-off.
    const double distance = std::abs(s);
    Point        p;
    if (distance <= head_[0].length())
      {
        const double half_angle = 0.5 * distance / crown_radius_;
        p[0]                    = crown_radius_ * std::sin(2. * half_angle);
        p[1]                    = -2. * crown_radius_ * std::sin(half_angle) * std::sin(half_angle);
      }
    else
      p = point_on_chain(head_, distance);
    p[0] = std::copysign(p[0], s);
    return p;
  }

  double RailProfile::head_length() const
  {
    double length = 0.;
    for (const OutlinePiece &piece : head_)
      length += piece.length();
    return length;
  }

  double RailProfile::shoulder_length() const
  {
    return head_[0].length() + head_[1].length() + 0.5 * head_[2].length();
  }

  double RailProfile::head_depth() const
  {
    return -head_.back().end[1];
  }

  double RailProfile::head_half_width() const
  {
    return head_.back().end[0];
  }

  const std::vector<OutlinePiece> &RailProfile::half_outline() const
  {
    return outline_;
  }

  dealii::Point<2> RailProfile::outline_point(const double s) const
  {
    return point_on_chain(outline_, s);
  }

  const RailProfile::Corners &RailProfile::corners() const
  {
    return corners_;
  }

  SectionProperties RailProfile::section() const
  {
    // Line integrals around the right half (Green's theorem), with z above the base; three Gauss points a
    // stretch, which integrate straight lines exactly (degree 4) and arcs of 0.01 rad to round-off.
    static const double abscissa[3] = {-std::sqrt(0.6), 0., std::sqrt(0.6)};
    static const double weight[3]   = {5. / 9., 8. / 9., 5. / 9.};

    double area = 0., moment = 0., inertia_y = 0., inertia_z = 0.;
    for (const OutlinePiece &piece : outline_)
      {
        const double       turn = piece.straight ? 0. : piece.angle_end - piece.angle_begin;
        const unsigned int n    = 1 + static_cast<unsigned int>(std::abs(turn) / 0.01);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int q = 0; q < 3; ++q)
            {
              const double share = (i + 0.5 + 0.5 * abscissa[q]) / n;
              const Point  p     = piece.point(share * piece.length());
              // derivatives by the share
              double dy, dz;
              if (piece.straight)
                {
                  dy = piece.end[0] - piece.begin[0];
                  dz = piece.end[1] - piece.begin[1];
                }
              else
                {
                  const double angle = piece.angle_begin + share * turn;
                  dy                 = -piece.radius * turn * std::sin(angle);
                  dz                 = piece.radius * turn * std::cos(angle);
                }
              const double y = p[0], z = p[1] + height_, w = 0.5 * weight[q] / n;
              // clockwise, hence area = integral of z dy, or of -y dz
              area += w * z * dy;
              moment += w * 0.5 * z * z * dy;
              inertia_y += w * z * z * z / 3. * dy;
              inertia_z -= w * y * y * y / 3. * dz;
            }
      }
    // both halves
    SectionProperties section;
    section.area            = 2. * area;
    section.centroid_height = moment / area;
    section.inertia_y       = 2. * (inertia_y - moment * moment / area);
    section.inertia_z       = 2. * inertia_z;
    return section;
  }
} // namespace tread
