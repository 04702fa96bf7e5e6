// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/reproducible_sum.h>
#include <tread/scene/parts.h>
#include <tread/simulation/recorders/passages.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace tread
{
  namespace
  {
    /// Whether a place of the reference configuration is where passages are compared, in the middle of the
    /// path.
    bool is_in_middle_of(const Scene &scene, const dealii::Point<3> &p)
    {
      constexpr double half_length = 5e-3;
      return std::abs(p[0] - 0.5 * (scene.path_begin() + scene.path_end())) <= half_length;
    }

    PassageGrowth make_growth(Model &model)
    {
      const Mesh       &mesh = model.mesh;
      std::vector<char> judged(mesh.cells.size(), false), of_rail(mesh.nodes.size(), false);
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        judged[c] = model.solid.plastic().contains(c) && mesh.cells[c].body == rail_body &&
                    is_in_middle_of(model.scene, mesh.nodes[mesh.cells[c].nodes[0]]);
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


  Passages::Passages(Model &model, const EndOfWay &end_of_way, const Solution &solution)
    : model(model)
    , end_of_way(end_of_way)
    , solution(solution)
    , growth(make_growth(model))
  {
  }


  void Passages::measure_rail(Passage &passage) const
  {
    using dealii::Utilities::MPI::max;
    const Scene     &scene      = model.scene;
    const Mesh      &mesh       = model.mesh;
    const State     &state      = model.dynamics.state;
    constexpr double on_line    = 1e-6;
    const auto       is_on_path = [&](const dealii::Point<3> &p) {
      return scene.is_positioned() ? scene.placed_wheel().is_on_path(p, scene.mesh.finest_cell)
                                         : std::abs(p[1]) < on_line && std::abs(p[2]) < on_line;
    };
    ReproducibleSum<double> settled, shifted;
    double                  n_nodes = 0.;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (const dealii::Point<3> &p = mesh.nodes[i]; mesh.node_bodies[i] == rail_body &&
                                                     mesh.shared_nodes.is_owned(i) &&
                                                     is_in_middle_of(scene, p) && is_on_path(p))
        {
          settled.add(p[2] - state.position(i)[2]);
          shifted.add(state.position(i)[0] - p[0]);
          n_nodes += 1.;
        }
    const std::vector<std::array<double, 6>> stress =
      model.solid.cauchy_stress(state.positions().data(), state.history);
    const std::vector<double> strains = model.solid.plastic().equivalent_plastic_strain(state.history);
    double                    strain = 0., residual = 0.;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (model.solid.plastic().contains(c) && mesh.cells[c].body == rail_body &&
          is_in_middle_of(scene, mesh.nodes[mesh.cells[c].nodes[0]]))
        {
          strain   = std::max(strain, strains[c]);
          residual = std::max(residual, von_mises(stress[c]));
        }
    n_nodes =
      dealii::Utilities::MPI::sum(n_nodes, model.comm); // 0: not a number, instead of a settlement of 0
    passage.settlement      = settled.value(model.comm) / n_nodes;
    passage.shift           = shifted.value(model.comm) / n_nodes;
    passage.plastic_strain  = max(strain, model.comm);
    passage.residual_stress = max(residual, model.comm);
  }


  void Passages::end(RunFolder &folder, Progress &progress)
  {
    Passage passage{};
    passage.number  = (passages.empty() ? 0. : passages.back().number) + skipped + 1.;
    passage.skipped = skipped;
    growth.note(passage.number);
    measure_rail(passage);
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
    progress.say(format("passage %.0f of %u: settlement %.2f um, largest plastic strain %.3f %%, net %.3f %%",
                        passage.number, model.scene.motion.passages, 1e6 * passage.settlement,
                        100. * passage.plastic_strain, 100. * passage.net_strain));
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
    summary.set("passages_rolled", passages.size());
    summary.set("net_plastic_strain", strain);
    summary.set("net_plastic_strain_of_last_passage", per_passage);
    if (!(strain > 0.))
      return; // nothing has yielded anywhere
    const dealii::Point<3> place = growth.place();
    const double           depth = model.scene.depth_in_rail(place);
    summary.set("net_plastic_strain_y_m", place[1]);
    summary.set("net_plastic_strain_depth_m", depth);
    report.lines +=
      format("net plastic strain of the rail %.3f %% after %.0f passages (y = %.2f mm, depth %.2f mm), "
             "%.3g %% in the last one",
             100. * strain, passages.back().number, 1e3 * place[1], 1e3 * depth, 100. * per_passage);
    if (growth.n_jumps() > 0)
      {
        summary.set("passages_left_out", growth.n_skipped());
        summary.set("jumps", growth.n_jumps());
        summary.set("net_plastic_strain_error_estimate", growth.error_of_strain());
        report.lines +=
          format("; %u passages left out in %u jumps, off by %.3g %% at most by its own estimate",
                 growth.n_skipped(), growth.n_jumps(), 100. * growth.error_of_strain());
        constexpr double too_much = 0.1;
        if (growth.error_of_strain() > too_much * strain)
          report.warnings.push_back(
            format("the jumps over passages may be off by %.3g %% of the net plastic strain: lower "
                   "'Ratcheting/Change in a jump (%%)'",
                   100. * growth.error_of_strain() / strain));
      }
    else if (model.scene.ratcheting.jumps)
      report.warnings.push_back("no passages were left out: the change per passage was never regular, see "
                                "'Ratcheting/Irregularity (%)'");
    if (growth.has_failed())
      {
        summary.set("passages_to_failure", passages.back().number);
        report.lines += format("\nthe rail's steel reaches its strain at failure, %g %%, in passage %.0f",
                               100. * model.scene.ratcheting.strain_at_failure, passages.back().number);
      }
    report.lines += "\n";
  }


  void Passages::serialize(Archive &archive)
  {
    growth.serialize(archive);
    archive.same(passages, skipped);
  }
} // namespace tread
