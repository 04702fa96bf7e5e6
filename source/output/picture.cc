// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/hdf5_file.h>
#include <tread/output/picture.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/grid/reference_cell.h>

#include <iomanip>
#include <sstream>
#include <tuple>

namespace tread
{
  namespace
  {
    template <int dim>
    std::string piece_of(const Picture &picture)
    {
      using Kind = dealii::DataComponentInterpretation::DataComponentInterpretation;
      std::vector<std::string>                                               names;
      std::vector<std::tuple<unsigned int, unsigned int, std::string, Kind>> vectors;
      for (const Picture::Field &field : picture.fields)
        {
          const unsigned int first = names.size();
          names.insert(names.end(), field.n_components, field.name);
          if (field.n_components == 3)
            vectors.emplace_back(first, first + 2, field.name,
                                 dealii::DataComponentInterpretation::component_is_part_of_vector);
        }
      std::vector<dealii::DataOutBase::Patch<dim, 3>> patches(picture.n_cells());
      for (std::size_t c = 0; c < patches.size(); ++c)
        {
          auto &patch          = patches[c];
          patch.reference_cell = dealii::ReferenceCells::get_hypercube<dim>();
          patch.patch_index    = c;
          patch.n_subdivisions = 1;
          patch.data.reinit(names.size(), picture.n_corners);
          for (unsigned int v = 0; v < picture.n_corners; ++v)
            {
              const std::size_t point = picture.corners[c * picture.n_corners + v];
              for (unsigned int d = 0; d < 3; ++d)
                patch.vertices[v][d] = picture.points[3 * point + d];
              unsigned int row = 0;
              for (const Picture::Field &field : picture.fields)
                for (unsigned int k = 0; k < field.n_components; ++k)
                  patch.data(row++, v) = field.values[field.n_components * (field.at_points ? point : c) + k];
            }
        }
      std::ostringstream            text;
      dealii::DataOutBase::VtkFlags flags;
      // The best takes several times as long for files that are a tenth smaller.
      flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
      dealii::DataOutBase::write_vtu_main(patches, names, vectors, flags, text);
      return text.str();
    }
  } // namespace


  void Picture::add(const Picture &other)
  {
    const std::uint32_t first = n_points();
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (const std::uint32_t corner : other.corners)
      corners.push_back(first + corner);
    for (std::size_t f = 0; f < fields.size(); ++f)
      fields[f].values.insert(fields[f].values.end(), other.fields[f].values.begin(),
                              other.fields[f].values.end());
  }


  std::string vtu_piece(const Picture &picture)
  {
    if (picture.corners.empty())
      return "";
    return picture.n_corners == 8 ? piece_of<3>(picture) : piece_of<2>(picture);
  }


  void write_hdf5_picture(const std::string &path, const Picture &picture)
  {
    using namespace hdf5;
    const Handle file(create(path), H5Fclose);
    write_rows(file, "points", picture.points, 3);
    std::vector<std::uint32_t> corners;
    for (std::size_t first = 0; first < picture.corners.size(); first += 4)
      for (const unsigned int v : {0, 1, 3, 2}) // of a face around
        corners.push_back(picture.corners[first + v]);
    write_rows(file, "cells", corners, picture.n_corners);
    for (const Picture::Field &field : picture.fields)
      write_rows(file, field.name, field.values, field.n_components);
    check(H5Fflush(file, H5F_SCOPE_GLOBAL));
  }


  void join_hdf5_pictures(const std::string                                      &path,
                          const std::vector<std::pair<std::string, std::string>> &pictures)
  {
    using namespace hdf5;
    const Handle file(create(path), H5Fclose);
    for (const auto &[group, alone] : pictures)
      {
        const Handle picture(H5Fopen(alone.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
        check(H5Ocopy(picture, "/", file, group.c_str(), H5P_DEFAULT, H5P_DEFAULT));
      }
    check(H5Fflush(file, H5F_SCOPE_GLOBAL));
  }


  std::string xdmf_grid(const Picture     &picture,
                        const std::string &name,
                        const std::string &place,
                        const double       time)
  {
    std::ostringstream text;
    const auto         data = [&](const std::string &dataset, const std::size_t n_rows, const unsigned int n,
                          const char *type, const unsigned int bytes) {
      text << "<DataItem Dimensions=\"" << n_rows;
      if (n > 1)
        text << ' ' << n;
      text << "\" NumberType=\"" << type << "\" Precision=\"" << bytes << "\" Format=\"HDF\">" << place
           << dataset << "</DataItem>";
    };
    text << "<Grid Name=\"" << name << "\">\n<Time Value=\"" << std::setprecision(12) << time
         << "\"/>\n<Topology TopologyType=\"" << (picture.n_corners == 8 ? "Hexahedron" : "Quadrilateral")
         << "\" NumberOfElements=\"" << picture.n_cells() << "\">";
    data("cells", picture.n_cells(), picture.n_corners, "UInt", 4);
    text << "</Topology>\n<Geometry GeometryType=\"XYZ\">";
    data("points", picture.n_points(), 3, "Float", 8);
    text << "</Geometry>\n";
    for (const Picture::Field &field : picture.fields)
      {
        text << "<Attribute Name=\"" << field.name << "\" AttributeType=\""
             << (field.n_components == 3 ? "Vector" : "Scalar") << "\" Center=\""
             << (field.at_points ? "Node" : "Cell") << "\">";
        data(field.name, field.at_points ? picture.n_points() : picture.n_cells(), field.n_components,
             "Float", 4);
        text << "</Attribute>\n";
      }
    text << "</Grid>\n";
    return text.str();
  }


  std::string xdmf_collection(const std::string &name, const std::vector<std::string> &grids)
  {
    std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"" + name +
                       "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    for (const std::string &grid : grids)
      text += grid;
    return text + "</Grid>\n</Domain>\n</Xdmf>\n";
  }
} // namespace tread
