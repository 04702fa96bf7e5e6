// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_stress_peaks_h
#define tread_analysis_stress_peaks_h

#include <tread/base/archive.h>
#include <tread/contact/contact.h>
#include <tread/dynamics/explicit_dynamics.h>

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
    double y_middle, half_width, depth;
    double finest_cell; ///< its thickness tells layers apart
    double reach;       ///< stresses are looked at while a wheel is this near to the region
    /// Place along the path of a point in the reference configuration, and its depth below the surface.
    std::function<double(const dealii::Point<3> &)> along, depth_of;
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
  /// surface, where no cell has its centre, in two ways:
  /// - all six stresses are extrapolated along a line through the centres of a surface cell and the one below
  ///   it;
  /// - by von_mises_at_face(), on the body whose surface nodes have the tractions (the slave).
  /// There the largest pressure and shear stress are recorded as well.
  ///
  /// Cells of higher levels of time steps, which lie below the finest ones, are looked at whenever all nodes
  /// are at the same instant.
  class StressPeaks
  {
  public:
    /// @param contact if the body is the slave, whose nodes have the tractions; otherwise null. Collective.
    StressPeaks(const ExplicitDynamics &dynamics,
                const Contact          *contact,
                const unsigned int      body,
                const ElasticMaterial  &material,
                const PeakRegion       &region);

    /// Whether a wheel at this place (m) is near enough to the region.
    bool concerns(const double wheel_x) const
    {
      return wheel_x >= region.x_begin - region.reach && wheel_x <= region.x_end + region.reach;
    }

    /// To be called after each step in which a wheel is near. @param states the nodes in contact.
    /// Collective.
    void sample(const ExplicitDynamics              &dynamics,
                const std::vector<ContactNodeState> &states,
                const double                         wheel_x);

    struct Layer
    {
      Peak   peak;
      double equivalent_strain; ///< elastic at the peak, stress over 3 mu, and the largest plastic at present
    };
    struct Answer
    {
      Layer              surface; ///< extrapolated; value 0 where the region has no cells
      Peak               from_tractions; ///< value 0 where steel at the surface can yield, and for the wheel
      Peak               pressure, shear;
      std::vector<Layer> layers; ///< downwards; depths are those of the centres of the cells
    };

    /// Of all ranks. Collective.
    Answer answer(const ExplicitDynamics &dynamics) const;

    /// Store or restore the peaks. Collective.
    void serialize(Archive &archive);

  private:
    struct Member
    {
      unsigned int cell, layer;
      double       x, y, depth; ///< of its centre
      bool         every_step;  ///< or at the end of the longest step only
    };
    /// A cell at the surface and the one below it, of which another rank may have the stress.
    struct Pair
    {
      unsigned int member;
      int          below; ///< member; -1: on another rank, which puts its stress into the slot
      unsigned int slot;
      double       share; ///< stress at the surface: upper one + share * (upper - lower)
      bool         every_step;
    };
    struct SurfaceFace
    {
      std::array<unsigned int, 4> nodes, surface_nodes; ///< of this rank; numbers in the contact's surfaces
      std::array<Vector3, 4>      reference;
      double                      x, y; ///< of its middle
    };
    enum Slot
    {
      extrapolated,
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

    void find_members(const ExplicitDynamics &dynamics, const unsigned int body);
    void find_pairs();
    void find_faces(const ExplicitDynamics &dynamics, const Contact &contact);
    void sample_layers(const Instant &instant);
    void extrapolate(const Instant &instant);
    void sample_surface(const std::vector<ContactNodeState> &states,
                        const double                         time_step,
                        const Instant                       &instant);
    /// The largest of all ranks, alike on all of them. Collective.
    std::vector<Peak> of_all_ranks() const;
    void              keep(const unsigned int slot, const Peak &peak);

    MPI_Comm                                           comm;
    PeakRegion                                         region;
    ElasticMaterial                                    material;
    std::vector<Member>                                members; ///< of this rank
    std::vector<Pair>                                  pairs;
    std::vector<std::pair<unsigned int, unsigned int>> sent;      ///< member of this rank, slot
    std::vector<std::array<double, 6>>                 exchanged; ///< by slot: stress, Pa
    std::vector<SurfaceFace>                           faces;
    std::vector<unsigned int>                          nodes;           ///< of the members
    std::vector<std::unique_ptr<const CellGroup>>      groups;          ///< the elastic members
    std::vector<char>                                  plastic_members; ///< by cell of the mesh; empty: none
    NodalField                                         x;               ///< by node; those of members are set
    std::vector<std::array<double, 6>>                 stress; ///< by cell; those of members are set, Pa
    std::vector<Vector3> traction;                             ///< by surface node, Pa: normal, along, across
    std::vector<Peak>    peaks;                                ///< by Slot
  };
} // namespace tread

#endif
