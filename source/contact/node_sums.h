// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_node_sums_h
#define tread_contact_node_sums_h

#include <tread/base/gathered.h>
#include <tread/contact/mortar.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace tread
{
  /// What the faces around a slave node add up to.
  struct NodeSum
  {
    unsigned int                                    node = 0;
    Vector3                                         normal{};
    double                                          area = 0., covered = 0., whole = 0.; ///< m^2
    boost::container::small_vector<MortarEntry, 32> entries;

    void add(const NodeSum &other, const double share)
    {
      area += share * other.area;
      covered += share * other.covered;
      whole += share * other.whole;
      for (const MortarEntry &entry : other.entries)
        add(entry.node, share * entry.coefficient);
    }

    void add(const unsigned int node, const double value)
    {
      for (MortarEntry &entry : entries)
        if (entry.node == node)
          {
            entry.coefficient += value;
            return;
          }
      entries.push_back({node, value});
    }
  };

  /// The sums of all nodes that have one.
  class NodeSums
  {
  public:
    explicit NodeSums(const unsigned int n_nodes)
      : number(n_nodes, -1)
    {
    }

    bool has(const unsigned int node) const
    {
      return number[node] >= 0;
    }

    /// That of a node; an empty one is made if it has none, and others may then move.
    NodeSum &of(const unsigned int node)
    {
      if (number[node] < 0)
        {
          number[node] = sums.size();
          sums.emplace_back();
          sums.back().node = node;
        }
      return sums[number[node]];
    }

    /// Add to that of the same node.
    void add(const NodeSum &part)
    {
      NodeSum &sum = of(part.node);
      sum.normal += part.normal;
      sum.add(part, 1.);
    }

  private:
    std::vector<NodeSum> sums;
    std::vector<int>     number; ///< in sums, -1: none
  };


  /// What single slave faces contribute to the sums of their nodes. It is added in the order of the faces,
  /// whichever ranks integrate them, so that sums are the same on any number of ranks.
  class FaceSums
  {
  public:
    /// Those of the next face of this rank, whose number must be larger than those before, for its nodes.
    std::array<NodeSum, 4> &begin_face(const unsigned int face, const std::array<unsigned int, 4> &nodes)
    {
      faces.push_back({face, {}});
      for (unsigned int k = 0; k < 4; ++k)
        faces.back().of_node[k].node = nodes[k];
      return faces.back().of_node;
    }

    /// Add what all ranks have. Collective.
    void add_to(NodeSums &sums, const MPI_Comm comm) const
    {
      // A face's number, and for each of its nodes 8 numbers and the entries.
      const std::vector<double>                            all = gathered(packed(), comm);
      std::vector<std::pair<unsigned int, const double *>> begins;
      for (const double *value = all.data(); value < all.data() + all.size();)
        {
          begins.emplace_back(value[0], value + 1);
          ++value;
          for (unsigned int k = 0; k < 4; ++k)
            value += size_of(value);
        }
      std::sort(begins.begin(), begins.end());
      for (auto [face, value] : begins)
        for (unsigned int k = 0; k < 4; ++k, value += size_of(value))
          sums.add(unpacked(value));
    }

  private:
    std::vector<double> packed() const
    {
      std::vector<double> numbers;
      for (const OfFace &face : faces)
        {
          numbers.push_back(face.number);
          for (const NodeSum &part : face.of_node)
            {
              numbers.insert(numbers.end(),
                             {double(part.node), part.normal[0], part.normal[1], part.normal[2], part.area,
                              part.covered, part.whole, double(part.entries.size())});
              for (const MortarEntry &entry : part.entries)
                numbers.insert(numbers.end(), {double(entry.node), entry.coefficient});
            }
        }
      return numbers;
    }

    static std::size_t size_of(const double *value)
    {
      return 8 + 2 * static_cast<std::size_t>(value[7]);
    }

    static NodeSum unpacked(const double *value)
    {
      NodeSum part;
      part.node    = value[0];
      part.normal  = Vector3{value[1], value[2], value[3], 0.};
      part.area    = value[4];
      part.covered = value[5];
      part.whole   = value[6];
      for (const double *entry = value + 8; entry < value + size_of(value); entry += 2)
        part.entries.push_back({static_cast<unsigned int>(entry[0]), entry[1]});
      return part;
    }

    struct OfFace
    {
      unsigned int           number;
      std::array<NodeSum, 4> of_node;
    };
    std::vector<OfFace> faces;
  };
} // namespace tread

#endif
