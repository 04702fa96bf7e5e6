// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_scene_h
#define tread_scene_scene_h

#include <tread/contact/friction_law.h>
#include <tread/geometry/defect.h>
#include <tread/geometry/rail_profile.h>
#include <tread/geometry/running_surfaces.h>
#include <tread/material/elastic.h>
#include <tread/material/plastic.h>
#include <tread/track/rail_ends.h>
#include <tread/track/supports.h>

#include <deal.II/base/parameter_handler.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace tread
{
  /// A parameter or file that cannot be used; what() is one line for the user.
  class SceneError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// All that a user chooses, in the units that the parameter file names. Each entry is declared
  /// once: name, default, range, meaning.
  class Scene
  {
  public:
    Scene();

    struct Material
    {
      double      young_modulus_GPa = 210., poisson_ratio = 0.3, density = 7800.;
      double      yield_stress_MPa = 0., tangent_modulus_GPa = 21.;
      std::string hardening = "isotropic", backstress_moduli_GPa = "60", backstress_recoveries = "300";
      double      plastic_depth_mm = 8., plastic_half_width_mm = 10.;
      std::string plastic_zones;

      ElasticMaterial si() const
      {
        return {young_modulus_GPa * 1e9, poisson_ratio, density};
      }

      /// The plastic material in SI units, with the given yield stress and tangent modulus.
      PlasticMaterial plastic(const double yield_MPa, const double tangent_GPa) const;

      /// A part of the plastic zone that differs from the rest.
      struct Zone
      {
        double begin_mm, end_mm, depth_mm, yield_stress_MPa, tangent_modulus_GPa;
      };
      /// @throws SceneError
      std::vector<Zone> zones() const;
    };

    // Scene
    std::string title;
    bool        quasi_static  = true;
    double      density_scale = 1.;
    // Wheel
    std::string wheel_shape = "sector";
    double      radius_mm = 460., wheel_mass = 900., wheel_inertia = 58.;
    double      sector_thickness_mm = 60., sector_width_mm = 120., sector_margin_mm = 60.;
    double      rim_inner_radius_mm = 380., rim_width_mm = 135., web_thickness_mm = 52.3;
    double      hub_outer_radius_mm = 140., hub_length_mm = 180., bore_radius_mm = 92.5;
    std::string tread               = "cylinder";
    double      lateral_position_mm = 0.;
    Material    wheel_material;
    // Rail
    std::string rail_shape = "head", profile = "54E1", rail_inclination = "none", measured_head;
    std::string rail_begins_at  = "automatic";
    double      rail_length_mm  = 0.;
    double      crown_radius_mm = 300., block_width_mm = 120., block_height_mm = 60., rail_margin_mm = 60.;
    std::string rail_ends          = "symmetric";
    double      absorbing_length_m = 0.6;
    Material    rail_material;
    // Defect
    std::string defect_shape       = "none", defect_file;
    double      defect_position_mm = 0., defect_length_mm = 0., defect_width_mm = 0., defect_depth_mm = 0.,
           defect_lateral_mm = 0., leading_rounding_mm = 0., trailing_rounding_mm = 0.;
    std::string defect_lateral_law = "parabola";
    bool        defect_reversed    = false;
    // Mesh
    double finest_mm = 0.63, fine_half_width_mm = 0., cells_per_level = 2., level_depth = 1.,
           coarsest_mm        = 22.;
    unsigned int fine_layers  = 2;
    double       fine_from_mm = 0., fine_to_mm = 0., path_cell_mm = 0., longest_row_mm = 40.;
    // Solid
    std::string element          = "one-point";
    double hourglass_coefficient = 1., damping_steps = 0.1, mass_damping = 0., linear_bulk_viscosity = 0.,
           quadratic_bulk_viscosity = 0.;
    // Contact
    double       friction = 0.5, contact_tolerance = 1e-7;
    std::string  friction_law_name = "Coulomb";
    unsigned int max_sweeps        = 200;
    // Track
    std::string foundation = "rigid", sleepers = "mass";
    double      sleeper_spacing_m = 0.6, support_0_mm = 0.;
    double pad_stiffness_MN_m = 1300., pad_damping_kN_s_m = 45., pad_length_mm = 150., pad_width_mm = 140.;
    unsigned int points_along = 3, points_across = 4;
    double sleeper_mass = 200., sleeper_length_m = 2.52, sleeper_width_mm = 250., rail_distance_mm = 1500.;
    double sleeper_young_modulus_GPa = 38.4, sleeper_poisson_ratio = 0.2, sleeper_density = 2520.;
    double ballast_stiffness_MN_m = 45., ballast_damping_kN_s_m = 32.;
    // Vehicle
    double sprung_mass = 13400., suspension_stiffness_kN_m = 1150., suspension_damping = 2500.,
           gravity = 9.81;
    // Motion
    double       speed_kmh = 140., rolled_mm = 60., hold_mm = 15.;
    std::string  starts_at = "automatic";
    std::string  drive = "creepage", creepage = "predicted";
    double       traction_coefficient = 0.3;
    unsigned int passages             = 1;
    // Time stepping
    double       courant_number = 0.95;
    unsigned int time_levels    = 1;
    // Start
    std::string  start_tractions  = "predicted";
    double       start_tolerance  = 1e-5;
    unsigned int start_iterations = 20000;
    // Output
    std::string output = "results";
    std::string recorded, cells;
    double history_mm = 0.25, surface_mm = 0., volume_mm = 0., table_depth_mm = 0., strip_half_width_mm = 3.,
           checkpoint_minutes = 10.;
    bool write_volume         = true;

    /// Read a parameter file (none: all defaults), then "Section/Name=value" settings in their order, and
    /// check that they make sense together. @throws SceneError
    void read(const std::string &file, const std::vector<std::string> &settings);

    /// All parameters with their values, units, ranges and meaning, as a parameter file.
    void print(std::ostream &out, const bool with_documentation) const;

    struct Parameter
    {
      std::string path, value; ///< Section/Name
    };
    /// All parameters of a scene with this parameter file, in the order of declaration. Only names and ranges
    /// are checked. @throws SceneError
    static std::vector<Parameter> parameters_in(const std::string &file);

    double speed() const
    {
      return speed_kmh / 3.6;
    }
    /// Weight that rests on the contact, N.
    double static_load() const
    {
      return (wheel_mass + sprung_mass) * gravity;
    }
    /// Rolling speed over the speed of Rayleigh waves in the scaled material, squared: the order of
    /// the relative error that the inertia of rolling makes in a quasi-static scene.
    double inertia_error_estimate() const;

    /// Numerical assumptions that are not part of the physics of the scene (scaled density, mass damping,
    /// predicted start), one line each.
    std::vector<std::string> assumptions() const;

    /// The law that the scene names, with its parameters. @throws SceneError
    std::shared_ptr<const FrictionLaw> friction_law() const;

    bool predicts_creepage() const
    {
      return creepage == "predicted";
    }
    bool has_supports() const
    {
      return foundation != "rigid";
    }
    bool has_solid_sleepers() const
    {
      return foundation == "two-layer" && sleepers == "solid";
    }
    TrackParameters track() const;
    /// The absorbing ends of the rail. Their length is 0 if the ends are symmetric.
    AbsorbingEnds absorbing_ends() const;
    /// Coordinates x of the supports on the rail, m, and the number of the first one. Support 0 lies where
    /// the scene places it.
    std::vector<double> support_positions() const;
    int                 first_support() const;
    /// The middle of the rail's base at x = 0.
    dealii::Point<3> base_middle() const;
    /// Height of a solid sleeper, which follows from the mass that the scene prescribes, m.
    double solid_sleeper_height() const;
    /// Numbers of the supports written to history.csv: those selected, or those next to the path of the
    /// wheel.
    std::vector<int> recorded_supports() const;
    /// Positions in the rail (reference configuration, m) whose cells are written to cells.csv. @throws
    /// SceneError
    std::vector<dealii::Point<3>> recorded_cells() const;

    /// x of the wheel at the start and at the solution instant, m.
    double path_begin() const
    {
      return shapes->path_begin;
    }
    double path_end() const
    {
      return shapes->path_end;
    }
    /// The profile of a rail head or a full section.
    RailProfile rail_profile() const;
    /// Ends of the rail, m.
    double rail_begin() const
    {
      return shapes->rail_begin;
    }
    double rail_end() const;
    /// Angle by which the rail top is inclined towards the gauge side, y < 0, rad.
    double inclination() const;
    /// Position in the rail's own axes, which are inclined with it.
    dealii::Point<3> in_rail_axes(const dealii::Point<3> &p) const;

    /// The running surfaces of wheel and rail, created by read().
    const RunningSurfaces &surfaces() const
    {
      return shapes->surfaces;
    }
    /// Height above the rail's profile, in the rail's own axes: measured head and defect. Null: none. @see
    /// RailTop
    const std::function<double(double, double)> &rail_height() const
    {
      return shapes->rail_height;
    }
    /// The defect of the running surface; null: none.
    const std::shared_ptr<const Defect> &defect() const
    {
      return shapes->defect;
    }
    /// Point of first contact on the smooth rail, and the position of the wheel at the start.
    const FirstContact &first_contact() const
    {
      return shapes->contact;
    }
    /// Lateral extent of the patch under the static load on the smooth rail (m), from half-space theory with
    /// the true gap: the patch of a worn profile or of S1002 may extend far to one side of the first contact.
    struct PatchExtent
    {
      double begin, end;
    };
    const PatchExtent &patch_extent() const
    {
      return shapes->patch;
    }
    /// Half width of the zone of finest cells, from the middle of the path: as prescribed, or as the patch
    /// requires, m.
    double fine_half_width() const;
    /// Smallest admissible half width of that zone, m.
    double needed_half_width() const;
    /// Lateral middle of the finely meshed path: the first contact, shifted by whole cells towards the middle
    /// of the patch, m.
    double path_y() const;
    /// Depth below the running surface of a point in the reference configuration, m.
    double depth_in_rail(const dealii::Point<3> &p) const;
    /// Height of the axle at the start, m.
    double axle_height() const
    {
      return 1e-3 * radius_mm + first_contact().lift;
    }
    /// Rolling radius of the wheel at the first contact, m.
    double rolling_radius() const;
    /// Lateral radius of the gap between the surfaces where they touch, m.
    double lateral_radius() const;

  private:
    /// Quantities that follow from the positions, files and shapes named by the parameters.
    struct Shapes
    {
      double                                path_begin, path_end, rail_begin; ///< x, m
      RunningSurfaces                       surfaces;
      std::function<double(double, double)> rail_height;
      std::shared_ptr<const Defect>         defect;
      FirstContact                          contact;
      PatchExtent                           patch;
    };

    void parse(const std::string &file);
    void declare();
    void declare_defect();
    void declare_track();
    void set(const std::string &setting);
    void check() const;
    void check_track() const;
    /// Check that scaled density, mass damping and levels of time steps are used only where they are
    /// admissible.
    void check_numerics() const;
    /// Path of a file named by a parameter: as given, or relative to the folder of the parameter file.
    std::string located(const std::string &file) const;
    /// @throws SceneError
    void                          make_shapes();
    std::shared_ptr<const Defect> make_defect() const;
    PatchExtent                   patch_under_load() const;
    void                          check_surfaces() const;
    /// @param thickness_mm and the following: extent of the body's mesh from its surface, from its middle and
    /// along the path. @throws SceneError
    void check_plasticity(const std::string &section,
                          const Material    &material,
                          const double       thickness_mm,
                          const double       half_width_mm,
                          const double       begin_mm,
                          const double       end_mm) const;

    mutable dealii::ParameterHandler handler;
    std::filesystem::path            folder; ///< of the parameter file
    std::shared_ptr<const Shapes>    shapes;
  };
} // namespace tread

#endif
