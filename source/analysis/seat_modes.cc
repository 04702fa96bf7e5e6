// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/seat_modes.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include "petsc_error.h"
#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tread
{
  namespace
  {
    /// A mode with a smaller share in the response of a place is not felt there, but for rounding.
    constexpr double rounding = 1e-8;

    /// Vectors of PETSc and the factors of a stiffness matrix; destroyed at the end of the scope.
    class Solver
    {
    public:
      explicit Solver(const ElasticSystem &system)
        : system(system)
      {
        PC factors;
        check_petsc(KSPCreate(system.mesh.comm, &linear));
        check_petsc(KSPSetOperators(linear, system.stiffness(), system.stiffness()));
        check_petsc(KSPSetType(linear, KSPPREONLY));
        check_petsc(KSPGetPC(linear, &factors));
        check_petsc(PCSetType(factors, PCLU));
        check_petsc(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS));
      }
      ~Solver()
      {
        for (Vec &vector : all)
          VecDestroy(&vector);
        KSPDestroy(&linear);
      }
      Solver(const Solver &)            = delete;
      Solver &operator=(const Solver &) = delete;

      Vec keep(Vec vector)
      {
        all.push_back(vector);
        return vector;
      }
      Vec new_vector()
      {
        return keep(system.new_vector());
      }
      /// K^-1 load
      Vec answer_to(Vec load)
      {
        Vec answer = new_vector();
        check_petsc(KSPSolve(linear, load, answer));
        return answer;
      }
      Vec times(Mat matrix, Vec vector)
      {
        Vec product = new_vector();
        check_petsc(MatMult(matrix, vector, product));
        return product;
      }

    private:
      const ElasticSystem &system;
      KSP                  linear = nullptr;
      std::vector<Vec>     all;
    };

    /// M-orthonormal vectors of the Krylov space of a load.
    std::vector<Vec> krylov_basis(Solver &solver, const ElasticSystem &system, Vec load, const unsigned int n)
    {
      std::vector<Vec> basis;
      while (basis.size() < n)
        {
          Vec vector = solver.answer_to(load);
          if (!system.normalise_against(basis, vector))
            break;
          basis.push_back(vector);
          load = solver.times(system.mass(), vector);
        }
      return basis;
    }
  } // namespace


  SleeperModes modes_at_place(const ElasticSystem        &system,
                              const ElasticSystem::Place &place,
                              const unsigned int          n)
  {
    Solver                 solver(system);
    Vec                    force = solver.keep(system.force_on(place));
    const std::vector<Vec> basis = krylov_basis(solver, system, force, n);
    const unsigned int     k     = basis.size();

    dealii::LAPACKFullMatrix<double> stiffness(k, k);
    dealii::FullMatrix<double>       damping(k, k);
    for (unsigned int j = 0; j < k; ++j)
      {
        Vec of_springs = solver.times(system.stiffness(), basis[j]),
            of_dampers = solver.times(system.damping(), basis[j]);
        for (unsigned int i = 0; i < k; ++i)
          {
            stiffness(i, j) = dot(basis[i], of_springs);
            damping(i, j)   = dot(basis[i], of_dampers);
          }
      }
    for (unsigned int j = 0; j < k; ++j)
      for (unsigned int i = 0; i < j; ++i)
        stiffness(i, j) = stiffness(j, i) = 0.5 * (stiffness(i, j) + stiffness(j, i));
    dealii::Vector<double>     squares(k);
    dealii::FullMatrix<double> shapes(k, k);
    // All are positive and below the sum of the diagonal.
    double bound = 0.;
    for (unsigned int j = 0; j < k; ++j)
      bound += stiffness(j, j);
    stiffness.compute_eigenvalues_symmetric(0., 2. * bound, 0., squares, shapes);

    // What gravity pulls at.
    ElasticSystem::Place all;
    for (unsigned int i = 0; i < system.masses().size(); ++i)
      if (system.mesh.shared_nodes.is_owned(i) && system.masses()[i] > 0.)
        all.emplace_back(i, system.masses()[i]);
    Vec                 weight = solver.keep(system.force_on(all));
    std::vector<double> at_place(k), weighing(k);
    for (unsigned int j = 0; j < k; ++j)
      {
        at_place[j] = dot(basis[j], force);
        weighing[j] = dot(basis[j], weight);
      }
    const auto in_mode = [&](const std::vector<double> &of_basis, const unsigned int mode) {
      double sum = 0.;
      for (unsigned int j = 0; j < k; ++j)
        sum += shapes(j, mode) * of_basis[j];
      return sum;
    };
    // What the place does not feel has shares in its softness that are rounding.
    std::vector<unsigned int> felt;
    double                    softness = 0.;
    const auto                share    = [&](const unsigned int mode) {
      return std::pow(in_mode(at_place, mode), 2) / squares(mode);
    };
    for (unsigned int mode = 0; mode < k; ++mode)
      softness += share(mode);
    for (unsigned int mode = 0; mode < k; ++mode)
      if (share(mode) > rounding * softness)
        felt.push_back(mode);
    SleeperModes        modes;
    std::vector<double> scale(k); // of a mode of unit mass, so that the place moves by one
    for (const unsigned int mode : felt)
      {
        scale[mode] = 1. / in_mode(at_place, mode);
        modes.mass.push_back(scale[mode] * scale[mode]);
        modes.stiffness.push_back(scale[mode] * scale[mode] * squares(mode));
        modes.weighing.push_back(scale[mode] * in_mode(weighing, mode));
      }
    for (const unsigned int a : felt)
      for (const unsigned int b : felt)
        {
          double sum = 0.;
          for (unsigned int i = 0; i < k; ++i)
            for (unsigned int j = 0; j < k; ++j)
              sum += shapes(i, a) * damping(i, j) * shapes(j, b);
          modes.damping.push_back(scale[a] * scale[b] * sum);
        }
    return modes;
  }


  SleeperModes modes_at_seat(const Mesh                         &mesh,
                             const unsigned int                  rail_body,
                             const SolidSleeper                 &sleeper,
                             const double                        position,
                             TrackParameters                     track,
                             const std::vector<ElasticMaterial> &materials,
                             const SolidParameters              &parameters)
  {
    constexpr unsigned int n    = 12; // receptances up to 2 kHz within a thousandth
    track.springs.pad_stiffness = track.springs.pad_damping = 0.;
    const Supports    support(mesh, rail_body, {position}, track, {sleeper});
    std::vector<char> with_body(mesh.body_names.size(), false);
    with_body[sleeper.body] = true;
    ElasticSystem system(mesh, with_body, materials, parameters);
    system.attach_supports(support);
    system.guide_nodes(support.guided_nodes(0), 0);
    system.guide_nodes(mesh.boundary_nodes(sleeper.body, Boundary::end), 1);
    system.assemble();
    ElasticSystem::Place seat; // the points of the pad, alike
    for (const Supports::Link &link : support.links())
      if (link.layer == Supports::pad)
        for (const auto &[node, share] : link.nodes)
          if (mesh.node_bodies[node] == sleeper.body)
            seat.emplace_back(node, std::abs(share) / (track.points_along * track.points_across));
    return modes_at_place(system, seat, n);
  }
} // namespace tread
