// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_slice_list_h
#define tread_geometry_slice_list_h

#include <string>
#include <utility>
#include <vector>

namespace tread
{
  /// A list of slices in the format of CONTACT: .slcs of a rail, over the way, or .slcw of a wheel, over the
  /// angle about the axle (CONTACT user guide, E. Vollebregt).
  struct SliceList
  {
    struct Entry
    {
      double                                 along;    ///< the unit of the scaled numbers: mm, or rad
      std::string                            file;     ///< as the list names it, from its own folder
      std::vector<std::pair<double, double>> points;   ///< as read_profile_points() gives them (m)
      std::vector<double>                    features; ///< lengths along the slice, -1: not there
    };
    std::vector<Entry> entries;
    bool               approximates   = false; ///< the splines pass beside the slices
    unsigned int       line_of_method = 0;
  };

  /// @throws InputError, one line with file, line and cause, for what is not understood: kinks, jumps of the
  /// curvature, numbers that are missing or too many, slices that are not there
  SliceList read_slice_list(const std::string &file);

  /// The files of the slices as a list names them, from its own folder; none if it is no list, or a wrong
  /// one.
  std::vector<std::string> slices_named_in(const std::string &file);
} // namespace tread

#endif
