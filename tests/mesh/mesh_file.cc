// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes from files: all formats give the same cells and names, as deal.II reads those that it can; what
// cannot be used is refused with its place; and the body that is made of one.
#include <tread/base/input_error.h>
#include <tread/mesh/mesh_rail.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>

#include "check.h"
#include "refined_body.h"
#include "temporary_folder.h"

#include <cmath>
#include <map>
#include <sstream>

using namespace tread;
using dealii::Point;

namespace mesh_file
{
  // Two cubes of 10 mm along x, in mm. Nodes i + 3 (j + 2 k) + 1.
  const std::string places[12] = {"0 -5 -10", "10 -5 -10", "20 -5 -10", "0 5 -10", "10 5 -10", "20 5 -10",
                                  "0 -5 0",   "10 -5 0",   "20 -5 0",   "0 5 0",   "10 5 0",   "20 5 0"};

  std::string with_commas(std::string text)
  {
    for (std::size_t at = text.find(' '); at != text.npos; at = text.find(' '))
      text.replace(at, 1, ",");
    return text;
  }

  std::string gmsh_old()
  {
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n2 1 \"contact\"\n2 2 "
                       "\"support\"\n2 3 \"end\"\n2 4 "
                       "\"symmetry\"\n3 7 \"rail steel\"\n$EndPhysicalNames\n$Nodes\n12\n";
    for (unsigned int i = 0; i < 12; ++i)
      text += std::to_string(i + 1) + " " + places[i] + "\n";
    return text + "$EndNodes\n$Elements\n9\n1 1 2 0 1 7 8\n2 3 2 1 1 7 8 11 10\n3 3 2 1 1 8 9 12 11\n4 3 2 2 "
                  "2 1 2 5 4\n5 3 2 2 2 2 3 6 5\n"
                  "6 3 2 3 3 1 4 10 7\n7 3 2 4 4 1 2 8 7\n8 5 2 7 7 1 2 5 4 7 8 11 10\n9 5 2 7 7 2 3 6 5 8 9 "
                  "12 11\n$EndElements\n";
  }

  std::string gmsh_new()
  {
    std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n2 1 \"contact\"\n2 2 "
                       "\"support\"\n2 3 \"end\"\n2 4 "
                       "\"symmetry\"\n3 7 \"rail steel\"\n$EndPhysicalNames\n$Entities\n1 1 4 1\n1 0 0 0 "
                       "0\n1 0 -5 0 20 -5 0 0 0\n21 0 -5 0 20 "
                       "5 0 1 1 1 1\n22 0 -5 -10 20 5 -10 1 2 0\n23 0 -5 -10 0 5 0 1 3 0\n24 0 -5 -10 10 -5 "
                       "0 1 4 0\n1 0 -5 -10 20 5 0 1 7 4 "
                       "21 22 23 24\n$EndEntities\n$Nodes\n2 12 1 12\n2 21 0 1\n7\n0 -5 0\n3 1 0 11\n";
    for (unsigned int i = 0; i < 12; ++i)
      text += i == 6 ? "" : std::to_string(i + 1) + "\n";
    for (unsigned int i = 0; i < 12; ++i)
      text += i == 6 ? "" : places[i] + "\n";
    return text +
           "$EndNodes\n$Elements\n6 9 1 9\n1 1 1 1\n1 7 8\n2 21 3 2\n2 7 8 11 10\n3 8 9 12 11\n2 22 3 2\n4 1 "
           "2 5 4\n5 2 3 6 5\n2 23 3 1\n6 "
           "1 4 10 7\n2 24 3 1\n7 1 2 8 7\n3 1 5 2\n8 1 2 5 4 7 8 11 10\n9 2 3 6 5 8 9 12 11\n$EndElements\n";
  }

  std::string abaqus()
  {
    std::string text = "*Heading\n a title\n** remark\n*Node\n";
    for (unsigned int i = 0; i < 12; ++i)
      text += std::to_string(i + 1) + ", " + with_commas(places[i]) + "\n";
    return text + "*Element, type=C3D8R, elset=steel\n1, 1,2,5,4,7,\n8,11,10\n2, "
                  "2,3,6,5,8,9,12,11\n*Element, type=S4, elset=Surface3\n11, "
                  "1,4,10,7\n*Elset, elset=end\n11\n*Elset, elset=all, generate\n1,2,1\n*Surface, "
                  "type=ELEMENT, name=Contact\nall, S2\n*Nset, "
                  "nset=support, generate\n1,6,1\n*Surface, name=symmetry\n1, S3\n*Material, "
                  "name=steel\n*Elastic\n 210000., 0.3\n";
  }

  std::string ls_dyna()
  {
    std::string text =
      "$ remark\n*KEYWORD\n*NODE\n$#   nid               x               y               z\n";
    for (unsigned int i = 0; i < 12; ++i)
      {
        std::istringstream in(places[i]);
        double             p[3];
        in >> p[0] >> p[1] >> p[2];
        char line[80];
        std::snprintf(line, sizeof line, "%8u%16.6f%16.6f%16.6f\n", i + 1, p[0], p[1], p[2]);
        text += line;
      }
    return text + "*PART\nrail steel\n         1         1         1\n*PART\nend\n         2         1       "
                  "  1\n*ELEMENT_SOLID\n       1       1       1       2       "
                  "5       4       7       8      11      10\n       2       1\n       2       3       6     "
                  "  5       8       9      12      "
                  "11\n*ELEMENT_SHELL\n      11       2       1       4      10       "
                  "7\n*SET_SEGMENT_TITLE\ncontact\n         1\n         7         8        11    "
                  "    10\n         8         9        12        11\n*SET_NODE_LIST_TITLE\nsupport\n         "
                  "2\n         1         2         3         4         5  "
                  "       6\n*SET_SEGMENT_TITLE\nsymmetry\n         4\n         1         2         8        "
                  " 7\n*MAT_ELASTIC\n1,7.85e-9\n*END\n";
  }

  void check_formats(tests::Check &check, const tests::TemporaryFolder &folder)
  {
    for (const auto &[name, text] : {std::pair("old.msh", gmsh_old()), std::pair("new.msh", gmsh_new()),
                                     std::pair("a.inp", abaqus()), std::pair("a.k", ls_dyna())})
      {
        const std::string                what = std::string(name) + ": ";
        const MeshFile                   mesh = read_mesh_file(folder.write(name, text), 1e-3);
        std::map<Boundary, unsigned int> n;
        double                           contact_z = 0.;
        for (const NamedFace &face : mesh.faces)
          {
            ++n[face.boundary];
            for (const unsigned int v : face.vertices)
              contact_z += face.boundary == Boundary::contact ? std::abs(mesh.vertices[v][2]) : 0.;
          }
        check.absolute(what + "cells", mesh.cells.size(), 2., 0.);
        check.absolute(what + "vertices", mesh.vertices.size(), 12., 0.);
        check.that(what + "contact, support, end, symmetry",
                   n[Boundary::contact] == 2 && n[Boundary::support] == 2 && n[Boundary::end] == 1 &&
                     n[Boundary::side] == 1);
        check.below(what + "height of the contact surface, mm", 1e3 * contact_z, 1e-9);
        check.relative(what + "length, mm", 1e3 * (mesh.range(0).end - mesh.range(0).begin), 20., 1e-12);
        check.that(what + "volume's name",
                   mesh.volumes.size() >= 1 &&
                     (mesh.volumes[0].name == "rail steel" || mesh.volumes[0].name == "all"));
        double volume = 0.;
        for (const auto &cell : mesh.cells)
          volume += dealii::GridTools::cell_measure<3>(mesh.vertices, cell.vertices);
        check.relative(what + "volume in deal.II's order, cm3", 1e6 * volume, 2., 1e-12);
      }
    // In m, and the names by number where there are none.
    std::string    numbers = gmsh_old();
    const auto     at      = numbers.find("$Physical");
    const MeshFile in_m =
      read_mesh_file(folder.write("numbers.msh", numbers.erase(at, numbers.find("$Nodes") - at)), 1.);
    check.relative("in m: length, m", in_m.range(0).end, 20., 1e-12);
    check.absolute("named by numbers: faces", in_m.faces.size(), 6., 0.);
    // deal.II's own reader of the same files.
    for (const char *name : {"old.msh", "new.msh"})
      {
        dealii::Triangulation<3> theirs;
        dealii::GridIn<3>        in(theirs);
        std::ifstream            stream(folder.path + "/" + name);
        in.read_msh(stream);
        const MeshFile ours = read_mesh_file(folder.path + "/" + name, 1.);
        double         off  = 0.;
        for (const Point<3> &p : ours.vertices)
          {
            double nearest = 1e300;
            for (const Point<3> &q : theirs.get_vertices())
              nearest = std::min(nearest, p.distance(q));
            off = std::max(off, nearest);
          }
        check.absolute(std::string(name) + " by deal.II: cells", ours.cells.size(), theirs.n_active_cells(),
                       0.);
        check.below(std::string(name) + " by deal.II: vertices off, mm", off, 1e-12);
      }
  }

  std::string replaced(std::string text, const std::string &from, const std::string &to)
  {
    const auto at = text.find(from);
    if (at == text.npos)
      throw std::logic_error("the text has no '" + from + "'");
    return text.replace(at, from.size(), to);
  }

  /// A further part behind the last one, below the same keyword.
  std::string with_third_part(const std::string &text)
  {
    return replaced(text, "*ELEMENT_SOLID", "pad\n         3         1         8\n*ELEMENT_SOLID");
  }

  /// Texts of a file with one place changed, and words of the line that refuses it.
  struct Fault
  {
    std::string name, file, from, to, words;
  };

  /// One of the two hexahedra in a volume of its own, to which the file gives another material.
  void check_materials(tests::Check &check, const tests::TemporaryFolder &folder)
  {
    const std::string gmsh = replaced(replaced(replaced(gmsh_old(), "$PhysicalNames\n5", "$PhysicalNames\n6"),
                                               "\"rail steel\"\n", "\"rail steel\"\n3 8 \"End post\"\n"),
                                      "9 5 2 7 7", "9 5 2 8 8");
    const std::string inp =
      replaced(abaqus(), "*Material, name=steel",
               "*Elset, elset=first\n1\n*Solid section, elset=first, material=steel\n*Elset, elset=\"End "
               "post\"\n2\n*Solid section, elset=\"end post\", material=nylon\n*Material, name=steel");
    const std::string k = replaced(
      replaced(ls_dyna(), "       2       1\n       2       3", "       2       3\n       2       3"),
      "*ELEMENT_SOLID", "*PART\nend post\n         3         1         8\n*ELEMENT_SOLID");
    const auto refusal = [&](const std::string &name, const std::vector<std::string> &others) {
      return tests::complaint<InputError>([&] { read_mesh_file(folder.path + "/" + name, 1e-3, others); });
    };
    const auto says = [&](const std::string &text, const std::string &words) {
      check.that(text, text.find(words) != text.npos);
    };
    for (const auto &[name, text] :
         {std::pair("two.msh", gmsh), std::pair("two.inp", inp), std::pair("two.k", k)})
      {
        const MeshFile mesh = read_mesh_file(folder.write(name, text), 1e-3, {"End Post"});
        check.that(std::string(name) + ": the second hexahedron has the other material",
                   mesh.cells[0].material_id == 0 && mesh.cells[1].material_id == 1);
        says(refusal(name, {"rubber"}), "has no hexahedra in a volume 'rubber'");
      }
    says(refusal("two.inp", {"end post", "all"}), "two materials");
    says(
      refusal("two.inp", {}),
      "gives the material 'nylon' to hexahedra of 'end post', and line 35 gives 'steel' to those of 'first'");
    says(refusal("two.k", {}), "gives the material '8' to hexahedra of 'end post', and line");
    // Two materials of one volume, and one of a set that is not there.
    folder.write("two.k", replaced(k, "*PART\nend post", "*PART\nrail steel"));
    says(refusal("two.k", {}), "gives the material '8' to 'rail steel', to which line");
    const std::string post = "*Solid section, elset=\"end post\", material=";
    folder.write("two.inp", replaced(inp, post, post + "rubber\n" + post));
    says(refusal("two.inp", {"end post"}), "gives the material 'nylon' to 'end post', to which line");
    folder.write("two.inp", replaced(inp, post, "*Solid section, elset=posts, material="));
    says(refusal("two.inp", {}), "gives a material to a set 'posts' that is not there");
    folder.write("two.inp", inp);
    says(refusal("two.inp", {"all"}), "one and the same of 'Rail/Materials'");
  }

  void check_refused(tests::Check &check, const tests::TemporaryFolder &folder)
  {
    const std::string        old = "old.msh", now = "new.msh", inp = "a.inp", k = "a.k";
    const std::vector<Fault> faults{
      {"tetrahedron", old, "9 5 2 7 7 2 3 6 5 8 9 12 11", "9 4 2 7 7 2 3 6 8",
       "line 37: is a tetrahedron: only hexahedra"},
      {"prism", old, "9 5 2 7 7 2 3 6 5 8 9 12 11", "9 6 2 7 7 2 3 6 8 9 12", "line 37: is a prism"},
      {"pyramid", old, "9 5 2 7 7", "9 7 2 7 7", "is a pyramid"},
      {"second order", old, "9 5 2 7 7", "9 12 2 7 7",
       "second order: only hexahedra with 8 nodes are read; mesh with first order"},
      {"triangle", now, "2 23 3 1\n6 1 4 10 7", "2 23 2 1\n6 1 4 10", "is a triangle"},
      {"no hexahedra", now, "3 1 5 2\n8 1 2 5 4 7 8 11 10\n9 2 3 6 5 8 9 12 11\n", "3 1 5 0\n",
       "has no hexahedra"},
      {"inside out", old, "1 2 5 4 7 8 11 10", "7 8 11 10 1 2 5 4",
       "line 36: has a hexahedron that is inside out"},
      {"twisted", old, "1 2 5 4 7 8 11 10", "1 2 4 5 7 8 11 10", "turned over or flat"},
      {"wedge", old, "1 2 5 4 7 8 11 10", "1 2 5 4 7 8 10 10", "one node twice"},
      {"node without a cell", old, "$Nodes\n12\n", "$Nodes\n13\n99 1 2 3\n",
       "line 14: node 99 belongs to no hexahedron"},
      {"node twice", old, "12 20 5 0", "11 20 5 0", "node 11 is there already"},
      {"no such node", old, "8 9 12 11\n$EndE", "8 9 13 11\n$EndE", "there is no node 13"},
      {"unknown name", old, "\"contact\"", "\"contcat\"",
       "line 6: 'contcat' is no name of a boundary; those are contact, support, end, symmetry and free"},
      {"no contact", old, "\"contact\"", "\"free\"", "has no faces named 'contact'"},
      {"no support", old, "\"support\"", "\"free\"",
       "has no faces named 'support': name the faces that are held so, by a physical surface (Gmsh) or a "
       "set; it has 'contact', 'free'"},
      {"number without a name beside names", old, "2 3 2 1 1 7 8 11 10", "2 3 2 55 1 7 8 11 10",
       "physical surface 55 without a name"},
      {"face within", old, "6 3 2 3 3 1 4 10 7", "6 3 2 3 3 2 5 11 8",
       "line 34: has a face of 'end' that is between two hexahedra"},
      {"face of nothing", old, "6 3 2 3 3 1 4 10 7", "6 3 2 3 3 1 4 11 8", "no face of a hexahedron"},
      {"face of two names", old, "6 3 2 3 3 1 4 10 7", "6 3 2 3 3 7 8 11 10", "both 'contact' and 'end'"},
      {"end that is not across", old, "7 3 2 4 4 1 2 8 7", "7 3 2 3 4 1 2 8 7",
       "not at right angles to x: its nodes"},
      {"binary", now, "4.1 0 8", "4.1 1 8", "line 2: is a binary file: write it as ASCII"},
      {"version", now, "4.1 0 8", "4 0 8", "has the version 4; 2.2 and 4.1 are read"},
      {"cut off", now, "8 1 2 5 4 7 8 11 10\n9 2 3 6 5 8 9 12 11\n$EndElements\n", "8 1 2 5 4 7 8 11 10\n",
       "cut off"},
      {"cut off among the nodes", old, "$EndNodes", "$Comments", "the file is cut off"},
      {"no number", old, "10 -5 -10", "10 -5 ten", "line 15: 'ten' is no number"},
      {"no mesh", old, "$MeshFormat", "solid", "a section's name"},
      {"Abaqus: tetrahedra", inp, "C3D8R", "C3D4",
       "line 17: has elements of the type 'C3D4', which are tetrahedra"},
      {"Abaqus: second order", inp, "C3D8R", "C3D20R", "mesh with first order"},
      {"Abaqus: another file", inp, "*Heading", "*Include, input=x", "*INCLUDE is not read"},
      {"Abaqus: face", inp, "all, S2", "all, S7", "'S7' is no face"},
      {"Abaqus: a surface of nothing", inp, "all, S2", ", S2", "names no element and no set of a surface"},
      {"Abaqus: set", inp, "all, S2", "every, S2", "there is no set 'every'"},
      {"Abaqus: name", inp, "nset=support", "nset=foot", "'foot' is no name of a boundary"},
      {"Abaqus: element twice", inp, "2, 2,3,6,5,8,9,12,11", "1, 2,3,6,5,8,9,12,11",
       "element 1 is there already"},
      {"Abaqus: range", inp, "1,6,1", "1,6,0", "no range of numbers"},
      {"Abaqus: a set in a set of nodes", inp, "nset=support, generate\n1,6,1", "nset=support\nfoot, 1",
       "names the set 'foot' in a set of nodes"},
      {"Abaqus: names no face", inp, "1,6,1", "1,2,1", "'support' names no face"},
      {"Abaqus: instance that is moved", inp, "*Element, type=C3D8R",
       "*Instance, name=a, part=b\n1.,0.,0.\n*Element, type=C3D8R", "moves an instance"},
      {"Abaqus: keyword on two lines", inp, "elset=all, generate", "elset=all,\ngenerate",
       "goes on in the next line"},
      {"Abaqus: cylinder coordinates", inp, "*Node\n", "*Node, system=C\n", "SYSTEM=C is not read"},
      {"Abaqus: volume with the name of a boundary", inp, "elset=steel", "elset=end",
       "the set 'end' has hexahedra"},
      {"Abaqus: set that is not there", inp, "*Elset, elset=end\n11", "*Elset, elset=end\nends, 11",
       "names the set 'ends', which is not there yet"},
      {"longer than its count: nodes", old, "$Nodes\n12\n", "$Nodes\n11\n",
       "line 25: goes on with '12 20 5 0' where $Nodes should end, which has 11 nodes"},
      {"longer than its count: elements", old, "$Elements\n9\n", "$Elements\n8\n",
       "where $Elements should end, which has 8 elements"},
      {"longer than its count: names", old, "$PhysicalNames\n5\n", "$PhysicalNames\n4\n",
       "where $PhysicalNames should end, which has 4 names"},
      {"longer than its count: a block of nodes", now, "$Nodes\n2 12 1 12", "$Nodes\n1 12 1 12",
       "where $Nodes should end"},
      {"longer than its count: blocks of elements", now, "$Elements\n6 9 1 9", "$Elements\n5 9 1 9",
       "where $Elements should end"},
      {"longer than its count: entities", now, "1 1 4 1\n", "1 1 4 0\n", "where $Entities should end"},
      {"negative count", old, "$Elements\n9\n", "$Elements\n-9\n", "'-9' is no number of elements"},
      {"section twice", old, "$Elements\n9\n", "$Nodes\n0\n$EndNodes\n$Elements\n9\n", "a second $Nodes"},
      {"far away", old, "10 -5 -10", "1e300 -5 -10", "line 15: node 2 lies more than 1000 km"},
      {"Abaqus: more numbers than lines", inp, "1,6,1", "1,6000000000,1",
       "'1' to '6000000000' is a range of more numbers than the file has lines"},
      {"Abaqus: sets of sets of sets", inp, "*Elset, elset=all, generate\n1,2,1\n",
       "*Elset, elset=all, generate\n1,2,1\n*Elset, elset=b\nall,all,all,all,all,all,all,all,all,all\n"
       "*Elset, elset=c\nb,b,b,b,b,b,b,b,b,b\n*Elset, elset=d\nc,c,c,c,c,c,c,c,c,c\n*Elset, elset=e\n"
       "d,d,d,d,d,d,d,d,d,d\n",
       "more than a hundred times as many numbers as the file has lines"},
      {"Abaqus: tied pieces", inp, "*Material, name=steel", "*Tie, name=a\nfoot, head",
       "line 33: *TIE is not read: pieces hang together by common nodes only"},
      {"Abaqus: tied contact", inp, "*Material, name=steel", "*Contact pair, interaction=a, tied",
       "*CONTACT PAIR with TIED is not read: pieces"},
      {"Abaqus: equation", inp, "*Material, name=steel", "*Equation", "*EQUATION is not read"},
      {"Abaqus: several nodes as one", inp, "*Material, name=steel", "*MPC", "*MPC is not read"},
      {"Abaqus: coupling", inp, "*Material, name=steel", "*Coupling, constraint name=a",
       "*COUPLING is not read"},
      {"Abaqus: turned axes of nodes", inp, "*Material, name=steel", "*Transform, nset=a",
       "*TRANSFORM is not read"},
      {"Abaqus: nodes that are moved", inp, "*Node\n", "*System\n0,0,10\n*Node\n",
       "line 4: *SYSTEM is not read: write all nodes and elements with their numbers and places in x, y and "
       "z"},
      {"Abaqus: blanks in a keyword", inp, "*Node\n", "* node\n1,0,0,0\n*  System\n0,0,10\n*Node\n",
       "*SYSTEM is not read"},
      {"Abaqus: copied nodes", inp, "*Material, name=steel", "*Ncopy, change number=100",
       "*NCOPY is not read"},
      {"Abaqus: stress at the start", inp, "*Material, name=steel", "*Initial conditions, type=stress",
       "*INITIAL CONDITIONS is not read: the rail begins without stress"},
      {"Abaqus: a change in a step", inp, "*Material, name=steel", "*Step\n*Static\n*Model change, remove",
       "*MODEL CHANGE is not read"},
      {"Abaqus: springs", inp, "*Material, name=steel", "*Spring, elset=a", "*SPRING is not read"},
      {"Abaqus: unknown", inp, "*Material, name=steel", "*Porous magic",
       "*POROUS MAGIC is not read: it is not known here and may change the answer"},
      {"Abaqus: two materials", inp, "*Material, name=steel",
       "*Elset, elset=first\n1\n*Solid section, elset=first, material=steel\n*Elset, "
       "elset=second\n2\n*Solid section, elset=second, material=\"Rubber, soft\"\n*Material, name=steel",
       "gives the material 'rubber, soft' to hexahedra of 'second', and line 35 gives 'steel' to those of "
       "'first': both have the steel of "
       "section 'Rail'"},
      {"LS-DYNA: tied nodes", k, "*MAT_ELASTIC", "*CONSTRAINED_NODE_SET",
       "*CONSTRAINED_NODE_SET is not read"},
      {"LS-DYNA: tied surfaces", k, "*MAT_ELASTIC", "*CONTACT_TIED_SURFACE_TO_SURFACE_ID",
       "is not read: pieces"},
      {"LS-DYNA: surfaces that are glued", k, "*MAT_ELASTIC",
       "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK", "is not read: pieces"},
      {"LS-DYNA: transformation", k, "*MAT_ELASTIC", "*DEFINE_TRANSFORMATION",
       "*DEFINE_TRANSFORMATION is not read"},
      {"LS-DYNA: moved nodes", k, "*MAT_ELASTIC", "*NODE_TRANSFORM", "*NODE_TRANSFORM is not read"},
      {"LS-DYNA: moved file", k, "*MAT_ELASTIC", "*INCLUDE_TRANSFORM", "*INCLUDE_TRANSFORM is not read"},
      {"LS-DYNA: stress at the start", k, "*MAT_ELASTIC", "*INITIAL_STRESS_SOLID",
       "the rail begins without stress"},
      {"LS-DYNA: springs", k, "*MAT_ELASTIC", "*ELEMENT_DISCRETE", "*ELEMENT_DISCRETE is not read"},
      {"LS-DYNA: unknown", k, "*MAT_ELASTIC", "*MAGIC", "*MAGIC is not read: it is not known here"},
      {"LS-DYNA: fields of ten", k, "*KEYWORD", "*KEYWORD I10=Y", "write fields of the usual width"},
      {"LS-DYNA: two materials", k, "       2       1\n       2       3",
       "       2       3\n       2       3", "gives the material '8' to hexahedra of 'pad', and line "},
      {"LS-DYNA: set without a title beside others", k, "*SET_SEGMENT_TITLE\nsymmetry\n", "*SET_SEGMENT\n",
       "has a set 4 without a title beside 'support', which has one: is it the boundary 'symmetry'?"},
      {"LS-DYNA: another file", k, "*MAT_ELASTIC", "*INCLUDE\n", "*INCLUDE is not read"},
      {"LS-DYNA: wide fields", k, "*KEYWORD", "*KEYWORD LONG=Y", "is not read"},
      {"LS-DYNA: generated set", k, "*SET_NODE_LIST_TITLE", "*SET_NODE_GENERAL_TITLE", "list the nodes"},
      {"LS-DYNA: tetrahedron", k, "       8       9      12      11", "       8       8       8       8",
       "one node twice"},
    };
    const std::map<std::string, std::string> texts{{old, gmsh_old()},
                                                   {now, gmsh_new()},
                                                   {inp, abaqus()},
                                                   {k, with_third_part(ls_dyna())}};
    for (const Fault &fault : faults)
      {
        const std::string file =
                            folder.write(fault.file, replaced(texts.at(fault.file), fault.from, fault.to)),
                          text = tests::complaint<InputError>([&] { read_mesh_file(file, 1e-3); });
        check.that(fault.name + ": \"" + text + "\"", text.find(fault.words) != text.npos &&
                                                        text.find('\n') == text.npos &&
                                                        text.find(file) != text.npos);
      }
    check.that("a file that is not there", tests::complaint<InputError>([&] {
                                             read_mesh_file(folder.path + "/no.msh", 1.);
                                           }).find("cannot be read") != std::string::npos);
    check.that("another ending", tests::complaint<InputError>([&] {
                                   read_mesh_file("a.vtk", 1.);
                                 }).find("no format that is read") != std::string::npos);

    // Two cubes with nodes of their own between them.
    std::string apart = replaced(gmsh_old(), "9 5 2 7 7 2 3 6 5 8 9 12 11", "9 5 2 7 7 22 3 6 25 28 9 12 31");
    apart = replaced(apart, "$Nodes\n12\n", "$Nodes\n16\n22 10 -5 -10\n25 10 5 -10\n28 10 -5 0\n31 10 5 0\n");
    apart = replaced(replaced(apart, "1 8 9 12 11", "1 28 9 12 31"), "2 2 3 6 5", "2 22 3 6 25");
    const std::string text =
      tests::complaint<InputError>([&] { read_mesh_file(folder.write("apart.msh", apart), 1e-3); });
    check.that("nodes at one place: \"" + text + "\"",
               text.find("nodes 2 and 22 lie at one place, 10, -5, -10 mm") != text.npos);
  }

  std::string refusal_of(const tests::TemporaryFolder &folder, const std::string &text)
  {
    return tests::complaint<InputError>([&] { read_mesh_file(folder.write("refused.msh", text), 1e-3); });
  }

  /// A block of cells of 10 mm with nodes from a number on: contact, and support where it is held.
  struct Blocks
  {
    std::string  nodes, cells, faces;
    unsigned int n_nodes = 0, n_elements = 0;

    void add(const double x, const double y, const double z, const double edge, const bool is_held)
    {
      const unsigned int first = n_nodes + 1;
      for (unsigned int v = 0; v < 8; ++v)
        nodes += std::to_string(++n_nodes) + " " + std::to_string(x + (v & 1u ? edge : 0.)) + " " +
                 std::to_string(y + (v & 2u ? edge : 0.)) + " " + std::to_string(z + (v & 4u ? edge : 0.)) +
                 "\n";
      const auto element = [&](const std::string &kind, const std::vector<unsigned int> &corners) {
        std::string text = std::to_string(++n_elements) + " " + kind;
        for (const unsigned int v : corners)
          text += " " + std::to_string(first + v);
        return text + "\n";
      };
      cells += element("5 2 9 9", {0, 1, 3, 2, 4, 5, 7, 6});
      faces += element("3 2 1 1", {4, 5, 7, 6});
      if (is_held)
        faces += element("3 2 2 2", {0, 1, 3, 2});
    }

    std::string text() const
    {
      return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(n_nodes) + "\n" + nodes +
             "$EndNodes\n$Elements\n" + std::to_string(n_elements) + "\n" + cells + faces + "$EndElements\n";
    }
  };

  /// Pieces that nothing holds, and cells that do not meet face to face.
  void check_pieces(tests::Check &check, const tests::TemporaryFolder &folder)
  {
    const auto refused = [&](const std::string &what, const Blocks &blocks, const std::string &words) {
      const std::string said = refusal_of(folder, blocks.text());
      check.that(what + ": \"" + said + "\"", said.find(words) != said.npos && said.find('\n') == said.npos);
    };
    Blocks two;
    two.add(0., 0., 0., 10., true);
    two.add(20., 0., 0., 10., false);
    refused("piece without a support", two,
            "line 26: begins a piece of 1 hexahedron that has no face named 'support', x = 20 to 30, y = 0 "
            "to 10, z "
            "= 0 to 10 mm: nothing would hold it; name what holds it");
    // The second cube hangs on an edge of the first one.
    std::string hinged = gmsh_old();
    hinged             = replaced(hinged, "9 5 2 7 7 2 3 6 5 8 9 12 11", "9 5 2 7 7 8 21 22 11 23 24 25 26");
    hinged             = replaced(hinged, "3 3 2 1 1 8 9 12 11\n4 3 2 2 2 1 2 5 4\n5 3 2 2 2 2 3 6 5\n",
                                  "3 3 2 1 1 23 24 25 26\n4 3 2 2 2 1 2 5 4\n");
    hinged             = replaced(hinged, "$Elements\n9\n", "$Elements\n8\n");
    hinged             = replaced(hinged, "3 20 -5 -10\n", "");
    hinged             = replaced(hinged, "6 20 5 -10\n", "");
    hinged             = replaced(hinged, "9 20 -5 0\n", "");
    hinged             = replaced(hinged, "12 20 5 0\n",
                                  "21 20 -5 0\n22 20 5 0\n23 10 -5 10\n24 20 -5 10\n25 20 5 10\n26 10 5 10\n");
    hinged             = replaced(hinged, "$Nodes\n12\n", "$Nodes\n14\n");
    const std::string said = refusal_of(folder, hinged);
    check.that("piece that hangs on an edge: \"" + said + "\"",
               said.find("it hangs on the others by edges or corners only") != said.npos);

    // Four small cubes against a large one: their inner nodes lie on its face.
    Blocks torn;
    torn.add(0., 0., 0., 10., true);
    torn.add(10., 2., 2., 5., true);
    refused("small faces against a large one", torn,
            "line 14: node 9 at 10, 2, 2 mm lies on a face or an edge of the hexahedron of line 25 and is no "
            "node of "
            "it: the mesh is torn there");
    Blocks on_edge;
    on_edge.add(0., 0., 0., 10., true);
    on_edge.add(10., 10., 2.5, 5., true);
    refused("node on an edge", on_edge, "lies on a face or an edge of the hexahedron of line 25");
    Blocks within;
    within.add(0., 0., 0., 10., true);
    within.add(7., 3., 3., 10., true);
    refused(
      "pieces in each other", within,
      "node 9 at 7, 3, 3 mm lies within the hexahedron of line 25 and is no node of it: pieces lie in each "
      "other");
    // Near it there may be a gap, or a tear.
    for (const double gap : {0.2, 0.6})
      {
        Blocks apart;
        apart.add(0., 0., 0., 10., true);
        apart.add(10. + gap, 2., 2., 5., true);
        const MeshFile mesh   = read_mesh_file(folder.write("gap.msh", apart.text()), 1e-3);
        std::string    doubts = mesh.doubts.empty() ? "" : mesh.doubts.front();
        check.that("gap: \"" + doubts + "\"",
                   gap < 0.5
                     ? doubts.find("node 9 at 10.2, 2, 2 mm and 3 others lie up to 0.2 mm beside hexahedra "
                                   "that are not joined to them") != doubts.npos
                     : mesh.doubts.empty());
      }
  }

  /// What is passed over is named once, and names and numbers that may be meant otherwise are read right.
  void check_named(tests::Check &check, const tests::TemporaryFolder &folder)
  {
    const auto doubts_of = [&](const std::string &name, const std::string &text) {
      std::string all;
      for (const std::string &doubt : read_mesh_file(folder.write(name, text), 1e-3).doubts)
        all += doubt + "|";
      return all;
    };
    const auto has = [&](const std::string &what, const std::string &text, const std::string &words) {
      check.that(what + ": \"" + text + "\"", text.find(words) != text.npos);
    };
    check.that("nothing is said of a file without anything else", doubts_of("old.msh", gmsh_old()).empty());
    has("Abaqus",
        doubts_of("a.inp",
                  abaqus() + "*Expansion\n1e-5\n*Boundary\nfoot, 1, 3\n*Step\n*Static\n*End step\n*Step\n"),
        "a.inp' is read for its cells and the names of its faces alone; material, loads, what is held and "
        "all else "
        "are those of the scene. Passed over: *MATERIAL (line 33), *BOUNDARY (line 38), *STEP (line 40)|");
    std::string k = replaced(ls_dyna(), "*MAT_ELASTIC", "*DATABASE_GLSTAT\n1.\n*MAT_ELASTIC");
    has("LS-DYNA", doubts_of("a.k", k), "Passed over: *DATABASE_GLSTAT (line 42), *MAT_ELASTIC (line 44)|");
    has("LS-DYNA: nodes that are held",
        doubts_of("a.k", replaced(ls_dyna(), "      -10.000000\n", "      -10.000000       7       0\n")),
        "Passed over: constraints of nodes (line 5), *MAT_ELASTIC");
    for (const std::string from : {"_TITLE\ncontact", "_TITLE\nsupport", "_TITLE\nsymmetry"})
      k = replaced(k, from, "");
    has(
      "LS-DYNA: sets without titles", doubts_of("a.k", k),
      "a.k' has sets without titles, which are taken by their numbers: 1 as 'contact', 2 as 'support', 4 as "
      "'symmetry'|");
    check.absolute("LS-DYNA: sets without titles: faces",
                   read_mesh_file(folder.path + "/a.k", 1e-3).faces.size(), 6., 0.);
    has("Gmsh", doubts_of("old.msh", gmsh_old() + "$Periodic\n0\n$EndPeriodic\n"),
        "Passed over: $Periodic (line 39)|");

    // Names in quotation marks, with a comma.
    std::string quoted = replaced(abaqus(), "elset=steel", "elset=\"Steel, R260\"");
    quoted = replaced(replaced(quoted, "elset=end", "elset=\"End\""), "nset=support", "nset = \"support\"");
    quoted = replaced(quoted, "elset=all, generate\n1,2,1", "elset=\"a, b\", generate\n1,2,1");
    quoted = replaced(replaced(quoted, "all, S2", "\"a, b\", S2"), "name=Contact", "name=\"Contact\"");
    check.absolute("names in quotation marks: faces",
                   read_mesh_file(folder.write("quoted.inp", quoted), 1e-3).faces.size(), 6., 0.);
    // Groups of which Gmsh has turned the orientation over.
    std::string turned     = replaced(gmsh_new(), "5 0 1 1 1 1", "5 0 1 -1 1 1");
    turned                 = replaced(turned, "5 -10 1 2 0", "5 -10 1 -2 0");
    const MeshFile new_one = read_mesh_file(folder.write("turned.msh", turned), 1e-3);
    check.absolute("negative tags of 4.1: faces", new_one.faces.size(), 6., 0.);
    const MeshFile old_one =
      read_mesh_file(folder.write("turned.msh", replaced(gmsh_old(), "2 3 2 1 1 7", "2 3 2 -1 1 7")), 1e-3);
    check.absolute("negative tags of 2.2: faces", old_one.faces.size(), 6., 0.);
  }

  /// A cell may list its nodes from any corner: the first edge lies along x, the last along z.
  void check_alignment(tests::Check &check, const tests::TemporaryFolder &folder)
  {
    const MeshFile mesh = read_mesh_file(
      folder.write("turned.msh", replaced(gmsh_old(), "1 2 5 4 7 8 11 10", "1 4 10 7 2 5 11 8")), 1e-3);
    for (const auto &cell : mesh.cells)
      {
        const auto edge = [&](const unsigned int to) {
          return 1e3 * (mesh.vertices[cell.vertices[to]] - mesh.vertices[cell.vertices[0]]);
        };
        check.absolute("edge along x, mm", edge(1)[0], 10., 1e-12);
        check.absolute("edge along y, mm", edge(2)[1], 10., 1e-12);
        check.absolute("edge along z, mm", edge(4)[2], 10., 1e-12);
      }
  }

  /// Beside a face that is a trapezoid the search for its coordinates may meet the line where they fold back.
  void check_beside_trapezoid(tests::Check &check, const tests::TemporaryFolder &folder)
  {
    const MeshRail rail(
      read_mesh_file(folder.write("trapezoid.msh", replaced(replaced(gmsh_old(), "8 10 -5 0", "8 10 0 0"),
                                                            "symmetry", "free")),
                     1e-3));
    check.below("height beside a trapezoid, mm", 1e3 * std::abs(rail.surface.facet(0.02, -0.003).z), 1e-9);
  }

  /// A flat bar with lines so far apart, in mm: what is said of its cells of the running surface under a path
  /// along y = 0 from x = 20 to 40 mm, with finest cells of 1 mm.
  std::string said_of_cells(const std::vector<std::vector<double>> &edges)
  {
    dealii::Triangulation<3>         block;
    std::vector<std::vector<double>> steps  = edges;
    double                           end[3] = {0., 0., 0.};
    for (unsigned int d = 0; d < 3; ++d)
      for (double &step : steps[d])
        end[d] += step *= 1e-3;
    dealii::GridGenerator::subdivided_hyper_rectangle(block, steps, Point<3>(0., -0.5 * end[1], -end[2]),
                                                      Point<3>(end[0], 0.5 * end[1], 0.));
    MeshFile            file;
    dealii::SubCellData ignored;
    file.file                                    = "bar";
    std::tie(file.vertices, file.cells, ignored) = dealii::GridTools::get_coarse_mesh_description(block);
    for (unsigned int c = 0; c < file.cells.size(); ++c)
      {
        const auto &v = file.cells[c].vertices;
        if (std::abs(file.vertices[v[4]][2]) < 1e-9)
          file.faces.push_back({{{v[4], v[5], v[7], v[6]}}, c, Boundary::contact});
      }
    std::string all;
    for (const std::string &doubt : MeshRail(file).doubts_about_cells({0.021, 0.039, -0.009, 0.009}, 1e-3))
      all += doubt + "|";
    return all;
  }

  void check_unlike_cells(tests::Check &check)
  {
    const std::vector<double> even(6, 10.);
    check.that("even cells: nothing is said", said_of_cells({even, even, {10., 10.}}).empty());
    check.that("cells of 14 x 10 x 9 mm: nothing is said",
               said_of_cells({std::vector<double>(5, 14.), even, {9., 9.}}).empty());
    // Their mean edge is 11.67 mm, halved four times to 0.73 mm.
    const std::string unlike =
      said_of_cells({std::vector<double>(4, 20.), std::vector<double>(12, 5.), {10., 10.}});
    check.that(
      "cells of 20 x 5 x 10 mm: \"" + unlike + "\"",
      unlike.find("'bar': 4 of 4 cells at the running surface under the path have edges unlike the mean one "
                  "of 11.7 mm: that at x = ") == 0 &&
        unlike.find("mm of 20 x 5 x 10 mm (along, across, down) is refined to 1.25 x 0.312 x 0.625 mm, where "
                    "'Mesh/Finest cell (mm)' is 1;") != unlike.npos);
    const std::string jump = said_of_cells({{10., 10., 12., 4., 10., 10., 10.}, even, {10., 10.}});
    check.that("cells of 12 beside 4 mm: \"" + jump + "\"",
               jump.find("side by side at x = 32, y = ") != jump.npos &&
                 jump.find("are 12 and 4 mm long") != jump.npos);
    check.that("the same beyond the path: nothing is said",
               said_of_cells({{12., 4., 12., 10., 10., 10.}, even, {10., 10.}}).find("side by side") ==
                 std::string::npos);
  }

  /// A block with a crown of 300 mm on coarse cells of 10 mm, refined about a path.
  void check_body(tests::Check &check)
  {
    constexpr double radius = 0.3;
    const auto       crown  = [](const double y) {
      return std::sqrt(radius * radius - y * y) - radius;
    };
    dealii::Triangulation<3> block;
    dealii::GridGenerator::subdivided_hyper_rectangle(block, {8, 8, 4}, Point<3>(-0.04, -0.04, -0.04),
                                                      Point<3>(0.04, 0.04, 0.));
    MeshFile file;
    file.file = "block";
    dealii::SubCellData ignored;
    std::tie(file.vertices, file.cells, ignored) = dealii::GridTools::get_coarse_mesh_description(block);
    for (Point<3> &p : file.vertices)
      p[2] += crown(p[1]) * (1. + p[2] / 0.04);
    static constexpr unsigned int top[4] = {4, 5, 7, 6}, bottom[4] = {0, 2, 3, 1};
    for (unsigned int c = 0; c < file.cells.size(); ++c)
      for (const auto &[corners, boundary] :
           {std::pair(top, Boundary::contact), std::pair(bottom, Boundary::support)})
        {
          NamedFace face{{}, c, boundary};
          double    depth = 0.;
          for (unsigned int v = 0; v < 4; ++v)
            {
              face.vertices[v] = file.cells[c].vertices[corners[v]];
              depth +=
                std::abs(file.vertices[face.vertices[v]][2] -
                         (boundary == Boundary::contact ? crown(file.vertices[face.vertices[v]][1]) : -0.04));
            }
          if (depth < 1e-9)
            file.faces.push_back(face);
        }
    FineZone zone;
    zone.finest_cell_size = 0.7e-3;
    zone.x_begin          = -8e-3;
    zone.x_end            = 8e-3;
    zone.half_width       = 5e-3;
    const auto  rail      = std::make_shared<const MeshRail>(file);
    const Body  body      = make_mesh_rail(rail, zone);
    tests::Mesh mesh;
    tests::refine(body, mesh);
    const tests::Measured m = tests::measure(body, mesh, zone.finest_cell_size, [&](const Point<3> &p) {
      return zone.distance(p[0], p[1], rail->surface.facet(p[0], p[1]).z - p[2]) <= 0.;
    });
    check.that("Jacobians at vertices and Gauss points > 0", m.min_jacobian > 0.);
    check.that("cells in the fine zone", m.n_fine >= 25 * 16 * 2);
    // Without the lift they are as far below the crown as 40 um.
    check.below("nodes off the crown, nm",
                1e9 * tests::off_surface(mesh, Boundary::contact,
                                         [&](const Point<3> &p) { return p[2] - crown(p[1]); }),
                5.);
    // The lift fades out below the surface: in the midst of coarse faces it would move the bottom by 42 um.
    check.below("place on the bottom moved, nm",
                1e9 * body.to_space(Point<3>(0.005, 0.005, -0.04)).distance(Point<3>(0.005, 0.005, -0.04)),
                1e-3);
    check.relative("support, cm2", 1e4 * m.areas.at(2), 64., 1e-12);
    check.relative("contact, cm2", 1e4 * m.areas.at(1), 1e4 * 0.08 * 2. * radius * std::asin(0.04 / radius),
                   1e-4);
    check.relative("thickness, mm", 1e3 * rail->thickness(0., 0.), 40., 1e-12);
  }
} // namespace mesh_file

TREAD_TEST(mesh_file)(tests::Check &check, const tests::Arguments &)
{
  const tests::TemporaryFolder folder;
  check_formats(check, folder);
  check_refused(check, folder);
  check_materials(check, folder);
  check_pieces(check, folder);
  check_named(check, folder);
  check_alignment(check, folder);
  check_body(check);
  check_unlike_cells(check);
  check_beside_trapezoid(check, folder);
}
