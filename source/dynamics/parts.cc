// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/parts.h>

#include <deal.II/base/mpi.h>

#include <typeinfo>
#include <utility>

namespace tread
{
  void Parts::add(std::unique_ptr<Part> part)
  {
    if (auto *carrier = dynamic_cast<CarriesBody *>(part.get()))
      {
        carrier_of_body[carrier->body()] = that_carry.size();
        that_carry.push_back(carrier);
        part_of_carrier.push_back(all.size());
      }
    first_sum.push_back(rank_sums.size());
    rank_sums.resize(rank_sums.size() + part->n_sums());
    all.push_back(std::move(part));
  }


  void Parts::find_motions()
  {
    motions_found.resize(that_carry.size());
    for (std::size_t k = 0; k < that_carry.size(); ++k)
      motions_found[k] = that_carry[k]->motion();
  }


  std::vector<MovingLoad> Parts::loads_of_carriers() const
  {
    std::vector<MovingLoad> loads;
    for (const CarriesBody *carrier : that_carry)
      loads.push_back(carrier->load());
    return loads;
  }


  void Parts::set_sums(const State &state, const std::vector<double> &inverse_mass)
  {
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k]->set_sums(state, inverse_mass, rank_sums.data() + first_sum[k]);
  }


  void Parts::sum_over_ranks(const MPI_Comm comm)
  {
    if (!rank_sums.empty())
      dealii::Utilities::MPI::sum(rank_sums, comm, rank_sums);
  }


  void Parts::advance(Step &step)
  {
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k]->advance(step, rank_sums.data() + first_sum[k]);
  }


  void Parts::serialize(Archive &archive)
  {
    for (const auto &added : all)
      {
        Part &part = *added;
        archive.kind(typeid(part));
        part.serialize(archive);
      }
  }
} // namespace tread
