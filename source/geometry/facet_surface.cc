// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/geometry/facet_surface.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace tread
{
  namespace
  {
    /// Faces may stand this steep: cosine of the angle to the plane, 70 degrees.
    constexpr double least_cosine = 0.34;

    /// A place counts as within a face up to this beyond its sides, of a side.
    constexpr double least_beyond_side = 1e-7;

    /// Rings of vertices around one that are fitted together: two, and more where these do not tell all
    /// powers of a degree, as beside an edge.
    constexpr unsigned int least_rings = 2, most_rings = 4;

    /// Singular values below this share of the largest leave powers of a degree open.
    constexpr double least_share = 1e-4;

    /// Bilinear coordinates of places that are further from a face are not looked for.
    constexpr double far_before = -3., far_behind = 4.;

    /// From 0 to 1 with two derivatives that vanish at both ends.
    double quintic_step(const double t)
    {
      return t * t * t * (10. + t * (6. * t - 15.));
    }

    std::string place_in_words(const dealii::Point<3> &p)
    {
      return text_in_mm(p[0]) + ", " + text_in_mm(p[1]) + ", " + text_in_mm(p[2]) + " mm";
    }
  } // namespace


  std::array<double, FacetSurface::n_powers> FacetSurface::powers(const double u, const double w)
  {
    const double u2 = u * u, w2 = w * w;
    return {{u, w, u2, u * w, w2, u2 * u, u2 * w, u * w2, w2 * w, u2 * u2, u2 * u * w, u2 * w2, u * w2 * w,
             w2 * w2}};
  }


  double FacetSurface::Polynomial::at(const double x, const double y) const
  {
    const auto power = powers((x - middle[0]) / scale, (y - middle[1]) / scale);
    return std::inner_product(power.begin(), power.end(), coefficient.begin(), middle[2]);
  }


  FacetSurface::FacetSurface(const std::vector<Point> &vertices, const std::vector<Quadrilateral> &faces)
  {
    require(!faces.empty(), "the contact surface has no faces");
    std::map<unsigned int, unsigned int> number_of;
    double                               sum = 0.;
    for (const Quadrilateral &face : faces)
      {
        corners.emplace_back();
        for (unsigned int v = 0; v < 4; ++v)
          {
            const auto [at, is_new] = number_of.try_emplace(face[v], points.size());
            if (is_new)
              points.push_back(vertices[face[v]]);
            corners.back()[v] = at->second;
            sum += vertices[face[v]].distance(vertices[face[(v + 1) % 4]]);
          }
      }
    edge                       = sum / (4. * faces.size());
    const auto [low_x, high_x] = std::minmax_element(
      points.begin(), points.end(), [](const Point &a, const Point &b) { return a[0] < b[0]; });
    const auto [low_y, high_y] = std::minmax_element(
      points.begin(), points.end(), [](const Point &a, const Point &b) { return a[1] < b[1]; });
    x_begin = (*low_x)[0];
    x_end   = (*high_x)[0];
    y_begin = (*low_y)[1];
    y_end   = (*high_y)[1];

    constexpr double most = 1000.; // bins in a direction
    n_x                   = std::clamp((x_end - x_begin) / edge, 1., most);
    n_y                   = std::clamp((y_end - y_begin) / edge, 1., most);
    bins.resize(n_x * n_y);
    for (std::size_t f = 0; f < corners.size(); ++f)
      {
        double low[2] = {x_end, y_end}, high[2] = {x_begin, y_begin};
        for (const unsigned int v : corners[f])
          for (unsigned int d = 0; d < 2; ++d)
            {
              low[d]  = std::min(low[d], points[v][d]);
              high[d] = std::max(high[d], points[v][d]);
            }
        const double beyond = least_beyond_side * edge;
        const auto   first  = bin(low[0] - beyond, low[1] - beyond),
                   last     = bin(high[0] + beyond, high[1] + beyond);
        for (std::size_t j = first / n_x; j <= last / n_x; ++j)
          for (std::size_t i = first % n_x; i <= last % n_x; ++i)
            bins[i + n_x * j].push_back(f);
      }
    check_graph();

    // Empty bins have the faces of those around them, one ring after the other.
    for (bool any = true; any;)
      {
        any               = false;
        const auto before = bins;
        for (std::size_t j = 0; j < n_y; ++j)
          for (std::size_t i = 0; i < n_x; ++i)
            if (before[i + n_x * j].empty())
              for (std::size_t m = j > 0 ? j - 1 : 0; m <= std::min(j + 1, n_y - 1); ++m)
                for (std::size_t k = i > 0 ? i - 1 : 0; k <= std::min(i + 1, n_x - 1); ++k)
                  {
                    const auto &other = before[k + n_x * m];
                    bins[i + n_x * j].insert(bins[i + n_x * j].end(), other.begin(), other.end());
                    any = any || !other.empty();
                  }
        for (std::vector<std::size_t> &faces : bins) // those of several neighbours once
          {
            std::sort(faces.begin(), faces.end());
            faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
          }
      }

    list_neighbours();
    for (unsigned int v = 0; v < points.size(); ++v)
      fitted.push_back(fit(v));
  }


  std::size_t FacetSurface::bin(const double x, const double y) const
  {
    const auto place = [](const double at, const double begin, const double end, const std::size_t n) {
      return end > begin ? static_cast<std::size_t>(std::clamp((at - begin) / (end - begin) * n, 0., n - 0.5))
                         : 0;
    };
    return place(x, x_begin, x_end, n_x) + n_x * place(y, y_begin, y_end, n_y);
  }


  void FacetSurface::check_graph() const
  {
    for (const Quadrilateral &face : corners)
      {
        const auto normal =
          dealii::cross_product_3d(points[face[2]] - points[face[0]], points[face[3]] - points[face[1]]);
        require(normal[2] >= least_cosine * normal.norm(),
                "the contact surface is " +
                  std::string(normal[2] > 0. ? "steeper than 70 degrees" : "vertical, or looks down,") +
                  " at " + place_in_words(points[face[0]]) +
                  ": name as 'contact' what the wheel may roll on, with z upwards");
      }
    // Some places of each face lie within no other one.
    constexpr double within = 0.01, places[] = {0.21, 0.5, 0.83}; // of a side
    for (std::size_t f = 0; f < corners.size(); ++f)
      for (const double s : places)
        for (const double t : places)
          {
            const Point at = bilinear({f, s, t});
            for (const std::size_t other : bins[bin(at[0], at[1])])
              if (other != f)
                {
                  const Place place = place_in(other, at[0], at[1]);
                  require(!(std::min(place.s, place.t) > within && std::max(place.s, place.t) < 1. - within),
                          "the contact surface has one face above another at " + place_in_words(at) +
                            ": name as 'contact' what the wheel may roll on, once over each x and y");
                }
          }
  }


  void FacetSurface::list_neighbours()
  {
    std::vector<std::set<unsigned int>> sets(points.size());
    for (const Quadrilateral &face : corners)
      for (const unsigned int a : face)
        for (const unsigned int b : face)
          if (a != b)
            sets[a].insert(b);
    for (const auto &set : sets)
      neighbours.emplace_back(set.begin(), set.end());
    std::vector<bool> is_met(points.size(), false);
    for (unsigned int start = 0; start < points.size(); ++start)
      {
        if (is_met[start])
          continue;
        ++pieces;
        std::vector<unsigned int> to_visit{start};
        is_met[start] = true;
        while (!to_visit.empty())
          {
            const unsigned int now = to_visit.back();
            to_visit.pop_back();
            for (const unsigned int next : neighbours[now])
              if (!is_met[next])
                {
                  is_met[next] = true;
                  to_visit.push_back(next);
                }
          }
      }
  }


  std::vector<unsigned int> FacetSurface::around(const unsigned int vertex, const unsigned int rings) const
  {
    std::vector<unsigned int> near{vertex};
    std::set<unsigned int>    is_near{vertex};
    for (unsigned int ring = 0, begin = 0; ring < rings; ++ring)
      for (const unsigned int end = near.size(); begin < end; ++begin)
        for (const unsigned int next : neighbours[near[begin]])
          if (is_near.insert(next).second)
            near.push_back(next);
    return near;
  }


  std::optional<FacetSurface::Polynomial> FacetSurface::fitted_to(const std::vector<unsigned int> &near,
                                                                  const unsigned int n_terms) const
  {
    if (near.size() <= n_terms + n_terms / 2)
      return std::nullopt;
    Polynomial                       polynomial{points[near.front()], edge, {}};
    dealii::LAPACKFullMatrix<double> matrix(near.size() - 1, n_terms);
    dealii::Vector<double>           heights(near.size() - 1), answer(n_terms);
    for (std::size_t i = 1; i < near.size(); ++i)
      {
        const auto   offset = points[near[i]] - polynomial.middle;
        const double u = offset[0] / edge, w = offset[1] / edge, far = 1. + u * u + w * w,
                     weight = 1. / (far * far);
        const auto power    = powers(u, w);
        for (unsigned int k = 0; k < n_terms; ++k)
          matrix(i - 1, k) = weight * power[k];
        heights[i - 1] = weight * offset[2];
      }
    matrix.compute_svd();
    if (!(matrix.singular_value(n_terms - 1) > least_share * matrix.singular_value(0)))
      return std::nullopt;
    matrix.compute_inverse_svd();
    matrix.vmult(answer, heights);
    std::copy(answer.begin(), answer.end(), polynomial.coefficient.begin());
    return polynomial;
  }


  FacetSurface::Polynomial FacetSurface::fit(const unsigned int vertex) const
  {
    constexpr unsigned int terms_of_degree[] = {14, 9, 5, 2}; // 4 to 1
    for (const unsigned int n_terms : terms_of_degree)
      for (unsigned int rings = least_rings; rings <= most_rings; ++rings)
        if (const auto polynomial = fitted_to(around(vertex, rings), n_terms))
          return *polynomial;
    return {points[vertex], edge, {}};
  }


  FacetSurface::Place FacetSurface::place_in(const std::size_t face, const double x, const double y) const
  {
    // The bilinear map from the unit square, by Newton's method: exact at once where the face is a
    // parallelogram in plan.
    const Quadrilateral &c = corners[face];
    const Point         &p = points[c[0]];
    const auto           a = points[c[1]] - p, b = points[c[3]] - p, twist = points[c[2]] - points[c[1]] - b;
    Place                place{face, 0.5, 0.5};
    for (unsigned int i = 0; i < 20; ++i)
      {
        const double off[2]  = {p[0] + place.s * a[0] + place.t * b[0] + place.s * place.t * twist[0] - x,
                                p[1] + place.s * a[1] + place.t * b[1] + place.s * place.t * twist[1] - y};
        const double by_s[2] = {a[0] + place.t * twist[0], a[1] + place.t * twist[1]},
                     by_t[2] = {b[0] + place.s * twist[0], b[1] + place.s * twist[1]},
                     area    = by_s[0] * by_t[1] - by_s[1] * by_t[0];
        if (area == 0.) // where the map folds back
          break;
        const double step_s = (off[0] * by_t[1] - off[1] * by_t[0]) / area,
                     step_t = (by_s[0] * off[1] - by_s[1] * off[0]) / area;
        place.s -= step_s;
        place.t -= step_t;
        if (!(std::abs(step_s) + std::abs(step_t) > 1e-13))
          return place;
        // Far outside the map folds back.
        place.s = std::clamp(place.s, far_before, far_behind);
        place.t = std::clamp(place.t, far_before, far_behind);
      }
    return {face, far_before, far_before};
  }


  std::optional<FacetSurface::Place> FacetSurface::place(const double x,
                                                         const double y,
                                                         const bool   nearest) const
  {
    const auto beyond = [](const Place &at) {
      return std::max({-at.s, at.s - 1., -at.t, at.t - 1., 0.});
    };
    std::optional<Place> best;
    for (const std::size_t face : bins[bin(x, y)])
      if (const Place now = place_in(face, x, y); !best || beyond(now) < beyond(*best))
        best = now;
    if (!best || (!nearest && !(beyond(*best) <= least_beyond_side)))
      return std::nullopt;
    best->s = std::clamp(best->s, 0., 1.);
    best->t = std::clamp(best->t, 0., 1.);
    return best;
  }


  FacetSurface::Point FacetSurface::bilinear(const Place &at) const
  {
    const Quadrilateral &c = corners[at.face];
    return (1. - at.t) * ((1. - at.s) * points[c[0]] + at.s * dealii::Tensor<1, 3>(points[c[1]])) +
           at.t *
             ((1. - at.s) * dealii::Tensor<1, 3>(points[c[3]]) + at.s * dealii::Tensor<1, 3>(points[c[2]]));
  }


  double FacetSurface::smooth(const Place &at) const
  {
    const Quadrilateral &c = corners[at.face];
    const double         s = quintic_step(at.s), t = quintic_step(at.t);
    const double         weights[4] = {(1. - s) * (1. - t), s * (1. - t), s * t, (1. - s) * t};
    const Point          p          = bilinear(at);
    double               z          = 0.;
    for (unsigned int v = 0; v < 4; ++v)
      if (weights[v] > 0.)
        z += weights[v] * fitted[c[v]].at(p[0], p[1]);
    return z;
  }


  std::optional<double> FacetSurface::height(const double x, const double y) const
  {
    const auto at = place(x, y, false);
    return at ? std::make_optional(smooth(*at)) : std::nullopt;
  }


  FacetSurface::Facet FacetSurface::facet(const double x, const double y) const
  {
    const Place  at = *place(x, y, true);
    const double z  = bilinear(at)[2];
    return {z, smooth(at) - z};
  }


  FacetSurface::Range FacetSurface::across(const double x, const double y_middle) const
  {
    constexpr unsigned int steps = 4; // within a face
    const double           step  = edge / steps;
    if (!place(x, y_middle, false))
      return {y_middle, y_middle};
    Range range{y_middle, y_middle};
    while (place(x, range.begin - step, false))
      range.begin -= step;
    while (place(x, range.end + step, false))
      range.end += step;
    // and to the edge itself
    for (double part = 0.5 * step; part > 1e-9; part *= 0.5)
      {
        if (place(x, range.begin - part, false))
          range.begin -= part;
        if (place(x, range.end + part, false))
          range.end += part;
      }
    return range;
  }


  std::string FacetSurface::in_words() const
  {
    return format("%zu faces in %u piece%s, with edges of %.3g mm in the mean", corners.size(), pieces,
                  pieces == 1 ? "" : "s", 1e3 * edge);
  }
} // namespace tread
