// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/scene.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tread
{
  namespace
  {
    std::string text_of(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }
  } // namespace


  void Scene::declare_track()
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    using dealii::Patterns::Selection;
    constexpr double          tiny = 1e-12; // for "above 0"
    dealii::ParameterHandler &prm  = handler;
    prm.enter_subsection("Track");
    prm.add_parameter(
      "Foundation", foundation,
      "rigid: the rail's bottom is held. one-layer: it rests on pads on the ground. two-layer: pads, "
      "sleepers "
      "and "
      "ballast. With either the rail's ends are planes of symmetry, and supports move vertically only.",
      Selection("rigid|one-layer|two-layer"));
    prm.add_parameter(
      "Sleepers", sleepers,
      "Of two layers. mass: they move in z and are rigid. solid: half sleepers of cells, the middle of the "
      "track "
      "being a plane of symmetry; they bend and cost cells.",
      Selection("mass|solid"));
    prm.add_parameter("Sleeper spacing (m)", sleeper_spacing_m,
                      "Between the supports' middles. The rail must end between half a pad and half a "
                      "spacing beyond its last supports.",
                      Double(0.05, 10.));
    prm.add_parameter("Support 0 (mm)", support_0_mm,
                      "x of the support with number 0. Numbers grow in rolling direction.",
                      Double(-20000., 20000.));
    prm.add_parameter("Pad stiffness (MN per m)", pad_stiffness_MN_m, "Of a whole support, vertical.",
                      Double(tiny));
    prm.add_parameter("Pad damping (kN s per m)", pad_damping_kN_s_m, "Of a whole support, vertical.",
                      Double(0.));
    prm.add_parameter("Pad length (mm)", pad_length_mm,
                      "Along the rail. Longer pads hold the rail's slope as well.", Double(1., 2000.));
    prm.add_parameter("Pad width (mm)", pad_width_mm,
                      "Across the rail, at most the foot's. Wider pads resist the rail's rolling over more.",
                      Double(1., 2000.));
    prm.add_parameter("Points along", points_along,
                      "A pad acts at this many points along the rail (so does the ballast under a solid "
                      "sleeper). 1: the slope of the rail is free.",
                      Integer(1, 50));
    prm.add_parameter("Points across", points_across,
                      "The same across the rail. 1: nothing keeps the rail from tipping over, so only for "
                      "upright rails that are loaded on y = 0 and whose crown radius exceeds their height.",
                      Integer(1, 50));
    prm.add_parameter("Sleeper mass (kg)", sleeper_mass,
                      "What one rail's support carries: half a sleeper. Sets the height of a solid one.",
                      Double(tiny));
    prm.add_parameter("Sleeper length (m)", sleeper_length_m, "Whole, of a solid sleeper.", Double(0.1, 10.));
    prm.add_parameter("Sleeper width (mm)", sleeper_width_mm,
                      "Along the rail, of a solid sleeper; not below the pad's length.", Double(1., 2000.));
    prm.add_parameter("Rail distance (mm)", rail_distance_mm,
                      "Between the middles of both rails, with solid sleepers: half of it to the track's "
                      "middle, at y < 0.",
                      Double(1., 5000.));
    prm.add_parameter("Sleeper Young's modulus (GPa)", sleeper_young_modulus_GPa, "Of a solid sleeper.",
                      Double(1e-3, 1e4));
    prm.add_parameter("Sleeper Poisson's ratio", sleeper_poisson_ratio, "Of a solid sleeper.",
                      Double(0., 0.49));
    prm.add_parameter("Sleeper density (kg per m3)", sleeper_density, "Of a solid sleeper.", Double(1., 1e5));
    prm.add_parameter("Ballast stiffness (MN per m)", ballast_stiffness_MN_m,
                      "Of a whole support (one rail's), vertical.", Double(tiny));
    prm.add_parameter("Ballast damping (kN s per m)", ballast_damping_kN_s_m,
                      "Of a whole support (one rail's), vertical.", Double(0.));
    prm.leave_subsection();
  }


  void Scene::check_track() const
  {
    if (!has_supports() && rail_ends != "symmetric")
      throw SceneError("'Rail/Ends' " + rail_ends +
                       " needs a rail on supports: 'Track/Foundation' cannot be rigid");
    if (!has_supports())
      return;
    const auto require = [](const bool holds, const std::string &line) {
      if (!holds)
        throw SceneError(line);
    };
    require(rail_shape != "head",
            "'Track/Foundation' " + foundation + " needs a rail with a foot: 'Rail/Shape' cannot be head");
    require(density_scale == 1., "'Scene/Density scale' must be 1 with 'Track/Foundation' " + foundation +
                                   ": the inertia of rail and sleepers is part of the answer");
    require(pad_length_mm < 1e3 * sleeper_spacing_m, "'Track/Pad length (mm)' " + text_of(pad_length_mm) +
                                                       " must be below the sleeper spacing, " +
                                                       text_of(1e3 * sleeper_spacing_m));
    const double base_mm = rail_shape == "block"
                             ? block_width_mm
                             : 2e3 * rail_profile().outline_point(rail_profile().corners().foot_edge)[0];
    require(pad_width_mm <= base_mm, "'Track/Pad width (mm)' " + text_of(pad_width_mm) +
                                       " exceeds the flat width of the rail's base, " + text_of(base_mm));
    // A rail that rolls on its crown under the load rises, and comes back, if the crown's centre lies below
    // its foot.
    const double height_mm = rail_shape == "block" ? block_height_mm : 1e3 * rail_profile().height();
    require(points_across > 1 ||
              (inclination() == 0. && measured_head.empty() && std::abs(first_contact().y) < 1e-6 &&
               (!defect() || defect_lateral_mm == 0.) && 1e3 * lateral_radius() > height_mm),
            "'Track/Points across' must be at least 2: on one the rail tips over, unless it stands upright "
            "('Rail/Inclination' none), wheel and defect meet it on y = 0, and its crown radius exceeds its "
            "height, " +
              text_of(height_mm) + " mm");
    const std::vector<double> positions = support_positions();
    const double              begin_mm = 1e3 * rail_begin(), end_mm = 1e3 * rail_end();
    require(positions.size() >= 2, "'Track/Sleeper spacing (m)' " + text_of(sleeper_spacing_m) + " leaves " +
                                     std::to_string(positions.size()) + " supports on the rail of " +
                                     text_of(end_mm - begin_mm) + " mm; at least 2 are needed");
    constexpr double round_off_mm   = 1e-6;
    const auto       check_overhang = [&](const double overhang_mm, const std::string &begins,
                                    const std::string &support) {
      require(overhang_mm >= 0.5 * pad_length_mm - round_off_mm &&
                      overhang_mm <= 500. * sleeper_spacing_m + round_off_mm,
                    "'Track/Sleeper spacing (m)' " + text_of(sleeper_spacing_m) + " does not fit the rail from " +
                      text_of(begin_mm) + " to " + text_of(end_mm) + " mm: it " + begins + " " +
                      text_of(overhang_mm < round_off_mm ? 0. : overhang_mm) + " mm " + support +
                      "; from half a pad, " + text_of(0.5 * pad_length_mm) + ", to half a spacing, " +
                      text_of(500. * sleeper_spacing_m) + ", is allowed");
    };
    check_overhang(1e3 * positions.front() - begin_mm, "begins", "before its first support");
    check_overhang(end_mm - 1e3 * positions.back(), "ends", "behind its last support");
    if (const auto ends = absorbing_ends(); ends.length > 0.)
      {
        const double clear_m = std::min(path_begin() - ends.begin, ends.end - path_end()) - sleeper_spacing_m;
        require(ends.length <= clear_m + 1e-3 * round_off_mm,
                "'Rail/Absorbing length (m)' " + text_of(ends.length) +
                  " leaves less than a sleeper spacing between the absorbing ends and the wheel's path; at "
                  "most " +
                  text_of(std::max(0., clear_m)) + " fits this rail");
      }
    if (has_solid_sleepers())
      {
        require(pad_length_mm <= sleeper_width_mm && sleeper_width_mm < 1e3 * sleeper_spacing_m,
                "'Track/Sleeper width (mm)' " + text_of(sleeper_width_mm) +
                  " must be from 'Pad length (mm)' to below the spacing");
        require(0.5 * (rail_distance_mm + pad_width_mm) <= 500. * sleeper_length_m &&
                  pad_width_mm <= rail_distance_mm,
                "'Track/Sleeper length (m)' " + text_of(sleeper_length_m) +
                  " does not reach under the pads of rails at 'Rail distance (mm)' " +
                  text_of(rail_distance_mm));
      }
    for (const int support : recorded_supports())
      require(support >= first_support() && support < first_support() + static_cast<int>(positions.size()),
              "'Output/Supports' has " + std::to_string(support) + "; the rail has supports " +
                std::to_string(first_support()) + " to " +
                std::to_string(first_support() + static_cast<int>(positions.size()) - 1));
  }


  int Scene::first_support() const
  {
    // The first whose middle lies on the rail.
    return std::ceil((1e3 * rail_begin() - support_0_mm) / (1e3 * sleeper_spacing_m) - 1e-9);
  }


  std::vector<double> Scene::support_positions() const
  {
    const int last = std::floor((1e3 * rail_end() - support_0_mm) / (1e3 * sleeper_spacing_m) + 1e-9);
    std::vector<double> positions;
    for (int i = first_support(); i <= last; ++i)
      positions.push_back(1e-3 * support_0_mm + sleeper_spacing_m * i);
    return positions;
  }


  std::vector<int> Scene::recorded_supports() const
  {
    std::vector<int> numbers;
    if (!has_supports())
      return numbers;
    for (const std::string &text : dealii::Utilities::split_string_list(recorded))
      numbers.push_back(dealii::Utilities::string_to_int(text));
    if (numbers.empty())
      {
        const double spacing_mm = 1e3 * sleeper_spacing_m;
        const int    size       = support_positions().size();
        const int    first      = std::max<int>(first_support(),
                                        std::floor((1e3 * path_begin() - support_0_mm) / spacing_mm)),
                  last          = std::min<int>(first_support() + size - 1,
                                       std::ceil((1e3 * path_end() - support_0_mm) / spacing_mm));
        for (int i = first; i <= last; ++i)
          numbers.push_back(i);
      }
    return numbers;
  }


  TrackParameters Scene::track() const
  {
    TrackParameters p;
    p.pad_stiffness     = 1e6 * pad_stiffness_MN_m;
    p.pad_damping       = 1e3 * pad_damping_kN_s_m;
    p.pad_length        = 1e-3 * pad_length_mm;
    p.pad_width         = 1e-3 * pad_width_mm;
    p.pad_middle        = base_middle()[1];
    p.points_along      = points_along;
    p.points_across     = points_across;
    p.two_layers        = foundation == "two-layer";
    p.sleeper_mass      = sleeper_mass;
    p.ballast_stiffness = 1e6 * ballast_stiffness_MN_m;
    p.ballast_damping   = 1e3 * ballast_damping_kN_s_m;
    return p;
  }


  AbsorbingEnds Scene::absorbing_ends() const
  {
    return {rail_begin(), rail_end(), rail_ends == "absorbing" ? absorbing_length_m : 0.,
            rail_material.si().shear_wave_speed()};
  }


  double Scene::solid_sleeper_height() const
  {
    return sleeper_mass / (sleeper_density * 0.5 * sleeper_length_m * 1e-3 * sleeper_width_mm);
  }


  dealii::Point<3> Scene::base_middle() const
  {
    const double height = rail_shape == "block" ? 1e-3 * block_height_mm : rail_profile().height();
    return dealii::Point<3>(0., std::sin(inclination()) * height, -std::cos(inclination()) * height);
  }
} // namespace tread
