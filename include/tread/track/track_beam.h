// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_track_beam_h
#define tread_track_track_beam_h

#include <tread/base/archive.h>
#include <tread/reference/supported_beam.h>

#include <deal.II/lac/sparse_direct.h>

#include <array>
#include <memory>
#include <vector>

namespace tread
{
  /// A sleeper as the pad on it feels it: coordinates whose sum is the displacement under the pad. A rigid
  /// one has one; without any the pads stand on the ground.
  struct SleeperModes
  {
    std::vector<double> mass, stiffness; ///< of each coordinate: kg, N/m
    std::vector<double> weighing;        ///< what gravity pulls at each, kg
    std::vector<double> damping;         ///< of the ballast, row by row of a symmetric matrix, N s/m

    std::size_t size() const
    {
      return mass.size();
    }
  };

  /// A part of the beam that carries cells, from the section on: nothing if it has no length.
  struct LoadedPart
  {
    double from = 0., to = 0.; ///< m
    /// What the cells have, and the beam has less, by element of the whole beam: mass and bending stiffness.
    /// Of its rotary inertia the beam keeps the same share as of its bending stiffness. Empty: nothing.
    std::vector<reference::BeamSection> cells;

    bool is_there() const
    {
      return to > from;
    }
  };

  /// From a place on the beam has another section.
  struct BeamStretch
  {
    double                 from; ///< from the section on, m
    reference::BeamSection section;
  };

  struct TrackBeamParameters
  {
    unsigned int             n_spans         = 20;
    double                   spacing         = 0.6;  ///< of the supports, m
    double                   first_support   = 0.3;  ///< distance from the end of the cells, m
    double                   stiffness_along = 40e6; ///< of a support, along the rail, N/m
    double                   shear_speed     = 3200; ///< of the steel, m/s: @see AbsorbingEnds
    double                   gravity         = 0.;   ///< m/s^2
    reference::SupportLayers layers;                 ///< of each support
    SleeperModes             sleeper;                ///< none given: that of the layers, which is rigid
    LoadedPart               loaded;    ///< with one the beam absorbs what arrives at its beginning as well
    std::vector<BeamStretch> stretches; ///< in their order; before the first one the beam's own section
  };

  /// Where the nodes of a beam lie.
  struct BeamNodes
  {
    std::vector<double>      places;     ///< distances from the section, which comes first, m
    std::vector<std::size_t> of_support; ///< places over the supports
  };
  BeamNodes beam_nodes(const TrackBeamParameters &parameters);
  /// Its section between two neighbouring nodes. @param before the first stretch
  const reference::BeamSection &section_between(const reference::BeamSection   &before,
                                                const std::vector<BeamStretch> &stretches,
                                                const double                    from,
                                                const double                    to);

  /// A beam under a piece of rail.
  struct BeamUnderRail
  {
    reference::BeamSection section;              ///< of the whole rail
    double                 axial_stiffness = 0.; ///< E A, N
    double                 begin           = 0.; ///< x of the beam's held section, m
    TrackBeamParameters    track;                ///< with the part that carries cells
  };

  /// A rail as a Timoshenko beam and bar on supports (springs, dampers and sleepers). It stands for the track
  /// beyond one end of a rail of cells, whose last section is its first node; or for all of the rail under a
  /// piece of cells that it carries, with a first section that is held far away. In the half that is farther
  /// away damping grows towards a plane of symmetry, as at absorbing ends. Coordinates point outwards from
  /// the section: along the rail, upwards, and the slope of a cross-section. Linear: supports pull and have
  /// no gaps.
  ///
  /// Two-node elements that are exact in statics (one-point integration with the residual bending flexibility
  /// of MacNeal 1978), lumped inertia, and central differences in step with the cells: forces at the
  /// displacements of step n, dampers with the velocities of half a step before. The section itself has no
  /// mass here: half an element's is that of its other node.
  class TrackBeam
  {
  public:
    /// Displacement (m, m, rad) or velocity of the section, or force (N, N, N m) on it.
    struct AtSection
    {
      double along = 0., up = 0., slope = 0.;
    };

    /// @param axial_stiffness E A, N
    TrackBeam(const reference::BeamSection &section,
              const double                  axial_stiffness,
              const TrackBeamParameters    &parameters);

    /// Everything is at rest with the section displaced so.
    void set_at_rest(const AtSection &section);
    /// Everything follows the section slowly, as it would at rest.
    void follow_slowly(const AtSection &velocity_of_section);

    // The part that carries cells.

    std::size_t n_loaded() const ///< its nodes
    {
      return last_loaded - first_loaded + 1;
    }
    /// Up (m) and slope (rad) of its nodes, one node after the other.
    std::vector<double> displacements_of_loaded() const;
    /// How a place of it follows two of its nodes, the first of which is this one: deflection and slope of
    /// the cross-section by the deflection and the slope of one node after the other, as the static equations
    /// of a Timoshenko beam without loads between them have it (Friedman & Kosmatka 1993).
    struct Place
    {
      std::size_t           first; ///< of the four among the ups and slopes of the loaded nodes
      std::array<double, 4> up, slope;
    };
    /// @param from_section m
    Place place(const double from_section) const;
    /// Forces (N) and moments (N m) of the cells on its nodes, one node after the other.
    void set_loads(const double *of_nodes);
    /// Displace the beam as these loads do at rest, with the section where it is; velocities stay. Or set its
    /// velocities to those with which it follows loads that change by so much in a second, or to those of a
    /// beam with the same nodes.
    void take_loads_at_rest();
    void follow_loads(const double *rates_of_nodes);
    void move_as(const TrackBeam &other)
    {
      velocity = other.velocity;
    }
    AtSection displacement_at(const Place &place) const
    {
      return value_at(place, displacement);
    }
    AtSection velocity_at(const Place &place) const
    {
      return value_at(place, velocity);
    }

    /// Find the forces at the present state.
    void find_forces();
    /// That of the springs and the beam on the section, as last found.
    const AtSection &force_on_section() const
    {
      return on_section;
    }
    /// The same at present, after a step.
    AtSection present_force_on_section() const;
    /// Move by one step, with the section's new velocity. @pre find_forces()
    void advance(const AtSection &velocity_of_section, const double time_step);

    /// Bounds of what moves here, over its masses: 1/s^2 and 1/s.
    double stiffness_over_mass() const;
    double damping_over_mass() const;
    /// Of the first element, as its section feels it: N/m, N/m, N m; row sums.
    AtSection stiffness_of_section() const;

    /// Energies at present, J, and of weight half a step back.
    double spring_energy() const;
    double kinetic_energy(const double time_step) const;
    double weight_potential(const double time_step) const;
    double dissipated() const
    {
      return damper_work;
    }

    void serialize(Archive &archive);

  private:
    /// Unknowns in this order: along, up and slope of the nodes behind the section, then the coordinates of
    /// one sleeper after the other.
    std::size_t unknown(const unsigned int kind, const std::size_t node) const
    {
      return kind * n_nodes + node;
    }
    std::size_t of_sleeper(const std::size_t support, const std::size_t coordinate = 0) const
    {
      return 3 * n_nodes + support * parameters.sleeper.size() + coordinate;
    }
    /// What these unknowns have under the pad of a support.
    double under_pad(const std::vector<double> &values, const std::size_t support) const;
    /// Forces of beam and springs at these displacements. @returns what acts on the section
    AtSection spring_forces(const AtSection           &section,
                            const std::vector<double> &displacement,
                            std::vector<double>       &force) const;
    void      find_damping(); ///< forces of dampers at the present velocities
    void      find_shapes();
    AtSection value_at(const Place &place, const std::vector<double> &values) const;
    /// Displacements that these forces on the unknowns cause at rest.
    std::vector<double> at_rest(const std::vector<double> &forces) const;

    struct Element
    {
      double length, axial, bending, shear; ///< m; E A/h, E I/h, N/m and N m; corrected kappa G A, N
    };
    TrackBeamParameters      parameters;
    std::vector<Element>     elements; ///< of node i - 1 (or the section) and node i
    std::size_t              n_nodes = 0;
    std::vector<std::size_t> node_of_support;
    std::vector<double>      mass, weight, rate; ///< kg, kg m^2; N; 1/s: by unknown

    std::vector<double> distances;                         ///< of the nodes from the section, m
    std::size_t         first_loaded = 0, last_loaded = 0; ///< nodes
    std::vector<double> load;                              ///< by unknown

    // At rest: with a unit displacement of the section each, and with the weight alone.
    std::unique_ptr<dealii::SparseDirectUMFPACK> solver;
    std::array<std::size_t, 2>                   held; ///< unknowns that stay 0 at the far end
    std::vector<double>                          shapes[3], sagged;

    AtSection                   section, on_section;
    std::vector<double>         displacement, velocity; ///< by unknown
    std::vector<double>         force, damping;         ///< as last found
    double                      damper_work = 0.;       ///< so far, J
    mutable std::vector<double> strains[3]; ///< of the elements: forces N, Q (N) and moments M (N m)
  };
} // namespace tread

#endif
