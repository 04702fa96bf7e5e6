// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_parts_h
#define tread_dynamics_parts_h

#include <tread/dynamics/carries_body.h>
#include <tread/dynamics/part.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace tread
{
  /// The parts that act on the nodes of a model, in the order in which they act, those of them that carry
  /// bodies, and what all of them sum over the ranks.
  class Parts
  {
  public:
    /// @param n_bodies of the mesh
    explicit Parts(const unsigned int n_bodies)
      : carrier_of_body(n_bodies, -1)
    {
    }

    void add(std::unique_ptr<Part> part);

    auto begin() const
    {
      return all.begin();
    }
    auto end() const
    {
      return all.end();
    }

    const std::vector<CarriesBody *> &carriers() const
    {
      return that_carry;
    }
    /// Number of the carrier of each body; -1: none.
    const std::vector<int> &carriers_of_bodies() const
    {
      return carrier_of_body;
    }
    /// The motions of the carriers as find_motions() has asked for them.
    const std::vector<RigidMotion> &motions() const
    {
      return motions_found;
    }
    void                    find_motions();
    std::vector<MovingLoad> loads_of_carriers() const;

    /// This rank's shares of the numbers that the parts sum over the ranks.
    void set_sums(const State &state, const std::vector<double> &inverse_mass);
    void sum_over_ranks(const MPI_Comm comm); ///< these numbers. Collective.
    /// These numbers of all parts, for whoever sums them over the ranks together with others.
    std::vector<double> &sums()
    {
      return rank_sums;
    }
    /// Those of the carrier of this number.
    const double *sums_of_carrier(const std::size_t number) const
    {
      return rank_sums.data() + first_sum[part_of_carrier[number]];
    }
    /// Let the parts advance with the sums over the ranks.
    void advance(Step &step);

    /// Sum of an energy over the parts, J. @param energy of a part
    template <typename Energy>
    double sum_of(const Energy &energy) const
    {
      double sum = 0.;
      for (const auto &part : all)
        sum += energy(*part);
      return sum;
    }

    /// Store or restore the state of all parts. Collective.
    void serialize(Archive &archive);

  private:
    std::vector<std::unique_ptr<Part>> all;
    std::vector<std::size_t>           first_sum; ///< of each part in rank_sums
    std::vector<double>                rank_sums;
    std::vector<CarriesBody *>         that_carry;
    std::vector<std::size_t>           part_of_carrier; ///< its number among all
    std::vector<int>                   carrier_of_body; ///< -1: none
    std::vector<RigidMotion>           motions_found;
  };
} // namespace tread

#endif
