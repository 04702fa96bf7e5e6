// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_stress_recovery_h
#define tread_analysis_stress_recovery_h

#include <tread/contact/contact.h>
#include <tread/dynamics/explicit_dynamics.h>

#include <array>
#include <functional>
#include <vector>

namespace tread
{
  /// The nodes of a body at and below which stresses are recovered, in the reference configuration.
  struct RecoveryExtent
  {
    unsigned int body;
    /// Depth below the surface, m. Only its differences count for cells; any function that grows inwards will
    /// do where nobody asks for depths.
    std::function<double(const dealii::Point<3> &)> depth_of;
    std::function<bool(const dealii::Point<3> &)>   contains;
    bool only_surface = false; ///< whether stresses are recovered at the surface alone
  };

  /// Stresses at the surface of a body and below it, of second order in the size of the cells: the one
  /// recovery of all tables and pictures.
  ///
  /// A cell with one point of integration knows its stress at its centre, half a cell below the surface.
  /// There the stress is too large by the square of the cell's size over eight times the second derivatives
  /// along the surface, because equilibrium holds at the nodes, for the mean of the cells around them. Hence
  /// - **below the surface** stress is recovered in the middle of each edge that goes into depth, as the mean
  /// of
  ///   the cells around this edge. The error and the alternation beside larger cells cancel in it.
  /// - **at the surface** stress is recovered at the nodes. The stress across the surface is the traction
  /// that
  ///   the contact exerts, 0 outside the patch. The stress along the surface follows by Hooke's law from this
  ///   traction and from the stretch of the faces around the node. Nothing is extrapolated.
  /// - **In the uppermost layer** the mean of the cells still contains an error: it balances the traction
  /// with
  ///   the stress along the surface at half the height of the layer instead of the mean of this stress above
  ///   it. Half the square of the depth times the second derivative over depth is therefore subtracted. The
  ///   derivative is that of the parabola through the stress of the surface, that of the edge and that of the
  ///   edge below.
  ///
  /// Hooke's law does not apply to steel that has yielded. Around a node where a cell has yielded, the stress
  /// along the surface is extrapolated from the edge below the node and the next one, with the tractions as
  /// they are. It is then reduced towards equal stress in all directions until the equivalent stress is one
  /// that the yield condition of the cells around the node allows.
  class StressRecovery
  {
  public:
    using Stress = std::array<double, 6>; ///< xx, yy, zz, xy, yz, zx; Pa

    /// @param surfaces give the nodes the numbers by which forces on them are known; null: none. Collective.
    StressRecovery(const Mesh            &mesh,
                   const Solid           &solid,
                   const ContactSurfaces *surfaces,
                   const ElasticMaterial &material,
                   const RecoveryExtent  &extent);

    /// A place at which stress is recovered.
    struct Site
    {
      unsigned int     node;  ///< at the surface, or at the upper end of the edge
      dealii::Point<3> place; ///< in the reference configuration
      double           depth; ///< m
      bool every_step;        ///< whether its cells make the smallest time steps; else they may lag behind
      bool wanted;            ///< of this rank, and in the extent; others only help
    };
    /// Nodes of the surface, and edges below it.
    const std::vector<Site> &at_surface() const
    {
      return surface_sites;
    }
    const std::vector<Site> &below_surface() const
    {
      return edge_sites;
    }

    /// Cells of this rank whose stress is needed, and all nodes of these and of the faces.
    const std::vector<unsigned int> &cells() const
    {
      return needed_cells;
    }
    const std::vector<unsigned int> &nodes() const
    {
      return needed_nodes;
    }

    /// Recover. Collective.
    /// @param x positions by node (m); @param stress by cell of the mesh; @param yield_limits see
    /// PlasticCells::yield_limits(), empty where no cell can yield; @param impulses on surface nodes, see
    /// Contact::surface_impulses(), N s, of a step that takes time_step s; empty: none act
    void recover(const Vector3              *x,
                 const std::vector<Stress>  &stress,
                 const std::vector<double>  &yield_limits,
                 const std::vector<Vector3> &impulses,
                 const double                time_step);

    /// The same at present.
    void recover(const ExplicitDynamics &dynamics, const Contact *contact);

    /// In the order of at_surface() and below_surface().
    const std::vector<Stress> &stress_at_surface() const
    {
      return surface_stress;
    }
    const std::vector<Stress> &stress_below_surface() const
    {
      return edge_stress;
    }

  private:
    static constexpr int none = -1;

    struct Cell
    {
      unsigned int       number;
      std::array<int, 4> edges; ///< sites of the edges into depth, or none
    };
    struct Face
    {
      std::array<unsigned int, 4> nodes;
      std::array<int, 4>          sites;
      double                      length, b1, b2; ///< of its middle lines: A along the first axis, B
      unsigned int                cell;
    };
    struct SurfaceNode
    {
      int    contact_node;  ///< its number in the contact's surfaces, or none
      int    below, deeper; ///< sites of the edge below it and of the next one, or none
      double depth, deeper_depth;
      double n_faces;
    };

    void number_sites(const Mesh &mesh, const Solid &solid, const RecoveryExtent &extent);
    void find_faces(const Mesh &mesh, const ContactSurfaces *surfaces, const RecoveryExtent &extent);
    void mean_of_cells(const std::vector<Stress> &stress);
    void stretch_of_faces(const Vector3 *x, const std::vector<double> &yield_limits);
    /// Complete the sums of nodes that several ranks share. Collective.
    void sum_over_ranks(const std::vector<Site> &sites, std::vector<Stress> &values);
    /// Stress along the surface of a node where steel has yielded, from below.
    Stress of_yielded(const SurfaceNode &node,
                      const Vector3      normal,
                      const Vector3      traction,
                      const double       limit) const;

    const SharedNodes        *shared_nodes;
    bool                      on_several_ranks;
    bool                      can_yield; ///< any cell of any rank
    double                    lame, shear_modulus;
    std::vector<Site>         surface_sites, edge_sites;
    std::vector<SurfaceNode>  surface_nodes; ///< by surface site
    std::vector<double>       cells_around;  ///< by edge site
    std::vector<Cell>         own_cells;
    std::vector<Face>         faces;
    std::vector<unsigned int> needed_cells, needed_nodes;
    std::vector<Stress>       surface_stress, edge_stress;
    std::vector<Stress>       area_and_limit; ///< by surface site: area vector, sum of limits, their number
    NodalField                field;          ///< by node, for what goes from rank to rank
  };
  /// A body whose surface may be in contact.
  struct RecoveredBody
  {
    unsigned int                                    body;
    ElasticMaterial                                 material;
    std::function<double(const dealii::Point<3> &)> depth_of; ///< or what grows as the depth does
  };

  /// Stresses at the nodes of all bodies: at surfaces that may be in contact those of StressRecovery, inside
  /// the means of the cells around, which are those of the edges above and below.
  class NodalStresses
  {
  public:
    /// Collective.
    NodalStresses(const ExplicitDynamics           &dynamics,
                  const Contact                    *contact,
                  const std::vector<RecoveredBody> &bodies);

    /// By node of the mesh, at present; nodes must be synchronised. Collective.
    std::vector<StressRecovery::Stress> at_present();

  private:
    const ExplicitDynamics     &dynamics;
    const Contact              *contact;
    std::vector<StressRecovery> surfaces;
    std::vector<double>         cells_around; ///< by node
  };
} // namespace tread

#endif
