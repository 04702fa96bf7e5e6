// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_records_h
#define tread_output_records_h

#include <tread/analysis/contact_patch.h>
#include <tread/analysis/rail_stress.h>
#include <tread/dynamics/explicit_dynamics.h>

#include <vector>

namespace tread
{
  /// Forces and displacements of one support, SI units.
  struct SupportRecord
  {
    double pad_force, ballast_force; ///< compression at the end of the interval
    double seat_pressure;            ///< largest of the pad's points
    double least_seat_pressure;      ///< smallest of them; negative where the pad pulls
    double rail_over_support;        ///< displacement of the rail's foot, upwards
    double rail_at_mid_span;         ///< the same half a spacing ahead
  };

  /// One wheel in a row of history.csv, SI units.
  struct WheelRecord
  {
    Vector3       force; ///< on the wheel, mean over the interval
    double        creepage;
    PatchMeasures patch;
    double        axle_box_acceleration; ///< vertical, mean over the interval
    double        lateral_shift, yaw;    ///< of the wheelset at the end of the interval
    double        guidance_force;        ///< lateral, on the wheelset, at the end of the interval
    double        roll;                  ///< of a wheelset with both wheels, likewise
    Vector3       other_force;           ///< of `force`, that on the other wheel
    double        inner_force; ///< of its vertical part, that of the inner piece of a rail of slices
    double        height;      ///< of the wheelset over its radius, at the end of the interval
    /// Of a flexible axle, at the end of the interval: twist of the own wheel against the other, and what the
    /// wheels have in addition to the roll and yaw of the wheelset.
    double twist = 0.;
    struct Tilt
    {
      double roll = 0., yaw = 0.;
    } own_tilt{}, other_tilt{};
  };

  /// One row of history.csv and of cells.csv, SI units.
  struct HistoryRow
  {
    double                     time, position; ///< of the first wheel
    std::vector<WheelRecord>   wheels;         ///< of all
    EnergyLedger               energy;
    std::vector<SupportRecord> supports; ///< those recorded
    std::vector<CellRecord>    cells;    ///< likewise
    /// Of a rail's bottom that moves, at the end; on a beam under the first wheel: m, rad.
    Vector3 rail_base{};
    double  rail_base_slope = 0.;
  };

  /// One row of patches.csv: a node in contact at one of the instants, SI units.
  struct PatchesRow
  {
    double    time, position; ///< of the wheel
    PatchNode node;
  };

  /// Residual state of the rail after the first wheel, SI units: averages over the nodes in the middle of the
  /// rolled distance, 10 mm long and on the line of the path, and the largest values of the cells below them.
  struct Passage
  {
    double number;                ///< 1 for the first wheel
    double skipped;               ///< passages before it that were not rolled
    double settlement, shift;     ///< of the surface since the virgin state: downwards, along x (m)
    double plastic_strain;        ///< largest equivalent plastic strain
    double net_strain, growth;    ///< largest net plastic strain, and what this passage adds to it
    double residual_stress;       ///< largest equivalent (von Mises) stress
    double plastic_work;          ///< of rail and wheel in this passage, J
    double frictional_work;       ///< J
    double traction_coefficient;  ///< mean over the last 10 mm
    double max_pressure;          ///< at the solution instant, Pa
    double energy_residual_share; ///< of the work done in this passage
    double energy_residual_of_dissipated;
  };
} // namespace tread

#endif
