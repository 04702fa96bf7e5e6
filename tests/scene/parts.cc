// SPDX-License-Identifier: LGPL-2.1-or-later
// What the parts of a simulation are given by the parameters of a scene. Every parameter has a value of its
// own, so that an exchange is noticed; expected are the values as they stand in the parameters, in SI units,
// and closed forms.
#include <tread/geometry/contact_points.h>
#include <tread/geometry/rail_profile.h>
#include <tread/reference/hertz.h>
#include <tread/scene/doubts.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/islands.h>
#include <tread/scene/parts.h>
#include <tread/scene/recorded.h>
#include <tread/scene/surface_laws.h>
#include <tread/scene/track_parts.h>
#include <tread/scene/wheelset_case.h>
#include <tread/scene/wheelset_summary.h>
#include <tread/track/track_beam.h>

#include <deal.II/base/numbers.h>

#include "check.h"
#include "temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using namespace tread;
using tests::TemporaryFolder;
using dealii::Point;

namespace scene_parts
{
  using Settings = std::vector<std::string>;

  /// A scene does not move: its parameters are bound to its sections.
  std::unique_ptr<Scene> scene_of(const Settings &settings, const Settings &more = {})
  {
    Settings all = settings;
    all.insert(all.end(), more.begin(), more.end());
    auto scene = std::make_unique<Scene>();
    scene->read("", all);
    return scene;
  }

  constexpr double round_off = 1e-12;
  const Settings   block{"Rail/Shape=block"};


  void check_numerics(tests::Check &check)
  {
    const auto scene = scene_of(
      block, {"Scene/Density scale=4", "Scene/Reproducible=true", "Solid/Hourglass coefficient=0.7",
              "Solid/Linear bulk viscosity=0.07", "Solid/Quadratic bulk viscosity=1.3",
              "Solid/Stiffness damping (time steps)=0.21", "Solid/Mass damping (1 per s)=31",
              "Time stepping/Courant number=0.83", "Time stepping/Levels=3", "Contact/Tolerance=3e-7",
              "Contact/Largest number of sweeps=77", "Watchdogs/Stop at strain=0.37",
              "Watchdogs/Stop at node speed (m per s)=812", "Vehicle/Gravity (m per s2)=9.7"});

    const SolidParameters solid = solid_parameters(*scene);
    check.relative("solid: hourglass coefficient", solid.hourglass_coefficient, 0.7, 0.);
    check.relative("solid: linear bulk viscosity", solid.linear_bulk_viscosity, 0.07, 0.);
    check.relative("solid: quadratic bulk viscosity", solid.quadratic_bulk_viscosity, 1.3, 0.);
    check.relative("solid: density scale", solid.density_scale, 4., 0.);
    check.absolute("solid: the highest of three levels", solid.max_level, 2, 0.);
    check.that("solid: reproducible", solid.reproducible);
    check.that("solid: usual element", solid.element == "one-point");

    const DynamicsParameters dynamics = dynamics_parameters(*scene);
    check.relative("dynamics: Courant number", dynamics.courant_number, 0.83, 0.);
    check.relative("dynamics: damping in time steps", dynamics.damping_steps, 0.21, 0.);
    check.relative("dynamics: mass damping, 1/s", dynamics.mass_damping, 31., 0.);
    check.relative("dynamics: density scale", dynamics.density_scale, 4., 0.);
    check.relative("dynamics: gravity, m/s2", dynamics.gravity, 9.7, 0.);
    check.relative("dynamics: largest strain", dynamics.stop_at.strain, 0.37, 0.);
    check.relative("dynamics: largest speed, m/s", dynamics.stop_at.node_speed, 812., 0.);

    const ContactParameters contact = contact_parameters(*scene);
    check.relative("contact: tolerance", contact.solver.tolerance, 3e-7, 0.);
    check.absolute("contact: sweeps", contact.solver.max_sweeps, 77, 0.);
    check.that("contact: reproducible", contact.reproducible);

    const auto other = scene_of(block, {"Solid/Element=fully-integrated"});
    check.that("solid: the element that is named", solid_parameters(*other).element == "fully-integrated");
    check.that("solid and contact: not reproducible unless it is wanted",
               !solid_parameters(*other).reproducible && !contact_parameters(*other).reproducible);
    check.absolute("solid: one level", solid_parameters(*other).max_level, 0, 0.);
  }


  const Settings vehicle{"Wheel/Mass (kg)=911",
                         "Wheel/Moment of inertia (kg m2)=61",
                         "Vehicle/Sprung mass (kg)=7300",
                         "Vehicle/Suspension stiffness (kN per m)=1170",
                         "Vehicle/Suspension damping (N s per m)=3100",
                         "Vehicle/Gravity (m per s2)=9.7"};

  /// @param n_wheels of the hub, each with its share of the vehicle
  void check_hub(tests::Check &check, const std::string &name, const WheelHubParameters &hub, const double n)
  {
    check.relative(name + "mass, kg", hub.mass, n * 911., round_off);
    check.relative(name + "moment of inertia, kg m2", hub.moment_of_inertia, n * 61., round_off);
    check.relative(name + "sprung mass, kg", hub.sprung_mass, n * 7300., round_off);
    check.relative(name + "suspension stiffness, kN/m", 1e-3 * hub.suspension_stiffness, n * 1170.,
                   round_off);
    check.relative(name + "suspension damping, N s/m", hub.suspension_damping, n * 3100., round_off);
    check.relative(name + "gravity, m/s2", hub.gravity, 9.7, 0.);
  }


  /// The hub follows its load in scenes of steady rolling, and in no other. The stiffness of a contact is the
  /// slope of Hertz's force over the approach.
  void check_settling(tests::Check      &check,
                      const std::string &name,
                      const Scene       &scene,
                      const double       n,
                      const double       allowed)
  {
    const auto settling = hub_parameters(scene).settling;
    if (!check.that(name + "settles", settling.has_value()))
      return;
    constexpr double more    = 1.001;
    const double     load    = scene.static_load();
    const auto       ellipse = scene.stance().ellipse(load), next = scene.stance().ellipse(more * load);
    check.relative(name + "stiffness of the contacts, GN/m", 1e-9 * settling->stiffness,
                   1e-9 * n * (more - 1.) * load / (next.approach - ellipse.approach), allowed);
    check.relative(name + "time of half a patch, ms", 1e3 * settling->time,
                   1e3 * ellipse.semi_axis_x / scene.motion.speed, round_off);
  }


  /// Several wheels on one rail, each with a drive of its own.
  void check_wheels(tests::Check &check)
  {
    Settings three = vehicle;
    three.insert(three.end(), {"Motion/Traction coefficient=0.3", "Further wheels/Distances (mm)=1000,2300"});
    const auto own = scene_of(block, three);
    check_hub(check, "hub: ", hub_parameters(*own), 1.);
    check_settling(check, "hub: ", *own, 1., 1e-3);
    for (const Settings &other :
         {Settings{"Scene/Quasi-static=false"},
          Settings{"Defect/Length (mm)=20", "Defect/Depth (mm)=0.1", "Defect/Shape=dip"},
          Settings{"Defect/Length (mm)=20", "Defect/Shape=none"},
          Settings{"Rail/Shape=full section", "Rail/Begin (mm)=-1725", "Rail/Length (mm)=3300",
                   "Track/Support 0 (mm)=-450", "Track/Foundation=two-layer"}})
      {
        Settings settings = block;
        settings.insert(settings.end(), other.begin(), other.end());
        check.that("hub: has its inertia with " + other.back(),
                   !hub_parameters(*scene_of(settings)).settling);
      }
    check.below("hub: no inertia about other axes",
                hub_parameters(*own).yaw_inertia + hub_parameters(*own).roll_inertia, 0.);
    check.relative("static load of a wheel, kN", 1e-3 * own->static_load(), 79.6467, round_off);
    three.push_back("Further wheels/Traction coefficients=0.1,-0.2");
    const auto others = scene_of(block, three);
    for (unsigned int k = 0; k < 3; ++k)
      {
        const std::string name     = "wheel " + std::to_string(k + 1) + ": ";
        constexpr double  of_own[] = {0.3, 0.1, -0.2}, behind[] = {0., 1., 2.3};
        check.relative(name + "traction coefficient of the first wheel", own->traction_coefficient(k), 0.3,
                       0.);
        check.relative(name + "its own traction coefficient", others->traction_coefficient(k), of_own[k], 0.);
        check.absolute(name + "begins this far behind the first, m", own->path_begin(0) - own->path_begin(k),
                       behind[k], round_off);
      }
  }


  void check_materials(tests::Check &check)
  {
    const Settings steel{"Young's modulus (GPa)=200", "Yield stress (MPa)=410", "Tangent modulus (GPa)=20"};
    Settings       rail{"Rail/Shape=block"};
    for (const std::string &line : steel)
      rail.push_back("Rail/" + line);
    // Both branches of the bi-linear line: 1/Et = 1/E + 1/H, with which H = 200/9 GPa; of 40 GPa H = 50 GPa.
    const double hardening = 200e9 / 9.;
    {
      const auto            scene     = scene_of(rail, {"Rail/Hardening=isotropic"});
      const PlasticMaterial isotropic = scene->rail.material.plastic(410e6, 20e9);
      check.relative("isotropic hardening: yield stress, MPa", 1e-6 * isotropic.yield_stress, 410.,
                     round_off);
      check.relative("isotropic hardening: modulus, GPa", 1e-9 * isotropic.isotropic_modulus,
                     1e-9 * hardening, round_off);
      check.that("isotropic hardening: no backstress", isotropic.backstresses.empty());
    }
    {
      const auto            scene     = scene_of(rail, {"Rail/Hardening=kinematic"});
      const PlasticMaterial kinematic = scene->rail.material.plastic(410e6, 20e9);
      check.below("kinematic hardening: none of the yield stress, GPa", 1e-9 * kinematic.isotropic_modulus,
                  0.);
      check.absolute("kinematic hardening: backstresses", kinematic.backstresses.size(), 1, 0.);
      if (!kinematic.backstresses.empty())
        {
          check.relative("kinematic hardening: modulus, GPa", 1e-9 * kinematic.backstresses[0].modulus,
                         1e-9 * hardening, round_off);
          check.below("kinematic hardening: no recovery", kinematic.backstresses[0].recovery, 0.);
        }
    }
    {
      const auto scene =
        scene_of(rail, {"Rail/Hardening=Armstrong-Frederick", "Rail/Backstress moduli (GPa)=61,7",
                        "Rail/Backstress recoveries=310,11"});
      const PlasticMaterial ratchets = scene->rail.material.plastic(410e6, 20e9);
      check.below("Armstrong-Frederick: none of the yield stress, GPa", 1e-9 * ratchets.isotropic_modulus,
                  0.);
      check.absolute("Armstrong-Frederick: backstresses", ratchets.backstresses.size(), 2, 0.);
      if (ratchets.backstresses.size() == 2)
        for (unsigned int i = 0; i < 2; ++i)
          {
            const std::string name = "Armstrong-Frederick: " + std::to_string(i + 1) + ". ";
            check.relative(name + "modulus, GPa", 1e-9 * ratchets.backstresses[i].modulus, i ? 7. : 61.,
                           round_off);
            check.relative(name + "recovery", ratchets.backstresses[i].recovery, i ? 11. : 310., 0.);
          }
    }
  }


  /// Cells that may yield, on both bodies and to both sides, and a weld in the rail.
  void check_plastic_zones(tests::Check &check)
  {
    const auto scene = scene_of(
      block, {"Rail/Young's modulus (GPa)=200", "Rail/Yield stress (MPa)=410",
              "Rail/Tangent modulus (GPa)=20", "Rail/Plastic depth (mm)=6", "Rail/Plastic half width (mm)=7",
              "Rail/Plastic zones=-30:-20:4:300:40", "Wheel/Young's modulus (GPa)=210",
              "Wheel/Yield stress (MPa)=520", "Wheel/Tangent modulus (GPa)=21", "Wheel/Plastic depth (mm)=5",
              "Wheel/Plastic half width (mm)=8", "Motion/Start (mm)=-50", "Motion/Rolled distance (mm)=60"});
    const auto   zones = plastic_zones(*scene);
    const double mm    = 1e-3;
    // By the yield stress of the zone that a cell is in, MPa; 0: it stays elastic.
    const auto in_rail = [&](const double x, const double y, const double depth) {
      const int zone = zone_at(zones, rail_body, Point<3>(mm * x, mm * y, -mm * depth));
      return zone < 0 ? 0. : 1e-6 * zones[zone].material.yield_stress;
    };
    // Along the tread, from where it touches at the start.
    const auto in_wheel = [&](const double arc, const double y, const double depth) {
      constexpr double radius = 460., start = -50.; // mm
      const double     angle = arc / radius, r = radius - depth;
      const Point<3>   p(mm * (start + r * std::sin(angle)), mm * y,
                         scene->axle_height() - mm * r * std::cos(angle));
      const int        zone = zone_at(zones, wheel_body(0), p);
      return zone < 0 ? 0. : 1e-6 * zones[zone].material.yield_stress;
    };
    struct At
    {
      const char *place;
      double      along, beside, depth, yield_rail, yield_wheel;
    };
    // The weld is 4 mm deep and from x = -30 to -20 mm; below it is the rail.
    for (const At &at : std::vector<At>{{"in the middle", 0., 0., 3., 410., 520.},
                                        {"6.9 mm to the gauge side", 0., -6.9, 3., 410., 520.},
                                        {"6.9 mm to the field side", 0., 6.9, 3., 410., 520.},
                                        {"7.1 mm to the gauge side", 0., -7.1, 3., 0., 520.},
                                        {"7.1 mm to the field side", 0., 7.1, 3., 0., 520.},
                                        {"8.1 mm to the gauge side", 0., -8.1, 3., 0., 0.},
                                        {"8.1 mm to the field side", 0., 8.1, 3., 0., 0.},
                                        {"4.9 mm deep", 0., 0., 4.9, 410., 520.},
                                        {"5.9 mm deep", 0., 0., 5.9, 410., 0.},
                                        {"6.1 mm deep", 0., 0., 6.1, 0., 0.},
                                        {"at -29 mm", -29., 0., 3., 300., 0.},
                                        {"at -21 mm", -21., 0., 3., 300., 0.},
                                        {"at -19 mm", -19., 0., 3., 410., 0.},
                                        {"at -31 mm", -31., 0., 3., 410., 0.},
                                        {"at -25 mm, 4.5 mm deep", -25., 0., 4.5, 410., 0.},
                                        {"at 55 mm", 55., 0., 3., 0., 520.},
                                        {"at -80 mm", -80., 0., 3., 0., 0.},
                                        {"at 90 mm", 90., 0., 3., 0., 0.}})
      {
        check.absolute("yield stress in the rail " + std::string(at.place) + ", MPa",
                       in_rail(at.along, at.beside, at.depth), at.yield_rail, 1e-9);
        check.absolute("yield stress in the wheel " + std::string(at.place) + ", MPa",
                       in_wheel(at.along, at.beside, at.depth), at.yield_wheel, 1e-9);
      }
    const auto modulus = [&](const unsigned int body, const Point<3> &p) {
      const int zone = zone_at(zones, body, p);
      return zone < 0 ? 0. : 1e-9 * zones[zone].material.isotropic_modulus;
    };
    check.relative("the weld's own hardening, GPa", modulus(rail_body, Point<3>(-25e-3, 0., -3e-3)), 50.,
                   1e-9);
    check.relative("that of the rail beside it, GPa", modulus(rail_body, Point<3>(0., 0., -3e-3)), 200. / 9.,
                   1e-9);
    check.relative("that of the wheel, GPa", modulus(wheel_body(0), Point<3>(-50e-3, 0., 3e-3)), 70. / 3.,
                   1e-9);
  }


  const Settings on_track{"Rail/Shape=full section",
                          "Rail/Inclination=1:20",
                          "Wheel/Tread profile=cone 1:20",
                          "Scene/Quasi-static=false",
                          "Track/Foundation=two-layer",
                          "Track/Sleepers=solid",
                          "Track/Sleeper spacing (m)=0.61",
                          "Track/Support 0 (mm)=50",
                          "Track/Pad stiffness (MN per m)=610",
                          "Track/Pad damping (kN s per m)=21",
                          "Track/Pads pull=false",
                          "Track/Pad length (mm)=130",
                          "Track/Pad width (mm)=120",
                          "Track/Points along=5",
                          "Track/Points across=3",
                          "Track/Sleeper mass (kg)=171",
                          "Track/Sleeper length (m)=2.6",
                          "Track/Sleeper width (mm)=260",
                          "Track/Rail distance (mm)=1510",
                          "Track/Sleeper Young's modulus (GPa)=41",
                          "Track/Sleeper Poisson's ratio=0.21",
                          "Track/Sleeper density (kg per m3)=2450",
                          "Track/Ballast stiffness (MN per m)=47",
                          "Track/Ballast damping (kN s per m)=33",
                          "Rail/Young's modulus (GPa)=207",
                          "Rail/Poisson's ratio=0.28",
                          "Rail/Density (kg per m3)=7810",
                          "Wheel/Young's modulus (GPa)=205",
                          "Wheel/Poisson's ratio=0.29",
                          "Wheel/Density (kg per m3)=7790",
                          "Rail/Begin (mm)=-2050",
                          "Rail/Length (mm)=4100",
                          "Rail/Ends=absorbing",
                          "Rail/Absorbing length (m)=0.9",
                          "Motion/Start (mm)=-20",
                          "Motion/Rolled distance (mm)=40"};

  void check_springs(tests::Check                   &check,
                     const std::string              &name,
                     const TrackParameters::Springs &springs,
                     const TrackParameters::Springs &expected)
  {
    check.relative(name + "pad stiffness, MN/m", 1e-6 * springs.pad_stiffness, 1e-6 * expected.pad_stiffness,
                   round_off);
    check.relative(name + "ballast stiffness, MN/m", 1e-6 * springs.ballast_stiffness,
                   1e-6 * expected.ballast_stiffness, round_off);
    check.relative(name + "pad damping, kN s/m", 1e-3 * springs.pad_damping, 1e-3 * expected.pad_damping,
                   round_off);
    check.relative(name + "ballast damping, kN s/m", 1e-3 * springs.ballast_damping,
                   1e-3 * expected.ballast_damping, round_off);
    check.absolute(name + "gap below, mm", 1e3 * springs.ballast_gap, 1e3 * expected.ballast_gap, round_off);
  }

  void check_track(tests::Check &check, const TemporaryFolder &folder)
  {
    const std::string file  = folder.write("supports.csv", "support,pad_stiffness_MN_per_m,ballast_gap_mm\n"
                                                            "2,333,1.5\n");
    const auto        scene = scene_of(on_track, {"Track/Support file=" + file});

    // Middles of the sleepers at 50 mm + 610 mm times the number that are on the rail.
    const std::vector<double> positions = support_positions(*scene);
    check.absolute("track: supports", positions.size(), 7, 0.);
    check.absolute("track: number of the first", first_support(*scene), -3, 0.);
    check.absolute("track: place of the first, mm", 1e3 * positions.front(), -1780., 1e-9);
    check.absolute("track: place of the last, mm", 1e3 * positions.back(), 1880., 1e-9);
    check.that("track: supports beside the path are recorded",
               recorded_supports(*scene) == std::vector<int>({-1, 0}));

    const TrackParameters track = track_parameters(*scene);
    check_springs(check, "track: ", track.springs, {610e6, 47e6, 21e3, 33e3, 0.});
    check.absolute("track: supports that differ", track.exceptions.size(), 1, 0.);
    check_springs(check, "track: support 2, the sixth on the rail: ", track.springs_of(5),
                  {333e6, 47e6, 21e3, 33e3, 1.5e-3});
    check.that("track: pads do not pull", !track.pads_pull);
    check.relative("track: pad length, mm", 1e3 * track.pad_length, 130., round_off);
    check.relative("track: pad width, mm", 1e3 * track.pad_width, 120., round_off);
    check.absolute("track: points along", track.points_along, 5, 0.);
    check.absolute("track: points across", track.points_across, 3, 0.);
    check.that("track: two layers", track.two_layers);
    check.relative("track: sleeper mass, kg", track.sleeper_mass, 171., 0.);
    // A rail of 159 mm that leans to the gauge side by 1:20 has its foot to the field side of its top.
    check.relative("track: middle of the pads, mm", 1e3 * track.pad_middle, 159. / std::sqrt(401.), 1e-9);
    check.relative("track: base of the rail, mm", 1e3 * base_middle(*scene)[2], -159. * 20. / std::sqrt(401.),
                   1e-9);

    const AbsorbingEnds ends = absorbing_ends(*scene);
    check.relative("absorbing ends: length, m", ends.length, 0.9, round_off);
    check.relative("absorbing ends: from, m", ends.begin, -2.05, round_off);
    check.relative("absorbing ends: to, m", ends.end, 2.05, round_off);
    check.relative("absorbing ends: speed of shear waves, m/s", ends.shear_speed,
                   std::sqrt(207e9 / (2. * 1.28) / 7810.), round_off);

    // Half a spacing ahead of a support; the last one has the end of the rail there.
    check.relative("mid-span ahead of support 1, mm", 1e3 * mid_span_beside(*scene, 1), 965., round_off);
    check.relative("mid-span ahead of support -2, mm", 1e3 * mid_span_beside(*scene, -2), -865., round_off);
    check.relative("the rail's end ahead of support 3, mm", 1e3 * mid_span_beside(*scene, 3), 2050.,
                   round_off);

    const std::vector<SolidSleeper> sleepers = solid_sleepers(*scene);
    check.absolute("sleepers", sleepers.size(), 7, 0.);
    check.absolute("sleepers: body of the third, behind rail and wheel", sleepers[2].body, 4, 0.);
    check.relative("sleepers: from the middle of the track, mm", 1e3 * sleepers[2].y_begin, -755., round_off);
    check.relative("sleepers: to the end, mm", 1e3 * sleepers[2].y_end, 545., round_off);
    check.relative("sleepers: width, mm", 1e3 * sleepers[2].width, 260., round_off);
    check.relative("sleepers: mass of half of one by its size, kg",
                   2450. * scene->track.solid_sleeper_height() * (sleepers[2].y_end - sleepers[2].y_begin) *
                     sleepers[2].width,
                   171., round_off);

    const std::vector<ElasticMaterial> list = materials(*scene);
    check.absolute("materials: rail, wheel, sleepers", list.size(), 9, 0.);
    constexpr double young[] = {207., 205., 41.}, poisson[] = {0.28, 0.29, 0.21},
                     density[] = {7810., 7790., 2450.};
    for (const std::size_t body : {0, 1, 2, 8})
      {
        const std::string name = "material of body " + std::to_string(body) + ": ";
        const std::size_t kind = std::min<std::size_t>(body, 2);
        check.relative(name + "Young's modulus, GPa", 1e-9 * list[body].young_modulus, young[kind],
                       round_off);
        check.relative(name + "Poisson's ratio", list[body].poisson_ratio, poisson[kind], 0.);
        check.relative(name + "density, kg/m3", list[body].density, density[kind], 0.);
      }

    const auto plain =
      scene_of(on_track, {"Track/Pads pull=true", "Track/Sleepers=mass", "Track/Foundation=one-layer",
                          "Rail/Ends=symmetric", "Output/Supports=-3,2"});
    check.that("track: pads pull", track_parameters(*plain).pads_pull);
    check.that("track: one layer", !track_parameters(*plain).two_layers);
    check.that("track: none of the supports differs", track_parameters(*plain).exceptions.empty());
    check.below("symmetric ends absorb nothing, m", absorbing_ends(*plain).length, 0.);
    check.that("symmetric ends: nothing beyond", !track_beyond(*plain));
    check.that("track: supports that are named are recorded",
               recorded_supports(*plain) == std::vector<int>({-3, 2}));
    check.that("rigid sleepers are no bodies", solid_sleepers(*plain).empty());
    check.absolute("materials: rail, wheel", materials(*plain).size(), 2, 0.);
  }


  void check_beam_under_rail(tests::Check &check, const TemporaryFolder &folder)
  {
    const std::string names      = "x_mm,bending_stiffness_MN_m2,shear_stiffness_MN,mass_kg_per_m\n";
    const auto        scene_with = [&](const std::string &rows, const std::string &columns) {
      return scene_of({"Rail/Shape=block", "Track/Foundation=beam",
                       "Track/Beam bending stiffness (MN m2)=5.5", "Track/Beam shear stiffness (MN)=210",
                       "Track/Beam mass (kg per m)=55", "Track/Sleeper spacing (m)=0.61",
                       "Track/Support 0 (mm)=290", "Scene/Density scale=1", "Solid/Mass damping (1 per s)=0",
                       "Rail/Spans beyond=7"},
                             {"Track/Beam file=" + folder.write("beam.csv", columns + rows)});
    };
    const auto          scene = scene_with("-30,7.3,547,94.5\n-3,0.93,297,34.3\n33,5.5,210,55\n", names);
    const BeamUnderRail beam  = beam_under_rail(*scene);
    check.relative("beam: bending stiffness, MN m2", 1e-6 * beam.section.bending_stiffness, 5.5, round_off);
    check.relative("beam: shear stiffness, MN", 1e-6 * beam.section.shear_stiffness, 210., round_off);
    check.relative("beam: mass, kg/m", beam.section.mass, 55., round_off);
    const double inertia =
      scene->rail.material.elastic().density / scene->rail.material.elastic().young_modulus;
    check.relative("beam: rotary inertia, kg m", beam.section.rotary_inertia, 5.5e6 * inertia, round_off);
    check.relative("beam: begins halfway between supports", 1e3 * (beam.begin + beam.track.first_support),
                   290. - 610. * std::round((290. - 1e3 * (beam.begin + beam.track.first_support)) / 610.),
                   1e-9);
    check.absolute("stretches of the beam", beam.track.stretches.size(), 3., 0.);
    const double rows[3][4] = {{-30., 7.3, 547., 94.5}, {-3., 0.93, 297., 34.3}, {33., 5.5, 210., 55.}};
    for (std::size_t i = 0; i < std::min<std::size_t>(3, beam.track.stretches.size()); ++i)
      {
        const BeamStretch &stretch = beam.track.stretches[i];
        check.relative("stretch: from, mm", 1e3 * (beam.begin + stretch.from), rows[i][0], 1e-9);
        check.relative("stretch: bending stiffness, MN m2", 1e-6 * stretch.section.bending_stiffness,
                       rows[i][1], round_off);
        check.relative("stretch: shear stiffness, MN", 1e-6 * stretch.section.shear_stiffness, rows[i][2],
                       round_off);
        check.relative("stretch: mass, kg/m", stretch.section.mass, rows[i][3], round_off);
        check.relative("stretch: rotary inertia, kg m", stretch.section.rotary_inertia,
                       1e6 * rows[i][1] * inertia, round_off);
      }
    const auto refused = [&](const std::string &rows, const std::string &words, const std::string &columns) {
      const std::string text = tests::complaint<InputError>([&] { scene_with(rows, columns); });
      check.that("refused: " + text, text.find(words) != text.npos);
    };
    refused("0,7,547,94\n-3,7,547,94\n", "row 2: x_mm -3 must be at least 5 mm behind", names);
    refused("0,7e6,547,94\n", "row 1: bending_stiffness_MN_m2 7e+06 is no value of a rail", names);
    refused("0,7,0,94\n", "row 1: shear_stiffness_MN 0 is no value of a rail", names);
    refused("90000,7,547,94\n", "lies beyond the beam, which goes from", names);
    refused("", "has no rows", names);
    refused("0,7,547\n", "mass_kg_per_m", "x_mm,bending_stiffness_MN_m2,shear_stiffness_MN\n");
    refused("0,7,547,94,3\n", "has a column 'depth_mm'; it may have x_mm",
            "x_mm,bending_stiffness_MN_m2,shear_stiffness_MN,mass_kg_per_m,depth_mm\n");
  }

  void check_volume_materials(tests::Check &check)
  {
    RailSection rail;
    rail.materials  = "end post : 3:0.35:1900, rubber:0.01:0.45:1200";
    const auto list = rail.volume_materials();
    check.that("two volumes with materials",
               list.size() == 2 && list[0].volume == "end post" && list[1].volume == "rubber");
    check.relative("Young's modulus, GPa", 1e-9 * list.at(0).material.young_modulus, 3., round_off);
    check.relative("Poisson's ratio", list.at(1).material.poisson_ratio, 0.45, round_off);
    check.relative("density, kg/m3", list.at(0).material.density, 1900., round_off);
    for (const auto &[text, words] :
         {std::pair("post:3:0.35", "allowed: name of the volume:Young's modulus"),
          std::pair(":3:0.35:1900", "allowed: name of the volume"),
          std::pair("post:3:0.5:1900", "Poisson's ratio must be from 0 to 0.49"),
          std::pair("post:3e9:0.3:1900", "Young's modulus (GPa) must be from"),
          std::pair("post:3:0.3:1.9", "density (kg per m3) must be from"),
          std::pair("post:3:0.3:1900,Post:4:0.3:1900", "the volume is there twice")})
      {
        rail.materials         = text;
        const std::string said = tests::complaint<InputError>([&] { rail.volume_materials(); });
        check.that("refused: " + said, said.find(words) != said.npos);
      }
  }

  void check_track_beyond(tests::Check &check, const TemporaryFolder &folder)
  {
    // A support that differs is one of the cells' alone.
    const std::string file = folder.write("soft.csv", "support,pad_stiffness_MN_per_m\n-3,333\n");
    const auto        scene =
      scene_of(on_track, {"Track/Support file=" + file, "Track/Pads pull=true", "Rail/Ends=endless",
                          "Rail/Spans beyond=17", "Track/Stiffness along the rail (MN per m)=37",
                          "Vehicle/Gravity (m per s2)=9.7"});
    check.below("endless ends absorb nothing in the cells, m", absorbing_ends(*scene).length, 0.);
    const auto beyond = track_beyond(*scene);
    check.that("endless ends", bool(beyond));
    if (!beyond)
      return;
    // The middles of sleepers go on at 610 mm, from -1780 and 1880 mm.
    check.absolute("track beyond: first support before the rail, mm", 1e3 * (*beyond)[0].first_support, 340.,
                   1e-9);
    check.absolute("track beyond: first support behind the rail, mm", 1e3 * (*beyond)[1].first_support, 440.,
                   1e-9);
    for (const TrackBeamParameters &p : *beyond)
      {
        check.absolute("track beyond: spans", p.n_spans, 17, 0.);
        check.relative("track beyond: spacing, mm", 1e3 * p.spacing, 610., round_off);
        check.relative("track beyond: stiffness along the rail, MN/m", 1e-6 * p.stiffness_along, 37.,
                       round_off);
        check.relative("track beyond: gravity, m/s2", p.gravity, 9.7, round_off);
        check.relative("track beyond: speed of shear waves, m/s", p.shear_speed,
                       std::sqrt(207e9 / (2. * 1.28) / 7810.), round_off);
        check.relative("track beyond: pad stiffness, MN/m", 1e-6 * p.layers.pad_stiffness, 610., round_off);
        check.relative("track beyond: pad damping, kN s/m", 1e-3 * p.layers.pad_damping, 21., round_off);
        check.relative("track beyond: sleeper mass, kg", p.layers.sleeper_mass, 171., round_off);
        check.relative("track beyond: ballast stiffness, MN/m", 1e-6 * p.layers.ballast_stiffness, 47.,
                       round_off);
        check.relative("track beyond: ballast damping, kN s/m", 1e-3 * p.layers.ballast_damping, 33.,
                       round_off);
      }
  }


  bool has(const std::vector<std::string> &lines, const std::string &words)
  {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string &line) { return line.find(words) != std::string::npos; });
  }

  /// Height (mm) over the rail's profile at a place (mm).
  double height(const Scene &scene, const double x, const double y)
  {
    return 1e3 * scene.shapes().rail_height(1e-3 * x, 1e-3 * y);
  }

  void check_dips(tests::Check &check)
  {
    const Settings dip{"Defect/Shape=dip",      "Defect/Position (mm)=-5", "Defect/Length (mm)=20",
                       "Defect/Depth (mm)=0.3", "Motion/Start (mm)=-30",   "Motion/Rolled distance (mm)=60"};
    const auto     scene =
      scene_of(dip, {"Defect/Width (mm)=12", "Defect/Lateral position (mm)=5",
                     "Defect/Rounded leading edge (mm)=2", "Defect/Rounded trailing edge (mm)=4"});
    constexpr double picometre = 1e-9; // mm
    check.absolute("dip: deepest, mm", height(*scene, 5., 5.), -0.3, picometre);
    check.absolute("dip: half of the way to its side, mm", height(*scene, 5., 8.), -0.3 * 0.75, picometre);
    check.absolute("dip: the same to the other side, mm", height(*scene, 5., 2.), -0.3 * 0.75, picometre);
    check.absolute("dip: beyond its width, mm", height(*scene, 5., 13.), 0., picometre);
    check.absolute("dip: the same to the other side, mm", height(*scene, 5., -3.), 0., picometre);
    check.absolute("dip: not on the gauge side, mm", height(*scene, 5., -5.), 0., picometre);
    // A parabola that takes a kink of the slope s over the length R passes s R/8 below it; s is four depths
    // over the length.
    check.absolute("dip: at the rounded leading edge, mm", height(*scene, -5., 5.), -0.06 * 2. / 8.,
                   picometre);
    check.absolute("dip: at the rounded trailing edge, mm", height(*scene, 15., 5.), -0.06 * 4. / 8.,
                   picometre);
    check.absolute("dip: where the rounding is over, mm", height(*scene, 17.5, 5.), 0., picometre);

    // As wide as it is long, with sharp edges, twice.
    const auto round = scene_of(dip, {"Defect/Repeated at (mm)=30"});
    check.absolute("round dip: half of the way to its side, mm", height(*round, 5., -5.), -0.3 * 0.75,
                   picometre);
    check.absolute("round dip: its edge, mm", height(*round, 15., 0.), 0., picometre);
    check.absolute("round dip: the second, mm", height(*round, 40., 0.), -0.3, picometre);

    // From the middle to a semi-axis behind the trailing edge.
    const auto         peaks  = scene_of(dip, {"Peak stress/Region=trailing edge"});
    const Scene::Range region = peak_range(*peaks);
    check.absolute("peaks: from the middle of the dip, mm", 1e3 * region.begin, 5., 1e-9);
    check.absolute("peaks: to a semi-axis behind its end, mm", 1e3 * region.end,
                   15. + 1e3 * peaks->stance().ellipse(peaks->static_load()).semi_axis_x, 1e-9);
    // As wide as the patch, but no wider than to where a round edge runs at 45 degrees.
    const double patch = 1e3 * peaks->stance().ellipse(peaks->static_load()).semi_axis_y;
    check.absolute("peaks: half width of the patch, mm", 1e3 * peak_half_width(*peaks), patch, 1e-9);
    for (const Settings &narrow :
         {Settings{"Defect/Width (mm)=6"}, Settings{"Defect/Length (mm)=6", "Defect/Depth (mm)=0.05"},
          Settings{"Defect/Length (mm)=6", "Defect/Shape=none"}})
      {
        Settings settings = narrow;
        settings.push_back("Peak stress/Region=trailing edge");
        check.absolute("peaks: half width with " + narrow.front(),
                       1e3 * peak_half_width(*scene_of(dip, settings)), 3. * std::sqrt(0.5), 1e-9);
      }
    const auto         chosen = scene_of(dip, {"Peak stress/Region=range", "Peak stress/From (mm)=3",
                                               "Peak stress/To (mm)=17", "Peak stress/Half width (mm)=4"});
    const Scene::Range range  = peak_range(*chosen);
    check.absolute("peaks: from, mm", 1e3 * range.begin, 3., 1e-9);
    check.absolute("peaks: to, mm", 1e3 * range.end, 17., 1e-9);
    check.absolute("peaks: half width, mm", 1e3 * peak_half_width(*chosen), 4., 1e-9);

    // The wheel ends at 30 mm, and its patch a semi-axis of some 7 mm further on; not to be sure has room.
    const auto met = [&](const Settings &more) {
      return defect_in_words(*scene_of(dip, more)).find("does NOT reach it") == std::string::npos;
    };
    check.that("a dip under the path is met", met({}));
    check.that("one before the start is not", !met({"Defect/Position (mm)=-70"}));
    check.that("one that the patch reaches at its end is", met({"Defect/Position (mm)=36"}));
    check.that("one beyond is not", !met({"Defect/Position (mm)=45"}));
    check.that("it is on a longer way", met({"Defect/Position (mm)=45", "Motion/Longest distance (mm)=80"}));
    check.that("so is one that lies beyond with another on the way",
               met({"Defect/Position (mm)=45", "Defect/Repeated at (mm)=10"}));
    check.that("one between two wheels is not",
               !met({"Defect/Position (mm)=-500", "Further wheels/Distances (mm)=1000"}));
    check.that("one under the second wheel is",
               met({"Defect/Position (mm)=-1000", "Further wheels/Distances (mm)=1000"}));
    check.that("one beside the patch is not",
               !met({"Defect/Lateral position (mm)=18", "Defect/Width (mm)=8"}));
    const std::vector<std::string> beyond = doubts(*scene_of(dip, {"Defect/Position (mm)=45"}));
    check.that("which is a doubt",
               beyond.size() == 1 && has(beyond, "NOT reach the defect, from 45.00 to 65.00 mm"));
    check.that("and only then", doubts(*scene_of(dip)).empty());
  }


  /// A table of heights (mm) over x and y (mm), a node each half a millimetre.
  std::string map_of(const double                                 length,
                     const double                                 half_width,
                     const std::function<double(double, double)> &height)
  {
    std::ostringstream text;
    text << "x_mm,y_mm,z_mm\n";
    for (int j = -std::lround(2. * half_width); j <= std::lround(2. * half_width); ++j)
      for (int i = 0; i <= std::lround(2. * length); ++i)
        text << 0.5 * i << ',' << 0.5 * j << ',' << height(0.5 * i, 0.5 * j) << '\n';
    return text.str();
  }

  /// What stands above the rail is met from a distance, but not from any.
  void check_bumps(tests::Check &check, const TemporaryFolder &folder)
  {
    // The wheel rolls from -30 to 30 mm.
    const auto met = [&](const std::string &file, const Settings &more) {
      return !misses_defect(*scene_of({"Defect/Shape=map", "Defect/Profile file=" + file,
                                       "Motion/Start (mm)=-30", "Motion/Rolled distance (mm)=60"},
                                      more));
    };
    const auto hump = [](const double x, const double y) {
      return std::max(0., 1. - std::pow(x / 8. - 1., 2) - std::pow(y / 8., 2));
    };
    const std::string bump = folder.write(
                        "bump.csv",
                        map_of(16., 8., [&](const double x, const double y) { return 0.1 * hump(x, y); })),
                      // a bowl with a rim of half a micrometre, as splines leave one
      bowl = folder.write("bowl.csv", map_of(16., 8., [&](const double x, const double y) {
                            return -0.1 * hump(x, y) +
                                   0.0005 * (std::hypot(x - 8., y) > 7. && std::hypot(x - 8., y) < 7.9);
                          }));
    check.that("a bowl under the path is met", met(bowl, {"Defect/Position (mm)=0"}));
    check.that("a bowl behind its end is not", !met(bowl, {"Defect/Position (mm)=45"}));
    check.that("a bowl before its start is not", !met(bowl, {"Defect/Position (mm)=-60"}));
    check.that("a bowl beside the patch is not",
               !met(bowl, {"Defect/Position (mm)=0", "Defect/Lateral position (mm)=19"}));
    // A wheel of 0.46 m touches 0.1 mm from sqrt(2 x 460 x 0.1) = 9.6 mm on.
    check.that("a bump is met from further away", met(bump, {"Defect/Position (mm)=44"}));
    check.that("but not from any distance", !met(bump, {"Defect/Position (mm)=54"}));
    check.that("nor before the start", !met(bump, {"Defect/Position (mm)=-75"}));
  }

  /// Detail of a defect's file that cells do not see, and heights that are in another unit.
  void check_detail(tests::Check &check, const TemporaryFolder &folder)
  {
    const Settings base{"Defect/Shape=profile",           "Defect/Lateral law=uniform",
                        "Defect/Position (mm)=-20",       "Motion/Start (mm)=-30",
                        "Motion/Rolled distance (mm)=60", "Mesh/Finest cell (mm)=1.3"};
    const auto     line = [&](const std::string &name, const std::function<double(double)> &height) {
      std::ostringstream text;
      for (int i = 0; i <= 800; ++i)
        text << 0.05 * i << ' ' << height(0.05 * i) << '\n';
      return "Defect/Profile file=" + folder.write(name, text.str());
    };
    const double pi    = dealii::numbers::PI;
    const auto   waves = [=](const double x) {
      return -0.05 * (1. - std::cos(2. * pi * x / 40.));
    };
    const auto seen = scene_of(base, {line("smooth.txt", waves)}),
               step = scene_of(
                 base, {line("step.txt", [](const double x) { return x > 0. && x < 40. ? -0.012 : 0.; })}),
               noise =
                 scene_of(base, {line("noise.txt", [&](const double x) {
                            return waves(x) - (x > 0. && x < 40. ? 0.008 * (1. + std::sin(1e4 * x * x)) : 0.);
                          })});
    check.that("a smooth line has no doubts", doubts(*seen).empty());
    check.that("a step has", has(doubts(*step), "detail along the rail"));
    check.that("noise has", has(doubts(*noise), "detail along the rail"));
    // A sine of two cells' length between nodes at its zeros is not seen at all; a straight line through
    // nodes leaves the root of its mean square, 1/sqrt(2), and a cubic next to that.
    const auto sine =
      scene_of(base, {line("sine.txt",
                           [&](const double x) {
                             return x > 0. && x < 40. ? -0.01 - 0.004 * std::cos(2. * pi * x / 1.3) : 0.;
                           }),
                      "Defect/Ramp (mm)=8"});
    check.that("waves of a cell's length are seen by no node",
               detail_along(*sine) > 2e-6 && detail_along(*sine) < 8e-6);
    check.that("heights in m are refused",
               tests::complaint<std::exception>([&]() {
                 scene_of(base, {line("metres.txt", [&](const double x) { return 1e-3 * 0.5 * waves(x); })});
               }).find("heights in m") != std::string::npos);
    const std::vector<std::string> values = implausible_values(
      *scene_of({"Wheel/Mass (kg)=0.9", "Vehicle/Sprung mass (kg)=9", "Motion/Rolled distance (mm)=60",
                 "Mesh/Finest cell (mm)=0.1", "Rail/Density (kg per m3)=7.8"}));
    check.that("masses and density in t", values.size() == 3 && has(values, "'Wheel/Mass (kg)' 0.9") &&
                                            has(values, "'Vehicle/Sprung mass (kg)' 9") &&
                                            has(values, "'Rail/Density (kg per m3)' 7.8"));
    const auto loaded = [](const Settings &more) {
      return implausible_values(*scene_of({"Motion/Rolled distance (mm)=60"}, more));
    };
    check.that("an axle load in kN",
               has(loaded({"Vehicle/Axle load (t)=180"}), "'Vehicle/Axle load (t)' 180"));
    check.that("masses that are exchanged",
               has(loaded({"Wheel/Mass (kg)=9000", "Vehicle/Sprung mass (kg)=700"}), "are they exchanged"));
    check.that("masses of a light wagon",
               loaded({"Wheel/Mass (kg)=1500", "Vehicle/Sprung mass (kg)=1200"}).empty());
    const std::string in_newton =
      folder.write("newton.csv", "support,ballast_damping_kN_s_per_m\n0,33\n1,33000\n");
    check.that("a damper of one support in N s per m",
               has(implausible_values(*scene_of(on_track, {"Track/Support file=" + in_newton})),
                   "support 1: ballast_damping_kN_s_per_m 33000"));
    // Where a wheel begins on its defect: the path is from -30 to 30 mm, the patch 16 mm long.
    const auto dip_from = [&](const std::string &position) {
      return doubts(*scene_of({"Motion/Start (mm)=-30", "Motion/Rolled distance (mm)=60", "Defect/Shape=dip",
                               "Defect/Length (mm)=18", "Defect/Depth (mm)=0.08"},
                              {"Defect/Position (mm)=" + position}));
    };
    check.that("a wheel in the middle of its dip", has(dip_from("-40"), "begins on the defect"));
    check.that("a patch over its leading edge", has(dip_from("-25"), "begins on the defect"));
    check.that("a dip ahead", !has(dip_from("-15"), "begins on the defect"));
  }

  /// Tables along the path that have no place on it.
  void check_unused_tables(tests::Check &check)
  {
    const auto unused = [](const Settings &more) {
      return scene_of({"Motion/Start (mm)=-30", "Motion/Rolled distance (mm)=60"}, more)->unused_parameters();
    };
    check.that("friction places on the path count",
               unused({"Contact/Friction places (mm)=0,200", "Contact/Friction factors=1,0.9"}).empty());
    check.that("those behind it do not",
               has(unused({"Contact/Friction places (mm)=100,200", "Contact/Friction factors=0.9,1"}),
                   "the friction factor is 0.9 on all of it"));
    check.that("those before it do not",
               has(unused({"Contact/Friction places (mm)=-300,-200", "Contact/Friction factors=0.9,1"}),
                   "Friction places"));
    check.that("pressures in Pa", has(unused({"Contact/Friction pressures (MPa)=100000,900000",
                                              "Contact/Friction pressure factors=1,0.8"}),
                                      "no wheel on a rail"));
    check.that("pressures of a wheel",
               unused({"Contact/Friction pressures (MPa)=200,900", "Contact/Friction pressure factors=1,0.8"})
                 .empty());
    check.that("a traction coefficient beside a creepage",
               has(unused({"Motion/Creepage=0.001", "Motion/Traction coefficient=0.2"}),
                   "'Motion/Traction coefficient' has no effect: it needs 'Motion/Creepage' predicted"));
    check.that("a traction coefficient alone", unused({"Motion/Traction coefficient=0.2"}).empty());
    check.that(
      "a torque has one beside a creepage",
      unused({"Motion/Drive=torque", "Motion/Creepage=0.001", "Motion/Traction coefficient=0.2"}).empty());
    check.that("traction coefficients of further wheels beside one of the first",
               unused({"Motion/Traction coefficient=0.2", "Further wheels/Distances (mm)=1000",
                       "Further wheels/Traction coefficients=0.1"})
                 .empty());
    const Settings dip{"Defect/Shape=dip", "Defect/Length (mm)=30", "Defect/Depth (mm)=0.1"};
    check.that("a dip has no ramp", has(unused({dip[0], dip[1], dip[2], "Defect/Ramp (mm)=10"}),
                                        "'Defect/Ramp (mm)' has no effect: it needs 'Defect/Shape'"));
    check.that("nothing else of a dip is without effect", unused(dip).empty());
    check.that("a zone beside the path",
               has(unused({"Rail/Yield stress (MPa)=500", "Rail/Plastic zones=500:600:8:400:21",
                           "Rail/Begin (mm)=-700", "Rail/Length (mm)=1500"}),
                   "'Rail/Plastic zones' from 500 to 600 mm"));
  }

  /// Which memory friction takes that falls.
  void check_unmatched(tests::Check &check)
  {
    const auto says = [](const Settings &settings, const std::string &words) {
      return has(doubts(*scene_of(settings)), words);
    };
    const std::string words = "'Solid/Matched surface' has little or no effect on ";
    check.that("steel is matched", !says({}, words));
    check.that("the wheel is not",
               says({"Wheel/Poisson's ratio=0.42"}, words + "the wheel: there are no positive weights for a "
                                                            "Poisson's ratio of 0.42"));
    check.that("neither is", says({"Solid/Hourglass coefficient=0.05"}, words + "the wheel and the rail"));
    // Cubes alone may have weights where cells that differ from them by a twentieth have none.
    for (const auto &[setting, is_matched] :
         {std::pair("Rail/Poisson's ratio=0.18", false), std::pair("Rail/Poisson's ratio=0.19", true),
          std::pair("Rail/Poisson's ratio=0.38", true), std::pair("Rail/Poisson's ratio=0.385", false),
          std::pair("Solid/Hourglass coefficient=0.25", false),
          std::pair("Solid/Hourglass coefficient=0.3", true)})
      check.that(setting, says({setting}, words) != is_matched);
    check.that("nobody asked for it",
               !says({"Rail/Poisson's ratio=0.42", "Solid/Matched surface=false"}, words));
  }

  void check_memory(tests::Check &check)
  {
    const Settings falling{"Contact/Friction law=falling",
                           "Contact/Friction coefficient=0.3",
                           "Contact/Kinetic friction coefficient=0.1",
                           "Motion/Traction coefficient=0.1",
                           "Contact/Falling slip speed (m per s)=1",
                           "Motion/Speed (km per h)=144",
                           "Motion/Creepage=0.01"};
    const auto     memory = [&](const Settings &more) {
      return 1e6 * friction_law(*scene_of(falling, more))->memory().distance;
    };
    // Slip of 0.02 x 40 m/s: s|f'| is largest there, 0.8 x 0.2 exp(-0.8); load 140 kN, R 460 mm, E 210 GPa.
    const auto   scene    = scene_of(falling);
    const double modulus  = 0.5 * scene->rail.material.young_modulus / (1. - 0.09),
                 a        = std::cbrt(0.75 * scene->static_load() * 0.46 / modulus),
                 pressure = 1.5 * scene->static_load() / (dealii::numbers::PI * a * a);
    check.relative("memory, um", memory({}),
                   1e6 * 3. * pressure * 0.8 * 0.2 * std::exp(-0.8) * a /
                     scene->rail.material.elastic().shear_modulus(),
                   0.01);
    check.absolute("memory as given, um", memory({"Contact/Friction memory (mm)=0.07"}), 70., 1e-9);
    check.absolute("none where waves carry away what falls, um",
                   memory({"Contact/Falling slip speed (m per s)=80"}), 0., 0.);
    // A fall of 0.2 x 1.06 GPa over 8 m/s is twice what waves carry, and two fifths of it in cells of 25
    // times the density, which shake all the same.
    check.relative(
      "memory with scaled density, um",
      memory({"Contact/Falling slip speed (m per s)=8", "Scene/Density scale=25", "Scene/Quasi-static=true"}),
      memory({"Contact/Falling slip speed (m per s)=8"}), 1e-12);
    check.that("memory of a slow fall", memory({"Contact/Falling slip speed (m per s)=8"}) > 1.);
    check.that("none at all is a doubt",
               has(doubts(*scene_of(falling, {"Contact/Friction memory (mm)=0"})), "lets slip oscillate"));
    check.that("what is taken is not", doubts(*scene_of(falling)).empty());
  }

  void check_profiles(tests::Check &check, const TemporaryFolder &folder)
  {
    // 40 mm long, deepest by 0.2 mm a quarter of the way from its beginning.
    const std::string file = folder.write("profile.txt", "0 0\n10 -0.2\n20 -0.1\n30 -0.05\n40 0\n");
    const Settings    profile{"Defect/Shape=profile",          "Defect/Profile file=" + file,
                           "Defect/Position (mm)=-20",      "Defect/Width (mm)=20",
                           "Motion/Start (mm)=-30",         "Motion/Rolled distance (mm)=60",
                           "Defect/Lateral position (mm)=3"};
    constexpr double  picometre = 1e-9; // mm
    const auto        as_it_is  = scene_of(profile);
    check.absolute("profile: deepest, mm", height(*as_it_is, -10., 3.), -0.2, picometre);
    check.absolute("profile: behind it, mm", height(*as_it_is, 0., 3.), -0.1, picometre);
    check.absolute("profile: its end, mm", height(*as_it_is, 20., 3.), 0., picometre);
    check.absolute("profile: half of the way to its side, mm", height(*as_it_is, -10., 8.), -0.15, picometre);
    check.absolute("profile: the same to the other side, mm", height(*as_it_is, -10., -2.), -0.15, picometre);
    check.absolute("profile: beyond its width, mm", height(*as_it_is, -10., -7.5), 0., picometre);

    const auto other = scene_of(profile, {"Defect/Reversed=true", "Defect/Length (mm)=48",
                                          "Defect/Depth (mm)=0.5", "Defect/Lateral law=uniform"});
    check.absolute("profile from its other end, longer and deeper: deepest, mm", height(*other, 16., 3.),
                   -0.5, picometre);
    check.absolute("profile from its other end: in the middle, mm", height(*other, 4., 3.), -0.25, picometre);
    check.absolute("profile from its other end: a quarter before, mm", height(*other, -8., 3.), -0.125,
                   picometre);
    check.absolute("uniform profile: 20 mm to the gauge side, mm", height(*other, 16., -20.), -0.5,
                   picometre);
    check.absolute("uniform profile: 20 mm to the field side, mm", height(*other, 16., 20.), -0.5, picometre);
  }


  void check_corrugation(tests::Check &check, const TemporaryFolder &folder)
  {
    const Settings   waves{"Defect/Shape=corrugation", "Defect/Position (mm)=-20",
                         "Defect/Length (mm)=60",    "Defect/Wavelength (mm)=20",
                         "Defect/Depth (mm)=0.05",   "Defect/Lateral law=uniform",
                         "Motion/Start (mm)=-30",    "Motion/Rolled distance (mm)=80"};
    constexpr double picometre = 1e-9; // mm
    const auto       whole     = scene_of(waves);
    check.absolute("corrugation: its first trough, mm", height(*whole, -10., 0.), -0.05, picometre);
    check.absolute("corrugation: a crest, 20 mm to the side, mm", height(*whole, 20., -20.), 0., picometre);
    check.absolute("corrugation: on its flank, mm", height(*whole, 25., 11.), -0.025, picometre);
    check.absolute("corrugation: behind it, mm", height(*whole, 50., 0.), 0., picometre);
    const auto narrow = scene_of(waves, {"Defect/Lateral law=parabola", "Defect/Width (mm)=20",
                                         "Defect/Lateral position (mm)=2", "Defect/Ramp (mm)=30"});
    check.absolute("corrugation with ramps: in its middle, mm", height(*narrow, 10., 2.), -0.05, picometre);
    check.absolute("corrugation with ramps: half of the way to its side, mm", height(*narrow, 10., 7.),
                   -0.0375, picometre);
    check.absolute("corrugation with ramps: a third of the first, mm", height(*narrow, -10., 2.),
                   -0.05 * 0.25, picometre);

    const auto refused = [&](const std::string &what, const std::string &words, const Settings &more) {
      const std::string said = tests::complaint<InputError>([&] { scene_of(waves, more); });
      check.that(what + ": \"" + said + "\"", said.find(words) != std::string::npos);
    };
    refused("corrugation that ends in a step", "2.5 wavelengths", {"Defect/Length (mm)=50"});
    refused("waves shorter than its cells carry", "is lost between cells", {"Defect/Wavelength (mm)=3"});
    refused("a ramp that is a step", "'Defect/Ramp (mm)' 1 is a step", {"Defect/Ramp (mm)=1"});
    refused("a ramp longer than half of it", "'Defect/Ramp (mm)' 31", {"Defect/Ramp (mm)=31"});
    refused("no wavelength", "'Defect/Wavelength (mm)'", {"Defect/Wavelength (mm)=0"});

    // A map that ends 0.1 mm below the surface, and fades by a ramp.
    std::string text = "x_mm,y_mm,z_mm\n";
    for (int x = 0; x <= 40; x += 4)
      for (int y = -8; y <= 8; y += 2)
        text += std::to_string(x) + "," + std::to_string(y) + "," + (std::abs(y) < 8 ? "-0.1\n" : "0\n");
    const Settings map{"Defect/Shape=map", "Defect/Profile file=" + folder.write("channel.csv", text),
                       "Defect/Position (mm)=-20", "Motion/Start (mm)=-30", "Motion/Rolled distance (mm)=60"};
    const auto     channel = scene_of(map, {"Defect/Ramp (mm)=10"});
    check.absolute("map with ramps: its beginning, mm", height(*channel, -20., 0.), 0., picometre);
    check.absolute("map with ramps: half of the ramp, mm", height(*channel, -15., 0.), -0.05, picometre);
    check.absolute("map with ramps: its middle, mm", height(*channel, 0., 0.), -0.1, picometre);
    // Deepest where a ramp takes half of it: the depth is that which is left, or as given.
    const std::string bowl = folder.write("bowl.txt", "0 0\n5 -0.1\n15 -0.1\n20 0\n");
    const Settings    profile{"Defect/Shape=profile",     "Defect/Profile file=" + bowl,
                           "Defect/Position (mm)=-10", "Defect/Lateral law=uniform",
                           "Motion/Start (mm)=-30",    "Motion/Rolled distance (mm)=60",
                           "Defect/Ramp (mm)=8"};
    for (const auto &[depth, expected] : {std::pair("0", 0.), std::pair("0.3", 0.3)})
      {
        const auto scene  = scene_of(profile, {std::string("Defect/Depth (mm)=") + depth});
        double     lowest = 0., highest = 0.;
        for (double x = -10.; x <= 10.; x += 0.01)
          {
            lowest  = std::min(lowest, height(*scene, x, 0.));
            highest = std::max(highest, height(*scene, x, 0.));
          }
        check.relative(std::string("profile with ramps: depth in words, of ") + depth + " mm, mm",
                       1e3 * scene->shapes().defect->depth, std::max(-lowest, highest), 1e-4);
        if (expected > 0.)
          check.relative("profile with ramps: as deep as given, mm", std::max(-lowest, highest), expected,
                         1e-4);
      }
    const std::string step = tests::complaint<InputError>([&] { scene_of(map); });
    check.that("the same without: \"" + step + "\"", step.find("a step") != std::string::npos);
  }


  void check_maps(tests::Check &check, const TemporaryFolder &folder)
  {
    // Deepest towards its end on the gauge side; a shallow place on the field side.
    std::string text = "x_mm,y_mm,z_mm\n";
    for (int x = 0; x <= 40; x += 4)
      for (int y = -8; y <= 12; y += 2)
        text += std::to_string(x) + "," + std::to_string(y) + "," +
                (x == 32 && y == -4  ? "-0.3\n"
                 : x == 12 && y == 6 ? "-0.1\n"
                                     : "0\n");
    const Settings   map{"Defect/Shape=map", "Defect/Profile file=" + folder.write("map.csv", text),
                       "Defect/Position (mm)=-20", "Motion/Start (mm)=-30", "Motion/Rolled distance (mm)=60"};
    constexpr double picometre = 1e-9; // mm
    const auto       as_it_is  = scene_of(map);
    check.absolute("map: deepest, on the gauge side, mm", height(*as_it_is, 12., -4.), -0.3, picometre);
    check.absolute("map: the other place, mm", height(*as_it_is, -8., 6.), -0.1, picometre);
    check.absolute("map: where a mirrored one were deepest, mm", height(*as_it_is, 12., 8.), 0., picometre);
    check.absolute("map: where a reversed one were deepest, mm", height(*as_it_is, -12., -4.), 0., picometre);

    const auto other = scene_of(map, {"Defect/Reversed=true", "Defect/Length (mm)=48",
                                      "Defect/Depth (mm)=0.6", "Defect/Lateral position (mm)=3"});
    check.absolute("map from its other end, longer and deeper, 3 mm beside: deepest, mm",
                   height(*other, -20. + 9.6, -1.), -0.6, picometre);
    check.absolute("map from its other end: the other place, mm", height(*other, -20. + 33.6, 9.), -0.2,
                   picometre);
  }


  void check_surfaces(tests::Check &check, const TemporaryFolder &folder)
  {
    for (const auto &[name, slope] :
         {std::pair("none", 0.), std::pair("1:40", 0.025), std::pair("1:20", 0.05)})
      check.absolute("inclination " + std::string(name),
                     std::tan(scene_of({"Rail/Inclination=" + std::string(name)})->rail.angle()), slope,
                     round_off);

    // The running circle lies 3 mm to the field side; the cone is thicker towards the gauge side.
    const auto beside =
      scene_of({"Rail/Inclination=1:20", "Wheel/Tread profile=cone 1:20", "Wheel/Lateral position (mm)=3"});
    const auto &offset = beside->shapes().surfaces.tread_offset;
    check.absolute("tread on its running circle, mm", 1e3 * offset(3e-3), 0., 1e-9);
    check.absolute("tread 10 mm to the field side of it, mm", 1e3 * offset(13e-3), -0.5, 1e-9);
    check.absolute("tread 10 mm to the gauge side of it, mm", 1e3 * offset(-7e-3), 0.5, 1e-9);

    // A head worn by a thousandth of the distance from its middle, measured up to 27 mm.
    const RailProfile  profile = RailProfile::rail_54e1();
    std::ostringstream points;
    points << std::setprecision(12);
    for (int y = -27; y <= 27; ++y)
      points << y << ' ' << 1e3 * profile.z_top(1e-3 * y) - 1e-3 * std::abs(y) << '\n';
    const auto       worn      = scene_of({"Rail/Measured head=" + folder.write("head.txt", points.str())});
    constexpr double picometre = 1e-8; // mm, of a file with 12 digits
    check.absolute("measured head: 20 mm to the field side, mm", height(*worn, 0., 20.), -0.02, picometre);
    check.absolute("measured head: 20 mm to the gauge side, mm", height(*worn, 0., -20.), -0.02, picometre);
    // It fades over 5 mm beside what was measured.
    check.absolute("measured head: half of it 2.5 mm beside, mm", height(*worn, 0., 29.5), -0.0135,
                   picometre);
    check.absolute("measured head: the same to the gauge side, mm", height(*worn, 0., -29.5), -0.0135,
                   picometre);
    check.absolute("measured head: nothing 5 mm beside, mm", height(*worn, 0., 32.5), 0., picometre);
    check.that("a new rail has no heights", !beside->shapes().rail_height);

    // Depth counts from the crown of 300 mm radius, at x, y.
    const auto                  cells     = scene_of({"Output/Cells=-3,8,2;5,-4,3.5"});
    const std::vector<Point<3>> points_of = recorded_cells(*cells);
    const std::vector<Point<3>> expected{{-3., 8., std::sqrt(300. * 300. - 64.) - 300. - 2.},
                                         {5., -4., std::sqrt(300. * 300. - 16.) - 300. - 3.5}};
    check.absolute("cells", points_of.size(), 2, 0.);
    for (unsigned int i = 0; i < std::min<std::size_t>(points_of.size(), 2); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        check.absolute("cell " + std::to_string(i + 1) + ": " + "xyz"[d] + ", mm", 1e3 * points_of[i][d],
                       expected[i][d], 1e-9);
  }


  void check_mesh(tests::Check &check)
  {
    // A load that doubles or triples makes the patch wider by its cube root.
    const auto   quasi_static = scene_of(block), dynamic = scene_of(block, {"Scene/Quasi-static=false"});
    const double wider = fine_half_width(*dynamic) / fine_half_width(*quasi_static);
    check.relative("fine half width without impacts: as the patch needs, mm",
                   1e3 * fine_half_width(*quasi_static), 1e3 * needed_half_width(*quasi_static), round_off);
    check.that("fine half width with them: there is room for twice the load", wider > std::cbrt(2.));
    check.that("fine half width with them: not for more than three times the load", wider < std::cbrt(3.));
    check.relative("fine half width as it is given, mm",
                   1e3 * fine_half_width(*scene_of(block, {"Mesh/Fine half width (mm)=11"})), 11., round_off);

    // Cubes from 10 mm before to 30 mm behind the leading edge, elsewhere cells of twice the length.
    const auto scene =
      scene_of(block, {"Mesh/Finest cell (mm)=1", "Mesh/Path cell (mm)=2", "Mesh/Fine from (mm)=-10",
                       "Mesh/Fine to (mm)=30", "Defect/Position (mm)=5", "Motion/Start (mm)=-60",
                       "Motion/Rolled distance (mm)=100"});
    const std::vector<Body> bodies = scene->stance().make_bodies({});
    for (const double x : {-58., -40., -7., -3., 15., 33., 37.})
      {
        const double expected = x > -5. && x < 35. ? 1. : 2.;
        // Rolling takes the wheel from x = -60 mm on.
        const double      radius = scene->wheel.radius, angle = 1e-3 * (x + 60.) / radius, depth = 0.1e-3;
        const std::string at = "largest cell at x = " + std::to_string(int(x)) + " mm, mm: ";
        check.relative(at + "rail", 1e3 * bodies[0].wanted_cell_size(Point<3>(1e-3 * x, 0., -depth)),
                       expected, round_off);
        check.relative(at + "wheel where it touches there",
                       1e3 * bodies[1].wanted_cell_size(
                               Point<3>(-60e-3 + (radius - depth) * std::sin(angle), 0.,
                                        scene->axle_height() - (radius - depth) * std::cos(angle))),
                       expected, round_off);
      }
  }


  void check_half_space(tests::Check &check)
  {
    // A cone that becomes thinner to the field side.
    const auto scene = scene_of(
      {"Rail/Inclination=1:20", "Wheel/Tread profile=cone 1:20", "Motion/Lateral creepage=0.0011",
       "Motion/Spin (1 per m)=0.13", "Motion/Speed (km per h)=72", "Motion/Traction coefficient=0.17",
       "Contact/Friction coefficient=0.43", "Wheel/Young's modulus (GPa)=205", "Wheel/Poisson's ratio=0.29",
       "Rail/Young's modulus (GPa)=207", "Rail/Poisson's ratio=0.28"});
    const reference::RollingCase c       = half_space_case(*scene);
    const double                 rolling = scene->stance().rolling_radius();
    check.relative("half-space: radius 10 mm to the field side, relative", c.radius_change(10e-3),
                   -0.5e-3 / rolling, 1e-6);
    check.relative("half-space: radius 10 mm to the gauge side, relative", c.radius_change(-10e-3),
                   0.5e-3 / rolling, 1e-6);
    check.relative("half-space: Young's modulus of the wheel, GPa", 1e-9 * c.wheel.young, 205., round_off);
    check.relative("half-space: Young's modulus of the rail, GPa", 1e-9 * c.rail.young, 207., round_off);
    check.relative("half-space: Poisson's ratio of the wheel", c.wheel.poisson, 0.29, 0.);
    check.relative("half-space: Poisson's ratio of the rail", c.rail.poisson, 0.28, 0.);
    check.relative("half-space: lateral creepage", c.lateral_creepage, 0.0011, 0.);
    check.relative("half-space: spin, 1/m", c.spin, 0.13, 0.);
    check.relative("half-space: speed, m/s", c.speed, 20., round_off);
    check.relative("half-space: friction", c.friction, 0.43, 0.);
    check.relative("half-space: traction coefficient", c.traction_coefficient, 0.17, 0.);
    check.that("half-space: the force is prescribed", c.prescribe_force);
    check.relative("half-space: load, kN", 1e-3 * c.normal_force, 1e-3 * scene->static_load(), 0.);

    // A wheel and a crown of the same radius touch like a sphere on a plane. Below the pressure p a surface
    // is strained by -(1 + nu)(1 - 2 nu) p/E along x and y together, half of it along x; the mean of p
    // weighted with p is three quarters of the largest. A rail of twice the stiffness is strained half as
    // much, and thus by more than the wheel.
    const auto   unlike = scene_of({"Rail/Shape=block", "Rail/Crown radius (mm)=460", "Wheel/Radius (mm)=460",
                                    "Rail/Young's modulus (GPa)=400", "Rail/Poisson's ratio=0.2",
                                    "Wheel/Young's modulus (GPa)=200", "Wheel/Poisson's ratio=0.3"});
    const double modulus = 1. / ((1. - 0.04) / 400e9 + (1. - 0.09) / 200e9), radius_of_both = 0.46; // Pa, m
    const double pressure = std::cbrt(6. * unlike->static_load() * modulus * modulus /
                                      (std::pow(dealii::numbers::PI, 3) * radius_of_both * radius_of_both));
    const double of_rail  = -1.2 * 0.6 / 400e9 * 0.375 * pressure,
                 of_wheel = -1.3 * 0.4 / 200e9 * 0.375 * pressure;
    check.relative("unlike materials: stretch of the rail less the wheel's, 1e-6",
                   1e6 * half_space_stretch(*unlike), 1e6 * (of_rail - of_wheel), 1e-6);
    check.below("like materials: stretch, 1e-6", 1e6 * half_space_stretch(*scene_of(block)), round_off);
  }


  /// Parts of a patch hang together over edges and corners of elements, and each has its own force.
  void check_islands(tests::Check &check)
  {
    reference::Grid grid;
    grid.n_x              = 5;
    grid.n_y              = 4;
    grid.dx               = 2e-3;
    grid.dy               = 1e-3;
    const std::size_t row = grid.n_x;
    check.that("islands of no pressure: none",
               islands_of(grid, std::vector<double>(row * grid.n_y, 0.)).empty());
    // Three elements, of which two touch at a corner, and one in the last row.
    std::vector<double> pressure(row * grid.n_y, 0.);
    pressure[0]                       = 1e6;
    pressure[1]                       = 2e6;
    pressure[row + 2]                 = 3e6;
    pressure[3 * row + 4]             = 5e6;
    const std::vector<Island> islands = islands_of(grid, pressure);
    if (!check.absolute("islands", islands.size(), 2., 0.))
      return;
    const double x = 1e3 * (grid.x(0) - 0.5 * grid.dx), y = 1e3 * (grid.y(0) - 0.5 * grid.dy);
    const double expected[2][5] = {{x, x + 6., y, y + 2., 12.}, {x + 8., x + 10., y + 3., y + 4., 10.}};
    for (unsigned int i = 0; i < 2; ++i)
      {
        const Island     &island = islands[i];
        const std::string name   = i == 0 ? "first island: " : "second island: ";
        check.absolute(name + "it begins at x, mm", 1e3 * island.x_begin, expected[i][0], round_off);
        check.absolute(name + "it ends at x, mm", 1e3 * island.x_end, expected[i][1], round_off);
        check.absolute(name + "it begins at y, mm", 1e3 * island.y_begin, expected[i][2], round_off);
        check.absolute(name + "it ends at y, mm", 1e3 * island.y_end, expected[i][3], round_off);
        check.relative(name + "normal force, N", island.force, expected[i][4], round_off);
      }
  }


  /// The difference from a micro-slip of the half-space that is as good as nothing is not given as a share.
  void check_negligible_slip(tests::Check &check)
  {
    reference::RollingEstimate half_space;
    for (const double slip : {0.5e-3, 2e-3})
      {
        half_space.max_slip.value = slip;
        ContactAnswer answer;
        answer.patch.max_slip = 1.25 * slip;
        Summary summary;
        compare(summary, answer, half_space, false);
        const auto  figures = nlohmann::json::parse(summary.text());
        const auto &difference =
          figures["reference"]["max_slip_m_per_s"]["half-space"]["relative_difference"];
        if (slip < 1e-3)
          check.that("half a millimetre a second of micro-slip: no difference is given",
                     difference.is_null());
        else
          check.relative("two millimetres a second of micro-slip: the difference",
                         difference.is_number() ? difference.get<double>() : 0., 0.25, 1e-9);
      }
  }


  /// Beside a half-space that rolls at the same creepage stands the traction, as a share of the own normal
  /// force.
  void check_compared_traction(tests::Check &check)
  {
    reference::RollingEstimate half_space;
    half_space.longitudinal_force.value   = 20e3;
    half_space.lateral_force.value        = -8e3;
    half_space.traction_coefficient.value = 0.2;
    half_space.fields.normal_force        = 100e3;
    ContactAnswer answer;
    answer.force               = Vector3{27.5e3, -11e3, 110e3, 0.};
    answer.patch.normal_force  = 110e3;
    answer.patch.lateral_force = -11e3;
    Summary summary;
    compare(summary, answer, half_space, false);
    const auto        figures   = nlohmann::json::parse(summary.text());
    const std::string given[2]  = {"traction_coefficient", "lateral_coefficient"};
    const double      values[2] = {0.25, -0.1}, shares[2] = {0.25, 0.25};
    for (unsigned int i = 0; i < 2; ++i)
      {
        check.relative("compared: " + given[i], figures[given[i]].get<double>(), values[i], round_off);
        check.relative("compared: its difference from the half-space's",
                       figures["reference"][given[i]]["half-space"]["relative_difference"].get<double>(),
                       shares[i], round_off);
      }
  }


  /// Both wheels of a wheelset.
  void check_wheelset(tests::Check &check)
  {
    Settings settings{"Rail/Inclination=1:40",          "Wheel/Tread profile=S1002",
                      "Wheelset/Both wheels=true",      "Wheelset/Lateral shift (mm)=2",
                      "Guidance/Kind=springs",          "Guidance/Yaw inertia (kg m2)=47",
                      "Contact/Friction coefficient=0", "Motion/Creepage=0"};
    settings.insert(settings.end(), vehicle.begin(), vehicle.end());
    const auto               scene = scene_of(settings);
    const WheelHubParameters hub   = hub_parameters(*scene);
    check_hub(check, "hub of both wheels: ", hub, 2.);
    // The ellipse is that of the profiles under the patch, which grows with the load.
    check_settling(check, "hub of both wheels: ", *scene, 2., 0.05);
    check.relative("hub of both wheels: arm of the contacts, m", hub.settling->arm, 0.75, 0.01);
    check.relative("hub of both wheels: yaw inertia, kg m2", hub.yaw_inertia, 47., 0.);
    check.relative("hub of both wheels: roll inertia, kg m2", hub.roll_inertia, 47., 0.);

    // How it rolls while it moves across: from where rigid wheels touch a little to both sides.
    constexpr double speed = 0.03, step = 0.2e-3; // m/s, m
    WheelRolling     rolling = wheel_rolling(*scene, 0.);
    rolling.across_speed     = speed;
    // Fine enough for where wheel and rail touch, which is all that counts here.
    rolling.element_x = rolling.element_y = 1e-3;
    const WheelsetPosition position       = scene->wheelset.position();
    const PlacedWheel      wheel(*scene, position, rolling);
    WheelsetPosition       left = position, right = position;
    left.shift -= step;
    right.shift += step;
    const WheelsetPosition before = touching_wheelset(wheel.surfaces, left).position,
                           behind = touching_wheelset(wheel.surfaces, right).position;
    // Elastic wheels touch on an area over which the slopes change.
    check.relative("both wheels: roll rate, mrad/s", 1e3 * wheel.rise().roll_rate,
                   1e3 * speed * (behind.roll - before.roll) / (2. * step), 0.01);
  }


  /// A wheel that is not round in a position: in the mesh, in the depth below its tread, and where it comes
  /// to the rail.
  void check_deviation_of_wheelset(tests::Check &check)
  {
    constexpr double amplitude = 0.05e-3, order = 40., pitch = 0.3; // m, -, rad
    Settings         settings{
      "Rail/Inclination=1:40",    "Wheel/Tread profile=S1002",      "Wheelset/Lateral shift (mm)=6",
      "Wheelset/Yaw (mrad)=14.4", "Wheelset/Roll (mrad)=-0.6272",   "Contact/Friction coefficient=0",
      "Motion/Creepage=0",        "Motion/Rolled distance (mm)=40", "Mesh/Finest cell (mm)=0.7",
      "Scene/Quasi-static=false"};
    settings.insert(settings.end(), vehicle.begin(), vehicle.end());
    const auto round    = scene_of(settings),
               wavy     = scene_of(settings, {"Wheel/Deviation=waves: 40=0.05@0",
                                              "Wheel/Deviation pitch (deg)=" +
                                                std::to_string(pitch * 180. / dealii::numbers::PI)});
    const Body   before = round->stance().make_bodies({})[1], behind = wavy->stance().make_bodies({})[1];
    const double yaw  = round->placed_wheel().contact.position.yaw,
                 roll = round->placed_wheel().contact.position.roll;
    // A roll about x that takes the own side down, then a yaw about what was the vertical.
    const Vector3 ahead{std::cos(yaw), std::cos(roll) * std::sin(yaw), -std::sin(roll) * std::sin(yaw), 0.},
      down{0., -std::sin(roll), -std::cos(roll), 0.},
      middle               = round->placed_wheel().middle() + Vector3{round->path_begin(), 0., 0., 0.};
    const double thickness = round->wheel.sector_thickness;
    const auto   path      = wavy->stance().paths().front();
    const auto   strip     = wavy->stance().strip(wheel_body(0), path.begin, path.end);
    double       off = 0., off_depth = 0., highest = 0., lowest = 0.;
    for (double arc = -8e-3; arc < 40e-3; arc += 1.1e-3)
      for (double along = -4e-3; along <= 4e-3; along += 0.7e-3)
        for (const double inside : {0., 0.3 * thickness, thickness})
          {
            const Point<3> p    = before.to_space({arc, along, -inside}),
                           q    = behind.to_space({arc, along, -inside});
            const Vector3 arm   = Vector3{p[0], p[1], p[2], 0.} - middle;
            const double  angle = std::atan2(dot(arm, ahead), dot(arm, down)),
                         lift   = (1. - inside / thickness) * amplitude * std::cos(order * (angle - pitch));
            const Vector3 outwards = std::sin(angle) * ahead + std::cos(angle) * down;
            off     = std::max(off, q.distance(p + lift * Point<3>(outwards[0], outwards[1], outwards[2])));
            highest = std::max(highest, lift);
            lowest  = std::min(lowest, lift);
            if (inside == 0.)
              off_depth = std::max(off_depth, std::abs(strip.below(q)));
          }
    // The pitch is read with six decimals of a degree.
    check.below("wheel in a position that is not round: nodes off their places, um", 1e6 * off, 1e-4);
    check.absolute("wheel in a position that is not round: least more radius, um", 1e6 * lowest,
                   -1e6 * amplitude, 2.);
    check.absolute("wheel in a position that is not round: most more radius, um", 1e6 * highest,
                   1e6 * amplitude, 2.);
    // Known: the normal is that of the patch, and within 4 mm of it the tread turns.
    check.below("wheel in a position that is not round: depth of its tread below itself, um", 1e6 * off_depth,
                0.5e6 * amplitude);

    // A narrow flat comes to the rail where the patch is, and to no other place.
    const auto tread = round->stance().treads().front();
    const auto comes = [&](const double way) {
      const auto found = doubts(
        *scene_of(settings, {"Wheel/Deviation=flat: length_mm=4 depth_mm=0.02",
                             "Wheel/Deviation pitch (deg)=" +
                               std::to_string(way / round->wheel.radius * 180. / dealii::numbers::PI)}));
      return std::none_of(found.begin(), found.end(), [](const std::string &doubt) {
        return doubt.find("no part of 'Wheel/Deviation' comes to the rail") != doubt.npos;
      });
    };
    // Known: the patch is behind the middle of the wheelset, and the yaw has turned the wheel back, too.
    const auto footprint = round->stance().footprints().front();
    check.absolute(
      "tread: middle of the patch ahead of the wheel's bottom, mm",
      5e2 * (tread.x_begin + tread.x_end - round->motion.meshed_distance()),
      5e2 * (footprint.x_begin + footprint.x_end) +
        1e3 * std::sin(yaw) *
          (round->placed_wheel().surfaces.wheel_origin_y() + 0.5 * (tread.y_begin + tread.y_end)),
      0.2);
    check.that("a flat before the patch does not come to the rail", !comes(tread.x_begin - 2.2e-3));
    check.that("a flat under the patch comes to the rail", comes(tread.x_begin + 2e-3));
    check.that("a flat at the end comes to the rail", comes(tread.x_end - 2e-3));
    check.that("a flat after the end does not come to the rail", !comes(tread.x_end + 2.2e-3));
  }


  /// A window of fine cells of a wheelset in a position lies about its patch: behind the axle on the rail,
  /// and on the wheel where the tread comes down to it.
  void check_window_of_wheelset(tests::Check &check)
  {
    Settings settings{
      "Rail/Inclination=1:40",    "Wheel/Tread profile=S1002",       "Wheelset/Lateral shift (mm)=6",
      "Wheelset/Yaw (mrad)=14.4", "Wheelset/Roll (mrad)=-0.6272",    "Contact/Friction coefficient=0",
      "Motion/Creepage=0",        "Motion/Rolled distance (mm)=200", "Mesh/Finest cell (mm)=0.7",
      "Mesh/Window=true",         "Mesh/Window length (mm)=20"};
    settings.insert(settings.end(), vehicle.begin(), vehicle.end());
    const auto scene = scene_of(settings);
    // The fifth window, where the wheel has turned as it rolls.
    const double            tread = 82e-3, margin = window_margin(*scene);
    const FineWindow        window = fine_window(*scene, 4, tread);
    const std::vector<Body> bodies = scene->stance().make_bodies(window);
    check.absolute("window of a wheelset: begin on the rail, mm", 1e3 * window.rail_begin,
                   1e3 * (scene->path_begin() + 80e-3 - margin), 1e-9);
    const WheelPatch &patch    = scene->placed_wheel().patches().front();
    const auto        of_rail  = scene->stance().footprints().front();
    const double      ahead    = 0.5 * (of_rail.x_begin + of_rail.x_end);
    const Vector3     axle     = Vector3{scene->path_begin(), 0., 0., 0.} + scene->placed_wheel().middle();
    const auto       &position = scene->placed_wheel().contact.position;
    // A roll about x that takes the own side down, then a yaw about what was the vertical.
    const Vector3 forwards{std::cos(position.yaw), std::cos(position.roll) * std::sin(position.yaw),
                           -std::sin(position.roll) * std::sin(position.yaw), 0.},
      down{0., -std::sin(position.roll), -std::cos(position.roll), 0.};
    // Stretches of the middle lines of both blocks on which cells are finest, by how far the wheel has rolled
    // when they are under it.
    double range[2][2] = {{1., -1.}, {1., -1.}};
    for (unsigned int body = 0; body < 2; ++body)
      for (double x = scene->rail_begin(); x < scene->rail_end(); x += 0.1e-3)
        {
          const double along = body == 0 ? x : x - scene->path_begin();
          if (bodies[body].wanted_cell_size({along, 0., -1e-6}) > 0.71e-3)
            continue;
          const Point<3> p   = bodies[body].to_space({along, 0., 0.});
          const Vector3  arm = Vector3{p[0], p[1], p[2], 0.} - axle;
          // On the wheel the middle of the patch is beside the reference point as it is on the rail.
          const double way =
            body == 0
              ? p[0] - scene->path_begin() - ahead
              : scene->wheel.radius * (std::atan2(dot(arm, forwards), dot(arm, down)) - patch.wheel_angle) -
                  0.5 * (patch.solution.x_begin + patch.solution.x_end);
          range[body][0] = std::min(range[body][0], way);
          range[body][1] = std::max(range[body][1], way);
        }
    for (unsigned int body = 0; body < 2; ++body)
      {
        const std::string name =
          std::string("window of a wheelset: fine on the ") + (body == 0 ? "rail" : "wheel");
        check.absolute(name + " from, mm", 1e3 * range[body][0], 1e3 * ((body == 0 ? 80e-3 : tread) - margin),
                       0.2);
        check.absolute(
          name + " to, mm", 1e3 * range[body][1],
          1e3 * ((body == 0 ? 100e-3 : tread + (1. + largest_creepage(*scene)) * 20e-3) + margin), 0.2);
      }
  }


  /// A defect under a wheelset in a position: in the mesh and in the depth below it, and what the wheel rolls
  /// over.
  void check_defect_of_wheelset(tests::Check &check)
  {
    constexpr double depth = 0.1e-3, length = 14e-3, width = 6e-3, angle_tan = 1. / 40.;
    Settings         at_corner{
      "Rail/Inclination=1:40",    "Wheel/Tread profile=S1002",      "Wheelset/Lateral shift (mm)=6",
      "Wheelset/Yaw (mrad)=14.4", "Wheelset/Roll (mrad)=-0.6272",   "Contact/Friction coefficient=0",
      "Motion/Creepage=0",        "Motion/Rolled distance (mm)=40", "Mesh/Finest cell (mm)=0.7"};
    at_corner.insert(at_corner.end(), vehicle.begin(), vehicle.end());
    const auto with_dip = [&](const double begin, const double y) {
      return scene_of(at_corner, {"Scene/Quasi-static=false", "Defect/Shape=dip", "Defect/Length (mm)=14",
                                  "Defect/Width (mm)=6", "Defect/Depth (mm)=0.1",
                                  "Defect/Position (mm)=" + std::to_string(1e3 * begin),
                                  "Defect/Lateral position (mm)=" + std::to_string(1e3 * y)});
    };
    const double x_begin = -30e-3, cosine = 1. / std::hypot(1., angle_tan), sine = cosine * angle_tan;
    const auto   smooth    = scene_of(at_corner);
    const auto   footprint = smooth->stance().footprints().front();
    const double y_middle  = 0.5 * (footprint.y_begin + footprint.y_end);
    const auto   dipped    = with_dip(x_begin, y_middle);
    const Body   before    = smooth->stance().make_bodies({}).front(),
               behind      = dipped->stance().make_bodies({}).front();
    double off = 0., off_depth = 0., deepest = 0.;
    for (double x = x_begin - 1e-3; x < x_begin + length; x += 0.9e-3)
      for (double along = -6e-3; along <= 6e-3; along += 0.7e-3)
        for (const double down : {0., 0.5 * smooth->wheel.sector_thickness})
          {
            const Point<3> p = before.to_space({x, along, -down}), top = before.to_space({x, along, 0.}),
                           q  = behind.to_space({x, along, -down});
            const double u    = (x - x_begin) / length * 2. - 1.,
                         v    = (cosine * top[1] + sine * top[2] - y_middle) / width * 2.,
                         fade = 1. - down / smooth->wheel.sector_thickness,
                         lift = -depth * std::max(0., 1. - u * u - v * v);
            off     = std::max(off, q.distance(p + Point<3>(0., -sine * fade * lift, cosine * fade * lift)));
            deepest = std::max(deepest, -lift);
            if (down == 0.)
              off_depth = std::max(off_depth, std::abs(dipped->stance().depth_in_rail(q)));
          }
    // Its place is read with six decimals of a millimetre.
    check.below("defect of a wheelset: nodes off their places, um", 1e6 * off, 1e-4);
    check.absolute("defect of a wheelset: depth of what was looked at, mm", 1e3 * deepest, 0.1, 0.01);
    // Known: along the normal the defect is looked at beside the place, by less than its depth, over which it
    // has at most its largest slope across.
    check.below("defect of a wheelset: depth of its surface below itself, um", 1e6 * off_depth,
                1e6 * depth * 4. * depth / width);

    // The patch is the half-space's: its outermost elements end half of their distance beside their middles.
    const WheelPatch   &patch = smooth->placed_wheel().patches().front();
    const ContactAxes   axes  = smooth->placed_wheel().axes(patch);
    std::vector<double> lines;
    for (const auto &[y, pressure] : smooth->stance().loaded_lines())
      lines.push_back(y);
    std::sort(lines.begin(), lines.end());
    const double element     = *std::find_if(lines.begin(), lines.end(), [&](const double y) {
      return y > lines.front() + 1e-6;
    }) - lines.front();
    const auto   in_own_axes = [&](const double y) {
      return cosine * y + sine * (axes.origin[2] + (y - axes.origin[1]) * std::tan(patch.angle()));
    };
    check.absolute("footprint of a wheelset: low edge, mm", 1e3 * footprint.y_begin,
                   1e3 * in_own_axes(lines.front() - 0.5 * element), 1e-6);
    check.absolute("footprint of a wheelset: high edge, mm", 1e3 * footprint.y_end,
                   1e3 * in_own_axes(lines.back() + 0.5 * element), 1e-6);
    const double ahead = 0.5 * (footprint.x_begin + footprint.x_end);
    check.absolute("footprint of a wheelset: ahead of the axle, mm", 1e3 * ahead, -7.4, 0.4);
    const double reach = footprint.x_end - footprint.x_begin; // more than room for dynamic forces and a cell
    check.that("a dip under the patch is met", !misses_defect(*dipped));
    check.that(
      "a dip that ends under the edge of the patch at the start is met",
      !misses_defect(*with_dip(smooth->path_begin() + footprint.x_begin - length + 0.5e-3, y_middle)));
    check.that("a wheelset that moves across may come to a dip",
               !misses_defect(*scene_of(at_corner, {"Scene/Quasi-static=false", "Guidance/Kind=springs",
                                                    "Guidance/Yaw inertia (kg m2)=47", "Defect/Shape=dip",
                                                    "Defect/Length (mm)=14", "Defect/Depth (mm)=0.1"})));
    check.that("a dip before the patch comes is not met",
               misses_defect(*with_dip(smooth->path_begin() + ahead - reach - length, y_middle)));
    check.that("a dip between axle and patch at the end is not met",
               misses_defect(*with_dip(smooth->meshed_end() + ahead + reach, y_middle)));
    check.that("a dip on the middle of the head is not met", misses_defect(*with_dip(x_begin, 0.)));
    const auto on_dip = doubts(*with_dip(smooth->path_begin() + ahead - 0.5 * length, y_middle));
    check.that("a wheelset that begins on a dip is named",
               std::any_of(on_dip.begin(), on_dip.end(), [](const std::string &doubt) {
                 return doubt.find("begins on the defect") != doubt.npos;
               }));
  }


  /// Finest cells that reach beyond the profile are refused, with how far they and it reach.
  void check_beyond_profile(tests::Check &check)
  {
    const auto scene =
      scene_of({"Rail/Inclination=1:40", "Wheel/Tread profile=S1002", "Wheelset/Lateral shift (mm)=2",
                "Contact/Friction coefficient=0", "Motion/Creepage=0", "Mesh/Finest cell (mm)=2",
                "Mesh/Fine half width (mm)=40"});
    const std::string said = tests::complaint<InputError>([&] { scene->stance().make_bodies({}); });
    const std::string from = "its finest cells reach from ", to = " to ";
    const std::size_t at = said.find(from), behind = said.find(to, at);
    if (check.that("finest cells beyond the profile are refused: " + said,
                   at != said.npos && behind != said.npos))
      check.absolute("finest cells beyond the profile: their whole width, mm",
                     std::stod(said.substr(behind + to.size())) - std::stod(said.substr(at + from.size())),
                     80., 0.02);
  }


  /// A piece of a rail reaches as far as the patches on it, which lie in its inclined surface.
  void check_touched_piece(tests::Check &check)
  {
    TouchedPiece piece{"nose", {}, 1e-3, {}};
    for (const double along : {0., 1.})
      {
        TouchedPiece::Touch touch{0.1 * along, {}};
        touch.patch.region.reference = {{0., 0.74 + 2e-3 * along, 0.}};
        touch.patch.region.angle     = 0.1 + 0.2 * along;
        touch.patch.solution.y_begin = -5e-3;
        touch.patch.solution.y_end   = 4e-3;
        piece.touches.push_back(touch);
      }
    piece.fit_line();
    check.relative("piece of a rail: lowest y of its patches, mm", 1e3 * piece.y_low(),
                   740. - 5. * std::cos(0.1), round_off);
    check.relative("piece of a rail: highest y of its patches, mm", 1e3 * piece.y_high(),
                   742. + 4. * std::cos(0.3), round_off);
    check.relative("piece of a rail: y of the wheel's line in their middle, mm", 1e3 * piece.y(0.05), 741.,
                   round_off);
    check.relative("piece of a rail: mean inclination, rad", piece.inclination(), 0.2, round_off);
  }


  /// Windows follow each other over the whole way; one ends a cell before the first cube would lie in it,
  /// another where the last one has left it, and between such places all are equal.
  void check_windows(tests::Check &check)
  {
    const Settings way{"Motion/Start (mm)=-200",  "Motion/Rolled distance (mm)=600",
                       "Mesh/Finest cell (mm)=1", "Mesh/Window margin (mm)=20",
                       "Mesh/Window=true",        "Rail/Shape=block"};
    const auto     of_length = [&](const std::string &name, const Settings &more,
                               const std::vector<double> &borders) {
      const auto scene   = scene_of(way, more);
      const auto windows = tread::windows(*scene);
      check.absolute(name + ": number of windows", windows.size(), borders.size() - 1, 0.);
      for (std::size_t k = 0; k < std::min(windows.size(), borders.size() - 1); ++k)
        {
          check.absolute(name + ": begin, mm", 1e3 * windows[k].begin, borders[k], 1e-9);
          check.absolute(name + ": end, mm", 1e3 * windows[k].end, borders[k + 1], 1e-9);
        }
    };
    const auto equal = [](std::vector<double> borders, const double to, const unsigned int n) {
      const double from = borders.back();
      for (unsigned int i = 1; i <= n; ++i)
        borders.push_back(from + (to - from) * i / n);
      return borders;
    };
    const Settings length{"Mesh/Window length (mm)=50"};
    of_length("no window", {"Mesh/Window=false"}, {-200., 400.});
    of_length("windows without cubes", length, equal({-200.}, 400., 12));
    of_length("a window that does not divide the way", {"Mesh/Window length (mm)=51"},
              equal({-200.}, 400., 12));
    const Settings cubes{"Mesh/Window length (mm)=50", "Mesh/Path cell (mm)=4", "Defect/Position (mm)=100",
                         "Mesh/Fine from (mm)=-10"};
    const auto     until = [&](const std::string &fine_to) {
      Settings all = cubes;
      all.push_back("Mesh/Fine to (mm)=" + fine_to);
      return all;
    };
    of_length("cubes", until("90"), equal(equal(equal({-200.}, 69., 6), 211., 3), 400., 4));
    of_length("cubes to the end", until("280"), equal(equal({-200.}, 69., 6), 400., 7));
    of_length("cubes nearly to the end", until("270"), equal(equal({-200.}, 69., 6), 400., 7));

    // Without a length that is the largest, as near to the usual one as the stretches allow.
    Settings usual = until("90");
    usual.erase(usual.begin());
    const auto   scene   = scene_of(way, usual);
    const auto   windows = tread::windows(*scene);
    const double own = 2.5 * scene->stance().ellipse(scene->static_load()).semi_axis_x; // without supports
    unsigned int expected = 0;
    for (const double stretch : {269e-3, 142e-3, 189e-3})
      expected += std::max(1., std::round(stretch / own));
    check.absolute("usual length: number of windows", windows.size(), expected, 0.);

    const FineWindow window = fine_window(*scene_of(way, until("90")), 6, 0.3);
    check.relative("fine cells on the rail from, mm", 1e3 * window.rail_begin, 49., 1e-9);
    check.relative("fine cells on the rail to, mm", 1e3 * window.rail_end, 69. + 142. / 3. + 20., 1e-9);
    check.relative("fine cells on the tread from, mm", 1e3 * window.tread_begin, 280., 1e-9);
    check.relative("fine cells on the tread to, mm", 1e3 * window.tread_end, 300. + 1.01 * 142. / 3. + 20.,
                   1e-9);
  }


  void check_figures_of_patches(tests::Check &check)
  {
    // The rails' tops lie 750 mm beside the middle; both contacts are 4 mm from them, to the gauge side.
    std::vector<WheelPatch> patches(2);
    patches[0].region.reference  = {{1e-3, 746e-3, -0.2e-3}};
    patches[1].region.reference  = {{2e-3, -746e-3, -0.3e-3}};
    patches[1].is_of_other_wheel = true;
    const auto figures           = patches_as_json(patches, 750e-3, *scene_of(block));
    for (unsigned int i = 0; i < 2; ++i)
      {
        const std::string name = i == 0 ? "patch of the own wheel: " : "patch of the other wheel: ";
        check.that(name + "whose", figures[i]["wheel"] == (i == 0 ? "own" : "other"));
        check.relative(name + "y in the track, mm", 1e3 * figures[i]["y_m"].get<double>(),
                       i == 0 ? 746. : -746., round_off);
        check.relative(name + "y from the middle of its rail, mm", 1e3 * figures[i]["y_rail_m"].get<double>(),
                       -4., 1e-9);
        check.relative(name + "x, mm", 1e3 * figures[i]["x_m"].get<double>(), i == 0 ? 1. : 2., round_off);
        check.relative(name + "z, mm", 1e3 * figures[i]["z_m"].get<double>(), i == 0 ? -0.2 : -0.3,
                       round_off);
      }
  }
} // namespace scene_parts


TREAD_TEST(scene_parts)(tests::Check &check, const tests::Arguments &)
{
  const TemporaryFolder folder;
  check_numerics(check);
  check_wheels(check);
  check_materials(check);
  check_plastic_zones(check);
  check_track(check, folder);
  check_beam_under_rail(check, folder);
  check_volume_materials(check);
  check_track_beyond(check, folder);
  check_dips(check);
  check_bumps(check, folder);
  check_detail(check, folder);
  check_unused_tables(check);
  check_memory(check);
  check_unmatched(check);
  check_profiles(check, folder);
  check_corrugation(check, folder);
  check_maps(check, folder);
  check_surfaces(check, folder);
  check_mesh(check);
  check_windows(check);
  check_half_space(check);
  check_islands(check);
  check_negligible_slip(check);
  check_compared_traction(check);
  check_wheelset(check);
  check_defect_of_wheelset(check);
  check_deviation_of_wheelset(check);
  check_window_of_wheelset(check);
  check_beyond_profile(check);
  check_touched_piece(check);
  check_figures_of_patches(check);
}
