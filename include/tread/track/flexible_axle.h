// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_flexible_axle_h
#define tread_track_flexible_axle_h

#include <tread/base/archive.h>

#include <array>
#include <optional>

namespace tread
{
  /// SI units.
  struct FlexibleAxleParameters
  {
    std::optional<double> torsional_stiffness; ///< between both wheels, N m/rad; none: rigid
    std::optional<double> bending_stiffness;   ///< E I, N m^2; none: rigid
    double                damping_time = 0.;   ///< of its damping, over the stiffness: s
    double                half_length  = 0.;   ///< from the middle to the planes of the wheels, m
  };

  /// What an axle without mass between two like wheels, on which it is clamped, adds to their common rigid
  /// motion. It twists, and bends in both planes that contain it. Its deflection is counted from the start:
  /// what it bears then belongs to the position in which the wheelset was put on the rails.
  ///
  /// Each wheel turns against the chord between their middles as the end of an Euler-Bernoulli beam does:
  /// moments \f$M_1 = (2EI/L)(2\alpha_1 + \alpha_2)\f$ and likewise for the other. With a damping time
  /// \f$\tau\f$ the same of \f$\tau\dot\alpha\f$ is added. A wheel resists as a disc, half of its inertia
  /// about the axle about a diameter, and with the gyroscopic moments of one that turns.
  class FlexibleAxle
  {
  public:
    /// Number of a wheel: that of the own side, towards which the axle points, and the other one.
    enum Side
    {
      own,
      other
    };
    /// Of both, about the chord's axes x and z: rad, rad/s or N m.
    template <typename T>
    using OfSides = std::array<T, 2>;
    struct Tilt
    {
      double x = 0., z = 0.;
    };

    explicit FlexibleAxle(const FlexibleAxleParameters &parameters)
      : parameters(parameters)
    {
    }

    bool twists() const
    {
      return bool(parameters.torsional_stiffness);
    }
    bool bends() const
    {
      return bool(parameters.bending_stiffness);
    }
    double half_length() const
    {
      return parameters.half_length;
    }

    /// Straight and at rest, and hold from now on what acts first.
    void place();

    /// Twist of one wheel against the mean of both, rad.
    double twist(const Side side) const
    {
      return (side == own ? 0.5 : -0.5) * state.twist;
    }
    double twist_rate(const Side side) const
    {
      return (side == own ? 0.5 : -0.5) * state.twist_rate;
    }
    Tilt tilt(const Side side) const
    {
      return state.tilts[side];
    }
    Tilt tilt_rate(const Side side) const
    {
      return state.tilt_rates[side];
    }

    /// Moments on wheels that are not balanced by the axle, the axle's included. They turn the wheels and not
    /// the chord, N m. @param outside those of cells and of their turning, about the middle of each wheel
    OfSides<Tilt> unbalanced(const OfSides<Tilt> &outside);

    /// One central-difference step. @param moments what unbalanced() gave; @param torques about the axle, of
    /// the cells on each wheel, N m; @param of_chord angular acceleration of the chord, rad/s^2
    /// @param inertia of a wheel about the axle, kg m^2
    void advance(const OfSides<Tilt>   &moments,
                 const OfSides<double> &torques,
                 const Tilt             of_chord,
                 const double           inertia,
                 const double           time_step);

    /// What both wheels add to the kinetic energy that they have from the motion of the chord, J.
    /// @param of_chord its angular velocity, rad/s; @param inertia as above
    double kinetic_energy(const Tilt of_chord, const double inertia) const;

    /// Work of the axle on both wheels so far, J.
    double work() const
    {
      return state.work;
    }
    /// Sum of its absolute amounts, J.
    double gross_work() const
    {
      return state.gross;
    }

    /// Inertia of a wheel about a diameter, from that about the axle.
    static double about_diameter(const double inertia)
    {
      return 0.5 * inertia;
    }

    /// Largest angular frequency, rad/s. @param inertia as above; @param of_chord the same of the wheelset
    /// about the chord's middle, without what its wheels have about their own, kg m^2
    double largest_frequency(const double inertia, const double of_chord) const;

    /// Store or restore the state.
    void serialize(Archive &archive);

  private:
    struct State
    {
      double                       twist = 0., twist_rate = 0.; ///< of the own wheel against the other
      OfSides<Tilt>                tilts{}, tilt_rates{};
      std::optional<OfSides<Tilt>> held; ///< constant part of the axle's moments; none: before the first step
      std::optional<double>        held_torque; ///< on the own wheel, likewise
      OfSides<Tilt>                last{};      ///< moments of the axle in the present step
      double                       work = 0., gross = 0.;
    };

    FlexibleAxleParameters parameters;
    State                  state;
  };
} // namespace tread

#endif
