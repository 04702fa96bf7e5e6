// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/input_error.h>
#include <tread/dynamics/parts/rail_base.h>
#include <tread/dynamics/parts/rail_on_beam.h>
#include <tread/output/summary_keys.h>
#include <tread/recorders/history.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/parts.h>
#include <tread/scene/recorded.h>
#include <tread/scene/track_parts.h>
#include <tread/track/supports.h>

#include <stdexcept>
#include <string>

namespace tread
{
  namespace
  {
    const bool keys_of_history_are_known = know_summary_keys(
      SummaryGroup::recorded,
      {{"cell_1_x_m", "Middle of the cell of the rail that 'Output/Cells' names, along the rail"},
       {"cell_1_y_m", "The same across"},
       {"cell_1_depth_m", "The same below the surface"},
       {"history_crc32", "CRC-32 of history.csv as the run wrote it"}});

    HistoryParts parts_of(const Model &model)
    {
      const Scene &scene = model.scene;
      return {static_cast<unsigned int>(model.wheels.size()),
              scene.guidance.kind != Guidance::rigid,
              scene.wheelset.both_wheels,
              recorded_supports(scene),
              scene.track.runs_along(),
              scene.track.is_beam(),
              scene.wheelset.has_flexible_axle(),
              scene.rail.is_sliced(),
              model.between_pieces.has_value(),
              has_window(scene)};
    }
  } // namespace


  History::History(const Model &model)
    : model(model)
    , sums(model.wheels.size())
    , columns(history_columns(parts_of(model)))
  {
    if (const auto points = recorded_cells(model.scene); !points.empty())
      try
        {
          probes           = std::make_unique<CellProbes>(model.mesh, rail_body, points);
          columns_of_cells = cell_columns(probes->centres().size());
        }
      catch (const std::out_of_range &number)
        {
          throw InputError("'Output/Cells': entry " + std::string(number.what()) + " lies outside the rail");
        }
  }


  void History::open(RunFolder &folder)
  {
    folder.open_table("history.csv", columns);
    if (probes)
      folder.open_table("cells.csv", columns_of_cells);
  }


  void History::start()
  {
    begin_interval();
  }


  void History::begin_interval()
  {
    steps      = 0;
    start_time = model.dynamics.state.time;
    for (const RollingWheel &wheel : model.wheels)
      {
        sums[wheel.number]             = Interval();
        sums[wheel.number].start_speed = wheel.hub.motion.velocity_z;
      }
  }


  void History::add_step()
  {
    for (const RollingWheel &wheel : model.wheels)
      {
        Interval &sum = sums[wheel.number];
        sum.force += model.force_on(wheel);
        if (model.scene.wheelset.both_wheels)
          sum.other_force += model.force_on_other();
        if (model.between_pieces)
          sum.inner_force +=
            model.contact.total_impulse_below(*model.between_pieces)[2] / model.dynamics.state.time_step;
      }
    ++steps;
  }


  double History::interval_seconds() const
  {
    return model.dynamics.state.time - start_time;
  }


  WheelRecord History::record(const RollingWheel &wheel, const std::vector<PatchNode> &patch) const
  {
    const Scene            &scene  = model.scene;
    const Interval         &sum    = sums[wheel.number];
    const WheelHub::Motion &motion = wheel.hub.motion;
    WheelRecord             record{(1. / steps) * sum.force,
                       wheel.creepage(scene),
                       measure(patch),
                       (motion.velocity_z - sum.start_speed) / interval_seconds(),
                       motion.y + scene.wheelset.position().shift,
                       motion.yaw,
                       wheel.hub.guidance.lateral_force(),
                       motion.roll,
                       (1. / steps) * sum.other_force,
                       sum.inner_force / steps,
                       scene.is_positioned() ? wheel.position(scene).height : 0.};
    if (const FlexibleAxle *axle = wheel.hub.flexible_axle())
      {
        record.twist    = 2. * axle->twist(FlexibleAxle::own);
        const auto tilt = [&](const FlexibleAxle::Side side) {
          return WheelRecord::Tilt{-axle->tilt(side).x, axle->tilt(side).z};
        };
        record.own_tilt   = tilt(FlexibleAxle::own);
        record.other_tilt = tilt(FlexibleAxle::other);
      }
    return record;
  }


  std::vector<SupportRecord> History::support_records() const
  {
    std::vector<SupportRecord> records;
    for (const int number : recorded_supports(model.scene))
      {
        const unsigned int s                  = number - first_support(model.scene);
        const auto [least_pressure, pressure] = model.supports->pad_pressures(s);
        records.push_back({model.supports->force(s, Supports::pad),
                           model.supports->force(s, Supports::ballast), pressure, least_pressure,
                           model.supports->rail_displacement(s),
                           model.supports->probe_displacement(records.size())});
      }
    return records;
  }


  HistoryRow History::row() const
  {
    HistoryRow row;
    row.time           = model.dynamics.state.time;
    row.position       = model.position();
    const auto patches = model.patches_now();
    for (const RollingWheel &wheel : model.wheels)
      row.wheels.push_back(record(wheel, patches[wheel.number]));
    row.energy   = model.dynamics.ledger();
    row.supports = support_records();
    if (model.rail_base)
      row.rail_base = model.rail_base->displacement();
    if (model.rail_on_beam)
      {
        const TrackBeam::AtSection under = model.rail_on_beam->displacement_at(row.position);
        row.rail_base                    = Vector3{0., 0., under.up, 0.};
        row.rail_base_slope              = under.slope;
      }
    if (probes)
      row.cells = probes->record(model.dynamics);
    return row;
  }


  void History::add_row(const HistoryRow &row, const double, RunFolder &folder)
  {
    folder.append("history.csv", columns, {row});
    if (probes)
      folder.append("cells.csv", columns_of_cells, {row});
    begin_interval();
  }


  void History::finish(Report &report)
  {
    for (std::size_t i = 0; probes && i < probes->centres().size(); ++i)
      {
        const dealii::Point<3> &centre = probes->centres()[i];
        const std::string       name   = "cell_" + std::to_string(i + 1);
        report.summary.set(name + "_x_m", centre[0]);
        report.summary.set(name + "_y_m", centre[1]);
        report.summary.set(name + "_depth_m", model.scene.stance().depth_in_rail(centre));
      }
    report.summary.set("history_crc32", report.folder.history_checksum());
  }


  void History::serialize(Archive &archive)
  {
    archive.same(steps, start_time, sums);
  }
} // namespace tread
