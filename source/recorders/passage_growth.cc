// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/gathered.h>
#include <tread/base/reproducible_sum.h>
#include <tread/recorders/passage_growth.h>
#include <tread/scene/parts.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>

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

    /// Rows of all ranks in an order that does not depend on these, as sums by rows do.
    template <typename Row, typename Key>
    std::vector<Row> in_order(std::vector<Row> rows, const Key &key)
    {
      std::sort(rows.begin(), rows.end(), [&](const Row &a, const Row &b) { return key(a) < key(b); });
      return rows;
    }

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
    , variation(change)
    , variation_before(change)
    , steady_at_jump(change)
    , slope_at_jump(change)
    , deviation(change)
  {
    keep_places();
  }


  std::array<std::pair<const char *, PassageGrowth::Residue *>, 7> PassageGrowth::residues()
  {
    return {{{"passage", &last},
             {"passage_change", &change},
             {"passage_variation", &variation},
             {"passage_variation_before", &variation_before},
             {"passage_steady_at_jump", &steady_at_jump},
             {"passage_slope_at_jump", &slope_at_jump},
             {"passage_deviation", &deviation}}};
  }


  double PassageGrowth::error_of_strain() const
  {
    return largest(deviation);
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


  double PassageGrowth::product(const Residue &a, const Residue &b) const
  {
    Residue sum = a;
    sum.add(1., b);
    const double of_sum = norm(sum), of_difference = norm(a - b);
    return 0.25 * (of_sum + of_difference) * (of_sum - of_difference);
  }


  PassageGrowth::Course PassageGrowth::course() const
  {
    // What fades is what the variation has beside the slope of the jump before.
    const Residue now = variation - slope_at_jump, before = variation_before - slope_at_jump;
    const double  square = product(before, before);
    Course        course{change, slope_at_jump, now, 0.};
    if (square > 0.)
      course.factor = std::clamp(product(now, before) / square, 0., slowest_fading);
    course.fading.scale(-course.factor / (1. - course.factor));
    course.steady.add(-1., course.fading);
    if (jumps > 0)
      {
        course.slope = course.steady - steady_at_jump;
        course.slope.scale(1. / (number - number_at_jump));
        if (jumps > 1) // else what one jump has too much of the next has too little
          {
            course.slope.add(1., slope_at_jump);
            course.slope.scale(0.5);
          }
      }
    return course;
  }


  void PassageGrowth::make_uniform(Residue &residue) const
  {
    // Nodes: displacements by line.
    struct Moved
    {
      Line      line;
      long long x; ///< nm
      double    by[3];
    };
    std::vector<Moved> nodes;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (moved[i] && mesh.shared_nodes.is_owned(i) && uniform(mesh.nodes[i]))
        {
          const Archive::Key key = mesh.node_key(i);
          const Vector3     &x   = residue.places[i];
          nodes.push_back({{{key[2], key[3]}},
                           key[1],
                           {x[0] - mesh.nodes[i][0], x[1] - mesh.nodes[i][1], x[2] - mesh.nodes[i][2]}});
        }
    std::map<Line, std::pair<Vector3, double>> by_line;
    for (const Moved &node :
         in_order(gathered(nodes, mesh.comm), [](const Moved &n) { return std::tuple(n.line, n.x); }))
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
    for (const CellHistory &cell :
         in_order(gathered(middle, mesh.comm), [](const CellHistory &c) { return c.key; }))
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
    variation_before   = variation;
    variation          = here - last - change;
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
        Residue off = course().steady - steady_at_jump;
        off.add(-(number - number_at_jump), slope_at_jump);
        deviation.add(0.5 * last_jump, off);
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
        const double rate = norm(change), irregular = norm(variation);
        if (irregular > section.irregularity * rate)
          return 0;
        if (jumps > 0)
          n = std::min(n, 2. * last_jump); // a slope is as sure as the way is long over which it is known
        else if (irregular > 0.)           // nobody knows yet what will fade
          n = std::min(n, section.change_in_a_jump * rate / irregular);
        n = std::min(n, section.strain_of_a_jump / largest_rate);
        // The rate n passages on is another one by n slope - (1 - factor^n) fading.
        const Course course = this->course();
        const double slope  = product(course.slope, course.slope),
                     fading = product(course.fading, course.fading),
                     both = product(course.slope, course.fading), most = section.change_in_a_jump * rate;
        for (n = std::floor(n); n >= 2.; n -= 1.)
          if (const double faded = 1. - std::pow(course.factor, n);
              n * n * slope - 2. * n * faded * both + faded * faded * fading <= most * most)
            break;
        if (section.strain_at_failure > 0.)
          n = std::min(n, (section.strain_at_failure - strain) / largest_rate);
      }
    return n >= 2. ? static_cast<unsigned int>(n) : 0;
  }


  void PassageGrowth::skip(const unsigned int n)
  {
    const Course course = this->course();
    if (has_shaken_down())
      slope_at_jump.scale(0.);
    else
      {
        const Residue  before      = last - change;
        const Residue  before_that = before - (change - variation);
        PlasticHistory stresses =
          stresses_in(n, stresses_of(last), stresses_of(before), stresses_of(before_that));
        last.add(n, course.steady);
        last.add(0.5 * n * (n + 1.), course.slope);
        last.add(course.factor * (1. - std::pow(course.factor, n)) / (1. - course.factor), course.fading);
        // The equivalent plastic strain is what it has become by its own rate.
        solid.plastic().copy(stresses, last.steel, PlasticCells::strain_at, PlasticCells::hourglass_at);
        last.steel = solid.plastic().where_flowing(
          change.steel,
          solid.plastic().with_logarithms(solid.plastic().from_stresses(last.places.data(), stresses)),
          last.steel);
        slope_at_jump = course.slope;
      }
    steady_at_jump = course.steady;
    number_at_jump = number;
    number += n;
    last_jump = n;
    rolled    = 0;
    skipped += n;
    ++jumps;
  }


  PlasticHistory PassageGrowth::stresses_of(const Residue &residue) const
  {
    return solid.plastic().with_stresses(residue.places.data(),
                                         solid.plastic().from_logarithms(residue.steel));
  }


  PlasticHistory PassageGrowth::stresses_in(const unsigned int    n,
                                            const PlasticHistory &now,
                                            const PlasticHistory &before,
                                            const PlasticHistory &before_that) const
  {
    const PlasticCells &cells = solid.plastic();
    PlasticHistory      in_n = now, change_now = now, change_before = before;
    for (std::size_t k = 0; k < now.values.size(); ++k)
      {
        change_now.values[k] -= before.values[k];
        change_before.values[k] -= before_that.values[k];
      }
    for (const auto &[begin, end] :
         {std::pair(0U, PlasticCells::strain_at),
          std::pair(PlasticCells::backstress_at,
                    PlasticCells::backstress_at + 6 * PlasticMaterial::max_backstresses)})
      {
        const auto product = [&](const PlasticHistory &a, const PlasticHistory &b) {
          const std::vector<double> by_cell = cells.products(a, b, begin, end);
          return reproducible_sum(
            judged.size(), [&](const std::size_t c) { return judged[c] ? by_cell[c] : 0.; }, mesh.comm);
        };
        // Near 1 where they go on changing as they did; what comes and goes, and noise, has less.
        const double square =
          std::max(product(change_now, change_now), product(change_before, change_before));
        const double share = square > 0. ? std::max(product(change_now, change_before) / square, 0.) : 0.;
        double       sum   = 0.;
        for (unsigned int i = 0; i < n; ++i)
          sum = share * (1. + sum);
        cells.add(in_n, sum, change_now, begin, end);
      }
    return in_n;
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
    // As a step begins, and a run that goes on from here.
    mesh.distribute_hanging_nodes(state.x_damped.data());
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
    archive.same(number, number_at_jump, strain, largest_rate, place_of_strain, rolled, last_jump, jumps,
                 skipped);
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
