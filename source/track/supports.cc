// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/supports.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace tread
{
  namespace
  {
    /// Newton's method on a face's map: it ends when a point is found to this share of the face's size, for
    /// which a flat quadrilateral takes 2 to 4 of the iterations allowed, or when the local coordinates run
    /// away to this distance, 1 being the edge.
    constexpr double       newton_tolerance  = 1e-12;
    constexpr unsigned int newton_iterations = 20;
    constexpr double       far_outside       = 10.;

    /// A point on the edge of two faces may lie outside each of them by rounding: this much, in local
    /// coordinates, is still inside.
    constexpr double edge_tolerance = 1e-6;

    /// A corner of a face is nearer to any of its points than this many of its largest sides.
    constexpr double reach_of_face = 3.;

    /// Heights (m), distances (m) and shares that differ by less are the same: far above rounding, far below
    /// anything of a mesh.
    constexpr double round_off = 1e-9;

    constexpr double nanometre = 1e-9; // m

    /// Shape functions of a face at (x, y), seen along z; false if it lies outside.
    bool shares_of_corners(const std::array<dealii::Point<3>, 4> &corner,
                           const double                           x,
                           const double                           y,
                           std::array<double, 4>                 &share)
    {
      double       xi = 0., eta = 0., size = 0.;
      const double sign_xi[4] = {-1., 1., 1., -1.}, sign_eta[4] = {-1., -1., 1., 1.};
      for (const dealii::Point<3> &p : corner)
        size = std::max({size, std::abs(p[0] - corner[0][0]), std::abs(p[1] - corner[0][1])});
      if (std::hypot(x - corner[0][0], y - corner[0][1]) > reach_of_face * size)
        return false;
      for (unsigned int iteration = 0; iteration < newton_iterations; ++iteration)
        {
          double dx = x, dy = y, J[2][2] = {};
          for (unsigned int k = 0; k < 4; ++k)
            {
              const double a = 1. + sign_xi[k] * xi, b = 1. + sign_eta[k] * eta;
              share[k] = 0.25 * a * b;
              dx -= share[k] * corner[k][0];
              dy -= share[k] * corner[k][1];
              for (unsigned int d = 0; d < 2; ++d)
                {
                  J[d][0] += 0.25 * sign_xi[k] * b * corner[k][d];
                  J[d][1] += 0.25 * sign_eta[k] * a * corner[k][d];
                }
            }
          if (std::hypot(dx, dy) < newton_tolerance * size)
            break;
          const double determinant = J[0][0] * J[1][1] - J[0][1] * J[1][0];
          xi += (J[1][1] * dx - J[0][1] * dy) / determinant;
          eta += (J[0][0] * dy - J[1][0] * dx) / determinant;
          if (!(std::abs(xi) < far_outside && std::abs(eta) < far_outside))
            return false;
        }
      return std::max(std::abs(xi), std::abs(eta)) < 1. + edge_tolerance;
    }

    /// The middles of n equal parts of [begin, end].
    std::vector<double> middles(const double begin, const double end, const unsigned int n)
    {
      std::vector<double> middle;
      for (unsigned int i = 0; i < n; ++i)
        middle.push_back(begin + (end - begin) * (i + 0.5) / n);
      return middle;
    }
  } // namespace


  reference::SupportLayers TrackParameters::layers(const unsigned int support) const
  {
    const Springs           &own = springs_of(support);
    reference::SupportLayers l;
    l.pad_stiffness = own.pad_stiffness;
    l.pad_damping   = own.pad_damping;
    // Radius of gyration of n equal points at the centres of n parts.
    const double n = points_along;
    l.pad_radius   = pad_length * std::sqrt((1. - 1. / (n * n)) / 12.);
    if (two_layers)
      {
        l.sleeper_mass      = sleeper_mass;
        l.ballast_stiffness = own.ballast_stiffness;
        l.ballast_damping   = own.ballast_damping;
      }
    return l;
  }


  Supports::Supports(const Mesh                      &mesh,
                     const unsigned int               rail_body,
                     const std::vector<double>       &positions,
                     const TrackParameters           &p,
                     const std::vector<SolidSleeper> &solid_sleepers)
    : rail_body(rail_body)
    , positions(positions)
    , parameters(p)
    , solid_sleepers(solid_sleepers)
    , mesh(mesh)
    , rail_ends(positions.size())
    , n_sleepers(p.two_layers && solid_sleepers.empty() ? positions.size() : 0)
  {
    if (!solid_sleepers.empty() && solid_sleepers.size() != positions.size())
      throw std::invalid_argument("solid sleepers: one a support");
    const unsigned int n    = p.points_along * p.points_across;
    const Faces        foot = facing(rail_body, -1.);
    for (unsigned int s = 0; s < positions.size(); ++s)
      {
        const TrackParameters::Springs &own = p.springs_of(s);
        Faces                           top, bottom;
        if (!solid_sleepers.empty())
          {
            top    = facing(solid_sleepers[s].body, 1.);
            bottom = facing(solid_sleepers[s].body, -1.);
          }
        for (const double x :
             middles(positions[s] - 0.5 * p.pad_length, positions[s] + 0.5 * p.pad_length, p.points_along))
          for (const double y :
               middles(p.pad_middle - 0.5 * p.pad_width, p.pad_middle + 0.5 * p.pad_width, p.points_across))
            {
              const unsigned int end = add_end(foot, x, y, -1.);
              rail_ends[s].push_back(end);
              const int below = !p.two_layers            ? -1
                                : solid_sleepers.empty() ? static_cast<int>(s)
                                                         : static_cast<int>(point_of(add_end(top, x, y, 1.)));
              springs.push_back({static_cast<int>(point_of(end)), below, own.pad_stiffness / n,
                                 own.pad_damping / n, s, pad, p.pads_pull, 0.});
            }
        if (!p.two_layers)
          continue;
        if (solid_sleepers.empty())
          springs.push_back({static_cast<int>(s), -1, own.ballast_stiffness, own.ballast_damping, s, ballast,
                             own.ballast_gap == 0., own.ballast_gap});
        else
          for (const double x : middles(positions[s] - 0.5 * solid_sleepers[s].width,
                                        positions[s] + 0.5 * solid_sleepers[s].width, p.points_along))
            for (const double y :
                 middles(solid_sleepers[s].y_begin, solid_sleepers[s].y_end, p.points_across))
              springs.push_back({static_cast<int>(point_of(add_end(bottom, x, y, -1.))), -1,
                                 own.ballast_stiffness / n, own.ballast_damping / n, s, ballast,
                                 own.ballast_gap == 0., own.ballast_gap});
      }
    displacement.assign(point_of(ends.size()), 0.);
    velocity = displacement;
    sleeper_force.assign(n_sleepers, 0.);
    spring_force.assign(springs.size(), 0.);
    damper_force = spring_force;
  }


  Supports::Faces Supports::facing(const unsigned int body, const double side) const
  {
    // Steeper faces, such as those of a web, carry nothing.
    constexpr double least_slope = 0.7;
    Faces            faces;
    for (const Mesh::Face &face : mesh.faces)
      if (face.body == body)
        {
          const dealii::Tensor<1, 3> normal =
            dealii::cross_product_3d(mesh.nodes[face.nodes[2]] - mesh.nodes[face.nodes[0]],
                                     mesh.nodes[face.nodes[3]] - mesh.nodes[face.nodes[1]]);
          if (side * normal[2] > least_slope * normal.norm())
            faces.push_back(&face);
        }
    return faces;
  }


  unsigned int Supports::add_end(const Faces &faces, const double x, const double y, const double side)
  {
    using Place = std::array<long long, 3>; // the middle of a face, nm
    struct Candidate
    {
      double                height;
      Place                 place;
      const Mesh::Face     *face;
      std::array<double, 4> shares;
    };
    constexpr Place        nowhere{{std::numeric_limits<long long>::max(), 0, 0}};
    std::vector<Candidate> candidates;
    double                 highest = std::numeric_limits<double>::lowest();
    for (const Mesh::Face *face : faces)
      {
        std::array<dealii::Point<3>, 4> corner;
        for (unsigned int k = 0; k < 4; ++k)
          corner[k] = mesh.nodes[face->nodes[k]];
        Candidate candidate{0., {}, face, {}};
        if (!shares_of_corners(corner, x, y, candidate.shares))
          continue;
        dealii::Point<3> middle;
        for (unsigned int k = 0; k < 4; ++k)
          {
            candidate.height += side * candidate.shares[k] * corner[k][2];
            middle += 0.25 * corner[k];
          }
        for (unsigned int d = 0; d < 3; ++d)
          candidate.place[d] = std::llround(middle[d] / nanometre);
        highest = std::max(highest, candidate.height);
        candidates.push_back(candidate);
      }
    const double best = dealii::Utilities::MPI::max(highest, mesh.comm);
    if (best == std::numeric_limits<double>::lowest())
      throw std::invalid_argument("no face of the body lies at x = " + std::to_string(1e3 * x) +
                                  " mm, y = " + std::to_string(1e3 * y) + " mm");
    // On an edge several faces hold the point: the first by its place takes it, whichever rank has that.
    Place            first = nowhere;
    const Candidate *found = nullptr;
    for (const Candidate &candidate : candidates)
      if (candidate.height > best - round_off && candidate.place < first)
        {
          first = candidate.place;
          found = &candidate;
        }
    const auto firsts = dealii::Utilities::MPI::all_gather(mesh.comm, first);
    End        end;
    if (found && first == *std::min_element(firsts.begin(), firsts.end()))
      {
        std::map<unsigned int, double> of_node;
        for (unsigned int k = 0; k < 4; ++k)
          {
            const unsigned int node = found->face->nodes[k];
            const auto         h =
              std::find_if(mesh.hanging_nodes.begin(), mesh.hanging_nodes.end(),
                           [=](const Mesh::HangingNode &hanging) { return hanging.node == node; });
            if (h == mesh.hanging_nodes.end())
              of_node[node] += found->shares[k];
            else
              for (const unsigned int parent : h->parents)
                of_node[parent] += found->shares[k] * Mesh::HangingNode::weight;
          }
        // On an edge two faces hold a point, by the nodes of the edge alone.
        for (const auto &[node, part] : of_node)
          if (part > round_off)
            end.nodes.emplace_back(node, part);
        // Their numbers depend on the ranks, and a sum on its order.
        std::sort(end.nodes.begin(), end.nodes.end(), [this](const auto &a, const auto &b) {
          return mesh.node_key(a.first) < mesh.node_key(b.first);
        });
      }
    ends.push_back(end);
    return ends.size() - 1;
  }


  unsigned int Supports::add_probe(const double x)
  {
    probes.push_back(add_end(facing(rail_body, -1.), x, parameters.pad_middle, -1.));
    displacement.push_back(0.);
    velocity.push_back(0.);
    return probes.size() - 1;
  }


  std::vector<double> Supports::of_nodes(const Vector3 *field, const bool from_reference) const
  {
    std::vector<double> values(ends.size(), 0.);
    for (unsigned int e = 0; e < ends.size(); ++e)
      for (const auto &[node, share] : ends[e].nodes)
        values[e] += share * (field[node][2] - (from_reference ? mesh.nodes[node][2] : 0.));
    dealii::Utilities::MPI::sum(values, mesh.comm, values);
    return values;
  }


  void Supports::set_at_rest(const Vector3 *x)
  {
    const std::vector<double> u = of_nodes(x, true);
    std::copy(u.begin(), u.end(), displacement.begin() + n_sleepers);
    std::fill(velocity.begin(), velocity.end(), 0.);
    place_sleepers();
  }


  void Supports::place_sleepers()
  {
    // Springs that push, and those that pull; the others are left out, until none changes.
    std::vector<char>      acts(springs.size(), true);
    bool                   changes = n_sleepers > 0;
    constexpr unsigned int most    = 50; // turns
    for (unsigned int turn = 0; turn < most && changes; ++turn)
      {
        std::vector<double> stiffness(n_sleepers, 0.), load(n_sleepers, -parameters.sleeper_mass * gravity);
        for (unsigned int i = 0; i < springs.size(); ++i)
          if (acts[i])
            for (const int point : {springs[i].a, springs[i].b})
              if (point >= 0 && point < static_cast<int>(n_sleepers))
                {
                  const Spring &spring = springs[i];
                  const int     other  = spring.a + spring.b - point;
                  const double  sign   = point == spring.a ? -1. : 1.;
                  stiffness[point] += spring.stiffness;
                  load[point] +=
                    spring.stiffness * ((other < 0 ? 0. : displacement[other]) + sign * spring.gap);
                }
        for (unsigned int s = 0; s < n_sleepers; ++s)
          if (stiffness[s] > 0.)
            displacement[s] = load[s] / stiffness[s];
        changes = false;
        for (unsigned int i = 0; i < springs.size(); ++i)
          {
            const Spring &spring = springs[i];
            // A sleeper that nothing holds comes to rest on its ballast.
            const bool falls =
              spring.layer == ballast && spring.a < static_cast<int>(n_sleepers) && stiffness[spring.a] == 0.;
            const bool acted = acts[i];
            acts[i]          = falls || spring.pulls || tension(spring) < 0.;
            changes          = changes || acts[i] != acted;
          }
      }
  }


  void Supports::give(const int point, const double value, Vector3 *force) const
  {
    if (point >= static_cast<int>(n_sleepers))
      for (const auto &[node, share] : ends[point - n_sleepers].nodes)
        force[node][2] += force_quantum.round(share * value);
  }


  void Supports::add_forces(Vector3 *force)
  {
    for (double &f : sleeper_force)
      f = -parameters.sleeper_mass * gravity;
    for (unsigned int i = 0; i < springs.size(); ++i)
      {
        const Spring &spring = springs[i];
        const double  held   = tension(spring);
        damper_force[i]      = spring.damping * difference(velocity, spring);
        if (!spring.pulls)
          damper_force[i] = held < 0. ? std::min(damper_force[i], -held) : 0.;
        const double f  = held + damper_force[i];
        spring_force[i] = f;
        give(spring.a, -f, force);
        give(spring.b, f, force);
        if (spring.a < static_cast<int>(n_sleepers))
          sleeper_force[spring.a] -= f;
        if (spring.b >= 0 && spring.b < static_cast<int>(n_sleepers))
          sleeper_force[spring.b] += f;
      }
  }


  void Supports::add_spring_forces(Vector3 *force) const
  {
    for (const Spring &spring : springs)
      {
        const double f = tension(spring);
        give(spring.a, -f, force);
        give(spring.b, f, force);
      }
  }


  void Supports::add_row_sums(Vector3 *field) const
  {
    for (const Spring &spring : springs)
      for (const int point : {spring.a, spring.b})
        if (point >= static_cast<int>(n_sleepers))
          {
            const double neighbours = spring.b < 0 ? 1. : 2.;
            for (const auto &[node, share] : ends[point - n_sleepers].nodes)
              {
                field[node][0] += row_quantum.round(neighbours * share * spring.stiffness);
                field[node][1] += row_quantum.round(neighbours * share * spring.damping);
              }
          }
  }


  void Supports::sleeper_row_sums(double &stiffness_over_mass, double &damping_over_mass) const
  {
    stiffness_over_mass = damping_over_mass = 0.;
    for (unsigned int s = 0; s < n_sleepers; ++s)
      {
        const TrackParameters::Springs &own = parameters.springs_of(s);
        stiffness_over_mass = std::max(stiffness_over_mass, (2. * own.pad_stiffness + own.ballast_stiffness) /
                                                              parameters.sleeper_mass);
        damping_over_mass =
          std::max(damping_over_mass, (2. * own.pad_damping + own.ballast_damping) / parameters.sleeper_mass);
      }
  }


  void Supports::predict(const Vector3             *v,
                         const Vector3             *force,
                         const std::vector<double> &inverse_masses,
                         const double               time_step,
                         double                    *velocities) const
  {
    for (unsigned int e = 0; e < ends.size(); ++e)
      {
        velocities[e] = 0.;
        for (const auto &[node, share] : ends[e].nodes)
          velocities[e] += share * (v[node][2] + time_step * inverse_masses[node] * force[node][2]);
      }
  }


  void Supports::advance(const double *velocities, const double time_step)
  {
    const std::vector<double> before = velocity;
    for (unsigned int s = 0; s < n_sleepers; ++s)
      velocity[s] += time_step * sleeper_force[s] / parameters.sleeper_mass;
    std::copy(velocities, velocities + ends.size(), velocity.begin() + n_sleepers);
    for (unsigned int i = 0; i < springs.size(); ++i)
      damper_work += 0.5 * time_step * damper_force[i] *
                     (difference(before, springs[i]) + difference(velocity, springs[i]));
    for (unsigned int i = 0; i < displacement.size(); ++i)
      displacement[i] += time_step * velocity[i];
  }


  void Supports::set_velocities(const Vector3 *v, const std::vector<double> &sleeper_velocities)
  {
    const std::vector<double> of_ends = of_nodes(v, false);
    std::copy(of_ends.begin(), of_ends.end(), velocity.begin() + n_sleepers);
    std::copy_n(sleeper_velocities.begin(), n_sleepers, velocity.begin());
  }


  double Supports::force(const unsigned int support, const Layer layer) const
  {
    double compression = 0.;
    for (unsigned int i = 0; i < springs.size(); ++i)
      if (springs[i].support == support && springs[i].layer == layer)
        compression -= spring_force[i];
    return compression;
  }


  std::vector<double> Supports::seat_pressures(const unsigned int support) const
  {
    const double points_per_area =
      parameters.points_along * parameters.points_across / (parameters.pad_length * parameters.pad_width);
    std::vector<double> pressures;
    for (unsigned int i = 0; i < springs.size(); ++i)
      if (springs[i].support == support && springs[i].layer == pad)
        pressures.push_back(-spring_force[i] * points_per_area);
    return pressures;
  }


  std::pair<double, double> Supports::pad_pressures(const unsigned int support) const
  {
    const std::vector<double> pressures = seat_pressures(support);
    const auto [least, largest]         = std::minmax_element(pressures.begin(), pressures.end());
    return {*least, *largest};
  }


  double Supports::rail_displacement(const unsigned int support) const
  {
    double sum = 0.;
    for (const unsigned int e : rail_ends[support])
      sum += displacement[point_of(e)];
    return sum / rail_ends[support].size();
  }


  double Supports::probe_displacement(const unsigned int probe) const
  {
    return displacement[point_of(probes[probe])];
  }


  double Supports::spring_energy() const
  {
    double energy = 0.;
    for (const Spring &spring : springs)
      if (spring.stiffness > 0.)
        energy += 0.5 * std::pow(tension(spring), 2) / spring.stiffness;
    return energy;
  }


  double Supports::sleeper_kinetic_energy(const double time_step) const
  {
    double energy = 0.;
    for (unsigned int s = 0; s < n_sleepers; ++s)
      energy += 0.5 * parameters.sleeper_mass * velocity[s] * velocity[s];
    for (const Spring &spring : springs)
      {
        const double f = tension(spring);
        if (spring.a < static_cast<int>(n_sleepers))
          energy -= 0.5 * time_step * f * velocity[spring.a];
        if (spring.b >= 0 && spring.b < static_cast<int>(n_sleepers))
          energy += 0.5 * time_step * f * velocity[spring.b];
      }
    return energy;
  }


  double Supports::weight_potential(const double time_step) const
  {
    double potential = 0.;
    for (unsigned int s = 0; s < n_sleepers; ++s)
      potential += parameters.sleeper_mass * gravity * (displacement[s] - 0.5 * time_step * velocity[s]);
    return potential;
  }


  std::vector<unsigned int> Supports::nodes() const
  {
    std::vector<unsigned int> all;
    for (const End &end : ends)
      for (const auto &[node, share] : end.nodes)
        all.push_back(node);
    return all;
  }


  std::vector<unsigned int> Supports::guided_nodes(const unsigned int direction) const
  {
    std::vector<unsigned int> chosen;
    for (unsigned int s = 0; s < positions.size(); ++s)
      {
        // Points of the rail's foot under the pads, or those on the ballast of solid sleepers.
        std::vector<unsigned int> candidates;
        for (const Spring &spring : springs)
          if (spring.support == s && spring.a >= static_cast<int>(n_sleepers) &&
              spring.layer == (direction == 1 ? pad : ballast))
            for (const auto &[node, share] : ends[spring.a - n_sleepers].nodes)
              candidates.push_back(node);
        const auto distance = [&](const unsigned int node) {
          return std::abs(mesh.nodes[node][direction] -
                          (direction == 0 ? positions[s] : parameters.pad_middle));
        };
        double nearest = std::numeric_limits<double>::max();
        for (const unsigned int node : candidates)
          nearest = std::min(nearest, distance(node));
        nearest = dealii::Utilities::MPI::min(nearest, mesh.comm);
        for (const unsigned int node : candidates)
          if (distance(node) <= nearest + round_off)
            chosen.push_back(node);
      }
    // A node is held on all ranks or on none.
    NodalField marks(mesh.nodes.size(), Vector3{});
    for (const unsigned int node : chosen)
      marks[node][0] = 1.;
    mesh.shared_nodes.sum(marks.data());
    chosen.clear();
    for (unsigned int i = 0; i < marks.size(); ++i)
      if (marks[i][0] > 0.)
        chosen.push_back(i);
    return chosen;
  }


  std::vector<Supports::Link> Supports::links() const
  {
    std::vector<Link> list;
    for (const Spring &spring : springs)
      {
        Link link{spring.stiffness, spring.damping, spring.support, spring.layer, {}, {}};
        for (const auto &[point, sign] : {std::pair<int, double>{spring.a, 1.}, {spring.b, -1.}})
          if (point >= static_cast<int>(n_sleepers))
            for (const auto &[node, share] : ends[point - n_sleepers].nodes)
              link.nodes.emplace_back(node, sign * share);
          else if (point >= 0)
            link.sleepers.emplace_back(point, sign);
        list.push_back(link);
      }
    return list;
  }


  void Supports::serialize(Archive &archive)
  {
    archive.same_number(displacement, velocity, spring_force);
    archive.same(damper_work);
  }
} // namespace tread
