// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_t_gamma_h
#define tread_reference_t_gamma_h

#include <array>

namespace tread::reference
{
  /// Regimes of wear by T-gamma over the area in contact, which twin discs show: mild, where the rate rises
  /// in proportion, severe, where it stays, and catastrophic, where it rises again (Lewis and Dwyer-Joyce
  /// 2004; Braghin, Lewis, Dwyer-Joyce and Bruni 2006).
  struct WearRegimes
  {
    std::array<double, 2> borders; ///< T-gamma over area, Pa
    std::array<double, 2> slopes;  ///< of the rate in the first regime and in the last, kg/m^3 per Pa

    /// 1, 2 or 3. @param t_gamma_per_area Pa
    unsigned int regime(const double t_gamma_per_area) const
    {
      return t_gamma_per_area < borders[0] ? 1 : t_gamma_per_area <= borders[1] ? 2 : 3;
    }

    /// Mass that is lost for each metre rolled and square metre in contact, kg/m^3. The last regime goes on
    /// from the rate of the second one.
    double rate(const double t_gamma_per_area) const
    {
      switch (regime(t_gamma_per_area))
        {
        case 1:
          return slopes[0] * t_gamma_per_area;
        case 2:
          return slopes[0] * borders[0];
        default:
          return slopes[0] * borders[0] + slopes[1] * (t_gamma_per_area - borders[1]);
        }
    }
  };

  /// A wheel of R8T on a rail of 900A (Braghin, Lewis, Dwyer-Joyce and Bruni 2006, whose formula of the last
  /// regime is printed without the rate from which it goes on).
  constexpr WearRegimes regimes_of_r8t_on_900a{{{10.4e6, 77.2e6}}, {{5.3e-9, 61.9e-9}}};
} // namespace tread::reference

#endif
