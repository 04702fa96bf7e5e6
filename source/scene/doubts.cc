// SPDX-License-Identifier: LGPL-2.1-or-later
// What of a scene makes its answer doubtful, before anything is computed.
#include <tread/base/format.h>
#include <tread/geometry/measured_profile.h>
#include <tread/mesh/mesh_rail.h>
#include <tread/reference/half_space.h>
#include <tread/reference/hertz.h>
#include <tread/scene/checks.h>
#include <tread/scene/doubts.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/islands.h>
#include <tread/scene/scene.h>
#include <tread/solid/element.h>
#include <tread/solid/surface_lattice.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

namespace tread
{
  namespace
  {
    /// What is found on railways and on test rigs, with a decade of room: beyond, a number is likely to be in
    /// another unit.
    struct Usual
    {
      const char *path;
      double      least, largest; ///< in the parameter's unit
      const char *but;            ///< the unit that it may be in
    };
    const std::vector<Usual> usual_values{
      {"Wheel/Mass (kg)", 5., 2e4, "t"},
      {"Wheel/Moment of inertia (kg m2)", 1e-3, 1e4, "t m2"},
      {"Wheel/Young's modulus (GPa)", 1., 1e3, "MPa or TPa"},
      {"Rail/Young's modulus (GPa)", 1., 1e3, "MPa or TPa"},
      {"Wheel/Density (kg per m3)", 500., 3e4, "t per m3"},
      {"Rail/Density (kg per m3)", 500., 3e4, "t per m3"},
      {"Vehicle/Sprung mass (kg)", 50., 1e5, "t"},
      {"Vehicle/Wheel load (kN)", 0.05, 1e3, "N or MN"},
      {"Vehicle/Axle load (t)", 0.01, 60., "kg or kN"},
      {"Vehicle/Gravity (m per s2)", 0.1, 100., "mm per s2"},
      {"Vehicle/Suspension stiffness (kN per m)", 1., 1e5, "N per m or MN per m"},
      {"Vehicle/Suspension damping (N s per m)", 10., 1e7, "kN s per m"},
      {"Track/Pad stiffness (MN per m)", 1., 1e5, "N per m or kN per mm"},
      {"Track/Pad damping (kN s per m)", 0.05, 1e4, "N s per m"},
      {"Track/Ballast stiffness (MN per m)", 0.1, 1e4, "N per m"},
      {"Track/Ballast damping (kN s per m)", 0.05, 1e4, "N s per m"},
      {"Track/Sleeper mass (kg)", 5., 5e3, "t"},
      {"Track/Sleeper density (kg per m3)", 100., 2e4, "t per m3"},
      {"Track/Sleeper Young's modulus (GPa)", 0.1, 1e3, "MPa"},
      {"Track/Co-running mass (kg)", 1., 1e5, "t"},
      {"Track/Vertical stiffness (MN per m)", 0.1, 1e5, "N per m"},
      {"Track/Vertical damping (kN s per m)", 0.05, 1e5, "N s per m"},
      {"Track/Lateral stiffness (MN per m)", 0.01, 1e5, "N per m"},
      {"Track/Lateral damping (kN s per m)", 0.05, 1e5, "N s per m"},
      {"Track/Beam bending stiffness (MN m2)", 0.05, 500., "N m2"},
      {"Track/Beam shear stiffness (MN)", 5., 2e4, "N"},
      {"Track/Beam mass (kg per m)", 5., 3e3, "t per m"},
      {"Guidance/Lateral stiffness (MN per m)", 1e-3, 1e4, "N per m"},
      {"Guidance/Yaw inertia (kg m2)", 1., 1e5, "t m2"},
    };

    /// Heights of a defect's file below which it is no defect: less than ground surfaces are rough.
    constexpr double least_height = 2e-6; // m

    /// More than is not sprung on any wheel of a railway, beside a sprung mass that is less. [kg]
    constexpr double largest_unsprung_mass = 4e3;

    /// Radius of the smallest wheels on railways, m.
    constexpr double smallest_wheel = 0.15;

    /// Across the track: a wheelset that hunts over all of its play has some tenths. [m/s]
    constexpr double largest_lateral_speed = 2.;

    /// Where the treads that have a name have the back of their flange, and what it may be off. [m]
    constexpr double named_back = -70e-3, back_tolerance = 2e-3;

    /// Of a wheel that begins where the rail lies lower or higher than without the defect: it stands there at
    /// rest, and the way into the defect is missing. Corrugation may reach over all of the path.
    std::string begins_on_defect(const Scene &scene)
    {
      if (!scene.shapes().defect || scene.defect.shape == "corrugation" || scene.static_load() <= 0.)
        return "";
      constexpr unsigned int n    = 5; // places over the patch, along and across
      const Defect          &made = *scene.shapes().defect;
      for (unsigned int number = 0; number < scene.n_wheels(); ++number)
        for (const WheelStance::Footprint &patch : scene.stance().footprints())
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              if (std::abs(made.height(
                    scene.path_begin(number) + patch.x_begin + (patch.x_end - patch.x_begin) * i / (n - 1.),
                    patch.y_begin + (patch.y_end - patch.y_begin) * j / (n - 1.))) > least_height)
                return format("the wheel begins on the defect: its patch at rest, around x = %.2f mm, lies "
                              "in part on it, so that the way into the defect is missing; move "
                              "'Defect/Position (mm)' or 'Motion/Start (mm)'",
                              1e3 * (scene.path_begin(number) + 0.5 * (patch.x_begin + patch.x_end)));
      return "";
    }

    /// What the wheel is not round by, inwards or outwards, that comes to the rail on the way, m.
    double largest_deviation(const Scene &scene)
    {
      constexpr double       step    = 0.5e-3; // m
      constexpr unsigned int n       = 8;      // across a patch
      double                 largest = scene.shapes().largest_deviation;
      for (const WheelStance::Footprint &tread : scene.stance().treads())
        for (double way = tread.x_begin; way <= tread.x_end; way += step)
          for (unsigned int i = 0; i <= n; ++i)
            largest = std::max(
              largest, std::abs(scene.shapes().surfaces.deviation(
                         way / scene.wheel.radius, tread.y_begin + (tread.y_end - tread.y_begin) * i / n)));
      return largest;
    }

    std::string flange_back_elsewhere(const Scene &scene)
    {
      // A worn or rounded back is not known better.
      constexpr double tolerance = 3e-3; // m
      if (!scene.wheel.has_measured_profile())
        return "";
      const double given = scene.wheelset.track.back_position;
      const auto   shown = read_measured_profile(scene.parameters().located(scene.wheel.tread_profile),
                                                 ProfileBody::wheel, scene.wheel.profile_placement)
                           .flange_back;
      if (!shown || std::abs(given - *shown) <= tolerance)
        return "";
      return format(
        "'Wheelset/Flange back (mm)' %g: the flange of 'Wheel/Tread profile' '%s' has its back at %.1f, so "
        "that the wheel stands %.1f mm off its place in the track",
        1e3 * given, scene.wheel.tread_profile.c_str(), 1e3 * *shown, 1e3 * std::abs(given - *shown));
    }

    std::string short_way(const Scene &scene)
    {
      if (scene.output.history_interval <= scene.motion.rolled_distance * scene.motion.passages)
        return "";
      return format(
        "'Output/History interval (mm)' %g is longer than the way, %g: history.csv has one row, which is the "
        "mean over all of it",
        1e3 * scene.output.history_interval, 1e3 * scene.motion.rolled_distance * scene.motion.passages);
    }

    /// Length of the cells under the path from begin to end, the longest where they are not alike, m.
    double cell_along(const Scene &scene, const double begin, const double end)
    {
      return is_finest(scene, begin, end) ? scene.mesh.finest_cell
                                          : std::max(scene.mesh.finest_cell, scene.mesh.path_cell);
    }

    std::string unseen_detail_along(const Scene &scene)
    {
      // As across: Westergaard's pressure under waves of two cells' length that are pressed flat.
      constexpr double large  = 0.1;
      const double     detail = detail_along(scene), load = scene.static_load();
      if (!(detail > 0. && load > 0.))
        return "";
      const Defect *made = scene.shapes().defect.get();
      const double  cell = made && scene.shapes().is_round()
                             ? cell_along(scene, made->begin, made->begin + made->length)
                             : cell_along(scene, scene.path_begin(), scene.meshed_end());
      const double  modulus =
                     reference::combine(elastic_of(scene.wheel.material), elastic_of(scene.rail.material))
                       .hertz_modulus(),
                   share = dealii::numbers::PI * modulus * std::sqrt(2.) * detail /
                           (2. * cell * scene.stance().ellipse(load).max_pressure);
      if (!(share > large))
        return "";
      return format(
        "%s has detail along the rail of %.2g um within a cell of %.3g mm, noise or "
        "a step, which a pressure of %.0f %% of Hertz's presses flat (above %g %%): pressure and stress "
        "depend on the cells; %s, or use smaller cells",
        scene.shapes().is_round() ? "'Defect/Profile file'" : "'Wheel/Deviation'", 1e6 * detail, 1e3 * cell,
        100. * share, 100. * large,
        scene.shapes().is_round() ? "smooth the file, give 'Defect/Ramp (mm)' where it begins with a step"
                                  : "give 'Wheel/Deviation smoothing (mm)'");
    }

    std::string missed_defect(const Scene &scene)
    {
      if (!scene.shapes().defect || !misses_defect(scene))
        return "";
      const Defect &made = *scene.shapes().defect;
      std::string   patches;
      for (const WheelStance::Footprint &patch : scene.stance().footprints())
        {
          const double ahead = 0.5 * (patch.x_begin + patch.x_end);
          patches += (patches.empty() ? "" : " and ") +
                     format("%.2f to %.2f mm", 1e3 * patch.y_begin, 1e3 * patch.y_end);
          if (std::abs(ahead) >= scene.mesh.finest_cell)
            patches +=
              format(", %.2f mm %s the axle", 1e3 * std::abs(ahead), ahead > 0. ? "ahead of" : "behind");
        }
      return format(
        "the contact does NOT reach the defect, from %.2f to %.2f mm: the wheel rolls from %.2f to %.2f "
        "mm, and its patch is from y = %s; look at 'Defect/Position (mm)', 'Lateral position "
        "(mm)', 'Motion/Start (mm)' and 'Rolled distance (mm)'",
        1e3 * made.begin, 1e3 * (made.begin + made.length), 1e3 * scene.path_begin(),
        1e3 * scene.meshed_end(), patches.c_str());
    }

    std::string narrow_island(const Scene &scene)
    {
      // As many cells as check() wants of the whole patch; less than a hundredth of the load is no matter.
      constexpr double least_cells = 2. / 0.45, least_share = 0.01;
      struct Narrow
      {
        std::string patch;
        Island      island;
        double      size;
      };
      std::vector<Narrow> narrow;
      const auto          look = [&](const std::vector<Island> &islands, const std::string &patch) {
        for (const Island &island : islands)
          if (const double size = std::min(island.y_end - island.y_begin, island.x_end - island.x_begin);
              island.force >= least_share * scene.static_load() &&
              size < least_cells * scene.mesh.finest_cell)
            narrow.push_back({patch, island, size});
      };
      for (const auto &[patch, parts] : scene.stance().parts_of_patches())
        look(parts, patch);
      if (narrow.empty())
        return "";
      const Narrow &worst = *std::min_element(
        narrow.begin(), narrow.end(), [](const Narrow &a, const Narrow &b) { return a.size < b.size; });
      const Island &at = worst.island;
      return format(
        "a part of %s by half-space theory, %.2f mm long and %.2f mm wide, with %.1f %% of the "
        "load, has %.1f cells of "
        "'Mesh/Finest cell (mm)' %g (below %.1f), which find too low a pressure; at most %.2g mm%s",
        worst.patch.c_str(), 1e3 * (at.x_end - at.x_begin), 1e3 * (at.y_end - at.y_begin),
        100. * at.force / scene.static_load(), worst.size / scene.mesh.finest_cell,
        1e3 * scene.mesh.finest_cell, least_cells, 1e3 * worst.size / least_cells,
        narrow.size() > 1 ? format("; %u more like it", unsigned(narrow.size() - 1)).c_str() : "");
    }

    /// Cells are cubes to within some per cent, and at the border of what has weights cubes may have some
    /// alone.
    bool has_weights_near_cubes(SurfaceWeights weights)
    {
      for (const double stretch : {0.95, 1.05})
        for (unsigned int d = 0; d < 3; ++d)
          {
            std::array<double, 3> edges{{1., 1., 1.}};
            edges[d] = stretch;
            if (!weights.of_box(edges))
              return false;
          }
      return true;
    }

    /// Of the track that runs along: a mass that is right at low frequencies.
    std::string blow_on_a_mass(const Scene &scene)
    {
      return scene.track.runs_along() && (!scene.shapes().are_smooth() || scene.rail.is_sliced())
               ? "'Track/Foundation' co-running: its mass stands for the track at low frequencies and makes "
                 "blows within some "
                 "milliseconds too large, by half at a crossing and twice at a short dip; beam finds them"
               : "";
    }

    /// Steel on something soft bends about its own middle, and not about the beam below.
    std::string soft_layer_on_beam(const Scene &scene)
    {
      constexpr double most = 0.1; // of the faces: an end post is less
      const auto      &rail = scene.shapes().rail_mesh;
      if (!scene.track.is_beam() || !rail)
        return "";
      unsigned int n = 0, n_others = 0;
      for (const NamedFace &face : rail->mesh.faces)
        if (face.boundary == Boundary::support)
          {
            ++n;
            n_others += rail->mesh.cells[face.cell].material_id != 0;
          }
      return n_others <= most * n
               ? ""
               : "'Track/Foundation' beam: a volume of 'Rail/Materials' lies between the rail and "
                 "the beam, which has less bending stiffness by all of the cells' as if sections "
                 "stayed plane: if it is soft, both together are softer than the rail";
    }

    /// Bodies whose surface cannot be matched. @see SurfaceWeights
    std::string unmatched_surface(const Scene &scene)
    {
      if (!scene.solid.matched_surface || !element_named(scene.solid.element).has_hourglass_modes)
        return "";
      const double coefficient = scene.solid.hourglass_coefficient;
      std::string  bodies, ratios;
      for (const auto &[name, material] :
           {std::pair("the wheel", &scene.wheel.material), std::pair("the rail", &scene.rail.material)})
        if (!has_weights_near_cubes(SurfaceWeights(material->poisson_ratio, coefficient)))
          {
            bodies += (bodies.empty() ? "" : " and ") + std::string(name);
            ratios += (ratios.empty() ? "" : " and ") + format("%g", material->poisson_ratio);
          }
      return bodies.empty()
               ? ""
               : format("'Solid/Matched surface' has little or no effect on %s: there are no positive "
                        "weights for a Poisson's "
                        "ratio of %s and a 'Hourglass coefficient' of %g; creepages and forces "
                        "under spin keep the "
                        "error of the cells, some per cent with ten cells in the patch",
                        bodies.c_str(), ratios.c_str(), coefficient);
    }
  } // namespace


  std::vector<std::string> implausible_values(const Scene &scene, const bool stands_in_track)
  {
    std::vector<std::string> list;
    for (const ParameterFile::Setting &parameter : scene.parameters().changed_values())
      for (const Usual &usual : usual_values)
        // Wheels of test rigs are as light as they are small.
        if (parameter.path == usual.path &&
            (scene.wheel.radius >= smallest_wheel || parameter.path != "Wheel/Mass (kg)"))
          {
            const double value = std::strtod(parameter.value.c_str(), nullptr);
            if (value != 0. && std::isfinite(value) && (value < usual.least || value > usual.largest))
              list.push_back(format("'%s' %g is far from what there is on railways, %g to %g: is it in %s?",
                                    usual.path, value, usual.least, usual.largest, usual.but));
          }
    // Of supports that have springs of their own one line each column.
    using Springs = TrackParameters::Springs;
    for (const auto &[column, path, value, in_si] :
         {std::tuple("pad_stiffness_MN_per_m", "Track/Pad stiffness (MN per m)", &Springs::pad_stiffness,
                     1e6),
          std::tuple("pad_damping_kN_s_per_m", "Track/Pad damping (kN s per m)", &Springs::pad_damping, 1e3),
          std::tuple("ballast_stiffness_MN_per_m", "Track/Ballast stiffness (MN per m)",
                     &Springs::ballast_stiffness, 1e6),
          std::tuple("ballast_damping_kN_s_per_m", "Track/Ballast damping (kN s per m)",
                     &Springs::ballast_damping, 1e3)})
      {
        const auto usual =
          std::find_if(usual_values.begin(), usual_values.end(),
                       [path = path](const Usual &u) { return std::string(u.path) == path; });
        for (const auto &[number, springs] : scene.tables().support_springs)
          if (const double own = springs.*value / in_si; own > usual->largest)
            {
              list.push_back(format("'Track/Support file', support %d: %s %g is far from what there is on "
                                    "railways, up to %g: is it in %s?",
                                    number, column, own, usual->largest, usual->but));
              break;
            }
      }
    if (!scene.vehicle.wheel_load && !scene.vehicle.axle_load && scene.wheel.mass > largest_unsprung_mass &&
        scene.wheel.mass > scene.vehicle.sprung_mass)
      list.push_back(format("'Wheel/Mass (kg)' %g, which is not sprung, is more than 'Vehicle/Sprung mass "
                            "(kg)' %g: are they exchanged?",
                            scene.wheel.mass, scene.vehicle.sprung_mass));
    if (const double back = scene.wheelset.track.back_position;
        !scene.wheel.has_measured_profile() && std::abs(back - named_back) > back_tolerance)
      list.push_back(format("'Wheelset/Flange back (mm)' %g: the flange of 'Wheel/Tread profile' %s has its "
                            "back at %g, so that the wheel stands %g mm off its place in the track",
                            1e3 * back, scene.wheel.tread_profile.c_str(), 1e3 * named_back,
                            1e3 * std::abs(back - named_back)));
    if (stands_in_track && !scene.wheel.deviation.empty())
      list.push_back("'Wheel/Deviation' is left out: the wheel is taken as round");
    if (stands_in_track || scene.is_positioned())
      if (const std::string elsewhere = flange_back_elsewhere(scene); !elsewhere.empty())
        list.push_back(elsewhere);
    if (scene.tables().wheelset_motion &&
        scene.tables().wheelset_motion->largest_lateral_speed() > largest_lateral_speed)
      list.push_back(
        format("'Guidance/File' moves the wheelset across the track with up to %.3g m/s, which none does "
               "(above %g m/s): are its shifts in mm and its times in s?",
               scene.tables().wheelset_motion->largest_lateral_speed(), largest_lateral_speed));
    if (!scene.shapes().is_round() && largest_deviation(scene) < least_height)
      list.push_back(
        "no part of 'Wheel/Deviation' comes to the rail: where the wheel rolls it is round within 2 "
        "um; change 'Wheel/Deviation pitch (deg)' or 'Motion/Rolled distance (mm)'");
    if (scene.rail.is_sliced())
      for (const std::string &doubt : scene.wheel_on_rail().rail_surface().doubts())
        list.push_back("'Rail/Slices': " + doubt);
    if (scene.shapes().defect && !scene.defect.profile_file.empty() && scene.defect.depth == 0. &&
        scene.shapes().defect->depth < least_height)
      list.push_back(
        format("'Defect/Profile file': heights of at most %.3g um, less than a ground surface is "
               "rough; they are read in mm: are they in m?",
               1e6 * scene.shapes().defect->depth));
    return list;
  }


  double detail_along(const Scene &scene)
  {
    const Defect *made    = scene.shapes().defect.get();
    const bool    is_file = made && (scene.defect.shape == "profile" || scene.defect.shape == "map");
    if (!is_file && scene.shapes().is_round())
      return 0.;
    constexpr unsigned int n_between = 8, n_across = 5; // places from node to node, and lines
    const double           a       = scene.stance().ellipse(scene.static_load()).semi_axis_x;
    double                 largest = 0.;
    struct Patches
    {
      std::vector<double> lines;         // across
      Scene::Range        reach{0., 0.}; // from the axle
    };
    const auto lines_of = [](const std::vector<WheelStance::Footprint> &patches) {
      Patches all;
      for (const WheelStance::Footprint &patch : patches)
        {
          for (unsigned int line = 0; line < n_across; ++line)
            all.lines.push_back(patch.y_begin + (patch.y_end - patch.y_begin) * (line + 0.5) / n_across);
          all.reach = {std::min(all.reach.begin, patch.x_begin), std::max(all.reach.end, patch.x_end)};
        }
      return all;
    };
    const auto look = [&](const std::vector<double> &lines, const double cell, const double from,
                          const double to, const bool alike,
                          const std::function<double(double, double)> &height) {
      if (!(to > from))
        return;
      const unsigned int n = std::ceil((to - from) / cell), window = std::max(4., std::ceil(a / cell));
      for (const double y : lines)
        {
          // Where the nodes lie is not known: the way between them begins with the defect.
          std::vector<double> squares(n, 0.);
          for (unsigned int k = 0; k < n; ++k)
            {
              double of_node[4];
              for (unsigned int i = 0; i < 4; ++i)
                of_node[i] = height(from + (k + i - 1. + 0.5) * cell, y);
              for (unsigned int j = 1; j < n_between; ++j)
                {
                  const double s        = double(j) / n_between;
                  const double of_nodes = cubic_between(of_node, s);
                  const double off      = height(from + (k + s + 0.5) * cell, y) - of_nodes;
                  squares[k] += off * off / (n_between - 1.);
                }
            }
          double sum = 0.;
          for (unsigned int k = 0; k < n; ++k)
            {
              sum += squares[k] - (k >= window ? squares[k - window] : 0.);
              largest = std::max(largest, std::sqrt(std::max(0., sum) / std::min(n, window)));
            }
          if (alike)
            break;
        }
    };
    if (is_file)
      {
        const Patches       on_rail = lines_of(scene.stance().footprints());
        std::vector<double> begins(made->repeated_at);
        begins.push_back(made->begin);
        for (const double begin : begins)
          {
            const double cell = cell_along(scene, begin, begin + made->length);
            look(on_rail.lines, cell,
                 std::max(begin - 2. * cell, scene.path_begin(scene.last_wheel()) + on_rail.reach.begin),
                 std::min(begin + made->length + 2. * cell, scene.meshed_end() + on_rail.reach.end),
                 std::isinf(made->width), [&](const double x, const double y) { return made->height(x, y); });
          }
      }
    if (!scene.shapes().is_round())
      look(lines_of(scene.stance().treads()).lines, cell_along(scene, scene.path_begin(), scene.meshed_end()),
           -a, scene.motion.meshed_distance() + a, false, [&](const double way, const double y) {
             return scene.shapes().surfaces.deviation(way / scene.wheel.radius, y);
           });
    return largest;
  }


  std::vector<std::string> doubts(const Scene &scene)
  {
    std::vector<std::string> list = implausible_values(scene);
    for (const std::string &doubt :
         {missed_defect(scene), begins_on_defect(scene), unseen_detail_along(scene), narrow_island(scene),
          short_memory(scene), short_way(scene), unmatched_surface(scene), soft_layer_on_beam(scene),
          blow_on_a_mass(scene)})
      if (!doubt.empty())
        list.push_back(doubt);
    if (scene.shapes().rail_mesh)
      list.insert(list.end(), scene.shapes().rail_mesh->mesh.doubts.begin(),
                  scene.shapes().rail_mesh->mesh.doubts.end());
    return list;
  }


  std::vector<std::string> left_out_by_half_space(const Scene &scene)
  {
    std::vector<std::string> list;
    if (scene.shapes().defect)
      list.push_back("the defect is left out: half-space theory rolls over a smooth rail");
    if (!scene.shapes().is_round())
      list.push_back("the wheel is taken as round: tread positions solves wheels that are not");
    return list;
  }


  double detail_within_cells(const Scene &scene)
  {
    if (scene.is_positioned())
      return 0.;
    constexpr unsigned int n_between = 8; // places from node to node
    const double           cell      = scene.mesh.finest_cell;
    double                 sum       = 0.;
    unsigned int           n         = 0;
    for (double y = scene.shapes().patch.begin + cell; y + 2. * cell <= scene.shapes().patch.end; y += cell)
      {
        double of_node[4]; // around the second of three cells
        for (unsigned int i = 0; i < 4; ++i)
          of_node[i] = scene.shapes().surfaces.gap(y + (i - 1.) * cell);
        for (unsigned int k = 1; k < n_between; ++k)
          {
            const double s = double(k) / n_between;
            if (const double off = scene.shapes().surfaces.gap(y + s * cell) - cubic_between(of_node, s);
                std::isfinite(off))
              {
                sum += off * off;
                ++n;
              }
          }
      }
    return n > 0 ? std::sqrt(sum / n) : 0.;
  }


  bool misses_defect(const Scene &scene)
  {
    const Defect &made = *scene.shapes().defect;
    // A wheelset that is moved or moves across may come to it later.
    if (scene.static_load() <= 0. || scene.guidance.kind != Guidance::rigid)
      return false;
    const Scene::Range  beyond = reach_of(scene, -extremes_of(made.shape).first * made.depth);
    std::vector<double> begins(made.repeated_at);
    begins.push_back(made.begin);
    const auto is_met = [&](const WheelStance::Footprint &patch, const double path_begin) {
      const double along  = 0.5 * room_for_dynamic_load * (patch.x_end - patch.x_begin) + beyond.begin,
                   across = 0.5 * room_for_dynamic_load * (patch.y_end - patch.y_begin) + beyond.end,
                   cell = scene.mesh.finest_cell, middle = path_begin + 0.5 * (patch.x_begin + patch.x_end),
                   from = middle - along - cell, to = middle + scene.motion.meshed_distance() + along + cell;
      return std::abs(made.y_middle - 0.5 * (patch.y_begin + patch.y_end)) <=
               across + cell + 0.5 * made.width &&
             std::any_of(begins.begin(), begins.end(),
                         [&](const double begin) { return begin < to && begin + made.length > from; });
    };
    for (const WheelStance::Footprint &patch : scene.stance().footprints())
      for (unsigned int number = 0; number < scene.n_wheels(); ++number)
        if (is_met(patch, scene.path_begin(number)))
          return false;
    return true;
  }


  std::string defect_in_words(const Scene &scene)
  {
    const Defect     *made = scene.shapes().defect.get();
    const std::string wheel_is =
      scene.shapes().is_round() ? "" : "the wheel is not round: " + scene.shapes().wheel_deviation;
    if (!made)
      return wheel_is;
    return (scene.shapes().is_round() ? "" : wheel_is + "; ") +
           format("defect: x = %.2f to %.2f mm, %.3f mm deep%s", 1e3 * made->begin,
                  1e3 * (made->begin + made->length), 1e3 * made->depth,
                  made->is_a_bump() ? "; it rises ABOVE the rail more than it lies below" : "") +
           (made->repeated_at.empty()
              ? ""
              : format("; %u more like it", static_cast<unsigned int>(made->repeated_at.size()))) +
           (misses_defect(scene) ? "; the contact does NOT reach it" : "");
  }
} // namespace tread
