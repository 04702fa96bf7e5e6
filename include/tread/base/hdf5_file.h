// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_hdf5_file_h
#define tread_base_hdf5_file_h

#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace tread::hdf5
{
  /// What HDF5 has opened; closed at the end of its scope.
  class Handle
  {
  public:
    Handle(const hid_t id, herr_t (*close)(hid_t))
      : id(id)
      , close(close)
    {
      if (id < 0)
        throw std::runtime_error("HDF5");
    }
    ~Handle()
    {
      close(id);
    }
    Handle(const Handle &)            = delete;
    Handle &operator=(const Handle &) = delete;
            operator hid_t() const
    {
      return id;
    }

  private:
    const hid_t id;
    herr_t (*const close)(hid_t);
  };

  inline void check(const herr_t result)
  {
    if (result < 0)
      throw std::runtime_error("HDF5");
  }

  /// A new file. Errors are thrown, not printed.
  inline hid_t create(const std::string &path)
  {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    // The format of HDF5 1.10 needs a third of the room of older ones for columns of some hundred rows.
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110));
    return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  }

  /// A file that is there, to be read. Errors are thrown, not printed.
  inline hid_t open(const std::string &path)
  {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  }

  /// Extents of a dataset of a file.
  inline std::vector<hsize_t> extents(const hid_t file, const std::string &name)
  {
    const Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose),
      space(H5Dget_space(dataset), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space);
    check(rank);
    std::vector<hsize_t> sizes(rank);
    check(H5Sget_simple_extent_dims(space, sizes.data(), nullptr));
    return sizes;
  }

  /// Its numbers, the last index running fastest.
  inline std::vector<double> read(const hid_t file, const std::string &name)
  {
    std::size_t n = 1;
    for (const hsize_t size : extents(file, name))
      n *= size;
    const Handle        dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    std::vector<double> values(n);
    if (n > 0)
      check(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    return values;
  }

  inline hid_t create_group(const hid_t parent, const std::string &name)
  {
    return H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  }

  inline hid_t type_of(const double)
  {
    return H5T_NATIVE_DOUBLE;
  }
  inline hid_t type_of(const float)
  {
    return H5T_NATIVE_FLOAT;
  }
  inline hid_t type_of(const std::uint8_t)
  {
    return H5T_NATIVE_UINT8;
  }
  inline hid_t type_of(const std::uint32_t)
  {
    return H5T_NATIVE_UINT32;
  }

  /// A dataset of rows of so many numbers, compressed. One of a single column has one dimension.
  template <typename Number>
  void write_rows(const hid_t                group,
                  const std::string         &name,
                  const std::vector<Number> &values,
                  const unsigned int         n_columns = 1)
  {
    const hsize_t size[2] = {values.size() / n_columns, n_columns};
    const int     rank    = n_columns > 1 ? 2 : 1;
    const Handle  space(H5Screate_simple(rank, size, nullptr), H5Sclose),
      how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (size[0] > 0)
      {
        const hsize_t chunk[2] = {std::min<hsize_t>(size[0], 16384), n_columns};
        check(H5Pset_chunk(how, rank, chunk));
        check(H5Pset_shuffle(how));
        check(H5Pset_deflate(how, 1)); // higher levels take several times as long for a few per cent
      }
    const Handle dataset(
      H5Dcreate2(group, name.c_str(), type_of(Number()), space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose);
    if (size[0] > 0)
      check(H5Dwrite(dataset, type_of(Number()), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  }
} // namespace tread::hdf5

#endif
