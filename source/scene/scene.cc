// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/scene.h>

namespace tread
{
  namespace
  {
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    using dealii::Patterns::Selection;

    constexpr double tiny = 1e-12; // for "above 0"
  }                                // namespace


  Scene::Scene()
  {
    declare();
  }


  PlasticMaterial Scene::Material::plastic(const double yield_MPa, const double tangent_GPa) const
  {
    PlasticMaterial material;
    material.yield_stress = 1e6 * yield_MPa;
    if (yield_MPa == 0.)
      return material;
    if (hardening == "Armstrong-Frederick")
      {
        const auto numbers = [](const std::string &list) {
          return dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(list));
        };
        const std::vector<double> moduli     = numbers(backstress_moduli_GPa),
                                  recoveries = numbers(backstress_recoveries);
        for (std::size_t i = 0; i < moduli.size(); ++i)
          material.backstresses.push_back({1e9 * moduli[i], recoveries[i]});
        return material;
      }
    const double modulus = hardening_modulus(1e9 * young_modulus_GPa, 1e9 * tangent_GPa);
    if (hardening == "isotropic")
      material.isotropic_modulus = modulus;
    else
      material.backstresses = {{modulus, 0.}};
    return material;
  }


  std::vector<Scene::Material::Zone> Scene::Material::zones() const
  {
    std::vector<Zone> list;
    for (const std::string &text : dealii::Utilities::split_string_list(plastic_zones))
      {
        const std::vector<std::string> parts = dealii::Utilities::split_string_list(text, ':');
        std::vector<double>            values;
        try
          {
            values = dealii::Utilities::string_to_double(parts);
          }
        catch (const dealii::ExceptionBase &)
          {
            values.clear();
          }
        if (values.size() != 5)
          throw SceneError("'Plastic zones' cannot be '" + text +
                           "'; allowed: begin:end:depth:yield stress:tangent modulus, in mm, MPa and GPa");
        list.push_back({values[0], values[1], values[2], values[3], values[4]});
      }
    return list;
  }


  void Scene::declare()
  {
    dealii::ParameterHandler &prm = handler;
    prm.enter_subsection("Scene");
    prm.add_parameter("Title", title, "What the scene shows; printed and kept in the summary.");
    prm.add_parameter("Quasi-static", quasi_static,
                      "Whether inertia is no part of the answer. Only then may the density be scaled.");
    prm.add_parameter(
      "Density scale", density_scale,
      "Factor on the density of the cells: the time step grows with its square root, the error of rolling "
      "inertia like (speed / wave speed)^2. 1 to 100; above 1 only for quasi-static scenes.",
      Double(1., 100.));
    prm.leave_subsection();

    const auto declare_material = [&](Material &material) {
      prm.add_parameter("Young's modulus (GPa)", material.young_modulus_GPa, "Above 0.", Double(1e-3, 1e4));
      prm.add_parameter("Poisson's ratio", material.poisson_ratio, "From 0 to 0.49.", Double(0., 0.49));
      prm.add_parameter("Density (kg per m3)", material.density, "Above 0. Inertia of the cells.",
                        Double(1., 1e5));
      prm.add_parameter("Yield stress (MPa)", material.yield_stress_MPa,
                        "Of von Mises, at first yield. 0: elastic. The static load may well be above yield.",
                        Double(0.));
      prm.add_parameter("Tangent modulus (GPa)", material.tangent_modulus_GPa,
                        "Slope of the uniaxial stress over strain beyond yield, for isotropic and kinematic "
                        "hardening. From 0 "
                        "to below Young's modulus.",
                        Double(0.));
      prm.add_parameter(
        "Hardening", material.hardening,
        "isotropic: the yield surface grows; it shakes down. kinematic: it moves, in a straight line. "
        "Armstrong-Frederick: it moves and saturates, by one to three backstresses; it ratchets.",
        Selection("isotropic|kinematic|Armstrong-Frederick"));
      prm.add_parameter("Backstress moduli (GPa)", material.backstress_moduli_GPa,
                        "Of Armstrong-Frederick hardening: C of each backstress, separated by commas; "
                        "da = 2/3 C de - gamma a dp.",
                        dealii::Patterns::List(Double(0.), 1, PlasticMaterial::max_backstresses));
      prm.add_parameter("Backstress recoveries", material.backstress_recoveries,
                        "Of the same: gamma of each backstress, no unit; it saturates at C/gamma.",
                        dealii::Patterns::List(Double(0.), 1, PlasticMaterial::max_backstresses));
      prm.add_parameter("Plastic depth (mm)", material.plastic_depth_mm,
                        "Cells under the contact path yield down to here; those below stay elastic and cost "
                        "less. A patch length is enough.",
                        Double(tiny));
      prm.add_parameter("Plastic half width (mm)", material.plastic_half_width_mm,
                        "Cells yield from the middle of the path to here, at both sides.", Double(tiny));
      prm.add_parameter(
        "Plastic zones", material.plastic_zones,
        "Parts with another yield stress, such as a weld or a hardened layer: begin and end along the path "
        "(mm; of the wheel along the tread, from where it touches at the start), depth (mm), yield stress "
        "(MPa), tangent modulus (GPa), separated by colons, as in -30:-20:8:400:21. Several: separated by "
        "commas; where they overlap the last counts.",
        Anything());
    };

    prm.enter_subsection("Wheel");
    prm.add_parameter("Shape", wheel_shape,
                      "sector: a piece of the rim on a rigid hub that has the rest of mass and inertia. "
                      "full: rim, web and hub deform; what the bore holds is rigid.",
                      Selection("sector|full"));
    prm.add_parameter("Radius (mm)", radius_mm, "Rolling radius. Sets the curvature along the rail.",
                      Double(10., 2000.));
    prm.add_parameter(
      "Mass (kg)", wheel_mass,
      "Of all that is unsprung, meshed or not: wheel, half axle, axle box. It loads the contact.",
      Double(tiny));
    prm.add_parameter("Moment of inertia (kg m2)", wheel_inertia,
                      "About the axle, of the same. Matters when a torque drives.", Double(tiny));
    prm.add_parameter("Sector thickness (mm)", sector_thickness_mm,
                      "Radial size of a sector. Thicker is nearer to a half-space.", Double(1., 1000.));
    prm.add_parameter("Sector width (mm)", sector_width_mm, "Lateral size of a sector.", Double(1., 1000.));
    prm.add_parameter("Sector margin (mm)", sector_margin_mm,
                      "Arc of a sector beyond the rolled distance, at each end.", Double(0., 1000.));
    prm.add_parameter("Rim inner radius (mm)", rim_inner_radius_mm,
                      "Full wheel. Above the hub's outer radius, below the wheel's radius.",
                      Double(1., 2000.));
    prm.add_parameter("Rim width (mm)", rim_width_mm, "Full wheel. Above the web's thickness.",
                      Double(1., 1000.));
    prm.add_parameter("Web thickness (mm)", web_thickness_mm, "Full wheel. Below rim width and hub length.",
                      Double(1., 1000.));
    prm.add_parameter("Hub outer radius (mm)", hub_outer_radius_mm, "Full wheel. Above the bore's radius.",
                      Double(1., 2000.));
    prm.add_parameter("Hub length (mm)", hub_length_mm, "Full wheel. Above the web's thickness.",
                      Double(1., 1000.));
    prm.add_parameter("Bore radius (mm)", bore_radius_mm, "Full wheel: the rigid axle begins here.",
                      Double(1., 2000.));
    prm.add_parameter(
      "Tread profile", tread,
      "cylinder, cone 1:40, cone 1:20, S1002 (EN 13715), or a file with a measured one: columns y and z in "
      "mm "
      "(flange at y < 0, z up), .prw of Simpack or .whl of MiniProf. The flange itself is not meshed.",
      Anything());
    prm.add_parameter("Lateral position (mm)", lateral_position_mm,
                      "y of the running circle over the rail's middle; the flange lies at y < 0.",
                      Double(-30., 30.));
    declare_material(wheel_material);
    prm.leave_subsection();

    prm.enter_subsection("Rail");
    prm.add_parameter(
      "Shape", rail_shape,
      "head: the head of a rail profile on a rigid foundation. full section: head, web and foot, held at the "
      "foot. block: a box with a cylindrical crown, to compare with half-space theory.",
      Selection("head|full section|block"));
    prm.add_parameter("Profile", profile, "Of a head or a full section (EN 13674-1). UIC60 has that of 60E1.",
                      Selection("54E1|60E1"));
    prm.add_parameter(
      "Measured head", measured_head,
      "File with a measured running surface that takes the place of the profile's own: columns y and z in mm "
      "(gauge side at y < 0), .prr of Simpack or .ban of MiniProf. Empty: a new rail.",
      Anything());
    prm.add_parameter(
      "Inclination", rail_inclination,
      "Of a head or a full section: how far it leans to the gauge side, y < 0. A cone of the same slope "
      "touches it on the middle of the top, a cylinder 7.5 mm (1:40) or 15 mm (1:20) beside it.",
      Selection("none|1:40|1:20"));
    prm.add_parameter(
      "Begin (mm)", rail_begins_at,
      "x of the rail's first end. automatic: before the path as much as behind it where Length "
      "is given, else by Margin.",
      Anything());
    prm.add_parameter("Length (mm)", rail_length_mm, "Of the whole rail. 0: to Margin behind the path.",
                      Double(0., 1e5));
    prm.add_parameter("Crown radius (mm)", crown_radius_mm, "Of a block. Sets the lateral curvature.",
                      Double(10., 1e6));
    prm.add_parameter("Block width (mm)", block_width_mm, "Lateral.", Double(1., 1000.));
    prm.add_parameter("Block height (mm)", block_height_mm, "At the crown; the bottom is held.",
                      Double(1., 1000.));
    prm.add_parameter(
      "Margin (mm)", rail_margin_mm,
      "Rail beyond the rolled distance, at each end. At least three contact semi-axes; 150 of a full "
      "section, whose head gives way near a free end: the normal force would drift by per cents.",
      Double(0., 20000.));
    prm.add_parameter(
      "Ends", rail_ends,
      "Of a rail on supports ('Track/Foundation'). symmetric: planes of symmetry, which reflect waves. "
      "absorbing: the same planes behind a length of rail in which damping grows towards the end and takes "
      "up most of the waves, as if the rail went on.",
      Selection("symmetric|absorbing"));
    prm.add_parameter("Absorbing length (m)", absorbing_length_m,
                      "Of the part at each absorbing end; the wheel's path stays a sleeper spacing clear of "
                      "it. Longer ones absorb lower frequencies: from 0.6 m on it helps.",
                      Double(0.05, 100.));
    declare_material(rail_material);
    prm.leave_subsection();

    declare_defect();

    prm.enter_subsection("Mesh");
    prm.add_parameter(
      "Finest cell (mm)", finest_mm,
      "Edge of the cells under the contact path. Cost grows like its inverse cube or faster; the "
      "pressure's error shrinks like its square.",
      Double(0.02, 20.));
    prm.add_parameter(
      "Fine half width (mm)", fine_half_width_mm,
      "Finest cells reach from the middle of the patch to here; contact must stay inside. 0: as far "
      "as the patch under the static load needs, and 1.35 times as far in a scene that is not "
      "quasi-static, whose load may double.",
      Double(0., 500.));
    prm.add_parameter("Fine layers", fine_layers,
                      "Layers of finest cells under the surface; even numbers fit the octree.",
                      Integer(1, 64));
    prm.add_parameter("Cells per level", cells_per_level,
                      "How many cells of each larger size follow before the next doubling, at least.",
                      Double(1., 32.));
    prm.add_parameter(
      "Level depth (semi-axes)", level_depth,
      "Least thickness of the layers of larger cells below the finest ones, over Hertz's mean "
      "semi-axis: of cells of twice the size, four times the size, and so on. So the error of the "
      "graded mesh shrinks with the finest cell; with 0, where 'Cells per level' alone counts, "
      "bodies are about 1 % too stiff at any finest cell, and cells below 0.7 mm are fewer.",
      Double(0., 10.));
    prm.add_parameter(
      "Coarsest cell (mm)", coarsest_mm,
      "Upper bound of the coarse blocks' edges, not below the finest cell; a rail head, being curved, "
      "takes 12.5 mm if that is less.",
      Double(0.1, 500.));
    prm.add_parameter(
      "Fine from (mm)", fine_from_mm,
      "From here to 'Fine to', counted from the leading edge of the defect ('Defect/Position'), cells under "
      "the path are cubes; elsewhere they are as long as 'Path cell' says. Both 0: the whole path.",
      Double(-1e5, 1e5));
    prm.add_parameter("Fine to (mm)", fine_to_mm, "See 'Fine from (mm)'.", Double(-1e5, 1e5));
    prm.add_parameter(
      "Path cell (mm)", path_cell_mm,
      "Largest length along the path of cells outside 'Fine from' to 'Fine to'; from twice the "
      "finest cell on they are as many levels of the octree coarser. Saves cells and time steps "
      "where the wheel only has to arrive, but the contact force ripples as it rolls over "
      "large cells: at most half a semi-axis. 0: the finest cell.",
      Double(0., 100.));
    prm.add_parameter("Longest row (mm)", longest_row_mm,
                      "Full section: largest length of the coarse cells of the rail beside the path.",
                      Double(1., 1000.));
    prm.leave_subsection();

    prm.enter_subsection("Solid");
    prm.add_parameter(
      "Element", element,
      "one-point: uniform strain with hourglass stiffness, fast. fully-integrated: the cross-check.",
      Selection("one-point|fully-integrated"));
    prm.add_parameter("Hourglass coefficient", hourglass_coefficient,
                      "Stiffness of the hourglass modes; 1 gives a cube the stiffness of pure bending.",
                      Double(0.01, 10.));
    prm.add_parameter(
      "Stiffness damping (time steps)", damping_steps,
      "Internal forces are taken at x + beta v, beta in time steps. 0.1 removes grid-frequency chatter of "
      "the "
      "micro-slip and nothing else that can be seen; larger values shorten the stable time step.",
      Double(0., 10.));
    prm.add_parameter(
      "Mass damping (1 per s)", mass_damping,
      "Of motion relative to the rigid bodies: a wave fades by half in 1.4 over this. Removes what the "
      "start leaves ringing; only for quasi-static scenes.",
      Double(0., 1e6));
    prm.add_parameter("Linear bulk viscosity", linear_bulk_viscosity,
                      "Against ringing behind fronts; 0.06 is usual for impact.", Double(0., 10.));
    prm.add_parameter("Quadratic bulk viscosity", quadratic_bulk_viscosity,
                      "In compression only; 1.2 is usual for impact.", Double(0., 10.));
    prm.leave_subsection();

    prm.enter_subsection("Contact");
    prm.add_parameter("Friction coefficient", friction,
                      "Without slip; that of Coulomb's law is the same at any slip speed. 0 is frictionless. "
                      "Half-space references, the predicted start among them, know this number only.",
                      Double(0., 2.));
    prm.add_parameter("Friction law", friction_law_name, friction_law_help(), friction_law_pattern());
    declare_friction_laws(prm);
    prm.add_parameter(
      "Tolerance", contact_tolerance,
      "Sweeps over the contact nodes end when no impulse changes by more than this share of the largest.",
      Double(1e-15, 0.1));
    prm.add_parameter("Largest number of sweeps", max_sweeps, "In one time step.", Integer(1, 100000));
    prm.leave_subsection();

    declare_track();

    prm.enter_subsection("Vehicle");
    prm.add_parameter("Sprung mass (kg)", sprung_mass,
                      "Rests on the primary suspension and loads the contact.", Double(0.));
    prm.add_parameter("Suspension stiffness (kN per m)", suspension_stiffness_kN_m, "Vertical.", Double(0.));
    prm.add_parameter("Suspension damping (N s per m)", suspension_damping, "Vertical.", Double(0.));
    prm.add_parameter("Gravity (m per s2)", gravity,
                      "Weight of wheel and sprung mass: the load of the contact.", Double(0., 100.));
    prm.leave_subsection();

    prm.enter_subsection("Motion");
    prm.add_parameter("Speed (km per h)", speed_kmh, "Of the wheel's centre, kept along x. At least 0.1.",
                      Double(0., 1000.));
    prm.add_parameter(
      "Start (mm)", starts_at,
      "x of the wheel at the start. automatic: minus the rolled distance, so that the solution instant is at "
      "x = 0. A number keeps the wheel, the rail with its supports and a defect in their places when the "
      "rolled "
      "distance is changed.",
      Anything());
    prm.add_parameter(
      "Rolled distance (mm)", rolled_mm,
      "From the start to the solution instant; the run ends half a finest cell after it, over which the "
      "patch is averaged. The tangential solution needs one and a half to two patch lengths to become "
      "steady, and three to four if 'Start/Tractions' is none.",
      Double(tiny, 10000.));
    prm.add_parameter(
      "Drive", drive,
      "creepage: the angular velocity is kept. torque: a torque of traction coefficient x load x radius acts "
      "on the axle, after Hold distance at the creepage below.",
      Selection("creepage|torque"));
    prm.add_parameter(
      "Traction coefficient", traction_coefficient,
      "Longitudinal over normal force, positive when driving. Below the friction coefficient.",
      Double(-2., 2.));
    prm.add_parameter(
      "Creepage", creepage,
      "(angular velocity x radius - speed) / speed, counted from free rolling, positive when driving; "
      "or 'predicted': what half-space theory gives for the traction coefficient.",
      Anything());
    prm.add_parameter(
      "Hold distance (mm)", hold_mm,
      "Rolled at the creepage above before the torque acts, so that no long run-in is paid for.",
      Double(0., 10000.));
    prm.add_parameter(
      "Passages", passages,
      "Wheels that roll over the same rail, one after the other: the rail keeps its stress and strain, each "
      "wheel comes new. Above 1 passages.csv has a row for each. Cost grows in proportion.",
      Integer(1, 10000));
    prm.leave_subsection();

    prm.enter_subsection("Time stepping");
    prm.add_parameter("Courant number", courant_number,
                      "Time step over the critical one. Above 1 the run may become unstable and stops.",
                      Double(0.01, 2.));
    prm.add_parameter(
      "Levels", time_levels,
      "Cells twice, four times, ... as slow as the fastest step only every second, fourth, ... time. "
      "1: all cells in every step. More levels pay where much of the mesh is coarse; results are at "
      "least 2^(levels - 1) steps apart.",
      Integer(1, 6));
    prm.leave_subsection();

    prm.enter_subsection("Start");
    prm.add_parameter(
      "Tractions", start_tractions,
      "none: the wheel stands without friction at the start, and the tangential tractions build up as it "
      "rolls. predicted: it starts with what half-space theory gives for steady rolling, so that only what "
      "differs from that must still build up, as where steel yields. On a track the start takes some times "
      "as many iterations, and lateral tractions build up.",
      Selection("none|predicted"));
    prm.add_parameter("Tolerance", start_tolerance,
                      "Of the force balance at the start, share of the largest force.", Double(1e-12, 0.1));
    prm.add_parameter("Largest number of iterations", start_iterations, "Of the dynamic relaxation.",
                      Integer(1, 100000000));
    prm.leave_subsection();

    prm.enter_subsection("Output");
    prm.add_parameter("Directory", output, "Folder of the results; --output overrides it.");
    prm.add_parameter("History interval (mm)", history_mm, "Rolled distance between rows of history.csv.",
                      Double(1e-3));
    prm.add_parameter(
      "Supports", recorded,
      "Numbers of the supports whose forces history.csv has, separated by commas; empty: those "
      "beside the path of the wheel.",
      dealii::Patterns::List(Integer(-1000, 1000), 0, 1000));
    prm.add_parameter(
      "Cells", cells,
      "Cells of the rail whose von Mises stress and equivalent plastic strain cells.csv has, a row for each "
      "of history.csv: x,y,depth in mm of a point in each, depth below the running surface, separated by "
      "semicolons, as in -20,0,1.5; -20,0,4. Empty: none.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Strip half width (mm)", strip_half_width_mm,
      "strip.csv lists the largest von Mises stress that the rail's cells up to here at both sides of the "
      "first contact have seen along the path, looked at in each History interval. 0: no table.",
      Double(0.));
    prm.add_parameter(
      "Surface interval (mm)", surface_mm,
      "Rolled distance between pictures of the contact surface; 0: the solution instant only.", Double(0.));
    prm.add_parameter("Volume interval (mm)", volume_mm,
                      "Rolled distance between pictures of the bodies; 0: the solution instant only.",
                      Double(0.));
    prm.add_parameter(
      "Table depth (mm)", table_depth_mm,
      "At the solution instant rail_cells.csv lists stress and plastic strain of the rail's cells under the "
      "contact path down to this depth, and rail_surface.csv the displacement of its surface. 0: neither.",
      Double(0.));
    prm.add_parameter("Write volume", write_volume, "Whether pictures of the bodies are written at all.");
    prm.add_parameter("Checkpoint interval (minutes)", checkpoint_minutes,
                      "Wall time between checkpoints, from which --resume goes on; 0: only when interrupted.",
                      Double(0.));
    prm.leave_subsection();
  }
} // namespace tread
