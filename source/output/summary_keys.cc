// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/damage_index.h>
#include <tread/output/quality.h>
#include <tread/output/summary_keys.h>

#include <map>
#include <regex>
#include <utility>
#include <vector>

namespace tread
{
  namespace
  {
    /// Names of keys with what they mean.
    using Keys = std::vector<std::pair<std::string, std::string>>;

    Keys &further_keys()
    {
      static Keys keys;
      return keys;
    }


    const std::string over_last_way = "mean over the last 10 mm of the path",
                      over_a_cell   = "mean while the wheel rolls over one cell around the end of the path",
                      largest_patch = "; of a wheelset in a position the largest of its patches",
                      all_patches   = "; of a wheelset in a position the sum of its patches";

    /// What was solved, and where a wheelset stands in its track.
    const Keys scene{
      {"title", "'Scene/Title'"},
      {"method", "How it was solved: explicit finite elements, or half-space solver (tread reference)"},
      {"completed",
       "Whether the end was reached: false after an interruption, and where contact was about to leave the "
       "faces meshed for it"},
      {"lateral_shift_m",
       "Of a wheelset in a position: its shift in the track, to its own side, at the end of the path"},
      {"yaw_rad",
       "Of a wheelset in a position, at the end of the path, positive: the leading side turns to the own "
       "side"},
      {"roll_rad", "Of a wheelset in a position, at the end of the path, positive: the own side goes down"},
      {"creepage_over_nominal_radius",
       "Of a wheelset in a position: angular velocity times 'Wheel/Radius (mm)' over the speed, less 1, as "
       "'Motion/Creepage' counts it; 'creepage' of each patch counts from the radius that rolls there"},
      {"angular_velocity_rad_per_s",
       "Of a wheelset in a position, about its axle at the end of the path, counted from free rolling"},
      {"wheelset_height_m",
       "Of a wheelset in a position: height of the middle of its axle over the tops of the rails, less the "
       "wheel's radius, at the end of the path"}};

    /// Of each wheel; the keys of further ones have its number in their names.
    struct WheelKey
    {
      std::string name, about;
      std::string of_first = ""; ///< what is to be added of the plain key
    };
    const std::vector<WheelKey> of_wheel{
      {"normal_force_N", "Vertical force on the wheel, " + over_last_way,
       " (half-space solver: the load); of a wheelset in a position of all its patches together"},
      {"longitudinal_force_N", "Force on the wheel along the rail, positive forward, " + over_last_way},
      {"lateral_force_N", "Force on the wheel across the rail, positive to the field side, " + over_last_way,
       "; of a wheelset in a position positive to its own side"},
      {"traction_coefficient", "Longitudinal over normal force, 0 without a normal force"},
      {"creepage",
       "Angular velocity x rolling radius over speed, less 1, counted from free rolling, at the end of the "
       "run; positive when driving"},
      {"free_rolling_creepage", "At which the loaded wheel rolls freely, by the difference of both surfaces' "
                                "stretch along the rail at "
                                "the start, beyond that of half-spaces; creepages are counted from it"},
      {"max_pressure_Pa", "Largest pressure of a node, " + over_a_cell, largest_patch},
      {"patch_area_m2", "Area in contact, " + over_a_cell, all_patches},
      {"adhesion_share", "Share of the area that sticks, " + over_a_cell},
      {"max_slip_m_per_s",
       "Largest micro-slip of a node, the velocity of the wheel over the rail, " + over_a_cell,
       largest_patch},
      {"frictional_power_W", "Power that friction takes in the patch, " + over_a_cell, all_patches}};

    /// What rolling does to the steel.
    const Keys of_damage{
      {"t_gamma_N",
       "Frictional power over the rolling speed: T-gamma, spin included, summed over all patches"},
      {"max_flash_temperature_K",
       "Largest rise of temperature by the heat of friction, of rail and wheels, in all steps"},
      {"wear_volume_m3", "Volume that the rail has lost by 'Damage/Wear law', in all passages; in each the "
                         "wheels together lose as much"}};

    /// Of profiles that wear (tread wear).
    const Keys of_profile_wear{
      {"contacts", "Contacts of a block of passages, rows of the table of tread wear"},
      {"wear_steps", "Steps in which the profiles wore"},
      {"wear_steps_refused", "Those that changed the pressure too much and were taken again, shorter"},
      {"rail_passages", "'Profile wear/Passages' of wheels over the rail"},
      {"wheel_turns", "'Profile wear/Wheel turns' meanwhile"},
      {"rail_wear_depth_m", "Largest depth that the rail has worn"},
      {"wheel_wear_depth_m", "Largest depth that the wheel has worn"},
      {"rail_wear_area_m2",
       "Area between the rail's profile and that at the start: volume on a metre of way"},
      {"wheel_wear_area_m2",
       "Area between the wheel's profile and that at the start: volume on a metre of its circumference"},
      {"rail_wear_area_by_law_m2", "The same by 'Damage/Wear law', summed over the steps"},
      {"wheel_wear_area_by_law_m2", "The same of the wheel"},
      {"rail_friction_work_J_per_m", "Work of friction in all passages, on a metre of way"},
      {"wheel_friction_work_J_per_m", "Work of friction in all turns, on a metre of the circumference"},
      {"max_pressure_at_start_Pa", "Largest pressure of all contacts on the new profiles"}};

    /// Of the first wheel alone.
    const Keys first_wheel{
      {"friction_coefficient",
       "'Contact/Friction coefficient', which factors of places, slip and pressure may change"},
      {"first_contact_y_m", "Where wheel and rail touch first without load and defect, from the middle of "
                            "the rail's top, positive "
                            "to the field side"},
      {"semi_axis_x_m", "Half the length of the patch along the rail, from the first to the last node in "
                        "contact and a cell, " +
                          over_a_cell},
      {"semi_axis_y_m", "Half its width across the rail, likewise, " + over_a_cell},
      {"pressure_semi_axis_x_m",
       "Semi-axis along the rail of Hertz's ellipse with the same second moment of pressure, " + over_a_cell},
      {"pressure_semi_axis_y_m", "The same across the rail, " + over_a_cell},
      {"pressure_centre_x_m",
       "Where the resultant of the pressure acts, along the rail ahead of the axle, " + over_a_cell},
      {"pressure_centre_y_m", "The same across, from the middle of the rail's top, " + over_a_cell},
      {"max_shear_Pa", "Largest shear stress of a node, " + over_a_cell + largest_patch},
      {"lateral_coefficient", "Resultant of the lateral shear stress over that of the pressure, " +
                                over_a_cell + "; where the half-space solution has a lateral force"},
      {"normal_force_ripple_share",
       "Largest deviation of the normal force of a step from its mean over the last 10 mm of the path, over "
       "this mean"},
      {"tangential_force_ripple_share",
       "Amplitude of the force along and across the rail about straight lines over the last 10 mm of the "
       "path, that of a sine with the same mean square, over the mean normal force"}};

    /// What is compared, and words.
    const Keys comparison{
      {"max_pressure_Pa_half_space_uncertainty",
       "How far the half-space's largest pressure may lie from the limit of small elements; likewise behind "
       "the names of other figures"},
      {"reference", "Figures of the summary with what they are compared with: by name and source"},
      {"reference/max_pressure_Pa/Hertz/value", "What the figure is compared with: of Hertz's ellipse under "
                                                "the normal force (the load of a wheel that "
                                                "has lifted off), or of the half-space in steady rolling"},
      {"reference/max_pressure_Pa/Hertz/source", "Hertz or half-space"},
      {"reference/max_pressure_Pa/Hertz/relative_difference",
       "Figure less this value, over the value; null where the value is as good as zero"},
      {"reference/max_pressure_Pa/Hertz/uncertainty",
       "Of a half-space's value: how far it may lie from the limit of small elements"},
      {"patches", "Of a wheelset in a position: a list with an entry for each patch, in contact axes: x "
                  "forward, s along the rail's surface to the field side, the normal upwards; forces, "
                  "pressure, slip and extent are means while the wheel rolls over one cell around the end of "
                  "the path, what follows from the undeformed bodies is the half-space's"},
      {"half_space_patches", "The same patches as half-space theory has them, with the same keys"},
      {"note", "Why there is no comparison with steady rolling, or what stands against it, in words; only "
               "where there "
               "is something to say"},
      {"assumptions",
       "What the run takes for granted, in words: scaled density, damping, the type of start, ..."},
      {"unused_parameters",
       "What the scene sets and another of its parameters leaves without effect, in words"},
      {"wheel_profile_largest_change_m", "By how much 'Wheel/Smoothing length (mm)' moved a point of the "
                                         "measured tread at most, at right angles to "
                                         "it; only where it is above 0"},
      {"rail_profile_largest_change_m", "The same of 'Rail/Smoothing length (mm)' and the measured head"},
      {"warnings",
       "Measures of quality beyond their thresholds and other reasons to doubt the figures, in words"}};

    /// Extremes over the rows of history.csv of a scene with a defect or a track.
    const Keys impacts{
      {"largest_normal_force_N",
       "Largest normal force on the first wheel, mean over an interval of the history"},
      {"largest_normal_force_x_m", "Where the wheel was at the end of that interval"},
      {"largest_normal_force_over_static", "This force over the static load of a wheel"},
      {"largest_normal_force_at_end",
       "Whether it is that of the last interval: a run that had gone on might have exceeded it"},
      {"least_normal_force_N", "Least normal force on the first wheel, mean over an interval of the history"},
      {"least_normal_force_x_m", "Where the wheel was at the end of that interval"},
      {"least_normal_force_over_static", "This force over the static load of a wheel"},
      {"least_normal_force_at_end",
       "Whether it is that of the last interval: a run that had gone on might have fallen below it"},
      {"airborne_s", "How long the first wheel was in the air: intervals of the history without any force"},
      {"largest_pad_force_N",
       "Largest compressive force in the pad of a recorded support at the end of an interval of the history"},
      {"largest_pad_force_x_m", "Where the first wheel was then"},
      {"largest_pad_force_support", "Number of that support"},
      {"largest_pad_force_at_end", "Whether it is that of the last interval"},
      {"largest_ballast_force_N",
       "Largest compressive force in the ballast under a recorded support at the end of an interval of the "
       "history"},
      {"largest_ballast_force_x_m", "Where the first wheel was then"},
      {"largest_ballast_force_support", "Number of that support"},
      {"largest_ballast_force_at_end", "Whether it is that of the last interval"}};

    /// How large the run was and what it cost.
    const Keys cost{
      {"contact_unconverged_steps",
       "Steps in which the iteration of the contact ended before 'Contact/Tolerance' was reached"},
      {"cells", "Number of cells of all bodies"},
      {"windows", "Number of places at which the window of fine cells has stood"},
      {"window_loss_J", "Energy that fine cells had and others do not carry when the window moves"},
      {"plastic_cells", "Number of cells that can yield"},
      {"unknowns", "Three for each node that does not hang"},
      {"steps", "Time steps of the shortest level, of all passages"},
      {"time_step_s", "Of the shortest level, at the end"},
      {"density_scale", "'Scene/Density scale'"},
      {"added_mass_rail_kg",
       "Mass that 'Time stepping/Least step (us)' added to the fastest cells of the rail, the largest of "
       "all windows of fine cells"},
      {"added_mass_rail_share", "The same over the mass of the rail's cells"},
      {"added_mass_wheels_kg", "The same of all wheels' cells"},
      {"added_mass_wheels_share", "The same over the mass of these cells"},
      {"added_mass_error_estimate",
       "Inertia of what was added at a wheel and in the rail, at 1 kHz, over the stiffness of the contact: "
       "about the relative error of the contact force there"},
      {"inertia_error_estimate",
       "Relative error by inertia in steady rolling, about: density scale x square of the speed over that of "
       "Rayleigh waves in the slower body"},
      {"passages", "Wheels that roll over the rail one after the other: 'Motion/Passages', or fewer where "
                   "its steel failed"},
      {"passages_rolled", "Those that were rolled, and not left out by 'Ratcheting/Jumps'"},
      {"passages_left_out", "Those over which the change of the steel was extrapolated"},
      {"jumps", "How often passages were left out"},
      {"net_plastic_strain", "Largest equivalent of what is left of the rail's plastic strain after the last "
                             "passage, without what goes "
                             "forth and back, of the cells in the middle of the path"},
      {"net_plastic_strain_y_m", "y of that cell's centre, before it was deformed"},
      {"net_plastic_strain_depth_m", "Its depth"},
      {"net_plastic_strain_of_last_passage", "Largest change of it in the last passage, of the same cells"},
      {"net_plastic_strain_error_estimate", "How far the jumps may have put it off: half the passages left "
                                            "out times how far the change per passage "
                                            "behind the jump was from the expected one, summed"},
      {"passages_to_failure", "Passage with which it reached 'Ratcheting/Strain at failure (%)'"},
      {"rolled_m", "How far the wheel has rolled; of several passages in the last one"},
      {"rolled_patch_lengths", "The same, from the onset of a torque on, over the length of the patch under "
                               "the normal force, by Hertz "
                               "or half-space theory"},
      {"long_enough_to_be_steady",
       "Whether that is enough for steady rolling: 1.5 lengths after a start with tractions if no cell can "
       "yield, otherwise 3"},
      {"wall_s",
       "Wall time without the generation of the mesh, with that of a resumed run before (half-space solver: "
       "of the whole answer)"},
      {"wall_s_start", "Wall time of the equilibrium at the start, of the last passage"},
      {"wall_s_internal_forces",
       "Wall time of forces of cells and supports in all steps, of the slowest rank"},
      {"wall_s_contact", "Wall time of search and solution of the contact, likewise"},
      {"wall_s_communication", "Wall time in which ranks exchange forces and wait for each other, likewise"},
      {"wall_s_nodes", "Wall time of moving nodes and hubs, likewise"},
      {"element_updates", "Evaluations of cells in all time steps on all ranks"},
      {"element_updates_per_s", "The same over the wall time of internal forces"},
      {"cells_and_nodes_bytes", "Memory of mesh, cells and nodes on all ranks"},
      {"ranks", "Processes of MPI"},
      {"imbalance_of_cells", "Largest number of cells of a rank over the mean"},
      {"ranks_of_contact",
       "So many of the ranks share the sweeps over the patch, as many as have enough to do"},
      {"version", "Of the program"},
      {"files",
       "Files that the run has read: a list with the parameter that names each ('parameter file' for the "
       "scene's own text), its path, and bytes and crc32 of its content"}};

    /// Stresses in the rail, and what history.csv is.
    const Keys recorded{
      {"strip_max_von_mises_Pa",
       "Largest von Mises stress in strip.csv: of the rail's cells under the path at the ends of the "
       "history's intervals"},
      {"strip_max_von_mises_x_m", "Where it was: middle of the surface cell above it, along the rail"},
      {"strip_max_von_mises_y_m", "Where it was: middle of its cell, across"},
      {"strip_max_von_mises_depth_m", "Where it was: middle of its cell, below the surface"},
      {"strip_max_von_mises_time_s", "When it was"},
      {"cell_1_x_m", "Middle of the cell of the rail that 'Output/Cells' names, along the rail"},
      {"cell_1_y_m", "The same across"},
      {"cell_1_depth_m", "The same below the surface"},
      {"largest_plastic_strain", "Largest equivalent plastic strain of the rail's cells, at the end"},
      {"largest_plastic_strain_x_m", "Where it is: middle of its cell as meshed, along the rail"},
      {"largest_plastic_strain_y_m", "The same across"},
      {"largest_plastic_strain_depth_m", "The same below the surface"},
      {"wheel_largest_plastic_strain",
       "Largest equivalent plastic strain of the first wheel's cells, at the end"},
      {"history_crc32", "CRC-32 of history.csv as the run wrote it"}};

    /// Of the half-space's answer alone.
    const Keys half_space{
      {"wheel_max_von_mises_Pa",
       "Largest von Mises stress of the wheel in the plane along the rail through the first contact, "
       "from a twentieth to one and a half of the smaller semi-axis deep"},
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
       "Largest violation of Coulomb's law, over friction coefficient and largest pressure"},
      {"solutions",
       "Of a wheelset in a position: half-space solutions in the search for the height that carries the "
       "load"}};

    /// The largest value of a quantity in the region of 'Peak stress' and over all steps. @param how it is
    /// found
    void add_peak(Keys &keys, const std::string &name, const std::string &what, const std::string &how = "")
    {
      const bool        of_wheel = name.rfind("wheel_", 0) == 0;
      const std::string of_region =
        of_wheel ? " in the part of its tread that rolls over the region" : " in the region";
      keys.emplace_back(name + "_Pa",
                        "Largest " + what + of_region + " of 'Peak stress', of all steps" + how);
      keys.emplace_back(name + "_x_m", of_wheel
                                         ? "Where that part of the tread meets the rail, along the rail"
                                         : "Where it was, along the rail");
      keys.emplace_back(name + "_y_m", "Where it was, across");
      if (what.find("cells") != std::string::npos)
        keys.emplace_back(name + "_depth_m", "Where it was: half the height of its layer, from the surface");
      keys.emplace_back(name + "_time_s", "When it was");
    }

    Keys peaks()
    {
      const std::string recovered =
        ", recovered at its nodes from tractions and stretch, or from below where steel has yielded";
      Keys keys;
      add_peak(keys, "peak_von_mises", "von Mises stress of the layers of the rail's cells");
      add_peak(keys, "peak_surface_von_mises", "von Mises stress at the rail's surface", recovered);
      add_peak(keys, "peak_surface_von_mises_from_tractions", "von Mises stress at the rail's surface",
               ", from the stretch of a face of it and the tractions on it");
      add_peak(keys, "peak_pressure", "pressure of a node of the rail");
      add_peak(keys, "peak_shear", "shear stress of a node of the rail");
      add_peak(keys, "wheel_peak_von_mises", "von Mises stress of the layers of the first wheel's cells");
      add_peak(keys, "wheel_peak_surface_von_mises", "von Mises stress at the first wheel's surface",
               recovered);
      return keys;
    }

    Keys all_keys()
    {
      Keys wheel, further_wheels, quality, indices;
      for (const WheelKey &key : of_wheel)
        {
          wheel.emplace_back(key.name, key.about + key.of_first);
          further_wheels.emplace_back("wheel_2_" + key.name, key.about);
        }
      for (const Column<Quality> &column : quality_columns())
        quality.emplace_back(heading(column), column.about);
      for (const DamageIndexEntry &index : damage_indices())
        indices.emplace_back(index.key, index.about);
      Keys all;
      for (const Keys &keys :
           {scene, wheel, first_wheel, comparison, quality, impacts, cost, further_wheels, recorded,
            of_damage, indices, of_profile_wear, peaks(), half_space, further_keys()})
        all.insert(all.end(), keys.begin(), keys.end());
      return all;
    }

    /// A key as the list has it.
    std::string without_numbers(const std::string &key)
    {
      static const std::regex further_wheel("^wheel_[0-9]+_"), cell("^cell_[0-9]+_"),
        source("^reference/[^/]*/[^/]*/"), uncertainty("^.*_half_space_uncertainty$");
      std::string text = std::regex_replace(key, further_wheel, "wheel_2_");
      text             = std::regex_replace(text, cell, "cell_1_");
      text             = std::regex_replace(text, source, "reference/max_pressure_Pa/Hertz/");
      return std::regex_replace(text, uncertainty, "max_pressure_Pa_half_space_uncertainty");
    }

    /// Some have their unit, or that of the figure to which they belong, within the name.
    std::string unit_of_key(const std::string &key)
    {
      static const std::regex within(
        "^(wall_s)_.*$|^(.*)_half_space_uncertainty$|^reference/([^/]*)/[^/]*/(?:value|uncertainty)$");
      return unit_of_heading(std::regex_replace(key, within, "$1$2$3"));
    }
  } // namespace


  bool know_summary_key(const std::string &key, const std::string &about)
  {
    further_keys().emplace_back(key, about);
    return true;
  }


  TableDescription keys_of_summary()
  {
    TableDescription table{"summary.json", {}};
    for (const auto &[key, about] : all_keys())
      table.columns.push_back({key, unit_of_key(key), about});
    return table;
  }


  std::string about_summary_key(const std::string &key)
  {
    static const std::map<std::string, std::string> meanings = []() {
      const Keys keys = all_keys();
      return std::map<std::string, std::string>(keys.begin(), keys.end());
    }();
    const auto found = meanings.find(without_numbers(key));
    return found == meanings.end() ? "" : found->second;
  }
} // namespace tread
