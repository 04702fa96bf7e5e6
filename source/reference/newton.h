// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_newton_h
#define tread_reference_newton_h

#include <tread/reference/half_space.h>

#include "gmres.h"

#include <optional>
#include <vector>

namespace tread::reference
{
  /// Some elements of a grid, on the smallest grid that holds them.
  struct Patch
  {
    Patch(const Grid &outer_grid, const std::vector<unsigned int> &elements);

    Grid                      grid;
    std::vector<unsigned int> outer; ///< element of the outer grid
    std::vector<unsigned int> inner; ///< the same element on the cropped grid

    std::size_t size() const
    {
      return outer.size();
    }
  };

  /// What Newton's method solves: slip s = fixed + (creepages of prescribed forces) + L p with the tangential
  /// operator L.
  struct FrictionEquations
  {
    const Patch                       *patch;
    ElasticPair                        pair;
    std::vector<std::array<double, 2>> stencil;    ///< of L: weights and offsets
    std::vector<double>                bound;      ///< f pn per element [Pa]
    std::vector<double>                fixed;      ///< slip that does not depend on the unknowns (two blocks)
    std::vector<double>                compliance; ///< more slip by an element's own traction (two blocks)
    bool                               prescribed[2]; ///< force in x, y prescribed
    double                             force[2];      ///< [N]
  };

  /// Semismooth Newton method for p = P(p - r s), P the projection on the disc of radius f pn (Alart &
  /// Curnier 1991; Hueeber, Stadler & Wohlmuth 2008), in scaled variables t = p/p_ref, sigma = r s/p_ref. r
  /// is the traction that an element needs for unit slip of its own. After each step tractions are brought
  /// back into the disc, which tames the overshoot.
  class FrictionNewton
  {
  public:
    explicit FrictionNewton(const FrictionEquations &equations);

    /// Tractions [Pa], two blocks, and the creepages of prescribed forces.
    struct State
    {
      std::vector<double> shear;
      double              creepage[2] = {0., 0.};
    };

    /// Improve a state; true if the tolerance is reached. Adds to the counters.
    bool iterate(State &state, double tolerance, unsigned int max_iterations);

    unsigned int iterations        = 0;
    unsigned int linear_iterations = 0;
    double       violation         = 0.; ///< of the last state

    /// Slip of the last state (two blocks), and whether an element slips.
    std::vector<double> slip() const;
    bool                slips(const std::size_t k) const
    {
      return weight[k] >= 0.;
    }

  private:
    double residual(const std::vector<double> &v, std::vector<double> &out);
    void   jacobian(const double *in, double *out);
    void   precondition(const double *in, double *out);

    const FrictionEquations       &equations;
    const std::size_t              n;
    FourierGrid                    fourier;
    TangentialOperator             op;
    std::optional<FactoredInverse> inverse; // preconditioner; none for a patch of few elements
    double                         p_ref, r;
    double                         border; // 1/sqrt(n): scales the rows and columns of prescribed forces
    int                            row[2]; // of the prescribed forces, -1: none
    std::size_t                    n_unknowns;
    std::vector<double>            bound, fixed, sigma, weight, e_x, e_y, work;
    std::vector<double>            softness; // r times compliance, two blocks
    Gmres                          gmres;
  };
} // namespace tread::reference

#endif
