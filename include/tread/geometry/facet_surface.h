// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_facet_surface_h
#define tread_geometry_facet_surface_h

#include <deal.II/base/point.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tread
{
  /// A smooth running surface z(x, y) through the vertices of quadrilaterals, which may lie in any way and
  /// in several pieces that do not hang together, such as two rails at a joint. Lengths in m.
  ///
  /// Around each vertex a polynomial of the fourth degree, or of a lower one where the piece has few
  /// vertices, is fitted to the vertices nearby by least squares; it passes through its own vertex. Within a
  /// face the polynomials of its four corners are blended by quintic steps along its two directions. On faces
  /// that are rectangles in plan the surface has continuous curvature; on others its slope is continuous but
  /// for what neighbouring polynomials differ by, which is of the order of the error of the fit.
  class FacetSurface
  {
  public:
    using Point         = dealii::Point<3>;
    using Quadrilateral = std::array<unsigned int, 4>;

    /// @param faces counter-clockwise seen from above
    /// @throws InputError where the faces are no graph over x and y: too steep, or above each other
    FacetSurface(const std::vector<Point> &vertices, const std::vector<Quadrilateral> &faces);

    /// The smooth surface; nothing beside the faces.
    std::optional<double> height(const double x, const double y) const;

    /// Of the place on the faces that is nearest in plan: the facet's height, and by how much the smooth
    /// surface is above it.
    struct Facet
    {
      double z, smooth_above;
    };
    Facet facet(const double x, const double y) const;

    /// Range of y over which the surface is there without a break around y_middle, at x; begin = end where it
    /// is not there.
    struct Range
    {
      double begin, end;
    };
    Range across(const double x, const double y_middle) const;
    Range along() const
    {
      return {x_begin, x_end};
    }
    Range lateral() const
    {
      return {y_begin, y_end};
    }

    /// Number of pieces that do not hang together.
    unsigned int n_pieces() const
    {
      return pieces;
    }
    std::size_t n_faces() const
    {
      return corners.size();
    }
    /// Mean length of the faces' edges, and the longest.
    double mean_edge() const
    {
      return edge;
    }

    /// "864 faces in 2 pieces, with edges of 7.5 mm in the mean"
    std::string in_words() const;

  private:
    /// Powers of x and y over a scale about a vertex, up to the fourth degree, without the constant.
    static constexpr unsigned int n_powers = 14;
    struct Polynomial
    {
      Point                        middle;
      double                       scale = 1.;
      std::array<double, n_powers> coefficient{};

      double at(const double x, const double y) const;
    };
    static std::array<double, n_powers> powers(const double u, const double w);

    /// A place in a face, by its bilinear coordinates.
    struct Place
    {
      std::size_t face;
      double      s, t;
    };
    void check_graph() const;
    void list_neighbours();
    /// A vertex and those around it, it first.
    std::vector<unsigned int> around(const unsigned int vertex, const unsigned int rings) const;
    /// Through the first of these vertices, near the others; none where they are too few, or do not tell all
    /// terms.
    std::optional<Polynomial> fitted_to(const std::vector<unsigned int> &near,
                                        const unsigned int               n_terms) const;
    Polynomial                fit(const unsigned int vertex) const;
    Place                     place_in(const std::size_t face, const double x, const double y) const;
    std::optional<Place>      place(const double x, const double y, const bool nearest) const;
    double                    smooth(const Place &place) const;
    Point                     bilinear(const Place &place) const;
    std::size_t               bin(const double x, const double y) const;

    std::vector<Point>                     points;     ///< those of faces alone
    std::vector<Quadrilateral>             corners;    ///< of faces, numbers of points
    std::vector<std::vector<unsigned int>> neighbours; ///< points of the faces around a point
    std::vector<Polynomial>                fitted;     ///< by point
    unsigned int                           pieces = 0;
    double                                 x_begin, x_end, y_begin, y_end, edge;

    /// Faces by where they lie in plan; where there are none, those of the nearest bin that has some.
    std::vector<std::vector<std::size_t>> bins;
    std::size_t                           n_x, n_y;
  };
} // namespace tread

#endif
