// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/version.h>
#include <tread/geometry/contact_points.h>
#include <tread/output/columns.h>
#include <tread/output/progress.h>
#include <tread/output/run_folder.h>
#include <tread/scene/doubts.h>
#include <tread/tools/contact_points_files.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace tread
{
  namespace
  {
    /// Amplitude for which EN 15302 and vehicle standards state a conicity, m.
    constexpr double usual_amplitude = 3e-3;

    /// What a motion of the wheelset is about.
    struct Motion
    {
      double equilibrium;              ///< shift with like rolling radii, m
      double conicity, level_conicity; ///< with and without roll, at the usual amplitude
    };

    struct Row
    {
      int              number; ///< of steps from the middle
      TouchingWheelset wheelset;
      TouchingWheelset level;                    ///< without roll; not a number where a wheel meets no rail
      double conicity, harmonic, level_conicity; ///< NaN where the table does not reach to both sides
    };

    Columns<Row> columns(const double rail_y)
    {
      Columns<Row> list{
        {"lateral_shift", "mm", "Of the wheelset to its own side",
         [](const Row &r) {
           return r.wheelset.position.shift;
         }},
        {"roll", "rad", "At which both wheels touch, positive: the own side goes down",
         [](const Row &r) {
           return r.wheelset.position.roll;
         }},
        {"height", "mm", "Of the wheelset's middle over the radius, likewise",
         [](const Row &r) {
           return r.wheelset.position.height;
         }},
        {"radius_difference", "mm", "Rolling radius of the own wheel less that of the other one",
         [](const Row &r) {
           return r.wheelset.radius_difference();
         }},
        {"equivalent_conicity", "",
         "Of EN 15302: of cones with the same wavelength of the wheelset's motion with this amplitude; nan "
         "where "
         "a side is not reached",
         [](const Row &r) {
           return r.conicity;
         }},
        {"harmonic_conicity", "",
         "The same by harmonic linearisation of the radius difference over a motion with this amplitude",
         [](const Row &r) {
           return r.harmonic;
         }},
        {"radius_difference_without_roll", "mm",
         "Rolling radius of the own wheel less that of the other one under an axle that stays level",
         [](const Row &r) {
           return r.level.radius_difference();
         }},
        {"equivalent_conicity_without_roll", "", "Equivalent conicity of that radius difference",
         [](const Row &r) {
           return r.level_conicity;
         }}};
      for (const auto &[name, wheel] :
           {std::pair("own", &TouchingWheelset::own), std::pair("other", &TouchingWheelset::other)})
        {
          const std::string side = name;
          const auto        add  = [&, wheel = wheel](const char *what, const char *unit, const char *about,
                                              const auto &value) {
            list.push_back({side + "_" + what, unit, about, [wheel, value](const Row &r) {
                              return value(r.wheelset.*wheel);
                            }});
          };
          add("x", "mm", "Contact ahead of the axle, in the track",
              [](const TouchingWheel &w) { return w.x; });
          add("y", "mm", "From the middle of the track to the side of the wheel",
              [](const TouchingWheel &w) { return w.y; });
          add("y_rail", "mm", "From the middle of the rail's top, + to the field side",
              [rail_y](const TouchingWheel &w) { return w.y - rail_y; });
          add("y_wheel", "mm", "On the wheel's profile from its running circle, + to the field side",
              [](const TouchingWheel &w) { return w.wheel_y; });
          add("angle", "rad", "Inclination of the rail there, + where it falls to the gauge side",
              [](const TouchingWheel &w) { return w.angle; });
          add("rolling_radius", "mm", "Of the wheel there",
              [](const TouchingWheel &w) { return w.rolling_radius; });
        }
      return list;
    }

    Columns<Vector3d> profile_columns(const double rail_y)
    {
      Columns<Vector3d> list{{"y", "mm", "From the middle of the track to the own side",
                              [](const Vector3d &p) {
                                return p[1];
                              }},
                             {"y_rail", "mm", "From the middle of the rail's top, + to the field side",
                              [rail_y](const Vector3d &p) {
                                return p[1] - rail_y;
                              }},
                             {"z", "mm", "From the plane on the rail tops, upwards", [](const Vector3d &p) {
                                return p[2];
                              }}};
      return list;
    }

    /// Both profiles in the track as they are taken, the wheel's where it stands in a position.
    void write_profiles(const WheelOnRail      &surfaces,
                        const WheelsetPosition &position,
                        const RunFolder        &folder)
    {
      constexpr double spacing = 0.25e-3; // m
      const auto       points  = [](const ProfileCurve &curve, const auto &in_track) {
        const auto            n = static_cast<unsigned int>(std::ceil(curve.length() / spacing));
        std::vector<Vector3d> list;
        for (unsigned int i = 0; i <= n; ++i)
          list.push_back(in_track(curve.at(curve.length() * i / n)));
        return list;
      };
      const Columns<Vector3d> columns = profile_columns(surfaces.rail_origin_y());
      folder.write_table("rail_profile.csv", columns,
                         points(surfaces.rail().curve(), [](const ProfileCurve::Place &p) {
                           return Vector3d{0., p.y, p.z};
                         }));
      folder.write_table("wheel_profile.csv", columns,
                         points(surfaces.wheel(), [&](const ProfileCurve::Place &p) {
                           return surfaces.place(position, p.y, p.z, 0.);
                         }));
    }

    /// One row for each shift at which both wheels meet their rails. @returns the first complaint otherwise.
    std::string make_rows(const WheelsetSurfaces     &surfaces,
                          const Scene                &scene,
                          const ContactPointsRequest &request,
                          std::vector<Row>           &rows,
                          Motion                     &about)
    {
      std::string complaint;
      const int   n = static_cast<int>(std::floor(request.to_mm / request.step_mm * (1. + 1e-9)));
      // Where wheels may touch at several rolls, as on tread and flange tip, those of the way out of the
      // middle.
      for (const int side : {1, -1})
        {
          double roll = 0.;
          for (int i = side > 0 ? 0 : -1; std::abs(i) <= n; i += side)
            try
              {
                WheelsetPosition position = scene.wheelset.position();
                position.shift            = 1e-3 * i * request.step_mm;
                position.roll             = roll;
                rows.push_back({i, touching_wheelset(surfaces, position),
                                touching_wheelset(surfaces, position, Roll::none), 0., 0., 0.});
                roll = rows.back().wheelset.position.roll;
              }
            catch (const std::bad_alloc &)
              {
                throw; // no fault of the input
              }
            catch (const std::exception &error)
              {
                if (complaint.empty())
                  complaint = format("at a lateral shift of %g mm ", i * request.step_mm) + error.what();
              }
        }
      std::sort(rows.begin(), rows.end(), [](const Row &a, const Row &b) { return a.number < b.number; });
      const double            largest = 1e-3 * n * request.step_mm;
      const RadiusDifferences differences(surfaces, scene.wheelset.position(), largest),
        level(surfaces, scene.wheelset.position(), largest, Roll::none);
      const LateralMotion motion = differences.motion(), level_motion = level.motion();
      for (Row &row : rows)
        {
          const double amplitude = std::abs(row.wheelset.position.shift);
          row.conicity           = motion.conicity(amplitude);
          row.harmonic           = differences.harmonic(amplitude);
          row.level_conicity     = level_motion.conicity(amplitude);
        }
      about = {motion.equilibrium(), motion.conicity(usual_amplitude),
               level_motion.conicity(usual_amplitude)};
      return complaint;
    }
  } // namespace


  namespace
  {
    WheelOnRail other_side(const Scene &own, const std::string &file)
    {
      Scene scene;
      scene.read_surfaces(file, {});
      require(!scene.rail.is_sliced(), "--other-side " + file + ": 'Rail/Shape' cannot be slices");
      const TrackGauge &a = own.wheelset.track, &b = scene.wheelset.track;
      require(a.gauge == b.gauge && a.measuring_depth == b.measuring_depth &&
                a.back_distance == b.back_distance,
              "--other-side " + file +
                ": its track gauge, the depth at which that is measured or the distance of the wheels' backs "
                "('Wheelset') is not that of the scene, but both sides are of one track and one wheelset");
      return scene.wheel_on_rail();
    }
  } // namespace


  std::vector<TableDescription> tables_of_contact_points()
  {
    return {describe("contact_points.csv", columns(0.)), describe("rail_profile.csv", profile_columns(0.)),
            describe("wheel_profile.csv", profile_columns(0.))};
  }


  void write_contact_points(const Scene                &scene,
                            const ContactPointsRequest &request,
                            const std::string          &path,
                            const MPI_Comm              comm)
  {
    require(request.to_mm > 0. && request.to_mm <= 100. && request.step_mm > 0. &&
              request.step_mm <= request.to_mm,
            "--shift-to must be above 0 and at most 100 mm, --shift-step above 0 and at most as much");
    constexpr double most_rows = 100000.;
    require(2. * request.to_mm / request.step_mm + 1. <= most_rows,
            format("--shift-step %g mm makes more than %g rows up to --shift-to %g mm; at least %.2g",
                   request.step_mm, most_rows, request.to_mm, 2.1 * request.to_mm / most_rows));
    Progress          progress(dealii::Utilities::MPI::this_mpi_process(comm) == 0);
    const WheelOnRail surfaces = scene.wheel_on_rail();
    const WheelOnRail other = request.other_side.empty() ? surfaces : other_side(scene, request.other_side);
    std::vector<Row>  rows;
    Motion            about{};
    const std::string complaint = make_rows({surfaces, other}, scene, request, rows, about);
    require(!rows.empty(), "wheel and rail do not meet: " + complaint);

    RunFolder folder(path, comm);
    folder.write_table("contact_points.csv", columns(surfaces.rail_origin_y()), rows);
    const Row &middle = *std::min_element(rows.begin(), rows.end(), [](const Row &a, const Row &b) {
      return std::abs(a.number) < std::abs(b.number);
    });
    write_profiles(surfaces, middle.wheelset.position, folder);

    progress.say("tread " + version() + (scene.general.title.empty() ? "" : ": " + scene.general.title));
    progress.say(format(
      "rigid wheelset, yaw %g mrad: shift to the own side, contact on the own and on the other wheel\n",
      1e3 * scene.wheelset.yaw));
    progress.say(
      "   shift     roll  y wheel    angle   radius  y wheel    angle   radius  difference  conicity\n"
      "      mm     mrad       mm  degrees       mm       mm  degrees       mm          mm");
    constexpr double degree = 180. / dealii::numbers::PI;
    // Whole millimetres, or steps of about one.
    const int every = std::max(1, static_cast<int>(std::lround(1. / request.step_mm)));
    for (const Row &row : rows)
      {
        if (row.number % every != 0)
          continue;
        const double         shift = 1e3 * row.wheelset.position.shift;
        const TouchingWheel &own = row.wheelset.own, &other = row.wheelset.other;
        progress.say(format("%8.2f %8.3f %8.2f %8.2f %8.2f %8.2f %8.2f %8.2f %11.3f %9.4f", shift,
                            1e3 * row.wheelset.position.roll, 1e3 * own.wheel_y, degree * own.angle,
                            1e3 * own.rolling_radius, 1e3 * other.wheel_y, degree * other.angle,
                            1e3 * other.rolling_radius, 1e3 * row.wheelset.radius_difference(),
                            row.conicity));
      }
    if (!std::isnan(about.conicity))
      progress.say(
        format("\nequivalent conicity at an amplitude of %g mm (EN 15302): %.3f, without roll %.3f",
               1e3 * usual_amplitude, about.conicity, about.level_conicity));
    constexpr double beside = 1e-6; // m
    if (std::abs(about.equilibrium) > beside)
      progress.say(format(
        "the sides are unlike: both rolling radii are equal at a lateral shift of %.3f mm, about which the "
        "motions of the equivalent conicity are",
        1e3 * about.equilibrium));
    else if (std::isnan(about.equilibrium))
      progress.say("the rolling radii are unlike at all shifts: there is no equivalent conicity");
    for (const std::string &warning : implausible_values(scene, true))
      progress.say("warning: " + warning);
    if (!complaint.empty())
      progress.say("warning: rows are missing: " + complaint);
    double least = std::numeric_limits<double>::infinity();
    for (const Row &row : rows)
      if (row.wheelset.own.is_beyond_flank || row.wheelset.other.is_beyond_flank)
        least = std::min(least, std::abs(row.wheelset.position.shift));
    if (std::isfinite(least))
      progress.say(
        format("note: from a lateral shift of %g mm on a wheel stands on its flange between the steepest "
               "part and the tip: it climbs out of the track",
               1e3 * least));
    const double last = request.step_mm * std::floor(request.to_mm / request.step_mm * (1. + 1e-9));
    if (last < request.to_mm * (1. - 1e-9))
      progress.say(format(
        "note: the table ends at lateral shifts of %g mm, before --shift-to %g, which is no multiple of "
        "--shift-step %g",
        last, request.to_mm, request.step_mm));
    if (scene.wheel.lateral_position != 0.)
      progress.say(
        "note: 'Wheel/Lateral position (mm)' does not count here: the lateral shift of the wheelset "
        "takes its place");
    progress.say(format("\nfinished in %.2f s. Results in ", progress.seconds()) + folder.path("") +
                 ": contact_points.csv, rail_profile.csv, wheel_profile.csv");
  }
} // namespace tread
