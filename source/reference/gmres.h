// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_gmres_h
#define tread_reference_gmres_h

#include <cmath>
#include <cstddef>
#include <vector>

namespace tread::reference
{
  /// Restarted GMRES (Saad & Schultz 1986) with a right preconditioner, which must be linear.
  class Gmres
  {
  public:
    /// Solve A x = b from x = 0 until |b - A x| <= tolerance |b|.
    /// @param apply        apply(in, out): out = A in, arrays of size() entries
    /// @param precondition precondition(in, out): out = approximately A^-1 in
    /// @return number of products with A
    template <typename Apply, typename Precondition>
    unsigned int solve(const std::vector<double> &b,
                       std::vector<double>       &x,
                       const double               tolerance,
                       const unsigned int         max_products,
                       const Apply               &apply,
                       const Precondition        &precondition,
                       const unsigned int         restart = 120)
    {
      const std::size_t n = b.size();
      x.assign(n, 0.);
      std::vector<double> residual = b, work(n), image(n);
      const double        norm_b   = norm(b);
      unsigned int        products = 0;
      if (norm_b == 0.)
        return 0;
      while (products < max_products)
        {
          const double beta = norm(residual);
          if (beta <= tolerance * norm_b)
            break;
          basis.resize(restart + 1);
          std::vector<double> h((restart + 1) * restart, 0.), cosine(restart), sine(restart),
            rhs(restart + 1, 0.);
          basis[0] = residual;
          scale(basis[0], 1. / beta);
          rhs[0]         = beta;
          unsigned int k = 0;
          for (; k < restart && products < max_products; ++k)
            {
              precondition(basis[k].data(), image.data());
              apply(image.data(), work.data());
              ++products;
              double *column = &h[k * (restart + 1)];
              for (unsigned int i = 0; i <= k; ++i)
                {
                  const double dot = product(basis[i], work);
                  column[i]        = dot;
                  for (std::size_t e = 0; e < n; ++e)
                    work[e] -= dot * basis[i][e];
                }
              const double next = norm(work);
              column[k + 1]     = next;
              if (next > 0.)
                {
                  basis[k + 1] = work;
                  scale(basis[k + 1], 1. / next);
                }
              for (unsigned int i = 0; i < k; ++i)
                {
                  const double c = cosine[i] * column[i] + sine[i] * column[i + 1];
                  column[i + 1]  = -sine[i] * column[i] + cosine[i] * column[i + 1];
                  column[i]      = c;
                }
              const double length = std::hypot(column[k], column[k + 1]);
              cosine[k]           = length > 0. ? column[k] / length : 1.;
              sine[k]             = length > 0. ? column[k + 1] / length : 0.;
              column[k]           = length;
              column[k + 1]       = 0.;
              rhs[k + 1]          = -sine[k] * rhs[k];
              rhs[k] *= cosine[k];
              if (std::abs(rhs[k + 1]) <= tolerance * norm_b || next == 0.)
                {
                  ++k;
                  break;
                }
            }
          std::vector<double> y(k, 0.);
          for (unsigned int i = k; i-- > 0;)
            {
              double sum = rhs[i];
              for (unsigned int j = i + 1; j < k; ++j)
                sum -= h[j * (restart + 1) + i] * y[j];
              const double diagonal = h[i * (restart + 1) + i];
              y[i]                  = diagonal != 0. ? sum / diagonal : 0.;
            }
          work.assign(n, 0.);
          for (unsigned int j = 0; j < k; ++j)
            for (std::size_t e = 0; e < n; ++e)
              work[e] += y[j] * basis[j][e];
          precondition(work.data(), image.data());
          for (std::size_t e = 0; e < n; ++e)
            x[e] += image[e];
          if (std::abs(rhs[k]) <= tolerance * norm_b)
            break;
          apply(x.data(), work.data());
          ++products;
          for (std::size_t e = 0; e < n; ++e)
            residual[e] = b[e] - work[e];
        }
      return products;
    }

  private:
    static double product(const std::vector<double> &a, const std::vector<double> &b)
    {
      // four partial sums: without them the sum is a chain of dependent additions
      double            s0 = 0., s1 = 0., s2 = 0., s3 = 0.;
      std::size_t       e = 0;
      const std::size_t n = a.size();
      for (; e + 4 <= n; e += 4)
        {
          s0 += a[e] * b[e];
          s1 += a[e + 1] * b[e + 1];
          s2 += a[e + 2] * b[e + 2];
          s3 += a[e + 3] * b[e + 3];
        }
      for (; e < n; ++e)
        s0 += a[e] * b[e];
      return (s0 + s1) + (s2 + s3);
    }
    static double norm(const std::vector<double> &a)
    {
      return std::sqrt(product(a, a));
    }
    static void scale(std::vector<double> &a, const double factor)
    {
      for (double &v : a)
        v *= factor;
    }

    std::vector<std::vector<double>> basis;
  };
} // namespace tread::reference

#endif
