// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/gathered.h>
#include <tread/base/reproducible_sum.h>
#include <tread/scene/parts.h>
#include <tread/simulation/passage_growth.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace tread
{
  namespace
  {
    const std::array<const char *, 3> components{{"_x_m", "_y_m", "_z_m"}};

    /// y and z of a place of the reference configuration, nm: a line along the rail.
    using Line = std::array<long long, 2>;

    /// Least and largest y and z of a cell, nm.
    struct CrossSection
    {
      Line least{{std::numeric_limits<long long>::max(), std::numeric_limits<long long>::max()}},
        largest{{std::numeric_limits<long long>::lowest(), std::numeric_limits<long long>::lowest()}};

      bool contains(const Line &line) const
      {
        return least[0] <= line[0] && line[0] <= largest[0] && least[1] <= line[1] && line[1] <= largest[1];
      }
    };

    /// Of histories of cells with logarithms.
    struct Mean
    {
      decltype(CellHistory::values) sum{};
      double                        n = 0.;

      void add(const decltype(sum) &values)
      {
        for (std::size_t k = 0; k < values.size(); ++k)
          sum[k] += values[k];
        n += 1.;
      }
      decltype(sum) value() const
      {
        decltype(sum) mean = sum;
        for (double &component : mean)
          component /= n;
        return mean;
      }
    };

    /// By the keys that plastic cells have.
    std::map<Archive::Key, CrossSection> sections_of_cells(const Mesh &mesh)
    {
      std::map<Archive::Key, CrossSection> sections;
      for (const Mesh::Cell &cell : mesh.cells)
        {
          CrossSection     section;
          dealii::Point<3> centre;
          for (const unsigned int i : cell.nodes)
            {
              const dealii::Point<3> &p = mesh.nodes[i];
              for (unsigned int d = 0; d < 2; ++d)
                {
                  section.least[d]   = std::min(section.least[d], std::llround(1e9 * p[d + 1]));
                  section.largest[d] = std::max(section.largest[d], std::llround(1e9 * p[d + 1]));
                }
              centre += p / 8.;
            }
          sections[PlasticCells::key_of(cell.body, centre)] = section;
        }
      return sections;
    }
  } // namespace


  PassageGrowth::Residue PassageGrowth::Residue::operator-(const Residue &other) const
  {
    Residue difference = *this;
    difference.add(-1., other);
    return difference;
  }


  void PassageGrowth::Residue::add(const double factor, const Residue &other)
  {
    for (std::size_t k = 0; k < steel.values.size(); ++k)
      steel.values[k] += factor * other.steel.values[k];
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] += factor * other.places[i];
  }


  void PassageGrowth::Residue::scale(const double factor)
  {
    for (Lanes &value : steel.values)
      value *= factor;
    for (Vector3 &place : places)
      place = factor * place;
  }


  PassageGrowth::PassageGrowth(const RatchetingSection                             &section,
                               const Mesh                                          &mesh,
                               const Solid                                         &solid,
                               State                                               &state,
                               const std::vector<char>                             &judged,
                               const std::vector<char>                             &moved,
                               const std::function<bool(const dealii::Point<3> &)> &uniform)
    : section(section)
    , mesh(mesh)
    , solid(solid)
    , state(state)
    , judged(judged)
    , moved(moved)
    , uniform(uniform)
    , last{solid.plastic().with_logarithms(state.history), state.positions()}
    , change(last - last)
    , change_before(change)
    , change_at_jump(change)
    , expected(change)
  {
    keep_places();
  }


  std::array<std::pair<const char *, PassageGrowth::Residue *>, 5> PassageGrowth::residues()
  {
    return {{{"passage", &last},
             {"passage_change", &change},
             {"passage_change_before", &change_before},
             {"passage_change_at_jump", &change_at_jump},
             {"passage_slope", &expected}}};
  }


  PassageGrowth::Residue PassageGrowth::now() const
  {
    Residue here{solid.plastic().with_logarithms(state.history), state.positions()};
    if (uniform)
      make_uniform(here);
    return here;
  }


  double PassageGrowth::norm(const Residue &residue) const
  {
    const std::vector<double> strains = solid.plastic().net_plastic_strain(residue.steel);
    const auto                square  = [&](const std::size_t c) {
      return judged[c] ? strains[c] * strains[c] : 0.;
    };
    // Of whatever size: those of steel that shakes down are below what a sum of numbers near 1 resolves.
    return std::sqrt(reproducible_sum(judged.size(), square, mesh.comm));
  }


  double PassageGrowth::largest(const Residue &residue) const
  {
    const std::vector<double> strains = solid.plastic().net_plastic_strain(residue.steel);
    double                    most    = 0.;
    for (unsigned int c = 0; c < judged.size(); ++c)
      if (judged[c])
        most = std::max(most, strains[c]);
    return dealii::Utilities::MPI::max(most, mesh.comm);
  }


  PassageGrowth::Residue PassageGrowth::slope() const
  {
    Residue slope = change - change_at_jump;
    slope.scale(1. / (number - number_at_jump));
    if (jumps > 1) // else what one jump has too much of the next has too little
      {
        slope.add(1., expected);
        slope.scale(0.5);
      }
    return slope;
  }


  void PassageGrowth::make_uniform(Residue &residue) const
  {
    // Nodes: displacements by line.
    struct Moved
    {
      Line   line;
      double by[3];
    };
    std::vector<Moved> nodes;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (moved[i] && mesh.shared_nodes.is_owned(i) && uniform(mesh.nodes[i]))
        {
          const Archive::Key key = mesh.node_key(i);
          const Vector3     &x   = residue.places[i];
          nodes.push_back({{{key[2], key[3]}},
                           {x[0] - mesh.nodes[i][0], x[1] - mesh.nodes[i][1], x[2] - mesh.nodes[i][2]}});
        }
    std::map<Line, std::pair<Vector3, double>> by_line;
    for (const Moved &node : gathered(nodes, mesh.comm))
      {
        auto &[sum, n] = by_line.try_emplace(node.line, Vector3{}, 0.).first->second;
        sum += Vector3{node.by[0], node.by[1], node.by[2], 0.};
        n += 1.;
      }
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (moved[i])
        {
          const Archive::Key key   = mesh.node_key(i);
          const auto         found = by_line.find(Line{{key[2], key[3]}});
          if (found == by_line.end())
            continue;
          const auto &[sum, n] = found->second;
          residue.places[i] =
            Vector3{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.} + (1. / n) * sum;
        }

    // Cells: histories, which can be added with logarithms.
    const std::vector<CellHistory> own = solid.plastic().stored(residue.steel);
    std::vector<CellHistory>       middle, changed;
    for (const CellHistory &cell : own)
      if (cell.key[0] == rail_body && uniform({1e-9 * cell.key[1], 1e-9 * cell.key[2], 1e-9 * cell.key[3]}))
        middle.push_back(cell);
    std::map<Line, Mean> means;
    for (const CellHistory &cell : gathered(middle, mesh.comm))
      means[{{cell.key[2], cell.key[3]}}].add(cell.values);
    const std::map<Archive::Key, CrossSection> sections = sections_of_cells(mesh);
    for (CellHistory cell : own)
      {
        if (cell.key[0] != rail_body)
          continue;
        Mean       mean;
        const auto same      = means.find({{cell.key[2], cell.key[3]}});
        const bool is_larger = same == means.end(); // than those of the middle, before or behind the path
        if (!is_larger)
          mean = same->second;
        else
          for (const auto &[line, of_line] : means)
            if (sections.at(cell.key).contains(line))
              mean.add(of_line.value());
        if (mean.n == 0.)
          continue;
        cell.values = mean.value();
        if (is_larger) // its own hourglass modes are others
          std::fill_n(cell.values.begin() + PlasticCells::hourglass_at, PlasticCells::n_hourglass, 0.);
        changed.push_back(cell);
      }
    solid.plastic().restore(changed, residue.steel);
  }


  void PassageGrowth::note(const double number_of_passage)
  {
    number             = number_of_passage;
    const Residue here = now();
    change_before      = change;
    change             = here - last;
    last               = here;
    ++rolled;
    strain       = largest(last);
    largest_rate = largest(change);

    const std::vector<double> strains = solid.plastic().net_plastic_strain(last.steel);
    // Of several ranks and of several cells as strained, the one that is last along the path.
    std::array<double, 3> found{{-1e300, -1e300, -1e300}};
    for (unsigned int c = 0; c < judged.size(); ++c)
      if (judged[c] && strains[c] == strain)
        {
          dealii::Point<3> centre;
          for (const unsigned int i : mesh.cells[c].nodes)
            centre += mesh.nodes[i] / 8.;
          if (const std::array<double, 3> candidate{{centre[0], centre[1], centre[2]}}; candidate > found)
            found = candidate;
        }
    for (unsigned int d = 0; d < 3; ++d)
      {
        // Ranks that have a lesser coordinate leave the place to the others.
        place_of_strain[d] = dealii::Utilities::MPI::max(found[d], mesh.comm);
        if (found[d] != place_of_strain[d])
          found.fill(-1e300);
      }

    if (jumps > 0 && rolled == section.rolled_between)
      {
        Residue difference = change - change_at_jump;
        difference.add(-(number - number_at_jump), expected);
        error += 0.5 * last_jump * largest(difference);
      }
    keep_places();
  }


  unsigned int PassageGrowth::passages_to_skip(const unsigned int remaining) const
  {
    if (!section.jumps || rolled < section.rolled_between || remaining <= section.rolled_between)
      return 0;
    double n = std::min<double>(section.longest_jump, remaining - section.rolled_between);
    if (!has_shaken_down())
      {
        const double rate      = norm(change);
        const double variation = norm(change - change_before);
        if (variation > section.irregularity * rate)
          return 0;
        n = std::min(n, section.strain_of_a_jump / largest_rate);
        // What a jump disturbs fades in the passages behind it: extrapolated it would grow from jump to jump.
        const double in_a_one = std::max(variation, jumps > 0 ? norm(slope()) : 0.);
        if (in_a_one > 0.)
          n = std::min(n, section.change_in_a_jump * rate / in_a_one);
        if (section.strain_at_failure > 0.)
          n = std::min(n, (section.strain_at_failure - strain) / largest_rate);
      }
    return n >= 2. ? static_cast<unsigned int>(n) : 0;
  }


  void PassageGrowth::skip(const unsigned int n)
  {
    if (has_shaken_down())
      expected.scale(0.);
    else
      {
        if (jumps > 0)
          expected = slope();
        last.add(n, change);
        last.add(0.5 * n * (n + 1.), expected);
      }
    change_at_jump = change;
    number_at_jump = number;
    number += n;
    last_jump = n;
    rolled    = 0;
    skipped += n;
    ++jumps;
  }


  void PassageGrowth::begin_next(const unsigned int n)
  {
    if (n > 0)
      skip(n);
    if (n == 0 && !uniform)
      return;
    state.history = solid.plastic().from_logarithms(last.steel);
    // Backstresses may be held, and what is kept is what there is.
    last.steel = solid.plastic().with_logarithms(state.history);
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (moved[i])
        state.set_position(i, last.places[i]);
    keep_places();
  }


  void PassageGrowth::keep_places()
  {
    for (const auto &[name, residue] : residues())
      for (unsigned int d = 0; d < 3; ++d)
        {
          std::vector<double> &field = state.fields[std::string(name) + components[d]];
          field.resize(residue->places.size());
          for (std::size_t i = 0; i < field.size(); ++i)
            field[i] = residue->places[i][d];
        }
  }


  void PassageGrowth::serialize(Archive &archive)
  {
    archive.same(number, number_at_jump, strain, largest_rate, error, place_of_strain, rolled, last_jump,
                 jumps, skipped);
    for (const auto &[name, residue] : residues())
      {
        solid.plastic().serialize(archive, residue->steel);
        for (unsigned int d = 0; d < 3 && archive.restores(); ++d)
          {
            const std::vector<double> &field = state.fields[std::string(name) + components[d]];
            for (std::size_t i = 0; i < field.size(); ++i)
              residue->places[i][d] = field[i];
          }
      }
  }
} // namespace tread
