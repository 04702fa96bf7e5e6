// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/version.h>
#include <tread/output/progress.h>
#include <tread/output/run_folder.h>
#include <tread/output/summary_keys.h>
#include <tread/reference/subsurface.h>
#include <tread/reference/transient.h>
#include <tread/scene/doubts.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/measured_profiles.h>
#include <tread/scene/steady_damage_tables.h>
#include <tread/tools/reference_only.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <new>
#include <sstream>

namespace tread
{
  namespace
  {
    const bool keys_of_half_space_are_known = know_summary_keys(
      SummaryGroup::half_space,
      {{"wheel_max_von_mises_Pa",
        "Largest von Mises stress of the wheel in the plane along the rail through the first contact, from a "
        "twentieth to one and a half of the smaller semi-axis deep"},
       {"wheel_max_von_mises_x_m", "Where it was, forward from the first contact"},
       {"wheel_max_von_mises_depth_m", "Where it was, from the surface"},
       {"rail_max_von_mises_Pa", "The same of the rail"},
       {"rail_max_von_mises_x_m", "Where it was, forward from the first contact"},
       {"rail_max_von_mises_depth_m", "Where it was, below the surface"},
       {"approach_m", "Of distant points of wheel and rail to each other under the load"},
       {"element_size_m", "Edge of the elements in rolling direction, of the finer grid"},
       {"elements", "Number of them in contact"},
       {"normal_iterations", "Steps of conjugate gradients for the pressure on the finer grid"},
       {"normal_residual", "Largest error of the gap in contact, over the approach"},
       {"tangential_iterations", "Steps of Newton's method for the shear stress on the finer grid"},
       {"tangential_residual",
        "Largest violation of Coulomb's law, over friction coefficient and largest pressure"}});

    using reference::Body;
    using reference::Stress;
    using Point = std::array<double, 3>; // x, y, depth

    /// The stresses of one body under the tractions of a half-space answer.
    class BodyStress
    {
    public:
      BodyStress(const reference::RollingResult &answer, const Body body, const double poisson)
        : answer(answer)
        , grid(answer.grid)
        , body(body)
        , poisson(poisson)
      {
      }

      std::vector<Stress> at(const std::vector<Point> &points) const
      {
        return reference::subsurface_stress(grid, poisson, answer.pressure, answer.shear_x, answer.shear_y,
                                            body, points);
      }

      /// Where von Mises' stress is largest on the plane y = 0, not nearer to the surface than
      /// `shallowest`: above that the kinks of the shear stress decide, which depend on the element size.
      Point most_stressed(const double half_length, const double shallowest, const double deepest) const
      {
        std::vector<Point> points;
        for (int i = -6; i <= 6; ++i)
          for (int k = 0; k <= 7; ++k)
            points.push_back({i / 6. * half_length, 0., shallowest * std::pow(deepest / shallowest, k / 7.)});
        Point  best    = points[0];
        double largest = 0.;
        for (double step = 0.5;; step *= 0.5)
          {
            const std::vector<Stress> stress = at(points);
            for (std::size_t i = 0; i < points.size(); ++i)
              if (stress[i].von_mises() > largest)
                {
                  largest = stress[i].von_mises();
                  best    = points[i];
                }
            if (step < 0.01)
              return best;
            points.clear();
            for (const int i : {-1, 0, 1})
              for (const int k : {-1, 0, 1})
                if (i != 0 || k != 0)
                  points.push_back(
                    {best[0] + i * step * half_length / 6., 0.,
                     std::max(shallowest, best[2] * std::pow(deepest / shallowest, k * step / 7.))});
          }
      }

    private:
      const reference::RollingResult &answer;
      const reference::Grid           grid;
      const Body                      body;
      const double                    poisson;
    };

    /// Stresses down to three times the smaller semi-axis in both bodies, under the patch centre, at the x of
    /// the largest von Mises stress, and, in a scene that looks for peaks, at each depth where this is
    /// largest on the plane y = 0; the largest
    /// go into the summary. They are those of the tractions of first order, within 0.4 % from a twentieth of
    /// the smaller semi-axis on.
    std::string depth_lines(const Scene &scene, Summary &summary)
    {
      const reference::RollingResult answer = reference::solve_rolling(half_space_case(scene));
      const double       a = answer.hertz.semi_axis_x, smaller = std::min(a, answer.hertz.semi_axis_y);
      std::ostringstream table;
      table
        << "body,line,x_mm,y_mm,depth_mm,von_mises_MPa,mean_stress_MPa,xx_MPa,yy_MPa,zz_MPa,xy_MPa,xz_MPa,"
           "yz_MPa\n"
        << std::setprecision(7);
      for (const Body body : {Body::wheel, Body::rail})
        {
          const std::string name = body == Body::wheel ? "wheel" : "rail";
          const double nu = (body == Body::wheel ? scene.wheel.material : scene.rail.material).poisson_ratio;
          const BodyStress stress(answer, body, nu);
          const Point      worst     = stress.most_stressed(1.2 * a, 0.05 * smaller, 1.5 * smaller);
          const double     von_mises = stress.at({worst})[0].von_mises();
          summary.show(name + "_max_von_mises_Pa", "von Mises maximum, " + name + ", MPa", 1e-6, von_mises);
          summary.set(name + "_max_von_mises_x_m", worst[0]);
          summary.show(name + "_max_von_mises_depth_m", "its depth, " + name + ", mm", 1e3, worst[2]);
          // On the surface stresses are singular on element edges, so lines go through element centres.
          const double        nearest = std::round(worst[0] / answer.grid.dx) * answer.grid.dx;
          std::vector<double> depths;
          for (unsigned int k = 0; k <= 60; ++k)
            depths.push_back(smaller * (k <= 40 ? 0.025 * k : 1. + 0.1 * (k - 40)));
          const auto add_row = [&](const char *line, const Point &p, const Stress &s) {
            table << name << ',' << line << ',' << 1e3 * p[0] << ',' << 1e3 * scene.shapes().first_contact.y
                  << ',' << 1e3 * p[2];
            for (const double value : {s.von_mises(), s.mean(), s.xx, s.yy, s.zz, s.xy, s.xz, s.yz})
              table << ',' << 1e-6 * value;
            table << '\n';
          };
          for (const auto &[line, x] : {std::pair<const char *, double>{"centre", 0.}, {"maximum", nearest}})
            {
              std::vector<Point> points;
              for (const double depth : depths)
                points.push_back({x, 0., depth});
              const std::vector<Stress> stresses = stress.at(points);
              for (std::size_t k = 0; k < points.size(); ++k)
                add_row(line, points[k], stresses[k]);
            }
          if (!scene.peak_stress.is_wanted())
            continue;
          // From one depth to the next the place moves by an element or two.
          constexpr double two_and_a_half = 2.5;
          double           around = 0., reach = a;
          for (const double depth : depths)
            {
              std::vector<Point> points;
              for (const double x : answer.x)
                if (std::abs(x - around) <= reach)
                  points.push_back({x, 0., depth});
              const std::vector<Stress> stresses = stress.at(points);
              const auto                most =
                std::max_element(stresses.begin(), stresses.end(), [](const Stress &p, const Stress &q) {
                  return p.von_mises() < q.von_mises();
                });
              around = points[most - stresses.begin()][0];
              reach  = two_and_a_half * answer.grid.dx;
              add_row("largest", points[most - stresses.begin()], *most);
            }
        }
      return table.str();
    }
  } // namespace


  namespace
  {
    /// How the traction builds up over the distance that a scene rolls at its creepage from a start without
    /// tractions; empty where that is not what the scene asks for, or the half-space knows no answer.
    /// @param why there is none, if the scene asks for it
    std::string transient_table(const Scene                      &scene,
                                const reference::RollingEstimate &steady,
                                std::string                      &why)
    {
      reference::TransientCase transient;
      transient.rolling = half_space_case(scene);
      const bool like   = reference::combine(transient.rolling.wheel, transient.rolling.rail).coupling == 0.;
      if (scene.start.tractions != StartTractions::none || scene.motion.drive != Drive::creepage ||
          !(scene.contact.friction_coefficient > 0.))
        return "";
      const double half_length = hertz(transient.rolling).semi_axis_x;
      if (!like)
        why = "wheel and rail are of unlike materials";
      else if (transient.rolling.slip_friction)
        why = "'Contact/Friction law' " + scene.contact.friction_law + " depends on the slip";
      else if (transient.rolling.pressure_factor)
        why = "'Contact/Friction pressures (MPa)' are given";
      else if (transient.rolling.heat_friction)
        why = "'Contact/Friction temperatures (C)' are given";
      else if (transient.rolling.place_factor)
        why = "'Contact/Friction across (mm)' or 'Friction inclinations (deg)' are given";
      else if (scene.contact.friction_varies(scene.path_begin() - half_length,
                                             scene.path_end() + half_length))
        why = "'Contact/Friction factors' change on the way";
      if (!why.empty())
        return "";
      // Elements half as large again: some seconds of rolling, 0.1 % of the steady traction.
      transient.rolling.element_size *= 1.5;
      transient.rolling.prescribe_force       = false;
      transient.rolling.creepage              = steady.creepage.value;
      transient.distance                      = scene.path_end() - scene.path_begin();
      const reference::TransientResult result = reference::solve_transient(transient);
      std::ostringstream               table;
      table << "rolled_mm,traction_coefficient,lateral_coefficient,longitudinal_force_N,creepage\n"
            << std::setprecision(7);
      for (std::size_t k = 0; k < result.distance.size(); ++k)
        table << 1e3 * result.distance[k] << ',' << result.traction_coefficient[k] << ','
              << result.lateral_coefficient[k] << ','
              << result.traction_coefficient[k] * transient.rolling.normal_force << ','
              << 0. - result.creepage[k] << '\n';
      return table.str();
    }
  } // namespace


  void run_reference_only(const Scene &scene, const std::string &path, const MPI_Comm comm)
  {
    Progress                   progress(dealii::Utilities::MPI::this_mpi_process(comm) == 0);
    reference::RollingEstimate estimate;
    try
      {
        estimate = half_space_answer(scene, half_space_case(scene));
      }
    catch (const std::bad_alloc &)
      {
        throw; // no fault of the input
      }
    catch (const std::exception &error)
      {
        throw InputError(std::string("no half-space answer: ") + error.what());
      }

    Summary       summary;
    ContactAnswer answer = contact_answer(estimate);
    answer.patch.y_of_pressure += scene.shapes().first_contact.y;
    summarise(summary, scene, "half-space solver", answer, true);
    const reference::RollingResult &half_space = estimate.fields;
    for (const auto &[name, value] :
         {std::pair<const char *, const reference::Estimate &>{"creepage", estimate.creepage},
          {"traction_coefficient", estimate.traction_coefficient},
          {"lateral_force_N", estimate.lateral_force},
          {"max_pressure_Pa", estimate.max_pressure},
          {"adhesion_share", estimate.adhesion_share},
          {"max_shear_Pa", estimate.max_shear},
          {"max_slip_m_per_s", estimate.max_slip},
          {"frictional_power_W", estimate.frictional_power}})
      summary.set(std::string(name) + "_half_space_uncertainty", value.uncertainty);
    const std::string subsurface = depth_lines(scene, summary);
    summary.set("approach_m", half_space.approach);
    summary.set("element_size_m", half_space.grid.dx);
    summary.set("elements", std::count_if(half_space.state.begin(), half_space.state.end(), [](const auto s) {
                  return s != reference::ElementState::exterior;
                }));
    summary.set("normal_iterations", half_space.convergence.normal_iterations);
    summary.set("normal_residual", half_space.convergence.normal_residual);
    summary.set("tangential_iterations", half_space.convergence.tangential_iterations);
    summary.set("tangential_residual", half_space.convergence.tangential_residual);
    const MeasuredProfiles   profiles(scene);
    std::vector<std::string> warnings = scene.unused_parameters();
    for (const std::vector<std::string> &more :
         {implausible_values(scene), profiles.warnings(), left_out_by_half_space(scene)})
      warnings.insert(warnings.end(), more.begin(), more.end());
    profiles.summarise(summary);
    summary.set("wall_s", progress.seconds());
    summary.set("ranks", dealii::Utilities::MPI::n_mpi_processes(comm));
    summary.set("version", version());
    summary.set("files", as_json(scene.parameters().files_read()));

    RunFolder folder(path, comm, scene.output.pictures);
    folder.remove_results();
    folder.write("parameters.prm", scene.parameters().of_run());
    const std::vector<PatchNode> nodes = patch_nodes(half_space, scene.shapes().first_contact.y);
    folder.write_table("patch.csv", patch_columns(), nodes);
    write_steady_damage(scene, {{nodes, scene.motion.speed * (1. + answer.creepage)}}, folder, summary,
                        warnings);
    summary.set("warnings", warnings);
    folder.write_surface(nodes, half_space.grid.dx);
    folder.join_pictures();
    folder.write("subsurface.csv", subsurface);
    profiles.write(folder);
    std::string       no_transient;
    const std::string transient = transient_table(scene, estimate, no_transient);
    if (!transient.empty())
      folder.write("transient.csv", transient);
    folder.write("summary.json", summary.text());

    progress.say("tread " + version() + (scene.general.title.empty() ? "" : ": " + scene.general.title));
    char text[200];
    std::snprintf(text, sizeof text,
                  "half-space solver: elements of %.3g mm, normal force %.2f kN, approach %.2f um, traction "
                  "coefficient %.4f\n",
                  1e3 * half_space.grid.dx, 1e-3 * half_space.normal_force, 1e6 * half_space.approach,
                  half_space.traction_coefficient);
    progress.say(text);
    for (const std::string &line : profiles.smoothing())
      progress.say(line);
    for (const std::string &warning : warnings)
      progress.say("WARNING: " + warning);
    progress.say(summary.table());
    if (!no_transient.empty())
      progress.say("no transient.csv, for a solver that knows one friction coefficient and like bodies: " +
                   no_transient);
    std::snprintf(text, sizeof text, "finished in %.2f s. Results in ", progress.seconds());
    progress.say(text + folder.path("") + ": summary.json, patch.csv, subsurface.csv" +
                 (transient.empty() ? "" : ", transient.csv") +
                 "; for ParaView: " + folder.list_of_pictures("surface"));
  }
} // namespace tread
