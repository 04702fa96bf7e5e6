// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/hertz.h>
#include <tread/reference/rolling_case.h>
#include <tread/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tread
{
  namespace
  {
    /// Stiffness damping, in time steps, that levels of time steps need: what dynamics_levels shows to
    /// suffice.
    constexpr double least_damping_of_levels = 0.1;

    std::string number(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }
  } // namespace


  void Scene::check() const
  {
    const auto require = [](const bool holds, const std::string &line) {
      if (!holds)
        throw SceneError(line);
    };
    require(
      density_scale == 1. || quasi_static,
      "'Scene/Density scale' must be 1 when 'Scene/Quasi-static' is false: inertia is part of the answer");
    require(mass_damping == 0. || quasi_static,
            "'Solid/Mass damping (1 per s)' must be 0 when 'Scene/Quasi-static' is false: it slows waves "
            "that are part of the answer");
    require(inertia_error_estimate() <= 0.02 || !quasi_static,
            "'Scene/Density scale' " + number(density_scale) + " at " + number(speed_kmh) +
              " km/h makes an inertia error of about " + number(100. * inertia_error_estimate()) +
              " %; at most 2 % is allowed");
    require(speed_kmh >= 0.1,
            "'Motion/Speed (km per h)' must be at least 0.1: a wheel that stands does not roll" +
              std::string(drive == "torque" ? ", and a torque would only spin it" : ""));
    require(static_load() > 0., "'Vehicle/Gravity (m per s2)' must be above 0: nothing loads the contact");
    require(std::abs(traction_coefficient) < friction || (traction_coefficient == 0.) ||
              (drive == "creepage" && !predicts_creepage()),
            "'Motion/Traction coefficient' " + number(traction_coefficient) +
              " must be below 'Contact/Friction coefficient' " + number(friction) + " in size");
    friction_law();
    if (!predicts_creepage())
      {
        double      value = 0.;
        std::size_t used  = 0;
        try
          {
            value = std::stod(creepage, &used);
          }
        catch (const std::exception &)
          {
          }
        require(used == creepage.size() && used > 0 && std::abs(value) <= 0.2,
                "'Motion/Creepage' cannot be '" + creepage +
                  "'; allowed: 'predicted' or a number from -0.2 to 0.2");
      }
    require(drive != "torque" || hold_mm < rolled_mm,
            "'Motion/Hold distance (mm)' must be below 'Motion/Rolled distance (mm)' " + number(rolled_mm));

    check_surfaces();
    const ElasticMaterial wheel = wheel_material.si(), rail = rail_material.si();
    const auto            pair = reference::combine({wheel.young_modulus, wheel.poisson_ratio},
                                                    {rail.young_modulus, rail.poisson_ratio});
    const auto            hertz =
      reference::hertz_ellipse(500. / radius_mm, 0.5 / lateral_radius(), pair.hertz_modulus(), static_load());
    const double a_mm = 1e3 * hertz.semi_axis_x, b_mm = 1e3 * hertz.semi_axis_y;
    require(finest_mm <= 0.45 * std::min(a_mm, b_mm),
            "'Mesh/Finest cell (mm)' " + number(finest_mm) + " is too large for a patch of semi-axes " +
              number(a_mm) + " and " + number(b_mm) + " mm; at most " + number(0.45 * std::min(a_mm, b_mm)));
    const double fine_mm = 1e3 * fine_half_width(), needed_mm = 1e3 * needed_half_width();
    require(fine_mm >= needed_mm * (1. - 1e-9),
            "'Mesh/Fine half width (mm)' " + number(fine_mm) +
              " must hold the patch from y = " + number(1e3 * patch_extent().begin) + " to " +
              number(1e3 * patch_extent().end) + " mm; at least " + number(needed_mm));
    require(rail_margin_mm >= 3. * a_mm, "'Rail/Margin (mm)' " + number(rail_margin_mm) +
                                           " lets the wheel leave the rail; at least three semi-axes, " +
                                           number(3. * a_mm));
    require(wheel_shape == "full" || sector_margin_mm >= 3. * a_mm,
            "'Wheel/Sector margin (mm)' " + number(sector_margin_mm) +
              " lets the contact leave the sector; at least three semi-axes, " + number(3. * a_mm));
    require(wheel_shape == "full" ||
              rolled_mm + 2. * sector_margin_mm <= 0.95 * 2. * dealii::numbers::PI * radius_mm,
            "'Motion/Rolled distance (mm)' with 'Wheel/Sector margin (mm)' at both ends exceeds 95 % of the "
            "wheel's "
            "circumference, " +
              number(0.95 * 2. * dealii::numbers::PI * radius_mm));
    require(wheel_shape == "full" || sector_thickness_mm < radius_mm,
            "'Wheel/Sector thickness (mm)' must be below 'Wheel/Radius (mm)' " + number(radius_mm));
    require(wheel_shape == "sector" ||
              (bore_radius_mm < hub_outer_radius_mm && hub_outer_radius_mm < rim_inner_radius_mm &&
               rim_inner_radius_mm < radius_mm),
            "a full wheel needs 'Wheel/Bore radius (mm)' < 'Hub outer radius (mm)' < 'Rim inner radius (mm)' "
            "< 'Radius (mm)'");
    require(wheel_shape == "sector" || web_thickness_mm < std::min(rim_width_mm, hub_length_mm),
            "'Wheel/Web thickness (mm)' " + number(web_thickness_mm) +
              " must be below 'Wheel/Rim width (mm)' " + number(rim_width_mm) +
              " and 'Wheel/Hub length (mm)' " + number(hub_length_mm));
    require(rail_shape != "block" || crown_radius_mm > 0.5 * block_width_mm,
            "'Rail/Crown radius (mm)' " + number(crown_radius_mm) +
              " must be above half of 'Rail/Block width (mm)', " + number(0.5 * block_width_mm));
    require(rail_shape != "block" ||
              block_height_mm > -1e3 * crown_height(5e-4 * block_width_mm, 1e-3 * crown_radius_mm),
            "'Rail/Block height (mm)' " + number(block_height_mm) + " must be above the rise of the crown, " +
              number(-1e3 * crown_height(5e-4 * block_width_mm, 1e-3 * crown_radius_mm)));

    check_track();

    // Around the finest cells there is room for at least one more.
    require(coarsest_mm >= finest_mm, "'Mesh/Coarsest cell (mm)' " + number(coarsest_mm) +
                                        " must be at least 'Mesh/Finest cell (mm)' " + number(finest_mm));
    const double rail_half_width_mm =
      rail_shape == "block" ? 0.5 * block_width_mm : 1e3 * rail_profile().shoulder_length();
    const double beside_mm = 1e3 * std::abs(path_y());
    require(beside_mm + fine_mm <= rail_half_width_mm - finest_mm,
            "'Mesh/Fine half width (mm)' " + number(fine_mm) +
              (beside_mm > 0. ? " about y = " + number(1e3 * path_y()) + " mm" : "") +
              " must be below the half width of the rail; at most " +
              number(rail_half_width_mm - finest_mm - beside_mm));
    const double wheel_half_width_mm = 0.5 * (wheel_shape == "full" ? rim_width_mm : sector_width_mm);
    require(beside_mm + fine_mm <= wheel_half_width_mm - finest_mm,
            "'Mesh/Fine half width (mm)' " + number(fine_mm) +
              " must be below half of the wheel's width; at most " +
              number(wheel_half_width_mm - finest_mm - beside_mm));
    const double thickness_mm =
      std::min(rail_shape == "block" ? block_height_mm : 1e3 * rail_profile().head_depth(),
               wheel_shape == "full" ? radius_mm - rim_inner_radius_mm : sector_thickness_mm);
    require((fine_layers + 1) * finest_mm <= thickness_mm * (1. + 1e-9),
            "'Mesh/Fine layers' " + std::to_string(fine_layers) + " of 'Mesh/Finest cell (mm)' " +
              number(finest_mm) + " do not fit into rail and wheel; at most " +
              std::to_string(std::max(0, static_cast<int>(thickness_mm / finest_mm * (1. + 1e-9)) - 1)));
    require(element == "one-point" || (linear_bulk_viscosity == 0. && quadratic_bulk_viscosity == 0.),
            "'Solid/Linear bulk viscosity' and 'Solid/Quadratic bulk viscosity' must be 0 with "
            "'Solid/Element' fully-integrated");
    check_plasticity("Wheel", wheel_material,
                     wheel_shape == "full" ? radius_mm - rim_inner_radius_mm : sector_thickness_mm,
                     wheel_half_width_mm - beside_mm, -sector_margin_mm, rolled_mm + sector_margin_mm);
    check_plasticity("Rail", rail_material,
                     rail_shape == "block" ? block_height_mm : 1e3 * rail_profile().head_depth(),
                     rail_half_width_mm - beside_mm, 1e3 * rail_begin(), 1e3 * rail_end());
    check_numerics();
  }


  void Scene::check_plasticity(const std::string &section,
                               const Material    &material,
                               const double       thickness_mm,
                               const double       half_width_mm,
                               const double       begin_mm,
                               const double       end_mm) const
  {
    const auto require = [&](const bool holds, const std::string &name, const std::string &rest) {
      if (!holds)
        throw SceneError("'" + section + "/" + name + "' " + rest);
    };
    if (material.plastic_zones.empty() && material.yield_stress_MPa == 0.)
      return;
    const bool bilinear = material.hardening != "Armstrong-Frederick";
    const auto below    = [&](const double tangent_GPa) {
      return !bilinear || (tangent_GPa >= 0. && tangent_GPa < material.young_modulus_GPa);
    };
    require(element == "one-point" && linear_bulk_viscosity == 0. && quadratic_bulk_viscosity == 0.,
            "Yield stress (MPa)", "needs 'Solid/Element' one-point and no bulk viscosity");
    require(below(material.tangent_modulus_GPa), "Tangent modulus (GPa)",
            number(material.tangent_modulus_GPa) + " must be below Young's modulus, " +
              number(material.young_modulus_GPa));
    require(bilinear || dealii::Utilities::split_string_list(material.backstress_moduli_GPa).size() ==
                          dealii::Utilities::split_string_list(material.backstress_recoveries).size(),
            "Backstress moduli (GPa)", "has not as many entries as '" + section + "/Backstress recoveries'");
    require(material.plastic_depth_mm <= thickness_mm, "Plastic depth (mm)",
            number(material.plastic_depth_mm) + " leaves the mesh; at most " + number(thickness_mm));
    require(material.plastic_half_width_mm <= half_width_mm, "Plastic half width (mm)",
            number(material.plastic_half_width_mm) + " leaves the mesh; at most " + number(half_width_mm));
    for (const Material::Zone &zone : material.zones())
      {
        const std::string name = "Plastic zones";
        require(begin_mm <= zone.begin_mm && zone.begin_mm < zone.end_mm && zone.end_mm <= end_mm, name,
                "from " + number(zone.begin_mm) + " to " + number(zone.end_mm) +
                  " mm leaves the mesh, which is from " + number(begin_mm) + " to " + number(end_mm) + " mm");
        require(zone.depth_mm > 0. && zone.depth_mm <= thickness_mm, name,
                "of depth " + number(zone.depth_mm) + " mm leaves the mesh; above 0 and at most " +
                  number(thickness_mm));
        require(zone.yield_stress_MPa > 0., name,
                "with yield stress " + number(zone.yield_stress_MPa) + " MPa: must be above 0");
        require(below(zone.tangent_modulus_GPa), name,
                "with tangent modulus " + number(zone.tangent_modulus_GPa) +
                  " GPa: must be below Young's modulus, " + number(material.young_modulus_GPa));
      }
  }


  void Scene::check_numerics() const
  {
    const auto require = [](const bool holds, const std::string &line) {
      if (!holds)
        throw SceneError(line);
    };
    const auto needs_inertia = [&](const std::string &cause) {
      require(density_scale == 1., "'Scene/Density scale' must be 1 with " + cause +
                                     ": the inertia of the cells is part of the answer");
      require(mass_damping == 0., "'Solid/Mass damping (1 per s)' must be 0 with " + cause +
                                    ": it slows motion that is part of the answer");
    };
    if (defect())
      needs_inertia("'Defect/Shape' " + defect_shape);
    if (has_supports())
      needs_inertia("'Track/Foundation' " + foundation);
    require(time_levels == 1 || damping_steps >= least_damping_of_levels,
            "'Time stepping/Levels' " + std::to_string(time_levels) +
              " needs 'Solid/Stiffness damping (time steps)' of at least " + number(least_damping_of_levels) +
              ": levels of time steps resonate without it");
  }


  std::shared_ptr<const FrictionLaw> Scene::friction_law() const
  {
    handler.enter_subsection("Contact");
    std::shared_ptr<const FrictionLaw> law;
    std::string                        problem;
    try
      {
        law = make_friction_law(friction_law_name, friction, handler);
      }
    catch (const std::invalid_argument &error)
      {
        problem = error.what();
      }
    handler.leave_subsection();
    if (!law)
      throw SceneError(problem);
    return law;
  }


  std::vector<std::string> Scene::assumptions() const
  {
    std::vector<std::string> list;
    if (density_scale > 1.)
      list.push_back("density of the cells times " + number(density_scale) +
                     ": for steady rolling only, with an inertia error of about " +
                     number(std::round(1e4 * inertia_error_estimate()) / 100.) + " %");
    if (mass_damping > 0.)
      list.push_back("mass damping of " + number(mass_damping) +
                     " per s: motion of the cells on top of the rigid bodies' fades by half in " +
                     number(std::round(1e5 * 2. * std::log(2.) / mass_damping) / 100.) + " ms");
    if (drive == "torque" && (density_scale > 1. || mass_damping > 0.))
      list.push_back(
        "the way from the torque's onset to steady rolling is that of the scaled or damped cells, "
        "not the true one");
    list.push_back(start_tractions == "predicted"
                     ? "the start has the tractions that half-space theory predicts for steady rolling"
                     : "the start has no tractions; they build up while rolling");
    if (!friction_law()->is_constant())
      list.push_back("half-space theory, of the references and of what is predicted, has the friction "
                     "coefficient without slip, " +
                     number(friction_law()->coefficient(0.)) + ", everywhere");
    if (damping_steps == 0.)
      list.push_back("no stiffness damping: micro-slip may chatter at the frequency of the cells");
    return list;
  }


  double Scene::inertia_error_estimate() const
  {
    // Speed of Rayleigh waves (Viktorov 1967), the slower body's.
    const auto rayleigh = [](const ElasticMaterial &material) {
      const double nu = material.poisson_ratio;
      return material.shear_wave_speed() * (0.87 + 1.12 * nu) / (1. + nu);
    };
    const double slower = std::min(rayleigh(rail_material.si()), rayleigh(wheel_material.si()));
    return density_scale * speed() * speed() / (slower * slower);
  }
} // namespace tread
