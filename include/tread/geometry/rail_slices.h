// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_rail_slices_h
#define tread_geometry_rail_slices_h

#include <tread/geometry/surface.h>

#include <memory>
#include <string>
#include <vector>

namespace tread
{
  /// A measured or designed section of a rail that changes along the way, such as a crossing.
  struct RailSlice
  {
    double                        x;      ///< m
    std::vector<dealii::Point<2>> points; ///< y, z up, from low to high y along the surface (m)
    /// Lengths along the chords from the first point, at which part k begins (k) and ends (k + 1), m; nan
    /// where the slice does not have it. Empty: the slice is not cut.
    std::vector<double>      breaks;
    std::vector<std::string> bodies; ///< of the points; empty: no names
  };

  struct RailSlices
  {
    std::string            file;
    std::vector<RailSlice> slices; ///< with increasing x
  };

  /// Slices from a file: a list of CONTACT (.slcs) with its files of sections beside it, or a table with the
  /// columns x_mm, y_mm, z_mm and, where they are there, part and body. Whether z points up is seen from the
  /// shape; sections of a list whose numbers are all below 1 are in m, others in mm.
  /// @throws InputError, one line with file and place, for what is not understood
  RailSlices read_rail_slices(const std::string &file);

  /// Whether a file has slices, and not one profile: a list of CONTACT, or a table with a column x_mm.
  /// @throws InputError if it cannot be read
  bool has_rail_slices(const std::string &file);

  /// Refuses a line through points that crosses itself, or comes back to one of them other than to close.
  /// @param where begins the message
  /// @throws InputError
  void refuse_crossing_line(const std::string &where, const std::vector<dealii::Point<2>> &points);

  /// A rail through slices. Each slice is a cubic spline over the length of its chords. Between two slices
  /// that are cut, each part that both have is sampled at equal shares of its length, between others the
  /// whole slice; along x cubic splines go through the samples of equal share, natural at the ends.
  /// Parts may begin and end at a slice.
  class SlicedRail : public Surface
  {
  public:
    /// @throws InputError, one line, for slices that make no surface
    explicit SlicedRail(RailSlices slices);

    std::string               in_words() const override;
    Extent                    extent() const override;
    bool                      is_constant() const override;
    std::vector<ProfileCurve> sections(double along) const override;
    std::string               body(double along, double y) const override;

    /// A slice that does not fit those around it while these fit each other without it, by leaving out one at
    /// a time; a distance between two slices that stands out.
    std::vector<std::string> doubts() const override;

  private:
    /// Samples of a part, or of whole slices, over consecutive slices, with their splines along x.
    struct Strip
    {
      std::size_t                                first, last; ///< slices
      std::vector<std::vector<dealii::Point<2>>> places;      ///< of the samples, by slice
      std::vector<std::vector<dealii::Point<2>>> bend;        ///< second derivatives by x
    };
    Strip                         strip(std::size_t first, std::size_t last, int part) const;
    std::vector<dealii::Point<2>> points_of(const Strip &strip, std::size_t slice, double x) const;

    RailSlices                      rail;
    std::vector<ProfileCurve>       curves; ///< of the slices
    std::vector<std::vector<Strip>> parts;  ///< of part k
    std::vector<Strip>              wholes;
    Extent                          known;
  };
} // namespace tread

#endif
