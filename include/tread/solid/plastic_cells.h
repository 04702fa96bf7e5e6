// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_plastic_cells_h
#define tread_solid_plastic_cells_h

#include <tread/base/archive.h>
#include <tread/base/simd.h>
#include <tread/material/plastic.h>
#include <tread/mesh/mesh.h>
#include <tread/solid/one_point_batch.h>
#include <tread/solid/plastic_zone.h>
#include <tread/solid/surface_layer.h>

namespace tread
{
  /// History of the cells of all plastic zones of a rank. It is part of the state of a run, like the
  /// positions.
  struct PlasticHistory
  {
    AlignedVector<Lanes> values;
  };

  /// History of one cell with a key that does not depend on the ranks: for checkpoints.
  struct CellHistory
  {
    std::array<long long, 4> key; ///< body and centre in the reference position, nm
    std::array<double, 19 + 6 * PlasticMaterial::max_backstresses> values;
  };

  /// One-point hexahedra that yield: the part of a Solid that remembers. Elastic cells are not here.
  ///
  /// History of a cell: the inverse G of its plastic right Cauchy-Green tensor (6), the equivalent plastic
  /// strain, the plastic part of its hourglass amplitudes (12), its backstresses (6 each). All of it refers
  /// to the reference configuration, so that rotation leaves it alone.
  class PlasticCells
  {
  public:
    PlasticCells() = default;

    /// Where the parts of a cell's history begin that follow G, and how many values the second one has.
    static constexpr unsigned int strain_at = 6, hourglass_at = 7, n_hourglass = 12, backstress_at = 19;

    /// Time of a cell that may yield, as Element::relative_cost counts it: 1.5 to 2.1 times an elastic one
    /// (plastic_benchmark).
    static constexpr double relative_cost = 2.;

    /// @param materials @see Solid. @param zones if a cell lies in several zones of a body, the last
    /// one applies. @param force_quantum of what is added to the forces of nodes, N.
    PlasticCells(const Mesh                         &mesh,
                 const std::vector<ElasticMaterial> &materials,
                 const std::vector<PlasticZone>     &zones,
                 const double                        hourglass_coefficient,
                 const Quantum                       force_quantum = Quantum(),
                 const SurfaceLayer                 &surface       = {});

    bool contains(const unsigned int cell) const
    {
      return !zone_of_cell.empty() && zone_of_cell[cell] >= 0;
    }

    bool empty() const
    {
      return batches.empty();
    }

    PlasticHistory virgin_history() const;

    /// Reset the cells of a body to the state of never having been loaded.
    void forget(const unsigned int body, PlasticHistory &history) const;

    /// Add the forces (N) that the cells exert when their nodes move to x (m) from the state of the last
    /// update of the history. The history remains unchanged.
    void add_forces(const Vector3 *x, Vector3 *force, const PlasticHistory &history) const;

    /// The same with an update of the history. @returns the plastic work done in it on this rank, J.
    ReproducibleSum<double> update(const Vector3 *x, Vector3 *force, PlasticHistory &history) const;

    /// Elastic energies of deformation and of the hourglass modes at x, J.
    std::array<ReproducibleSum<double>, 2> energies(const Vector3 *x, const PlasticHistory &history) const;

    /// Write the Cauchy stress (xx, yy, zz, xy, yz, zx; Pa) of the cells at x into a list of all cells.
    /// @param wanted by cell: batches without any wanted cell are omitted; empty: all cells.
    void cauchy_stress(const Vector3                      *x,
                       const PlasticHistory               &history,
                       std::vector<std::array<double, 6>> &stress,
                       const std::vector<char>            &wanted) const;

    /// Equivalent plastic strain by cell of the mesh, 0 outside the zones.
    std::vector<double> equivalent_plastic_strain(const PlasticHistory &history) const;

    /// The history with the net plastic strain -1/2 ln G (Hencky; reference configuration) in the place of G:
    /// in this form histories can be added and multiplied by a number.
    PlasticHistory with_logarithms(const PlasticHistory &history) const;

    /// Back from that form. Backstresses stay within what they saturate at.
    PlasticHistory from_logarithms(const PlasticHistory &logarithmic) const;

    /// The history with the elastic strain (Hencky; in space) of cells whose nodes are at x in the place of
    /// G, and the elastic part of the hourglass amplitudes (m) in the place of the plastic one: in this form
    /// it says what stresses there are, whatever the shape.
    PlasticHistory with_stresses(const Vector3 *x, const PlasticHistory &history) const;

    /// Back from that form, of cells whose nodes are at x.
    PlasticHistory from_stresses(const Vector3 *x, const PlasticHistory &stressed) const;

    /// Add a multiple of the values begin to end (not included) of each cell's history.
    void add(PlasticHistory       &history,
             const double          factor,
             const PlasticHistory &other,
             const unsigned int    begin,
             const unsigned int    end) const;

    /// Set those values to the other history's.
    void copy(PlasticHistory       &history,
              const PlasticHistory &other,
              const unsigned int    begin,
              const unsigned int    end) const;

    /// Histories of cells whose equivalent plastic strain grows in `flow`, and of all others.
    PlasticHistory where_flowing(const PlasticHistory &flow,
                                 const PlasticHistory &there,
                                 const PlasticHistory &elsewhere) const;

    /// Sum of the products of the values begin to end (not included) of two histories, by cell of the mesh.
    std::vector<double> products(const PlasticHistory &a,
                                 const PlasticHistory &b,
                                 const unsigned int    begin,
                                 const unsigned int    end) const;

    /// Equivalent sqrt(2/3 e:e) of the net plastic strain by cell of the mesh, 0 outside the zones.
    /// @param logarithmic history with_logarithms(), or a sum of such
    std::vector<double> net_plastic_strain(const PlasticHistory &logarithmic) const;

    /// Largest equivalent stress of von Mises, Pa, that the yield condition allows in a cell that has
    /// yielded, by cell of the mesh: the yield stress at its plastic strain and the equivalents of its
    /// backstresses. 0 where no cell has yielded. Empty without zones.
    std::vector<double> yield_limits(const PlasticHistory &history) const;

    /// @param centre in the reference configuration, m. @returns body and centre, nm
    static std::array<long long, 4> key_of(const unsigned int body, const dealii::Point<3> &centre);

    /// Save and restore the histories of this rank's cells by key. Cells that are not in the list keep
    /// theirs.
    /// @returns how many were found.
    std::vector<CellHistory> stored(const PlasticHistory &history) const;
    std::size_t              restore(const std::vector<CellHistory> &list, PlasticHistory &history) const;

    /// Store or restore the history of the cells of all ranks.
    void serialize(Archive &archive, PlasticHistory &history) const;

    /// Memory of this rank's cells including their history, bytes.
    std::size_t memory_consumption() const;

    std::size_t n_cells() const
    {
      return keys.size();
    }

  private:
    using Batch = OnePointBatch<false>;
    struct Range ///< the cells of one zone: those of the uppermost layer, or all others
    {
      std::size_t     begin, end; ///< batches
      std::size_t     history;    ///< where that of the first batch begins
      ElasticMaterial elastic;
      PlasticMaterial plastic;
      unsigned int    body;
      bool            is_surface;
      std::size_t     surface; ///< where the modes of the first batch are if it is

      const SurfaceModes *modes_of(const AlignedVector<SurfaceModes> &all, const std::size_t batch) const
      {
        return is_surface ? &all[surface + (batch - begin)] : nullptr;
      }

      /// Number of lanes of history per batch.
      std::size_t stride() const
      {
        return 19 + 6 * plastic.backstresses.size();
      }
    };
    template <unsigned int n>
    struct State;

    /// Call work(range, batch, first) for each batch, whose values in a history begin at first.
    template <typename Work>
    void for_batches(const Work &work) const;

    /// The history with function(eigenvalue) in the place of the eigenvalues of its first six values.
    template <typename Function>
    PlasticHistory of_eigenvalues(const PlasticHistory &history, const Function &function) const;

    template <unsigned int n, bool updates, typename History>
    ReproducibleSum<double> add_forces(const Range   &range,
                                       const Vector3 *x,
                                       Vector3       *force,
                                       History       &history) const;

    /// Call work(range, n) for each range, with the number n of its backstresses as a constant.
    template <typename Work>
    void for_ranges(const Work &work) const;

    /// Call work(range, batch, lane, cell) for each cell.
    template <typename Work>
    void for_cells(const Work &work) const;

    std::vector<int>                      zone_of_cell; ///< -1: none
    AlignedVector<Batch>                  batches;
    AlignedVector<SurfaceModes>           modes;        ///< of the batches of surface ranges
    std::vector<std::array<int, n_lanes>> cell_of_lane; ///< -1: padded
    std::vector<std::array<long long, 4>> keys;         ///< of the cells, in the order of for_cells()
    std::vector<Range>                    ranges;
    Quantum                               force_quantum;
  };


  template <typename Work>
  void PlasticCells::for_batches(const Work &work) const
  {
    for (const Range &range : ranges)
      for (std::size_t b = range.begin; b < range.end; ++b)
        work(range, b, range.history + (b - range.begin) * range.stride());
  }


  template <typename Work>
  void PlasticCells::for_cells(const Work &work) const
  {
    std::size_t number = 0;
    for_batches([&](const Range &range, const std::size_t b, const std::size_t first) {
      for (unsigned int l = 0; l < n_lanes; ++l)
        if (cell_of_lane[b][l] >= 0)
          work(range, first, l, cell_of_lane[b][l], number++);
    });
  }
} // namespace tread

#endif
