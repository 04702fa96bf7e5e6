// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_batch_files_h
#define tread_tools_batch_files_h

#include <mpi.h>

#include <string>

namespace tread
{
  /// Solves many cases of rolling half-spaces on all cores (`tread batch`, see half_space.h).
  ///
  /// @param cases  a table, one case a row: A_per_m, B_per_m, normal_force_N, friction, young_Pa, poisson,
  ///               creepage, lateral_creepage, spin_per_m; may have element_x_m, element_y_m (0 or none:
  ///               chosen) and slip_order (none: 1, that of CONTACT, where elements are given, else 2);
  ///               others are kept
  /// @param output the same rows with longitudinal_force_N, lateral_force_N, spin_moment_Nm, max_pressure_Pa,
  ///               adhesion_share, iterations, area_m2, approach_m, frictional_work_J_per_m, status
  /// @throws InputError for a table that cannot be read, std::runtime_error if cases were not solved, whose
  /// rows then have nan and a status that is not 0
  void write_batch(const std::string &cases, const std::string &output, MPI_Comm comm);
} // namespace tread

#endif
