// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_elastic_system_h
#define tread_analysis_elastic_system_h

#include <tread/mesh/mesh.h>
#include <tread/solid/element.h>
#include <tread/track/supports.h>
#include <tread/track/wheel_hub.h>

#include <petscmat.h>

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace tread
{
  /// Some bodies of a mesh with what carries them, for small vibrations about the undeformed state at rest:
  /// M u'' + C u' + K u = f as distributed sparse matrices.
  ///
  /// The model is that of the explicit run. The stiffness of a cell is the derivative of the forces that its
  /// element exerts, one-point cells with their hourglass stiffness included, by central differences about
  /// the reference position. The rigid motions of the cell, which the forces of an undeformed cell do not
  /// feel, are then taken out of the rounding errors. Masses are the lumped ones, with the true density
  /// whatever the scene scales. Hanging nodes are condensed, held nodes left out, and the nodes on a hub
  /// follow its motion; all cells are elastic, those of plastic zones too. There is no prestress, no rotation
  /// and no contact.
  ///
  /// Unknowns are numbered by rank; those of hub and rigid sleepers come last and belong to the last rank.
  class ElasticSystem
  {
  public:
    /// @param with_body by number: whether it takes part; @param materials one for each body of the mesh.
    ElasticSystem(const Mesh                         &mesh,
                  const std::vector<char>            &with_body,
                  const std::vector<ElasticMaterial> &materials,
                  const SolidParameters              &parameters);
    ~ElasticSystem();
    ElasticSystem(const ElasticSystem &)            = delete;
    ElasticSystem &operator=(const ElasticSystem &) = delete;

    // What holds the bodies: all before assemble(). The nodes are of this rank.

    void fix_nodes(const std::vector<unsigned int> &nodes);
    void guide_nodes(const std::vector<unsigned int> &nodes, const unsigned int direction);

    /// What a hub may do besides moving up and down.
    struct HubFreedom
    {
      bool moves_along = false, turns = false;
      bool is_suspended = true; ///< under the primary suspension, with the sprung mass
    };

    /// The support nodes of a body are carried by a rigid hub, which has been placed. It keeps its lateral
    /// position, as in a run. @throws std::invalid_argument if the hub is too light.
    void attach_hub(WheelHub hub, const unsigned int body, const HubFreedom &freedom);

    void attach_supports(const Supports &supports);

    /// Damping of the nodes of a body in proportion to their mass (1/s): absorbing ends.
    void damp_nodes(const unsigned int body, const std::function<double(const dealii::Point<3> &)> &rate);

    /// Make the matrices. Collective.
    void assemble();

    Mat stiffness() const ///< N/m
    {
      return K;
    }
    Mat mass() const ///< kg
    {
      return M;
    }
    Mat damping() const ///< N s/m
    {
      return C;
    }
    std::uint64_t n_unknowns() const
    {
      return n_global;
    }

    /// Mass (kg) of the nodes that move on their own: 0 for held, carried and hanging nodes and on bodies
    /// that do not take part.
    const std::vector<double> &masses() const
    {
      return node_masses;
    }

    /// Displacements of hub (along, up, turn; m, rad), sprung mass and rigid sleepers (m, upwards).
    struct RigidParts
    {
      double              along = 0., up = 0., turn = 0., sprung = 0.;
      std::vector<double> sleepers;
    };
    /// Nodal displacements of a vector of unknowns, with hanging and carried nodes. Collective.
    NodalField displacements(const Vec vector, RigidParts &parts) const;

    /// Twice the kinetic energy of the rigid parts when they move so fast, by: hub, sprung mass, sleepers.
    std::array<double, 3> rigid_inertia(const RigidParts &velocities) const;

    /// Shares of nodes of this rank in the vertical displacement of a place, or in a force on it.
    using Place = std::vector<std::pair<unsigned int, double>>;

    /// A vector of the unknowns' size, 0. To be destroyed by the caller.
    Vec new_vector() const;
    /// Unit force, upwards, on a place. Collective.
    Vec force_on(const Place &place) const;
    /// Unit tension in a support's layer, shared by its dampers. One vector for each support and layer.
    /// Collective.
    std::vector<Vec> damper_forces() const;

    /// Make a vector M-orthogonal to all of a basis that is so, and of unit modal mass. @returns false if
    /// nothing but rounding remains. Collective.
    bool normalise_against(const std::vector<Vec> &basis, Vec vector) const;

    /// Vertical displacement of a place. Collective.
    double displacement_of(const Place &place, const NodalField &field) const;

    const Mesh &mesh;

  private:
    struct Term
    {
      long long unknown;
      double    weight;
    };
    using LinearForm = std::vector<Term>;
    struct Link ///< of all ranks: its elongation
    {
      LinearForm                   form;
      double                       stiffness, damping;
      std::pair<unsigned int, int> layer; ///< of a support
    };

    void number_unknowns();
    /// A node's displacement in a direction by the unknowns.
    void expand(const unsigned int node,
                const unsigned int direction,
                const double       weight,
                LinearForm        &form) const;
    void gather_links();
    void add_cells(Mat matrix) const;
    void add_links(Mat stiffness, Mat damping) const;
    void add_inertia(Mat mass, Mat damping) const;
    template <typename Fill>
    Mat make_matrix(const Fill &fill) const;

    static constexpr long long none = -1;

    std::vector<char>                     with_body;
    const std::vector<ElasticMaterial>    materials;
    SolidParameters                       parameters;
    std::vector<double>                   node_masses, node_damping; ///< kg, 1/s
    std::vector<std::array<char, 3>>      held;
    std::vector<char>                     carried;
    std::vector<int>                      hanging; ///< number in the mesh's list, -1: none
    std::vector<std::array<long long, 3>> unknowns;
    long long                             first_own = 0, n_own = 0, n_global = 0;

    struct Hub
    {
      bool               is_there = false;
      HubFreedom         freedom;
      WheelHubParameters parameters;
      double             x = 0., z = 0.;                                      ///< of the axle, m
      double             first_moment_x = 0., first_moment_z = 0.;            ///< of the rest, kg m
      long long          along = none, up = none, turn = none, sprung = none; ///< unknowns
    } hub;
    const Supports   *supports      = nullptr;
    long long         first_sleeper = none;
    std::vector<Link> links;

    Mat K = nullptr, M = nullptr, C = nullptr;
  };
} // namespace tread

#endif
