// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_height_map_h
#define tread_geometry_height_map_h

#include <cstddef>
#include <string>
#include <vector>

namespace tread
{
  /// Heights of a surface over its nominal one on a rectangular grid, as a scanner gives them: z up. In
  /// between cubic in each direction (Catmull and Rom 1974), so that planes and parabolas come out exactly.
  /// Lengths in m.
  class HeightMap
  {
  public:
    /// A table with the columns x_mm, y_mm and z_mm, separated by commas: each place of a grid with equal
    /// spacings once, in any order. Or, if its name ends in .h5 or .hdf5, a file of HDF5 with the datasets
    /// x_mm (n_x), y_mm (n_y) and z_mm (n_y, n_x). @throws InputError
    explicit HeightMap(const std::string &file);

    /// Outside the grid that of the nearest place on its border.
    double height(double x, double y) const;

    double x_begin() const
    {
      return along.begin;
    }
    double x_end() const
    {
      return along.begin + (along.n - 1) * along.spacing;
    }
    double y_begin() const
    {
      return across.begin;
    }
    double y_end() const
    {
      return across.begin + (across.n - 1) * across.spacing;
    }
    double lowest() const;
    double highest() const;
    /// Largest amount at the first and the last x.
    double largest_on_ends() const;
    /// Largest amount at the first and the last y.
    double largest_on_sides() const;

  private:
    /// A place and its height in each row, mm.
    struct Rows
    {
      std::string         file;
      std::vector<double> x, y, z;
    };
    static Rows read_table(const std::string &file);
    static Rows read_hdf5(const std::string &file);
    explicit HeightMap(const Rows &rows);

    struct Axis
    {
      double      begin = 0., spacing = 0.;
      std::size_t n = 0;

      Axis(std::vector<double> values, const std::string &name, const std::string &file);
      std::size_t place_of(double value) const;
    };
    double at(std::size_t i, std::size_t j) const
    {
      return heights[j * along.n + i];
    }

    Axis                along, across;
    std::vector<double> heights;

    /// @throws InputError that names a place of the grid which none of these numbers of places is
    [[noreturn]] void fail_at_missing(std::vector<std::size_t> places, const std::string &file) const;
  };
} // namespace tread

#endif
