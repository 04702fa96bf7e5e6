// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/recorders/history.h>

#include <string>
#include <utility>

namespace tread
{
  namespace
  {
    /// Of a wheel: what acts in its contact.
    const Columns<WheelRecord> &contact_columns()
    {
      using R = WheelRecord;
      static const Columns<R> columns{
        {"normal_force", "N",
         "Vertical force on the wheel, mean over the interval; of a wheelset in a position of all its "
         "patches",
         [](const R &r) {
           return r.force[2];
         }},
        {"longitudinal_force", "N", "The same along the rail, positive forward",
         [](const R &r) {
           return r.force[0];
         }},
        {"lateral_force", "N",
         "The same across the rail, positive to the field side (of a wheelset to its own side)",
         [](const R &r) {
           return r.force[1];
         }},
        {"traction_coefficient", "", "Longitudinal over normal force",
         [](const R &r) {
           return r.force[2] > 0. ? r.force[0] / r.force[2] : 0.;
         }},
        {"creepage", "",
         "Angular velocity x rolling radius over speed, less 1, counted from free rolling; positive when "
         "driving",
         [](const R &r) {
           return r.creepage;
         }},
        {"contact_area", "m2", "Area of the patch at the end of the interval",
         [](const R &r) {
           return r.patch.area;
         }},
        {"adhesion_share", "", "Share of the area that sticks",
         [](const R &r) {
           return r.patch.adhesion_share;
         }},
        {"max_pressure", "Pa", "Largest pressure of a node at the end of the interval", [](const R &r) {
           return r.patch.max_pressure;
         }}};
      return columns;
    }

    /// Of a wheel: what its axle box feels.
    const Columns<WheelRecord> &axle_columns()
    {
      using R = WheelRecord;
      static const Columns<R> columns{{"axle_box_acceleration", "m_per_s2",
                                       "Vertical acceleration of the hub, mean over the interval",
                                       [](const R &r) {
                                         return r.axle_box_acceleration;
                                       }}};
      return columns;
    }

    /// Of a wheelset that moves across its track.
    const Columns<WheelRecord> &across_columns()
    {
      using R = WheelRecord;
      static const Columns<R> columns{
        {"lateral_shift", "m", "Of the wheelset in the track, to its own side, at the end of the interval",
         [](const R &r) {
           return r.lateral_shift;
         }},
        {"yaw", "rad", "Of the wheelset, positive: the leading side turns to the own side",
         [](const R &r) {
           return r.yaw;
         }},
        {"guidance_force", "N", "Lateral force of the guidance on the wheelset", [](const R &r) {
           return r.guidance_force;
         }}};
      return columns;
    }

    /// Of a wheelset with both wheels.
    const Columns<WheelRecord> &both_wheels_columns()
    {
      using R = WheelRecord;
      static const Columns<R> columns{
        {"roll", "rad", "Of the wheelset, positive: the own side goes down",
         [](const R &r) {
           return r.roll;
         }},
        {"other_normal_force", "N", "Vertical force on the other wheel alone",
         [](const R &r) {
           return r.other_force[2];
         }},
        {"other_longitudinal_force", "N", "Longitudinal force on the other wheel alone",
         [](const R &r) {
           return r.other_force[0];
         }},
        {"other_lateral_force", "N",
         "Lateral force on the other wheel alone, in track axes: positive to the own side", [](const R &r) {
           return r.other_force[1];
         }}};
      return columns;
    }

    /// Of a wheelset on a flexible axle.
    const Columns<WheelRecord> &flexible_axle_columns()
    {
      using R = WheelRecord;
      static const Columns<R> columns{
        {"axle_twist", "rad", "Of the own wheel against the other about the axle, since the start",
         [](const R &r) {
           return r.twist;
         }},
        {"own_wheel_roll", "rad", "Roll of the own wheel beside the wheelset's",
         [](const R &r) {
           return r.own_tilt.roll;
         }},
        {"own_wheel_yaw", "rad", "Yaw of the own wheel beside the wheelset's",
         [](const R &r) {
           return r.own_tilt.yaw;
         }},
        {"other_wheel_roll", "rad", "Roll of the other wheel beside the wheelset's",
         [](const R &r) {
           return r.other_tilt.roll;
         }},
        {"other_wheel_yaw", "rad", "Yaw of the other wheel beside the wheelset's", [](const R &r) {
           return r.other_tilt.yaw;
         }}};
      return columns;
    }

    const Columns<EnergyLedger> &energy_columns()
    {
      using R = EnergyLedger;
      static const Columns<R> columns{
        {"external_work", "J",
         "Work of drive, guidance, suspension, weight, imposed sliding and cells of the surface that become "
         "matched, since the start",
         [](const R &r) {
           return r.external_work;
         }},
        {"kinetic_energy", "J", "Of all masses, change since the start",
         [](const R &r) {
           return r.kinetic;
         }},
        {"internal_energy", "J",
         "Elastic energy of the cells without that of hourglass modes, change since the start",
         [](const R &r) {
           return r.strain;
         }},
        {"hourglass_energy", "J",
         "Of the cells' deformation that one integration point does not see, change since the start",
         [](const R &r) {
           return r.hourglass;
         }},
        {"frictional_work", "J", "Work of friction since the start",
         [](const R &r) {
           return r.friction;
         }},
        {"contact_loss", "J", "Energy that the contact took other than by sliding, since the start",
         [](const R &r) {
           return r.contact;
         }},
        {"damping_work", "J",
         "Work lost to stiffness and mass damping, bulk viscosity and dampers since the start",
         [](const R &r) {
           return r.damping;
         }},
        {"plastic_work", "J", "Work on plastic strain since the start",
         [](const R &r) {
           return r.plastic;
         }},
        {"energy_residual", "J", "Energy that no other column accounts for", [](const R &r) {
           return r.residual();
         }}};
      return columns;
    }
  } // namespace


  Columns<HistoryRow> history_columns(const HistoryParts &parts)
  {
    using R          = HistoryRow;
    const auto wheel = [](const std::size_t i) {
      return [i](const R &r) -> const WheelRecord & {
        return r.wheels[i];
      };
    };
    Columns<R> columns{{"time", "s", "End of the interval, from the start of the run",
                        [](const R &r) {
                          return r.time;
                        }},
                       {"position", "m", "Of the wheel along the rail at that time", [](const R &r) {
                          return r.position;
                        }}};
    add_columns(columns, contact_columns(), "", wheel(0));
    add_columns(columns, energy_columns(), "", [](const R &r) -> const EnergyLedger & { return r.energy; });
    add_columns(columns, axle_columns(), "", wheel(0));
    if (parts.moves_across)
      add_columns(columns, across_columns(), "", wheel(0));
    if (parts.has_both_wheels)
      add_columns(columns, both_wheels_columns(), "", wheel(0));
    if (parts.has_flexible_axle)
      add_columns(columns, flexible_axle_columns(), "", wheel(0));
    if (parts.has_slices)
      columns.push_back({"wheelset_height", "m",
                         "Of the wheelset's middle in the track over the radius, at the end of the interval",
                         [](const R &r) {
                           return r.wheels.front().height;
                         }});
    if (parts.has_two_pieces)
      columns.push_back({"inner_normal_force", "N",
                         "Of the vertical force that of the piece of the rail nearer to the middle of the "
                         "track, such as a nose",
                         [](const R &r) {
                           return r.wheels.front().inner_force;
                         }});
    if (parts.has_window)
      columns.push_back(
        {"window_loss", "J",
         "Energy that fine cells had and others do not carry when the window moves, since the start",
         [](const R &r) {
           return r.energy.window;
         }});
    if (!parts.supports.empty() || parts.base_pitches)
      columns.push_back({"spring_energy", "J",
                         "Of the springs of the supports and of beams, change since the start",
                         [](const R &r) {
                           return r.energy.springs;
                         }});
    if (parts.base_moves_across || parts.base_pitches)
      {
        if (parts.base_moves_across)
          columns.push_back(
            {"rail_base_lateral", "m", "Lateral displacement of the rail's bottom", [](const R &r) {
               return r.rail_base[1];
             }});
        columns.push_back(
          {"rail_base_vertical", "m",
           "Vertical displacement of the rail's bottom, on a beam under the wheel, since the start",
           [](const R &r) {
             return r.rail_base[2];
           }});
        if (parts.base_pitches)
          columns.push_back({"rail_base_slope", "rad",
                             "The same of its slope, positive where it rises along x", [](const R &r) {
                               return r.rail_base_slope;
                             }});
      }
    const Columns<SupportRecord> of_support{
      {"pad", "N", "Compressive force of the pad at the end of the interval",
       [](const SupportRecord &s) {
         return s.pad_force;
       }},
      {"ballast", "N", "Compressive force of the ballast, likewise",
       [](const SupportRecord &s) {
         return s.ballast_force;
       }},
      {"seat_pressure", "Pa", "Largest pressure of the pad's points",
       [](const SupportRecord &s) {
         return s.seat_pressure;
       }},
      {"least_seat_pressure", "Pa", "Least pressure of the pad's points, negative where they pull",
       [](const SupportRecord &s) {
         return s.least_seat_pressure;
       }},
      {"rail", "m", "Upward displacement of the rail's foot over the support",
       [](const SupportRecord &s) {
         return s.rail_over_support;
       }},
      {"rail_at_next_mid_span", "m", "The same half a spacing ahead", [](const SupportRecord &s) {
         return s.rail_at_mid_span;
       }}};
    for (std::size_t i = 0; i < parts.supports.size(); ++i)
      add_columns(columns, of_support, "support_" + std::to_string(parts.supports[i]) + "_",
                  [i](const R &r) -> const SupportRecord & { return r.supports[i]; });
    for (unsigned int i = 1; i < parts.n_wheels; ++i)
      for (const auto *of_wheel : {&contact_columns(), &axle_columns()})
        add_columns(columns, *of_wheel, "wheel_" + std::to_string(i + 1) + "_", wheel(i));
    return columns;
  }


  Columns<HistoryRow> cell_columns(const std::size_t n_cells)
  {
    using R = HistoryRow;
    Columns<R> columns{{"time", "s", "End of the interval",
                        [](const R &r) {
                          return r.time;
                        }},
                       {"position", "m", "Of the wheel along the rail", [](const R &r) {
                          return r.position;
                        }}};
    for (std::size_t i = 0; i < n_cells; ++i)
      {
        const std::string name = "cell_" + std::to_string(i + 1);
        columns.push_back({name + "_von_mises", "Pa", "Von Mises stress of the cell", [i](const R &r) {
                             return r.cells[i].von_mises;
                           }});
        columns.push_back(
          {name + "_equivalent_plastic_strain", "", "Equivalent plastic strain of the cell", [i](const R &r) {
             return r.cells[i].equivalent_plastic_strain;
           }});
      }
    return columns;
  }


  namespace
  {
    bool know_history()
    {
      HistoryParts all{2, true, true, {0}};
      all.base_moves_across = all.base_pitches = all.has_flexible_axle = all.has_slices = all.has_two_pieces =
        all.has_window                                                                  = true;
      return know_table(describe("history.csv", history_columns(all))) &&
             know_table(describe("cells.csv", cell_columns(1)));
    }
    const bool history_is_known = know_history();
  } // namespace
} // namespace tread
