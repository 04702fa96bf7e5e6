// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_stress_peaks_h
#define tread_analysis_stress_peaks_h

#include <tread/analysis/stress_recovery.h>
#include <tread/base/archive.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace tread
{
  /// The part of a body in which the largest stresses are looked for. Lengths in m.
  struct PeakRegion
  {
    double x_begin, x_end; ///< along the path
    double half_width, depth;
    double finest_cell; ///< its thickness tells layers apart
    double reach;       ///< stresses are looked at while a wheel is this near to the region
    /// Place along the path of a point in the reference configuration, how far it is beside the path, and its
    /// depth below the surface.
    std::function<double(const dealii::Point<3> &)> along, beside, depth_of;
  };

  /// The largest value of a quantity over a region and over all time, SI units.
  struct Peak
  {
    double value = 0., x = 0., y = 0., depth = 0., time = 0.;
    double wheel_x = 0.; ///< where the wheel that caused it was

    bool operator<(const Peak &other) const;
  };

  /// Stress of von Mises (Pa) at the middle of a face of the surface, from its stretch and from the tractions
  /// on it: nothing is extrapolated. Logarithmic strains in the plane of the face follow from the positions
  /// of its nodes, around it; stresses from Hooke's law with the pressure as the stress across the face
  /// and the shear stress given.
  /// @param reference, current positions of the nodes, m; @param pressure, shear Pa
  double von_mises_at_face(const std::array<Vector3, 4> &reference,
                           const std::array<Vector3, 4> &current,
                           const ElasticMaterial        &material,
                           const double                  pressure,
                           const double                  shear);

  /// Records in every step the largest von Mises stress in each layer of cells of a region, and at the
  /// surface, as StressRecovery finds them: at the nodes of the surface, and in the layers of finest cells in
  /// the middle of edges. Cells of the larger ones below them have the stress of their centres. Beside that,
  /// on the body whose surface nodes carry the unknown tractions (the slave), von_mises_at_face() and the
  /// largest pressure and shear stress.
  ///
  /// What rests on cells of higher levels of time steps, which lie below the finest ones, is looked at
  /// whenever all nodes are at the same instant.
  class StressPeaks
  {
  public:
    /// @param contact exerts the tractions; null: none. @param is_slave whether the body's nodes have the
    /// tractions of which active_nodes() tells. Collective.
    StressPeaks(const ExplicitDynamics &dynamics,
                const Contact          *contact,
                const bool              is_slave,
                const unsigned int      body,
                const ElasticMaterial  &material,
                const PeakRegion       &region);

    /// Whether a wheel at this place (m) is near enough to the region.
    bool concerns(const double wheel_x) const
    {
      return wheel_x >= region.x_begin - region.reach && wheel_x <= region.x_end + region.reach;
    }

    /// To be called after each step in which a wheel is near. @param states the nodes in contact, for the
    /// slave. @param impulses on the nodes of all surfaces, N s. Collective.
    void sample(const ExplicitDynamics              &dynamics,
                const std::vector<ContactNodeState> &states,
                const std::vector<Vector3>          &impulses,
                const double                         wheel_x);

    struct Layer
    {
      Peak   peak;
      double equivalent_strain; ///< elastic at the peak, stress over 3 mu, and the largest plastic at present
    };
    struct Answer
    {
      Layer              surface;        ///< value 0 where the region has no surface
      Peak               from_tractions; ///< value 0 where steel at the surface can yield, and for the wheel
      Peak               pressure, shear;
      std::vector<Layer> layers; ///< downwards; depths are half the heights of the layers
    };

    /// Of all ranks. Collective.
    Answer answer(const ExplicitDynamics &dynamics) const;

    /// Store or restore the peaks. Collective.
    void serialize(Archive &archive);

  private:
    struct Member
    {
      unsigned int cell, layer;
    };
    /// A place at which stress is known.
    struct Place
    {
      unsigned int site, slot; ///< of the recovery, or the cell; where its largest value is kept
      double       x, y, depth;
      bool         every_step; ///< or at the end of the longest step only
    };
    struct SurfaceFace
    {
      std::array<unsigned int, 4> nodes, surface_nodes; ///< of this rank; numbers in the contact's surfaces
      std::array<Vector3, 4>      reference;
      double                      x, y; ///< of its middle
    };
    enum Slot
    {
      surface,
      from_tractions,
      pressure,
      shear,
      first_layer
    };

    struct Instant
    {
      double time, wheel_x;
      bool   all; ///< whether all nodes are at this instant
    };

    bool contains(const dealii::Point<3> &p) const;
    void find_members(const ExplicitDynamics &dynamics, const unsigned int body);
    void find_places(const Mesh &mesh);
    void find_faces(const ExplicitDynamics &dynamics, const Contact &contact);
    void sample_places(const std::vector<Place>                  &places,
                       const std::vector<StressRecovery::Stress> &stresses,
                       const Instant                             &instant);
    void sample_surface(const std::vector<ContactNodeState> &states,
                        const double                         time_step,
                        const Instant                       &instant);
    /// The largest of all ranks, alike on all of them. Collective.
    std::vector<Peak> of_all_ranks() const;
    void              keep(const unsigned int slot, const Peak &peak);

    MPI_Comm                                      comm;
    PeakRegion                                    region;
    ElasticMaterial                               material;
    StressRecovery                                recovery;
    std::vector<Member>                           members; ///< of this rank
    std::vector<Place>                            at_surface, below_surface, centres;
    std::vector<SurfaceFace>                      faces;
    std::vector<unsigned int>                     nodes;           ///< whose positions are needed
    std::vector<std::unique_ptr<const CellGroup>> groups;          ///< the elastic cells
    std::vector<char>                             plastic_members; ///< by cell of the mesh; empty: none
    NodalField                                    x;        ///< by node; those of cells and faces are set
    std::vector<StressRecovery::Stress>           stress;   ///< by cell; those needed are set, Pa
    std::vector<Vector3>                          traction; ///< by surface node, Pa: normal, along, across
    std::vector<Peak>                             peaks;    ///< by Slot
  };
} // namespace tread

#endif
