// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_batched_group_h
#define tread_solid_batched_group_h

#include <tread/solid/element.h>

#include <algorithm>
#include <limits>

namespace tread
{
  /// Green-Lagrange strain (F^T F - 1)/2: xx, yy, zz, xy, yz, zx.
  [[gnu::always_inline]] inline void green_lagrange(const Lanes (&F)[3][3], Lanes (&E)[6])
  {
    const auto product = [&](const unsigned int j, const unsigned int k) {
      return F[0][j] * F[0][k] + F[1][j] * F[1][k] + F[2][j] * F[2][k];
    };
    E[0] = 0.5 * (product(0, 0) - 1.);
    E[1] = 0.5 * (product(1, 1) - 1.);
    E[2] = 0.5 * (product(2, 2) - 1.);
    E[3] = 0.5 * product(0, 1);
    E[4] = 0.5 * product(1, 2);
    E[5] = 0.5 * product(2, 0);
  }

  /// First Piola-Kirchhoff stress P = F S.
  [[gnu::always_inline]] inline void first_piola(const Lanes (&F)[3][3],
                                                 const Lanes (&S)[6],
                                                 Lanes (&P)[3][3])
  {
    for (unsigned int i = 0; i < 3; ++i)
      {
        P[i][0] = F[i][0] * S[0] + F[i][1] * S[3] + F[i][2] * S[5];
        P[i][1] = F[i][0] * S[3] + F[i][1] * S[1] + F[i][2] * S[4];
        P[i][2] = F[i][0] * S[5] + F[i][1] * S[4] + F[i][2] * S[2];
      }
  }


  /// A group whose kernel takes n_lanes cells at once. A batch has the nodes of its cells, and what its
  /// kernel needs; all zero, it is that of padded lanes, whose forces vanish.
  template <typename Batch>
  class BatchedGroup : public CellGroup
  {
  public:
    /// @param set called with batch, lane, integrals and number of each cell.
    template <typename Set>
    BatchedGroup(const Mesh                      &mesh,
                 const ElasticMaterial           &material,
                 const std::vector<unsigned int> &cells,
                 const Set                       &set)
      : lambda(material.lame())
      , mu(material.shear_modulus())
    {
      for (std::size_t first = 0; first < cells.size(); first += n_lanes)
        {
          batches.emplace_back();
          cell_of_lane.emplace_back();
          cell_of_lane.back().fill(invalid_cell);
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            {
              const bool         padded = first + lane >= cells.size();
              const unsigned int c      = cells[padded ? first : first + lane];
              for (unsigned int a = 0; a < 8; ++a)
                batches.back().node[a][lane] = mesh.cells[c].nodes[a];
              if (padded)
                continue;
              cell_of_lane.back()[lane] = c;
              set(batches.back(), lane, HexahedronIntegrals(mesh.corners(c)), c);
            }
        }
    }

    void set_cauchy_stress(const Vector3                      *x,
                           const std::vector<char>            &wanted,
                           std::vector<std::array<double, 6>> &stress) const override
    {
      for (std::size_t b = 0; b < batches.size(); ++b)
        {
          const auto &cells = cell_of_lane[b];
          if (!wanted.empty() && std::none_of(cells.begin(), cells.end(), [&](const unsigned int c) {
                return c != invalid_cell && wanted[c];
              }))
            continue;
          Lanes F[3][3], E[6], S[6], P[3][3];
          deform_centre(batches[b], x, F);
          green_lagrange(F, E);
          HenckyPoint<Lanes>(E).stress(lambda, mu, S);
          first_piola(F, S, P);
          for (unsigned int l = 0; l < n_lanes; ++l)
            if (const unsigned int c = cells[l]; c != invalid_cell)
              {
                const double J = F[0][0][l] * (F[1][1][l] * F[2][2][l] - F[1][2][l] * F[2][1][l]) -
                                 F[0][1][l] * (F[1][0][l] * F[2][2][l] - F[1][2][l] * F[2][0][l]) +
                                 F[0][2][l] * (F[1][0][l] * F[2][1][l] - F[1][1][l] * F[2][0][l]);
                static constexpr unsigned int ij[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
                for (unsigned int k = 0; k < 6; ++k)
                  {
                    double sum = 0.;
                    for (unsigned int m = 0; m < 3; ++m)
                      sum += P[ij[k][0]][m][l] * F[ij[k][1]][m][l];
                    stress[c][k] = sum / J;
                  }
              }
        }
    }

    std::size_t memory_consumption() const override
    {
      return batches.size() * sizeof(Batch) + cell_of_lane.size() * sizeof(cell_of_lane[0]);
    }

  protected:
    /// Deformation gradient at the centres of a batch's cells.
    virtual void deform_centre(const Batch &batch, const Vector3 *x, Lanes (&F)[3][3]) const = 0;

    AlignedVector<Batch> batches;
    double               lambda, mu; ///< of Lame, Pa

  private:
    static constexpr unsigned int                  invalid_cell = std::numeric_limits<unsigned int>::max();
    std::vector<std::array<unsigned int, n_lanes>> cell_of_lane; ///< invalid where padded
  };
} // namespace tread

#endif
