// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/columns.h>

#include <array>
#include <utility>

namespace tread
{
  double factor_of(const std::string &unit)
  {
    static const std::array<std::pair<const char *, double>, 5> factors{
      {{"mm", 1e3}, {"um", 1e6}, {"mm2", 1e6}, {"MPa", 1e-6}, {"percent", 100.}}};
    for (const auto &[name, factor] : factors)
      if (unit == name)
        return factor;
    return 1.;
  }


  std::string unit_of_heading(const std::string &heading)
  {
    // Longer ones before those that they end with.
    for (const std::string unit : {"m_per_s2", "m_per_s", "N_per_m", "m_per_N", "percent", "degrees", "MPa",
                                   "Pa", "Hz", "mm2", "mm", "um", "m2", "rad", "m", "N", "J", "W", "s"})
      if (heading.size() > unit.size() + 1 &&
          heading.compare(heading.size() - unit.size() - 1, std::string::npos, "_" + unit) == 0)
        return unit;
    return "";
  }


  namespace
  {
    /// Of a wheel: what acts in its contact.
    const Columns<WheelRecord> &contact_columns()
    {
      using R = WheelRecord;
      static const Columns<R> columns{{"normal_force", "N",
                                       [](const R &r) {
                                         return r.force[2];
                                       }},
                                      {"longitudinal_force", "N",
                                       [](const R &r) {
                                         return r.force[0];
                                       }},
                                      {"lateral_force", "N",
                                       [](const R &r) {
                                         return r.force[1];
                                       }},
                                      {"traction_coefficient", "",
                                       [](const R &r) {
                                         return r.force[2] > 0. ? r.force[0] / r.force[2] : 0.;
                                       }},
                                      {"creepage", "",
                                       [](const R &r) {
                                         return r.creepage;
                                       }},
                                      {"contact_area", "m2",
                                       [](const R &r) {
                                         return r.patch.area;
                                       }},
                                      {"adhesion_share", "",
                                       [](const R &r) {
                                         return r.patch.adhesion_share;
                                       }},
                                      {"max_pressure", "Pa", [](const R &r) {
                                         return r.patch.max_pressure;
                                       }}};
      return columns;
    }

    /// Of a wheel: what its axle box feels.
    const Columns<WheelRecord> &axle_columns()
    {
      using R = WheelRecord;
      static const Columns<R> columns{{"axle_box_acceleration", "m_per_s2", [](const R &r) {
                                         return r.axle_box_acceleration;
                                       }}};
      return columns;
    }

    /// Of a wheelset that moves across its track.
    const Columns<WheelRecord> &across_columns()
    {
      using R = WheelRecord;
      static const Columns<R> columns{{"lateral_shift", "m",
                                       [](const R &r) {
                                         return r.lateral_shift;
                                       }},
                                      {"yaw", "rad",
                                       [](const R &r) {
                                         return r.yaw;
                                       }},
                                      {"guidance_force", "N", [](const R &r) {
                                         return r.guidance_force;
                                       }}};
      return columns;
    }

    /// Of a wheelset with both wheels.
    const Columns<WheelRecord> &both_wheels_columns()
    {
      using R = WheelRecord;
      static const Columns<R> columns{{"roll", "rad",
                                       [](const R &r) {
                                         return r.roll;
                                       }},
                                      {"other_normal_force", "N",
                                       [](const R &r) {
                                         return r.other_force[2];
                                       }},
                                      {"other_longitudinal_force", "N",
                                       [](const R &r) {
                                         return r.other_force[0];
                                       }},
                                      {"other_lateral_force", "N", [](const R &r) {
                                         return r.other_force[1];
                                       }}};
      return columns;
    }

    /// Of a wheelset on a flexible axle.
    const Columns<WheelRecord> &flexible_axle_columns()
    {
      using R = WheelRecord;
      static const Columns<R> columns{{"axle_twist", "rad",
                                       [](const R &r) {
                                         return r.twist;
                                       }},
                                      {"own_wheel_roll", "rad",
                                       [](const R &r) {
                                         return r.own_tilt.roll;
                                       }},
                                      {"own_wheel_yaw", "rad",
                                       [](const R &r) {
                                         return r.own_tilt.yaw;
                                       }},
                                      {"other_wheel_roll", "rad",
                                       [](const R &r) {
                                         return r.other_tilt.roll;
                                       }},
                                      {"other_wheel_yaw", "rad", [](const R &r) {
                                         return r.other_tilt.yaw;
                                       }}};
      return columns;
    }

    const Columns<EnergyLedger> &energy_columns()
    {
      using R = EnergyLedger;
      static const Columns<R> columns{{"external_work", "J",
                                       [](const R &r) {
                                         return r.external_work;
                                       }},
                                      {"kinetic_energy", "J",
                                       [](const R &r) {
                                         return r.kinetic;
                                       }},
                                      {"internal_energy", "J",
                                       [](const R &r) {
                                         return r.strain;
                                       }},
                                      {"hourglass_energy", "J",
                                       [](const R &r) {
                                         return r.hourglass;
                                       }},
                                      {"frictional_work", "J",
                                       [](const R &r) {
                                         return r.friction;
                                       }},
                                      {"contact_loss", "J",
                                       [](const R &r) {
                                         return r.contact;
                                       }},
                                      {"damping_work", "J",
                                       [](const R &r) {
                                         return r.damping;
                                       }},
                                      {"plastic_work", "J",
                                       [](const R &r) {
                                         return r.plastic;
                                       }},
                                      {"energy_residual", "J", [](const R &r) {
                                         return r.residual();
                                       }}};
      return columns;
    }

    /// Add the columns of one of the parts of a row, with a prefix to their names. @param part of the row
    template <typename Row, typename Part, typename PartOf>
    void add_columns(Columns<Row>        &columns,
                     const Columns<Part> &of_part,
                     const std::string   &prefix,
                     const PartOf        &part)
    {
      for (const Column<Part> &column : of_part)
        {
          Column<Row> own{prefix + column.name, column.unit, {}};
          if (column.word)
            own.word = [part, word = column.word](const Row &r) {
              return word(part(r));
            };
          else
            own.value = [part, value = column.value](const Row &r) {
              return value(part(r));
            };
          columns.push_back(own);
        }
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
    Columns<R> columns{{"time", "s",
                        [](const R &r) {
                          return r.time;
                        }},
                       {"position", "m", [](const R &r) {
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
    if (!parts.supports.empty())
      columns.push_back({"spring_energy", "J", [](const R &r) {
                           return r.energy.springs;
                         }});
    if (parts.has_rail_base)
      {
        columns.push_back({"rail_base_lateral", "m", [](const R &r) {
                             return r.rail_base[1];
                           }});
        columns.push_back({"rail_base_vertical", "m", [](const R &r) {
                             return r.rail_base[2];
                           }});
      }
    const Columns<SupportRecord> of_support{{"pad", "N",
                                             [](const SupportRecord &s) {
                                               return s.pad_force;
                                             }},
                                            {"ballast", "N",
                                             [](const SupportRecord &s) {
                                               return s.ballast_force;
                                             }},
                                            {"seat_pressure", "Pa",
                                             [](const SupportRecord &s) {
                                               return s.seat_pressure;
                                             }},
                                            {"least_seat_pressure", "Pa",
                                             [](const SupportRecord &s) {
                                               return s.least_seat_pressure;
                                             }},
                                            {"rail", "m",
                                             [](const SupportRecord &s) {
                                               return s.rail_over_support;
                                             }},
                                            {"rail_at_next_mid_span", "m", [](const SupportRecord &s) {
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
    Columns<R> columns{{"time", "s",
                        [](const R &r) {
                          return r.time;
                        }},
                       {"position", "m", [](const R &r) {
                          return r.position;
                        }}};
    for (std::size_t i = 0; i < n_cells; ++i)
      {
        const std::string name = "cell_" + std::to_string(i + 1);
        columns.push_back({name + "_von_mises", "Pa", [i](const R &r) {
                             return r.cells[i].von_mises;
                           }});
        columns.push_back({name + "_equivalent_plastic_strain", "", [i](const R &r) {
                             return r.cells[i].equivalent_plastic_strain;
                           }});
      }
    return columns;
  }


  const Columns<PatchNode> &patch_columns()
  {
    using R = PatchNode;
    static const Columns<R> columns{{"x", "mm",
                                     [](const R &r) {
                                       return r.position[0];
                                     }},
                                    {"y", "mm",
                                     [](const R &r) {
                                       return r.position[1];
                                     }},
                                    {"z", "mm",
                                     [](const R &r) {
                                       return r.position[2];
                                     }},
                                    {"area", "mm2",
                                     [](const R &r) {
                                       return r.area;
                                     }},
                                    {"pressure", "MPa",
                                     [](const R &r) {
                                       return r.pressure;
                                     }},
                                    {"shear_x", "MPa",
                                     [](const R &r) {
                                       return r.shear[0];
                                     }},
                                    {"shear_y", "MPa",
                                     [](const R &r) {
                                       return r.shear[1];
                                     }},
                                    {"slip_x", "m_per_s",
                                     [](const R &r) {
                                       return r.slip[0];
                                     }},
                                    {"slip_y", "m_per_s",
                                     [](const R &r) {
                                       return r.slip[1];
                                     }},
                                    {"state", "", {}, [](const R &r) {
                                       return std::string(r.adhesion ? "adhesion" : "slip");
                                     }}};
    return columns;
  }


  const Columns<PatchesRow> &patches_columns()
  {
    using R                         = PatchesRow;
    static const Columns<R> columns = []() {
      Columns<R> c{{"time", "s",
                    [](const R &r) {
                      return r.time;
                    }},
                   {"position", "mm", [](const R &r) {
                      return r.position;
                    }}};
      add_columns(c, patch_columns(), "", [](const R &r) -> const PatchNode & { return r.node; });
      return c;
    }();
    return columns;
  }


  const Columns<Passage> &passage_columns()
  {
    using R = Passage;
    static const Columns<R> columns{{"passage", "",
                                     [](const R &r) {
                                       return r.number;
                                     }},
                                    {"settlement", "um",
                                     [](const R &r) {
                                       return r.settlement;
                                     }},
                                    {"shift", "um",
                                     [](const R &r) {
                                       return r.shift;
                                     }},
                                    {"equivalent_plastic_strain", "percent",
                                     [](const R &r) {
                                       return r.plastic_strain;
                                     }},
                                    {"residual_von_mises", "MPa",
                                     [](const R &r) {
                                       return r.residual_stress;
                                     }},
                                    {"plastic_work", "J",
                                     [](const R &r) {
                                       return r.plastic_work;
                                     }},
                                    {"frictional_work", "J",
                                     [](const R &r) {
                                       return r.frictional_work;
                                     }},
                                    {"traction_coefficient", "",
                                     [](const R &r) {
                                       return r.traction_coefficient;
                                     }},
                                    {"max_pressure", "MPa",
                                     [](const R &r) {
                                       return r.max_pressure;
                                     }},
                                    {"energy_residual_share", "",
                                     [](const R &r) {
                                       return r.energy_residual_share;
                                     }},
                                    {"energy_residual_of_dissipated", "", [](const R &r) {
                                       return r.energy_residual_of_dissipated;
                                     }}};
    return columns;
  }


  const Columns<StressPeaks::Layer> &peak_columns()
  {
    using R = StressPeaks::Layer;
    static const Columns<R> columns{{"depth", "mm",
                                     [](const R &r) {
                                       return r.peak.depth;
                                     }},
                                    {"von_mises", "MPa",
                                     [](const R &r) {
                                       return r.peak.value;
                                     }},
                                    {"x", "mm",
                                     [](const R &r) {
                                       return r.peak.x;
                                     }},
                                    {"y", "mm",
                                     [](const R &r) {
                                       return r.peak.y;
                                     }},
                                    {"time", "s",
                                     [](const R &r) {
                                       return r.peak.time;
                                     }},
                                    {"wheel_x", "mm",
                                     [](const R &r) {
                                       return r.peak.wheel_x;
                                     }},
                                    {"equivalent_strain", "percent", [](const R &r) {
                                       return r.equivalent_strain;
                                     }}};
    return columns;
  }


  const Columns<StripColumn> &strip_columns()
  {
    using R = StripColumn;
    static const Columns<R> columns{{"x", "mm",
                                     [](const R &r) {
                                       return r.x;
                                     }},
                                    {"von_mises", "MPa",
                                     [](const R &r) {
                                       return r.largest.stress;
                                     }},
                                    {"y", "mm",
                                     [](const R &r) {
                                       return r.y;
                                     }},
                                    {"depth", "mm",
                                     [](const R &r) {
                                       return r.depth;
                                     }},
                                    {"time", "s",
                                     [](const R &r) {
                                       return r.largest.time;
                                     }},
                                    {"wheel_x", "mm",
                                     [](const R &r) {
                                       return r.largest.wheel_x;
                                     }},
                                    {"surface_von_mises", "MPa",
                                     [](const R &r) {
                                       return r.at_surface.stress;
                                     }},
                                    {"surface_y", "mm",
                                     [](const R &r) {
                                       return r.y_at_surface;
                                     }},
                                    {"surface_time", "s",
                                     [](const R &r) {
                                       return r.at_surface.time;
                                     }},
                                    {"surface_wheel_x", "mm",
                                     [](const R &r) {
                                       return r.at_surface.wheel_x;
                                     }},
                                    {"equivalent_plastic_strain", "percent", [](const R &r) {
                                       return r.equivalent_plastic_strain;
                                     }}};
    return columns;
  }


  const Columns<RailSeatPoint> &rail_seat_columns()
  {
    using R = RailSeatPoint;
    static const Columns<R> columns{{"support", "",
                                     [](const R &r) {
                                       return r.support;
                                     }},
                                    {"time", "s",
                                     [](const R &r) {
                                       return r.time;
                                     }},
                                    {"wheel_x", "mm",
                                     [](const R &r) {
                                       return r.wheel_x;
                                     }},
                                    {"x", "mm",
                                     [](const R &r) {
                                       return r.x;
                                     }},
                                    {"y", "mm",
                                     [](const R &r) {
                                       return r.y;
                                     }},
                                    {"pressure", "MPa", [](const R &r) {
                                       return r.pressure;
                                     }}};
    return columns;
  }
} // namespace tread
