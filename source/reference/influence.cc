// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/influence.h>

#include "require.h"
#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <numeric>

namespace tread::reference
{
  namespace
  {
    // Y ln(X + R) up to terms that drop out of the corner sum: Y asinh(X/|Y|).
    double y_log(const double x, const double y)
    {
      return y == 0. ? 0. : y * std::asinh(x / std::abs(y));
    }

    /// What the primitives of 1/r, x^2/r^3, y^2/r^3 and x y/r^3 consist of, at a corner of an element.
    struct Corner
    {
      double y_log_x, x_log_y; ///< y ln(x + r), x ln(y + r), odd in x and in y
      double distance;         ///< r, even
    };

    Corner corner_at(const double x, const double y)
    {
      return {y_log(x, y), y_log(y, x), std::hypot(x, y)};
    }

    bool is_of_like_bodies(const Influence kind)
    {
      return kind != Influence::zx && kind != Influence::zy;
    }

    double primitive(const Influence kind, const double nu, const Corner &c)
    {
      switch (kind)
        {
        case Influence::zz:
          return (1. - nu) * (c.y_log_x + c.x_log_y);
        case Influence::xx: // 1/r = x^2/r^3 + y^2/r^3
          return c.y_log_x + (1. - nu) * c.x_log_y;
        case Influence::yy:
          return (1. - nu) * c.y_log_x + c.x_log_y;
        default:
          return -nu * c.distance;
        }
    }

    // Primitive F with d^2F/dxdy = kernel, to be summed over the corners with alternating signs.
    double primitive(const Influence kind, const ElasticPair &pair, const double x, const double y)
    {
      if (is_of_like_bodies(kind))
        return primitive(kind, pair.poisson, corner_at(x, y));
      switch (kind)
        {
        case Influence::zx:
          {
            const double r2 = x * x + y * y;
            return r2 == 0.
                     ? 0.
                     : pair.coupling * ((x == 0. ? 0. : x * std::atan(y / x)) + 0.5 * y * std::log(r2));
          }
        default:
          {
            const double r2 = x * x + y * y;
            return r2 == 0.
                     ? 0.
                     : pair.coupling * ((y == 0. ? 0. : y * std::atan(x / y)) + 0.5 * x * std::log(r2));
          }
        }
    }

    // The product without the checks for infinities that std::complex makes.
    std::complex<double> times(const std::complex<double> &a, const std::complex<double> &b)
    {
      return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
    }

    /// Multiply a spectrum by another, or by its conjugate. Separate arrays let the compiler work on several
    /// values at once.
    template <bool conjugate = false>
    void multiply(FourierGrid::Spectrum &spectrum, const FourierGrid::Spectrum &by)
    {
      std::complex<double> *const __restrict value        = spectrum.data();
      const std::complex<double> *const __restrict factor = by.data();
      for (std::size_t k = 0; k < spectrum.size(); ++k)
        value[k] = times(conjugate ? std::conj(factor[k]) : factor[k], value[k]);
    }

    unsigned int good_size(const unsigned int at_least)
    {
      for (unsigned int n = at_least;; ++n)
        {
          if (n % 2 != 0)
            continue;
          unsigned int rest = n;
          for (const unsigned int factor : {2u, 3u, 5u, 7u})
            while (rest % factor == 0)
              rest /= factor;
          if (rest == 1)
            return n;
        }
    }
  } // namespace

  void check_grid(const Grid &grid)
  {
    require(grid.n_x > 0, "n_x", grid.n_x, "at least 1");
    require(grid.n_y > 0, "n_y", grid.n_y, "at least 1");
    require_positive("dx", grid.dx, "m");
    require_positive("dy", grid.dy, "m");
    require_finite("x_first", grid.x_first);
    require_finite("y_first", grid.y_first);
  }

  Grid centred_grid(const double half_x, const double half_y, const double dx, const double dy)
  {
    require_positive("half_x", half_x, "m");
    require_positive("half_y", half_y, "m");
    require_positive("element_size", dx, "m");
    require_positive("element_size_y", dy, "m");
    const double m_x = std::ceil(half_x / dx - 0.5), m_y = std::ceil(half_y / dy - 0.5);
    require((2. * m_x + 1.) * (2. * m_y + 1.) <= 2e6, "element_size", std::min(dx, dy),
            "a size that gives at most two million elements on the grid");
    Grid grid;
    grid.n_x     = 2 * static_cast<unsigned int>(std::max(m_x, 0.)) + 1;
    grid.n_y     = 2 * static_cast<unsigned int>(std::max(m_y, 0.)) + 1;
    grid.dx      = dx;
    grid.dy      = dy;
    grid.x_first = -0.5 * (grid.n_x - 1) * dx;
    grid.y_first = -0.5 * (grid.n_y - 1) * dy;
    return grid;
  }

  Grid centred_grid(const double half_x, const double half_y, const double element_size)
  {
    return centred_grid(half_x, half_y, element_size, element_size);
  }

  namespace
  {
    /// Displacement of the layer at x in the row of an element with unit traction [m/Pa].
    double layer_influence(const Influence kind, const ElasticPair &pair, const double dx, const double x)
    {
      constexpr double within = 0.5 * (1. - 1e-9); // elements do not overlap by rounding
      return (kind == Influence::xx || kind == Influence::yy) && std::abs(x) < within * dx ? pair.layer : 0.;
    }
  } // namespace

  double influence_coefficient(const Influence    kind,
                               const ElasticPair &pair,
                               const double       dx,
                               const double       dy,
                               const double       x,
                               const double       y)
  {
    const double x0 = x - 0.5 * dx, x1 = x + 0.5 * dx, y0 = y - 0.5 * dy, y1 = y + 0.5 * dy;
    return (primitive(kind, pair, x1, y1) - primitive(kind, pair, x0, y1) - primitive(kind, pair, x1, y0) +
            primitive(kind, pair, x0, y0)) /
             (std::numbers::pi * pair.shear) +
           (std::abs(y) < 0.5 * dy ? layer_influence(kind, pair, dx, x) : 0.);
  }

  namespace
  {
    /// FFTW makes and destroys plans in one thread at a time; they are executed in any.
    std::mutex &planner()
    {
      static std::mutex mutex;
      return mutex;
    }
  } // namespace

  /// Of the padded rows only those of the grid hold values before a transform and are asked for after its
  /// inverse, so lines along x are transformed in these alone.
  struct FourierGrid::Plans
  {
    fftw_plan rows, columns;           ///< of transform()
    fftw_plan columns_back, rows_back; ///< of back()
    fftw_plan whole;                   ///< of kernels, which fill all rows

    explicit Plans(const FourierGrid &fourier)
    {
      const int n_x = static_cast<int>(fourier.padded[0]), n_y = static_cast<int>(fourier.padded[1]),
                n = static_cast<int>(fourier.grid.n_y), half = n_x / 2 + 1;
      std::vector<double, Aligned<double>> values(static_cast<std::size_t>(n_x) * n_y);
      Spectrum                             one(fourier.spectrum_size()), two(one);
      double *const                        real = values.data();
      const auto                           from = reinterpret_cast<fftw_complex *>(one.data()),
                 to                             = reinterpret_cast<fftw_complex *>(two.data());
      rows = fftw_plan_many_dft_r2c(1, &n_x, n, real, nullptr, 1, n_x, to, nullptr, 1, half, FFTW_ESTIMATE);
      rows_back =
        fftw_plan_many_dft_c2r(1, &n_x, n, from, nullptr, 1, half, real, nullptr, 1, n_x, FFTW_ESTIMATE);
      const auto along_y = [&](const int sign) {
        return fftw_plan_many_dft(1, &n_y, half, from, nullptr, half, 1, to, nullptr, half, 1, sign,
                                  FFTW_ESTIMATE);
      };
      columns      = along_y(FFTW_FORWARD);
      columns_back = along_y(FFTW_BACKWARD);
      whole        = fftw_plan_dft_r2c_2d(n_y, n_x, real, to, FFTW_ESTIMATE);
    }
    Plans(const Plans &)            = delete;
    Plans &operator=(const Plans &) = delete;

    ~Plans()
    {
      for (const fftw_plan plan : {rows, columns, columns_back, rows_back, whole})
        fftw_destroy_plan(plan);
    }

    /// Made once for each size and kept: on the small grids of a batch they cost as much as a hundred
    /// transforms.
    static const Plans &of(const FourierGrid &fourier)
    {
      const std::lock_guard<std::mutex>                   alone(planner());
      static std::map<std::array<unsigned int, 3>, Plans> made;
      return made.try_emplace({fourier.padded[0], fourier.padded[1], fourier.grid.n_y}, fourier)
        .first->second;
    }
  };

  FourierGrid::FourierGrid(const Grid &grid)
    : grid(grid)
  {
    check_grid(grid);
    padded = {good_size(2 * grid.n_x), good_size(2 * grid.n_y)};
    input.assign(static_cast<std::size_t>(padded[0]) * grid.n_y, 0.);
    output.resize(input.size());
    input_rows.assign(spectrum_size(), 0.);
    output_rows.resize(spectrum_size());
    plans = &Plans::of(*this);
    std::vector<unsigned int> all(grid.size());
    std::iota(all.begin(), all.end(), 0u);
    select(all);
  }

  FourierGrid::~FourierGrid() = default;

  void FourierGrid::select(const std::vector<unsigned int> &elements)
  {
    for (const unsigned int p : positions)
      input[p] = 0.;
    positions.resize(elements.size());
    for (std::size_t k = 0; k < elements.size(); ++k)
      positions[k] = elements[k] / grid.n_x * padded[0] + elements[k] % grid.n_x;
  }

  void FourierGrid::transform(const double *values, Spectrum &spectrum) const
  {
    spectrum.resize(spectrum_size());
    for (std::size_t k = 0; k < positions.size(); ++k)
      input[positions[k]] = values[k];
    const auto rows = reinterpret_cast<fftw_complex *>(input_rows.data());
    fftw_execute_dft_r2c(plans->rows, input.data(), rows);
    fftw_execute_dft(plans->columns, rows, reinterpret_cast<fftw_complex *>(spectrum.data()));
  }

  void FourierGrid::back(Spectrum &spectrum, double *values) const
  {
    const auto rows = reinterpret_cast<fftw_complex *>(output_rows.data());
    fftw_execute_dft(plans->columns_back, reinterpret_cast<fftw_complex *>(spectrum.data()), rows);
    fftw_execute_dft_c2r(plans->rows_back, rows, output.data());
    for (std::size_t k = 0; k < positions.size(); ++k)
      values[k] = output[positions[k]];
  }

  FourierGrid::Spectrum FourierGrid::kernel(
    const Influence                           kind,
    const ElasticPair                        &pair,
    const std::vector<std::array<double, 2>> &weights_and_offsets) const
  {
    const int         columns = static_cast<int>(padded[0]), rows = static_cast<int>(padded[1]);
    const std::size_t n      = static_cast<std::size_t>(columns) * rows;
    double           *values = fftw_alloc_real(n);
    std::fill_n(values, n, 0.);
    const int n_x = static_cast<int>(grid.n_x), n_y = static_cast<int>(grid.n_y);
    // Corners lie at half elements, whatever whole number of elements the offset is: a quarter of the plane
    // has them all.
    int  widest        = 0;
    bool whole_offsets = is_of_like_bodies(kind);
    for (const auto &[weight, offset] : weights_and_offsets)
      {
        const double elements = offset / grid.dx;
        whole_offsets         = whole_offsets && std::abs(elements - std::round(elements)) < 1e-9;
        widest                = std::max(widest, static_cast<int>(std::ceil(std::abs(elements))));
      }
    if (whole_offsets && quarter.size() < static_cast<std::size_t>(n_x + widest) * n_y)
      {
        quarter.clear();
        for (int i = 0; i < n_x + widest; ++i)
          for (int j = 0; j < n_y; ++j)
            {
              const Corner c = corner_at((i + 0.5) * grid.dx, (j + 0.5) * grid.dy);
              quarter.push_back({c.y_log_x, c.x_log_y, c.distance});
            }
      }
    const auto in_quarter = [](const int i) {
      return i < 0 ? -1 - i : i;
    };
    const auto at_corner = [&](const int i, const int j) {
      const auto  &c    = quarter[static_cast<std::size_t>(in_quarter(i)) * n_y + in_quarter(j)];
      const double sign = (i < 0) == (j < 0) ? 1. : -1.;
      return primitive(kind, pair.poisson, {sign * c[0], sign * c[1], c[2]});
    };

    for (const auto &[weight, offset] : weights_and_offsets)
      {
        // the primitive at the corners of all element offsets -(n-1) .. n-1
        const int           corners_x = 2 * n_x, corners_y = 2 * n_y;
        std::vector<double> corner(static_cast<std::size_t>(corners_x) * corners_y);
        const int           ahead = static_cast<int>(std::lround(offset / grid.dx));
        for (int j = 0; j < corners_y; ++j)
          for (int i = 0; i < corners_x; ++i)
            corner[static_cast<std::size_t>(j) * corners_x + i] =
              whole_offsets
                ? at_corner(i - n_x + ahead, j - n_y)
                : primitive(kind, pair, (i - n_x + 0.5) * grid.dx + offset, (j - n_y + 0.5) * grid.dy);
        const double scale = weight / (std::numbers::pi * pair.shear * static_cast<double>(n));
        for (int j = -n_y + 1; j < n_y; ++j)
          for (int i = -n_x + 1; i < n_x; ++i)
            {
              const double *c = &corner[static_cast<std::size_t>(j + n_y - 1) * corners_x + (i + n_x - 1)];
              values[static_cast<std::size_t>((j + rows) % rows) * columns + (i + columns) % columns] +=
                scale * (c[corners_x + 1] - c[corners_x] - c[1] + c[0]);
            }
        if (pair.layer != 0.)
          for (int i = -n_x + 1; i < n_x; ++i)
            values[(i + columns) % columns] +=
              weight / static_cast<double>(n) * layer_influence(kind, pair, grid.dx, i * grid.dx + offset);
      }
    Spectrum spectrum(spectrum_size());
    fftw_execute_dft_r2c(plans->whole, values, reinterpret_cast<fftw_complex *>(spectrum.data()));
    fftw_free(values);
    return spectrum;
  }

  void FourierGrid::factorise(Spectrum &spectrum, const double least) const
  {
    const std::size_t            n = padded[0], half = n / 2 + 1;
    double                      *line    = fftw_alloc_real(n);
    fftw_complex                *complex = fftw_alloc_complex(half);
    std::unique_lock<std::mutex> alone(planner());
    const fftw_plan back    = fftw_plan_dft_c2r_1d(static_cast<int>(n), complex, line, FFTW_ESTIMATE),
                    forward = fftw_plan_dft_r2c_1d(static_cast<int>(n), line, complex, FFTW_ESTIMATE);
    alone.unlock();
    for (unsigned int j = 0; j < padded[1]; ++j)
      {
        std::complex<double> *row = &spectrum[j * half];
        for (std::size_t i = 0; i < half; ++i)
          {
            complex[i][0] = std::log(std::max(row[i].real(), least));
            complex[i][1] = 0.;
          }
        fftw_execute(back);
        for (std::size_t i = 0; i < n; ++i)
          line[i] *= (i == 0 || 2 * i == n ? 0.5 : 2 * i < n ? 1. : 0.) / n;
        fftw_execute(forward);
        for (std::size_t i = 0; i < half; ++i)
          row[i] = std::exp(std::complex<double>(complex[i][0], complex[i][1]));
      }
    alone.lock();
    fftw_destroy_plan(back);
    fftw_destroy_plan(forward);
    alone.unlock();
    fftw_free(line);
    fftw_free(complex);
  }

  NormalOperator::NormalOperator(const FourierGrid &fourier, const ElasticPair &pair)
    : self_influence(influence_coefficient(Influence::zz, pair, fourier.grid.dx, fourier.grid.dy, 0., 0.))
    , fourier(fourier)
    , kernel(fourier.kernel(Influence::zz, pair, {{1., 0.}}))
  {
  }

  void NormalOperator::apply(const double *pressure, double *displacement) const
  {
    fourier.transform(pressure, work);
    multiply(work, kernel);
    fourier.back(work, displacement);
  }

  TangentialOperator::TangentialOperator(const FourierGrid                        &fourier,
                                         const ElasticPair                        &pair,
                                         const std::vector<std::array<double, 2>> &weights_and_offsets)
    : fourier(fourier)
    , xx(fourier.kernel(Influence::xx, pair, weights_and_offsets))
    , xy(fourier.kernel(Influence::xy, pair, weights_and_offsets))
    , yy(fourier.kernel(Influence::yy, pair, weights_and_offsets))
  {
  }

  void TangentialOperator::apply(const double *traction, double *displacement) const
  {
    const std::size_t n = fourier.n_selected();
    fourier.transform(traction, work_x);
    fourier.transform(traction + n, work_y);
    // as in multiply()
    const std::complex<double> *const __restrict of_xx = xx.data(), *const __restrict of_xy = xy.data(),
                                                 *const __restrict of_yy = yy.data();
    std::complex<double> *const __restrict x = work_x.data(), *const __restrict y = work_y.data();
    for (std::size_t k = 0; k < work_x.size(); ++k)
      {
        const std::complex<double> px = x[k], py = y[k];
        x[k] = times(of_xx[k], px) + times(of_xy[k], py);
        y[k] = times(of_xy[k], px) + times(of_yy[k], py);
      }
    fourier.back(work_x, displacement);
    fourier.back(work_y, displacement + n);
  }

  FactoredInverse::FactoredInverse(const FourierGrid &fourier, const ElasticPair &pair)
    : fourier(fourier)
  {
    const double n = static_cast<double>(fourier.padded_x()) * fourier.padded_y(); // kernels carry 1/n
    for (const unsigned int d : {0, 1})
      {
        const Influence kind = d == 0 ? Influence::xx : Influence::yy;
        inverse[d]           = fourier.kernel(kind, pair, {{1., 0.}});
        for (std::complex<double> &value : inverse[d])
          value *= n;
        // The spectrum's mean is the self-influence, its least value some 0.4 of that, but for the ripple of
        // a kernel that ends at the grid's size.
        const Grid &grid = fourier.grid;
        fourier.factorise(inverse[d], 0.1 * influence_coefficient(kind, pair, grid.dx, grid.dy, 0., 0.));
        for (std::complex<double> &value : inverse[d])
          value = 1. / (n * value);
      }
  }

  void FactoredInverse::apply(double *values, const bool forward) const
  {
    for (const unsigned int d : {0, 1})
      {
        double *block = values + d * fourier.n_selected();
        fourier.transform(block, work);
        forward ? multiply(work, inverse[d]) : multiply<true>(work, inverse[d]);
        fourier.back(work, block);
      }
  }

  void FactoredInverse::apply_forward(double *values) const
  {
    apply(values, true);
  }

  void FactoredInverse::apply_backward(double *values) const
  {
    apply(values, false);
  }

  CouplingOperator::CouplingOperator(const FourierGrid                        &fourier,
                                     const ElasticPair                        &pair,
                                     const std::vector<std::array<double, 2>> &weights_and_offsets)
    : fourier(fourier)
    , zx(fourier.kernel(Influence::zx, pair, weights_and_offsets))
    , zy(fourier.kernel(Influence::zy, pair, weights_and_offsets))
  {
  }

  void CouplingOperator::tangential_by_pressure(const double *pressure, double *displacement) const
  {
    fourier.transform(pressure, work_x);
    work_y = work_x;
    for (std::size_t k = 0; k < work_x.size(); ++k)
      {
        work_x[k] = -times(work_x[k], zx[k]);
        work_y[k] = -times(work_y[k], zy[k]);
      }
    fourier.back(work_x, displacement);
    fourier.back(work_y, displacement + fourier.n_selected());
  }

  void CouplingOperator::normal_by_traction(const double *traction, double *displacement) const
  {
    fourier.transform(traction, work_x);
    fourier.transform(traction + fourier.n_selected(), work_y);
    for (std::size_t k = 0; k < work_x.size(); ++k)
      work_x[k] = times(zx[k], work_x[k]) + times(zy[k], work_y[k]);
    fourier.back(work_x, displacement);
  }
} // namespace tread::reference
