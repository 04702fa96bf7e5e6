// SPDX-License-Identifier: LGPL-2.1-or-later
// A rail from the user's own mesh: its surface as the scene asks for it, and what it must have.
#include <tread/scene/checks.h>
#include <tread/scene/scene.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    /// Where the rail has no surface, as in the gap of a joint, it is this far below its section at the
    /// start, m.
    constexpr double where_there_is_none = 0.1;

    /// A surface that differs by less from its section at the start is the same, with the error of a fit to
    /// coarse faces: a hundredth of what a loaded contact gives way, m.
    constexpr double round_off_of_fit = 1e-6;

    /// As wide and as long as patches are, about the first contact, m.
    constexpr double half_patch = 10e-3;

    /// Places of the surface that are looked at are so far apart, m.
    constexpr double step_along = 0.5e-3, step_across = 1e-3;

    /// Tables of a run count heights from z = 0, where the tops of other rails lie; a top may lie this far
    /// from it, m.
    constexpr double highest_top = 10e-3;

    /// What rails measure, m: others are meshes in another unit.
    constexpr double narrowest_rail = 5e-3, widest_rail = 1., lowest_rail = 5e-3, highest_rail = 3.,
                     shortest_rail = 20e-3, longest_rail = 200.;

    std::string from_to_in_mm(const double begin, const double end)
    {
      return text_in_mm(begin) + " to " + text_in_mm(end) + " mm";
    }

    /// @throws InputError
    void require_size_of_rail(const MeshRail &rail, const LengthUnit unit)
    {
      const auto require_between = [&](const std::string &what, const double size, const double least,
                                       const double largest) {
        require(size >= least && size <= largest,
                "'" + rail.mesh.file + "' is " + text_in_mm(size) + " mm " + what + ", where rails have " +
                  text_in_mm(least) + " to " + text_in_mm(largest) + ": 'Rail/Mesh unit' is " +
                  name_of(unit) + "; is the file in " + (unit == LengthUnit::metre ? "mm" : "m") + "?");
      };
      const auto along = rail.surface.along(), across = rail.surface.lateral();
      const auto up = rail.mesh.range(2);
      require_between("long", along.end - along.begin, shortest_rail, longest_rail);
      require_between("wide on its running surface", across.end - across.begin, narrowest_rail, widest_rail);
      require_between("high", up.end - up.begin, lowest_rail, highest_rail);
    }

    /// Add what is doubtful in the cells on the way of patches from x_begin to x_end to what the file's
    /// reader noted, each as a line about the parameter.
    void note_doubts_about_cells(MeshRail              &rail,
                                 const RunningSurfaces &surfaces,
                                 const double           x_begin,
                                 const double           x_end,
                                 const double           start,
                                 const double           finest_cell_size)
    {
      const double y = tread::first_contact(surfaces, start).y;
      for (const std::string &doubt : rail.doubts_about_cells(
             {x_begin - half_patch, x_end + half_patch, y - half_patch, y + half_patch}, finest_cell_size))
        rail.mesh.doubts.push_back(doubt);
      for (std::string &doubt : rail.mesh.doubts)
        doubt = "'Rail/Mesh file': " + doubt;
    }

    /// By how much the smooth surface differs from its section at the start, along the path and over the
    /// patch's width: 0 where it is the same within the error of the fit.
    double unevenness(const SceneShapes &made, const Scene &scene)
    {
      const double y       = tread::first_contact(made.surfaces, scene.path_begin()).y,
                   y_begin = std::max(-made.surfaces.half_width, y - half_patch),
                   y_end   = std::min(made.surfaces.half_width, y + half_patch);
      const auto   known   = made.rail_mesh->surface.along();
      const double from    = std::max(known.begin, scene.path_begin(scene.last_wheel()) - half_patch),
                   to      = std::min(known.end, scene.meshed_end() + half_patch);
      const int n_along    = std::ceil(std::max(0., to - from) / step_along),
                n_across   = std::ceil((y_end - y_begin) / step_across);
      double largest       = 0.;
      for (int i = 0; i <= n_along; ++i)
        for (int j = 0; j <= n_across; ++j)
          {
            const double x      = from + i * (to - from) / std::max(n_along, 1),
                         across = y_begin + (y_end - y_begin) * j / n_across;
            const auto height   = made.rail_mesh->surface.height(x, across);
            largest = std::max(largest, height ? std::abs(*height - made.surfaces.rail_top(across))
                                               : where_there_is_none);
          }
      return largest > round_off_of_fit ? largest : 0.;
    }

    /// @param file names the mesh
    void check_slice(const Scene &scene, const std::string &file)
    {
      const FacetSurface::Range across = scene.shapes().rail_mesh->surface.across(scene.path_begin(), 0.);
      constexpr double          alike = 1e-6, level = 1e-7; // m
      require(!scene.wheel.is_full() && std::abs(across.end - 0.5 * scene.wheel.sector_width) < alike &&
                std::abs(across.begin + 0.5 * scene.wheel.sector_width) < alike,
              file + "lies between planes of symmetry at y = " + from_to_in_mm(across.begin, across.end) +
                ", between which the wheel must fit: 'Wheel/Shape' sector with 'Sector width (mm)' " +
                text_in_mm(across.end - across.begin) + ", and a rail with its middle at y = 0");
      require(
        scene.wheel.lateral_position == 0.,
        "'Wheel/Lateral position (mm)' must be 0 on a rail between planes of symmetry, which hold the wheel");
      const auto gap = [&](const double share) {
        return scene.shapes().surfaces.gap(share * scene.shapes().surfaces.half_width);
      };
      for (const double share : {-1., -0.5, 0.5, 1.})
        require(std::abs(gap(share) - gap(0.)) < level,
                file +
                  "lies between planes of symmetry, in plane strain: rail and wheel must be level across, "
                  "and their distance changes by " +
                  text_in_mm(std::abs(gap(share) - gap(0.))) + " mm");
    }
  } // namespace


  void shape_mesh_rail(SceneShapes &made, const Scene &scene)
  {
    scene.rail.check();
    const double              unit = scene.rail.mesh_unit == LengthUnit::millimetre ? 1e-3 : 1.;
    std::shared_ptr<MeshRail> own;
    std::vector<std::string>  volumes;
    for (const auto &other : scene.rail.volume_materials())
      volumes.push_back(other.volume);
    try
      {
        own = std::make_shared<MeshRail>(
          read_mesh_file(scene.parameters().located(scene.rail.mesh_file), unit, volumes));
        made.rail_mesh = own;
        require_size_of_rail(*made.rail_mesh, scene.rail.mesh_unit);
      }
    catch (const InputError &error)
      {
        throw InputError(std::string("'Rail/Mesh file': ") + error.what());
      }
    require(!made.defect,
            "'Defect/Shape' " + scene.defect.shape +
              " is laid on a rail of the program's own: with 'Rail/Shape' mesh it must be none, and the "
              "mesh has its own shape");
    const FacetSurface       &surface = made.rail_mesh->surface;
    const double              start   = scene.path_begin();
    const FacetSurface::Range across  = surface.across(start, 0.);
    constexpr double          inside  = 1e-6; // m
    require(std::min(-across.begin, across.end) >= 0.5 * narrowest_rail,
            "'Rail/Mesh file': '" + scene.parameters().located(scene.rail.mesh_file) +
              "' has no contact surface about y = 0 at x = " + text_in_mm(start) +
              " mm, where the wheel begins" +
              (across.begin < across.end ? ", but from y = " + from_to_in_mm(across.begin, across.end) : "") +
              "; it is there for x from " + from_to_in_mm(surface.along().begin, surface.along().end) +
              ": move the mesh, or 'Motion/Start (mm)'");
    const double z = *surface.height(start, 0.);
    require(std::abs(z) <= highest_top, "'Rail/Mesh file': '" +
                                          scene.parameters().located(scene.rail.mesh_file) +
                                          "' has its top at z = " + text_in_mm(z) +
                                          " mm at y = 0 where the wheel "
                                          "begins, x = " +
                                          text_in_mm(start) + " mm; tops of rails lie at z = 0, within " +
                                          text_in_mm(highest_top) + " mm: move the mesh");
    made.surfaces.half_width = std::min({running_half_width, -across.begin - inside, across.end - inside});
    const double fall        = made.rail_mesh->between_planes ? 0. : 1.; // beyond the surface
    made.surfaces.rail_top   = [mesh       = made.rail_mesh, start, fall,
                              half_width = made.surfaces.half_width](const double y) {
      const double              on_rail = std::clamp(y, -half_width, half_width);
      const FacetSurface::Facet facet   = mesh->surface.facet(start, on_rail);
      return facet.z + facet.smooth_above - fall * std::abs(y - on_rail);
    };
    note_doubts_about_cells(*own, made.surfaces, scene.path_begin(scene.last_wheel()), scene.meshed_end(),
                            scene.path_begin(), scene.mesh.finest_cell);
    made.unevenness = unevenness(made, scene);
    if (made.unevenness > 0.)
      made.surfaces.defect = [mesh = made.rail_mesh, top = made.surfaces.rail_top](const double x,
                                                                                   const double y) {
        const auto height = mesh->surface.height(x, y);
        return height ? *height - top(y) : -where_there_is_none;
      };
  }


  std::string uneven_in_words(const Scene &scene)
  {
    return scene.shapes().unevenness < where_there_is_none ? text_in_mm(scene.shapes().unevenness) + " mm"
                                                           : "a gap";
  }


  void check_mesh_rail(const Scene &scene)
  {
    const FacetSurface &surface = scene.shapes().rail_mesh->surface;
    const std::string file = "'Rail/Mesh file': '" + scene.parameters().located(scene.rail.mesh_file) + "' ";
    const double      a    = scene.stance().ellipse(scene.static_load()).semi_axis_x,
                 from = scene.path_begin(scene.last_wheel()) - 3. * a, to = scene.meshed_end() + 3. * a;
    require(surface.along().begin <= from && surface.along().end >= to,
            file + "has a contact surface for x from " +
              from_to_in_mm(surface.along().begin, surface.along().end) +
              "; the path and three semi-axes of the patch at both ends are from " + from_to_in_mm(from, to) +
              ": mesh a longer rail, or change 'Motion/Start (mm)' and 'Rolled distance (mm)'");
    if (scene.shapes().is_between_planes())
      check_slice(scene, file);
    require(std::abs(scene.shapes().first_contact.y) < 0.99 * scene.shapes().surfaces.half_width,
            file + "and the wheel touch at y = " + text_in_mm(scene.shapes().first_contact.y) +
              " mm, at the edge of the contact surface, which is known up to " +
              text_in_mm(scene.shapes().surfaces.half_width) + " mm at both sides where the wheel begins");
    require(scene.shapes().is_between_planes() ||
              std::max(-scene.shapes().patch.begin, scene.shapes().patch.end) + scene.mesh.finest_cell <=
                scene.shapes().surfaces.half_width,
            file + "has a contact surface up to " + text_in_mm(scene.shapes().surfaces.half_width) +
              " mm at both sides where the wheel begins, and the patch under the static load is from y = " +
              from_to_in_mm(scene.shapes().patch.begin, scene.shapes().patch.end) +
              ": name more of it 'contact'");
    // At every wheel's start there is a rail under it: not a gap.
    for (unsigned int wheel = 0; wheel < scene.n_wheels(); ++wheel)
      for (double x = scene.path_begin(wheel) - a; x <= scene.path_begin(wheel) + a; x += step_along)
        require(surface.height(x, scene.shapes().first_contact.y).has_value(),
                file + "has no contact surface at x = " + text_in_mm(x) +
                  " mm, y = " + text_in_mm(scene.shapes().first_contact.y) +
                  " mm, where a wheel begins: move 'Motion/Start (mm)' away from the gap");
  }
} // namespace tread
