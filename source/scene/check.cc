// SPDX-License-Identifier: LGPL-2.1-or-later
// What the parameters of several sections have to say to each other.
#include <tread/base/registry.h>
#include <tread/mesh/rail_body.h>
#include <tread/reference/hertz.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/placed_wheel.h>
#include <tread/scene/scene.h>
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
  } // namespace


  void Scene::check(const SceneUse use) const
  {
    wear_law(); // which says what is wrong with its numbers
    indices_of_damage();
    constexpr double softest = 1e6; // Pa
    require(damage.shear_strength == 0. || damage.shear_strength >= softest,
            "'Damage/Shear strength (MPa)' " + text_of(1e-6 * damage.shear_strength) +
              " is below that of any metal; 0 where it is not known, or at least 1");
    if (is_positioned())
      {
        require(use == SceneUse::roll || motion.drive != Drive::torque,
                "'Motion/Drive' cannot be torque where 'Wheelset' has a position and half-space theory "
                "answers: it takes the creepage that is given");
        return check_wheelset();
      }
    require(guidance.kind == Guidance::rigid,
            "'Guidance/Kind' " + name_of(guidance.kind) +
              " moves a wheelset in its track: 'Wheelset/Lateral shift (mm)' puts it there");
    require(!rail.is_sliced(),
            "'Rail/Shape' slices is for a wheel in a position of its wheelset: 'Wheelset/Lateral "
            "shift (mm)' puts it there");
    general.check();
    check_motion();
    rail.check();
    check_surfaces();
    wheel.check();
    further_wheels.check(2. * wheel.radius);
    if (use == SceneUse::half_space)
      return;
    check_defect();
    check_peak_stress();
    mesh.check();
    check_mesh();
    check_track();
    solid.check();
    check_plasticity();
    check_ratcheting();
    check_numerics();
  }


  void Scene::check_motion() const
  {
    require(solid.mass_damping == 0. || general.quasi_static,
            "'Solid/Mass damping (1 per s)' must be 0 when 'Scene/Quasi-static' is false: it slows waves "
            "that are part of the answer");
    constexpr double largest_inertia_error = 0.02;
    require(inertia_error_estimate() <= largest_inertia_error || !general.quasi_static,
            "'Scene/Density scale' " + text_of(general.density_scale) + " at " + text_of(3.6 * motion.speed) +
              " km/h makes an inertia error of about " + text_of(100. * inertia_error_estimate()) +
              " %; at most " + text_of(100. * largest_inertia_error) + " % is allowed");
    contact.check();
    check_friction_by_temperature();
    motion.check();
    require(time_stepping.least_step == 0. || general.density_scale == 1.,
            "'Time stepping/Least step (us)' cannot be had with 'Scene/Density scale' " +
              text_of(general.density_scale) + ", which makes the steps of all cells longer");
    require(static_load() > 0., "'Vehicle/Gravity (m per s2)' must be above 0: nothing loads the contact");
    check_suspension();
    check_guidance_springs();
    check_axle();
    for (unsigned int k = 0; k < n_wheels(); ++k)
      if (const double traction = traction_coefficient(k);
          traction != 0. && (motion.drive == Drive::torque || !(is_positioned() || motion.creepage)))
        {
          const double factor = contact.varies_across() ? mean_factor_across() : 1.,
                       limit = contact.friction_coefficient * contact.friction_factor(path_begin(k)) * factor;
          require(std::abs(traction) < limit,
                  (k == 0 ? "'Motion/Traction coefficient' " : "'Further wheels/Traction coefficients' ") +
                    text_of(traction) + " must be below 'Contact/Friction coefficient' " + text_of(limit) +
                    " in size where the wheel begins" +
                    (factor != 1. ? ", with a mean factor of " + text_of(factor) + " across its patch" : ""));
        }
    friction_law();
  }


  namespace
  {
    /// @param names of the parameters that swing or settle at this rate (1/s), @param part that does
    void require_slow(const double rate, const std::string &names, const std::string &part)
    {
      // A hundred times what the time step of the smallest cells resolves is not what anyone means.
      constexpr double fastest = 1e5; // 1/s
      require(rate <= fastest, names + " swing or settle within " + text_of(1e6 / rate) + " us, which no " +
                                 part + " does; at least " + text_of(1e6 / fastest) + " us are allowed");
    }
  } // namespace


  void Scene::check_axle() const
  {
    if (!wheelset.has_flexible_axle())
      return;
    const double wheel_inertia = wheel.moment_of_inertia,
                 of_chord      = guidance.yaw_inertia - 2. * FlexibleAxle::about_diameter(wheel_inertia);
    require(of_chord > 0.,
            "'Guidance/Yaw inertia (kg m2)' " + text_of(guidance.yaw_inertia) +
              " is that of the wheelset: on a flexible axle it must be above what both wheels have "
              "about their own diameters, 'Wheel/Moment of inertia (kg m2)' " +
              text_of(wheel_inertia));
    const FlexibleAxle axle(
      {wheelset.axle_torsion, wheelset.axle_bending, wheelset.axle_damping, wheelset.track.wheel_origin()});
    const double frequency = axle.largest_frequency(wheel_inertia, of_chord),
                 rate      = std::max(frequency, wheelset.axle_damping * frequency * frequency);
    require_slow(rate,
                 "'Wheelset/Axle torsional stiffness (MN m per rad)' and 'Axle bending stiffness (MN m2)', "
                 "which may be 'rigid', and 'Axle damping (us)'",
                 "axle");
  }


  void Scene::check_guidance_springs() const
  {
    const GuidanceSprings &springs = guidance.springs;
    const auto             slow = [](const std::string &names, const double stiffness, const double damping,
                         const double inertia) {
      if (inertia == 0.)
        return;
      require_slow(std::max(std::sqrt(stiffness / inertia), damping / inertia), names, "guidance");
    };
    slow("'Guidance/Lateral stiffness (MN per m)' and 'Lateral damping (kN s per m)'", springs.stiffness,
         springs.damping, wheelset.n_wheels() * wheel.mass);
    slow("'Guidance/Yaw stiffness (MN m per rad)' and 'Yaw damping (kN m s per rad)'", springs.yaw_stiffness,
         springs.yaw_damping, guidance.yaw_inertia);
  }


  void Scene::check_suspension() const
  {
    if (vehicle.sprung_mass == 0.)
      return;
    const double inverse = 1. / wheel.mass + 1. / vehicle.sprung_mass,
                 rate    = std::max(std::sqrt(vehicle.suspension_stiffness * inverse),
                                    vehicle.suspension_damping * inverse);
    require_slow(rate,
                 "'Vehicle/Sprung mass (kg)' " + text_of(vehicle.sprung_mass) +
                   ", 'Suspension stiffness (kN per m)' and 'Suspension damping (N s per m)'",
                 "suspension");
  }


  void Scene::check_surfaces() const
  {
    if (rail_mesh())
      check_mesh_rail();
    // A mesh ends where its own surface does, which has no margin of its own.
    const double margin = rail_mesh() ? 0. : rail.margin;
    const double from = path_begin(last_wheel()) - margin, to = meshed_end() + margin;
    require(rail_begin() <= from + round_off && rail_end() >= to - round_off,
            "the rail, by 'Rail/Begin (mm)' and 'Length (mm)' from " + text_in_mm(rail_begin()) + " to " +
              text_in_mm(rail_end()) + " mm, must hold the path and 'Rail/Margin (mm)' at both ends, from " +
              text_in_mm(from) + " to " + text_in_mm(to) + " mm");
    require(
      std::abs(first_contact().y) < 0.99 * surfaces().half_width,
      "wheel and rail touch at y = " + text_in_mm(first_contact().y) +
        " mm, beside the running surface: change 'Wheel/Tread profile', 'Wheel/Lateral position (mm)' or "
        "'Rail/Inclination'");
    if (const auto &tread = surfaces().tread_offset)
      {
        // The flange of an upright wheel is cut off where it becomes steeper than 1:1: with the edge that is
        // left it would touch as no wheel does.
        constexpr double beside = 0.5e-3, steepest = 0.5; // m, tangent
        const double     y = first_contact().y;
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
    if (has_narrow_head())
      require(std::max(-patch_extent().begin, patch_extent().end) + mesh.finest_cell <= surfaces().half_width,
              "'Rail/Measured head' ends " + text_in_mm(surfaces().half_width) +
                " mm beside its middle, in the patch under the static load or beside it, from y = " +
                text_in_mm(patch_extent().begin) + " to " + text_in_mm(patch_extent().end) +
                " mm: measure a wider head, or change 'Measured head shift (mm)'");
    if (!rail.is_block() && !rail_mesh())
      {
        const double reach = rail.standard_profile().head_point(RailHead().contact_half_width)[0];
        require(std::max(-patch_extent().begin, patch_extent().end) + mesh.finest_cell <= reach,
                "the patch under the static load, from y = " + text_in_mm(patch_extent().begin) + " to " +
                  text_in_mm(patch_extent().end) +
                  " mm, leaves what of the rail is meshed for contact, up to " + text_in_mm(reach) +
                  " mm from the middle: change 'Wheel/Tread profile', 'Wheel/Lateral position (mm)' or "
                  "'Rail/Inclination'");
      }
    recorded_cells();
  }


  void Scene::check_defect() const
  {
    if (!shapes->defect)
      return;
    const Defect       &made = *shapes->defect;
    std::vector<double> begins(made.repeated_at);
    begins.push_back(made.begin);
    std::sort(begins.begin(), begins.end());
    for (std::size_t k = 0; k < begins.size(); ++k)
      {
        const double      begin = begins[k], end = begin + made.length, before = begins[k > 0 ? k - 1 : 0];
        const std::string which =
          begin == made.begin ? "'Defect/Position (mm)' " : "'Defect/Repeated at (mm)' ";
        require(begin >= rail_begin() && end <= rail_end(),
                "the defect, from " + which + text_in_mm(begin) + " to " + text_in_mm(end) +
                  " mm, lies outside the rail, which is from " + text_in_mm(rail_begin()) + " to " +
                  text_in_mm(rail_end()) + " mm");
        require(k == 0 || begin >= before + made.length - round_off,
                "'Defect/Repeated at (mm)': the defects from " + text_in_mm(before) + " and " +
                  text_in_mm(begin) + " mm overlap, being " + text_in_mm(made.length) + " mm long");
        const Range fine = cubes();
        require(begin == made.begin || is_finest(begin, end),
                "'Defect/Repeated at (mm)' " + text_in_mm(begin) +
                  " lies outside the cubes of 'Mesh/Fine from (mm)' to 'Fine to (mm)', from " +
                  text_in_mm(fine.begin) + " to " + text_in_mm(fine.end) + " mm");
      }
    constexpr double cells_of_ramp = 4.;
    require(defect.ramp == 0. || defect.ramp >= cells_of_ramp * mesh.finest_cell,
            "'Defect/Ramp (mm)' " + text_in_mm(defect.ramp) + " is a step between the nodes; at least " +
              text_in_mm(cells_of_ramp * mesh.finest_cell) +
              ", four times 'Mesh/Finest cell (mm)', or 0 for none");
    if (defect.shape == "corrugation")
      {
        // Six nodes a wave: fewer make another one of it.
        constexpr double cells_of_wave = 6.;
        const double     cell          = is_finest(made.begin, made.begin + made.length)
                                           ? mesh.finest_cell
                                           : std::max(mesh.finest_cell, mesh.path_cell);
        require(defect.wavelength >= cells_of_wave * cell,
                "'Defect/Wavelength (mm)' " + text_in_mm(defect.wavelength) + " is lost between cells of " +
                  text_in_mm(cell) + " mm along the path; at least " + text_in_mm(cells_of_wave * cell) +
                  ", or finer cells by 'Mesh/Finest cell (mm)', 'Path cell (mm)', 'Fine from (mm)' and 'Fine "
                  "to (mm)'");
      }
    const char *of_width = defect.width > 0. ? "'Defect/Width (mm)'" : "'Defect/Length (mm)'";
    for (const auto &[name, size] :
         {std::pair("'Defect/Length (mm)'", made.length), std::pair(of_width, made.width)})
      require(size >= 2. * mesh.finest_cell,
              std::string(name) + " " + text_in_mm(size) +
                " is lost between the nodes; at least twice 'Mesh/Finest cell (mm)', " +
                text_in_mm(2. * mesh.finest_cell));
    const double head =
      rail.is_block() ? rail.half_width() : rail.standard_profile().head_point(rail.half_width())[0];
    const double edge = std::isinf(made.width) ? 0. : std::abs(made.y_middle) + 0.5 * made.width;
    require(edge <= head, "the defect reaches to " + text_in_mm(edge) +
                            " mm beside the rail's middle and the top of the head only to " +
                            text_in_mm(head) + " mm: lower 'Defect/Width (mm)' or 'Lateral position (mm)'");
  }


  void Scene::check_peak_stress() const
  {
    if (!peak_stress.is_wanted())
      return;
    const Range region = peak_range();
    if (peak_stress.place == PeakPlace::range)
      require(peak_stress.from < peak_stress.to, "'Peak stress/From (mm)' " + text_in_mm(peak_stress.from) +
                                                   " must be below 'To (mm)', " + text_in_mm(peak_stress.to));
    // A wheelset in a position touches ahead of its axle or behind it, on slices on one piece after the
    // other.
    const double half_cell = 0.5 * mesh.finest_cell;
    const auto   on_path =
      is_positioned()
          ? placed_wheel().paths()
          : std::vector<PlacedWheel::Path>{{nullptr, "", path_begin(), path_end() + half_cell, 0., 0.}};
    std::string where;
    for (const PlacedWheel::Path &path : on_path)
      where += (where.empty() ? "" : ", or ") + (path.name.empty() ? "" : path.name + " ") + "from " +
               text_in_mm(path.begin) + " to " + text_in_mm(path.end) + " mm";
    require(std::any_of(on_path.begin(), on_path.end(),
                        [&](const PlacedWheel::Path &path) {
                          return region.begin >= path.begin && region.end <= path.end;
                        }),
            "the region of 'Peak stress', from " + text_in_mm(region.begin) + " to " +
              text_in_mm(region.end) + " mm, must lie on the path of the first wheel, which is " + where);
    const Range fine = cubes();
    require(
      is_finest(region.begin, region.end),
      "the region of 'Peak stress', from " + text_in_mm(region.begin) + " to " + text_in_mm(region.end) +
        " mm, must lie among the finest cells, which 'Mesh/Fine from (mm)' and 'Fine to (mm)' put from " +
        text_in_mm(fine.begin) + " to " + text_in_mm(fine.end) + " mm");
    require(peak_stress.depth >= 2. * mesh.finest_cell,
            "'Peak stress/Depth (mm)' " + text_in_mm(peak_stress.depth) +
              " does not hold the two layers of cells from which the stress at the surface follows; at least "
              "twice 'Mesh/Finest cell (mm)', " +
              text_in_mm(2. * mesh.finest_cell));
    if (peak_stress.place == PeakPlace::trailing_edge && shapes->defect)
      {
        const Defect &made = *shapes->defect;
        const double  off  = std::abs(made.y_middle - first_contact().y) - peak_half_width();
        require(
          off < 0.5 * made.width,
          "the region of 'Peak stress' does not meet the defect, whose 'Defect/Lateral position (mm)' is " +
            text_in_mm(made.y_middle) + " and whose width is " + text_in_mm(made.width) +
            ": make 'Peak stress/Half width (mm)' larger than " + text_in_mm(peak_half_width()));
      }
    const double widest = std::min(rail_half_width(), wheel.half_width());
    require(peak_stress.half_width <= widest, "'Peak stress/Half width (mm)' " +
                                                text_in_mm(peak_stress.half_width) +
                                                " exceeds that of rail or wheel, " + text_in_mm(widest));
  }


  void Scene::check_mesh() const
  {
    const reference::HertzEllipse ellipse = hertz(*this, static_load());
    const double                  a = ellipse.semi_axis_x, b = ellipse.semi_axis_y;
    const double                  finest = mesh.finest_cell, largest_finest = 0.45 * std::min(a, b);
    require(finest <= largest_finest, "'Mesh/Finest cell (mm)' " + text_in_mm(finest) +
                                        " is too large for a patch of semi-axes " + text_in_mm(a) + " and " +
                                        text_in_mm(b) + " mm; at most " + text_in_mm(largest_finest));
    require(fine_half_width() >= needed_half_width() * (1. - 1e-9),
            "'Mesh/Fine half width (mm)' " + text_in_mm(fine_half_width()) +
              " must hold the patch from y = " + text_in_mm(patch_extent().begin) + " to " +
              text_in_mm(patch_extent().end) + " mm; at least " + text_in_mm(needed_half_width()));
    const double longest = 0.7 * a;
    require(mesh.path_cell <= longest, "'Mesh/Path cell (mm)' " + text_in_mm(mesh.path_cell) +
                                         " is too large for a patch with a semi-axis of " + text_in_mm(a) +
                                         " mm along the path, whose force it would make ripple; at most " +
                                         text_in_mm(longest));
    require(rail.is_meshed() || rail.margin >= 3. * a,
            "'Rail/Margin (mm)' " + text_in_mm(rail.margin) +
              " lets the wheel leave the rail; at least three semi-axes, " + text_in_mm(3. * a));
    require(wheel.is_full() || wheel.sector_margin >= 3. * a,
            "'Wheel/Sector margin (mm)' " + text_in_mm(wheel.sector_margin) +
              " lets the contact leave the sector; at least three semi-axes, " + text_in_mm(3. * a));
    check_sector();
    check_window();

    // Around the finest cells there is room for at least one more, if the rail does not go on as its image.
    const double beside = std::abs(path_y());
    require(is_between_planes() || beside + fine_half_width() <= rail_half_width() - finest,
            "'Mesh/Fine half width (mm)' " + text_in_mm(fine_half_width()) +
              (beside > 0. ? " about y = " + text_in_mm(path_y()) + " mm" : "") +
              " must be below the half width of the rail; at most " +
              text_in_mm(rail_half_width() - finest - beside));
    require(is_between_planes() || beside + fine_half_width() <= wheel.half_width() - finest,
            "'Mesh/Fine half width (mm)' " + text_in_mm(fine_half_width()) +
              " must be below half of the wheel's width; at most " +
              text_in_mm(wheel.half_width() - finest - beside));
    const double thickness = std::min(rail_thickness(), wheel.thickness());
    require((mesh.fine_layers + 1) * finest <= thickness * (1. + 1e-9),
            "'Mesh/Fine layers' " + std::to_string(mesh.fine_layers) + " of 'Mesh/Finest cell (mm)' " +
              text_in_mm(finest) + " do not fit into rail and wheel; at most " +
              std::to_string(std::max(0, static_cast<int>(thickness / finest * (1. + 1e-9)) - 1)));
    const Range fine = cubes();
    require(mesh.fine_from == mesh.fine_to || (fine.begin < rail_end() && fine.end > rail_begin()),
            "'Mesh/Fine from (mm)' to 'Fine to (mm)', from the defect's leading edge at " +
              text_in_mm(defect.position) + " mm, must lie on the rail from " + text_in_mm(rail_begin()) +
              " to " + text_in_mm(rail_end()) + " mm at least in part");
  }


  void Scene::check_window() const
  {
    if (!has_window())
      return;
    const double a = hertz(*this, static_load()).semi_axis_x, least = 1.25 * a + 2. * mesh.finest_cell;
    require(window_margin() >= least * (1. - 1e-9),
            "'Mesh/Window margin (mm)' " + text_in_mm(mesh.window_margin) +
              " must hold the patch and a quarter of it more; at least " + text_in_mm(least));
    constexpr double shortest = 4.; // cells: a change costs more than so short a way
    require(motion.rolled_distance <= usual_window() ||
              usual_window() >= shortest * mesh.finest_cell * (1. - 1e-9),
            "'Mesh/Window length (mm)' " + text_in_mm(mesh.window_length) + " must be at least four cells, " +
              text_in_mm(shortest * mesh.finest_cell));
    const std::string keeps = keeps_mesh();
    require(keeps.empty(), "'Mesh/Window' cannot be had with " + keeps + ": its mesh must stay");
  }


  std::string Scene::keeps_mesh() const
  {
    const auto yields = [](const MaterialSection &material) {
      return material.yield_stress > 0. || !material.plastic_zones.empty();
    };
    for (const auto &[what, is_there] : std::initializer_list<std::pair<const char *, bool>>{
           {"a wheelset in a position ('Wheelset')", is_positioned()},
           {"several wheels", n_wheels() > 1},
           {"several passages", motion.passages > 1},
           {"'Motion/Longest distance (mm)'", motion.longest_distance > 0.},
           {"a rail that is meshed in a file", bool(rail_mesh())},
           {"steel that yields", yields(rail.material) || yields(wheel.material)},
           {"'Damage/Record'", damage.record},
           {"section 'Peak stress'", peak_stress.is_wanted()},
           {"'Output/Cells'", !output.cells.empty()},
           {"'Scene/Reproducible'", general.reproducible}})
      if (is_there)
        return what;
    return "";
  }


  void Scene::check_sector() const
  {
    require(!is_positioned() || !wheel_is_ring(),
            "'Motion/Rolled distance (mm)' with 'Wheel/Sector margin (mm)' at both ends exceeds 95 % of the "
            "wheel's circumference, " +
              text_in_mm(longest_sector()) + ", where 'Wheelset' has a position");
  }


  void Scene::check_plasticity() const
  {
    const double beside = is_positioned() ? 0. : std::abs(path_y());
    for (const bool of_wheel : {true, false})
      {
        const std::string      section  = of_wheel ? "Wheel" : "Rail";
        const MaterialSection &material = of_wheel ? wheel.material : rail.material;
        require((material.plastic_zones.empty() && material.yield_stress == 0.) ||
                  (element_named(solid.element).can_yield && !solid.has_bulk_viscosity()),
                "'" + section + "/Yield stress (MPa)' needs 'Solid/Element' one-point and no bulk viscosity");
        // Where the wheel has a position both bodies are blocks of one size.
        material.check(section, of_wheel
                                  ? MaterialSection::Meshed{wheel.thickness(), wheel.half_width() - beside,
                                                            meshed_arc().begin, meshed_arc().end}
                                  : MaterialSection::Meshed{
                                      (is_positioned() ? wheel.thickness() : rail_thickness()),
                                      (is_positioned() ? wheel.half_width() : rail_half_width()) - beside,
                                      rail_begin(), rail_end()});
      }
  }


  void Scene::check_ratcheting() const
  {
    const bool fails = ratcheting.strain_at_failure > 0.;
    if (!fails && !ratcheting.jumps && !ratcheting.uniform)
      return;
    const std::string name = fails              ? "'Ratcheting/Strain at failure (%)'"
                             : ratcheting.jumps ? "'Ratcheting/Jumps'"
                                                : "'Ratcheting/Uniform rail'";
    require(motion.passages > 1, name + " needs several 'Motion/Passages'");
    require(rail.material.yield_stress > 0. || !rail.material.plastic_zones.empty(),
            name + " needs a rail that yields: 'Rail/Yield stress (MPa)'");
    require(
      !ratcheting.uniform || (!is_positioned() && !has_defect() && !rail.is_meshed() && n_wheels() == 1 &&
                              rail.material.plastic_zones.empty()),
      "'Ratcheting/Uniform rail' needs one wheel that stands upright and a rail that is alike along its "
      "length: no defect, mesh file, slices or plastic zones");
    if (!ratcheting.jumps)
      return;
    require(!damage.record,
            "'Ratcheting/Jumps' cannot be had with 'Damage/Record', which sums what is rolled");
    require(ratcheting.rolled_between < motion.passages,
            "'Ratcheting/Rolled between jumps' " + std::to_string(ratcheting.rolled_between) +
              " must be below 'Motion/Passages', " + std::to_string(motion.passages));
  }


  void Scene::check_numerics() const
  {
    const auto needs_inertia = [&](const std::string &cause) {
      require(general.density_scale == 1., "'Scene/Density scale' must be 1 with " + cause +
                                             ": the inertia of the cells is part of the answer");
      require(solid.mass_damping == 0., "'Solid/Mass damping (1 per s)' must be 0 with " + cause +
                                          ": it slows motion that is part of the answer");
    };
    if (shapes->defect)
      needs_inertia("'Defect/Shape' " + defect.shape);
    if (!is_round())
      needs_inertia("'Wheel/Deviation'");
    if (has_uneven_mesh())
      needs_inertia("a 'Rail/Mesh file' whose running surface changes along the path by " +
                    uneven_in_words());
    if (track.foundation != Foundation::rigid)
      needs_inertia("'Track/Foundation' " + name_of(track.foundation));
    const double largest_ratio = element_named(solid.element).largest_poisson_ratio;
    for (const auto &[body, material] :
         {std::pair("Wheel", &wheel.material), std::pair("Rail", &rail.material)})
      require(material->elastic().poisson_ratio <= largest_ratio,
              "'Solid/Element' " + solid.element + " locks at '" + body + "/Poisson's ratio' " +
                text_of(material->elastic().poisson_ratio) + "; at most " + text_of(largest_ratio));
    require(time_stepping.levels == 1 || solid.stiffness_damping >= least_damping_of_levels,
            "'Time stepping/Levels' " + std::to_string(time_stepping.levels) +
              " needs 'Solid/Stiffness damping (time steps)' of at least " +
              text_of(least_damping_of_levels) + ": levels of time steps resonate without it");
  }


  double Scene::traction_coefficient(const unsigned int number) const
  {
    return number == 0 || further_wheels.traction_coefficients.empty()
             ? motion.traction_coefficient
             : further_wheels.traction_coefficients[number - 1];
  }


  DamageIndices Scene::indices_of_damage() const
  {
    const Section section(handler, "Damage");
    DamageIndices indices;
    for (const DamageIndexEntry &entry : damage_indices())
      if (auto index = entry.make(handler))
        indices.emplace_back(entry.key, std::move(index));
    return indices;
  }


  std::shared_ptr<const WearLaw> Scene::wear_law() const
  {
    const Section section(handler, "Damage");
    return entry_named(wear_laws(), damage.wear_law, "wear law").make(handler);
  }


  bool Scene::settles() const
  {
    // A smooth twin has the length of the defect, and the inertia of the run that it is for.
    const bool has_defect = shapes->defect || defect.length > 0.;
    return general.quasi_static && !has_defect && is_round() && !has_uneven_mesh() &&
           track.foundation == Foundation::rigid;
  }


  std::vector<std::string> Scene::assumptions(const bool has_tractions) const
  {
    std::vector<std::string> list;
    const double             scale = general.density_scale, mass_damping = solid.mass_damping;
    if (scale > 1.)
      list.push_back("density of the cells times " + text_of(scale) +
                     ": for steady rolling only, with an inertia error of about " +
                     text_of(std::round(1e4 * inertia_error_estimate()) / 100.) + " %");
    if (mesh.window == WindowUse::automatic && has_window())
      list.push_back(
        format("cells are fine about the wheel alone, in %u windows one after the other ('Mesh/Window' "
               "false: along the whole path)",
               static_cast<unsigned int>(windows().size())));
    if (time_stepping.least_step > 0.)
      list.push_back("mass added to cells that would need steps below " +
                     text_of(1e6 * time_stepping.least_step) +
                     " us: above some kHz the contact force is not the true one");
    if (mass_damping > 0.)
      list.push_back("mass damping of " + text_of(mass_damping) +
                     " per s: motion of the cells on top of the rigid bodies' fades by half in " +
                     text_of(std::round(1e5 * 2. * std::log(2.) / mass_damping) / 100.) + " ms");
    if (settles())
      list.push_back("the axle rises and sinks until contact carries the load, within about the length of a "
                     "patch: the mass of the wheel is a load only");
    if (guidance.kind != Guidance::rigid && (scale > 1. || mass_damping > 0.))
      list.push_back(
        "a wheelset that moves across its track has the inertia of the scaled, or damped, cells: "
        "for motion that is slow beside its vibration on the contact only");
    if (motion.drive == Drive::torque && (scale > 1. || mass_damping > 0.))
      list.push_back(
        "the way from the torque's onset to steady rolling is that of the scaled or damped cells, "
        "not the true one");
    if (has_tractions)
      list.push_back("the start has the tractions that half-space theory predicts for steady rolling");
    else
      list.push_back(
        std::string("the start has no tractions") +
        (start.tractions == StartTractions::predicted ? ", which half-space theory cannot predict" : "") +
        "; they build up while rolling");
    if (const auto law = friction_law(); !law->is_constant() && law->memory().distance == 0.)
      list.push_back(
        "friction follows the slip speed at once: where pressure times the fall of the coefficient "
        "with slip is above half the shear impedance of the steel, slip oscillates by itself "
        "('Contact/Friction memory (mm)' prevents it)");
    if (has_narrow_head())
      list.push_back(
        "the head was measured up to " + text_in_mm(surfaces().half_width) +
        " mm beside its middle; beyond, it has the profile's shape, as far from it as where it ends");
    // Found on a rail head: 0.7 % at 2.9 semi-axes, 2.5 % at 1.7, 6 % at 1.2, 30 % at 0.4.
    constexpr double              thick   = 3.;
    const reference::HertzEllipse ellipse = hertz(*this, static_load());
    if (const double axes = std::sqrt(ellipse.semi_axis_x * ellipse.semi_axis_y);
        !wheel.is_full() && wheel.sector_thickness < thick * axes)
      list.push_back(
        format("the sector is %.1f mean semi-axes of the patch thick: below %g its rigid back raises the "
               "pressure",
               wheel.sector_thickness / axes, thick));
    constexpr double soft_hourglass = 0.5, stiff_hourglass = 2.; // doc/verification.md, section 2.4
    if (element_named(solid.element).has_hourglass_modes &&
        (solid.hourglass_coefficient < soft_hourglass || solid.hourglass_coefficient > stiff_hourglass))
      list.push_back(format("'Solid/Hourglass coefficient' %g, of which %g to %g is examined: pressure, "
                            "creepage and slip are off by some per cent",
                            solid.hourglass_coefficient, soft_hourglass, stiff_hourglass));
    if (solid.stiffness_damping == 0.)
      list.push_back("no stiffness damping: micro-slip may chatter at the frequency of the cells");
    return list;
  }


  double Scene::inertia_error_estimate() const
  {
    // Speed of Rayleigh waves (Viktorov 1967), the slower body's.
    const auto rayleigh = [](const ElasticMaterial &material) {
      const double nu = material.poisson_ratio;
      return material.shear_wave_speed() * (0.87 + 1.12 * nu) / (1. + nu);
    };
    const double slower = std::min(rayleigh(rail.material.elastic()), rayleigh(wheel.material.elastic()));
    return general.density_scale * motion.speed * motion.speed / (slower * slower);
  }
} // namespace tread
