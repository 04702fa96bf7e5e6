// SPDX-License-Identifier: LGPL-2.1-or-later
// Parameters that a scene sets and that another one of its parameters leaves without effect.
#include <tread/scene/fine_cells.h>
#include <tread/scene/scene.h>
#include <tread/scene/surface_laws.h>

#include <algorithm>

namespace tread
{
  namespace
  {
    /// Parameters that count only where the scene has something.
    struct Group
    {
      std::string              section;
      std::vector<std::string> names;  ///< empty: all of the section, but for `main`
      std::string              main;   ///< what decides, in the same section or as Section/Name
      bool                     counts; ///< in this scene
      std::string              needed; ///< of the deciding parameter
    };

    bool concerns(const Group &group, const std::string &path)
    {
      const std::size_t slash = group.section.size();
      if (path.compare(0, slash + 1, group.section + "/") != 0)
        return false;
      const std::string name = path.substr(slash + 1);
      if (group.names.empty())
        return name != group.main;
      return std::find(group.names.begin(), group.names.end(), name) != group.names.end();
    }

    std::vector<Group> groups_of_steel(const std::string &body, const MaterialSection &steel)
    {
      const bool yields = steel.yield_stress > 0. || !steel.plastic_zones.empty();
      return {{body,
               {"Tangent modulus (GPa)", "Hardening", "Plastic depth (mm)", "Plastic half width (mm)"},
               "Yield stress (MPa)",
               yields,
               "above 0"},
              {body,
               {"Tangent modulus (GPa)"},
               "Hardening",
               steel.hardening != Hardening::armstrong_frederick,
               "isotropic or kinematic"},
              {body,
               {"Backstress moduli (GPa)", "Backstress recoveries"},
               "Hardening",
               yields && steel.hardening == Hardening::armstrong_frederick,
               "Armstrong-Frederick, with a yield stress"}};
    }

    /// Tables along the path of which none lies on it, one line each.
    std::vector<std::string> tables_beside_the_path(const Scene &scene, const bool positioned)
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
      if (const auto &places = scene.contact.across_places; !places.empty() && !positioned)
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
    const bool defect_of_file = defect.shape == "profile" || defect.shape == "map",
               positioned     = is_positioned();
    std::vector<Group> groups{
      {"Wheel",
       {"Rim inner radius (mm)", "Rim width (mm)", "Web thickness (mm)", "Hub outer radius (mm)",
        "Hub length (mm)", "Bore radius (mm)"},
       "Shape",
       wheel.is_full(),
       "full"},
      {"Wheel",
       {"Sector thickness (mm)", "Sector width (mm)", "Sector margin (mm)"},
       "Shape",
       !wheel.is_full() || positioned,
       "sector"},
      {"Wheel", {"Deviation pitch (deg)"}, "Deviation", !wheel.deviation.empty(), "a file or a rule"},
      {"Wheel", {"Deviation smoothing (mm)"}, "Deviation", wheel.has_scan(), "a file"},
      {"Wheelset", {}, "Lateral shift (mm)", positioned, "a number"},
      {"Guidance", {"File"}, "Kind", guidance.kind == Guidance::file, "file"},
      {"Guidance",
       {"Lateral stiffness (MN per m)", "Lateral damping (kN s per m)", "Lateral force (kN)",
        "Yaw stiffness (MN m per rad)", "Yaw damping (kN m s per rad)", "Yaw moment (kN m)"},
       "Kind",
       guidance.kind == Guidance::springs,
       "springs"},
      {"Guidance",
       {"Yaw inertia (kg m2)"},
       "Kind",
       guidance.kind == Guidance::springs || wheelset.both_wheels,
       "springs, or both wheels"},
      {"Rail",
       {"Crown radius (mm)", "Block width (mm)", "Block height (mm)"},
       "Shape",
       rail.is_block(),
       "block"},
      {"Rail", {"Slices place (mm)", "Slices y (mm)", "Slices z (mm)"}, "Shape", rail.is_sliced(), "slices"},
      {"Rail", {"Mesh unit", "Materials"}, "Shape", rail.is_meshed(), "mesh"},
      {"Rail",
       {"Begin (mm)", "Length (mm)", "Margin (mm)"},
       "Shape",
       !rail.is_meshed(),
       "head, full section, block or slices"},
      {"Rail", {"Profile"}, "Shape", !rail.is_sliced() && !rail.is_meshed(), "head or full section"},
      {"Wheelset",
       {"Track gauge (mm)", "Gauge depth (mm)"},
       "Rail/Shape",
       !positioned || !rail.is_sliced(),
       "head"},
      {"Rail",
       {"Profile", "Measured head", "Measured head mirrored", "Measured head shift (mm)", "Inclination"},
       "Shape",
       !rail.is_block(),
       "head or full section"},
      {"Mesh",
       {"Window length (mm)", "Window margin (mm)"},
       "Window",
       has_window(*this),
       "true, or automatic on a way that is long enough"},
      {"Ratcheting",
       {"Rolled between jumps", "Irregularity (%)", "Change in a jump (%)", "Strain of a jump (%)",
        "Longest jump"},
       "Jumps",
       ratcheting.jumps,
       "true"},
      {"Rail",
       {"Ends", "Absorbing length (m)"},
       "Track/Foundation",
       track.has_supports(),
       "one-layer or two-layer"},
      {"Rail",
       {"Spans beyond"},
       "Ends",
       rail.ends == EndKind::endless || track.is_beam(),
       "endless, or on a beam"},
      {"Track",
       {"Stiffness along the rail (MN per m)"},
       "Rail/Ends",
       rail.ends == EndKind::endless,
       "endless"},
      {"Defect", {}, "Shape", defect.shape != "none", "dip, profile, corrugation or map"},
      {"Defect",
       {"Rounded leading edge (mm)", "Rounded trailing edge (mm)"},
       "Shape",
       defect.shape == "dip" || defect.shape == "none",
       "dip"},
      {"Defect",
       {"Profile file", "Reversed"},
       "Shape",
       defect_of_file || defect.shape == "none",
       "profile or map"},
      {"Defect",
       {"Lateral law"},
       "Shape",
       defect.shape == "profile" || defect.shape == "corrugation" || defect.shape == "none",
       "profile or corrugation"},
      {"Defect",
       {"Wavelength (mm)"},
       "Shape",
       defect.shape == "corrugation" || defect.shape == "none",
       "corrugation"},
      {"Defect", {"Ramp (mm)"}, "Shape", defect.shape != "dip", "profile, corrugation or map"},
      {"Contact",
       {"Kinetic friction coefficient", "Falling slip speed (m per s)", "Friction memory (mm)",
        "Least speed of memory (m per s)"},
       "Friction law",
       !friction_law(*this)->is_constant(),
       "one that falls"},
      {"Contact",
       {"Least speed of memory (m per s)"},
       "Friction memory (mm)",
       friction_law(*this)->memory().distance > 0.,
       "above 0"},
      {"Vehicle", {"Sprung mass (kg)"}, "Wheel load (kN)", !vehicle.wheel_load, "masses"},
      {"Vehicle", {"Sprung mass (kg)"}, "Axle load (t)", !vehicle.axle_load, "none"},
      {"Mesh", {"Longest row (mm)"}, "Rail/Shape", rail.shape == RailShape::full_section, "full section"},
      {"Track",
       {},
       "Foundation",
       track.foundation != Foundation::rigid,
       "one-layer, two-layer, co-running or beam"},
      {"Track",
       {"Co-running mass (kg)", "Vertical stiffness (MN per m)", "Vertical damping (kN s per m)",
        "Lateral stiffness (MN per m)", "Lateral damping (kN s per m)"},
       "Foundation",
       !track.has_supports() && !track.is_beam(),
       "co-running"},
      {"Track",
       {"Beam bending stiffness (MN m2)", "Beam shear stiffness (MN)", "Beam mass (kg per m)", "Beam file"},
       "Foundation",
       track.is_beam() || track.foundation == Foundation::rigid,
       "beam"},
      {"Track",
       {"Sleeper spacing (m)", "Support 0 (mm)", "Pad stiffness (MN per m)", "Pad damping (kN s per m)",
        "Pad length (mm)", "Points along"},
       "Foundation",
       !track.runs_along(),
       "one-layer, two-layer or beam"},
      {"Track",
       {"Pads pull", "Pad width (mm)", "Points across", "Support file"},
       "Foundation",
       !track.has_moving_base(),
       "one-layer or two-layer"},
      {"Track",
       {"Sleeper mass (kg)", "Ballast stiffness (MN per m)", "Ballast damping (kN s per m)"},
       "Foundation",
       track.foundation == Foundation::two_layer || track.is_beam() || track.foundation == Foundation::rigid,
       "two-layer or beam"},
      {"Track",
       {"Sleepers"},
       "Foundation",
       track.foundation == Foundation::two_layer || track.foundation == Foundation::rigid,
       "two-layer"},
      {"Track",
       {"Sleeper length (m)", "Sleeper width (mm)", "Rail distance (mm)", "Sleeper Young's modulus (GPa)",
        "Sleeper Poisson's ratio", "Sleeper density (kg per m3)"},
       "Sleepers",
       track.has_solid_sleepers() || track.foundation == Foundation::rigid,
       "solid, on two layers"},
      {"Solid",
       {"Hourglass coefficient"},
       "Element",
       element_named(solid.element).has_hourglass_modes,
       "one-point"},
      {"Motion",
       {"Traction coefficient"},
       "Creepage",
       motion.drive == Drive::torque || !(motion.creepage || motion.angular_velocity) ||
         (motion.creepage == 0. && motion.traction_coefficient == 0.), // free rolling, said twice
       "predicted"},
      {"Further wheels",
       {"Traction coefficients"},
       "Motion/Creepage",
       motion.drive == Drive::torque || !motion.creepage,
       "predicted"},
      {"Motion", {"Hold distance (mm)"}, "Drive", motion.drive == Drive::torque, "torque"},
      {"Peak stress", {}, "Region", peak_stress.is_wanted(), "a region"},
      {"Peak stress", {"From (mm)", "To (mm)"}, "Region", peak_stress.place == PeakPlace::range, "range"},
      {"Damage",
       {"Wear law", "Wear coefficient", "Hardness (MPa)", "Map slip speeds (m per s)",
        "Map pressures over hardness", "Map wear coefficients", "Wear per work (mm3 per kJ)",
        "Thermal conductivity (W per m K)", "Heat capacity (J per kg K)", "Heat share of the wheel"},
       "Record",
       damage.record,
       "true"},
      {"Damage",
       {"Rail temperature (C)", "Wheel temperature (C)"},
       "Contact/Friction temperatures (C)",
       !contact.temperatures.empty(),
       "given"},
      {"Damage", {"Wear coefficient"}, "Wear law", damage.wear_law == "Archard", "Archard"},
      {"Damage",
       {"Hardness (MPa)"},
       "Wear law",
       damage.wear_law == "Archard" || damage.wear_law == "Archard map",
       "Archard or Archard map"},
      {"Damage",
       {"Map slip speeds (m per s)", "Map pressures over hardness", "Map wear coefficients"},
       "Wear law",
       damage.wear_law == "Archard map",
       "Archard map"},
      {"Damage",
       {"Wear per work (mm3 per kJ)"},
       "Wear law",
       damage.wear_law == "friction work",
       "friction work"},
      {"Output", {"Supports"}, "Track/Foundation", track.has_supports(), "one-layer or two-layer"},
      {"Output", {"Volume interval (mm)"}, "Write volume", output.write_volume, "true"},
    };
    for (const auto &[body, steel] :
         {std::make_pair("Wheel", &wheel.material), std::make_pair("Rail", &rail.material)})
      for (Group &group : groups_of_steel(body, *steel))
        groups.push_back(std::move(group));

    // Without a defect they say where the region lies.
    const auto places_region = [&](const std::string &path) {
      return peak_stress.place == PeakPlace::trailing_edge &&
             (path == "Defect/Length (mm)" || path == "Defect/Position (mm)" || path == "Defect/Width (mm)");
    };
    std::vector<std::string> unused;
    for (const auto &[path, value, is_given] : input.changed_values())
      for (const Group &group : groups)
        if (!group.counts && concerns(group, path) && !places_region(path))
          {
            const bool elsewhere = group.main.find('/') != std::string::npos;
            unused.push_back("'" + path + "' has no effect: it needs '" +
                             (elsewhere ? "" : group.section + "/") + group.main + "' " + group.needed);
            break;
          }
    for (const std::string &line : tables_beside_the_path(*this, positioned))
      unused.push_back(line);
    return unused;
  }
} // namespace tread
