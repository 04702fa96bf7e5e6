// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/material.h>

#include <deal.II/base/utilities.h>

namespace tread
{
  template <>
  const std::vector<Choice<Hardening>> &choices()
  {
    static const std::vector<Choice<Hardening>> list{
      {Hardening::isotropic, "isotropic", "the yield surface grows; it shakes down."},
      {Hardening::kinematic, "kinematic", "it moves, in a straight line."},
      {Hardening::armstrong_frederick, "Armstrong-Frederick",
       "it moves and saturates, by one to three backstresses; it ratchets."}};
    return list;
  }


  void MaterialSection::declare(Section &section)
  {
    constexpr double  tiny = 1e-12; // for "above 0"
    const std::string zone = AnyText::number() + "(:" + AnyText::number() + "){4}";
    const Need        yields =
      Need(section.path("Yield stress (MPa)"), {}, "above 0").or_has(section.path("Plastic zones"), {});
    const Need by_a_modulus(section.path("Hardening"), {"isotropic", "kinematic"});
    const Need by_backstresses =
      Need(section.path("Hardening"), {"Armstrong-Frederick"}, "Armstrong-Frederick, with a yield stress")
        .and_has(section.path("Yield stress (MPa)"), {})
        .or_has(section.path("Plastic zones"), {});

    section.add("Young's modulus (GPa)", young_modulus, "Young's modulus.", Number(1e-3, 1e4));
    section.add("Poisson's ratio", poisson_ratio, "Poisson's ratio, from 0 to 0.49.", Number(0., 0.49));
    section.add("Density (kg per m3)", density, "Density, which gives the cells their inertia.",
                Number(1., 1e5));
    section.add(
      "Yield stress (MPa)", yield_stress,
      "Von Mises stress at which the material first yields. 0: elastic. The static load may well exceed it.",
      Number(0.));
    section.needs(yields)
      .needs(by_a_modulus)
      .add("Tangent modulus (GPa)", tangent_modulus,
           "Slope of the uniaxial stress over strain beyond yield, for isotropic and kinematic "
           "hardening. From 0 "
           "to below Young's modulus.",
           Number(0.));
    section.needs(yields).choose("Hardening", hardening);
    section.needs(by_backstresses)
      .add("Backstress moduli (GPa)", backstress_moduli,
           "For Armstrong-Frederick hardening: modulus C of each backstress, separated by commas, in da "
           "= 2/3 C de - gamma a dp.",
           Number(0.), PlasticMaterial::max_backstresses);
    section.needs(by_backstresses)
      .add("Backstress recoveries", backstress_recoveries,
           "For Armstrong-Frederick hardening: recovery gamma of each backstress, without a unit; the "
           "backstress saturates at C/gamma.",
           Number(0.), PlasticMaterial::max_backstresses);
    section.needs(yields).add(
      "Plastic depth (mm)", plastic_depth,
      "Depth under the contact path down to which cells can yield; those below stay elastic and "
      "cost less. One patch length is enough.",
      Number(tiny));
    section.needs(yields).add(
      "Plastic half width (mm)", plastic_half_width,
      "Distance from the middle of the path, to both sides, within which cells can yield.", Number(tiny));
    section.add(
      "Plastic zones", plastic_zones,
      "Parts with another yield stress, such as a weld or a hardened layer: begin and end along the path "
      "(mm; of the wheel along the tread, from where it touches at the start), depth (mm), yield stress "
      "(MPa), tangent modulus (GPa), separated by colons, as in -30:-20:8:400:21. Several: separated by "
      "commas; where they overlap the last counts.",
      AnyText(form_of_zones, "^(" + zone + "(," + zone + ")*,?)?\\s*$"));
  }


  PlasticMaterial MaterialSection::plastic(const double yield, const double tangent) const
  {
    PlasticMaterial material;
    material.yield_stress = yield;
    if (yield == 0.)
      return material;
    if (hardening == Hardening::armstrong_frederick)
      {
        for (std::size_t i = 0; i < backstress_moduli.size(); ++i)
          material.backstresses.push_back({backstress_moduli[i], backstress_recoveries[i]});
        return material;
      }
    const double modulus = hardening_modulus(young_modulus, tangent);
    if (hardening == Hardening::isotropic)
      material.isotropic_modulus = modulus;
    else
      material.backstresses = {{modulus, 0.}};
    return material;
  }


  std::vector<MaterialSection::Zone> MaterialSection::zones(const std::string &section) const
  {
    std::vector<Zone> list;
    for (const std::string &text : dealii::Utilities::split_string_list(plastic_zones))
      {
        const std::vector<std::string> parts = dealii::Utilities::split_string_list(text, ':');
        std::vector<double>            values;
        try
          {
            values = dealii::Utilities::string_to_double(parts);
          }
        catch (const dealii::ExceptionBase &)
          {
            values.clear();
          }
        require(values.size() == 5,
                "'" + section + "/Plastic zones' cannot be '" + text + "'; allowed: " + form_of_zones);
        list.push_back(
          {1e-3 * values[0], 1e-3 * values[1], 1e-3 * values[2], 1e6 * values[3], 1e9 * values[4]});
      }
    return list;
  }


  void MaterialSection::check(const std::string &section, const Meshed &meshed) const
  {
    const auto require = [&](const bool holds, const std::string &name, const std::string &rest) {
      tread::require(holds, "'" + section + "/" + name + "' " + rest);
    };
    const auto in_GPa = [](const double modulus) {
      return text_of(1e-9 * modulus);
    };
    if (plastic_zones.empty() && yield_stress == 0.)
      return;
    // Of metals; what is beyond is in another unit.
    constexpr double least_yield = 1e7, largest_yield = 1e10; // Pa
    const auto       is_of_metal = [](const double yield) {
      return yield >= least_yield && yield <= largest_yield;
    };
    const std::string metals = text_of(1e-6 * least_yield) + " to " + text_of(1e-6 * largest_yield) + " MPa";
    require(yield_stress == 0. || is_of_metal(yield_stress), "Yield stress (MPa)",
            text_of(1e-6 * yield_stress) + " is that of no metal, " + metals + "; is it in Pa or GPa?");
    const bool bilinear = hardening != Hardening::armstrong_frederick;
    const auto below    = [&](const double tangent) {
      return !bilinear || (tangent >= 0. && tangent < young_modulus);
    };
    require(below(tangent_modulus), "Tangent modulus (GPa)",
            in_GPa(tangent_modulus) + " must be below Young's modulus, " + in_GPa(young_modulus));
    require(bilinear || backstress_moduli.size() == backstress_recoveries.size(), "Backstress moduli (GPa)",
            "has not as many entries as '" + section + "/Backstress recoveries'");
    require(plastic_depth <= meshed.thickness, "Plastic depth (mm)",
            text_in_mm(plastic_depth) + " leaves the mesh; at most " + text_in_mm(meshed.thickness));
    require(plastic_half_width <= meshed.half_width, "Plastic half width (mm)",
            text_in_mm(plastic_half_width) + " leaves the mesh; at most " + text_in_mm(meshed.half_width));
    for (const Zone &zone : zones(section))
      {
        const std::string name = "Plastic zones";
        require(meshed.begin <= zone.begin && zone.begin < zone.end && zone.end <= meshed.end, name,
                "from " + text_in_mm(zone.begin) + " to " + text_in_mm(zone.end) +
                  " mm leaves the mesh, which is from " + text_in_mm(meshed.begin) + " to " +
                  text_in_mm(meshed.end) + " mm");
        require(zone.depth > 0. && zone.depth <= meshed.thickness, name,
                "of depth " + text_in_mm(zone.depth) + " mm leaves the mesh; above 0 and at most " +
                  text_in_mm(meshed.thickness));
        require(zone.yield_stress > 0., name,
                "with yield stress " + text_of(1e-6 * zone.yield_stress) + " MPa: must be above 0");
        require(is_of_metal(zone.yield_stress), name,
                "with yield stress " + text_of(1e-6 * zone.yield_stress) + " MPa: that of no metal, " +
                  metals);
        require(below(zone.tangent_modulus), name,
                "with tangent modulus " + in_GPa(zone.tangent_modulus) +
                  " GPa: must be below Young's modulus, " + in_GPa(young_modulus));
      }
  }
} // namespace tread
