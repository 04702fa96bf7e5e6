// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_material_h
#define tread_scene_sections_material_h

#include <tread/base/section.h>
#include <tread/material/elastic.h>
#include <tread/material/plastic.h>

namespace tread
{
  enum class Hardening
  {
    isotropic,
    kinematic,
    armstrong_frederick
  };

  template <>
  const std::vector<Choice<Hardening>> &choices();

  /// The part of the sections `Wheel` and `Rail` that says what a body is made of.
  struct MaterialSection
  {
    double              young_modulus     = 210e9; ///< Pa
    double              poisson_ratio     = 0.3;
    double              density           = 7800.; ///< kg/m^3
    double              yield_stress      = 0.;    ///< Pa; 0: elastic
    double              tangent_modulus   = 21e9;  ///< of bi-linear hardening, Pa
    Hardening           hardening         = Hardening::isotropic;
    std::vector<double> backstress_moduli = {60e9}, backstress_recoveries = {300.}; ///< Pa; no unit
    double              plastic_depth = 8e-3, plastic_half_width = 10e-3; ///< of the cells that yield, m
    std::string         plastic_zones;
    static constexpr const char *form_of_zones =
      "begin:end:depth:yield stress:tangent modulus, in mm, MPa and GPa";

    /// A part of the plastic zone that differs from the rest: m and Pa.
    struct Zone
    {
      double begin, end, depth, yield_stress, tangent_modulus;
    };
    /// @param section of the body, for what is said of it. @throws InputError
    std::vector<Zone> zones(const std::string &section) const;

    ElasticMaterial elastic() const
    {
      return {young_modulus, poisson_ratio, density};
    }
    /// With a yield stress and a tangent modulus (Pa) of its own.
    PlasticMaterial plastic(const double yield, const double tangent) const;

    void declare(Section &section);
    /// How far the mesh of the body reaches from its surface, from its middle and along the path, m.
    struct Meshed
    {
      double thickness, half_width, begin, end;
    };
    /// @param section that it is part of, for messages. @throws InputError
    void check(const std::string &section, const Meshed &meshed) const;
  };
} // namespace tread

#endif
