// SPDX-License-Identifier: LGPL-2.1-or-later
// What the parameters of several sections have to say to each other.
#include <tread/base/format.h>
#include <tread/mesh/rail_body.h>
#include <tread/reference/hertz.h>
#include <tread/scene/assumptions.h>
#include <tread/scene/checks.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/placed_wheel.h>
#include <tread/scene/recorded.h>
#include <tread/scene/scene.h>
#include <tread/scene/surface_laws.h>
#include <tread/solid/element.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    /// Stiffness damping, in time steps, that levels of time steps need: what dynamics_levels shows to
    /// suffice.
    constexpr double least_damping_of_levels = 0.1;

    /// Places that should be equal may differ by this, m.
    constexpr double round_off = 1e-9;

    /// @param names of the parameters that swing or settle at this rate (1/s), @param part that does
    void require_slow(const double rate, const std::string &names, const std::string &part)
    {
      // A hundred times what the time step of the smallest cells resolves is not what anyone means.
      constexpr double fastest = 1e5; // 1/s
      require(rate <= fastest, names + " swing or settle within " + text_of(1e6 / rate) + " us, which no " +
                                 part + " does; at least " + text_of(1e6 / fastest) + " us are allowed");
    }

    void check_axle(const Scene &scene)
    {
      if (!scene.wheelset.has_flexible_axle())
        return;
      const double wheel_inertia = scene.wheel.moment_of_inertia,
                   of_chord = scene.guidance.yaw_inertia - 2. * FlexibleAxle::about_diameter(wheel_inertia);
      require(of_chord > 0.,
              "'Guidance/Yaw inertia (kg m2)' " + text_of(scene.guidance.yaw_inertia) +
                " is that of the wheelset: on a flexible axle it must be above what both wheels have "
                "about their own diameters, 'Wheel/Moment of inertia (kg m2)' " +
                text_of(wheel_inertia));
      const FlexibleAxle axle({scene.wheelset.axle_torsion, scene.wheelset.axle_bending,
                               scene.wheelset.axle_damping, scene.wheelset.track.wheel_origin()});
      const double       frequency = axle.largest_frequency(wheel_inertia, of_chord),
                   rate            = std::max(frequency, scene.wheelset.axle_damping * frequency * frequency);
      require_slow(rate,
                   "'Wheelset/Axle torsional stiffness (MN m per rad)' and 'Axle bending stiffness (MN m2)', "
                   "which may be 'rigid', and 'Axle damping (us)'",
                   "axle");
    }

    void check_guidance_springs(const Scene &scene)
    {
      const GuidanceSprings &springs = scene.guidance.springs;
      const auto             slow = [](const std::string &names, const double stiffness, const double damping,
                           const double inertia) {
        if (inertia == 0.)
          return;
        require_slow(std::max(std::sqrt(stiffness / inertia), damping / inertia), names, "guidance");
      };
      slow("'Guidance/Lateral stiffness (MN per m)' and 'Lateral damping (kN s per m)'", springs.stiffness,
           springs.damping, scene.wheelset.n_wheels() * scene.wheel.mass);
      slow("'Guidance/Yaw stiffness (MN m per rad)' and 'Yaw damping (kN m s per rad)'",
           springs.yaw_stiffness, springs.yaw_damping, scene.guidance.yaw_inertia);
    }

    void check_suspension(const Scene &scene)
    {
      if (scene.vehicle.sprung_mass == 0.)
        return;
      const double inverse = 1. / scene.wheel.mass + 1. / scene.vehicle.sprung_mass,
                   rate    = std::max(std::sqrt(scene.vehicle.suspension_stiffness * inverse),
                                      scene.vehicle.suspension_damping * inverse);
      require_slow(rate,
                   "'Vehicle/Sprung mass (kg)' " + text_of(scene.vehicle.sprung_mass) +
                     ", 'Suspension stiffness (kN per m)' and 'Suspension damping (N s per m)'",
                   "suspension");
    }

    void check_surfaces(const Scene &scene)
    {
      if (scene.shapes().rail_mesh)
        check_mesh_rail(scene);
      check_rail_ends(scene);
      require(
        std::abs(scene.shapes().first_contact.y) < 0.99 * scene.shapes().surfaces.half_width,
        "wheel and rail touch at y = " + text_in_mm(scene.shapes().first_contact.y) +
          " mm, beside the running surface: change 'Wheel/Tread profile', 'Wheel/Lateral position (mm)' or "
          "'Rail/Inclination'");
      if (const auto &tread = scene.shapes().surfaces.tread_offset)
        {
          // The flange of an upright wheel is cut off where it becomes steeper than 1:1: with the edge that
          // is left it would touch as no wheel does.
          constexpr double beside = 0.5e-3, steepest = 0.5; // m, tangent
          const double     y = scene.shapes().first_contact.y;
          const double     slope =
            std::max(std::abs(tread(y + beside) - tread(y)), std::abs(tread(y) - tread(y - beside))) / beside;
          require(slope <= steepest,
                  "wheel and rail touch at y = " + text_in_mm(y) +
                    " mm, at the root of the flange, where the tread "
                    "is as steep as " +
                    text_of(slope) +
                    ": an upright wheel has no flange; change 'Wheel/Lateral "
                    "position (mm)', or put the wheel into the track by 'Wheelset/Lateral shift (mm)'");
        }
      if (has_narrow_head(scene))
        require(std::max(-scene.shapes().patch.begin, scene.shapes().patch.end) + scene.mesh.finest_cell <=
                  scene.shapes().surfaces.half_width,
                "'Rail/Measured head' ends " + text_in_mm(scene.shapes().surfaces.half_width) +
                  " mm beside its middle, in the patch under the static load or beside it, from y = " +
                  text_in_mm(scene.shapes().patch.begin) + " to " + text_in_mm(scene.shapes().patch.end) +
                  " mm: measure a wider head, or change 'Measured head shift (mm)'");
      if (!scene.rail.is_block() && !scene.shapes().rail_mesh)
        {
          const double reach = scene.rail.standard_profile().head_point(RailHead().contact_half_width)[0];
          require(std::max(-scene.shapes().patch.begin, scene.shapes().patch.end) + scene.mesh.finest_cell <=
                    reach,
                  "the patch under the static load, from y = " + text_in_mm(scene.shapes().patch.begin) +
                    " to " + text_in_mm(scene.shapes().patch.end) +
                    " mm, leaves what of the rail is meshed for contact, up to " + text_in_mm(reach) +
                    " mm from the middle: change 'Wheel/Tread profile', 'Wheel/Lateral position (mm)' or "
                    "'Rail/Inclination'");
        }
      recorded_cells(scene);
    }

    /// That a defect lies on the top of an upright wheel's rail.
    void check_breadth_of_defect(const Scene &scene)
    {
      if (!scene.shapes().defect)
        return;
      const Defect &made = *scene.shapes().defect;
      const double  head = scene.rail.is_block()
                             ? scene.rail.half_width()
                             : scene.rail.standard_profile().head_point(scene.rail.half_width())[0];
      const double  edge = std::isinf(made.width) ? 0. : std::abs(made.y_middle) + 0.5 * made.width;
      require(edge <= head, "the defect reaches to " + text_in_mm(edge) +
                              " mm beside the rail's middle and the top of the head only to " +
                              text_in_mm(head) + " mm: lower 'Defect/Width (mm)' or 'Lateral position (mm)'");
    }

    void check_mesh(const Scene &scene)
    {
      const reference::HertzEllipse ellipse = scene.stance().ellipse(scene.static_load());
      const double                  a = ellipse.semi_axis_x, b = ellipse.semi_axis_y;
      const double                  finest = scene.mesh.finest_cell, largest_finest = 0.45 * std::min(a, b);
      require(finest <= largest_finest,
              "'Mesh/Finest cell (mm)' " + text_in_mm(finest) + " is too large for a patch of semi-axes " +
                text_in_mm(a) + " and " + text_in_mm(b) + " mm; at most " + text_in_mm(largest_finest));
      require(fine_half_width(scene) >= needed_half_width(scene) * (1. - 1e-9),
              "'Mesh/Fine half width (mm)' " + text_in_mm(fine_half_width(scene)) +
                " must hold the patch from y = " + text_in_mm(scene.shapes().patch.begin) + " to " +
                text_in_mm(scene.shapes().patch.end) + " mm; at least " +
                text_in_mm(needed_half_width(scene)));
      const double longest = 0.7 * a;
      require(scene.mesh.path_cell <= longest,
              "'Mesh/Path cell (mm)' " + text_in_mm(scene.mesh.path_cell) +
                " is too large for a patch with a semi-axis of " + text_in_mm(a) +
                " mm along the path, whose force it would make ripple; at most " + text_in_mm(longest));
      require(scene.rail.is_meshed() || scene.rail.margin >= 3. * a,
              "'Rail/Margin (mm)' " + text_in_mm(scene.rail.margin) +
                " lets the wheel leave the rail; at least three semi-axes, " + text_in_mm(3. * a));
      require(scene.wheel.is_full() || scene.wheel.sector_margin >= 3. * a,
              "'Wheel/Sector margin (mm)' " + text_in_mm(scene.wheel.sector_margin) +
                " lets the contact leave the sector; at least three semi-axes, " + text_in_mm(3. * a));
      check_window(scene);

      // Around the finest cells there is room for at least one more, if the rail does not go on as its image.
      const double beside = std::abs(path_y(scene));
      require(scene.shapes().is_between_planes() ||
                beside + fine_half_width(scene) <= scene.rail_half_width() - finest,
              "'Mesh/Fine half width (mm)' " + text_in_mm(fine_half_width(scene)) +
                (beside > 0. ? " about y = " + text_in_mm(path_y(scene)) + " mm" : "") +
                " must be below the half width of the rail; at most " +
                text_in_mm(scene.rail_half_width() - finest - beside));
      require(scene.shapes().is_between_planes() ||
                beside + fine_half_width(scene) <= scene.wheel.half_width() - finest,
              "'Mesh/Fine half width (mm)' " + text_in_mm(fine_half_width(scene)) +
                " must be below half of the wheel's width; at most " +
                text_in_mm(scene.wheel.half_width() - finest - beside));
      const double thickness = std::min(scene.rail_thickness(), scene.wheel.thickness());
      require((scene.mesh.fine_layers + 1) * finest <= thickness * (1. + 1e-9),
              "'Mesh/Fine layers' " + std::to_string(scene.mesh.fine_layers) +
                " of 'Mesh/Finest cell (mm)' " + text_in_mm(finest) +
                " do not fit into rail and wheel; at most " +
                std::to_string(std::max(0, static_cast<int>(thickness / finest * (1. + 1e-9)) - 1)));
      const Scene::Range fine = cubes(scene);
      require(scene.mesh.fine_from == scene.mesh.fine_to ||
                (fine.begin < scene.rail_end() && fine.end > scene.rail_begin()),
              "'Mesh/Fine from (mm)' to 'Fine to (mm)', from the defect's leading edge at " +
                text_in_mm(scene.defect.position) + " mm, must lie on the rail from " +
                text_in_mm(scene.rail_begin()) + " to " + text_in_mm(scene.rail_end()) +
                " mm at least in part");
    }
  } // namespace


  void check_rail_ends(const Scene &scene)
  {
    // A mesh ends where its own surface does, which has no margin of its own.
    const double margin = scene.shapes().rail_mesh ? 0. : scene.rail.margin;
    const double from = scene.path_begin(scene.last_wheel()) - margin, to = scene.meshed_end() + margin;
    require(scene.rail_begin() <= from + round_off && scene.rail_end() >= to - round_off,
            "the rail, by 'Rail/Begin (mm)' and 'Length (mm)' from " + text_in_mm(scene.rail_begin()) +
              " to " + text_in_mm(scene.rail_end()) +
              " mm, must hold the path and 'Rail/Margin (mm)' at both ends, from " + text_in_mm(from) +
              " to " + text_in_mm(to) + " mm");
  }


  void check_defect(const Scene &scene)
  {
    if (!scene.shapes().defect)
      return;
    const Defect       &made = *scene.shapes().defect;
    std::vector<double> begins(made.repeated_at);
    begins.push_back(made.begin);
    std::sort(begins.begin(), begins.end());
    for (std::size_t k = 0; k < begins.size(); ++k)
      {
        const double      begin = begins[k], end = begin + made.length, before = begins[k > 0 ? k - 1 : 0];
        const std::string which =
          begin == made.begin ? "'Defect/Position (mm)' " : "'Defect/Repeated at (mm)' ";
        require(begin >= scene.rail_begin() && end <= scene.rail_end(),
                "the defect, from " + which + text_in_mm(begin) + " to " + text_in_mm(end) +
                  " mm, lies outside the rail, which is from " + text_in_mm(scene.rail_begin()) + " to " +
                  text_in_mm(scene.rail_end()) + " mm");
        require(k == 0 || begin >= before + made.length - round_off,
                "'Defect/Repeated at (mm)': the defects from " + text_in_mm(before) + " and " +
                  text_in_mm(begin) + " mm overlap, being " + text_in_mm(made.length) + " mm long");
        const Scene::Range fine = cubes(scene);
        require(begin == made.begin || is_finest(scene, begin, end),
                "'Defect/Repeated at (mm)' " + text_in_mm(begin) +
                  " lies outside the cubes of 'Mesh/Fine from (mm)' to 'Fine to (mm)', from " +
                  text_in_mm(fine.begin) + " to " + text_in_mm(fine.end) + " mm");
      }
    constexpr double cells_of_ramp = 4.;
    require(scene.defect.ramp == 0. || scene.defect.ramp >= cells_of_ramp * scene.mesh.finest_cell,
            "'Defect/Ramp (mm)' " + text_in_mm(scene.defect.ramp) +
              " is a step between the nodes; at least " + text_in_mm(cells_of_ramp * scene.mesh.finest_cell) +
              ", four times 'Mesh/Finest cell (mm)', or 0 for none");
    if (scene.defect.shape == "corrugation")
      {
        // Six nodes a wave: fewer make another one of it.
        constexpr double cells_of_wave = 6.;
        const double     cell          = is_finest(scene, made.begin, made.begin + made.length)
                                           ? scene.mesh.finest_cell
                                           : std::max(scene.mesh.finest_cell, scene.mesh.path_cell);
        require(scene.defect.wavelength >= cells_of_wave * cell,
                "'Defect/Wavelength (mm)' " + text_in_mm(scene.defect.wavelength) +
                  " is lost between cells of " + text_in_mm(cell) + " mm along the path; at least " +
                  text_in_mm(cells_of_wave * cell) +
                  ", or finer cells by 'Mesh/Finest cell (mm)', 'Path cell (mm)', 'Fine from (mm)' and 'Fine "
                  "to (mm)'");
      }
    const char *of_width = scene.defect.width > 0. ? "'Defect/Width (mm)'" : "'Defect/Length (mm)'";
    for (const auto &[name, size] :
         {std::pair("'Defect/Length (mm)'", made.length), std::pair(of_width, made.width)})
      require(size >= 2. * scene.mesh.finest_cell,
              std::string(name) + " " + text_in_mm(size) +
                " is lost between the nodes; at least twice 'Mesh/Finest cell (mm)', " +
                text_in_mm(2. * scene.mesh.finest_cell));
  }


  void check_ratcheting(const Scene &scene)
  {
    const bool fails = scene.ratcheting.strain_at_failure > 0.;
    if (!fails && !scene.ratcheting.jumps && !scene.ratcheting.uniform)
      return;
    const std::string name = fails                    ? "'Ratcheting/Strain at failure (%)'"
                             : scene.ratcheting.jumps ? "'Ratcheting/Jumps'"
                                                      : "'Ratcheting/Uniform rail'";
    require(scene.motion.passages > 1, name + " needs several 'Motion/Passages'");
    require(scene.rail.material.yield_stress > 0. || !scene.rail.material.plastic_zones.empty(),
            name + " needs a rail that yields: 'Rail/Yield stress (MPa)'");
    require(
      !scene.ratcheting.uniform ||
        (!scene.is_positioned() && !scene.shapes().defect && !scene.rail.is_meshed() &&
         scene.n_wheels() == 1 && scene.rail.material.plastic_zones.empty()),
      "'Ratcheting/Uniform rail' needs one wheel that stands upright and a rail that is alike along its "
      "length: no defect, mesh file, slices or plastic zones");
    if (!scene.ratcheting.jumps)
      return;
    require(!scene.damage.record,
            "'Ratcheting/Jumps' cannot be had with 'Damage/Record', which sums what is rolled");
    require(scene.ratcheting.rolled_between < scene.motion.passages,
            "'Ratcheting/Rolled between jumps' " + std::to_string(scene.ratcheting.rolled_between) +
              " must be below 'Motion/Passages', " + std::to_string(scene.motion.passages));
  }


  void check_motion(const Scene &scene)
  {
    require(scene.solid.mass_damping == 0. || scene.general.quasi_static,
            "'Solid/Mass damping (1 per s)' must be 0 when 'Scene/Quasi-static' is false: it slows waves "
            "that are part of the answer");
    constexpr double largest_inertia_error = 0.02;
    require(inertia_error_estimate(scene) <= largest_inertia_error || !scene.general.quasi_static,
            "'Scene/Density scale' " + text_of(scene.general.density_scale) + " at " +
              text_of(3.6 * scene.motion.speed) + " km/h makes an inertia error of about " +
              text_of(100. * inertia_error_estimate(scene)) + " %; at most " +
              text_of(100. * largest_inertia_error) + " % is allowed");
    scene.contact.check();
    check_friction_by_temperature(scene);
    scene.motion.check();
    require(scene.time_stepping.least_step == 0. || scene.general.density_scale == 1.,
            "'Time stepping/Least step (us)' cannot be had with 'Scene/Density scale' " +
              text_of(scene.general.density_scale) + ", which makes the steps of all cells longer");
    require(scene.static_load() > 0.,
            "'Vehicle/Gravity (m per s2)' must be above 0: nothing loads the contact");
    check_suspension(scene);
    check_guidance_springs(scene);
    check_axle(scene);
    for (unsigned int k = 0; k < scene.n_wheels(); ++k)
      if (const double traction = scene.traction_coefficient(k);
          traction != 0. &&
          (scene.motion.drive == Drive::torque || !(scene.is_positioned() || scene.motion.creepage)))
        {
          const double factor = scene.contact.varies_across() ? mean_factor_across(scene) : 1.,
                       limit  = scene.contact.friction_coefficient *
                               scene.contact.friction_factor(scene.path_begin(k)) * factor;
          require(std::abs(traction) < limit,
                  (k == 0 ? "'Motion/Traction coefficient' " : "'Further wheels/Traction coefficients' ") +
                    text_of(traction) + " must be below 'Contact/Friction coefficient' " + text_of(limit) +
                    " in size where the wheel begins" +
                    (factor != 1. ? ", with a mean factor of " + text_of(factor) + " across its patch" : ""));
        }
    friction_law(scene);
  }


  void check_peak_stress(const Scene &scene)
  {
    if (!scene.peak_stress.is_wanted())
      return;
    const Scene::Range region = peak_range(scene);
    if (scene.peak_stress.place == PeakPlace::range)
      require(scene.peak_stress.from < scene.peak_stress.to,
              "'Peak stress/From (mm)' " + text_in_mm(scene.peak_stress.from) + " must be below 'To (mm)', " +
                text_in_mm(scene.peak_stress.to));
    // A wheelset in a position touches ahead of its axle or behind it, on slices on one piece after the
    // other.
    const auto  on_path = scene.stance().paths();
    std::string where;
    for (const WheelStance::Path &path : on_path)
      where += (where.empty() ? "" : ", or ") + (path.name.empty() ? "" : path.name + " ") + "from " +
               text_in_mm(path.begin) + " to " + text_in_mm(path.end) + " mm";
    require(std::any_of(on_path.begin(), on_path.end(),
                        [&](const WheelStance::Path &path) {
                          return region.begin >= path.begin && region.end <= path.end;
                        }),
            "the region of 'Peak stress', from " + text_in_mm(region.begin) + " to " +
              text_in_mm(region.end) + " mm, must lie on the path of the first wheel, which is " + where);
    const Scene::Range fine = cubes(scene);
    require(
      is_finest(scene, region.begin, region.end),
      "the region of 'Peak stress', from " + text_in_mm(region.begin) + " to " + text_in_mm(region.end) +
        " mm, must lie among the finest cells, which 'Mesh/Fine from (mm)' and 'Fine to (mm)' put from " +
        text_in_mm(fine.begin) + " to " + text_in_mm(fine.end) + " mm");
    require(scene.peak_stress.depth >= 2. * scene.mesh.finest_cell,
            "'Peak stress/Depth (mm)' " + text_in_mm(scene.peak_stress.depth) +
              " does not hold the two layers of cells from which the stress at the surface follows; at least "
              "twice 'Mesh/Finest cell (mm)', " +
              text_in_mm(2. * scene.mesh.finest_cell));
    if (scene.peak_stress.place == PeakPlace::trailing_edge && scene.shapes().defect)
      {
        const Defect &made = *scene.shapes().defect;
        const double  off  = std::abs(made.y_middle - scene.stance().patch_y()) - peak_half_width(scene);
        require(
          off < 0.5 * made.width,
          "the region of 'Peak stress' does not meet the defect, whose 'Defect/Lateral position (mm)' is " +
            text_in_mm(made.y_middle) + " and whose width is " + text_in_mm(made.width) +
            ": make 'Peak stress/Half width (mm)' larger than " + text_in_mm(peak_half_width(scene)));
      }
    const double widest = std::min(scene.rail_half_width(), scene.wheel.half_width());
    require(scene.peak_stress.half_width <= widest,
            "'Peak stress/Half width (mm)' " + text_in_mm(scene.peak_stress.half_width) +
              " exceeds that of rail or wheel, " + text_in_mm(widest));
  }


  void check_window(const Scene &scene)
  {
    if (!has_window(scene))
      return;
    const double a     = scene.stance().ellipse(scene.static_load()).semi_axis_x,
                 least = 1.25 * a + 2. * scene.mesh.finest_cell;
    require(window_margin(scene) >= least * (1. - 1e-9),
            "'Mesh/Window margin (mm)' " + text_in_mm(scene.mesh.window_margin) +
              " must hold the patch and a quarter of it more; at least " + text_in_mm(least));
    constexpr double shortest = 4.; // cells: a change costs more than so short a way
    require(scene.motion.rolled_distance <= usual_window(scene) ||
              usual_window(scene) >= shortest * scene.mesh.finest_cell * (1. - 1e-9),
            "'Mesh/Window length (mm)' " + text_in_mm(scene.mesh.window_length) +
              " must be at least four cells, " + text_in_mm(shortest * scene.mesh.finest_cell));
    const std::string keeps = keeps_mesh(scene);
    require(keeps.empty(), "'Mesh/Window' cannot be had with " + keeps + ": its mesh must stay");
  }


  void check_plasticity(const Scene &scene)
  {
    const bool   alike  = scene.is_positioned(); // both bodies are blocks of one size
    const double beside = alike ? 0. : std::abs(path_y(scene));
    for (const bool of_wheel : {true, false})
      {
        const std::string      section  = of_wheel ? "Wheel" : "Rail";
        const MaterialSection &material = of_wheel ? scene.wheel.material : scene.rail.material;
        require((material.plastic_zones.empty() && material.yield_stress == 0.) ||
                  (element_named(scene.solid.element).can_yield && !scene.solid.has_bulk_viscosity()),
                "'" + section + "/Yield stress (MPa)' needs 'Solid/Element' one-point and no bulk viscosity");
        material.check(
          section,
          of_wheel
            ? MaterialSection::Meshed{scene.wheel.thickness(), scene.wheel.half_width() - beside,
                                      meshed_arc(scene).begin, meshed_arc(scene).end}
            : MaterialSection::Meshed{alike ? scene.wheel.thickness() : scene.rail_thickness(),
                                      (alike ? scene.wheel.half_width() : scene.rail_half_width()) - beside,
                                      scene.rail_begin(), scene.rail_end()});
      }
  }


  void check_numerics(const Scene &scene)
  {
    const auto needs_inertia = [&](const std::string &cause) {
      require(scene.general.density_scale == 1., "'Scene/Density scale' must be 1 with " + cause +
                                                   ": the inertia of the cells is part of the answer");
      require(scene.solid.mass_damping == 0., "'Solid/Mass damping (1 per s)' must be 0 with " + cause +
                                                ": it slows motion that is part of the answer");
    };
    if (scene.shapes().defect)
      needs_inertia("'Defect/Shape' " + scene.defect.shape);
    if (!scene.shapes().is_round())
      needs_inertia("'Wheel/Deviation'");
    if (scene.shapes().has_uneven_mesh())
      needs_inertia("a 'Rail/Mesh file' whose running surface changes along the path by " +
                    uneven_in_words(scene));
    if (scene.track.foundation != Foundation::rigid)
      needs_inertia("'Track/Foundation' " + name_of(scene.track.foundation));
    const double largest_ratio = element_named(scene.solid.element).largest_poisson_ratio;
    for (const auto &[body, material] :
         {std::pair("Wheel", &scene.wheel.material), std::pair("Rail", &scene.rail.material)})
      require(material->elastic().poisson_ratio <= largest_ratio,
              "'Solid/Element' " + scene.solid.element + " locks at '" + body + "/Poisson's ratio' " +
                text_of(material->elastic().poisson_ratio) + "; at most " + text_of(largest_ratio));
    require(scene.time_stepping.levels == 1 || scene.solid.stiffness_damping >= least_damping_of_levels,
            "'Time stepping/Levels' " + std::to_string(scene.time_stepping.levels) +
              " needs 'Solid/Stiffness damping (time steps)' of at least " +
              text_of(least_damping_of_levels) + ": levels of time steps resonate without it");
  }


  bool has_narrow_head(const Scene &scene)
  {
    return !scene.rail.measured_head.empty() && scene.shapes().surfaces.half_width < running_half_width;
  }


  void check_sections(const Scene &scene, const SceneUse use)
  {
    wear_law(scene); // which says what is wrong with its numbers
    indices_of_damage(scene);
    constexpr double softest = 1e6; // Pa
    require(scene.damage.shear_strength == 0. || scene.damage.shear_strength >= softest,
            "'Damage/Shear strength (MPa)' " + text_of(1e-6 * scene.damage.shear_strength) +
              " is below that of any metal; 0 where it is not known, or at least 1");
    if (scene.is_positioned())
      {
        require(use == SceneUse::roll || scene.motion.drive != Drive::torque,
                "'Motion/Drive' cannot be torque where 'Wheelset' has a position and half-space theory "
                "answers: it takes the creepage that is given");
        return check_wheelset(scene);
      }
    require(scene.guidance.kind == Guidance::rigid,
            "'Guidance/Kind' " + name_of(scene.guidance.kind) +
              " moves a wheelset in its track: 'Wheelset/Lateral shift (mm)' puts it there");
    require(!scene.rail.is_sliced(),
            "'Rail/Shape' slices is for a wheel in a position of its wheelset: 'Wheelset/Lateral "
            "shift (mm)' puts it there");
    scene.general.check();
    check_motion(scene);
    scene.rail.check();
    check_surfaces(scene);
    scene.wheel.check();
    scene.further_wheels.check(2. * scene.wheel.radius);
    if (use == SceneUse::half_space)
      return;
    check_defect(scene);
    check_breadth_of_defect(scene);
    check_peak_stress(scene);
    scene.mesh.check();
    check_mesh(scene);
    check_track(scene);
    scene.solid.check();
    check_plasticity(scene);
    check_ratcheting(scene);
    check_numerics(scene);
  }
} // namespace tread
