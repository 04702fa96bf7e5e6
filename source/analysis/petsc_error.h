// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_petsc_error_h
#define tread_analysis_petsc_error_h

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/exceptions.h>

#include <petscsys.h>

namespace tread
{
  /// @throws dealii::LACExceptions::ExcPETScError for what a function of PETSc or SLEPc returned, if it is
  /// one
  inline void check_petsc(const PetscErrorCode error)
  {
    AssertThrow(error == 0, dealii::LACExceptions::ExcPETScError(error));
  }
} // namespace tread

#endif
