// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/csv_table.h>
#include <tread/base/format.h>
#include <tread/base/hdf5_file.h>
#include <tread/base/input_error.h>
#include <tread/geometry/height_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

namespace tread
{
  namespace
  {
    /// Places that should be equal may differ by this share of the spacing, as printed digits do.
    constexpr double printed_digits = 1e-2;

    bool is_hdf5(const std::string &file)
    {
      const std::string ending = std::filesystem::path(file).extension();
      return ending == ".h5" || ending == ".hdf5";
    }

    /// Weights of four neighbours at a place from 0 to 1 between the middle two.
    std::array<double, 4> catmull_rom(const double t)
    {
      return {{0.5 * t * (-1. + t * (2. - t)), 1. + 0.5 * t * t * (3. * t - 5.),
               0.5 * t * (1. + t * (4. - 3. * t)), 0.5 * t * t * (t - 1.)}};
    }
  } // namespace


  HeightMap::Axis::Axis(std::vector<double> values, const std::string &name, const std::string &file)
  {
    std::sort(values.begin(), values.end());
    const double extent = values.empty() ? 0. : values.back() - values.front();
    // Equal places lie together; spacings are far above their scatter.
    constexpr double    finest = 1e-6; // of the extent
    std::vector<double> places;
    for (const double value : values)
      if (places.empty() || value - places.back() > finest * extent)
        places.push_back(value);
    n = places.size();
    if (n < 2)
      throw InputError("'" + file + "' needs at least two different " + name);
    begin                  = 1e-3 * places.front();
    spacing                = 1e-3 * (places.back() - places.front()) / (n - 1);
    constexpr double least = 1e-9; // m
    if (!(spacing >= least))
      throw InputError("'" + file + "': " + name + " have spacings of " + text_in_mm(spacing) +
                       " mm; at least " + text_in_mm(least) + " mm");
    for (std::size_t i = 0; i < n; ++i)
      if (std::abs(1e-3 * places[i] - begin - i * spacing) > printed_digits * spacing)
        throw InputError("'" + file + "': " + name + " " + text_of(places[i]) +
                         " does not lie on a grid with equal spacings of " + text_in_mm(spacing) +
                         " mm from " + text_of(places.front()) + " on");
  }


  std::size_t HeightMap::Axis::place_of(const double value) const
  {
    return std::lround(std::clamp((value - begin) / spacing, 0., double(n - 1)));
  }


  HeightMap::HeightMap(const std::string &file)
    : HeightMap(is_hdf5(file) ? read_hdf5(file) : read_table(file))
  {
  }


  HeightMap::Rows HeightMap::read_table(const std::string &file)
  {
    const CsvTable table = [&] {
      try
        {
          return CsvTable(
            file, [](const std::string &name) { return name == "x_mm" || name == "y_mm" || name == "z_mm"; },
            "cannot read '" + file + "'");
        }
      catch (const InputError &error)
        {
          const std::string what = error.what();
          throw InputError(what +
                           (what.find("begins with numbers") != what.npos
                              ? "; a map needs columns x_mm, y_mm and z_mm, a row for each place; matrices "
                                "are read from HDF5 (.h5)"
                              : ""));
        }
    }();
    return {file, table.column("x_mm"), table.column("y_mm"), table.column("z_mm")};
  }


  HeightMap::Rows HeightMap::read_hdf5(const std::string &file)
  {
    const hdf5::Handle opened = [&] {
      try
        {
          return hdf5::Handle(hdf5::open(file), H5Fclose);
        }
      catch (const std::exception &)
        {
          throw InputError("cannot read '" + file + "'" +
                           (std::filesystem::is_regular_file(file) ? " as a file of HDF5" : ""));
        }
    }();
    const auto of_dataset = [&](const auto &read, const std::string &name) {
      try
        {
          return read(opened, name);
        }
      catch (const std::exception &)
        {
          throw InputError("'" + file + "': the dataset of numbers '" + name +
                           "' is not there, or cannot be read");
        }
    };
    const auto x_size = of_dataset(hdf5::extents, "x_mm"), y_size = of_dataset(hdf5::extents, "y_mm"),
               z_size   = of_dataset(hdf5::extents, "z_mm");
    const auto in_words = [](const std::vector<hsize_t> &extents) {
      std::string text;
      for (const hsize_t extent : extents)
        text += (text.empty() ? "" : " x ") + std::to_string(extent);
      return text.empty() ? "a single number" : text;
    };
    if (x_size.size() != 1 || y_size.size() != 1 || z_size != std::vector<hsize_t>{y_size[0], x_size[0]} ||
        y_size[0] < 2 || x_size[0] < 2)
      throw InputError("'" + file +
                       "': x_mm must have one dimension (n_x), y_mm one (n_y), z_mm two, (n_y, "
                       "n_x), of two places at least; they are " +
                       in_words(x_size) + ", " + in_words(y_size) + " and " + in_words(z_size));
    const auto numbers = [&](const std::string &name) {
      const std::vector<double> values = of_dataset(hdf5::read, name);
      if (!std::all_of(values.begin(), values.end(), [](const double value) { return std::isfinite(value); }))
        throw InputError("'" + file + "': " + name + " has a value that is no finite number");
      return values;
    };
    const std::vector<double> x = numbers("x_mm"), y = numbers("y_mm");
    Rows                      rows{file, {}, {}, numbers("z_mm")};
    for (const double place_y : y)
      for (const double place_x : x)
        {
          rows.x.push_back(place_x);
          rows.y.push_back(place_y);
        }
    return rows;
  }


  HeightMap::HeightMap(const Rows &rows)
    : along(rows.x, "x_mm", rows.file)
    , across(rows.y, "y_mm", rows.file)
  {
    const std::vector<double> &x = rows.x, &y = rows.y, &z = rows.z;
    std::vector<std::size_t>   places;
    for (std::size_t row = 0; row < z.size(); ++row)
      places.push_back(across.place_of(1e-3 * y[row]) * along.n + along.place_of(1e-3 * x[row]));
    // Nothing is made room for that the file does not have.
    if (along.n * across.n > places.size())
      fail_at_missing(places, rows.file);
    heights.assign(along.n * across.n, 0.);
    std::vector<bool> known(heights.size(), false);
    for (std::size_t row = 0; row < z.size(); ++row)
      {
        const std::size_t k = places[row];
        if (known[k])
          throw InputError("'" + rows.file + "', row " + std::to_string(row + 1) + ": x " + text_of(x[row]) +
                           " mm, y " + text_of(y[row]) + " mm is there twice");
        known[k]   = true;
        heights[k] = 1e-3 * z[row];
      }
  }


  void HeightMap::fail_at_missing(std::vector<std::size_t> places, const std::string &file) const
  {
    std::sort(places.begin(), places.end());
    std::size_t k = 0;
    for (const std::size_t place : places)
      if (place == k)
        ++k;
      else if (place > k)
        break;
    throw InputError("'" + file + "': the place x " +
                     text_in_mm(along.begin + (k % along.n) * along.spacing) + " mm, y " +
                     text_in_mm(across.begin + (k / along.n) * across.spacing) + " mm of its grid of " +
                     std::to_string(along.n) + " x " + std::to_string(across.n) + " is missing");
  }


  double HeightMap::height(const double x, const double y) const
  {
    const auto find = [](const Axis &axis, const double value) {
      const double      t = std::clamp((value - axis.begin) / axis.spacing, 0., double(axis.n - 1));
      const std::size_t i = std::min<std::size_t>(t, axis.n - 2);
      return std::pair(i, t - i);
    };
    const auto [i, u] = find(along, x);
    const auto [j, v] = find(across, y);
    const auto w = catmull_rom(u), s = catmull_rom(v);
    // A neighbour beyond the border continues the straight line.
    const auto along_row = [&, i = i](const std::size_t row) {
      const double b = at(i, row), c = at(i + 1, row), a = i > 0 ? at(i - 1, row) : 2. * b - c,
                   d = i + 2 < along.n ? at(i + 2, row) : 2. * c - b;
      return w[0] * a + w[1] * b + w[2] * c + w[3] * d;
    };
    const double b = along_row(j), c = along_row(j + 1), a = j > 0 ? along_row(j - 1) : 2. * b - c,
                 d = j + 2 < across.n ? along_row(j + 2) : 2. * c - b;
    return s[0] * a + s[1] * b + s[2] * c + s[3] * d;
  }


  double HeightMap::lowest() const
  {
    return *std::min_element(heights.begin(), heights.end());
  }


  double HeightMap::highest() const
  {
    return *std::max_element(heights.begin(), heights.end());
  }


  double HeightMap::largest_on_ends() const
  {
    double largest = 0.;
    for (std::size_t j = 0; j < across.n; ++j)
      largest = std::max({largest, std::abs(at(0, j)), std::abs(at(along.n - 1, j))});
    return largest;
  }


  double HeightMap::largest_on_sides() const
  {
    double largest = 0.;
    for (std::size_t i = 0; i < along.n; ++i)
      largest = std::max({largest, std::abs(at(i, 0)), std::abs(at(i, across.n - 1))});
    return largest;
  }
} // namespace tread
