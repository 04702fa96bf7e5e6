// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_critical_step_h
#define tread_dynamics_critical_step_h

#include <tread/base/archive.h>
#include <tread/dynamics/moving_bodies.h>

namespace tread
{
  /// The largest stable time step of bodies, and whether it still is stable with the cells as they are
  /// deformed.
  class CriticalStep
  {
  public:
    explicit CriticalStep(const MovingBodies &bodies)
      : moving(bodies)
    {
    }

    /// Largest stable time step of level 0 with the prescribed damping, s, from the highest frequencies of
    /// the cells of each level and above. Collective; the first call costs about 30 force evaluations per
    /// level and requires that all supports are set.
    double seconds() const;

    /// Time step that the cells alone allow over the critical one, which springs and dampers shorten.
    double slowed_by_supports() const;

    /// Determine it for the cells as they are deformed at present. Cells that are yielding at present count
    /// with their softer tangent. Collective; about 30 force evaluations per level.
    void renew();

    /// @throws WentWrong if a cell has been turned inside out or strained too much, or if the cells have
    /// deformed so much that the time step is no longer stable. Collective; costs about one force evaluation,
    /// or 30 per level if a bound from the cells' stretches is not sufficient.
    void check_cells();

    void serialize(Archive &archive)
    {
      archive.same(critical_step, highest_of_step, bound_found_stable);
    }

  private:
    /// Highest frequency of the cells of this and higher levels with nodes at x, rad/s.
    double highest_frequency(const unsigned int    first_level,
                             const NodalField     &x,
                             const PlasticHistory &memory) const;
    /// The largest of these frequencies times 2^level, which the steps of level 0 must resolve, rad/s.
    double highest_of_levels(const NodalField &x, const PlasticHistory &memory) const;
    double step_for(double highest_of_levels) const; ///< s; also stores that frequency

    const MovingBodies &moving;
    mutable double critical_step = 0., highest_of_step = 0.; ///< s, and the frequency that it is for, rad/s
    mutable double bound_found_stable = 0.; ///< times the Courant number: no check is needed below it, rad/s
  };
} // namespace tread

#endif
