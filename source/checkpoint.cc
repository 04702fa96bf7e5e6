// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/checkpoint.h>
#include <tread/simulation.h>

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/binary_object.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <filesystem>
#include <map>
#include <sstream>

namespace tread
{
  namespace
  {
    const std::string format_name = "tread checkpoint 2";

    /// A node of any rank under its name.
    struct StoredNode
    {
      std::array<long long, 4> key;
      double                   x[3], v[3];

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &key &x &v;
      }
    };

    template <typename Archive, typename T>
    void bytes(Archive &archive, T &value)
    {
      static_assert(std::is_trivially_copyable_v<T>);
      boost::serialization::binary_object object(&value, sizeof value);
      archive                            &object;
    }

    template <typename Archive, typename T>
    void byte_vector(Archive &archive, std::vector<T> &values)
    {
      static_assert(std::is_trivially_copyable_v<T>);
      std::size_t n = values.size();
      archive    &n;
      values.resize(n);
      if (n > 0)
        {
          boost::serialization::binary_object object(values.data(), n * sizeof(T));
          archive                            &object;
        }
    }
  } // namespace


  Checkpoint::Checkpoint(const RunFolder &folder, const MPI_Comm comm)
    : folder(folder)
    , comm(comm)
  {
  }


  std::string Checkpoint::fingerprint(const Simulation &simulation)
  {
    // All parameters but those of the output.
    std::ostringstream text;
    simulation.scene.print(text, false);
    const std::string all = text.str();
    return all.substr(0, all.find("subsection Output"));
  }


  template <typename Archive>
  void Checkpoint::state(Archive &archive, Simulation &s)
  {
    ExplicitDynamics &d = s.dynamics;
    bytes(archive, d.time);
    bytes(archive, d.n_steps);
    bytes(archive, d.totals);
    bytes(archive, d.nominal_angular_velocity);
    bytes(archive, d.start_kinetic);
    bytes(archive, d.start_potential);
    bytes(archive, d.start_strain);
    bytes(archive, d.start_hub_work);
    bytes(archive, d.start_hub_gross);
    bytes(archive, d.last_damping_power);
    bytes(archive, d.last_damping_step);
    bytes(archive, s.hub); // plain numbers only
    byte_vector(archive, s.contact.impulse_of_node);
    bytes(archive, s.target_creepage);
    bytes(archive, s.free_creepage);
    bytes(archive, s.torque_released);
    bytes(archive, s.solution_taken);
    bytes(archive, s.interval_force);
    bytes(archive, s.interval_steps);
    bytes(archive, s.next_history);
    bytes(archive, s.next_surface);
    bytes(archive, s.next_volume);
    byte_vector(archive, s.solution_patch);
    byte_vector(archive, s.passages);
    bytes(archive, s.last_force_sum);
    bytes(archive, s.last_force_low);
    bytes(archive, s.last_force_high);
    bytes(archive, s.last_steps);
    bytes(archive, s.relaxation_seconds);
    bytes(archive, s.relaxation_iterations);
    bytes(archive, s.average.measure_sums);
    bytes(archive, s.average.centre_sum);
    bytes(archive, s.average.steps);
    std::vector<std::pair<unsigned int, PatchAverage::Sum>> sums(s.average.sums.begin(),
                                                                 s.average.sums.end());
    std::size_t                                             n = sums.size();
    archive                                                &n;
    sums.resize(n);
    for (auto &[node, sum] : sums)
      {
        archive &node;
        bytes(archive, sum);
      }
    s.average.sums = std::map<unsigned int, PatchAverage::Sum>(sums.begin(), sums.end());
  }


  void Checkpoint::write(Simulation &simulation)
  {
    ExplicitDynamics &d    = simulation.dynamics;
    const Mesh       &mesh = simulation.mesh;
    simulation.contact.refresh(d.x.data(), d.v.data(), d.time_step);

    // Sums that ranks keep apart are stored as one.
    const EnergyLedger kept       = d.totals;
    const double       kept_power = d.last_damping_power;
    d.totals.damping              = dealii::Utilities::MPI::sum(kept.damping, comm);
    d.totals.external_work        = dealii::Utilities::MPI::sum(kept.external_work, comm);
    d.totals.gross_work           = dealii::Utilities::MPI::sum(kept.gross_work, comm);
    d.totals.plastic              = dealii::Utilities::MPI::sum(kept.plastic, comm);
    d.last_damping_power          = dealii::Utilities::MPI::sum(kept_power, comm);

    std::vector<StoredNode> own;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        own.push_back(
          {mesh.node_key(i), {d.x[i][0], d.x[i][1], d.x[i][2]}, {d.v[i][0], d.v[i][1], d.v[i][2]}});
    std::vector<std::vector<StoredNode>>        nodes = dealii::Utilities::MPI::gather(comm, own, 0);
    const std::vector<std::vector<CellHistory>> cells =
      dealii::Utilities::MPI::gather(comm, simulation.solid.plastic().stored(d.history), 0);

    std::string problem;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        const std::string name = "checkpoint-" + std::to_string(next_slot);
        std::ofstream     file(folder.path(name), std::ios::binary);
        if (file)
          try
            {
              boost::archive::binary_oarchive archive(file);
              std::string                     text = fingerprint(simulation);
              archive << format_name << text;
              state(archive, simulation);
              archive << nodes << cells;
            }
          catch (const std::exception &)
            {
              file.setstate(std::ios::failbit);
            }
        file.flush();
        if (!file)
          problem = "cannot write '" + folder.path(name) + "': is the disk full?";
        else
          folder.write("checkpoint.last", name + "\n");
        next_slot = 1 - next_slot;
      }
    d.totals             = kept;
    d.last_damping_power = kept_power;
    problem              = dealii::Utilities::MPI::broadcast(comm, problem, 0);
    if (!problem.empty())
      throw std::runtime_error(problem);
  }


  void Checkpoint::read(Simulation &simulation)
  {
    ExplicitDynamics &d    = simulation.dynamics;
    const Mesh       &mesh = simulation.mesh;
    std::string       name, text, found_format;
    std::ifstream     last(folder.path("checkpoint.last"));
    if (!(last >> name))
      throw SceneError("--resume: no checkpoint in '" + folder.path("") + "'");
    next_slot = name.back() == '0' ? 1 : 0;
    std::ifstream                         file(folder.path(name), std::ios::binary);
    std::vector<std::vector<StoredNode>>  nodes;
    std::vector<std::vector<CellHistory>> cells;
    try
      {
        boost::archive::binary_iarchive archive(file);
        archive >> found_format >> text;
        if (found_format != format_name)
          throw SceneError("");
        if (text != fingerprint(simulation))
          {
            std::istringstream old_lines(text), new_lines(fingerprint(simulation));
            std::string        old_line, new_line;
            while (std::getline(old_lines, old_line) && std::getline(new_lines, new_line) &&
                   old_line == new_line)
              ;
            throw SceneError(
              "--resume: the checkpoint was made with other parameters: '" +
              old_line.substr(std::min(old_line.size(), old_line.find_first_not_of(' '))) + "', now '" +
              new_line.substr(std::min(new_line.size(), new_line.find_first_not_of(' '))) + "'");
          }
        state(archive, simulation);
        archive >> nodes >> cells;
      }
    catch (const SceneError &error)
      {
        if (std::string(error.what()).empty())
          throw SceneError("--resume: '" + folder.path(name) + "' was written by another version of tread");
        throw;
      }
    catch (const std::exception &)
      {
        throw SceneError("--resume: '" + folder.path(name) + "' is damaged");
      }

    if (dealii::Utilities::MPI::this_mpi_process(comm) != 0)
      d.totals.damping = d.totals.external_work = d.totals.gross_work = d.totals.plastic =
        d.last_damping_power                                          = 0.;

    std::map<std::array<long long, 4>, const StoredNode *> by_key;
    for (const auto &list : nodes)
      for (const StoredNode &node : list)
        by_key[node.key] = &node;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      {
        const auto entry = by_key.find(mesh.node_key(i));
        if (entry == by_key.end())
          throw SceneError("--resume: '" + folder.path(name) + "' belongs to another mesh");
        d.x[i] = Row{entry->second->x[0], entry->second->x[1], entry->second->x[2], 0.};
        d.v[i] = Row{entry->second->v[0], entry->second->v[1], entry->second->v[2], 0.};
      }
    std::size_t n_restored = 0;
    for (const std::vector<CellHistory> &list : cells)
      n_restored += simulation.solid.plastic().restore(list, d.history);
    if (n_restored != simulation.solid.plastic().n_cells())
      throw SceneError("--resume: '" + folder.path(name) + "' belongs to another mesh");
    d.set_inertia();
  }
} // namespace tread
