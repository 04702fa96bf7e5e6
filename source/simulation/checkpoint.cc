// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/simulation/checkpoint.h>
#include <tread/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/crc.hpp>
#include <boost/serialization/binary_object.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

namespace tread
{
  namespace
  {
    /// A node of any rank under its name.
    struct StoredNode
    {
      std::array<long long, 4> key;
      double                   x_damped[3], v[3];
    };

    /// Work that a rank has summed for its own cells and nodes, J, and power, W.
    struct RankWork
    {
      double damping = 0., external_work = 0., gross_work = 0., plastic = 0., friction = 0., contact = 0.,
             contact_on_nodes = 0., last_damping_power = 0.;
    };

    template <typename Archive, typename T>
    void bytes(Archive &archive, T &value)
    {
      static_assert(std::is_trivially_copyable_v<T>);
      boost::serialization::binary_object object(&value, sizeof value);
      archive                            &object;
    }

    /// The first line of the file: what can be read by whom, and whether it is whole.
    struct Header
    {
      std::string  layout;
      std::size_t  size     = 0;
      unsigned int checksum = 0;

      Header() = default;
      explicit Header(const std::string &content)
        : layout(own_layout())
        , size(content.size())
        , checksum(sum(content))
      {
      }

      /// To be counted up when the order or the meaning of what is stored changes; sizes change by
      /// themselves.
      static std::string own_layout()
      {
        std::string text = "tread-checkpoint-9";
        for (const std::size_t n :
             {sizeof(StoredNode), sizeof(EnergyLedger), sizeof(StrainEnergy), sizeof(StepTimes),
              sizeof(WheelHub), sizeof(PatchNode), sizeof(PatchMeasures), sizeof(CellHistory),
              sizeof(Passage), sizeof(ContactProblem::Constraint), sizeof(ContactProblem::Entry),
              sizeof(RankWork), sizeof(StoredPeak)})
          text += "." + std::to_string(n);
        return text;
      }

      static unsigned int sum(const std::string &content)
      {
        boost::crc_32_type crc;
        crc.process_bytes(content.data(), content.size());
        return crc.checksum();
      }
    };

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
    // All parameters but those of the output, of which only the columns of tables that grow must stay.
    std::ostringstream text;
    simulation.scene.print(text, false);
    const std::string all = text.str();
    std::string       supports;
    for (const int number : simulation.scene.output.supports)
      supports += (supports.empty() ? "" : ",") + std::to_string(number);
    return all.substr(0, all.find("subsection Output")) + "set Supports = " + supports +
           "\nset Cells = " + simulation.scene.output.cells + "\n";
  }


  template <typename Archive>
  void Checkpoint::state(Archive &archive, Simulation &s)
  {
    ExplicitDynamics &d = s.dynamics;
    bytes(archive, d.highest_of_step);
    bytes(archive, d.bound_found_stable);
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
    bytes(archive, d.damping_is_sampled);
    bytes(archive, d.start_springs);
    bytes(archive, d.start_dissipated);
    if (s.supports)
      {
        byte_vector(archive, s.supports->displacement);
        byte_vector(archive, s.supports->velocity);
        bytes(archive, s.supports->damper_work);
      }
    bytes(archive, s.interval_start_time);
    bytes(archive, s.interval_start_speed);
    bytes(archive, d.times);
    bytes(archive, s.wall_seconds);
    bytes(archive, s.hub); // plain numbers only
    Contact &c = s.contact;
    byte_vector(archive, c.problem.constraints);
    byte_vector(archive, c.problem.entries);
    byte_vector(archive, c.involved);
    byte_vector(archive, c.position);
    byte_vector(archive, c.impulse);
    byte_vector(archive, c.previous_impulse);
    byte_vector(archive, c.slid);
    archive &c.corners_around;
    bytes(archive, c.steps_since_normals);
    bytes(archive, c.time_since_refresh);
    bytes(archive, c.time_to_refresh);
    bytes(archive, c.closing_speed);
    bytes(archive, c.travelled);
    bytes(archive, c.allowed_travel);
    bytes(archive, c.unconverged_steps);
    std::vector<unsigned int> begin_of_strip = c.strips.begins();
    byte_vector(archive, begin_of_strip);
    if constexpr (Archive::is_loading::value)
      c.make_room(begin_of_strip);
    bytes(archive, s.target_creepage);
    bytes(archive, s.free_creepage);
    bytes(archive, s.torque_released);
    bytes(archive, s.solution_taken);
    bytes(archive, s.interval_force);
    bytes(archive, s.interval_steps);
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


  std::string Checkpoint::own_part(const ExplicitDynamics &d)
  {
    const RankWork work{d.totals.damping,          d.totals.external_work, d.totals.gross_work,
                        d.totals.plastic,          d.totals.friction,      d.totals.contact,
                        d.totals.contact_on_nodes, d.last_damping_power};
    std::string    part(reinterpret_cast<const char *>(&work), sizeof work);
    for (const ExplicitDynamics::SlowShares &shares : d.slow_shares)
      part.append(reinterpret_cast<const char *>(shares.steady.data()), shares.steady.size() * sizeof(Row));
    const std::size_t size = part.size();
    return std::string(reinterpret_cast<const char *>(&size), sizeof size) + part;
  }


  void Checkpoint::restore_parts(ExplicitDynamics &d, const std::string &parts) const
  {
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
    RankWork           sum, own;
    const char        *own_steady = nullptr;
    std::size_t        n_parts = 0, own_size = 0;
    for (std::size_t i = 0, size = 0; i < parts.size(); i += size, ++n_parts)
      {
        std::memcpy(&size, &parts[i], sizeof size);
        i += sizeof size;
        RankWork work;
        std::memcpy(&work, &parts[i], sizeof work);
        for (double RankWork::*value : {&RankWork::damping, &RankWork::external_work, &RankWork::gross_work,
                                        &RankWork::plastic, &RankWork::friction, &RankWork::contact,
                                        &RankWork::contact_on_nodes, &RankWork::last_damping_power})
          sum.*value += work.*value;
        if (n_parts == rank)
          {
            own        = work;
            own_steady = &parts[i] + sizeof work;
            own_size   = size - sizeof work;
          }
      }
    std::size_t n_shares = 0;
    for (const ExplicitDynamics::SlowShares &shares : d.slow_shares)
      n_shares += shares.nodes.size();
    const bool same_ranks = !dealii::Utilities::MPI::logical_or(
      n_parts != dealii::Utilities::MPI::n_mpi_processes(comm) || own_size != n_shares * sizeof(Row), comm);
    // On other ranks the steady shares of slow cells' forces begin anew, and the first has all work.
    const RankWork work       = same_ranks ? own : rank == 0 ? sum : RankWork();
    d.totals.damping          = work.damping;
    d.totals.external_work    = work.external_work;
    d.totals.gross_work       = work.gross_work;
    d.totals.plastic          = work.plastic;
    d.totals.friction         = work.friction;
    d.totals.contact          = work.contact;
    d.totals.contact_on_nodes = work.contact_on_nodes;
    d.last_damping_power      = work.last_damping_power;
    d.slow_shares_known       = same_ranks;
    const char *next_steady   = own_steady;
    if (same_ranks)
      for (ExplicitDynamics::SlowShares &shares : d.slow_shares)
        {
          std::memcpy(shares.steady.data(), next_steady, shares.steady.size() * sizeof(Row));
          next_steady += shares.steady.size() * sizeof(Row);
        }
  }


  void Checkpoint::write(Simulation &simulation)
  {
    ExplicitDynamics &d    = simulation.dynamics;
    const Mesh       &mesh = simulation.mesh;

    // Times are the slowest rank's.
    const StepTimes kept_times = d.times;
    for (double StepTimes::*time : {&StepTimes::internal_forces, &StepTimes::contact, &StepTimes::search,
                                    &StepTimes::communication, &StepTimes::nodes})
      d.times.*time = dealii::Utilities::MPI::max(kept_times.*time, comm);

    std::string nodes;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        {
          const StoredNode node{mesh.node_key(i),
                                {d.x_damped[i][0], d.x_damped[i][1], d.x_damped[i][2]},
                                {d.v[i][0], d.v[i][1], d.v[i][2]}};
          nodes.append(reinterpret_cast<const char *>(&node), sizeof node);
        }
    nodes = folder.gather(nodes);
    std::string cells;
    for (const CellHistory &cell : simulation.solid.plastic().stored(d.history))
      cells.append(reinterpret_cast<const char *>(&cell), sizeof cell);
    cells                   = folder.gather(cells);
    const std::string parts = folder.gather(own_part(d));
    simulation.contact.complete_state();
    std::string peaks;
    if (simulation.strip)
      for (const StoredPeak &peak : simulation.strip->stored())
        peaks.append(reinterpret_cast<const char *>(&peak), sizeof peak);
    peaks = folder.gather(peaks);

    std::string problem;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          std::ostringstream content;
          {
            boost::archive::binary_oarchive archive(content);
            std::string                     text = fingerprint(simulation);
            archive << text;
            bytes(archive, d.critical_step);
            state(archive, simulation);
            archive << nodes << cells << parts << peaks;
          }
          const Header       header(content.str());
          std::ostringstream file;
          file << header.layout << ' ' << header.size << ' ' << header.checksum << '\n' << content.str();
          const std::string name = "checkpoint-" + std::to_string(next_slot);
          folder.write(name, file.str());
          folder.write("checkpoint.last", name + "\n");
          next_slot = 1 - next_slot;
        }
      catch (const std::exception &error)
        {
          problem = error.what();
        }
    d.times = kept_times;
    problem = dealii::Utilities::MPI::broadcast(comm, problem, 0);
    if (!problem.empty())
      throw std::runtime_error(problem);
  }


  void Checkpoint::read(Simulation &simulation)
  {
    ExplicitDynamics &d    = simulation.dynamics;
    const Mesh       &mesh = simulation.mesh;
    // Rank 0 reads, and all find the same.
    const bool  reads = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    std::string name, content;
    if (reads)
      std::ifstream(folder.path("checkpoint.last")) >> name;
    name = dealii::Utilities::MPI::broadcast(comm, name, 0);
    if (name.empty())
      throw SceneError("--resume: no checkpoint in '" + folder.path("") + "'");
    next_slot = name.back() == '0' ? 1 : 0;

    const std::string path = folder.path(name);
    Header            header;
    if (reads)
      {
        std::ifstream file(path, std::ios::binary);
        file >> header.layout >> header.size >> header.checksum;
        file.get();
        content.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
      }
    header.layout = dealii::Utilities::MPI::broadcast(comm, header.layout, 0);
    if (header.layout.empty())
      throw SceneError("--resume: cannot read '" + path + "'");
    if (header.layout != Header::own_layout())
      throw SceneError("--resume: '" + path + "' was not written by this version of tread");
    const bool whole = header.size == content.size() && header.checksum == Header::sum(content);
    if (!dealii::Utilities::MPI::broadcast(comm, whole, 0))
      throw SceneError("--resume: '" + path + "' is damaged");
    content = dealii::Utilities::MPI::broadcast(comm, content, 0);

    std::istringstream              stream(content);
    boost::archive::binary_iarchive archive(stream);
    std::string                     text;
    archive >> text;
    if (text != fingerprint(simulation))
      {
        std::istringstream old_lines(text), new_lines(fingerprint(simulation));
        std::string        old_line, new_line;
        while (std::getline(old_lines, old_line) && std::getline(new_lines, new_line) && old_line == new_line)
          ;
        throw SceneError("--resume: the checkpoint was made with other parameters: '" +
                         old_line.substr(std::min(old_line.size(), old_line.find_first_not_of(' '))) +
                         "', now '" +
                         new_line.substr(std::min(new_line.size(), new_line.find_first_not_of(' '))) + "'");
      }
    bytes(archive, d.critical_step);
    d.set_inertia(); // first, as it looks for the pairs in contact, which are read
    state(archive, simulation);
    std::string nodes, cells, parts, peaks;
    archive >> nodes >> cells >> parts >> peaks;
    restore_parts(d, parts);

    std::map<std::array<long long, 4>, StoredNode> by_key;
    for (std::size_t i = 0; i < nodes.size(); i += sizeof(StoredNode))
      {
        StoredNode node;
        std::memcpy(&node, nodes.data() + i, sizeof node);
        by_key[node.key] = node;
      }
    bool missing   = false;
    d.damping_time = d.parameters.damping_steps * d.time_step;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (const auto entry = by_key.find(mesh.node_key(i)); entry != by_key.end())
        {
          const StoredNode &node = entry->second;
          d.x_damped[i]          = Row{node.x_damped[0], node.x_damped[1], node.x_damped[2], 0.};
          d.v[i]                 = Row{node.v[0], node.v[1], node.v[2], 0.};
        }
      else
        missing = true;
    std::vector<CellHistory> histories(cells.size() / sizeof(CellHistory));
    if (!histories.empty())
      std::memcpy(histories.data(), cells.data(), histories.size() * sizeof(CellHistory));
    const PlasticCells &plastic = simulation.solid.plastic();
    missing                     = plastic.restore(histories, d.history) != plastic.n_cells() || missing;
    if (dealii::Utilities::MPI::logical_or(missing, comm))
      throw SceneError("--resume: '" + path + "' belongs to another mesh");
    std::vector<StoredPeak> stored_peaks(peaks.size() / sizeof(StoredPeak));
    if (!stored_peaks.empty())
      std::memcpy(stored_peaks.data(), peaks.data(), stored_peaks.size() * sizeof(StoredPeak));
    if (simulation.strip)
      simulation.strip->restore(stored_peaks);
    d.prepare_step();
  }
} // namespace tread
