// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_mesh_file_h
#define tread_mesh_mesh_file_h

#include <tread/mesh/body.h>

#include <deal.II/base/point.h>
#include <deal.II/grid/tria_description.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tread
{
  /// What the boundary of a mesh from a file is named for.
  struct NamedFace
  {
    std::array<unsigned int, 4> vertices; ///< around the face, counter-clockwise seen from outside
    unsigned int                cell;
    Boundary                    boundary;
  };

  /// A group of hexahedra with a name.
  struct MeshVolume
  {
    std::string               name;
    std::vector<unsigned int> cells;
    std::string               material; ///< that the file gives to it; empty: none
    unsigned int              line = 0; ///< where it does
  };

  /// Hexahedra of the user's own, checked: all cells have positive volume at all corners, each vertex belongs
  /// to one, no two vertices lie at one place, none lies within a cell or on a face that is not its own, the
  /// named faces are on the boundary, and each piece has faces of support. Lengths in m.
  struct MeshFile
  {
    std::string                      file;
    std::vector<dealii::Point<3>>    vertices;
    std::vector<dealii::CellData<3>> cells; ///< deal.II's (lexicographic) order, the first edge along x and
                                            ///< the last along z as nearly as the cell's shape allows
    std::vector<NamedFace>   faces;         ///< contact, support, end, side
    std::vector<MeshVolume>  volumes;
    std::vector<std::string> doubts; ///< what the user should know of it: one line each, with the file's name

    /// Range of the vertices in a direction.
    struct Range
    {
      double begin, end;
    };
    Range range(const unsigned int direction) const;
  };

  /// Read a mesh of Gmsh (.msh, ASCII of the versions 2.2 and 4.1), Abaqus (.inp) or LS-DYNA (.k, .key).
  /// deal.II's GridIn (9.4.1) is not used: it has no names of Gmsh's physical groups, turns cells that are
  /// inside out and leaves out nodes without a cell in silence, loses surfaces of Abaqus, and knows no
  /// LS-DYNA and no place in the file.
  /// @param unit of the file's lengths, m
  /// @param other_materials names of volumes whose cells have the first, the second ... other material than
  /// the rail's own, as material_id of the cells
  /// @throws InputError of one line with the place in the file and what to do
  MeshFile read_mesh_file(const std::string              &file,
                          const double                    unit,
                          const std::vector<std::string> &other_materials = {});


  /// What a mesh file says, before it is checked. Numbers of nodes and elements are the file's own.
  struct MeshInput
  {
    /// Where something stands in the file.
    struct Node
    {
      dealii::Point<3> place; ///< in the file's unit
      unsigned int     line;
    };
    struct Hexahedron
    {
      std::array<long, 8> nodes; ///< bottom and top, each counter-clockwise seen from above
      unsigned int        line;
    };
    struct Quadrilateral
    {
      std::array<long, 4> nodes;
      unsigned int        line;
    };
    /// What a name of the boundary is given to: faces, or nodes of which those of whole faces count.
    struct Named
    {
      std::string                name;
      unsigned int               line;
      std::vector<Quadrilateral> faces;
      std::vector<long>          nodes;
    };

    std::map<long, Node>    nodes;
    std::vector<Hexahedron> hexahedra;
    std::vector<Named>      boundary;
    std::vector<MeshVolume> volumes;
    /// What was passed over because it cannot change the answer, each name once with its first line.
    std::vector<std::pair<std::string, unsigned int>> passed_over;
    std::vector<std::string>                          doubts; ///< one line each, without the file's name

    /// The named part, made where there is none yet.
    Named      &named(const std::string &name, const unsigned int line);
    MeshVolume &volume(const std::string &name);
    /// Hexahedra of this volume have this material. @throws TextError if they have another one
    void give_material(const std::string &volume, const std::string &material, const unsigned int line);
    /// @throws TextError if the number is taken
    void add_node(const long number, const dealii::Point<3> &place, const unsigned int line);
    void pass_over(const std::string &name, const unsigned int line);
  };

  /// Corners of a hexahedron's face, counter-clockwise seen from outside, as in MeshInput: bottom, top, and
  /// the four around, which is the order of Abaqus' faces S1 to S6.
  extern const std::array<std::array<unsigned int, 4>, 6> faces_of_hexahedron;

  /// Formats, by lines of the file. @throws TextError
  MeshInput read_gmsh(const std::vector<std::string> &lines);
  MeshInput read_abaqus(const std::vector<std::string> &lines);
  MeshInput read_ls_dyna(const std::vector<std::string> &lines);
} // namespace tread

#endif
