// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/solid.h>

namespace tread
{
  void SolidSection::declare(ParameterTable &table)
  {
    Section section(table, "Solid");

    section.choose("Element", element, elements());
    std::vector<std::string> with_hourglass_modes;
    for (const ElementEntry &entry : elements())
      if (entry.has_hourglass_modes)
        with_hourglass_modes.push_back(entry.name);
    section.needs({"Solid/Element", with_hourglass_modes})
      .add("Hourglass coefficient", hourglass_coefficient,
           "Stiffness of the hourglass modes; 1 gives a cube the stiffness of pure bending.",
           Number(0.01, 10.));
    section.add(
      "Matched surface", matched_surface,
      "Whether the hourglass stiffness of the uppermost layer of one-point cells is weighted so that "
      "the surface has the tangential stiffness that belongs to its normal one. Without it a mesh "
      "acts as if the surface shear stress began a tenth of a cell ahead of the pressure. It acts on "
      "cells near the contact.");
    section.add(
      "Surface damping (time steps)", surface_damping,
      "Damping of the hourglass modes that 'Matched surface' softens, in directions of the surface, "
      "over their unweighted stiffness. 0 lets the micro-slip of coarse cells chatter; larger values "
      "shorten the stable time step, of cubes above 1.6, of other cells and with a larger 'Hourglass "
      "coefficient' "
      "sooner.",
      Number(0., 10.));
    section.add(
      "Stiffness damping (time steps)", stiffness_damping,
      "Internal forces are taken at x + beta v, beta in time steps. 0.1 removes grid-frequency chatter of "
      "the "
      "micro-slip and nothing else that can be seen; larger values shorten the stable time step.",
      Number(0., 10.));
    section.add("Mass damping (1 per s)", mass_damping,
                "Damping of motion relative to the rigid bodies: a wave fades by half in 1.4 over this. It "
                "removes oscillations that the start excites; only for quasi-static scenes.",
                Number(0., 1e6));
    section.add("Linear bulk viscosity", linear_bulk_viscosity,
                "Damps ringing behind wave fronts; 0.06 is usual for impact.", Number(0., 10.));
    section.add("Quadratic bulk viscosity", quadratic_bulk_viscosity,
                "Damps compression only; 1.2 is usual for impact.", Number(0., 10.));
  }


  void SolidSection::check() const
  {
    require(element_named(element).has_bulk_viscosity || !has_bulk_viscosity(),
            "'Solid/Linear bulk viscosity' and 'Solid/Quadratic bulk viscosity' must be 0 with "
            "'Solid/Element' " +
              element);
  }
} // namespace tread
