// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/output/summary_keys.h>
#include <tread/recorders/stresses.h>
#include <tread/scene/parts.h>
#include <tread/scene/recorded.h>
#include <tread/scene/track_parts.h>
#include <tread/track/supports.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace tread
{
  const Columns<StripColumn> &strip_columns()
  {
    using R = StripColumn;
    static const Columns<R> columns{
      {"x", "mm", "Of the surface cell, along the rail",
       [](const R &r) {
         return r.x;
       }},
      {"von_mises", "MPa", "Largest stress of all rows of the history in the middles of the cells below it",
       [](const R &r) {
         return r.largest.stress;
       }},
      {"y", "mm", "Where it was, across",
       [](const R &r) {
         return r.y;
       }},
      {"depth", "mm", "Where it was",
       [](const R &r) {
         return r.depth;
       }},
      {"time", "s", "When it was",
       [](const R &r) {
         return r.largest.time;
       }},
      {"wheel_x", "mm", "Where the wheel was then",
       [](const R &r) {
         return r.largest.wheel_x;
       }},
      {"surface_von_mises", "MPa", "Largest stress of the surface, recovered at the nodes of the cell",
       [](const R &r) {
         return r.at_surface.stress;
       }},
      {"surface_y", "mm", "Where it was, across",
       [](const R &r) {
         return r.y_at_surface;
       }},
      {"surface_time", "s", "When it was",
       [](const R &r) {
         return r.at_surface.time;
       }},
      {"surface_wheel_x", "mm", "Where the wheel was then",
       [](const R &r) {
         return r.at_surface.wheel_x;
       }},
      {"equivalent_plastic_strain", "percent", "Largest of the cells below, at the end", [](const R &r) {
         return r.equivalent_plastic_strain;
       }}};
    return columns;
  }


  const Columns<StressPeaks::Layer> &peak_columns()
  {
    using R = StressPeaks::Layer;
    static const Columns<R> columns{
      {"depth", "mm", "Half the height of the layer of cells; 0: the surface",
       [](const R &r) {
         return r.peak.depth;
       }},
      {"von_mises", "MPa", "Largest von Mises stress of all steps, recovered at this depth",
       [](const R &r) {
         return r.peak.value;
       }},
      {"x", "mm", "Where it was, along the rail",
       [](const R &r) {
         return r.peak.x;
       }},
      {"y", "mm", "Where it was, across",
       [](const R &r) {
         return r.peak.y;
       }},
      {"time", "s", "When it was",
       [](const R &r) {
         return r.peak.time;
       }},
      {"wheel_x", "mm", "Where the wheel was then",
       [](const R &r) {
         return r.peak.wheel_x;
       }},
      {"equivalent_strain", "percent",
       "Stress over three times the shear modulus, and the largest equivalent plastic strain at the end",
       [](const R &r) {
         return r.equivalent_strain;
       }}};
    return columns;
  }


  const Columns<RailSeatPoint> &rail_seat_columns()
  {
    using R = RailSeatPoint;
    static const Columns<R> columns{
      {"support", "", "Its number",
       [](const R &r) {
         return r.support;
       }},
      {"time", "s", "Of the largest force in its pad",
       [](const R &r) {
         return r.time;
       }},
      {"wheel_x", "mm", "Where the wheel was then",
       [](const R &r) {
         return r.wheel_x;
       }},
      {"x", "mm", "Of the part of the pad, along the rail from the pad's middle",
       [](const R &r) {
         return r.x;
       }},
      {"y", "mm", "The same across",
       [](const R &r) {
         return r.y;
       }},
      {"pressure", "MPa", "On the pad there, negative in tension", [](const R &r) {
         return r.pressure;
       }}};
    return columns;
  }


  namespace
  {
    /// The largest value of a quantity in the region of 'Peak stress' and over all steps. @param how it is
    /// found
    void add_peak(SummaryKeys       &keys,
                  const std::string &name,
                  const std::string &what,
                  const std::string &how = "")
    {
      const bool        of_wheel = name.rfind("wheel_", 0) == 0;
      const std::string of_region =
        of_wheel ? " in the part of its tread that rolls over the region" : " in the region";
      keys.push_back({name + "_Pa", "Largest " + what + of_region + " of 'Peak stress', of all steps" + how});
      keys.push_back({name + "_x_m", of_wheel ? "Where that part of the tread meets the rail, along the rail"
                                              : "Where it was, along the rail"});
      keys.push_back({name + "_y_m", "Where it was, across"});
      if (what.find("cells") != std::string::npos)
        keys.push_back({name + "_depth_m", "Where it was: half the height of its layer, from the surface"});
      keys.push_back({name + "_time_s", "When it was"});
    }

    SummaryKeys keys_of_peaks()
    {
      const std::string recovered =
        ", recovered at its nodes from tractions and stretch, or from below where steel has yielded";
      SummaryKeys keys;
      add_peak(keys, "peak_von_mises", "von Mises stress of the layers of the rail's cells");
      add_peak(keys, "peak_surface_von_mises", "von Mises stress at the rail's surface", recovered);
      add_peak(keys, "peak_surface_von_mises_from_tractions", "von Mises stress at the rail's surface",
               ", from the stretch of a face of it and the tractions on it");
      add_peak(keys, "peak_pressure", "pressure of a node of the rail");
      add_peak(keys, "peak_shear", "shear stress of a node of the rail");
      add_peak(keys, "wheel_peak_von_mises", "von Mises stress of the layers of the first wheel's cells");
      add_peak(keys, "wheel_peak_surface_von_mises", "von Mises stress at the first wheel's surface",
               recovered);
      return keys;
    }

    const bool stresses_are_known =
      know_table(describe("strip.csv", strip_columns())) &&
      know_table(describe("peak_stress.csv", peak_columns())) &&
      know_table(describe("rail_seats.csv", rail_seat_columns())) &&
      know_summary_keys(
        SummaryGroup::recorded,
        {{"strip_max_von_mises_Pa", "Largest von Mises stress in strip.csv: of the rail's cells under the "
                                    "path at the ends of the history's intervals"},
         {"strip_max_von_mises_x_m", "Where it was: middle of the surface cell above it, along the rail"},
         {"strip_max_von_mises_y_m", "Where it was: middle of its cell, across"},
         {"strip_max_von_mises_depth_m", "Where it was: middle of its cell, below the surface"},
         {"strip_max_von_mises_time_s", "When it was"}}) &&
      know_summary_keys(
        SummaryGroup::recorded,
        {{"largest_plastic_strain", "Largest equivalent plastic strain of the rail's cells, at the end"},
         {"largest_plastic_strain_x_m", "Where it is: middle of its cell as meshed, along the rail"},
         {"largest_plastic_strain_y_m", "The same across"},
         {"largest_plastic_strain_depth_m", "The same below the surface"},
         {"wheel_largest_plastic_strain",
          "Largest equivalent plastic strain of the first wheel's cells, at the end"}}) &&
      know_summary_keys(SummaryGroup::peaks, keys_of_peaks());

    /// @param stress Pa; @param x, y, depth m
    std::string line_of_stress(const std::string &what,
                               const double       stress,
                               const double       x,
                               const double       y,
                               const double       depth)
    {
      return format("%-46s %7.1f MPa at x = %.2f mm, y = %.2f mm, depth %.2f mm\n", what.c_str(),
                    1e-6 * stress, 1e3 * x, 1e3 * y, 1e3 * depth);
    }
  } // namespace


  StripRecorder::StripRecorder(const Model &model, const WindowPlace &window)
    : model(model)
    , strip(model.mesh,
            model.solid,
            &model.contact.surfaces,
            rail_body,
            materials(model.scene)[rail_body],
            strip_extent(model.scene, window.number))
  {
  }


  void StripRecorder::add_row(const HistoryRow &row, const double, RunFolder &)
  {
    strip.sample(model.dynamics, model.contact.surface_impulses(), row.position);
  }


  void StripRecorder::finish(Report &report)
  {
    const std::vector<StripColumn> columns = strip.columns(model.dynamics);
    const auto                     most =
      std::max_element(columns.begin(), columns.end(), [](const StripColumn &a, const StripColumn &b) {
        return a.largest.stress < b.largest.stress;
      });
    if (most != columns.end())
      for (const auto &[name, value] :
           std::vector<std::pair<const char *, double>>{{"strip_max_von_mises_Pa", most->largest.stress},
                                                        {"strip_max_von_mises_x_m", most->x},
                                                        {"strip_max_von_mises_y_m", most->y},
                                                        {"strip_max_von_mises_depth_m", most->depth},
                                                        {"strip_max_von_mises_time_s", most->largest.time}})
        report.summary.set(name, value);
    if (most != columns.end() && !model.scene.peak_stress.is_wanted())
      report.extremes += line_of_stress("largest von Mises stress of the rail's cells", most->largest.stress,
                                        most->x, most->y, most->depth);
    report.folder.write_table("strip.csv", strip_columns(), columns);
  }


  namespace
  {
    StressPeaks peaks_of(const Model &model, const unsigned int body)
    {
      return StressPeaks(model.dynamics, &model.contact, body == rail_body, body,
                         materials(model.scene)[body], peak_region(model.scene, body));
    }
  } // namespace


  PeakRecorder::PeakRecorder(const Model &model)
    : model(model)
    , rail(peaks_of(model, rail_body))
    , wheel(peaks_of(model, model.wheels.front().body))
  {
  }


  void PeakRecorder::add_step()
  {
    const std::vector<RollingWheel> &wheels = model.wheels;
    const auto                       near   = std::find_if(wheels.begin(), wheels.end(),
                                                           [&](const RollingWheel &w) { return rail.concerns(w.hub.motion.x); });
    if (near == wheels.end())
      return;
    const std::vector<Vector3> impulses = model.contact.surface_impulses();
    rail.sample(model.dynamics, model.contact.active_nodes(), impulses, near->hub.motion.x);
    if (near == wheels.begin())
      wheel.sample(model.dynamics, {}, impulses, model.position());
  }


  void PeakRecorder::finish(Report &report)
  {
    // Slow cells are looked at when all nodes are at the same instant.
    const ExplicitDynamics &dynamics = model.dynamics;
    const double            last_instant =
      dynamics.state.time - (std::uint64_t(1) << dynamics.max_level()) * dynamics.state.time_step;
    bool       still_grows = false;
    const auto add         = [&](const std::string &name, const Peak &peak, const bool with_depth) {
      report.summary.set(name + "_Pa", peak.value);
      report.summary.set(name + "_x_m", peak.x);
      report.summary.set(name + "_y_m", peak.y);
      if (with_depth)
        report.summary.set(name + "_depth_m", peak.depth);
      report.summary.set(name + "_time_s", peak.time);
      still_grows = still_grows || peak.time >= last_instant;
    };
    for (const bool of_rail : {true, false})
      {
        const StressPeaks::Answer answer = (of_rail ? rail : wheel).answer(dynamics);
        const std::string         prefix = of_rail ? "peak_" : "wheel_peak_";
        Peak                      highest;
        for (const StressPeaks::Layer &layer : answer.layers)
          {
            highest     = std::max(highest, layer.peak);
            still_grows = still_grows || layer.peak.time >= last_instant;
          }
        add(prefix + "von_mises", highest, true);
        add(prefix + "surface_von_mises", answer.surface.peak, false);
        if (of_rail)
          {
            if (answer.from_tractions.value > 0.)
              add("peak_surface_von_mises_from_tractions", answer.from_tractions, false);
            add("peak_pressure", answer.pressure, false);
            add("peak_shear", answer.shear, false);
          }
        const std::string body = of_rail ? "of the rail's" : "of the wheel's";
        for (const auto &[where, peak] : {std::pair(" surface", answer.surface.peak), {" cells", highest}})
          report.extremes += line_of_stress("largest von Mises stress " + body + where, peak.value, peak.x,
                                            peak.y, peak.depth);
        // The surface, at depth 0, and each layer of cells below it.
        std::vector<StressPeaks::Layer> rows;
        if (answer.surface.peak.value > 0.)
          rows.push_back(answer.surface);
        rows.insert(rows.end(), answer.layers.begin(), answer.layers.end());
        report.folder.write_table(of_rail ? "peak_stress.csv" : "peak_stress_wheel.csv", peak_columns(),
                                  rows);
      }
    if (still_grows)
      report.warnings.push_back(
        "a largest stress of the region of 'Peak stress' is that of the last instant of the run, and "
        "grew until then: roll farther");
  }


  void PeakRecorder::serialize(Archive &archive)
  {
    rail.serialize(archive);
    wheel.serialize(archive);
  }


  SeatRecorder::SeatRecorder(const Model &model)
    : model(model)
    , seats(*model.supports, recorded_supports(model.scene), first_support(model.scene))
  {
  }


  namespace
  {
    constexpr double far = 1e30;

    /// Of equal strains, such as those of a row of cells along the path, the place of the foremost, whatever
    /// rank has it: x, y and depth, m.
    std::array<double, 3> place_of(const double                     strain,
                                   const std::vector<double>       &strains,
                                   const std::vector<unsigned int> &cells,
                                   const Model                     &model)
    {
      std::array<double, 3> place{{-far, -far, -far}};
      for (const unsigned int c : cells)
        if (strains[c] == strain)
          {
            dealii::Point<3> centre;
            for (const unsigned int i : model.mesh.cells[c].nodes)
              centre += model.mesh.nodes[i] / 8.;
            place = std::max(place, {{centre[0], centre[1], model.scene.stance().depth_in_rail(centre)}});
          }
      const auto places = dealii::Utilities::MPI::all_gather(model.comm, place);
      return *std::max_element(places.begin(), places.end());
    }
  } // namespace


  void PlasticStrainRecorder::finish(Report &report)
  {
    const PlasticCells &plastic = model.solid.plastic();
    if (dealii::Utilities::MPI::sum(plastic.n_cells(), model.comm) == 0)
      return;
    const std::vector<double> strains = plastic.equivalent_plastic_strain(model.dynamics.state.history);
    std::string               line;
    for (const auto &[body, key, name] :
         {std::tuple(rail_body, "largest_plastic_strain", "rail"),
          std::tuple(model.wheels.front().body, "wheel_largest_plastic_strain", "wheel")})
      {
        std::vector<unsigned int> cells;
        double                    own = -1.; // of this rank
        for (unsigned int c = 0; c < model.mesh.cells.size(); ++c)
          if (model.mesh.cells[c].body == body && plastic.contains(c))
            {
              cells.push_back(c);
              own = std::max(own, strains[c]);
            }
        const double largest = dealii::Utilities::MPI::max(own, model.comm);
        if (largest < 0.) // no cell of this body can yield
          continue;
        report.summary.set(key, largest);
        line += format("%s %.3f %% in the %s", line.empty() ? "largest equivalent plastic strain" : ",",
                       100. * largest, name);
        if (body != rail_body || largest == 0.)
          continue;
        const std::array<double, 3> place = place_of(largest, strains, cells, model);
        for (unsigned int d = 0; d < 3; ++d)
          report.summary.set(std::string(key) + std::array{"_x_m", "_y_m", "_depth_m"}[d], place[d]);
        line += format(" (x = %.2f mm, y = %.2f mm, depth %.2f mm)", 1e3 * place[0], 1e3 * place[1],
                       1e3 * place[2]);
      }
    if (!line.empty())
      report.lines += line + "\n";
  }
} // namespace tread
