// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_petsc_error_h
#define tread_analysis_petsc_error_h

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/exceptions.h>

#include <petscvec.h>

namespace tread
{
  /// @throws dealii::LACExceptions::ExcPETScError for what a function of PETSc or SLEPc returned, if it is
  /// one
  inline void check_petsc(const PetscErrorCode error)
  {
    AssertThrow(error == 0, dealii::LACExceptions::ExcPETScError(error));
  }

  inline double dot(const Vec a, const Vec b)
  {
    PetscScalar value;
    check_petsc(VecDot(a, b, &value));
    return value;
  }
} // namespace tread

#endif
