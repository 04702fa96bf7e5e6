// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_edges_h
#define tread_reference_edges_h

#include <tread/reference/influence.h>

#include <vector>

namespace tread::reference
{
  /// Where each row of elements enters and leaves the patch [m]. Rows without contact have lead < trail.
  struct Edges
  {
    std::vector<double> lead, trail;
    /// Half of the longest row, and of the widest extent across the rows [m].
    double semi_axis_x = 0., semi_axis_y = 0.;

    /// Area between them [m^2].
    double area(const Grid &grid) const;
  };

  /// Edges of an ellipse, mean over the width of each row.
  Edges ellipse_edges(const Grid &grid, double semi_axis_x, double semi_axis_y);

  /// Edges from a pressure that ends as the square root of the distance: its square is continued linearly
  /// from the second and the fourth element in contact to zero. The error is a small share of an element.
  Edges pressure_edges(const Grid &grid, const std::vector<double> &pressure);

  /// A leading edge within an element.
  ///
  /// Piecewise constant tractions with the slip of second order at element centres solve for a patch whose
  /// leading edge lies h/6 behind the outer edge of the last element: with it there, the force of Carter's
  /// problem is right to second order. A compliance kappa of the last element moves it on continuously:
  /// by m h for kappa = -1.93 m/(1 + m) times the slip that a strip of elements has by its own unit traction,
  /// from m = 0 to m = -1, where the element carries nothing. (kappa was found for 11 values of m such that
  /// Carter's force comes out; the formula meets them to 0.01.)
  struct LeadingEdge
  {
    std::vector<double> bound;      ///< pressure that limits the traction, sum of a row kept [Pa]
    std::vector<double> compliance; ///< kappa per element, in the unit said above [-]
  };

  /// @param lead per row [m]
  LeadingEdge leading_edge(const Grid                &grid,
                           const std::vector<double> &pressure,
                           const std::vector<double> &lead);
} // namespace tread::reference

#endif
