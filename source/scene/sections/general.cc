// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/general.h>

namespace tread
{
  void GeneralSection::declare(ParameterTable &table)
  {
    Section section(table, "Scene");

    section.add("Title", title, "What the scene shows; printed and kept in the summary.");
    section.add("Quasi-static", quasi_static,
                "true: inertia is negligible in the answer, as in steady rolling: the density may be scaled, "
                "and without a defect or a track the axle settles under its load. false: inertia counts.");
    section.add(
      "Density scale", density_scale,
      "Factor on the density of the cells: the time step grows with its square root, the error of rolling "
      "inertia like (speed / wave speed)^2. 1 to 100; above 1 only for quasi-static scenes.",
      Number(1., 100.));
    section.add("Reproducible", reproducible,
                "true: all results are the same to the last bit on any number of ranks, also when a run is "
                "resumed on another number. Forces are then rounded to 1.5e-8 N, and every rank solves the "
                "whole contact instead of its share.");
  }


  void GeneralSection::check() const
  {
    require(
      density_scale == 1. || quasi_static,
      "'Scene/Density scale' must be 1 when 'Scene/Quasi-static' is false: inertia is part of the answer");
  }
} // namespace tread
