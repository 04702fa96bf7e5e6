// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/mesh/rail_body.h>
#include <tread/scene/sections/rail.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/predicate.hpp>

#include <cmath>
#include <stdexcept>

namespace tread
{
  template <>
  const std::vector<Choice<RailShape>> &choices()
  {
    static const std::vector<Choice<RailShape>> list{
      {RailShape::head, "head",
       "the head of a rail profile; its bottom is held, or moves with what stands for the track."},
      {RailShape::full_section, "full section", "head, web and foot, held at the foot."},
      {RailShape::block, "block", "a box with a cylindrical crown, to compare with half-space theory."},
      {RailShape::slices, "slices",
       "blocks behind the surfaces of a rail that changes along the way, on which a wheel in a position "
       "rolls; "
       "doc/crossing.md."},
      {RailShape::mesh, "mesh",
       "a mesh of hexahedra of one's own, with names for its running surface and for what is held; "
       "doc/own-mesh.md."}};
    return list;
  }


  template <>
  const std::vector<Choice<LengthUnit>> &choices()
  {
    static const std::vector<Choice<LengthUnit>> list{{LengthUnit::millimetre, "mm", ""},
                                                      {LengthUnit::metre, "m", ""}};
    return list;
  }


  template <>
  const std::vector<Choice<ProfileName>> &choices()
  {
    static const std::vector<Choice<ProfileName>> list{{ProfileName::rail_54e1, "54E1", ""},
                                                       {ProfileName::rail_60e1, "60E1", ""},
                                                       {ProfileName::rail_49e1, "49E1", ""},
                                                       {ProfileName::rail_cn60, "CN60", ""}};
    return list;
  }


  template <>
  const std::vector<Choice<RailInclination>> &choices()
  {
    static const std::vector<Choice<RailInclination>> list{{RailInclination::none, "none", ""},
                                                           {RailInclination::one_in_forty, "1:40", ""},
                                                           {RailInclination::one_in_twenty, "1:20", ""}};
    return list;
  }


  template <>
  const std::vector<Choice<EndKind>> &choices()
  {
    static const std::vector<Choice<EndKind>> list{
      {EndKind::symmetric, "symmetric", "planes of symmetry, which reflect waves."},
      {EndKind::absorbing, "absorbing",
       "the same planes behind a length of rail in which damping grows towards the end and takes up most of "
       "the waves, as if the rail went on."},
      {EndKind::endless, "endless",
       "the track goes on as a beam on supports ('Spans beyond'), which costs next to nothing."}};
    return list;
  }


  void RailSection::declare(ParameterTable &table)
  {
    Section    section(table, "Rail");
    const Need with_profile("Rail/Shape", {"head", "full section"}), block("Rail/Shape", {"block"}),
      of_slices("Rail/Shape", {"slices"}), of_mesh("Rail/Shape", {"mesh"}),
      without_mesh("Rail/Shape", {"head", "full section", "block", "slices"}),
      on_supports("Track/Foundation", {"one-layer", "two-layer"});

    section.choose("Shape", shape);
    section.needs(with_profile)
      .choose(
        "Profile", profile,
        "Of a head or a full section. 54E1, 60E1, 49E1: EN 13674-1, the UIC54, UIC60 and S49 of before; "
        "CN60: TB/T 2344, also called CHN60. Heads of other rails come from points ('Measured head') on the "
        "section that is nearest; doc/geometry.md says how, and why there are no more names.");
    section.needs(with_profile)
      .add("Measured head", measured_head,
           "File with a measured running surface that takes the place of the profile's own: columns y and z "
           "in mm (gauge side at y < 0), .prr of Simpack or .ban of MiniProf. At least 12 mm to each side of "
           "the middle; contact must lie within. Empty: a new rail.",
           AnyText());
    section.needs(with_profile)
      .add("Measured head mirrored", head_placement.is_mirrored,
           "true: the sign of y in the file is reversed, for files with the gauge side at y > 0.");
    section.needs(with_profile)
      .add("Measured head shift (mm)", head_placement.shift,
           "Added to the file's y, after mirroring: where its y = 0 lies from the rail's middle line.",
           Number(-200., 200.));
    section.add(
      "Smoothing length (mm)", head_placement.smoothing,
      "Of the file 'Rail/Measured head': a smoothing spline leaves half of waves of this length along the "
      "surface, 6 % of those half as long and 94 % of those twice as long. Instruments need some "
      "millimetres; how far it moves the points is printed. 0: none.",
      Number(0., 50.));
    section.add("Slices", slices,
                "File with the slices of 'Shape' slices, such as a crossing: a .slcs of CONTACT or a table, "
                "doc/crossing.md. Blocks are 'Wheel/Sector thickness (mm)' thick.",
                AnyText());
    section.needs(of_slices).add("Slices place (mm)", slices_place,
                                 "Place along the slices that lies at x = 0 of the scene.",
                                 Number(-1e6, 1e6));
    section.needs(of_slices).add(
      "Slices y (mm)", slices_y,
      "Where y = 0 of the slices lies, from the middle of the track to the own side.", Number(-3000., 3000.));
    section.needs(of_slices).add("Slices z (mm)", slices_z,
                                 "Where z = 0 of the slices lies, over the tops of the rails.",
                                 Number(-1000., 1000.));
    section.add("Mesh file", mesh_file,
                "File of 'Shape' mesh, x along the path and z up: .msh of Gmsh (ASCII, 2.2 or 4.1), .inp of "
                "Abaqus or .k of LS-DYNA. Its faces are named contact, support, end or symmetry; "
                "doc/own-mesh.md. The path lies at y = 0 or beside it, as the wheel has it.",
                AnyText());
    section.needs(of_mesh).choose("Mesh unit", mesh_unit, "Of the lengths in 'Mesh file'.");
    section.needs(of_mesh).add(
      "Materials", materials,
      "Of 'Mesh file': volumes that are of another, elastic material than the rail, such as an end post or "
      "rubber around the rail. Name of the volume, Young's modulus (GPa), Poisson's ratio and density (kg "
      "per m3), separated by colons, as in end post:3:0.35:1900. Several: separated by commas.");
    section.needs(with_profile)
      .choose(
        "Inclination", inclination,
        "Of a head or a full section: how far it leans to the gauge side, y < 0. A cone of the same slope "
        "touches it on the middle of the top, a cylinder 7.5 mm (1:40) or 15 mm (1:20) beside it.");
    section.needs(without_mesh)
      .add("Begin (mm)", begin, "automatic",
           "x of the beginning of the rail. automatic: if Length is given, the rail extends as far "
           "before the path as behind it; otherwise it extends by Margin.",
           Number(-1e5, 1e5));
    section.needs(without_mesh)
      .add("Length (mm)", length, "Length of the whole rail. 0: the rail ends by Margin behind the path.",
           Number(0., 1e5));
    section.needs(block).add("Crown radius (mm)", crown_radius,
                             "Radius of the crown of a block, which is its lateral curvature.",
                             Number(10., 1e6));
    section.needs(block).add("Block width (mm)", block_width, "Lateral width of a block.", Number(1., 1000.));
    section.needs(block).add("Block height (mm)", block_height,
                             "Height of a block at its crown; its bottom is held.", Number(1., 1000.));
    section.needs(without_mesh)
      .add("Margin (mm)", margin,
           "Length of rail beyond the rolled distance at each end. At least three contact semi-axes; "
           "150 mm for a full section, whose head deflects more near a free end, which would make the "
           "normal force drift by per cents.",
           Number(0., 20000.));
    section.needs(on_supports).choose("Ends", ends, "Of a rail on supports ('Track/Foundation').");
    section.needs(on_supports)
      .add("Absorbing length (m)", absorbing_length,
           "Length of the damped part at each absorbing end; the wheel's path stays one sleeper spacing "
           "clear of it. Longer parts absorb lower frequencies; it helps from 0.6 m on.",
           Number(0.05, 100.));
    section
      .needs(Need("Rail/Ends", {"endless"}, "endless, or on a beam").or_has("Track/Foundation", {"beam"}))
      .add("Spans beyond", spans_beyond,
           "Sleeper spans of the beam behind each endless end, or each end of a piece on a beam "
           "('Track/Foundation'), whose farther half absorbs what arrives. "
           "Their supports are those of section Track, all alike, whatever 'Track/Support file' has.",
           WholeNumber(4, 1000));
    material.declare(section);
  }


  RailProfile RailSection::standard_profile() const
  {
    switch (profile)
      {
      case ProfileName::rail_54e1:
        return RailProfile::rail_54e1();
      case ProfileName::rail_60e1:
        return RailProfile::rail_60e1();
      case ProfileName::rail_49e1:
        return RailProfile::rail_49e1();
      case ProfileName::rail_cn60:
        return RailProfile::rail_cn60();
      }
    throw std::logic_error("a rail profile without a section");
  }


  double RailSection::angle() const
  {
    return inclination == RailInclination::one_in_forty    ? std::atan(1. / 40.)
           : inclination == RailInclination::one_in_twenty ? std::atan(1. / 20.)
                                                           : 0.;
  }


  dealii::Point<3> RailSection::in_own_axes(const dealii::Point<3> &p) const
  {
    const double c = std::cos(angle()), s = std::sin(angle());
    return {p[0], c * p[1] + s * p[2], -s * p[1] + c * p[2]};
  }


  double RailSection::half_width() const
  {
    return is_block() ? 0.5 * block_width : standard_profile().shoulder_length();
  }


  double RailSection::thickness() const
  {
    return is_block() ? block_height : standard_profile().head_depth();
  }


  double RailSection::height() const
  {
    return is_block() ? block_height : standard_profile().height();
  }


  std::vector<RailSection::VolumeMaterial> RailSection::volume_materials() const
  {
    std::vector<VolumeMaterial> list;
    for (const std::string &text : dealii::Utilities::split_string_list(materials))
      {
        std::vector<std::string> words = dealii::Utilities::split_string_list(text, ':');
        std::vector<double>      values;
        const std::string        volume = words.front();
        words.erase(words.begin());
        try
          {
            values = dealii::Utilities::string_to_double(words);
          }
        catch (const dealii::ExceptionBase &)
          {
            values.clear();
          }
        const std::string begin = "'Rail/Materials' cannot be '" + text + "'; ";
        require(
          values.size() == 3 && !volume.empty(),
          begin +
            "allowed: name of the volume:Young's modulus:Poisson's ratio:density, in GPa and kg per m3");
        const auto in = [&](const double value, const double least, const double most,
                            const std::string &what) {
          require(value >= least && value <= most,
                  begin + what + " must be from " + text_of(least) + " to " + text_of(most));
        };
        in(values[0], 1e-3, 1e4, "Young's modulus (GPa)");
        in(values[1], 0., 0.49, "Poisson's ratio");
        in(values[2], 100., 1e5, "density (kg per m3)");
        for (const VolumeMaterial &other : list)
          require(!boost::algorithm::iequals(other.volume, volume), begin + "the volume is there twice");
        list.push_back({volume, {1e9 * values[0], values[1], values[2]}});
      }
    return list;
  }


  void RailSection::check() const
  {
    require(!is_block() || (inclination == RailInclination::none && measured_head.empty()),
            "'Rail/Inclination' and 'Rail/Measured head' are for 'Rail/Shape' head or full section");
    require(
      !measured_head.empty() ||
        (!head_placement.is_mirrored && head_placement.shift == 0. && head_placement.smoothing == 0.),
      "'Rail/Measured head mirrored', 'Measured head shift (mm)' and 'Smoothing length (mm)' are of the file "
      "'Rail/Measured head'");
    require(is_sliced() != slices.empty(), is_sliced() ? "'Rail/Shape' slices needs a file: 'Rail/Slices'"
                                                       : "'Rail/Slices' need 'Rail/Shape' slices");
    require(!is_sliced() || (measured_head.empty() && inclination == RailInclination::none),
            "'Rail/Slices' take the place of a profile: 'Rail/Measured head' must be empty and 'Inclination' "
            "none");
    require(is_meshed() != mesh_file.empty(), is_meshed() ? "'Rail/Shape' mesh needs a file: 'Rail/Mesh file'"
                                                          : "'Rail/Mesh file' needs 'Rail/Shape' mesh");
    require(
      !is_meshed() || (measured_head.empty() && inclination == RailInclination::none),
      "'Rail/Mesh file' takes the place of a profile: 'Rail/Measured head' must be empty and 'Inclination' "
      "none");
    if (!is_block())
      return;
    require(crown_radius > 0.5 * block_width, "'Rail/Crown radius (mm)' " + text_in_mm(crown_radius) +
                                                " must be above half of 'Rail/Block width (mm)', " +
                                                text_in_mm(0.5 * block_width));
    const double rise = -crown_height(0.5 * block_width, crown_radius);
    require(block_height > rise, "'Rail/Block height (mm)' " + text_in_mm(block_height) +
                                   " must be above the rise of the crown, " + text_in_mm(rise));
  }
} // namespace tread
