// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_hub_settling_h
#define tread_track_hub_settling_h

#include <tread/base/archive.h>
#include <tread/track/hub_motion.h>

#include <functional>
#include <optional>

namespace tread
{
  /// How a hub follows its load where inertia is no part of the answer. Its own mass would take a hundred
  /// times as long to sink by what the contact gives way as the contact takes to roll over a patch. A light
  /// one is there after about a patch, or as soon as the scaled cells let it. Its damper leads to a companion
  /// on which nothing else acts, so that a hub which rises evenly is free of it. Where the rail's height
  /// changes along the way both are carried along it.
  struct SettlingOfHub
  {
    double stiffness; ///< of the contacts under the hub, N/m
    double time;      ///< in which half a patch is rolled over, s
    double arm;       ///< of the contacts from the middle of the axle, for the roll, m
    /// That move with the hub, kg, with the density that they have: of its carried nodes, and of free cells.
    double carried_mass = 0., cell_mass = 0.;

    /// Of the hub, kg: its period on the contact is the time. With less than its nodes would have it would
    /// shorten the stable time step.
    double mass() const;
    /// Of the damper, N s/m, and of the companion, kg. With these, of the masses that move on the contact, 2
    /// % of a step of the load is left after 7.8 radians of their oscillation.
    double damping() const;
    double companion_mass() const;
  };

  /// A hub that settles: its dampers and their companions.
  class HubSettling
  {
  public:
    /// @param settling none: the hub has its own inertia, and nothing here acts
    explicit HubSettling(const std::optional<SettlingOfHub> &settling)
      : settling(settling)
    {
    }
    /// Inertia against moving up (kg), and of the same mass on the contacts against a roll (kg m^2); none:
    /// the hub's own.
    std::optional<double> mass() const;
    double                roll_inertia() const;
    /// Tell the masses of carried nodes and of free cells, as they move, kg.
    void count(const double carried, const double cells);
    /// A hub that settles is carried along the height at which contact bears the load, which varies along the
    /// way, so that its mass does not lag behind. @param curvature second derivative of that height by x,
    /// 1/m, at x
    void ride(const std::function<double(const double x)> &curvature)
    {
      curvature_of_way = curvature;
    }

    void place();
    /// Rise and roll with the rail from now on.
    void begin(HubMotion &motion, const double speed);
    /// Force of the damper (N), and moment of that of the roll (N m); they move their companions.
    double lift(const HubMotion &motion, const double time_step);
    double roll(const HubMotion &motion, const double time_step);
    /// Force that carries the hub and its cells along its way; its companion and the sprung mass move along.
    double carry(HubMotion &motion, const double time_step);

    void serialize(Archive &archive);

  private:
    /// @param scale of a mass up, for what the companion moves in
    double damper(const double velocity, double &companion, const double scale, const double time_step) const;
    /// Of a mass on the contacts: its inertia about the middle between them, per kg.
    double per_roll() const
    {
      return settling->arm * settling->arm;
    }

    /// Velocities of the companions: up, m/s, and of the roll, rad/s.
    struct Companions
    {
      double up = 0., roll = 0.;
    };
    std::optional<SettlingOfHub> settling;
    Companions                   companions;
    /// Null: a level height.
    std::function<double(double)> curvature_of_way;
  };
} // namespace tread

#endif
