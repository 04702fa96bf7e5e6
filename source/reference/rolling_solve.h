// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_rolling_solve_h
#define tread_reference_rolling_solve_h

#include <tread/reference/rolling_case.h>

#include "edges.h"

namespace tread::reference
{
  /// Throws what solve_rolling() throws for a case that makes no sense.
  void check_case(const RollingCase &rolling_case);

  /// solve_rolling() with the slip of an order (TangentialProblem::order), and where its patch ends. With
  /// order 2 like bodies with the gap A x^2 + B y^2 carry Hertz's pressure, mean over each element.
  RollingResult solve_rolling(const RollingCase &rolling_case, unsigned int order, Edges &edges);
} // namespace tread::reference

#endif
