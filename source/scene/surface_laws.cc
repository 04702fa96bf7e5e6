// SPDX-License-Identifier: LGPL-2.1-or-later
// Laws of the surfaces in contact: friction, wear, damage.
// The friction law of a scene, and how long it has to remember.
#include <tread/base/format.h>
#include <tread/base/registry.h>
#include <tread/contact/remembering_friction.h>
#include <tread/scene/checks.h>
#include <tread/scene/placed_wheel.h>
#include <tread/scene/scene.h>
#include <tread/scene/surface_laws.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    /// The memory of friction that is taken, over the least for which slip is steady by a linear law, and the
    /// least that nothing is said of: at once the least, a steep law lost 14 % of its traction, and 1 % at
    /// twice.
    constexpr double memory_room = 3., least_room = 1.5;

    /// The least memory of a law that falls (m) with which slip under this load does not oscillate by itself;
    /// 0: it does not without one.
    double needed_memory(const Scene &scene, const FrictionLaw &law)
    {
      // An upright wheel on a crown of its own radius stands for all: pressure and length go with the cube
      // root of the load.
      const ElasticMaterial of_wheel = scene.wheel.material.elastic(),
                            of_rail  = scene.rail.material.elastic();
      const auto compliance          = [](const ElasticMaterial &m) {
        return (1. - m.poisson_ratio * m.poisson_ratio) / m.young_modulus;
      };
      const double modulus = 1. / (compliance(of_wheel) + compliance(of_rail)),
                   shear = of_rail.shear_modulus(), load = scene.static_load(),
                   a        = std::cbrt(0.75 * load * scene.wheel.radius / modulus),
                   pressure = 1.5 * load / (dealii::numbers::PI * a * a);
      // Waves carry this much away, half the shear impedance. Cells of scaled density would carry more, but
      // shake before that is reached: a third to all of the slip speed, between two and five times this
      // value.
      const double impedance = 0.5 * std::sqrt(of_rail.density * shear);
      // What slides in a patch slides no faster than this; where nothing says how fast, or a profile adds its
      // own, a hundredth of the speed.
      constexpr double of_profile = 0.01;
      const double     given      = scene.motion.creepage ? std::abs(*scene.motion.creepage) : 0.,
                   fastest =
                     scene.motion.speed * (given + of_profile + std::abs(scene.motion.lateral_creepage) +
                                           std::abs(scene.motion.spin) * a);
      double                 steepest = 0., of_speed = 0.; // largest -f'(s) and -s f'(s)
      constexpr unsigned int n = 400;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double s = fastest * (i + 0.5) / n, step = 0.5 * fastest / n,
                       slope = (law.coefficient(s - step) - law.coefficient(s + step)) / (2. * step);
          steepest           = std::max(steepest, slope);
          of_speed           = std::max(of_speed, s * slope);
        }
      if (pressure * steepest <= impedance)
        return 0.;
      // Slip that a memory d delays is steady where the stiffness k of the bodies against it exceeds
      // s (p |f'| - impedance) / d (linear stability of a slider whose friction follows its slip over a
      // distance). The softest waves of a patch have k = G / a. Found to be enough for partial slip and for
      // sliding.
      return memory_room * pressure * of_speed * a / shear;
    }
  } // namespace


  void check_friction_by_temperature(const Scene &scene)
  {
    if (scene.contact.temperatures.empty())
      return;
    const std::string name = "'Contact/Friction temperatures (C)' needs ";
    require(scene.damage.record, name + "'Damage/Record' true, which finds the temperatures");
    require(!scene.damage.wheel_share,
            name +
              "'Damage/Heat share of the wheel' automatic, with which both surfaces have one temperature");
    require(friction_law(scene)->is_constant(),
            name + "'Contact/Friction law' Coulomb: slip and heat would make friction fall twice");
    const double largest =
      scene.contact.friction_coefficient *
      *std::max_element(scene.contact.temperature_factors.begin(), scene.contact.temperature_factors.end());
    constexpr double most = 2.; // as of the coefficient itself
    require(largest <= most, "'Contact/Friction temperature factors' make the friction coefficient " +
                               text_of(largest) + "; at most " + text_of(most) + " is allowed");
  }


  std::string short_memory(const Scene &scene)
  {
    const auto   law    = friction_law(scene);
    const double needed = law->is_constant() ? 0. : needed_memory(scene, *law);
    if (law->memory().distance >= needed * least_room / memory_room)
      return "";
    return format(
      "'Contact/Friction memory (mm)' %g lets slip oscillate by itself, which takes friction away: "
      "'automatic' takes %.2g, and half-space theory beside has the same",
      1e3 * law->memory().distance, 1e3 * needed);
  }


  std::shared_ptr<const FrictionLaw> friction_law(const Scene &scene)
  {
    const Section section(scene.parameters().table(), "Contact");
    try
      {
        const auto law = make_friction_law(scene.contact.friction_law, scene.contact.friction_coefficient,
                                           scene.parameters().table().handler());
        if (law->memory().distance >= 0.)
          return law;
        return std::make_shared<RememberingFriction>(
          law, FrictionLaw::Memory{needed_memory(scene, *law), law->memory().speed});
      }
    catch (const std::invalid_argument &error)
      {
        throw InputError(error.what());
      }
  }


  double mean_factor_across(const Scene &scene)
  {
    double sum = 0., weights = 0.;
    for (const auto &[y, weight] : scene.stance().loaded_lines())
      {
        sum += weight * scene.stance().factor_across(Vector3{0., y, 0., 0.});
        weights += weight;
      }
    return weights > 0. ? sum / weights : 1.;
  }


  DamageIndices indices_of_damage(const Scene &scene)
  {
    const Section section(scene.parameters().table(), "Damage");
    DamageIndices indices;
    for (const DamageIndexEntry &entry : damage_indices())
      if (auto index = entry.make(scene.parameters().table().handler()))
        indices.emplace_back(entry.key, std::move(index));
    return indices;
  }


  std::shared_ptr<const WearLaw> wear_law(const Scene &scene)
  {
    const Section section(scene.parameters().table(), "Damage");
    return entry_named(wear_laws(), scene.damage.wear_law, "wear law")
      .make(scene.parameters().table().handler());
  }


  double shear_strength(const Scene &scene)
  {
    return scene.damage.shear_strength > 0. ? scene.damage.shear_strength
                                            : scene.rail.material.yield_stress / std::sqrt(3.);
  }
} // namespace tread
