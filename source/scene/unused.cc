// SPDX-License-Identifier: LGPL-2.1-or-later
// Parameters that a scene sets and that another one of its parameters leaves without effect.
#include <tread/scene/fine_cells.h>
#include <tread/scene/scene.h>
#include <tread/scene/surface_laws.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace tread
{
  namespace
  {
    /// Whether what a parameter needs and no other one says by its value is so. @see Need::of_fact()
    bool is_true(const Scene &scene, const std::string &fact)
    {
      const MotionSection &motion = scene.motion;
      if (fact == "scan")
        return scene.wheel.has_scan();
      if (fact == "window")
        return has_window(scene);
      if (fact == "memory of friction")
        return friction_law(scene)->memory().distance > 0.;
      if (fact == "traction")
        return !(motion.creepage || motion.angular_velocity) ||
               (motion.creepage == 0. && motion.traction_coefficient == 0.); // free rolling, said twice
      throw std::logic_error("a parameter needs '" + fact + "', of which nothing is known");
    }

    /// Tables along the path of which none lies on it, one line each.
    std::vector<std::string> tables_beside_the_path(const Scene &scene)
    {
      std::vector<std::string> lines;
      // More than any patch is long.
      constexpr double room = 0.05, largest_pressure = 5e9, least_pressure = 1e7; // m, Pa
      const double     from = scene.path_begin(scene.last_wheel()) - room, to = scene.meshed_end() + room;
      const auto       beside = [&](const double begin, const double end) {
        return end < from || begin > to;
      };
      if (const auto &places = scene.contact.friction_places;
          !places.empty() && beside(places.front(), places.back()))
        lines.push_back("'Contact/Friction places (mm)' all lie beside the path, from " +
                        text_in_mm(scene.path_begin(scene.last_wheel())) + " to " +
                        text_in_mm(scene.meshed_end()) + " mm: the friction factor is " +
                        text_of(scene.contact.friction_factor(scene.path_begin())) + " on all of it");
      if (const auto &places = scene.contact.across_places; !places.empty() && !scene.is_positioned())
        if (const PatchExtent &patch = scene.shapes().patch;
            places.front() > patch.end || places.back() < patch.begin)
          lines.push_back("'Contact/Friction across (mm)' all lie beside the patch, from " +
                          text_in_mm(patch.begin) + " to " + text_in_mm(patch.end) +
                          " mm: the factor is the same on all of it");
      if (const auto &pressures = scene.contact.friction_pressures;
          !pressures.empty() && (pressures.front() > largest_pressure || pressures.back() < least_pressure))
        lines.push_back("'Contact/Friction pressures (MPa)', from " + text_of(1e-6 * pressures.front()) +
                        " to " + text_of(1e-6 * pressures.back()) +
                        ", are those of no wheel on a rail: the factor is the same at all of its pressures");
      for (const MaterialSection::Zone &zone : scene.rail.material.zones("Rail"))
        if (beside(zone.begin, zone.end))
          lines.push_back("'Rail/Plastic zones' from " + text_in_mm(zone.begin) + " to " +
                          text_in_mm(zone.end) + " mm has no effect: it lies beside the path");
      return lines;
    }
  } // namespace


  std::vector<std::string> Scene::unused_parameters() const
  {
    const ParameterTable    &table = input.table();
    std::vector<std::string> unused;
    for (const auto &[path, value, is_given] : input.changed_values())
      if (const Need *const need = table.unmet_need(
            *table.find(path), [this](const std::string &fact) { return is_true(*this, fact); }))
        unused.push_back("'" + path + "' has no effect: it needs " + need->in_words());
    for (const std::string &line : tables_beside_the_path(*this))
      unused.push_back(line);
    return unused;
  }
} // namespace tread
