// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/contact/contact_surfaces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace tread
{
  namespace
  {
    /// Body and position in nm: a name that does not depend on the number of ranks.
    using Key = std::array<long long, 4>;

    // Flat lists that deal.II can send.
    using SentFace = std::array<long long, 16>; ///< body, left out or not, four positions in nm, edge along,
                                                ///< corners on a side
    using SentHangingNode = std::array<long long, 12>; ///< keys of the node and its two parents

    /// The first two corners of a face's cell lie on an edge along the path: the first of the face's two
    /// edges that is nearer to that direction, 0 or 1.
    unsigned int edge_along(const Mesh &mesh, const Mesh::Face &face)
    {
      const auto &cell  = mesh.cells[face.cell].nodes;
      const auto  along = mesh.nodes[cell[1]] - mesh.nodes[cell[0]];
      double      cosine[2];
      for (unsigned int e = 0; e < 2; ++e)
        {
          const auto edge = mesh.nodes[face.nodes[e + 1]] - mesh.nodes[face.nodes[e]];
          cosine[e]       = std::abs(along * edge) / edge.norm();
        }
      return cosine[1] > cosine[0];
    }

    /// The contact faces of this rank's cells, and the nodes that hang on an edge across the path.
    void list_faces(const Mesh &mesh, std::vector<SentFace> &faces, std::vector<SentHangingNode> &hanging)
    {
      std::vector<const Mesh::HangingNode *> hangs(mesh.nodes.size(), nullptr);
      for (const Mesh::HangingNode &h : mesh.hanging_nodes)
        hangs[h.node] = &h;

      // A face whose edge lies on a plane of symmetry belongs to the cell that has the plane's face too.
      std::set<unsigned int> on_side;
      for (const Mesh::Face &face : mesh.faces)
        if (face.boundary == Boundary::side)
          on_side.insert(face.nodes.begin(), face.nodes.end());

      for (const Mesh::Face &face : mesh.faces)
        if (face.boundary == Boundary::contact)
          {
            SentFace entry{};
            entry[0]          = face.body;
            entry[14]         = edge_along(mesh, face);
            const auto &cell  = mesh.cells[face.cell].nodes;
            const auto  along = mesh.nodes[cell[1]] - mesh.nodes[cell[0]];
            for (unsigned int v = 0; v < 4; ++v)
              {
                const unsigned int node = face.nodes[v];
                const Key          key  = mesh.node_key(node);
                for (unsigned int d = 0; d < 3; ++d)
                  entry[2 + 3 * v + d] = key[1 + d];
                if (on_side.count(node) > 0)
                  entry[15] |= 1 << v;
                if (!hangs[node])
                  continue;
                const std::set<unsigned int> parents(hangs[node]->parents.begin(),
                                                     hangs[node]->parents.end());
                const auto edge = mesh.nodes[*parents.rbegin()] - mesh.nodes[*parents.begin()];
                if (parents.size() == 2 && std::abs(along * edge) < 0.5 * along.norm() * edge.norm())
                  {
                    const Key names[3] = {key, mesh.node_key(*parents.begin()),
                                          mesh.node_key(*parents.rbegin())};
                    hanging.emplace_back();
                    for (unsigned int k = 0; k < 12; ++k)
                      hanging.back()[k] = names[k / 4][k % 4];
                  }
                else
                  entry[1] = 1;
              }
            faces.push_back(entry);
          }
    }

    /// Beyond an edge along the path that only one face has, nothing can be touched. Where one surface ends
    /// on a plane of symmetry there is nothing beyond to be touched, but its own image: the edge there, and
    /// those of the other surface on or beyond the plane, are no rims.
    void mark_rims(const std::vector<ContactSurfaces::Face> &faces,
                   const std::set<unsigned int>             &on_side,
                   std::vector<ContactSurfaces::Node>       &nodes)
    {
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> n_faces;
      for (const ContactSurfaces::Face &face : faces)
        for (const unsigned int v : {face.edge_along, face.edge_along + 2})
          ++n_faces[std::minmax(face.nodes[v], face.nodes[(v + 1) % 4])];
      constexpr double tolerance = 1e-6; // m
      double           least = -std::numeric_limits<double>::max(), most = -least;
      for (const unsigned int i : on_side)
        (nodes[i].reference[1] < 0. ? least : most) = nodes[i].reference[1];
      const auto is_within = [&](const unsigned int i) {
        return nodes[i].reference[1] > least + tolerance && nodes[i].reference[1] < most - tolerance;
      };
      for (const auto &[ends, count] : n_faces)
        if (count == 1 && (is_within(ends.first) || is_within(ends.second)))
          nodes[ends.first].at_rim = nodes[ends.second].at_rim = true;
    }
  } // namespace


  ContactSurfaces::ContactSurfaces(const Mesh &mesh)
    : comm(mesh.comm)
  {
    std::vector<SentFace>        own_faces;
    std::vector<SentHangingNode> own_hanging;
    list_faces(mesh, own_faces, own_hanging);

    std::vector<SentFace> sorted;
    for (const auto &list : dealii::Utilities::MPI::all_gather(comm, own_faces))
      sorted.insert(sorted.end(), list.begin(), list.end());
    std::sort(sorted.begin(), sorted.end());

    std::map<Key, unsigned int> number;
    for (const auto &entry : sorted)
      for (unsigned int v = 0; v < 4; ++v)
        number[{{entry[0], entry[2 + 3 * v], entry[3 + 3 * v], entry[4 + 3 * v]}}] = 0;
    unsigned int n = 0;
    for (auto &[key, i] : number)
      i = n++;

    nodes.resize(n);
    for (const auto &[key, i] : number)
      nodes[i] = {static_cast<unsigned int>(key[0]), false, -1, -1, Vector3{}};
    std::map<unsigned int, std::array<unsigned int, 2>> parents_of;
    std::set<unsigned int> without_parents; // on an edge that is no longer in reach
    for (const auto &list : dealii::Utilities::MPI::all_gather(comm, own_hanging))
      for (const auto &names : list)
        {
          const auto find = [&](const unsigned int k) {
            return number.find({{names[4 * k], names[4 * k + 1], names[4 * k + 2], names[4 * k + 3]}});
          };
          const auto node = find(0), a = find(1), b = find(2);
          if (a == number.end() || b == number.end())
            without_parents.insert(node->second);
          else
            parents_of[node->second] = {std::min(a->second, b->second), std::max(a->second, b->second)};
        }
    for (const auto &[node, parents] : parents_of)
      hanging_nodes.push_back({node, parents});

    std::set<unsigned int> on_side;
    for (const auto &entry : sorted)
      {
        Face face;
        face.body       = entry[0];
        face.edge_along = entry[14];
        for (unsigned int v = 0; v < 4; ++v)
          {
            face.nodes[v] = number.at({{entry[0], entry[2 + 3 * v], entry[3 + 3 * v], entry[4 + 3 * v]}});
            if (entry[15] >> v & 1)
              on_side.insert(face.nodes[v]);
          }
        if (entry[1] == 0 && std::none_of(face.nodes.begin(), face.nodes.end(),
                                          [&](const unsigned int i) { return without_parents.count(i) > 0; }))
          faces.push_back(face);
        else
          for (const unsigned int i : face.nodes)
            nodes[i].at_rim = true;
      }

    // Also copies of contact nodes whose faces belong to other ranks.
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (const auto entry = number.find(mesh.node_key(i)); entry != number.end())
        nodes[entry->second].local = i;

    std::vector<unsigned int> own;
    for (unsigned int i = 0; i < n; ++i)
      if (nodes[i].local >= 0 && mesh.shared_nodes.is_owned(nodes[i].local))
        own.push_back(i);
    nodes_of_rank = dealii::Utilities::MPI::all_gather(comm, own);
    for (unsigned int rank = 0; rank < nodes_of_rank.size(); ++rank)
      for (const unsigned int i : nodes_of_rank[rank])
        nodes[i].owner = rank;
    NodalField           reference(mesh.nodes.size());
    std::vector<Vector3> rows;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      reference[i] = Vector3{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
    replicate(reference.data(), rows);
    for (unsigned int i = 0; i < n; ++i)
      nodes[i].reference = rows[i];

    mark_rims(faces, on_side, nodes);
  }


  void ContactSurfaces::replicate(const Vector3 *field, std::vector<Vector3> &rows) const
  {
    rows.resize(nodes.size());
    const unsigned int n_ranks   = nodes_of_rank.size(),
                       this_rank = dealii::Utilities::MPI::this_mpi_process(comm);
    std::vector<double> send, receive(3 * nodes.size());
    std::vector<int>    counts(n_ranks), offsets(n_ranks);
    for (unsigned int rank = 0, offset = 0; rank < n_ranks; ++rank)
      {
        counts[rank]  = 3 * nodes_of_rank[rank].size();
        offsets[rank] = offset;
        offset += counts[rank];
      }
    for (const unsigned int i : nodes_of_rank[this_rank])
      for (unsigned int d = 0; d < 3; ++d)
        send.push_back(field[nodes[i].local][d]);
    MPI_Allgatherv(send.data(), send.size(), MPI_DOUBLE, receive.data(), counts.data(), offsets.data(),
                   MPI_DOUBLE, comm);
    const double *value = receive.data();
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      for (const unsigned int i : nodes_of_rank[rank])
        {
          rows[i] = Vector3{value[0], value[1], value[2], 0.};
          value += 3;
        }
  }
} // namespace tread
