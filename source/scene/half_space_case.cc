// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/damage_index.h>
#include <tread/geometry/rail_profile.h>
#include <tread/output/summary_keys.h>
#include <tread/reference/errors.h>
#include <tread/reference/fatigue.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/parts.h>
#include <tread/scene/surface_laws.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace tread
{
  namespace
  {
    /// Flatter gaps touch along a line, for which Hertz's ellipse means nothing, m.
    constexpr double largest_lateral_radius = 10.;
  } // namespace


  reference::Elastic elastic_of(const MaterialSection &material)
  {
    return {material.elastic().young_modulus, material.elastic().poisson_ratio};
  }


  reference::RollingCase half_space_case(const Scene &scene,
                                         const double normal_force,
                                         const double traction_coefficient)
  {
    reference::RollingCase c;
    c.curvature_x  = 0.5 / scene.stance().rolling_radius();
    c.curvature_y  = 0.5 / lateral_radius(scene);
    c.normal_force = normal_force;
    c.speed        = scene.motion.speed;
    set_friction(c, scene, scene.path_end());
    c.wheel                         = elastic_of(scene.wheel.material);
    c.rail                          = elastic_of(scene.rail.material);
    c.prescribe_force               = true;
    c.traction_coefficient          = traction_coefficient;
    c.lateral_creepage              = scene.motion.lateral_creepage;
    c.spin                          = scene.motion.spin;
    const RunningSurfaces &surfaces = scene.shapes().surfaces;
    const double           y_middle = scene.shapes().first_contact.y;
    if (scene.contact.varies_across())
      c.place_factor = [&scene, y_middle](const double, const double y) {
        return scene.stance().factor_across(Vector3{0., y_middle + y, 0., 0.});
      };
    if (!scene.rail.is_block() || surfaces.tread_offset)
      c.gap = [curvature_x = c.curvature_x, surfaces, y_middle,
               closed      = surfaces.gap(y_middle)](const double x, const double y) {
        return curvature_x * x * x + surfaces.gap(y_middle + y) - closed;
      };
    if (surfaces.tread_offset)
      c.radius_change = [offset    = surfaces.tread_offset, y_middle,
                         at_middle = surfaces.tread_offset(y_middle),
                         radius    = scene.stance().rolling_radius()](const double y) {
        return (offset(y_middle + y) - at_middle) / radius;
      };
    // 50 elements along a patch, or as many elements in a wide one: creepages within 0.03 % of the limit for
    // Hertz's patch, a quarter of a per cent for others.
    const reference::HertzEllipse ellipse = hertz(c);
    const double                  a = ellipse.semi_axis_x, b = ellipse.semi_axis_y;
    c.element_size = std::min(std::max(a, std::sqrt(a * b)) / 25., std::min(a, b) / 7.);
    return c;
  }


  reference::RollingCase half_space_case(const Scene &scene, const unsigned int wheel)
  {
    const bool             creepage_given = scene.motion.drive == Drive::creepage && scene.motion.creepage;
    reference::RollingCase c =
      half_space_case(scene, scene.static_load(), creepage_given ? 0. : scene.traction_coefficient(wheel));
    c.prescribe_force = !creepage_given;
    if (creepage_given)
      c.creepage = -*scene.motion.creepage;
    return c;
  }


  void set_friction(reference::Friction &c, const Scene &scene, const double x)
  {
    const double factor = scene.contact.friction_factor(x);
    const auto   law    = friction_law(scene);
    c.friction          = factor * law->coefficient(0.);
    c.slip_friction.reset();
    if (!scene.contact.friction_pressures.empty())
      c.pressure_factor = [contact = scene.contact](const double p) {
        return contact.pressure_factor(p);
      };
    if (!scene.contact.temperatures.empty())
      {
        const SurfaceDamageParameters heat = surface_damage_parameters(scene);
        c.heat_friction =
          std::make_shared<const reference::Friction::HeatFriction>(reference::Friction::HeatFriction{
            factor_by_rise(scene), 1. - heat.master_share, heat.slave_effusivity});
      }
    if (!law->is_constant())
      c.slip_friction = std::make_shared<const reference::Friction::SlipFriction>(
        reference::Friction::SlipFriction{[=](const double s) { return factor * law->coefficient(s); },
                                          law->memory().distance, law->memory().speed});
  }


  void require_half_space(const Scene &scene)
  {
    if (scene.shapes().is_between_planes())
      throw InputError("a rail between two planes of symmetry, in plane strain, has no half-space answer");
  }


  reference::RollingEstimate half_space_answer(const Scene                  &scene,
                                               const reference::RollingCase &c,
                                               const unsigned int            wheel)
  {
    require_half_space(scene);
    const std::string law = "'Contact/Friction law' " + scene.contact.friction_law;
    const std::string traction =
      (wheel == 0 ? "'Motion/Traction coefficient' " : "'Further wheels/Traction coefficients' ") +
      text_of(c.traction_coefficient);
    if (c.slip_friction && reference::combine(c.wheel, c.rail).coupling != 0.)
      throw InputError(law + " with unlike materials of wheel and rail has no half-space answer");
    const std::string places = "'Contact/Friction across (mm)' or 'Friction inclinations (deg)'";
    for (const auto &[is_given, name] :
         {std::pair(bool(c.pressure_factor), std::string("'Contact/Friction pressures (MPa)'")),
          std::pair(bool(c.heat_friction), std::string("'Contact/Friction temperatures (C)'")),
          std::pair(bool(c.place_factor), places)})
      {
        if (is_given && reference::combine(c.wheel, c.rail).coupling != 0.)
          throw InputError(name + " with unlike materials of wheel and rail has no half-space answer");
        if (is_given && c.slip_friction)
          throw InputError(name + " with " + law + " has no half-space answer");
      }
    const double carried = c.friction * (c.place_factor ? mean_factor_across(scene) : 1.);
    if (c.prescribe_force && c.traction_coefficient != 0. && std::abs(c.traction_coefficient) >= carried)
      throw InputError(traction + " is not below the friction coefficient in size, which is " +
                       text_of(carried) +
                       " there by 'Contact/Friction coefficient' and the tables of its factors");
    try
      {
        return reference::estimate_rolling(c);
      }
    catch (const reference::FrictionTooSteep &error)
      {
        throw InputError(law + ": " + error.what() + "; see 'Contact/Friction memory (mm)'");
      }
    catch (const std::bad_alloc &)
      {
        throw; // no fault of the input
      }
    catch (const std::exception &error)
      {
        if (c.prescribe_force && (c.pressure_factor || c.place_factor || c.heat_friction))
          throw InputError(traction +
                           " is beyond what the factors of section 'Contact' on the friction "
                           "coefficient leave, or too near to it: lower it (" +
                           error.what() + ")");
        if (c.prescribe_force && c.slip_friction)
          throw InputError(traction + " is beyond what " + law +
                           " carries while it slips, or too near to it: lower it (" + error.what() + ")");
        throw InputError(error.what());
      }
  }


  reference::HertzEllipse hertz(const reference::RollingCase &c)
  {
    return reference::hertz_ellipse(c.curvature_x, c.curvature_y,
                                    reference::combine(c.wheel, c.rail).hertz_modulus(), c.normal_force);
  }


  namespace
  {
    /// The line contact of a slice. What would be the ellipse's other semi-axis is half its width too:
    /// nothing varies across, and what is sized by the smaller or the mean one follows the line.
    reference::HertzEllipse line_between_planes(const Scene &scene, const double normal_force)
    {
      const double width = scene.wheel.sector_width;
      const double modulus =
        reference::combine(elastic_of(scene.wheel.material), elastic_of(scene.rail.material)).hertz_modulus();
      const reference::HertzLine line =
        reference::hertz_line(scene.stance().rolling_radius(), modulus, normal_force / width);
      // Of bodies as thick as the sector, held at their backs (Johnson 1985, section 5.6).
      const double nu = scene.wheel.material.elastic().poisson_ratio;
      const double per_force =
        (2. * std::log(2. * scene.wheel.sector_thickness / line.half_width) - nu / (1. - nu)) /
        (dealii::numbers::PI * modulus * width);
      reference::HertzEllipse ellipse;
      ellipse.semi_axis_x   = line.half_width;
      ellipse.semi_axis_y   = line.half_width;
      ellipse.max_pressure  = line.max_pressure;
      ellipse.mean_pressure = line.mean_pressure;
      ellipse.approach      = per_force * normal_force;
      ellipse.area          = 2. * line.half_width * width;
      ellipse.stiffness     = 1. / per_force;
      return ellipse;
    }
  } // namespace


  reference::HertzEllipse UprightWheel::ellipse(const double normal_force) const
  {
    if (scene.shapes().is_between_planes())
      return line_between_planes(scene, normal_force);
    return hertz(half_space_case(scene, normal_force, 0.));
  }


  double lateral_radius(const Scene &scene)
  {
    if (!has_fitted_lateral_radius(scene))
      return scene.rail.is_block() ? scene.rail.crown_radius : scene.rail.standard_profile().crown_radius();
    return std::min(scene.shapes().first_contact.lateral_radius, largest_lateral_radius);
  }


  bool has_fitted_lateral_radius(const Scene &scene)
  {
    return scene.shapes().surfaces.tread_offset || scene.rail.angle() != 0. ||
           !scene.rail.measured_head.empty() || scene.rail.is_meshed();
  }


  reference::HertzEllipse hertz_over_patch(const Scene &scene, const double normal_force)
  {
    reference::HertzEllipse ellipse = scene.stance().ellipse(normal_force);
    if (scene.shapes().is_between_planes() || !has_fitted_lateral_radius(scene))
      return ellipse;
    reference::RollingCase c = half_space_case(scene, normal_force, 0.);
    for (unsigned int pass = 0; pass < 30; ++pass)
      {
        const double radius =
          fitted_lateral_radius(scene.shapes().surfaces, scene.shapes().first_contact.y, ellipse.semi_axis_y);
        const double before = ellipse.semi_axis_y;
        c.curvature_y       = 0.5 / std::min(radius, largest_lateral_radius);
        ellipse             = hertz(c);
        if (std::abs(ellipse.semi_axis_y - before) < 1e-6 * before)
          return ellipse;
      }
    return scene.stance().ellipse(normal_force); // two sizes in turn: that of 5 mm
  }


  double half_space_stretch(const Scene &scene)
  {
    const reference::HertzEllipse ellipse = scene.stance().ellipse(scene.static_load());
    const auto                    stretch = [&](const ElasticMaterial &material) {
      const double nu = material.poisson_ratio;
      return -(1. + nu) * (1. - 2. * nu) / material.young_modulus * ellipse.semi_axis_y /
             (ellipse.semi_axis_x + ellipse.semi_axis_y) * 0.75 * ellipse.max_pressure;
    };
    return stretch(scene.rail.material.elastic()) - stretch(scene.wheel.material.elastic());
  }


  std::vector<PatchNode> patch_nodes(const reference::RollingResult &half_space, const double y_first_contact)
  {
    std::vector<PatchNode> nodes;
    for (std::size_t i = 0; i < half_space.x.size(); ++i)
      if (half_space.state[i] != reference::ElementState::exterior)
        nodes.push_back({Vector3{half_space.x[i], half_space.y[i] + y_first_contact, 0., 0.},
                         half_space.grid.dx * half_space.grid.dy,
                         half_space.pressure[i],
                         {half_space.shear_x[i], half_space.shear_y[i]},
                         {half_space.slip_x[i], half_space.slip_y[i]},
                         half_space.state[i] == reference::ElementState::adhesion});
    return nodes;
  }


  Vector3 traction_over_pressure(const reference::RollingResult &half_space, const double x, const double y)
  {
    const double       dx = half_space.grid.dx, dy = half_space.grid.dy;
    const unsigned int n_steps = std::ceil(std::max(std::abs(x) / dx, std::abs(y) / dy));
    for (unsigned int step = n_steps + 1; step-- > 0;)
      {
        const double share  = n_steps > 0 ? double(step) / n_steps : 0.;
        const double column = std::round((share * x - half_space.x.front()) / dx),
                     row    = std::round((share * y - half_space.y.front()) / dy);
        if (column < 0. || column >= half_space.grid.n_x || row < 0. || row >= half_space.grid.n_y)
          continue;
        const std::size_t i = half_space.grid.n_x * std::size_t(row) + std::size_t(column);
        if (half_space.pressure[i] > 0.)
          return Vector3{half_space.shear_x[i], half_space.shear_y[i], 0., 0.} *
                 (1. / half_space.pressure[i]);
      }
    return Vector3{};
  }


  ContactAnswer contact_answer(const reference::RollingEstimate &half_space)
  {
    const reference::RollingResult &fields = half_space.fields;
    ContactAnswer                   answer;
    answer.force =
      Vector3{half_space.longitudinal_force.value, half_space.lateral_force.value, fields.normal_force, 0.};
    answer.creepage               = 0. - half_space.creepage.value;
    answer.patch                  = measure(patch_nodes(fields, 0.));
    answer.patch.max_pressure     = half_space.max_pressure.value;
    answer.patch.area             = half_space.area.value;
    answer.patch.semi_axis_x      = fields.semi_axis_x;
    answer.patch.semi_axis_y      = fields.semi_axis_y;
    answer.patch.adhesion_share   = half_space.adhesion_share.value;
    answer.patch.max_shear        = half_space.max_shear.value;
    answer.patch.max_slip         = half_space.max_slip.value;
    answer.patch.frictional_power = half_space.frictional_power.value;
    return answer;
  }


  namespace
  {
    SummaryKeys keys_of_damage_indices()
    {
      SummaryKeys keys;
      for (const DamageIndexEntry &index : damage_indices())
        keys.push_back({index.key, index.about});
      return keys;
    }

    const bool keys_of_answers_are_known =
      know_summary_keys(
        SummaryGroup::first_wheel,
        {{"first_contact_y_m", "Where wheel and rail touch first without load and defect, from the middle of "
                               "the rail's top, positive to the field side"},
         {"semi_axis_x_m", "Half the length of the patch along the rail, from the first to the last node in "
                           "contact and a cell, " +
                             over_a_cell},
         {"semi_axis_y_m", "Half its width across the rail, likewise, " + over_a_cell},
         {"pressure_semi_axis_x_m",
          "Semi-axis along the rail of Hertz's ellipse with the same second moment of pressure, " +
            over_a_cell},
         {"pressure_semi_axis_y_m", "The same across the rail, " + over_a_cell},
         {"pressure_centre_x_m",
          "Where the resultant of the pressure acts, along the rail ahead of the axle, " + over_a_cell},
         {"pressure_centre_y_m", "The same across, from the middle of the rail's top, " + over_a_cell},
         {"lateral_coefficient", "Resultant of the lateral shear stress over that of the pressure, " +
                                   over_a_cell + "; where the half-space solution has a lateral force"}}) &&
      know_summary_keys(SummaryGroup::damage_indices, keys_of_damage_indices());
  } // namespace


  void summarise_damage(Summary &summary, const Scene &scene, const std::vector<DamageIndex::Load> &loads)
  {
    const DamageIndices                         indices = indices_of_damage(scene);
    std::vector<std::pair<std::string, double>> worst;
    for (const DamageIndex::Load &load : loads)
      for (const auto &[key, value] : damage_of(indices, load))
        {
          const auto found = std::find_if(worst.begin(), worst.end(),
                                          [&key = key](const auto &entry) { return entry.first == key; });
          if (found == worst.end())
            worst.emplace_back(key, value);
          else
            found->second = std::max(found->second, value);
        }
    for (const auto &[key, value] : worst)
      summary.set(key, value);
  }


  void summarise(Summary             &summary,
                 const Scene         &scene,
                 const std::string   &method,
                 const ContactAnswer &answer,
                 const bool           completed)
  {
    const double         normal = answer.force[2];
    const PatchMeasures &patch  = answer.patch;
    summary.set("title", scene.general.title);
    summary.set("method", method);
    summary.set("completed", completed);
    summary.set("normal_force_N", normal);
    summary.set("longitudinal_force_N", answer.force[0]);
    summary.set("lateral_force_N", answer.force[1]);
    summary.set("traction_coefficient", normal > 0. ? answer.force[0] / normal : 0.);
    summary.set("friction_coefficient", scene.contact.friction_coefficient);
    summary.set("first_contact_y_m", scene.shapes().first_contact.y);

    // A wheel that has lifted off is compared with the patch of the static load.
    const reference::HertzEllipse ellipse =
      hertz_over_patch(scene, normal > 0. ? normal : scene.static_load());
    const auto with_hertz = [&](const char *name, const char *label, const double scale, const double value,
                                const double reference) {
      summary.compare(name, label, scale, value, "Hertz", reference);
    };
    with_hertz("max_pressure_Pa", "maximum pressure, MPa", 1e-6, patch.max_pressure, ellipse.max_pressure);
    with_hertz("patch_area_m2", "patch area, mm2", 1e6, patch.area, ellipse.area);
    with_hertz("semi_axis_x_m", "semi-axis a, mm", 1e3, patch.semi_axis_x, ellipse.semi_axis_x);
    // By moments of the pressure of an ellipse, which a line has not.
    if (scene.shapes().is_between_planes())
      {
        summary.set("semi_axis_y_m", patch.semi_axis_y);
        summary.set("pressure_semi_axis_x_m", patch.pressure_semi_axis_x);
        summary.set("pressure_semi_axis_y_m", patch.pressure_semi_axis_y);
      }
    else
      {
        with_hertz("semi_axis_y_m", "semi-axis b, mm", 1e3, patch.semi_axis_y, ellipse.semi_axis_y);
        with_hertz("pressure_semi_axis_x_m", "a by moments of pressure, mm", 1e3, patch.pressure_semi_axis_x,
                   ellipse.semi_axis_x);
        with_hertz("pressure_semi_axis_y_m", "b by moments of pressure, mm", 1e3, patch.pressure_semi_axis_y,
                   ellipse.semi_axis_y);
      }
    // Of the resultant of the pressure: ahead of the axle, and from the rail's middle.
    summary.set("pressure_centre_x_m", patch.x_of_pressure);
    summary.set("pressure_centre_y_m", patch.y_of_pressure);

    summary.show("creepage", "creepage, 1e-3", 1e3, answer.creepage);
    summary.show("adhesion_share", "adhesion share, %", 1e2, patch.adhesion_share);
    summary.show("max_shear_Pa", "maximum shear stress, MPa", 1e-6, patch.max_shear);
    summary.show("max_slip_m_per_s", "maximum micro-slip, m/s", 1., patch.max_slip);
    summary.show("frictional_power_W", "frictional power, W", 1., patch.frictional_power);
    summary.set("t_gamma_N", patch.frictional_power / scene.motion.speed);
    summarise_damage(summary, scene,
                     {{normal, std::hypot(answer.force[0], answer.force[1]), patch.area, patch.max_pressure,
                       patch.frictional_power / scene.motion.speed, shear_strength(scene)}});
  }


  void compare(Summary                          &summary,
               const ContactAnswer              &answer,
               const reference::RollingEstimate &half_space,
               const bool                        forces_given)
  {
    const ContactAnswer reference = contact_answer(half_space);
    // The last number: what is as good as nothing.
    const auto with_half_space = [&](const char *name, const char *label, const double scale,
                                     const double value, const double reference,
                                     const reference::Estimate &estimate, const double negligible) {
      summary.compare(name, label, scale, value, "half-space", reference, negligible, estimate.uncertainty);
    };
    with_half_space("max_pressure_Pa", "maximum pressure, MPa", 1e-6, answer.patch.max_pressure,
                    reference.patch.max_pressure, half_space.max_pressure, 0.);
    // Near free rolling the creepage is that of free rolling, of which half-spaces know nothing.
    constexpr double near_free_rolling = 0.02; // tangential over normal force
    const double     no_creepage =
      std::hypot(answer.force[0], answer.force[1]) < near_free_rolling * answer.force[2]
            ? std::numeric_limits<double>::infinity()
            : 1e-5;
    if (forces_given)
      with_half_space("creepage", "creepage, 1e-3", 1e3, answer.creepage, reference.creepage,
                      half_space.creepage, no_creepage);
    else
      with_half_space("traction_coefficient", "traction coefficient", 1., answer.force[0] / answer.force[2],
                      reference.force[0] / reference.force[2], half_space.traction_coefficient, 1e-3);
    // Lateral creepage or spin: a prescribed one, or that of a tapered tread.
    constexpr double no_lateral_force = 1e-3;
    if (const double lateral = reference.force[1] / reference.force[2]; std::abs(lateral) > no_lateral_force)
      with_half_space("lateral_coefficient", "lateral over normal force", 1.,
                      answer.patch.lateral_force / answer.patch.normal_force, lateral,
                      {lateral, half_space.lateral_force.uncertainty / reference.force[2]}, no_lateral_force);
    with_half_space("adhesion_share", "adhesion share, %", 1e2, answer.patch.adhesion_share,
                    reference.patch.adhesion_share, half_space.adhesion_share, 0.);
    with_half_space("max_shear_Pa", "maximum shear stress, MPa", 1e-6, answer.patch.max_shear,
                    reference.patch.max_shear, half_space.max_shear, 5e-3 * reference.patch.max_pressure);
    with_half_space("max_slip_m_per_s", "maximum micro-slip, m/s", 1., answer.patch.max_slip,
                    reference.patch.max_slip, half_space.max_slip, 1e-3);
    with_half_space("frictional_power_W", "frictional power, W", 1., answer.patch.frictional_power,
                    reference.patch.frictional_power, half_space.frictional_power, 1.);
  }
} // namespace tread
