// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/csv_table.h>
#include <tread/mesh/mesh_rail.h>
#include <tread/scene/checks.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/scene.h>
#include <tread/scene/tables.h>
#include <tread/scene/track_parts.h>
#include <tread/track/track_beam.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace tread
{
  namespace
  {
    /// Places that should be equal may differ by this, m.
    constexpr double same_place = 1e-9;

    std::string named_file(const std::string &parameter, const std::string &file)
    {
      return "'" + parameter + "': '" + file + "' ";
    }

    /// @throws InputError if it has other columns
    CsvTable table_with(const std::vector<std::string> &columns,
                        const std::string              &parameter,
                        const std::string              &file)
    {
      return CsvTable(
        file,
        [&](const std::string &name) {
          require(std::find(columns.begin(), columns.end(), name) != columns.end(),
                  named_file(parameter, file) + "has a column '" + name + "'; it may have " +
                    boost::algorithm::join(columns, ", "));
          return true;
        },
        "'" + parameter + "': cannot read '" + file + "'");
    }

    /// Of both ends, but for the place of the first support.
    TrackBeamParameters track_beam_alike(const Scene &scene)
    {
      TrackParameters alike = track_parameters(scene);
      alike.exceptions.clear();
      TrackBeamParameters p;
      p.n_spans         = scene.rail.spans_beyond;
      p.spacing         = scene.track.sleeper_spacing;
      p.stiffness_along = scene.track.stiffness_along;
      p.shear_speed     = scene.rail.material.elastic().shear_wave_speed();
      p.gravity         = scene.vehicle.gravity;
      p.layers          = alike.layers(0);
      return p;
    }

    void check_beam(const Scene &scene)
    {
      require(
        scene.rail.shape != RailShape::full_section,
        "'Track/Foundation' beam stands for the rail below the meshed piece: 'Rail/Shape' must be head, "
        "block, slices or mesh");
      require(
        !scene.shapes().rail_mesh || !scene.shapes().rail_mesh->between_planes,
        "'Track/Foundation' beam needs a rail of some width, and this one lies between planes of symmetry");
      require(
        !scene.shapes().rail_mesh ||
          std::none_of(scene.shapes().rail_mesh->mesh.faces.begin(),
                       scene.shapes().rail_mesh->mesh.faces.end(),
                       [](const NamedFace &face) { return face.boundary == Boundary::end; }),
        "'Track/Foundation' beam turns the rail's cross-sections, and faces named 'end' in 'Rail/Mesh file' "
        "would hold them upright: give them no name");
      scene.track.check();
      const BeamUnderRail beam = beam_under_rail(scene);
      const double        end  = beam.begin + beam.track.n_spans * beam.track.spacing;
      for (const BeamRow &row : scene.tables().beam_rows)
        require(row.x > beam.begin && row.x < end,
                "'Track/Beam file': x_mm " + text_in_mm(row.x) + " lies beyond the beam, which goes from " +
                  text_in_mm(beam.begin) + " to " + text_in_mm(end) + " mm ('Rail/Spans beyond')");
    }

    void check_overhang(const Scene &scene)
    {
      const std::vector<double> positions = support_positions(scene);
      const double              spacing   = scene.track.sleeper_spacing;
      require(positions.size() >= 2, "'Track/Sleeper spacing (m)' " + text_of(spacing) + " leaves " +
                                       std::to_string(positions.size()) + " supports on the rail of " +
                                       text_in_mm(scene.rail_end() - scene.rail_begin()) +
                                       " mm; at least 2 are needed");
      const auto check_end = [&](const double overhang, const std::string &begins,
                                 const std::string &support) {
        require(overhang >= 0.5 * scene.track.pad_length - same_place &&
                  overhang <= 0.5 * spacing + same_place,
                "'Track/Sleeper spacing (m)' " + text_of(spacing) + " does not fit the rail from " +
                  text_in_mm(scene.rail_begin()) + " to " + text_in_mm(scene.rail_end()) + " mm: it " +
                  begins + " " + text_in_mm(overhang < same_place ? 0. : overhang) + " mm " + support +
                  "; from half a pad, " + text_in_mm(0.5 * scene.track.pad_length) + ", to half a spacing, " +
                  text_in_mm(0.5 * spacing) + ", is allowed");
      };
      check_end(positions.front() - scene.rail_begin(), "begins", "before its first support");
      check_end(scene.rail_end() - positions.back(), "ends", "behind its last support");
    }
  } // namespace


  int first_support(const Scene &scene)
  {
    // The first whose middle lies on the rail.
    return std::ceil((scene.rail_begin() - scene.track.support_0) / scene.track.sleeper_spacing - 1e-9);
  }


  std::vector<double> support_positions(const Scene &scene)
  {
    const int last =
      std::floor((scene.rail_end() - scene.track.support_0) / scene.track.sleeper_spacing + 1e-9);
    std::vector<double> positions;
    for (int i = first_support(scene); i <= last; ++i)
      positions.push_back(scene.track.support_0 + scene.track.sleeper_spacing * i);
    return positions;
  }


  std::vector<int> recorded_supports(const Scene &scene)
  {
    if (!scene.track.has_supports())
      return {};
    std::vector<int> numbers = scene.output.supports;
    if (numbers.empty())
      {
        const int     size = support_positions(scene).size();
        std::set<int> beside_paths;
        for (unsigned int k = 0; k < scene.n_wheels(); ++k)
          {
            const int first = std::max<int>(first_support(scene),
                                            std::floor((scene.path_begin(k) - scene.track.support_0) /
                                                       scene.track.sleeper_spacing)),
                      last  = std::min<int>(first_support(scene) + size - 1,
                                           std::ceil((scene.meshed_end(k) - scene.track.support_0) /
                                                      scene.track.sleeper_spacing));
            for (int i = first; i <= last; ++i)
              beside_paths.insert(i);
          }
        numbers.assign(beside_paths.begin(), beside_paths.end());
      }
    return numbers;
  }


  std::map<int, TrackParameters::Springs> read_support_springs(const TrackSection &track,
                                                               const std::string  &file)
  {
    require(!track.is_beam(),
            "'Track/Support file' must be empty with 'Track/Foundation' beam, whose supports are all alike");
    require(track.has_supports(),
            "'Track/Support file' needs supports: 'Track/Foundation' must be one-layer or two-layer");
    using Springs = TrackParameters::Springs;
    struct Column
    {
      const char *name;
      double Springs::*value;
      double           in_si;
      double           least; ///< SI
      bool             of_ballast;
    };
    const std::array<Column, 5> columns{
      {{"pad_stiffness_MN_per_m", &Springs::pad_stiffness, 1e6, 1., false},
       {"pad_damping_kN_s_per_m", &Springs::pad_damping, 1e3, 0., false},
       {"ballast_stiffness_MN_per_m", &Springs::ballast_stiffness, 1e6, 0., true},
       {"ballast_damping_kN_s_per_m", &Springs::ballast_damping, 1e3, 0., true},
       {"ballast_gap_mm", &Springs::ballast_gap, 1e-3, 0., true}}};
    const std::string        begin = named_file("Track/Support file", file);
    std::vector<std::string> names{"support"};
    for (const Column &column : columns)
      names.push_back(column.name);
    std::map<int, Springs>     all;
    const CsvTable             table   = table_with(names, "Track/Support file", file);
    const std::vector<double> &numbers = table.column("support");
    require(!numbers.empty() && table.names().size() > 1, begin + "has no rows, or no column beside support");
    for (std::size_t row = 0; row < numbers.size(); ++row)
      {
        const std::string place = begin + "row " + std::to_string(row + 1) + ": ";
        constexpr double  most  = 1e6; // more than on any rail
        require(numbers[row] == std::round(numbers[row]) && std::abs(numbers[row]) <= most,
                place + "support " + text_of(numbers[row]) + " is no whole number, or far beyond the rail");
        const int number = static_cast<int>(numbers[row]);
        require(all.count(number) == 0, place + "support " + std::to_string(number) + " occurs twice");
        Springs own{track.pad_stiffness, track.ballast_stiffness, track.pad_damping, track.ballast_damping};
        for (const Column &column : columns)
          if (table.has(column.name))
            {
              require(!column.of_ballast || track.foundation == Foundation::two_layer,
                      begin + "has " + column.name + ", but 'Track/Foundation' one-layer has no ballast");
              own.*column.value = column.in_si * table.column(column.name)[row];
              require(own.*column.value >= column.least,
                      place + column.name + " " + text_of(own.*column.value / column.in_si) +
                        " is too small; at least " + text_of(column.least / column.in_si));
            }
        all[number] = own;
      }
    return all;
  }


  std::vector<BeamRow> read_beam_rows(const std::string &file)
  {
    struct Column
    {
      const char *name;
      double BeamRow::*value;
      double           in_si, least, largest; ///< limits as in the file: in SI units it would lie beyond
    };
    constexpr std::array<Column, 4> columns{
      {{"x_mm", &BeamRow::x, 1e-3, -1e6, 1e6},
       {"bending_stiffness_MN_m2", &BeamRow::bending_stiffness, 1e6, 1e-3, 1e3},
       {"shear_stiffness_MN", &BeamRow::shear_stiffness, 1e6, 1e-1, 1e5},
       {"mass_kg_per_m", &BeamRow::mass, 1., 1e-1, 1e4}}};
    constexpr double         least_length = 5e-3; // m: shorter elements need shorter steps
    const std::string        begin        = named_file("Track/Beam file", file);
    std::vector<std::string> names;
    for (const Column &column : columns)
      names.push_back(column.name);
    std::vector<BeamRow> rows;
    const CsvTable       table = table_with(names, "Track/Beam file", file);
    require(table.n_rows() > 0, begin + "has no rows");
    for (std::size_t row = 0; row < table.n_rows(); ++row)
      {
        const std::string place = begin + "row " + std::to_string(row + 1) + ": ";
        BeamRow           own;
        for (const Column &column : columns)
          {
            const double value = table.column(column.name)[row];
            require(value >= column.least && value <= column.largest,
                    place + column.name + " " + text_of(value) + " is no value of a rail; from " +
                      text_of(column.least) + " to " + text_of(column.largest));
            own.*column.value = column.in_si * value;
          }
        require(rows.empty() || own.x >= rows.back().x + least_length,
                place + "x_mm " + text_in_mm(own.x) + " must be at least 5 mm behind that of the row before");
        rows.push_back(own);
      }
    return rows;
  }


  TrackParameters track_parameters(const Scene &scene)
  {
    TrackParameters p;
    p.springs       = {scene.track.pad_stiffness, scene.track.ballast_stiffness, scene.track.pad_damping,
                       scene.track.ballast_damping};
    p.pads_pull     = scene.track.pads_pull;
    p.pad_length    = scene.track.pad_length;
    p.pad_width     = scene.track.pad_width;
    p.pad_middle    = base_middle(scene)[1];
    p.points_along  = scene.track.points_along;
    p.points_across = scene.track.points_across;
    p.two_layers    = scene.track.foundation == Foundation::two_layer || scene.track.is_beam();
    p.sleeper_mass  = scene.track.sleeper_mass;
    for (const auto &[number, springs] : scene.tables().support_springs)
      p.exceptions[number - first_support(scene)] = springs;
    return p;
  }


  AbsorbingEnds absorbing_ends(const Scene &scene)
  {
    return {scene.rail_begin(), scene.rail_end(),
            scene.rail.ends == EndKind::absorbing ? scene.rail.absorbing_length : 0.,
            scene.rail.material.elastic().shear_wave_speed()};
  }


  BeamUnderRail beam_under_rail(const Scene &scene)
  {
    const ElasticMaterial &steel   = scene.rail.material.elastic();
    const auto             section = [&](const double bending, const double shear, const double mass) {
      return reference::BeamSection{bending, shear, mass, bending * steel.density / steel.young_modulus};
    };
    BeamUnderRail beam;
    beam.section =
      section(scene.track.beam_bending_stiffness, scene.track.beam_shear_stiffness, scene.track.beam_mass);
    beam.axial_stiffness = scene.track.beam_mass * steel.young_modulus / steel.density;
    beam.track           = track_beam_alike(scene);
    beam.track.gravity   = 0.; // it carries nothing but the cells and the wheel
    // So many spans go on beyond both ends of the piece.
    const MeshFile::Range piece  = scene.shapes().rail_mesh
                                     ? scene.shapes().rail_mesh->mesh.range(0)
                                     : MeshFile::Range{scene.rail_begin(), scene.rail_end()};
    const int             beyond = scene.rail.spans_beyond - 1,
              first =
                std::floor((piece.begin - scene.track.support_0) / scene.track.sleeper_spacing) - beyond,
              last = std::ceil((piece.end - scene.track.support_0) / scene.track.sleeper_spacing) + beyond;
    beam.track.n_spans       = last - first + 1;
    beam.track.first_support = 0.5 * scene.track.sleeper_spacing;
    beam.begin               = scene.track.support_0 + (first - 0.5) * scene.track.sleeper_spacing;
    beam.track.loaded        = {piece.begin - beam.begin, piece.end - beam.begin, {}};
    for (const BeamRow &row : scene.tables().beam_rows)
      beam.track.stretches.push_back(
        {row.x - beam.begin, section(row.bending_stiffness, row.shear_stiffness, row.mass)});
    return beam;
  }


  std::optional<std::array<TrackBeamParameters, 2>> track_beyond(const Scene &scene)
  {
    if (scene.rail.ends != EndKind::endless)
      return {};
    const TrackBeamParameters p      = track_beam_alike(scene);
    const std::vector<double> places = support_positions(scene);
    TrackBeamParameters       before = p, behind = p;
    before.first_support = scene.track.sleeper_spacing - (places.front() - scene.rail_begin());
    behind.first_support = scene.track.sleeper_spacing - (scene.rail_end() - places.back());
    return std::array{before, behind};
  }


  dealii::Point<3> base_middle(const Scene &scene)
  {
    return dealii::Point<3>(0., std::sin(scene.rail.angle()) * scene.rail.height(),
                            -std::cos(scene.rail.angle()) * scene.rail.height());
  }


  void check_track(const Scene &scene)
  {
    require(scene.track.has_supports() || scene.rail.ends == EndKind::symmetric,
            "'Rail/Ends' " + name_of(scene.rail.ends) +
              (scene.track.is_beam()
                 ? " is for rails on supports: a beam is endless by itself"
                 : " needs a rail on supports: 'Track/Foundation' must be one-layer or two-layer"));
    require(!scene.track.has_moving_base() || (scene.n_wheels() == 1 && !scene.wheelset.both_wheels),
            "'Track/Foundation' " + name_of(scene.track.foundation) +
              " is for one wheel: 'Further wheels' and "
              "'Wheelset/Both wheels' must be off");
    if (scene.track.is_beam())
      check_beam(scene);
    if (!scene.track.has_supports())
      return;
    require(!scene.rail.is_meshed(),
            "'Track/Foundation' " + name_of(scene.track.foundation) +
              " needs a rail with a foot of the program's own: with 'Rail/Shape' mesh it must be "
              "rigid, co-running or beam");
    require(scene.rail.shape != RailShape::head, "'Track/Foundation' " + name_of(scene.track.foundation) +
                                                   " needs a rail with a foot: 'Rail/Shape' cannot be head");
    scene.track.check();
    const RailProfile profile = scene.rail.standard_profile();
    const double      base    = scene.rail.is_block() ? scene.rail.block_width
                                                      : 2. * profile.outline_point(profile.corners().foot_edge)[0];
    require(scene.track.pad_width <= base, "'Track/Pad width (mm)' " + text_in_mm(scene.track.pad_width) +
                                             " exceeds the flat width of the rail's base, " +
                                             text_in_mm(base));
    // A rail that rolls on its crown under the load rises, and comes back, if the crown's centre lies below
    // its foot.
    const bool stands_upright = scene.rail.angle() == 0. && scene.rail.measured_head.empty() &&
                                std::abs(scene.shapes().first_contact.y) < 1e-6 &&
                                (!scene.shapes().defect || scene.shapes().defect->y_middle == 0.) &&
                                scene.motion.lateral_creepage == 0. && scene.motion.spin == 0.;
    require(
      scene.track.points_across > 1 || (stands_upright && lateral_radius(scene) > scene.rail.height()),
      "'Track/Points across' must be at least 2: on one the rail tips over, unless it stands upright "
      "('Rail/Inclination' none), wheel and defect meet it on y = 0, 'Motion/Lateral creepage' and 'Spin "
      "(1 per m)' are 0, and its crown radius exceeds its height, " +
        text_in_mm(scene.rail.height()) + " mm");
    check_overhang(scene);
    if (const AbsorbingEnds ends = absorbing_ends(scene); ends.length > 0.)
      {
        const double clear =
          std::min(scene.path_begin(scene.last_wheel()) - ends.begin, ends.end - scene.meshed_end()) -
          scene.track.sleeper_spacing;
        require(ends.length <= clear + same_place,
                "'Rail/Absorbing length (m)' " + text_of(ends.length) +
                  " leaves less than a sleeper spacing between the absorbing ends and the wheel's path; at "
                  "most " +
                  text_of(std::max(0., clear)) + " fits this rail");
      }
    if (scene.rail.ends == EndKind::endless)
      {
        require(scene.track.pads_pull,
                "'Rail/Ends' endless needs 'Track/Pads pull' true: the beam beyond the ends is "
                "linear");
        require(scene.general.density_scale == 1.,
                "'Rail/Ends' endless needs 'Scene/Density scale' 1: waves that "
                "leave the cells would find another rail");
        const double clear = std::min(scene.path_begin(scene.last_wheel()) - scene.rail_begin(),
                                      scene.rail_end() - scene.meshed_end());
        require(clear >= 0.5 * scene.track.sleeper_spacing - same_place,
                "'Rail/Ends' endless: the wheel's path comes within " + text_in_mm(std::max(0., clear)) +
                  " mm of an end of the rail; at least half a sleeper spacing, " +
                  text_in_mm(0.5 * scene.track.sleeper_spacing) + " mm, is needed");
      }
    const int first = first_support(scene),
              last  = first + static_cast<int>(support_positions(scene).size()) - 1;
    for (const auto &[support, springs] : scene.tables().support_springs)
      require(support >= first && support <= last, "'Track/Support file' has support " +
                                                     std::to_string(support) + "; the rail has supports " +
                                                     std::to_string(first) + " to " + std::to_string(last));
    for (const int support : recorded_supports(scene))
      require(support >= first && support <= last, "'Output/Supports' has " + std::to_string(support) +
                                                     "; the rail has supports " + std::to_string(first) +
                                                     " to " + std::to_string(last));
  }
} // namespace tread
