// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/supported_beam.h>

#include "require.h"

#include <algorithm>

namespace tread::reference
{
  namespace
  {
    using Complex = std::complex<double>;
    constexpr Complex imaginary_unit{0., 1.};
    using Pair  = std::array<Complex, 2>;
    using Block = std::array<std::array<Complex, 2>, 2>;

    Block inverse(const Block &a)
    {
      const Complex determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
      return {
        {{a[1][1] / determinant, -a[0][1] / determinant}, {-a[1][0] / determinant, a[0][0] / determinant}}};
    }

    Block product(const Block &a, const Block &b)
    {
      Block c;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
      return c;
    }

    Pair product(const Block &a, const Pair &b)
    {
      return {a[0][0] * b[0] + a[0][1] * b[1], a[1][0] * b[0] + a[1][1] * b[1]};
    }
  } // namespace


  Complex SupportLayers::stiffness(const Complex omega) const
  {
    const Complex pad = pad_stiffness + imaginary_unit * omega * pad_damping;
    if (std::isinf(ballast_stiffness))
      return pad;
    const Complex below =
      ballast_stiffness + imaginary_unit * omega * ballast_damping - omega * omega * sleeper_mass;
    return pad * below / (pad + below);
  }


  Complex SupportLayers::transmission(const Complex omega) const
  {
    if (std::isinf(ballast_stiffness))
      return 1.;
    const Complex ballast = ballast_stiffness + imaginary_unit * omega * ballast_damping;
    return ballast == 0. ? 0. : ballast / (ballast - omega * omega * sleeper_mass); // none: a hanging sleeper
  }


  double timoshenko_frequency(const BeamSection &section, const double half_wave_length)
  {
    require_positive("half_wave_length", half_wave_length, "m");
    require_positive("mass", section.mass, "kg/m");
    const double k2 = M_PI * M_PI / (half_wave_length * half_wave_length);
    if (std::isinf(section.shear_stiffness))
      return std::sqrt(section.bending_stiffness * k2 * k2 / (section.mass + section.rotary_inertia * k2));
    // (E I k^2 + kGA - rho I w^2)(kGA k^2 - m w^2) = (kGA k)^2
    const double S = section.shear_stiffness, a = section.rotary_inertia * section.mass,
                 b = section.mass * (section.bending_stiffness * k2 + S) + section.rotary_inertia * S * k2,
                 c = section.bending_stiffness * S * k2 * k2;
    return std::sqrt(2. * c / (b + std::sqrt(b * b - 4. * a * c)));
  }


  SupportedBeam::SupportedBeam(const BeamSection                &section,
                               const std::vector<SupportLayers> &layers,
                               const std::vector<double>        &supports,
                               const double                      begin,
                               const double                      end,
                               const double                      element_length)
    : layers(layers)
    , supports(supports)
    , section(section)
  {
    require_positive("bending_stiffness", section.bending_stiffness, "N m^2");
    require(layers.size() == supports.size(), "layers", layers.size(), "one for each support");
    for (const SupportLayers &of_support : layers)
      require_positive("pad_stiffness", of_support.pad_stiffness, "N/m");
    require_positive("element_length", element_length, "m");
    require(begin < end, "end", end, "above the begin");
    double last = begin;
    nodes.push_back(begin);
    const auto divide = [&](const double to) {
      const unsigned int n = std::ceil((to - last) / element_length - 1e-9);
      for (unsigned int i = 1; i <= n; ++i)
        nodes.push_back(i < n ? last + (to - last) * i / n : to);
      last = to;
    };
    for (const double x : supports)
      {
        require(x >= last && x <= end, "support", x, "ascending, between begin and end");
        divide(x);
        node_of_support.push_back(nodes.size() - 1);
      }
    divide(end);
  }


  unsigned int SupportedBeam::element_at(const double x, double &s) const
  {
    require(x >= nodes.front() - 1e-9 && x <= nodes.back() + 1e-9, "x", x, "on the beam");
    const auto         above   = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
    const unsigned int element = above - nodes.begin() - 1;
    s                          = (x - nodes[element]) / (nodes[element + 1] - nodes[element]);
    return element;
  }


  SupportedBeam::Shape SupportedBeam::shape(const unsigned int element, const double s) const
  {
    // Rotation theta_1 (1 - s) + theta_2 s + b s (1 - s) with b = 6/(1 + Phi) ((w_2 - w_1)/L - (theta_1 +
    // theta_2)/2), and slope = rotation + shear strain Phi b/6: no distributed load (Przemieniecki 1968).
    const double                L   = nodes[element + 1] - nodes[element];
    const double                phi = 12. * section.bending_stiffness / (section.shear_stiffness * L * L);
    const double                b   = 6. / (1. + phi);
    const std::array<double, 4> bubble{-b / L, -0.5 * b, b / L, -0.5 * b};
    const double                of_bubble = L * (0.5 * s * s - s * s * s / 3. + phi * s / 6.);
    Shape                       result;
    for (unsigned int i = 0; i < 4; ++i)
      {
        result.deflection[i] = of_bubble * bubble[i];
        result.rotation[i]   = s * (1. - s) * bubble[i];
      }
    result.deflection[0] += 1.;
    result.deflection[1] += L * (s - 0.5 * s * s);
    result.deflection[3] += L * 0.5 * s * s;
    result.rotation[1] += 1. - s;
    result.rotation[3] += s;
    return result;
  }


  SupportedBeam::Response SupportedBeam::respond(const std::vector<Load> &loads, const Complex omega) const &
  {
    const unsigned int n = nodes.size();
    std::vector<Block> diagonal(n, Block{}), upper(n, Block{}); // lower is upper transposed
    std::vector<Pair>  load(n, Pair{});
    for (unsigned int e = 0; e + 1 < n; ++e)
      {
        const double  L    = nodes[e + 1] - nodes[e];
        const double  phi  = 12. * section.bending_stiffness / (section.shear_stiffness * L * L);
        const double  k    = section.bending_stiffness / (L * L * L * (1. + phi));
        const Complex mass = -omega * omega * 0.5 * L * section.mass,
                      turn = -omega * omega * 0.5 * L * section.rotary_inertia;
        for (unsigned int side = 0; side < 2; ++side)
          {
            const double sign = side == 0 ? 1. : -1.;
            diagonal[e + side][0][0] += 12. * k + mass;
            diagonal[e + side][0][1] += sign * 6. * L * k;
            diagonal[e + side][1][0] += sign * 6. * L * k;
            diagonal[e + side][1][1] += (4. + phi) * L * L * k + turn;
          }
        upper[e] = {{{-12. * k, 6. * L * k}, {-6. * L * k, (2. - phi) * L * L * k}}};
      }
    for (std::size_t s = 0; s < supports.size(); ++s)
      {
        const unsigned int   i = node_of_support[s];
        const SupportLayers &l = layers[s];
        diagonal[i][0][0] += l.stiffness(omega);
        // The sleeper does not turn.
        diagonal[i][1][1] +=
          l.pad_radius * l.pad_radius * (l.pad_stiffness + imaginary_unit * omega * l.pad_damping);
      }
    for (const Load &l : loads)
      {
        double             s;
        const unsigned int e = element_at(l.x, s);
        const Shape        f = shape(e, s);
        for (unsigned int i = 0; i < 4; ++i)
          load[e + i / 2][i % 2] += f.deflection[i] * l.force + f.rotation[i] * l.moment;
      }
    // No rotation at the ends.
    for (const unsigned int i : {0u, n - 1})
      {
        diagonal[i][0][1] = diagonal[i][1][0] = load[i][1] = 0.;
        diagonal[i][1][1]                                  = 1.;
      }
    upper[0][1]        = {};
    upper[n - 2][0][1] = upper[n - 2][1][1] = 0.;

    // Elimination by blocks, from the left.
    for (unsigned int i = 0; i + 1 < n; ++i)
      {
        const Block lower{{{upper[i][0][0], upper[i][1][0]}, {upper[i][0][1], upper[i][1][1]}}};
        const Block factor = product(lower, inverse(diagonal[i]));
        const Block taken  = product(factor, upper[i]);
        const Pair  moved  = product(factor, load[i]);
        for (unsigned int a = 0; a < 2; ++a)
          {
            load[i + 1][a] -= moved[a];
            for (unsigned int b = 0; b < 2; ++b)
              diagonal[i + 1][a][b] -= taken[a][b];
          }
      }
    Response response;
    response.beam  = this;
    response.omega = omega;
    response.nodes.resize(n);
    for (unsigned int i = n; i-- > 0;)
      {
        if (i + 1 < n)
          {
            const Pair right = product(upper[i], response.nodes[i + 1]);
            load[i][0] -= right[0];
            load[i][1] -= right[1];
          }
        response.nodes[i] = product(inverse(diagonal[i]), load[i]);
      }
    return response;
  }


  Complex SupportedBeam::Response::deflection(const double x) const
  {
    double             s;
    const unsigned int e = beam->element_at(x, s);
    const Shape        f = beam->shape(e, s);
    return f.deflection[0] * nodes[e][0] + f.deflection[1] * nodes[e][1] + f.deflection[2] * nodes[e + 1][0] +
           f.deflection[3] * nodes[e + 1][1];
  }


  Complex SupportedBeam::Response::rotation(const double x) const
  {
    double             s;
    const unsigned int e = beam->element_at(x, s);
    const Shape        f = beam->shape(e, s);
    return f.rotation[0] * nodes[e][0] + f.rotation[1] * nodes[e][1] + f.rotation[2] * nodes[e + 1][0] +
           f.rotation[3] * nodes[e + 1][1];
  }


  Complex SupportedBeam::Response::pad_force(const unsigned int support) const
  {
    return beam->layers.at(support).stiffness(omega) * nodes[beam->node_of_support.at(support)][0];
  }


  Complex SupportedBeam::Response::ballast_force(const unsigned int support) const
  {
    return beam->layers.at(support).transmission(omega) * pad_force(support);
  }
} // namespace tread::reference
