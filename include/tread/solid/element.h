// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_element_h
#define tread_solid_element_h

#include <tread/base/reproducible_sum.h>
#include <tread/base/simd.h>
#include <tread/material/elastic.h>
#include <tread/mesh/mesh.h>
#include <tread/solid/hexahedron.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace tread
{
  struct ElementParameters
  {
    std::string element = "one-point"; ///< one of elements()
    /// Stiffness of the hourglass modes over that of pure bending of a box cell.
    double hourglass_coefficient = 1.;
    /// Whether the surface of contact has the tangential stiffness that belongs to its normal one (@see
    /// SurfaceWeights), in elements with hourglass modes; and the damping of the modes that this softens, in
    /// time steps.
    bool   matched_surface = true;
    double surface_damping = 0.5;
    /// Artificial bulk viscosity: linear (times c h rho) and quadratic (times rho h^2 in compression).
    double linear_bulk_viscosity = 0., quadratic_bulk_viscosity = 0.;

    bool has_bulk_viscosity() const
    {
      return linear_bulk_viscosity > 0. || quadratic_bulk_viscosity > 0.;
    }
  };

  /// All that the bodies have in common.
  struct SolidParameters : ElementParameters
  {
    /// Factor on the inertia of the cells (quasi-static scenes).
    double density_scale = 1.;
    /// Cells that would vibrate faster than this (rad/s) get as much mass as it takes that they do not; 0:
    /// none.
    double highest_frequency = 0.;
    /// Cells of level l are slow enough for time steps of 2^l times the smallest; 0: all in one level.
    unsigned int max_level = 0;
    /// Whether forces are rounded, so that their sums at the nodes do not depend on the order of the cells.
    bool reproducible = false;

    /// Of the forces that cells exert on their nodes, N: as fine as what positions in double precision leave
    /// of the forces of small cells (strains of 1e-13 in steel cells of a millimetre, 2e-8 N), and with room
    /// for 3e7 N at a node that has hanging nodes.
    Quantum force_quantum() const
    {
      return Quantum(reproducible ? 0x1p-26 : 0.);
    }
  };

  /// Elastic cells of one element, material and level of time steps, in the order in which their kernel takes
  /// them. The caller treats hanging nodes.
  class CellGroup
  {
  public:
    virtual ~CellGroup() = default;

    /// Add factor times the forces that the cells exert on their nodes (N) when these are at x (m) and, for
    /// bulk viscosity, move at v (m/s).
    virtual void add_forces(const Vector3 *x,
                            const Vector3 *v,
                            Vector3       *force,
                            const double   factor) const = 0;

    /// Add the energies stored at x, J, whose sums over the lanes count.
    virtual void add_energies(const Vector3          *x,
                              ReproducibleSum<Lanes> &strain,
                              ReproducibleSum<Lanes> &hourglass) const = 0;

    /// Set the Cauchy stress (xx, yy, zz, xy, yz, zx; Pa) at the centres of the cells at x, by cell of the
    /// mesh. @param wanted by cell: batches without any wanted cell are left out; empty: all cells.
    virtual void set_cauchy_stress(const Vector3                      *x,
                                   const std::vector<char>            &wanted,
                                   std::vector<std::array<double, 6>> &stress) const = 0;

    /// Bytes.
    virtual std::size_t memory_consumption() const = 0;
  };

  /// A finite element: how cells resist to deformation, and what time integration must know of them.
  ///
  /// A new element is a header and a source like those of fully_integrated, and its line in element.cc.
  class Element
  {
  public:
    virtual ~Element() = default;

    /// Upper bound of the highest angular frequency of one free cell, rad/s, with the nodal masses
    /// density_scale * density * node_volume. @param hourglass_factor on the stiffness of all hourglass
    /// modes.
    virtual double highest_frequency_bound(const HexahedronIntegrals &cell,
                                           const ElasticMaterial     &material,
                                           const double               hourglass_factor) const = 0;

    /// Approximate time that a cell with these corners (m) and its nodes take in a step, over that of a
    /// one-point parallelepiped: for a fair division among the ranks.
    virtual double relative_cost(const std::array<dealii::Point<3>, 8> &corners) const = 0;

    /// Put cells of the mesh, all of this material, into groups.
    virtual std::vector<std::unique_ptr<const CellGroup>> make_groups(
      const Mesh                      &mesh,
      const ElasticMaterial           &material,
      const std::vector<unsigned int> &cells) const = 0;
  };

  /// What a scene has to know of an element to offer it.
  struct ElementEntry
  {
    std::string name, description;
    /// Cells that yield are one-point cells; bulk viscosity is a pressure of cells with one strain.
    bool can_yield, has_bulk_viscosity;
    bool has_hourglass_modes; ///< which a coefficient stiffens
    /// Up to which it does not lock: beyond it cells are too stiff to keep their volume and bend.
    double largest_poisson_ratio;
    std::shared_ptr<const Element> (*make)(const SolidParameters &parameters);
  };

  /// All elements, the usual one first.
  const std::vector<ElementEntry> &elements();

  /// @throws std::invalid_argument if there is none of this name
  const ElementEntry &element_named(const std::string &name);
} // namespace tread

#endif
