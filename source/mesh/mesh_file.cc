// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/base/text_file.h>
#include <tread/mesh/mesh_file.h>

#include "mesh_file_tears.h"
#include "mesh_file_words.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace tread
{
  // In the order of bottom and top, each counter-clockwise seen from above.
  const std::array<std::array<unsigned int, 4>, 6> faces_of_hexahedron{
    {{{0, 3, 2, 1}}, {{4, 5, 6, 7}}, {{0, 1, 5, 4}}, {{1, 2, 6, 5}}, {{2, 3, 7, 6}}, {{3, 0, 4, 7}}}};


  MeshInput::Named &MeshInput::named(const std::string &name, const unsigned int line)
  {
    const std::string lower = mesh_words::lower(name);
    for (Named &known : boundary)
      if (known.name == lower)
        return known;
    boundary.push_back({lower, line, {}, {}});
    return boundary.back();
  }


  void MeshInput::add_node(const long number, const dealii::Point<3> &place, const unsigned int line)
  {
    if (!nodes.emplace(number, Node{place, line}).second)
      throw TextError(line, "node " + std::to_string(number) + " is there already");
  }


  void MeshInput::pass_over(const std::string &name, const unsigned int line)
  {
    if (std::none_of(passed_over.begin(), passed_over.end(),
                     [&](const auto &known) { return known.first == name; }))
      passed_over.emplace_back(name, line);
  }


  MeshFile::Range MeshFile::range(const unsigned int direction) const
  {
    Range range{std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()};
    for (const dealii::Point<3> &p : vertices)
      range = {std::min(range.begin, p[direction]), std::max(range.end, p[direction])};
    return range;
  }


  namespace
  {
    using CellCorners =
      std::array<unsigned int, 8>;               // places in MeshFile::vertices, in the order of MeshInput
    using FaceKey = std::array<unsigned int, 4>; // of a face

    /// Six times the volume that three edges of a corner span.
    double spanned(const dealii::Point<3> &corner,
                   const dealii::Point<3> &a,
                   const dealii::Point<3> &b,
                   const dealii::Point<3> &c)
    {
      return dealii::cross_product_3d(a - corner, b - corner) * (c - corner);
    }

    std::string vertex_in_words(const dealii::Point<3> &p)
    {
      return text_in_mm(p[0]) + ", " + text_in_mm(p[1]) + ", " + text_in_mm(p[2]) + " mm";
    }

    /// From what the file says to what can be meshed.
    class CheckedMesh
    {
    public:
      CheckedMesh(const MeshInput &input, const std::string &file, const double unit)
        : input(input)
      {
        mesh.file    = file;
        mesh.volumes = input.volumes;
        add_vertices(unit);
        for (const MeshInput::Hexahedron &cell : input.hexahedra)
          add_cell(cell);
        check_all_used();
        check_apart();
        check_not_torn();
        for (const auto &named : input.boundary)
          add_named(named);
        for (const Boundary needed : {Boundary::contact, Boundary::support})
          check_there(needed);
        check_pieces_held();
        note_doubts();
      }

      MeshFile mesh;

    private:
      void add_vertices(const double unit)
      {
        if (input.hexahedra.empty())
          throw TextError(0, std::string("has no hexahedra: ") + mesh_words::make_hexahedra +
                               "; Gmsh leaves out volumes that belong to no physical group");
        constexpr double furthest = 1e6; // m
        for (const auto &[number, node] : input.nodes)
          {
            if (!(unit * node.place.norm() < furthest))
              throw TextError(node.line,
                              "node " + std::to_string(number) +
                                " lies more than 1000 km from the origin: its coordinates are damaged");
            place_of[number] = mesh.vertices.size();
            mesh.vertices.push_back(unit * node.place);
            numbers.push_back(number);
          }
        is_used.assign(mesh.vertices.size(), false);
      }

      unsigned int vertex(const long number, const unsigned int line) const
      {
        const auto found = place_of.find(number);
        if (found == place_of.end())
          throw TextError(line, "there is no node " + std::to_string(number));
        return found->second;
      }

      void add_cell(const MeshInput::Hexahedron &cell)
      {
        CellCorners corners;
        for (unsigned int v = 0; v < 8; ++v)
          {
            corners[v]          = vertex(cell.nodes[v], cell.line);
            is_used[corners[v]] = true;
          }
        if (std::set<unsigned int>(corners.begin(), corners.end()).size() < 8)
          throw TextError(
            cell.line,
            std::string("has one node twice in a hexahedron, which is a prism or a tetrahedron then: ") +
              mesh_words::make_hexahedra);
        check_volume(corners, cell.line);
        const unsigned int number = mesh.cells.size();
        piece_of.push_back(number);
        neighbours.emplace_back();
        neighbours.back().fill(none);
        for (unsigned int f = 0; f < 6; ++f)
          {
            const auto &face = faces_of_hexahedron[f];
            FaceKey     around;
            for (unsigned int v = 0; v < 4; ++v)
              around[v] = corners[face[v]];
            FaceKey key = around;
            std::sort(key.begin(), key.end());
            const auto [at, is_new] = faces.try_emplace(key, Found{around, number, f, true, cell.line});
            if (is_new)
              continue;
            Found &other = at->second;
            if (!std::exchange(other.is_boundary, false))
              throw TextError(cell.line,
                              "has a face that two other hexahedra share: some lie over each other");
            neighbours[number][f]                = other.cell;
            neighbours[other.cell][other.number] = number;
            piece_of[first_of_piece(number)]     = first_of_piece(other.cell);
          }
        mesh.cells.push_back(aligned(corners));
      }

      /// All corners of a cell span a positive volume, or none does where it is inside out.
      void check_volume(const CellCorners &c, const unsigned int line) const
      {
        static constexpr unsigned int neighbours[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                                          {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
        double                        least = 1., largest = -1.; // over the product of the edges
        unsigned int                  worst = 0;
        for (unsigned int v = 0; v < 8; ++v)
          {
            const dealii::Point<3> &p     = mesh.vertices[c[v]];
            double                  edges = 1.;
            for (const unsigned int n : neighbours[v])
              edges *= p.distance(mesh.vertices[c[n]]);
            const double share =
              spanned(p, mesh.vertices[c[neighbours[v][0]]], mesh.vertices[c[neighbours[v][1]]],
                      mesh.vertices[c[neighbours[v][2]]]) /
              std::max(edges, std::numeric_limits<double>::min());
            if (share < least)
              worst = v;
            least   = std::min(least, share);
            largest = std::max(largest, share);
          }
        constexpr double least_share = 0.02; // edges that lie in one plane within a degree
        if (largest < -least_share)
          throw TextError(
            line,
            "has a hexahedron that is inside out, at " + vertex_in_words(mesh.vertices[c[0]]) +
              ": the mesh is mirrored, or lists the upper nodes first; turn its orientation (Gmsh: 'Reverse "
              "mesh', or Physical Volume of a surface loop turned outwards)");
        if (!(least >= least_share))
          throw TextError(line, "has a hexahedron that is turned over or flat at its corner " +
                                  vertex_in_words(mesh.vertices[c[worst]]) +
                                  ": move its nodes, or mend their order");
      }

      /// deal.II's order, turned so that the first edges lie along x and the last ones along z as nearly as
      /// possible: what is along the path and what across matters at the contact surface.
      dealii::CellData<3> aligned(const CellCorners &c) const
      {
        static constexpr unsigned int lexicographic[8] = {0, 1, 3, 2, 4, 5, 7, 6};
        std::array<unsigned int, 8>   best{};
        double                        largest = -std::numeric_limits<double>::max();
        for (unsigned int x = 0; x < 3; ++x)
          for (unsigned int signs = 0; signs < 8; ++signs)
            for (const bool swapped : {false, true})
              {
                const unsigned int axes[3] = {x, (x + (swapped ? 2 : 1)) % 3, (x + (swapped ? 1 : 2)) % 3};
                const bool         is_odd  = (signs == 1 || signs == 2 || signs == 4 || signs == 7);
                if (swapped != is_odd)
                  continue; // a mirror image, and no turn
                std::array<unsigned int, 8> turned;
                for (unsigned int v = 0; v < 8; ++v)
                  {
                    unsigned int old = 0;
                    for (unsigned int d = 0; d < 3; ++d)
                      old |= ((v >> d & 1u) ^ (signs >> d & 1u)) << axes[d];
                    turned[v] = c[lexicographic[old]];
                  }
                if (const double now = alignment(turned); now > largest)
                  {
                    largest = now;
                    best    = turned;
                  }
              }
        dealii::CellData<3> cell;
        cell.vertices.assign(best.begin(), best.end());
        return cell;
      }

      /// Sum of the cosines between the cell's middle lines and the axes.
      double alignment(const std::array<unsigned int, 8> &v) const
      {
        double sum = 0.;
        for (unsigned int d = 0; d < 3; ++d)
          {
            dealii::Tensor<1, 3> line;
            for (unsigned int i = 0; i < 8; ++i)
              line += (i >> d & 1u ? 1. : -1.) * mesh.vertices[v[i]];
            sum += line[d] / line.norm();
          }
        return sum;
      }

      void check_all_used() const
      {
        const auto n = std::count(is_used.begin(), is_used.end(), false);
        if (n == 0)
          return;
        const std::size_t first  = std::find(is_used.begin(), is_used.end(), false) - is_used.begin();
        const long        number = numbers[first];
        throw TextError(input.nodes.at(number).line,
                        "node " + std::to_string(number) + " belongs to no hexahedron" +
                          (n > 1 ? ", as " + std::to_string(n - 1) + " others" : "") +
                          ": leave out what is no volume, such as the centres of arcs");
      }

      /// Nodes at one place that are not one node: pieces that look joined and are not.
      void check_apart() const
      {
        double shortest = std::numeric_limits<double>::max();
        for (const auto &cell : mesh.cells)
          for (unsigned int v = 0; v < 8; ++v)
            for (unsigned int d = 0; d < 3; ++d)
              if (!(v >> d & 1u))
                shortest = std::min(shortest, mesh.vertices[cell.vertices[v]].distance(
                                                mesh.vertices[cell.vertices[v | 1u << d]]));
        constexpr double          apart = 1e-3; // of the shortest edge
        std::vector<unsigned int> order(mesh.vertices.size());
        std::iota(order.begin(), order.end(), 0u);
        std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
          return mesh.vertices[a][0] < mesh.vertices[b][0];
        });
        // Among those of nearly the same x, in the order of y.
        for (std::size_t i = 0, end = 0; i < order.size(); i = end)
          {
            while (end < order.size() &&
                   (end == i ||
                    mesh.vertices[order[end]][0] - mesh.vertices[order[end - 1]][0] < apart * shortest))
              ++end;
            std::sort(order.begin() + i, order.begin() + end,
                      [&](const unsigned int a, const unsigned int b) {
                        return mesh.vertices[a][1] < mesh.vertices[b][1];
                      });
            for (std::size_t k = i; k < end; ++k)
              for (std::size_t m = k + 1;
                   m < end && mesh.vertices[order[m]][1] - mesh.vertices[order[k]][1] < apart * shortest; ++m)
                if (mesh.vertices[order[k]].distance(mesh.vertices[order[m]]) < apart * shortest)
                  refuse_twins(std::minmax(numbers[order[k]], numbers[order[m]]));
          }
      }

      [[noreturn]] void refuse_twins(const std::pair<long, long> &twins) const
      {
        throw TextError(
          input.nodes.at(twins.second).line,
          "nodes " + std::to_string(twins.first) + " and " + std::to_string(twins.second) +
            " lie at one place, " + vertex_in_words(mesh.vertices[place_of.at(twins.first)]) +
            ", and are not joined: merge them (Gmsh: Coherence Mesh), or leave a gap between two rails");
      }

      /// Cells that do not meet face to face: small faces against large ones, or pieces that lie in each
      /// other. Nothing joins them there, or there is more steel than there should be.
      void check_not_torn()
      {
        constexpr double within = 1e-3, close = 0.05; // of a cell
        auto strays = mesh_tears::stray_nodes(mesh.vertices, mesh.cells, neighbours, none, within, close);
        std::sort(strays.begin(), strays.end(), [](const auto &a, const auto &b) {
          return std::pair(a.vertex, a.cell) < std::pair(b.vertex, b.cell);
        });
        for (const mesh_tears::StrayNode &stray : strays)
          if (stray.beyond <= within)
            throw TextError(input.nodes.at(numbers[stray.vertex]).line,
                            "node " + std::to_string(numbers[stray.vertex]) + " at " +
                              vertex_in_words(mesh.vertices[stray.vertex]) +
                              (stray.beyond < -within ? " lies within" : " lies on a face or an edge of") +
                              " the hexahedron of line " + std::to_string(input.hexahedra[stray.cell].line) +
                              " and is no node of it" +
                              (stray.beyond < -within
                                 ? ": pieces lie in each other; move them, or mesh them as one"
                                 : ": the mesh is torn there; let whole faces meet, of one size and with "
                                   "common nodes, or leave "
                                   "a gap between two rails"));
        if (strays.empty())
          return;
        std::set<unsigned int> nodes;
        double                 widest = 0.;
        for (const mesh_tears::StrayNode &stray : strays)
          {
            nodes.insert(stray.vertex);
            widest = std::max(widest, stray.gap);
          }
        const unsigned int first = strays.front().vertex;
        note(input.nodes.at(numbers[first]).line,
             "node " + std::to_string(numbers[first]) + " at " + vertex_in_words(mesh.vertices[first]) +
               (nodes.size() > 1 ? " and " + std::to_string(nodes.size() - 1) + " others lie" : " lies") +
               " up to " + text_in_mm(widest) + " mm beside hexahedra that are not joined to " +
               (nodes.size() > 1 ? "them" : "it") +
               ": no force crosses such a gap, even when it closes; where there should be none, join the "
               "pieces by common nodes");
      }

      unsigned int first_of_piece(unsigned int cell)
      {
        while (piece_of[cell] != cell)
          cell = piece_of[cell] = piece_of[piece_of[cell]];
        return cell;
      }

      /// Each piece has faces of support, or it would fall.
      void check_pieces_held()
      {
        std::set<unsigned int> held;
        for (const NamedFace &face : mesh.faces)
          if (face.boundary == Boundary::support)
            held.insert(first_of_piece(face.cell));
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (held.count(first_of_piece(c)) == 0)
            refuse_piece(c);
      }

      [[noreturn]] void refuse_piece(const unsigned int cell)
      {
        const unsigned int piece = first_of_piece(cell);
        std::vector<bool>  is_of_piece(mesh.vertices.size(), false), is_of_others = is_of_piece;
        unsigned int       n = 0;
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          {
            const bool is_in = first_of_piece(c) == piece;
            n += is_in;
            for (const unsigned int v : mesh.cells[c].vertices)
              (is_in ? is_of_piece : is_of_others)[v] = true;
          }
        MeshFile alone;
        bool     touches = false;
        for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
          if (is_of_piece[v])
            {
              alone.vertices.push_back(mesh.vertices[v]);
              touches = touches || is_of_others[v];
            }
        std::string place;
        for (unsigned int d = 0; d < 3; ++d)
          place += std::string(d > 0 ? ", " : "") + "xyz"[d] + " = " + text_in_mm(alone.range(d).begin) +
                   " to " + text_in_mm(alone.range(d).end);
        throw TextError(input.hexahedra[cell].line,
                        "begins a piece of " + std::to_string(n) + (n > 1 ? " hexahedra" : " hexahedron") +
                          " that has no face named 'support', " + place + " mm: " +
                          (touches
                             ? "it hangs on the others by edges or corners only and would turn about them"
                             : "nothing would hold it") +
                          "; name what holds it, join it to the others by whole faces, or leave it out");
      }

      void note(const unsigned int line, const std::string &what)
      {
        mesh.doubts.push_back("'" + mesh.file + "' " + TextError(line, what).what());
      }

      void note_doubts()
      {
        for (const std::string &doubt : input.doubts)
          note(0, doubt);
        if (input.passed_over.empty())
          return;
        constexpr std::size_t most = 12;
        std::string           names;
        for (std::size_t i = 0; i < std::min(most, input.passed_over.size()); ++i)
          names += (i > 0 ? ", " : "") + input.passed_over[i].first + " (line " +
                   std::to_string(input.passed_over[i].second) + ")";
        if (input.passed_over.size() > most)
          names += " and " + std::to_string(input.passed_over.size() - most) + " more";
        note(0,
             "is read for its cells and the names of its faces alone; material, loads, what is held and all "
             "else are those of the scene. Passed over: " +
               names);
      }

      struct Found
      {
        FaceKey      around;       ///< counter-clockwise from outside
        unsigned int cell, number; ///< of the face among the cell's
        bool         is_boundary;
        unsigned int line; ///< of the cell
      };

      void add_named(const MeshInput::Named &named)
      {
        static const std::vector<std::string> known{"contact", "support", "end", "symmetry", "free"};
        if (std::find(known.begin(), known.end(), named.name) == known.end())
          throw TextError(
            named.line,
            "'" + named.name +
              "' is no name of a boundary; those are contact, support, end, symmetry and free (faces "
              "without a name are free)");
        const std::size_t before = n_named;
        for (const MeshInput::Quadrilateral &face : named.faces)
          add_face(face, named.name);
        std::set<unsigned int> members;
        for (const long number : named.nodes)
          members.insert(vertex(number, named.line));
        for (const auto &[key, face] : faces)
          if (face.is_boundary &&
              std::all_of(key.begin(), key.end(), [&](const unsigned int v) { return members.count(v) > 0; }))
            name_face(key, face, named.name, named.line);
        if (n_named == before && named.name != "free")
          throw TextError(named.line, "'" + named.name +
                                        "' names no face: nodes name a face whose four are in their set");
      }

      void add_face(const MeshInput::Quadrilateral &quadrilateral, const std::string &name)
      {
        FaceKey key;
        for (unsigned int v = 0; v < 4; ++v)
          key[v] = vertex(quadrilateral.nodes[v], quadrilateral.line);
        std::sort(key.begin(), key.end());
        const auto found = faces.find(key);
        if (found == faces.end() || !found->second.is_boundary)
          throw TextError(quadrilateral.line,
                          "has a face of '" + name + "' that is " +
                            (found == faces.end() ? "no face of a hexahedron" : "between two hexahedra") +
                            ", and not on the boundary");
        name_face(key, found->second, name, quadrilateral.line);
      }

      void name_face(const FaceKey &key, const Found &face, const std::string &name, const unsigned int line)
      {
        const auto [at, is_new] = name_of.emplace(key, name);
        ++n_named;
        if (!is_new && at->second != name)
          throw TextError(line, "has a face that is both '" + at->second + "' and '" + name + "'");
        if (is_new && name != "free")
          mesh.faces.push_back({face.around, face.cell, meaning(name, face, line)});
      }

      /// Nodes of the boundary are guided along one of the axes.
      Boundary meaning(const std::string &name, const Found &face, const unsigned int line) const
      {
        if (name == "contact")
          return Boundary::contact;
        if (name == "support")
          return Boundary::support;
        constexpr double     least_cosine = 0.9998; // a degree
        dealii::Tensor<1, 3> normal =
          dealii::cross_product_3d(mesh.vertices[face.around[2]] - mesh.vertices[face.around[0]],
                                   mesh.vertices[face.around[3]] - mesh.vertices[face.around[1]]);
        normal /= normal.norm();
        if (std::abs(normal[0]) >= least_cosine)
          return Boundary::end;
        if (name == "symmetry" && std::abs(normal[1]) >= least_cosine)
          return Boundary::side;
        throw TextError(line, "has a face of '" + name + "' at " +
                                vertex_in_words(mesh.vertices[face.around[0]]) +
                                " that is not at right angles to x" + (name == "symmetry" ? " or y" : "") +
                                ": its nodes could not slide along it");
      }

      void check_there(const Boundary boundary) const
      {
        if (std::any_of(mesh.faces.begin(), mesh.faces.end(),
                        [&](const NamedFace &face) { return face.boundary == boundary; }))
          return;
        std::string names;
        for (const MeshInput::Named &named : input.boundary)
          names += (names.empty() ? "" : ", ") + ("'" + named.name + "'");
        throw TextError(
          0, std::string("has no faces named '") + (boundary == Boundary::contact ? "contact" : "support") +
               "': name the " + (boundary == Boundary::contact ? "running surface" : "faces that are held") +
               " so, by a physical surface (Gmsh) or a set; it has " + (names.empty() ? "no names" : names));
      }

      const MeshInput                         &input;
      std::map<long, unsigned int>             place_of; // of a node, by its number
      std::vector<long>                        numbers;  // and back
      std::vector<bool>                        is_used;
      std::map<FaceKey, Found>                 faces;
      std::map<FaceKey, std::string>           name_of;
      std::size_t                              n_named = 0; ///< faces so far
      static constexpr unsigned int            none    = std::numeric_limits<unsigned int>::max();
      std::vector<std::array<unsigned int, 6>> neighbours; // cells behind the faces of each; or none
      std::vector<unsigned int> piece_of; // another cell of the same piece; the first one: itself
    };

    /// The first line below $MeshFormat has the version, the kind of file and a size.
    void refuse_binary(const std::string &file)
    {
      std::ifstream stream(file, std::ios::binary);
      std::string   format, version;
      int           kind = 0;
      if (stream >> format >> version >> kind && format == "$MeshFormat" && kind != 0)
        throw TextError(2, "is a binary file: write it as ASCII (Gmsh: Mesh.Binary = 0)");
    }

    MeshInput read_as_its_ending_says(const std::string &file)
    {
      const std::string ending = mesh_words::lower(std::filesystem::path(file).extension().string());
      if (ending == ".msh")
        {
          refuse_binary(file);
          return read_gmsh(read_lines(file));
        }
      if (ending == ".inp")
        return read_abaqus(read_lines(file));
      if (ending == ".k" || ending == ".key")
        return read_ls_dyna(read_lines(file));
      throw TextError(0, "is of no format that is read: .msh of Gmsh, .inp of Abaqus, .k or .key of LS-DYNA");
    }

    /// Cells of the volumes of this name have this other material. @throws TextError
    void give_material(MeshFile &mesh, const std::string &name, const unsigned int number)
    {
      bool        is_there = false;
      std::string all;
      for (const MeshVolume &volume : mesh.volumes)
        {
          if (!volume.cells.empty())
            all += (all.empty() ? "'" : ", '") + volume.name + "'";
          if (mesh_words::lower(volume.name) != mesh_words::lower(name))
            continue;
          for (const unsigned int c : volume.cells)
            {
              dealii::types::material_id &id = mesh.cells[c].material_id;
              if (id != 0 && id != number)
                throw TextError(0, "has a hexahedron in '" + volume.name +
                                     "' to which 'Rail/Materials' gives two "
                                     "materials, by another volume as well");
              id       = number;
              is_there = true;
            }
        }
      if (!is_there)
        throw TextError(0, "has no hexahedra in a volume '" + name +
                             "', to which 'Rail/Materials' gives a material; " +
                             (all.empty() ? "its volumes have no names" : "it has " + all));
    }

    /// Hexahedra to which the file gives unlike materials have unlike ones. @throws TextError
    void check_materials(const MeshFile &mesh)
    {
      std::map<unsigned int, const MeshVolume *> first;
      for (const MeshVolume &volume : mesh.volumes)
        if (!volume.material.empty())
          for (const unsigned int c : volume.cells)
            if (const MeshVolume &other =
                  *first.try_emplace(mesh.cells[c].material_id, &volume).first->second;
                other.material != volume.material)
              {
                const auto [earlier, later] = std::minmax(
                  volume, other, [](const MeshVolume &a, const MeshVolume &b) { return a.line < b.line; });
                throw TextError(later.line, "gives the material '" + later.material + "' to hexahedra of '" +
                                              later.name + "', and line " + std::to_string(earlier.line) +
                                              " gives '" + earlier.material + "' to those of '" +
                                              earlier.name + "': " + mesh_words::one_steel);
              }
    }
  } // namespace


  MeshVolume &MeshInput::volume(const std::string &name)
  {
    const auto found =
      std::find_if(volumes.begin(), volumes.end(), [&](const MeshVolume &v) { return v.name == name; });
    return found != volumes.end() ? *found : volumes.emplace_back(MeshVolume{name, {}, {}, 0});
  }


  void MeshInput::give_material(const std::string &volume,
                                const std::string &material,
                                const unsigned int line)
  {
    MeshVolume &own = this->volume(volume);
    if (!own.material.empty() && own.material != material)
      throw TextError(line, "gives the material '" + material + "' to '" + volume + "', to which line " +
                              std::to_string(own.line) + " gives '" + own.material + "'");
    own.material = material;
    own.line     = line;
  }


  MeshFile read_mesh_file(const std::string              &file,
                          const double                    unit,
                          const std::vector<std::string> &other_materials)
  {
    try
      {
        MeshFile mesh = CheckedMesh(read_as_its_ending_says(file), file, unit).mesh;
        for (unsigned int k = 0; k < other_materials.size(); ++k)
          give_material(mesh, other_materials[k], k + 1);
        check_materials(mesh);
        return mesh;
      }
    catch (const TextError &error)
      {
        throw InputError("'" + file + "' " + error.what());
      }
  }
} // namespace tread
