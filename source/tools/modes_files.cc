// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/modes.h>
#include <tread/base/format.h>
#include <tread/base/version.h>
#include <tread/model/rail_hold.h>
#include <tread/model/rolling_wheel.h>
#include <tread/output/progress.h>
#include <tread/output/run_folder.h>
#include <tread/scene/parts.h>
#include <tread/scene/track_parts.h>
#include <tread/tools/modes_files.h>
#include <tread/track/track_beam.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/grid/reference_cell.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace tread
{
  namespace
  {
    constexpr double pi = dealii::numbers::PI;

    // What --up-to may be, Hz.
    constexpr double lowest_allowed = 1., highest_allowed = 20000.;

    /// Below it a mode is a rigid motion, Hz: rounding leaves hundredths, and no suspension is so soft.
    constexpr double rigid_below = 0.2;

    /// Radius of the disc of the running surface over which the force of a receptance is spread evenly, m. A
    /// point would dent the mesh the more the finer it is; this is more than a patch and less than the head.
    constexpr double disc_radius = 15e-3;

    /// Points a direction by which a face of the disc is sampled.
    constexpr unsigned int samples = 16;

    /// Lines of receptance.csv.
    constexpr unsigned int n_lines = 400;

    /// Nodal diameters and half waves that are looked for.
    constexpr unsigned int max_diameters = 12, max_half_waves = 200;

    /// A share of the kinetic energy that names a mode.
    constexpr double dominant = 0.6;

    /// A half wave this near to the spacing of supports, relatively, is pinned-pinned.
    constexpr double pinned_tolerance = 0.05;

    const char *const free_wheel = "wheel", *const suspended_wheel = "wheel_on_suspension",
                      *const track_body = "track";

    /// A row of modes.csv.
    struct ModeRow
    {
      unsigned int number;
      double       frequency; ///< Hz
      std::string  body;
      // shares of the kinetic energy
      double rail = 0., sleepers = 0., rim = 0., web = 0., hub = 0., sprung = 0.;
      double vertical = 0., lateral = 0., longitudinal = 0.;
      // for a modal mass of 1 kg m^2, 1/sqrt(kg)
      double      contact = 0., axle = 0., pad = 0., pad_elongation = 0.;
      double      damping_share = 0.;
      int         waves         = -1; ///< half waves along the rail, or nodal diameters
      double      half_wave     = 0.; ///< m
      std::string description;
    };

    const Columns<ModeRow> &mode_columns()
    {
      using R          = ModeRow;
      const auto value = [](const std::string &name, const std::string &unit, const std::string &about,
                            double R::*member) {
        return Column<R>{name, unit, about, [member](const R &r) {
                           return r.*member;
                         }};
      };
      const auto word = [](const std::string &name, const std::string &about, std::string R::*member) {
        return Column<R>{name, "", about, {}, [member](const R &r) {
                           return r.*member;
                         }};
      };
      static const Columns<R> columns{
        {"number", "", "From the lowest frequency on",
         [](const R &r) {
           return r.number;
         }},
        value("frequency", "Hz", "Of the mode", &R::frequency),
        word("body", "wheel or track", &R::body),
        value("rail_share", "", "Of the kinetic energy, in the rail", &R::rail),
        value("sleeper_share", "", "In the sleepers", &R::sleepers),
        value("rim_share", "", "In the wheel's rim", &R::rim),
        value("web_share", "", "In the wheel's web", &R::web),
        value("hub_share", "", "In the hub", &R::hub),
        value("sprung_share", "", "In the sprung mass", &R::sprung),
        value("vertical_share", "", "Of the kinetic energy, that of motion upwards", &R::vertical),
        value("lateral_share", "", "Across", &R::lateral),
        value("longitudinal_share", "", "Along the rail", &R::longitudinal),
        value("contact_amplitude", "per_sqrt_kg", "Vertical amplitude at the contact for unit modal mass",
              &R::contact),
        value("axle_amplitude", "per_sqrt_kg", "The same of the axle", &R::axle),
        value("pad_amplitude", "per_sqrt_kg", "The same of the rail's foot over the pads, the largest",
              &R::pad),
        value("pad_elongation", "per_sqrt_kg", "Largest elongation of a pad, likewise", &R::pad_elongation),
        value("damping_share", "", "Damping matrix projected on the mode, over critical damping",
              &R::damping_share),
        {"waves", "", "Half waves along the rail, or nodal diameters of the wheel; -1: neither",
         [](const R &r) {
           return r.waves;
         }},
        value("half_wave", "mm", "Along the rail; 0: none", &R::half_wave),
        word("description", "In words", &R::description)};
      return columns;
    }

    /// A row of receptance.csv.
    struct ReceptanceRow
    {
      double               frequency; ///< Hz
      std::complex<double> rail, wheel;
      double               contact_force; ///< N/m
    };

    const Columns<ReceptanceRow> &receptance_columns()
    {
      using R = ReceptanceRow;
      static const Columns<R> columns{
        {"frequency", "Hz", "Of the force",
         [](const R &r) {
           return r.frequency;
         }},
        {"rail_magnitude", "m_per_N", "Vertical displacement of the rail at the contact for a force there",
         [](const R &r) {
           return std::abs(r.rail);
         }},
        {"rail_phase", "degrees", "Its phase behind the force, negative",
         [](const R &r) {
           return 180. / pi * std::arg(r.rail);
         }},
        {"wheel_magnitude", "m_per_N", "The same of the wheel",
         [](const R &r) {
           return std::abs(r.wheel);
         }},
        {"wheel_phase", "degrees", "Likewise",
         [](const R &r) {
           return 180. / pi * std::arg(r.wheel);
         }},
        {"contact_force", "N_per_m", "Contact force for a roughness of unit amplitude", [](const R &r) {
           return r.contact_force;
         }}};
      return columns;
    }

    /// The disc of a body's contact surface around (x, y), seen from above; shares by area. Collective.
    ElasticSystem::Place disc(const Mesh &mesh, const unsigned int body, const double x, const double y)
    {
      std::map<unsigned int, double> share;
      double                         area = 0.;
      for (const Mesh::Face &face : mesh.faces)
        if (face.body == body && face.boundary == Boundary::contact)
          for (unsigned int i = 0; i < samples; ++i)
            for (unsigned int j = 0; j < samples; ++j)
              {
                const double                xi = (i + 0.5) / samples, eta = (j + 0.5) / samples;
                const std::array<double, 4> N{(1. - xi) * (1. - eta), xi * (1. - eta), xi * eta,
                                              (1. - xi) * eta};
                const auto                  at = [&](const unsigned int k) {
                  return mesh.nodes[face.nodes[k]];
                };
                dealii::Point<3> p;
                for (unsigned int k = 0; k < 4; ++k)
                  p += N[k] * at(k);
                if (std::hypot(p[0] - x, p[1] - y) > disc_radius)
                  continue;
                const auto along   = (1. - eta) * (at(1) - at(0)) + eta * (at(2) - at(3)),
                           across  = (1. - xi) * (at(3) - at(0)) + xi * (at(2) - at(1));
                const double piece = std::abs(along[0] * across[1] - along[1] * across[0]);
                area += piece;
                for (unsigned int k = 0; k < 4; ++k)
                  share[face.nodes[k]] += N[k] * piece;
              }
      area = dealii::Utilities::MPI::sum(area, mesh.comm);
      ElasticSystem::Place place;
      for (const auto &[node, value] : share)
        place.emplace_back(node, value / area);
      if (!(area > 0.))
        throw InputError(format("tread modes: the contact surface of the %s ends before x = %g mm, where its "
                                "receptance is wanted",
                                mesh.body_names[body].c_str(), 1e3 * x));
      return place;
    }

    /// How much the disc of a half-space sinks under a unit force that is spread over it evenly, m/N: the
    /// mean over the disc (Johnson 1985, section 3.4).
    double dent(const ElasticMaterial &material)
    {
      return 16. * (1. - material.poisson_ratio * material.poisson_ratio) /
             (3. * pi * pi * disc_radius * material.young_modulus);
    }

    /// What is known of modes beyond their shape.
    class Describer
    {
    public:
      Describer(const Scene &scene, const ElasticSystem &system, const Supports *supports)
        : scene(scene)
        , system(system)
        , links(supports ? supports->links() : std::vector<Supports::Link>())
      {
      }

      /// Fill in shares and waves. Collective.
      void describe(ModeRow &row, const NodalField &u, const ElasticSystem::RigidParts &parts) const
      {
        const Mesh         &mesh = system.mesh;
        std::vector<double> parts_of_bodies(4, 0.), directions(3, 0.);
        for (unsigned int i = 0; i < u.size(); ++i)
          if (const double m = system.masses()[i]; m > 0. && mesh.shared_nodes.is_owned(i))
            {
              const unsigned int body  = mesh.node_bodies[i];
              const bool         wheel = body >= wheel_body(0) && body < wheel_body(scene.n_wheels());
              const unsigned int part  = body == rail_body ? 0 : !wheel ? 1 : in_rim(mesh.nodes[i]) ? 2 : 3;
              parts_of_bodies[part] += m * dot(u[i], u[i]);
              for (unsigned int d = 0; d < 3; ++d)
                directions[d] += m * u[i][d] * u[i][d];
            }
        dealii::Utilities::MPI::sum(parts_of_bodies, mesh.comm, parts_of_bodies);
        dealii::Utilities::MPI::sum(directions, mesh.comm, directions);
        const auto                rigid = system.rigid_inertia(parts);
        ElasticSystem::RigidParts up    = parts;
        up.along = up.turn  = 0.;
        const auto rigid_up = system.rigid_inertia(up);
        row.rail            = parts_of_bodies[0];
        row.sleepers        = parts_of_bodies[1] + rigid[2];
        row.rim             = parts_of_bodies[2];
        row.web             = parts_of_bodies[3];
        row.hub             = rigid[0];
        row.sprung          = rigid[1];
        row.longitudinal    = directions[0] + rigid[0] - rigid_up[0];
        row.lateral         = directions[1];
        row.vertical        = directions[2] + rigid_up[0] + rigid[1] + rigid[2];
        row.axle            = parts.up;
        move_pads(row, u, parts);
        if (row.body == track_body)
          describe_track(row, u);
        else
          describe_wheel(row, u);
      }

    private:
      double radius(const dealii::Point<3> &p) const
      {
        return std::hypot(p[0] - scene.path_begin(), p[2] - scene.axle_height());
      }
      bool in_rim(const dealii::Point<3> &p) const
      {
        return !scene.wheel.is_full() || radius(p) > scene.wheel.rim_inner_radius;
      }

      void move_pads(ModeRow &row, const NodalField &u, const ElasticSystem::RigidParts &parts) const
      {
        std::vector<double> moves(2 * links.size(), 0.);
        for (unsigned int l = 0; l < links.size(); ++l)
          for (const auto &[node, share] : links[l].nodes)
            {
              moves[2 * l] += share * u[node][2];
              if (share > 0.)
                moves[2 * l + 1] += share * u[node][2];
            }
        dealii::Utilities::MPI::sum(moves, system.mesh.comm, moves);
        for (unsigned int l = 0; l < links.size(); ++l)
          if (links[l].layer == Supports::pad)
            {
              for (const auto &[sleeper, share] : links[l].sleepers)
                moves[2 * l] += share * parts.sleepers[sleeper];
              row.pad_elongation = std::max(row.pad_elongation, std::abs(moves[2 * l]));
              row.pad            = std::max(row.pad, std::abs(moves[2 * l + 1]));
            }
      }

      /// The largest of the cosines cos(k pi x/L) in the motion of the rail's sections: along, across, up,
      /// and turning about x, where k half waves fit its length.
      void describe_track(ModeRow &row, const NodalField &u) const
      {
        const Mesh         &mesh      = system.mesh;
        const double        length    = scene.rail_end() - scene.rail_begin();
        constexpr int       n_motions = 4;
        std::vector<double> mean(3, 0.);
        for (unsigned int i = 0; i < u.size(); ++i)
          if (mesh.node_bodies[i] == rail_body && mesh.shared_nodes.is_owned(i))
            {
              mean[0] += system.masses()[i];
              mean[1] += system.masses()[i] * mesh.nodes[i][1];
              mean[2] += system.masses()[i] * mesh.nodes[i][2];
            }
        dealii::Utilities::MPI::sum(mean, mesh.comm, mean);
        const double        y = mean[1] / mean[0], z = mean[2] / mean[0];
        const unsigned int  n_waves = std::min<unsigned int>(max_half_waves, std::ceil(length / 0.1));
        std::vector<double> waves(n_motions * (n_waves + 1), 0.);
        double              inertia = 0.;
        for (unsigned int i = 0; i < u.size(); ++i)
          if (mesh.node_bodies[i] == rail_body && mesh.shared_nodes.is_owned(i))
            {
              const double m = system.masses()[i], ry = mesh.nodes[i][1] - y, rz = mesh.nodes[i][2] - z,
                           phase = pi * (mesh.nodes[i][0] - scene.rail_begin()) / length;
              inertia += m * (ry * ry + rz * rz);
              const double motion[n_motions] = {u[i][0], u[i][1], u[i][2], ry * u[i][2] - rz * u[i][1]};
              for (unsigned int k = 0; k <= n_waves; ++k)
                {
                  // Along the rail both ends are held: a sine.
                  const double c = std::cos(k * phase), s = std::sin(k * phase);
                  for (int d = 0; d < n_motions; ++d)
                    waves[n_motions * k + d] += m * (d == 0 ? s : c) * motion[d];
                }
            }
        inertia = dealii::Utilities::MPI::sum(inertia, mesh.comm);
        dealii::Utilities::MPI::sum(waves, mesh.comm, waves);
        double most = 0.;
        int    best = 0;
        for (unsigned int k = 0; k <= n_waves; ++k)
          for (int d = 0; d < n_motions; ++d)
            {
              // Kinetic energy of this wave alone.
              const double w      = waves[n_motions * k + d];
              const double energy = (k == 0 ? 1. : 2.) * w * w / (d == 3 ? inertia : mean[0]);
              if (energy > most)
                {
                  most      = energy;
                  row.waves = k;
                  best      = d;
                }
            }
        row.half_wave                             = row.waves > 0 ? length / row.waves : 0.;
        static const char *const names[n_motions] = {"longitudinal", "lateral", "vertical", "torsion"};
        if (row.sleepers > dominant)
          row.description = std::string("sleepers, ") + (row.vertical > dominant       ? "vertical"
                                                         : row.lateral > dominant      ? "lateral"
                                                         : row.longitudinal > dominant ? "longitudinal"
                                                                                       : "mixed");
        else if (most > 0.5 * row.rail && row.rail > 0.5)
          {
            row.description = std::string("rail, ") + names[best];
            if (best == 2 && scene.track.has_supports() &&
                std::abs(row.half_wave - scene.track.sleeper_spacing) <
                  pinned_tolerance * scene.track.sleeper_spacing)
              row.description += ", half wave as long as a span (pinned-pinned)";
          }
        else
          row.description = "rail and sleepers";
      }

      /// Nodal diameters of the rim, by the largest Fourier component of its axial and its radial motion.
      void describe_wheel(ModeRow &row, const NodalField &u) const
      {
        if (row.frequency < rigid_below)
          {
            row.description = "rigid motion";
            return;
          }
        if (row.hub + row.sprung > dominant)
          {
            row.description = row.vertical > dominant ? "wheel and sprung mass, vertical" : "hub";
            return;
          }
        if (!scene.wheel.is_full())
          return;
        const Mesh         &mesh = system.mesh;
        std::vector<double> waves(4 * (max_diameters + 1), 0.);
        for (unsigned int i = 0; i < u.size(); ++i)
          if (const double m = system.masses()[i];
              m > 0. && mesh.shared_nodes.is_owned(i) && in_rim(mesh.nodes[i]))
            {
              const double angle =
                std::atan2(mesh.nodes[i][0] - scene.path_begin(), -(mesh.nodes[i][2] - scene.axle_height()));
              const double outwards = std::sin(angle) * u[i][0] - std::cos(angle) * u[i][2];
              for (unsigned int n = 0; n <= max_diameters; ++n)
                {
                  waves[4 * n] += m * u[i][1] * std::cos(n * angle);
                  waves[4 * n + 1] += m * u[i][1] * std::sin(n * angle);
                  waves[4 * n + 2] += m * outwards * std::cos(n * angle);
                  waves[4 * n + 3] += m * outwards * std::sin(n * angle);
                }
            }
        dealii::Utilities::MPI::sum(waves, mesh.comm, waves);
        double most  = 0.;
        bool   axial = false;
        for (unsigned int n = 0; n <= max_diameters; ++n)
          for (const bool is_axial : {true, false})
            {
              const double c = waves[4 * n + (is_axial ? 0 : 2)], s = waves[4 * n + (is_axial ? 1 : 3)];
              const double energy = (n == 0 ? 1. : 2.) * (c * c + s * s);
              if (energy > most)
                {
                  most      = energy;
                  row.waves = n;
                  axial     = is_axial;
                }
            }
        if (row.lateral > dominant || row.lateral < 1. - dominant)
          row.description =
            format("%s, %d nodal diameters",
                   axial == (row.lateral > 0.5) ? (axial ? "axial" : "radial")
                                                : (row.lateral > 0.5 ? "axial" : "in the plane"),
                   row.waves);
      }

      const Scene                      &scene;
      const ElasticSystem              &system;
      const std::vector<Supports::Link> links;
    };

    /// Boundary faces of the bodies that take part, with displacements of a mode: a piece of a VTU file.
    std::string piece(const Mesh &mesh, const std::vector<char> &with_body, const NodalField &u)
    {
      using Patch = dealii::DataOutBase::Patch<2, 3>;
      std::vector<Patch> patches;
      for (const Mesh::Face &face : mesh.faces)
        if (with_body[face.body])
          {
            Patch patch;
            patch.reference_cell = dealii::ReferenceCells::Quadrilateral;
            patch.patch_index    = patches.size();
            patch.n_subdivisions = 1;
            patch.data.reinit(4, 4);
            constexpr unsigned int around[4] = {0, 1, 3, 2}; // from the counter-clockwise order
            for (unsigned int v = 0; v < 4; ++v)
              {
                const unsigned int i = face.nodes[around[v]];
                patch.vertices[v]    = mesh.nodes[i];
                for (unsigned int d = 0; d < 3; ++d)
                  patch.data(d, v) = u[i][d];
                patch.data(3, v) = face.body;
              }
            patches.push_back(std::move(patch));
          }
      std::ostringstream text;
      const std::string  name = "shape_per_sqrt_kg";
      if (!patches.empty())
        dealii::DataOutBase::write_vtu_main(
          patches, {name, name, name, "body"},
          {{0u, 2u, name, dealii::DataComponentInterpretation::component_is_part_of_vector}},
          dealii::DataOutBase::VtkFlags(), text);
      return text.str();
    }

    /// Modes of one system after the other, in the folder of the results.
    class Writer
    {
    public:
      Writer(const Scene &scene, const Mesh &mesh, const RunFolder &folder, Progress &progress)
        : scene(scene)
        , mesh(mesh)
        , folder(folder)
        , progress(progress)
      {
      }

      void add(const std::string          &body,
               const Modes                &modes,
               const std::vector<char>    &with_body,
               const ElasticSystem::Place &place,
               const Supports             *supports)
      {
        const Describer describer(scene, modes.system, supports);
        for (unsigned int k = 0; k < modes.size(); ++k)
          {
            ElasticSystem::RigidParts parts;
            const NodalField          u = modes.shape(k, parts);
            ModeRow                   row;
            row.number        = rows.size() + 1;
            row.frequency     = modes.frequency(k);
            row.body          = body;
            row.contact       = modes.system.displacement_of(place, u);
            row.damping_share = modes.damping_share(k);
            describer.describe(row, u, parts);
            rows.push_back(row);

            std::ostringstream vtu;
            dealii::DataOutBase::write_vtu_header(vtu, dealii::DataOutBase::VtkFlags());
            vtu << folder.gather(piece(mesh, with_body, u));
            dealii::DataOutBase::write_vtu_footer(vtu);
            files.emplace_back(row.number, format("modes-%04u.vtu", row.number));
            folder.write(files.back().second, vtu.str());
          }
        progress.say(format("%s: %llu unknowns, %zu modes, factorised and solved after %.1f s", body.c_str(),
                            (unsigned long long)modes.system.n_unknowns(), modes.size(), progress.seconds()));
      }

      void finish() const
      {
        folder.write_table("modes.csv", mode_columns(), rows);
        std::ostringstream collection;
        dealii::DataOutBase::write_pvd_record(collection, files);
        folder.write("modes.pvd", collection.str());
      }

    private:
      const Scene                                &scene;
      const Mesh                                 &mesh;
      const RunFolder                            &folder;
      Progress                                   &progress;
      std::vector<ModeRow>                        rows;
      std::vector<std::pair<double, std::string>> files;
    };

    /// The rail and its sleepers as in a run. @param supports null: the rail is held
    void put_on_track(const Scene &scene, const Mesh &mesh, const Supports *supports, ElasticSystem &system)
    {
      if (supports)
        system.attach_supports(*supports);
      hold_rail(scene, mesh, supports,
                {[&](const std::vector<unsigned int> &nodes) { system.fix_nodes(nodes); },
                 [&](const std::vector<unsigned int> &nodes, const unsigned int direction) {
                   system.guide_nodes(nodes, direction);
                 },
                 [&](const std::function<double(const dealii::Point<3> &)> &rate) {
                   system.damp_nodes(rail_body, rate);
                 }});
    }
  } // namespace


  std::vector<TableDescription> tables_of_modes()
  {
    return {describe("modes.csv", mode_columns()), describe("receptance.csv", receptance_columns())};
  }


  void write_modes(const Scene        &scene,
                   const ModesRequest &request,
                   const std::string  &path,
                   const MPI_Comm      comm)
  {
    if (!(request.up_to >= lowest_allowed && request.up_to <= highest_allowed))
      throw InputError(format("--up-to %g: the highest frequency must lie between %g and %g Hz",
                              request.up_to, lowest_allowed, highest_allowed));
    if (scene.track.is_beam())
      throw InputError(
        "tread modes: 'Track/Foundation' beam has no modes of its own, as waves leave along the "
        "beam; with one-layer or two-layer a whole rail of cells has");
    if (scene.track.runs_along())
      throw InputError("tread modes: 'Track/Foundation' co-running moves on with the wheel, and stands for "
                       "no track above its "
                       "own frequency; with rigid, one-layer or two-layer the rail of the cells has modes");
    if (track_beyond(scene))
      throw InputError(
        "tread modes: 'Rail/Ends' endless has no modes of its own, as waves leave; with symmetric the "
        "rail of the cells has");
    Progress   progress(dealii::Utilities::MPI::this_mpi_process(comm) == 0);
    const Mesh mesh(comm, scene.stance().make_bodies({}));
    // Where the rail is struck: at the defect, otherwise under the wheel.
    const bool   has_defect             = scene.defect.shape != defect_shapes().front().name;
    const double y                      = scene.shapes().first_contact.y,
                 x                      = has_defect ? scene.defect.position : scene.path_begin();
    const ElasticSystem::Place on_rail  = disc(mesh, rail_body, x, y),
                               on_wheel = disc(mesh, wheel_body(0), scene.path_begin(), y);

    RunFolder folder(path, comm);
    folder.remove_results();
    folder.write("parameters.prm", scene.parameters().of_run());
    progress.say("tread " + version() + (scene.general.title.empty() ? "" : ": " + scene.general.title));
    Writer                             writer(scene, mesh, folder, progress);
    const std::vector<ElasticMaterial> material   = materials(scene);
    const SolidParameters              parameters = solid_parameters(scene);
    std::vector<ReceptanceRow>         rows;
    std::vector<std::complex<double>>  omega;
    for (unsigned int line = 1; line <= n_lines; ++line)
      {
        rows.push_back({request.up_to * line / n_lines, 0., 0., 0.});
        omega.emplace_back(2. * pi * rows.back().frequency, 0.);
      }

    for (const bool suspended : {false, true})
      {
        std::vector<char> with_body(mesh.body_names.size(), false);
        with_body[wheel_body(0)] = true;
        ElasticSystem             system(mesh, with_body, material, parameters);
        ElasticSystem::HubFreedom freedom;
        freedom.moves_along  = !suspended;
        freedom.turns        = !suspended || scene.motion.drive == Drive::torque;
        freedom.is_suspended = suspended;
        system.attach_hub(RollingWheel(scene, 0).hub, wheel_body(0), freedom);
        system.assemble();
        Modes modes(system, request.up_to);
        modes.align(on_wheel);
        writer.add(suspended ? suspended_wheel : free_wheel, modes, with_body, on_wheel, nullptr);
        if (suspended)
          {
            const auto values = modes.receptance(on_wheel, omega);
            for (unsigned int line = 0; line < n_lines; ++line)
              rows[line].wheel = values[line];
          }
      }
    {
      std::vector<char> with_body(mesh.body_names.size(), true);
      for (unsigned int k = 0; k < scene.n_wheels(); ++k)
        with_body[wheel_body(k)] = false;
      const std::unique_ptr<const Supports> supports = make_supports(scene, mesh);
      ElasticSystem                         system(mesh, with_body, material, parameters);
      put_on_track(scene, mesh, supports.get(), system);
      system.assemble();
      Modes modes(system, request.up_to);
      modes.align(on_rail);
      writer.add(track_body, modes, with_body, on_rail, supports.get());
      const auto values = modes.receptance(on_rail, omega);
      for (unsigned int line = 0; line < n_lines; ++line)
        rows[line].rail = values[line];
    }
    writer.finish();

    // A roughness of unit amplitude between wheel and rail. Hertz's spring holds what they are dented.
    const double stiffness = scene.stance().ellipse(scene.static_load()).stiffness,
                 dents     = dent(scene.wheel.material.elastic()) + dent(scene.rail.material.elastic());
    for (ReceptanceRow &row : rows)
      row.contact_force = 1. / std::abs(1. / stiffness + row.wheel + row.rail - dents);
    folder.write_table("receptance.csv", receptance_columns(), rows);

    progress.say(
      format("receptances at x = %.1f mm on the rail and under the wheel; Hertz's spring at %.2f kN: "
             "%.4g MN/m",
             1e3 * x, 1e-3 * scene.static_load(), 1e-6 * stiffness));
    for (unsigned int line = 1; line + 1 < n_lines; ++line)
      if (rows[line].contact_force > rows[line - 1].contact_force &&
          rows[line].contact_force > rows[line + 1].contact_force)
        progress.say(format("resonance of wheel, contact and rail: %.0f Hz, %.3g N/um", rows[line].frequency,
                            1e-6 * rows[line].contact_force));
    progress.say(
      format("finished in %.1f s. Results in %s: modes.csv, receptance.csv; for ParaView: modes.pvd",
             progress.seconds(), folder.path("").c_str()));
  }
} // namespace tread
