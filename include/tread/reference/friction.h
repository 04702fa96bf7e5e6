// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_friction_h
#define tread_reference_friction_h

#include <functional>
#include <memory>

namespace tread::reference
{
  /// Friction between two half-spaces: Coulomb's, or with a coefficient that depends on slip, pressure, place
  /// or temperature.
  struct Friction
  {
    double friction = 0.; ///< Coulomb's friction coefficient f [-], >= 0; 0: no shear at all

    /// Friction that falls with the slip speed; null: `friction` at any speed.
    struct SlipFriction
    {
      /// Coefficient at a slip speed [m/s] in the long run, never above `friction`, which is that without
      /// slip.
      std::function<double(double)> coefficient;
      /// The coefficient mu that a particle has follows d mu/dt = -max(s, memory_speed)/memory_distance (mu -
      /// coefficient(s)) from `friction` at the leading edge on (Vollebregt & Schuttelaars 2012). 0 m: at
      /// once.
      double memory_distance = 0.; ///< [m]
      double memory_speed    = 0.; ///< [m/s]
    };
    std::shared_ptr<const SlipFriction> slip_friction;

    /// Factor of `friction` at a pressure [Pa]; empty: 1. Not with slip_friction.
    std::function<double(double)> pressure_factor;

    /// Factor of `friction` at a place of the patch, x and y of the grid [m]; empty: 1. Not with
    /// slip_friction.
    std::function<double(double x, double y)> place_factor;

    /// Friction that changes with the temperature to which it heats a surface that passes the patch (@see
    /// SurfaceHeat); null: it does not. Not with slip_friction.
    struct HeatFriction
    {
      std::function<double(double)> factor;     ///< of `friction` at a rise of temperature [K]
      double                        heat_share; ///< of the heat of friction that flows into that surface
      double                        effusivity; ///< of its body [J/(m^2 K sqrt(s))]
    };
    std::shared_ptr<const HeatFriction> heat_friction;

    /// Whether the coefficient is the same everywhere and at any time.
    bool is_coulomb() const
    {
      return !slip_friction && !pressure_factor && !place_factor && !heat_friction;
    }
    /// Of `friction` at a place and a pressure [m, Pa], without slip and before heat changes it.
    double friction_factor(const double x, const double y, const double pressure) const
    {
      return (pressure_factor ? pressure_factor(pressure) : 1.) * (place_factor ? place_factor(x, y) : 1.);
    }
    /// Largest shear stress that friction carries there [Pa], without slip.
    double friction_bound(const double x, const double y, const double pressure) const
    {
      return friction * friction_factor(x, y, pressure) * pressure;
    }
  };
} // namespace tread::reference

#endif
