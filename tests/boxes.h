// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_boxes_h
#define tread_tests_boxes_h

#include <tread/mesh/body.h>
#include <tread/mesh/rail_body.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

namespace tread::tests
{
  /// Faces of a box at -x, +x, -y, +y, -z and +z.
  enum class Side
  {
    left,
    right,
    front,
    back,
    bottom,
    top
  };

  /// A box of n cells a direction; faces that are not named are free.
  inline Body make_box(const std::string                                      &name,
                       const dealii::Point<3>                                 &low,
                       const dealii::Point<3>                                 &high,
                       const std::array<unsigned int, 3>                      &n,
                       const std::initializer_list<std::pair<Side, Boundary>> &named = {})
  {
    std::array<Boundary, 6> boundaries;
    boundaries.fill(Boundary::free);
    for (const auto &[side, boundary] : named)
      boundaries[static_cast<unsigned int>(side)] = boundary;
    Body body;
    body.name = name;
    for (unsigned int k = 0; k <= n[2]; ++k)
      for (unsigned int j = 0; j <= n[1]; ++j)
        for (unsigned int i = 0; i <= n[0]; ++i)
          body.vertices.emplace_back(low[0] + (high[0] - low[0]) * i / n[0],
                                     low[1] + (high[1] - low[1]) * j / n[1],
                                     low[2] + (high[2] - low[2]) * k / n[2]);
    const auto number = [&](const unsigned int i, const unsigned int j, const unsigned int k) {
      return i + (n[0] + 1) * (j + (n[1] + 1) * k);
    };
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          {
            dealii::CellData<3> cell;
            for (unsigned int v = 0; v < 8; ++v)
              cell.vertices[v] = number(i + (v & 1), j + ((v >> 1) & 1), k + ((v >> 2) & 1));
            body.cells.push_back(cell);
          }
    body.wanted_cell_size = [](const dealii::Point<3> &) {
      return std::numeric_limits<double>::max();
    };
    body.boundary_at = [=](const dealii::Point<3> &p) {
      for (unsigned int d = 0; d < 3; ++d)
        {
          const double tolerance = 1e-9 * (high[d] - low[d]);
          if (p[d] < low[d] + tolerance)
            return boundaries[2 * d];
          if (p[d] > high[d] - tolerance)
            return boundaries[2 * d + 1];
        }
      return Boundary::free;
    };
    return body;
  }

  /// p turned by angle (rad) about the axis (unit length) through the origin (Rodrigues' formula).
  inline dealii::Point<3> turn(const dealii::Point<3> &p, const dealii::Point<3> &axis, const double angle)
  {
    const dealii::Tensor<1, 3> along = (axis * p) * axis;
    return dealii::Point<3>(along + std::cos(angle) * (p - along) +
                            std::sin(angle) * dealii::cross_product_3d(axis, p));
  }

  /// The same body turned about an axis through the origin, then shifted.
  inline Body turned(Body                        body,
                     const dealii::Point<3>     &axis,
                     const double                angle,
                     const dealii::Tensor<1, 3> &shift = {})
  {
    const auto before = body.to_space;
    body.to_space     = [=](const dealii::Point<3> &p) {
      return turn(before ? before(p) : p, axis, angle) + shift;
    };
    return body;
  }

  /// A cube-like block of half-width and height size, top z = 0 flat or (radius > 0) a paraboloid cap with
  /// that radius at the origin that fades towards the flat bottom; the fine zone is where the top touches.
  /// Bottom: support.
  inline Body make_indenter(const std::string &name,
                            const double       size,
                            const double       coarsest,
                            const double       radius,
                            const FineZone    &zone)
  {
    RailBlock block;
    block.x_begin            = -size;
    block.x_end              = size;
    block.width              = 2. * size;
    block.height             = size;
    block.coarsest_cell_size = coarsest;
    block.contact_half_width = size;
    Body body                = make_rail_block(block, zone);
    body.name                = name;
    body.to_space            = [=](const dealii::Point<3> &p) {
      const double sag = radius > 0. ? (p[0] * p[0] + p[1] * p[1]) / (2. * radius) : 0.;
      return dealii::Point<3>(p[0], p[1], p[2] - sag * (1. + p[2] / size));
    };
    return body;
  }

  /// Ask for cells of this edge length (m) around a point; the octree puts hanging nodes around them.
  inline void refine_near(Body                   &body,
                          const dealii::Point<3> &point,
                          const double            radius,
                          const double            cell_size)
  {
    body.wanted_cell_size = [=](const dealii::Point<3> &p) {
      return p.distance(point) < radius ? cell_size : std::numeric_limits<double>::max();
    };
  }

  /// A cube [0, edge]^3 of seven distorted hexahedra: an irregular inner one, six between it and the faces.
  inline Body make_patch_cube(const double edge)
  {
    static constexpr double shift[8][3] = {{-.04, .07, .02},  {.05, -.03, .06},  {.02, .03, -.05},
                                           {-.06, -.02, .01}, {.03, -.06, -.04}, {-.02, .05, .03},
                                           {.06, .01, -.02},  {.01, .04, .05}};
    Body                    body;
    body.name = "patch cube";
    for (unsigned int v = 0; v < 8; ++v)
      body.vertices.emplace_back(edge * (v & 1), edge * ((v >> 1) & 1), edge * ((v >> 2) & 1));
    for (unsigned int v = 0; v < 8; ++v)
      body.vertices.emplace_back(edge * (0.3 + 0.4 * (v & 1) + shift[v][0]),
                                 edge * (0.3 + 0.4 * ((v >> 1) & 1) + shift[v][1]),
                                 edge * (0.3 + 0.4 * ((v >> 2) & 1) + shift[v][2]));
    dealii::CellData<3> inner;
    for (unsigned int v = 0; v < 8; ++v)
      inner.vertices[v] = 8 + v;
    body.cells.push_back(inner);
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int side = 0; side < 2; ++side)
        {
          dealii::CellData<3> cell;
          for (unsigned int v = 0; v < 8; ++v)
            {
              const unsigned int on_face = side ? v | (1u << d) : v & ~(1u << d);
              cell.vertices[v]           = on_face + (((v >> d) & 1) == side ? 0 : 8);
            }
          body.cells.push_back(cell);
        }
    body.wanted_cell_size = [](const dealii::Point<3> &) {
      return std::numeric_limits<double>::max();
    };
    body.boundary_at = [](const dealii::Point<3> &) {
      return Boundary::free;
    };
    return body;
  }

  /// A ring about the y axis with n cells around, across the width and through the thickness;
  /// its inner face is the support.
  inline Body make_ring(const double                       outer_radius,
                        const double                       inner_radius,
                        const double                       width,
                        const std::array<unsigned int, 3> &n)
  {
    Body body;
    body.name = "ring";
    for (unsigned int k = 0; k <= n[2]; ++k)
      for (unsigned int j = 0; j <= n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          {
            const double angle  = 2. * dealii::numbers::PI * i / n[0];
            const double radius = outer_radius + (inner_radius - outer_radius) * k / n[2];
            body.vertices.emplace_back(radius * std::sin(angle), width * (double(j) / n[1] - 0.5),
                                       -radius * std::cos(angle));
          }
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          {
            dealii::CellData<3> cell;
            for (unsigned int v = 0; v < 8; ++v)
              cell.vertices[v] =
                (i + (v & 1)) % n[0] + n[0] * (j + ((v >> 1) & 1) + (n[1] + 1) * (k + ((v >> 2) & 1)));
            body.cells.push_back(cell);
          }
    body.wanted_cell_size = [](const dealii::Point<3> &) {
      return std::numeric_limits<double>::max();
    };
    const double middle = 0.5 * (inner_radius + outer_radius) - 0.49 * (outer_radius - inner_radius);
    body.boundary_at    = [=](const dealii::Point<3> &p) {
      return std::hypot(p[0], p[2]) < middle ? Boundary::support : Boundary::free;
    };
    return body;
  }
} // namespace tread::tests

#endif
