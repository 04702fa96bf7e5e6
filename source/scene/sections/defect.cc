// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/registry.h>
#include <tread/geometry/height_map.h>
#include <tread/geometry/measured_line.h>
#include <tread/scene/sections/defect.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread
{
  namespace
  {
    constexpr double deepest = 10e-3; // m

    std::shared_ptr<Defect> make_dip(const DefectSection &section, const std::string &)
    {
      const double length = section.length;
      require(length > 0. && section.depth > 0.,
              "a dip needs 'Defect/Length (mm)' and 'Defect/Depth (mm)' above 0");
      require(!section.reversed,
              "'Defect/Reversed' is for 'Defect/Shape' profile and map; a dip is rolled over from its other "
              "end with its rounded edges exchanged");
      require(std::max(section.leading_rounding, section.trailing_rounding) <= 0.5 * length,
              "'Defect/Rounded leading edge (mm)' and 'Rounded trailing edge (mm)' must be at most half of "
              "'Defect/Length (mm)', " +
                text_in_mm(0.5 * length));
      auto defect    = std::make_shared<Defect>();
      defect->length = length;
      defect->width  = section.width > 0. ? section.width : length;
      defect->shape  = dip(section.leading_rounding / length, section.trailing_rounding / length);
      return defect;
    }


    /// Alike across the whole head, or as the lateral law says. @param shape in words
    void set_width(Defect &defect, const DefectSection &section, const std::string &shape)
    {
      const bool uniform = section.lateral_law == LateralLaw::uniform;
      require(uniform || section.width > 0.,
              "'Defect/Width (mm)' must be above 0 for a " + shape + " with 'Lateral law' parabola");
      defect.width = uniform ? std::numeric_limits<double>::infinity() : section.width;
      if (!uniform)
        defect.shape = with_parabola(defect.shape);
    }

    /// Give a defect its length and its ramps, and the depth that is left of its own.
    void set_length(Defect &defect, const DefectSection &section)
    {
      if (section.length > 0.)
        defect.length = section.length;
      if (section.ramp == 0.)
        return;
      require(section.ramp <= 0.5 * defect.length, "'Defect/Ramp (mm)' " + text_in_mm(section.ramp) +
                                                     " must be at most half of its length, " +
                                                     text_in_mm(0.5 * defect.length));
      const auto whole            = with_ramps(defect.shape, section.ramp / defect.length);
      const auto [least, largest] = extremes_of(whole);
      const double left           = std::max(-least, largest);
      require(left > 0., "'Defect/Ramp (mm)' " + text_in_mm(section.ramp) + " leaves nothing of the defect");
      defect.depth *= left;
      defect.shape = [whole, left](const double u, const double v) {
        return whole(u, v) / left;
      };
    }

    std::shared_ptr<Defect> make_corrugation(const DefectSection &section, const std::string &)
    {
      require(section.wavelength > 0. && section.length >= section.wavelength && section.depth > 0.,
              "corrugation needs 'Defect/Wavelength (mm)' and 'Defect/Depth (mm)' above 0 and 'Defect/Length "
              "(mm)' of at least a wavelength");
      const double waves = section.length / section.wavelength;
      require(section.ramp > 0. || std::abs(waves - std::round(waves)) < 1e-6,
              "'Defect/Length (mm)' is " + text_of(waves) +
                " wavelengths, so that the corrugation ends in a step: make it a whole number, or give "
                "'Defect/Ramp (mm)'");
      auto defect   = std::make_shared<Defect>();
      defect->shape = corrugation(section.wavelength / section.length);
      set_width(*defect, section, "corrugation");
      set_length(*defect, section);
      return defect;
    }


    std::shared_ptr<Defect> make_profile(const DefectSection &section, const std::string &file)
    {
      require(!section.profile_file.empty(), "'Defect/Shape' profile needs 'Defect/Profile file'");
      auto defect = std::make_shared<Defect>();
      try
        {
          *defect = defect_along(read_longitudinal_profile(file),
                                 section.ramp > 0. ? LineDatum::fitted : LineDatum::chord, section.reversed);
        }
      catch (const std::runtime_error &error)
        {
          throw InputError("'Defect/Profile file': " + std::string(error.what()));
        }
      set_width(*defect, section, "profile");
      set_length(*defect, section);
      return defect;
    }


    std::shared_ptr<Defect> make_map(const DefectSection &section, const std::string &file)
    {
      require(!section.profile_file.empty(), "'Defect/Shape' map needs 'Defect/Profile file'");
      const auto map = [&] {
        try
          {
            return std::make_shared<const HeightMap>(file);
          }
        catch (const InputError &error)
          {
            throw InputError("'Defect/Profile file': " + std::string(error.what()));
          }
      }();
      const double largest = std::max(-map->lowest(), map->highest());
      require(largest > 0., "'Defect/Profile file': all heights are 0");
      // Beside the map the surface is the nominal one.
      constexpr double step_allowed = 0.05;
      const double     on_border =
        std::max(map->largest_on_sides(), section.ramp > 0. ? 0. : map->largest_on_ends());
      require(
        on_border <= step_allowed * largest,
        "'Defect/Profile file': the border of the map is up to " + text_in_mm(on_border) +
          " mm off the nominal surface, which follows it: a step. Take the plane of the border away, or "
          "let the heights fade to 0, at its ends by 'Defect/Ramp (mm)'; at most " +
          text_in_mm(step_allowed * largest) + " mm are allowed");
      auto defect      = std::make_shared<Defect>();
      defect->length   = map->x_end() - map->x_begin();
      defect->width    = section.width > 0. ? section.width : map->y_end() - map->y_begin();
      defect->y_middle = 0.5 * (map->y_begin() + map->y_end());
      defect->depth    = largest;
      defect->shape    = [map, largest, reversed = section.reversed](const double u, const double v) {
        if (u <= 0. || u >= 1. || std::abs(v) >= 1.)
          return 0.;
        const double along = reversed ? 1. - u : u, across = 0.5 * (v + 1.);
        return -map->height(map->x_begin() + along * (map->x_end() - map->x_begin()),
                               map->y_begin() + across * (map->y_end() - map->y_begin())) /
               largest;
      };
      set_length(*defect, section);
      return defect;
    }
  } // namespace


  const std::vector<DefectShape> &defect_shapes()
  {
    static const std::vector<DefectShape> list{
      {"none", "smooth",
       [](const DefectSection &, const std::string &) {
         return std::shared_ptr<Defect>();
       }},
      {"dip", "of Length, Width and Depth, a sphere's cap where length and width are equal", make_dip},
      {"profile", "along the path as in Profile file, across as Lateral law says", make_profile},
      {"corrugation", "waves of Wavelength and Depth along the path, across as Lateral law says",
       make_corrugation},
      {"map", "heights over the rail's surface, along and across, as in Profile file", make_map}};
    return list;
  }


  template <>
  const std::vector<Choice<LateralLaw>> &choices()
  {
    static const std::vector<Choice<LateralLaw>> list{
      {LateralLaw::parabola, "parabola", "1 - (2 y / Width)^2 of the depth."},
      {LateralLaw::uniform, "uniform", "the whole head, as at a weld."}};
    return list;
  }


  void DefectSection::declare(ParameterTable &table)
  {
    Section section(table, "Defect");

    section.choose("Shape", shape, defect_shapes());
    std::vector<std::string> any;
    for (const DefectShape &entry : defect_shapes())
      if (entry.name != "none")
        any.push_back(entry.name);
    const Need is_there("Defect/Shape", any), a_dip("Defect/Shape", {"dip"}),
      of_file("Defect/Shape", {"profile", "map"});
    // Without a defect they say where the region of the largest stresses lies.
    const Need region = Need(is_there).or_else({"Peak stress/Region", {"trailing edge"}}),
               across = Need("Defect/Lateral law", {"parabola"}).or_else({"Defect/Shape", {"dip", "map"}});
    section
      .needs(Need(region)
               .or_else({"Mesh/Fine from (mm)", {}, "other than 0"})
               .or_else({"Mesh/Fine to (mm)", {}, "other than 0"}))
      .add("Position (mm)", position,
           "x of the leading edge of the defect. 'Motion/Start' and 'Rolled distance' say where the "
           "wheel starts and ends.",
           Number(-1e5, 1e5));
    section.add(
      "Length (mm)", length,
      "Length of the defect along the rail. A profile or a map is stretched to it; 0: as in the file. In a "
      "scene without one that of the defect whose smooth twin it is, with the same mesh and start.",
      Number(0., 1e4));
    section.needs(region).needs(across).add(
      "Width (mm)", width,
      "Width of the defect across the rail. 0: a dip is as wide as it is long, a map as in its file.",
      Number(0., 200.));
    section.all_need({is_there});
    section.add("Depth (mm)", depth,
                "Depth of the deepest point; of corrugation, from crests to troughs. A profile or a map is "
                "scaled to it; 0: as in the file.",
                Number(0., 1e3 * deepest));
    section.needs(across).add("Lateral position (mm)", lateral_position,
                              "y of the middle of the defect, along the rail's top; the gauge side is y < 0.",
                              Number(-50., 50.));
    section.needs(a_dip).add(
      "Rounded leading edge (mm)", leading_rounding,
      "Length over which the kink at the beginning of a dip is rounded. 0: a sharp edge.", Number(0., 1000.));
    section.needs(a_dip).add("Rounded trailing edge (mm)", trailing_rounding,
                             "Length over which the kink at the end of a dip is rounded. 0: a sharp edge.",
                             Number(0., 1000.));
    section.needs({"Defect/Shape", {"corrugation"}})
      .add("Wavelength (mm)", wavelength, "Wavelength of corrugation.", Number(0., 1000.));
    section.needs({"Defect/Shape", {"profile", "corrugation", "map"}})
      .add("Ramp (mm)", ramp,
           "Length over which the heights of a profile, a map or corrugation grow from 0 at the "
           "beginning and fade to 0 at the end. 0: none.",
           Number(0., 1e4));
    section.needs(of_file).add(
      "Profile file", profile_file,
      "Of a profile: columns x and z in mm, z up; depth is counted from the straight line between the ends, "
      "with a Ramp from the one that fits best. Of a map: a table with a row of names, x_mm, y_mm and z_mm, "
      "separated by commas, on a grid with equal spacings, or a file of HDF5 (.h5) with datasets x_mm (n_x), "
      "y_mm (n_y), z_mm (n_y, n_x); z is the height over the surface without the defect, y is counted from "
      "the middle of the rail's top, the first x lies at Position. Looked for in the present folder and "
      "beside the parameter file.",
      AnyText());
    section.needs({"Defect/Shape", {"profile", "corrugation"}})
      .choose("Lateral law", lateral_law, "Of a profile or corrugation.");
    section.needs(of_file).add("Reversed", reversed,
                               "true: a profile or a map is rolled over from its other end.");
    section.add("Repeated at (mm)", repeated_at,
                "x of the leading edges of further defects of the same shape, separated by commas, at least "
                "the defect's length apart. Defects that differ fit into one map.",
                Number(-1e5, 1e5), 1000);
  }


  std::shared_ptr<const Defect> DefectSection::make(const std::string &file) const
  {
    const std::shared_ptr<Defect> defect =
      entry_named(defect_shapes(), shape, "defect shape").make(*this, file);
    if (!defect)
      return nullptr;
    if (shape == "profile" || shape == "map")
      {
        // Nothing that is measured is so short or so shallow.
        constexpr double shortest = 1e-3, shallowest = 0.5e-6; // m
        require(length > 0. || defect->length >= shortest,
                "'Defect/Profile file': " + text_in_mm(defect->length) +
                  " mm long; are its lengths in m? They must be in mm");
        require(depth > 0. || defect->depth >= shallowest,
                "'Defect/Profile file': " + text_of(1e6 * defect->depth) +
                  " um deep; are its heights in m? They must be in mm");
      }
    if (depth > 0.)
      defect->depth = depth;
    require(defect->depth <= deepest, "'Defect/Profile file': " + text_in_mm(defect->depth) +
                                        " mm deep, where at most " + text_in_mm(deepest) +
                                        " mm are allowed; heights in it are in mm, not in um");
    defect->begin       = position;
    defect->repeated_at = repeated_at;
    defect->y_middle += lateral_position;
    return defect;
  }
} // namespace tread
