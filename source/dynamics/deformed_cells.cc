// SPDX-License-Identifier: LGPL-2.1-or-later
// What large deformation does to the cells: turned inside out, or too fast for the time step.
#include <tread/base/format.h>
#include <tread/base/went_wrong.h>
#include <tread/dynamics/critical_step.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread
{
  namespace
  {
    using dealii::Tensor;

    /// Frobenius' norm of C - 1 up to which it stands for the largest eigenvalue, which it bounds, so that no
    /// eigenvalues are computed. It makes the bound of the frequency larger by up to 1 % than it is.
    constexpr double small_deviation = 0.02;

    /// Factor by which the bound of the frequency must exceed the value last found stable for the frequency
    /// to be computed again. A larger one computes it less often, but notices later that the step is too
    /// long.
    constexpr double worth_looking = 1.01;

    /// Share of the largest stable Courant number that a user is advised to start anew with.
    constexpr double advised_share = 0.98;

    /// dx/dxi at the centre of a cell with corners in lexicographic order, for xi from -1 to 1.
    template <typename Corner>
    Tensor<2, 3> jacobian_at_centre(const Corner &corner)
    {
      Tensor<2, 3> J;
      for (unsigned int a = 0; a < 8; ++a)
        {
          const auto x = corner(a);
          for (unsigned int k = 0; k < 3; ++k)
            for (unsigned int i = 0; i < 3; ++i)
              J[i][k] += ((a >> k) & 1 ? 0.125 : -0.125) * x[i];
        }
      return J;
    }

    /// Largest factor by which the principal stretches of F can raise the frequency of a cell. Stiffness
    /// grows with the square of the largest stretch if stress refers to undeformed areas (St. Venant and
    /// Kirchhoff's law), and with the inverse square of the smallest one if it refers to deformed areas.
    /// @param C = F^T F; @param deviation norm of C - 1.
    double largest_change_of_stretch(const dealii::SymmetricTensor<2, 3> &C, const double deviation)
    {
      if (deviation < small_deviation)
        return 1. / std::sqrt(1. - deviation);
      const auto squares = dealii::eigenvalues(C); // the largest first
      return std::sqrt(std::max(squares[0], 1. / squares[2]));
    }
  } // namespace


  void CriticalStep::check_cells()
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::min;
    double       least_volume = std::numeric_limits<double>::max(), stretch = 1., fastest = 0., strain = 0.;
    unsigned int worst = 0, most_strained = 0;
    for (unsigned int c = 0; c < moving.mesh.cells.size(); ++c)
      {
        const auto        &nodes  = moving.mesh.cells[c].nodes;
        const Tensor<2, 3> before = jacobian_at_centre(
                             [&](const unsigned int a) { return moving.mesh.nodes[nodes[a]]; }),
                           now = jacobian_at_centre(
                             [&](const unsigned int a) { return moving.state.position(nodes[a]); });
        const Tensor<2, 3> F      = now * dealii::invert(before);
        const double       volume = dealii::determinant(F);
        if (!(volume >= least_volume)) // NaN is found as well
          {
            least_volume = volume == volume ? volume : std::numeric_limits<double>::lowest();
            worst        = c;
          }
        if (volume > 0.)
          {
            const dealii::SymmetricTensor<2, 3> C         = dealii::symmetrize(dealii::transpose(F) * F);
            const double                        deviation = (C - dealii::unit_symmetric_tensor<3>()).norm(),
                         change                           = largest_change_of_stretch(C, deviation);
            if (0.5 * deviation > strain)
              {
                strain        = 0.5 * deviation;
                most_strained = c;
              }
            stretch = std::max(stretch, change);
            fastest = std::max(fastest, change * moving.solid.cell_frequencies()[c] *
                                          (1u << moving.solid.cell_levels()[c]));
          }
      }
    if (const double least = min(least_volume, moving.mesh.comm); least <= 0.)
      throw WentWrong("the cell " + moving.place_of_worst_cell(least_volume == least, worst) +
                      " has been turned inside out after " + std::to_string(moving.state.n_steps) +
                      " steps: its strain is too large for this mesh; use larger cells there, or "
                      "less load or hardening that carries it");
    else if (least < moving.parameters.stop_at.volume)
      throw WentWrong("the cell " + moving.place_of_worst_cell(least_volume == least, worst) +
                      format(" has %.3g of its volume after %llu steps, below 'Watchdogs/Stop at volume' %g",
                             least, (unsigned long long)moving.state.n_steps,
                             moving.parameters.stop_at.volume));
    if (const double largest = max(strain, moving.mesh.comm); largest > moving.parameters.stop_at.strain)
      throw WentWrong("the cell " + moving.place_of_worst_cell(strain == largest, most_strained) +
                      format(" has a strain of %.3g after %llu steps, above 'Watchdogs/Stop at strain' %g",
                             largest, (unsigned long long)moving.state.n_steps,
                             moving.parameters.stop_at.strain));

    // No motion of the mesh can have become faster by more than its most changed cell, nor be faster than the
    // fastest cell alone: while that is slow enough nothing needs to be known exactly.
    const double bound =
      std::min(max(stretch, moving.mesh.comm) * highest_of_step, max(fastest, moving.mesh.comm));
    if (moving.parameters.courant_number * bound <=
        std::max(highest_of_step, worth_looking * bound_found_stable))
      return;
    const double courant = moving.parameters.courant_number *
                           highest_of_levels(moving.state.positions(), moving.state.history) /
                           highest_of_step;
    if (courant > 1.)
      throw WentWrong(
        format("the cells have deformed so much after %llu steps that the time step is no longer stable: "
               "Courant number %.3f; start anew with 'Time stepping/Courant number' at most %.2f",
               (unsigned long long)moving.state.n_steps, courant,
               std::floor(100. * advised_share * moving.parameters.courant_number / courant) / 100.));
    bound_found_stable = moving.parameters.courant_number * bound;
  }
} // namespace tread
