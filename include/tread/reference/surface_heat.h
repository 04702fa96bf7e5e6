// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_surface_heat_h
#define tread_reference_surface_heat_h

#include <array>

namespace tread::reference
{
  /// Temperature of a place on the surface of a half-space into whose depth heat flows, while it flows along
  /// the surface not at all: what a fast moving source leaves (Carslaw and Jaeger 1959, section 2.9; Blok
  /// 1937). The flux is constant over each interval of time.
  ///
  /// The kernel 1/sqrt(t) is a sum of exponentials, so that a place remembers what it has felt in a few
  /// numbers: the trapezoidal rule for its Laplace integral over the logarithm of the rates. What lies above
  /// the largest rate is felt at once; it makes the first interval exact.
  class SurfaceHeat
  {
  public:
    /// Rates from that of the interval down to 1e-12 of it, a factor of 3.3 apart.
    static constexpr unsigned int n_rates = 24;
    using Memory                          = std::array<double, n_rates>;

    /// @param interval s
    explicit SurfaceHeat(double interval);

    /// Let a flux (W/m^2) flow in for an interval. @returns the rise of temperature then, times the
    /// effusivity of the body (K times J/(m^2 K sqrt(s)))
    double flow(Memory &memory, double flux) const;

    /// Let nothing flow in for a time (s).
    void rest(Memory &memory, double time) const;

    double interval() const
    {
      return length;
    }

  private:
    double length, at_once;
    Memory rates, weights, decay, gain;
  };
} // namespace tread::reference

#endif
