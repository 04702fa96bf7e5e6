// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/mesh.h>

namespace tread
{
  template <>
  const std::vector<Choice<WindowUse>> &choices()
  {
    static const std::vector<Choice<WindowUse>> list{
      {WindowUse::automatic, "automatic",
       "so on supports under a round wheel, where the way is as long as four windows and nothing needs a "
       "mesh that stays."},
      {WindowUse::always, "true", "always."},
      {WindowUse::never, "false", "cells are fine along the whole path."}};
    return list;
  }


  void MeshSection::declare(ParameterTable &table)
  {
    Section    section(table, "Mesh");
    const auto with_window =
      Need::of_fact("Mesh/Window", "true, or automatic on a way that is long enough", "window");

    section.add("Finest cell (mm)", finest_cell,
                "Edge of the cells under the contact path. Cost grows like its inverse cube or faster; the "
                "pressure's error shrinks in proportion to it, or a little faster.",
                Number(0.02, 20.));
    section.add(
      "Fine half width (mm)", fine_half_width,
      "Half width of the zone of finest cells, from the middle of the patch; contact must stay "
      "inside. 0: as wide as the patch under the static load needs, and 1.35 times as wide where the "
      "load may double: in a scene that is not quasi-static or, where 'Wheelset' has a position, over "
      "a defect.",
      Number(0., 500.));
    section.add("Fine layers", fine_layers,
                "Number of layers of finest cells under the surface; even numbers fit the octree.",
                WholeNumber(1, 64));
    section.add("Cells per level", cells_per_level,
                "Least number of cells of each larger size before the size doubles again.", Number(1., 32.));
    section.add("Level depth (semi-axes)", level_depth,
                "Least thickness of the layers of larger cells below the finest ones, over Hertz's mean "
                "semi-axis: of cells of twice the size, four times the size, and so on. So the error of the "
                "graded mesh shrinks with the finest cell; with 0, where 'Cells per level' alone counts, "
                "bodies are about 1 % too stiff at any finest cell, and cells below 0.7 mm are fewer.",
                Number(0., 10.));
    section.add(
      "Coarsest cell (mm)", coarsest_cell,
      "Upper bound of the coarse blocks' edges, not below the finest cell; a rail head, being curved, "
      "takes 12.5 mm if that is less.",
      Number(0.1, 500.));
    section.add(
      "Fine from (mm)", fine_from,
      "From here to 'Fine to', counted from the leading edge of the defect ('Defect/Position'), cells under "
      "the path are cubes; elsewhere they are as long as 'Path cell' says. Both 0: the whole path.",
      Number(-1e5, 1e5));
    section.add("Fine to (mm)", fine_to, "End of that range; see 'Fine from (mm)'.", Number(-1e5, 1e5));
    section.add("Path cell (mm)", path_cell,
                "Largest length along the path of cells outside 'Fine from' to 'Fine to'; from twice the "
                "finest cell on they are as many levels of the octree coarser. Saves cells and time steps "
                "where the wheel only has to arrive, but the contact force ripples as it rolls over "
                "large cells: at most half a semi-axis. 0: the finest cell.",
                Number(0., 100.));
    section.needs({"Rail/Shape", {"full section"}})
      .add("Longest row (mm)", longest_row,
           "Largest length of the coarse cells of a full section beside the path.", Number(1., 1000.));
    section.choose(
      "Window", window,
      "Keep cells fine only about the wheel: when it has rolled 'Window length', the run goes on with a "
      "mesh whose fine cells are further on, on rail and wheel. Cost then grows with the way alone. "
      "Energy that fine cells had and others do not carry is the ledger's window loss.",
      "The summary's 'windows' says how often it stood somewhere.");
    section.needs(with_window)
      .add(
        "Window length (mm)", window_length,
        "Way between two changes, at most. 0: about 2.5 semi-axes of the patch, 12 on supports, and "
        "longer by the fourth root of 'Scene/Density scale'. The mesh also changes just before the cubes of "
        "'Fine from (mm)' come and when those of 'Fine to (mm)' have gone, unless that is nearer to another "
        "change, or to an end of the way, than a third of this.",
        Number(0., 1e5));
    section.needs(with_window)
      .add("Window margin (mm)", window_margin,
           "Length of the finest cells before and behind the wheel at a change. 0: 1.75 semi-axes and two "
           "cells.",
           Number(0., 1e4));
  }


  void MeshSection::check() const
  {
    require(coarsest_cell >= finest_cell, "'Mesh/Coarsest cell (mm)' " + text_in_mm(coarsest_cell) +
                                            " must be at least 'Mesh/Finest cell (mm)' " +
                                            text_in_mm(finest_cell));
    require(fine_from <= fine_to, "'Mesh/Fine from (mm)' must be below 'Mesh/Fine to (mm)'");
    require(path_cell == 0. || path_cell >= finest_cell, "'Mesh/Path cell (mm)' " + text_in_mm(path_cell) +
                                                           " must be at least 'Mesh/Finest cell (mm)' " +
                                                           text_in_mm(finest_cell) + ", or 0 for the same");
    require(path_cell <= finest_cell || fine_from < fine_to,
            "'Mesh/Path cell (mm)' needs 'Mesh/Fine from (mm)' and 'Fine to (mm)'");
  }
} // namespace tread
