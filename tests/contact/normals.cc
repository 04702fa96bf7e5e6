// SPDX-License-Identifier: LGPL-2.1-or-later
// Two blocks meet at a curved interface, where cells of two sizes leave nodes hanging, and turn together:
// between two searches the normals of the contact turn with the surface, and the search is due again after a
// small angle.
#include <tread/contact/contact.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "fields.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>

using namespace tread;
using tests::size;
using dealii::Point;

namespace contact_normals
{
  constexpr double edge = 0.02, radius = 0.05; // of the blocks and of the interface, m

  /// A half of the interface has cells of half the size.
  Body curved(Body body)
  {
    body.wanted_cell_size = [](const Point<3> &p) {
      return p[0] < 0.49 * edge && std::abs(p[2]) < 0.26 * edge ? 0.15 * edge : edge;
    };
    body.to_space = [](const Point<3> &p) {
      const double x = p[0] - 0.5 * edge, y = p[1] - 0.5 * edge;
      return Point<3>(p[0], p[1], p[2] - (x * x + y * y) / (2. * radius));
    };
    return body;
  }

  /// Contact alone, without cells that resist: all nodes have a mass of 1 kg.
  struct Blocks
  {
    static constexpr double time_step = 1e-3; // s

    Mesh       mesh;
    Contact    contact;
    NodalField x;

    Blocks()
      : mesh(MPI_COMM_WORLD,
             {curved(tests::make_box("lower",
                                     Point<3>(0., 0., -edge),
                                     Point<3>(edge, edge, 0.),
                                     {{4, 4, 4}},
                                     {{tests::Side::top, Boundary::contact}})),
              curved(tests::make_box("upper",
                                     Point<3>(0., 0., 0.),
                                     Point<3>(edge, edge, edge),
                                     {{4, 4, 4}},
                                     {{tests::Side::bottom, Boundary::contact}}))})
      , contact(mesh, ContactParameters(), std::make_shared<CoulombFriction>(0.))
      , x(tests::reference_positions(mesh))
    {
      std::vector<double> inverse_masses(mesh.nodes.size(), 1.);
      for (const Mesh::HangingNode &h : mesh.hanging_nodes)
        inverse_masses[h.node] = 0.;
      contact.set_inverse_masses(inverse_masses);
    }

    /// Velocities of a common rotation (rad/s), and of the upper block downwards, so that the blocks push
    /// each other, but so slowly that this turns no face.
    NodalField velocities(const Vector3 rotation) const
    {
      constexpr double approach = 1e-9; // m/s
      NodalField       v(x.size());
      for (unsigned int i = 0; i < x.size(); ++i)
        v[i] = cross(rotation, x[i]) - Vector3{0., 0., mesh.node_bodies[i] == 1 ? approach : 0., 0.};
      return v;
    }

    void step(const NodalField &v, const double time_step = Blocks::time_step)
    {
      NodalField          force(x.size(), Vector3{});
      std::vector<double> nothing;
      contact.predict(v.data(), force.data(), time_step, nothing);
      contact.solve(time_step, force.data());
    }
  };

  /// The normal of a surface that moves linearly: of x + A x, by the cofactors of 1 + A.
  Vector3 turned(const Vector3 normal, const Vector3 angle)
  {
    const Vector3 columns[3] = {Vector3{1., 0., 0., 0.} + cross(angle, Vector3{1., 0., 0., 0.}),
                                Vector3{0., 1., 0., 0.} + cross(angle, Vector3{0., 1., 0., 0.}),
                                Vector3{0., 0., 1., 0.} + cross(angle, Vector3{0., 0., 1., 0.})};
    const Vector3 n = normal[0] * cross(columns[1], columns[2]) + normal[1] * cross(columns[2], columns[0]) +
                      normal[2] * cross(columns[0], columns[1]);
    return (1. / size(n)) * n;
  }
} // namespace contact_normals


TREAD_TEST(contact_normals)(tests::Check &check, const tests::Arguments &)
{
  for (const Vector3 rotation : {Vector3{}, Vector3{7., -4., 2., 0.}})
    {
      const std::string name = size(rotation) > 0. ? "blocks that turn: " : "blocks at rest: ";
      Blocks            blocks;
      const NodalField  v = blocks.velocities(rotation);
      blocks.contact.refresh(blocks.x.data(), v.data(), blocks.time_step);
      blocks.step(v);
      std::map<unsigned int, Vector3> at_search;
      for (const ContactNodeState &state : blocks.contact.active_nodes())
        at_search[state.node] = state.normal;

      // The normals follow within a few steps; the blocks wait for them.
      constexpr unsigned int moving = 12, waiting = 12;
      for (unsigned int n = 1; n < moving; ++n)
        blocks.step(v);
      const NodalField still = blocks.velocities(Vector3{});
      for (unsigned int n = 0; n < waiting; ++n)
        blocks.step(still);

      std::set<unsigned int> at_hanging;
      const auto            &surfaces = blocks.contact.surfaces;
      for (const ContactSurfaces::Face &face : surfaces.faces)
        for (const ContactSurfaces::HangingNode &h : surfaces.hanging_nodes)
          if (std::count(face.nodes.begin(), face.nodes.end(), h.node) > 0)
            at_hanging.insert(face.nodes.begin(), face.nodes.end());
      double       off      = 0.;
      unsigned int n_beside = 0;
      const auto   states   = blocks.contact.active_nodes();
      for (const ContactNodeState &state : states)
        {
          off = std::max(
            off, size(state.normal - turned(at_search.at(state.node), moving * blocks.time_step * rotation)));
          n_beside += at_hanging.count(state.node);
        }
      // Rows of 9 nodes in the fine half and of 5 in the other, where the size changes 4 hang.
      check.absolute(name + "nodes that push", states.size(), 4 * 9 + 3 * 5, 0.);
      check.that(name + "some of them are on faces with a hanging node", n_beside >= 9 + 5);
      // Impulses move nodes by 1e-11 m, over faces of 2.5 mm, but nearly all alike.
      check.below(name + "normals off those of the search, turned", off, 1e-10);
    }

  // Both blocks turn alike: no node comes nearer to the other side or slides on it. Seen along its normal, a
  // diagonal of a face rises by the angle times its length, which is sqrt(2) of an edge of the smallest faces
  // and twice as long on some others.
  Blocks                 blocks;
  const Vector3          rotation{7., -4., 0., 0.};
  const NodalField       v          = blocks.velocities(rotation);
  constexpr double       small_step = 5e-6; // s
  constexpr unsigned int most       = 1000;
  blocks.contact.refresh(blocks.x.data(), v.data(), small_step);
  blocks.step(v, small_step);
  blocks.contact.refresh(blocks.x.data(), v.data(), small_step);
  unsigned int n = 0;
  for (; n < most && !blocks.contact.refresh_due(); ++n)
    blocks.step(v, small_step);
  check.relative("blocks that turn: angle up to the next search, mrad", 1e3 * n * small_step * size(rotation),
                 1e3 * ContactParameters().turning / std::sqrt(2.), 0.2);
}
