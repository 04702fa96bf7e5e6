// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_profile_wear_h
#define tread_analysis_profile_wear_h

#include <tread/analysis/wear_law.h>
#include <tread/analysis/wheelset_contact.h>
#include <tread/analysis/worn_profile.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tread
{
  /// One of the ways in which a wheel passes the rail while both wear. SI units.
  struct WearContact
  {
    double           weight = 1.; ///< share of the passages, over the sum of all
    WheelsetPosition position;    ///< the height is found
    WheelRolling     rolling;
    double           load        = 0.; ///< vertical, on the wheel
    bool             both_wheels = false;
    /// Slip of the wheel over the rail where it touches, over the speed: sets the angular velocity. None:
    /// that of `rolling`.
    std::optional<double> creepage;
  };

  struct ProfileWearParameters
  {
    std::shared_ptr<const WearLaw> law;
    double                         passages  = 0.; ///< of wheels over the rail, in all; 0: the rail stays
    double                         turns     = 0.; ///< of the wheel, in all; 0: the wheel stays
    double                         spacing   = 0.25e-3; ///< of the points of profiles, m
    double                         smoothing = 2e-3;    ///< WornProfile::smoothed(), m
    double                         change    = 0.05;    ///< that a step may make, @see WearStep::change
    double       least_step = 0.1e-6; ///< of the largest depth, below which no step is shortened, m
    unsigned int states     = 1;      ///< so many are kept, at equal distances, beside the start

    double     radius     = 0.46; ///< of the new wheel where z = 0 in its profile, m
    double     rail_angle = 0.;   ///< by which the rail's profile is turned in the track, rad
    TrackGauge gauge;
    /// Where the profile's origin lies in the track, m; none: by the gauge face of the new rail.
    std::optional<WheelOnRail::RailOrigin> origin;
  };

  /// What a step of wear did. Areas are volumes on a metre of way.
  struct WearStep
  {
    double progress; ///< of all, at its end
    /// Of the distribution of normal force across the rail: the sum of absolute changes over that of forces,
    /// mean of the contacts by their weights.
    double change;
    double rail_depth, wheel_depth; ///< largest ones so far, m
    double rail_area, wheel_area;   ///< gone so far, m^2
    double mean_work;               ///< of friction in a passage on a metre of way, by weights, J/m
    double max_pressure;            ///< of all contacts, Pa
    double mean_max_pressure;       ///< by weights, Pa
  };

  /// A patch of a contact of the block at one state.
  struct WearPatch
  {
    unsigned int contact, patch;
    double       rail_y, wheel_y, angle; ///< in the profiles of the bodies, m; inclination in the track, rad
    double       normal_force, longitudinal_force, lateral_force; ///< in contact axes, on the wheel, N
    double       max_pressure;
    double       length, width; ///< m
    double       creepage, lateral_creepage, spin;
    double       work;             ///< of friction on a metre of way, J/m
    double       rail_area;        ///< that the rail loses in a passage, on a metre of way, m^2
    double       angular_velocity; ///< of the wheel, rad/s
    double       turn;             ///< WheelPatch::turn
    double       element;          ///< edge across, m
    double       sink_by_others;   ///< over its undeformed overlap
    bool         climbs;           ///< on the flange beyond its steepest part
  };

  /// A state that is kept.
  struct WornState
  {
    double                        progress;
    std::vector<dealii::Point<2>> rail, wheel;    ///< profiles, m
    std::vector<double>    rail_work, wheel_work; ///< of friction so far, by point, J on a metre of way
    std::vector<WearPatch> patches;
  };

  /// Wear that changes the profiles of rail and wheel, by half-space theory: a block of contacts is solved,
  /// both surfaces lose what they lose in a share of all passages, and the block is solved again on the new
  /// profiles.
  ///
  /// Pressure follows waves of the profile the more closely the shorter they are, so that steps with the
  /// present losses alone would have to be some tenths of a micrometre, whatever they change. The steps are
  /// those of a Rosenbrock method of second order with two blocks a step, which keeps its order with any
  /// derivative (ROS2; Verwer et al. 1999): the derivative is that of plane contact, pressure being half of
  /// Hertz's modulus times the wave number times the depth, as a sum of exchanges between points, so that no
  /// area gets lost. A step is as long as the distribution of pressure changes by no more than is allowed.
  class ProfileWear
  {
  public:
    ProfileWear(const ProfileWearParameters    &parameters,
                const std::vector<WearContact> &contacts,
                const ProfileCurve             &wheel,
                const ProfileCurve             &rail);

    bool is_done() const
    {
      return progress >= 1.;
    }
    /// Solve the first block, or wear by a step. @throws std::runtime_error, one line, where a contact has no
    /// answer or a profile folds
    void advance();

    const std::vector<WearStep> &steps() const
    {
      return done;
    }
    const std::vector<WornState> &states() const
    {
      return kept;
    }
    unsigned int n_refused() const ///< steps that were taken again, shorter
    {
      return refused;
    }
    unsigned int n_forced() const ///< steps of the least depth that changed more than allowed
    {
      return forced;
    }
    const WornProfile &rail() const
    {
      return rail_profile;
    }
    const WornProfile &wheel() const
    {
      return wheel_profile;
    }
    /// What the law has taken so far, m^2, and the work of friction behind it, J/m.
    struct Lost
    {
      double area, work;
    };
    Lost rail_loss() const
    {
      return rail_lost;
    }
    Lost wheel_loss() const
    {
      return wheel_lost;
    }
    /// Both surfaces as they are now.
    WheelOnRail surfaces() const;

    /// @pre the same parameters, contacts and profiles
    void serialize(Archive &archive);

  private:
    /// What all passages would do if they were like those of one block, by points of the profiles.
    struct Rates
    {
      std::vector<double> rail_area, wheel_area, rail_work, wheel_work;
      /// How fast depths grow for each pressure, times the stiffness of short waves; times the points'
      /// lengths (m^2).
      std::vector<double> rail_yielding, wheel_yielding;
    };
    struct Answer
    {
      std::vector<double>    force; ///< normal, by points of the rail, N
      Rates                  rates;
      std::vector<WearPatch> patches;
      double                 radius = 0.; ///< at which the wheel rolls, mean by forces, m
      double                 work = 0., max_pressure = 0.;
    };
    struct Block
    {
      Rates               rates;
      std::vector<Answer> answers; ///< without rates
      double              mean_work = 0., max_pressure = 0., mean_max_pressure = 0.;
    };

    WheelOnRail surfaces(const WornProfile &wheel, const WornProfile &rail) const;
    Answer      solve(const WearContact &contact,
                      const WheelOnRail &surfaces,
                      const WornProfile &wheel,
                      const WornProfile &rail,
                      double             rolling_radius) const;
    void        add_patch(const WheelPatch   &patch,
                          const WheelContact &whole,
                          double              angular_velocity,
                          const WheelOnRail  &surfaces,
                          const WornProfile  &wheel,
                          const WornProfile  &rail,
                          const WearContact  &contact,
                          Answer             &answer) const;
    Block       solve(const WornProfile &wheel, const WornProfile &rail) const;
    double      change(const Block &before, const Block &after) const;
    double      deepest(const Rates &rates) const; ///< in all passages, m
    void        begin();
    void        keep_state();

    ProfileWearParameters    p;
    std::vector<WearContact> contacts;
    WornProfile              rail_profile, wheel_profile;
    std::vector<double>      rail_work, wheel_work; ///< so far, by points
    Block                    last;
    double                   progress = 0., share = 0.;
    unsigned int             refused = 0, forced = 0;
    Lost                     rail_lost{0., 0.}, wheel_lost{0., 0.};
    std::vector<WearStep>    done;
    std::vector<WornState>   kept;
    bool                     has_begun = false;
  };
} // namespace tread

#endif
