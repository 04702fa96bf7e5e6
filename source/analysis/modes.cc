// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/modes.h>
#include <tread/base/format.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/lac/exceptions.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include "petsc_error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Shift s of the stiffness, rad/s. Small beside the frequencies that are wanted, and large enough that
    /// K + s^2 M of free bodies is not nearly singular: the ratio of its extreme eigenvalues is 1e8 for cells
    /// of a centimetre. At half or double the value the modes agree to 1e-9.
    constexpr double shift = 2. * dealii::numbers::PI * 20.;

    /// Relative residual of the eigenvalues of the inverse; eigenvalues are more exact.
    constexpr double       tolerance      = 1e-10;
    constexpr unsigned int max_iterations = 1000;

    /// Modes whose squared frequencies differ by less, relatively, count as equal.
    constexpr double equal_frequencies = 1e-7;

    /// Vectors of the Krylov space of the force that enter the reduced equations.
    constexpr unsigned int n_krylov = 3;
  } // namespace


  Modes::Modes(const ElasticSystem &system, const double up_to)
    : system(system)
  {
    check_petsc(MatDuplicate(system.stiffness(), MAT_COPY_VALUES, &shifted));
    check_petsc(MatAXPY(shifted, shift * shift, system.mass(), DIFFERENT_NONZERO_PATTERN));
    check_petsc(MatSetOption(shifted, MAT_SYMMETRIC, PETSC_TRUE));
    check_petsc(MatSetOption(shifted, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
    check_petsc(MatSetOption(shifted, MAT_SPD, PETSC_TRUE));

    check_petsc(EPSCreate(system.mesh.comm, &solver));
    check_petsc(EPSSetOperators(solver, shifted, system.mass()));
    check_petsc(EPSSetProblemType(solver, EPS_GHEP));
    check_petsc(EPSSetType(solver, EPSKRYLOVSCHUR));
    check_petsc(EPSSetTarget(solver, 0.));
    check_petsc(EPSSetWhichEigenpairs(solver, EPS_TARGET_MAGNITUDE));
    check_petsc(EPSSetTolerances(solver, tolerance, max_iterations));
    ST  transformation;
    KSP linear;
    PC  factors;
    check_petsc(EPSGetST(solver, &transformation));
    check_petsc(STSetType(transformation, STSINVERT));
    check_petsc(STGetKSP(transformation, &linear));
    check_petsc(KSPSetType(linear, KSPPREONLY));
    check_petsc(KSPGetPC(linear, &factors));
    check_petsc(PCSetType(factors, PCCHOLESKY));
    check_petsc(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS));

    const double       highest = std::pow(2. * dealii::numbers::PI * up_to, 2);
    const unsigned int n       = number_below(highest);
    if (n == 0)
      {
        // The reduced equations need the factors all the same.
        check_petsc(EPSSetDimensions(solver, 1, PETSC_DEFAULT, PETSC_DEFAULT));
        check_petsc(EPSSetUp(solver));
        return;
      }
    // One starting vector finds one of several modes that are equal to the last digit, unless rounding brings
    // in the others: then more are asked for.
    for (unsigned int more = 0; more < 4; ++more)
      {
        solve(n + more * (2 + n / 10));
        const auto n_found =
          std::count_if(eigenvalues.begin(), eigenvalues.end(), [&](const double e) { return e < highest; });
        if (n_found == n)
          {
            for (std::size_t k = n; k < vectors.size(); ++k)
              check_petsc(VecDestroy(&vectors[k]));
            vectors.resize(n);
            eigenvalues.resize(n);
            return;
          }
      }
    throw std::runtime_error(
      format("the iteration did not find all of the %u modes up to %g Hz; try another frequency", n, up_to));
  }


  Modes::~Modes()
  {
    for (Vec &vector : vectors)
      VecDestroy(&vector);
    EPSDestroy(&solver);
    MatDestroy(&shifted);
  }


  unsigned int Modes::number_below(const double omega_squared) const
  {
    Mat matrix, factor;
    check_petsc(MatDuplicate(system.stiffness(), MAT_COPY_VALUES, &matrix));
    check_petsc(MatAXPY(matrix, -omega_squared, system.mass(), DIFFERENT_NONZERO_PATTERN));
    check_petsc(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
    check_petsc(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor));
    check_petsc(MatMumpsSetIcntl(factor, 13, 1)); // no ScaLAPACK for the last block: it does not count pivots
    check_petsc(MatMumpsSetIcntl(factor, 24, 1)); // without it PETSc trusts no inertia
    MatFactorInfo information;
    check_petsc(MatFactorInfoInitialize(&information));
    check_petsc(MatCholeskyFactorSymbolic(factor, matrix, nullptr, &information));
    check_petsc(MatCholeskyFactorNumeric(factor, matrix, &information));
    PetscInt negative, zero, positive;
    check_petsc(MatGetInertia(factor, &negative, &zero, &positive));
    check_petsc(MatDestroy(&factor));
    check_petsc(MatDestroy(&matrix));
    return negative;
  }


  void Modes::solve(const unsigned int n)
  {
    for (Vec &vector : vectors)
      check_petsc(VecDestroy(&vector));
    vectors.clear();
    eigenvalues.clear();
    check_petsc(EPSSetDimensions(solver, std::min<std::uint64_t>(n, system.n_unknowns()), PETSC_DEFAULT,
                                 PETSC_DEFAULT));
    check_petsc(EPSSolve(solver));
    PetscInt n_converged;
    check_petsc(EPSGetConverged(solver, &n_converged));
    std::vector<std::pair<double, Vec>> found;
    for (PetscInt k = 0; k < n_converged; ++k)
      {
        Vec         vector = system.new_vector();
        PetscScalar value;
        check_petsc(EPSGetEigenpair(solver, k, &value, nullptr, vector, nullptr));
        found.emplace_back(value - shift * shift, vector);
      }
    std::sort(found.begin(), found.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    Vec product = system.new_vector();
    for (const auto &found_mode : found)
      {
        Vec vector = found_mode.second;
        check_petsc(MatMult(system.mass(), vector, product));
        check_petsc(VecScale(vector, 1. / std::sqrt(dot(vector, product))));
        // Rayleigh's quotient: its error is of second order in that of the vector.
        check_petsc(MatMult(system.stiffness(), vector, product));
        eigenvalues.push_back(dot(vector, product));
        vectors.push_back(vector);
      }
    check_petsc(VecDestroy(&product));
  }


  double Modes::frequency(const unsigned int mode) const
  {
    return std::sqrt(std::max(eigenvalues[mode], 0.)) / (2. * dealii::numbers::PI);
  }


  double Modes::damping_share(const unsigned int mode) const
  {
    Vec product = system.new_vector();
    check_petsc(MatMult(system.damping(), vectors[mode], product));
    const double damping = dot(vectors[mode], product);
    check_petsc(VecDestroy(&product));
    return eigenvalues[mode] > 0. ? damping / (2. * std::sqrt(eigenvalues[mode])) : 0.;
  }


  double Modes::orthogonality_error() const
  {
    double                   largest = 0.;
    Vec                      product = system.new_vector();
    std::vector<PetscScalar> products(size());
    for (unsigned int k = 0; k < size(); ++k)
      {
        check_petsc(MatMult(system.mass(), vectors[k], product));
        check_petsc(VecMDot(product, size(), vectors.data(), products.data()));
        products[k] -= 1.;
        for (const double value : products)
          largest = std::max(largest, std::abs(value));
      }
    check_petsc(VecDestroy(&product));
    return largest;
  }


  void Modes::align(const ElasticSystem::Place &place)
  {
    const auto amplitude = [&](const unsigned int k) {
      ElasticSystem::RigidParts parts;
      return system.displacement_of(place, shape(k, parts));
    };
    Vec combined = system.new_vector();
    for (unsigned int first = 0, end; first < size(); first = end)
      {
        end = first + 1;
        while (end < size() && eigenvalues[end] - eigenvalues[first] <
                                 equal_frequencies * (std::abs(eigenvalues[end]) + shift * shift))
          ++end;
        std::vector<double> u;
        double              square = 0.;
        for (unsigned int k = first; k < end; ++k)
          {
            u.push_back(amplitude(k));
            square += u.back() * u.back();
          }
        if (square == 0.)
          continue;
        // Householder's reflection that makes of the amplitudes (-+|u|, 0, ...).
        const double size_of_u = std::copysign(std::sqrt(square), u[0]);
        if (end > first + 1)
          {
            std::vector<double> w = u;
            w[0] += size_of_u;
            double norm = 0.;
            for (const double value : w)
              norm += value * value;
            check_petsc(VecSet(combined, 0.));
            for (unsigned int k = first; k < end; ++k)
              check_petsc(VecAXPY(combined, w[k - first], vectors[k]));
            for (unsigned int k = first; k < end; ++k)
              check_petsc(VecAXPY(vectors[k], -2. * w[k - first] / norm, combined));
            u[0] = -size_of_u;
          }
        if (u[0] < 0.)
          check_petsc(VecScale(vectors[first], -1.));
      }
    check_petsc(VecDestroy(&combined));
  }


  std::vector<std::complex<double>> Modes::receptance(const ElasticSystem::Place              &place,
                                                      const std::vector<std::complex<double>> &omega) const
  {
    ST  transformation;
    KSP linear;
    check_petsc(EPSGetST(solver, &transformation));
    check_petsc(STGetKSP(transformation, &linear));
    Vec              force = system.force_on(place), product = system.new_vector();
    std::vector<Vec> loads = system.damper_forces(), basis = vectors;
    const auto       add = [&](Vec load) {
      Vec answer = system.new_vector();
      check_petsc(KSPSolve(linear, load, answer));
      if (system.normalise_against(basis, answer))
        basis.push_back(answer);
      else
        check_petsc(VecDestroy(&answer));
    };
    for (Vec &load : loads)
      {
        add(load);
        check_petsc(VecDestroy(&load));
      }
    Vec krylov = system.new_vector();
    check_petsc(VecCopy(force, product));
    for (unsigned int k = 0; k < n_krylov; ++k)
      {
        add(product);
        check_petsc(KSPSolve(linear, product, krylov));
        check_petsc(MatMult(system.mass(), krylov, product));
        PetscReal size;
        check_petsc(VecNorm(product, NORM_2, &size));
        check_petsc(VecScale(product, 1. / size));
      }
    check_petsc(VecDestroy(&krylov));

    const unsigned int         n = basis.size();
    dealii::FullMatrix<double> stiffness(n, n), damping(n, n);
    std::vector<PetscScalar>   products(n), forces(n);
    check_petsc(VecMDot(force, n, basis.data(), forces.data()));
    for (unsigned int j = 0; j < n; ++j)
      {
        check_petsc(MatMult(system.damping(), basis[j], product));
        check_petsc(VecMDot(product, n, basis.data(), products.data()));
        for (unsigned int i = 0; i < n; ++i)
          damping(i, j) = products[i];
        if (j < vectors.size())
          stiffness(j, j) = eigenvalues[j];
        else
          {
            check_petsc(MatMult(system.stiffness(), basis[j], product));
            check_petsc(VecMDot(product, n, basis.data(), products.data()));
            for (unsigned int i = 0; i < n; ++i)
              stiffness(i, j) = stiffness(j, i) = products[i];
          }
      }
    for (std::size_t k = vectors.size(); k < n; ++k)
      check_petsc(VecDestroy(&basis[k]));
    check_petsc(VecDestroy(&product));
    check_petsc(VecDestroy(&force));

    // Each rank takes every n_ranks-th frequency.
    using Complex              = std::complex<double>;
    const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(system.mesh.comm),
                       n_ranks = dealii::Utilities::MPI::n_mpi_processes(system.mesh.comm);
    std::vector<double> values(2 * omega.size(), 0.);
    for (unsigned int line = rank; line < omega.size(); line += n_ranks)
      {
        dealii::LAPACKFullMatrix<Complex> matrix(n);
        dealii::Vector<Complex>           answer(n);
        for (unsigned int i = 0; i < n; ++i)
          {
            for (unsigned int j = 0; j < n; ++j)
              matrix(i, j) = stiffness(i, j) + Complex(0., 1.) * omega[line] * damping(i, j);
            matrix(i, i) -= omega[line] * omega[line];
            answer(i) = forces[i];
          }
        matrix.compute_lu_factorization();
        matrix.solve(answer);
        Complex sum = 0.;
        for (unsigned int i = 0; i < n; ++i)
          sum += forces[i] * answer(i);
        values[2 * line]     = sum.real();
        values[2 * line + 1] = sum.imag();
      }
    dealii::Utilities::MPI::sum(values, system.mesh.comm, values);
    std::vector<Complex> result;
    for (unsigned int line = 0; line < omega.size(); ++line)
      result.emplace_back(values[2 * line], values[2 * line + 1]);
    return result;
  }
} // namespace tread
