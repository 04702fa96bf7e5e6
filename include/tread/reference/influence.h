// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_influence_h
#define tread_reference_influence_h

#include <tread/reference/elastic.h>

#include <array>
#include <complex>
#include <memory>
#include <new>
#include <vector>

namespace tread::reference
{
  /// A regular grid of rectangular elements on the plane z = 0. Fields are vectors of n_x n_y entries, x
  /// fastest.
  struct Grid
  {
    unsigned int n_x     = 0;
    unsigned int n_y     = 0;
    double       dx      = 0.; ///< element edge in x [m]
    double       dy      = 0.; ///< element edge in y [m]
    double       x_first = 0.; ///< centre of element (0, 0) [m]
    double       y_first = 0.;

    std::size_t size() const
    {
      return static_cast<std::size_t>(n_x) * n_y;
    }
    double x(const unsigned int i) const
    {
      return x_first + i * dx;
    }
    double y(const unsigned int j) const
    {
      return y_first + j * dy;
    }
    double element_area() const
    {
      return dx * dy;
    }
  };

  /// A grid of elements dx by dy with element centres at x = 0 and y = 0 that covers |x| <= half_x, |y| <=
  /// half_y.
  Grid centred_grid(double half_x, double half_y, double dx, double dy);
  /// The same of square elements.
  Grid centred_grid(double half_x, double half_y, double element_size);

  /// Throws std::invalid_argument for an empty or impossible grid.
  void check_grid(const Grid &grid);

  /// Which displacement difference (wheel less rail) by which traction on the wheel.
  enum class Influence
  {
    zz, ///< normal by pressure:       (1 - nu)/(pi G) int 1/r
    xx, ///< u_x by p_x:               1/(pi G) int [(1 - nu)/r + nu x^2/r^3]
    xy, ///< u_x by p_y, u_y by p_x:   1/(pi G) int nu x y/r^3
    yy, ///< u_y by p_y:               1/(pi G) int [(1 - nu)/r + nu y^2/r^3]
    zx, ///< u_z by p_x:               K/(pi G) int x/r^2; u_x by pressure is minus this
    zy  ///< u_z by p_y:               K/(pi G) int y/r^2; u_y by pressure is minus this
  };

  /// Displacement at (x, y) of a unit traction on the rectangle |x'| <= dx/2, |y'| <= dy/2 of the surface of
  /// a half-space (Boussinesq 1885, Cerruti 1882; integrals in closed form, Kalker 1990, sect. 4.2) [m/Pa].
  double influence_coefficient(Influence          kind,
                               const ElasticPair &pair,
                               double             dx,
                               double             dy,
                               double             x,
                               double             y);

  /// Zero-padded Fourier transforms for one grid (FFTW). Not thread-safe: one object per thread; objects may
  /// be made in several threads at once.
  class FourierGrid
  {
  public:
    /// Memory aligned as FFTW's plans expect it.
    template <typename Number>
    struct Aligned
    {
      using value_type = Number;
      Aligned()        = default;
      template <typename Other>
      Aligned(const Aligned<Other> &)
      {
      }
      Number *allocate(const std::size_t n)
      {
        return static_cast<Number *>(::operator new(n * sizeof(Number), std::align_val_t(64)));
      }
      void deallocate(Number *pointer, const std::size_t)
      {
        ::operator delete(pointer, std::align_val_t(64));
      }
      bool operator==(const Aligned &) const
      {
        return true;
      }
    };
    using Spectrum = std::vector<std::complex<double>, Aligned<std::complex<double>>>;

    explicit FourierGrid(const Grid &grid);
    ~FourierGrid();
    FourierGrid(const FourierGrid &)            = delete;
    FourierGrid &operator=(const FourierGrid &) = delete;

    const Grid grid;

    unsigned int padded_x() const
    {
      return padded[0];
    }
    unsigned int padded_y() const
    {
      return padded[1];
    }

    /// Elements of the grid that carry values in transform() and back(); default: all.
    void select(const std::vector<unsigned int> &elements);

    std::size_t n_selected() const
    {
      return positions.size();
    }

    /// Spectrum of values on the selected elements.
    void transform(const double *values, Spectrum &spectrum) const;
    /// Values on the selected elements of a spectrum.
    void back(Spectrum &spectrum, double *values) const;

    /// Spectrum of the kernel sum_k weight_k C(x + offset_k, y) of influence coefficients, already divided by
    /// the number of padded elements, so that back(spectrum * transform(p)) is the convolution.
    Spectrum kernel(Influence                                 kind,
                    const ElasticPair                        &pair,
                    const std::vector<std::array<double, 2>> &weights_and_offsets) const;

    /// Replace a real, even spectrum by that of its factor F which moves values towards +x only: half of the
    /// logarithm's transform along x, exponentiated. Smaller values than `least` > 0 are raised to it.
    void factorise(Spectrum &spectrum, double least) const;

    std::size_t spectrum_size() const
    {
      return static_cast<std::size_t>(padded[0] / 2 + 1) * padded[1];
    }

  private:
    struct Plans;
    std::array<unsigned int, 2> padded;
    std::vector<unsigned int>   positions; // of the selected elements in the padded array
    const Plans                *plans;     // shared by all grids of this size
    /// The input and its rows' transforms stay zero outside the selected elements and below the grid, so the
    /// inverse needs its own.
    mutable std::vector<double, Aligned<double>> input, output;
    mutable Spectrum                             input_rows, output_rows;
    /// Of kernels: y ln(x + r), x ln(y + r) and r at the corners of elements in the quarter x, y > 0.
    mutable std::vector<std::array<double, 3>> quarter;
  };

  /// Normal displacement difference by pressure, as convolution.
  class NormalOperator
  {
  public:
    NormalOperator(const FourierGrid &fourier, const ElasticPair &pair);
    /// u_z [m] on the selected elements of pressures on them [Pa].
    void apply(const double *pressure, double *displacement) const;

    /// Displacement of an element by its own unit pressure [m/Pa].
    const double self_influence;

  private:
    const FourierGrid            &fourier;
    const FourierGrid::Spectrum   kernel;
    mutable FourierGrid::Spectrum work;
  };

  /// Tangential displacement differences by tangential tractions: a combination sum_k weight_k u(x +
  /// offset_k, y).
  class TangentialOperator
  {
  public:
    TangentialOperator(const FourierGrid                        &fourier,
                       const ElasticPair                        &pair,
                       const std::vector<std::array<double, 2>> &weights_and_offsets);
    /// Arrays of two blocks (x, then y), one entry per selected element.
    void apply(const double *traction, double *displacement) const;

  private:
    const FourierGrid            &fourier;
    const FourierGrid::Spectrum   xx, xy, yy;
    mutable FourierGrid::Spectrum work_x, work_y;
  };

  /// Approximate inverse of the tangential displacement (u_x by p_x, u_y by p_y; the other axis' share is
  /// left out) in two factors. The displacement is a product A = F B of a convolution F that only moves
  /// values towards +x and its mirror image B that only moves them towards -x (Wiener & Hopf 1931). Each
  /// factor restricted to a half-plane has the restricted inverse of the whole plane as its exact inverse,
  /// which A itself has not: so B^-1 (restrict) F^-1 knows of the edge at which a patch ends towards +x.
  class FactoredInverse
  {
  public:
    FactoredInverse(const FourierGrid &fourier, const ElasticPair &pair);
    /// F^-1 [Pa/m]^(1/2), in place: two blocks (x, then y), one entry per selected element.
    void apply_forward(double *values) const;
    /// B^-1, likewise.
    void apply_backward(double *values) const;

  private:
    void apply(double *values, bool forward) const;

    const FourierGrid                   &fourier;
    std::array<FourierGrid::Spectrum, 2> inverse; // of F
    mutable FourierGrid::Spectrum        work;
  };

  /// The coupling of normal and tangential problem for unlike bodies.
  class CouplingOperator
  {
  public:
    CouplingOperator(const FourierGrid                        &fourier,
                     const ElasticPair                        &pair,
                     const std::vector<std::array<double, 2>> &weights_and_offsets);
    /// u_x, u_y (two blocks) by pressure.
    void tangential_by_pressure(const double *pressure, double *displacement) const;
    /// u_z by tractions (two blocks).
    void normal_by_traction(const double *traction, double *displacement) const;

  private:
    const FourierGrid            &fourier;
    const FourierGrid::Spectrum   zx, zy;
    mutable FourierGrid::Spectrum work_x, work_y;
  };
} // namespace tread::reference

#endif
