// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_rail_stress_h
#define tread_analysis_rail_stress_h

#include <tread/analysis/stress_recovery.h>
#include <tread/base/archive.h>
#include <tread/dynamics/explicit_dynamics.h>

#include <functional>
#include <vector>

namespace tread
{
  /// Which cells of a body lie under the path of the wheel. Lengths in m.
  struct StripExtent
  {
    double x_begin, x_end, y_middle, half_width, depth;
    /// Depth below the surface of a point in the reference configuration.
    std::function<double(const dealii::Point<3> &)> depth_of;
  };

  /// The largest von Mises stress that a cell has experienced, with its time (s) and the position x of the
  /// wheel (m) at that time.
  struct StressPeak
  {
    double stress = 0., time = 0., wheel_x = 0.; // Pa, s, m
  };

  /// Maxima over the cells between two cross-sections of the strip, SI units.
  struct StripColumn
  {
    double     x;                      ///< middle of the column in the reference configuration
    StressPeak largest, at_surface;    ///< of the centres of all its cells, and of the nodes at the surface
    double     y, depth, y_at_surface; ///< where these are
    double     equivalent_plastic_strain; ///< present maximum
  };

  /// Records the largest von Mises stress at the instants sampled for the centres of the cells of a rail
  /// under the path of the wheel, and for the nodes of its surface above them (StressRecovery).
  class StressStrip
  {
  public:
    /// @param surfaces number the nodes on which the contact acts; null: none does. Collective.
    StressStrip(const Mesh            &mesh,
                const Solid           &solid,
                const ContactSurfaces *surfaces,
                const unsigned int     body,
                const ElasticMaterial &material,
                const StripExtent     &extent);

    /// Only cells of the strip are evaluated. Nodes must be synchronised. @param impulses on the nodes of
    /// all surfaces in the last step, N s. Collective.
    void sample(const ExplicitDynamics &dynamics, const std::vector<Vector3> &impulses, const double wheel_x);

    /// One column for each surface cell along the path, beginning at the rear; on rank 0. Collective.
    std::vector<StripColumn> columns(const ExplicitDynamics &dynamics) const;

    /// Keep what cells of another mesh of the same body felt, besides what this one's will. Collective.
    void take_over(const StressStrip &before);

    /// Store or restore the maxima. Collective.
    void serialize(Archive &archive);

  private:
    /// Of a cell: from and to which x it lies, y, depth, whether at the surface, largest stress, its time,
    /// the wheel's x then, present plastic strain; of a node at the surface x, y, and the same of its stress.
    using CellRow = std::array<double, 9>;
    using NodeRow = std::array<double, 5>;
    std::vector<CellRow> cell_rows(const std::vector<double> &plastic_strain) const; ///< of this rank
    std::vector<NodeRow> node_rows() const;                                          ///< of this rank

    struct Member
    {
      unsigned int cell;
      Archive::Key key; ///< body and centre in the reference position, nm
      double       x_begin, x_end, y, depth;
      bool         at_surface;
      StressPeak   peak;
    };
    struct SurfaceMember
    {
      unsigned int site; ///< of the recovery
      Archive::Key key;
      double       x, y;
      StressPeak   peak;
    };

    MPI_Comm                   comm;
    StressRecovery             recovery;
    std::vector<Member>        members;      ///< cells of this rank
    std::vector<SurfaceMember> surface;      ///< nodes of this rank
    std::vector<char>          wanted;       ///< by cell of the mesh
    std::vector<CellRow>       cells_before; ///< of other meshes and all ranks, the largest of each column
    std::vector<NodeRow>       nodes_before;
  };

  /// Stress and plastic strain of a cell at one instant.
  struct CellRecord
  {
    double von_mises, equivalent_plastic_strain; // Pa, share
  };

  /// Cells of a body at selected positions, known to all ranks.
  class CellProbes
  {
  public:
    /// @param points in the reference configuration, m. @throws std::out_of_range with the number of the
    /// first point that lies outside the body, on all ranks. Collective.
    CellProbes(const Mesh &mesh, const unsigned int body, const std::vector<dealii::Point<3>> &points);

    /// One record for each point. Nodes must be synchronised. Collective.
    std::vector<CellRecord> record(const ExplicitDynamics &dynamics) const;

    const std::vector<dealii::Point<3>> &centres() const
    {
      return centres_of_cells;
    }

  private:
    static constexpr unsigned int elsewhere = -1;

    MPI_Comm                      comm;
    std::vector<unsigned int>     cells; ///< by point; elsewhere: on another rank
    std::vector<dealii::Point<3>> centres_of_cells;
    std::vector<char>             wanted;
  };
} // namespace tread

#endif
