// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/reproducible_sum.h>
#include <tread/output/summary_keys.h>
#include <tread/recorders/passages.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/parts.h>
#include <tread/scene/recorded.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>

namespace tread
{
  const Columns<Passage> &passage_columns()
  {
    using R = Passage;
    static const Columns<R> columns{
      {"passage", "", "Number of the wheel that has rolled over",
       [](const R &r) {
         return r.number;
       }},
      {"skipped", "", "Passages before it over which the change was extrapolated",
       [](const R &r) {
         return r.skipped;
       }},
      {"settlement", "um",
       "Of the rail's surface in the middle of the path since before the first wheel, downwards, without "
       "load: the first row's is known when the second wheel stands at the beginning, and never where the "
       "steel failed before",
       [](const R &r) {
         return r.settlement;
       }},
      {"shift", "um", "The same along the rail, forward",
       [](const R &r) {
         return r.shift;
       }},
      {"equivalent_plastic_strain", "percent", "Largest of the rail's cells in the middle of the path",
       [](const R &r) {
         return r.plastic_strain;
       }},
      {"net_plastic_strain", "percent",
       "Largest there of what is left of the plastic strain, equivalent, without what goes forth and back",
       [](const R &r) {
         return r.net_strain;
       }},
      {"net_plastic_strain_of_passage", "percent", "Largest change there in this passage",
       [](const R &r) {
         return r.growth;
       }},
      {"residual_von_mises", "MPa", "Largest stress there, likewise without load",
       [](const R &r) {
         return r.residual_stress;
       }},
      {"plastic_work", "J", "Of this passage",
       [](const R &r) {
         return r.plastic_work;
       }},
      {"frictional_work", "J", "Of this passage",
       [](const R &r) {
         return r.frictional_work;
       }},
      {"traction_coefficient", "", "Mean over the last 10 mm of the passage",
       [](const R &r) {
         return r.traction_coefficient;
       }},
      {"max_pressure", "MPa", "Largest of a node at the solution instant",
       [](const R &r) {
         return r.max_pressure;
       }},
      {"energy_residual_share", "", "Residual over the gross work",
       [](const R &r) {
         return r.energy_residual_share;
       }},
      {"energy_residual_of_dissipated", "", "Residual over the dissipated work", [](const R &r) {
         return r.energy_residual_of_dissipated;
       }}};
    return columns;
  }


  namespace
  {
    const bool passages_are_known         = know_table(describe("passages.csv", passage_columns()));
    const bool keys_of_passages_are_known = know_summary_keys(
      SummaryGroup::passages,
      {{"passages_rolled", "Those that were rolled, and not left out by 'Ratcheting/Jumps'"},
       {"passages_left_out", "Those over which the change of the steel was extrapolated"},
       {"jumps", "How often passages were left out"},
       {"net_plastic_strain",
        "Largest equivalent of what is left of the rail's plastic strain after the last passage, without "
        "what goes forth and back, of the cells in the middle of the path"},
       {"net_plastic_strain_y_m", "y of that cell's centre, before it was deformed"},
       {"net_plastic_strain_depth_m", "Its depth"},
       {"net_plastic_strain_of_last_passage", "Largest change of it in the last passage, of the same cells"},
       {"net_plastic_strain_error_estimate",
        "How far the jumps may have put it off: half the passages left out times how far the change per "
        "passage behind the jump was from the expected one, summed"},
       {"passages_to_failure", "Passage with which it reached 'Ratcheting/Strain at failure (%)'"}});

    /// Whether a place of the reference configuration is where passages are compared, in the middle of the
    /// path.
    bool is_in_middle_of(const Scene &scene, const dealii::Point<3> &p)
    {
      constexpr double half_length = 5e-3;
      return std::abs(p[0] - 0.5 * (scene.path_begin() + scene.path_end())) <= half_length;
    }

    std::vector<unsigned int> cells_in_middle(const Model &model)
    {
      std::vector<unsigned int> cells;
      for (unsigned int c = 0; c < model.mesh.cells.size(); ++c)
        if (model.solid.plastic().contains(c) && model.mesh.cells[c].body == rail_body &&
            is_in_middle_of(model.scene, model.mesh.nodes[model.mesh.cells[c].nodes[0]]))
          cells.push_back(c);
      return cells;
    }

    /// Nodes of the rail's surface in the middle of the path, as near to its line as there are any.
    std::vector<unsigned int> nodes_on_line(const Model &model)
    {
      const Scene              &scene = model.scene;
      std::vector<unsigned int> nodes;
      for (const unsigned int i : model.mesh.boundary_nodes(rail_body, Boundary::contact))
        if (const dealii::Point<3> &p = model.mesh.nodes[i];
            model.mesh.shared_nodes.is_owned(i) && is_in_middle_of(scene, p) &&
            scene.stance().is_on_path(p, scene.mesh.finest_cell))
          nodes.push_back(i);
      return nodes;
    }

    PassageGrowth make_growth(Model &model, const std::vector<unsigned int> &in_middle)
    {
      const Mesh       &mesh = model.mesh;
      std::vector<char> judged(mesh.cells.size(), false), of_rail(mesh.nodes.size(), false);
      for (const unsigned int c : in_middle)
        judged[c] = true;
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        of_rail[i] = mesh.node_bodies[i] == rail_body;
      std::function<bool(const dealii::Point<3> &)> uniform;
      if (model.scene.ratcheting.uniform)
        uniform = [&scene = model.scene](const dealii::Point<3> &p) {
          return is_in_middle_of(scene, p);
        };
      return PassageGrowth(model.scene.ratcheting, mesh, model.solid, model.dynamics.state, judged, of_rail,
                           uniform);
    }
  } // namespace


  Passages::Middle Passages::Middle::operator-(const Middle &other) const
  {
    Middle difference{settlement - other.settlement, shift - other.shift, stress};
    for (std::size_t k = 0; k < stress.size(); ++k)
      for (unsigned int d = 0; d < 6; ++d)
        difference.stress[k][d] -= other.stress[k][d];
    return difference;
  }


  Passages::Passages(Model &model, const EndOfWay &end_of_way, const Solution &solution)
    : model(model)
    , end_of_way(end_of_way)
    , solution(solution)
    , judged(cells_in_middle(model))
    , on_line(nodes_on_line(model))
    , growth(make_growth(model, judged))
  {
    at_first_start.stress.resize(judged.size());
    at_last_end.stress.resize(judged.size());
    of_load.stress.resize(judged.size());
  }


  Passages::Middle Passages::measure_middle() const
  {
    const State            &state = model.dynamics.state;
    ReproducibleSum<double> settled, shifted;
    for (const unsigned int i : on_line)
      {
        const dealii::Point<3> &p = model.mesh.nodes[i];
        settled.add(p[2] - state.position(i)[2]);
        shifted.add(state.position(i)[0] - p[0]);
      }
    const double n_nodes = dealii::Utilities::MPI::sum<double>(on_line.size(), model.comm);
    Middle       middle{settled.value(model.comm) / n_nodes, shifted.value(model.comm) / n_nodes, {}};
    const std::vector<std::array<double, 6>> stress =
      model.solid.cauchy_stress(state.positions().data(), state.history);
    for (const unsigned int c : judged)
      middle.stress.push_back(stress[c]);
    return middle;
  }


  void Passages::note(const Middle &left, Passage &passage) const
  {
    double residual = 0.;
    for (const std::array<double, 6> &stress : left.stress)
      residual = std::max(residual, von_mises(stress));
    passage.settlement      = left.settlement;
    passage.shift           = left.shift;
    passage.residual_stress = dealii::Utilities::MPI::max(residual, model.comm);
  }


  void Passages::start()
  {
    if (passages.empty())
      at_first_start = measure_middle();
    else if (skipped == 0)
      {
        const Middle left = measure_middle() - at_first_start;
        note(left, passages.back());
        of_load = at_last_end - left;
      }
  }


  void Passages::end(RunFolder &folder, Progress &progress)
  {
    Passage passage{};
    passage.number  = (passages.empty() ? 0. : passages.back().number) + skipped + 1.;
    passage.skipped = skipped;
    growth.note(passage.number);
    const std::vector<double> strains =
      model.solid.plastic().equivalent_plastic_strain(model.dynamics.state.history);
    double strain = 0.;
    for (const unsigned int c : judged)
      strain = std::max(strain, strains[c]);
    passage.plastic_strain = dealii::Utilities::MPI::max(strain, model.comm);
    at_last_end            = measure_middle();
    if (passages.empty())
      passage.settlement = passage.shift = passage.residual_stress =
        std::numeric_limits<double>::quiet_NaN(); // until the next wheel stands at the beginning
    else
      note(at_last_end - of_load, passage);
    const Vector3      force              = end_of_way.force_on(model.wheels.front());
    const EnergyLedger energy             = model.dynamics.ledger();
    passage.net_strain                    = growth.net_strain();
    passage.growth                        = growth.rate();
    passage.plastic_work                  = energy.plastic;
    passage.frictional_work               = energy.friction;
    passage.traction_coefficient          = force[2] > 0. ? force[0] / force[2] : 0.;
    passage.max_pressure                  = measure(solution.patches().front()).max_pressure;
    passage.energy_residual_share         = energy.residual_share();
    passage.energy_residual_of_dissipated = energy.of_dissipated(energy.residual());
    passages.push_back(passage);
    folder.write_table("passages.csv", passage_columns(), passages);
    progress.say(format("passage %.0f of %u: largest plastic strain %.3f %%, net %.3f %%", passage.number,
                        model.scene.motion.passages, 100. * passage.plastic_strain,
                        100. * passage.net_strain));
  }


  bool Passages::is_last() const
  {
    return passages.back().number >= model.scene.motion.passages || growth.has_failed();
  }


  void Passages::begin_next(Progress &progress)
  {
    skipped = growth.passages_to_skip(model.scene.motion.passages -
                                      static_cast<unsigned int>(passages.back().number));
    if (skipped > 0)
      progress.say(
        growth.has_shaken_down()
          ? format("%u passages are left out: the rail has shaken down and stays as it is", skipped)
          : format("%u passages are left out, in each of which the net plastic strain grows by %.3g %%",
                   skipped, 100. * growth.rate()));
    growth.begin_next(skipped);
  }


  void Passages::finish(Report &report)
  {
    if (passages.empty())
      return;
    Summary     &summary = report.summary;
    const double strain = growth.net_strain(), per_passage = growth.rate();
    const auto   left_out = [this] {
      return growth.n_jumps() > 0
                 ? format("; %u passages left out in %u jumps", growth.n_skipped(), growth.n_jumps())
                 : std::string();
    };
    summary.set("passages_rolled", passages.size());
    summary.set("net_plastic_strain", strain);
    summary.set("net_plastic_strain_of_last_passage", per_passage);
    if (growth.n_jumps() > 0)
      {
        summary.set("passages_left_out", growth.n_skipped());
        summary.set("jumps", growth.n_jumps());
        summary.set("net_plastic_strain_error_estimate", growth.error_of_strain());
      }
    if (!(strain > 0.))
      {
        report.lines += "the rail's steel has not yielded in the middle of the path" + left_out() + "\n";
        return;
      }
    const dealii::Point<3> place = growth.place();
    const double           depth = model.scene.stance().depth_in_rail(place);
    summary.set("net_plastic_strain_y_m", place[1]);
    summary.set("net_plastic_strain_depth_m", depth);
    report.lines +=
      format("net plastic strain of the rail %.3f %% after %.0f passages (y = %.2f mm, depth %.2f mm), "
             "at most %.3g %% more in the last one",
             100. * strain, passages.back().number, 1e3 * place[1], 1e3 * depth, 100. * per_passage);
    if (growth.n_jumps() > 0)
      {
        report.lines +=
          left_out() + format(", off by about %.3g %% by its own estimate", 100. * growth.error_of_strain());
        constexpr double too_much = 0.1;
        if (growth.error_of_strain() > too_much * strain)
          report.warnings.push_back(
            format("the jumps over passages may be off by %.3g %% of the net plastic strain: lower "
                   "'Ratcheting/Change in a jump (%%)'",
                   100. * growth.error_of_strain() / strain));
      }
    else if (model.scene.ratcheting.jumps && !growth.has_failed() &&
             passages.size() > 3. * model.scene.ratcheting.rolled_between)
      report.warnings.push_back("no passages were left out: the change per passage was never regular, see "
                                "'Ratcheting/Irregularity (%)'");
    if (growth.has_failed())
      {
        const auto number = static_cast<unsigned int>(passages.back().number);
        summary.set("passages", number);
        summary.set("passages_to_failure", number);
        report.lines += format("\nthe rail's steel reaches its strain at failure, %g %%, in passage %.0f",
                               100. * model.scene.ratcheting.strain_at_failure, passages.back().number);
      }
    report.lines += "\n";
  }


  void Passages::serialize(Archive &archive, Middle &middle) const
  {
    struct OfCell
    {
      CellAddress           cell;
      std::array<double, 6> stress;
    };
    archive.same(middle.settlement, middle.shift);
    std::vector<OfCell> cells;
    for (std::size_t k = 0; k < judged.size(); ++k)
      cells.push_back({model.mesh.cells[judged[k]].address, middle.stress[k]});
    std::map<CellAddress, std::array<double, 6>> stored;
    for (const OfCell &of_cell : archive.records(cells))
      stored.emplace(of_cell.cell, of_cell.stress);
    for (std::size_t k = 0; k < judged.size() && archive.restores(); ++k)
      if (const auto found = stored.find(cells[k].cell); found != stored.end())
        middle.stress[k] = found->second;
      else
        archive.miss();
  }


  void Passages::serialize(Archive &archive)
  {
    growth.serialize(archive);
    archive.same(passages, skipped);
    serialize(archive, at_first_start);
    serialize(archive, at_last_end);
    serialize(archive, of_load);
  }
} // namespace tread
