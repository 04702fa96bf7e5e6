// SPDX-License-Identifier: LGPL-2.1-or-later
#include "newton.h"

#include <algorithm>
#include <cmath>

namespace tread::reference
{
  Patch::Patch(const Grid &outer_grid, const std::vector<unsigned int> &elements)
    : outer(elements)
  {
    unsigned int i0 = outer_grid.n_x, i1 = 0, j0 = outer_grid.n_y, j1 = 0;
    for (const unsigned int e : elements)
      {
        const unsigned int i = e % outer_grid.n_x, j = e / outer_grid.n_x;
        i0 = std::min(i0, i), i1 = std::max(i1, i);
        j0 = std::min(j0, j), j1 = std::max(j1, j);
      }
    grid = Grid{i1 - i0 + 1, j1 - j0 + 1, outer_grid.dx, outer_grid.dy, outer_grid.x(i0), outer_grid.y(j0)};
    inner.reserve(elements.size());
    for (const unsigned int e : elements)
      inner.push_back((e / outer_grid.n_x - j0) * grid.n_x + e % outer_grid.n_x - i0);
  }

  FrictionNewton::FrictionNewton(const FrictionEquations &equations)
    : equations(equations)
    , n(equations.patch->size())
    , fourier(equations.patch->grid)
    , op(fourier, equations.pair, equations.stencil)
  {
    // Its transforms cost twice those of a product; with so few elements in a row they save less.
    constexpr unsigned int worth_it = 40;
    if (equations.patch->grid.n_x > worth_it)
      inverse.emplace(fourier, equations.pair);
    fourier.select(equations.patch->inner);
    p_ref                = *std::max_element(equations.bound.begin(), equations.bound.end());
    const Grid &grid     = equations.patch->grid;
    double      diagonal = 0.;
    for (const auto &[w, offset] : equations.stencil)
      diagonal += w * influence_coefficient(Influence::xx, equations.pair, grid.dx, grid.dy, offset, 0.);
    r = 1. / diagonal;
    if (equations.stencil.size() == 1)
      {
        // The displacements themselves, without a difference along x: their operator is smoothing, its
        // largest eigenvalue belongs to constant traction, and r must not exceed the inverse of that.
        std::vector<double> ones(2 * n, 0.), u(2 * n);
        std::fill_n(ones.begin(), n, 1.);
        op.apply(ones.data(), u.data());
        r = 1. / *std::max_element(u.begin(), u.begin() + n);
      }
    n_unknowns = 2 * n;
    for (unsigned int d = 0; d < 2; ++d)
      row[d] = equations.prescribed[d] ? static_cast<int>(n_unknowns++) : -1;
    border = 1. / std::sqrt(static_cast<double>(n));
    bound.resize(n);
    for (std::size_t k = 0; k < n; ++k)
      bound[k] = equations.bound[k] / p_ref;
    fixed.resize(2 * n);
    for (std::size_t k = 0; k < 2 * n; ++k)
      fixed[k] = equations.fixed[k] * r / p_ref;
    softness.assign(2 * n, 0.);
    for (std::size_t k = 0; k < equations.compliance.size(); ++k)
      softness[k] = r * equations.compliance[k];
    sigma.resize(2 * n), weight.resize(n), e_x.resize(n), e_y.resize(n), work.resize(2 * n);
  }

  // weight < 0 marks adhesion; else weight and (e_x, e_y) make the derivative of the projection.
  double FrictionNewton::residual(const std::vector<double> &v, std::vector<double> &out)
  {
    op.apply(v.data(), sigma.data());
    const double c_x = row[0] < 0 ? 0. : v[row[0]] * border, c_y = row[1] < 0 ? 0. : v[row[1]] * border;
    double       worst = 0., sum[2] = {0., 0.};
    out.resize(n_unknowns);
    for (std::size_t k = 0; k < n; ++k)
      {
        sigma[k]     = r * sigma[k] + fixed[k] + c_x;
        sigma[n + k] = r * sigma[n + k] + fixed[n + k] + c_y;
        // With a compliance r must be the smaller value of a softer element, and the same in both directions.
        const double soft = 1. / (1. + std::max(softness[k], softness[n + k]));
        const double s_x  = soft * (sigma[k] + softness[k] * v[k]),
                     s_y  = soft * (sigma[n + k] + softness[n + k] * v[n + k]);
        const double q_x = v[k] - s_x, q_y = v[n + k] - s_y;
        const double size = std::hypot(q_x, q_y);
        if (size <= bound[k])
          {
            weight[k]  = -1.;
            out[k]     = s_x;
            out[n + k] = s_y;
          }
        else
          {
            weight[k]  = bound[k] / size;
            e_x[k]     = q_x / size;
            e_y[k]     = q_y / size;
            out[k]     = v[k] - weight[k] * q_x;
            out[n + k] = v[n + k] - weight[k] * q_y;
          }
        worst = std::max({worst, std::abs(out[k]), std::abs(out[n + k])});
        sum[0] += v[k];
        sum[1] += v[n + k];
      }
    const double unit = p_ref * equations.patch->grid.element_area();
    for (unsigned int d = 0; d < 2; ++d)
      if (row[d] >= 0)
        {
          out[row[d]] = border * (sum[d] - equations.force[d] / unit);
          worst       = std::max(worst, std::abs(out[row[d]]) * border);
        }
    return worst;
  }

  void FrictionNewton::jacobian(const double *in, double *out)
  {
    op.apply(in, work.data());
    const double c_x = row[0] < 0 ? 0. : in[row[0]] * border, c_y = row[1] < 0 ? 0. : in[row[1]] * border;
    double       sum[2] = {0., 0.};
    for (std::size_t k = 0; k < n; ++k)
      {
        const double soft = 1. / (1. + std::max(softness[k], softness[n + k]));
        const double s_x  = soft * (r * work[k] + c_x + softness[k] * in[k]),
                     s_y  = soft * (r * work[n + k] + c_y + softness[n + k] * in[n + k]);
        sum[0] += in[k];
        sum[1] += in[n + k];
        if (weight[k] < 0.)
          {
            out[k]     = s_x;
            out[n + k] = s_y;
          }
        else
          {
            const double q_x = in[k] - s_x, q_y = in[n + k] - s_y;
            const double along = e_x[k] * q_x + e_y[k] * q_y;
            out[k]             = in[k] - weight[k] * (q_x - along * e_x[k]);
            out[n + k]         = in[n + k] - weight[k] * (q_y - along * e_y[k]);
          }
      }
    for (unsigned int d = 0; d < 2; ++d)
      if (row[d] >= 0)
        out[row[d]] = border * sum[d];
  }

  // Identity where elements slip. In adhesion u(x) - u(x + dx) = slip is inverted by the sum of slips from
  // the leading edge of each row, a convolution towards -x that belongs before the backward factor of the
  // displacement's inverse. The difference of second order is 3/2 (1 - z/3)(1 - z) with the shift z by an
  // element towards +x, so a second, decaying sum follows. A shift or a transient step knows u(x + dx): no
  // sums.
  void FrictionNewton::precondition(const double *in, double *out)
  {
    const std::vector<unsigned int> &element              = equations.patch->inner;
    const unsigned int               n_x                  = equations.patch->grid.n_x;
    const bool                       sums                 = equations.stencil.size() >= 2;
    const double                     scale                = 1. / (r * equations.stencil[0][0]);
    const auto                       restrict_to_adhesion = [&] {
      for (std::size_t k = 0; k < n; ++k)
        if (weight[k] >= 0.)
          out[k] = out[n + k] = 0.;
    };
    std::copy_n(in, n_unknowns, out);
    if (!inverse)
      return;
    restrict_to_adhesion();
    inverse->apply_forward(out);
    restrict_to_adhesion();
    const auto sum_from_the_front = [&](const double share) {
      for (std::size_t k = n - 1; k-- > 0;)
        if (weight[k] < 0. && weight[k + 1] < 0. && element[k + 1] == element[k] + 1 &&
            element[k + 1] % n_x != 0)
          {
            out[k] += share * out[k + 1];
            out[n + k] += share * out[n + k + 1];
          }
    };
    if (sums)
      sum_from_the_front(1.);
    if (equations.stencil.size() == 3)
      sum_from_the_front(1. / 3.);
    inverse->apply_backward(out);
    for (std::size_t k = 0; k < n; ++k)
      {
        const bool adheres = weight[k] < 0.;
        out[k]             = adheres ? scale * out[k] : in[k];
        out[n + k]         = adheres ? scale * out[n + k] : in[n + k];
      }
  }

  bool FrictionNewton::iterate(State &state, const double tolerance, const unsigned int max_iterations)
  {
    std::vector<double> v(n_unknowns, 0.), f, delta;
    for (std::size_t k = 0; k < 2 * n; ++k)
      v[k] = state.shear[k] / p_ref;
    for (unsigned int d = 0; d < 2; ++d)
      if (row[d] >= 0)
        v[row[d]] = state.creepage[d] * r / p_ref / border;

    // Tractions far below the friction bound are found to the same share of themselves, not of the bound.
    constexpr double round_off = 1e-14;
    const auto       allowed   = [&] {
      double largest = 0.;
      for (std::size_t k = 0; k < 2 * n; ++k)
        largest = std::max(largest, std::abs(v[k]));
      return std::max(tolerance * std::min(largest, 1.), round_off);
    };
    violation = residual(v, f);
    for (unsigned int k = 0; k < max_iterations && violation > allowed(); ++k)
      {
        for (double &value : f)
          value = -value;
        // 1e-2 balances Krylov steps that the next Newton step makes void against further Newton steps
        linear_iterations += gmres.solve(
          f, delta, 1e-2, 400, [&](const double *in, double *out) { jacobian(in, out); },
          [&](const double *in, double *out) { precondition(in, out); });
        ++iterations;
        // Where nearly all slips, the force hardly depends on the creepage: its steps are kept to the order
        // of the slip that turns adhesion into full slip, which is 1 in these variables.
        double shorten = 1.;
        for (std::size_t e = 2 * n; e < n_unknowns; ++e)
          shorten = std::min(shorten, 1. / std::max(1., std::abs(delta[e]) * border));
        for (std::size_t e = 0; e < n_unknowns; ++e)
          v[e] += shorten * delta[e];
        for (std::size_t e = 0; e < n; ++e)
          {
            const double size = std::hypot(v[e], v[n + e]);
            if (size > bound[e])
              {
                v[e] *= bound[e] / size;
                v[n + e] *= bound[e] / size;
              }
          }
        violation = residual(v, f);
      }
    for (std::size_t e = 0; e < 2 * n; ++e)
      state.shear[e] = v[e] * p_ref;
    for (unsigned int d = 0; d < 2; ++d)
      if (row[d] >= 0)
        state.creepage[d] = v[row[d]] * border * p_ref / r;
    return violation <= allowed();
  }

  std::vector<double> FrictionNewton::slip() const
  {
    std::vector<double> result(2 * n);
    for (std::size_t k = 0; k < 2 * n; ++k)
      result[k] = sigma[k] * p_ref / r;
    return result;
  }
} // namespace tread::reference
