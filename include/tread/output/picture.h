// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_picture_h
#define tread_output_picture_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tread
{
  enum class PictureFormat
  {
    vtu, ///< a file a picture, by deal.II: values of cells at all of their corners
    xdmf ///< HDF5: points that cells share, values of cells
  };

  /// What a picture for ParaView shows: cells of four or eight corners with values at points or of cells.
  struct Picture
  {
    struct Field
    {
      std::string        name; ///< with its unit
      unsigned int       n_components;
      bool               at_points;
      std::vector<float> values;

      template <typename BoostArchive>
      void serialize(BoostArchive &archive, const unsigned int)
      {
        archive &name &n_components &at_points &values;
      }
    };

    unsigned int               n_corners = 8;
    std::vector<double>        points;  ///< x, y, z of each, m
    std::vector<std::uint32_t> corners; ///< of each cell, in deal.II's order
    std::vector<Field>         fields;  ///< the same on all ranks

    std::size_t n_points() const
    {
      return points.size() / 3;
    }
    std::size_t n_cells() const
    {
      return corners.size() / n_corners;
    }

    /// Add another picture with the same fields.
    void add(const Picture &other);

    template <typename BoostArchive>
    void serialize(BoostArchive &archive, const unsigned int)
    {
      archive &n_corners &points &corners &fields;
    }
  };

  /// The part of a VTU file with these cells; empty if there are none.
  std::string vtu_piece(const Picture &picture);

  /// A file of HDF5 with points, cells (in VTK's order of corners) and fields, compressed. @throws
  /// std::runtime_error
  void write_hdf5_picture(const std::string &path, const Picture &picture);

  /// One file with the pictures of several. @param pictures name of the group and path of each. @throws
  /// std::runtime_error
  void join_hdf5_pictures(const std::string                                      &path,
                          const std::vector<std::pair<std::string, std::string>> &pictures);

  /// How XDMF describes such a picture. @param place of its data: file name, a colon, and a group that ends
  /// with a slash; @param time s
  std::string xdmf_grid(const Picture     &picture,
                        const std::string &name,
                        const std::string &place,
                        const double       time);

  /// The XDMF file of a series of pictures from their descriptions.
  std::string xdmf_collection(const std::string &name, const std::vector<std::string> &grids);
} // namespace tread

#endif
