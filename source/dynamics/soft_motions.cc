// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/soft_motions.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tread
{
  namespace
  {
    /// Distance of the stations of a rail, m: a quarter of a span. The relaxation does what is shorter.
    constexpr double distance_of_stations = 0.15;
    /// So many stations of a rail are enough: the matrix is full.
    constexpr unsigned int most_stations = 200;
    /// Largest number of waves around a wheel: its rim is stiff against shorter ones.
    constexpr unsigned int most_waves = 3;

    /// By which a motion is probed, m.
    constexpr double probe = 1e-6;

    /// Share of the largest stiffness that every motion has at least: some are held by nothing, or wholly.
    constexpr double least_stiffness = 1e-8;
  } // namespace


  SoftMotions::SoftMotions(const Mesh                       &mesh,
                           const std::vector<SoftBody>      &soft,
                           NodalField                        at_,
                           std::vector<char>                 moves_,
                           std::function<void(NodalField &)> hold,
                           const Quantum                     quantum)
    : mesh(mesh)
    , at(std::move(at_))
    , moves(std::move(moves_))
    , hold(std::move(hold))
    , quantum(quantum)
    , bodies(soft.size())
    , place_of_body(mesh.body_names.size(), -1)
  {
    for (unsigned int b = 0; b < soft.size(); ++b)
      {
        bodies[b].what                = soft[b];
        place_of_body[soft[b].number] = b;
      }
    // Bounds of the bodies, with negative signs of the lower ones, then of carried radii and lengths of
    // cells.
    std::vector<double> bounds(7 * soft.size() + 1, std::numeric_limits<double>::lowest());
    for (unsigned int i = 0; i < at.size(); ++i)
      if (const int b = place_of_body[mesh.node_bodies[i]]; b >= 0)
        for (unsigned int c = 0; c < 3; ++c)
          {
            bounds[7 * b + c]     = std::max(bounds[7 * b + c], -at[i][c]);
            bounds[7 * b + 3 + c] = std::max(bounds[7 * b + 3 + c], at[i][c]);
          }
    for (unsigned int b = 0; b < soft.size(); ++b)
      for (const unsigned int i : soft[b].held)
        bounds[7 * b + 6] =
          std::max(bounds[7 * b + 6], std::hypot(at[i][0] - soft[b].middle[0], at[i][2] - soft[b].middle[2]));
    for (const Mesh::Cell &cell : mesh.cells)
      if (const int b = place_of_body[cell.body]; b >= 0 && soft[b].shape == SoftBody::Shape::line)
        for (const unsigned int node : cell.nodes)
          bounds.back() = std::max(bounds.back(), at[node][0] - at[cell.nodes[0]][0]);
    bounds.back() = std::max(bounds.back(), 0.);
    dealii::Utilities::MPI::max(bounds, mesh.comm, bounds);
    longest_cell = bounds.back();
    for (unsigned int b = 0; b < soft.size(); ++b)
      {
        Body &body = bodies[b];
        for (unsigned int c = 0; c < 3; ++c)
          {
            body.low[c]  = -bounds[7 * b + c];
            body.high[c] = bounds[7 * b + 3 + c];
          }
        body.hub   = bounds[7 * b + 6];
        body.first = n_motions;
        if (body.what.shape == SoftBody::Shape::line)
          {
            const double length = body.high[0] - body.low[0];
            const double pieces = std::ceil(length / std::max(distance_of_stations, longest_cell));
            body.n              = 1 + static_cast<unsigned int>(std::clamp(pieces, 1., most_stations - 1.));
            body.spacing        = length / (body.n - 1);
          }
        else if (body.what.shape == SoftBody::Shape::ring)
          body.n = 1 + 2 * most_waves;
        n_motions += body.n * body.n_motions();
      }
  }


  template <typename Loop>
  void SoftMotions::for_motions(const Body &body, const Vector3 &place, const Loop &loop) const
  {
    // Rotations are those of the largest half width of a section, so that all motions are displacements.
    const dealii::Point<3> middle     = body.low + 0.5 * (body.high - body.low);
    const double           half       = 0.5 * (body.high[2] - body.low[2]);
    const auto             of_station = [&](const unsigned int station, const double weight) {
      if (weight == 0.)
        return;
      Vector3 arm{};
      for (unsigned int c = 0; c < 3; ++c)
        arm[c] = place[c] - middle[c];
      const unsigned int motion = body.first + station * body.n_motions();
      if (body.what.shape == SoftBody::Shape::line) // no shear strain where the curvature is the same
        arm[0] = 0.5 * (place[0] - body.low[0] - station * body.spacing);
      for (unsigned int c = 0; c < 3; ++c)
        {
          Vector3 along{};
          along[c] = weight;
          loop(motion + c, along);
        }
      loop(motion + 3, weight / half * Vector3{0., -arm[2], arm[1], 0.});
      loop(motion + 4, weight / half * Vector3{arm[2], 0., -arm[0], 0.});
      loop(motion + 5, weight / half * Vector3{-arm[1], arm[0], 0., 0.});
    };
    switch (body.what.shape)
      {
      case SoftBody::Shape::piece:
        of_station(0, 1.);
        return;
      case SoftBody::Shape::line:
        {
          const double s     = std::clamp((place[0] - body.low[0]) / body.spacing, 0., body.n - 1.);
          const auto   below = std::min(static_cast<unsigned int>(s), body.n - 2);
          of_station(below, 1. - (s - below));
          of_station(below + 1, s - below);
          return;
        }
      case SoftBody::Shape::ring:
        // A plate without shear strain (Kirchhoff) that bends to the side, clamped inside.
        {
          const Vector3 arm   = place - body.what.middle;
          const double  r     = std::sqrt(arm[0] * arm[0] + arm[2] * arm[2]);
          const double  width = body.high[2] - body.what.middle[2] - body.hub;
          const double  s     = (r - body.hub) / width;
          const Vector3 outwards{arm[0] / r, 0., arm[2] / r, 0.}, around{-arm[2] / r, 0., arm[0] / r, 0.};
          double        cosine = 1., sine = 0.; // of the angle times the number of waves
          for (unsigned int f = 0; f < body.n; ++f)
            {
              const unsigned int waves   = (f + 1) / 2;
              const bool         is_sine = f % 2 == 1; // the first of this number
              if (is_sine)
                {
                  const double before = cosine;
                  cosine              = before * outwards[0] - sine * outwards[2];
                  sine                = sine * outwards[0] + before * outwards[2];
                }
              const double wave = is_sine ? sine : cosine, slope = waves * (is_sine ? cosine : -sine);
              double       lower = s; // power
              for (unsigned int power = 2; power < 2 + body.n_motions(); ++power)
                {
                  const double way = lower * s;
                  loop(body.first + f * body.n_motions() + power - 2,
                       Vector3{0., way * wave, 0., 0.} - arm[1] * power * lower / width * wave * outwards -
                         arm[1] * way * slope / r * around);
                  lower = way;
                }
            }
        }
      }
  }


  template <typename Loop>
  void SoftMotions::for_line(const double x, const Loop &loop) const
  {
    for (const Body &body : bodies)
      if (body.what.shape == SoftBody::Shape::line)
        for_motions(body, Vector3{x, 0., body.high[2], 0.}, loop);
  }


  void SoftMotions::project(const NodalField &force, double *shares) const
  {
    for (unsigned int i = 0; i < at.size(); ++i)
      if (const Body *body = body_of(i); body && mesh.shared_nodes.is_owned(i))
        for_motions(*body, at[i], [&](const unsigned int motion, const Vector3 &displacement) {
          shares[motion] += quantum.round(dot(displacement, force[i]));
        });
  }


  NodalField SoftMotions::field(const dealii::Vector<double> &amplitudes) const
  {
    NodalField field(at.size(), Vector3{});
    for (unsigned int i = 0; i < at.size(); ++i)
      if (const Body *body = body_of(i))
        for_motions(*body, at[i], [&](const unsigned int motion, const Vector3 &displacement) {
          field[i] += amplitudes[motion] * displacement;
        });
    hold(field);
    mesh.distribute_hanging_nodes(field.data());
    return field;
  }


  double SoftMotions::up(const dealii::Vector<double> &amplitudes, const double x) const
  {
    double up = 0.;
    for_line(x, [&](const unsigned int motion, const Vector3 &way) { up += amplitudes[motion] * way[2]; });
    return up;
  }


  std::vector<SoftMotions::Station> SoftMotions::stations() const
  {
    std::vector<Station> all;
    for (const Body &body : bodies)
      for (unsigned int s = 0; s < body.n; ++s)
        {
          Station station{&body, s, body.low[0], body.high[0]};
          if (body.what.shape == SoftBody::Shape::line)
            {
              station.from = body.low[0] + (s - 1.) * body.spacing;
              station.to   = body.low[0] + (s + 1.) * body.spacing;
            }
          station.from -= longest_cell;
          station.to += longest_cell;
          all.push_back(station);
        }
    return all;
  }


  bool SoftMotions::touch(const Station &a, const Station &b) const
  {
    const auto ring = SoftBody::Shape::ring;
    if (a.body->what.shape != ring && b.body->what.shape != ring)
      return a.from < b.to && b.from < a.to;
    return a.body == b.body;
  }


  bool SoftMotions::find_stiffness(const std::function<NodalField(const NodalField &)> &forces_by)
  {
    const std::vector<Station>             all = stations();
    const auto                             n   = static_cast<unsigned int>(all.size());
    std::vector<std::vector<unsigned int>> touched(n);
    for (unsigned int s = 0; s < n; ++s)
      for (unsigned int t = 0; t < n; ++t)
        if (touch(all[s], all[t]))
          touched[s].push_back(t);
    // Stations that are probed at once have no station in common that feels both.
    std::vector<std::vector<unsigned int>> groups;
    std::vector<std::vector<char>>         feels;
    for (unsigned int s = 0; s < n; ++s)
      {
        std::size_t g = 0;
        while (g < groups.size() && std::any_of(touched[s].begin(), touched[s].end(),
                                                [&](const unsigned int t) { return feels[g][t]; }))
          ++g;
        if (g == groups.size())
          {
            groups.emplace_back();
            feels.emplace_back(n, 0);
          }
        groups[g].push_back(s);
        for (const unsigned int t : touched[s])
          feels[g][t] = 1;
      }

    constexpr unsigned int most_motions = 6;
    std::vector<double>    shares(groups.size() * most_motions * n_motions, 0.);
    const auto             shares_of = [&](const std::size_t group, const unsigned int motion) {
      return shares.data() + (group * most_motions + motion) * n_motions;
    };
    const auto motion = [&](const unsigned int s, const unsigned int m) {
      return all[s].body->first + all[s].number * all[s].body->n_motions() + m;
    };
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (unsigned int m = 0; m < most_motions; ++m)
        {
          dealii::Vector<double> amplitudes(n_motions);
          for (const unsigned int s : groups[g])
            if (m < all[s].body->n_motions())
              amplitudes[motion(s, m)] = probe;
          if (amplitudes.all_zero())
            continue;
          project(forces_by(field(amplitudes)), shares_of(g, m));
        }
    dealii::Utilities::MPI::sum(shares, mesh.comm, shares);

    dealii::FullMatrix<double> found(n_motions);
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const unsigned int s : groups[g])
        for (unsigned int m = 0; m < all[s].body->n_motions(); ++m)
          for (const unsigned int t : touched[s])
            for (unsigned int k = 0; k < all[t].body->n_motions(); ++k)
              {
                const double half = -0.5 / probe * shares_of(g, m)[motion(t, k)];
                found(motion(s, m), motion(t, k)) += half;
                found(motion(t, k), motion(s, m)) += half;
              }
    double largest = 0.;
    for (unsigned int k = 0; k < n_motions; ++k)
      largest = std::max(largest, found(k, k));
    // Springs at the border of open and closed, and what is bent far, may leave it indefinite.
    is_known = true;
    for (double least = least_stiffness;; least *= 10.)
      {
        dealii::LAPACKFullMatrix<double> factor(n_motions);
        factor = found;
        for (unsigned int k = 0; k < n_motions; ++k)
          factor(k, k) += least * largest;
        factor.set_property(dealii::LAPACKSupport::symmetric);
        try
          {
            factor.compute_cholesky_factorization();
          }
        catch (const dealii::ExceptionBase &)
          {
            if (stiffness.m() > 0)
              return false;
            if (least >= 1.)
              throw std::runtime_error(
                "no equilibrium at the start: rail, sleepers or wheel resist no motion");
            continue;
          }
        stiffness = std::move(factor);
        return true;
      }
  }


  SoftMotions::Balance SoftMotions::balance(const NodalField              &force,
                                            const std::vector<MovingLoad> &loads) const
  {
    std::vector<double> shares(n_motions, 0.);
    project(force, shares.data());
    dealii::Utilities::MPI::sum(shares, mesh.comm, shares);
    for (const MovingLoad &load : loads)
      for_line(load.x, [&](const unsigned int motion, const Vector3 &displacement) {
        shares[motion] += load.force * displacement[2];
      });
    Balance balance{dealii::Vector<double>(shares.begin(), shares.end()), 0., 0.};
    stiffness.solve(balance.amplitudes);
    for (unsigned int motion = 0; motion < n_motions; ++motion)
      {
        balance.work += balance.amplitudes[motion] * shares[motion];
        balance.largest_force = std::max(balance.largest_force, std::abs(shares[motion]));
      }
    return balance;
  }
} // namespace tread
