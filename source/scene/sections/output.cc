// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/output.h>

namespace tread
{
  template <>
  const std::vector<Choice<PictureFormat>> &choices()
  {
    static const std::vector<Choice<PictureFormat>> list{
      {PictureFormat::vtu, "vtu", "a file each, listed in .pvd, with the values of cells at their corners."},
      {PictureFormat::xdmf, "xdmf",
       "listed in .xdmf, with data in HDF5: smaller, values of cells as such, all of a run in "
       "volume.h5 and surface.h5 at its end."}};
    return list;
  }


  void OutputSection::declare(ParameterTable &table)
  {
    Section           section(table, "Output");
    const std::string triple = AnyText::number() + "," + AnyText::number() + "," + AnyText::number(false);

    section.add("Directory", directory, "Folder of the results; --output overrides it.");
    section.add("History interval (mm)", history_interval, "Rolled distance between rows of history.csv.",
                Number(1e-3));
    section.needs({"Track/Foundation", {"one-layer", "two-layer"}})
      .add("Supports", supports,
           "Numbers of the supports whose forces history.csv has, separated by commas; empty: those "
           "beside the path of the wheel.",
           WholeNumber(-1000, 1000), 1000);
    section.add(
      "Cells", cells,
      "Cells of the rail whose von Mises stress and equivalent plastic strain cells.csv has, a row for each "
      "of history.csv: x,y,depth in mm of a point in each, depth below the running surface, separated by "
      "semicolons, as in -20,0,1.5; -20,0,4. Empty: none.",
      AnyText(form_of_cells, "^(" + triple + "(;" + triple + ")*;?)?\\s*$"));
    section.add("Strip half width (mm)", strip_half_width,
                "Half width of the band of rail under the running wheel, to both sides of the first contact, "
                "in which strip.csv lists the largest von Mises stress that the cells have seen along the "
                "path, sampled once per History interval. 0: no table.",
                Number(0.));
    section.add("Surface interval (mm)", surface_interval,
                "Rolled distance between pictures of the contact surface, with a table of all their patches, "
                "patches.csv; 0: a picture of the solution instant only.",
                Number(0.));
    section.add(
      "Patch interval (mm)", patch_interval,
      "Rolled distance between the instants of patches.csv, with or without pictures: the table alone "
      "costs next to nothing. 0: as the pictures.",
      Number(0.));
    section.needs({"Output/Write volume", {"true"}})
      .add("Volume interval (mm)", volume_interval,
           "Rolled distance between pictures of the bodies; 0: the solution instant only.", Number(0.));
    section.add(
      "Table depth (mm)", table_depth,
      "At the solution instant rail_cells.csv lists stress and plastic strain of the rail's cells under the "
      "contact path down to this depth, and rail_surface.csv the displacement of its surface. 0: neither.",
      Number(0.));
    section.add("Write volume", write_volume, "Whether pictures of the bodies are written at all.");
    section.choose("Pictures", pictures, "Format of the pictures for ParaView.");
    section.add("Checkpoint interval (minutes)", checkpoint_interval,
                "Wall time between checkpoints, from which --resume goes on, the first one after a start of "
                "more than a minute; 0: only when "
                "interrupted.",
                Number(0.));
  }
} // namespace tread
